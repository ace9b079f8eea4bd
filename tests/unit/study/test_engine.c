/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples of a study, one after the other in one design, are to the last bit what each is by itself, whatever came
   before: random designs of several devices, among them such as are rejected, undecided, cannot be drawn, cannot be
   read, or name other packs. FW_TEST_DESIGNS: so many of the six-bar in place of the usual number. */
#include "chance/random.h"
#include "study/study_parts.h"
#include "test.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define GALLERY FW_TEST_SOURCE_DIR "/docs/gallery/"

/* the reference six-bar with what is to differ as parameters */
static const char six_bar[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"six\">\n"
    "<parameter name=\"push\" value=\"0.25 mN\"/><parameter name=\"link\" value=\"120 um\"/>\n"
    "<parameter name=\"thin\" value=\"0 um\"/><parameter name=\"arc\" value=\"240 deg\"/>\n"
    "<material ref=\"silicon-100\" youngs-modulus=\"169 GPa\" strength=\"2.5 GPa\" thickness=\"50 "
    "um\"/>\n"
    "<limits safety-factor=\"1.5\"/>%s\n"
    "<flexure id=\"A\" kind=\"csfh\" length=\"300 um\" angle=\"arc\" width=\"9 um - thin\" gap=\"8 "
    "um\"/>\n"
    "<flexure id=\"B\" kind=\"csfh\" length=\"250 um\" angle=\"arc\" width=\"8.5 um\" gap=\"8 "
    "um\"/>\n"
    "<flexure id=\"C\" kind=\"csfh\" length=\"200 um\" angle=\"arc\" width=\"8 um\" gap=\"8 "
    "um\"/>\n"
    "<flexure id=\"D\" kind=\"csfh\" length=\"240 um\" angle=\"arc\" width=\"8 um\" gap=\"8 "
    "um\"/>\n"
    "<flexure id=\"E\" kind=\"csfh\" length=\"350 um\" angle=\"arc\" width=\"9 um\" gap=\"8 "
    "um\"/>\n"
    "<flexure id=\"F\" kind=\"csfh\" length=\"400 um\" angle=\"arc\" width=\"10 um\" gap=\"8 "
    "um\"/>\n"
    "<six-bar>\n"
    "<hinge at=\"A\" x=\"0.70 mm\" y=\"0.15 mm\" flexure=\"A\" stiffness=\"1.711e-6 N m/rad\" "
    "damping=\"7e-12 N m s/rad\"/>\n"
    "<hinge at=\"B\" x=\"0.20 mm\" y=\"1.40 mm\" flexure=\"B\" stiffness=\"1.730e-6 N m/rad\" "
    "damping=\"6e-12 N m s/rad\"/>\n"
    "<hinge at=\"C\" x=\"0.80 mm\" y=\"2.70 mm\" flexure=\"C\" stiffness=\"1.803e-6 N m/rad\" "
    "damping=\"5e-12 N m s/rad\"/>\n"
    "<hinge at=\"D\" x=\"2.20 mm\" y=\"2.75 mm\" flexure=\"D\" stiffness=\"1.502e-6 N m/rad\" "
    "damping=\"5.5e-12 N m s/rad\"/>\n"
    "<hinge at=\"E\" x=\"2.85 mm\" y=\"1.45 mm\" flexure=\"E\" stiffness=\"1.467e-6 N m/rad\" "
    "damping=\"6.5e-12 N m s/rad\"/>\n"
    "<hinge at=\"F\" x=\"2.30 mm\" y=\"0.15 mm\" flexure=\"F\" stiffness=\"1.760e-6 N m/rad\" "
    "damping=\"7.5e-12 N m s/rad\"/>\n"
    "<link id=\"AB\" width=\"link\" mass=\"0.0188 mg\" inertia=\"0.00286 mg mm^2\"/>\n"
    "<link id=\"BC\" width=\"link\" mass=\"0.0200 mg\" inertia=\"0.00344 mg mm^2\"/>\n"
    "<platform id=\"CD\" width=\"1.40 mm\" height=\"0.40 mm\" x=\"1.50 mm\" y=\"2.875 mm\" "
    "mass=\"0.0653 mg\" inertia=\"0.01155 mg mm^2\"/>\n"
    "<link id=\"DE\" width=\"link\" mass=\"0.0203 mg\" inertia=\"0.00360 mg mm^2\"/>\n"
    "<link id=\"EF\" width=\"link\" mass=\"0.0197 mg\" inertia=\"0.00330 mg mm^2\"/>\n"
    "</six-bar>\n"
    "<scene name=\"step\" duration=\"3 ms\"><force on=\"CD\" fx=\"push\" "
    "fy=\"-0.56*push\"/></scene>\n"
    "<die width=\"5.6 mm\" height=\"5 mm\" title=\"SIX\"/>\n"
    "</device>\n";

static const char hinges[] =
    "<respond name=\"U\" value=\"governing.utilisation\"/>"
    "<respond name=\"band\" value=\"governing.utilisation_band[1]\"/>"
    "<respond name=\"least\" value=\"hinges[*].utilisation\" take=\"least\"/>"
    "<respond name=\"angle\" value=\"hinges[0].peak_angle_rad\"/>";
static const char any[] = /* whatever governs */
    "<respond name=\"least\" value=\"hinges[*].utilisation\" take=\"least\"/>"
    "<respond name=\"most\" value=\"hinges[*].utilisation\" take=\"largest\"/>"
    "<respond name=\"high\" value=\"hinges[0].utilisation_band[1]\"/>";
static const char more[] =
    "<respond name=\"U\" value=\"governing.utilisation\"/>"
    "<respond name=\"near\" value=\"clearances[*].clearance_m\" take=\"least\"/>"
    "<respond name=\"give\" value=\"hinge_model[*].bodies_give\" take=\"largest\"/>";

typedef struct room {
    char directory[256], device[288], file[288];
} room;

static void write_to(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fputs(text, file) >= 0, 1);
    assert_int_equal(fclose(file), 0);
}

