/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Breaking a tether: a uniform beam between two walls and a free cantilever in closed form, and stepped
   beams on a body that turns on a hinge against direct stiffness. */
#include "statics/statics.h"
#include "test.h"
#include <math.h>
#include <string.h>

static const double E = 160e9, NU = 0.25, H = 50e-6, STRENGTH = 1e9;

typedef struct case_of { /* one body on one hinge at the origin, one tether along y */
    fw_device device;
    fw_layout layout;
    fw_layout_tether tether;
    fw_layout_hinge_layout drawn;
    fw_mechanism_variant variant;
    fw_mechanism_mass body;
    fw_mechanism_pin pin;
    fw_mechanism_hinge hinge;
    fw_mechanism m;
} case_of;

static void make(case_of *c, double compliance, double x_m, double y_m) {
    *c = (case_of){.tether = {.body = 0,
                              .label = "tether of link b",
                              .cut = {x_m, y_m},
                              .outward = {0.0, 1.0},
                              .length_m = 200e-6,
                              .finger_m = 20e-6,
                              .neck_m = 8e-6,
                              .neck_long_m = 4e-6,
                              .flare_m = 12e-6,
                              .stub_m = 2e-6}};
    c->device.safety_factor = 2.0;
    c->layout = (fw_layout){.drawn = true, .tether = &c->tether, .ntether = 1, .hinge = &c->drawn};
    c->variant.thickness_m = H;
    c->variant.material.youngs.value = E;
    c->variant.material.poisson.value = NU;
    c->variant.material.strength.value = STRENGTH;
    c->variant.material.strength.uncertainty = 0.2e9;
    c->variant.material.criterion = "fracture";
    c->body = (fw_mechanism_mass){.id = "b", .x_m = 0.3e-3, .y_m = -0.1e-3};
    c->pin = (fw_mechanism_pin){
        .id = "A", .body_a = FW_GROUND, .body_b = 0, .bx_m = -0.3e-3, .by_m = 0.1e-3};
    c->hinge = (fw_mechanism_hinge){
        .input = {.kind = FW_FLEXURE_LEAF, .length_m = 200e-6, .width_m = 8e-6}, .scale = 1.0};
    fw_flexure_result *r = &c->hinge.closed_form;
    r->compliance[0][0] = 1e3 * compliance;
    r->compliance[1][1] = r->compliance[2][2] = 1e-6 * compliance;
    r->stiffness_Nm_per_rad = 1.0 / r->compliance[0][0];
    r->stress_per_rad_Pa = 1e9;
    r->limit_angle_rad = 0.5;
    c->hinge.limits.governing = FW_NONE;
    c->m = (fw_mechanism){.device = &c->device,
                          .variant = &c->variant,
                          .body = &c->body,
                          .pin = &c->pin,
                          .hinge = &c->hinge,
                          .nbody = 1,
                          .npin = 1,
                          .nhinge = 1,
                          .layout = &c->layout};
}

static const fw_statics_tethers *found(fw_arena *arena, const case_of *c) {
    const fw_statics_tethers *t;
    assert_int_equal(fw_statics_tethers_find(arena, &c->m, &t), FW_OK);
    assert_non_null(t);
    if (t->why) fail_msg("%s", t->why);
    return t;
}

static double bending(double w) {
    return E * H * w * w * w / 12.0;
}

/* the body free to follow: the finger is a cantilever, P a at its root, P a^3/3 EI under the probe */
static void a_free_body_leaves_a_cantilever(void **unused) {
    (void)unused;
    case_of c;
    fw_arena *arena = fw_arena_new(0);
    make(&c, 1e9, 0.3e-3, 0.2e-3);
    c.tether.neck_m = c.tether.finger_m;
    const fw_statics_tethers *t = found(arena, &c);
    const fw_statics_tether *x = &t->item[0];
    double a = c.tether.length_m - x->probe_m, w = c.tether.finger_m;
    assert_relative(x->last.stress_per_N, 6.0 * a / (H * w * w), 1e-6);
    assert_relative(x->last.force_N, STRENGTH * H * w * w / (6.0 * a), 1e-6);
    double slide = 1.2 * a / (E / 2.5 * H * w);
    assert_relative(x->last.move_m / x->last.force_N, a * a * a / (3.0 * bending(w)) + slide, 1e-6);
    assert_false(x->last.at_neck);
    assert_relative(x->last.low_N, 0.6 * x->last.force_N, 1e-12);
    assert_relative(x->last.high_N, 1.4 * x->last.force_N, 1e-12);
    fw_arena_free(arena);
}

