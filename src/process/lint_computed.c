/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the computed times do to the layers: known only with the mask and the device's thickness. */
#include "process/lint.h"
#include "process/stack.h"
#include <math.h>
#include <string.h>

/* thickness of what lies on top of a column and is all of one material; NaN: a part is unknown */
static double top_layer(const fw_process_stack *stack, int column, const char *material) {
    double sum = 0.0;
    for (int i = stack->n[column] - 1; i >= 0; i--) {
        if (strcmp(stack->cell[column][i].material, material) != 0) break;
        sum += stack->cell[column][i].thickness_m;
    }
    return sum;
}

/* Loss of an exposed material in a step, nominal and at two standard uncertainties:
     by rate r:            l = r T (1 + overrun),     u/l = sqrt((u_r/r)^2 + u_T^2)
     by selectivity S:     l = d (1 + overrun)/S,     u/l = u_S/S
   r m/s, T the step's nominal time s, d m the depth that the step removes; l m. NaN when an input
   is not known. Source: docs/theory/process.md, What a step takes along. Test: test_lint.c, loss.
 */
double fw_process_exposed_loss(const fw_process_step *s, const fw_process_exposed *x,
                               double *most_m) {
    double loss = (double)NAN, relative = 0.0;
    if (x->rate && !x->rate->unknown && s->time.computable) {
        loss = x->rate->value * s->time.nominal_s * (1.0 + s->overrun);
        relative = hypot(x->rate->uncertainty / x->rate->value, s->time.relative_uncertainty);
    } else if (x->selectivity && !x->selectivity->unknown) {
        for (int i = 0; i < s->nchange; i++) {
            const fw_quantity *d = s->change[i].thickness;
            if (strcmp(s->change[i].kind, "remove") == 0 && d && !d->unknown)
                loss = fmax(isnan(loss) ? 0.0 : loss,
                            d->value * (1.0 + s->overrun) / x->selectivity->value);
        }
        relative = x->selectivity->uncertainty / x->selectivity->value;
    }
    *most_m = relative < 0.5 ? loss / (1.0 - 2.0 * relative) : (double)INFINITY;
    return loss;
}

static fw_status lint_loss(fw_arena *arena, fw_process_flow *flow, int index,
                           const fw_process_exposed *x, fw_diags *diags) {
    const fw_process_step *s = &flow->step[index];
    double most, loss = fw_process_exposed_loss(s, x, &most), least = (double)INFINITY;
    for (int k = index - 1; k <= index; k++) { /* open from the start, or laid open by the step */
        fw_process_stack stack;
        FW_TRY(fw_process_flow_stack(arena, flow, k, &stack, NULL));
        for (int column = 0; column < FW_STACK_COLUMNS; column++) {
            double there = top_layer(&stack, column, x->material);
            if (there > 0.0) least = fmin(least, there);
        }
    }
    if (isnan(loss) || !(most >= least)) return FW_OK;
    char lost[32], have[32], is[32], u[32], needed[32];
    const char *name = fw_process_flow_material_name(flow, x->material);
    const fw_quantity *q = x->rate ? x->rate : x->selectivity;
    double unit = fw_quantity_in_unit(q) / q->value, share = loss / least;
    fw_number_text(lost, sizeof lost, loss * 1e6, 3);
    fw_number_text(have, sizeof have, least * 1e6, 3);
    fw_number_text(is, sizeof is, fw_quantity_in_unit(q), 4);
    fw_number_text(u, sizeof u, q->uncertainty * unit, 3);
    fw_number_text(needed, sizeof needed, q->value * unit * (x->rate ? 1.0 / share : share), 4);
    if (loss >= least)
        fw_diag_warning(diags, 270, x->place,
                        "step %s removes %s um of %s, but that layer is "
                        "only %s um thick; use a thicker layer or a "
                        "better selectivity",
                        s->id, lost, name, have);
    const char *of = x->rate ? "rate" : "selectivity", *gap = strcmp(q->unit, "1") ? " " : "";
    const char *why = fw_arena_printf(
        arena,
        "step %s takes %s um of the open %s, %s um thick, at a %s of %s%s%s (u = %s): it lasts %s "
        "%s%s%s. %s",
        s->id, lost, name, have, of, is, gap, gap[0] ? q->unit : "", u, x->rate ? "below" : "above",
        needed, gap, gap[0] ? q->unit : "",
        loss >= least ? "Nearest change: a thicker layer, or another etch"
                      : "Measure it before the first wafer");
    return fw_process_flow_add_reason(arena, flow, loss >= least ? 0 : -1, why);
}

