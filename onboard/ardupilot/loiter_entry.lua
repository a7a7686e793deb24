-- The fastest entry onto a holding circle, for ArduPlane.
--
-- Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
--
-- SHA-256 of the source: fb894c07a653822004c5909eef3bd5643fc58674b6531312754b9716a2051ae8
--
-- When a switch asks for it, this script flies a plane onto the holding circle around its present target in least
-- time, and then leaves the circle to ArduPlane: loiter_entry.md. It works by GUIDED_CHANGE_HEADING in GUIDED: the target
-- heading is 90 degrees ahead, so that the limit of lateral acceleration is what is flown.

-- luacheck: ignore 581 ("not (x < y)" holds for nan, and "x >= y" does not)

local SEVERITY = {CRITICAL = 2, WARNING = 4, NOTICE = 5}
local GUIDED, DO_REPOSITION, GUIDED_CHANGE_HEADING, ACCEPTED = 15, 192, 43002, 0
local FRAME_GLOBAL, ABSOLUTE = 0, 0
local GRAVITY = 9.80665

-- The time between two steps, and between the callbacks for searches that follow a step where they are due, milliseconds.
local PERIOD_MS, SEARCH_MS = 50, 10

-- In wind the point of joining is improved in all of these callbacks until there have been so many, later in one.
local MANY_SEARCHES = 60

-- What GUIDED_CHANGE_HEADING does with a bank: a delay, seconds, then a quick response with a limited rate of roll.
local DELAY_S, ROLL_TIME_S, ROLL_RATE_DEG_S = 0.2, 0.1, 90.0

-- The delay is measured in whole steps, up to this many. The squares of the errors of the bank, each at most the second
-- number, are forgotten over the third, seconds; the declared delay counts as this much of them for each second squared
-- by which another one is off.
local MOST_STEPS, LARGEST_ERROR_DEG2, DELAY_MEMORY_S, DELAY_WEIGHT = 10, 100.0, 20.0, 2000.0

-- The first roll of a flight shows the delay where the bank has stayed within this many degrees for so many steps before.
local STEADY_DEG = 5.0

-- Until there is a plan the bank of the beginning is kept, for so many milliseconds at most.
local FIRST_PLAN_MS = 500

-- The largest bank ever commanded, and how far below the limit of the autopilot it stays, degrees.
local LARGEST_BANK_DEG, BELOW_LIMIT_DEG = 60.0, 0.5

-- A flight ends where the altitude is off by this much more than at its beginning, metres; where the bank differs from
-- the command by this many degrees, or the pilot moves the stick of roll or pitch by this share, for as many
-- milliseconds.
local ALTITUDE_OFF_M, BANK_OFF_DEG, BANK_OFF_MS, STICK, STICK_MS = 25.0, 25.0, 3000, 0.5, 300

-- The circle is held once the plane has been within this share of the radius and this many degrees of the tangent for
-- so many milliseconds and degrees of the circle. A flight takes this many milliseconds at most.
local BAND, BAND_DEG, HELD_MS, HELD_DEG, LONGEST_MS = 0.05, 5.0, 8000, 90.0, 300000

-- A wind that changes by more than this, metres per second, is planned with.
local WIND_CHANGED_M_S = 1.0

-- The airspeed is averaged over this time, seconds, before a flight. One that differs from the planned one by more than
-- this share is planned with.
local AIRSPEED_S, AIRSPEED_CHANGED = 3.0, 0.03

-- How the plane turns is measured so often, seconds; measurements further apart are not related to each other.
local LEARN_S, RELATED_S = 0.1, 1.0

-- Turn ratios that differ by this much, or less, are planned with alike before a flight.
local RATIO_CHANGED = 0.02

local PARAM_TABLE_KEY = 141
assert(param:add_table(PARAM_TABLE_KEY, "LENT_", 6), "loiter_entry: no room for parameters")

-- A parameter of this script.
local function own_parameter(number, name, default)
    assert(param:add_param(PARAM_TABLE_KEY, number, name, default), "loiter_entry: no parameter " .. name)
    return Parameter("LENT_" .. name)
end

--[[
  // @Param: LENT_ENABLE
  // @DisplayName: Fastest entry: enable
  // @Description: Whether the switch begins an entry. Change it to 0 to have an entry end at once
  // @Values: 0:Disabled,1:Enabled
  // @User: Standard
--]]
local ENABLE = own_parameter(1, "ENABLE", 1)

--[[
  // @Param: LENT_FUNC
  // @DisplayName: Fastest entry: function of the switch
  // @Description: RCx_OPTION of the switch that begins an entry when it is moved to its high position, and ends it otherwise
  // @Values: 300:Scripting1,301:Scripting2,302:Scripting3,303:Scripting4,304:Scripting5,305:Scripting6,306:Scripting7,307:Scripting8
  // @User: Standard
--]]
local FUNC = own_parameter(2, "FUNC", 300)

--[[
  // @Param: LENT_RADIUS
  // @DisplayName: Fastest entry: radius of the circle
  // @Description: Radius of the circle. With 0 it is that of WP_LOITER_RAD
  // @Units: m
  // @Range: 0 2000
  // @User: Standard
--]]
local RADIUS = own_parameter(3, "RADIUS", 0)

--[[
  // @Param: LENT_SIDE
  // @DisplayName: Fastest entry: direction of the circle
  // @Description: Direction in which the circle is flown, seen from above. With 0 it is the one that is faster
  // @Values: -1:CounterClockwise,0:Either,1:Clockwise
  // @User: Standard
--]]
local SIDE = own_parameter(4, "SIDE", 0)

--[[
  // @Param: LENT_BANK
  // @DisplayName: Fastest entry: largest bank
  // @Description: Largest bank of the entry. With 0 it is half a degree less than ROLL_LIMIT_DEG. It is never more than that, nor than 60 degrees
  // @Units: deg
  // @Range: 0 60
  // @User: Standard
--]]
local BANK = own_parameter(5, "BANK", 0)

--[[
  // @Param: LENT_BEAT
  // @DisplayName: Fastest entry: sign of life
  // @Description: Changes twenty times a second while an entry is flown, and is 0 otherwise: for loiter_watchdog.lua. It is positive where the circle is flown clockwise. Not to be set by a user
  // @User: Advanced
  // @ReadOnly: True
--]]
local BEAT = own_parameter(6, "BEAT", 0)

local law = {}

-- What the law searches with in wind.
local begin_in_wind, advance_in_wind

-- The guidance law.
do
local abs, acos, atan, ceil, cos, exp = math.abs, math.acos, math.atan, math.ceil, math.cos, math.exp
local fmod, log, max, min, sin, sqrt = math.fmod, math.log, math.max, math.min, math.sin, math.sqrt
local tan, huge, unpack = math.tan, math.huge, table.unpack

-- The least integer that is no smaller; nan and what is too large become the largest or the least.
local function integer_of(a)
    return a >= 2147483647.0 and 2147483647 or a > -2147483647.0 and ceil(a) or -2147483647
end

-- A ring of equal elements.
local function filled(one, length)
    local ring = {}
    for i = 1, length do
        ring[i] = one
    end
    return ring
end

-- A table with other values of some fields.
local function with_fields(one, values)
    local copy = {}
    for name, value in pairs(one) do
        copy[name] = value
    end
    for name, value in pairs(values) do
        copy[name] = value
    end
    return copy
end

-- A ring with another last element.
local function with_last(ring, last)
    local changed = {unpack(ring)}
    changed[#ring] = last
    return changed
end

-- A ring with another last element, and without its first one.
local function appended(ring, last)
    local changed = {unpack(ring, 2, #ring + 1)}
    changed[#ring] = last
    return changed
end
law.FIRST_CLOCK = {time_s = -huge, since_s = 0.0, gap_s = huge, jump_s = 0.0, first_s = (0.0 / 0.0), latest_s = (0.0 / 0.0)}

-- What is assumed until then, as if it had been measured for the last time, seconds: gusts of about 10 % of the
-- airspeed, as the mean square change of each component in a second, and noise of 0.4 m/s; (m/s)^2.
-- FIRST_NOISE = 0.16

-- How fast the velocity of the air changes is measured from its differences over this time, seconds, averaged over
-- the second time.
-- GUST_LAG_S = 1.0
-- FIRST_GUST = 0.6
-- ASSUMED_S = 1.0
law.CALM_ALONG = {near_square = 0.0, far_square = 0.0, known_s = 3.0}

-- The ring of the last measurements. Where it would not cover the lag, those that follow each other sooner than
-- this, seconds, are left out.
-- SAMPLES = 64
law.NO_ESTIMATE = {time_s = -huge, pose = {x = 0.0, y = 0.0, c = 1.0, s = 0.0}, airspeed_m_s = 0.0, turn_rate = 0.0, bank_deg = 0.0, air_east_m_s = 0.0, air_north_m_s = 0.0, turning = {ratio = 1.0, lead_s = 0.0}}
law.NO_LIMITS = {revision = -1, wind_differs = false, wind_east_m_s = 0.0, wind_north_m_s = 0.0, roll = {time_s = 0.0, rate_deg_s = 0.0, lag_s = 0.0, slew_deg_s = 0.0}, limit_deg = 0.0, turns = {airspeed_m_s = 1.0, tightest_m = 1.0, planned_m = 1.0}, hold_deg = 0.0, hold_half_deg = 0, planned_half_deg = 0, lead_s = 0.0, reversal_s2 = 0.0, reversal_m = 0.0, lag_s = 0.0}

-- The wind is planned as estimated, not as declared, where they differ by the first share of the airspeed, until
-- they differ by less than the second.
-- WIND_KEPT = 0.05
-- WIND_DIFFERS = 0.1

-- An aircraft that hardly exceeds the wind can hold no circle; wind beyond this share of the airspeed is planned as
-- if it were weaker.
-- STRONGEST_WIND = 0.95

-- Where the bank overshoots its limit, less than that is commanded, but at least this multiple of the circle's
-- bank.
-- LEAST_LIMIT = 1.2
-- STANDARD_GRAVITY_M_S2 = 9.80665

-- The delays of changes of bank are computed again when the time constant or the rate of the roll changes by this
-- share.
-- ROLL_CHANGED = 0.01

-- The commanded change of bank is this many times the change that is wanted, where the limits leave room, but no
-- more than makes the time constant this, seconds: a roll that is quick gains nothing, and errors would be
-- amplified.
-- QUICKEST_S = 0.15
-- COMMAND_GAIN = 2.5

-- The damping of a bank whose rate has a lag, under these commands.
-- DAMPING = 0.8

-- A smaller change of bank, degrees, takes effect like an infinitely small one where neither it nor its rate is
-- limited.
-- SMALL_CHANGE_DEG = 5.0

-- Gauss-Legendre points and weights on [0, 1], and Gauss-Laguerre points x, exp(-x) and weights.
law.LEGENDRE_POINTS = {0.1127016653792583, 0.5, 0.8872983346207417}
law.LEGENDRE_WEIGHTS = {0.2777777777777778, 0.4444444444444444, 0.2777777777777778}
law.LAGUERRE_POINTS = {0.4157745567834791, 2.294280360279042, 6.2899450829374794}
law.LAGUERRE_SHARES = {0.6598290076917097, 0.10083393126672065, 0.0018548618076203868}
law.LAGUERRE_WEIGHTS = {0.711093009929173, 0.27851773356924087, 0.010389256501586137}

-- The largest number of steps in which a change of a bank whose rate has a lag is flown.
-- STEPS = 24

-- These last for the change at the limit of the roll rate, and for so many time constants more.
-- SETTLING = 1.5

-- For fewer lags of the bank rate its effect is a series, of which the first term that is left out is 1.4e-6 here.
-- SHORT_LAGS = 0.1

-- The reserve grows by this share for each radian that the aircraft could turn during the delay of its roll: the
-- slower the roll, the farther an error of its estimate takes the aircraft off the last arc.
-- ROLL_RESERVE = 0.8

-- The gain of course corrections is reduced by this share of the delay: a part of it is not predicted exactly.
-- DELAY_SHARE = 1.0
law.NO_PLAN = {route = {side = 0, current = {u = -2, x = 0.0, y = 0.0, c = 1.0, s = 0.0, end_x = 0.0, end_y = 0.0, time_s = 0.0, radius_m = 1.0}, second = {u = -2, x = 0.0, y = 0.0, c = 1.0, s = 0.0, end_x = 0.0, end_y = 0.0, time_s = 0.0, radius_m = 1.0}, third = {u = -2, x = 0.0, y = 0.0, c = 1.0, s = 0.0, end_x = 0.0, end_y = 0.0, time_s = 0.0, radius_m = 1.0}, more_s = 0.0, last_u = -2, start_s = 0.0, turn_radius_m = 1.0, speed_m_s = 1.0, wind_east_m_s = 0.0, wind_north_m_s = 0.0}, remaining_s = 0.0, join_s = huge, planned_join_s = huge, searched_s = -huge}

-- The control of a piece that the word does not have.
-- ABSENT = -2
law.NO_LEADS = {bank = -1000000000, rate = 0, command = 0, current = 0, next = 0, last = 0, current_s = 0.0, more = 0.0, next_s = 0.0, last_s = 0.0, displaced_s2 = 0.0}
law.NO_RESPONSE = {state = {time_s = 0.0, x = 0.0, y = 0.0, vx = 0.0, vy = 0.0, hx = 0.0, hy = 0.0}, offset = {crosstrack = 0.0, course_error = 0.0, path_rate = 0.0}, early_s = 0.0}
law.NO_ENTRY_SEARCH = {aim = 0, state = {time_s = 0.0, x = 0.0, y = 0.0, vx = 0.0, vy = 0.0, hx = 0.0, hy = 0.0}, turns = {airspeed_m_s = 1.0, tightest_m = 1.0, planned_m = 1.0}, wind_east_m_s = 0.0, wind_north_m_s = 0.0, radius_m = 1.0, wide_m = 1.0, side = 0, reversing = false, is_second = false, is_begun = false, in_air = {stage = 0, sides = 0, side = 1, scene = {x = 0.0, y = 0.0, c = 1.0, s = 0.0, R = 1.0, wx = 0.0, wy = 0.0, arc_tolerance = 0.0}, best = {phase = 0.0, side = 0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}}, beside = {entry = {side = 0, word = 0, t1 = huge, t2 = 0.0, t3 = 0.0}, phase = 0.0, miss = huge}, visit = {number = 0, level = 0, words = 63}, before = {number = -2, point = {phase = 0.0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}, slope = 0.0}}, leaves = {first = 0, second = 0, third = 0, fourth = 0}, others = {first = 0, second = 0, third = 0, fourth = 0}, corner = {phase = 0.0, u = 0, t1 = 0.0, t2 = 0.0}, compared = huge, visits = 0, refinement = {stage = 0, side = 0, width = 0.0, here = {phase = 0.0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}, slope = 0.0}, other = {phase = 0.0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}, slope = 0.0}, last = {phase = 0.0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}, slope = 0.0}, words = 0, bisect = false, steps = 0, enclosures = 0}, cell = {words = 0, earliest = 0.0, tolerance = 0.0}, left = 0, entry = {status = 12, side = 0, word = 0, t1 = (0.0 / 0.0), t2 = (0.0 / 0.0), t3 = (0.0 / 0.0), azimuth = (0.0 / 0.0), miss = (0.0 / 0.0)}}}

-- What a command does: the control that it flies, +1 to the left; or one of these.
-- NO_DATA = 3

-- The history covers at least this time, seconds, in this many entries.
-- ENTRIES = 128

-- The largest plausible time stamp, seconds: 32,000 years, where a double still resolves a tenth of a millisecond.
-- LATEST_S = 1000000000000.0

-- Bounds of a plausible measurement: the largest value in metres, degrees or metres per second, the least airspeed.
-- LARGEST_VALUE = 1000000000.0
-- LEAST_AIRSPEED_M_S = 0.1

-- Until the next measurement arrives the last one is extrapolated, but no longer than this, seconds; older ones are
-- not averaged with new ones.
-- EXTRAPOLATED_S = 3.0

-- A turn through a smaller angle, radians, is flown as a straight line: the difference is below the rounding error.
-- SMALLEST_TURN = 2.9802322387695312e-08 -- 2.0 ** (-54)

-- A stamp is accepted at once unless it is later by more than this, seconds, than the last one plus the time that
-- has passed since. So a law that was not called for an hour continues at once.
-- LARGEST_GAP_S = 3600.0

-- A clock that has jumped back, or further ahead, is accepted once its stamps have advanced by this, seconds. No
-- single step between them may be larger: two stamps alone do not confirm a clock.
-- CONFIRMATION_S = 1.0

-- In calm air, where gusts turn the course by less than `CALM_COURSE` in a second, radians, only noise is left:
-- averages take longer, up to this multiple. They have at least this many measurements; of their mean interval each
-- is this share, and a longer one, seconds, counts as that.
-- INTERVAL_SHARE = 0.05
-- LONGEST_INTERVAL_S = 0.3
-- CALM_COURSE = 0.02
-- CALM_MULTIPLE = 1.6
-- LEAST_COUNT = 5.0
-- GUST_AVERAGE_S = 10.0

-- On the circle gusts are measured anew, as if none had been measured for the first time, seconds. Differences over
-- which the turn rate changes by the second, radians per second, count half: the slip changes with it, like a gust.
-- TURN_CHANGE = 0.1
-- SAMPLE_GAP_S = 0.016129032258064516 -- GUST_LAG_S / (SAMPLES - 2)

-- The aim of no search.
-- NOTHING = 0

-- The least speed along the heading, as a share of the airspeed, from which a course is taken: below it the
-- measured velocity is not that of an aircraft in flight.
-- LEAST_SPEED = 0.05
law.NO_PIECE = {u = -2, x = 0.0, y = 0.0, c = 1.0, s = 0.0, end_x = 0.0, end_y = 0.0, time_s = 0.0, radius_m = 1.0}

-- A flight that begins on the circle, within half of the reserve and this angle, radians, holds it at once.
-- ON_COURSE = 0.09

-- The interval between searches for another plan, seconds.
-- SEARCH_INTERVAL_S = 0.1

-- A piece with less than this left, seconds, is complete but for rounding.
-- ROUNDING_S = 0.000131072 -- 1e-09

-- What a search is for: the first turn of the first plan, as it would be with wings level; any plan; a plan that is
-- better than the present one; or one that is better or is the present one from the present state. `NOTHING` is
-- none.
-- FIRST_TURN = 1

-- Rates of the bank count in steps of so many half degrees per second.
-- RATE_STEPS = 4.0

-- Added to inner products, so that a zero vector gives the rotation by zero. It is negligible for vectors longer
-- than 1e-37, and a product of three of them does not underflow.
-- TINY = 1.4551915228366852e-11 -- 2.0 ** (-300)
-- TWO_PI = 6.283185307179586 -- 2.0 * pi

-- Gusts are heavy where they change the course by this angle in a second, radians.
-- HEAVY_GUSTS = 0.04

-- The last turn, where it is opposite to the circle, is aimed again from the present state as long as so much of
-- the present piece is left, seconds, the turn is no wider than this multiple of a planned one, and the time to
-- join changes by no more than the third number, seconds.
-- WIDEST_AIMED = 8.0

-- Beyond this crosstrack error, turn radii, or course error, radians, the aircraft is lost: any new plan is
-- accepted.
-- LOST_OFFSET = 0.5
-- AIMED_LEFT_S = 0.2
-- AIM_CHANGE_S = 1.0
-- LOST_COURSE = 1.0
-- ANY = 2

-- In wind a new plan counts as the same one if it differs only by a first turn back to the path that is no longer
-- than `LONGEST_BEND`, turn radii. It is not adopted before the crosstrack error or the change of the time to join
-- exceeds `DEVIATION`, turn radii: each adds such a turn.
-- DEVIATION = 0.1
-- UPDATE = 4
-- BETTER = 3

-- Rounding error of a length of order one: the reduction (2) costs 2 roundings a coordinate, a difference of
-- squares 6, the angle and the flight of each of three pieces about 10; 64 units of 2**-52 is the next power of two
-- above the sum.
-- ROUNDING = 7.62939453125e-06 -- 64.0 * 2.0 ** (-52)

-- Dekker's splitting factor, 2^27 + 1, halves the 53 digits of a double.
-- SPLITTER = 4097.0 -- 134217729.0

-- A rotation multiplied by less could have subnormal components, which have lost digits. Below this distance the
-- rounding error of c - end x itself is negligible.
-- SMALLEST_SCALE = 1.4551915228366852e-11 -- 2.0 ** (-300)
law.NO_ROTATION = {0.0, 1.0}
law.NO_SEARCH = {stage = 0, sides = 0, side = 1, scene = {x = 0.0, y = 0.0, c = 1.0, s = 0.0, R = 1.0, wx = 0.0, wy = 0.0, arc_tolerance = 0.0}, best = {phase = 0.0, side = 0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}}, beside = {entry = {side = 0, word = 0, t1 = huge, t2 = 0.0, t3 = 0.0}, phase = 0.0, miss = huge}, visit = {number = 0, level = 0, words = 63}, before = {number = -2, point = {phase = 0.0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}, slope = 0.0}}, leaves = {first = 0, second = 0, third = 0, fourth = 0}, others = {first = 0, second = 0, third = 0, fourth = 0}, corner = {phase = 0.0, u = 0, t1 = 0.0, t2 = 0.0}, compared = huge, visits = 0, refinement = {stage = 0, side = 0, width = 0.0, here = {phase = 0.0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}, slope = 0.0}, other = {phase = 0.0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}, slope = 0.0}, last = {phase = 0.0, path = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}, slope = 0.0}, words = 0, bisect = false, steps = 0, enclosures = 0}, cell = {words = 0, earliest = 0.0, tolerance = 0.0}, left = 0, entry = {status = 12, side = 0, word = 0, t1 = (0.0 / 0.0), t2 = (0.0 / 0.0), t3 = (0.0 / 0.0), azimuth = (0.0 / 0.0), miss = (0.0 / 0.0)}}

-- The stages of a search: on each side, first some points, then cells down to the leaves, then the leaves that are
-- left.
-- ENDED = 5

-- The answer of the kernel where there is no entry.
law.NONE = {side = 0, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0}
-- LONGEST_BEND = 0.1

-- Margins, turn radii over airspeed. A different plan replaces the present one if it is faster by the first margin,
-- the same plan, made again from the present state, if it is slower by no more than the second. Sensor noise
-- changes the least time by less than these margins, except where that time jumps; there the present plan is the
-- fastest.
-- UPDATE_MARGIN = 0.25
-- SWITCH_MARGIN = 0.25

-- Without a usable measurement the last command is kept for this time, seconds.
-- BLIND_S = 1.0

-- On the circle it falls so far that course errors are corrected at this rate, 1/s, or at this multiple of that at
-- which crosstrack errors are, but not below the last share. It rises with the square of the gusts, to the whole
-- where they change the course by `ROUGH_HOLD` in a second. A vehicle that turns more quickly than its bank says
-- where that changes would swing about the circle otherwise.
-- HOLD_RATE = 1.3
-- HOLD_MULTIPLE = 6.0

-- On the circle crosstrack errors are corrected over an arc of 1/HOLD_GAIN radians, so that the intercept angle
-- depends only on the ratio of the error to the radius.
-- HOLD_GAIN = 1.2

-- In calm air the gain of course corrections falls to this share: only noise would be corrected. The air is rough
-- where gusts change the course by this angle in a second, radians (root mean square).
-- CALM_GAIN = 0.75
-- CALM_HOLD_GAIN = 0.35
-- ROUGH_HOLD = 0.02
-- ROUGH_AIR = 0.02

-- In heavy gusts it rises in proportion to them, up to this multiple.
-- HEAVY_GAIN = 1.5

-- The gains of course and crosstrack corrections, to be divided by the response time: the delay of a change of bank
-- plus the averaging time. A faster correction of crosstrack errors would need an intercept angle of several
-- degrees.
-- PLACE_GAIN = 0.25

-- There the part of a crosstrack error beyond this, radii, counts twice in calm air, so that the aircraft returns
-- more steeply; in rough air, as for `ROUGH_HOLD`, it counts once.
-- STEEP_OFFSET = 0.035

-- The steepest intercept angle onto a path, radians: a vehicle far off turns towards the path, not all the way
-- round.
-- STEEPEST_INTERCEPT = 0.6

-- On the circle the mean crosstrack error is driven to zero by a correction of the rate of turn: at this share of
-- the gain of course corrections, but no more than the second number, 1/s, which suits gusts. It is at most the
-- third share of the circle's rate of turn, and changes only while the error is less than the fourth, in radii.
-- TRIMMED_OFFSET = 0.05
-- TRIM_GAIN = 0.25
-- LARGEST_TRIM_GAIN = 0.4
-- LARGEST_TRIM = 0.15
-- HOLD = 2
law.NO_TURNS = {xx = 0.0, xu = 0.0, uu = 0.0, xy = 0.0, uy = 0.0}
law.NO_PAIRS = {product = 0.0, square = 0.0}
law.NO_VALUE = {value = 0.0, last = (0.0 / 0.0)}

-- Turn ratio and bank bias are fitted to angles that are high-pass filtered and forgotten over these times,
-- seconds.
-- TURN_FILTER_S = 3.0
-- TURN_MEMORY_S = 60.0

-- What is expected of them counts as if it had been measured with these standard deviations, from headings with
-- errors of the third, degrees, that are correlated over the filter time. The bias stays within the last, degrees.
-- TURN_ERROR_DEG = 0.7
-- TURN_RATIO_SPREAD = 0.15
-- BANK_BIAS_SPREAD_DEG = 1.5

-- The bounds of ratios of turns.
-- LEAST_TURN_RATIO = 0.6
-- LARGEST_TURN_RATIO = 3.0
-- LARGEST_BANK_BIAS_DEG = 6.0

