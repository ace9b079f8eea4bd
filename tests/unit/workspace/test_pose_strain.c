/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strains over required boxes against poses that are sampled and held by a statics of its own: the
   equilibrium of all five bodies as one linear system. */
#include "six_bar_fixture.h"
#include "test.h"
#include "workspace/pose_load.h"

static uint64_t seed;

static double unit(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static double between(double low, double high) {
    return low + (high - low) * unit();
}

/* ---- a six-bar with flexures, its links scaled ---- */

typedef struct loaded_six_bar {
    six_bar_fixture f;
    fw_device_flexure flexure[6];
    fw_mechanism_hinge hinge[6];
    fw_device_scene scene;
    fw_device_force force[2];
    fw_device_torque torque[2];
    fw_device_tendon tendon[4];
    fw_device_eyelet eyelet[8];
    fw_device_comb comb;
    fw_device_spring spring[3];
    fw_device_contact_use contact[2];
    fw_device_friction_use friction[6];
} loaded_six_bar;

static void flexures(loaded_six_bar *d, bool drawn) {
    for (int i = 0; i < 6; i++) {
        fw_device_flexure *x = &d->flexure[i];
        bool leaf = unit() < 0.2;
        *x = (fw_device_flexure){.kind = leaf ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                                 .length_m = between(200e-6, 400e-6),
                                 .angle_rad = leaf ? 0 : between(1.5, 4.5),
                                 .width_m = between(6e-6, 10e-6),
                                 .fillet_m = 6e-6};
        x->radius_m = leaf ? 0 : x->length_m / x->angle_rad;
        fw_mechanism_hinge *h = &d->hinge[i];
        *h = (fw_mechanism_hinge){.pin = i, .flexure = i, .first_is_a = unit() < 0.5};
        h->input = fw_flexure_input_of(x, x->fillet_m);
        h->input.depth_m = 50e-6, h->input.youngs_Pa = 169e9, h->input.poisson = 0.28;
        h->input.strength_Pa = 2.5e9, h->input.safety_factor = 1.5;
        fw_flexure_closed_form(&h->input, &h->closed_form);
        fw_flexure_hinge_law_of(&h->input, &h->closed_form, &h->law);
        h->axis_rad = drawn ? between(-3.1, 3.1) : (double)NAN;
        d->f.pin[i].hinge = i;
        d->f.pin[i].stiffness_Nm_per_rad = h->closed_form.stiffness_Nm_per_rad * between(0.9, 1.1);
    }
    d->f.mechanism.hinge = d->hinge;
    d->f.mechanism.nhinge = 6;
    d->f.device.flexure = d->flexure;
    d->f.device.nflexure = 6;
    d->f.variant.material.youngs.value = 169e9;
    d->f.variant.thickness_m = 50e-6;
}

enum { NO_SCENE, TORQUE_AND_FORCE, TENDONS, ELECTRODES, KINDS };

static void scenes(loaded_six_bar *d, int kind) {
    static const char *const id[] = {"AB", "BC", "CD", "DE", "EF"};
    for (int i = 0; i < 5; i++)
        d->f.body[i].id = id[i];
    d->f.device.scene = &d->scene;
    d->f.device.nscene = kind != NO_SCENE;
    d->scene = (fw_device_scene){
        .torque = d->torque, .force = d->force, .tendon = d->tendon, .comb = &d->comb};
    d->torque[0] = (fw_device_torque){.body = 0, .value_Nm = 1e-7};
    d->torque[1] = (fw_device_torque){.body = 4, .value_Nm = -1e-7};
    d->force[0] = (fw_device_force){.body = 2, .fx_N = 1e-4, .fy_N = 3e-5};
    d->force[1] = (fw_device_force){.body = 1, .x_m = 1e-4, .fx_N = 1e-4};
    d->comb = (fw_device_comb){.body_a = 4, .body_b = 2, .bx_m = 1e-4, .direction_rad = 0.7};
    for (int i = 0; i < 4; i++) {
        static const double from[4][2] = {{-2, 1.5}, {2, 1.5}, {-1.5, -1}, {1.5, -1.5}};
        d->eyelet[2 * i] = (fw_device_eyelet){
            .body = FW_GROUND, .x_m = from[i][0] * 1e-3, .y_m = from[i][1] * 1e-3};
        d->eyelet[2 * i + 1] = (fw_device_eyelet){
            .body = i == 3 ? 3 : 2, .x_m = from[i][0] * 1e-4, .y_m = 1e-4 * (i % 2 ? 1 : -1)};
        d->tendon[i] = (fw_device_tendon){.id = "t", .eyelet = &d->eyelet[2 * i], .neyelet = 2};
    }
    if (kind == TORQUE_AND_FORCE) d->scene.ntorque = 1, d->scene.nforce = 1;
    if (kind == TENDONS) d->scene.ntendon = 4;
    if (kind == ELECTRODES) d->scene.ncomb = 1, d->scene.ntorque = 2, d->scene.nforce = 2;
}

static void make(loaded_six_bar *d, double scale, bool drawn, int kind) {
    double p[6][2];
    for (int h = 0; h < 6; h++)
        for (int k = 0; k < 2; k++)
            p[h][k] = (six_bar_reference[h][k] + between(-100, 100)) * scale;
    six_bar_make(&d->f, (const double(*)[2])p);
    flexures(d, drawn);
    scenes(d, kind);
}

/* ---- statics of one pose: 12 components of joint forces and three sizes ---- */

typedef double system15[15][16];

static bool eliminate(system15 a, double x[15]) {
    for (int c = 0; c < 15; c++) {
        int best = c;
        for (int i = c + 1; i < 15; i++)
            if (fabs(a[i][c]) > fabs(a[best][c])) best = i;
        if (a[best][c] == 0) return false;
        for (int j = 0; j < 16; j++) {
            double t = a[c][j];
            a[c][j] = a[best][j], a[best][j] = t;
        }
        for (int i = 0; i < 15; i++) {
            double by = i == c ? 0 : a[i][c] / a[c][c];
            for (int j = c; j < 16 && by != 0; j++)
                a[i][j] -= by * a[c][j];
        }
    }
    for (int c = 0; c < 15; c++)
        x[c] = a[c][15] / a[c][c];
    return true;
}

typedef struct still_pose {
    fw_geometry_vec2 pin[6], com[5];
    double turn[5], theta[6];
} still_pose;

static fw_geometry_vec2 turned(fw_geometry_vec2 p, double phi) {
    return (fw_geometry_vec2){cos(phi) * p.x - sin(phi) * p.y, sin(phi) * p.x + cos(phi) * p.y};
}

/* links one after another from A, by the joint angles of the inverse kinematics */
static bool stand(const loaded_six_bar *d, const double pose[3], still_pose *s) {
    int leg;
    if (!fw_workspace_six_bar_inverse(&d->f.mechanism, pose[0], pose[1], pose[2], s->theta, &leg))
        return false;
    fw_geometry_vec2 at = fw_mechanism_pin_place(&d->f.mechanism, &d->f.pin[0], 0);
    double phi = 0;
    for (int b = 0; b < 5; b++) {
        phi += s->theta[b];
        s->pin[b] = at, s->turn[b] = phi;
        const fw_mechanism_pin *p = &d->f.pin[b], *q = &d->f.pin[b + 1];
        fw_geometry_vec2 to = turned((fw_geometry_vec2){-p->bx_m, -p->by_m}, phi);
        s->com[b] = (fw_geometry_vec2){at.x + to.x, at.y + to.y};
        to = turned((fw_geometry_vec2){q->ax_m, q->ay_m}, phi);
        at = (fw_geometry_vec2){s->com[b].x + to.x, s->com[b].y + to.y};
    }
    s->pin[5] = at;
    return true;
}

static void add(system15 a, int column, int body, fw_geometry_vec2 at, double fx, double fy,
                double moment) {
    if (body == FW_GROUND) return;
    a[3 * body][column] += fx, a[3 * body + 1][column] += fy;
    a[3 * body + 2][column] += 1e3 * (at.x * fy - at.y * fx + moment);
}

static fw_geometry_vec2 point(const still_pose *s, int body, double x, double y) {
    if (body == FW_GROUND) return (fw_geometry_vec2){x, y};
    fw_geometry_vec2 p = turned((fw_geometry_vec2){x, y}, s->turn[body]);
    return (fw_geometry_vec2){p.x + s->com[body].x, p.y + s->com[body].y};
}

/* by the words of the device, found by the actuator's name */
static void act(const loaded_six_bar *d, const still_pose *s, const fw_workspace_actuator *by,
                system15 a, int column) {
    fw_geometry_vec2 none = {0, 0};
    if (by->kind == FW_ACTUATOR_TORQUE) {
        add(a, column, by->body, none, 0, 0, 1e-3);
    } else if (by->kind == FW_ACTUATOR_FORCE) {
        fw_geometry_vec2 at =
            by->body == 1 ? point(s, 1, d->force[1].x_m, d->force[1].y_m) : s->com[2];
        add(a, column, by->body, at, by->direction[0], by->direction[1], 0);
    } else if (by->kind == FW_ACTUATOR_TENDON) {
        const fw_device_eyelet *e = NULL;
        for (int i = 0; i < 4; i++)
            if (d->eyelet[2 * i].x_m == by->point[0].x_m) e = &d->eyelet[2 * i];
        fw_geometry_vec2 p = point(s, e[0].body, e[0].x_m, e[0].y_m),
                         q = point(s, e[1].body, e[1].x_m, e[1].y_m);
        double l = hypot(q.x - p.x, q.y - p.y);
        add(a, column, e[1].body, q, (p.x - q.x) / l, (p.y - q.y) / l, 0);
    } else {
        double angle = d->comb.direction_rad + s->turn[4];
        fw_geometry_vec2 at = point(s, 2, d->comb.bx_m, d->comb.by_m);
        add(a, column, 2, at, cos(angle), sin(angle), 0);
        add(a, column, 4, at, -cos(angle), -sin(angle), 0);
    }
}

/* two points pull each other with this force */
static void tie(system15 a, int body_a, fw_geometry_vec2 p, int body_b, fw_geometry_vec2 q,
                double pull) {
    double l = hypot(q.x - p.x, q.y - p.y);
    if (!(l > 0)) return;
    add(a, 15, body_a, p, -pull * (q.x - p.x) / l, -pull * (q.y - p.y) / l, 0);
    add(a, 15, body_b, q, pull * (q.x - p.x) / l, pull * (q.y - p.y) / l, 0);
}

/* what acts whatever holds the pose, by the words of the device, on the right-hand side */
static void resist(const loaded_six_bar *d, const still_pose *s, system15 a) {
    for (int i = 0; i < d->f.mechanism.nspring; i++) {
        const fw_device_spring *k = &d->spring[i];
        fw_geometry_vec2 p = point(s, k->body_a, k->ax_m, k->ay_m),
                         q = point(s, k->body_b, k->bx_m, k->by_m);
        double pull = k->stiffness_N_per_m * (hypot(q.x - p.x, q.y - p.y) - k->length_m);
        tie(a, k->body_a, p, k->body_b, q, k->cable ? fmax(pull, 0) : pull);
    }
    for (int b = 0; b < 5 && d->scene.gravity; b++)
        add(a, 15, b, s->com[b], -d->f.body[b].mass_kg * d->scene.gx_m_per_s2,
            -d->f.body[b].mass_kg * d->scene.gy_m_per_s2, 0);
    for (int i = 0; i < d->scene.ncontact; i++) {
        const fw_device_contact_use *c = &d->contact[i];
        fw_geometry_vec2 p = point(s, c->body_a, c->ax_m, c->ay_m),
                         q = point(s, c->body_b, c->bx_m, c->by_m);
        double angle = c->face_rad + (c->body_a == FW_GROUND ? 0 : s->turn[c->body_a]);
        double nx = cos(angle), ny = sin(angle);
        double apart = c->face ? nx * (q.x - p.x) + ny * (q.y - p.y) : hypot(q.x - p.x, q.y - p.y);
        double over = (apart - c->distance_m) * (c->side == FW_CONTACT_INSIDE ? 1 : -1);
        double push = c->stiffness_N_per_m * fmax(over, 0);
        if (!c->face) {
            tie(a, c->body_a, p, c->body_b, q, c->side == FW_CONTACT_INSIDE ? push : -push);
            continue;
        }
        add(a, 15, c->body_b, q, -push * nx, -push * ny, 0);
        add(a, 15, c->body_a, q, push * nx, push * ny, 0);
    }
}

/* forces of the joints on their second bodies, which take the torques `rub` besides; false: a tendon or an electrode would
   push */
static bool rub_still(const loaded_six_bar *d, const fw_workspace_hold *hold, const fw_workspace_grip *grip,
                      const still_pose *s, const double rub[6], double force[12]) {
    system15 a = {{0}};
    double x[15];
    for (int b = 0; b < 5; b++)
        for (int end = 0; end < 2; end++) {
            int i = b + end;
            double sign = end ? -1 : 1, m = d->f.pin[i].stiffness_Nm_per_rad * s->theta[i] + rub[i];
            a[3 * b][2 * i] += sign, a[3 * b + 1][2 * i + 1] += sign;
            a[3 * b + 2][2 * i] -= 1e3 * sign * s->pin[i].y;
            a[3 * b + 2][2 * i + 1] += 1e3 * sign * s->pin[i].x;
            a[3 * b + 2][15] += 1e3 * sign * m;
        }
    for (int k = 0; k < 3; k++)
        act(d, s, &hold->actuator[grip->actuator[k]], a, 12 + k);
    resist(d, s, a);
    if (!eliminate(a, x)) return false;
    memcpy(force, x, 12 * sizeof *force);
    for (int k = 0; k < 3; k++)
        if (hold->actuator[grip->actuator[k]].pulls && x[12 + k] < 0) return false;
    return true;
}

static bool hold_still(const loaded_six_bar *d, const fw_workspace_hold *hold,
                       const fw_workspace_grip *grip, const still_pose *s, double force[12]) {
    return rub_still(d, hold, grip, s, (const double[6]){0}, force);
}

/* eq. 1 and 2 of docs/theory/verdict.md */
static double strain(const loaded_six_bar *d, const still_pose *s, int i, const double *force) {
    const fw_mechanism_hinge *h = &d->hinge[i];
    const fw_flexure_result *c = &h->closed_form;
    const fw_device_flexure *x = &d->flexure[i];
    double per = c->strain_per_rad / c->stiffness_Nm_per_rad, size = hypot(force[0], force[1]);
    double axial = size / (169e9 * x->width_m * 50e-6), m = c->stiffness_Nm_per_rad * s->theta[i];
    double a = 0.5 * x->angle_rad, r = x->radius_m, most = 0;
    bool arc = x->kind == FW_FLEXURE_CSFH;
    if (isnan(h->axis_rad)) {
        double lever = arc ? hypot(r * cos(a) - c->centre_m, r * sin(a)) : 0.5 * x->length_m;
        return per * (fabs(m) + lever * size) + axial;
    }
    double lower = i > 0 ? s->turn[i - 1] : 0, upper = i < 5 ? s->turn[i] : 0;
    fw_geometry_vec2 f =
        turned((fw_geometry_vec2){-force[0], -force[1]}, -(h->axis_rad + 0.5 * (lower + upper)));
    for (int k = 0; k <= 80; k++) {
        double part = k / 40.0 - 1, b = part * a;
        double now = arc ? m + c->centre_m * f.y + r * (f.x * sin(b) - f.y * cos(b))
                         : m + 0.5 * part * x->length_m * f.x;
        if (k != 0 && k != 80) now *= c->fibre / c->concentration;
        most = fmax(most, fabs(now));
    }
    return per * most + axial;
}

/* ---- the tests ---- */

static void sample(const loaded_six_bar *d, const fw_workspace_hold *hold,
                   const fw_workspace_box3 *box, const fw_workspace_strain_proof *proof,
                   double most[6], double most_N[6]) {
    int n = test_fewest(test_cases(300, 100), 30);
    for (int k = 0; k < n; k++) {
        double pose[3];
        still_pose s;
        for (int i = 0; i < 3; i++)
            pose[i] = k < 8 ? (k >> i & 1 ? box->hi[i] : box->lo[i])
                            : box->lo[i] + unit() * (box->hi[i] - box->lo[i]);
        for (int i = 0; i < 3 && k >= 8 && k < 14; i++)
            pose[i] = proof->most[k - 8].pose[i];
        assert_true(stand(d, pose, &s));
        for (int g = 0; g < hold->ngrip; g++) {
            double force[12];
            if (!hold_still(d, hold, &hold->grip[g], &s, force)) continue;
            for (int i = 0; i < 6; i++)
                most[i] = fmax(most[i], strain(d, &s, i, force + 2 * i)),
                most_N[i] = fmax(most_N[i], hypot(force[2 * i], force[2 * i + 1]));
        }
    }
}

/* a spring of each kind: between ground and platform, from link to link, one without length; a cable that hangs slack in
   half of the box; weight; something round inside of which the platform stays, and a face that runs with a link */
static void give(loaded_six_bar *d, double scale, int kind) {
    const double k = 1 / (scale * scale), away = 1e-3 * scale;
    const fw_device_spring spring[] = {
        {.id = "S", .body_a = FW_GROUND, .ax_m = 2 * away, .ay_m = away, .body_b = 2, .bx_m = 2e-4 * scale, .stiffness_N_per_m = 10 * k},
        {.id = "T", .body_a = 0, .ax_m = 1e-4 * scale, .body_b = 3, .by_m = 2e-4 * scale, .stiffness_N_per_m = 5 * k},
        {.id = "U", .body_a = FW_GROUND, .ax_m = d->f.body[2].x_m, .ay_m = d->f.body[2].y_m, .body_b = 2, .stiffness_N_per_m = 4 * k}};
    still_pose s;
    assert_true(stand(d, (double[3]){0, 0, 0}, &s));
    for (int i = 0; i < 3; i++) {
        fw_device_spring *to = &d->spring[i];
        *to = spring[i];
        fw_geometry_vec2 p = point(&s, to->body_a, to->ax_m, to->ay_m),
                         q = point(&s, to->body_b, to->bx_m, to->by_m);
        to->length_m = i == 2 ? 0 : hypot(q.x - p.x, q.y - p.y) * (i == 1 ? 0.98 : 1);
    }
    d->spring[0].cable = kind == 1;
    d->f.mechanism.spring = d->spring, d->f.mechanism.nspring = kind < 2 ? 3 : 0;
    d->f.device.scene = &d->scene, d->f.device.nscene = 1;
    for (int b = 0; b < 5; b++)
        d->f.body[b].mass_kg = 2e-8 * (b + 1);
    if (kind == 2)
        d->scene.gravity = true, d->scene.gx_m_per_s2 = 3e3 * k, d->scene.gy_m_per_s2 = -5e3 * k;
    d->contact[0] = (fw_device_contact_use){.joint = FW_NONE, .side = FW_CONTACT_INSIDE, .body_a = FW_GROUND,
                                            .ax_m = d->f.body[2].x_m - 3e-5 * scale, .ay_m = d->f.body[2].y_m,
                                            .body_b = 2, .distance_m = 4e-5 * scale, .stiffness_N_per_m = 20 * k};
    d->contact[1] = (fw_device_contact_use){.joint = FW_NONE, .side = FW_CONTACT_OUTSIDE, .body_a = 1,
                                            .ax_m = 0, .ay_m = 0, .face = true, .face_rad = 0.3,
                                            .body_b = 2, .bx_m = 1e-4 * scale, .stiffness_N_per_m = 20 * k};
    fw_geometry_vec2 q = point(&s, 2, d->contact[1].bx_m, 0);
    d->contact[1].distance_m = cos(0.3) * (q.x - s.com[1].x) + sin(0.3) * (q.y - s.com[1].y) - 5e-6 * scale;
    d->scene.contact = d->contact, d->scene.ncontact = kind == 3 ? 2 : 0;
}

/* forces in the corners are those of this statics, and none is above its bound */
static void corners(fw_arena *arena, const loaded_six_bar *d, const fw_workspace_hold *hold,
                    const fw_workspace_box3 *box, const fw_workspace_strain_proof *proof) {
    double *force_N, own[12];
    int n, k = 0;
    assert_int_equal(fw_workspace_forces(arena, proof, box->lo, box->hi, &force_N, &n), FW_OK);
    for (int c = 0; c < 8; c++)
        for (int g = 0; g < hold->ngrip; g++) {
            const double pose[3] = {(c & 1 ? box->hi : box->lo)[0], (c & 2 ? box->hi : box->lo)[1],
                                    (c & 4 ? box->hi : box->lo)[2]};
            still_pose s;
            assert_true(stand(d, pose, &s));
            if (!hold_still(d, hold, &hold->grip[g], &s, own)) continue;
            for (int i = 0; i < 12; i++)
                assert_true(fabs(force_N[12 * k + i] - own[i]) <= 1e-8 * fabs(own[i]) + 1e-10);
            k++;
        }
    assert_true(k <= n && n <= k + 6);
    for (int i = 0; i < 12 * n; i += 2)
        assert_true(hypot(force_N[i], force_N[i + 1]) <= proof->force_N[i / 2 % 6] * (1 + 1e-9));
}

/* the bound is above all samples, and within 1 % of the largest; 2 % where something begins to pull or to push */
static void bound(bool given) {
    seed = 11;
    static const double scale[] = {1, 0.45, 0.35};
    double loose = 1;
    int count = test_fewest(test_cases(40, 12), 5), proved = 0;
    for (int n = 0; n < count; n++) {
        loaded_six_bar d = {0};
        make(&d, scale[n % 3], n % 5 != 4, given && n % KINDS == NO_SCENE ? TORQUE_AND_FORCE : n % KINDS);
        if (given) give(&d, scale[n % 3], n / 3 % 4);
        fw_workspace_loop loop;
        assert_true(fw_workspace_loop_set_up(&d.f.mechanism, &loop));
        double s = scale[n % 3];
        const fw_workspace_box3 box = {
            {-between(20e-6, 120e-6) * s, -between(20e-6, 60e-6) * s, -between(0.01, 0.05)},
            {between(20e-6, 120e-6) * s, between(20e-6, 60e-6) * s, between(0.01, 0.05)}};
        fw_arena *arena = fw_arena_new(0);
        fw_workspace_hold hold;
        fw_workspace_strain_proof proof;
        fw_workspace_proof_end end;
        assert_int_equal(fw_workspace_hold_of(arena, &d.f.mechanism, &loop, &box, NULL, &hold), FW_OK);
        assert_true(hold.ngrip > 0);
        if (given) assert_int_equal(fw_workspace_hold_given(arena, &d.f.mechanism, &d.scene, &hold), FW_OK);
        assert_int_equal(hold.ngiven > 0, given);
        assert_int_equal(fw_workspace_certify_strain(arena, &hold, &box, 2e-3, 20000, &proof, &end),
                         FW_OK);
        if (end == FW_PROVED) {
            double most[6] = {0}, most_N[6] = {0};
            proved++;
            sample(&d, &hold, &box, &proof, most, most_N);
            corners(arena, &d, &hold, &box, &proof);
            for (int i = 0; i < 6; i++)
                if (!(most[i] <= proof.strain[i]) || !(most[i] >= (given ? 0.98 : 0.99) * proof.strain[i]))
                    fail_msg("case %d hinge %d: %.9g sampled, %.9g proved", n, i, most[i],
                             proof.strain[i]);
            for (int i = 0; i < 6; i++) {
                if (!(most_N[i] <= proof.force_N[i] * (1 + 1e-9)))
                    fail_msg("case %d hinge %d: %.9g N sampled, %.9g proved", n, i, most_N[i],
                             proof.force_N[i]);
                if (most_N[i] > 0) loose = fmax(loose, proof.force_N[i] / most_N[i]);
            }
        }
        fw_arena_free(arena);
    }
    assert_true(proved >= count * 9 / 10);
    assert_true(loose < 4); /* leaves are as small as strains need, not forces */
}

static void bounds_hold_and_are_sharp(void **state) {
    (void)state;
    bound(false);
}

static void bounds_hold_against_what_is_given(void **state) {
    (void)state;
    bound(true);
}

/* what the scenes have is used, and what they lack comes from the platform */
/* ---- friction ---- */

/* forces where hinges rub with these signs, each by as much as its joint force presses */
static bool rub_with(const loaded_six_bar *d, const fw_workspace_hold *hold, const fw_workspace_grip *grip,
                     const still_pose *s, const int sign[6], double force[12]) {
    double rub[6] = {0};
    bool holds = false;
    for (int round = 0; round < 10; round++) {
        holds = rub_still(d, hold, grip, s, rub, force);
        for (int i = 0; i < 6; i++) {
            const fw_device_friction_use *u = &d->friction[i];
            const double press = u->preload_N + hypot(force[2 * i], force[2 * i + 1]);
            rub[i] = sign[i] * fmax(u->coefficient, u->static_coefficient) * u->radius_m * press;
        }
    }
    return holds;
}

/* the platform comes to the pose along v: signs by the angles a little way back */
static void come_from(const loaded_six_bar *d, const double pose[3], const still_pose *s, int sign[6]) {
    const double by = 1e-4;
    const double from[3] = {pose[0] - by * between(-1e-3, 1e-3), pose[1] - by * between(-1e-3, 1e-3),
                            pose[2] - by * between(-1, 1)};
    still_pose before;
    assert_true(stand(d, from, &before));
    for (int i = 0; i < 6; i++)
        sign[i] = s->theta[i] < before.theta[i] ? -1 : 1;
}

/* No signs strain a hinge above the bound, and the largest is near it, but for what all torques are taken to press
   together; ways to the worst pose strain it as much as is said
   to be reached, and one of them nearly as much as that. */
static void friction_of_either_sign(void **state) {
    (void)state;
    seed = 23;
    double added = 0;
    int count = test_fewest(test_cases(7, 5), 3), sharp = 0, of = 0;
    for (int n = 0; n < count; n++) {
        loaded_six_bar d = {0};
        const double scale = n % 2 ? 0.45 : 1;
        const int kind = n == 2 ? TENDONS : n % 2 ? TORQUE_AND_FORCE : NO_SCENE;
        const bool pulls = kind == TENDONS; /* beyond where these let go nothing is near the bound */
        make(&d, scale, true, kind);
        d.f.device.scene = &d.scene, d.f.device.nscene = 1;
        d.scene.friction = d.friction, d.scene.nfriction = 6;
        for (int i = 0; i < 6; i++)
            d.friction[i] = (fw_device_friction_use){
                .revolute = i, .joint = FW_NONE, .coefficient = 0.3, .static_coefficient = i % 2 ? 0.5 : (double)NAN,
                .radius_m = between(20e-6, 80e-6) * scale, .preload_N = between(0, 4e-3) / scale};
        fw_workspace_loop loop;
        assert_true(fw_workspace_loop_set_up(&d.f.mechanism, &loop));
        const fw_workspace_box3 box = {{-60e-6 * scale, -40e-6 * scale, -0.03}, {70e-6 * scale, 30e-6 * scale, 0.04}};
        fw_arena *arena = fw_arena_new(0);
        fw_workspace_hold hold, bare;
        fw_workspace_strain_proof proof, without;
        fw_workspace_proof_end end;
        assert_int_equal(fw_workspace_hold_of(arena, &d.f.mechanism, &loop, &box, NULL, &hold), FW_OK);
        bare = hold;
        assert_int_equal(fw_workspace_hold_given(arena, &d.f.mechanism, &d.scene, &hold), FW_OK);
        assert_true(hold.rubs && hold.ngiven == 0);
        assert_int_equal(fw_workspace_certify_strain(arena, &bare, &box, 2e-3, 20000, &without, &end), FW_OK);
        assert_int_equal(end, FW_PROVED);
        assert_int_equal(fw_workspace_certify_strain(arena, &hold, &box, 2e-3, 20000, &proof, &end), FW_OK);
        assert_int_equal(end, FW_PROVED);
        for (int i = 0; i < 6; i++) {
            double most = 0, reached = 0, pose[3];
            fw_workspace_load load;
            still_pose s;
            int sign[6];
            double force[12];
            assert_int_equal(fw_workspace_load_of(arena, &hold, &d.f.mechanism, &proof, i, &(fw_workspace_give){0}, &load),
                             FW_OK);
            added = fmax(added, proof.strain[i] / without.strain[i] - 1);
            for (int k = 0; k < 8; k++) {
                for (int c = 0; c < 3; c++)
                    pose[c] = k == 0 ? proof.most[i].pose[c] : box.lo[c] + unit() * (box.hi[c] - box.lo[c]);
                assert_true(stand(&d, pose, &s));
                for (int g = 0; g < hold.ngrip; g++)
                    for (int p = 0; p < 64; p++) {
                        for (int j = 0; j < 6; j++)
                            sign[j] = p >> j & 1 ? 1 : -1;
                        if (!rub_with(&d, &hold, &hold.grip[g], &s, sign, force)) continue;
                        most = fmax(most, strain(&d, &s, i, force + 2 * i));
                        assert_true(hypot(force[2 * i], force[2 * i + 1]) <= proof.force_N[i] * (1 + 1e-9));
                    }
            }
            for (int c = 0; c < 3; c++)
                pose[c] = proof.most[i].pose[c];
            assert_true(stand(&d, pose, &s));
            for (int k = 0; k < 300; k++) {
                come_from(&d, pose, &s, sign);
                if (!rub_with(&d, &hold, &hold.grip[proof.most[i].grip], &s, sign, force)) continue;
                reached = fmax(reached, strain(&d, &s, i, force + 2 * i));
            }
            if (!(most <= proof.strain[i]) || (!pulls && !(most >= 0.95 * proof.strain[i])))
                fail_msg("case %d hinge %d: %.9g sampled, %.9g proved", n, i, most, proof.strain[i]);
            const double said = load.strain - load.error;
            if (!pulls && !(reached <= said * (1 + 1e-4)))
                fail_msg("case %d hinge %d: %.9g reached, %.9g said", n, i, reached, said);
            sharp += !pulls && reached >= 0.99 * said, of += !pulls;
        }
        fw_arena_free(arena);
    }
    assert_true(added > 0.2);
    if (!(sharp > of * 9 / 10)) fail_msg("%d of %d are reached", sharp, of);
}

static void grips_of_the_scenes(void **state) {
    (void)state;
    static const struct {
        int kind, nforce, ntorque, ngrip;
        const char *first;
    } row[] = {
        {NO_SCENE, 0, 0, 4, "wrench on the platform"},
        {TORQUE_AND_FORCE, 0, 0, 0, "wrench on the platform"},
        /* torques on three bodies, and nothing else */
        {TORQUE_AND_FORCE, 0, 3, 1, "torque on AB, torque on EF, torque on CD"},
    };
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++) {
        loaded_six_bar d = {0};
        seed = 5;
        make(&d, 1, true, row[k].kind);
        fw_device_torque torque[3] = {d.torque[0], d.torque[1], {.body = 2, .value_Nm = 1e-7}};
        if (row[k].ntorque == 3) d.scene.torque = torque, d.scene.ntorque = 3, d.scene.nforce = 0;
        fw_workspace_loop loop;
        assert_true(fw_workspace_loop_set_up(&d.f.mechanism, &loop));
        const fw_workspace_box3 box = {{-50e-6, -30e-6, -0.02}, {50e-6, 30e-6, 0.02}};
        fw_arena *arena = fw_arena_new(0);
        fw_workspace_hold hold;
        assert_int_equal(fw_workspace_hold_of(arena, &d.f.mechanism, &loop, &box, NULL, &hold), FW_OK);
        if (row[k].ngrip > 0) assert_int_equal(hold.ngrip, row[k].ngrip);
        assert_string_equal(hold.grip[0].name, row[k].first);
        fw_arena_free(arena);
    }
}

