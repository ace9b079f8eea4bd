/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Diagnostics: what is wrong, where, the value, the limit and its source, what to do. Collected, so
   that all mistakes of a file are reported in one run. */
#ifndef FW_BASE_DIAG_H
#define FW_BASE_DIAG_H
#include "base/arena.h"
#include "base/status.h"
#include "base/text.h"

/* base/diagnostics.def holds one row per id: X(number, short title, long text for `explain`) */
typedef struct fw_diag_entry {
    int number;
    const char *title, *text;
} fw_diag_entry;

typedef enum fw_severity { FW_NOTE, FW_WARNING, FW_ERROR } fw_severity;

/* a place in a file; line 0 means the file as a whole. Columns count bytes from 1. */
typedef struct fw_place {
    const char *file;
    int line, column;
} fw_place;

/* the file's name without directories, "" when there is none: outputs show this, so that where a
   file lies does not change a byte of them */
const char *fw_place_file(fw_place place);

/* does an error say that a run came to where a formula does not hold? */
typedef enum fw_diag_ended {
    FW_ENDED_NOT,
    FW_ENDED_FORMULA,
    FW_ENDED_CLOSED_FORM, /* of a flexure: an exact beam may hold farther on */
    FW_ENDED_BEAM /* of a flexure as an exact beam, which is not looked for beyond where held ends would buckle it */
} fw_diag_ended;

typedef struct fw_diag {
    int number;
    fw_severity severity;
    fw_place place;
    const char *message;
    fw_diag_ended ended;
    bool
        unreliable; /* a warning after which the result is not to be relied on, or a finding of a log */
    bool once;      /* said of a place once, however many flows have it */
    int reason;     /* of an error, errno of the call of the system that failed; 0: none did */
} fw_diag;

typedef struct fw_diags {
    fw_arena *arena;
    fw_diag *item; /* (count) */
    size_t count, capacity;
    size_t errors, unreliable;
    size_t dropped; /* beyond FW_DIAG_MOST */
    size_t before;  /* of the items: said before the call that is at work */
    int failed;     /* memory was short while collecting */
    int once;       /* number of what is to be said once of a place; 0: of nothing */
    int reason;     /* of the error that is said next; 0: none */
} fw_diags;

enum { FW_DIAG_MOST = 100 };

fw_diags fw_diags_new(fw_arena *arena);
/* all of its room at once, so that fw_diags_put needs no memory; false: there is none */
bool fw_diags_reserve(fw_diags *diags);
/* A list that is asked of over and over: another call begins. In a full list errors of earlier calls, which these were
   answered with, make room for whatever a later one says, the oldest first. Test: test_diag.c */
void fw_diags_call(fw_diags *diags);
/* printf rules of fw_text_printf hold: format numbers with fw_number_text. Returns FW_INPUT for
   errors, so that `return fw_diag_error(...)` reads well. */
fw_status fw_diag_error(fw_diags *diags, int number, fw_place place, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The list, where the error that is said next is for this reason of the system (errno), which callers of the library are told
   as a number beside the words: fw_diag_error(fw_diags_because(diags, errno), 220, ...). Test: test_diag.c */
fw_diags *fw_diags_because(fw_diags *diags, int reason);
/* of a run that came to where a formula does not hold */
fw_status fw_diag_formula_ended(fw_diags *diags, int number, fw_diag_ended ended, fw_place place,
                                const char *format, ...) __attribute__((format(printf, 5, 6)));
void fw_diag_warning(fw_diags *diags, int number, fw_place place, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* A warning that the result is of another start than the stated one, or wrong in itself: there is
   an answer, but not the one that was asked for, so a command does not end with 0. */
void fw_diag_unreliable(fw_diags *diags, int number, fw_place place, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void fw_diag_note(fw_diags *diags, int number, fw_place place, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Was this said of this place before? If not, and if it is now, it is said of it once: another list that this one takes over
   does not say it again. */
bool fw_diag_said(fw_diags *diags, int number, fw_place place);
/* adds what was said of a try that now counts, as if it had been said here */
void fw_diags_take(fw_diags *diags, const fw_diags *from);
/* Adds one whose text is there already and lives as long as the list. Where that is full of errors of this call it takes the
   place of the last of them. */
void fw_diags_put(fw_diags *diags, fw_diag ready);
/* adds one of another list, as a message of this severity */
void fw_diags_add(fw_diags *diags, const fw_diag *diag, fw_severity severity);

/* "FILE:LINE:COLUMN: error: message [FW-D041]", one line each, in file order.
   `source` (may be NULL, n bytes) is the text of `file`: places in it are shown with a caret. */
void fw_diags_print(const fw_diags *diags, fw_text *out, const char *file, const char *source,
                    size_t n, int colour);

const fw_diag_entry *fw_diag_table(size_t *count);
const fw_diag_entry *fw_diag_find(int number); /* NULL when there is none */

/* ---- what was probably meant ---- */

/* edit distance (insert, delete, replace, swap), at most `limit`+1; for "did you mean" */
int fw_edit_distance(const char *a, const char *b, int limit);
/* best match among count names within distance 2, else the one that begins alike, or NULL */
const char *fw_did_you_mean(const char *word, const char *const *names, size_t count);
/* that name in a message, by "%s%s%s" behind what is wrong: "; did you mean 'um'?", or nothing for NULL */
#define FW_DID_YOU_MEAN(near)                                                                      \
    (near) ? "; did you mean '" : "", (near) ? (near) : "", (near) ? "'?" : ""

/* Behind what is wrong: that, or where nothing is near the first of what there is, "; there are A B ..."; "" of no names.
   NULL: no memory. Test: test_growing_text.c */
const char *fw_text_meant(fw_arena *arena, const char *word, const char *const *names,
                          size_t count);

#endif
