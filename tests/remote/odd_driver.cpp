// A driver for tests: odd_driver HABIT [SOCKET]. `steady` drives well, `polls` likewise and never
// sleeps, `sleeps` always does, `counting` says in each tick which one that is; every other one
// breaks the wire's rules in its way, in the third tick if it gets that far. odd_driver killed
// TICK: is, in that one.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include "remote/client.h"
#include "remote/frame_channel.h"
#include "remote/schema.h"
#include "world/check.h"

namespace {

using reprise::remote::Client;

int descriptor() {
    return std::atoi(std::getenv("REPRISE_DRIVER") + std::strlen("fd:"));
}

void say_raw(const void* bytes, std::size_t size) {
    if (send(descriptor(), bytes, size, MSG_NOSIGNAL) < 0)
        std::exit(4);
}

/// What a habit does in its tick. True: in place of an answer, past the library and so through the
/// socket.
bool misbehave(const std::string& habit, Client& run) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (habit == "dies")
        std::exit(3);
    if (habit == "leaves_a_child") {  // which has our socket, until our group is ended
        if (fork() == 0)
            for (;;)
                pause();
        std::exit(3);
    }
    if (habit == "chatters") {
        flatbuffers::FlatBufferBuilder builder;
        const auto reason = builder.CreateString("I am\n" + std::string(30'000, 'x'));
        builder.Finish(reprise::remote::CreateGoodbye(builder, reason));
        const std::uint32_t header[] = {builder.GetSize(), 5};
        say_raw(header, sizeof(header));
        say_raw(builder.GetBufferPointer(), builder.GetSize());
        return true;
    }
    if (habit == "crashes")
        std::abort();
    if (habit == "nan")
        run.say({.throttle = nan});
    if (habit == "too_much")
        run.say({.steer = -1.5});
    if (habit == "twice")
        run.say({.throttle = 0.1});
    if (habit == "ahead") {
        flatbuffers::FlatBufferBuilder builder;
        builder.Finish(reprise::remote::CreateControl(builder, 9));
        const std::uint32_t header[] = {builder.GetSize(), 4};
        say_raw(header, sizeof(header));
        say_raw(builder.GetBufferPointer(), builder.GetSize());
        return true;
    }
    if (habit == "silent")
        std::this_thread::sleep_for(std::chrono::hours(1));
    if (habit == "garbage") {
        const char garbage[] = "GET / HTTP/1.1\r\nHost: here\r\n\r\n";
        say_raw(garbage, sizeof(garbage));
        return true;
    }
    if (habit == "huge") {
        const std::uint32_t header[] = {0xffff'ffffU, 4};
        say_raw(header, sizeof(header));
        return true;
    }
    if (habit == "interrupts") {  // Ctrl-C while the run waits for us; who we are is for the test
        std::FILE* note = std::fopen("odd_driver.pid", "w");
        std::fprintf(note, "%d\n", static_cast<int>(getpid()));
        std::fclose(note);
        kill(getppid(), SIGINT);
        std::this_thread::sleep_for(std::chrono::hours(1));
    }
    if (habit == "leaves") {
        run.leave("enough");
        std::exit(0);
    }
    if (habit == "cut") {
        const std::uint32_t header[] = {64, 4};
        say_raw(header, sizeof(header));
        std::exit(0);
    }
    return false;
}

int be_of_another_version() {
    reprise::remote::FrameChannel channel(descriptor(), 256 << 20);
    channel.receive();
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(reprise::remote::CreateReady(builder, reprise::remote::wire_version + 1));
    channel.send(reprise::remote::Kind::ready, {builder.GetBufferPointer(), builder.GetSize()});
    channel.receive();
    return 0;
}

}  // namespace

int main(int count, char** words) {
    const std::string habit = count > 1 ? words[1] : "steady";
    if (habit == "never_ready")
        return 5;
    if (habit == "other_version")
        return be_of_another_version();
    const bool killed = habit == "killed";
    try {
        const double polling = habit == "polls"    ? 10
                               : habit == "sleeps" ? 0
                                                   : reprise::remote::usual_polling;
        Client run(count > 2 && !killed ? words[2] : "", polling);
        int ticks = 0;
        while (const auto tick = run.next()) {
            if (killed && tick->index() == std::strtoull(words[2], nullptr, 10))
                std::raise(SIGKILL);
            if (++ticks == 3 && misbehave(habit, run))
                continue;
            if (habit == "counting")
                run.say({.throttle = 0.125, .steer = static_cast<double>(tick->index()) / 1024});
            else
                run.say({.throttle = 0.25, .steer = 0.125, .lamps = 8});
        }
    } catch (const reprise::world::Error&) {
        return 6;
    }
    return 0;
}
