#if defined(__GNUC__) || defined(__clang__)
#define LOITER_ALWAYS_INLINE __attribute__((always_inline))
#else
#define LOITER_ALWAYS_INLINE
#endif

/* What Python has and C has not: the first of two that tie, and quotients rounded down. */
static inline real min_real(real a, real b) { return b < a ? b : a; }
static inline real max_real(real a, real b) { return b > a ? b : a; }
static inline integer min_integer(integer a, integer b) { return b < a ? b : a; }
static inline integer max_integer(integer a, integer b) { return b > a ? b : a; }

static inline integer shift_left(integer a, integer bits) { return (integer)((unsigned_integer)a << bits); }

static inline integer integer_quotient(integer a, integer b) {
    const integer quotient = a / b;
    return quotient * b != a && (a < 0) != (b < 0) ? quotient - 1 : quotient;
}

static inline integer integer_modulo(integer a, integer b) { return a - integer_quotient(a, b) * b; }

static inline real real_modulo(real a, real b) {
    const real rest = fmod(a, b);
    if (rest == 0.0) {
        return copysign(0.0, b);
    }
    return (rest < 0.0) != (b < 0.0) ? rest + b : rest;
}

/* A real number as an integer; what is too large for 32 bits, or nan, becomes the largest or least of them. */
static inline integer integer_of(real a) {
    return a >= 2147483647.0 ? 2147483647 : a > -2147483647.0 ? (integer)a : -2147483647;
}

