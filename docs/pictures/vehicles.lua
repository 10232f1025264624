-- Every vehicle of the catalogue side by side, as vehicles.jpg shows them:
--     reprise run docs/pictures/vehicles.lua --town docs/pictures/plaza.net.xml -o v.mcap
--     reprise render v.mcap -o v --ticks 2 --actor 1 --mount=-27.5,1,4.2 --yaw 180 --pitch -7 \
--         --size 1800x440 --fov 68
return scenario 'vehicles' {
    town = 'plaza', duration = 3, seed = 14,
    run = function()
        spawn{ name = 'camera', model = 'sedan', driver = 'parked', lane = 'ab_4', s = 100 }
        local front = { 'bicycle', 'motorcycle', 'city_car', 'hatchback', 'coupe', 'sedan', 'taxi', 'police', 'wagon' }
        local back = { 'suv', 'pickup', 'van', 'ambulance', 'minibus', 'lorry', 'bus' }
        for i, model in ipairs(front) do
            spawn{ model = model, driver = 'parked', lane = 'ab_4', s = 50, offset = 3.1 * (i - 5) }
        end
        for i, model in ipairs(back) do
            spawn{ model = model, driver = 'parked', lane = 'ab_4', s = 39, offset = 3.7 * (i - 4) }
        end
        wait(60)
    end,
}
