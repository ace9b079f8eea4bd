/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least change that opens a window for the release: the device is drawn again with it, its distances
   found again, and the flow judged with them.

   Tried are release holes, from the coarsest grid to the finest that can be drawn, then, to 1 um, between the
   last pitch that opens nothing and the first that does; a wider frame, where the frame is lost first; and
   narrower bars, where bars alone come free too late. In: a plan with a flow that has no window. Out: words
   for its reason. Cost: some ten drawings, only for what is refused. Test: test_release_change.c. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

typedef struct change {
    double pitch_m, frame_m, bar_m; /* 0: as stated */
} change;

typedef struct answer {
    bool opens;
    double needed_m, lost_m;
} answer;

static const double FINEST_M = 27e-6, COARSEST_M = 400e-6, STEP_M = 1e-6;

fw_status fw_plan_release_solve(fw_plan *plan, const fw_plan_flow *pf, const fw_layout *layout,
                                const fw_release **release) {
    const fw_layout *marked;
    int left_out;
    FW_TRY(fw_mask_frame_marks(plan->arena, pf->table, layout, &marked, &left_out));
    return fw_release_solve(plan->arena, marked, fw_plan_insulated(pf),
                            fw_process_flow_frees_all(pf->flow), fw_process_flow_bond(pf->flow),
                            release);
}

/* the device as changed: bodies are copied where bars become narrower */
static fw_status changed_device(fw_arena *arena, const fw_device *from, const change *c,
                                fw_device *to) {
    *to = *from;
    if (c->pitch_m > 0.0) {
        to->release_pitch_m = c->pitch_m;
        to->release_hole_m = 0.0; /* in proportion */
    }
    if (c->frame_m > 0.0) to->die.frame_m = c->frame_m;
    if (!(c->bar_m > 0.0)) return FW_OK;
    size_t n = (size_t)from->nbody;
    FW_NEED(to->body = fw_arena_grow(arena, from->body, n, n, sizeof *to->body));
    for (int i = 0; i < to->nbody; i++)
        if (to->body[i].width_m > c->bar_m) to->body[i].width_m = c->bar_m;
    return FW_OK;
}

/* drawn, measured and judged; *out.opens false where it cannot be drawn, too */
static fw_status try_change(fw_plan *plan, fw_plan_flow *pf, const change *c, answer *out) {
    fw_device device;
    const fw_layout *layout = NULL;
    const fw_release *release;
    fw_process_mask_facts facts;
    fw_diags quiet = fw_diags_new(plan->arena);
    *out = (answer){0};
    FW_TRY(changed_device(plan->arena, plan->device, c, &device));
    fw_status status = fw_layout_build(plan->arena, &device, &quiet, &layout);
    if (status == FW_GEOMETRY || status == FW_INPUT) return FW_OK;
    FW_TRY(status);
    if (!layout || !layout->drawn) return FW_OK;
    FW_TRY(fw_plan_release_solve(plan, pf, layout, &release));
    FW_TRY(fw_plan_mask_facts(plan->arena, &device, layout, &pf->variant, pf->table,
                              fw_plan_insulated(pf), &facts));
    facts.dies = plan->dies;
    facts.release = release;
    status = fw_process_flow_compute(plan->arena, pf->flow, &facts, &quiet);
    if (status == FW_INPUT) return FW_OK;
    FW_TRY(status);
    *out = (answer){!pf->flow->no_window, release->needed_m, release->lost_m};
    return FW_OK;
}

static double to_grid(double x_m, double step_m) {
    return step_m * round(x_m / step_m);
}

/* the coarsest grid of holes that opens a window */
static fw_status find_pitch(fw_plan *plan, fw_plan_flow *pf, double *pitch_m, answer *found) {
    double was = plan->device->release_pitch_m, high = was > 0.0 ? was : COARSEST_M, low = 0.0;
    *pitch_m = 0.0;
    /* what a square grid leaves is some 0.56 of the pitch, and with its over-etch less than is lost */
    double guess = fmin(high, 2.0 * pf->release->lost_m);
    for (double p = guess; p >= FINEST_M && low == 0.0; p *= 0.82) {
        double here = to_grid(p, STEP_M);
        FW_TRY(try_change(plan, pf, &(change){.pitch_m = here}, found));
        *(found->opens ? &low : &high) = here;
    }
    if (low == 0.0) return FW_OK;
    answer best = *found;
    while (high < COARSEST_M && high - low > 1.5 * STEP_M) {
        double middle = to_grid(0.5 * (low + high), STEP_M);
        FW_TRY(try_change(plan, pf, &(change){.pitch_m = middle}, found));
        if (found->opens) best = *found;
        *(found->opens ? &low : &high) = middle;
    }
    *pitch_m = low;
    *found = best;
    return FW_OK;
}

