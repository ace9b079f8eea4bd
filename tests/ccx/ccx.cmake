# SPDX-License-Identifier: GPL-3.0-or-later
# CalculiX' answers to the decks of the tests of solids are kept in tests/data/ccx (README.md there): a program ccx that gives
# them stands first in PATH of those tests; whole.NAME, of ./test --all, asks CalculiX itself.
find_program(FW_CCX ccx)
if(FW_CCX)
    set(FW_CCX_KEPT ${PROJECT_BINARY_DIR}/tests/ccx)
    file(CONFIGURE OUTPUT ${FW_CCX_KEPT}/ccx @ONLY CONTENT
         "#!/bin/sh\nexec \"${Python3_EXECUTABLE}\" \"${CMAKE_CURRENT_SOURCE_DIR}/ccx/kept.py\" \"${FW_CCX}\" \"${CMAKE_CURRENT_SOURCE_DIR}/data/ccx\" \"\" \"$@\"\n")
    file(CHMOD ${FW_CCX_KEPT}/ccx PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
    foreach(name test_continuum test_solid)
        if(TEST unit.continuum.${name})
            set_property(TEST unit.continuum.${name} PROPERTY ENVIRONMENT_MODIFICATION PATH=path_list_prepend:${FW_CCX_KEPT})
            set_property(TEST unit.continuum.${name} APPEND PROPERTY LABELS part)
            add_test(NAME whole.continuum.${name} COMMAND unit_continuum ${name})
            set_tests_properties(whole.continuum.${name} PROPERTIES LABELS long TIMEOUT 600)
        endif()
    endforeach()
    set_property(TEST cli.hinge cli.sizing PROPERTY ENVIRONMENT FW_CCX=${FW_CCX_KEPT}) # which ./test --all does not take
endif()
