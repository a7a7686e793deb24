/* The functions of loiter.h, C99 and C++.
 *
 * Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
 *
 * SHA-256 of the source: 2ec5ff08a51330b018d751c08ee9282012adc7c41ee57b3b3e1d40c13d79ba6d
 */
#include "loiter.h"

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

typedef loiter_Rings Rings;

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


/* The direction in which the circle is held: the sign of the target's ordinate in the reduced plane, (8)-(10). */
enum { SIDE_CW = 1, SIDE_CCW = -1, SIDE_EITHER = 0 };

/* The outcome for one state of an array call; the results are nan unless it is `OK`. */
enum { STATUS_OK = 0, STATUS_NOT_FINITE = 1, STATUS_RADIUS_TOO_SMALL = 2, STATUS_OUT_OF_RANGE = 3,
        STATUS_BAD_TOLERANCE = 4, STATUS_BAD_AIRCRAFT = 5, STATUS_BAD_ORBIT = 6, STATUS_BAD_TURN = 7,
        STATUS_BAD_POSE = 8, STATUS_MALFORMED = 9, STATUS_WIND_TOO_STRONG = 10, STATUS_NOT_HELD = 11,
        STATUS_NOT_CONVERGED = 12, STATUS_BAD_WIND = 13, STATUS_BAD_SLOT = 14 };

/* The words that occur, in Dubins' letters: L (u = +1), S (u = 0), R (u = -1).
 *
 * `EMPTY` is the word of a start that is already on the circle.
 */
enum { WORD_EMPTY = 0, WORD_R = 1, WORD_L = 3, WORD_SR = 6, WORD_SL = 14, WORD_RL = 13, WORD_LR = 7, WORD_RSR = 25,
        WORD_RSL = 57, WORD_LSR = 27, WORD_LSL = 59, WORD_RLR = 29, WORD_LRL = 55 };

typedef struct { real a0, a1; } real_2;

typedef loiter_Entry Entry;

/* A word with its pieces in flying order: first arc, straight length, middle arc (or none), last arc. */
typedef struct { integer word; real_2 first; real straight; real_2 middle, last; } Extremal;

typedef struct { real a0; Extremal a1; } real_Extremal;

/* Reduced state, radius, arc tolerance, and on which side of three circles the state lies: positive outside them.
 *
 * `arc_tolerance` is the arc length by which a rotation may fall short of a full turn and count as none
 * (`angles.snap_full_turn`). `outer` is rp^2 - (R + 1)^2, `inner` rm^2 - (R - 1)^2, `fold` rp^2 - (R - 3)^2.
 */
typedef struct { real x, y, R, arc_tolerance, outer, inner, fold; } Start;

typedef struct { real a0, a1, a2; } real_3;

typedef struct { real_2 a0; real a1; } real_2_real;

typedef struct { integer a0; real a1, a2, a3; } integer_real_3;

typedef struct { integer a0, a1, a2; } integer_3;

/* An entry to find: start, heading as a unit vector, radius, `words.Side`, velocity of the air past the circle.
 *
 * A start beyond the circle, or beyond a last arc, by less than `tolerance` (turn radii) counts as on it.
 */
typedef struct { real x, y, c, s, R; integer side; real wx, wy, tolerance; } WindProblem;

typedef loiter_WindScene WindScene;

typedef loiter_Path Path;

typedef loiter_WindCandidate WindCandidate;

typedef loiter_EntryBeside EntryBeside;

typedef loiter_CellVisit CellVisit;

typedef loiter_JoinPoint JoinPoint;

typedef loiter_LeafEnd LeafEnd;

typedef loiter_Leaves Leaves;

typedef loiter_Corner Corner;

typedef loiter_Refinement Refinement;

typedef loiter_OpenCell OpenCell;

typedef loiter_WindEntry WindEntry;

typedef loiter_WindSearch WindSearch;

typedef struct { real a0, a1, a2, a3, a4; } real_5;

typedef struct { real a0, a1, a2, a3; } real_4;

typedef struct { Entry a0; real a1; } Entry_real;

/* An arc that ends with the heading of a point of joining: its duration, and how far along the hold it is short. */
typedef struct { real t, short_; } ArcEnd;

/* The data common to all words: the headings (c0, s0) at the start and (c, s) at the pose, and the wind.
 *
 * `arc_tolerance` is the arc length by which a rotation may fall short of a full turn and count as none
 * (`angles.snap_full_turn`).
 */
typedef struct { real c0, s0, c, s, wx, wy, arc_tolerance; } Ends;

/* An arc of the circle, and what all words share: derivatives are with respect to the phase.
 *
 * `half` is half its width; (px, py) the point in its middle, from the start, and (c, s) the heading there; (tx,
 * ty) the derivative of the point, and (nx, ny) its second derivative; `turning` and `turned_more` those of the
 * angle of the heading. `fastest_turning`, `twist` and `jerk` bound the first three derivatives of that angle,
 * `bend` and `bend_change` the second and the third derivative of the centre of the last arc. (c0, s0) is the
 * heading at the start, (wx, wy) the wind, `wind` its size.
 */
typedef struct { real half, px, py, c, s, tx, ty, nx, ny, turning, turned_more, bend, bend_change, twist, jerk,
        fastest_turning, wind, c0, s0, wx, wy; } Cell;

/* The vector from the centre of the first arc to that of the last at time 0 and two derivatives by the phase.
 *
 * `change` bounds how much the vector differs from that inside the cell, `fastest` its derivative.
 */
typedef struct { real x, y, dx, dy, ddx, ddy, change, fastest; } Centres;

typedef struct { integer a0; LeafEnd a1; JoinPoint a2; } integer_LeafEnd_JoinPoint;

typedef struct { Path a0; real a1; } Path_real;

typedef struct { real a0; WindCandidate a1; } real_WindCandidate;

typedef loiter_RollValues RollValues;

typedef loiter_VehicleEstimates VehicleEstimates;

typedef loiter_VehicleModel VehicleModel;

typedef loiter_Settings Settings;

typedef loiter_Clock Clock;

typedef loiter_Difference Difference;

typedef loiter_AlongFlight AlongFlight;

typedef loiter_AirSample AirSample;

typedef loiter_AirSample_ring_64 *AirSample_ring_64;

static inline AirSample_ring_64 AirSample_ring_64_filled(AirSample_ring_64 ring, AirSample one) {
    for (int i = 0; i < 64; i++) {
        ring->at[i] = one;
    }
    return ring;
}

static inline AirSample_ring_64 AirSample_ring_64_with_last(AirSample_ring_64 ring, AirSample last) {
    ring->at[63] = last;
    return ring;
}

static inline AirSample_ring_64 AirSample_ring_64_appended(AirSample_ring_64 ring, AirSample last) {
    for (int i = 0; i < 63; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[63] = last;
    return ring;
}

typedef loiter_AirAverage AirAverage;

typedef loiter_PlanarPose PlanarPose;

typedef loiter_Turning Turning;

typedef loiter_Estimate Estimate;

typedef loiter_Observer Observer;

typedef loiter_BankEntry BankEntry;

typedef loiter_BankEntry_ring_128 *BankEntry_ring_128;

static inline BankEntry_ring_128 BankEntry_ring_128_filled(BankEntry_ring_128 ring, BankEntry one) {
    for (int i = 0; i < 128; i++) {
        ring->at[i] = one;
    }
    return ring;
}

static inline BankEntry_ring_128 BankEntry_ring_128_with_last(BankEntry_ring_128 ring, BankEntry last) {
    ring->at[127] = last;
    return ring;
}

static inline BankEntry_ring_128 BankEntry_ring_128_appended(BankEntry_ring_128 ring, BankEntry last) {
    for (int i = 0; i < 127; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[127] = last;
    return ring;
}

typedef loiter_BankHistory BankHistory;

typedef loiter_Sensing Sensing;

typedef loiter_TurnLimits TurnLimits;

typedef loiter_Limits Limits;

typedef loiter_RoutePiece RoutePiece;

typedef loiter_Route Route;

typedef loiter_Plan Plan;

typedef loiter_PathPiece PathPiece;

typedef loiter_PathPiece_ring_12 *PathPiece_ring_12;

static inline PathPiece_ring_12 PathPiece_ring_12_filled(PathPiece_ring_12 ring, PathPiece one) {
    for (int i = 0; i < 12; i++) {
        ring->at[i] = one;
    }
    return ring;
}

static inline PathPiece_ring_12 PathPiece_ring_12_with_last(PathPiece_ring_12 ring, PathPiece last) {
    ring->at[11] = last;
    return ring;
}

static inline PathPiece_ring_12 PathPiece_ring_12_appended(PathPiece_ring_12 ring, PathPiece last) {
    for (int i = 0; i < 11; i++) {
        ring->at[i] = ring->at[i + 1];
    }
    ring->at[11] = last;
    return ring;
}

typedef loiter_GivenPath GivenPath;

typedef loiter_Leads Leads;

typedef loiter_RelativeState RelativeState;

typedef loiter_PathOffset PathOffset;

typedef loiter_ResponsePoint ResponsePoint;

typedef loiter_EntrySearch EntrySearch;

typedef loiter_Planning Planning;

typedef loiter_LawCommand LawCommand;

typedef loiter_Memory Memory;

typedef struct { bool a0; real a1, a2; } bool_real_2;

/* When a change of turn rate takes effect: the mean of the times at which its parts do, and their variance.
 *
 * After the change the aircraft flies as if it had changed its turn rate instantly after `lead_s` seconds, but it
 * is displaced towards the new turn by half of `variance_s2` times airspeed times the change of turn rate.
 */
typedef struct { real lead_s, variance_s2; } TurnOnset;

/* A bank and its rate, which counts only where that has a lag; degrees and degrees per second. */
typedef struct { real bank_deg, rate_deg_s; } Bank;

/* A bank, and the command that it follows at present, which counts only where that has a slew rate; degrees. */
typedef struct { Bank now; real command_deg; } BankState;

/* How a change of bank delays a turn.
 *
 * With w the turn rate divided by g/V, and w1 the one after the change: `missing_s` is the integral of w1 - w over
 * time, and `moment_s2` that of the same times the time.
 */
typedef struct { real missing_s, moment_s2; } TurnDelay;

/* A short step of a bank whose rate has a lag: its time, seconds, and the share of the present rate.
 *
 * `kept` is the share at the end of the step, `share` that on average in the change of bank.
 */
typedef struct { real time_s, kept, share; } RollStep;

/* An aircraft at an instant, true or as measured by its sensors.
 *
 * Position in local metres east and north, heading of the nose, bank, velocity over the ground and true airspeed
 * (metres per second).
 */
typedef struct { real time_s, east_m, north_m, heading_deg, bank_deg, velocity_east_m_s, velocity_north_m_s,
        airspeed_m_s; } State;

typedef struct { Clock a0; bool a1; } Clock_bool;

/* The direction of flight (c, s), a unit vector, and the turn rate, radians per second. */
typedef struct { real c, s, turn_rate; } AirMotion;

/* An entry to fly: side, word and durations, the turn radius and the speed, and the velocity of the air.
 *
 * The air moves past the circle with the wind, metres per second; `speed_m_s` is the speed relative to that air.
 * The side is 0 where there is no entry.
 */
typedef struct { integer side, word; real t1_s, t2_s, t3_s, turn_radius_m, speed_m_s, wind_east_m_s, wind_north_m_s;
        } PlannedEntry;

typedef struct { RoutePiece a0; real a1, a2; } RoutePiece_real_2;

/* Position and velocity, relative to the steady wind of a plan, as if the air were still. */
typedef struct { real x, y, vx, vy; } Motion;

typedef struct { GivenPath a0; Route a1; } GivenPath_Route;

typedef struct { GivenPath a0; RoutePiece a1; real a2; } GivenPath_RoutePiece_real;


/* Rounding error of a length of order one: the reduction (2) costs 2 roundings a coordinate, a difference of
 * squares 6, the angle and the flight of each of three pieces about 10; 64 units of 2**-52 is the next power of two
 * above the sum.
 */
#ifdef LOITER_FLOAT
#define ROUNDING REAL(7.62939453125e-06)
#else
#define ROUNDING REAL(1.4210854715202004e-14) /* 64.0 * 2.0 ** (-52) */
#endif

/* Dekker's splitting factor, 2^27 + 1, halves the 53 digits of a double. */
#ifdef LOITER_FLOAT
#define SPLITTER REAL(4097.0)
#else
#define SPLITTER REAL(134217729.0)
#endif

/* A rotation multiplied by less could have subnormal components, which have lost digits. Below this distance the
 * rounding error of c - end x itself is negligible.
 */
#ifdef LOITER_FLOAT
#define SMALLEST_SCALE REAL(1.4551915228366852e-11)
#else
#define SMALLEST_SCALE REAL(4.909093465297727e-91) /* 2.0 ** (-300) */
#endif
static const real_2 NO_ROTATION = {REAL(0.0), REAL(1.0)};

/* Added to inner products, so that a zero vector gives the rotation by zero. It is negligible for vectors longer
 * than 1e-37, and a product of three of them does not underflow.
 */
#ifdef LOITER_FLOAT
#define TINY REAL(1.4551915228366852e-11)
#else
#define TINY REAL(4.909093465297727e-91) /* 2.0 ** (-300) */
#endif
#define TWO_PI REAL(6.283185307179586) /* 2.0 * pi */

/* The control of a piece that the word does not have. */
#define ABSENT (-2)

/* Beyond this many turn radii neighbouring doubles are a turn radius apart. */
#ifdef LOITER_FLOAT
#define REACH REAL(8388608.0)
#else
#define REACH REAL(4503599627370496.0) /* 2.0 ** 52 */
#endif
static const WindSearch NO_SEARCH = {0, 0, 1, {REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0), REAL(1.0), REAL(0.0), REAL(0.0), REAL(0.0)}, {REAL(0.0), 0, {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}}, {{0, 0, REAL_INFINITY, REAL(0.0), REAL(0.0)}, REAL(0.0), REAL_INFINITY}, {0, 0, 63}, {-2, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}}, {0, 0, 0, 0}, {0, 0, 0, 0}, {REAL(0.0), 0, REAL(0.0), REAL(0.0)}, REAL_INFINITY, 0, {0, 0, REAL(0.0), {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, 0, false, 0, 0}, {0, REAL(0.0), REAL(0.0)}, 0, {12, 0, 0, REAL_NAN, REAL_NAN, REAL_NAN, REAL_NAN, REAL_NAN}};

/* The stages of a search: on each side, first some points, then cells down to the leaves, then the leaves that are
 * left.
 */
#define ENDED 5

/* A slower wind displaces no point within REACH by as much as rounding, and its square would be subnormal. */
#ifdef LOITER_FLOAT
#define NEGLIGIBLE_WIND REAL(1.7763568394002505e-15)
#else
#define NEGLIGIBLE_WIND REAL(3.8725919148493183e-121) /* 2.0 ** (-400) */
#endif
static const EntryBeside NO_ENTRY_BESIDE = {{0, 0, REAL_INFINITY, REAL(0.0), REAL(0.0)}, REAL(0.0), REAL_INFINITY};

/* Newton's method reduces an error of 1e-4 to rounding in three steps. */
#define ARC_STEPS 8

/* Points of joining around the circle between which single arcs are looked for. */
#define ARC_SAMPLES 32

/* The path found next to two arcs may be too early by this many times its miss: both vary with the adjoint, whose
 * length over lambda + p . w stays below 10 where lambda = 1 and |w| < 0.9.
 */
#define TOO_EARLY REAL(10.0)

/* Where two arcs are the fastest, the search ends on a word with a short third piece that is due to rounding: a
 * straight piece of up to the square root of 4e-14 where the phase is accurate to 1e-14.
 */
#ifdef LOITER_FLOAT
#define SHORT REAL(0.01522185107203483)
#else
#define SHORT REAL(0.0001)
#endif

/* The stages of a refinement; there is none, or it has ended, where it is REFINED. */
#define REFINED 0
#define BRACKETING 1

/* Sets of the six words of three pieces, a bit for each: all, and those with a straight piece. */
#define ALL_WORDS 63
static const Path NO_PATH = {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)};

/* An arc that comes this close to a whole turn, or to zero, may pass it. */
#ifdef LOITER_FLOAT
#define ALMOST REAL(0.0008127493386077178)
#else
#define ALMOST REAL(1e-06)
#endif

/* Here Newton's method approaches every root from the side on which it converges monotonically. Each step squares
 * the error, or halves it near a double root; 60 halvings are more than the digits of a double.
 */
#define NEWTON_STEPS 60

/* The next step of Newton's method for LSR or RSL is left out where it would be less than the time times this over
 * 2 (1 - |w|).
 */
#ifdef LOITER_FLOAT
#define NO_STEP REAL(1.862645149230957e-09)
#else
#define NO_STEP REAL(3.469446951953614e-18) /* 2.0 ** (-58) */
#endif

/* Steps, each twice as long as the last, that together go round the circle from a leaf of `wind_search`. */
#define BRACKETING_STEPS 7
#define ENCLOSING 2

/* The search ends where another step is worth less than the time over this. */
#ifdef LOITER_FLOAT
#define WORTH REAL(16777216.0)
#else
#define WORTH REAL(9007199254740992.0) /* 2.0 ** 53 */
#endif
#define COMPARING 3

/* A point of two arcs is a local minimum unless the time falls away from it this far before or after it, in
 * radians. The phase of such a point is known to some 1e-15, and the time changes by no more than a few times this
 * up to there.
 */
#ifdef LOITER_FLOAT
#define AT_CORNER REAL(0.000536870912)
#else
#define AT_CORNER REAL(1e-12)
#endif

/* At worst every other step of `enclose` bisects, so 106 steps exhaust the digits of a double; 14 are in reserve. */
#define REFINING_STEPS 120

/* A faster path is sought this far before and after a local minimum, in radians; this is multiplied by the time
 * where that is below 1.
 */
#ifdef LOITER_FLOAT
#define BESIDE REAL(0.002317047500592079)
#else
#define BESIDE REAL(1e-07)
#endif
static const Refinement NO_REFINEMENT = {0, 0, REAL(0.0), {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, 0, false, 0, 0};

/* Refinements after which no path to the point, or to a point beside it, is faster; the second is rarely needed. */
#define REFINEMENTS 4
#define JOINING 0
static const CellVisit FIRST_CELL = {0, 0, 63};
#define COARSE_OTHER 2

/* Cells at first. Those that may hold a faster path than the best are halved to 2 pi/128, where local minima are
 * found, and then until none may hold a path that is faster by more than `time_tolerance`: the hold through a cell
 * of the level `LAST` takes less than that. The bound by the hold, which takes a path, is used from 2 pi/32 on.
 */
#define FIRST_CELLS 8
#define LEAF 4
static const LeafEnd NO_LEAF_END = {-2, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}};
static const Corner NO_CORNER = {REAL(0.0), 0, REAL(0.0), REAL(0.0)};
#ifdef LOITER_FLOAT
#define LAST 15
#else
#define LAST 44
#endif

/* The last level to which a cell hands on its words: five sets of six bits, from the first level or from `LEAF` on,
 * fit into the integers of JavaScript.
 */
#ifdef LOITER_FLOAT
#define NARROWED 3
#else
#define NARROWED 8
#endif

/* Points of joining on each side that are tried first. */
#define JOINS 8
#define WITH_STRAIGHT 15
static const JoinPoint NO_POINT = {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)};

/* Tangents to h that `has_no_middle` tries. */
#define TANGENTS 8
#define COARSE 2

/* A quarter of the cells of the level `LEAF`: as many as there are bits in the integers of JavaScript. */
#define LEAVES 32 /* FIRST_CELLS << LEAF - 2 */
static const WindCandidate NO_CANDIDATE = {REAL(0.0), 0, {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}};

/* After so many cells of the level `LEAF` and below, the tolerance is `hold_tolerance`. More are needed only in
 * degenerate scenes, some of those in still air with R = 1 or 2; the slowest others found take some 2,500.
 */
#define MOST_VISITS 4096

/* In wind maneuvers tie if their times agree to this share of 1 + R + T: the accuracy found in docs/wind.md,
 * section 6.
 */
#ifdef LOITER_FLOAT
#define WIND_TIE_TOLERANCE REAL(0.000536870912)
#else
#define WIND_TIE_TOLERANCE REAL(1e-12)
#endif

/* The arc of the circle that is held for `hold_tolerance`. */
#define UNKNOWN_ARC REAL(0.0015339807878856412) /* TWO_PI / 4096.0 */

/* In cells within this many half widths of the end of the best path, bounds around that end are tried too. */
#define NEAR_BEST REAL(8.0)

/* 4/3 (TURNS/2)^3. */
#define CUBE REAL(0.288) /* TURNS * TURNS * TURNS / 6.0 */

/* A vector that is displaced by a share of its length turns by less than this times that share, up to two thirds. */
#define TURNS REAL(1.2)

/* The angle by which the other arc may change while one vanishes. */
#define SWING REAL(1.5707963267948966) /* 0.5 * pi */
#define STANDARD_GRAVITY_M_S2 REAL(9.80665)
static const Clock FIRST_CLOCK = {-REAL_INFINITY, REAL(0.0), REAL_INFINITY, REAL(0.0), REAL_NAN, REAL_NAN};

/* What is assumed until then, as if it had been measured for the last time, seconds: gusts of about 10 % of the
 * airspeed, as the mean square change of each component in a second, and noise of 0.4 m/s; (m/s)^2.
 */
#define FIRST_NOISE REAL(0.16)

/* How fast the velocity of the air changes is measured from its differences over this time, seconds, averaged over
 * the second time.
 */
#define GUST_LAG_S REAL(1.0)
#define FIRST_GUST REAL(0.6)
#define ASSUMED_S REAL(1.0)
static const AlongFlight CALM_ALONG = {REAL(0.0), REAL(0.0), REAL(3.0)};

/* The ring of the last measurements. Where it would not cover the lag, those that follow each other sooner than
 * this, seconds, are left out.
 */
#define SAMPLES 64
static const Estimate NO_ESTIMATE = {-REAL_INFINITY, {REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0)}, REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), {REAL(1.0), REAL(0.0)}};
static const Limits NO_LIMITS = {-1, false, REAL(0.0), REAL(0.0), {REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)}, REAL(0.0), {REAL(1.0), REAL(1.0), REAL(1.0)}, REAL(0.0), 0, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)};

/* The wind is planned as estimated, not as declared, where they differ by the first share of the airspeed, until
 * they differ by less than the second.
 */
#define WIND_KEPT REAL(0.05)
#define WIND_DIFFERS REAL(0.1)

/* An aircraft that hardly exceeds the wind can hold no circle; wind beyond this share of the airspeed is planned as
 * if it were weaker.
 */
#define STRONGEST_WIND REAL(0.95)

/* Where the bank overshoots its limit, less than that is commanded, but at least this multiple of the circle's
 * bank.
 */
#define LEAST_LIMIT REAL(1.2)

/* The delays of changes of bank are computed again when the time constant or the rate of the roll changes by this
 * share.
 */
#define ROLL_CHANGED REAL(0.01)

/* The commanded change of bank is this many times the change that is wanted, where the limits leave room, but no
 * more than makes the time constant this, seconds: a roll that is quick gains nothing, and errors would be
 * amplified.
 */
#define QUICKEST_S REAL(0.15)
#define COMMAND_GAIN REAL(2.5)

/* The damping of a bank whose rate has a lag, under these commands. */
#define DAMPING REAL(0.8)

/* A smaller change of bank, degrees, takes effect like an infinitely small one where neither it nor its rate is
 * limited.
 */
#define SMALL_CHANGE_DEG REAL(5.0)

/* Gauss-Legendre points and weights on [0, 1], and Gauss-Laguerre points x, exp(-x) and weights. */
static const real_3 LEGENDRE_POINTS = {REAL(0.1127016653792583), REAL(0.5), REAL(0.8872983346207417)};
static const real_3 LEGENDRE_WEIGHTS = {REAL(0.2777777777777778), REAL(0.4444444444444444), REAL(0.2777777777777778)};
static const real_3 LAGUERRE_POINTS = {REAL(0.4157745567834791), REAL(2.294280360279042), REAL(6.2899450829374794)};
static const real_3 LAGUERRE_SHARES = {REAL(0.6598290076917097), REAL(0.10083393126672065), REAL(0.0018548618076203868)};
static const real_3 LAGUERRE_WEIGHTS = {REAL(0.711093009929173), REAL(0.27851773356924087), REAL(0.010389256501586137)};

/* The largest number of steps in which a change of a bank whose rate has a lag is flown. */
#define STEPS 24

/* These last for the change at the limit of the roll rate, and for so many time constants more. */
#define SETTLING REAL(1.5)

/* For fewer lags of the bank rate its effect is a series, of which the first term that is left out is 1.4e-6 here. */
#define SHORT_LAGS REAL(0.1)

/* The reserve grows by this share for each radian that the aircraft could turn during the delay of its roll: the
 * slower the roll, the farther an error of its estimate takes the aircraft off the last arc.
 */
#define ROLL_RESERVE REAL(0.8)

/* The gain of course corrections is reduced by this share of the delay: a part of it is not predicted exactly. */
#define DELAY_SHARE REAL(1.0)
static const Plan NO_PLAN = {{0, {-2, REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0)}, {-2, REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0)}, {-2, REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0)}, REAL(0.0), -2, REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0), REAL(0.0)}, REAL(0.0), REAL_INFINITY, REAL_INFINITY, -REAL_INFINITY};
static const Leads NO_LEADS = {-1000000000, 0, 0, 0, 0, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)};
static const ResponsePoint NO_RESPONSE = {{REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)}, {REAL(0.0), REAL(0.0), REAL(0.0)}, REAL(0.0)};
static const EntrySearch NO_ENTRY_SEARCH = {0, {REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)}, {REAL(1.0), REAL(1.0), REAL(1.0)}, REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), 0, false, false, false, {0, 0, 1, {REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0), REAL(1.0), REAL(0.0), REAL(0.0), REAL(0.0)}, {REAL(0.0), 0, {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}}, {{0, 0, REAL_INFINITY, REAL(0.0), REAL(0.0)}, REAL(0.0), REAL_INFINITY}, {0, 0, 63}, {-2, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}}, {0, 0, 0, 0}, {0, 0, 0, 0}, {REAL(0.0), 0, REAL(0.0), REAL(0.0)}, REAL_INFINITY, 0, {0, 0, REAL(0.0), {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, {REAL(0.0), {REAL_INFINITY, 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0), REAL(1.0), REAL(0.0)}, REAL(0.0)}, 0, false, 0, 0}, {0, REAL(0.0), REAL(0.0)}, 0, {12, 0, 0, REAL_NAN, REAL_NAN, REAL_NAN, REAL_NAN, REAL_NAN}}};

/* What a command does: the control that it flies, +1 to the left; or one of these. */
#define NO_DATA 3

/* The history covers at least this time, seconds, in this many entries. */
#define ENTRIES 128

/* The largest plausible time stamp, seconds: 32,000 years, where a double still resolves a tenth of a millisecond. */
#define LATEST_S REAL(1000000000000.0)

/* Bounds of a plausible measurement: the largest value in metres, degrees or metres per second, the least airspeed. */
#define LARGEST_VALUE REAL(1000000000.0)
#define LEAST_AIRSPEED_M_S REAL(0.1)

/* Until the next measurement arrives the last one is extrapolated, but no longer than this, seconds; older ones are
 * not averaged with new ones.
 */
#define EXTRAPOLATED_S REAL(3.0)

/* A turn through a smaller angle, radians, is flown as a straight line: the difference is below the rounding error. */
#ifdef LOITER_FLOAT
#define SMALLEST_TURN REAL(2.9802322387695312e-08)
#else
#define SMALLEST_TURN REAL(5.551115123125783e-17) /* 2.0 ** (-54) */
#endif

/* A stamp is accepted at once unless it is later by more than this, seconds, than the last one plus the time that
 * has passed since. So a law that was not called for an hour continues at once.
 */
#define LARGEST_GAP_S REAL(3600.0)

/* A clock that has jumped back, or further ahead, is accepted once its stamps have advanced by this, seconds. No
 * single step between them may be larger: two stamps alone do not confirm a clock.
 */
#define CONFIRMATION_S REAL(1.0)

/* In calm air, where gusts turn the course by less than `CALM_COURSE` in a second, radians, only noise is left:
 * averages take longer, up to this multiple. They have at least this many measurements; of their mean interval each
 * is this share, and a longer one, seconds, counts as that.
 */
#define INTERVAL_SHARE REAL(0.05)
#define LONGEST_INTERVAL_S REAL(0.3)
#define CALM_COURSE REAL(0.02)
#define CALM_MULTIPLE REAL(1.6)
#define LEAST_COUNT REAL(5.0)
#define GUST_AVERAGE_S REAL(10.0)

/* On the circle gusts are measured anew, as if none had been measured for the first time, seconds. Differences over
 * which the turn rate changes by the second, radians per second, count half: the slip changes with it, like a gust.
 */
#define TURN_CHANGE REAL(0.1)
#define SAMPLE_GAP_S REAL(0.016129032258064516) /* GUST_LAG_S / (SAMPLES - 2) */

/* The aim of no search. */
#define NOTHING 0

/* The least speed along the heading, as a share of the airspeed, from which a course is taken: below it the
 * measured velocity is not that of an aircraft in flight.
 */
#define LEAST_SPEED REAL(0.05)
static const RoutePiece NO_PIECE = {-2, REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0)};

/* A flight that begins on the circle, within half of the reserve and this angle, radians, holds it at once. */
#define ON_COURSE REAL(0.09)

/* The interval between searches for another plan, seconds. */
#define SEARCH_INTERVAL_S REAL(0.1)

/* A piece with less than this left, seconds, is complete but for rounding. */
#ifdef LOITER_FLOAT
#define ROUNDING_S REAL(0.000131072)
#else
#define ROUNDING_S REAL(1e-09)
#endif

/* What a search is for: the first turn of the first plan, as it would be with wings level; any plan; a plan that is
 * better than the present one; or one that is better or is the present one from the present state. `NOTHING` is
 * none.
 */
#define FIRST_TURN 1

/* Rates of the bank count in steps of so many half degrees per second. */
#define RATE_STEPS REAL(4.0)

/* Gusts are heavy where they change the course by this angle in a second, radians. */
#define HEAVY_GUSTS REAL(0.04)

/* The last turn, where it is opposite to the circle, is aimed again from the present state as long as so much of
 * the present piece is left, seconds, the turn is no wider than this multiple of a planned one, and the time to
 * join changes by no more than the third number, seconds.
 */
#define WIDEST_AIMED REAL(8.0)

/* Beyond this crosstrack error, turn radii, or course error, radians, the aircraft is lost: any new plan is
 * accepted.
 */
#define LOST_OFFSET REAL(0.5)
#define AIMED_LEFT_S REAL(0.2)
#define AIM_CHANGE_S REAL(1.0)
#define LOST_COURSE REAL(1.0)
#define ANY 2

/* In wind a new plan counts as the same one if it differs only by a first turn back to the path that is no longer
 * than `LONGEST_BEND`, turn radii. It is not adopted before the crosstrack error or the change of the time to join
 * exceeds `DEVIATION`, turn radii: each adds such a turn.
 */
#define DEVIATION REAL(0.1)
#define UPDATE 4
#define BETTER 3

/* More steps than any search takes. */
#define UNLIMITED 2147483647 /* 2 ** 31 - 1 */

/* The answer of the kernel where there is no entry. */
static const Entry NONE = {0, 0, REAL(0.0), REAL(0.0), REAL(0.0)};
#define LONGEST_BEND REAL(0.1)

/* Margins, turn radii over airspeed. A different plan replaces the present one if it is faster by the first margin,
 * the same plan, made again from the present state, if it is slower by no more than the second. Sensor noise
 * changes the least time by less than these margins, except where that time jumps; there the present plan is the
 * fastest.
 */
#define UPDATE_MARGIN REAL(0.25)
#define SWITCH_MARGIN REAL(0.25)

/* Without a usable measurement the last command is kept for this time, seconds. */
#define BLIND_S REAL(1.0)

/* On the circle it falls so far that course errors are corrected at this rate, 1/s, or at this multiple of that at
 * which crosstrack errors are, but not below the last share. It rises with the square of the gusts, to the whole
 * where they change the course by `ROUGH_HOLD` in a second. A vehicle that turns more quickly than its bank says
 * where that changes would swing about the circle otherwise.
 */
#define HOLD_RATE REAL(1.3)
#define HOLD_MULTIPLE REAL(6.0)

/* On the circle crosstrack errors are corrected over an arc of 1/HOLD_GAIN radians, so that the intercept angle
 * depends only on the ratio of the error to the radius.
 */
#define HOLD_GAIN REAL(1.2)

/* In calm air the gain of course corrections falls to this share: only noise would be corrected. The air is rough
 * where gusts change the course by this angle in a second, radians (root mean square).
 */
#define CALM_GAIN REAL(0.75)
#define CALM_HOLD_GAIN REAL(0.35)
#define ROUGH_HOLD REAL(0.02)
#define ROUGH_AIR REAL(0.02)

/* In heavy gusts it rises in proportion to them, up to this multiple. */
#define HEAVY_GAIN REAL(1.5)

/* The gains of course and crosstrack corrections, to be divided by the response time: the delay of a change of bank
 * plus the averaging time. A faster correction of crosstrack errors would need an intercept angle of several
 * degrees.
 */
#define PLACE_GAIN REAL(0.25)

/* There the part of a crosstrack error beyond this, radii, counts twice in calm air, so that the aircraft returns
 * more steeply; in rough air, as for `ROUGH_HOLD`, it counts once.
 */
#define STEEP_OFFSET REAL(0.035)

/* The steepest intercept angle onto a path, radians: a vehicle far off turns towards the path, not all the way
 * round.
 */
#define STEEPEST_INTERCEPT REAL(0.6)

/* On the circle the mean crosstrack error is driven to zero by a correction of the rate of turn: at this share of
 * the gain of course corrections, but no more than the second number, 1/s, which suits gusts. It is at most the
 * third share of the circle's rate of turn, and changes only while the error is less than the fourth, in radii.
 */
#define TRIMMED_OFFSET REAL(0.05)
#define TRIM_GAIN REAL(0.25)
#define LARGEST_TRIM_GAIN REAL(0.4)
#define LARGEST_TRIM REAL(0.15)
#define HOLD 2

/* The reduced state (2) of a vehicle at (x, y), relative to the circle's centre, with the unit heading (c, s). */
static inline real_2 reduce(real x, real y, real c, real s) {
    return MAKE(real_2){x * c + y * s, y * c - x * s};
}

/* R, or 1 where R is less than 1 by rounding only: a circle as tight as the aircraft can turn. */
static inline real rounded_radius(real R) {
    return REAL(1.0) - ROUNDING <= R && R < REAL(1.0) ? REAL(1.0) : R;
}