/* a force on the platform that is along x or y but for its last digits, or so near that both are one */
static void force_nearly_along_an_axis(void **state) {
    (void)state;
    static const double force[][2] = {
        {1e-4, 0}, {1e-4, 1e-18}, {-1e-4, 9e-17}, {-1e-18, 1e-4}, {1e-18, -1e-4}};
    for (size_t k = 0; k < sizeof force / sizeof force[0]; k++) {
        loaded_six_bar d = {0};
        seed = 5;
        make(&d, 1, true, TORQUE_AND_FORCE);
        d.force[0].fx_N = force[k][0], d.force[0].fy_N = force[k][1];
        fw_workspace_loop loop;
        assert_true(fw_workspace_loop_set_up(&d.f.mechanism, &loop));
        const fw_workspace_box3 box = {{-50e-6, -30e-6, -0.02}, {50e-6, 30e-6, 0.02}};
        fw_arena *arena = fw_arena_new(0);
        fw_workspace_hold hold;
        assert_int_equal(fw_workspace_hold_of(arena, &d.f.mechanism, &loop, &box, NULL, &hold), FW_OK);
        assert_int_equal(hold.nactuator, 4); /* a torque, the force, and what the wrench has besides */
        assert_string_equal(hold.grip[0].name, "wrench on the platform");
        for (int g = 0; g < hold.ngrip; g++)
            for (int i = 0; i < 3; i++)
                assert_in_range(hold.grip[g].actuator[i], 0, hold.nactuator - 1);
        fw_arena_free(arena);
    }
}

