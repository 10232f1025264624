#include "exchange/carla/carla_log.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>

#include <gmock/gmock.h>

#include "exchange/carla/carla_packet_kinds.h"
#include "tests/exchange/carla_logs.h"
#include "world/check.h"
#include "world/random.h"

namespace reprise::exchange {
namespace {

using test::bytes_of;
using test::carla_log;
using testing::HasSubstr;

/// What is wrong with these bytes; empty: nothing. Reads everything that can be read.
std::string complaint(const std::string& bytes) {
    try {
        CarlaLog log(bytes_of(bytes));
        while (log.next() != nullptr) {
        }
        return log.damage() ? log.damage()->what : "";
    } catch (const world::Error& error) {
        return error.what();
    }
}

TEST(CarlaLog, ReadsTheHeader) {
    const CarlaLog log(bytes_of(carla_log("--seconds 0.1")));
    EXPECT_EQ(log.map(), "Carla/Maps/Town01");
    EXPECT_EQ(log.date(), 1'600'000'000);
}

TEST(CarlaLog, TellsFloatsFromDoubles) {
    EXPECT_EQ(CarlaLog(bytes_of(carla_log("--seconds 0.1"))).variant(), CarlaVariant::ue4);
    EXPECT_EQ(CarlaLog(bytes_of(carla_log("--seconds 0.1 --ue5"))).variant(), CarlaVariant::ue5);
}

TEST(CarlaLog, ReadsWhatTheFirstFrameSays) {
    for (const std::string variant : {"", " --ue5"}) {
        CarlaLog log(bytes_of(carla_log("--seconds 0.5 --additional" + variant)));
        const CarlaFrame* frame = log.next();
        ASSERT_NE(frame, nullptr);
        ASSERT_EQ(frame->added.size(), 6U);
        const CarlaActor& car = frame->added.front();
        EXPECT_EQ(car.pose.actor, 24U);
        EXPECT_EQ(car.kind, CarlaKind::vehicle);
        EXPECT_EQ(car.blueprint, "vehicle.tesla.model3");
        EXPECT_EQ(car.attributes.at("role_name"), "hero");
        EXPECT_EQ(car.pose.location, Eigen::Vector3d(3000, 0, 0));
        EXPECT_EQ(car.pose.rotation, Eigen::Vector3d(0, 0, 90));
        EXPECT_EQ(frame->poses.size(), 5U) << "the prop has a place, the traffic light has none";
        ASSERT_EQ(frame->lights.size(), 1U);
        EXPECT_EQ(frame->lights.front().color, CarlaColor::green);
        EXPECT_EQ(frame->lamps.size(), 3U);
        EXPECT_EQ(frame->controls.size(), 3U);
        EXPECT_EQ(frame->motions.size(), 4U);
        EXPECT_EQ(frame->boxes.size(), 1U);
        ASSERT_EQ(frame->triggers.size(), 1U);
        EXPECT_EQ(frame->triggers.front().extent, Eigen::Vector3d(200, 200, 200));
    }
}

TEST(CarlaLog, StepsOverPacketsThatItDoesNotKnow) {
    CarlaLog log(bytes_of(carla_log("--frames 3")));
    while (log.next() != nullptr) {
    }
    EXPECT_FALSE(log.damage());
    EXPECT_EQ(log.skipped().at(142), 3U);
    EXPECT_EQ(carla_packet_name(142), "unknown packet 142");
    EXPECT_EQ(carla_packet_name(6), "Position");
}

TEST(CarlaLog, ReadsTheSameAgainAfterRewinding) {
    CarlaLog log(bytes_of(carla_log("--frames 5")));
    std::vector<double> first;
    std::vector<double> again;
    while (const CarlaFrame* frame = log.next())
        first.push_back(frame->poses.front().location.x());
    const std::uint64_t end = log.offset();
    log.rewind();
    while (const CarlaFrame* frame = log.next())
        again.push_back(frame->poses.front().location.x());
    EXPECT_EQ(first.size(), 5U);
    EXPECT_EQ(first, again);
    EXPECT_EQ(log.offset(), end);
}

TEST(CarlaLog, KeepsTheWholeFramesOfALogThatWasCutOff) {
    const std::string whole = carla_log("--frames 4");
    CarlaLog log(bytes_of(carla_log("--frames 5 --cut 30")));
    int frames = 0;
    while (log.next() != nullptr)
        ++frames;
    EXPECT_EQ(frames, 4);
    ASSERT_TRUE(log.damage());
    EXPECT_EQ(log.offset(), whole.size()) << "what is lost begins with the fifth frame";
    EXPECT_GE(log.damage()->offset, whole.size());
}

TEST(CarlaLog, SaysWhatIsNoLog) {
    EXPECT_THAT(complaint(""), HasSubstr("ends within its header"));
    EXPECT_THAT(complaint(std::string("\x01\x00\x0e\x00SOMETHING_ELSE", 18)),
                HasSubstr("expected CARLA_RECORDER"));
    std::string newer = carla_log("--frames 1");
    newer[0] = 2;
    EXPECT_THAT(complaint(newer), HasSubstr("version 2 of CARLA's recorder"));
}

/// Every cut leaves either a whole number of frames, or a complaint.
TEST(CarlaLog, SurvivesEveryCutOfItsFirstTwoKilobytes) {
    for (const std::string variant : {"", " --ue5 --additional"}) {
        const std::string bytes = carla_log("--frames 6" + variant);
        ASSERT_GT(bytes.size(), 2048U);
        std::size_t sound = 0;
        for (std::size_t size = 0; size < 2048; ++size)
            sound += complaint(bytes.substr(0, size)).empty() ? 1 : 0;
        EXPECT_GE(sound, 1U) << "a header alone is sound";
        EXPECT_LE(sound, 7U) << "and so is what ends with a frame";
    }
}

/// Where a packet of this kind begins, and its size.
std::pair<std::size_t, std::size_t> packet_in(const std::string& log, std::uint8_t kind) {
    const auto number = [&](std::size_t at, std::size_t bytes) {
        std::size_t value = 0;
        for (std::size_t i = bytes; i > 0; --i)
            value = value << 8 | static_cast<unsigned char>(log[at + i - 1]);
        return value;
    };
    std::size_t at = 2 + 2 + number(2, 2) + 8;
    at += 2 + number(at, 2);
    while (at < log.size() && static_cast<std::uint8_t>(log[at]) != kind)
        at += 5 + number(at + 1, 4);
    return {at, number(at + 1, 4)};
}

/// Numbers of which nothing can be made are told with their packet, where they stand in the way.
TEST(CarlaLog, NamesThePacketAndTheByteOfWhatIsNoNumber) {
    struct Place {
        std::uint8_t kind;
        std::size_t offset;  ///< of the float in the packet's first record
        const char* name;
    };

    const std::string bytes = carla_log("--frames 3 --additional");
    for (const Place& place : {Place{2, 2 + 4 + 1, "EventAdd: the place of actor"},
                               Place{6, 2 + 4, "Position: the place of actor"},
                               Place{6, 2 + 4 + 4, "Position: the place of actor"},
                               Place{6, 2 + 4 + 8, "Position: the place of actor"},
                               Place{6, 2 + 4 + 12, "Position: the rotation of actor"},
                               Place{6, 2 + 4 + 16, "Position: the rotation of actor"},
                               Place{6, 2 + 4 + 20, "Position: the rotation of actor"},
                               Place{8, 2 + 4 + 8, "the brake of actor"},
                               Place{12, 2 + 4, "the velocity of actor"},
                               Place{12, 2 + 4 + 8, "the velocity of actor"}})
        for (const float value :
             {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
            std::string bad = bytes;
            const std::size_t packet = packet_in(bytes, place.kind).first;
            std::memcpy(bad.data() + packet + 5 + place.offset, &value, sizeof(value));
            CarlaLog log(bytes_of(bad));
            EXPECT_EQ(log.next(), nullptr) << place.name;
            ASSERT_TRUE(log.damage()) << place.name;
            EXPECT_EQ(log.damage()->offset, packet);
            EXPECT_THAT(log.damage()->what, HasSubstr(place.name));
        }
}

/// What a reader learns from a log, frame by frame, and where each frame ends.
struct Told {
    std::vector<std::string> frames;
    std::vector<std::uint64_t> ends;
    std::optional<CarlaDamage> damage;
};

std::string told(const CarlaFrame& frame) {
    std::ostringstream text;
    text << std::hexfloat << frame.number << ' ' << frame.elapsed;
    const auto add_vector = [&](const Eigen::Vector3d& v) {
        text << ' ' << v.x() << ' ' << v.y() << ' ' << v.z();
    };
    for (const CarlaActor& actor : frame.added) {
        text << " +" << actor.pose.actor << ' ' << actor.blueprint;
        for (const auto& [key, value] : actor.attributes)
            text << ' ' << key << '=' << value;
    }
    for (const std::uint32_t actor : frame.removed)
        text << " -" << actor;
    for (const CarlaPose& pose : frame.poses) {
        text << " @" << pose.actor;
        add_vector(pose.location);
        add_vector(pose.rotation);
    }
    for (const CarlaLight& light : frame.lights)
        text << " light " << light.actor << ' ' << static_cast<int>(light.color);
    for (const CarlaControl& control : frame.controls)
        text << " control " << control.actor << ' ' << control.brake << ' ' << control.gear;
    for (const CarlaMotion& motion : frame.motions) {
        text << " motion " << motion.actor;
        add_vector(motion.velocity);
    }
    text << ' ' << frame.collisions.size() << ' ' << frame.lamps.size() << ' ' << frame.boxes.size()
         << ' ' << frame.triggers.size();
    return text.str();
}

Told read_all(const std::string& bytes) {
    Told all;
    CarlaLog log(bytes_of(bytes));
    while (const CarlaFrame* frame = log.next()) {
        all.frames.push_back(told(*frame));
        all.ends.push_back(log.offset());
    }
    all.damage = log.damage();
    return all;
}

/// Whatever bit is flipped: a refusal, a complaint that names a place in the log from the flip's
/// frame on, or frames to the end; and each frame before the flip is told as without it.
TEST(CarlaLog, SurvivesBitFlips) {
    for (const std::string variant : {"", " --ue5"}) {
        const std::string bytes = carla_log("--frames 20 --additional" + variant);
        const Told whole = read_all(bytes);
        ASSERT_EQ(whole.frames.size(), 20U);
        ASSERT_FALSE(whole.damage);
        std::size_t complaints = 0;
        for (std::uint64_t i = 0; i < 500; ++i) {
            const std::uint64_t bit =
                world::draw_index(8 * bytes.size(), 1, 0, world::Purpose::scenario, i);
            std::string flipped = bytes;
            flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
            const auto before = static_cast<std::size_t>(
                std::upper_bound(whole.ends.begin(), whole.ends.end(), bit / 8) -
                whole.ends.begin());
            Told found;
            try {
                found = read_all(flipped);
            } catch (const world::Error& error) {
                EXPECT_EQ(before, 0U) << error.what();  // of a header only
                EXPECT_THAT(error.what(), HasSubstr("byte "));
                continue;
            }
            ASSERT_GE(found.frames.size(), before) << "bit " << bit;
            for (std::size_t k = 0; k < before; ++k)
                ASSERT_EQ(found.frames[k], whole.frames[k]) << "bit " << bit << ", frame " << k;
            if (!found.damage)
                continue;
            ++complaints;
            EXPECT_FALSE(found.damage->what.empty());
            EXPECT_LE(found.damage->offset, bytes.size());
            EXPECT_GE(found.damage->offset, before == 0 ? 0 : whole.ends[before - 1]);
        }
        EXPECT_GT(complaints, 20U) << "lengths, kinds and clocks are looked at";
    }
}

}  // namespace
}  // namespace reprise::exchange
