/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/judge.h"
#include "process/law.h"
#include "process/undercut.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef enum answer { ANSWER_NO, ANSWER_OPEN, ANSWER_FINE } answer;

typedef struct judge {
    fw_arena *arena;
    fw_flow *flow;
    const fw_mask_facts *facts; /* may be NULL */
    fw_text note;
    answer verdict;
} judge;

/* up to eight numbers of one sentence */
typedef struct numbers {
    char text[8][32];
    int n;
} numbers;

static const char *number(numbers *list, double value, int digits) {
    char *text = list->text[list->n++ % 8];
    return fw_number_text(text, sizeof list->text[0], value, digits);
}
static const char *um(numbers *list, double value_m) {
    return number(list, value_m * 1e6, 4);
}

__attribute__((format(printf, 3, 4))) static fw_status say(judge *j, answer weight,
                                                           const char *format, ...) {
    char text[1200];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length >= (int)sizeof text) { /* cut a very long list, never inside a character */
        size_t end = sizeof text - 4;
        while (end > 0 && ((unsigned char)text[end] & 0xC0) == 0x80)
            end--;
        memcpy(text + end, "...", 4);
    }
    fw_flow *f = j->flow;
    const char **grown = fw_arena_grow(j->arena, f->reason, (size_t)f->nreason,
                                       (size_t)f->nreason + 1, sizeof *f->reason);
    FW_NEED(grown);
    f->reason = grown;
    FW_NEED(f->reason[f->nreason] = fw_arena_strdup(j->arena, text));
    f->nreason++;
    if (weight < j->verdict) j->verdict = weight;
    return FW_OK;
}

static double known(const fw_quantity *q) {
    return q && !q->unknown ? q->value : (double)NAN;
}

static bool has_flexure(const judge *j) {
    return j->facts && j->facts->deepest_hinge_width_m > 0.0 &&
           isfinite(j->facts->deepest_hinge_width_m);
}

/* a masked wet etch runs under its mask by d (1 + overrun) at every edge: known, so compensated */
static fw_status isotropic_loss(judge *j, const fw_step *s, const fw_change *c) {
    numbers t = {0};
    double depth = known(c->thickness);
    if (isnan(depth))
        return say(j, ANSWER_OPEN, "step %s etches sideways by its own depth, which is not known",
                   s->id);
    double loss = depth * (1.0 + s->overrun);
    j->flow->bias_m += loss;
    fw_text_printf(
        &j->note,
        "%sstep %s etches %s um of %s isotropically with %s %% over-etch: %s um are lost "
        "at every edge and the mask adds them",
        j->note.length ? "; " : "", s->id, um(&t, depth), c->material,
        number(&t, 100.0 * s->overrun, 3), um(&t, loss));
    return FW_OK;
}

/* numbers for the run sheet when the anisotropy is not known */
static fw_status anisotropy_unknown(judge *j, const fw_step *s, double depth) {
    numbers t = {0};
    fw_text_printf(&j->note,
                   "%sthe lateral etch of step %s is NOT in the bias, because the anisotropy A is "
                   "not stated: at A = 0.99, 0.95, 0.9 the top edge loses %s, %s, %s um per side",
                   j->note.length ? "; " : "", s->id, um(&t, 0.01 * depth), um(&t, 0.05 * depth),
                   um(&t, 0.1 * depth));
    if (!has_flexure(j))
        return say(j, ANSWER_OPEN,
                   "not guaranteed until the anisotropy of step %s is measured; the mask names no "
                   "flexure to judge",
                   s->id);
    double w = j->facts->deepest_hinge_width_m;
    const char *width = um(&t, w), *deep = um(&t, depth);
    FW_TRY(say(j, ANSWER_OPEN,
               "not guaranteed until the anisotropy A of step %s is measured: the top edge of the "
               "narrowest flexure (%s um wide, %s um deep) is cut through at A = %s in the nominal "
               "time and at A = %s with 20 %% over-etch",
               s->id, width, deep, number(&t, fw_undercut_cut(w, depth), 4),
               number(&t, fw_undercut_cut(w, 1.2 * depth), 4)));
    numbers n = {0};
    return say(j, ANSWER_OPEN,
               "a stiffness within 10 %% of the drawn one needs A >= %s (tapered wall, nominal "
               "time), %s (10 %% over-etch), %s (straight wall, full undercut)",
               number(&n, fw_undercut_needed(w, depth, depth, 0.1, 0), 4),
               number(&n, fw_undercut_needed(w, depth, 1.1 * depth, 0.1, 0), 4),
               number(&n, fw_undercut_needed(w, depth, depth, 0.1, 1), 4));
}

