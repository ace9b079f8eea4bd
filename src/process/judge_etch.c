/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/pack.h"
#include "process/films.h"
#include "process/process_law.h"
#include <math.h>
#include <string.h>

/* u(z) = (1 - A)(E - z), E = R T the depth the floor would have reached in the whole time: the wall
   at depth z is exposed from z/R on. w m, A 1, depth and E m. w_top = w - 2u(0), w_bottom = w -
   2u(depth); negative where the beam is gone. Constant lateral rate (1 - A) R.
   Source: docs/theory/etching.md. Test: test_undercut.c, table. */
void fw_process_undercut_widths(double width_m, double anisotropy, double depth_m, double etched_m,
                                double *top_m, double *bottom_m) {
    double loss = 2.0 * (1.0 - anisotropy);
    *top_m = width_m - loss * etched_m;
    *bottom_m = width_m - loss * fmax(0.0, etched_m - depth_m);
}

/* k/k0 = (wb^4 - wt^4)/(4 (wb - wt) w0^3): I = h (wb^4 - wt^4)/(48 (wb - wt)) integrated over the
   depth; where the wall is gone (negative width) nothing is added, while the slope stays that of
   the whole wall. Equal widths: (w/w0)^3. Test: test_undercut.c, table. */
double fw_process_undercut_stiffness(double top_m, double bottom_m, double w0_m) {
    double t = fmax(top_m, 0.0) / w0_m, b = fmax(bottom_m, 0.0) / w0_m;
    double share = 1.0; /* of the depth that is left, where an edge is gone */
    if ((top_m < 0.0) != (bottom_m < 0.0)) share = fabs(b - t) * w0_m / fabs(bottom_m - top_m);
    return share * (b * b + t * t) * (b + t) / 4.0;
}

double fw_process_undercut_cut(double width_m, double etched_m) {
    return 1.0 - width_m / (2.0 * etched_m);
}

static double ratio(double A, double width_m, double depth_m, double etched_m, int straight) {
    double top, bottom;
    fw_process_undercut_widths(width_m, A, depth_m, etched_m, &top, &bottom);
    return fw_process_undercut_stiffness(top, straight ? top : bottom, width_m);
}

/* Bisection on k/k0(A) = 1 - tolerance; the ratio rises with A and is 1 at A = 1. Error 1e-15.
   Test: test_undercut.c, needed. */
double fw_process_undercut_needed(double width_m, double depth_m, double etched_m, double tolerance,
                                  int straight) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; i++) {
        double A = 0.5 * (low + high);
        if (ratio(A, width_m, depth_m, etched_m, straight) >= 1.0 - tolerance)
            high = A;
        else
            low = A;
    }
    return high;
}

/* b = 1.5 sqrt(lambda (g + h/2)). lambda, gap g, resist h m; b m. Fresnel shadow of a mask edge in
   the middle of the resist. Source: textbook, e.g. Madou, Fundamentals of Microfabrication.
   Test: test_undercut.c, print_limit. */
double fw_process_print_limit(double wavelength_m, double gap_m, double resist_m) {
    return 1.5 * sqrt(wavelength_m * (gap_m + resist_m / 2.0));
}

/* What etches do to edges and gaps, in words: the numbers are those of the fixed point. */

static bool has_flexure(const fw_process_judge *j) {
    return j->facts && j->facts->deepest_hinge_width_m > 0.0 &&
           isfinite(j->facts->deepest_hinge_width_m);
}

static const char *next(const fw_process_judge *j) {
    return j->note.length ? "; " : "";
}

/* a masked wet etch runs under its mask by d (1 + overrun) at every edge: known, so compensated */
static fw_status isotropic_loss(fw_process_judge *j, const fw_process_step *s,
                                const fw_process_change *c) {
    fw_process_numbers t = {0};
    double depth = fw_process_judge_known(c->thickness);
    if (isnan(depth))
        return fw_process_judge_reason(
            j, FW_ANSWER_OPEN, "step %s etches sideways by its own depth, which is not known",
            s->id);
    fw_text_printf(
        &j->note,
        "%sstep %s etches %s um of %s isotropically with %s %% over-etch: %s um are lost "
        "at every edge and the mask adds them",
        next(j), s->id, fw_process_judge_um(&t, depth), c->material,
        fw_process_judge_number(&t, 100.0 * s->overrun, 3),
        fw_process_judge_um(&t, depth * (1.0 + s->overrun)));
    return FW_OK;
}

