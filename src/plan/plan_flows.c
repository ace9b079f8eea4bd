/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flows computed with what the mask of a die, or the plate of a wafer, hands to them: times, bias,
   judgement, and for a release the distances of the drawing and the least change that opens a window; and
   which measurement pays. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

/* ---- the release ----
   The least change that opens a window for it: the device is drawn again with it, its distances found again,
   and the flow judged with them.

   Tried are release holes, from the coarsest grid to the finest that can be drawn, then, to 1 um, between the
   last pitch that opens nothing and the first that does; a wider frame, where the frame is lost first; and
   narrower bars, where bars alone come free too late. In: a plan with a flow that has no window. Out: words
   for its reason. Cost: some ten drawings, only for what is refused. Test: test_release_change.c. */

typedef struct change {
    double pitch_m, frame_m, bar_m; /* 0: as stated */
} change;

typedef struct answer {
    bool opens;
    double needed_m, lost_m;
} answer;

static const double FINEST_M = 27e-6, COARSEST_M = 400e-6, STEP_M = 1e-6;

/* distances of a drawing from its openings, with the flow's own marks */
static fw_status solve_release(fw_plan *plan, const fw_plan_flow *pf, const fw_layout *layout,
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
    FW_TRY(solve_release(plan, pf, layout, &release));
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

/* of a flow without a window for its release: what opens one, in words. The flow is computed again by the caller */
static fw_status find_change(fw_plan *plan, fw_plan_flow *pf, const char **out) {
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

/* ---- times, bias, judgement ---- */

/* what one mask leaves standing, as drawn: + where a term of the plate draws, - where it takes away
   (lettering and marks lie within what they are taken out of) */
static void add_mask(const fw_mask *mask, const fw_mask_plate_term *term, int nterm, int times,
                     fw_process_mask_facts *facts) {
    for (int t = 0; t < nterm; t++)
        for (int i = 0; i < mask->nshape; i++) {
            const fw_geometry_contour *c = &mask->shape[i].piece->contour;
            if (mask->shape[i].layer != term[t].layer) continue;
            double sign = term[t].rule == FW_SET_NOT ? -1.0 : 1.0;
            facts->wafer_structure_m2 += sign * times * fw_geometry_contour_area(c);
            facts->wafer_perimeter_m += times * fw_plan_free_perimeter(c);
        }
}

/* what the plate of a wafer places, added to the facts of its die: exact areas and edges as
   drawn */
static fw_status add_wafer_facts(fw_arena *arena, const fw_wafer *wafer,
                                 fw_process_mask_facts *facts) {
    fw_mask_plate_term *term;
    int n;
    FW_TRY(fw_mask_plate_terms(arena, wafer->table, &term, &n));
    facts->wafer_structure_m2 = facts->wafer_perimeter_m = 0.0;
    for (int i = 0; i < wafer->ncell; i++)
        if (wafer->cell[i].mask)
            add_mask(wafer->cell[i].mask, term, n, wafer->cell[i].placed, facts);
    facts->wafer_diameter_m = wafer->form.diameter_m;
    for (int i = 0; i < wafer->grid.nsite; i++) {
        const fw_wafer_site *site = &wafer->grid.site[i];
        double x = fmax(fabs((double)site->x), fabs((double)site->x + wafer->grid.width)),
               y = fmax(fabs((double)site->y), fabs((double)site->y + wafer->grid.height));
        facts->wafer_reach_m = fmax(facts->wafer_reach_m, 1e-9 * hypot(x, y));
    }
    facts->wafer_area_m2 =
        (double)wafer->grid.nsite * wafer->grid.width * wafer->grid.height * 1e-18;
    return FW_OK;
}

/* distances from the openings of the device with the flow's own marks, once */
static fw_status release_of(fw_plan *plan, fw_plan_flow *pf) {
    if (pf->release || !plan->layout || !plan->layout->drawn) return FW_OK;
    if (!fw_process_flow_releases(pf->flow)) return FW_OK;
    FW_TRY(solve_release(plan, pf, plan->layout, &pf->release));
    return fw_release_hold_find(plan->arena, plan->device, plan->layout, pf->release, &pf->hold);
}

/* what the times and the judgement of a flow are computed with: of the wafer where it is laid out */
static fw_status facts_of(fw_plan *plan, const fw_plan_flow *pf, fw_process_mask_facts *facts) {
    FW_TRY(fw_plan_mask_facts(plan->arena, plan->device, plan->layout, &pf->variant, pf->table,
                              fw_plan_insulated(pf), facts));
    facts->dies = plan->dies;
    facts->release = pf->release;
    facts->hold = pf->hold;
    facts->release_change = pf->release_change;
    return pf->wafer ? add_wafer_facts(plan->arena, pf->wafer, facts) : FW_OK;
}

/* a flow computed with its facts */
static fw_status compute_flow(fw_plan *plan, fw_plan_flow *pf, fw_diags *diags) {
    bool drawn = plan->layout && plan->layout->drawn;
    fw_process_mask_facts facts;
    fw_mask_verdict contents; /* hollows, pads: what the other plates draw */
    FW_TRY(release_of(plan, pf));
    FW_TRY(facts_of(plan, pf, &facts));
    FW_TRY(fw_mask_contents_judge(plan->arena, pf->table, plan->layout, &contents));
    facts.widest_hollow_m = contents.widest_hollow_m;
    FW_TRY(fw_process_flow_compute(plan->arena, pf->flow, drawn ? &facts : NULL, diags));
    if (pf->flow->no_window && !pf->release_change) {
        fw_diags said = fw_diags_new(plan->arena);
        FW_TRY(find_change(plan, pf, &pf->release_change));
        facts.release_change = pf->release_change;
        FW_TRY(fw_process_flow_compute(plan->arena, pf->flow, &facts, &said));
    }
    for (int i = 0; i < contents.n; i++)
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, 0, contents.reason[i]));
    FW_TRY(fw_plan_check_hollows(plan, pf, diags));
    fw_process_drive_facts *drive;
    int n;
    FW_TRY(fw_plan_find_drives(plan->arena, plan->device, pf->variant.flow, &drive, &n));
    FW_TRY(fw_process_flow_judge_drives(plan->arena, pf->flow,
                                        pf->use && pf->use->insulating_carrier, drive, n, diags));
    return fw_plan_wiring(plan, pf);
}

