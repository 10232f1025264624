// Private to the room.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <nlohmann/json.hpp>

#include "exchange/page/number_column.h"
#include "world/tick.h"

namespace reprise::exchange {

/// Who was where: one track for each time that an actor was there without a break.
class PageActors {
  public:
    /// Those with mass, at the next frame of the ticks' clock.
    void add_bodies(const world::TickView& tick);

    /// Everybody else, at the next frame of the traffic's clock: it may tick more seldom.
    void add_traffic(const world::TickView& tick);

    /// Into `head` the clocks, the tracks, the models and the columns' names and sizes; the
    /// columns' bytes are returned.
    std::string write(nlohmann::json& head) const;

  private:
    enum Clock : std::uint8_t { of_ticks, of_traffic, clocks };

    enum Kind : std::uint8_t { vehicle, car, walker, prop };

    /// In the page's units: cm, 1/4096 turn, cm/s.
    struct Sample {
        std::int32_t x = 0;
        std::int32_t y = 0;
        std::int32_t yaw = 0;
        std::int32_t speed = 0;
        std::int32_t lane = -1;  ///< in Town.lanes; -1: none
        std::int32_t lamps =
            0;  ///< Lamp bits; from bit 16 on: doors that are open, as Door counts them
        // Of those with mass only.
        std::int16_t steer = 0;   ///< [mrad] of the front wheels
        std::int16_t pedals = 0;  ///< [%] throttle, or less than 0: brake
        std::int32_t gap = 0;     ///< [cm] ahead
        std::int32_t offset = 0;  ///< [cm] left of the lane's centre line
    };

    struct Track {
        std::uint32_t id = 0;
        Kind kind = Kind::vehicle;
        std::uint16_t model = 0;
        std::size_t first = 0;  ///< frame of its clock
        std::vector<Sample> samples;
    };

    /// The track of whoever is seen at the last frame of a clock: a new one after a break.
    Track& track(Clock clock, Kind kind, std::uint32_t id, std::uint16_t model);

    struct Columns;

    static void append(const Track& track, Columns& columns);

    static Sample sample(const world::Vec3& position, double yaw, double speed);

    std::vector<std::uint64_t> ticks_[clocks];
    std::vector<Track> tracks_[clocks];
    std::map<std::uint32_t, std::size_t> last_[clocks];  ///< by actor: its last track
};

}  // namespace reprise::exchange