/* flows: elements of the device */
static room room_new(const char *flows) {
    room r;
    char text[6000];
    const char *parent = getenv("TMPDIR");
    int size = snprintf(r.directory, sizeof r.directory, "%s/fw-engine-XXXXXX", parent ? parent : "/tmp");
    assert_true(size > 0 && (size_t)size < sizeof r.directory);
    assert_non_null(mkdtemp(r.directory));
    snprintf(r.device, sizeof r.device, "%s/device.xml", r.directory);
    snprintf(r.file, sizeof r.file, "%s/study.xml", r.directory);
    snprintf(text, sizeof text, six_bar, flows);
    write_to(r.device, text);
    return r;
}

static void room_free(const room *r) {
    unlink(r->device), unlink(r->file), rmdir(r->directory);
}

static fw_study *open_study(const room *r, const char *device, const char *as, const char *rows,
                            const char *respond) {
    char text[4096];
    fw_study *study;
    fw_study_options o = {.design = fw_design_options_default(), .file = r->file, .jobs = 1};
    o.design.data_directory = FW_TEST_SOURCE_DIR;
    snprintf(text, sizeof text,
             "<study xmlns=\"urn:flexwright:study:1\" name=\"s\" kind=\"sweep\" points=\"sobol\" "
             "as=\"%s\" "
             "device=\"%s\">%s%s</study>\n",
             as, device, rows, respond);
    write_to(r->file, text);
    fw_status status = fw_study_open(&o, &study);
    for (size_t i = 0; status != FW_OK && i < study->diags.count; i++)
        print_message("%s\n", study->diags.item[i].message);
    assert_int_equal(status, FW_OK);
    return study;
}

