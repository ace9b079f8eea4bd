/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Width and space as they are written, against every pair of edges of the polygons, in whole numbers
   and a few lines: the same values are found, at tolerances from 0.4 to 1000 nm, in both ways of
   flattening, with limits just above and just below what is there. */
#include "mask/rule.h"
#include "scene.h"
#include "test.h"

enum { KINDS = 2, MOST = 20000 };

/* a bar with round ends, a hook of two arcs, a disc, a wedge, a box on the grid */
static void shape(scene *s, uint64_t *seed) {
    double x = 80 * random01(seed), y = 80 * random01(seed), turn = 6.3 * random01(seed);
    fw_geometry_vec2 at = {x * UM, y * UM};
    fw_geometry_contour c, moved;
    fw_geometry_pose pose = {at.x, at.y, turn};
    switch ((int)(5 * random01(seed))) {
    case 0:
        assert_int_equal(
            fw_geometry_contour_disc(s->arena, at, (1.5 + 10 * random01(seed)) * UM, &c), FW_OK);
        scene_add(s, FW_ROLE_STRUCTURE, "disc", c);
        return;
    case 1:
        scene_box(s, "box", round(x), round(y), round(x) + 2 + 10 * random01(seed), round(y) + 9);
        return;
    case 2: {
        const double p[3][2] = {{0, 0}, {12, -6 * random01(seed)}, {9, 3 + 9 * random01(seed)}};
        c = polygon(s->arena, p, 3);
        break;
    }
    default: {
        double r = (4 + 25 * random01(seed)) * UM, w = (2 + 5 * random01(seed)) * UM;
        double sweep = 0.3 + 4 * random01(seed), m = r + w / 2;
        fw_geometry_vec2 o = {0, 0}, from = {m, 0}, to = {m * cos(sweep), m * sin(sweep)};
        fw_geometry_outline l = fw_geometry_outline_start(s->arena, (fw_geometry_vec2){r + w, 0});
        fw_geometry_outline_arc(&l, o, sweep, 0);
        fw_geometry_outline_arc(&l, to, FW_PI, 0);
        fw_geometry_outline_arc(&l, o, -sweep, 0);
        fw_geometry_outline_arc_to(&l, from, FW_PI, (fw_geometry_vec2){r + w, 0}, 0);
        assert_int_equal(fw_geometry_outline_close(&l, &c), FW_OK);
    }
    }
    assert_int_equal(fw_geometry_contour_transform(s->arena, &c, pose, false, &moved), FW_OK);
    scene_add(s, FW_ROLE_FLEXURE, "part", moved);
}

/* ---- every pair ---- */

typedef struct side {
    double x[2], y[2]; /* nm */
} side;

static double over(const side *e, double x, double y) { /* left of it: > 0; exact here */
    return (e->x[1] - e->x[0]) * (y - e->y[0]) - (e->y[1] - e->y[0]) * (x - e->x[0]);
}

static double near(const side *e, double x, double y) {
    double dx = e->x[1] - e->x[0], dy = e->y[1] - e->y[0];
    double t = ((x - e->x[0]) * dx + (y - e->y[0]) * dy) / (dx * dx + dy * dy);
    t = fmax(0, fmin(1, t));
    return hypot(x - e->x[0] - t * dx, y - e->y[0] - t * dy);
}

/* what of e is on that side of f; false: nothing */
static bool cut(side *e, const side *f, double sign) {
    double a = sign * over(f, e->x[0], e->y[0]), b = sign * over(f, e->x[1], e->y[1]);
    if (a <= 0 && b <= 0) return false;
    double x = e->x[0] + a / (a - b) * (e->x[1] - e->x[0]),
           y = e->y[0] + a / (a - b) * (e->y[1] - e->y[0]);
    if (a < 0) e->x[0] = x, e->y[0] = y;
    if (b < 0) e->x[1] = x, e->y[1] = y;
    return true;
}

static double apart(const side *e, const side *f) {
    return fmin(fmin(near(e, f->x[0], f->y[0]), near(e, f->x[1], f->y[1])),
                fmin(near(f, e->x[0], e->y[0]), near(f, e->x[1], e->y[1])));
}

static double value_of(const side *e, const side *f, int kind) {
    double sign = kind == FW_RULE_WIDTH ? 1 : -1;
    side p = *e, q = *f;
    double dot =
        (e->x[1] - e->x[0]) * (f->x[1] - f->x[0]) + (e->y[1] - e->y[0]) * (f->y[1] - f->y[0]);
    if (dot >= 0 || !cut(&p, f, sign) || !cut(&q, e, sign)) return HUGE_VAL;
    return fmax(apart(&p, f), apart(e, &q));
}

static int sides_of(const fw_mask_shape *shape, int n, side *list) {
    int count = 0;
    for (int k = 0; k < n; k++)
        for (int i = 0; i < shape[k].polygon.count; i++) {
            fw_geometry_point a = shape[k].polygon.vertex[i],
                              b = shape[k].polygon.vertex[(i + 1) % shape[k].polygon.count];
            list[count++] = (side){{a.x_dbu, b.x_dbu}, {a.y_dbu, b.y_dbu}};
            assert_true(count < MOST);
        }
    return count;
}

