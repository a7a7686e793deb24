@HEAD@
#include "loiter.h"

@ARITHMETIC@

@TYPEDEFS@

@GENERATED@
/* ---- The functions of loiter.h ---------------------------------------------------------------------------------- */

static int exported(Entry found, loiter_entry *entry) {
    const integer_3 u = controls(found.word);
    const integer each[3] = {u.a0, u.a1, u.a2};
    const real durations[3] = {found.t1, found.t2, found.t3};
    entry->side = (int)found.side;
    entry->pieces = 0;
    for (int i = 0; i < 3; i++) {
        const bool is_piece = each[i] != ABSENT;
        entry->controls[i] = is_piece ? (int)each[i] : LOITER_STRAIGHT;
        entry->durations[i] = is_piece ? durations[i] : REAL(0.0);
        entry->pieces += is_piece ? 1 : 0;
    }
    return LOITER_OK;
}

static int status_of_side(int side) { return side >= -1 && side <= 1 ? LOITER_OK : LOITER_BAD_TURN; }

static int end_with(loiter_search *search, int status) {
    search->state.entry.status = status;
    search->state.stage = ENDED;
    return status;
}

int loiter_search_begin(loiter_search *search, const loiter_problem *p) {
    const real size = length(p->c, p->s);
    search->state = NO_SEARCH;
    if (status_of_side(p->side) != LOITER_OK) {
        return end_with(search, LOITER_BAD_TURN);
    }
    if (!(real_fabs(size - REAL(1.0)) <= REAL(1e-3))) {
        return end_with(search, LOITER_BAD_POSE);
    }
    const WindProblem problem = {p->x,    p->y,  p->c / size, p->s / size, rounded_radius(p->radius),
                                 p->side, p->wx, p->wy,       p->tolerance};
    const integer status = status_of(&problem);
    if (status != STATUS_OK) {
        return end_with(search, (int)status);
    }
    if (p->wx == REAL(0.0) && p->wy == REAL(0.0)) {
        const real_2 at = reduce(problem.x, problem.y, problem.c, problem.s);
        const Entry found = optimum(at.a0, at.a1, problem.R, problem.side, problem.tolerance);
        WindEntry *const entry = &search->state.entry;
        entry->side = found.side;
        entry->word = found.word;
        entry->t1 = found.t1;
        entry->t2 = found.t2;
        entry->t3 = found.t3;
        return end_with(search, LOITER_OK);
    }
    search->state = begin_search(&problem);
    return LOITER_OK;
}

int loiter_search_step(loiter_search *search, int steps, loiter_entry *entry) {
    advance_search(&search->state, steps);
    if (search->state.stage != ENDED) {
        return LOITER_SEARCHING;
    }
    return search->state.entry.status == STATUS_OK ? exported(entry_of(&search->state.entry), entry)
                                                   : (int)search->state.entry.status;
}

int loiter_fastest(const loiter_problem *problem, loiter_entry *entry) {
    loiter_search search;
    const int status = loiter_search_begin(&search, problem);
    return status == LOITER_OK ? loiter_search_step(&search, UNLIMITED, entry) : status;
}

loiter_law_config loiter_law_defaults(loiter_real airspeed_m_s, loiter_real bank_limit_deg, loiter_real radius_m,
                                      int side) {
    loiter_law_config config;
    config.radius_m = radius_m;
    config.side = side;
    config.airspeed_m_s = airspeed_m_s;
    config.bank_limit_deg = bank_limit_deg;
    config.roll_time_s = @ROLL_TIME@;
    config.roll_rate_deg_s = @ROLL_RATE@;
    config.roll_slew_deg_s = REAL_INFINITY;
    config.delay_s = @DELAY@;
    config.wind_east_m_s = config.wind_north_m_s = REAL(0.0);
    config.reserve = @RESERVE@;
    config.smoothing_s = @SMOOTHING@;
    config.gain = @GAIN@;
    config.search_steps = 0;
    return config;
}

