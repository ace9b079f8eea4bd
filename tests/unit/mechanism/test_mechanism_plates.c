/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plates on flexures: a mass at the end of a leaf, a beam between two leaves, a layer that curls, a link that is
   pressed; each against what follows by hand. */
#include "base/constants.h"
#include "flexure/path.h"
#include "mechanism/mechanism_plates.h"
#include "test.h"

enum { BODIES = 2, HINGES = 3 };

typedef struct rig {
    fw_arena *arena;
    fw_mechanism m;
    fw_mechanism_variant variant;
    fw_mechanism_mass body[BODIES];
    fw_mechanism_shape shape[BODIES];
    fw_mechanism_pin pin[HINGES];
    fw_mechanism_hinge hinge[HINGES];
} rig;

static const double L = 200e-6, W = 8e-6, H = 20e-6, E = 100e9;

static void rig_new(rig *r) {
    memset(r, 0, sizeof *r);
    r->arena = fw_arena_new(0);
    r->variant.thickness_m = H;
    r->m = (fw_mechanism){.variant = &r->variant,
                          .body = r->body,
                          .drawn = r->body,
                          .shape = r->shape,
                          .pin = r->pin,
                          .hinge = r->hinge};
}

/* a x b, about its middle */
static void add_body(rig *r, double x, double y, double a, double b, double mass) {
    int k = r->m.nbody++;
    r->body[k] = (fw_mechanism_mass){.id = "B",
                                     .mass_kg = mass,
                                     .x_m = x,
                                     .y_m = y,
                                     .inertia_kg_m2 = mass * (a * a + b * b) / 12};
    r->shape[k] = (fw_mechanism_shape){.area_m2 = a * b,
                                       .polar_m4 = a * b * (a * a + b * b) / 12,
                                       .spread_m4 = {a * b * (a * a - b * b) / 12, 0}};
}

/* a leaf with ideal ends along x whose middle is at (x, y), from a (at the left) to b */
static void add_leaf(rig *r, double x, double y, int a, int b) {
    int k = r->m.nhinge++;
    fw_mechanism_hinge *h = &r->hinge[k];
    *h = (fw_mechanism_hinge){.pin = k, .scale = 1, .axis_rad = 0.5 * FW_PI, .first_is_a = false};
    h->input = (fw_flexure_input){.kind = FW_FLEXURE_LEAF,
                                  .length_m = L,
                                  .width_m = W,
                                  .fillet_m = -1,
                                  .depth_m = H,
                                  .youngs_Pa = E,
                                  .poisson = 0.3,
                                  .strength_Pa = 1e9,
                                  .safety_factor = 1,
                                  .ends = true};
    fw_flexure_closed_form(&h->input, &h->closed_form);
    fw_mechanism_pin *p = &r->pin[r->m.npin++];
    *p = (fw_mechanism_pin){.id = "A",
                            .body_a = a,
                            .body_b = b,
                            .hinge = k,
                            .ax_m = x,
                            .ay_m = y,
                            .bx_m = x,
                            .by_m = y,
                            .root_a_m = {-0.5 * L, 0},
                            .root_b_m = {0.5 * L, 0}};
    if (a != FW_GROUND) p->ax_m -= r->body[a].x_m, p->ay_m -= r->body[a].y_m;
    if (b != FW_GROUND) p->bx_m -= r->body[b].x_m, p->by_m -= r->body[b].y_m;
}

static fw_mechanism_plates plates_of(rig *r) {
    fw_mechanism_plates p;
    assert_int_equal(fw_mechanism_plates_new(r->arena, &r->m, NULL, &p), FW_OK);
    return p;
}

static double EI(void) {
    return E * W * H * H * H / 12;
}

static double sheared(void) { /* 1/(k G A) */
    return 1.2 / (E / 2.6 * W * H);
}