/* with a measured A the mask adds the mean undercut of the wall, (1 - A)(E - D/2), E = D (1 + OE):
   the section then is a trapezoid about the drawn width */
static fw_status anisotropy_known(judge *j, const fw_step *s, double depth, double A) {
    numbers t = {0};
    double etched = depth * (1.0 + s->overrun), mean = (1.0 - A) * (etched - depth / 2.0);
    j->flow->bias_m += mean;
    fw_text_printf(&j->note,
                   "%sstep %s undercuts by %s um at mid-depth (A = %s) and the mask adds that",
                   j->note.length ? "; " : "", s->id, um(&t, mean), number(&t, A, 4));
    if (!has_flexure(j)) return FW_OK;
    double w = j->facts->deepest_hinge_width_m, top, bottom;
    fw_undercut_widths(w + 2.0 * mean, A, depth, etched, &top, &bottom);
    double ratio = fw_undercut_stiffness(top, bottom, w);
    answer weight = top <= 0.0 ? ANSWER_NO : fabs(ratio - 1.0) > 0.1 ? ANSWER_OPEN : ANSWER_FINE;
    return say(j, weight,
               "with A = %s and the biased mask the narrowest flexure is %s um wide at the top and "
               "%s um at the bottom: its stiffness is %s of the drawn one%s",
               number(&t, A, 4), um(&t, top), um(&t, bottom), number(&t, ratio, 4),
               weight == ANSWER_NO ? "; its edge is gone. Nearest change: a wider flexure, a "
                                     "thinner layer or a more anisotropic etch"
                                   : "");
}

/* depth in the narrowest slot after the nominal time, by bisection on t = (d + S J(w, d))/R */
static fw_status slot_lag(judge *j, const fw_step *s, double depth) {
    numbers t = {0};
    double S = known(fw_flow_quantity(j->flow, "rie.S"));
    if (!j->facts || isnan(S) || !isfinite(j->facts->narrowest_slot_m)) return FW_OK;
    double w = j->facts->narrowest_slot_m, low = 0.0, high = depth;
    for (int i = 0; i < 60; i++) {
        double d = 0.5 * (low + high);
        if (d + S * fw_arde_integral(w, d, false) < depth)
            low = d;
        else
            high = d;
    }
    double longer = 1.0 + S * fw_arde_integral(w, depth, false) / depth;
    return say(j, ANSWER_OPEN,
               "the narrowest slot is %s um wide: in the nominal time of step %s it reaches %s of "
               "%s um, and needs %s times that time to come through (neutral transport, S = %s "
               "assumed: etch slots of several widths on a dummy wafer and measure their depths)",
               um(&t, w), s->id, um(&t, low), um(&t, depth), number(&t, longer, 4),
               number(&t, S, 3));
}

static fw_status etching(judge *j) {
    for (int i = 0; i < j->flow->nstep; i++) {
        const fw_step *s = &j->flow->step[i];
        for (int k = 0; k < s->nchange; k++) {
            const fw_change *c = &s->change[k];
            double depth = known(c->thickness), A = known(c->anisotropy);
            if (c->isotropic) FW_TRY(isotropic_loss(j, s, c));
            if (!c->anisotropy || isnan(depth)) continue;
            FW_TRY(isnan(A) ? anisotropy_unknown(j, s, depth) : anisotropy_known(j, s, depth, A));
            FW_TRY(slot_lag(j, s, depth));
        }
    }
    return FW_OK;
}

