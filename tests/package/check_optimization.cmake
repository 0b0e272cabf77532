# SPDX-License-Identifier: Apache-2.0
# cmake -DCOMMANDS=<compile_commands.json> -DFLAG=<-O...> -P check_optimization.cmake: fails unless the last -O of every
# compilation of the project's own libraries and tests, the one that holds, is the flag.
cmake_minimum_required(VERSION 3.25)
file(READ "${COMMANDS}" commands)
string(JSON count LENGTH "${commands}")
math(EXPR last "${count} - 1")
set(checked 0)
foreach(index RANGE ${last})
    string(JSON command GET "${commands}" ${index} command)
    string(JSON file GET "${commands}" ${index} file)
    if(file MATCHES "/user\\.cpp$")  # the parent's own
        continue()
    endif()
    string(REGEX MATCHALL " -O[0-9a-z]*" flags "${command}")
    list(POP_BACK flags flag)
    if(NOT flag STREQUAL " ${FLAG}")
        message(FATAL_ERROR "${file} is compiled with '${flag}', not ${FLAG}:\n${command}")
    endif()
    math(EXPR checked "${checked} + 1")
endforeach()
if(checked LESS 10)
    message(FATAL_ERROR "only ${checked} compilations in ${COMMANDS}")
endif()