/* a small heavy body at the end: a cantilever with a tip load */
static void tip_mass(void **state) {
    (void)state;
    rig r;
    rig_new(&r);
    add_body(&r, L, 0, 1e-7, 1e-7, 1e-9);
    add_leaf(&r, 0.5 * L, 0, FW_GROUND, 0);
    const fw_mechanism_plates p = plates_of(&r);
    double f[3], x[3], give = L * L * L / (3 * EI()) + L * sheared();
    assert_null(p.why);
    fw_mechanism_plates_weight(&p, -9.80665, f);
    fw_mechanism_plates_answer(&p, f, x);
    assert_relative(x[0], -9.80665e-9 * give, 1e-8);
    assert_relative(fw_mechanism_plates_z(&p, x, 0, (fw_geometry_vec2){L, 0}), x[0], 1e-12);
    assert_relative(x[2], 9.80665e-9 * L * L / (2 * EI()), 1e-8); /* slope of its end, down ahead */
    assert_relative(p.f_Hz[0], sqrt(1 / (1e-9 * give)) / (2 * FW_PI), 1e-3);
    bool tilts = true;
    assert_int_equal(fw_mechanism_plates_mover(&p, 0, &tilts), 0);
    assert_false(tilts);
    fw_mechanism_plates_stiff stiff;
    assert_int_equal(fw_mechanism_plates_stiffness(r.arena, &p, &stiff), FW_OK);
    assert_relative(stiff.across_N_per_m, 1 / give, 1e-8);
    double in = L * L * L / (3 * E * H * W * W * W / 12);
    assert_relative(stiff.in_N_per_m, 1 / in, 0.02); /* the closed form's shear and depth */
    fw_arena_free(r.arena);
}

/* a beam with a leaf at either end: up and down 2 x 12 EI/L^3, rolling about its length by torsion, tilting by both */
static void between_two(void **state) {
    (void)state;
    rig r;
    rig_new(&r);
    const double a = 400e-6, b = 100e-6, mass = 2e-9;
    add_body(&r, 0, 0, a, b, mass);
    add_leaf(&r, -0.5 * (a + L), 0, FW_GROUND, 0);
    add_leaf(&r, 0.5 * (a + L), 0, 0, FW_GROUND);
    const fw_mechanism_plates p = plates_of(&r);
    const double k = 1 / (L * L * L / (12 * EI()) + L * sheared()), lever = 0.5 * (a + L);
    const double roll = mass * (b * b + H * H) / 12, tilt = mass * (a * a + H * H) / 12;
    double want[3] = {sqrt(2 * k / mass), sqrt(2 * (EI() / L + k * lever * lever) / tilt),
                      sqrt(2 / (p.hinge[0].c[1][1] * roll))};
    for (int i = 0; i < 3; i++) {
        bool found = false;
        for (int j = 0; j < 3; j++)
            found = found || fabs(2 * FW_PI * p.f_Hz[j] / want[i] - 1) < 1e-8;
        assert_true(found);
    }
    /* a flexure that is given 1e9 times as much more holds nothing */
    double give[18] = {0}, soft;
    for (int i = 0; i < 3; i++)
        give[4 * i] = p.hinge[0].c[i][i];
    fw_mechanism_plates q;
    assert_int_equal(fw_mechanism_plates_new(r.arena, &r.m, give, &q), FW_OK);
    soft = q.f_Hz[0];
    assert_true(soft < p.f_Hz[0] && soft > sqrt(0.5) * p.f_Hz[0] * (1 - 1e-9));
    fw_arena_free(r.arena);
}

/* a layer that curls with its one anchor lies on the sphere that is flat there */
static void curls(void **state) {
    (void)state;
    rig r;
    rig_new(&r);
    const double kappa = 5, far = 700e-6;
    add_body(&r, far, 0, 400e-6, 100e-6, 1e-9);
    add_leaf(&r, far - 200e-6 - 0.5 * L, 0, FW_GROUND, 0);
    const fw_mechanism_plates p = plates_of(&r);
    double f[3], x[3];
    fw_geometry_vec2 middle;
    fw_mechanism_plates_curl(&p, kappa, &middle, f);
    fw_mechanism_plates_answer(&p, f, x);
    const double root = far - 200e-6 - L;
    for (int k = 0; k < 3; k++) { /* on the sphere about the root, at any point of the plate */
        const fw_geometry_vec2 at = {far + (k - 1) * 150e-6, 30e-6};
        double dx = at.x - middle.x, dy = at.y - middle.y;
        double z = fw_mechanism_plates_z(&p, x, 0, at) + 0.5 * kappa * (dx * dx + dy * dy);
        assert_relative(z, 0.5 * kappa * ((at.x - root) * (at.x - root) + at.y * at.y), 1e-9);
    }
    fw_arena_free(r.arena);
}

