/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Release: the reach that a sideways etch below the device needs, from the device's own openings, and
   whether there is a window between that and what must stay.

   A removal with a reach is such an etch. Where the pack leaves the reach to the mask (status derived) it
   becomes the distance of the worst point of what moves (release/release.h), as it is drawn, and as much
   farther as the foot of the walls stands out; the step's time follows from it by the step's own law. With
   E the over-etch as a part, what must stay has to outlast r (1 + E). A rate known to u leaves at the time
   by which the slowest has freed everything, r R / (R - k u), up to r (R + k u) / (R - k u) of the fastest; the planned time
   r (1 + E) (R + k u) / R, and the stop time of the run sheet so many times as much as it is longer.
   A law with a lag gives the time of a narrow opening, t(r, S) against t(r, 0) of a wide one, from which the etch
   then has run k = t(r, S)/t(r, 0) times as far; a lag that is only assumed leaves the time that of wide openings.
   Theory: docs/theory/release.md. Test: test_judge_release.c. */
#include "base/text.h"
#include "process/fixed_point.h"
#include "process/pack.h"
#include "process/process_law.h"
#include <math.h>
#include <string.h>

static const char BOND[] = "release.bond";

bool fw_process_flow_releases(const fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++)
            if (flow->step[i].change[k].reach) return true;
    return false;
}

const fw_process_step *fw_process_flow_release_step(const fw_process_flow *flow, double *reach_m) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++)
            if (flow->step[i].change[k].reach) {
                *reach_m = fw_process_judge_known(flow->step[i].change[k].reach);
                return &flow->step[i];
            }
    *reach_m = (double)NAN;
    return NULL;
}

bool fw_process_flow_frees_all(const fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (c->reach && strcmp(c->where, "all") != 0) return false;
        }
    return true;
}

double fw_process_flow_bond(const fw_process_flow *flow) {
    const fw_quantity *q = fw_process_flow_quantity(flow, BOND);
    return q && !q->unknown ? fmin(fmax(q->value, 0.0), 0.99) : 0.0;
}

/* How far the foot of the walls stands outside of the drawn edges when the release begins: with what the walls lose from
   then on. 0 where that is not known. */
static double foot_of(const fw_process_flow *flow) {
    const fw_process_fixed_point *p = &flow->edges;
    double foot = p->ncls > 0 && p->solved ? p->cls[p->field].edge.bottom_m : 0.0;
    return (isfinite(foot) ? foot : 0.0) + p->wear.after_m;
}

static bool is_solved(const fw_process_change *c) {
    return c->reach && c->reach->status == FW_DERIVED;
}

double fw_process_release_run(const fw_process_flow *flow, const fw_process_step *step,
                              double reach_m) {
    return reach_m * (1.0 + step->overrun) * flow->release_wide;
}

/* does every law by which a release is timed know how narrow openings fall behind? */
static bool knows_lag(const fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_step *s = &flow->step[i];
            const fw_process_law *law = s->law ? fw_process_law_find(s->law) : NULL;
            if (s->change[k].reach && !(law && law->lags)) return false;
        }
    return true;
}

/* the reach as a quantity that laws of time take; unknown where nothing is drawn */
void fw_process_release_fill(fw_process_flow *flow, const fw_process_mask_facts *facts) {
    const fw_release *r = facts ? facts->release : NULL;
    const fw_quantity *edge = fw_process_flow_own_quantity(flow, FW_PROCESS_PRINTED_EDGE);
    bool known = r && r->slowest >= 0 && r->needed_m > 0.0;
    flow->release = known ? r : NULL;
    flow->hold = known ? facts->hold : NULL;
    flow->release_foot_m = foot_of(flow);
    flow->release_lag_known = knows_lag(flow);
    flow->release_wide = flow->release_wide_most = 1.0;
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (!is_solved(c)) continue;
            fw_quantity *q = fw_process_flow_own_quantity(flow, c->reach->id);
            if (!q) continue;
            q->unknown = !known;
            q->value = known ? fmax(r->needed_m + flow->release_foot_m, 0.0) : 0.0;
            q->uncertainty = known && edge && !edge->unknown ? edge->uncertainty : 0.0;
            q->source = "this device's own openings";
        }
}

