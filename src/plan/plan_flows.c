/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flows computed with what the mask of a die, or the plate of a wafer, hands to them: times, bias,
   judgement, and for a release the distances of the drawing and the least change that opens a window; and
   which measurement pays. */
#include "base/constants.h"
#include "base/text.h"
#include "base/sort.h"
#include "layout/layout_rules.h"
#include "plan/stages.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the release ----
   The least change that opens a window for it: the device is drawn again with it, its distances found again,
   and the flow judged with them.

   Tried are release holes, from the coarsest grid to the finest that can be drawn; where there are some,
   larger ones; narrower bars, where a bar is free last; and wider frame, bases and pads, whichever would be lost
   before all that moves is free, all by the same factor. Each is looked for from what is stated in steps, then,
   to 1 um, between the last that opens nothing and the first that does. Where none opens a window by itself,
   holes and wider anchors are tried together. In: a plan with a flow that has no window. Out: words for its
   reason, the least change first: of ln(new/old), new holes counted as a factor of e. Cost: some ten drawings
   for each, only for what is refused. Test: test_release_change.c. */

typedef enum knob {             /* what may be changed */
                    KNOB_PITCH, /* m */
                    KNOB_HOLE,
                    KNOB_BAR,
                    KNOB_WIDER, /* factor */
                    KNOBS
} knob;

typedef struct change {
    double size[KNOBS];              /* 0: as stated */
    double frame_m, anchor_m, pad_m; /* as drawn now, of those that are made wider; else 0 */
} change;

typedef struct answer {
    bool opens;
    double needed_m, lost_m;
} answer;

typedef struct proposal {
    change made;
    answer found;
    double far; /* how large the change is */
} proposal;

static const double FINEST_M = 27e-6, COARSEST_M = 400e-6, STEP_M = 1e-6, WIDEST = 6.0,
                    PAD_M = 150e-6, NARROWEST_BAR_M = 30e-6;

/* distances of a drawing from its openings, with the flow's own marks */
static fw_status solve_release(fw_plan *plan, fw_plan_flow *pf, const fw_layout *layout,
                               const fw_release **release) {
    const fw_layout *marked;
    fw_layout_no_room no_room;
    if (layout == plan->layout)
        FW_TRY(fw_plan_marked(plan, pf, &marked, &no_room));
    else
        FW_TRY(fw_mask_frame_marks(plan->arena, pf->table, layout, &marked, &no_room));
    return fw_release_solve(plan->arena, marked, fw_plan_insulated(pf),
                            fw_process_flow_frees_all(pf->flow), fw_process_flow_bond(pf->flow),
                            release);
}

static double to_grid(double x_m) {
    return STEP_M * round(x_m / STEP_M);
}

/* the device as changed: bodies are copied where bars become narrower */
static fw_status changed_device(fw_arena *arena, const fw_device *from, const change *c,
                                fw_device *to) {
    double bar = c->size[KNOB_BAR], wider = c->size[KNOB_WIDER];
    *to = *from;
    if (c->size[KNOB_PITCH] > 0.0) {
        to->release_pitch_m = c->size[KNOB_PITCH];
        to->release_hole_m = 0.0; /* in proportion */
    }
    if (c->size[KNOB_HOLE] > 0.0) to->release_hole_m = c->size[KNOB_HOLE];
    if (wider > 0.0 && c->frame_m > 0.0) to->die.frame_m = to_grid(wider * c->frame_m);
    if (wider > 0.0 && c->anchor_m > 0.0) to->die.anchor_m = to_grid(wider * c->anchor_m);
    if (wider > 0.0 && c->pad_m > 0.0) to->die.pad_m = to_grid(wider * c->pad_m);
    if (!(bar > 0.0)) return FW_OK;
    size_t n = (size_t)from->nbody;
    FW_NEED(to->body = fw_arena_grow(arena, from->body, n, n, sizeof *to->body));
    for (int i = 0; i < to->nbody; i++)
        if (to->body[i].width_m > bar) to->body[i].width_m = bar;
    return FW_OK;
}

