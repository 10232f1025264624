# Script mode: cmake -DOUTPUT=... -DNAME=... "-DSOURCES=a;b" -P SourceDigest.cmake
# Writes a header that defines NAME as one digest of all these files; leaves it alone when equal.
set(all "")
foreach(source IN LISTS SOURCES)
  file(SHA256 ${source} digest)
  string(APPEND all ${digest})
endforeach()
string(SHA256 all "${all}")
string(SUBSTRING ${all} 0 16 all)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define ${NAME} \"${all}\"\n")
