/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files of the page, in the program itself: cmake/embed.cmake writes the table at build time.
   Private to the room. */
#ifndef FW_SERVE_SERVE_PAGE_H
#define FW_SERVE_SERVE_PAGE_H
#include <stddef.h>

typedef struct fw_serve_page_file {
    const char *path; /* "/page.js"; "/" is index.html */
    const char *type; /* of its content, for HTTP */
    const char *etag; /* with its quotes: of all bytes */
    const unsigned char *data;
    size_t n;
} fw_serve_page_file;
extern const fw_serve_page_file fw_serve_page_files[];
extern const size_t fw_serve_page_count;

#endif