static bool same_number(double a, double b) {
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

typedef struct tally {
    int state[6]; /* by decision; 5: could not be judged */
    int by_itself;
} tally;

/* sample i of a sequence of random ones */
static void draw(const fw_study *study, uint64_t sequence, int i, fw_study_sample *sample) {
    for (int k = 0; k < study->ninput; k++)
        assert_int_equal(
            fw_study_input_at(&study->input[k],
                              fw_chance_uniform(sequence, (uint64_t)i, (uint64_t)k), 6,
                              sample->text[k], &sample->value[k]),
            FW_OK);
}

/* n random samples, each by both ways */
static tally compare(fw_study *study, int n) {
    tally t = {{0}, 0};
    fw_study_sample one, other;
    assert_int_equal(fw_study_sample_new(study->arena, study, &one), FW_OK);
    assert_int_equal(fw_study_sample_new(study->arena, study, &other), FW_OK);
    for (int i = 0; i < n; i++) {
        bool changed = false;
        draw(study, 22, i, &one);
        one.i = i;
        fw_study_sample_copy(study, &one, &other);
        assert_int_equal(fw_study_evaluate(study, NULL, &one, &changed), FW_OK);
        assert_int_equal(fw_study_evaluate_alone(study, NULL, &other, &changed), FW_OK);
        assert_false(changed);
        bool same = one.run == other.run && one.decision == other.decision &&
                    same_number(one.used, other.used) && strcmp(one.why, other.why) == 0;
        for (int k = 0; k < study->nresponse; k++) {
            const bool alike = same_number(one.response[k], other.response[k]);
            if (!alike)
                print_message("%s: %.17g, by itself %.17g\n", study->response[k].asked->name,
                              one.response[k], other.response[k]);
            same = same && alike;
        }
        if (!same)
            fail_msg("sample %d (%s %s %s): %d %d, used %.17g %.17g, %.17g %.17g, '%s' '%s'", i,
                     one.text[0], study->ninput > 1 ? one.text[1] : "",
                     study->ninput > 2 ? one.text[2] : "", one.decision, other.decision, one.used,
                     other.used, one.response[0], other.response[0], one.why, other.why);
        t.state[one.run ? one.decision : 5]++;
    }
    return t;
}

static void random_six_bars(void **state) {
    (void)state;
    const char *asked = getenv("FW_TEST_DESIGNS");
    const int n = asked ? atoi(asked) : test_fewest(test_cases(200, 30), 6);
    room r = room_new("");
    fw_study *study =
        open_study(&r, r.device, "drawn",
                   "<vary what=\"push\" from=\"0.1 mN\" to=\"0.9 mN\"/>"
                   "<vary what=\"flexure[A]/@width\" from=\"4 um\" to=\"14 um\"/>"
                   "<vary what=\"flexure[C]/@width\" from=\"4 um\" to=\"12 um\"/>"
                   "<vary what=\"flexure[E]/@angle\" from=\"150 deg\" to=\"280 deg\"/>"
                   "<vary what=\"link\" from=\"25 um\" to=\"260 um\"/>",
                   hinges);
    tally t = compare(study, n);
    print_message("%d designs: %d accepted, %d rejected, %d undecided, %d failed\n", n, t.state[0],
                  t.state[1], t.state[4], t.state[5]);
    assert_true(n < 100 || (t.state[0] > n / 20 && t.state[1] > n / 20 && t.state[4] > 0));
    fw_study_free(study);
    room_free(&r);
}

/* What a verdict of hinges alone says of hinges is what the whole verdict says, whether they are accepted or not; and
   what the whole one accepts or hinges reject is decided alike. Links as wide as here collide in some. */
static void hinges_alone(void **state) {
    (void)state;
    const int n = test_fewest(test_cases(60, 16), 4);
    const char *rows = "<vary what=\"push\" from=\"0.1 mN\" to=\"0.9 mN\"/>"
                       "<vary what=\"flexure[A]/@width\" from=\"4 um\" to=\"14 um\"/>"
                       "<vary what=\"link\" from=\"100 um\" to=\"600 um\"/>";
    room r = room_new("");
    fw_study *whole = open_study(&r, r.device, "drawn", rows, any);
    fw_study *alone = open_study(&r, r.device, "hinges", rows, any);
    fw_study_sample a, b;
    int accepted = 0, beside = 0;
    compare(alone, test_fewest(6, 2));
    assert_int_equal(fw_study_sample_new(whole->arena, whole, &a), FW_OK);
    assert_int_equal(fw_study_sample_new(alone->arena, alone, &b), FW_OK);
    for (int i = 0; i < n; i++) {
        bool changed = false;
        draw(whole, 81, i, &a);
        fw_study_sample_copy(whole, &a, &b);
        assert_int_equal(fw_study_evaluate(whole, NULL, &a, &changed), FW_OK);
        assert_int_equal(fw_study_evaluate(alone, NULL, &b, &changed), FW_OK);
        assert_int_equal(a.run, b.run);
        if (!a.run) continue;
        /* a hinge that is undecided is looked at again, unless something else has rejected the device */
        if (a.decision != 1 || b.decision == 1) {
            for (int k = 0; k < whole->nresponse; k++)
                assert_true(same_number(a.response[k], b.response[k]));
        }
        if (a.decision == 0) assert_int_equal(b.decision, a.decision);
        if (b.decision != 0) assert_int_not_equal(a.decision, 0);
        accepted += a.decision == 0;
        beside += a.decision != b.decision;
    }
    print_message("%d designs: %d accepted, %d decided by something beside hinges\n", n, accepted,
                  beside);
    assert_true(n < 30 || (accepted > 0 && beside > 0));
    fw_study_free(whole);
    fw_study_free(alone);
    room_free(&r);
}

/* with a flow, whose judgement, its masks' among it, is part of the decision; asked for more than hinges; as the flow
   makes it */
static void flows_and_clearances(void **state) {
    (void)state;
    room r = room_new("<flow ref=\"al-masked-rie\"/>");
    const char *rows = "<vary what=\"push\" from=\"0.1 mN\" to=\"0.6 mN\"/>"
                       "<vary what=\"flexure[A]/@gap\" from=\"2 um\" to=\"9 um\"/>"
                       "<vary what=\"link\" from=\"60 um\" to=\"240 um\"/>";
    for (int i = 0; i < 3; i++) {
        fw_study *study =
            open_study(&r, r.device, i == 2 ? "made" : "drawn", rows, i == 1 ? more : hinges);
        compare(study, test_fewest(test_cases(12, 4), 2));
        fw_study_free(study);
    }
    room_free(&r);
}

/* a value that cannot be drawn, one that cannot be read, another material: by itself each time, and the next one is
   not the worse for it */
static void strange_ones(void **state) {
    (void)state;
    room r = room_new("");
    fw_study *study =
        open_study(&r, r.device, "drawn",
                   "<vary what=\"thin\" values=\"0 um; 1 um; 12 um\"/>"
                   "<vary what=\"material/@ref\" values=\"silicon-100; copper-plated\"/>"
                   "<vary what=\"flexure[B]/@width\" values=\"8 um; 200 um\"/>",
                   hinges);
    tally t = compare(study, test_fewest(20, 4));
    assert_true(t.state[5] > 0);
    fw_study_free(study);
    room_free(&r);
}

static void of_the_gallery(void **state) {
    (void)state;
    static const struct {
        const char *device, *rows;
    } of[] = {
        {"free-form-gripper", "<vary what=\"pull\" from=\"0.1 mN\" to=\"0.2 mN\"/>"},
        {"copper-nodder", "<vary what=\"push\" from=\"10 uN\" to=\"50 uN\"/>"},
        {"leaf-four-bar", "<vary what=\"width\" from=\"6 um\" to=\"12 um\"/>"},
        {"free-form-four-bar", "<vary what=\"width\" from=\"6 um\" to=\"9 um\"/>"},
        {"straight-stage", "<vary what=\"pull\" from=\"60 uN\" to=\"160 uN\"/>"},
        {"four-tendons", "<vary what=\"draw\" from=\"4 um\" to=\"30 um\"/>"},
    };
    room r = room_new("");
    for (size_t i = 0; i < (size_t)test_fewest(test_cases(6, 3), 1); i++) {
        char device[300];
        snprintf(device, sizeof device, GALLERY "%s/device.xml", of[i].device);
        fw_study *study = open_study(&r, device, "drawn", of[i].rows, any);
        compare(study, 2);
        fw_study_free(study);
    }
    room_free(&r);
}

/* files that are changed while the study runs are noticed */
static void changed_files(void **state) {
    (void)state;
    room r = room_new("");
    fw_study *study = open_study(&r, r.device, "drawn",
                                 "<vary what=\"push\" from=\"0.1 mN\" to=\"0.2 mN\"/>", hinges);
    fw_study_sample sample;
    bool changed = false;
    assert_int_equal(fw_study_sample_new(study->arena, study, &sample), FW_OK);
    strcpy(sample.text[0], "0.15 mN");
    assert_int_equal(fw_study_evaluate(study, NULL, &sample, &changed), FW_OK);
    assert_true(sample.run);
    write_to(r.device, "<device/>\n");
    usleep(1100000);
    assert_int_equal(fw_study_evaluate(study, NULL, &sample, &changed), FW_INPUT);
    assert_true(changed);
    fw_study_free(study);
    room_free(&r);
}

/* nobody sees the advice of a point that Explore asks for: a refused one is judged, and no change of it is sought, which
   would cost twenty times the judgement */
static void points_without_advice(void **state) {
    (void)state;
    fw_device_vary vary = {.what = "push", .unit = "", .from = (double)NAN, .to = (double)NAN};
    fw_device_respond respond = {.name = "U", .value = "governing.utilisation", .min = (double)NAN, .max = (double)NAN};
    const fw_device_study asked = {.name = "points", .kind = FW_STUDY_IS_sweep, .judge = FW_JUDGE_MADE,
                                   .nvary = 1, .vary = &vary, .nrespond = 1, .respond = &respond};
    room r = room_new("");
    fw_study_options o = {.design = fw_design_options_default(), .file = r.device, .jobs = 1};
    o.design.data_directory = FW_TEST_SOURCE_DIR;
    o.design.corners = "none";
    fw_study *study;
    assert_int_equal(fw_study_open_points(&o, &asked, &study), FW_OK);
    fw_study_sample sample;
    bool changed = false;
    assert_int_equal(fw_study_sample_new(study->arena, study, &sample), FW_OK);
    strcpy(sample.text[0], "0.9 mN");
    assert_int_equal(fw_study_evaluate(study, NULL, &sample, &changed), FW_OK);
    assert_true(sample.run);
    assert_int_equal(sample.decision, 1);
    const fw_verdict *v = &fw_plan_design_plan(study->design)->verdict;
    assert_int_equal(v->decision, FW_REJECT); /* the point was judged in this design */
    assert_int_equal(v->nproposal, 0);
    assert_ptr_equal(v->advice_note, fw_verdict_not_searched);
    fw_study_free(study);
    room_free(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_six_bars), cmocka_unit_test(flows_and_clearances),
        cmocka_unit_test(strange_ones),    cmocka_unit_test(of_the_gallery),
        cmocka_unit_test(changed_files),    cmocka_unit_test(hinges_alone),
        cmocka_unit_test(points_without_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
