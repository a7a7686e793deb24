/* The inner loops of NumPy's ufuncs, over the functions generated from the Python of the kernel.
 *
 * A loop copies a block of states into buffers on the stack, works on these with loops that the compiler vectorises,
 * and copies the results out: it allocates nothing, and its speed does not depend on the strides. The same file is
 * compiled for several kinds of processors; LOITER_LEVEL is a suffix of the names.
 */

/* gcc would share expressions between branches, and then vectorise nothing; clang has no such option. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-tree-pre")
#endif

#include "loops.h"

#include <fenv.h>
#include <stddef.h>

#include "still_air_loops.h"

/* Each loop is compiled by itself, so that none is compiled differently for what stands beside it. */
#if defined(__GNUC__) || defined(__clang__)
#define NOINLINE __attribute__((noinline))
#else
#define NOINLINE
#endif

/* States; their buffers of 2 KiB each stay in the first-level cache. */
#define BLOCK 256

typedef struct {
    double x[BLOCK], y[BLOCK], R[BLOCK], side[BLOCK], tolerance[BLOCK];
} StateBlock;

typedef struct {
    double t1[BLOCK], t2[BLOCK], t3[BLOCK];
    int32_t side[BLOCK], word[BLOCK];
} EntryBlock;

/* The operands of `min_time`, `control` and `solve` by number: five inputs, and the results of each. `solve` has a
 * sixth input, only for the number 3 of durations; after the strides of all operands come those along the axis of
 * length 3, of the sixth input and of the durations. */
enum { X, Y, RADIUS, SIDE, TOLERANCE, MIN_TIME, CONTROL = MIN_TIME };
enum { TIME = 6, WORD, DURATIONS, STATUS, SIDE_HELD, MISS, NEXT_DURATION = 13 };

static void load(double *buffer, char **args, const ptrdiff_t *steps, int operand, ptrdiff_t start, int count) {
    const char *source = args[operand] + start * steps[operand];
    const ptrdiff_t step = steps[operand];
    if (step == sizeof(double)) {
        for (int i = 0; i < count; i++) {
            buffer[i] = ((const double *)source)[i];
        }
    } else {
        for (int i = 0; i < count; i++) {
            buffer[i] = *(const double *)(source + i * step);
        }
    }
}

static void store(const double *buffer, char **args, const ptrdiff_t *steps, int operand, ptrdiff_t start, int count) {
    char *target = args[operand] + start * steps[operand];
    const ptrdiff_t step = steps[operand];
    if (step == sizeof(double)) {
        for (int i = 0; i < count; i++) {
            ((double *)target)[i] = buffer[i];
        }
    } else {
        for (int i = 0; i < count; i++) {
            *(double *)(target + i * step) = buffer[i];
        }
    }
}

static void store_codes(const int32_t *codes, char **args, const ptrdiff_t *steps, int operand, ptrdiff_t start,
                        int count) {
    char *target = args[operand] + start * steps[operand];
    const ptrdiff_t step = steps[operand];
    for (int i = 0; i < count; i++) {
        *(int8_t *)(target + i * step) = (int8_t)codes[i];
    }
}

/* Whether an operand is one number for all states, and equals this value. */
static bool is_constant(char **args, const ptrdiff_t *steps, int operand, double value) {
    return steps[operand] == 0 && *(const double *)args[operand] == value;
}

/* Whether a tolerance may make the far side of *either* the faster one. */
static bool tries_both_sides(char **args, const ptrdiff_t *steps) {
    return !is_constant(args, steps, TOLERANCE, 0.0) && !is_constant(args, steps, SIDE, SIDE_CW) &&
           !is_constant(args, steps, SIDE, SIDE_CCW);
}

static void load_states(StateBlock *states, char **args, const ptrdiff_t *steps, ptrdiff_t start, int count) {
    load(states->x, args, steps, X, start, count);
    load(states->y, args, steps, Y, start, count);
    load(states->R, args, steps, RADIUS, start, count);
    load(states->side, args, steps, SIDE, start, count);
    load(states->tolerance, args, steps, TOLERANCE, start, count);
}

