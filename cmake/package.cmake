# SPDX-License-Identifier: GPL-3.0-or-later
# `cpack` in the build directory makes a package for Debian. Where the installed tree lies it does not care.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME flexwright)
set(CPACK_PACKAGE_VENDOR "Flexwright")
set(CPACK_PACKAGE_CONTACT "Flexwright <flexwright@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "planner for planar compliant micromanipulators")
set(CPACK_PACKAGE_DESCRIPTION "From one description of a planar compliant micromanipulator to a verdict (does any flexure
hinge leave its elastic range?), mask layouts and computed fabrication recipes: program, C library, Python package,
process packs.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "klayout, calculix-ccx")
# ldconfig runs by its trigger; the scripts stand in for those that CPack would add, which run it again and
# cannot in a root of another system
set(control ${PROJECT_BINARY_DIR}/debian)
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
file(WRITE ${control}/postinst "#!/bin/sh\nset -e\n# ldconfig is run by its trigger\n")
file(COPY_FILE ${control}/postinst ${control}/postrm)
# what Python compiled where root used the package goes with it
file(WRITE ${control}/prerm "#!/bin/sh\nset -e
rm -rf \"$DPKG_ROOT/usr/lib/python3/dist-packages/flexwright/__pycache__\" \\
    \"$DPKG_ROOT/usr/share/flexwright/klayout/python/flexwright_klayout/__pycache__\"\n")
foreach(script postinst postrm prerm)
    file(CHMOD ${control}/${script} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
         WORLD_READ WORLD_EXECUTE)
endforeach()
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${control}/triggers ${control}/postinst ${control}/postrm ${control}/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
