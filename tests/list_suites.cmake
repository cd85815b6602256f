# Writes OUT: a test of CTest for each suite of PROGRAM. Starting the program takes longer than most tests do, so that
# a process for each of them would take twice as long as all of them.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[^ \n][^\n]*" lines "${listed}")
set(text "")
foreach(line IN LISTS lines)
  string(STRIP "${line}" suite)
  string(REGEX REPLACE " .*" "" suite "${suite}") # without the type of a typed suite
  if(suite MATCHES "^[A-Za-z0-9_/]+\\.$")
    string(REGEX REPLACE "\\.$" "" name "${suite}")
    string(APPEND text "add_test(\"${name}\" \"${PROGRAM}\" \"--gtest_filter=${suite}*\" --gtest_brief=1)\n"
                       "set_tests_properties(\"${name}\" PROPERTIES ENVIRONMENT OMP_WAIT_POLICY=passive)\n")
  endif()
endforeach()
file(WRITE ${OUT} "${text}")
