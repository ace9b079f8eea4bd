/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Can the flow make the device? What it can print and plate, and the nearest change where it cannot. */
#include "process/pack.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- what the flow can print and plate ---- */

static const char LINE[] = "narrowest line";

static fw_status printable(fw_process_judge *j, const char *what, double drawn, double on_mask,
                           double hard, double safe, double resist) {
    fw_process_numbers t = {0};
    const char *thick = fw_process_judge_um(&t, resist), *size = fw_process_judge_um(&t, on_mask),
               *as_drawn = fw_process_judge_um(&t, drawn);
    if (on_mask < hard) {
        const char *change;
        if (strcmp(what, LINE) == 0) { /* its bias is that of all edges, whatever its width */
            FW_NEED(change = fw_arena_printf(j->arena, "draw it %s um wide",
                                             fw_process_judge_um(&t, drawn + (safe - on_mask))));
        } else
            FW_TRY(fw_process_judge_nearest(j, &change));
        return fw_process_judge_reason(
            j, FW_ANSWER_NO,
            "the %s is %s um on the mask (%s um drawn), below what %s um of resist "
            "can print in contact, 1.5 sqrt(lambda h/2) = %s um. Nearest change: %s; or a thinner "
            "resist",
            what, size, as_drawn, thick, fw_process_judge_um(&t, hard), change);
    }
    j->flow->tight = j->flow->tight || on_mask < safe;
    if (on_mask < safe)
        return fw_process_judge_reason(
            j, FW_ANSWER_OPEN,
            "the %s is %s um on the mask: %s um of resist print it only in perfect "
            "contact; with the gap of this flow the limit is %s um",
            what, size, thick, fw_process_judge_um(&t, safe));
    return FW_OK;
}

typedef struct printing {  /* what this flow's lithography can print */
    double hard_m, safe_m; /* in contact, with the gap of the flow */
    double resist_m;
} printing;

static bool printing_of(const fw_process_flow *flow, printing *p) {
    double lambda = fw_process_judge_known(fw_process_flow_quantity(flow, "litho.wavelength")),
           gap = fw_process_judge_known(fw_process_flow_quantity(flow, "litho.gap")),
           resist = fw_process_judge_known(fw_process_flow_quantity(flow, "litho.resist"));
    if (isnan(resist))
        resist = fw_process_judge_known(fw_process_flow_quantity(flow, "mould.height"));
    if (isnan(lambda) || isnan(gap) || isnan(resist)) return false;
    *p = (printing){fw_process_print_limit(lambda, 0.0, resist),
                    fw_process_print_limit(lambda, gap, resist), resist};
    return true;
}

static fw_status print_drawn(fw_process_judge *j, const char *what, double drawn, double on_mask,
                             const printing *p) {
    fw_process_numbers t = {0};
    if (on_mask < p->hard_m)
        fw_diag_warning(j->diags, 182, j->flow->place,
                        "flow %s cannot print the %s: %s um drawn, %s um on the mask, at least %s "
                        "um are needed in perfect contact",
                        j->flow->id, what, fw_process_judge_um(&t, drawn),
                        fw_process_judge_um(&t, on_mask), fw_process_judge_um(&t, p->hard_m));
    return printable(j, what, drawn, on_mask, p->hard_m, p->safe_m, p->resist_m);
}

static fw_status lithography(fw_process_judge *j) {
    printing p;
    if (!j->facts || !printing_of(j->flow, &p)) return FW_OK;
    double twice = 2.0 * j->flow->bias_m;
    FW_TRY(print_drawn(j, "narrowest slot", j->facts->narrowest_slot_m,
                       j->facts->narrowest_slot_m - twice, &p));
    return print_drawn(j, LINE, j->facts->narrowest_line_m, j->facts->narrowest_line_m + twice, &p);
}