static fw_status printable(judge *j, const char *what, double drawn, double on_mask, double hard,
                           double safe, double resist) {
    numbers t = {0};
    const char *thick = um(&t, resist), *size = um(&t, on_mask), *as_drawn = um(&t, drawn);
    if (on_mask < hard)
        return say(j, ANSWER_NO,
                   "the %s is %s um on the mask (%s um drawn), below what %s um of resist "
                   "can print in contact, 1.5 sqrt(lambda h/2) = %s um. Nearest change: draw it "
                   "%s um wide or use a thinner resist",
                   what, size, as_drawn, thick, um(&t, hard), um(&t, drawn + (safe - on_mask)));
    if (on_mask < safe)
        return say(j, ANSWER_OPEN,
                   "the %s is %s um on the mask: %s um of resist print it only in perfect "
                   "contact; with the gap of this flow the limit is %s um",
                   what, size, thick, um(&t, safe));
    return FW_OK;
}

typedef struct printing {  /* what this flow's lithography can print */
    double hard_m, safe_m; /* in contact, with the gap of the flow */
    double resist_m;
} printing;

static bool printing_of(const fw_flow *flow, printing *p) {
    double lambda = known(fw_flow_quantity(flow, "litho.wavelength")),
           gap = known(fw_flow_quantity(flow, "litho.gap")),
           resist = known(fw_flow_quantity(flow, "litho.resist"));
    if (isnan(resist)) resist = known(fw_flow_quantity(flow, "mould.height"));
    if (isnan(lambda) || isnan(gap) || isnan(resist)) return false;
    *p = (printing){fw_print_limit(lambda, 0.0, resist), fw_print_limit(lambda, gap, resist),
                    resist};
    return true;
}

static fw_status lithography(judge *j) {
    printing p;
    if (!j->facts || !printing_of(j->flow, &p)) return FW_OK;
    double b = j->flow->bias_m;
    FW_TRY(printable(j, "narrowest slot", j->facts->narrowest_slot_m,
                     j->facts->narrowest_slot_m - 2.0 * b, p.hard_m, p.safe_m, p.resist_m));
    return printable(j, "narrowest line", j->facts->narrowest_line_m,
                     j->facts->narrowest_line_m + 2.0 * b, p.hard_m, p.safe_m, p.resist_m);
}

/* a deposit must stay below its mould: no mushroom while f_J d < h */
static fw_status mould(judge *j) {
    numbers t = {0};
    double wall = known(fw_flow_quantity(j->flow, "mould.height")), d = known(j->flow->thickness);
    if (isnan(wall) || isnan(d)) return FW_OK;
    if (d >= wall)
        return say(
            j, ANSWER_NO,
            "%s um do not fit into a mould of %s um. Nearest change: a device layer of %s um "
            "or a thicker resist",
            um(&t, d), um(&t, wall), um(&t, wall / 1.3));
    if (wall / d < 1.3)
        return say(j, ANSWER_OPEN,
                   "the mould is only %s times as high as the deposit: local current above that "
                   "factor overplates it",
                   number(&t, wall / d, 4));
    return FW_OK;
}

static fw_status not_computable(judge *j) {
    for (int i = 0; i < j->flow->nstep; i++) {
        const fw_step *s = &j->flow->step[i];
        fw_text list = fw_text_new(j->arena);
        if (s->time.computable) continue;
        for (int k = 0; k < s->time.nmissing; k++) {
            fw_text_add(&list, k ? ", " : "");
            fw_text_add(&list, s->time.missing[k]);
        }
        FW_TRY(fw_text_end(&list));
        FW_TRY(say(j, ANSWER_OPEN, "step %s (%s) is NOT COMPUTABLE, missing: %s", s->id, s->title,
                   list.data ? list.data : "its inputs"));
    }
    return FW_OK;
}

