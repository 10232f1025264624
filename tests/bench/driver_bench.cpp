// What a driver in another program adds to a tick, beside a bare round trip of the same bytes in
// the same run: in each tick the same observation goes to one driver in C++, to one in Python, and
// to a child that only reads and replies.
#include <array>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <benchmark/benchmark.h>

#include "kernel/kernel.h"
#include "remote/seat.h"
#include "tests/bench/drive.h"
#include "tests/bench/timer.h"

namespace {

using namespace reprise;

constexpr int warm_up = 200;  // ticks until queues have formed
constexpr int measured = 600;
constexpr std::size_t answer_bytes = 64;

void move(int descriptor, std::vector<char>& bytes, bool out) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = out ? write(descriptor, bytes.data() + done, bytes.size() - done)
                                  : read(descriptor, bytes.data() + done, bytes.size() - done);
        if (count <= 0)
            throw std::runtime_error("the bare child is gone");
        done += static_cast<std::size_t>(count);
    }
}

/// A child at a socket that reads so many bytes, which four of them say before, and replies with
/// few.
class BareChild {
  public:
    BareChild() {
        std::array<int, 2> ends{};
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
            throw std::runtime_error("no socket");
        child_ = fork();
        if (child_ == 0) {
            close(ends[0]);
            serve(ends[1]);
        }
        close(ends[1]);
        socket_ = ends[0];
    }

    ~BareChild() {
        close(socket_);
        waitpid(child_, nullptr, 0);
    }

    BareChild(const BareChild&) = delete;
    BareChild& operator=(const BareChild&) = delete;

    void round_trip(std::size_t size) {
        std::vector<char> message(size + sizeof(std::uint32_t));
        const auto count = static_cast<std::uint32_t>(size);
        std::memcpy(message.data(), &count, sizeof(count));
        move(socket_, message, true);
        std::vector<char> answer(answer_bytes);
        move(socket_, answer, false);
    }

  private:
    [[noreturn]] static void serve(int socket) {
        try {
            for (;;) {
                std::vector<char> size(sizeof(std::uint32_t));
                move(socket, size, false);
                std::uint32_t count = 0;
                std::memcpy(&count, size.data(), sizeof(count));
                std::vector<char> message(count);
                move(socket, message, false);
                std::vector<char> answer(answer_bytes);
                move(socket, answer, true);
            }
        } catch (const std::exception&) {
            _exit(0);
        }
    }

    int socket_ = -1;
    pid_t child_ = -1;
};

/// As a run asks a driver. [s] into `watch`
world::Control ask(remote::Seat& seat, const world::SealedTick& tick, bench::Timer& watch) {
    world::Control said;
    watch.time([&] {
        if (const auto lost = seat.show(tick))
            throw std::runtime_error(lost->reason);
        const auto answer = seat.answer();
        if (const auto* lost = std::get_if<remote::Lost>(&answer))
            throw std::runtime_error(lost->reason);
        said = std::get<world::Control>(answer);
    });
    return said;
}

void Driver(benchmark::State& state) {
    world::Recording recording = bench::in_town1("tests/bench/driven.lua");
    const std::string source = REPRISE_SOURCE;
    bench::Timer step, cpp, python, bare;
    double bytes = 0;
    for ([[maybe_unused]] const auto _ : state) {
        BareChild child;
        kernel::Kernel kernel(recording);
        const world::SealedTick* tick = &kernel.step();
        remote::Seat fast({"ego", IDLE_DRIVER}, {});
        remote::Seat slow({"ego",
                           "PYTHONPATH=" + source + "/python /usr/bin/python3 " + source +
                               "/tests/bench/idle_driver.py"},
                          {});
        for (remote::Seat* seat : {&fast, &slow})
            if (const auto lost = seat->take(1, recording))
                throw std::runtime_error(lost->reason);
        bench::Timer unused;
        for (int i = 0; i < warm_up + measured; ++i) {
            const bool counts = i >= warm_up;
            const std::size_t size = tick->tick_bytes().size() + tick->traffic_bytes().size();
            const world::Control said = ask(fast, *tick, counts ? cpp : unused);
            ask(slow, *tick, counts ? python : unused);
            (counts ? bare : unused).time([&] { child.round_trip(size); });
            (counts ? step : unused).time([&] { tick = &kernel.step({&said, 1}); });
            bytes += counts ? static_cast<double>(size) / measured : 0;
        }
        state.SetIterationTime(step.sum() / measured);
    }
    state.counters["observation_B"] = bytes;
    state.counters["tick_us"] = 1e6 * step.median();
    state.counters["bare_us"] = 1e6 * bare.median();
    state.counters["cpp_us"] = 1e6 * cpp.median();
    state.counters["python_us"] = 1e6 * python.median();
    state.counters["cpp_of_bare"] = cpp.median() / bare.median();
    state.counters["python_of_bare"] = python.median() / bare.median();
    state.counters["ticks/s_cpp"] = 1 / (step.median() + cpp.median());
    state.counters["ticks/s_python"] = 1 / (step.median() + python.median());
}

BENCHMARK(Driver)->Iterations(1)->UseManualTime()->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
