/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plates as they are written: tone, scale, mirror, several of a flow, one die; and their order sheets. */
#include "wafer/plate.h"
#include <stdlib.h>

static fw_wafer_written written(plate *p, const fw_wafer *w, int of) {
    fw_wafer_written out;
    assert_int_equal(fw_wafer_written_of(p->arena, w, of, &out), FW_OK);
    return out;
}

static double place_of(const fw_mask_plate_place *p, int column) {
    return p->x + (double)column * p->step_x;
}

/* What is drawn and what it leaves free are the whole field, whatever the scale: cells of dies, of ids and the
   top cell neither overlap nor leave gaps, though each is rounded to the grid by itself. */
static void inverted(void **state) {
    (void)state;
    const double scale[] = {1, 1.0002, 0.99971, 1.00777};
    for (size_t i = 0; i < sizeof scale / sizeof scale[0]; i++)
        for (int mirror = 0; mirror < 2; mirror++) {
            plate *p = plate_new(240);
            fw_device_order_asked *o = &p->device.wafer.order;
            o->scale = scale[i];
            o->mirror = mirror ? FW_MIRROR_YES : FW_MIRROR_NO;
            const fw_wafer *w = plate_build(p);
            assert_true(w->ids);
            fw_wafer_written drawn = written(p, w, 0);
            o->inverted = true;
            fw_wafer_written rest = written(p, w, 0);
            double field_m2 = rest.field_m * rest.field_m;
            assert_near(rest.field_m, w->form.plate_m - 8e-3, 1e-12);
            assert_true(drawn.sums.area_m2 > 0.05 * field_m2);
            assert_near(drawn.sums.area_m2 + rest.sums.area_m2, field_m2, 1e-15 * 1e3);
            assert_string_equal(drawn.plate.table->layer[0].tone, "data dark");
            assert_string_equal(rest.plate.table->layer[0].tone, "data clear");
            assert_int_equal(drawn.mirrored, mirror);
            fw_arena_free(p->arena);
        }
}

/* dies stand on the scaled pitch, rounded, wherever they are; the area grows with the square */
static void scaled(void **state) {
    (void)state;
    plate *p = plate_new(240);
    p->device.wafer.order.mirror = FW_MIRROR_NO;
    const fw_wafer *w = plate_build(p);
    fw_wafer_written one = written(p, w, 0);
    p->device.wafer.order.scale = 1.0004;
    fw_wafer_written more = written(p, w, 0);
    assert_int_equal(one.plate.nplace, more.plate.nplace);
    for (int i = 0; i < one.plate.nplace; i++) {
        const fw_mask_plate_place *a = &one.plate.place[i], *b = &more.plate.place[i];
        assert_int_equal(a->columns, b->columns);
        for (int k = 0; k < a->columns; k++) /* half a nanometre a step, and two roundings */
            assert_near(place_of(b, k), 1.0004 * place_of(a, k), 0.5 * w->grid.columns + 2);
        assert_near(b->y, 1.0004 * a->y, 0.5 * w->grid.rows + 2);
    }
    /* title and crosses are not scaled */
    assert_true(more.sums.area_m2 < 1.0004 * 1.0004 * one.sums.area_m2);
    assert_true(more.sums.area_m2 > 1.0006 * one.sums.area_m2);
    fw_arena_free(p->arena);
}

static fw_status build_with(plate *p, double scale, double size_m, bool single,
                            const fw_wafer **w) {
    p->device.wafer.order.scale = scale;
    p->device.wafer.order.size_m = size_m;
    p->input.single = single;
    return fw_wafer_build(p->arena, &p->input, &p->diags, w);
}

/* too large a scale for a wafer is refused with what is left; one die takes it, on a plate that holds it */
static void scale_and_size(void **state) {
    (void)state;
    const fw_wafer *w = NULL;
    plate *p = plate_new(240);
    assert_int_equal(build_with(p, 5, (double)NAN, false, &w), FW_INPUT);
    assert_int_equal(p->diags.item[p->diags.count - 1].number, 551);
    assert_non_null(strstr(p->diags.item[p->diags.count - 1].message, "a scale of at most 1."));
    assert_int_equal(build_with(p, 5, (double)NAN, true, &w), FW_OK);
    assert_int_equal(w->dies, 1);
    assert_false(w->ids);
    assert_near(w->form.plate_m, 3 * 25.4e-3, 1e-9); /* 12.8 mm across, and 20 mm */
    fw_wafer_written five = written(p, w, 0);
    assert_int_equal(five.plate.ncell, 1);
    fw_geometry_box b =
        five.plate.cell[0].mask->box; /* 1900 um of frame and the bias, five times */
    assert_near(b.x1 - b.x0, 5 * 1902.2e-6, 2e-9);
    assert_int_equal(build_with(p, 5, 30e-3, true, &w), FW_INPUT);
    assert_int_equal(p->diags.item[p->diags.count - 1].number, 551);
    assert_int_equal(build_with(p, 5, 35e-3, true, &w), FW_OK);
    assert_near(w->form.plate_m, 35e-3, 1e-12);
    fw_arena_free(p->arena);
}

