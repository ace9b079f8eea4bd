/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The quick look of the page: the same numbers as the program gives, shapes that fit together,
   energies that balance, places of mistakes, and requests that are not what they should be. */
#include "live_case.h"
#include <flexwright.h>

static fw_plan_live *live;

static int begin(void **state) {
    (void)state;
    live = live_new();
    return 0;
}

static int end(void **state) {
    (void)state;
    fw_plan_live_free(live);
    return 0;
}

static json_t *preview(const char *file, const char *more) {
    return ask_file(live, fw_plan_live_preview, file, more);
}

static const json_t *at(const json_t *object, const char *key) {
    return json_object_get(object, key);
}

static const json_t *of(const json_t *array, size_t i) {
    return json_array_get(array, i);
}

/* ---- against the library, which is what the commands print ---- */

static json_t *document(const char *file, const char *corners, const char *hinge_model, int which) {
    char path[512];
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.samples = 401;
    o.corners = corners;
    o.hinge_model = hinge_model;
    fw_design *design = fw_design_new(&o);
    snprintf(path, sizeof path, "%s/%s", FW_TEST_SOURCE_DIR, file);
    assert_int_equal(fw_design_read(design, path), FW_STATUS_OK);
    assert_int_equal(which == FW_DOCUMENT_VERDICT_JSON ? fw_design_judge(design)
                                                       : fw_design_simulate(design),
                     FW_STATUS_OK);
    const char *text;
    size_t n;
    assert_int_equal(fw_design_document(design, which, &text, &n), FW_STATUS_OK);
    json_t *root = json_loadb(text, n, 0, NULL);
    assert_non_null(root);
    fw_design_free(design);
    return root;
}

/* the verdict of `check --corners none`, of `check`, and with pins: digit by digit */
static void the_verdict_is_that_of_check(void **state) {
    (void)state;
    static const struct {
        const char *options, *corners, *hinge_model;
        bool provisional;
    } row[] = {{"\"options\":{\"detail\":\"full\"}", "none", NULL, true},
               {"\"options\":{\"detail\":\"full\",\"corners\":\"auto\"}", "auto", NULL, false},
               {NULL, "none", "revolute", true}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        json_t *mine = preview(SIX_BAR, row[i].options);
        json_t *want =
            document(SIX_BAR, row[i].corners, row[i].hinge_model, FW_DOCUMENT_VERDICT_JSON);
        json_t *have = json_object_get(mine, "verdict");
        assert_string_equal(text_at(mine, "status"), "ok");
        assert_string_equal(text_at(mine, "decision"), text_at(want, "verdict"));
        assert_true(json_is_true(at(mine, "provisional")) == row[i].provisional);
        assert_int_equal(json_integer_value(at(mine, "exit_status")), 0);
        for (const char **key = (const char *[]){"advice", "advice_note", "advice_parameters",
                                                 NULL};
             *key; key++) {
            json_object_del(have, *key);
            json_object_del(want, *key);
        }
        assert_true(json_equal(have, want));
        json_decref(mine);
        json_decref(want);
    }
}

static void the_motion_is_that_of_simulate(void **state) {
    (void)state;
    json_t *mine = preview(SIX_BAR, "\"options\":{\"detail\":\"full\"}");
    json_t *want = document(SIX_BAR, "none", NULL, FW_DOCUMENT_SIMULATE_JSON);
    const json_t *motion = at(mine, "motion"), *peaks = at(motion, "peaks");
    for (size_t i = 0; i < 6; i++) {
        const json_t *a = of(peaks, i), *b = of(at(want, "peaks"), i);
        assert_string_equal(text_at(a, "pin"), text_at(b, "hinge"));
        assert_true(real_at(a, "angle_rad") == real_at(b, "angle_rad"));
        assert_relative(real_at(a, "t_s"), real_at(b, "t_s"), 1e-5);
        assert_relative(real_at(a, "error_rad"), real_at(b, "error_rad"), 1e-5);
    }
    assert_string_equal(text_at(motion, "method"), text_at(want, "method"));
    assert_string_equal(text_at(motion, "integrator"), text_at(want, "integrator"));
    assert_true(json_equal(at(at(motion, "stats"), "steps"), at(at(want, "stats"), "steps")));
    assert_int_equal(json_array_size(at(mine, "ledger")), json_array_size(at(want, "effects")));
    const json_t *final = of(at(motion, "q"), 400), *q = at(at(want, "final"), "q");
    for (int b = 0; b < 5; b++) {
        const json_t *triple = at(q, text_at(of(at(mine, "bodies"), (size_t)b), "id"));
        for (int k = 0; k < 3; k++)
            assert_near(item(final, 3 * b + k), item(triple, k), k == 2 ? 6e-9 : 1e-11);
    }
    json_decref(mine);
    json_decref(want);
}

