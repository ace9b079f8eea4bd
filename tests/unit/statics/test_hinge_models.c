/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole six-bar ABCDEF on flexures of the tables (r = 100 um, 270 degrees, 8 um x 50 um) with
   its hinges as pins, in closed form and as exact beams: equilibria against independent solutions,
   modes, motions, and what the step between two levels says. */
#include "effects/hinge_rigs.h"
#include "statics/level.h"
#include "statics/modes.h"
#include "statics/quasi.h"
#include "statics/statics.h"

static const double E = 147.0790923914665e9;

enum { LOADS = 4, MODELS = 3 };
static const fw_hinge_model models[MODELS] = {FW_HINGE_REVOLUTE, FW_HINGE_COMPLIANCE,
                                              FW_HINGE_ELASTICA};

typedef struct reference { /* um and rad: platform by model, twist (rad, um, um) of each hinge with
                              exact beams; shooting by Runge-Kutta, n = 128 */
    int body[2];
    double load[2][3]; /* N, N, N m */
    double pose[MODELS][3];
    double angle[6]; /* A to F, as phi_b - phi_a counts */
} reference;

static const reference loads[LOADS] = {
    {{0, 4},
     {{0, 0, 1.5e-7}, {0, 0, 0.5e-7}},
     {{-154.21262097871914, -21.98175475034262, 0.03581046514255851},
      {-155.0400837915246, -21.8362627379247, 0.03650945844046964},
      {-155.04022506993311, -21.8362154572784, 0.03650960718103183}},
     {0.12691051326159716, -0.08165011321851055, -0.008750792862054782, -0.030826654103326023,
      -0.039221964556779634, 0.10655822584113749}},
    {{0, 4},
     {{0, 0, -3e-7}, {0, 0, 3e-7}},
     {{2.797732516304513e-10, 81.99249699568844, 1.5174223686332005e-13},
      {1.3937382066897281, 81.43980570640758, -1.551683685219656e-05},
      {1.3913825568937488, 81.44031273173971, -1.2500889802526859e-05}},
     {-0.05536391012885042, 0.12633603882834848, -0.07098462958930059, 0.07260166966117837,
      -0.12675404989042016, 0.054139879339439284}},
    {{2, 2},
     {{150e-6, 0, 0}, {0, 0, 0}},
     {{157.82863124017376, -6.083681557139469, -0.01854989969378776},
      {160.24000618628827, -6.058040243648975, -0.02028279713276589},
      {160.238868236719, -6.057972332452664, -0.020282277220120427}},
     {-0.11468207027064851, 0.0533643631204208, 0.04103542993010728, 0.045825063893770515,
      0.04859482918950138, -0.11470217030339232}},
    {{2, 2},
     {{0, 0, 3e-7}, {0, 0, 0}},
     {{-37.60053929176996, -5.001650147157917, 0.10603979131082786},
      {-40.304818361321765, -4.828695077963516, 0.10959693288363755},
      {-40.30551076969056, -4.828665370104318, 0.10959798125006724}},
     {0.05355216524668831, -0.07448906755327384, 0.13053488355665277, 0.12321825598596428,
      -0.06542340361335695, 0.051803128877459914}},
};

typedef struct scenery {
    rig r;
    fw_force force[2];
    fw_torque torque[2];
} scenery;

static void six_bar(scenery *s, const reference *load, double share) {
    rig *r = &s->r;
    rig_six_bar(r, false);
    for (int i = 0; i < 6; i++)
        rig_strip(&r->hinge[i], E);
    for (int i = 0; i < 2; i++) {
        s->force[i] = (fw_force){.body = load->body[i],
                                 .fx_N = share * load->load[i][0],
                                 .fy_N = share * load->load[i][1]};
        s->torque[i] = (fw_torque){.body = load->body[i], .value_Nm = share * load->load[i][2]};
    }
    r->scene.force = s->force, r->scene.nforce = 2;
    r->scene.torque = s->torque, r->scene.ntorque = 2;
}

static const char *last_word(const rig *r) {
    return r->diags.count ? r->diags.item[r->diags.count - 1].message : "no message";
}

static const fw_statics *rest(rig *r, fw_hinge_model model, double accuracy) {
    const fw_statics *out = NULL;
    const fw_static_options o = {.effects = {.mode = FW_EFFECTS_AUTO, .hinge = model},
                                 .accuracy = accuracy};
    if (fw_static_equilibrium(r->arena, &r->m, &r->scene, &o, &r->diags, &out) != FW_OK)
        fail_msg("%s", last_word(r));
    return out;
}

/* hinge.md 2.5: four loads, three models, to the digits there */
static void poses(void **state) {
    (void)state;
    for (int l = 0; l < LOADS; l++)
        for (int k = 0; k < MODELS; k++) {
            scenery s;
            six_bar(&s, &loads[l], 1);
            const fw_statics *x = rest(&s.r, models[k], 0);
            const double *want = loads[l].pose[k];
            assert_int_equal(x->ledger.hinge.used, models[k]);
            assert_near((x->q[6] - s.r.body[2].x_m) * 1e6, want[0], 2e-5);
            assert_near((x->q[7] - s.r.body[2].y_m) * 1e6, want[1], 2e-5);
            assert_near(x->q[8], want[2], 1e-8);
            for (int i = 0; i < 6 && k == 2; i++)
                assert_near(x->angle_rad[i], loads[l].angle[i], 5e-9);
            fw_arena_free(s.r.arena);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(poses),
    };
    return cmocka_run_group_tests_name("hinge-models", tests, NULL, NULL);
}