/* a flow of two plates: what each draws, how it is lettered, and what is asked of each */
static void several(void **state) {
    (void)state;
    plate *p = plate_new(240);
    fw_mask_plate_row row[] = {{.id = "hollow",
                                .title = "hollows",
                                .layers = "4/0",
                                .reading = "right-reading chrome down",
                                .overlay_m = (double)NAN},
                               {.id = "device",
                                .title = "the device",
                                .layers = "1/0 NOT 2/0 NOT 3/0",
                                .reading = "right-reading chrome up",
                                .aligned_to = "hollow",
                                .overlay_m = 3e-6}};
    fw_device_order_asked own = p->device.wafer.order;
    own.plate = "hollow";
    own.quantity = 3;
    own.quartz = true;
    p->table.plates = row;
    p->table.nplate = 2;
    p->table.device_plate = 1;
    p->device.wafer.ordered = &own;
    p->device.wafer.nordered = 1;
    const fw_wafer *w = plate_build(p);
    assert_string_equal(fw_device_order_of(&p->device.wafer, "hollow")->plate, "hollow");
    assert_null(fw_device_order_of(&p->device.wafer, "device")->plate);
    double area[2];
    for (int of = 0; of < 2; of++) {
        fw_wafer_written own_plate = written(p, w, of);
        fw_text out = fw_text_new(p->arena), json = fw_text_new(p->arena);
        area[of] = own_plate.sums.area_m2;
        assert_int_equal(own_plate.mirrored, of == 0);
        assert_non_null(own_plate.plate.drawn); /* title and crosses, of its own layer */
        assert_true(own_plate.plate.drawn->nshape > 20);
        assert_int_equal(fw_wafer_write_written_order(w, &own_plate, NULL, 0, &out), FW_OK);
        assert_int_equal(fw_wafer_write_written_order_json(w, &own_plate, NULL, 0, &json), FW_OK);
        assert_non_null(
            strstr(out.data, of ? "2 of 2 of this flow, \"device\"" : "1 of 2 of this"));
        assert_non_null(strstr(out.data, "+-") ? strstr(out.data, "1 um (a third of the closest")
                                               : NULL);
        assert_non_null(strstr(out.data, ": the same on every plate of the set"));
        assert_non_null(strstr(out.data, of ? "soda-lime glass" : "quartz, chrome"));
        assert_non_null(strstr(json.data, of ? "\"quantity\": 1" : "\"quantity\": 3"));
        assert_non_null(strstr(json.data, "\"registration_um\": 1,"));
        assert_non_null(
            strstr(json.data, of ? "\"mirrored_in_data\": false" : "\"mirrored_in_data\": true"));
        /* cells of ids are of the plate that draws the frame alone */
        for (int c = 0; c < own_plate.plate.ncell; c++)
            assert_true(of == 1 || strncmp(own_plate.plate.cell[c].name, "ROW", 3) != 0);
    }
    /* lanes of 2000 um x 50 um of every place that has one, and the lettering beside them */
    assert_true(area[0] > w->dies * 2000e-6 * 50e-6);
    assert_true(area[1] > 10 * w->dies * 2000e-6 * 50e-6);
    fw_arena_free(p->arena);
}

/* What stands beside the dies is on the order word by word, as the file has it; what has no room or was not asked for is
   said to be missing. */
