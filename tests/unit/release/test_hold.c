/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds a body when it lets go: narrow links before a wide one, bases at their hinges, tethers. */
#include "layout/fixture.h"
#include "release/release.h"
#include "test.h"
#include <string.h>

typedef struct held {
    fw_arena *arena;
    const fw_layout *layout;
    const fw_release *release;
    const fw_release_hold *hold;
} held;

static held find(const fw_device *device) {
    held h = {.arena = fw_arena_new(0)};
    fw_diags diags = fw_diags_new(h.arena);
    assert_int_equal(fw_layout_build(h.arena, device, &diags, &h.layout), FW_OK);
    assert_int_equal(fw_release_solve(h.arena, h.layout, false, false, 0.1, &h.release), FW_OK);
    assert_int_equal(fw_release_hold_find(h.arena, device, h.layout, h.release, &h.hold), FW_OK);
    return h;
}

static bool is_held_by(const fw_release_body_hold *b, const char *what) {
    for (int i = 0; i < b->nby; i++)
        if (strcmp(b->by[i], what) == 0) return true;
    return false;
}

static const fw_release_body_hold *of(const held *h, int body) {
    for (int i = 0; i < h->hold->nbody; i++)
        if (h->hold->body[i].body == body) return &h->hold->body[i];
    fail_msg("body %d lets go never", body);
    return NULL;
}

/* a wide coupler between a crank and a rocker: it is bonded longest, and they hang on it until then */
static void links_hang_on_what_is_bonded(void **unused) {
    (void)unused;
    fixture f;
    fixture_four_bar(&f);
    f.body[1].width_m = 160e-6;
    held h = find(&f.device);
    assert_int_equal(h.hold->nbody, 3);
    assert_int_equal(h.hold->ngroup, 1);
    assert_int_equal(h.hold->body[2].body, 1);
    for (int i = 0; i < 2; i++)
        assert_true(h.hold->body[i].free_m <= h.hold->body[i + 1].free_m);
    const fw_release_body_hold *crank = of(&h, 0), *rocker = of(&h, 2), *coupler = of(&h, 1);
    assert_true(is_held_by(crank, "link coupler") && is_held_by(crank, "base at hinge P"));
    assert_true(is_held_by(rocker, "link coupler") && is_held_by(rocker, "base at hinge S"));
    assert_int_equal(crank->holders, 2);
    /* then it hangs on both bases, through crank and rocker, and on its tether */
    assert_true(is_held_by(coupler, "base at hinge P") && is_held_by(coupler, "base at hinge S"));
    assert_true(is_held_by(coupler, "tether of link coupler"));
    assert_int_equal(coupler->holders, 3);
    const fw_release_group_hold *g = &h.hold->group[0];
    assert_string_equal(g->last_bond, "link coupler");
    assert_true(g->hangs_m == coupler->free_m);
    assert_int_equal(g->ground_hinges, 2);
    assert_int_equal(g->tethers, 1);
    assert_true(g->last_anchor_m > g->hangs_m);
    fw_arena_free(h.arena);
}

/* a paddle on one hinge, without tethers: that is its last anchor */
static void one_hinge_is_the_last_anchor(void **unused) {
    (void)unused;
    fixture f;
    fixture_paddle(&f);
    f.device.die.tethers = false;
    held h = find(&f.device);
    const fw_release_body_hold *b = of(&h, 0);
    assert_int_equal(b->holders, 1);
    assert_true(is_held_by(b, "base at hinge H"));
    assert_int_equal(h.hold->group[0].tethers, 0);
    assert_string_equal(h.hold->group[0].last_anchor, "base");
    double most = 0;
    for (int i = 0; i < h.release->npart; i++)
        if (h.release->part[i].duty == FW_RELEASE_MOVES)
            most = fmax(most, h.release->part[i].most_m);
    assert_true(h.hold->group[0].hangs_m == most);
    fw_arena_free(h.arena);
    f.device.die.tethers = true;
    h = find(&f.device);
    assert_int_equal(of(&h, 0)->holders, 1 + h.layout->ntether);
    assert_int_equal(h.hold->group[0].tethers, h.layout->ntether);
    assert_true(h.layout->ntether > 0);
    fw_arena_free(h.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(links_hang_on_what_is_bonded),
        cmocka_unit_test(one_hinge_is_the_last_anchor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
