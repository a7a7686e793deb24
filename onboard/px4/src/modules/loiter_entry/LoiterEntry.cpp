#include "LoiterEntry.hpp"

#include <math.h>
#include <px4_platform_common/log.h>
#include <px4_platform_common/posix.h>
#include <string.h>
#include <systemlib/mavlink_log.h>

static constexpr char NAME[] {"Loiter entry"};

static constexpr float DEGREES{57.29577951f}, GRAVITY_M_S2{9.80665f};
static constexpr double RADIANS{0.017453292519943295};

/* The work queue: the law needs more stack than the queues of PX4 have, and a step in wind more time than the queue of
 * the controllers can spare. */
static constexpr px4::wq_config_t QUEUE{"wq:loiter_entry", 9000, -20};

/* A run takes so many steps of a search in wind: 160,000 instructions in the mean and 600,000 at most, where a whole
 * search takes up to 1.5 million. */
static constexpr int SEARCH_STEPS{20};

/* The longest time between two runs where no position comes, and between two requests; the age of measurements that are
 * too old. Microseconds. */
static constexpr uint32_t IDLE_US{50000};
static constexpr hrt_abstime ASK_AGAIN_US{1000000}, TOO_OLD_US{300000}, SLOW_TOO_OLD_US{2000000}, REPORT_US{5000000};

/* The bank limit lies below PX4's by this, degrees, and is never above the second. */
static constexpr float BANK_MARGIN_DEG{0.5f}, STEEPEST_DEG{60.0f};

/* The ellipsoid WGS 84: the semi-major axis, metres, and the eccentricity squared. */
static constexpr double EQUATOR_M{6378137.0}, ECCENTRICITY2{6.69437999014e-3};

static LoiterEntry *running{nullptr};

LoiterEntry::LoiterEntry()
    : ScheduledWorkItem("loiter_entry", QUEUE), _latitude_param(param_find("LOIT_LAT")),
      _longitude_param(param_find("LOIT_LON")), _radius_param(param_find("LOIT_RADIUS")),
      _direction_param(param_find("LOIT_DIR")), _roll_time_param(param_find("LOIT_ROLL_T")),
      _roll_rate_param(param_find("LOIT_ROLL_RATE")), _delay_param(param_find("LOIT_DELAY")),
      _airspeed_param(param_find("FW_AIRSPD_TRIM")), _bank_param(param_find("FW_R_LIM")),
      _slew_param(param_find("FW_PN_R_SLEW_MAX"))
{
    _wind.windspeed_north = _wind.windspeed_east = NAN;
    _airspeed.true_airspeed_m_s = _airspeed.calibrated_airspeed_m_s = NAN;
}

bool LoiterEntry::init()
{
    read_parameters();
    ScheduleDelayed(IDLE_US);
    return _position_sub.registerCallback();
}

void LoiterEntry::Run()
{
    ScheduleDelayed(IDLE_US);
    _status_sub.update(&_status);
    _airspeed_sub.update(&_airspeed);
    _wind_sub.update(&_wind);

    if (_should_stop) {
        stop();
        return;
    }

    parameter_update_s changed;

    if (_parameter_update_sub.update(&changed) && !_flies) {
        read_parameters();
    }

    take_registration();
    register_mode();
    answer_arming_check();
    update_mode();

    if (_flies) {
        fly();
    }
}

/* ---- Registration ----------------------------------------------------------------------------------------------- */

void LoiterEntry::register_mode()
{
    /* PX4 registers modes only before arming. */
    const bool armed = _status.arming_state == vehicle_status_s::ARMING_STATE_ARMED;

    if (_mode >= 0 || armed || hrt_elapsed_time(&_requested_at) < ASK_AGAIN_US) {
        return;
    }

    register_ext_component_request_s request{};
    request.timestamp = _requested_at = hrt_absolute_time();
    request.request_id = _request_id = _requested_at;
    strncpy(request.name, NAME, sizeof(request.name) - 1);
    request.px4_ros2_api_version = register_ext_component_request_s::LATEST_PX4_ROS2_API_VERSION;
    request.register_arming_check = true;
    request.register_mode = true;
    _register_pub.publish(request);
}

void LoiterEntry::take_registration()
{
    register_ext_component_reply_s reply;

    while (_registered_sub.update(&reply)) {
        if (_mode < 0 && reply.request_id == _request_id && reply.success) {
            _mode = reply.mode_id;
            _arming_check = reply.arming_check_id;
            PX4_INFO("registered as external mode %i", _mode - vehicle_status_s::NAVIGATION_STATE_EXTERNAL1 + 1);
        }
    }
}

