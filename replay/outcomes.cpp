#include "replay/outcomes.h"

#include <fmt/format.h>

#include "world/printable.h"

namespace reprise::replay {

void ToldOutcome::hear(const world::Tick& tick) {
    external_.hear(tick);
    for (const world::Event* event : *tick.events()) {
        const world::EventKind kind = event->kind();
        failed_ = failed_ || kind == world::EventKind::check_failed ||
                  kind == world::EventKind::not_evaluated;
        passed_ = passed_ || kind == world::EventKind::check_passed;
        if (kind == world::EventKind::finished)
            finished_ = event->text()->str();
    }
}

std::optional<world::Outcome> ToldOutcome::of(const TraceReader& trace) const {
    // A check that had passed when another script took over says so no more.
    const bool unsaid = !trace.episode().branches.empty() && !failed_ && !passed_;
    if (!finished_ || unsaid || trace.first() > 1)
        return std::nullopt;
    return world::Outcome{failed_   ? "failed"
                          : passed_ ? "passed"
                                    : "completed",
                          *finished_,
                          trace.ticks()};
}

std::optional<std::string> ToldOutcome::contradiction(const TraceReader& trace, bool all) const {
    const world::Outcome& says = trace.outcome();
    const bool goes_on =
        says == world::outcome_of_part(trace.ticks()) ||
        says == world::outcome_of_cut_off(trace.ticks()) ||
        (all && trace.first() == 1 ? external_.explain(says) : world::is_early_end(says));
    const auto differs = [&](const std::string& told) {
        return fmt::format("its outcome says '{}', its ticks '{}'", to_text(says), told);
    };
    if (trace.level() == Level::inputs)
        return std::nullopt;
    if (!finished_)
        return goes_on ? std::nullopt : std::optional(differs("the run goes on"));
    const std::optional<world::Outcome> told = of(trace);
    if (all && told && !(*told == says))
        return differs(to_text(*told));
    if (says.reason != *finished_ || (failed_ && says.verdict != "failed"))
        return differs(world::printable(failed_ ? "failed: " + *finished_ : *finished_));
    return std::nullopt;
}

std::optional<world::Outcome> told_outcome(TraceReader& trace) {
    ToldOutcome told;
    if (trace.level() == Level::inputs)
        return std::nullopt;
    for (std::uint64_t index = trace.first(); index <= trace.last(); ++index)
        told.hear(*trace.recorded(index).view.tick);
    return told.of(trace);
}

std::string to_text(const world::Outcome& outcome) {
    return world::printable(outcome.reason.empty() ? outcome.verdict
                                                   : outcome.verdict + ": " + outcome.reason);
}

}  // namespace reprise::replay
