/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One pass of the computed flow: times, edges and judgement for the facts of a mask. What changes it can make the device
   with: process_judge.c. */
#include "base/constants.h"
#include "process/pack.h"
#include "process/process_law.h"
#include <math.h>
#include <string.h>

/* ---- a flow, computed once ---- */

static bool usable(double x) {
    return isfinite(x) && x > 0.0;
}

static fw_status bad_fact(const fw_process_flow *flow, fw_diags *diags, const char *name,
                          double value) {
    char text[32];
    return fw_diag_error(diags, 179, flow->place, "the mask's %s is %s; it must be above zero",
                         name, fw_number_text(text, sizeof text, value, 6));
}

static double none_if_zero(double x) {
    return x == 0.0 || isnan(x) ? HUGE_VAL : x;
}

static fw_status check_facts(const fw_process_flow *flow, const fw_process_mask_facts *m,
                             fw_diags *diags) {
    const struct {
        const char *name;
        double value;
        bool may_lack; /* infinite or, for a flexure and the thickness, 0: there is none */
    } must[] = {{"structure area", m->structure_area_m2, false},
                {"die area", m->die_area_m2, false},
                {"edge length", m->perimeter_m, false},
                {"number of dies", m->dies, false},
                {"narrowest slot", m->narrowest_slot_m, true},
                {"narrowest line", m->narrowest_line_m, true},
                {"narrowest flexure", none_if_zero(m->deepest_hinge_width_m), true},
                {"device thickness", none_if_zero(m->device_thickness_m), true}};
    fw_status status = FW_OK;
    for (size_t i = 0; i < sizeof must / sizeof must[0]; i++)
        if (!usable(must[i].value) && !(must[i].may_lack && must[i].value > 0.0))
            status = bad_fact(flow, diags, must[i].name, must[i].value);
    if (m->structure_area_m2 > m->die_area_m2)
        status = bad_fact(flow, diags, "area outside the structure",
                          m->die_area_m2 - m->structure_area_m2);
    return status;
}

/* a quantity that the pack leaves to the mask; absent in packs that do not need it */
static void fill(fw_process_flow *flow, const char *id, double value, double uncertainty) {
    fw_quantity *q = fw_process_flow_own_quantity(flow, id);
    if (!q) return;
    q->unknown = !isfinite(value) || !isfinite(uncertainty);
    q->value = q->unknown ? 0.0 : value;
    q->uncertainty = q->unknown ? 0.0 : uncertainty;
    q->status = q->u_status = FW_DERIVED;
    q->source = "this device's own mask";
}

/* everything that is on the wafer at once */
static double all_perimeter(const fw_process_mask_facts *m) {
    return m->wafer_area_m2 > 0.0 ? m->wafer_perimeter_m : m->perimeter_m * m->dies;
}

/* What stands on the wafer, whose edges the mask puts `bias` further out, where it does so, and a process so far outside of
   that: A(b) = A + P b, to a relative (b/w)^2 of what is w wide. m2, exact for the drawing. Test: test_flow.c, areas. */
static double all_structure(const fw_process_flow *flow, const fw_process_mask_facts *m,
                            double outside_m) {
    const bool laid = m->wafer_area_m2 > 0.0;
    const double drawn = laid ? m->wafer_structure_m2 : m->structure_area_m2 * m->dies,
                 biased = laid ? m->wafer_biased_m : m->biased_perimeter_m * m->dies;
    return drawn + flow->edges.bias_m * biased + outside_m * all_perimeter(m);
}

/* The whole wafer is in the plasma, between its dies and at its rim, too. Where none is laid out it is the pack's, or the
   dies alone. */
static double all_area(const fw_process_flow *flow, const fw_process_mask_facts *m,
                       fw_quantity_value_status *status) {
    const fw_quantity *D = fw_process_flow_own_quantity(flow, "wafer.D");
    const double dies = m->die_area_m2 * m->dies;
    if (m->wafer_area_m2 > 0.0) return m->wafer_area_m2;
    const double own = D && !D->unknown ? 0.25 * FW_PI * D->value * D->value : 0.0;
    if (own > dies) *status = fw_process_status_worse(*status, D->status);
    return fmax(own, dies);
}

