# SPDX-License-Identifier: GPL-3.0-or-later
# One static library per room. The order is the order of the floors: a room may use the rooms named
# before it and no other. tests/arch checks the same list against every #include.
find_package(PkgConfig REQUIRED)
pkg_check_modules(XML2 REQUIRED IMPORTED_TARGET libxml-2.0)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(GSL REQUIRED IMPORTED_TARGET gsl)
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson)
pkg_check_modules(ZLIB REQUIRED IMPORTED_TARGET zlib)
pkg_check_modules(MICROHTTPD REQUIRED IMPORTED_TARGET libmicrohttpd)
pkg_check_modules(ZIP REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(SQLITE REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(NLOPT REQUIRED IMPORTED_TARGET nlopt)
find_package(Threads REQUIRED)
find_library(LAPACKE_LIBRARY lapacke REQUIRED)
find_library(LAPACK_LIBRARY lapack REQUIRED)

set(FW_ROOMS base maths geometry drawing quantity chance xml device flexure layout release wiring mechanism effects multibody assembly
             dynamics statics workspace clearance probe
             verdict continuum process measuring schedule mask wafer recipe report plan study serve cli)
set(FW_EXTERN_maths PkgConfig::GSL ${LAPACKE_LIBRARY} ${LAPACK_LIBRARY} m)
set(FW_EXTERN_xml PkgConfig::XML2)
set(FW_EXTERN_mask PkgConfig::ZLIB)
set(FW_EXTERN_report PkgConfig::CAIRO)
set(FW_EXTERN_study PkgConfig::SQLITE PkgConfig::NLOPT Threads::Threads)
set(FW_EXTERN_serve PkgConfig::MICROHTTPD PkgConfig::ZIP)
set(FW_EXTERN_base PkgConfig::JANSSON m)

# The rooms without some effects: their files are not compiled and they have no row. A scene's elements of
# such an effect are then not looked at, so that such a build is good for counting only (target
# effect_cost; docs/theory/effects/costs.md).
set(FW_WITHOUT_EFFECTS "" CACHE STRING "ids of effects to build without, for measurements only")
set(effects_gone)
set(effects_without)
foreach(id ${FW_WITHOUT_EFFECTS})
    string(REPLACE "-" "_" name ${id})
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/src/effects/${name}.c)
        message(FATAL_ERROR "FW_WITHOUT_EFFECTS: there is no effect ${id}")
    endif()
    list(APPEND effects_gone "/effects/${name}\\.c$")
    list(APPEND effects_without FW_WITHOUT_${name}=1)
endforeach()
set_source_files_properties(${PROJECT_SOURCE_DIR}/src/effects/table.c PROPERTIES COMPILE_DEFINITIONS
                            "${effects_without}")

# Under the sanitizers these take longer to optimise than it saves where they run
set(FW_ROOMS_PLAIN cli continuum layout mask measuring mechanism plan probe process recipe release report serve study verdict wafer wiring)
# And this one, whose sizes with derivatives are structures that are handed on by value: each copy that -O1 leaves is looked at, byte
# by byte, which took three fifths of the longest test
set(FW_ROOMS_BY_VALUE workspace)
if(FW_SANITIZE) # all but this one, of which a test asks for a million Jacobians
    set_source_files_properties(${PROJECT_SOURCE_DIR}/src/continuum/mesh.c PROPERTIES COMPILE_OPTIONS -O1)
endif()

# Rooms that cast a pointer by way of void, where no warning looks at its alignment (tests/arch/rooms.py knows no others)
set(FW_ROOMS_CAST base device flexure maths plan serve)

# What tests/edges/edges.py counts: what a program passes. edge: of the control flow; func: starts of functions
set(FW_EDGES "" CACHE STRING "counters of coverage (clang): edge or func")
set(FW_ROOMS_FUZZED base quantity xml device)
# Rooms that read what strangers wrote: under the sanitizers every pointer is looked at (flags.cmake)
set(FW_ROOMS_READ ${FW_ROOMS_FUZZED} drawing serve)
# A build that fuzzes for hours (FUZZ_LONG of tests/build/fuzz.sh): every reader's room guides the fuzzer and is optimised
option(FW_FUZZ_LONG "rooms of all readers carry the fuzzer's counters, and are optimised" OFF)
if(FW_FUZZ_LONG)
    set(FW_ROOMS_FUZZED base quantity xml device drawing process mask recipe study serve)
    set(FW_ROOMS_READ ${FW_ROOMS_FUZZED})
    set(FW_ROOMS_PLAIN)
endif()

set(below)
foreach(room ${FW_ROOMS})
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${room}/*.c)
    foreach(gone "/cli/main\\.c$" ${effects_gone})
        list(FILTER sources EXCLUDE REGEX ${gone})
    endforeach()
    if(sources)
        add_library(fw_${room} STATIC ${sources})
        target_link_libraries(fw_${room} PUBLIC ${below} ${FW_EXTERN_${room}})
        fw_together(fw_${room} ${sources})
        if(room STREQUAL effects) # a row that no table names can be left out though its file has what others call (tests/bench)
            target_compile_options(fw_${room} PRIVATE -fdata-sections)
        endif()
        if(FW_SANITIZE AND room IN_LIST FW_ROOMS_PLAIN)
            target_compile_options(fw_${room} PRIVATE -O0)
        endif()
        if(FW_SANITIZE AND room IN_LIST FW_ROOMS_BY_VALUE)
            target_compile_options(fw_${room} PRIVATE -O2)
        endif()
        if(FW_SANITIZE AND room IN_LIST FW_ROOMS_CAST)
            target_compile_options(fw_${room} PRIVATE -fsanitize=alignment)
        endif()
        if(FW_SANITIZE AND room IN_LIST FW_ROOMS_READ)
            target_compile_options(fw_${room} PRIVATE -fsanitize=null,pointer-overflow)
        endif()
        # in the rooms of tests/fuzz the fuzzer counts edges
        if(FW_EDGES AND NOT (FW_FUZZ AND room IN_LIST FW_ROOMS_FUZZED))
            target_compile_options(fw_${room} PRIVATE -fsanitize-coverage=${FW_EDGES},inline-8bit-counters,pc-table)
        endif()
        list(PREPEND below fw_${room})
    endif()
endforeach()

# The kernel of the right-hand side once more for lanes of designs, chosen at run time. These may contract
# products and sums; the kernel of one design, which the room has compiled above, may not.
set(kernel_level -O3)
if(CMAKE_C_FLAGS MATCHES "-fsanitize=") # tests/build/threads.sh: nothing of its own in what is unrolled
    set(kernel_level -O0)
endif()
if(FW_SANITIZE)
    # unrolled lines with a check at each take clang nine minutes; AddressSanitizer sees where a wrong pointer goes
    set(kernel_level -O0)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/src/multibody/kernel_blocks.c PROPERTIES
                                COMPILE_OPTIONS "-fno-sanitize=pointer-overflow;-O0")
endif()
function(fw_kernel_lanes name width)
    add_library(fw_kernel_${name} OBJECT ${PROJECT_SOURCE_DIR}/src/multibody/kernel_blocks.c)
    target_compile_definitions(fw_kernel_${name} PRIVATE FW_W=${width} FW_BRIEF=1 FW_CORE=fw_multibody_core_${name}
                                                         FW_CORE_NAME="${name}")
    # its arrays of doubles are aligned for lanes where they are taken from the arena
    target_compile_options(fw_kernel_${name} PRIVATE ${kernel_level} -mfma -ffp-contract=fast -Wno-cast-align ${ARGN})
    target_sources(fw_multibody PRIVATE $<TARGET_OBJECTS:fw_kernel_${name}>)
endfunction()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    fw_kernel_lanes(avx2 4 -mavx2)
    fw_kernel_lanes(avx512 8 -mavx512f -mavx512dq -mavx512vl)
endif()

# The law of flexures under forces for hinges side by side, which are to have the bits of one alone: not contracted
if(CMAKE_C_COMPILER_ID STREQUAL "GNU") # what waits for one another apart: 12 % of one hinge and of four
    set_source_files_properties(${PROJECT_SOURCE_DIR}/src/flexure/finite_lanes.c PROPERTIES
                                COMPILE_OPTIONS "-fschedule-insns;-fsched-pressure")
endif()
function(fw_hinge_lanes width)
    add_library(fw_hinge_lanes_${width} OBJECT ${PROJECT_SOURCE_DIR}/src/flexure/finite_lanes.c)
    target_compile_definitions(fw_hinge_lanes_${width} PRIVATE FW_W=${width})
    target_compile_options(fw_hinge_lanes_${width} PRIVATE ${ARGN})
    target_sources(fw_flexure PRIVATE $<TARGET_OBJECTS:fw_hinge_lanes_${width}>)
endfunction()
fw_hinge_lanes(2)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    fw_hinge_lanes(4 -mavx2)
    fw_hinge_lanes(8 -mavx512f -mavx512dq)
endif()
