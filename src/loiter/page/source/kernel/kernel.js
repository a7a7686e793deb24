// @ts-check
/* The fastest way onto a holding circle, in still air and in wind, for browsers and Node: the same answers in all
 * of them, to the last bit, since sine, cosine and arctangent are its own.
 *
 * Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
 *
 * SHA-256 of the source: b044ebf539c32cb4e83f2ff38d545d960e7466f2864237ea4f39d1f48756d92d
 */

// What Python has and JavaScript has not: the first of two that tie, and quotients rounded down. Integers are doubles
// without fraction, of up to 53 bits; &, |, ~ and shifts by a constant take 32.

/** @type {(a: number, b: number) => number} */
export const min_real = (a, b) => (b < a ? b : a);

/** @type {(a: number, b: number) => number} */
export const max_real = (a, b) => (b > a ? b : a);

export const [min_integer, max_integer] = [min_real, max_real];

/** @type {(a: number, b: number) => number} */
export const integer_quotient = (a, b) => Math.floor(a / b);

/** @type {(a: number, b: number) => number} */
export const integer_modulo = (a, b) => a - Math.floor(a / b) * b;

/** @type {(bits: number) => number} */
const power_of_two = (bits) => (bits < 31 ? 1 << bits : 1073741824 * power_of_two(bits - 30));

/** @type {(a: number, bits: number) => number} */
export const shift_left = (a, bits) => a * power_of_two(bits);

/** @type {(a: number, bits: number) => number} */
export const shift_right = (a, bits) => Math.floor(a / power_of_two(bits));

/** @type {(a: number, b: number) => number} */
export function real_modulo(a, b) {
    const rest = a % b;
    if (rest === 0) {
        return b < 0 ? -0 : 0;
    }
    return rest < 0 !== b < 0 ? rest + b : rest;
}

/** @type {(a: number) => boolean} */
export const isfinite = Number.isFinite;

/** What is too large for 32 bits, or nan, becomes the largest or least of them. @type {(a: number) => number} */
export const integer_of = (a) => (a >= 2147483647 ? 2147483647 : a > -2147483647 ? Math.trunc(a) + 0 : -2147483647);

/** @type {(count: number) => number[]} */
export const range = (count) => Array.from({ length: count }, (_, i) => i);

/** The elements in the order of a function of them. @type {<T>(list: T[], key: (one: T) => number) => T[]} */
export const sorted = (list, key) => [...list].sort((a, b) => key(a) - key(b));

/* The direction in which the circle is held: the sign of the target's ordinate in the reduced plane, (8)-(10). */
export const Side = { CW: 1, CCW: -1, EITHER: 0 };

/* The outcome for one state of an array call; the results are nan unless it is `OK`. */
export const Status = { OK: 0, NOT_FINITE: 1, RADIUS_TOO_SMALL: 2, OUT_OF_RANGE: 3, BAD_TOLERANCE: 4,
        BAD_AIRCRAFT: 5, BAD_ORBIT: 6, BAD_TURN: 7, BAD_POSE: 8, MALFORMED: 9, WIND_TOO_STRONG: 10, NOT_HELD: 11,
        NOT_CONVERGED: 12, BAD_WIND: 13, BAD_SLOT: 14 };

/* The words that occur, in Dubins' letters: L (u = +1), S (u = 0), R (u = -1).
 *
 * `EMPTY` is the word of a start that is already on the circle.
 */
export const Word = { EMPTY: 0, R: 1, L: 3, SR: 6, SL: 14, RL: 13, LR: 7, RSR: 25, RSL: 57, LSR: 27, LSL: 59,
        RLR: 29, LRL: 55 };

/**
 * A maneuver: the side of its circle, its word as flown, and the durations of its pieces (0 past the last).
 *
 * @typedef {{side: number, word: number, t1: number, t2: number, t3: number}} Entry
 */

/**
 * A word with its pieces in flying order: first arc, straight length, middle arc (or none), last arc.
 *
 * @typedef {{word: number, first: [number, number], straight: number, middle: [number, number], last: [number,
 *         number]}} Extremal
 */

/**
 * Reduced state, radius, arc tolerance, and on which side of three circles the state lies: positive outside them.
 *
 * `arc_tolerance` is the arc length by which a rotation may fall short of a full turn and count as none
 * (`angles.snap_full_turn`). `outer` is rp^2 - (R + 1)^2, `inner` rm^2 - (R - 1)^2, `fold` rp^2 - (R - 3)^2.
 *
 * @typedef {{x: number, y: number, R: number, arc_tolerance: number, outer: number, inner: number, fold: number}}
 *         Start
 */

/**
 * The multiplier lambda and the adjoint psi of a state.
 *
 * @typedef {{lam: number, psi1: number, psi2: number}} Adjoint
 */

/**
 * An entry to find: start, heading as a unit vector, radius, `words.Side`, velocity of the air past the circle.
 *
 * A start beyond the circle, or beyond a last arc, by less than `tolerance` (turn radii) counts as on it.
 *
 * @typedef {{x: number, y: number, c: number, s: number, R: number, side: number, wx: number, wy: number,
 *         tolerance: number}} WindProblem
 */

/**
 * A maneuver as flown: status, side, word, durations, azimuth of the point of joining, and miss.
 *
 * The azimuth is counted counter-clockwise from the x axis; the miss is the distance of the end from that point,
 * position and heading together.
 *
 * @typedef {{status: number, side: number, word: number, t1: number, t2: number, t3: number, azimuth: number,
 *         miss: number}} WindEntry
 */

/**
 * Start, heading as a unit vector, radius, wind, and `arc_tolerance` as in `moving_target.Ends`.
 *
 * @typedef {{x: number, y: number, c: number, s: number, R: number, wx: number, wy: number, arc_tolerance: number}}
 *         WindScene
 */

/**
 * A path to the pose: its time, word and three durations, and its adjoint, lambda and the unit vector p.
 *
 * The adjoint is that of docs/wind.md, section 3.
 *
 * @typedef {{time: number, word: number, t1: number, t2: number, t3: number, lam: number, p1: number, p2: number}}
 *         Path
 */

/**
 * A path and where it joins: the phase of the point (`hold`), and the side on which the circle is held.
 *
 * @typedef {{phase: number, side: number, path: Path}} WindCandidate
 */

/**
 * A maneuver that ends beside the circle by `miss`, at the point of joining with this phase.
 *
 * @typedef {{entry: Entry, phase: number, miss: number}} EntryBeside
 */

/**
 * A cell, one of `FIRST_CELLS` << `level` equal arcs of the circle, by its number; and words, six bits a level.
 *
 * The words are those that may join inside the cells that contain it, the smallest in the lowest bits; of these
 * cells none is below the level `NARROWED`.
 *
 * @typedef {{number: number, level: number, words: number}} CellVisit
 */

/**
 * A point of joining: its phase, the first path to it, and the slope of the time there, `join_slope`.
 *
 * @typedef {{phase: number, path: Path, slope: number}} JoinPoint
 */

/**
 * The end of a cell of the level `LEAF`, by the number of the cell.
 *
 * @typedef {{number: number, point: JoinPoint}} LeafEnd
 */

/**
 * A set of cells of the level `LEAF`: a bit for each, for each quarter of the circle.
 *
 * @typedef {{first: number, second: number, third: number, fourth: number}} Leaves
 */

/**
 * Two arcs that end on the circle: the phase of their end, the control of the first, and their durations.
 *
 * @typedef {{phase: number, u: number, t1: number, t2: number}} Corner
 */

/**
 * The search for the local minimum of the time next to a candidate, which `refine` continues step by step.
 *
 * From the best point so far, `here`, the time falls towards the point `other`. Once the minimum is enclosed, the
 * time there is higher, or it falls in the opposite direction: so there is a local minimum between them. `last` is
 * the point tried last, with one of a set of words; `bisect` says that the next point is that in the middle.
 * `steps` counts those of the stage, and `enclosures` the minima that were not yet the last one.
 *
 * @typedef {{stage: number, side: number, width: number, here: JoinPoint, other: JoinPoint, last: JoinPoint,
 *         words: number, bisect: boolean, steps: number, enclosures: number}} Refinement
 */

/**
 * A cell whose end has a path faster than the best one: the words that may join inside it before the best time.
 *
 * No path into the cell is faster than `earliest`. Without one that is faster than the best by `tolerance` it is
 * done.
 *
 * @typedef {{words: number, earliest: number, tolerance: number}} OpenCell
 */

/**
 * A search for the fastest entry, which `advance_search` continues: its stage, and what is known so far.
 *
 * The sides of the circle that are asked for are `sides`, that which is searched now is `side`. `best` is the
 * fastest path found, `beside` the entry beside the circle that counts, too. `visit` is the next cell; `before` the
 * end of the leaf before it, `leaves` those that are left on this side, and `others` on the other one. `corner` is
 * that of the best path, which took the time `compared`, and `visits` the number of cells so far. While there is a
 * refinement, it is continued first; `cell` is the cell that waits for it. `left` is the number of steps that may
 * follow at once, and `entry` the result once the stage is ENDED.
 *
 * @typedef {{stage: number, sides: number, side: number, scene: WindScene, best: WindCandidate, beside: EntryBeside,
 *         visit: CellVisit, before: LeafEnd, leaves: Leaves, others: Leaves, corner: Corner, compared: number,
 *         visits: number, refinement: Refinement, cell: OpenCell, left: number, entry: WindEntry}} WindSearch
 */

/**
 * An arc that ends with the heading of a point of joining: its duration, and how far along the hold it is short.
 *
 * @typedef {{t: number, short_: number}} ArcEnd
 */

/**
 * The data common to all words: the headings (c0, s0) at the start and (c, s) at the pose, and the wind.
 *
 * `arc_tolerance` is the arc length by which a rotation may fall short of a full turn and count as none
 * (`angles.snap_full_turn`).
 *
 * @typedef {{c0: number, s0: number, c: number, s: number, wx: number, wy: number, arc_tolerance: number}} Ends
 */

/**
 * An arc of the circle, and what all words share: derivatives are with respect to the phase.
 *
 * `half` is half its width; (px, py) the point in its middle, from the start, and (c, s) the heading there; (tx,
 * ty) the derivative of the point, and (nx, ny) its second derivative; `turning` and `turned_more` those of the
 * angle of the heading. `fastest_turning`, `twist` and `jerk` bound the first three derivatives of that angle,
 * `bend` and `bend_change` the second and the third derivative of the centre of the last arc. (c0, s0) is the
 * heading at the start, (wx, wy) the wind, `wind` its size.
 *
 * @typedef {{half: number, px: number, py: number, c: number, s: number, tx: number, ty: number, nx: number,
 *         ny: number, turning: number, turned_more: number, bend: number, bend_change: number, twist: number,
 *         jerk: number, fastest_turning: number, wind: number, c0: number, s0: number, wx: number, wy: number}} Cell
 */

/**
 * The vector from the centre of the first arc to that of the last at time 0 and two derivatives by the phase.
 *
 * `change` bounds how much the vector differs from that inside the cell, `fastest` its derivative.
 *
 * @typedef {{x: number, y: number, dx: number, dy: number, ddx: number, ddy: number, change: number, fastest: number}}
 *         Centres
 */

/**
 * Where and when to leave: the side of the hold, the phase of the exit, and what must have passed by then.
 *
 * `hold` is the least time on the circle, `width` the least angle of it, `time` the least time since the start.
 *
 * @typedef {{side: number, phase: number, hold: number, width: number, time: number}} WayOut
 */

/**
 * The path onto the circle, the angle of the circle that is held after it, and the time at the exit.
 *
 * @typedef {{path: Path, width: number, time: number}} Exit
 */

/**
 * A slot: the side on which the circle is held, and the phase (`hold`) of the slot at the time 0.
 *
 * @typedef {{side: number, phase: number}} Slot
 */

/**
 * The slot after an angle `width` of the circle: the time, and the point from the start, in the frame of the air.
 *
 * (c, s) is the heading there, `advance` the derivative of the time by the width, `turning` that of the size of the
 * angle through which the heading has turned since the time 0, and `turned` this angle.
 *
 * @typedef {{width: number, time: number, x: number, y: number, c: number, s: number, advance: number,
 *         turning: number, turned: number}} SlotPose
 */

/**
 * Bounds within `step` of a width: on V, on its derivative and on the rate at which the heading turns.
 *
 * @typedef {{step: number, speed: number, speed_change: number, turning: number}} Bounds
 */

/**
 * Length less time of a word with a straight piece, less whole turns, in [-pi, pi], and its derivative.
 *
 * `apart` is the square of the distance of the outer circles' centres less 4, and `apart_slope` its derivative: LSR
 * and RSL exist where it is not negative.
 *
 * @typedef {{value: number, slope: number, apart: number, apart_slope: number}} Excess
 */

/**
 * Bounds on the second derivative of |d|^2: it is at least -`down`, at most `up`, and no larger than `size`.
 *
 * @typedef {{down: number, up: number, size: number}} Bends
 */

/**
 * The function whose roots are the arrivals of LRL or RLR, and its derivative.
 *
 * With it the middle arc and the vector between the centres of the outer arcs.
 *
 * @typedef {{value: number, slope: number, arc: number, dx: number, dy: number}} Middle
 */


/* pi/2 in three pieces, the first two of 33 digits, so that multiples below 2^20 are exact (Cody and Waite 1980). */
export const HALF_PI_1 = 1.5707963267341256;
export const HALF_PI_2 = 6.077100506303966e-11;
export const HALF_PI_3 = 2.0222662487959506e-21;

/* Beyond this many turn radii neighbouring doubles are a turn radius apart. */
export const REACH = 4503599627370496.0; /* 2.0 ** 52 */

/* Rounding error of a length of order one: the reduction (2) costs 2 roundings a coordinate, a difference of
 * squares 6, the angle and the flight of each of three pieces about 10; 64 units of 2**-52 is the next power of two
 * above the sum.
 */
export const ROUNDING = 1.4210854715202004e-14; /* 64.0 * 2.0 ** (-52) */

/* Dekker's splitting factor, 2^27 + 1, halves the 53 digits of a double. */
export const SPLITTER = 134217729.0;

/* A rotation multiplied by less could have subnormal components, which have lost digits. Below this distance the
 * rounding error of c - end x itself is negligible.
 */
export const SMALLEST_SCALE = 4.909093465297727e-91; /* 2.0 ** (-300) */
/** @type {[number, number]} */
export const NO_ROTATION = [0.0, 1.0];

/* Added to inner products, so that a zero vector gives the rotation by zero. It is negligible for vectors longer
 * than 1e-37, and a product of three of them does not underflow.
 */
export const TINY = 4.909093465297727e-91; /* 2.0 ** (-300) */
export const TAN_EIGHTH = 0.41421356237309515; /* sqrt(2.0) - 1.0 */
export const TWO_PI = 6.283185307179586; /* 2.0 * pi */

/* The control of a piece that the word does not have. */
export const ABSENT = -2;

/* In wind maneuvers tie if their times agree to this share of 1 + R + T: the accuracy found in docs/wind.md,
 * section 6.
 */
export const WIND_TIE_TOLERANCE = 1e-12;

/* A slower wind displaces no point within REACH by as much as rounding, and its square would be subnormal. */
export const NEGLIGIBLE_WIND = 3.8725919148493183e-121; /* 2.0 ** (-400) */
/** @type {WindSearch} */
export const NO_SEARCH = { stage: 0, sides: 0, side: 1, scene: { x: 0.0, y: 0.0, c: 1.0, s: 0.0, R: 1.0, wx: 0.0, wy: 0.0, arc_tolerance: 0.0 }, best: { phase: 0.0, side: 0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 } }, beside: { entry: { side: 0, word: 0, t1: Infinity, t2: 0.0, t3: 0.0 }, phase: 0.0, miss: Infinity }, visit: { number: 0, level: 0, words: 63 }, before: { number: -2, point: { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 } }, leaves: { first: 0, second: 0, third: 0, fourth: 0 }, others: { first: 0, second: 0, third: 0, fourth: 0 }, corner: { phase: 0.0, u: 0, t1: 0.0, t2: 0.0 }, compared: Infinity, visits: 0, refinement: { stage: 0, side: 0, width: 0.0, here: { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 }, other: { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 }, last: { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 }, words: 0, bisect: false, steps: 0, enclosures: 0 }, cell: { words: 0, earliest: 0.0, tolerance: 0.0 }, left: 0, entry: { status: 12, side: 0, word: 0, t1: NaN, t2: NaN, t3: NaN, azimuth: NaN, miss: NaN } };

/* The stages of a search: on each side, first some points, then cells down to the leaves, then the leaves that are
 * left.
 */
export const ENDED = 5;
/** @type {EntryBeside} */
export const NO_ENTRY_BESIDE = { entry: { side: 0, word: 0, t1: Infinity, t2: 0.0, t3: 0.0 }, phase: 0.0, miss: Infinity };

/* Newton's method reduces an error of 1e-4 to rounding in three steps. */
export const ARC_STEPS = 8;

/* Points of joining around the circle between which single arcs are looked for. */
export const ARC_SAMPLES = 32;

/* The path found next to two arcs may be too early by this many times its miss: both vary with the adjoint, whose
 * length over lambda + p . w stays below 10 where lambda = 1 and |w| < 0.9.
 */
export const TOO_EARLY = 10.0;

/* Where two arcs are the fastest, the search ends on a word with a short third piece that is due to rounding: a
 * straight piece of up to the square root of 4e-14 where the phase is accurate to 1e-14.
 */
export const SHORT = 0.0001;

/* More steps than any search takes. */
export const UNLIMITED = 2147483647; /* 2 ** 31 - 1 */

/* The stages of a refinement; there is none, or it has ended, where it is REFINED. */
export const REFINED = 0;
export const BRACKETING = 1;

/* Sets of the six words of three pieces, a bit for each: all, and those with a straight piece. */
export const ALL_WORDS = 63;
/** @type {Path} */
export const NO_PATH = { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 };

/* An arc that comes this close to a whole turn, or to zero, may pass it. */
export const ALMOST = 1e-06;

/* Here Newton's method approaches every root from the side on which it converges monotonically. Each step squares
 * the error, or halves it near a double root; 60 halvings are more than the digits of a double.
 */
export const NEWTON_STEPS = 60;

/* The next step of Newton's method for LSR or RSL is left out where it would be less than the time times this over
 * 2 (1 - |w|).
 */
export const NO_STEP = 3.469446951953614e-18; /* 2.0 ** (-58) */

/* Steps, each twice as long as the last, that together go round the circle from a leaf of `wind_search`. */
export const BRACKETING_STEPS = 7;
export const ENCLOSING = 2;

/* The search ends where another step is worth less than the time over this. */
export const WORTH = 9007199254740992.0; /* 2.0 ** 53 */
export const COMPARING = 3;

/* A point of two arcs is a local minimum unless the time falls away from it this far before or after it, in
 * radians. The phase of such a point is known to some 1e-15, and the time changes by no more than a few times this
 * up to there.
 */
export const AT_CORNER = 1e-12;

/* At worst every other step of `enclose` bisects, so 106 steps exhaust the digits of a double; 14 are in reserve. */
export const REFINING_STEPS = 120;

/* A faster path is sought this far before and after a local minimum, in radians; this is multiplied by the time
 * where that is below 1.
 */
export const BESIDE = 1e-07;
/** @type {Refinement} */
export const NO_REFINEMENT = { stage: 0, side: 0, width: 0.0, here: { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 }, other: { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 }, last: { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 }, words: 0, bisect: false, steps: 0, enclosures: 0 };

/* Refinements after which no path to the point, or to a point beside it, is faster; the second is rarely needed. */
export const REFINEMENTS = 4;
export const JOINING = 0;
/** @type {CellVisit} */
export const FIRST_CELL = { number: 0, level: 0, words: 63 };
export const COARSE_OTHER = 2;

/* Cells at first. Those that may hold a faster path than the best are halved to 2 pi/128, where local minima are
 * found, and then until none may hold a path that is faster by more than `time_tolerance`: the hold through a cell
 * of the level `LAST` takes less than that. The bound by the hold, which takes a path, is used from 2 pi/32 on.
 */
export const FIRST_CELLS = 8;
export const LEAF = 4;
/** @type {LeafEnd} */
export const NO_LEAF_END = { number: -2, point: { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 } };
/** @type {Corner} */
export const NO_CORNER = { phase: 0.0, u: 0, t1: 0.0, t2: 0.0 };
export const LAST = 44;

/* The last level to which a cell hands on its words: five sets of six bits, from the first level or from `LEAF` on,
 * fit into the integers of JavaScript.
 */
export const NARROWED = 8;

/* Points of joining on each side that are tried first. */
export const JOINS = 8;
export const WITH_STRAIGHT = 15;
/** @type {JoinPoint} */
export const NO_POINT = { phase: 0.0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 }, slope: 0.0 };

/* Tangents to h that `has_no_middle` tries. */
export const TANGENTS = 8;
export const COARSE = 2;

/* A quarter of the cells of the level `LEAF`: as many as there are bits in the integers of JavaScript. */
export const LEAVES = 32; /* FIRST_CELLS << LEAF - 2 */
/** @type {WindCandidate} */
export const NO_CANDIDATE = { phase: 0.0, side: 0, path: { time: Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 } };

/* After so many cells of the level `LEAF` and below, the tolerance is `hold_tolerance`. More are needed only in
 * degenerate scenes, some of those in still air with R = 1 or 2; the slowest others found take some 2,500.
 */
export const MOST_VISITS = 4096;

/* The arc of the circle that is held for `hold_tolerance`. */
export const UNKNOWN_ARC = 0.0015339807878856412; /* TWO_PI / 4096.0 */

/* In cells within this many half widths of the end of the best path, bounds around that end are tried too. */
export const NEAR_BEST = 8.0;

/* 4/3 (TURNS/2)^3. */
export const CUBE = 0.288; /* TURNS * TURNS * TURNS / 6.0 */

/* A vector that is displaced by a share of its length turns by less than this times that share, up to two thirds. */
export const TURNS = 1.2;

/* The angle by which the other arc may change while one vanishes. */
export const SWING = 1.5707963267948966; /* 0.5 * pi */

/* Points of joining around the circle between which `ranked` looks for local minima. */
export const SAMPLES = 128;

/* Halvings after which an interval of phases is as short as rounding. */
export const HALVINGS = 60;

/* Each step squares the difference of the two means: seven reach rounding from any wind that a double can tell from
 * 1.
 */
export const MEANS = 7;

/* Halvings of the angle that is held until the circle can be reached. */
export const BEGIN_HALVINGS = 20;

/* Steps towards the slot while it is out of reach, and the time that remains when they end. */
export const APPROACHES = 200;
export const NEAR = 0.01;

/* The ground speed changes by no more than a factor exp(GROWTH) within a step. */
export const GROWTH = 0.5;

/* Steps after which the search for one word gives up: a circle of 10,000 turn radii takes fewer. */
export const MOST_STEPS = 100000;

/* Next to a double root a step is at least this long, radians: there the function is within rounding of zero. */
export const DOUBLE_ROOT = 1e-08;

/* Halvings, or better steps, that shrink a bracket to rounding. */
export const ROOT_STEPS = 120;

/* Where the last arc or a straight piece vanishes at a root of the excess, it is known to the cube root of this
 * times rounding: the excess of a last arc a is V a^3 / (6 k), k <= 1, and of the two words that meet there one has
 * V >= 1.
 */
export const EDGE = 1000.0;

/* What a search for a word with a straight piece gives up with before anything is found: it is earlier than all
 * others, so that these end too.
 */
/** @type {Path} */
export const GAVE_UP = { time: -Infinity, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 };

/* The distance between the outer circles of LRL or RLR is known up to so many arc tolerances. */
export const THREE_ARCS = 12.0;

/**
 * The reduced state (2) of a vehicle at (x, y), relative to the circle's centre, with the unit heading (c, s).
 *
 * @type {(x: number, y: number, c: number, s: number) => [number, number]}
 */
export function reduce(x, y, c, s) {
    return [x * c + y * s, y * c - x * s];
}

/**
 * sin(q)/q - 1 for z = q^2 up to (pi/4)^2.
 *
 * @type {(z: number) => number}
 */
export function _sin(z) {
    const z2 = z * z;
    const low = -0.16666666666666666 + 0.008333333333333331 * z;
    const middle = -0.00019841269841265065 + 2.7557319219339167e-06 * z;
    const high = -2.5052106232447578e-08 + 1.6058531618986147e-10 * z + -7.586697117706918e-13 * z2;
    return z * (low + middle * z2 + high * (z2 * z2));
}

/**
 * (cos q - 1 + z/2)/z^2 for z = q^2 up to (pi/4)^2.
 *
 * @type {(z: number) => number}
 */
export function _cos(z) {
    const z2 = z * z;
    const low = 0.041666666666666664 + -0.0013888888888887398 * z;
    const middle = 2.480158729876569e-05 + -2.7557317271729793e-07 * z;
    return low + middle * z2 + (2.08761462684032e-09 + -1.1382632425521717e-11 * z) * (z2 * z2);
}

/**
 * The quarter turns in an angle, 0 to 3, and sine and cosine of the remainder, which is within pi/4.
 *
 * @type {(a: number) => [number, number, number]}
 */
export function _quarters(a) {
    const n = Math.floor(a * (2.0 / 3.141592653589793) + 0.5) * 1.0;
    const q = a - n * HALF_PI_1 - n * HALF_PI_2 - n * HALF_PI_3;
    const z = q * q;
    return [n - 4.0 * Math.floor(0.25 * n), q + q * _sin(z), 1.0 - (0.5 * z - z * z * _cos(z))];
}

/**
 * Cosine for |a| up to 2^19.
 *
 * @type {(a: number) => number}
 */
export function cos(a) {
    const _quarters_1 = _quarters(a);
    const quarters = _quarters_1[0], s = _quarters_1[1], c = _quarters_1[2];
    /** @type {boolean} */ const odd = quarters === 1.0 || quarters === 3.0;
    const value = odd ? s : c;
    return quarters === 1.0 || quarters === 2.0 ? -value : value;
}

/**
 * Sine for |a| up to 2^19.
 *
 * @type {(a: number) => number}
 */
export function sin(a) {
    const _quarters_1 = _quarters(a);
    const quarters = _quarters_1[0], s = _quarters_1[1], c = _quarters_1[2];
    /** @type {boolean} */ const odd = quarters === 1.0 || quarters === 3.0;
    const value = odd ? c : s;
    return quarters >= 2.0 ? -value : value;
}

