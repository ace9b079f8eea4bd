/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A whole report input made by hand: the reference six-bar with simple outlines, motions from
   closed kinematics of the two legs, invented verdicts, masks and flows. */
#ifndef FW_TEST_REPORT_FIXTURE_H
#define FW_TEST_REPORT_FIXTURE_H
#include "report/report.h"
#include <math.h>
#include <stdlib.h>

enum { SIX = 6, FIVE = 5, SAMPLES = 1500, VARIANTS = 2 };

typedef struct fixture {
    fw_device device;
    fw_layout layout;
    fw_mechanism mechanism[VARIANTS];
    fw_mechanism_variant variant[VARIANTS];
    fw_verdict_variant_verdict variant_verdict[VARIANTS];
    fw_verdict verdict;
    fw_report_flow flow[VARIANTS];
    fw_report_input input;
    fw_process_flow process[VARIANTS];
    fw_mask mask;
    fw_diags diags;
} fixture;

static const fw_geometry_vec2 fixture_hinge[SIX] = {{0.70e-3, 0.15e-3}, {0.20e-3, 1.40e-3},
                                                    {0.80e-3, 2.70e-3}, {2.20e-3, 2.75e-3},
                                                    {2.85e-3, 1.45e-3}, {2.30e-3, 0.15e-3}};
static const char *const fixture_name[SIX] = {"A", "B", "C", "D", "E", "F"};
static const char *const fixture_link[FIVE] = {"AB", "BC", "CD", "DE", "EF"};

/* memory for the fixture itself is never short: tests that fail allocations do so afterwards */
static void *fixture_need(void *pointer) {
    if (!pointer) abort();
    return pointer;
}
#define FIXTURE_ARRAY(arena, type, n) ((type *)fixture_need(fw_arena_array((arena), type, (n))))

static const char **fixture_texts(fw_arena *arena, const char *a, const char *b) {
    const char **list = FIXTURE_ARRAY(arena, const char *, 2);
    list[0] = a;
    list[1] = b;
    return list;
}