static fw_status wet(fw_process_judge *j) {
    for (int i = 0; i < j->flow->nstep; i++)
        for (int k = 0; k < j->flow->step[i].nchange; k++) {
            const fw_process_step *s = &j->flow->step[i];
            if (s->change[k].isotropic &&
                fw_process_where_is_of_device(j->flow, s->change[k].where))
                FW_TRY(isotropic_loss(j, s, &s->change[k]));
        }
    return FW_OK;
}

/* what is known of printing: pulled back by as much as edges print outside */
static void printed(fw_process_judge *j) {
    fw_process_numbers t = {0};
    double by = j->flow->edges.printed_m;
    if (by == 0.0) return;
    fw_text_printf(
        &j->note,
        "%sedges are known to come out %s um %s where they are drawn and the mask %s that", next(j),
        fw_process_judge_um(&t, fabs(by)), by < 0.0 ? "outside" : "inside",
        by < 0.0 ? "takes back" : "adds");
}

/* what wet steps take of the device when it stands: known, so compensated in width, not in
 * thickness */
static fw_status worn(fw_process_judge *j) {
    fw_process_numbers t = {0};
    const fw_process_wear w = j->flow->edges.wear;
    if (!w.step) return FW_OK;
    if (w.loss_m > 0.0)
        fw_text_printf(
            &j->note,
            "%sstep %s takes %s um of every open face of the device: the mask adds them at "
            "every edge, and the layer ends as much thinner",
            next(j), w.step->id, fw_process_judge_um(&t, w.loss_m));
    if (!w.missing) return FW_OK;
    if (w.never)
        return fw_process_judge_reason(
            j, FW_ANSWER_NO,
            "step %s takes %s from every open face of the device for a time that needs %s: before "
            "the mask is made nobody can say how much, so that it is neither compensated nor "
            "judged. Nearest change: a time or a rate of the step's own",
            w.step->id, fw_process_flow_material_name(j->flow, w.exposed->material), w.missing);
    return fw_process_judge_reason(
        j, FW_ANSWER_OPEN,
        "step %s takes %s from every open face of the device; how much is not known "
        "(%s), and not compensated",
        w.step->id, fw_process_flow_material_name(j->flow, w.exposed->material), w.missing);
}

/* ---- an anisotropy that nobody knows ---- */

static void note_unknown(fw_process_judge *j, const fw_process_cut *c) {
    fw_process_numbers t = {0};
    double E = c->etched_m;
    const fw_process_fixed_point *p = &j->flow->edges;
    const char *deep = fw_process_judge_um(&t, E);
    fw_text_printf(&j->note,
                   "%sthe lateral etch of step %s is NOT in the bias, because the anisotropy A is "
                   "not stated: in its whole time, over-etch included, the top edge loses (1 - A) "
                   "%s um per side; at A = 0.99, 0.95, 0.9 that is %s, %s, %s um",
                   next(j), c->step->id, deep, fw_process_judge_um(&t, 0.01 * E),
                   fw_process_judge_um(&t, 0.05 * E), fw_process_judge_um(&t, 0.1 * E));
    if (isnan(c->low) || isnan(p->low_m) || isnan(p->high_m)) return;
    fw_process_numbers r = {0};
    fw_text_printf(&j->note,
                   "; the range assumed for the verdict, A = %s to %s, would ask for a bias of %s "
                   "to %s um",
                   fw_process_judge_number(&r, c->low, 4), fw_process_judge_number(&r, c->high, 4),
                   fw_process_judge_um(&r, p->high_m), fw_process_judge_um(&r, p->low_m));
}

