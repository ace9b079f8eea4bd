/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes that ring or shake, moved again with stiffnesses that are off: bands hold what devices at random within the errors of
   their flexures do, and decide what bands by modes leave open. */
#include "verdict/random_device.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include "test.h"

enum { DEVICES = 20, DRAWS = 4, HINGES = 6 };

typedef struct moved { /* a device, and how it moves */
    fw_mechanism_variant variant;
    const fw_mechanism *m;
    fw_dynamics_motion_options options;
    fw_verdict_strain_monitor saw;
    const fw_dynamics_motion *motion[1];
    double used; /* of the limit, by the hinge that is strained most */
} moved;

static bool move(fw_arena *arena, uint64_t seed, double by, moved *to) {
    const char *xml = device_describe(arena, seed, by);
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    assert_int_equal(
        fw_device_read(arena, "random.xml", xml, strlen(xml), NULL, 0, &diags, &device), FW_OK);
    *to = (moved){.variant = device_silicon(), .options = {.accuracy = 1e-3, .samples = 65}};
    if (fw_mechanism_build(arena, device, NULL, &to->variant, &diags, &to->m) != FW_OK)
        return false; /* it has to be drawn */
    assert_int_equal(fw_verdict_strain_monitor_new(arena, to->m, false, &to->saw), FW_OK);
    to->options.hinge_accuracy = 0.01, to->options.within_limits = true;
    fw_dynamics_motion_options o = to->options;
    fw_verdict_strain_monitor_watch(&to->saw, &o);
    const fw_device_scene *scene = to->m->device->scene;
    if (fw_statics_move_scene(arena, to->m, scene, &o, &diags, &to->motion[0]) != FW_OK)
        return false;
    to->used = 0;
    for (int k = 0; k < to->m->nhinge; k++) {
        const fw_flexure_result *c = &to->m->hinge[k].closed_form;
        to->used = fmax(to->used,
                        to->saw.hinge[k].strain.value / (c->limit_angle_rad * c->strain_per_rad));
    }
    return !to->motion[0]->ended && to->motion[0]->stats.rhs < 25000;
}

/* every hinge is open, and nothing but stiffnesses is off */
static int widened(fw_arena *arena, const moved *x, double *factor) {
    fw_verdict_variant_verdict v = {.mechanism = x->m,
                                    .motion = (const fw_dynamics_motion **)x->motion};
    double stays[2 * HINGES];
    int known = 0;
    for (int i = 0; i < 2 * x->m->nhinge; i++)
        stays[i] = 1, factor[i] = i % 2 ? 0 : 1e3;
    assert_int_equal(fw_verdict_stiffness_again(arena, x->m, 0, &x->options, 0, stays, &v, factor),
                     FW_OK);
    for (int k = 0; k < x->m->nhinge; k++)
        known += factor[2 * k] < 1e3;
    return known;
}

/* each stiffness by itself anywhere within its error, and every second time at an end of it */
static void off_at_random(const fw_mechanism *m, uint64_t *seed, bool ends, double (*off)[3]) {
    for (int k = 0; k < m->nhinge; k++) {
        const fw_flexure_error *e = &m->hinge[k].closed_form.error;
        const double most[3] = {m->hinge[k].stated ? 0 : e->stiffness, e->kx, e->ky};
        for (int i = 0; i < 3; i++) {
            const double way = device_between(seed, -1, 1);
            off[k][i] = most[i] * (ends ? (way < 0 ? -1 : 1) : way);
        }
    }
}

/* strain of each hinge over as computed; false: there is no such motion */
static bool moved_off(fw_arena *arena, const moved *x, double (*off)[3], double *times) {
    fw_mechanism other;
    fw_verdict_strain_monitor saw;
    fw_dynamics_motion_options o = x->options;
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *motion;
    assert_int_equal(fw_verdict_with_stiffness(arena, x->m, off, &other), FW_OK);
    assert_int_equal(fw_verdict_strain_monitor_new(arena, x->m, false, &saw), FW_OK);
    fw_verdict_strain_monitor_watch(&saw, &o);
    fw_statics_move_like(x->motion[0], &o);
    o.glance = fw_verdict_strain_monitor_glance;
    if (fw_statics_move_scene(arena, &other, x->m->device->scene, &o, &diags, &motion) != FW_OK)
        return false;
    for (int k = 0; k < x->m->nhinge; k++)
        times[k] = saw.hinge[k].strain.value / x->saw.hinge[k].strain.value;
    return !motion->ended;
}

static void bands_hold_devices_within_errors(void **state) {
    (void)state;
    int devices = 0, looked = 0;
    double farthest = 0;
    for (uint64_t seed = 1; devices < DEVICES; seed++) {
        fw_arena *arena = fw_arena_new(0);
        moved x;
        double factor[2 * HINGES], off[HINGES][3], times[HINGES];
        uint64_t chance = 77 * seed + 5;
        if (move(arena, seed, 0.3, &x) && x.used > 0 && move(arena, seed, 0.3 * 0.8 / x.used, &x) &&
            widened(arena, &x, factor) > 0) {
            /* what bands of hinges have of stiffnesses anyway */
            const double above = fmin(fw_verdict_motion_lasting_above(x.m), 0.029),
                         below = fmin(fw_verdict_motion_lasting_below(x.m), 0.029);
            devices++;
            for (int i = 0; i < DRAWS; i++) {
                off_at_random(x.m, &chance, i % 2, off);
                if (!moved_off(arena, &x, off, times)) continue;
                for (int k = 0; k < x.m->nhinge; k++) {
                    if (!(factor[2 * k] < 1e3)) continue;
                    const double more = factor[2 * k] + above,
                                 fewer = factor[2 * k + 1] * (1 - below);
                    if (times[k] > more || times[k] < fewer)
                        print_message("device %llu hinge %d: %.5f times, of %.5f to %.5f\n",
                                      (unsigned long long)seed, k, times[k], fewer, more);
                    assert_true(times[k] <= more && times[k] >= fewer);
                    looked++;
                    farthest = fmax(
                        farthest, fmax((times[k] - 1) / (more - 1), (1 - times[k]) / (1 - fewer)));
                }
            }
        }
        fw_arena_free(arena);
    }
    assert_true(looked > DEVICES * DRAWS);
    assert_true(farthest > 0.3); /* they are no wider than that needs */
}

/* Modes one by one bound these hinges at 98 to 125 % and 78 to 118 % of what they do as computed: both were undecided. A tenth
   less and more of their loads say that the limit is not there. Of the third one hinge is 5 % beyond its limit, which decides
   it whatever another does whose limit lies within its band */
static void what_rings_is_decided(void **state) {
    (void)state;
    static const struct {
        uint64_t seed;
        fw_verdict_decision is;
    } known[] = {{62, FW_ACCEPT}, {2, FW_ACCEPT}, {36, FW_REJECT}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_verdict v;
        const char *message;
        double by;
        assert_true(device_aimed(arena, known[i].seed, &by));
        const char *xml = device_describe(arena, known[i].seed, by);
        assert_int_equal(device_judge(arena, xml, 1e-3, &v, &message), FW_OK);
        assert_int_equal(v.decision, known[i].is);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(bands_hold_devices_within_errors),
                                       cmocka_unit_test(what_rings_is_decided)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
