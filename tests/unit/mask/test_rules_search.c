/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rules with pairs passed over, and concentric arcs in closed form, against every pair of parts:
   the same findings and measures on random layers of bars, discs, hinges and sharp corners. */
#include "mask/rule.h"
#include "scene.h"

static void bar(scene *s, uint64_t *seed, fw_geometry_vec2 at) {
    double angle = random01(seed) < 0.5 ? 0 : 6 * random01(seed);
    double l = (3 + 40 * random01(seed)) * UM, w = (2 + 12 * random01(seed)) * UM;
    fw_geometry_vec2 u = {cos(angle) * l, sin(angle) * l};
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_contour_bar(s->arena, at, vec_add(at, u), w, &c), FW_OK);
    scene_add(s, FW_ROLE_STRUCTURE, "bar", c);
}

static void disc(scene *s, uint64_t *seed, fw_geometry_vec2 at) {
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_contour_disc(s->arena, at, (1 + 12 * random01(seed)) * UM, &c),
                     FW_OK);
    scene_add(s, FW_ROLE_STRUCTURE, "disc", c);
}

/* two concentric arcs with flat or round ends */
static void bend(scene *s, uint64_t *seed, fw_geometry_vec2 c) {
    double r = (6 + 30 * random01(seed)) * UM, w = (2 + 6 * random01(seed)) * UM;
    double from = 6 * random01(seed), sweep = 0.3 + 5.4 * random01(seed);
    fw_geometry_contour out;
    if (random01(seed) < 0.5) {
        assert_int_equal(fw_geometry_contour_ring_sector(s->arena, c, r, r + w, from, sweep, &out),
                         FW_OK);
    } else {
        fw_geometry_vec2 ends[2] = {
            {c.x + (r + w / 2) * cos(from), c.y + (r + w / 2) * sin(from)},
            {c.x + (r + w / 2) * cos(from + sweep), c.y + (r + w / 2) * sin(from + sweep)}};
        fw_geometry_vec2 at = {c.x + (r + w) * cos(from), c.y + (r + w) * sin(from)};
        fw_geometry_outline o = fw_geometry_outline_start(s->arena, at);
        fw_geometry_outline_arc(&o, c, sweep, 0);
        fw_geometry_outline_arc(&o, ends[1], FW_PI, 0);
        fw_geometry_outline_arc(&o, c, -sweep, 0);
        fw_geometry_outline_arc_to(&o, ends[0], FW_PI, at, 0);
        assert_int_equal(fw_geometry_outline_close(&o, &out), FW_OK);
    }
    scene_add(s, FW_ROLE_STRUCTURE, "bend", out);
}

static void wedge(scene *s, uint64_t *seed, fw_geometry_vec2 at) {
    double p[3][2];
    for (int i = 0; i < 3; i++) {
        double angle = 2 * PI * (i + 0.6 * random01(seed)) / 3;
        p[i][0] = at.x / UM + 15 * cos(angle);
        p[i][1] = at.y / UM + 15 * sin(angle);
    }
    scene_add(s, FW_ROLE_STRUCTURE, "wedge", polygon(s->arena, (const double(*)[2])p, 3));
}

static scene *random_layer(uint64_t seed) {
    static void (*const kind[])(scene *, uint64_t *, fw_geometry_vec2) = {bar, disc, bend, wedge,
                                                                          bend};
    scene *s = scene_new(4 * UM, 4 * UM);
    double side = (random01(&seed) < 0.3 ? 1500 : 60 + 400 * random01(&seed)) * UM;
    int n = 2 + (int)(14 * random01(&seed));
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 at = {side * random01(&seed), side * random01(&seed)};
        kind[(int)(5 * random01(&seed))](s, &seed, at);
    }
    return s;
}

typedef struct answer {
    fw_mask_rule_search in;
    fw_mask_measure measure;
    fw_mask_rule_finding *found; /* (nfound) places of every kind */
    int nfound;
} answer;

static void add_places(answer *a, fw_mask_rule_kind kind) {
    fw_arena *arena = a->in.arena;
    fw_mask_rule_finding *list = fw_arena_array(arena, fw_mask_rule_finding, (size_t)a->in.nfound),
                         *place;
    int n = 0, count;
    for (int i = 0; i < a->in.nfound; i++)
        if (a->in.found[i].kind == kind) list[n++] = a->in.found[i];
    if (kind == FW_RULE_OVERLAP) { /* where they meet: all */
        place = list, count = n;
    } else {
        assert_int_equal(fw_mask_rule_places(arena, list, n, 4 * UM, &place, &count), FW_OK);
    }
    a->found = fw_arena_grow(arena, a->found, (size_t)a->nfound, (size_t)(a->nfound + count),
                             sizeof *place);
    memcpy(a->found + a->nfound, place, (size_t)count * sizeof *place);
    a->nfound += count;
}

static void ask(scene *s, bool everything, answer *a) {
    int n = s->layout.npiece;
    fw_mask_shape *shape = fw_arena_array(s->arena, fw_mask_shape, (size_t)n);
    for (int i = 0; i < n; i++)
        shape[i] = (fw_mask_shape){.piece = &s->piece[i], .contour = s->piece[i].contour};
    *a = (answer){.measure = {.width_m = HUGE_VAL, .space_m = HUGE_VAL}};
    a->in = (fw_mask_rule_search){.arena = s->arena,
                                  .limit_m = {4 * UM, 4 * UM},
                                  .shape = shape,
                                  .measure = &a->measure,
                                  .everything = everything};
    assert_int_equal(fw_mask_rule_edges(&a->in, n, 5e-9), FW_OK);
    fw_mask_rule_search_run(&a->in);
    assert_false(a->in.no_memory);
    for (int kind = 0; kind < 3; kind++)
        add_places(a, (fw_mask_rule_kind)kind);
}

