# SPDX-License-Identifier: GPL-3.0-or-later
# Manual pages and completions, written from the program's tables when it is built, and what editors read.
add_executable(manuals EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/tools/manuals/manuals.c)
target_link_libraries(manuals PRIVATE fw_cli)
set(FW_MANUALS ${PROJECT_BINARY_DIR}/manual)
add_custom_command(OUTPUT ${FW_MANUALS}/flexwright.1
                   COMMAND ${CMAKE_COMMAND} -E remove_directory ${FW_MANUALS}/written
                   COMMAND ${CMAKE_COMMAND} -E make_directory ${FW_MANUALS}/written
                   COMMAND manuals ${FW_MANUALS}/written
                   COMMAND ${CMAKE_COMMAND} -E copy ${FW_MANUALS}/written/flexwright.1 ${FW_MANUALS}/flexwright.1
                   DEPENDS manuals VERBATIM)
add_custom_target(manual_pages ALL DEPENDS ${FW_MANUALS}/flexwright.1)
install(DIRECTORY ${FW_MANUALS}/written/ DESTINATION share/man/man1 FILES_MATCHING PATTERN "*.1")
install(FILES ${FW_MANUALS}/written/flexwright.bash DESTINATION share/bash-completion/completions RENAME flexwright)
install(FILES ${FW_MANUALS}/written/_flexwright DESTINATION share/zsh/vendor-completions)
install(FILES ${FW_MANUALS}/written/flexwright.fish DESTINATION share/fish/vendor_completions.d)
