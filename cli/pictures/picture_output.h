#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/render_options.h"
#include "cli/pictures/cameras.h"
#include "cli/pictures/film_pipe.h"
#include "cli/process/new_folder.h"
#include "render/picture.h"

namespace reprise::cli {

/// Where pictures go.
class PictureOutput {
  public:
    PictureOutput() = default;
    virtual ~PictureOutput() = default;
    PictureOutput(const PictureOutput&) = delete;
    PictureOutput& operator=(const PictureOutput&) = delete;

    /// Whether pictures are taken one at a time, in the order of their ticks; else by several
    /// threads at once.
    virtual bool in_order() const = 0;

    /// Whether it is asked how people are shown what this sensor saw.
    virtual bool shows(std::size_t sensor) const = 0;

    /// What a sensor saw, and how that is shown to people.
    virtual void take(std::size_t sensor,
                      const world::SensorFrame& frame,
                      const world::SensorFrame& shown) = 0;

    /// A text that belongs to what a sensor saw, in a folder of this name beside it.
    virtual void take_text(std::size_t /*sensor*/,
                           const std::string& /*folder*/,
                           std::uint64_t /*tick*/,
                           const std::string& /*text*/) {}

    /// All were taken.
    virtual void finish() {}
};

/// PNG files that are named by their tick, in a folder for each camera: `folder` alone where there
/// is one camera, and it is not of a recorded rig. Folders that stay empty go again.
class PictureFolders : public PictureOutput {
  public:
    PictureFolders(const RenderOptions& options, const Cameras& cameras);

    bool in_order() const override { return false; }

    bool shows(std::size_t sensor) const override { return view_ || for_people_[sensor]; }

    void take(std::size_t sensor,
              const world::SensorFrame& frame,
              const world::SensorFrame& shown) override;

    void take_text(std::size_t sensor,
                   const std::string& folder,
                   std::uint64_t tick,
                   const std::string& text) override;
    void finish() override;

  private:
    void write(const world::SensorFrame& frame, const std::filesystem::path& folder) const;

    const RenderOptions& options_;
    const Cameras& cameras_;
    render::DepthCoding coding_;
    bool view_;
    std::vector<bool> for_people_;  ///< by sensor: rgb
    std::vector<std::filesystem::path> of_sensors_;
    std::list<NewFolder> made_;
};

/// A film of one camera. To be made before there are threads.
class Film : public PictureOutput {
  public:
    /// `rate`: pictures a second.
    Film(const std::filesystem::path& path,
         const std::string& ending,
         const Cameras& cameras,
         double rate);

    bool in_order() const override { return true; }

    bool shows(std::size_t /*sensor*/) const override { return true; }

    void take(std::size_t sensor,
              const world::SensorFrame& frame,
              const world::SensorFrame& shown) override;
    void finish() override;

  private:
    std::optional<FilmPipe> pipe_;
};

}  // namespace reprise::cli
