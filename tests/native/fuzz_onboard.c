/* Makes calls of the C for autopilots from bytes: nothing may trap, each call has a status, a search in parts gives the
 * bits of a whole one, and a bank is within its limit.
 *
 * libFuzzer gives the bytes, where FUZZED is what is called: entry, search, law or settings (`python -m native.fuzz`). Where
 * AT_RANDOM is defined a generator does; the arguments are what is called, and how many inputs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "loiter_identification.h"

static const uint8_t *next_byte;
static size_t bytes_left;

static unsigned byte(void) {
    if (bytes_left == 0) {
        return 0;
    }
    bytes_left--;
    return *next_byte++;
}

static int integer(void) {
    const unsigned low = byte(), high = byte();
    return (int)(low | high << 8) - 32768;
}

/* A number of some size, a special number, or any pattern of bits. */
static loiter_real number(loiter_real size) {
    static const double special[] = {0.0,   -0.0,  1.0,   -1.0,     2.0,       5e-324, 1e-40,
                                     1e-30, 1e-20, 1e-9,  16777216, 8388608.0, 1e18,   1e30,
                                     3e38,  1e300, 180.0, INFINITY, -INFINITY, NAN,    0.5};
    const unsigned kind = byte();
    loiter_real value;
    if (kind < 224) {
        return size * (loiter_real)integer() / 32768;
    }
    if (kind < 248) {
        const double chosen = special[byte() % (sizeof special / sizeof *special)];
        return fabs(chosen) > 3e38 && isfinite(chosen) && sizeof value == 4 ? (loiter_real)3e38 : (loiter_real)chosen;
    }
    uint8_t bits[sizeof value];
    for (size_t i = 0; i < sizeof bits; i++) {
        bits[i] = (uint8_t)byte();
    }
    memcpy(&value, bits, sizeof value);
    return value;
}

static int side(void) {
    const unsigned kind = byte();
    return kind < 240 ? (int)(kind % 3) - 1 : integer();
}

static void fail(const char *what) {
    fprintf(stderr, "%s\n", what);
    abort();
}

static loiter_problem problem(void) {
    loiter_problem p;
    const double heading = 3.2 * integer() / 32768;
    const unsigned kind = byte();
    p.x = number(8);
    p.y = number(8);
    p.c = kind & 15 ? (loiter_real)cos(heading) : number(1);
    p.s = kind & 15 ? (loiter_real)sin(heading) : number(1);
    p.radius = kind & 16 ? number(8) : (loiter_real)3 + 2 * (loiter_real)integer() / 32768;
    p.side = side();
    p.wx = kind & 96 ? number((loiter_real)0.7) : 0;
    p.wy = kind & 96 ? number((loiter_real)0.7) : 0;
    p.tolerance = kind & 128 ? number((loiter_real)0.01) : 0;
    return p;
}

static void check_entry(int status, const loiter_entry *entry) {
    if (status < 0 || status > LOITER_BAD_RESPONSE) {
        fail("entry: no status");
    }
    for (int k = 0; status == LOITER_OK && k < 3; k++) {
        if (entry->pieces > 3 || !(entry->durations[k] >= 0) || !isfinite(entry->durations[k])) {
            fail("entry: a piece has no duration");
        }
    }
}

static void entry(void) {
    const loiter_problem p = problem();
    loiter_entry found;
    memset(&found, 0, sizeof found);
    check_entry(loiter_fastest(&p, &found), &found);
}

static void search(void) {
    const loiter_problem p = problem();
    loiter_search one, copy;
    loiter_entry found, whole;
    memset(&found, 0, sizeof found);
    memset(&whole, 0, sizeof whole);
    int status = loiter_search_begin(&one, &p);
    if (status != loiter_search_step(&one, 0, &found) && status != LOITER_OK) {
        fail("search: another status than at its beginning");
    }
    do {
        copy = one;
        status = loiter_search_step(&copy, integer() % 64, &found);
        one = copy;
    } while (status == LOITER_SEARCHING && bytes_left > 0);
    if (status == LOITER_SEARCHING) {
        status = loiter_search_step(&one, 1 << 30, &found);
    }
    check_entry(status, &found);
    if (loiter_fastest(&p, &whole) != status || memcmp(&found, &whole, sizeof found) != 0) {
        fail("search: another answer than a whole one");
    }
}

