#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "wheel/view.h"

namespace reprise::wheel {

enum class Key { ahead, back, left, right, hand_brake, gear, sensor, pause, end };

/// The keys in what a terminal sends: letters, and escape sequences of arrows. A lone escape is the
/// key of that name. What means nothing to us is passed over.
std::vector<Key> keys_in(std::string_view bytes);

/// Terminals say that a key went down, say so again while it is held, and never that it went up;
/// of two that are held only the last one repeats. So a key counts as held for some time behind
/// each word of it: pedals longer than the wheel.
class RepeatedKeys {
  public:
    void press(Key key, double now);

    /// What is held at this time [s]; what was pressed since the last call.
    Wishes look(double now);

  private:
    static constexpr std::size_t held_keys = 5;  ///< those up to the hand brake

    Wishes pressed_;                         ///< once each
    std::array<double, held_keys> until_{};  ///< [s]
};

}  // namespace reprise::wheel
