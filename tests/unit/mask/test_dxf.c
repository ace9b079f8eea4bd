/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DXF read back by groups of two lines; arcs from end points and bulge alone. */
#include "xml/xml.h"
#include "scene.h"
#include <stdlib.h>

enum { MOST = 400 };
typedef struct line {
    char layer[40];
    int closed, n;
    double x[MOST], y[MOST], bulge[MOST]; /* um */
} line;

typedef struct drawing {
    line poly[64];
    int npoly, nlayer, colour[8], unit, comments, ended;
    char layer[8][40], version[16];
    double extent[4];
} drawing;

static const char *next_line(const char **at, char *to, size_t most) {
    size_t n = strcspn(*at, "\n");
    assert_true((*at)[n] == '\n' && n < most && n <= 256);
    memcpy(to, *at, n);
    to[n] = '\0';
    *at += n + 1;
    return to;
}

static void read_drawing(drawing *d, const fw_text *text) {
    *d = (drawing){0};
    const char *at = text->data;
    char value[300], entity[40] = "", section[40] = "", variable[40] = "", number[16];
    line *p = NULL;
    while (*at) {
        int code = atoi(next_line(&at, number, sizeof number));
        next_line(&at, value, sizeof value);
        double v = strtod(value, NULL);
        bool vertex = strcmp(entity, "VERTEX") == 0, layer = strcmp(entity, "LAYER") == 0;
        assert_false(d->ended);
        if (code == 0) {
            snprintf(entity, sizeof entity, "%.39s", value);
            assert_true(strcmp(value, "TEXT") != 0);
            if (strcmp(value, "POLYLINE") == 0) p = &d->poly[d->npoly++];
            if (strcmp(value, "VERTEX") == 0) p->n++;
            if (strcmp(value, "LAYER") == 0) d->nlayer++;
            d->ended = strcmp(value, "EOF") == 0;
        } else if (code == 999)
            d->comments++;
        else if (code == 2 && strcmp(entity, "SECTION") == 0)
            snprintf(section, sizeof section, "%.39s", value);
        else if (code == 9)
            snprintf(variable, sizeof variable, "%.39s", value);
        else if (strcmp(section, "HEADER") == 0) {
            if (strcmp(variable, "$ACADVER") == 0) snprintf(d->version, 16, "%.15s", value);
            if (strcmp(variable, "$INSUNITS") == 0) d->unit = (int)v;
            int corner = strcmp(variable, "$EXTMIN") == 0   ? 0
                         : strcmp(variable, "$EXTMAX") == 0 ? 2
                                                            : -1;
            if (corner >= 0) d->extent[corner + (code == 20)] = v;
        } else if (layer && code == 2)
            snprintf(d->layer[d->nlayer - 1], sizeof d->layer[0], "%.39s", value);
        else if (layer && code == 62)
            d->colour[d->nlayer - 1] = (int)v;
        else if (p && !vertex && code == 8 && strcmp(entity, "POLYLINE") == 0)
            snprintf(p->layer, sizeof p->layer, "%.39s", value);
        else if (p && !vertex && code == 70)
            p->closed = (int)v;
        else if (vertex && code == 8)
            assert_string_equal(value, p->layer);
        else if (vertex && (code == 10 || code == 20 || code == 42))
            (code == 10 ? p->x : code == 20 ? p->y : p->bulge)[p->n - 1] = v;
    }
    assert_true(d->ended);
}

/* area of a polyline with bulges b = tan(sweep / 4): chords, and segments r^2 (s - sin s) / 2 */
static double area(const line *p) {
    double sum = 0;
    for (int i = 0; i < p->n; i++) {
        int j = (i + 1) % p->n;
        double b = p->bulge[i], chord = hypot(p->x[j] - p->x[i], p->y[j] - p->y[i]);
        sum += 0.5 * (p->x[i] * p->y[j] - p->x[j] * p->y[i]);
        if (b == 0) continue;
        double sweep = 4 * atan(b), r = chord / (2 * sin(fabs(sweep) / 2));
        sum += 0.5 * r * r * (sweep - sin(sweep));
    }
    return sum;
}

