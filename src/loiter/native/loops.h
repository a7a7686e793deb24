/* The inner loops of loops.c and tight_loop.c, under the names for one kind of processors. */
#ifndef LOITER_LOOPS_H
#define LOITER_LOOPS_H

#include <stddef.h>

#define LOITER_JOINED(name, level) loiter_##name##_##level
#define LOITER_EXPANDED(name, level) LOITER_JOINED(name, level)
#define LOITER_NAMED(name) LOITER_EXPANDED(name, LOITER_LEVEL)

/* As PyUFuncGenericFunction: pointers to the operands, the number of states, the strides in bytes. */
typedef void loiter_loop(char **, const ptrdiff_t *, const ptrdiff_t *, void *);

/* T for R = 1, *either*, no tolerance: the compiler precomputes whatever depends only on these. */
typedef void loiter_tight_loop(const double *x, const double *y, double *time, int count);

#define LOITER_LOOPS(level)                                                                                        \
    extern loiter_loop loiter_min_time_##level, loiter_control_##level, loiter_reduce_##level, loiter_solve_##level; \
    extern loiter_tight_loop loiter_tight_times_##level

LOITER_LOOPS(any);
LOITER_LOOPS(v2);
LOITER_LOOPS(v3);
LOITER_LOOPS(v4);

#endif
