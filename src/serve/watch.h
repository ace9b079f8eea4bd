/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one file that the server shows, watches and saves. Private to the room. */
#ifndef FW_SERVE_WATCH_H
#define FW_SERVE_WATCH_H
#include "serve/server.h"

typedef struct fw_serve_file_watch fw_serve_file_watch;

/* `path` NULL: there is no file, and NULL is returned for both. Errors are diagnostics. */
fw_status fw_serve_file_watch_open(fw_arena *arena, const char *path, fw_diags *diags,
                                   fw_serve_file_watch **watch);
void fw_serve_file_watch_close(fw_serve_file_watch *watch);
const char *
fw_serve_file_watch_name(const fw_serve_file_watch *watch); /* without directories; NULL: no file */
const char *
fw_serve_file_watch_version(const fw_serve_file_watch *watch); /* as last seen; NULL: none */
int fw_serve_file_watch_fd(const fw_serve_file_watch *watch);  /* to be polled; -1: there is none */
/* looks at the file when the system says that it changed, and every second in any case: tells the
   pages when its content is another */
void fw_serve_file_watch_run(fw_serve_server *server);

#endif