/* a deposit must stay below its mould: no mushroom while f_J d < h */
static fw_status mould(fw_process_judge *j) {
    fw_process_numbers t = {0};
    double wall = fw_process_judge_known(fw_process_flow_quantity(j->flow, "mould.height")),
           d = fw_process_judge_known(j->flow->thickness);
    const bool known = j->flow->nearest_known && !isnan(j->flow->nearest_layer_m);
    if (isnan(wall) || isnan(d)) return FW_OK;
    if (d >= wall)
        return fw_process_judge_reason(
            j, FW_ANSWER_NO, "%s um do not fit into a mould of %s um. Nearest change: %s%s%s",
            fw_process_judge_um(&t, d), fw_process_judge_um(&t, wall),
            known ? "a device layer of " : "a thicker resist",
            known ? fw_process_judge_um(&t, j->flow->nearest_layer_m) : "",
            known ? " um, or a thicker resist" : "");
    if (wall / d < 1.3)
        return fw_process_judge_reason(
            j, FW_ANSWER_OPEN,
            "the mould is only %s times as high as the deposit: local current above that "
            "factor overplates it",
            fw_process_judge_number(&t, wall / d, 4));
    return FW_OK;
}

static fw_status not_computable(fw_process_judge *j) {
    for (int i = 0; i < j->flow->nstep; i++) {
        const fw_process_step *s = &j->flow->step[i];
        fw_text list = fw_text_new(j->arena);
        if (s->time.computable) continue;
        for (int k = 0; k < s->time.nmissing; k++) {
            fw_text_add(&list, k ? ", " : "");
            fw_text_add(&list, s->time.missing[k]);
        }
        FW_TRY(fw_text_end(&list));
        FW_TRY(fw_process_judge_reason(j, FW_ANSWER_OPEN,
                                       "step %s (%s) is NOT COMPUTABLE, missing: %s", s->id,
                                       s->title, list.data ? list.data : "its inputs"));
    }
    return FW_OK;
}

/* are all of these quantities known? An id that is none of the flow leaves the point open */
static bool closed(const fw_process_flow *flow, const char *until) {
    char id[64];
    for (const char *at = until; at && *at;) {
        const size_t n = strcspn(at, " ");
        snprintf(id, sizeof id, "%.*s", (int)n, at);
        const fw_quantity *q = fw_process_flow_quantity(flow, id);
        if (n > 0 && (!q || q->unknown)) return false;
        at += n + strspn(at + n, " ");
    }
    return until != NULL;
}

/* what printed edges may be off by; where that lies within what was measured of a layer below, what those may */
static void edges_off(fw_process_judge *j) {
    const fw_quantity *edge = fw_process_flow_quantity(j->flow, FW_PROCESS_PRINTED_EDGE);
    const char *name = NULL, *within = NULL;
    for (int i = 0; i < j->flow->ncorner; i++) {
        const fw_process_corner *c = &j->flow->corner[i];
        if (c->q == edge && edge && !fw_process_corner_counts(c))
            edge = c->within, within = c->name;
    }
    for (int i = 0; within && i < j->flow->ncorner; i++)
        if (j->flow->corner[i].q == edge) name = j->flow->corner[i].name;
    if (!edge || edge->unknown || !(edge->uncertainty > 0.0)) return;
    fw_process_numbers t = {0};
    const char *between = j->note.length ? "; " : "",
               *by = fw_process_judge_um(&t, edge->uncertainty);
    if (within)
        fw_text_printf(&j->note,
                       "%sthe %s, with the %s in it, may lie off by %s um (standard), which is not "
                       "known and not compensated",
                       between, name ? name : edge->id, within, by);
    else
        fw_text_printf(&j->note,
                       "%sprinted edges may lie off by %s um (standard), which is not known and "
                       "not compensated",
                       between, by);
}

