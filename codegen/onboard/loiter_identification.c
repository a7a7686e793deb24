@HEAD@
#include "loiter_identification.h"

@ARITHMETIC@

@GENERATED@
/* ---- The functions of loiter_identification.h ------------------------------------------------------------------- */

void loiter_identification_begin(loiter_identification *identification, loiter_law *law, bool is_wind_known) {
    unsigned char *const bytes = (unsigned char *)&identification->memory;
    VehicleEstimates *const declared = &law->vehicle.estimates;
    declared->turn_ratio = declared->quick_turn_ratio = @TURN_RATIO@;
    law->settings.negligible_wind = @NEGLIGIBLE_WIND@;
    for (unsigned i = 0; i < sizeof identification->memory; i++) {
        bytes[i] = 0;
    }
    identification->begin_us = 0;
    identification->settings = settings_of(declared, law->settings.limit_deg, is_wind_known ? @WIND_KNOWN@ : REAL(0.0));
    begin_identification(&identification->memory, &identification->settings);
}

/* Times are relative to `begin_us`, which follows the clock at these intervals, seconds, as in a law. */
#define INTERVAL_S 64

static void follow_clock(loiter_identification *identification, uint32_t time_us) {
    Stamps *const stamps = &identification->memory.stamps;
    if (stamps->clock.time_s == -REAL_INFINITY) {
        identification->begin_us = time_us;
        return;
    }
    const int32_t intervals = (int32_t)real_floor(stamps->clock.time_s / (real)INTERVAL_S);
    const real past_s = (real)(intervals * INTERVAL_S);
    identification->begin_us += (uint32_t)intervals * (uint32_t)INTERVAL_S * UINT32_C(1000000);
    stamps->clock.time_s -= past_s;
    stamps->clock.first_s -= past_s;
    stamps->clock.latest_s -= past_s;
    stamps->used_s -= past_s;
}

int loiter_law_step_identified(loiter_law *law, loiter_identification *identification, const loiter_measurement *m,
                               loiter_real dt_s, loiter_command *command) {
    if (!is_step(dt_s)) {
        return LOITER_BAD_STEP;
    }
    Identification *const memory = &identification->memory;
    follow_clock(identification, m->time_us);
    const real time_s = (real)(int32_t)(m->time_us - identification->begin_us) * REAL(1e-6);
    const State state = {time_s,      m->east_m,           m->north_m,           m->heading_deg,
                         m->bank_deg, m->velocity_east_m_s, m->velocity_north_m_s, m->airspeed_m_s};
    advance_identification(memory, &identification->settings, &state, law->memory.command.bank_deg, law->memory.step_s);
    law->vehicle.revision = memory->revision;
    law->vehicle.bank_deg = memory->roll.bank_deg;
    law->vehicle.bank_rate_deg_s = memory->roll.bank_rate_deg_s;
    law->vehicle.estimates = memory->estimates;
    return loiter_law_step_known(law, m, dt_s, command);
}
