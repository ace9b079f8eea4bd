/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text that a page has and nobody saved: kept beside no file of the user's, below
   $XDG_STATE_HOME/flexwright/drafts (else ~/.local/state), one for every watched file and one for
   servers without a file. So it survives a page that is closed and a server that ends, on whatever
   port it starts again. Private to the room. */
#ifndef FW_SERVE_DRAFT_H
#define FW_SERVE_DRAFT_H
#include "serve/request.h"

/* where the draft of this file is (an absolute path; NULL: of no file); NULL: memory was short, or
   neither $XDG_STATE_HOME nor $HOME names a directory */
const char *fw_serve_draft_path(fw_arena *arena, const char *file);

/* The handlers of GET, POST and DELETE. GET answers what was kept, {"text": null} where nothing
   is; what is no document of ours counts as nothing. */
void fw_serve_draft_get(fw_serve_request *request, const char *path);
void fw_serve_draft_post(fw_serve_request *request, const char *path);
void fw_serve_draft_delete(fw_serve_request *request, const char *path);

#endif