/* the arc from two points and a bulge, at its ends and in its middle, is on the circle that was
   drawn: to 2 pm, with coordinates of 1 pm */
static void assert_arc(const line *p, int i, const fw_geometry_segment *s) {
    int j = (i + 1) % p->n;
    double dx = p->x[j] - p->x[i], dy = p->y[j] - p->y[i], b = p->bulge[i];
    double x[3] = {p->x[i], p->x[j], 0.5 * (p->x[i] + p->x[j]) + 0.5 * b * dy};
    double y[3] = {p->y[i], p->y[j], 0.5 * (p->y[i] + p->y[j]) - 0.5 * b * dx};
    assert_true((b > 0) == (s->sweep_rad > 0) && fabs(b) <= tan(PI / 6) * (1 + 1e-9));
    for (int k = 0; k < 3; k++)
        assert_near(hypot(x[k] - s->centre.x * 1e6, y[k] - s->centre.y * 1e6), s->radius * 1e6,
                    2e-6);
}

static void assert_same(const line *p, const fw_geometry_contour *c) {
    int at = 0;
    for (int k = 0; k < c->count; k++) {
        const fw_geometry_segment *s = &c->segment[k];
        double left = s->kind == FW_ARC ? fabs(s->sweep_rad) : 1;
        assert_near(p->x[at], s->a.x * 1e6, 0.6e-6);
        assert_near(p->y[at], s->a.y * 1e6, 0.6e-6);
        if (s->kind == FW_LINE) {
            assert_true(p->bulge[at++] == 0);
            continue;
        }
        while (left > 1e-9) {
            assert_arc(p, at, s);
            left -= 4 * atan(fabs(p->bulge[at++]));
        }
        assert_near(left, 0, 1e-9);
    }
    assert_int_equal(at, p->n);
}

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

static void arcs_come_back(void **state) {
    (void)state;
    uint64_t seed = 21;
    drawing *d = calloc(1, sizeof *d);
    for (int i = 0; i < 60; i++) {
        scene *s = scene_new(0, 0);
        double inner = (10 + 100 * random01(&seed)) * UM, width = (4 + 30 * random01(&seed)) * UM;
        double sweep = 0.3 + 5.6 * random01(&seed), radius = (5 + 50 * random01(&seed)) * UM;
        fw_geometry_vec2 o = {1e-3 * random01(&seed), -1e-3 * random01(&seed)};
        fw_geometry_contour ring, disc;
        assert_int_equal(fw_geometry_contour_ring_sector(s->arena, o, inner, inner + width,
                                                         6 * random01(&seed), sweep, &ring),
                         FW_OK);
        assert_int_equal(
            fw_geometry_contour_disc(s->arena, (fw_geometry_vec2){2e-3, 0}, radius, &disc), FW_OK);
        scene_add(s, FW_ROLE_FLEXURE, "ring", ring);
        scene_add(s, FW_ROLE_TEXT, "disc", disc);
        s->options.bias_m = (random01(&seed) - 0.5) * UM;
        const fw_mask *mask = built(s);
        fw_text out = fw_text_new(s->arena);
        assert_int_equal(fw_mask_write_dxf(mask, &out), FW_OK);
        read_drawing(d, &out);
        assert_int_equal(d->npoly, mask->nshape);
        for (int k = 0; k < d->npoly; k++) {
            const fw_geometry_contour *c = &mask->shape[k].contour;
            assert_int_equal(d->poly[k].closed, 1);
            assert_true(d->poly[k].n >= 3);
            assert_string_equal(d->poly[k].layer, mask->shape[k].layer ? "TEXT" : "DEVICE");
            assert_same(&d->poly[k], c);
            assert_near(area(&d->poly[k]), fw_geometry_contour_area(c) * 1e12,
                        fw_geometry_contour_perimeter(c) * 1e6 * 2e-6);
        }
        assert_near(d->extent[0], mask->box.x0 * 1e6, 1e-6);
        assert_near(d->extent[3], mask->box.y1 * 1e6, 1e-6);
        scene_free(s);
    }
    free(d);
}

