/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of the wafer in flows that print more than the device's plate. */
#include "pack_fixture.h"
#include "process/films.h"
#include <string.h>

#define SOI    "soi-deep-rie"
#define CAVITY "<plate id=\"cavity\" inside=\"cavity\" outside=\"bond\"/>"
#define PADS   "<plate id=\"pads\" inside=\"pad\" outside=\"bare\" within=\"structure bond\"/>"
#define BEFORE "<step id=\"D01\""

static fw_process_flow *with(const char *rows) {
    char text[2000];
    snprintf(text, sizeof text, "%s\n  %s", rows, BEFORE);
    diags = fw_diags_new(arena);
    return read_pack(arena, SOI, BEFORE, text, &diags);
}

/* of two plates besides the device's the parts that can be, each under its own name */
static void columns(void **state) {
    (void)state;
    static const char *const name[] = {"structure, bond, bare", "field, bond, bare",
                                       "structure, cavity, bare", "field, cavity, bare",
                                       "structure, bond, pad"};
    fw_process_flow *f = with(CAVITY PADS);
    assert_non_null(f);
    assert_int_equal(fw_process_flow_columns(f), 5);
    for (int k = 0; k < 5; k++) {
        char text[FW_LABEL];
        assert_string_equal(fw_process_column_name(f, k, text), name[k]);
        assert_true(fw_process_where_holds(f, "all", k));
        assert_int_equal(fw_process_where_holds(f, "cavity", k), strstr(name[k], "cavity") != NULL);
        assert_int_equal(fw_process_where_holds(f, "pad", k), strstr(name[k], "pad") != NULL);
        assert_int_equal(fw_process_where_holds(f, "field", k), strstr(name[k], "field") != NULL);
    }
    assert_true(fw_process_columns_meet(f, 0, 1) && fw_process_columns_meet(f, 0, 4));
    assert_false(fw_process_columns_meet(f, 1, 2));
    assert_int_equal(fw_process_flow_columns(with("")), 2);
}

/* films of the shipped flow are the same whatever else parts the wafer, as long as no step works on it */
static void further_plates_change_nothing(void **state) {
    (void)state;
    fw_process_flow *plain = with(""), *parted = with(CAVITY PADS);
    assert_int_equal(fw_process_flow_compute(arena, plain, &plain_facts, &diags), FW_OK);
    assert_int_equal(fw_process_flow_compute(arena, parted, &plain_facts, &diags), FW_OK);
    for (int i = 0; i < plain->nstep; i++) {
        fw_process_films a, b;
        assert_int_equal(fw_process_flow_films(arena, plain, i, &a), FW_OK);
        assert_int_equal(fw_process_flow_films(arena, parted, i, &b), FW_OK);
        assert_int_equal(a.n, b.n);
        for (int k = 0; k < a.n; k++) {
            assert_string_equal(a.film[k].material, b.film[k].material);
            assert_near(a.film[k].bottom_m, b.film[k].bottom_m, 0.0);
            assert_near(a.film[k].top_m, b.film[k].top_m, 0.0);
            assert_near(a.film[k].foot_m, b.film[k].foot_m, 0.0);
            for (int c = 0; c < 5; c++)
                assert_int_equal(b.film[k].in[c],
                                 a.film[k].in[fw_process_where_holds(parted, "field", c) ? 1 : 0]);
        }
    }
}

static const fw_process_film *film_in(const fw_process_films *films, const char *material,
                                      int column) {
    const fw_process_film *found = NULL;
    for (int i = 0; i < films->n; i++)
        if (films->film[i].in[column] && strcmp(films->film[i].material, material) == 0 &&
            (!found || films->film[i].top_m > found->top_m))
            found = &films->film[i];
    return found;
}

/* a hollow etched into what the wafer begins with, and a layer that spans it: the hollow stays below the layer */
static void hollow_below_a_layer(void **state) {
    (void)state;
    static const char *const from =
        "<change kind=\"add\" material=\"silicon-100\" thickness=\"soi.d\"/>";
    static const char *const to =
        "<change kind=\"remove\" material=\"buried-oxide\" thickness=\"box.d\" where=\"cavity\"/>"
        "<change kind=\"add\" material=\"silicon-100\" thickness=\"soi.d\" spans=\"yes\"/>";
    diags = fw_diags_new(arena);
    fw_process_flow *f = read_pack(arena, SOI, from, to, &diags);
    assert_null(f); /* cavity is no part of the wafer before a <plate> says so */
    assert_non_null(said_of(413, "where=\"cavity\" is no part of the wafer"));
    char file[200];
    snprintf(file, sizeof file, "%s", CAVITY);
    f = with(CAVITY);
    assert_non_null(f);
    fw_process_step *first = &f->step[0];
    assert_int_equal(first->nchange, 3);
    fw_process_change change[4] = {first->change[0], first->change[1], first->change[1],
                                   first->change[2]};
    change[2].kind = "remove";
    change[2].where = "cavity";
    change[3].spans = true;
    first->change = change;
    first->nchange = 4;
    fw_process_films films;
    fw_process_stack stack;
    assert_int_equal(fw_process_flow_films(arena, f, 0, &films), FW_OK);
    assert_int_equal(fw_process_flow_stack(arena, f, 0, &stack, NULL), FW_OK);
    const fw_process_film *oxide = film_in(&films, "buried-oxide", 0),
                          *silicon = film_in(&films, "silicon-100", 0);
    assert_non_null(oxide);
    assert_null(film_in(&films, "buried-oxide", 2));
    assert_null(film_in(&films, "buried-oxide", 3));
    assert_ptr_equal(silicon, film_in(&films, "silicon-100", 2));
    assert_near(silicon->bottom_m, oxide->top_m, 1e-15);
    assert_int_equal(stack.n[0], 3);
    assert_int_equal(stack.n[2], 2);
    assert_near(stack.cell[2][1].bottom, stack.cell[0][2].bottom, 1e-12);
}