/* "of the stage, near (900, 1500) um" */
static const char *place_of(fw_process_judge *j, const fw_release_part *p) {
    fw_process_numbers t = {0};
    return fw_arena_printf(j->arena, "%s, near (%s, %s) um", p->label ? p->label : "a piece",
                           fw_process_judge_um(&t, p->at.x), fw_process_judge_um(&t, p->at.y));
}

static fw_status window(fw_process_judge *j, const fw_process_step *s, double reach_m) {
    const fw_release *r = j->facts->release;
    fw_process_numbers t = {0};
    double needed = r->needed_m + j->flow->release_foot_m,
           lost = r->lost_m + j->flow->release_foot_m,
           run = fw_process_release_run(j->flow, s, reach_m);
    const char *slow, *weak,
        *needs = fw_process_judge_um(&t, needed), *loses = fw_process_judge_um(&t, lost),
        *runs = fw_process_judge_um(&t, run), *most = fw_process_judge_um(&t, reach_m);
    const char *share = fw_process_judge_number(&t, 100.0 * r->share, 3);
    const bool enough = j->flow->nearest_known && !isnan(j->flow->nearest_reach_m);
    FW_NEED(slow = place_of(j, &r->part[r->slowest]));
    if (needed > reach_m * (1.0 + 1e-9))
        FW_TRY(fw_process_judge_reason(
            j, FW_ANSWER_NO,
            "step %s does not free the device: it reaches %s um from every opening, and the middle "
            "of %s is %s um from the nearest one. Nearest change: %s%s%sholes (release-pitch)",
            s->id, most, slow, needs, enough ? "a reach of " : "",
            enough ? fw_process_judge_um(&t, j->flow->nearest_reach_m) : "",
            enough ? " um, or " : ""));
    if (r->weakest < 0) return FW_OK;
    FW_NEED(weak = place_of(j, &r->part[r->weakest]));
    if (run < lost) return FW_OK;
    j->flow->no_window = true;
    return fw_process_judge_reason(
        j, FW_ANSWER_NO,
        "step %s has no window: the last that comes free is %s, %s um from the nearest opening, so "
        "that with its over-etch the step runs %s um sideways%s; but %s keeps less than %s %% of "
        "its "
        "bond after %s um. Nearest change: %s",
        s->id, slow, needs, runs,
        j->flow->release_wide > 1.0 ? " from wide openings, while narrow ones fall behind" : "",
        weak, share, loses,
        j->facts->release_change ? j->facts->release_change : "release holes, or wider anchors");
}

/* what the step leaves of the bonds, where that is less than half of one */
static fw_status bonds(fw_process_judge *j, const fw_process_step *s, double reach_m) {
    const fw_release *r = j->facts->release;
    double run = fw_process_release_run(j->flow, s, reach_m) - j->flow->release_foot_m, least = 0.5;
    int part = -1;
    fw_process_numbers t = {0};
    for (int i = 0; i < r->npart && !j->flow->no_window; i++) {
        const fw_release_part *p = &r->part[i];
        double left = fw_release_bonded(p, run) / p->area_m2;
        if (p->duty == FW_RELEASE_STAYS && left < least) least = left, part = i;
    }
    if (part < 0) return FW_OK;
    return fw_process_judge_reason(
        j, FW_ANSWER_OPEN,
        "at the end of step %s, over-etch included, %s keeps %s %% of its bond; what is narrower "
        "than %s um, as a lead or a spine, hangs free",
        s->id, r->part[part].label, fw_process_judge_number(&t, 100.0 * least, 3),
        fw_process_judge_um(&t, 2.0 * run));
}

/* a flow that frees everything takes the frame off, too, where it runs so far */
static fw_status frame(fw_process_judge *j, const fw_process_step *s, double reach_m) {
    const fw_release *r = j->facts->release;
    double run = fw_process_release_run(j->flow, s, reach_m);
    fw_process_numbers t = {0};
    for (int i = 0; i < r->npart; i++) {
        const fw_release_part *p = &r->part[i];
        if (p->duty != FW_RELEASE_EITHER || p->body != FW_GROUND || p->joint != FW_NONE ||
            p->role != FW_ROLE_FRAME || p->reach_m + j->flow->release_foot_m > run)
            continue;
        return fw_process_judge_reason(
            j, FW_ANSWER_OPEN,
            "step %s runs %s um sideways, and the frame is nowhere farther than %s um from an "
            "opening: it comes off the wafer with the device, in one piece",
            s->id, fw_process_judge_um(&t, run),
            fw_process_judge_um(&t, p->reach_m + j->flow->release_foot_m));
    }
    return FW_OK;
}