static void names_and_units(void **state) {
    (void)state;
    drawing *d = calloc(1, sizeof *d);
    for (int rejected = 0; rejected < 2; rejected++) {
        scene *s = scene_new(0, 0);
        s->layer[0].name = "Al_mask-of.a name that is too long for release 12";
        s->layer[1].colour = s->layer[0].colour; /* the same colour in the table */
        scene_arch(s, 50, 8, 20);
        s->options.rejected = rejected;
        fw_text out = fw_text_new(s->arena);
        assert_int_equal(fw_mask_write_dxf(built(s), &out), FW_OK);
        read_drawing(d, &out);
        assert_string_equal(d->version, "AC1009");
        assert_int_equal(d->unit, 13);
        assert_int_equal(d->nlayer, 2); /* notes are comments */
        assert_true(d->comments > 8);
        assert_string_equal(d->layer[0], rejected ? "REJECTED_AL_MASK-OF_A_NAME_THAT"
                                                  : "AL_MASK-OF_A_NAME_THAT_IS_TOO_L");
        assert_true(d->colour[0] != d->colour[1] && d->colour[0] > 0 && d->colour[0] < 10);
        assert_int_equal(strstr(out.data, "status=REJECTED") != NULL, rejected);
        scene_free(s);
    }
    free(d);
}

static void short_memory(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    const fw_mask *mask = built(s);
    for (int lyt = 0; lyt < 2; lyt++) {
        fw_status status = FW_NOMEM;
        for (long at = 1; status != FW_OK && at < 100; at++) {
            fw_text out = fw_text_new(s->arena);
            fw_arena_fail_at(at, 1);
            status = (lyt ? fw_mask_write_lyt : fw_mask_write_dxf)(mask, &out);
            fw_arena_fail_at(0, 0);
            assert_true(status == FW_OK || status == FW_NOMEM);
        }
        assert_int_equal(status, FW_OK);
    }
    scene_free(s);
}

static const fw_xml_element *child(const fw_xml_element *e, const char *name) {
    for (const fw_xml_element *c = e->first_child; c; c = c->next)
        if (strcmp(c->name, name) == 0) return c;
    fail_msg("<%s> has no <%s>", e->name, name);
    return NULL;
}

/* the technology maps the names of the DXF layers to the numbers of GDSII */
static void technology(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_arch(s, 50, 8, 20);
    s->options.tolerance_m = 2e-9;
    s->options.rejected = true;
    fw_text out = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_lyt(built(s), &out), FW_OK);
    fw_xml_element *root = NULL;
    assert_int_equal(fw_xml_read(s->arena, "t", out.data, out.length, &s->diags, &root), FW_OK);
    assert_string_equal(root->name, "technology");
    assert_string_equal(child(root, "name")->text, "flexwright-test-flow");
    assert_string_equal(child(root, "layer-properties_file")->text, "test-flow.lyp");
    assert_string_equal(child(root, "description")->text, "REJECTED: right-reading chrome down");
    const fw_xml_element *dxf = child(child(root, "reader-options"), "dxf");
    assert_string_equal(child(dxf, "layer-map")->text,
                        "layer_map('REJECTED_DEVICE : 1/0';'REJECTED_TEXT : 2/0')");
    assert_string_equal(child(dxf, "circle-accuracy")->text, "0.002");
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arcs_come_back),
        cmocka_unit_test(names_and_units),
        cmocka_unit_test(short_memory),
        cmocka_unit_test(technology),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