static double looked_at(double least) {
    return fmin(least, FW_MASK_LOOK_M);
}

static void nothing_is_passed_over(void **state) {
    (void)state;
    int kinds[3] = {0}, clean = 0, measured = 0;
    for (uint64_t seed = 1; seed <= 80; seed++) {
        scene *s = random_layer(seed);
        answer few, all;
        ask(s, false, &few);
        ask(s, true, &all);
        if (few.nfound != all.nfound)
            fail_msg("layer %d: %d findings, %d of all pairs", (int)seed, few.nfound, all.nfound);
        for (int i = 0; i < few.nfound; i++) {
            const fw_mask_rule_finding *f = &few.found[i], *g = &all.found[i];
            kinds[f->kind]++;
            assert_int_equal(f->kind, g->kind);
            assert_int_equal(f->shape[0], g->shape[0]);
            assert_int_equal(f->shape[1], g->shape[1]);
            assert_near(f->value_m, g->value_m, 1e-15);
        }
        assert_near(looked_at(few.measure.width_m), looked_at(all.measure.width_m), 1e-15);
        assert_near(looked_at(few.measure.space_m), looked_at(all.measure.space_m), 1e-15);
        clean += few.nfound == 0;
        measured += few.measure.space_m < FW_MASK_LOOK_M;
        scene_free(s);
    }
    print_message("%d widths, %d spaces, %d overlaps; %d layers clean, %d with a space\n", kinds[0],
                  kinds[1], kinds[2], clean, measured);
    assert_true(kinds[0] > 50 && kinds[1] > 50 && kinds[2] > 50 && clean > 2 && measured > 40);
}

/* all of very many are told, not the first ones */
static void every_violation_is_told(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    for (int i = 0; i < 200; i++)
        scene_box(s, "bar", 20 * i, 0, 20 * i + 3.5, 50);
    answer a;
    ask(s, false, &a);
    assert_int_equal(a.nfound, 200);
    assert_near(a.measure.space_m, 16.5 * UM, 1e-15);
    scene_free(s);
}

/* the arc of a rounded right angle turns by 90 degrees and no more, whatever its last digits say:
   no width, though its ends are nearer than the rule; one of 100 degrees is */
static void a_rounded_corner_is_no_width(void **state) {
    (void)state;
    for (int i = 0; i < 50; i++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        double angle = 0.13 * i, lean = i % 2 ? 0 : 0.18;
        fw_geometry_vec2 u = {cos(angle), sin(angle)}, v = {-sin(angle + lean), cos(angle + lean)};
        double p[4][2];
        for (int k = 0; k < 4; k++) {
            double a = k == 1 || k == 2 ? 40 : 0, b = k >= 2 ? 30 : 0;
            p[k][0] = a * u.x + b * v.x;
            p[k][1] = a * u.y + b * v.y;
        }
        fw_geometry_contour sharp = polygon(s->arena, (const double(*)[2])p, 4), round;
        fw_geometry_vec2 where;
        assert_int_equal(fw_geometry_contour_round(s->arena, &sharp, 2.4 * UM, 0, &round, &where),
                         FW_OK);
        scene_add(s, FW_ROLE_STRUCTURE, "rounded", round);
        answer few, all;
        ask(s, false, &few);
        ask(s, true, &all);
        assert_int_equal(few.nfound, lean > 0 ? 2 : 0); /* the two sharp corners */
        assert_int_equal(all.nfound, lean > 0 ? 2 : 0);
        scene_free(s);
    }
}

/* what is written of the edges of an outline, one after the other, is its polygon and vertices that
   lie on a straight way between others */
static void what_is_written_is_the_polygon(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 200; i++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        bend(s, &seed, (fw_geometry_vec2){1e-3 * random01(&seed), -1e-3 * random01(&seed)});
        answer a;
        ask(s, false, &a);
        fw_geometry_polygon p;
        assert_int_equal(
            fw_geometry_flatten(s->arena, &s->piece[0].contour, 5e-9, FW_FLATTEN_INSIDE, &p, NULL),
            FW_OK);
        int at = 0, vertices = 0;
        for (int segment = 0; segment < a.in.nedge; segment++)
            for (int k = 0; k < a.in.nedge; k++) {
                fw_mask_rule_edge *e = &a.in.edge[k];
                if (e->segment != segment) continue;
                assert_true(fw_mask_rule_write(&a.in, e));
                for (int m = 0; m < e->nwritten; m++) {
                    fw_geometry_point v = e->written[m].a, q = p.vertex[at % p.count];
                    if (vertices == 0 || (v.x_dbu == q.x_dbu && v.y_dbu == q.y_dbu))
                        vertices++, at++;
                }
            }
        assert_int_equal(vertices, p.count);
        scene_free(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_is_passed_over),
                                       cmocka_unit_test(every_violation_is_told),
                                       cmocka_unit_test(a_rounded_corner_is_no_width),
                                       cmocka_unit_test(what_is_written_is_the_polygon)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
