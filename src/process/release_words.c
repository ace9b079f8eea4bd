/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a release does to every part of the device, for the documents of verdict and recipe: as JSON and in words. */
#include "base/text.h"
#include "process/judge.h"
#include "process/pack.h"
#include <math.h>

/* ---- in between and after: which body lets go when, what it then hangs on, and the anchors ---- */

/* when the etch has gone so far, in the step's own time; NaN: that is not computed */
static double time_of(const fw_process_flow *flow, double drawn_m) {
    double reach;
    const fw_process_step *s = fw_process_flow_release_step(flow, &reach);
    if (!s || !s->time.computable || !(reach > 0.0)) return (double)NAN;
    return s->time.nominal_s * fmax(drawn_m + flow->release_foot_m, 0.0) / reach;
}

static void moment(fw_json *json, const fw_process_flow *flow, const char *way, const char *time,
                   double drawn_m) {
    fw_json_real(json, way, drawn_m + flow->release_foot_m);
    fw_json_real(json, time, time_of(flow, drawn_m));
}

static void body(fw_json *json, const fw_process_flow *flow, const fw_release_body_hold *b) {
    fw_json_object(json, NULL);
    fw_json_text(json, "part", b->label);
    moment(json, flow, "free_m", "free_s", b->free_m);
    fw_json_list(json, "held_by");
    for (int i = 0; i < b->nby; i++)
        fw_json_text(json, NULL, b->by[i]);
    fw_json_end(json);
    fw_json_truth(json, "last_anchor", b->holders == 1);
    fw_json_end(json);
}

static void group(fw_json *json, const fw_process_flow *flow, const fw_release_group_hold *g) {
    fw_json_object(json, NULL);
    moment(json, flow, "hangs_m", "hangs_s", g->hangs_m);
    fw_json_text(json, "last_bond", g->last_bond);
    fw_json_whole(json, "ground_hinges", g->ground_hinges);
    fw_json_whole(json, "tethers", g->tethers);
    fw_json_text(json, "last_anchor", g->last_anchor);
    moment(json, flow, "last_anchor_m", "last_anchor_s", g->last_anchor_m);
    fw_json_end(json);
}

/* members "lets_go" and "mechanisms" of an open object; nothing where there are none */
static void hold_json(const fw_process_flow *flow, fw_json *json) {
    const fw_release_hold *h = flow->hold;
    if (!h) return;
    fw_json_list(json, "lets_go");
    for (int i = 0; i < h->nbody; i++)
        body(json, flow, &h->body[i]);
    fw_json_end(json);
    fw_json_list(json, "mechanisms");
    for (int i = 0; i < h->ngroup; i++)
        group(json, flow, &h->group[i]);
    fw_json_end(json);
}

static void say_moment(fw_text *text, const fw_process_flow *flow, double drawn_m) {
    fw_process_numbers t = {0};
    double s = time_of(flow, drawn_m);
    fw_text_printf(text, "%s um", fw_process_judge_um(&t, drawn_m + flow->release_foot_m));
    if (!isnan(s)) fw_text_printf(text, " (%s min)", fw_process_judge_number(&t, s / 60.0, 3));
}

static void say_body(fw_text *text, const fw_process_flow *flow, const fw_release_body_hold *b) {
    enum { FEW = 3 };
    fw_text_printf(text, "%s after ", b->label);
    say_moment(text, flow, b->free_m);
    fw_text_printf(text, b->holders == 0   ? ", held by nothing: it floats"
                         : b->holders == 1 ? ", on its last anchor, "
                                           : ", on ");
    for (int i = 0; i < b->nby && i < FEW; i++)
        fw_text_printf(text, "%s%s", i ? ", " : "", b->by[i]);
    if (b->nby > FEW) fw_text_printf(text, " and %d more", b->nby - FEW);
}

static void say_group(fw_text *text, const fw_process_flow *flow, const fw_release_group_hold *g,
                      const fw_release_hold *h) {
    fw_text_add(text, ". From ");
    say_moment(text, flow, g->hangs_m);
    fw_text_printf(text, " on, when %s has let go, %s hangs on %s%s", g->last_bond,
                   h->ngroup > 1 ? "its mechanism" : "the device",
                   g->ground_hinges == 0 && g->tethers == 0 ? "nothing" : "",
                   g->ground_hinges > 0 ? g->at : "");
    if (g->tethers > 0)
        fw_text_printf(text, "%s%d tether%s", g->ground_hinges > 0 ? " and " : "", g->tethers,
                       g->tethers == 1 ? "" : "s");
    if (g->ground_hinges + g->tethers == 1) fw_text_add(text, ", ITS ONE ANCHOR");
    if (!g->last_anchor) return;
    fw_text_printf(text, "; the last of the anchors would be the %s, which nothing holds after ",
                   g->last_anchor);
    say_moment(text, flow, g->last_anchor_m);
}

fw_status fw_process_hold_words(fw_arena *arena, const fw_process_flow *flow, const char **out) {
    enum { FEW = 8 };
    const fw_release_hold *h = flow->hold;
    fw_text text = fw_text_new(arena);
    *out = NULL;
    if (!h || h->nbody == 0) return FW_OK;
    fw_text_add(&text, "They let go in this order: ");
    for (int i = 0; i < h->nbody && i < FEW; i++) {
        fw_text_add(&text, i ? "; " : "");
        say_body(&text, flow, &h->body[i]);
    }
    if (h->nbody > FEW) fw_text_printf(&text, "; and %d more later", h->nbody - FEW);
    for (int i = 0; i < h->ngroup && i < FEW; i++)
        say_group(&text, flow, &h->group[i], h);
    FW_TRY(fw_text_end(&text));
    *out = text.data;
    return FW_OK;
}

/* ---- every part ---- */

static const char *duty_word(fw_release_duty duty) {
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
    fw_json_text(json, "duty", duty_word(p->duty));
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
    double run = fw_process_release_run(flow, s, reach), foot = flow->release_foot_m;
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
    hold_json(flow, json);
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
               *run = fw_process_judge_um(&t, fw_process_release_run(flow, s, reach)),
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
