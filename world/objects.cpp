// How the nouns' objects are packed into bytes, unpacked and compared: flatc's code, compiled once.
#include "world/common_generated.h"
#include "world/episode_generated.h"
#include "world/tick_generated.h"
#include "world/town_generated.h"
#include "world/traffic_generated.h"

namespace reprise::world {

#include "world/common_objects.inc"
#include "world/episode_objects.inc"
#include "world/tick_objects.inc"
#include "world/town_objects.inc"
#include "world/traffic_objects.inc"

}  // namespace reprise::world
