#include "cli/trace/level_note.h"

#include <fmt/format.h>

#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "replay/level.h"

namespace reprise::cli {

void print_level_note(const replay::TraceReader& trace) {
    if (trace.level() != replay::Level::full)
        say(stderr,
            "reprise: note: {}\n",
            replay::lacks_text(shell_path(trace.path()), trace.level()));
}

}  // namespace reprise::cli