static void fixture_device(fw_arena *arena, fw_device *d) {
    static const double length[SIX] = {300e-6, 250e-6, 200e-6, 240e-6, 350e-6, 400e-6};
    static const double width[SIX] = {9e-6, 8.5e-6, 8e-6, 8e-6, 9e-6, 10e-6};
    *d = (fw_device){.file = "device.xml", .name = "reference-six-bar", .six_bar = true};
    d->nflexure = d->nrevolute = SIX;
    d->nbody = FIVE;
    d->flexure = FIXTURE_ARRAY(arena, fw_device_flexure, SIX);
    d->revolute = FIXTURE_ARRAY(arena, fw_device_revolute, SIX);
    d->body = FIXTURE_ARRAY(arena, fw_device_body, FIVE);
    for (int j = 0; j < SIX; j++) {
        double angle = 4.18879020478639;
        d->flexure[j] = (fw_device_flexure){.id = fixture_name[j],
                                            .kind = FW_FLEXURE_CSFH,
                                            .length_m = length[j],
                                            .angle_rad = angle,
                                            .radius_m = length[j] / angle,
                                            .width_m = width[j],
                                            .gap_m = 8e-6,
                                            .length_given = true};
        d->revolute[j] = (fw_device_revolute){.id = fixture_name[j],
                                              .body_a = j == 0 ? FW_GROUND : j - 1,
                                              .body_b = j == SIX - 1 ? FW_GROUND : j,
                                              .x_m = fixture_hinge[j].x,
                                              .y_m = fixture_hinge[j].y,
                                              .flexure = j};
    }
    for (int b = 0; b < FIVE; b++)
        d->body[b] = (fw_device_body){.id = fixture_link[b],
                                      .platform = b == 2,
                                      .x_m = 0.5 * (fixture_hinge[b].x + fixture_hinge[b + 1].x),
                                      .y_m = 0.5 * (fixture_hinge[b].y + fixture_hinge[b + 1].y)};
    d->parameter = FIXTURE_ARRAY(arena, fw_device_parameter, 2);
    d->nparameter = 2;
    d->parameter[0] = (fw_device_parameter){.name = "arc",
                                            .doc = "subtended angle of every hinge arc",
                                            .value = 4.18879020478639,
                                            .unit = "deg"};
    d->parameter[1] = (fw_device_parameter){.name = "link",
                                            .doc = "width of the four links",
                                            .value = 120e-6,
                                            .unit = "um",
                                            .overridden = true};
    d->scene = FIXTURE_ARRAY(arena, fw_device_scene, 2);
    d->nscene = 2;
    fw_device_force *force = FIXTURE_ARRAY(arena, fw_device_force, 2);
    fw_device_torque *torque = FIXTURE_ARRAY(arena, fw_device_torque, 2);
    force[0] = (fw_device_force){.body = 2, .fx_N = 0.35e-3, .fy_N = -0.20e-3};
    force[1] = (fw_device_force){.body = 2, .fx_N = 4.4e-6, .fy_N = -2.5e-6};
    torque[0] = (fw_device_torque){.body = 0, .value_Nm = -0.15e-6};
    torque[1] = (fw_device_torque){.body = 0, .value_Nm = -1.9e-9};
    d->scene[0] = (fw_device_scene){.name = "step-load",
                                    .flow = "al-masked-rie",
                                    .duration_s = 10e-3,
                                    .force = &force[0],
                                    .nforce = 1,
                                    .torque = &torque[0],
                                    .ntorque = 1};
    d->scene[1] = (fw_device_scene){.name = "gentle-step",
                                    .flow = "copper-on-porous-silicon",
                                    .duration_s = 10e-3,
                                    .force = &force[1],
                                    .nforce = 1,
                                    .torque = &torque[1],
                                    .ntorque = 1};
    d->workspace = FIXTURE_ARRAY(arena, fw_device_workspace_box, 1);
    d->nworkspace = 1;
    d->workspace[0] = (fw_device_workspace_box){
        "al-masked-rie", -150e-6, 150e-6, -60e-6, 60e-6, -0.0349, 0.0349, {"device.xml", 48, 3}};
    d->safety_factor = 1.5;
}

static void fixture_piece(fw_layout *layout, fw_layout_role role, int body, int joint,
                          const char *label, fw_geometry_contour contour) {
    layout->piece[layout->npiece++] = (fw_layout_piece){role, body, joint, label, contour};
}

