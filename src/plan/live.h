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
#include "device/edit.h"
#include "mechanism/mechanism.h"
#include "plan/design.h"
#include <jansson.h>
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

/* ---- requests of the page, read and checked: private to live*.c and to what study/ answers in the same way ---- */

enum {
    FW_LIVE_REQUEST_MOST = 16 * 1024 * 1024, /* bytes */
    FW_LIVE_SETS_MOST = 256,
    FW_LIVE_CHANGES_MOST = 256,
    FW_LIVE_LABS_MOST = 4,
    FW_LIVE_SAMPLES = 401, /* rows of a motion where nothing is asked for */
    FW_LIVE_SAMPLES_MOST = 2001
};

struct fw_plan_live_shown { /* the design of the last preview, read and nothing else */
    fw_plan_kept kept;      /* design NULL: none */
    json_t *options, *lab;  /* of its request; NULL: it had none */
    bool full;              /* options.detail */
    json_t *held;           /* what its request set, while its text has not been asked for; NULL */
    bool rates;             /* of its request */
};

struct fw_plan_live {
    fw_arena *self; /* holds this struct */
    fw_plan_live_settings settings;
    fw_arena *answer;                 /* of the last one, NULL: none */
    struct fw_plan_live_posed *posed; /* the mechanism that was last posed, NULL: none */
    struct fw_plan_live_shown shown;
    /* what a room below keeps from one request to the next, and how it is freed; NULL: nothing */
    void *kept;
    void (*kept_free)(void *kept);
};

typedef struct fw_plan_live_request {
    fw_arena *arena; /* the answer's */
    json_t *root;    /* strings below belong to it */
    const char *text;
    size_t length;
    json_t *set, *options, *lab; /* objects or NULL; lab: laboratory packs by name */
    bool full;                   /* options.detail, after fw_plan_live_design */
    const char *wrong;           /* a sentence; NULL: nothing is */
} fw_plan_live_request;

/* what is wrong: FW_USAGE */
fw_status fw_plan_live_wrong(fw_plan_live_request *request, const char *what, const char *key);
/* the request's options into those of a design; strings belong to the request. *full: options.detail */
fw_status fw_plan_live_options(fw_plan_live_request *request, fw_design_options *options,
                               bool *full);
/* the laboratory packs of the request; texts belong to it */
fw_status fw_plan_live_lab(fw_plan_live_request *request, fw_arena *arena,
                           const fw_plan_lab_text **lab, int *n);
/* what an object of the request sets, NULL: nothing; texts belong to it */
fw_status fw_plan_live_sets(fw_plan_live_request *request, fw_arena *arena, json_t *object,
                            fw_device_set **set, int *n);
/* a design with the options, sets and packs of the request, not read yet */
fw_status fw_plan_live_design(const fw_plan_live *live, fw_plan_live_request *request,
                              fw_design **design);
void fw_plan_live_shown_free(fw_plan_live *live); /* from then on there is none */
/* optional members of an object: absent leaves *value alone */
fw_status fw_plan_live_string(fw_plan_live_request *r, const json_t *object, const char *key,
                              const char **value);
fw_status fw_plan_live_real(fw_plan_live_request *r, const json_t *object, const char *key,
                            double *value);

void fw_plan_live_posed_free(struct fw_plan_live_posed *posed); /* NULL allowed */

/* one call: `work` fills `out` in a fresh arena */
typedef fw_status (*fw_plan_live_work)(fw_plan_live *live, fw_plan_live_request *request,
                                       fw_text *out);
fw_plan_live_answer fw_plan_live_call(fw_plan_live *live, const char *json, size_t n,
                                      const char *const *keys, fw_plan_live_work work);

/* ---- where the bodies of a mechanism are when one of them is put somewhere ---- */

typedef struct fw_plan_posed {
    double *q;         /* (3 nbody) m, rad */
    double *angle_rad; /* (npin) phi_b - phi_a - free angle */
    double at[3];      /* displacement of the body from rest that q has: x m, y m, phi rad */
    bool reachable;    /* that is the one that was asked for */
    bool closed_form;
    double share;       /* closed form: of the way from rest to what was asked for; else NaN */
    const char *reason; /* why it is not reachable, a sentence; NULL */
} fw_plan_posed;

/* the body that is meant without a name: the platform, else the heaviest; FW_NONE: no bodies */
int fw_plan_pose_body(const fw_mechanism *mechanism);
/* asked: displacement of `body` from rest (x m, y m, phi rad), finite; phi NaN: any (of a
   six-bar's platform: as drawn). from (3 nbody): poses of the
   other bodies to start from, NULL: at rest. *posed is in `arena`. FW_SOLVER: no pose was found. */
fw_status fw_plan_pose_solve(fw_arena *arena, const fw_mechanism *mechanism, int body,
                             const double asked[3], const double *from, fw_plan_posed *posed);
#endif
