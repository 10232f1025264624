// A golden's file, written. Each line is one fact: its kind, then words; texts in quotes.
#include <fmt/format.h>

#include "replay/golden/golden.h"
#include "replay/golden/golden_format.h"
#include "world/digest.h"

namespace reprise::replay {

namespace {

constexpr std::string_view plain =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+:,./#-";

}  // namespace

std::string in_quotes(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            out += std::string("\\") + c;
        else if (byte < 0x20 || byte == 0x7f)
            out += fmt::format("\\x{:02x}", byte);
        else
            out += c;
    }
    return out + "\"";
}

namespace {

/// In quotes only when it needs them.
std::string word(std::string_view text) {
    const bool is_plain = !text.empty() && text.find_first_not_of(plain) == std::string_view::npos;
    return is_plain ? std::string(text) : in_quotes(text);
}

std::string header_text(const Golden& golden) {
    std::string text = std::string(golden_first_line) + "\n";
    text +=
        "# `reprise test` compares a run with this; `reprise accept` writes it. Not for editing.\n";
    text += "because " + in_quotes(golden.because) + "\n";
    text += fmt::format("scenario {} {}\n", word(golden.scenario), golden.scenario_digest);
    const GivenSetup& given = golden.given;
    for (const auto& [key, value] : {std::pair<const char*, const std::string&>{"town", given.town},
                                     {"seed", given.seed},
                                     {"for", given.seconds}})
        if (!value.empty())
            text += fmt::format("given {} {}\n", key, word(value));
    for (const auto& [key, value] : given.parameters)
        text += fmt::format("given set {} {}\n", word(key), word(value));
    for (const world::ParameterT& line : golden.build)
        text += fmt::format("build {} {}\n", word(line.key), in_quotes(line.value));
    for (const auto& [key, value] : golden.starts)
        text += fmt::format("start {} {}\n", word(key), in_quotes(value));
    text += "chain " + word(golden.chain) + "\n";
    text += fmt::format("step_ns {}\n", golden.step_ns);
    text += fmt::format(
        "every checkpoint {} state {}\n", golden.sampling.checkpoints, golden.sampling.states);
    return text;
}

std::string event_text(const GoldenEvent& event, const std::string& time) {
    std::string text = fmt::format("event {} {}", time, word(event.kind));
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty())
            text += fmt::format(" {} {}", key, value);
    };
    add("actor", event.actor.empty() ? "" : word(event.actor));
    add("other", event.other.empty() ? "" : word(event.other));
    add("value", event.value);
    add("at", event.place);
    add("line", event.line == 0 ? "" : std::to_string(event.line));
    add("text", event.text.empty() ? "" : in_quotes(event.text));
    return text + "\n";
}

std::string story_text(const Golden& golden) {
    const auto time = [&](std::uint64_t tick) { return golden_seconds(tick, golden.step_ns); };
    std::string text = "\n# How it ended.\n";
    text += fmt::format("verdict {} after {} {}\n",
                        word(golden.verdict),
                        time(golden.ticks),
                        in_quotes(golden.reason));
    for (const GoldenCheck& check : golden.checks)
        text += fmt::format("check {} {} line {} {} {}\n",
                            word(check.status),
                            check.tick == 0 ? "-" : time(check.tick),
                            check.line,
                            in_quotes(check.name),
                            in_quotes(check.detail));
    text += "\n# What happened, and when [s].\n";
    for (const GoldenEvent& event : golden.events)
        text += event_text(event, time(event.tick));
    return text;
}

std::string checkpoints_text(const Golden& golden) {
    const auto time = [&](std::uint64_t tick) { return golden_seconds(tick, golden.step_ns); };
    std::string text =
        "\n# checkpoint TIME HISTORY, then a digest of each stage since the last one: scenario,\n"
        "# controls, traffic, pedestrians, physics, measurements.\n";
    for (const Checkpoint& checkpoint : golden.checkpoints) {
        text += fmt::format("checkpoint {} {}", time(checkpoint.tick), word(checkpoint.history));
        for (const std::string& stage : checkpoint.stages)
            text += " " + word(stage);
        text += "\n";
    }
    if (!golden.background.empty())
        text += "\n# The demand: how many, and a digest of where they are.\n";
    for (const BackgroundState& state : golden.background)
        text += fmt::format("background {} cars {} walkers {} {}\n",
                            time(state.tick),
                            state.cars,
                            state.walkers,
                            word(state.digest));
    if (!golden.states.empty())
        text += "\n# Who is where; metres, metres a second, radians; every digit counts.\n";
    for (const ActorState& state : golden.states) {
        text += fmt::format("state {} {}", time(state.tick), word(state.actor));
        for (const auto& [name, value] : state.values)
            text += fmt::format(" {} {}", word(name), word(value));
        text += "\n";
    }
    return text;
}

}  // namespace

std::string golden_seal(std::string_view text) {
    world::Hasher hasher;
    hasher.add_text(text);
    return fmt::format("{:016x}", hasher.digest64());
}

std::string to_text(const Golden& golden) {
    std::string text = header_text(golden) + story_text(golden) + checkpoints_text(golden);
    return text + "\nseal " + golden_seal(text) + "\n";
}

}  // namespace reprise::replay
