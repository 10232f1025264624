// Must: take any bytes; never hold more than one packet; say where and why a log ends early.
// Assumes: little endian; every packet says how long it is.
// Goes: header, then a look ahead for a packet of positions, whose length tells floats from
// doubles;
//   then packet by packet, a frame counts when its FrameEnd is there.
// Keeps: a window of the file, and the frame being read.
#include "exchange/carla/carla_log.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "exchange/carla/carla_packet_kinds.h"
#include "exchange/carla/carla_packets.h"
#include "replay/mcap/mcap.h"
#include "world/check.h"

namespace reprise::exchange {

namespace {

using replay::mcap::Decoder;
using replay::mcap::Malformed;
using replay::mcap::View;

constexpr std::uint64_t window_size = std::uint64_t{1} << 20;
constexpr std::uint64_t largest_packet = std::uint64_t{64} << 20;
constexpr std::uint64_t prefix_size = 5;  // u8 kind, u32 size
constexpr std::uint32_t no_records = 2;   // bytes of a packet that holds nothing
constexpr double longest_pause = 60;      // [s] between two frames; CARLA's are about 0.05 s apart
}  // namespace

struct CarlaLog::State {
    CarlaBytes bytes;
    std::string map;
    std::int64_t date = 0;
    CarlaVariant variant = CarlaVariant::ue4;
    std::vector<std::uint8_t> window;
    std::uint64_t window_at = 0;
    std::uint64_t at = 0;  ///< of the next packet
    std::uint64_t first_packet = 0;
    std::uint64_t whole = 0;  ///< where the last whole frame ends
    std::optional<double> last_elapsed;
    std::optional<CarlaDamage> damage;
    std::map<std::uint8_t, std::uint64_t> skipped;
    CarlaFrame frame;

    /// These bytes, which lie in the log; until the next call.
    View view(std::uint64_t offset, std::uint64_t size) {
        if (offset < window_at || offset + size > window_at + window.size()) {
            window.resize(std::min(std::max(size, window_size), bytes.size - offset));
            bytes.read(offset, window);
            window_at = offset;
        }
        return View(window).subspan(offset - window_at, size);
    }

    struct Prefix {
        std::uint8_t kind;
        std::uint32_t size;
    };

    /// Of the packet at `offset`; throws Malformed when it does not lie wholly in the log.
    Prefix prefix(std::uint64_t offset) {
        const std::uint64_t left = bytes.size - offset;
        if (left < prefix_size)
            throw Malformed("the log is cut off within a packet");
        Decoder in(view(offset, prefix_size));
        const auto kind = in.number<std::uint8_t>();
        const auto size = in.number<std::uint32_t>();
        if (size > left - prefix_size)
            throw Malformed(fmt::format("{} of {} bytes, but the log has {} more",
                                        carla_packet_name(kind),
                                        size,
                                        left - prefix_size));
        return {kind, size};
    }

