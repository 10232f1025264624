// Writes a sound trace whose texts are all hostile: hostile_trace OUT
#include "replay/chain_seed.h"
#include "replay/trace_writer.h"
#include "tests/replay/synthetic_run.h"
#include "world/digest.h"

using namespace reprise;

namespace {

/// Clears the screen, sets a title by a C1 control, turns the direction of writing, is no UTF-8,
/// and begins a line of its own.
std::string hostile(const std::string& text) {
    return text + "\x1b[2J\xc2\x9b\x31m\xe2\x80\xae\xe2\x81\xa6\xff\x07\rX\nreprise: verified";
}

}  // namespace

int main(int, char** argv) {
    world::Recording recording = test::recording();
    world::EpisodeT& episode = recording.episode;
    for (std::string* text : {&episode.name,
                              &episode.scenario_path,
                              &episode.town,
                              &episode.town_path,
                              &episode.weather_name})
        *text = hostile(*text);
    recording.town.name = hostile(recording.town.name);
    for (const char* key : {"one", "two"}) {
        world::ParameterT parameter;
        parameter.key = hostile(key);
        parameter.value = hostile("value");
        episode.parameters.push_back(parameter);
        episode.fingerprint.push_back(parameter);
    }
    replay::TraceWriter writer(argv[1], recording);
    world::Digest128 chain = replay::chain_seed(recording);
    std::vector<world::TickDraft> drafts;
    test::drive({.ticks = 70, .cars = 3, .change = [&](world::TickDraft& draft) {
                     for (world::EventT& event : draft.tick.events)
                         event.text = hostile(event.text);
                     drafts.push_back(draft);
                 }});
    for (world::TickDraft& draft : drafts) {
        const world::SealedTick tick = world::seal(draft, chain);
        chain = tick.view().tick->digests()->chain();
        writer.append(tick);
    }
    writer.close({hostile("failed"), hostile("reason"), drafts.size()});
    return 0;
}
