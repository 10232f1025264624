-- One car drives the shortest way from a place to another in an empty town, as the tasks of
-- towns/town1/tasks.json ask for: it arrives in the time that 10 km/h would need, and touches nothing.
-- Without places: from one lane to another, both chosen by the seed.
return scenario 'drive_route' {
    town = 'town1',
    duration = 1200,
    seed = 7,
    cars = 0,
    weather = 'clear_noon',
    params = {
        start = '', s = 10,      -- lane, and [m] on it
        goal = '', goal_s = 30,
        model = 'sedan',
    },

    run = function(p)
        local start = p.start ~= '' and p.start or pick_lane{ length = 50 }
        local goal = p.goal ~= '' and p.goal or pick_lane{ length = 50 }
        local ego = spawn{ name = 'ego', model = p.model, driver = 'autopilot', lane = start, s = p.s, may_overtake = true }
        local length = ego:route_to{ lane = goal, s = p.goal_s }
        print(string.format('%.0f m to go', length))

        -- The goal may lie on the lane that we start from, behind us.
        local function arrived()
            return ego:distance_driven() > length - 10 and ego:lane() == goal and ego:s() >= p.goal_s
        end
        check.never('collision', function() return ego:collided() end)
        check.eventually('arrived in time', arrived, { within = length / (10 / 3.6) + 10 })

        wait_until(arrived)
        print(string.format('%.0f s: arrived after %.0f m', time(), ego:distance_driven()))
        finish 'arrived'
    end,
}