/* a narrow slot must still be open on the mask after the bias was added on both sides */
static fw_status open_slot(judge *j) {
    numbers t = {0};
    double left = j->facts ? j->facts->narrowest_slot_m - 2.0 * j->flow->bias_m : 1.0;
    if (left > 0.0) return FW_OK;
    return say(j, ANSWER_NO,
               "the compensation of %s um per edge closes the narrowest slot of %s um on the mask. "
               "Nearest change: slots wider than %s um",
               um(&t, j->flow->bias_m), um(&t, j->facts->narrowest_slot_m),
               um(&t, 2.0 * j->flow->bias_m));
}

fw_status fw_flow_judge(fw_arena *arena, fw_flow *flow, const fw_mask_facts *facts) {
    judge j = {arena, flow, facts, fw_text_new(arena), ANSWER_FINE};
    flow->bias_m = 0.0;
    flow->reason = NULL;
    flow->nreason = 0;
    FW_TRY(etching(&j));
    FW_TRY(open_slot(&j));
    FW_TRY(lithography(&j));
    FW_TRY(mould(&j));
    FW_TRY(not_computable(&j));
    for (int i = 0; i < flow->nopen_point; i++)
        FW_TRY(say(&j, ANSWER_OPEN, "%s", flow->open_point[i]));
    const fw_quantity *edge = fw_flow_quantity(flow, "litho.edge");
    if (edge && !edge->unknown && edge->uncertainty > 0.0) {
        numbers t = {0};
        fw_text_printf(&j.note,
                       "%sprinted edges may lie off by %s um (standard), which is not known "
                       "and not compensated",
                       j.note.length ? "; " : "", um(&t, edge->uncertainty));
    }
    FW_TRY(fw_text_end(&j.note));
    flow->bias_note = j.note.length ? j.note.data : "nothing to compensate is known";
    flow->manufacturable = j.verdict == ANSWER_NO ? 0 : j.verdict == ANSWER_OPEN ? -1 : 1;
    return FW_OK;
}

/* ---- comb drives ---- */

static fw_status drive_names(judge *j, const fw_drive_facts *drive, int n, const char **names) {
    fw_text list = fw_text_new(j->arena);
    for (int i = 0; i < n; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "", drive[i].id ? drive[i].id : "(unnamed)");
    FW_TRY(fw_text_end(&list));
    *names = list.data;
    return FW_OK;
}

/* rotor and stator are electrodes: they must not be one piece of conductor */
static fw_status insulation(judge *j, const fw_drive_facts *drive, int n, fw_diags *diags) {
    const char *names, *layer = fw_flow_material_name(j->flow, j->flow->material);
    FW_TRY(drive_names(j, drive, n, &names));
    FW_TRY(
        say(j, ANSWER_NO,
            "comb drive %s: nothing insulates its rotor from its stator. In this flow the device "
            "is one conducting layer (%s), cut from one sheet or standing on a conducting wafer, "
            "so that every voltage is shorted. Nearest change: a carrier that insulates (glass, "
            "or an oxidised silicon handle) with anchors of rotor and stator apart on it, <flow "
            "ref=\"%s\" carrier=\"insulating\"/>",
            names, layer, j->flow->id));
    fw_diag_warning(diags, 207, drive[0].place,
                    "comb drive %s cannot work in flow %s: nothing insulates rotor from stator; "
                    "carrier=\"insulating\" in <flow> says that the handle does",
                    names, j->flow->id);
    return FW_OK;
}

