#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/look/sky.h"
#include "render/neighbours.h"
#include "render/optics/photograph.h"
#include "render/ranging/probe.h"
#include "render/scene/scene.h"
#include "render/shade/frame.h"

namespace reprise::render {

/// Looks at one tick after another. What is kept between calls: the sky of the last weather, and
/// memory for pictures.
class Observer {
  public:
    explicit Observer(const TownScene& town) : scene_(town), last_(town), next_(town) {}

    std::vector<world::SensorFrame> observe(const world::TickView& tick,
                                            const world::SensorRig& rig,
                                            const world::Weather& weather,
                                            const Neighbours& neighbours);

    std::vector<ProbeEcho> probe(const world::TickView& tick,
                                 std::span<const Probe> probes,
                                 double range,
                                 std::uint32_t carrier);

  private:
    /// Of cameras.
    std::vector<world::SensorFrame> look(const world::TickView& tick,
                                         const world::SensorRig& rig,
                                         const world::Weather& weather,
                                         const Neighbours& neighbours);

    /// What cameras of one place and lens have in common.
    struct Look {
        const world::TickView& tick;
        const world::SensorRig& rig;
        const Neighbours& neighbours;
        const std::vector<std::uint32_t>& mounts;
        std::vector<std::size_t> cameras;  ///< by their number in the rig
        Stage stage;
        Sight sight;
        std::vector<Band> bands;
        std::vector<Hit>& hits;
    };

    void label(Look& look, std::vector<world::SensorFrame>& frames);
    std::vector<std::uint8_t> photograph(Look& look, std::size_t number, Sky& sky);
    void watch(Look& look, std::size_t number, Sky& sky, world::SensorFrame& frame);
    Sight sight_of(const world::SensorSpec& spec,
                   std::size_t number,
                   const Camera& camera,
                   std::uint32_t mask,
                   const Neighbours& neighbours);

    /// Of what measures by rays. Places the scene as it needs it.
    world::SensorFrame measure(const world::TickView& tick,
                               const world::SensorSpec& spec,
                               const world::Weather& weather);
    void arrange_neighbours(const world::SensorRig& rig, const Neighbours& neighbours);
    std::vector<std::uint8_t> flow(const world::SensorSpec& spec,
                                   std::size_t number,
                                   const Camera& camera,
                                   const std::vector<Hit>& hits,
                                   const Neighbours& neighbours) const;

    /// Kept for who asks for several weathers in turns.
    Sky& sky_of(const world::Weather& weather);

    Scene scene_;
    Scene last_;  ///< where everybody was and will be, for who asks how things move
    Scene next_;
    std::vector<std::unique_ptr<Sky>> skies_;  ///< the last one first
    Frame frame_;
    Frame work_;
    std::vector<Hit> hits_;  ///< kept for their memory, as frames are
};

}  // namespace reprise::render
