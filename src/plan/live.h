/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Live computing behind an interactive page: one request (JSON) in, one answer (JSON) out, again
   and again in one process. Nothing is kept between calls but what an fw_plan_live holds, and
   that is bounded: the last answer, the design of the last preview and what it read of packs, the mechanism that was
   last posed, and the study whose points were last asked for (study/study.h). One fw_plan_live belongs to one thread.

   Documents (docs/reference/json.md): flexwright.table/1, preview/1, picture/1, pose/1, edit/1. */
#ifndef FW_PLAN_LIVE_H
#define FW_PLAN_LIVE_H
#include "base/arena.h"
#include "base/status.h"
#include <stddef.h>

typedef struct fw_plan_live_settings { /* zero: the defaults */
    const char *data_directory;        /* holds processes/ and masks/; NULL: as installed */
    size_t memory_cap;                 /* most bytes of one request; 0: 512 MiB */
    const fw_cancel *cancel;           /* stops the answer that is computed; may be NULL */
} fw_plan_live_settings;

typedef struct fw_plan_live fw_plan_live;
/* NULL settings: the defaults. NULL: out of memory */
fw_plan_live *fw_plan_live_new(const fw_plan_live_settings *settings);
void fw_plan_live_free(fw_plan_live *live); /* NULL allowed */

/* `text` is never NULL, belongs to `live` and lives until its next call.
   FW_OK: the document, also of a description that is wrong (its "status" says so).
   FW_USAGE: the request is not what it should be: {"error": {"message", "code"}}.
   Anything else: the work could not be done (out of memory ...): likewise an error object. */
typedef struct fw_plan_live_answer {
    fw_status status;
    const char *text; /* NUL-terminated UTF-8 */
    size_t length;    /* without the NUL */
} fw_plan_live_answer;

/* elements and attributes of the description, and the lists that options choose from. Always the
   same in one version. Cost: 1 ms. */
fw_plan_live_answer fw_plan_live_table(fw_plan_live *live);
/* {"text", "set", "options"}: the description read, judged as drawn (options.corners "auto": as
   made, too) and one scene of it moved. Cost for a six-bar: 110 ms of CPU,
   50 ms where the one before had the same options and packs, 5 ms where it is that one's text with what it held
   ("set") written into it. Test: test_live_kept.c */
fw_plan_live_answer fw_plan_live_preview(fw_plan_live *live, const char *request, size_t n);
/* {"text", "set", "options"}: of a preview's answer what its picture shows, for a page that is driven: shapes, and the motion
   of the scene that is shown, with what the hinges use in it. Nothing else is moved or judged.
   Cost for a six-bar: 8 ms of CPU where the answer before had the same options and packs. Test: test_live_kept.c */
fw_plan_live_answer fw_plan_live_picture(fw_plan_live *live, const char *request, size_t n);
/* {"text", "set", "options", "flow", "body", "platform": {"x_m", "y_m", "phi_rad"}, "q"}: the pose
   of the whole mechanism for a displacement of the platform. Cost for a six-bar: 1 ms, the first
   one with a text as much as laying it out. */
fw_plan_live_answer fw_plan_live_pose(fw_plan_live *live, const char *request, size_t n);
/* {"text", "changes": [...]}: the text with these changes made (device/edit.h). Cost: 1 ms. */
fw_plan_live_answer fw_plan_live_edit(fw_plan_live *live, const char *request, size_t n);
#endif