/* what an etch with unknown anisotropy makes of the gap: force per V^2 goes with 1/gap */
static fw_status widened(judge *j, const fw_drive_facts *d) {
    for (int i = 0; i < j->flow->nstep; i++)
        for (int k = 0; k < j->flow->step[i].nchange; k++) {
            const fw_step *s = &j->flow->step[i];
            double depth = known(s->change[k].thickness), g = d->gap_m;
            const fw_quantity *a = s->change[k].anisotropy;
            if (!a || !isnan(known(a)) || isnan(depth)) continue;
            numbers t = {0};
            const char *as_drawn = um(&t, g);
            double mild = 0.02 * depth, strong = 0.1 * depth; /* both sides, A = 0.99 and 0.95 */
            FW_TRY(say(
                j, ANSWER_OPEN,
                "the gap of comb drive %s, drawn %s um, is not known until the anisotropy A of "
                "step %s is measured: at its top edge it is %s um at A = 0.99 and %s um at A = "
                "0.95, and the force at a given voltage %s and %s of the drawn one's",
                d->id ? d->id : "(unnamed)", as_drawn, s->id, um(&t, g + mild), um(&t, g + strong),
                number(&t, g / (g + mild), 3), number(&t, g / (g + strong), 3)));
        }
    return FW_OK;
}

static fw_status drive_gap(judge *j, const fw_drive_facts *d, fw_diags *diags) {
    numbers t = {0};
    printing p;
    double on_mask = d->gap_m - 2.0 * j->flow->bias_m;
    const char *what =
        fw_arena_printf(j->arena, "gap of comb drive %s", d->id ? d->id : "(unnamed)");
    FW_NEED(what);
    bool limited = printing_of(j->flow, &p);
    if (on_mask <= 0.0)
        FW_TRY(say(j, ANSWER_NO,
                   "the compensation of %s um per edge closes the %s, %s um drawn, on the mask. "
                   "Nearest change: a gap above %s um",
                   um(&t, j->flow->bias_m), what, um(&t, d->gap_m),
                   um(&t, 2.0 * j->flow->bias_m + (limited ? p.safe_m : 0.0))));
    else if (limited)
        FW_TRY(printable(j, what, d->gap_m, on_mask, p.hard_m, p.safe_m, p.resist_m));
    if (on_mask <= 0.0 || (limited && on_mask < p.hard_m))
        fw_diag_warning(diags, 208, d->place,
                        "the %s is too narrow for flow %s: %s um drawn, %s um on the mask", what,
                        j->flow->id, um(&t, d->gap_m), um(&t, on_mask));
    return widened(j, d);
}

fw_status fw_flow_judge_drives(fw_arena *arena, fw_flow *flow, bool insulating_carrier,
                               const fw_drive_facts *drive, int n, fw_diags *diags) {
    static const answer as_judged[] = {ANSWER_OPEN, ANSWER_NO, ANSWER_FINE}; /* -1, 0, 1 */
    judge j = {.arena = arena, .flow = flow, .verdict = as_judged[flow->manufacturable + 1]};
    int before = flow->nreason;
    if (n == 0) return FW_OK;
    if (!insulating_carrier && !flow->insulating) FW_TRY(insulation(&j, drive, n, diags));
    for (int i = 0; i < n; i++) {
        bool told = false; /* once per gap */
        for (int k = 0; k < i && !told; k++)
            told = drive[k].gap_m == drive[i].gap_m;
        if (!told) FW_TRY(drive_gap(&j, &drive[i], diags));
    }
    for (int i = before; i < flow->nreason; i++) { /* what refuses comes first */
        const char *reason = flow->reason[i];
        memmove(flow->reason + i - before + 1, flow->reason + i - before,
                (size_t)before * sizeof *flow->reason);
        flow->reason[i - before] = reason;
    }
    flow->manufacturable = j.verdict == ANSWER_NO ? 0 : j.verdict == ANSWER_OPEN ? -1 : 1;
    return diags->failed ? FW_NOMEM : FW_OK;
}