/* A = n A_die + ring + thief; u^2 = (P u_edge)^2 + u_ring^2 + u_thief^2, since A(b) = A + P b for
   an edge that prints b further out. The printed area of the mask is exact. All m2. */
static void fill_plated(fw_process_flow *flow, const fw_process_mask_facts *m) {
    static const char *const extra[] = {"ring.area", "thief.area"};
    const fw_quantity *edge = fw_process_flow_own_quantity(flow, FW_PROCESS_PRINTED_EDGE);
    double area = all_structure(flow, m, -flow->edges.printed_m);
    double u = edge && !edge->unknown ? edge->uncertainty * all_perimeter(m) : 0.0;
    fw_quantity_value_status worst = FW_DERIVED;
    for (int i = 0; i < 2; i++) {
        const fw_quantity *q = fw_process_flow_own_quantity(flow, extra[i]);
        if (!q) continue;
        worst = fw_process_status_worse(worst, q->status);
        area += q->unknown ? (double)NAN : q->value;
        u = hypot(u, q->uncertainty);
    }
    fill(flow, "mask.plated-area", area, u);
    fw_quantity *whole = fw_process_flow_own_quantity(flow, "mask.plated-area");
    if (!whole) return;
    whole->status = whole->u_status = worst;
    whole->source = "this device's own mask, contact ring and thief of the pack";
}

static void fill_mask(fw_process_flow *flow, const fw_process_mask_facts *m) {
    const fw_quantity *edge = fw_process_flow_own_quantity(flow, FW_PROCESS_PRINTED_EDGE);
    double u = edge && !edge->unknown ? 2.0 * edge->uncertainty : 0.0; /* of a width: two edges */
    double flexure = usable(m->deepest_hinge_width_m) ? m->deepest_hinge_width_m : (double)NAN;
    fill(flow, "mask.perimeter", all_perimeter(m), 0.0);
    fill(flow, "mask.dies", m->dies, 0.0);
    fill(flow, "mask.pads", m->pads > 0 ? m->pads : (double)NAN, 0.0);
    fill(flow, "mask.narrowest-slot", m->narrowest_slot_m, u);
    fill(flow, "mask.narrowest-line", m->narrowest_line_m, u);
    fill(flow, "mask.narrowest-flexure", flexure, u);
    fill(flow, "mask.widest-hollow", m->widest_hollow_m > 0.0 ? m->widest_hollow_m : (double)NAN,
         0.0);
}

/* areas as they come out, once the bias is known: what is printed is plated, and an etch sees the layer that masks it */
static void fill_areas(fw_process_flow *flow, const fw_process_mask_facts *m) {
    const fw_process_fixed_point *p = &flow->edges;
    fw_quantity_value_status status = FW_DERIVED;
    const double whole = all_area(flow, m, &status),
                 standing = all_structure(flow, m, -p->printed_m - p->wet_m);
    fill(flow, "mask.structure-area", all_structure(flow, m, -p->printed_m), 0.0);
    fill(flow, "mask.open-area", whole - standing, 0.0);
    fw_quantity *open = fw_process_flow_own_quantity(flow, "mask.open-area");
    if (open) open->status = open->u_status = status;
    fill_plated(flow, m);
}

/* the pack's own wafer stands in until the device file lays one out */
static void set_wafer(fw_process_flow *flow, const fw_process_mask_facts *m) {
    fw_quantity *q = fw_process_flow_own_quantity(flow, "wafer.D");
    if (!q || !usable(m->wafer_diameter_m)) return;
    q->value = m->wafer_diameter_m;
    q->uncertainty = 0.0;
    q->unknown = q->interval = false;
    q->status = q->u_status = FW_DERIVED;
    q->source = "device file, <wafer>";
    q->note = NULL;
}

