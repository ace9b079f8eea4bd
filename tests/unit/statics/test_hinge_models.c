/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole six-bar ABCDEF on flexures of the tables (r = 100 um, 270 degrees, 8 um x 50 um) with
   its hinges as pins, in closed form and as exact beams: equilibria against independent solutions,
   modes, motions, and what the step between two levels says. */
#include "effects/hinge_rigs.h"
#include "statics/statics.h"

static const double E = 147.0790923914665e9;

enum { LOADS = 4, MODELS = 3 };
static const fw_effects_hinge_model models[MODELS] = {FW_HINGE_REVOLUTE, FW_HINGE_COMPLIANCE,
                                                      FW_HINGE_ELASTICA};

typedef struct reference { /* um and rad: platform by model, twist (rad, um, um) of each hinge with
                              exact beams; shooting by Runge-Kutta, n = 128 */
    int body[2];
    double load[2][3]; /* N, N, N m */
    double pose[MODELS][3];
    double angle[6]; /* A to F, as phi_b - phi_a counts */
} reference;

static const reference load_acceleration[LOADS] = {
    {{0, 4},
     {{0, 0, 1.5e-7}, {0, 0, 0.5e-7}},
     {{-154.21262097871914, -21.98175475034262, 0.03581046514255851},
      {-155.04022506993311, -21.8362154572784, 0.03650960718103183},
      {-155.04022506993311, -21.8362154572784, 0.03650960718103183}},
     {0.12691051326159716, -0.08165011321851055, -0.008750792862054782, -0.030826654103326023,
      -0.039221964556779634, 0.10655822584113749}},
    {{0, 4},
     {{0, 0, -3e-7}, {0, 0, 3e-7}},
     {{2.797732516304513e-10, 81.99249699568844, 1.5174223686332005e-13},
      {1.3913825568937488, 81.44031273173971, -1.2500889802526859e-05},
      {1.3913825568937488, 81.44031273173971, -1.2500889802526859e-05}},
     {-0.05536391012885042, 0.12633603882834848, -0.07098462958930059, 0.07260166966117837,
      -0.12675404989042016, 0.054139879339439284}},
    {{2, 2},
     {{150e-6, 0, 0}, {0, 0, 0}},
     {{157.82863124017376, -6.083681557139469, -0.01854989969378776},
      {160.238868236719, -6.057972332452664, -0.020282277220120427},
      {160.238868236719, -6.057972332452664, -0.020282277220120427}},
     {-0.11468207027064851, 0.0533643631204208, 0.04103542993010728, 0.045825063893770515,
      0.04859482918950138, -0.11470217030339232}},
    {{2, 2},
     {{0, 0, 3e-7}, {0, 0, 0}},
     {{-37.60053929176996, -5.001650147157917, 0.10603979131082786},
      {-40.30551076969056, -4.828665370104318, 0.10959798125006724},
      {-40.30551076969056, -4.828665370104318, 0.10959798125006724}},
     {0.05355216524668831, -0.07448906755327384, 0.13053488355665277, 0.12321825598596428,
      -0.06542340361335695, 0.051803128877459914}},
};

typedef struct scenery {
    rig r;
    fw_device_force force[2];
    fw_device_torque torque[2];
} scenery;

static void six_bar(scenery *s, const reference *load, double share) {
    rig *r = &s->r;
    rig_six_bar(r, false);
    for (int i = 0; i < 6; i++)
        rig_strip(&r->hinge[i], E);
    for (int i = 0; i < 2; i++) {
        s->force[i] = (fw_device_force){.body = load->body[i],
                                        .fx_N = share * load->load[i][0],
                                        .fy_N = share * load->load[i][1]};
        s->torque[i] =
            (fw_device_torque){.body = load->body[i], .value_Nm = share * load->load[i][2]};
    }
    r->scene.force = s->force, r->scene.nforce = 2;
    r->scene.torque = s->torque, r->scene.ntorque = 2;
}

static const char *last_word(const rig *r) {
    return r->diags.count ? r->diags.item[r->diags.count - 1].message : "no message";
}

static const fw_statics *rest(rig *r, fw_effects_hinge_model model, double accuracy) {
    const fw_statics *out = NULL;
    const fw_statics_static_options o = {.effects = {.mode = FW_EFFECTS_AUTO, .hinge = model},
                                         .accuracy = accuracy};
    if (fw_statics_solve(r->arena, &r->m, &r->scene, &o, &r->diags, &out) != FW_OK)
        fail_msg("%s", last_word(r));
    return out;
}

