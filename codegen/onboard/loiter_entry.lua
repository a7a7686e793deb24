@HEAD@
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
@LAW@
end

-- The instructions of a callback are limited (SCR_VM_I_COUNT). So a search has callbacks of its own, between two steps
-- of the law. In wind the point of joining is remembered, and each of these callbacks improves it: for the problem of
-- the law's search, or for the last problem where the law makes none.
local known_join = {side = 0, phase = 0.0, words = 0, shift = @FIRST_SHIFT@, calls = 0}
local last_problem, searches = nil, 0

local function improve_join(problem)
    local entry
    known_join, entry = law.track(known_join, problem)
    last_problem, searches = problem, searches + 1
    entry.status = entry.side == 0 and @NOT_CONVERGED@ or 0
    return entry
end

begin_in_wind = function(problem)
    return {stage = 0, problem = problem}
end

advance_in_wind = function(search)
    local entry = search.entry
    if search.stage ~= @ENDED@ then
        entry = improve_join(search.problem)
    end
    return {stage = @ENDED@, left = 0, entry = entry}
end

-- The flight that is prepared or flown; and whether the switch must be moved before the next one.
local flight, is_latched = nil, true

-- When the last step began, and how many callbacks for searches there have been since then.
local begun_ms, slot = nil, 0

-- The mean equivalent airspeed in the present mode.
local mean_airspeed = {}

-- How the plane turns, and when that was last measured.
local turns, learned_ms = law.first_turns(@EXPECTED_RATIO@, 0.0), nil

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
    local declared = {turn_ratio = @EXPECTED_RATIO@, course_lead_s = 0.0}
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
        turns_unknown = @DECLARED_TURN_AIRSPEED@ / airspeeds.in_turns.known_s, heading_bias_deg = 0.0,
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
        limit_deg = bank_deg, command_limit_deg = bank_deg, gain = @GAIN@, reserve = @RESERVE@,
        smoothing_s = @SMOOTHING@, negligible_wind = @NEGLIGIBLE_WIND@, covered_s = @COVERED@, search_steps = 1,
    }
    local airspeeds = {
        always = {value = airspeed_m_s, known_s = @DECLARED_AIRSPEED@},
        in_turns = {value = airspeed_m_s, known_s = @DECLARED_TURN_AIRSPEED@},
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
    last_problem = law.begin_in_air(law.search_from(flight.settings, limits, @FIRST_TURN@, {
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
        local error_m = @DOWNWIND_SHARE@ * (downwind * downwind - V * V) / (radius_m * omega * omega)
        radius_m = radius_m - math.min(error_m, @LARGEST_SHARE@ * radius_m)
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
    return flight and flight.is_flown and flight.memory.planning.search.aim ~= @NOTHING@
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
    if command.phase ~= @NO_DATA@ or flight.is_commanded then
        flight.command_deg, flight.side, flight.is_commanded = command.bank_deg, command.side, true
        if is_held(now, state) then
            finish(SEVERITY.NOTICE, "circle held, left to ArduPlane", true, true)
            return
        end
        -- On the circle with the bias that the law takes from measured banks: ArduPlane flies the bank that it measures.
        bank_deg = command.bank_deg + (command.phase == @HOLD@ and turns.slow.bank_bias_deg or 0.0)
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

say(SEVERITY.NOTICE, "loiter_entry @VERSION@ ready")
return protected_update()
