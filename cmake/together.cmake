# SPDX-License-Identifier: GPL-3.0-or-later
# FW_TOGETHER: files that name nothing alike are compiled as one, of each room and of its tests. For the trees that tests/build/ makes:
# a third less to compile under the sanitizers. tools/together.py says which; what one file names at its level may be a local name
# of another, which -Wshadow would refuse and is looked at where each file is compiled by itself.
option(FW_TOGETHER "compile several files of a room as one" OFF)
set(FW_TOGETHER_SIZE 8)

# rows "FILE GROUP" of the files named behind `out`
function(fw_together_groups out)
    find_package(Python3 REQUIRED COMPONENTS Interpreter)
    set(script ${PROJECT_SOURCE_DIR}/tools/together.py)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${script} ${ARGN})
    execute_process(COMMAND ${Python3_EXECUTABLE} ${script} ${FW_TOGETHER_SIZE} ${ARGN} OUTPUT_VARIABLE rows
                    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE "\n" ";" rows "${rows}")
    set(${out} "${rows}" PARENT_SCOPE)
endfunction()

function(fw_together target)
    if(NOT FW_TOGETHER)
        return()
    endif()
    fw_together_groups(rows ${ARGN})
    foreach(row ${rows})
        if(row MATCHES "^(.*) ([0-9]+)$")
            set_source_files_properties(${CMAKE_MATCH_1} PROPERTIES UNITY_GROUP ${target}_${CMAKE_MATCH_2})
        endif()
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    target_compile_options(${target} PRIVATE -Wno-shadow)
endfunction()

# Tests have a main each, test_NAME_main in the program of a room: files that give it its name and include them, in `out`; `header`
# declares the mains.
function(fw_tests_together out room header)
    fw_together_groups(rows ${ARGN})
    set(sources)
    foreach(row ${rows})
        if(row MATCHES "^(.*) ([0-9]+)$")
            set(file ${CMAKE_CURRENT_BINARY_DIR}/together_${room}_${CMAKE_MATCH_2}.c)
            get_filename_component(name ${CMAKE_MATCH_1} NAME_WE)
            if(NOT file IN_LIST sources)
                list(APPEND sources ${file})
                set(text_${CMAKE_MATCH_2} "")
            endif()
            string(APPEND text_${CMAKE_MATCH_2} "#define main ${name}_main\n#include \"${CMAKE_MATCH_1}\"\n#undef main\n")
            set(content_${file} "${text_${CMAKE_MATCH_2}}")
        endif()
    endforeach()
    foreach(file ${sources})
        file(CONFIGURE OUTPUT ${file} CONTENT "#include \"${header}\"\n${content_${file}}" @ONLY)
    endforeach()
    set(${out} ${sources} PARENT_SCOPE)
endfunction()
