# SPDX-License-Identifier: GPL-3.0-or-later
# The server against clients that mean harm; the same program with one defence built out, which the same
# test must notice; and load, signals, kill -9, jobs, archive, watching and saving.
set(FW_DEFENCES HOST ORIGIN FETCH_SITE ONE_TIME COOKIE HEADER_TOKEN CONTENT_TYPE BODY HEAD REAPER)
foreach(defence ${FW_DEFENCES})
    add_executable(flexwright_without_${defence} EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/src/cli/main.c
                   ${PROJECT_SOURCE_DIR}/src/serve/serve_guard.c ${PROJECT_SOURCE_DIR}/src/serve/server.c)
    target_compile_definitions(flexwright_without_${defence} PRIVATE FW_SERVE_WITHOUT=FW_DEFENCE_${defence})
    target_link_libraries(flexwright_without_${defence} PRIVATE fw_cli)
    set_target_properties(flexwright_without_${defence} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
endforeach()
fw_script_test(serve.hostile COMMAND ${Python3_EXECUTABLE} tests/serve/hostile.py ${FW_PROGRAM})
fw_script_test(serve.doors COMMAND ${Python3_EXECUTABLE} tests/serve/doors.py ${FW_PROGRAM})
fw_script_test(serve.robust COMMAND ${Python3_EXECUTABLE} tests/serve/robust.py ${FW_PROGRAM})
fw_script_test(serve.talk COMMAND ${Python3_EXECUTABLE} tests/serve/talk.py ${FW_PROGRAM})
fw_script_test(serve.mutants COMMAND ${Python3_EXECUTABLE} tests/serve/mutants.py ${PROJECT_BINARY_DIR} ${FW_DEFENCES})
