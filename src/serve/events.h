/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Server-sent events: what changed, for at most FW_SERVE_STREAMS pages. Private to the room. */
#ifndef FW_SERVE_EVENTS_H
#define FW_SERVE_EVENTS_H
#include "serve/server.h"

/* one event for every page; the text is one line of JSON */
void fw_serve_events_send(fw_serve_server *server, const char *event, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* a comment from time to time, so that a page that went away is noticed */
void fw_serve_events_run(fw_serve_server *server);
void fw_serve_events_close(fw_serve_request *request); /* when it is one of them */
struct MHD_Response *fw_serve_events_response(fw_serve_request *request);

#endif