static void forget_mask(fw_process_flow *flow) {
    for (int i = 0; i < flow->nquantity; i++)
        if (flow->quantity[i]->id && strncmp(flow->quantity[i]->id, "mask.", 5) == 0)
            fill(flow, flow->quantity[i]->id, (double)NAN, (double)NAN);
}

/* the device file may ask for another thickness than the pack's own */
static fw_status set_thickness(fw_arena *arena, fw_process_flow *flow,
                               const fw_process_mask_facts *m) {
    fw_quantity *q = fw_process_flow_own_quantity(flow, flow->thickness->id);
    if (!q || !usable(m->device_thickness_m) ||
        fabs(m->device_thickness_m - q->value) < 1e-9 * q->value)
        return FW_OK;
    char was[32];
    fw_number_text(was, sizeof was, q->unknown ? 0.0 : fw_quantity_in_unit(q), 6);
    FW_NEED(q->note = fw_arena_printf(arena, "the pack's own value is %s %s (%s)", was, q->unit,
                                      fw_quantity_value_status_text(q->status)));
    q->uncertainty *= q->unknown || q->value == 0.0 ? 0.0 : m->device_thickness_m / q->value;
    q->value = m->device_thickness_m;
    q->unknown = false;
    q->status = FW_ASSUMED;
    q->source = "device file";
    return FW_OK;
}

static fw_status derive_all(fw_arena *arena, fw_process_step *s) {
    for (int i = 0; i < s->nderive; i++) {
        const fw_process_derive *d = &s->derive[i];
        fw_process_law_use use = {.law = fw_process_law_find(d->law),
                                  .shape = d->shape,
                                  .expression = d->expression,
                                  .wanted = d->dimension,
                                  .argument = d->argument,
                                  .nargument = d->nargument,
                                  .setting = s->setting,
                                  .nsetting = s->nsetting};
        fw_process_law_answer answer;
        FW_TRY(fw_process_law_evaluate(arena, &use, &answer));
        double value = answer.computable ? answer.value : (double)NAN;
        const char *source = "";
        FW_NEED(source = fw_arena_printf(arena, "computed: %s",
                                         !use.law->argument ? d->expression : use.law->formula));
        FW_TRY(fw_process_step_derive(arena, s, d->name, value, answer.uncertainty, d->dimension,
                                      d->unit, answer.status, source));
        fw_quantity *shown = (fw_quantity *)s->derived[s->nderived - 1];
        for (int j = 0; j < answer.nmissing && !shown->note; j++)
            FW_NEED(shown->note = fw_arena_printf(arena, "missing: %s", answer.missing[j]));
        if (d->q) {
            const char *id = d->q->id;
            *d->q = *shown;
            d->q->id = id;
        }
        int before = s->nderived;
        if (use.law->derive) FW_TRY(use.law->derive(arena, &use, &answer, s));
        for (int j = before; j < s->nderived; j++) {
            fw_quantity *more = (fw_quantity *)s->derived[j];
            FW_NEED(more->id = fw_arena_printf(arena, "%s: %s", d->name, more->id));
        }
    }
    return FW_OK;
}

/* How much longer the step is planned than wide openings take: T/T_wide, 1. In: the step's own law, its answer. Test:
   test_lint.c, mask_lasts_as_planned. */
static fw_status slow(fw_arena *arena, fw_process_law_use use, fw_process_step *s) {
    fw_process_argument list[FW_LAW_ARGUMENTS];
    fw_quantity none;
    fw_process_law_answer wide;
    if (!use.law->lags || !s->time.computable) return FW_OK;
    use.argument = fw_process_law_wide(&use, list, &none, false);
    FW_TRY(fw_process_law_evaluate(arena, &use, &wide));
    if (wide.computable && wide.value > 0.0) s->time.slowed = s->time.nominal_s / wide.value;
    return FW_OK;
}

