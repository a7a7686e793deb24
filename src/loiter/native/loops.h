/* The inner loops of loops.c, under the names for one kind of processors. */
#ifndef LOITER_LOOPS_H
#define LOITER_LOOPS_H

#include <stddef.h>

#define LOITER_JOINED(name, level) loiter_##name##_##level
#define LOITER_EXPANDED(name, level) LOITER_JOINED(name, level)
#define LOITER_NAMED(name) LOITER_EXPANDED(name, LOITER_LEVEL)

/* As PyUFuncGenericFunction: pointers to the operands, the number of states, the strides in bytes. */
typedef void loiter_loop(char **, const ptrdiff_t *, const ptrdiff_t *, void *);

#define LOITER_LOOPS(level) \
    extern loiter_loop loiter_min_time_##level, loiter_control_##level, loiter_reduce_##level, loiter_solve_##level

LOITER_LOOPS(any);
LOITER_LOOPS(v2);
LOITER_LOOPS(v3);
LOITER_LOOPS(v4);

#endif