static void lettering(void **state) {
    (void)state;
    static const char *const flat[] = {[FW_SIDE_BOTTOM] = "at y = -", [FW_SIDE_TOP] = "at y = ",
                                       [FW_SIDE_LEFT] = "at x = -", [FW_SIDE_RIGHT] = "at x = "};
    for (int i = 0; i < 16; i++) {
        plate *p = plate_new(240);
        fw_device_order_asked *o = &p->device.wafer.order;
        bool mirror = i & 4, asked = i & 8;
        p->device.wafer.side = (fw_device_wafer_side)(i % 4);
        p->device.wafer.plate_m = 127e-3;
        o->mirror = mirror ? FW_MIRROR_YES : FW_MIRROR_NO;
        o->barcode = asked ? "LOT-7" : NULL;
        o->flat_line = asked;
        const fw_wafer *w = plate_build(p);
        fw_wafer_written own = written(p, w, 0);
        fw_text out = fw_text_new(p->arena), json = fw_text_new(p->arena);
        assert_int_equal(fw_wafer_write_written_order(w, &own, NULL, 0, &out), FW_OK);
        assert_int_equal(fw_wafer_write_written_order_json(w, &own, NULL, 0, &json), FW_OK);
        char line[200];
        snprintf(line, sizeof line, "text at the top        %s\n", w->title);
        assert_non_null(strstr(out.data, line));
        assert_non_null(strstr(out.data, "text at the bottom     "));
        assert_non_null(strstr(json.data, "\"text_at_bottom\": \""));
        snprintf(line, sizeof line, "barcode                %s%s\n", asked ? "LOT-7 (Code 39), " : "none",
                 !asked ? "" : mirror ? "on the right of the wafer" : "on the left of the wafer");
        assert_non_null(strstr(out.data, line));
        bool turned = mirror && i % 4 >= FW_SIDE_LEFT;
        int side = !turned ? i % 4 : i % 4 == FW_SIDE_LEFT ? FW_SIDE_RIGHT : FW_SIDE_LEFT;
        snprintf(line, sizeof line, "%s%s", asked ? "its inner edge " : "flat line              none",
                 asked ? flat[side] : "");
        const char *at = strstr(out.data, line);
        assert_non_null(at);
        if (asked) assert_true(at[strlen(line)] != '-');
        assert_non_null(strstr(json.data, asked ? "\"flat_line\": true" : "\"flat_line\": false"));
        fw_arena_free(p->arena);
    }
    plate *p = plate_new(240); /* on a plate of 3 inches these signs have no room */
    p->device.wafer.order.barcode = "0123456789012345678901234567890123456789";
    const fw_wafer *w = plate_build(p);
    fw_wafer_written own = written(p, w, 0);
    fw_text out = fw_text_new(p->arena);
    assert_int_equal(fw_wafer_write_written_order(w, &own, NULL, 0, &out), FW_OK);
    assert_non_null(strstr(out.data, "barcode                none\n"));
    fw_arena_free(p->arena);
}

/* where the search for near edges ended early, the order does not give what it found as the least there is */
static void unfinished(void **state) {
    (void)state;
    for (int of = 0; of < 2; of++) {
        plate *p = plate_new(240);
        const fw_wafer *w = plate_build(p);
        fw_mask_measure *m = (fw_mask_measure *)(uintptr_t)&w->cell[0].mask->measure[0];
        m->unfinished = of;
        fw_wafer_written own = written(p, w, 0);
        fw_text out = fw_text_new(p->arena), json = fw_text_new(p->arena), all = fw_text_new(p->arena);
        assert_int_equal(fw_wafer_write_written_order(w, &own, NULL, 0, &out), FW_OK);
        assert_int_equal(fw_wafer_write_written_order_json(w, &own, NULL, 0, &json), FW_OK);
        assert_int_equal(fw_wafer_write_order(w, 0, NULL, 0, &all), FW_OK);
        assert_int_equal(strstr(out.data, "um or less: edges are too many") != NULL, of);
        assert_int_equal(strstr(out.data, "(a third of the least feature or space that was found)") != NULL, of);
        assert_int_equal(strstr(json.data, "\"unfinished\": true") != NULL, of);
        assert_int_equal(strstr(all.data, "(FW-D592)") != NULL, of);
        fw_arena_free(p->arena);
    }
}

static const fw_diag *said(const plate *p, int number) {
    for (size_t i = 0; i < p->diags.count; i++)
        if (p->diags.item[i].number == number) return &p->diags.item[i];
    return NULL;
}

/* data that are not what the reading asks for are to be mirrored by whoever writes them, and the sheet says so */
static void mirror_against_reading(void **state) {
    (void)state;
    static const char *const reading[] = {"right-reading chrome down", "wrong-reading chrome down", "as you like"};
    for (int r = 0; r < 3; r++)
        for (int mirror = 0; mirror < 2; mirror++) {
            plate *p = plate_new(240);
            p->table.reading = reading[r];
            p->device.wafer.order.mirror = mirror ? FW_MIRROR_YES : FW_MIRROR_NO;
            const fw_wafer *w = plate_build(p);
            fw_wafer_written own = written(p, w, 0);
            fw_text out = fw_text_new(p->arena), json = fw_text_new(p->arena);
            assert_int_equal(fw_wafer_check_orders(p->arena, w, &p->diags), FW_OK);
            assert_int_equal(fw_wafer_write_written_order(w, &own, NULL, 0, &out), FW_OK);
            assert_int_equal(fw_wafer_write_written_order_json(w, &own, NULL, 0, &json), FW_OK);
            const bool wanted = r == 0, as_read = mirror == wanted;
            assert_int_equal(said(p, 688) != NULL, r < 2 && !as_read);
            assert_int_equal(strstr(out.data, "; write them as they are") != NULL, r < 2 && as_read);
            assert_int_equal(strstr(out.data, "mirror them when writing") != NULL, r < 2 && !as_read);
            assert_int_equal(strstr(out.data, "ask before writing") != NULL, r == 2);
            assert_non_null(strstr(json.data, r == 2       ? "\"mirror_when_writing\": null"
                                              : as_read ? "\"mirror_when_writing\": false"
                                                        : "\"mirror_when_writing\": true"));
            fw_arena_free(p->arena);
        }
}

