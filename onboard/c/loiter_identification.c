/* The functions of loiter_identification.h, C99 and C++.
 *
 * Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
 *
 * SHA-256 of the source: 875b507c7117b08ac03bc4202585b8173c801cdbc58b758a94ae3d8669e97ce7
 */
#include "loiter_identification.h"

#include <math.h>

typedef loiter_real real;
typedef loiter_integer integer;

/* Numbers and functions of the arithmetic; and structures, which C and C++ make in different ways. */
#ifdef LOITER_FLOAT
typedef uint32_t unsigned_integer;
#define REAL(number) number##f
#define real_sqrt sqrtf
#define real_atan2 atan2f
#define real_sin sinf
#define real_cos cosf
#define real_tan tanf
#define real_acos acosf
#define real_atan atanf
#define real_exp expf
#define real_log logf
#define real_fabs fabsf
#define real_fmod fmodf
#define real_ceil ceilf
#define real_floor floorf
#define real_copysign copysignf
#define real_fma fmaf
#else
typedef uint64_t unsigned_integer;
#define REAL(number) number
#define real_sqrt sqrt
#define real_atan2 atan2
#define real_sin sin
#define real_cos cos
#define real_tan tan
#define real_acos acos
#define real_atan atan
#define real_exp exp
#define real_log log
#define real_fabs fabs
#define real_fmod fmod
#define real_ceil ceil
#define real_floor floor
#define real_copysign copysign
#define real_fma fma
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
    const real rest = real_fmod(a, b);
    if (rest == REAL(0.0)) {
        return real_copysign(REAL(0.0), b);
    }
    return (rest < REAL(0.0)) != (b < REAL(0.0)) ? rest + b : rest;
}

/* A real number as an integer; what is too large for 32 bits, or nan, becomes the largest or least of them. */
static inline integer integer_of(real a) {
    return a >= REAL(2147483647.0) ? 2147483647 : a > -REAL(2147483647.0) ? (integer)a : -2147483647;
}


typedef loiter_RollValues RollValues;

typedef loiter_VehicleEstimates VehicleEstimates;

typedef loiter_Unknown Unknown;

typedef loiter_ModelStep ModelStep;

typedef loiter_ModelStep_ring_8 ModelStep_ring_8;

static inline ModelStep_ring_8 ModelStep_ring_8_filled(ModelStep one) {
    ModelStep_ring_8 ring;
    for (int i = 0; i < 8; i++) {
        ring.at[i] = one;
    }
    return ring;
}

static inline ModelStep_ring_8 ModelStep_ring_8_with_last(ModelStep_ring_8 ring, ModelStep last) {
    ring.at[7] = last;
    return ring;
}

static inline ModelStep_ring_8 ModelStep_ring_8_appended(ModelStep_ring_8 ring, ModelStep last) {
    for (int i = 0; i < 7; i++) {
        ring.at[i] = ring.at[i + 1];
    }
    ring.at[7] = last;
    return ring;
}

