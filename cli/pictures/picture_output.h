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
#include "cli/pictures/written_files.h"
#include "cli/process/new_folder.h"
#include "render/picture.h"
#include "world/digest.h"

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

    /// Whether it is asked what this sensor saw in that tick.
    virtual bool wants(std::size_t /*sensor*/, std::uint64_t /*tick*/) const { return true; }

    /// What a sensor saw, and how that is shown to people.
    virtual void take(std::size_t sensor,
                      const world::SensorFrame& frame,
                      const world::SensorFrame& shown) = 0;

    /// The boxes of all that a sensor saw, as box_text says them, after that picture. `instances`:
    /// what they were made of.
    virtual void take_boxes(std::size_t /*sensor*/,
                            std::uint64_t /*tick*/,
                            const std::string& /*text*/,
                            const world::SensorFrame& /*instances*/) {}

    /// All were taken.
    virtual void finish() {}
};

/// PNG files that are named by their tick, in a folder for each camera: `folder` alone where there
/// is one camera, and it is not of a recorded rig. Folders that stay empty go again.
class PictureFolders : public PictureOutput {
  public:
    PictureFolders(const RenderOptions& options, const Cameras& cameras, WrittenFiles& files);

    bool in_order() const override { return false; }

    bool shows(std::size_t sensor) const override { return view_ || for_people_[sensor]; }

    void take(std::size_t sensor,
              const world::SensorFrame& frame,
              const world::SensorFrame& shown) override;

    void take_boxes(std::size_t sensor,
                    std::uint64_t tick,
                    const std::string& text,
                    const world::SensorFrame& instances) override;
    void finish() override;

  private:
    void write(const world::SensorFrame& frame, const std::filesystem::path& folder) const;
    std::filesystem::path noted(std::filesystem::path path) const;

    const RenderOptions& options_;
    const Cameras& cameras_;
    WrittenFiles& files_;
    render::DepthCoding coding_;
    bool view_;
    std::vector<bool> for_people_;  ///< by sensor: rgb
    std::vector<std::filesystem::path> of_sensors_;
    std::list<NewFolder> made_;
};

/// A film of one camera. To be made before there are threads.
class Film : public PictureOutput {
  public:
    /// `rate`: pictures a second. `strips`: so many pictures one after the other are one of the
    /// film, side by side: of each the part that is in its place.
    Film(const std::filesystem::path& path,
         const std::string& ending,
         const Cameras& cameras,
         double rate,
         std::size_t strips,
         WrittenFiles& files);

    bool in_order() const override { return true; }

    bool shows(std::size_t /*sensor*/) const override { return true; }

    void take(std::size_t sensor,
              const world::SensorFrame& frame,
              const world::SensorFrame& shown) override;
    void finish() override;

  private:
    void add(const std::vector<std::uint8_t>& rgb);

    std::filesystem::path path_;
    WrittenFiles& files_;
    std::optional<FilmPipe> pipe_;
    world::Hasher pictures_;
    std::size_t strips_;
    std::size_t taken_ = 0;               ///< of the picture in the making
    std::vector<std::uint8_t> composed_;  ///< that picture
};

}  // namespace reprise::cli
