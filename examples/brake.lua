-- What if it had stopped? For `reprise branch T.mcap --script examples/brake.lua`.
return scenario 'brake' {
    run = function()
        actor('ego'):set_speed(0)
        wait(60)
    end,
}
