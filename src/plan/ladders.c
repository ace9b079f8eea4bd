/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ladders of a plan: every hinge in every flow. */
#include "plan/ladder.h"
#include "plan/stages.h"
#include <math.h>

typedef struct climber {
    fw_plan *plan;
    fw_plan_ladders *all;
    int wanted;
} climber;

const char *fw_plan_ladder_id(const fw_plan_ladder *l) {
    return l->mechanism->pin[l->hinge->pin].id;
}

static fw_plan_ladder_case case_of(const climber *k, const fw_plan_ladder *l) {
    return (fw_plan_ladder_case){k->plan->arena, l->mechanism, l->hinge, &k->plan->diags};
}

/* the ladder that a hinge like this one has climbed already; -1: none */
static int before(const climber *k, const fw_plan_ladder *l) {
    const fw_plan_ladder_case mine = case_of(k, l);
    for (int i = 0; &k->all->item[i] != l; i++) {
        const fw_plan_ladder_case other = case_of(k, &k->all->item[i]);
        if (k->all->item[i].shared < 0 && fw_plan_ladder_alike(&mine, &other)) return i;
    }
    return -1;
}

static bool takes(const climber *k, const fw_plan_ladder *l, int i,
                  const fw_plan_ladder_level *level) {
    if (k->wanted >= 0) return i == k->wanted;
    if (!level->external || k->wanted == FW_LADDER_ALL) return true;
    return k->wanted == FW_LADDER_AUTO && !l->reached;
}

static fw_status climb(const climber *k, fw_plan_ladder *l) {
    size_t count;
    const fw_plan_ladder_level *level = fw_plan_ladder_levels(&count);
    const fw_plan_ladder_case c = case_of(k, l);
    l->shared = before(k, l);
    for (int i = 0; i < (int)count && l->shared < 0; i++) {
        if (!takes(k, l, i, &level[i])) continue;
        FW_TRY(fw_plan_ladder_climb(&c, &level[i], k->wanted != FW_LADDER_ONCE, &l->row[l->rows]));
        l->rows++;
        fw_plan_ladder_pick(l, k->all->accuracy);
    }
    if (l->shared >= 0) { /* the numbers are in the hinge's own frame: only its place is another */
        const fw_plan_ladder *from = &k->all->item[l->shared];
        for (l->rows = 0; l->rows < from->rows; l->rows++)
            l->row[l->rows] = from->row[l->rows];
        fw_plan_ladder_pick(l, k->all->accuracy);
    }
    for (int i = 0; i < l->rows; i++)
        fw_plan_ladder_place(l->mechanism, l->hinge, l->row[i].at_m, l->row[i].centre_m);
    fw_plan_ladder_drift_of(l->mechanism, l->hinge, &l->drift);
    return FW_OK;
}

fw_status fw_plan_ladders_run(fw_plan *plan, int wanted, fw_plan_ladders *out) {
    const fw_layout *layout = NULL;
    fw_diags drawing = fw_diags_new(plan->arena);
    *out = (fw_plan_ladders){.accuracy = plan->options.verdict.motion.accuracy};
    const climber k = {plan, out, wanted};
    if (fw_layout_build(plan->arena, plan->device, &drawing, &layout) != FW_OK) layout = NULL;
    size_t most = (size_t)plan->nflow * (size_t)plan->device->nrevolute;
    FW_NEED(out->item = fw_arena_array(plan->arena, fw_plan_ladder, most));
    for (int i = 0; i < plan->nflow; i++) {
        const fw_mechanism *m;
        const fw_mechanism_variant *v = &plan->flow[i].variant;
        FW_TRY(fw_mechanism_build(plan->arena, plan->device, layout, v, &plan->diags, &m));
        for (int h = 0; h < m->nhinge; h++) {
            fw_plan_ladder *l = &out->item[out->count++];
            *l = (fw_plan_ladder){.flow = v->flow, .mechanism = m, .hinge = &m->hinge[h]};
            FW_TRY(climb(&k, l));
        }
    }
    return FW_OK;
}

fw_status fw_plan_report_hinges(fw_plan *plan, const fw_plan_ladders *all, fw_report_hinge **out) {
    fw_report_hinge *shown;
    FW_NEED(shown = fw_arena_array(plan->arena, fw_report_hinge, (size_t)all->count));
    for (int i = 0; i < all->count; i++) {
        const fw_plan_ladder *l = &all->item[i];
        const fw_mechanism_hinge *h = l->hinge;
        int body = l->mechanism->pin[h->pin].body_a;
        double phi = body == FW_GROUND ? 0 : l->mechanism->body[body].phi_rad;
        shown[i] =
            (fw_report_hinge){.id = fw_plan_ladder_id(l),
                              .flow = l->flow,
                              .hinge = h,
                              .cover_rad = {h->cover_from_rad + phi, h->cover_to_rad + phi},
                              .point = l->drift.point,
                              .npoint = FW_DRIFT_POINTS,
                              .gap_m = l->drift.surfaces.gap_m,
                              .contact_rad = {l->drift.contact_rad[0], l->drift.contact_rad[1]},
                              .level = l->row,
                              .nlevel = l->rows};
    }
    *out = shown;
    return FW_OK;
}
