# What goes into the build fingerprint (world/fingerprint.cpp.in): versions as the package manager
# knows them, because Debian's point releases can change results, and a digest of our own sources.
function(reprise_package_version variable package)
  execute_process(COMMAND dpkg-query -W -f=\${Version} ${package}
                  OUTPUT_VARIABLE version ERROR_QUIET RESULT_VARIABLE failed)
  if(failed OR version STREQUAL "")
    set(version "unknown")
  endif()
  set(${variable} "${version}" PARENT_SCOPE)
endfunction()

reprise_package_version(SUMO_VERSION sumo)
reprise_package_version(LIBM_VERSION musl-dev)
string(PREPEND LIBM_VERSION "musl ")

# Every room that a run's state comes out of, at any depth; tests/state_sources_test.sh counts after.
set(REPRISE_STATE_ROOMS world ground walkers towns scripting traffic drivers replay kernel)
set(patterns)
foreach(room IN LISTS REPRISE_STATE_ROOMS)
  foreach(ending cpp h fbs lua in)
    list(APPEND patterns ${PROJECT_SOURCE_DIR}/${room}/*.${ending})
  endforeach()
endforeach()
file(GLOB_RECURSE REPRISE_STATE_SOURCES CONFIGURE_DEPENDS ${patterns})
list(SORT REPRISE_STATE_SOURCES)
list(JOIN REPRISE_STATE_SOURCES "\n" lines)
file(WRITE ${PROJECT_BINARY_DIR}/generated/state_sources.txt "${lines}\n")

string(JOIN " " REPRISE_FLAGS_TEXT -O2 ${REPRISE_FLAGS})
if(REPRISE_SANITIZE)
  string(APPEND REPRISE_FLAGS_TEXT " -fsanitize=${REPRISE_SANITIZE}")
endif()