/* the narrowest frame that opens one: up to four times as wide */
static fw_status find_frame(fw_plan *plan, fw_plan_flow *pf, double *frame_m, answer *found) {
    double low = plan->device->die.frame_m, high = 4.0 * low;
    *frame_m = 0.0;
    if (!(low > 0.0)) return FW_OK;
    FW_TRY(try_change(plan, pf, &(change){.frame_m = high}, found));
    if (!found->opens) return FW_OK;
    answer best = *found;
    while (high - low > 10.0 * STEP_M) {
        double middle = to_grid(0.5 * (low + high), STEP_M);
        FW_TRY(try_change(plan, pf, &(change){.frame_m = middle}, found));
        if (found->opens) best = *found;
        *(found->opens ? &high : &low) = middle;
    }
    *frame_m = high;
    *found = best;
    return FW_OK;
}

/* the widest bars that open one */
static fw_status find_bars(fw_plan *plan, fw_plan_flow *pf, double *bar_m, answer *found) {
    double widest = 0.0, most = 2.0 * pf->release->lost_m;
    *bar_m = 0.0;
    for (int i = 0; i < plan->device->nbody; i++)
        widest = fmax(widest, plan->device->body[i].width_m);
    for (double w = fmin(most, widest) * 0.95; w > 30e-6 && *bar_m == 0.0; w *= 0.85) {
        FW_TRY(try_change(plan, pf, &(change){.bar_m = to_grid(w, STEP_M)}, found));
        if (found->opens) *bar_m = to_grid(w, STEP_M);
    }
    return FW_OK;
}

static bool is_bar(const fw_plan *plan, const fw_release_part *p) {
    return p->body >= 0 && plan->device->body[p->body].width_m > 0.0 &&
           !(plan->device->body[p->body].plate_width_m > 0.0);
}

/* what: the change up to its number, and behind its unit */
static fw_status words(fw_plan *plan, const char *const what[2], double m, const answer *a,
                       const char **out) {
    char size[32], needed[32], lost[32];
    FW_NEED(*out = fw_arena_printf(plan->arena,
                                   "%s%s um%s: drawn and judged again, all that moves is free "
                                   "after %s um, and what must stay holds for %s um",
                                   what[0], fw_number_text(size, sizeof size, 1e6 * m, 4), what[1],
                                   fw_number_text(needed, sizeof needed, 1e6 * a->needed_m, 4),
                                   fw_number_text(lost, sizeof lost, 1e6 * a->lost_m, 4)));
    return FW_OK;
}

fw_status fw_plan_release_change(fw_plan *plan, fw_plan_flow *pf, const char **out) {
    const fw_release *r = pf->release;
    double size = 0.0;
    answer a;
    static const char *const frame[] = {"<die frame=\"", "\"/>"},
                             *const bars[] = {"bars no wider than ", ""},
                             *const pitch[] = {"<die release-pitch=\"", "\"/>"};
    const char *const *what = frame;
    fw_mark mark = fw_arena_mark(plan->arena);
    if (r->weakest >= 0 && r->part[r->weakest].role == FW_ROLE_FRAME)
        FW_TRY(find_frame(plan, pf, &size, &a));
    if (size == 0.0 && is_bar(plan, &r->part[r->slowest])) {
        what = bars;
        FW_TRY(find_bars(plan, pf, &size, &a));
    }
    if (size == 0.0) {
        what = pitch;
        FW_TRY(find_pitch(plan, pf, &size, &a));
    }
    fw_arena_rewind(plan->arena, mark);
    if (size > 0.0) return words(plan, what, size, &a, out);
    FW_NEED(*out = fw_arena_printf(plan->arena,
                                   "none was found: no grid of release holes down to %.0f um, no "
                                   "wider frame and no narrower bars open one; anchors must be "
                                   "wider",
                                   1e6 * FINEST_M));
    return FW_OK;
}