void LoiterEntry::answer_arming_check()
{
    arming_check_request_s request;

    if (!_arming_check_sub.update(&request) || _mode < 0) {
        return;
    }

    arming_check_reply_s reply{};
    reply.timestamp = hrt_absolute_time();
    reply.request_id = request.request_id;
    reply.registration_id = (uint8_t)_arming_check;
    reply.health_component_index = arming_check_reply_s::HEALTH_COMPONENT_INDEX_NONE;
    reply.can_arm_and_run = _circle_status == LOITER_OK;
    reply.mode_req_angular_velocity = true;
    reply.mode_req_attitude = true;
    reply.mode_req_local_alt = true;
    reply.mode_req_local_position = true;
    reply.mode_req_global_position = true;
    reply.mode_req_prevent_arming = true;
    _arming_check_pub.publish(reply);
}

/* ---- What is known ---------------------------------------------------------------------------------------------- */

float LoiterEntry::read(param_t parameter) const
{
    float value = NAN;
    param_get(parameter, &value);
    return value;
}

void LoiterEntry::read_parameters()
{
    int32_t latitude = 0, longitude = 0, side = LOITER_EITHER;
    param_get(_latitude_param, &latitude);
    param_get(_longitude_param, &longitude);
    param_get(_direction_param, &side);
    _airspeed_m_s = read(_airspeed_param);
    _circle = {1e-7 * latitude, 1e-7 * longitude, read(_radius_param), (int)side};

    /* Whether the circle can be held: in the wind that is known now. */
    const bool is_given = latitude != 0 || longitude != 0;
    _circle_status = is_given ? _flight.begin(law_config()) : (int)LOITER_BAD_ORBIT;
}

loiter_law_config LoiterEntry::law_config() const
{
    const bool is_measured = PX4_ISFINITE(_airspeed.true_airspeed_m_s) && _airspeed.calibrated_airspeed_m_s > 1.0f;
    const float thinner = is_measured ? _airspeed.true_airspeed_m_s / _airspeed.calibrated_airspeed_m_s : 1.0f;
    const float limit_deg = fminf(read(_bank_param) - BANK_MARGIN_DEG, STEEPEST_DEG);
    loiter_law_config config = loiter_law_defaults(thinner * _airspeed_m_s, limit_deg, _circle.radius_m, _circle.side);
    config.roll_time_s = read(_roll_time_param);
    config.roll_rate_deg_s = read(_roll_rate_param);
    const float slew_deg_s = read(_slew_param);

    /* With 0 PX4 does not limit its bank setpoint. */
    if (slew_deg_s > 0.0f) {
        config.roll_slew_deg_s = slew_deg_s;
    }

    config.delay_s = read(_delay_param);
    config.search_steps = SEARCH_STEPS;

    if (PX4_ISFINITE(_wind.windspeed_east) && PX4_ISFINITE(_wind.windspeed_north)) {
        config.wind_east_m_s = _wind.windspeed_east;
        config.wind_north_m_s = _wind.windspeed_north;
    }

    return config;
}

float LoiterEntry::true_airspeed_m_s() const
{
    const bool is_measured = PX4_ISFINITE(_airspeed.true_airspeed_m_s)
                          && hrt_elapsed_time(&_airspeed.timestamp) < SLOW_TOO_OLD_US;

    if (is_measured) {
        return _airspeed.true_airspeed_m_s;
    }

    const float east = _local.vy - _wind.windspeed_east, north = _local.vx - _wind.windspeed_north;
    return PX4_ISFINITE(east + north) ? hypotf(east, north) : _airspeed_m_s;
}