/* a bowed plate reaches as far as its middle on one side, whichever way it bows, and at least as far as its corners on the other */
static void as_far_as_its_middle(void **state) {
    (void)state;
    rig r;
    rig_new(&r);
    const double a = 400e-6, b = 100e-6, away = 1e-6;
    add_body(&r, 0, 0, a, b, 1e-9);
    fw_layout_piece piece = {.role = FW_ROLE_STRUCTURE, .body = 0};
    const fw_layout layout = {.piece = &piece, .npiece = 1};
    assert_int_equal(fw_geometry_contour_rectangle(
                         r.arena, (fw_geometry_box){-0.5 * a, -0.5 * b, 0.5 * a, 0.5 * b}, &piece.contour),
                     FW_OK);
    r.m.layout = &layout;
    const fw_mechanism_plates p = {.mechanism = &r.m, .n = 3};
    for (int up = -1; up <= 1; up += 2) {
        const double x[3] = {-up * away, 0, 0}, bow = 5 * (a * a + b * b) / 8;
        const fw_mechanism_plates_reach reach = fw_mechanism_plates_reached(&p, x, NULL, up * 5.0, (fw_geometry_vec2){0, 0});
        assert_near(up > 0 ? reach.lowest_m : reach.highest_m, -up * away, 1e-18);
        assert_near(up > 0 ? reach.highest_m : reach.lowest_m, fmax(bow - away, 0) * up, 1e-18);
        assert_near(reach.tilt_rad, 0, 1e-18);
    }
    fw_arena_free(r.arena);
}

/* the nearest point of an outline to the foot of its sphere is the lowest, the farthest the highest: of a square with a round
   side, level in the middle, outside it, over the round side and with no curvature at all; the mirror image curls down */
static void as_low_as_it_is_drawn(void **state) {
    (void)state;
    rig r;
    rig_new(&r);
    const double a = 100e-6, kappa = 4;
    add_body(&r, 0, 0, 2 * a, 2 * a, 1e-9);
    fw_layout_piece piece = {.role = FW_ROLE_STRUCTURE, .body = 0};
    const fw_layout layout = {.piece = &piece, .npiece = 1};
    fw_geometry_outline o = fw_geometry_outline_start(r.arena, (fw_geometry_vec2){-a, -a});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){a, -a}, 0);
    fw_geometry_outline_arc(&o, (fw_geometry_vec2){a, 0}, FW_PI, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){-a, a}, 0);
    assert_int_equal(fw_geometry_outline_close(&o, &piece.contour), FW_OK);
    r.m.layout = &layout;
    const fw_mechanism_plates p = {.mechanism = &r.m, .n = 3};
    static const struct {
        double x, y, near, far; /* of the foot; distances, in halves of a side */
    } is[] = {{0, 0, 0, 2},       {-3, 0, 2, 5},      {5, 0, 3, 6.0827625},
              {0.5, 9, 8, 10.1118742}, {4, 4, 4, 7.0710678}, {-4, 4, 4.2426407, 7.4031242}};
    for (size_t k = 0; k < sizeof is / sizeof *is; k++)
        for (int up = -1; up <= 1; up += 2) {
            const double near = 0.5 * kappa * a * a * is[k].near * is[k].near,
                         far = 0.5 * kappa * a * a * is[k].far * is[k].far;
            const double x[3] = {0, 0, 0};
            const fw_geometry_vec2 foot = {a * is[k].x, a * is[k].y};
            const fw_mechanism_plates_reach reach =
                fw_mechanism_plates_reached(&p, x, NULL, up * kappa, foot);
            assert_near(up > 0 ? reach.lowest_m : reach.highest_m, 0, 1e-18);
            assert_near(up > 0 ? reach.highest_m : -reach.lowest_m, far, 1e-6 * far);
            /* and from so far below that its lowest point is seen */
            const double down[3] = {-up * 2 * far, 0, 0};
            const fw_mechanism_plates_reach low =
                fw_mechanism_plates_reached(&p, down, NULL, up * kappa, foot);
            assert_near(up > 0 ? low.lowest_m : -low.highest_m, near - 2 * far, 1e-6 * far);
        }
    const double tilted[3] = {0, 0.01, -0.02}; /* z = 0.02 x + 0.01 y: least at a corner, most on the round side */
    const fw_mechanism_plates_reach flat =
        fw_mechanism_plates_reached(&p, tilted, NULL, 0, (fw_geometry_vec2){0, 0});
    assert_near(flat.lowest_m, -0.03 * a, 1e-15);
    assert_near(flat.highest_m, 0.02 * a + hypot(0.02, 0.01) * a, 1e-15);
    fw_arena_free(r.arena);
}