/**
 * Position (x, y) and unit velocity (c, s) after a time t with control u: the exact flow of (1).
 *
 * The displacement is the chord of the arc, 2 sin(t/2) long, along the velocity at half time. This avoids the
 * difference of two nearly equal sines for short arcs.
 *
 * @type {(x: number, y: number, c: number, s: number, u: number, t: number) => [number, number, number, number]}
 */
export function fly(x, y, c, s, u, t) {
    const half = 0.5 * u * t;
    const ch = cos(half), sh = sin(half);
    const chord = u !== 0 ? 2.0 * sin(0.5 * t) : t;
    const ce = cos(u * t), se = sin(u * t);
    return [x + chord * (c * ch - s * sh), y + chord * (s * ch + c * sh), c * ce - s * se, s * ce + c * se];
}

/**
 * The state after a time t with control u, by (7): turned about (0, -u), or shifted along x for u = 0.
 *
 * @type {(x: number, y: number, u: number, t: number) => [number, number]}
 */
export function flow(x, y, u, t) {
    if (u === 0) {
        return [x + t, y];
    }
    const w = u * y + 1.0;
    const ce = cos(t), se = sin(t);
    return [x * ce + w * se, u * (w * ce - x * se - 1.0)];
}

/**
 * Whether `status_of` is OK: state and circle are within REACH, and the circle can be held.
 *
 * @type {(x: number, y: number, R: number, tolerance: number) => boolean}
 */
export function is_solvable(x, y, R, tolerance) {
    /** @type {boolean} */ const near = Math.abs(x) <= REACH && Math.abs(y) <= REACH && (0.0 <= tolerance &&
            tolerance <= REACH);
    return near && (1.0 - ROUNDING <= R && R <= REACH);
}

/**
 * R, or 1 where R is less than 1 by rounding only: a circle as tight as the aircraft can turn.
 *
 * @type {(R: number) => number}
 */
export function rounded_radius(R) {
    return 1.0 - ROUNDING <= R && R < 1.0 ? 1.0 : R;
}

/**
 * `Status.OK`, or why there is nothing to solve.
 *
 * @type {(x: number, y: number, R: number, tolerance: number) => number}
 */
export function synthesis_status_of(x, y, R, tolerance) {
    if (is_solvable(x, y, R, tolerance)) {
        return Status.OK;
    }
    if (!(isfinite(x) && isfinite(y) && isfinite(R))) {
        return Status.NOT_FINITE;
    }
    if (rounded_radius(R) < 1.0) {
        return Status.RADIUS_TOO_SMALL;
    }
    if (Math.abs(x) > REACH || Math.abs(y) > REACH || R > REACH) {
        return Status.OUT_OF_RANGE;
    }
    return Status.BAD_TOLERANCE;
}

/**
 * The plain number of a member of `Word`, `Side` or `Status`, which Python answers in as compiled code does.
 *
 * @type {(member: number) => number}
 */
export function code(member) {
    return member + 0;
}

/**
 * The side that is never slower: T_either(x, y) = T_cw(x, |y|) (paper, section 5); clockwise on y = 0.
 *
 * @type {(y: number) => number}
 */
export function near_side(y) {
    return y < 0.0 ? -1 : 1;
}

/**
 * The side itself; for *either*, the near side.
 *
 * @type {(y: number, side: number) => number}
 */
export function side_or_near(y, side) {
    return side !== Side.EITHER ? code(side) : near_side(y);
}

/**
 * The length tolerance: the rounding error of lengths for a state and a circle of this size.
 *
 * @type {(x: number, y: number, R: number) => number}
 */
export function rounding(x, y, R) {
    return ROUNDING * (1.0 + Math.abs(x) + Math.abs(y) + R);
}

/**
 * The share of the end-point tolerance that each of at most three pieces may use up.
 *
 * @type {(x: number, y: number, R: number, tolerance: number) => number}
 */
export function arc_tolerance_of(x, y, R, tolerance) {
    return max_real(tolerance, rounding(x, y, R)) / 3.0;
}

/**
 * The rounded sum a + b, and its rounding error, exactly.
 *
 * @type {(a: number, b: number) => [number, number]}
 */
export function two_sum(a, b) {
    const s = a + b;
    const t = s - a;
    return [s, a - (s - t) + (b - t)];
}

/**
 * A double as the sum of two of 26 digits.
 *
 * @type {(a: number) => [number, number]}
 */
export function split(a) {
    const c = SPLITTER * a;
    const high = c - (c - a);
    return [high, a - high];
}

/**
 * The rounded product a b, and its rounding error, exactly for |a|, |b| < 2^480.
 *
 * @type {(a: number, b: number) => [number, number]}
 */
export function two_product(a, b) {
    const p = a * b;
    const split_1 = split(a);
    const ah = split_1[0], al = split_1[1];
    const split_2 = split(b);
    const bh = split_2[0], bl = split_2[1];
    return [p, ah * bh - p + ah * bl + al * bh + al * bl];
}

/**
 * The squared distances rp^2 - (R + 1)^2, rm^2 - (R - 1)^2 and rp^2 - (R - 3)^2 beyond three circles.
 *
 * They are `beyond` with R and 2, R and -2, 2 - R and 2. The last is the sum u + d + low, with an error of third
 * order only: at R = 1 + 2e-14 there are doubles next to (-sqrt(3), 0) where it is 8e-32, and where T would lose
 * 1e-9 for the terms that `beyond` leaves out. The others differ from it by -8 (R - 1) and -4 (y + R - 2); for them
 * an error of second order is enough, since next to their circles a single arc replaces the words that depend on
 * them.
 *
 * @type {(x: number, y: number, R: number) => [number, number, number]}
 */
export function beyond_circles(x, y, R) {
    const two_sum_1 = two_sum(y, R - 2.0);
    const s = two_sum_1[0], es = two_sum_1[1];
    const two_sum_2 = two_sum(y, 2.0 - R);
    let t = two_sum_2[0];
    const et = two_sum_2[1];
    const two_sum_3 = two_sum(t, 2.0);
    t = two_sum_3[0];
    const ek = two_sum_3[1];
    const two_sum_4 = two_sum(et, ek);
    const e = two_sum_4[0], ee = two_sum_4[1];
    const two_product_5 = two_product(s, t);
    const p = two_product_5[0], ep = two_product_5[1];
    const two_product_6 = two_product(x, x);
    const q = two_product_6[0], eq = two_product_6[1];
    const two_product_7 = two_product(s, e);
    const v = two_product_7[0], ev = two_product_7[1];
    const two_product_8 = two_product(t, es);
    const w = two_product_8[0], ew = two_product_8[1];
    const two_sum_9 = two_sum(q, p);
    const u = two_sum_9[0], eu = two_sum_9[1];
    const two_sum_10 = two_sum(ep, eq);
    const a = two_sum_10[0], ea = two_sum_10[1];
    const two_sum_11 = two_sum(v, w);
    const b = two_sum_11[0], eb = two_sum_11[1];
    const two_sum_12 = two_sum(a, b);
    const c = two_sum_12[0], ec = two_sum_12[1];
    const two_sum_13 = two_sum(eu, c);
    const d = two_sum_13[0], ed = two_sum_13[1];
    const low = es * e + s * ee + (ev + ew + (ea + eb + (ec + ed)));
    const two_sum_14 = two_sum(u, -8.0 * (R - 1.0));
    const f = two_sum_14[0], ef = two_sum_14[1];
    const two_sum_15 = two_sum(u, -4.0 * s);
    const g = two_sum_15[0], eg = two_sum_15[1];
    return [f + (ef + d), g + (eg + d - 4.0 * es), u + d + low];
}

/**
 * The start at a reduced state.
 *
 * @type {(x: number, y: number, R: number, arc_tolerance: number) => Start}
 */
export function start_at(x, y, R, arc_tolerance) {
    const beyond_circles_1 = beyond_circles(x, y, R);
    const outer = beyond_circles_1[0], inner = beyond_circles_1[1], fold = beyond_circles_1[2];
    return { x, y, R, arc_tolerance, outer, inner, fold };
}

/**
 * The rotation, or that by zero where it is less than a full turn by at most `arc_tolerance` of arc length.
 *
 * `radius2` is the square of the radius of the arc. Leaving out the full turn moves the end point by at most
 * `arc_tolerance`; it removes the jump of T that rounding or noise would cause where an arc vanishes
 * (docs/theory.md, section 6). The missing angle is replaced by its tangent, which is no smaller.
 *
 * @type {(rotated: [number, number], radius2: number, arc_tolerance: number) => [number, number]}
 */
export function snap_full_turn(rotated, radius2, arc_tolerance) {
    const cross = rotated[0], dot = rotated[1];
    /** @type {boolean} */ const nearly_full = (cross < 0.0 && 0.0 < dot) && cross * cross * radius2 <=
            arc_tolerance * arc_tolerance * dot * dot;
    return [nearly_full ? 0.0 : rotated[0], nearly_full ? dot : rotated[1]];
}

/**
 * The rotation of a left turn from (x, y) to the point (end c, 0) of the axis y = 0, end = -1 or +1; and c.
 *
 * c is sqrt(rp^2 - 1), or -1 where the turn never meets the axis (rp < 1). A right turn is the mirror image: pass
 * -y. The cross product is end (c y + c - end x); where end x > 0, c - end x = y (y + 2) / (c + end x), so the
 * rotation has exactly the sign of y.
 *
 * @type {(x: number, y: number, end_: number, arc_tolerance: number) => [[number, number], number]}
 */
export function onto_axis(x, y, end_, arc_tolerance) {
    const rise = y * (y + 2.0);
    const c2 = x * x + rise;
    const c = Math.sqrt(max_real(c2, 0.0));
    const along = end_ * x;
    // Both products are multiplied by c + along where that is safe, which saves a division.
    const scale = along > SMALLEST_SCALE ? c + along : 1.0;
    const gap = along > SMALLEST_SCALE ? rise : c - along;
    /** @type {[number, number]} */ const products = [end_ * (c * y * scale + gap), (c * along + y + 1.0) * scale];
    return [snap_full_turn(products, c2 + 1.0, arc_tolerance), c2 >= 0.0 ? c : -1.0];
}

/**
 * LSL: onto the axis at (-c, 0), straight to (-X, 0), X = sqrt(R (R + 2)), left for acos(1/(R + 1)).
 *
 * `y` is the ordinate of the start, with the opposite sign for RSL. `joins` says whether c >= X, decided as in the
 * selection of words; rounding may still make c - X negative.
 *
 * @type {(word: number, y: number, start: Start, joins: boolean) => Extremal}
 */
export function external_join(word, y, start, joins) {
    const R = start.R;
    const onto_axis_1 = onto_axis(start.x, y, -1.0, start.arc_tolerance);
    /** @type {[number, number]} */ const first = onto_axis_1[0];
    const c = onto_axis_1[1];
    const X = Math.sqrt(R * (R + 2.0));
    return { word, first, straight: joins ? max_real(c - X, 0.0) : Infinity, middle: NO_ROTATION, last: [X, 1.0] };
}

/**
 * Right, straight, left, rm >= R + 1: the first arc is the mirror image of that of LSL.
 *
 * @type {(start: Start) => Extremal}
 */
export function rsl(start) {
    return external_join(Word.RSL, -start.y, start, start.inner >= 4.0 * start.R);
}

/**
 * (R + 3)^2 - rm^2: not negative where the circle of R meets the last circle of L, so where RL exists.
 *
 * It is 4 (R + y + 2) - `outer`, and not computed as 8 (R + 1) - `inner`: next to (0, -R - 2), where it vanishes
 * and RL is the fastest, neither term is negative, so that no digits are lost. T varies with its square root.
 *
 * @type {(start: Start) => number}
 */
export function within_reach(start) {
    return 4.0 * (start.R + start.y + 2.0) - start.outer;
}

/**
 * The squared distance from (0, centre), accurate even near zero; computed from `beyond` it would lose digits.
 *
 * @type {(x: number, y: number, centre: number) => number}
 */
export function squared_distance(x, y, centre) {
    return x * x + (y - centre) * (y - centre);
}

/**
 * The counter-clockwise rotation from direction (ax, ay) to (bx, by); by zero where one of them is zero.
 *
 * @type {(ax: number, ay: number, bx: number, by: number) => [number, number]}
 */
export function rotation(ax, ay, bx, by) {
    return [ax * by - ay * bx, ax * bx + ay * by + TINY];
}

/**
 * RL: right to the crossing with the last circle (R + 1 about (0, -1)) where x1 has `branch`'s sign; then left.
 *
 * The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = `inner` = rm^2 - (R - 1)^2 and p = `within_reach`
 * = (R + 3)^2 - rm^2.
 *
 * @type {(start: Start, branch: number) => Extremal}
 */
export function rl(start, branch) {
    const x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, inner = start.inner;
    const p = within_reach(start);
    const x1 = branch * 0.25 * Math.sqrt(max_real(p * inner, 0.0));
    const radius2 = squared_distance(x, y, 1.0);
    /** @type {[number, number]} */ const first = snap_full_turn(rotation(x, y - 1.0, x1, R - 1.0 - 0.25 * inner),
            radius2, arc_tolerance);
    /** @type {[number, number]} */ const last = snap_full_turn([-x1, R + 1.0 - 0.25 * inner], (R + 1.0) * (R +
            1.0), arc_tolerance);
    return { word: Word.RL, first, straight: inner >= 0.0 && p >= 0.0 ? 0.0 : Infinity, middle: last, last:
            NO_ROTATION };
}

/**
 * Extremal a where the condition holds, otherwise b; compiled code has `compiled.branchless.select` instead.
 *
 * @type {(condition: boolean, a: Extremal, b: Extremal) => Extremal}
 */
export function select(condition, a, b) {
    return condition ? a : b;
}

/**
 * LSR, R >= 2: onto the axis at (c, 0), straight to (X, 0), X = sqrt(R (R - 2)), right for pi - acos(1/(R - 1)).
 *
 * `y` as in `external_join`, with the opposite sign for RSR; `joins` says whether c <= X.
 *
 * @type {(word: number, y: number, start: Start, joins: boolean) => Extremal}
 */
export function internal_join(word, y, start, joins) {
    const R = start.R;
    const onto_axis_1 = onto_axis(start.x, y, 1.0, start.arc_tolerance);
    /** @type {[number, number]} */ const first = onto_axis_1[0];
    const c = onto_axis_1[1];
    const X = Math.sqrt(max_real(R * (R - 2.0), 0.0));
    const straight = R >= 2.0 && c >= 0.0 && joins ? max_real(X - c, 0.0) : Infinity;
    return { word, first, straight, middle: NO_ROTATION, last: [X, -1.0] };
}

/**
 * Right, straight, right, rm <= R - 1: the first arc is the mirror image of that of LSR.
 *
 * @type {(start: Start) => Extremal}
 */
export function rsr(start) {
    return internal_join(Word.RSR, -start.y, start, start.inner <= 0.0);
}

/**
 * Of the extremals of several pieces that begin with R, the one that can win, by rm; see `left_first`.
 *
 * @type {(start: Start) => Extremal}
 */
export function right_first(start) {
    let best = select(start.inner > 4.0 * start.R, rsl(start), rl(start, -1.0));
    if (start.y < 0.0) {
        best = select(start.inner < 0.0, rsr(start), best);
    }
    return best;
}

/**
 * Whether a point is within a distance of a circle; `beyond2`: squared distance from the centre less radius^2.
 *
 * @type {(beyond2: number, radius: number, distance: number) => boolean}
 */
export function is_near_circle(beyond2, radius, distance) {
    const inwards = min_real(distance, radius);
    return -inwards * (2.0 * radius - inwards) <= beyond2 && beyond2 <= distance * (2.0 * radius + distance);
}

/**
 * Right along the circle of radius R - 1 about (0, 1), from within `arc_tolerance` of it: the limit of LR.
 *
 * @type {(start: Start) => Extremal}
 */
export function r(start) {
    const x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, inner = start.inner;
    /** @type {[number, number]} */ const first = snap_full_turn([x, y - 1.0], (R - 1.0) * (R - 1.0),
            arc_tolerance);
    const straight = R > 1.0 && is_near_circle(inner, R - 1.0, arc_tolerance) ? 0.0 : Infinity;
    return { word: Word.R, first, straight, middle: NO_ROTATION, last: NO_ROTATION };
}

/**
 * The difference a^2 - b with nearly full relative accuracy even near zero, for |a| < 2^480.
 *
 * @type {(a: number, b: number) => number}
 */
export function square_beyond(a, b) {
    const two_product_1 = two_product(a, a);
    const p = two_product_1[0], e = two_product_1[1];
    return p - b + e;
}

/**
 * `gap` and v of the quadratic 3 w^2 - 2 gap w + v = 0 of `lrl`.
 *
 * @type {(start: Start) => [number, number]}
 */
export function lrl_quadratic(start) {
    const R = start.R, outer = start.outer, fold = start.fold;
    const gap = -0.5 * fold - square_beyond(R - 1.0, 3.0);
    const v = -0.0625 * fold * (8.0 * (R + 3.0) - outer);
    return [gap, v];
}

/**
 * Left to the switching curve at (xa, ya), right for more than pi to (xb, yb) on the last circle, left.
 *
 * With xa / ya = -xb / yb = m and a = 1 + m^2, the circles give a ya^2 + 2 ya = k = rp^2 - 1, a yb^2 + 2 yb = K = R
 * (R + 2) and a (ya + yb) = 2; hence yb - ya = d = (K - k)/4 = -outer/4 and, for s = ya + yb = 2/a and h = (K +
 * k)/2, the larger root of 3 s^2 - 2 h s + d^2 = 0. Quantities that vanish in places are not computed as
 * differences of others: ya comes from k, and w = 2 - s = m^2 s is the smaller root of 3 w^2 - 2 gap w + v = 0 with
 * v = -`fold` ((R + 5)^2 - rp^2)/16 and gap = 6 - h = 3 - (R - 1)^2 - `fold`/2, whose terms have one sign where LRL
 * is the fastest; so LRL needs rp <= 3 - R.
 *
 * @type {(start: Start) => Extremal}
 */
export function lrl(start) {
    const x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, outer = start.outer, fold =
            start.fold;
    const k = x * x + y * (y + 2.0), d = -0.25 * outer;
    const lrl_quadratic_1 = lrl_quadratic(start);
    const gap = lrl_quadratic_1[0], v = lrl_quadratic_1[1];
    const D = gap * gap - 3.0 * v;
    /** @type {boolean} */ const exists = R <= 3.0 && fold <= 0.0 && D >= 0.0 && gap > 0.0;
    const root = Math.sqrt(max_real(D, 0.0));
    const above = 6.0 - gap + root, below = exists ? gap + root : 1.0;
    const share = 1.0 / (above * below);
    const w = v * above * share;
    const a = 6.0 * below * share;
    const m = Math.sqrt(max_real(0.5 * a * w, 0.0));
    // ya = k/q; every vector is multiplied by q.
    const q = 1.0 + Math.sqrt(max_real(1.0 + a * k, 0.0));
    const ya = k, yb = k + d * q;
    const xa = m * ya, xb = -m * yb;
    /** @type {[number, number]} */ const first = snap_full_turn(rotation(xa, ya + q, x, y + 1.0),
            squared_distance(x, y, -1.0), arc_tolerance);
    // ya - 1 and yb - 1 from the quantities that make them small: at R = 1 both vanish on the last arc.
    /** @type {[number, number]} */ const middle = rotation(xa, -0.5 * (w + d) * q, xb, -0.5 * (w - d) * q);
    /** @type {[number, number]} */ const last = [-xb, yb + q];
    return { word: Word.LRL, first, straight: exists ? 0.0 : Infinity, middle, last };
}

/**
 * Left, straight, right, from inside a circle of R >= 2: rp <= R - 1, that is rp^2 - (R - 3)^2 <= 4 (R - 2).
 *
 * @type {(start: Start) => Extremal}
 */
export function lsr(start) {
    return internal_join(Word.LSR, start.y, start, start.fold <= 4.0 * (start.R - 2.0));
}

/**
 * Whether an extremal ends at the target.
 *
 * @type {(extremal: Extremal) => boolean}
 */
export function reaches(extremal) {
    return extremal.straight < Infinity;
}

/**
 * LR, R > 1: left to the crossing with the circle (R - 1 about (0, 1)) where x1 has `branch`'s sign; then right.
 *
 * The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = -`outer` = (R + 1)^2 - rp^2, p = `fold` = rp^2 -
 * (R - 3)^2. So y1 + 1 is R + 1 - q/4 or 3 - R + p/4, and y1 - 1 is R - 1 - q/4: those forms are used whose terms
 * are no longer than the arc's radius, however small that is.
 *
 * @type {(start: Start, branch: number) => Extremal}
 */
export function lr(start, branch) {
    const x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, outer = start.outer, fold =
            start.fold;
    const x1 = branch * 0.25 * Math.sqrt(max_real(-outer * fold, 0.0));
    const radius2 = squared_distance(x, y, -1.0);
    /** @type {[number, number]} */ const first = snap_full_turn(rotation(x1, 3.0 - R + 0.25 * fold, x, y + 1.0),
            radius2, arc_tolerance);
    /** @type {[number, number]} */ const last = snap_full_turn([x1, R - 1.0 + 0.25 * outer], (R - 1.0) * (R - 1.0),
            arc_tolerance);
    return { word: Word.LR, first, straight: R > 1.0 && outer <= 0.0 && fold >= 0.0 ? 0.0 : Infinity, middle: last,
            last: NO_ROTATION };
}

/**
 * Left, straight along the line through the centre, left: rp >= R + 1.
 *
 * @type {(start: Start) => Extremal}
 */
export function lsl(start) {
    return external_join(Word.LSL, start.y, start, start.outer >= 0.0);
}

/**
 * Of the extremals of several pieces that begin with L, the one that can win (docs/theory.md, section 4).
 *
 * It is determined by rp. `detour` gives the other crossing of LR, which is not considered here.
 *
 * @type {(start: Start) => Extremal}
 */
export function left_first(start) {
    let best = lrl(start);
    if (start.R > 1.0) {
        let inside = lsr(start);
        inside = select(reaches(inside), inside, lr(start, 1.0));
        best = select(start.fold <= 0.0 && start.R <= 3.0, best, inside);
    }
    if (start.y < 0.0) {
        best = select(start.outer >= 0.0, lsl(start), best);
    }
    return best;
}

/**
 * Left along the last circle, radius R + 1 about (0, -1), from within `arc_tolerance` of it: the limit of RL.
 *
 * @type {(start: Start) => Extremal}
 */
export function l(start) {
    const x = start.x, y = start.y, R = start.R, arc_tolerance = start.arc_tolerance, outer = start.outer;
    /** @type {[number, number]} */ const first = snap_full_turn([-x, y + 1.0], (R + 1.0) * (R + 1.0),
            arc_tolerance);
    const straight = is_near_circle(outer, R + 1.0, arc_tolerance) ? 0.0 : Infinity;
    return { word: Word.L, first, straight, middle: NO_ROTATION, last: NO_ROTATION };
}

/**
 * Whether the angle of a rotation is in [0, pi].
 *
 * @type {(rotated: [number, number]) => boolean}
 */
export function is_at_most_half_turn(rotated) {
    const cross = rotated[0];
    return cross >= 0.0;
}

/**
 * Whether a single arc replaces the words of which it is the limit: of at most half a turn, or of any length.
 *
 * @type {(arc: Extremal, any_length: boolean) => boolean}
 */
export function is_limit(arc, any_length) {
    return reaches(arc) && (is_at_most_half_turn(arc.first) || any_length);
}

/**
 * The rotation, less half a turn where it is half a turn or more, and the count `halves` of these half turns.
 *
 * @type {(rotated: [number, number], halves: number) => [number, number, number]}
 */
export function fold_half_turn(rotated, halves) {
    const cross = rotated[0], dot = rotated[1];
    if (cross < 0.0 || (cross === 0.0 && dot < 0.0)) {
        return [-cross, -dot, halves + 1.0];
    }
    return [cross, dot, halves];
}

/**
 * atan(q)/q - 1 for z = q^2 up to tan(pi/8)^2; summed in pairs, which shortens the chain of operations.
 *
 * @type {(z: number) => number}
 */
export function _atan(z) {
    const z2 = z * z;
    const z4 = z2 * z2;
    const low = -0.3333333333333333 + 0.19999999999999804 * z + (-0.14285714285659828 + 0.11111111105155447 * z) *
            z2;
    const middle = -0.09090908753500877 + 0.07692296375032143 * z + (-0.06666424885738255 + 0.05878928997834775 * z)
            * z2;
    const high = -0.05230454270650244 + 0.04551593220626549 * z + (-0.034570561981427744 + 0.016285756855221028 * z)
            * z2;
    return z * (low + middle * z4 + high * (z4 * z4));
}

/**
 * The angle of (x, y) in [-pi, pi], 0 for (0, 0); finite arguments. The sign of a zero is ignored.
 *
 * The smaller coordinate over the larger one, reduced from pi/4 to pi/8 by tan(a - pi/4) = (t - 1)/(t + 1).
 *
 * @type {(y: number, x: number) => number}
 */
export function atan2(y, x) {
    const ax = Math.abs(x), ay = Math.abs(y);
    const large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
    /** @type {boolean} */ const beyond = small > TAN_EIGHTH * large;
    const above = beyond ? small - large : small, below = beyond ? small + large : large;
    const q = above / (below > 0.0 ? below : 1.0);
    let a = q + q * _atan(q * q) + (beyond ? 0.25 * 3.141592653589793 : 0.0);
    a = ay > ax ? 0.5 * 3.141592653589793 - a : a;
    a = x < 0.0 ? 3.141592653589793 - a : a;
    return y < 0.0 ? -a : a;
}

/**
 * The sum of the angles of three rotations, in [0, 6 pi], with one arctangent.
 *
 * Multiplying the vectors as complex numbers adds their angles. Each is first folded below pi, so that two of them
 * make less than a full turn and no whole turn is lost.
 *
 * @type {(first: [number, number], second: [number, number], third: [number, number]) => number}
 */
export function total_angle(first, second, third) {
    const fold_half_turn_1 = fold_half_turn(first, 0.0);
    const c1 = fold_half_turn_1[0], d1 = fold_half_turn_1[1];
    let halves = fold_half_turn_1[2];
    const fold_half_turn_2 = fold_half_turn(second, halves);
    const c2 = fold_half_turn_2[0], d2 = fold_half_turn_2[1];
    halves = fold_half_turn_2[2];
    const fold_half_turn_3 = fold_half_turn([c1 * d2 + d1 * c2, d1 * d2 - c1 * c2], halves);
    let c = fold_half_turn_3[0], d = fold_half_turn_3[1];
    halves = fold_half_turn_3[2];
    const fold_half_turn_4 = fold_half_turn(third, halves);
    const c3 = fold_half_turn_4[0], d3 = fold_half_turn_4[1];
    halves = fold_half_turn_4[2];
    const fold_half_turn_5 = fold_half_turn([c * d3 + d * c3, d * d3 - c * c3], halves);
    c = fold_half_turn_5[0];
    d = fold_half_turn_5[1];
    halves = fold_half_turn_5[2];
    return 3.141592653589793 * halves + atan2(c, d);
}

