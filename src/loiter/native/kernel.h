/* The fastest way onto a holding circle, in still air and in wind, in double precision, with the functions of the C
 * library: the same answers as in Python, to the last bit.
 *
 * Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
 *
 * SHA-256 of the source: f01ba3f00e62a87c45588a9e24ca83a795c8aad04ba22b153a320ddf602867de
 */
#ifndef LOITER_KERNEL_H
#define LOITER_KERNEL_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

typedef double real;
typedef int64_t integer;
typedef uint64_t unsigned_integer;

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

/* A maneuver: the side of its circle, its word as flown, and the durations of its pieces (0 past the last). */
typedef struct { integer side, word; real t1, t2, t3; } Entry;

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

/* The derivatives of T with respect to the reduced state and the radius of the circle. */
typedef struct { real x, y, radius; } ValueGradient;

/* The multiplier lambda and the adjoint psi of a state. */
typedef struct { real lam, psi1, psi2; } Adjoint;

typedef struct { real a0, a1, a2, a3; } real_4;

/* An entry to find: start, heading as a unit vector, radius, `words.Side`, velocity of the air past the circle.
 *
 * A start beyond the circle, or beyond a last arc, by less than `tolerance` (turn radii) counts as on it.
 */
typedef struct { real x, y, c, s, R; integer side; real wx, wy, tolerance; } WindProblem;

/* A maneuver as flown: status, side, word, durations, azimuth of the point of joining, and miss.
 *
 * The azimuth is counted counter-clockwise from the x axis; the miss is the distance of the end from that point,
 * position and heading together.
 */
typedef struct { integer status, side, word; real t1, t2, t3, azimuth, miss; } WindEntry;

/* Start, heading as a unit vector, radius, wind, and `arc_tolerance` as in `moving_target.Ends`. */
typedef struct { real x, y, c, s, R, wx, wy, arc_tolerance; } WindScene;

/* A path to the pose: its time, word and three durations, and its adjoint, lambda and the unit vector p.
 *
 * The adjoint is that of docs/wind.md, section 3.
 */
typedef struct { real time; integer word; real t1, t2, t3, lam, p1, p2; } Path;

/* A path and where it joins: the phase of the point (`hold`), and the side on which the circle is held. */
typedef struct { real phase; integer side; Path path; } WindCandidate;

/* A maneuver that ends beside the circle by `miss`, at the point of joining with this phase. */
typedef struct { Entry entry; real phase, miss; } EntryBeside;

/* A cell, one of `FIRST_CELLS` << `level` equal arcs of the circle, by its number; and words, six bits a level.
 *
 * The words are those that may join inside the cells that contain it, the smallest in the lowest bits; of these
 * cells none is below the level `NARROWED`.
 */
typedef struct { integer number, level, words; } CellVisit;

/* A point of joining: its phase, the first path to it, and the slope of the time there, `join_slope`. */
typedef struct { real phase; Path path; real slope; } JoinPoint;

/* The end of a cell of the level `LEAF`, by the number of the cell. */
typedef struct { integer number; JoinPoint point; } LeafEnd;

/* A set of cells of the level `LEAF`: a bit for each, for each quarter of the circle. */
typedef struct { integer first, second, third, fourth; } Leaves;

/* Two arcs that end on the circle: the phase of their end, the control of the first, and their durations. */
typedef struct { real phase; integer u; real t1, t2; } Corner;

/* The search for the local minimum of the time next to a candidate, which `refine` continues step by step.
 *
 * From the best point so far, `here`, the time falls towards the point `other`. Once the minimum is enclosed, the
 * time there is higher, or it falls in the opposite direction: so there is a local minimum between them. `last` is
 * the point tried last, with one of a set of words; `bisect` says that the next point is that in the middle.
 * `steps` counts those of the stage, and `enclosures` the minima that were not yet the last one.
 */
typedef struct { integer stage, side; real width; JoinPoint here, other, last; integer words; bool bisect; integer
        steps, enclosures; } Refinement;

/* A cell whose end has a path faster than the best one: the words that may join inside it before the best time.
 *
 * No path into the cell is faster than `earliest`. Without one that is faster than the best by `tolerance` it is
 * done.
 */
typedef struct { integer words; real earliest, tolerance; } OpenCell;

/* A search for the fastest entry, which `advance_search` continues: its stage, and what is known so far.
 *
 * The sides of the circle that are asked for are `sides`, that which is searched now is `side`. `best` is the
 * fastest path found, `beside` the entry beside the circle that counts, too. `visit` is the next cell; `before` the
 * end of the leaf before it, `leaves` those that are left on this side, and `others` on the other one. `corner` is
 * that of the best path, which took the time `compared`, and `visits` the number of cells so far. While there is a
 * refinement, it is continued first; `cell` is the cell that waits for it. `left` is the number of steps that may
 * follow at once, and `entry` the result once the stage is ENDED.
 */
typedef struct { integer stage, sides, side; WindScene scene; WindCandidate best; EntryBeside beside; CellVisit
        visit; LeafEnd before; Leaves leaves, others; Corner corner; real compared; integer visits; Refinement
        refinement; OpenCell cell; integer left; WindEntry entry; } WindSearch;

typedef struct { real a0, a1, a2, a3, a4; } real_5;

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

/* A slot: the side on which the circle is held, and the phase (`hold`) of the slot at the time 0. */
typedef struct { integer side; real phase; } Slot;

/* The slot after an angle `width` of the circle: the time, and the point from the start, in the frame of the air.
 *
 * (c, s) is the heading there, `advance` the derivative of the time by the width, `turning` that of the size of the
 * angle through which the heading has turned since the time 0, and `turned` this angle.
 */
typedef struct { real width, time, x, y, c, s, advance, turning, turned; } SlotPose;

/* Bounds within `step` of a width: on V, on its derivative and on the rate at which the heading turns. */
typedef struct { real step, speed, speed_change, turning; } Bounds;

/* Length less time of a word with a straight piece, less whole turns, in [-pi, pi], and its derivative.
 *
 * `apart` is the square of the distance of the outer circles' centres less 4, and `apart_slope` its derivative: LSR
 * and RSL exist where it is not negative.
 */
typedef struct { real value, slope, apart, apart_slope; } Excess;

/* Bounds on the second derivative of |d|^2: it is at least -`down`, at most `up`, and no larger than `size`. */
typedef struct { real down, up, size; } Bends;

/* The function whose roots are the arrivals of LRL or RLR, and its derivative.
 *
 * With it the middle arc and the vector between the centres of the outer arcs.
 */
typedef struct { real value, slope, arc, dx, dy; } Middle;


/* Beyond this many turn radii neighbouring doubles are a turn radius apart. */
#define REACH 4503599627370496.0 /* 2.0 ** 52 */

/* Rounding error of a length of order one: the reduction (2) costs 2 roundings a coordinate, a difference of
 * squares 6, the angle and the flight of each of three pieces about 10; 64 units of 2**-52 is the next power of two
 * above the sum.
 */
#define ROUNDING 1.4210854715202004e-14 /* 64.0 * 2.0 ** (-52) */

/* Dekker's splitting factor, 2^27 + 1, halves the 53 digits of a double. */
#define SPLITTER 134217729.0

/* A rotation multiplied by less could have subnormal components, which have lost digits. Below this distance the
 * rounding error of c - end x itself is negligible.
 */
#define SMALLEST_SCALE 4.909093465297727e-91 /* 2.0 ** (-300) */
static const real_2 NO_ROTATION = {0.0, 1.0};

/* Added to inner products, so that a zero vector gives the rotation by zero. It is negligible for vectors longer
 * than 1e-37, and a product of three of them does not underflow.
 */
#define TINY 4.909093465297727e-91 /* 2.0 ** (-300) */
#define TWO_PI 6.283185307179586 /* 2.0 * pi */

/* The control of a piece that the word does not have. */
#define ABSENT (-2)
static const WindSearch NO_SEARCH = {0, 0, 1, {0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0}, {0.0, 0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}}, {{0, 0, INFINITY, 0.0, 0.0}, 0.0, INFINITY}, {0, 0, 63}, {-2, {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0}}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0.0, 0, 0.0, 0.0}, INFINITY, 0, {0, 0, 0.0, {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0}, {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0}, {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0}, 0, false, 0, 0}, {0, 0.0, 0.0}, 0, {12, 0, 0, NAN, NAN, NAN, NAN, NAN}};

/* The stages of a search: on each side, first some points, then cells down to the leaves, then the leaves that are
 * left.
 */
#define ENDED 5

/* A slower wind displaces no point within REACH by as much as rounding, and its square would be subnormal. */
#define NEGLIGIBLE_WIND 3.8725919148493183e-121 /* 2.0 ** (-400) */
static const EntryBeside NO_ENTRY_BESIDE = {{0, 0, INFINITY, 0.0, 0.0}, 0.0, INFINITY};

/* Newton's method reduces an error of 1e-4 to rounding in three steps. */
#define ARC_STEPS 8

/* Points of joining around the circle between which single arcs are looked for. */
#define ARC_SAMPLES 32

/* The path found next to two arcs may be too early by this many times its miss: both vary with the adjoint, whose
 * length over lambda + p . w stays below 10 where lambda = 1 and |w| < 0.9.
 */
#define TOO_EARLY 10.0

/* Where two arcs are the fastest, the search ends on a word with a short third piece that is due to rounding: a
 * straight piece of up to the square root of 4e-14 where the phase is accurate to 1e-14.
 */
#define SHORT 0.0001

/* More steps than any search takes. */
#define UNLIMITED 2147483647 /* 2 ** 31 - 1 */

/* The stages of a refinement; there is none, or it has ended, where it is REFINED. */
#define REFINED 0
#define BRACKETING 1

/* Sets of the six words of three pieces, a bit for each: all, and those with a straight piece. */
#define ALL_WORDS 63
static const Path NO_PATH = {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0};

/* An arc that comes this close to a whole turn, or to zero, may pass it. */
#define ALMOST 1e-06

/* Here Newton's method approaches every root from the side on which it converges monotonically. Each step squares
 * the error, or halves it near a double root; 60 halvings are more than the digits of a double.
 */
#define NEWTON_STEPS 60

/* The next step of Newton's method for LSR or RSL is left out where it would be less than the time times this over
 * 2 (1 - |w|).
 */
#define NO_STEP 3.469446951953614e-18 /* 2.0 ** (-58) */

/* Steps, each twice as long as the last, that together go round the circle from a leaf of `wind_search`. */
#define BRACKETING_STEPS 7
#define ENCLOSING 2

/* The search ends where another step is worth less than the time over this. */
#define WORTH 9007199254740992.0 /* 2.0 ** 53 */
#define COMPARING 3

/* A point of two arcs is a local minimum unless the time falls away from it this far before or after it, in
 * radians. The phase of such a point is known to some 1e-15, and the time changes by no more than a few times this
 * up to there.
 */
#define AT_CORNER 1e-12

/* At worst every other step of `enclose` bisects, so 106 steps exhaust the digits of a double; 14 are in reserve. */
#define REFINING_STEPS 120

/* A faster path is sought this far before and after a local minimum, in radians; this is multiplied by the time
 * where that is below 1.
 */
#define BESIDE 1e-07
static const Refinement NO_REFINEMENT = {0, 0, 0.0, {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0}, {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0}, {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0}, 0, false, 0, 0};

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
static const LeafEnd NO_LEAF_END = {-2, {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0}};
static const Corner NO_CORNER = {0.0, 0, 0.0, 0.0};
#define LAST 44

/* The last level to which a cell hands on its words: five sets of six bits, from the first level or from `LEAF` on,
 * fit into the integers of JavaScript.
 */
#define NARROWED 8

/* Points of joining on each side that are tried first. */
#define JOINS 8
#define WITH_STRAIGHT 15
static const JoinPoint NO_POINT = {0.0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}, 0.0};

/* Tangents to h that `has_no_middle` tries. */
#define TANGENTS 8
#define COARSE 2

/* A quarter of the cells of the level `LEAF`: as many as there are bits in the integers of JavaScript. */
#define LEAVES 32 /* FIRST_CELLS << LEAF - 2 */
static const WindCandidate NO_CANDIDATE = {0.0, 0, {INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}};

/* After so many cells of the level `LEAF` and below, the tolerance is `hold_tolerance`. More are needed only in
 * degenerate scenes, some of those in still air with R = 1 or 2; the slowest others found take some 2,500.
 */
#define MOST_VISITS 4096

/* In wind maneuvers tie if their times agree to this share of 1 + R + T: the accuracy found in docs/wind.md,
 * section 6.
 */
#define WIND_TIE_TOLERANCE 1e-12

/* The arc of the circle that is held for `hold_tolerance`. */
#define UNKNOWN_ARC 0.0015339807878856412 /* TWO_PI / 4096.0 */

/* In cells within this many half widths of the end of the best path, bounds around that end are tried too. */
#define NEAR_BEST 8.0

/* 4/3 (TURNS/2)^3. */
#define CUBE 0.288 /* TURNS * TURNS * TURNS / 6.0 */

/* A vector that is displaced by a share of its length turns by less than this times that share, up to two thirds. */
#define TURNS 1.2

/* The angle by which the other arc may change while one vanishes. */
#define SWING 1.5707963267948966 /* 0.5 * pi */

/* Points of joining around the circle between which `ranked` looks for local minima. */
#define SAMPLES 128

/* Halvings of the angle that is held until the circle can be reached. */
#define BEGIN_HALVINGS 20

/* Each step squares the difference of the two means: seven reach rounding from any wind that a double can tell from
 * 1.
 */
#define MEANS 7

/* Steps towards the slot while it is out of reach, and the time that remains when they end. */
#define APPROACHES 200
#define NEAR 0.01

/* The ground speed changes by no more than a factor exp(GROWTH) within a step. */
#define GROWTH 0.5

/* Steps after which the search for one word gives up: a circle of 10,000 turn radii takes fewer. */
#define MOST_STEPS 100000

/* Next to a double root a step is at least this long, radians: there the function is within rounding of zero. */
#define DOUBLE_ROOT 1e-08

/* Halvings, or better steps, that shrink a bracket to rounding. */
#define ROOT_STEPS 120

/* Where the last arc or a straight piece vanishes at a root of the excess, it is known to the cube root of this
 * times rounding: the excess of a last arc a is V a^3 / (6 k), k <= 1, and of the two words that meet there one has
 * V >= 1.
 */
#define EDGE 1000.0

/* What a search for a word with a straight piece gives up with before anything is found: it is earlier than all
 * others, so that these end too.
 */
static const Path GAVE_UP = {-INFINITY, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0};

/* The distance between the outer circles of LRL or RLR is known up to so many arc tolerances. */
#define THREE_ARCS 12.0

/* The reduced state (2) of a vehicle at (x, y), relative to the circle's centre, with the unit heading (c, s). */
static inline real_2 reduce(real x, real y, real c, real s) {
    return (real_2){x * c + y * s, y * c - x * s};
}

/* Whether `status_of` is OK: state and circle are within REACH, and the circle can be held. */
static inline bool is_solvable(real x, real y, real R, real tolerance) {
    const bool near = fabs(x) <= REACH && fabs(y) <= REACH && (0.0 <= tolerance && tolerance <= REACH);
    return near && (1.0 - ROUNDING <= R && R <= REACH);
}

/* R, or 1 where R is less than 1 by rounding only: a circle as tight as the aircraft can turn. */
static inline real rounded_radius(real R) {
    return 1.0 - ROUNDING <= R && R < 1.0 ? 1.0 : R;
}

/* `Status.OK`, or why there is nothing to solve. */
static inline integer synthesis_status_of(real x, real y, real R, real tolerance) {
    if (is_solvable(x, y, R, tolerance)) {
        return STATUS_OK;
    }
    if (!(isfinite(x) && isfinite(y) && isfinite(R))) {
        return STATUS_NOT_FINITE;
    }
    if (rounded_radius(R) < 1.0) {
        return STATUS_RADIUS_TOO_SMALL;
    }
    if (fabs(x) > REACH || fabs(y) > REACH || R > REACH) {
        return STATUS_OUT_OF_RANGE;
    }
    return STATUS_BAD_TOLERANCE;
}

/* The plain number of a member of `Word`, `Side` or `Status`, which Python answers in as compiled code does. */
static inline integer code(integer member) {
    return member + 0;
}

/* The side that is never slower: T_either(x, y) = T_cw(x, |y|) (paper, section 5); clockwise on y = 0. */
static inline integer near_side(real y) {
    return y < 0.0 ? -1 : 1;
}

/* The side itself; for *either*, the near side. */
static inline integer side_or_near(real y, integer side) {
    return side != SIDE_EITHER ? code(side) : near_side(y);
}

/* The length tolerance: the rounding error of lengths for a state and a circle of this size. */
static inline real rounding(real x, real y, real R) {
    return ROUNDING * (1.0 + fabs(x) + fabs(y) + R);
}

/* The share of the end-point tolerance that each of at most three pieces may use up. */
static inline real arc_tolerance_of(real x, real y, real R, real tolerance) {
    return max_real(tolerance, rounding(x, y, R)) / 3.0;
}

/* The rounded sum a + b, and its rounding error, exactly. */
static inline real_2 two_sum(real a, real b) {
    const real s = a + b;
    const real t = s - a;
    return (real_2){s, a - (s - t) + (b - t)};
}

/* A double as the sum of two of 26 digits. */
static inline real_2 split(real a) {
    const real c = SPLITTER * a;
    const real high = c - (c - a);
    return (real_2){high, a - high};
}

/* The rounded product a b, and its rounding error, exactly for |a|, |b| < 2^480. */
static inline real_2 two_product(real a, real b) {
    const real p = a * b;
    const real_2 split_1 = split(a);
    const real ah = split_1.a0, al = split_1.a1;
    const real_2 split_2 = split(b);
    const real bh = split_2.a0, bl = split_2.a1;
    return (real_2){p, ah * bh - p + ah * bl + al * bh + al * bl};
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
    const real_2 two_sum_1 = two_sum(y, R - 2.0);
    const real s = two_sum_1.a0, es = two_sum_1.a1;
    const real_2 two_sum_2 = two_sum(y, 2.0 - R);
    real t = two_sum_2.a0;
    const real et = two_sum_2.a1;
    const real_2 two_sum_3 = two_sum(t, 2.0);
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
    const real_2 two_sum_14 = two_sum(u, -8.0 * (R - 1.0));
    const real f = two_sum_14.a0, ef = two_sum_14.a1;
    const real_2 two_sum_15 = two_sum(u, -4.0 * s);
    const real g = two_sum_15.a0, eg = two_sum_15.a1;
    return (real_3){f + (ef + d), g + (eg + d - 4.0 * es), u + d + low};
}

/* The start at a reduced state. */
static inline Start start_at(real x, real y, real R, real arc_tolerance) {
    const real_3 beyond_circles_1 = beyond_circles(x, y, R);
    const real outer = beyond_circles_1.a0, inner = beyond_circles_1.a1, fold = beyond_circles_1.a2;
    return (Start){x, y, R, arc_tolerance, outer, inner, fold};
}

/* The rotation, or that by zero where it is less than a full turn by at most `arc_tolerance` of arc length.
 *
 * `radius2` is the square of the radius of the arc. Leaving out the full turn moves the end point by at most
 * `arc_tolerance`; it removes the jump of T that rounding or noise would cause where an arc vanishes
 * (docs/theory.md, section 6). The missing angle is replaced by its tangent, which is no smaller.
 */