static inline void ModelStep_ring_8_append(ModelStep_ring_8 *ring, ModelStep last) {
    for (int i = 0; i < 7; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[7] = last;
}

typedef loiter_real_ring_8 real_ring_8;

static inline real_ring_8 real_ring_8_filled(real one) {
    real_ring_8 ring;
    for (int i = 0; i < 8; i++) {
        ring.at[i] = one;
    }
    return ring;
}

static inline real_ring_8 real_ring_8_with_last(real_ring_8 ring, real last) {
    ring.at[7] = last;
    return ring;
}

static inline real_ring_8 real_ring_8_appended(real_ring_8 ring, real last) {
    for (int i = 0; i < 7; i++) {
        ring.at[i] = ring.at[i + 1];
    }
    ring.at[7] = last;
    return ring;
}

static inline void real_ring_8_append(real_ring_8 *ring, real last) {
    for (int i = 0; i < 7; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[7] = last;
}

typedef loiter_real_ring_6 real_ring_6;

static inline real_ring_6 real_ring_6_filled(real one) {
    real_ring_6 ring;
    for (int i = 0; i < 6; i++) {
        ring.at[i] = one;
    }
    return ring;
}

static inline real_ring_6 real_ring_6_with_last(real_ring_6 ring, real last) {
    ring.at[5] = last;
    return ring;
}

static inline real_ring_6 real_ring_6_appended(real_ring_6 ring, real last) {
    for (int i = 0; i < 5; i++) {
        ring.at[i] = ring.at[i + 1];
    }
    ring.at[5] = last;
    return ring;
}

static inline void real_ring_6_append(real_ring_6 *ring, real last) {
    for (int i = 0; i < 5; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[5] = last;
}

typedef loiter_real_ring_14 real_ring_14;

static inline real_ring_14 real_ring_14_filled(real one) {
    real_ring_14 ring;
    for (int i = 0; i < 14; i++) {
        ring.at[i] = one;
    }
    return ring;
}

static inline real_ring_14 real_ring_14_with_last(real_ring_14 ring, real last) {
    ring.at[13] = last;
    return ring;
}

static inline real_ring_14 real_ring_14_appended(real_ring_14 ring, real last) {
    for (int i = 0; i < 13; i++) {
        ring.at[i] = ring.at[i + 1];
    }
    ring.at[13] = last;
    return ring;
}

static inline void real_ring_14_append(real_ring_14 *ring, real last) {
    for (int i = 0; i < 13; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[13] = last;
}

typedef loiter_RollSettings RollSettings;

typedef loiter_IdentificationSettings IdentificationSettings;

typedef loiter_Sums Sums;

typedef loiter_Bank Bank;

/* A short step of a bank whose rate has a lag: its time, seconds, and the share of the present rate.
 *
 * `kept` is the share at the end of the step, `share` that on average in the change of bank.
 */
typedef struct { real time_s, kept, share; } RollStep;

typedef loiter_Clock Clock;

typedef loiter_Stamps Stamps;

typedef loiter_MeasuredBank MeasuredBank;

typedef loiter_Comparison Comparison;

typedef loiter_RollModel RollModel;

typedef loiter_RollModel_ring_6 RollModel_ring_6;

static inline RollModel_ring_6 RollModel_ring_6_filled(RollModel one) {
    RollModel_ring_6 ring;
    for (int i = 0; i < 6; i++) {
        ring.at[i] = one;
    }
    return ring;
}

static inline RollModel_ring_6 RollModel_ring_6_with_last(RollModel_ring_6 ring, RollModel last) {
    ring.at[5] = last;
    return ring;
}

static inline RollModel_ring_6 RollModel_ring_6_appended(RollModel_ring_6 ring, RollModel last) {
    for (int i = 0; i < 5; i++) {
        ring.at[i] = ring.at[i + 1];
    }
    ring.at[5] = last;
    return ring;
}

static inline void RollModel_ring_6_append(RollModel_ring_6 *ring, RollModel last) {
    for (int i = 0; i < 5; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[5] = last;
}

typedef loiter_RollModel_ring_6_ring_8 RollModel_ring_6_ring_8;

static inline RollModel_ring_6_ring_8 RollModel_ring_6_ring_8_filled(RollModel_ring_6 one) {
    RollModel_ring_6_ring_8 ring;
    for (int i = 0; i < 8; i++) {
        ring.at[i] = one;
    }
    return ring;
}

static inline RollModel_ring_6_ring_8 RollModel_ring_6_ring_8_with_last(RollModel_ring_6_ring_8 ring, RollModel_ring_6 last) {
    ring.at[7] = last;
    return ring;
}

static inline RollModel_ring_6_ring_8 RollModel_ring_6_ring_8_appended(RollModel_ring_6_ring_8 ring, RollModel_ring_6 last) {
    for (int i = 0; i < 7; i++) {
        ring.at[i] = ring.at[i + 1];
    }
    ring.at[7] = last;
    return ring;
}

static inline void RollModel_ring_6_ring_8_append(RollModel_ring_6_ring_8 *ring, RollModel_ring_6 last) {
    for (int i = 0; i < 7; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[7] = last;
}

typedef loiter_Models Models;

typedef loiter_real_ring_14_ring_6 real_ring_14_ring_6;

static inline real_ring_14_ring_6 real_ring_14_ring_6_filled(real_ring_14 one) {
    real_ring_14_ring_6 ring;
    for (int i = 0; i < 6; i++) {
        ring.at[i] = one;
    }
    return ring;
}

static inline real_ring_14_ring_6 real_ring_14_ring_6_with_last(real_ring_14_ring_6 ring, real_ring_14 last) {
    ring.at[5] = last;
    return ring;
}

static inline real_ring_14_ring_6 real_ring_14_ring_6_appended(real_ring_14_ring_6 ring, real_ring_14 last) {
    for (int i = 0; i < 5; i++) {
        ring.at[i] = ring.at[i + 1];
    }
    ring.at[5] = last;
    return ring;
}

static inline void real_ring_14_ring_6_append(real_ring_14_ring_6 *ring, real_ring_14 last) {
    for (int i = 0; i < 5; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[5] = last;
}

typedef loiter_KindWeights KindWeights;

typedef loiter_KindWeights_ring_8 KindWeights_ring_8;

static inline KindWeights_ring_8 KindWeights_ring_8_filled(KindWeights one) {
    KindWeights_ring_8 ring;
    for (int i = 0; i < 8; i++) {
        ring.at[i] = one;
    }
    return ring;
}

static inline KindWeights_ring_8 KindWeights_ring_8_with_last(KindWeights_ring_8 ring, KindWeights last) {
    ring.at[7] = last;
    return ring;
}

static inline KindWeights_ring_8 KindWeights_ring_8_appended(KindWeights_ring_8 ring, KindWeights last) {
    for (int i = 0; i < 7; i++) {
        ring.at[i] = ring.at[i + 1];
    }
    ring.at[7] = last;
    return ring;
}

static inline void KindWeights_ring_8_append(KindWeights_ring_8 *ring, KindWeights last) {
    for (int i = 0; i < 7; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[7] = last;
}

typedef loiter_RollEstimate RollEstimate;

typedef loiter_Weights Weights;

typedef loiter_RollMemory RollMemory;

typedef loiter_TurnSums TurnSums;

typedef loiter_SlowTurns SlowTurns;

typedef loiter_RatioFit RatioFit;

typedef loiter_HighPass HighPass;

typedef loiter_QuickTurns QuickTurns;

typedef loiter_CourseLead CourseLead;

typedef loiter_Turns Turns;

typedef loiter_AirErrors AirErrors;

typedef loiter_AirMeans AirMeans;

typedef loiter_WindChange WindChange;

typedef loiter_WindFit WindFit;

typedef loiter_Average Average;

typedef loiter_Airspeeds Airspeeds;

typedef loiter_Overshoot Overshoot;

typedef loiter_Identification Identification;

/* An aircraft at an instant, true or as measured by its sensors.
 *
 * Position in local metres east and north, heading of the nose, bank, velocity over the ground and true airspeed
 * (metres per second).
 */
typedef struct { real time_s, east_m, north_m, heading_deg, bank_deg, velocity_east_m_s, velocity_north_m_s,
        airspeed_m_s; } State;

typedef struct { Clock a0; bool a1; } Clock_bool;

typedef struct { real a0, a1; } real_2;

typedef struct { WindChange a0; bool a1; } WindChange_bool;


/* The least time constant, seconds, and the largest rate limit, degrees per second, that count as declared; a
 * longer delay than those of the grid counts as the longest of them.
 */
#define LEAST_TIME_S REAL(0.1)
#define LARGEST_RATE_DEG_S REAL(200.0)

/* The models: so many time constants and rate limits, of which each is the next multiple of the one before it; the
 * declared ones have these indices.
 */
#define DECLARED_TIME 3
#define TIME_RATIO REAL(1.8)

/* What is declared counts as a measurement with these standard deviations: of the logarithms of the time constant
 * and of the rate limit, and of the delay, seconds.
 */
#define SPREAD REAL(0.7)
#define TIMES 5
static const Sums NO_SUMS = {REAL(0.0), REAL(0.0), REAL(0.0)};
#define DECLARED_RATE 3
#define RATE_RATIO REAL(1.45)
#define RATES 6

/* The models make steps of this length, seconds. The delays are whole steps, from the longest one down to 0. */
#define STEP_S REAL(0.1)
#define DELAYS 14
#define DELAY_SPREAD_S REAL(0.2)
static const ModelStep NO_MODEL_STEP = {REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)};
#define KINDS 8 /* TIMES + SECOND_TIMES */

/* Each is of first order and, the slowest ones, of second order too, with these multiples of its time constant as
 * the time constant and the lag of its rate: as quick to 63 %, with an overshoot of 13 %.
 */
#define SECOND_TIMES 3

/* A roll of first order is declared: the others have this share of the probability of the same roll of first order. */
#define SECOND_SHARE REAL(0.5)

/* A step of a model of second order is computed in so many. */
#define SUBSTEPS 32

/* For fewer lags of the bank rate its effect is a series, of which the first term that is left out is 1.4e-6 here. */
#define SHORT_LAGS REAL(0.1)
#define SECOND_TIME REAL(0.71)
#define SECOND_LAG REAL(0.58)

/* The airspeed is averaged over the first time, seconds, at most; the declared one counts for the second. */
#define DECLARED_AIRSPEED_S REAL(5.0)

/* The same for the airspeed in turns with more than this share of the bank limit. */
#define DECLARED_TURN_AIRSPEED_S REAL(0.3)

/* Prediction errors have this standard deviation, degrees, and are correlated over this time, seconds; larger ones
 * than `LARGEST_ERROR_DEG` count as that.
 */
#define CORRELATION_S REAL(0.2)
static const MeasuredBank NOTHING_MEASURED = {REAL(0.0), REAL(0.0), REAL(0.0)};

/* Errors are forgotten over this time, seconds, while the predictions differ by more than `EXCITED_DEG`. */
#define EXCITED_DEG REAL(3.0)
#define MEMORY_S REAL(10.0)
#define ERROR_DEG REAL(1.4)
#define LARGEST_ERROR_DEG REAL(10.0)

/* A shorter lag of the bank rate, seconds, counts as none. */
#define NEGLIGIBLE_LAG_S REAL(0.01)

/* A smaller variance of an index counts as that: it is the difference of nearly equal sums, and its root would turn
 * their last digits, which differ between languages, into 1e-7 of a bank.
 */
#define NEGLIGIBLE_VARIANCE REAL(1e-06)

/* The estimate of the rate limit is lower than its mean by this multiple of the standard deviation that is left, to
 * the extent that measurements count: a reversal that begins too late costs more than one that begins too early.
 */
#define RATE_CAUTION REAL(0.8)
#define MODELS 48 /* KINDS * RATES */
static const Clock FIRST_CLOCK = {-REAL_INFINITY, REAL(0.0), REAL_INFINITY, REAL(0.0), REAL_NAN, REAL_NAN};
static const TurnSums NO_TURNS = {REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)};
static const RatioFit NO_PAIRS = {REAL(0.0), REAL(0.0)};
static const HighPass NO_VALUE = {REAL(0.0), REAL_NAN};
static const AirErrors NO_ERRORS = {REAL(0.0), REAL(0.0)};
static const WindChange NO_CHANGE = {REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0025000000000000005)};

/* After a longer step, seconds, the banks are those of a step of this length: it has the same effect on every
 * model.
 */
#define LONGEST_STEP_S REAL(20.0)

/* The largest plausible time stamp, seconds: 32,000 years, where a double still resolves a tenth of a millisecond. */
#define LATEST_S REAL(1000000000000.0)

/* Bounds of a plausible measurement: the largest value in metres, degrees or metres per second, the least airspeed. */
#define LARGEST_VALUE REAL(1000000000.0)
#define LEAST_AIRSPEED_M_S REAL(0.1)

/* A stamp is accepted at once unless it is later by more than this, seconds, than the last one plus the time that
 * has passed since. So a law that was not called for an hour continues at once.
 */
#define LARGEST_GAP_S REAL(3600.0)

/* A clock that has jumped back, or further ahead, is accepted once its stamps have advanced by this, seconds. No
 * single step between them may be larger: two stamps alone do not confirm a clock.
 */
#define CONFIRMATION_S REAL(1.0)

/* Measurements that follow each other sooner than this, seconds, are left out: identification needs no more. */
#define SHORTEST_GAP_S REAL(0.095)

/* Measurements further apart than this, seconds, are not related to each other. */
#define RELATED_S REAL(1.0)
#define STANDARD_GRAVITY_M_S2 REAL(9.80665)

/* Turn ratio and bank bias are fitted to angles that are high-pass filtered and forgotten over these times,
 * seconds.
 */
#define TURN_FILTER_S REAL(3.0)
#define TURN_MEMORY_S REAL(60.0)

/* What is expected of them counts as if it had been measured with these standard deviations, from headings with
 * errors of the third, degrees, that are correlated over the filter time. The bias stays within the last, degrees.
 */
#define TURN_ERROR_DEG REAL(0.7)
#define TURN_RATIO_SPREAD REAL(0.15)
#define BANK_BIAS_SPREAD_DEG REAL(1.5)

/* The bounds of ratios of turns. */
#define LEAST_TURN_RATIO REAL(0.6)
#define LARGEST_TURN_RATIO REAL(3.0)
#define LARGEST_BANK_BIAS_DEG REAL(6.0)

/* The ratio of quick turns is fitted to angles that are high-pass filtered over the first time, seconds. From these
 * their means over the second time are subtracted, which a steady turn leaves. They are forgotten over the third.
 */
#define QUICK_FILTER_S REAL(0.3)
#define QUICK_MEAN_S REAL(0.5)

/* The declared ratio counts as if it had been measured with this standard deviation, from angles with errors of the
 * second, degrees, that are correlated over the filter time. A larger angle than the third, degrees, counts no more
 * than that: otherwise one large turn would outweigh many small oscillations.
 */
#define QUICK_SATURATION_DEG REAL(0.5)
#define QUICK_MEMORY_S REAL(6.0)
#define QUICK_ERROR_DEG REAL(0.5)
#define QUICK_RATIO_SPREAD REAL(0.5)

/* The lead of the course is fitted to signals that are high-pass filtered over this time, and forgotten over the
 * second. A lead of 0 counts as if it had been measured with the third, from directions with errors of the fourth,
 * radians, that are correlated over a second. It stays within the last.
 */
#define LEAD_FILTER_S REAL(1.5)
#define LEAD_MEMORY_S REAL(30.0)
#define DIRECTION_ERROR REAL(0.03)
#define LEAD_SPREAD_S REAL(0.1)
#define LARGEST_LEAD_S REAL(0.4)

/* The wind has changed where the velocity of the air, averaged over the first time, seconds, differs from the
 * estimated wind for the second time by more than the first share of the airspeed, and by more than the last
 * multiple of what is usual. That is the root mean square difference over the third time, which begins with the
 * second share. The average at the end of the second time is the change: at first the aircraft flies beside its
 * nose, until it has turned into the new wind.
 */
#define SWIFT_S REAL(0.3)
#define CHANGED_SHARE REAL(0.2)
#define USUAL_MULTIPLE REAL(2.5)
#define USUAL_S REAL(20.0)
#define CHANGED_S REAL(1.5)

/* The wind is the average of the air's velocity over the first time, seconds, at most. A declared wind counts as if
 * it had been averaged over the second; without one the average begins with the first measurement.
 */
#define WIND_MEMORY_S REAL(60.0)

/* The heading bias, radians, and the share of the airspeed that is not measured count, before they show, as if they
 * had been found to be 0, or what they were when the wind changed, with the first two standard deviations, from an
 * air velocity with errors of the third, airspeeds, that are correlated over the fourth, seconds.
 */
#define AIR_ERROR REAL(0.05)
#define AIR_ERROR_S REAL(4.0)
#define HEADING_BIAS_SPREAD REAL(0.06)
#define AIRSPEED_SPREAD REAL(0.04)

/* The shortest time between two measured banks that are used, seconds. */
#define MEASURED_S REAL(0.15)
#define TIGHT_SHARE REAL(0.7)
#define AIRSPEED_MEMORY_S REAL(20.0)

/* Of the bank beyond the limit this much, degrees, is normal; the rest is forgotten over the second time, seconds. */
#define NORMAL_OVERSHOOT_DEG REAL(8.0)
#define OVERSHOOT_MEMORY_S REAL(60.0)

/* The sums with another index. */
static inline Sums with_index(Sums sums, integer index, real weight) {
    return MAKE(Sums){sums.total + weight, sums.weighted + weight * (real)index, sums.squared + weight *
            (real)(index * index)};
}

/* The logarithm of the probability of an index, as declared, up to a constant. */
static inline real declared_log(const Unknown *unknown, real index) {
    const real off = unknown->step * (index - unknown->at_index) / unknown->spread;
    return -REAL(0.5) * off * off;
}

/* The weighted mean of the indices. */
static inline real mean_of(Sums sums) {
    return sums.weighted / sums.total;
}

/* The weighted variance of the indices. */
static inline real variance_of(Sums sums) {
    return sums.squared / sums.total - mean_of(sums) * mean_of(sums);
}

/* The unknown with `count` indices, of which the declared one need not be whole. */
static inline Unknown unknown_of(real declared, real index, real step, real spread, integer count) {
    const Unknown unknown = MAKE(Unknown){declared, index, step, spread, REAL(0.0), REAL(1.0)};
    Sums sums = NO_SUMS;
    for (integer i = 0; i < count; i++) {
        sums = with_index(sums, i, real_exp(declared_log(&unknown, (real)i)));
    }
    return MAKE(Unknown){declared, index, step, spread, mean_of(sums) - index, variance_of(sums)};
}

/* The index of the time constant of a kind: those of first order come first, then the slowest of second order. */
static inline integer time_index(integer kind) {
    return kind < TIMES ? kind : kind - SECOND_TIMES;
}

/* The value of an unknown at an index. */
static inline real value_at(const Unknown *unknown, real index) {
    return unknown->declared + unknown->step * (index - unknown->at_index);
}

/* The step of a time above 0. */
static inline RollStep roll_step(RollValues roll, real time_s) {
    if (roll.lag_s == REAL(0.0)) {
        return MAKE(RollStep){time_s, REAL(0.0), REAL(0.0)};
    }
    const real kept = real_exp(-time_s / roll.lag_s), lags = time_s / roll.lag_s;
    /* The difference of large numbers for a short time, of which this is the series. */
    return MAKE(RollStep){time_s, kept, lags < SHORT_LAGS ? REAL(0.5) - lags / REAL(12.0) : REAL(1.0) / lags - kept
            / (REAL(1.0) - kept)};
}

/* The exact bank after `time_s` seconds under a constant command. */
static inline real bank_after(real roll_time_s, real rate_deg_s, real bank_deg, real command_deg, real time_s) {
    if (roll_time_s == REAL(0.0) && rate_deg_s == REAL_INFINITY) {
        return command_deg;
    }
    real missing = command_deg - bank_deg;
    const real sign = missing >= REAL(0.0) ? REAL(1.0) : -REAL(1.0);
    const real beyond = max_real(real_fabs(missing) - rate_deg_s * roll_time_s, REAL(0.0));
    const real limited_s = beyond / rate_deg_s;
    if (limited_s > time_s) {
        return bank_deg + sign * rate_deg_s * time_s;
    }
    missing -= sign * beyond;
    if (roll_time_s > REAL(0.0)) {
        return command_deg - missing * real_exp(-(time_s - limited_s) / roll_time_s);
    }
    return time_s <= limited_s ? command_deg - missing : command_deg;
}

/* `value`, limited to the range from -`limit` to `limit`. */
static inline real clip(real value, real limit) {
    /* Comparisons take a third of the time of `min` and `max`, and a law clips several values in each step. */
    return value > limit ? limit : value < -limit ? -limit : value;
}

/* The bank after a step under a constant command. */
static inline Bank bank_after_step(RollValues roll, RollStep step, Bank now, real command_deg) {
    if (roll.lag_s == REAL(0.0)) {
        return MAKE(Bank){bank_after(roll.time_s, roll.rate_deg_s, now.bank_deg, command_deg, step.time_s),
                now.rate_deg_s};
    }
    const real wanted_deg_s = (command_deg - now.bank_deg - REAL(0.5) * step.time_s * now.rate_deg_s) / roll.time_s;
    const real rate_deg_s = clip(wanted_deg_s + step.kept * (now.rate_deg_s - wanted_deg_s), roll.rate_deg_s);
    const real change_deg = step.time_s * (rate_deg_s + step.share * (now.rate_deg_s - rate_deg_s));
    return MAKE(Bank){now.bank_deg + change_deg, rate_deg_s};
}

/* The bank after a short time under a constant command; exact without a lag of the bank rate. */
static inline Bank roll_after(RollValues roll, Bank now, real command_deg, real time_s) {
    return time_s > REAL(0.0) ? bank_after_step(roll, roll_step(roll, time_s), now, command_deg) : now;
}

/* The step of a model without its limit. */
static inline ModelStep step_of(real time_s, real lag_s) {
    if (lag_s == REAL(0.0)) {
        return MAKE(ModelStep){REAL(1.0) - real_exp(-STEP_S / time_s), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)};
    }
    const RollValues roll = MAKE(RollValues){time_s, REAL_INFINITY, lag_s, REAL_INFINITY};
    Bank one = MAKE(Bank){REAL(1.0), REAL(0.0)}, other = MAKE(Bank){REAL(0.0), REAL(1.0)};
    const real dt = STEP_S / (real)SUBSTEPS;
    for (integer pass_1 = 0; pass_1 < SUBSTEPS; pass_1++) {
        one = roll_after(roll, one, REAL(0.0), dt);
        other = roll_after(roll, other, REAL(0.0), dt);
    }
    return MAKE(ModelStep){REAL(1.0) - one.bank_deg, other.bank_deg, -one.rate_deg_s, other.rate_deg_s, lag_s};
}

/* The models for what is declared. */
static inline RollSettings roll_settings(RollValues declared, real delay_s) {
    const real time_s = max_real(declared.time_s, LEAST_TIME_S), rate_deg_s = min_real(declared.rate_deg_s,
            LARGEST_RATE_DEG_S);
    const Unknown time = unknown_of(real_log(time_s), (real)DECLARED_TIME, real_log(TIME_RATIO), SPREAD, TIMES);
    const Unknown rate = unknown_of(real_log(rate_deg_s), (real)DECLARED_RATE, real_log(RATE_RATIO), SPREAD, RATES);
    delay_s = min_real(delay_s, STEP_S * (real)(DELAYS - 1));
    const Unknown delay = unknown_of(delay_s, (real)(DELAYS - 1) - delay_s / STEP_S, -STEP_S, DELAY_SPREAD_S,
            DELAYS);
    ModelStep_ring_8 kinds = ModelStep_ring_8_filled(NO_MODEL_STEP);
    real_ring_8 kind_logs = real_ring_8_filled(REAL(0.0));
    real_ring_14 delay_logs = real_ring_14_filled(REAL(0.0));
    real_ring_6 limits_deg = real_ring_6_filled(REAL(0.0)), rate_logs = real_ring_6_filled(REAL(0.0));
    for (integer i = 0; i < KINDS; i++) {
        const integer at = time_index(i);
        const real one_s = real_exp(value_at(&time, (real)at));
        real share = SECOND_SHARE;
        if (i < TIMES) {
            share = i >= TIMES - SECOND_TIMES ? REAL(1.0) : REAL(1.0) + SECOND_SHARE;
            ModelStep_ring_8_append(&kinds, step_of(one_s, REAL(0.0)));
        } else {
            ModelStep_ring_8_append(&kinds, step_of(SECOND_TIME * one_s, SECOND_LAG * one_s));
        }
        real_ring_8_append(&kind_logs, declared_log(&time, (real)at) + real_log(share));
    }
    for (integer i = 0; i < RATES; i++) {
        real_ring_6_append(&limits_deg, STEP_S * real_exp(value_at(&rate, (real)i)));
        real_ring_6_append(&rate_logs, declared_log(&rate, (real)i));
    }
    for (integer i = 0; i < DELAYS; i++) {
        real_ring_14_append(&delay_logs, declared_log(&delay, (real)i));
    }
    return MAKE(RollSettings){time, rate, delay, declared.slew_deg_s, kinds, kind_logs, limits_deg, rate_logs,
            delay_logs};
}

/* The settings for what is declared. */
static inline IdentificationSettings settings_of(const VehicleEstimates *declared, real limit_deg, real
        wind_known_s) {
    return MAKE(IdentificationSettings){(*declared), wind_known_s, limit_deg, roll_settings(declared->roll,
            declared->delay_s)};
}

/* A comparison with a measured bank of which so many kinds count as done. */
static inline Comparison comparison_with(MeasuredBank measured, integer done) {
    return MAKE(Comparison){measured, done, REAL(0.0), REAL(0.0), NO_SUMS, NO_SUMS, NO_SUMS, REAL(0.0), REAL(0.0)};
}

/* A model after a step under a command. */
static inline Bank model_step(ModelStep kind, real limit_deg, Bank now, real command_deg) {
    const real missing_deg = command_deg - now.bank_deg;
    const real change_deg = clip(kind.change * missing_deg + kind.change_s * now.rate_deg_s, limit_deg);
    const real rate_deg_s = clip(kind.rate * missing_deg + kind.rate_kept * now.rate_deg_s, limit_deg / STEP_S);
    return MAKE(Bank){now.bank_deg + change_deg, rate_deg_s};
}

/* The weights with those of a kind at the end, without the first ones. */
static inline void with_next_kind(Weights *weights, const KindWeights *kind) {
    KindWeights_ring_8_append(&weights->kinds, (*kind));
    return;
}

/* The memory with the measured bank compared with one more kind of models. */
static inline void compare_kind(RollMemory *memory, const RollSettings *settings) {
    const Comparison sums = memory->comparison;
    const integer i = memory->comparison.done;
    const MeasuredBank measured = memory->comparison.measured;
    real errors = sums.errors, squares = sums.squares, lag_s = sums.lag_s, second = sums.second;
    Sums time = sums.time, rate = sums.rate, delay = sums.delay;
    const ModelStep kind = settings->kinds.at[i];
    KindWeights weights = memory->weights.kinds.at[0];
    const real variance_deg2 = memory->weights.variance_deg2;
    const real kept = real_exp(-variance_deg2 / (variance_deg2 + EXCITED_DEG * EXCITED_DEG) * measured.since_s /
            MEMORY_S);
    const real scale = -REAL(0.5) * measured.since_s / (CORRELATION_S * ERROR_DEG * ERROR_DEG);
    const real measured_deg = measured.bank_deg, done = measured.after_s / STEP_S, largest = LARGEST_ERROR_DEG *
            LARGEST_ERROR_DEG;
    const real kind_log = settings->kind_logs.at[i] - memory->weights.log_total;
    for (integer j = 0; j < RATES; j++) {
        const real limit_deg = settings->limits_deg.at[j], model_log = kind_log + settings->rate_logs.at[j];
        Bank now = memory->models.kinds.at[i].at[j].earliest;
        real_ring_14 pairs = weights.logs.at[0];
        real total = REAL(0.0);
        for (integer k = 0; k < DELAYS; k++) {
            const Bank after = model_step(kind, limit_deg, now, memory->models.commands_deg.at[k]);
            const real error = now.bank_deg + done * (after.bank_deg - now.bank_deg) - measured_deg;
            now = after;
            const real square = error * error;
            errors = errors + error;
            squares = squares + square;
            const real one = kept * pairs.at[0] + scale * (square < largest ? square : largest);
            const real weight = real_exp(model_log + settings->delay_logs.at[k] + one);
            real_ring_14_append(&pairs, one);
            total = total + weight;
            delay = with_index(delay, k, weight);
        }
        real_ring_14_ring_6_append(&weights.logs, pairs);
        real_ring_6_append(&weights.probabilities, total);
        time = with_index(time, time_index(i), total);
        rate = with_index(rate, j, total);
        lag_s = lag_s + total * kind.lag_s;
        second = second + (kind.lag_s > REAL(0.0) ? total : REAL(0.0));
    }
    const Comparison comparison = MAKE(Comparison){measured, i + 1, errors, squares, time, rate, delay, lag_s,
            second};
    memory->comparison = comparison;
    with_next_kind(&memory->weights, &weights);
    return;
}

/* To what extent measurements count instead of what is declared, from 0 to 1. */
static inline real measured_share(const Unknown *unknown, Sums sums) {
    return REAL(1.0) - min_real(max_real(variance_of(sums) / unknown->variance, REAL(0.0)), REAL(1.0));
}

/* The weighted mean of an unknown, without the bias that is left. */
static inline real estimate_of(const Unknown *unknown, Sums sums) {
    return value_at(unknown, mean_of(sums) - (REAL(1.0) - measured_share(unknown, sums)) * unknown->bias);
}

/* `estimate_of`, lower by `RATE_CAUTION` standard deviations; what is declared is believed until measured. */
static inline real cautious_estimate(const Unknown *unknown, Sums sums) {
    const real deviation = unknown->step * real_sqrt(max_real(variance_of(sums), NEGLIGIBLE_VARIANCE));
    return estimate_of(unknown, sums) - RATE_CAUTION * measured_share(unknown, sums) * deviation;
}

/* The weights with the estimate after a comparison with all kinds. */
static inline void estimate_anew(Weights *weights, const RollSettings *settings, const Comparison *sums) {
    const real total = sums->time.total;
    /* A roll of first order is declared. */
    const real share = measured_share(&settings->time, sums->time) / total;
    const real time_s = real_exp(estimate_of(&settings->time, sums->time)) * (REAL(1.0) + share * sums->second
            * (SECOND_TIME - REAL(1.0)));
    real lag_s = share * sums->lag_s;
    lag_s = lag_s > NEGLIGIBLE_LAG_S ? lag_s : REAL(0.0);
    const RollValues roll = MAKE(RollValues){time_s, real_exp(cautious_estimate(&settings->rate, sums->rate)),
            lag_s, settings->slew_deg_s};
    const real mean = sums->errors / (real)(MODELS * DELAYS);
    const real new_1 = weights->log_total + real_log(total);
    weights->total = total;
    weights->log_total = new_1;
    weights->variance_deg2 = max_real(sums->squares / (real)(MODELS * DELAYS) - mean * mean, REAL(0.0));
    weights->estimate = MAKE(RollEstimate){roll, max_real(estimate_of(&settings->delay, sums->delay),
            REAL(0.0))};
    return;
}

/* The memory with the measured bank compared with so many more kinds, and with another estimate after the last. */
static inline void compare(RollMemory *memory, const RollSettings *settings, integer kinds) {
    if (memory->comparison.done == KINDS) {
        return;
    }
    const integer last = min_integer(memory->comparison.done + kinds, KINDS);
    while (memory->comparison.done < last) {
        compare_kind(memory, settings);
    }
    if (memory->comparison.done < KINDS) {
        return;
    }
    estimate_anew(&memory->weights, settings, &memory->comparison);
    return;
}

/* The memory before the first command, with wings level: `NO_ROLL`, which is given, with the first estimate. */
static inline void begin_roll(RollMemory *memory, const RollSettings *settings) {
    memory->since_s = CORRELATION_S;
    /* A measurement that counts for no time leaves the probabilities as they are declared. */
    memory->comparison = comparison_with(NOTHING_MEASURED, 0);
    compare(memory, settings, KINDS);
    return;
}

/* The fit before a measurement, or one that does not relate later measurements to earlier ones. */
static inline SlowTurns first_slow_turns(real ratio, real bank_bias_deg, TurnSums sums) {
    return MAKE(SlowTurns){ratio, bank_bias_deg, sums, REAL_NAN, REAL_NAN, REAL_NAN, REAL(0.0), REAL(0.0),
            REAL(0.0)};
}

/* The fit before a measurement, or one that does not relate later measurements to earlier ones. */
static inline QuickTurns first_quick_turns(real ratio, RatioFit fit) {
    return MAKE(QuickTurns){ratio, fit, REAL_NAN, REAL_NAN, REAL(0.0), REAL(0.0), NO_VALUE, NO_VALUE};
}

/* The fit before a measurement, or one that does not relate later measurements to earlier ones. */
static inline CourseLead first_lead(real lead_s, RatioFit fit) {
    return MAKE(CourseLead){lead_s, fit, NO_VALUE, NO_VALUE};
}

/* The fits before a measurement, with what is declared. */
static inline Turns first_turns(real turn_ratio, real lead_s) {
    return MAKE(Turns){first_slow_turns(turn_ratio, REAL(0.0), NO_TURNS), first_quick_turns(turn_ratio, NO_PAIRS),
            first_lead(lead_s, NO_PAIRS)};
}

/* The fit before a measurement. */
static inline WindFit first_wind(real east_m_s, real north_m_s, real known_s) {
    const AirMeans means = MAKE(AirMeans){east_m_s, north_m_s, REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0),
            REAL(0.0)};
    return MAKE(WindFit){east_m_s, north_m_s, NO_ERRORS, NO_ERRORS, known_s, means, NO_CHANGE};
}

/* `NO_IDENTIFICATION`, which is given, with what is declared. */
static APART void begin_identification(Identification *memory, const IdentificationSettings *settings) {
    const VehicleEstimates declared = settings->declared;
    const Average airspeed = MAKE(Average){declared.airspeed_m_s, DECLARED_AIRSPEED_S};
    const Average turn_airspeed = MAKE(Average){declared.turn_airspeed_m_s, DECLARED_TURN_AIRSPEED_S};
    begin_roll(&memory->roll, &settings->roll);
    memory->stamps = MAKE(Stamps){FIRST_CLOCK, REAL(0.0), -REAL_INFINITY};
    memory->turns = first_turns(declared.turn_ratio, declared.course_lead_s);
    memory->wind = first_wind(declared.wind_east_m_s, declared.wind_north_m_s, settings->wind_known_s);
    memory->airspeeds = MAKE(Airspeeds){airspeed, turn_airspeed};
    memory->estimates = declared;
    return;
}

/* All models after a step under the mean command. */
static inline void step_models(Models *models, const RollSettings *settings, real command_deg) {
    const real oldest_deg = models->commands_deg.at[0];
    for (integer i = 0; i < KINDS; i++) {
        const ModelStep kind = settings->kinds.at[i];
        RollModel_ring_6 rolls = models->kinds.at[0];
        for (integer j = 0; j < RATES; j++) {
            const RollModel one = rolls.at[0];
            const real limit_deg = settings->limits_deg.at[j];
            const Bank present = model_step(kind, limit_deg, one.present, command_deg);
            const Bank earliest = model_step(kind, limit_deg, one.earliest, oldest_deg);
            RollModel_ring_6_append(&rolls, MAKE(RollModel){present, earliest});
        }
        RollModel_ring_6_ring_8_append(&models->kinds, rolls);
    }
    real_ring_14_append(&models->commands_deg, command_deg);
    return;
}

/* The weighted means of the banks of the models, and of their rates, as far as these go on. */
static inline Bank mean_bank(const RollMemory *memory, const RollSettings *settings) {
    real bank_deg = REAL(0.0), lag_s = REAL(0.0), coasted_deg = REAL(0.0);
    for (integer i = 0; i < KINDS; i++) {
        for (integer j = 0; j < RATES; j++) {
            const real probability = memory->weights.kinds.at[i].probabilities.at[j];
            const Bank now = memory->models.kinds.at[i].at[j].present;
            bank_deg += probability * now.bank_deg;
            lag_s += probability * settings->kinds.at[i].lag_s;
            coasted_deg += probability * settings->kinds.at[i].lag_s * now.rate_deg_s;
        }
    }
    return MAKE(Bank){bank_deg / memory->weights.total, lag_s > REAL(0.0) ? coasted_deg / lag_s : REAL(0.0)};
}

/* The memory after `dt` seconds under a command.
 *
 * A measured bank is compared with the models kind by kind until their next step, so that each call has its share.
 */
static inline void fly_models(RollMemory *memory, const RollSettings *settings, real command_deg, real dt) {
    real waiting_s = memory->waiting_s, commanded = memory->commanded;
    dt = min_real(dt, LONGEST_STEP_S);
    Bank now = MAKE(Bank){memory->bank_deg, memory->bank_rate_deg_s};
    real left_s = dt;
    memory->since_s = memory->since_s + dt;
    while (left_s >= STEP_S - waiting_s) {
        const real mean_deg = (commanded + (STEP_S - waiting_s) * command_deg) / STEP_S;
        compare(memory, settings, KINDS);
        step_models(&memory->models, settings, mean_deg);
        if (memory->measured.since_s > REAL(0.0)) {
            memory->comparison = comparison_with(memory->measured, 0);
            memory->measured = NOTHING_MEASURED;
        }
        left_s = left_s - (STEP_S - waiting_s);
        waiting_s = REAL(0.0);
        commanded = REAL(0.0);
        now = mean_bank(memory, settings);
    }
    waiting_s = waiting_s + left_s;
    commanded = commanded + left_s * command_deg;
    compare(memory, settings, integer_of(real_ceil((real)KINDS * dt / STEP_S)));
    /* Between the steps of the models the present bank is that of the estimated response. */
    now = roll_after(memory->weights.estimate.roll, now, command_deg, left_s);
    memory->bank_deg = now.bank_deg;
    memory->bank_rate_deg_s = now.rate_deg_s;
    memory->waiting_s = waiting_s;
    memory->commanded = commanded;
    return;
}

/* Whether the time of a measurement is within `LATEST_S`, and all other numbers together within `LARGEST_VALUE`. */
static inline bool is_plausible(const State *state) {
    const real time_s = state->time_s, east = state->east_m, north = state->north_m, heading =
            state->heading_deg, bank = state->bank_deg, velocity_east = state->velocity_east_m_s,
            velocity_north = state->velocity_north_m_s, airspeed = state->airspeed_m_s;
    const real position = real_fabs(east) + real_fabs(north), angles = real_fabs(heading) + real_fabs(bank);
    const real size = position + angles + real_fabs(velocity_east) + real_fabs(velocity_north) +
            real_fabs(airspeed);
    /* Neither comparison holds for nan. */
    return real_fabs(time_s) < LATEST_S && size < LARGEST_VALUE;
}

/* Whether a measurement is plausible and of an aircraft in flight, faster than `LEAST_AIRSPEED_M_S`. */
static inline bool is_usable(const State *state) {
    return is_plausible(state) && state->airspeed_m_s > LEAST_AIRSPEED_M_S;
}

/* The clock `dt` seconds later. */
static inline Clock advance_clock(const Clock *clock, real dt) {
    const real time_s = clock->time_s, since_s = clock->since_s, gap_s = clock->gap_s, jump_s =
            clock->jump_s, first_s = clock->first_s, latest_s = clock->latest_s;
    return MAKE(Clock){time_s, since_s + dt, gap_s, jump_s, first_s, latest_s};
}

/* The clock after a measurement at `time_s`, and whether that is a new one.
 *
 * It may be one by this clock, or by another that is confirmed by now.
 */
static inline Clock_bool check_stamp(const Clock *clock, real time_s) {
    const real ahead_s = time_s - clock->time_s;
    if ((REAL(0.0) < ahead_s && ahead_s <= clock->since_s + LARGEST_GAP_S) || clock->time_s == -REAL_INFINITY) {
        return MAKE(Clock_bool){MAKE(Clock){time_s, REAL(0.0), ahead_s, REAL(0.0), REAL_NAN, REAL_NAN}, true};
    }
    /* A stamp that does not fit the earlier ones of the other clock starts the count again. */
    const bool fits = clock->first_s <= time_s && time_s <= clock->latest_s + CONFIRMATION_S;
    const real first_s = fits ? clock->first_s : time_s, latest_s = fits ? max_real(clock->latest_s, time_s) :
            time_s;
    if (latest_s - first_s >= CONFIRMATION_S) {
        return MAKE(Clock_bool){MAKE(Clock){time_s, REAL(0.0), clock->since_s, ahead_s - clock->since_s,
                REAL_NAN, REAL_NAN}, true};
    }
    return MAKE(Clock_bool){MAKE(Clock){clock->time_s, clock->since_s, clock->gap_s, clock->jump_s, first_s,
            latest_s}, false};
}

/* A measured state without the biases of heading and bank. */
static inline State remove_bias(const VehicleEstimates *known, const State *state) {
    const real heading_bias_deg = known->heading_bias_deg, bank_bias_deg = known->bank_bias_deg;
    if (heading_bias_deg == REAL(0.0) && bank_bias_deg == REAL(0.0)) {
        return (*state);
    }
    const real time_s = state->time_s, x = state->east_m, y = state->north_m, heading_deg =
            state->heading_deg, bank_deg = state->bank_deg, east = state->velocity_east_m_s, north =
            state->velocity_north_m_s, V = state->airspeed_m_s;
    return MAKE(State){time_s, x, y, heading_deg - heading_bias_deg, bank_deg - bank_bias_deg, east, north, V};
}

/* The models at a bank that has always been this. */
static inline Models constant_models(real bank_deg) {
    return MAKE(Models){real_ring_14_filled(bank_deg),
            RollModel_ring_6_ring_8_filled(RollModel_ring_6_filled(MAKE(RollModel){MAKE(Bank){bank_deg, REAL(0.0)},
            MAKE(Bank){bank_deg, REAL(0.0)}}))};
}

/* The memory with every model at a bank. */
static inline void start_models(RollMemory *memory, real bank_deg) {
    memory->bank_deg = bank_deg;
    memory->models = constant_models(bank_deg);
    return;
}

/* Whether the last measurements differ from the wind as if it had changed. */
static inline bool is_changing(const WindFit *wind) {
    return wind->change.since_s > REAL(0.0);
}

/* The fits, which do not relate later measurements to earlier ones. */
static inline Turns restart_turns(const Turns *turns) {
    const SlowTurns slow = turns->slow;
    const QuickTurns quick = turns->quick;
    const CourseLead lead = turns->lead;
    return MAKE(Turns){first_slow_turns(slow.ratio, slow.bank_bias_deg, slow.sums), first_quick_turns(quick.ratio,
            quick.fit), first_lead(lead.lead_s, lead.fit)};
}

/* Turn rate of a coordinated turn, radians per second, with the sign of the bank: g tan(bank)/V. */
static inline real rate_at_bank(real bank_deg, real airspeed_m_s) {
    return STANDARD_GRAVITY_M_S2 * real_tan(bank_deg * REAL(0.017453292519943295)) / airspeed_m_s;
}

/* The angle from one direction to another, from -180 to below 180 degrees. */
static inline real turn_between_deg(real from_deg, real to_deg) {
    return real_modulo(to_deg - from_deg + REAL(180.0), REAL(360.0)) - REAL(180.0);
}

/* A filtered value `dt` seconds later, where the input has changed; the filter has a time, seconds. */
static inline real high_pass(real filtered, real change, real dt, real time_s) {
    return real_exp(-dt / time_s) * (filtered + change);
}

/* A ratio of turns within its bounds. */
static inline real bounded_turn_ratio(real ratio) {
    return min_real(max_real(ratio, LEAST_TURN_RATIO), LARGEST_TURN_RATIO);
}

/* The ratio and the bank bias, degrees, from the sums and what is declared. */
static inline real_2 solve_turns(TurnSums sums, real declared) {
    const real error = TURN_ERROR_DEG * TURN_ERROR_DEG * TURN_FILTER_S;
    const real ratio_prior = error / (TURN_RATIO_SPREAD * TURN_RATIO_SPREAD);
    const real bias_prior = error / (BANK_BIAS_SPREAD_DEG * BANK_BIAS_SPREAD_DEG);
    const real xx = sums.xx + ratio_prior, xu = sums.xu, uu = sums.uu + bias_prior;
    const real xy = sums.xy + ratio_prior * declared, uy = sums.uy;
    const real determinant = xx * uu - xu * xu;
    const real ratio = bounded_turn_ratio((uu * xy - xu * uy) / determinant);
    return MAKE(real_2){ratio, clip((xx * uy - xu * xy) / (determinant * ratio), LARGEST_BANK_BIAS_DEG)};
}

/* The fit with a measured heading, bank and airspeed, `dt` seconds after the last. */
static inline SlowTurns add_slow_turn(const SlowTurns *turns, real declared, const State *state, real dt) {
    /* Degrees per second, and degrees per second for each degree of bank: tan(45 degrees) is 1. */
    const real rate = rate_at_bank(state->bank_deg, state->airspeed_m_s) * REAL(57.29577951308232);
    const real cosine = real_cos(state->bank_deg * REAL(0.017453292519943295));
    const real slope = rate_at_bank(REAL(45.0), state->airspeed_m_s) / (cosine * cosine);
    real turned = REAL(0.0), computed = REAL(0.0), of_bias = REAL(0.0);
    if (turns->last_deg == turns->last_deg) {
        turned = turn_between_deg(turns->last_deg, state->heading_deg);
        computed = REAL(0.5) * dt * (turns->last_rate + rate);
        of_bias = -REAL(0.5) * dt * (turns->last_slope + slope);
    }
    const real y = high_pass(turns->measured_deg, turned, dt, TURN_FILTER_S);
    const real x = high_pass(turns->computed_deg, computed, dt, TURN_FILTER_S);
    const real u = high_pass(turns->of_bias_deg, of_bias, dt, TURN_FILTER_S);
    const real kept = real_exp(-dt / TURN_MEMORY_S), xx = turns->sums.xx, xu = turns->sums.xu, uu =
            turns->sums.uu, xy = turns->sums.xy, uy = turns->sums.uy;
    const TurnSums sums = MAKE(TurnSums){kept * xx + dt * x * x, kept * xu + dt * x * u, kept * uu + dt * u * u,
            kept * xy + dt * x * y, kept * uy + dt * u * y};
    const real_2 solve_turns_1 = solve_turns(sums, declared);
    const real ratio = solve_turns_1.a0, bank_bias_deg = solve_turns_1.a1;
    return MAKE(SlowTurns){ratio, bank_bias_deg, sums, state->heading_deg, rate, slope, y, x, u};
}

/* The filter after a value, `dt` seconds after the last. */
static inline HighPass filter_value(HighPass before, real value, real dt, real time_s) {
    const real change = before.last == before.last ? value - before.last : REAL(0.0);
    return MAKE(HighPass){high_pass(before.value, change, dt, time_s), value};
}

/* The sums of which a share is kept, with a pair that counts for so many seconds. */
static inline RatioFit add_pair(RatioFit fit, real y, real x, real seconds, real kept) {
    return MAKE(RatioFit){kept * fit.product + seconds * y * x, kept * fit.square + seconds * x * x};
}

/* The ratio; `prior` is how much the declared one weighs, in x^2 s. */
static inline real ratio_of(RatioFit fit, real declared, real prior) {
    return (fit.product + declared * prior) / (fit.square + prior);
}

/* The fit with a direction and the turn rate of a coordinated turn, `dt` seconds after the last. */
static inline QuickTurns add_quick_turn(const QuickTurns *turns, real declared, real direction_deg, real rate_deg_s,
        real dt) {
    real measured = REAL(0.0), computed = REAL(0.0);
    if (turns->last_deg == turns->last_deg) {
        measured = turn_between_deg(turns->last_deg, direction_deg);
        computed = REAL(0.5) * dt * (turns->last_rate_deg_s + rate_deg_s);
    }
    const real measured_deg = high_pass(turns->measured_deg, measured, dt, QUICK_FILTER_S);
    const real computed_deg = high_pass(turns->computed_deg, computed, dt, QUICK_FILTER_S);
    const HighPass measured_mean = filter_value(turns->measured_mean, measured_deg, dt, QUICK_MEAN_S);
    const HighPass computed_mean = filter_value(turns->computed_mean, computed_deg, dt, QUICK_MEAN_S);
    const real y = measured_mean.value, x = computed_mean.value;
    const real excess = max_real(real_fabs(x) / QUICK_SATURATION_DEG, REAL(1.0));
    const RatioFit fit = add_pair(turns->fit, y, x, dt / (excess * excess), real_exp(-dt / QUICK_MEMORY_S));
    const real prior = QUICK_ERROR_DEG * QUICK_ERROR_DEG * QUICK_FILTER_S / (QUICK_RATIO_SPREAD *
            QUICK_RATIO_SPREAD);
    return MAKE(QuickTurns){bounded_turn_ratio(ratio_of(fit, declared, prior)), fit, direction_deg, rate_deg_s,
            measured_deg, computed_deg, measured_mean, computed_mean};
}

/* East and north component of the unit vector along a compass heading, exact at multiples of 90 degrees.
 *
 * The nearest multiple of 90 degrees is subtracted before the conversion to radians. Therefore a start that heads
 * due east towards the centre has the reduced ordinate 0, not 6e-17, and a large heading keeps its precision.
 */
static inline real_2 heading_vector(real heading_deg) {
    const real heading = real_fmod(heading_deg, REAL(360.0));
    const real quarters = real_floor(heading / REAL(90.0) + REAL(0.5));
    const real rest = (heading - REAL(90.0) * quarters) * REAL(0.017453292519943295);
    /* Sine and cosine of the whole quarters, by `floor`: for arrays the operator % takes longer than a sine. */
    const real halves = real_floor(REAL(0.5) * quarters);
    const real odd = quarters - REAL(2.0) * halves, flip = halves - REAL(2.0) * real_floor(REAL(0.5) * halves);
    const real sq = odd - REAL(2.0) * odd * flip, cq = (REAL(1.0) - odd) * (REAL(1.0) - REAL(2.0) * flip);
    const real s = real_sin(rest), c = real_cos(rest);
    return MAKE(real_2){sq * c + cq * s, cq * c - sq * s};
}

/* The fit with a measurement `dt` seconds after the last, in a wind. */
static inline CourseLead add_course(const CourseLead *lead, real declared_s, const State *state, real turn_ratio,
        const WindFit *wind, real dt) {
    const real_2 heading_vector_1 = heading_vector(state->heading_deg);
    const real c = heading_vector_1.a0, s = heading_vector_1.a1;
    const real east = state->velocity_east_m_s - wind->east_m_s, north = state->velocity_north_m_s -
            wind->north_m_s;
    /* Both positive to the right. */
    const HighPass angle = filter_value(lead->angle, real_atan2(east * s - north * c, east * c + north * s), dt,
            LEAD_FILTER_S);
    const real turn_rate = turn_ratio * rate_at_bank(state->bank_deg, state->airspeed_m_s);
    const HighPass rate = filter_value(lead->rate, turn_rate, dt, LEAD_FILTER_S);
    const RatioFit fit = add_pair(lead->fit, angle.value, rate.value, dt, real_exp(-dt / LEAD_MEMORY_S));
    const real prior = DIRECTION_ERROR * DIRECTION_ERROR / (LEAD_SPREAD_S * LEAD_SPREAD_S);
    return MAKE(CourseLead){clip(ratio_of(fit, declared_s, prior), LARGEST_LEAD_S), fit, angle, rate};
}

/* The fits with a measurement `dt` seconds after the last, and with the same state without its biases. */
static inline Turns add_turn(const Turns *turns, const VehicleEstimates *declared, const State *measurement, const
        State *state, const WindFit *wind, real dt) {
    const SlowTurns slow = add_slow_turn(&turns->slow, declared->turn_ratio, measurement, dt);
    const real rate_deg_s = rate_at_bank(state->bank_deg, state->airspeed_m_s) * REAL(57.29577951308232);
    const real course_deg = real_atan2(state->velocity_east_m_s - wind->east_m_s, state->velocity_north_m_s -
            wind->north_m_s) * REAL(57.29577951308232);
    const QuickTurns quick = add_quick_turn(&turns->quick, declared->turn_ratio, course_deg, rate_deg_s, dt);
    const CourseLead lead = add_course(&turns->lead, declared->course_lead_s, state, slow.ratio, wind, dt);
    return MAKE(Turns){slow, quick, lead};
}

/* The velocity of the air without the errors of heading and airspeed; `right` is the airspeed to the right. */
static inline real_2 without_errors(AirErrors errors, real east_m_s, real north_m_s, real right_east_m_s, real
        right_north_m_s) {
    return MAKE(real_2){east_m_s + errors.heading * right_east_m_s + errors.airspeed * right_north_m_s, north_m_s +
            errors.heading * right_north_m_s - errors.airspeed * right_east_m_s};
}

/* The length of a vector whose square neither overflows nor underflows.
 *
 * Unlike `math.hypot`, whose algorithm is Python's own, compiled code gives the same value to the last bit.
 */
static inline real length(real x, real y) {
    return real_sqrt(x * x + y * y);
}

/* The change with a difference, `dt` seconds after the last, and whether the wind has changed. */
static inline WindChange_bool add_difference(WindChange change, real east_m_s, real north_m_s, real airspeed_m_s,
        real dt) {
    real since_s = change.since_s, swift_east = change.swift_east_m_s, swift_north = change.swift_north_m_s,
            usual_square = change.usual_square;
    const real share = REAL(1.0) - real_exp(-dt / SWIFT_S);
    swift_east = swift_east + share * (east_m_s - swift_east);
    swift_north = swift_north + share * (north_m_s - swift_north);
    const real off = length(swift_east, swift_north) / airspeed_m_s;
    if (off <= max_real(CHANGED_SHARE, USUAL_MULTIPLE * real_sqrt(usual_square))) {
        usual_square += (REAL(1.0) - real_exp(-dt / USUAL_S)) * (off * off - usual_square);
        return MAKE(WindChange_bool){MAKE(WindChange){REAL(0.0), swift_east, swift_north, usual_square}, false};
    }
    since_s += dt;
    const bool has_changed = since_s >= CHANGED_S;
    return MAKE(WindChange_bool){MAKE(WindChange){has_changed ? REAL(0.0) : since_s, swift_east, swift_north,
            usual_square}, has_changed};
}

/* The means as if the wind had always been as it is after a change by this velocity. */
static inline AirMeans shift_means(const AirMeans *means, real east_m_s, real north_m_s) {
    const real east = means->east_m_s, north = means->north_m_s, right_east = means->right_east_m_s,
            right_north = means->right_north_m_s;
    real right = means->right, along = means->along;
    const real square = means->square;
    right += east_m_s * right_east + north_m_s * right_north;
    along += north_m_s * right_east - east_m_s * right_north;
    return MAKE(AirMeans){east + east_m_s, north + north_m_s, right_east, right_north, right, along, square};
}

/* The means, corrected by a share of their differences from the present values. */
static inline AirMeans update_means(const AirMeans *means, const AirMeans *now, real share) {
    return MAKE(AirMeans){means->east_m_s + share * (now->east_m_s - means->east_m_s), means->north_m_s +
            share * (now->north_m_s - means->north_m_s), means->right_east_m_s + share *
            (now->right_east_m_s - means->right_east_m_s), means->right_north_m_s + share *
            (now->right_north_m_s - means->right_north_m_s), means->right + share * (now->right -
            means->right), means->along + share * (now->along - means->along), means->square + share *
            (now->square - means->square)};
}

/* The errors by least squares, where the mean velocity of the air has a variance, (m/s)^2. */
static inline AirErrors air_errors(const AirMeans *means, AirErrors expected, real variance) {
    const real east = means->east_m_s, north = means->north_m_s, right_east = means->right_east_m_s,
            right_north = means->right_north_m_s;
    real right = means->right, along = means->along;
    const real square = means->square;
    const real spread = square - right_east * right_east - right_north * right_north;
    const real of_heading = variance / (HEADING_BIAS_SPREAD * HEADING_BIAS_SPREAD);
    const real of_airspeed = variance / (AIRSPEED_SPREAD * AIRSPEED_SPREAD);
    right = right - east * right_east - north * right_north;
    along = along - north * right_east + east * right_north;
    return MAKE(AirErrors){(of_heading * expected.heading - right) / (spread + of_heading), (of_airspeed *
            expected.airspeed + along) / (spread + of_airspeed)};
}

/* The fit with a state whose heading was corrected by `removed_deg`; the flight is `off` radians to its right. */
static inline WindFit add_air_velocity(const WindFit *wind, const State *state, real off, real removed_deg, real dt)
        {
    dt = max_real(dt, REAL(0.001));
    const real V = state->airspeed_m_s;
    const real_2 heading_vector_1 = heading_vector(state->heading_deg + removed_deg + off *
            REAL(57.29577951308232));
    const real c = heading_vector_1.a0, s = heading_vector_1.a1;
    const real right_east = V * s, right_north = -V * c;
    const real east = state->velocity_east_m_s - V * c, north = state->velocity_north_m_s - V * s;
    real wind_east = wind->east_m_s, wind_north = wind->north_m_s;
    AirErrors errors = wind->errors, expected = wind->expected;
    real known_s = wind->known_s;
    AirMeans means = wind->means;
    WindChange change = wind->change;
    if (known_s > REAL(0.0)) {
        const real_2 without_errors_2 = without_errors(errors, east, north, right_east, right_north);
        const real true_east = without_errors_2.a0, true_north = without_errors_2.a1;
        const WindChange_bool add_difference_3 = add_difference(change, true_east - wind_east, true_north -
                wind_north, V, dt);
        change = add_difference_3.a0;
        const bool has_changed = add_difference_3.a1;
        if (has_changed) {
            means = shift_means(&means, change.swift_east_m_s, change.swift_north_m_s);
            known_s = SWIFT_S;
            expected = errors;
            change = MAKE(WindChange){REAL(0.0), REAL(0.0), REAL(0.0), change.usual_square};
        }
        if (change.since_s > REAL(0.0)) {
            return MAKE(WindFit){wind_east, wind_north, errors, expected, known_s, means, change};
        }
    }
    known_s = min_real(known_s + dt, WIND_MEMORY_S);
    const real right = right_east * east + right_north * north, along = right_east * north - right_north * east;
    const AirMeans stored_4 = MAKE(AirMeans){east, north, right_east, right_north, right, along, V * V};
    means = update_means(&means, &stored_4, min_real(dt / known_s, REAL(1.0)));
    errors = air_errors(&means, expected, AIR_ERROR * AIR_ERROR * V * V * AIR_ERROR_S / known_s);
    const real_2 without_errors_5 = without_errors(errors, means.east_m_s, means.north_m_s, means.right_east_m_s,
            means.right_north_m_s);
    wind_east = without_errors_5.a0;
    wind_north = without_errors_5.a1;
    return MAKE(WindFit){wind_east, wind_north, errors, expected, known_s, means, change};
}

/* The memory with a measured bank that has just arrived; it is compared with the models at their next step. */
static inline void add_measured_bank(RollMemory *memory, real measured_deg) {
    if (memory->since_s < MEASURED_S) {
        return;
    }
    const MeasuredBank measured = MAKE(MeasuredBank){measured_deg, memory->waiting_s, min_real(memory->since_s,
            CORRELATION_S)};
    memory->since_s = REAL(0.0);
    memory->measured = measured;
    return;
}

/* The average over `AIRSPEED_MEMORY_S` at most, including a value measured `dt` seconds after the last. */
static inline Average update_average(Average average, real value, real dt) {
    const real known_s = min_real(average.known_s + max_real(dt, REAL(0.001)), AIRSPEED_MEMORY_S);
    return MAKE(Average){average.value + min_real(dt / known_s, REAL(1.0)) * (value - average.value), known_s};
}

/* The airspeeds including a state, `dt` seconds after the last. */
static inline Airspeeds update_airspeeds(const IdentificationSettings *settings, Airspeeds airspeeds, const State
        *state, real dt) {
    const Average always = airspeeds.always;
    Average in_turns = airspeeds.in_turns;
    if (real_fabs(state->bank_deg) > TIGHT_SHARE * settings->limit_deg) {
        in_turns = update_average(in_turns, state->airspeed_m_s, dt);
    }
    return MAKE(Airspeeds){update_average(always, state->airspeed_m_s, dt), in_turns};
}

/* The overshoot including a bank measured `dt` seconds after the last. */
static inline Overshoot update_overshoot(Overshoot overshoot, real limit_deg, real bank_deg, real dt) {
    const real beyond_deg = max_real(real_fabs(bank_deg) - limit_deg - NORMAL_OVERSHOOT_DEG, REAL(0.0));
    const bool has_begun = overshoot.has_begun || beyond_deg == REAL(0.0);
    if (!has_begun) {
        return overshoot;
    }
    return MAKE(Overshoot){max_real(overshoot.overshoot_deg * real_exp(-dt / OVERSHOOT_MEMORY_S), beyond_deg),
            true};
}

/* The memory with a new measurement, `since_s` seconds after the last one that was used. */
static inline void update_fits(Identification *memory, const IdentificationSettings *settings, const State
        *measurement, real since_s) {
    Turns turns = memory->turns;
    WindFit wind = memory->wind;
    Airspeeds airspeeds = memory->airspeeds;
    Overshoot overshoot = memory->overshoot;
    const VehicleEstimates known = memory->estimates;
    const VehicleEstimates declared = settings->declared;
    real dt = since_s;
    const bool is_related = REAL(0.0) < since_s && since_s <= RELATED_S;
    if (!is_related || is_changing(&wind)) {
        /* While the wind changes the nose turns into it, which no bank does. */
        dt = is_related ? since_s : REAL(0.0);
        turns = restart_turns(&turns);
    }
    const State state = remove_bias(&known, measurement);
    turns = add_turn(&turns, &declared, measurement, &state, &wind, dt);
    const SlowTurns slow = turns.slow;
    const QuickTurns quick = turns.quick;
    const CourseLead lead = turns.lead;
    const real rate = rate_at_bank(state.bank_deg, state.airspeed_m_s);
    /* The direction of flight is to the right of the heading by this angle. */
    wind = add_air_velocity(&wind, &state, lead.lead_s * slow.ratio * rate, known.heading_bias_deg, dt);
    if (wind.known_s < memory->wind.known_s) {
        /* The wind has changed: a lead that was fitted to the wind before may have been part of it. */
        turns.lead = first_lead(declared.course_lead_s, NO_PAIRS);
    }
    add_measured_bank(&memory->roll, state.bank_deg);
    airspeeds = update_airspeeds(settings, airspeeds, &state, dt);
    overshoot = update_overshoot(overshoot, settings->limit_deg, state.bank_deg, dt);
    const VehicleEstimates estimates = MAKE(VehicleEstimates){memory->roll.weights.estimate.roll,
            memory->roll.weights.estimate.delay_s, slow.ratio, quick.ratio, turns.lead.lead_s, wind.east_m_s,
            wind.north_m_s, airspeeds.always.value, airspeeds.in_turns.value, overshoot.overshoot_deg,
            DECLARED_TURN_AIRSPEED_S / airspeeds.in_turns.known_s, wind.errors.heading * REAL(57.29577951308232),
            slow.bank_bias_deg};
    memory->revision = memory->revision + 1;
    memory->turns = turns;
    memory->wind = wind;
    memory->airspeeds = airspeeds;
    memory->overshoot = overshoot;
    memory->estimates = estimates;
    return;
}

/* The memory at a measurement `dt` seconds after the last call.
 *
 * The bank `command_deg` was commanded since then. The measurement may be unusable, or repeat the last one.
 */
static APART void advance_identification(Identification *memory, const IdentificationSettings *settings, const State
        *measurement, real command_deg, real dt) {
    Clock clock = memory->stamps.clock;
    real waited_s = memory->stamps.waited_s;
    const real used_s = memory->stamps.used_s;
    if (dt > REAL(0.0)) {
        fly_models(&memory->roll, &settings->roll, command_deg, dt);
        waited_s = waited_s + dt;
    }
    if (is_usable(measurement) && measurement->time_s != clock.time_s) {
        const Clock stored_1 = advance_clock(&clock, waited_s);
        const Clock_bool check_stamp_2 = check_stamp(&stored_1, measurement->time_s);
        clock = check_stamp_2.a0;
        const bool is_new = check_stamp_2.a1;
        waited_s = REAL(0.0);
        const real since_s = measurement->time_s - used_s;
        if (is_new && !(REAL(0.0) < since_s && since_s < SHORTEST_GAP_S)) {
            if (used_s == -REAL_INFINITY) {
                const real bank_deg = remove_bias(&memory->estimates, measurement).bank_deg;
                start_models(&memory->roll, bank_deg);
            }
            memory->stamps = MAKE(Stamps){clock, REAL(0.0), measurement->time_s};
            update_fits(memory, settings, measurement, since_s);
            return;
        }
    }
    memory->stamps = MAKE(Stamps){clock, waited_s, used_s};
    return;
}

/* ---- The functions of loiter_identification.h ------------------------------------------------------------------- */

void loiter_identification_begin(loiter_identification *identification, loiter_law *law, bool is_wind_known) {
    unsigned char *const bytes = (unsigned char *)&identification->memory;
    VehicleEstimates *const declared = &law->vehicle.estimates;
    declared->turn_ratio = declared->quick_turn_ratio = REAL(0.95);
    law->settings.negligible_wind = REAL(0.03);
    for (unsigned i = 0; i < sizeof identification->memory; i++) {
        bytes[i] = 0;
    }
    identification->begin_us = 0;
    identification->settings = settings_of(declared, law->settings.limit_deg, is_wind_known ? REAL(30.0) : REAL(0.0));
    begin_identification(&identification->memory, &identification->settings);
}

/* Times are relative to `begin_us`, which follows the clock at these intervals, seconds, as in a law. */
#define INTERVAL_S 64

static void follow_clock(loiter_identification *identification, uint32_t time_us) {
    Stamps *const stamps = &identification->memory.stamps;
    if (stamps->clock.time_s == -REAL_INFINITY) {
        identification->begin_us = time_us;
        return;
    }
    const int32_t intervals = (int32_t)real_floor(stamps->clock.time_s / (real)INTERVAL_S);
    const real past_s = (real)(intervals * INTERVAL_S);
    identification->begin_us += (uint32_t)intervals * (uint32_t)INTERVAL_S * UINT32_C(1000000);
    stamps->clock.time_s -= past_s;
    stamps->clock.first_s -= past_s;
    stamps->clock.latest_s -= past_s;
    stamps->used_s -= past_s;
}

int loiter_law_step_identified(loiter_law *law, loiter_identification *identification, const loiter_measurement *m,
                               loiter_real dt_s, loiter_command *command) {
    if (!is_step(dt_s)) {
        return LOITER_BAD_STEP;
    }
    Identification *const memory = &identification->memory;
    follow_clock(identification, m->time_us);
    const real time_s = (real)(int32_t)(m->time_us - identification->begin_us) * REAL(1e-6);
    const State state = {time_s,      m->east_m,           m->north_m,           m->heading_deg,
                         m->bank_deg, m->velocity_east_m_s, m->velocity_north_m_s, m->airspeed_m_s};
    advance_identification(memory, &identification->settings, &state, law->memory.command.bank_deg, law->memory.step_s);
    law->vehicle.revision = memory->revision;
    law->vehicle.bank_deg = memory->roll.bank_deg;
    law->vehicle.bank_rate_deg_s = memory->roll.bank_rate_deg_s;
    law->vehicle.estimates = memory->estimates;
    return loiter_law_step_known(law, m, dt_s, command);
}
