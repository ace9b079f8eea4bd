/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Design rules on single cases: shapes of one layer in, across and outside of another, windows that
   cut outlines, many findings at once, and outputs of findings. */
#include "mask/rule.h"
#include "rule_field.h"

/* what lies in, across or outside of another layer: one finding with the value 0 */
static void nothing_between_layers(void **state) {
    (void)state;
    const struct {
        fw_layout_role role;
        double x0, y0, x1, y1;
        const fw_mask_rule_kind_row *kind; /* NULL: fine */
    } box[] = {
        {FW_ROLE_TEXT, 10, 10, 30, 30, NULL},
        {FW_ROLE_TEXT, 200, 10, 230, 30, &fw_mask_kind_enclosure},
        {FW_ROLE_TEXT, 80, 10, 130, 30, &fw_mask_kind_enclosure},
        {FW_ROLE_TEXT, 100, 10, 130, 30, &fw_mask_kind_enclosure},
        {FW_ROLE_TEXT, -10, -10, 130, 130, &fw_mask_kind_enclosure},
        {FW_ROLE_MARK, 200, 10, 230, 30, NULL},
        {FW_ROLE_MARK, 20, 10, 30, 30, &fw_mask_kind_separation},
        {FW_ROLE_MARK, -20, -10, 130, 130, &fw_mask_kind_separation},
        {FW_ROLE_MARK, 80, 10, 130, 30, &fw_mask_kind_separation},
    };
    for (size_t i = 0; i < sizeof box / sizeof box[0]; i++) {
        field *f = field_new(i);
        f->pose = (fw_geometry_pose){3 * UM, 4 * UM, 0.1 * (double)i};
        f->label = "around";
        draw_box(f, FW_ROLE_FRAME, 0, 0, 100, 100);
        f->label = "box";
        draw_box(f, box[i].role, box[i].x0, box[i].y0, box[i].x1, box[i].y1);
        const fw_mask *mask = examine(f->s);
        assert_int_equal(mask->nfinding, box[i].kind != NULL);
        if (box[i].kind) {
            assert_ptr_equal(mask->finding[0].rule->kind, box[i].kind);
            assert_true(mask->finding[0].value == 0);
            assert_string_equal(mask->finding[0].label[0], "box");
            /* two outlines and an edge of each, or one alone */
            assert_true((mask->finding[0].label[1] == NULL) == (mask->finding[0].edge[1] == -1));
            assert_true(mask->finding[0].edge[0] >= 0);
            if (i == 1) assert_null(mask->finding[0].label[1]);
        }
        scene_free(f->s);
    }
}

/* a disc and a bar cut by the lines between windows: segments of a circle, and trapezia */
static void windows_cut_outlines(void **state) {
    (void)state;
    for (int i = 0; i < 40; i++) {
        field *f = field_new(300 + (uint64_t)i);
        f->rule[0] = window_rule();
        f->s->table.nrule = 1;
        f->rule[0].least = 0.9999; /* every window is told, and all are one place: the emptiest */
        f->rule[0].most = 1;
        f->rule[0].step_m = 100 * UM;
        double r = between(f, 5, 45), d = between(f, -0.99, 0.99) * r, x = 100 - d, y = 50;
        f->label = "disc";
        draw_box(f, FW_ROLE_FRAME, 0, 0, 200, 100);
        draw_disc(f, FW_ROLE_DICING, x, y, r);
        /* the part on either side of the line x = 100 um, d from the middle of the disc */
        double right = r * r * acos(d / r) - d * sqrt(r * r - d * d), left = PI * r * r - right;
        const fw_mask *mask = examine(f->s);
        assert_int_equal(mask->nfinding, 1);
        assert_near(mask->finding[0].value, fmin(left, right) / 1e4, 1e-12);
        assert_near(mask->finding[0].box.x1 - mask->finding[0].box.x0, 200 * UM, 1e-15);
        scene_free(f->s);
        f = field_new(300 + (uint64_t)i);
        f->rule[0] = window_rule();
        f->s->table.nrule = 1;
        f->rule[0].least = 0.9999;
        f->rule[0].most = 1;
        f->label = "bar";
        draw_box(f, FW_ROLE_FRAME, 0, 0, 200, 100);
        double low = between(f, 5, 50), high = between(f, 5, 50), wide = between(f, 5, 40);
        const double p[4][2] = {{50, low}, {150, high}, {150, high + wide}, {50, low + wide}};
        draw_polygon(f, FW_ROLE_DICING, p, 4);
        mask = examine(f->s);
        assert_near(mask->finding[0].value, 50 * wide / 1e4, 1e-12);
        scene_free(f->s);
    }
}

