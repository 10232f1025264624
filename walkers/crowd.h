#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "walkers/gate.h"
#include "walkers/neighbours.h"
#include "walkers/on_foot.h"
#include "walkers/person.h"
#include "walkers/places.h"
#include "walkers/road_traffic.h"
#include "walkers/road_users.h"
#include "walkers/steering.h"
#include "walkers/threats.h"
#include "walkers/walker_lights.h"
#include "walkers/walking_ground.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::walkers {

/// Ids of background walkers; those of background cars lie below. Never reused within an episode.
inline constexpr std::uint32_t first_walker_id = 100'000'000;

/// As many people on foot as the episode asks for, each on the way to somewhere.
///
/// MUST    depend on ticks and commands alone, to the bit; leave the pavement at crossings only
///         (but for jaywalkers), step onto none at red, look before stepping onto a road; never
///         overlap; go on.
/// ASSUMES ticks come in order.
/// GOES    one by one in the order of ids. First everybody says where to: along the way that the
///         walk map gave, waiting at gates, around others as DetourCrowd's avoidance says, and out
///         of the way of cars that are about to roll over him. Then everybody takes a step, which
///         is not taken where somebody stands by then.
/// KEEPS   who they are, where, and their ways; the lights' usual times.
class Crowd {
  public:
    /// All of them must outlive this.
    Crowd(const world::EpisodeT& episode,
          const world::TownT& town,
          const world::LaneMap& lanes,
          WalkingGround& ground);

    /// Adds everybody to next.walkers, behind the scenario's walkers that are there by now,
    /// and the events of those who come and go.
    void advance(const world::TickView& last, OnFoot& next);

    /// The unrounded number behind a recorded one, for a drill; null: not of this crowd.
    double* number(std::uint32_t id, std::string_view field);

    void add_to(world::Hasher& hasher) const;

  private:
    static constexpr double beside = 0.8;  ///< [m] between two who walk together

    /// [ticks] that one waits for a gap; where there is a crossing, and where there is none.
    static constexpr std::uint32_t patience = 1800;
    static constexpr std::uint32_t patience_elsewhere = 400;

    struct Walker {
        std::uint32_t id = 0;
        Person person;
        WalkMap::Place place;
        Eigen::Vector2d velocity{0, 0};  ///< [m/s]
        double yaw = 0;
        double phase = 0;                ///< of the walk cycle, in [0, 1)
        std::vector<WalkMap::Step> way;  ///< empty: has none
        std::size_t corner = 0;          ///< of the way, that he walks to
        std::vector<Gate> gates;
        std::size_t gate = 0;          ///< the next one of them
        bool may_enter = false;        ///< the next gate, in this tick
        bool on_road = false;          ///< before the step
        bool entered = false;          ///< the next gate: he is past the kerb
        bool gave_up = false;          ///< to cross anywhere, on this way
        std::uint32_t waited = 0;      ///< [ticks] at the next gate
        std::uint32_t lets = 0;        ///< id of a car that may go first there; 0: none
        std::uint32_t let_for = 0;     ///< [ticks] by now; one a gate
        std::uint32_t stuck = 0;       ///< [ticks] in somebody's way
        Eigen::Vector2d was_at{0, 0};  ///< where he was last seen to get on, or to wait
        std::uint64_t was_at_tick = 0;
        std::uint64_t pause_until = 0;  ///< tick until which he stands and looks
        std::uint64_t down_until = 0;   ///< 0: on his feet; else the tick of his removal
        std::uint64_t draws = 0;        ///< of goals so far
        std::uint32_t friend_of = 0;    ///< whom he walks beside; 0: nobody
        bool meets = false;             ///< goes back to him, who is far behind
        Eigen::Vector2d wanted{0, 0};   ///< [m/s] in this tick
        bool flees = false;             ///< in this tick
        bool cornered = false;          ///< there, and gets nowhere by himself
        std::size_t body = 0;           ///< his of neighbours_
        ground::GroundProbe::Around underfoot;
    };

    const WalkMap& map_of(const Person& person);
    const Walker* find(std::uint32_t id) const;
    void keep_from_posts(const Person& person);

    void lay_down(const world::TickView& last, std::uint64_t tick);
    void remove_hit_and_lost(OnFoot& next);
    void watch(Walker& walker, std::uint64_t tick);
    void fill_up(const world::TickView& last, OnFoot& next);
    bool add(const world::TickView& last, OnFoot& next);
    bool add_friend(OnFoot& next);
    void appear(Walker walker, OnFoot& next);
    std::optional<Eigen::Vector3d> drawn_place(double metre_share, double side_share) const;

    void plan(Walker& walker, std::uint64_t tick);
    bool take_way(Walker& walker, const WalkMap::Place& goal);
    static bool is_near_friend(const Walker& walker, const Walker& leader, double distance);
    static void keep_to_side(const WalkMap& map,
                             const WalkMap::Place& start,
                             double side,
                             std::vector<WalkMap::Step>& way);
    static bool is_out_of_patience(const Walker& walker);
    void want(Walker& walker, std::uint64_t tick);
    double speed_at_gate(Walker& walker, double speed);
    bool lets_one_go(Walker& walker, const Gate& gate) const;
    void make_way(Walker& walker);
    void look_at_stopped();
    void step_back(Walker& walker) const;
    static Neighbours::From keeps_from(const Walker& walker);
    void avoid(Walker& walker);
    double flight_pace(const Walker& walker, const Eigen::Vector2d& way);
    void flee();
    bool walks_into_threat(const Walker& walker) const;
    Eigen::Vector2d reached(const Walker& walker, const Eigen::Vector2d& there);
    Eigen::Vector2d way_from(const Walker& other, const Walker& fleeing);
    bool give_room_to(const Walker& fleeing);
    void step(Walker& walker, std::uint64_t tick);
    bool is_allowed(const Walker& walker, const WalkMap::Place& place);
    void write(const Walker& walker, OnFoot& next) const;

    const world::EpisodeT* episode_;
    const world::TownT* town_;
    const world::LaneMap* lanes_;
    WalkingGround* ground_;
    double step_;  ///< [s]
    std::vector<std::uint32_t> sidewalks_;
    std::vector<double> ends_;  ///< [m] running sum of their lengths
    RoadUsers users_;
    RoadTraffic traffic_;
    Threats threats_;
    WalkerLights lights_;
    Steering steering_;
    Neighbours neighbours_;
    std::array<bool, 2> knows_posts_{};  ///< beside the pavement, and beside the streets
    Places people_;                      ///< of this crowd, in this tick
    Places on_road_;                     ///< those of them who are
    std::vector<RoadUser> stopped_;      ///< in junctions, in this tick
    std::vector<Body> around_;           ///< of one, while looking
    std::vector<Walker> walkers_;        ///< by id
    std::uint32_t next_id_ = first_walker_id;
    std::uint64_t tries_ = 0;  ///< of places to appear at
    unsigned plans_ = 0;       ///< made in this tick
};

}  // namespace reprise::walkers