/* The plain number of a member of `Word`, `Side` or `Status`, which Python answers in as compiled code does. */
static inline integer code(integer member) {
    return member + 0;
}

/* The side that is never slower: T_either(x, y) = T_cw(x, |y|) (paper, section 5); clockwise on y = 0. */
static inline integer near_side(real y) {
    return y < REAL(0.0) ? -1 : 1;
}

/* The side itself; for *either*, the near side. */
static inline integer side_or_near(real y, integer side) {
    return side != SIDE_EITHER ? code(side) : near_side(y);
}

/* The length tolerance: the rounding error of lengths for a state and a circle of this size. */
static inline real rounding(real x, real y, real R) {
    return ROUNDING * (REAL(1.0) + real_fabs(x) + real_fabs(y) + R);
}

/* The share of the end-point tolerance that each of at most three pieces may use up. */
static inline real arc_tolerance_of(real x, real y, real R, real tolerance) {
    return max_real(tolerance, rounding(x, y, R)) / REAL(3.0);
}

/* The rounded sum a + b, and its rounding error, exactly. */
static inline real_2 two_sum(real a, real b) {
    const real s = a + b;
    const real t = s - a;
    return MAKE(real_2){s, a - (s - t) + (b - t)};
}

/* A double as the sum of two of 26 digits. */
static inline real_2 split(real a) {
    const real c = SPLITTER * a;
    const real high = c - (c - a);
    return MAKE(real_2){high, a - high};
}

/* The rounded product a b, and its rounding error, exactly for |a|, |b| < 2^480. */
static inline real_2 two_product(real a, real b) {
    const real p = a * b;
    const real_2 split_1 = split(a);
    const real ah = split_1.a0, al = split_1.a1;
    const real_2 split_2 = split(b);
    const real bh = split_2.a0, bl = split_2.a1;
    return MAKE(real_2){p, ah * bh - p + ah * bl + al * bh + al * bl};
}

/* The squared distances rp^2 - (R + 1)^2, rm^2 - (R - 1)^2 and rp^2 - (R - 3)^2 beyond three circles.
 *
 * They are `beyond` with R and 2, R and -2, 2 - R and 2. The last is the sum u + d + low, with an error of third
 * order only: at R = 1 + 2e-14 there are doubles next to (-sqrt(3), 0) where it is 8e-32, and where T would lose
 * 1e-9 for the terms that `beyond` leaves out. The others differ from it by -8 (R - 1) and -4 (y + R - 2); for them
 * an error of second order is enough, since next to their circles a single arc replaces the words that depend on
 * them.
 */
static inline real_3 beyond_circles(real x, real y, real R) {
    const real_2 two_sum_1 = two_sum(y, R - REAL(2.0));
    const real s = two_sum_1.a0, es = two_sum_1.a1;
    const real_2 two_sum_2 = two_sum(y, REAL(2.0) - R);
    real t = two_sum_2.a0;
    const real et = two_sum_2.a1;
    const real_2 two_sum_3 = two_sum(t, REAL(2.0));
    t = two_sum_3.a0;
    const real ek = two_sum_3.a1;
    const real_2 two_sum_4 = two_sum(et, ek);
    const real e = two_sum_4.a0, ee = two_sum_4.a1;
    const real_2 two_product_5 = two_product(s, t);
    const real p = two_product_5.a0, ep = two_product_5.a1;
    const real_2 two_product_6 = two_product(x, x);
    const real q = two_product_6.a0, eq = two_product_6.a1;
    const real_2 two_product_7 = two_product(s, e);
    const real v = two_product_7.a0, ev = two_product_7.a1;
    const real_2 two_product_8 = two_product(t, es);
    const real w = two_product_8.a0, ew = two_product_8.a1;
    const real_2 two_sum_9 = two_sum(q, p);
    const real u = two_sum_9.a0, eu = two_sum_9.a1;
    const real_2 two_sum_10 = two_sum(ep, eq);
    const real a = two_sum_10.a0, ea = two_sum_10.a1;
    const real_2 two_sum_11 = two_sum(v, w);
    const real b = two_sum_11.a0, eb = two_sum_11.a1;
    const real_2 two_sum_12 = two_sum(a, b);
    const real c = two_sum_12.a0, ec = two_sum_12.a1;
    const real_2 two_sum_13 = two_sum(eu, c);
    const real d = two_sum_13.a0, ed = two_sum_13.a1;
    const real low = es * e + s * ee + (ev + ew + (ea + eb + (ec + ed)));
    const real_2 two_sum_14 = two_sum(u, -REAL(8.0) * (R - REAL(1.0)));
    const real f = two_sum_14.a0, ef = two_sum_14.a1;
    const real_2 two_sum_15 = two_sum(u, -REAL(4.0) * s);
    const real g = two_sum_15.a0, eg = two_sum_15.a1;
    return MAKE(real_3){f + (ef + d), g + (eg + d - REAL(4.0) * es), u + d + low};
}

/* The start at a reduced state. */
static inline Start start_at(real x, real y, real R, real arc_tolerance) {
    const real_3 beyond_circles_1 = beyond_circles(x, y, R);
    const real outer = beyond_circles_1.a0, inner = beyond_circles_1.a1, fold = beyond_circles_1.a2;
    return MAKE(Start){x, y, R, arc_tolerance, outer, inner, fold};
}

/* The rotation, or that by zero where it is less than a full turn by at most `arc_tolerance` of arc length.
 *
 * `radius2` is the square of the radius of the arc. Leaving out the full turn moves the end point by at most
 * `arc_tolerance`; it removes the jump of T that rounding or noise would cause where an arc vanishes
 * (docs/theory.md, section 6). The missing angle is replaced by its tangent, which is no smaller.
 */
static inline real_2 snap_full_turn(real_2 rotated, real radius2, real arc_tolerance) {
    const real cross = rotated.a0, dot = rotated.a1;
    const bool nearly_full = (cross < REAL(0.0) && REAL(0.0) < dot) && cross * cross * radius2 <= arc_tolerance *
            arc_tolerance * dot * dot;
    return MAKE(real_2){nearly_full ? REAL(0.0) : rotated.a0, nearly_full ? dot : rotated.a1};
}

/* The rotation of a left turn from (x, y) to the point (end c, 0) of the axis y = 0, end = -1 or +1; and c.
 *
 * c is sqrt(rp^2 - 1), or -1 where the turn never meets the axis (rp < 1). A right turn is the mirror image: pass
 * -y. The cross product is end (c y + c - end x); where end x > 0, c - end x = y (y + 2) / (c + end x), so the
 * rotation has exactly the sign of y.
 */
static inline real_2_real onto_axis(real x, real y, real end_, real arc_tolerance) {
    const real rise = y * (y + REAL(2.0));
    const real c2 = x * x + rise;
    const real c = real_sqrt(max_real(c2, REAL(0.0)));
    const real along = end_ * x;
    /* Both products are multiplied by c + along where that is safe, which saves a division. */
    const real scale = along > SMALLEST_SCALE ? c + along : REAL(1.0);
    const real gap = along > SMALLEST_SCALE ? rise : c - along;
    const real_2 products = MAKE(real_2){end_ * (c * y * scale + gap), (c * along + y + REAL(1.0)) * scale};
    return MAKE(real_2_real){snap_full_turn(products, c2 + REAL(1.0), arc_tolerance), c2 >= REAL(0.0) ? c :
            -REAL(1.0)};
}

/* LSL: onto the axis at (-c, 0), straight to (-X, 0), X = sqrt(R (R + 2)), left for acos(1/(R + 1)).
 *
 * `y` is the ordinate of the start, with the opposite sign for RSL. `joins` says whether c >= X, decided as in the
 * selection of words; rounding may still make c - X negative.
 */
static inline Extremal external_join(integer word, real y, const Start *start, bool joins) {
    const real R = start->R;
    const real_2_real onto_axis_1 = onto_axis(start->x, y, -REAL(1.0), start->arc_tolerance);
    const real_2 first = onto_axis_1.a0;
    const real c = onto_axis_1.a1;
    const real X = real_sqrt(R * (R + REAL(2.0)));
    return MAKE(Extremal){word, first, joins ? max_real(c - X, REAL(0.0)) : REAL_INFINITY, NO_ROTATION,
            MAKE(real_2){X, REAL(1.0)}};
}

/* Right, straight, left, rm >= R + 1: the first arc is the mirror image of that of LSL. */
static inline Extremal rsl(const Start *start) {
    return external_join(WORD_RSL, -start->y, start, start->inner >= REAL(4.0) * start->R);
}

/* (R + 3)^2 - rm^2: not negative where the circle of R meets the last circle of L, so where RL exists.
 *
 * It is 4 (R + y + 2) - `outer`, and not computed as 8 (R + 1) - `inner`: next to (0, -R - 2), where it vanishes
 * and RL is the fastest, neither term is negative, so that no digits are lost. T varies with its square root.
 */
static inline real within_reach(const Start *start) {
    return REAL(4.0) * (start->R + start->y + REAL(2.0)) - start->outer;
}

/* The squared distance from (0, centre), accurate even near zero; computed from `beyond` it would lose digits. */
static inline real squared_distance(real x, real y, real centre) {
    return x * x + (y - centre) * (y - centre);
}

/* The counter-clockwise rotation from direction (ax, ay) to (bx, by); by zero where one of them is zero. */
static inline real_2 rotation(real ax, real ay, real bx, real by) {
    return MAKE(real_2){ax * by - ay * bx, ax * bx + ay * by + TINY};
}

/* RL: right to the crossing with the last circle (R + 1 about (0, -1)) where x1 has `branch`'s sign; then left.
 *
 * The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = `inner` = rm^2 - (R - 1)^2 and p = `within_reach`
 * = (R + 3)^2 - rm^2.
 */
static inline Extremal rl(const Start *start, real branch) {
    const real x = start->x, y = start->y, R = start->R, arc_tolerance = start->arc_tolerance, inner =
            start->inner;
    const real p = within_reach(start);
    const real x1 = branch * REAL(0.25) * real_sqrt(max_real(p * inner, REAL(0.0)));
    const real radius2 = squared_distance(x, y, REAL(1.0));
    const real_2 first = snap_full_turn(rotation(x, y - REAL(1.0), x1, R - REAL(1.0) - REAL(0.25) * inner), radius2,
            arc_tolerance);
    const real_2 last = snap_full_turn(MAKE(real_2){-x1, R + REAL(1.0) - REAL(0.25) * inner}, (R + REAL(1.0)) * (R +
            REAL(1.0)), arc_tolerance);
    return MAKE(Extremal){WORD_RL, first, inner >= REAL(0.0) && p >= REAL(0.0) ? REAL(0.0) : REAL_INFINITY, last,
            NO_ROTATION};
}

/* Extremal a where the condition holds, otherwise b; compiled code has `compiled.branchless.select` instead. */
static inline Extremal extremals_select(bool condition, const Extremal *a, const Extremal *b) {
    return condition ? (*a) : (*b);
}

/* LSR, R >= 2: onto the axis at (c, 0), straight to (X, 0), X = sqrt(R (R - 2)), right for pi - acos(1/(R - 1)).
 *
 * `y` as in `external_join`, with the opposite sign for RSR; `joins` says whether c <= X.
 */
static inline Extremal internal_join(integer word, real y, const Start *start, bool joins) {
    const real R = start->R;
    const real_2_real onto_axis_1 = onto_axis(start->x, y, REAL(1.0), start->arc_tolerance);
    const real_2 first = onto_axis_1.a0;
    const real c = onto_axis_1.a1;
    const real X = real_sqrt(max_real(R * (R - REAL(2.0)), REAL(0.0)));
    const real straight = R >= REAL(2.0) && c >= REAL(0.0) && joins ? max_real(X - c, REAL(0.0)) : REAL_INFINITY;
    return MAKE(Extremal){word, first, straight, NO_ROTATION, MAKE(real_2){X, -REAL(1.0)}};
}

/* Right, straight, right, rm <= R - 1: the first arc is the mirror image of that of LSR. */
static inline Extremal rsr(const Start *start) {
    return internal_join(WORD_RSR, -start->y, start, start->inner <= REAL(0.0));
}

/* Of the extremals of several pieces that begin with R, the one that can win, by rm; see `left_first`. */
static inline Extremal right_first(const Start *start) {
    const Extremal stored_1 = rsl(start);
    const Extremal stored_2 = rl(start, -REAL(1.0));
    Extremal best = extremals_select(start->inner > REAL(4.0) * start->R, &stored_1, &stored_2);
    if (start->y < REAL(0.0)) {
        const Extremal stored_3 = rsr(start);
        best = extremals_select(start->inner < REAL(0.0), &stored_3, &best);
    }
    return best;
}

/* Whether a point is within a distance of a circle; `beyond2`: squared distance from the centre less radius^2. */
static inline bool is_near_circle(real beyond2, real radius, real distance) {
    const real inwards = min_real(distance, radius);
    return -inwards * (REAL(2.0) * radius - inwards) <= beyond2 && beyond2 <= distance * (REAL(2.0) * radius +
            distance);
}

/* Right along the circle of radius R - 1 about (0, 1), from within `arc_tolerance` of it: the limit of LR. */
static inline Extremal extremals_r(const Start *start) {
    const real x = start->x, y = start->y, R = start->R, arc_tolerance = start->arc_tolerance, inner =
            start->inner;
    const real_2 first = snap_full_turn(MAKE(real_2){x, y - REAL(1.0)}, (R - REAL(1.0)) * (R - REAL(1.0)),
            arc_tolerance);
    const real straight = R > REAL(1.0) && is_near_circle(inner, R - REAL(1.0), arc_tolerance) ? REAL(0.0) :
            REAL_INFINITY;
    return MAKE(Extremal){WORD_R, first, straight, NO_ROTATION, NO_ROTATION};
}

/* The difference a^2 - b with nearly full relative accuracy even near zero, for |a| < 2^480. */
static inline real square_beyond(real a, real b) {
    const real_2 two_product_1 = two_product(a, a);
    const real p = two_product_1.a0, e = two_product_1.a1;
    return p - b + e;
}

/* `gap` and v of the quadratic 3 w^2 - 2 gap w + v = 0 of `lrl`. */
static inline real_2 lrl_quadratic(const Start *start) {
    const real R = start->R, outer = start->outer, fold = start->fold;
    const real gap = -REAL(0.5) * fold - square_beyond(R - REAL(1.0), REAL(3.0));
    const real v = -REAL(0.0625) * fold * (REAL(8.0) * (R + REAL(3.0)) - outer);
    return MAKE(real_2){gap, v};
}

/* Left to the switching curve at (xa, ya), right for more than pi to (xb, yb) on the last circle, left.
 *
 * With xa / ya = -xb / yb = m and a = 1 + m^2, the circles give a ya^2 + 2 ya = k = rp^2 - 1, a yb^2 + 2 yb = K = R
 * (R + 2) and a (ya + yb) = 2; hence yb - ya = d = (K - k)/4 = -outer/4 and, for s = ya + yb = 2/a and h = (K +
 * k)/2, the larger root of 3 s^2 - 2 h s + d^2 = 0. Quantities that vanish in places are not computed as
 * differences of others: ya comes from k, and w = 2 - s = m^2 s is the smaller root of 3 w^2 - 2 gap w + v = 0 with
 * v = -`fold` ((R + 5)^2 - rp^2)/16 and gap = 6 - h = 3 - (R - 1)^2 - `fold`/2, whose terms have one sign where LRL
 * is the fastest; so LRL needs rp <= 3 - R.
 */
static inline Extremal lrl(const Start *start) {
    const real x = start->x, y = start->y, R = start->R, arc_tolerance = start->arc_tolerance, outer =
            start->outer, fold = start->fold;
    const real k = x * x + y * (y + REAL(2.0)), d = -REAL(0.25) * outer;
    const real_2 lrl_quadratic_1 = lrl_quadratic(start);
    const real gap = lrl_quadratic_1.a0, v = lrl_quadratic_1.a1;
    const real D = gap * gap - REAL(3.0) * v;
    const bool exists = R <= REAL(3.0) && fold <= REAL(0.0) && D >= REAL(0.0) && gap > REAL(0.0);
    const real root = real_sqrt(max_real(D, REAL(0.0)));
    const real above = REAL(6.0) - gap + root, below = exists ? gap + root : REAL(1.0);
    const real share = REAL(1.0) / (above * below);
    const real w = v * above * share;
    const real a = REAL(6.0) * below * share;
    const real m = real_sqrt(max_real(REAL(0.5) * a * w, REAL(0.0)));
    /* ya = k/q; every vector is multiplied by q. */
    const real q = REAL(1.0) + real_sqrt(max_real(REAL(1.0) + a * k, REAL(0.0)));
    const real ya = k, yb = k + d * q;
    const real xa = m * ya, xb = -m * yb;
    const real_2 first = snap_full_turn(rotation(xa, ya + q, x, y + REAL(1.0)), squared_distance(x, y, -REAL(1.0)),
            arc_tolerance);
    /* ya - 1 and yb - 1 from the quantities that make them small: at R = 1 both vanish on the last arc. */
    const real_2 middle = rotation(xa, -REAL(0.5) * (w + d) * q, xb, -REAL(0.5) * (w - d) * q);
    const real_2 last = MAKE(real_2){-xb, yb + q};
    return MAKE(Extremal){WORD_LRL, first, exists ? REAL(0.0) : REAL_INFINITY, middle, last};
}

/* Left, straight, right, from inside a circle of R >= 2: rp <= R - 1, that is rp^2 - (R - 3)^2 <= 4 (R - 2). */
static inline Extremal lsr(const Start *start) {
    return internal_join(WORD_LSR, start->y, start, start->fold <= REAL(4.0) * (start->R - REAL(2.0)));
}

/* Whether an extremal ends at the target. */
static inline bool reaches(const Extremal *extremal) {
    return extremal->straight < REAL_INFINITY;
}

/* LR, R > 1: left to the crossing with the circle (R - 1 about (0, 1)) where x1 has `branch`'s sign; then right.
 *
 * The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = -`outer` = (R + 1)^2 - rp^2, p = `fold` = rp^2 -
 * (R - 3)^2. So y1 + 1 is R + 1 - q/4 or 3 - R + p/4, and y1 - 1 is R - 1 - q/4: those forms are used whose terms
 * are no longer than the arc's radius, however small that is.
 */
static inline Extremal lr(const Start *start, real branch) {
    const real x = start->x, y = start->y, R = start->R, arc_tolerance = start->arc_tolerance, outer =
            start->outer, fold = start->fold;
    const real x1 = branch * REAL(0.25) * real_sqrt(max_real(-outer * fold, REAL(0.0)));
    const real radius2 = squared_distance(x, y, -REAL(1.0));
    const real_2 first = snap_full_turn(rotation(x1, REAL(3.0) - R + REAL(0.25) * fold, x, y + REAL(1.0)), radius2,
            arc_tolerance);
    const real_2 last = snap_full_turn(MAKE(real_2){x1, R - REAL(1.0) + REAL(0.25) * outer}, (R - REAL(1.0)) * (R -
            REAL(1.0)), arc_tolerance);
    return MAKE(Extremal){WORD_LR, first, R > REAL(1.0) && outer <= REAL(0.0) && fold >= REAL(0.0) ? REAL(0.0) :
            REAL_INFINITY, last, NO_ROTATION};
}

/* Left, straight along the line through the centre, left: rp >= R + 1. */
static inline Extremal lsl(const Start *start) {
    return external_join(WORD_LSL, start->y, start, start->outer >= REAL(0.0));
}

/* Of the extremals of several pieces that begin with L, the one that can win (docs/theory.md, section 4).
 *
 * It is determined by rp. `detour` gives the other crossing of LR, which is not considered here.
 */
static inline Extremal left_first(const Start *start) {
    Extremal best = lrl(start);
    if (start->R > REAL(1.0)) {
        Extremal inside = lsr(start);
        const Extremal stored_1 = lr(start, REAL(1.0));
        inside = extremals_select(reaches(&inside), &inside, &stored_1);
        best = extremals_select(start->fold <= REAL(0.0) && start->R <= REAL(3.0), &best, &inside);
    }
    if (start->y < REAL(0.0)) {
        const Extremal stored_2 = lsl(start);
        best = extremals_select(start->outer >= REAL(0.0), &stored_2, &best);
    }
    return best;
}

/* Left along the last circle, radius R + 1 about (0, -1), from within `arc_tolerance` of it: the limit of RL. */
static inline Extremal extremals_l(const Start *start) {
    const real x = start->x, y = start->y, R = start->R, arc_tolerance = start->arc_tolerance, outer =
            start->outer;
    const real_2 first = snap_full_turn(MAKE(real_2){-x, y + REAL(1.0)}, (R + REAL(1.0)) * (R + REAL(1.0)),
            arc_tolerance);
    const real straight = is_near_circle(outer, R + REAL(1.0), arc_tolerance) ? REAL(0.0) : REAL_INFINITY;
    return MAKE(Extremal){WORD_L, first, straight, NO_ROTATION, NO_ROTATION};
}

/* Whether the angle of a rotation is in [0, pi]. */
static inline bool is_at_most_half_turn(real_2 rotated) {
    const real cross = rotated.a0;
    return cross >= REAL(0.0);
}

/* Whether a single arc replaces the words of which it is the limit: of at most half a turn, or of any length. */
static inline bool is_limit(const Extremal *arc, bool any_length) {
    return reaches(arc) && (is_at_most_half_turn(arc->first) || any_length);
}

/* The rotation, less half a turn where it is half a turn or more, and the count `halves` of these half turns. */
static inline real_3 fold_half_turn(real_2 rotated, real halves) {
    const real cross = rotated.a0, dot = rotated.a1;
    if (cross < REAL(0.0) || (cross == REAL(0.0) && dot < REAL(0.0))) {
        return MAKE(real_3){-cross, -dot, halves + REAL(1.0)};
    }
    return MAKE(real_3){cross, dot, halves};
}

/* The sum of the angles of three rotations, in [0, 6 pi], with one arctangent.
 *
 * Multiplying the vectors as complex numbers adds their angles. Each is first folded below pi, so that two of them
 * make less than a full turn and no whole turn is lost.
 */
static inline real total_angle(real_2 first, real_2 second, real_2 third) {
    const real_3 fold_half_turn_1 = fold_half_turn(first, REAL(0.0));
    const real c1 = fold_half_turn_1.a0, d1 = fold_half_turn_1.a1;
    real halves = fold_half_turn_1.a2;
    const real_3 fold_half_turn_2 = fold_half_turn(second, halves);
    const real c2 = fold_half_turn_2.a0, d2 = fold_half_turn_2.a1;
    halves = fold_half_turn_2.a2;
    const real_3 fold_half_turn_3 = fold_half_turn(MAKE(real_2){c1 * d2 + d1 * c2, d1 * d2 - c1 * c2}, halves);
    real c = fold_half_turn_3.a0, d = fold_half_turn_3.a1;
    halves = fold_half_turn_3.a2;
    const real_3 fold_half_turn_4 = fold_half_turn(third, halves);
    const real c3 = fold_half_turn_4.a0, d3 = fold_half_turn_4.a1;
    halves = fold_half_turn_4.a2;
    const real_3 fold_half_turn_5 = fold_half_turn(MAKE(real_2){c * d3 + d * c3, d * d3 - c * c3}, halves);
    c = fold_half_turn_5.a0;
    d = fold_half_turn_5.a1;
    halves = fold_half_turn_5.a2;
    return REAL(3.141592653589793) * halves + real_atan2(c, d);
}

/* T, the whole time of an extremal; `inf` where it does not reach the target. */
static inline real extremals_duration(const Extremal *extremal) {
    return extremal->straight + total_angle(extremal->first, extremal->middle, extremal->last);
}

/* The least time so far and its extremal, or those of another extremal that takes less. */
static inline real_Extremal faster_of(real least, const Extremal *best, const Extremal *other) {
    const real time = extremals_duration(other);
    return MAKE(real_Extremal){time < least ? time : least, extremals_select(time < least, other, best)};
}

/* The only RL or LR with the other crossing that can win, for y < 0: its first arc ends before the axis. */
static inline Extremal detour(const Start *start) {
    const Extremal stored_1 = rl(start, REAL(1.0));
    const Extremal stored_2 = lr(start, -REAL(1.0));
    return extremals_select(start->inner > REAL(4.0) * start->R, &stored_1, &stored_2);
}

/* The least T and its extremal, among at most three words: one for each first turn, and the `detour`.
 *
 * `exact` says that there is no tolerance. Then a start counts as on a last circle only if it is there up to
 * rounding, and the single arc replaces the words of which it is the limit. From y > 0 an arc of more than half a
 * turn is not optimal: L does not replace LRL there, where it would cross the axis, nor R the words from beyond the
 * last circle of L, from where, just past the target, it would be almost a whole turn. With a tolerance, where a
 * start may lie beside a circle, the single arcs compete with the other words, so that a tolerance never makes T
 * larger.
 *
 * Without a tolerance no times are compared for R = 1, y >= 0 (paper, section 6): the word that begins with L wins
 * where it exists and its first arc is no longer than half a turn, up to the switching curve.
 */
static inline real_Extremal fastest(real x, real y, real R, real arc_tolerance, bool exact) {
    const Start start = start_at(x, y, R, arc_tolerance);
    Extremal right = right_first(&start);
    const Extremal only_right = extremals_r(&start);
    Extremal left = left_first(&start);
    const Extremal only_left = extremals_l(&start);
    if (exact) {
        left = extremals_select(is_limit(&only_left, y <= REAL(0.0)), &only_left, &left);
        right = extremals_select(is_limit(&only_right, y <= REAL(0.0) || start.outer <= REAL(0.0)), &only_right,
                &right);
    }
    Extremal best;
    if (exact && R == REAL(1.0) && !(y < REAL(0.0))) {
        best = extremals_select(reaches(&left) && is_at_most_half_turn(left.first), &left, &right);
        return MAKE(real_Extremal){extremals_duration(&best), best};
    }
    const real_Extremal faster_of_1 = faster_of(extremals_duration(&right), &right, &left);
    real least = faster_of_1.a0;
    best = faster_of_1.a1;
    if (y < REAL(0.0)) {
        const Extremal stored_2 = detour(&start);
        const real_Extremal faster_of_3 = faster_of(least, &best, &stored_2);
        least = faster_of_3.a0;
        best = faster_of_3.a1;
    }
    if (!exact) {
        const real_Extremal faster_of_4 = faster_of(least, &best, &only_left);
        least = faster_of_4.a0;
        best = faster_of_4.a1;
        const real_Extremal faster_of_5 = faster_of(least, &best, &only_right);
        least = faster_of_5.a0;
        best = faster_of_5.a1;
    }
    return MAKE(real_Extremal){least, best};
}

/* The angle of a counter-clockwise rotation, in [0, 2 pi]; that of a clockwise one is `angle((-cross, dot))`.
 *
 * One arctangent has an error of about one rounding of the angle itself; a difference of two arctangents would lose
 * the digits of a small rotation.
 */
static inline real angle(real_2 rotated) {
    const real cross = rotated.a0, dot = rotated.a1;
    const real turned = real_atan2(cross, dot);
    /* + 0.0 turns -0.0 into 0.0, so that no duration has a negative sign. */
    return turned < REAL(0.0) ? turned + TWO_PI : turned + REAL(0.0);
}

/* The durations of the pieces in flying order, 0 past the last. */
static inline real_3 durations(const Extremal *extremal) {
    return MAKE(real_3){angle(extremal->first), extremal->straight + angle(extremal->middle),
            angle(extremal->last)};
}

/* The controls of the three pieces of a word, `ABSENT` past its last. */
static inline integer_3 controls(integer word) {
    return MAKE(integer_3){(word & 3) - 2, ((word >> 2) & 3) - 2, ((word >> 4) & 3) - 2};
}

/* The word of the controls -1, 0 or +1 of up to three pieces, in the order flown. */
static inline integer encode(integer u1, integer u2, integer u3) {
    return u1 + 2 + 4 * (u2 + 2) + 16 * (u3 + 2);
}

/* The word without its first piece. */
static inline integer rest(integer word) {
    return (word >> 2);
}

/* The word as flown: without a straight piece up to `short` and arcs up to `no_angle`; equal arcs are joined. */
static inline integer_real_3 drop_short_pieces(integer word, real t1, real t2, real t3, real short_, real no_angle)
        {
    const integer_3 controls_1 = controls(word);
    integer first = controls_1.a0;
    const integer last = controls_1.a2;
    if (last != ABSENT && t2 <= short_) {
        if (first == last) {
            word = encode(first, -2, -2);
            t1 = t1 + t3;
            t2 = REAL(0.0);
            t3 = REAL(0.0);
        } else {
            word = encode(first, last, -2);
            t2 = t3;
            t3 = REAL(0.0);
        }
    }
    const integer_3 controls_2 = controls(word);
    first = controls_2.a0;
    const integer second = controls_2.a1, third = controls_2.a2;
    if (second != ABSENT && third == ABSENT && t2 <= no_angle) {
        word = encode(first, -2, -2);
        t2 = REAL(0.0);
    }
    if (t1 <= no_angle) {
        word = rest(word);
        t1 = t2;
        t2 = t3;
        t3 = REAL(0.0);
    }
    return MAKE(integer_real_3){word, t1, t2, t3};
}

/* The opposite control; `ABSENT` stays as it is. */
static inline integer opposite(integer u) {
    return u == ABSENT ? u : -u;
}

/* The word with L and R exchanged. */
static inline integer mirrored(integer word) {
    const integer_3 controls_1 = controls(word);
    const integer u1 = controls_1.a0, u2 = controls_1.a1, u3 = controls_1.a2;
    return encode(opposite(u1), opposite(u2), opposite(u3));
}

/* An extremal of the clockwise circle as the maneuver flown onto the circle of the given side.
 *
 * Leaving out a piece, or an almost full turn, moves the end by at most a third of `length_tolerance`, since the
 * radius of an arc is no more than 1 + |x| + |y| + R. So three pieces together miss the target by no more than
 * `length_tolerance`.
 */
static inline Entry flown_entry(const Extremal *extremal, real length_tolerance, integer side) {
    const real_3 durations_1 = durations(extremal);
    real t1 = durations_1.a0, t2 = durations_1.a1, t3 = durations_1.a2;
    const integer_real_3 drop_short_pieces_2 = drop_short_pieces(code(extremal->word), t1, t2, t3,
            length_tolerance / REAL(3.0), ROUNDING / REAL(3.0));
    const integer word = drop_short_pieces_2.a0;
    t1 = drop_short_pieces_2.a1;
    t2 = drop_short_pieces_2.a2;
    t3 = drop_short_pieces_2.a3;
    return MAKE(Entry){side, side < 0 ? mirrored(word) : word, t1, t2, t3};
}

/* The fastest maneuver onto the circle held on one side. */
static inline Entry optimum_on_side(real x, real y, real R, integer side, real tolerance) {
    const real_Extremal fastest_1 = fastest(x, (real)side * y, R, arc_tolerance_of(x, y, R, tolerance), tolerance ==
            REAL(0.0));
    const Extremal best = fastest_1.a1;
    return flown_entry(&best, rounding(x, y, R), side);
}

/* T, the whole time of a maneuver. */
static inline real entry_duration(Entry maneuver) {
    return maneuver.t1 + maneuver.t2 + maneuver.t3;
}

/* Whether a maneuver is faster than another by more than rounding. */
static inline bool is_faster(Entry maneuver, Entry other, real length_tolerance) {
    return entry_duration(maneuver) < entry_duration(other) - length_tolerance;
}

/* The fastest maneuver onto the circle from the reduced state (x, y); to be called only where `status_of` is OK.
 *
 * For *either*, the far side can be faster than the near one only within a tolerance; only then are both solved.
 */
static inline Entry optimum(real x, real y, real R, integer side, real tolerance) {
    const Entry near = optimum_on_side(x, y, R, side_or_near(y, side), tolerance);
    if (side != SIDE_EITHER || tolerance == REAL(0.0)) {
        return near;
    }
    const Entry far = optimum_on_side(x, y, R, -near_side(y), tolerance);
    return is_faster(far, near, rounding(x, y, R)) ? far : near;
}

/* The length of a vector whose square neither overflows nor underflows.
 *
 * Unlike `math.hypot`, whose algorithm is Python's own, compiled code gives the same value to the last bit.
 */
static inline real length(real x, real y) {
    return real_sqrt(x * x + y * y);
}

/* The least R of a circle that can be held all round: the rate of turn is largest downwind, (1 + |w|)^2 / R. */
static inline real tightest_radius(real wx, real wy) {
    const real fastest = REAL(1.0) + length(wx, wy);
    return fastest * fastest;
}

/* `Status.OK`, or why there is nothing to solve. */
static inline integer status_of(const WindProblem *problem) {
    const real x = problem->x, y = problem->y, c = problem->c, s = problem->s, R = problem->R, wx =
            problem->wx, wy = problem->wy, tolerance = problem->tolerance;
    if (!(isfinite(x + y) && isfinite(c + s) && isfinite(R) && isfinite(wx + wy))) {
        return code(STATUS_NOT_FINITE);
    }
    if (length(wx, wy) >= REAL(1.0)) {
        return code(STATUS_WIND_TOO_STRONG);
    }
    if (tightest_radius(wx, wy) * (REAL(1.0) - ROUNDING) > R) {
        return code(R >= REAL(1.0) ? STATUS_NOT_HELD : STATUS_RADIUS_TOO_SMALL);
    }
    if (real_fabs(x) > REACH || real_fabs(y) > REACH || R > REACH) {
        return code(STATUS_OUT_OF_RANGE);
    }
    return code(REAL(0.0) <= tolerance && tolerance <= REACH ? STATUS_OK : STATUS_BAD_TOLERANCE);
}

/* The result where there is no maneuver. */
static inline WindEntry no_entry(integer status) {
    return MAKE(WindEntry){status, 0, 0, REAL_NAN, REAL_NAN, REAL_NAN, REAL_NAN, REAL_NAN};
}

/* The scene of a problem, with the arc tolerance that rounding requires; negligible wind is treated as zero. */
static inline WindScene scene_of(const WindProblem *problem) {
    const real x = problem->x, y = problem->y, c = problem->c, s = problem->s, R = problem->R;
    real wx = problem->wx, wy = problem->wy;
    if (length(wx, wy) < NEGLIGIBLE_WIND) {
        wx = REAL(0.0);
        wy = REAL(0.0);
    }
    return MAKE(WindScene){x, y, c, s, R, wx, wy, rounding(x, y, R) / REAL(3.0)};
}

/* The direction of the wind as a unit vector; (1, 0) in still air, and in a wind too light to have one. */
static inline real_2 downwind(real wx, real wy) {
    const real wind = length(wx, wy);
    const bool chosen_1 = wind >= NEGLIGIBLE_WIND;
    return MAKE(real_2){chosen_1 ? wx / wind : REAL(1.0), chosen_1 ? wy / wind : REAL(0.0)};
}

