#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "replay/trace_reader.h"
#include "world/recording.h"
#include "world/tick.h"

/// Runs made up without a kernel: a vehicle and some cars that drive about.
namespace reprise::test {

/// The straight road with its signal, seed 7, and a few bytes for a network.
world::Recording recording(std::uint64_t seed = 7);

/// Changes a tick before it is sealed. Stage digests are computed before this.
using Change = std::function<void(world::TickDraft&)>;

/// The change, at one tick only.
Change at(std::uint64_t tick, Change change);

struct SyntheticRun {
    std::uint64_t ticks = 150;
    std::uint32_t cars = 5;
    std::uint64_t seed = 7;  ///< of the recording: it starts the chain
    Change change = {};      ///< called for every tick
};

std::vector<world::SealedTick> drive(const SyntheticRun& run = {});

/// Writes such a run, closed, with the verdict "passed".
void write_trace(const std::filesystem::path& path, const SyntheticRun& run = {});

replay::RecordedTick as_recorded(const world::SealedTick& tick);

/// Deep copies of what TraceReader lends.
struct TickBytes {
    std::vector<std::uint8_t> tick;
    std::vector<std::uint8_t> traffic;

    bool operator==(const TickBytes&) const = default;
};

TickBytes bytes_of(const replay::RecordedTick& tick);
TickBytes bytes_of(const world::SealedTick& tick);

std::vector<std::uint8_t> read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes);

/// A folder of its own for a test, removed with all that is in it.
class Folder {
  public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// What `action` throws as world::Error, or "" when it does not.
std::string error_of(const std::function<void()>& action);

}  // namespace reprise::test
