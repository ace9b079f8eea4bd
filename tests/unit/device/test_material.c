/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files.h"

#define PACK(body) "<process><source id='s'>src</source>" body "</process>"

static void the_pack_is_sound(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    size_t n;
    char *xml = load(arena, "processes/base.xml", &n);
    fw_device_materials m;
    fw_status s = fw_device_materials_read(arena, "base.xml", xml, n, &diags, &m);
    if (s != FW_OK) fail_msg("%d: %s", diags.item[0].place.line, diags.item[0].message);
    const fw_device_material *si = fw_device_material_find(&m, "silicon-100");
    const fw_device_material *cu = fw_device_material_find(&m, "copper-plated");
    assert_non_null(si);
    assert_non_null(cu);
    assert_in_range((long)(si->youngs.value / 1e9), 130, 169);
    assert_in_range((long)cu->density.value, 8000, 9000);
    assert_string_equal(si->criterion, "fracture");
    assert_true(si->youngs.uncertainty > 0 && si->youngs.source[0]);
    assert_null(fw_device_material_find(&m, "unobtainium"));
    const struct {
        const char *id;
        double expansion, change;
    } warm[] = {{"silicon-100", 2.57e-6, -60e-6},
                {"copper-plated", 16.7e-6, -390e-6},
                {"aluminium", 23.1e-6, -540e-6},
                {"silicon-substrate", 2.57e-6, 0},
                {"glass-carrier", 3.3e-6, 0}};
    for (size_t i = 0; i < sizeof warm / sizeof warm[0]; i++) {
        const fw_device_material *w = fw_device_material_find(&m, warm[i].id);
        assert_non_null(w);
        assert_relative(w->expansion.value, warm[i].expansion, 1e-14);
        assert_true(w->expansion.uncertainty > 0 && w->expansion.status == FW_TYPICAL);
        assert_int_equal(w->modulus_change.unknown, warm[i].change == 0);
        if (warm[i].change != 0) assert_relative(w->modulus_change.value, warm[i].change, 1e-14);
    }
    /* what limits are made of: fracture and fatigue of silicon, yield and fatigue of metals */
    const fw_device_limit_data *l = &si->limit;
    assert_false(l->weibull_strength.unknown || l->weibull_modulus.unknown ||
                 l->weibull_area.unknown);
    assert_relative(l->weibull_area.value, 1e-8, 1e-14);
    assert_true(l->offset_yield.unknown && l->film_yield.unknown);
    assert_relative(cu->limit.fatigue_strength.value, 110e6, 1e-14);
    assert_relative(cu->limit.ductility_exponent.value, -0.51, 1e-14);
    assert_true(cu->limit.weibull_area.unknown);
    const char *const tires[] = {"silicon-100", "copper-plated", "aluminium"};
    for (int i = 0; i < 3; i++) {
        l = &fw_device_material_find(&m, tires[i])->limit;
        assert_false(l->fatigue_strength.unknown || l->fatigue_cycles.unknown ||
                     l->fatigue_exponent.unknown);
        assert_true(l->fatigue_strength.source[0] && l->fatigue_strength.status >= FW_TYPICAL);
    }
    l = &fw_device_material_find(&m, "copper-film")->limit;
    assert_relative(l->film_yield.value, 116e6, 1e-14);
    assert_relative(l->film_yield_rise.value, 355e6, 1e-14);
    assert_relative(l->film_thickest.value, 3e-6, 1e-14);
    assert_null(fw_device_material_find(&m, NULL));
    fw_arena_free(arena);
}