/* The side of each state; for *either* the near one or, where `far` and there is a tolerance, the far one. */
static void choose_sides(const StateBlock *states, int32_t *chosen, bool far, int count) {
    for (int i = 0; i < count; i++) {
        const int32_t side = states->side[i] > 0.0 ? 1 : states->side[i] < 0.0 ? -1 : 0;
        const int32_t near = side_or_near(states->y[i], side);
        chosen[i] = far && side == SIDE_EITHER && states->tolerance[i] > 0.0 ? -near : near;
    }
}

/* The number of states without a tolerance. */
static int exact_count(const StateBlock *states, int count) {
    int exact = 0;
    for (int i = 0; i < count; i++) {
        exact += states->tolerance[i] == 0.0;
    }
    return exact;
}

static inline LOITER_ALWAYS_INLINE void all_times(const StateBlock *restrict states, const int32_t *restrict chosen, double *restrict time,
                                                  bool exact, int count) {
    for (int i = 0; i < count; i++) {
        const double x = states->x[i], y = states->y[i], R = states->R[i];
        const double tolerance = exact ? 0.0 : states->tolerance[i];
        const double T = least_time(x, y, rounded_radius(R), chosen[i], tolerance);
        time[i] = is_solvable(x, y, R, tolerance) ? T : NAN;
    }
}

static NOINLINE void times(const StateBlock *restrict states, const int32_t *restrict chosen, double *restrict time, int count) {
    all_times(states, chosen, time, false, count);
}

/* `times` without a tolerance: the compiler leaves out the words that compete only beside a circle. */
static NOINLINE void exact_times(const StateBlock *restrict states, const int32_t *restrict chosen, double *restrict time, int count) {
    all_times(states, chosen, time, true, count);
}

void LOITER_NAMED(min_time)(char **args, const ptrdiff_t *dimensions, const ptrdiff_t *steps, void *data) {
    StateBlock states;
    double time[BLOCK], other[BLOCK];
    int32_t chosen[BLOCK];
    const bool exact = is_constant(args, steps, TOLERANCE, 0.0), both = tries_both_sides(args, steps);
    const bool tight = exact && is_constant(args, steps, RADIUS, 1.0) && is_constant(args, steps, SIDE, SIDE_EITHER);
    const ptrdiff_t n = dimensions[0];
    (void)data;
    for (ptrdiff_t start = 0; start < n; start += BLOCK) {
        const int count = (int)(n - start < BLOCK ? n - start : BLOCK);
        if (tight) {
            load(states.x, args, steps, X, start, count);
            load(states.y, args, steps, Y, start, count);
            LOITER_NAMED(tight_times)(states.x, states.y, time, count);
        } else {
            load_states(&states, args, steps, start, count);
            choose_sides(&states, chosen, false, count);
            if (exact) {
                exact_times(&states, chosen, time, count);
            } else {
                times(&states, chosen, time, count);
            }
            if (both) {
                choose_sides(&states, chosen, true, count);
                times(&states, chosen, other, count);
                for (int i = 0; i < count; i++) {
                    time[i] = other[i] < time[i] ? other[i] : time[i];
                }
            }
        }
        store(time, args, steps, MIN_TIME, start, count);
    }
    feclearexcept(FE_ALL_EXCEPT);
}

/* The fastest extremals of a block of states. */
typedef struct {
    double first_cross[BLOCK], first_dot[BLOCK], straight[BLOCK], middle_cross[BLOCK], middle_dot[BLOCK];
    double last_cross[BLOCK], last_dot[BLOCK];
    int32_t word[BLOCK];
} ExtremalBlock;

