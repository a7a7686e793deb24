/* The loop of `min_time` for R = 1, in a file of its own: it has more live numbers than registers, so gcc takes a tenth
 * less time if it orders instructions with an eye to that before it assigns registers. The other loops take longer so. */

/* Without sharing expressions between branches, as in loops.c. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-tree-pre", "schedule-insns", "sched-pressure")
#endif

#include "loops.h"
#include "still_air_loops.h"

void LOITER_NAMED(tight_times)(const double *restrict x, const double *restrict y, double *restrict time, int count) {
    for (int i = 0; i < count; i++) {
        const double T = least_time(x[i], fabs(y[i]), 1.0, SIDE_CW, 0.0);
        time[i] = is_solvable(x[i], y[i], 1.0, 0.0) ? T : NAN;
    }
}