static void fixture_layout(fw_arena *arena, const fw_device *d, fw_layout *layout) {
    *layout = (fw_layout){.drawn = true, .narrowest_gap_m = 8e-6};
    layout->die = (fw_geometry_box){-1.3e-3, -1.0e-3, 4.3e-3, 4.0e-3};
    layout->window = (fw_geometry_box){-1.0e-3, -0.7e-3, 4.0e-3, 3.7e-3};
    layout->piece = FIXTURE_ARRAY(arena, fw_layout_piece, 32);
    layout->hinge = FIXTURE_ARRAY(arena, fw_layout_hinge_layout, SIX);
    layout->body = FIXTURE_ARRAY(arena, fw_layout_body_layout, FIVE);
    fw_geometry_contour c;
    for (int b = 0; b < FIVE; b++) {
        fw_geometry_vec2 p = fixture_hinge[b], q = fixture_hinge[b + 1];
        double l = hypot(q.x - p.x, q.y - p.y), ux = (q.x - p.x) / l, uy = (q.y - p.y) / l;
        double cut = 60e-6;
        fw_geometry_vec2 from = {p.x + cut * ux, p.y + cut * uy},
                         to = {q.x - cut * ux, q.y - cut * uy};
        fixture_need(fw_geometry_contour_bar(arena, from, to, b == 2 ? 400e-6 : 120e-6, &c) == FW_OK
                         ? &c
                         : NULL);
        fixture_piece(layout, FW_ROLE_STRUCTURE, b, FW_NONE, "link", c);
        layout->body[b] = (fw_layout_body_layout){
            .area_m2 = l * 120e-6, .centroid = {0.5 * (p.x + q.x), 0.5 * (p.y + q.y)}};
    }
    for (int j = 0; j < SIX; j++) {
        const fw_device_flexure *f = &d->flexure[j];
        fw_geometry_vec2 w = fixture_hinge[j];
        double axis = atan2(w.y - 1.4e-3, w.x - 1.5e-3);
        double centre = f->radius_m * sin(0.5 * f->angle_rad) / (0.5 * f->angle_rad);
        fw_geometry_vec2 o = {w.x - centre * cos(axis), w.y - centre * sin(axis)};
        fixture_need(fw_geometry_contour_ring_sector(
                         arena, o, f->radius_m - 0.5 * f->width_m, f->radius_m + 0.5 * f->width_m,
                         axis - 0.5 * f->angle_rad, f->angle_rad, &c) == FW_OK
                         ? &c
                         : NULL);
        fixture_piece(layout, FW_ROLE_FLEXURE, FW_GROUND, j, "flexure", c);
        layout->hinge[j] = (fw_layout_hinge_layout){.drawn = true,
                                                    .centre = w,
                                                    .arc_centre = o,
                                                    .axis_rad = axis,
                                                    .lower = d->revolute[j].body_a,
                                                    .upper = d->revolute[j].body_b,
                                                    .keep_out_m = 90e-6};
    }
    static const double anchor[2] = {0.70e-3, 2.30e-3};
    for (int k = 0; k < 2; k++) {
        fixture_need(fw_geometry_contour_rectangle(arena,
                                                   (fw_geometry_box){anchor[k] - 150e-6, -0.7e-3,
                                                                     anchor[k] + 150e-6, 0.09e-3},
                                                   &c) == FW_OK
                         ? &c
                         : NULL);
        fixture_piece(layout, FW_ROLE_STRUCTURE, FW_GROUND, FW_NONE, "base", c);
    }
    fixture_need(fw_geometry_contour_disc(arena, (fw_geometry_vec2){1.5e-3, -0.5e-3}, 60e-6, &c) ==
                         FW_OK
                     ? &c
                     : NULL);
    fixture_piece(layout, FW_ROLE_MARK, FW_GROUND, FW_NONE, "mark", c);
}

/* where the middle hinge of a leg is, on the side where it was drawn */
static fw_geometry_vec2 fixture_knee(fw_geometry_vec2 root, fw_geometry_vec2 knee0,
                                     fw_geometry_vec2 tip0, fw_geometry_vec2 tip) {
    double a = hypot(knee0.x - root.x, knee0.y - root.y);
    double b = hypot(tip0.x - knee0.x, tip0.y - knee0.y);
    double dx = tip.x - root.x, dy = tip.y - root.y, d = hypot(dx, dy);
    double along = (a * a - b * b + d * d) / (2.0 * d), off = sqrt(a * a - along * along);
    double side = (tip0.x - root.x) * (knee0.y - root.y) - (tip0.y - root.y) * (knee0.x - root.x);
    off = side > 0.0 ? off : -off;
    return (fw_geometry_vec2){root.x + along * dx / d - off * dy / d,
                              root.y + along * dy / d + off * dx / d};
}

static double fixture_turn(fw_geometry_vec2 p0, fw_geometry_vec2 q0, fw_geometry_vec2 p,
                           fw_geometry_vec2 q) {
    return remainder(atan2(q.y - p.y, q.x - p.x) - atan2(q0.y - p0.y, q0.x - p0.x),
                     6.283185307179586);
}

