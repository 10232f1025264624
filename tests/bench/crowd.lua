-- What the sizes in the README are measured on: free_drive's car among 100 cars, and 100 walkers who
-- cross the road to and fro.
return scenario 'crowd' {
    town = 'town1', duration = 60, seed = 7, cars = 100,
    params = { walkers = 100 },

    run = function(p)
        spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' }
        local taken = {}
        -- Where nobody stands within 2 m yet.
        local function pick_place()
            while true do
                local lane = pick_lane{ sidewalk = true, length = 20 }
                local s = 5 + random() * (lane_length(lane) - 10)
                local free = true
                for _, place in ipairs(taken) do
                    free = free and (place.lane ~= lane or math.abs(place.s - s) > 2)
                end
                if free then
                    table.insert(taken, { lane = lane, s = s })
                    return lane, s
                end
            end
        end
        for i = 1, p.walkers do
            local lane, s = pick_place()
            local right = -lane_width(lane) / 2 - 1
            local walker = spawn{ model = 'adult', lane = lane, s = s, offset = right }
            start(function()
                wait(random() * 10)
                while true do
                    walker:walk_to{ across = lane }
                    wait(8 + random() * 8)
                    walker:walk_to{ lane = lane, s = s, offset = right }
                    wait(8 + random() * 8)
                end
            end)
        end
        wait(3600)
    end,
}