/* a link that is pressed between its leaves: P over what the plate's tilt bears, and each leaf as a cantilever */
static void pressed(void **state) {
    (void)state;
    rig r;
    rig_new(&r);
    const double a = 400e-6, P = 1e-3;
    add_body(&r, 0, 0, a, 100e-6, 2e-9);
    add_leaf(&r, -0.5 * (a + L), 0, FW_GROUND, 0);
    add_leaf(&r, 0.5 * (a + L), 0, 0, FW_GROUND);
    const fw_mechanism_plates p = plates_of(&r);
    const double lever = 0.5 * (a + L), k = 1 / (L * L * L / (12 * EI()) + L * sheared());
    const double tilt = 2 * (EI() / L + k * lever * lever), GJ = p.hinge[0].twist_Nm2,
                 l = 2 * L / FW_PI;
    /* on body b: of the left leaf the link, pushed to the right; of the right one the ground */
    const double force[4] = {P, 0, P, 0}, most[6] = {P * P, 0, P * P, P * P, 0, P * P};
    double factor, alone = P * l * l / EI() + 0.5 * P * L * l / sqrt(EI() * GJ);
    int hinge;
    const double none = 0, off = 1e-7;
    const fw_mechanism_plates_pressed by = {force, most, &none, 0};
    assert_int_equal(fw_mechanism_plates_buckling(r.arena, &p, &by, &factor, &hinge), FW_OK);
    assert_relative(1 / factor, 2 * P * lever / tilt + alone, 1e-8);
    /* where any factor from `enough` on will do: no less than that, and no more than what it is */
    const fw_mechanism_plates_pressed easy = {force, most, &none, 0.3 * factor};
    double bound;
    assert_int_equal(fw_mechanism_plates_buckling(r.arena, &p, &easy, &bound, &hinge), FW_OK);
    assert_true(bound >= 0.3 * factor && bound <= factor * (1 + 1e-9));
    const double pulled[4] = {-P, 0, -P, 0};
    const fw_mechanism_plates_pressed pull = {pulled, most, &none, 0}, besides = {force, most, &off, 0};
    double more;
    assert_int_equal(fw_mechanism_plates_buckling(r.arena, &p, &besides, &more, &hinge), FW_OK);
    assert_relative(1 / more,
                    fmax((2 * P * lever + off) / tilt, off * p.hinge[0].c[1][1] / 2) + alone, 1e-8);
    assert_int_equal(fw_mechanism_plates_buckling(r.arena, &p, &pull, &factor, &hinge), FW_OK);
    assert_relative(1 / factor, alone,
                    1e-8); /* tension holds the plate; of the leaves only sizes are known */
    const double nothing[6] = {0}; /* and with what presses them known, nothing tips */
    const fw_mechanism_plates_pressed held = {pulled, nothing, &none, 0};
    assert_int_equal(fw_mechanism_plates_buckling(r.arena, &p, &held, &factor, &hinge), FW_OK);
    assert_true(factor == HUGE_VAL);
    assert_true(1 / alone < FW_PI * FW_PI * EI() / (4 * L * L * P)); /* below Euler's load */
    fw_arena_free(r.arena);
}

