/* Calls every function of the library with random and special numbers: nothing may trap, and each call has a status.
 *
 * Arguments: the number of states in still air and of problems in wind. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "loiter.h"
#include "loops.h"
#include "wind_loops.h"

static unsigned long long seed = 88172645463325252ULL;

static unsigned long long bits(void) {
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return seed;
}

static double uniform(void) { return (double)(bits() >> 11) / 9007199254740992.0; }

/* Numbers near 1, special numbers, or any pattern of bits. */
static double number(void) {
    static const double special[] = {0.0,    -0.0,  1.0,   -1.0, 2.0,      3.0,       5e-324, 2.2e-308, 1e-160,
                                     1e-9,   1e15,  4e15,  9e15, 1e300,    INFINITY,  -INFINITY, NAN,   0.5};
    const unsigned long long kind = bits() % 8;
    if (kind < 5) {
        return 8.0 * uniform() - 4.0;
    }
    if (kind < 7) {
        return special[bits() % (sizeof special / sizeof *special)];
    }
    const unsigned long long any = bits();
    double value;
    memcpy(&value, &any, sizeof value);
    return value;
}

static void fail(const char *what) {
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static void still_air(int count) {
    for (int i = 0; i < count; i++) {
        const double x = number(), y = number(), R = bits() % 4 ? fabs(number()) + 1.0 : number();
        const double tolerance = bits() % 2 ? 0.0 : number();
        const int side = (int)(bits() % 3) - 1;
        loiter_entry entry;
        const int status = loiter_optimum(x, y, R, side, tolerance, &entry);
        const double time = loiter_least_time(x, y, R, side, tolerance);
        if (status < 0 || status > 13 || (status != 0) != (isnan(time) != 0)) {
            fail("still air: status and time do not agree");
        }
        if (status == 0 && !(loiter_miss(x, y, R, &entry) >= 0.0)) {
            fail("still air: the miss is no number");
        }
    }
}

static void wind(int count) {
    static loiter_wind_entry entries[LOITER_SAMPLES];
    for (int i = 0; i < count; i++) {
        const double heading = 6.3 * uniform(), mild = bits() % 4 ? 0.4 : 4.0;
        loiter_wind_problem p = {number(), number(), cos(heading), sin(heading), fabs(number()) + 2.0,
                                 (int)(bits() % 3) - 1, 0.1 * mild * number(), 0.1 * mild * number(),
                                 bits() % 2 ? 0.0 : fabs(number())};
        const loiter_wind_entry entry = loiter_fastest_in_wind(&p);
        if (entry.status < 0 || entry.status > 13 || (entry.status != 0) != (isnan(entry.t1) != 0)) {
            fail("wind: status and time do not agree");
        }
        if (entry.status == 0 && p.side != 0 && i % 16 == 0) {
            loiter_local_minima(&p, entries);
        }
    }
}

enum { ROWS = 1000 };

static double numbers[9][ROWS], floats[4][ROWS], durations[ROWS][3];
static signed char codes[3][ROWS];

static void loops(int count) {
    const ptrdiff_t d = sizeof(double), dimensions[] = {ROWS, 3};
    char *one[] = {(char *)numbers[0], (char *)numbers[1], (char *)numbers[2], (char *)numbers[3],
                   (char *)numbers[4], (char *)floats[0]};
    const ptrdiff_t one_steps[] = {d, d, d, d, d, d};
    char *all[] = {(char *)numbers[0], (char *)numbers[1], (char *)numbers[2], (char *)numbers[3],
                   (char *)numbers[4], (char *)numbers[5], (char *)floats[0],  (char *)codes[0],
                   (char *)durations,  (char *)codes[1],   (char *)codes[2],   (char *)floats[1]};
    const ptrdiff_t all_steps[] = {d, d, d, d, d, 0, d, 1, 3 * d, 1, 1, d, d, d};
    for (int start = 0; start < count; start += ROWS) {
        for (int i = 0; i < ROWS; i++) {
            for (int k = 0; k < 5; k++) {
                numbers[k][i] = number();
            }
            numbers[3][i] = (double)(int)(bits() % 3) - 1.0;
        }
        loiter_min_time_any(one, dimensions, one_steps, NULL);
        loiter_control_any(one, dimensions, one_steps, NULL);
        loiter_solve_any(all, dimensions, all_steps, NULL);
        for (int i = 0; i < ROWS; i++) {
            if ((codes[1][i] != 0) != (isnan(floats[0][i]) != 0)) {
                fail("loops: status and time do not agree");
            }
        }
    }
}

int main(int count, char **arguments) {
    if (count != 3) {
        fail("two numbers are needed");
    }
    still_air(atoi(arguments[1]));
    loops(atoi(arguments[1]));
    wind(atoi(arguments[2]));
    return 0;
}
