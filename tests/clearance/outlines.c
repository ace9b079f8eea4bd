/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What clearances are compared on, as JSON: outlines of every body as drawn, flattened to 0.5 nm,
   hinges' circles, poses of all bodies at many instants, what the verdict says, and gaps that are
   probed: at those instants, and their extremes.
     clearance_outlines DEVICE.xml SAMPLES
   Distances are no matter of this program: compare.py computes them. */
#include "plan/plan.h"
#include "geometry/segment.h"
#include <stdio.h>
#include <stdlib.h>

static void points(const fw_geometry_segment *s) {
    const double off_m = 5e-10;
    int n = 1;
    if (s->kind == FW_ARC) n = 1 + (int)(fabs(s->sweep_rad) / sqrt(8 * off_m / s->radius));
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 p = fw_geometry_segment_point(s, (double)i / n);
        printf("[%.13g,%.13g],", p.x, p.y);
    }
}

static void pieces(const fw_layout *layout) {
    const char *comma = "";
    printf("\"pieces\":[");
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->role != FW_ROLE_STRUCTURE && p->role != FW_ROLE_FRAME) continue;
        if (p->body < 0 && p->body != FW_GROUND && p->body != FW_ISLAND) continue;
        printf("%s{\"body\":%d,\"label\":\"%s\",\"outline\":[", comma, p->body < 0 ? -1 : p->body,
               p->label ? p->label : "");
        for (int k = 0; k < p->contour.count; k++)
            points(&p->contour.segment[k]);
        printf("[%.13g,%.13g]]}", p->contour.segment[0].a.x, p->contour.segment[0].a.y);
        comma = ",\n";
    }
    printf("],\n\"hinges\":[");
    comma = "";
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->role != FW_ROLE_FLEXURE || p->joint < 0) continue;
        const fw_layout_hinge_layout *h = &layout->hinge[p->joint];
        printf("%s[%d,%d,%.13g,%.13g,%.13g]", comma, h->lower, h->upper, h->centre.x, h->centre.y,
               h->keep_out_m);
        comma = ",";
    }
    printf("],\n");
}

static void motion_of(const fw_verdict_variant_verdict *v, int scene) {
    const fw_dynamics_motion *m = v->motion[scene];
    const fw_mechanism *mechanism = v->mechanism;
    printf("\"centres\":[");
    for (int b = 0; b < mechanism->nbody; b++)
        printf("%s[%.13g,%.13g,%.13g]", b ? "," : "", mechanism->body[b].x_m,
               mechanism->body[b].y_m, mechanism->body[b].phi_rad);
    printf("],\n\"q\":[");
    fw_dynamics_motion_rows(m, 0, m->nsample);
    for (int i = 0; i < m->nsample; i++) {
        printf("%s[%.13g", i ? ",\n" : "", m->t_s[i]);
        for (int k = 0; k < 3 * m->nbody; k++)
            printf(",%.13g", m->q[i * 3 * m->nbody + k]);
        printf("]");
    }
    printf("],\n");
}

static void gaps(fw_arena *arena, const fw_verdict_variant_verdict *v) {
    const fw_mechanism *mechanism = v->mechanism;
    const fw_dynamics_motion *m = v->motion[0];
    const char *comma = "";
    fw_probe *probe;
    printf("\"gaps\":[");
    if (fw_probe_bind(arena, mechanism, &mechanism->device->scene[0], m->loads, &probe) != FW_OK)
        exit(6);
    for (int i = 0; i < fw_probe_count(mechanism); i++) {
        const fw_probe_result *r = &v->probed[i];
        if (!probe[i].gap) continue;
        printf("%s{\"a\":%d,\"b\":%d,\"minimum\":%.13g,\"minimum_t\":%.13g,\"maximum\":%.13g,"
               "\"moved\":%.13g,\"error\":%.13g,\"m\":[",
               comma, probe[i].asked->body, probe[i].asked->body_b, r->minimum, r->minimum_t_s,
               r->maximum, r->moved, r->numeric);
        for (int k = 0; k < m->nsample; k++)
            printf("%s%.13g", k ? "," : "", fw_probe_at_row(&probe[i], m, k));
        printf("]}");
        comma = ",\n";
    }
    printf("],\n");
}

static void clearance(const fw_verdict_variant_verdict *v) {
    const fw_verdict_clearance *c = &v->clearance[0];
    if (v->nclearance == 0) {
        printf("\"clearance\":null}\n");
        return;
    }
    printf("\"clearance\":{\"m\":%.13g,\"low\":%.13g,\"left\":%.13g,\"moved\":%.13g,"
           "\"a\":%d,\"b\":%d,\"t\":%.13g,\"share\":%.9g,\"start\":%.13g,\"decision\":%d,"
           "\"looked\":%ld}}\n",
           c->least.m, fmax(c->least.low_m, -1), fmax(c->least.left_m, -1), c->least.moved_m,
           c->least.a, c->least.b, c->least.t_s, c->least.share, c->least.start_m, (int)c->decision,
           c->least.looked);
}

int main(int argc, char **argv) {
    fw_plan_options options = {.verdict = {.corners = FW_CORNERS_NONE}};
    if (argc != 3) return 2;
    options.verdict.motion.samples = atoi(argv[2]);
    fw_plan *plan = fw_plan_new(&options);
    if (!plan) return 6;
    fw_status status = fw_plan_load(plan, argv[1]);
    if (status == FW_OK) status = fw_plan_judge(plan);
    int ok = status == FW_OK && plan->verdict.nvariant > 0 && plan->verdict.layout &&
             plan->verdict.variant[0].motion[0] && !plan->verdict.variant[0].motion[0]->ended;
    if (ok) {
        printf("{");
        pieces(plan->verdict.layout);
        motion_of(&plan->verdict.variant[0], 0);
        gaps(plan->arena, &plan->verdict.variant[0]);
        clearance(&plan->verdict.variant[0]);
    }
    for (size_t i = 0; !ok && i < plan->diags.count; i++)
        if (plan->diags.item[i].severity == FW_ERROR)
            fprintf(stderr, "%s\n", plan->diags.item[i].message);
    fw_plan_free(plan);
    return ok ? 0 : 1;
}
