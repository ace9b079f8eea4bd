/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be asked for: one row each. docs/reference/serve.md says what goes in and out. */
#include "serve/serve_page.h"
#include "serve/server.h"
#include <string.h>

static const fw_serve_route table[] = {
    {.method = "GET", .path = "/api/session", .handle = fw_serve_route_session},
    {.method = "GET", .path = "/api/table", .handle = fw_serve_route_table},
    {.method = "GET", .path = "/api/file", .handle = fw_serve_route_file},
    {.method = "POST", .path = "/api/file", .handle = fw_serve_route_save},
    {.method = "GET", .path = "/api/events", .handle = fw_serve_route_events},
    {.method = "POST", .path = "/api/preview", .handle = fw_serve_route_preview},
    {.method = "POST", .path = "/api/pose", .handle = fw_serve_route_pose},
    {.method = "POST", .path = "/api/edit", .handle = fw_serve_route_edit},
    {.method = "POST", .path = "/api/jobs", .handle = fw_serve_route_job_new},
    {.method = "GET", .path = "/api/jobs/*", .handle = fw_serve_route_job},
    {.method = "DELETE", .path = "/api/jobs/*", .handle = fw_serve_route_job_delete},
};

/* the files of the page have one row for all: their table is made at build time */
static const fw_serve_route page = {.method = "GET", .path = "/", .handle = fw_serve_route_page};

static bool fits(const char *row, const char *path) {
    size_t n = strlen(row);
    return row[n - 1] == '*' ? strncmp(row, path, n - 1) == 0 && path[n - 1]
                             : strcmp(row, path) == 0;
}

const fw_serve_route *fw_serve_route_find(const char *method, const char *path, bool *known_path) {
    *known_path = false;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        if (!fits(table[i].path, path)) continue;
        *known_path = true;
        if (strcmp(table[i].method, method) == 0) return &table[i];
    }
    for (size_t i = 0; i < fw_serve_page_count; i++)
        if (strcmp(fw_serve_page_files[i].path, path) == 0) {
            *known_path = true;
            return strcmp(method, page.method) == 0 ? &page : NULL;
        }
    return NULL;
}