static bool is_within(real value, real least, real most) { return value >= least && value <= most; }

/* The largest times, seconds, gains and speeds of any aircraft, the largest bank, degrees, whose tangent single precision
 * still resolves, and the least rate of a roll, degrees per second, and time constant but 0, seconds; with others numbers
 * might overflow, or be divided by zero. */
#define MOST @LARGEST_SETTING@
#define LARGEST_BANK REAL(89.0)
#define LEAST_ROLL_RATE @LEAST_ROLL_RATE@
#define LEAST_ROLL_TIME @LEAST_ROLL_TIME@

/* Whether a law can be made for a configuration. */
static int status_of_config(const loiter_law_config *c) {
    if (!is_within(c->airspeed_m_s, LEAST_AIRSPEED_M_S, MOST) || !(c->bank_limit_deg > REAL(0.0)) ||
        !(c->bank_limit_deg <= LARGEST_BANK)) {
        return LOITER_BAD_AIRCRAFT;
    }
    if (!(c->radius_m > REAL(0.0)) || !(c->radius_m <= LARGEST_VALUE)) {
        return LOITER_BAD_ORBIT;
    }
    if (status_of_side(c->side) != LOITER_OK) {
        return LOITER_BAD_TURN;
    }
    const bool is_roll = c->roll_time_s == REAL(0.0) || is_within(c->roll_time_s, LEAST_ROLL_TIME, MOST);
    if (!is_roll || !(c->roll_rate_deg_s >= LEAST_ROLL_RATE) ||
        !(c->roll_slew_deg_s >= LEAST_ROLL_RATE) ||
        !is_within(c->delay_s, REAL(0.0), MOST) || !is_within(c->reserve, REAL(0.0), MOST) ||
        !is_within(c->smoothing_s, REAL(0.0), MOST) || !(c->gain > REAL(0.0)) || !(c->gain <= MOST) || c->search_steps < 0) {
        return LOITER_BAD_RESPONSE;
    }
    const real R = rounded_radius(c->radius_m / radius_at_bank(c->airspeed_m_s, c->bank_limit_deg));
    const real wx = c->wind_east_m_s / c->airspeed_m_s, wy = c->wind_north_m_s / c->airspeed_m_s;
    if (!isfinite(wx) || !isfinite(wy)) {
        return LOITER_BAD_WIND;
    }
    const WindProblem at_centre = {REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0), R, SIDE_EITHER, wx, wy, REAL(0.0)};
    return (int)status_of(&at_centre);
}

/* Let the memory use the rings of this law, wherever that is now. */
static void use_own_rings(loiter_law *law) {
    law->memory.sensing.history.entries = &law->rings.BankEntry_ring_128;
    law->memory.sensing.observer.air.recent = &law->rings.AirSample_ring_64;
}

int loiter_law_begin(loiter_law *law, const loiter_law_config *c) {
    const int status = status_of_config(c);
    if (status != LOITER_OK) {
        return status;
    }
    const RollValues roll = {c->roll_time_s, c->roll_rate_deg_s, REAL(0.0), c->roll_slew_deg_s};
    const VehicleEstimates declared = {roll,
                                       c->delay_s,
                                       REAL(1.0),
                                       REAL(1.0),
                                       REAL(0.0),
                                       c->wind_east_m_s,
                                       c->wind_north_m_s,
                                       c->airspeed_m_s,
                                       c->airspeed_m_s,
                                       REAL(0.0),
                                       REAL(0.0),
                                       REAL(0.0),
                                       REAL(0.0)};
    law->settings = MAKE(Settings){REAL(0.0),
                                   REAL(0.0),
                                   c->radius_m,
                                   c->side,
                                   REAL(0.0),
                                   REAL(0.0),
                                   c->wind_east_m_s,
                                   c->wind_north_m_s,
                                   c->bank_limit_deg,
                                   c->bank_limit_deg,
                                   c->gain,
                                   c->reserve,
                                   c->smoothing_s,
                                   REAL(0.0),
                                   max_real(@COVERED@, c->delay_s),
                                   c->search_steps};
    law->vehicle = MAKE(VehicleModel){0, REAL(0.0), REAL(0.0), declared};
    law->begin_us = 0;
    law->memory = first_memory(&law->rings, &law->settings, &law->vehicle);
    return LOITER_OK;
}

