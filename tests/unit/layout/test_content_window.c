/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Thief and fill in the window of the reference six-bar: only where they are asked for, joined to
   the frame, out of everybody's way, and as much as the formulas say. */
#include "fixture.h"
#include "geometry/segment.h"
#include "layout/pattern.h"
#include "test.h"

static const double KEEP_M = 150e-6;

typedef struct made {
    fw_arena *arena;
    fixture f;
    fw_diags diags;
    const fw_layout *plain, *filled;
} made;

static fw_layout_pattern row(const char *kind, const double *value) {
    fw_layout_pattern p = {.kind = fw_layout_pattern_kind_named(kind), .id = kind};
    assert_non_null(p.kind);
    for (int i = 0; i < p.kind->nparameter; i++)
        p.value[i] = value[i];
    return p;
}

static made *make(bool fill, bool thief_too, double keep_m) {
    fw_arena *arena = fw_arena_new(0);
    made *m = fw_arena_one(arena, made);
    m->arena = arena;
    m->diags = fw_diags_new(arena);
    fixture_six_bar(&m->f);
    m->f.device.die.fill = fill;
    assert_int_equal(fw_layout_build(arena, &m->f.device, &m->diags, &m->plain), FW_OK);
    const fw_layout_pattern pattern[] = {
        row("window-fill", (double[]){80e-6, 20e-6, 0.5, keep_m}), /* the thief is drawn first */
        row("window-thief", (double[]){60e-6, keep_m})};
    fw_layout_no_room no_room;
    assert_int_equal(fw_layout_content_on_frame(arena, m->plain, pattern, thief_too ? 2 : 1, 4e-6,
                                                4e-6, &m->filled, &no_room),
                     FW_OK);
    return m;
}

static double frame_area(const fw_layout *l) {
    double sum = 0;
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].role == FW_ROLE_FRAME)
            sum += fw_geometry_contour_area(&l->piece[i].contour);
    return sum;
}

static void only_where_it_is_asked_for(void **state) {
    (void)state;
    made *m = make(false, true, KEEP_M);
    assert_ptr_equal(m->plain, m->filled);
    fw_arena_free(m->arena);
}

/* every joint of the frame is still there; all else is the frame with more on its edges */
static void frame_stays_the_frame(void **state) {
    (void)state;
    made *m = make(true, true, KEEP_M);
    assert_int_equal(m->plain->npiece, m->filled->npiece);
    for (int i = 0; i < m->plain->npiece; i++) {
        const fw_layout_piece *p = &m->plain->piece[i], *q = &m->filled->piece[i];
        if (p->role != FW_ROLE_FRAME) {
            assert_ptr_equal(p->contour.segment, q->contour.segment);
            continue;
        }
        assert_true(fw_geometry_contour_valid(&q->contour));
        int joints = 0, found = 0;
        for (int k = 0; k < p->contour.count; k++) {
            const fw_geometry_segment *s = &p->contour.segment[k];
            if (!(s->flags & FW_SEGMENT_JOINT)) continue;
            joints++;
            for (int j = 0; j < q->contour.count; j++) {
                const fw_geometry_segment *t = &q->contour.segment[j];
                found += t->flags == s->flags && vec_same(s->a, t->a) && vec_same(s->b, t->b);
            }
        }
        assert_true(joints > 0 && found == joints);
        /* thief and fill are 20 um wide at least and 20 um and more apart: no sliver anywhere */
        assert_true(fw_geometry_contour_clearance(&q->contour, true, NULL, NULL) > 19.9e-6);
        assert_true(fw_geometry_contour_clearance(&q->contour, false, NULL, NULL) > 19.9e-6);
    }
    assert_true(frame_area(m->filled) > frame_area(m->plain) + 1e-6); /* 1 mm2 and more */
    fw_arena_free(m->arena);
}

static bool was_there(const fw_layout *l, fw_geometry_vec2 at) {
    for (int i = 0; i < l->npiece; i++)
        for (int k = 0; k < l->piece[i].contour.count; k++)
            if (vec_same(l->piece[i].contour.segment[k].a, at)) return true;
    return false;
}

/* distances of what is new, by every one of its edges */
static void keeps_out(void **state) {
    (void)state;
    const double keep[] = {60e-6, KEEP_M, 400e-6};
    double area = HUGE_VAL;
    for (int n = 0; n < 3; n++) {
        made *m = make(true, true, keep[n]);
        double least = HUGE_VAL;
        const fw_layout *l = m->filled;
        for (int i = 0; i < l->npiece; i++)
            for (int k = 0; l->piece[i].role == FW_ROLE_FRAME && k < l->piece[i].contour.count;
                 k++) {
                const fw_geometry_segment *s = &l->piece[i].contour.segment[k];
                fw_geometry_box b = l->window;
                bool inside = s->a.x > b.x0 + 1e-9 && s->a.x < b.x1 - 1e-9 &&
                              s->a.y > b.y0 + 1e-9 && s->a.y < b.y1 - 1e-9;
                if (!inside || was_there(m->plain, s->a) || was_there(m->plain, s->b)) continue;
                for (int j = 0; j < l->npiece; j++) {
                    fw_layout_role role = l->piece[j].role;
                    if (role != FW_ROLE_STRUCTURE && role != FW_ROLE_FLEXURE &&
                        role != FW_ROLE_TETHER)
                        continue;
                    for (int e = 0; e < l->piece[j].contour.count; e++) {
                        fw_geometry_vec2 p, q;
                        least = fmin(least, fw_geometry_segment_distance(
                                                s, &l->piece[j].contour.segment[e], &p, &q));
                    }
                }
            }
        assert_true(least >= keep[n] - 1e-12 && least < 4 * keep[n]);
        assert_true(frame_area(m->filled) < area);
        area = frame_area(m->filled);
        fw_arena_free(m->arena);
    }
}

/* whole chains: their squares and stems have the share that is asked for. Counted from the outline:
   every square has two outer sides of its full height */
static void fill_has_its_share(void **state) {
    (void)state;
    made *m = make(true, false, KEEP_M);
    double s = 80e-6, n = 20e-6, gap = floor(fw_layout_fill_gap_m(s, n, 0.5) * 1e9 + 0.5) * 1e-9;
    int sides = 0;
    for (int i = 0; i < m->filled->npiece; i++)
        for (int k = 0;
             m->filled->piece[i].role == FW_ROLE_FRAME && k < m->filled->piece[i].contour.count;
             k++) {
            const fw_geometry_segment *e = &m->filled->piece[i].contour.segment[k];
            sides += e->kind == FW_LINE && e->a.x == e->b.x &&
                     fabs(fabs(e->b.y - e->a.y) - s) < 1e-12 && !was_there(m->plain, e->a);
        }
    assert_true(sides % 2 == 0 && sides > 400);
    double added = frame_area(m->filled) - frame_area(m->plain);
    assert_near(added, 0.5 * sides * (s * s + n * gap), 1e-15);
    assert_near((s * s + n * gap) / ((s + gap) * (s + gap)), 0.5, 1e-4);
    fw_arena_free(m->arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_where_it_is_asked_for),
        cmocka_unit_test(frame_stays_the_frame),
        cmocka_unit_test(keeps_out),
        cmocka_unit_test(fill_has_its_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