static fw_status anisotropy_unknown(fw_process_judge *j, const fw_process_cut *c) {
    fw_process_numbers t = {0};
    const char *id = c->step->id;
    double planned = c->planned_m, depth = c->depth_m;
    note_unknown(j, c);
    if (!has_flexure(j))
        return fw_process_judge_reason(
            j, FW_ANSWER_OPEN,
            "not guaranteed until the anisotropy of step %s is measured; the mask "
            "names no flexure to judge",
            id);
    double w = j->facts->deepest_hinge_width_m;
    const char *width = fw_process_judge_um(&t, w), *deep = fw_process_judge_um(&t, depth);
    FW_TRY(fw_process_judge_reason(
        j, FW_ANSWER_OPEN,
        "not guaranteed until the anisotropy A of step %s is measured: the top edge of the "
        "narrowest flexure (%s um wide, %s um deep) is cut through at A = %s in the nominal "
        "time and at A = %s with 20 %% over-etch",
        id, width, deep, fw_process_judge_number(&t, fw_process_undercut_cut(w, planned), 4),
        fw_process_judge_number(&t, fw_process_undercut_cut(w, 1.2 * planned), 4)));
    fw_process_numbers n = {0};
    return fw_process_judge_reason(
        j, FW_ANSWER_OPEN,
        "a stiffness within 10 %% of the drawn one needs A >= %s (tapered wall, nominal "
        "time), %s (10 %% over-etch), %s (straight wall, full undercut)",
        fw_process_judge_number(&n, fw_process_undercut_needed(w, depth, planned, 0.1, 0), 4),
        fw_process_judge_number(&n, fw_process_undercut_needed(w, depth, 1.1 * planned, 0.1, 0), 4),
        fw_process_judge_number(&n, fw_process_undercut_needed(w, depth, planned, 0.1, 1), 4));
}

/* ---- a known one ---- */

static void note_known(fw_process_judge *j, const fw_process_cut *c) {
    static const char *const face[] = {[FW_FACE_MIDDLE] = "at mid-depth",
                                       [FW_FACE_TOP] = "at the top edge",
                                       [FW_FACE_BOTTOM] = "at the bottom edge"};
    fw_process_numbers t = {0};
    fw_text_printf(&j->note,
                   "%sstep %s undercuts by %s um %s (A = %s, whole time for %s um with %s %% "
                   "over-etch) and the mask adds that",
                   next(j), c->step->id, fw_process_judge_um(&t, c->mask_m),
                   c->device ? face[c->compensate] : "at the foot of its layer",
                   fw_process_judge_number(&t, c->anisotropy, 4),
                   fw_process_judge_um(&t, c->planned_m),
                   fw_process_judge_number(&t, 100.0 * c->overrun, 3));
}

static fw_status anisotropy_known(fw_process_judge *j, const fw_process_cut *c) {
    fw_process_numbers t = {0};
    note_known(j, c);
    if (!has_flexure(j) || !c->device || j->flow->edges.ncls == 0) return FW_OK;
    double w = j->facts->deepest_hinge_width_m;
    const fw_process_edge e = j->flow->edges.cls[j->flow->edges.field].edge;
    double top = w + 2.0 * e.top_m, bottom = w + 2.0 * e.bottom_m;
    double ratio = fw_process_undercut_stiffness(top, bottom, w);
    fw_process_answer weight = top <= 0.0                ? FW_ANSWER_NO
                               : fabs(ratio - 1.0) > 0.1 ? FW_ANSWER_OPEN
                                                         : FW_ANSWER_FINE;
    if (weight == FW_ANSWER_NO)
        fw_diag_warning(
            j->diags, 184, c->step->place,
            "in flow %s step %s etches the top edge of the narrowest flexure away: %s um drawn, "
            "%s um left at A = %s",
            j->flow->id, c->step->id, fw_process_judge_um(&t, w),
            fw_process_judge_um(&t, fmax(top, 0.0)), fw_process_judge_number(&t, c->anisotropy, 4));
    fw_process_numbers n = {0};
    return fw_process_judge_reason(
        j, weight,
        "with A = %s and the biased mask the narrowest flexure is %s um wide at the top and "
        "%s um at the bottom: its stiffness is %s of the drawn one%s",
        fw_process_judge_number(&n, c->anisotropy, 4), fw_process_judge_um(&n, fmax(top, 0.0)),
        fw_process_judge_um(&n, fmax(bottom, 0.0)), fw_process_judge_number(&n, ratio, 4),
        weight == FW_ANSWER_NO ? "; its edge is gone. Nearest change: a wider flexure, a thinner "
                                 "layer or a more anisotropic etch"
                               : "");
}

/* ---- narrow openings fall behind ---- */

