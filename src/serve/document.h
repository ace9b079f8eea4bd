/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text that a page edits: the one file that the server shows, watches and saves, the draft that
   a page has and nobody saved, and what lies beside the file. Private to the room. */
#ifndef FW_SERVE_DOCUMENT_H
#define FW_SERVE_DOCUMENT_H
#include "base/diag.h"
#include "serve/request.h"

typedef struct fw_serve_file_watch fw_serve_file_watch;

/* `path` NULL: there is no file, and *watch is NULL. A file larger than most_bytes is not read;
   changes of it go out as events. Errors are diagnostics. */
fw_status fw_serve_file_watch_open(fw_arena *arena, const char *path, size_t most_bytes,
                                   fw_serve_events *events, fw_diags *diags,
                                   fw_serve_file_watch **watch);
void fw_serve_file_watch_close(fw_serve_file_watch *watch);
/* without directories; NULL: no file */
const char *fw_serve_file_watch_name(const fw_serve_file_watch *watch);
/* whole; NULL: no file */
const char *fw_serve_file_watch_path(const fw_serve_file_watch *watch);
int fw_serve_file_watch_fd(const fw_serve_file_watch *watch); /* to be polled; -1: there is none */
/* looks at the file when the system says that it changed, and every second in any case: tells the
   pages when its content is another, and when it could not be read for a second: gone, too large,
   no file any more */
void fw_serve_file_watch_run(fw_serve_file_watch *watch);
/* tells one page which version was seen last: it may have missed a change */
void fw_serve_file_watch_tell(const fw_serve_file_watch *watch, fw_serve_stream *stream);

/* ---- the file as it is now ---- */
typedef struct fw_serve_file_state {
    const char *text; /* (n) in the caller's arena, or what was to be saved */
    size_t n;
    char version[65]; /* hash of the text; "": it could not be read */
    bool writable;
} fw_serve_file_state;
fw_status fw_serve_file_watch_read(fw_arena *arena, const fw_serve_file_watch *watch,
                                   fw_diags *diags, fw_serve_file_state *state);
/* Saves n bytes, whole or not at all, with the permissions that the file has; state is then what
   was saved. FW_CANCELLED: the file is not at `version` any more, state says what it is. A file that
   is gone is written anew; what is there and cannot be read is not replaced. */
fw_status fw_serve_file_watch_save(fw_arena *arena, fw_serve_file_watch *watch, const char *text,
                                   size_t n, const char *version, fw_diags *diags,
                                   fw_serve_file_state *state);

/* ---- the draft ----
   Kept beside no file of the user's, below $XDG_STATE_HOME/flexwright/drafts (else ~/.local/state), one
   for every watched file and one for servers without a file. So it survives a page that is closed and
   a server that ends, on whatever port it starts again. */

/* where the draft of this file is (an absolute path; NULL: of no file); NULL: memory was short, or
   neither $XDG_STATE_HOME nor $HOME names a directory */
const char *fw_serve_draft_path(fw_arena *arena, const char *file);

/* The handlers of GET, POST and DELETE. GET answers what was kept, {"text": null} where nothing
   is; what is no document of ours counts as nothing. */
void fw_serve_draft_get(fw_serve_request *request, const char *path);
void fw_serve_draft_post(fw_serve_request *request, const char *path);
void fw_serve_draft_delete(fw_serve_request *request, const char *path);

/* ---- what lies beside the file ----
   As-run logs in its directory, and directories below it that hold the samples of a study: what the program has
   written there in a terminal. A server without a file keeps logs below $XDG_STATE_HOME/flexwright/logs. */

typedef struct fw_serve_beside {
    const char *directory; /* absolute, with a slash at its end; NULL: there is none */
    const char **log;      /* (nlog) names of files that begin as logs do, by name */
    const char *
        *study; /* (nstudy) directories with a study.sqlite, from the directory on, by name */
    size_t nlog, nstudy;
} fw_serve_beside;

/* `file` as fw_serve_file_watch_path has it */
fw_status fw_serve_beside_look(fw_arena *arena, const char *file, fw_serve_beside *beside);
/* a log that is there, or a name that a new one may have: letters, digits, '-' and '_' before ".log" */
bool fw_serve_beside_is_log(const fw_serve_beside *beside, const char *name);
/* The samples of one of its studies as out/study.sqlite of the directory `to`: a copy, what is beside the file stays as it
   is. NULL, or why not. */
const char *fw_serve_beside_copy(const fw_serve_beside *beside, const char *study, int to);
/* the handler of GET: what there is, or with a name the log of that name */
void fw_serve_beside_get(fw_serve_request *request, const char *file, const char *name);

#endif
