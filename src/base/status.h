/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a function answers. A rejected design is a result, not an error. */
#ifndef FW_BASE_STATUS_H
#define FW_BASE_STATUS_H

/* code, exit status of the program, text */
#define FW_STATUS_TABLE(X)                                                                         \
    X(OK, 0, "done")                                                                               \
    X(USAGE, 2, "wrong usage")                                                                     \
    X(INPUT, 3, "invalid input")                                                                   \
    X(GEOMETRY, 3, "impossible geometry")                                                          \
    X(IO, 5, "input or output failed")                                                             \
    X(NOMEM, 6, "out of memory")                                                                   \
    X(LIMIT, 6, "a limit was reached")                                                             \
    X(SOLVER, 7, "no numerical solution")                                                          \
    X(CANCELLED, 130, "cancelled")                                                                 \
    X(INTERNAL, 70, "internal error")

typedef enum fw_status {
#define FW_STATUS_ENUM(code, exit_status, text) FW_##code,
    FW_STATUS_TABLE(FW_STATUS_ENUM)
#undef FW_STATUS_ENUM
} fw_status;

const char *fw_status_text(fw_status status);
int fw_status_exit(fw_status status);

/* return early with whatever went wrong; the only macro with hidden control flow */
#define FW_TRY(expression)                                                                         \
    do {                                                                                           \
        fw_status fw_try_ = (expression);                                                          \
        if (fw_try_ != FW_OK) return fw_try_;                                                      \
    } while (0)

/* OUT OF MEMORY as a status: FW_NEED(p = fw_arena_array(...)) */
#define FW_NEED(pointer)                                                                           \
    do {                                                                                           \
        if (!(pointer)) return FW_NOMEM;                                                           \
    } while (0)

#endif