static void not_known(void **state) {
    (void)state;
    rig r;
    rig_new(&r);
    add_body(&r, L, 0, 1e-4, 1e-4, 1e-9);
    add_body(&r, 3 * L, 0, 1e-4, 1e-4, 1e-9);
    add_leaf(&r, 0.5 * L, 0, FW_GROUND, 0);
    assert_string_equal(plates_of(&r).why, "not all bodies are held by flexures");
    r.shape[1].area_m2 = (double)NAN;
    assert_string_equal(plates_of(&r).why, "nothing is drawn of body B");
    fw_arena_free(r.arena);
}

/* what tips a body needs no drawing of it: the same factor, and no modes */
static void tips_undrawn(void **state) {
    (void)state;
    rig r;
    rig_new(&r);
    const double a = 400e-6, P = 1e-3;
    add_body(&r, 0, 0, a, 100e-6, 2e-9);
    add_leaf(&r, -0.5 * (a + L), 0, FW_GROUND, 0);
    add_leaf(&r, 0.5 * (a + L), 0, 0, FW_GROUND);
    const double force[4] = {P, 0, P, 0}, most[6] = {P * P, 0, 0, P * P, 0, 0}, none = 0;
    const fw_mechanism_plates_pressed by = {force, most, &none, 0};
    const fw_mechanism_plates drawn = plates_of(&r);
    double factor[2];
    int hinge;
    assert_int_equal(fw_mechanism_plates_buckling(r.arena, &drawn, &by, &factor[0], &hinge), FW_OK);
    r.shape[0].area_m2 = (double)NAN;
    const fw_mechanism_plates bare = plates_of(&r);
    assert_string_equal(bare.why, "nothing is drawn of body B");
    assert_int_equal(bare.n, 3);
    assert_int_equal(fw_mechanism_plates_buckling(r.arena, &bare, &by, &factor[1], &hinge), FW_OK);
    assert_relative(factor[1], factor[0], 1e-8);
    fw_arena_free(r.arena);
}

/* Where nothing is drawn and nothing said of what tips a body, a force may act as far from its centre of mass as anything that the
   scenes attach to it: the factor is that of one force at that distance, whatever it is that lies there. */
static void loads_act_as_far_as_they_are_attached(void **state) {
    (void)state;
    enum { FORCE, OTHER, SPRING_A, SPRING_B, TENDON, COMB_B, COMB_A, CONTACT_A, CONTACT_B, ROWS };
    const double d = 5e-3, P = 1e-3, x = 0.6 * d, y = 0.8 * d;
    double factor[ROWS + 1];
    for (int n = 0; n <= ROWS; n++) {
        rig r;
        rig_new(&r);
        add_body(&r, 1e-3, -2e-3, 400e-6, 100e-6, 2e-9); /* in axes that are not the world's */
        add_leaf(&r, 1e-3 - 0.5 * (400e-6 + L), -2e-3, FW_GROUND, 0);
        r.shape[0].area_m2 = (double)NAN;
        fw_device_force force = {.body = n == OTHER ? 1 : 0, .x_m = n == ROWS ? 2 * x : x, .y_m = n == ROWS ? 2 * y : y};
        fw_device_spring spring = {.body_a = n == SPRING_A ? 0 : FW_GROUND, .body_b = n == SPRING_A ? FW_GROUND : 0,
                                   .ax_m = n == SPRING_A ? x : 9, .ay_m = n == SPRING_A ? y : 9, .bx_m = n == SPRING_A ? 9 : x,
                                   .by_m = n == SPRING_A ? 9 : y};
        fw_device_eyelet eyelet[2] = {{.body = FW_GROUND, .x_m = 9}, {.body = 0, .x_m = x, .y_m = -y}};
        fw_device_tendon tendon = {.eyelet = eyelet, .neyelet = 2};
        /* half its length 1 mm, 4 x 2 x (10 + 40) um wide, a gap of 10 um, and its place 3.59 mm away: 5 mm */
        fw_device_comb comb = {.fingers = 4, .gap_m = 10e-6, .width_m = 40e-6, .length_m = 2e-3, .body_a = n == COMB_A ? 0 : FW_GROUND,
                               .body_b = n == COMB_A ? FW_GROUND : 0, .bx_m = n == COMB_A ? 1e-3 + 0.6 * 3.59e-3 : 0.6 * 3.59e-3,
                               .by_m = n == COMB_A ? -2e-3 + 0.8 * 3.59e-3 : 0.8 * 3.59e-3};
        fw_device_contact_use contact = {.joint = FW_NONE, .body_a = n == CONTACT_A ? 0 : FW_GROUND, .body_b = n == CONTACT_A ? FW_GROUND : 0,
                                         .distance_m = 1e-3, .ax_m = n == CONTACT_A ? 0.8 * x : 9, .ay_m = n == CONTACT_A ? 0.8 * y : 9,
                                         .bx_m = n == CONTACT_A ? 9 : 0.8 * x, .by_m = n == CONTACT_A ? 9 : 0.8 * y};
        fw_device_scene scene = {.name = "s"};
        if (n == FORCE || n == OTHER || n == ROWS) scene.force = &force, scene.nforce = 1;
        if (n == SPRING_A || n == SPRING_B) r.m.spring = &spring, r.m.nspring = 1;
        if (n == TENDON) scene.tendon = &tendon, scene.ntendon = 1;
        if (n == COMB_A || n == COMB_B) scene.comb = &comb, scene.ncomb = 1;
        if (n == CONTACT_A || n == CONTACT_B) scene.contact = &contact, scene.ncontact = 1;
        const fw_device device = {.scene = &scene, .nscene = 1};
        r.m.device = &device;
        const double pull[2] = {P, 0.3 * P}, most[3] = {P * P, 0, 0}, unknown = (double)NAN;
        const fw_mechanism_plates_pressed by = {pull, most, &unknown, 0};
        const fw_mechanism_plates bare = plates_of(&r);
        int hinge;
        assert_int_equal(fw_mechanism_plates_buckling(r.arena, &bare, &by, &factor[n], &hinge), FW_OK);
        fw_arena_free(r.arena);
    }
    for (int n = 0; n < ROWS; n++)
        if (n != OTHER) assert_relative(factor[n], factor[FORCE], 1e-9);
    assert_true(factor[OTHER] > 1.05 * factor[FORCE] && factor[ROWS] < 0.95 * factor[FORCE]); /* of no other body; and farther is worse */
}

