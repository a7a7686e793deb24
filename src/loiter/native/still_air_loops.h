/* The fastest way onto a holding circle in still air, in double precision, without branches and without calls of
 * the C library, for loops that a compiler vectorises.
 *
 * Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
 *
 * SHA-256 of the source: e27410e5741cb98d7ded2c70db82507ceb6e0938b557226a9f21dd21e6bfec23
 */
#ifndef LOITER_STILL_AIR_LOOPS_H
#define LOITER_STILL_AIR_LOOPS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

typedef double real;
typedef int32_t integer;
typedef uint32_t unsigned_integer;

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

/* A maneuver: the side of its circle, its word as flown, and the durations of its pieces (0 past the last). */
typedef struct { integer side, word; real t1, t2, t3; } Entry;

typedef struct { integer a0; real a1, a2, a3; } integer_real_3;

typedef struct { integer a0, a1, a2; } integer_3;


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
#define TAN_EIGHTH 0.41421356237309515 /* sqrt(2.0) - 1.0 */
#define TWO_PI 6.283185307179586 /* 2.0 * pi */

/* The control of a piece that the word does not have. */
#define ABSENT (-2)

/* pi/2 in three pieces, the first two of 33 digits, so that multiples below 2^20 are exact (Cody and Waite 1980). */
#define HALF_PI_1 1.5707963267341256
#define HALF_PI_2 6.077100506303966e-11
#define HALF_PI_3 2.0222662487959506e-21

/* The reduced state (2) of a vehicle at (x, y), relative to the circle's centre, with the unit heading (c, s). */
static inline LOITER_ALWAYS_INLINE real_2 reduce(real x, real y, real c, real s) {
    return (real_2){x * c + y * s, y * c - x * s};
}

/* The plain number of a member of `Word`, `Side` or `Status`, which Python answers in as compiled code does. */
static inline LOITER_ALWAYS_INLINE integer code(integer member) {
    return member + 0;
}

/* The side that is never slower: T_either(x, y) = T_cw(x, |y|) (paper, section 5); clockwise on y = 0. */
static inline LOITER_ALWAYS_INLINE integer near_side(real y) {
    return y < 0.0 ? -1 : 1;
}

/* The side itself; for *either*, the near side. */
static inline LOITER_ALWAYS_INLINE integer side_or_near(real y, integer side) {
    return side != SIDE_EITHER ? code(side) : near_side(y);
}

/* Whether `status_of` is OK: state and circle are within REACH, and the circle can be held. */
static inline LOITER_ALWAYS_INLINE bool is_solvable(real x, real y, real R, real tolerance) {
    const bool near = fabs(x) <= REACH && fabs(y) <= REACH && (0.0 <= tolerance && tolerance <= REACH);
    return near && (1.0 - ROUNDING <= R && R <= REACH);
}

/* R, or 1 where R is less than 1 by rounding only: a circle as tight as the aircraft can turn. */
static inline LOITER_ALWAYS_INLINE real rounded_radius(real R) {
    return 1.0 - ROUNDING <= R && R < 1.0 ? 1.0 : R;
}