/**
 * T, the whole time of an extremal; `inf` where it does not reach the target.
 *
 * @type {(extremal: Extremal) => number}
 */
export function extremals_duration(extremal) {
    return extremal.straight + total_angle(extremal.first, extremal.middle, extremal.last);
}

/**
 * The least time so far and its extremal, or those of another extremal that takes less.
 *
 * @type {(least: number, best: Extremal, other: Extremal) => [number, Extremal]}
 */
export function faster_of(least, best, other) {
    const time = extremals_duration(other);
    return [time < least ? time : least, select(time < least, other, best)];
}

/**
 * The only RL or LR with the other crossing that can win, for y < 0: its first arc ends before the axis.
 *
 * @type {(start: Start) => Extremal}
 */
export function detour(start) {
    return select(start.inner > 4.0 * start.R, rl(start, 1.0), lr(start, -1.0));
}

/**
 * The least T and its extremal, among at most three words: one for each first turn, and the `detour`.
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
 *
 * @type {(x: number, y: number, R: number, arc_tolerance: number, exact: boolean) => [number, Extremal]}
 */
export function extremals_fastest(x, y, R, arc_tolerance, exact) {
    const start = start_at(x, y, R, arc_tolerance);
    let right = right_first(start);
    const only_right = r(start);
    let left = left_first(start);
    const only_left = l(start);
    if (exact) {
        left = select(is_limit(only_left, y <= 0.0), only_left, left);
        right = select(is_limit(only_right, y <= 0.0 || start.outer <= 0.0), only_right, right);
    }
    let best;
    if (exact && R === 1.0 && !(y < 0.0)) {
        best = select(reaches(left) && is_at_most_half_turn(left.first), left, right);
        return [extremals_duration(best), best];
    }
    const faster_of_1 = faster_of(extremals_duration(right), right, left);
    let least = faster_of_1[0];
    best = faster_of_1[1];
    if (y < 0.0) {
        const faster_of_2 = faster_of(least, best, detour(start));
        least = faster_of_2[0];
        best = faster_of_2[1];
    }
    if (!exact) {
        const faster_of_3 = faster_of(least, best, only_left);
        least = faster_of_3[0];
        best = faster_of_3[1];
        const faster_of_4 = faster_of(least, best, only_right);
        least = faster_of_4[0];
        best = faster_of_4[1];
    }
    return [least, best];
}

/**
 * The angle of a counter-clockwise rotation, in [0, 2 pi]; that of a clockwise one is `angle((-cross, dot))`.
 *
 * One arctangent has an error of about one rounding of the angle itself; a difference of two arctangents would lose
 * the digits of a small rotation.
 *
 * @type {(rotated: [number, number]) => number}
 */
export function angle(rotated) {
    const cross = rotated[0], dot = rotated[1];
    const turned = atan2(cross, dot);
    // + 0.0 turns -0.0 into 0.0, so that no duration has a negative sign.
    return turned < 0.0 ? turned + TWO_PI : turned + 0.0;
}

/**
 * The durations of the pieces in flying order, 0 past the last.
 *
 * @type {(extremal: Extremal) => [number, number, number]}
 */
export function durations(extremal) {
    return [angle(extremal.first), extremal.straight + angle(extremal.middle), angle(extremal.last)];
}

/**
 * The controls of the three pieces of a word, `ABSENT` past its last.
 *
 * @type {(word: number) => [number, number, number]}
 */
export function controls(word) {
    return [(word & 3) - 2, ((word >> 2) & 3) - 2, ((word >> 4) & 3) - 2];
}

/**
 * The word of the controls -1, 0 or +1 of up to three pieces, in the order flown.
 *
 * @type {(u1: number, u2: number, u3: number) => number}
 */
export function encode(u1, u2, u3) {
    return u1 + 2 + 4 * (u2 + 2) + 16 * (u3 + 2);
}

/**
 * The word without its first piece.
 *
 * @type {(word: number) => number}
 */
export function rest(word) {
    return (word >> 2);
}

/**
 * The word as flown: without a straight piece up to `short` and arcs up to `no_angle`; equal arcs are joined.
 *
 * @type {(word: number, t1: number, t2: number, t3: number, short_: number, no_angle: number) => [number, number,
 *         number, number]}
 */
