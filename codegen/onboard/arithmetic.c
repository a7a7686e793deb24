#include <math.h>

typedef loiter_real real;
typedef loiter_integer integer;

/* Numbers and functions of the arithmetic; and structures, which C and C++ make in different ways. */
#ifdef LOITER_FLOAT
typedef uint32_t unsigned_integer;
#define REAL(number) number##f
@FLOAT_FUNCTIONS@
#else
typedef uint64_t unsigned_integer;
#define REAL(number) number
@DOUBLE_FUNCTIONS@
#endif
#define REAL_NAN ((real)NAN)
#define REAL_INFINITY ((real)INFINITY)
#ifdef __cplusplus
#define MAKE(type) type
#else
#define MAKE(type) (type)
#endif

/* Before functions that are not inlined, so that their memory on the stack does not add up. */
#if defined(__GNUC__)
#define APART __attribute__((noinline))
#else
#define APART
#endif

/* Whether a step may be so long, seconds. */
static inline bool is_step(real dt_s) {
    return dt_s > REAL(0.0) && dt_s <= (real)LOITER_LONGEST_STEP_S;
}