/* How far a rate that is known to so much alone may run: by the time as planned where it is the fastest there may be, over-etch
   included; by when the slowest has freed everything; and by the stop time of the run sheet. m */
typedef struct runs {
    double planned_m, slowest_m, stop_m;
} runs;

static runs runs_of(const fw_process_flow *f, const fw_process_step *s, const fw_quantity *rate,
                    double low, double high, double reach_m) {
    const double faster = reach_m * f->release_wide * high / rate->value;
    runs r = {.planned_m = faster * (1.0 + s->overrun),
              .slowest_m = low > 0.0 ? reach_m * f->release_wide * high / low : HUGE_VAL,
              .stop_m = faster * (1.0 + s->overrun)};
    if (s->time.computable && s->time.nominal_s > 0.0)
        r.stop_m = faster * s->time.stop_s / s->time.nominal_s;
    return r;
}

/* what that leaves of the window */
static fw_status by_time(fw_process_judge *j, const fw_process_step *s, double reach_m) {
    const fw_release *r = j->facts->release;
    const fw_quantity *rate = fw_process_step_argument(s, "rate");
    fw_process_numbers t = {0};
    if (!rate || rate->unknown || !(rate->value > 0.0) || r->weakest < 0 || j->flow->no_window)
        return FW_OK;
    double low, high, lost = r->lost_m + j->flow->release_foot_m;
    fw_process_quantity_range(rate, &low, &high);
    const runs run = runs_of(j->flow, s, rate, low, high, reach_m);
    const double most = fmax(run.planned_m, fmax(run.slowest_m, run.stop_m));
    if (most < lost) return FW_OK;
    fw_quantity slowest = *rate, fastest = *rate;
    slowest.value = low, fastest.value = high;
    const char *from = fw_process_judge_um(&t, reach_m), *to = fw_process_judge_um(&t, lost);
    return fw_process_judge_reason(
        j, FW_ANSWER_OPEN,
        "the time of step %s alone does not hold its window of %s to %s um: with a rate between %s "
        "and %s %s, the planned time, over-etch included, may have run %s um, what is surely free "
        "by the longest time %s um, and the stop time %s um. Stop by the release ladder of the "
        "test die: when its plates up to a reach of %s um are free, and none beyond %s um",
        s->id, from, to, fw_process_judge_number(&t, fw_quantity_in_unit(&slowest), 3),
        fw_process_judge_number(&t, fw_quantity_in_unit(&fastest), 3), rate->unit,
        fw_process_judge_um(&t, run.planned_m),
        isfinite(run.slowest_m) ? fw_process_judge_um(&t, run.slowest_m) : "any",
        fw_process_judge_um(&t, run.stop_m), from, to);
}

/* the argument of a law with a lag that says how large it is; -1: none */
static int lag_of(const fw_process_step *s) {
    const fw_process_law *law = s->law ? fw_process_law_find(s->law) : NULL;
    for (int i = 0; law && law->lags && i < s->nargument && s->nargument <= FW_LAW_ARGUMENTS; i++) {
        const fw_process_argument *a = &s->argument[i];
        bool lag = strcmp(a->name, "probability") == 0 || strcmp(a->name, "lag") == 0;
        if (lag && a->q && !a->q->unknown) return i;
    }
    return -1;
}

/* the step's time with another lag; NaN: not computable */
static fw_status time_with(fw_process_judge *j, const fw_process_step *s, int lag, double value,
                           double *time_s) {
    fw_process_argument list[FW_LAW_ARGUMENTS];
    fw_process_law_answer answer;
    fw_quantity other = *s->argument[lag].q;
    for (int i = 0; i < s->nargument; i++)
        list[i] = s->argument[i];
    other.value = value;
    list[lag].q = &other;
    const fw_process_law_use use = fw_process_law_of_step(s, list);
    FW_TRY(fw_process_law_evaluate(j->arena, &use, &answer));
    *time_s = answer.computable ? answer.value : (double)NAN;
    return FW_OK;
}

