/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <wafer> and <sweep>: what is read, what is refused. */
#include "files.h"

#define PARAMETERS                                                                                 \
    "<parameter name=\"arc\" value=\"200 deg\"/><parameter name=\"w\" value=\"8 um\"/>"            \
    "<parameter name=\"half\" value=\"w/2\"/><parameter name=\"n\" value=\"3\"/>"
#define WAFER(attributes, body) DEVICE(PARAMETERS "<wafer " attributes ">" body "</wafer>" ARM)

static void plain(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device *d = sound(arena, DEVICE(ARM), NULL, 0);
    assert_false(d->wafer.asked);
    d = sound(arena, WAFER("", ""), NULL, 0);
    assert_true(d->wafer.asked && d->wafer.nsweep == 0 && !d->wafer.alignment);
    assert_near(d->wafer.diameter_m, 0.1, 1e-15);
    assert_near(d->wafer.edge_m, 3e-3, 1e-15);
    assert_true(isnan(d->wafer.flat_m) && isnan(d->wafer.pitch_x_m) && isnan(d->wafer.plate_m));
    assert_true(d->wafer.side == FW_SIDE_BOTTOM && d->wafer.centre == FW_CENTRE_AUTO);
    fw_arena_free(arena);
}

static void all_of_it(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml =
        WAFER("diameter=\"150 mm\" flat=\"57.5 mm\" flat-side=\"left\" edge-exclusion=\"5 mm\" "
              "pitch-x=\"3.5 mm\" pitch-y=\"w*500\" centre=\"street\" alignment=\"2 sites\" "
              "test-dies=\"5\" assign=\"blocks\" plate=\"180 mm\" title=\"T\"",
              "<sweep parameter=\"arc\" from=\"180 deg\" to=\"240 deg\" steps=\"4\"/>"
              "<sweep parameter=\"half\" from=\"1 um\" to=\"half\" steps=\"3\"/>");
    const fw_device *d = sound(arena, xml, NULL, 0);
    const fw_device_wafer_asked *w = &d->wafer;
    assert_near(w->diameter_m, 0.15, 1e-15);
    assert_near(w->flat_m, 57.5e-3, 1e-15);
    assert_true(w->side == FW_SIDE_LEFT && w->centre == FW_CENTRE_STREET && w->blocks);
    assert_near(w->edge_m, 5e-3, 1e-15);
    assert_near(w->pitch_x_m, 3.5e-3, 1e-15);
    assert_near(w->pitch_y_m, 4e-3, 1e-15);
    assert_true(w->alignment && w->tests == 5);
    assert_near(w->plate_m, 0.18, 1e-15);
    assert_string_equal(w->title, "T");
    assert_int_equal(w->nsweep, 2);
    assert_string_equal(d->parameter[w->sweep[0].parameter].name, "arc");
    assert_relative(w->sweep[0].to, 240 * 3.14159265358979323846 / 180, 1e-15);
    assert_string_equal(w->sweep[0].unit, "deg");
    assert_int_equal(w->sweep[0].steps, 4);
    assert_string_equal(d->parameter[w->sweep[1].parameter].name, "half");
    assert_string_equal(w->sweep[1].unit, "um");
    assert_near(w->sweep[1].to, 4e-6, 1e-20);
    fw_arena_free(arena);
}