    void read_header();
    void find_variant();
    void start_frame(View content);
    bool read_packet(const Prefix& next);
    bool read_frame();
};

void CarlaLog::State::read_header() {
    const std::uint64_t size = std::min<std::uint64_t>(bytes.size, 65'536 + 64);
    Decoder in(view(0, size));
    const auto fail = [&](std::uint64_t offset, const std::string& what) {
        throw world::Error(fmt::format("{}: byte {}: {}", bytes.name, offset, what));
    };
    try {
        const auto version = in.number<std::uint16_t>();
        const std::string magic = read_carla_text(in);
        if (magic != "CARLA_RECORDER")
            fail(2, "not a recording of CARLA's recorder (expected CARLA_RECORDER)");
        if (version != 1)
            fail(0, fmt::format("version {} of CARLA's recorder, expected 1", version));
        date = in.number<std::int64_t>();
        map = read_carla_text(in);
    } catch (const Malformed&) {
        fail(bytes.size, "the log ends within its header");
    }
    at = first_packet = whole = size - in.rest().size();
}

void CarlaLog::State::find_variant() {
    try {
        for (std::uint64_t offset = at; offset < bytes.size;) {
            const Prefix next = prefix(offset);
            if (next.kind == position && next.size > 2) {
                const auto records = Decoder(view(offset + prefix_size, 2)).number<std::uint16_t>();
                if (records > 0) {
                    if (next.size == position_packet_size(records, CarlaVariant::ue5))
                        variant = CarlaVariant::ue5;
                    return;
                }
            }
            offset += prefix_size + next.size;
        }
    } catch (const Malformed&) {
        // Reading the frames comes to the same place and says so.
    }
}

void CarlaLog::State::start_frame(View content) {
    Decoder in(content);
    frame = {};
    frame.number = in.number<std::uint64_t>();
    in.number<std::uint64_t>();  // how long the frame took
    frame.elapsed = std::bit_cast<double>(in.number<std::uint64_t>());
    const double last = last_elapsed.value_or(frame.elapsed);
    if (!(frame.elapsed >= last && frame.elapsed <= last + longest_pause && frame.elapsed >= 0 &&
          frame.elapsed < 1e7))
        throw Malformed(
            fmt::format("the clock goes from {:.3f} s to {:.3f} s", last, frame.elapsed));
}

/// False when it holds something that is not read.
bool CarlaLog::State::read_packet(const Prefix& next) {
    try {
        return read_carla_packet(next.kind, view(at + prefix_size, next.size), variant, frame);
    } catch (const Malformed& error) {
        throw Malformed(carla_packet_name(next.kind) + ": " + error.what());
    }
}

/// False at the end. Throws Malformed; `at` is then the packet that is to blame.
bool CarlaLog::State::read_frame() {
    bool inside = false;
    while (at < bytes.size) {
        const Prefix next = prefix(at);
        const bool is_known = is_known_packet(next.kind);
        if (!inside && is_known && next.kind != frame_start)
            throw Malformed(carla_packet_name(next.kind) + " outside of a frame");
        if (inside && next.kind == frame_start)
            throw Malformed("a frame begins before the last one has ended");
        if (is_known && next.size > largest_packet)
            throw Malformed(fmt::format("{} of {} bytes", carla_packet_name(next.kind), next.size));
        if (!is_known)
            ++skipped[next.kind];
        else if (next.kind == frame_start)
            start_frame(view(at + prefix_size, next.size));
        else if (next.kind != frame_end && !read_packet(next) && next.size > no_records)
            ++skipped[next.kind];
        inside = inside || next.kind == frame_start;
        at += prefix_size + next.size;
        if (next.kind == frame_end)
            return true;
    }
    if (inside)
        throw Malformed("the log is cut off within a frame");
    return false;
}

CarlaLog::CarlaLog(CarlaBytes bytes) : state_(std::make_unique<State>()) {
    state_->bytes = std::move(bytes);
    state_->read_header();
    state_->find_variant();
}

CarlaLog::~CarlaLog() = default;
CarlaLog::CarlaLog(CarlaLog&&) noexcept = default;

const std::string& CarlaLog::map() const {
    return state_->map;
}

std::int64_t CarlaLog::date() const {
    return state_->date;
}

CarlaVariant CarlaLog::variant() const {
    return state_->variant;
}

const CarlaFrame* CarlaLog::next() {
    if (state_->damage)
        return nullptr;
    try {
        if (!state_->read_frame())
            return nullptr;
    } catch (const Malformed& error) {
        state_->damage = CarlaDamage{state_->at, error.what()};
        return nullptr;
    }
    state_->whole = state_->at;
    state_->last_elapsed = state_->frame.elapsed;
    return &state_->frame;
}

void CarlaLog::rewind() {
    state_->at = state_->whole = state_->first_packet;
    state_->last_elapsed.reset();
    state_->damage.reset();
    state_->skipped.clear();
}

const std::optional<CarlaDamage>& CarlaLog::damage() const {
    return state_->damage;
}

std::uint64_t CarlaLog::offset() const {
    return state_->whole;
}

const std::map<std::uint8_t, std::uint64_t>& CarlaLog::skipped() const {
    return state_->skipped;
}

}  // namespace reprise::exchange