static void fixture_pose(double dx, double dy, double turn, double q[3 * FIVE]) {
    fw_geometry_vec2 h[SIX];
    const fw_geometry_vec2 *h0 = fixture_hinge;
    fw_geometry_vec2 m = {0.5 * (h0[2].x + h0[3].x), 0.5 * (h0[2].y + h0[3].y)};
    h[0] = h0[0];
    h[5] = h0[5];
    for (int k = 2; k <= 3; k++) {
        double x = h0[k].x - m.x, y = h0[k].y - m.y;
        h[k] = (fw_geometry_vec2){m.x + dx + cos(turn) * x - sin(turn) * y,
                                  m.y + dy + sin(turn) * x + cos(turn) * y};
    }
    h[1] = fixture_knee(h0[0], h0[1], h0[2], h[2]);
    h[4] = fixture_knee(h0[5], h0[4], h0[3], h[3]);
    for (int b = 0; b < FIVE; b++) {
        q[3 * b] = 0.5 * (h[b].x + h[b + 1].x);
        q[3 * b + 1] = 0.5 * (h[b].y + h[b + 1].y);
        q[3 * b + 2] = fixture_turn(h0[b], h0[b + 1], h[b], h[b + 1]);
    }
}

static void fixture_peaks(fw_dynamics_motion *m) {
    for (int k = 0; k < m->npin; k++)
        for (int i = 0; i < m->nsample; i++) {
            double angle = m->angle_rad[i * m->npin + k];
            if (fabs(angle) > fabs(m->peak[k].angle_rad) || i == 0)
                m->peak[k] = (fw_dynamics_peak){angle, m->t_s[i], fabs(angle) * 2e-4};
        }
}

static const fw_dynamics_motion *fixture_motion(fw_arena *arena, double size) {
    fw_dynamics_motion *m = FIXTURE_ARRAY(arena, fw_dynamics_motion, 1);
    *m = (fw_dynamics_motion){
        .nbody = FIVE,
        .npin = SIX,
        .nsample = SAMPLES,
        .method = "chain",
        .integrator = "dop853",
        .stabilise = "projection",
        .reason = "explicit: the fastest decaying mode is slower than the accuracy needs"};
    m->t_s = FIXTURE_ARRAY(arena, double, SAMPLES);
    m->q = FIXTURE_ARRAY(arena, double, SAMPLES * 3 * FIVE);
    m->v = FIXTURE_ARRAY(arena, double, SAMPLES * 3 * FIVE);
    m->accel = FIXTURE_ARRAY(arena, double, SAMPLES * 3 * FIVE);
    m->reaction_N = FIXTURE_ARRAY(arena, double, SAMPLES * 2 * SIX);
    m->angle_rad = FIXTURE_ARRAY(arena, double, SAMPLES *SIX);
    m->peak = FIXTURE_ARRAY(arena, fw_dynamics_peak, SIX);
    for (int i = 0; i < SAMPLES; i++) {
        double t = 10e-3 * i / (SAMPLES - 1);
        double ring = 1.0 - exp(-t / 5e-3) * cos(6.283185307179586 * 620.0 * t);
        double fast = exp(-t / 2e-3) * sin(6.283185307179586 * 2300.0 * t);
        double *q = m->q + i * 3 * FIVE;
        m->t_s[i] = t;
        fixture_pose(size * 95e-6 * ring, size * (-30e-6 * ring + 9e-6 * fast),
                     size * (0.016 * ring + 0.006 * fast), q);
        for (int j = 0; j < SIX; j++)
            m->angle_rad[i * SIX + j] =
                (j < FIVE ? q[3 * j + 2] : 0.0) - (j > 0 ? q[3 * (j - 1) + 2] : 0.0);
        for (int k = 0; i && k < 3 * FIVE; k++)
            m->v[i * 3 * FIVE + k] = (q[k] - q[k - 3 * FIVE]) / (t - m->t_s[i - 1]);
    }
    fixture_peaks(m);
    m->stats = (fw_dynamics_motion_stats){.steps = 412,
                                          .rejected = 17,
                                          .rhs = 5148,
                                          .projections = 429,
                                          .cpu_s = 0.0123,
                                          .max_constraint_norm = 3.1e-15,
                                          .max_velocity_norm = 2.2e-14,
                                          .energy_error = 4.7e-9,
                                          .rtol = 1e-8,
                                          .assembly_moved_m = 2.3e-12};
    m->ledger.count = 4;
    m->ledger.item = FIXTURE_ARRAY(arena, fw_effect_entry, 4);
    m->ledger.item[0] = (fw_effect_entry){.id = "applied-load",
                                          .called_for = true,
                                          .active = true,
                                          .bound = HUGE_VAL,
                                          .reason = "it is the motion"};
    m->ledger.item[1] = (fw_effect_entry){.id = "joint-elasticity",
                                          .called_for = true,
                                          .active = true,
                                          .bound = 0.83,
                                          .reason = "hinges have springs"};
    m->ledger.item[2] = (fw_effect_entry){.id = "joint-damping",
                                          .called_for = true,
                                          .active = true,
                                          .bound = 0.041,
                                          .reason = "bound exceeds 0.001"};
    m->ledger.item[3] = (fw_effect_entry){.id = "gravity",
                                          .called_for = false,
                                          .active = false,
                                          .bound = 0.0,
                                          .reason = "the scene has no <gravity>"};
    return m;
}

