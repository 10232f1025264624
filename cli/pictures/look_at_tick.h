#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cli/pictures/annotation.h"
#include "cli/pictures/cameras.h"
#include "cli/pictures/kept_ticks.h"
#include "cli/pictures/picture_output.h"
#include "render/labels/boxes.h"
#include "render/sensors.h"

namespace reprise::cli {

/// The same cameras in a tick beside; nothing where they are not. `looking`: which of them the
/// first of `rig` are.
std::optional<render::Neighbour> neighbour(const Cameras& cameras,
                                           const std::vector<std::size_t>& looking,
                                           const world::SensorRig& rig,
                                           std::uint32_t actor,
                                           const world::TickView& there);

/// A tick's cameras and what becomes of their pictures. Keeps the tick: the trace is read on while
/// it is looked at.
class LookAtTick : public render::Observation {
  public:
    /// `boxes`: of these parked vehicles and of all actors, where boxes are wished at all.
    LookAtTick(KeptTicks ticks,
               const Annotation& annotation,
               PictureOutput& output,
               const std::vector<render::ParkedVehicle>* boxes)
        : ticks_(std::move(ticks)),
          annotation_(annotation),
          output_(output),
          boxes_(boxes) {}

    world::TickView tick() const override { return ticks_.tick.view(); }

    render::Neighbours neighbours() const override { return neighbours_; }

    const world::SensorRig& rig() const override { return rig_; }

    const world::Weather& weather() const override { return weather_; }

    /// `looking`: by their index in Cameras::sensors(). `last`: nothing comes after it, and the run
    /// ends so.
    void point(const Cameras& cameras,
               const std::vector<std::size_t>& looking,
               std::uint32_t actor,
               const world::Weather& weather,
               bool last);

    void seen(std::vector<world::SensorFrame> frames) override;
    void done() override;

  private:
    void look_also(world::SensorKind kind);
    world::SensorFrame shown(std::size_t i) const;

    KeptTicks ticks_;
    const Annotation& annotation_;
    PictureOutput& output_;
    const std::vector<render::ParkedVehicle>* boxes_;
    std::size_t first_of_boxes_ = 0;  ///< of rig_: the instances, behind them the classes
    render::Neighbours neighbours_;
    std::vector<std::size_t> looking_;
    std::uint32_t actor_ = 0;
    bool last_ = false;
    world::Weather weather_;
    world::SensorRig rig_;
    Annotation::Words words_;
    std::vector<world::SensorFrame> frames_;
    std::vector<world::SensorFrame> shown_;
};

}  // namespace reprise::cli