/* `Status.OK`, or why there is nothing to solve. */
static inline LOITER_ALWAYS_INLINE integer status_of(real x, real y, real R, real tolerance) {
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

/* The length tolerance: the rounding error of lengths for a state and a circle of this size. */
static inline LOITER_ALWAYS_INLINE real rounding(real x, real y, real R) {
    return ROUNDING * (1.0 + fabs(x) + fabs(y) + R);
}

/* The share of the end-point tolerance that each of at most three pieces may use up. */
static inline LOITER_ALWAYS_INLINE real arc_tolerance_of(real x, real y, real R, real tolerance) {
    return max_real(tolerance, rounding(x, y, R)) / 3.0;
}

/* The rounded sum a + b, and its rounding error, exactly. */
static inline LOITER_ALWAYS_INLINE real_2 two_sum(real a, real b) {
    const real s = a + b;
    const real t = s - a;
    return (real_2){s, a - (s - t) + (b - t)};
}

/* A double as the sum of two of 26 digits. */
static inline LOITER_ALWAYS_INLINE real_2 split(real a) {
    const real c = SPLITTER * a;
    const real high = c - (c - a);
    return (real_2){high, a - high};
}

/* The rounded product a b, and its rounding error, exactly for |a|, |b| < 2^480. */
static inline LOITER_ALWAYS_INLINE real_2 two_product(real a, real b) {
#ifdef FP_FAST_FMA
    return (real_2){a * b, fma(a, b, -(a * b))};
#else
    const real p = a * b;
    const real_2 split_1 = split(a);
    const real ah = split_1.a0, al = split_1.a1;
    const real_2 split_2 = split(b);
    const real bh = split_2.a0, bl = split_2.a1;
    return (real_2){p, ah * bh - p + ah * bl + al * bh + al * bl};
#endif
}

/* The squared distances rp^2 - (R + 1)^2, rm^2 - (R - 1)^2 and rp^2 - (R - 3)^2 beyond three circles.
 *
 * They are `beyond` with R and 2, R and -2, 2 - R and 2. The last is the sum u + d + low, with an error of third
 * order only: at R = 1 + 2e-14 there are doubles next to (-sqrt(3), 0) where it is 8e-32, and where T would lose
 * 1e-9 for the terms that `beyond` leaves out. The others differ from it by -8 (R - 1) and -4 (y + R - 2); for them
 * an error of second order is enough, since next to their circles a single arc replaces the words that depend on
 * them.
 */
static inline LOITER_ALWAYS_INLINE real_3 beyond_circles(real x, real y, real R) {
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
static inline LOITER_ALWAYS_INLINE Start start_at(real x, real y, real R, real arc_tolerance) {
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
static inline LOITER_ALWAYS_INLINE real_2 snap_full_turn(real_2 rotated, real radius2, real arc_tolerance) {
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
static inline LOITER_ALWAYS_INLINE real_2_real onto_axis(real x, real y, real end_, real arc_tolerance) {
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
static inline LOITER_ALWAYS_INLINE Extremal external_join(integer word, real y, Start start, bool joins) {
    const real R = start.R;
    const real_2_real onto_axis_1 = onto_axis(start.x, y, -1.0, start.arc_tolerance);
    const real_2 first = onto_axis_1.a0;
    const real c = onto_axis_1.a1;
    const real X = sqrt(R * (R + 2.0));
    return (Extremal){word, first, joins ? max_real(c - X, 0.0) : INFINITY, NO_ROTATION, (real_2){X, 1.0}};
}

/* Right, straight, left, rm >= R + 1: the first arc is the mirror image of that of LSL. */
static inline LOITER_ALWAYS_INLINE Extremal rsl(Start start) {
    return external_join(WORD_RSL, -start.y, start, start.inner >= 4.0 * start.R);
}

/* (R + 3)^2 - rm^2: not negative where the circle of R meets the last circle of L, so where RL exists.
 *
 * It is 4 (R + y + 2) - `outer`, and not computed as 8 (R + 1) - `inner`: next to (0, -R - 2), where it vanishes
 * and RL is the fastest, neither term is negative, so that no digits are lost. T varies with its square root.
 */
static inline LOITER_ALWAYS_INLINE real within_reach(Start start) {
    return 4.0 * (start.R + start.y + 2.0) - start.outer;
}

/* The squared distance from (0, centre), accurate even near zero; computed from `beyond` it would lose digits. */
static inline LOITER_ALWAYS_INLINE real squared_distance(real x, real y, real centre) {
    return x * x + (y - centre) * (y - centre);
}

/* The counter-clockwise rotation from direction (ax, ay) to (bx, by); by zero where one of them is zero. */
static inline LOITER_ALWAYS_INLINE real_2 rotation(real ax, real ay, real bx, real by) {
    return (real_2){ax * by - ay * bx, ax * bx + ay * by + TINY};
}

/* RL: right to the crossing with the last circle (R + 1 about (0, -1)) where x1 has `branch`'s sign; then left.
 *
 * The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = `inner` = rm^2 - (R - 1)^2 and p = `within_reach`
 * = (R + 3)^2 - rm^2.
 */
static inline LOITER_ALWAYS_INLINE Extremal rl(Start start, real branch) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, inner = start.inner;
    const real p = within_reach(start);
    const real x1 = branch * 0.25 * sqrt(max_real(p * inner, 0.0));
    const real radius2 = squared_distance(x, y, 1.0);
    const real_2 first = snap_full_turn(rotation(x, y - 1.0, x1, R - 1.0 - 0.25 * inner), radius2, arc_tolerance);
    const real_2 last = snap_full_turn((real_2){-x1, R + 1.0 - 0.25 * inner}, (R + 1.0) * (R + 1.0), arc_tolerance);
    return (Extremal){WORD_RL, first, inner >= 0.0 && p >= 0.0 ? 0.0 : INFINITY, last, NO_ROTATION};
}

/* Rotation a where the condition holds, otherwise b. */
static inline LOITER_ALWAYS_INLINE real_2 select_rotation(bool condition, real_2 a, real_2 b) {
    const real across_a = a.a0, along_a = a.a1, across_b = b.a0, along_b = b.a1;
    return (real_2){condition ? across_a : across_b, condition ? along_a : along_b};
}

/* `extremals.select` number by number: it compiles to selects, which LLVM vectorises, instead of a branch. */
static inline LOITER_ALWAYS_INLINE Extremal branchless_select(bool condition, Extremal a, Extremal b) {
    const real straight = condition ? a.straight : b.straight;
    const integer word = condition ? a.word : b.word;
    const real_2 first = select_rotation(condition, a.first, b.first), middle = select_rotation(condition, a.middle,
            b.middle), last = select_rotation(condition, a.last, b.last);
    return (Extremal){word, first, straight, middle, last};
}

/* LSR, R >= 2: onto the axis at (c, 0), straight to (X, 0), X = sqrt(R (R - 2)), right for pi - acos(1/(R - 1)).
 *
 * `y` as in `external_join`, with the opposite sign for RSR; `joins` says whether c <= X.
 */
static inline LOITER_ALWAYS_INLINE Extremal internal_join(integer word, real y, Start start, bool joins) {
    const real R = start.R;
    const real_2_real onto_axis_1 = onto_axis(start.x, y, 1.0, start.arc_tolerance);
    const real_2 first = onto_axis_1.a0;
    const real c = onto_axis_1.a1;
    const real X = sqrt(max_real(R * (R - 2.0), 0.0));
    const real straight = R >= 2.0 && c >= 0.0 && joins ? max_real(X - c, 0.0) : INFINITY;
    return (Extremal){word, first, straight, NO_ROTATION, (real_2){X, -1.0}};
}

/* Right, straight, right, rm <= R - 1: the first arc is the mirror image of that of LSR. */
static inline LOITER_ALWAYS_INLINE Extremal rsr(Start start) {
    return internal_join(WORD_RSR, -start.y, start, start.inner <= 0.0);
}

/* Of the extremals of several pieces that begin with R, the one that can win, by rm; see `left_first`. */
static inline LOITER_ALWAYS_INLINE Extremal right_first(Start start) {
    Extremal best = branchless_select(start.inner > 4.0 * start.R, rsl(start), rl(start, -1.0));
    if (start.y < 0.0) {
        best = branchless_select(start.inner < 0.0, rsr(start), best);
    }
    return best;
}

/* Whether a point is within a distance of a circle; `beyond2`: squared distance from the centre less radius^2. */
static inline LOITER_ALWAYS_INLINE bool is_near_circle(real beyond2, real radius, real distance) {
    const real inwards = min_real(distance, radius);
    return -inwards * (2.0 * radius - inwards) <= beyond2 && beyond2 <= distance * (2.0 * radius + distance);
}

/* Right along the circle of radius R - 1 about (0, 1), from within `arc_tolerance` of it: the limit of LR. */
static inline LOITER_ALWAYS_INLINE Extremal extremals_r(Start start) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, inner = start.inner;
    const real_2 first = snap_full_turn((real_2){x, y - 1.0}, (R - 1.0) * (R - 1.0), arc_tolerance);
    const real straight = R > 1.0 && is_near_circle(inner, R - 1.0, arc_tolerance) ? 0.0 : INFINITY;
    return (Extremal){WORD_R, first, straight, NO_ROTATION, NO_ROTATION};
}

/* The difference a^2 - b with nearly full relative accuracy even near zero, for |a| < 2^480. */
static inline LOITER_ALWAYS_INLINE real square_beyond(real a, real b) {
    const real_2 two_product_1 = two_product(a, a);
    const real p = two_product_1.a0, e = two_product_1.a1;
    return p - b + e;
}

/* `gap` and v of the quadratic 3 w^2 - 2 gap w + v = 0 of `lrl`. */
static inline LOITER_ALWAYS_INLINE real_2 lrl_quadratic(Start start) {
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
static inline LOITER_ALWAYS_INLINE Extremal lrl(Start start) {
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
static inline LOITER_ALWAYS_INLINE Extremal lsr(Start start) {
    return internal_join(WORD_LSR, start.y, start, start.fold <= 4.0 * (start.R - 2.0));
}

/* Whether an extremal ends at the target. */
static inline LOITER_ALWAYS_INLINE bool reaches(Extremal extremal) {
    return extremal.straight < INFINITY;
}

/* LR, R > 1: left to the crossing with the circle (R - 1 about (0, 1)) where x1 has `branch`'s sign; then right.
 *
 * The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = -`outer` = (R + 1)^2 - rp^2, p = `fold` = rp^2 -
 * (R - 3)^2. So y1 + 1 is R + 1 - q/4 or 3 - R + p/4, and y1 - 1 is R - 1 - q/4: those forms are used whose terms
 * are no longer than the arc's radius, however small that is.
 */
static inline LOITER_ALWAYS_INLINE Extremal lr(Start start, real branch) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, outer = start.outer, fold
            = start.fold;
    const real x1 = branch * 0.25 * sqrt(max_real(-outer * fold, 0.0));
    const real radius2 = squared_distance(x, y, -1.0);
    const real_2 first = snap_full_turn(rotation(x1, 3.0 - R + 0.25 * fold, x, y + 1.0), radius2, arc_tolerance);
    const real_2 last = snap_full_turn((real_2){x1, R - 1.0 + 0.25 * outer}, (R - 1.0) * (R - 1.0), arc_tolerance);
    return (Extremal){WORD_LR, first, R > 1.0 && outer <= 0.0 && fold >= 0.0 ? 0.0 : INFINITY, last, NO_ROTATION};
}

/* Left, straight along the line through the centre, left: rp >= R + 1. */
static inline LOITER_ALWAYS_INLINE Extremal lsl(Start start) {
    return external_join(WORD_LSL, start.y, start, start.outer >= 0.0);
}

/* Of the extremals of several pieces that begin with L, the one that can win (docs/theory.md, section 4).
 *
 * It is determined by rp. `detour` gives the other crossing of LR, which is not considered here.
 */
static inline LOITER_ALWAYS_INLINE Extremal left_first(Start start) {
    Extremal best = lrl(start);
    if (start.R > 1.0) {
        Extremal inside = lsr(start);
        inside = branchless_select(reaches(inside), inside, lr(start, 1.0));
        best = branchless_select(start.fold <= 0.0 && start.R <= 3.0, best, inside);
    }
    if (start.y < 0.0) {
        best = branchless_select(start.outer >= 0.0, lsl(start), best);
    }
    return best;
}

/* Left along the last circle, radius R + 1 about (0, -1), from within `arc_tolerance` of it: the limit of RL. */
static inline LOITER_ALWAYS_INLINE Extremal extremals_l(Start start) {
    const real x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, outer = start.outer;
    const real_2 first = snap_full_turn((real_2){-x, y + 1.0}, (R + 1.0) * (R + 1.0), arc_tolerance);
    const real straight = is_near_circle(outer, R + 1.0, arc_tolerance) ? 0.0 : INFINITY;
    return (Extremal){WORD_L, first, straight, NO_ROTATION, NO_ROTATION};
}

/* Whether the angle of a rotation is in [0, pi]. */
static inline LOITER_ALWAYS_INLINE bool is_at_most_half_turn(real_2 rotated) {
    const real cross = rotated.a0;
    return cross >= 0.0;
}

/* Whether a single arc replaces the words of which it is the limit: of at most half a turn, or of any length. */
static inline LOITER_ALWAYS_INLINE bool is_limit(Extremal arc, bool any_length) {
    return reaches(arc) && (is_at_most_half_turn(arc.first) || any_length);
}

/* The rotation, less half a turn where it is half a turn or more, and the count `halves` of these half turns. */
static inline LOITER_ALWAYS_INLINE real_3 fold_half_turn(real_2 rotated, real halves) {
    const real cross = rotated.a0, dot = rotated.a1;
    if (cross < 0.0 || (cross == 0.0 && dot < 0.0)) {
        return (real_3){-cross, -dot, halves + 1.0};
    }
    return (real_3){cross, dot, halves};
}

/* atan(q)/q - 1 for z = q^2 up to tan(pi/8)^2; summed in pairs, which shortens the chain of operations. */
static inline LOITER_ALWAYS_INLINE real _atan(real z) {
    const real z2 = z * z;
    const real z4 = z2 * z2;
    const real low = -0.3333333333333333 + 0.19999999999999804 * z + (-0.14285714285659828 + 0.11111111105155447 *
            z) * z2;
    const real middle = -0.09090908753500877 + 0.07692296375032143 * z + (-0.06666424885738255 + 0.05878928997834775
            * z) * z2;
    const real high = -0.05230454270650244 + 0.04551593220626549 * z + (-0.034570561981427744 + 0.016285756855221028
            * z) * z2;
    return z * (low + middle * z4 + high * (z4 * z4));
}

/* The angle of (x, y) in [-pi, pi], 0 for (0, 0); finite arguments. The sign of a zero is ignored.
 *
 * The smaller coordinate over the larger one, reduced from pi/4 to pi/8 by tan(a - pi/4) = (t - 1)/(t + 1).
 */
static inline LOITER_ALWAYS_INLINE real branchless_atan2(real y, real x) {
    const real ax = fabs(x), ay = fabs(y);
    const real large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
    const bool beyond = small > TAN_EIGHTH * large;
    const real above = beyond ? small - large : small, below = beyond ? small + large : large;
    const real q = above / (below > 0.0 ? below : 1.0);
    real a = q + q * _atan(q * q) + (beyond ? 0.25 * 3.141592653589793 : 0.0);
    a = ay > ax ? 0.5 * 3.141592653589793 - a : a;
    a = x < 0.0 ? 3.141592653589793 - a : a;
    return y < 0.0 ? -a : a;
}

/* The sum of the angles of three rotations, in [0, 6 pi], with one arctangent.
 *
 * Multiplying the vectors as complex numbers adds their angles. Each is first folded below pi, so that two of them
 * make less than a full turn and no whole turn is lost.
 */
static inline LOITER_ALWAYS_INLINE real total_angle(real_2 first, real_2 second, real_2 third) {
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
    return 3.141592653589793 * halves + branchless_atan2(c, d);
}

/* T, the whole time of an extremal; `inf` where it does not reach the target. */
static inline LOITER_ALWAYS_INLINE real extremals_duration(Extremal extremal) {
    return extremal.straight + total_angle(extremal.first, extremal.middle, extremal.last);
}

/* The least time so far and its extremal, or those of another extremal that takes less. */
static inline LOITER_ALWAYS_INLINE real_Extremal faster_of(real least, Extremal best, Extremal other) {
    const real time = extremals_duration(other);
    return (real_Extremal){time < least ? time : least, branchless_select(time < least, other, best)};
}

/* The only RL or LR with the other crossing that can win, for y < 0: its first arc ends before the axis. */
static inline LOITER_ALWAYS_INLINE Extremal detour(Start start) {
    return branchless_select(start.inner > 4.0 * start.R, rl(start, 1.0), lr(start, -1.0));
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
static inline LOITER_ALWAYS_INLINE real_Extremal fastest(real x, real y, real R, real arc_tolerance, bool exact) {
    const Start start = start_at(x, y, R, arc_tolerance);
    Extremal right = right_first(start);
    const Extremal only_right = extremals_r(start);
    Extremal left = left_first(start);
    const Extremal only_left = extremals_l(start);
    if (exact) {
        left = branchless_select(is_limit(only_left, y <= 0.0), only_left, left);
        right = branchless_select(is_limit(only_right, y <= 0.0 || start.outer <= 0.0), only_right, right);
    }
    Extremal best;
    if (exact && R == 1.0 && !(y < 0.0)) {
        best = branchless_select(reaches(left) && is_at_most_half_turn(left.first), left, right);
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

/* T of `optimum_on_side`, without its pieces; a piece that is too short to be flown may be included. */
static inline LOITER_ALWAYS_INLINE real least_time(real x, real y, real R, integer side, real tolerance) {
    const real_Extremal fastest_1 = fastest(x, (real)side * y, R, arc_tolerance_of(x, y, R, tolerance), tolerance ==
            0.0);
    const real time = fastest_1.a0;
    return time;
}

/* The angle of a counter-clockwise rotation, in [0, 2 pi]; that of a clockwise one is `angle((-cross, dot))`.
 *
 * One arctangent has an error of about one rounding of the angle itself; a difference of two arctangents would lose
 * the digits of a small rotation.
 */
static inline LOITER_ALWAYS_INLINE real angle(real_2 rotated) {
    const real cross = rotated.a0, dot = rotated.a1;
    const real turned = branchless_atan2(cross, dot);
    /* + 0.0 turns -0.0 into 0.0, so that no duration has a negative sign. */
    return turned < 0.0 ? turned + TWO_PI : turned + 0.0;
}

/* The durations of the pieces in flying order, 0 past the last. */
static inline LOITER_ALWAYS_INLINE real_3 durations(Extremal extremal) {
    return (real_3){angle(extremal.first), extremal.straight + angle(extremal.middle), angle(extremal.last)};
}

/* The controls of the three pieces of a word, `ABSENT` past its last. */
static inline LOITER_ALWAYS_INLINE integer_3 controls(integer word) {
    return (integer_3){(word & 3) - 2, ((word >> 2) & 3) - 2, ((word >> 4) & 3) - 2};
}

/* The word of the controls -1, 0 or +1 of up to three pieces, in the order flown. */
static inline LOITER_ALWAYS_INLINE integer encode(integer u1, integer u2, integer u3) {
    return u1 + 2 + 4 * (u2 + 2) + 16 * (u3 + 2);
}

/* The word without its first piece. */
static inline LOITER_ALWAYS_INLINE integer rest(integer word) {
    return (word >> 2);
}

/* The word as flown: without a straight piece up to `short` and arcs up to `no_angle`; equal arcs are joined. */
static inline LOITER_ALWAYS_INLINE integer_real_3 drop_short_pieces(integer word, real t1, real t2, real t3, real
        short_, real no_angle) {
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
static inline LOITER_ALWAYS_INLINE integer opposite(integer u) {
    return u == ABSENT ? u : -u;
}

/* The word with L and R exchanged. */
static inline LOITER_ALWAYS_INLINE integer mirrored(integer word) {
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
static inline LOITER_ALWAYS_INLINE Entry flown_entry(Extremal extremal, real length_tolerance, integer side) {
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

/* T, the whole time of a maneuver. */
static inline LOITER_ALWAYS_INLINE real entry_duration(Entry maneuver) {
    return maneuver.t1 + maneuver.t2 + maneuver.t3;
}

/* Whether a maneuver is faster than another by more than rounding. */
static inline LOITER_ALWAYS_INLINE bool is_faster(Entry maneuver, Entry other, real length_tolerance) {
    return entry_duration(maneuver) < entry_duration(other) - length_tolerance;
}

/* Feedback law: the first control of a maneuver; at the target the rate -1/R or 1/R that holds the circle. */
static inline LOITER_ALWAYS_INLINE real first_control(real R, Entry maneuver) {
    const integer_3 controls_1 = controls(maneuver.word);
    const integer first = controls_1.a0;
    return first != ABSENT ? (real)first : (real)-maneuver.side / R;
}

/* sin(q)/q - 1 for z = q^2 up to (pi/4)^2. */
static inline LOITER_ALWAYS_INLINE real _sin(real z) {
    const real z2 = z * z;
    const real low = -0.16666666666666666 + 0.008333333333333331 * z;
    const real middle = -0.00019841269841265065 + 2.7557319219339167e-06 * z;
    const real high = -2.5052106232447578e-08 + 1.6058531618986147e-10 * z + -7.586697117706918e-13 * z2;
    return z * (low + middle * z2 + high * (z2 * z2));
}

/* (cos q - 1 + z/2)/z^2 for z = q^2 up to (pi/4)^2. */
static inline LOITER_ALWAYS_INLINE real _cos(real z) {
    const real z2 = z * z;
    const real low = 0.041666666666666664 + -0.0013888888888887398 * z;
    const real middle = 2.480158729876569e-05 + -2.7557317271729793e-07 * z;
    return low + middle * z2 + (2.08761462684032e-09 + -1.1382632425521717e-11 * z) * (z2 * z2);
}

/* The quarter turns in an angle, 0 to 3, and sine and cosine of the remainder, which is within pi/4. */
static inline LOITER_ALWAYS_INLINE real_3 _quarters(real a) {
    const real n = floor(a * (2.0 / 3.141592653589793) + 0.5) * 1.0;
    const real q = a - n * HALF_PI_1 - n * HALF_PI_2 - n * HALF_PI_3;
    const real z = q * q;
    return (real_3){n - 4.0 * floor(0.25 * n), q + q * _sin(z), 1.0 - (0.5 * z - z * z * _cos(z))};
}

/* Cosine for |a| up to 2^19. */
static inline LOITER_ALWAYS_INLINE real branchless_cos(real a) {
    const real_3 _quarters_1 = _quarters(a);
    const real quarters = _quarters_1.a0, s = _quarters_1.a1, c = _quarters_1.a2;
    const bool odd = quarters == 1.0 || quarters == 3.0;
    const real value = odd ? s : c;
    return quarters == 1.0 || quarters == 2.0 ? -value : value;
}

/* Sine for |a| up to 2^19. */
static inline LOITER_ALWAYS_INLINE real branchless_sin(real a) {
    const real_3 _quarters_1 = _quarters(a);
    const real quarters = _quarters_1.a0, s = _quarters_1.a1, c = _quarters_1.a2;
    const bool odd = quarters == 1.0 || quarters == 3.0;
    const real value = odd ? c : s;
    return quarters >= 2.0 ? -value : value;
}

/* The state after a time t with control u, by (7): turned about (0, -u), or shifted along x for u = 0. */
static inline LOITER_ALWAYS_INLINE real_2 flow(real x, real y, integer u, real t) {
    if (u == 0) {
        return (real_2){x + t, y};
    }
    const real w = (real)u * y + 1.0;
    const real ce = branchless_cos(t), se = branchless_sin(t);
    return (real_2){x * ce + w * se, (real)u * (w * ce - x * se - 1.0)};
}

/* The length of a vector whose square neither overflows nor underflows.
 *
 * Unlike `math.hypot`, whose algorithm is Python's own, compiled code gives the same value to the last bit.
 */
static inline LOITER_ALWAYS_INLINE real length(real x, real y) {
    return sqrt(x * x + y * y);
}

/* The distance from the target, in the reduced plane, at which a maneuver from (x, y) ends when flown exactly. */
static inline LOITER_ALWAYS_INLINE real miss(real x, real y, real R, Entry maneuver) {
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

#endif