static double finishing_s(const fw_process_step *s) {
    double sum = 0.0;
    for (int i = 0; i < s->nfinish; i++)
        if (s->finish[i].time && !s->finish[i].time->unknown) sum += s->finish[i].time->value;
    return sum;
}

/* pauses between parts of `t` s: none after the last */
static double pausing_s(const fw_process_step *s, double t_s) {
    if (!s->pulse || s->pulse->unknown || s->pause->unknown || !(s->pulse->value > 0.0)) return 0.0;
    return fmax(0.0, ceil(t_s / s->pulse->value * (1.0 - 1e-12)) - 1.0) * s->pause->value;
}

/* the longest time of the step's own that goes with its pauses into so much */
double fw_process_step_own_s(const fw_process_step *s, double machine_s) {
    if (!s->pulse || s->pulse->unknown || s->pause->unknown || !(s->pulse->value > 0.0))
        return machine_s;
    const double part = s->pulse->value, cycle = part + s->pause->value,
                 whole = floor(machine_s / cycle);
    return whole * part + fmin(machine_s - whole * cycle, part);
}

/* What somebody's presence takes beyond the step's own time is handling, which is as long when the step goes on to its
   stop time: a log is judged from both. Test: test_step_texts.c. */
static void book(fw_process_step *s) {
    double t = s->time.nominal_s * (1.0 + s->overrun), own, handling;
    s->booked_s = s->booked_stop_s = s->booked_stop_own_s = 0.0;
    if (!s->time.computable) return;
    own = t + pausing_s(s, t) + s->finish_s;
    handling = fmax(0.0, s->attended_s - own);
    s->booked_s = own + handling;
    s->booked_stop_own_s = s->time.stop_s + pausing_s(s, s->time.stop_s) + s->finish_s;
    s->booked_stop_s = s->booked_stop_own_s + handling;
}

/* the time as planned, over-etch included, by the id that the pack gives it; values derived in the step may use it */
static fw_status give_planned(fw_arena *arena, fw_process_step *s) {
    const fw_process_time *t = &s->time;
    if (!s->planned) return FW_OK;
    s->planned->unknown = !t->computable;
    s->planned->value = t->nominal_s * (1.0 + s->overrun);
    s->planned->uncertainty = s->planned->value * t->relative_uncertainty;
    s->planned->status = fw_process_status_worse(t->status, FW_DERIVED);
    s->derived = NULL;
    s->nderived = 0;
    return derive_all(arena, s);
}

fw_status fw_process_step_compute(fw_arena *arena, fw_process_step *s) {
    fw_process_argument list[FW_LAW_ARGUMENTS];
    fw_quantity none;
    s->finish_s = finishing_s(s);
    s->derived = NULL;
    s->nderived = 0;
    FW_TRY(derive_all(arena, s));
    fw_process_law_use use = fw_process_law_of_step(s, s->argument);
    use.argument = fw_process_law_wide(&use, list, &none, true);
    use.need = s->need, use.nneed = s->nneed;
    use.setting = s->setting, use.nsetting = s->nsetting;
    fw_process_law_answer answer;
    FW_TRY(fw_process_law_evaluate(arena, &use, &answer));
    fw_process_law_window(&answer, s->k, s->overrun, &s->time);
    FW_TRY(slow(arena, use, s));
    FW_TRY(give_planned(arena, s));
    if (use.law->derive) FW_TRY(use.law->derive(arena, &use, &answer, s));
    book(s);
    return FW_OK;
}

