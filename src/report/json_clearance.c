/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How near what moves comes to what it may meet, as JSON. */
#include "report/json_parts.h"
#include "report/report.h"
#include <math.h>

static void place(fw_json *json, const char *key, fw_geometry_vec2 p) {
    fw_json_list(json, key);
    fw_json_real(json, NULL, p.x);
    fw_json_real(json, NULL, p.y);
    fw_json_end(json);
}

static void one(fw_json *json, const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    fw_json_object(json, NULL);
    fw_json_text(json, "scene", c->scene);
    fw_json_text(json, "flow", c->flow);
    fw_json_text(json, "verdict",
                 c->decision == FW_ACCEPT   ? "accept"
                 : c->decision == FW_REJECT ? "reject"
                                            : "inconclusive");
    fw_json_text(json, "a", l->at.a);
    fw_json_text(json, "b", l->at.b);
    fw_json_real(json, "clearance_m", c->m);
    fw_json_real(json, "low_m", c->low_m);
    fw_json_real(json, "high_m", c->high_m);
    fw_json_real(json, "required_m", c->required_m);
    fw_json_real(json, "drawn_m", l->m);
    fw_json_real(json, "proved_m", isfinite(l->low_m) ? l->low_m : (double)NAN);
    fw_json_real(json, "start_m", l->start_m);
    fw_json_truth(json, "meet", l->m <= 0);
    fw_json_real(json, "share", l->share);
    place(json, "at_a_m", l->at.at_a);
    place(json, "at_b_m", l->at.at_b);
    fw_json_real(json, "t_s", c->box == FW_NONE ? l->t_s : (double)NAN);
    fw_json_end(json);
}

void fw_report_json_clearances(fw_json *json, const fw_verdict *v) {
    fw_json_list(json, "clearances");
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nclearance; k++)
            one(json, &v->variant[i].clearance[k]);
    fw_json_end(json);
}
