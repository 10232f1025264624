// A golden's file, read. What is read is written again and must be the same bytes, so that no
// character of a golden is without a meaning.
#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "replay/golden/golden.h"
#include "replay/golden/golden_format.h"
#include "world/check.h"

namespace reprise::replay {

namespace {

/// The words of one line; every mistake names file and line.
class Words {
  public:
    Words(const std::string& line, const std::string& path, std::size_t number)
        : line_(line),
          path_(path),
          number_(number) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw world::Error(fmt::format("{}:{}: {}", path_, number_, what));
    }

    bool at_end() const { return at_ >= line_.size(); }

    std::string take() {
        if (at_end())
            fail("the line is cut off");
        std::string text;
        if (line_[at_] == '"') {
            text = take_quoted();
        } else {
            const std::size_t end = std::min(line_.find(' ', at_), line_.size());
            text = line_.substr(at_, end - at_);
            at_ = end;
        }
        if (!at_end() && line_[at_++] != ' ')
            fail("a space is missing behind a text");
        return text;
    }

    std::uint64_t number() {
        const std::string text = take();
        std::uint64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc() || stop != end)
            fail("expected a whole number, found '" + text + "'");
        return value;
    }

    /// Takes the next word if it is this one.
    bool take_if(std::string_view expected) {
        const std::size_t before = at_;
        if (!at_end() && take() == expected)
            return true;
        at_ = before;
        return false;
    }

    /// A time in seconds, as the tick that it stands for.
    std::uint64_t tick(std::uint64_t step_ns) {
        const std::string text = take();
        double seconds = 0;
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, seconds);
        if (error != std::errc() || stop != end || !(seconds >= 0) || seconds > 1e9)
            fail("expected a time in seconds, found '" + text + "'");
        if (step_ns == 0)
            fail("the line with the step must come first");
        const auto ns = static_cast<std::uint64_t>(seconds * 1e9 + 0.5);
        return (ns + step_ns / 2) / step_ns;
    }

  private:
    std::string take_quoted() {
        std::string text;
        for (++at_; at_ < line_.size() && line_[at_] != '"'; ++at_) {
            if (line_[at_] != '\\') {
                text += line_[at_];
                continue;
            }
            ++at_;
            if (at_ < line_.size() && line_[at_] == 'x') {
                unsigned byte = 0;
                std::from_chars(line_.data() + at_ + 1,
                                line_.data() + std::min(at_ + 3, line_.size()),
                                byte,
                                16);
                text += static_cast<char>(byte);
                at_ += 2;
            } else if (at_ < line_.size()) {
                text += line_[at_];
            }
        }
        if (at_ >= line_.size())
            fail("a text without its closing quote");
        ++at_;
        return text;
    }

    const std::string& line_;
    const std::string& path_;
    std::size_t number_;
    std::size_t at_ = 0;
};

void parse_given(Words& words, GivenSetup& given) {
    const std::string key = words.take();
    if (key == "town")
        given.town = words.take();
    else if (key == "seed")
        given.seed = words.take();
    else if (key == "for")
        given.seconds = words.take();
    else if (key == "set") {
        const std::string name = words.take();
        given.parameters.emplace_back(name, words.take());
    } else
        words.fail("expected town, seed, for or set, found '" + key + "'");
}

/// Header lines. False: it is none.
bool parse_header(const std::string& kind, Words& words, Golden& golden) {
    if (kind == "because") {
        golden.because = words.take();
    } else if (kind == "scenario") {
        golden.scenario = words.take();
        golden.scenario_digest = words.take();
    } else if (kind == "given") {
        parse_given(words, golden.given);
    } else if (kind == "build") {
        world::ParameterT line;
        line.key = words.take();
        line.value = words.take();
        golden.build.push_back(std::move(line));
    } else if (kind == "start") {
        const std::string key = words.take();
        golden.starts.emplace_back(key, words.take());
    } else if (kind == "chain") {
        golden.chain = words.take();
    } else if (kind == "step_ns") {
        golden.step_ns = words.number();
    } else if (kind == "every") {
        if (!words.take_if("checkpoint"))
            words.fail("expected checkpoint");
        golden.sampling.checkpoints = words.number();
        if (!words.take_if("state"))
            words.fail("expected state");
        golden.sampling.states = words.number();
        if (golden.sampling.checkpoints == 0 || golden.sampling.states == 0)
            words.fail("every 0 seconds is not possible");
    } else {
        return false;
    }
    return true;
}

GoldenEvent parse_event(Words& words, std::uint64_t step_ns) {
    GoldenEvent event;
    event.tick = words.tick(step_ns);
    event.kind = words.take();
    while (!words.at_end()) {
        const std::string key = words.take();
        if (key == "actor")
            event.actor = words.take();
        else if (key == "other")
            event.other = words.take();
        else if (key == "value")
            event.value = words.take();
        else if (key == "line")
            event.line = static_cast<std::uint32_t>(words.number());
        else if (key == "text")
            event.text = words.take();
        else if (key == "at")
            for (int i = 0; i < 3; ++i)
                event.place += (i == 0 ? "" : " ") + words.take();
        else
            words.fail("an event has no '" + key + "'");
    }
    return event;
}

