# SPDX-License-Identifier: Apache-2.0
# What all targets of this project share: C++17, warnings, sanitizers on demand, installation.
include(GNUInstallDirs)

if(PROJECT_IS_TOP_LEVEL)  # else these are the business of the project that we are part of
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
    endif()
    set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
endif()

# Optimization is CMake's own for the build type, -O3 in Release: a warm step is a tenth slower at -O2. What a user sets
# in CMAKE_CXX_FLAGS_RELEASE or CMAKE_CXX_FLAGS holds for every file.
string(STRIP "${CMAKE_CXX_FLAGS_RELEASE_INIT}" TAUTLINE_DEFAULT_RELEASE_FLAGS)

# tautline_optimize_lightly(<target>): for targets that take longer to compile than to run.
function(tautline_optimize_lightly target)
    if(CMAKE_CXX_FLAGS_RELEASE STREQUAL TAUTLINE_DEFAULT_RELEASE_FLAGS)
        target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
endfunction()

# tautline_target(<target>): call once for every library and program of ours.
function(tautline_target target)
    target_compile_features(${target} PUBLIC cxx_std_17)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                             $<$<BOOL:${TAUTLINE_WERROR}>:-Werror>)
    # A parent project that has chosen nothing gets a library that is fit for use.
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT CMAKE_CXX_FLAGS MATCHES "-O")
        target_compile_options(${target} PRIVATE -O3 -DNDEBUG)
    endif()
    if(TAUTLINE_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=${TAUTLINE_SANITIZE} -fno-omit-frame-pointer
                                                 -fno-sanitize-recover=all)
        target_link_options(${target} PUBLIC -fsanitize=${TAUTLINE_SANITIZE})
    endif()
endfunction()

set(TAUTLINE_PACKAGE_FOLDER "${CMAKE_INSTALL_LIBDIR}/cmake/Tautline")

# tautline_install(<target> <name>): the library, the headers beside it, and its part of the package, in which it is
# called Tautline::<name>.
function(tautline_install target name)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    if(NOT TAUTLINE_INSTALL)
        return()
    endif()
    install(TARGETS ${target} EXPORT Tautline_${name})
    install(DIRECTORY include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(EXPORT Tautline_${name} NAMESPACE Tautline:: DESTINATION "${TAUTLINE_PACKAGE_FOLDER}")
endfunction()