/* what the step takes of materials that lie open: the number of the reasons and of the sections */
static fw_status derive_losses(fw_arena *arena, const fw_process_flow *flow, fw_process_step *s) {
    for (int i = 0; i < s->nexposed; i++) {
        const fw_process_exposed *x = &s->exposed[i];
        const fw_quantity *q = x->rate ? x->rate : x->selectivity;
        double most, loss = fw_process_exposed_loss(s, x, &most);
        if (!isfinite(loss)) continue;
        const char *name = fw_arena_printf(arena, "lost of the open %s, over-etch included",
                                           fw_process_flow_material_name(flow, x->material));
        FW_NEED(name);
        double u = isfinite(most) && most > 0.0 ? 0.5 * loss * (1.0 - loss / most) : 0.5 * loss;
        FW_TRY(fw_process_step_derive(arena, s, name, loss, u, (fw_quantity_dimension)FW_DIM_LENGTH,
                                      "um", fw_process_status_worse(q->status, s->time.status),
                                      x->rate ? "computed: rate time (1 + over-etch)"
                                              : "computed: depth of a wide opening in the planned "
                                                "time (1 + over-etch)/selectivity"));
    }
    return FW_OK;
}

/* ---- edges ---- */

/* between which widths, against the drawn one, the verdict judges the narrowest flexure: one of its ends at the ends of all
   ranges of the corners, to 0.1 % outwards. Not known where the anisotropy has no range. */
static void fill_judged(fw_process_flow *flow, const char *least, const char *most, double width_m,
                        double low_m, double high_m) {
    const double a = 2.0 * fmin(low_m, high_m) / width_m, b = 2.0 * fmax(low_m, high_m) / width_m;
    const bool known = isfinite(low_m) && isfinite(high_m) && usable(width_m);
    fill(flow, least, known ? floor(1e3 * a) / 1e3 : (double)NAN, 0.0);
    fill(flow, most, known ? ceil(1e3 * b) / 1e3 : (double)NAN, 0.0);
}

/* widths of lines against the drawn ones, both of whose edges stand `off_m` outside: as planned, and between which they are
   judged, to 10 nm outwards. Where there is no range nothing would be accepted, and the limits are not known. */
static void fill_lines(fw_process_flow *flow, const char *const id[3], double off_m, double low_m,
                       double high_m) {
    const double to = 1e8;
    const bool known = high_m > low_m;
    for (int i = 0; i < 3; i++) {
        fw_quantity *q = fw_process_flow_own_quantity(flow, id[i]);
        if (q) q->range = FW_PROCESS_DIFFERENCE; /* above 0 or not */
    }
    fill(flow, id[0], 2.0 * off_m, 0.0);
    fill(flow, id[1], known ? floor(2.0 * to * (off_m + low_m) + 1e-6) / to : (double)NAN, 0.0);
    fill(flow, id[2], known ? ceil(2.0 * to * (off_m + high_m) - 1e-6) / to : (double)NAN, 0.0);
}

/* Lines of the test die stand on the mask as they are drawn, without its bias: in the resist they come out as it prints,
   and in the layer that masks the last etch narrower by all that isotropic etches take, which devices are given back. */
static void fill_coupon_lines(fw_process_flow *flow) {
    static const char *const metal[] = {"mask.metal-planned", "mask.metal-least",
                                        "mask.metal-most"},
                             *const print[] = {"mask.print-planned", "mask.print-least",
                                               "mask.print-most"};
    const fw_process_fixed_point *p = &flow->edges;
    const fw_quantity *edge = fw_process_flow_own_quantity(flow, FW_PROCESS_PRINTED_EDGE);
    double low, high;
    fill_lines(flow, metal, p->wet_open ? (double)NAN : -p->printed_m - p->wet_m, p->off_low_m,
               p->off_high_m);
    if (!edge || edge->unknown) return;
    fw_process_quantity_range(edge, &low, &high);
    fill_lines(flow, print, edge->value, low - edge->value, high - edge->value);
}

/* what of the layer's thickness a wet step leaves that takes of its open faces: of its top, until it is free. As far as
   that is known. */
static void fill_thickness(fw_process_flow *flow) {
    const double d =
        flow->thickness && !flow->thickness->unknown ? flow->thickness->value : (double)NAN;
    fill(flow, "mask.thickness-left", d - flow->edges.wear.loss_m, 0.0);
}

