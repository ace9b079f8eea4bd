/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Corners of a flow: read from the pack, and handed to the verdict as independent inputs. */
#include "process/made.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

/* ---- reading ---- */

static const struct {
    const char *word;
    fw_dimension dimension;
} kind[] = {{"edge", FW_DIM_LENGTH},
            {"taper", {.rad = 1}},
            {"anisotropy", {0}},
            {"thickness", FW_DIM_LENGTH},
            {"youngs", {0}}};
enum { KINDS = sizeof kind / sizeof kind[0] };

static const fw_quantity *quantity(fw_pack *pack, const fw_element *e, const char *name, int of) {
    const fw_attribute *a = fw_pack_get(e, name);
    if (!a) return NULL;
    const fw_quantity *q = fw_pack_find(pack, a, FW_ID_QUANTITY);
    if (q && !fw_dimension_equal(q->dimension, kind[of].dimension))
        fw_diag_error(pack->diags, 260, a->place, "'%s' is no %s; give a quantity of that kind",
                      a->value, kind[of].word);
    return q;
}

static void read_corner(fw_pack *pack, const fw_element *e) {
    fw_flow *f = pack->flow;
    int of = 0;
    while (of < KINDS && strcmp(kind[of].word, fw_pack_text(e, "of")) != 0)
        of++;
    if (of == KINDS) return; /* said by the schema */
    fw_corner *c = &f->corner[f->ncorner++];
    *c = (fw_corner){.of = (fw_corner_of)of,
                     .name = fw_pack_text(e, "name"),
                     .q = quantity(pack, e, "q", of),
                     .assumed = quantity(pack, e, "assumed", of),
                     .place = e->place};
    const fw_quantity *layer = f->thickness;
    if (of == FW_CORNER_THICKNESS && layer && c->q != layer && !layer->unknown)
        c->aim_m = layer->value;
    if ((of == FW_CORNER_YOUNGS) == (fw_pack_get(e, "q") != NULL))
        fw_diag_error(pack->diags, 260, e->place,
                      of == FW_CORNER_YOUNGS
                          ? "the corner of Young's modulus is the material's own; it takes no q"
                          : "a corner of '%s' needs q: the quantity whose range it is",
                      kind[of].word);
}

void fw_pack_corners(fw_pack *pack) {
    for (const fw_element *e = pack->root->first_child; e; e = e->next)
        if (strcmp(e->name, "corner") == 0) read_corner(pack, e);
    if (pack->flow->ncorner > FW_MADE_INPUTS)
        fw_diag_error(pack->diags, 260, pack->flow->corner[FW_MADE_INPUTS].place,
                      "a flow has at most %d corners: join those that move the same edge",
                      FW_MADE_INPUTS);
}

/* ---- inputs of the verdict ---- */

/* the range: lo to hi where the pack gives that, else two standard uncertainties either way */
static void set_range(fw_made_input *in, const fw_quantity *q) {
    in->q = *q;
    in->nominal = q->value;
    in->sigma = q->uncertainty;
    in->low = q->interval ? q->low : q->value - 2.0 * q->uncertainty;
    in->high = q->interval ? q->high : q->value + 2.0 * q->uncertainty;
}

static void scale_range(fw_made_input *in, double by) {
    in->nominal *= by, in->low *= by, in->high *= by, in->sigma *= by;
}

/* the step that cuts the device layer */
static const fw_step *cutting_step(const fw_flow *flow) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++)
            if (flow->step[i].change[k].anisotropy) return &flow->step[i];
    return NULL;
}

/* u(z) = (1 - A)(E - z) from every wall at depth z, E = D (1 + over-etch): at mid-depth the edge
   goes back by (1 - A)(E - D/2), and one face is left 2 (1 - A) D wider than the other. D, E m;
   A 1. A known A is in the bias of the mask, so that edges are even there. Source:
   docs/theory/process.md; test_made.c against fw_undercut_widths. */
static void anisotropy(const fw_step *step, double depth_m, bool known, fw_made_input *in) {
    double etched = depth_m * (1.0 + step->overrun);
    in->edge_m = etched - 0.5 * depth_m;
    in->flare_m = -depth_m;
    in->drawn = 1.0;
    in->even = known ? in->nominal : 1.0;
    in->high = fmin(in->high, 1.0);
    in->nominal = fmin(in->nominal, 1.0);
}

static bool fill(const fw_flow *flow, const fw_corner *c, const fw_variant *v, fw_made_input *in) {
    bool unknown = c->q && c->q->unknown;
    const fw_quantity *q = c->of == FW_CORNER_YOUNGS ? &v->material.youngs
                           : unknown                 ? c->assumed
                                                     : c->q;
    if (!q || q->unknown) return false;
    *in = (fw_made_input){.name = c->name, .unknown = unknown ? c->q->id : NULL};
    set_range(in, q);
    const fw_step *step;
    switch (c->of) {
    case FW_CORNER_EDGE: /* its known part is in the bias of the mask */
        in->edge_m = 1.0;
        in->drawn = in->even = in->nominal;
        break;
    case FW_CORNER_TAPER:
        in->flare_m = v->thickness_m;
        break;
    case FW_CORNER_ANISOTROPY:
        step = cutting_step(flow);
        if (!step) return false;
        anisotropy(step, v->thickness_m, !unknown, in);
        break;
    case FW_CORNER_THICKNESS:
        /* the device may ask for another one; what is measured may lie beside what was aimed at */
        scale_range(in, v->thickness_m / (c->aim_m > 0.0 ? c->aim_m : q->value));
        in->thickness = 1.0 / v->thickness_m;
        in->drawn = v->thickness_m;
        break;
    case FW_CORNER_YOUNGS:
        in->youngs = 1.0 / q->value;
        in->drawn = q->value;
        break;
    }
    return in->high > in->low;
}

fw_status fw_flow_made(fw_arena *arena, const fw_flow *flow, const fw_variant *variant,
                       const fw_made_input **input, int *ninput) {
    fw_made_input *list = fw_arena_array(arena, fw_made_input, FW_MADE_INPUTS);
    FW_NEED(list);
    *ninput = 0;
    for (int i = 0; i < flow->ncorner && *ninput < FW_MADE_INPUTS; i++)
        *ninput += fill(flow, &flow->corner[i], variant, &list[*ninput]);
    *input = list;
    return FW_OK;
}