/* The rotation of the arc of control u = +1 or -1 that takes the heading (ax, ay) to (bx, by). */
static inline real_2 arc_rotation(integer u, real ax, real ay, real bx, real by) {
    const real_2 rotation_1 = rotation(ax, ay, bx, by);
    const real cross = rotation_1.a0, dot = rotation_1.a1;
    return MAKE(real_2){(real)u * cross, dot};
}

/* The phase of the point of the circle that is nearest to (x, y). */
static inline real phase_of(real x, real y, integer side, real wx, real wy) {
    const real_2 downwind_1 = downwind(wx, wy);
    const real dx = downwind_1.a0, dy = downwind_1.a1;
    return angle(arc_rotation(-side, -dx, -dy, (real)side * y, (real)-side * x));
}

/* The pose on the circle at a phase, (1) and (2): heading and wind add up to a velocity along the circle. */
static inline real_5 hold_pose(real phase, integer side, real R, real wx, real wy) {
    const real_2 downwind_1 = downwind(wx, wy);
    const real dx = downwind_1.a0, dy = downwind_1.a1;
    const real a = -real_cos(phase), b = (real)side * real_sin(phase);
    const real tx = a * dx - b * dy, ty = a * dy + b * dx;
    const real nx = (real)-side * ty, ny = (real)side * tx;
    const real out = wx * nx + wy * ny;
    const real crab = real_sqrt((REAL(1.0) - out) * (REAL(1.0) + out));
    return MAKE(real_5){R * nx, R * ny, crab * tx - out * nx, crab * ty - out * ny, crab + wx * tx + wy * ty};
}

/* The distance of the start from a point of joining, where an angle between the headings counts R times. */
static inline real hold_miss(real phase, integer side, const WindScene *scene) {
    const real_5 hold_pose_1 = hold_pose(phase, side, scene->R, scene->wx, scene->wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, ce = hold_pose_1.a2, se = hold_pose_1.a3;
    return length(length(px - scene->x, py - scene->y), scene->R * length(ce - scene->c, se - scene->s));
}

/* Position (x, y) and unit velocity (c, s) after a time t with control u: the exact flow of (1).
 *
 * The displacement is the chord of the arc, 2 sin(t/2) long, along the velocity at half time. This avoids the
 * difference of two nearly equal sines for short arcs.
 */
static inline real_4 fly(real x, real y, real c, real s, integer u, real t) {
    const real half = REAL(0.5) * (real)u * t;
    const real ch = real_cos(half), sh = real_sin(half);
    const real chord = u != 0 ? REAL(2.0) * real_sin(REAL(0.5) * t) : t;
    const real ce = real_cos((real)u * t), se = real_sin((real)u * t);
    return MAKE(real_4){x + chord * (c * ch - s * sh), y + chord * (s * ch + c * sh), c * ce - s * se, s * ce + c *
            se};
}

/* The distance of the end of a maneuver, flown exactly, from a point of joining: position and heading together. */
static inline real end_miss(Entry entry, real phase, const WindScene *scene) {
    real x = scene->x, y = scene->y, c = scene->c, s = scene->s;
    const real R = scene->R, wx = scene->wx, wy = scene->wy;
    const integer side = entry.side, word = entry.word;
    const real t1 = entry.t1, t2 = entry.t2, t3 = entry.t3;
    const integer_3 controls_1 = controls(word);
    const integer each_u_1[3] = {controls_1.a0, controls_1.a1, controls_1.a2};
    const real each_t_1[3] = {t1, t2, t3};
    for (int i_1 = 0; i_1 < 3; i_1++) {
        const integer u = each_u_1[i_1];
        const real t = each_t_1[i_1];
        if (u != ABSENT) {
            const real_4 fly_2 = fly(x, y, c, s, u, t);
            x = fly_2.a0;
            y = fly_2.a1;
            c = fly_2.a2;
            s = fly_2.a3;
            x = x + wx * t;
            y = y + wy * t;
        }
    }
    const real_5 hold_pose_3 = hold_pose(phase, side, R, wx, wy);
    const real px = hold_pose_3.a0, py = hold_pose_3.a1, ce = hold_pose_3.a2, se = hold_pose_3.a3;
    return length(length(px - x, py - y), length(ce - c, se - s));
}

/* The maneuver that takes less time; a where b ends too far from the circle. */
static inline EntryBeside faster_beside(const EntryBeside *a, const EntryBeside *b, real tolerance) {
    return b->miss <= tolerance && (REAL(0.0) <= b->entry.t1 && b->entry.t1 < min_real(a->entry.t1, TWO_PI))
            ? (*b) : (*a);
}

/* The size of the rate of turn that holds the circle at a phase: g^2 / (R cos(crab)), (3). */
static inline real hold_rate(real phase, integer side, real R, real wx, real wy) {
    const real_5 hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const real c = hold_pose_1.a2, s = hold_pose_1.a3, g = hold_pose_1.a4;
    return g * g / (R * (g - (wx * (c + wx) + wy * (s + wy)) / g));
}

/* One arc that ends on the circle, and its phase, from an approximation, by Newton's method.
 *
 * It can end on the circle and along it only where the start is on it by rounding. The end and the point of joining
 * move in the same direction, so the distance between them along it determines the duration of the arc less the
 * time s by which it joins later, and then the heading determines s.
 */
static inline Entry_real fit_one_arc(Entry arc, real phase, const WindScene *scene) {
    const real x = scene->x, y = scene->y, c = scene->c, s = scene->s, R = scene->R, wx = scene->wx, wy
            = scene->wy, arc_tolerance = scene->arc_tolerance;
    const integer side = arc.side, word = arc.word;
    real t = arc.t1;
    const integer_3 controls_1 = controls(word);
    const integer u = controls_1.a0;
    for (integer pass_1 = 0; pass_1 < ARC_STEPS; pass_1++) {
        const real_4 fly_2 = fly(x, y, c, s, u, t);
        const real x1 = fly_2.a0, y1 = fly_2.a1, c1 = fly_2.a2, s1 = fly_2.a3;
        const real_5 hold_pose_3 = hold_pose(phase, side, R, wx, wy);
        const real px = hold_pose_3.a0, py = hold_pose_3.a1, ce = hold_pose_3.a2, se = hold_pose_3.a3, g =
                hold_pose_3.a4;
        const real rx = px - x1 - wx * t, ry = py - y1 - wy * t, vx = ce + wx, vy = se + wy;
        const real longer = (rx * vx + ry * vy) / (g * g), bend = (real)u + (real)side * hold_rate(phase, side, R,
                wx, wy);
        if (bend == REAL(0.0)) {
            break;
        }
        const real later = (real_atan2(c1 * se - s1 * ce, c1 * ce + s1 * se) - (real)u * longer) / bend;
        t = t + longer + later;
        phase = phase + later * g / R;
        if (real_fabs(longer) + real_fabs(later) <= arc_tolerance) {
            break;
        }
    }
    return MAKE(Entry_real){MAKE(Entry){side, word, t, REAL(0.0), REAL(0.0)}, phase};
}

/* The arc of control u next to an approximation that ends abreast of the circle, with the heading of the hold. */
static inline EntryBeside arc_beside(integer u, real t, real phase, integer side, const WindScene *scene) {
    const Entry_real fit_one_arc_1 = fit_one_arc(MAKE(Entry){side, encode(u, -2, -2), t, REAL(0.0), REAL(0.0)},
            phase, scene);
    const Entry entry = fit_one_arc_1.a0;
    phase = fit_one_arc_1.a1;
    return MAKE(EntryBeside){entry, phase, end_miss(entry, phase, scene)};
}

/* The end of the arc of control u that ends with the heading of a point of joining. */
static inline ArcEnd arc_end(integer u, real phase, integer side, const WindScene *scene) {
    const real x = scene->x, y = scene->y, c = scene->c, s = scene->s, R = scene->R, wx = scene->wx, wy
            = scene->wy;
    const real_5 hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, ce = hold_pose_1.a2, se = hold_pose_1.a3, g =
            hold_pose_1.a4;
    const real t = angle(arc_rotation(u, c, s, ce, se));
    const real_4 fly_2 = fly(x, y, c, s, u, t);
    const real x1 = fly_2.a0, y1 = fly_2.a1;
    const real rx = px - x1 - wx * t, ry = py - y1 - wy * t;
    return MAKE(ArcEnd){t, (rx * (ce + wx) + ry * (se + wy)) / g};
}

/* The faster of `best` and the arcs of the control u between `ARC_SAMPLES` points of joining. */
static inline EntryBeside fastest_arc_beside(EntryBeside best, integer u, integer side, real tolerance, const
        WindScene *scene) {
    ArcEnd before = arc_end(u, REAL(0.0), side, scene);
    const integer last_1 = ARC_SAMPLES + 1;
    for (integer i = 1; i < last_1; i++) {
        const real phase = TWO_PI / (real)ARC_SAMPLES * (real)i;
        const ArcEnd after = arc_end(u, phase, side, scene);
        /* Where the heading of the start lies between those of two points, one of the two arcs is almost a whole turn. */
        if ((before.short_ <= REAL(0.0) && REAL(0.0) <= after.short_) && real_fabs(after.t - before.t) <
                REAL(3.141592653589793)) {
            const EntryBeside stored_1 = arc_beside(u, after.t, phase, side, scene);
            best = faster_beside(&best, &stored_1, tolerance);
        }
        before = after;
    }
    return best;
}

/* The fastest maneuver of no piece or of one arc that ends within `tolerance` of the circle; T is inf for none.
 *
 * `sides` is a `words.Side`. An arc ends with the heading of its point of joining, so that its miss is the distance
 * from that point.
 */
static inline EntryBeside entry_beside(integer sides, real tolerance, const WindScene *scene) {
    EntryBeside best = NO_ENTRY_BESIDE;
    const integer each_side_1[2] = {1, -1};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const integer side = each_side_1[i_1];
        if (sides != -side) {
            const real phase = phase_of(scene->x, scene->y, side, scene->wx, scene->wy);
            const Entry nothing = MAKE(Entry){side, 0, REAL(0.0), REAL(0.0), REAL(0.0)};
            if (hold_miss(phase, side, scene) <= tolerance && best.entry.t1 > REAL(0.0)) {
                best = MAKE(EntryBeside){nothing, phase, end_miss(nothing, phase, scene)};
            }
            const integer each_u_2[2] = {1, -1};
            for (int i_2 = 0; i_2 < 2; i_2++) {
                const integer u = each_u_2[i_2];
                const EntryBeside stored_1 = arc_beside(u, REAL(0.0), phase, side, scene);
                best = faster_beside(&best, &stored_1, tolerance);
                best = fastest_arc_beside(best, u, side, tolerance, scene);
            }
        }
    }
    return best;
}

/* The result for a maneuver that joins at a phase. */
static inline WindEntry entry_at(Entry entry, real phase, real miss, const WindScene *scene) {
    const real_5 hold_pose_1 = hold_pose(phase, entry.side, scene->R, scene->wx, scene->wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1;
    return MAKE(WindEntry){code(STATUS_OK), entry.side, entry.word, entry.t1, entry.t2, entry.t3, real_atan2(py,
            px), miss};
}

/* The candidate without pieces, which joins at the point of the circle that is nearest to the start. */
static inline WindCandidate start_on_circle(integer side, const WindScene *scene) {
    const real phase = phase_of(scene->x, scene->y, side, scene->wx, scene->wy);
    return MAKE(WindCandidate){phase, side, MAKE(Path){REAL(0.0), 0, REAL(0.0), REAL(0.0), REAL(0.0), REAL(1.0),
            REAL(1.0), REAL(0.0)}};
}

/* Whether the start is on the circle and moves along it, up to rounding. */
static inline bool is_on_circle(integer side, const WindScene *scene) {
    const Entry nothing = MAKE(Entry){side, 0, REAL(0.0), REAL(0.0), REAL(0.0)};
    const real phase = start_on_circle(side, scene).phase;
    return end_miss(nothing, phase, scene) <= REAL(3.0) * scene->arc_tolerance;
}

/* The arc left of a word whose other pieces together last `SHORT` or less; the empty word where there is none. */
static inline Entry one_arc_entry(const WindCandidate *found) {
    const integer side = found->side;
    const Path path = found->path;
    const integer_3 controls_1 = controls(path.word);
    const integer first = controls_1.a0, middle = controls_1.a1, last = controls_1.a2;
    if (first == last && path.t2 <= SHORT) {
        return MAKE(Entry){side, encode(first, -2, -2), path.t1 + path.t3, REAL(0.0), REAL(0.0)};
    }
    if (middle != 0 && path.t1 + path.t3 <= SHORT) {
        return MAKE(Entry){side, encode(middle, -2, -2), path.t2, REAL(0.0), REAL(0.0)};
    }
    if (path.t2 + path.t3 <= SHORT) {
        return MAKE(Entry){side, encode(first, -2, -2), path.t1, REAL(0.0), REAL(0.0)};
    }
    if (path.t1 + path.t2 <= SHORT) {
        return MAKE(Entry){side, encode(last, -2, -2), path.t3, REAL(0.0), REAL(0.0)};
    }
    return MAKE(Entry){side, 0, REAL(0.0), REAL(0.0), REAL(0.0)};
}

/* The two arcs left of a word whose third piece lasts `short` or less; the empty word where there are none. */
static inline Entry two_arc_entry(const WindCandidate *found, real short_) {
    const integer side = found->side;
    const Path path = found->path;
    const integer_3 controls_1 = controls(path.word);
    const integer first = controls_1.a0, middle = controls_1.a1, last = controls_1.a2;
    if (middle == 0) {
        if (path.t2 <= short_ && first != last) {
            return MAKE(Entry){side, encode(first, last, -2), path.t1, path.t3, REAL(0.0)};
        }
    } else if (path.t1 <= min_real(short_, path.t3)) {
        return MAKE(Entry){side, encode(middle, last, -2), path.t2, path.t3, REAL(0.0)};
    } else if (path.t3 <= short_) {
        return MAKE(Entry){side, encode(first, middle, -2), path.t1, path.t2, REAL(0.0)};
    }
    return MAKE(Entry){side, 0, REAL(0.0), REAL(0.0), REAL(0.0)};
}

/* Whether one or two arcs end on the circle, and no later than `latest`, up to rounding. */
static inline bool is_close(Entry arcs, real phase, real latest, const WindScene *scene) {
    const bool both_flown = min_real(arcs.t1, arcs.t2) >= REAL(0.0);
    const real late = entry_duration(arcs) - latest;
    return both_flown && max_real(late, end_miss(arcs, phase, scene)) <= REAL(3.0) * scene->arc_tolerance;
}

/* Two arcs that end on the circle, and their phase, from an approximation, by Newton's method.
 *
 * Where the headings agree, joining later by s along the circle moves the point of joining just as flying the
 * second arc for s longer moves the end of the path. So the position determines t1 and t2 - s, and then the heading
 * determines s.
 */
static inline Entry_real fit_two_arcs(Entry arcs, real phase, const WindScene *scene) {
    const real x = scene->x, y = scene->y, c = scene->c, s = scene->s, R = scene->R, wx = scene->wx, wy
            = scene->wy, arc_tolerance = scene->arc_tolerance;
    const integer side = arcs.side, word = arcs.word;
    real t1 = arcs.t1, t2 = arcs.t2;
    const integer_3 controls_1 = controls(word);
    const integer first = controls_1.a0, second = controls_1.a1;
    for (integer pass_1 = 0; pass_1 < ARC_STEPS; pass_1++) {
        const real_4 fly_2 = fly(x, y, c, s, first, t1);
        const real x1 = fly_2.a0, y1 = fly_2.a1, c1 = fly_2.a2, s1 = fly_2.a3;
        const real_4 fly_3 = fly(x1, y1, c1, s1, second, t2);
        const real x2 = fly_3.a0, y2 = fly_3.a1, c2 = fly_3.a2, s2 = fly_3.a3;
        const real_5 hold_pose_4 = hold_pose(phase, side, R, wx, wy);
        const real px = hold_pose_4.a0, py = hold_pose_4.a1, ce = hold_pose_4.a2, se = hold_pose_4.a3, g =
                hold_pose_4.a4;
        const real rx = px - x2 - wx * (t1 + t2), ry = py - y2 - wy * (t1 + t2);
        /* How the end moves with t1, which turns the second arc about its start, and with t2. */
        const real ax = c1 + wx - (real)first * (y2 - y1), ay = s1 + wy + (real)first * (x2 - x1);
        const real bx = c2 + wx, by = s2 + wy;
        const real across = ax * by - ay * bx, bend = (real)second + (real)side * hold_rate(phase, side, R, wx, wy);
        if (across == REAL(0.0) || bend == REAL(0.0)) {
            break;
        }
        const real d1 = (rx * by - ry * bx) / across, d2 = (ax * ry - ay * rx) / across;
        const real later = (real_atan2(c2 * se - s2 * ce, c2 * ce + s2 * se) - (real)first * d1 - (real)second * d2)
                / bend;
        t1 = t1 + d1;
        t2 = t2 + d2 + later;
        phase = phase + later * g / R;
        if (real_fabs(d1) + real_fabs(d2) + real_fabs(later) <= arc_tolerance) {
            break;
        }
    }
    return MAKE(Entry_real){MAKE(Entry){side, word, t1, t2, REAL(0.0)}, phase};
}

/* The maneuver and phase of a candidate, or those of one or two of its arcs alone if close and no slower. */
static inline Entry_real polish(const WindCandidate *found, const WindScene *scene) {
    const real phase = found->phase;
    const integer side = found->side;
    const Path path = found->path;
    const Entry entry = MAKE(Entry){side, path.word, path.t1, path.t2, path.t3};
    const real latest = path.time + TOO_EARLY * end_miss(entry, phase, scene);
    Entry arc = one_arc_entry(found), arcs = two_arc_entry(found, SHORT);
    if (arc.word != 0) {
        const Entry_real fit_one_arc_1 = fit_one_arc(arc, phase, scene);
        arc = fit_one_arc_1.a0;
        const real arc_phase = fit_one_arc_1.a1;
        if (is_close(arc, arc_phase, latest, scene)) {
            return MAKE(Entry_real){arc, arc_phase};
        }
    }
    if (arcs.word != 0) {
        const Entry_real fit_two_arcs_2 = fit_two_arcs(arcs, phase, scene);
        arcs = fit_two_arcs_2.a0;
        const real arcs_phase = fit_two_arcs_2.a1;
        if (is_close(arcs, arcs_phase, latest, scene)) {
            return MAKE(Entry_real){arcs, arcs_phase};
        }
    }
    return MAKE(Entry_real){entry, phase};
}

/* A candidate as the maneuver flown; `Status.NOT_CONVERGED` where it does not end on the circle. */
static inline WindEntry wind_entry(const WindCandidate *found, const WindScene *scene) {
    const real length_tolerance = rounding(scene->x, scene->y, scene->R);
    const Entry_real polish_1 = polish(found, scene);
    const integer side = polish_1.a0.side;
    integer word = polish_1.a0.word;
    real t1 = polish_1.a0.t1, t2 = polish_1.a0.t2, t3 = polish_1.a0.t3;
    const real phase = polish_1.a1;
    const integer_real_3 drop_short_pieces_2 = drop_short_pieces(word, t1, t2, t3, length_tolerance, ROUNDING);
    word = drop_short_pieces_2.a0;
    t1 = drop_short_pieces_2.a1;
    t2 = drop_short_pieces_2.a2;
    t3 = drop_short_pieces_2.a3;
    const real miss = end_miss(MAKE(Entry){side, word, t1, t2, t3}, phase, scene);
    /* Each piece has its arc tolerance, which the wind may double, and the rounding of its duration. The negated */
    /* comparison also rejects a miss that is nan. */
    if (!(miss <= REAL(2.0) * length_tolerance + ROUNDING * (t1 + t2 + t3))) {
        return no_entry(code(STATUS_NOT_CONVERGED));
    }
    return entry_at(MAKE(Entry){side, word, t1, t2, t3}, phase, miss, scene);
}

/* The side, word and durations of a maneuver, as for still air. */
static inline Entry entry_of(const WindEntry *maneuver) {
    return MAKE(Entry){maneuver->side, maneuver->word, maneuver->t1, maneuver->t2, maneuver->t3};
}

/* T, the whole time of a maneuver. */
static inline real time_of(const WindEntry *maneuver) {
    return entry_duration(entry_of(maneuver));
}

/* The search with its result: the maneuver onto the circle, or that beside it if it is faster. */
static inline void end_search(WindSearch *search) {
    const WindScene scene = search->scene;
    const EntryBeside beside = search->beside;
    WindEntry entry = wind_entry(&search->best, &scene);
    /* The negated comparison is also true where there is no maneuver onto the circle: its times are nan. */
    if (beside.entry.t1 < REAL_INFINITY && !(time_of(&entry) <= beside.entry.t1)) {
        entry = entry_at(beside.entry, beside.phase, beside.miss, &scene);
    }
    search->stage = ENDED;
    search->entry = entry;
    return;
}

/* The search for the fastest maneuver, before its first step; it has ended where the answer is known at once. */
static inline WindSearch begin_search(const WindProblem *problem) {
    WindSearch search = NO_SEARCH;
    const integer status = status_of(problem);
    if (status != 0) {
        search.stage = ENDED;
        search.entry = no_entry(status);
        return search;
    }
    const WindScene scene = scene_of(problem);
    search.sides = problem->side;
    search.scene = scene;
    if (problem->tolerance > REAL(0.0)) {
        search.beside = entry_beside(problem->side, problem->tolerance, &scene);
        const Entry entry = search.beside.entry;
        const real phase = search.beside.phase, miss = search.beside.miss;
        if (entry.t1 == REAL(0.0)) {
            search.stage = ENDED;
            search.entry = entry_at(entry, phase, miss, &scene);
            return search;
        }
    }
    const integer each_side_1[2] = {1, -1};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const integer side = each_side_1[i_1];
        if (problem->side != -side && is_on_circle(side, &scene)) {
            search.best = start_on_circle(side, &scene);
        }
    }
    if (search.best.side != 0) {
        end_search(&search);
        return search;
    }
    return search;
}

/* The time at which a straight flight at speed 1 meets a point that starts at d and moves with -w: t = |d - w t|.
 *
 * The positive root of (1 - w^2) t^2 + 2 (w . d) t = d^2, in the form without cancellation.
 */
static inline real interception(real dx, real dy, real wx, real wy) {
    const real along = wx * dx + wy * dy, spare = REAL(1.0) - wx * wx - wy * wy, square = dx * dx + dy * dy;
    const real root = real_sqrt(along * along + spare * square);
    if (along < REAL(0.0)) {
        return (root - along) / spare;
    }
    return square > REAL(0.0) ? square / (root + along) : REAL(0.0);
}

/* The set that contains only a word of three pieces: LSL, RSR, LSR, RSL, LRL and RLR are its bits, lowest first. */
static inline integer set_of(integer word) {
    const integer_3 controls_1 = controls(word);
    const integer first = controls_1.a0, middle = controls_1.a1, last = controls_1.a2;
    const integer lowest = middle != 0 ? 16 : first == last ? 1 : 4;
    return first > 0 ? lowest : 2 * lowest;
}

/* The duration of an arc; zero where it is less than a full turn by at most `arc_tolerance` at the given radius. */
static inline real arc_time(real_2 rotation, real radius, real arc_tolerance) {
    return angle(snap_full_turn(rotation, radius * radius, arc_tolerance));
}

/* The first arc of LSL or RSR, whose arcs add up to `arcs`; one of them is zero where it falls short by rounding.
 *
 * The straight piece moves by its own length alone as it turns: the shorter it is, the less is known of its
 * direction.
 */
static inline real first_of_same_turns(real first, real arcs, real straight, real arc_tolerance) {
    const real beyond = first - arcs, short_ = TWO_PI - first;
    if (beyond > arc_tolerance && straight * min_real(beyond, short_) <= REAL(3.0) * arc_tolerance) {
        return beyond < short_ ? arcs : REAL(0.0);
    }
    return first;
}

/* The first LSL (u = +1) or RSR whose time is at most `until`.
 *
 * t1 + t3 is the rotation from start to pose, or a turn more, and t2 an interception.
 */
static inline Path lsl_rsr(integer u, real dx, real dy, const Ends *ends, real until_) {
    const real c0 = ends->c0, s0 = ends->s0, c = ends->c, s = ends->s, wx = ends->wx, wy = ends->wy,
            arc_tolerance = ends->arc_tolerance;
    const real rotation = arc_time(arc_rotation(u, c0, s0, c, s), REAL(1.0), arc_tolerance);
    const real each_arcs_1[2] = {rotation, rotation + TWO_PI};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const real arcs = each_arcs_1[i_1];
        const real ax = dx - wx * arcs, ay = dy - wy * arcs;
        const real straight = interception(ax, ay, wx, wy);
        if (arcs + straight > until_ + ALMOST) {
            break;
        }
        const real ex = ax - wx * straight, ey = ay - wy * straight;
        real first = arc_time(arc_rotation(u, c0, s0, ex, ey), REAL(1.0) + straight, arc_tolerance);
        first = first_of_same_turns(first, arcs, straight, arc_tolerance);
        const real last = max_real(arcs - first, REAL(0.0));
        if (first <= arcs + arc_tolerance && straight * (last - TWO_PI) <= REAL(3.0) * arc_tolerance) {
            const real distance = length(ex, ey);
            /* Where the two circles coincide, any direction of p is possible. */
            const bool chosen_1 = distance > REAL(0.0);
            const real p1 = chosen_1 ? ex / distance : REAL(1.0), p2 = chosen_1 ? ey / distance : REAL(0.0);
            return MAKE(Path){first + straight + last, encode(u, 0, u), first, straight, last, REAL(1.0), p1, p2};
        }
    }
    return NO_PATH;
}

/* The path that takes less time: a where they tie, or where b takes longer than `until`. */
static inline Path faster_path(const Path *a, const Path *b, real until_) {
    return b->time < a->time && b->time <= until_ ? (*b) : (*a);
}

/* The interval of times t >= 0 in which |d - w t| < limit; both ends are `inf` where there is none. */
static inline real_2 time_within(real dx, real dy, real wx, real wy, real limit) {
    const real along = wx * dx + wy * dy, square = wx * wx + wy * wy, gap = dx * dx + dy * dy - limit * limit;
    const real discriminant = along * along - square * gap;
    if (gap >= REAL(0.0) && (along <= REAL(0.0) || discriminant <= REAL(0.0))) {
        return MAKE(real_2){REAL_INFINITY, REAL_INFINITY};
    }
    const real root = real_sqrt(discriminant);
    if (gap >= REAL(0.0)) {
        return MAKE(real_2){gap / (along + root), (along + root) / square};
    }
    if (along > REAL(0.0)) {
        return MAKE(real_2){REAL(0.0), (along + root) / square};
    }
    return MAKE(real_2){REAL(0.0), root > along ? -gap / (root - along) : REAL_INFINITY};
}

/* The straight piece of LSR (u = +1) or RSL between circles whose centres are d apart: length and direction. */
static inline real_3 tangent(integer u, real dx, real dy) {
    const real square = dx * dx + dy * dy;
    const real straight = real_sqrt(max_real(square - REAL(4.0), REAL(0.0)));
    return MAKE(real_3){straight, (straight * dx - REAL(2.0) * (real)u * dy) / square, (straight * dy + REAL(2.0) *
            (real)u * dx) / square};
}

/* By how much each arc of LSR (u = +1) or RSL grows in an interval, continued beyond whole turns. */
static inline real arc_growth(integer u, real dx, real dy, const Ends *ends, real_2 interval) {
    const real begin = interval.a0, end_ = interval.a1;
    const real_3 tangent_1 = tangent(u, dx - ends->wx * begin, dy - ends->wy * begin);
    const real e1 = tangent_1.a1, e2 = tangent_1.a2;
    /* In the end the straight piece points against the wind. */
    real p1 = -ends->wx, p2 = -ends->wy;
    if (end_ < REAL_INFINITY) {
        const real_3 tangent_2 = tangent(u, dx - ends->wx * end_, dy - ends->wy * end_);
        p1 = tangent_2.a1;
        p2 = tangent_2.a2;
    }
    const real turned = real_fabs(real_atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2));
    return (real)u * (ends->wx * e2 - ends->wy * e1) >= REAL(0.0) ? turned : -turned;
}

/* 1 where an arc exceeds a limit, or almost: the ends of arcs are known up to rounding only; otherwise 0. */
static inline integer passes(real arc, real limit) {
    return arc > limit - ALMOST ? 1 : 0;
}

/* The time in an interval at which the length of LSR or RSL equals T; any later time where there is none.
 *
 * `arcs` is the sum of the durations of its two arcs at the beginning of the interval.
 */
static inline real lsr_rsl_root(integer u, real dx, real dy, const Ends *ends, real arcs, real_2 interval) {
    const real wx = ends->wx, wy = ends->wy;
    const real begin = interval.a0, end_ = interval.a1;
    const real_3 tangent_1 = tangent(u, dx - wx * begin, dy - wy * begin);
    real straight = tangent_1.a0;
    const real e1 = tangent_1.a1, e2 = tangent_1.a2;
    real time = begin, p1 = e1, p2 = e2, turned = REAL(0.0);
    for (integer pass_1 = 0; pass_1 < NEWTON_STEPS; pass_1++) {
        const real step = (arcs + turned + straight - time) / (REAL(1.0) + wx * p1 + wy * p2);
        const real before = time;
        time = time + step;
        const real across = (wx * p2 - wy * p1) * step;
        /* The next step would be `across`^2 / (2 straight (1 + w . p)). */
        if (time <= before || time > end_ || across * across <= NO_STEP * straight * time) {
            break;
        }
        const real_3 tangent_2 = tangent(u, dx - wx * time, dy - wy * time);
        straight = tangent_2.a0;
        p1 = tangent_2.a1;
        p2 = tangent_2.a2;
        /* The direction turns one way only, by no more than pi in all. */
        turned = REAL(2.0) * (real)u * real_atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2);
    }
    return time;
}

/* The LSR or RSL at the first root in an interval throughout which the centres are at least two radii apart.
 *
 * With its arcs continued beyond whole turns, length - T is convex and falls with the slope -(1 + w . p). So for
 * each number of turns it has at most one root, and Newton's method converges to it from the beginning of the
 * interval.
 */
static inline Path first_lsr_rsl(integer u, real dx, real dy, const Ends *ends, real_2 interval) {
    const real c0 = ends->c0, s0 = ends->s0, c = ends->c, s = ends->s, wx = ends->wx, wy = ends->wy,
            arc_tolerance = ends->arc_tolerance;
    const real begin = interval.a0, end_ = interval.a1;
    const real_3 tangent_1 = tangent(u, dx - wx * begin, dy - wy * begin);
    real straight = tangent_1.a0;
    const real e1 = tangent_1.a1, e2 = tangent_1.a2;
    real first = angle(arc_rotation(u, c0, s0, e1, e2)), last = angle(arc_rotation(u, c, s, e1, e2));
    const real arcs = first + last, growth = arc_growth(u, dx, dy, ends, interval);
    /* An arc that grows beyond a whole turn loses it, one that shrinks below zero gains one. */
    const real least = min_real(first, last) + growth, most = max_real(first, last) + growth;
    const integer fewest = max_integer(-passes(least, TWO_PI) - passes(most, TWO_PI), integer_of(real_ceil((begin -
            arcs - straight) / TWO_PI)));
    const integer gained = passes(-least, REAL(0.0)) + passes(-most, REAL(0.0));
    const integer last_1 = gained + 1;
    for (integer turns = fewest; turns < last_1; turns++) {
        const real time = lsr_rsl_root(u, dx, dy, ends, arcs + TWO_PI * (real)turns, interval);
        if (time > end_) {
            break;
        }
        const real_3 tangent_2 = tangent(u, dx - wx * time, dy - wy * time);
        straight = tangent_2.a0;
        const real p1 = tangent_2.a1, p2 = tangent_2.a2;
        first = arc_time(arc_rotation(u, c0, s0, p1, p2), REAL(1.0) + straight, arc_tolerance);
        last = arc_time(arc_rotation(u, c, s, p1, p2), REAL(1.0), arc_tolerance);
        if (real_fabs(first + straight + last - time) < REAL(3.141592653589793)) {
            return MAKE(Path){first + straight + last, encode(u, 0, -u), first, straight, last, REAL(1.0), p1, p2};
        }
    }
    return NO_PATH;
}

/* The first LSR (u = +1) or RSL whose time is at most `until`; the centres must be at least two radii apart. */
static inline Path lsr_rsl(integer u, real dx, real dy, const Ends *ends, real until_) {
    /* Circles that overlap by rounding count as touching: two arcs without a straight piece. */
    const real_2 time_within_1 = time_within(dx, dy, ends->wx, ends->wy, REAL(2.0) - ends->arc_tolerance);
    const real enter = time_within_1.a0, leave = time_within_1.a1;
    Path path = NO_PATH;
    if (enter > REAL(0.0)) {
        path = first_lsr_rsl(u, dx, dy, ends, MAKE(real_2){REAL(0.0), min_real(enter, until_)});
    }
    if (path.time == REAL_INFINITY && leave < until_) {
        path = first_lsr_rsl(u, dx, dy, ends, MAKE(real_2){leave, until_});
    }
    return path;
}

/* The m in (0, 2 pi) at which h(m) = |d - 2 w m|^2 - 8 (1 - cos m) rises through zero.
 *
 * `inf` where it does not, or not within an interval. h'' = 8 (w^2 - cos m), and h >= 0 at 0 and 2 pi. With i =
 * acos(w^2), h is concave up to i and has no such root there. It is convex up to 2 pi - i and may have one there;
 * if it is negative at 2 pi - i, it has one beyond, where it is concave.
 */
static inline real middle_arc(real dx, real dy, real wx, real wy, real_2 within) {
    const real inflection = real_acos(wx * wx + wy * wy);
    real least = within.a0;
    const real most = within.a1;
    least = max_real(least, inflection);
    const real outer = TWO_PI - inflection;
    real m = min_real(outer, most);
    bool concave = false;
    for (integer step = 0; step < NEWTON_STEPS; step++) {
        if (m < least && !concave) {
            return REAL_INFINITY;
        }
        const real x = dx - REAL(2.0) * m * wx, y = dy - REAL(2.0) * m * wy;
        const real across = real_sin(REAL(0.5) * m), along = real_cos(REAL(0.5) * m);
        const real h = x * x + y * y - REAL(16.0) * across * across;
        const real slope = -REAL(4.0) * (wx * x + wy * y) - REAL(16.0) * across * along;
        if (step == 0) {
            concave = h < REAL(0.0);
        }
        /* The root lies beyond `most` where h is still negative there. */
        if (slope <= REAL(0.0) || (concave && m >= most)) {
            return REAL_INFINITY;
        }
        const real before = m;
        m = m - h / slope;
        if (concave ? m <= before : m >= before) {
            break;
        }
    }
    return m;
}

