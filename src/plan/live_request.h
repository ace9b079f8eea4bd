/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requests of the page, read and checked. Private to live*.c and to what study/ answers in the same way. */
#ifndef FW_PLAN_LIVE_REQUEST_H
#define FW_PLAN_LIVE_REQUEST_H
#include "device/edit.h"
#include "mechanism/mechanism.h"
#include "plan/design.h"
#include "plan/live.h"
#include <jansson.h>

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
