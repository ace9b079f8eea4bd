/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria, the assembled position and the workspace as arrays. */
#include "plan/arrays.h"
#include "probe/probe.h"
#include "report/report.h"
#include <math.h>

/* ---- equilibrium ---- */

static fw_status statics_probes(fw_design *d, fw_plan_arrays *to) {
    const fw_mechanism *m = d->mechanism;
    const size_t n = (size_t)fw_probe_count(m);
    fw_probe *probe;
    fw_plan_axis axis = {0, NULL};
    const char **label = fw_plan_labels(to, n);
    const char **unit_of = fw_plan_labels(to, n);
    double *seen = fw_arena_array(to->arena, double, n);
    if (!label || !unit_of || !seen) return FW_NOMEM;
    FW_TRY(fw_probe_bind(to->arena, m, d->scene, d->statics->loads, &probe));
    for (size_t i = 0; i < n; i++) {
        if (!fw_report_probe_moves(&probe[i])) continue;
        label[axis.n] = probe[i].asked->id;
        unit_of[axis.n] = probe[i].kind->unit;
        seen[axis.n++] = fw_probe_at_equilibrium(&probe[i], d->scene, d->statics);
    }
    axis.label = label;
    fw_plan_array_copy(to, (fw_plan_array_name){"probe", "*", "what each probe sees"}, 0, axis,
                       seen);
    const char **unit = fw_plan_array_text(
        to, (fw_plan_array_name){"probe_unit", "", "SI unit of each probe"}, axis);
    for (size_t i = 0; unit && i < axis.n; i++)
        unit[i] = unit_of[i];
    return FW_OK;
}

fw_status fw_plan_numbers_statics(fw_design *d, fw_plan_arrays *to) {
    const fw_statics *s = d->statics;
    const fw_plan_axis one = {1, NULL};
    fw_plan_bodies b;
    FW_TRY(fw_plan_bodies_of(to, d->mechanism, &b));
    fw_plan_array_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "poses of reference frames"},
                        0, s->q);
    fw_plan_array_poses(to, &b,
                        (fw_plan_array_name){"rest_q", "m,m,rad", "the same where nothing acts"}, 0,
                        s->rest_q);
    fw_plan_array_centres(to, &b, 0, s->q);
    fw_plan_array_copy(
        to,
        (fw_plan_array_name){"angle", "rad", "rotation of each revolute joint from its free angle"},
        0, b.pin, s->angle_rad);
    fw_plan_array_forces(to, &b, 0, s->reaction_N, s->joint_N, s->driver_N);
    fw_plan_array_copy(to,
                       (fw_plan_array_name){"eigenvalue", "1/s^2",
                                            "of the tangent stiffness over the mass, ascending; "
                                            "below 0: unstable"},
                       0, (fw_plan_axis){(size_t)s->dof, NULL}, s->eigenvalue_per_s2);
    int32_t *stable = fw_plan_array_whole(to, (fw_plan_array_name){"stable", "1", "0: it is not"},
                                          FW_ARRAY_TRUTH, one);
    if (stable) *stable = s->negative == 0;
    fw_plan_array_copy(
        to, (fw_plan_array_name){"residual", "1", "force that is left over the largest force"}, 0,
        one, &s->residual);
    return statics_probes(d, to);
}

fw_status fw_plan_numbers_load_path(fw_design *d, fw_plan_arrays *to) {
    const fw_statics_path *p = d->statics->path;
    fw_plan_bodies b;
    if (!p || p->count == 0) return FW_OK;
    const size_t rows = (size_t)p->count;
    const fw_plan_axis points = {rows, NULL};
    FW_TRY(fw_plan_bodies_of(to, d->mechanism, &b));
    fw_plan_array_copy(
        to, (fw_plan_array_name){"factor", "1", "of the loads: 0 at rest, 1 all of them"}, 0,
        points, p->factor);
    fw_plan_array_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "poses of reference frames"},
                        rows, p->q);
    fw_plan_array_centres(to, &b, rows, p->q);
    fw_plan_array_copy(
        to,
        (fw_plan_array_name){"angle", "rad", "rotation of each revolute joint from its free angle"},
        rows, b.pin, p->angle_rad);
    fw_plan_array_forces(to, &b, rows, p->reaction_N, p->joint_N, p->driver_N);
    fw_plan_array_copy(
        to, (fw_plan_array_name){"lowest", "1/s^2", "least eigenvalue; below 0: unstable"}, 0,
        points, p->lowest_per_s2);
    int32_t *negative = fw_plan_array_whole(
        to, (fw_plan_array_name){"negative", "1", "eigenvalues below 0"}, FW_ARRAY_WHOLE, points);
    const char **mark = fw_plan_array_text(
        to, (fw_plan_array_name){"kind", "", "what the point is, fold or bifurcation too"}, points);
    for (size_t i = 0; negative && mark && i < rows; i++) {
        negative[i] = p->negative[i];
        mark[i] = fw_report_path_mark(p->mark[i]);
    }
    return FW_OK;
}

