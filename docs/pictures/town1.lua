-- Eight spots of Town 1, each seen from a parked car, among traffic and walkers: make.sh makes the pictures.
-- The cars are the first eight actors, in the order of make.sh.
local cameras = {
    { lane = 'm1_m2s_0', s = 45 },                -- roundabout
    { lane = 'c1_m1_0', s = 20 },                 -- square
    { lane = 'm1_a1_0', s = 26, offset = -9 },    -- park
    { lane = 'b2_m1_0', s = 20 },                 -- old street
    { lane = 'a1_m1_0', s = 40 },                 -- crossing with lights
    { lane = 'c3_t3_0', s = 6 },                  -- shops
    { lane = 'l1_a2_0', s = 14 },                 -- bend
    { lane = 'l1_t1_0', s = 22 },                 -- village
}

-- Along which lane, from where to where on it [m], who, and how far left of its middle [m].
local strolls = {
    { 'm1_m2s_0', 62, 5, 'tourist' }, { 'm2s_m1_0', 3, 60, 'jogger' }, { 'm1_m2s_0', 30, 70, 'mother' },
    { 'c1_m1_0', 30, 62, 'musician', -9 }, { 'c1_m1_0', 52, 30, 'shopper', -13 }, { 'm1_m2s_0', 12, 60, 'student' },
    { 'm1_a1_0', 20, 44, 'schoolgirl', -14 }, { 'm1_a1_0', 42, 26, 'pensioner', -20 }, { 'm1_a1_0', 50, 20, 'runner', -14 },
    { 'm1_m2s_0', 30, 6, 'musician', -16 }, { 'm1_m2s_0', 12, 45, 'dancer', -30 }, { 'm1_m2s_0', 40, 8, 'skater', -40 },
    { 'b2_m1_0', 40, 66, 'traveller' }, { 'm1_b2_0', 20, 60, 'gentleman' }, { 'b2_m1_0', 60, 30, 'artist' },
    { 'a1_m1_0', 50, 69, 'businesswoman' }, { 'm1_a1_0', 4, 50, 'courier' }, { 'a1_m1_0', 66, 44, 'hiker' },
    { 'c3_t3_0', 14, 55, 'manager' }, { 't3_c3_0', 45, 8, 'clerk' }, { 'c3_t3_0', 40, 10, 'backpacker' },
    { 'a2_l1_0', 107, 122, 'grandmother' }, { 'l1_a2_0', 50, 66, 'boy' }, { 'a2_l1_0', 118, 90, 'postman' },
    { 'l1_t1_0', 30, 70, 'father' }, { 't1_l1_0', 200, 170, 'girl' }, { 'l1_t1_0', 60, 30, 'gardener' },
}

return scenario 'town1_spots' {
    town = 'town1', duration = 61, seed = 5, cars = 110,
    run = function()
        for i, place in ipairs(cameras) do
            spawn{ name = 'camera_' .. i, model = 'city_car', driver = 'parked', lane = place.lane, s = place.s,
                   offset = place.offset }
        end
        wait(20)
        for _, stroll in ipairs(strolls) do
            local lane, from, to, model, offset = table.unpack(stroll)
            local walker = spawn{ model = model, driver = 'walker', lane = lane, s = from, offset = offset }
            walker:walk_to{ lane = lane, s = to, offset = offset }
        end
        wait(60)
    end,
}
