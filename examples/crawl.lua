-- What if it had gone on at a walking pace? For `reprise branch T.mcap --script examples/crawl.lua`.
return scenario 'crawl' {
    run = function()
        actor('ego'):set_speed(1.5)
        wait(60)
    end,
}