/* LRL or RLR with a given middle arc between circles whose centres are d = -4 sin(m/2) p apart. */
static inline Path three_arcs(integer u, real middle, real dx, real dy, const Ends *ends) {
    const real c0 = ends->c0, s0 = ends->s0, c = ends->c, s = ends->s, arc_tolerance =
            ends->arc_tolerance;
    const real distance = length(dx, dy);
    const bool chosen_1 = distance > REAL(0.0);
    const real p1 = chosen_1 ? -dx / distance : REAL(1.0), p2 = chosen_1 ? -dy / distance : REAL(0.0);
    const real lam = -real_cos(REAL(0.5) * middle), across = real_sin(REAL(0.5) * middle);
    /* The headings at the two switches: p turned by the angle whose cosine is lambda, against the sense of the outer */
    /* arcs at the first switch and in their sense at the second. */
    const real ax = lam * p1 + (real)u * across * p2, ay = lam * p2 - (real)u * across * p1;
    const real bx = lam * p1 - (real)u * across * p2, by = lam * p2 + (real)u * across * p1;
    const real first = arc_time(arc_rotation(u, c0, s0, ax, ay), REAL(4.0), arc_tolerance);
    const real last = arc_time(arc_rotation(u, bx, by, c, s), REAL(1.0), arc_tolerance);
    return MAKE(Path){first + middle + last, encode(u, -u, u), first, middle, last, lam, p1, p2};
}

/* The first LRL (u = +1) or RLR whose time T is at most `until`: T = 2 t2 + rotation from start to pose + turns.
 *
 * Only a path with p . w + lambda >= 0 can be the first; for each number of whole turns there is at most one such
 * path.
 */
static inline Path lrl_rlr(integer u, real dx, real dy, const Ends *ends, real until_) {
    const real c0 = ends->c0, s0 = ends->s0, c = ends->c, s = ends->s, wx = ends->wx, wy = ends->wy,
            arc_tolerance = ends->arc_tolerance;
    const real_2 time_within_1 = time_within(dx, dy, wx, wy, REAL(4.0));
    const real enter = time_within_1.a0, leave = time_within_1.a1;
    Path best = NO_PATH;
    if (enter <= until_) {
        const real rotation = arc_time(arc_rotation(u, c0, s0, c, s), REAL(1.0), arc_tolerance);
        const real each_turns_1[3] = {-REAL(1.0), REAL(0.0), REAL(1.0)};
        for (int i_1 = 0; i_1 < 3; i_1++) {
            const real turns = each_turns_1[i_1];
            const real outside = rotation + TWO_PI * turns;
            const real limit = min_real(min_real(leave + arc_tolerance, until_), best.time);
            const real_2 within = MAKE(real_2){REAL(0.5) * (enter - outside) - ALMOST, REAL(0.5) * (limit - outside)
                    + ALMOST};
            const real middle = middle_arc(dx - wx * outside, dy - wy * outside, wx, wy, within);
            const real time = outside + REAL(2.0) * middle;
            if (REAL_INFINITY > time && (enter - arc_tolerance <= time && time <= limit)) {
                const Path path = three_arcs(u, middle, dx - wx * time, dy - wy * time, ends);
                if (real_fabs(path.time - time) < REAL(3.141592653589793)) {
                    best = path;
                }
            }
        }
    }
    return best;
}

/* The first path to a point of joining of a set of words; `NO_PATH` where it takes longer than `until`. */
static inline Path first_path_of(integer words, real phase, integer side, const WindScene *scene, real until_) {
    const real x = scene->x, y = scene->y, c0 = scene->c, s0 = scene->s, R = scene->R, wx = scene->wx,
            wy = scene->wy, arc_tolerance = scene->arc_tolerance;
    const real_5 hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, c = hold_pose_1.a2, s = hold_pose_1.a3;
    const real dx = px - x, dy = py - y;
    Path best = NO_PATH;
    if (interception(dx, dy, wx, wy) <= until_ + arc_tolerance) {
        const Ends ends = MAKE(Ends){c0, s0, c, s, wx, wy, arc_tolerance};
        /* The vectors are those from the centre of the first arc to that of the last. The words that take least to find */
        /* are tried first. */
        Path path;
        const integer each_u_1[2] = {1, -1};
        for (int i_1 = 0; i_1 < 2; i_1++) {
            const integer u = each_u_1[i_1];
            if ((words & set_of(encode(u, 0, u))) != 0) {
                path = lsl_rsr(u, dx - (real)u * (s - s0), dy + (real)u * (c - c0), &ends, min_real(until_,
                        best.time));
                best = faster_path(&best, &path, until_);
            }
        }
        const integer each_u_2[2] = {1, -1};
        for (int i_2 = 0; i_2 < 2; i_2++) {
            const integer u = each_u_2[i_2];
            if ((words & set_of(encode(u, 0, -u))) != 0) {
                path = lsr_rsl(u, dx + (real)u * (s + s0), dy - (real)u * (c + c0), &ends, min_real(until_,
                        best.time));
                best = faster_path(&best, &path, until_);
            }
        }
        const integer each_u_3[2] = {1, -1};
        for (int i_3 = 0; i_3 < 2; i_3++) {
            const integer u = each_u_3[i_3];
            if ((words & set_of(encode(u, -u, u))) != 0) {
                path = lrl_rlr(u, dx - (real)u * (s - s0), dy + (real)u * (c - c0), &ends, min_real(until_,
                        best.time));
                best = faster_path(&best, &path, until_);
            }
        }
    }
    return best;
}

/* The derivative of the time of the path with respect to the point of joining, in units of hold time, (6).
 *
 * It is zero where the adjoint is transversal to the circle, and it never exceeds 1.
 */
static inline real join_slope(const Path *path, real phase, integer side, const WindScene *scene) {
    const real_5 hold_pose_1 = hold_pose(phase, side, scene->R, scene->wx, scene->wy);
    const real c = hold_pose_1.a2, s = hold_pose_1.a3;
    const real along = path->p1 * c + path->p2 * s, drift = path->p1 * scene->wx + path->p2 * scene->wy;
    const integer_3 controls_2 = controls(path->word);
    const integer last = controls_2.a2;
    const real rate = (real)(side * last) * hold_rate(phase, side, scene->R, scene->wx, scene->wy);
    return (along + drift - rate * (path->lam - along)) / (path->lam + drift);
}

/* The point of joining at a phase, for a set of words. */
static inline JoinPoint join_point(integer words, real phase, integer side, const WindScene *scene) {
    const Path path = first_path_of(words, phase, side, scene, REAL_INFINITY);
    return MAKE(JoinPoint){phase, path, join_slope(&path, phase, side, scene)};
}

/* The refinement after a step towards where the time falls, twice as long as the last one. */
static inline void bracket(Refinement *refinement, const WindScene *scene) {
    JoinPoint here = refinement->here;
    const integer steps = refinement->steps;
    const real step = refinement->width * (real)shift_left(1, steps);
    JoinPoint other = join_point(ALL_WORDS, here.phase + (here.slope < REAL(0.0) ? step : -step),
            refinement->side, scene);
    bool is_enclosed = other.path.time > here.path.time;
    if (!is_enclosed) {
        const JoinPoint new_here = other;
        const JoinPoint new_other = here;
        here = new_here;
        other = new_other;
        is_enclosed = here.slope * other.slope <= REAL(0.0);
    }
    if (!is_enclosed && steps + 1 < BRACKETING_STEPS) {
        refinement->here = here;
        refinement->steps = steps + 1;
        return;
    }
    const integer words = (set_of(here.path.word) | set_of(other.path.word));
    refinement->stage = ENCLOSING;
    refinement->here = here;
    refinement->other = other;
    refinement->last = other;
    refinement->words = words;
    refinement->bisect = false;
    refinement->steps = 0;
    return;
}

/* Whether two paths are of different words, or an arc has lost or gained a whole turn between them. */
static inline bool has_changed(const Path *a, const Path *b) {
    return a->word != b->word || max_real(real_fabs(a->t1 - b->t1), real_fabs(a->t3 - b->t3)) >
            REAL(3.141592653589793);
}

/* Where the slope is zero by the secant through two points; `inf` where there is none.
 *
 * Nor is there one through points on either side of a corner at which the slope does not change its sign.
 */
static inline real secant_phase(const JoinPoint *a, const JoinPoint *b) {
    if (a->slope == b->slope || (a->slope * b->slope > REAL(0.0) && has_changed(&a->path, &b->path))) {
        return REAL_INFINITY;
    }
    return a->phase + (b->phase - a->phase) * (a->slope / (a->slope - b->slope));
}

/* Whether the time at a phase, where the slope should be zero, is lower by no more than rounding. */
static inline bool is_worthless(const JoinPoint *here, real there, const WindScene *scene) {
    const real slowest = REAL(1.0) - length(scene->wx, scene->wy);
    return real_fabs(there - here->phase) * real_fabs(here->slope) * scene->R * WORTH <= here->path.time *
            slowest;
}

/* Whether a phase lies between those of two points. */
static inline bool is_between(real phase, const JoinPoint *a, const JoinPoint *b) {
    return min_real(a->phase, b->phase) < phase && phase < max_real(a->phase, b->phase);
}

/* The phase between two points of different words where the path consists of two arcs; `inf` if none is found. */
static inline real corner_phase(const JoinPoint *here, const JoinPoint *other, integer side, const WindScene *scene)
        {
    if (here->path.word != other->path.word) {
        const JoinPoint each_point_1[2] = {(*here), (*other)};
        for (int i_1 = 0; i_1 < 2; i_1++) {
            const JoinPoint point = each_point_1[i_1];
            const WindCandidate stored_1 = MAKE(WindCandidate){point.phase, side, point.path};
            Entry arcs = two_arc_entry(&stored_1, REAL_INFINITY);
            if (arcs.word != 0) {
                const Entry_real fit_two_arcs_2 = fit_two_arcs(arcs, point.phase, scene);
                arcs = fit_two_arcs_2.a0;
                const real phase = fit_two_arcs_2.a1;
                const bool fits = min_real(arcs.t1, arcs.t2) >= REAL(0.0) && end_miss(arcs, phase, scene) <=
                        REAL(3.0) * scene->arc_tolerance;
                if (fits && is_between(phase, here, other)) {
                    return phase;
                }
            }
        }
    }
    return REAL_INFINITY;
}

/* A point just before or after a corner from where the time falls further; its path is `NO_PATH` for none. */
static inline JoinPoint falling_beside(const JoinPoint *corner, integer side, const WindScene *scene) {
    const real latest = corner->path.time + scene->arc_tolerance;
    const real each_shift_1[2] = {-AT_CORNER, AT_CORNER};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const real shift = each_shift_1[i_1];
        const JoinPoint beside = join_point(ALL_WORDS, corner->phase + shift, side, scene);
        if (beside.path.time <= latest && beside.slope * shift < REAL(0.0)) {
            return beside;
        }
    }
    return MAKE(JoinPoint){corner->phase, NO_PATH, REAL(0.0)};
}

/* The refinement after another point between those that enclose the minimum. */
static inline void enclose(Refinement *refinement, const WindScene *scene) {
    const integer side = refinement->side;
    JoinPoint here = refinement->here, other = refinement->other, last = refinement->last;
    integer words = refinement->words;
    bool bisect = refinement->bisect;
    const integer steps = refinement->steps;
    const real secant = secant_phase(&here, &last);
    /* Across a corner the secant does not show how far the minimum is. */
    if (is_worthless(&here, has_changed(&here.path, &last.path) ? other.phase : secant, scene)) {
        refinement->stage = COMPARING;
        return;
    }
    const real corner = integer_modulo(steps, 4) == 1 ? corner_phase(&here, &other, side, scene) : REAL_INFINITY;
    real there = is_between(corner, &here, &other) ? corner : REAL(0.5) * (here.phase + other.phase);
    const bool use_secant = there != corner && !bisect && is_between(secant, &here, &other);
    if (use_secant) {
        there = secant;
    }
    if (there == here.phase || there == other.phase) {
        refinement->stage = COMPARING;
        return;
    }
    const real flattest = min_real(real_fabs(here.slope), real_fabs(last.slope));
    last = join_point(words, there, side, scene);
    if (last.path.time > here.path.time && has_changed(&here.path, &last.path)) {
        last = join_point(ALL_WORDS, there, side, scene);
        words |= set_of(last.path.word);
    }
    /* A secant that helps little is followed by a bisection. */
    bisect = use_secant && real_fabs(last.slope) > REAL(0.5) * flattest;
    if (last.path.time > here.path.time + scene->arc_tolerance) {
        other = last;
    } else if (there == corner) {
        const JoinPoint beside = falling_beside(&last, side, scene);
        if (beside.path.time == REAL_INFINITY) {
            refinement->stage = COMPARING;
            refinement->here = last;
            return;
        }
        other = is_between(beside.phase, &last, &other) ? other : here;
        here = beside;
    } else {
        if (here.slope * last.slope < REAL(0.0)) {
            other = here;
        }
        const JoinPoint new_here = last;
        const JoinPoint new_last = here;
        here = new_here;
        last = new_last;
    }
    const integer stage = steps + 1 < REFINING_STEPS ? ENCLOSING : COMPARING;
    refinement->stage = stage;
    refinement->here = here;
    refinement->other = other;
    refinement->last = last;
    refinement->words = words;
    refinement->bisect = bisect;
    refinement->steps = steps + 1;
    return;
}

/* The local minimum at which a refinement has ended. */
static inline WindCandidate minimum_of(const Refinement *refinement) {
    return MAKE(WindCandidate){refinement->here.phase, refinement->side, refinement->here.path};
}

/* The first path to a point of joining, the best of the six words; `NO_PATH` where it takes longer than `until`. */
static inline Path first_path(real phase, integer side, const WindScene *scene, real until_) {
    return first_path_of(ALL_WORDS, phase, side, scene, until_);
}

/* A faster path, of any word, to the point of a candidate or a little before or after it; otherwise `NO_PATH`. */
static inline WindCandidate faster_nearby(const WindCandidate *found, const WindScene *scene) {
    const real until_ = found->path.time - scene->arc_tolerance;
    const real beside = BESIDE * min_real(found->path.time, REAL(1.0));
    const real each_shift_1[3] = {REAL(0.0), -beside, beside};
    for (int i_1 = 0; i_1 < 3; i_1++) {
        const real shift = each_shift_1[i_1];
        const Path path = first_path(found->phase + shift, found->side, scene, until_);
        if (path.time < REAL_INFINITY) {
            return MAKE(WindCandidate){found->phase + shift, found->side, path};
        }
    }
    return MAKE(WindCandidate){found->phase, found->side, NO_PATH};
}

/* The refinement that begins at a point; its first step is as wide as `width`, radians. */
static inline Refinement refinement_from(const JoinPoint *start, integer side, real width) {
    Refinement changed_1 = NO_REFINEMENT;
    changed_1.stage = BRACKETING;
    changed_1.side = side;
    changed_1.width = width;
    changed_1.here = (*start);
    return changed_1;
}

/* The refinement of a candidate. */
static inline Refinement begin_refinement(const WindCandidate *found, real width, const WindScene *scene) {
    const real slope = join_slope(&found->path, found->phase, found->side, scene);
    const JoinPoint stored_1 = MAKE(JoinPoint){found->phase, found->path, slope};
    return refinement_from(&stored_1, found->side, width);
}

/* The refinement of a faster path, of any word, to its minimum or to a point beside it, if there is one. */
static inline void compare_nearby(Refinement *refinement, const WindScene *scene) {
    const WindCandidate stored_1 = minimum_of(refinement);
    const WindCandidate faster = faster_nearby(&stored_1, scene);
    if (faster.path.time == REAL_INFINITY) {
        refinement->stage = REFINED;
        return;
    }
    const Refinement again = begin_refinement(&faster, refinement->width, scene);
    const integer enclosures = refinement->enclosures + 1;
    Refinement changed_2 = again;
    changed_2.stage = enclosures < REFINEMENTS ? BRACKETING : REFINED;
    changed_2.enclosures = enclosures;
    *refinement = changed_2;
    return;
}

/* The refinement after another step, which tries a point, or a few; it has not ended yet. */
static inline void refine(Refinement *refinement, const WindScene *scene) {
    if (refinement->stage == BRACKETING) {
        bracket(refinement, scene);
        return;
    }
    if (refinement->stage == ENCLOSING) {
        enclose(refinement, scene);
        return;
    }
    compare_nearby(refinement, scene);
    return;
}

/* The leaf after one, by its number. */
static inline CellVisit next_leaf(integer leaf) {
    return MAKE(CellVisit){leaf + 1, LEAF, ALL_WORDS};
}

/* The search at the beginning of its next stage, on the other side; the result after the last one. */
static inline void next_stage(WindSearch *search) {
    const integer stage = search->stage + 1, side = -search->side;
    if (stage == ENDED) {
        end_search(search);
        return;
    }
    CellVisit visit = FIRST_CELL;
    if (stage > COARSE_OTHER || search->sides == -side) {
        const integer first = search->others.first, second = search->others.second, third =
                search->others.third, fourth = search->others.fourth;
        visit = next_leaf((((first | second) | third) | fourth) != 0 ? -1 : shift_left(FIRST_CELLS, LEAF));
    }
    const Leaves new_1 = search->others;
    const Leaves new_2 = search->leaves;
    search->stage = stage;
    search->side = side;
    search->visit = visit;
    search->before = NO_LEAF_END;
    search->leaves = new_1;
    search->others = new_2;
    search->corner = NO_CORNER;
    search->compared = REAL_INFINITY;
    search->visits = 0;
    return;
}

/* Whether a cell needs not be halved further. */
static inline bool is_done(CellVisit visit, OpenCell cell, const WindCandidate *best) {
    return visit.level == LAST || cell.earliest >= best->path.time - cell.tolerance;
}

/* The first half of a cell inside which a set of words may join. */
static inline CellVisit first_half(CellVisit visit, integer possible) {
    const integer words = visit.level < NARROWED ? (shift_left(visit.words, 6) | possible) : visit.words;
    return MAKE(CellVisit){2 * visit.number, visit.level + 1, words};
}

/* The cell after one that needs not be halved: the largest that begins there and is not yet visited. */
static inline CellVisit next_cell(CellVisit visit) {
    integer number = visit.number + 1, level = visit.level, words = visit.words;
    while (level > 0 && integer_modulo(number, 2) == 0) {
        const integer new_number = integer_quotient(number, 2);
        const integer new_level = level - 1;
        const integer new_words = level <= NARROWED ? (words >> 6) : words;
        number = new_number;
        level = new_level;
        words = new_words;
    }
    return MAKE(CellVisit){number, level, words};
}

/* The cell after one of a leaf in which a set of words may join: its first half, the next one, or the next leaf. */
static inline CellVisit next_in_leaves(CellVisit visit, integer words) {
    const integer leaf = (visit.number >> (visit.level - LEAF));
    visit = words != 0 ? first_half(visit, words) : next_cell(visit);
    return visit.level >= LEAF && (visit.number >> (visit.level - LEAF)) == leaf ? visit : next_leaf(leaf);
}

/* The search with a refinement continued until it ends, and with its result then. */
static inline void refine_path(WindSearch *search) {
    Refinement refinement = search->refinement;
    integer left = search->left;
    const WindScene scene = search->scene;
    while (refinement.stage != REFINED && left > 0) {
        Refinement changed_1 = refinement;
        refine(&changed_1, &scene);
        refinement = changed_1;
        left = left - 1;
    }
    search->refinement = refinement;
    search->left = left;
    if (refinement.stage != REFINED) {
        return;
    }
    const WindCandidate found = minimum_of(&refinement), best = search->best;
    if (search->stage == JOINING) {
        /* The better side is searched first, which shortens the search on the other side. */
        search->best = found;
        search->side = found.side != 0 ? -found.side : -1;
        if (found.path.time > REAL(0.0)) {
            next_stage(search);
            return;
        }
        end_search(search);
        return;
    }
    if (search->stage <= COARSE_OTHER) {
        search->best = found.path.time < best.path.time ? found : best;
        return;
    }
    const integer words = is_done(search->visit, search->cell, &found) ? 0 : search->cell.words;
    const CellVisit new_2 = next_in_leaves(search->visit, words);
    search->best = found;
    search->visit = new_2;
    return;
}

/* The fastest of `best` and the paths to `JOINS` points around the circle, where possible with a straight piece. */
static inline WindCandidate best_of_joins(integer side, const WindScene *scene, WindCandidate best) {
    for (integer i = 0; i < JOINS; i++) {
        const real phase = TWO_PI / (real)JOINS * ((real)i + REAL(0.5));
        const integer words = best.path.time < REAL_INFINITY ? WITH_STRAIGHT : ALL_WORDS;
        const Path path = first_path_of(words, phase, side, scene, best.path.time);
        if (path.time < best.path.time) {
            best = MAKE(WindCandidate){phase, side, path};
        }
    }
    return best;
}

/* The search with the points of joining on one side tried; then the best path is refined. */
static inline void join_one_side(WindSearch *search) {
    WindCandidate best = search->best;
    const WindScene scene = search->scene;
    const integer side = search->side;
    if (search->sides != -side) {
        best = best_of_joins(side, &scene, best);
    }
    const Refinement refinement = side == 1 ? NO_REFINEMENT : begin_refinement(&best, TWO_PI / (real)JOINS, &scene);
    const integer new_1 = search->left - 1;
    search->best = best;
    search->side = -side;
    search->left = new_1;
    search->refinement = refinement;
    return;
}

/* The phase in the middle of a cell, and half its width. */
static inline real_2 middle_of(CellVisit visit) {
    const real half = REAL(0.5) * TWO_PI / (real)shift_left(FIRST_CELLS, visit.level);
    return MAKE(real_2){half * (REAL(2.0) * (real)visit.number + REAL(1.0)), half};
}

/* The cell around a phase. */
static inline Cell cell_at(real phase, real half, integer side, const WindScene *scene) {
    const real x = scene->x, y = scene->y, c0 = scene->c, s0 = scene->s, R = scene->R, wx = scene->wx,
            wy = scene->wy;
    const real_5 hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, c = hold_pose_1.a2, s = hold_pose_1.a3, g = hold_pose_1.a4;
    const real wind = length(wx, wy), out = (wx * px + wy * py) / R;
    const real crab = real_sqrt((REAL(1.0) - out) * (REAL(1.0) + out));
    /* The heading turns by g/crab, from 1 - |w| upwind to 1 + |w| downwind; that changes most across the wind. */
    const real turning = g / crab, twist = wind / real_sqrt((REAL(1.0) - wind) * (REAL(1.0) + wind));
    const real fastest_turning = min_real(REAL(1.0) + wind, turning + twist * half);
    const real bend = R + fastest_turning * fastest_turning + twist;
    const real tx = R * (c + wx) / g, ty = R * (s + wy) / g;
    const real still = (REAL(1.0) - wind) * (REAL(1.0) + wind);
    const real turned_more = (real)side * out * still / (crab * crab * crab);
    const real jerk = twist * (REAL(1.0) + REAL(2.0) * wind * wind) / still;
    const real bend_change = R + jerk + REAL(3.0) * fastest_turning * twist + fastest_turning * fastest_turning *
            fastest_turning;
    return MAKE(Cell){half, px - x, py - y, c, s, tx, ty, -px, -py, (real)-side * turning, turned_more, bend,
            bend_change, twist, jerk, fastest_turning, wind, c0, s0, wx, wy};
}

/* Whether no vehicle, however fast it turns, reaches the cell before the time. */
static inline bool is_out_of_reach(const Cell *cell, real radius, real time) {
    return length(cell->px - cell->wx * time, cell->py - cell->wy * time) >= time + radius * cell->half;
}

/* The centres of the first and the last arc of a word with these controls. */
static inline Centres centres(integer first, integer last, const Cell *cell) {
    const real x = cell->px - (real)last * cell->s + (real)first * cell->s0, y = cell->py + (real)last *
            cell->c - (real)first * cell->c0;
    const real turning = cell->turning, c = cell->c, s = cell->s;
    const real dx = cell->tx - (real)last * turning * c, dy = cell->ty - (real)last * turning * s;
    const real ddx = cell->nx - (real)last * (cell->turned_more * c - turning * turning * s);
    const real ddy = cell->ny - (real)last * (cell->turned_more * s + turning * turning * c);
    const real rate = length(dx, dy);
    const real change = (rate + REAL(0.5) * cell->bend * cell->half) * cell->half;
    return MAKE(Centres){x, y, dx, dy, ddx, ddy, change, rate + cell->bend * cell->half};
}

/* An angle in [0, 2 pi), or one turn less where a change by as much as `change` may bring it back to zero. */
static inline real lowest_turn(real turn, real change) {
    return turn + change >= TWO_PI ? turn - TWO_PI : turn;
}

/* A lower bound, inside a cell, on a function whose second derivative is at least -`bend`. */
static inline real least_inside(real value, real slope, real bend, real half) {
    return value - (real_fabs(slope) + REAL(0.5) * bend * half) * half;
}

/* The second derivative of the length of LSL (or LSR, with `distance` its straight piece) but for that of the arcs.
 *
 * The straight piece has the direction p.
 */
static inline real distance_curvature(real p1, real p2, real distance, const Centres *between) {
    const real across = p1 * between->dy - p2 * between->dx;
    return p1 * between->ddx + p2 * between->ddy + across * across / distance;
}

/* A bound on the derivative of `distance_curvature` inside a cell, where the straight piece is at least `nearest`.
 *
 * `touching` is 2 for LSR, where the direction of the straight piece changes its length too, otherwise 0.
 */
static inline real distance_curvature_change(real nearest, real touching, const Centres *between, const Cell *cell)
        {
    const real swing = between->fastest / nearest;
    return cell->bend_change + (REAL(3.0) * cell->bend + (REAL(3.0) * between->fastest + touching * swing) *
            swing) * swing;
}

/* A lower bound, inside a cell, on a function whose third derivative is at most `change` in size. */
static inline real least_inside_curved(real value, real slope, real curvature, real change, real half) {
    const real steep = real_fabs(slope);
    real least = value - (steep - (REAL(0.5) * curvature - change * half / REAL(6.0)) * half) * half;
    const real square = curvature * curvature - REAL(2.0) * steep * change;
    if (curvature > REAL(0.0) && square > REAL(0.0)) {
        const real lowest = REAL(2.0) * steep / (curvature + real_sqrt(square));
        if (lowest < half) {
            least = min_real(least, value - (steep - (REAL(0.5) * curvature - change * lowest / REAL(6.0)) * lowest)
                    * lowest);
        }
    }
    return least;
}

/* Half the rate at which the length of a word, less the time, falls with the time.
 *
 * Its straight piece has the direction p. The rate is no less while the direction changes by no more than this over
 * |w|.
 */
static inline real slowest_fall(real p1, real p2, const Cell *cell) {
    return REAL(0.5) * (REAL(1.0) + cell->wx * p1 + cell->wy * p2);
}

/* Whether two arcs that add up to `arcs` are too few throughout the cell: the first alone would be longer. */
static inline bool lsl_rsr_needs_turn(integer u, real arcs, const Centres *between, real turned, const Cell *cell) {
    const real wx = cell->wx, wy = cell->wy;
    real x = between->x - wx * arcs, y = between->y - wy * arcs;
    const real straight = interception(x, y, wx, wy);
    x = x - wx * straight;
    y = y - wy * straight;
    const real distance = length(x, y);
    if (distance == REAL(0.0)) {
        return false;
    }
    const real rate = slowest_fall(x / distance, y / distance, cell);
    /* How far the centres move relative to each other, since the time changes too. */
    real shift = between->change + cell->wind * (between->change + turned) / rate;
    const real first = angle(arc_rotation(u, cell->c0, cell->s0, x, y));
    real swing = REAL(0.5) * REAL(3.141592653589793) * shift / distance;
    const bool known = shift < distance && cell->wind * swing <= rate;
    if (known && first - swing <= arcs + turned) {
        /* The rate is known better now. */
        shift = between->change + cell->wind * (between->change + turned) / (REAL(2.0) * rate - cell->wind *
                swing);
        swing = REAL(0.5) * REAL(3.141592653589793) * shift / distance;
    }
    return known && first - swing > arcs + turned && first + swing < TWO_PI;
}

/* The margin of LSL (u = +1) or RSR: the length of the word less the time. */
static inline real lsl_rsr_margin(integer u, const Cell *cell, real time) {
    const Centres between = centres(u, u, cell);
    const real turned = cell->fastest_turning * cell->half;
    const real x = between.x - cell->wx * time, y = between.y - cell->wy * time;
    const real arcs = lowest_turn(angle(arc_rotation(u, cell->c0, cell->s0, cell->c, cell->s)), turned);
    const real distance = length(x, y);
    const real nearer = distance > REAL(0.0) ? (x * between.dx + y * between.dy) / distance : between.change /
            cell->half;
    const real slope = nearer + (real)u * cell->turning, bend = cell->bend + cell->twist, value = distance +
            arcs - time;
    real margin = least_inside(value, slope, bend, cell->half);
    if (margin < REAL(0.0) && REAL(0.0) < distance - between.change) {
        const real curvature = distance_curvature(x / distance, y / distance, distance, &between) + (real)u *
                cell->turned_more;
        const real change = distance_curvature_change(distance - between.change, REAL(0.0), &between, cell) +
                cell->jerk;
        margin = max_real(margin, least_inside_curved(value, slope, curvature, change, cell->half));
    }
    if (margin < REAL(0.0) && lsl_rsr_needs_turn(u, arcs, &between, turned, cell)) {
        return margin + TWO_PI;
    }
    return margin;
}

/* The angle by which the straight piece of LSR or RSL turns at most while the arcs may touch. */
static inline real most_turned(real touching, const Centres *between, const Cell *cell) {
    const real moved = REAL(0.5) * cell->wind * touching;
    return real_acos(REAL(2.0) / (REAL(2.0) + REAL(3.0) * between->change)) + (moved < REAL(1.0) ? REAL(0.5) *
            REAL(3.141592653589793) * moved : REAL(3.141592653589793));
}

/* Whether LSR or RSL has an arc below zero throughout the cell if its two arcs last `arcs` at the beginning.
 *
 * Or whether it is shorter than the time from the beginning on, and `before` that, so that it is never equal to it.
 */
static inline bool lsr_rsl_needs_turn(integer u, const Centres *between, const Cell *cell, real arcs, real_2
        interval, real before) {
    const real begin = interval.a0, end_ = interval.a1;
    const real turned = cell->fastest_turning * cell->half;
    const real_3 tangent_1 = tangent(u, between->x - cell->wx * begin, between->y - cell->wy * begin);
    real straight = tangent_1.a0;
    if (straight + arcs + between->change + turned + (REAL(1.0) + cell->wind) * before < begin) {
        return true;
    }
    const Ends ends = MAKE(Ends){cell->c0, cell->s0, cell->c, cell->s, cell->wx, cell->wy, REAL(0.0)};
    const real time = lsr_rsl_root(u, between->x, between->y, &ends, arcs, interval);
    if (!(begin < time && time < end_)) {
        return false;
    }
    const real x = between->x - cell->wx * time, y = between->y - cell->wy * time;
    const real_3 tangent_2 = tangent(u, x, y);
    straight = tangent_2.a0;
    const real p1 = tangent_2.a1, p2 = tangent_2.a2;
    const real rate = slowest_fall(p1, p2, cell);
    const real later = (between->change + turned) / rate;
    const real moved = between->change + cell->wind * later;
    const real nearest = length(x, y) - moved;
    if (nearest <= REAL(2.0) || time - later <= begin) {
        return false;
    }
    const real swing = moved / real_sqrt(nearest * nearest - REAL(4.0));
    if (cell->wind * swing > rate) {
        return false;
    }
    const real t1 = angle(arc_rotation(u, cell->c0, cell->s0, p1, p2)), t3 = angle(arc_rotation(u, cell->c,
            cell->s, p1, p2));
    const real first = min_real(t1, TWO_PI - t1), last = min_real(t3, TWO_PI - t3);
    return t1 + straight + t3 - time > REAL(3.141592653589793) && first > swing && last > swing + turned;
}

/* The margin of LSR or RSL at the end of an interval, throughout which the centres are further apart than 2.
 *
 * `before` is how long before the interval the arcs may touch, `after` how long after it.
 */
static inline real tangent_margin(integer u, const Centres *between, const Cell *cell, real_2 interval, real before,
        real after) {
    const real begin = interval.a0, time = interval.a1;
    const real x = between->x - cell->wx * time, y = between->y - cell->wy * time;
    const real_3 tangent_1 = tangent(u, x, y);
    const real straight = tangent_1.a0, p1 = tangent_1.a1, p2 = tangent_1.a2;
    const real nearest = length(x, y) - between->change;
    if (nearest <= REAL(2.0)) {
        return -REAL_INFINITY;
    }
    /* The direction of the straight piece turns by less than this inside the cell, and by `earlier` during the interval. */
    real swing = between->change / real_sqrt(nearest * nearest - REAL(4.0));
    if (before + after > REAL(0.0)) {
        swing += most_turned(before + after, between, cell);
    }
    const real_3 tangent_2 = tangent(u, between->x - cell->wx * begin, between->y - cell->wy * begin);
    const real q1 = tangent_2.a1, q2 = tangent_2.a2;
    const real earlier = (real)u * real_atan2(p1 * q2 - p2 * q1, p1 * q1 + p2 * q2);
    const real turned = cell->fastest_turning * cell->half;
    const real first = angle(arc_rotation(u, cell->c0, cell->s0, p1, p2)), last = angle(arc_rotation(u,
            cell->c, cell->s, p1, p2));
    const real slope = p1 * between->dx + p2 * between->dy - (real)u * cell->turning;
    const real middle = straight + first + last - time;
    real value = least_inside(middle, slope, cell->bend + cell->twist, cell->half);
    if (value < REAL(0.0)) {
        const real curvature = distance_curvature(p1, p2, straight, between) - (real)u * cell->turned_more;
        const real change = distance_curvature_change(real_sqrt(nearest * nearest - REAL(4.0)), REAL(2.0), between,
                cell) + cell->jerk;
        value = max_real(value, least_inside_curved(middle, slope, curvature, change, cell->half));
    }
    const real lowest = lowest_turn(first, swing + max_real(earlier, REAL(0.0))) + lowest_turn(last, swing +
            max_real(earlier, REAL(0.0)) + turned);
    value += lowest - first - last;
    /* The arcs at the beginning of the interval, without those turns that either arc may lose. */
    real arcs = lowest + REAL(2.0) * earlier;
    for (integer pass_1 = 0; pass_1 < 3; pass_1++) {
        if (value >= REAL(0.0)) {
            return value;
        }
        if (!lsr_rsl_needs_turn(u, between, cell, arcs, interval, before)) {
            return value;
        }
        value = value + TWO_PI;
        arcs = arcs + TWO_PI;
    }
    return value;
}

