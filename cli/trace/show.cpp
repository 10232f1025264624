#include "cli/trace/show.h"

#include <filesystem>

#include "cli/options/tick_option.h"
#include "cli/options/tick_range.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/say.h"
#include "exchange/page/replay_page.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::cli {

int show(const ShowOptions& options) {
    const std::string output =
        options.output.empty()
            ? std::filesystem::path(options.trace).replace_extension(".html").string()
            : options.output;
    refuse_overwriting(options.trace, output);
    replay::TraceReader trace(options.trace);
    const TickRange range = parse_ticks("--ticks", options.ticks, trace);
    std::uint64_t every = 0;
    if (!options.every.empty()) {
        every = parse_tick("--every", options.every, trace.episode().step_ns, 1);
        if (every < 1)
            throw world::Error("--every: expected 1 tick at least, got '" + options.every + "'");
    }
    exchange::ReplayPage page = exchange::replay_page(trace, {range.first, range.last, every});
    Output file(output);
    file.text = std::move(page.html);
    const std::size_t size = file.text.size();
    file.finish();
    say(stderr,
        "{}: {}{}, {:.1f} MB; any browser opens it\n",
        output,
        world::count_of(range.last + 1 - range.first, "tick"),
        page.every > 1 ? fmt::format(" (positions of one in {})", page.every) : "",
        static_cast<double>(size) / 1e6);
    return exit_good;
}

}  // namespace reprise::cli
