// The least that a driver in C++ can do: it looks at its speed, and answers. idle_driver [POLLING]
#include <cstdlib>

#include "remote/client.h"

int main(int count, char** words) {
    using namespace reprise::remote;
    Client run("", count > 1 ? std::atof(words[1]) : usual_polling);
    while (const auto tick = run.next()) {
        const auto* own = reprise::world::find(tick->measurements(), run.actor());
        run.say({.throttle = own != nullptr && own->speed() < 5 ? 0.4 : 0.0});
    }
}