static inline real_2 snap_full_turn(real_2 rotated, real radius2, real arc_tolerance) {
    const real cross = rotated.a0, dot = rotated.a1;
    const bool nearly_full = (cross < 0.0 && 0.0 < dot) && cross * cross * radius2 <= arc_tolerance * arc_tolerance
            * dot * dot;
    return (real_2){nearly_full ? 0.0 : rotated.a0, nearly_full ? dot : rotated.a1};
}

/* The rotation of a left turn from (x, y) to the point (end c, 0) of the axis y = 0, end = -1 or +1; and c.
 *
 * c is sqrt(rp^2 - 1), or -1 where the turn never meets the axis (rp < 1). A right turn is the mirror image: pass
 * -y. The cross product is end (c y + c - end x); where end x > 0, c - end x = y (y + 2) / (c + end x), so the
 * rotation has exactly the sign of y.
 */
static inline real_2_real onto_axis(real x, real y, real end_, real arc_tolerance) {
    const real rise = y * (y + 2.0);
    const real c2 = x * x + rise;
    const real c = sqrt(max_real(c2, 0.0));
    const real along = end_ * x;
    /* Both products are multiplied by c + along where that is safe, which saves a division. */
    const real scale = along > SMALLEST_SCALE ? c + along : 1.0;
    const real gap = along > SMALLEST_SCALE ? rise : c - along;
    const real_2 products = (real_2){end_ * (c * y * scale + gap), (c * along + y + 1.0) * scale};
    return (real_2_real){snap_full_turn(products, c2 + 1.0, arc_tolerance), c2 >= 0.0 ? c : -1.0};
}

/* LSL: onto the axis at (-c, 0), straight to (-X, 0), X = sqrt(R (R + 2)), left for acos(1/(R + 1)).
 *
 * `y` is the ordinate of the start, with the opposite sign for RSL. `joins` says whether c >= X, decided as in the
 * selection of words; rounding may still make c - X negative.
 */
static inline Extremal external_join(integer word, real y, Start start, bool joins) {
    const real R = start.R;
    const real_2_real onto_axis_1 = onto_axis(start.x, y, -1.0, start.arc_tolerance);
    const real_2 first = onto_axis_1.a0;
    const real c = onto_axis_1.a1;
    const real X = sqrt(R * (R + 2.0));
    return (Extremal){word, first, joins ? max_real(c - X, 0.0) : INFINITY, NO_ROTATION, (real_2){X, 1.0}};
}

/* Right, straight, left, rm >= R + 1: the first arc is the mirror image of that of LSL. */
static inline Extremal rsl(Start start) {
    return external_join(WORD_RSL, -start.y, start, start.inner >= 4.0 * start.R);
}

/* (R + 3)^2 - rm^2: not negative where the circle of R meets the last circle of L, so where RL exists.
 *
 * It is 4 (R + y + 2) - `outer`, and not computed as 8 (R + 1) - `inner`: next to (0, -R - 2), where it vanishes
 * and RL is the fastest, neither term is negative, so that no digits are lost. T varies with its square root.
 */
static inline real within_reach(Start start) {
    return 4.0 * (start.R + start.y + 2.0) - start.outer;
}

/* The squared distance from (0, centre), accurate even near zero; computed from `beyond` it would lose digits. */
static inline real squared_distance(real x, real y, real centre) {
    return x * x + (y - centre) * (y - centre);
}

/* The counter-clockwise rotation from direction (ax, ay) to (bx, by); by zero where one of them is zero. */
static inline real_2 rotation(real ax, real ay, real bx, real by) {
    return (real_2){ax * by - ay * bx, ax * bx + ay * by + TINY};
}

/* RL: right to the crossing with the last circle (R + 1 about (0, -1)) where x1 has `branch`'s sign; then left.
 *
 * The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = `inner` = rm^2 - (R - 1)^2 and p = `within_reach`
 * = (R + 3)^2 - rm^2.
 */
static inline Extremal rl(Start start, real branch) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, inner = start.inner;
    const real p = within_reach(start);
    const real x1 = branch * 0.25 * sqrt(max_real(p * inner, 0.0));
    const real radius2 = squared_distance(x, y, 1.0);
    const real_2 first = snap_full_turn(rotation(x, y - 1.0, x1, R - 1.0 - 0.25 * inner), radius2, arc_tolerance);
    const real_2 last = snap_full_turn((real_2){-x1, R + 1.0 - 0.25 * inner}, (R + 1.0) * (R + 1.0), arc_tolerance);
    return (Extremal){WORD_RL, first, inner >= 0.0 && p >= 0.0 ? 0.0 : INFINITY, last, NO_ROTATION};
}

/* Extremal a where the condition holds, otherwise b; compiled code has `compiled.branchless.select` instead. */
static inline Extremal extremals_select(bool condition, Extremal a, Extremal b) {
    return condition ? a : b;
}

/* LSR, R >= 2: onto the axis at (c, 0), straight to (X, 0), X = sqrt(R (R - 2)), right for pi - acos(1/(R - 1)).
 *
 * `y` as in `external_join`, with the opposite sign for RSR; `joins` says whether c <= X.
 */
static inline Extremal internal_join(integer word, real y, Start start, bool joins) {
    const real R = start.R;
    const real_2_real onto_axis_1 = onto_axis(start.x, y, 1.0, start.arc_tolerance);
    const real_2 first = onto_axis_1.a0;
    const real c = onto_axis_1.a1;
    const real X = sqrt(max_real(R * (R - 2.0), 0.0));
    const real straight = R >= 2.0 && c >= 0.0 && joins ? max_real(X - c, 0.0) : INFINITY;
    return (Extremal){word, first, straight, NO_ROTATION, (real_2){X, -1.0}};
}

/* Right, straight, right, rm <= R - 1: the first arc is the mirror image of that of LSR. */
static inline Extremal rsr(Start start) {
    return internal_join(WORD_RSR, -start.y, start, start.inner <= 0.0);
}

/* Of the extremals of several pieces that begin with R, the one that can win, by rm; see `left_first`. */
static inline Extremal right_first(Start start) {
    Extremal best = extremals_select(start.inner > 4.0 * start.R, rsl(start), rl(start, -1.0));
    if (start.y < 0.0) {
        best = extremals_select(start.inner < 0.0, rsr(start), best);
    }
    return best;
}

/* Whether a point is within a distance of a circle; `beyond2`: squared distance from the centre less radius^2. */
static inline bool is_near_circle(real beyond2, real radius, real distance) {
    const real inwards = min_real(distance, radius);
    return -inwards * (2.0 * radius - inwards) <= beyond2 && beyond2 <= distance * (2.0 * radius + distance);
}

/* Right along the circle of radius R - 1 about (0, 1), from within `arc_tolerance` of it: the limit of LR. */
static inline Extremal extremals_r(Start start) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, inner = start.inner;
    const real_2 first = snap_full_turn((real_2){x, y - 1.0}, (R - 1.0) * (R - 1.0), arc_tolerance);
    const real straight = R > 1.0 && is_near_circle(inner, R - 1.0, arc_tolerance) ? 0.0 : INFINITY;
    return (Extremal){WORD_R, first, straight, NO_ROTATION, NO_ROTATION};
}

/* The difference a^2 - b with nearly full relative accuracy even near zero, for |a| < 2^480. */
static inline real square_beyond(real a, real b) {
    const real_2 two_product_1 = two_product(a, a);
    const real p = two_product_1.a0, e = two_product_1.a1;
    return p - b + e;
}

/* `gap` and v of the quadratic 3 w^2 - 2 gap w + v = 0 of `lrl`. */
static inline real_2 lrl_quadratic(Start start) {
    const real R = start.R, outer = start.outer, fold = start.fold;
    const real gap = -0.5 * fold - square_beyond(R - 1.0, 3.0);
    const real v = -0.0625 * fold * (8.0 * (R + 3.0) - outer);
    return (real_2){gap, v};
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
static inline Extremal lrl(Start start) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, outer = start.outer, fold
            = start.fold;
    const real k = x * x + y * (y + 2.0), d = -0.25 * outer;
    const real_2 lrl_quadratic_1 = lrl_quadratic(start);
    const real gap = lrl_quadratic_1.a0, v = lrl_quadratic_1.a1;
    const real D = gap * gap - 3.0 * v;
    const bool exists = R <= 3.0 && fold <= 0.0 && D >= 0.0 && gap > 0.0;
    const real root = sqrt(max_real(D, 0.0));
    const real above = 6.0 - gap + root, below = exists ? gap + root : 1.0;
    const real share = 1.0 / (above * below);
    const real w = v * above * share;
    const real a = 6.0 * below * share;
    const real m = sqrt(max_real(0.5 * a * w, 0.0));
    /* ya = k/q; every vector is multiplied by q. */
    const real q = 1.0 + sqrt(max_real(1.0 + a * k, 0.0));
    const real ya = k, yb = k + d * q;
    const real xa = m * ya, xb = -m * yb;
    const real_2 first = snap_full_turn(rotation(xa, ya + q, x, y + 1.0), squared_distance(x, y, -1.0),
            arc_tolerance);
    /* ya - 1 and yb - 1 from the quantities that make them small: at R = 1 both vanish on the last arc. */
    const real_2 middle = rotation(xa, -0.5 * (w + d) * q, xb, -0.5 * (w - d) * q);
    const real_2 last = (real_2){-xb, yb + q};
    return (Extremal){WORD_LRL, first, exists ? 0.0 : INFINITY, middle, last};
}

/* Left, straight, right, from inside a circle of R >= 2: rp <= R - 1, that is rp^2 - (R - 3)^2 <= 4 (R - 2). */
static inline Extremal lsr(Start start) {
    return internal_join(WORD_LSR, start.y, start, start.fold <= 4.0 * (start.R - 2.0));
}

/* Whether an extremal ends at the target. */
static inline bool reaches(Extremal extremal) {
    return extremal.straight < INFINITY;
}

/* LR, R > 1: left to the crossing with the circle (R - 1 about (0, 1)) where x1 has `branch`'s sign; then right.
 *
 * The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = -`outer` = (R + 1)^2 - rp^2, p = `fold` = rp^2 -
 * (R - 3)^2. So y1 + 1 is R + 1 - q/4 or 3 - R + p/4, and y1 - 1 is R - 1 - q/4: those forms are used whose terms
 * are no longer than the arc's radius, however small that is.
 */
static inline Extremal lr(Start start, real branch) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, outer = start.outer, fold
            = start.fold;
    const real x1 = branch * 0.25 * sqrt(max_real(-outer * fold, 0.0));
    const real radius2 = squared_distance(x, y, -1.0);
    const real_2 first = snap_full_turn(rotation(x1, 3.0 - R + 0.25 * fold, x, y + 1.0), radius2, arc_tolerance);
    const real_2 last = snap_full_turn((real_2){x1, R - 1.0 + 0.25 * outer}, (R - 1.0) * (R - 1.0), arc_tolerance);
    return (Extremal){WORD_LR, first, R > 1.0 && outer <= 0.0 && fold >= 0.0 ? 0.0 : INFINITY, last, NO_ROTATION};
}

/* Left, straight along the line through the centre, left: rp >= R + 1. */
static inline Extremal lsl(Start start) {
    return external_join(WORD_LSL, start.y, start, start.outer >= 0.0);
}

/* Of the extremals of several pieces that begin with L, the one that can win (docs/theory.md, section 4).
 *
 * It is determined by rp. `detour` gives the other crossing of LR, which is not considered here.
 */
static inline Extremal left_first(Start start) {
    Extremal best = lrl(start);
    if (start.R > 1.0) {
        Extremal inside = lsr(start);
        inside = extremals_select(reaches(inside), inside, lr(start, 1.0));
        best = extremals_select(start.fold <= 0.0 && start.R <= 3.0, best, inside);
    }
    if (start.y < 0.0) {
        best = extremals_select(start.outer >= 0.0, lsl(start), best);
    }
    return best;
}

/* Left along the last circle, radius R + 1 about (0, -1), from within `arc_tolerance` of it: the limit of RL. */
static inline Extremal extremals_l(Start start) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, outer = start.outer;
    const real_2 first = snap_full_turn((real_2){-x, y + 1.0}, (R + 1.0) * (R + 1.0), arc_tolerance);
    const real straight = is_near_circle(outer, R + 1.0, arc_tolerance) ? 0.0 : INFINITY;
    return (Extremal){WORD_L, first, straight, NO_ROTATION, NO_ROTATION};
}

/* Whether the angle of a rotation is in [0, pi]. */
static inline bool is_at_most_half_turn(real_2 rotated) {
    const real cross = rotated.a0;
    return cross >= 0.0;
}

/* Whether a single arc replaces the words of which it is the limit: of at most half a turn, or of any length. */
static inline bool is_limit(Extremal arc, bool any_length) {
    return reaches(arc) && (is_at_most_half_turn(arc.first) || any_length);
}

/* The rotation, less half a turn where it is half a turn or more, and the count `halves` of these half turns. */
static inline real_3 fold_half_turn(real_2 rotated, real halves) {
    const real cross = rotated.a0, dot = rotated.a1;
    if (cross < 0.0 || (cross == 0.0 && dot < 0.0)) {
        return (real_3){-cross, -dot, halves + 1.0};
    }
    return (real_3){cross, dot, halves};
}

/* The sum of the angles of three rotations, in [0, 6 pi], with one arctangent.
 *
 * Multiplying the vectors as complex numbers adds their angles. Each is first folded below pi, so that two of them
 * make less than a full turn and no whole turn is lost.
 */
static inline real total_angle(real_2 first, real_2 second, real_2 third) {
    const real_3 fold_half_turn_1 = fold_half_turn(first, 0.0);
    const real c1 = fold_half_turn_1.a0, d1 = fold_half_turn_1.a1;
    real halves = fold_half_turn_1.a2;
    const real_3 fold_half_turn_2 = fold_half_turn(second, halves);
    const real c2 = fold_half_turn_2.a0, d2 = fold_half_turn_2.a1;
    halves = fold_half_turn_2.a2;
    const real_3 fold_half_turn_3 = fold_half_turn((real_2){c1 * d2 + d1 * c2, d1 * d2 - c1 * c2}, halves);
    real c = fold_half_turn_3.a0, d = fold_half_turn_3.a1;
    halves = fold_half_turn_3.a2;
    const real_3 fold_half_turn_4 = fold_half_turn(third, halves);
    const real c3 = fold_half_turn_4.a0, d3 = fold_half_turn_4.a1;
    halves = fold_half_turn_4.a2;
    const real_3 fold_half_turn_5 = fold_half_turn((real_2){c * d3 + d * c3, d * d3 - c * c3}, halves);
    c = fold_half_turn_5.a0;
    d = fold_half_turn_5.a1;
    halves = fold_half_turn_5.a2;
    return 3.141592653589793 * halves + atan2(c, d);
}

/* T, the whole time of an extremal; `inf` where it does not reach the target. */
static inline real extremals_duration(Extremal extremal) {
    return extremal.straight + total_angle(extremal.first, extremal.middle, extremal.last);
}

/* The least time so far and its extremal, or those of another extremal that takes less. */
static inline real_Extremal faster_of(real least, Extremal best, Extremal other) {
    const real time = extremals_duration(other);
    return (real_Extremal){time < least ? time : least, extremals_select(time < least, other, best)};
}

/* The only RL or LR with the other crossing that can win, for y < 0: its first arc ends before the axis. */
static inline Extremal detour(Start start) {
    return extremals_select(start.inner > 4.0 * start.R, rl(start, 1.0), lr(start, -1.0));
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
static inline real_Extremal extremals_fastest(real x, real y, real R, real arc_tolerance, bool exact) {
    const Start start = start_at(x, y, R, arc_tolerance);
    Extremal right = right_first(start);
    const Extremal only_right = extremals_r(start);
    Extremal left = left_first(start);
    const Extremal only_left = extremals_l(start);
    if (exact) {
        left = extremals_select(is_limit(only_left, y <= 0.0), only_left, left);
        right = extremals_select(is_limit(only_right, y <= 0.0 || start.outer <= 0.0), only_right, right);
    }
    Extremal best;
    if (exact && R == 1.0 && !(y < 0.0)) {
        best = extremals_select(reaches(left) && is_at_most_half_turn(left.first), left, right);
        return (real_Extremal){extremals_duration(best), best};
    }
    const real_Extremal faster_of_1 = faster_of(extremals_duration(right), right, left);
    real least = faster_of_1.a0;
    best = faster_of_1.a1;
    if (y < 0.0) {
        const real_Extremal faster_of_2 = faster_of(least, best, detour(start));
        least = faster_of_2.a0;
        best = faster_of_2.a1;
    }
    if (!exact) {
        const real_Extremal faster_of_3 = faster_of(least, best, only_left);
        least = faster_of_3.a0;
        best = faster_of_3.a1;
        const real_Extremal faster_of_4 = faster_of(least, best, only_right);
        least = faster_of_4.a0;
        best = faster_of_4.a1;
    }
    return (real_Extremal){least, best};
}

/* The angle of a counter-clockwise rotation, in [0, 2 pi]; that of a clockwise one is `angle((-cross, dot))`.
 *
 * One arctangent has an error of about one rounding of the angle itself; a difference of two arctangents would lose
 * the digits of a small rotation.
 */
static inline real angle(real_2 rotated) {
    const real cross = rotated.a0, dot = rotated.a1;
    const real turned = atan2(cross, dot);
    /* + 0.0 turns -0.0 into 0.0, so that no duration has a negative sign. */
    return turned < 0.0 ? turned + TWO_PI : turned + 0.0;
}

/* The durations of the pieces in flying order, 0 past the last. */
static inline real_3 durations(Extremal extremal) {
    return (real_3){angle(extremal.first), extremal.straight + angle(extremal.middle), angle(extremal.last)};
}

/* The controls of the three pieces of a word, `ABSENT` past its last. */
static inline integer_3 controls(integer word) {
    return (integer_3){(word & 3) - 2, ((word >> 2) & 3) - 2, ((word >> 4) & 3) - 2};
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
            t2 = 0.0;
            t3 = 0.0;
        } else {
            word = encode(first, last, -2);
            t2 = t3;
            t3 = 0.0;
        }
    }
    const integer_3 controls_2 = controls(word);
    first = controls_2.a0;
    const integer second = controls_2.a1, third = controls_2.a2;
    if (second != ABSENT && third == ABSENT && t2 <= no_angle) {
        word = encode(first, -2, -2);
        t2 = 0.0;
    }
    if (t1 <= no_angle) {
        word = rest(word);
        t1 = t2;
        t2 = t3;
        t3 = 0.0;
    }
    return (integer_real_3){word, t1, t2, t3};
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
static inline Entry flown_entry(Extremal extremal, real length_tolerance, integer side) {
    const real_3 durations_1 = durations(extremal);
    real t1 = durations_1.a0, t2 = durations_1.a1, t3 = durations_1.a2;
    const integer_real_3 drop_short_pieces_2 = drop_short_pieces(code(extremal.word), t1, t2, t3, length_tolerance /
            3.0, ROUNDING / 3.0);
    const integer word = drop_short_pieces_2.a0;
    t1 = drop_short_pieces_2.a1;
    t2 = drop_short_pieces_2.a2;
    t3 = drop_short_pieces_2.a3;
    return (Entry){side, side < 0 ? mirrored(word) : word, t1, t2, t3};
}