/* never better than the whole truth: where corners or a better model reject, the quick answer is
   provisional */
static void a_quick_answer_says_what_it_is_without(void **state) {
    (void)state;
    json_t *mine = preview(SIX_BAR, "\"set\":{\"limits/@safety-factor\":\"12\"}");
    assert_string_equal(text_at(mine, "decision"), "reject");
    assert_false(json_is_true(at(mine, "provisional")));
    assert_int_equal(json_integer_value(at(mine, "exit_status")), 1);
    json_decref(mine);
    mine = preview(SIX_BAR, NULL);
    assert_true(json_is_true(at(mine, "provisional")));
    bool corners = false, pins = false;
    for (size_t i = 0; i < json_array_size(at(mine, "left_out")); i++) {
        const json_t *l = of(at(mine, "left_out"), i);
        bool could = json_is_true(at(l, "could_reject"));
        corners = corners || (strcmp(text_at(l, "what"), "corners") == 0 && could);
        pins = pins || (strcmp(text_at(l, "what"), "hinge-model") == 0 && could);
    }
    assert_true(corners && pins);
    json_decref(mine);
}

/* ---- shapes and motion fit together ---- */

static void place(const json_t *q, int body, const json_t *local_um, double to[2]) {
    double x = 1e-6 * item(local_um, 0), y = 1e-6 * item(local_um, 1);
    double c = 1, s = 0, at_x = 0, at_y = 0;
    if (body >= 0) {
        c = cos(item(q, 3 * body + 2)), s = sin(item(q, 3 * body + 2));
        at_x = item(q, 3 * body), at_y = item(q, 3 * body + 1);
    }
    to[0] = at_x + c * x - s * y;
    to[1] = at_y + s * x + c * y;
}

static void joints_stay_closed_and_angles_are_those_of_the_bodies(void **state) {
    (void)state;
    json_t *p = preview(SIX_BAR, NULL);
    const json_t *motion = at(p, "motion"), *pins = at(p, "pins"), *bodies = at(p, "bodies");
    assert_int_equal(json_array_size(pins), 6);
    assert_int_equal(json_array_size(bodies), 6);
    assert_true(json_is_true(at(of(bodies, 5), "fixed")));
    for (size_t row = 0; row < 401; row += 8) {
        const json_t *q = of(at(motion, "q"), row), *angle = of(at(motion, "angle_rad"), row);
        for (size_t i = 0; i < 6; i++) {
            const json_t *pin = of(pins, i);
            int a = (int)item(at(pin, "bodies"), 0), b = (int)item(at(pin, "bodies"), 1);
            double on_a[2], on_b[2];
            place(q, a, at(pin, "on_a_um"), on_a);
            place(q, b, at(pin, "on_b_um"), on_b);
            assert_near(hypot(on_a[0] - on_b[0], on_a[1] - on_b[1]), 0, 3e-9); /* of the rounding */
            double turn = (b < 0 ? 0 : item(q, 3 * b + 2)) - (a < 0 ? 0 : item(q, 3 * a + 2));
            assert_near(item(angle, (int)i), turn - real_at(pin, "free_angle_rad"), 3e-8);
        }
    }
    json_decref(p);
}

/* the first point of a path, um */
static void first_point(const char *path, double to[2]) {
    assert_int_equal(sscanf(path, "M%lf %lf", &to[0], &to[1]), 2);
}

/* a body's outline, put where the body is drawn, lies in the picture's box; both ends of a flexure
   are where its bodies have them, and its centre line runs between them */