/* <order>: what is not said is left to the wafer room */
static void order(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device_order_asked *o = &sound(arena, WAFER("", ""), NULL, 0)->wafer.order;
    assert_true(isnan(o->thickness_m) && isnan(o->cd_m) && isnan(o->registration_m) &&
                isnan(o->defect_m));
    assert_true(!o->quartz && !o->pellicle && o->mirror == FW_MIRROR_READ && o->quantity == 1);
    assert_true(!o->barcode && !o->flat_line);
    o = &sound(arena,
               WAFER("", "<order material=\"quartz\" thickness=\"2.3 mm\" mirror=\"no\" "
                         "cd-tolerance=\"0.2 um\" registration=\"w/10\" defect=\"1 um\" "
                         "pellicle=\"yes\" quantity=\"3\" barcode=\"A-1 $2\" flat-line=\"yes\"/>"),
               NULL, 0)
             ->wafer.order;
    assert_true(o->quartz && o->pellicle && o->mirror == FW_MIRROR_NO && o->quantity == 3);
    assert_near(o->thickness_m, 2.3e-3, 1e-15);
    assert_near(o->cd_m, 0.2e-6, 1e-20);
    assert_near(o->registration_m, 0.8e-6, 1e-20);
    assert_near(o->defect_m, 1e-6, 1e-20);
    assert_string_equal(o->barcode, "A-1 $2");
    assert_true(o->flat_line);
    fw_arena_free(arena);
}

/* the unit of the steps: of `from`, else of the parameter, else none is known; pure numbers need
 * none */
static void units(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device *d =
        sound(arena, WAFER("", "<sweep parameter=\"w\" from=\"half\" to=\"9 um\" steps=\"2\"/>"),
              NULL, 0);
    assert_string_equal(d->wafer.sweep[0].unit, "um");
    d = sound(arena, WAFER("", "<sweep parameter=\"n\" from=\"1\" to=\"n\" steps=\"3\"/>"), NULL,
              0);
    assert_string_equal(d->wafer.sweep[0].unit, "");
    only_error(arena, WAFER("", "<sweep parameter=\"half\" from=\"w\" to=\"9 um\" steps=\"2\"/>"),
               NULL, 0, 190, "no unit of its own");
    fw_arena_free(arena);
}

static void refused(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const struct {
        const char *xml, *says;
        int number;
    } row[] = {
        {WAFER("", "<sweep parameter=\"ark\" from=\"1 deg\" to=\"2 deg\" steps=\"2\"/>"), "arc",
         46},
        {WAFER("", "<sweep parameter=\"arc\" from=\"1 um\" to=\"2 deg\" steps=\"2\"/>"),
         "angle is wanted", 25},
        {WAFER("", "<sweep parameter=\"arc\" from=\"1 deg\" to=\"2 deg\" steps=\"1\"/>"), "sweep",
         47},
        {WAFER("", "<sweep parameter=\"arc\" from=\"1 deg\" to=\"2 deg\" steps=\"2.5\"/>"), "whole",
         96},
        {WAFER("", "<sweep parameter=\"arc\" from=\"1 deg\" steps=\"2\"/>"), "to", 43},
        {WAFER("", "<sweep parameter=\"arc\" from=\"1 deg\" to=\"2 deg\" steps=\"2\"/>"
                   "<sweep parameter=\"arc\" from=\"1 deg\" to=\"2 deg\" steps=\"2\"/>"),
         "swept twice", 190},
        {WAFER("", "<sweep parameter=\"arc\" from=\"1 deg\" to=\"2 deg\" steps=\"9\"/>"
                   "<sweep parameter=\"w\" from=\"1 um\" to=\"2 um\" steps=\"8\"/>"),
         "72 different", 190},
        {WAFER("", "<sweep parameter=\"arc\" from=\"1 deg\" to=\"2 deg\" steps=\"2\"/>"
                   "<sweep parameter=\"w\" from=\"1 um\" to=\"2 um\" steps=\"2\"/>"
                   "<sweep parameter=\"n\" from=\"1\" to=\"2\" steps=\"2\"/>"),
         "2 <sweep>", 66},
        {WAFER("diameter=\"1 m\"", ""), "diameter", 47},
        {WAFER("edge-exclusion=\"5 um\"", ""), "edge-exclusion", 47},
        {WAFER("centre=\"edge\"", ""), "centre", 48},
        {WAFER("test-dies=\"10\"", ""), "test-dies", 47},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        only_error(arena, row[i].xml, NULL, 0, row[i].number, row[i].says);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order), cmocka_unit_test(plain),   cmocka_unit_test(all_of_it),
        cmocka_unit_test(units), cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