/* neither the time of the step nor all that it takes sideways: the mask adds what that is at least */
static fw_status lag_unknown(fw_process_judge *j, const fw_process_cut *c) {
    fw_process_numbers t = {0};
    if (c->mask_m > 0.0)
        fw_text_printf(&j->note,
                       "%sstep %s undercuts by at least %s um (A = %s, without any lag) and the "
                       "mask adds that",
                       next(j), c->step->id, fw_process_judge_um(&t, c->mask_m),
                       fw_process_judge_number(&t, c->anisotropy, 4));
    return fw_process_judge_reason(
        j, FW_ANSWER_OPEN,
        "how narrow openings fall behind in step %s is not known, so that neither its time nor its "
        "undercut is%s",
        c->step->id, c->mask_m > 0.0 ? ": what it takes at least is in the bias" : "");
}

/* depth of the floor after the time in which a wide opening is through, by bisection */
static double depth_in_wide_time(const fw_process_cut *c, double w_m) {
    double low = 0.0, high = c->depth_m;
    for (int i = 0; i < 60; i++) {
        double d = 0.5 * (low + high);
        if (d + fw_process_cut_lag(c, w_m, d) < c->depth_m)
            low = d;
        else
            high = d;
    }
    return low;
}

/* An over-etch with which the whole flow refuses nothing, and openings: of a flow that is refused those that are enough,
   else as wide as those that come through by what was computed */
static fw_status come_through(fw_process_judge *j, const char **text) {
    const fw_process_flow *f = j->flow;
    fw_process_numbers t = {0};
    const bool over = f->nearest_known && !isnan(f->nearest_overetch);
    const char *openings;
    FW_TRY(fw_process_judge_openings(j, &openings));
    FW_NEED(*text = fw_arena_printf(
                j->arena, "%s%s%s%s", over ? "an over-etch of " : "no over-etch alone is enough",
                over ? fw_process_judge_number(&t, f->nearest_overetch, 3) : "",
                over ? ", or " : "; ",
                openings ? openings : "openings as wide as those that come through"));
    return FW_OK;
}

/* too short a time for an opening: no by a measured lag, open by an assumed one */
static fw_status not_through(fw_process_judge *j, const fw_process_cut *c,
                             const fw_process_edge_class *k, bool firm) {
    fw_process_numbers t = {0};
    double times = k->reach_m / c->planned_m;
    const char *change;
    j->flow->behind = (int)(c->step - j->flow->step);
    /* in hundredths, upwards: the mask follows the time, and the opening with it, by less than that */
    j->flow->behind_overetch = ceil(100 * (times - 1) + 0.1) / 100;
    fw_diag_warning(j->diags, 183, c->step->place,
                    "in flow %s the %s (%s um drawn, %s um in the masking layer) is not etched "
                    "through within the time of step %s, over-etch included: it needs %s times "
                    "the planned time; widen it or plan the step for the narrowest opening",
                    j->flow->id, k->name, fw_process_judge_um(&t, k->drawn_m),
                    fw_process_judge_um(&t, k->opening_m), c->step->id,
                    fw_process_judge_number(&t, times, 4));
    FW_TRY(come_through(j, &change));
    FW_TRY(fw_process_judge_reason(
        j, firm ? FW_ANSWER_NO : FW_ANSWER_OPEN,
        "the %s does not come through in step %s: it needs %s times the planned time, over-etch "
        "included %s. Nearest change: %s",
        k->name, c->step->id, fw_process_judge_number(&t, times, 4),
        fw_process_judge_number(&t, 1.0 + c->overrun, 4), change));
    if (j->verdict != FW_ANSWER_NO) j->flow->fails = j->flow->reason[j->flow->nreason - 1];
    return FW_OK;
}

static fw_status lag(fw_process_judge *j, const fw_process_cut *c) {
    fw_process_numbers t = {0};
    const fw_process_fixed_point *p = &j->flow->edges;
    if (c->lag == FW_LAG_NONE || isnan(c->lag_value) || p->ncls == 0) return FW_OK;
    const fw_process_edge_class *k = &p->cls[0];
    if (k->kind == FW_GAP_FIELD || !(c->lag_value > 0.0)) return FW_OK;
    bool firm = c->lag_quantity && fw_process_status_firm(c->lag_quantity->status);
    double deep = depth_in_wide_time(c, k->opening_m);
    const char *how = c->follows ? "is planned for" : "would need";
    const char *opening = fw_process_judge_um(&t, k->opening_m),
               *got = fw_process_judge_um(&t, deep), *of = fw_process_judge_um(&t, c->depth_m);
    FW_TRY(fw_process_judge_reason(
        j, firm ? FW_ANSWER_FINE : FW_ANSWER_OPEN,
        "the %s is %s um wide in the layer that masks step %s: in the time of wide openings it "
        "reaches %s of %s um, and the step %s %s times that time to bring it through (neutral "
        "transport, %s = %s %s%s)",
        k->name, opening, c->step->id, got, of, how,
        fw_process_judge_number(&t, k->reach_m / c->depth_m, 4),
        c->lag == FW_LAG_LINEAR ? "c" : "S", fw_process_judge_number(&t, c->lag_value, 3),
        c->lag_quantity ? fw_quantity_value_status_text(c->lag_quantity->status) : "",
        firm ? "" : ": etch slots of several widths on a dummy wafer and measure their depths"));
    for (int i = 0; i < p->ncls; i++)
        if (p->cls[i].over_etch < -1e-9) return not_through(j, c, &p->cls[i], firm);
    return FW_OK;
}