#define GLASS "silicon-on-glass"

/* the shipped flow of three plates: what its steps do to the parts of its wafer */
static void hollowed_glass(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack(GLASS, NULL, NULL);
    const fw_process_step *at = NULL;
    const fw_quantity *depth = fw_process_flow_hollow(f, "cavity", &at);
    assert_non_null(depth);
    assert_near(depth->value, 20e-6, 1e-15);
    assert_string_equal(at->op, "wet-etch");
    assert_null(fw_process_flow_hollow(f, "pads", NULL));
    assert_near(f->bias_m, 1.1e-6,
                1e-12); /* of the aluminium alone: the hollow is another plate's */
    int etch = (int)(at - f->step), hollow = -1;
    for (int k = 0; k < fw_process_flow_columns(f); k++)
        if (fw_process_where_holds(f, "cavity", k)) hollow = k;
    fw_process_films films;
    fw_process_stack stack;
    assert_int_equal(fw_process_flow_films(arena, f, etch, &films), FW_OK);
    const fw_process_film *ground = film_in(&films, "glass-carrier", 0),
                          *floor = film_in(&films, "glass-carrier", hollow);
    assert_near(ground->top_m - floor->top_m, 20e-6, 1e-12);
    assert_near(ground->further[0].foot_m, -20e-6, 1e-12); /* as printed, */
    assert_near(ground->further[0].head_m, 0.0, 1e-12);    /* and as drawn where it is bonded */
    assert_int_equal(fw_process_flow_stack(arena, f, etch, &stack, NULL), FW_OK);
    assert_near(stack.cell[hollow][3].thickness_m, 480e-6, 1e-12);
    assert_near(stack.cell[0][3].thickness_m, 500e-6, 1e-12);
    assert_int_equal(fw_process_flow_stack(arena, f, f->nstep - 1, &stack, NULL), FW_OK);
    for (int k = 0; k < stack.columns; k++) {
        bool pad = fw_process_where_holds(f, "pad", k),
             field = fw_process_where_holds(f, "field", k);
        assert_int_equal(fw_process_stack_holds(&stack, k, "pad-gold"), pad);
        assert_int_equal(fw_process_stack_holds(&stack, k, "silicon-100"), !field);
        assert_int_equal(stack.n[k], field ? 1 : pad ? 3 : 2);
    }
}

/* what the etch takes sideways, and what its plate is drawn smaller by */
static void shrink(void **state) {
    (void)state;
    const struct {
        const char *from, *to, *says;
    } row[] = {
        {"shrink=\"cavity.d\"", "shrink=\"si.d\"",
         "plate \"cavity\" is drawn smaller by 50 um (shrink), but step G12 takes 20 um"},
        {" shrink=\"cavity.d\"", "", "drawn smaller by 0 um (shrink), but step G12 takes 20 um"},
        {"overrun=\"0\" k=\"2\"><arg name=\"thickness\" q=\"cavity.d\"/>",
         "overrun=\"0.5\" k=\"2\"><arg name=\"thickness\" q=\"cavity.d\"/>",
         "drawn smaller by 20 um (shrink), but step G12 takes 30 um"},
        {"outside=\"bare\"", "outside=\"bare\" shrink=\"al.d\"",
         "plate \"pads\" is drawn smaller by 1 um (shrink), but no isotropic etch takes 0 um"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, GLASS, row[i].from, row[i].to, &diags));
        if (!said_of(420, row[i].says)) fail_msg("%s", diags.item[0].message);
    }
    diags = fw_diags_new(arena);
    assert_non_null(read_pack(arena, GLASS, "id=\"cavity.d\" value=\"20\"",
                              "id=\"cavity.d\" value=\"30\"", &diags));
    assert_int_equal(diags.errors, 0); /* both go with it */
}

static void mistakes(void **state) {
    (void)state;
    assert_null(with("<plate id=\"a\" inside=\"field\" outside=\"b\"/>"));
    assert_non_null(said_of(413, "plate \"a\" calls its parts"));
    assert_null(with("<plate id=\"a\" inside=\"x\" outside=\"x\"/>"));
    assert_non_null(said_of(413, "plate \"a\" calls its parts"));
    assert_null(with(CAVITY PADS "<plate id=\"c\" inside=\"x\" outside=\"y\"/>"));
    assert_non_null(said_of(413, "at most 2 plates besides"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(columns, setup, teardown),
        cmocka_unit_test_setup_teardown(further_plates_change_nothing, setup, teardown),
        cmocka_unit_test_setup_teardown(hollow_below_a_layer, setup, teardown),
        cmocka_unit_test_setup_teardown(hollowed_glass, setup, teardown),
        cmocka_unit_test_setup_teardown(shrink, setup, teardown),
        cmocka_unit_test_setup_teardown(mistakes, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