static fw_quantity fixture_quantity(const char *id, double value, double uncertainty,
                                    const char *unit, fw_quantity_value_status status,
                                    const char *source) {
    return (fw_quantity){.id = id,
                         .value = value,
                         .uncertainty = uncertainty,
                         .unit = unit,
                         .status = status,
                         .source = source,
                         .place = {"base.xml", 12, 5}};
}

static void fixture_mechanism(fw_arena *arena, fixture *f, int i, double limit) {
    fw_mechanism *m = &f->mechanism[i];
    static const char *const flow[VARIANTS] = {"al-masked-rie", "copper-on-porous-silicon"};
    f->variant[i] = (fw_mechanism_variant){.flow = flow[i],
                                           .thickness_m = i ? 9e-6 : 50e-6,
                                           .explicit_mass_scale = i ? 0.69 : 1.0,
                                           .explicit_stiffness_scale = i ? 0.13 : 1.0,
                                           .explicit_damping_scale = i ? 0.299 : 1.0};
    f->variant[i].material = (fw_device_material){
        .id = i ? "copper-plated" : "silicon-100",
        .name = i ? "plated copper" : "silicon (100)",
        .youngs =
            fixture_quantity("youngs", i ? 117e9 : 169e9, 2e9, "GPa", FW_STATED, "device file"),
        .poisson = fixture_quantity("poisson", 0.28, 0.0, "1", FW_TYPICAL, "textbook value"),
        .density =
            fixture_quantity("density", i ? 8960.0 : 2330.0, 0.0, "kg/m3", FW_STATED, "handbook"),
        .strength =
            fixture_quantity("strength", i ? 180e6 : 2.5e9, 1e8, "Pa", FW_ASSUMED, "device file"),
        .criterion = i ? "proportional limit" : "fracture"};
    *m = (fw_mechanism){
        .device = &f->device, .variant = &f->variant[i], .nbody = FIVE, .npin = SIX, .nhinge = SIX};
    m->body = FIXTURE_ARRAY(arena, fw_mechanism_mass, FIVE);
    m->pin = FIXTURE_ARRAY(arena, fw_mechanism_pin, SIX);
    m->hinge = FIXTURE_ARRAY(arena, fw_mechanism_hinge, SIX);
    double q[3 * FIVE];
    fixture_pose(0.0, 0.0, 0.0, q);
    for (int b = 0; b < FIVE; b++)
        m->body[b] =
            (fw_mechanism_mass){fixture_link[b], 2e-8, 3e-15, q[3 * b], q[3 * b + 1], 0.0, {0, 0}};
    for (int j = 0; j < SIX; j++) {
        m->pin[j] = (fw_mechanism_pin){.id = fixture_name[j],
                                       .body_a = f->device.revolute[j].body_a,
                                       .body_b = f->device.revolute[j].body_b,
                                       .hinge = j};
        int a = m->pin[j].body_a;
        m->pin[j].ax_m = fixture_hinge[j].x - (a >= 0 ? q[3 * a] : 0.0);
        m->pin[j].ay_m = fixture_hinge[j].y - (a >= 0 ? q[3 * a + 1] : 0.0);
        m->hinge[j] =
            (fw_mechanism_hinge){.pin = j,
                                 .flexure = j,
                                 .closed_form = {.limit_angle_rad = limit * (1.0 + 0.15 * j),
                                                 .limit_uncertainty = 0.03,
                                                 .strain_per_rad = 0.11}};
    }
}