static void fill_widths(fw_process_flow *flow, const fw_process_mask_facts *facts) {
    const fw_process_fixed_point *p = &flow->edges;
    const fw_process_edge none = {.top_m = (double)NAN, .bottom_m = (double)NAN};
    const bool known = facts && p->solved && p->ncls > 0;
    const fw_process_edge low = known ? p->cls[p->field].low : none,
                          high = known ? p->cls[p->field].high : none;
    const double width_m = facts ? facts->deepest_hinge_width_m : (double)NAN;
    fill_judged(flow, "mask.top-least", "mask.top-most", width_m, low.top_m, high.top_m);
    fill_judged(flow, "mask.bottom-least", "mask.bottom-most", width_m, low.bottom_m,
                high.bottom_m);
    fill_coupon_lines(flow);
    fill_thickness(flow);
}

/* edges, bias and gaps; the narrowest opening goes to the laws of the steps */
static fw_status solve_edges(fw_arena *arena, fw_process_flow *flow,
                             const fw_process_mask_facts *facts) {
    fw_process_fixed_point *p = &flow->edges;
    double thickness = facts ? facts->device_thickness_m : 0.0;
    FW_TRY(fw_process_fixed_point_solve(arena, flow, facts, thickness, p));
    flow->bias_m = p->bias_m;
    double opening = p->ncls && p->solved ? p->cls[0].opening_m : (double)NAN;
    if (p->ncls) fill(flow, FW_MASK_OPENING, opening, 2.0 * p->edges_u_m); /* of two edges */
    fill_widths(flow, facts);
    fw_process_release_fill(flow, facts);
    return FW_OK;
}

static fw_status derive_class(fw_arena *arena, fw_process_step *s, const fw_process_edge_class *c) {
    char width[32];
    const char *name =
        fw_arena_printf(arena, "floor through, %s, %s um wide under the mask", c->name,
                        fw_number_text(width, sizeof width, c->opening_m * 1e6, 4));
    FW_NEED(name);
    return fw_process_step_derive(arena, s, name, c->through_s, 0.0,
                                  (fw_quantity_dimension)FW_DIM_TIME, "min", s->time.status,
                                  "computed with bias and gap of this mask");
}

/* when each width of opening is through, in the step that cuts the device layer */
static fw_status show_edges(fw_arena *arena, fw_process_flow *flow) {
    fw_process_fixed_point *p = &flow->edges;
    for (int k = 0; k < p->ncut; k++) {
        const fw_process_cut *cut = &p->cut[k];
        fw_process_step *s = (fw_process_step *)cut->step;
        if (!cut->device || !p->solved || !s->time.computable) continue;
        for (int i = 0; i < p->ncls; i++) {
            fw_process_edge_class *c = &p->cls[i];
            c->through_s = s->time.nominal_s * c->reach_m / cut->planned_m;
            if (cut->lag != FW_LAG_NONE) FW_TRY(derive_class(arena, s, c));
        }
        return FW_OK;
    }
    return FW_OK;
}

static void forget_derived(fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++) {
        if (flow->step[i].planned) flow->step[i].planned->unknown = true;
        for (int j = 0; j < flow->step[i].nderive; j++)
            if (flow->step[i].derive[j].q) flow->step[i].derive[j].q->unknown = true;
    }
}

static bool listed(const fw_quantity **list, int n, const fw_quantity *q) {
    for (int i = 0; i < n; i++)
        if (list[i] == q) return true;
    return false;
}

static void count_one(fw_process_flow *flow, const fw_quantity **list, int *n,
                      const fw_quantity *q) {
    if (listed(list, *n, q)) return;
    list[(*n)++] = q;
    if (q->unknown)
        flow->unknown++;
    else
        flow->count[q->status]++;
}