/* ---- no bias at all ---- */

static fw_status unsolved(fw_process_judge *j) {
    const fw_process_fixed_point *p = &j->flow->edges;
    if (p->solved) return FW_OK;
    fw_process_numbers t = {0};
    const char *what = p->ncls ? p->cls[0].name : "opening", *change;
    double drawn = p->ncls ? p->cls[0].drawn_m : 0.0;
    const char *wide = fw_process_judge_um(&t, drawn);
    FW_TRY(fw_process_judge_nearest(j, &change));
    fw_diag_warning(j->diags, 181, j->flow->place,
                    "in flow %s bias, etch time and gap have no common solution: the mask would "
                    "have to close the %s, %s um as drawn",
                    j->flow->id, what, wide);
    return fw_process_judge_reason(
        j, FW_ANSWER_NO,
        "no mask brings the edges to where they are drawn: what is added against the undercut "
        "narrows the %s (%s um drawn), a narrower one takes longer to etch through, and the longer "
        "etch undercuts more than was added, until it is closed. Nearest change: %s",
        what, wide, change);
}

/* a narrow slot must still be open on the mask after the bias was added on both sides */
static fw_status open_slot(fw_process_judge *j) {
    fw_process_numbers t = {0};
    double bias = j->flow->bias_m;
    double left = j->facts ? j->facts->narrowest_slot_m - 2.0 * bias : 1.0;
    if (left > 0.0 || !j->flow->edges.solved) return FW_OK;
    const char *by = fw_process_judge_um(&t, bias),
               *slot = fw_process_judge_um(&t, j->facts->narrowest_slot_m);
    fw_diag_warning(j->diags, 181, j->flow->place,
                    "in flow %s the compensation of %s um per edge closes the narrowest slot of %s "
                    "um on the mask",
                    j->flow->id, by, slot);
    const char *change;
    FW_TRY(fw_process_judge_nearest(j, &change));
    return fw_process_judge_reason(
        j, FW_ANSWER_NO,
        "the compensation of %s um per edge closes the narrowest slot of %s um on the mask. "
        "Nearest change: %s",
        by, slot, change);
}

fw_status fw_process_judge_etching(fw_process_judge *j) {
    const fw_process_fixed_point *p = &j->flow->edges;
    FW_TRY(wet(j));
    printed(j);
    FW_TRY(worn(j));
    FW_TRY(unsolved(j));
    for (int k = 0; k < p->ncut; k++) {
        const fw_process_cut *c = &p->cut[k];
        if (isnan(c->etched_m))
            FW_TRY(lag_unknown(j, c));
        else if (isnan(c->anisotropy))
            FW_TRY(anisotropy_unknown(j, c));
        else if (p->solved)
            FW_TRY(anisotropy_known(j, c));
        if (c->device) FW_TRY(lag(j, c));
    }
    return open_slot(j);
}

/* ---- what the computed times do to the layers ----
   Known only with the mask and the thickness of the device. Test: test_lint.c, loss, mould. */

/* thickness of what lies outermost on a face of a column and is all of one material, or below films that have holes; NaN: a
   part is unknown */
static double top_layer(const fw_process_flow *flow, const fw_process_stack *stack, int column,
                        const char *material, bool back) {
    double sum = 0.0;
    const int n = stack->n[column];
    for (int i = 0; i < n; i++) {
        const fw_process_cell *c = &stack->cell[column][back ? i : n - 1 - i];
        const fw_process_material *m = fw_process_flow_material(flow, c->material);
        const bool same = strcmp(c->material, material) == 0;
        if (!same && !(sum == 0.0 && m && m->holes)) break;
        if (same) sum += c->thickness_m;
    }
    return sum;
}

