-- A swarm: the seed decides what happens. First it draws how likely each kind of deed is, some not at all and the
-- others very differently, then it does deeds until the time is up. So some episodes spawn and spawn, others steer
-- like mad, others only watch: what never meets when everything is equally likely, meets here.
-- tests/determinism/episodes.py runs it, twice a seed; the line `deeds:` at the end tells it what was covered.
return scenario 'swarm' {
    town = 'town1',
    duration = 60,
    cars = 30,
    weather = 'clear_noon',
    params = {
        seconds = 15,
        limit = 60,     -- actors at most
        connected = 0,  -- 1: in this town every lane can be reached from every other
        mistakes = 0,   -- 1: one of the deeds is a mistake of the script's
    },

    run = function(p)
        local vehicles = { 'sedan', 'hatchback', 'suv', 'van', 'lorry', 'bus' }
        local people = { 'adult', 'child', 'senior' }
        local drivers = { 'autopilot', 'manual', 'traffic', 'parked' }
        local weathers = { 'clear_noon', 'hard_rain_sunset' }
        local actors, counts = {}, {}

        local function one_of(list) return list[random_int(1, #list)] end
        local function between(low, high) return low + (high - low) * random() end
        local function chance(share) return random() < share end

        -- An actor who is there, of these drivers; nil when the draw finds none.
        local function some(wanted)
            for _ = 1, 6 do
                local actor = #actors > 0 and one_of(actors)
                if actor and wanted[actor.driver] and actor.handle:exists() then return actor end
            end
        end
        local function some_driver() return some{ autopilot = true, traffic = true } end

        local function place(driver)
            if (driver == 'autopilot' or driver == 'traffic') and chance(0.5) then return end
            return pick_lane{ length = between(0, 60), sidewalk = chance(0.3) or nil, optional = true } or pick_lane{}
        end

        local function add(driver, model)
            if #actors >= p.limit then return false end
            local lane = place(driver)
            local seat = { model = model, driver = driver, lane = lane }
            if lane then
                seat.s = between(0, lane_length(lane))
                local side = lane_width(lane) / 2  -- who drives starts on its lane
                if driver == 'manual' then seat.offset = between(-side, side) end
                if driver == 'parked' or driver == 'walker' then seat.offset = between(-4, 4) end
            end
            if driver ~= 'parked' and driver ~= 'walker' then seat.speed = chance(0.5) and between(0, 20) or 0 end
            local free, handle = pcall(spawn, seat)  -- somebody may stand there
            if not free then return false end
            actors[#actors + 1] = { handle = handle, driver = driver }
        end

        local deeds = {
            spawn_vehicle = function() return add(one_of(drivers), one_of(vehicles)) end,
            spawn_manual = function() return add('manual', one_of(vehicles)) end,
            spawn_walker = function() return add('walker', one_of(people)) end,
            -- A hand's breadth behind another, and far faster: a crash from the first ticks on.
            spawn_into_each_other = function()
                local lane = pick_lane{ length = 20, optional = true }
                if not lane or #actors + 1 >= p.limit then return false end
                local there, s = 0, 4
                while there < 2 and s < 20 do
                    local free, handle = pcall(spawn, { model = one_of(vehicles), driver = 'manual', lane = lane, s = s,
                                                        speed = 20 * (1 - there) })
                    if free then
                        actors[#actors + 1] = { handle = handle, driver = 'manual' }
                        there = there + 1
                    end
                    s = s + 0.3
                end
                return there > 0
            end,
            despawn = function()
                local actor = some{ autopilot = true, manual = true, traffic = true, parked = true, walker = true }
                if not actor then return false end
                actor.handle:despawn()
            end,
            set_speed = function()
                local actor = some_driver()
                if not actor then return false end
                local over = actor.driver == 'traffic' and chance(0.5) and between(0, 4) or 0
                actor.handle:set_speed(between(0, 30), { over = over })
            end,
            free_speed = function()
                local actor = some_driver()
                if not actor then return false end
                actor.handle:free_speed()
            end,
            change_lane = function()
                local actor = some_driver()
                local lane = actor and actor.handle:lane()
                local target = lane and (chance(0.5) and lane_left_of(lane) or lane_right_of(lane))
                if not target then return false end
                actor.handle:change_lane(target, { over = actor.driver == 'traffic' and between(0, 3) or 0 })
            end,
            keep_lane = function()
                local actor = some_driver()
                if not actor or actor.routed then return false end  -- its route might need another lane
                actor.kept = true
                actor.handle:keep_lane(chance(0.7))
            end,
            -- Anywhere where every way leads; elsewhere to the lane it is on, which any town has.
            set_route = function()
                local actor = some_driver()
                local lane = actor and actor.handle:lane()
                if not lane or lane:sub(1, 1) == ':' or actor.kept then return false end
                actor.routed = true
                if p.connected == 0 and actor.handle:s() > lane_length(lane) - 20 then return false end
                actor.handle:set_route{ p.connected == 0 and lane or pick_lane{} }
            end,
            control = function()
                local actor = some{ manual = true }
                if not actor then return false end
                actor.handle:control{ throttle = chance(0.7) and random() or 0, brake = chance(0.3) and random() or 0,
                                      steer = between(-1, 1), hand_brake = chance(0.1), reverse = chance(0.2) }
            end,
            walk = function()
                local actor = some{ walker = true }
                if not actor then return false end
                local x, y = actor.handle:x(), actor.handle:y()
                actor.handle:walk{ to = { x + between(-40, 40), y + between(-40, 40) }, speed = between(0.5, 6) }
            end,
            walk_to = function()
                local actor = some{ walker = true }
                if not actor then return false end
                local lane = pick_lane{}
                if chance(0.5) then
                    actor.handle:walk_to{ across = lane, speed = between(0.5, 3) }
                else
                    actor.handle:walk_to{ lane = lane, s = between(0, lane_length(lane)), offset = between(-5, 5) }
                end
            end,
            weather = function() set_weather(one_of(weathers)) end,
            look = function()
                local one, other = some_driver(), some_driver()
                if not one or one == other or not other then return false end
                local a, b = one.handle, other.handle
                print(gap(a, b), distance(a, b), ttc(a, b), a:heading_deg(), a:lane(), a:s(), a:offset())
            end,
            check = function()
                local actor = some_driver()
                if not actor then return false end
                local name = 'slow ' .. time() .. ' ' .. random_int(1, 1000000000)
                check.max(name, function() return actor.handle:speed() end, between(1, 30), { optional = true })
            end,
            task = function()
                start(function()
                    for _ = 1, random_int(1, 20, 'tasks') do
                        wait(random('tasks'))
                        local manual = some{ manual = true }
                        if manual then manual.handle:control{ throttle = random('tasks') } end
                    end
                end)
            end,
            compute = function()
                local sum, list = 0, {}
                for i = 1, random_int(10, 2000) do
                    list[i] = math.sin(i * between(1, 1000)) ^ 2 + math.exp(-random())
                end
                table.sort(list)
                for key, value in pairs(list) do sum = sum + value / key end
                print(string.format('%.17g', sum))
            end,
            mistake = function()
                if p.mistakes == 0 or not chance(0.2) then return false end
                local nobody = nil
                return nobody.speed
            end,
        }

        -- Weights: a third of the deeds never, the others from 1 to 64.
        local names, weights, total = {}, {}, 0
        for name in pairs(deeds) do
            local weight = chance(1 / 3) and 0 or 2 ^ between(0, 6)
            if name == 'spawn_vehicle' or name == 'spawn_walker' then weight = math.max(weight, 1) end
            names[#names + 1], weights[#weights + 1], total = name, weight, total + weight
            counts[name] = 0
        end
        local function draw_deed()
            local mark = random() * total
            for i, name in ipairs(names) do
                mark = mark - weights[i]
                if mark < 0 then return name end
            end
            return names[#names]
        end

        -- Somebody to begin with; then deeds, many a tick or few.
        for _ = 1, random_int(0, 10) do add(one_of(drivers), one_of(vehicles)) end
        local pause = one_of{ 0.05, 0.1, 0.25, 1 }
        while time() < p.seconds do
            for _ = 1, random_int(0, 3) do
                local name = draw_deed()
                if deeds[name]() ~= false then counts[name] = counts[name] + 1 end
            end
            wait(pause)
        end
        local text = 'deeds:'
        for name, count in pairs(counts) do text = text .. ' ' .. name .. '=' .. count end
        print(text)
    end,
}
