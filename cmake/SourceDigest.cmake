# Script mode: cmake -DOUTPUT=... "-DSOURCES=a;b" -P SourceDigest.cmake
# Writes a header with one digest of all sources that can change a run; leaves it alone when equal.
set(all "")
foreach(source IN LISTS SOURCES)
  file(SHA256 ${source} digest)
  string(APPEND all ${digest})
endforeach()
string(SHA256 all "${all}")
string(SUBSTRING ${all} 0 16 all)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define REPRISE_SOURCE_DIGEST \"${all}\"\n")