/* The fastest maneuver onto the circle held on one side. */
static inline Entry optimum_on_side(real x, real y, real R, integer side, real tolerance) {
    const real_Extremal fastest_1 = extremals_fastest(x, (real)side * y, R, arc_tolerance_of(x, y, R, tolerance),
            tolerance == 0.0);
    const Extremal best = fastest_1.a1;
    return flown_entry(best, rounding(x, y, R), side);
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
    if (side != SIDE_EITHER || tolerance == 0.0) {
        return near;
    }
    const Entry far = optimum_on_side(x, y, R, -near_side(y), tolerance);
    return is_faster(far, near, rounding(x, y, R)) ? far : near;
}

/* T of `optimum_on_side`, without its pieces; a piece that is too short to be flown may be included. */
static inline real least_time(real x, real y, real R, integer side, real tolerance) {
    const real_Extremal fastest_1 = extremals_fastest(x, (real)side * y, R, arc_tolerance_of(x, y, R, tolerance),
            tolerance == 0.0);
    const real time = fastest_1.a0;
    return time;
}

/* Feedback law: the first control of a maneuver; at the target the rate -1/R or 1/R that holds the circle. */
static inline real first_control(real R, Entry maneuver) {
    const integer_3 controls_1 = controls(maneuver.word);
    const integer first = controls_1.a0;
    return first != ABSENT ? (real)first : (real)-maneuver.side / R;
}

/* The state after a time t with control u, by (7): turned about (0, -u), or shifted along x for u = 0. */
static inline real_2 flow(real x, real y, integer u, real t) {
    if (u == 0) {
        return (real_2){x + t, y};
    }
    const real w = (real)u * y + 1.0;
    const real ce = cos(t), se = sin(t);
    return (real_2){x * ce + w * se, (real)u * (w * ce - x * se - 1.0)};
}

/* The length of a vector whose square neither overflows nor underflows.
 *
 * Unlike `math.hypot`, whose algorithm is Python's own, compiled code gives the same value to the last bit.
 */
static inline real length(real x, real y) {
    return sqrt(x * x + y * y);
}

/* The distance from the target, in the reduced plane, at which a maneuver from (x, y) ends when flown exactly. */
static inline real miss(real x, real y, real R, Entry maneuver) {
    const integer side = maneuver.side, word = maneuver.word;
    const real t1 = maneuver.t1, t2 = maneuver.t2, t3 = maneuver.t3;
    const integer_3 controls_1 = controls(word);
    const integer each_u_1[3] = {controls_1.a0, controls_1.a1, controls_1.a2};
    const real each_t_1[3] = {t1, t2, t3};
    for (int i_1 = 0; i_1 < 3; i_1++) {
        const integer u = each_u_1[i_1];
        const real t = each_t_1[i_1];
        if (u != ABSENT) {
            const real_2 flow_2 = flow(x, y, u, t);
            x = flow_2.a0;
            y = flow_2.a1;
        }
    }
    return length(x, y - (real)side * R);
}

/* Position (x, y) and unit velocity (c, s) after a time t with control u: the exact flow of (1).
 *
 * The displacement is the chord of the arc, 2 sin(t/2) long, along the velocity at half time. This avoids the
 * difference of two nearly equal sines for short arcs.
 */
static inline real_4 fly(real x, real y, real c, real s, integer u, real t) {
    const real half = 0.5 * (real)u * t;
    const real ch = cos(half), sh = sin(half);
    const real chord = u != 0 ? 2.0 * sin(0.5 * t) : t;
    const real ce = cos((real)u * t), se = sin((real)u * t);
    return (real_4){x + chord * (c * ch - s * sh), y + chord * (s * ch + c * sh), c * ce - s * se, s * ce + c * se};
}

/* The adjoint psi after a time t (before, if t < 0) with control u: the exact flow of the dual system (12). */
static inline real_2 turn_adjoint(real psi1, real psi2, integer u, real t) {
    /* psi is the constant adjoint of the position in axes along the course, so it turns opposite to the course. */
    const real_4 fly_1 = fly(0.0, 0.0, psi1, psi2, -u, t);
    psi1 = fly_1.a2;
    psi2 = fly_1.a3;
    return (real_2){psi1, psi2};
}

/* The adjoint at a state (x, y) where phi = 0 and the next control is u.
 *
 * psi is parallel to (x, y). Its sign follows from psi1 = lambda >= 0, and also from phi' = -psi2, which has the
 * sign of u. The two agree on an optimum; the larger component of (x, y) decides, so that rounding of the smaller
 * one has no effect. At the centre any psi is possible: (1, 0) is chosen, that of the straight piece.
 */
static inline Adjoint at_switch(real x, real y, integer u, real R) {
    real r = length(x, y);
    if (r <= rounding(x, y, R)) {
        return (Adjoint){1.0, 1.0, 0.0};
    }
    const bool backwards = fabs(x) > fabs(y) ? x < 0.0 : (real)u * y > 0.0;
    if (backwards) {
        r = -r;
    }
    return (Adjoint){x / r, x / r, y / r};
}

/* The adjoint at the start (x, y) of a single arc onto the circle, chosen as described at the top. */
static inline Adjoint of_single_arc(real x, real y, real R, Entry maneuver) {
    const integer_3 controls_1 = controls(maneuver.word);
    const integer u = controls_1.a0;
    const real_2_real onto_axis_2 = onto_axis(x, (real)u * y, -1.0 * (real)u * (real)maneuver.side, 0.0);
    const real_2 to_axis = onto_axis_2.a0;
    const real c = onto_axis_2.a1;
    if (c >= 0.0 && angle(to_axis) < maneuver.t1) {
        const real_2 turn_adjoint_3 = turn_adjoint(1.0, 0.0, u, -angle(to_axis));
        const real psi1 = turn_adjoint_3.a0, psi2 = turn_adjoint_3.a1;
        return (Adjoint){1.0, psi1, psi2};
    }
    const Adjoint start = at_switch(x, y, u, R);
    /* Past half a turn of the small circle lambda would be negative; there lambda = 0 is the nearest possible value. */
    return start.lam < 0.0 ? (Adjoint){0.0, 0.0, -1.0 * (real)u} : start;
}

/* The adjoint at the start of a word of two or three arcs, from the last switch between L and R. */
static inline Adjoint of_arcs(real R, Entry maneuver) {
    const integer side = maneuver.side, word = maneuver.word;
    const real t1 = maneuver.t1, t2 = maneuver.t2, t3 = maneuver.t3;
    const integer_3 controls_1 = controls(word);
    const integer first = controls_1.a0, second = controls_1.a1, third = controls_1.a2;
    real x, y, lam, psi1, psi2;
    if (third == ABSENT) {
        const real_2 flow_2 = flow(0.0, (real)side * R, second, -t2);
        x = flow_2.a0;
        y = flow_2.a1;
        const Adjoint at_switch_3 = at_switch(x, y, second, R);
        lam = at_switch_3.lam;
        psi1 = at_switch_3.psi1;
        psi2 = at_switch_3.psi2;
    } else {
        const real_2 flow_4 = flow(0.0, (real)side * R, third, -t3);
        x = flow_4.a0;
        y = flow_4.a1;
        const Adjoint at_switch_5 = at_switch(x, y, third, R);
        lam = at_switch_5.lam;
        psi1 = at_switch_5.psi1;
        psi2 = at_switch_5.psi2;
        const real_2 turn_adjoint_6 = turn_adjoint(psi1, psi2, second, -t2);
        psi1 = turn_adjoint_6.a0;
        psi2 = turn_adjoint_6.a1;
    }
    const real_2 turn_adjoint_7 = turn_adjoint(psi1, psi2, first, -t1);
    psi1 = turn_adjoint_7.a0;
    psi2 = turn_adjoint_7.a1;
    return (Adjoint){lam, psi1, psi2};
}

/* Lambda and psi at the start of an extremal from (x, y) onto the circle; |psi| = 1.
 *
 * nan for the empty word, which has no controls. A word that is not an extremal also gets a psi, the one that its
 * last switch requires; it then violates one of (13)-(16).
 */
static inline Adjoint adjoint(real x, real y, real R, Entry maneuver) {
    const integer_3 controls_1 = controls(maneuver.word);
    const integer first = controls_1.a0, second = controls_1.a1;
    if (first == ABSENT) {
        return (Adjoint){NAN, NAN, NAN};
    }
    if (second == ABSENT) {
        return of_single_arc(x, y, R, maneuver);
    }
    if (first == 0) {
        return (Adjoint){1.0, 1.0, 0.0};
    }
    if (second == 0) {
        const real_2 turn_adjoint_2 = turn_adjoint(1.0, 0.0, first, -maneuver.t1);
        const real psi1 = turn_adjoint_2.a0, psi2 = turn_adjoint_2.a1;
        return (Adjoint){1.0, psi1, psi2};
    }
    return of_arcs(R, maneuver);
}

/* A component over lambda; infinite where lambda is 0, a division that Python would refuse. */
static inline real quotient(real a, real lam) {
    if (lam != 0.0) {
        return a / lam;
    }
    return a > 0.0 ? INFINITY : a < 0.0 ? -INFINITY : NAN;
}

/* The gradient of the time of an extremal from (x, y) onto the circle.
 *
 * nan for the empty word; infinite, and of no use, where lambda = 0: there T has a vertical tangent.
 */
static inline ValueGradient value_gradient(real x, real y, real R, Entry maneuver) {
    const Adjoint adjoint_1 = adjoint(x, y, R, maneuver);
    const real lam = adjoint_1.lam, psi1 = adjoint_1.psi1, psi2 = adjoint_1.psi2;
    const integer_3 controls_2 = controls(maneuver.word);
    const integer u1 = controls_2.a0, u2 = controls_2.a1, u3 = controls_2.a2;
    if (u1 == ABSENT) {
        return (ValueGradient){NAN, NAN, NAN};
    }
    const real_2 turn_adjoint_3 = turn_adjoint(psi1, psi2, u1, maneuver.t1);
    real end1 = turn_adjoint_3.a0, end2 = turn_adjoint_3.a1;
    if (u2 != ABSENT) {
        const real_2 turn_adjoint_4 = turn_adjoint(end1, end2, u2, maneuver.t2);
        end1 = turn_adjoint_4.a0;
        end2 = turn_adjoint_4.a1;
    }
    if (u3 != ABSENT) {
        const real_2 turn_adjoint_5 = turn_adjoint(end1, end2, u3, maneuver.t3);
        end1 = turn_adjoint_5.a0;
        end2 = turn_adjoint_5.a1;
    }
    return (ValueGradient){quotient(-psi1, lam), quotient(-psi2, lam), quotient((real)maneuver.side * end2, lam)};
}

/* The least R of a circle that can be held all round: the rate of turn is largest downwind, (1 + |w|)^2 / R. */
static inline real tightest_radius(real wx, real wy) {
    const real fastest = 1.0 + length(wx, wy);
    return fastest * fastest;
}

/* `Status.OK`, or why there is nothing to solve. */
static inline integer wind_search_status_of(WindProblem problem) {
    const real x = problem.x, y = problem.y, c = problem.c, s = problem.s, R = problem.R, wx = problem.wx, wy =
            problem.wy, tolerance = problem.tolerance;
    if (!(isfinite(x + y) && isfinite(c + s) && isfinite(R) && isfinite(wx + wy))) {
        return code(STATUS_NOT_FINITE);
    }
    if (length(wx, wy) >= 1.0) {
        return code(STATUS_WIND_TOO_STRONG);
    }
    if (tightest_radius(wx, wy) * (1.0 - ROUNDING) > R) {
        return code(R >= 1.0 ? STATUS_NOT_HELD : STATUS_RADIUS_TOO_SMALL);
    }
    if (fabs(x) > REACH || fabs(y) > REACH || R > REACH) {
        return code(STATUS_OUT_OF_RANGE);
    }
    return code(0.0 <= tolerance && tolerance <= REACH ? STATUS_OK : STATUS_BAD_TOLERANCE);
}

/* The result where there is no maneuver. */
static inline WindEntry no_entry(integer status) {
    return (WindEntry){status, 0, 0, NAN, NAN, NAN, NAN, NAN};
}

/* The scene of a problem, with the arc tolerance that rounding requires; negligible wind is treated as zero. */
static inline WindScene scene_of(WindProblem problem) {
    const real x = problem.x, y = problem.y, c = problem.c, s = problem.s, R = problem.R;
    real wx = problem.wx, wy = problem.wy;
    if (length(wx, wy) < NEGLIGIBLE_WIND) {
        wx = 0.0;
        wy = 0.0;
    }
    return (WindScene){x, y, c, s, R, wx, wy, rounding(x, y, R) / 3.0};
}

/* The direction of the wind as a unit vector; (1, 0) in still air, and in a wind too light to have one. */
static inline real_2 downwind(real wx, real wy) {
    const real wind = length(wx, wy);
    const bool chosen_1 = wind >= NEGLIGIBLE_WIND;
    return (real_2){chosen_1 ? wx / wind : 1.0, chosen_1 ? wy / wind : 0.0};
}

/* The rotation of the arc of control u = +1 or -1 that takes the heading (ax, ay) to (bx, by). */
static inline real_2 arc_rotation(integer u, real ax, real ay, real bx, real by) {
    const real_2 rotation_1 = rotation(ax, ay, bx, by);
    const real cross = rotation_1.a0, dot = rotation_1.a1;
    return (real_2){(real)u * cross, dot};
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
    const real a = -cos(phase), b = (real)side * sin(phase);
    const real tx = a * dx - b * dy, ty = a * dy + b * dx;
    const real nx = (real)-side * ty, ny = (real)side * tx;
    const real out = wx * nx + wy * ny;
    const real crab = sqrt((1.0 - out) * (1.0 + out));
    return (real_5){R * nx, R * ny, crab * tx - out * nx, crab * ty - out * ny, crab + wx * tx + wy * ty};
}