static void fixture_hinges(fw_arena *arena, fixture *f, int i, const fw_dynamics_motion *motion) {
    fw_verdict_variant_verdict *v = &f->variant_verdict[i];
    *v = (fw_verdict_variant_verdict){
        .variant = &f->variant[i], .mechanism = &f->mechanism[i], .nhinge = SIX, .governing = 0};
    v->motion = FIXTURE_ARRAY(arena, const fw_dynamics_motion *, 2);
    v->motion[i] = motion;
    v->hinge = FIXTURE_ARRAY(arena, fw_verdict_hinge_verdict, SIX);
    for (int j = 0; j < SIX; j++) {
        double limit = f->mechanism[i].hinge[j].closed_form.limit_angle_rad;
        fw_verdict_hinge_verdict *h = &v->hinge[j];
        *h = (fw_verdict_hinge_verdict){.id = fixture_name[j],
                                        .flow = f->variant[i].flow,
                                        .scene = f->device.scene[i].name,
                                        .joint = j,
                                        .limit_angle_rad = limit,
                                        .strain_limit = 0.0098};
        h->peak_angle_rad = motion->peak[j].angle_rad;
        h->angle_error_rad = motion->peak[j].error_rad;
        h->t_s = motion->peak[j].t_s;
        h->utilisation = fabs(h->peak_angle_rad) / limit;
        h->utilisation_low = 0.94 * h->utilisation;
        h->utilisation_high = 1.07 * h->utilisation;
        h->peak_strain = h->utilisation * h->strain_limit;
        h->decision = h->utilisation_low > 1.0    ? FW_REJECT
                      : h->utilisation_high > 1.0 ? FW_INCONCLUSIVE
                                                  : FW_ACCEPT;
        v->decision = h->decision > v->decision ? h->decision : v->decision;
        if (h->utilisation > v->hinge[v->governing].utilisation) v->governing = j;
    }
    if (i == 0) {
        static const bool yes[1] = {true};
        v->workspace = (fw_workspace_result){.required = true,
                                             .reachable = true,
                                             .certified = true,
                                             .volume_m2_rad = 2.5e-9,
                                             .fail_box = FW_NONE,
                                             .asked = yes,
                                             .box_reachable = yes};
        for (int j = 0; j < FW_SIX; j++)
            v->workspace.peak[j] =
                (fw_workspace_peak){0.01 * (j + 2), 1e-6, 150e-6, -60e-6, 0.0349};
    }
}

