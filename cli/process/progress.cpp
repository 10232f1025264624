#include "cli/process/progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace reprise::cli {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto redraw = std::chrono::milliseconds(100);

}  // namespace

Progress::Progress(std::string what, std::string unit, std::uint64_t total)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(std::max<std::uint64_t>(total, 1)),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      begin_(Clock::now()),
      next_(begin_ + redraw) {}

Progress::~Progress() {
    clear();
}

void Progress::update(std::uint64_t done) {
    if (!on_terminal_ || done == 0)  // nothing to tell the speed by
        return;
    const auto now = Clock::now();
    if (now < next_)
        return;
    next_ = now + redraw;
    draw(done);
}

void Progress::draw(std::uint64_t done) {
    constexpr std::uint64_t width = 30;
    const std::uint64_t filled = std::min(width, width * done / total_);
    const double rate = static_cast<double>(done) / std::max(seconds(), 1e-9);
    const double left = static_cast<double>(total_ - std::min(done, total_)) / std::max(rate, 1e-9);
    const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::fprintf(stderr,
                 "\r\033[K%s [%s] %3llu %%  %.0f %s/s  %.0f s left",
                 what_.c_str(),
                 bar.c_str(),
                 static_cast<unsigned long long>(100 * std::min(done, total_) / total_),
                 rate,
                 unit_.c_str(),
                 left);
    std::fflush(stderr);
    drawn_ = true;
}

void Progress::clear() {
    if (drawn_)
        std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

double Progress::seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
}

}  // namespace reprise::cli