/* Plating beyond the mould's top closes its gaps: d f <= h, with d m the mean thickness, f the
   largest local thickness over the mean (spread, 1 when it is not given) and h m the mould, all of
   one material on top of the field. Test: test_lint.c, mould. */
static fw_status lint_mould(fw_arena *arena, fw_process_flow *flow, int index,
                            const fw_process_change *c, fw_diags *diags) {
    fw_process_stack stack;
    double spread = c->spread && !c->spread->unknown ? c->spread->value : 1.0;
    if (!c->thickness || c->thickness->unknown) return FW_OK;
    FW_TRY(fw_process_flow_stack(arena, flow, index - 1, &stack, NULL));
    int field = strcmp(c->where, "field") == 0 ? FW_STACK_STRUCTURE : FW_STACK_FIELD;
    if (stack.n[field] == 0) return FW_OK;
    const char *mould = stack.cell[field][stack.n[field] - 1].material;
    double height = top_layer(&stack, field, mould), grown = c->thickness->value * spread;
    if (isnan(height) || grown <= height) return FW_OK;
    char up[32], high[32];
    fw_number_text(up, sizeof up, grown * 1e6, 4);
    fw_number_text(high, sizeof high, height * 1e6, 4);
    fw_diag_warning(diags, 273, c->place,
                    "step %s plates up to %s um into a mould only %s um "
                    "high; use a higher mould or plate less",
                    flow->step[index].id, up, high);
    return fw_process_flow_add_reason(
        arena, flow, 0,
        fw_arena_printf(arena,
                        "step %s plates up to %s um where the mould of %s is %s um high: "
                        "the metal grows over it and closes the gaps. Nearest change: a "
                        "mould above %s um, or thinner plating",
                        flow->step[index].id, up, fw_process_flow_material_name(flow, mould), high,
                        up));
}

static const fw_quantity *derived_named(const fw_process_step *s, const char *name) {
    for (int i = 0; i < s->nderived; i++)
        if (s->derived[i]->id && strcmp(s->derived[i]->id, name) == 0) return s->derived[i];
    return NULL;
}

/* A derived value above what the pack allows it (<derive most>): what a bath gives to one wafer,
   for example. Test: test_lint.c, most. */
static fw_status lint_most(fw_arena *arena, fw_process_flow *flow, const fw_process_step *s,
                           const fw_process_derive *d, fw_diags *diags) {
    const fw_quantity *q = derived_named(s, d->name);
    if (!q || q->unknown || !d->most || d->most->unknown || q->value <= d->most->value)
        return FW_OK;
    char is[32], most[32];
    fw_quantity limit = *d->most;
    limit.unit = q->unit;
    fw_number_text(is, sizeof is, fw_quantity_in_unit(q), 4);
    fw_number_text(most, sizeof most, fw_quantity_in_unit(&limit), 4);
    const char *gap = strcmp(q->unit, "1") == 0 ? "" : " ", *unit = gap[0] ? q->unit : "";
    fw_diag_warning(diags, 279, s->place, "step %s: %s is %s%s%s, above the %s%s%s of %s", s->id,
                    d->name, is, gap, unit, most, gap, unit, d->most->id);
    const char *why = fw_arena_printf(
        arena, "step %s: %s is %s%s%s, above the limit of %s%s%s (%s; %s)", s->id, d->name, is, gap,
        unit, most, gap, unit, d->most->id, fw_quantity_value_status_text(d->most->status));
    return fw_process_flow_add_reason(arena, flow, -1, why);
}

fw_status fw_process_lint_computed(fw_arena *arena, fw_process_flow *flow, fw_diags *diags) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->nexposed; k++)
            FW_TRY(lint_loss(arena, flow, i, &s->exposed[k], diags));
        for (int k = 0; k < s->nderive; k++)
            FW_TRY(lint_most(arena, flow, s, &s->derive[k], diags));
        for (int k = 0; k < s->nchange && strcmp(s->op, "plate") == 0; k++)
            if (strcmp(s->change[k].kind, "add") == 0 && strcmp(s->change[k].where, "all") != 0)
                FW_TRY(lint_mould(arena, flow, i, &s->change[k], diags));
    }
    return FW_OK;
}