static void shapes_are_in_place(void **state) {
    (void)state;
    static const char *const file[] = {SIX_BAR, "docs/gallery/leaf-four-bar/device.xml",
                                       "docs/gallery/free-form-four-bar/device.xml"};
    for (size_t f = 0; f < 3; f++) {
        json_t *p = preview(file[f], "\"options\":{\"samples\":2}");
        const json_t *bodies = at(p, "bodies"), *box = at(p, "box_um");
        const json_t *rest = of(at(at(p, "motion"), "q"), 0);
        size_t moving = json_array_size(bodies) - 1;
        for (size_t b = 0; b < moving; b++) {
            const json_t *body = of(bodies, b);
            assert_true(json_is_true(at(body, "drawn")));
            assert_true(json_array_size(at(body, "outline")) > 0);
            double m[2], w[2];
            first_point(json_string_value(of(at(body, "outline"), 0)), m);
            json_t *local = json_pack("[f,f]", m[0], m[1]);
            place(rest, (int)b, local, w);
            json_decref(local);
            for (int k = 0; k < 2; k++)
                assert_true(1e6 * w[k] >= item(box, k) - 0.01 &&
                            1e6 * w[k] <= item(box, k + 2) + 0.01);
            for (int k = 0; k < 3; k++)
                assert_near(item(at(body, "rest"), k), item(rest, 3 * (int)b + k), 1e-8);
        }
        const json_t *flexures = at(p, "flexures");
        assert_true(json_array_size(flexures) >= 4);
        for (size_t i = 0; i < json_array_size(flexures); i++) {
            const json_t *x = of(flexures, i), *ends = at(x, "ends");
            const char *line = text_at(x, "centre_line"), *last = strrchr(line, 'L');
            double start[2], stop[2], a[2], b[2];
            first_point(line, start);
            assert_non_null(last);
            assert_int_equal(sscanf(last, "L%lf %lf", &stop[0], &stop[1]), 2);
            place(rest, (int)item(at(x, "bodies"), 0), at(of(ends, 0), "at_um"), a);
            place(rest, (int)item(at(x, "bodies"), 1), at(of(ends, 1), "at_um"), b);
            for (int k = 0; k < 2; k++) {
                assert_near(1e6 * a[k], start[k], 0.01);
                assert_near(1e6 * b[k], stop[k], 0.01);
            }
            assert_true(json_array_size(at(x, "points")) % 3 == 0);
        }
        json_decref(p);
    }
}

/* rates: velocities of bodies, and of probes that are lengths or angles, which the values follow: between two samples a
   value changes by the mean of both rates, but for a twelfth of dt^3 times the third derivative; where the bead is
   met more, so squares are summed */
static void rates_are_those_of_the_values(void **state) {
    (void)state;
    json_t *plain = ask_file(live, fw_plan_live_preview, "tests/data/probes/gripper.xml", NULL),
           *root = ask_file(live, fw_plan_live_preview, "tests/data/probes/gripper.xml",
                            "\"rates\":true,\"options\":{\"samples\":2001}"),
           *motion = json_object_get(root, "motion"), *t = json_object_get(motion, "t_s"), *probe;
    assert_null(json_object_get(json_object_get(plain, "motion"), "v"));
    assert_int_equal(json_array_size(json_object_get(motion, "v")), json_array_size(t));
    size_t i;
    int compared = 0;
    json_array_foreach(json_object_get(motion, "probes"), i, probe) {
        const json_t *value = json_object_get(probe, "value"), *rate = json_object_get(probe, "rate");
        const bool has = strcmp(text_at(probe, "unit"), "m") == 0 || strcmp(text_at(probe, "unit"), "rad") == 0;
        assert_true(has ? json_is_array(rate) : json_is_null(rate));
        double most = 0, off = 0;
        for (int k = 0; has && k + 1 < (int)json_array_size(t); k++) {
            double dt = item(t, k + 1) - item(t, k), by = (item(rate, k) + item(rate, k + 1)) / 2 * dt;
            most += by * by;
            off += pow(item(value, k + 1) - item(value, k) - by, 2);
        }
        if (has && !(off <= 1e-4 * most))
            fail_msg("%s: off by %g", text_at(probe, "id"), sqrt(off / most));
        compared += has;
    }
    assert_int_equal(compared, 3); /* opening, swing and tip */
    json_decref(plain);
    json_decref(root);
}

