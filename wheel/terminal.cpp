#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "wheel/half_blocks.h"
#include "wheel/repeated_keys.h"
#include "wheel/view.h"
#include "world/check.h"

namespace reprise::wheel {

namespace {

constexpr const char* device = "/dev/tty";
constexpr std::string_view enter = "\x1b[?1049h\x1b[?25l\x1b[2J";  // another screen, no cursor
constexpr std::string_view leave = "\x1b[0m\x1b[?25h\x1b[?1049l";

/// The terminal of our session, key by key: our group stands in front until we are done, so that
/// the terminal lets us read, and Ctrl-C is a key.
class Terminal : public View {
  public:
    explicit Terminal(const Clock& clock)
        : clock_(clock),
          descriptor_(open(device, O_RDWR | O_CLOEXEC)) {
        if (descriptor_ < 0)
            throw world::Error(std::string("no terminal: ") + std::strerror(errno));
        signal(SIGTTOU, SIG_IGN);  // else who is not in front is stopped when it says so
        front_before_ = tcgetpgrp(descriptor_);
        if (tcsetpgrp(descriptor_, getpgrp()) != 0 || tcgetattr(descriptor_, &before_) != 0) {
            const int reason = errno;
            close(descriptor_);
            throw world::Error(std::string("no terminal: ") + std::strerror(reason));
        }
        termios raw = before_;
        cfmakeraw(&raw);
        tcsetattr(descriptor_, TCSANOW, &raw);
        say(enter);
    }

    ~Terminal() override {
        say(leave);
        tcsetattr(descriptor_, TCSANOW, &before_);
        tcsetpgrp(descriptor_, front_before_);
        close(descriptor_);
    }

    Wishes wait(double seconds) override {
        constexpr double milliseconds = 1e3;
        const double until = clock_() + seconds;
        for (;;) {
            const double left = until - clock_();
            pollfd one{descriptor_, POLLIN, 0};
            const int ready =
                poll(&one, 1, left > 0 ? static_cast<int>(left * milliseconds) + 1 : 0);
            const double now = clock_();
            if (ready > 0)
                hear(now);
            Wishes wishes = keys_.look(now);
            taken_.gear += wishes.gear;
            taken_.sensor += wishes.sensor;
            taken_.pause += wishes.pause;
            if (!wishes.end && (ready > 0 || now < until))
                continue;
            wishes.gear = taken_.gear;
            wishes.sensor = taken_.sensor;
            wishes.pause = taken_.pause;
            taken_ = {};
            return wishes;
        }
    }

    void show(const Image* image, const std::string& line) override {
        winsize size{};
        if (ioctl(descriptor_, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0)
            size = {24, 80, 0, 0};
        std::string text = "\x1b[H";
        if (image != nullptr)  // the last two lines are for the dashboard, and for the run's own
            text += half_blocks(*image, size.ws_col, size.ws_row - 2);
        text += line.substr(0, size.ws_col) + "\x1b[K\r\n";
        say(text);
    }

  private:
    void hear(double now) {
        std::array<char, 256> bytes{};
        const ssize_t count = read(descriptor_, bytes.data(), bytes.size());
        if (count <= 0)  // the terminal is gone
            return keys_.press(Key::end, now);
        for (const Key key : keys_in({bytes.data(), static_cast<std::size_t>(count)}))
            keys_.press(key, now);
    }

    void say(std::string_view text) const {
        while (!text.empty()) {
            const ssize_t count = write(descriptor_, text.data(), text.size());
            if (count <= 0 && errno != EINTR)
                return;
            text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        }
    }

    Clock clock_;
    int descriptor_ = -1;
    pid_t front_before_ = -1;
    termios before_{};
    RepeatedKeys keys_;
    Wishes taken_;  ///< what was pressed once, while we wait on
};

}  // namespace

std::unique_ptr<View> open_terminal(const Clock& clock) {
    return std::make_unique<Terminal>(clock);
}

std::unique_ptr<View> open_view(const std::string& which, const Clock& clock) {
    if (which == "window")
        return open_window(clock);
    if (which == "terminal")
        return open_terminal(clock);
    try {
        return open_window(clock);
    } catch (const world::Error& no_window) {
        try {
            return open_terminal(clock);
        } catch (const world::Error& no_terminal) {
            throw world::Error(std::string("no display: ") + no_window.what() + "; " +
                               no_terminal.what());
        }
    }
}

}  // namespace reprise::wheel