export function drop_short_pieces(word, t1, t2, t3, short_, no_angle) {
    const controls_1 = controls(word);
    let first = controls_1[0];
    const last = controls_1[2];
    if (last !== ABSENT && t2 <= short_) {
        if (first === last) {
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
    const controls_2 = controls(word);
    first = controls_2[0];
    const second = controls_2[1], third = controls_2[2];
    if (second !== ABSENT && third === ABSENT && t2 <= no_angle) {
        word = encode(first, -2, -2);
        t2 = 0.0;
    }
    if (t1 <= no_angle) {
        word = rest(word);
        t1 = t2;
        t2 = t3;
        t3 = 0.0;
    }
    return [word, t1, t2, t3];
}

/**
 * The opposite control; `ABSENT` stays as it is.
 *
 * @type {(u: number) => number}
 */
export function opposite(u) {
    return u === ABSENT ? u : 0 - u;
}

/**
 * The word with L and R exchanged.
 *
 * @type {(word: number) => number}
 */
export function mirrored(word) {
    const controls_1 = controls(word);
    const u1 = controls_1[0], u2 = controls_1[1], u3 = controls_1[2];
    return encode(opposite(u1), opposite(u2), opposite(u3));
}

/**
 * An extremal of the clockwise circle as the maneuver flown onto the circle of the given side.
 *
 * Leaving out a piece, or an almost full turn, moves the end by at most a third of `length_tolerance`, since the
 * radius of an arc is no more than 1 + |x| + |y| + R. So three pieces together miss the target by no more than
 * `length_tolerance`.
 *
 * @type {(extremal: Extremal, length_tolerance: number, side: number) => Entry}
 */
export function flown_entry(extremal, length_tolerance, side) {
    const durations_1 = durations(extremal);
    let t1 = durations_1[0], t2 = durations_1[1], t3 = durations_1[2];
    const drop_short_pieces_2 = drop_short_pieces(code(extremal.word), t1, t2, t3, length_tolerance / 3.0, ROUNDING
            / 3.0);
    const word = drop_short_pieces_2[0];
    t1 = drop_short_pieces_2[1];
    t2 = drop_short_pieces_2[2];
    t3 = drop_short_pieces_2[3];
    return { side, word: side < 0 ? mirrored(word) : word, t1, t2, t3 };
}

/**
 * The fastest maneuver onto the circle held on one side.
 *
 * @type {(x: number, y: number, R: number, side: number, tolerance: number) => Entry}
 */
export function optimum_on_side(x, y, R, side, tolerance) {
    const fastest_1 = extremals_fastest(x, side * y, R, arc_tolerance_of(x, y, R, tolerance), tolerance === 0.0);
    const best = fastest_1[1];
    return flown_entry(best, rounding(x, y, R), side);
}

/**
 * T, the whole time of a maneuver.
 *
 * @type {(maneuver: Entry) => number}
 */
export function entry_duration(maneuver) {
    return maneuver.t1 + maneuver.t2 + maneuver.t3;
}

/**
 * Whether a maneuver is faster than another by more than rounding.
 *
 * @type {(maneuver: Entry, other: Entry, length_tolerance: number) => boolean}
 */
export function is_faster(maneuver, other, length_tolerance) {
    return entry_duration(maneuver) < entry_duration(other) - length_tolerance;
}

/**
 * The fastest maneuver onto the circle from the reduced state (x, y); to be called only where `status_of` is OK.
 *
 * For *either*, the far side can be faster than the near one only within a tolerance; only then are both solved.
 *
 * @type {(x: number, y: number, R: number, side: number, tolerance: number) => Entry}
 */
export function optimum(x, y, R, side, tolerance) {
    const near = optimum_on_side(x, y, R, side_or_near(y, side), tolerance);
    if (side !== Side.EITHER || tolerance === 0.0) {
        return near;
    }
    const far = optimum_on_side(x, y, R, 0 - near_side(y), tolerance);
    return is_faster(far, near, rounding(x, y, R)) ? far : near;
}

/**
 * Every extremal for the target (0, R); of several that tie, the first is preferred.
 *
 * Where a straight piece is about to vanish, the words with and without it tie.
 *
 * @type {(x: number, y: number, R: number, arc_tolerance: number) => Extremal[]}
 */
export function extremals(x, y, R, arc_tolerance) {
    const start = start_at(x, y, R, arc_tolerance);
    return [l(start), r(start), lsl(start), rsl(start), lsr(start), rsr(start), rl(start, -1.0), rl(start, 1.0),
            lr(start, -1.0), lr(start, 1.0), lrl(start)];
}

/**
 * Whether two maneuvers, found as limits of two words, are the same.
 *
 * @type {(a: Entry, b: Entry, length_tolerance: number) => boolean}
 */
export function is_same(a, b, length_tolerance) {
    const difference = max_real(max_real(Math.abs(a.t1 - b.t1), Math.abs(a.t2 - b.t2)), Math.abs(a.t3 - b.t3));
    return a.side === b.side && a.word === b.word && difference <= length_tolerance;
}

/**
 * Every extremal that reaches the circle, each once, fastest first; for *either*, those of both sides.
 *
 * Extremals that are faster than the optimum are left out: they end beside the target, within a tolerance.
 *
 * @type {(x: number, y: number, R: number, side: number, tolerance: number) => Entry[]}
 */
export function synthesis_ranked(x, y, R, side, tolerance) {
    const length_tolerance = rounding(x, y, R);
    const least = entry_duration(optimum(x, y, R, side, tolerance)) - length_tolerance;
    const sides = side === Side.EITHER ? [near_side(y), 0 - near_side(y)] : [side];
    /** @type {Entry[]} */
    const maneuvers = [];
    for (const s of sides) {
        for (const extremal of extremals(x, s * y, R, arc_tolerance_of(x, y, R, tolerance))) {
            const maneuver = flown_entry(extremal, length_tolerance, s);
            /** @type {boolean} */ const known = maneuvers.some((other) => is_same(maneuver, other,
                    length_tolerance));
            const time = entry_duration(maneuver);
            if ((least <= time && time < Infinity) && !known) {
                maneuvers.push(maneuver);
            }
        }
    }
    return sorted(maneuvers, entry_duration);
}

/**
 * Whether a time T equals the least time in still air: up to the rounding of the scene, `rounding`.
 *
 * @type {(T: number, least: number, length_tolerance: number) => boolean}
 */
export function is_tie(T, least, length_tolerance) {
    return least + length_tolerance >= T;
}

/**
 * The times at which the pieces of a maneuver end.
 *
 * @type {(maneuver: Entry) => [number, number, number]}
 */
export function piece_ends(maneuver) {
    const t1 = maneuver.t1, t2 = maneuver.t2, t3 = maneuver.t3;
    return [t1, t1 + t2, t1 + t2 + t3];
}

/**
 * The control flown from the time t on; `ABSENT` past the end.
 *
 * @type {(maneuver: Entry, t: number) => number}
 */
export function control_at(maneuver, t) {
    const each_u_1 = controls(maneuver.word), each_end__1 = piece_ends(maneuver);
    for (let i_1 = 0; i_1 < each_u_1.length; i_1++) {
        const u = each_u_1[i_1], end_ = each_end__1[i_1];
        if (t < end_) {
            return u;
        }
    }
    return ABSENT;
}

/**
 * The time during which two maneuvers fly different controls.
 *
 * @type {(a: Entry, b: Entry) => number}
 */
export function time_apart(a, b) {
    let apart = 0.0, begin = 0.0;
    const piece_ends_1 = piece_ends(a);
    const piece_ends_2 = piece_ends(b);
    for (const end_ of sorted([piece_ends_1[0], piece_ends_1[1], piece_ends_1[2], piece_ends_2[0], piece_ends_2[1],
            piece_ends_2[2]], Number)) {
        if (control_at(a, begin) !== control_at(b, begin)) {
            apart += end_ - begin;
        }
        begin = end_;
    }
    return apart;
}

/**
 * Every optimal maneuver: those of `ranked` that tie with the fastest up to rounding, and differ by more than that.
 *
 * Where a straight piece of length s vanishes, the words with and without it differ in T by s^3/24 only (where an
 * arc vanishes at a switching curve: by s^2). So both tie for s up to the cube root of rounding: they count as one.
 *
 * @type {(x: number, y: number, R: number, side: number, tolerance: number) => Entry[]}
 */
export function synthesis_optima(x, y, R, side, tolerance) {
    const maneuvers = synthesis_ranked(x, y, R, side, tolerance);
    const length_tolerance = rounding(x, y, R);
    const least = Math.min(...maneuvers.map(entry_duration));
    const one_maneuver = 2.0 * Math.cbrt(24.0 * length_tolerance);
    /** @type {Entry[]} */
    const distinct = [];
    for (const maneuver of maneuvers) {
        /** @type {boolean} */ const ties = is_tie(entry_duration(maneuver), least, length_tolerance);
        if (ties && distinct.every((m) => maneuver.side !== m.side || time_apart(maneuver, m) > one_maneuver)) {
            distinct.push(maneuver);
        }
    }
    return distinct;
}

/**
 * T of `optimum_on_side`, without its pieces; a piece that is too short to be flown may be included.
 *
 * @type {(x: number, y: number, R: number, side: number, tolerance: number) => number}
 */
export function least_time(x, y, R, side, tolerance) {
    const fastest_1 = extremals_fastest(x, side * y, R, arc_tolerance_of(x, y, R, tolerance), tolerance === 0.0);
    const time = fastest_1[0];
    return time;
}

/**
 * Feedback law: the first control of a maneuver; at the target the rate -1/R or 1/R that holds the circle.
 *
 * @type {(R: number, maneuver: Entry) => number}
 */
export function first_control(R, maneuver) {
    const controls_1 = controls(maneuver.word);
    const first = controls_1[0];
    return first !== ABSENT ? first : (0 - maneuver.side) / R;
}

/**
 * The length of a vector whose square neither overflows nor underflows.
 *
 * Unlike `math.hypot`, whose algorithm is Python's own, compiled code gives the same value to the last bit.
 *
 * @type {(x: number, y: number) => number}
 */
export function length(x, y) {
    return Math.sqrt(x * x + y * y);
}

/**
 * The distance from the target, in the reduced plane, at which a maneuver from (x, y) ends when flown exactly.
 *
 * @type {(x: number, y: number, R: number, maneuver: Entry) => number}
 */
export function miss(x, y, R, maneuver) {
    const side = maneuver.side, word = maneuver.word, t1 = maneuver.t1, t2 = maneuver.t2, t3 = maneuver.t3;
    const each_u_1 = controls(word), each_t_1 = [t1, t2, t3];
    for (let i_1 = 0; i_1 < each_u_1.length; i_1++) {
        const u = each_u_1[i_1], t = each_t_1[i_1];
        if (u !== ABSENT) {
            const flow_1 = flow(x, y, u, t);
            x = flow_1[0];
            y = flow_1[1];
        }
    }
    return length(x, y - side * R);
}

/**
 * Whether a time T equals the least time in wind, within the accuracy of `wind_search.fastest`.
 *
 * @type {(T: number, least: number, R: number) => boolean}
 */
export function is_tie_in_wind(T, least, R) {
    return T - least <= WIND_TIE_TOLERANCE * (1.0 + R + least);
}

/**
 * The adjoint psi after a time t (before, if t < 0) with control u: the exact flow of the dual system (12).
 *
 * @type {(psi1: number, psi2: number, u: number, t: number) => [number, number]}
 */
export function turn_adjoint(psi1, psi2, u, t) {
    // psi is the constant adjoint of the position in axes along the course, so it turns opposite to the course.
    const fly_1 = fly(0.0, 0.0, psi1, psi2, 0 - u, t);
    psi1 = fly_1[2];
    psi2 = fly_1[3];
    return [psi1, psi2];
}

/**
 * The adjoint at a state (x, y) where phi = 0 and the next control is u.
 *
 * psi is parallel to (x, y). Its sign follows from psi1 = lambda >= 0, and also from phi' = -psi2, which has the
 * sign of u. The two agree on an optimum; the larger component of (x, y) decides, so that rounding of the smaller
 * one has no effect. At the centre any psi is possible: (1, 0) is chosen, that of the straight piece.
 *
 * @type {(x: number, y: number, u: number, R: number) => Adjoint}
 */
export function at_switch(x, y, u, R) {
    let r = length(x, y);
    if (r <= rounding(x, y, R)) {
        return { lam: 1.0, psi1: 1.0, psi2: 0.0 };
    }
    /** @type {boolean} */ const backwards = Math.abs(x) > Math.abs(y) ? x < 0.0 : u * y > 0.0;
    if (backwards) {
        r = -r;
    }
    return { lam: x / r, psi1: x / r, psi2: y / r };
}

/**
 * The adjoint at the start (x, y) of a single arc onto the circle, chosen as described at the top.
 *
 * @type {(x: number, y: number, R: number, maneuver: Entry) => Adjoint}
 */
export function of_single_arc(x, y, R, maneuver) {
    const controls_1 = controls(maneuver.word);
    const u = controls_1[0];
    const onto_axis_2 = onto_axis(x, u * y, -1.0 * u * maneuver.side, 0.0);
    /** @type {[number, number]} */ const to_axis = onto_axis_2[0];
    const c = onto_axis_2[1];
    if (c >= 0.0 && angle(to_axis) < maneuver.t1) {
        const turn_adjoint_3 = turn_adjoint(1.0, 0.0, u, -angle(to_axis));
        const psi1 = turn_adjoint_3[0], psi2 = turn_adjoint_3[1];
        return { lam: 1.0, psi1, psi2 };
    }
    const start = at_switch(x, y, u, R);
    // Past half a turn of the small circle lambda would be negative; there lambda = 0 is the nearest possible value.
    return start.lam < 0.0 ? { lam: 0.0, psi1: 0.0, psi2: -1.0 * u } : start;
}

/**
 * The adjoint at the start of a word of two or three arcs, from the last switch between L and R.
 *
 * @type {(R: number, maneuver: Entry) => Adjoint}
 */
export function of_arcs(R, maneuver) {
    const side = maneuver.side, word = maneuver.word, t1 = maneuver.t1, t2 = maneuver.t2, t3 = maneuver.t3;
    const controls_1 = controls(word);
    const first = controls_1[0], second = controls_1[1], third = controls_1[2];
    let x, y, lam, psi1, psi2;
    if (third === ABSENT) {
        const flow_2 = flow(0.0, side * R, second, -t2);
        x = flow_2[0];
        y = flow_2[1];
        const at_switch_3 = at_switch(x, y, second, R);
        lam = at_switch_3.lam;
        psi1 = at_switch_3.psi1;
        psi2 = at_switch_3.psi2;
    } else {
        const flow_4 = flow(0.0, side * R, third, -t3);
        x = flow_4[0];
        y = flow_4[1];
        const at_switch_5 = at_switch(x, y, third, R);
        lam = at_switch_5.lam;
        psi1 = at_switch_5.psi1;
        psi2 = at_switch_5.psi2;
        const turn_adjoint_6 = turn_adjoint(psi1, psi2, second, -t2);
        psi1 = turn_adjoint_6[0];
        psi2 = turn_adjoint_6[1];
    }
    const turn_adjoint_7 = turn_adjoint(psi1, psi2, first, -t1);
    psi1 = turn_adjoint_7[0];
    psi2 = turn_adjoint_7[1];
    return { lam, psi1, psi2 };
}

/**
 * Lambda and psi at the start of an extremal from (x, y) onto the circle; |psi| = 1.
 *
 * nan for the empty word, which has no controls. A word that is not an extremal also gets a psi, the one that its
 * last switch requires; it then violates one of (13)-(16).
 *
 * @type {(x: number, y: number, R: number, maneuver: Entry) => Adjoint}
 */
export function adjoint(x, y, R, maneuver) {
    const controls_1 = controls(maneuver.word);
    const first = controls_1[0], second = controls_1[1];
    if (first === ABSENT) {
        return { lam: NaN, psi1: NaN, psi2: NaN };
    }
    if (second === ABSENT) {
        return of_single_arc(x, y, R, maneuver);
    }
    if (first === 0) {
        return { lam: 1.0, psi1: 1.0, psi2: 0.0 };
    }
    if (second === 0) {
        const turn_adjoint_2 = turn_adjoint(1.0, 0.0, first, -maneuver.t1);
        const psi1 = turn_adjoint_2[0], psi2 = turn_adjoint_2[1];
        return { lam: 1.0, psi1, psi2 };
    }
    return of_arcs(R, maneuver);
}

/**
 * Phi = psi1 y - psi2 x, (15).
 *
 * @type {(x: number, y: number, psi1: number, psi2: number) => number}
 */
export function switching_function(x, y, psi1, psi2) {
    return psi1 * y - psi2 * x;
}

/**
 * The difference of squares x^2 + (y - R) (y + R + k), with nearly full relative accuracy even near zero.
 *
 * With k = 2 it is rp^2 - (R + 1)^2: the squared distance from (0, -1) less the squared radius of the last circle
 * of L. With k = -2 it is rm^2 - (R - 1)^2, the same for R about (0, 1). Near zero it is a small difference of
 * large numbers, and T varies with its square root: in plain doubles T would lose half of its digits there.
 *
 * @type {(x: number, y: number, R: number, k: number) => number}
 */
export function beyond(x, y, R, k) {
    const two_sum_1 = two_sum(y, -R);
    const s = two_sum_1[0], es = two_sum_1[1];
    const two_sum_2 = two_sum(y, R);
    let t = two_sum_2[0];
    const et = two_sum_2[1];
    const two_sum_3 = two_sum(t, k);
    t = two_sum_3[0];
    const ek = two_sum_3[1];
    const two_product_4 = two_product(s, t);
    const p = two_product_4[0], ep = two_product_4[1];
    const two_product_5 = two_product(x, x);
    const q = two_product_5[0], eq = two_product_5[1];
    const two_sum_6 = two_sum(q, p);
    const u = two_sum_6[0], eu = two_sum_6[1];
    return u + (eu + (ep + eq + s * (et + ek) + t * es));
}

/**
 * Positive outside the circle of the last L, radius R + 1 about (0, -1), negative inside.
 *
 * @type {(x: number, y: number, R: number) => number}
 */
export function beyond_last_circle(x, y, R) {
    return beyond(x, y, R, 2.0);
}

/**
 * Positive where a right turn from (x, y) meets the axis left of the last circle: (24) at R = 1; zero at (25).
 *
 * @type {(x: number, y: number, R: number) => number}
 */
export function beyond_first_circle(x, y, R) {
    return beyond_last_circle(x, -y, R);
}

/**
 * The x at ordinate y where an optimal left turn may switch to a right one on the way to (0, R); nan off the curve.
 *
 * Eliminating the second switch from a y^2 + 2 y = k, a yb^2 + 2 yb = K = R (R + 2), a (y + yb) = 2
 * (docs/theory.md, section 3) leaves a^2 y^2 - (6 y + K) a + 8 = 0 with x = y sqrt(a - 1). Its root is a = 8/(A +
 * B), A = 3 y + K/2, B^2 = y^2 + 3 K y + K^2/4, which keeps its digits near y = 0, where A - B loses them. At R =
 * 1, y >= 0 this is (22). The curve ends on x = 0 at y = 2 - R; for y < 0, x < 0 it belongs to the clockwise circle
 * alone.
 *
 * @type {(y: number, R: number) => number}
 */
export function switching_abscissa(y, R) {
    const K = R * (R + 2.0);
    const A = 3.0 * y + 0.5 * K, B2 = y * y + 3.0 * K * y + 0.25 * K * K;
    if (B2 < 0.0 || A + Math.sqrt(B2) <= 0.0) {
        return NaN;
    }
    const excess = 8.0 / (A + Math.sqrt(B2)) - 1.0;
    return excess >= 0.0 ? y * Math.sqrt(excess) : NaN;
}

/**
 * The word that wins at R = 1, *either*, y >= 0: the paper's section 6, corrected (evidence/docs/paper.md).
 *
 * The letters are those of the clockwise circle; for y < 0 take the mirror image. Pieces of zero length are left
 * out: the word is SL on the axis, L on the arc (27) and empty at the target.
 *
 * @type {(x: number, y: number) => number}
 */
export function region(x, y) {
    if (x === 0.0 && y === 1.0) {
        return Word.EMPTY;
    }
    if (beyond_first_circle(x, y, 1.0) > 0.0) {
        return y === 0.0 && x < 0.0 ? Word.SL : Word.RSL;
    }
    if (y < 1.0 && beyond_last_circle(x, y, 1.0) === 0.0 && x < 0.0) {
        return Word.L;
    }
    if (y < 1.0 && beyond_last_circle(x, y, 1.0) < 0.0 && x < switching_abscissa(y, 1.0)) {
        return Word.LRL;
    }
    return Word.RL;
}

/**
 * The x of the last arc (27) at R = 1, y >= 0: left half of the circle of radius 2 about (0, -1); nan above it.
 *
 * @type {(y: number) => number}
 */
export function last_arc_abscissa(y) {
    const square = (1.0 - y) * (3.0 + y);
    return square >= 0.0 ? -Math.sqrt(square) : NaN;
}

/**
 * The direction of the wind as a unit vector; (1, 0) in still air, and in a wind too light to have one.
 *
 * @type {(wx: number, wy: number) => [number, number]}
 */
export function downwind(wx, wy) {
    const wind = length(wx, wy);
    const chosen_1 = wind >= NEGLIGIBLE_WIND;
    return [chosen_1 ? wx / wind : 1.0, chosen_1 ? wy / wind : 0.0];
}

/**
 * The pose on the circle at a phase, (1) and (2): heading and wind add up to a velocity along the circle.
 *
 * @type {(phase: number, side: number, R: number, wx: number, wy: number) => [number, number, number, number, number]}
 */
export function hold_pose(phase, side, R, wx, wy) {
    const downwind_1 = downwind(wx, wy);
    const dx = downwind_1[0], dy = downwind_1[1];
    const a = -cos(phase), b = side * sin(phase);
    const tx = a * dx - b * dy, ty = a * dy + b * dx;
    const nx = (0 - side) * ty, ny = side * tx;
    const out = wx * nx + wy * ny;
    const crab = Math.sqrt((1.0 - out) * (1.0 + out));
    return [R * nx, R * ny, crab * tx - out * nx, crab * ty - out * ny, crab + wx * tx + wy * ty];
}

/**
 * The size of the rate of turn that holds the circle at a phase: g^2 / (R cos(crab)), (3).
 *
 * @type {(phase: number, side: number, R: number, wx: number, wy: number) => number}
 */
export function hold_rate(phase, side, R, wx, wy) {
    const hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const c = hold_pose_1[2], s = hold_pose_1[3], g = hold_pose_1[4];
    return g * g / (R * (g - (wx * (c + wx) + wy * (s + wy)) / g));
}

/**
 * The rotation of the arc of control u = +1 or -1 that takes the heading (ax, ay) to (bx, by).
 *
 * @type {(u: number, ax: number, ay: number, bx: number, by: number) => [number, number]}
 */
export function arc_rotation(u, ax, ay, bx, by) {
    const rotation_1 = rotation(ax, ay, bx, by);
    const cross = rotation_1[0], dot = rotation_1[1];
    return [u * cross, dot];
}

/**
 * The phase of the point of the circle that is nearest to (x, y).
 *
 * @type {(x: number, y: number, side: number, wx: number, wy: number) => number}
 */
export function phase_of(x, y, side, wx, wy) {
    const downwind_1 = downwind(wx, wy);
    const dx = downwind_1[0], dy = downwind_1[1];
    return angle(arc_rotation(0 - side, -dx, -dy, side * y, (0 - side) * x));
}

/**
 * The least R of a circle that can be held all round: the rate of turn is largest downwind, (1 + |w|)^2 / R.
 *
 * @type {(wx: number, wy: number) => number}
 */
export function tightest_radius(wx, wy) {
    const fastest = 1.0 + length(wx, wy);
    return fastest * fastest;
}

/**
 * `Status.OK`, or why there is nothing to solve.
 *
 * @type {(problem: WindProblem) => number}
 */
export function wind_search_status_of(problem) {
    const x = problem.x, y = problem.y, c = problem.c, s = problem.s, R = problem.R, wx = problem.wx, wy =
            problem.wy, tolerance = problem.tolerance;
    if (!(isfinite(x + y) && isfinite(c + s) && isfinite(R) && isfinite(wx + wy))) {
        return code(Status.NOT_FINITE);
    }
    if (length(wx, wy) >= 1.0) {
        return code(Status.WIND_TOO_STRONG);
    }
    if (tightest_radius(wx, wy) * (1.0 - ROUNDING) > R) {
        return code(R >= 1.0 ? Status.NOT_HELD : Status.RADIUS_TOO_SMALL);
    }
    if (Math.abs(x) > REACH || Math.abs(y) > REACH || R > REACH) {
        return code(Status.OUT_OF_RANGE);
    }
    return code(0.0 <= tolerance && tolerance <= REACH ? Status.OK : Status.BAD_TOLERANCE);
}

/**
 * The result where there is no maneuver.
 *
 * @type {(status: number) => WindEntry}
 */
export function no_entry(status) {
    return { status, side: 0, word: 0, t1: NaN, t2: NaN, t3: NaN, azimuth: NaN, miss: NaN };
}

/**
 * The scene of a problem, with the arc tolerance that rounding requires; negligible wind is treated as zero.
 *
 * @type {(problem: WindProblem) => WindScene}
 */
export function scene_of(problem) {
    const x = problem.x, y = problem.y, c = problem.c, s = problem.s, R = problem.R;
    let wx = problem.wx, wy = problem.wy;
    if (length(wx, wy) < NEGLIGIBLE_WIND) {
        wx = 0.0;
        wy = 0.0;
    }
    return { x, y, c, s, R, wx, wy, arc_tolerance: rounding(x, y, R) / 3.0 };
}

/**
 * The distance of the start from a point of joining, where an angle between the headings counts R times.
 *
 * @type {(phase: number, side: number, scene: WindScene) => number}
 */
export function hold_miss(phase, side, scene) {
    const hold_pose_1 = hold_pose(phase, side, scene.R, scene.wx, scene.wy);
    const px = hold_pose_1[0], py = hold_pose_1[1], ce = hold_pose_1[2], se = hold_pose_1[3];
    return length(length(px - scene.x, py - scene.y), scene.R * length(ce - scene.c, se - scene.s));
}

/**
 * The distance of the end of a maneuver, flown exactly, from a point of joining: position and heading together.
 *
 * @type {(entry: Entry, phase: number, scene: WindScene) => number}
 */
export function end_miss(entry, phase, scene) {
    let x = scene.x, y = scene.y, c = scene.c, s = scene.s;
    const R = scene.R, wx = scene.wx, wy = scene.wy;
    const side = entry.side, word = entry.word, t1 = entry.t1, t2 = entry.t2, t3 = entry.t3;
    const each_u_1 = controls(word), each_t_1 = [t1, t2, t3];
    for (let i_1 = 0; i_1 < each_u_1.length; i_1++) {
        const u = each_u_1[i_1], t = each_t_1[i_1];
        if (u !== ABSENT) {
            const fly_1 = fly(x, y, c, s, u, t);
            x = fly_1[0];
            y = fly_1[1];
            c = fly_1[2];
            s = fly_1[3];
            x = x + wx * t;
            y = y + wy * t;
        }
    }
    const hold_pose_2 = hold_pose(phase, side, R, wx, wy);
    const px = hold_pose_2[0], py = hold_pose_2[1], ce = hold_pose_2[2], se = hold_pose_2[3];
    return length(length(px - x, py - y), length(ce - c, se - s));
}

/**
 * One arc that ends on the circle, and its phase, from an approximation, by Newton's method.
 *
 * It can end on the circle and along it only where the start is on it by rounding. The end and the point of joining
 * move in the same direction, so the distance between them along it determines the duration of the arc less the
 * time s by which it joins later, and then the heading determines s.
 *
 * @type {(arc: Entry, phase: number, scene: WindScene) => [Entry, number]}
 */
export function fit_one_arc(arc, phase, scene) {
    const x = scene.x, y = scene.y, c = scene.c, s = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy,
            arc_tolerance = scene.arc_tolerance;
    const side = arc.side, word = arc.word;
    let t = arc.t1;
    const controls_1 = controls(word);
    const u = controls_1[0];
    for (let pass_1 = 0; pass_1 < ARC_STEPS; pass_1++) {
        const fly_2 = fly(x, y, c, s, u, t);
        const x1 = fly_2[0], y1 = fly_2[1], c1 = fly_2[2], s1 = fly_2[3];
        const hold_pose_3 = hold_pose(phase, side, R, wx, wy);
        const px = hold_pose_3[0], py = hold_pose_3[1], ce = hold_pose_3[2], se = hold_pose_3[3], g =
                hold_pose_3[4];
        const rx = px - x1 - wx * t, ry = py - y1 - wy * t, vx = ce + wx, vy = se + wy;
        const longer = (rx * vx + ry * vy) / (g * g), bend = u + side * hold_rate(phase, side, R, wx, wy);
        if (bend === 0.0) {
            break;
        }
        const later = (atan2(c1 * se - s1 * ce, c1 * ce + s1 * se) - u * longer) / bend;
        t = t + longer + later;
        phase = phase + later * g / R;
        if (Math.abs(longer) + Math.abs(later) <= arc_tolerance) {
            break;
        }
    }
    return [{ side, word, t1: t, t2: 0.0, t3: 0.0 }, phase];
}

/**
 * The arc of control u next to an approximation that ends abreast of the circle, with the heading of the hold.
 *
 * @type {(u: number, t: number, phase: number, side: number, scene: WindScene) => EntryBeside}
 */
export function arc_beside(u, t, phase, side, scene) {
    const fit_one_arc_1 = fit_one_arc({ side, word: encode(u, -2, -2), t1: t, t2: 0.0, t3: 0.0 }, phase, scene);
    const entry = fit_one_arc_1[0];
    phase = fit_one_arc_1[1];
    return { entry, phase, miss: end_miss(entry, phase, scene) };
}

/**
 * The maneuver that takes less time; a where b ends too far from the circle.
 *
 * @type {(a: EntryBeside, b: EntryBeside, tolerance: number) => EntryBeside}
 */
export function faster_beside(a, b, tolerance) {
    return b.miss <= tolerance && (0.0 <= b.entry.t1 && b.entry.t1 < min_real(a.entry.t1, TWO_PI)) ? b : a;
}

/**
 * The end of the arc of control u that ends with the heading of a point of joining.
 *
 * @type {(u: number, phase: number, side: number, scene: WindScene) => ArcEnd}
 */
export function arc_end(u, phase, side, scene) {
    const x = scene.x, y = scene.y, c = scene.c, s = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy;
    const hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const px = hold_pose_1[0], py = hold_pose_1[1], ce = hold_pose_1[2], se = hold_pose_1[3], g = hold_pose_1[4];
    const t = angle(arc_rotation(u, c, s, ce, se));
    const fly_2 = fly(x, y, c, s, u, t);
    const x1 = fly_2[0], y1 = fly_2[1];
    const rx = px - x1 - wx * t, ry = py - y1 - wy * t;
    return { t, short_: (rx * (ce + wx) + ry * (se + wy)) / g };
}

/**
 * The faster of `best` and the arcs of the control u between `ARC_SAMPLES` points of joining.
 *
 * @type {(best: EntryBeside, u: number, side: number, tolerance: number, scene: WindScene) => EntryBeside}
 */
export function fastest_arc_beside(best, u, side, tolerance, scene) {
    let before = arc_end(u, 0.0, side, scene);
    const last_1 = ARC_SAMPLES + 1;
    for (let i = 1; i < last_1; i++) {
        const phase = TWO_PI / ARC_SAMPLES * i;
        const after = arc_end(u, phase, side, scene);
        // Where the heading of the start lies between those of two points, one of the two arcs is almost a whole turn.
        if ((before.short_ <= 0.0 && 0.0 <= after.short_) && Math.abs(after.t - before.t) < 3.141592653589793) {
            best = faster_beside(best, arc_beside(u, after.t, phase, side, scene), tolerance);
        }
        before = after;
    }
    return best;
}

/**
 * The fastest maneuver of no piece or of one arc that ends within `tolerance` of the circle; T is inf for none.
 *
 * `sides` is a `words.Side`. An arc ends with the heading of its point of joining, so that its miss is the distance
 * from that point.
 *
 * @type {(sides: number, tolerance: number, scene: WindScene) => EntryBeside}
 */
export function entry_beside(sides, tolerance, scene) {
    let best = NO_ENTRY_BESIDE;
    for (const side of [1, -1]) {
        if (sides !== 0 - side) {
            const phase = phase_of(scene.x, scene.y, side, scene.wx, scene.wy);
            const nothing = { side, word: 0, t1: 0.0, t2: 0.0, t3: 0.0 };
            if (hold_miss(phase, side, scene) <= tolerance && best.entry.t1 > 0.0) {
                best = { entry: nothing, phase, miss: end_miss(nothing, phase, scene) };
            }
            for (const u of [1, -1]) {
                best = faster_beside(best, arc_beside(u, 0.0, phase, side, scene), tolerance);
                best = fastest_arc_beside(best, u, side, tolerance, scene);
            }
        }
    }
    return best;
}

/**
 * The result for a maneuver that joins at a phase.
 *
 * @type {(entry: Entry, phase: number, miss: number, scene: WindScene) => WindEntry}
 */
export function entry_at(entry, phase, miss, scene) {
    const hold_pose_1 = hold_pose(phase, entry.side, scene.R, scene.wx, scene.wy);
    const px = hold_pose_1[0], py = hold_pose_1[1];
    return { status: code(Status.OK), side: entry.side, word: entry.word, t1: entry.t1, t2: entry.t2, t3: entry.t3,
            azimuth: atan2(py, px), miss };
}

/**
 * The candidate without pieces, which joins at the point of the circle that is nearest to the start.
 *
 * @type {(side: number, scene: WindScene) => WindCandidate}
 */
export function start_on_circle(side, scene) {
    const phase = phase_of(scene.x, scene.y, side, scene.wx, scene.wy);
    return { phase, side, path: { time: 0.0, word: 0, t1: 0.0, t2: 0.0, t3: 0.0, lam: 1.0, p1: 1.0, p2: 0.0 } };
}

/**
 * Whether the start is on the circle and moves along it, up to rounding.
 *
 * @type {(side: number, scene: WindScene) => boolean}
 */
export function is_on_circle(side, scene) {
    const nothing = { side, word: 0, t1: 0.0, t2: 0.0, t3: 0.0 }, phase = start_on_circle(side, scene).phase;
    return end_miss(nothing, phase, scene) <= 3.0 * scene.arc_tolerance;
}

/**
 * The arc left of a word whose other pieces together last `SHORT` or less; the empty word where there is none.
 *
 * @type {(found: WindCandidate) => Entry}
 */
export function one_arc_entry(found) {
    const side = found.side, path = found.path;
    const controls_1 = controls(path.word);
    const first = controls_1[0], middle = controls_1[1], last = controls_1[2];
    if (first === last && path.t2 <= SHORT) {
        return { side, word: encode(first, -2, -2), t1: path.t1 + path.t3, t2: 0.0, t3: 0.0 };
    }
    if (middle !== 0 && path.t1 + path.t3 <= SHORT) {
        return { side, word: encode(middle, -2, -2), t1: path.t2, t2: 0.0, t3: 0.0 };
    }
    if (path.t2 + path.t3 <= SHORT) {
        return { side, word: encode(first, -2, -2), t1: path.t1, t2: 0.0, t3: 0.0 };
    }
    if (path.t1 + path.t2 <= SHORT) {
        return { side, word: encode(last, -2, -2), t1: path.t3, t2: 0.0, t3: 0.0 };
    }
    return { side, word: 0, t1: 0.0, t2: 0.0, t3: 0.0 };
}

/**
 * The two arcs left of a word whose third piece lasts `short` or less; the empty word where there are none.
 *
 * @type {(found: WindCandidate, short_: number) => Entry}
 */
export function two_arc_entry(found, short_) {
    const side = found.side, path = found.path;
    const controls_1 = controls(path.word);
    const first = controls_1[0], middle = controls_1[1], last = controls_1[2];
    if (middle === 0) {
        if (path.t2 <= short_ && first !== last) {
            return { side, word: encode(first, last, -2), t1: path.t1, t2: path.t3, t3: 0.0 };
        }
    } else if (path.t1 <= min_real(short_, path.t3)) {
        return { side, word: encode(middle, last, -2), t1: path.t2, t2: path.t3, t3: 0.0 };
    } else if (path.t3 <= short_) {
        return { side, word: encode(first, middle, -2), t1: path.t1, t2: path.t2, t3: 0.0 };
    }
    return { side, word: 0, t1: 0.0, t2: 0.0, t3: 0.0 };
}

/**
 * Whether one or two arcs end on the circle, and no later than `latest`, up to rounding.
 *
 * @type {(arcs: Entry, phase: number, latest: number, scene: WindScene) => boolean}
 */
export function is_close(arcs, phase, latest, scene) {
    /** @type {boolean} */ const both_flown = min_real(arcs.t1, arcs.t2) >= 0.0;
    const late = entry_duration(arcs) - latest;
    return both_flown && max_real(late, end_miss(arcs, phase, scene)) <= 3.0 * scene.arc_tolerance;
}

/**
 * Two arcs that end on the circle, and their phase, from an approximation, by Newton's method.
 *
 * Where the headings agree, joining later by s along the circle moves the point of joining just as flying the
 * second arc for s longer moves the end of the path. So the position determines t1 and t2 - s, and then the heading
 * determines s.
 *
 * @type {(arcs: Entry, phase: number, scene: WindScene) => [Entry, number]}
 */
export function fit_two_arcs(arcs, phase, scene) {
    const x = scene.x, y = scene.y, c = scene.c, s = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy,
            arc_tolerance = scene.arc_tolerance;
    const side = arcs.side, word = arcs.word;
    let t1 = arcs.t1, t2 = arcs.t2;
    const controls_1 = controls(word);
    const first = controls_1[0], second = controls_1[1];
    for (let pass_1 = 0; pass_1 < ARC_STEPS; pass_1++) {
        const fly_2 = fly(x, y, c, s, first, t1);
        const x1 = fly_2[0], y1 = fly_2[1], c1 = fly_2[2], s1 = fly_2[3];
        const fly_3 = fly(x1, y1, c1, s1, second, t2);
        const x2 = fly_3[0], y2 = fly_3[1], c2 = fly_3[2], s2 = fly_3[3];
        const hold_pose_4 = hold_pose(phase, side, R, wx, wy);
        const px = hold_pose_4[0], py = hold_pose_4[1], ce = hold_pose_4[2], se = hold_pose_4[3], g =
                hold_pose_4[4];
        const rx = px - x2 - wx * (t1 + t2), ry = py - y2 - wy * (t1 + t2);
        // How the end moves with t1, which turns the second arc about its start, and with t2.
        const ax = c1 + wx - first * (y2 - y1), ay = s1 + wy + first * (x2 - x1);
        const bx = c2 + wx, by = s2 + wy;
        const across = ax * by - ay * bx, bend = second + side * hold_rate(phase, side, R, wx, wy);
        if (across === 0.0 || bend === 0.0) {
            break;
        }
        const d1 = (rx * by - ry * bx) / across, d2 = (ax * ry - ay * rx) / across;
        const later = (atan2(c2 * se - s2 * ce, c2 * ce + s2 * se) - first * d1 - second * d2) / bend;
        t1 = t1 + d1;
        t2 = t2 + d2 + later;
        phase = phase + later * g / R;
        if (Math.abs(d1) + Math.abs(d2) + Math.abs(later) <= arc_tolerance) {
            break;
        }
    }
    return [{ side, word, t1, t2, t3: 0.0 }, phase];
}

/**
 * The maneuver and phase of a candidate, or those of one or two of its arcs alone if close and no slower.
 *
 * @type {(found: WindCandidate, scene: WindScene) => [Entry, number]}
 */
export function polish(found, scene) {
    const phase = found.phase, side = found.side, path = found.path;
    const entry = { side, word: path.word, t1: path.t1, t2: path.t2, t3: path.t3 };
    const latest = path.time + TOO_EARLY * end_miss(entry, phase, scene);
    let arc = one_arc_entry(found), arcs = two_arc_entry(found, SHORT);
    if (arc.word !== 0) {
        const fit_one_arc_1 = fit_one_arc(arc, phase, scene);
        arc = fit_one_arc_1[0];
        const arc_phase = fit_one_arc_1[1];
        if (is_close(arc, arc_phase, latest, scene)) {
            return [arc, arc_phase];
        }
    }
    if (arcs.word !== 0) {
        const fit_two_arcs_2 = fit_two_arcs(arcs, phase, scene);
        arcs = fit_two_arcs_2[0];
        const arcs_phase = fit_two_arcs_2[1];
        if (is_close(arcs, arcs_phase, latest, scene)) {
            return [arcs, arcs_phase];
        }
    }
    return [entry, phase];
}

/**
 * A candidate as the maneuver flown; `Status.NOT_CONVERGED` where it does not end on the circle.
 *
 * @type {(found: WindCandidate, scene: WindScene) => WindEntry}
 */
export function wind_entry(found, scene) {
    const length_tolerance = rounding(scene.x, scene.y, scene.R);
    const polish_1 = polish(found, scene);
    const side = polish_1[0].side;
    let word = polish_1[0].word, t1 = polish_1[0].t1, t2 = polish_1[0].t2, t3 = polish_1[0].t3;
    const phase = polish_1[1];
    const drop_short_pieces_2 = drop_short_pieces(word, t1, t2, t3, length_tolerance, ROUNDING);
    word = drop_short_pieces_2[0];
    t1 = drop_short_pieces_2[1];
    t2 = drop_short_pieces_2[2];
    t3 = drop_short_pieces_2[3];
    const miss = end_miss({ side, word, t1, t2, t3 }, phase, scene);
    // Each piece has its arc tolerance, which the wind may double, and the rounding of its duration. The negated
    // comparison also rejects a miss that is nan.
    if (!(miss <= 2.0 * length_tolerance + ROUNDING * (t1 + t2 + t3))) {
        return no_entry(code(Status.NOT_CONVERGED));
    }
    return entry_at({ side, word, t1, t2, t3 }, phase, miss, scene);
}

/**
 * The side, word and durations of a maneuver, as for still air.
 *
 * @type {(maneuver: WindEntry) => Entry}
 */
export function entry_of(maneuver) {
    return { side: maneuver.side, word: maneuver.word, t1: maneuver.t1, t2: maneuver.t2, t3: maneuver.t3 };
}

/**
 * T, the whole time of a maneuver.
 *
 * @type {(maneuver: WindEntry) => number}
 */
export function time_of(maneuver) {
    return entry_duration(entry_of(maneuver));
}

/**
 * The search with its result: the maneuver onto the circle, or that beside it if it is faster.
 *
 * @type {(search: WindSearch) => WindSearch}
 */
export function end_search(search) {
    const scene = search.scene, beside = search.beside;
    let entry = wind_entry(search.best, scene);
    // The negated comparison is also true where there is no maneuver onto the circle: its times are nan.
    if (beside.entry.t1 < Infinity && !(time_of(entry) <= beside.entry.t1)) {
        entry = entry_at(beside.entry, beside.phase, beside.miss, scene);
    }
    return { ...search, stage: ENDED, entry: entry };
}

/**
 * The search for the fastest maneuver, before its first step; it has ended where the answer is known at once.
 *
 * @type {(problem: WindProblem) => WindSearch}
 */
export function begin_search(problem) {
    let search = NO_SEARCH;
    const status = wind_search_status_of(problem);
    if (status !== 0) {
        return { ...search, stage: ENDED, entry: no_entry(status) };
    }
    const scene = scene_of(problem);
    search = { ...search, sides: problem.side, scene: scene };
    if (problem.tolerance > 0.0) {
        search = { ...search, beside: entry_beside(problem.side, problem.tolerance, scene) };
        const entry = search.beside.entry, phase = search.beside.phase, miss = search.beside.miss;
        if (entry.t1 === 0.0) {
            return { ...search, stage: ENDED, entry: entry_at(entry, phase, miss, scene) };
        }
    }
    for (const side of [1, -1]) {
        if (problem.side !== 0 - side && is_on_circle(side, scene)) {
            search = { ...search, best: start_on_circle(side, scene) };
        }
    }
    if (search.best.side !== 0) {
        return end_search(search);
    }
    return search;
}

/**
 * The time at which a straight flight at speed 1 meets a point that starts at d and moves with -w: t = |d - w t|.
 *
 * The positive root of (1 - w^2) t^2 + 2 (w . d) t = d^2, in the form without cancellation.
 *
 * @type {(dx: number, dy: number, wx: number, wy: number) => number}
 */
export function interception(dx, dy, wx, wy) {
    const along = wx * dx + wy * dy, spare = 1.0 - wx * wx - wy * wy, square = dx * dx + dy * dy;
    const root = Math.sqrt(along * along + spare * square);
    if (along < 0.0) {
        return (root - along) / spare;
    }
    return square > 0.0 ? square / (root + along) : 0.0;
}

/**
 * The set that contains only a word of three pieces: LSL, RSR, LSR, RSL, LRL and RLR are its bits, lowest first.
 *
 * @type {(word: number) => number}
 */
export function set_of(word) {
    const controls_1 = controls(word);
    const first = controls_1[0], middle = controls_1[1], last = controls_1[2];
    const lowest = middle !== 0 ? 16 : first === last ? 1 : 4;
    return first > 0 ? lowest : 2 * lowest;
}

/**
 * The duration of an arc; zero where it is less than a full turn by at most `arc_tolerance` at the given radius.
 *
 * @type {(rotation: [number, number], radius: number, arc_tolerance: number) => number}
 */
export function arc_time(rotation, radius, arc_tolerance) {
    return angle(snap_full_turn(rotation, radius * radius, arc_tolerance));
}

/**
 * The first arc of LSL or RSR, whose arcs add up to `arcs`; one of them is zero where it falls short by rounding.
 *
 * The straight piece moves by its own length alone as it turns: the shorter it is, the less is known of its
 * direction.
 *
 * @type {(first: number, arcs: number, straight: number, arc_tolerance: number) => number}
 */
export function first_of_same_turns(first, arcs, straight, arc_tolerance) {
    const beyond = first - arcs, short_ = TWO_PI - first;
    if (beyond > arc_tolerance && straight * min_real(beyond, short_) <= 3.0 * arc_tolerance) {
        return beyond < short_ ? arcs : 0.0;
    }
    return first;
}

/**
 * The first LSL (u = +1) or RSR whose time is at most `until`.
 *
 * t1 + t3 is the rotation from start to pose, or a turn more, and t2 an interception.
 *
 * @type {(u: number, dx: number, dy: number, ends: Ends, until_: number) => Path}
 */
export function lsl_rsr(u, dx, dy, ends, until_) {
    const c0 = ends.c0, s0 = ends.s0, c = ends.c, s = ends.s, wx = ends.wx, wy = ends.wy, arc_tolerance =
            ends.arc_tolerance;
    const rotation = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, arc_tolerance);
    for (const arcs of [rotation, rotation + TWO_PI]) {
        const ax = dx - wx * arcs, ay = dy - wy * arcs;
        const straight = interception(ax, ay, wx, wy);
        if (arcs + straight > until_ + ALMOST) {
            break;
        }
        const ex = ax - wx * straight, ey = ay - wy * straight;
        let first = arc_time(arc_rotation(u, c0, s0, ex, ey), 1.0 + straight, arc_tolerance);
        first = first_of_same_turns(first, arcs, straight, arc_tolerance);
        const last = max_real(arcs - first, 0.0);
        if (first <= arcs + arc_tolerance && straight * (last - TWO_PI) <= 3.0 * arc_tolerance) {
            const distance = length(ex, ey);
            // Where the two circles coincide, any direction of p is possible.
            const chosen_1 = distance > 0.0;
            const p1 = chosen_1 ? ex / distance : 1.0, p2 = chosen_1 ? ey / distance : 0.0;
            return { time: first + straight + last, word: encode(u, 0, u), t1: first, t2: straight, t3: last, lam:
                    1.0, p1, p2 };
        }
    }
    return NO_PATH;
}

/**
 * The path that takes less time: a where they tie, or where b takes longer than `until`.
 *
 * @type {(a: Path, b: Path, until_: number) => Path}
 */
export function faster_path(a, b, until_) {
    return b.time < a.time && b.time <= until_ ? b : a;
}

/**
 * The interval of times t >= 0 in which |d - w t| < limit; both ends are `inf` where there is none.
 *
 * @type {(dx: number, dy: number, wx: number, wy: number, limit: number) => [number, number]}
 */
export function time_within(dx, dy, wx, wy, limit) {
    const along = wx * dx + wy * dy, square = wx * wx + wy * wy, gap = dx * dx + dy * dy - limit * limit;
    const discriminant = along * along - square * gap;
    if (gap >= 0.0 && (along <= 0.0 || discriminant <= 0.0)) {
        return [Infinity, Infinity];
    }
    const root = Math.sqrt(discriminant);
    if (gap >= 0.0) {
        return [gap / (along + root), (along + root) / square];
    }
    if (along > 0.0) {
        return [0.0, (along + root) / square];
    }
    return [0.0, root > along ? -gap / (root - along) : Infinity];
}

/**
 * The straight piece of LSR (u = +1) or RSL between circles whose centres are d apart: length and direction.
 *
 * @type {(u: number, dx: number, dy: number) => [number, number, number]}
 */
export function tangent(u, dx, dy) {
    const square = dx * dx + dy * dy;
    const straight = Math.sqrt(max_real(square - 4.0, 0.0));
    return [straight, (straight * dx - 2.0 * u * dy) / square, (straight * dy + 2.0 * u * dx) / square];
}

/**
 * By how much each arc of LSR (u = +1) or RSL grows in an interval, continued beyond whole turns.
 *
 * @type {(u: number, dx: number, dy: number, ends: Ends, interval: [number, number]) => number}
 */
export function arc_growth(u, dx, dy, ends, interval) {
    const begin = interval[0], end_ = interval[1];
    const tangent_1 = tangent(u, dx - ends.wx * begin, dy - ends.wy * begin);
    const e1 = tangent_1[1], e2 = tangent_1[2];
    // In the end the straight piece points against the wind.
    let p1 = -ends.wx, p2 = -ends.wy;
    if (end_ < Infinity) {
        const tangent_2 = tangent(u, dx - ends.wx * end_, dy - ends.wy * end_);
        p1 = tangent_2[1];
        p2 = tangent_2[2];
    }
    const turned = Math.abs(atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2));
    return u * (ends.wx * e2 - ends.wy * e1) >= 0.0 ? turned : -turned;
}