/* The margin of LSR (u = +1) or RSL: the length of the word less the time, where the arcs do not overlap. */
static inline real lsr_rsl_margin(integer u, const Cell *cell, real time) {
    const Centres between = centres(u, -u, cell);
    const real wx = cell->wx, wy = cell->wy, change = between.change;
    const real_2 time_within_1 = time_within(between.x, between.y, wx, wy, REAL(2.0) + REAL(2.0) * change);
    const real enter = time_within_1.a0, leave = time_within_1.a1;
    if (enter >= time) {
        return tangent_margin(u, &between, cell, MAKE(real_2){REAL(0.0), time}, REAL(0.0), REAL(0.0));
    }
    real margin = REAL_INFINITY;
    real inner_enter = REAL_INFINITY, inner_leave = REAL_INFINITY;
    if (change < REAL(2.0)) {
        const real_2 time_within_2 = time_within(between.x, between.y, wx, wy, REAL(2.0) - change);
        inner_enter = time_within_2.a0;
        inner_leave = time_within_2.a1;
    }
    real touching;
    if (inner_enter > REAL(0.0)) {
        /* The first arc and the last may touch between these times. */
        touching = min_real(min_real(inner_enter, leave), time) - enter;
        if (enter == REAL(0.0)) {
            return -REAL_INFINITY;
        }
        margin = tangent_margin(u, &between, cell, MAKE(real_2){REAL(0.0), enter}, REAL(0.0), touching);
        margin -= (REAL(1.0) + cell->wind) * touching;
    }
    if (leave <= time) {
        touching = leave - (inner_enter < REAL_INFINITY ? inner_leave : enter);
        const real last = tangent_margin(u, &between, cell, MAKE(real_2){leave, time}, touching, REAL(0.0));
        margin = min_real(margin, last);
    } else if (inner_leave < time || inner_enter == REAL_INFINITY) {
        return -REAL_INFINITY;
    }
    return margin;
}

/* What is left between the outer arcs of LRL or RLR at a time, with a given T less twice its middle arc. */
static inline real middle_margin_at(integer u, const Centres *between, const Cell *cell, real outside, real time) {
    const real x = between->x - cell->wx * time, y = between->y - cell->wy * time;
    const real distance = length(x, y), half_middle = REAL(0.25) * (time - outside);
    if (half_middle <= REAL(0.0) || half_middle >= REAL(3.141592653589793) || distance <= between->change) {
        return -REAL_INFINITY;
    }
    const real turning = cell->fastest_turning;
    const real across = real_sin(half_middle), along = real_cos(half_middle), nearest = distance -
            between->change;
    const real slope = along * (real)u * cell->turning + (x * between->dx + y * between->dy) / distance;
    const real bend = REAL(0.25) * turning * turning + cell->twist + cell->bend + between->fastest *
            between->fastest / nearest;
    const real value = REAL(4.0) * across - distance;
    real margin = least_inside(value, slope, bend, cell->half);
    if (margin < REAL(0.0)) {
        real curvature = -distance_curvature(x / distance, y / distance, distance, between);
        curvature -= REAL(0.25) * across * cell->turning * cell->turning + along * (real)u *
                cell->turned_more;
        real change = distance_curvature_change(nearest, REAL(0.0), between, cell);
        change += (REAL(0.0625) * turning * turning + REAL(0.75) * cell->twist) * turning + cell->jerk;
        margin = max_real(margin, least_inside_curved(value, slope, curvature, change, cell->half));
    }
    return margin;
}

/* The margin of LRL or RLR with a given T less twice its middle arc, of which the middle may last longer.
 *
 * A word that does not join before a later time does not join before this time either.
 */
static inline real middle_margin(integer u, const Centres *between, const Cell *cell, real outside, real time) {
    real margin = middle_margin_at(u, between, cell, outside, time);
    if (margin < REAL(0.0)) {
        const real x = between->x - cell->wx * time, y = between->y - cell->wy * time;
        const real distance = length(x, y);
        if (distance > REAL(0.0)) {
            const real growth = real_cos(REAL(0.25) * (time - outside)) + (x * cell->wx + y * cell->wy) /
                    distance;
            if (growth > REAL(0.0)) {
                const real later = growth / (REAL(0.25) + cell->wind * cell->wind / distance);
                margin = max_real(margin, middle_margin_at(u, between, cell, outside, time + later));
            }
        }
    }
    return margin;
}

/* Whether LRL or RLR with a given T less twice its middle arc exists nowhere in the cell before the time.
 *
 * In `moving_target.middle_arc`, h has a root at which it rises only if it is not positive somewhere between the
 * two points of inflection. There it is convex: it lies above its tangents.
 */
static inline bool has_no_middle(const Centres *between, const Cell *cell, real outside, real time) {
    const real wx = cell->wx, wy = cell->wy;
    const real wind = cell->wind;
    const real turned = cell->fastest_turning * cell->half;
    real low = real_acos(wind * wind);
    real high = min_real(TWO_PI - low, REAL(0.5) * (time - outside + turned));
    /* How far the centres move relative to each other inside the cell, for a given middle arc. */
    const real shift = between->change + wind * turned;
    const real needed = (REAL(8.0) + REAL(3.0) * shift) * shift;
    for (integer pass_1 = 0; pass_1 < TANGENTS; pass_1++) {
        if (low > high) {
            return true;
        }
        const real m = REAL(0.5) * (low + high);
        const real x = between->x - wx * (outside + REAL(2.0) * m), y = between->y - wy * (outside + REAL(2.0) *
                m);
        const real across = real_sin(REAL(0.5) * m), along = real_cos(REAL(0.5) * m);
        const real spare = x * x + y * y - REAL(16.0) * across * across - needed;
        const real slope = -REAL(4.0) * (wx * x + wy * y) - REAL(16.0) * across * along;
        if (spare <= REAL(0.0)) {
            return false;
        }
        /* By the tangent, h is large enough on the side to which it rises, and for some way to the other side. */
        if (slope > REAL(0.0)) {
            high = m - spare / slope;
        } else if (slope < REAL(0.0)) {
            low = m - spare / slope;
        } else {
            return true;
        }
    }
    return false;
}

/* Whether LRL or RLR with a given T less twice its middle arc has an arc below zero throughout the cell. */
static inline bool lrl_rlr_needs_turn(integer u, const Centres *between, const Cell *cell, real outside) {
    const real wx = cell->wx, wy = cell->wy;
    const real wind = cell->wind, turned = cell->fastest_turning * cell->half;
    const real middle = middle_arc(between->x - wx * outside, between->y - wy * outside, wx, wy,
            MAKE(real_2){REAL(0.0), REAL_INFINITY});
    if (middle == REAL_INFINITY) {
        return false;
    }
    const real time = outside + REAL(2.0) * middle;
    const real x = between->x - wx * time, y = between->y - wy * time;
    const real distance = length(x, y);
    const real slope = -REAL(4.0) * (wx * x + wy * y) - REAL(8.0) * real_sin(middle);
    const real shift = between->change + wind * turned;
    /* Near its root, h changes by up to `rise` inside the cell. Its second derivative is at most 16, so the root moves */
    /* by less than twice `rise` over the slope, as long as that does not exceed a sixteenth of the slope. */
    const real rise = (REAL(2.0) * distance + REAL(0.25) * wind * slope + shift) * shift;
    if (REAL(32.0) * rise >= slope * slope || slope <= REAL(0.0)) {
        return false;
    }
    const real longer = REAL(2.0) * rise / slope;
    const real moved = shift + REAL(2.0) * wind * longer;
    if (moved >= distance) {
        return false;
    }
    const real swing = REAL(0.5) * REAL(3.141592653589793) * moved / distance + REAL(0.5) * longer;
    const Ends ends = MAKE(Ends){cell->c0, cell->s0, cell->c, cell->s, wx, wy, REAL(0.0)};
    const Path path = three_arcs(u, middle, x, y, &ends);
    const real first = min_real(path.t1, TWO_PI - path.t1), last = min_real(path.t3, TWO_PI - path.t3);
    return path.time - time > REAL(3.141592653589793) && first > swing && last > swing + turned;
}

/* The margin of LRL (u = +1) or RLR: what is left between its outer arcs once the middle one lasts long enough.
 *
 * Paths whose T less twice the middle arc is `known`, within half a turn, are left out.
 */
static inline real lrl_rlr_margin(integer u, const Cell *cell, real time, real known) {
    const Centres between = centres(u, u, cell);
    const real turned = cell->fastest_turning * cell->half;
    const real_2 time_within_1 = time_within(between.x, between.y, cell->wx, cell->wy, REAL(4.0) +
            between.change);
    const real enter = time_within_1.a0;
    if (enter >= time) {
        return REAL_INFINITY;
    }
    const real arcs = lowest_turn(angle(arc_rotation(u, cell->c0, cell->s0, cell->c, cell->s)), turned);
    const real shortest = REAL(2.0) * real_acos(cell->wind);
    const real each_turns_1[4] = {-REAL(1.0), REAL(0.0), REAL(1.0), REAL(2.0)};
    for (int i_1 = 0; i_1 < 4; i_1++) {
        const real turns = each_turns_1[i_1];
        const real outside = arcs + TWO_PI * turns;
        if (real_fabs(outside - known) < REAL(3.141592653589793)) {
            continue;
        }
        real late = max_real(max_real(outside - turned + REAL(2.0) * shortest, -outside - turned), shortest) - time;
        if (late < REAL(0.0)) {
            late = middle_margin(u, &between, cell, outside, time);
        }
        if (late < REAL(0.0) && !(has_no_middle(&between, cell, outside, time) || lrl_rlr_needs_turn(u, &between,
                cell, outside))) {
            return late;
        }
    }
    return REAL_INFINITY;
}

/* Those of a set of words that may join before a time inside the cell with this middle and half width. */
static inline integer words_inside(real phase, real half, integer words, integer side, const WindScene *scene, real
        time) {
    const Cell cell = cell_at(phase, half, side, scene);
    integer impossible = 0;
    if (is_out_of_reach(&cell, scene->R, time)) {
        return 0;
    }
    const integer each_u_1[2] = {1, -1};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const integer u = each_u_1[i_1];
        const integer lsl = set_of(encode(u, 0, u)), lsr = set_of(encode(u, 0, -u)), lrl = set_of(encode(u, -u, u));
        if ((words & lsl) != 0 && lsl_rsr_margin(u, &cell, time) >= REAL(0.0)) {
            impossible |= lsl;
        }
        if ((words & lsr) != 0 && lsr_rsl_margin(u, &cell, time) >= REAL(0.0)) {
            impossible |= lsr;
        }
        if ((words & lrl) != 0 && lrl_rlr_margin(u, &cell, time, REAL_INFINITY) >= REAL(0.0)) {
            impossible |= lrl;
        }
    }
    return (words & ~impossible);
}

/* An angle, in [-pi, pi). */
static inline real wrap(real angle) {
    return real_modulo(angle + REAL(3.141592653589793), TWO_PI) - REAL(3.141592653589793);
}

/* An upper bound on the time to hold the circle from `phase` - `width` (zero or more) to `phase`.
 *
 * The ground speed rises from the headwind to the tailwind and then falls: it is least at one of the two ends.
 */
static inline real hold_time(real phase, real width, integer side, real R, real wx, real wy) {
    const real_5 hold_pose_1 = hold_pose(phase - width, side, R, wx, wy);
    const real speed_before = hold_pose_1.a4;
    const real_5 hold_pose_2 = hold_pose(phase, side, R, wx, wy);
    const real speed_after = hold_pose_2.a4;
    return R * width / min_real(speed_before, speed_after);
}

/* The first path to the end of a cell, and the time to hold the circle through the cell.
 *
 * `NO_PATH` where that path is later than the best one by more than this time.
 */
static inline Path_real path_to_end(CellVisit visit, integer side, const WindScene *scene, const WindCandidate
        *best) {
    const real_2 middle_of_1 = middle_of(visit);
    const real middle = middle_of_1.a0, half = middle_of_1.a1;
    const real within = hold_time(middle + half, REAL(2.0) * half, side, scene->R, scene->wx, scene->wy);
    return MAKE(Path_real){first_path(middle + half, side, scene, best->path.time + within), within};
}

/* Whether the time has a local minimum in the leaf that ends at `after`; `before` is the end of an earlier leaf. */
static inline bool has_minimum(const LeafEnd *before, const LeafEnd *after) {
    const bool rises = after->point.slope > REAL(0.0), later = after->point.path.time >
            before->point.path.time;
    if (before->number != after->number - 1) {
        return rises;
    }
    return (before->point.slope < REAL(0.0) && (rises || later)) || (rises && !later);
}

/* The words that may still join inside a cell early enough; the last leaf's end; the point to refine, or none.
 *
 * A path that joins inside the cell can follow the circle to the cell's end. So no path into the cell is faster
 * than the first path to its end less the time to hold the circle through the cell.
 */
static inline integer_LeafEnd_JoinPoint examine_cell(CellVisit visit, integer words, integer side, const WindScene
        *scene, const LeafEnd *before, const WindCandidate *best) {
    const real_2 middle_of_1 = middle_of(visit);
    const real middle = middle_of_1.a0, half = middle_of_1.a1;
    const bool holds_best = side == best->side && real_fabs(wrap(best->phase - middle)) <= half;
    if (visit.level < LEAF && holds_best) {
        return MAKE(integer_LeafEnd_JoinPoint){words, (*before), NO_POINT};
    }
    const Path_real path_to_end_2 = path_to_end(visit, side, scene, best);
    const Path path = path_to_end_2.a0;
    if (path.time == REAL_INFINITY) {
        return MAKE(integer_LeafEnd_JoinPoint){0, (*before), NO_POINT};
    }
    if (visit.level < LEAF) {
        return MAKE(integer_LeafEnd_JoinPoint){words, (*before), NO_POINT};
    }
    const LeafEnd after = MAKE(LeafEnd){visit.number, MAKE(JoinPoint){middle + half, path, join_slope(&path, middle
            + half, side, scene)}};
    if (holds_best || !has_minimum(before, &after)) {
        return MAKE(integer_LeafEnd_JoinPoint){words, after, NO_POINT};
    }
    const bool adjoins = before->number == after.number - 1;
    return MAKE(integer_LeafEnd_JoinPoint){words, after, adjoins && before->point.path.time < path.time ?
            before->point : after.point};
}

/* A set of leaves and one more, by its number. */
static inline Leaves with_leaf(Leaves leaves, integer number) {
    const integer first = leaves.first, second = leaves.second, third = leaves.third, fourth = leaves.fourth;
    const integer quarter = integer_quotient(number, LEAVES), leaf = shift_left(1, integer_modulo(number, LEAVES));
    if (quarter == 0) {
        return MAKE(Leaves){(first | leaf), second, third, fourth};
    }
    if (quarter == 1) {
        return MAKE(Leaves){first, (second | leaf), third, fourth};
    }
    if (quarter == 2) {
        return MAKE(Leaves){first, second, (third | leaf), fourth};
    }
    return MAKE(Leaves){first, second, third, (fourth | leaf)};
}

/* The search after cells of one side, until a path has to be refined; some of their leaves are left to search.
 *
 * Cells are visited in the order of their phases, and halved as long as a word may join inside them early enough.
 */
static inline void coarse_search(WindSearch *search) {
    const integer side = search->side;
    const WindScene scene = search->scene;
    const WindCandidate best = search->best;
    CellVisit visit = search->visit;
    LeafEnd before = search->before;
    Leaves leaves = search->leaves;
    integer left = search->left;
    JoinPoint start = NO_POINT;
    while (left > 0 && start.path.time == REAL_INFINITY && visit.number < shift_left(FIRST_CELLS, visit.level)) {
        left -= 1;
        const real_2 middle_of_1 = middle_of(visit);
        integer words = words_inside(middle_of_1.a0, middle_of_1.a1, (visit.words & ALL_WORDS), side, &scene,
                best.path.time);
        if (words != 0 && visit.level >= COARSE) {
            const integer_LeafEnd_JoinPoint examine_cell_2 = examine_cell(visit, words, side, &scene, &before,
                    &best);
            words = examine_cell_2.a0;
            before = examine_cell_2.a1;
            start = examine_cell_2.a2;
            if (words != 0 && visit.level == LEAF) {
                leaves = with_leaf(leaves, visit.number);
                words = 0;
            }
        }
        visit = words != 0 ? first_half(visit, words) : next_cell(visit);
    }
    search->visit = visit;
    search->before = before;
    search->leaves = leaves;
    search->left = left;
    if (start.path.time < REAL_INFINITY) {
        search->refinement = refinement_from(&start, side, TWO_PI / (real)shift_left(FIRST_CELLS, LEAF));
        return;
    }
    if (visit.number < shift_left(FIRST_CELLS, visit.level)) {
        return;
    }
    next_stage(search);
    return;
}

/* Whether a set of leaves contains the one with a number. */
static inline bool has_leaf(Leaves leaves, integer number) {
    const integer first = leaves.first, second = leaves.second, third = leaves.third, fourth = leaves.fourth;
    const integer quarter = integer_quotient(number, LEAVES);
    const integer members = quarter == 0 ? first : quarter == 1 ? second : quarter == 2 ? third : fourth;
    return ((members >> integer_modulo(number, LEAVES)) & 1) != 0;
}

/* By how much a path may be faster than the best one and remain unknown. */
static inline real time_tolerance(const WindCandidate *best, const WindScene *scene) {
    return WIND_TIE_TOLERANCE * (REAL(1.0) + scene->R + best->path.time);
}

/* The tolerance after `MOST_VISITS` cells: an upper bound on the time to hold the circle through `UNKNOWN_ARC`. */
static inline real hold_tolerance(const WindScene *scene) {
    return scene->R / (REAL(1.0) - length(scene->wx, scene->wy)) * UNKNOWN_ARC;
}

/* The two arcs of which the best path consists, up to rounding; `NO_CORNER` for another path. */
static inline Corner corner_of(const WindCandidate *best, const WindScene *scene) {
    Entry arcs = two_arc_entry(best, SHORT);
    if (arcs.word != 0) {
        const Entry_real fit_two_arcs_1 = fit_two_arcs(arcs, best->phase, scene);
        arcs = fit_two_arcs_1.a0;
        const real phase = fit_two_arcs_1.a1;
        if (is_close(arcs, phase, best->path.time, scene)) {
            const integer_3 controls_2 = controls(arcs.word);
            const integer u = controls_2.a0;
            return MAKE(Corner){phase, u, arcs.t1, arcs.t2};
        }
    }
    return NO_CORNER;
}

/* Whether LSR or RSL joins nowhere in the cell more than `longest` before the time of the corner.
 *
 * And whether its arcs remain shorter than a turn.
 */
static inline bool is_late_before(const Centres *between, const Cell *cell, real longest, Corner corner) {
    const integer u = corner.u;
    const real t1 = corner.t1, t2 = corner.t2;
    const real time = t1 + t2, change = between->change, wind = cell->wind;
    const real_2 time_within_1 = time_within(between->x, between->y, cell->wx, cell->wy, REAL(2.0) +
            REAL(2.0) * change);
    const real enter = time_within_1.a0;
    const real apart = change + wind * longest;
    const real arc = max_real(t1, t2 + cell->fastest_turning * cell->half) + real_acos(REAL(2.0) / (REAL(2.0) +
            apart)) + REAL(0.5) * TURNS * apart;
    if (enter > REAL(0.0) && enter >= time - longest) {
        /* The centres come closer until then: the arcs change in one sense. */
        const real_3 tangent_2 = tangent(u, between->x - cell->wx * time, between->y - cell->wy * time);
        const real p1 = tangent_2.a1, p2 = tangent_2.a2;
        const real_3 tangent_3 = tangent(u, between->x, between->y);
        const real q1 = tangent_3.a1, q2 = tangent_3.a2;
        return arc + max_real((real)u * real_atan2(p1 * q2 - p2 * q1, p1 * q1 + p2 * q2), REAL(0.0)) < TWO_PI;
    }
    if (arc >= TWO_PI || change >= REAL(2.0)) {
        return false;
    }
    const real_2 time_within_4 = time_within(between->x, between->y, cell->wx, cell->wy, REAL(2.0) -
            change);
    const real inner_enter = time_within_4.a0, inner_leave = time_within_4.a1;
    if (inner_enter == REAL_INFINITY || inner_leave < time - longest || (enter == REAL(0.0) && inner_enter >
            REAL(0.0))) {
        return false;
    }
    if (inner_enter == REAL(0.0)) {
        return true;
    }
    const real touching = inner_enter - enter;
    return tangent_margin(u, between, cell, MAKE(real_2){REAL(0.0), enter}, REAL(0.0), touching) >= (REAL(1.0) +
            wind) * touching;
}

/* Whether LSR (u = +1) or RSL is never faster than the two arcs inside the cell around their point of joining.
 *
 * Let v be the angle by which the line of centres has turned since the corner. With the straight piece in the
 * direction that it has at the corner, the length would exceed the true one by v^3/3 at most. Where the circles
 * touch, it would be less than the true one by that much at most.
 */
static inline bool straight_vanishes(Corner corner, const Cell *cell) {
    const integer u = corner.u;
    const real t1 = corner.t1, t2 = corner.t2;
    const real time = t1 + t2, half = cell->half, wind = cell->wind;
    const Centres between = centres(u, -u, cell);
    const real x = between.x - cell->wx * time, y = between.y - cell->wy * time;
    const real_3 tangent_1 = tangent(u, x, y);
    const real p1 = tangent_1.a1, p2 = tangent_1.a2;
    const real slope = p1 * between.dx + p2 * between.dy - (real)u * cell->turning, fall = REAL(1.0) + cell->wx
            * p1 + cell->wy * p2;
    const real steep = real_fabs(slope), curvature = p1 * between.ddx + p2 * between.ddy - (real)u *
            cell->turned_more;
    /* v is at most TURNS (|D'| x + |w| s)/2, and (a + b)^3 <= 4 (a^3 + b^3). For s up to `longest` the second cube is */
    /* less than a sixth of `fall` s. */
    const real windy = CUBE * wind * wind * wind;
    const real longest = REAL(1.5) * windy <= fall ? REAL(0.5) : real_sqrt(fall / (REAL(6.0) * windy));
    real change = (cell->bend_change + cell->jerk) / REAL(6.0);
    const real cube = CUBE * between.fastest * between.fastest * between.fastest;
    const real slack = (max_real(-REAL(0.5) * curvature, REAL(0.0)) + (cube + change) * half) * half;
    real latest = REAL(1.2) * (steep + slack) / fall;
    if (steep <= slack || latest * half > longest || between.fastest * half > REAL(0.5)) {
        return false;
    }
    /* The least and the largest s over x, on the side where the word would be faster. */
    const real moved = between.fastest + wind * latest;
    change += REAL(0.25) * CUBE * moved * moved * moved;
    const real shortest = (steep - (max_real(REAL(0.5) * curvature, REAL(0.0)) + change * half) * half) / fall;
    latest = min_real(latest, (steep + (max_real(-REAL(0.5) * curvature, REAL(0.0)) + change * half) * half) /
            fall);
    /* How the square of the distance of the centres changes with x there: the circles must overlap. */
    const real drift = REAL(2.0) * (x * cell->wx + y * cell->wy);
    real apart = REAL(2.0) * (x * between.dx + y * between.dy);
    apart = max_real(drift * shortest, drift * latest) - (slope > REAL(0.0) ? apart : -apart);
    if (shortest < REAL(0.0) || apart + (REAL(2.0) * cell->bend + moved * moved) * half >= REAL(0.0)) {
        return false;
    }
    return is_late_before(&between, cell, longest, corner);
}

/* Whether LRL (u = +1) or RLR is never faster than the two arcs inside the cell around their point of joining.
 *
 * `first` is +1 where its first arc vanishes, -1 where its last does; `middle` and `other` are the durations of the
 * remaining arcs.
 */
static inline bool arc_vanishes(integer u, integer first, real middle, real other, Corner corner, const Cell *cell)
        {
    const real time = corner.t1 + corner.t2, half = cell->half, wind = cell->wind;
    const Centres between = centres(u, u, cell);
    real x = between.x - cell->wx * time, y = between.y - cell->wy * time;
    const real distance = length(x, y), along = real_cos(REAL(0.5) * middle);
    if (distance == REAL(0.0)) {
        return false;
    }
    x = x / distance;
    y = y / distance;
    const real slope = -along * (real)u * cell->turning - x * between.dx - y * between.dy;
    const real fall = -along - x * cell->wx - y * cell->wy, steep = real_fabs(slope);
    if (fall <= REAL(0.0)) {
        return lrl_rlr_margin(u, cell, time, REAL_INFINITY) >= REAL(0.0);
    }
    if (steep == REAL(0.0)) {
        return false;
    }
    const real latest = REAL(2.0) * steep / fall;
    const real rate = between.fastest + wind * latest, nearest = distance - between.change - wind * latest * half;
    const real turning = cell->fastest_turning;
    const real sweep = REAL(0.5) * (turning + latest) * half;
    if (nearest <= REAL(0.0) || !(sweep < middle && middle < TWO_PI - sweep)) {
        return false;
    }
    const real bend = REAL(0.25) * (turning + latest) * (turning + latest) + cell->twist + cell->bend + rate *
            rate / nearest;
    const real spare = REAL(0.5) * bend * half;
    const real swing = (turning + rate / nearest + REAL(0.25) * latest) * half;
    if (spare > steep || swing > SWING || other + swing >= TWO_PI) {
        return false;
    }
    /* How the arc that vanishes changes along x, on the side where the word would be faster. */
    const real turned = (real)u * (x * between.dy - y * between.dx) / distance;
    const real drift = (real)-u * (x * cell->wy - y * cell->wx) / distance;
    const real growth = (real)first * turned - REAL(0.25) * (real)u * cell->turning + (first < 0 ? (real)u *
            cell->turning : REAL(0.0));
    const real sooner = (real)first * drift + REAL(0.25);
    const real sign = slope > REAL(0.0) ? REAL(1.0) : -REAL(1.0);
    const real longer = -sign * growth - min_real(sooner * (steep - spare), sooner * (steep + spare)) / fall;
    if (longer + REAL(0.5) * (cell->twist + cell->bend / nearest + rate * rate / (nearest * nearest)) * half >=
            REAL(0.0)) {
        return false;
    }
    return lrl_rlr_margin(u, cell, time, time - REAL(2.0) * middle) >= REAL(0.0);
}

/* Those of a set of words that may be faster than two arcs within a distance of their point of joining. */
static inline integer words_beside(Corner corner, real reach, integer words, integer side, const WindScene *scene) {
    const Cell cell = cell_at(corner.phase, reach, side, scene);
    integer impossible = 0;
    const integer u = corner.u;
    const integer lsr = set_of(encode(u, 0, -u)), lrl = set_of(encode(u, -u, u)), rlr = set_of(encode(-u, u, -u));
    if ((words & lsr) != 0 && straight_vanishes(corner, &cell)) {
        impossible |= lsr;
    }
    if ((words & lrl) != 0 && arc_vanishes(u, -1, corner.t2, corner.t1, corner, &cell)) {
        impossible |= lrl;
    }
    if ((words & rlr) != 0 && arc_vanishes(-u, 1, corner.t1, corner.t2, corner, &cell)) {
        impossible |= rlr;
    }
    return (words & ~impossible);
}

/* Those of a set of words that may join before a time inside a cell next to the end of the best path.
 *
 * Around a local minimum, bounds hold in a neighbourhood that does not depend on how small cells are.
 */
static inline integer words_beside_best(CellVisit visit, integer words, const WindScene *scene, const WindCandidate
        *best, Corner corner, real sooner) {
    const real_2 middle_of_1 = middle_of(visit);
    const real middle = middle_of_1.a0, half = middle_of_1.a1;
    real reach = real_fabs(wrap(best->phase - middle)) + half;
    if (reach <= NEAR_BEST * half) {
        if (corner.u != 0) {
            reach = real_fabs(wrap(corner.phase - middle)) + half;
            words = words_beside(corner, reach, words, best->side, scene);
        } else {
            words = words_inside(best->phase, reach, words, best->side, scene, sooner);
        }
    }
    return words;
}

/* The time before which no path joins in a cell, as in `examine_cell`; the path to its end if it is faster. */
static inline real_WindCandidate compare_at_end(CellVisit visit, integer side, const WindScene *scene, const
        WindCandidate *best) {
    const real_2 middle_of_1 = middle_of(visit);
    const real middle = middle_of_1.a0, half = middle_of_1.a1;
    const Path_real path_to_end_2 = path_to_end(visit, side, scene, best);
    const Path path = path_to_end_2.a0;
    const real within = path_to_end_2.a1;
    return MAKE(real_WindCandidate){path.time - within, MAKE(WindCandidate){middle + half, path.time <
            best->path.time ? side : 0, path}};
}

/* The search after cells inside the leaves of one side that are left, until a path has to be refined. */
static inline void fine_search(WindSearch *search) {
    const integer side = search->side;
    const WindScene scene = search->scene;
    const WindCandidate best = search->best;
    const Leaves leaves = search->leaves;
    CellVisit visit = search->visit;
    Corner corner = search->corner;
    real compared = search->compared;
    integer visits = search->visits, left = search->left;
    WindCandidate start = NO_CANDIDATE;
    OpenCell cell = search->cell;
    while (left > 0 && start.side == 0 && visit.number < shift_left(FIRST_CELLS, visit.level)) {
        if (visit.level == LEAF && !has_leaf(leaves, visit.number)) {
            visit = next_leaf(visit.number);
            continue;
        }
        left = left - 1;
        visits = visits + 1;
        const real tolerance = visits <= MOST_VISITS ? time_tolerance(&best, &scene) : hold_tolerance(&scene);
        const real sooner = best.path.time - tolerance;
        const real_2 middle_of_1 = middle_of(visit);
        integer words = words_inside(middle_of_1.a0, middle_of_1.a1, (visit.words & ALL_WORDS), side, &scene,
                sooner);
        if (words != 0 && side == best.side) {
            if (best.path.time < compared) {
                corner = corner_of(&best, &scene);
                compared = best.path.time;
            }
            words = words_beside_best(visit, words, &scene, &best, corner, sooner);
        }
        if (words != 0 && integer_modulo(LAST - visit.level, 2) == 0 && visit.level > LEAF) {
            const real_WindCandidate compare_at_end_2 = compare_at_end(visit, side, &scene, &best);
            const real earliest = compare_at_end_2.a0;
            start = compare_at_end_2.a1;
            cell = MAKE(OpenCell){words, earliest, tolerance};
            if (start.side == 0 && is_done(visit, cell, &best)) {
                words = 0;
            }
        }
        if (start.side == 0) {
            visit = next_in_leaves(visit, words);
        }
    }
    search->visit = visit;
    search->corner = corner;
    search->compared = compared;
    search->visits = visits;
    search->left = left;
    search->cell = cell;
    if (start.side != 0) {
        const real_2 middle_of_3 = middle_of(visit);
        const real half = middle_of_3.a1;
        search->refinement = begin_refinement(&start, REAL(2.0) * half, &scene);
        return;
    }
    if (visit.number < shift_left(FIRST_CELLS, visit.level)) {
        return;
    }
    next_stage(search);
    return;
}

/* The search after at most `steps` more steps, each of which takes about as long as trying one point of joining. */
static APART void advance_search(WindSearch *search, integer steps) {
    search->left = steps;
    while (search->stage != ENDED && search->left > 0) {
        if (search->refinement.stage != REFINED) {
            refine_path(search);
        } else if (search->stage == JOINING) {
            join_one_side(search);
        } else if (search->stage <= COARSE_OTHER) {
            coarse_search(search);
        } else {
            fine_search(search);
        }
    }
    return;
}

