/* Flies the module of onboard/px4 in a simulation of ours, in which PX4's commander is a few lines, and prints what it
 * sent: `flight SCENARIO`, where the scenario is what happens. */
#include "px4.hpp"

extern "C" int loiter_entry_main(int argc, char *argv[]);

static constexpr double DEGREE{0.017453292519943295}, EARTH_M{6378137.0};
static constexpr double LATITUDE_DEG{0.0}, LONGITUDE_DEG{8.5}, AIRSPEED_M_S{15.0};

/* How the simulated aircraft rolls: a time constant, seconds. */
static constexpr double ROLL_S{0.2};

static hrt_abstime now{1000000};
static const char *scenario{""};
px4::WorkItem *listener{nullptr};
static px4::WorkItem *item{nullptr};

hrt_abstime hrt_absolute_time() { return now; }
px4::WorkItem::~WorkItem() {}
px4::ScheduledWorkItem::ScheduledWorkItem(const char *, const wq_config_t &) { item = this; }

static bool happens(const char *what) { return strcmp(scenario, what) == 0; }

/* ---- Parameters ------------------------------------------------------------------------------------------------- */

static const char *const NAMES[] {"LOIT_LAT", "LOIT_LON", "LOIT_RADIUS", "LOIT_DIR", "LOIT_ROLL_T", "LOIT_ROLL_RATE",
                                  "LOIT_DELAY", "FW_AIRSPD_TRIM", "FW_R_LIM", "FW_PN_R_SLEW_MAX"};
static const double VALUES[] {LATITUDE_DEG * 1e7, LONGITUDE_DEG * 1e7, 60.0, 0.0, ROLL_S, 200.0, 0.02, AIRSPEED_M_S, 50.0, 90.0};

param_t param_find(const char *name)
{
    for (int i = 0; i < 10; i++) {
        if (strcmp(name, NAMES[i]) == 0) {
            return i;
        }
    }

    return -1;
}

static double value_of(param_t parameter)
{
    if (parameter == 2 && happens("tight")) {
        return 18.0;
    }

    if (parameter == 1 && happens("unset")) {
        return 0.0;
    }

    return parameter == 3 && happens("clockwise") ? 1.0 : VALUES[parameter];
}

int param_get(param_t parameter, void *to)
{
    const bool is_integer = parameter == 0 || parameter == 1 || parameter == 3;
    const float real = (float)value_of(parameter);
    const int32_t integer = (int32_t)value_of(parameter);
    memcpy(to, is_integer ? (const void *)&integer : (const void *)&real, 4);
    return 0;
}

/* ---- The aircraft and the rest of PX4 ---------------------------------------------------------------------------- */

static struct {
    double east_m, north_m, heading_deg, bank_deg;
} aircraft{-250.0, 40.0, 60.0, 0.0};

static uint8_t nav_state{vehicle_status_s::NAVIGATION_STATE_AUTO_LOITER};
static double began_s{0.0}, largest_deg{0.0}, last_setpoint_s{0.0};
static unsigned orders{0}, setpoints{0};

template<class T> static void publish(const T &message) { uORB::Publication<T>{nullptr}.publish(message); }

static double seconds() { return 1e-6 * (double)now; }

/* Whether a scenario's misfortune happens now: from 5 s after the mode began. */
static bool strikes(const char *what) { return happens(what) && began_s > 0.0 && seconds() > began_s + 5.0; }

/* The bank that the last setpoint asks for. */
static double asked_deg()
{
    return atan((double)topic<fixed_wing_lateral_setpoint_s>().message.lateral_acceleration / 9.80665) / DEGREE;
}

static void fly(double dt_s)
{
    aircraft.bank_deg += (asked_deg() - aircraft.bank_deg) * dt_s / ROLL_S;
    aircraft.heading_deg += 9.80665 * tan(aircraft.bank_deg * DEGREE) / AIRSPEED_M_S * dt_s / DEGREE;
    aircraft.east_m += AIRSPEED_M_S * sin(aircraft.heading_deg * DEGREE) * dt_s;
    aircraft.north_m += AIRSPEED_M_S * cos(aircraft.heading_deg * DEGREE) * dt_s;
}

static void sense()
{
    const double roll = 0.5 * aircraft.bank_deg * DEGREE, yaw = 0.5 * aircraft.heading_deg * DEGREE;
    publish(vehicle_attitude_s{now, {(float)(cos(roll) * cos(yaw)), (float)(sin(roll) * cos(yaw)),
                                     (float)(sin(roll) * sin(yaw)), (float)(cos(roll) * sin(yaw))}});
    const float north = (float)(AIRSPEED_M_S * cos(aircraft.heading_deg * DEGREE));
    const float east = (float)(AIRSPEED_M_S * sin(aircraft.heading_deg * DEGREE));
    publish(vehicle_local_position_s{now, -100.0f, north, east, 400.0f, true});
    const float airspeed = happens("no airspeed") ? NAN : (float)AIRSPEED_M_S;
    publish(airspeed_validated_s{now, airspeed, airspeed});
    /* The curvature of the ellipsoid along a meridian, at the equator. */
    const double along_m = EARTH_M * (1.0 - 6.69437999014e-3);
    const double north_m = aircraft.north_m + (strikes("jump") ? 200.0 : 0.0);

    if (!strikes("no position")) {
        publish(vehicle_global_position_s{now, now, LATITUDE_DEG + north_m / along_m / DEGREE,
                                          LONGITUDE_DEG + aircraft.east_m / EARTH_M / DEGREE, true});

        if (listener != nullptr) {
            listener->ScheduleNow();
        }
    }
}

