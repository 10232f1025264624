#include "cli/live.h"

#include "cli/process/guard.h"
#include "remote/live_rig.h"
#include "render/sensors.h"

namespace reprise::cli {

int live() {
    remote::LivePictures pictures;
    render::Sensors sensors(pictures.town());
    pictures.ready();
    while (const auto wish = pictures.next())
        pictures.show(sensors.observe(wish->tick, wish->sensors, *wish->tick.tick->weather()));
    return exit_good;
}

}  // namespace reprise::cli
