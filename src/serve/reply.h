/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replies as libmicrohttpd wants them. Private to the room. */
#ifndef FW_SERVE_REPLY_H
#define FW_SERVE_REPLY_H
#include "serve/server.h"

/* hands request->reply over, with the headers that every answer has */
enum MHD_Result fw_serve_reply_queue(fw_serve_request *request, struct MHD_Connection *mhd);

#endif
