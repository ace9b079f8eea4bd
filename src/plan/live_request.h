/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requests of the page, read and checked. Private to live*.c. */
#ifndef FW_PLAN_LIVE_REQUEST_H
#define FW_PLAN_LIVE_REQUEST_H
#include "device/edit.h"
#include "plan/design.h"
#include "plan/live.h"
#include <jansson.h>

enum {
    FW_LIVE_REQUEST_MOST = 16 * 1024 * 1024, /* bytes */
    FW_LIVE_SETS_MOST = 256,
    FW_LIVE_CHANGES_MOST = 256,
    FW_LIVE_SAMPLES = 401, /* rows of a motion where nothing is asked for */
    FW_LIVE_SAMPLES_MOST = 2001
};

struct fw_plan_live {
    fw_arena *self; /* holds this struct */
    fw_plan_live_settings settings;
    fw_arena *answer;                 /* of the last one, NULL: none */
    struct fw_plan_live_posed *posed; /* the mechanism that was last posed, NULL: none */
};

typedef struct fw_plan_live_request {
    fw_arena *arena; /* the answer's */
    json_t *root;    /* strings below belong to it */
    const char *text;
    size_t length;
    json_t *set, *options; /* objects or NULL */
    bool full;             /* options.detail, after fw_plan_live_design */
    const char *wrong;     /* a sentence; NULL: nothing is */
} fw_plan_live_request;

/* takes the request apart; keys: those allowed beside "text", NULL at the end. FW_USAGE: `wrong` */
fw_status fw_plan_live_request_read(fw_arena *arena, const char *json, size_t n,
                                    const char *const *keys, fw_plan_live_request *request);
void fw_plan_live_request_free(fw_plan_live_request *request);
/* what is wrong: FW_USAGE */
fw_status fw_plan_live_wrong(fw_plan_live_request *request, const char *what, const char *key);
/* a design with the options and sets of the request, not read yet */
fw_status fw_plan_live_design(const fw_plan_live *live, fw_plan_live_request *request,
                              fw_design **design);
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
#endif