/**
 * 1 where an arc exceeds a limit, or almost: the ends of arcs are known up to rounding only; otherwise 0.
 *
 * @type {(arc: number, limit: number) => number}
 */
export function passes(arc, limit) {
    return arc > limit - ALMOST ? 1 : 0;
}

/**
 * The time in an interval at which the length of LSR or RSL equals T; any later time where there is none.
 *
 * `arcs` is the sum of the durations of its two arcs at the beginning of the interval.
 *
 * @type {(u: number, dx: number, dy: number, ends: Ends, arcs: number, interval: [number, number]) => number}
 */
export function lsr_rsl_root(u, dx, dy, ends, arcs, interval) {
    const wx = ends.wx, wy = ends.wy;
    const begin = interval[0], end_ = interval[1];
    const tangent_1 = tangent(u, dx - wx * begin, dy - wy * begin);
    let straight = tangent_1[0];
    const e1 = tangent_1[1], e2 = tangent_1[2];
    let time = begin, p1 = e1, p2 = e2, turned = 0.0;
    for (let pass_1 = 0; pass_1 < NEWTON_STEPS; pass_1++) {
        const step = (arcs + turned + straight - time) / (1.0 + wx * p1 + wy * p2);
        const before = time;
        time = time + step;
        const across = (wx * p2 - wy * p1) * step;
        // The next step would be `across`^2 / (2 straight (1 + w . p)).
        if (time <= before || time > end_ || across * across <= NO_STEP * straight * time) {
            break;
        }
        const tangent_2 = tangent(u, dx - wx * time, dy - wy * time);
        straight = tangent_2[0];
        p1 = tangent_2[1];
        p2 = tangent_2[2];
        // The direction turns one way only, by no more than pi in all.
        turned = 2.0 * u * atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2);
    }
    return time;
}

/**
 * The LSR or RSL at the first root in an interval throughout which the centres are at least two radii apart.
 *
 * With its arcs continued beyond whole turns, length - T is convex and falls with the slope -(1 + w . p). So for
 * each number of turns it has at most one root, and Newton's method converges to it from the beginning of the
 * interval.
 *
 * @type {(u: number, dx: number, dy: number, ends: Ends, interval: [number, number]) => Path}
 */
export function first_lsr_rsl(u, dx, dy, ends, interval) {
    const c0 = ends.c0, s0 = ends.s0, c = ends.c, s = ends.s, wx = ends.wx, wy = ends.wy, arc_tolerance =
            ends.arc_tolerance;
    const begin = interval[0], end_ = interval[1];
    const tangent_1 = tangent(u, dx - wx * begin, dy - wy * begin);
    let straight = tangent_1[0];
    const e1 = tangent_1[1], e2 = tangent_1[2];
    let first = angle(arc_rotation(u, c0, s0, e1, e2)), last = angle(arc_rotation(u, c, s, e1, e2));
    const arcs = first + last, growth = arc_growth(u, dx, dy, ends, interval);
    // An arc that grows beyond a whole turn loses it, one that shrinks below zero gains one.
    const least = min_real(first, last) + growth, most = max_real(first, last) + growth;
    const fewest = max_integer(0 - passes(least, TWO_PI) - passes(most, TWO_PI), integer_of(Math.ceil((begin - arcs
            - straight) / TWO_PI)));
    const gained = passes(-least, 0.0) + passes(-most, 0.0);
    const last_1 = gained + 1;
    for (let turns = fewest; turns < last_1; turns++) {
        const time = lsr_rsl_root(u, dx, dy, ends, arcs + TWO_PI * turns, interval);
        if (time > end_) {
            break;
        }
        const tangent_2 = tangent(u, dx - wx * time, dy - wy * time);
        straight = tangent_2[0];
        const p1 = tangent_2[1], p2 = tangent_2[2];
        first = arc_time(arc_rotation(u, c0, s0, p1, p2), 1.0 + straight, arc_tolerance);
        last = arc_time(arc_rotation(u, c, s, p1, p2), 1.0, arc_tolerance);
        if (Math.abs(first + straight + last - time) < 3.141592653589793) {
            return { time: first + straight + last, word: encode(u, 0, 0 - u), t1: first, t2: straight, t3: last,
                    lam: 1.0, p1, p2 };
        }
    }
    return NO_PATH;
}

/**
 * The first LSR (u = +1) or RSL whose time is at most `until`; the centres must be at least two radii apart.
 *
 * @type {(u: number, dx: number, dy: number, ends: Ends, until_: number) => Path}
 */
export function lsr_rsl(u, dx, dy, ends, until_) {
    // Circles that overlap by rounding count as touching: two arcs without a straight piece.
    const time_within_1 = time_within(dx, dy, ends.wx, ends.wy, 2.0 - ends.arc_tolerance);
    const enter = time_within_1[0], leave = time_within_1[1];
    let path = NO_PATH;
    if (enter > 0.0) {
        path = first_lsr_rsl(u, dx, dy, ends, [0.0, min_real(enter, until_)]);
    }
    if (path.time === Infinity && leave < until_) {
        path = first_lsr_rsl(u, dx, dy, ends, [leave, until_]);
    }
    return path;
}

/**
 * The angle in [0, pi] whose cosine is x.
 *
 * @type {(x: number) => number}
 */
export function acos(x) {
    return atan2(Math.sqrt((1.0 - x) * (1.0 + x)), x);
}

/**
 * The m in (0, 2 pi) at which h(m) = |d - 2 w m|^2 - 8 (1 - cos m) rises through zero.
 *
 * `inf` where it does not, or not within an interval. h'' = 8 (w^2 - cos m), and h >= 0 at 0 and 2 pi. With i =
 * acos(w^2), h is concave up to i and has no such root there. It is convex up to 2 pi - i and may have one there;
 * if it is negative at 2 pi - i, it has one beyond, where it is concave.
 *
 * @type {(dx: number, dy: number, wx: number, wy: number, within: [number, number]) => number}
 */
export function middle_arc(dx, dy, wx, wy, within) {
    const inflection = acos(wx * wx + wy * wy);
    let least = within[0];
    const most = within[1];
    least = max_real(least, inflection);
    const outer = TWO_PI - inflection;
    let m = min_real(outer, most);
    /** @type {boolean} */ let concave = false;
    for (let step = 0; step < NEWTON_STEPS; step++) {
        if (m < least && !concave) {
            return Infinity;
        }
        const x = dx - 2.0 * m * wx, y = dy - 2.0 * m * wy;
        const across = sin(0.5 * m), along = cos(0.5 * m);
        const h = x * x + y * y - 16.0 * across * across;
        const slope = -4.0 * (wx * x + wy * y) - 16.0 * across * along;
        if (step === 0) {
            concave = h < 0.0;
        }
        // The root lies beyond `most` where h is still negative there.
        if (slope <= 0.0 || (concave && m >= most)) {
            return Infinity;
        }
        const before = m;
        m = m - h / slope;
        if (concave ? m <= before : m >= before) {
            break;
        }
    }
    return m;
}

/**
 * LRL or RLR with a given middle arc between circles whose centres are d = -4 sin(m/2) p apart.
 *
 * @type {(u: number, middle: number, dx: number, dy: number, ends: Ends) => Path}
 */
export function three_arcs(u, middle, dx, dy, ends) {
    const c0 = ends.c0, s0 = ends.s0, c = ends.c, s = ends.s, arc_tolerance = ends.arc_tolerance;
    const distance = length(dx, dy);
    const chosen_1 = distance > 0.0;
    const p1 = chosen_1 ? -dx / distance : 1.0, p2 = chosen_1 ? -dy / distance : 0.0;
    const lam = -cos(0.5 * middle), across = sin(0.5 * middle);
    // The headings at the two switches: p turned by the angle whose cosine is lambda, against the sense of the outer
    // arcs at the first switch and in their sense at the second.
    const ax = lam * p1 + u * across * p2, ay = lam * p2 - u * across * p1;
    const bx = lam * p1 - u * across * p2, by = lam * p2 + u * across * p1;
    const first = arc_time(arc_rotation(u, c0, s0, ax, ay), 4.0, arc_tolerance);
    const last = arc_time(arc_rotation(u, bx, by, c, s), 1.0, arc_tolerance);
    return { time: first + middle + last, word: encode(u, 0 - u, u), t1: first, t2: middle, t3: last, lam, p1, p2 };
}

/**
 * The first LRL (u = +1) or RLR whose time T is at most `until`: T = 2 t2 + rotation from start to pose + turns.
 *
 * Only a path with p . w + lambda >= 0 can be the first; for each number of whole turns there is at most one such
 * path.
 *
 * @type {(u: number, dx: number, dy: number, ends: Ends, until_: number) => Path}
 */
export function lrl_rlr(u, dx, dy, ends, until_) {
    const c0 = ends.c0, s0 = ends.s0, c = ends.c, s = ends.s, wx = ends.wx, wy = ends.wy, arc_tolerance =
            ends.arc_tolerance;
    const time_within_1 = time_within(dx, dy, wx, wy, 4.0);
    const enter = time_within_1[0], leave = time_within_1[1];
    let best = NO_PATH;
    if (enter <= until_) {
        const rotation = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, arc_tolerance);
        for (const turns of [-1.0, 0.0, 1.0]) {
            const outside = rotation + TWO_PI * turns;
            const limit = min_real(min_real(leave + arc_tolerance, until_), best.time);
            /** @type {[number, number]} */ const within = [0.5 * (enter - outside) - ALMOST, 0.5 * (limit -
                    outside) + ALMOST];
            const middle = middle_arc(dx - wx * outside, dy - wy * outside, wx, wy, within);
            const time = outside + 2.0 * middle;
            if (Infinity > time && (enter - arc_tolerance <= time && time <= limit)) {
                const path = three_arcs(u, middle, dx - wx * time, dy - wy * time, ends);
                if (Math.abs(path.time - time) < 3.141592653589793) {
                    best = path;
                }
            }
        }
    }
    return best;
}

/**
 * The first path to a point of joining of a set of words; `NO_PATH` where it takes longer than `until`.
 *
 * @type {(words: number, phase: number, side: number, scene: WindScene, until_: number) => Path}
 */
export function first_path_of(words, phase, side, scene, until_) {
    const x = scene.x, y = scene.y, c0 = scene.c, s0 = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy,
            arc_tolerance = scene.arc_tolerance;
    const hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const px = hold_pose_1[0], py = hold_pose_1[1], c = hold_pose_1[2], s = hold_pose_1[3];
    const dx = px - x, dy = py - y;
    let best = NO_PATH;
    if (interception(dx, dy, wx, wy) <= until_ + arc_tolerance) {
        const ends = { c0, s0, c, s, wx, wy, arc_tolerance };
        // The vectors are those from the centre of the first arc to that of the last. The words that take least to find
        // are tried first.
        let path;
        for (const u of [1, -1]) {
            if ((words & set_of(encode(u, 0, u))) !== 0) {
                path = lsl_rsr(u, dx - u * (s - s0), dy + u * (c - c0), ends, min_real(until_, best.time));
                best = faster_path(best, path, until_);
            }
        }
        for (const u of [1, -1]) {
            if ((words & set_of(encode(u, 0, 0 - u))) !== 0) {
                path = lsr_rsl(u, dx + u * (s + s0), dy - u * (c + c0), ends, min_real(until_, best.time));
                best = faster_path(best, path, until_);
            }
        }
        for (const u of [1, -1]) {
            if ((words & set_of(encode(u, 0 - u, u))) !== 0) {
                path = lrl_rlr(u, dx - u * (s - s0), dy + u * (c - c0), ends, min_real(until_, best.time));
                best = faster_path(best, path, until_);
            }
        }
    }
    return best;
}

/**
 * The derivative of the time of the path with respect to the point of joining, in units of hold time, (6).
 *
 * It is zero where the adjoint is transversal to the circle, and it never exceeds 1.
 *
 * @type {(path: Path, phase: number, side: number, scene: WindScene) => number}
 */
export function join_slope(path, phase, side, scene) {
    const hold_pose_1 = hold_pose(phase, side, scene.R, scene.wx, scene.wy);
    const c = hold_pose_1[2], s = hold_pose_1[3];
    const along = path.p1 * c + path.p2 * s, drift = path.p1 * scene.wx + path.p2 * scene.wy;
    const controls_2 = controls(path.word);
    const last = controls_2[2];
    const rate = (side * last + 0) * hold_rate(phase, side, scene.R, scene.wx, scene.wy);
    return (along + drift - rate * (path.lam - along)) / (path.lam + drift);
}

/**
 * The point of joining at a phase, for a set of words.
 *
 * @type {(words: number, phase: number, side: number, scene: WindScene) => JoinPoint}
 */
export function join_point(words, phase, side, scene) {
    const path = first_path_of(words, phase, side, scene, Infinity);
    return { phase, path, slope: join_slope(path, phase, side, scene) };
}

/**
 * The refinement after a step towards where the time falls, twice as long as the last one.
 *
 * @type {(refinement: Refinement, scene: WindScene) => Refinement}
 */
export function bracket(refinement, scene) {
    let here = refinement.here;
    const steps = refinement.steps;
    const step = refinement.width * shift_left(1, steps);
    let other = join_point(ALL_WORDS, here.phase + (here.slope < 0.0 ? step : -step), refinement.side, scene);
    /** @type {boolean} */ let is_enclosed = other.path.time > here.path.time;
    if (!is_enclosed) {
        const new_here = other;
        const new_other = here;
        here = new_here;
        other = new_other;
        is_enclosed = here.slope * other.slope <= 0.0;
    }
    if (!is_enclosed && steps + 1 < BRACKETING_STEPS) {
        return { ...refinement, here: here, steps: steps + 1 };
    }
    const words = (set_of(here.path.word) | set_of(other.path.word));
    return { ...refinement, stage: ENCLOSING, here: here, other: other, last: other, words: words, bisect: false,
            steps: 0 };
}

/**
 * Whether two paths are of different words, or an arc has lost or gained a whole turn between them.
 *
 * @type {(a: Path, b: Path) => boolean}
 */
export function has_changed(a, b) {
    return a.word !== b.word || max_real(Math.abs(a.t1 - b.t1), Math.abs(a.t3 - b.t3)) > 3.141592653589793;
}

/**
 * Where the slope is zero by the secant through two points; `inf` where there is none.
 *
 * Nor is there one through points on either side of a corner at which the slope does not change its sign.
 *
 * @type {(a: JoinPoint, b: JoinPoint) => number}
 */
export function secant_phase(a, b) {
    if (a.slope === b.slope || (a.slope * b.slope > 0.0 && has_changed(a.path, b.path))) {
        return Infinity;
    }
    return a.phase + (b.phase - a.phase) * (a.slope / (a.slope - b.slope));
}

/**
 * Whether the time at a phase, where the slope should be zero, is lower by no more than rounding.
 *
 * @type {(here: JoinPoint, there: number, scene: WindScene) => boolean}
 */
export function is_worthless(here, there, scene) {
    const slowest = 1.0 - length(scene.wx, scene.wy);
    return Math.abs(there - here.phase) * Math.abs(here.slope) * scene.R * WORTH <= here.path.time * slowest;
}

/**
 * Whether a phase lies between those of two points.
 *
 * @type {(phase: number, a: JoinPoint, b: JoinPoint) => boolean}
 */
export function is_between(phase, a, b) {
    return min_real(a.phase, b.phase) < phase && phase < max_real(a.phase, b.phase);
}

/**
 * The phase between two points of different words where the path consists of two arcs; `inf` if none is found.
 *
 * @type {(here: JoinPoint, other: JoinPoint, side: number, scene: WindScene) => number}
 */
export function corner_phase(here, other, side, scene) {
    if (here.path.word !== other.path.word) {
        for (const point of [here, other]) {
            let arcs = two_arc_entry({ phase: point.phase, side, path: point.path }, Infinity);
            if (arcs.word !== 0) {
                const fit_two_arcs_1 = fit_two_arcs(arcs, point.phase, scene);
                arcs = fit_two_arcs_1[0];
                const phase = fit_two_arcs_1[1];
                /** @type {boolean} */ const fits = min_real(arcs.t1, arcs.t2) >= 0.0 && end_miss(arcs, phase,
                        scene) <= 3.0 * scene.arc_tolerance;
                if (fits && is_between(phase, here, other)) {
                    return phase;
                }
            }
        }
    }
    return Infinity;
}

/**
 * A point just before or after a corner from where the time falls further; its path is `NO_PATH` for none.
 *
 * @type {(corner: JoinPoint, side: number, scene: WindScene) => JoinPoint}
 */
export function falling_beside(corner, side, scene) {
    const latest = corner.path.time + scene.arc_tolerance;
    for (const shift of [-AT_CORNER, AT_CORNER]) {
        const beside = join_point(ALL_WORDS, corner.phase + shift, side, scene);
        if (beside.path.time <= latest && beside.slope * shift < 0.0) {
            return beside;
        }
    }
    return { phase: corner.phase, path: NO_PATH, slope: 0.0 };
}

/**
 * The refinement after another point between those that enclose the minimum.
 *
 * @type {(refinement: Refinement, scene: WindScene) => Refinement}
 */
export function enclose(refinement, scene) {
    const side = refinement.side;
    let here = refinement.here, other = refinement.other, last = refinement.last, words = refinement.words;
    /** @type {boolean} */ let bisect = refinement.bisect;
    const steps = refinement.steps;
    const secant = secant_phase(here, last);
    // Across a corner the secant does not show how far the minimum is.
    if (is_worthless(here, has_changed(here.path, last.path) ? other.phase : secant, scene)) {
        return { ...refinement, stage: COMPARING };
    }
    const corner = integer_modulo(steps, 4) === 1 ? corner_phase(here, other, side, scene) : Infinity;
    let there = is_between(corner, here, other) ? corner : 0.5 * (here.phase + other.phase);
    /** @type {boolean} */ const use_secant = there !== corner && !bisect && is_between(secant, here, other);
    if (use_secant) {
        there = secant;
    }
    if (there === here.phase || there === other.phase) {
        return { ...refinement, stage: COMPARING };
    }
    const flattest = min_real(Math.abs(here.slope), Math.abs(last.slope));
    last = join_point(words, there, side, scene);
    if (last.path.time > here.path.time && has_changed(here.path, last.path)) {
        last = join_point(ALL_WORDS, there, side, scene);
        words |= set_of(last.path.word);
    }
    // A secant that helps little is followed by a bisection.
    bisect = use_secant && Math.abs(last.slope) > 0.5 * flattest;
    if (last.path.time > here.path.time + scene.arc_tolerance) {
        other = last;
    } else if (there === corner) {
        const beside = falling_beside(last, side, scene);
        if (beside.path.time === Infinity) {
            return { ...refinement, stage: COMPARING, here: last };
        }
        other = is_between(beside.phase, last, other) ? other : here;
        here = beside;
    } else {
        if (here.slope * last.slope < 0.0) {
            other = here;
        }
        const new_here = last;
        const new_last = here;
        here = new_here;
        last = new_last;
    }
    const stage = steps + 1 < REFINING_STEPS ? ENCLOSING : COMPARING;
    return { ...refinement, stage: stage, here: here, other: other, last: last, words: words, bisect: bisect, steps:
            steps + 1 };
}

/**
 * The local minimum at which a refinement has ended.
 *
 * @type {(refinement: Refinement) => WindCandidate}
 */
export function minimum_of(refinement) {
    return { phase: refinement.here.phase, side: refinement.side, path: refinement.here.path };
}

/**
 * The first path to a point of joining, the best of the six words; `NO_PATH` where it takes longer than `until`.
 *
 * @type {(phase: number, side: number, scene: WindScene, until_: number) => Path}
 */
export function first_path(phase, side, scene, until_) {
    return first_path_of(ALL_WORDS, phase, side, scene, until_);
}

/**
 * A faster path, of any word, to the point of a candidate or a little before or after it; otherwise `NO_PATH`.
 *
 * @type {(found: WindCandidate, scene: WindScene) => WindCandidate}
 */
export function faster_nearby(found, scene) {
    const until_ = found.path.time - scene.arc_tolerance;
    const beside = BESIDE * min_real(found.path.time, 1.0);
    for (const shift of [0.0, -beside, beside]) {
        const path = first_path(found.phase + shift, found.side, scene, until_);
        if (path.time < Infinity) {
            return { phase: found.phase + shift, side: found.side, path };
        }
    }
    return { phase: found.phase, side: found.side, path: NO_PATH };
}

/**
 * The refinement that begins at a point; its first step is as wide as `width`, radians.
 *
 * @type {(start: JoinPoint, side: number, width: number) => Refinement}
 */
export function refinement_from(start, side, width) {
    return { ...NO_REFINEMENT, stage: BRACKETING, side: side, width: width, here: start };
}

/**
 * The refinement of a candidate.
 *
 * @type {(found: WindCandidate, width: number, scene: WindScene) => Refinement}
 */
export function begin_refinement(found, width, scene) {
    const slope = join_slope(found.path, found.phase, found.side, scene);
    return refinement_from({ phase: found.phase, path: found.path, slope }, found.side, width);
}

/**
 * The refinement of a faster path, of any word, to its minimum or to a point beside it, if there is one.
 *
 * @type {(refinement: Refinement, scene: WindScene) => Refinement}
 */
export function compare_nearby(refinement, scene) {
    const faster = faster_nearby(minimum_of(refinement), scene);
    if (faster.path.time === Infinity) {
        return { ...refinement, stage: REFINED };
    }
    const again = begin_refinement(faster, refinement.width, scene), enclosures = refinement.enclosures + 1;
    return { ...again, stage: enclosures < REFINEMENTS ? BRACKETING : REFINED, enclosures: enclosures };
}

/**
 * The refinement after another step, which tries a point, or a few; it has not ended yet.
 *
 * @type {(refinement: Refinement, scene: WindScene) => Refinement}
 */
export function refine(refinement, scene) {
    if (refinement.stage === BRACKETING) {
        return bracket(refinement, scene);
    }
    if (refinement.stage === ENCLOSING) {
        return enclose(refinement, scene);
    }
    return compare_nearby(refinement, scene);
}

/**
 * The leaf after one, by its number.
 *
 * @type {(leaf: number) => CellVisit}
 */
export function next_leaf(leaf) {
    return { number: leaf + 1, level: LEAF, words: ALL_WORDS };
}

/**
 * The search at the beginning of its next stage, on the other side; the result after the last one.
 *
 * @type {(search: WindSearch) => WindSearch}
 */
export function next_stage(search) {
    const stage = search.stage + 1, side = 0 - search.side;
    if (stage === ENDED) {
        return end_search(search);
    }
    let visit = FIRST_CELL;
    if (stage > COARSE_OTHER || search.sides === 0 - side) {
        const first = search.others.first, second = search.others.second, third = search.others.third, fourth =
                search.others.fourth;
        visit = next_leaf((((first | second) | third) | fourth) !== 0 ? -1 : shift_left(FIRST_CELLS, LEAF));
    }
    return { ...search, stage: stage, side: side, visit: visit, before: NO_LEAF_END, leaves: search.others, others:
            search.leaves, corner: NO_CORNER, compared: Infinity, visits: 0 };
}

/**
 * Whether a cell needs not be halved further.
 *
 * @type {(visit: CellVisit, cell: OpenCell, best: WindCandidate) => boolean}
 */
export function is_done(visit, cell, best) {
    return visit.level === LAST || cell.earliest >= best.path.time - cell.tolerance;
}

/**
 * The first half of a cell inside which a set of words may join.
 *
 * @type {(visit: CellVisit, possible: number) => CellVisit}
 */
export function first_half(visit, possible) {
    const words = visit.level < NARROWED ? (shift_left(visit.words, 6) | possible) : visit.words;
    return { number: 2 * visit.number, level: visit.level + 1, words };
}

/**
 * The cell after one that needs not be halved: the largest that begins there and is not yet visited.
 *
 * @type {(visit: CellVisit) => CellVisit}
 */
export function next_cell(visit) {
    let number = visit.number + 1, level = visit.level, words = visit.words;
    while (level > 0 && integer_modulo(number, 2) === 0) {
        const new_number = integer_quotient(number, 2);
        const new_level = level - 1;
        const new_words = level <= NARROWED ? (words >> 6) : words;
        number = new_number;
        level = new_level;
        words = new_words;
    }
    return { number, level, words };
}

/**
 * The cell after one of a leaf in which a set of words may join: its first half, the next one, or the next leaf.
 *
 * @type {(visit: CellVisit, words: number) => CellVisit}
 */
