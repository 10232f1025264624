#include "process/copy.h"

#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "process/nameless_file.h"
#include "world/check.h"

namespace reprise::process {

namespace {

using How = CopyResult::How;

void check_alone() {
    namespace fs = std::filesystem;
    const auto threads =
        std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
    REPRISE_CHECK(threads == 1, fmt::format("{} threads run, a copy would have one", threads));
}

std::string too_much_memory(const Copy& copy) {
    if (!copy.limits.memory)
        return copy.subject + ": out of memory";
    return fmt::format("{}: more than {} GB of memory would be needed",
                       copy.subject,
                       static_cast<double>(*copy.limits.memory >> 20) / 1024);
}

CopyResult do_work(const Copy& copy) {
    try {
        return {How::returned, copy.work()};
    } catch (const world::Error& error) {
        return {How::mistake, error.what()};
    } catch (const Stopped& stopped) {
        return {How::mistake, stopped.what()};
    } catch (const std::bad_alloc&) {
        return {How::mistake, too_much_memory(copy)};
    } catch (const std::exception& error) {
        return {How::fault, error.what()};
    }
}

/// In the copy. Its exit code says whether all of its note was written.
int be_copy(const Copy& copy, const NamelessFile& note) {
    Limits limits = copy.limits;
#ifdef __SANITIZE_ADDRESS__
    limits.memory.reset();  // it maps terabytes
#endif
    impose(limits);
    const CopyResult result = do_work(copy);
    std::fflush(nullptr);
    // Here the copy ends, without the farewells of libraries: what they hold is ours, too.
    const bool written =
        note.write(std::string(1, static_cast<char>(result.how))) && note.write(result.text);
    return written ? 0 : 1;
}

CopyResult result_of(const Copy& copy, const NamelessFile& note, const Ended& ended) {
    const std::string told = note.read(std::numeric_limits<std::size_t>::max());
    if (ended.signal == 0 && ended.code == 0 && !told.empty())
        return {static_cast<How>(told[0]), told.substr(1)};
    if (ended.signal == 0)
        return {
            How::fault,
            fmt::format("{}: the work on it ended with exit code {}", copy.subject, ended.code)};
    if (ended.signal == SIGINT || ended.signal == SIGTERM || ended.signal == SIGHUP)
        return {How::mistake,
                fmt::format("{}: stopped ({})", copy.subject, strsignal(ended.signal))};
    const bool limited = (ended.signal == SIGXCPU && copy.limits.seconds) ||
                         (ended.signal == SIGXFSZ && copy.limits.file);
    return {limited ? How::mistake : How::fault,
            fmt::format("{}: the work on it {}", copy.subject, reason(ended.signal, copy.limits))};
}

}  // namespace

std::vector<CopyResult> run_copies(const Children& children, const std::vector<Copy>& copies) {
    check_alone();
    std::fflush(nullptr);  // or each copy would write it again
    std::vector<CopyResult> results(copies.size());
    std::vector<std::optional<NamelessFile>> notes(copies.size());  // open while it runs
    children.run({copies.size(),
                  [&](std::size_t i) { notes[i].emplace(); },
                  [&](std::size_t i) { return be_copy(copies[i], *notes[i]); },
                  [&](std::size_t i, const Ended& ended) {
                      results[i] = result_of(copies[i], *notes[i], ended);
                      notes[i].reset();
                  }});
    return results;
}

std::string run_copy(const Copy& copy) {
    const CopyResult result = run_copies(Children(1), {copy}).front();
    if (result.how == How::mistake)
        throw world::Error(result.text);
    if (result.how == How::fault)
        throw std::runtime_error(result.text);
    return result.text;
}

}  // namespace reprise::process
