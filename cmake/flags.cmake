# SPDX-License-Identifier: GPL-3.0-or-later
# Warnings are errors for our own code. -ffp-contract=off: the same expression gives the same bits
# with and without FMA units. -fno-math-errno only; -ffast-math miscompiles with Debian 12's gcc
# (docs/decisions/0003-floating-point-flags.md).
add_compile_options(-Wall -Wextra -Wconversion -Wshadow -Wstrict-prototypes -Wvla
                    -Wdouble-promotion -Wmissing-prototypes -Werror
                    -ffp-contract=off -fno-math-errno)
# a cast to what wants a wider alignment is an error here; what casts by way of void is marked in the source
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wcast-align=strict)
else()
    add_compile_options(-Wcast-align)
endif()
add_compile_definitions(_GNU_SOURCE FW_VERSION="${PROJECT_VERSION}")
# in one file alone: what is compiled with it is another file in another directory
set_source_files_properties(${PROJECT_SOURCE_DIR}/src/base/input.c PROPERTIES COMPILE_DEFINITIONS
                            "FW_SOURCE_DATA_DIR=\"${PROJECT_SOURCE_DIR}\";FW_INSTALL_DATA_DIR=\"${CMAKE_INSTALL_PREFIX}/share/flexwright\"")
include_directories(${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include)
# the rooms go into the program and into the shared library, which shows only what FW_API marks
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT FW_REPLACEABLE) # tests/build/mutants.py puts one file of a room in place of another as the program starts
    set(CMAKE_C_VISIBILITY_PRESET hidden)
endif()
if(FW_SANITIZE)
    # -g1: reports show functions and lines, nothing else; it takes a fifth less to compile than -g
    # object-size, an eighth of the time to compile, foretells what AddressSanitizer sees when it happens;
    # alignment, a seventh, is for the rooms that cast by way of void (FW_ROOMS_CAST); others are refused by the warning above
    # null and pointer-overflow, a quarter to compile and a fifth to run, are for the rooms that read what strangers wrote
    # (FW_ROOMS_READ): elsewhere a pointer that goes wrong is seen by AddressSanitizer once it is followed. FW_SANITIZE_ALL: everywhere
    add_compile_options(-fsanitize=address,undefined -fno-sanitize=object-size,alignment -fno-sanitize-recover=all
                        -fno-omit-frame-pointer -g1)
    if(NOT FW_SANITIZE_ALL)
        add_compile_options(-fno-sanitize=null,pointer-overflow)
    endif()
    add_link_options(-fsanitize=address,undefined)
endif()
