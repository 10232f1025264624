-- Reads a trace in Lua, by way of `reprise cat`: CSV is all that it takes.
--   lua5.4 read_trace.lua a.mcap [path of reprise]
local trace, reprise = arg[1], arg[2] or 'reprise'

local function rows(fields)
    local pipe = assert(io.popen(("'%s' cat '%s' --format csv --fields %s"):format(reprise, trace, fields)))
    local names = {}
    for heading in pipe:read('l'):gmatch('[^,]+') do names[#names + 1] = heading:match('^%S+') end  -- without its unit
    return function()
        local line = pipe:read('l')
        if not line then return pipe:close() and nil end
        local row, i = {}, 0
        for cell in line:gmatch('[^,]*') do
            i = i + 1
            row[names[i]] = tonumber(cell) or cell
        end
        return row
    end
end

local speed = {}
for row in rows('measurements.speed') do speed[row.tick] = speed[row.tick] or row.speed end

local cars, fastest, last = {}, {}, 0
for row in rows('cars.speed') do
    cars[row.tick] = (cars[row.tick] or 0) + 1
    fastest[row.tick] = math.max(fastest[row.tick] or 0, row.speed)
    last = math.max(last, row.tick)
end

for tick = 20, last, 20 do
    print(('tick %d: %.3f m/s; the fastest of %d cars: %.3f m/s'):format(
        tick, speed[tick] or 0, cars[tick] or 0, fastest[tick] or 0))
end
