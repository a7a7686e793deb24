-- Releases a plane from an entry of loiter_entry.lua whose script has died: loiter_watchdog.md.
--
-- ArduPlane keeps the last heading that it was commanded, so the plane would fly on in that turn, or straight on. While
-- an entry is flown LENT_BEAT changes twenty times a second. Where it stands still, and not at 0, this script commands
-- the circle by ArduPlane's own guidance.

local SEVERITY = {CRITICAL = 2, NOTICE = 5}
local GUIDED, DO_REPOSITION, ACCEPTED = 15, 192, 0
local FRAME_GLOBAL, ABSOLUTE = 0, 0

-- The sign of life is read at this interval, milliseconds; at so many readings of one value the script is dead.
local PERIOD_MS, READINGS = 100, 4

-- The last value, and how often it has been read.
local last, readings = 0, 0

local function say(severity, text)
    gcs:send_text(severity, "Entry watchdog: " .. text)
end

-- The radius of the circle, by parameters of the applet or of ArduPlane, as DO_REPOSITION takes it.
local function commanded_radius_m()
    local radius_m = param:get("LENT_RADIUS") or 0.0
    if radius_m <= 0.0 then
        radius_m = math.abs(param:get("WP_LOITER_RAD") or 0.0)
    end
    if (param:get("NAVL1_LIM_BANK") or 0.0) <= 0.0 then
        -- ArduPlane then multiplies the radius by the square of this ratio.
        local ratio = ahrs:get_EAS2TAS() or 1.0
        radius_m = radius_m / (ratio * ratio)
    end
    return radius_m
end

-- Command the circle around the present target; whether that was accepted.
local function reposition(is_clockwise)
    local target = vehicle:get_target_location()
    if not target or not target:change_alt_frame(ABSOLUTE) then
        return false
    end
    return gcs:run_command_int(DO_REPOSITION, {
        p1 = -1, p2 = 1, p3 = math.floor(commanded_radius_m() + 0.5), p4 = is_clockwise and 0 or 1,
        frame = FRAME_GLOBAL, x = target:lat(), y = target:lng(), z = target:alt() * 0.01,
    }) == ACCEPTED
end

-- End the entry of a script that has died. In another mode the plane is not ours.
local function release(beat)
    if vehicle:get_mode() ~= GUIDED then
        param:set("LENT_BEAT", 0)
        say(SEVERITY.CRITICAL, "script has died")
    elseif reposition(beat > 0) then
        param:set("LENT_BEAT", 0)
        say(SEVERITY.CRITICAL, "script has died, circle commanded")
    else
        say(SEVERITY.CRITICAL, "script has died, CIRCLE REFUSED: change the mode")
    end
end

local function update()
    local beat = param:get("LENT_BEAT") or 0
    readings = beat ~= 0 and beat == last and readings + 1 or 1
    last = beat
    if beat ~= 0 and readings >= READINGS then
        readings = 0
        release(beat)
    end
    return update, PERIOD_MS
end

say(SEVERITY.NOTICE, "ready")
return update()
