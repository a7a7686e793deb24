/* Flights in closed loop: the point mass, its sensors and its downlink as in loiter.lab.simulators, with the law
   of law.h, until they have settled as in loiter.lab.trials.settling. The caller draws the random numbers.
   SI units, banks and headings in degrees; a name of Python in a comment is that of the original. */

#include <string.h>
#include "law.h"

/* The largest number of commands and of measurements that wait. */
#define WAITING 1024

static const double DEGREE = 180.0 / 3.14159265358979323846;

/* A roll of first order, `Roll`, or of second order with dead time, `RollResponse`. */
typedef struct {
    int64_t order;
    double time_s, rate_deg_s, slew_deg_s, dead_time_s, damping, frequency, start_deg;
} RollKind;

typedef struct {
    double acts_s, command_deg;
} Waiting;

typedef struct {
    RollKind kind;
    double bank_deg, bank_rate_deg_s, command_deg;
    Waiting waiting[WAITING];
    int first, count;
} RollState;

/* An aircraft with its sensors and its downlink, and the circle about the origin that it shall settle on.

   The law knows the roll from the start where `knows_roll` holds: as a lag of `lag_s`, with its dead time. */
typedef struct {
    double east_m, north_m, heading_east, heading_north, V;
    double turn_ratio, wind_east_m_s, wind_north_m_s, limit_deg;
    RollKind roll;
    double position_m, heading_deg, bank_deg, velocity_m_s, airspeed_m_s, delay_s, heading_bias_deg, bank_bias_deg;
    double gust_m_s, gust_along, gust_y, gust_slope, gust_step[9];
    double rate_hz, jitter, loss, outage_s, outage_period_s;
    double radius_m;
    int64_t direction;
    double band, course_deg, step_s, limit_s;
    bool knows_roll;
    double lag_s;
} Scene;

typedef struct {
    double settled_s, joined_s, turned_deg;
    int64_t steps;
} Flown;

/* A step: the true state, the commanded bank, and the bank that the law models. */
typedef struct {
    double time_s, east_m, north_m, heading_deg, bank_deg, velocity_east_m_s, velocity_north_m_s;
    double command_deg, modelled_deg;
} Row;

static void begin_roll_state(RollState *roll, const RollKind *kind) {
    roll->kind = *kind;
    roll->bank_deg = roll->command_deg = kind->start_deg;
    roll->bank_rate_deg_s = 0.0;
    roll->first = 0;
    roll->count = 1;
    roll->waiting[0] = (Waiting){kind->dead_time_s, kind->start_deg};
}

static void integrate(RollState *roll, double command_deg, double time_s) {
    const double w = roll->kind.frequency;
    const int steps = 1 + (int)(time_s * w / 0.05);
    const double dt = time_s / steps;
    for (int i = 0; i < steps; i++) {
        const double acceleration =
            w * (w * (command_deg - roll->bank_deg) - 2.0 * roll->kind.damping * roll->bank_rate_deg_s);
        roll->bank_rate_deg_s = clip(roll->bank_rate_deg_s + acceleration * dt, roll->kind.rate_deg_s);
        roll->bank_deg += roll->bank_rate_deg_s * dt;
    }
}

static void fly_roll(RollState *roll, double time_s) {
    while (time_s > 0.0) {
        Waiting *next = &roll->waiting[roll->first];
        const double flown_s = next->acts_s < time_s ? next->acts_s : time_s;
        const double command_deg = next->command_deg;
        if (next->acts_s > flown_s) {
            next->acts_s -= flown_s;
        } else {
            roll->first = (roll->first + 1) % WAITING;
            roll->count--;
        }
        integrate(roll, command_deg, flown_s);
        time_s -= flown_s;
    }
}

/* The first order: the command that is followed counts with its mean. */
static void follow(RollState *roll, double command_deg, double dt) {
    const double change_deg = roll->kind.slew_deg_s * dt;
    const double followed_deg = dt > 0.0 ? mean_command(roll->command_deg, command_deg, change_deg) : command_deg;
    roll->command_deg = slewed_command(roll->command_deg, command_deg, change_deg);
    roll->bank_deg = bank_after(roll->kind.time_s, roll->kind.rate_deg_s, roll->bank_deg, followed_deg, dt);
}

