/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Area, edges and moments of bodies: outline and halves of flexures, against sums over many chords;
   Steiner's formulas against a rectangle that grows. */
#include "test.h"
#include "fixture.h"
#include "geometry/segment.h"

enum { CHORDS = 4000 };

typedef struct sums { /* about the origin */
    double area, ax, ay, polar, edge, ex, ey, eq;
} sums;

/* a chord from p to q: the triangle with the origin, and the edge itself */
static void add(sums *s, fw_geometry_vec2 p, fw_geometry_vec2 q, bool is_edge) {
    double cross = p.x * q.y - p.y * q.x, l = hypot(q.x - p.x, q.y - p.y);
    double x = 0.5 * (p.x + q.x), y = 0.5 * (p.y + q.y);
    s->area += 0.5 * cross;
    s->ax += cross * (p.x + q.x) / 6;
    s->ay += cross * (p.y + q.y) / 6;
    s->polar +=
        cross * (p.x * p.x + p.x * q.x + q.x * q.x + p.y * p.y + p.y * q.y + q.y * q.y) / 12;
    if (!is_edge) return;
    s->edge += l, s->ex += l * x, s->ey += l * y;
    s->eq += l * (x * x + y * y + l * l / 12);
}

/* side_of: +1, -1: only the part on that side of the hinge's axis, whose cut closes it; 0: all */
static void add_contour(sums *s, const fw_geometry_contour *c, const fw_layout_hinge_layout *h,
                        int side_of) {
    fw_geometry_vec2 at = {0, 0}, first = {0, 0};
    bool any = false;
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *e = &c->segment[i];
        int n = e->kind == FW_ARC ? CHORDS : 1;
        for (int k = 0; k < n; k++) {
            fw_geometry_vec2 p = fw_geometry_segment_point(e, (double)k / n),
                             q = fw_geometry_segment_point(e, (k + 1.0) / n);
            if (side_of) {
                double x = 0.5 * (p.x + q.x) - h->arc_centre.x,
                       y = 0.5 * (p.y + q.y) - h->arc_centre.y;
                double side = cos(h->axis_rad) * y - sin(h->axis_rad) * x;
                if (side * side_of < 0) continue;
            }
            if (any && (at.x != p.x || at.y != p.y)) add(s, at, p, false);
            if (!any) first = p;
            add(s, p, q, !(e->flags & FW_SEGMENT_JOINT));
            any = true, at = q;
        }
    }
    if (any) add(s, at, first, false);
}

static void compare(const fw_layout_body_layout *b, const sums *s) {
    double x = s->ax / s->area, y = s->ay / s->area, square = x * x + y * y;
    assert_relative(b->area_m2, s->area, 1e-5);
    assert_near(b->centroid.x, x, 1e-9);
    assert_near(b->centroid.y, y, 1e-9);
    assert_relative(b->polar_m4, s->polar - s->area * square, 1e-5);
    assert_relative(b->perimeter_m, s->edge, 1e-5);
    assert_near(b->edge_m2.x, s->ex - x * s->edge, 1e-5 * 1e-3 * s->edge);
    assert_near(b->edge_m2.y, s->ey - y * s->edge, 1e-5 * 1e-3 * s->edge);
    assert_relative(b->edge_m3, s->eq - 2 * (x * s->ex + y * s->ey) + s->edge * square, 1e-5);
}

static void bodies_have_halves_of_their_flexures(void **state) {
    (void)state;
    void (*const make[])(fixture *) = {fixture_six_bar, fixture_four_bar, fixture_stage};
    for (size_t n = 0; n < sizeof make / sizeof make[0]; n++) {
        fixture f;
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        const fw_layout *l;
        make[n](&f);
        f.device.die.tethers = false; /* what is left of them is no part of these sums */
        assert_int_equal(fw_layout_build(arena, &f.device, &diags, &l), FW_OK);
        for (int b = 0; b < f.device.nbody; b++) {
            sums s = {0};
            int halves = 0;
            for (int i = 0; i < l->npiece; i++) {
                const fw_layout_piece *p = &l->piece[i];
                if (p->role == FW_ROLE_STRUCTURE && p->body == b)
                    add_contour(&s, &p->contour, NULL, 0);
                if (p->role != FW_ROLE_FLEXURE) continue;
                const fw_layout_hinge_layout *h = &l->hinge[p->joint];
                if (h->lower != b && h->upper != b) continue;
                add_contour(&s, &p->contour, h, h->upper == b ? 1 : -1);
                halves++;
            }
            assert_true(halves >= 2);
            compare(&l->body[b], &s);
        }
        fw_arena_free(arena);
    }
}

/* a x b, grown by e on every side, has (a + 2 e)(b + 2 e) and so on: the sums' own check of
   dI/de = Q */
static void a_rectangle_grows_as_steiner_says(void **state) {
    (void)state;
    const double a = 3, b = 2, e = 1e-5;
    const fw_geometry_vec2 at[4] = {
        {-a / 2, -b / 2}, {a / 2, -b / 2}, {a / 2, b / 2}, {-a / 2, b / 2}};
    sums s = {0};
    for (int i = 0; i < 4; i++)
        add(&s, at[i], at[(i + 1) % 4], true);
    const double A = a + 2 * e, B = b + 2 * e;
    assert_relative((A * B - a * b) / e, s.edge, 1e-4);
    assert_relative((A * B * (A * A + B * B) - a * b * (a * a + b * b)) / (12 * e), s.eq, 1e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(bodies_have_halves_of_their_flexures),
                                       cmocka_unit_test(a_rectangle_grows_as_steiner_says)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
