-- The part of the vocabulary that is easiest said in Lua. Runs before every scenario; what it
-- defines here are the words that a scenario sees.

local give_up_at, poll = _give_up_at, _poll
_give_up_at, _poll = nil, nil

--- Tests the condition at once, then in every tick. True when it holds; false after `timeout` seconds.
function wait_until(condition, options)
    local last_tick = give_up_at(condition, options)
    while not condition() do
        if tick() >= last_tick then
            return false
        end
        local asked, answer = poll(condition, last_tick)
        if asked then
            return answer
        elseif asked == false then
            error(answer, 0)
        end
        wait_ticks(1)  -- inside another condition
    end
    return true
end

local wish_for_green = _wish_for_green
_wish_for_green = nil

--- Until the light at the lane's end is green; true, or false after `timeout` seconds.
function wait_until_green(lane, options)
    local turn, limit = wish_for_green(lane, options)
    return wait_until(function()
        local color = signal(lane, turn)
        return color == 'green' or color == 'green_minor'
    end, limit)
end

local steer_together = _steer_together
_steer_together = nil

--- Steers the speed of `a` so that it comes to its point when `b` comes to its own; returns when either
--- is there, or they hit each other, or it gives up: did they meet, and how many seconds apart.
function arrive_together(a, b, point, options)
    local met, apart, left_a, left_b
    local began, moved = tick(), tick()
    while true do
        local done, now_met, now_apart, now_a, now_b, moves =
            steer_together(a, b, point, options, left_a, left_b, began, moved)
        if moves then
            moved = tick()
        end
        if now_apart then
            met, apart, left_a, left_b = now_met, now_apart, now_a, now_b
        end
        if done then
            return met, apart
        end
        wait_ticks(1)
    end
end

local actor = _actor
_actor = nil

function actor:speed_kmh()
    return self:speed() * 3.6
end

function actor:x()
    return (self:position())
end

function actor:y()
    local _, y = self:position()
    return y
end