/* The bank at half time. */
static double advance_roll(RollState *roll, double command_deg, double dt) {
    double halfway_deg;
    if (roll->kind.order == 1) {
        follow(roll, command_deg, 0.5 * dt);
        halfway_deg = roll->bank_deg;
        follow(roll, command_deg, 0.5 * dt);
        return halfway_deg;
    }
    roll->waiting[(roll->first + roll->count) % WAITING] = (Waiting){dt, command_deg};
    roll->count++;
    fly_roll(roll, 0.5 * dt);
    halfway_deg = roll->bank_deg;
    fly_roll(roll, 0.5 * dt);
    return halfway_deg;
}

typedef struct {
    const Scene *scene;
    PlanarPose pose;
    double time_s, along, y, slope;
    RollState roll;
    const double *normals, *gusts;
    State start, waiting[WAITING], latest;
    int first, count;
} Mass;

static void air_velocity(const Mass *mass, double *east, double *north) {
    const Scene *s = mass->scene;
    const double along = s->gust_m_s * mass->along, right = s->gust_m_s * (mass->y + sqrt(3.0) * mass->slope);
    *east = s->wind_east_m_s + along * mass->pose.c + right * mass->pose.s;
    *north = s->wind_north_m_s + along * mass->pose.s - right * mass->pose.c;
}

static double wrapped_deg(double angle_deg) {
    const double left = fmod(angle_deg, 360.0);
    return left < 0.0 ? left + 360.0 : left;
}

static State true_state(const Mass *mass) {
    const double V = mass->scene->V;
    double east, north;
    air_velocity(mass, &east, &north);
    return (State){mass->time_s, mass->pose.x, mass->pose.y, wrapped_deg(DEGREE * atan2(mass->pose.c, mass->pose.s)),
        mass->roll.bank_deg, V * mass->pose.c + east, V * mass->pose.s + north, V};
}

static State noisy(Mass *mass, State state) {
    const Scene *s = mass->scene;
    const double *n = mass->normals;
    mass->normals += 7;
    return (State){state.time_s, state.east_m + s->position_m * n[0], state.north_m + s->position_m * n[1],
        wrapped_deg(state.heading_deg + s->heading_bias_deg + s->heading_deg * n[2]),
        state.bank_deg + s->bank_bias_deg + s->bank_deg * n[3], state.velocity_east_m_s + s->velocity_m_s * n[4],
        state.velocity_north_m_s + s->velocity_m_s * n[5], state.airspeed_m_s + s->airspeed_m_s * n[6]};
}

static State state_before(State state, double time_s) {
    state.time_s -= time_s;
    state.east_m -= state.velocity_east_m_s * time_s;
    state.north_m -= state.velocity_north_m_s * time_s;
    return state;
}

static void release(Mass *mass, double due_s) {
    while (mass->count > 0 && mass->waiting[mass->first].time_s <= due_s + 1e-9) {
        mass->latest = mass->waiting[mass->first];
        mass->first = (mass->first + 1) % WAITING;
        mass->count--;
    }
}

static void await_release(Mass *mass, State measured) {
    mass->waiting[(mass->first + mass->count) % WAITING] = measured;
    mass->count++;
}

static void begin_mass(Mass *mass, const Scene *s, const double *normals, const double *gusts) {
    mass->scene = s;
    mass->pose = (PlanarPose){s->east_m, s->north_m, s->heading_east, s->heading_north};
    mass->time_s = 0.0;
    mass->along = s->gust_along;
    mass->y = s->gust_y;
    mass->slope = s->gust_slope;
    begin_roll_state(&mass->roll, &s->roll);
    mass->normals = normals;
    mass->gusts = gusts;
    mass->first = mass->count = 0;
    mass->start = true_state(mass);
    await_release(mass, noisy(mass, mass->start));
    if (s->delay_s > 0.0) {
        mass->latest = noisy(mass, state_before(mass->start, s->delay_s));
    } else {
        release(mass, 0.0);
    }
}