/* drawn, measured and judged; *out.opens false where it cannot be drawn as whole as it is now, too */
static fw_status make_change(fw_plan *plan, fw_plan_flow *pf, const change *c, answer *out) {
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
    if (!layout || !layout->drawn || layout->nmissing > plan->layout->nmissing) return FW_OK;
    FW_TRY(solve_release(plan, pf, layout, &release));
    FW_TRY(fw_plan_mask_facts(plan->arena, &device, layout, NULL, &pf->variant, pf->table,
                              fw_plan_insulated(pf), &facts));
    facts.dies = plan->dies;
    facts.release = release;
    status = fw_process_flow_compute(plan->arena, pf->flow, &facts, &quiet);
    if (status == FW_INPUT) return FW_OK;
    FW_TRY(status);
    *out = (answer){!pf->flow->no_window, release->needed_m, release->lost_m};
    return FW_OK;
}

/* the same, and nothing of it is kept: a search makes some hundred drawings */
static fw_status try_change(fw_plan *plan, fw_plan_flow *pf, const change *c, answer *out) {
    fw_mark mark = fw_arena_mark(plan->arena);
    fw_status status = make_change(plan, pf, c, out);
    fw_arena_rewind(plan->arena, mark);
    return status;
}

/* One number alone, beside what *p has already: from `first` on by `ratio` up to `last`, then between the last
   that opens nothing (`fails` before the first) and the first that does. p->found.opens: it was found. */
static fw_status find_size(fw_plan *plan, fw_plan_flow *pf, knob k, double fails, double first,
                           double last, double ratio, proposal *p) {
    double step = k == KNOB_WIDER ? 0.01 : STEP_M, good = 0.0;
    p->found = (answer){0};
    for (double x = first; (ratio > 1.0 ? x <= last : x >= last) && good == 0.0; x *= ratio) {
        p->made.size[k] = step * round(x / step);
        FW_TRY(try_change(plan, pf, &p->made, &p->found));
        *(p->found.opens ? &good : &fails) = p->made.size[k];
    }
    if (good == 0.0) return FW_OK;
    answer best = p->found;
    while (fabs(good - fails) > 1.5 * step) {
        p->made.size[k] = step * round(0.5 * (good + fails) / step);
        FW_TRY(try_change(plan, pf, &p->made, &p->found));
        if (p->found.opens) best = p->found;
        *(p->found.opens ? &good : &fails) = p->made.size[k];
    }
    p->made.size[k] = good;
    p->found = best;
    return FW_OK;
}

/* the coarsest grid of holes: what a square grid leaves is some 0.56 of the pitch, and with its over-etch less
   than is lost */
static fw_status find_pitch(fw_plan *plan, fw_plan_flow *pf, double lost_m, proposal *p) {
    double was = plan->device->release_pitch_m, high = was > 0.0 ? was : COARSEST_M;
    FW_TRY(find_size(plan, pf, KNOB_PITCH, high, fmin(high, 2.0 * lost_m), FINEST_M, 0.82, p));
    p->far += was > 0.0 ? log(was / p->made.size[KNOB_PITCH]) : 1.0;
    return FW_OK;
}

static fw_status find_hole(fw_plan *plan, fw_plan_flow *pf, proposal *p) {
    double pitch = plan->device->release_pitch_m, was = plan->device->release_hole_m;
    if (!(pitch > 0.0)) return FW_OK;
    if (!(was > 0.0)) was = 0.3 * pitch;
    FW_TRY(find_size(plan, pf, KNOB_HOLE, was, 1.2 * was, 0.5 * pitch, 1.2, p));
    p->far = log(p->made.size[KNOB_HOLE] / was);
    return FW_OK;
}

/* the widest bars, where a bar is free last */
static fw_status find_bars(fw_plan *plan, fw_plan_flow *pf, proposal *p) {
    const fw_release_part *slow = &pf->release->part[pf->release->slowest];
    double widest = 0.0;
    if (slow->body < 0 || !(plan->device->body[slow->body].width_m > 0.0) ||
        plan->device->body[slow->body].plate_width_m > 0.0)
        return FW_OK;
    for (int i = 0; i < plan->device->nbody; i++)
        widest = fmax(widest, plan->device->body[i].width_m);
    FW_TRY(find_size(plan, pf, KNOB_BAR, widest, 0.95 * fmin(2.0 * pf->release->lost_m, widest),
                     NARROWEST_BAR_M, 0.85, p));
    p->far = log(widest / p->made.size[KNOB_BAR]);
    return FW_OK;
}

