# How every room is built. The flags are the same everywhere, because they are part of what a
# recorded run depends on: see docs/determinism.md.
set(REPRISE_SANITIZE "" CACHE STRING "Comma-separated sanitizers, such as address,undefined")
# Without lines for a debugger, which are a fifteenth of the compiler's time: the preset dev has them all.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g")

# None of the last four changes a number. Vectors of three were put together in pairs, and whoever
# read them whole waited for their parts to arrive in memory: 8 % of a picture. What is -fPIC is
# inlined all the same; square roots are instructions alone.
set(REPRISE_FLAGS -ffp-contract=off -march=x86-64 -mtune=generic
    -fno-tree-slp-vectorize -fno-semantic-interposition -fno-math-errno -fno-trapping-math)

# A newcomer's build compiles the files of a folder together, at most this many at a time: headers are
# read once for all of them (a third of the time of single files). 0: each file alone, for work on them.
set(REPRISE_UNITY 0 CACHE STRING "Files compiled together; 0: each alone")

add_library(reprise_build INTERFACE)
# -fPIC for programs as for libraries: one kind of code, so that compiled headers serve both.
target_compile_options(reprise_build INTERFACE
  ${REPRISE_FLAGS} -fPIC -Wall -Wextra -Wpedantic -Wconversion -Wnon-virtual-dtor -Wold-style-cast
  -Wdouble-promotion)
# What one file hides from another of its folder, and types of its own inside of a class, are only seen
# by the compiler when files are compiled together; alone, names that hide others are told.
target_compile_options(reprise_build INTERFACE
  $<IF:$<BOOL:${REPRISE_UNITY}>,-Wno-subobject-linkage,-Wshadow>)