/* ---- the assembled position ---- */

fw_status fw_plan_numbers_assembly(fw_design *d, fw_plan_arrays *to) {
    const fw_plan_assembly *in = &d->assembly;
    const fw_assembly *a = in->assembly;
    const fw_assembly_kinematics *k = in->kinematics;
    fw_plan_bodies b;
    FW_TRY(fw_plan_bodies_of(to, in->mechanism, &b));
    fw_plan_array_poses(
        to, &b, (fw_plan_array_name){"before", "m,m,rad", "as the file states them"}, 0, a->before);
    fw_plan_array_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "poses with closed joints"}, 0,
                        a->after);
    fw_plan_array_centres(to, &b, 0, a->after);
    fw_plan_array_copy(to, (fw_plan_array_name){"moved", "m", "of each centre of mass"}, 0, b.body,
                       a->moved_m);
    fw_plan_array_copy(to, (fw_plan_array_name){"turned", "rad", "of each body"}, 0, b.body,
                       a->turned_rad);
    if (!k) return FW_OK;
    fw_plan_array_velocities(
        to, &b, (fw_plan_array_name){"v", "m/s,m/s,rad/s", "velocities of reference frames"}, 0,
        k->q, 1, k->v);
    fw_plan_array_forces(to, &b, 0, k->reaction_N, k->joint_N, k->driver_N);
    return FW_OK;
}

/* ---- the workspace ---- */

static fw_status limits(fw_plan_arrays *to, const fw_report_workspace *w, fw_plan_axis flows) {
    const char **hinge = fw_plan_labels(to, FW_SIX);
    FW_NEED(hinge);
    for (int i = 0; w->nflow > 0 && i < FW_SIX; i++)
        hinge[i] = w->flow[0].mechanism->pin[i].id;
    const fw_plan_axis axis[2] = {flows, {FW_SIX, hinge}};
    double *limit = fw_plan_array_real(
        to, (fw_plan_array_name){"limit_angle", "rad", "of each hinge"}, 2, axis);
    double *share = fw_plan_array_real(
        to, (fw_plan_array_name){"boundary_share", "1", "of the boundary, by hinge; an estimate"},
        2, axis);
    for (size_t i = 0; limit && share && i < flows.n * FW_SIX; i++) {
        const fw_workspace_map *map = w->flow[i / FW_SIX].map;
        limit[i] = map->none ? (double)NAN : map->limit_rad[i % FW_SIX];
        share[i] = map->none ? (double)NAN : map->survey.share[i % FW_SIX];
    }
    return FW_OK;
}

static void extents(fw_plan_arrays *to, const fw_report_workspace *w, fw_plan_axis flows) {
    static const char *const bracket[2] = {"low", "high"};
    const double none = (double)NAN;
    const fw_plan_axis axis[3] = {flows, {2, bracket}, {3, fw_plan_pose_labels}};
    double *volume = fw_plan_array_real(
        to, (fw_plan_array_name){"volume", "m^2 rad", "of the reachable poses, proved bracket"}, 2,
        axis);
    double *least = fw_plan_array_real(
        to, (fw_plan_array_name){"least", "m,m,rad", "where the displacements end, proved bracket"},
        3, axis);
    double *most = fw_plan_array_real(
        to, (fw_plan_array_name){"most", "m,m,rad", "the other end, proved bracket"}, 3, axis);
    for (size_t i = 0; volume && least && most && i < flows.n; i++) {
        const fw_workspace_map *map = w->flow[i].map;
        volume[2 * i] = map->none ? none : map->volume.value.lo;
        volume[2 * i + 1] = map->none ? none : map->volume.value.hi;
        for (size_t c = 0; c < 3; c++) {
            least[6 * i + c] = map->none ? none : map->survey.least[c].lo;
            least[6 * i + 3 + c] = map->none ? none : map->survey.least[c].hi;
            most[6 * i + c] = map->none ? none : map->survey.most[c].lo;
            most[6 * i + 3 + c] = map->none ? none : map->survey.most[c].hi;
        }
    }
}

fw_status fw_plan_numbers_workspace(fw_design *d, fw_plan_arrays *to) {
    const fw_report_workspace *w = &d->workspace;
    const char **label = fw_plan_labels(to, (size_t)w->nflow);
    FW_NEED(label);
    const fw_plan_axis flows = {(size_t)w->nflow, label};
    for (int i = 0; i < w->nflow; i++)
        label[i] = w->flow[i].flow ? w->flow[i].flow : "";
    const char **flow =
        fw_plan_array_text(to, (fw_plan_array_name){"flow", "", "of the row"}, flows);
    const char **none = fw_plan_array_text(
        to, (fw_plan_array_name){"none", "", "why there is nothing; none: there is"}, flows);
    for (size_t i = 0; flow && none && i < flows.n; i++) {
        flow[i] = w->flow[i].flow;
        none[i] = w->flow[i].map->none;
    }
    extents(to, w, flows);
    return limits(to, w, flows);
}