fw_status fw_process_flow_judge(fw_arena *arena, fw_process_flow *flow,
                                const fw_process_mask_facts *facts, fw_diags *diags) {
    fw_process_judge j = {.arena = arena,
                          .flow = flow,
                          .facts = facts,
                          .diags = diags,
                          .note = fw_text_new(arena),
                          .verdict = FW_ANSWER_FINE};
    flow->reason = NULL;
    flow->nreason = 0;
    flow->fails = NULL;
    flow->tight = false;
    flow->behind = -1;
    FW_TRY(fw_process_judge_etching(&j));
    FW_TRY(lithography(&j));
    FW_TRY(mould(&j));
    FW_TRY(fw_process_judge_release(&j));
    FW_TRY(not_computable(&j));
    for (int i = 0; i < flow->nopen_point; i++)
        if (!closed(flow, flow->open_until[i]))
            FW_TRY(fw_process_judge_reason(&j, FW_ANSWER_OPEN, "%s", flow->open_point[i]));
    edges_off(&j);
    FW_TRY(fw_text_end(&j.note));
    flow->bias_note = j.note.length ? j.note.data : "nothing to compensate is known";
    flow->manufacturable = j.verdict == FW_ANSWER_NO ? 0 : j.verdict == FW_ANSWER_OPEN ? -1 : 1;
    return FW_OK;
}

/* ---- comb drives ---- */

static fw_status drive_names(fw_process_judge *j, const fw_process_drive_facts *drive, int n,
                             const char **names) {
    fw_text list = fw_text_new(j->arena);
    for (int i = 0; i < n; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "", fw_text_name(drive[i].id));
    FW_TRY(fw_text_end(&list));
    FW_NEED(*names = fw_text_few(j->arena, list.data));
    return FW_OK;
}

/* rotor and stator are electrodes: they must not be one piece of conductor */
static fw_status insulation(fw_process_judge *j, const fw_process_drive_facts *drive, int n,
                            fw_diags *diags) {
    const char *names, *layer = fw_process_flow_material_name(j->flow, j->flow->material);
    FW_TRY(drive_names(j, drive, n, &names));
    FW_TRY(fw_process_judge_reason(
        j, FW_ANSWER_NO,
        "%s%s: nothing insulates its rotor from its stator. In this flow the device "
        "is one conducting layer (%s), cut from one sheet or standing on a conducting wafer, "
        "so that every voltage is shorted. Nearest change: a carrier that insulates (glass, "
        "or an oxidised silicon handle) with anchors of rotor and stator apart on it, <flow "
        "ref=\"%s\" carrier=\"insulating\"/>",
        FW_NAMED("comb drive", names), layer, j->flow->id));
    fw_diag_warning(diags, 207, drive[0].place,
                    "%s%s cannot work in flow %s: nothing insulates rotor from stator; "
                    "carrier=\"insulating\" in <flow> says that the handle does",
                    FW_NAMED("comb drive", names), j->flow->id);
    return FW_OK;
}

/* what an etch with unknown anisotropy makes of the gap: force per V^2 goes with 1/gap */
static fw_status widened(fw_process_judge *j, const fw_process_drive_facts *d) {
    for (int i = 0; i < j->flow->nstep; i++)
        for (int k = 0; k < j->flow->step[i].nchange; k++) {
            const fw_process_step *s = &j->flow->step[i];
            double depth = fw_process_judge_known(s->change[k].thickness), g = d->gap_m;
            const fw_quantity *a = s->change[k].anisotropy;
            if (!a || !isnan(fw_process_judge_known(a)) || isnan(depth)) continue;
            fw_process_numbers t = {0};
            const char *as_drawn = fw_process_judge_um(&t, g);
            double mild = 0.02 * depth, strong = 0.1 * depth; /* both sides, A = 0.99 and 0.95 */
            FW_TRY(fw_process_judge_reason(
                j, FW_ANSWER_OPEN,
                "the gap of %s%s, drawn %s um, is not known until the anisotropy A of "
                "step %s is measured: at its top edge it is %s um at A = 0.99 and %s um at A = "
                "0.95, and the force at a given voltage %s and %s of the drawn one's",
                FW_NAMED("comb drive", fw_text_name(d->id)), as_drawn, s->id,
                fw_process_judge_um(&t, g + mild), fw_process_judge_um(&t, g + strong),
                fw_process_judge_number(&t, g / (g + mild), 3),
                fw_process_judge_number(&t, g / (g + strong), 3)));
        }
    return FW_OK;
}