/* Times may be nan without data alone. */
static void check_command(const loiter_command *command, loiter_real limit_deg) {
    if (!(fabs((double)command->bank_deg) <= (double)limit_deg)) {
        fail("step: a bank beyond the limit");
    }
    if (!isfinite(command->turn_rate_deg_s)) {
        fail("step: a turn rate that is no number");
    }
    if (command->phase != LOITER_NO_DATA && (!(command->time_to_join_s >= 0) || !(command->next_in_s >= 0))) {
        fail("step: a time that is no number");
    }
}

/* A law, with a vehicle that flies as it is commanded but for what the bytes say. */
static void law(void) {
    static loiter_law flown;
    static loiter_identification known;
    loiter_law_config config = loiter_law_defaults(18, 35, 90, side());
    loiter_real *const configured[] = {&config.radius_m,      &config.airspeed_m_s,    &config.bank_limit_deg,
                                       &config.roll_time_s,   &config.roll_rate_deg_s, &config.roll_slew_deg_s,
                                       &config.delay_s,
                                       &config.wind_east_m_s, &config.wind_north_m_s,  &config.reserve,
                                       &config.smoothing_s,   &config.gain};
    for (unsigned k = byte() % 4; k > 0; k--) {
        loiter_real *const one = configured[byte() % 12];
        *one = byte() % 2 ? number(100) : *one * 2 * (loiter_real)byte() / 256;
    }
    config.search_steps = byte() % 2 ? integer() % 32 : 0;
    loiter_real wind_east = 0, wind_north = 0;
    if (byte() % 2) {
        config.wind_east_m_s = wind_east = number(12);
        config.wind_north_m_s = wind_north = number(12);
    }
    const int begun = loiter_law_begin(&flown, &config);
    if (begun < 0 || begun > LOITER_BAD_RESPONSE) {
        fail("law: no status");
    }
    if (begun != LOITER_OK) {
        return;
    }
    const int is_identified = byte() % 2;
    if (is_identified) {
        loiter_identification_begin(&known, &flown, byte() % 2);
    }
    loiter_real east = number(500), north = number(500), heading_deg = 180 + number(180), bank_deg = 0;
    uint32_t time_us = 0;
    for (int steps = 0; steps < 300 && bytes_left > 0; steps++) {
        const unsigned event = byte();
        const loiter_real c = (loiter_real)cos(heading_deg * 0.01745), s = (loiter_real)sin(heading_deg * 0.01745);
        loiter_real dt = (loiter_real)0.01 * (loiter_real)(1 + event % 32);
        loiter_measurement m = {time_us, east, north, heading_deg, bank_deg, 18 * s + wind_east, 18 * c + wind_north, 18};
        loiter_real *const measured[] = {&m.east_m,            &m.north_m,           &m.heading_deg, &m.bank_deg,
                                         &m.velocity_east_m_s, &m.velocity_north_m_s, &m.airspeed_m_s};
        const loiter_real flown_s = dt;
        if (event >= 192 && event < 224) {
            *measured[byte() % 7] = number(1000);
        } else if (event >= 224 && event < 240) {
            dt = number(2);
        } else if (event >= 240) {
            time_us += (uint32_t)integer() * 65536u + (uint32_t)integer();
        }
        loiter_command command;
        const int status = is_identified ? loiter_law_step_identified(&flown, &known, &m, dt, &command)
                                         : loiter_law_step(&flown, &m, dt, &command);
        if (status != LOITER_OK && status != LOITER_BAD_STEP) {
            fail("step: no status");
        }
        if (status != LOITER_OK) {
            continue;
        }
        check_command(&command, config.bank_limit_deg);
        bank_deg = command.bank_deg;
        heading_deg += 31 * (loiter_real)tan(bank_deg * 0.01745) * flown_s;
        heading_deg -= 360 * (loiter_real)floor(heading_deg / 360);
        east += m.velocity_east_m_s * flown_s;
        north += m.velocity_north_m_s * flown_s;
        if (!isfinite(east) || !isfinite(north) || !isfinite(heading_deg)) {
            east = north = heading_deg = 0;
        }
        time_us += (uint32_t)(flown_s * 1000000);
    }
}