/* three constants or none, stable; a stated modulus holds in every direction */
static void crystals(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    size_t n;
    char *xml = load(arena, "processes/base.xml", &n);
    fw_device_materials m;
    assert_int_equal(fw_device_materials_read(arena, "base.xml", xml, n, &diags, &m), FW_OK);
    const fw_device_material *si = fw_device_material_find(&m, "silicon-100");
    assert_true(fw_device_material_is_crystal(si));
    assert_false(fw_device_material_is_crystal(fw_device_material_find(&m, "copper-plated")));
    /* the pack's modulus is the harmonic mean of its own constants: 1/(S11 - S0/4) */
    double a = si->c11.value, b = si->c12.value, d = (a - b) * (a + 2 * b);
    double s0 = (a + 2 * b) / d - 0.5 / si->c44.value;
    assert_relative(si->youngs.value, 1 / ((a + b) / d - 0.25 * s0), 1e-4);
    fw_device_material_override none = {.density = {.value = 2300, .unit = "kg/m3"}}, stiff = none;
    none.youngs.unknown = none.poisson.unknown = none.strength.unknown = true;
    stiff.poisson.unknown = stiff.strength.unknown = true;
    stiff.youngs = (fw_quantity){.value = 160e9, .unit = "GPa"};
    const fw_device_material same = fw_device_material_with(si, &none),
                             other = fw_device_material_with(si, &stiff);
    assert_true(fw_device_material_is_crystal(&same));
    assert_false(fw_device_material_is_crystal(&other));
    const fw_device_material blank = {.id = "w"};
    assert_false(fw_device_material_is_crystal(&blank));

#define C(id, value) "<q id='" id "' value='" value "' u='1' unit='GPa' status='typical' src='s'/>"
    const char *const bad[] = {
        PACK("<material id='w'>" C("c11", "100") C("c12", "50") "</material>"),
        PACK("<material id='w'>" C("c11", "50") C("c12", "60") C("c44", "30") "</material>"),
        PACK("<material id='w'>" C("c11", "50") C("c12", "10") C("c44", "-3") "</material>")};
    const int number[] = {209, 209, 47};
    for (int i = 0; i < 3; i++) {
        diags = fw_diags_new(arena);
        assert_int_equal(fw_device_materials_read(arena, "t", bad[i], strlen(bad[i]), &diags, &m),
                         FW_INPUT);
        assert_int_equal(diags.item[0].number, number[i]);
    }
    fw_arena_free(arena);
}

static void what_is_absent_is_unknown(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const char *xml = PACK("<material id='w' name='wax'/>");
    fw_device_materials m;
    assert_int_equal(fw_device_materials_read(arena, "t", xml, strlen(xml), &diags, &m), FW_OK);
    const fw_device_material *w = fw_device_material_find(&m, "w");
    assert_true(w->youngs.unknown && w->poisson.unknown && w->density.unknown &&
                w->strength.unknown && w->loss.unknown && w->expansion.unknown &&
                w->modulus_change.unknown);
    assert_string_equal(w->modulus_change.id, "modulus-change");
    assert_string_equal(w->strength.id, "strength");
    fw_arena_free(arena);
}

static double mean_expansion(const fw_device_material *m, double change_K) {
    return fw_device_mean_expansion(&m->expansion, &m->expansion_slope, &m->expansion_curvature,
                                    change_K);
}

/* the mean over a change is that of Okada and Tokumaru's formula, integrated here, within 0.05 ppm/K from -150 to 300 K; of a
   material that does not say how it changes it is the coefficient itself */
static void expansion_goes_with_temperature(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    size_t n;
    char *xml = load(arena, "processes/base.xml", &n);
    fw_device_materials m;
    assert_int_equal(fw_device_materials_read(arena, "base.xml", xml, n, &diags, &m), FW_OK);
    const char *const crystal[] = {"silicon-100", "silicon-substrate"};
    for (int k = 0; k < 2; k++)
        for (int change = -150; change <= 300; change += 25) {
            double sum = 0;
            for (int i = 0; i < 1000; i++) {
                double T = 300 + change * (i + 0.5) / 1000;
                sum += 3.725 * (1 - exp(-5.88e-3 * (T - 124))) + 5.548e-4 * T;
            }
            const fw_device_material *si = fw_device_material_find(&m, crystal[k]);
            assert_near(mean_expansion(si, change), 1e-9 * sum, 0.05e-6);
        }
    const fw_device_material *cu = fw_device_material_find(&m, "copper-plated"),
                             *glass = fw_device_material_find(&m, "glass-carrier");
    /* over 100 K, of 16.7 and 17.6 ppm/K at its ends */
    assert_near(mean_expansion(cu, 100), 17.15e-6, 0.1e-6);
    assert_relative(mean_expansion(glass, 100), 3.3e-6, 1e-14);
    fw_arena_free(arena);
}

/* expansion may be negative, as that of silicon below 120 K; 1 % per kelvin is a
   slip of the unit */
