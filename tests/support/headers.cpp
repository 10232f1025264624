// A target needs a source to own compiled headers: cmake/Room.cmake, reprise_precompiled.