/* every quantity that a step sets, computes with or needs, once */
static fw_status count_quantities(fw_arena *arena, fw_process_flow *flow) {
    const fw_quantity **list = fw_arena_array(arena, const fw_quantity *, (size_t)flow->nquantity);
    FW_NEED(list);
    int n = 0;
    memset(flow->count, 0, sizeof flow->count);
    flow->unknown = 0;
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int j = 0; j < s->nfinish; j++)
            if (s->finish[j].time) count_one(flow, list, &n, s->finish[j].time);
        for (int j = 0; j < s->nsetting; j++)
            count_one(flow, list, &n, s->setting[j].q);
        for (int j = 0; j < s->nargument; j++)
            count_one(flow, list, &n, s->argument[j].q);
        for (int j = 0; j < s->nneed; j++)
            count_one(flow, list, &n, s->need[j].q);
    }
    return FW_OK;
}

static fw_status tell(fw_arena *arena, const fw_process_flow *flow, fw_diags *diags) {
    if (flow->not_computable == 0) return FW_OK;
    fw_text text = fw_text_new(arena);
    for (int i = 0; i < flow->nstep; i++)
        if (!flow->step[i].time.computable) {
            fw_text_add(&text, text.length ? ", " : "");
            fw_text_add(&text, flow->step[i].id);
        }
    FW_TRY(fw_text_end(&text));
    fw_diag_note(diags, 176, flow->place,
                 "%d of %d steps of '%s' are NOT COMPUTABLE (%s), because values are missing: "
                 "the run sheet lists them; enter them in a laboratory pack",
                 flow->not_computable, flow->nstep, flow->id, text.data);
    return FW_OK;
}

fw_status fw_process_flow_compute_once(fw_arena *arena, fw_process_flow *flow,
                                       const fw_process_mask_facts *facts, fw_diags *diags) {
    forget_mask(flow);
    forget_derived(flow);
    if (facts) FW_TRY(set_thickness(arena, flow, facts));
    if (facts) set_wafer(flow, facts);
    if (facts && facts->structure_area_m2 == 0.0 && facts->die_area_m2 == 0.0)
        facts = NULL; /* nothing was drawn */
    if (facts) {
        FW_TRY(check_facts(flow, facts, diags));
        fill_mask(flow, facts);
    }
    for (int i = 0; i < flow->nstep; i++)
        fw_process_step_overrun(&flow->step[i]);
    FW_TRY(fw_process_flow_fill_texts(arena, flow, diags));
    FW_TRY(solve_edges(arena, flow, facts));
    if (facts) fill_areas(flow, facts);
    FW_TRY(fw_process_flow_uncover(arena, flow));
    flow->total_s = 0.0;
    flow->not_computable = 0;
    for (int i = 0; i < flow->nstep; i++) {
        FW_TRY(fw_process_step_compute(arena, &flow->step[i]));
        FW_TRY(derive_losses(arena, flow, &flow->step[i]));
        if (flow->step[i].time.computable)
            flow->total_s += flow->step[i].booked_s;
        else
            flow->not_computable++;
    }
    FW_TRY(fw_process_flow_fill_texts(arena, flow, diags)); /* with what was computed now */
    FW_TRY(show_edges(arena, flow));
    FW_TRY(count_quantities(arena, flow));
    FW_TRY(fw_process_flow_judge(arena, flow, facts, diags));
    FW_TRY(fw_process_lint_computed(arena, flow, diags));
    FW_TRY(fw_process_lint_wafer(arena, flow, facts));
    FW_TRY(tell(arena, flow, diags));
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_process_flow_compute(fw_arena *arena, fw_process_flow *flow,
                                  const fw_process_mask_facts *facts, fw_diags *diags) {
    flow->nearest_known = false;
    FW_TRY(fw_process_flow_compute_once(arena, flow, facts, diags));
    bool drawn = facts && facts->structure_area_m2 > 0.0,
         asked = drawn && !(facts->redraw && facts->redraw->judging);
    return asked && (flow->manufacturable == 0 || flow->behind >= 0)
               ? fw_process_judge_changes(arena, flow, facts, fw_process_flow_compute_once)
               : FW_OK;
}