/* T + V + D - W stays what it is, and what is in the document is a motion: dT/dt is bounded */
static void energies_balance(void **state) {
    (void)state;
    static const char *const file[] = {SIX_BAR, "docs/gallery/comb-stage/device.xml",
                                       "docs/mechanisms/toggle.xml"};
    for (size_t f = 0; f < 3; f++) {
        json_t *p = preview(file[f], NULL);
        const json_t *motion = at(p, "motion"), *e = at(motion, "energy");
        assert_true(json_is_object(e));
        double most = 0, first = 0, worst = 0, error = real_at(at(motion, "stats"), "energy_error");
        for (int i = 0; i < 401; i++) {
            double t = item(at(e, "kinetic_J"), i), v = item(at(e, "potential_J"), i);
            double d = item(at(e, "dissipated_J"), i), w = item(at(e, "work_J"), i);
            assert_true(t >= 0 && d >= -1e-9 * most);
            most = fmax(most, fmax(t + fabs(v) + d, fabs(w)));
            if (i == 0) first = t + v + d - w;
            worst = fmax(worst, fabs(t + v + d - w - first));
            assert_true(item(at(motion, "constraint_norm"), i) < 1e-10);
        }
        /* rows are on the dense output, and have seven digits */
        assert_true(most > 0 && worst <= most * (2e-6 + 10 * error));
        json_decref(p);
    }
}

/* asking for energies moves nothing */
static void energies_cost_no_digit(void **state) {
    (void)state;
    json_t *with = preview(SIX_BAR, NULL);
    json_t *without =
        preview(SIX_BAR, "\"options\":{\"detail\":\"full\",\"hinge_model\":\"revolute\"}");
    json_t *a = json_object_get(json_object_get(with, "verdict"), "hinges");
    json_t *b = json_object_get(json_object_get(without, "verdict"), "hinges");
    assert_true(json_equal(a, b));
    json_decref(with);
    json_decref(without);
}

/* ---- options, scenes, parameters ---- */

static void options_are_followed(void **state) {
    (void)state;
    json_t *p = preview(SIX_BAR, "\"options\":{\"scene\":\"gentle-step\",\"method\":\"minimal\","
                                 "\"integrator\":\"radau5\",\"samples\":11,\"effects\":\"all\"}");
    const json_t *motion = at(p, "motion");
    assert_string_equal(text_at(motion, "scene"), "gentle-step");
    assert_string_equal(text_at(motion, "flow"), "copper-on-porous-silicon");
    assert_string_equal(text_at(motion, "method"), "minimal");
    assert_string_equal(text_at(motion, "integrator"), "radau5");
    assert_int_equal(json_array_size(at(motion, "t_s")), 11);
    json_decref(p);
}

static void parameters_have_unit_bounds_and_place(void **state) {
    (void)state;
    json_t *p = preview(SIX_BAR, "\"set\":{\"arc\":\"250 deg\"}");
    const json_t *arc = of(at(p, "parameters"), 0);
    assert_string_equal(text_at(arc, "name"), "arc");
    assert_near(real_at(arc, "value"), 250, 1e-9);
    assert_near(real_at(arc, "minimum"), 140, 1e-9);
    assert_near(real_at(arc, "maximum"), 260, 1e-9);
    assert_string_equal(text_at(arc, "unit"), "deg");
    assert_string_equal(text_at(arc, "written"), "240 deg");
    assert_string_equal(text_at(arc, "path"), "parameter[arc]/@value");
    assert_true(json_is_true(at(arc, "overridden")) && json_is_false(at(arc, "derived")));
    assert_int_equal(json_integer_value(at(arc, "line")), 6);
    json_decref(p);
}

/* setting a parameter and writing it into the text are the same */
static void set_and_edit_agree(void **state) {
    (void)state;
    json_t *by_set = preview(SIX_BAR, "\"set\":{\"arc\":\"250 deg\"}");
    json_t *edited = ask_file(live, fw_plan_live_edit, SIX_BAR,
                              "\"changes\":[{\"path\":\"arc\",\"value\":\"250 deg\"}]");
    assert_string_equal(text_at(edited, "status"), "ok");
    json_t *request = json_pack("{s:s}", "text", text_at(edited, "text"));
    char *dump = json_dumps(request, 0);
    json_t *by_text = ask(live, fw_plan_live_preview, dump, FW_OK);
    assert_true(json_equal(at(by_set, "verdict"), at(by_text, "verdict")));
    assert_true(json_equal(at(at(by_set, "motion"), "q"), at(at(by_text, "motion"), "q")));
    free(dump);
    json_decref(request), json_decref(by_text), json_decref(edited), json_decref(by_set);
}

