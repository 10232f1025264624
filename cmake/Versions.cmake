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

file(GLOB REPRISE_STATE_SOURCES CONFIGURE_DEPENDS
     ${PROJECT_SOURCE_DIR}/world/*.cpp ${PROJECT_SOURCE_DIR}/world/*.h ${PROJECT_SOURCE_DIR}/world/*.fbs
     ${PROJECT_SOURCE_DIR}/scripting/*.cpp ${PROJECT_SOURCE_DIR}/scripting/*.h
     ${PROJECT_SOURCE_DIR}/scripting/*.lua
     ${PROJECT_SOURCE_DIR}/replay/*.cpp ${PROJECT_SOURCE_DIR}/replay/*.h
     ${PROJECT_SOURCE_DIR}/traffic/*.cpp ${PROJECT_SOURCE_DIR}/traffic/*.h
     ${PROJECT_SOURCE_DIR}/kernel/*.cpp ${PROJECT_SOURCE_DIR}/kernel/*.h)
list(SORT REPRISE_STATE_SOURCES)

string(JOIN " " REPRISE_FLAGS_TEXT -O2 ${REPRISE_FLAGS})
if(REPRISE_SANITIZE)
  string(APPEND REPRISE_FLAGS_TEXT " -fsanitize=${REPRISE_SANITIZE}")
endif()