/* the body held: a beam between two walls, P a b^2/L^2 at one and P a^2 b/L^2 at the other; shear adds
   to the way, and shifts the moments by less than 2 % here */
static void a_held_body_leaves_two_walls(void **unused) {
    (void)unused;
    case_of c;
    fw_arena *arena = fw_arena_new(0);
    make(&c, 1e-12, 0.3e-3, 0.2e-3);
    c.tether.neck_m = c.tether.finger_m = 6e-6;
    c.tether.flare_m = 1e-9;
    const fw_statics_tethers *t = found(arena, &c);
    const fw_statics_tether *x = &t->item[0];
    double a = c.tether.length_m - x->probe_m, l = c.tether.length_m + c.tether.stub_m, b = l - a;
    double wall = fmax(a * b * b, a * a * b) / (l * l), w = c.tether.finger_m;
    double under = 2.0 * a * a * b * b / (l * l * l);
    assert_relative(x->last.stress_per_N, 6.0 * fmax(wall, under) / (H * w * w), 2e-2);
    fw_arena_free(arena);
}

/* ---- direct stiffness: the same beam in many pieces, the body a rigid lever on the hinge ---- */

enum { PIECES = 600, MOST = 3 * (PIECES + 1) };

static double width_of(const fw_layout_tether *t, double s) {
    double neck = t->length_m - t->neck_long_m, flare = neck - t->flare_m;
    if (s <= flare) return t->finger_m;
    if (s >= neck) return t->neck_m;
    return t->finger_m + (s - flare) / t->flare_m * (t->neck_m - t->finger_m);
}

/* a banded system of lateral displacement and rotation, solved by elimination; the axis is apart */
static void by_direct_stiffness(const case_of *c, double a, double *move, double *stress) {
    static double k[2 * PIECES + 2][2 * PIECES + 3];
    const fw_layout_tether *t = &c->tether;
    const double l = t->length_m + t->stub_m, step = l / PIECES;
    enum { N = 2 * PIECES + 2 };
    memset(k, 0, sizeof k);
    double flex[PIECES], phi[PIECES];
    for (int i = 0; i < PIECES; i++) {
        double w = width_of(t, (i + 0.5) * step), ei = bending(w),
               ga = E / (2 * (1 + NU)) * H * w / 1.2;
        phi[i] = 12 * ei / (ga * step * step);
        double f = flex[i] = ei / (1 + phi[i]) / (step * step * step);
        const double e[4][4] = {
            {12, 6 * step, -12, 6 * step},
            {6 * step, (4 + phi[i]) * step * step, -6 * step, (2 - phi[i]) * step * step},
            {-12, -6 * step, 12, -6 * step},
            {6 * step, (2 - phi[i]) * step * step, -6 * step, (4 + phi[i]) * step * step}};
        for (int p = 0; p < 4; p++)
            for (int q = 0; q < 4; q++)
                k[2 * i + p][2 * i + q] += f * e[p][q];
    }
    /* the end is on the body: hinge springs in the plane, its stiff axis along the beam left out by
       placing the tether straight above the hinge */
    double lever = t->cut.y - t->stub_m, turn = 1.0 / c->hinge.closed_form.compliance[0][0],
           side = 1.0 / c->hinge.closed_form.compliance[1][1];
    /* lateral v at the end is -x; the hinge moves by v - theta lever' with the beam pointing to -y */
    double r = lever;
    k[N - 2][N - 2] += side, k[N - 2][N - 1] += side * r, k[N - 1][N - 2] += side * r;
    k[N - 1][N - 1] += side * r * r + turn;
    int at = (int)lround(a / step) * 2;
    k[at][N] = 1.0;
    for (int i = 0; i < 2; i++) { /* the wall */
        memset(k[i], 0, sizeof k[i]);
        k[i][i] = 1.0;
    }
    for (int i = 0; i < N; i++)
        for (int j = i + 1; j < N && j < i + 4; j++) {
            double part = k[j][i] / k[i][i];
            for (int q = i; part != 0.0 && q < i + 4 && q < N; q++)
                k[j][q] -= part * k[i][q];
            k[j][N] -= part * k[i][N];
        }
    static double x[2 * PIECES + 2];
    for (int i = N - 1; i >= 0; i--) {
        x[i] = k[i][N];
        for (int j = i + 1; j < N && j < i + 4; j++)
            x[i] -= k[i][j] * x[j];
        x[i] /= k[i][i];
    }
    *move = x[at];
    *stress = 0.0;
    for (int i = 0; i < PIECES; i++) { /* moments at both ends of each piece */
        const double *u = x + 2 * i;
        double m0 = flex[i] * step *
                    (6 * (u[0] - u[2]) + (4 + phi[i]) * step * u[1] + (2 - phi[i]) * step * u[3]),
               m1 = flex[i] * step *
                    (6 * (u[0] - u[2]) + (2 - phi[i]) * step * u[1] + (4 + phi[i]) * step * u[3]);
        double w0 = width_of(t, i * step), w1 = width_of(t, (i + 1) * step);
        *stress = fmax(*stress, fmax(6 * fabs(m0) / (H * w0 * w0), 6 * fabs(m1) / (H * w1 * w1)));
    }
}

