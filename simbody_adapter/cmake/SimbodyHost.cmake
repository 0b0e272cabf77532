# SPDX-License-Identifier: Apache-2.0
# Tautline::simbody_host: Simbody as all code here must see it. Link this and not ${Simbody_LIBRARIES}.
#
# SimTK::CacheEntryInfo, which lies in every State and is handled by inline functions, has members that exist
# only without NDEBUG. Code compiled otherwise than the Simbody library (Debian's is built without NDEBUG, our
# Release with it) corrupts States silently. The library tells how it was built by a symbol.
include(CheckCXXSourceCompiles)
find_package(Simbody REQUIRED)

set(CMAKE_REQUIRED_FLAGS "-UNDEBUG")
set(CMAKE_REQUIRED_INCLUDES "${Simbody_INCLUDE_DIR}")
set(CMAKE_REQUIRED_LIBRARIES "${Simbody_LIBRARIES}")
check_cxx_source_compiles("
    #include <SimTKcommon.h>
    int main() {
        auto record = &SimTK::CacheEntryInfo::recordPrerequisiteVersions;
        return record == nullptr;
    }" TAUTLINE_SIMBODY_KEEPS_ASSERTS)
# CablePath's successor, with the interface that it was released with.
check_cxx_source_compiles("
    #include <Simbody.h>
    int main() {
        auto length = &SimTK::CableSpan::calcLengthDot;
        auto accuracy = &SimTK::CableSpan::setCurveSegmentAccuracy;
        return length == nullptr || accuracy == nullptr;
    }" TAUTLINE_SIMBODY_HAS_CABLE_SPAN)
unset(CMAKE_REQUIRED_FLAGS)
unset(CMAKE_REQUIRED_INCLUDES)
unset(CMAKE_REQUIRED_LIBRARIES)

# Imported, so that the installed package makes its own by this file: whether NDEBUG holds is asked anew there.
add_library(Tautline::simbody_host INTERFACE IMPORTED GLOBAL)
target_include_directories(Tautline::simbody_host SYSTEM INTERFACE "${Simbody_INCLUDE_DIR}")
target_link_libraries(Tautline::simbody_host INTERFACE ${Simbody_LIBRARIES})
if(TAUTLINE_SIMBODY_KEEPS_ASSERTS)
    # Eigen's checks follow NDEBUG unless told otherwise; ours in the core are compiled without it.
    target_compile_options(Tautline::simbody_host INTERFACE -UNDEBUG)
    target_compile_definitions(Tautline::simbody_host INTERFACE $<$<NOT:$<CONFIG:Debug>>:EIGEN_NO_DEBUG>)
else()
    target_compile_definitions(Tautline::simbody_host INTERFACE NDEBUG)
endif()