static void advance_mass(Mass *mass, double command_deg, double dt) {
    const Scene *s = mass->scene;
    const double V = s->V;
    const double halfway_deg = advance_roll(&mass->roll, clip(command_deg, s->limit_deg), dt);
    double east, north;
    air_velocity(mass, &east, &north);
    mass->pose = constant_turn(mass->pose, V, -s->turn_ratio * rate_at_bank(halfway_deg, V), dt, (real_2){east, north});
    if (s->gust_m_s > 0.0) {
        const double *g = s->gust_step, *n = mass->gusts, y = mass->y, slope = mass->slope;
        mass->gusts += 3;
        mass->along = g[0] * mass->along + g[1] * n[0];
        mass->y = g[2] * y + g[3] * slope + g[6] * n[1];
        mass->slope = g[4] * y + g[5] * slope + g[7] * n[1] + g[8] * n[2];
    }
    mass->time_s += dt;
    const State state = true_state(mass);
    await_release(mass, noisy(mass, state));
    const double due_s = mass->time_s - s->delay_s;
    if (due_s < 0.0) {
        mass->latest = noisy(mass, state_before(mass->start, -due_s));
    }
    release(mass, due_s);
}

typedef struct {
    const double *uniforms, *outages;
    double next_s, outage_from_s, outage_to_s;
    int64_t period;
    State latest;
} Link;

static double interval_s(Link *link, const Scene *s) {
    const double drawn = -s->jitter + 2.0 * s->jitter * *link->uniforms++;
    return (1.0 + drawn) / s->rate_hz;
}

static bool is_outage(Link *link, const Scene *s, double now_s) {
    while (link->period < (int64_t)(now_s / s->outage_period_s)) {
        link->period++;
        link->outage_from_s = ((double)link->period + *link->outages++) * s->outage_period_s;
        link->outage_to_s = link->outage_from_s + s->outage_s * *link->outages++;
    }
    return link->outage_from_s <= now_s && now_s < link->outage_to_s;
}

static void advance_link(Link *link, const Scene *s, const Mass *mass) {
    const double now_s = mass->time_s;
    if (now_s < link->next_s - 1e-9) {
        return;
    }
    while (link->next_s <= now_s + 1e-9) {
        link->next_s += interval_s(link, s);
    }
    const bool lost = *link->uniforms++ < s->loss;
    if (!(lost || is_outage(link, s, now_s))) {
        link->latest = mass->latest;
    }
}

/* Settling: `SettlingMonitor`. */
typedef struct {
    double azimuth_deg, in_band_deg, since_joining_deg, turned_deg, counted_deg, entered_s, joined_s;
    int direction;
    bool counts;
} Settling;

static int direction_in(const Scene *s, double outside, double outward, double clockwise, double factor) {
    for (int side = 1; side >= -1; side -= 2) {
        const double course_deg = DEGREE * atan2(-side * outward, side * clockwise);
        if ((s->direction == 0 || s->direction == side) && fabs(outside) <= factor * s->band * s->radius_m &&
            fabs(course_deg) <= factor * s->course_deg) {
            return side;
        }
    }
    return 0;
}

static void update_settling(Settling *m, const Scene *s, State state) {
    const double d = length(state.east_m, state.north_m);
    double out_east = state.east_m / d, out_north = state.north_m / d;
    if (d <= 0.1) {
        out_east = sin(state.heading_deg / DEGREE);
        out_north = cos(state.heading_deg / DEGREE);
    }
    const double outward = state.velocity_east_m_s * out_east + state.velocity_north_m_s * out_north;
    const double clockwise = state.velocity_east_m_s * out_north - state.velocity_north_m_s * out_east;
    const double azimuth_deg = DEGREE * atan2(out_east, out_north), outside = d - s->radius_m;
    const double flown_deg = remainder(azimuth_deg - m->azimuth_deg, 360.0);
    const int direction = direction_in(s, outside, outward, clockwise, 1.0);
    m->azimuth_deg = azimuth_deg;
    if (fabs(m->since_joining_deg) < 360.0) {
        const bool near = direction_in(s, outside, outward, clockwise, 2.0) != 0;
        if (near || !m->counts) {
            m->counts = true;
            m->counted_deg = state.heading_deg;
        }
        if (!near) {
            const double turned_deg = fabs(remainder(state.heading_deg - m->counted_deg, 360.0));
            if (turned_deg >= 10.0) {
                m->counted_deg = state.heading_deg;
                m->turned_deg += turned_deg;
            }
            m->since_joining_deg = 0.0;
            m->joined_s = nan("");
        } else if (m->joined_s == m->joined_s) {
            m->since_joining_deg += flown_deg;
        } else if (direction != 0) {
            m->joined_s = state.time_s;
        }
    }
    if (direction != m->direction || direction == 0) {
        m->direction = direction;
        m->in_band_deg = 0.0;
        m->entered_s = direction ? state.time_s : nan("");
    } else {
        m->in_band_deg += flown_deg;
    }
}

