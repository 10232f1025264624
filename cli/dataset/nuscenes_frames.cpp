#include "cli/dataset/nuscenes_frames.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/dataset/labels.h"
#include "cli/dataset/nuscenes_names.h"
#include "cli/dataset/nuscenes_points.h"
#include "files/json_text.h"
#include "render/labels/boxes.h"
#include "world/check.h"
#include "world/models/actors.h"
#include "world/spawns.h"

namespace reprise::cli {

namespace {

using Json = nlohmann::ordered_json;

/// Who is parked is said when they are spawned, and never again.
class Parked {
  public:
    explicit Parked(replay::TraceReader& trace) : trace_(trace), next_(trace.first()) {
        if (const auto slice = trace.slice())
            for (const auto& [actor, spawn] : slice->spawns)
                hear(spawn.command.driver, actor);
    }

    void hear_to(std::uint64_t tick) {
        for (; next_ <= tick; ++next_)
            for (const world::Command* command : *trace_.recorded(next_).view.tick->commands())
                if (command->kind() == world::CommandKind::spawn)
                    hear(command->driver(), command->actor());
    }

    bool contains(std::uint32_t actor) const { return actors_.contains(actor); }

  private:
    void hear(world::Driver driver, std::uint32_t actor) {
        if (driver == world::Driver::parked)
            actors_.insert(actor);
    }

    replay::TraceReader& trace_;
    std::uint64_t next_;
    std::set<std::uint32_t> actors_;
};

/// Of one actor in all cameras: pixels that show it, and that would if nothing hid it.
struct Pixels {
    double seen = 0;
    double whole = 0;
};

void count_pixels(const std::filesystem::path& path, std::map<Who, Pixels>& counts) {
    const Json json = Json::parse(files::json_text(path), nullptr, false);
    try {
        for (const Json& box : json.at("boxes")) {
            Pixels& pixels = counts[who(box)];
            const auto seen = box.at("pixels").get<double>();
            pixels.seen += seen;
            pixels.whole += seen / std::max(1e-6, shown_share(box.dump()));
        }
    } catch (const Json::exception&) {
        throw world::Error(path.string() + ": was changed; remove it");
    }
}

/// Whom cameras see, or beams meet, and which share of them cameras see.
std::map<Who, double> seen_in(const DatasetLayout& layout, std::size_t id) {
    std::map<Who, Pixels> counts;
    for (std::size_t i = 0; i < layout.cameras().size(); ++i)
        if (layout.is_rgb(i))
            count_pixels(layout.boxes(i, id), counts);
    std::map<Who, double> shares;
    for (const auto& [actor, pixels] : counts)
        shares[actor] = std::min(1.0, pixels.seen / std::max(1.0, pixels.whole));
    if (layout.velodyne())
        for (const auto& [actor, beams] : read_beams(layout.beams(id)))
            shares.emplace(actor, 0);
    return shares;
}

/// What stands in a town, in order of its number.
NuscenesObject parked_object(const std::vector<render::ParkedVehicle>& town,
                             Who who,
                             double share) {
    const auto found = std::lower_bound(
        town.begin(), town.end(), who - first_thing, [](const auto& vehicle, std::uint32_t thing) {
            return vehicle.thing < thing;
        });
    if (found == town.end() || found->thing != who - first_thing)
        throw world::Error(fmt::format(
            "labels/: no vehicle stands in the town as thing {}: was changed; remove the folder",
            who - first_thing));
    const world::VehicleModel& model = world::vehicle_models()[found->model];
    return {who,
            nuscenes_category(model),
            nuscenes_attribute(model),
            share,
            found->box.pose_world,
            found->box.size};
}

}  // namespace

std::vector<NuscenesFrame> nuscenes_frames(const DatasetLayout& layout,
                                           const std::list<DatasetSource>& sources,
                                           const std::vector<DatasetFrame>& frames) {
    std::vector<NuscenesFrame> all;
    auto source = sources.begin();
    std::size_t number = 0;
    std::optional<Parked> parked;
    std::vector<render::ParkedVehicle> town;
    std::map<std::uint64_t, Moment> sweeps;
    for (std::size_t id = 0; id < frames.size(); ++id) {
        const DatasetFrame& frame = frames[id];
        if (frame.trace != number) {
            std::advance(source, static_cast<std::ptrdiff_t>(frame.trace - number));
            number = frame.trace;
            parked.reset();
        }
        if (!parked) {
            parked.emplace(source->trace());
            town = render::parked_vehicles(source->trace().recording().town);
            sweeps = source->sweeps(number, frames);
        }
        std::vector<NuscenesSweep> before;
        for (const auto& [at, moment] : sweeps)
            if (moment.id == id) {
                const world::TickView view = source->trace().tick(at).view;
                before.push_back({moment.before, *world::find_pose(view, source->ego(view))});
            }
        parked->hear_to(frame.tick);
        const world::TickView tick = source->trace().tick(frame.tick).view;
        const std::uint32_t ego = source->ego(tick);
        NuscenesFrame& made = all.emplace_back();
        made.trace = frame.trace;
        made.tick = frame.tick;
        made.split = frame.split;
        made.sweeps = std::move(before);
        made.pose_world_ego = *world::find_pose(tick, ego);
        for (const auto& [actor, share] : seen_in(layout, id)) {
            if (actor >= first_thing) {
                made.objects.push_back(parked_object(town, actor, share));
                continue;
            }
            const auto category = nuscenes_category(tick, actor);
            const auto box = render::actor_box(tick, actor);
            if (actor == ego || !category || !box)
                continue;
            made.objects.push_back({actor,
                                    *category,
                                    nuscenes_attribute(tick, actor, parked->contains(actor)),
                                    share,
                                    box->pose_world,
                                    box->size});
        }
    }
    return all;
}

}  // namespace reprise::cli