static fw_status drive_gap(fw_process_judge *j, const fw_process_drive_facts *d, fw_diags *diags) {
    fw_process_numbers t = {0};
    printing p;
    double on_mask = d->gap_m - 2.0 * j->flow->bias_m;
    const char *what =
        fw_arena_printf(j->arena, "gap of %s%s", FW_NAMED("comb drive", fw_text_name(d->id)));
    FW_NEED(what);
    bool limited = printing_of(j->flow, &p);
    if (on_mask <= 0.0) {
        const char *change;
        FW_TRY(fw_process_judge_nearest(j, &change));
        FW_TRY(fw_process_judge_reason(
            j, FW_ANSWER_NO,
            "the compensation of %s um per edge closes the %s, %s um drawn, on the mask. "
            "Nearest change: %s",
            fw_process_judge_um(&t, j->flow->bias_m), what, fw_process_judge_um(&t, d->gap_m),
            change));
    } else if (limited)
        FW_TRY(printable(j, what, d->gap_m, on_mask, p.hard_m, p.safe_m, p.resist_m));
    if (on_mask <= 0.0 || (limited && on_mask < p.hard_m))
        fw_diag_warning(diags, 208, d->place,
                        "the %s is too narrow for flow %s: %s um drawn, %s um on the mask", what,
                        j->flow->id, fw_process_judge_um(&t, d->gap_m),
                        fw_process_judge_um(&t, on_mask));
    return widened(j, d);
}