static double after(const fw_text *text, const char *key) {
    const char *at = strstr(text->data, key);
    assert_non_null(at);
    return atof(at + strlen(key));
}

/* what holds on the wafer is as much larger on a plate of that scale: bias, arcs, tolerances */
static void scale_of_sheet(void **state) {
    (void)state;
    fw_text out[2];
    double bias_um[2], cd_um[2], registration_um[2];
    plate *p[2];
    for (int i = 0; i < 2; i++) {
        p[i] = plate_new(240);
        p[i]->device.wafer.order.mirror = FW_MIRROR_NO;
        p[i]->input.effect = (fw_wafer_width_effect){.says = "hinge A", .left_m = 0.2e-6, .looked_m = 1e-6};
        p[i]->input.overlay_m = 3e-6;
        p[i]->input.mask.bias_m = 0.5e-6;
        const fw_wafer *w;
        assert_int_equal(build_with(p[i], i ? 5 : 1, (double)NAN, true, &w), FW_OK);
        fw_wafer_written own = written(p[i], w, 0);
        fw_text json = fw_text_new(p[i]->arena);
        out[i] = fw_text_new(p[i]->arena);
        ((fw_mask *)(uintptr_t)w->cell[0].mask)->bias_m = 0.5e-6;
        assert_int_equal(fw_wafer_write_written_order(w, &own, NULL, 0, &out[i]), FW_OK);
        assert_int_equal(fw_wafer_write_written_order_json(w, &own, NULL, 0, &json), FW_OK);
        bias_um[i] = after(&json, "\"bias_um_per_edge\": ");
        cd_um[i] = after(&json, "\"cd_tolerance_um\": ");
        registration_um[i] = after(&json, "\"registration_um\": ");
        assert_non_null(strstr(out[i].data, i ? "arcs within 25 nm" : "arcs within 5 nm"));
        assert_non_null(strstr(out[i].data, i ? "2.5 um per edge" : "0.5 um per edge"));
    }
    assert_relative(bias_um[1], 5 * bias_um[0], 1e-9);
    assert_relative(cd_um[0], 0.1, 1e-9);
    assert_relative(cd_um[1], 0.5, 1e-9);
    assert_relative(registration_um[0], 1, 1e-9);
    assert_relative(registration_um[1], 5, 1e-9);
    fw_arena_free(p[0]->arena);
    fw_arena_free(p[1]->arena);
}

/* a tolerance that is stated is held against what the verdict bears, and what is asked for against what shops promise */
static void held_against(void **state) {
    (void)state;
    const double stated[] = {(double)NAN, 0.25e-6, 0.05e-6}, left[] = {0.2e-6, 0.006e-6};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            plate *p = plate_new(240);
            p->device.wafer.order.cd_m = stated[i];
            p->input.effect = (fw_wafer_width_effect){.says = "hinge A", .left_m = left[k], .looked_m = 1e-6};
            const fw_wafer *w = plate_build(p);
            assert_int_equal(fw_wafer_check_orders(p->arena, w, &p->diags), FW_OK);
            assert_int_equal(said(p, 689) != NULL, stated[i] > 0.5 * left[k]);
            assert_int_equal(said(p, 697) != NULL, isnan(stated[i]) && k == 1);
            if (said(p, 689)) assert_non_null(strstr(said(p, 689)->message, "hinge A"));
            fw_arena_free(p->arena);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(inverted), cmocka_unit_test(scaled),
                                       cmocka_unit_test(scale_and_size), cmocka_unit_test(several),
                                       cmocka_unit_test(lettering), cmocka_unit_test(unfinished),
                                       cmocka_unit_test(mirror_against_reading),
                                       cmocka_unit_test(scale_of_sheet), cmocka_unit_test(held_against)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