static void counted(void **state) {
    (void)state;
    const double a[] = {10, 30}, b[] = {20, 25, 40};
    const fw_mechanism_frequencies in = {a, 2, sizeof *a}, out = {b, 3, sizeof *b};
    static const int want[6][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}, {2, 1}, {-1, 0}};
    bool across;
    for (int n = 1; n <= 6; n++) {
        assert_int_equal(fw_mechanism_plates_nth(n, FW_PLANE_EITHER, in, out, &across),
                         want[n - 1][0]);
        if (n < 6) assert_int_equal(across, want[n - 1][1]);
    }
    assert_int_equal(fw_mechanism_plates_nth(2, FW_PLANE_IN, in, out, &across), 1);
    assert_false(across);
    assert_int_equal(fw_mechanism_plates_nth(3, FW_PLANE_ACROSS, in, out, &across), 2);
    assert_true(across);
    assert_int_equal(fw_mechanism_plates_nth(3, FW_PLANE_IN, in, out, &across), -1);
}

/* two arms that are mirror images move as much, but for the last digits of the library: it is the first one that is named */
static void of_equal_movers_the_first(void **state) {
    (void)state;
    double mass[18] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    double shape[36] = {0.7, 0.1, 0, 0.7 * (1 + 1e-12), 0.1, 0};
    const fw_mechanism_plates p = {.n = 6, .mass = mass, .shape = shape};
    bool tilts = true;
    assert_int_equal(fw_mechanism_plates_mover(&p, 0, &tilts), 0);
    assert_false(tilts);
    shape[3] = 0.71;
    assert_int_equal(fw_mechanism_plates_mover(&p, 0, &tilts), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_equal_movers_the_first),
        cmocka_unit_test(tip_mass), cmocka_unit_test(between_two), cmocka_unit_test(curls),
        cmocka_unit_test(as_far_as_its_middle),
        cmocka_unit_test(as_low_as_it_is_drawn),
        cmocka_unit_test(pressed),  cmocka_unit_test(not_known), cmocka_unit_test(tips_undrawn),   cmocka_unit_test(counted),
        cmocka_unit_test(loads_act_as_far_as_they_are_attached),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