static void stepped_beams_agree_with_direct_stiffness(void **unused) {
    (void)unused;
    static const double compliance[] = {1e-4, 1.0, 30.0, 1e3};
    for (int i = 0; i < 4; i++) {
        case_of c;
        double move, stress;
        fw_arena *arena = fw_arena_new(0);
        make(&c, compliance[i], 0.0, 0.2e-3);
        const fw_statics_tether *x = &found(arena, &c)->item[0];
        by_direct_stiffness(&c, c.tether.length_m - x->probe_m, &move, &stress);
        assert_relative(x->last.move_m / x->last.force_N, move, 1e-2);
        assert_relative(x->last.stress_per_N, stress, 2e-2);
        fw_arena_free(arena);
    }
}

/* Two hinges at one place: one after the other, with a body between, they are one of twice the compliance;
   beside each other, one of half of it. The place and the bodies' own frames are anywhere. */
static void hinges_add_up(void **unused) {
    (void)unused;
    for (int beside = 0; beside < 2; beside++) {
        case_of one, two;
        fw_arena *arena = fw_arena_new(0);
        fw_mechanism_mass body[2];
        fw_mechanism_pin pin[2];
        fw_mechanism_hinge hinge[2];
        fw_layout_hinge_layout drawn[2] = {{0}, {0}};
        make(&one, 3.0, 0.35e-3, 0.25e-3);
        make(&two, beside ? 6.0 : 1.5, 0.35e-3, 0.25e-3);
        body[0] = two.body, body[1] = two.body;
        body[1].x_m = -0.2e-3, body[1].y_m = 0.4e-3;
        pin[0] = pin[1] = two.pin;
        hinge[0] = hinge[1] = two.hinge;
        hinge[1].pin = 1;
        if (beside) {
            pin[1].body_a = 0, pin[1].body_b = FW_GROUND; /* turned round */
            pin[1].ax_m = pin[1].bx_m, pin[1].ay_m = pin[1].by_m;
            pin[1].bx_m = pin[1].by_m = 0.0;
        } else { /* ground, body 1, body 0 */
            pin[0].body_a = 1, pin[0].ax_m = 0.2e-3, pin[0].ay_m = -0.4e-3;
            pin[1].body_b = 1, pin[1].bx_m = 0.2e-3, pin[1].by_m = -0.4e-3;
        }
        one.hinge.closed_form.stress_per_rad_Pa = 1e17; /* beside it the pull is nothing */
        for (int k = 0; k < 2; k++)
            hinge[k].closed_form.stress_per_rad_Pa = beside ? 1e17 : 2e17;
        two.layout.hinge = drawn;
        two.m.body = body, two.m.pin = pin, two.m.hinge = hinge;
        two.m.nbody = beside ? 1 : 2, two.m.npin = two.m.nhinge = 2;
        const fw_statics_tether_break *a = &found(arena, &one)->item[0].last,
                                      *b = &found(arena, &two)->item[0].last;
        assert_relative(b->force_N, a->force_N, 1e-8);
        assert_relative(b->move_m, a->move_m, 1e-8);
        assert_relative(b->hinge_share, a->hinge_share, 1e-4);
        fw_arena_free(arena);
    }
}

