#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "exchange/carla/carla_frame.h"

namespace reprise::exchange {

/// Where the bytes of a log are: `read` fills its argument from an offset on; the range lies in it.
struct CarlaBytes {
    std::string name;  ///< for messages
    std::uint64_t size = 0;
    std::function<void(std::uint64_t, std::span<std::uint8_t>)> read;
};

/// Where a log stops making sense.
struct CarlaDamage {
    std::uint64_t offset = 0;
    std::string what;
};

/// Reads a recording of CARLA's recorder frame by frame, in bounded memory: a window of 1 MB, or
/// one packet where that is larger, 64 MB at most. Packets of unknown kind are stepped over.
class CarlaLog {
  public:
    /// Reads the header and finds the variant. Throws world::Error, "x.log: byte N: ...", when this
    /// is no such log.
    explicit CarlaLog(CarlaBytes bytes);
    ~CarlaLog();
    CarlaLog(CarlaLog&&) noexcept;

    const std::string& map() const;
    std::int64_t date() const;  ///< [s] since 1970, UTC
    CarlaVariant variant() const;

    /// The next whole frame, or null at the end or where the log is damaged. Lives until the next
    /// call.
    const CarlaFrame* next();

    /// From the first frame again.
    void rewind();

    /// What ended the log before its end; nothing when it is whole as far as it was read.
    const std::optional<CarlaDamage>& damage() const;

    /// Bytes of the header and of the whole frames read so far.
    std::uint64_t offset() const;

    /// How many packets of which kind were stepped over.
    const std::map<std::uint8_t, std::uint64_t>& skipped() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace reprise::exchange