/* samples where nothing can be proved: not above the bound, and not far below it */
static void samples_agree_with_the_proof(void **state) {
    (void)state;
    seed = 3;
    loaded_six_bar d = {0};
    make(&d, 0.5, true, TORQUE_AND_FORCE);
    fw_workspace_loop loop;
    assert_true(fw_workspace_loop_set_up(&d.f.mechanism, &loop));
    const fw_workspace_box3 box = {{-50e-6, -30e-6, -0.03}, {60e-6, 20e-6, 0.02}};
    fw_arena *arena = fw_arena_new(0);
    fw_workspace_hold hold;
    fw_workspace_strain_proof proof, few, samples;
    fw_workspace_proof_end end;
    assert_int_equal(fw_workspace_hold_of(arena, &d.f.mechanism, &loop, &box, NULL, &hold), FW_OK);
    assert_int_equal(fw_workspace_certify_strain(arena, &hold, &box, 1e-3, 20000, &proof, &end),
                     FW_OK);
    assert_int_equal(end, FW_PROVED);
    assert_int_equal(fw_workspace_certify_strain(arena, &hold, &box, 1e-3, 3, &few, &end), FW_OK);
    assert_int_equal(end, FW_UNDECIDED);
    assert_false(few.proved);
    assert_int_equal(fw_workspace_sample_strain(arena, &hold, &box, &samples), FW_OK);
    assert_false(samples.proved);
    for (int i = 0; i < 6; i++)
        assert_true(samples.strain[i] <= proof.strain[i] * 1.001 &&
                    samples.strain[i] >= proof.strain[i] * 0.99);
    fw_arena_free(arena);
}