/* Three settings with extreme values, those of the roll every other time, and a flight of 12 s as commanded. */
static void settings(void) {
    static const double extreme[] = {0.0,  5e-324, 1e-320, 1e-310, 1e-300, 1e-160, 1e-45, 1e-40, 1e-37, 1e-20, 1e-12,
                                     1e-9, 1e-6,   1e-3,   0.1,    1.0,    5.0,    60.0,  89.0,  89.9,  89.9999, 90.0,
                                     1e3,  1e4,    1e6,    1e9,    1e18,   3e38,   1e100, 1e300, INFINITY, NAN, -1.0};
    static loiter_law flown;
    static loiter_identification known;
    loiter_law_config config = loiter_law_defaults(18, 35, 90, (int)(byte() % 3) - 1);
    loiter_real *const configured[] = {&config.roll_time_s,  &config.roll_rate_deg_s, &config.roll_slew_deg_s,
                                       &config.radius_m,     &config.airspeed_m_s,    &config.bank_limit_deg,
                                       &config.delay_s,      &config.wind_east_m_s,   &config.wind_north_m_s,
                                       &config.reserve,      &config.smoothing_s,     &config.gain};
    const unsigned is_roll = byte() % 2;
    config.search_steps = 12;
    int begun = LOITER_BAD_RESPONSE;
    for (unsigned k = 0; k < 3; k++) {
        loiter_real *const one = configured[is_roll ? k : byte() % 12];
        const loiter_real before = *one;
        const double value = extreme[byte() % (sizeof extreme / sizeof *extreme)];
        *one = fabs(value) > 3e38 && isfinite(value) && sizeof before == 4 ? (loiter_real)3e38 : (loiter_real)value;
        begun = loiter_law_begin(&flown, &config);
        if (begun < 0 || begun > LOITER_BAD_RESPONSE) {
            fail("settings: no status");
        }
        *one = begun == LOITER_OK ? *one : before;
    }
    if (loiter_law_begin(&flown, &config) != LOITER_OK) {
        fail("settings: refused");
    }
    const int is_identified = byte() % 2;
    if (is_identified) {
        loiter_identification_begin(&known, &flown, byte() % 2);
    }
    const double speed = (double)config.airspeed_m_s, rad = 0.017453292519943295, dt_s = 0.08;
    double east = 400.0 * integer() / 32768, north = 400.0 * integer() / 32768, heading = 180.0 * integer() / 32768, bank = 0;
    for (uint32_t step = 0; step < 150; step++) {
        const double velocity_east = speed * sin(heading * rad) + (double)config.wind_east_m_s;
        const double velocity_north = speed * cos(heading * rad) + (double)config.wind_north_m_s;
        const loiter_measurement m = {step * 80000u,     (loiter_real)east, (loiter_real)north, (loiter_real)heading,
                                      (loiter_real)bank, (loiter_real)velocity_east, (loiter_real)velocity_north,
                                      (loiter_real)speed};
        loiter_command command;
        const int status = is_identified ? loiter_law_step_identified(&flown, &known, &m, (loiter_real)dt_s, &command)
                                         : loiter_law_step(&flown, &m, (loiter_real)dt_s, &command);
        if (status != LOITER_OK) {
            fail("settings: no step");
        }
        check_command(&command, config.bank_limit_deg);
        bank = (double)command.bank_deg;
        heading += (double)command.turn_rate_deg_s * dt_s;
        heading -= 360 * floor(heading / 360);
        east += velocity_east * dt_s;
        north += velocity_north * dt_s;
    }
}

static void call(void (*one)(void), const uint8_t *data, size_t size) {
    next_byte = data;
    bytes_left = size;
    one();
}

#ifndef AT_RANDOM
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    call(FUZZED, data, size);
    return 0;
}
#else
int main(int count, char **arguments) {
    uint64_t seed = UINT64_C(88172645463325252);
    uint8_t bytes[512];
    if (count != 3) {
        fail("what is called, and a number, are needed");
    }
    void (*const called)(void) =
        strcmp(arguments[1], "entry") == 0      ? entry
        : strcmp(arguments[1], "search") == 0   ? search
        : strcmp(arguments[1], "settings") == 0 ? settings
                                                : law;
    for (long left = atol(arguments[2]); left > 0; left--) {
        for (size_t i = 0; i < sizeof bytes; i++) {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            bytes[i] = (uint8_t)(seed >> 32);
        }
        call(called, bytes, sizeof bytes);
    }
    return 0;
}
#endif
