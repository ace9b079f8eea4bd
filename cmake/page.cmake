# SPDX-License-Identifier: GPL-3.0-or-later
# The page (web/) is bundled at build time: npm ci once for each lock file, then esbuild, which takes
# a tenth of a second. FW_PAGE AUTO: where npm is there and can fetch the libraries, else the plain
# page stands in (cmake/serve.cmake); ON: it is an error if it cannot be made; OFF: the plain page.
set(FW_PAGE AUTO CACHE STRING "bundle the page with npm: AUTO, ON or OFF")
set_property(CACHE FW_PAGE PROPERTY STRINGS AUTO ON OFF)
set(page_build ${PROJECT_BINARY_DIR}/web)

# The libraries, in the build directory, as the lock file has them; they stay until it changes. No
# script of a package runs.
function(fw_page_libraries done)
    set(${done} FALSE PARENT_SCOPE)
    file(SHA256 ${PROJECT_SOURCE_DIR}/web/package-lock.json lock)
    if(EXISTS ${page_build}/libraries.txt)
        file(READ ${page_build}/libraries.txt present)
        if(present STREQUAL lock)
            set(${done} TRUE PARENT_SCOPE)
            return()
        endif()
    endif()
    message(STATUS "fetching the libraries of the page")
    file(COPY ${PROJECT_SOURCE_DIR}/web/package.json ${PROJECT_SOURCE_DIR}/web/package-lock.json
         DESTINATION ${page_build})
    execute_process(
        COMMAND ${FW_NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
        WORKING_DIRECTORY ${page_build} RESULT_VARIABLE status ERROR_VARIABLE why OUTPUT_QUIET
        TIMEOUT 300)
    if(status EQUAL 0)
        file(WRITE ${page_build}/libraries.txt ${lock})
        set(${done} TRUE PARENT_SCOPE)
    elseif(FW_PAGE STREQUAL "ON")
        message(FATAL_ERROR "the libraries of the page could not be fetched: ${why}")
    else()
        message(WARNING "the libraries of the page could not be fetched; the plain page stands in: ${why}")
    endif()
endfunction()

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/package-lock.json)
if(NOT FW_PAGE STREQUAL "OFF")
    find_program(FW_NPM npm)
    find_program(FW_NODE NAMES node nodejs)
    set(libraries FALSE)
    if(FW_NPM AND FW_NODE)
        fw_page_libraries(libraries)
    elseif(FW_PAGE STREQUAL "ON")
        message(FATAL_ERROR "FW_PAGE=ON needs npm and node")
    endif()
    if(libraries)
        file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/src/*
             ${PROJECT_SOURCE_DIR}/web/style/*)
        file(GLOB page_gallery CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/gallery/*/device.xml
             ${PROJECT_SOURCE_DIR}/docs/gallery/*/device.svg)
        file(GLOB page_help CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*/README.md
             ${PROJECT_SOURCE_DIR}/docs/reference/*.md)
        list(APPEND page_sources ${page_gallery} ${page_help} ${PROJECT_SOURCE_DIR}/web/build.mjs ${PROJECT_SOURCE_DIR}/web/help.mjs ${PROJECT_SOURCE_DIR}/web/index.html
             ${PROJECT_SOURCE_DIR}/web/favicon.svg ${PROJECT_SOURCE_DIR}/web/package-lock.json)
        set(FW_PAGE_DIR ${page_build}/dist)
        set(FW_PAGE_DEPENDS ${FW_PAGE_DIR}/page.js)
        add_custom_command(
            OUTPUT ${FW_PAGE_DIR}/page.js
            COMMAND ${FW_NODE} ${PROJECT_SOURCE_DIR}/web/build.mjs ${page_build}
            DEPENDS ${page_sources} VERBATIM COMMENT "Bundling the page")
    else()
        message(STATUS "the page is not bundled (no npm, or no libraries): the plain one stands in")
    endif()
endif()