static void changes_with_temperature(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
#define WARM(what)                                                                                 \
    PACK("<material id='w'><q id='expansion' " what " u='0' status='typical' "                     \
         "src='s'/></material>")
    static const struct {
        const char *xml;
        int number;
        double value;
    } pack[] = {{WARM("value='-0.4' unit='ppm/K'"), 0, -0.4e-6},
                {WARM("value='2.6e-6' unit='1/K'"), 0, 2.6e-6},
                {WARM("value='2.6e-6' unit='K^-1'"), 0, 2.6e-6},
                {WARM("value='2.6' unit='1/K'"), 47, 2.6},
                {WARM("value='2.6e-6' unit='1'"), 25, 2.6e-6}};
    for (size_t i = 0; i < sizeof pack / sizeof pack[0]; i++) {
        fw_diags diags = fw_diags_new(arena);
        fw_device_materials m;
        fw_status s =
            fw_device_materials_read(arena, "t", pack[i].xml, strlen(pack[i].xml), &diags, &m);
        assert_int_equal(s, pack[i].number ? FW_INPUT : FW_OK);
        if (pack[i].number) assert_int_equal(diags.item[0].number, pack[i].number);
        assert_relative(m.item[0].expansion.value, pack[i].value, 1e-14);
    }
    fw_arena_free(arena);
}

static void overrides_replace(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const char *xml = PACK("<material id='w'><q id='youngs' value='100' u='5' unit='GPa' "
                           "status='typical' src='s'/></material>");
    fw_device_materials m;
    assert_int_equal(fw_device_materials_read(arena, "t", xml, strlen(xml), &diags, &m), FW_OK);
    const char *device = DEVICE("<material ref=\"w\" youngs-modulus=\"160 GPa\"/>" ARM);
    const fw_device *d = sound(arena, device, NULL, 0);
    fw_device_material with = fw_device_material_with(&m.item[0], &d->material);
    assert_relative(with.youngs.value, 160e9, 1e-15);
    assert_string_equal(with.youngs.source, "device file");
    assert_string_equal(with.youngs.unit, "GPa");
    assert_true(with.density.unknown);
    fw_device_material_override none = {0}; /* never filled: changes nothing */
    assert_relative(fw_device_material_with(&m.item[0], &none).youngs.value, 100e9, 1e-15);
    fw_arena_free(arena);
}

static void limits_asked_and_overridden(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const char *xml = PACK("<material id='w'><q id='fatigue-exponent' value='-0.1' u='0.05' "
                           "unit='1' status='measured' src='s'/></material>");
    fw_device_materials m;
    assert_int_equal(fw_device_materials_read(arena, "t", xml, strlen(xml), &diags, &m), FW_OK);
    const char *device =
        DEVICE("<material ref=\"w\" weibull-strength=\"1.4 GPa\" weibull-modulus=\"12\" "
               "weibull-area=\"0.02 mm^2\" fatigue-strength=\"80 MPa\" "
               "fatigue-cycles=\"1e6\" film-thickest=\"2 um\"/><limits cycles=\"3e5\" "
               "failure-probability=\"1e-4\" survival=\"yes\"/>" ARM);
    const fw_device *d = sound(arena, device, NULL, 0);
    assert_relative(d->limits.cycles, 3e5, 1e-15);
    assert_relative(d->limits.failure_probability, 1e-4, 1e-15);
    assert_true(d->limits.survival);
    assert_relative(d->safety_factor, 1.5, 0);
    fw_device_material with = fw_device_material_with(&m.item[0], &d->material);
    const fw_device_limit_data *l = &with.limit;
    assert_relative(l->weibull_strength.value, 1.4e9, 1e-14);
    assert_relative(l->weibull_modulus.value, 12, 0);
    assert_relative(l->weibull_area.value, 2e-8, 1e-14);
    assert_relative(l->fatigue_strength.value, 80e6, 1e-14);
    assert_relative(l->film_thickest.value, 2e-6, 1e-14);
    assert_string_equal(l->weibull_area.source, "device file");
    assert_int_equal(l->weibull_area.status, FW_STATED);
    assert_relative(l->fatigue_exponent.value, -0.1, 0); /* the material's own stays */
    assert_int_equal(l->fatigue_exponent.status, FW_MEASURED);
    assert_true(l->ductility.unknown);
    assert_false(with.strength_stated);
    const fw_device *plain =
        sound(arena, DEVICE("<material ref=\"w\" strength=\"1 GPa\"/>" ARM), NULL, 0);
    assert_true(fw_device_material_with(&m.item[0], &plain->material).strength_stated);
    assert_true(isnan(plain->limits.cycles) && isnan(plain->limits.failure_probability));
    assert_false(plain->limits.survival);
    fw_device_material_override none = {0};
    assert_false(fw_device_material_with(&m.item[0], &none).strength_stated);
    fw_arena_free(arena);
}

