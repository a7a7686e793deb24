/* The inner loops of NumPy's ufuncs that solve one state at a time, by loiter.h: those in wind, and the gradient. */
#include "wind_loops.h"

#include <fenv.h>
#include <stddef.h>
#include <stdint.h>

#include "loiter.h"

/* The operands by number: those of a problem, and the results. `solve_in_wind` has one more input, only for the number
 * 3 of durations; after the strides of all operands come those along the axis of length 3, of that input and of the
 * durations. */
enum { X, Y, COSINE, SINE, RADIUS, SIDE, WIND_X, WIND_Y, TOLERANCE, MIN_TIME };
enum { TIME = 10, WORD, DURATIONS, STATUS, SIDE_HELD, AZIMUTH, MISS, NEXT_DURATION = 18 };

static double number_at(char **args, const ptrdiff_t *steps, int operand, ptrdiff_t i) {
    return *(const double *)(args[operand] + i * steps[operand]);
}

static void put_number(char **args, const ptrdiff_t *steps, int operand, ptrdiff_t i, double value) {
    *(double *)(args[operand] + i * steps[operand]) = value;
}

static void put_code(char **args, const ptrdiff_t *steps, int operand, ptrdiff_t i, int code) {
    *(int8_t *)(args[operand] + i * steps[operand]) = (int8_t)code;
}

static loiter_wind_entry solved(char **args, const ptrdiff_t *steps, ptrdiff_t i) {
    const double side = number_at(args, steps, SIDE, i);
    const loiter_wind_problem problem = {
        .x = number_at(args, steps, X, i),
        .y = number_at(args, steps, Y, i),
        .c = number_at(args, steps, COSINE, i),
        .s = number_at(args, steps, SINE, i),
        .R = number_at(args, steps, RADIUS, i),
        .side = side > 0.0 ? 1 : side < 0.0 ? -1 : 0,
        .wx = number_at(args, steps, WIND_X, i),
        .wy = number_at(args, steps, WIND_Y, i),
        .tolerance = number_at(args, steps, TOLERANCE, i),
    };
    return loiter_fastest_in_wind(&problem);
}

/* Operands: x, y, radius and side, and then the three derivatives. */
void loiter_gradients(char **args, const ptrdiff_t *dimensions, const ptrdiff_t *steps, void *data) {
    (void)data;
    for (ptrdiff_t i = 0; i < dimensions[0]; i++) {
        const double side = number_at(args, steps, 3, i);
        double gradient[3];
        loiter_gradient(number_at(args, steps, 0, i), number_at(args, steps, 1, i), number_at(args, steps, 2, i),
                        side > 0.0 ? 1 : side < 0.0 ? -1 : 0, gradient);
        for (int k = 0; k < 3; k++) {
            put_number(args, steps, 4 + k, i, gradient[k]);
        }
    }
    feclearexcept(FE_ALL_EXCEPT);
}

void loiter_min_time_in_wind(char **args, const ptrdiff_t *dimensions, const ptrdiff_t *steps, void *data) {
    (void)data;
    for (ptrdiff_t i = 0; i < dimensions[0]; i++) {
        const loiter_wind_entry entry = solved(args, steps, i);
        put_number(args, steps, MIN_TIME, i, entry.t1 + entry.t2 + entry.t3);
    }
    feclearexcept(FE_ALL_EXCEPT);
}

void loiter_solve_in_wind(char **args, const ptrdiff_t *dimensions, const ptrdiff_t *steps, void *data) {
    const ptrdiff_t next = steps[NEXT_DURATION];
    (void)data;
    for (ptrdiff_t i = 0; i < dimensions[0]; i++) {
        const loiter_wind_entry entry = solved(args, steps, i);
        char *row = args[DURATIONS] + i * steps[DURATIONS];
        put_number(args, steps, TIME, i, entry.t1 + entry.t2 + entry.t3);
        put_code(args, steps, WORD, i, entry.word);
        *(double *)row = entry.t1;
        *(double *)(row + next) = entry.t2;
        *(double *)(row + 2 * next) = entry.t3;
        put_code(args, steps, STATUS, i, entry.status);
        put_code(args, steps, SIDE_HELD, i, entry.side);
        put_number(args, steps, AZIMUTH, i, entry.azimuth);
        put_number(args, steps, MISS, i, entry.miss);
    }
    feclearexcept(FE_ALL_EXCEPT);
}

/* Operands: the word, x, y, cosine, sine, track and wind, and then the three durations. */
void loiter_paths_to_poses(char **args, const ptrdiff_t *dimensions, const ptrdiff_t *steps, void *data) {
    (void)data;
    for (ptrdiff_t i = 0; i < dimensions[0]; i++) {
        double in[8], durations[3];
        for (int k = 0; k < 8; k++) {
            in[k] = number_at(args, steps, k, i);
        }
        loiter_path_to_pose((int)in[0], in[1], in[2], in[3], in[4], in[5], in[6], in[7], durations);
        for (int k = 0; k < 3; k++) {
            put_number(args, steps, 8 + k, i, durations[k]);
        }
    }
    feclearexcept(FE_ALL_EXCEPT);
}