/* ---- descriptions that are wrong ---- */

static json_t *look(const char *xml, fw_status status) {
    json_t *request = json_pack("{s:s}", "text", xml);
    char *dump = json_dumps(request, 0);
    json_t *p = ask(live, fw_plan_live_preview, dump, status);
    free(dump);
    json_decref(request);
    return p;
}

static void mistakes_have_their_place(void **state) {
    (void)state;
    json_t *p = look("<device xmlns=\"urn:flexwright:device:1\" name=\"d\">\n  <flexur id=\"A\"/>\n"
                     "  <parameter name=\"a\" value=\"1 furlong\"/>\n</device>",
                     FW_OK);
    assert_string_equal(text_at(p, "status"), "invalid");
    assert_int_equal(json_integer_value(at(p, "exit_status")), 3);
    assert_true(json_is_null(at(p, "motion")) && json_is_null(at(p, "verdict")));
    int lines = 0;
    for (size_t i = 0; i < json_array_size(at(p, "diagnostics")); i++) {
        const json_t *d = of(at(p, "diagnostics"), i);
        assert_true(json_is_true(at(d, "in_text")) && strncmp(text_at(d, "code"), "FW-D", 4) == 0);
        assert_true(text_at(d, "message")[0] && text_at(d, "explain")[0]);
        lines |= 1 << json_integer_value(at(d, "line"));
        assert_true(json_integer_value(at(d, "column")) > 0);
    }
    assert_true((lines & (1 << 2)) && (lines & (1 << 3)));
    json_decref(p);
    p = look("", FW_OK);
    assert_string_equal(text_at(p, "status"), "invalid");
    json_decref(p);
    p = look("<device xmlns=\"urn:flexwright:device:1\" name=\"d\"", FW_OK);
    assert_string_equal(text_at(p, "status"), "invalid");
    json_decref(p);
}

/* a mechanism without hinges cannot be judged, but moved and drawn; one without scenes drawn */
static void what_can_be_done_is_done(void **state) {
    (void)state;
    json_t *p = preview("docs/mechanisms/squeezer.xml", NULL);
    assert_string_equal(text_at(p, "status"), "ok");
    assert_true(json_is_null(at(p, "verdict")) && json_is_object(at(p, "motion")));
    assert_true(json_array_size(at(of(at(p, "bodies"), 0), "outline")) > 0);
    assert_true(json_is_false(at(of(at(p, "bodies"), 0), "drawn")));
    json_decref(p);
    p = look("<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><mechanism><body id=\"arm\" "
             "mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"1 mm\" y=\"0 mm\"/><revolute id=\"r\" "
             "a=\"ground\" b=\"arm\" b-x=\"-1 mm\"/></mechanism></device>",
             FW_OK);
    assert_int_equal(json_array_size(at(p, "bodies")), 2);
    assert_int_equal(json_array_size(at(p, "pins")), 1);
    json_decref(p);
}

/* a change that cannot be made leaves no text, and says where it was wanted */
static void edits_that_fail_say_so(void **state) {
    (void)state;
    json_t *e =
        ask_file(live, fw_plan_live_edit, SIX_BAR,
                 "\"changes\":[{\"path\":\"arc\",\"value\":\"1\"},{\"path\":\"bow\",\"value\":"
                 "\"1\"}]");
    assert_string_equal(text_at(e, "status"), "invalid");
    assert_true(json_is_null(at(e, "text")));
    assert_string_equal(text_at(of(at(e, "diagnostics"), 0), "code"), "FW-D288");
    json_decref(e);
}

/* ---- the table ---- */

static const json_t *named(const json_t *list, const char *name) {
    for (size_t i = 0; i < json_array_size(list); i++)
        if (strcmp(text_at(of(list, i), "name"), name) == 0) return of(list, i);
    fail_msg("no %s", name);
    return NULL;
}

enum { /* the rows of the table */
#define FW_EFFECT(name)              +1
#define FW_EFFECT_ELEMENT(name, ...) +1
    effects =
#include "device/effects.def"
#undef FW_EFFECT_ELEMENT
#undef FW_EFFECT
};

