# SPDX-License-Identifier: GPL-3.0-or-later
# The Python package beside the library: PREFIX/lib/python3/dist-packages, where Debian's python3 looks for
# prefix /usr; in /usr/local it looks into a directory with its version. It finds the library by its own place.
install(CODE "
    set(directory lib/python3/dist-packages)
    if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr/local\")
        file(GLOB versioned LIST_DIRECTORIES true /usr/local/lib/python3.*/dist-packages)
        list(LENGTH versioned n)
        if(n EQUAL 1)
            file(RELATIVE_PATH directory /usr/local \"\${versioned}\")
        endif()
    endif()
    file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/\${directory}\" TYPE DIRECTORY
         FILES \"${PROJECT_SOURCE_DIR}/python/flexwright\" PATTERN __pycache__ EXCLUDE PATTERN _native EXCLUDE)
")