-- The ratio of quick turns is fitted to angles that are high-pass filtered over the first time, seconds. From these
-- their means over the second time are subtracted, which a steady turn leaves. They are forgotten over the third.
-- QUICK_FILTER_S = 0.3
-- QUICK_MEAN_S = 0.5

-- The declared ratio counts as if it had been measured with this standard deviation, from angles with errors of the
-- second, degrees, that are correlated over the filter time. A larger angle than the third, degrees, counts no more
-- than that: otherwise one large turn would outweigh many small oscillations.
-- QUICK_SATURATION_DEG = 0.5
-- QUICK_MEMORY_S = 6.0
-- QUICK_ERROR_DEG = 0.5
-- QUICK_RATIO_SPREAD = 0.5

-- The lead of the course is fitted to signals that are high-pass filtered over this time, and forgotten over the
-- second. A lead of 0 counts as if it had been measured with the third, from directions with errors of the fourth,
-- radians, that are correlated over a second. It stays within the last.
-- LEAD_FILTER_S = 1.5
-- LEAD_MEMORY_S = 30.0
-- DIRECTION_ERROR = 0.03
-- LEAD_SPREAD_S = 0.1
-- LARGEST_LEAD_S = 0.4

-- The same for the airspeed in turns with more than this share of the bank limit.
-- TIGHT_SHARE = 0.7

-- The airspeed is averaged over the first time, seconds, at most; the declared one counts for the second.
-- AIRSPEED_MEMORY_S = 20.0

-- A slower wind displaces no point within REACH by as much as rounding, and its square would be subnormal.
-- NEGLIGIBLE_WIND = 1.7763568394002505e-15 -- 2.0 ** (-400)
law.NO_PATH = {time = huge, word = 0, t1 = 0.0, t2 = 0.0, t3 = 0.0, lam = 1.0, p1 = 1.0, p2 = 0.0}

-- An arc that comes this close to a whole turn, or to zero, may pass it.
-- ALMOST = 0.0008127493386077178 -- 1e-06

-- Here Newton's method approaches every root from the side on which it converges monotonically. Each step squares
-- the error, or halves it near a double root; 60 halvings are more than the digits of a double.
-- NEWTON_STEPS = 60

-- The next step of Newton's method for LSR or RSL is left out where it would be less than the time times this over
-- 2 (1 - |w|).
-- NO_STEP = 1.862645149230957e-09 -- 2.0 ** (-58)

-- How far beside the point of joining the next one is tried, radians: at first, and at least. The time is a
-- quadratic function there: half of the least distance costs some 1e-5 turn radii over the airspeed.
-- LEAST_SHIFT = 0.01

-- Points anywhere are these shares of the circle apart, the golden ratio: no others are spread as evenly at any
-- number of points. They begin anew after so many.
-- GOLDEN = 0.6180339887498949

-- Sets of the six words of three pieces, a bit for each: all, and those with a straight piece.
-- ALL_WORDS = 63
-- FIRST_SHIFT = 0.2
-- ROUND = 1024

-- Words that end with L or with R, as sets.
-- ENDS_WITH_L = 25 -- set_of(Word.LSL) | set_of(Word.RSL) | set_of(Word.LRL)
-- ENDS_WITH_R = 38 -- set_of(Word.RSR) | set_of(Word.LSR) | set_of(Word.RLR)

-- The average before the first measurement.
function law.first_air()
    local near = {time_s = 0.02, square = 2.0 * 0.16--[[FIRST_NOISE]]}
    local far = {time_s = 1.0--[[GUST_LAG_S]], square = 2.0 * 0.16--[[FIRST_NOISE]] + 0.6--[[FIRST_GUST]] *
            1.0--[[GUST_LAG_S]]}
    local recent = filled({time_s = 0.0, east_m_s = 0.0, north_m_s = 0.0, turn_rate = 0.0}, 64)
    return {east_m_s = 0.0, north_m_s = 0.0, known_s = 1.0--[[ASSUMED_S]], near = near, far = far, along =
            law.CALM_ALONG, recent = recent, lag_index = 64--[[SAMPLES]] - 2}
end

-- The observer before the first measurement.
function law.first_observer(smoothing_s)
    return {smoothing_s = smoothing_s, interval_s = 0.0, air = law.first_air(), estimate = law.NO_ESTIMATE}
end

-- The history of a bank that has always been this.
function law.constant_history(bank_deg)
    local unused = filled({end_s = -huge, bank_deg = bank_deg, integral = 0.0}, 128)
    return {entries = with_last(unused, {end_s = 0.0, bank_deg = bank_deg, integral = 0.0})}
end

-- What is known before the first measurement, at a bank.
function law.first_sensing(smoothing_s, bank_deg)
    return {clock = law.FIRST_CLOCK, observer = law.first_observer(smoothing_s), history =
            law.constant_history(bank_deg), command_deg = bank_deg, present = law.NO_ESTIMATE, bank_rate_deg_s =
            0.0, elapsed_s = 0.0, model_error_deg = 0.0, is_known = false}
end

-- The length of a vector whose square neither overflows nor underflows.
--
-- Unlike `math.hypot`, whose algorithm is Python's own, compiled code gives the same value to the last bit.
function law.length(x, y)
    return sqrt(x * x + y * y)
end

-- The velocity of the air past the circle to plan with, and whether it differs from the declared one.
--
-- It is the declared one, unless the wind is found to differ from that by more than gusts do.
function law.planned_wind(settings, known, differed)
    local east, north, V = settings.wind_east_m_s, settings.wind_north_m_s, known.airspeed_m_s
    local share = law.length(known.wind_east_m_s - east, known.wind_north_m_s - north) / V
    local differs = share > (differed and 0.05--[[WIND_KEPT]] or 0.1--[[WIND_DIFFERS]])
    if differs then
        east = known.wind_east_m_s
        north = known.wind_north_m_s
    end
    east = east - settings.velocity_east_m_s
    north = north - settings.velocity_north_m_s
    if law.length(east, north) < settings.negligible_wind * V then
        return differs, 0.0, 0.0
    end
    return differs, east, north
end

-- The least R of a circle that can be held all round: the rate of turn is largest downwind, (1 + |w|)^2 / R.
function law.tightest_radius(wx, wy)
    local fastest = 1.0 + law.length(wx, wy)
    return fastest * fastest
end

-- The widest turn radius with which a circle can be held in a wind that moves past it.
function law.widest_turn_m(airspeed_m_s, radius_m, east_m_s, north_m_s)
    if east_m_s == 0.0 and north_m_s == 0.0 then
        return radius_m
    end
    local strength = law.length(east_m_s, north_m_s) / airspeed_m_s
    local scale = min(1.0, 0.95--[[STRONGEST_WIND]] / strength) / airspeed_m_s
    return radius_m / law.tightest_radius(scale * east_m_s, scale * north_m_s)
end

-- Bank of a coordinated turn, degrees, from its rate in radians per second: the inverse of `rate_at_bank`.
function law.bank_at_rate(rate, airspeed_m_s)
    return atan(rate * airspeed_m_s / 9.80665--[[STANDARD_GRAVITY_M_S2]]) * 57.29577951308232
end

-- The bank at which the vehicle turns at a rate, radians per second; degrees with the sign of the rate.
function law.bank_for(known, rate)
    return law.bank_at_rate(rate / known.turn_ratio, known.airspeed_m_s)
end

-- The bank limit, lowered by what the bank overshoots it, but not below what turns of `widest_m` need.
function law.present_limit_deg(settings, known, widest_m)
    local declared_deg = settings.limit_deg
    if known.overshoot_deg == 0.0 then
        return declared_deg
    end
    local least_deg = 1.2--[[LEAST_LIMIT]] * law.bank_for(known, known.airspeed_m_s / widest_m)
    return max(declared_deg - known.overshoot_deg, min(least_deg, declared_deg))
end

-- Whether a roll response differs so much that delays of changes of bank must be computed again.
function law.is_changed(roll, before)
    local time_s, lag_s = before.time_s, before.lag_s
    return abs(roll.time_s - time_s) > 0.01--[[ROLL_CHANGED]] * time_s or abs(roll.rate_deg_s - before.rate_deg_s) >
            0.01--[[ROLL_CHANGED]] * before.rate_deg_s or abs(roll.lag_s - lag_s) > 0.01--[[ROLL_CHANGED]] * time_s
end

-- Radius of a coordinated turn, metres: V^2 / (g tan bank).
function law.radius_at_bank(airspeed_m_s, bank_deg)
    return airspeed_m_s * airspeed_m_s / (9.80665--[[STANDARD_GRAVITY_M_S2]] * tan(bank_deg * 0.017453292519943295))
end

-- A bank in whole half degrees.
function law.half_degrees(bank_deg)
    return integer_of(2.0 * bank_deg - 0.5)
end

-- How many times the change of bank that is wanted is commanded.
--
-- With more than the last number the command would have to return to the target faster than its slew rate.
function law.command_gain(roll)
    return min(max(roll.time_s / 0.15--[[QUICKEST_S]], 1.0), 2.5--[[COMMAND_GAIN]], 1.0 + roll.slew_deg_s /
            roll.rate_deg_s)
end

-- By how much less is commanded for each degree per second of the bank rate, seconds.
--
-- With the gain K the bank then obeys tau lag bank'' + (tau + this) bank' + K (bank - target) = 0, with the damping
-- `DAMPING` at least. It is 0 without a lag.
function law.rate_gain_s(roll)
    return max(2.0 * 0.8--[[DAMPING]] * sqrt(law.command_gain(roll) * roll.time_s * roll.lag_s) - roll.time_s, 0.0)
end

-- When a small change of bank takes effect.
function law.small_onset(roll)
    local gain = law.command_gain(roll)
    local first_s = (roll.time_s + law.rate_gain_s(roll)) / gain
    return {lead_s = first_s, variance_s2 = max(first_s * first_s - 2.0 * roll.time_s * roll.lag_s / gain, 0.0)}
end

-- `turn_delay` without a lag of the bank rate.
--
-- Let m be the missing bank, p the limit of the roll rate, and g how far the bank limit lies beyond the target. The
-- bank changes at the least of p, (m + g)/tau (the command is at the bank limit) and `command_gain` m/tau. As m
-- shrinks these apply in that order. The time at which m is left follows from each in closed form. The times at
-- which the parts of the change take effect, and the squares of these times, are summed over these three ranges by
-- Gauss's rules.
function law.first_order_delay(roll, bank_deg, target_deg, limit_deg)
    local tau, p, gain, m = roll.time_s, roll.rate_deg_s, law.command_gain(roll), abs(target_deg - bank_deg)
    local last_s, change = tau / gain, tan(target_deg * 0.017453292519943295) - tan(bank_deg * 0.017453292519943295)
    local g = max(limit_deg - (target_deg >= bank_deg and target_deg or -target_deg), 0.0)
    -- The missing bank below which a demand is within the bank limit, and that at which the rate leaves its limit.
    local unlimited = gain > 1.0 and g / (gain - 1.0) or huge
    local is_instant = tau == 0.0 and p == huge
    if is_instant or m == 0.0 or m <= min(unlimited, p * last_s, 5.0--[[SMALL_CHANGE_DEG]]) then
        return {missing_s = last_s * change, moment_s2 = last_s * last_s * change}
    end
    local slow = min(max(p * tau - g, p * last_s), m)
    local free = min(unlimited, slow)
    local backward, time_s = target_deg > bank_deg and -1.0 or 1.0, (m - slow) / p
    local whole, mean, square = 0.0, 0.0, 0.0
    local tangent, share, at_s
    if slow < m then
        local each_x_1 = {law.LEGENDRE_POINTS[1], law.LEGENDRE_POINTS[2], law.LEGENDRE_POINTS[3]}
        local each_w_1 = {law.LEGENDRE_WEIGHTS[1], law.LEGENDRE_WEIGHTS[2], law.LEGENDRE_WEIGHTS[3]}
        for i_1 = 1, 3 do
            local x = each_x_1[i_1]
            local w = each_w_1[i_1]
            tangent = tan((target_deg + backward * (slow + x * (m - slow))) * 0.017453292519943295)
            share = w * (m - slow) * (1.0 + tangent * tangent)
            at_s = (1.0 - x) * time_s
            whole = whole + share
            mean = mean + share * at_s
            square = square + share * at_s * at_s
        end
    end
    if free < slow then
        -- In the square of a variable the logarithm is smooth where it begins.
        local each_x_2 = {law.LEGENDRE_POINTS[1], law.LEGENDRE_POINTS[2], law.LEGENDRE_POINTS[3]}
        local each_w_2 = {law.LEGENDRE_WEIGHTS[1], law.LEGENDRE_WEIGHTS[2], law.LEGENDRE_WEIGHTS[3]}
        for i_2 = 1, 3 do
            local x = each_x_2[i_2]
            local w = each_w_2[i_2]
            local left = free + x * x * (slow - free)
            tangent = tan((target_deg + backward * left) * 0.017453292519943295)
            at_s = time_s + tau * log((slow + g) / (left + g))
            share = 2.0 * x * w * (slow - free) * (1.0 + tangent * tangent)
            whole = whole + share
            mean = mean + share * at_s
            square = square + share * at_s * at_s
        end
    end
    if free > 0.0 then
        time_s = time_s + tau * log((slow + g) / (free + g))
        local each_x_3 = {law.LAGUERRE_POINTS[1], law.LAGUERRE_POINTS[2], law.LAGUERRE_POINTS[3]}
        local each_kept_3 = {law.LAGUERRE_SHARES[1], law.LAGUERRE_SHARES[2], law.LAGUERRE_SHARES[3]}
        local each_w_3 = {law.LAGUERRE_WEIGHTS[1], law.LAGUERRE_WEIGHTS[2], law.LAGUERRE_WEIGHTS[3]}
        for i_3 = 1, 3 do
            local x = each_x_3[i_3]
            local kept = each_kept_3[i_3]
            local w = each_w_3[i_3]
            tangent = tan((target_deg + backward * free * kept) * 0.017453292519943295)
            at_s = time_s + x * last_s
            share = w * free * (1.0 + tangent * tangent)
            whole = whole + share
            mean = mean + share * at_s
            square = square + share * at_s * at_s
        end
    end
    return {missing_s = change * mean / whole, moment_s2 = 0.5 * change * square / whole}
end

-- The largest change of bank that counts as infinitely small: its rate is not limited.
function law.small_change_deg(roll)
    return min(5.0--[[SMALL_CHANGE_DEG]], roll.rate_deg_s * roll.time_s / law.command_gain(roll))
end

-- `value`, limited to the range from -`limit` to `limit`.
function law.clip(value, limit)
    -- Comparisons take a third of the time of `min` and `max`, and a law clips several values in each step.
    return value > limit and limit or value < -limit and -limit or value
end

-- The step of a time above 0.
function law.roll_step(roll, time_s)
    if roll.lag_s == 0.0 then
        return {time_s = time_s, kept = 0.0, share = 0.0}
    end
    local kept, lags = exp(-time_s / roll.lag_s), time_s / roll.lag_s
    -- The difference of large numbers for a short time, of which this is the series.
    return {time_s = time_s, kept = kept, share = lags < 0.1--[[SHORT_LAGS]] and 0.5 - lags / 12.0 or 1.0 / lags -
            kept / (1.0 - kept)}
end

-- The mean of the command over the time in which it may change by `change_deg` on the way to a demand.
function law.mean_command(command_deg, demand_deg, change_deg)
    local missing_deg = demand_deg - command_deg
    if abs(missing_deg) >= change_deg then
        return command_deg + 0.5 * law.clip(missing_deg, change_deg)
    end
    return demand_deg - 0.5 * missing_deg * abs(missing_deg) / change_deg
end

-- The exact bank after `time_s` seconds under a constant command.
function law.bank_after(roll_time_s, rate_deg_s, bank_deg, command_deg, time_s)
    if roll_time_s == 0.0 and rate_deg_s == huge then
        return command_deg
    end
    local missing = command_deg - bank_deg
    local sign = missing >= 0.0 and 1.0 or -1.0
    local beyond = max(abs(missing) - rate_deg_s * roll_time_s, 0.0)
    local limited_s = beyond / rate_deg_s
    if limited_s > time_s then
        return bank_deg + sign * rate_deg_s * time_s
    end
    missing = missing - sign * beyond
    if roll_time_s > 0.0 then
        return command_deg - missing * exp(-(time_s - limited_s) / roll_time_s)
    end
    return time_s <= limited_s and command_deg - missing or command_deg
end

-- The bank after a step under a constant command.
function law.bank_after_step(roll, step, now, command_deg)
    if roll.lag_s == 0.0 then
        return {bank_deg = law.bank_after(roll.time_s, roll.rate_deg_s, now.bank_deg, command_deg, step.time_s),
                rate_deg_s = now.rate_deg_s}
    end
    local wanted_deg_s = (command_deg - now.bank_deg - 0.5 * step.time_s * now.rate_deg_s) / roll.time_s
    local rate_deg_s = law.clip(wanted_deg_s + step.kept * (now.rate_deg_s - wanted_deg_s), roll.rate_deg_s)
    local change_deg = step.time_s * (rate_deg_s + step.share * (now.rate_deg_s - rate_deg_s))
    return {bank_deg = now.bank_deg + change_deg, rate_deg_s = rate_deg_s}
end

-- The command that follows `command_deg` on the way to a demand, where it may change by `change_deg`.
function law.slewed_command(command_deg, demand_deg, change_deg)
    local missing_deg = demand_deg - command_deg
    return abs(missing_deg) <= change_deg and demand_deg or command_deg + law.clip(missing_deg, change_deg)
end

-- The delay of a small change of bank from `beyond_deg` beyond the target, in degrees of bank, not in turn rates.
--
-- With a = tau lag/K and b = (tau + rate gain)/K the missing bank m obeys a m'' + b m' + m = 0, so that its
-- integral over time is b m + a m', and that of m t is b times this less a m. A demand at the bank limit has the
-- gain 1.
function law.linear_delay(roll, beyond_deg, rate_deg_s, is_limited)
    local gain = is_limited and 1.0 or law.command_gain(roll)
    local a, b = roll.time_s * roll.lag_s / gain, (roll.time_s + (is_limited and 0.0 or law.rate_gain_s(roll))) /
            gain
    local missing_s = -b * beyond_deg - a * rate_deg_s
    return {missing_s = missing_s, moment_s2 = b * missing_s + a * beyond_deg}
end

-- `turn_delay` of a bank whose rate has a lag, or whose command a slew rate.
--
-- It is flown in steps until the change is small; the rest is linear.
function law.stepped_delay(roll, state, target_deg, limit_deg)
    local now, command_deg = state.now, state.command_deg
    local gain, braking_s, tangent = law.command_gain(roll), law.rate_gain_s(roll), tan(target_deg *
            0.017453292519943295)
    local missing_s, moment_s2, time_s, is_limited, left = 0.0, 0.0, 0.0, true, 24--[[STEPS]]
    local small_deg = law.small_change_deg(roll)
    now = {bank_deg = now.bank_deg, rate_deg_s = law.clip(now.rate_deg_s, roll.rate_deg_s)}
    local slowest_s = max(abs(target_deg - now.bank_deg) / roll.rate_deg_s, abs(target_deg - command_deg) /
            roll.slew_deg_s)
    local dt = (slowest_s + 1.5--[[SETTLING]] * (roll.time_s + braking_s)) / 24--[[STEPS]]
    local half_step, step, slew_deg = law.roll_step(roll, 0.5 * dt), law.roll_step(roll, dt), roll.slew_deg_s * dt
    while left > 0 do
        local wanted_deg = now.bank_deg + gain * (target_deg - now.bank_deg) - braking_s * now.rate_deg_s
        is_limited = abs(wanted_deg) > limit_deg or abs(wanted_deg - command_deg) > slew_deg
        if not is_limited and abs(target_deg - now.bank_deg) + roll.lag_s * abs(now.rate_deg_s) < small_deg then
            break
        end
        wanted_deg = law.clip(wanted_deg, limit_deg)
        local half = law.bank_after_step(roll, half_step, now, law.mean_command(command_deg, wanted_deg, 0.5 *
                slew_deg))
        -- The demand at half time counts for the whole step.
        wanted_deg = half.bank_deg + gain * (target_deg - half.bank_deg) - braking_s * half.rate_deg_s
        wanted_deg = law.clip(wanted_deg, limit_deg)
        local after = law.bank_after_step(roll, step, now, law.mean_command(command_deg, wanted_deg, slew_deg))
        local part_s = dt * (tangent - tan(0.5 * (now.bank_deg + after.bank_deg) * 0.017453292519943295))
        missing_s = missing_s + part_s
        moment_s2 = moment_s2 + part_s * (time_s + 0.5 * dt)
        command_deg = law.slewed_command(command_deg, wanted_deg, slew_deg)
        now = after
        time_s = time_s + dt
        left = left - 1
    end
    local slope = (1.0 + tangent * tangent) * 0.017453292519943295
    local rest = law.linear_delay(roll, now.bank_deg - target_deg, now.rate_deg_s, is_limited)
    missing_s = missing_s + slope * rest.missing_s
    return {missing_s = missing_s, moment_s2 = moment_s2 + slope * (time_s * rest.missing_s + rest.moment_s2)}
end

-- How a change of bank under `demand_deg` delays a turn. The turn rate is proportional to tan(bank).
function law.turn_delay(roll, state, target_deg, limit_deg)
    if roll.lag_s == 0.0 and roll.slew_deg_s == huge then
        return law.first_order_delay(roll, state.now.bank_deg, target_deg, limit_deg)
    end
    return law.stepped_delay(roll, state, target_deg, limit_deg)
end

-- When a change of bank from rest, under `demand_deg`, changes the turn rate.
function law.turn_onset(roll, bank_deg, target_deg, limit_deg)
    local change = tan(target_deg * 0.017453292519943295) - tan(bank_deg * 0.017453292519943295)
    if change == 0.0 then
        return law.small_onset(roll)
    end
    local delay = law.turn_delay(roll, {now = {bank_deg = bank_deg, rate_deg_s = 0.0}, command_deg = bank_deg},
            target_deg, limit_deg)
    local lead_s = delay.missing_s / change
    return {lead_s = lead_s, variance_s2 = max(2.0 * delay.moment_s2 / change - lead_s * lead_s, 0.0)}
end

-- `turn_onset` for whole half degrees.
function law.rounded_onset(roll, bank_deg, target_deg, limit_deg)
    return law.turn_onset(roll, 0.5 * law.half_degrees(bank_deg), 0.5 * law.half_degrees(target_deg), limit_deg)
end

-- What follows from the estimates of the vehicle, after other estimates.
function law.limits_of(settings, vehicle, before)
    local known, V, R = vehicle.estimates, vehicle.estimates.airspeed_m_s, settings.radius_m
    local wind_differs, east, north = law.planned_wind(settings, known, before.wind_differs)
    local widest_m = law.widest_turn_m(V, R, east, north)
    local limit_deg = law.present_limit_deg(settings, known, widest_m)
    local roll = before.roll
    local is_other = law.is_changed(known.roll, roll) or limit_deg ~= before.limit_deg
    if is_other then
        roll = known.roll
    end
    local tightest_m = law.radius_at_bank(known.turn_airspeed_m_s, limit_deg) / known.turn_ratio
    local lead_s = before.lead_s
    if is_other then
        lead_s = law.rounded_onset(roll, 0.0, limit_deg, limit_deg).lead_s
    end
    local turned = lead_s * V / tightest_m
    local reserve = settings.reserve * (1.0 + known.turns_unknown + 0.8--[[ROLL_RESERVE]] * turned)
    local planned_m = min(tightest_m * (1.0 + reserve), widest_m)
    local hold_deg = law.clip(law.bank_for(known, V / R), limit_deg)
    local planned, hold = law.half_degrees(law.clip(law.bank_for(known, V / planned_m), limit_deg)),
            law.half_degrees(hold_deg)
    local reversal_s2 = before.reversal_s2
    if is_other or planned ~= before.planned_half_deg or hold ~= before.hold_half_deg then
        reversal_s2 = law.turn_onset(roll, -0.5 * planned, 0.5 * hold, limit_deg).variance_s2
    end
    return {revision = vehicle.revision, wind_differs = wind_differs, wind_east_m_s = east, wind_north_m_s = north,
            roll = roll, limit_deg = limit_deg, turns = {airspeed_m_s = V, tightest_m = tightest_m, planned_m =
            planned_m}, hold_deg = hold_deg, hold_half_deg = hold, planned_half_deg = planned, lead_s = lead_s,
            reversal_s2 = reversal_s2, reversal_m = 0.5 * reversal_s2 * V * V * (1.0 / planned_m + 1.0 / R), lag_s =
            lead_s + 1.0--[[DELAY_SHARE]] * known.delay_s}
end

-- No path.
function law.no_path()
    return {pieces = filled({u = -2--[[ABSENT]], time_s = 0.0, radius_m = 1.0}, 12), total = 0, taken = 0, c = 1.0,
            s = 0.0}
end

-- The memory before there is a plan.
function law.first_planning()
    return {plan = law.NO_PLAN, path = law.no_path(), leads = law.NO_LEADS, response = law.NO_RESPONSE, search =
            law.NO_ENTRY_SEARCH, has_joined = false}
end

-- The memory before the first measurement, with wings level.
function law.first_memory(settings, vehicle)
    return {sensing = law.first_sensing(settings.smoothing_s, vehicle.bank_deg), limits = law.limits_of(settings,
            vehicle, law.NO_LIMITS), planning = law.first_planning(), trim = 0.0, command = {turn_rate_deg_s = 0.0,
            bank_deg = 0.0, phase = 3--[[NO_DATA]], time_to_join_s = (0.0 / 0.0), side = settings.side, next_phase =
            3--[[NO_DATA]], next_in_s = (0.0 / 0.0)}, step_s = 0.0}
