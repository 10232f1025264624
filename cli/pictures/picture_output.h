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

namespace reprise::cli {

/// Where pictures go.
class PictureOutput {
  public:
    PictureOutput() = default;
    virtual ~PictureOutput() = default;
    PictureOutput(const PictureOutput&) = delete;
    PictureOutput& operator=(const PictureOutput&) = delete;

    /// What a sensor saw, and how that is shown to people.
    virtual void take(std::size_t sensor,
                      const world::SensorFrame& frame,
                      const world::SensorFrame& shown) = 0;

    /// All were taken.
    virtual void finish() {}
};

/// PNG files that are named by their tick, in a folder for each camera: `folder` alone where there
/// is one camera, and it is not of a recorded rig. Folders that stay empty go again.
class PictureFolders : public PictureOutput {
  public:
    PictureFolders(const std::filesystem::path& folder, const Cameras& cameras);

    void take(std::size_t sensor,
              const world::SensorFrame& frame,
              const world::SensorFrame& shown) override;

  private:
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

    void take(std::size_t sensor,
              const world::SensorFrame& frame,
              const world::SensorFrame& shown) override;
    void finish() override;

  private:
    std::optional<FilmPipe> pipe_;
};

}  // namespace reprise::cli
