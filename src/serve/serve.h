/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The local page: a server on loopback over the same library. One thread, one loop over sockets;
   all that computes runs in processes of its own with limits (jobs.h). */
#ifndef FW_SERVE_SERVE_H
#define FW_SERVE_SERVE_H
#include "base/arena.h"
#include <stdbool.h>

typedef struct fw_serve_options {
    const char *device;         /* the file that is shown, watched and saved; NULL: none */
    const char *data_directory; /* of packs and layer tables, as fw_design_options; may be NULL */
    int port;                   /* 0: a free one */
    bool ipv6;                  /* listen on ::1 as well */
    /* called once the server listens; `page` is a file that leads to the address, for a browser
       that is started by a command line, which others can read; NULL: it could not be written */
    void (*ready)(const char *url, const char *page, void *context);
    void *context;
    const fw_cancel *interrupted; /* ends the server; may be NULL */
} fw_serve_options;

/* serves until SIGINT or SIGTERM; what went wrong is said on standard error. Returns the exit
   status of the program: 0 after a signal. */
int fw_serve_run(const fw_serve_options *options);

/* The program as one of the server's own processes: argv[1] is FW_SERVE_CHILD, argv[2] says which.
   Nobody types this, and it is no command. */
#define FW_SERVE_CHILD "--serve-child"
int fw_serve_child(int argc, char **argv);

#endif