end

-- The clock `dt` seconds later.
function law.advance_clock(clock, dt)
    local time_s, since_s, gap_s, jump_s, first_s, latest_s = clock.time_s, clock.since_s, clock.gap_s,
            clock.jump_s, clock.first_s, clock.latest_s
    return {time_s = time_s, since_s = since_s + dt, gap_s = gap_s, jump_s = jump_s, first_s = first_s, latest_s =
            latest_s}
end

-- The history with another step of `dt` seconds and the bank at its end; it covers at least `covered_s`.
--
-- Once the ring is full, steps that are so short that it would not cover that time are joined: two entries that
-- follow each other then last longer than twice that time divided by their number.
function law.record_bank(history, bank_deg, dt, covered_s)
    local entries = history.entries
    dt = min(dt, covered_s)
    local last = entries[128]
    local entry = {end_s = last.end_s + dt, bank_deg = bank_deg, integral = last.integral + dt * 0.5 *
            (last.bank_deg + bank_deg)}
    if entry.end_s - entries[127].end_s > 2.0 * covered_s / 128--[[ENTRIES]] or entries[1].end_s == -huge then
        return {entries = appended(entries, entry)}
    end
    return {entries = with_last(entries, entry)}
end

-- Whether the time of a measurement is within `LATEST_S`, and all other numbers together within `LARGEST_VALUE`.
function law.is_plausible(state)
    local time_s, east, north, heading, bank, velocity_east, velocity_north, airspeed = state.time_s, state.east_m,
            state.north_m, state.heading_deg, state.bank_deg, state.velocity_east_m_s, state.velocity_north_m_s,
            state.airspeed_m_s
    local position, angles = abs(east) + abs(north), abs(heading) + abs(bank)
    local size = position + angles + abs(velocity_east) + abs(velocity_north) + abs(airspeed)
    -- Neither comparison holds for nan.
    return abs(time_s) < 1000000000000.0--[[LATEST_S]] and size < 1000000000.0--[[LARGEST_VALUE]]
end

-- Whether a measurement is plausible and of an aircraft in flight, faster than `LEAST_AIRSPEED_M_S`.
function law.is_usable(state)
    return law.is_plausible(state) and state.airspeed_m_s > 0.1--[[LEAST_AIRSPEED_M_S]]
end

-- The bank at the end of the last step.
function law.present_deg(history)
    return history.entries[128].bank_deg
end

-- Turn rate of a coordinated turn, radians per second, with the sign of the bank: g tan(bank)/V.
function law.rate_at_bank(bank_deg, airspeed_m_s)
    return 9.80665--[[STANDARD_GRAVITY_M_S2]] * tan(bank_deg * 0.017453292519943295) / airspeed_m_s
end

-- The turn rate at a bank, radians per second, positive to the left.
function law.turn_rate_at(turning, bank_deg, airspeed_m_s)
    return -turning.ratio * law.rate_at_bank(bank_deg, airspeed_m_s)
end

-- A pose turned to the left by an angle, radians.
function law._rotated(pose, angle)
    if angle == 0.0 then
        return pose
    end
    local x, y, c, s = pose.x, pose.y, pose.c, pose.s
    local cosine, sine = cos(angle), sin(angle)
    return {x = x, y = y, c = c * cosine - s * sine, s = s * cosine + c * sine}
end

-- The estimate with another bank, which also changes the direction of flight if the vehicle slips.
function law.estimate_with_bank(estimate, bank_deg)
    local time_s, pose, V, last_rate, east, north, turning = estimate.time_s, estimate.pose, estimate.airspeed_m_s,
            estimate.turn_rate, estimate.air_east_m_s, estimate.air_north_m_s, estimate.turning
    local turn_rate = law.turn_rate_at(turning, bank_deg, V)
    pose = law._rotated(pose, turning.lead_s * (turn_rate - last_rate))
    return {time_s = time_s, pose = pose, airspeed_m_s = V, turn_rate = turn_rate, bank_deg = bank_deg, air_east_m_s
            = east, air_north_m_s = north, turning = turning}
end

-- The exact pose after `time` at constant speed and turn rate (radians per second, positive to the left).
--
-- The air moves with the velocity `air`, east and north. The displacement through it is the chord of the arc, along
-- the velocity at half time: `kernel.motion.fly`, but the heading turns twice by half the angle, which needs one
-- sine and one cosine, since a law turns poses several times a step.
function law.constant_turn(pose, speed, rate, time, air)
    local x, y, c, s, east, north = pose.x, pose.y, pose.c, pose.s, air[1], air[2]
    x = x + east * time
    y = y + north * time
    local half = 0.5 * rate * time
    if abs(half) < 2.9802322387695312e-08--[[SMALLEST_TURN]] then
        return {x = x + speed * time * c, y = y + speed * time * s, c = c, s = s}
    end
    local ch, sh = cos(half), sin(half)
    local new_c = c * ch - s * sh
    local new_s = s * ch + c * sh
    c = new_c
    s = new_s
    local chord = 2.0 * speed / rate * sh
    return {x = x + chord * c, y = y + chord * s, c = c * ch - s * sh, s = s * ch + c * sh}
end

-- The estimate `time_s` seconds later, with constant bank in a constant wind.
function law.estimate_after(estimate, time_s)
    local then_s, pose, V, turn_rate, bank_deg, east, north, turning = estimate.time_s, estimate.pose,
            estimate.airspeed_m_s, estimate.turn_rate, estimate.bank_deg, estimate.air_east_m_s,
            estimate.air_north_m_s, estimate.turning
    pose = law.constant_turn(pose, V, turn_rate, time_s, {east, north})
    return {time_s = then_s + time_s, pose = pose, airspeed_m_s = V, turn_rate = turn_rate, bank_deg = bank_deg,
            air_east_m_s = east, air_north_m_s = north, turning = turning}
end

-- The clock after a measurement at `time_s`, and whether that is a new one.
--
-- It may be one by this clock, or by another that is confirmed by now.
function law.check_stamp(clock, time_s)
    local ahead_s = time_s - clock.time_s
    if (0.0 < ahead_s and ahead_s <= clock.since_s + 3600.0--[[LARGEST_GAP_S]]) or clock.time_s == -huge then
        return {time_s = time_s, since_s = 0.0, gap_s = ahead_s, jump_s = 0.0, first_s = (0.0 / 0.0), latest_s =
                (0.0 / 0.0)}, true
    end
    -- A stamp that does not fit the earlier ones of the other clock starts the count again.
    local fits = clock.first_s <= time_s and time_s <= clock.latest_s + 1.0--[[CONFIRMATION_S]]
    local first_s, latest_s = fits and clock.first_s or time_s, fits and max(clock.latest_s, time_s) or time_s
    if latest_s - first_s >= 1.0--[[CONFIRMATION_S]] then
        return {time_s = time_s, since_s = 0.0, gap_s = clock.since_s, jump_s = ahead_s - clock.since_s, first_s =
                (0.0 / 0.0), latest_s = (0.0 / 0.0)}, true
    end
    return {time_s = clock.time_s, since_s = clock.since_s, gap_s = clock.gap_s, jump_s = clock.jump_s, first_s =
            first_s, latest_s = latest_s}, false
end

-- The observer that starts again from the next measurement.
function law.restart(observer)
    return {smoothing_s = observer.smoothing_s, interval_s = observer.interval_s, air = observer.air, estimate =
            law.NO_ESTIMATE}
end

-- The index of the first entry that ends at a time or later.
function law.index_at(history, time_s)
    local entries, low, high = history.entries, 0, 128--[[ENTRIES]] - 1
    while low < high do
        local middle = ((low + high) >> 1)
        if entries[middle + 1].end_s < time_s then
            low = middle + 1
        else
            high = middle
        end
    end
    return low
end

-- The bank at a time within an entry, between those at its ends; before the first entry it was constant.
function law.bank_within(history, index, time_s)
    local entry = history.entries[index + 1]
    if index == 0 then
        return entry.bank_deg
    end
    local before = history.entries[index - 1 + 1]
    if before.end_s == -huge or entry.end_s <= before.end_s then
        return entry.bank_deg
    end
    return entry.bank_deg - (entry.end_s - time_s) / (entry.end_s - before.end_s) * (entry.bank_deg -
            before.bank_deg)
end

-- The bank `delay_s` seconds ago.
function law.delayed_deg(history, delay_s)
    if delay_s <= 0.0 then
        return law.present_deg(history)
    end
    local then_s = history.entries[128].end_s - delay_s
    return law.bank_within(history, law.index_at(history, then_s), then_s)
end

-- A measured state without the biases of heading and bank.
function law.remove_bias(known, state)
    local heading_bias_deg, bank_bias_deg = known.heading_bias_deg, known.bank_bias_deg
    if heading_bias_deg == 0.0 and bank_bias_deg == 0.0 then
        return state
    end
    local time_s, x, y, heading_deg, bank_deg, east, north, V = state.time_s, state.east_m, state.north_m,
            state.heading_deg, state.bank_deg, state.velocity_east_m_s, state.velocity_north_m_s, state.airspeed_m_s
    return {time_s = time_s, east_m = x, north_m = y, heading_deg = heading_deg - heading_bias_deg, bank_deg =
            bank_deg - bank_bias_deg, velocity_east_m_s = east, velocity_north_m_s = north, airspeed_m_s = V}
end