static void fixture_process(fw_arena *arena, fixture *f, int i) {
    fw_process_flow *p = &f->process[i];
    fw_quantity *q = FIXTURE_ARRAY(arena, fw_quantity, 2);
    q[0] =
        fixture_quantity("rie-rate-si", 3.3e-9, 5e-10, "um/min", FW_TYPICAL, "SF6/O2, open load");
    q[1] = fixture_quantity("al-rate", 5e-10, 1e-10, "Ao/s", FW_ASSUMED, "evaporator log");
    fw_process_argument *argument = FIXTURE_ARRAY(arena, fw_process_argument, 2);
    argument[0] = (fw_process_argument){"rate", &q[0]};
    argument[1] = (fw_process_argument){"rate", &q[1]};
    const char **missing = fixture_texts(arena, "resist thickness at 3000 rpm", "dose to clear");
    const char **contribution = fixture_texts(arena, "rate 12 %", "depth 2 %");
    p->step = FIXTURE_ARRAY(arena, fw_process_step, 4);
    p->nstep = 4;
    p->step[0] = (fw_process_step){.id = "clean", .title = "Clean the wafer", .in_source = true};
    p->step[1] =
        (fw_process_step){.id = "spin", .title = "Spin resist", .law = "spin", .in_source = true};
    p->step[1].time = (fw_process_time){.missing = missing, .nmissing = 2};
    p->step[2] = (fw_process_step){.id = "al",
                                   .title = "Evaporate 100 nm aluminium",
                                   .law = "rate",
                                   .argument = &argument[1],
                                   .nargument = 1,
                                   .in_source = false};
    p->step[2].time = (fw_process_time){.computable = true,
                                        .nominal_s = 200.0,
                                        .first_look_s = 160.0,
                                        .clear_by_s = 240.0,
                                        .stop_s = 250.0,
                                        .relative_uncertainty = 0.2,
                                        .status = FW_ASSUMED};
    p->step[3] = (fw_process_step){.id = "rie",
                                   .title = "Etch through the device layer",
                                   .law = "rate",
                                   .argument = argument,
                                   .nargument = 1,
                                   .in_source = true};
    p->step[3].time = (fw_process_time){.computable = true,
                                        .nominal_s = 15151.0,
                                        .first_look_s = 12800.0,
                                        .clear_by_s = 17500.0,
                                        .stop_s = 18100.0,
                                        .relative_uncertainty = 0.15,
                                        .status = FW_TYPICAL,
                                        .contribution = contribution,
                                        .ncontribution = 2};
    const char **reason = fixture_texts(
        arena, "selectivity of the aluminium mask at this load is typical, not measured",
        "the undercut leaves 6.4 um of the 9 um flexure");
    *p = (fw_process_flow){.id = f->variant[i].flow,
                           .version = "1",
                           .title = i ? "Copper on porous silicon" : "Aluminium-masked dry etch",
                           .step = p->step,
                           .nstep = 4,
                           .total_s = 15351.0,
                           .not_computable = 1,
                           .bias_m = 0.4e-6,
                           .bias_note = "undercut 0.4 um per edge; resist bias unknown",
                           .manufacturable = i ? 1 : -1,
                           .reason = reason,
                           .nreason = i ? 0 : 2};
}

static void fixture_mask(fw_arena *arena, fixture *f) {
    fw_mask_table *table = FIXTURE_ARRAY(arena, fw_mask_table, 1);
    fw_mask_layer *layer = FIXTURE_ARRAY(arena, fw_mask_layer, 3);
    *table = (fw_mask_table){.flow = "al-masked-rie",
                             .reading = "right-reading chrome down",
                             .layer = layer,
                             .nlayer = 3};
    layer[0] = (fw_mask_layer){.layer = 1,
                               .id = "structure",
                               .name = "structure",
                               .purpose = "silicon that stays",
                               .tone = "data dark",
                               .colour = "#0072B2",
                               .roles = 3,
                               .biased = true,
                               .min_width_m = 4e-6,
                               .min_space_m = 4e-6,
                               .rule_source = "resist"};
    layer[1] = (fw_mask_layer){.layer = 2,
                               .id = "frame",
                               .name = "frame",
                               .purpose = "die frame",
                               .tone = "data dark",
                               .colour = "#999999",
                               .roles = 4,
                               .min_width_m = 10e-6};
    layer[2] = (fw_mask_layer){.layer = 10,
                               .id = "marks",
                               .name = "marks",
                               .purpose = "alignment",
                               .tone = "data dark",
                               .colour = "url(javascript:x)",
                               .roles = 32};
    f->mask = (fw_mask){.table = table,
                        .cell = "REFERENCE_SIX_BAR",
                        .flow = "al-masked-rie",
                        .nshape = f->layout.npiece,
                        .bias_m = 0.4e-6,
                        .tolerance_m = 5e-9,
                        .box = f->layout.die};
    fw_mask_measure *measure = FIXTURE_ARRAY(arena, fw_mask_measure, 3);
    measure[0] = (fw_mask_measure){.shapes = 13,
                                   .vertices = 412,
                                   .area_m2 = 1.6e-6,
                                   .width_m = 8.8e-6,
                                   .space_m = 7.2e-6,
                                   .shortest_edge_m = 1.1e-6};
    measure[1] =
        (fw_mask_measure){.width_m = HUGE_VAL, .space_m = HUGE_VAL, .shortest_edge_m = HUGE_VAL};
    measure[2] = (fw_mask_measure){.shapes = 1,
                                   .vertices = 96,
                                   .area_m2 = 1.13e-8,
                                   .width_m = HUGE_VAL,
                                   .space_m = HUGE_VAL,
                                   .shortest_edge_m = 4e-6};
    f->mask.measure = measure;
    f->mask.shape = FIXTURE_ARRAY(arena, fw_mask_shape, (size_t)f->layout.npiece);
    for (int i = 0; i < f->layout.npiece; i++) {
        const fw_layout_piece *p = &f->layout.piece[i];
        fw_mask_shape *s = &f->mask.shape[i];
        *s = (fw_mask_shape){
            .layer = p->role == FW_ROLE_MARK ? 2 : 0, .piece = p, .contour = p->contour};
        s->polygon.vertex = FIXTURE_ARRAY(arena, fw_geometry_point, (size_t)p->contour.count);
        s->polygon.count = p->contour.count;
        for (int k = 0; k < p->contour.count; k++)
            s->polygon.vertex[k] =
                (fw_geometry_point){(int32_t)lround(1e9 * p->contour.segment[k].a.x),
                                    (int32_t)lround(1e9 * p->contour.segment[k].a.y)};
    }
}

