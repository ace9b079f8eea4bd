/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A verdict never flips: random devices near their limit, judged at the default accuracy and a
   hundred times tighter. Neither may be accepted by one and rejected by the other; and, the error
   of the model left aside (it is in both bands alike), each utilisation lies in the other's
   numerical band; where the two took different models of the hinges, the bands meet.
   FW_VERDICT_FIRST and FW_VERDICT_COUNT choose others. */
#include "hard.h"
#include "verdict/random_device.h"

typedef struct tally {
    int run, inconclusive, flipped, outside, refused, climbed;
    double largest; /* difference over both numerical bands */
} tally;

/* the model of the hinges that a scene was judged with */
static fw_effects_hinge_model model_of(const fw_verdict *v, const char *scene) {
    const fw_dynamics_motion *motion = v->variant[0].motion[0]; /* there is one scene */
    return motion && strcmp(scene, "workspace") != 0 ? motion->ledger.hinge.used
                                                     : FW_HINGE_REVOLUTE;
}

static double apart(const fw_verdict_hinge_verdict *a, const fw_verdict_hinge_verdict *b) {
    return fmax(a->utilisation_low - b->utilisation_high, b->utilisation_low - a->utilisation_high);
}

static void compare(uint64_t seed, const fw_verdict *loose, const fw_verdict *tight, tally *n) {
    n->inconclusive += loose->decision == FW_INCONCLUSIVE;
    if ((loose->decision == FW_ACCEPT && tight->decision == FW_REJECT) ||
        (loose->decision == FW_REJECT && tight->decision == FW_ACCEPT)) {
        n->flipped++;
        print_message("device %llu: %s at the default, %s tighter\n", (unsigned long long)seed,
                      fw_verdict_decision_text(loose->decision),
                      fw_verdict_decision_text(tight->decision));
    }
    for (int k = 0; k < loose->nhinge; k++) {
        const fw_verdict_hinge_verdict *a = &loose->hinge[k], *b = &tight->hinge[k];
        if (!a->scene || !b->scene || strcmp(a->scene, b->scene) != 0) continue;
        if (a->utilisation > 50) continue; /* ended after a whole turn */
        double off = fabs(a->utilisation - b->utilisation);
        double room = a->numeric + b->numeric + 1e-12;
        bool alike = model_of(loose, a->scene) == model_of(tight, b->scene);
        n->climbed += !alike;
        if (alike) n->largest = fmax(n->largest, off / room);
        if (alike ? off <= room : !(apart(a, b) > 0)) continue;
        n->outside++;
        print_message("device %llu hinge %s in %s: %.9g +- %.3g (%.9g..%.9g), tighter %.9g +- %.3g "
                      "(%.9g..%.9g)%s\n",
                      (unsigned long long)seed, a->id, a->scene, a->utilisation, a->numeric,
                      a->utilisation_low, a->utilisation_high, b->utilisation, b->numeric,
                      b->utilisation_low, b->utilisation_high,
                      alike ? "" : ", another model of its hinges");
    }
}

static void one(uint64_t seed, tally *n) {
    fw_arena *arena = fw_arena_new(0);
    fw_verdict loose, tight;
    const char *message;
    double by;
    bool fine = device_aimed(arena, seed, &by);
    const char *xml = device_describe(arena, seed, by);
    if (fine && device_judge(arena, xml, 1e-3, &loose, &message) == FW_OK &&
        device_judge(arena, xml, 1e-5, &tight, &message) == FW_OK) {
        n->run++;
        compare(seed, &loose, &tight, n);
    } else {
        n->refused++;
    }
    if (getenv("FW_VERDICT_SHOW")) fputs(xml, stdout);
    fw_arena_free(arena);
}

static void a_verdict_never_flips(void **state) {
    (void)state;
    const char *from = getenv("FW_VERDICT_FIRST"), *count = getenv("FW_VERDICT_COUNT");
    uint64_t first = from ? strtoull(from, NULL, 10) : 1;
    int most = count ? atoi(count) : hard_quick() ? 20 : 300;
    tally n = {0};
    for (int i = 0; i < most; i++)
        one(first + (uint64_t)i, &n);
    print_message("%d devices: %.1f %% inconclusive, %d flips, %d outside their bands, largest "
                  "difference %.3g of both; %d hinges by other models; %d without a verdict\n",
                  n.run, 100.0 * n.inconclusive / n.run, n.flipped, n.outside, n.largest, n.climbed,
                  n.refused);
    assert_int_equal(n.flipped, 0);
    assert_int_equal(n.outside, 0);
    assert_true(n.refused <= most / 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_verdict_never_flips)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
