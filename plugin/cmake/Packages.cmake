# SPDX-License-Identifier: Apache-2.0
# Debian packages, one for each component of the installation: `cpack -G DEB` in the build folder of the preset `debian`.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tautline)
set(CPACK_PACKAGE_VENDOR "Tautline")
set(CPACK_PACKAGE_CONTACT "Tautline developers <tautline@localhost>")
set(CPACK_PACKAGE_HOMEPAGE_URL "")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/wrapping_core"
    "${PROJECT_BINARY_DIR}/simbody_adapter" "${PROJECT_BINARY_DIR}/models")
set(CPACK_COMPONENTS_ALL libtautline0 libtautline-dev tautline tautline-plugin python3-tautline)

# debian_package(<component> SECTION <section> SUMMARY <line> DESCRIPTION <text> [DEPENDS <packages>]): the copyright and
# the changes come with each.
function(debian_package component)
    cmake_parse_arguments(ARG "" "SECTION;SUMMARY;DESCRIPTION;DEPENDS" "" ${ARGN})
    string(TOUPPER "${component}" key)
    foreach(pair "PACKAGE_NAME;${component}" "PACKAGE_SECTION;${ARG_SECTION}" "PACKAGE_DEPENDS;${ARG_DEPENDS}"
            "PACKAGE_SHLIBDEPS;ON" "DESCRIPTION;${ARG_SUMMARY}\n${ARG_DESCRIPTION}")
        list(POP_FRONT pair name)
        set(CPACK_DEBIAN_${key}_${name} "${pair}" PARENT_SCOPE)
    endforeach()
    set(folder "${CMAKE_INSTALL_DATADIR}/doc/${component}")
    install(FILES "${PROJECT_BINARY_DIR}/packages/copyright" DESTINATION "${folder}" COMPONENT ${component})
    install(FILES "${PROJECT_BINARY_DIR}/packages/changelog.gz" DESTINATION "${folder}" COMPONENT ${component}
        RENAME changelog.Debian.gz)
endfunction()

file(CONFIGURE OUTPUT packages/copyright @ONLY CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Tautline

Files: *
Copyright: 2025-2026 the Tautline developers
License: Apache-2.0
 On Debian systems the text of the Apache License, version 2.0, is in
 /usr/share/common-licenses/Apache-2.0.
")
file(CONFIGURE OUTPUT packages/changelog @ONLY CONTENT
"tautline (@PROJECT_VERSION@-1) unstable; urgency=medium

  * See CHANGELOG.md of the sources.

 -- Tautline developers <tautline@localhost>  Thu, 01 Jan 2026 00:00:00 +0000
")
execute_process(COMMAND gzip -9nfk "${PROJECT_BINARY_DIR}/packages/changelog" COMMAND_ERROR_IS_FATAL ANY)

set(about "Tautline finds the shortest path of a taut, frictionless string over an
ordered list of smooth moving surfaces: its length, the rate of that, the
forces that it puts on bodies, and when it touches a surface or lifts off.")
debian_package(libtautline0 SECTION libs SUMMARY "shortest paths of muscles and cables over smooth surfaces"
    DESCRIPTION "${about}
.
This package has the shared libraries.")
set(version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
debian_package(libtautline-dev SECTION libdevel SUMMARY "shortest paths over smooth surfaces - development files"
    DEPENDS "libtautline0 (= ${version}), libeigen3-dev, liblapack-dev, libsimbody-dev, libpugixml-dev"
    DESCRIPTION "${about}
.
This package has the headers and what CMake and pkg-config need.")
debian_package(tautline SECTION science SUMMARY "simulate and solve musculoskeletal models with wrapping muscles"
    DEPENDS "libtautline0 (= ${version})"
    DESCRIPTION "${about}
.
This package has the program, which reads OpenSim models.")
debian_package(tautline-plugin SECTION libs SUMMARY "module that attaches wrapping muscles to Simbody systems"
    DEPENDS "libtautline0 (= ${version})"
    DESCRIPTION "${about}
.
This package has the module that Simbody programs load.")
debian_package(python3-tautline SECTION python SUMMARY "shortest paths over smooth surfaces - Python module"
    DEPENDS "libtautline0 (= ${version}), python3, python3-numpy"
    DESCRIPTION "${about}
.
This package has the module for Python.")
# The manual pages are the program's own help: tautline(1), and tautline-run(1) and so on of its commands.
# manual_page(<name> <command> <line>)
find_program(help2man help2man)
set(pages "")
function(manual_page name command summary)
    set(page "${PROJECT_BINARY_DIR}/packages/${name}.1")
    string(TOUPPER "${name}" heading)
    add_custom_command(OUTPUT "${page}.gz" DEPENDS tautline VERBATIM
        COMMAND ${help2man} --no-info --no-discard-stderr --version-string "${PROJECT_VERSION}" --name "${summary}"
            --output "${page}" "$<TARGET_FILE:tautline>${command}"
        # help2man heads the page of a command with two words, which man cannot look up.
        COMMAND sed -i -e "s/^tautline${command} /${name} /" -e "s/^[.]TH TAUTLINE /.TH ${heading} /" "${page}"
        COMMAND gzip -9nf "${page}")
    install(FILES "${page}.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT tautline)
    set(pages ${pages} "${page}.gz" PARENT_SCOPE)
endfunction()
if(help2man)
    manual_page(tautline "" "shortest paths of muscles over smooth surfaces")
    manual_page(tautline-run " run" "simulate a model file forward")
    manual_page(tautline-solve " solve" "lengths, contacts and moment arms of a model's paths")
    manual_page(tautline-check " check" "what is in a model file")
    add_custom_target(manual_page ALL DEPENDS ${pages})
endif()
# Compiled files of the Python module come and go with it.
set(CPACK_DEBIAN_PYTHON3-TAUTLINE_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/python3/postinst"
    "${CMAKE_CURRENT_LIST_DIR}/python3/prerm")
include(CPack)
