// In place of window.cpp where the build had no SDL2.
#include "wheel/view.h"
#include "world/check.h"

namespace reprise::wheel {

std::unique_ptr<View> open_window(const Clock& /*clock*/) {
    throw world::Error("this build has no windows: libsdl2-dev was missing");
}

}  // namespace reprise::wheel
