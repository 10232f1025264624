// The least that a driver in C++ can do: it looks at its speed, and answers.
#include "remote/client.h"

int main() {
    reprise::remote::Client run;
    while (const auto tick = run.next()) {
        const auto* own = reprise::world::find(tick->measurements(), run.actor());
        run.say({.throttle = own != nullptr && own->speed() < 5 ? 0.4 : 0.0});
    }
}
