-- Answers of the kernel and of the law in the numbers of this Lua: rows of a file in, rows of another file out.

local law, action, from, to = ...

-- The numbers of a row; those of single precision are written as they are in hexadecimal.
local function numbers(line)
    local found = {}
    for word in line:gmatch("%S+") do
        found[#found + 1] = word == "nan" and 0.0 / 0.0 or tonumber(word)
    end
    return found
end

local function fields(names, values)
    local found = {}
    for k, name in ipairs(names) do
        found[name] = values[k]
    end
    return found
end

local STATE = {
    "time_s", "east_m", "north_m", "heading_deg", "bank_deg", "velocity_east_m_s", "velocity_north_m_s", "airspeed_m_s",
}

local actions = {}

-- x, y, R, side and tolerance; side, word and time.
function actions.kernel(lines, out)
    for line in lines do
        local x, y, R, side, tolerance = table.unpack(numbers(line))
        local entry = law.optimum(x, y, law.rounded_radius(R), math.floor(side), tolerance)
        out:write(string.format("%d %d %.9g\n", entry.side, entry.word, entry.t1 + entry.t2 + entry.t3))
    end
end

-- The law with settings and vehicle, and the time between steps: a function from a measurement to bank and time to join.
local function flight(begin, dt_text)
    local settings, model = load(begin)()
    local dt = tonumber(dt_text)
    local memory = law.first_memory(settings, model)
    return function(line)
        model = law.fly_as_declared(model, memory.command.bank_deg, memory.step_s)
        memory = law.prepare(memory, settings, model, fields(STATE, numbers(line)))
        memory = law.conclude(law.continue_search(memory, settings, 10), settings, model, dt)
        return memory.command.bank_deg, memory.command.time_to_join_s
    end
end

-- Two lines that begin a flight, then measurements; bank and time to join.
function actions.law(lines, out)
    local step = flight(lines(), lines())
    for line in lines do
        out:write(string.format("%.9g %.9g\n", step(line)))
        out:flush()
    end
end

if action == "flight" then
    return flight
end

local out = assert(io.open(to, "w"))
actions[action](io.lines(from), out)
out:close()
