#include "exchange/carla/carla_import.h"

#include <cmath>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "exchange/carla/carla_survey.h"
#include "exchange/carla/carla_town.h"
#include "exchange/geo_origin.h"
#include "replay/chain_seed.h"
#include "replay/trace_writer.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/models/catalogue.h"
#include "world/weather/weather.h"

namespace reprise::exchange {

namespace {

std::string date_text(std::int64_t date) {
    constexpr std::int64_t year_2100 = 4'102'444'800;
    if (date < 0 || date >= year_2100)
        return "an unknown date";
    return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(static_cast<std::time_t>(date)));
}

std::string source_text(const CarlaLog& log, const std::string& name) {
    return fmt::format("CARLA recorder file {} ({}), map {}, {}",
                       name,
                       log.variant() == CarlaVariant::ue5 ? "UE5" : "UE4",
                       log.map(),
                       date_text(log.date()));
}

std::uint64_t ticks_of(const CarlaSurvey& survey, const std::string& name, std::uint64_t step_ns) {
    const double length = survey.last - survey.first;
    // A recording of whole steps must not lose its last one to the clock's rounding.
    const auto ticks =
        static_cast<std::uint64_t>(length * 1e9 / static_cast<double>(step_ns) + 1e-6);
    if (survey.roles.empty() || !(survey.low.x() <= survey.high.x()))
        throw world::Error(name + ": holds no place of any vehicle or walker");
    if (ticks == 0)
        throw world::Error(fmt::format("{}: its {} whole frames last {:.3f} s, less than one tick",
                                       name,
                                       survey.frames,
                                       length));
    return ticks;
}

world::Recording make_recording(const CarlaImportOptions& options,
                                const CarlaSurvey& survey,
                                const std::string& source,
                                std::uint64_t ticks) {
    world::Recording recording;
    world::EpisodeT& episode = recording.episode;
    episode.name = std::filesystem::path(options.name).stem().string();
    episode.scenario_path = options.name;
    episode.step_ns = options.timing.step_ns;
    episode.max_ticks = ticks;
    episode.road_friction = 1;
    episode.weather_name = "clear_noon";
    episode.weather = world::find_weather(episode.weather_name)->weather;
    episode.fingerprint = options.fingerprint;
    episode.imported_from = source;
    if (survey.hero) {
        world::ParameterT hero;
        hero.key = "hero";
        hero.value = std::to_string(*survey.hero);
        episode.parameters.push_back(std::move(hero));
    }
    if (options.town) {
        recording.town = options.town->town;
        recording.network = options.town->network;
        episode.town_path = options.town->path;
    } else {
        recording.town = plain_town(survey);
    }
    episode.town = recording.town.name;
    episode.town_digest = world::digest128(recording.network);
    return recording;
}

void describe_roles(const CarlaSurvey& survey, CarlaReport& report) {
    std::set<std::string> guessed;
    for (const auto& [id, role] : survey.roles) {
        const bool is_walker = role.actor.kind == CarlaKind::walker;
        ++(is_walker ? report.walkers : report.vehicles);
        if (!role.guessed_by.empty())
            guessed.insert(fmt::format("{}: {}, {}",
                                       role.actor.blueprint,
                                       is_walker ? world::walker_models()[role.model].name
                                                 : world::vehicle_models()[role.model].name,
                                       role.guessed_by));
    }
    report.guessed.assign(guessed.begin(), guessed.end());
}

}  // namespace

CarlaReport import_carla(CarlaBytes bytes,
                         const CarlaImportOptions& options,
                         const std::filesystem::path& trace) {
    const std::string name = bytes.name;
    const std::uint64_t size = bytes.size;
    CarlaLog log(std::move(bytes));
    const CarlaSurvey survey = exchange::survey(log, options.progress);
    CarlaReport report;
    report.damage = log.damage();
    report.skipped = log.skipped();
    report.lost = size - log.offset();
    report.frames = survey.frames;
    if (survey.frames == 0)
        throw world::Error(report.damage ? fmt::format("{}: byte {}: {}; there is no whole frame",
                                                       name,
                                                       report.damage->offset,
                                                       report.damage->what)
                                         : name + ": holds no frames");
    report.ticks = ticks_of(survey, name, options.timing.step_ns);
    report.source = source_text(log, options.name);
    const world::Recording recording = make_recording(options, survey, report.source, report.ticks);
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    offset.head<2>() = net_offset(recording.network);
    std::vector<std::uint32_t> lights = match_signals(recording.town, survey, offset);
    report.lights = survey.lights.size();
    report.signals = lights.size();
    for (const std::uint32_t light : lights)
        report.matched += light != 0 ? 1 : 0;
    report.low = survey.low.z();
    report.high = survey.high.z();
    describe_roles(survey, report);

    replay::TraceWriter writer(trace, recording, replay::Level::full, replay::Unfinished::remove);
    CarlaTicks ticks(log, survey, recording.town, std::move(lights), offset, options.timing);
    world::Digest128 chain = replay::chain_seed(recording);
    for (std::uint64_t i = 0; i < report.ticks; ++i) {
        world::TickDraft draft = ticks.next();
        writer.append(world::seal(draft, chain));
        chain = draft.tick.digests.chain();
        options.progress(size + log.offset());
    }
    report.jumps = ticks.jumps();
    world::Outcome outcome;
    outcome.verdict = report.damage ? "error" : "completed";
    outcome.reason = report.damage ? "the log ends early" : "the log ended";
    outcome.ticks = report.ticks;
    writer.close(outcome);
    return report;
}

}  // namespace reprise::exchange