static bool same(const void *a, const void *b, size_t n) {
    return memcmp(a, b, n) == 0;
}

static void same_result(const fw_workspace_result *a, const fw_workspace_result *b) {
    assert_int_equal(a->certified, b->certified);
    assert_true(same(a->peak, b->peak, sizeof a->peak));
    assert_true(same(a->proof->angle_rad, b->proof->angle_rad, sizeof a->proof->angle_rad));
    assert_true(same(a->proof->most, b->proof->most, sizeof a->proof->most));
    assert_int_equal(a->proof->boxes, b->proof->boxes);
    assert_int_equal(a->proof->proved, b->proof->proved);
    if (a->proof->proved) assert_string_equal(a->proof->tree, b->proof->tree);
    assert_true(same(a->strain->strain, b->strain->strain, sizeof a->strain->strain));
    assert_int_equal(a->strain->boxes, b->strain->boxes);
    assert_int_equal(a->strain->proved, b->strain->proved);
    if (a->strain->proved) assert_string_equal(a->strain->tree, b->strain->tree);
    for (int i = 0; i < 6; i++) {
        const fw_workspace_load *x = &a->load[i], *y = &b->load[i];
        const double is[] = {x->strain, x->error, x->give, x->relief, x->added, x->angle_rad},
                     other[] = {y->strain, y->error, y->give, y->relief, y->added, y->angle_rad};
        assert_true(same(is, other, sizeof is));
    }
}