/* Whether attitude, position and velocity are known and new. */
bool LoiterEntry::measure(loiter_measurement &m)
{
    _position_sub.update(&_position);
    _local_position_sub.update(&_local);
    _attitude_sub.update(&_attitude);

    const bool is_new = hrt_elapsed_time(&_position.timestamp) < TOO_OLD_US
                        && hrt_elapsed_time(&_local.timestamp) < TOO_OLD_US
                        && hrt_elapsed_time(&_attitude.timestamp) < TOO_OLD_US;

    if (!is_new || !_position.lat_lon_valid || !_local.v_xy_valid) {
        return false;
    }

    const double sine = sin(RADIANS * _circle.latitude_deg), flatter = 1.0 - ECCENTRICITY2 * sine * sine;
    const double across_m = EQUATOR_M / sqrt(flatter), along_m = across_m * (1.0 - ECCENTRICITY2) / flatter;
    const double cosine = cos(RADIANS * _circle.latitude_deg);
    m.time_us = (uint32_t)_position.timestamp_sample;
    m.east_m = (float)(RADIANS * remainder(_position.lon - _circle.longitude_deg, 360.0) * across_m * cosine);
    m.north_m = (float)(RADIANS * (_position.lat - _circle.latitude_deg) * along_m);
    m.velocity_east_m_s = _local.vy;
    m.velocity_north_m_s = _local.vx;

    const float *q = _attitude.q;
    m.heading_deg = DEGREES * atan2f(2.0f * (q[0] * q[3] + q[1] * q[2]), 1.0f - 2.0f * (q[2] * q[2] + q[3] * q[3]));
    m.bank_deg = DEGREES * atan2f(2.0f * (q[0] * q[1] + q[2] * q[3]), 1.0f - 2.0f * (q[1] * q[1] + q[2] * q[2]));
    m.airspeed_m_s = true_airspeed_m_s();
    return PX4_ISFINITE(m.east_m + m.north_m + m.velocity_east_m_s + m.velocity_north_m_s + m.heading_deg + m.bank_deg);
}

/* ---- The flight ------------------------------------------------------------------------------------------------- */

void LoiterEntry::update_mode()
{
    const bool is_ours = _mode >= 0 && _status.nav_state == _mode
                         && _status.arming_state == vehicle_status_s::ARMING_STATE_ARMED;

    if (is_ours && !_flies) {
        begin();

    } else if (!is_ours && _flies) {
        /* The pilot, a failsafe, or the hand-over: nothing more is sent. */
        _flies = false;
        mavlink_log_info(&_mavlink_log_pub, "%s: %s\t", NAME, _reason != nullptr ? _reason : "the mode was changed");
        read_parameters();
    }
}

void LoiterEntry::begin()
{
    read_parameters();
    _local_position_sub.update(&_local);
    _altitude_m = _local.ref_alt - _local.z;
    _flies = true;
    _said_on_circle = false;
    _reason = nullptr;
    _ordered_at = _said_at = 0;
    _stepped_at = hrt_absolute_time();
    configure_setpoints();

    if (_circle_status != LOITER_OK) {
        hand_over("this circle cannot be held");
    }
}

void LoiterEntry::fly()
{
    const hrt_abstime now = hrt_absolute_time();
    const bool asks_again = _reason != nullptr && now - _ordered_at > ASK_AGAIN_US;
    loiter_measurement measurement;

    if (_circle_status != LOITER_OK || !measure(measurement)) {
        publish_bank(0.0f);
        hand_over("position or attitude is missing");

    } else if (_flight.jumps(measurement)) {
        publish_bank(0.0f);
        hand_over("the position has jumped");

    } else {
        const float dt_s = fminf(fmaxf(1e-6f * (float)(now - _stepped_at), 0.001f), 0.1f);
        _stepped_at = now;
        publish_bank(_flight.step(measurement, dt_s));
        report_progress();

        if (_reason == nullptr && _flight.hold().settled()) {
            hand_over("Hold flies the circle");
        }
    }

    if (asks_again) {
        command_orbit();
    }
}

void LoiterEntry::report_progress()
{
    const loiter_command &command = _flight.command();
    const char *direction = command.side < 0 ? "counter-clockwise" : "clockwise";
    const hrt_abstime now = hrt_absolute_time();

    if (command.phase == LOITER_HOLD && !_said_on_circle) {
        _said_on_circle = true;
        mavlink_log_info(&_mavlink_log_pub, "%s: on the circle, %s\t", NAME, direction);

    } else if (!_said_on_circle && now - _said_at > REPORT_US && PX4_ISFINITE(command.time_to_join_s)) {
        _said_at = now;
        mavlink_log_info(&_mavlink_log_pub, "%s: joins %s in %.0f s\t", NAME, direction, (double)command.time_to_join_s);
    }
}