/* sizes of what would be lost before all that moves is free: frame, bases, pads; false: none */
static bool find_weak(const fw_plan *plan, const fw_plan_flow *pf, change *c) {
    const fw_release *r = pf->release;
    const fw_device_die *die = &plan->device->die;
    double reach, foot = pf->flow->release_foot_m;
    const fw_process_step *s = fw_process_flow_release_step(pf->flow, &reach);
    double run = s ? (r->needed_m + foot) * (1.0 + s->overrun) : 0.0;
    for (int i = 0; i < r->npart; i++) {
        const fw_release_part *p = &r->part[i];
        if (p->duty != FW_RELEASE_STAYS || p->kept_m + foot > run) continue;
        if (p->role == FW_ROLE_FRAME)
            c->frame_m = die->frame_m > 0.0 ? die->frame_m : fw_layout_rule.frame_m;
        else if (p->body == FW_ISLAND)
            c->pad_m = die->pad_m > 0.0 ? die->pad_m : PAD_M;
        else
            c->anchor_m = fmax(c->anchor_m, die->anchor_m > 0.0 ? die->anchor_m : 2.0 * p->reach_m);
    }
    return c->frame_m + c->anchor_m + c->pad_m > 0.0;
}

static fw_status find_wider(fw_plan *plan, fw_plan_flow *pf, proposal *p) {
    if (!find_weak(plan, pf, &p->made)) return FW_OK;
    FW_TRY(find_size(plan, pf, KNOB_WIDER, 1.0, 1.25, WIDEST, 1.25, p));
    p->far = log(p->made.size[KNOB_WIDER]);
    return FW_OK;
}

/* wider anchors, as little as may be in three steps, and with them the coarsest grid of holes */
static fw_status find_both(fw_plan *plan, fw_plan_flow *pf, proposal *p) {
    if (!find_weak(plan, pf, &p->made)) return FW_OK;
    for (double wider = 1.5; wider <= WIDEST && !p->found.opens; wider *= 1.6) {
        p->made.size[KNOB_WIDER] = 0.01 * round(100.0 * wider);
        FW_TRY(find_pitch(plan, pf, wider * pf->release->lost_m, p));
    }
    return FW_OK;
}

static void say_um(fw_text *text, const char *what, double m) {
    char um[32];
    fw_text_printf(text, " %s=\"%s um\"", what, fw_number_text(um, sizeof um, 1e6 * m, 4));
}

static void say(const proposal *p, fw_text *text) {
    const change *c = &p->made;
    double wider = c->size[KNOB_WIDER];
    char needed[32], lost[32];
    fw_text_add(text, text->length ? "; or " : "");
    if (c->size[KNOB_BAR] > 0.0) {
        char um[32];
        fw_text_printf(text, "bars no wider than %s um",
                       fw_number_text(um, sizeof um, 1e6 * c->size[KNOB_BAR], 4));
    } else {
        fw_text_add(text, "<die");
        if (c->size[KNOB_PITCH] > 0.0) say_um(text, "release-pitch", c->size[KNOB_PITCH]);
        if (c->size[KNOB_HOLE] > 0.0) say_um(text, "release-hole", c->size[KNOB_HOLE]);
        if (wider > 0.0 && c->frame_m > 0.0) say_um(text, "frame", to_grid(wider * c->frame_m));
        if (wider > 0.0 && c->anchor_m > 0.0) say_um(text, "anchor", to_grid(wider * c->anchor_m));
        if (wider > 0.0 && c->pad_m > 0.0) say_um(text, "pad", to_grid(wider * c->pad_m));
        fw_text_add(text, "/>");
    }
    fw_text_printf(text,
                   ": drawn and judged again, all that moves is free after %s um, and what must "
                   "stay holds for %s um",
                   fw_number_text(needed, sizeof needed, 1e6 * p->found.needed_m, 4),
                   fw_number_text(lost, sizeof lost, 1e6 * p->found.lost_m, 4));
}

static int by_far(const void *a, const void *b) {
    const proposal *p = a, *q = b;
    return fw_order_doubles(p->far, q->far);
}