/* hinge.md 2.5: four loads, three models, to the digits there */
static void poses(void **state) {
    (void)state;
    for (int l = 0; l < LOADS; l++)
        for (int k = 0; k < MODELS; k++) {
            scenery s;
            six_bar(&s, &load_acceleration[l], 1);
            const fw_statics *x = rest(&s.r, models[k], 0);
            const double *want = load_acceleration[l].pose[k];
            assert_int_equal(x->ledger.hinge.used, models[k]);
            assert_near((x->q[6] - s.r.body[2].x_m) * 1e6, want[0], 2e-5);
            assert_near((x->q[7] - s.r.body[2].y_m) * 1e6, want[1], 2e-5);
            assert_near(x->q[8], want[2], 1e-8);
            for (int i = 0; i < 6 && k == 2; i++)
                assert_near(x->angle_rad[i], load_acceleration[l].angle[i], 5e-9);
            fw_arena_free(s.r.arena);
        }
}

/* the step from one level to the next is the difference of their equilibria */
static void step_up(void **state) {
    (void)state;
    for (int l = 0; l < LOADS; l++)
        for (int k = 0; k < MODELS; k++) {
            scenery s;
            six_bar(&s, &load_acceleration[l], 1);
            const fw_statics_level_step *step = rest(&s.r, models[k], 0)->level;
            assert_non_null(step);
            assert_int_equal(step->used, models[k]);
            if (k == MODELS - 1) {
                assert_non_null(step->why_not);
                assert_true(isnan(step->relative));
                fw_arena_free(s.r.arena);
                continue;
            }
            assert_null(step->why_not);
            assert_int_equal(step->next, models[k + 1]);
            for (int i = 0; i < 3; i++) {
                const double unit = i < 2 ? 1e6 : 1, *a = load_acceleration[l].pose[k],
                             *b = load_acceleration[l].pose[k + 1];
                double tolerance = i < 2 ? 4e-5 : 2e-8;
                assert_near((step->up.q[6 + i] - step->at.q[6 + i]) * unit, b[i] - a[i], tolerance);
            }
            double largest = 0, off = 0;
            const fw_statics *up = rest(&s.r, models[k + 1], 0);
            for (int i = 0; i < 6; i++) {
                largest = fmax(largest, fabs(step->at.angle_rad[i]));
                largest = fmax(largest, fabs(step->up.angle_rad[i]));
                off = fmax(off, fabs(up->angle_rad[i] - step->at.angle_rad[i]));
                assert_near(up->angle_rad[i], step->up.angle_rad[i], 1e-12);
                assert_near(up->reaction_N[2 * i], step->up.reaction_N[2 * i], 1e-12);
            }
            double way = 0, apart = 0; /* of all bodies */
            for (int b = 0; b < s.r.m.nbody; b++) {
                const double *at = step->at.q + 3 * b, *next = step->up.q + 3 * b;
                way = fmax(way, hypot(at[0] - s.r.body[b].x_m, at[1] - s.r.body[b].y_m));
                way = fmax(way, hypot(next[0] - s.r.body[b].x_m, next[1] - s.r.body[b].y_m));
                apart = fmax(apart, hypot(next[0] - at[0], next[1] - at[1]));
            }
            for (int i = 0; i < s.r.m.nhinge; i++) { /* and of what hinges turn, a length away */
                const fw_mechanism_hinge *h = &s.r.m.hinge[i];
                way = fmax(way, h->law.length_m * fabs(step->at.angle_rad[h->pin]));
                way = fmax(way, h->law.length_m * fabs(step->up.angle_rad[h->pin]));
            }
            assert_near(step->relative, fmax(off / largest, apart / way), 1e-9);
            fw_arena_free(s.r.arena);
        }
}

/* auto: the cheapest that is good enough. Pins are never (2 to 5 % off), closed forms are for 1e-6
   and, by load, not for 1e-9; what is then used says why and how far off the level below was */
static void by_accuracy(void **state) {
    (void)state;
    for (int l = 0; l < LOADS; l++) {
        scenery s;
        six_bar(&s, &load_acceleration[l], 1);
        const fw_statics *rough = rest(&s.r, FW_HINGE_AUTO, 1e-3);
        assert_int_equal(rough->ledger.hinge.used, FW_HINGE_COMPLIANCE);
        double error = rough->ledger.hinge.error;
        assert_true(error > 1e-9 && error < 1e-6);
        const fw_statics *same = rest(&s.r, FW_HINGE_AUTO, 1.01 * error);
        assert_int_equal(same->ledger.hinge.used, FW_HINGE_COMPLIANCE);
        const fw_statics *fine = rest(&s.r, FW_HINGE_AUTO, 0.99 * error);
        assert_int_equal(fine->ledger.hinge.used, FW_HINGE_ELASTICA);
        assert_true(fine->ledger.hinge.error <= 1e-8);
        assert_non_null(strstr(fine->ledger.hinge.why, "compliance was computed to be off"));
        fw_arena_free(s.r.arena);
    }
}

