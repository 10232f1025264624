# Every third-party library the project uses, found once, under one name each. All come from Debian 12
# packages (packages.txt). Imported targets are SYSTEM: their headers' warnings are not ours.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(FlatBuffers CONFIG REQUIRED)
find_package(embree 3.13 REQUIRED CONFIG)
find_package(TBB REQUIRED CONFIG)
find_package(pugixml REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(Boost 1.74 REQUIRED)
find_path(cgal_headers CGAL/Constrained_Delaunay_triangulation_2.h REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(EXPAT REQUIRED)
find_package(nlohmann_json REQUIRED CONFIG)
pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet-float64)
pkg_check_modules(lua REQUIRED IMPORTED_TARGET lua5.4-c++)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(sqlite3 REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(proj REQUIRED IMPORTED_TARGET proj)
pkg_check_modules(openexr REQUIRED IMPORTED_TARGET OpenEXR)
pkg_check_modules(cli11 REQUIRED IMPORTED_TARGET CLI11)
# malloc of the program that simulates. A step of SUMO's asks for 2,000 blocks, and looks at thousands that were asked for minutes
# apart: with jemalloc 200 s among 100 cars take 4 to 5 % less than with glibc's. Nobody names a symbol of it, so the
# linker is told to keep it. A sanitizer has its own.
pkg_check_modules(jemalloc REQUIRED IMPORTED_TARGET jemalloc)
add_library(memory INTERFACE)
if(NOT REPRISE_SANITIZE)
  target_sources(memory INTERFACE ${PROJECT_SOURCE_DIR}/cli/process/run_memory.cpp)
  target_link_libraries(memory INTERFACE -Wl,--push-state,--no-as-needed PkgConfig::jemalloc -Wl,--pop-state)
endif()
# The one that may be missing: then who drives by hand looks at a terminal.
pkg_check_modules(sdl2 IMPORTED_TARGET sdl2)
# Their -pthread defines _REENTRANT, which says nothing to this compiler, but that the compiled headers are others'.
foreach(target PkgConfig::openexr PkgConfig::sdl2)
  if(TARGET ${target})
    set_target_properties(${target} PROPERTIES INTERFACE_COMPILE_OPTIONS "")
  endif()
endforeach()

# libsumo, Recast, libosmium and the OpenCV modules ship no CMake package in the small -dev packages we install.
include(PlainLibrary)

# Headers only; those that read XML need expat and threads.
reprise_plain_library(osmium osmium/io/xml_input.hpp)
target_link_libraries(osmium INTERFACE EXPAT::EXPAT Threads::Threads)
reprise_plain_library(recast recastnavigation/Recast.h NAMES DetourCrowd Detour Recast)
reprise_plain_library(sumo libsumo/libsumo.h NAMES sumocpp)
reprise_plain_library(opencv opencv2/core.hpp PATHS opencv4
                      NAMES opencv_core opencv_imgproc)
reprise_plain_library(opencv_video opencv2/videoio.hpp PATHS opencv4 NAMES opencv_core opencv_videoio)

# ./dev demo builds the program only, from packages.txt's first list.
option(REPRISE_TESTS "Build tests and benchmarks, which need packages.txt's second list" ON)
if(REPRISE_TESTS)
  find_package(GTest CONFIG)
  find_package(benchmark CONFIG)
  if(NOT GTest_FOUND OR NOT benchmark_FOUND)
    message(FATAL_ERROR "tests need libgmock-dev, libgtest-dev and libbenchmark-dev (packages.txt, [tests]): "
                        "./dev test installs them, -DREPRISE_TESTS=OFF builds without tests")
  endif()
  # Reads again what render/codecs writes.
  reprise_plain_library(opencv_codecs opencv2/imgcodecs.hpp PATHS opencv4 NAMES opencv_imgcodecs)
endif()