export function next_in_leaves(visit, words) {
    const leaf = shift_right(visit.number, visit.level - LEAF);
    visit = words !== 0 ? first_half(visit, words) : next_cell(visit);
    return visit.level >= LEAF && shift_right(visit.number, visit.level - LEAF) === leaf ? visit : next_leaf(leaf);
}

/**
 * The search with a refinement continued until it ends, and with its result then.
 *
 * @type {(search: WindSearch) => WindSearch}
 */
export function refine_path(search) {
    let refinement = search.refinement, left = search.left;
    const scene = search.scene;
    while (refinement.stage !== REFINED && left > 0) {
        refinement = refine(refinement, scene);
        left = left - 1;
    }
    search = { ...search, refinement: refinement, left: left };
    if (refinement.stage !== REFINED) {
        return search;
    }
    const found = minimum_of(refinement), best = search.best;
    if (search.stage === JOINING) {
        // The better side is searched first, which shortens the search on the other side.
        search = { ...search, best: found, side: found.side !== 0 ? 0 - found.side : -1 };
        return found.path.time > 0.0 ? next_stage(search) : end_search(search);
    }
    if (search.stage <= COARSE_OTHER) {
        return { ...search, best: found.path.time < best.path.time ? found : best };
    }
    const words = is_done(search.visit, search.cell, found) ? 0 : search.cell.words;
    return { ...search, best: found, visit: next_in_leaves(search.visit, words) };
}

/**
 * The fastest of `best` and the paths to `JOINS` points around the circle, where possible with a straight piece.
 *
 * @type {(side: number, scene: WindScene, best: WindCandidate) => WindCandidate}
 */
export function best_of_joins(side, scene, best) {
    for (let i = 0; i < JOINS; i++) {
        const phase = TWO_PI / JOINS * (i + 0.5);
        const words = best.path.time < Infinity ? WITH_STRAIGHT : ALL_WORDS;
        const path = first_path_of(words, phase, side, scene, best.path.time);
        if (path.time < best.path.time) {
            best = { phase, side, path };
        }
    }
    return best;
}

/**
 * The search with the points of joining on one side tried; then the best path is refined.
 *
 * @type {(search: WindSearch) => WindSearch}
 */
export function join_one_side(search) {
    let best = search.best;
    const scene = search.scene, side = search.side;
    if (search.sides !== 0 - side) {
        best = best_of_joins(side, scene, best);
    }
    const refinement = side === 1 ? NO_REFINEMENT : begin_refinement(best, TWO_PI / JOINS, scene);
    return { ...search, best: best, side: 0 - side, left: search.left - 1, refinement: refinement };
}

/**
 * The phase in the middle of a cell, and half its width.
 *
 * @type {(visit: CellVisit) => [number, number]}
 */
export function middle_of(visit) {
    const half = 0.5 * TWO_PI / shift_left(FIRST_CELLS, visit.level);
    return [half * (2.0 * visit.number + 1.0), half];
}

/**
 * The cell around a phase.
 *
 * @type {(phase: number, half: number, side: number, scene: WindScene) => Cell}
 */
export function cell_at(phase, half, side, scene) {
    const x = scene.x, y = scene.y, c0 = scene.c, s0 = scene.s, R = scene.R, wx = scene.wx, wy = scene.wy;
    const hold_pose_1 = hold_pose(phase, side, R, wx, wy);
    const px = hold_pose_1[0], py = hold_pose_1[1], c = hold_pose_1[2], s = hold_pose_1[3], g = hold_pose_1[4];
    const wind = length(wx, wy), out = (wx * px + wy * py) / R;
    const crab = Math.sqrt((1.0 - out) * (1.0 + out));
    // The heading turns by g/crab, from 1 - |w| upwind to 1 + |w| downwind; that changes most across the wind.
    const turning = g / crab, twist = wind / Math.sqrt((1.0 - wind) * (1.0 + wind));
    const fastest_turning = min_real(1.0 + wind, turning + twist * half);
    const bend = R + fastest_turning * fastest_turning + twist;
    const tx = R * (c + wx) / g, ty = R * (s + wy) / g;
    const still = (1.0 - wind) * (1.0 + wind);
    const turned_more = side * out * still / (crab * crab * crab);
    const jerk = twist * (1.0 + 2.0 * wind * wind) / still;
    const bend_change = R + jerk + 3.0 * fastest_turning * twist + fastest_turning * fastest_turning *
            fastest_turning;
    return { half, px: px - x, py: py - y, c, s, tx, ty, nx: -px, ny: -py, turning: (0 - side) * turning,
            turned_more, bend, bend_change, twist, jerk, fastest_turning, wind, c0, s0, wx, wy };
}

/**
 * Whether no vehicle, however fast it turns, reaches the cell before the time.
 *
 * @type {(cell: Cell, radius: number, time: number) => boolean}
 */
export function is_out_of_reach(cell, radius, time) {
    return length(cell.px - cell.wx * time, cell.py - cell.wy * time) >= time + radius * cell.half;
}

/**
 * The centres of the first and the last arc of a word with these controls.
 *
 * @type {(first: number, last: number, cell: Cell) => Centres}
 */
export function centres(first, last, cell) {
    const x = cell.px - last * cell.s + first * cell.s0, y = cell.py + last * cell.c - first * cell.c0;
    const turning = cell.turning, c = cell.c, s = cell.s;
    const dx = cell.tx - last * turning * c, dy = cell.ty - last * turning * s;
    const ddx = cell.nx - last * (cell.turned_more * c - turning * turning * s);
    const ddy = cell.ny - last * (cell.turned_more * s + turning * turning * c);
    const rate = length(dx, dy);
    const change = (rate + 0.5 * cell.bend * cell.half) * cell.half;
    return { x, y, dx, dy, ddx, ddy, change, fastest: rate + cell.bend * cell.half };
}

/**
 * An angle in [0, 2 pi), or one turn less where a change by as much as `change` may bring it back to zero.
 *
 * @type {(turn: number, change: number) => number}
 */
export function lowest_turn(turn, change) {
    return turn + change >= TWO_PI ? turn - TWO_PI : turn;
}

/**
 * A lower bound, inside a cell, on a function whose second derivative is at least -`bend`.
 *
 * @type {(value: number, slope: number, bend: number, half: number) => number}
 */
export function least_inside(value, slope, bend, half) {
    return value - (Math.abs(slope) + 0.5 * bend * half) * half;
}

/**
 * The second derivative of the length of LSL (or LSR, with `distance` its straight piece) but for that of the arcs.
 *
 * The straight piece has the direction p.
 *
 * @type {(p1: number, p2: number, distance: number, between: Centres) => number}
 */
export function distance_curvature(p1, p2, distance, between) {
    const across = p1 * between.dy - p2 * between.dx;
    return p1 * between.ddx + p2 * between.ddy + across * across / distance;
}

/**
 * A bound on the derivative of `distance_curvature` inside a cell, where the straight piece is at least `nearest`.
 *
 * `touching` is 2 for LSR, where the direction of the straight piece changes its length too, otherwise 0.
 *
 * @type {(nearest: number, touching: number, between: Centres, cell: Cell) => number}
 */
export function distance_curvature_change(nearest, touching, between, cell) {
    const swing = between.fastest / nearest;
    return cell.bend_change + (3.0 * cell.bend + (3.0 * between.fastest + touching * swing) * swing) * swing;
}

/**
 * A lower bound, inside a cell, on a function whose third derivative is at most `change` in size.
 *
 * @type {(value: number, slope: number, curvature: number, change: number, half: number) => number}
 */
export function least_inside_curved(value, slope, curvature, change, half) {
    const steep = Math.abs(slope);
    let least = value - (steep - (0.5 * curvature - change * half / 6.0) * half) * half;
    const square = curvature * curvature - 2.0 * steep * change;
    if (curvature > 0.0 && square > 0.0) {
        const lowest = 2.0 * steep / (curvature + Math.sqrt(square));
        if (lowest < half) {
            least = min_real(least, value - (steep - (0.5 * curvature - change * lowest / 6.0) * lowest) * lowest);
        }
    }
    return least;
}

/**
 * Half the rate at which the length of a word, less the time, falls with the time.
 *
 * Its straight piece has the direction p. The rate is no less while the direction changes by no more than this over
 * |w|.
 *
 * @type {(p1: number, p2: number, cell: Cell) => number}
 */
export function slowest_fall(p1, p2, cell) {
    return 0.5 * (1.0 + cell.wx * p1 + cell.wy * p2);
}

/**
 * Whether two arcs that add up to `arcs` are too few throughout the cell: the first alone would be longer.
 *
 * @type {(u: number, arcs: number, between: Centres, turned: number, cell: Cell) => boolean}
 */
export function lsl_rsr_needs_turn(u, arcs, between, turned, cell) {
    const wx = cell.wx, wy = cell.wy;
    let x = between.x - wx * arcs, y = between.y - wy * arcs;
    const straight = interception(x, y, wx, wy);
    x = x - wx * straight;
    y = y - wy * straight;
    const distance = length(x, y);
    if (distance === 0.0) {
        return false;
    }
    const rate = slowest_fall(x / distance, y / distance, cell);
    // How far the centres move relative to each other, since the time changes too.
    let shift = between.change + cell.wind * (between.change + turned) / rate;
    const first = angle(arc_rotation(u, cell.c0, cell.s0, x, y));
    let swing = 0.5 * 3.141592653589793 * shift / distance;
    /** @type {boolean} */ const known = shift < distance && cell.wind * swing <= rate;
    if (known && first - swing <= arcs + turned) {
        // The rate is known better now.
        shift = between.change + cell.wind * (between.change + turned) / (2.0 * rate - cell.wind * swing);
        swing = 0.5 * 3.141592653589793 * shift / distance;
    }
    return known && first - swing > arcs + turned && first + swing < TWO_PI;
}

/**
 * The margin of LSL (u = +1) or RSR: the length of the word less the time.
 *
 * @type {(u: number, cell: Cell, time: number) => number}
 */
export function lsl_rsr_margin(u, cell, time) {
    const between = centres(u, u, cell), turned = cell.fastest_turning * cell.half;
    const x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const arcs = lowest_turn(angle(arc_rotation(u, cell.c0, cell.s0, cell.c, cell.s)), turned);
    const distance = length(x, y);
    const nearer = distance > 0.0 ? (x * between.dx + y * between.dy) / distance : between.change / cell.half;
    const slope = nearer + u * cell.turning, bend = cell.bend + cell.twist, value = distance + arcs - time;
    let margin = least_inside(value, slope, bend, cell.half);
    if (margin < 0.0 && 0.0 < distance - between.change) {
        const curvature = distance_curvature(x / distance, y / distance, distance, between) + u * cell.turned_more;
        const change = distance_curvature_change(distance - between.change, 0.0, between, cell) + cell.jerk;
        margin = max_real(margin, least_inside_curved(value, slope, curvature, change, cell.half));
    }
    if (margin < 0.0 && lsl_rsr_needs_turn(u, arcs, between, turned, cell)) {
        return margin + TWO_PI;
    }
    return margin;
}

/**
 * The angle by which the straight piece of LSR or RSL turns at most while the arcs may touch.
 *
 * @type {(touching: number, between: Centres, cell: Cell) => number}
 */
export function most_turned(touching, between, cell) {
    const moved = 0.5 * cell.wind * touching;
    return acos(2.0 / (2.0 + 3.0 * between.change)) + (moved < 1.0 ? 0.5 * 3.141592653589793 * moved :
            3.141592653589793);
}

/**
 * Whether LSR or RSL has an arc below zero throughout the cell if its two arcs last `arcs` at the beginning.
 *
 * Or whether it is shorter than the time from the beginning on, and `before` that, so that it is never equal to it.
 *
 * @type {(u: number, between: Centres, cell: Cell, arcs: number, interval: [number, number], before: number) =>
 *         boolean}
 */
export function lsr_rsl_needs_turn(u, between, cell, arcs, interval, before) {
    const begin = interval[0], end_ = interval[1];
    const turned = cell.fastest_turning * cell.half;
    const tangent_1 = tangent(u, between.x - cell.wx * begin, between.y - cell.wy * begin);
    let straight = tangent_1[0];
    if (straight + arcs + between.change + turned + (1.0 + cell.wind) * before < begin) {
        return true;
    }
    const ends = { c0: cell.c0, s0: cell.s0, c: cell.c, s: cell.s, wx: cell.wx, wy: cell.wy, arc_tolerance: 0.0 };
    const time = lsr_rsl_root(u, between.x, between.y, ends, arcs, interval);
    if (!(begin < time && time < end_)) {
        return false;
    }
    const x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const tangent_2 = tangent(u, x, y);
    straight = tangent_2[0];
    const p1 = tangent_2[1], p2 = tangent_2[2];
    const rate = slowest_fall(p1, p2, cell);
    const later = (between.change + turned) / rate;
    const moved = between.change + cell.wind * later;
    const nearest = length(x, y) - moved;
    if (nearest <= 2.0 || time - later <= begin) {
        return false;
    }
    const swing = moved / Math.sqrt(nearest * nearest - 4.0);
    if (cell.wind * swing > rate) {
        return false;
    }
    const t1 = angle(arc_rotation(u, cell.c0, cell.s0, p1, p2)), t3 = angle(arc_rotation(u, cell.c, cell.s, p1,
            p2));
    const first = min_real(t1, TWO_PI - t1), last = min_real(t3, TWO_PI - t3);
    return t1 + straight + t3 - time > 3.141592653589793 && first > swing && last > swing + turned;
}

/**
 * The margin of LSR or RSL at the end of an interval, throughout which the centres are further apart than 2.
 *
 * `before` is how long before the interval the arcs may touch, `after` how long after it.
 *
 * @type {(u: number, between: Centres, cell: Cell, interval: [number, number], before: number, after: number) =>
 *         number}
 */