/* The thickness of a material that lies open on a face in a column, where step `by` works; 0: it does not, or the step does
   not reach that face. Columns of the back follow those of the front. */
static double open_in(const fw_process_flow *flow, const fw_process_stack *stack,
                      const fw_process_step *by, const char *material, int column) {
    const bool back = column >= stack->columns;
    return fw_process_step_meets(by, back)
               ? top_layer(flow, stack, column % stack->columns, material, back)
               : 0.0;
}

/* before step index, and after it */
static fw_status stacks_about(fw_arena *arena, const fw_process_flow *flow, int index,
                              fw_process_stack stack[2]) {
    FW_TRY(fw_process_flow_stack(arena, flow, index - 1, &stack[0], NULL));
    return fw_process_flow_stack(arena, flow, index, &stack[1], NULL);
}

/* does the step put the material there anew? */
static bool adds(const fw_process_step *s, const char *material) {
    for (int k = 0; k < s->nchange; k++)
        if (strcmp(s->change[k].kind, "add") == 0 && strcmp(s->change[k].material, material) == 0)
            return true;
    return false;
}

typedef struct taken { /* of a layer in each column of both faces, m */
    double nominal_m[2 * FW_STACK_MOST], most_m[2 * FW_STACK_MOST];
} taken;

/* what steps since the material was put there took of it where it lay open */
static fw_status taken_before(fw_arena *arena, const fw_process_flow *flow, int index,
                              const char *material, taken *sum) {
    *sum = (taken){0};
    for (int i = index - 1; i >= 0 && !adds(&flow->step[i], material); i--) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->nexposed; k++) {
            fw_process_stack stack[2];
            double most, loss = fw_process_exposed_loss(s, &s->exposed[k], &most);
            if (strcmp(s->exposed[k].material, material) != 0 || isnan(loss)) continue;
            FW_TRY(stacks_about(arena, flow, i, stack));
            for (int column = 0; column < 2 * stack[0].columns; column++) {
                if (!(open_in(flow, &stack[0], s, material, column) > 0.0) &&
                    !(open_in(flow, &stack[1], s, material, column) > 0.0))
                    continue;
                sum->nominal_m[column] += loss;
                sum->most_m[column] += most;
            }
        }
    }
    return FW_OK;
}

/* Laid open by the step alone, which is timed for what it takes off: bare only from when that is through. */
static fw_status uncovers(fw_arena *arena, const fw_process_flow *flow, int index,
                          fw_process_exposed *x) {
    const fw_process_step *s = &flow->step[index];
    const fw_quantity *timed = fw_process_step_argument(s, "thickness");
    bool before = false, after = false, through = false;
    fw_process_stack stack[2];
    if (!timed) timed = fw_process_step_argument(s, "depth");
    for (int k = 0; k < s->nchange && timed; k++)
        through = through ||
                  (strcmp(s->change[k].kind, "remove") == 0 && s->change[k].thickness == timed);
    x->uncovered = false;
    if (!through) return FW_OK;
    FW_TRY(stacks_about(arena, flow, index, stack));
    for (int column = 0; column < 2 * stack[0].columns; column++) {
        before = before || open_in(flow, &stack[0], s, x->material, column) > 0.0;
        after = after || open_in(flow, &stack[1], s, x->material, column) > 0.0;
    }
    x->uncovered = after && !before;
    return FW_OK;
}

fw_status fw_process_flow_uncover(fw_arena *arena, fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nexposed; k++)
            FW_TRY(uncovers(arena, flow, i, &flow->step[i].exposed[k]));
    return FW_OK;
}

