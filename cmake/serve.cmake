# SPDX-License-Identifier: GPL-3.0-or-later
# The page goes into the program as a table of bytes. FW_PAGE_DIR is the directory of its files and
# FW_PAGE_DEPENDS what makes them anew (files or targets); where nobody builds the page, a plain one
# stands in, so that a build without npm serves too.
if(NOT DEFINED FW_PAGE_DIR)
    set(FW_PAGE_DIR ${PROJECT_SOURCE_DIR}/web/plain)
    file(GLOB FW_PAGE_DEPENDS CONFIGURE_DEPENDS ${FW_PAGE_DIR}/*)
endif()
set(page_table ${PROJECT_BINARY_DIR}/page_table.c)
add_custom_command(OUTPUT ${page_table}
                   COMMAND ${CMAKE_COMMAND} -D FROM=${FW_PAGE_DIR} -D TO=${page_table} -P
                           ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
                   DEPENDS ${FW_PAGE_DEPENDS} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake VERBATIM)
target_sources(fw_serve PRIVATE ${page_table})