/* how much farther the etch runs from wide openings than from the one that the time is of */
static fw_status find_wide(fw_process_judge *j, const fw_process_step *s) {
    int lag = lag_of(s);
    double low, high, none, as_known, worst;
    j->flow->release_wide = j->flow->release_wide_most = 1.0;
    if (lag < 0) return FW_OK;
    const fw_quantity *q = s->argument[lag].q;
    fw_process_quantity_range(q, &low, &high);
    FW_TRY(time_with(j, s, lag, 0.0, &none));
    FW_TRY(time_with(j, s, lag, q->value, &as_known));
    FW_TRY(time_with(j, s, lag, fmax(high, q->value), &worst));
    if (!(none > 0.0) || isnan(as_known + worst)) return FW_OK;
    if (!fw_process_lag_is_guess(q)) j->flow->release_wide = fmax(as_known / none, 1.0);
    j->flow->release_wide_most = fmax(worst / none, j->flow->release_wide);
    return FW_OK;
}

/* what is known of how narrow openings hold a sideways etch back leaves of the window */
static fw_status lag(fw_process_judge *j, const fw_process_step *s, double reach_m) {
    const fw_release *r = j->facts->release;
    fw_process_numbers t = {0};
    double most = j->flow->release_wide_most;
    if (lag_of(s) < 0)
        return fw_process_judge_reason(
            j, FW_ANSWER_OPEN,
            "whether narrow openings and long ways below a plate hold the etch of step %s back is "
            "not known: the flow has no law for it, and every opening is taken to be as fast",
            s->id);
    bool guess = j->flow->release_wide < most && fw_process_lag_is_guess(s->argument[lag_of(s)].q);
    double lost = r->lost_m + j->flow->release_foot_m, run = reach_m * (1.0 + s->overrun) * most;
    if (j->flow->no_window || r->weakest < 0 || (run < lost && !guess)) return FW_OK;
    return fw_process_judge_reason(
        j, FW_ANSWER_OPEN,
        "%s: at the worst of what is known of the lag, wide openings have run %s um by the time "
        "that "
        "narrow ones have run the %s um of step %s, over-etch included, and %s keeps %s %% of its "
        "bond for %s um. Read the release ladder of the test die",
        guess ? "how far narrow openings fall behind is only assumed, and the time is that of wide "
                "ones"
              : "narrow openings may fall so far behind that there is no window",
        fw_process_judge_um(&t, run), fw_process_judge_um(&t, reach_m), s->id,
        r->part[r->weakest].label, fw_process_judge_number(&t, 100.0 * r->share, 3),
        fw_process_judge_um(&t, lost));
}

fw_status fw_process_judge_release(fw_process_judge *j) {
    int before = j->flow->nreason;
    fw_process_answer so_far = j->verdict;
    j->flow->no_window = false;
    if (!j->facts || !j->facts->release || j->facts->release->slowest < 0) return FW_OK;
    for (int i = 0; i < j->flow->nstep; i++) {
        const fw_process_step *s = &j->flow->step[i];
        for (int k = 0; k < s->nchange; k++) {
            double reach = fw_process_judge_known(s->change[k].reach);
            if (!s->change[k].reach || isnan(reach)) continue;
            FW_TRY(find_wide(j, s));
            FW_TRY(window(j, s, reach));
            FW_TRY(bonds(j, s, reach));
            FW_TRY(frame(j, s, reach));
            FW_TRY(by_time(j, s, reach));
            FW_TRY(lag(j, s, reach));
        }
    }
    if (j->verdict == FW_ANSWER_NO && so_far != FW_ANSWER_NO) /* what refuses comes first */
        fw_process_judge_to_front(j->flow, before);
    return FW_OK;
}

/* ==== for the documents of verdict and recipe, as JSON and in words ==== */

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
    const char *hinges = g->ground_hinges > 0 ? fw_text_few(text->arena, g->at) : "";
    text->failed = text->failed || !hinges;
    fw_text_printf(text, " on, when %s has let go, %s hangs on %s%s", g->last_bond,
                   h->ngroup > 1 ? "its mechanism" : "the device",
                   g->ground_hinges == 0 && g->tethers == 0 ? "nothing" : "", hinges ? hinges : "");
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
    for (int i = 0; i < r->own; i++)
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