/* Times in the memory are relative to `begin_us`, which follows the clock at these intervals, seconds: single precision
 * resolves 4 microseconds in the first of them. */
#define INTERVAL_S 64

static void follow_clock(loiter_law *law, uint32_t time_us) {
    Sensing *sensing = &law->memory.sensing;
    Clock *clock = &sensing->clock;
    if (clock->time_s == -REAL_INFINITY) {
        law->begin_us = time_us;
        return;
    }
    const int32_t intervals = (int32_t)real_floor(clock->time_s / (real)INTERVAL_S);
    if (intervals == 0) {
        return;
    }
    const real past_s = (real)(intervals * INTERVAL_S);
    law->begin_us += (uint32_t)intervals * (uint32_t)INTERVAL_S * UINT32_C(1000000);
    clock->time_s -= past_s;
    clock->first_s -= past_s;
    clock->latest_s -= past_s;
    sensing->observer.estimate.time_s -= past_s;
    sensing->present.time_s -= past_s;
    plan_by_clock(&law->memory.planning.plan, -past_s);
    law->memory.planning.search.state.time_s -= past_s;
    law->memory.planning.response.state.time_s -= past_s;
    BankEntry *entries = law->rings.BankEntry_ring_128.at;
    const BankEntry last = entries[ENTRIES - 1];
    for (int i = 0; i < ENTRIES; i++) {
        entries[i].end_s -= last.end_s;
        entries[i].integral -= last.integral;
    }
    AirSample *samples = law->rings.AirSample_ring_64.at;
    const real now_s = samples[SAMPLES - 1].time_s;
    for (int i = 0; i < SAMPLES; i++) {
        samples[i].time_s -= now_s;
    }
}

/* A step, once the bank of the vehicle is modelled for the end of the last command. */
static void step_with(loiter_law *law, const loiter_measurement *m, real dt_s, loiter_command *command) {
    use_own_rings(law);
    follow_clock(law, m->time_us);
    const real time_s = (real)(int32_t)(m->time_us - law->begin_us) * REAL(1e-6);
    const State state = {time_s,      m->east_m,           m->north_m,           m->heading_deg,
                         m->bank_deg, m->velocity_east_m_s, m->velocity_north_m_s, m->airspeed_m_s};
    advance(&law->rings, &law->memory, &law->settings, &law->vehicle, &state, dt_s);
    const LawCommand *const given = &law->memory.command;
    command->turn_rate_deg_s = given->turn_rate_deg_s;
    command->bank_deg = given->bank_deg;
    command->phase = (int)given->phase;
    command->time_to_join_s = given->time_to_join_s;
    command->side = (int)given->side;
    command->next_phase = (int)given->next_phase;
    command->next_in_s = given->next_in_s;
}

int loiter_law_step_known(loiter_law *law, const loiter_measurement *measurement, loiter_real dt_s,
                          loiter_command *command) {
    if (!is_step(dt_s)) {
        return LOITER_BAD_STEP;
    }
    step_with(law, measurement, dt_s, command);
    return LOITER_OK;
}

int loiter_law_step(loiter_law *law, const loiter_measurement *measurement, loiter_real dt_s, loiter_command *command) {
    if (is_step(dt_s)) {
        law->vehicle = fly_as_declared(&law->vehicle, law->memory.command.bank_deg, law->memory.step_s);
    }
    return loiter_law_step_known(law, measurement, dt_s, command);
}