/* a small box, `far` times as wide */
static void small_box(loaded_six_bar *d, double far) {
    d->f.box = (fw_device_workspace_box){.x_min_m = -40e-6 * far,
                                         .x_max_m = 40e-6 * far,
                                         .y_min_m = -20e-6 * far,
                                         .y_max_m = 20e-6 * far,
                                         .phi_min_rad = -0.02,
                                         .phi_max_rad = 0.02};
    d->f.device.nworkspace = 1;
}

/* kept NULL: of the device by itself */
static void required(fw_arena *arena, const loaded_six_bar *d, fw_workspace_kept *kept,
                     fw_workspace_result *out) {
    fw_diags diags = fw_diags_new(arena);
    assert_int_equal(fw_workspace_required(arena, &d->f.mechanism, kept, &diags, out), FW_OK);
}

/* Devices whose pins, axes, springs, loads or boxes are others, in any order: with what is kept of those before each
   is what it is by itself, to the last bit. */
static void kept_from_device_to_device(void **state) {
    (void)state;
    fw_arena *keeps = fw_arena_new(0);
    fw_workspace_kept *kept;
    assert_int_equal(fw_workspace_kept_new(keeps, &kept), FW_OK);
    int proved = 0, count = test_fewest(test_cases(24, 12), 6);
    for (int n = 0; n < count; n++) {
        loaded_six_bar d = {0};
        seed = (uint64_t)(n / 4 % 2 + 1); /* pins, hinges and loads of two devices, by turns */
        make(&d, n % 4 == 3 ? 0.9 : 1, false, n / 2 % KINDS); /* hinges without a strip of their own */
        for (int i = 0; i < 6 && n % 2; i++)
            d.f.pin[i].stiffness_Nm_per_rad *= 1 + 0.01 * n;
        small_box(&d, n % 3 ? 1 : 0.7);
        fw_arena *arena = fw_arena_new(0);
        fw_workspace_result alone, with;
        required(arena, &d, NULL, &alone);
        required(arena, &d, kept, &with);
        same_result(&alone, &with);
        proved += alone.proof->proved && alone.strain->proved;
        fw_arena_free(arena);
    }
    assert_true(proved >= count / 2);
    fw_arena_free(keeps);
}