/* ---- the search ---- */

typedef struct written {
    fw_mask_rule_search in;
    fw_mask_measure measure;
} written;

static void search(scene *s, fw_mask_shape *shape, double tolerance_m, double limit_m, written *w) {
    *w = (written){.measure = {.width_m = HUGE_VAL, .space_m = HUGE_VAL}};
    w->in = (fw_mask_rule_search){
        .arena = s->arena, .limit_m = {limit_m, limit_m}, .shape = shape, .measure = &w->measure};
    assert_int_equal(fw_mask_rule_edges(&w->in, s->layout.npiece, tolerance_m), FW_OK);
    fw_mask_rule_search_run(&w->in);
    assert_false(w->in.no_memory);
}

static double least_found(const written *w, int kind) {
    double least = HUGE_VAL;
    for (int i = 0; i < w->in.nfound; i++)
        if ((int)w->in.found[i].kind == kind) least = fmin(least, w->in.found[i].value_m);
    return least;
}

/* every value of one list is in the other, to 1e-6 nm */
static int same(const double *value, int n, const written *w, int kind, uint64_t seed) {
    int found = 0;
    for (int i = 0; i < n; i++) {
        bool there = false;
        for (int k = 0; k < w->in.nfound && !there; k++)
            there = (int)w->in.found[k].kind == kind &&
                    fabs(w->in.found[k].value_m * 1e9 - value[i]) < 1e-6;
        if (!there) fail_msg("layer %d: %.9g nm is not found", (int)seed, value[i]);
        found++;
    }
    for (int k = 0; k < w->in.nfound; k++) {
        bool there = (int)w->in.found[k].kind != kind;
        for (int i = 0; i < n && !there; i++)
            there = fabs(w->in.found[k].value_m * 1e9 - value[i]) < 1e-6;
        if (!there)
            fail_msg("layer %d: %.9g nm is not there", (int)seed, w->in.found[k].value_m * 1e9);
    }
    return found;
}

static void one_layer(uint64_t seed, int count[KINDS], int edge[KINDS]) {
    static const double tolerance_nm[] = {0.4, 1.42, 5, 20, 100, 300, 1000};
    static side list[MOST];
    static double value[MOST];
    scene *s = scene_new(0, 0);
    uint64_t more = seed;
    int n = 2 + (int)(5 * random01(&more));
    for (int i = 0; i < n; i++)
        shape(s, &more);
    double tolerance_m = tolerance_nm[seed % 7] * 1e-9;
    fw_mask_shape *all = fw_arena_array(s->arena, fw_mask_shape, (size_t)n);
    bool flat = true;
    for (int i = 0; i < n; i++) {
        fw_mask_wavy_arc wavy;
        fw_geometry_polygon_report report;
        all[i] = (fw_mask_shape){.piece = &s->piece[i], .contour = s->piece[i].contour};
        all[i].flattening = seed % 2 ? FW_FLATTEN_EQUAL_AREA : FW_FLATTEN_INSIDE;
        flat = flat && fw_mask_flatten(s->arena, &all[i], tolerance_m, &wavy) == FW_OK &&
               fw_geometry_polygon_check(s->arena, &all[i].polygon, &report) == FW_OK &&
               report.simple;
    }
    int sides = flat ? sides_of(all, n, list) : 0;
    for (int kind = 0; kind < KINDS && flat; kind++) {
        double least = HUGE_VAL;
        int few = 0;
        for (int i = 0; i < sides; i++)
            for (int j = i + 1; j < sides; j++) {
                double v = value_of(&list[i], &list[j], kind);
                if (v > 1) least = fmin(least, v);
                if (v < 6000 - 1e-6 && few < MOST) value[few++] = v;
            }
        written w;
        search(s, all, tolerance_m, 6e-6, &w);
        count[kind] += few < MOST ? same(value, few, &w, kind, seed) : 0;
        if (!(least < 20000)) continue;
        for (int above = 0; above < 2; above++) { /* by a hundredth of a nanometre */
            search(s, all, tolerance_m, (least + (above ? 0.01 : -0.01)) * 1e-9, &w);
            double found = least_found(&w, kind) * 1e9;
            if (above && !(found <= least + 1e-6))
                fail_msg("layer %d: %.9g nm, found %.9g", (int)seed, least, found);
            if (!above && found > 1 && found < least - 1e-6)
                fail_msg("layer %d: %.9g nm, but found %.9g", (int)seed, least, found);
            edge[kind] += above;
        }
    }
    scene_free(s);
}

static void every_pair_of_written_edges(void **state) {
    (void)state;
    int count[KINDS] = {0}, edge[KINDS] = {0};
    const int cases = test_fewest(test_cases(70, 21), 7); /* seven tolerances */
    for (int seed = 1; seed <= cases; seed++)
        one_layer((uint64_t)seed, count, edge);
    print_message("%d widths, %d spaces; at the limit %d and %d times\n", count[0], count[1],
                  edge[0], edge[1]);
    assert_true(count[0] > 100 * cases && count[1] > 30 * cases);
    assert_true(3 * edge[0] > 2 * cases && 2 * edge[1] > cases);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_pair_of_written_edges)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