/* `limit` in rad of hinge A: small rejects */
static fixture *fixture_new(fw_arena *arena, double limit) {
    fixture *f = FIXTURE_ARRAY(arena, fixture, 1);
    fixture_device(arena, &f->device);
    fixture_layout(arena, &f->device, &f->layout);
    for (int i = 0; i < VARIANTS; i++) {
        fixture_mechanism(arena, f, i, limit * (i ? 0.25 : 1.0));
        fixture_hinges(arena, f, i, fixture_motion(arena, i ? 0.12 : 1.0));
        fixture_process(arena, f, i);
        f->flow[i] = (fw_report_flow){.variant = &f->variant_verdict[i], .flow = &f->process[i]};
    }
    fixture_mask(arena, f);
    f->flow[0].mask = &f->mask;
    f->flow[1].mask_error = "space 3.1 um between link BC and flexure C is below 4 um (resist)";
    fw_verdict *v = &f->verdict;
    *v = (fw_verdict){.decision = f->variant_verdict[0].decision,
                      .variant = f->variant_verdict,
                      .nvariant = VARIANTS,
                      .hinge = f->variant_verdict[0].hinge,
                      .nhinge = SIX,
                      .governing = f->variant_verdict[0].governing,
                      .accuracy_wanted = 1e-3,
                      .accuracy_estimated = 2.1e-4};
    if (v->decision != FW_ACCEPT) {
        fw_device_set *set = FIXTURE_ARRAY(arena, fw_device_set, 1);
        set[0] = (fw_device_set){"flexure[A]/@length", "312 um"};
        v->proposal = FIXTURE_ARRAY(arena, fw_verdict_proposal, 1);
        v->nproposal = 1;
        v->proposal[0] =
            (fw_verdict_proposal){.kind = FW_PROPOSE_FLEXURES,
                                  .set = set,
                                  .nset = 1,
                                  .change = 0.04,
                                  .text = "flexure A: arc length >= 312 um accepts (now 300 um)"};
    }
    const char **assumption =
        fixture_texts(arena, "material strength 2.5 GPa overrides the pack (device.xml:11)", "");
    f->diags = fw_diags_new(arena);
    fw_diag_warning(&f->diags, 160, (fw_place){"device.xml", 14, 33},
                    "thickness differs from the pack");
    f->input = (fw_report_input){.device = &f->device,
                                 .layout = &f->layout,
                                 .verdict = v,
                                 .flow = f->flow,
                                 .nflow = VARIANTS,
                                 .version = "0.1.0",
                                 .assumption = assumption,
                                 .nassumption = 1,
                                 .diags = &f->diags};
    return f;
}
#endif
