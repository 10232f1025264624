#include "exchange/carla/carla_packets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "exchange/carla/carla_packet_kinds.h"

namespace reprise::exchange {

namespace {

using replay::mcap::Decoder;
using replay::mcap::Malformed;
using replay::mcap::View;

constexpr double farthest = 1e8;           // [cm] from the origin: ten times CARLA's largest maps
constexpr double most_turned = 1e6;        // [degrees]; some turn on and on
constexpr std::size_t longest_text = 200;  // bytes of a name or value that are kept

double read_float(Decoder& in) {
    return static_cast<double>(std::bit_cast<float>(in.number<std::uint32_t>()));
}

double read_double(Decoder& in) {
    return std::bit_cast<double>(in.number<std::uint64_t>());
}

/// What a packet holds, record by record.
class PacketReader {
  public:
    PacketReader(View content, CarlaVariant variant) : in_(content), variant_(variant) {}

    /// Vectors of `vectors` and other fields of `bytes` bytes make a record of this length.
    std::uint64_t record_size(std::uint64_t bytes, std::uint64_t vectors) const {
        return bytes + vectors * (variant_ == CarlaVariant::ue5 ? 24 : 12);
    }

    Eigen::Vector3d vector() {
        std::array<double, 3> v{};
        for (double& coordinate : v)
            coordinate = variant_ == CarlaVariant::ue5 ? read_double(in_) : read_float(in_);
        return {v[0], v[1], v[2]};
    }

    CarlaPose pose(std::uint32_t actor) {
        CarlaPose pose;
        pose.actor = actor;
        pose.location = vector();
        pose.rotation = vector();
        require(pose.location, farthest, "place", actor);
        require(pose.rotation, most_turned, "rotation", actor);
        return pose;
    }

    CarlaMotion motion() {
        CarlaMotion motion;
        motion.actor = in_.number<std::uint32_t>();
        motion.velocity = vector();
        require(motion.velocity, std::numeric_limits<double>::max(), "velocity", motion.actor);
        vector();  // angular
        return motion;
    }

    CarlaActor actor() {
        const auto id = in_.number<std::uint32_t>();
        const auto kind = in_.number<std::uint8_t>();
        CarlaActor actor;
        actor.kind = kind <= static_cast<std::uint8_t>(CarlaKind::traffic_light)
                         ? static_cast<CarlaKind>(kind)
                         : CarlaKind::other;
        actor.pose = pose(id);
        in_.number<std::uint32_t>();  // number of the blueprint
        actor.blueprint = read_carla_text(in_);
        for (auto left = in_.number<std::uint16_t>(); left > 0; --left) {
            in_.number<std::uint8_t>();  // type of the value
            std::string key = read_carla_text(in_);
            actor.attributes[std::move(key)] = read_carla_text(in_);
        }
        return actor;
    }

    CarlaBox box() {
        CarlaBox box;
        box.actor = in_.number<std::uint32_t>();
        box.middle = vector();
        box.extent = vector();
        return box;
    }

    Decoder& in() { return in_; }

  private:
    /// No number, or none that can be: what is made of it would be neither.
    static void require(const Eigen::Vector3d& value,
                        double largest,
                        const char* what,
                        std::uint32_t actor) {
        // Not their maximum: which number that is where one is none, depends on their order.
        if (!(value.array().abs() <= largest).all())
            throw Malformed(fmt::format("the {} of actor {} is ({:g}, {:g}, {:g})",
                                        what,
                                        actor,
                                        value.x(),
                                        value.y(),
                                        value.z()));
    }

    Decoder in_;
    CarlaVariant variant_;
};

CarlaControl read_control(Decoder& in) {
    CarlaControl control;
    control.actor = in.number<std::uint32_t>();
    read_float(in);  // steering
    read_float(in);  // throttle
    control.brake = read_float(in);
    if (!std::isfinite(control.brake))
        throw Malformed(fmt::format("the brake of actor {} is {:g}", control.actor, control.brake));
    in.number<std::uint8_t>();  // hand brake
    control.gear = in.number<std::int32_t>();
    return control;
}

CarlaLight read_light(Decoder& in) {
    CarlaLight light;
    light.actor = in.number<std::uint32_t>();
    in.number<std::uint8_t>();  // frozen
    read_float(in);             // since the last change
    const auto color = in.number<std::uint8_t>();
    light.color = color < static_cast<std::uint8_t>(CarlaColor::unknown)
                      ? static_cast<CarlaColor>(color)
                      : CarlaColor::unknown;
    return light;
}

/// Packets of so many records of one length.
bool read_records(std::uint8_t kind, PacketReader packet, std::uint64_t size, CarlaFrame& frame) {
    Decoder& in = packet.in();
    const auto each = [&](std::uint64_t record_size, auto read) {
        const auto records = in.number<std::uint16_t>();
        if (size == 2 + records * record_size) {
            for (std::size_t i = 0; i < records; ++i)
                read();
            return true;
        }
        if (kind == position || kind == event_del)
            throw Malformed(fmt::format("{} of {} records has {} bytes, expected {}",
                                        carla_packet_name(kind),
                                        records,
                                        size,
                                        2 + records * record_size));
        return false;  // of a version that says more, or less
    };
    const auto id = [&] { return in.number<std::uint32_t>(); };
    switch (kind) {
        case event_del:
            return each(4, [&] { frame.removed.push_back(id()); });
        case collision:
            return each(14, [&] {
                id();  // a running number
                const std::uint32_t actor = id();
                frame.collisions.push_back({actor, id()});
                in.number<std::uint16_t>();  // which of the two is the hero
            });
        case position:
            return each(packet.record_size(4, 2),
                        [&] { frame.poses.push_back(packet.pose(id())); });
        case state:
            return each(10, [&] { frame.lights.push_back(read_light(in)); });
        case anim_vehicle:
            return each(21, [&] { frame.controls.push_back(read_control(in)); });
        case vehicle_light:
            return each(8, [&] {
                const std::uint32_t actor = id();
                frame.lamps.push_back({actor, id()});
            });
        case kinematics:
            return each(packet.record_size(4, 2),
                        [&] { frame.motions.push_back(packet.motion()); });
        case bounding_box:
            return each(packet.record_size(4, 2), [&] { frame.boxes.push_back(packet.box()); });
        case trigger_volume:
            return each(packet.record_size(4, 2), [&] { frame.triggers.push_back(packet.box()); });
        default:
            return false;
    }
}

}  // namespace

std::string read_carla_text(Decoder& in) {
    const View bytes = in.raw(in.number<std::uint16_t>());
    std::string text(
        bytes.begin(),
        bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), longest_text)));
    for (char& c : text)
        c = c >= ' ' && c <= '~' ? c : '?';
    return text;
}

std::uint64_t position_packet_size(std::uint64_t records, CarlaVariant variant) {
    return 2 + records * PacketReader({}, variant).record_size(4, 2);
}

bool read_carla_packet(std::uint8_t kind, View content, CarlaVariant variant, CarlaFrame& frame) {
    PacketReader packet(content, variant);
    if (kind != event_add)
        return read_records(kind, packet, content.size(), frame);
    for (auto left = packet.in().number<std::uint16_t>(); left > 0; --left)
        frame.added.push_back(packet.actor());
    if (!packet.in().rest().empty())
        throw Malformed("EventAdd is longer than what it holds");
    return true;
}

}  // namespace reprise::exchange
