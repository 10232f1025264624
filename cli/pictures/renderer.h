#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/pictures/annotation.h"
#include "cli/pictures/chosen_weather.h"
#include "cli/pictures/look_at_tick.h"

namespace reprise::cli {

/// Goes through the ticks, and says who looks at each.
class Renderer {
  public:
    /// Under each weather of `weathers` in turn; none: as options say.
    Renderer(const RenderOptions& options,
             replay::TraceReader& trace,
             const Cameras& cameras,
             PictureOutput& output,
             const std::vector<std::string>& weathers);

    /// Many looks at once. Throws world::Error.
    void look_at_all(render::Sensors& sensors, const Ticks& ticks, const std::string& doing);

    std::size_t pictures() const { return pictures_; }

  private:
    std::unique_ptr<LookAtTick> look(std::uint64_t index, const ChosenWeather& weather, bool last);
    [[noreturn]] void refuse_gap(const Ticks& ticks) const;

    replay::TraceReader& trace_;
    const Cameras& cameras_;
    PictureOutput& output_;
    Annotation annotation_;
    std::optional<std::vector<render::ParkedVehicle>> parked_;  ///< where boxes are wished
    std::vector<ChosenWeather> weathers_;
    std::size_t pictures_ = 0;
    bool due_ = false;  ///< has a camera looked, or would have?
    bool carried_ = false;
};

}  // namespace reprise::cli
