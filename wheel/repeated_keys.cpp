#include "wheel/repeated_keys.h"

#include <optional>

namespace reprise::wheel {

namespace {

constexpr char escape = '\x1b';
constexpr char interrupt = '\x03';  // Ctrl-C

// [s] Keyboards begin to repeat after 0.25 to 0.66.
constexpr double pedal_time = 1.0;
constexpr double wheel_time = 0.35;

std::optional<Key> arrow(char letter) {
    switch (letter) {
        case 'A':
            return Key::ahead;
        case 'B':
            return Key::back;
        case 'C':
            return Key::right;
        case 'D':
            return Key::left;
        default:
            return std::nullopt;
    }
}

std::optional<Key> letter_key(char letter) {
    switch (letter) {
        case 'w':
        case 'W':
            return Key::ahead;
        case 's':
        case 'S':
            return Key::back;
        case 'a':
        case 'A':
            return Key::left;
        case 'd':
        case 'D':
            return Key::right;
        case ' ':
            return Key::hand_brake;
        case 'r':
        case 'R':
            return Key::gear;
        case '\t':
            return Key::sensor;
        case 'p':
        case 'P':
            return Key::pause;
        case 'q':
        case 'Q':
        case escape:
        case interrupt:
            return Key::end;
        default:
            return std::nullopt;
    }
}

}  // namespace

std::vector<Key> keys_in(std::string_view bytes) {
    std::vector<Key> keys;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const bool sequence = bytes[i] == escape && i + 1 < bytes.size() &&
                              (bytes[i + 1] == '[' || bytes[i + 1] == 'O');
        std::optional<Key> key;
        if (sequence) {
            // Parameters stand before the letter that ends it: ESC [ 1 ; 2 A is an arrow with
            // shift.
            for (i += 2; i < bytes.size() && bytes[i] < '@';)
                ++i;
            key = i < bytes.size() ? arrow(bytes[i]) : std::nullopt;
        } else {
            key = letter_key(bytes[i]);
        }
        if (key)
            keys.push_back(*key);
    }
    return keys;
}

void RepeatedKeys::press(Key key, double now) {
    const auto index = static_cast<std::size_t>(key);
    if (index < held_keys) {
        const bool wheel = key == Key::left || key == Key::right;
        until_[index] = now + (wheel ? wheel_time : pedal_time);
        // Who turns the wheel to the other side, or brakes, has let go of the other key.
        constexpr std::array<std::size_t, held_keys> other{1, 0, 3, 2, 4};
        if (other[index] != index)
            until_[other[index]] = now;
    }
    if (key == Key::gear)
        ++pressed_.gear;
    if (key == Key::sensor)
        ++pressed_.sensor;
    if (key == Key::pause)
        ++pressed_.pause;
    if (key == Key::end)
        pressed_.end = true;
}

Wishes RepeatedKeys::look(double now) {
    Wishes wishes = pressed_;
    pressed_ = {};
    const auto held = [&](Key key) { return until_[static_cast<std::size_t>(key)] > now; };
    wishes.ahead = held(Key::ahead);
    wishes.back = held(Key::back);
    wishes.left = held(Key::left);
    wishes.right = held(Key::right);
    wishes.hand_brake = held(Key::hand_brake);
    return wishes;
}

}  // namespace reprise::wheel
