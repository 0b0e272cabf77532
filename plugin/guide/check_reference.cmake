# SPDX-License-Identifier: Apache-2.0
# cmake -DDOXYGEN=<program> -DDOXYFILE=<file> -P check_reference.cmake: builds the reference of the public headers, and
# fails if Doxygen finds anything wrong in it. Parameters whose names say all are not documented one by one, which
# Doxygen 1.9.4 cannot be told.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND "${DOXYGEN}" "${DOXYFILE}" ERROR_VARIABLE messages OUTPUT_QUIET RESULT_VARIABLE result)
string(REPLACE ";" "," messages "${messages}")
string(REPLACE "\n" ";" messages "${messages}")
list(FILTER messages INCLUDE REGEX "(warning|error):")
list(FILTER messages EXCLUDE REGEX "The following parameters? of .* (is|are) not documented:")
if(messages OR NOT result EQUAL 0)
    list(JOIN messages "\n" messages)
    message(FATAL_ERROR "${result}\n${messages}")
endif()