void LoiterEntry::publish_bank(float bank_deg)
{
    fixed_wing_lateral_setpoint_s lateral{};
    lateral.timestamp = hrt_absolute_time();
    lateral.course = lateral.airspeed_direction = NAN;
    lateral.lateral_acceleration = GRAVITY_M_S2 * tanf(bank_deg / DEGREES);
    _lateral_pub.publish(lateral);

    fixed_wing_longitudinal_setpoint_s longitudinal{};
    longitudinal.timestamp = lateral.timestamp;
    longitudinal.altitude = _altitude_m;
    longitudinal.height_rate = longitudinal.pitch_direct = longitudinal.throttle_direct = NAN;
    longitudinal.equivalent_airspeed = _airspeed_m_s;
    _longitudinal_pub.publish(longitudinal);
}

void LoiterEntry::configure_setpoints()
{
#ifdef LOITER_ENTRY_CONFIGURES_SETPOINTS
    setpoint_config_s config{};
    config.timestamp = hrt_absolute_time();
    config.type = setpoint_config_s::TYPE_FIXEDWING_LATERAL_LONGITUDINAL;
    config.source_id = (uint8_t)_mode;
    config.should_apply = true;
    _setpoint_config_pub.publish(config);
#endif
}

void LoiterEntry::hand_over(const char *reason)
{
    if (_reason == nullptr) {
        _reason = reason;
        command_orbit();
    }
}

void LoiterEntry::command_orbit()
{
    const int side = _flight.command().side != 0 ? _flight.command().side : _circle.side;
    vehicle_command_s order{};
    order.timestamp = _ordered_at = hrt_absolute_time();
    order.command = vehicle_command_s::VEHICLE_CMD_DO_ORBIT;
    order.param1 = side < 0 ? -_circle.radius_m : _circle.radius_m;
    order.param2 = order.param4 = NAN;
    order.param3 = (float)vehicle_command_s::ORBIT_YAW_BEHAVIOUR_UNCHANGED;
    order.param5 = _circle.latitude_deg;
    order.param6 = _circle.longitude_deg;
    order.param7 = _altitude_m;
    order.target_system = order.source_system = _status.system_id;
    order.target_component = _status.component_id;
    order.source_component = _status.component_id;
    _command_pub.publish(order);
}

void LoiterEntry::stop()
{
    if (_flies) {
        command_orbit();
        _flies = false;
    }

    if (_mode >= 0) {
        unregister_ext_component_s leave{};
        leave.timestamp = hrt_absolute_time();
        strncpy(leave.name, NAME, sizeof(leave.name) - 1);
        leave.arming_check_id = (int8_t)_arming_check;
        leave.mode_id = (int8_t)_mode;
        leave.mode_executor_id = -1;
        _unregister_pub.publish(leave);
    }

    _position_sub.unregisterCallback();
    ScheduleClear();
    _has_ended = true;
}

void LoiterEntry::print_status() const
{
    PX4_INFO("circle %.7f, %.7f, radius %.1f m: %s", _circle.latitude_deg, _circle.longitude_deg,
             (double)_circle.radius_m, _circle_status == LOITER_OK ? "can be flown" : "cannot be flown");
    PX4_INFO("%s", _mode < 0 ? "not registered: start it before arming" : _flies ? "flies" : "waits for its mode");

    if (_flies) {
        PX4_INFO("bank %.1f deg, %.1f m outside the circle", (double)_flight.command().bank_deg,
                 (double)_flight.hold().offset().outside_m);
    }
}

/* ---- The command of PX4's shell --------------------------------------------------------------------------------- */

static int start()
{
    running = new LoiterEntry();

    if (running != nullptr && running->init()) {
        return 0;
    }

    PX4_ERR("no memory, or no positions");
    delete running;
    running = nullptr;
    return 1;
}

static int stop()
{
    running->request_stop();

    for (int i = 0; i < 20 && !running->has_ended(); i++) {
        px4_usleep(100000);
    }

    if (!running->has_ended()) {
        PX4_ERR("does not stop");
        return 1;
    }

    delete running;
    running = nullptr;
    return 0;
}

extern "C" __EXPORT int loiter_entry_main(int argc, char *argv[])
{
    const char *verb = argc > 1 ? argv[1] : "";

    if (strcmp(verb, "start") == 0 && running == nullptr) {
        return start();

    } else if (strcmp(verb, "stop") == 0 && running != nullptr) {
        return stop();

    } else if (strcmp(verb, "status") == 0 && running != nullptr) {
        running->print_status();
        return 0;
    }

    PX4_INFO("%s: loiter_entry start | stop | status", running == nullptr ? "does not run" : "runs");
    return 1;
}