/* more than are named one by one: all are findings, and the rest is counted */
static void all_are_findings(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    for (int i = 0; i < 150; i++)
        scene_box(s, "bar", 20 * i, 0, 20 * i + 3.5 - 1e-3 * i, 50);
    const fw_mask *mask = examine(s);
    assert_int_equal(mask->nfinding, 150);
    assert_int_equal(mask->nbroken, 150);
    assert_true(mask->rejected);
    assert_int_equal(s->diags.count, 5);
    assert_says(s->diags.item[0].message, "width of 3.351 um");
    assert_says(scene_first(s, 159), "146 more place(s)");
    const fw_mask *none = mask;
    assert_int_equal(fw_mask_build(s->arena, &s->layout, &s->table, "test device", &s->options,
                                   &s->diags, &none),
                     FW_INPUT);
    assert_null(none);
    scene_free(s);
}

/* Bars that cross off the grid: no space of 1e-17 um is told of them, but that they cross, and the value is 0 at once. */
static void what_crosses_has_no_space(void **state) {
    (void)state;
    for (int turn = 1; turn < 40; turn++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        const double c = cos(0.07 * turn), d = sin(0.07 * turn),
                     p[4][2] = {{25 + 40 * c, 5 + 40 * d},
                                {25 - 6 * d + 40 * c, 5 + 6 * c + 40 * d},
                                {25 - 6 * d - 40 * c, 5 + 6 * c - 40 * d},
                                {25 - 40 * c, 5 - 40 * d}};
        scene_box(s, "bar", 0, 0, 51, 10);
        scene_add(s, FW_ROLE_STRUCTURE, "beam", polygon(s->arena, p, 4));
        const fw_mask *mask = examine(s);
        int crossing = 0;
        for (int i = 0; i < mask->nfinding; i++) {
            const fw_mask_finding *f = &mask->finding[i];
            if (strcmp(f->label[0], f->label[1]) == 0 || strcmp(f->what, "space") != 0) continue;
            if (f->value == 0) crossing++;
            assert_true(f->value == 0 || f->value > 1e-9); /* what nearly touches is on the grid */
        }
        assert_true(crossing > 0);
        bool told = false;
        for (size_t i = 0; i < s->diags.count; i++) {
            const char *said = s->diags.item[i].message;
            told = told || (strstr(said, "bar") && strstr(said, "outlines cross or touch at"));
            assert_null(strstr(said, "space of 0 um"));
            if (strstr(said, "e-1")) fail_msg("%s", said);
        }
        assert_true(told);
        scene_free(s);
    }
}

