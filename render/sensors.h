#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "render/neighbours.h"
#include "render/ranging/probe.h"
#include "world/external/sensor.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::render {

/// One of many, see Sensors::observe_each.
class Observation {
  public:
    Observation() = default;
    virtual ~Observation() = default;
    Observation(const Observation&) = delete;
    Observation& operator=(const Observation&) = delete;

    virtual world::TickView tick() const = 0;
    virtual const world::SensorRig& rig() const = 0;
    virtual const world::Weather& weather() const = 0;

    virtual Neighbours neighbours() const { return {}; }

    /// What was seen, from any thread, while others look.
    virtual void seen(std::vector<world::SensorFrame> frames) = 0;

    /// All this: one look at a time, in the order in which they were asked for.
    virtual void done() {}
};

/// What the cameras see at a tick, under any weather. Reads a tick and a Town, nothing else: live
/// and replayed frames come out of the same code. Embree traces the rays, or PortableTracer. Frames
/// do not depend on the number of threads, those of other kinds than rgb not on the weather either.
/// 800x600 RGB: about 0.2 s on two cores.
class Sensors {
  public:
    struct Options {
        /// How many work on pictures; 0: one a core. While this object lives TBB gives the whole
        /// process no more.
        int threads = 0;

        /// The same bytes on every x86-64 CPU, when the program is linked with the maths of
        /// cmake/PortableMath.cmake. Depth and semantic take twice as long, RGB 10 to 20 % longer.
        bool portable = false;
    };

    explicit Sensors(const world::TownT& town) : Sensors(town, Options()) {}

    Sensors(const world::TownT& town, const Options& options);
    ~Sensors();
    Sensors(const Sensors&) = delete;
    Sensors& operator=(const Sensors&) = delete;

    /// One frame for each sensor of the rig, in its order: cameras, and what measures by rays (see
    /// world::is_ranging). Cameras of one place share their primary rays. Throws world::Error when
    /// a sensor sits on an actor that is not in the tick.
    std::vector<world::SensorFrame> observe(const world::TickView& tick,
                                            const world::SensorRig& rig,
                                            const world::Weather& weather,
                                            const Neighbours& neighbours = {});

    /// What is there along straight lines at a tick, for sensors of one's own: one answer a probe,
    /// of what is nearer than `range` [m]. `carrier` is not seen; 0: nobody is hidden. 100,000
    /// probes: 20 ms of a core, where neighbours run alike. See examples/own_sensor.cpp.
    std::vector<ProbeEcho> probe(const world::TickView& tick,
                                 std::span<const Probe> probes,
                                 double range,
                                 std::uint32_t carrier = 0);

    /// Many looks, several at a time, so that cores share no picture and do not wait for each
    /// other: frames are those that observe() makes. `next` is called by one thread at a time, and
    /// says with nothing that this was all. A look in the making takes 190 bytes a pixel,
    /// by night 213.
    void observe_each(const std::function<std::unique_ptr<Observation>()>& next);

  private:
    struct Studio;
    std::unique_ptr<Studio> studio_;
};

}  // namespace reprise::render