/* Radius of a coordinated turn, metres: V^2 / (g tan bank). */
static inline real radius_at_bank(real airspeed_m_s, real bank_deg) {
    return airspeed_m_s * airspeed_m_s / (STANDARD_GRAVITY_M_S2 * real_tan(bank_deg * REAL(0.017453292519943295)));
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

/* The model of a vehicle that is as declared after `dt` seconds under a command; `identify` is not needed then. */
static inline VehicleModel fly_as_declared(const VehicleModel *vehicle, real command_deg, real dt) {
    const integer revision = vehicle->revision;
    real bank_deg = vehicle->bank_deg;
    const real rate_deg_s = vehicle->bank_rate_deg_s;
    const VehicleEstimates known = vehicle->estimates;
    bank_deg = bank_after(known.roll.time_s, known.roll.rate_deg_s, bank_deg, command_deg, dt);
    return MAKE(VehicleModel){revision, bank_deg, rate_deg_s, known};
}

/* The average before the first measurement. */
static inline AirAverage first_air(Rings *rings) {
    const Difference near = MAKE(Difference){REAL(0.02), REAL(2.0) * FIRST_NOISE};
    const Difference far = MAKE(Difference){GUST_LAG_S, REAL(2.0) * FIRST_NOISE + FIRST_GUST * GUST_LAG_S};
    const AirSample_ring_64 recent = AirSample_ring_64_filled(&rings->AirSample_ring_64, MAKE(AirSample){REAL(0.0),
            REAL(0.0), REAL(0.0), REAL(0.0)});
    return MAKE(AirAverage){REAL(0.0), REAL(0.0), ASSUMED_S, near, far, CALM_ALONG, recent, SAMPLES - 2};
}

/* The observer before the first measurement. */
static inline Observer first_observer(Rings *rings, real smoothing_s) {
    return MAKE(Observer){smoothing_s, REAL(0.0), first_air(rings), NO_ESTIMATE};
}

/* The history of a bank that has always been this. */
static inline BankHistory constant_history(Rings *rings, real bank_deg) {
    const BankEntry_ring_128 unused = BankEntry_ring_128_filled(&rings->BankEntry_ring_128,
            MAKE(BankEntry){-REAL_INFINITY, bank_deg, REAL(0.0)});
    return MAKE(BankHistory){BankEntry_ring_128_with_last(unused, MAKE(BankEntry){REAL(0.0), bank_deg, REAL(0.0)})};
}

/* What is known before the first measurement, at a bank. */
static inline Sensing first_sensing(Rings *rings, real smoothing_s, real bank_deg) {
    return MAKE(Sensing){FIRST_CLOCK, first_observer(rings, smoothing_s), constant_history(rings, bank_deg),
            bank_deg, NO_ESTIMATE, REAL(0.0), REAL(0.0), REAL(0.0), false};
}

/* The velocity of the air past the circle to plan with, and whether it differs from the declared one.
 *
 * It is the declared one, unless the wind is found to differ from that by more than gusts do.
 */
static inline bool_real_2 planned_wind(const Settings *settings, const VehicleEstimates *known, bool differed) {
    real east = settings->wind_east_m_s, north = settings->wind_north_m_s;
    const real V = known->airspeed_m_s;
    const real share = length(known->wind_east_m_s - east, known->wind_north_m_s - north) / V;
    const bool differs = share > (differed ? WIND_KEPT : WIND_DIFFERS);
    if (differs) {
        east = known->wind_east_m_s;
        north = known->wind_north_m_s;
    }
    east = east - settings->velocity_east_m_s;
    north = north - settings->velocity_north_m_s;
    if (length(east, north) < settings->negligible_wind * V) {
        return MAKE(bool_real_2){differs, REAL(0.0), REAL(0.0)};
    }
    return MAKE(bool_real_2){differs, east, north};
}

/* The widest turn radius with which a circle can be held in a wind that moves past it. */
static inline real widest_turn_m(real airspeed_m_s, real radius_m, real east_m_s, real north_m_s) {
    if (east_m_s == REAL(0.0) && north_m_s == REAL(0.0)) {
        return radius_m;
    }
    const real strength = length(east_m_s, north_m_s) / airspeed_m_s;
    const real scale = min_real(REAL(1.0), STRONGEST_WIND / strength) / airspeed_m_s;
    return radius_m / tightest_radius(scale * east_m_s, scale * north_m_s);
}

/* Bank of a coordinated turn, degrees, from its rate in radians per second: the inverse of `rate_at_bank`. */
static inline real bank_at_rate(real rate, real airspeed_m_s) {
    return real_atan(rate * airspeed_m_s / STANDARD_GRAVITY_M_S2) * REAL(57.29577951308232);
}

/* The bank at which the vehicle turns at a rate, radians per second; degrees with the sign of the rate. */
static inline real bank_for(const VehicleEstimates *known, real rate) {
    return bank_at_rate(rate / known->turn_ratio, known->airspeed_m_s);
}

/* The bank limit, lowered by what the bank overshoots it, but not below what turns of `widest_m` need. */
static inline real present_limit_deg(const Settings *settings, const VehicleEstimates *known, real widest_m) {
    const real declared_deg = settings->limit_deg;
    if (known->overshoot_deg == REAL(0.0)) {
        return declared_deg;
    }
    const real least_deg = LEAST_LIMIT * bank_for(known, known->airspeed_m_s / widest_m);
    return max_real(declared_deg - known->overshoot_deg, min_real(least_deg, declared_deg));
}

/* Whether a roll response differs so much that delays of changes of bank must be computed again. */
static inline bool is_changed(RollValues roll, RollValues before) {
    const real time_s = before.time_s, lag_s = before.lag_s;
    return real_fabs(roll.time_s - time_s) > ROLL_CHANGED * time_s || real_fabs(roll.rate_deg_s - before.rate_deg_s)
            > ROLL_CHANGED * before.rate_deg_s || real_fabs(roll.lag_s - lag_s) > ROLL_CHANGED * time_s;
}

/* A bank in whole half degrees. */
static inline integer half_degrees(real bank_deg) {
    return integer_of(real_ceil(REAL(2.0) * bank_deg - REAL(0.5)));
}

/* How many times the change of bank that is wanted is commanded.
 *
 * With more than the last number the command would have to return to the target faster than its slew rate.
 */
static inline real command_gain(RollValues roll) {
    return min_real(min_real(max_real(roll.time_s / QUICKEST_S, REAL(1.0)), COMMAND_GAIN), REAL(1.0) +
            roll.slew_deg_s / roll.rate_deg_s);
}

/* By how much less is commanded for each degree per second of the bank rate, seconds.
 *
 * With the gain K the bank then obeys tau lag bank'' + (tau + this) bank' + K (bank - target) = 0, with the damping
 * `DAMPING` at least. It is 0 without a lag.
 */
static inline real rate_gain_s(RollValues roll) {
    return max_real(REAL(2.0) * DAMPING * real_sqrt(command_gain(roll) * roll.time_s * roll.lag_s) - roll.time_s,
            REAL(0.0));
}

/* When a small change of bank takes effect. */
static inline TurnOnset small_onset(RollValues roll) {
    const real gain = command_gain(roll);
    const real first_s = (roll.time_s + rate_gain_s(roll)) / gain;
    return MAKE(TurnOnset){first_s, max_real(first_s * first_s - REAL(2.0) * roll.time_s * roll.lag_s / gain,
            REAL(0.0))};
}

/* `turn_delay` without a lag of the bank rate.
 *
 * Let m be the missing bank, p the limit of the roll rate, and g how far the bank limit lies beyond the target. The
 * bank changes at the least of p, (m + g)/tau (the command is at the bank limit) and `command_gain` m/tau. As m
 * shrinks these apply in that order. The time at which m is left follows from each in closed form. The times at
 * which the parts of the change take effect, and the squares of these times, are summed over these three ranges by
 * Gauss's rules.
 */
static inline TurnDelay first_order_delay(RollValues roll, real bank_deg, real target_deg, real limit_deg) {
    const real tau = roll.time_s, p = roll.rate_deg_s, gain = command_gain(roll), m = real_fabs(target_deg -
            bank_deg);
    const real last_s = tau / gain, change = real_tan(target_deg * REAL(0.017453292519943295)) - real_tan(bank_deg *
            REAL(0.017453292519943295));
    const real g = max_real(limit_deg - (target_deg >= bank_deg ? target_deg : -target_deg), REAL(0.0));
    /* The missing bank below which a demand is within the bank limit, and that at which the rate leaves its limit. */
    const real unlimited = gain > REAL(1.0) ? g / (gain - REAL(1.0)) : REAL_INFINITY;
    const bool is_instant = tau == REAL(0.0) && p == REAL_INFINITY;
    if (is_instant || m == REAL(0.0) || m <= min_real(min_real(unlimited, p * last_s), SMALL_CHANGE_DEG)) {
        return MAKE(TurnDelay){last_s * change, last_s * last_s * change};
    }
    const real slow = min_real(max_real(p * tau - g, p * last_s), m);
    const real free = min_real(unlimited, slow);
    const real backward = target_deg > bank_deg ? -REAL(1.0) : REAL(1.0);
    real time_s = (m - slow) / p;
    real whole = REAL(0.0), mean = REAL(0.0), square = REAL(0.0);
    real tangent, share, at_s;
    if (slow < m) {
        const real each_x_1[3] = {LEGENDRE_POINTS.a0, LEGENDRE_POINTS.a1, LEGENDRE_POINTS.a2};
        const real each_w_1[3] = {LEGENDRE_WEIGHTS.a0, LEGENDRE_WEIGHTS.a1, LEGENDRE_WEIGHTS.a2};
        for (int i_1 = 0; i_1 < 3; i_1++) {
            const real x = each_x_1[i_1];
            const real w = each_w_1[i_1];
            tangent = real_tan((target_deg + backward * (slow + x * (m - slow))) * REAL(0.017453292519943295));
            share = w * (m - slow) * (REAL(1.0) + tangent * tangent);
            at_s = (REAL(1.0) - x) * time_s;
            whole = whole + share;
            mean = mean + share * at_s;
            square = square + share * at_s * at_s;
        }
    }
    if (free < slow) {
        /* In the square of a variable the logarithm is smooth where it begins. */
        const real each_x_2[3] = {LEGENDRE_POINTS.a0, LEGENDRE_POINTS.a1, LEGENDRE_POINTS.a2};
        const real each_w_2[3] = {LEGENDRE_WEIGHTS.a0, LEGENDRE_WEIGHTS.a1, LEGENDRE_WEIGHTS.a2};
        for (int i_2 = 0; i_2 < 3; i_2++) {
            const real x = each_x_2[i_2];
            const real w = each_w_2[i_2];
            const real left = free + x * x * (slow - free);
            tangent = real_tan((target_deg + backward * left) * REAL(0.017453292519943295));
            at_s = time_s + tau * real_log((slow + g) / (left + g));
            share = REAL(2.0) * x * w * (slow - free) * (REAL(1.0) + tangent * tangent);
            whole = whole + share;
            mean = mean + share * at_s;
            square = square + share * at_s * at_s;
        }
    }
    if (free > REAL(0.0)) {
        time_s += tau * real_log((slow + g) / (free + g));
        const real each_x_3[3] = {LAGUERRE_POINTS.a0, LAGUERRE_POINTS.a1, LAGUERRE_POINTS.a2};
        const real each_kept_3[3] = {LAGUERRE_SHARES.a0, LAGUERRE_SHARES.a1, LAGUERRE_SHARES.a2};
        const real each_w_3[3] = {LAGUERRE_WEIGHTS.a0, LAGUERRE_WEIGHTS.a1, LAGUERRE_WEIGHTS.a2};
        for (int i_3 = 0; i_3 < 3; i_3++) {
            const real x = each_x_3[i_3];
            const real kept = each_kept_3[i_3];
            const real w = each_w_3[i_3];
            tangent = real_tan((target_deg + backward * free * kept) * REAL(0.017453292519943295));
            at_s = time_s + x * last_s;
            share = w * free * (REAL(1.0) + tangent * tangent);
            whole = whole + share;
            mean = mean + share * at_s;
            square = square + share * at_s * at_s;
        }
    }
    return MAKE(TurnDelay){change * mean / whole, REAL(0.5) * change * square / whole};
}

/* The largest change of bank that counts as infinitely small: its rate is not limited. */
static inline real small_change_deg(RollValues roll) {
    return min_real(SMALL_CHANGE_DEG, roll.rate_deg_s * roll.time_s / command_gain(roll));
}

/* `value`, limited to the range from -`limit` to `limit`. */
static inline real clip(real value, real limit) {
    /* Comparisons take a third of the time of `min` and `max`, and a law clips several values in each step. */
    return value > limit ? limit : value < -limit ? -limit : value;
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

/* The mean of the command over the time in which it may change by `change_deg` on the way to a demand. */
static inline real mean_command(real command_deg, real demand_deg, real change_deg) {
    const real missing_deg = demand_deg - command_deg;
    if (real_fabs(missing_deg) >= change_deg) {
        return command_deg + REAL(0.5) * clip(missing_deg, change_deg);
    }
    return demand_deg - REAL(0.5) * missing_deg * real_fabs(missing_deg) / change_deg;
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

/* The command that follows `command_deg` on the way to a demand, where it may change by `change_deg`. */
static inline real slewed_command(real command_deg, real demand_deg, real change_deg) {
    const real missing_deg = demand_deg - command_deg;
    return real_fabs(missing_deg) <= change_deg ? demand_deg : command_deg + clip(missing_deg, change_deg);
}

/* The delay of a small change of bank from `beyond_deg` beyond the target, in degrees of bank, not in turn rates.
 *
 * With a = tau lag/K and b = (tau + rate gain)/K the missing bank m obeys a m'' + b m' + m = 0, so that its
 * integral over time is b m + a m', and that of m t is b times this less a m. A demand at the bank limit has the
 * gain 1.
 */
static inline TurnDelay linear_delay(RollValues roll, real beyond_deg, real rate_deg_s, bool is_limited) {
    const real gain = is_limited ? REAL(1.0) : command_gain(roll);
    const real a = roll.time_s * roll.lag_s / gain, b = (roll.time_s + (is_limited ? REAL(0.0) : rate_gain_s(roll)))
            / gain;
    const real missing_s = -b * beyond_deg - a * rate_deg_s;
    return MAKE(TurnDelay){missing_s, b * missing_s + a * beyond_deg};
}

/* `turn_delay` of a bank whose rate has a lag, or whose command a slew rate.
 *
 * It is flown in steps until the change is small; the rest is linear.
 */
static inline TurnDelay stepped_delay(RollValues roll, BankState state, real target_deg, real limit_deg) {
    Bank now = state.now;
    real command_deg = state.command_deg;
    const real gain = command_gain(roll), braking_s = rate_gain_s(roll), tangent = real_tan(target_deg *
            REAL(0.017453292519943295));
    real missing_s = REAL(0.0), moment_s2 = REAL(0.0), time_s = REAL(0.0);
    bool is_limited = true;
    integer left = STEPS;
    const real small_deg = small_change_deg(roll);
    now = MAKE(Bank){now.bank_deg, clip(now.rate_deg_s, roll.rate_deg_s)};
    const real slowest_s = max_real(real_fabs(target_deg - now.bank_deg) / roll.rate_deg_s, real_fabs(target_deg -
            command_deg) / roll.slew_deg_s);
    const real dt = (slowest_s + SETTLING * (roll.time_s + braking_s)) / (real)STEPS;
    const RollStep half_step = roll_step(roll, REAL(0.5) * dt), step = roll_step(roll, dt);
    const real slew_deg = roll.slew_deg_s * dt;
    while (left > 0) {
        real wanted_deg = now.bank_deg + gain * (target_deg - now.bank_deg) - braking_s * now.rate_deg_s;
        is_limited = real_fabs(wanted_deg) > limit_deg || real_fabs(wanted_deg - command_deg) > slew_deg;
        if (!is_limited && real_fabs(target_deg - now.bank_deg) + roll.lag_s * real_fabs(now.rate_deg_s) <
                small_deg) {
            break;
        }
        wanted_deg = clip(wanted_deg, limit_deg);
        const Bank half = bank_after_step(roll, half_step, now, mean_command(command_deg, wanted_deg, REAL(0.5) *
                slew_deg));
        /* The demand at half time counts for the whole step. */
        wanted_deg = half.bank_deg + gain * (target_deg - half.bank_deg) - braking_s * half.rate_deg_s;
        wanted_deg = clip(wanted_deg, limit_deg);
        const Bank after = bank_after_step(roll, step, now, mean_command(command_deg, wanted_deg, slew_deg));
        const real part_s = dt * (tangent - real_tan(REAL(0.5) * (now.bank_deg + after.bank_deg) *
                REAL(0.017453292519943295)));
        missing_s = missing_s + part_s;
        moment_s2 = moment_s2 + part_s * (time_s + REAL(0.5) * dt);
        command_deg = slewed_command(command_deg, wanted_deg, slew_deg);
        now = after;
        time_s = time_s + dt;
        left = left - 1;
    }
    const real slope = (REAL(1.0) + tangent * tangent) * REAL(0.017453292519943295);
    const TurnDelay rest = linear_delay(roll, now.bank_deg - target_deg, now.rate_deg_s, is_limited);
    missing_s += slope * rest.missing_s;
    return MAKE(TurnDelay){missing_s, moment_s2 + slope * (time_s * rest.missing_s + rest.moment_s2)};
}

/* How a change of bank under `demand_deg` delays a turn. The turn rate is proportional to tan(bank). */
static inline TurnDelay turn_delay(RollValues roll, BankState state, real target_deg, real limit_deg) {
    if (roll.lag_s == REAL(0.0) && roll.slew_deg_s == REAL_INFINITY) {
        return first_order_delay(roll, state.now.bank_deg, target_deg, limit_deg);
    }
    return stepped_delay(roll, state, target_deg, limit_deg);
}

/* When a change of bank from rest, under `demand_deg`, changes the turn rate. */
static inline TurnOnset turn_onset(RollValues roll, real bank_deg, real target_deg, real limit_deg) {
    const real change = real_tan(target_deg * REAL(0.017453292519943295)) - real_tan(bank_deg *
            REAL(0.017453292519943295));
    if (change == REAL(0.0)) {
        return small_onset(roll);
    }
    const TurnDelay delay = turn_delay(roll, MAKE(BankState){MAKE(Bank){bank_deg, REAL(0.0)}, bank_deg}, target_deg,
            limit_deg);
    const real lead_s = delay.missing_s / change;
    return MAKE(TurnOnset){lead_s, max_real(REAL(2.0) * delay.moment_s2 / change - lead_s * lead_s, REAL(0.0))};
}

/* `turn_onset` for whole half degrees. */
static inline TurnOnset rounded_onset(RollValues roll, real bank_deg, real target_deg, real limit_deg) {
    return turn_onset(roll, REAL(0.5) * (real)half_degrees(bank_deg), REAL(0.5) * (real)half_degrees(target_deg),
            limit_deg);
}

/* What follows from the estimates of the vehicle, after other estimates. */
static inline Limits limits_of(const Settings *settings, const VehicleModel *vehicle, const Limits *before) {
    const VehicleEstimates known = vehicle->estimates;
    const real V = vehicle->estimates.airspeed_m_s, R = settings->radius_m;
    const bool_real_2 planned_wind_1 = planned_wind(settings, &known, before->wind_differs);
    const bool wind_differs = planned_wind_1.a0;
    const real east = planned_wind_1.a1, north = planned_wind_1.a2;
    const real widest_m = widest_turn_m(V, R, east, north);
    const real limit_deg = present_limit_deg(settings, &known, widest_m);
    RollValues roll = before->roll;
    const bool is_other = is_changed(known.roll, roll) || limit_deg != before->limit_deg;
    if (is_other) {
        roll = known.roll;
    }
    const real tightest_m = radius_at_bank(known.turn_airspeed_m_s, limit_deg) / known.turn_ratio;
    real lead_s = before->lead_s;
    if (is_other) {
        lead_s = rounded_onset(roll, REAL(0.0), limit_deg, limit_deg).lead_s;
    }
    const real turned = lead_s * V / tightest_m;
    const real reserve = settings->reserve * (REAL(1.0) + known.turns_unknown + ROLL_RESERVE * turned);
    const real planned_m = min_real(tightest_m * (REAL(1.0) + reserve), widest_m);
    const real hold_deg = clip(bank_for(&known, V / R), limit_deg);
    const integer planned = half_degrees(clip(bank_for(&known, V / planned_m), limit_deg)), hold =
            half_degrees(hold_deg);
    real reversal_s2 = before->reversal_s2;
    if (is_other || planned != before->planned_half_deg || hold != before->hold_half_deg) {
        reversal_s2 = turn_onset(roll, -REAL(0.5) * (real)planned, REAL(0.5) * (real)hold, limit_deg).variance_s2;
    }
    return MAKE(Limits){vehicle->revision, wind_differs, east, north, roll, limit_deg, MAKE(TurnLimits){V,
            tightest_m, planned_m}, hold_deg, hold, planned, lead_s, reversal_s2, REAL(0.5) * reversal_s2 * V * V *
            (REAL(1.0) / planned_m + REAL(1.0) / R), lead_s + DELAY_SHARE * known.delay_s};
}

/* No path. */
static inline GivenPath no_path(Rings *rings) {
    return MAKE(GivenPath){PathPiece_ring_12_filled(&rings->PathPiece_ring_12, MAKE(PathPiece){ABSENT, REAL(0.0),
            REAL(1.0)}), 0, 0, REAL(1.0), REAL(0.0)};
}

/* The memory before there is a plan. */
static inline Planning first_planning(Rings *rings) {
    return MAKE(Planning){NO_PLAN, no_path(rings), NO_LEADS, NO_RESPONSE, NO_ENTRY_SEARCH, false};
}

/* The memory before the first measurement, with wings level. */
static inline Memory first_memory(Rings *rings, const Settings *settings, const VehicleModel *vehicle) {
    return MAKE(Memory){first_sensing(rings, settings->smoothing_s, vehicle->bank_deg), limits_of(settings,
            vehicle, &NO_LIMITS), first_planning(rings), REAL(0.0), MAKE(LawCommand){REAL(0.0), REAL(0.0), NO_DATA,
            REAL_NAN, settings->side, NO_DATA, REAL_NAN}, REAL(0.0)};
}

/* The route by a clock that has jumped. */
static inline void by_clock(Route *route, real jump_s) {
    route->start_s = route->start_s + jump_s;
    return;
}

/* The plan by a clock that has jumped by `jump_s`. */
static inline void plan_by_clock(Plan *plan, real jump_s) {
    const Route route = plan->route;
    const real left_s = plan->remaining_s, join_s = plan->join_s, planned_join_s = plan->planned_join_s,
            searched_s = plan->searched_s;
    Route changed_1 = route;
    by_clock(&changed_1, jump_s);
    *plan = MAKE(Plan){changed_1, left_s, join_s + jump_s, planned_join_s + jump_s, searched_s + jump_s};
    return;
}

/* The clock `dt` seconds later. */
static inline Clock advance_clock(const Clock *clock, real dt) {
    const real time_s = clock->time_s, since_s = clock->since_s, gap_s = clock->gap_s, jump_s =
            clock->jump_s, first_s = clock->first_s, latest_s = clock->latest_s;
    return MAKE(Clock){time_s, since_s + dt, gap_s, jump_s, first_s, latest_s};
}

/* The history with another step of `dt` seconds and the bank at its end; it covers at least `covered_s`.
 *
 * Once the ring is full, steps that are so short that it would not cover that time are joined: two entries that
 * follow each other then last longer than twice that time divided by their number.
 */
static inline BankHistory record_bank(BankHistory history, real bank_deg, real dt, real covered_s) {
    const BankEntry_ring_128 entries = history.entries;
    dt = min_real(dt, covered_s);
    const BankEntry last = entries->at[127];
    const BankEntry entry = MAKE(BankEntry){last.end_s + dt, bank_deg, last.integral + dt * REAL(0.5) *
            (last.bank_deg + bank_deg)};
    if (entry.end_s - entries->at[126].end_s > REAL(2.0) * covered_s / (real)ENTRIES || entries->at[0].end_s ==
            -REAL_INFINITY) {
        return MAKE(BankHistory){BankEntry_ring_128_appended(entries, entry)};
    }
    return MAKE(BankHistory){BankEntry_ring_128_with_last(entries, entry)};
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

/* The bank at the end of the last step. */
static inline real present_deg(BankHistory history) {
    return history.entries->at[127].bank_deg;
}

/* Turn rate of a coordinated turn, radians per second, with the sign of the bank: g tan(bank)/V. */
static inline real rate_at_bank(real bank_deg, real airspeed_m_s) {
    return STANDARD_GRAVITY_M_S2 * real_tan(bank_deg * REAL(0.017453292519943295)) / airspeed_m_s;
}

/* The turn rate at a bank, radians per second, positive to the left. */
static inline real turn_rate_at(Turning turning, real bank_deg, real airspeed_m_s) {
    return -turning.ratio * rate_at_bank(bank_deg, airspeed_m_s);
}

/* A pose turned to the left by an angle, radians. */
static inline PlanarPose _rotated(PlanarPose pose, real angle) {
    if (angle == REAL(0.0)) {
        return pose;
    }
    const real x = pose.x, y = pose.y, c = pose.c, s = pose.s;
    const real cosine = real_cos(angle), sine = real_sin(angle);
    return MAKE(PlanarPose){x, y, c * cosine - s * sine, s * cosine + c * sine};
}

/* The estimate with another bank, which also changes the direction of flight if the vehicle slips. */
static inline Estimate estimate_with_bank(const Estimate *estimate, real bank_deg) {
    const real time_s = estimate->time_s;
    PlanarPose pose = estimate->pose;
    const real V = estimate->airspeed_m_s, last_rate = estimate->turn_rate, east = estimate->air_east_m_s,
            north = estimate->air_north_m_s;
    const Turning turning = estimate->turning;
    const real turn_rate = turn_rate_at(turning, bank_deg, V);
    pose = _rotated(pose, turning.lead_s * (turn_rate - last_rate));
    return MAKE(Estimate){time_s, pose, V, turn_rate, bank_deg, east, north, turning};
}

/* The exact pose after `time` at constant speed and turn rate (radians per second, positive to the left).
 *
 * The air moves with the velocity `air`, east and north. The displacement through it is the chord of the arc, along
 * the velocity at half time: `kernel.motion.fly`, but the heading turns twice by half the angle, which needs one
 * sine and one cosine, since a law turns poses several times a step.
 */
static inline PlanarPose constant_turn(PlanarPose pose, real speed, real rate, real time, real_2 air) {
    real x = pose.x, y = pose.y, c = pose.c, s = pose.s;
    const real east = air.a0, north = air.a1;
    x = x + east * time;
    y = y + north * time;
    const real half = REAL(0.5) * rate * time;
    if (real_fabs(half) < SMALLEST_TURN) {
        return MAKE(PlanarPose){x + speed * time * c, y + speed * time * s, c, s};
    }
    const real ch = real_cos(half), sh = real_sin(half);
    const real new_c = c * ch - s * sh;
    const real new_s = s * ch + c * sh;
    c = new_c;
    s = new_s;
    const real chord = REAL(2.0) * speed / rate * sh;
    return MAKE(PlanarPose){x + chord * c, y + chord * s, c * ch - s * sh, s * ch + c * sh};
}

/* The estimate `time_s` seconds later, with constant bank in a constant wind. */
static inline Estimate estimate_after(const Estimate *estimate, real time_s) {
    const real then_s = estimate->time_s;
    PlanarPose pose = estimate->pose;
    const real V = estimate->airspeed_m_s, turn_rate = estimate->turn_rate, bank_deg = estimate->bank_deg,
            east = estimate->air_east_m_s, north = estimate->air_north_m_s;
    const Turning turning = estimate->turning;
    pose = constant_turn(pose, V, turn_rate, time_s, MAKE(real_2){east, north});
    return MAKE(Estimate){then_s + time_s, pose, V, turn_rate, bank_deg, east, north, turning};
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

/* The observer that starts again from the next measurement. */
static inline Observer restart(const Observer *observer) {
    return MAKE(Observer){observer->smoothing_s, observer->interval_s, observer->air, NO_ESTIMATE};
}

/* The index of the first entry that ends at a time or later. */
static inline integer index_at(BankHistory history, real time_s) {
    const BankEntry_ring_128 entries = history.entries;
    integer low = 0, high = ENTRIES - 1;
    while (low < high) {
        const integer middle = ((low + high) >> 1);
        if (entries->at[middle].end_s < time_s) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* The bank at a time within an entry, between those at its ends; before the first entry it was constant. */
static inline real bank_within(BankHistory history, integer index, real time_s) {
    const BankEntry entry = history.entries->at[index];
    if (index == 0) {
        return entry.bank_deg;
    }
    const BankEntry before = history.entries->at[index - 1];
    if (before.end_s == -REAL_INFINITY || entry.end_s <= before.end_s) {
        return entry.bank_deg;
    }
    return entry.bank_deg - (entry.end_s - time_s) / (entry.end_s - before.end_s) * (entry.bank_deg -
            before.bank_deg);
}

/* The bank `delay_s` seconds ago. */
static inline real delayed_deg(BankHistory history, real delay_s) {
    if (delay_s <= REAL(0.0)) {
        return present_deg(history);
    }
    const real then_s = history.entries->at[127].end_s - delay_s;
    return bank_within(history, index_at(history, then_s), then_s);
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

/* The measured position, with the direction of flight through the air. */
static inline PlanarPose _flight_pose(const State *state, Turning turning) {
    const real ahead_deg = turning.lead_s * turn_rate_at(turning, state->bank_deg, state->airspeed_m_s) *
            REAL(57.29577951308232);
    const real_2 heading_vector_1 = heading_vector(state->heading_deg - ahead_deg);
    return MAKE(PlanarPose){state->east_m, state->north_m, heading_vector_1.a0, heading_vector_1.a1};
}

/* The estimate from a single measurement. */
static inline Estimate _estimate_from(const State *state, Turning turning) {
    const real V = state->airspeed_m_s;
    const PlanarPose pose = _flight_pose(state, turning);
    const real turn_rate = turn_rate_at(turning, state->bank_deg, V);
    const real east = state->velocity_east_m_s - V * pose.c, north = state->velocity_north_m_s - V * pose.s;
    return MAKE(Estimate){state->time_s, pose, V, turn_rate, state->bank_deg, east, north, turning};
}

/* The average restarted from a velocity; what is known of gusts and noise stays. */
static inline AirAverage restart_air(Rings *rings, const AirAverage *air, real east_m_s, real north_m_s) {
    const AirSample sample = MAKE(AirSample){air->recent->at[63].time_s, east_m_s, north_m_s, REAL(0.0)};
    const AirSample_ring_64 recent = AirSample_ring_64_filled(&rings->AirSample_ring_64, sample);
    return MAKE(AirAverage){east_m_s, north_m_s, air->known_s, air->near, air->far, air->along, recent,
            SAMPLES - 2};
}

/* The mean square change of each component of the air's velocity in a second, (m/s)^2. */
static inline real gust(Difference near, Difference far) {
    return max_real(far.square - near.square, REAL(0.0)) / max_real(far.time_s - near.time_s, REAL(0.1));
}

/* The root mean square change of course in a second, radians, by gusts that show in these differences. */
static inline real course_change(const Observer *observer, Difference near, Difference far) {
    const real V = observer->estimate.airspeed_m_s;
    return V > REAL(0.0) ? real_sqrt(gust(near, far)) / V : REAL(0.0);
}

/* The root mean square change of course that gusts cause in a second, radians. */
static inline real roughness(const Observer *observer) {
    return course_change(observer, observer->air.near, observer->air.far);
}

/* The smoothing time for the present air and the interval of the measurements. */
static inline real _smoothing_s(real rough, real interval_s, real shortest_s) {
    const real calm = REAL(1.0) - min_real(rough / CALM_COURSE, REAL(1.0));
    const real multiple = REAL(1.0) + (CALM_MULTIPLE - REAL(1.0)) * calm;
    return multiple * max_real(shortest_s, LEAST_COUNT * interval_s);
}

/* A pose corrected by a share of its difference from the measured one. */
static inline PlanarPose _blended(PlanarPose pose, PlanarPose measured, real share) {
    const real x = pose.x, y = pose.y;
    real c = pose.c, s = pose.s;
    c = c + share * (measured.c - c);
    s = s + share * (measured.s - s);
    const real size = length(c, s);
    return MAKE(PlanarPose){x + share * (measured.x - x), y + share * (measured.y - y), c / size, s / size};
}

/* The means along the flight with a measurement, the last one, and the one `GUST_LAG_S` before. */
static inline AlongFlight _along(AlongFlight along, AirSample last, AirSample before, AirSample now, AirMotion
        motion, real dt) {
    const real near_square = along.near_square, far_square = along.far_square;
    real known_s = along.known_s;
    const real change = (now.turn_rate - before.turn_rate) / TURN_CHANGE;
    const real counted_s = dt / (REAL(1.0) + change * change);
    known_s = min_real(known_s + counted_s, GUST_AVERAGE_S);
    const real weight = counted_s / known_s;
    const real near = motion.c * (now.east_m_s - last.east_m_s) + motion.s * (now.north_m_s - last.north_m_s);
    const real far = motion.c * (now.east_m_s - before.east_m_s) + motion.s * (now.north_m_s - before.north_m_s);
    return MAKE(AlongFlight){near_square + weight * (near * near - near_square), far_square + weight * (far * far -
            far_square), known_s};
}

/* A mean with the difference of two measurements. */
static inline Difference _mean(Difference mean, AirSample before, AirSample now, real weight) {
    const real time_s = mean.time_s, square = mean.square;
    const real east = now.east_m_s - before.east_m_s, north = now.north_m_s - before.north_m_s;
    return MAKE(Difference){time_s + weight * (now.time_s - before.time_s - time_s), square + weight * (REAL(0.5) *
            (east * east + north * north) - square)};
}

/* The averaging time that suits gusts and noise, `longest_s` at most. */
static inline real _averaging_s(Difference near, Difference far, real longest_s) {
    const real change = gust(near, far);
    const real noise = max_real(near.square - change * near.time_s, REAL(0.0)) / REAL(2.0);
    if (noise * near.time_s >= change * longest_s * longest_s) {
        return longest_s;
    }
    return real_sqrt(noise * near.time_s / change);
}

/* The average, over `longest_s` at most, including a velocity measured `dt` seconds after the last. */
static inline AirAverage average_air(const AirAverage *air, real east_m_s, real north_m_s, real dt, real longest_s,
        AirMotion motion) {
    real east = air->east_m_s, north = air->north_m_s, known_s = air->known_s;
    Difference near = air->near, far = air->far;
    AlongFlight along = air->along;
    AirSample_ring_64 recent = air->recent;
    integer lag_index = air->lag_index;
    const real now_s = recent->at[63].time_s + dt;
    known_s = min_real(known_s + dt, GUST_AVERAGE_S);
    while (lag_index < SAMPLES - 1 && now_s - recent->at[lag_index + 1].time_s >= GUST_LAG_S) {
        lag_index += 1;
    }
    const AirSample sample = MAKE(AirSample){now_s, east_m_s, north_m_s, motion.turn_rate};
    const real weight = REAL(1.0) - real_exp(-dt / known_s);
    along = _along(along, recent->at[63], recent->at[lag_index], sample, motion, dt);
    near = _mean(near, recent->at[63], sample, weight);
    far = _mean(far, recent->at[lag_index], sample, weight);
    if (lag_index == 0 && recent->at[63].time_s - recent->at[62].time_s < SAMPLE_GAP_S) {
        recent = AirSample_ring_64_with_last(recent, sample);
    } else {
        recent = AirSample_ring_64_appended(recent, sample);
        lag_index = max_integer(lag_index - 1, 0);
    }
    const real averaging_s = _averaging_s(near, far, longest_s);
    const real share = averaging_s > REAL(0.0) ? REAL(1.0) - real_exp(-dt / averaging_s) : REAL(1.0);
    east = east + share * (east_m_s - east);
    north = north + share * (north_m_s - north);
    return MAKE(AirAverage){east, north, known_s, near, far, along, recent, lag_index};
}

/* The observer after a usable measurement that is later than the last one.
 *
 * `bank_deg` is the bank that the roll model predicts for that time, `shortest_s` the shortest smoothing time.
 */
static inline Observer observe(Rings *rings, const Observer *observer, const State *state, real bank_deg, real
        shortest_s, Turning turning) {
    real smoothing_s = observer->smoothing_s, interval_s = observer->interval_s;
    AirAverage air = observer->air;
    const Estimate last = observer->estimate;
    if (last.airspeed_m_s == REAL(0.0) || shortest_s == REAL(0.0)) {
        const Estimate measured = _estimate_from(state, turning);
        air = restart_air(rings, &air, measured.air_east_m_s, measured.air_north_m_s);
        return MAKE(Observer){smoothing_s, interval_s, air, measured};
    }
    const real last_s = last.time_s;
    PlanarPose pose = last.pose;
    real V = last.airspeed_m_s;
    const real last_rate = last.turn_rate, air_east = last.air_east_m_s, air_north = last.air_north_m_s;
    const real dt = state->time_s - last_s;
    interval_s += (interval_s > REAL(0.0) ? INTERVAL_SHARE : REAL(1.0)) * (min_real(dt, LONGEST_INTERVAL_S) -
            interval_s);
    smoothing_s = _smoothing_s(roughness(observer), interval_s, shortest_s);
    const real share = REAL(1.0) - real_exp(-dt / smoothing_s);
    V += share * (state->airspeed_m_s - V);
    bank_deg += share * (state->bank_deg - bank_deg);
    const real turn_rate = turn_rate_at(turning, bank_deg, V);
    pose = _rotated(pose, turning.lead_s * (turn_rate - last_rate));
    const PlanarPose predicted = constant_turn(pose, V, turn_rate, dt, MAKE(real_2){air_east, air_north});
    pose = _blended(predicted, _flight_pose(state, turning), share);
    const real east = state->velocity_east_m_s - V * pose.c, north = state->velocity_north_m_s - V * pose.s;
    air = average_air(&air, east, north, dt, shortest_s, MAKE(AirMotion){pose.c, pose.s, turn_rate});
    const Estimate estimate = MAKE(Estimate){state->time_s, pose, V, turn_rate, bank_deg, air.east_m_s,
            air.north_m_s, turning};
    return MAKE(Observer){smoothing_s, interval_s, air, estimate};
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

/* The mean bank over the last `delay_s` seconds. */
static inline real mean_deg(BankHistory history, real delay_s) {
    if (delay_s <= REAL(0.0)) {
        return present_deg(history);
    }
    const BankEntry last = history.entries->at[127];
    const real then_s = last.end_s - delay_s;
    const integer index = index_at(history, then_s);
    const BankEntry first = history.entries->at[index];
    const real bank_deg = bank_within(history, index, then_s);
    return (last.integral - first.integral + (first.end_s - then_s) * REAL(0.5) * (bank_deg + first.bank_deg)) /
            delay_s;
}

/* The estimate extrapolated over the measurement delay, with the banks modelled since then. */
static inline Estimate estimate_at_present(const Estimate *estimate, BankHistory history, real delay_s) {
    const real time_s = estimate->time_s;
    PlanarPose pose = estimate->pose;
    const real V = estimate->airspeed_m_s, last_rate = estimate->turn_rate, bank_deg = estimate->bank_deg,
            east = estimate->air_east_m_s, north = estimate->air_north_m_s;
    const Turning turning = estimate->turning;
    const real error_deg = bank_deg - delayed_deg(history, delay_s);
    const real mean_rate = turn_rate_at(turning, mean_deg(history, delay_s) + error_deg, V);
    const real now_deg = present_deg(history) + error_deg;
    const real present_rate = turn_rate_at(turning, now_deg, V);
    /* The slip changes with the turn rate, and with it the direction of flight. */
    pose = _rotated(pose, turning.lead_s * (mean_rate - last_rate));
    pose = constant_turn(pose, V, mean_rate, delay_s, MAKE(real_2){east, north});
    pose = _rotated(pose, turning.lead_s * (present_rate - mean_rate));
    return MAKE(Estimate){time_s + delay_s, pose, V, present_rate, now_deg, east, north, turning};
}

/* What is known at a measurement, `step_s` seconds after the last.
 *
 * `smoothing_s` is the shortest smoothing time, `covered_s` what the history of banks has to cover. Telemetry may
 * be slower than the steps: until the next measurement, but no longer than `EXTRAPOLATED_S`, the last estimate is
 * extrapolated with the modelled bank.
 */
static inline void sense(Rings *rings, Sensing *sensing, const VehicleModel *vehicle, const State *measurement, real
        step_s, real smoothing_s, real covered_s) {
    Clock clock = sensing->clock;
    Observer observer = sensing->observer;
    BankHistory history = sensing->history;
    const real command_deg = sensing->command_deg;
    Estimate present = sensing->present;
    real elapsed_s = sensing->elapsed_s;
    const real error_deg = sensing->model_error_deg;
    const real rate_deg_s = vehicle->bank_rate_deg_s;
    if (step_s > REAL(0.0)) {
        clock = advance_clock(&clock, step_s);
        elapsed_s = elapsed_s + step_s;
        history = record_bank(history, vehicle->bank_deg, step_s, covered_s);
    }
    if (!is_usable(measurement)) {
        *sensing = MAKE(Sensing){clock, observer, history, command_deg, present, rate_deg_s, elapsed_s, error_deg,
                false};
        return;
    }
    if (measurement->time_s == clock.time_s) {
        if (present.airspeed_m_s == REAL(0.0) || clock.since_s > EXTRAPOLATED_S) {
            *sensing = MAKE(Sensing){clock, observer, history, command_deg, present, rate_deg_s, elapsed_s,
                    error_deg, false};
            return;
        }
        const Estimate stored_1 = estimate_with_bank(&present, present_deg(history) + error_deg);
        present = estimate_after(&stored_1, elapsed_s);
        *sensing = MAKE(Sensing){clock, observer, history, command_deg, present, rate_deg_s, REAL(0.0), error_deg,
                true};
        return;
    }
    const bool is_first = clock.time_s == -REAL_INFINITY;
    const Clock_bool check_stamp_2 = check_stamp(&clock, measurement->time_s);
    clock = check_stamp_2.a0;
    const bool is_new = check_stamp_2.a1;
    if (!is_new) {
        *sensing = MAKE(Sensing){clock, observer, history, command_deg, present, rate_deg_s, elapsed_s, error_deg,
                false};
        return;
    }
    if (is_first) {
        history = constant_history(rings, vehicle->bank_deg);
    }
    if (clock.jump_s != REAL(0.0) || clock.gap_s > EXTRAPOLATED_S) {
        observer = restart(&observer);
    }
    const VehicleEstimates known = vehicle->estimates;
    const Turning turning = MAKE(Turning){known.turn_ratio, known.course_lead_s};
    const real bank_deg = delayed_deg(history, known.delay_s);
    const State stored_3 = remove_bias(&known, measurement);
    observer = observe(rings, &observer, &stored_3, bank_deg, smoothing_s, turning);
    present = estimate_at_present(&observer.estimate, history, known.delay_s);
    *sensing = MAKE(Sensing){clock, observer, history, command_deg, present, rate_deg_s, REAL(0.0), present.bank_deg
            - present_deg(history), true};
    return;
}

/* What is known, with the command that the vehicle follows at present. */
static inline void with_command(Sensing *sensing, real command_deg) {
    sensing->command_deg = command_deg;
    return;
}

/* The search without an aim. */
static inline void end_entry_search(EntrySearch *search) {
    search->aim = NOTHING;
    return;
}

/* The memory without a search. */
static inline void drop_search(Planning *planning) {
    end_entry_search(&planning->search);
    return;
}

/* Whether delays of changes of bank are others than before. */
static inline bool is_other_roll(const Limits *limits, const Limits *before) {
    const RollValues a = limits->roll, b = before->roll;
    const bool same = a.time_s == b.time_s && a.rate_deg_s == b.rate_deg_s && a.lag_s == b.lag_s;
    return !(same && limits->limit_deg == before->limit_deg);
}

/* The memory without delays of changes of bank, which are then computed anew. */
static inline void forget_leads(Planning *planning) {
    planning->leads = NO_LEADS;
    return;
}

/* The aircraft relative to the circle. */
static inline RelativeState relative_state(const Settings *settings, const Estimate *estimate) {
    const real time_s = estimate->time_s, x = estimate->pose.x, y = estimate->pose.y, c = estimate->pose.c,
            s = estimate->pose.s, V = estimate->airspeed_m_s, air_east = estimate->air_east_m_s, air_north =
            estimate->air_north_m_s;
    const real east = settings->velocity_east_m_s, north = settings->velocity_north_m_s, hx = V * c, hy = V * s;
    return MAKE(RelativeState){time_s, x - (settings->east_m + east * time_s), y - (settings->north_m + north *
            time_s), hx + air_east - east, hy + air_north - north, hx, hy};
}

/* The velocity (vx, vy) of a vehicle that flies along (hx, hy); (hx, hy) where that velocity is not plausible. */
static inline real_2 flight_velocity(real vx, real vy, real hx, real hy) {
    const bool chosen_1 = vx * hx + vy * hy > LEAST_SPEED * (hx * hx + hy * hy);
    return MAKE(real_2){chosen_1 ? vx : hx, chosen_1 ? vy : hy};
}

/* A piece of the control `u` that begins at (x, y) along (c, s), and the direction (c, s) at its end. */
static inline RoutePiece_real_2 _piece(integer u, real x, real y, real c, real s, real time_s, real r, real speed) {
    if (u == ABSENT) {
        return MAKE(RoutePiece_real_2){NO_PIECE, c, s};
    }
    const real_4 fly_1 = fly(REAL(0.0), REAL(0.0), c, s, u, time_s * speed / r);
    const real dx = fly_1.a0, dy = fly_1.a1, end_c = fly_1.a2, end_s = fly_1.a3;
    const real centre_x = x - (real)u * r * s, centre_y = y + (real)u * r * c;
    return MAKE(RoutePiece_real_2){MAKE(RoutePiece){u, centre_x, centre_y, c, s, x + r * dx, y + r * dy, time_s, r},
            end_c, end_s};
}

/* The control of the last piece of a word. */
static inline integer end_control(integer word) {
    const integer_3 controls_1 = controls(word);
    const integer u1 = controls_1.a0, u2 = controls_1.a1, u3 = controls_1.a2;
    return u3 != ABSENT ? u3 : u2 != ABSENT ? u2 : u1;
}

/* The route of an entry that begins at a state. */
static inline Route route_of(const RelativeState *state, const PlannedEntry *entry) {
    const integer side = entry->side, word = entry->word;
    const real t1_s = entry->t1_s, t2_s = entry->t2_s, t3_s = entry->t3_s, r = entry->turn_radius_m, speed =
            entry->speed_m_s, east = entry->wind_east_m_s, north = entry->wind_north_m_s;
    const real_2 flight_velocity_1 = flight_velocity(state->vx - east, state->vy - north, state->hx,
            state->hy);
    const real vx = flight_velocity_1.a0, vy = flight_velocity_1.a1;
    const real size = length(vx, vy);
    const integer_3 controls_2 = controls(word);
    const integer u1 = controls_2.a0, u2 = controls_2.a1, u3 = controls_2.a2;
    const RoutePiece_real_2 _piece_3 = _piece(u1, state->x, state->y, vx / size, vy / size, t1_s, r, speed);
    const RoutePiece first = _piece_3.a0;
    real c = _piece_3.a1, s = _piece_3.a2;
    const RoutePiece_real_2 _piece_4 = _piece(u2, first.end_x, first.end_y, c, s, t2_s, r, speed);
    const RoutePiece second = _piece_4.a0;
    c = _piece_4.a1;
    s = _piece_4.a2;
    const RoutePiece_real_2 _piece_5 = _piece(u3, second.end_x, second.end_y, c, s, t3_s, r, speed);
    const RoutePiece third = _piece_5.a0;
    return MAKE(Route){side, first, second, third, REAL(0.0), end_control(word), state->time_s, r, speed, east,
            north};
}

/* Whether only the circle is left. */
static inline bool is_holding(const Route *route) {
    return route->current.u == ABSENT;
}

/* The offset from a circle, flown to the left (u = +1) or right (-1), of a vehicle with the velocity (vx, vy).
 *
 * The vehicle is at (x, y) relative to the centre. A holding circle of side +1, clockwise, is flown to the right.
 */
static inline PathOffset arc_offset(integer u, real radius, real x, real y, real vx, real vy) {
    const real d = length(x, y);
    /* At the centre the direction along the circle is undefined: half a radius is the least distance used. */
    const real reach = max_real(d, REAL(0.5) * radius);
    const real along = (real)u * (x * vy - y * vx) / reach, inward = -(x * vx + y * vy) / reach;
    /* The left side of a left turn is the inside. */
    return MAKE(PathOffset){(real)u * (radius - d), real_atan2((real)u * inward, along), (real)u * along / reach};
}

/* The motion of a vehicle relative to the steady wind of the plan. */
static inline Motion in_air(const Route *route, const RelativeState *state) {
    const real time_s = state->time_s, x = state->x, y = state->y;
    real vx = state->vx, vy = state->vy;
    const real hx = state->hx, hy = state->hy;
    const real east = route->wind_east_m_s, north = route->wind_north_m_s, elapsed_s = time_s -
            route->start_s;
    const real_2 flight_velocity_1 = flight_velocity(vx - east, vy - north, hx, hy);
    vx = flight_velocity_1.a0;
    vy = flight_velocity_1.a1;
    return MAKE(Motion){x - east * elapsed_s, y - north * elapsed_s, vx, vy};
}

/* The offset from a line along the unit vector (c, s) of a vehicle with the velocity (vx, vy).
 *
 * The vehicle is at (x, y) relative to a point of the line.
 */
static inline PathOffset line_offset(real x, real y, real c, real s, real vx, real vy) {
    return MAKE(PathOffset){c * y - s * x, real_atan2(c * vy - s * vx, c * vx + s * vy), REAL(0.0)};
}

/* The offset of a state from the current piece, or from the circle of `radius_m`. */
static inline PathOffset offset_of(const Route *route, const RelativeState *state, real radius_m) {
    real vx, vy;
    if (is_holding(route)) {
        const real_2 flight_velocity_1 = flight_velocity(state->vx, state->vy, state->hx, state->hy);
        vx = flight_velocity_1.a0;
        vy = flight_velocity_1.a1;
        return arc_offset(-route->side, radius_m, state->x, state->y, vx, vy);
    }
    const RoutePiece piece = route->current;
    const Motion in_air_2 = in_air(route, state);
    const real x = in_air_2.x, y = in_air_2.y;
    vx = in_air_2.vx;
    vy = in_air_2.vy;
    if (piece.u == 0) {
        return line_offset(x - piece.x, y - piece.y, piece.c, piece.s, vx, vy);
    }
    return arc_offset(piece.u, piece.radius_m, x - piece.x, y - piece.y, vx, vy);
}

/* The plan that holds the circle at once, if the flight begins on it; otherwise the plan as it is. */
static inline Plan plan_on_circle(const Settings *settings, const Limits *limits, const Plan *plan, const
        RelativeState *state) {
    const real r = limits->turns.planned_m, V = limits->turns.airspeed_m_s, R = settings->radius_m;
    const integer each_side_1[2] = {code(SIDE_CW), code(SIDE_CCW)};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const integer side = each_side_1[i_1];
        if (settings->side == side || settings->side == SIDE_EITHER) {
            const PlannedEntry entry = MAKE(PlannedEntry){side, code(WORD_EMPTY), REAL(0.0), REAL(0.0), REAL(0.0),
                    r, V, limits->wind_east_m_s, limits->wind_north_m_s};
            const Route route = route_of(state, &entry);
            const PathOffset offset = offset_of(&route, state, R);
            if (real_fabs(offset.crosstrack) < REAL(0.5) * settings->reserve * R && real_fabs(offset.course_error)
                    < ON_COURSE) {
                return MAKE(Plan){route, REAL(0.0), state->time_s, state->time_s, plan->searched_s};
            }
        }
    }
    return (*plan);
}

/* Whether the last search is long enough ago. */
static inline bool is_search_due(const Clock *clock, const Plan *plan) {
    return clock->time_s - plan->searched_s >= SEARCH_INTERVAL_S - ROUNDING_S;
}

/* The delay of a change of bank. */
static inline real lead_s(const Limits *limits, real bank_deg, real target_deg) {
    return rounded_onset(limits->roll, bank_deg, target_deg, limits->limit_deg).lead_s;
}

/* The search for the fastest entry from a state, before its first step. */
static inline EntrySearch search_from(const Settings *settings, const Limits *limits, integer aim, const
        RelativeState *state, bool reversing) {
    EntrySearch changed_1 = NO_ENTRY_SEARCH;
    changed_1.aim = aim;
    changed_1.state = (*state);
    changed_1.turns = limits->turns;
    changed_1.wind_east_m_s = limits->wind_east_m_s;
    changed_1.wind_north_m_s = limits->wind_north_m_s;
    changed_1.radius_m = settings->radius_m;
    changed_1.wide_m = settings->radius_m + limits->reversal_m;
    changed_1.side = settings->side;
    changed_1.reversing = reversing;
    return changed_1;
}

/* The plan to hold the circle where the flight begins on it, otherwise a search if it is due.
 *
 * The fastest entry begins where a command takes effect, which depends on the bank and the first turn. So that is
 * found first, as it would be with wings level.
 */
static inline void begin_first_plan(Planning *planning, const Settings *settings, const Limits *limits, const
        Sensing *sensing) {
    const Estimate present = sensing->present;
    const RelativeState stored_1 = relative_state(settings, &present);
    planning->plan = plan_on_circle(settings, limits, &planning->plan, &stored_1);
    if (planning->plan.route.side != 0) {
        drop_search(planning);
        return;
    }
    if (planning->search.aim != NOTHING || !is_search_due(&sensing->clock, &planning->plan)) {
        return;
    }
    const Estimate later = estimate_after(&present, lead_s(limits, present.bank_deg, REAL(0.0)));
    const RelativeState stored_2 = relative_state(settings, &later);
    planning->search = search_from(settings, limits, FIRST_TURN, &stored_2, true);
    return;
}

/* The control of the last piece before the circle; `ABSENT` on the circle. */
static inline integer last_control(const Route *route) {
    return route->second.u == ABSENT ? route->current.u : route->last_u;
}

/* The bank of a piece in half degrees, of the circle where it is absent; wide arcs need less than planned turns. */
static inline integer half_deg_on(const Limits *limits, const Route *route, const RoutePiece *piece) {
    if (piece->u == ABSENT) {
        return route->side * limits->hold_half_deg;
    }
    if (piece->radius_m == route->turn_radius_m) {
        return -piece->u * limits->planned_half_deg;
    }
    const real V = limits->turns.airspeed_m_s, planned_deg = REAL(0.5) * (real)limits->planned_half_deg;
    const real rate = rate_at_bank(planned_deg, V) * route->turn_radius_m / piece->radius_m;
    return -piece->u * half_degrees(bank_at_rate(rate, V));
}

/* The bank to which it goes on where it is at present while no change is wanted, degrees.
 *
 * A lag of the bank rate keeps it for a time in effect. A command that lies q ahead of the bank returns to it at
 * the slew rate S: with q' = -S - q/tau, the bank meanwhile changes by q - S tau ln(1 + q/(S tau)).
 */
static inline real coasted_deg(RollValues roll, BankState state) {
    const Bank now = state.now;
    const real command_deg = state.command_deg;
    real bank_deg = now.bank_deg;
    if (roll.lag_s > REAL(0.0)) {
        bank_deg += roll.time_s * roll.lag_s / (roll.time_s + rate_gain_s(roll)) * now.rate_deg_s;
    }
    if (roll.slew_deg_s < REAL_INFINITY && roll.time_s > REAL(0.0)) {
        const real ahead_deg = clip(command_deg - now.bank_deg, roll.rate_deg_s * roll.time_s), slew_deg =
                roll.slew_deg_s * roll.time_s;
        const real change_deg = real_fabs(ahead_deg) - slew_deg * real_log(REAL(1.0) + real_fabs(ahead_deg) /
                slew_deg);
        bank_deg += ahead_deg > REAL(0.0) ? change_deg : -change_deg;
    }
    return bank_deg;
}

/* After how long a change from the bank of one piece to that of another takes effect, seconds.
 *
 * Banks are in half degrees; `first_missing_s` is what the turn to the first one misses (`TurnDelay`).
 */
static inline real change_delay_s(RollValues roll, BankState state, real limit_deg, integer first, real
        first_missing_s, integer second) {
    if (first == second) {
        return REAL(0.0);
    }
    const real missing_s = turn_delay(roll, state, REAL(0.5) * (real)second, limit_deg).missing_s;
    return (first_missing_s - missing_s) / (real_tan(REAL(0.5) * (real)first * REAL(0.017453292519943295)) -
            real_tan(REAL(0.5) * (real)second * REAL(0.017453292519943295)));
}

/* How changes from a bank to those of the pieces of a route are delayed; what is known is not computed again. */
static inline Leads leads_to(const Limits *limits, const Leads *leads, BankState state, const Route *route) {
    Bank now = state.now;
    const integer u3 = last_control(route);
    const integer bank = half_degrees(now.bank_deg), rate = half_degrees(now.rate_deg_s / RATE_STEPS);
    const integer command = limits->roll.slew_deg_s < REAL_INFINITY ? half_degrees(state.command_deg) : 0;
    const integer first = half_deg_on(limits, route, &route->current), second = half_deg_on(limits, route,
            &route->second);
    const integer last = u3 == ABSENT ? route->side * limits->hold_half_deg : -u3 * limits->planned_half_deg;
    if (leads->bank == bank && leads->rate == rate && leads->command == command && leads->current == first
            && leads->next == second && leads->last == last) {
        return (*leads);
    }
    const RollValues roll = limits->roll;
    const real limit_deg = limits->limit_deg;
    now = MAKE(Bank){REAL(0.5) * (real)bank, REAL(0.5) * RATE_STEPS * (real)rate};
    state = MAKE(BankState){now, REAL(0.5) * (real)command};
    const real there = real_tan(now.bank_deg * REAL(0.017453292519943295));
    const real first_s = small_onset(roll).lead_s;
    const TurnDelay first_delay = turn_delay(roll, state, REAL(0.5) * (real)first, limit_deg);
    const real first_missing_s = first_delay.missing_s;
    const real tangent = real_tan(REAL(0.5) * (real)first * REAL(0.017453292519943295));
    const real unchanged_deg = clip(coasted_deg(roll, state), limit_deg);
    real current_s = first_s;
    if (real_fabs(REAL(0.5) * (real)first - unchanged_deg) > SMALL_CHANGE_DEG) {
        current_s = max_real(first_missing_s / (tangent - real_tan(unchanged_deg * REAL(0.017453292519943295))),
                REAL(0.5) * first_s);
    } else if (rate == 0 && first != bank && (command == 0 || command == bank)) {
        current_s = first_missing_s / (tangent - there);
    }
    const real more = current_s > REAL(0.0) && first != bank ? tangent - first_missing_s / current_s - there :
            REAL(0.0);
    const real next_s = change_delay_s(roll, state, limit_deg, first, first_missing_s, second) - current_s;
    const real last_s = change_delay_s(roll, state, limit_deg, first, first_missing_s, last) - current_s;
    const real displaced_s2 = first_delay.moment_s2 - REAL(0.5) * first_missing_s * current_s;
    return MAKE(Leads){bank, rate, command, first, second, last, current_s, more, next_s, last_s, displaced_s2};
}

/* The estimate with a turn rate that is larger by `more` g/V, positive to the right. */
static inline Estimate turning_more(const Estimate *estimate, real more) {
    const real V = estimate->airspeed_m_s;
    const real rate = estimate->turn_rate - estimate->turning.ratio * STANDARD_GRAVITY_M_S2 * more / V;
    Estimate changed_1 = (*estimate);
    changed_1.turn_rate = rate;
    return changed_1;
}

/* The state displaced to the right by so many times standard gravity. */
static inline RelativeState displaced(const RelativeState *state, real displaced_s2) {
    const real scale = STANDARD_GRAVITY_M_S2 * displaced_s2 / length(state->hx, state->hy);
    RelativeState changed_1 = (*state);
    changed_1.x = state->x + scale * state->hy;
    changed_1.y = state->y - scale * state->hx;
    return changed_1;
}

/* The time left of the current piece at a state; 0 on the circle.
 *
 * On an arc this is known up to whole turns: the value nearest to `previous_s` is taken.
 */
static inline real remaining_s(const Route *route, const RelativeState *state, real previous_s) {
    if (is_holding(route)) {
        return REAL(0.0);
    }
    const Motion in_air_1 = in_air(route, state);
    const RoutePiece piece = route->current;
    const real x = in_air_1.x, y = in_air_1.y;
    if (piece.u == 0) {
        return ((piece.end_x - x) * piece.c + (piece.end_y - y) * piece.s) / route->speed_m_s;
    }
    const real left = angle(arc_rotation(piece.u, x - piece.x, y - piece.y, piece.end_x - piece.x, piece.end_y -
            piece.y));
    const real rate = route->speed_m_s / piece.radius_m;
    return (left + TWO_PI * (real)integer_of(real_ceil((previous_s * rate - left) / TWO_PI - REAL(0.5)))) / rate;
}

/* How long before its end the current piece must end, since the next bank takes effect with a delay. */
static inline real early_end_s(const Route *route, const Leads *leads) {
    real early_s = leads->next_s;
    if (route->second.u == 0 && route->third.u != ABSENT && route->third.u != route->current.u) {
        /* A straight line between opposite turns may be shorter than the reversal, which then begins before its end. */
        early_s = max_real(early_s, leads->last_s - REAL(0.5) * route->second.time_s);
    }
    return max_real(early_s, REAL(0.0));
}

/* A path without its next piece, that, which begins at the end of the last one, and the time of those after it. */
static inline GivenPath_RoutePiece_real _next_piece(GivenPath path, const RoutePiece *last, real speed, real more_s)
        {
    if (path.taken == path.total) {
        return MAKE(GivenPath_RoutePiece_real){path, NO_PIECE, REAL(0.0)};
    }
    const PathPiece parts_1 = path.pieces->at[path.taken];
    const integer u = parts_1.u;
    const real time_s = parts_1.time_s, radius_m = parts_1.radius_m;
    const RoutePiece_real_2 _piece_2 = _piece(u, last->end_x, last->end_y, path.c, path.s, time_s, radius_m,
            speed);
    const RoutePiece piece = _piece_2.a0;
    const real c = _piece_2.a1, s = _piece_2.a2;
    const integer taken = path.taken + 1;
    GivenPath changed_3 = path;
    changed_3.taken = taken;
    changed_3.c = c;
    changed_3.s = s;
    return MAKE(GivenPath_RoutePiece_real){changed_3, piece, taken == path.total ? REAL(0.0) : more_s - time_s};
}

/* A path and the route along it, without the current piece of that. */
static inline GivenPath_Route next_on(GivenPath path, const Route *route) {
    const GivenPath_RoutePiece_real _next_piece_1 = _next_piece(path, &route->third, route->speed_m_s,
            route->more_s);
    path = _next_piece_1.a0;
    const RoutePiece third = _next_piece_1.a1;
    const real more_s = _next_piece_1.a2;
    Route changed_2 = (*route);
    changed_2.current = route->second;
    changed_2.second = route->third;
    changed_2.third = third;
    changed_2.more_s = more_s;
    return MAKE(GivenPath_Route){path, changed_2};
}

/* The time from the end of the current piece to the circle. */
static inline real later_s(const Route *route) {
    return route->second.time_s + route->third.time_s + route->more_s;
}

/* The plan at the response: without the pieces that are complete when a command takes effect.
 *
 * A change of bank takes effect with a delay; from then on the aircraft turns like one that banks instantly.
 */
static inline void advance_plan(Planning *planning, const Settings *settings, const Limits *limits, const Sensing
        *sensing) {
    const Estimate estimate = sensing->present;
    Leads leads = planning->leads;
    GivenPath path = planning->path;
    Route route = planning->plan.route;
    real left_s = planning->plan.remaining_s, join_s = planning->plan.join_s, planned_join_s =
            planning->plan.planned_join_s;
    const real searched_s = planning->plan.searched_s;
    /* Pieces are dropped that are complete, in a plan of its own at most three. */
    RelativeState state;
    real early_s;
    while (true) {
        const Bank now = MAKE(Bank){estimate.bank_deg, sensing->bank_rate_deg_s};
        leads = leads_to(limits, &leads, MAKE(BankState){now, sensing->command_deg}, &route);
        const Estimate stored_1 = turning_more(&estimate, leads.more);
        const Estimate later = estimate_after(&stored_1, leads.current_s);
        const RelativeState stored_2 = relative_state(settings, &later);
        state = displaced(&stored_2, estimate.turning.ratio * leads.displaced_s2);
        left_s = remaining_s(&route, &state, left_s);
        early_s = early_end_s(&route, &leads);
        if (is_holding(&route) || left_s > early_s + ROUNDING_S) {
            break;
        }
        const GivenPath_Route next_on_3 = next_on(path, &route);
        path = next_on_3.a0;
        route = next_on_3.a1;
        left_s = route.current.time_s;
    }
    bool has_joined = planning->has_joined;
    if (is_holding(&route)) {
        early_s = REAL(0.0);
        has_joined = has_joined || !is_holding(&planning->plan.route);
    } else {
        join_s = state.time_s + left_s + later_s(&route);
        if (path.total > 0) {
            /* A given path stays where it is over the ground: in wind it does not drift on where it is flown late. */
            Route changed_4 = route;
            by_clock(&changed_4, join_s - planned_join_s);
            route = changed_4;
            planned_join_s = join_s;
        }
    }
    planning->path = path;
    planning->plan = MAKE(Plan){route, left_s, join_s, planned_join_s, searched_s};
    planning->leads = leads;
    planning->response = MAKE(ResponsePoint){state, offset_of(&route, &state, settings->radius_m), early_s};
    planning->has_joined = has_joined;
    return;
}

/* The same by gusts along the flight since `restart_gusts`: a slip that changes with the bank does not count. */
static inline real along_roughness(const Observer *observer) {
    const Difference near = observer->air.near, far = observer->air.far;
    const AlongFlight along = observer->air.along;
    return course_change(observer, MAKE(Difference){near.time_s, along.near_square}, MAKE(Difference){far.time_s,
            along.far_square});
}

/* Whether the last turn of the plan is opposite to that of the circle. */
static inline bool reverses(const Route *route) {
    return route->last_u == route->side;
}

/* The turn from (x, y) along (c, s), opposite to the circle, that ends where it is closest to the circle. */
static inline RoutePiece _last_turn(integer u, real x, real y, real c, real s, real r, real speed) {
    const real centre_x = x - (real)u * r * s, centre_y = y + (real)u * r * c;
    const real scale = REAL(1.0) - r / length(centre_x, centre_y);
    const real end_x = scale * centre_x, end_y = scale * centre_y;
    const real turned = angle(arc_rotation(u, x - centre_x, y - centre_y, end_x - centre_x, end_y - centre_y));
    return MAKE(RoutePiece){u, centre_x, centre_y, c, s, end_x, end_y, turned * r / speed, r};
}

/* The route with its line, parallel to the present one, through a state, and another last turn, in still air.
 *
 * The route as it is where that turn, as wide as planned and opposite to the circle, cannot end on the circle.
 */
static inline void with_last_line(Route *route, const RelativeState *state, real circle_m) {
    const real r = route->turn_radius_m, c = route->current.c, s = route->current.s;
    const integer u = route->second.u;
    const real V = route->speed_m_s;
    const real centre_x = state->x - (real)u * r * s, centre_y = state->y + (real)u * r * c, reach_m = circle_m
            + r;
    const real along_m = c * centre_x + s * centre_y, beside_m = c * centre_y - s * centre_x;
    if (real_fabs(beside_m) >= reach_m) {
        return;
    }
    const real left_m = -along_m - real_sqrt(reach_m * reach_m - beside_m * beside_m);
    const real end_x = state->x + left_m * c, end_y = state->y + left_m * s;
    const RoutePiece line = MAKE(RoutePiece){0, state->x, state->y, c, s, end_x, end_y, left_m / V, r};
    route->current = line;
    route->second = _last_turn(u, end_x, end_y, c, s, r, V);
    return;
}

/* The radius of the turn, opposite to the circle, that leads in still air from a state onto the circle; metres.
 *
 * The centre of the turn, p + r n with the unit vector n towards it, is r plus the radius of the circle away from
 * that of the circle. The result is not positive where there is no such turn.
 */
static inline real last_radius_m(const Route *route, const RelativeState *state, real circle_m) {
    const real_2 flight_velocity_1 = flight_velocity(state->vx, state->vy, state->hx, state->hy);
    const real vx = flight_velocity_1.a0, vy = flight_velocity_1.a1;
    const real ahead_m = circle_m - (real)route->current.u * (state->y * vx - state->x * vy) / length(vx, vy);
    return ahead_m > REAL(0.0) ? REAL(0.5) * (state->x * state->x + state->y * state->y - circle_m *
            circle_m) / ahead_m : REAL(0.0);
}

/* The route with another last turn, in still air, that begins at a state. */
static inline void with_last_turn(Route *route, const RelativeState *state, real radius_m) {
    const real_2 flight_velocity_1 = flight_velocity(state->vx, state->vy, state->hx, state->hy);
    const real vx = flight_velocity_1.a0, vy = flight_velocity_1.a1;
    const real speed = length(vx, vy);
    const RoutePiece turn = _last_turn(route->current.u, state->x, state->y, vx / speed, vy / speed, radius_m,
            route->speed_m_s);
    route->current = turn;
    return;
}

/* The plan along a new route, which joins at a time. */
static inline void plan_along(Plan *plan, const Route *route, real join_s) {
    plan->route = (*route);
    plan->remaining_s = route->current.time_s;
    plan->join_s = join_s;
    return;
}

/* The memory with a plan whose last turn, where that is opposite to the circle, is aimed again from the response.
 *
 * Until a plan that is better comes, the aircraft would miss the circle by its distance from the present one. In
 * still air the line before that turn is moved to the aircraft, and the radius of the turn itself follows from the
 * state; it is the tightest one where that is too wide. In heavy gusts the last plan is followed: the aim would
 * move with them.
 */
static inline void aim_again(Planning *planning, const Settings *settings, const Limits *limits, const Sensing
        *sensing) {
    const RelativeState state = planning->response.state;
    const Plan plan = planning->plan;
    Route route = planning->plan.route;
    const bool is_still = route.wind_east_m_s == REAL(0.0) && route.wind_north_m_s == REAL(0.0);
    const bool is_calm = along_roughness(&sensing->observer) <= HEAVY_GUSTS;
    if (is_holding(&route) || route.third.u != ABSENT || !(is_still && is_calm && reverses(&route))) {
        return;
    }
    const real circle_m = settings->radius_m + limits->reversal_m;
    if (route.second.u != ABSENT) {
        if (route.current.u != 0) {
            return;
        }
        with_last_line(&route, &state, circle_m);
    } else {
        const real radius_m = last_radius_m(&route, &state, circle_m);
        if (!(REAL(0.0) < radius_m && radius_m < WIDEST_AIMED * limits->turns.planned_m)) {
            return;
        }
        with_last_turn(&route, &state, max_real(radius_m, limits->turns.tightest_m));
        const real missed_m = length(route.current.end_x, route.current.end_y) - circle_m;
        if (real_fabs(missed_m) > LOST_OFFSET * limits->turns.planned_m) {
            return;
        }
    }
    const real left_s = route.current.time_s, whole_s = route.current.time_s + later_s(&route);
    const real later = whole_s - plan.remaining_s - later_s(&plan.route);
    if (left_s < AIMED_LEFT_S + planning->response.early_s || real_fabs(later) > AIM_CHANGE_S) {
        return;
    }
    Plan changed_1 = plan;
    plan_along(&changed_1, &route, state.time_s + whole_s);
    planning->plan = changed_1;
    advance_plan(planning, settings, limits, sensing);
    return;
}

/* The plan with the time of the last search. */
static inline void searched_at(Plan *plan, real time_s) {
    plan->searched_s = time_s;
    return;
}

/* The memory with a search for a plan from a state, and when it began. */
static inline void begin_plan_search(Planning *planning, const Settings *settings, const Limits *limits, integer
        aim, const RelativeState *state, real now_s) {
    const bool reversing = planning->plan.route.side == 0 || reverses(&planning->plan.route);
    planning->search = search_from(settings, limits, aim, state, reversing);
    searched_at(&planning->plan, now_s);
    return;
}

/* The memory with a search for another plan, if that is due. */
static inline void reconsider(Planning *planning, const Settings *settings, const Limits *limits, const Sensing
        *sensing) {
    const bool is_given = planning->path.total > 0;
    if (is_given || planning->search.aim != NOTHING || !is_search_due(&sensing->clock, &planning->plan)) {
        return;
    }
    aim_again(planning, settings, limits, sensing);
    const PathOffset offset = planning->response.offset;
    const Plan plan = planning->plan;
    const real r = limits->turns.planned_m, V = limits->turns.airspeed_m_s;
    const bool holding = is_holding(&plan.route);
    const bool is_lost = real_fabs(offset.crosstrack) > LOST_OFFSET * r || real_fabs(offset.course_error) >
            LOST_COURSE;
    /* A plan for a wind that differs so much from the present one means nothing. */
    const real east = limits->wind_east_m_s - plan.route.wind_east_m_s, north = limits->wind_north_m_s -
            plan.route.wind_north_m_s;
    if (is_lost || (!holding && length(east, north) > WIND_DIFFERS * V)) {
        begin_plan_search(planning, settings, limits, ANY, &planning->response.state, sensing->clock.time_s);
        return;
    }
    if (holding) {
        return;
    }
    const real later_m = real_fabs(plan.join_s - plan.planned_join_s) * V;
    const bool deviates = max_real(real_fabs(offset.crosstrack), later_m) > DEVIATION * r;
    const bool is_still = limits->wind_east_m_s == REAL(0.0) && limits->wind_north_m_s == REAL(0.0);
    const integer aim = deviates || is_still ? UPDATE : BETTER;
    begin_plan_search(planning, settings, limits, aim, &planning->response.state, sensing->clock.time_s);
    return;
}

/* The plan from the present state on, and a search begun for another if it is due. */
static inline void update_plan(Planning *planning, const Settings *settings, const Limits *limits, const Sensing
        *sensing) {
    const Clock clock = sensing->clock;
    if (clock.since_s == REAL(0.0) && clock.jump_s != REAL(0.0)) {
        plan_by_clock(&planning->plan, clock.jump_s);
        drop_search(planning);
    }
    if (planning->plan.route.side == 0) {
        begin_first_plan(planning, settings, limits, sensing);
    }
    if (planning->plan.route.side == 0) {
        return;
    }
    advance_plan(planning, settings, limits, sensing);
    reconsider(planning, settings, limits, sensing);
    return;
}

/* The memory after a measurement: what is known, the present plan, and a search begun for another if it is due. */
static APART void prepare(Rings *rings, Memory *memory, const Settings *settings, const VehicleModel *vehicle, const
        State *measurement) {
    const real smoothing_s = settings->smoothing_s, covered_s = settings->covered_s;
    Sensing changed_1 = memory->sensing;
    sense(rings, &changed_1, vehicle, measurement, memory->step_s, smoothing_s, covered_s);
    const Sensing sensing = changed_1;
    const real command_deg = memory->step_s > REAL(0.0) ? memory->command.bank_deg : vehicle->bank_deg;
    Sensing changed_2 = sensing;
    with_command(&changed_2, command_deg);
    memory->sensing = changed_2;
    if (!memory->sensing.is_known) {
        drop_search(&memory->planning);
        return;
    }
    if (vehicle->revision != memory->limits.revision) {
        const Limits limits = limits_of(settings, vehicle, &memory->limits);
        if (is_other_roll(&limits, &memory->limits)) {
            forget_leads(&memory->planning);
        }
        memory->limits = limits;
    }
    update_plan(&memory->planning, settings, &memory->limits, &memory->sensing);
    return;
}

/* The radius of the circle that is searched for. */
static inline real circle_m(const EntrySearch *search) {
    return search->reversing ? search->wide_m : search->radius_m;
}

/* The velocity relative to the air with which an entry starts. */
static inline real_2 flight_vector(const EntrySearch *search) {
    const RelativeState state = search->state;
    return flight_velocity(state.vx - search->wind_east_m_s, state.vy - search->wind_north_m_s, state.hx,
            state.hy);
}

/* Whether the air is planned to be at rest. */
static inline bool is_still(const EntrySearch *search) {
    return search->wind_east_m_s == REAL(0.0) && search->wind_north_m_s == REAL(0.0);
}

/* The radius of the turns at a speed, over that of the planned ones.
 *
 * In still air turns are wider in the present gust: at a given turn rate the radius grows with the speed. They are
 * at most as wide as the circle.
 */
static inline real turn_scale(const EntrySearch *search, real speed) {
    if (!is_still(search)) {
        return REAL(1.0);
    }
    return min_real(speed / search->turns.airspeed_m_s, circle_m(search) / search->turns.planned_m);
}

static inline Entry _still_air_entry(const RelativeState *state, real c, real s, real r, real radius_m, integer
        side, real tolerance) {
    const real_2 reduce_1 = reduce(state->x / r, state->y / r, c, s);
    const real x = reduce_1.a0, y = reduce_1.a1;
    return optimum(x, y, radius_m / r, side, tolerance);
}

/* The search whose answer is known. */
static inline WindSearch found_at_once(Entry entry) {
    const WindEntry found = MAKE(WindEntry){code(STATUS_OK), entry.side, entry.word, entry.t1, entry.t2, entry.t3,
            REAL_NAN, REAL_NAN};
    WindSearch changed_1 = NO_SEARCH;
    changed_1.stage = ENDED;
    changed_1.entry = found;
    return changed_1;
}

/* The search with that of the kernel begun; the entry starts along the velocity relative to the air. */
static APART void begin_in_air(EntrySearch *search) {
    const RelativeState state = search->state;
    const real V = search->turns.airspeed_m_s, r = search->turns.planned_m, radius_m = circle_m(search);
    const real_2 flight_vector_1 = flight_vector(search);
    const real vx = flight_vector_1.a0, vy = flight_vector_1.a1;
    const real speed = length(vx, vy);
    const real c = vx / speed, s = vy / speed;
    if (is_still(search)) {
        /* A start beside the last arc counts as on it if half of the reserve can correct its distance. */
        const real tolerance = max_real(REAL(0.5) * (r / search->turns.tightest_m - REAL(1.0)), REAL(0.0));
        const real turn_m = turn_scale(search, speed) * r;
        const Entry entry = _still_air_entry(&state, c, s, turn_m, radius_m, search->side, tolerance);
        search->is_begun = true;
        search->in_air = found_at_once(entry);
        return;
    }
    const real R = rounded_radius(radius_m / r), east = search->wind_east_m_s / V, north =
            search->wind_north_m_s / V;
    const WindProblem problem = MAKE(WindProblem){state.x / r, state.y / r, c, s, R, search->side, east, north,
            REAL(0.0)};
    search->is_begun = true;
    search->in_air = begin_search(&problem);
    return;
}

/* Whether the last turn of an entry is opposite to that of the circle. */
static inline bool ends_opposite(integer side, integer word) {
    const integer_3 controls_1 = controls(word);
    const integer u1 = controls_1.a0, u2 = controls_1.a1, u3 = controls_1.a2;
    return (u3 != ABSENT ? u3 : u2 != ABSENT ? u2 : u1) == side;
}

/* The search after at most `steps` more steps of the kernel's, up to the end of the first or second one of these.
 *
 * `in_air.left` is then how many of the steps are left.
 */
static inline void advance_entry_search(EntrySearch *search, integer steps) {
    if (!search->is_begun) {
        begin_in_air(search);
    }
    advance_search(&search->in_air, steps);
    if (search->in_air.stage == ENDED && !search->is_second) {
        const WindEntry entry = search->in_air.entry;
        const bool is_found = entry.status == STATUS_OK && entry.side != 0;
        if (is_found && ends_opposite(entry.side, entry.word) != search->reversing) {
            const bool new_1 = !search->reversing;
            search->reversing = new_1;
            search->is_second = true;
            search->is_begun = false;
        }
    }
    return;
}

/* Whether the answer is known. */
static inline bool is_complete(const EntrySearch *search) {
    return search->is_begun && search->in_air.stage == ENDED;
}

/* The entry that a search has found; its side is 0 where there is none. */
static inline PlannedEntry found_entry(const EntrySearch *search) {
    const real V = search->turns.airspeed_m_s, r = search->turns.planned_m;
    const real_2 flight_vector_1 = flight_vector(search);
    const real vx = flight_vector_1.a0, vy = flight_vector_1.a1;
    const real scale = turn_scale(search, length(vx, vy)), unit_s = r / V;
    const Entry entry = search->in_air.entry.status == STATUS_OK ? entry_of(&search->in_air.entry) : NONE;
    const real t1_s = entry.t1 * unit_s, t2_s = entry.t2 * unit_s, t3_s = entry.t3 * unit_s;
    const real east = search->wind_east_m_s, north = search->wind_north_m_s;
    return MAKE(PlannedEntry){entry.side, entry.word, t1_s, t2_s, t3_s, scale * r, scale * V, east, north};
}

/* Whether an entry flies a word, after additional pieces that take no longer than `bend_s` in all. */
static inline bool ends_with(const PlannedEntry *entry, integer word, real bend_s) {
    const integer without_first = rest(entry->word);
    if (entry->word == word) {
        return true;
    }
    if (without_first == word) {
        return entry->t1_s <= bend_s;
    }
    return rest(without_first) == word && entry->t1_s + entry->t2_s <= bend_s;
}

/* Whether an entry has the first and the last control of a route. */
static inline bool is_alike(const PlannedEntry *entry, const Route *route) {
    const integer_3 controls_1 = controls(entry->word);
    const integer first_u = controls_1.a0;
    return first_u == route->current.u && end_control(entry->word) == last_control(route);
}

/* The time until the circle is joined. */
static inline real duration_s(const PlannedEntry *entry) {
    return entry->t1_s + entry->t2_s + entry->t3_s;
}

/* Whether an entry, which began `passed_s` seconds ago, should replace a plan.
 *
 * Either `update` holds, and it is the same plan and not much slower; or it is faster by a margin.
 *
 * In still air a plan with the same first and last turns is the same one, whether there is a line between them or
 * not. In wind additional pieces at its beginning, together no longer than `LONGEST_BEND`, do not make it a
 * different plan. The duration of a plan with tighter turns grows with their radius.
 */
static inline bool is_better(const PlannedEntry *entry, const Plan *plan, TurnLimits turns, bool update, real
        passed_s) {
    const Route route = plan->route;
    const real unit_s = turns.planned_m / turns.airspeed_m_s;
    const bool is_still = entry->wind_east_m_s == REAL(0.0) && entry->wind_north_m_s == REAL(0.0);
    const integer left = encode(route.current.u, route.second.u, route.third.u);
    bool same = entry->side == route.side && ends_with(entry, left, is_still ? REAL(0.0) : LONGEST_BEND * unit_s);
    if (is_still && update && entry->side == route.side) {
        same = same || is_alike(entry, &route);
    }
    if (same && !update) {
        return false;
    }
    const real widened = same ? max_real(REAL(1.0), entry->turn_radius_m / route.turn_radius_m) : REAL(1.0);
    const real margin_s = (same ? UPDATE_MARGIN : -SWITCH_MARGIN) * unit_s;
    return duration_s(entry) - passed_s < widened * (plan->remaining_s + later_s(&route)) + margin_s;
}

/* The memory after a complete search, with the plan that it has found if that is better than the present one.
 *
 * After the search for the first turn the one for the first plan follows.
 */
static APART void take_entry(Planning *planning, const Settings *settings, const Limits *limits, const Sensing
        *sensing) {
    const integer aim = planning->search.aim;
    const RelativeState state = planning->search.state;
    const PlannedEntry entry = found_entry(&planning->search);
    drop_search(planning);
    if (entry.side == 0) {
        return;
    }
    const Estimate present = sensing->present;
    if (aim == FIRST_TURN) {
        const integer_3 controls_1 = controls(entry.word);
        const integer first = controls_1.a0;
        const real bank_deg = first != ABSENT ? (real)-first * limits->limit_deg : (real)entry.side *
                limits->hold_deg;
        const Estimate later = estimate_after(&present, lead_s(limits, present.bank_deg, bank_deg));
        const RelativeState stored_2 = relative_state(settings, &later);
        begin_plan_search(planning, settings, limits, ANY, &stored_2, sensing->clock.time_s);
        return;
    }
    /* How much later it is than where the search began. */
    const real passed_s = aim == ANY ? REAL(0.0) : planning->response.state.time_s - state.time_s;
    if (aim != ANY && !is_better(&entry, &planning->plan, limits->turns, aim == UPDATE, passed_s)) {
        return;
    }
    const Route route = route_of(&state, &entry);
    const real join_s = state.time_s + duration_s(&entry);
    const Plan plan = MAKE(Plan){route, route.current.time_s, join_s, join_s, planning->plan.searched_s};
    planning->plan = plan;
    advance_plan(planning, settings, limits, sensing);
    return;
}

/* The memory after at most `steps` more steps of its search, with the plan that this has found. */
static inline void continue_search(Planning *planning, const Settings *settings, const Limits *limits, const Sensing
        *sensing, integer steps) {
    integer left = steps;
    while (planning->search.aim != NOTHING && left > 0) {
        advance_entry_search(&planning->search, left);
        left = planning->search.in_air.left;
        if (is_complete(&planning->search)) {
            take_entry(planning, settings, limits, sensing);
        }
    }
    return;
}

/* The rate at which the vehicle turns at a bank: the inverse of `bank_for`, but in degrees per second. */
static inline real turn_rate_deg_s(const VehicleEstimates *known, real bank_deg) {
    return known->turn_ratio * rate_at_bank(bank_deg, known->airspeed_m_s) * REAL(57.29577951308232);
}

/* The memory with the safe command while there is no usable measurement, or no plan yet. */
static inline void without_data(Memory *memory, const Settings *settings, const VehicleEstimates *known, real dt) {
    real bank_deg = memory->command.bank_deg;
    const Route route = memory->planning.plan.route;
    if (memory->sensing.clock.since_s > BLIND_S) {
        const bool on_circle = route.side != 0 && is_holding(&route);
        bank_deg = on_circle ? (real)route.side * memory->limits.hold_deg : REAL(0.0);
    }
    /* The limit may be lower now than when the last command was given. */
    bank_deg = clip(bank_deg, settings->command_limit_deg);
    const real rate = turn_rate_deg_s(known, bank_deg);
    const LawCommand command = MAKE(LawCommand){rate, bank_deg, NO_DATA, REAL_NAN, memory->command.side, NO_DATA,
            REAL_NAN};
    Planning changed_1 = memory->planning;
    forget_leads(&changed_1);
    const Planning new_2 = changed_1;
    memory->planning = new_2;
    memory->command = command;
    memory->step_s = dt;
    return;
}

/* The observer that measures the gusts along the flight anew. */
static inline Observer restart_gusts(const Observer *observer) {
    AirAverage changed_1 = observer->air;
    changed_1.along = CALM_ALONG;
    Observer changed_2 = (*observer);
    changed_2.air = changed_1;
    return changed_2;
}

/* What is known, without the gusts: the turns before the circle look like gusts. */
static inline void measure_gusts_anew(Sensing *sensing) {
    sensing->observer = restart_gusts(&sensing->observer);
    return;
}

/* The memory once it is known elsewhere that the circle was joined. */
static inline void forget_joining(Planning *planning) {
    planning->has_joined = false;
    return;
}

/* The velocity along the path: relative to the plan's steady wind; on the circle, relative to the circle. */
static inline real_2 path_velocity(const Route *route, const RelativeState *state) {
    if (is_holding(route)) {
        return flight_velocity(state->vx, state->vy, state->hx, state->hy);
    }
    const real east = route->wind_east_m_s, north = route->wind_north_m_s;
    return flight_velocity(state->vx - east, state->vy - north, state->hx, state->hy);
}

/* The gain of course corrections in the present air; on the circle, which turns at `turn_rate`, it is smaller.
 *
 * It is larger in heavy gusts, and smaller where quick turns are quicker than the bank says.
 */
static inline real corrections_gain(const Settings *settings, const VehicleEstimates *known, const Observer
        *observer, real response_s, real turn_rate, bool holding) {
    const real gain = settings->gain;
    real rough, share;
    if (holding) {
        rough = along_roughness(observer);
        const real calm_rate = max_real(HOLD_RATE, HOLD_MULTIPLE * HOLD_GAIN * turn_rate);
        const real calm_share = max_real(min_real(calm_rate * response_s / gain, CALM_GAIN), CALM_HOLD_GAIN);
        share = max_real(min_real(rough / ROUGH_HOLD * (rough / ROUGH_HOLD), REAL(1.0)), calm_share);
    } else {
        rough = roughness(observer);
        share = max_real(min_real(rough / ROUGH_AIR, REAL(1.0)), CALM_GAIN);
    }
    const real lively = max_real(known->quick_turn_ratio / known->turn_ratio, REAL(1.0));
    return gain * max_real(share, min_real(rough / HEAVY_GUSTS, HEAVY_GAIN)) / lively;
}

/* The offset from the circle to correct, in air of this roughness: a large crosstrack error counts for more. */
static inline PathOffset steep_offset(PathOffset offset, real radius_m, real rough) {
    const real beyond_m = offset.crosstrack - clip(offset.crosstrack, STEEP_OFFSET * radius_m);
    const real calm = max_real(REAL(1.0) - rough / ROUGH_HOLD, REAL(0.0));
    PathOffset changed_1 = offset;
    changed_1.crosstrack = offset.crosstrack + calm * beyond_m;
    return changed_1;
}

/* The rate at which the course should turn to reach a path and stay on it.
 *
 * With the crosstrack error e, the course error b and small angles, e' = speed b, and b is driven towards
 * -`place_gain` e/speed with the gain `course_gain`: e'' + course_gain (e' + place_gain e) = 0. There is no
 * overshoot if `course_gain` is at least four times `place_gain`.
 */
static inline real course_rate(PathOffset offset, real course_gain, real place_gain, real speed) {
    const real intercept = clip(-place_gain * offset.crosstrack / speed, STEEPEST_INTERCEPT);
    return offset.path_rate - course_gain * (offset.course_error - intercept);
}

/* The correction of the rate of turn on the circle after another step, radians per second. */
static inline real next_trim(const Settings *settings, real trim, real crosstrack, real course_gain, real V, real
        dt) {
    const real R = settings->radius_m, turn_rate = V / settings->radius_m;
    if (real_fabs(crosstrack) >= TRIMMED_OFFSET * R) {
        return trim;
    }
    const real place_gain = HOLD_GAIN * turn_rate;
    const real integral_gain = min_real(TRIM_GAIN * course_gain, LARGEST_TRIM_GAIN) * place_gain * place_gain / V;
    return clip(trim + integral_gain * crosstrack * dt, LARGEST_TRIM * turn_rate);
}

/* The turn rate through the air, for the heading (hx, hy), that turns the velocity (vx, vy) at `rate`.
 *
 * A turn at the rate w with the airspeed a accelerates the vehicle by a w across its heading. The component a w
 * cos(crab) turns a velocity of the size v at the rate a w cos(crab)/v. On the circle this is equation (3) of
 * docs/wind.md, `hold.hold_rate`.
 */
static inline real air_rate(real rate, real vx, real vy, real hx, real hy) {
    return rate * (vx * vx + vy * vy) / (hx * vx + hy * vy);
}

/* The bank that follows the route, and the trim; on a turn before the last piece it is the bank limit.
 *
 * Such a turn is planned again before it ends, unless the path is given; flying it as wide as planned would only
 * cost time.
 */
static inline real_2 target_bank(real trim, const Settings *settings, const Limits *limits, const Sensing *sensing,
        const Planning *planning, const VehicleEstimates *known, real dt) {
    const Route route = planning->plan.route;
    const Observer observer = sensing->observer;
    const integer u = planning->plan.route.current.u;
    if (u != 0 && route.second.u != ABSENT && planning->path.total == 0) {
        return MAKE(real_2){(real)-u * limits->limit_deg, trim};
    }
    const RelativeState state = planning->response.state;
    const PathOffset offset = planning->response.offset;
    const real_2 path_velocity_1 = path_velocity(&route, &state);
    const real vx = path_velocity_1.a0, vy = path_velocity_1.a1;
    const real speed = length(vx, vy), R = settings->radius_m, V = limits->turns.airspeed_m_s;
    const bool holding = is_holding(&route);
    const real response_s = limits->lag_s + observer.smoothing_s;
    const real gain = corrections_gain(settings, known, &observer, response_s, V / R, holding);
    const real bandwidth = REAL(1.0) / (response_s + gain * dt);
    const real place_gain = holding ? HOLD_GAIN * speed / R : PLACE_GAIN * bandwidth;
    const PathOffset followed = holding ? steep_offset(offset, R, along_roughness(&observer)) : offset;
    real course = course_rate(followed, gain * bandwidth, place_gain, speed);
    if (holding) {
        trim = next_trim(settings, trim, offset.crosstrack, gain * bandwidth, V, dt);
        course -= trim;
    }
    const real rate = -air_rate(course, vx, vy, state.hx, state.hy);
    /* At the present airspeed, which differs from the mean one where an autopilot holds it less exactly. */
    return MAKE(real_2){bank_at_rate(rate / known->turn_ratio, length(state.hx, state.hy)), trim};
}

/* The command that brings the bank to a target `command_gain` times as fast as commanding the target would.
 *
 * It lies beyond the target, but never beyond the bank limit.
 */
static inline real demand_deg(RollValues roll, Bank now, real target_deg, real limit_deg) {
    if (roll.time_s == REAL(0.0)) {
        return target_deg;
    }
    const real change_deg = command_gain(roll) * (target_deg - now.bank_deg) - rate_gain_s(roll) * now.rate_deg_s;
    return clip(now.bank_deg + change_deg, limit_deg);
}

/* The phase in which a control is flown; on the circle, which follows the last control, if that is absent. */
static inline integer phase_code(integer u) {
    return u == ABSENT ? HOLD : u;
}

/* The memory with the command for the next `dt` seconds, which follows the plan. */
static APART void conclude(Memory *memory, const Settings *settings, const VehicleModel *vehicle, real dt) {
    if (!memory->sensing.is_known || memory->planning.plan.route.side == 0) {
        without_data(memory, settings, &vehicle->estimates, dt);
        return;
    }
    if (memory->planning.has_joined) {
        measure_gusts_anew(&memory->sensing);
        forget_joining(&memory->planning);
    }
    const Limits limits = memory->limits;
    const Estimate present = memory->sensing.present;
    const Plan plan = memory->planning.plan;
    const real_2 target_bank_1 = target_bank(memory->trim, settings, &limits, &memory->sensing,
            &memory->planning, &vehicle->estimates, dt);
    real target_deg = target_bank_1.a0;
    const real trim = target_bank_1.a1;
    target_deg = clip(target_deg, limits.limit_deg);
    const Bank now = MAKE(Bank){present.bank_deg, memory->sensing.bank_rate_deg_s};
    const RollValues roll = vehicle->estimates.roll;
    real bank_deg = demand_deg(roll, now, target_deg, limits.limit_deg);
    bank_deg = slewed_command(memory->sensing.command_deg, bank_deg, roll.slew_deg_s * dt);
    bank_deg = clip(bank_deg, settings->command_limit_deg);
    const Route route = plan.route;
    const LawCommand command = MAKE(LawCommand){turn_rate_deg_s(&vehicle->estimates, bank_deg), bank_deg,
            phase_code(route.current.u), max_real(plan.join_s - present.time_s, REAL(0.0)), route.side,
            phase_code(route.second.u), is_holding(&route) ? REAL_INFINITY : plan.remaining_s -
            memory->planning.response.early_s};
    memory->trim = trim;
    memory->command = command;
    memory->step_s = dt;
    return;
}

/* The memory, with the command for the next `dt` seconds.
 *
 * `vehicle` is what is known at this time, with the bank that is modelled for the end of the last command.
 */
static inline void advance(Rings *rings, Memory *memory, const Settings *settings, const VehicleModel *vehicle,
        const State *measurement, real dt) {
    prepare(rings, memory, settings, vehicle, measurement);
    const integer steps = settings->search_steps == 0 ? UNLIMITED : settings->search_steps;
    continue_search(&memory->planning, settings, &memory->limits, &memory->sensing, steps);
    conclude(memory, settings, vehicle, dt);
    return;
}

/* ---- The functions of loiter.h ---------------------------------------------------------------------------------- */

static int exported(Entry found, loiter_entry *entry) {
    const integer_3 u = controls(found.word);
    const integer each[3] = {u.a0, u.a1, u.a2};
    const real durations[3] = {found.t1, found.t2, found.t3};
    entry->side = (int)found.side;
    entry->pieces = 0;
    for (int i = 0; i < 3; i++) {
        const bool is_piece = each[i] != ABSENT;
        entry->controls[i] = is_piece ? (int)each[i] : LOITER_STRAIGHT;
        entry->durations[i] = is_piece ? durations[i] : REAL(0.0);
        entry->pieces += is_piece ? 1 : 0;
    }
    return LOITER_OK;
}

static int status_of_side(int side) { return side >= -1 && side <= 1 ? LOITER_OK : LOITER_BAD_TURN; }

static int end_with(loiter_search *search, int status) {
    search->state.entry.status = status;
    search->state.stage = ENDED;
    return status;
}

int loiter_search_begin(loiter_search *search, const loiter_problem *p) {
    const real size = length(p->c, p->s);
    search->state = NO_SEARCH;
    if (status_of_side(p->side) != LOITER_OK) {
        return end_with(search, LOITER_BAD_TURN);
    }
    if (!(real_fabs(size - REAL(1.0)) <= REAL(1e-3))) {
        return end_with(search, LOITER_BAD_POSE);
    }
    const WindProblem problem = {p->x,    p->y,  p->c / size, p->s / size, rounded_radius(p->radius),
                                 p->side, p->wx, p->wy,       p->tolerance};
    const integer status = status_of(&problem);
    if (status != STATUS_OK) {
        return end_with(search, (int)status);
    }
    if (p->wx == REAL(0.0) && p->wy == REAL(0.0)) {
        const real_2 at = reduce(problem.x, problem.y, problem.c, problem.s);
        const Entry found = optimum(at.a0, at.a1, problem.R, problem.side, problem.tolerance);
        WindEntry *const entry = &search->state.entry;
        entry->side = found.side;
        entry->word = found.word;
        entry->t1 = found.t1;
        entry->t2 = found.t2;
        entry->t3 = found.t3;
        return end_with(search, LOITER_OK);
    }
    search->state = begin_search(&problem);
    return LOITER_OK;
}

int loiter_search_step(loiter_search *search, int steps, loiter_entry *entry) {
    advance_search(&search->state, steps);
    if (search->state.stage != ENDED) {
        return LOITER_SEARCHING;
    }
    return search->state.entry.status == STATUS_OK ? exported(entry_of(&search->state.entry), entry)
                                                   : (int)search->state.entry.status;
}

int loiter_fastest(const loiter_problem *problem, loiter_entry *entry) {
    loiter_search search;
    const int status = loiter_search_begin(&search, problem);
    return status == LOITER_OK ? loiter_search_step(&search, UNLIMITED, entry) : status;
}

loiter_law_config loiter_law_defaults(loiter_real airspeed_m_s, loiter_real bank_limit_deg, loiter_real radius_m,
                                      int side) {
    loiter_law_config config;
    config.radius_m = radius_m;
    config.side = side;
    config.airspeed_m_s = airspeed_m_s;
    config.bank_limit_deg = bank_limit_deg;
    config.roll_time_s = REAL(0.5);
    config.roll_rate_deg_s = REAL(60.0);
    config.roll_slew_deg_s = REAL_INFINITY;
    config.delay_s = REAL(0.1);
    config.wind_east_m_s = config.wind_north_m_s = REAL(0.0);
    config.reserve = REAL(0.1);
    config.smoothing_s = REAL(0.5);
    config.gain = REAL(4.0);
    config.search_steps = 0;
    return config;
}

static bool is_within(real value, real least, real most) { return value >= least && value <= most; }

/* The largest times, seconds, gains and speeds of any aircraft, the largest bank, degrees, whose tangent single precision
 * still resolves, and the least rate of a roll, degrees per second, and time constant but 0, seconds; with others numbers
 * might overflow, or be divided by zero. */
#define MOST REAL(1000.0)
#define LARGEST_BANK REAL(89.0)
#define LEAST_ROLL_RATE REAL(0.1)
#define LEAST_ROLL_TIME REAL(1e-06)

/* Whether a law can be made for a configuration. */
static int status_of_config(const loiter_law_config *c) {
    if (!is_within(c->airspeed_m_s, LEAST_AIRSPEED_M_S, MOST) || !(c->bank_limit_deg > REAL(0.0)) ||
        !(c->bank_limit_deg <= LARGEST_BANK)) {
        return LOITER_BAD_AIRCRAFT;
    }
    if (!(c->radius_m > REAL(0.0)) || !(c->radius_m <= LARGEST_VALUE)) {
        return LOITER_BAD_ORBIT;
    }
    if (status_of_side(c->side) != LOITER_OK) {
        return LOITER_BAD_TURN;
    }
    const bool is_roll = c->roll_time_s == REAL(0.0) || is_within(c->roll_time_s, LEAST_ROLL_TIME, MOST);
    if (!is_roll || !(c->roll_rate_deg_s >= LEAST_ROLL_RATE) ||
        !(c->roll_slew_deg_s >= LEAST_ROLL_RATE) ||
        !is_within(c->delay_s, REAL(0.0), MOST) || !is_within(c->reserve, REAL(0.0), MOST) ||
        !is_within(c->smoothing_s, REAL(0.0), MOST) || !(c->gain > REAL(0.0)) || !(c->gain <= MOST) || c->search_steps < 0) {
        return LOITER_BAD_RESPONSE;
    }
    const real R = rounded_radius(c->radius_m / radius_at_bank(c->airspeed_m_s, c->bank_limit_deg));
    const real wx = c->wind_east_m_s / c->airspeed_m_s, wy = c->wind_north_m_s / c->airspeed_m_s;
    if (!isfinite(wx) || !isfinite(wy)) {
        return LOITER_BAD_WIND;
    }
    const WindProblem at_centre = {REAL(0.0), REAL(0.0), REAL(1.0), REAL(0.0), R, SIDE_EITHER, wx, wy, REAL(0.0)};
    return (int)status_of(&at_centre);
}

/* Let the memory use the rings of this law, wherever that is now. */
static void use_own_rings(loiter_law *law) {
    law->memory.sensing.history.entries = &law->rings.BankEntry_ring_128;
    law->memory.sensing.observer.air.recent = &law->rings.AirSample_ring_64;
}

int loiter_law_begin(loiter_law *law, const loiter_law_config *c) {
    const int status = status_of_config(c);
    if (status != LOITER_OK) {
        return status;
    }
    const RollValues roll = {c->roll_time_s, c->roll_rate_deg_s, REAL(0.0), c->roll_slew_deg_s};
    const VehicleEstimates declared = {roll,
                                       c->delay_s,
                                       REAL(1.0),
                                       REAL(1.0),
                                       REAL(0.0),
                                       c->wind_east_m_s,
                                       c->wind_north_m_s,
                                       c->airspeed_m_s,
                                       c->airspeed_m_s,
                                       REAL(0.0),
                                       REAL(0.0),
                                       REAL(0.0),
                                       REAL(0.0)};
    law->settings = MAKE(Settings){REAL(0.0),
                                   REAL(0.0),
                                   c->radius_m,
                                   c->side,
                                   REAL(0.0),
                                   REAL(0.0),
                                   c->wind_east_m_s,
                                   c->wind_north_m_s,
                                   c->bank_limit_deg,
                                   c->bank_limit_deg,
                                   c->gain,
                                   c->reserve,
                                   c->smoothing_s,
                                   REAL(0.0),
                                   max_real(REAL(2.0), c->delay_s),
                                   c->search_steps};
    law->vehicle = MAKE(VehicleModel){0, REAL(0.0), REAL(0.0), declared};
    law->begin_us = 0;
    law->memory = first_memory(&law->rings, &law->settings, &law->vehicle);
    return LOITER_OK;
}

/* Times in the memory are relative to `begin_us`, which follows the clock at these intervals, seconds: single precision
 * resolves 4 microseconds in the first of them. */
#define INTERVAL_S 64

static void follow_clock(loiter_law *law, uint32_t time_us) {
    Sensing *sensing = &law->memory.sensing;
    Clock *clock = &sensing->clock;
    if (clock->time_s == -REAL_INFINITY) {
        law->begin_us = time_us;
        return;
    }
    const int32_t intervals = (int32_t)real_floor(clock->time_s / (real)INTERVAL_S);
    if (intervals == 0) {
        return;
    }
    const real past_s = (real)(intervals * INTERVAL_S);
    law->begin_us += (uint32_t)intervals * (uint32_t)INTERVAL_S * UINT32_C(1000000);
    clock->time_s -= past_s;
    clock->first_s -= past_s;
    clock->latest_s -= past_s;
    sensing->observer.estimate.time_s -= past_s;
    sensing->present.time_s -= past_s;
    plan_by_clock(&law->memory.planning.plan, -past_s);
    law->memory.planning.search.state.time_s -= past_s;
    law->memory.planning.response.state.time_s -= past_s;
    BankEntry *entries = law->rings.BankEntry_ring_128.at;
    const BankEntry last = entries[ENTRIES - 1];
    for (int i = 0; i < ENTRIES; i++) {
        entries[i].end_s -= last.end_s;
        entries[i].integral -= last.integral;
    }
    AirSample *samples = law->rings.AirSample_ring_64.at;
    const real now_s = samples[SAMPLES - 1].time_s;
    for (int i = 0; i < SAMPLES; i++) {
        samples[i].time_s -= now_s;
    }
}

/* A step, once the bank of the vehicle is modelled for the end of the last command. */
static void step_with(loiter_law *law, const loiter_measurement *m, real dt_s, loiter_command *command) {
    use_own_rings(law);
    follow_clock(law, m->time_us);
    const real time_s = (real)(int32_t)(m->time_us - law->begin_us) * REAL(1e-6);
    const State state = {time_s,      m->east_m,           m->north_m,           m->heading_deg,
                         m->bank_deg, m->velocity_east_m_s, m->velocity_north_m_s, m->airspeed_m_s};
    advance(&law->rings, &law->memory, &law->settings, &law->vehicle, &state, dt_s);
    const LawCommand *const given = &law->memory.command;
    command->turn_rate_deg_s = given->turn_rate_deg_s;
    command->bank_deg = given->bank_deg;
    command->phase = (int)given->phase;
    command->time_to_join_s = given->time_to_join_s;
    command->side = (int)given->side;
    command->next_phase = (int)given->next_phase;
    command->next_in_s = given->next_in_s;
}

int loiter_law_step_known(loiter_law *law, const loiter_measurement *measurement, loiter_real dt_s,
                          loiter_command *command) {
    if (!is_step(dt_s)) {
        return LOITER_BAD_STEP;
    }
    step_with(law, measurement, dt_s, command);
    return LOITER_OK;
}

int loiter_law_step(loiter_law *law, const loiter_measurement *measurement, loiter_real dt_s, loiter_command *command) {
    if (is_step(dt_s)) {
        law->vehicle = fly_as_declared(&law->vehicle, law->memory.command.bank_deg, law->memory.step_s);
    }
    return loiter_law_step_known(law, measurement, dt_s, command);
}