/* one comb, many notches: each is a place of its own, though all are of one shape */
static void notches_of_one_shape(void **state) {
    (void)state;
    enum { TEETH = 20 };
    double p[4 * TEETH][2];
    int n = 0;
    for (int i = 0; i < TEETH; i++) {
        double x = 13 * i;
        p[n][0] = x, p[n++][1] = 20;
        p[n][0] = x, p[n++][1] = 60;
        p[n][0] = x + 10, p[n++][1] = 60;
        p[n][0] = x + 10, p[n++][1] = 20;
    }
    p[0][1] = 0, p[n - 1][1] = 0;
    double q[4 * TEETH][2]; /* counter-clockwise */
    for (int i = 0; i < n; i++)
        q[i][0] = p[n - 1 - i][0], q[i][1] = p[n - 1 - i][1];
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_add(s, FW_ROLE_STRUCTURE, "comb", polygon(s->arena, (const double(*)[2])q, n));
    const fw_mask *mask = examine(s);
    assert_int_equal(mask->nfinding, TEETH - 1);
    for (int i = 0; i < mask->nfinding; i++)
        assert_near(mask->finding[i].value, 3 * UM, 1e-15);
    scene_free(s);
}

/* two prongs of one piece before one edge: two places, however long the edge */
static void two_places_of_one_pair(void **state) {
    (void)state;
    const double p[8][2] = {{0, 40},  {0, 3},    {10, 3},   {10, 20},
                            {30, 20}, {30, 3.5}, {40, 3.5}, {40, 40}};
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_box(s, "bar", -10, -10, 60, 0);
    scene_add(s, FW_ROLE_STRUCTURE, "prongs", polygon(s->arena, p, 8));
    const fw_mask *mask = examine(s);
    assert_int_equal(mask->nfinding, 2);
    assert_near(fmin(mask->finding[0].value, mask->finding[1].value), 3 * UM, 1e-15);
    assert_near(fmax(mask->finding[0].value, mask->finding[1].value), 3.5 * UM, 1e-15);
    scene_free(s);
}

/* of a pair that which is drawn first is named first, whichever lies to the left */
static void first_drawn_first_named(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        scene_box(s, "first", 20 * i, 0, 20 * i + 18, 50);
        scene_box(s, "second", 20 * (1 - i), 0, 20 * (1 - i) + 18, 50);
        const fw_mask *mask = examine(s);
        assert_int_equal(mask->nfinding, 1);
        assert_string_equal(mask->finding[0].label[0], "first");
        assert_string_equal(mask->finding[0].label[1], "second");
        scene_free(s);
    }
}

/* a row for what the layer says as well is judged once, as the row says it */
static void row_and_layer_are_one(void **state) {
    (void)state;
    field *f = field_new(9);
    f->layer[FW_ROLE_STRUCTURE].min_width_m = 4 * UM;
    f->label = "bar";
    draw_box(f, FW_ROLE_STRUCTURE, 0, 0, 50, 3);
    const fw_mask *mask = examine(f->s);
    assert_int_equal(mask->nfinding, 1);
    assert_string_equal(mask->finding[0].rule->source, "test rule");
    f->rule[0].severity = FW_WARNING; /* now they are two */
    mask = examine(f->s);
    assert_int_equal(mask->nfinding, 2);
    assert_int_equal(mask->nbroken, 1);
    scene_free(f->s);
}

/* a warning does not stop the mask */
static void warnings_let_pass(void **state) {
    (void)state;
    field *f = field_new(9);
    for (int i = 0; i < f->s->table.nrule; i++)
        f->rule[i].severity = FW_WARNING;
    f->label = "bar";
    draw_box(f, FW_ROLE_STRUCTURE, 0, 0, 50, 3);
    const fw_mask *mask = examine(f->s);
    assert_int_equal(mask->nfinding, 1);
    assert_int_equal(mask->nbroken, 0);
    assert_false(mask->rejected);
    scene_free(f->s);
}

/* a field with one finding of every kind that a bar, a disc and a letter can break */
static field *broken_field(void) {
    field *f = field_new(5);
    f->label = "a < b & 'c'";
    draw_box(f, FW_ROLE_STRUCTURE, 0, 0, 50, 3);
    draw_disc(f, FW_ROLE_FRAME, 200, 0, 5);
    draw_box(f, FW_ROLE_TEXT, 400, 0, 420, 10);
    return f;
}

static int count_of(const char *text, const char *part) {
    int n = 0;
    for (const char *s = strstr(text, part); s; s = strstr(s + 1, part))
        n++;
    return n;
}

