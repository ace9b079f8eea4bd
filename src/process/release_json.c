/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a release does to every part of the device, for the documents of verdict and recipe. */
#include "process/pack.h"
#include "process/judge.h"
#include <math.h>

const char *fw_process_duty_word(fw_release_duty duty) {
    switch (duty) {
    case FW_RELEASE_MOVES:
        return "moves";
    case FW_RELEASE_STAYS:
        return "stays";
    case FW_RELEASE_EITHER:
        return "either";
    }
    return "";
}

static void part(fw_json *json, const fw_release_part *p, double run_m) {
    fw_json_object(json, NULL);
    fw_json_text(json, "part", p->label);
    fw_json_text(json, "duty", fw_process_duty_word(p->duty));
    fw_json_real(json, "area_m2", p->area_m2);
    fw_json_real(json, "reach_m", p->reach_m);
    fw_json_real(json, "most_m", p->most_m);
    fw_json_list(json, "at_m");
    fw_json_real(json, NULL, p->at.x);
    fw_json_real(json, NULL, p->at.y);
    fw_json_end(json);
    if (p->duty == FW_RELEASE_STAYS) {
        fw_json_real(json, "kept_m", p->kept_m);
        fw_json_real(json, "bonded_share",
                     isnan(run_m) ? (double)NAN : fw_release_bonded(p, run_m) / p->area_m2);
    }
    fw_json_end(json);
}

void fw_process_release_json(const fw_process_flow *flow, fw_json *json) {
    const fw_release *r = flow->release;
    double reach;
    const fw_process_step *s = fw_process_flow_release_step(flow, &reach);
    if (!r || !s) {
        fw_json_null(json, "release");
        return;
    }
    double run = reach * (1.0 + s->overrun), foot = flow->release_foot_m;
    fw_json_object(json, "release");
    fw_json_text(json, "step", s->id);
    fw_json_real(json, "reach_m", reach);
    fw_json_real(json, "run_m", run);
    fw_json_real(json, "needed_m", r->needed_m);
    fw_json_real(json, "lost_m", r->lost_m);
    fw_json_real(json, "foot_m", foot);
    fw_json_real(json, "share", r->share);
    fw_json_truth(json, "window", !flow->no_window);
    fw_json_text(json, "slowest", r->slowest < 0 ? NULL : r->part[r->slowest].label);
    fw_json_text(json, "weakest", r->weakest < 0 ? NULL : r->part[r->weakest].label);
    fw_json_list(json, "parts");
    for (int i = 0; i < r->npart; i++)
        part(json, &r->part[i], run - foot);
    fw_json_end(json);
    fw_process_hold_json(flow, json);
    fw_json_end(json);
}

fw_status fw_process_release_words(fw_arena *arena, const fw_process_flow *flow, const char **out) {
    const fw_release *r = flow->release;
    double reach, foot = flow->release_foot_m;
    const fw_process_step *s = fw_process_flow_release_step(flow, &reach);
    fw_process_numbers t = {0};
    *out = NULL;
    if (!r || !s || isnan(reach) || r->slowest < 0) return FW_OK;
    const char *most = fw_process_judge_um(&t, reach),
               *run = fw_process_judge_um(&t, reach * (1.0 + s->overrun)),
               *needed = fw_process_judge_um(&t, r->needed_m + foot);
    if (r->weakest < 0) {
        FW_NEED(*out = fw_arena_printf(arena,
                                       "Step %s reaches %s um sideways (%s with its over-etch): %s "
                                       "is free last, after %s um; nothing must stay",
                                       s->id, most, run, r->part[r->slowest].label, needed));
        return FW_OK;
    }
    FW_NEED(*out = fw_arena_printf(
                arena,
                "Step %s reaches %s um sideways (%s with its over-etch): %s is free last, after %s "
                "um; %s is lost first, after %s um",
                s->id, most, run, r->part[r->slowest].label, needed, r->part[r->weakest].label,
                fw_process_judge_um(&t, r->lost_m + foot)));
    return FW_OK;
}