static void memory_runs_out(void **state) {
    (void)state;
    const char *xml = PACK("<material id='w'><q id='youngs' value='100' u='5' unit='GPa' "
                           "status='typical' src='s'/></material><material/>");
    for (long n = 1;; n++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_device_materials m;
        fw_arena_fail_at(n, 1);
        fw_status s = fw_device_materials_read(arena, "t", xml, strlen(xml), &diags, &m);
        long used = fw_arena_count();
        fw_arena_fail_at(0, 0);
        assert_int_equal(s, used >= n ? FW_NOMEM : FW_INPUT);
        fw_arena_free(arena);
        if (used < n) break;
    }
}

/* a flow's own material counts as a whole, sources of either file hold, and what it does not give is the shared one's */
static void a_flow_gives_its_own(void **state) {
    (void)state;
    static const char shared[] = PACK(
        "<material id='a' name='A'><q id='youngs' value='100' u='1' unit='GPa' status='typical' "
        "src='s'/><q id='strength' value='400' u='1' unit='MPa' status='typical' src='s'/>"
        "</material><material id='b' name='B'/>"),
                      own[] =
                          "<process><source id='o'>own</source><material id='a' name='ours'>"
                          "<q id='strength' value='40' u='4' unit='MPa' status='measured' src='o'/>"
                          "<q id='density' value='8900' u='1' unit='kg/m3' status='typical' "
                          "src='s'/>"
                          "</material><material id='c' name='C'/></process>";
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_device_materials base, m;
    assert_int_equal(
        fw_device_materials_read(arena, "base.xml", shared, strlen(shared), &diags, &base), FW_OK);
    assert_int_equal(
        fw_device_materials_of_flow(arena, "f.xml", own, strlen(own), &base, &diags, &m), FW_OK);
    const fw_device_material *a = fw_device_material_find(&m, "a");
    assert_non_null(a);
    assert_string_equal(a->name, "ours");
    assert_near(a->strength.value, 40e6, 1);
    assert_string_equal(a->strength.source, "own");
    assert_string_equal(a->density.source, "src");
    assert_true(a->youngs.unknown);
    assert_non_null(fw_device_material_find(&m, "b"));
    assert_non_null(fw_device_material_find(&m, "c"));
    assert_int_equal(m.count, 3);
    assert_near(fw_device_material_find(&base, "a")->strength.value, 400e6, 1);
    fw_arena_free(arena);
}

/* silicon-100 of the pack: 180.3 GPa in every direction of the plane, of its constants; E that is stated alone leaves that,
   E and nu together are a layer that is alike in all directions, as a metal is */
static void biaxial_of_a_crystal(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    size_t n;
    char *xml = load(arena, "processes/base.xml", &n);
    fw_device_materials m;
    assert_int_equal(fw_device_materials_read(arena, "base.xml", xml, n, &diags, &m), FW_OK);
    const fw_device_material *si = fw_device_material_find(&m, "silicon-100"),
                             *cu = fw_device_material_find(&m, "copper-plated");
    const double plane = 165.7e9 + 63.9e9 - 2 * 63.9e9 * 63.9e9 / 165.7e9;
    assert_relative(plane, 180.316e9, 1e-5);
    assert_relative(fw_device_material_biaxial_Pa(si), plane, 1e-14);
    assert_relative(fw_device_material_biaxial_Pa(cu), 115e9 / 0.66, 1e-14);
    fw_device_material_override both = {.youngs = {.value = 169e9, .unit = "GPa"},
                                        .poisson = {.value = 0.064, .unit = "1"},
                                        .density.unknown = true,
                                        .strength.unknown = true},
                                alone = both, nu = both;
    alone.poisson.unknown = nu.youngs.unknown = true;
    fw_device_material of = fw_device_material_with(si, &both);
    assert_relative(fw_device_material_biaxial_Pa(&of), 169e9 / 0.936, 1e-14);
    of = fw_device_material_with(si, &alone);
    assert_false(fw_device_material_is_crystal(&of));
    assert_relative(fw_device_material_biaxial_Pa(&of), plane, 1e-14);
    of = fw_device_material_with(si, &nu);
    assert_relative(fw_device_material_biaxial_Pa(&of), plane, 1e-14);
    of = *cu, of.poisson.unknown = true;
    assert_true(isnan(fw_device_material_biaxial_Pa(&of)));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_pack_is_sound),
        cmocka_unit_test(what_is_absent_is_unknown),
        cmocka_unit_test(crystals),
        cmocka_unit_test(expansion_goes_with_temperature),
        cmocka_unit_test(changes_with_temperature),
        cmocka_unit_test(overrides_replace),
        cmocka_unit_test(limits_asked_and_overridden),
        cmocka_unit_test(memory_runs_out),
        cmocka_unit_test(a_flow_gives_its_own),
        cmocka_unit_test(biaxial_of_a_crystal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
