# cmake -P script: runs PROGRAM and compares what it prints with the file EXPECTED.
execute_process(COMMAND ${PROGRAM} OUTPUT_VARIABLE printed RESULT_VARIABLE status)
file(READ ${EXPECTED} expected)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the example ended with ${status}")
endif()
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "the documentation says the example prints\n${expected}but it printed\n${printed}")
endif()