fw_status fw_process_flow_judge_drives(fw_arena *arena, fw_process_flow *flow,
                                       bool insulating_carrier, const fw_process_drive_facts *drive,
                                       int n, fw_diags *diags) {
    static const fw_process_answer as_judged[] = {FW_ANSWER_OPEN, FW_ANSWER_NO,
                                                  FW_ANSWER_FINE}; /* -1, 0, 1 */
    fw_process_judge j = {
        .arena = arena, .flow = flow, .verdict = as_judged[flow->manufacturable + 1]};
    int before = flow->nreason;
    if (n == 0) return FW_OK;
    if (!insulating_carrier && !flow->insulating) FW_TRY(insulation(&j, drive, n, diags));
    for (int i = 0; i < n; i++) {
        bool told = false; /* once per gap */
        for (int k = 0; k < i && !told; k++)
            told = drive[k].gap_m == drive[i].gap_m;
        if (!told) FW_TRY(drive_gap(&j, &drive[i], diags));
    }
    fw_process_judge_to_front(flow, before); /* what refuses comes first */
    flow->manufacturable = j.verdict == FW_ANSWER_NO ? 0 : j.verdict == FW_ANSWER_OPEN ? -1 : 1;
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- the nearest change of what a flow cannot make ----
   A width of the narrowest openings, an anisotropy, an over-etch, a layer or a reach, with which the whole flow is judged
   again and refuses nothing. What a closed form says of one reason alone may fail by the next one; and what the steps take
   may have no mask: heads and corners are drawn anew beside a wider opening. So whoever has a drawing draws what the steps
   take, and where its mask breaks a rule the next change is looked for that breaks none. */

enum { WHY = 160 };

typedef struct trial {
    fw_process_compute *compute;
    fw_arena *arena;
    fw_process_flow *flow;
    const fw_process_mask_facts *facts;
    fw_process_mask_gap *gap; /* (facts->ngap) */
    /* where bias, time and gap begin to have a solution (fixed_point.c): below it nothing is made; NaN: they have one */
    double fold_gap_m, fold_anisotropy;
    fw_quantity *anisotropy; /* of the cut of the device, while it is looked for */
    bool undrawn;            /* what was judged last is between outlines, which nobody drew anew */
    char fails[WHY];         /* what refused the first opening that was drawn; empty: nothing */
    double fails_m;          /* ... which was so wide */
} trial;

/* once more as the flow and `facts` are now: does it refuse nothing, and can its mask be drawn, lines and slots as wide there
   as its rules ask for, with a grid of 1 nm at either edge and the digits of a proposal? What cannot be computed is not made */
static fw_status judge_again(trial *t, const fw_process_mask_facts *facts, bool *made) {
    fw_diags quiet = fw_diags_new(t->arena);
    fw_status status = t->compute(t->arena, t->flow, facts, &quiet);
    const double grid = 4e-9, bias = t->flow->bias_m;
    *made = status == FW_OK && t->flow->manufacturable != 0 &&
            facts->narrowest_slot_m - 2.0 * bias >= facts->least_space_m + grid &&
            facts->narrowest_line_m + 2.0 * bias >= facts->least_width_m + grid;
    return status == FW_INPUT ? FW_OK : status;
}

/* of what the steps take, with the flow as it is now: drawn anew, does its mask keep its rules, and does nothing else refuse? */
static fw_status drawn(trial *t, double gap_m, double thickness_m, bool *made) {
    const fw_process_redraw *redraw = t->facts->redraw;
    fw_process_redrawn answer;
    char why[WHY] = "";
    t->undrawn = false;
    if (!*made || !redraw || !redraw->judge) return FW_OK;
    FW_TRY(redraw->judge(redraw->context, gap_m, thickness_m, &answer, why, sizeof why));
    *made = answer != FW_REDRAWN_REFUSED;
    t->undrawn = answer == FW_REDRAWN_UNDECIDED;
    if (!*made && gap_m > 0.0 && !t->fails[0]) {
        memcpy(t->fails, why, sizeof why);
        t->fails_m = gap_m;
    }
    return FW_OK;
}

/* The first change from `from` on, in whole steps and up to `most`, that is made as drawn: by steps that double, then
   between the last that is not and the first that is. NaN: none of those. Cost: a drawing and a mask for each of at most
   some twenty. Test: test_nearest_drawn.c. */
typedef fw_status attempt(trial *t, double value, bool *made);

static fw_status first_drawn(trial *t, attempt *try, double from, double step, double most,
                             double *found) {
    double low = from, high = from;
    bool made, undrawn;
    *found = (double)NAN;
    FW_TRY(try(t, from, &made));
    for (double n = 1.0; !made && from + n * step <= most; n *= 2.0) {
        low = high, high = from + n * step;
        FW_TRY(try(t, high, &made));
    }
    if (!made) return FW_OK;
    undrawn = t->undrawn;
    while (high - low > 1.5 * step) {
        const double middle = low + step * round(0.5 * (high - low) / step);
        FW_TRY(try(t, middle, &made));
        *(made ? &high : &low) = middle;
    }
    t->undrawn = undrawn;
    *found = high;
    return FW_OK;
}

/* every opening at least so wide: made, and printed with the gap of the flow, not in perfect contact only */
static fw_status with_gap(trial *t, double gap_m, bool *made) {
    fw_process_mask_facts facts = *t->facts;
    *made = false;
    if (gap_m < t->fold_gap_m) return FW_OK;
    for (int i = 0; i < facts.ngap; i++) {
        t->gap[i] = t->facts->gap[i];
        t->gap[i].gap_m = fmax(t->gap[i].gap_m, gap_m);
    }
    facts.gap = t->gap;
    facts.narrowest_slot_m = fmax(facts.narrowest_slot_m, gap_m);
    fw_status status = judge_again(t, &facts, made);
    *made = *made && !t->flow->tight;
    return status;
}

static fw_status gap_drawn(trial *t, double gap_m, bool *made) {
    FW_TRY(with_gap(t, gap_m, made));
    return drawn(t, gap_m, 0.0, made);
}

static double rounded_up(double x_m) { /* what a person draws */
    return 1e-7 * ceil(x_m / 1e-7 - 1e-9);
}

/* Bisection in the logarithm between what is drawn and twenty times that, then up to the next 0.1 um, and judged once
   more, drawn anew; where its mask is refused, on to the first that has one. NaN: no width that far is enough, another
   reason refuses. Error: 0.1 um above the least. Cost: some 12 times fw_process_flow_compute, only for what is refused. Test: test_fixed_point.c, a_proposal_is_accepted_and_least. */
static fw_status least_gap(trial *t, double *gap_m) {
    double low = t->facts->narrowest_slot_m, high = 20.0 * low;
    bool made;
    *gap_m = (double)NAN;
    if (!(low > 0.0) || !isfinite(low)) return FW_OK;
    FW_TRY(with_gap(t, high, &made));
    if (!made) return FW_OK;
    while (high - low > 0.05e-6) {
        double middle = sqrt(low * high);
        FW_TRY(with_gap(t, middle, &made));
        *(made ? &high : &low) = middle;
    }
    return first_drawn(t, gap_drawn, rounded_up(high), 1e-7, 20.0 * t->facts->narrowest_slot_m,
                       gap_m);
}

static fw_status with_anisotropy(trial *t, double value, bool *made) {
    *made = false;
    if (value < t->fold_anisotropy) return FW_OK;
    t->anisotropy->value = value;
    fw_status status = judge_again(t, t->facts, made);
    *made = *made && !t->flow->tight;
    return status;
}

static fw_status anisotropy_drawn(trial *t, double value, bool *made) {
    FW_TRY(with_anisotropy(t, value, made));
    return drawn(t, 0.0, 0.0, made);
}

/* of the cut of the device, where it is known; to 1e-4 */
static fw_status least_anisotropy(trial *t, double *least) {
    fw_quantity *q = NULL;
    *least = (double)NAN;
    for (int i = 0; i < t->flow->edges.ncut; i++)
        if (t->flow->edges.cut[i].device) q = (fw_quantity *)t->flow->edges.cut[i].quantity;
    if (!q || q->unknown) return FW_OK;
    const fw_quantity was = *q;
    double low = was.value, high = 1.0;
    bool made;
    q->interval = false;
    t->anisotropy = q;
    fw_status status = with_anisotropy(t, high, &made);
    while (status == FW_OK && made && high - low > 1e-4) {
        bool enough;
        double middle = 0.5 * (low + high);
        status = with_anisotropy(t, middle, &enough);
        *(enough ? &high : &low) = middle;
    }
    if (status == FW_OK && made)
        status =
            first_drawn(t, anisotropy_drawn, 1e-4 * ceil(high / 1e-4 - 1e-9), 1e-4, 1.0, least);
    *q = was;
    return status;
}

/* In hundredths, upwards from what the opening that stays closed needs with everything else as it is. A longer etch opens
   the mask in another way than it was computed for, and takes more of what masks it: a few hundredths more may be needed,
   and many more may do harm. At most as long again as the etch itself: a share, which its range bounds. */
static fw_status least_overetch(trial *t, double *least) {
    enum { TRIES = 20 };
    fw_process_flow *f = t->flow;
    fw_process_step *s = &f->step[f->behind];
    fw_quantity *q = (fw_quantity *)s->overrun_from;
    double *share = q ? &q->value : &s->overrun;
    const double was = *share, from = f->behind_overetch;
    bool made = false, tight = f->tight;
    fw_status status = FW_OK;
    *least = (double)NAN;
    for (int i = 0; i < TRIES && status == FW_OK && !made && from + 0.01 * i <= 1.0; i++) {
        *share = from + 0.01 * i;
        status = judge_again(t, t->facts, &made);
        made = made && f->behind < 0 && (tight || !f->tight);
        if (status == FW_OK) status = drawn(t, 0.0, 0.0, &made);
        if (made) *least = from + 0.01 * i;
    }
    *share = was;
    return status;
}

/* of a deposit in a mould: three quarters of what stands around it, rounded down to a tenth of a micrometre */
static fw_status thinner_layer(trial *t, double *layer_m) {
    fw_quantity *q = fw_process_flow_own_quantity(t->flow, t->flow->thickness->id);
    const double wall = fw_process_judge_known(fw_process_flow_quantity(t->flow, "mould.height"));
    *layer_m = (double)NAN;
    if (!q || !(q->value >= wall)) return FW_OK;
    const fw_quantity was = *q;
    const double thin = 1e-7 * floor(wall / 1.3 / 1e-7 + 1e-9);
    fw_process_mask_facts facts = *t->facts;
    bool made;
    facts.device_thickness_m = thin;
    fw_status status = judge_again(t, &facts, &made);
    if (status == FW_OK) status = drawn(t, 0.0, thin, &made);
    if (made) *layer_m = thin;
    *q = was;
    return status;
}

/* of a release that does not reach the middle of the widest body, rounded up to a tenth of a micrometre */
static fw_status farther_reach(trial *t, double *reach_m) {
    double is;
    const fw_process_step *s = fw_process_flow_release_step(t->flow, &is);
    fw_quantity *q = NULL;
    bool made;
    *reach_m = (double)NAN;
    for (int k = 0; s && k < s->nchange; k++)
        if (s->change[k].reach && s->change[k].reach->id)
            q = fw_process_flow_own_quantity(t->flow, s->change[k].reach->id);
    if (!q || !t->facts->release || q->status == FW_DERIVED) return FW_OK;
    const double was = q->value;
    const double needs = rounded_up(t->facts->release->needed_m + t->flow->release_foot_m);
    if (!(needs > is)) return FW_OK;
    q->value = needs;
    fw_status status = judge_again(t, t->facts, &made);
    if (status == FW_OK) status = drawn(t, 0.0, 0.0, &made);
    if (made) *reach_m = needs;
    q->value = was;
    return status;
}

fw_status fw_process_judge_changes(fw_arena *arena, fw_process_flow *flow,
                                   const fw_process_mask_facts *facts,
                                   fw_process_compute *compute) {
    trial t = {.compute = compute,
               .arena = arena,
               .flow = flow,
               .facts = facts,
               .fold_gap_m = flow->edges.least_gap_m,
               .fold_anisotropy = flow->edges.least_anisotropy};
    double gap = (double)NAN, A = (double)NAN, over = (double)NAN, layer = (double)NAN,
           reach = (double)NAN;
    const bool refused = flow->manufacturable == 0;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(t.gap = fw_arena_array(arena, fw_process_mask_gap, (size_t)facts->ngap + 1));
    bool undrawn = false;
    if (flow->behind >= 0) FW_TRY(least_overetch(&t, &over));
    if (refused) {
        FW_TRY(least_gap(&t, &gap));
        undrawn = !isnan(gap) && t.undrawn;
        FW_TRY(least_anisotropy(&t, &A));
        FW_TRY(thinner_layer(&t, &layer));
        FW_TRY(farther_reach(&t, &reach));
    }
    fw_arena_rewind(arena, mark);
    flow->nearest_fails = NULL;
    if (t.fails[0] && isnan(gap)) {
        fw_process_numbers n = {0};
        FW_NEED(flow->nearest_fails =
                    fw_arena_printf(arena, "drawn with openings of %s um, it is refused by %s",
                                    fw_process_judge_um(&n, t.fails_m), t.fails));
    }
    flow->nearest_undrawn = undrawn;
    flow->nearest_refused = refused;
    flow->nearest_gap_m = gap;
    flow->nearest_anisotropy = A;
    flow->nearest_overetch = over;
    flow->nearest_layer_m = layer;
    flow->nearest_reach_m = reach;
    flow->nearest_known = true;
    fw_diags quiet = fw_diags_new(arena); /* all was said already */
    return compute(arena, flow, facts, &quiet);
}
