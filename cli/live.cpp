#include "cli/live.h"

#include "cli/process/guard.h"
#include "remote/live_rig.h"
#include "render/sensors.h"

namespace reprise::cli {

int live() {
    try {
        remote::LivePictures pictures;
        render::Sensors sensors(pictures.town());
        pictures.ready();
        for (;;) {
            const remote::LivePictures::Wish wish = pictures.next();
            render::Neighbours neighbours;
            if (wish.last)
                neighbours.last = render::Neighbour{*wish.last, {}};
            pictures.show(
                sensors.observe(wish.tick, wish.sensors, *wish.tick.tick->weather(), neighbours));
        }
    } catch (const remote::ChannelFault&) {
        // The run ended, and says why; nobody looks any more.
    }
    return exit_good;
}

}  // namespace reprise::cli
