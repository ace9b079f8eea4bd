/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/pack.h"
#include "process/films.h"
#include "process/process_law.h"
#include <math.h>

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
    fw_process_wear w = fw_process_flow_wear(j->flow);
    if (!w.step) return FW_OK;
    if (w.loss_m > 0.0)
        fw_text_printf(
            &j->note,
            "%sstep %s takes %s um of every open face of the device: the mask adds them at "
            "every edge, and the layer ends as much thinner",
            next(j), w.step->id, fw_process_judge_um(&t, w.loss_m));
    if (!w.missing) return FW_OK;
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
            j->flow->id, c->step->id, fw_process_judge_um(&t, w), fw_process_judge_um(&t, top),
            fw_process_judge_number(&t, c->anisotropy, 4));
    fw_process_numbers n = {0};
    return fw_process_judge_reason(
        j, weight,
        "with A = %s and the biased mask the narrowest flexure is %s um wide at the top and "
        "%s um at the bottom: its stiffness is %s of the drawn one%s",
        fw_process_judge_number(&n, c->anisotropy, 4), fw_process_judge_um(&n, top),
        fw_process_judge_um(&n, bottom), fw_process_judge_number(&n, ratio, 4),
        weight == FW_ANSWER_NO ? "; its edge is gone. Nearest change: a wider flexure, a thinner "
                                 "layer or a more anisotropic etch"
                               : "");
}

/* ---- narrow openings fall behind ---- */

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
            FW_TRY(fw_process_judge_reason(
                j, FW_ANSWER_OPEN,
                "how narrow openings fall behind in step %s is not known, so that "
                "neither its time nor its undercut is",
                c->step->id));
        else if (isnan(c->anisotropy))
            FW_TRY(anisotropy_unknown(j, c));
        else if (p->solved)
            FW_TRY(anisotropy_known(j, c));
        if (c->device) FW_TRY(lag(j, c));
    }
    return open_slot(j);
}