/* The distance of the start from a point of joining, where an angle between the headings counts R times. */
static inline real hold_miss(real phase, integer side, WindScene scene) {
    const real_5 hold_pose_1 = hold_pose(phase, side, scene.R, scene.wx, scene.wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, ce = hold_pose_1.a2, se = hold_pose_1.a3;
    return length(length(px - scene.x, py - scene.y), scene.R * length(ce - scene.c, se - scene.s));
}

/* The distance of the end of a maneuver, flown exactly, from a point of joining: position and heading together. */
static inline real end_miss(Entry entry, real phase, WindScene scene) {
    real x = scene.x, y = scene.y, c = scene.c, s = scene.s;
    const real R = scene.R, wx = scene.wx, wy = scene.wy;
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
static inline EntryBeside faster_beside(EntryBeside a, EntryBeside b, real tolerance) {
    return b.miss <= tolerance && (0.0 <= b.entry.t1 && b.entry.t1 < min_real(a.entry.t1, TWO_PI)) ? b : a;
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
static inline Entry_real fit_one_arc(Entry arc, real phase, WindScene scene) {
    const real x = scene.x, y = scene.y, c = scene.c, s = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy,
            arc_tolerance = scene.arc_tolerance;
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
        if (bend == 0.0) {
            break;
        }
        const real later = (atan2(c1 * se - s1 * ce, c1 * ce + s1 * se) - (real)u * longer) / bend;
        t = t + longer + later;
        phase = phase + later * g / R;
        if (fabs(longer) + fabs(later) <= arc_tolerance) {
            break;
        }
    }
    return (Entry_real){(Entry){side, word, t, 0.0, 0.0}, phase};
}

/* The arc of control u next to an approximation that ends abreast of the circle, with the heading of the hold. */
static inline EntryBeside arc_beside(integer u, real t, real phase, integer side, WindScene scene) {
    const Entry_real fit_one_arc_1 = fit_one_arc((Entry){side, encode(u, -2, -2), t, 0.0, 0.0}, phase, scene);
    const Entry entry = fit_one_arc_1.a0;
    phase = fit_one_arc_1.a1;
    return (EntryBeside){entry, phase, end_miss(entry, phase, scene)};
}

/* The end of the arc of control u that ends with the heading of a point of joining. */
static inline ArcEnd arc_end(integer u, real phase, integer side, WindScene scene) {
    const real x = scene.x, y = scene.y, c = scene.c, s = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy;
    const real_5 hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, ce = hold_pose_1.a2, se = hold_pose_1.a3, g =
            hold_pose_1.a4;
    const real t = angle(arc_rotation(u, c, s, ce, se));
    const real_4 fly_2 = fly(x, y, c, s, u, t);
    const real x1 = fly_2.a0, y1 = fly_2.a1;
    const real rx = px - x1 - wx * t, ry = py - y1 - wy * t;
    return (ArcEnd){t, (rx * (ce + wx) + ry * (se + wy)) / g};
}

/* The faster of `best` and the arcs of the control u between `ARC_SAMPLES` points of joining. */
static inline EntryBeside fastest_arc_beside(EntryBeside best, integer u, integer side, real tolerance, WindScene
        scene) {
    ArcEnd before = arc_end(u, 0.0, side, scene);
    const integer last_1 = ARC_SAMPLES + 1;
    for (integer i = 1; i < last_1; i++) {
        const real phase = TWO_PI / (real)ARC_SAMPLES * (real)i;
        const ArcEnd after = arc_end(u, phase, side, scene);
        /* Where the heading of the start lies between those of two points, one of the two arcs is almost a whole turn. */
        if ((before.short_ <= 0.0 && 0.0 <= after.short_) && fabs(after.t - before.t) < 3.141592653589793) {
            best = faster_beside(best, arc_beside(u, after.t, phase, side, scene), tolerance);
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
static inline EntryBeside entry_beside(integer sides, real tolerance, WindScene scene) {
    EntryBeside best = NO_ENTRY_BESIDE;
    const integer each_side_1[2] = {1, -1};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const integer side = each_side_1[i_1];
        if (sides != -side) {
            const real phase = phase_of(scene.x, scene.y, side, scene.wx, scene.wy);
            const Entry nothing = (Entry){side, 0, 0.0, 0.0, 0.0};
            if (hold_miss(phase, side, scene) <= tolerance && best.entry.t1 > 0.0) {
                best = (EntryBeside){nothing, phase, end_miss(nothing, phase, scene)};
            }
            const integer each_u_2[2] = {1, -1};
            for (int i_2 = 0; i_2 < 2; i_2++) {
                const integer u = each_u_2[i_2];
                best = faster_beside(best, arc_beside(u, 0.0, phase, side, scene), tolerance);
                best = fastest_arc_beside(best, u, side, tolerance, scene);
            }
        }
    }
    return best;
}

/* The result for a maneuver that joins at a phase. */
static inline WindEntry entry_at(Entry entry, real phase, real miss, WindScene scene) {
    const real_5 hold_pose_1 = hold_pose(phase, entry.side, scene.R, scene.wx, scene.wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1;
    return (WindEntry){code(STATUS_OK), entry.side, entry.word, entry.t1, entry.t2, entry.t3, atan2(py, px), miss};
}

/* The candidate without pieces, which joins at the point of the circle that is nearest to the start. */
static inline WindCandidate start_on_circle(integer side, WindScene scene) {
    const real phase = phase_of(scene.x, scene.y, side, scene.wx, scene.wy);
    return (WindCandidate){phase, side, (Path){0.0, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0}};
}

/* Whether the start is on the circle and moves along it, up to rounding. */
static inline bool is_on_circle(integer side, WindScene scene) {
    const Entry nothing = (Entry){side, 0, 0.0, 0.0, 0.0};
    const real phase = start_on_circle(side, scene).phase;
    return end_miss(nothing, phase, scene) <= 3.0 * scene.arc_tolerance;
}

/* The arc left of a word whose other pieces together last `SHORT` or less; the empty word where there is none. */
static inline Entry one_arc_entry(WindCandidate found) {
    const integer side = found.side;
    const Path path = found.path;
    const integer_3 controls_1 = controls(path.word);
    const integer first = controls_1.a0, middle = controls_1.a1, last = controls_1.a2;
    if (first == last && path.t2 <= SHORT) {
        return (Entry){side, encode(first, -2, -2), path.t1 + path.t3, 0.0, 0.0};
    }
    if (middle != 0 && path.t1 + path.t3 <= SHORT) {
        return (Entry){side, encode(middle, -2, -2), path.t2, 0.0, 0.0};
    }
    if (path.t2 + path.t3 <= SHORT) {
        return (Entry){side, encode(first, -2, -2), path.t1, 0.0, 0.0};
    }
    if (path.t1 + path.t2 <= SHORT) {
        return (Entry){side, encode(last, -2, -2), path.t3, 0.0, 0.0};
    }
    return (Entry){side, 0, 0.0, 0.0, 0.0};
}

/* The two arcs left of a word whose third piece lasts `short` or less; the empty word where there are none. */
static inline Entry two_arc_entry(WindCandidate found, real short_) {
    const integer side = found.side;
    const Path path = found.path;
    const integer_3 controls_1 = controls(path.word);
    const integer first = controls_1.a0, middle = controls_1.a1, last = controls_1.a2;
    if (middle == 0) {
        if (path.t2 <= short_ && first != last) {
            return (Entry){side, encode(first, last, -2), path.t1, path.t3, 0.0};
        }
    } else if (path.t1 <= min_real(short_, path.t3)) {
        return (Entry){side, encode(middle, last, -2), path.t2, path.t3, 0.0};
    } else if (path.t3 <= short_) {
        return (Entry){side, encode(first, middle, -2), path.t1, path.t2, 0.0};
    }
    return (Entry){side, 0, 0.0, 0.0, 0.0};
}

/* Whether one or two arcs end on the circle, and no later than `latest`, up to rounding. */
static inline bool is_close(Entry arcs, real phase, real latest, WindScene scene) {
    const bool both_flown = min_real(arcs.t1, arcs.t2) >= 0.0;
    const real late = entry_duration(arcs) - latest;
    return both_flown && max_real(late, end_miss(arcs, phase, scene)) <= 3.0 * scene.arc_tolerance;
}

/* Two arcs that end on the circle, and their phase, from an approximation, by Newton's method.
 *
 * Where the headings agree, joining later by s along the circle moves the point of joining just as flying the
 * second arc for s longer moves the end of the path. So the position determines t1 and t2 - s, and then the heading
 * determines s.
 */
static inline Entry_real fit_two_arcs(Entry arcs, real phase, WindScene scene) {
    const real x = scene.x, y = scene.y, c = scene.c, s = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy,
            arc_tolerance = scene.arc_tolerance;
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
        if (across == 0.0 || bend == 0.0) {
            break;
        }
        const real d1 = (rx * by - ry * bx) / across, d2 = (ax * ry - ay * rx) / across;
        const real later = (atan2(c2 * se - s2 * ce, c2 * ce + s2 * se) - (real)first * d1 - (real)second * d2) /
                bend;
        t1 = t1 + d1;
        t2 = t2 + d2 + later;
        phase = phase + later * g / R;
        if (fabs(d1) + fabs(d2) + fabs(later) <= arc_tolerance) {
            break;
        }
    }
    return (Entry_real){(Entry){side, word, t1, t2, 0.0}, phase};
}

/* The maneuver and phase of a candidate, or those of one or two of its arcs alone if close and no slower. */
static inline Entry_real polish(WindCandidate found, WindScene scene) {
    const real phase = found.phase;
    const integer side = found.side;
    const Path path = found.path;
    const Entry entry = (Entry){side, path.word, path.t1, path.t2, path.t3};
    const real latest = path.time + TOO_EARLY * end_miss(entry, phase, scene);
    Entry arc = one_arc_entry(found), arcs = two_arc_entry(found, SHORT);
    if (arc.word != 0) {
        const Entry_real fit_one_arc_1 = fit_one_arc(arc, phase, scene);
        arc = fit_one_arc_1.a0;
        const real arc_phase = fit_one_arc_1.a1;
        if (is_close(arc, arc_phase, latest, scene)) {
            return (Entry_real){arc, arc_phase};
        }
    }
    if (arcs.word != 0) {
        const Entry_real fit_two_arcs_2 = fit_two_arcs(arcs, phase, scene);
        arcs = fit_two_arcs_2.a0;
        const real arcs_phase = fit_two_arcs_2.a1;
        if (is_close(arcs, arcs_phase, latest, scene)) {
            return (Entry_real){arcs, arcs_phase};
        }
    }
    return (Entry_real){entry, phase};
}

/* A candidate as the maneuver flown; `Status.NOT_CONVERGED` where it does not end on the circle. */
static inline WindEntry wind_entry(WindCandidate found, WindScene scene) {
    const real length_tolerance = rounding(scene.x, scene.y, scene.R);
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
    const real miss = end_miss((Entry){side, word, t1, t2, t3}, phase, scene);
    /* Each piece has its arc tolerance, which the wind may double, and the rounding of its duration. The negated */
    /* comparison also rejects a miss that is nan. */
    if (!(miss <= 2.0 * length_tolerance + ROUNDING * (t1 + t2 + t3))) {
        return no_entry(code(STATUS_NOT_CONVERGED));
    }
    return entry_at((Entry){side, word, t1, t2, t3}, phase, miss, scene);
}

/* The side, word and durations of a maneuver, as for still air. */
static inline Entry entry_of(WindEntry maneuver) {
    return (Entry){maneuver.side, maneuver.word, maneuver.t1, maneuver.t2, maneuver.t3};
}

/* T, the whole time of a maneuver. */
static inline real time_of(WindEntry maneuver) {
    return entry_duration(entry_of(maneuver));
}

/* The search with its result: the maneuver onto the circle, or that beside it if it is faster. */
static inline void end_search(WindSearch *search) {
    const WindScene scene = search->scene;
    const EntryBeside beside = search->beside;
    WindEntry entry = wind_entry(search->best, scene);
    /* The negated comparison is also true where there is no maneuver onto the circle: its times are nan. */
    if (beside.entry.t1 < INFINITY && !(time_of(entry) <= beside.entry.t1)) {
        entry = entry_at(beside.entry, beside.phase, beside.miss, scene);
    }
    search->stage = ENDED;
    search->entry = entry;
    return;
}

/* The search for the fastest maneuver, before its first step; it has ended where the answer is known at once. */
static inline WindSearch begin_search(WindProblem problem) {
    WindSearch search = NO_SEARCH;
    const integer status = wind_search_status_of(problem);
    if (status != 0) {
        search.stage = ENDED;
        search.entry = no_entry(status);
        return search;
    }
    const WindScene scene = scene_of(problem);
    search.sides = problem.side;
    search.scene = scene;
    if (problem.tolerance > 0.0) {
        search.beside = entry_beside(problem.side, problem.tolerance, scene);
        const Entry entry = search.beside.entry;
        const real phase = search.beside.phase, miss = search.beside.miss;
        if (entry.t1 == 0.0) {
            search.stage = ENDED;
            search.entry = entry_at(entry, phase, miss, scene);
            return search;
        }
    }
    const integer each_side_1[2] = {1, -1};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const integer side = each_side_1[i_1];
        if (problem.side != -side && is_on_circle(side, scene)) {
            search.best = start_on_circle(side, scene);
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
    const real along = wx * dx + wy * dy, spare = 1.0 - wx * wx - wy * wy, square = dx * dx + dy * dy;
    const real root = sqrt(along * along + spare * square);
    if (along < 0.0) {
        return (root - along) / spare;
    }
    return square > 0.0 ? square / (root + along) : 0.0;
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
    if (beyond > arc_tolerance && straight * min_real(beyond, short_) <= 3.0 * arc_tolerance) {
        return beyond < short_ ? arcs : 0.0;
    }
    return first;
}

/* The first LSL (u = +1) or RSR whose time is at most `until`.
 *
 * t1 + t3 is the rotation from start to pose, or a turn more, and t2 an interception.
 */
static inline Path lsl_rsr(integer u, real dx, real dy, Ends ends, real until_) {
    const real c0 = ends.c0, s0 = ends.s0, c = ends.c, s = ends.s, wx = ends.wx, wy = ends.wy, arc_tolerance =
            ends.arc_tolerance;
    const real rotation = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, arc_tolerance);
    const real each_arcs_1[2] = {rotation, rotation + TWO_PI};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const real arcs = each_arcs_1[i_1];
        const real ax = dx - wx * arcs, ay = dy - wy * arcs;
        const real straight = interception(ax, ay, wx, wy);
        if (arcs + straight > until_ + ALMOST) {
            break;
        }
        const real ex = ax - wx * straight, ey = ay - wy * straight;
        real first = arc_time(arc_rotation(u, c0, s0, ex, ey), 1.0 + straight, arc_tolerance);
        first = first_of_same_turns(first, arcs, straight, arc_tolerance);
        const real last = max_real(arcs - first, 0.0);
        if (first <= arcs + arc_tolerance && straight * (last - TWO_PI) <= 3.0 * arc_tolerance) {
            const real distance = length(ex, ey);
            /* Where the two circles coincide, any direction of p is possible. */
            const bool chosen_1 = distance > 0.0;
            const real p1 = chosen_1 ? ex / distance : 1.0, p2 = chosen_1 ? ey / distance : 0.0;
            return (Path){first + straight + last, encode(u, 0, u), first, straight, last, 1.0, p1, p2};
        }
    }
    return NO_PATH;
}

/* The path that takes less time: a where they tie, or where b takes longer than `until`. */
static inline Path faster_path(Path a, Path b, real until_) {
    return b.time < a.time && b.time <= until_ ? b : a;
}

/* The interval of times t >= 0 in which |d - w t| < limit; both ends are `inf` where there is none. */
static inline real_2 time_within(real dx, real dy, real wx, real wy, real limit) {
    const real along = wx * dx + wy * dy, square = wx * wx + wy * wy, gap = dx * dx + dy * dy - limit * limit;
    const real discriminant = along * along - square * gap;
    if (gap >= 0.0 && (along <= 0.0 || discriminant <= 0.0)) {
        return (real_2){INFINITY, INFINITY};
    }
    const real root = sqrt(discriminant);
    if (gap >= 0.0) {
        return (real_2){gap / (along + root), (along + root) / square};
    }
    if (along > 0.0) {
        return (real_2){0.0, (along + root) / square};
    }
    return (real_2){0.0, root > along ? -gap / (root - along) : INFINITY};
}

/* The straight piece of LSR (u = +1) or RSL between circles whose centres are d apart: length and direction. */
static inline real_3 tangent(integer u, real dx, real dy) {
    const real square = dx * dx + dy * dy;
    const real straight = sqrt(max_real(square - 4.0, 0.0));
    return (real_3){straight, (straight * dx - 2.0 * (real)u * dy) / square, (straight * dy + 2.0 * (real)u * dx) /
            square};
}

/* By how much each arc of LSR (u = +1) or RSL grows in an interval, continued beyond whole turns. */
static inline real arc_growth(integer u, real dx, real dy, Ends ends, real_2 interval) {
    const real begin = interval.a0, end_ = interval.a1;
    const real_3 tangent_1 = tangent(u, dx - ends.wx * begin, dy - ends.wy * begin);
    const real e1 = tangent_1.a1, e2 = tangent_1.a2;
    /* In the end the straight piece points against the wind. */
    real p1 = -ends.wx, p2 = -ends.wy;
    if (end_ < INFINITY) {
        const real_3 tangent_2 = tangent(u, dx - ends.wx * end_, dy - ends.wy * end_);
        p1 = tangent_2.a1;
        p2 = tangent_2.a2;
    }
    const real turned = fabs(atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2));
    return (real)u * (ends.wx * e2 - ends.wy * e1) >= 0.0 ? turned : -turned;
}

/* 1 where an arc exceeds a limit, or almost: the ends of arcs are known up to rounding only; otherwise 0. */
static inline integer passes(real arc, real limit) {
    return arc > limit - ALMOST ? 1 : 0;
}

/* The time in an interval at which the length of LSR or RSL equals T; any later time where there is none.
 *
 * `arcs` is the sum of the durations of its two arcs at the beginning of the interval.
 */
static inline real lsr_rsl_root(integer u, real dx, real dy, Ends ends, real arcs, real_2 interval) {
    const real wx = ends.wx, wy = ends.wy;
    const real begin = interval.a0, end_ = interval.a1;
    const real_3 tangent_1 = tangent(u, dx - wx * begin, dy - wy * begin);
    real straight = tangent_1.a0;
    const real e1 = tangent_1.a1, e2 = tangent_1.a2;
    real time = begin, p1 = e1, p2 = e2, turned = 0.0;
    for (integer pass_1 = 0; pass_1 < NEWTON_STEPS; pass_1++) {
        const real step = (arcs + turned + straight - time) / (1.0 + wx * p1 + wy * p2);
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
        turned = 2.0 * (real)u * atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2);
    }
    return time;
}

/* The LSR or RSL at the first root in an interval throughout which the centres are at least two radii apart.
 *
 * With its arcs continued beyond whole turns, length - T is convex and falls with the slope -(1 + w . p). So for
 * each number of turns it has at most one root, and Newton's method converges to it from the beginning of the
 * interval.
 */
static inline Path first_lsr_rsl(integer u, real dx, real dy, Ends ends, real_2 interval) {
    const real c0 = ends.c0, s0 = ends.s0, c = ends.c, s = ends.s, wx = ends.wx, wy = ends.wy, arc_tolerance =
            ends.arc_tolerance;
    const real begin = interval.a0, end_ = interval.a1;
    const real_3 tangent_1 = tangent(u, dx - wx * begin, dy - wy * begin);
    real straight = tangent_1.a0;
    const real e1 = tangent_1.a1, e2 = tangent_1.a2;
    real first = angle(arc_rotation(u, c0, s0, e1, e2)), last = angle(arc_rotation(u, c, s, e1, e2));
    const real arcs = first + last, growth = arc_growth(u, dx, dy, ends, interval);
    /* An arc that grows beyond a whole turn loses it, one that shrinks below zero gains one. */
    const real least = min_real(first, last) + growth, most = max_real(first, last) + growth;
    const integer fewest = max_integer(-passes(least, TWO_PI) - passes(most, TWO_PI), integer_of(ceil((begin - arcs
            - straight) / TWO_PI)));
    const integer gained = passes(-least, 0.0) + passes(-most, 0.0);
    const integer last_1 = gained + 1;
    for (integer turns = fewest; turns < last_1; turns++) {
        const real time = lsr_rsl_root(u, dx, dy, ends, arcs + TWO_PI * (real)turns, interval);
        if (time > end_) {
            break;
        }
        const real_3 tangent_2 = tangent(u, dx - wx * time, dy - wy * time);
        straight = tangent_2.a0;
        const real p1 = tangent_2.a1, p2 = tangent_2.a2;
        first = arc_time(arc_rotation(u, c0, s0, p1, p2), 1.0 + straight, arc_tolerance);
        last = arc_time(arc_rotation(u, c, s, p1, p2), 1.0, arc_tolerance);
        if (fabs(first + straight + last - time) < 3.141592653589793) {
            return (Path){first + straight + last, encode(u, 0, -u), first, straight, last, 1.0, p1, p2};
        }
    }
    return NO_PATH;
}

/* The first LSR (u = +1) or RSL whose time is at most `until`; the centres must be at least two radii apart. */
static inline Path lsr_rsl(integer u, real dx, real dy, Ends ends, real until_) {
    /* Circles that overlap by rounding count as touching: two arcs without a straight piece. */
    const real_2 time_within_1 = time_within(dx, dy, ends.wx, ends.wy, 2.0 - ends.arc_tolerance);
    const real enter = time_within_1.a0, leave = time_within_1.a1;
    Path path = NO_PATH;
    if (enter > 0.0) {
        path = first_lsr_rsl(u, dx, dy, ends, (real_2){0.0, min_real(enter, until_)});
    }
    if (path.time == INFINITY && leave < until_) {
        path = first_lsr_rsl(u, dx, dy, ends, (real_2){leave, until_});
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
    const real inflection = acos(wx * wx + wy * wy);
    real least = within.a0;
    const real most = within.a1;
    least = max_real(least, inflection);
    const real outer = TWO_PI - inflection;
    real m = min_real(outer, most);
    bool concave = false;
    for (integer step = 0; step < NEWTON_STEPS; step++) {
        if (m < least && !concave) {
            return INFINITY;
        }
        const real x = dx - 2.0 * m * wx, y = dy - 2.0 * m * wy;
        const real across = sin(0.5 * m), along = cos(0.5 * m);
        const real h = x * x + y * y - 16.0 * across * across;
        const real slope = -4.0 * (wx * x + wy * y) - 16.0 * across * along;
        if (step == 0) {
            concave = h < 0.0;
        }
        /* The root lies beyond `most` where h is still negative there. */
        if (slope <= 0.0 || (concave && m >= most)) {
            return INFINITY;
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
static inline Path three_arcs(integer u, real middle, real dx, real dy, Ends ends) {
    const real c0 = ends.c0, s0 = ends.s0, c = ends.c, s = ends.s, arc_tolerance = ends.arc_tolerance;
    const real distance = length(dx, dy);
    const bool chosen_1 = distance > 0.0;
    const real p1 = chosen_1 ? -dx / distance : 1.0, p2 = chosen_1 ? -dy / distance : 0.0;
    const real lam = -cos(0.5 * middle), across = sin(0.5 * middle);
    /* The headings at the two switches: p turned by the angle whose cosine is lambda, against the sense of the outer */
    /* arcs at the first switch and in their sense at the second. */
    const real ax = lam * p1 + (real)u * across * p2, ay = lam * p2 - (real)u * across * p1;
    const real bx = lam * p1 - (real)u * across * p2, by = lam * p2 + (real)u * across * p1;
    const real first = arc_time(arc_rotation(u, c0, s0, ax, ay), 4.0, arc_tolerance);
    const real last = arc_time(arc_rotation(u, bx, by, c, s), 1.0, arc_tolerance);
    return (Path){first + middle + last, encode(u, -u, u), first, middle, last, lam, p1, p2};
}

/* The first LRL (u = +1) or RLR whose time T is at most `until`: T = 2 t2 + rotation from start to pose + turns.
 *
 * Only a path with p . w + lambda >= 0 can be the first; for each number of whole turns there is at most one such
 * path.
 */
static inline Path lrl_rlr(integer u, real dx, real dy, Ends ends, real until_) {
    const real c0 = ends.c0, s0 = ends.s0, c = ends.c, s = ends.s, wx = ends.wx, wy = ends.wy, arc_tolerance =
            ends.arc_tolerance;
    const real_2 time_within_1 = time_within(dx, dy, wx, wy, 4.0);
    const real enter = time_within_1.a0, leave = time_within_1.a1;
    Path best = NO_PATH;
    if (enter <= until_) {
        const real rotation = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, arc_tolerance);
        const real each_turns_1[3] = {-1.0, 0.0, 1.0};
        for (int i_1 = 0; i_1 < 3; i_1++) {
            const real turns = each_turns_1[i_1];
            const real outside = rotation + TWO_PI * turns;
            const real limit = min_real(min_real(leave + arc_tolerance, until_), best.time);
            const real_2 within = (real_2){0.5 * (enter - outside) - ALMOST, 0.5 * (limit - outside) + ALMOST};
            const real middle = middle_arc(dx - wx * outside, dy - wy * outside, wx, wy, within);
            const real time = outside + 2.0 * middle;
            if (INFINITY > time && (enter - arc_tolerance <= time && time <= limit)) {
                const Path path = three_arcs(u, middle, dx - wx * time, dy - wy * time, ends);
                if (fabs(path.time - time) < 3.141592653589793) {
                    best = path;
                }
            }
        }
    }
    return best;
}

/* The first path to a point of joining of a set of words; `NO_PATH` where it takes longer than `until`. */
static inline Path first_path_of(integer words, real phase, integer side, WindScene scene, real until_) {
    const real x = scene.x, y = scene.y, c0 = scene.c, s0 = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy,
            arc_tolerance = scene.arc_tolerance;
    const real_5 hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, c = hold_pose_1.a2, s = hold_pose_1.a3;
    const real dx = px - x, dy = py - y;
    Path best = NO_PATH;
    if (interception(dx, dy, wx, wy) <= until_ + arc_tolerance) {
        const Ends ends = (Ends){c0, s0, c, s, wx, wy, arc_tolerance};
        /* The vectors are those from the centre of the first arc to that of the last. The words that take least to find */
        /* are tried first. */
        Path path;
        const integer each_u_1[2] = {1, -1};
        for (int i_1 = 0; i_1 < 2; i_1++) {
            const integer u = each_u_1[i_1];
            if ((words & set_of(encode(u, 0, u))) != 0) {
                path = lsl_rsr(u, dx - (real)u * (s - s0), dy + (real)u * (c - c0), ends, min_real(until_,
                        best.time));
                best = faster_path(best, path, until_);
            }
        }
        const integer each_u_2[2] = {1, -1};
        for (int i_2 = 0; i_2 < 2; i_2++) {
            const integer u = each_u_2[i_2];
            if ((words & set_of(encode(u, 0, -u))) != 0) {
                path = lsr_rsl(u, dx + (real)u * (s + s0), dy - (real)u * (c + c0), ends, min_real(until_,
                        best.time));
                best = faster_path(best, path, until_);
            }
        }
        const integer each_u_3[2] = {1, -1};
        for (int i_3 = 0; i_3 < 2; i_3++) {
            const integer u = each_u_3[i_3];
            if ((words & set_of(encode(u, -u, u))) != 0) {
                path = lrl_rlr(u, dx - (real)u * (s - s0), dy + (real)u * (c - c0), ends, min_real(until_,
                        best.time));
                best = faster_path(best, path, until_);
            }
        }
    }
    return best;
}

/* The derivative of the time of the path with respect to the point of joining, in units of hold time, (6).
 *
 * It is zero where the adjoint is transversal to the circle, and it never exceeds 1.
 */
static inline real join_slope(Path path, real phase, integer side, WindScene scene) {
    const real_5 hold_pose_1 = hold_pose(phase, side, scene.R, scene.wx, scene.wy);
    const real c = hold_pose_1.a2, s = hold_pose_1.a3;
    const real along = path.p1 * c + path.p2 * s, drift = path.p1 * scene.wx + path.p2 * scene.wy;
    const integer_3 controls_2 = controls(path.word);
    const integer last = controls_2.a2;
    const real rate = (real)(side * last) * hold_rate(phase, side, scene.R, scene.wx, scene.wy);
    return (along + drift - rate * (path.lam - along)) / (path.lam + drift);
}

/* The point of joining at a phase, for a set of words. */
static inline JoinPoint join_point(integer words, real phase, integer side, WindScene scene) {
    const Path path = first_path_of(words, phase, side, scene, INFINITY);
    return (JoinPoint){phase, path, join_slope(path, phase, side, scene)};
}

/* The refinement after a step towards where the time falls, twice as long as the last one. */
static inline void bracket(Refinement *refinement, WindScene scene) {
    JoinPoint here = refinement->here;
    const integer steps = refinement->steps;
    const real step = refinement->width * (real)shift_left(1, steps);
    JoinPoint other = join_point(ALL_WORDS, here.phase + (here.slope < 0.0 ? step : -step), refinement->side,
            scene);
    bool is_enclosed = other.path.time > here.path.time;
    if (!is_enclosed) {
        const JoinPoint new_here = other;
        const JoinPoint new_other = here;
        here = new_here;
        other = new_other;
        is_enclosed = here.slope * other.slope <= 0.0;
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
static inline bool has_changed(Path a, Path b) {
    return a.word != b.word || max_real(fabs(a.t1 - b.t1), fabs(a.t3 - b.t3)) > 3.141592653589793;
}

/* Where the slope is zero by the secant through two points; `inf` where there is none.
 *
 * Nor is there one through points on either side of a corner at which the slope does not change its sign.
 */
static inline real secant_phase(JoinPoint a, JoinPoint b) {
    if (a.slope == b.slope || (a.slope * b.slope > 0.0 && has_changed(a.path, b.path))) {
        return INFINITY;
    }
    return a.phase + (b.phase - a.phase) * (a.slope / (a.slope - b.slope));
}

/* Whether the time at a phase, where the slope should be zero, is lower by no more than rounding. */
static inline bool is_worthless(JoinPoint here, real there, WindScene scene) {
    const real slowest = 1.0 - length(scene.wx, scene.wy);
    return fabs(there - here.phase) * fabs(here.slope) * scene.R * WORTH <= here.path.time * slowest;
}

/* Whether a phase lies between those of two points. */
static inline bool is_between(real phase, JoinPoint a, JoinPoint b) {
    return min_real(a.phase, b.phase) < phase && phase < max_real(a.phase, b.phase);
}

/* The phase between two points of different words where the path consists of two arcs; `inf` if none is found. */
static inline real corner_phase(JoinPoint here, JoinPoint other, integer side, WindScene scene) {
    if (here.path.word != other.path.word) {
        const JoinPoint each_point_1[2] = {here, other};
        for (int i_1 = 0; i_1 < 2; i_1++) {
            const JoinPoint point = each_point_1[i_1];
            Entry arcs = two_arc_entry((WindCandidate){point.phase, side, point.path}, INFINITY);
            if (arcs.word != 0) {
                const Entry_real fit_two_arcs_1 = fit_two_arcs(arcs, point.phase, scene);
                arcs = fit_two_arcs_1.a0;
                const real phase = fit_two_arcs_1.a1;
                const bool fits = min_real(arcs.t1, arcs.t2) >= 0.0 && end_miss(arcs, phase, scene) <= 3.0 *
                        scene.arc_tolerance;
                if (fits && is_between(phase, here, other)) {
                    return phase;
                }
            }
        }
    }
    return INFINITY;
}

/* A point just before or after a corner from where the time falls further; its path is `NO_PATH` for none. */
static inline JoinPoint falling_beside(JoinPoint corner, integer side, WindScene scene) {
    const real latest = corner.path.time + scene.arc_tolerance;
    const real each_shift_1[2] = {-AT_CORNER, AT_CORNER};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const real shift = each_shift_1[i_1];
        const JoinPoint beside = join_point(ALL_WORDS, corner.phase + shift, side, scene);
        if (beside.path.time <= latest && beside.slope * shift < 0.0) {
            return beside;
        }
    }
    return (JoinPoint){corner.phase, NO_PATH, 0.0};
}

/* The refinement after another point between those that enclose the minimum. */
static inline void enclose(Refinement *refinement, WindScene scene) {
    const integer side = refinement->side;
    JoinPoint here = refinement->here, other = refinement->other, last = refinement->last;
    integer words = refinement->words;
    bool bisect = refinement->bisect;
    const integer steps = refinement->steps;
    const real secant = secant_phase(here, last);
    /* Across a corner the secant does not show how far the minimum is. */
    if (is_worthless(here, has_changed(here.path, last.path) ? other.phase : secant, scene)) {
        refinement->stage = COMPARING;
        return;
    }
    const real corner = integer_modulo(steps, 4) == 1 ? corner_phase(here, other, side, scene) : INFINITY;
    real there = is_between(corner, here, other) ? corner : 0.5 * (here.phase + other.phase);
    const bool use_secant = there != corner && !bisect && is_between(secant, here, other);
    if (use_secant) {
        there = secant;
    }
    if (there == here.phase || there == other.phase) {
        refinement->stage = COMPARING;
        return;
    }
    const real flattest = min_real(fabs(here.slope), fabs(last.slope));
    last = join_point(words, there, side, scene);
    if (last.path.time > here.path.time && has_changed(here.path, last.path)) {
        last = join_point(ALL_WORDS, there, side, scene);
        words |= set_of(last.path.word);
    }
    /* A secant that helps little is followed by a bisection. */
    bisect = use_secant && fabs(last.slope) > 0.5 * flattest;
    if (last.path.time > here.path.time + scene.arc_tolerance) {
        other = last;
    } else if (there == corner) {
        const JoinPoint beside = falling_beside(last, side, scene);
        if (beside.path.time == INFINITY) {
            refinement->stage = COMPARING;
            refinement->here = last;
            return;
        }
        other = is_between(beside.phase, last, other) ? other : here;
        here = beside;
    } else {
        if (here.slope * last.slope < 0.0) {
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
    return (WindCandidate){refinement->here.phase, refinement->side, refinement->here.path};
}

/* The first path to a point of joining, the best of the six words; `NO_PATH` where it takes longer than `until`. */
static inline Path first_path(real phase, integer side, WindScene scene, real until_) {
    return first_path_of(ALL_WORDS, phase, side, scene, until_);
}

/* A faster path, of any word, to the point of a candidate or a little before or after it; otherwise `NO_PATH`. */
static inline WindCandidate faster_nearby(WindCandidate found, WindScene scene) {
    const real until_ = found.path.time - scene.arc_tolerance;
    const real beside = BESIDE * min_real(found.path.time, 1.0);
    const real each_shift_1[3] = {0.0, -beside, beside};
    for (int i_1 = 0; i_1 < 3; i_1++) {
        const real shift = each_shift_1[i_1];
        const Path path = first_path(found.phase + shift, found.side, scene, until_);
        if (path.time < INFINITY) {
            return (WindCandidate){found.phase + shift, found.side, path};
        }
    }
    return (WindCandidate){found.phase, found.side, NO_PATH};
}

/* The refinement that begins at a point; its first step is as wide as `width`, radians. */
static inline Refinement refinement_from(JoinPoint start, integer side, real width) {
    Refinement changed_1 = NO_REFINEMENT;
    changed_1.stage = BRACKETING;
    changed_1.side = side;
    changed_1.width = width;
    changed_1.here = start;
    return changed_1;
}

/* The refinement of a candidate. */
static inline Refinement begin_refinement(WindCandidate found, real width, WindScene scene) {
    const real slope = join_slope(found.path, found.phase, found.side, scene);
    return refinement_from((JoinPoint){found.phase, found.path, slope}, found.side, width);
}

/* The refinement of a faster path, of any word, to its minimum or to a point beside it, if there is one. */
static inline void compare_nearby(Refinement *refinement, WindScene scene) {
    const WindCandidate faster = faster_nearby(minimum_of(refinement), scene);
    if (faster.path.time == INFINITY) {
        refinement->stage = REFINED;
        return;
    }
    const Refinement again = begin_refinement(faster, refinement->width, scene);
    const integer enclosures = refinement->enclosures + 1;
    Refinement changed_1 = again;
    changed_1.stage = enclosures < REFINEMENTS ? BRACKETING : REFINED;
    changed_1.enclosures = enclosures;
    *refinement = changed_1;
    return;
}

/* The refinement after another step, which tries a point, or a few; it has not ended yet. */
static inline void refine(Refinement *refinement, WindScene scene) {
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
    return (CellVisit){leaf + 1, LEAF, ALL_WORDS};
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
    search->compared = INFINITY;
    search->visits = 0;
    return;
}

/* Whether a cell needs not be halved further. */
static inline bool is_done(CellVisit visit, OpenCell cell, WindCandidate best) {
    return visit.level == LAST || cell.earliest >= best.path.time - cell.tolerance;
}

/* The first half of a cell inside which a set of words may join. */
static inline CellVisit first_half(CellVisit visit, integer possible) {
    const integer words = visit.level < NARROWED ? (shift_left(visit.words, 6) | possible) : visit.words;
    return (CellVisit){2 * visit.number, visit.level + 1, words};
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
    return (CellVisit){number, level, words};
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
        refine(&changed_1, scene);
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
        if (found.path.time > 0.0) {
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
    const integer words = is_done(search->visit, search->cell, found) ? 0 : search->cell.words;
    const CellVisit new_2 = next_in_leaves(search->visit, words);
    search->best = found;
    search->visit = new_2;
    return;
}

/* The fastest of `best` and the paths to `JOINS` points around the circle, where possible with a straight piece. */
static inline WindCandidate best_of_joins(integer side, WindScene scene, WindCandidate best) {
    for (integer i = 0; i < JOINS; i++) {
        const real phase = TWO_PI / (real)JOINS * ((real)i + 0.5);
        const integer words = best.path.time < INFINITY ? WITH_STRAIGHT : ALL_WORDS;
        const Path path = first_path_of(words, phase, side, scene, best.path.time);
        if (path.time < best.path.time) {
            best = (WindCandidate){phase, side, path};
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
        best = best_of_joins(side, scene, best);
    }
    const Refinement refinement = side == 1 ? NO_REFINEMENT : begin_refinement(best, TWO_PI / (real)JOINS, scene);
    const integer new_1 = search->left - 1;
    search->best = best;
    search->side = -side;
    search->left = new_1;
    search->refinement = refinement;
    return;
}

/* The phase in the middle of a cell, and half its width. */
static inline real_2 middle_of(CellVisit visit) {
    const real half = 0.5 * TWO_PI / (real)shift_left(FIRST_CELLS, visit.level);
    return (real_2){half * (2.0 * (real)visit.number + 1.0), half};
}

/* The cell around a phase. */
static inline Cell cell_at(real phase, real half, integer side, WindScene scene) {
    const real x = scene.x, y = scene.y, c0 = scene.c, s0 = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy;
    const real_5 hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, c = hold_pose_1.a2, s = hold_pose_1.a3, g = hold_pose_1.a4;
    const real wind = length(wx, wy), out = (wx * px + wy * py) / R;
    const real crab = sqrt((1.0 - out) * (1.0 + out));
    /* The heading turns by g/crab, from 1 - |w| upwind to 1 + |w| downwind; that changes most across the wind. */
    const real turning = g / crab, twist = wind / sqrt((1.0 - wind) * (1.0 + wind));
    const real fastest_turning = min_real(1.0 + wind, turning + twist * half);
    const real bend = R + fastest_turning * fastest_turning + twist;
    const real tx = R * (c + wx) / g, ty = R * (s + wy) / g;
    const real still = (1.0 - wind) * (1.0 + wind);
    const real turned_more = (real)side * out * still / (crab * crab * crab);
    const real jerk = twist * (1.0 + 2.0 * wind * wind) / still;
    const real bend_change = R + jerk + 3.0 * fastest_turning * twist + fastest_turning * fastest_turning *
            fastest_turning;
    return (Cell){half, px - x, py - y, c, s, tx, ty, -px, -py, (real)-side * turning, turned_more, bend,
            bend_change, twist, jerk, fastest_turning, wind, c0, s0, wx, wy};
}

/* Whether no vehicle, however fast it turns, reaches the cell before the time. */
static inline bool is_out_of_reach(Cell cell, real radius, real time) {
    return length(cell.px - cell.wx * time, cell.py - cell.wy * time) >= time + radius * cell.half;
}

/* The centres of the first and the last arc of a word with these controls. */
static inline Centres centres(integer first, integer last, Cell cell) {
    const real x = cell.px - (real)last * cell.s + (real)first * cell.s0, y = cell.py + (real)last * cell.c -
            (real)first * cell.c0;
    const real turning = cell.turning, c = cell.c, s = cell.s;
    const real dx = cell.tx - (real)last * turning * c, dy = cell.ty - (real)last * turning * s;
    const real ddx = cell.nx - (real)last * (cell.turned_more * c - turning * turning * s);
    const real ddy = cell.ny - (real)last * (cell.turned_more * s + turning * turning * c);
    const real rate = length(dx, dy);
    const real change = (rate + 0.5 * cell.bend * cell.half) * cell.half;
    return (Centres){x, y, dx, dy, ddx, ddy, change, rate + cell.bend * cell.half};
}

/* An angle in [0, 2 pi), or one turn less where a change by as much as `change` may bring it back to zero. */
static inline real lowest_turn(real turn, real change) {
    return turn + change >= TWO_PI ? turn - TWO_PI : turn;
}

/* A lower bound, inside a cell, on a function whose second derivative is at least -`bend`. */
static inline real least_inside(real value, real slope, real bend, real half) {
    return value - (fabs(slope) + 0.5 * bend * half) * half;
}

/* The second derivative of the length of LSL (or LSR, with `distance` its straight piece) but for that of the arcs.
 *
 * The straight piece has the direction p.
 */
static inline real distance_curvature(real p1, real p2, real distance, Centres between) {
    const real across = p1 * between.dy - p2 * between.dx;
    return p1 * between.ddx + p2 * between.ddy + across * across / distance;
}

/* A bound on the derivative of `distance_curvature` inside a cell, where the straight piece is at least `nearest`.
 *
 * `touching` is 2 for LSR, where the direction of the straight piece changes its length too, otherwise 0.
 */
static inline real distance_curvature_change(real nearest, real touching, Centres between, Cell cell) {
    const real swing = between.fastest / nearest;
    return cell.bend_change + (3.0 * cell.bend + (3.0 * between.fastest + touching * swing) * swing) * swing;
}

/* A lower bound, inside a cell, on a function whose third derivative is at most `change` in size. */
static inline real least_inside_curved(real value, real slope, real curvature, real change, real half) {
    const real steep = fabs(slope);
    real least = value - (steep - (0.5 * curvature - change * half / 6.0) * half) * half;
    const real square = curvature * curvature - 2.0 * steep * change;
    if (curvature > 0.0 && square > 0.0) {
        const real lowest = 2.0 * steep / (curvature + sqrt(square));
        if (lowest < half) {
            least = min_real(least, value - (steep - (0.5 * curvature - change * lowest / 6.0) * lowest) * lowest);
        }
    }
    return least;
}

/* Half the rate at which the length of a word, less the time, falls with the time.
 *
 * Its straight piece has the direction p. The rate is no less while the direction changes by no more than this over
 * |w|.
 */
static inline real slowest_fall(real p1, real p2, Cell cell) {
    return 0.5 * (1.0 + cell.wx * p1 + cell.wy * p2);
}

/* Whether two arcs that add up to `arcs` are too few throughout the cell: the first alone would be longer. */
static inline bool lsl_rsr_needs_turn(integer u, real arcs, Centres between, real turned, Cell cell) {
    const real wx = cell.wx, wy = cell.wy;
    real x = between.x - wx * arcs, y = between.y - wy * arcs;
    const real straight = interception(x, y, wx, wy);
    x = x - wx * straight;
    y = y - wy * straight;
    const real distance = length(x, y);
    if (distance == 0.0) {
        return false;
    }
    const real rate = slowest_fall(x / distance, y / distance, cell);
    /* How far the centres move relative to each other, since the time changes too. */
    real shift = between.change + cell.wind * (between.change + turned) / rate;
    const real first = angle(arc_rotation(u, cell.c0, cell.s0, x, y));
    real swing = 0.5 * 3.141592653589793 * shift / distance;
    const bool known = shift < distance && cell.wind * swing <= rate;
    if (known && first - swing <= arcs + turned) {
        /* The rate is known better now. */
        shift = between.change + cell.wind * (between.change + turned) / (2.0 * rate - cell.wind * swing);
        swing = 0.5 * 3.141592653589793 * shift / distance;
    }
    return known && first - swing > arcs + turned && first + swing < TWO_PI;
}

/* The margin of LSL (u = +1) or RSR: the length of the word less the time. */
static inline real lsl_rsr_margin(integer u, Cell cell, real time) {
    const Centres between = centres(u, u, cell);
    const real turned = cell.fastest_turning * cell.half;
    const real x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const real arcs = lowest_turn(angle(arc_rotation(u, cell.c0, cell.s0, cell.c, cell.s)), turned);
    const real distance = length(x, y);
    const real nearer = distance > 0.0 ? (x * between.dx + y * between.dy) / distance : between.change / cell.half;
    const real slope = nearer + (real)u * cell.turning, bend = cell.bend + cell.twist, value = distance + arcs -
            time;
    real margin = least_inside(value, slope, bend, cell.half);
    if (margin < 0.0 && 0.0 < distance - between.change) {
        const real curvature = distance_curvature(x / distance, y / distance, distance, between) + (real)u *
                cell.turned_more;
        const real change = distance_curvature_change(distance - between.change, 0.0, between, cell) + cell.jerk;
        margin = max_real(margin, least_inside_curved(value, slope, curvature, change, cell.half));
    }
    if (margin < 0.0 && lsl_rsr_needs_turn(u, arcs, between, turned, cell)) {
        return margin + TWO_PI;
    }
    return margin;
}

/* The angle by which the straight piece of LSR or RSL turns at most while the arcs may touch. */
static inline real most_turned(real touching, Centres between, Cell cell) {
    const real moved = 0.5 * cell.wind * touching;
    return acos(2.0 / (2.0 + 3.0 * between.change)) + (moved < 1.0 ? 0.5 * 3.141592653589793 * moved :
            3.141592653589793);
}

/* Whether LSR or RSL has an arc below zero throughout the cell if its two arcs last `arcs` at the beginning.
 *
 * Or whether it is shorter than the time from the beginning on, and `before` that, so that it is never equal to it.
 */
static inline bool lsr_rsl_needs_turn(integer u, Centres between, Cell cell, real arcs, real_2 interval, real
        before) {
    const real begin = interval.a0, end_ = interval.a1;
    const real turned = cell.fastest_turning * cell.half;
    const real_3 tangent_1 = tangent(u, between.x - cell.wx * begin, between.y - cell.wy * begin);
    real straight = tangent_1.a0;
    if (straight + arcs + between.change + turned + (1.0 + cell.wind) * before < begin) {
        return true;
    }
    const Ends ends = (Ends){cell.c0, cell.s0, cell.c, cell.s, cell.wx, cell.wy, 0.0};
    const real time = lsr_rsl_root(u, between.x, between.y, ends, arcs, interval);
    if (!(begin < time && time < end_)) {
        return false;
    }
    const real x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const real_3 tangent_2 = tangent(u, x, y);
    straight = tangent_2.a0;
    const real p1 = tangent_2.a1, p2 = tangent_2.a2;
    const real rate = slowest_fall(p1, p2, cell);
    const real later = (between.change + turned) / rate;
    const real moved = between.change + cell.wind * later;
    const real nearest = length(x, y) - moved;
    if (nearest <= 2.0 || time - later <= begin) {
        return false;
    }
    const real swing = moved / sqrt(nearest * nearest - 4.0);
    if (cell.wind * swing > rate) {
        return false;
    }
    const real t1 = angle(arc_rotation(u, cell.c0, cell.s0, p1, p2)), t3 = angle(arc_rotation(u, cell.c, cell.s, p1,
            p2));
    const real first = min_real(t1, TWO_PI - t1), last = min_real(t3, TWO_PI - t3);
    return t1 + straight + t3 - time > 3.141592653589793 && first > swing && last > swing + turned;
}

/* The margin of LSR or RSL at the end of an interval, throughout which the centres are further apart than 2.
 *
 * `before` is how long before the interval the arcs may touch, `after` how long after it.
 */
static inline real tangent_margin(integer u, Centres between, Cell cell, real_2 interval, real before, real after) {
    const real begin = interval.a0, time = interval.a1;
    const real x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const real_3 tangent_1 = tangent(u, x, y);
    const real straight = tangent_1.a0, p1 = tangent_1.a1, p2 = tangent_1.a2;
    const real nearest = length(x, y) - between.change;
    if (nearest <= 2.0) {
        return -INFINITY;
    }
    /* The direction of the straight piece turns by less than this inside the cell, and by `earlier` during the interval. */
    real swing = between.change / sqrt(nearest * nearest - 4.0);
    if (before + after > 0.0) {
        swing += most_turned(before + after, between, cell);
    }
    const real_3 tangent_2 = tangent(u, between.x - cell.wx * begin, between.y - cell.wy * begin);
    const real q1 = tangent_2.a1, q2 = tangent_2.a2;
    const real earlier = (real)u * atan2(p1 * q2 - p2 * q1, p1 * q1 + p2 * q2);
    const real turned = cell.fastest_turning * cell.half;
    const real first = angle(arc_rotation(u, cell.c0, cell.s0, p1, p2)), last = angle(arc_rotation(u, cell.c,
            cell.s, p1, p2));
    const real slope = p1 * between.dx + p2 * between.dy - (real)u * cell.turning;
    const real middle = straight + first + last - time;
    real value = least_inside(middle, slope, cell.bend + cell.twist, cell.half);
    if (value < 0.0) {
        const real curvature = distance_curvature(p1, p2, straight, between) - (real)u * cell.turned_more;
        const real change = distance_curvature_change(sqrt(nearest * nearest - 4.0), 2.0, between, cell) +
                cell.jerk;
        value = max_real(value, least_inside_curved(middle, slope, curvature, change, cell.half));
    }
    const real lowest = lowest_turn(first, swing + max_real(earlier, 0.0)) + lowest_turn(last, swing +
            max_real(earlier, 0.0) + turned);
    value += lowest - first - last;
    /* The arcs at the beginning of the interval, without those turns that either arc may lose. */
    real arcs = lowest + 2.0 * earlier;
    for (integer pass_1 = 0; pass_1 < 3; pass_1++) {
        if (value >= 0.0) {
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
static inline real lsr_rsl_margin(integer u, Cell cell, real time) {
    const Centres between = centres(u, -u, cell);
    const real wx = cell.wx, wy = cell.wy, change = between.change;
    const real_2 time_within_1 = time_within(between.x, between.y, wx, wy, 2.0 + 2.0 * change);
    const real enter = time_within_1.a0, leave = time_within_1.a1;
    if (enter >= time) {
        return tangent_margin(u, between, cell, (real_2){0.0, time}, 0.0, 0.0);
    }
    real margin = INFINITY;
    real inner_enter = INFINITY, inner_leave = INFINITY;
    if (change < 2.0) {
        const real_2 time_within_2 = time_within(between.x, between.y, wx, wy, 2.0 - change);
        inner_enter = time_within_2.a0;
        inner_leave = time_within_2.a1;
    }
    real touching;
    if (inner_enter > 0.0) {
        /* The first arc and the last may touch between these times. */
        touching = min_real(min_real(inner_enter, leave), time) - enter;
        if (enter == 0.0) {
            return -INFINITY;
        }
        margin = tangent_margin(u, between, cell, (real_2){0.0, enter}, 0.0, touching);
        margin -= (1.0 + cell.wind) * touching;
    }
    if (leave <= time) {
        touching = leave - (inner_enter < INFINITY ? inner_leave : enter);
        const real last = tangent_margin(u, between, cell, (real_2){leave, time}, touching, 0.0);
        margin = min_real(margin, last);
    } else if (inner_leave < time || inner_enter == INFINITY) {
        return -INFINITY;
    }
    return margin;
}

/* What is left between the outer arcs of LRL or RLR at a time, with a given T less twice its middle arc. */
static inline real middle_margin_at(integer u, Centres between, Cell cell, real outside, real time) {
    const real x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const real distance = length(x, y), half_middle = 0.25 * (time - outside);
    if (half_middle <= 0.0 || half_middle >= 3.141592653589793 || distance <= between.change) {
        return -INFINITY;
    }
    const real turning = cell.fastest_turning;
    const real across = sin(half_middle), along = cos(half_middle), nearest = distance - between.change;
    const real slope = along * (real)u * cell.turning + (x * between.dx + y * between.dy) / distance;
    const real bend = 0.25 * turning * turning + cell.twist + cell.bend + between.fastest * between.fastest /
            nearest;
    const real value = 4.0 * across - distance;
    real margin = least_inside(value, slope, bend, cell.half);
    if (margin < 0.0) {
        real curvature = -distance_curvature(x / distance, y / distance, distance, between);
        curvature -= 0.25 * across * cell.turning * cell.turning + along * (real)u * cell.turned_more;
        real change = distance_curvature_change(nearest, 0.0, between, cell);
        change += (0.0625 * turning * turning + 0.75 * cell.twist) * turning + cell.jerk;
        margin = max_real(margin, least_inside_curved(value, slope, curvature, change, cell.half));
    }
    return margin;
}

/* The margin of LRL or RLR with a given T less twice its middle arc, of which the middle may last longer.
 *
 * A word that does not join before a later time does not join before this time either.
 */
static inline real middle_margin(integer u, Centres between, Cell cell, real outside, real time) {
    real margin = middle_margin_at(u, between, cell, outside, time);
    if (margin < 0.0) {
        const real x = between.x - cell.wx * time, y = between.y - cell.wy * time;
        const real distance = length(x, y);
        if (distance > 0.0) {
            const real growth = cos(0.25 * (time - outside)) + (x * cell.wx + y * cell.wy) / distance;
            if (growth > 0.0) {
                const real later = growth / (0.25 + cell.wind * cell.wind / distance);
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
static inline bool has_no_middle(Centres between, Cell cell, real outside, real time) {
    const real wx = cell.wx, wy = cell.wy;
    const real wind = cell.wind;
    const real turned = cell.fastest_turning * cell.half;
    real low = acos(wind * wind);
    real high = min_real(TWO_PI - low, 0.5 * (time - outside + turned));
    /* How far the centres move relative to each other inside the cell, for a given middle arc. */
    const real shift = between.change + wind * turned;
    const real needed = (8.0 + 3.0 * shift) * shift;
    for (integer pass_1 = 0; pass_1 < TANGENTS; pass_1++) {
        if (low > high) {
            return true;
        }
        const real m = 0.5 * (low + high);
        const real x = between.x - wx * (outside + 2.0 * m), y = between.y - wy * (outside + 2.0 * m);
        const real across = sin(0.5 * m), along = cos(0.5 * m);
        const real spare = x * x + y * y - 16.0 * across * across - needed;
        const real slope = -4.0 * (wx * x + wy * y) - 16.0 * across * along;
        if (spare <= 0.0) {
            return false;
        }
        /* By the tangent, h is large enough on the side to which it rises, and for some way to the other side. */
        if (slope > 0.0) {
            high = m - spare / slope;
        } else if (slope < 0.0) {
            low = m - spare / slope;
        } else {
            return true;
        }
    }
    return false;
}

/* Whether LRL or RLR with a given T less twice its middle arc has an arc below zero throughout the cell. */
static inline bool lrl_rlr_needs_turn(integer u, Centres between, Cell cell, real outside) {
    const real wx = cell.wx, wy = cell.wy;
    const real wind = cell.wind, turned = cell.fastest_turning * cell.half;
    const real middle = middle_arc(between.x - wx * outside, between.y - wy * outside, wx, wy, (real_2){0.0,
            INFINITY});
    if (middle == INFINITY) {
        return false;
    }
    const real time = outside + 2.0 * middle;
    const real x = between.x - wx * time, y = between.y - wy * time;
    const real distance = length(x, y);
    const real slope = -4.0 * (wx * x + wy * y) - 8.0 * sin(middle);
    const real shift = between.change + wind * turned;
    /* Near its root, h changes by up to `rise` inside the cell. Its second derivative is at most 16, so the root moves */
    /* by less than twice `rise` over the slope, as long as that does not exceed a sixteenth of the slope. */
    const real rise = (2.0 * distance + 0.25 * wind * slope + shift) * shift;
    if (32.0 * rise >= slope * slope || slope <= 0.0) {
        return false;
    }
    const real longer = 2.0 * rise / slope;
    const real moved = shift + 2.0 * wind * longer;
    if (moved >= distance) {
        return false;
    }
    const real swing = 0.5 * 3.141592653589793 * moved / distance + 0.5 * longer;
    const Ends ends = (Ends){cell.c0, cell.s0, cell.c, cell.s, wx, wy, 0.0};
    const Path path = three_arcs(u, middle, x, y, ends);
    const real first = min_real(path.t1, TWO_PI - path.t1), last = min_real(path.t3, TWO_PI - path.t3);
    return path.time - time > 3.141592653589793 && first > swing && last > swing + turned;
}

/* The margin of LRL (u = +1) or RLR: what is left between its outer arcs once the middle one lasts long enough.
 *
 * Paths whose T less twice the middle arc is `known`, within half a turn, are left out.
 */
static inline real lrl_rlr_margin(integer u, Cell cell, real time, real known) {
    const Centres between = centres(u, u, cell);
    const real turned = cell.fastest_turning * cell.half;
    const real_2 time_within_1 = time_within(between.x, between.y, cell.wx, cell.wy, 4.0 + between.change);
    const real enter = time_within_1.a0;
    if (enter >= time) {
        return INFINITY;
    }
    const real arcs = lowest_turn(angle(arc_rotation(u, cell.c0, cell.s0, cell.c, cell.s)), turned);
    const real shortest = 2.0 * acos(cell.wind);
    const real each_turns_1[4] = {-1.0, 0.0, 1.0, 2.0};
    for (int i_1 = 0; i_1 < 4; i_1++) {
        const real turns = each_turns_1[i_1];
        const real outside = arcs + TWO_PI * turns;
        if (fabs(outside - known) < 3.141592653589793) {
            continue;
        }
        real late = max_real(max_real(outside - turned + 2.0 * shortest, -outside - turned), shortest) - time;
        if (late < 0.0) {
            late = middle_margin(u, between, cell, outside, time);
        }
        if (late < 0.0 && !(has_no_middle(between, cell, outside, time) || lrl_rlr_needs_turn(u, between, cell,
                outside))) {
            return late;
        }
    }
    return INFINITY;
}

/* Those of a set of words that may join before a time inside the cell with this middle and half width. */
static inline integer words_inside(real phase, real half, integer words, integer side, WindScene scene, real time) {
    const Cell cell = cell_at(phase, half, side, scene);
    integer impossible = 0;
    if (is_out_of_reach(cell, scene.R, time)) {
        return 0;
    }
    const integer each_u_1[2] = {1, -1};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const integer u = each_u_1[i_1];
        const integer lsl = set_of(encode(u, 0, u)), lsr = set_of(encode(u, 0, -u)), lrl = set_of(encode(u, -u, u));
        if ((words & lsl) != 0 && lsl_rsr_margin(u, cell, time) >= 0.0) {
            impossible |= lsl;
        }
        if ((words & lsr) != 0 && lsr_rsl_margin(u, cell, time) >= 0.0) {
            impossible |= lsr;
        }
        if ((words & lrl) != 0 && lrl_rlr_margin(u, cell, time, INFINITY) >= 0.0) {
            impossible |= lrl;
        }
    }
    return (words & ~impossible);
}

/* An angle, in [-pi, pi). */
static inline real wrap(real angle) {
    return real_modulo(angle + 3.141592653589793, TWO_PI) - 3.141592653589793;
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
static inline Path_real path_to_end(CellVisit visit, integer side, WindScene scene, WindCandidate best) {
    const real_2 middle_of_1 = middle_of(visit);
    const real middle = middle_of_1.a0, half = middle_of_1.a1;
    const real within = hold_time(middle + half, 2.0 * half, side, scene.R, scene.wx, scene.wy);
    return (Path_real){first_path(middle + half, side, scene, best.path.time + within), within};
}

/* Whether the time has a local minimum in the leaf that ends at `after`; `before` is the end of an earlier leaf. */
static inline bool has_minimum(LeafEnd before, LeafEnd after) {
    const bool rises = after.point.slope > 0.0, later = after.point.path.time > before.point.path.time;
    if (before.number != after.number - 1) {
        return rises;
    }
    return (before.point.slope < 0.0 && (rises || later)) || (rises && !later);
}

/* The words that may still join inside a cell early enough; the last leaf's end; the point to refine, or none.
 *
 * A path that joins inside the cell can follow the circle to the cell's end. So no path into the cell is faster
 * than the first path to its end less the time to hold the circle through the cell.
 */
static inline integer_LeafEnd_JoinPoint examine_cell(CellVisit visit, integer words, integer side, WindScene scene,
        LeafEnd before, WindCandidate best) {
    const real_2 middle_of_1 = middle_of(visit);
    const real middle = middle_of_1.a0, half = middle_of_1.a1;
    const bool holds_best = side == best.side && fabs(wrap(best.phase - middle)) <= half;
    if (visit.level < LEAF && holds_best) {
        return (integer_LeafEnd_JoinPoint){words, before, NO_POINT};
    }
    const Path_real path_to_end_2 = path_to_end(visit, side, scene, best);
    const Path path = path_to_end_2.a0;
    if (path.time == INFINITY) {
        return (integer_LeafEnd_JoinPoint){0, before, NO_POINT};
    }
    if (visit.level < LEAF) {
        return (integer_LeafEnd_JoinPoint){words, before, NO_POINT};
    }
    const LeafEnd after = (LeafEnd){visit.number, (JoinPoint){middle + half, path, join_slope(path, middle + half,
            side, scene)}};
    if (holds_best || !has_minimum(before, after)) {
        return (integer_LeafEnd_JoinPoint){words, after, NO_POINT};
    }
    const bool adjoins = before.number == after.number - 1;
    return (integer_LeafEnd_JoinPoint){words, after, adjoins && before.point.path.time < path.time ? before.point :
            after.point};
}

/* A set of leaves and one more, by its number. */
static inline Leaves with_leaf(Leaves leaves, integer number) {
    const integer first = leaves.first, second = leaves.second, third = leaves.third, fourth = leaves.fourth;
    const integer quarter = integer_quotient(number, LEAVES), leaf = shift_left(1, integer_modulo(number, LEAVES));
    if (quarter == 0) {
        return (Leaves){(first | leaf), second, third, fourth};
    }
    if (quarter == 1) {
        return (Leaves){first, (second | leaf), third, fourth};
    }
    if (quarter == 2) {
        return (Leaves){first, second, (third | leaf), fourth};
    }
    return (Leaves){first, second, third, (fourth | leaf)};
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
    while (left > 0 && start.path.time == INFINITY && visit.number < shift_left(FIRST_CELLS, visit.level)) {
        left -= 1;
        const real_2 middle_of_1 = middle_of(visit);
        integer words = words_inside(middle_of_1.a0, middle_of_1.a1, (visit.words & ALL_WORDS), side, scene,
                best.path.time);
        if (words != 0 && visit.level >= COARSE) {
            const integer_LeafEnd_JoinPoint examine_cell_2 = examine_cell(visit, words, side, scene, before, best);
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
    if (start.path.time < INFINITY) {
        search->refinement = refinement_from(start, side, TWO_PI / (real)shift_left(FIRST_CELLS, LEAF));
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
static inline real time_tolerance(WindCandidate best, WindScene scene) {
    return WIND_TIE_TOLERANCE * (1.0 + scene.R + best.path.time);
}

/* The tolerance after `MOST_VISITS` cells: an upper bound on the time to hold the circle through `UNKNOWN_ARC`. */
static inline real hold_tolerance(WindScene scene) {
    return scene.R / (1.0 - length(scene.wx, scene.wy)) * UNKNOWN_ARC;
}

/* The two arcs of which the best path consists, up to rounding; `NO_CORNER` for another path. */
static inline Corner corner_of(WindCandidate best, WindScene scene) {
    Entry arcs = two_arc_entry(best, SHORT);
    if (arcs.word != 0) {
        const Entry_real fit_two_arcs_1 = fit_two_arcs(arcs, best.phase, scene);
        arcs = fit_two_arcs_1.a0;
        const real phase = fit_two_arcs_1.a1;
        if (is_close(arcs, phase, best.path.time, scene)) {
            const integer_3 controls_2 = controls(arcs.word);
            const integer u = controls_2.a0;
            return (Corner){phase, u, arcs.t1, arcs.t2};
        }
    }
    return NO_CORNER;
}

/* Whether LSR or RSL joins nowhere in the cell more than `longest` before the time of the corner.
 *
 * And whether its arcs remain shorter than a turn.
 */
static inline bool is_late_before(Centres between, Cell cell, real longest, Corner corner) {
    const integer u = corner.u;
    const real t1 = corner.t1, t2 = corner.t2;
    const real time = t1 + t2, change = between.change, wind = cell.wind;
    const real_2 time_within_1 = time_within(between.x, between.y, cell.wx, cell.wy, 2.0 + 2.0 * change);
    const real enter = time_within_1.a0;
    const real apart = change + wind * longest;
    const real arc = max_real(t1, t2 + cell.fastest_turning * cell.half) + acos(2.0 / (2.0 + apart)) + 0.5 * TURNS *
            apart;
    if (enter > 0.0 && enter >= time - longest) {
        /* The centres come closer until then: the arcs change in one sense. */
        const real_3 tangent_2 = tangent(u, between.x - cell.wx * time, between.y - cell.wy * time);
        const real p1 = tangent_2.a1, p2 = tangent_2.a2;
        const real_3 tangent_3 = tangent(u, between.x, between.y);
        const real q1 = tangent_3.a1, q2 = tangent_3.a2;
        return arc + max_real((real)u * atan2(p1 * q2 - p2 * q1, p1 * q1 + p2 * q2), 0.0) < TWO_PI;
    }
    if (arc >= TWO_PI || change >= 2.0) {
        return false;
    }
    const real_2 time_within_4 = time_within(between.x, between.y, cell.wx, cell.wy, 2.0 - change);
    const real inner_enter = time_within_4.a0, inner_leave = time_within_4.a1;
    if (inner_enter == INFINITY || inner_leave < time - longest || (enter == 0.0 && inner_enter > 0.0)) {
        return false;
    }
    if (inner_enter == 0.0) {
        return true;
    }
    const real touching = inner_enter - enter;
    return tangent_margin(u, between, cell, (real_2){0.0, enter}, 0.0, touching) >= (1.0 + wind) * touching;
}

/* Whether LSR (u = +1) or RSL is never faster than the two arcs inside the cell around their point of joining.
 *
 * Let v be the angle by which the line of centres has turned since the corner. With the straight piece in the
 * direction that it has at the corner, the length would exceed the true one by v^3/3 at most. Where the circles
 * touch, it would be less than the true one by that much at most.
 */
static inline bool straight_vanishes(Corner corner, Cell cell) {
    const integer u = corner.u;
    const real t1 = corner.t1, t2 = corner.t2;
    const real time = t1 + t2, half = cell.half, wind = cell.wind;
    const Centres between = centres(u, -u, cell);
    const real x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const real_3 tangent_1 = tangent(u, x, y);
    const real p1 = tangent_1.a1, p2 = tangent_1.a2;
    const real slope = p1 * between.dx + p2 * between.dy - (real)u * cell.turning, fall = 1.0 + cell.wx * p1 +
            cell.wy * p2;
    const real steep = fabs(slope), curvature = p1 * between.ddx + p2 * between.ddy - (real)u * cell.turned_more;
    /* v is at most TURNS (|D'| x + |w| s)/2, and (a + b)^3 <= 4 (a^3 + b^3). For s up to `longest` the second cube is */
    /* less than a sixth of `fall` s. */
    const real windy = CUBE * wind * wind * wind;
    const real longest = 1.5 * windy <= fall ? 0.5 : sqrt(fall / (6.0 * windy));
    real change = (cell.bend_change + cell.jerk) / 6.0;
    const real cube = CUBE * between.fastest * between.fastest * between.fastest;
    const real slack = (max_real(-0.5 * curvature, 0.0) + (cube + change) * half) * half;
    real latest = 1.2 * (steep + slack) / fall;
    if (steep <= slack || latest * half > longest || between.fastest * half > 0.5) {
        return false;
    }
    /* The least and the largest s over x, on the side where the word would be faster. */
    const real moved = between.fastest + wind * latest;
    change += 0.25 * CUBE * moved * moved * moved;
    const real shortest = (steep - (max_real(0.5 * curvature, 0.0) + change * half) * half) / fall;
    latest = min_real(latest, (steep + (max_real(-0.5 * curvature, 0.0) + change * half) * half) / fall);
    /* How the square of the distance of the centres changes with x there: the circles must overlap. */
    const real drift = 2.0 * (x * cell.wx + y * cell.wy);
    real apart = 2.0 * (x * between.dx + y * between.dy);
    apart = max_real(drift * shortest, drift * latest) - (slope > 0.0 ? apart : -apart);
    if (shortest < 0.0 || apart + (2.0 * cell.bend + moved * moved) * half >= 0.0) {
        return false;
    }
    return is_late_before(between, cell, longest, corner);
}

/* Whether LRL (u = +1) or RLR is never faster than the two arcs inside the cell around their point of joining.
 *
 * `first` is +1 where its first arc vanishes, -1 where its last does; `middle` and `other` are the durations of the
 * remaining arcs.
 */
static inline bool arc_vanishes(integer u, integer first, real middle, real other, Corner corner, Cell cell) {
    const real time = corner.t1 + corner.t2, half = cell.half, wind = cell.wind;
    const Centres between = centres(u, u, cell);
    real x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const real distance = length(x, y), along = cos(0.5 * middle);
    if (distance == 0.0) {
        return false;
    }
    x = x / distance;
    y = y / distance;
    const real slope = -along * (real)u * cell.turning - x * between.dx - y * between.dy;
    const real fall = -along - x * cell.wx - y * cell.wy, steep = fabs(slope);
    if (fall <= 0.0) {
        return lrl_rlr_margin(u, cell, time, INFINITY) >= 0.0;
    }
    if (steep == 0.0) {
        return false;
    }
    const real latest = 2.0 * steep / fall;
    const real rate = between.fastest + wind * latest, nearest = distance - between.change - wind * latest * half;
    const real turning = cell.fastest_turning;
    const real sweep = 0.5 * (turning + latest) * half;
    if (nearest <= 0.0 || !(sweep < middle && middle < TWO_PI - sweep)) {
        return false;
    }
    const real bend = 0.25 * (turning + latest) * (turning + latest) + cell.twist + cell.bend + rate * rate /
            nearest;
    const real spare = 0.5 * bend * half;
    const real swing = (turning + rate / nearest + 0.25 * latest) * half;
    if (spare > steep || swing > SWING || other + swing >= TWO_PI) {
        return false;
    }
    /* How the arc that vanishes changes along x, on the side where the word would be faster. */
    const real turned = (real)u * (x * between.dy - y * between.dx) / distance;
    const real drift = (real)-u * (x * cell.wy - y * cell.wx) / distance;
    const real growth = (real)first * turned - 0.25 * (real)u * cell.turning + (first < 0 ? (real)u * cell.turning :
            0.0);
    const real sooner = (real)first * drift + 0.25;
    const real sign = slope > 0.0 ? 1.0 : -1.0;
    const real longer = -sign * growth - min_real(sooner * (steep - spare), sooner * (steep + spare)) / fall;
    if (longer + 0.5 * (cell.twist + cell.bend / nearest + rate * rate / (nearest * nearest)) * half >= 0.0) {
        return false;
    }
    return lrl_rlr_margin(u, cell, time, time - 2.0 * middle) >= 0.0;
}

/* Those of a set of words that may be faster than two arcs within a distance of their point of joining. */
static inline integer words_beside(Corner corner, real reach, integer words, integer side, WindScene scene) {
    const Cell cell = cell_at(corner.phase, reach, side, scene);
    integer impossible = 0;
    const integer u = corner.u;
    const integer lsr = set_of(encode(u, 0, -u)), lrl = set_of(encode(u, -u, u)), rlr = set_of(encode(-u, u, -u));
    if ((words & lsr) != 0 && straight_vanishes(corner, cell)) {
        impossible |= lsr;
    }
    if ((words & lrl) != 0 && arc_vanishes(u, -1, corner.t2, corner.t1, corner, cell)) {
        impossible |= lrl;
    }
    if ((words & rlr) != 0 && arc_vanishes(-u, 1, corner.t1, corner.t2, corner, cell)) {
        impossible |= rlr;
    }
    return (words & ~impossible);
}

/* Those of a set of words that may join before a time inside a cell next to the end of the best path.
 *
 * Around a local minimum, bounds hold in a neighbourhood that does not depend on how small cells are.
 */
static inline integer words_beside_best(CellVisit visit, integer words, WindScene scene, WindCandidate best, Corner
        corner, real sooner) {
    const real_2 middle_of_1 = middle_of(visit);
    const real middle = middle_of_1.a0, half = middle_of_1.a1;
    real reach = fabs(wrap(best.phase - middle)) + half;
    if (reach <= NEAR_BEST * half) {
        if (corner.u != 0) {
            reach = fabs(wrap(corner.phase - middle)) + half;
            words = words_beside(corner, reach, words, best.side, scene);
        } else {
            words = words_inside(best.phase, reach, words, best.side, scene, sooner);
        }
    }
    return words;
}

/* The time before which no path joins in a cell, as in `examine_cell`; the path to its end if it is faster. */
static inline real_WindCandidate compare_at_end(CellVisit visit, integer side, WindScene scene, WindCandidate best)
        {
    const real_2 middle_of_1 = middle_of(visit);
    const real middle = middle_of_1.a0, half = middle_of_1.a1;
    const Path_real path_to_end_2 = path_to_end(visit, side, scene, best);
    const Path path = path_to_end_2.a0;
    const real within = path_to_end_2.a1;
    return (real_WindCandidate){path.time - within, (WindCandidate){middle + half, path.time < best.path.time ? side
            : 0, path}};
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
        const real tolerance = visits <= MOST_VISITS ? time_tolerance(best, scene) : hold_tolerance(scene);
        const real sooner = best.path.time - tolerance;
        const real_2 middle_of_1 = middle_of(visit);
        integer words = words_inside(middle_of_1.a0, middle_of_1.a1, (visit.words & ALL_WORDS), side, scene,
                sooner);
        if (words != 0 && side == best.side) {
            if (best.path.time < compared) {
                corner = corner_of(best, scene);
                compared = best.path.time;
            }
            words = words_beside_best(visit, words, scene, best, corner, sooner);
        }
        if (words != 0 && integer_modulo(LAST - visit.level, 2) == 0 && visit.level > LEAF) {
            const real_WindCandidate compare_at_end_2 = compare_at_end(visit, side, scene, best);
            const real earliest = compare_at_end_2.a0;
            start = compare_at_end_2.a1;
            cell = (OpenCell){words, earliest, tolerance};
            if (start.side == 0 && is_done(visit, cell, best)) {
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
        search->refinement = begin_refinement(start, 2.0 * half, scene);
        return;
    }
    if (visit.number < shift_left(FIRST_CELLS, visit.level)) {
        return;
    }
    next_stage(search);
    return;
}

/* The search after at most `steps` more steps, each of which takes about as long as trying one point of joining. */
static inline void advance_search(WindSearch *search, integer steps) {
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

/* The fastest maneuver onto the circle, or beside it within the tolerance; nan, with a status, where there is none.
 *
 * docs/wind.md, section 5, bounds by how much another maneuver could be faster, and says how the answer is found
 * and checked. The status is `Status.NOT_CONVERGED` where the maneuver, flown exactly, does not end on the circle.
 */
static inline WindEntry wind_search_fastest(WindProblem problem) {
    WindSearch changed_1 = begin_search(problem);
    advance_search(&changed_1, UNLIMITED);
    return changed_1.entry;
}

/* Write the times of the first paths to `SAMPLES` points around the circle. */
static inline void sampled_times(integer side, WindScene scene, real *times) {
    for (integer i = 0; i < SAMPLES; i++) {
        times[i] = first_path(TWO_PI / (real)SAMPLES * (real)i, side, scene, INFINITY).time;
    }
}

/* Whether the time of sample i is no greater than those beside it. */
static inline bool is_local_minimum(real *times, integer i) {
    return times[i] < INFINITY && times[i] <= min_real(times[integer_modulo(i - 1, SAMPLES)], times[integer_modulo(i
            + 1, SAMPLES)]);
}

/* The local minimum of the time next to a candidate, where the slope changes its sign or the time jumps.
 *
 * Only the words of the two points that enclose the minimum are tried, until all are at the end.
 */
static inline WindCandidate refined_minimum(WindCandidate found, real width, WindScene scene) {
    Refinement refinement = begin_refinement(found, width, scene);
    while (refinement.stage != REFINED) {
        refine(&refinement, scene);
    }
    return minimum_of(&refinement);
}

/* The maneuver at the local minimum next to sample i. */
static inline WindEntry entry_near_sample(integer i, integer side, WindScene scene) {
    const real phase = TWO_PI / (real)SAMPLES * (real)i, width = TWO_PI / (real)SAMPLES;
    const WindCandidate start = (WindCandidate){phase, side, first_path(phase, side, scene, INFINITY)};
    return wind_entry(refined_minimum(start, width, scene), scene);
}

/* E(p | w^2) for any p and 0 <= w < 1, by arithmetic and geometric means (Abramowitz and Stegun, 17.6). */
static inline real elliptic(real p, real w) {
    real a = 1.0, b = sqrt((1.0 - w) * (1.0 + w)), c = w;
    real squares = 0.5 * c * c, sines = 0.0, power = 1.0;
    for (integer pass_1 = 0; pass_1 < MEANS; pass_1++) {
        /* The arctangent's branch follows p, so that p doubles with each step. It is that of the rounded tangent, whose */
        /* sign is either one where p is an odd multiple of pi/2. */
        const real slope = tan(p);
        p = p + atan(b / a * slope) + 3.141592653589793 * floor((p - atan(slope)) / 3.141592653589793 + 0.5);
        const real new_a = 0.5 * (a + b);
        const real new_b = sqrt(a * b);
        const real new_c = 0.5 * (a - b);
        a = new_a;
        b = new_b;
        c = new_c;
        power = 2.0 * power;
        squares = squares + 0.5 * power * c * c;
        sines = sines + c * sin(p);
    }
    return p / (power * a) * (1.0 - squares) + sines;
}

/* The time to hold the circle from `phase` - `width` (zero or more) to `phase`. */
static inline real time_held(real phase, real width, real R, real wx, real wy) {
    const real wind = length(wx, wy);
    const real before = phase - width;
    if (wind == 0.0) {
        return R * width;
    }
    const real along = 2.0 * wind * cos(0.5 * (phase + before)) * sin(0.5 * width);
    return R * (elliptic(phase, wind) - elliptic(before, wind) + along) / ((1.0 - wind) * (1.0 + wind));
}

/* A width before which the slot is out of reach. */
static inline real begin_width(Slot slot, WindScene scene) {
    const real x = scene.x, y = scene.y, R = scene.R, wx = scene.wx, wy = scene.wy;
    const real square = x * x + y * y - R * R;
    if (square <= 0.0) {
        return 0.0;
    }
    /* The circle is out of reach while |q + w t| > t + R. */
    const real spare = 1.0 - wx * wx - wy * wy, half = R - (x * wx + y * wy);
    const real root = sqrt(half * half + spare * square);
    const real time = half > 0.0 ? square / (root + half) : (root - half) / spare;
    if (wx == 0.0 && wy == 0.0) {
        return time / R;
    }
    const real wind = length(wx, wy);
    real least = (1.0 - wind) * time / R, most = (1.0 + wind) * time / R;
    for (integer pass_1 = 0; pass_1 < BEGIN_HALVINGS; pass_1++) {
        const real middle = 0.5 * (least + most);
        if (time_held(slot.phase + middle, middle, R, wx, wy) < time) {
            least = middle;
        } else {
            most = middle;
        }
    }
    return least;
}

/* The angle between the heading and the track of a hold at a phase, zero against the wind. */
static inline real crab_angle(real phase, real wx, real wy) {
    const real across = length(wx, wy) * sin(phase);
    return atan2(across, sqrt((1.0 - across) * (1.0 + across)));
}

/* The slot after an angle of the circle. */
static inline SlotPose slot_pose(real width, Slot slot, WindScene scene) {
    const real wx = scene.wx, wy = scene.wy;
    const real phase = slot.phase + width;
    const real_5 hold_pose_1 = hold_pose(phase, slot.side, scene.R, wx, wy);
    const real px = hold_pose_1.a0, py = hold_pose_1.a1, c = hold_pose_1.a2, s = hold_pose_1.a3, g = hold_pose_1.a4;
    const real time = time_held(phase, width, scene.R, wx, wy);
    const real crab = g - (wx * (c + wx) + wy * (s + wy)) / g;
    const real turned = width - (crab_angle(phase, wx, wy) - crab_angle(slot.phase, wx, wy));
    return (SlotPose){width, time, px - wx * time - scene.x, py - wy * time - scene.y, c, s, scene.R / g, g / crab,
            turned};
}

/* The bounds next to a width. */
static inline Bounds bounds_at(integer last, SlotPose pose, Slot slot, WindScene scene) {
    const real wind = length(scene.wx, scene.wy);
    const real twist = wind / sqrt((1.0 - wind) * (1.0 + wind));
    real step = 1.0, advance = pose.advance;
    if (wind > 0.0) {
        step = min_real(GROWTH / twist, 1.0);
        advance = advance * exp(min_real(GROWTH, twist));
    }
    const real speed = max_real(advance + (last == slot.side ? 1.0 + wind : wind - 1.0), 0.0);
    return (Bounds){step, speed, twist * (advance + 1.0), 1.0 + wind};
}

/* The slot at a width before which it is out of reach: further away than the time. */
static inline SlotPose first_within_reach(Slot slot, WindScene scene) {
    SlotPose pose = slot_pose(begin_width(slot, scene), slot, scene);
    for (integer pass_1 = 0; pass_1 < APPROACHES; pass_1++) {
        const real gap = length(pose.x, pose.y) - pose.time;
        if (gap <= NEAR) {
            break;
        }
        const Bounds limits = bounds_at(0, pose, slot, scene);
        /* The distance falls at most as fast as the time grows: the slot flies at the speed 1 through the air. */
        const real advance = limits.speed + 1.0;
        pose = slot_pose(pose.width + min_real(0.5 * gap / advance, limits.step), slot, scene);
    }
    return pose;
}

/* The path that takes less time: a where they tie. */
static inline WindCandidate earlier(WindCandidate a, WindCandidate b) {
    return b.path.time < a.path.time ? b : a;
}

/* V, the derivative of the way of the centre of the last arc. */
static inline real centre_speed(integer last, SlotPose pose, Slot slot) {
    return max_real(pose.advance + (real)(last * slot.side) * pose.turning, 0.0);
}

/* An angle less whole turns, in [-pi, pi]. */
static inline real less_whole_turns(real excess) {
    return excess - TWO_PI * floor(excess / TWO_PI + 0.5);
}

/* The excess of the word with the first control u, a straight piece and the control `last`. */
static inline Excess excess_at(integer u, integer last, SlotPose pose, Slot slot, WindScene scene) {
    const real c0 = scene.c, s0 = scene.s, c = pose.c, s = pose.s;
    const real dx = pose.x - (real)last * s + (real)u * s0, dy = pose.y + (real)last * c - (real)u * c0;
    const real speed = centre_speed(last, pose, slot);
    const real along = dx * c + dy * s;
    real straight, arcs, ahead;
    if (u == last) {
        straight = length(dx, dy);
        arcs = angle(arc_rotation(u, c0, s0, c, s));
        ahead = straight > 0.0 ? along / straight : 1.0;
        return (Excess){less_whole_turns(straight + arcs - pose.time), -speed * (1.0 - ahead), 1.0, 0.0};
    }
    const real apart = dx * dx + dy * dy - 4.0, apart_slope = 2.0 * speed * along;
    if (apart <= -2.0) {
        return (Excess){NAN, 0.0, apart, apart_slope};
    }
    const real_3 tangent_1 = tangent(u, dx, dy);
    straight = tangent_1.a0;
    const real q1 = tangent_1.a1, q2 = tangent_1.a2;
    const real_2 arc_rotation_2 = arc_rotation(u, c0, s0, q1, q2);
    const real across1 = arc_rotation_2.a0, along1 = arc_rotation_2.a1;
    const real_2 arc_rotation_3 = arc_rotation(last, q1, q2, c, s);
    const real across2 = arc_rotation_3.a0, along2 = arc_rotation_3.a1;
    arcs = atan2(across1 * along2 + along1 * across2, along1 * along2 - across1 * across2);
    ahead = min_real(q1 * c + q2 * s, 1.0);
    return (Excess){less_whole_turns(straight + arcs - pose.time), -speed * (1.0 - ahead), apart, apart_slope};
}

/* The shortest path of a word with a straight piece to the slot. */
static inline Path pieces_with_straight(integer u, integer last, SlotPose pose, WindScene scene) {
    const real c0 = scene.c, s0 = scene.s, c = pose.c, s = pose.s;
    const real dx = pose.x - (real)last * s + (real)u * s0, dy = pose.y + (real)last * c - (real)u * c0;
    real straight, q1, q2;
    if (u == last) {
        straight = length(dx, dy);
        const bool chosen_1 = straight > 0.0;
        q1 = chosen_1 ? dx / straight : c0;
        q2 = chosen_1 ? dy / straight : s0;
    } else {
        const real_3 tangent_2 = tangent(u, dx, dy);
        straight = tangent_2.a0;
        q1 = tangent_2.a1;
        q2 = tangent_2.a2;
    }
    real first = arc_time(arc_rotation(u, c0, s0, q1, q2), 1.0 + straight, scene.arc_tolerance);
    real third = arc_time(arc_rotation(last, q1, q2, c, s), 1.0, scene.arc_tolerance);
    if (u == last) {
        const real arcs = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, scene.arc_tolerance);
        if (first + third > arcs + 3.141592653589793) {
            first = first_of_same_turns(first, arcs, straight, scene.arc_tolerance);
            third = first <= arcs ? arcs - first : third;
        }
    }
    return (Path){first + straight + third, encode(u, 0, last), first, straight, third, 1.0, q1, q2};
}

/* The path with whole turns added to its first arc, so that it takes the time of the slot; `NO_PATH` if longer. */
static inline Path with_turns(Path path, SlotPose pose) {
    const real turns = floor((pose.time - path.time) / TWO_PI + 0.5);
    if (turns < 0.0) {
        return NO_PATH;
    }
    Path changed_1 = path;
    changed_1.time = path.time + TWO_PI * turns;
    changed_1.t1 = path.t1 + TWO_PI * turns;
    return changed_1;
}

/* The path of a word with a straight piece to the slot, with as many whole turns first as the time leaves. */
static inline Path path_with_straight(integer u, integer last, SlotPose pose, WindScene scene) {
    return with_turns(pieces_with_straight(u, last, pose, scene), pose);
}

/* Bounds on the second derivative of |d|^2 where |d| is at most `distance`. */
static inline Bends bends_of_square(integer u, real distance, Bounds limits, WindScene scene) {
    const real general = 2.0 * (limits.speed * limits.turning + limits.speed_change) * distance, rise = 2.0 *
            limits.speed * limits.speed;
    if (limits.speed_change > 0.0) {
        return (Bends){general, general + rise, INFINITY};
    }
    /* In still air the last centre moves round the circle's: the square is a constant and a cosine. */
    return (Bends){general, general + rise, 2.0 * limits.speed * length(scene.x - (real)u * scene.s, scene.y +
            (real)u * scene.c)};
}

/* How far a function cannot come down to zero that has this value and derivative, if its second is >= -`bend`. */
static inline real step_without_zero(real value, real slope, real bend) {
    if (bend <= 0.0 && slope >= 0.0) {
        return INFINITY;
    }
    return 2.0 * value / (sqrt(slope * slope + 2.0 * bend * value) - slope);
}

/* A step within which the excess falls by at most half a turn, and LSR and RSL neither begin nor cease to exist. */
static inline real step_of_excess(integer u, integer last, Excess excess, Bounds limits, WindScene scene, real
        length_tolerance) {
    real step = limits.step;
    if (limits.speed > 0.0) {
        step = min_real(step, 0.5 * 3.141592653589793 / limits.speed);
    }
    if (u == last) {
        return step;
    }
    const real distance = sqrt(max_real(excess.apart + 4.0, 0.0)) + limits.speed * step;
    const Bends bends = bends_of_square(u, distance, limits, scene);
    const real low = min_real(bends.down, bends.size), high = min_real(bends.up, bends.size);
    if (fabs(excess.apart) <= length_tolerance) {
        return min_real(step, max_real(high > 0.0 ? fabs(excess.apart_slope) / high : step, DOUBLE_ROOT));
    }
    if (excess.apart > 0.0) {
        return min_real(step, step_without_zero(excess.apart, excess.apart_slope, low));
    }
    return min_real(step, step_without_zero(-excess.apart, -excess.apart_slope, high));
}

/* The slot where the excess has a value, between a pose where it is not less and one where it is. */
static inline SlotPose root_of_excess(integer u, integer last, SlotPose a, SlotPose b, Slot slot, WindScene scene,
        real level) {
    real least = a.width, most = b.width;
    real width = 0.5 * (least + most);
    SlotPose best = a;
    real best_value = INFINITY;
    for (integer i = 0; i < ROOT_STEPS; i++) {
        const SlotPose pose = slot_pose(width, slot, scene);
        const Excess excess = excess_at(u, last, pose, slot, scene);
        const real value = excess.value - level;
        if (fabs(value) < best_value) {
            best = pose;
            best_value = fabs(value);
        }
        if (value >= 0.0) {
            least = width;
        } else {
            most = width;
        }
        const real newton = excess.slope < 0.0 ? width - value / excess.slope : least;
        /* Every third step bisects, since Newton's method is slow at a triple root. */
        const bool is_newton = integer_modulo(i, 3) != 2 && (least < newton && newton < most);
        const real following = is_newton ? newton : 0.5 * (least + most);
        if (value == 0.0 || (following == width || following == least || following == most)) {
            break;
        }
        width = following;
    }
    return best;
}

/* The arrival where a word ceases to exist, between a pose to which it has a path and one to which it has none.
 *
 * An arc vanishes there, so that two words meet.
 */
static inline WindCandidate arrival_at_edge(integer u, integer last, SlotPose inside, SlotPose outside, Slot slot,
        WindScene scene) {
    real width = inside.width;
    Path path = path_with_straight(u, last, inside, scene);
    real beyond = outside.width;
    for (integer pass_1 = 0; pass_1 < ROOT_STEPS; pass_1++) {
        const real middle = 0.5 * (width + beyond);
        if (middle == width || middle == beyond) {
            break;
        }
        const Path nearer = path_with_straight(u, last, slot_pose(middle, slot, scene), scene);
        if (nearer.time < INFINITY) {
            width = middle;
            path = nearer;
        } else {
            beyond = middle;
        }
    }
    return (WindCandidate){slot.phase + width, slot.side, path};
}

/* The arrival at the root of the excess between two poses; `NO_PATH` where an arc falls short of zero there.
 *
 * Where words meet in a path without this arc, rounding must not make it fall short in all of them.
 */
static inline WindCandidate arrival_at_root(integer u, integer last, SlotPose a, SlotPose b, Slot slot, WindScene
        scene, real length_tolerance) {
    const SlotPose root = root_of_excess(u, last, a, b, slot, scene, 0.0);
    const Path pieces = pieces_with_straight(u, last, root, scene);
    const Path path = with_turns(pieces, root);
    if (path.time < INFINITY) {
        return (WindCandidate){slot.phase + root.width, slot.side, path};
    }
    const real short_ = min_real(TWO_PI - max_real(pieces.t1, pieces.t3), pieces.t2);
    if (short_ * short_ * short_ > EDGE * length_tolerance) {
        return (WindCandidate){0.0, slot.side, NO_PATH};
    }
    /* All poses between these two are roots up to rounding. */
    const real each_level_1[2] = {length_tolerance, -length_tolerance};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const real level = each_level_1[i_1];
        const SlotPose end_ = root_of_excess(u, last, a, b, slot, scene, level);
        if (path_with_straight(u, last, end_, scene).time < INFINITY) {
            return arrival_at_edge(u, last, end_, root, slot, scene);
        }
    }
    return (WindCandidate){0.0, slot.side, NO_PATH};
}

/* The first arrival by the word with these outer controls and a straight piece; `NO_PATH` for none by `until`. */
static inline WindCandidate first_with_straight(integer u, integer last, SlotPose begin, Slot slot, WindScene scene,
        real until_) {
    SlotPose pose = begin;
    const WindCandidate none = (WindCandidate){0.0, slot.side, NO_PATH};
    const real length_tolerance = 4.0 * scene.arc_tolerance;
    Excess excess = excess_at(u, last, pose, slot, scene);
    if (bounds_at(last, pose, slot, scene).speed <= ROUNDING) {
        /* The last arc is on the circle itself: the vehicle would have been in the slot before. */
        return none;
    }
    if (fabs(excess.value) <= length_tolerance && excess.apart >= -length_tolerance) {
        const Path path = path_with_straight(u, last, pose, scene);
        if (path.time < INFINITY) {
            return (WindCandidate){slot.phase + pose.width, slot.side, path};
        }
    }
    for (integer pass_1 = 0; pass_1 < MOST_STEPS; pass_1++) {
        if (pose.time > until_) {
            return none;
        }
        const Bounds limits = bounds_at(last, pose, slot, scene);
        const real step = step_of_excess(u, last, excess, limits, scene, length_tolerance);
        const SlotPose ahead = slot_pose(pose.width + step, slot, scene);
        const Excess excess_ahead = excess_at(u, last, ahead, slot, scene);
        const bool exists = excess.apart >= -length_tolerance && excess_ahead.apart >= -length_tolerance;
        if (exists && (excess.value >= 0.0 && 0.0 > excess_ahead.value) && excess.value - excess_ahead.value <=
                3.141592653589793 + 1.0) {
            const WindCandidate found = arrival_at_root(u, last, pose, ahead, slot, scene, length_tolerance);
            if (found.path.time < INFINITY) {
                return found;
            }
        }
        pose = ahead;
        excess = excess_ahead;
    }
    return (WindCandidate){0.0, slot.side, until_ == INFINITY ? GAVE_UP : NO_PATH};
}

/* The function for LRL (u = +1) or RLR: `half`, plus half the time less the heading's turn, is the middle arc. */
static inline Middle middle_at(integer u, real half, SlotPose pose, Slot slot, WindScene scene) {
    const real dx = pose.x - (real)u * (pose.s - scene.s), dy = pose.y + (real)u * (pose.c - scene.c);
    const real arc = half + 0.5 * (pose.time + (real)(u * slot.side) * pose.turned);
    const real across = sin(0.5 * arc);
    const real value = dx * dx + dy * dy - 16.0 * across * across;
    const real slope = centre_speed(u, pose, slot) * (2.0 * (dx * pose.c + dy * pose.s) - 4.0 * sin(arc));
    return (Middle){value, slope, arc - TWO_PI * floor(arc / TWO_PI), dx, dy};
}

/* The path of LRL or RLR to the slot, with as many whole turns first as the time leaves. */
static inline Path path_of_three_arcs(integer u, Middle middle, SlotPose pose, WindScene scene) {
    Ends ends = (Ends){scene.c, scene.s, pose.c, pose.s, scene.wx, scene.wy, scene.arc_tolerance};
    const Path path = with_turns(three_arcs(u, middle.arc, middle.dx, middle.dy, ends), pose);
    if (path.time < INFINITY) {
        return path;
    }
    /* An arc may fall short of zero by as much as counts as a root. */
    ends.arc_tolerance = THREE_ARCS * scene.arc_tolerance;
    return with_turns(three_arcs(u, middle.arc, middle.dx, middle.dy, ends), pose);
}

/* The first arrival by LRL (u = +1) or RLR; `halves` 0 or 1 chooses between middle arcs half a turn apart. */
static inline WindCandidate first_of_three_arcs(integer u, integer halves, SlotPose begin, Slot slot, WindScene
        scene, real until_) {
    const WindCandidate none = (WindCandidate){0.0, slot.side, NO_PATH};
    if (bounds_at(u, begin, slot, scene).speed <= ROUNDING) {
        return none;
    }
    const SlotPose origin = slot_pose(0.0, slot, scene);
    SlotPose pose = begin;
    const real length_tolerance = THREE_ARCS * scene.arc_tolerance;
    const real half = 3.141592653589793 * (real)halves - 0.5 * angle(arc_rotation(u, scene.c, scene.s, origin.c,
            origin.s));
    for (integer pass_1 = 0; pass_1 < MOST_STEPS; pass_1++) {
        if (pose.time > until_) {
            return none;
        }
        const Middle middle = middle_at(u, half, pose, slot, scene);
        const real distance = length(middle.dx, middle.dy);
        const Bounds limits = bounds_at(u, pose, slot, scene);
        real limit = limits.speed > 0.0 ? min_real(limits.step, 1.0 / limits.speed) : limits.step;
        const real furthest = distance + limits.speed * limit;
        const Bends bends = bends_of_square(u, furthest, limits, scene);
        const real square = 2.0 * limits.speed * limits.speed;
        /* To h'' the middle arc adds -2 V^2 cos(m) - 4 V' sin(m). |d|^2 adds 2 V^2 to its own, which `down` leaves out. */
        const real low = min_real(bends.down + 4.0 * limits.speed_change, bends.size + square);
        const real high = min_real(bends.up + square + 4.0 * limits.speed_change, bends.size + square);
        const real spread = distance + 4.0 * sin(0.5 * middle.arc);
        real step;
        if (fabs(middle.value) <= length_tolerance * (spread + length_tolerance)) {
            const Path path = path_of_three_arcs(u, middle, pose, scene);
            if (path.time < INFINITY) {
                return (WindCandidate){slot.phase + pose.width, slot.side, path};
            }
            step = max_real(fabs(middle.slope) / high, DOUBLE_ROOT);
        } else if (middle.value > 0.0) {
            step = step_without_zero(middle.value, middle.slope, low);
            if (distance - 4.0 > limits.speed * limit) {
                step = max_real(step, (distance - 4.0) / limits.speed);
                limit = limits.step;
            }
        } else {
            step = step_without_zero(-middle.value, -middle.slope, high);
        }
        pose = slot_pose(pose.width + min_real(step, limit), slot, scene);
    }
    return none;
}

/* The first arrival in a slot, the best of all words. */
static inline WindCandidate first_arrival(Slot slot, WindScene scene) {
    const SlotPose begin = first_within_reach(slot, scene);
    WindCandidate best = (WindCandidate){slot.phase, slot.side, NO_PATH};
    /* LSL or RSR that ends against the hold exists at all times and arrives within a turn or so; next to R = 1 others */
    /* may take forever. */
    const integer each_last_1[2] = {slot.side, -slot.side};
    for (int i_1 = 0; i_1 < 2; i_1++) {
        const integer last = each_last_1[i_1];
        const integer each_u_2[2] = {last, -last};
        for (int i_2 = 0; i_2 < 2; i_2++) {
            const integer u = each_u_2[i_2];
            best = earlier(best, first_with_straight(u, last, begin, slot, scene, best.path.time));
        }
    }
    const integer each_u_3[2] = {1, -1};
    for (int i_3 = 0; i_3 < 2; i_3++) {
        const integer u = each_u_3[i_3];
        const integer each_halves_4[2] = {0, 1};
        for (int i_4 = 0; i_4 < 2; i_4++) {
            const integer halves = each_halves_4[i_4];
            best = earlier(best, first_of_three_arcs(u, halves, begin, slot, scene, best.path.time));
        }
    }
    return best;
}

/* An arrival as the maneuver flown, with its status. */
static inline WindEntry arrival_of(WindCandidate found, WindScene scene) {
    const Path path = found.path;
    const integer side = found.side;
    const integer_real_3 drop_short_pieces_1 = drop_short_pieces(path.word, path.t1, path.t2, path.t3,
            rounding(scene.x, scene.y, scene.R), ROUNDING);
    const integer word = drop_short_pieces_1.a0;
    const real t1 = drop_short_pieces_1.a1, t2 = drop_short_pieces_1.a2, t3 = drop_short_pieces_1.a3;
    const Entry entry = (Entry){side, word, t1, t2, t3};
    const real miss = end_miss(entry, found.phase, scene);
    return entry_at(entry, found.phase, miss, scene);
}

/* The first arrival in the slot that is at a phase at the time 0; nan, with a status, where there is none.
 *
 * The side of the problem must be 1 or -1. The slot is entered exactly.
 */
static inline WindEntry first_in_slot(WindProblem problem, real phase) {
    const integer status = wind_search_status_of(problem);
    if (status != STATUS_OK) {
        return no_entry(status);
    }
    const WindScene scene = scene_of(problem);
    const Slot slot = (Slot){problem.side, phase};
    const Entry nothing = (Entry){slot.side, 0, 0.0, 0.0, 0.0};
    const real miss = end_miss(nothing, phase, scene);
    if (miss <= 3.0 * scene.arc_tolerance) {
        return entry_at(nothing, phase, miss, scene);
    }
    const WindCandidate found = first_arrival(slot, scene);
    if (fabs(found.path.time) == INFINITY) {
        return no_entry(code(STATUS_NOT_CONVERGED));
    }
    return arrival_of(found, scene);
}

/* The first path of a set of words to a pose at rest over the ground, passed in the direction `track`, radians.
 *
 * (x, y) is the start from the pose, and (c, s) its heading.
 */
static inline Path path_to_pose(integer words, real x, real y, real c, real s, real track, real wx, real wy) {
    /* The pose as a point of a circle of radius 1 on its left, passed counter-clockwise. */
    const real nx = sin(track), ny = -cos(track);
    const WindScene scene = (WindScene){x + nx, y + ny, c, s, 1.0, wx, wy, rounding(x + nx, y + ny, 1.0) / 3.0};
    return first_path_of(words, phase_of(nx, ny, -1, wx, wy), -1, scene, INFINITY);
}

#endif
