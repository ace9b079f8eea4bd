/* SPDX-License-Identifier: GPL-3.0-or-later */
/* STL: read back, closed, with the Euler number and the volume that they must have. */
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include "scene.h"
#include <stdlib.h>
#include <string.h>

typedef struct point {
    double x, y, z;
} point;
typedef struct edge {
    int a, b;
} edge;
typedef struct mesh {
    point *at; /* (npoint), each once */
    int npoint;
    int (*face)[3];
    int nface;
} mesh;

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

static double number_at(const unsigned char *at) {
    uint32_t v = at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    float f;
    memcpy(&f, &v, sizeof f);
    return (double)f;
}

static int point_order(const void *left, const void *right) {
    return memcmp(left, right, sizeof(point)); /* any fixed order */
}

static mesh read_stl(fw_arena *arena, const fw_text *text) {
    const unsigned char *data = (const unsigned char *)text->data;
    assert_true(text->length > 84 && memcmp(data, "solid", 5) != 0);
    int n = (int)(data[80] | data[81] << 8 | data[82] << 16);
    assert_true(text->length == 84 + 50 * (size_t)n);
    mesh m = {fw_arena_array(arena, point, 3 * (size_t)n), 0,
              fw_arena_alloc(arena, (size_t)n, sizeof(int[3])), n};
    point *corner = fw_arena_array(arena, point, 3 * (size_t)n);
    for (int i = 0; i < 3 * n; i++) {
        const unsigned char *at = data + 84 + 50 * (i / 3) + 12 + 12 * (i % 3);
        corner[i] = (point){number_at(at) + 0.0, number_at(at + 4) + 0.0, number_at(at + 8) + 0.0};
    }
    memcpy(m.at, corner, 3 * (size_t)n * sizeof *corner);
    qsort(m.at, 3 * (size_t)n, sizeof *m.at, point_order);
    for (int i = 0; i < 3 * n; i++)
        if (i == 0 || point_order(&m.at[m.npoint - 1], &m.at[i]) != 0) m.at[m.npoint++] = m.at[i];
    for (int i = 0; i < 3 * n; i++) {
        point *found = bsearch(&corner[i], m.at, (size_t)m.npoint, sizeof *m.at, point_order);
        m.face[i / 3][i % 3] = (int)(found - m.at);
    }
    for (int i = 0; i < n; i++) { /* normals are those of the corners */
        point a = corner[3 * i], b = corner[3 * i + 1], c = corner[3 * i + 2];
        const unsigned char *at = data + 84 + 50 * i;
        point u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
        double x = u.y * v.z - u.z * v.y, y = u.z * v.x - u.x * v.z, z = u.x * v.y - u.y * v.x;
        double along = x * number_at(at) + y * number_at(at + 4) + z * number_at(at + 8);
        assert_true(along > 0.999 * sqrt(x * x + y * y + z * z));
    }
    return m;
}

static int edge_order(const void *left, const void *right) {
    const edge *p = left, *q = right;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return (p->b > q->b) - (p->b < q->b);
}

static int root(int *above, int i) {
    while (above[i] != i)
        i = above[i] = above[above[i]];
    return i;
}

/* every edge once each way; V - E + F = 2 for each of `shells` */
static void assert_closed(fw_arena *arena, const mesh *m, int shells) {
    int n = 3 * m->nface, used = 0, found = 0;
    edge *e = fw_arena_array(arena, edge, (size_t)n);
    int *above = fw_arena_array(arena, int, (size_t)m->npoint);
    for (int i = 0; i < m->npoint; i++)
        above[i] = i;
    for (int i = 0; i < n; i++) {
        e[i] = (edge){m->face[i / 3][i % 3], m->face[i / 3][(i + 1) % 3]};
        above[root(above, e[i].a)] = root(above, e[i].b);
    }
    qsort(e, (size_t)n, sizeof *e, edge_order);
    for (int i = 0; i < n; i++) {
        edge back = {e[i].b, e[i].a};
        assert_true(e[i].a != e[i].b && (i == 0 || edge_order(&e[i - 1], &e[i]) != 0));
        assert_non_null(bsearch(&back, e, (size_t)n, sizeof *e, edge_order));
        used += i == 0 || e[i].a != e[i - 1].a;
    }
    for (int i = 0; i < m->npoint; i++)
        found += above[i] == i;
    assert_int_equal(used, m->npoint);
    assert_int_equal(found, shells);
    assert_int_equal(m->npoint - n / 2 + m->nface, 2 * shells);
}

static double volume(const mesh *m) {
    double sum = 0;
    for (int i = 0; i < m->nface; i++) {
        point a = m->at[m->face[i][0]], b = m->at[m->face[i][1]], c = m->at[m->face[i][2]];
        sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
               a.z * (b.x * c.y - b.y * c.x);
    }
    return sum / 6;
}

static int times(const char *text, const char *word) {
    int n = 0;
    for (const char *at = text; (at = strstr(at, word)) != NULL; at += strlen(word))
        n++;
    return n;
}

