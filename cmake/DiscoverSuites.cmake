# One test of ctest for each suite of a test program: cmake -DPROGRAM=... -DTIMEOUT=... -DOUTPUT=... -P this
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\.( *#[^\n]*)?\n" suites "\n${listed}")
set(script)
foreach(line IN LISTS suites)
  string(REGEX REPLACE "\n([A-Za-z0-9_/]+)\\..*" "\\1" suite "${line}")
  string(APPEND script "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
                       "set_tests_properties([=[${suite}]=] PROPERTIES TIMEOUT ${TIMEOUT})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
