-- Those of ArduPilot's bindings that the applets use, over a simulated world; `world` is an object of Python.
-- Each counts its arguments: those after the colon, as docs/docs.lua of AP_Scripting lists them.
local world, counts = ...

local uint32 = {}
uint32.__index = uint32
local function milliseconds(value) return setmetatable({value = value}, uint32) end
function uint32.__sub(a, b) return milliseconds(a.value - b.value) end
function uint32:tofloat() return self.value + 0.0 end
function uint32:toint() return math.floor(self.value) end
function millis() return milliseconds(world.milliseconds()) end

local function counted(title, methods)
  return setmetatable({}, {__index = function(_, name)
    local wanted = counts[title .. ":" .. name]
    assert(wanted, title .. ":" .. name .. " is no binding")
    return function(_, ...)
      assert(select("#", ...) == wanted, title .. ":" .. name .. " takes " .. wanted .. " arguments")
      return methods[name](...)
    end
  end})
end

local function vector(x, y)
  return counted("Vector3f_ud", {x = function() return x end, y = function() return y end})
end

local function location(lat, lng, alt)
  return counted("Location_ud", {
    lat = function() return lat end, lng = function() return lng end, alt = function() return alt end,
    change_alt_frame = function() return true end,
    get_distance_NE = function(other)
      return vector((other:lat() - lat) * 0.01, (other:lng() - lng) * 0.01)
    end,
  })
end

ahrs = counted("ahrs", {
  healthy = function() return world.is_healthy() end,
  get_location = function() return location(world.place()) end,
  get_velocity_NED = function() return vector(world.velocity()) end,
  wind_estimate = function() return vector(world.wind()) end,
  airspeed_EAS = function() return world.airspeed() end,
  get_EAS2TAS = function() return 1.0 end,
  get_yaw_rad = function() return world.yaw() end,
  get_roll_rad = function() return world.roll() end,
})
vehicle = counted("vehicle", {
  get_mode = function() return world.mode() end,
  get_likely_flying = function() return true end,
  has_ekf_failsafed = function() return world.has("ekf") end,
  get_target_location = function() return location(world.target()) end,
})
arming = counted("arming", {is_armed = function() return world.has("armed") end})
battery = counted("battery", {has_failsafed = function() return world.has("battery") end})
fence = counted("fence", {get_breaches = function() return world.has("fence") and 1 or 0 end})
rc = counted("rc", {
  has_valid_input = function() return true end,
  get_aux_cached = function() return world.has("switch") and 2 or 0 end,
  get_channel = function()
    return counted("RC_Channel_ud", {norm_input_dz = function() return world.stick() end})
  end,
})
gcs = counted("gcs", {
  send_text = function(_, text) world.say(text) end,
  run_command_int = function(command, p)
    return world.command(command, p.p2 or 0.0, p.p3 or 0.0, p.p4 or 0.0, p.x or 0, p.y or 0)
  end,
})
param = counted("param", {
  add_table = function() return true end,
  add_param = function(_, _, name, default) world.set("LENT_" .. name, default) return true end,
  get = function(name) return world.get(name) end,
  set = function(name, value) world.set(name, value) return true end,
})
function Parameter(name)
  return counted("Parameter_ud", {
    get = function() return world.get(name) end,
    set = function(value) world.set(name, value) return true end,
  })
end
