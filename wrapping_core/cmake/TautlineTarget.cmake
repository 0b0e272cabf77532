# What all targets of this project share: C++17, warnings, sanitizers on demand, installation.
include(GNUInstallDirs)

if(PROJECT_IS_TOP_LEVEL)  # else these are the business of the project that we are part of
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
    endif()
    # -O3 for all builds a fifth longer; tautline_optimize_fully() is for the sources that a warm step runs through.
    set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
    set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
endif()

# tautline_optimize_lightly(<sources>): for sources that run once, to build fast. They cannot share a precompiled
# header with others.
function(tautline_optimize_lightly)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O1>"
                                                       SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# tautline_optimize_fully(<sources>): for those of a warm step, which is a tenth quicker so: mostly by inlining.
function(tautline_optimize_fully)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>"
                                                       SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# tautline_target(<target>): call once for every library and program of ours.
function(tautline_target target)
    target_compile_features(${target} PUBLIC cxx_std_17)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                             $<$<BOOL:${TAUTLINE_WERROR}>:-Werror>)
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