fw_status fw_plan_compute_flows(fw_plan *plan) {
    FW_TRY(fw_plan_count_dies(plan));
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].flow) {
            fw_arena_tell(plan->arena, "computing the steps", i, plan->nflow, "flows");
            FW_TRY(compute_flow(plan, &plan->flow[i], &plan->diags));
        }
    return FW_OK;
}

fw_status fw_plan_compute_wafers(fw_plan *plan) {
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow || !pf->wafer) continue;
        fw_diags said = fw_diags_new(plan->arena);
        FW_TRY(compute_flow(plan, pf, &said));
        if (pf->mask_error)
            FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, 0, pf->mask_error));
    }
    return FW_OK;
}

/* ---- which measurement pays ----
   Of the flows of a plan: what is asked for and when; the work is measuring/'s. */

/* Bands cost the corners once more for every input. Where what a flow makes is undecided and changes are
   searched for they are a small part of that; else they are asked for. */
static bool wanted(const fw_plan *plan, const fw_verdict_variant_verdict *v, bool written,
                   bool *bands) {
    bool undecided = v->fabricated && v->fabricated->decision == FW_INCONCLUSIVE;
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    *bands = true;
    switch (plan->options.measurements) {
    case FW_MEASUREMENTS_NONE:
        return false;
    case FW_MEASUREMENTS_ALL:
        return true;
    case FW_MEASUREMENTS_AUTO:
        break;
    }
    *bands = undecided && plan->options.verdict.with_advice;
    return *bands || (written && given);
}

static fw_status find(fw_plan *plan, fw_plan_flow *pf, const fw_verdict_variant_verdict *v,
                      bool bands) {
    const fw_layout *layout = plan->verdict.layout;
    bool judged_drawn = layout && layout->drawn, drawn = plan->layout && plan->layout->drawn;
    fw_process_mask_facts of_verdict, of_times;
    fw_process_flow *flow;
    if (judged_drawn)
        FW_TRY(fw_plan_mask_facts(plan->arena, plan->device, layout, &pf->variant, pf->table,
                                  fw_plan_insulated(pf), &of_verdict));
    FW_TRY(facts_of(plan, pf, &of_times));
    FW_TRY(fw_plan_flow_again(plan, pf, &flow));
    const fw_measuring_request request = {.device = plan->device,
                                          .layout = layout,
                                          .options = &plan->options.verdict,
                                          .bands = bands,
                                          .verdict = v,
                                          .flow = flow,
                                          .drawn = judged_drawn ? &of_verdict : NULL,
                                          .facts = drawn ? &of_times : NULL};
    return fw_measuring_run(plan->arena, &request, &pf->measuring);
}

fw_status fw_plan_measurements_find(fw_plan *plan, bool written) {
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
        bool bands;
        if (!pf->flow || !wanted(plan, v, written, &bands)) continue;
        if (pf->measuring && pf->measured_on == pf->wafer) continue;
        FW_TRY(find(plan, pf, v, bands));
        pf->measured_on = pf->wafer; /* with a plate the times are others */
    }
    return FW_OK;
}