/* One device and others that differ from it in one respect, by turns and over the same poses: what is kept of the one is
   found again by the others only where it is theirs as well. Of both a flow and its device are looked at twice, and of each
   once by itself, which is the same whenever it is asked. */
static void what_devices_have_in_common(void **state) {
    (void)state;
    enum { NOTHING, HINGE, OTHER_HINGE, SPRING, PLACE, BODY, WAY, RESPECTS };
    fw_arena *keeps = fw_arena_new(0);
    fw_workspace_result alone[RESPECTS];
    bool known[RESPECTS] = {false};
    fw_workspace_kept *kept;
    assert_int_equal(fw_workspace_kept_new(keeps, &kept), FW_OK);
    for (int n = 0; n < 4 * RESPECTS; n++) {
        const int respect = n / 2 % 2 ? n / 4 : NOTHING;
        loaded_six_bar d = {0};
        seed = 1;
        make(&d, 1, false, ELECTRODES); /* hinges without a strip of their own */
        if (respect == HINGE) d.hinge[1].closed_form.strain_per_rad *= 1.3;
        if (respect == OTHER_HINGE) d.hinge[4].closed_form.strain_per_rad *= 1.2;
        if (respect == SPRING) d.f.pin[2].stiffness_Nm_per_rad *= 1.4;
        if (respect == PLACE) d.force[1].x_m = -2e-4;
        if (respect == BODY) d.torque[0].body = 1;
        if (respect == WAY) d.comb.direction_rad = 1.1;
        small_box(&d, 1);
        fw_workspace_result with;
        if (!known[respect]) required(keeps, &d, NULL, &alone[respect]);
        known[respect] = true;
        required(keeps, &d, kept, &with);
        same_result(&alone[respect], &with);
        assert_true(with.strain->proved);
    }
    fw_arena_free(keeps);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_hold_and_are_sharp),
        cmocka_unit_test(bounds_hold_against_what_is_given),
        cmocka_unit_test(friction_of_either_sign),
        cmocka_unit_test(grips_of_the_scenes),
        cmocka_unit_test(force_nearly_along_an_axis),
        cmocka_unit_test(samples_agree_with_the_proof),
        cmocka_unit_test(kept_from_device_to_device),
        cmocka_unit_test(what_devices_have_in_common),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