# GCC 12 guesses these behind its optimiser, and wrongly at times: one came and went with the length of the checkout's
# path. They are told, and are no error; the last not even told, as it finds a new one wherever more is inlined (the
# sanitizers and valgrind look for such).
target_compile_options(reprise_build INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-error=stringop-overread;\
-Wno-error=stringop-overflow;-Wno-error=restrict;-Wno-error=array-bounds;-Wno-maybe-uninitialized>")
# State maths uses Eigen's fixed sizes only; without its own vector code their results do not depend
# on where an array happens to lie in memory.
target_compile_definitions(reprise_build INTERFACE EIGEN_DONT_VECTORIZE EIGEN_DONT_PARALLELIZE)
# As fmt's own target says to those who link it: the compiled headers were read with it.
target_compile_definitions(reprise_build INTERFACE FMT_SHARED)
# ccache takes the old compiled headers for what the new ones are made from, and may hand out those of another schema:
# layouts would mix in silence. On the command line the schemas are part of what it compares.
file(GLOB schemas CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/world/*.fbs ${PROJECT_SOURCE_DIR}/remote/*.fbs)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${schemas})
set(digests "")
foreach(schema IN LISTS schemas)
  file(SHA256 ${schema} digest)
  string(APPEND digests ${digest})
endforeach()
string(SHA256 digests "${digests}")
string(SUBSTRING ${digests} 0 12 digests)
target_compile_definitions(reprise_build INTERFACE REPRISE_SCHEMAS=0x${digests})
if(REPRISE_SANITIZE)
  target_compile_options(reprise_build INTERFACE
    -fsanitize=${REPRISE_SANITIZE} -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(reprise_build INTERFACE -fsanitize=${REPRISE_SANITIZE})
endif()

# Headers that most files of the newcomer's build read, compiled once: those of the rooms, in world, and
# those of the tests. Single files (preset dev) do without, and so say which include a file lacks.
set(REPRISE_HEADERS <algorithm> <array> <charconv> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
    <memory> <numbers> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>
    <Eigen/Core> <Eigen/Geometry> <flatbuffers/flatbuffers.h> <fmt/format.h>
    [["world/episode_generated.h"]] [["world/tick_generated.h"]] [["world/town_generated.h"]])

# usage: reprise_precompiled(TARGET OWNER [HEADER ...]): TARGET reads the headers that OWNER has compiled
function(reprise_precompiled target owner)
  if(NOT REPRISE_UNITY)
    return()
  endif()
  # ccache follows the headers by it.
  target_compile_options(${target} PRIVATE -fpch-preprocess)
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${REPRISE_HEADERS} ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# Code that no tick waits for: half of the optimiser's work is enough. With that half GCC 12 sees overflows in
# std::string that are not there (its bug 105651); single files are still asked.
function(reprise_seldom_run target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1 -Wno-array-bounds -Wno-stringop-overflow>)
endfunction()

# usage: reprise_unity(TARGET [ACROSS_FOLDERS]): compiles files of one folder together: they are about one thing, and
# their names do not clash. ACROSS_FOLDERS: with those of its neighbours as well, where they are few. Before its first
# line a unit costs a second (headers, and the templates they use), half of what a small folder takes.
function(reprise_unity target)
  if(NOT REPRISE_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  set(folders)
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "in_${folder}" folder)
    list(APPEND folders ${folder})
    list(APPEND sources_${folder} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  set(unit 0)
  set(room 0)  # for so many files in this unit
  foreach(folder IN LISTS folders)
    list(LENGTH sources_${folder} count)
    if(count GREATER room OR NOT "ACROSS_FOLDERS" IN_LIST ARGN)
      set(room 0)
    endif()
    foreach(source IN LISTS sources_${folder})
      if(room EQUAL 0)
        math(EXPR unit "${unit} + 1")
        set(room ${REPRISE_UNITY})
      endif()
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP "${target}_${unit}")
      math(EXPR room "${room} - 1")
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# reprise_room(NAME [ACROSS_FOLDERS] SOURCES ... SELDOM ... ROOMS ... LIBRARIES ...): one static library per folder. LIBRARIES
# stay private to the room: no third-party type crosses its headers. SELDOM: those of its sources that
# neither a tick nor a picture waits for. ACROSS_FOLDERS: see reprise_unity.
function(reprise_room name)
  cmake_parse_arguments(ROOM "ACROSS_FOLDERS" "" "SOURCES;SELDOM;ROOMS;LIBRARIES" ${ARGN})
  set(across)
  if(ROOM_ACROSS_FOLDERS)
    set(across ACROSS_FOLDERS)
  endif()
  add_library(${name} STATIC ${ROOM_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                             $<INSTALL_INTERFACE:include/reprise>)
  target_link_libraries(${name} PUBLIC ${ROOM_ROOMS} PRIVATE reprise_build ${ROOM_LIBRARIES})
  reprise_unity(${name} ${across})
  reprise_precompiled(${name} world)
  if(NOT ROOM_SELDOM)
    return()
  endif()
  add_library(${name}_seldom OBJECT ${ROOM_SELDOM})
  target_include_directories(${name}_seldom PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name}_seldom PRIVATE reprise_build ${ROOM_ROOMS} ${ROOM_LIBRARIES})
  reprise_seldom_run(${name}_seldom)
  reprise_unity(${name}_seldom ${across})
  reprise_precompiled(${name}_seldom world)
  target_sources(${name} PRIVATE $<TARGET_OBJECTS:${name}_seldom>)
endfunction()

# Each suite of a test program is a test of ctest and a process, in which its cases share what they have read. A process that
# loads SUMO, or OpenCV, and the two hundred libraries that these want takes a tenth of a second before its first line.
function(reprise_discover_suites name)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${list}
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${name}> -DTIMEOUT=900 -DOUTPUT=${list}
            -P ${PROJECT_SOURCE_DIR}/cmake/DiscoverSuites.cmake VERBATIM)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
  file(WRITE ${include} "if(EXISTS \"${list}\")\n  include(\"${list}\")\n"
                        "else()\n  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()

# reprise_test(NAME [FOREIGN_BYTES] [BY_SUITE] SOURCES ... ROOMS ...): one test program per room. FOREIGN_BYTES: the
# room reads what others wrote; ./dev sanitize runs its tests with sanitizers. BY_SUITE: see reprise_discover_suites.
add_custom_target(foreign_bytes)

function(reprise_test name)
  cmake_parse_arguments(TEST "FOREIGN_BYTES;BY_SUITE" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  reprise_seldom_run(${name})
  target_link_libraries(${name} PRIVATE reprise_build ${TEST_ROOMS} ${TEST_LIBRARIES} GTest::gmock
                                        GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  reprise_unity(${name})
  reprise_precompiled(${name} test_headers)
  if(TEST_BY_SUITE)
    reprise_discover_suites(${name})
    return()
  endif()
  set(properties TIMEOUT 300)
  if(TEST_FOREIGN_BYTES)
    add_dependencies(foreign_bytes ${name})
    list(APPEND properties LABELS foreign_bytes)
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()

include(GoogleTest)