static void command()
{
    const bool is_armed = happens("armed") || seconds() > 3.0;
    register_ext_component_request_s &request = topic<register_ext_component_request_s>().message;

    if (request.request_id != topic<register_ext_component_reply_s>().message.request_id) {
        publish(register_ext_component_reply_s{request.request_id, true, 2, vehicle_status_s::NAVIGATION_STATE_EXTERNAL1});
    }

    if (seconds() > 5.0 && began_s <= 0.0) {
        nav_state = vehicle_status_s::NAVIGATION_STATE_EXTERNAL1;
        began_s = seconds();
    }

    if (strikes("pilot")) {
        nav_state = vehicle_status_s::NAVIGATION_STATE_POSCTL;
    }

    if (topic<vehicle_command_s>().published > orders) {
        orders = topic<vehicle_command_s>().published;
        const vehicle_command_s &order = topic<vehicle_command_s>().message;
        printf("ordered %.2f %u %.3f %.7f %.7f %.1f\n", seconds() - began_s, order.command, (double)order.param1,
               order.param5, order.param6, (double)order.param7);
        nav_state = happens("deaf") || happens("no position") ? nav_state : vehicle_status_s::NAVIGATION_STATE_AUTO_LOITER;
    }

    const uint8_t armed = is_armed ? vehicle_status_s::ARMING_STATE_ARMED : vehicle_status_s::ARMING_STATE_DISARMED;
    publish(vehicle_status_s{armed, nav_state, 1, 1});

    if (now % 300000 == 0) {
        publish(arming_check_request_s{(uint8_t)(now / 300000)});
    }
}

static void watch()
{
    if (topic<fixed_wing_lateral_setpoint_s>().published > setpoints) {
        setpoints = topic<fixed_wing_lateral_setpoint_s>().published;
        last_setpoint_s = seconds();
        largest_deg = fmax(largest_deg, fabs(asked_deg()));
    }
}

/* A hundredth of a second. */
static void advance()
{
    now += 10000;
    command();
    sense();

    if (item != nullptr && item->due <= now) {
        item->due = UINT64_MAX;
        item->Run();
    }

    watch();

    if (began_s > 0.0 && nav_state == vehicle_status_s::NAVIGATION_STATE_EXTERNAL1) {
        fly(0.01);
    }
}

void px4_usleep(uint32_t us)
{
    for (uint32_t i = 0; i < us / 10000; i++) {
        advance();
    }
}

static void shell(const char *verb)
{
    char name[] {"loiter_entry"}, argument[20] {};
    strncpy(argument, verb, sizeof(argument) - 1);
    char *arguments[] {name, argument};
    printf("%s gives %i\n", verb, loiter_entry_main(2, arguments));
}

int main(int, char **argv)
{
    scenario = argv[1];
    command();
    shell("start");
    bool stopped = false;

    for (int i = 0; i < 7000; i++) {
        advance();

        if (strikes("stop") && !stopped) {
            stopped = true;
            shell("stop");
        }
    }

    if (!stopped) {
        shell("status");
    }

    const arming_check_reply_s &check = topic<arming_check_reply_s>().message;
    const unregister_ext_component_s &leave = topic<unregister_ext_component_s>().message;
    const fixed_wing_longitudinal_setpoint_s &along = topic<fixed_wing_longitudinal_setpoint_s>().message;
    printf("registered %u %s\n", topic<register_ext_component_request_s>().published,
           topic<register_ext_component_request_s>().message.name);
    printf("can run %i %i\n", check.registration_id, check.can_arm_and_run);
    printf("setpoints %u, last %.2f, largest bank %.2f\n", setpoints, last_setpoint_s - began_s, largest_deg);
    printf("last bank %.2f\n", asked_deg());
    printf("altitude %.1f, airspeed %.1f\n", (double)along.altitude, (double)along.equivalent_airspeed);
    printf("outside %.2f\n", hypot(aircraft.east_m, aircraft.north_m) - 60.0);
    printf("configured %u\n", topic<setpoint_config_s>().published);
    printf("unregistered %u %s %i %i\n", topic<unregister_ext_component_s>().published, leave.name, leave.arming_check_id,
           leave.mode_id);
    return 0;
}