/* In two loops: the compiler does not vectorise one loop of both. */
static inline LOITER_ALWAYS_INLINE void all_optima(const StateBlock *restrict states, EntryBlock *restrict entries, bool exact,
                                                   int count) {
    ExtremalBlock found;
    for (int i = 0; i < count; i++) {
        const double x = states->x[i], y = states->y[i], R = rounded_radius(states->R[i]);
        const double tolerance = arc_tolerance_of(x, y, R, exact ? 0.0 : states->tolerance[i]);
        const Extremal best = fastest(x, entries->side[i] * y, R, tolerance, exact).a1;
        found.word[i] = best.word;
        found.first_cross[i] = best.first.a0;
        found.first_dot[i] = best.first.a1;
        found.straight[i] = best.straight;
        found.middle_cross[i] = best.middle.a0;
        found.middle_dot[i] = best.middle.a1;
        found.last_cross[i] = best.last.a0;
        found.last_dot[i] = best.last.a1;
    }
    for (int i = 0; i < count; i++) {
        const real_2 first = {found.first_cross[i], found.first_dot[i]};
        const real_2 middle = {found.middle_cross[i], found.middle_dot[i]};
        const real_2 last = {found.last_cross[i], found.last_dot[i]};
        const Extremal best = {found.word[i], first, found.straight[i], middle, last};
        const double size = rounding(states->x[i], states->y[i], rounded_radius(states->R[i]));
        const Entry entry = flown_entry(best, size, entries->side[i]);
        entries->word[i] = entry.word;
        entries->t1[i] = entry.t1;
        entries->t2[i] = entry.t2;
        entries->t3[i] = entry.t3;
    }
}

/* The optima where there is a tolerance. */
static NOINLINE void tolerant_optima(const StateBlock *restrict states, EntryBlock *restrict entries, int count) {
    all_optima(states, entries, false, count);
}

/* The optima where there is no tolerance: the compiler leaves out the words that compete only beside a circle. */
static NOINLINE void exact_optima(const StateBlock *restrict states, EntryBlock *restrict entries, int count) {
    all_optima(states, entries, true, count);
}

/* The optimum of each state on the side in `entries`; both kinds where only some states have a tolerance. */
static void optima(const StateBlock *restrict states, EntryBlock *restrict entries, int count) {
    const int exact = exact_count(states, count);
    if (exact == 0) {
        tolerant_optima(states, entries, count);
        return;
    }
    if (exact == count) {
        exact_optima(states, entries, count);
        return;
    }
    EntryBlock tolerant;
    for (int i = 0; i < count; i++) {
        tolerant.side[i] = entries->side[i];
    }
    tolerant_optima(states, &tolerant, count);
    exact_optima(states, entries, count);
    for (int i = 0; i < count; i++) {
        if (states->tolerance[i] != 0.0) {
            entries->word[i] = tolerant.word[i];
            entries->t1[i] = tolerant.t1[i];
            entries->t2[i] = tolerant.t2[i];
            entries->t3[i] = tolerant.t3[i];
        }
    }
}

static inline LOITER_ALWAYS_INLINE Entry entry_of_state(const EntryBlock *entries, int i) {
    return (Entry){entries->side[i], entries->word[i], entries->t1[i], entries->t2[i], entries->t3[i]};
}

/* Keep the maneuvers of the other side where they are faster. */
static void keep_faster(const StateBlock *states, EntryBlock *entries, const EntryBlock *others, int count) {
    for (int i = 0; i < count; i++) {
        const double size = rounding(states->x[i], states->y[i], states->R[i]);
        const Entry other = entry_of_state(others, i), own = entry_of_state(entries, i);
        const bool better = is_faster(other, own, size);
        entries->side[i] = better ? other.side : own.side;
        entries->word[i] = better ? other.word : own.word;
        entries->t1[i] = better ? other.t1 : own.t1;
        entries->t2[i] = better ? other.t2 : own.t2;
        entries->t3[i] = better ? other.t3 : own.t3;
    }
}

/* Load a block of states and solve it, both sides of *either* where a tolerance requires it. */
static void load_and_solve(StateBlock *states, EntryBlock *entries, char **args, const ptrdiff_t *steps,
                           ptrdiff_t start, int count) {
    load_states(states, args, steps, start, count);
    choose_sides(states, entries->side, false, count);
    optima(states, entries, count);
    if (tries_both_sides(args, steps)) {
        EntryBlock others;
        choose_sides(states, others.side, true, count);
        optima(states, &others, count);
        keep_faster(states, entries, &others, count);
    }
}

