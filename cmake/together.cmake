# SPDX-License-Identifier: GPL-3.0-or-later
# FW_TOGETHER: files that name nothing alike are compiled as one, of each room and of its tests. For the trees that tests/build/ makes:
# a third less to compile under the sanitizers. tools/together.py says which; what one file names at its level may be a local name
# of another, which -Wshadow would refuse and is looked at where each file is compiled by itself.
option(FW_TOGETHER "compile several files of a room as one" OFF)
set(FW_TOGETHER_SIZE 8)
# FW_TOGETHER_FILE: the number of a file's group among those of its folder. All files are asked for at once: they include the same headers,
# and to start an interpreter for each target took a minute.
if(FW_TOGETHER)
    find_package(Python3 REQUIRED COMPONENTS Interpreter)
    set(script ${PROJECT_SOURCE_DIR}/tools/together.py)
    file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/*/*.c ${PROJECT_SOURCE_DIR}/tests/unit/*/test_*.c)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${script} ${files})
    execute_process(COMMAND ${Python3_EXECUTABLE} ${script} ${FW_TOGETHER_SIZE} ${files} OUTPUT_VARIABLE rows
                    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE "\n" ";" rows "${rows}")
    foreach(row ${rows})
        if(row MATCHES "^(.*) ([0-9]+)$")
            set(FW_TOGETHER_${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
        endif()
    endforeach()
endif()

function(fw_together target)
    if(NOT FW_TOGETHER)
        return()
    endif()
    foreach(source ${ARGN})
        if(DEFINED FW_TOGETHER_${source})
            set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${target}_${FW_TOGETHER_${source}})
        endif()
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    target_compile_options(${target} PRIVATE -Wno-shadow)
endfunction()

# Tests have a main each, test_NAME_main in the program of a room: files that give it its name and include them, in `out`; `header`
# declares the mains.
function(fw_tests_together out room header)
    set(sources)
    foreach(source ${ARGN})
        set(group ${FW_TOGETHER_${source}})
        set(file ${CMAKE_CURRENT_BINARY_DIR}/together_${room}_${group}.c)
        get_filename_component(name ${source} NAME_WE)
        list(APPEND sources ${file})
        string(APPEND text_${group} "#define main ${name}_main\n#include \"${source}\"\n#undef main\n")
    endforeach()
    list(REMOVE_DUPLICATES sources)
    foreach(file ${sources})
        string(REGEX REPLACE ".*_([0-9]+)\\.c$" "\\1" group ${file})
        file(CONFIGURE OUTPUT ${file} CONTENT "#include \"${header}\"\n${text_${group}}" @ONLY)
    endforeach()
    set(${out} ${sources} PARENT_SCOPE)
endfunction()
