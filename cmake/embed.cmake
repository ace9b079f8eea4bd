# SPDX-License-Identifier: GPL-3.0-or-later
# Run at build time: cmake -D FROM=<directory> -D TO=<file.c> -P embed.cmake
# The files below FROM as one table of C (src/serve/server.h): path, type, bytes, and the SHA-256 as the
# strong entity tag. "index.html" is "/". Sorted by path, so that the same files give the same bytes. The assembler
# takes the bytes from the files: as numbers of C they take ten seconds to write and to compile. Where a file
# changes, its hash does, and by that this table.
cmake_minimum_required(VERSION 3.22)
set(type_html "text/html; charset=utf-8")
set(type_js "text/javascript; charset=utf-8")
set(type_css "text/css; charset=utf-8")
set(type_svg "image/svg+xml")
set(type_png "image/png")
set(type_json "application/json")
set(type_txt "text/plain; charset=utf-8")
set(type_woff2 "font/woff2")

file(GLOB_RECURSE files RELATIVE ${FROM} ${FROM}/*)
list(SORT files)
if(NOT "index.html" IN_LIST files)
    message(FATAL_ERROR "${FROM} has no index.html")
endif()
set(bytes "")
set(rows "")
set(count 0)
foreach(file ${files})
    string(REGEX MATCH "[^.]+$" ending ${file})
    if(NOT DEFINED type_${ending})
        continue() # maps of sources and the like are not served
    endif()
    file(SHA256 ${FROM}/${file} hash)
    file(SIZE ${FROM}/${file} size)
    set(path "/${file}")
    if(file STREQUAL "index.html")
        set(path "/")
    endif()
    string(APPEND bytes "BYTES(fw_serve_page_bytes_${count}, \"${FROM}/${file}\")\n")
    string(APPEND rows "    {\"${path}\", \"${type_${ending}}\", \"\\\"${hash}\\\"\", fw_serve_page_bytes_${count}, ${size}},\n")
    math(EXPR count "${count} + 1")
endforeach()
set(macro [[
#define BYTES(name, path)                                                                       \
    extern const unsigned char name[] __attribute__((visibility("hidden")));                    \
    __asm__(".pushsection .rodata\n.globl " #name "\n.hidden " #name "\n" #name ":\n"           \
            ".incbin \"" path "\"\n.byte 0\n.popsection");
]])
file(WRITE ${TO}.new "/* made by cmake/embed.cmake */\n#include \"serve/server.h\"\n${macro}${bytes}const fw_serve_page_file fw_serve_page_files[] = {\n${rows}};\nconst size_t fw_serve_page_count = ${count};\n")
file(COPY_FILE ${TO}.new ${TO} ONLY_IF_DIFFERENT)
file(REMOVE ${TO}.new)
