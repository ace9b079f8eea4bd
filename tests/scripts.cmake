# SPDX-License-Identifier: GPL-3.0-or-later
# Tests that run programs: each is one ctest entry. `quick` are those of ./test --quick.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(FW_PROGRAM $<TARGET_FILE:flexwright>)

function(fw_script_test name)
    cmake_parse_arguments(ARG "" "TIMEOUT;LABEL" "COMMAND" ${ARGN})
    add_test(NAME ${name} COMMAND ${ARG_COMMAND} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    if(NOT ARG_TIMEOUT)
        set(ARG_TIMEOUT 300)
    endif()
    if(NOT ARG_LABEL)
        set(ARG_LABEL full)
    endif()
    set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS ${ARG_LABEL})
endfunction()

fw_script_test(arch.rooms LABEL quick COMMAND ${Python3_EXECUTABLE} tests/arch/rooms.py)
fw_script_test(library.symbols LABEL quick COMMAND ${Python3_EXECUTABLE} tests/build/symbols.py
               $<TARGET_FILE:flexwright_library>)
fw_script_test(cli.program COMMAND ${Python3_EXECUTABLE} tests/cli/test_program.py ${FW_PROGRAM})
fw_script_test(cli.benchmarks COMMAND ${Python3_EXECUTABLE} tests/cli/test_benchmarks.py ${FW_PROGRAM})
fw_script_test(cli.reproducible COMMAND ${Python3_EXECUTABLE} tests/cli/test_reproducible.py ${FW_PROGRAM})
fw_script_test(fault.files COMMAND ${Python3_EXECUTABLE} tests/fault/test_faults.py ${FW_PROGRAM})
fw_script_test(accept.masks COMMAND tests/accept/gallery.sh ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(docs.readme COMMAND ${Python3_EXECUTABLE} tests/docs/readme.py ${FW_PROGRAM})
fw_script_test(build.clang COMMAND tests/build/clang.sh TIMEOUT 600)
fw_script_test(build.sanitized COMMAND tests/build/sanitized.sh TIMEOUT 900)
fw_script_test(fuzz.device COMMAND tests/build/fuzz.sh TIMEOUT 600)
set_tests_properties(build.clang build.sanitized fuzz.device PROPERTIES RUN_SERIAL ON)

add_executable(fault_memory fault/memory.c)
target_link_libraries(fault_memory PRIVATE fw_plan)
fw_script_test(fault.memory COMMAND fault_memory docs/gallery/reference-six-bar/device.xml TIMEOUT 600)
fw_script_test(golden.gallery COMMAND tests/golden/gallery.sh ${FW_PROGRAM})
set_tests_properties(accept.masks PROPERTIES SKIP_RETURN_CODE 77)
if(NOT FW_SANITIZE) # a sanitized library wants a sanitized user
    fw_script_test(library.consumer COMMAND tests/consumer/run.sh ${PROJECT_BINARY_DIR} ${FW_PROGRAM})
endif()