/* list and database have an entry for each finding, and foreign text in them breaks nothing */
static void findings_are_written(void **state) {
    (void)state;
    field *f = broken_field();
    const fw_mask *mask = examine(f->s), *marked;
    assert_int_equal(mask->nfinding, 3);
    fw_text json = fw_text_new(f->s->arena), lyrdb = fw_text_new(f->s->arena);
    assert_int_equal(fw_mask_write_findings(mask, &json), FW_OK);
    assert_int_equal(count_of(json.data, "\"rule\": "), 3);
    assert_says(json.data, "\"errors\": 3, \"warnings\": 0");
    assert_says(json.data, "\"value\": 3, \"limit\": 4, \"needed\": 4, \"unit\": \"um\"");
    assert_says(json.data, "\"pieces\": [\"a < b & 'c'\"");
    assert_int_equal(fw_mask_write_lyrdb(mask, &lyrdb), FW_OK);
    assert_int_equal(count_of(lyrdb.data, "<item>"), 3);
    assert_int_equal(count_of(lyrdb.data, "<category>\n"), 3);
    assert_says(lyrdb.data, "piece: a &lt; b &amp; \\'c\\''");
    assert_int_equal(fw_mask_marked(f->s->arena, mask, &marked), FW_OK);
    assert_int_equal(marked->nshape, mask->nshape + 3);
    assert_int_equal(marked->table->nlayer, mask->table->nlayer + 3);
    for (int i = 0; i < 3; i++) {
        const fw_mask_finding *g = &mask->finding[i];
        const fw_mask_shape *s = &marked->shape[mask->nshape + i];
        assert_int_equal(marked->table->layer[s->layer].layer, 60);
        assert_int_equal(marked->table->layer[s->layer].datatype, g->rule->kind->marker);
        fw_geometry_box box = fw_geometry_contour_box(&s->contour);
        for (int k = 0; k < 2; k++)
            assert_true(box.x0 <= g->at[k].x && g->at[k].x <= box.x1 && box.y0 <= g->at[k].y &&
                        g->at[k].y <= box.y1);
    }
    f->layer[0].layer = 60; /* taken: the next lower one */
    assert_int_equal(fw_mask_marked(f->s->arena, mask, &marked), FW_OK);
    assert_int_equal(marked->table->layer[marked->shape[mask->nshape].layer].layer, 59);
    scene_free(f->s);
}

static void short_memory(void **state) {
    (void)state;
    fw_status status = FW_NOMEM;
    long at = 1;
    for (; status == FW_NOMEM && at < 3000; at++) {
        field *f = broken_field();
        const fw_mask *mask = NULL, *marked;
        fw_text text = fw_text_new(f->s->arena);
        fw_arena_fail_at(at, 1);
        status = fw_mask_examine(f->s->arena, &f->s->layout, &f->s->table, "test device",
                                 &f->s->options, &f->s->diags, &mask);
        if (mask && status == FW_INPUT) status = fw_mask_marked(f->s->arena, mask, &marked);
        if (mask && status == FW_OK) status = fw_mask_write_lyrdb(mask, &text);
        if (mask && status == FW_OK) status = fw_mask_write_findings(mask, &text);
        fw_arena_fail_at(0, 0);
        scene_free(f->s);
    }
    assert_int_equal(status, FW_OK);
    assert_true(at > 50);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_between_layers), cmocka_unit_test(windows_cut_outlines),
        cmocka_unit_test(all_are_findings),       cmocka_unit_test(what_crosses_has_no_space),
        cmocka_unit_test(notches_of_one_shape),   cmocka_unit_test(first_drawn_first_named),
        cmocka_unit_test(row_and_layer_are_one),  cmocka_unit_test(two_places_of_one_pair),
        cmocka_unit_test(warnings_let_pass),      cmocka_unit_test(findings_are_written),
        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