void LOITER_NAMED(control)(char **args, const ptrdiff_t *dimensions, const ptrdiff_t *steps, void *data) {
    StateBlock states;
    EntryBlock entries;
    double u[BLOCK];
    const ptrdiff_t n = dimensions[0];
    (void)data;
    for (ptrdiff_t start = 0; start < n; start += BLOCK) {
        const int count = (int)(n - start < BLOCK ? n - start : BLOCK);
        load_and_solve(&states, &entries, args, steps, start, count);
        for (int i = 0; i < count; i++) {
            const double R = states.R[i];
            const double first = first_control(rounded_radius(R), entry_of_state(&entries, i));
            u[i] = is_solvable(states.x[i], states.y[i], R, states.tolerance[i]) ? first : NAN;
        }
        store(u, args, steps, CONTROL, start, count);
    }
    feclearexcept(FE_ALL_EXCEPT);
}

static NOINLINE void misses(const StateBlock *restrict states, const EntryBlock *restrict entries, double *restrict distance, int count) {
    for (int i = 0; i < count; i++) {
        distance[i] = miss(states->x[i], states->y[i], rounded_radius(states->R[i]), entry_of_state(entries, i));
    }
}

/* Set status and T; the results are nan and 0 where the status is not OK. */
static void check(const StateBlock *states, EntryBlock *entries, double *time, double *distance, int32_t *status,
                  int count) {
    for (int i = 0; i < count; i++) {
        status[i] = status_of(states->x[i], states->y[i], states->R[i], states->tolerance[i]);
        if (status[i] != STATUS_OK) {
            entries->t1[i] = entries->t2[i] = entries->t3[i] = distance[i] = NAN;
            entries->word[i] = entries->side[i] = 0;
        }
        time[i] = entries->t1[i] + entries->t2[i] + entries->t3[i];
    }
}

void LOITER_NAMED(solve)(char **args, const ptrdiff_t *dimensions, const ptrdiff_t *steps, void *data) {
    StateBlock states;
    EntryBlock entries;
    double time[BLOCK], distance[BLOCK];
    int32_t status[BLOCK];
    const ptrdiff_t n = dimensions[0], step = steps[DURATIONS], next = steps[NEXT_DURATION];
    (void)data;
    for (ptrdiff_t start = 0; start < n; start += BLOCK) {
        const int count = (int)(n - start < BLOCK ? n - start : BLOCK);
        load_and_solve(&states, &entries, args, steps, start, count);
        misses(&states, &entries, distance, count);
        check(&states, &entries, time, distance, status, count);
        store(time, args, steps, TIME, start, count);
        store_codes(entries.word, args, steps, WORD, start, count);
        for (int i = 0; i < count; i++) {
            char *row = args[DURATIONS] + (start + i) * step;
            *(double *)row = entries.t1[i];
            *(double *)(row + next) = entries.t2[i];
            *(double *)(row + 2 * next) = entries.t3[i];
        }
        store_codes(status, args, steps, STATUS, start, count);
        store_codes(entries.side, args, steps, SIDE_HELD, start, count);
        store(distance, args, steps, MISS, start, count);
    }
    feclearexcept(FE_ALL_EXCEPT);
}

void LOITER_NAMED(reduce)(char **args, const ptrdiff_t *dimensions, const ptrdiff_t *steps, void *data) {
    double x[BLOCK], y[BLOCK], c[BLOCK], s[BLOCK];
    const ptrdiff_t n = dimensions[0];
    (void)data;
    for (ptrdiff_t start = 0; start < n; start += BLOCK) {
        const int count = (int)(n - start < BLOCK ? n - start : BLOCK);
        load(x, args, steps, 0, start, count);
        load(y, args, steps, 1, start, count);
        load(c, args, steps, 2, start, count);
        load(s, args, steps, 3, start, count);
        for (int i = 0; i < count; i++) {
            const real_2 reduced = reduce(x[i], y[i], c[i], s[i]);
            x[i] = reduced.a0;
            y[i] = reduced.a1;
        }
        store(x, args, steps, 4, start, count);
        store(y, args, steps, 5, start, count);
    }
}