static bool has_settled(const Settling *m) { return m->direction * m->in_band_deg >= 360.0; }

static double or_nan(bool is_known, double value) { return is_known ? value : nan(""); }

/* Fly until the aircraft has settled, or for `limit_s`; `rows` has room for every step, or is null. */
void fly_scene(const Scene *s, const Settings *settings, const VehicleEstimates *declared, double wind_known_s,
               const double *normals, const double *gusts, const double *uniforms, const double *outages, Flown *flown,
               Row *rows) {
    static Mass mass;
    static Memory memory;
    static Identification identification;
    static RollState known_roll;
    const double dt = s->step_s;
    const IdentificationSettings known = settings_of(*declared, settings->limit_deg, wind_known_s);
    begin_mass(&mass, s, normals, gusts);
    memset(&identification, 0, sizeof identification);
    begin_identification(&identification, &known);
    VehicleModel vehicle = {0, 0.0, 0.0, *declared};
    memory = first_memory(*settings, vehicle);
    Link link = {uniforms, outages, 0.0, 0.0, 0.0, -1, mass.latest};
    link.next_s = interval_s(&link, s);
    Settling settling = {0.0, 0.0, 0.0, 0.0, 0.0, nan(""), nan(""), 0, false};
    RollKind modelled = s->roll;
    modelled.dead_time_s = modelled.start_deg = 0.0;
    begin_roll_state(&known_roll, &modelled);
    update_settling(&settling, s, true_state(&mass));
    int64_t steps = 0;
    for (; !has_settled(&settling) && mass.time_s < s->limit_s; steps++) {
        if (memory.step_s > 0.0) {
            (void)advance_roll(&known_roll, memory.command.bank_deg, memory.step_s);
        }
        advance_identification(&identification, &known, link.latest, memory.command.bank_deg, memory.step_s);
        vehicle = (VehicleModel){identification.revision, identification.roll.bank_deg,
            identification.roll.bank_rate_deg_s, identification.estimates};
        if (s->knows_roll) {
            vehicle.bank_deg = known_roll.bank_deg;
            vehicle.bank_rate_deg_s = known_roll.bank_rate_deg_s;
            vehicle.estimates.roll = (RollValues){s->lag_s, s->roll.rate_deg_s, s->roll.order == 1 ? 0.0 : 0.5 / (s->roll.damping * s->roll.frequency), s->roll.slew_deg_s};
            vehicle.estimates.delay_s = s->delay_s + s->roll.dead_time_s;
        }
        advance(&memory, *settings, vehicle, link.latest, dt);
        if (rows) {
            const State t = true_state(&mass);
            rows[steps] = (Row){t.time_s, t.east_m, t.north_m, t.heading_deg, t.bank_deg, t.velocity_east_m_s,
                t.velocity_north_m_s, memory.command.bank_deg, vehicle.bank_deg};
        }
        advance_mass(&mass, memory.command.bank_deg, dt);
        advance_link(&link, s, &mass);
        update_settling(&settling, s, true_state(&mass));
    }
    const bool settled = has_settled(&settling);
    *flown = (Flown){or_nan(settled, settling.entered_s), or_nan(settled, settling.joined_s),
        settling.turned_deg, steps};
}
