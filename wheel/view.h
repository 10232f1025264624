#pragma once

#include <functional>
#include <memory>
#include <string>

#include "wheel/image.h"

namespace reprise::wheel {

/// [s] of real time, from any beginning.
using Clock = std::function<double()>;

/// What a person wants, as keys, a joystick or a steering wheel say it.
struct Wishes {
    bool ahead = false;  ///< held
    bool back = false;
    bool left = false;
    bool right = false;
    bool hand_brake = false;
    unsigned gear = 0;    ///< pressed so many times since the last look: forward or reverse
    unsigned sensor = 0;  ///< likewise: another picture
    unsigned pause = 0;   ///< likewise
    bool end = false;

    /// Of what has axes and not keys; zero where nothing is touched, or nothing is there.
    double steer = 0;     ///< [-1, 1], left positive
    double throttle = 0;  ///< [0, 1]
    double brake = 0;     ///< [0, 1]
};

/// Where a person looks, and says what she wants.
class View {
  public:
    View() = default;
    virtual ~View() = default;
    View(const View&) = delete;
    View& operator=(const View&) = delete;

    /// What is held at the end of so many seconds, or was pressed in them; at once when there is
    /// nothing to wait for, and when the end is wanted.
    virtual Wishes wait(double seconds) = 0;

    /// `image`: none, where there is no picture at all. `line`: of the dashboard.
    virtual void show(const Image* image, const std::string& line) = 0;
};

/// A window. Throws world::Error where none can be opened.
std::unique_ptr<View> open_window(const Clock& clock);

/// The terminal in which we were started. Throws world::Error where there is none.
std::unique_ptr<View> open_terminal(const Clock& clock);

/// `which`: 'window', 'terminal', or 'auto': a window where one can be opened. Throws world::Error,
/// one line.
std::unique_ptr<View> open_view(const std::string& which, const Clock& clock);

}  // namespace reprise::wheel