GoldenCheck parse_check(Words& words, std::uint64_t step_ns) {
    GoldenCheck check;
    check.status = words.take();
    if (!words.take_if("-"))
        check.tick = words.tick(step_ns);
    if (!words.take_if("line"))
        words.fail("expected line");
    check.line = static_cast<std::uint32_t>(words.number());
    check.name = words.take();
    check.detail = words.take();
    return check;
}

/// What the run did. False: it is no such line.
bool parse_body(const std::string& kind, Words& words, Golden& golden) {
    if (kind == "verdict") {
        golden.verdict = words.take();
        if (!words.take_if("after"))
            words.fail("expected after");
        golden.ticks = words.tick(golden.step_ns);
        golden.reason = words.take();
    } else if (kind == "check") {
        golden.checks.push_back(parse_check(words, golden.step_ns));
    } else if (kind == "event") {
        golden.events.push_back(parse_event(words, golden.step_ns));
    } else if (kind == "checkpoint") {
        Checkpoint checkpoint;
        checkpoint.tick = words.tick(golden.step_ns);
        checkpoint.history = words.take();
        for (std::size_t i = 0; i < golden_stages().size(); ++i)
            checkpoint.stages.push_back(words.take());
        golden.checkpoints.push_back(std::move(checkpoint));
    } else if (kind == "background") {
        BackgroundState state;
        state.tick = words.tick(golden.step_ns);
        if (!words.take_if("cars"))
            words.fail("expected cars");
        state.cars = words.number();
        if (!words.take_if("walkers"))
            words.fail("expected walkers");
        state.walkers = words.number();
        state.digest = words.take();
        golden.background.push_back(std::move(state));
    } else if (kind == "state") {
        ActorState state;
        state.tick = words.tick(golden.step_ns);
        state.actor = words.take();
        while (!words.at_end()) {
            const std::string name = words.take();
            state.values.emplace_back(name, words.take());
        }
        golden.states.push_back(std::move(state));
    } else {
        return false;
    }
    return true;
}

void parse_line(const std::string& line, Golden& golden, Words& words) {
    if (line.empty() || line.front() == '#')
        return;
    const std::string kind = words.take();
    if (!parse_header(kind, words, golden) && !parse_body(kind, words, golden))
        words.fail("no line of a golden begins with '" + kind + "'");
    if (!words.at_end())
        words.fail("there is more on this line than belongs there");
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

void check_first_line(const std::vector<std::string>& lines, const std::string& path) {
    const std::string found = lines.empty() ? "" : lines.front();
    if (found == golden_first_line)
        return;
    if (found.starts_with("reprise golden ") && found.find('\r') == std::string::npos)
        throw world::Error(fmt::format("{}:1: a golden of format '{}'; this program reads '{}'",
                                       path,
                                       found.substr(15),
                                       golden_first_line.substr(15)));
    throw world::Error(
        fmt::format("{}:1: not a golden: it does not begin with '{}' and a plain "
                    "line end",
                    path,
                    golden_first_line));
}

/// What is read must be what would be written: no line moved, doubled, or spelt in another way.
void check_spelling(const std::string& text, const Golden& golden, const std::string& path) {
    const std::vector<std::string> found = split(text);
    const std::vector<std::string> expected = split(to_text(golden));
    for (std::size_t i = 0; i < found.size(); ++i)
        if (i >= expected.size() || found[i] != expected[i])
            throw world::Error(fmt::format(
                "{}:{}: not as `reprise accept` writes it; restore the file, or remove it and "
                "accept the case again",
                path,
                i + 1));
}

}  // namespace

Golden parse_golden(const std::string& text, const std::string& path) {
    const std::vector<std::string> lines = split(text);
    check_first_line(lines, path);
    const std::size_t seal = text.rfind("\nseal ");
    Golden golden;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        Words words(lines[i], path, i + 1);
        if (i + 1 < lines.size() || seal == std::string::npos)
            parse_line(lines[i], golden, words);
    }
    if (seal == std::string::npos || !lines.back().starts_with("seal "))
        throw world::Error(fmt::format(
            "{}:{}: cut off: the last line of a golden is its seal", path, lines.size()));
    if (text.substr(seal) != "\nseal " + golden_seal(std::string_view(text).substr(0, seal)) + "\n")
        throw world::Error(fmt::format(
            "{}:{}: the seal does not hold: the file was edited, or merged; restore it, or remove "
            "it and accept the case again",
            path,
            lines.size()));
    check_spelling(text, golden, path);
    return golden;
}

Golden load_golden(const std::filesystem::path& path) {
    std::error_code ignored;
    std::ifstream in(path, std::ios::binary);
    if (!std::filesystem::is_regular_file(path, ignored) || !in)
        throw world::Error(path.string() + ": cannot be read");
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    return parse_golden(text, path.string());
}

}  // namespace reprise::replay