static void the_table_has_everything(void **state) {
    (void)state;
    fw_plan_live_answer a = fw_plan_live_table(live);
    assert_int_equal(a.status, FW_OK);
    json_t *t = json_loads(a.text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(t);
    const json_t *elements = at(t, "elements");
    const json_t *flexure = named(elements, "flexure");
    assert_string_equal(text_at(flexure, "parent"), "device");
    assert_string_equal(text_at(flexure, "key"), "id");
    const json_t *length = named(at(flexure, "attributes"), "length");
    assert_string_equal(text_at(length, "type"), "number");
    assert_string_equal(text_at(length, "unit"), "um");
    assert_true(real_at(length, "minimum") < real_at(length, "maximum"));
    const json_t *kind = named(at(flexure, "attributes"), "kind");
    assert_int_equal(json_array_size(at(kind, "choices")), 3);
    assert_true(json_is_true(at(kind, "required")));
    size_t attributes = 0;
    for (size_t i = 0; i < json_array_size(elements); i++) {
        const json_t *list = at(of(elements, i), "attributes");
        assert_true(text_at(of(elements, i), "sentence")[0]);
        attributes += json_array_size(list);
        for (size_t k = 0; k < json_array_size(list); k++)
            assert_true(text_at(of(list, k), "sentence")[0] && text_at(of(list, k), "type")[0]);
    }
    assert_true(json_array_size(elements) > 30 && attributes > 200);
    named(at(t, "methods"), "chain");
    named(at(t, "integrators"), "dop853");
    named(at(t, "stabilisations"), "projection");
    named(at(t, "hinge_models"), "elastica");
    named(at(t, "effects"), "gravity");
    named(at(t, "mask_formats"), "gds");
    assert_int_equal(json_array_size(at(t, "effects")), effects);
    assert_near(real_at(at(at(t, "limits"), "accuracy"), "default"), 1e-3, 1e-15);
    json_decref(t);
}

/* a library user has the same */
static void documents_of_the_library(void **state) {
    (void)state;
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    fw_design *design = fw_design_new(&o);
    const char *text;
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_TABLE_JSON, &text, NULL), FW_STATUS_OK);
    fw_plan_live_answer a = fw_plan_live_table(live);
    assert_string_equal(text, a.text);
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_PREVIEW_JSON, &text, NULL),
                     FW_STATUS_USAGE);
    assert_int_equal(fw_design_read(design, FW_TEST_SOURCE_DIR "/" SIX_BAR), FW_STATUS_OK);
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_PREVIEW_JSON, &text, NULL),
                     FW_STATUS_OK);
    json_t *p = json_loads(text, 0, NULL);
    assert_true(json_is_null(at(p, "motion")) && json_is_null(at(p, "verdict")));
    assert_int_equal(json_array_size(at(p, "flexures")), 6);
    json_decref(p);
    assert_int_equal(fw_design_simulate(design), FW_STATUS_OK);
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_PREVIEW_JSON, &text, NULL),
                     FW_STATUS_OK);
    p = json_loads(text, 0, NULL);
    assert_int_equal(json_array_size(at(at(p, "motion"), "t_s")), 1001);
    assert_true(json_is_object(at(at(p, "motion"), "energy")));
    json_decref(p);
    fw_design_free(design);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_verdict_is_that_of_check),
        cmocka_unit_test(the_motion_is_that_of_simulate),
        cmocka_unit_test(a_quick_answer_says_what_it_is_without),
        cmocka_unit_test(joints_stay_closed_and_angles_are_those_of_the_bodies),
        cmocka_unit_test(shapes_are_in_place),
        cmocka_unit_test(rates_are_those_of_the_values),
        cmocka_unit_test(energies_balance),
        cmocka_unit_test(energies_cost_no_digit),
        cmocka_unit_test(options_are_followed),
        cmocka_unit_test(parameters_have_unit_bounds_and_place),
        cmocka_unit_test(set_and_edit_agree),
        cmocka_unit_test(mistakes_have_their_place),
        cmocka_unit_test(what_can_be_done_is_done),
        cmocka_unit_test(edits_that_fail_say_so),
        cmocka_unit_test(the_table_has_everything),
        cmocka_unit_test(documents_of_the_library),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