static const fw_statics_modes *small(rig *r, fw_effects_hinge_model model, bool loaded) {
    const fw_statics_modes *out = NULL;
    const fw_statics_mode_options o = {.effects = {.mode = FW_EFFECTS_ALL, .hinge = model},
                                       .at_equilibrium = loaded};
    if (fw_statics_small_motions(r->arena, &r->m, &r->scene, &o, &r->diags, &out) != FW_OK)
        fail_msg("%s", last_word(r));
    return out;
}

/* the same linear hinge at rest (K, kx, ky are the same integrals), and with W in the same place;
   pins are the limit of hinges that hardly give. Under load the slow modes differ by the share that
   the law is off, third order in the force */
static void frequencies(void **state) {
    (void)state;
    for (int l = 0; l < LOADS; l++)
        for (int loaded = 0; loaded < 2; loaded++) {
            scenery s;
            six_bar(&s, &load_acceleration[l], 1);
            const fw_statics_modes *pin = small(&s.r, FW_HINGE_REVOLUTE, loaded);
            const fw_statics_modes *law = small(&s.r, FW_HINGE_COMPLIANCE, loaded);
            const fw_statics_modes *exact = small(&s.r, FW_HINGE_ELASTICA, loaded);
            assert_int_equal(pin->count, 3);
            assert_int_equal(law->count, 15);
            assert_int_equal(exact->count, 15);
            double worst = 0, slow = 0;
            for (int k = 0; k < 15; k++) {
                double off = fabs(exact->mode[k].f_Hz / law->mode[k].f_Hz - 1);
                worst = fmax(worst, off);
                if (k < 3) slow = fmax(slow, off);
            }
            if (!loaded) assert_true(worst < 1e-9);
            if (loaded) assert_true(slow < 1e-5 && slow > 1e-11);
            if (loaded) assert_near(law->ledger.hinge.error, slow, 1e-5 * slow);
            for (int k = 0; k < 3; k++) {
                double off = exact->mode[k].f_Hz / pin->mode[k].f_Hz - 1;
                assert_true(off < (loaded ? 0.05 : 0) && off > -0.2);
            }
            fw_arena_free(s.r.arena);
        }
}

/* half of a load comes at once, every mode rings with some damping: closed form and exact beam
   differ by no more than what the step at the peak says (and some of what their frequencies do),
   energy closes for both, and the beam's force is the same run after run */
static void motions(void **state) {
    (void)state;
    scenery s;
    six_bar(&s, &load_acceleration[2], 0.5);
    s.r.scene.duration_s = 2e-3;
    for (int i = 0; i < 6; i++)
        s.r.pin[i].damping_Nms_per_rad = 2e-12;
    const fw_dynamics_motion *x[3];
    for (int k = 0; k < 3; k++) {
        const fw_dynamics_motion_options o = {
            .effects = {.mode = FW_EFFECTS_ALL,
                        .hinge = k ? FW_HINGE_ELASTICA : FW_HINGE_COMPLIANCE},
            .accuracy = 1e-5,
            .samples = 401};
        if (fw_statics_move_scene(s.r.arena, &s.r.m, &s.r.scene, &o, &s.r.diags, &x[k]) != FW_OK)
            fail_msg("%s", last_word(&s.r));
        assert_true(x[k]->stats.energy_error < 1e-6);
        assert_int_equal(x[k]->ledger.hinge.used, o.effects.hinge);
    }
    double largest = 0, off = 0;
    for (int i = 0; i < 6; i++) {
        largest = fmax(largest, fabs(x[0]->peak[i].angle_rad));
        off = fmax(off, fabs(x[1]->peak[i].angle_rad - x[0]->peak[i].angle_rad));
        assert_memory_equal(&x[1]->peak[i].angle_rad, &x[2]->peak[i].angle_rad, sizeof(double));
    }
    assert_true(largest > 0.05);
    assert_true(off < 3 * x[0]->level->relative * largest);
    fw_arena_free(s.r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(poses),       cmocka_unit_test(step_up), cmocka_unit_test(by_accuracy),
        cmocka_unit_test(frequencies), cmocka_unit_test(motions),
    };
    return cmocka_run_group_tests_name("hinge-models", tests, NULL, NULL);
}
