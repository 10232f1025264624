#include "traffic/sumo.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <iostream>
#include <numbers>
#include <sstream>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "world/check.h"

// SUMO looks for the translation of a message that it does not say, for each car in each step,
// which is a hundredth of a tick. What it says is to be the same under every locale anyway: the
// libraries that a program loads take this one for the C library's. In brackets, for that has a
// macro of it.
extern "C" char*(gettext)(const char* message) noexcept {
    return const_cast<char*>(message);
}

namespace reprise::traffic {

/// SUMO's MSNet::writeOutput, taken over as its gettext is: in each step it looks up by their names
/// which of some thirty files it is to write, and it writes none.
void write_no_output(void* net) asm("_ZN5MSNet11writeOutputEv");

void write_no_output(void*) {}

namespace {

bool running = false;  // libsumo is a global of the process, and silently accepts a second start

/// Bytes that can be opened under a path and that vanish with the process, however it ends.
class MemoryFile {
  public:
    explicit MemoryFile(std::string_view bytes) : file_(memfd_create("reprise", MFD_CLOEXEC)) {
        std::size_t written = 0;
        while (file_ >= 0 && written < bytes.size()) {
            const ssize_t count = write(file_, bytes.data() + written, bytes.size() - written);
            if (count < 0 && errno == EINTR)
                continue;
            if (count < 0)
                throw world::Error(fmt::format(
                    "cannot keep the network in memory: {}{}",
                    std::strerror(errno),
                    errno == EFBIG ? "; the limit on files (ulimit -f) holds there as well" : ""));
            written += static_cast<std::size_t>(count);
        }
        if (file_ < 0)
            throw world::Error(
                fmt::format("cannot make a file in memory: {}", std::strerror(errno)));
    }

    ~MemoryFile() { close(file_); }

    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const { return fmt::format("/proc/self/fd/{}", file_); }

  private:
    int file_;
};

/// Catches what SUMO says on std::cout and std::cerr while this lives: rooms do not print.
class Silence {
  public:
    Silence() : out_(std::cout.rdbuf(said_.rdbuf())), error_(std::cerr.rdbuf(said_.rdbuf())) {}

    ~Silence() {
        std::cout.rdbuf(out_);
        std::cerr.rdbuf(error_);
    }

    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

    /// The first line, without "Error: ", and without the name of our file in memory.
    std::string first_line() const {
        std::string text = said_.str();
        text = text.substr(0, text.find('\n'));
        if (text.starts_with("Error: "))
            text.erase(0, 7);
        return text;
    }

  private:
    std::ostringstream said_;
    std::streambuf* out_;
    std::streambuf* error_;
};

/// Every option that could change a run, whether or not it is SUMO's default today.
std::vector<std::string> command_line(const world::EpisodeT& episode,
                                      const MemoryFile& network,
                                      const MemoryFile& types) {
    constexpr std::uint64_t ns_per_ms = 1'000'000;
    const std::uint64_t step_ms = episode.step_ns / ns_per_ms;
    return {
        "sumo",
        "--net-file",
        network.path(),
        "--additional-files",
        types.path(),
        "--begin",
        "0",
        "--step-length",
        fmt::format("{}.{:03}", step_ms / 1000, step_ms % 1000),
        "--seed",
        fmt::format("{}", sumo_seed(episode.seed)),
        // One thread: SUMO's results may depend on the number of routing threads (its issue 10292).
        "--threads",
        "1",
        "--thread-rngs",
        "64",
        "--device.rerouting.threads",
        "0",
        "--device.rerouting.probability",
        "0",
        "--weights.random-factor",
        "1",
        // Nothing jumps: what blocks, blocks; see Demand for cars that stand for minutes.
        "--time-to-teleport",
        "-1",
        "--time-to-teleport.highways",
        "-1",
        "--time-to-teleport.disconnected",
        "-1",
        "--time-to-teleport.remove",
        "false",
        "--collision.action",
        "none",
        "--collision.check-junctions",
        "false",
        "--ignore-junction-blocker",
        "-1",
        // Routes are made here, link by link; SUMO need not end the run over one.
        "--ignore-route-errors",
        "true",
        "--step-method.ballistic",
        "false",
        "--default.action-step-length",
        "0",
        "--lateral-resolution",
        "-1",
        // A lane change takes three seconds instead of one tick: cars have no business to jump.
        "--lanechange.duration",
        "3",
        "--extrapolate-departpos",
        "false",
        "--max-depart-delay",
        "-1",
        "--max-num-vehicles",
        "-1",
        "--scale",
        "1",
        // For how long SUMO remembers when a car has waited: nobody asks it.
        "--waiting-time-memory",
        "1",
        "--no-internal-links",
        "false",
        "--tls.all-off",
        "false",
        // Quiet, and no file but ours: schemas would be looked up under SUMO_HOME.
        "--xml-validation",
        "never",
        "--xml-validation.net",
        "never",
        "--xml-validation.routes",
        "never",
        "--no-step-log",
        "true",
        "--no-warnings",
        "true",
        "--duration-log.disable",
        "true",
    };
}

}  // namespace

SumoProcess::SumoProcess(const world::EpisodeT& episode, std::string_view network) {
    REPRISE_CHECK(!running, "libsumo is one a process: destroy the first Background");
    if (episode.step_ns == 0 || episode.step_ns % 1'000'000 != 0)
        throw world::Error(fmt::format("{}: a step of {} ns: SUMO needs whole milliseconds",
                                       episode.scenario_path,
                                       episode.step_ns));
    const MemoryFile network_file(network);
    const MemoryFile types_file(vehicle_types_xml());
    const Silence silence;
    try {
        libsumo::Simulation::start(command_line(episode, network_file, types_file));
        running = true;
    } catch (const std::exception& failure) {
        const std::string said = silence.first_line();
        try {
            libsumo::Simulation::close();
        } catch (const std::exception&) {  // there is nothing to close
        }
        throw world::Error(fmt::format(
            "{}.net.xml: SUMO refuses it: {}", episode.town, said.empty() ? failure.what() : said));
    }
}

SumoProcess::~SumoProcess() {
    const Silence silence;
    try {
        libsumo::Simulation::close();
    } catch (const std::exception&) {  // SUMO is gone either way
    }
    running = false;
}

std::string sumo_id(std::uint32_t actor) {
    return fmt::format("{:010}", actor);
}

double sumo_angle_deg(double yaw) {
    const double angle = 90 - yaw * 180 / std::numbers::pi;
    return angle < 0 ? angle + 360 : angle;
}

std::uint32_t sumo_seed(std::uint64_t seed) {
    return static_cast<std::uint32_t>((seed ^ (seed >> 32)) & 0x7fffffffU);
}

}  // namespace reprise::traffic