/* STEP: so many solids, and every edge in two faces, once in each direction */
static void check_step(scene *s, const fw_mask *mask, int shells) {
    fw_text step = fw_text_new(s->arena), again = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_step(mask, &step), FW_OK);
    assert_int_equal(fw_mask_write_step(mask, &again), FW_OK);
    assert_string_equal(step.data, again.data);
    assert_int_equal(times(step.data, "=MANIFOLD_SOLID_BREP("), shells);
    assert_int_equal(times(step.data, "=CLOSED_SHELL("), shells);
    int most = times(step.data, "\n#") + 2;
    int *used = fw_arena_array(s->arena, int, 2 * (size_t)most);
    for (const char *at = step.data; (at = strstr(at, "=ORIENTED_EDGE(")) != NULL; at++) {
        const char *of = strchr(at, '#');
        long id = strtol(of + 1, NULL, 10);
        const char *sense = strchr(of, '.');
        assert_true(id > 0 && id < most);
        used[2 * id + (sense[1] == 'T')]++;
    }
    for (const char *at = step.data; (at = strstr(at, "=EDGE_CURVE(")) != NULL; at++) {
        const char *begin = at;
        while (*begin != '#')
            begin--;
        long id = strtol(begin + 1, NULL, 10);
        assert_int_equal(used[2 * id], 1);
        assert_int_equal(used[2 * id + 1], 1);
    }
    /* Euler: vertices - edges + faces = 2 for a solid without holes, less with them; never more */
    int euler = times(step.data, "=VERTEX_POINT(") - times(step.data, "=EDGE_CURVE(") +
                times(step.data, "=ADVANCED_FACE(") - times(step.data, "=FACE_BOUND(");
    assert_true(euler <= 2 * shells && euler % 2 == 0);
}

static void check(scene *s, const fw_mask *mask, int shells) {
    double want = mask->measure[0].polygon_area_m2 * 1e12 * s->options.thickness_m * 1e6;
    fw_text stl = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_stl(mask, &stl), FW_OK);
    mesh a = read_stl(s->arena, &stl);
    assert_closed(s->arena, &a, shells);
    assert_relative(volume(&a), want, 1e-6); /* floats */
    check_step(s, mask, shells);
}

/* ring and legs become one solid, without walls at the joints; a plate beside it another */
static void pieces_become_one_solid(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_arch(s, 50, 8, 20);
    s->options.thickness_m = 16 * UM;
    check(s, built(s), 1);
    scene_free(s);
    s = scene_new(0, 0);
    scene_arch(s, 50, 8, 20);
    scene_box(s, "plate", 200, 0, 260, 30);
    s->options.bias_m = 0.7 * UM;
    s->options.thickness_m = 25 * UM;
    check(s, built(s), 2);
    scene_free(s);
}

/* so do the parts of an outline that was cut */
static void cut_outlines_stay_one(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    fw_geometry_contour ring;
    assert_int_equal(fw_geometry_contour_ring_sector(s->arena, (fw_geometry_vec2){1e-4, -3e-4},
                                                     200 * UM, 240 * UM, 1, 5, &ring),
                     FW_OK);
    scene_add(s, FW_ROLE_STRUCTURE, "ring", ring);
    s->options.thickness_m = 10 * UM;
    s->options.vertex_limit = 60;
    const fw_mask *mask = built(s);
    assert_true(mask->shape[0].npart > 5);
    check(s, mask, 1);
    scene_free(s);
}

static void half_ring(scene *s, const char *label, double sign) {
    const double inner = sign * 40 * UM, outer = sign * 60 * UM;
    const fw_geometry_vec2 corner[4] = {{inner, 0}, {outer, 0}, {-outer, 0}, {-inner, 0}};
    scene_add(s, FW_ROLE_STRUCTURE, label, scene_half_ring(s->arena, corner));
}

/* as a frame around the device is: two halves that share their cuts make one solid, and what is within them is a hole in its faces */
static void a_hole_stays_a_hole(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    half_ring(s, "upper half", 1);
    half_ring(s, "lower half", -1);
    scene_box(s, "island", -10, -10, 10, 10);
    s->options.thickness_m = 16 * UM;
    const fw_mask *mask = built(s);
    check_step(s, mask, 2);
    fw_text step = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_step(mask, &step), FW_OK);
    assert_int_equal(times(step.data, "=FACE_BOUND("), 2); /* above and below */
    scene_free(s);
}

/* only what the process makes of the device: letters are not drawn up */
static void other_layers_are_left_out(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_box(s, "plate", 0, 0, 60, 30);
    const double p[4][2] = {{10, 50}, {20, 50}, {20, 60}, {10, 60}};
    scene_add(s, FW_ROLE_TEXT, "letter", polygon(s->arena, p, 4));
    s->options.thickness_m = 10 * UM;
    check(s, built(s), 1);
    scene_free(s);
}

static void short_memory(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_arch(s, 50, 8, 20);
    const fw_mask *mask = built(s);
    for (long n = 1; n < 200; n++) {
        fw_text out = fw_text_new(s->arena);
        fw_arena_fail_at(n, 1);
        fw_status status = fw_mask_write_stl(mask, &out);
        long count = fw_arena_count();
        fw_arena_fail_at(0, 0);
        if (count < n) {
            assert_int_equal(status, FW_OK);
            break;
        }
        assert_int_equal(status, FW_NOMEM);
    }
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_become_one_solid),
        cmocka_unit_test(cut_outlines_stay_one),
        cmocka_unit_test(a_hole_stays_a_hole),
        cmocka_unit_test(other_layers_are_left_out),
        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