-- East and north component of the unit vector along a compass heading, exact at multiples of 90 degrees.
--
-- The nearest multiple of 90 degrees is subtracted before the conversion to radians. Therefore a start that heads
-- due east towards the centre has the reduced ordinate 0, not 6e-17, and a large heading keeps its precision.
function law.heading_vector(heading_deg)
    local heading = fmod(heading_deg, 360.0)
    local quarters = (heading / 90.0 + 0.5) // 1.0
    local rest = (heading - 90.0 * quarters) * 0.017453292519943295
    -- Sine and cosine of the whole quarters, by `floor`: for arrays the operator % takes longer than a sine.
    local halves = 0.5 * quarters // 1.0
    local odd, flip = quarters - 2.0 * halves, halves - 2.0 * (0.5 * halves // 1.0)
    local sq, cq = odd - 2.0 * odd * flip, (1.0 - odd) * (1.0 - 2.0 * flip)
    local s, c = sin(rest), cos(rest)
    return sq * c + cq * s, cq * c - sq * s
end

-- The measured position, with the direction of flight through the air.
function law._flight_pose(state, turning)
    local ahead_deg = turning.lead_s * law.turn_rate_at(turning, state.bank_deg, state.airspeed_m_s) *
            57.29577951308232
    local heading_vector_1_1, heading_vector_1_2 = law.heading_vector(state.heading_deg - ahead_deg)
    return {x = state.east_m, y = state.north_m, c = heading_vector_1_1, s = heading_vector_1_2}
end

-- The estimate from a single measurement.
function law._estimate_from(state, turning)
    local V, pose = state.airspeed_m_s, law._flight_pose(state, turning)
    local turn_rate = law.turn_rate_at(turning, state.bank_deg, V)
    local east, north = state.velocity_east_m_s - V * pose.c, state.velocity_north_m_s - V * pose.s
    return {time_s = state.time_s, pose = pose, airspeed_m_s = V, turn_rate = turn_rate, bank_deg = state.bank_deg,
            air_east_m_s = east, air_north_m_s = north, turning = turning}
end

-- The average restarted from a velocity; what is known of gusts and noise stays.
function law.restart_air(air, east_m_s, north_m_s)
    local sample = {time_s = air.recent[64].time_s, east_m_s = east_m_s, north_m_s = north_m_s, turn_rate = 0.0}
    local recent = filled(sample, 64)
    return {east_m_s = east_m_s, north_m_s = north_m_s, known_s = air.known_s, near = air.near, far = air.far, along
            = air.along, recent = recent, lag_index = 64--[[SAMPLES]] - 2}
end

-- The mean square change of each component of the air's velocity in a second, (m/s)^2.
function law.gust(near, far)
    return max(far.square - near.square, 0.0) / max(far.time_s - near.time_s, 0.1)
end

-- The root mean square change of course in a second, radians, by gusts that show in these differences.
function law.course_change(observer, near, far)
    local V = observer.estimate.airspeed_m_s
    return V > 0.0 and sqrt(law.gust(near, far)) / V or 0.0
end

-- The root mean square change of course that gusts cause in a second, radians.
function law.roughness(observer)
    return law.course_change(observer, observer.air.near, observer.air.far)
end

-- The smoothing time for the present air and the interval of the measurements.
function law._smoothing_s(rough, interval_s, shortest_s)
    local calm = 1.0 - min(rough / 0.02--[[CALM_COURSE]], 1.0)
    local multiple = 1.0 + (1.6--[[CALM_MULTIPLE]] - 1.0) * calm
    return multiple * max(shortest_s, 5.0--[[LEAST_COUNT]] * interval_s)
end

-- A pose corrected by a share of its difference from the measured one.
function law._blended(pose, measured, share)
    local x, y, c, s = pose.x, pose.y, pose.c, pose.s
    c = c + share * (measured.c - c)
    s = s + share * (measured.s - s)
    local size = law.length(c, s)
    return {x = x + share * (measured.x - x), y = y + share * (measured.y - y), c = c / size, s = s / size}
end

-- The means along the flight with a measurement, the last one, and the one `GUST_LAG_S` before.
function law._along(along, last, before, now, motion, dt)
    local near_square, far_square, known_s = along.near_square, along.far_square, along.known_s
    local change = (now.turn_rate - before.turn_rate) / 0.1--[[TURN_CHANGE]]
    local counted_s = dt / (1.0 + change * change)
    known_s = min(known_s + counted_s, 10.0--[[GUST_AVERAGE_S]])
    local weight = counted_s / known_s
    local near = motion.c * (now.east_m_s - last.east_m_s) + motion.s * (now.north_m_s - last.north_m_s)
    local far = motion.c * (now.east_m_s - before.east_m_s) + motion.s * (now.north_m_s - before.north_m_s)
    return {near_square = near_square + weight * (near * near - near_square), far_square = far_square + weight *
            (far * far - far_square), known_s = known_s}
end

-- A mean with the difference of two measurements.
function law._mean(mean, before, now, weight)
    local time_s, square = mean.time_s, mean.square
    local east, north = now.east_m_s - before.east_m_s, now.north_m_s - before.north_m_s
    return {time_s = time_s + weight * (now.time_s - before.time_s - time_s), square = square + weight * (0.5 *
            (east * east + north * north) - square)}
end

-- The averaging time that suits gusts and noise, `longest_s` at most.
function law._averaging_s(near, far, longest_s)
    local change = law.gust(near, far)
    local noise = max(near.square - change * near.time_s, 0.0) / 2.0
    if noise * near.time_s >= change * longest_s * longest_s then
        return longest_s
    end
    return sqrt(noise * near.time_s / change)
end

-- The average, over `longest_s` at most, including a velocity measured `dt` seconds after the last.
function law.average_air(air, east_m_s, north_m_s, dt, longest_s, motion)
    local east, north, known_s, near, far, along, recent, lag_index = air.east_m_s, air.north_m_s, air.known_s,
            air.near, air.far, air.along, air.recent, air.lag_index
    local now_s = recent[64].time_s + dt
    known_s = min(known_s + dt, 10.0--[[GUST_AVERAGE_S]])
    while lag_index < 64--[[SAMPLES]] - 1 and now_s - recent[lag_index + 1 + 1].time_s >= 1.0--[[GUST_LAG_S]] do
        lag_index = lag_index + 1
    end
    local sample, weight = {time_s = now_s, east_m_s = east_m_s, north_m_s = north_m_s, turn_rate =
            motion.turn_rate}, 1.0 - exp(-dt / known_s)
    along = law._along(along, recent[64], recent[lag_index + 1], sample, motion, dt)
    near = law._mean(near, recent[64], sample, weight)
    far = law._mean(far, recent[lag_index + 1], sample, weight)
    if lag_index == 0 and recent[64].time_s - recent[63].time_s < 0.016129032258064516--[[SAMPLE_GAP_S]] then
        recent = with_last(recent, sample)
    else
        recent = appended(recent, sample)
        lag_index = max(lag_index - 1, 0)
    end
    local averaging_s = law._averaging_s(near, far, longest_s)
    local share = averaging_s > 0.0 and 1.0 - exp(-dt / averaging_s) or 1.0
    east = east + share * (east_m_s - east)
    north = north + share * (north_m_s - north)
    return {east_m_s = east, north_m_s = north, known_s = known_s, near = near, far = far, along = along, recent =
            recent, lag_index = lag_index}
end

-- The observer after a usable measurement that is later than the last one.
--
-- `bank_deg` is the bank that the roll model predicts for that time, `shortest_s` the shortest smoothing time.
function law.observe(observer, state, bank_deg, shortest_s, turning)
    local smoothing_s, interval_s, air, last = observer.smoothing_s, observer.interval_s, observer.air,
            observer.estimate
    if last.airspeed_m_s == 0.0 or shortest_s == 0.0 then
        local measured = law._estimate_from(state, turning)
        air = law.restart_air(air, measured.air_east_m_s, measured.air_north_m_s)
        return {smoothing_s = smoothing_s, interval_s = interval_s, air = air, estimate = measured}
    end
    local last_s, pose, V, last_rate, air_east, air_north = last.time_s, last.pose, last.airspeed_m_s,
            last.turn_rate, last.air_east_m_s, last.air_north_m_s
    local dt = state.time_s - last_s
    interval_s = interval_s + (interval_s > 0.0 and 0.05--[[INTERVAL_SHARE]] or 1.0) * (min(dt,
            0.3--[[LONGEST_INTERVAL_S]]) - interval_s)
    smoothing_s = law._smoothing_s(law.roughness(observer), interval_s, shortest_s)
    local share = 1.0 - exp(-dt / smoothing_s)
    V = V + share * (state.airspeed_m_s - V)
    bank_deg = bank_deg + share * (state.bank_deg - bank_deg)
    local turn_rate = law.turn_rate_at(turning, bank_deg, V)
    pose = law._rotated(pose, turning.lead_s * (turn_rate - last_rate))
    local predicted = law.constant_turn(pose, V, turn_rate, dt, {air_east, air_north})
    pose = law._blended(predicted, law._flight_pose(state, turning), share)
    local east, north = state.velocity_east_m_s - V * pose.c, state.velocity_north_m_s - V * pose.s
    air = law.average_air(air, east, north, dt, shortest_s, {c = pose.c, s = pose.s, turn_rate = turn_rate})
    local estimate = {time_s = state.time_s, pose = pose, airspeed_m_s = V, turn_rate = turn_rate, bank_deg =
            bank_deg, air_east_m_s = air.east_m_s, air_north_m_s = air.north_m_s, turning = turning}
    return {smoothing_s = smoothing_s, interval_s = interval_s, air = air, estimate = estimate}
end

-- The mean bank over the last `delay_s` seconds.
function law.mean_deg(history, delay_s)
    if delay_s <= 0.0 then
        return law.present_deg(history)
    end
    local last = history.entries[128]
    local then_s = last.end_s - delay_s
    local index = law.index_at(history, then_s)
    local first, bank_deg = history.entries[index + 1], law.bank_within(history, index, then_s)
    return (last.integral - first.integral + (first.end_s - then_s) * 0.5 * (bank_deg + first.bank_deg)) / delay_s
end

-- The estimate extrapolated over the measurement delay, with the banks modelled since then.
function law.estimate_at_present(estimate, history, delay_s)
    local time_s, pose, V, last_rate, bank_deg, east, north, turning = estimate.time_s, estimate.pose,
            estimate.airspeed_m_s, estimate.turn_rate, estimate.bank_deg, estimate.air_east_m_s,
            estimate.air_north_m_s, estimate.turning
    local error_deg = bank_deg - law.delayed_deg(history, delay_s)
    local mean_rate = law.turn_rate_at(turning, law.mean_deg(history, delay_s) + error_deg, V)
    local now_deg = law.present_deg(history) + error_deg
    local present_rate = law.turn_rate_at(turning, now_deg, V)
    -- The slip changes with the turn rate, and with it the direction of flight.
    pose = law._rotated(pose, turning.lead_s * (mean_rate - last_rate))
    pose = law.constant_turn(pose, V, mean_rate, delay_s, {east, north})
    pose = law._rotated(pose, turning.lead_s * (present_rate - mean_rate))
    return {time_s = time_s + delay_s, pose = pose, airspeed_m_s = V, turn_rate = present_rate, bank_deg = now_deg,
            air_east_m_s = east, air_north_m_s = north, turning = turning}
end

-- What is known at a measurement, `step_s` seconds after the last.
--
-- `smoothing_s` is the shortest smoothing time, `covered_s` what the history of banks has to cover. Telemetry may
-- be slower than the steps: until the next measurement, but no longer than `EXTRAPOLATED_S`, the last estimate is
-- extrapolated with the modelled bank.
function law.sense(sensing, vehicle, measurement, step_s, smoothing_s, covered_s)
    local clock, observer, history, command_deg, present, elapsed_s, error_deg = sensing.clock, sensing.observer,
            sensing.history, sensing.command_deg, sensing.present, sensing.elapsed_s, sensing.model_error_deg
    local rate_deg_s = vehicle.bank_rate_deg_s
    if step_s > 0.0 then
        clock = law.advance_clock(clock, step_s)
        elapsed_s = elapsed_s + step_s
        history = law.record_bank(history, vehicle.bank_deg, step_s, covered_s)
    end
    if not law.is_usable(measurement) then
        return {clock = clock, observer = observer, history = history, command_deg = command_deg, present = present,
                bank_rate_deg_s = rate_deg_s, elapsed_s = elapsed_s, model_error_deg = error_deg, is_known = false}
    end
    if measurement.time_s == clock.time_s then
        if present.airspeed_m_s == 0.0 or clock.since_s > 3.0--[[EXTRAPOLATED_S]] then
            return {clock = clock, observer = observer, history = history, command_deg = command_deg, present =
                    present, bank_rate_deg_s = rate_deg_s, elapsed_s = elapsed_s, model_error_deg = error_deg,
                    is_known = false}
        end
        present = law.estimate_after(law.estimate_with_bank(present, law.present_deg(history) + error_deg),
                elapsed_s)
        return {clock = clock, observer = observer, history = history, command_deg = command_deg, present = present,
                bank_rate_deg_s = rate_deg_s, elapsed_s = 0.0, model_error_deg = error_deg, is_known = true}
    end
    local is_first = clock.time_s == -huge
    local is_new
    clock, is_new = law.check_stamp(clock, measurement.time_s)
    if not is_new then
        return {clock = clock, observer = observer, history = history, command_deg = command_deg, present = present,
                bank_rate_deg_s = rate_deg_s, elapsed_s = elapsed_s, model_error_deg = error_deg, is_known = false}
    end
    if is_first then
        history = law.constant_history(vehicle.bank_deg)
    end
    if clock.jump_s ~= 0.0 or clock.gap_s > 3.0--[[EXTRAPOLATED_S]] then
        observer = law.restart(observer)
    end
    local known = vehicle.estimates
    local turning, bank_deg = {ratio = known.turn_ratio, lead_s = known.course_lead_s}, law.delayed_deg(history,
            known.delay_s)
    observer = law.observe(observer, law.remove_bias(known, measurement), bank_deg, smoothing_s, turning)
    present = law.estimate_at_present(observer.estimate, history, known.delay_s)
    return {clock = clock, observer = observer, history = history, command_deg = command_deg, present = present,
            bank_rate_deg_s = rate_deg_s, elapsed_s = 0.0, model_error_deg = present.bank_deg -
            law.present_deg(history), is_known = true}
end

-- What is known, with the command that the vehicle follows at present.
function law.with_command(sensing, command_deg)
    return with_fields(sensing, {command_deg = command_deg})
end

-- The search without an aim.
function law.end_entry_search(search)
    return with_fields(search, {aim = 0--[[NOTHING]]})
end

-- The memory without a search.
function law.drop_search(planning)
    return with_fields(planning, {search = law.end_entry_search(planning.search)})
end

-- Whether delays of changes of bank are others than before.
function law.is_other_roll(limits, before)
    local a, b = limits.roll, before.roll
    local same = a.time_s == b.time_s and a.rate_deg_s == b.rate_deg_s and a.lag_s == b.lag_s
    return not (same and limits.limit_deg == before.limit_deg)
end

-- The memory without delays of changes of bank, which are then computed anew.
function law.forget_leads(planning)
    return with_fields(planning, {leads = law.NO_LEADS})
end

-- The route by a clock that has jumped.
function law.by_clock(route, jump_s)
    return with_fields(route, {start_s = route.start_s + jump_s})
end

-- The plan by a clock that has jumped by `jump_s`.
function law.plan_by_clock(plan, jump_s)
    local route, left_s, join_s, planned_join_s, searched_s = plan.route, plan.remaining_s, plan.join_s,
            plan.planned_join_s, plan.searched_s
    return {route = law.by_clock(route, jump_s), remaining_s = left_s, join_s = join_s + jump_s, planned_join_s =
            planned_join_s + jump_s, searched_s = searched_s + jump_s}
end

-- The aircraft relative to the circle.
function law.relative_state(settings, estimate)
    local time_s, x, y, c, s, V, air_east, air_north = estimate.time_s, estimate.pose.x, estimate.pose.y,
            estimate.pose.c, estimate.pose.s, estimate.airspeed_m_s, estimate.air_east_m_s, estimate.air_north_m_s
    local east, north, hx, hy = settings.velocity_east_m_s, settings.velocity_north_m_s, V * c, V * s
    return {time_s = time_s, x = x - (settings.east_m + east * time_s), y = y - (settings.north_m + north * time_s),
            vx = hx + air_east - east, vy = hy + air_north - north, hx = hx, hy = hy}
end

-- The plain number of a member of `Word`, `Side` or `Status`, which Python answers in as compiled code does.
function law.code(member)
    return member + 0
end

-- The velocity (vx, vy) of a vehicle that flies along (hx, hy); (hx, hy) where that velocity is not plausible.
function law.flight_velocity(vx, vy, hx, hy)
    local chosen_1 = vx * hx + vy * hy > 0.05--[[LEAST_SPEED]] * (hx * hx + hy * hy)
    return chosen_1 and vx or hx, chosen_1 and vy or hy
end

-- The controls of the three pieces of a word, `ABSENT` past its last.
function law.controls(word)
    return (word & 3) - 2, ((word >> 2) & 3) - 2, ((word >> 4) & 3) - 2
end

-- Position (x, y) and unit velocity (c, s) after a time t with control u: the exact flow of (1).
--
-- The displacement is the chord of the arc, 2 sin(t/2) long, along the velocity at half time. This avoids the
-- difference of two nearly equal sines for short arcs.
function law.fly(x, y, c, s, u, t)
    local half = 0.5 * u * t
    local ch, sh = cos(half), sin(half)
    local chord = u ~= 0 and 2.0 * sin(0.5 * t) or t
    local ce, se = cos(u * t), sin(u * t)
    return x + chord * (c * ch - s * sh), y + chord * (s * ch + c * sh), c * ce - s * se, s * ce + c * se
end

-- A piece of the control `u` that begins at (x, y) along (c, s), and the direction (c, s) at its end.
function law._piece(u, x, y, c, s, time_s, r, speed)
    if u == -2--[[ABSENT]] then
        return law.NO_PIECE, c, s
    end
    local dx, dy, end_c, end_s = law.fly(0.0, 0.0, c, s, u, time_s * speed / r)
    local centre_x, centre_y = x - u * r * s, y + u * r * c
    return {u = u, x = centre_x, y = centre_y, c = c, s = s, end_x = x + r * dx, end_y = y + r * dy, time_s =
            time_s, radius_m = r}, end_c, end_s
end

-- The control of the last piece of a word.
function law.end_control(word)
    local u1, u2, u3 = law.controls(word)
    return u3 ~= -2--[[ABSENT]] and u3 or u2 ~= -2--[[ABSENT]] and u2 or u1
end

-- The route of an entry that begins at a state.
function law.route_of(state, entry)
    local side, word, t1_s, t2_s, t3_s, r, speed, east, north = entry.side, entry.word, entry.t1_s, entry.t2_s,
            entry.t3_s, entry.turn_radius_m, entry.speed_m_s, entry.wind_east_m_s, entry.wind_north_m_s
    local vx, vy = law.flight_velocity(state.vx - east, state.vy - north, state.hx, state.hy)
    local size = law.length(vx, vy)
    local u1, u2, u3 = law.controls(word)
    local first, c, s = law._piece(u1, state.x, state.y, vx / size, vy / size, t1_s, r, speed)
    local second
    second, c, s = law._piece(u2, first.end_x, first.end_y, c, s, t2_s, r, speed)
    local third = law._piece(u3, second.end_x, second.end_y, c, s, t3_s, r, speed)
    return {side = side, current = first, second = second, third = third, more_s = 0.0, last_u =
            law.end_control(word), start_s = state.time_s, turn_radius_m = r, speed_m_s = speed, wind_east_m_s =
            east, wind_north_m_s = north}
end

-- Whether only the circle is left.
function law.is_holding(route)
    return route.current.u == -2--[[ABSENT]]
end

-- The offset from a circle, flown to the left (u = +1) or right (-1), of a vehicle with the velocity (vx, vy).
--
-- The vehicle is at (x, y) relative to the centre. A holding circle of side +1, clockwise, is flown to the right.
function law.arc_offset(u, radius, x, y, vx, vy)
    local d = law.length(x, y)
    -- At the centre the direction along the circle is undefined: half a radius is the least distance used.
    local reach = max(d, 0.5 * radius)
    local along, inward = u * (x * vy - y * vx) / reach, -(x * vx + y * vy) / reach
    -- The left side of a left turn is the inside.
    return {crosstrack = u * (radius - d), course_error = atan(u * inward, along), path_rate = u * along / reach}
end

-- The motion of a vehicle relative to the steady wind of the plan.
function law.in_air(route, state)
    local time_s, x, y, vx, vy, hx, hy = state.time_s, state.x, state.y, state.vx, state.vy, state.hx, state.hy
    local east, north, elapsed_s = route.wind_east_m_s, route.wind_north_m_s, time_s - route.start_s
    vx, vy = law.flight_velocity(vx - east, vy - north, hx, hy)
    return {x = x - east * elapsed_s, y = y - north * elapsed_s, vx = vx, vy = vy}
end

-- The offset from a line along the unit vector (c, s) of a vehicle with the velocity (vx, vy).
--
-- The vehicle is at (x, y) relative to a point of the line.
function law.line_offset(x, y, c, s, vx, vy)
    return {crosstrack = c * y - s * x, course_error = atan(c * vy - s * vx, c * vx + s * vy), path_rate = 0.0}
end

-- The offset of a state from the current piece, or from the circle of `radius_m`.
function law.offset_of(route, state, radius_m)
    local vx, vy
    if law.is_holding(route) then
        vx, vy = law.flight_velocity(state.vx, state.vy, state.hx, state.hy)
        return law.arc_offset(-route.side, radius_m, state.x, state.y, vx, vy)
    end
    local piece = route.current
    local in_air_1 = law.in_air(route, state)
    local x, y = in_air_1.x, in_air_1.y
    vx = in_air_1.vx
    vy = in_air_1.vy
    if piece.u == 0 then
        return law.line_offset(x - piece.x, y - piece.y, piece.c, piece.s, vx, vy)
    end
    return law.arc_offset(piece.u, piece.radius_m, x - piece.x, y - piece.y, vx, vy)
end

-- The plan that holds the circle at once, if the flight begins on it; otherwise the plan as it is.
function law.plan_on_circle(settings, limits, plan, state)
    local r, V, R = limits.turns.planned_m, limits.turns.airspeed_m_s, settings.radius_m
    local each_side_1 = {law.code(1--[[Side.CW]]), law.code(-1--[[Side.CCW]])}
    for i_1 = 1, 2 do
        local side = each_side_1[i_1]
        if settings.side == side or settings.side == 0--[[Side.EITHER]] then
            local entry = {side = side, word = law.code(0--[[Word.EMPTY]]), t1_s = 0.0, t2_s = 0.0, t3_s = 0.0,
                    turn_radius_m = r, speed_m_s = V, wind_east_m_s = limits.wind_east_m_s, wind_north_m_s =
                    limits.wind_north_m_s}
            local route = law.route_of(state, entry)
            local offset = law.offset_of(route, state, R)
            if abs(offset.crosstrack) < 0.5 * settings.reserve * R and abs(offset.course_error) <
                    0.09--[[ON_COURSE]] then
                return {route = route, remaining_s = 0.0, join_s = state.time_s, planned_join_s = state.time_s,
                        searched_s = plan.searched_s}
            end
        end
    end
    return plan
end

-- Whether the last search is long enough ago.
function law.is_search_due(clock, plan)
    return clock.time_s - plan.searched_s >= 0.1--[[SEARCH_INTERVAL_S]] - 0.000131072--[[ROUNDING_S]]
end

-- The delay of a change of bank.
function law.lead_s(limits, bank_deg, target_deg)
    return law.rounded_onset(limits.roll, bank_deg, target_deg, limits.limit_deg).lead_s
end

-- The search for the fastest entry from a state, before its first step.
function law.search_from(settings, limits, aim, state, reversing)
    return with_fields(law.NO_ENTRY_SEARCH, {aim = aim, state = state, turns = limits.turns, wind_east_m_s =
            limits.wind_east_m_s, wind_north_m_s = limits.wind_north_m_s, radius_m = settings.radius_m, wide_m =
            settings.radius_m + limits.reversal_m, side = settings.side, reversing = reversing})
end

-- The plan to hold the circle where the flight begins on it, otherwise a search if it is due.
--
-- The fastest entry begins where a command takes effect, which depends on the bank and the first turn. So that is
-- found first, as it would be with wings level.
function law.begin_first_plan(planning, settings, limits, sensing)
    local present = sensing.present
    planning = with_fields(planning, {plan = law.plan_on_circle(settings, limits, planning.plan,
            law.relative_state(settings, present))})
    if planning.plan.route.side ~= 0 then
        return law.drop_search(planning)
    end
    if planning.search.aim ~= 0--[[NOTHING]] or not law.is_search_due(sensing.clock, planning.plan) then
        return planning
    end
    local later = law.estimate_after(present, law.lead_s(limits, present.bank_deg, 0.0))
    return with_fields(planning, {search = law.search_from(settings, limits, 1--[[FIRST_TURN]],
            law.relative_state(settings, later), true)})
end

-- The control of the last piece before the circle; `ABSENT` on the circle.
function law.last_control(route)
    return route.second.u == -2--[[ABSENT]] and route.current.u or route.last_u
end

-- The bank of a piece in half degrees, of the circle where it is absent; wide arcs need less than planned turns.
function law.half_deg_on(limits, route, piece)
    if piece.u == -2--[[ABSENT]] then
        return route.side * limits.hold_half_deg
    end
    if piece.radius_m == route.turn_radius_m then
        return -piece.u * limits.planned_half_deg
    end
    local V, planned_deg = limits.turns.airspeed_m_s, 0.5 * limits.planned_half_deg
    local rate = law.rate_at_bank(planned_deg, V) * route.turn_radius_m / piece.radius_m
    return -piece.u * law.half_degrees(law.bank_at_rate(rate, V))
end

-- The bank to which it goes on where it is at present while no change is wanted, degrees.
--
-- A lag of the bank rate keeps it for a time in effect. A command that lies q ahead of the bank returns to it at
-- the slew rate S: with q' = -S - q/tau, the bank meanwhile changes by q - S tau ln(1 + q/(S tau)).
function law.coasted_deg(roll, state)
    local now, command_deg = state.now, state.command_deg
    local bank_deg = now.bank_deg
    if roll.lag_s > 0.0 then
        bank_deg = bank_deg + roll.time_s * roll.lag_s / (roll.time_s + law.rate_gain_s(roll)) * now.rate_deg_s
    end
    if roll.slew_deg_s < huge and roll.time_s > 0.0 then
        local ahead_deg, slew_deg = law.clip(command_deg - now.bank_deg, roll.rate_deg_s * roll.time_s),
                roll.slew_deg_s * roll.time_s
        local change_deg = abs(ahead_deg) - slew_deg * log(1.0 + abs(ahead_deg) / slew_deg)
        bank_deg = bank_deg + (ahead_deg > 0.0 and change_deg or -change_deg)
    end
    return bank_deg
end

-- After how long a change from the bank of one piece to that of another takes effect, seconds.
--
-- Banks are in half degrees; `first_missing_s` is what the turn to the first one misses (`TurnDelay`).
function law.change_delay_s(roll, state, limit_deg, first, first_missing_s, second)
    if first == second then
        return 0.0
    end
    local missing_s = law.turn_delay(roll, state, 0.5 * second, limit_deg).missing_s
    return (first_missing_s - missing_s) / (tan(0.5 * first * 0.017453292519943295) - tan(0.5 * second *
            0.017453292519943295))
end

-- How changes from a bank to those of the pieces of a route are delayed; what is known is not computed again.
function law.leads_to(limits, leads, state, route)
    local now, u3 = state.now, law.last_control(route)
    local bank, rate = law.half_degrees(now.bank_deg), law.half_degrees(now.rate_deg_s / 4.0--[[RATE_STEPS]])
    local command = limits.roll.slew_deg_s < huge and law.half_degrees(state.command_deg) or 0
    local first, second = law.half_deg_on(limits, route, route.current), law.half_deg_on(limits, route,
            route.second)
    local last = u3 == -2--[[ABSENT]] and route.side * limits.hold_half_deg or -u3 * limits.planned_half_deg
    if leads.bank == bank and leads.rate == rate and leads.command == command and leads.current == first and
            leads.next == second and leads.last == last then
        return leads
    end
    local roll, limit_deg = limits.roll, limits.limit_deg
    now = {bank_deg = 0.5 * bank, rate_deg_s = 0.5 * 4.0--[[RATE_STEPS]] * rate}
    state = {now = now, command_deg = 0.5 * command}
    local there = tan(now.bank_deg * 0.017453292519943295)
    local first_s = law.small_onset(roll).lead_s
    local first_delay = law.turn_delay(roll, state, 0.5 * first, limit_deg)
    local first_missing_s = first_delay.missing_s
    local tangent = tan(0.5 * first * 0.017453292519943295)
    local unchanged_deg = law.clip(law.coasted_deg(roll, state), limit_deg)
    local current_s = first_s
    if abs(0.5 * first - unchanged_deg) > 5.0--[[SMALL_CHANGE_DEG]] then
        current_s = max(first_missing_s / (tangent - tan(unchanged_deg * 0.017453292519943295)), 0.5 * first_s)
    elseif rate == 0 and first ~= bank and (command == 0 or command == bank) then
        current_s = first_missing_s / (tangent - there)
    end
    local more = current_s > 0.0 and first ~= bank and tangent - first_missing_s / current_s - there or 0.0
    local next_s = law.change_delay_s(roll, state, limit_deg, first, first_missing_s, second) - current_s
    local last_s = law.change_delay_s(roll, state, limit_deg, first, first_missing_s, last) - current_s
    local displaced_s2 = first_delay.moment_s2 - 0.5 * first_missing_s * current_s
    return {bank = bank, rate = rate, command = command, current = first, next = second, last = last, current_s =
            current_s, more = more, next_s = next_s, last_s = last_s, displaced_s2 = displaced_s2}
end

-- The estimate with a turn rate that is larger by `more` g/V, positive to the right.
function law.turning_more(estimate, more)
    local V = estimate.airspeed_m_s
    local rate = estimate.turn_rate - estimate.turning.ratio * 9.80665--[[STANDARD_GRAVITY_M_S2]] * more / V
    return with_fields(estimate, {turn_rate = rate})
end

-- The state displaced to the right by so many times standard gravity.
function law.displaced(state, displaced_s2)
    local scale = 9.80665--[[STANDARD_GRAVITY_M_S2]] * displaced_s2 / law.length(state.hx, state.hy)
    return with_fields(state, {x = state.x + scale * state.hy, y = state.y - scale * state.hx})
end

-- The counter-clockwise rotation from direction (ax, ay) to (bx, by); by zero where one of them is zero.
function law.rotation(ax, ay, bx, by)
    return ax * by - ay * bx, ax * bx + ay * by + 1.4551915228366852e-11--[[TINY]]
end

-- The rotation of the arc of control u = +1 or -1 that takes the heading (ax, ay) to (bx, by).
function law.arc_rotation(u, ax, ay, bx, by)
    local cross, dot = law.rotation(ax, ay, bx, by)
    return u * cross, dot
end

-- The angle of a counter-clockwise rotation, in [0, 2 pi]; that of a clockwise one is `angle((-cross, dot))`.
--
-- One arctangent has an error of about one rounding of the angle itself; a difference of two arctangents would lose
-- the digits of a small rotation.
function law.angle(rotated)
    local cross, dot = rotated[1], rotated[2]
    local turned = atan(cross, dot)
    -- + 0.0 turns -0.0 into 0.0, so that no duration has a negative sign.
    return turned < 0.0 and turned + 6.283185307179586--[[TWO_PI]] or turned + 0.0
end

-- The time left of the current piece at a state; 0 on the circle.
--
-- On an arc this is known up to whole turns: the value nearest to `previous_s` is taken.
function law.remaining_s(route, state, previous_s)
    if law.is_holding(route) then
        return 0.0
    end
    local in_air_1 = law.in_air(route, state)
    local piece, x, y = route.current, in_air_1.x, in_air_1.y
    if piece.u == 0 then
        return ((piece.end_x - x) * piece.c + (piece.end_y - y) * piece.s) / route.speed_m_s
    end
    local left = law.angle({law.arc_rotation(piece.u, x - piece.x, y - piece.y, piece.end_x - piece.x, piece.end_y -
            piece.y)})
    local rate = route.speed_m_s / piece.radius_m
    return (left + 6.283185307179586--[[TWO_PI]] * integer_of((previous_s * rate - left) /
            6.283185307179586--[[TWO_PI]] - 0.5)) / rate
end

-- How long before its end the current piece must end, since the next bank takes effect with a delay.
function law.early_end_s(route, leads)
    local early_s = leads.next_s
    if route.second.u == 0 and route.third.u ~= -2--[[ABSENT]] and route.third.u ~= route.current.u then
        -- A straight line between opposite turns may be shorter than the reversal, which then begins before its end.
        early_s = max(early_s, leads.last_s - 0.5 * route.second.time_s)
    end
    return max(early_s, 0.0)
end

-- A path without its next piece, that, which begins at the end of the last one, and the time of those after it.
function law._next_piece(path, last, speed, more_s)
    if path.taken == path.total then
        return path, law.NO_PIECE, 0.0
    end
    local parts_1 = path.pieces[path.taken + 1]
    local u, time_s, radius_m = parts_1.u, parts_1.time_s, parts_1.radius_m
    local piece, c, s = law._piece(u, last.end_x, last.end_y, path.c, path.s, time_s, radius_m, speed)
    local taken = path.taken + 1
    return with_fields(path, {taken = taken, c = c, s = s}), piece, taken == path.total and 0.0 or more_s - time_s
end

-- A path and the route along it, without the current piece of that.
function law.next_on(path, route)
    local third, more_s
    path, third, more_s = law._next_piece(path, route.third, route.speed_m_s, route.more_s)
    return path, with_fields(route, {current = route.second, second = route.third, third = third, more_s = more_s})
end

-- The time from the end of the current piece to the circle.
function law.later_s(route)
    return route.second.time_s + route.third.time_s + route.more_s
end

-- The plan at the response: without the pieces that are complete when a command takes effect.
--
-- A change of bank takes effect with a delay; from then on the aircraft turns like one that banks instantly.
function law.advance_plan(planning, settings, limits, sensing)
    local estimate, leads, path = sensing.present, planning.leads, planning.path
    local route, left_s, join_s, planned_join_s, searched_s = planning.plan.route, planning.plan.remaining_s,
            planning.plan.join_s, planning.plan.planned_join_s, planning.plan.searched_s
    -- Pieces are dropped that are complete, in a plan of its own at most three.
    local state, early_s
    while true do
        local now = {bank_deg = estimate.bank_deg, rate_deg_s = sensing.bank_rate_deg_s}
        leads = law.leads_to(limits, leads, {now = now, command_deg = sensing.command_deg}, route)
        local later = law.estimate_after(law.turning_more(estimate, leads.more), leads.current_s)
        state = law.displaced(law.relative_state(settings, later), estimate.turning.ratio * leads.displaced_s2)
        left_s = law.remaining_s(route, state, left_s)
        early_s = law.early_end_s(route, leads)
        if law.is_holding(route) or left_s > early_s + 0.000131072--[[ROUNDING_S]] then
            break
        end
        path, route = law.next_on(path, route)
        left_s = route.current.time_s
    end
    local has_joined = planning.has_joined
    if law.is_holding(route) then
        early_s = 0.0
        has_joined = has_joined or not law.is_holding(planning.plan.route)
    else
        join_s = state.time_s + left_s + law.later_s(route)
        if path.total > 0 then
            -- A given path stays where it is over the ground: in wind it does not drift on where it is flown late.
            route = law.by_clock(route, join_s - planned_join_s)
            planned_join_s = join_s
        end
    end
    return with_fields(planning, {path = path, plan = {route = route, remaining_s = left_s, join_s = join_s,
            planned_join_s = planned_join_s, searched_s = searched_s}, leads = leads, response = {state = state,
            offset = law.offset_of(route, state, settings.radius_m), early_s = early_s}, has_joined = has_joined})
end

-- The same by gusts along the flight since `restart_gusts`: a slip that changes with the bank does not count.
function law.along_roughness(observer)
    local near, far, along = observer.air.near, observer.air.far, observer.air.along
    return law.course_change(observer, {time_s = near.time_s, square = along.near_square}, {time_s = far.time_s,
            square = along.far_square})
end

-- Whether the last turn of the plan is opposite to that of the circle.
function law.reverses(route)
    return route.last_u == route.side
end

-- The turn from (x, y) along (c, s), opposite to the circle, that ends where it is closest to the circle.
function law._last_turn(u, x, y, c, s, r, speed)
    local centre_x, centre_y = x - u * r * s, y + u * r * c
    local scale = 1.0 - r / law.length(centre_x, centre_y)
    local end_x, end_y = scale * centre_x, scale * centre_y
    local turned = law.angle({law.arc_rotation(u, x - centre_x, y - centre_y, end_x - centre_x, end_y - centre_y)})
    return {u = u, x = centre_x, y = centre_y, c = c, s = s, end_x = end_x, end_y = end_y, time_s = turned * r /
            speed, radius_m = r}
end

-- The route with its line, parallel to the present one, through a state, and another last turn, in still air.
--
-- The route as it is where that turn, as wide as planned and opposite to the circle, cannot end on the circle.
function law.with_last_line(route, state, circle_m)
    local r, c, s, u, V = route.turn_radius_m, route.current.c, route.current.s, route.second.u, route.speed_m_s
    local centre_x, centre_y, reach_m = state.x - u * r * s, state.y + u * r * c, circle_m + r
    local along_m, beside_m = c * centre_x + s * centre_y, c * centre_y - s * centre_x
    if abs(beside_m) >= reach_m then
        return route
    end
    local left_m = -along_m - sqrt(reach_m * reach_m - beside_m * beside_m)
    local end_x, end_y = state.x + left_m * c, state.y + left_m * s
    local line = {u = 0, x = state.x, y = state.y, c = c, s = s, end_x = end_x, end_y = end_y, time_s = left_m / V,
            radius_m = r}
    return with_fields(route, {current = line, second = law._last_turn(u, end_x, end_y, c, s, r, V)})
end

-- The radius of the turn, opposite to the circle, that leads in still air from a state onto the circle; metres.
--
-- The centre of the turn, p + r n with the unit vector n towards it, is r plus the radius of the circle away from
-- that of the circle. The result is not positive where there is no such turn.
function law.last_radius_m(route, state, circle_m)
    local vx, vy = law.flight_velocity(state.vx, state.vy, state.hx, state.hy)
    local ahead_m = circle_m - route.current.u * (state.y * vx - state.x * vy) / law.length(vx, vy)
    return ahead_m > 0.0 and 0.5 * (state.x * state.x + state.y * state.y - circle_m * circle_m) / ahead_m or 0.0
end

-- The route with another last turn, in still air, that begins at a state.
function law.with_last_turn(route, state, radius_m)
    local vx, vy = law.flight_velocity(state.vx, state.vy, state.hx, state.hy)
    local speed = law.length(vx, vy)
    local turn = law._last_turn(route.current.u, state.x, state.y, vx / speed, vy / speed, radius_m,
            route.speed_m_s)
    return with_fields(route, {current = turn})
end

-- The plan along a new route, which joins at a time.
function law.plan_along(plan, route, join_s)
    return with_fields(plan, {route = route, remaining_s = route.current.time_s, join_s = join_s})
end

-- The memory with a plan whose last turn, where that is opposite to the circle, is aimed again from the response.
--
-- Until a plan that is better comes, the aircraft would miss the circle by its distance from the present one. In
-- still air the line before that turn is moved to the aircraft, and the radius of the turn itself follows from the
-- state; it is the tightest one where that is too wide. In heavy gusts the last plan is followed: the aim would
-- move with them.
function law.aim_again(planning, settings, limits, sensing)
    local state, plan = planning.response.state, planning.plan
    local route = planning.plan.route
    local is_still = route.wind_east_m_s == 0.0 and route.wind_north_m_s == 0.0
    local is_calm = law.along_roughness(sensing.observer) <= 0.04--[[HEAVY_GUSTS]]
    if law.is_holding(route) or route.third.u ~= -2--[[ABSENT]] or not (is_still and is_calm and
            law.reverses(route)) then
        return planning
    end
    local circle_m = settings.radius_m + limits.reversal_m
    if route.second.u ~= -2--[[ABSENT]] then
        if route.current.u ~= 0 then
            return planning
        end
        route = law.with_last_line(route, state, circle_m)
    else
        local radius_m = law.last_radius_m(route, state, circle_m)
        if not (0.0 < radius_m and radius_m < 8.0--[[WIDEST_AIMED]] * limits.turns.planned_m) then
            return planning
        end
        route = law.with_last_turn(route, state, max(radius_m, limits.turns.tightest_m))
        local missed_m = law.length(route.current.end_x, route.current.end_y) - circle_m
        if abs(missed_m) > 0.5--[[LOST_OFFSET]] * limits.turns.planned_m then
            return planning
        end
    end
    local left_s, whole_s = route.current.time_s, route.current.time_s + law.later_s(route)
    local later = whole_s - plan.remaining_s - law.later_s(plan.route)
    if left_s < 0.2--[[AIMED_LEFT_S]] + planning.response.early_s or abs(later) > 1.0--[[AIM_CHANGE_S]] then
        return planning
    end
    planning = with_fields(planning, {plan = law.plan_along(plan, route, state.time_s + whole_s)})
    return law.advance_plan(planning, settings, limits, sensing)
end

-- The plan with the time of the last search.
function law.searched_at(plan, time_s)
    return with_fields(plan, {searched_s = time_s})
end

-- The memory with a search for a plan from a state, and when it began.
function law.begin_plan_search(planning, settings, limits, aim, state, now_s)
    local reversing = planning.plan.route.side == 0 or law.reverses(planning.plan.route)
    planning = with_fields(planning, {search = law.search_from(settings, limits, aim, state, reversing)})
    return with_fields(planning, {plan = law.searched_at(planning.plan, now_s)})
end

-- The memory with a search for another plan, if that is due.
function law.reconsider(planning, settings, limits, sensing)
    local is_given = planning.path.total > 0
    if is_given or planning.search.aim ~= 0--[[NOTHING]] or not law.is_search_due(sensing.clock, planning.plan) then
        return planning
    end
    planning = law.aim_again(planning, settings, limits, sensing)
    local offset, plan = planning.response.offset, planning.plan
    local r, V = limits.turns.planned_m, limits.turns.airspeed_m_s
    local holding = law.is_holding(plan.route)
    local is_lost = abs(offset.crosstrack) > 0.5--[[LOST_OFFSET]] * r or abs(offset.course_error) >
            1.0--[[LOST_COURSE]]
    -- A plan for a wind that differs so much from the present one means nothing.
    local east, north = limits.wind_east_m_s - plan.route.wind_east_m_s, limits.wind_north_m_s -
            plan.route.wind_north_m_s
    if is_lost or (not holding and law.length(east, north) > 0.1--[[WIND_DIFFERS]] * V) then
        return law.begin_plan_search(planning, settings, limits, 2--[[ANY]], planning.response.state,
                sensing.clock.time_s)
    end
    if holding then
        return planning
    end
    local later_m = abs(plan.join_s - plan.planned_join_s) * V
    local deviates = max(abs(offset.crosstrack), later_m) > 0.1--[[DEVIATION]] * r
    local is_still = limits.wind_east_m_s == 0.0 and limits.wind_north_m_s == 0.0
    local aim = (deviates or is_still) and 4--[[UPDATE]] or 3--[[BETTER]]
    return law.begin_plan_search(planning, settings, limits, aim, planning.response.state, sensing.clock.time_s)
end

-- The plan from the present state on, and a search begun for another if it is due.
function law.update_plan(planning, settings, limits, sensing)
    local clock = sensing.clock
    if clock.since_s == 0.0 and clock.jump_s ~= 0.0 then
        planning = with_fields(planning, {plan = law.plan_by_clock(planning.plan, clock.jump_s)})
        planning = law.drop_search(planning)
    end
    if planning.plan.route.side == 0 then
        planning = law.begin_first_plan(planning, settings, limits, sensing)
    end
    if planning.plan.route.side == 0 then
        return planning
    end
    planning = law.advance_plan(planning, settings, limits, sensing)
    return law.reconsider(planning, settings, limits, sensing)
end

-- The memory after a measurement: what is known, the present plan, and a search begun for another if it is due.
function law.prepare(memory, settings, vehicle, measurement)
    local smoothing_s, covered_s = settings.smoothing_s, settings.covered_s
    local sensing = law.sense(memory.sensing, vehicle, measurement, memory.step_s, smoothing_s, covered_s)
    local command_deg = memory.step_s > 0.0 and memory.command.bank_deg or vehicle.bank_deg
    memory = with_fields(memory, {sensing = law.with_command(sensing, command_deg)})
    if not memory.sensing.is_known then
        return with_fields(memory, {planning = law.drop_search(memory.planning)})
    end
    if vehicle.revision ~= memory.limits.revision then
        local limits = law.limits_of(settings, vehicle, memory.limits)
        if law.is_other_roll(limits, memory.limits) then
            memory = with_fields(memory, {planning = law.forget_leads(memory.planning)})
        end
        memory = with_fields(memory, {limits = limits})
    end
    return with_fields(memory, {planning = law.update_plan(memory.planning, settings, memory.limits,
            memory.sensing)})
end

-- The radius of the circle that is searched for.
function law.circle_m(search)
    return search.reversing and search.wide_m or search.radius_m
end

-- The velocity relative to the air with which an entry starts.
function law.flight_vector(search)
    local state = search.state
    return law.flight_velocity(state.vx - search.wind_east_m_s, state.vy - search.wind_north_m_s, state.hx,
            state.hy)
end

-- Whether the air is planned to be at rest.
function law.is_still(search)
    return search.wind_east_m_s == 0.0 and search.wind_north_m_s == 0.0
end

-- The radius of the turns at a speed, over that of the planned ones.
--
-- In still air turns are wider in the present gust: at a given turn rate the radius grows with the speed. They are
-- at most as wide as the circle.
function law.turn_scale(search, speed)
    if not law.is_still(search) then
        return 1.0
    end
    return min(speed / search.turns.airspeed_m_s, law.circle_m(search) / search.turns.planned_m)
end

-- The reduced state (2) of a vehicle at (x, y), relative to the circle's centre, with the unit heading (c, s).
function law.reduce(x, y, c, s)
    return x * c + y * s, y * c - x * s
end

-- The side that is never slower: T_either(x, y) = T_cw(x, |y|) (paper, section 5); clockwise on y = 0.
function law.near_side(y)
    return y < 0.0 and -1 or 1
end

-- The side itself; for *either*, the near side.
function law.side_or_near(y, side)
    return side ~= 0--[[Side.EITHER]] and law.code(side) or law.near_side(y)
end

-- The length tolerance: the rounding error of lengths for a state and a circle of this size.
function law.rounding(x, y, R)
    return 7.62939453125e-06--[[ROUNDING]] * (1.0 + abs(x) + abs(y) + R)
end

-- The share of the end-point tolerance that each of at most three pieces may use up.
function law.arc_tolerance_of(x, y, R, tolerance)
    return max(tolerance, law.rounding(x, y, R)) / 3.0
end

-- The rounded sum a + b, and its rounding error, exactly.
function law.two_sum(a, b)
    local s = a + b
    local t = s - a
    return s, a - (s - t) + (b - t)
end

-- A double as the sum of two of 26 digits.
function law.split(a)
    local c = 4097.0--[[SPLITTER]] * a
    local high = c - (c - a)
    return high, a - high
end

-- The rounded product a b, and its rounding error, exactly for |a|, |b| < 2^480.
function law.two_product(a, b)
    local p = a * b
    local ah, al = law.split(a)
    local bh, bl = law.split(b)
    return p, ah * bh - p + ah * bl + al * bh + al * bl
end

-- The squared distances rp^2 - (R + 1)^2, rm^2 - (R - 1)^2 and rp^2 - (R - 3)^2 beyond three circles.
--
-- They are `beyond` with R and 2, R and -2, 2 - R and 2. The last is the sum u + d + low, with an error of third
-- order only: at R = 1 + 2e-14 there are doubles next to (-sqrt(3), 0) where it is 8e-32, and where T would lose
-- 1e-9 for the terms that `beyond` leaves out. The others differ from it by -8 (R - 1) and -4 (y + R - 2); for them
-- an error of second order is enough, since next to their circles a single arc replaces the words that depend on
-- them.
function law.beyond_circles(x, y, R)
    local s, es = law.two_sum(y, R - 2.0)
    local t, et = law.two_sum(y, 2.0 - R)
    local ek
    t, ek = law.two_sum(t, 2.0)
    local e, ee = law.two_sum(et, ek)
    local p, ep = law.two_product(s, t)
    local q, eq = law.two_product(x, x)
    local v, ev = law.two_product(s, e)
    local w, ew = law.two_product(t, es)
    local u, eu = law.two_sum(q, p)
    local a, ea = law.two_sum(ep, eq)
    local b, eb = law.two_sum(v, w)
    local c, ec = law.two_sum(a, b)
    local d, ed = law.two_sum(eu, c)
    local low = es * e + s * ee + (ev + ew + (ea + eb + (ec + ed)))
    local f, ef = law.two_sum(u, -8.0 * (R - 1.0))
    local g, eg = law.two_sum(u, -4.0 * s)
    return f + (ef + d), g + (eg + d - 4.0 * es), u + d + low
end

-- The start at a reduced state.
function law.start_at(x, y, R, arc_tolerance)
    local outer, inner, fold = law.beyond_circles(x, y, R)
    return {x = x, y = y, R = R, arc_tolerance = arc_tolerance, outer = outer, inner = inner, fold = fold}
end

-- The rotation, or that by zero where it is less than a full turn by at most `arc_tolerance` of arc length.
--
-- `radius2` is the square of the radius of the arc. Leaving out the full turn moves the end point by at most
-- `arc_tolerance`; it removes the jump of T that rounding or noise would cause where an arc vanishes
-- (docs/theory.md, section 6). The missing angle is replaced by its tangent, which is no smaller.
function law.snap_full_turn(rotated, radius2, arc_tolerance)
    local cross, dot = rotated[1], rotated[2]
    local nearly_full = (cross < 0.0 and 0.0 < dot) and cross * cross * radius2 <= arc_tolerance * arc_tolerance *
            dot * dot
    return nearly_full and 0.0 or rotated[1], nearly_full and dot or rotated[2]
end

-- The rotation of a left turn from (x, y) to the point (end c, 0) of the axis y = 0, end = -1 or +1; and c.
--
-- c is sqrt(rp^2 - 1), or -1 where the turn never meets the axis (rp < 1). A right turn is the mirror image: pass
-- -y. The cross product is end (c y + c - end x); where end x > 0, c - end x = y (y + 2) / (c + end x), so the
-- rotation has exactly the sign of y.
function law.onto_axis(x, y, end_, arc_tolerance)
    local rise = y * (y + 2.0)
    local c2 = x * x + rise
    local c = sqrt(max(c2, 0.0))
    local along = end_ * x
    -- Both products are multiplied by c + along where that is safe, which saves a division.
    local scale = along > 1.4551915228366852e-11--[[SMALLEST_SCALE]] and c + along or 1.0
    local gap = along > 1.4551915228366852e-11--[[SMALLEST_SCALE]] and rise or c - along
    local products = {end_ * (c * y * scale + gap), (c * along + y + 1.0) * scale}
    return {law.snap_full_turn(products, c2 + 1.0, arc_tolerance)}, c2 >= 0.0 and c or -1.0
end

-- LSL: onto the axis at (-c, 0), straight to (-X, 0), X = sqrt(R (R + 2)), left for acos(1/(R + 1)).
--
-- `y` is the ordinate of the start, with the opposite sign for RSL. `joins` says whether c >= X, decided as in the
-- selection of words; rounding may still make c - X negative.
function law.external_join(word, y, start, joins)
    local R = start.R
    local first, c = law.onto_axis(start.x, y, -1.0, start.arc_tolerance)
    local X = sqrt(R * (R + 2.0))
    return {word = word, first = first, straight = joins and max(c - X, 0.0) or huge, middle = law.NO_ROTATION, last
            = {X, 1.0}}
end

-- Right, straight, left, rm >= R + 1: the first arc is the mirror image of that of LSL.
function law.rsl(start)
    return law.external_join(57--[[Word.RSL]], -start.y, start, start.inner >= 4.0 * start.R)
end

-- (R + 3)^2 - rm^2: not negative where the circle of R meets the last circle of L, so where RL exists.
--
-- It is 4 (R + y + 2) - `outer`, and not computed as 8 (R + 1) - `inner`: next to (0, -R - 2), where it vanishes
-- and RL is the fastest, neither term is negative, so that no digits are lost. T varies with its square root.
function law.within_reach(start)
    return 4.0 * (start.R + start.y + 2.0) - start.outer
end

-- The squared distance from (0, centre), accurate even near zero; computed from `beyond` it would lose digits.
function law.squared_distance(x, y, centre)
    return x * x + (y - centre) * (y - centre)
end

-- RL: right to the crossing with the last circle (R + 1 about (0, -1)) where x1 has `branch`'s sign; then left.
--
-- The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = `inner` = rm^2 - (R - 1)^2 and p = `within_reach`
-- = (R + 3)^2 - rm^2.
function law.rl(start, branch)
    local x, y, R, arc_tolerance, inner = start.x, start.y, start.R, start.arc_tolerance, start.inner
    local p = law.within_reach(start)
    local x1 = branch * 0.25 * sqrt(max(p * inner, 0.0))
    local radius2 = law.squared_distance(x, y, 1.0)
    local first = {law.snap_full_turn({law.rotation(x, y - 1.0, x1, R - 1.0 - 0.25 * inner)}, radius2,
            arc_tolerance)}
    local last = {law.snap_full_turn({-x1, R + 1.0 - 0.25 * inner}, (R + 1.0) * (R + 1.0), arc_tolerance)}
    return {word = 13--[[Word.RL]], first = first, straight = inner >= 0.0 and p >= 0.0 and 0.0 or huge, middle =
            last, last = law.NO_ROTATION}
end

-- Extremal a where the condition holds, otherwise b; compiled code has `compiled.branchless.select` instead.
function law.select(condition, a, b)
    return condition and a or b
end

-- LSR, R >= 2: onto the axis at (c, 0), straight to (X, 0), X = sqrt(R (R - 2)), right for pi - acos(1/(R - 1)).
--
-- `y` as in `external_join`, with the opposite sign for RSR; `joins` says whether c <= X.
function law.internal_join(word, y, start, joins)
    local R = start.R
    local first, c = law.onto_axis(start.x, y, 1.0, start.arc_tolerance)
    local X = sqrt(max(R * (R - 2.0), 0.0))
    local straight = R >= 2.0 and c >= 0.0 and joins and max(X - c, 0.0) or huge
    return {word = word, first = first, straight = straight, middle = law.NO_ROTATION, last = {X, -1.0}}
end

-- Right, straight, right, rm <= R - 1: the first arc is the mirror image of that of LSR.
function law.rsr(start)
    return law.internal_join(25--[[Word.RSR]], -start.y, start, start.inner <= 0.0)
end

-- Of the extremals of several pieces that begin with R, the one that can win, by rm; see `left_first`.
function law.right_first(start)
    local best = law.select(start.inner > 4.0 * start.R, law.rsl(start), law.rl(start, -1.0))
    if start.y < 0.0 then
        best = law.select(start.inner < 0.0, law.rsr(start), best)
    end
    return best
end

-- Whether a point is within a distance of a circle; `beyond2`: squared distance from the centre less radius^2.
function law.is_near_circle(beyond2, radius, distance)
    local inwards = min(distance, radius)
    return -inwards * (2.0 * radius - inwards) <= beyond2 and beyond2 <= distance * (2.0 * radius + distance)
end

-- Right along the circle of radius R - 1 about (0, 1), from within `arc_tolerance` of it: the limit of LR.
function law.r(start)
    local x, y, R, arc_tolerance, inner = start.x, start.y, start.R, start.arc_tolerance, start.inner
    local first = {law.snap_full_turn({x, y - 1.0}, (R - 1.0) * (R - 1.0), arc_tolerance)}
    local straight = R > 1.0 and law.is_near_circle(inner, R - 1.0, arc_tolerance) and 0.0 or huge
    return {word = 1--[[Word.R]], first = first, straight = straight, middle = law.NO_ROTATION, last =
            law.NO_ROTATION}
end

-- The difference a^2 - b with nearly full relative accuracy even near zero, for |a| < 2^480.
function law.square_beyond(a, b)
    local p, e = law.two_product(a, a)
    return p - b + e
end

-- `gap` and v of the quadratic 3 w^2 - 2 gap w + v = 0 of `lrl`.
function law.lrl_quadratic(start)
    local R, outer, fold = start.R, start.outer, start.fold
    local gap = -0.5 * fold - law.square_beyond(R - 1.0, 3.0)
    local v = -0.0625 * fold * (8.0 * (R + 3.0) - outer)
    return gap, v
end

-- Left to the switching curve at (xa, ya), right for more than pi to (xb, yb) on the last circle, left.
--
-- With xa / ya = -xb / yb = m and a = 1 + m^2, the circles give a ya^2 + 2 ya = k = rp^2 - 1, a yb^2 + 2 yb = K = R
-- (R + 2) and a (ya + yb) = 2; hence yb - ya = d = (K - k)/4 = -outer/4 and, for s = ya + yb = 2/a and h = (K +
-- k)/2, the larger root of 3 s^2 - 2 h s + d^2 = 0. Quantities that vanish in places are not computed as
-- differences of others: ya comes from k, and w = 2 - s = m^2 s is the smaller root of 3 w^2 - 2 gap w + v = 0 with
-- v = -`fold` ((R + 5)^2 - rp^2)/16 and gap = 6 - h = 3 - (R - 1)^2 - `fold`/2, whose terms have one sign where LRL
-- is the fastest; so LRL needs rp <= 3 - R.
function law.lrl(start)
    local x, y, R, arc_tolerance, outer, fold = start.x, start.y, start.R, start.arc_tolerance, start.outer,
            start.fold
    local k, d = x * x + y * (y + 2.0), -0.25 * outer
    local gap, v = law.lrl_quadratic(start)
    local D = gap * gap - 3.0 * v
    local exists = R <= 3.0 and fold <= 0.0 and D >= 0.0 and gap > 0.0
    local root = sqrt(max(D, 0.0))
    local above, below = 6.0 - gap + root, exists and gap + root or 1.0
    local share = 1.0 / (above * below)
    local w = v * above * share
    local a = 6.0 * below * share
    local m = sqrt(max(0.5 * a * w, 0.0))
    -- ya = k/q; every vector is multiplied by q.
    local q = 1.0 + sqrt(max(1.0 + a * k, 0.0))
    local ya, yb = k, k + d * q
    local xa, xb = m * ya, -m * yb
    local first = {law.snap_full_turn({law.rotation(xa, ya + q, x, y + 1.0)}, law.squared_distance(x, y, -1.0),
            arc_tolerance)}
    -- ya - 1 and yb - 1 from the quantities that make them small: at R = 1 both vanish on the last arc.
    local middle = {law.rotation(xa, -0.5 * (w + d) * q, xb, -0.5 * (w - d) * q)}
    local last = {-xb, yb + q}
    return {word = 55--[[Word.LRL]], first = first, straight = exists and 0.0 or huge, middle = middle, last = last}
end

-- Left, straight, right, from inside a circle of R >= 2: rp <= R - 1, that is rp^2 - (R - 3)^2 <= 4 (R - 2).
function law.lsr(start)
    return law.internal_join(27--[[Word.LSR]], start.y, start, start.fold <= 4.0 * (start.R - 2.0))
end

-- Whether an extremal ends at the target.
function law.reaches(extremal)
    return extremal.straight < huge
end

-- LR, R > 1: left to the crossing with the circle (R - 1 about (0, 1)) where x1 has `branch`'s sign; then right.
--
-- The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = -`outer` = (R + 1)^2 - rp^2, p = `fold` = rp^2 -
-- (R - 3)^2. So y1 + 1 is R + 1 - q/4 or 3 - R + p/4, and y1 - 1 is R - 1 - q/4: those forms are used whose terms
-- are no longer than the arc's radius, however small that is.
function law.lr(start, branch)
    local x, y, R, arc_tolerance, outer, fold = start.x, start.y, start.R, start.arc_tolerance, start.outer,
            start.fold
    local x1 = branch * 0.25 * sqrt(max(-outer * fold, 0.0))
    local radius2 = law.squared_distance(x, y, -1.0)
    local first = {law.snap_full_turn({law.rotation(x1, 3.0 - R + 0.25 * fold, x, y + 1.0)}, radius2,
            arc_tolerance)}
    local last = {law.snap_full_turn({x1, R - 1.0 + 0.25 * outer}, (R - 1.0) * (R - 1.0), arc_tolerance)}
    return {word = 7--[[Word.LR]], first = first, straight = R > 1.0 and outer <= 0.0 and fold >= 0.0 and 0.0 or
            huge, middle = last, last = law.NO_ROTATION}
end

-- Left, straight along the line through the centre, left: rp >= R + 1.
function law.lsl(start)
    return law.external_join(59--[[Word.LSL]], start.y, start, start.outer >= 0.0)
end

-- Of the extremals of several pieces that begin with L, the one that can win (docs/theory.md, section 4).
--
-- It is determined by rp. `detour` gives the other crossing of LR, which is not considered here.
function law.left_first(start)
    local best = law.lrl(start)
    if start.R > 1.0 then
        local inside = law.lsr(start)
        inside = law.select(law.reaches(inside), inside, law.lr(start, 1.0))
        best = law.select(start.fold <= 0.0 and start.R <= 3.0, best, inside)
    end
    if start.y < 0.0 then
        best = law.select(start.outer >= 0.0, law.lsl(start), best)
    end
    return best
end

-- Left along the last circle, radius R + 1 about (0, -1), from within `arc_tolerance` of it: the limit of RL.
function law.l(start)
    local x, y, R, arc_tolerance, outer = start.x, start.y, start.R, start.arc_tolerance, start.outer
    local first = {law.snap_full_turn({-x, y + 1.0}, (R + 1.0) * (R + 1.0), arc_tolerance)}
    local straight = law.is_near_circle(outer, R + 1.0, arc_tolerance) and 0.0 or huge
    return {word = 3--[[Word.L]], first = first, straight = straight, middle = law.NO_ROTATION, last =
            law.NO_ROTATION}
end

-- Whether the angle of a rotation is in [0, pi].
function law.is_at_most_half_turn(rotated)
    local cross = rotated[1]
    return cross >= 0.0
end

-- Whether a single arc replaces the words of which it is the limit: of at most half a turn, or of any length.
function law.is_limit(arc, any_length)
    return law.reaches(arc) and (law.is_at_most_half_turn(arc.first) or any_length)
end

-- The rotation, less half a turn where it is half a turn or more, and the count `halves` of these half turns.
function law.fold_half_turn(rotated, halves)
    local cross, dot = rotated[1], rotated[2]
    if cross < 0.0 or (cross == 0.0 and dot < 0.0) then
        return -cross, -dot, halves + 1.0
    end
    return cross, dot, halves
end

-- The sum of the angles of three rotations, in [0, 6 pi], with one arctangent.
--
-- Multiplying the vectors as complex numbers adds their angles. Each is first folded below pi, so that two of them
-- make less than a full turn and no whole turn is lost.
function law.total_angle(first, second, third)
    local c1, d1, halves = law.fold_half_turn(first, 0.0)
    local c2, d2
    c2, d2, halves = law.fold_half_turn(second, halves)
    local c, d
    c, d, halves = law.fold_half_turn({c1 * d2 + d1 * c2, d1 * d2 - c1 * c2}, halves)
    local c3, d3
    c3, d3, halves = law.fold_half_turn(third, halves)
    c, d, halves = law.fold_half_turn({c * d3 + d * c3, d * d3 - c * c3}, halves)
    return 3.141592653589793 * halves + atan(c, d)
end

-- T, the whole time of an extremal; `inf` where it does not reach the target.
function law.extremals_duration(extremal)
    return extremal.straight + law.total_angle(extremal.first, extremal.middle, extremal.last)
end

-- The least time so far and its extremal, or those of another extremal that takes less.
function law.faster_of(least, best, other)
    local time = law.extremals_duration(other)
    return time < least and time or least, law.select(time < least, other, best)
end

-- The only RL or LR with the other crossing that can win, for y < 0: its first arc ends before the axis.
function law.detour(start)
    return law.select(start.inner > 4.0 * start.R, law.rl(start, 1.0), law.lr(start, -1.0))
end

-- The least T and its extremal, among at most three words: one for each first turn, and the `detour`.
--
-- `exact` says that there is no tolerance. Then a start counts as on a last circle only if it is there up to
-- rounding, and the single arc replaces the words of which it is the limit. From y > 0 an arc of more than half a
-- turn is not optimal: L does not replace LRL there, where it would cross the axis, nor R the words from beyond the
-- last circle of L, from where, just past the target, it would be almost a whole turn. With a tolerance, where a
-- start may lie beside a circle, the single arcs compete with the other words, so that a tolerance never makes T
-- larger.
--
-- Without a tolerance no times are compared for R = 1, y >= 0 (paper, section 6): the word that begins with L wins
-- where it exists and its first arc is no longer than half a turn, up to the switching curve.
function law.fastest(x, y, R, arc_tolerance, exact)
    local start = law.start_at(x, y, R, arc_tolerance)
    local right, only_right = law.right_first(start), law.r(start)
    local left, only_left = law.left_first(start), law.l(start)
    if exact then
        left = law.select(law.is_limit(only_left, y <= 0.0), only_left, left)
        right = law.select(law.is_limit(only_right, y <= 0.0 or start.outer <= 0.0), only_right, right)
    end
    local best
    if exact and R == 1.0 and not (y < 0.0) then
        best = law.select(law.reaches(left) and law.is_at_most_half_turn(left.first), left, right)
        return law.extremals_duration(best), best
    end
    local least
    least, best = law.faster_of(law.extremals_duration(right), right, left)
    if y < 0.0 then
        least, best = law.faster_of(least, best, law.detour(start))
    end
    if not exact then
        least, best = law.faster_of(least, best, only_left)
        least, best = law.faster_of(least, best, only_right)
    end
    return least, best
end

-- The durations of the pieces in flying order, 0 past the last.
function law.durations(extremal)
    return law.angle(extremal.first), extremal.straight + law.angle(extremal.middle), law.angle(extremal.last)
end

-- The word of the controls -1, 0 or +1 of up to three pieces, in the order flown.
function law.encode(u1, u2, u3)
    return u1 + 2 + 4 * (u2 + 2) + 16 * (u3 + 2)
end

-- The word without its first piece.
function law.rest(word)
    return (word >> 2)
end

-- The word as flown: without a straight piece up to `short` and arcs up to `no_angle`; equal arcs are joined.
function law.drop_short_pieces(word, t1, t2, t3, short_, no_angle)
    local first, _, last = law.controls(word)
    if last ~= -2--[[ABSENT]] and t2 <= short_ then
        if first == last then
            word = law.encode(first, -2, -2)
            t1 = t1 + t3
            t2 = 0.0
            t3 = 0.0
        else
            word = law.encode(first, last, -2)
            t2 = t3
            t3 = 0.0
        end
    end
    local second, third
    first, second, third = law.controls(word)
    if second ~= -2--[[ABSENT]] and third == -2--[[ABSENT]] and t2 <= no_angle then
        word = law.encode(first, -2, -2)
        t2 = 0.0
    end
    if t1 <= no_angle then
        word = law.rest(word)
        t1 = t2
        t2 = t3
        t3 = 0.0
    end
    return word, t1, t2, t3
end

-- The opposite control; `ABSENT` stays as it is.
function law.opposite(u)
    return u == -2--[[ABSENT]] and u or -u
end

-- The word with L and R exchanged.
function law.mirrored(word)
    local u1, u2, u3 = law.controls(word)
    return law.encode(law.opposite(u1), law.opposite(u2), law.opposite(u3))
end

-- An extremal of the clockwise circle as the maneuver flown onto the circle of the given side.
--
-- Leaving out a piece, or an almost full turn, moves the end by at most a third of `length_tolerance`, since the
-- radius of an arc is no more than 1 + |x| + |y| + R. So three pieces together miss the target by no more than
-- `length_tolerance`.
function law.flown_entry(extremal, length_tolerance, side)
    local t1, t2, t3 = law.durations(extremal)
    local word
    word, t1, t2, t3 = law.drop_short_pieces(law.code(extremal.word), t1, t2, t3, length_tolerance / 3.0,
            7.62939453125e-06--[[ROUNDING]] / 3.0)
    return {side = side, word = side < 0 and law.mirrored(word) or word, t1 = t1, t2 = t2, t3 = t3}
end

-- The fastest maneuver onto the circle held on one side.
function law.optimum_on_side(x, y, R, side, tolerance)
    local _, best = law.fastest(x, side * y, R, law.arc_tolerance_of(x, y, R, tolerance), tolerance == 0.0)
    return law.flown_entry(best, law.rounding(x, y, R), side)
end

-- T, the whole time of a maneuver.
function law.entry_duration(maneuver)
    return maneuver.t1 + maneuver.t2 + maneuver.t3
end

-- Whether a maneuver is faster than another by more than rounding.
function law.is_faster(maneuver, other, length_tolerance)
    return law.entry_duration(maneuver) < law.entry_duration(other) - length_tolerance
end

-- The fastest maneuver onto the circle from the reduced state (x, y); to be called only where `status_of` is OK.
--
-- For *either*, the far side can be faster than the near one only within a tolerance; only then are both solved.
function law.optimum(x, y, R, side, tolerance)
    local near = law.optimum_on_side(x, y, R, law.side_or_near(y, side), tolerance)
    if side ~= 0--[[Side.EITHER]] or tolerance == 0.0 then
        return near
    end
    local far = law.optimum_on_side(x, y, R, -law.near_side(y), tolerance)
    return law.is_faster(far, near, law.rounding(x, y, R)) and far or near
end

function law._still_air_entry(state, c, s, r, radius_m, side, tolerance)
    local x, y = law.reduce(state.x / r, state.y / r, c, s)
    return law.optimum(x, y, radius_m / r, side, tolerance)
end

-- The search whose answer is known.
function law.found_at_once(entry)
    local found = {status = law.code(0--[[Status.OK]]), side = entry.side, word = entry.word, t1 = entry.t1, t2 =
            entry.t2, t3 = entry.t3, azimuth = (0.0 / 0.0), miss = (0.0 / 0.0)}
    return with_fields(law.NO_SEARCH, {stage = 5--[[ENDED]], entry = found})
end

-- R, or 1 where R is less than 1 by rounding only: a circle as tight as the aircraft can turn.
function law.rounded_radius(R)
    return 1.0 - 7.62939453125e-06--[[ROUNDING]] <= R and R < 1.0 and 1.0 or R
end

-- The search with that of the kernel begun; the entry starts along the velocity relative to the air.
function law.begin_in_air(search)
    local state, V, r, radius_m = search.state, search.turns.airspeed_m_s, search.turns.planned_m,
            law.circle_m(search)
    local vx, vy = law.flight_vector(search)
    local speed = law.length(vx, vy)
    local c, s = vx / speed, vy / speed
    if law.is_still(search) then
        -- A start beside the last arc counts as on it if half of the reserve can correct its distance.
        local tolerance = max(0.5 * (r / search.turns.tightest_m - 1.0), 0.0)
        local turn_m = law.turn_scale(search, speed) * r
        local entry = law._still_air_entry(state, c, s, turn_m, radius_m, search.side, tolerance)
        return with_fields(search, {is_begun = true, in_air = law.found_at_once(entry)})
    end
    local R, east, north = law.rounded_radius(radius_m / r), search.wind_east_m_s / V, search.wind_north_m_s / V
    local problem = {x = state.x / r, y = state.y / r, c = c, s = s, R = R, side = search.side, wx = east, wy =
            north, tolerance = 0.0}
    return with_fields(search, {is_begun = true, in_air = begin_in_wind(problem)})
end

-- Whether the last turn of an entry is opposite to that of the circle.
function law.ends_opposite(side, word)
    local u1, u2, u3 = law.controls(word)
    return (u3 ~= -2--[[ABSENT]] and u3 or u2 ~= -2--[[ABSENT]] and u2 or u1) == side
end

-- The search after at most `steps` more steps of the kernel's, up to the end of the first or second one of these.
--
-- `in_air.left` is then how many of the steps are left.
function law.advance_entry_search(search, steps)
    if not search.is_begun then
        search = law.begin_in_air(search)
    end
    search = with_fields(search, {in_air = advance_in_wind(search.in_air, steps)})
    if search.in_air.stage == 5--[[ENDED]] and not search.is_second then
        local entry = search.in_air.entry
        local is_found = entry.status == 0--[[Status.OK]] and entry.side ~= 0
        if is_found and law.ends_opposite(entry.side, entry.word) ~= search.reversing then
            search = with_fields(search, {reversing = not search.reversing, is_second = true, is_begun = false})
        end
    end
    return search
end

-- Whether the answer is known.
function law.is_complete(search)
    return search.is_begun and search.in_air.stage == 5--[[ENDED]]
end

-- The side, word and durations of a maneuver, as for still air.
function law.entry_of(maneuver)
    return {side = maneuver.side, word = maneuver.word, t1 = maneuver.t1, t2 = maneuver.t2, t3 = maneuver.t3}
end

-- The entry that a search has found; its side is 0 where there is none.
function law.found_entry(search)
    local V, r = search.turns.airspeed_m_s, search.turns.planned_m
    local vx, vy = law.flight_vector(search)
    local scale, unit_s = law.turn_scale(search, law.length(vx, vy)), r / V
    local entry = search.in_air.entry.status == 0--[[Status.OK]] and law.entry_of(search.in_air.entry) or law.NONE
    local t1_s, t2_s, t3_s = entry.t1 * unit_s, entry.t2 * unit_s, entry.t3 * unit_s
    local east, north = search.wind_east_m_s, search.wind_north_m_s
    return {side = entry.side, word = entry.word, t1_s = t1_s, t2_s = t2_s, t3_s = t3_s, turn_radius_m = scale * r,
            speed_m_s = scale * V, wind_east_m_s = east, wind_north_m_s = north}
end

-- Whether an entry flies a word, after additional pieces that take no longer than `bend_s` in all.
function law.ends_with(entry, word, bend_s)
    local without_first = law.rest(entry.word)
    if entry.word == word then
        return true
    end
    if without_first == word then
        return entry.t1_s <= bend_s
    end
    return law.rest(without_first) == word and entry.t1_s + entry.t2_s <= bend_s
end

-- Whether an entry has the first and the last control of a route.
function law.is_alike(entry, route)
    local first_u = law.controls(entry.word)
    return first_u == route.current.u and law.end_control(entry.word) == law.last_control(route)
end

-- The time until the circle is joined.
function law.duration_s(entry)
    return entry.t1_s + entry.t2_s + entry.t3_s
end

-- Whether an entry, which began `passed_s` seconds ago, should replace a plan.
--
-- Either `update` holds, and it is the same plan and not much slower; or it is faster by a margin.
--
-- In still air a plan with the same first and last turns is the same one, whether there is a line between them or
-- not. In wind additional pieces at its beginning, together no longer than `LONGEST_BEND`, do not make it a
-- different plan. The duration of a plan with tighter turns grows with their radius.
function law.is_better(entry, plan, turns, update, passed_s)
    local route, unit_s = plan.route, turns.planned_m / turns.airspeed_m_s
    local is_still = entry.wind_east_m_s == 0.0 and entry.wind_north_m_s == 0.0
    local left = law.encode(route.current.u, route.second.u, route.third.u)
    local same = entry.side == route.side and law.ends_with(entry, left, is_still and 0.0 or 0.1--[[LONGEST_BEND]] *
            unit_s)
    if is_still and update and entry.side == route.side then
        same = same or law.is_alike(entry, route)
    end
    if same and not update then
        return false
    end
    local widened = same and max(1.0, entry.turn_radius_m / route.turn_radius_m) or 1.0
    local margin_s = (same and 0.25--[[UPDATE_MARGIN]] or -0.25--[[SWITCH_MARGIN]]) * unit_s
    return law.duration_s(entry) - passed_s < widened * (plan.remaining_s + law.later_s(route)) + margin_s
end

-- The memory after a complete search, with the plan that it has found if that is better than the present one.
--
-- After the search for the first turn the one for the first plan follows.
function law.take_entry(planning, settings, limits, sensing)
    local aim, state, entry = planning.search.aim, planning.search.state, law.found_entry(planning.search)
    planning = law.drop_search(planning)
    if entry.side == 0 then
        return planning
    end
    local present = sensing.present
    if aim == 1--[[FIRST_TURN]] then
        local first = law.controls(entry.word)
        local bank_deg = first ~= -2--[[ABSENT]] and -first * limits.limit_deg or entry.side * limits.hold_deg
        local later = law.estimate_after(present, law.lead_s(limits, present.bank_deg, bank_deg))
        return law.begin_plan_search(planning, settings, limits, 2--[[ANY]], law.relative_state(settings, later),
                sensing.clock.time_s)
    end
    -- How much later it is than where the search began.
    local passed_s = aim == 2--[[ANY]] and 0.0 or planning.response.state.time_s - state.time_s
    if aim ~= 2--[[ANY]] and not law.is_better(entry, planning.plan, limits.turns, aim == 4--[[UPDATE]], passed_s)
            then
        return planning
    end
    local route, join_s = law.route_of(state, entry), state.time_s + law.duration_s(entry)
    local plan = {route = route, remaining_s = route.current.time_s, join_s = join_s, planned_join_s = join_s,
            searched_s = planning.plan.searched_s}
    planning = with_fields(planning, {plan = plan})
    return law.advance_plan(planning, settings, limits, sensing)
end

-- The memory after at most `steps` more steps of its search, with the plan that this has found.
function law.continue_search(planning, settings, limits, sensing, steps)
    local left = steps
    while planning.search.aim ~= 0--[[NOTHING]] and left > 0 do
        planning = with_fields(planning, {search = law.advance_entry_search(planning.search, left)})
        left = planning.search.in_air.left
        if law.is_complete(planning.search) then
            planning = law.take_entry(planning, settings, limits, sensing)
        end
    end
    return planning
end

-- The rate at which the vehicle turns at a bank: the inverse of `bank_for`, but in degrees per second.
function law.turn_rate_deg_s(known, bank_deg)
    return known.turn_ratio * law.rate_at_bank(bank_deg, known.airspeed_m_s) * 57.29577951308232
end

-- The memory with the safe command while there is no usable measurement, or no plan yet.
function law.without_data(memory, settings, known, dt)
    local bank_deg, route = memory.command.bank_deg, memory.planning.plan.route
    if memory.sensing.clock.since_s > 1.0--[[BLIND_S]] then
        local on_circle = route.side ~= 0 and law.is_holding(route)
        bank_deg = on_circle and route.side * memory.limits.hold_deg or 0.0
    end
    -- The limit may be lower now than when the last command was given.
    bank_deg = law.clip(bank_deg, settings.command_limit_deg)
    local rate = law.turn_rate_deg_s(known, bank_deg)
    local command = {turn_rate_deg_s = rate, bank_deg = bank_deg, phase = 3--[[NO_DATA]], time_to_join_s = (0.0 /
            0.0), side = memory.command.side, next_phase = 3--[[NO_DATA]], next_in_s = (0.0 / 0.0)}
    return with_fields(memory, {planning = law.forget_leads(memory.planning), command = command, step_s = dt})
end

-- The observer that measures the gusts along the flight anew.
function law.restart_gusts(observer)
    return with_fields(observer, {air = with_fields(observer.air, {along = law.CALM_ALONG})})
end

-- What is known, without the gusts: the turns before the circle look like gusts.
function law.measure_gusts_anew(sensing)
    return with_fields(sensing, {observer = law.restart_gusts(sensing.observer)})
end

-- The memory once it is known elsewhere that the circle was joined.
function law.forget_joining(planning)
    return with_fields(planning, {has_joined = false})
end

-- The velocity along the path: relative to the plan's steady wind; on the circle, relative to the circle.
function law.path_velocity(route, state)
    if law.is_holding(route) then
        return law.flight_velocity(state.vx, state.vy, state.hx, state.hy)
    end
    local east, north = route.wind_east_m_s, route.wind_north_m_s
    return law.flight_velocity(state.vx - east, state.vy - north, state.hx, state.hy)
end

-- The gain of course corrections in the present air; on the circle, which turns at `turn_rate`, it is smaller.
--
-- It is larger in heavy gusts, and smaller where quick turns are quicker than the bank says.
function law.corrections_gain(settings, known, observer, response_s, turn_rate, holding)
    local gain = settings.gain
    local rough, share
    if holding then
        rough = law.along_roughness(observer)
        local calm_rate = max(1.3--[[HOLD_RATE]], 6.0--[[HOLD_MULTIPLE]] * 1.2--[[HOLD_GAIN]] * turn_rate)
        local calm_share = max(min(calm_rate * response_s / gain, 0.75--[[CALM_GAIN]]), 0.35--[[CALM_HOLD_GAIN]])
        share = max(min(rough / 0.02--[[ROUGH_HOLD]] * (rough / 0.02--[[ROUGH_HOLD]]), 1.0), calm_share)
    else
        rough = law.roughness(observer)
        share = max(min(rough / 0.02--[[ROUGH_AIR]], 1.0), 0.75--[[CALM_GAIN]])
    end
    local lively = max(known.quick_turn_ratio / known.turn_ratio, 1.0)
    return gain * max(share, min(rough / 0.04--[[HEAVY_GUSTS]], 1.5--[[HEAVY_GAIN]])) / lively
end

-- The offset from the circle to correct, in air of this roughness: a large crosstrack error counts for more.
function law.steep_offset(offset, radius_m, rough)
    local beyond_m = offset.crosstrack - law.clip(offset.crosstrack, 0.035--[[STEEP_OFFSET]] * radius_m)
    local calm = max(1.0 - rough / 0.02--[[ROUGH_HOLD]], 0.0)
    return with_fields(offset, {crosstrack = offset.crosstrack + calm * beyond_m})
end

-- The rate at which the course should turn to reach a path and stay on it.
--
-- With the crosstrack error e, the course error b and small angles, e' = speed b, and b is driven towards
-- -`place_gain` e/speed with the gain `course_gain`: e'' + course_gain (e' + place_gain e) = 0. There is no
-- overshoot if `course_gain` is at least four times `place_gain`.
function law.course_rate(offset, course_gain, place_gain, speed)
    local intercept = law.clip(-place_gain * offset.crosstrack / speed, 0.6--[[STEEPEST_INTERCEPT]])
    return offset.path_rate - course_gain * (offset.course_error - intercept)
end

-- The correction of the rate of turn on the circle after another step, radians per second.
function law.next_trim(settings, trim, crosstrack, course_gain, V, dt)
    local R, turn_rate = settings.radius_m, V / settings.radius_m
    if abs(crosstrack) >= 0.05--[[TRIMMED_OFFSET]] * R then
        return trim
    end
    local place_gain = 1.2--[[HOLD_GAIN]] * turn_rate
    local integral_gain = min(0.25--[[TRIM_GAIN]] * course_gain, 0.4--[[LARGEST_TRIM_GAIN]]) * place_gain *
            place_gain / V
    return law.clip(trim + integral_gain * crosstrack * dt, 0.15--[[LARGEST_TRIM]] * turn_rate)
end

-- The turn rate through the air, for the heading (hx, hy), that turns the velocity (vx, vy) at `rate`.
--
-- A turn at the rate w with the airspeed a accelerates the vehicle by a w across its heading. The component a w
-- cos(crab) turns a velocity of the size v at the rate a w cos(crab)/v. On the circle this is equation (3) of
-- docs/wind.md, `hold.hold_rate`.
function law.air_rate(rate, vx, vy, hx, hy)
    return rate * (vx * vx + vy * vy) / (hx * vx + hy * vy)
end

-- The bank that follows the route, and the trim; on a turn before the last piece it is the bank limit.
--
-- Such a turn is planned again before it ends, unless the path is given; flying it as wide as planned would only
-- cost time.
function law.target_bank(trim, settings, limits, sensing, planning, known, dt)
    local route, observer = planning.plan.route, sensing.observer
    local u = planning.plan.route.current.u
    if u ~= 0 and route.second.u ~= -2--[[ABSENT]] and planning.path.total == 0 then
        return -u * limits.limit_deg, trim
    end
    local state, offset = planning.response.state, planning.response.offset
    local vx, vy = law.path_velocity(route, state)
    local speed, R, V, holding = law.length(vx, vy), settings.radius_m, limits.turns.airspeed_m_s,
            law.is_holding(route)
    local response_s = limits.lag_s + observer.smoothing_s
    local gain = law.corrections_gain(settings, known, observer, response_s, V / R, holding)
    local bandwidth = 1.0 / (response_s + gain * dt)
    local place_gain = holding and 1.2--[[HOLD_GAIN]] * speed / R or 0.25--[[PLACE_GAIN]] * bandwidth
    local followed = holding and law.steep_offset(offset, R, law.along_roughness(observer)) or offset
    local course = law.course_rate(followed, gain * bandwidth, place_gain, speed)
    if holding then
        trim = law.next_trim(settings, trim, offset.crosstrack, gain * bandwidth, V, dt)
        course = course - trim
    end
    local rate = -law.air_rate(course, vx, vy, state.hx, state.hy)
    -- At the present airspeed, which differs from the mean one where an autopilot holds it less exactly.
    return law.bank_at_rate(rate / known.turn_ratio, law.length(state.hx, state.hy)), trim
end

-- The command that brings the bank to a target `command_gain` times as fast as commanding the target would.
--
-- It lies beyond the target, but never beyond the bank limit.
function law.demand_deg(roll, now, target_deg, limit_deg)
    if roll.time_s == 0.0 then
        return target_deg
    end
    local change_deg = law.command_gain(roll) * (target_deg - now.bank_deg) - law.rate_gain_s(roll) * now.rate_deg_s
    return law.clip(now.bank_deg + change_deg, limit_deg)
end

-- The phase in which a control is flown; on the circle, which follows the last control, if that is absent.
function law.phase_code(u)
    return u == -2--[[ABSENT]] and 2--[[HOLD]] or u
end

-- The memory with the command for the next `dt` seconds, which follows the plan.
function law.conclude(memory, settings, vehicle, dt)
    if not memory.sensing.is_known or memory.planning.plan.route.side == 0 then
        return law.without_data(memory, settings, vehicle.estimates, dt)
    end
    if memory.planning.has_joined then
        memory = with_fields(memory, {sensing = law.measure_gusts_anew(memory.sensing)})
        memory = with_fields(memory, {planning = law.forget_joining(memory.planning)})
    end
    local limits, present, plan = memory.limits, memory.sensing.present, memory.planning.plan
    local target_deg, trim = law.target_bank(memory.trim, settings, limits, memory.sensing, memory.planning,
            vehicle.estimates, dt)
    target_deg = law.clip(target_deg, limits.limit_deg)
    local now = {bank_deg = present.bank_deg, rate_deg_s = memory.sensing.bank_rate_deg_s}
    local roll = vehicle.estimates.roll
    local bank_deg = law.demand_deg(roll, now, target_deg, limits.limit_deg)
    bank_deg = law.slewed_command(memory.sensing.command_deg, bank_deg, roll.slew_deg_s * dt)
    bank_deg = law.clip(bank_deg, settings.command_limit_deg)
    local route = plan.route
    local command = {turn_rate_deg_s = law.turn_rate_deg_s(vehicle.estimates, bank_deg), bank_deg = bank_deg, phase
            = law.phase_code(route.current.u), time_to_join_s = max(plan.join_s - present.time_s, 0.0), side =
            route.side, next_phase = law.phase_code(route.second.u), next_in_s = law.is_holding(route) and huge or
            plan.remaining_s - memory.planning.response.early_s}
    return with_fields(memory, {trim = trim, command = command, step_s = dt})
end

-- The model of a vehicle that is as declared after `dt` seconds under a command; `identify` is not needed then.
function law.fly_as_declared(vehicle, command_deg, dt)
    local revision, bank_deg, rate_deg_s, known = vehicle.revision, vehicle.bank_deg, vehicle.bank_rate_deg_s,
            vehicle.estimates
    bank_deg = law.bank_after(known.roll.time_s, known.roll.rate_deg_s, bank_deg, command_deg, dt)
    return {revision = revision, bank_deg = bank_deg, bank_rate_deg_s = rate_deg_s, estimates = known}
end

-- The fit before a measurement, or one that does not relate later measurements to earlier ones.
function law.first_slow_turns(ratio, bank_bias_deg, sums)
    return {ratio = ratio, bank_bias_deg = bank_bias_deg, sums = sums, last_deg = (0.0 / 0.0), last_rate = (0.0 /
            0.0), last_slope = (0.0 / 0.0), measured_deg = 0.0, computed_deg = 0.0, of_bias_deg = 0.0}
end

-- The fit before a measurement, or one that does not relate later measurements to earlier ones.
function law.first_quick_turns(ratio, fit)
    return {ratio = ratio, fit = fit, last_deg = (0.0 / 0.0), last_rate_deg_s = (0.0 / 0.0), measured_deg = 0.0,
            computed_deg = 0.0, measured_mean = law.NO_VALUE, computed_mean = law.NO_VALUE}
end

-- The fit before a measurement, or one that does not relate later measurements to earlier ones.
function law.first_lead(lead_s, fit)
    return {lead_s = lead_s, fit = fit, angle = law.NO_VALUE, rate = law.NO_VALUE}
end

-- The fits before a measurement, with what is declared.
function law.first_turns(turn_ratio, lead_s)
    return {slow = law.first_slow_turns(turn_ratio, 0.0, law.NO_TURNS), quick = law.first_quick_turns(turn_ratio,
            law.NO_PAIRS), lead = law.first_lead(lead_s, law.NO_PAIRS)}
end

-- The fits, which do not relate later measurements to earlier ones.
function law.restart_turns(turns)
    local slow, quick, lead = turns.slow, turns.quick, turns.lead
    return {slow = law.first_slow_turns(slow.ratio, slow.bank_bias_deg, slow.sums), quick =
            law.first_quick_turns(quick.ratio, quick.fit), lead = law.first_lead(lead.lead_s, lead.fit)}
end

-- The angle from one direction to another, from -180 to below 180 degrees.
function law.turn_between_deg(from_deg, to_deg)
    return (to_deg - from_deg + 180.0) % 360.0 - 180.0
end

-- A filtered value `dt` seconds later, where the input has changed; the filter has a time, seconds.
function law.high_pass(filtered, change, dt, time_s)
    return exp(-dt / time_s) * (filtered + change)
end

-- A ratio of turns within its bounds.
function law.bounded_turn_ratio(ratio)
    return min(max(ratio, 0.6--[[LEAST_TURN_RATIO]]), 3.0--[[LARGEST_TURN_RATIO]])
end

-- The ratio and the bank bias, degrees, from the sums and what is declared.
function law.solve_turns(sums, declared)
    local error = 0.7--[[TURN_ERROR_DEG]] * 0.7--[[TURN_ERROR_DEG]] * 3.0--[[TURN_FILTER_S]]
    local ratio_prior = error / (0.15--[[TURN_RATIO_SPREAD]] * 0.15--[[TURN_RATIO_SPREAD]])
    local bias_prior = error / (1.5--[[BANK_BIAS_SPREAD_DEG]] * 1.5--[[BANK_BIAS_SPREAD_DEG]])
    local xx, xu, uu = sums.xx + ratio_prior, sums.xu, sums.uu + bias_prior
    local xy, uy = sums.xy + ratio_prior * declared, sums.uy
    local determinant = xx * uu - xu * xu
    local ratio = law.bounded_turn_ratio((uu * xy - xu * uy) / determinant)
    return ratio, law.clip((xx * uy - xu * xy) / (determinant * ratio), 6.0--[[LARGEST_BANK_BIAS_DEG]])
end

-- The fit with a measured heading, bank and airspeed, `dt` seconds after the last.
function law.add_slow_turn(turns, declared, state, dt)
    -- Degrees per second, and degrees per second for each degree of bank: tan(45 degrees) is 1.
    local rate = law.rate_at_bank(state.bank_deg, state.airspeed_m_s) * 57.29577951308232
    local cosine = cos(state.bank_deg * 0.017453292519943295)
    local slope = law.rate_at_bank(45.0, state.airspeed_m_s) / (cosine * cosine)
    local turned, computed, of_bias = 0.0, 0.0, 0.0
    if turns.last_deg == turns.last_deg then
        turned = law.turn_between_deg(turns.last_deg, state.heading_deg)
        computed = 0.5 * dt * (turns.last_rate + rate)
        of_bias = -0.5 * dt * (turns.last_slope + slope)
    end
    local y = law.high_pass(turns.measured_deg, turned, dt, 3.0--[[TURN_FILTER_S]])
    local x = law.high_pass(turns.computed_deg, computed, dt, 3.0--[[TURN_FILTER_S]])
    local u = law.high_pass(turns.of_bias_deg, of_bias, dt, 3.0--[[TURN_FILTER_S]])
    local kept, xx, xu, uu, xy, uy = exp(-dt / 60.0--[[TURN_MEMORY_S]]), turns.sums.xx, turns.sums.xu,
            turns.sums.uu, turns.sums.xy, turns.sums.uy
    local sums = {xx = kept * xx + dt * x * x, xu = kept * xu + dt * x * u, uu = kept * uu + dt * u * u, xy = kept *
            xy + dt * x * y, uy = kept * uy + dt * u * y}
    local ratio, bank_bias_deg = law.solve_turns(sums, declared)
    return {ratio = ratio, bank_bias_deg = bank_bias_deg, sums = sums, last_deg = state.heading_deg, last_rate =
            rate, last_slope = slope, measured_deg = y, computed_deg = x, of_bias_deg = u}
end

-- The filter after a value, `dt` seconds after the last.
function law.filter_value(before, value, dt, time_s)
    local change = before.last == before.last and value - before.last or 0.0
    return {value = law.high_pass(before.value, change, dt, time_s), last = value}
end

-- The sums of which a share is kept, with a pair that counts for so many seconds.
function law.add_pair(fit, y, x, seconds, kept)
    return {product = kept * fit.product + seconds * y * x, square = kept * fit.square + seconds * x * x}
end

-- The ratio; `prior` is how much the declared one weighs, in x^2 s.
function law.ratio_of(fit, declared, prior)
    return (fit.product + declared * prior) / (fit.square + prior)
end

-- The fit with a direction and the turn rate of a coordinated turn, `dt` seconds after the last.
function law.add_quick_turn(turns, declared, direction_deg, rate_deg_s, dt)
    local measured, computed = 0.0, 0.0
    if turns.last_deg == turns.last_deg then
        measured = law.turn_between_deg(turns.last_deg, direction_deg)
        computed = 0.5 * dt * (turns.last_rate_deg_s + rate_deg_s)
    end
    local measured_deg = law.high_pass(turns.measured_deg, measured, dt, 0.3--[[QUICK_FILTER_S]])
    local computed_deg = law.high_pass(turns.computed_deg, computed, dt, 0.3--[[QUICK_FILTER_S]])
    local measured_mean = law.filter_value(turns.measured_mean, measured_deg, dt, 0.5--[[QUICK_MEAN_S]])
    local computed_mean = law.filter_value(turns.computed_mean, computed_deg, dt, 0.5--[[QUICK_MEAN_S]])
    local y, x = measured_mean.value, computed_mean.value
    local excess = max(abs(x) / 0.5--[[QUICK_SATURATION_DEG]], 1.0)
    local fit = law.add_pair(turns.fit, y, x, dt / (excess * excess), exp(-dt / 6.0--[[QUICK_MEMORY_S]]))
    local prior = 0.5--[[QUICK_ERROR_DEG]] * 0.5--[[QUICK_ERROR_DEG]] * 0.3--[[QUICK_FILTER_S]] /
            (0.5--[[QUICK_RATIO_SPREAD]] * 0.5--[[QUICK_RATIO_SPREAD]])
    return {ratio = law.bounded_turn_ratio(law.ratio_of(fit, declared, prior)), fit = fit, last_deg = direction_deg,
            last_rate_deg_s = rate_deg_s, measured_deg = measured_deg, computed_deg = computed_deg, measured_mean =
            measured_mean, computed_mean = computed_mean}
end

-- The fit with a measurement `dt` seconds after the last, in a wind.
function law.add_course(lead, declared_s, state, turn_ratio, wind, dt)
    local c, s = law.heading_vector(state.heading_deg)
    local east, north = state.velocity_east_m_s - wind.east_m_s, state.velocity_north_m_s - wind.north_m_s
    -- Both positive to the right.
    local angle = law.filter_value(lead.angle, atan(east * s - north * c, east * c + north * s), dt,
            1.5--[[LEAD_FILTER_S]])
    local turn_rate = turn_ratio * law.rate_at_bank(state.bank_deg, state.airspeed_m_s)
    local rate = law.filter_value(lead.rate, turn_rate, dt, 1.5--[[LEAD_FILTER_S]])
    local fit = law.add_pair(lead.fit, angle.value, rate.value, dt, exp(-dt / 30.0--[[LEAD_MEMORY_S]]))
    local prior = 0.03--[[DIRECTION_ERROR]] * 0.03--[[DIRECTION_ERROR]] / (0.1--[[LEAD_SPREAD_S]] *
            0.1--[[LEAD_SPREAD_S]])
    return {lead_s = law.clip(law.ratio_of(fit, declared_s, prior), 0.4--[[LARGEST_LEAD_S]]), fit = fit, angle =
            angle, rate = rate}
end

-- The fits with a measurement `dt` seconds after the last, and with the same state without its biases.
function law.add_turn(turns, declared, measurement, state, wind, dt)
    local slow = law.add_slow_turn(turns.slow, declared.turn_ratio, measurement, dt)
    local rate_deg_s = law.rate_at_bank(state.bank_deg, state.airspeed_m_s) * 57.29577951308232
    local course_deg = atan(state.velocity_east_m_s - wind.east_m_s, state.velocity_north_m_s - wind.north_m_s) *
            57.29577951308232
    local quick = law.add_quick_turn(turns.quick, declared.turn_ratio, course_deg, rate_deg_s, dt)
    local lead = law.add_course(turns.lead, declared.course_lead_s, state, slow.ratio, wind, dt)
    return {slow = slow, quick = quick, lead = lead}
end

-- The average over `AIRSPEED_MEMORY_S` at most, including a value measured `dt` seconds after the last.
function law.update_average(average, value, dt)
    local known_s = min(average.known_s + max(dt, 0.001), 20.0--[[AIRSPEED_MEMORY_S]])
    return {value = average.value + min(dt / known_s, 1.0) * (value - average.value), known_s = known_s}
end

-- The airspeeds including a state, `dt` seconds after the last.
function law.update_airspeeds(settings, airspeeds, state, dt)
    local always, in_turns = airspeeds.always, airspeeds.in_turns
    if abs(state.bank_deg) > 0.7--[[TIGHT_SHARE]] * settings.limit_deg then
        in_turns = law.update_average(in_turns, state.airspeed_m_s, dt)
    end
    return {always = law.update_average(always, state.airspeed_m_s, dt), in_turns = in_turns}
end

-- The scene of a problem, with the arc tolerance that rounding requires; negligible wind is treated as zero.
function law.scene_of(problem)
    local x, y, c, s, R, wx, wy = problem.x, problem.y, problem.c, problem.s, problem.R, problem.wx, problem.wy
    if law.length(wx, wy) < 1.7763568394002505e-15--[[NEGLIGIBLE_WIND]] then
        wx = 0.0
        wy = 0.0
    end
    return {x = x, y = y, c = c, s = s, R = R, wx = wx, wy = wy, arc_tolerance = law.rounding(x, y, R) / 3.0}
end

-- The direction of the wind as a unit vector; (1, 0) in still air, and in a wind too light to have one.
function law.downwind(wx, wy)
    local wind = law.length(wx, wy)
    local chosen_1 = wind >= 1.7763568394002505e-15--[[NEGLIGIBLE_WIND]]
    return chosen_1 and wx / wind or 1.0, chosen_1 and wy / wind or 0.0
end

-- The pose on the circle at a phase, (1) and (2): heading and wind add up to a velocity along the circle.
function law.hold_pose(phase, side, R, wx, wy)
    local dx, dy = law.downwind(wx, wy)
    local a, b = -cos(phase), side * sin(phase)
    local tx, ty = a * dx - b * dy, a * dy + b * dx
    local nx, ny = -side * ty, side * tx
    local out = wx * nx + wy * ny
    local crab = sqrt((1.0 - out) * (1.0 + out))
    return R * nx, R * ny, crab * tx - out * nx, crab * ty - out * ny, crab + wx * tx + wy * ty
end

-- The time at which a straight flight at speed 1 meets a point that starts at d and moves with -w: t = |d - w t|.
--
-- The positive root of (1 - w^2) t^2 + 2 (w . d) t = d^2, in the form without cancellation.
function law.interception(dx, dy, wx, wy)
    local along, spare, square = wx * dx + wy * dy, 1.0 - wx * wx - wy * wy, dx * dx + dy * dy
    local root = sqrt(along * along + spare * square)
    if along < 0.0 then
        return (root - along) / spare
    end
    return square > 0.0 and square / (root + along) or 0.0
end

-- The set that contains only a word of three pieces: LSL, RSR, LSR, RSL, LRL and RLR are its bits, lowest first.
function law.set_of(word)
    local first, middle, last = law.controls(word)
    local lowest = middle ~= 0 and 16 or first == last and 1 or 4
    return first > 0 and lowest or 2 * lowest
end

-- The duration of an arc; zero where it is less than a full turn by at most `arc_tolerance` at the given radius.
function law.arc_time(rotation, radius, arc_tolerance)
    return law.angle({law.snap_full_turn(rotation, radius * radius, arc_tolerance)})
end

-- The first arc of LSL or RSR, whose arcs add up to `arcs`; one of them is zero where it falls short by rounding.
--
-- The straight piece moves by its own length alone as it turns: the shorter it is, the less is known of its
-- direction.
function law.first_of_same_turns(first, arcs, straight, arc_tolerance)
    local beyond, short_ = first - arcs, 6.283185307179586--[[TWO_PI]] - first
    if beyond > arc_tolerance and straight * min(beyond, short_) <= 3.0 * arc_tolerance then
        return beyond < short_ and arcs or 0.0
    end
    return first
end

-- The first LSL (u = +1) or RSR whose time is at most `until`.
--
-- t1 + t3 is the rotation from start to pose, or a turn more, and t2 an interception.
function law.lsl_rsr(u, dx, dy, ends, until_)
    local c0, s0, c, s, wx, wy, arc_tolerance = ends.c0, ends.s0, ends.c, ends.s, ends.wx, ends.wy,
            ends.arc_tolerance
    local rotation = law.arc_time({law.arc_rotation(u, c0, s0, c, s)}, 1.0, arc_tolerance)
    local each_arcs_1 = {rotation, rotation + 6.283185307179586--[[TWO_PI]]}
    for i_1 = 1, 2 do
        local arcs = each_arcs_1[i_1]
        local ax, ay = dx - wx * arcs, dy - wy * arcs
        local straight = law.interception(ax, ay, wx, wy)
        if arcs + straight > until_ + 0.0008127493386077178--[[ALMOST]] then
            break
        end
        local ex, ey = ax - wx * straight, ay - wy * straight
        local first = law.arc_time({law.arc_rotation(u, c0, s0, ex, ey)}, 1.0 + straight, arc_tolerance)
        first = law.first_of_same_turns(first, arcs, straight, arc_tolerance)
        local last = max(arcs - first, 0.0)
        if first <= arcs + arc_tolerance and straight * (last - 6.283185307179586--[[TWO_PI]]) <= 3.0 *
                arc_tolerance then
            local distance = law.length(ex, ey)
            -- Where the two circles coincide, any direction of p is possible.
            local chosen_1 = distance > 0.0
            local p1, p2 = chosen_1 and ex / distance or 1.0, chosen_1 and ey / distance or 0.0
            return {time = first + straight + last, word = law.encode(u, 0, u), t1 = first, t2 = straight, t3 =
                    last, lam = 1.0, p1 = p1, p2 = p2}
        end
    end
    return law.NO_PATH
end

-- The path that takes less time: a where they tie, or where b takes longer than `until`.
function law.faster_path(a, b, until_)
    return b.time < a.time and b.time <= until_ and b or a
end

-- The interval of times t >= 0 in which |d - w t| < limit; both ends are `inf` where there is none.
function law.time_within(dx, dy, wx, wy, limit)
    local along, square, gap = wx * dx + wy * dy, wx * wx + wy * wy, dx * dx + dy * dy - limit * limit
    local discriminant = along * along - square * gap
    if gap >= 0.0 and (along <= 0.0 or discriminant <= 0.0) then
        return huge, huge
    end
    local root = sqrt(discriminant)
    if gap >= 0.0 then
        return gap / (along + root), (along + root) / square
    end
    if along > 0.0 then
        return 0.0, (along + root) / square
    end
    return 0.0, root > along and -gap / (root - along) or huge
end

-- The straight piece of LSR (u = +1) or RSL between circles whose centres are d apart: length and direction.
function law.tangent(u, dx, dy)
    local square = dx * dx + dy * dy
    local straight = sqrt(max(square - 4.0, 0.0))
    return straight, (straight * dx - 2.0 * u * dy) / square, (straight * dy + 2.0 * u * dx) / square
end

-- By how much each arc of LSR (u = +1) or RSL grows in an interval, continued beyond whole turns.
function law.arc_growth(u, dx, dy, ends, interval)
    local begin, end_ = interval[1], interval[2]
    local _, e1, e2 = law.tangent(u, dx - ends.wx * begin, dy - ends.wy * begin)
    -- In the end the straight piece points against the wind.
    local p1, p2 = -ends.wx, -ends.wy
    if end_ < huge then
        local _
        _, p1, p2 = law.tangent(u, dx - ends.wx * end_, dy - ends.wy * end_)
    end
    local turned = abs(atan(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2))
    return u * (ends.wx * e2 - ends.wy * e1) >= 0.0 and turned or -turned
end

-- 1 where an arc exceeds a limit, or almost: the ends of arcs are known up to rounding only; otherwise 0.
function law.passes(arc, limit)
    return arc > limit - 0.0008127493386077178--[[ALMOST]] and 1 or 0
end

-- The time in an interval at which the length of LSR or RSL equals T; any later time where there is none.
--
-- `arcs` is the sum of the durations of its two arcs at the beginning of the interval.
function law.lsr_rsl_root(u, dx, dy, ends, arcs, interval)
    local wx, wy = ends.wx, ends.wy
    local begin, end_ = interval[1], interval[2]
    local straight, e1, e2 = law.tangent(u, dx - wx * begin, dy - wy * begin)
    local time, p1, p2, turned = begin, e1, e2, 0.0
    for _ = 0, 60--[[NEWTON_STEPS]] - 1 do
        local step = (arcs + turned + straight - time) / (1.0 + wx * p1 + wy * p2)
        local before = time
        time = time + step
        local across = (wx * p2 - wy * p1) * step
        -- The next step would be `across`^2 / (2 straight (1 + w . p)).
        if time <= before or time > end_ or across * across <= 1.862645149230957e-09--[[NO_STEP]] * straight * time
                then
            break
        end
        straight, p1, p2 = law.tangent(u, dx - wx * time, dy - wy * time)
        -- The direction turns one way only, by no more than pi in all.
        turned = 2.0 * u * atan(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2)
    end
    return time
end

-- The LSR or RSL at the first root in an interval throughout which the centres are at least two radii apart.
--
-- With its arcs continued beyond whole turns, length - T is convex and falls with the slope -(1 + w . p). So for
-- each number of turns it has at most one root, and Newton's method converges to it from the beginning of the
-- interval.
function law.first_lsr_rsl(u, dx, dy, ends, interval)
    local c0, s0, c, s, wx, wy, arc_tolerance = ends.c0, ends.s0, ends.c, ends.s, ends.wx, ends.wy,
            ends.arc_tolerance
    local begin, end_ = interval[1], interval[2]
    local straight, e1, e2 = law.tangent(u, dx - wx * begin, dy - wy * begin)
    local first, last = law.angle({law.arc_rotation(u, c0, s0, e1, e2)}), law.angle({law.arc_rotation(u, c, s, e1,
            e2)})
    local arcs, growth = first + last, law.arc_growth(u, dx, dy, ends, interval)
    -- An arc that grows beyond a whole turn loses it, one that shrinks below zero gains one.
    local least, most = min(first, last) + growth, max(first, last) + growth
    local fewest = max(-law.passes(least, 6.283185307179586--[[TWO_PI]]) - law.passes(most,
            6.283185307179586--[[TWO_PI]]), integer_of((begin - arcs - straight) / 6.283185307179586--[[TWO_PI]]))
    local gained = law.passes(-least, 0.0) + law.passes(-most, 0.0)
    for turns = fewest, gained + 1 - 1 do
        local time = law.lsr_rsl_root(u, dx, dy, ends, arcs + 6.283185307179586--[[TWO_PI]] * turns, interval)
        if time > end_ then
            break
        end
        local p1, p2
        straight, p1, p2 = law.tangent(u, dx - wx * time, dy - wy * time)
        first = law.arc_time({law.arc_rotation(u, c0, s0, p1, p2)}, 1.0 + straight, arc_tolerance)
        last = law.arc_time({law.arc_rotation(u, c, s, p1, p2)}, 1.0, arc_tolerance)
        if abs(first + straight + last - time) < 3.141592653589793 then
            return {time = first + straight + last, word = law.encode(u, 0, -u), t1 = first, t2 = straight, t3 =
                    last, lam = 1.0, p1 = p1, p2 = p2}
        end
    end
    return law.NO_PATH
end

-- The first LSR (u = +1) or RSL whose time is at most `until`; the centres must be at least two radii apart.
function law.lsr_rsl(u, dx, dy, ends, until_)
    -- Circles that overlap by rounding count as touching: two arcs without a straight piece.
    local enter, leave = law.time_within(dx, dy, ends.wx, ends.wy, 2.0 - ends.arc_tolerance)
    local path = law.NO_PATH
    if enter > 0.0 then
        path = law.first_lsr_rsl(u, dx, dy, ends, {0.0, min(enter, until_)})
    end
    if path.time == huge and leave < until_ then
        path = law.first_lsr_rsl(u, dx, dy, ends, {leave, until_})
    end
    return path
end

-- The m in (0, 2 pi) at which h(m) = |d - 2 w m|^2 - 8 (1 - cos m) rises through zero.
--
-- `inf` where it does not, or not within an interval. h'' = 8 (w^2 - cos m), and h >= 0 at 0 and 2 pi. With i =
-- acos(w^2), h is concave up to i and has no such root there. It is convex up to 2 pi - i and may have one there;
-- if it is negative at 2 pi - i, it has one beyond, where it is concave.
function law.middle_arc(dx, dy, wx, wy, within)
    local inflection = acos(wx * wx + wy * wy)
    local least, most = within[1], within[2]
    least = max(least, inflection)
    local outer = 6.283185307179586--[[TWO_PI]] - inflection
    local m, concave = min(outer, most), false
    for step = 0, 60--[[NEWTON_STEPS]] - 1 do
        if m < least and not concave then
            return huge
        end
        local x, y = dx - 2.0 * m * wx, dy - 2.0 * m * wy
        local across, along = sin(0.5 * m), cos(0.5 * m)
        local h = x * x + y * y - 16.0 * across * across
        local slope = -4.0 * (wx * x + wy * y) - 16.0 * across * along
        if step == 0 then
            concave = h < 0.0
        end
        -- The root lies beyond `most` where h is still negative there.
        if slope <= 0.0 or (concave and m >= most) then
            return huge
        end
        local before = m
        m = m - h / slope
        if concave and m <= before or not concave and m >= before then
            break
        end
    end
    return m
end

-- LRL or RLR with a given middle arc between circles whose centres are d = -4 sin(m/2) p apart.
function law.three_arcs(u, middle, dx, dy, ends)
    local c0, s0, c, s, arc_tolerance = ends.c0, ends.s0, ends.c, ends.s, ends.arc_tolerance
    local distance = law.length(dx, dy)
    local chosen_1 = distance > 0.0
    local p1, p2 = chosen_1 and -dx / distance or 1.0, chosen_1 and -dy / distance or 0.0
    local lam, across = -cos(0.5 * middle), sin(0.5 * middle)
    -- The headings at the two switches: p turned by the angle whose cosine is lambda, against the sense of the outer
    -- arcs at the first switch and in their sense at the second.
    local ax, ay = lam * p1 + u * across * p2, lam * p2 - u * across * p1
    local bx, by = lam * p1 - u * across * p2, lam * p2 + u * across * p1
    local first = law.arc_time({law.arc_rotation(u, c0, s0, ax, ay)}, 4.0, arc_tolerance)
    local last = law.arc_time({law.arc_rotation(u, bx, by, c, s)}, 1.0, arc_tolerance)
    return {time = first + middle + last, word = law.encode(u, -u, u), t1 = first, t2 = middle, t3 = last, lam =
            lam, p1 = p1, p2 = p2}
end

-- The first LRL (u = +1) or RLR whose time T is at most `until`: T = 2 t2 + rotation from start to pose + turns.
--
-- Only a path with p . w + lambda >= 0 can be the first; for each number of whole turns there is at most one such
-- path.
function law.lrl_rlr(u, dx, dy, ends, until_)
    local c0, s0, c, s, wx, wy, arc_tolerance = ends.c0, ends.s0, ends.c, ends.s, ends.wx, ends.wy,
            ends.arc_tolerance
    local enter, leave = law.time_within(dx, dy, wx, wy, 4.0)
    local best = law.NO_PATH
    if enter <= until_ then
        local rotation = law.arc_time({law.arc_rotation(u, c0, s0, c, s)}, 1.0, arc_tolerance)
        local each_turns_1 = {-1.0, 0.0, 1.0}
        for i_1 = 1, 3 do
            local turns = each_turns_1[i_1]
            local outside = rotation + 6.283185307179586--[[TWO_PI]] * turns
            local limit = min(leave + arc_tolerance, until_, best.time)
            local within = {0.5 * (enter - outside) - 0.0008127493386077178--[[ALMOST]], 0.5 * (limit - outside) +
                    0.0008127493386077178--[[ALMOST]]}
            local middle = law.middle_arc(dx - wx * outside, dy - wy * outside, wx, wy, within)
            local time = outside + 2.0 * middle
            if huge > time and (enter - arc_tolerance <= time and time <= limit) then
                local path = law.three_arcs(u, middle, dx - wx * time, dy - wy * time, ends)
                if abs(path.time - time) < 3.141592653589793 then
                    best = path
                end
            end
        end
    end
    return best
end

-- The first path to a point of joining of a set of words; `NO_PATH` where it takes longer than `until`.
function law.first_path_of(words, phase, side, scene, until_)
    local x, y, c0, s0, R, wx, wy, arc_tolerance = scene.x, scene.y, scene.c, scene.s, scene.R, scene.wx, scene.wy,
            scene.arc_tolerance
    local px, py, c, s = law.hold_pose(phase, side, R, wx, wy)
    local dx, dy = px - x, py - y
    local best = law.NO_PATH
    if law.interception(dx, dy, wx, wy) <= until_ + arc_tolerance then
        local ends = {c0 = c0, s0 = s0, c = c, s = s, wx = wx, wy = wy, arc_tolerance = arc_tolerance}
        -- The vectors are those from the centre of the first arc to that of the last. The words that take least to find
        -- are tried first.
        local path
        local each_u_1 = {1, -1}
        for i_1 = 1, 2 do
            local u = each_u_1[i_1]
            if (words & law.set_of(law.encode(u, 0, u))) ~= 0 then
                path = law.lsl_rsr(u, dx - u * (s - s0), dy + u * (c - c0), ends, min(until_, best.time))
                best = law.faster_path(best, path, until_)
            end
        end
        local each_u_2 = {1, -1}
        for i_2 = 1, 2 do
            local u = each_u_2[i_2]
            if (words & law.set_of(law.encode(u, 0, -u))) ~= 0 then
                path = law.lsr_rsl(u, dx + u * (s + s0), dy - u * (c + c0), ends, min(until_, best.time))
                best = law.faster_path(best, path, until_)
            end
        end
        local each_u_3 = {1, -1}
        for i_3 = 1, 2 do
            local u = each_u_3[i_3]
            if (words & law.set_of(law.encode(u, -u, u))) ~= 0 then
                path = law.lrl_rlr(u, dx - u * (s - s0), dy + u * (c - c0), ends, min(until_, best.time))
                best = law.faster_path(best, path, until_)
            end
        end
    end
    return best
end

-- The size of the rate of turn that holds the circle at a phase: g^2 / (R cos(crab)), (3).
function law.hold_rate(phase, side, R, wx, wy)
    local _, _, c, s, g = law.hold_pose(phase, side, R, wx, wy)
    return g * g / (R * (g - (wx * (c + wx) + wy * (s + wy)) / g))
end

-- The derivative of the time of the path with respect to the point of joining, in units of hold time, (6).
--
-- It is zero where the adjoint is transversal to the circle, and it never exceeds 1.
function law.join_slope(path, phase, side, scene)
    local _, _, c, s = law.hold_pose(phase, side, scene.R, scene.wx, scene.wy)
    local along, drift = path.p1 * c + path.p2 * s, path.p1 * scene.wx + path.p2 * scene.wy
    local _, _, last = law.controls(path.word)
    local rate = side * last * law.hold_rate(phase, side, scene.R, scene.wx, scene.wy)
    return (along + drift - rate * (path.lam - along)) / (path.lam + drift)
end

-- The point of joining at a phase, for a set of words.
function law.join_point(words, phase, side, scene)
    local path = law.first_path_of(words, phase, side, scene, huge)
    return {phase = phase, path = path, slope = law.join_slope(path, phase, side, scene)}
end

-- The point of joining after another step of the search, and the path there; its side is 0 where none is known.
function law.track(known, problem)
    local scene, best = law.scene_of(problem), law.NO_PATH
    local side, phase, words, shift, calls = known.side, known.phase, known.words, known.shift, known.calls
    local path
    if side ~= 0 and (problem.side == side or problem.side == 0) then
        local here = law.join_point(words, phase, side, scene)
        best = here.path
        if calls % 2 == 0 then
            local beside = here.slope > 0.0 and phase - shift or phase + shift
            path = law.first_path_of(law.set_of(best.word), beside, side, scene, best.time)
            if path.time < best.time then
                phase = beside
                best = path
            else
                shift = max(0.5 * shift, 0.01--[[LEAST_SHIFT]])
            end
        end
    end
    if calls % 2 == 1 or best.time == huge then
        local one = problem.side ~= 0 and problem.side or calls % 4 < 2 and 1 or -1
        local anywhere = calls * 0.6180339887498949--[[GOLDEN]] % 1.0 * 6.283185307179586--[[TWO_PI]]
        path = law.first_path_of(63--[[ALL_WORDS]], anywhere, one, scene, best.time)
        if path.time < best.time then
            side = one
            phase = anywhere
            shift = 0.2--[[FIRST_SHIFT]]
            best = path
        end
    end
    calls = (calls + 1) % 1024--[[ROUND]]
    if best.time == huge then
        return {side = 0, phase = 0.0, words = 0, shift = 0.2--[[FIRST_SHIFT]], calls = calls}, {side = 0, word =
                law.code(0--[[Word.EMPTY]]), t1 = 0.0, t2 = 0.0, t3 = 0.0}
    end
    local _, _, last = law.controls(best.word)
    words = last > 0 and 25--[[ENDS_WITH_L]] or 38--[[ENDS_WITH_R]]
    local word, t1, t2, t3 = law.drop_short_pieces(best.word, best.t1, best.t2, best.t3, scene.arc_tolerance,
            7.62939453125e-06--[[ROUNDING]])
    return {side = side, phase = phase, words = words, shift = shift, calls = calls}, {side = side, word = word, t1
            = t1, t2 = t2, t3 = t3}
end
end

-- The instructions of a callback are limited (SCR_VM_I_COUNT). So a search has callbacks of its own, between two steps
-- of the law. In wind the point of joining is remembered, and each of these callbacks improves it: for the problem of
-- the law's search, or for the last problem where the law makes none.
local known_join = {side = 0, phase = 0.0, words = 0, shift = 0.2, calls = 0}
local last_problem, searches = nil, 0

local function improve_join(problem)
    local entry
    known_join, entry = law.track(known_join, problem)
    last_problem, searches = problem, searches + 1
    entry.status = entry.side == 0 and 12 or 0
    return entry
end

begin_in_wind = function(problem)
    return {stage = 0, problem = problem}
end

advance_in_wind = function(search)
    local entry = search.entry
    if search.stage ~= 5 then
        entry = improve_join(search.problem)
    end
    return {stage = 5, left = 0, entry = entry}
end

-- The flight that is prepared or flown; and whether the switch must be moved before the next one.
local flight, is_latched = nil, true

-- When the last step began, and how many callbacks for searches there have been since then.
local begun_ms, slot = nil, 0

-- The mean equivalent airspeed in the present mode.
local mean_airspeed = {}

-- How the plane turns, and when that was last measured.
local turns, learned_ms = law.first_turns(0.95, 0.0), nil

local function say(severity, text)
    gcs:send_text(severity, "Entry: " .. text)
end

local function wrap_180(angle_deg)
    return (angle_deg + 180.0) % 360.0 - 180.0
end

local function bearing_deg(north, east)
    return math.deg(math.atan(east, north))
end

-- The present state; nil where something is missing.
local function measure()
    local place, velocity, wind = ahrs:get_location(), ahrs:get_velocity_NED(), ahrs:wind_estimate()
    local equivalent, ratio = ahrs:airspeed_EAS(), ahrs:get_EAS2TAS()
    if not ahrs:healthy() or not place or not velocity or not wind or not equivalent or not ratio then
        return nil
    end
    return {
        now_ms = millis(), place = place, velocity_east_m_s = velocity:y(), velocity_north_m_s = velocity:x(),
        wind_east_m_s = wind:y(), wind_north_m_s = wind:x(), ratio = ratio, airspeed_m_s = equivalent * ratio,
        heading_deg = math.deg(ahrs:get_yaw_rad()) % 360.0, bank_deg = math.deg(ahrs:get_roll_rad()),
    }
end

-- What the law is given: metres from the centre of the circle, seconds since the flight was prepared.
local function relative(now)
    local offset = flight.centre:get_distance_NE(now.place)
    return {
        time_s = (now.now_ms - flight.since_ms):tofloat() * 0.001, east_m = offset:y(), north_m = offset:x(),
        heading_deg = now.heading_deg, bank_deg = now.bank_deg, velocity_east_m_s = now.velocity_east_m_s,
        velocity_north_m_s = now.velocity_north_m_s, airspeed_m_s = now.airspeed_m_s,
    }
end

-- Measure how the plane turns; whether that is due.
local function measure_turns(now)
    if not vehicle:get_likely_flying() or not (now.airspeed_m_s > 1.0) then
        return false
    end
    local dt = learned_ms and (now.now_ms - learned_ms):tofloat() * 0.001 or math.huge
    if dt < LEARN_S then
        return false
    elseif dt > RELATED_S then
        turns, dt = law.restart_turns(turns), 0.0
    end
    learned_ms = now.now_ms
    local state = {
        heading_deg = now.heading_deg, bank_deg = now.bank_deg - turns.slow.bank_bias_deg,
        airspeed_m_s = now.airspeed_m_s,
        velocity_east_m_s = now.velocity_east_m_s, velocity_north_m_s = now.velocity_north_m_s,
    }
    local declared = {turn_ratio = 0.95, course_lead_s = 0.0}
    local wind = {east_m_s = now.wind_east_m_s, north_m_s = now.wind_north_m_s}
    turns = law.add_turn(turns, declared, now, state, wind, dt)
    return true
end

-- Measure the airspeed that the present mode holds.
local function measure_airspeed(now, mode)
    local equivalent_m_s = now.airspeed_m_s / now.ratio
    if mean_airspeed.mode ~= mode then
        mean_airspeed = {mode = mode, value = equivalent_m_s, time_s = 0.0}
    end
    local dt = PERIOD_MS * 0.001
    mean_airspeed.time_s = mean_airspeed.time_s + dt
    local share = dt / math.min(mean_airspeed.time_s, AIRSPEED_S)
    mean_airspeed.value = mean_airspeed.value + share * (equivalent_m_s - mean_airspeed.value)
end

-- The bank before a flight, and since when it has been steady.
local steady = {bank_deg = 0.0, since_ms = nil}

local function watch_bank(now)
    if steady.since_ms == nil or math.abs(now.bank_deg - steady.bank_deg) > STEADY_DEG then
        steady = {bank_deg = now.bank_deg, since_ms = now.now_ms}
    end
end

-- The modelled banks before a flight, the last one first; none where the bank was not steady.
local function banks_before(now)
    local banks = {}
    if (now.now_ms - steady.since_ms):toint() >= MOST_STEPS * PERIOD_MS then
        for k = 1, MOST_STEPS do
            banks[k] = now.bank_deg
        end
    end
    steady.since_ms = nil
    return banks
end

-- The errors of the modelled bank for each delay, and the delay that follows from them; one flight learns from another.
local delay_errors, delay_s = {}, DELAY_S
for k = 0, MOST_STEPS do
    local off_s = PERIOD_MS * 0.001 * k - DELAY_S
    delay_errors[k] = DELAY_WEIGHT * off_s * off_s
end

-- Measure the delay: of the modelled banks of the last steps, one is most like the measured one.
local function measure_delay(now)
    local banks, errors, dt = flight.banks, delay_errors, PERIOD_MS * 0.001
    table.insert(banks, 1, flight.model.bank_deg)
    banks[MOST_STEPS + 2] = nil
    if #banks <= MOST_STEPS then
        -- The bank still follows what ArduPlane commanded before.
        return
    end
    local kept, best = math.exp(-dt / DELAY_MEMORY_S), 0
    for k = 0, MOST_STEPS do
        local off_deg = now.bank_deg - banks[k + 1]
        errors[k] = kept * errors[k] + dt * math.min(off_deg * off_deg, LARGEST_ERROR_DEG2)
        if errors[k] < errors[best] then
            best = k
        end
    end
    -- The least of the parabola through three errors.
    local beside = 0.0
    if best > 0 and best < MOST_STEPS then
        local before, after = errors[best - 1] - errors[best], errors[best + 1] - errors[best]
        beside = before + after > 0.0 and 0.5 * (before - after) / (before + after) or 0.0
    end
    delay_s = dt * (best + beside)
end

-- What is believed of the plane.
local function estimates_of(now, airspeeds)
    local rate_deg_s = param:get("RLL2SRV_RMAX") or 0.0
    return {
        roll = {
            time_s = ROLL_TIME_S, rate_deg_s = rate_deg_s >= 0.1 and rate_deg_s or ROLL_RATE_DEG_S, lag_s = 0.0,
            slew_deg_s = math.huge,
        },
        delay_s = delay_s, turn_ratio = turns.slow.ratio, quick_turn_ratio = turns.quick.ratio,
        course_lead_s = turns.lead.lead_s, wind_east_m_s = now.wind_east_m_s, wind_north_m_s = now.wind_north_m_s,
        airspeed_m_s = airspeeds.always.value, turn_airspeed_m_s = airspeeds.in_turns.value, overshoot_deg = 0.0,
        turns_unknown = 0.3 / airspeeds.in_turns.known_s, heading_bias_deg = 0.0,
        bank_bias_deg = turns.slow.bank_bias_deg,
    }
end

-- Learn from a measurement in flight.
local function learn(now)
    measure_delay(now)
    flight.airspeeds = law.update_airspeeds(flight.settings, flight.airspeeds, now, PERIOD_MS * 0.001)
    if not measure_turns(now) then
        return
    end
    flight.model = {
        revision = flight.model.revision + 1, bank_deg = flight.model.bank_deg, bank_rate_deg_s = 0.0,
        estimates = estimates_of(now, flight.airspeeds),
    }
    local east, north = now.wind_east_m_s - flight.wind_east_m_s, now.wind_north_m_s - flight.wind_north_m_s
    if east * east + north * north > WIND_CHANGED_M_S * WIND_CHANGED_M_S then
        searches, flight.wind_east_m_s, flight.wind_north_m_s = 0, now.wind_east_m_s, now.wind_north_m_s
    end
end

-- The target of the present mode, at an altitude above the sea; nil where there is none.
local function present_target()
    local target = vehicle:get_target_location()
    if target and target:change_alt_frame(ABSOLUTE) then
        return target
    end
    return nil
end

local function is_at(target, centre)
    return target ~= nil and target:lat() == centre:lat() and target:lng() == centre:lng()
end

-- Radius and largest bank, and nil where the circle cannot be held.
local function circle()
    local radius_m = RADIUS:get()
    if radius_m == 0 then
        radius_m = math.abs(param:get("WP_LOITER_RAD") or 0.0)
    end
    local bank_deg = math.min((param:get("ROLL_LIMIT_DEG") or 0.0) - BELOW_LIMIT_DEG, LARGEST_BANK_DEG)
    if BANK:get() > 0 then
        bank_deg = math.min(bank_deg, BANK:get())
    end
    return radius_m, bank_deg
end

-- The equivalent airspeed to plan with: that of GUIDED is kept where it is the present mode and has settled.
local function planned_airspeed()
    if mean_airspeed.mode == GUIDED and mean_airspeed.time_s >= AIRSPEED_S then
        return mean_airspeed.value
    end
    return param:get("AIRSPEED_CRUISE") or 0.0
end

-- Prepare a flight onto the circle around the present target; nil where there is none.
local function prepare(now)
    local target, equivalent_m_s = present_target(), planned_airspeed()
    local radius_m, bank_deg = circle()
    if not target or equivalent_m_s <= 0.0 or bank_deg <= 5.0 then
        return nil
    end
    local airspeed_m_s = equivalent_m_s * now.ratio
    local tightest_m = law.radius_at_bank(airspeed_m_s, bank_deg) / turns.slow.ratio
    local east, north = now.wind_east_m_s / airspeed_m_s, now.wind_north_m_s / airspeed_m_s
    if east * east + north * north >= 0.9 or tightest_m * law.tightest_radius(east, north) > radius_m then
        return nil
    end
    local settings = {
        east_m = 0.0, north_m = 0.0, radius_m = radius_m, side = math.floor(SIDE:get()), velocity_east_m_s = 0.0,
        velocity_north_m_s = 0.0, wind_east_m_s = now.wind_east_m_s, wind_north_m_s = now.wind_north_m_s,
        limit_deg = bank_deg, command_limit_deg = bank_deg, gain = 4.0, reserve = 0.1,
        smoothing_s = 0.5, negligible_wind = 0.03, covered_s = 2.0, search_steps = 1,
    }
    local airspeeds = {
        always = {value = airspeed_m_s, known_s = 5.0},
        in_turns = {value = airspeed_m_s, known_s = 0.3},
    }
    local estimates = estimates_of(now, airspeeds)
    last_problem, searches = nil, 0
    local model = {revision = 0, bank_deg = now.bank_deg, bank_rate_deg_s = 0.0, estimates = estimates}
    return {
        centre = target, settings = settings, model = model, memory = law.first_memory(settings, model),
        since_ms = now.now_ms, airspeeds = airspeeds, radius_m = radius_m, wind_east_m_s = now.wind_east_m_s,
        wind_north_m_s = now.wind_north_m_s,
    }
end

-- Whether a prepared flight is still the one that would be prepared.
local function is_current(now)
    local radius_m, bank_deg = circle()
    local settings, known = flight.settings, flight.model.estimates
    local east, north = now.wind_east_m_s - known.wind_east_m_s, now.wind_north_m_s - known.wind_north_m_s
    return is_at(vehicle:get_target_location(), flight.centre) and settings.radius_m == radius_m
        and settings.limit_deg == bank_deg and settings.side == SIDE:get()
        and east * east + north * north <= WIND_CHANGED_M_S * WIND_CHANGED_M_S
        and math.abs(known.turn_ratio - turns.slow.ratio) <= RATIO_CHANGED
        and math.abs(known.airspeed_m_s - planned_airspeed() * now.ratio) <= AIRSPEED_CHANGED * known.airspeed_m_s
end

-- Begin to improve the known point of joining, so that it is the best one when the switch is moved.
local function expect(now)
    local limits = flight.memory.limits
    if limits.wind_east_m_s == 0.0 and limits.wind_north_m_s == 0.0 then
        last_problem = nil
        return
    end
    local state = relative(now)
    local heading = math.rad(state.heading_deg)
    local hx, hy = state.airspeed_m_s * math.sin(heading), state.airspeed_m_s * math.cos(heading)
    last_problem = law.begin_in_air(law.search_from(flight.settings, limits, 1, {
        time_s = state.time_s, x = state.east_m, y = state.north_m, vx = state.velocity_east_m_s,
        vy = state.velocity_north_m_s, hx = hx, hy = hy,
    }, true)).in_air.problem
end

-- Command the circle by ArduPlane's own guidance, which ends a command of heading; the result.
local function reposition(is_held)
    local centre, radius_m = flight.centre, flight.radius_m
    if is_held then
        -- ArduPlane's own circle lies outside where the plane flies with the wind, by this share of the acceleration that
        -- is needed there beyond V^2/r: the middle of both is on the circle.
        local known, omega = flight.model.estimates, 2.0 * math.pi / (param:get("NAVL1_PERIOD") or 0.0)
        local east, north, V = known.wind_east_m_s, known.wind_north_m_s, known.airspeed_m_s
        local downwind = V + math.sqrt(east * east + north * north)
        local error_m = 0.073 * (downwind * downwind - V * V) / (radius_m * omega * omega)
        radius_m = radius_m - math.min(error_m, 0.3 * radius_m)
    end
    if (param:get("NAVL1_LIM_BANK") or 0.0) <= 0.0 then
        -- ArduPlane then multiplies the radius by the square of this ratio.
        radius_m = radius_m / (flight.ratio * flight.ratio)
    end
    local is_clockwise = flight.side > 0
    return gcs:run_command_int(DO_REPOSITION, {
        p1 = -1, p2 = 1, p3 = math.floor(radius_m + 0.5), p4 = is_clockwise and 0 or 1, frame = FRAME_GLOBAL,
        x = centre:lat(), y = centre:lng(), z = centre:alt() * 0.01,
    })
end

-- End a flight. With `is_ours` the mode is still ours, and the circle, which may be one that `is_held`, is left to
-- ArduPlane.
local function finish(severity, text, is_ours, is_held)
    if is_ours and reposition(is_held) ~= ACCEPTED then
        text = text .. ", fall-back circle refused"
    end
    BEAT:set(0)
    flight, is_latched = nil, true
    say(severity, text)
end

-- Command a bank, degrees; whether that was accepted.
local function command_bank(now, bank_deg)
    local ahead_deg = bank_deg < 0.0 and -90.0 or 90.0
    local acceleration = GRAVITY * math.tan(math.rad(math.abs(bank_deg)))
    -- Below the least limit that ArduPlane takes, wings level is the present heading.
    if acceleration < 0.05 then
        ahead_deg, acceleration = 0.0, 0.05
    end
    return gcs:run_command_int(GUIDED_CHANGE_HEADING, {
        p1 = 1, p2 = (now.heading_deg + ahead_deg) % 360.0, p3 = acceleration, frame = FRAME_GLOBAL,
    }) == ACCEPTED
end

-- Whether something has been so for a time, milliseconds; `name` remembers since when.
local function lasts(name, is_so, now_ms, time_ms)
    if not is_so then
        flight[name] = nil
        return false
    end
    flight[name] = flight[name] or now_ms
    return (now_ms - flight[name]):toint() >= time_ms
end

-- How far a stick is from its middle: 0 to 1, 0 where there is none.
local function stick(map)
    local channel = rc:get_channel(math.floor(param:get(map) or 0))
    return channel and math.abs(channel:norm_input_dz()) or 0.0
end

-- Why a flight must end, and whether the mode is still ours then; nil where it goes on.
local function reason_to_end(now, mode)
    if mode ~= GUIDED then
        return "pilot or failsafe took over", false
    elseif not arming:is_armed() or not vehicle:get_likely_flying() then
        return "not in flight", false
    elseif not is_at(vehicle:get_target_location(), flight.centre) then
        return "another target was given", false
    elseif vehicle:has_ekf_failsafed() or battery:has_failsafed() then
        return "failsafe", true
    elseif fence and fence:get_breaches() ~= 0 then
        return "fence", true
    elseif now == nil then
        return "no data", true
    elseif ENABLE:get() == 0 or rc:get_aux_cached(FUNC:get()) ~= 2 then
        return "ended by switch", true
    end
    local now_ms = now.now_ms
    if rc:has_valid_input() then
        local moved = math.max(stick("RCMAP_ROLL"), stick("RCMAP_PITCH"))
        if lasts("stick_ms", moved > STICK, now_ms, STICK_MS) then
            return "stick moved", true
        end
    end
    local off_m = math.abs(now.place:alt() - flight.centre:alt()) * 0.01
    flight.least_off_m = math.min(flight.least_off_m or off_m, off_m)
    if off_m > flight.least_off_m + ALTITUDE_OFF_M then
        return "altitude", true
    elseif lasts("bank_ms", math.abs(now.bank_deg - flight.command_deg) > BANK_OFF_DEG, now_ms, BANK_OFF_MS) then
        return "bank not flown", true
    elseif (now_ms - flight.begun_ms):toint() > LONGEST_MS then
        return "circle not held in time", true
    end
    return nil
end

-- Whether the circle has been held for so long that ArduPlane can go on.
local function is_held(now, state)
    local distance_m = math.sqrt(state.east_m * state.east_m + state.north_m * state.north_m)
    local azimuth_deg = bearing_deg(state.north_m, state.east_m)
    local tangent_deg = azimuth_deg + 90.0 * flight.side
    local course_deg = bearing_deg(now.velocity_north_m_s, now.velocity_east_m_s)
    local is_within = math.abs(distance_m - flight.radius_m) <= BAND * flight.radius_m
        and math.abs(wrap_180(course_deg - tangent_deg)) <= BAND_DEG
    local last_deg = flight.azimuth_deg or azimuth_deg
    flight.azimuth_deg = azimuth_deg
    flight.around_deg = is_within and (flight.around_deg or 0.0) + math.abs(wrap_180(azimuth_deg - last_deg)) or 0.0
    return lasts("held_ms", is_within, now.now_ms, HELD_MS) and flight.around_deg >= HELD_DEG
end

-- Begin the prepared flight, with the circle by ArduPlane's own guidance as what is flown if this script dies.
local function begin(now)
    local _, state = nil, relative(now)
    flight.ratio, flight.begun_ms, flight.command_deg = now.ratio, now.now_ms, now.bank_deg
    -- The bank has changed since the flight was prepared.
    flight.model.bank_deg, flight.banks = now.bank_deg, banks_before(now)
    -- The nearer side, until the law has a plan.
    local cross = state.east_m * now.velocity_north_m_s - state.north_m * now.velocity_east_m_s
    flight.side = flight.settings.side ~= 0 and flight.settings.side or cross < 0.0 and 1 or -1
    if reposition() ~= ACCEPTED then
        finish(SEVERITY.WARNING, "circle refused", false)
        return
    end
    flight.is_flown = true
    say(SEVERITY.NOTICE, "begins")
end

-- Whether a search of the law goes on.
local function is_searching()
    return flight and flight.is_flown and flight.memory.planning.search.aim ~= 0
end

-- Whether another callback for a search follows before the next step, which is due in so many milliseconds.
local function is_search_due(left_ms)
    local is_improved = flight and last_problem and (slot == 0 or searches < MANY_SEARCHES)
    return left_ms > SEARCH_MS and (is_searching() or is_improved)
end

-- A callback for a search.
local function continue_search()
    if is_searching() then
        local memory = flight.memory
        memory.planning = law.continue_search(memory.planning, flight.settings, memory.limits, memory.sensing, 1)
    elseif flight and last_problem then
        improve_join(last_problem)
    end
end

-- A callback in flight: one step of the law.
local function guide(now)
    local reason, is_ours = reason_to_end(now, vehicle:get_mode())
    if reason then
        finish(SEVERITY.WARNING, reason, is_ours)
        return
    end
    local elapsed_s = flight.stepped_ms and (now.now_ms - flight.stepped_ms):tofloat() * 0.001 or 0.0
    local state = relative(now)
    flight.stepped_ms, flight.memory.step_s = now.now_ms, elapsed_s
    flight.model = law.fly_as_declared(flight.model, flight.command_deg, elapsed_s)
    learn(now)
    local memory = law.prepare(flight.memory, flight.settings, flight.model, state)
    flight.memory = law.conclude(memory, flight.settings, flight.model, PERIOD_MS * 0.001)
    local command = flight.memory.command
    local limit_deg, bank_deg = flight.settings.limit_deg, flight.command_deg
    if command.phase ~= 3 or flight.is_commanded then
        flight.command_deg, flight.side, flight.is_commanded = command.bank_deg, command.side, true
        if is_held(now, state) then
            finish(SEVERITY.NOTICE, "circle held, left to ArduPlane", true, true)
            return
        end
        -- On the circle with the bias that the law takes from measured banks: ArduPlane flies the bank that it measures.
        bank_deg = command.bank_deg + (command.phase == 2 and turns.slow.bank_bias_deg or 0.0)
    elseif (now.now_ms - flight.begun_ms):toint() >= FIRST_PLAN_MS then
        -- The circle by ArduPlane's own guidance, until there is a plan.
        if not flight.is_left then
            flight.is_left = reposition() == ACCEPTED
        end
        bank_deg = nil
    end
    if bank_deg and not command_bank(now, math.max(-limit_deg, math.min(bank_deg, limit_deg))) then
        finish(SEVERITY.WARNING, "bank refused", false)
        return
    end
    flight.beat = (flight.beat or 0) % 1000 + 1
    BEAT:set(flight.side * flight.beat)
end

-- A callback without a flight: prepare one, and begin it where the switch is moved.
local function wait(now)
    local is_high = ENABLE:get() ~= 0 and rc:get_aux_cached(FUNC:get()) == 2
    if not is_high then
        is_latched = false
    end
    if now == nil or not arming:is_armed() or not vehicle:get_likely_flying() then
        flight = nil
        return
    end
    measure_turns(now)
    watch_bank(now)
    if flight and is_current(now) then
        if is_high and not is_latched then
            begin(now)
            if flight then
                guide(now)
            end
        else
            expect(now)
        end
        return
    end
    flight = prepare(now)
    if flight == nil and is_high and not is_latched then
        is_latched = true
        say(SEVERITY.WARNING, "no circle that can be held")
    end
end

-- A callback between searches: a step of the law, or a look at the switch.
local function step()
    local now = measure()
    if now then
        measure_airspeed(now, vehicle:get_mode())
    end
    if flight and flight.is_flown then
        guide(now)
    else
        wait(now)
    end
end

local function update()
    if slot > 0 then
        continue_search()
    else
        begun_ms = millis()
        step()
    end
    -- Callbacks come late: the next step is due after the last one began, not after this callback.
    local left_ms = PERIOD_MS - (millis() - begun_ms):toint()
    if is_search_due(left_ms) then
        slot = slot + 1
        return SEARCH_MS
    end
    slot = 0
    return math.max(left_ms, 1)
end

-- An error, for instance of memory, ends a flight.
local function protected_update()
    local is_done, delay_ms = pcall(update)
    if not is_done then
        local problem = delay_ms
        if flight and flight.is_flown then
            pcall(finish, SEVERITY.CRITICAL, "script error", vehicle:get_mode() == GUIDED)
        end
        flight, is_latched = nil, true
        say(SEVERITY.CRITICAL, tostring(problem))
        return protected_update, 1000
    end
    return protected_update, delay_ms
end

say(SEVERITY.NOTICE, "loiter_entry 0.1.0 ready")
return protected_update()