/* of a flow without a window for its release: what opens one, in words. The flow is computed again by the caller */
static fw_status find_change(fw_plan *plan, fw_plan_flow *pf, const char **out) {
    enum { ALONE = 4 };
    proposal p[ALONE + 1] = {0};
    int n = 0;
    fw_mark mark = fw_arena_mark(plan->arena);
    FW_TRY(find_pitch(plan, pf, pf->release->lost_m, &p[0]));
    FW_TRY(find_hole(plan, pf, &p[1]));
    FW_TRY(find_bars(plan, pf, &p[2]));
    FW_TRY(find_wider(plan, pf, &p[3]));
    for (int i = 0; i < ALONE; i++)
        if (p[i].found.opens) p[n++] = p[i];
    if (n == 0) {
        p[0] = (proposal){0};
        FW_TRY(find_both(plan, pf, &p[0]));
        n = p[0].found.opens ? 1 : 0;
    }
    fw_arena_rewind(plan->arena, mark);
    qsort(p, (size_t)n, sizeof p[0], by_far);
    fw_text text = fw_text_new(plan->arena);
    for (int i = 0; i < n; i++)
        say(&p[i], &text);
    if (n == 0)
        fw_text_printf(
            &text,
            "none was found: no grid of release holes down to %.0f um, no larger holes, no "
            "narrower bars, and no frame, bases or pads up to %.0f times as wide open "
            "one, nor holes and wider anchors together",
            1e6 * FINEST_M, WIDEST);
    FW_TRY(fw_text_end(&text));
    *out = text.data;
    return FW_OK;
}

/* ---- times, bias, judgement ---- */

/* What one mask leaves standing, as drawn: + where a term of the plate draws, - where it takes away
   (lettering and marks lie within what they are taken out of). A test die has its bias, where a pattern
   wants it, in its outlines already. Of what a plate draws beside its dies that counts which lies over the
   wafer, of its edges as large a share as of its area */
static void add_mask(const fw_mask *mask, const fw_mask_plate_term *term, int nterm, int times,
                     const fw_wafer_form *beside, fw_process_mask_facts *facts) {
    for (int t = 0; t < nterm; t++)
        for (int i = 0; i < mask->nshape; i++) {
            const fw_mask_shape *shape = &mask->shape[i];
            const fw_geometry_contour *c = &shape->piece->contour;
            if (shape->layer != term[t].layer) continue;
            double sign = term[t].rule == FW_SET_NOT ? -1.0 : 1.0, share = times;
            if (beside)
                share *= fw_wafer_area_over(beside, &shape->polygon) /
                         (0.5e-18 * (double)fw_geometry_polygon_area2(&shape->polygon));
            facts->wafer_structure_m2 += sign * share * fw_geometry_contour_area(c);
            const double edges_m = share * fw_plan_free_perimeter(c);
            facts->wafer_perimeter_m += edges_m;
            if (mask->bias_m != 0.0 && mask->table->layer[shape->layer].biased)
                facts->wafer_biased_m += edges_m;
        }
}

/* what the plate of a wafer places, added to the facts of its die: exact areas and edges as
   drawn */