fw_status fw_process_lint_loss(fw_arena *arena, fw_process_flow *flow, int index,
                               const fw_process_exposed *x, fw_diags *diags) {
    const fw_process_step *s = &flow->step[index];
    double most, loss = fw_process_exposed_loss(s, x, &most), least = (double)INFINITY,
                 sure = (double)INFINITY;
    const char *then = "";
    fw_process_stack stack[2]; /* open from the start, or laid open by the step */
    taken before;
    FW_TRY(stacks_about(arena, flow, index, stack));
    FW_TRY(taken_before(arena, flow, index, x->material, &before));
    for (int i = 0; i < 4 * stack[0].columns; i++) {
        const int column = i / 2;
        const double there = open_in(flow, &stack[i % 2], s, x->material, column),
                     left = fmax(0.0, there - before.nominal_m[column]);
        if (!(there > 0.0)) continue;
        if (left < least) then = before.nominal_m[column] > 0.0 ? " by then" : "";
        least = fmin(least, left);
        sure = fmin(sure, there - before.most_m[column]);
    }
    if (isnan(loss) || !(most >= sure)) return FW_OK;
    char lost[32], have[32], is[32], u[32], needed[32];
    const char *name = fw_process_flow_material_name(flow, x->material);
    const fw_quantity *q = x->rate ? x->rate : x->selectivity;
    double unit = fw_quantity_in_unit(q) / q->value, share = loss / fmax(least, 1e-12);
    fw_number_text(lost, sizeof lost, loss * 1e6, 3);
    fw_number_text(have, sizeof have, least * 1e6, 3);
    fw_number_text(is, sizeof is, fw_quantity_in_unit(q), 4);
    fw_number_text(u, sizeof u, q->uncertainty * unit, 3);
    fw_number_text(needed, sizeof needed, q->value * unit * (x->rate ? 1.0 / share : share), 4);
    if (loss >= least)
        fw_diag_warning(diags, 270, x->place,
                        "step %s removes %s um of %s, but that layer is "
                        "only %s um thick%s; use a thicker layer or a "
                        "better selectivity",
                        s->id, lost, name, have, then);
    const char *of = x->rate ? "rate" : "selectivity", *gap = strcmp(q->unit, "1") ? " " : "";
    const char *why =
        fw_arena_printf(arena,
                        "step %s takes %s um of the open %s, %s um thick%s, at a %s of %s%s%s (u = "
                        "%s): it lasts %s "
                        "%s%s%s. %s",
                        s->id, lost, name, have, then, of, is, gap, gap[0] ? q->unit : "", u,
                        x->rate ? "below" : "above", needed, gap, gap[0] ? q->unit : "",
                        loss >= least ? "Nearest change: a thicker layer, or another etch"
                                      : "Measure it before the first wafer");
    return fw_process_flow_add_reason(arena, flow, loss >= least ? 0 : -1, why);
}

/* Plating beyond the mould's top closes its gaps: d f <= h, with d m the mean thickness, f the
   largest local thickness over the mean (spread, 1 when it is not given) and h m the mould, all of
   one material on top of the field. Test: test_lint.c, mould. */
fw_status fw_process_lint_mould(fw_arena *arena, fw_process_flow *flow, int index,
                                const fw_process_change *c, fw_diags *diags) {
    fw_process_stack stack;
    double spread = c->spread && !c->spread->unknown ? c->spread->value : 1.0;
    if (!c->thickness || c->thickness->unknown) return FW_OK;
    FW_TRY(fw_process_flow_stack(arena, flow, index - 1, &stack, NULL));
    int field = strcmp(c->where, "field") == 0 ? FW_STACK_STRUCTURE : FW_STACK_FIELD;
    if (stack.n[field] == 0) return FW_OK;
    const char *mould = stack.cell[field][stack.n[field] - 1].material;
    double height = top_layer(flow, &stack, field, mould, false),
           grown = c->thickness->value * spread;
    if (isnan(height) || grown <= height) return FW_OK;
    char up[32], high[32], layer[32];
    const bool thinner = flow->nearest_known && !isnan(flow->nearest_layer_m);
    fw_number_text(up, sizeof up, grown * 1e6, 4);
    fw_number_text(high, sizeof high, height * 1e6, 4);
    fw_diag_warning(diags, 273, c->place,
                    "step %s plates up to %s um into a mould only %s um "
                    "high; use a higher mould or plate less",
                    flow->step[index].id, up, high);
    return fw_process_flow_add_reason(
        arena, flow, 0,
        fw_arena_printf(
            arena,
            "step %s plates up to %s um where the mould of %s is %s um high: "
            "the metal grows over it and closes the gaps. Nearest change: %s%s%s",
            flow->step[index].id, up, fw_process_flow_material_name(flow, mould), high,
            thinner ? "a device layer of " : "a higher mould, or thinner plating",
            thinner ? fw_number_text(layer, sizeof layer, 1e6 * flow->nearest_layer_m, 4) : "",
            thinner ? " um, or a higher mould" : ""));
}
