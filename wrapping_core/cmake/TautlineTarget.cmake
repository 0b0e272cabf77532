# SPDX-License-Identifier: Apache-2.0
# What all targets of this project share: C++17, warnings, sanitizers on demand, installation.
include(GNUInstallDirs)

if(PROJECT_IS_TOP_LEVEL)  # else these are the business of the project that we are part of
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
    endif()
    set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
    if(BUILD_SHARED_LIBS AND NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")  # where the loader does not look by itself
        set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR};$ORIGIN")
    endif()
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

set(TAUTLINE_EXPORTS "${CMAKE_CURRENT_LIST_DIR}/exports.map")
# From lib/pkgconfig up to the prefix, besides two steps.
string(REGEX REPLACE "[^/]+" ".." to_prefix "/${CMAKE_INSTALL_LIBDIR}")
string(REGEX REPLACE "^/\\.\\." "" to_prefix "${to_prefix}")

# tautline_pkg_config(<name> DESCRIPTION <text> [REQUIRES <packages>] [CFLAGS <flags>] [LIBS <flags>]): <name>.pc, for
# those who build without CMake.
function(tautline_pkg_config name)
    cmake_parse_arguments(ARG "" "DESCRIPTION" "REQUIRES;CFLAGS;LIBS" ${ARGN})
    list(JOIN ARG_REQUIRES " " requires)
    list(JOIN ARG_CFLAGS " " cflags)
    list(JOIN ARG_LIBS " " libs)
    file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${name}.pc" @ONLY CONTENT [[
prefix=${pcfiledir}/../..@to_prefix@
libdir=${prefix}/@CMAKE_INSTALL_LIBDIR@
includedir=${prefix}/@CMAKE_INSTALL_INCLUDEDIR@

Name: @name@
Description: @ARG_DESCRIPTION@
Version: @PROJECT_VERSION@
Requires: @requires@
Cflags: -I${includedir} @cflags@
Libs: -L${libdir} @libs@
]])
    install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
        COMPONENT libtautline-dev)
endfunction()

# tautline_install(<target> <name>): the library, the headers beside it, and its part of the package, in which it is
# called Tautline::<name>. The components are the Debian packages that the files go to.
function(tautline_install target name)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
        SOVERSION ${PROJECT_VERSION_MAJOR} DEFINE_SYMBOL "")
    get_target_property(type ${target} TYPE)
    if(type STREQUAL SHARED_LIBRARY)  # shows its own names and nothing of the libraries that it has used
        target_link_options(${target} PRIVATE "LINKER:--version-script=${TAUTLINE_EXPORTS}")
        set_target_properties(${target} PROPERTIES LINK_DEPENDS "${TAUTLINE_EXPORTS}")
    endif()
    if(NOT TAUTLINE_INSTALL)
        return()
    endif()
    install(TARGETS ${target} EXPORT Tautline_${name}
        LIBRARY COMPONENT libtautline0 NAMELINK_COMPONENT libtautline-dev
        ARCHIVE COMPONENT libtautline-dev)
    install(DIRECTORY include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT libtautline-dev)
    install(EXPORT Tautline_${name} NAMESPACE Tautline:: DESTINATION "${TAUTLINE_PACKAGE_FOLDER}"
        COMPONENT libtautline-dev)
endfunction()
