/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of documents that several of them have. Each writes one value with its key (NULL in a
   list).
   Private to the room and study/. */
#ifndef FW_REPORT_JSON_PARTS_H
#define FW_REPORT_JSON_PARTS_H
#include "base/json.h"
#include "dynamics/dynamics.h"
#include "statics/level.h"
#include "statics/pull_in.h"

/* [a, b] */
void fw_report_json_pair(fw_json *json, const char *key, double a, double b);
/* [a, b, ...] */
void fw_report_json_reals(fw_json *json, const char *key, const double *value, int count);
/* {"BODY": [x, y, phi]} from 3 numbers per body */
void fw_report_json_by_body(fw_json *json, const char *key, const fw_mechanism *mechanism,
                            const double *triples);
/* one object per line of the ledger, into a list; scene and flow are added where they are given */
void fw_report_json_effects(fw_json *json, const fw_effect_ledger *ledger, const char *scene,
                            const char *flow);
/* Members of the object about one pull-in, which the caller opens and closes */
void fw_report_json_pull_in(fw_json *json, const fw_statics_pull_in *pull_in);
/* how hinges were taken, as members of an object that the caller opens and closes, where
   use->why is given; level may be NULL */
void fw_report_json_hinge_model(fw_json *json, const fw_mechanism *mechanism,
                                const fw_effects_hinge_use *use,
                                const fw_statics_level_step *level);
#endif