export function tangent_margin(u, between, cell, interval, before, after) {
    const begin = interval[0], time = interval[1];
    const x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const tangent_1 = tangent(u, x, y);
    const straight = tangent_1[0], p1 = tangent_1[1], p2 = tangent_1[2];
    const nearest = length(x, y) - between.change;
    if (nearest <= 2.0) {
        return -Infinity;
    }
    // The direction of the straight piece turns by less than this inside the cell, and by `earlier` during the interval.
    let swing = between.change / Math.sqrt(nearest * nearest - 4.0);
    if (before + after > 0.0) {
        swing += most_turned(before + after, between, cell);
    }
    const tangent_2 = tangent(u, between.x - cell.wx * begin, between.y - cell.wy * begin);
    const q1 = tangent_2[1], q2 = tangent_2[2];
    const earlier = u * atan2(p1 * q2 - p2 * q1, p1 * q1 + p2 * q2);
    const turned = cell.fastest_turning * cell.half;
    const first = angle(arc_rotation(u, cell.c0, cell.s0, p1, p2)), last = angle(arc_rotation(u, cell.c, cell.s, p1,
            p2));
    const slope = p1 * between.dx + p2 * between.dy - u * cell.turning;
    const middle = straight + first + last - time;
    let value = least_inside(middle, slope, cell.bend + cell.twist, cell.half);
    if (value < 0.0) {
        const curvature = distance_curvature(p1, p2, straight, between) - u * cell.turned_more;
        const change = distance_curvature_change(Math.sqrt(nearest * nearest - 4.0), 2.0, between, cell) +
                cell.jerk;
        value = max_real(value, least_inside_curved(middle, slope, curvature, change, cell.half));
    }
    const lowest = lowest_turn(first, swing + max_real(earlier, 0.0)) + lowest_turn(last, swing + max_real(earlier,
            0.0) + turned);
    value += lowest - first - last;
    // The arcs at the beginning of the interval, without those turns that either arc may lose.
    let arcs = lowest + 2.0 * earlier;
    for (let pass_1 = 0; pass_1 < 3; pass_1++) {
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

/**
 * The margin of LSR (u = +1) or RSL: the length of the word less the time, where the arcs do not overlap.
 *
 * @type {(u: number, cell: Cell, time: number) => number}
 */
export function lsr_rsl_margin(u, cell, time) {
    const between = centres(u, 0 - u, cell);
    const wx = cell.wx, wy = cell.wy, change = between.change;
    const time_within_1 = time_within(between.x, between.y, wx, wy, 2.0 + 2.0 * change);
    const enter = time_within_1[0], leave = time_within_1[1];
    if (enter >= time) {
        return tangent_margin(u, between, cell, [0.0, time], 0.0, 0.0);
    }
    let margin = Infinity;
    let inner_enter = Infinity, inner_leave = Infinity;
    if (change < 2.0) {
        const time_within_2 = time_within(between.x, between.y, wx, wy, 2.0 - change);
        inner_enter = time_within_2[0];
        inner_leave = time_within_2[1];
    }
    let touching;
    if (inner_enter > 0.0) {
        // The first arc and the last may touch between these times.
        touching = min_real(min_real(inner_enter, leave), time) - enter;
        if (enter === 0.0) {
            return -Infinity;
        }
        margin = tangent_margin(u, between, cell, [0.0, enter], 0.0, touching);
        margin -= (1.0 + cell.wind) * touching;
    }
    if (leave <= time) {
        touching = leave - (inner_enter < Infinity ? inner_leave : enter);
        const last = tangent_margin(u, between, cell, [leave, time], touching, 0.0);
        margin = min_real(margin, last);
    } else if (inner_leave < time || inner_enter === Infinity) {
        return -Infinity;
    }
    return margin;
}

/**
 * What is left between the outer arcs of LRL or RLR at a time, with a given T less twice its middle arc.
 *
 * @type {(u: number, between: Centres, cell: Cell, outside: number, time: number) => number}
 */
export function middle_margin_at(u, between, cell, outside, time) {
    const x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const distance = length(x, y), half_middle = 0.25 * (time - outside);
    if (half_middle <= 0.0 || half_middle >= 3.141592653589793 || distance <= between.change) {
        return -Infinity;
    }
    const turning = cell.fastest_turning;
    const across = sin(half_middle), along = cos(half_middle), nearest = distance - between.change;
    const slope = along * u * cell.turning + (x * between.dx + y * between.dy) / distance;
    const bend = 0.25 * turning * turning + cell.twist + cell.bend + between.fastest * between.fastest / nearest;
    const value = 4.0 * across - distance;
    let margin = least_inside(value, slope, bend, cell.half);
    if (margin < 0.0) {
        let curvature = -distance_curvature(x / distance, y / distance, distance, between);
        curvature -= 0.25 * across * cell.turning * cell.turning + along * u * cell.turned_more;
        let change = distance_curvature_change(nearest, 0.0, between, cell);
        change += (0.0625 * turning * turning + 0.75 * cell.twist) * turning + cell.jerk;
        margin = max_real(margin, least_inside_curved(value, slope, curvature, change, cell.half));
    }
    return margin;
}

/**
 * The margin of LRL or RLR with a given T less twice its middle arc, of which the middle may last longer.
 *
 * A word that does not join before a later time does not join before this time either.
 *
 * @type {(u: number, between: Centres, cell: Cell, outside: number, time: number) => number}
 */
export function middle_margin(u, between, cell, outside, time) {
    let margin = middle_margin_at(u, between, cell, outside, time);
    if (margin < 0.0) {
        const x = between.x - cell.wx * time, y = between.y - cell.wy * time;
        const distance = length(x, y);
        if (distance > 0.0) {
            const growth = cos(0.25 * (time - outside)) + (x * cell.wx + y * cell.wy) / distance;
            if (growth > 0.0) {
                const later = growth / (0.25 + cell.wind * cell.wind / distance);
                margin = max_real(margin, middle_margin_at(u, between, cell, outside, time + later));
            }
        }
    }
    return margin;
}

/**
 * Whether LRL or RLR with a given T less twice its middle arc exists nowhere in the cell before the time.
 *
 * In `moving_target.middle_arc`, h has a root at which it rises only if it is not positive somewhere between the
 * two points of inflection. There it is convex: it lies above its tangents.
 *
 * @type {(between: Centres, cell: Cell, outside: number, time: number) => boolean}
 */
export function has_no_middle(between, cell, outside, time) {
    const wx = cell.wx, wy = cell.wy;
    const wind = cell.wind;
    const turned = cell.fastest_turning * cell.half;
    let low = acos(wind * wind);
    let high = min_real(TWO_PI - low, 0.5 * (time - outside + turned));
    // How far the centres move relative to each other inside the cell, for a given middle arc.
    const shift = between.change + wind * turned;
    const needed = (8.0 + 3.0 * shift) * shift;
    for (let pass_1 = 0; pass_1 < TANGENTS; pass_1++) {
        if (low > high) {
            return true;
        }
        const m = 0.5 * (low + high);
        const x = between.x - wx * (outside + 2.0 * m), y = between.y - wy * (outside + 2.0 * m);
        const across = sin(0.5 * m), along = cos(0.5 * m);
        const spare = x * x + y * y - 16.0 * across * across - needed;
        const slope = -4.0 * (wx * x + wy * y) - 16.0 * across * along;
        if (spare <= 0.0) {
            return false;
        }
        // By the tangent, h is large enough on the side to which it rises, and for some way to the other side.
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

/**
 * Whether LRL or RLR with a given T less twice its middle arc has an arc below zero throughout the cell.
 *
 * @type {(u: number, between: Centres, cell: Cell, outside: number) => boolean}
 */
export function lrl_rlr_needs_turn(u, between, cell, outside) {
    const wx = cell.wx, wy = cell.wy;
    const wind = cell.wind, turned = cell.fastest_turning * cell.half;
    const middle = middle_arc(between.x - wx * outside, between.y - wy * outside, wx, wy, [0.0, Infinity]);
    if (middle === Infinity) {
        return false;
    }
    const time = outside + 2.0 * middle;
    const x = between.x - wx * time, y = between.y - wy * time;
    const distance = length(x, y);
    const slope = -4.0 * (wx * x + wy * y) - 8.0 * sin(middle);
    const shift = between.change + wind * turned;
    // Near its root, h changes by up to `rise` inside the cell. Its second derivative is at most 16, so the root moves
    // by less than twice `rise` over the slope, as long as that does not exceed a sixteenth of the slope.
    const rise = (2.0 * distance + 0.25 * wind * slope + shift) * shift;
    if (32.0 * rise >= slope * slope || slope <= 0.0) {
        return false;
    }
    const longer = 2.0 * rise / slope;
    const moved = shift + 2.0 * wind * longer;
    if (moved >= distance) {
        return false;
    }
    const swing = 0.5 * 3.141592653589793 * moved / distance + 0.5 * longer;
    const ends = { c0: cell.c0, s0: cell.s0, c: cell.c, s: cell.s, wx, wy, arc_tolerance: 0.0 };
    const path = three_arcs(u, middle, x, y, ends);
    const first = min_real(path.t1, TWO_PI - path.t1), last = min_real(path.t3, TWO_PI - path.t3);
    return path.time - time > 3.141592653589793 && first > swing && last > swing + turned;
}

/**
 * The margin of LRL (u = +1) or RLR: what is left between its outer arcs once the middle one lasts long enough.
 *
 * Paths whose T less twice the middle arc is `known`, within half a turn, are left out.
 *
 * @type {(u: number, cell: Cell, time: number, known: number) => number}
 */
export function lrl_rlr_margin(u, cell, time, known) {
    const between = centres(u, u, cell), turned = cell.fastest_turning * cell.half;
    const time_within_1 = time_within(between.x, between.y, cell.wx, cell.wy, 4.0 + between.change);
    const enter = time_within_1[0];
    if (enter >= time) {
        return Infinity;
    }
    const arcs = lowest_turn(angle(arc_rotation(u, cell.c0, cell.s0, cell.c, cell.s)), turned);
    const shortest = 2.0 * acos(cell.wind);
    for (const turns of [-1.0, 0.0, 1.0, 2.0]) {
        const outside = arcs + TWO_PI * turns;
        if (Math.abs(outside - known) < 3.141592653589793) {
            continue;
        }
        let late = max_real(max_real(outside - turned + 2.0 * shortest, -outside - turned), shortest) - time;
        if (late < 0.0) {
            late = middle_margin(u, between, cell, outside, time);
        }
        if (late < 0.0 && !(has_no_middle(between, cell, outside, time) || lrl_rlr_needs_turn(u, between, cell,
                outside))) {
            return late;
        }
    }
    return Infinity;
}

/**
 * Those of a set of words that may join before a time inside the cell with this middle and half width.
 *
 * @type {(phase: number, half: number, words: number, side: number, scene: WindScene, time: number) => number}
 */
export function words_inside(phase, half, words, side, scene, time) {
    const cell = cell_at(phase, half, side, scene);
    let impossible = 0;
    if (is_out_of_reach(cell, scene.R, time)) {
        return 0;
    }
    for (const u of [1, -1]) {
        const lsl = set_of(encode(u, 0, u)), lsr = set_of(encode(u, 0, 0 - u)), lrl = set_of(encode(u, 0 - u, u));
        if ((words & lsl) !== 0 && lsl_rsr_margin(u, cell, time) >= 0.0) {
            impossible |= lsl;
        }
        if ((words & lsr) !== 0 && lsr_rsl_margin(u, cell, time) >= 0.0) {
            impossible |= lsr;
        }
        if ((words & lrl) !== 0 && lrl_rlr_margin(u, cell, time, Infinity) >= 0.0) {
            impossible |= lrl;
        }
    }
    return (words & ~impossible);
}

/**
 * An angle, in [-pi, pi).
 *
 * @type {(angle: number) => number}
 */
export function wrap(angle) {
    return real_modulo(angle + 3.141592653589793, TWO_PI) - 3.141592653589793;
}

/**
 * An upper bound on the time to hold the circle from `phase` - `width` (zero or more) to `phase`.
 *
 * The ground speed rises from the headwind to the tailwind and then falls: it is least at one of the two ends.
 *
 * @type {(phase: number, width: number, side: number, R: number, wx: number, wy: number) => number}
 */
export function hold_time(phase, width, side, R, wx, wy) {
    const hold_pose_1 = hold_pose(phase - width, side, R, wx, wy);
    const speed_before = hold_pose_1[4];
    const hold_pose_2 = hold_pose(phase, side, R, wx, wy);
    const speed_after = hold_pose_2[4];
    return R * width / min_real(speed_before, speed_after);
}

/**
 * The first path to the end of a cell, and the time to hold the circle through the cell.
 *
 * `NO_PATH` where that path is later than the best one by more than this time.
 *
 * @type {(visit: CellVisit, side: number, scene: WindScene, best: WindCandidate) => [Path, number]}
 */
export function path_to_end(visit, side, scene, best) {
    const middle_of_1 = middle_of(visit);
    const middle = middle_of_1[0], half = middle_of_1[1];
    const within = hold_time(middle + half, 2.0 * half, side, scene.R, scene.wx, scene.wy);
    return [first_path(middle + half, side, scene, best.path.time + within), within];
}

/**
 * Whether the time has a local minimum in the leaf that ends at `after`; `before` is the end of an earlier leaf.
 *
 * @type {(before: LeafEnd, after: LeafEnd) => boolean}
 */
export function has_minimum(before, after) {
    /** @type {boolean} */ const rises = after.point.slope > 0.0, later = after.point.path.time >
            before.point.path.time;
    if (before.number !== after.number - 1) {
        return rises;
    }
    return (before.point.slope < 0.0 && (rises || later)) || (rises && !later);
}

/**
 * The words that may still join inside a cell early enough; the last leaf's end; the point to refine, or none.
 *
 * A path that joins inside the cell can follow the circle to the cell's end. So no path into the cell is faster
 * than the first path to its end less the time to hold the circle through the cell.
 *
 * @type {(visit: CellVisit, words: number, side: number, scene: WindScene, before: LeafEnd, best: WindCandidate) =>
 *         [number, LeafEnd, JoinPoint]}
 */
export function examine_cell(visit, words, side, scene, before, best) {
    const middle_of_1 = middle_of(visit);
    const middle = middle_of_1[0], half = middle_of_1[1];
    /** @type {boolean} */ const holds_best = side === best.side && Math.abs(wrap(best.phase - middle)) <= half;
    if (visit.level < LEAF && holds_best) {
        return [words, before, NO_POINT];
    }
    const path_to_end_2 = path_to_end(visit, side, scene, best);
    const path = path_to_end_2[0];
    if (path.time === Infinity) {
        return [0, before, NO_POINT];
    }
    if (visit.level < LEAF) {
        return [words, before, NO_POINT];
    }
    const after = { number: visit.number, point: { phase: middle + half, path, slope: join_slope(path, middle +
            half, side, scene) } };
    if (holds_best || !has_minimum(before, after)) {
        return [words, after, NO_POINT];
    }
    /** @type {boolean} */ const adjoins = before.number === after.number - 1;
    return [words, after, adjoins && before.point.path.time < path.time ? before.point : after.point];
}

/**
 * A set of leaves and one more, by its number.
 *
 * @type {(leaves: Leaves, number: number) => Leaves}
 */
export function with_leaf(leaves, number) {
    const first = leaves.first, second = leaves.second, third = leaves.third, fourth = leaves.fourth;
    const quarter = integer_quotient(number, LEAVES), leaf = shift_left(1, integer_modulo(number, LEAVES));
    if (quarter === 0) {
        return { first: (first | leaf), second, third, fourth };
    }
    if (quarter === 1) {
        return { first, second: (second | leaf), third, fourth };
    }
    if (quarter === 2) {
        return { first, second, third: (third | leaf), fourth };
    }
    return { first, second, third, fourth: (fourth | leaf) };
}

/**
 * The search after cells of one side, until a path has to be refined; some of their leaves are left to search.
 *
 * Cells are visited in the order of their phases, and halved as long as a word may join inside them early enough.
 *
 * @type {(search: WindSearch) => WindSearch}
 */
export function coarse_search(search) {
    const side = search.side, scene = search.scene, best = search.best;
    let visit = search.visit, before = search.before;
    let leaves = search.leaves, left = search.left, start = NO_POINT;
    while (left > 0 && start.path.time === Infinity && visit.number < shift_left(FIRST_CELLS, visit.level)) {
        left -= 1;
        const middle_of_1 = middle_of(visit);
        let words = words_inside(middle_of_1[0], middle_of_1[1], (visit.words & ALL_WORDS), side, scene,
                best.path.time);
        if (words !== 0 && visit.level >= COARSE) {
            const examine_cell_2 = examine_cell(visit, words, side, scene, before, best);
            words = examine_cell_2[0];
            before = examine_cell_2[1];
            start = examine_cell_2[2];
            if (words !== 0 && visit.level === LEAF) {
                leaves = with_leaf(leaves, visit.number);
                words = 0;
            }
        }
        visit = words !== 0 ? first_half(visit, words) : next_cell(visit);
    }
    search = { ...search, visit: visit, before: before, leaves: leaves, left: left };
    if (start.path.time < Infinity) {
        return { ...search, refinement: refinement_from(start, side, TWO_PI / shift_left(FIRST_CELLS, LEAF)) };
    }
    return visit.number < shift_left(FIRST_CELLS, visit.level) ? search : next_stage(search);
}

/**
 * Whether a set of leaves contains the one with a number.
 *
 * @type {(leaves: Leaves, number: number) => boolean}
 */
export function has_leaf(leaves, number) {
    const first = leaves.first, second = leaves.second, third = leaves.third, fourth = leaves.fourth;
    const quarter = integer_quotient(number, LEAVES);
    const members = quarter === 0 ? first : quarter === 1 ? second : quarter === 2 ? third : fourth;
    return (shift_right(members, integer_modulo(number, LEAVES)) & 1) !== 0;
}

/**
 * By how much a path may be faster than the best one and remain unknown.
 *
 * @type {(best: WindCandidate, scene: WindScene) => number}
 */
export function time_tolerance(best, scene) {
    return WIND_TIE_TOLERANCE * (1.0 + scene.R + best.path.time);
}

/**
 * The tolerance after `MOST_VISITS` cells: an upper bound on the time to hold the circle through `UNKNOWN_ARC`.
 *
 * @type {(scene: WindScene) => number}
 */
export function hold_tolerance(scene) {
    return scene.R / (1.0 - length(scene.wx, scene.wy)) * UNKNOWN_ARC;
}

/**
 * The two arcs of which the best path consists, up to rounding; `NO_CORNER` for another path.
 *
 * @type {(best: WindCandidate, scene: WindScene) => Corner}
 */
export function corner_of(best, scene) {
    let arcs = two_arc_entry(best, SHORT);
    if (arcs.word !== 0) {
        const fit_two_arcs_1 = fit_two_arcs(arcs, best.phase, scene);
        arcs = fit_two_arcs_1[0];
        const phase = fit_two_arcs_1[1];
        if (is_close(arcs, phase, best.path.time, scene)) {
            const controls_2 = controls(arcs.word);
            const u = controls_2[0];
            return { phase, u, t1: arcs.t1, t2: arcs.t2 };
        }
    }
    return NO_CORNER;
}

/**
 * Whether LSR or RSL joins nowhere in the cell more than `longest` before the time of the corner.
 *
 * And whether its arcs remain shorter than a turn.
 *
 * @type {(between: Centres, cell: Cell, longest: number, corner: Corner) => boolean}
 */
export function is_late_before(between, cell, longest, corner) {
    const u = corner.u, t1 = corner.t1, t2 = corner.t2;
    const time = t1 + t2, change = between.change, wind = cell.wind;
    const time_within_1 = time_within(between.x, between.y, cell.wx, cell.wy, 2.0 + 2.0 * change);
    const enter = time_within_1[0];
    const apart = change + wind * longest;
    const arc = max_real(t1, t2 + cell.fastest_turning * cell.half) + acos(2.0 / (2.0 + apart)) + 0.5 * TURNS *
            apart;
    if (enter > 0.0 && enter >= time - longest) {
        // The centres come closer until then: the arcs change in one sense.
        const tangent_2 = tangent(u, between.x - cell.wx * time, between.y - cell.wy * time);
        const p1 = tangent_2[1], p2 = tangent_2[2];
        const tangent_3 = tangent(u, between.x, between.y);
        const q1 = tangent_3[1], q2 = tangent_3[2];
        return arc + max_real(u * atan2(p1 * q2 - p2 * q1, p1 * q1 + p2 * q2), 0.0) < TWO_PI;
    }
    if (arc >= TWO_PI || change >= 2.0) {
        return false;
    }
    const time_within_4 = time_within(between.x, between.y, cell.wx, cell.wy, 2.0 - change);
    const inner_enter = time_within_4[0], inner_leave = time_within_4[1];
    if (inner_enter === Infinity || inner_leave < time - longest || (enter === 0.0 && inner_enter > 0.0)) {
        return false;
    }
    if (inner_enter === 0.0) {
        return true;
    }
    const touching = inner_enter - enter;
    return tangent_margin(u, between, cell, [0.0, enter], 0.0, touching) >= (1.0 + wind) * touching;
}

/**
 * Whether LSR (u = +1) or RSL is never faster than the two arcs inside the cell around their point of joining.
 *
 * Let v be the angle by which the line of centres has turned since the corner. With the straight piece in the
 * direction that it has at the corner, the length would exceed the true one by v^3/3 at most. Where the circles
 * touch, it would be less than the true one by that much at most.
 *
 * @type {(corner: Corner, cell: Cell) => boolean}
 */
export function straight_vanishes(corner, cell) {
    const u = corner.u, t1 = corner.t1, t2 = corner.t2;
    const time = t1 + t2, half = cell.half, wind = cell.wind;
    const between = centres(u, 0 - u, cell);
    const x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const tangent_1 = tangent(u, x, y);
    const p1 = tangent_1[1], p2 = tangent_1[2];
    const slope = p1 * between.dx + p2 * between.dy - u * cell.turning, fall = 1.0 + cell.wx * p1 + cell.wy * p2;
    const steep = Math.abs(slope), curvature = p1 * between.ddx + p2 * between.ddy - u * cell.turned_more;
    // v is at most TURNS (|D'| x + |w| s)/2, and (a + b)^3 <= 4 (a^3 + b^3). For s up to `longest` the second cube is
    // less than a sixth of `fall` s.
    const windy = CUBE * wind * wind * wind;
    const longest = 1.5 * windy <= fall ? 0.5 : Math.sqrt(fall / (6.0 * windy));
    let change = (cell.bend_change + cell.jerk) / 6.0;
    const cube = CUBE * between.fastest * between.fastest * between.fastest;
    const slack = (max_real(-0.5 * curvature, 0.0) + (cube + change) * half) * half;
    let latest = 1.2 * (steep + slack) / fall;
    if (steep <= slack || latest * half > longest || between.fastest * half > 0.5) {
        return false;
    }
    // The least and the largest s over x, on the side where the word would be faster.
    const moved = between.fastest + wind * latest;
    change += 0.25 * CUBE * moved * moved * moved;
    const shortest = (steep - (max_real(0.5 * curvature, 0.0) + change * half) * half) / fall;
    latest = min_real(latest, (steep + (max_real(-0.5 * curvature, 0.0) + change * half) * half) / fall);
    // How the square of the distance of the centres changes with x there: the circles must overlap.
    const drift = 2.0 * (x * cell.wx + y * cell.wy);
    let apart = 2.0 * (x * between.dx + y * between.dy);
    apart = max_real(drift * shortest, drift * latest) - (slope > 0.0 ? apart : -apart);
    if (shortest < 0.0 || apart + (2.0 * cell.bend + moved * moved) * half >= 0.0) {
        return false;
    }
    return is_late_before(between, cell, longest, corner);
}

/**
 * Whether LRL (u = +1) or RLR is never faster than the two arcs inside the cell around their point of joining.
 *
 * `first` is +1 where its first arc vanishes, -1 where its last does; `middle` and `other` are the durations of the
 * remaining arcs.
 *
 * @type {(u: number, first: number, middle: number, other: number, corner: Corner, cell: Cell) => boolean}
 */
export function arc_vanishes(u, first, middle, other, corner, cell) {
    const time = corner.t1 + corner.t2, half = cell.half, wind = cell.wind;
    const between = centres(u, u, cell);
    let x = between.x - cell.wx * time, y = between.y - cell.wy * time;
    const distance = length(x, y), along = cos(0.5 * middle);
    if (distance === 0.0) {
        return false;
    }
    x = x / distance;
    y = y / distance;
    const slope = -along * u * cell.turning - x * between.dx - y * between.dy;
    const fall = -along - x * cell.wx - y * cell.wy, steep = Math.abs(slope);
    if (fall <= 0.0) {
        return lrl_rlr_margin(u, cell, time, Infinity) >= 0.0;
    }
    if (steep === 0.0) {
        return false;
    }
    const latest = 2.0 * steep / fall;
    const rate = between.fastest + wind * latest, nearest = distance - between.change - wind * latest * half;
    const turning = cell.fastest_turning;
    const sweep = 0.5 * (turning + latest) * half;
    if (nearest <= 0.0 || !(sweep < middle && middle < TWO_PI - sweep)) {
        return false;
    }
    const bend = 0.25 * (turning + latest) * (turning + latest) + cell.twist + cell.bend + rate * rate / nearest;
    const spare = 0.5 * bend * half;
    const swing = (turning + rate / nearest + 0.25 * latest) * half;
    if (spare > steep || swing > SWING || other + swing >= TWO_PI) {
        return false;
    }
    // How the arc that vanishes changes along x, on the side where the word would be faster.
    const turned = u * (x * between.dy - y * between.dx) / distance;
    const drift = (0 - u) * (x * cell.wy - y * cell.wx) / distance;
    const growth = first * turned - 0.25 * u * cell.turning + (first < 0 ? u * cell.turning : 0.0);
    const sooner = first * drift + 0.25;
    const sign = slope > 0.0 ? 1.0 : -1.0;
    const longer = -sign * growth - min_real(sooner * (steep - spare), sooner * (steep + spare)) / fall;
    if (longer + 0.5 * (cell.twist + cell.bend / nearest + rate * rate / (nearest * nearest)) * half >= 0.0) {
        return false;
    }
    return lrl_rlr_margin(u, cell, time, time - 2.0 * middle) >= 0.0;
}

/**
 * Those of a set of words that may be faster than two arcs within a distance of their point of joining.
 *
 * @type {(corner: Corner, reach: number, words: number, side: number, scene: WindScene) => number}
 */
export function words_beside(corner, reach, words, side, scene) {
    const cell = cell_at(corner.phase, reach, side, scene);
    let impossible = 0;
    const u = corner.u;
    const lsr = set_of(encode(u, 0, 0 - u)), lrl = set_of(encode(u, 0 - u, u)), rlr = set_of(encode(0 - u, u, 0 -
            u));
    if ((words & lsr) !== 0 && straight_vanishes(corner, cell)) {
        impossible |= lsr;
    }
    if ((words & lrl) !== 0 && arc_vanishes(u, -1, corner.t2, corner.t1, corner, cell)) {
        impossible |= lrl;
    }
    if ((words & rlr) !== 0 && arc_vanishes(0 - u, 1, corner.t1, corner.t2, corner, cell)) {
        impossible |= rlr;
    }
    return (words & ~impossible);
}

/**
 * Those of a set of words that may join before a time inside a cell next to the end of the best path.
 *
 * Around a local minimum, bounds hold in a neighbourhood that does not depend on how small cells are.
 *
 * @type {(visit: CellVisit, words: number, scene: WindScene, best: WindCandidate, corner: Corner, sooner: number) =>
 *         number}
 */
export function words_beside_best(visit, words, scene, best, corner, sooner) {
    const middle_of_1 = middle_of(visit);
    const middle = middle_of_1[0], half = middle_of_1[1];
    let reach = Math.abs(wrap(best.phase - middle)) + half;
    if (reach <= NEAR_BEST * half) {
        if (corner.u !== 0) {
            reach = Math.abs(wrap(corner.phase - middle)) + half;
            words = words_beside(corner, reach, words, best.side, scene);
        } else {
            words = words_inside(best.phase, reach, words, best.side, scene, sooner);
        }
    }
    return words;
}

/**
 * The time before which no path joins in a cell, as in `examine_cell`; the path to its end if it is faster.
 *
 * @type {(visit: CellVisit, side: number, scene: WindScene, best: WindCandidate) => [number, WindCandidate]}
 */
export function compare_at_end(visit, side, scene, best) {
    const middle_of_1 = middle_of(visit);
    const middle = middle_of_1[0], half = middle_of_1[1];
    const path_to_end_2 = path_to_end(visit, side, scene, best);
    const path = path_to_end_2[0], within = path_to_end_2[1];
    return [path.time - within, { phase: middle + half, side: path.time < best.path.time ? side : 0, path }];
}

/**
 * The search after cells inside the leaves of one side that are left, until a path has to be refined.
 *
 * @type {(search: WindSearch) => WindSearch}
 */
export function fine_search(search) {
    const side = search.side, scene = search.scene, best = search.best, leaves = search.leaves;
    let visit = search.visit;
    let corner = search.corner, compared = search.compared, visits = search.visits, left = search.left;
    let start = NO_CANDIDATE, cell = search.cell;
    while (left > 0 && start.side === 0 && visit.number < shift_left(FIRST_CELLS, visit.level)) {
        if (visit.level === LEAF && !has_leaf(leaves, visit.number)) {
            visit = next_leaf(visit.number);
            continue;
        }
        left = left - 1;
        visits = visits + 1;
        const tolerance = visits <= MOST_VISITS ? time_tolerance(best, scene) : hold_tolerance(scene);
        const sooner = best.path.time - tolerance;
        const middle_of_1 = middle_of(visit);
        let words = words_inside(middle_of_1[0], middle_of_1[1], (visit.words & ALL_WORDS), side, scene, sooner);
        if (words !== 0 && side === best.side) {
            if (best.path.time < compared) {
                corner = corner_of(best, scene);
                compared = best.path.time;
            }
            words = words_beside_best(visit, words, scene, best, corner, sooner);
        }
        if (words !== 0 && integer_modulo(LAST - visit.level, 2) === 0 && visit.level > LEAF) {
            const compare_at_end_2 = compare_at_end(visit, side, scene, best);
            const earliest = compare_at_end_2[0];
            start = compare_at_end_2[1];
            cell = { words, earliest, tolerance };
            if (start.side === 0 && is_done(visit, cell, best)) {
                words = 0;
            }
        }
        if (start.side === 0) {
            visit = next_in_leaves(visit, words);
        }
    }
    search = { ...search, visit: visit, corner: corner, compared: compared, visits: visits, left: left, cell: cell
            };
    if (start.side !== 0) {
        const middle_of_3 = middle_of(visit);
        const half = middle_of_3[1];
        return { ...search, refinement: begin_refinement(start, 2.0 * half, scene) };
    }
    return visit.number < shift_left(FIRST_CELLS, visit.level) ? search : next_stage(search);
}

/**
 * The search after at most `steps` more steps, each of which takes about as long as trying one point of joining.
 *
 * @type {(search: WindSearch, steps: number) => WindSearch}
 */
export function advance_search(search, steps) {
    search = { ...search, left: steps };
    while (search.stage !== ENDED && search.left > 0) {
        if (search.refinement.stage !== REFINED) {
            search = refine_path(search);
        } else if (search.stage === JOINING) {
            search = join_one_side(search);
        } else if (search.stage <= COARSE_OTHER) {
            search = coarse_search(search);
        } else {
            search = fine_search(search);
        }
    }
    return search;
}

/**
 * The fastest maneuver onto the circle, or beside it within the tolerance; nan, with a status, where there is none.
 *
 * docs/wind.md, section 5, bounds by how much another maneuver could be faster, and says how the answer is found
 * and checked. The status is `Status.NOT_CONVERGED` where the maneuver, flown exactly, does not end on the circle.
 *
 * @type {(problem: WindProblem) => WindEntry}
 */
export function wind_search_fastest(problem) {
    return advance_search(begin_search(problem), UNLIMITED).entry;
}

/**
 * Write the times of the first paths to `SAMPLES` points around the circle.
 *
 * @type {(side: number, scene: WindScene, times: number[]) => void}
 */
export function sampled_times(side, scene, times) {
    for (let i = 0; i < SAMPLES; i++) {
        times[i] = first_path(TWO_PI / SAMPLES * i, side, scene, Infinity).time;
    }
}

/**
 * Whether the time of sample i is no greater than those beside it.
 *
 * @type {(times: number[], i: number) => boolean}
 */
export function is_local_minimum(times, i) {
    return times[i] < Infinity && times[i] <= min_real(times[integer_modulo(i - 1, SAMPLES)], times[integer_modulo(i
            + 1, SAMPLES)]);
}

/**
 * The local minimum of the time next to a candidate, where the slope changes its sign or the time jumps.
 *
 * Only the words of the two points that enclose the minimum are tried, until all are at the end.
 *
 * @type {(found: WindCandidate, width: number, scene: WindScene) => WindCandidate}
 */
export function refined_minimum(found, width, scene) {
    let refinement = begin_refinement(found, width, scene);
    while (refinement.stage !== REFINED) {
        refinement = refine(refinement, scene);
    }
    return minimum_of(refinement);
}

/**
 * The maneuver at the local minimum next to sample i.
 *
 * @type {(i: number, side: number, scene: WindScene) => WindEntry}
 */
export function entry_near_sample(i, side, scene) {
    const phase = TWO_PI / SAMPLES * i, width = TWO_PI / SAMPLES;
    const start = { phase, side, path: first_path(phase, side, scene, Infinity) };
    return wind_entry(refined_minimum(start, width, scene), scene);
}

/**
 * The maneuvers at the local minima of the time over the point of joining, as resolved by `SAMPLES` points.
 *
 * The circle is held on one side, that of the problem.
 *
 * @type {(problem: WindProblem) => WindEntry[]}
 */
export function local_minima(problem) {
    const scene = scene_of(problem), times = Array(SAMPLES).fill(0.0);
    sampled_times(problem.side, scene, times);
    return range(SAMPLES).filter((i) => is_local_minimum(times, i)).map((i) => entry_near_sample(i, problem.side,
            scene));
}

/**
 * The maneuvers that are local minima over the point of joining, each once, fastest first.
 *
 * Those of both sides for *either*; the fastest of each side is among them. The list is empty where `fastest` finds
 * none. To be called only where `status_of` is OK.
 *
 * @type {(problem: WindProblem) => WindEntry[]}
 */
export function wind_search_ranked(problem) {
    const sides = [1, -1].filter((side) => problem.side !== 0 - side).map((side) => ({ ...problem, side: side }));
    let found = sides.map((one) => wind_search_fastest(one));
    if (found.some((maneuver) => maneuver.status !== Status.OK)) {
        return [];
    }
    for (const one of sides) {
        found.push(...local_minima(one));
    }
    // The phase of a local minimum is known to the square root of rounding, the length of a piece that vanishes there to
    // the cube root, as in `synthesis.optima`.
    const one_maneuver = 2.0 * Math.cbrt(24.0 * rounding(problem.x, problem.y, problem.R));
    /** @type {WindEntry[]} */
    const distinct = [];
    for (const maneuver of sorted(found.filter((m) => m.status === Status.OK), time_of)) {
        if (distinct.every((m) => maneuver.side !== m.side || time_apart(entry_of(maneuver), entry_of(m)) >
                one_maneuver)) {
            distinct.push(maneuver);
        }
    }
    return distinct;
}

/**
 * The maneuvers of `ranked` that tie with the fastest, within the accuracy of `fastest`.
 *
 * @type {(problem: WindProblem) => WindEntry[]}
 */
export function wind_search_optima(problem) {
    const maneuvers = wind_search_ranked(problem);
    const least = Math.min(...maneuvers.map(time_of));
    return maneuvers.filter((m) => is_tie_in_wind(time_of(m), least, problem.R));
}

/**
 * The unit vector to the point at which the tangent towards (x, y), outside the circle, leaves it.
 *
 * @type {(x: number, y: number, side: number, R: number) => [number, number]}
 */
export function exit_point(x, y, side, R) {
    const square = x * x + y * y;
    const along = Math.sqrt(max_real(square - R * R, 0.0));
    return [(R * x - side * along * y) / square, (R * y + side * along * x) / square];
}

/**
 * Tangent for |a| up to 2^19.
 *
 * @type {(a: number) => number}
 */
export function tan(a) {
    return sin(a) / cos(a);
}

/**
 * The angle in [-pi/2, pi/2] whose tangent is x.
 *
 * @type {(x: number) => number}
 */
export function atan(x) {
    return atan2(x, 1.0);
}

/**
 * E(p | w^2) for any p and 0 <= w < 1, by arithmetic and geometric means (Abramowitz and Stegun, 17.6).
 *
 * @type {(p: number, w: number) => number}
 */
export function elliptic(p, w) {
    let a = 1.0, b = Math.sqrt((1.0 - w) * (1.0 + w)), c = w;
    let squares = 0.5 * c * c, sines = 0.0, power = 1.0;
    for (let pass_1 = 0; pass_1 < MEANS; pass_1++) {
        // The arctangent's branch follows p, so that p doubles with each step. It is that of the rounded tangent, whose
        // sign is either one where p is an odd multiple of pi/2.
        const slope = tan(p);
        p = p + atan(b / a * slope) + 3.141592653589793 * Math.floor((p - atan(slope)) / 3.141592653589793 + 0.5);
        const new_a = 0.5 * (a + b);
        const new_b = Math.sqrt(a * b);
        const new_c = 0.5 * (a - b);
        a = new_a;
        b = new_b;
        c = new_c;
        power = 2.0 * power;
        squares = squares + 0.5 * power * c * c;
        sines = sines + c * sin(p);
    }
    return p / (power * a) * (1.0 - squares) + sines;
}

/**
 * The time to hold the circle from `phase` - `width` (zero or more) to `phase`.
 *
 * @type {(phase: number, width: number, R: number, wx: number, wy: number) => number}
 */
export function time_held(phase, width, R, wx, wy) {
    const wind = length(wx, wy);
    const before = phase - width;
    if (wind === 0.0) {
        return R * width;
    }
    const along = 2.0 * wind * cos(0.5 * (phase + before)) * sin(0.5 * width);
    return R * (elliptic(phase, wind) - elliptic(before, wind) + along) / ((1.0 - wind) * (1.0 + wind));
}

/**
 * The angle of the circle that is held for a time before `phase`: `time_held` of it is at least that time.
 *
 * @type {(phase: number, time: number, R: number, wx: number, wy: number) => number}
 */
export function width_held(phase, time, R, wx, wy) {
    const wind = length(wx, wy);
    // The ground speed lies between 1 - w and 1 + w.
    let least = (1.0 - wind) * time / R, most = (1.0 + wind) * time / R;
    for (let pass_1 = 0; pass_1 < HALVINGS; pass_1++) {
        const middle = 0.5 * (least + most);
        if (time_held(phase, middle, R, wx, wy) < time) {
            least = middle;
        } else {
            most = middle;
        }
    }
    return most;
}

/**
 * The least angle of the circle that is held.
 *
 * @type {(out: WayOut, scene: WindScene) => number}
 */
export function least_width(out, scene) {
    return max_real(out.width, width_held(out.phase, out.hold, scene.R, scene.wx, scene.wy));
}

/**
 * The exit after an angle of the circle, with the first path to the point where the hold begins.
 *
 * @type {(width: number, out: WayOut, scene: WindScene) => Exit}
 */
export function exit_after(width, out, scene) {
    const path = first_path(out.phase - width, out.side, scene, Infinity);
    return { path, width, time: path.time + time_held(out.phase, width, scene.R, scene.wx, scene.wy) };
}

/**
 * The soonest exit that is no sooner than `out.time`, by halving the angle that is held, from `least` on.
 *
 * @type {(least: number, out: WayOut, scene: WindScene) => Exit}
 */
export function exit_at_time(least, out, scene) {
    let most = max_real(least, width_held(out.phase, out.time, scene.R, scene.wx, scene.wy));
    let best = exit_after(most, out, scene);
    for (let pass_1 = 0; pass_1 < HALVINGS; pass_1++) {
        const middle = exit_after(0.5 * (least + most), out, scene);
        if (middle.time < out.time) {
            least = middle.width;
        } else {
            most = middle.width;
            best = middle;
        }
    }
    return best;
}

/**
 * The exit of an aircraft that holds the circle from the start on, at its first passage that is late enough.
 *
 * @type {(least: number, out: WayOut, scene: WindScene) => Exit}
 */
export function exit_of_hold(least, out, scene) {
    const start = start_on_circle(out.side, scene);
    // A passage that is too early by rounding only counts.
    let width = real_modulo(out.phase - start.phase, TWO_PI);
    const enough = max_real(least, width_held(out.phase, out.time, scene.R, scene.wx, scene.wy)) * (1.0 - ROUNDING)
            - ROUNDING;
    width += TWO_PI * max_integer(integer_of(Math.ceil((enough - width) / TWO_PI)), 0);
    return { path: start.path, width, time: time_held(out.phase, width, scene.R, scene.wx, scene.wy) };
}

/**
 * The exit with the least time at it, among those that join by a first path (docs/legs.md, section 3).
 *
 * @type {(out: WayOut, scene: WindScene) => Exit}
 */
export function soonest_exit(out, scene) {
    const least = least_width(out, scene);
    let best = exit_after(least, out, scene);
    if (best.time < out.time) {
        best = exit_at_time(least, out, scene);
    }
    if (is_on_circle(out.side, scene)) {
        const held = exit_of_hold(least, out, scene);
        best = held.time < best.time ? held : best;
    }
    return best;
}

/**
 * The path of an exit as the maneuver flown, and its miss: how far from the circle it ends when flown exactly.
 *
 * @type {(found: Exit, out: WayOut, scene: WindScene) => [Entry, number]}
 */
export function entry_before(found, out, scene) {
    const drop_short_pieces_1 = drop_short_pieces(found.path.word, found.path.t1, found.path.t2, found.path.t3,
            rounding(scene.x, scene.y, scene.R), ROUNDING);
    const word = drop_short_pieces_1[0], t1 = drop_short_pieces_1[1], t2 = drop_short_pieces_1[2], t3 =
            drop_short_pieces_1[3];
    const entry = { side: out.side, word, t1, t2, t3 };
    return [entry, end_miss(entry, out.phase - found.width, scene)];
}

/**
 * An angle less whole turns, in [-pi, pi].
 *
 * @type {(excess: number) => number}
 */
export function less_whole_turns(excess) {
    return excess - TWO_PI * Math.floor(excess / TWO_PI + 0.5);
}

/**
 * A width before which the slot is out of reach.
 *
 * @type {(slot: Slot, scene: WindScene) => number}
 */
export function begin_width(slot, scene) {
    const x = scene.x, y = scene.y, R = scene.R, wx = scene.wx, wy = scene.wy;
    const square = x * x + y * y - R * R;
    if (square <= 0.0) {
        return 0.0;
    }
    // The circle is out of reach while |q + w t| > t + R.
    const spare = 1.0 - wx * wx - wy * wy, half = R - (x * wx + y * wy);
    const root = Math.sqrt(half * half + spare * square);
    const time = half > 0.0 ? square / (root + half) : (root - half) / spare;
    if (wx === 0.0 && wy === 0.0) {
        return time / R;
    }
    const wind = length(wx, wy);
    let least = (1.0 - wind) * time / R, most = (1.0 + wind) * time / R;
    for (let pass_1 = 0; pass_1 < BEGIN_HALVINGS; pass_1++) {
        const middle = 0.5 * (least + most);
        if (time_held(slot.phase + middle, middle, R, wx, wy) < time) {
            least = middle;
        } else {
            most = middle;
        }
    }
    return least;
}

/**
 * The angle between the heading and the track of a hold at a phase, zero against the wind.
 *
 * @type {(phase: number, wx: number, wy: number) => number}
 */
export function crab_angle(phase, wx, wy) {
    const across = length(wx, wy) * sin(phase);
    return atan2(across, Math.sqrt((1.0 - across) * (1.0 + across)));
}

/**
 * The slot after an angle of the circle.
 *
 * @type {(width: number, slot: Slot, scene: WindScene) => SlotPose}
 */
export function slot_pose(width, slot, scene) {
    const wx = scene.wx, wy = scene.wy;
    const phase = slot.phase + width;
    const hold_pose_1 = hold_pose(phase, slot.side, scene.R, wx, wy);
    const px = hold_pose_1[0], py = hold_pose_1[1], c = hold_pose_1[2], s = hold_pose_1[3], g = hold_pose_1[4];
    const time = time_held(phase, width, scene.R, wx, wy);
    const crab = g - (wx * (c + wx) + wy * (s + wy)) / g;
    const turned = width - (crab_angle(phase, wx, wy) - crab_angle(slot.phase, wx, wy));
    return { width, time, x: px - wx * time - scene.x, y: py - wy * time - scene.y, c, s, advance: scene.R / g,
            turning: g / crab, turned };
}

/**
 * The bounds next to a width.
 *
 * @type {(last: number, pose: SlotPose, slot: Slot, scene: WindScene) => Bounds}
 */
export function bounds_at(last, pose, slot, scene) {
    const wind = length(scene.wx, scene.wy);
    const twist = wind / Math.sqrt((1.0 - wind) * (1.0 + wind));
    let step = 1.0, advance = pose.advance;
    if (wind > 0.0) {
        step = min_real(GROWTH / twist, 1.0);
        advance = advance * Math.exp(min_real(GROWTH, twist));
    }
    const speed = max_real(advance + (last === slot.side ? 1.0 + wind : wind - 1.0), 0.0);
    return { step, speed, speed_change: twist * (advance + 1.0), turning: 1.0 + wind };
}

/**
 * The slot at a width before which it is out of reach: further away than the time.
 *
 * @type {(slot: Slot, scene: WindScene) => SlotPose}
 */
export function first_within_reach(slot, scene) {
    let pose = slot_pose(begin_width(slot, scene), slot, scene);
    for (let pass_1 = 0; pass_1 < APPROACHES; pass_1++) {
        const gap = length(pose.x, pose.y) - pose.time;
        if (gap <= NEAR) {
            break;
        }
        const limits = bounds_at(0, pose, slot, scene);
        // The distance falls at most as fast as the time grows: the slot flies at the speed 1 through the air.
        const advance = limits.speed + 1.0;
        pose = slot_pose(pose.width + min_real(0.5 * gap / advance, limits.step), slot, scene);
    }
    return pose;
}

/**
 * V, the derivative of the way of the centre of the last arc.
 *
 * @type {(last: number, pose: SlotPose, slot: Slot) => number}
 */
export function centre_speed(last, pose, slot) {
    return max_real(pose.advance + (last * slot.side + 0) * pose.turning, 0.0);
}

/**
 * The excess of the word with the first control u, a straight piece and the control `last`.
 *
 * @type {(u: number, last: number, pose: SlotPose, slot: Slot, scene: WindScene) => Excess}
 */
export function excess_at(u, last, pose, slot, scene) {
    const c0 = scene.c, s0 = scene.s, c = pose.c, s = pose.s;
    const dx = pose.x - last * s + u * s0, dy = pose.y + last * c - u * c0;
    const speed = centre_speed(last, pose, slot);
    const along = dx * c + dy * s;
    let straight, arcs, ahead;
    if (u === last) {
        straight = length(dx, dy);
        arcs = angle(arc_rotation(u, c0, s0, c, s));
        ahead = straight > 0.0 ? along / straight : 1.0;
        return { value: less_whole_turns(straight + arcs - pose.time), slope: -speed * (1.0 - ahead), apart: 1.0,
                apart_slope: 0.0 };
    }
    const apart = dx * dx + dy * dy - 4.0, apart_slope = 2.0 * speed * along;
    if (apart <= -2.0) {
        return { value: NaN, slope: 0.0, apart, apart_slope };
    }
    const tangent_1 = tangent(u, dx, dy);
    straight = tangent_1[0];
    const q1 = tangent_1[1], q2 = tangent_1[2];
    const arc_rotation_2 = arc_rotation(u, c0, s0, q1, q2);
    const across1 = arc_rotation_2[0], along1 = arc_rotation_2[1];
    const arc_rotation_3 = arc_rotation(last, q1, q2, c, s);
    const across2 = arc_rotation_3[0], along2 = arc_rotation_3[1];
    arcs = atan2(across1 * along2 + along1 * across2, along1 * along2 - across1 * across2);
    ahead = min_real(q1 * c + q2 * s, 1.0);
    return { value: less_whole_turns(straight + arcs - pose.time), slope: -speed * (1.0 - ahead), apart, apart_slope
            };
}

/**
 * The shortest path of a word with a straight piece to the slot.
 *
 * @type {(u: number, last: number, pose: SlotPose, scene: WindScene) => Path}
 */
export function pieces_with_straight(u, last, pose, scene) {
    const c0 = scene.c, s0 = scene.s, c = pose.c, s = pose.s;
    const dx = pose.x - last * s + u * s0, dy = pose.y + last * c - u * c0;
    let straight, q1, q2;
    if (u === last) {
        straight = length(dx, dy);
        const chosen_1 = straight > 0.0;
        q1 = chosen_1 ? dx / straight : c0;
        q2 = chosen_1 ? dy / straight : s0;
    } else {
        const tangent_2 = tangent(u, dx, dy);
        straight = tangent_2[0];
        q1 = tangent_2[1];
        q2 = tangent_2[2];
    }
    let first = arc_time(arc_rotation(u, c0, s0, q1, q2), 1.0 + straight, scene.arc_tolerance);
    let third = arc_time(arc_rotation(last, q1, q2, c, s), 1.0, scene.arc_tolerance);
    if (u === last) {
        const arcs = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, scene.arc_tolerance);
        if (first + third > arcs + 3.141592653589793) {
            first = first_of_same_turns(first, arcs, straight, scene.arc_tolerance);
            third = first <= arcs ? arcs - first : third;
        }
    }
    return { time: first + straight + third, word: encode(u, 0, last), t1: first, t2: straight, t3: third, lam: 1.0,
            p1: q1, p2: q2 };
}

/**
 * The path with whole turns added to its first arc, so that it takes the time of the slot; `NO_PATH` if longer.
 *
 * @type {(path: Path, pose: SlotPose) => Path}
 */
export function with_turns(path, pose) {
    const turns = Math.floor((pose.time - path.time) / TWO_PI + 0.5);
    if (turns < 0.0) {
        return NO_PATH;
    }
    return { ...path, time: path.time + TWO_PI * turns, t1: path.t1 + TWO_PI * turns };
}

/**
 * The path of a word with a straight piece to the slot, with as many whole turns first as the time leaves.
 *
 * @type {(u: number, last: number, pose: SlotPose, scene: WindScene) => Path}
 */
export function path_with_straight(u, last, pose, scene) {
    return with_turns(pieces_with_straight(u, last, pose, scene), pose);
}

/**
 * Bounds on the second derivative of |d|^2 where |d| is at most `distance`.
 *
 * @type {(u: number, distance: number, limits: Bounds, scene: WindScene) => Bends}
 */
export function bends_of_square(u, distance, limits, scene) {
    const general = 2.0 * (limits.speed * limits.turning + limits.speed_change) * distance, rise = 2.0 *
            limits.speed * limits.speed;
    if (limits.speed_change > 0.0) {
        return { down: general, up: general + rise, size: Infinity };
    }
    // In still air the last centre moves round the circle's: the square is a constant and a cosine.
    return { down: general, up: general + rise, size: 2.0 * limits.speed * length(scene.x - u * scene.s, scene.y + u
            * scene.c) };
}

/**
 * How far a function cannot come down to zero that has this value and derivative, if its second is >= -`bend`.
 *
 * @type {(value: number, slope: number, bend: number) => number}
 */
export function step_without_zero(value, slope, bend) {
    if (bend <= 0.0 && slope >= 0.0) {
        return Infinity;
    }
    return 2.0 * value / (Math.sqrt(slope * slope + 2.0 * bend * value) - slope);
}

/**
 * A step within which the excess falls by at most half a turn, and LSR and RSL neither begin nor cease to exist.
 *
 * @type {(u: number, last: number, excess: Excess, limits: Bounds, scene: WindScene, length_tolerance: number) =>
 *         number}
 */
export function step_of_excess(u, last, excess, limits, scene, length_tolerance) {
    let step = limits.step;
    if (limits.speed > 0.0) {
        step = min_real(step, 0.5 * 3.141592653589793 / limits.speed);
    }
    if (u === last) {
        return step;
    }
    const distance = Math.sqrt(max_real(excess.apart + 4.0, 0.0)) + limits.speed * step;
    const bends = bends_of_square(u, distance, limits, scene);
    const low = min_real(bends.down, bends.size), high = min_real(bends.up, bends.size);
    if (Math.abs(excess.apart) <= length_tolerance) {
        return min_real(step, max_real(high > 0.0 ? Math.abs(excess.apart_slope) / high : step, DOUBLE_ROOT));
    }
    if (excess.apart > 0.0) {
        return min_real(step, step_without_zero(excess.apart, excess.apart_slope, low));
    }
    return min_real(step, step_without_zero(-excess.apart, -excess.apart_slope, high));
}

/**
 * The slot where the excess has a value, between a pose where it is not less and one where it is.
 *
 * @type {(u: number, last: number, a: SlotPose, b: SlotPose, slot: Slot, scene: WindScene, level: number) => SlotPose}
 */
export function root_of_excess(u, last, a, b, slot, scene, level) {
    let least = a.width, most = b.width;
    let width = 0.5 * (least + most), best = a, best_value = Infinity;
    for (let i = 0; i < ROOT_STEPS; i++) {
        const pose = slot_pose(width, slot, scene);
        const excess = excess_at(u, last, pose, slot, scene);
        const value = excess.value - level;
        if (Math.abs(value) < best_value) {
            best = pose;
            best_value = Math.abs(value);
        }
        if (value >= 0.0) {
            least = width;
        } else {
            most = width;
        }
        const newton = excess.slope < 0.0 ? width - value / excess.slope : least;
        // Every third step bisects, since Newton's method is slow at a triple root.
        /** @type {boolean} */ const is_newton = integer_modulo(i, 3) !== 2 && (least < newton && newton < most);
        const following = is_newton ? newton : 0.5 * (least + most);
        if (value === 0.0 || (following === width || following === least || following === most)) {
            break;
        }
        width = following;
    }
    return best;
}

/**
 * The arrival where a word ceases to exist, between a pose to which it has a path and one to which it has none.
 *
 * An arc vanishes there, so that two words meet.
 *
 * @type {(u: number, last: number, inside: SlotPose, outside: SlotPose, slot: Slot, scene: WindScene) =>
 *         WindCandidate}
 */
export function arrival_at_edge(u, last, inside, outside, slot, scene) {
    let width = inside.width, path = path_with_straight(u, last, inside, scene), beyond = outside.width;
    for (let pass_1 = 0; pass_1 < ROOT_STEPS; pass_1++) {
        const middle = 0.5 * (width + beyond);
        if (middle === width || middle === beyond) {
            break;
        }
        const nearer = path_with_straight(u, last, slot_pose(middle, slot, scene), scene);
        if (nearer.time < Infinity) {
            width = middle;
            path = nearer;
        } else {
            beyond = middle;
        }
    }
    return { phase: slot.phase + width, side: slot.side, path };
}

/**
 * The arrival at the root of the excess between two poses; `NO_PATH` where an arc falls short of zero there.
 *
 * Where words meet in a path without this arc, rounding must not make it fall short in all of them.
 *
 * @type {(u: number, last: number, a: SlotPose, b: SlotPose, slot: Slot, scene: WindScene, length_tolerance: number)
 *         => WindCandidate}
 */
export function arrival_at_root(u, last, a, b, slot, scene, length_tolerance) {
    const root = root_of_excess(u, last, a, b, slot, scene, 0.0);
    const pieces = pieces_with_straight(u, last, root, scene);
    const path = with_turns(pieces, root);
    if (path.time < Infinity) {
        return { phase: slot.phase + root.width, side: slot.side, path };
    }
    const short_ = min_real(TWO_PI - max_real(pieces.t1, pieces.t3), pieces.t2);
    if (short_ * short_ * short_ > EDGE * length_tolerance) {
        return { phase: 0.0, side: slot.side, path: NO_PATH };
    }
    // All poses between these two are roots up to rounding.
    for (const level of [length_tolerance, -length_tolerance]) {
        const end_ = root_of_excess(u, last, a, b, slot, scene, level);
        if (path_with_straight(u, last, end_, scene).time < Infinity) {
            return arrival_at_edge(u, last, end_, root, slot, scene);
        }
    }
    return { phase: 0.0, side: slot.side, path: NO_PATH };
}

/**
 * The first arrival by the word with these outer controls and a straight piece; `NO_PATH` for none by `until`.
 *
 * @type {(u: number, last: number, begin: SlotPose, slot: Slot, scene: WindScene, until_: number) => WindCandidate}
 */
export function first_with_straight(u, last, begin, slot, scene, until_) {
    let pose = begin;
    const none = { phase: 0.0, side: slot.side, path: NO_PATH };
    const length_tolerance = 4.0 * scene.arc_tolerance;
    let excess = excess_at(u, last, pose, slot, scene);
    if (bounds_at(last, pose, slot, scene).speed <= ROUNDING) {
        // The last arc is on the circle itself: the vehicle would have been in the slot before.
        return none;
    }
    if (Math.abs(excess.value) <= length_tolerance && excess.apart >= -length_tolerance) {
        const path = path_with_straight(u, last, pose, scene);
        if (path.time < Infinity) {
            return { phase: slot.phase + pose.width, side: slot.side, path };
        }
    }
    for (let pass_1 = 0; pass_1 < MOST_STEPS; pass_1++) {
        if (pose.time > until_) {
            return none;
        }
        const limits = bounds_at(last, pose, slot, scene);
        const step = step_of_excess(u, last, excess, limits, scene, length_tolerance);
        const ahead = slot_pose(pose.width + step, slot, scene);
        const excess_ahead = excess_at(u, last, ahead, slot, scene);
        /** @type {boolean} */ const exists = excess.apart >= -length_tolerance && excess_ahead.apart >=
                -length_tolerance;
        if (exists && (excess.value >= 0.0 && 0.0 > excess_ahead.value) && excess.value - excess_ahead.value <=
                3.141592653589793 + 1.0) {
            const found = arrival_at_root(u, last, pose, ahead, slot, scene, length_tolerance);
            if (found.path.time < Infinity) {
                return found;
            }
        }
        pose = ahead;
        excess = excess_ahead;
    }
    return { phase: 0.0, side: slot.side, path: until_ === Infinity ? GAVE_UP : NO_PATH };
}

/**
 * The path that takes less time: a where they tie.
 *
 * @type {(a: WindCandidate, b: WindCandidate) => WindCandidate}
 */
export function earlier(a, b) {
    return b.path.time < a.path.time ? b : a;
}

/**
 * The function for LRL (u = +1) or RLR: `half`, plus half the time less the heading's turn, is the middle arc.
 *
 * @type {(u: number, half: number, pose: SlotPose, slot: Slot, scene: WindScene) => Middle}
 */
export function middle_at(u, half, pose, slot, scene) {
    const dx = pose.x - u * (pose.s - scene.s), dy = pose.y + u * (pose.c - scene.c);
    const arc = half + 0.5 * (pose.time + (u * slot.side + 0) * pose.turned);
    const across = sin(0.5 * arc);
    const value = dx * dx + dy * dy - 16.0 * across * across;
    const slope = centre_speed(u, pose, slot) * (2.0 * (dx * pose.c + dy * pose.s) - 4.0 * sin(arc));
    return { value, slope, arc: arc - TWO_PI * Math.floor(arc / TWO_PI), dx, dy };
}

/**
 * The path of LRL or RLR to the slot, with as many whole turns first as the time leaves.
 *
 * @type {(u: number, middle: Middle, pose: SlotPose, scene: WindScene) => Path}
 */
export function path_of_three_arcs(u, middle, pose, scene) {
    let ends = { c0: scene.c, s0: scene.s, c: pose.c, s: pose.s, wx: scene.wx, wy: scene.wy, arc_tolerance:
            scene.arc_tolerance };
    const path = with_turns(three_arcs(u, middle.arc, middle.dx, middle.dy, ends), pose);
    if (path.time < Infinity) {
        return path;
    }
    // An arc may fall short of zero by as much as counts as a root.
    ends = { ...ends, arc_tolerance: THREE_ARCS * scene.arc_tolerance };
    return with_turns(three_arcs(u, middle.arc, middle.dx, middle.dy, ends), pose);
}

/**
 * The first arrival by LRL (u = +1) or RLR; `halves` 0 or 1 chooses between middle arcs half a turn apart.
 *
 * @type {(u: number, halves: number, begin: SlotPose, slot: Slot, scene: WindScene, until_: number) => WindCandidate}
 */
export function first_of_three_arcs(u, halves, begin, slot, scene, until_) {
    const none = { phase: 0.0, side: slot.side, path: NO_PATH };
    if (bounds_at(u, begin, slot, scene).speed <= ROUNDING) {
        return none;
    }
    const origin = slot_pose(0.0, slot, scene);
    let pose = begin;
    const length_tolerance = THREE_ARCS * scene.arc_tolerance;
    const half = 3.141592653589793 * halves - 0.5 * angle(arc_rotation(u, scene.c, scene.s, origin.c, origin.s));
    for (let pass_1 = 0; pass_1 < MOST_STEPS; pass_1++) {
        if (pose.time > until_) {
            return none;
        }
        const middle = middle_at(u, half, pose, slot, scene);
        const distance = length(middle.dx, middle.dy);
        const limits = bounds_at(u, pose, slot, scene);
        let limit = limits.speed > 0.0 ? min_real(limits.step, 1.0 / limits.speed) : limits.step;
        const furthest = distance + limits.speed * limit;
        const bends = bends_of_square(u, furthest, limits, scene), square = 2.0 * limits.speed * limits.speed;
        // To h'' the middle arc adds -2 V^2 cos(m) - 4 V' sin(m). |d|^2 adds 2 V^2 to its own, which `down` leaves out.
        const low = min_real(bends.down + 4.0 * limits.speed_change, bends.size + square);
        const high = min_real(bends.up + square + 4.0 * limits.speed_change, bends.size + square);
        const spread = distance + 4.0 * sin(0.5 * middle.arc);
        let step;
        if (Math.abs(middle.value) <= length_tolerance * (spread + length_tolerance)) {
            const path = path_of_three_arcs(u, middle, pose, scene);
            if (path.time < Infinity) {
                return { phase: slot.phase + pose.width, side: slot.side, path };
            }
            step = max_real(Math.abs(middle.slope) / high, DOUBLE_ROOT);
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

/**
 * The first arrival in a slot, the best of all words.
 *
 * @type {(slot: Slot, scene: WindScene) => WindCandidate}
 */
export function first_arrival(slot, scene) {
    const begin = first_within_reach(slot, scene);
    let best = { phase: slot.phase, side: slot.side, path: NO_PATH };
    // LSL or RSR that ends against the hold exists at all times and arrives within a turn or so; next to R = 1 others
    // may take forever.
    for (const last of [slot.side, 0 - slot.side]) {
        for (const u of [last, 0 - last]) {
            best = earlier(best, first_with_straight(u, last, begin, slot, scene, best.path.time));
        }
    }
    for (const u of [1, -1]) {
        for (const halves of [0, 1]) {
            best = earlier(best, first_of_three_arcs(u, halves, begin, slot, scene, best.path.time));
        }
    }
    return best;
}

/**
 * An arrival as the maneuver flown, with its status.
 *
 * @type {(found: WindCandidate, scene: WindScene) => WindEntry}
 */
export function arrival_of(found, scene) {
    const path = found.path, side = found.side;
    const drop_short_pieces_1 = drop_short_pieces(path.word, path.t1, path.t2, path.t3, rounding(scene.x, scene.y,
            scene.R), ROUNDING);
    const word = drop_short_pieces_1[0], t1 = drop_short_pieces_1[1], t2 = drop_short_pieces_1[2], t3 =
            drop_short_pieces_1[3];
    const entry = { side, word, t1, t2, t3 };
    const miss = end_miss(entry, found.phase, scene);
    return entry_at(entry, found.phase, miss, scene);
}

/**
 * The first arrival in the slot that is at a phase at the time 0; nan, with a status, where there is none.
 *
 * The side of the problem must be 1 or -1. The slot is entered exactly.
 *
 * @type {(problem: WindProblem, phase: number) => WindEntry}
 */
export function first_in_slot(problem, phase) {
    const status = wind_search_status_of(problem);
    if (status !== Status.OK) {
        return no_entry(status);
    }
    const scene = scene_of(problem), slot = { side: problem.side, phase };
    const nothing = { side: slot.side, word: 0, t1: 0.0, t2: 0.0, t3: 0.0 };
    const miss = end_miss(nothing, phase, scene);
    if (miss <= 3.0 * scene.arc_tolerance) {
        return entry_at(nothing, phase, miss, scene);
    }
    const found = first_arrival(slot, scene);
    if (Math.abs(found.path.time) === Infinity) {
        return no_entry(code(Status.NOT_CONVERGED));
    }
    return arrival_of(found, scene);
}

/**
 * The first path of a set of words to a pose at rest over the ground, passed in the direction `track`, radians.
 *
 * (x, y) is the start from the pose, and (c, s) its heading.
 *
 * @type {(words: number, x: number, y: number, c: number, s: number, track: number, wx: number, wy: number) => Path}
 */
export function path_to_pose(words, x, y, c, s, track, wx, wy) {
    // The pose as a point of a circle of radius 1 on its left, passed counter-clockwise.
    const nx = sin(track), ny = -cos(track);
    const scene = { x: x + nx, y: y + ny, c, s, R: 1.0, wx, wy, arc_tolerance: rounding(x + nx, y + ny, 1.0) / 3.0
            };
    return first_path_of(words, phase_of(nx, ny, -1, wx, wy), -1, scene, Infinity);
}