/* a stiffer hinge takes more of the load */
static void the_share_of_the_hinge_is_told(void **unused) {
    (void)unused;
    case_of c;
    fw_arena *arena = fw_arena_new(0);
    const char *words;
    make(&c, 1.0, 0.3e-3, 0.2e-3);
    const fw_statics_tethers *t = found(arena, &c);
    const fw_statics_tether_break *b = &t->item[0].last;
    assert_int_equal(b->hinge, 0);
    assert_relative(b->hinge_used, b->hinge_share * c.device.safety_factor, 1e-12);
    assert_relative(b->hinge_most, 1.4 * b->hinge_used, 1e-12);
    assert_true(b->hinge_share > 0.0);
    assert_int_equal(fw_statics_tethers_words(arena, &c.m, t, &words), FW_OK);
    assert_non_null(strstr(words, "hinge A bears at most"));
    assert_true((b->hinge_share >= 1.0) == (strstr(words, "BEFORE THE TETHER") != NULL));
    c.m.npin = 2; /* a joint that is no flexure */
    assert_int_equal(fw_statics_tethers_find(arena, &c.m, &t), FW_OK);
    assert_non_null(t->why);
    assert_int_equal(fw_statics_tethers_words(arena, &c.m, t, &words), FW_OK);
    assert_non_null(strstr(words, "NOT COMPUTABLE"));
    fw_arena_free(arena);
}

/* how far the cut goes towards the finger, by a shift and by a turn about the centre of mass, and what the
   run sheet says of it */
static void a_body_that_goes_towards_its_finger_is_told(void **state) {
    (void)state;
    static case_of c;
    fw_arena *arena = fw_arena_new(0);
    const fw_statics_tethers *all;
    const char *text;
    make(&c, 1e-3, 0.7e-3, 0.2e-3);
    c.m.drawn = &c.body;
    assert_int_equal(fw_statics_tethers_find(arena, &c.m, &all), FW_OK);
    const double x = c.body.x_m, y = c.body.y_m, turn = 0.01;
    const double away[3] = {x, y - 20e-6, 0}, rows[6] = {x + 50e-6, y + 3e-6, 0, x, y, turn};
    fw_statics_tethers_watch(all, &c.m, "back", away, 1);
    assert_near(all->item[0].toward_m, 0, 1e-12);
    assert_int_equal(fw_statics_tethers_words(arena, &c.m, all, &text), FW_OK);
    assert_null(strstr(text, "at the frame"));
    fw_statics_tethers_watch(all, &c.m, "shift", rows, 1);
    assert_near(all->item[0].toward_m, 3e-6, 1e-15);
    assert_string_equal(all->item[0].scene, "shift");
    fw_statics_tethers_watch(all, &c.m, "both", rows, 2);
    /* the cut is at (0.4, 0.3) mm from the centre of mass */
    assert_near(all->item[0].toward_m, 0.4e-3 * sin(turn) + 0.3e-3 * (cos(turn) - 1), 1e-15);
    assert_int_equal(fw_statics_tethers_words(arena, &c.m, all, &text), FW_OK);
    assert_non_null(strstr(text, "at the frame, too"));
    assert_non_null(strstr(text, "(3.98 um in scene both)"));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_free_body_leaves_a_cantilever),
        cmocka_unit_test(a_held_body_leaves_two_walls),
        cmocka_unit_test(stepped_beams_agree_with_direct_stiffness),
        cmocka_unit_test(hinges_add_up),
        cmocka_unit_test(the_share_of_the_hinge_is_told),
        cmocka_unit_test(a_body_that_goes_towards_its_finger_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
