/* Calls every function of the C for autopilots with random and special numbers: nothing may trap, each call has a
 * status, and a command is within the limits.
 *
 * Arguments: the number of entries to find, in still air and in wind, and of steps of the law. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "loiter.h"

static unsigned long long seed = 88172645463325252ULL;

static unsigned long long bits(void) {
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return seed;
}

static loiter_real uniform(void) { return (loiter_real)((double)(bits() >> 11) / 9007199254740992.0); }

/* A number of some size, a special number, or any pattern of bits. */
static loiter_real number(loiter_real size) {
    static const double special[] = {0.0,   -0.0,  1.0,   -1.0,     2.0,       5e-324, 1e-40,
                                     1e-30, 1e-20, 1e-9,  16777216, 8388608.0, 1e18,   1e30,
                                     3e38,  1e300, 180.0, INFINITY, -INFINITY, NAN,    0.5};
    const unsigned long long kind = bits() % 32;
    loiter_real value;
    if (kind < 28) {
        return size * ((loiter_real)2 * uniform() - (loiter_real)1);
    }
    if (kind < 31) {
        const double chosen = special[bits() % (sizeof special / sizeof *special)];
        return fabs(chosen) > 3e38 && isfinite(chosen) && sizeof value == 4 ? (loiter_real)3e38 : (loiter_real)chosen;
    }
    const unsigned long long any = bits();
    memcpy(&value, &any, sizeof value);
    return value;
}

static void fail(const char *what) {
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static void entries(int count, int windy) {
    for (int i = 0; i < count; i++) {
        const double heading = 6.3 * (double)uniform();
        loiter_problem p;
        loiter_entry entry;
        p.x = number(8);
        p.y = number(8);
        p.c = bits() % 16 ? (loiter_real)cos(heading) : number(1);
        p.s = bits() % 16 ? (loiter_real)sin(heading) : number(1);
        p.radius = bits() % 8 ? 1 + (loiter_real)4 * uniform() : number(8);
        p.side = bits() % 32 ? (int)(bits() % 3) - 1 : (int)bits();
        p.wx = windy ? number((loiter_real)0.6) : 0;
        p.wy = windy ? number((loiter_real)0.6) : 0;
        p.tolerance = bits() % 2 ? 0 : number((loiter_real)0.01);
        memset(&entry, 0, sizeof entry);
        const int status = loiter_fastest(&p, &entry);
        if (status < 0 || status > LOITER_BAD_RESPONSE) {
            fail("entry: no status");
        }
        for (int k = 0; status == LOITER_OK && k < 3; k++) {
            if (entry.pieces > 3 || !(entry.durations[k] >= 0) || !isfinite(entry.durations[k])) {
                fail("entry: a piece has no duration");
            }
        }
    }
}

static void law(int count) {
    static loiter_law law;
    int left = 0;
    loiter_real limit = 0, east = 0, north = 0;
    uint32_t time_us = 0;
    while (count > 0) {
        if (left == 0) {
            loiter_law_config config = loiter_law_defaults(18, 35, 90, LOITER_EITHER);
            loiter_real *const numbers[] = {&config.radius_m,        &config.airspeed_m_s,  &config.bank_limit_deg,
                                            &config.roll_time_s,     &config.roll_rate_deg_s, &config.delay_s,
                                            &config.wind_east_m_s,   &config.wind_north_m_s, &config.reserve,
                                            &config.smoothing_s,     &config.gain};
            for (int k = (int)(bits() % 4); k > 0; k--) {
                loiter_real *const one = numbers[bits() % 11];
                *one = bits() % 2 ? number(100) : *one * 2 * uniform();
            }
            config.side = bits() % 32 ? (int)(bits() % 3) - 1 : (int)bits();
            const int status = loiter_law_begin(&law, &config);
            if (status < 0 || status > LOITER_BAD_RESPONSE) {
                fail("law: no status");
            }
            count--;
            if (status != LOITER_OK) {
                continue;
            }
            limit = config.bank_limit_deg;
            left = 1 + (int)(bits() % 300);
            east = number(500);
            north = number(500);
        }
        loiter_measurement m = {time_us, east, north, 200 * uniform(), 20 * uniform(), 10 * uniform(), 10 * uniform(), 18};
        loiter_real *const numbers[] = {&m.east_m,  &m.north_m, &m.heading_deg, &m.bank_deg,
                                        &m.velocity_east_m_s, &m.velocity_north_m_s, &m.airspeed_m_s};
        loiter_real dt = (loiter_real)0.02;
        loiter_command command;
        if (bits() % 8 == 0) {
            *numbers[bits() % 7] = number(1000);
        }
        if (bits() % 64 == 0) {
            dt = number(2);
        }
        time_us += bits() % 64 ? 20000u : (uint32_t)bits();
        east += (loiter_real)0.3;
        const int status = loiter_law_step(&law, &m, dt, &command);
        if (status != LOITER_OK && status != LOITER_BAD_STEP) {
            fail("step: no status");
        }
        if (status == LOITER_OK && !(fabs((double)command.bank_deg) <= (double)limit)) {
            fprintf(stderr, "bank %g of %g, phase %d\n", (double)command.bank_deg, (double)limit, command.phase);
            fail("step: a bank beyond the limit");
        }
        count--;
        left--;
    }
}

int main(int count, char **arguments) {
    if (count != 4) {
        fail("three numbers are needed");
    }
    entries(atoi(arguments[1]), 0);
    entries(atoi(arguments[2]), 1);
    law(atoi(arguments[3]));
    return 0;
}