static fw_status add_wafer_facts(fw_arena *arena, const fw_wafer *wafer,
                                 fw_process_mask_facts *facts) {
    fw_mask_plate_term *term;
    int n;
    FW_TRY(fw_mask_plate_terms(arena, wafer->table, &term, &n));
    facts->wafer_structure_m2 = facts->wafer_perimeter_m = facts->wafer_biased_m = 0.0;
    for (int i = 0; i < wafer->ncell; i++)
        if (wafer->cell[i].mask)
            add_mask(wafer->cell[i].mask, term, n, wafer->cell[i].placed, NULL, facts);
    if (wafer->plate) add_mask(wafer->plate, term, n, 1, &wafer->form, facts);
    facts->wafer_diameter_m = wafer->form.diameter_m;
    for (int i = 0; i < wafer->grid.nsite; i++) {
        const fw_wafer_site *site = &wafer->grid.site[i];
        double x = fmax(fabs((double)site->x), fabs((double)site->x + wafer->grid.width)),
               y = fmax(fabs((double)site->y), fabs((double)site->y + wafer->grid.height));
        facts->wafer_reach_m = fmax(facts->wafer_reach_m, 1e-9 * hypot(x, y));
    }
    facts->wafer_area_m2 = fw_wafer_area(&wafer->form);
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
static fw_status facts_of(fw_plan *plan, fw_plan_flow *pf, fw_process_mask_facts *facts) {
    const fw_layout *marked = NULL;
    if (plan->layout && plan->layout->drawn) FW_TRY(fw_plan_marked(plan, pf, &marked, NULL));
    FW_TRY(fw_plan_mask_facts(plan->arena, plan->device, plan->layout, marked, &pf->variant,
                              pf->table, fw_plan_insulated(pf), facts));
    facts->dies = plan->dies;
    facts->release = pf->release;
    facts->hold = pf->hold;
    facts->release_change = pf->release_change;
    FW_TRY(fw_plan_join_swept(plan, plan->arena, (int)(pf - plan->flow), facts));
    return pf->wafer ? add_wafer_facts(plan->arena, pf->wafer, facts) : FW_OK;
}

/* a flow computed with its facts, and what would be made instead of what is refused */
static fw_status compute_flow(fw_plan *plan, fw_plan_flow *pf, const fw_process_redraw *redraw,
                              fw_diags *diags) {
    bool drawn = plan->layout && plan->layout->drawn;
    fw_process_mask_facts facts;
    fw_mask_verdict contents; /* hollows, pads: what the other plates draw */
    FW_TRY(release_of(plan, pf));
    FW_TRY(facts_of(plan, pf, &facts));
    FW_TRY(fw_mask_contents_judge(plan->arena, pf->table, plan->layout, &contents));
    facts.widest_hollow_m = contents.widest_hollow_m;
    facts.pads = contents.pads;
    facts.redraw = redraw;
    FW_TRY(fw_process_flow_compute(plan->arena, pf->flow, drawn ? &facts : NULL, diags));
    if (pf->flow->no_window && !facts.release_change && !redraw->judging) {
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
    if (!redraw->judging) FW_TRY(fw_plan_judge_alternatives(plan, pf));
    return fw_plan_wiring(plan, pf);
}

/* ---- a change that a flow would take, drawn ----
   Conjugate gaps, gaps of electrodes and release holes at least so wide, as whoever follows the proposal states them: the
   device is drawn anew, the flow computed with its facts, the mask drawn with the bias of that and its rules looked at. In:
   a plan that is judged, and a flow whose quantities are those to try. Out: what refuses. Cost: a drawing and a mask. Test:
   test_nearest_drawn.c. */

typedef struct redrawn_flow { /* what a flow is drawn anew of */
    fw_plan *plan;
    fw_plan_flow *pf;
    /* its cells are so fine that no mask with them is looked through to the end (FW-D592). No change of a gap mends that,
       and each drawing would take as long as theirs: they are left out */
    bool dense;
} redrawn_flow;

static fw_status widened_device(fw_arena *arena, const fw_device *from, double gap_m,
                                fw_device *to) {
    const size_t nflexure = (size_t)from->nflexure, nscene = (size_t)from->nscene;
    *to = *from;
    if (from->release_pitch_m > 0.0)
        to->release_hole_m = fmax(gap_m, from->release_hole_m > 0.0 ? from->release_hole_m
                                                                    : 0.3 * from->release_pitch_m);
    FW_NEED(to->flexure =
                fw_arena_grow(arena, from->flexure, nflexure, nflexure, sizeof *to->flexure));
    FW_NEED(to->scene = fw_arena_grow(arena, from->scene, nscene, nscene, sizeof *to->scene));
    for (int i = 0; i < to->nflexure; i++)
        if (to->flexure[i].gap_m > 0.0) to->flexure[i].gap_m = fmax(to->flexure[i].gap_m, gap_m);
    for (int i = 0; i < to->nscene; i++) {
        fw_device_scene *s = &to->scene[i];
        const size_t n = (size_t)s->ncomb;
        FW_NEED(s->comb = fw_arena_grow(arena, s->comb, n, n, sizeof *s->comb));
        for (int k = 0; k < s->ncomb; k++)
            s->comb[k].gap_m = fmax(s->comb[k].gap_m, gap_m);
    }
    return FW_OK;
}

/* *why: NULL where nothing refuses */
static fw_status judge_drawing(fw_plan *plan, fw_plan_flow *pf, const char **why) {
    const fw_process_redraw no_further = {.judging = true};
    FW_TRY(compute_flow(plan, pf, &no_further, &plan->diags));
    if (pf->flow->manufacturable != 0) FW_TRY(fw_plan_mask_examine(plan, pf, false));
    *why = pf->flow->manufacturable != 0 ? NULL
           : pf->mask_error              ? pf->mask_error
           : pf->flow->nreason > 0       ? pf->flow->reason[0]
                                         : "its steps";
    return FW_OK;
}

/* what a drawing lacks that the one before has; NULL: nothing */
static const char *lacks(fw_arena *arena, const fw_layout *before, const fw_layout *l,
                         const fw_diags *said) {
    const fw_layout_missing *m = l && l->nmissing ? &l->missing[l->nmissing - 1] : NULL;
    if (l && l->drawn && l->nmissing <= before->nmissing) return NULL;
    const char *why =
        m && l->drawn ? fw_arena_printf(arena, "its drawing: no room for %s, %s", m->name, m->why)
        : said->count > 0 ? said->item[0].message
                          : NULL;
    return why ? why : "its drawing";
}

static bool is_dense(const fw_device *device, const fw_diags *said) {
    bool cut = false;
    for (size_t i = 0; i < said->count; i++)
        cut = cut || said->item[i].number == 592;
    return cut && device->ncell > 0;
}

static fw_status draw_change(redrawn_flow *of, double gap_m, double thickness_m,
                             fw_process_redrawn *outcome, const char **why) {
    fw_plan other = *of->plan;
    fw_device device = *other.device;
    const size_t n = (size_t)other.nflow;
    bool outlines = false; /* what is narrowest stays as it is */
    fw_plan_flow *pf;
    other.diags = fw_diags_new(other.arena); /* nobody asked for this one */
    *outcome = FW_REDRAWN_REFUSED;
    FW_NEED(other.flow = fw_arena_grow(other.arena, other.flow, n, n, sizeof *other.flow));
    pf = &other.flow[of->pf - of->plan->flow];
    pf->wiring = NULL, pf->mask_error = NULL;
    pf->release_change = ""; /* not looked for */
    if (thickness_m > 0.0) pf->variant.thickness_m = thickness_m;
    if (gap_m > 0.0 || of->dense) {
        FW_TRY(widened_device(other.arena, other.device, gap_m, &device));
        if (of->dense) device.ncell = 0;
        other.device = &device;
        other.layout = NULL, other.swept = NULL; /* all of them would have such gaps */
        pf->release = NULL, pf->hold = NULL;
        fw_status status = fw_layout_build(other.arena, &device, &other.diags, &other.layout);
        if (status != FW_GEOMETRY && status != FW_INPUT) FW_TRY(status);
        *why = lacks(other.arena, of->plan->layout, other.layout, &other.diags);
        if (*why) return FW_OK;
        outlines =
            gap_m > 0.0 && !(other.layout->narrowest_gap_m > of->plan->layout->narrowest_gap_m);
    }
    *why = "its steps";
    fw_status status = judge_drawing(&other, pf, why);
    if (*why && is_dense(other.device, &other.diags)) {
        of->dense = true;
        return draw_change(of, gap_m, thickness_m, outcome, why);
    }
    if (status == FW_INPUT || status == FW_GEOMETRY) return FW_OK;
    *outcome = !*why ? FW_REDRAWN_MADE : outlines ? FW_REDRAWN_UNDECIDED : FW_REDRAWN_REFUSED;
    return status;
}

/* nothing of it is kept, but what the flow points to until it is computed again */
static fw_status redraw(void *context, double gap_m, double thickness_m,
                        fw_process_redrawn *outcome, char *why, size_t n) {
    redrawn_flow *of = context;
    const char *says;
    fw_mark mark = fw_arena_mark(of->plan->arena);
    fw_status status = draw_change(of, gap_m, thickness_m, outcome, &says);
    if (status == FW_OK && says) fw_text_cut(why, n, says);
    fw_arena_rewind(of->plan->arena, mark);
    return status;
}

/* what refuses is looked for with drawings, where masks are asked for at all */
static fw_status compute_and_propose(fw_plan *plan, fw_plan_flow *pf, fw_diags *diags) {
    redrawn_flow of = {plan, pf, false};
    const fw_process_redraw by = {.judge = plan->options.without_masks ? NULL : redraw,
                                  .context = &of,
                                  .judging = plan->options.without_changes};
    return compute_flow(plan, pf, &by, diags);
}

fw_status fw_plan_compute_flows(fw_plan *plan) {
    FW_TRY(fw_plan_count_dies(plan));
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].flow) {
            fw_arena_tell(plan->arena, "computing the steps", i, plan->nflow, "flows");
            FW_TRY(compute_and_propose(plan, &plan->flow[i], &plan->diags));
        }
    return FW_OK;
}

fw_status fw_plan_compute_wafers(fw_plan *plan) {
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow || !pf->wafer) continue;
        fw_diags said = fw_diags_new(plan->arena);
        FW_TRY(compute_and_propose(plan, pf, &said));
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
        FW_TRY(
            fw_plan_edge_facts(plan->arena, plan->device, layout, pf, &pf->variant, &of_verdict));
    if (judged_drawn)
        FW_TRY(fw_plan_join_swept(plan, plan->arena, (int)(pf - plan->flow), &of_verdict));
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
