/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flow of three plates and a device: where its pack and its layer table disagree, where a body runs over the edge of its
   hollow, and where a scene reckons with other air than the flow leaves. */
#include "plan/plan.h"
#include "geometry/segment.h"
#include "test.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char device_form[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"stage\">"
    "<material ref=\"silicon-100\" thickness=\"50 um\"/><flow ref=\"silicon-on-glass\"/>"
    "<flexure id=\"leaf\" kind=\"leaf\" length=\"400 um\" width=\"6 um\" gap=\"10 um\"/><mechanism>"
    "<body id=\"left\" x=\"0 mm\" y=\"0.75 mm\" width=\"120 um\"/>"
    "<body id=\"stage\" x=\"0.9 mm\" y=\"1.5 mm\" plate-width=\"0.7 mm\" plate-height=\"0.5 mm\"/>"
    "<body id=\"right\" x=\"1.8 mm\" y=\"0.75 mm\" width=\"120 um\"/>"
    "<revolute id=\"A\" a=\"ground\" b=\"left\" b-x=\"0 mm\" b-y=\"-0.75 mm\" hinge=\"leaf\"/>"
    "<revolute id=\"B\" a=\"left\" a-x=\"0 mm\" a-y=\"0.75 mm\" b=\"stage\" b-x=\"-0.9 mm\" "
    "b-y=\"0 mm\" hinge=\"leaf\"/>"
    "<revolute id=\"C\" a=\"stage\" a-x=\"0.9 mm\" a-y=\"0 mm\" b=\"right\" b-x=\"0 mm\" "
    "b-y=\"0.75 mm\" hinge=\"leaf\"/>"
    "<revolute id=\"D\" a=\"right\" a-x=\"0 mm\" a-y=\"-0.75 mm\" b=\"ground\" b-x=\"1.8 mm\" "
    "b-y=\"0 mm\" hinge=\"leaf\"/></mechanism>"
    "<scene name=\"push\" duration=\"3 ms\"><force on=\"stage\" fx=\"%s\"/>"
    "<air kind=\"slide\" on=\"stage\" gap=\"%s\"/></scene>%s</device>";

static const char *fx = "4 uN", *die = "";
static bool turned; /* the frame of body "left" by 90 degrees, which makes no other device */
static char folder[] = "fw-hollows-XXXXXX";

/* a file of the data directory, with one text exchanged */
static void copy(const char *name, const char *from, const char *to) {
    char path[400], text[200000];
    snprintf(path, sizeof path, FW_TEST_SOURCE_DIR "/%s", name);
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    size_t n = fread(text, 1, sizeof text - 1, f);
    text[n] = '\0';
    fclose(f);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    f = fopen(path, "wb");
    assert_non_null(f);
    char *at = from ? strstr(text, from) : NULL;
    if (from && !at) fail_msg("%s has no %s", name, from);
    if (at) {
        fwrite(text, 1, (size_t)(at - text), f);
        fputs(to, f);
        fputs(at + strlen(from), f);
    } else
        fputs(text, f);
    fclose(f);
}

static int set_up(void **state) {
    char path[400];
    (void)state;
    strcpy(folder, "fw-hollows-XXXXXX");
    assert_non_null(mkdtemp(folder));
    static const char *const part[] = {"processes", "masks"};
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, part[i]);
        mkdir(path, 0777);
    }
    copy("processes/base.xml", NULL, NULL);
    copy("processes/silicon-on-glass.xml", NULL, NULL);
    copy("masks/silicon-on-glass.xml", NULL, NULL);
    return 0;
}

static int tear_down(void **state) {
    static const char *const file[] = {"processes/base.xml",
                                       "processes/silicon-on-glass.xml",
                                       "masks/silicon-on-glass.xml",
                                       "processes",
                                       "masks",
                                       "."};
    char path[400];
    (void)state;
    for (size_t i = 0; i < sizeof file / sizeof file[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, file[i]);
        i < 3 ? unlink(path) : rmdir(path);
    }
    rmdir(folder);
    return 0;
}

static void exchange(char *text, const char *from, const char *to) {
    char *at = strstr(text, from);
    assert_non_null(at);
    memmove(at + strlen(to), at + strlen(from), strlen(at + strlen(from)) + 1);
    memcpy(at, to, strlen(to));
}

static fw_plan *asked(const char *gap, fw_status *loaded) {
    static char xml[4000];
    fw_plan_options options = fw_plan_options_default();
    options.data_directory = folder;
    fw_plan *plan = fw_plan_new(&options);
    snprintf(xml, sizeof xml, device_form, fx, gap, die);
    if (turned) {
        exchange(xml, "<body id=\"left\"", "<body id=\"left\" phi=\"90 deg\"");
        exchange(xml, "b=\"left\" b-x=\"0 mm\" b-y=\"-0.75 mm\"",
                 "b=\"left\" b-x=\"-0.75 mm\" b-y=\"0 mm\" free-angle=\"90 deg\"");
        exchange(xml, "a=\"left\" a-x=\"0 mm\" a-y=\"0.75 mm\"",
                 "a=\"left\" a-x=\"0.75 mm\" a-y=\"0 mm\" free-angle=\"-90 deg\"");
    }
    *loaded = fw_plan_load_memory(plan, "stage.xml", xml, strlen(xml));
    return plan;
}

static bool said(const fw_plan *plan, int number, const char *words) {
    for (size_t i = 0; i < plan->diags.count; i++)
        if (plan->diags.item[i].number == number && strstr(plan->diags.item[i].message, words))
            return true;
    return false;
}

static const char *reason_of(const fw_plan *plan, const char *words) {
    const fw_process_flow *f = plan->flow[0].flow;
    for (int i = 0; i < f->nreason; i++)
        if (strstr(f->reason[i], words)) return f->reason[i];
    return NULL;
}

static fw_plan *judged(const char *gap) {
    fw_status loaded;
    fw_plan *plan = asked(gap, &loaded);
    if (loaded != FW_OK || fw_plan_judge(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "no message");
    return plan;
}

static void as_it_is(void **state) {
    (void)state;
    fw_plan *plan = judged("20 um");
    if (plan->flow[0].flow->manufacturable == 0) fail_msg("%s", plan->flow[0].flow->reason[0]);
    assert_null(reason_of(plan, "bonded glass"));
    for (size_t i = 0; i < plan->diags.count; i++)
        assert_true(plan->diags.item[i].number < 420 || plan->diags.item[i].number > 429);
    const fw_quantity *hollow = fw_process_flow_quantity(plan->flow[0].flow, "mask.widest-hollow");
    assert_false(hollow->unknown); /* below the stage: 500 um and both margins, on a grid */
    assert_near(hollow->value, 580e-6, 25e-6);
    fw_plan_free(plan);
}

/* one wire from each pad that is drawn, of the chips that are packaged, and those that are pulled */
static void wires_follow_the_pads(void **state) {
    (void)state;
    fw_plan *plan = judged("20 um");
    const fw_layout *marked;
    fw_layout_no_room no_room;
    int pads = 0;
    assert_int_equal(
        fw_mask_frame_marks(plan->arena, plan->flow[0].table, plan->layout, &marked, &no_room),
        FW_OK);
    for (int i = 0; i < marked->npiece; i++)
        pads += strcmp(marked->piece[i].label, "metal of a bond pad") == 0;
    assert_true(pads > 0);
    static const char *const id[] = {"mask.pads", "chips", "wire.pulls", "wires"};
    double value[4];
    for (int i = 0; i < 4; i++) {
        const fw_quantity *q = fw_process_flow_quantity(plan->flow[0].flow, id[i]);
        assert_non_null(q);
        assert_false(q->unknown);
        value[i] = q->value;
    }
    assert_near(value[0], pads, 1e-12);
    assert_near(value[3], value[1] * pads + value[2], 1e-9);
    fw_plan_free(plan);
}

/* a frame that has no room for the marks of its plates says so, and the one that is named has it */
static void marks_without_room_are_said(void **state) {
    (void)state;
    static const struct {
        const char *die;
        bool said;
    } row[] = {{"", false},
               {"<die frame=\"140 um\"/>", true},
               {"<die frame=\"223 um\"/>", true},
               {"<die frame=\"224 um\"/>", false}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        die = row[i].die;
        fw_plan *plan = judged("20 um");
        die = "";
        assert_int_equal(said(plan, 619, "2 of the 2 marks frame-mark on the frame"), row[i].said);
        assert_int_equal(said(plan, 619, "with <die frame=\"224 um\"> they are there"),
                         row[i].said);
        fw_plan_free(plan);
    }
}

/* without marks on the frames, sites of the wafer must have them */
static void plates_without_any_mark_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *die;
        bool refused;
    } row[] = {{"<die frame=\"140 um\"/>", false}, /* whose plate it is put on is not said */
               {"<die frame=\"140 um\"/><wafer diameter=\"100 mm\"/>", true},
               {"<die frame=\"140 um\"/><wafer diameter=\"100 mm\" alignment=\"2 sites\"/>", false},
               {"<wafer diameter=\"100 mm\"/>", false}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        die = row[i].die;
        fw_plan *plan = judged("20 um");
        die = "";
        assert_int_equal(reason_of(plan, "shows how its plates lie on each other") != NULL,
                         row[i].refused);
        assert_int_equal(plan->flow[0].flow->manufacturable == 0, row[i].refused);
        fw_plan_free(plan);
    }
}

static void other_air(void **state) {
    (void)state;
    static const struct {
        const char *gap;
        bool warned;
    } row[] = {{"17.9 um", true}, {"18.1 um", false}, {"21.9 um", false}, {"22.1 um", true}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) { /* 20 +- 2 um are the flow's own */
        fw_plan *plan = judged(row[i].gap);
        assert_int_equal(said(plan, 422, "of air below what moves, but step G12"), row[i].warned);
        fw_plan_free(plan);
    }
}

/* refused where the way and the budget are more than the margin, and not where they are less; the way is that of the
   motion's own samples */
static void travel(void **state) {
    (void)state;
    fw_plan *plan = judged("20 um");
    const fw_dynamics_motion *motion = plan->verdict.variant[0].motion[0];
    const fw_mechanism *m = plan->verdict.variant[0].mechanism;
    double way = 0.0;
    for (int i = 0; i < motion->nsample; i++)
        for (int b = 0; b < motion->nbody; b++) {
            const double *q = motion->q + 3 * (i * motion->nbody + b);
            double r =
                b == 1 ? hypot(1.1e-3, 0.35e-3) : 1.2e-3; /* none is larger about its middle */
            double turn = fabs(q[2] - m->drawn[b].phi_rad);
            way = fmax(way, hypot(q[0] - m->drawn[b].x_m, q[1] - m->drawn[b].y_m) + r * turn);
        }
    fw_plan_free(plan);
    if (!(way > 5e-6 && way < 37e-6)) fail_msg("goes %g m", way);
    char to[200];
    snprintf(to, sizeof to, "<content kind=\"cavity\" margin=\"%.3f um\"", way * 1e6 + 3.001);
    copy("masks/silicon-on-glass.xml", "<content kind=\"cavity\" margin=\"40 um\"", to);
    plan = judged("20 um");
    assert_null(reason_of(plan, "bonded glass"));
    fw_plan_free(plan);
    copy("masks/silicon-on-glass.xml", "<content kind=\"cavity\" margin=\"40 um\"",
         "<content kind=\"cavity\" margin=\"5 um\"");
    plan = judged("20 um");
    const char *why = reason_of(plan, "it would run over bonded glass");
    double goes = 0.0;
    assert_non_null(why);
    assert_int_equal(plan->flow[0].flow->manufacturable, 0);
    assert_int_equal(sscanf(strstr(why, " goes "), " goes %lf um", &goes), 1);
    assert_true(goes * 1e-6 > 0.5 * way && goes * 1e-6 <= way * 1.001);
    fw_plan_free(plan);
}

/* how far a body goes does not depend on the axes of the frame in which it is stated */
static void axes_of_a_body_are_not_its_way(void **state) {
    (void)state;
    turned = true;
    fw_plan *plan = judged("20 um");
    turned = false;
    const char *over = reason_of(plan, "it would run over bonded glass");
    if (over) fail_msg("%s", over);
    fw_plan_free(plan);
}

/* The etch of 20 um leaves corners round by as much: sqrt(2) m - (sqrt(2) - 1) 20 um beside a corner of what moves, against
   the overlay alone where nothing goes far. 3 um are left at m = 7.98 um. */
static void corners_are_round(void **state) {
    (void)state;
    static const struct {
        const char *margin;
        bool over;
    } row[] = {{"40", false}, {"9.2", false}, {"7.9", true}, {"5", true}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        char to[200];
        snprintf(to, sizeof to, "<content kind=\"cavity\" margin=\"%s um\"", row[i].margin);
        copy("masks/silicon-on-glass.xml", "<content kind=\"cavity\" margin=\"40 um\"", to);
        fx = "4 nN";
        fw_plan *plan = judged("20 um");
        fx = "4 uN";
        const char *why = reason_of(plan, "it would run over bonded glass");
        if ((why != NULL) != row[i].over)
            fail_msg("%s um: %s", row[i].margin, why ? why : "nothing");
        if (why) assert_non_null(strstr(why, "at its corners, which the etch leaves round"));
        if (why) assert_non_null(strstr(why, "margin=\"8 um\""));
        fw_plan_free(plan);
    }
}

/* ---- a required workspace ---- */

static const char six_form[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"six\">"
    "<material ref=\"silicon-100\" strength=\"2.5 GPa\" thickness=\"50 um\"/>"
    "<flow ref=\"silicon-on-glass\" carrier=\"insulating\"/><die tethers=\"no\"/>"
    "<flexure id=\"f\" kind=\"csfh\" length=\"300 um\" angle=\"240 deg\" width=\"8 um\" gap=\"10 "
    "um\"/><six-bar>"
    "<hinge at=\"A\" x=\"0.70 mm\" y=\"0.15 mm\" flexure=\"f\"/><hinge at=\"B\" x=\"0.20 mm\" "
    "y=\"1.40 mm\" flexure=\"f\"/><hinge at=\"C\" x=\"0.80 mm\" y=\"2.70 mm\" "
    "flexure=\"f\"/><hinge "
    "at=\"D\" x=\"2.20 mm\" y=\"2.75 mm\" flexure=\"f\"/><hinge at=\"E\" x=\"2.85 mm\" y=\"1.45 "
    "mm\" "
    "flexure=\"f\"/><hinge at=\"F\" x=\"2.30 mm\" y=\"0.15 mm\" flexure=\"f\"/>"
    "<link id=\"AB\" width=\"120 um\"/><link id=\"BC\" width=\"120 um\"/>"
    "<platform id=\"CD\" width=\"1.40 mm\" height=\"0.40 mm\" x=\"1.50 mm\" y=\"2.875 mm\"/>"
    "<link id=\"DE\" width=\"120 um\"/><link id=\"EF\" width=\"120 um\"/></six-bar>"
    "<scene name=\"pull\" duration=\"0.1 ms\"><comb-drive id=\"up\" kind=\"plate\" on=\"CD\" x=\"0 "
    "mm\" "
    "y=\"0.21 mm\" direction=\"90 deg\" gap=\"40 um\" length=\"400 um\" voltage=\"1 V\"/></scene>"
    "<workspace x-min=\"-5 um\" x-max=\"5 um\" y-min=\"-5 um\" y-max=\"%g um\" phi-min=\"0 deg\" "
    "phi-max=\"0 deg\"/></device>";

static fw_plan *up_by(double um) {
    static char xml[4000];
    fw_plan_options options = fw_plan_options_default();
    options.data_directory = folder;
    options.verdict.corners = FW_CORNERS_NONE;
    fw_plan *plan = fw_plan_new(&options);
    snprintf(xml, sizeof xml, six_form, um);
    if (fw_plan_load_memory(plan, "six.xml", xml, strlen(xml)) != FW_OK ||
        fw_plan_judge(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "no message");
    return plan;
}

/* where the corner of two bars lies, at distances p and q from a and b, on the side on which it was drawn */
static fw_geometry_vec2 knee(fw_geometry_vec2 a, fw_geometry_vec2 b, double p, double q,
                             double side) {
    double far = vec_distance(a, b), along = (far * far + p * p - q * q) / (2 * far);
    fw_geometry_vec2 u = vec_scale(1 / far, vec_sub(b, a));
    return vec_along(vec_along(a, along, u), side * sqrt(p * p - along * along), vec_left(u));
}

/* how far any corner of a body's outline goes where p goes to p1 and q to q1 */
static double goes_at_most(const fw_layout *layout, int body, fw_geometry_vec2 p,
                           fw_geometry_vec2 q, fw_geometry_vec2 p1, fw_geometry_vec2 q1) {
    fw_geometry_vec2 u = vec_sub(q, p), v = vec_sub(q1, p1);
    double turn = atan2(vec_cross(u, v), vec_dot(u, v)), most = 0;
    for (int i = 0; i < layout->npiece; i++)
        for (int k = 0; layout->piece[i].body == body && k < layout->piece[i].contour.count; k++) {
            fw_geometry_vec2 at = layout->piece[i].contour.segment[k].a,
                             to = vec_add(p1, fw_geometry_vec_rotate(vec_sub(at, p), turn));
            most = fmax(most, vec_distance(at, to));
        }
    return most;
}

/* of the six-bar above over all of the box, from its hinge points alone */
static double box_moves(const fw_layout *layout, double up_m) {
    const fw_geometry_vec2 drawn[6] = {{0.70e-3, 0.15e-3}, {0.20e-3, 1.40e-3}, {0.80e-3, 2.70e-3},
                                       {2.20e-3, 2.75e-3}, {2.85e-3, 1.45e-3}, {2.30e-3, 0.15e-3}};
    double most = 0;
    for (int i = 0; i <= 10; i++)
        for (int k = 0; k <= 10; k++) {
            fw_geometry_vec2 at[6], by = {(i - 5) * 1e-6, -5e-6 + 0.1 * k * (up_m + 5e-6)};
            memcpy(at, drawn, sizeof at);
            at[2] = vec_add(at[2], by), at[3] = vec_add(at[3], by);
            at[1] = knee(at[0], at[2], vec_distance(drawn[0], drawn[1]),
                         vec_distance(drawn[1], drawn[2]), 1);
            at[4] = knee(at[5], at[3], vec_distance(drawn[5], drawn[4]),
                         vec_distance(drawn[4], drawn[3]), -1);
            for (int b = 0; b < 5; b++)
                most =
                    fmax(most, goes_at_most(layout, b, drawn[b], drawn[b + 1], at[b], at[b + 1]));
        }
    return most;
}

/* The scene moves nothing to speak of. The platform goes up by what is required, and no body much farther:
   over the margin it is refused. What is left between platform and stator is the gap less that way. */
static void required_poses_count(void **state) {
    (void)state;
    static const double up[] = {6, 20, 37};
    for (int i = 0; i < 3; i++) {
        fw_plan *plan = up_by(up[i]);
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
        const char *why = reason_of(plan, "it would run over bonded glass");
        double goes = 0.0, least = HUGE_VAL;
        assert_true(v->workspace.required && v->workspace.reachable);
        if (why) {
            assert_non_null(strstr(why, "in a required workspace"));
            assert_int_equal(sscanf(strstr(why, " goes "), " goes %lf um", &goes), 1);
            /* hinges turn about their elastic centres, some um from their points */
            const double must = 1e6 * box_moves(plan->layout, up[i] * 1e-6);
            if (!(goes >= 0.99 * must && goes < 1.04 * must))
                fail_msg("up %g um goes %g um: %s", up[i], must, why);
        }
        assert_int_equal(
            why != NULL,
            i == 2); /* 33 um at 20 up: less than the margin of 40 and the overlay of 3 */
        for (int k = 0; k < v->nstator; k++)
            if (strcmp(v->stator[k].scene, "workspace") == 0) least = fmin(least, v->stator[k].m);
        if (!(fabs(least - (40.0 - up[i]) * 1e-6) < 1e-6)) fail_msg("%g um left", 1e6 * least);
        const fw_wiring_gap *gap = NULL; /* and the wiring has it */
        for (int k = 0; k < plan->flow[0].wiring->ngap; k++)
            if (plan->flow[0].wiring->gap[k].moved_m == least) gap = &plan->flow[0].wiring->gap[k];
        assert_non_null(gap);
        assert_string_equal(gap->scene, "workspace");
        fw_plan_free(plan);
    }
}

static void disagreements(void **state) {
    (void)state;
    static const struct {
        const char *file, *from, *to;
        int number;
        const char *says;
    } row[] = {
        {"masks", "roles=\"land\" grow=\"cavity.d\"", "roles=\"land\" grow=\"si.d\"", 421,
         "layer \"land\" of plate \"cavity\" is drawn by si.d, but the pack draws that plate by "
         "cavity.d"},
        {"masks", "roles=\"metal\"", "roles=\"metal\" shrink=\"cavity.d\"", 421,
         "layer \"metal\" of plate \"pads\" is drawn by cavity.d, but the pack draws that plate by "
         "nothing"},
        {"masks", "marks=\"back\" overlay=\"3 um\"", "marks=\"back\" overlay=\"2 um\"", 421,
         "lets plate \"pads\" lie 3 um off, but masks/silicon-on-glass.xml reckons with 2 um"},
        {"processes", "<align to=\"cavity\" overlay=\"overlay.back\"",
         "<align to=\"device\" overlay=\"overlay.back\"", 373, "aligns mask pads to 'device'"},
        {"masks", "aligned-to=\"cavity\" marks=\"back\" overlay=\"3 um\"/>\n  <layer",
         "aligned-to=\"pads\" marks=\"back\" overlay=\"3 um\"/>\n  <layer", 421,
         "aligns plate \"device\" to cavity, and masks/silicon-on-glass.xml to pads"},
        {"processes", "<plate id=\"pads\"", "<plate id=\"metal\"", 421,
         "plate \"metal\" is no row in masks/silicon-on-glass.xml"},
        {"processes", "marks=\"back-mark frame-mark\"", "marks=\"back-mrk frame-mark\"", 372,
         "aligns by 'back-mrk', which masks/silicon-on-glass.xml does not have"},
        {"processes", "marks=\"back-mark frame-mark\"", "marks=\"back-mark ladder\"", 372,
         "aligns by 'ladder', which in masks/silicon-on-glass.xml is a undercut-ladder: no plate"},
        {"processes", "coupon=\"slots\"", "coupon=\"fill\"", 372,
         "reads coupon 'fill', which in masks/silicon-on-glass.xml is a fill"},
        {"processes", "mask=\"pads\"", "mask=\"metal\"", 412, "next of the plates"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        char name[80];
        fw_status loaded;
        snprintf(name, sizeof name, "%s/silicon-on-glass.xml", row[i].file);
        copy(name, row[i].from, row[i].to);
        fw_plan *plan = asked("20 um", &loaded);
        assert_int_equal(loaded, FW_INPUT);
        if (!said(plan, row[i].number, row[i].says))
            fail_msg("%s: %s", row[i].says,
                     plan->diags.count ? plan->diags.item[0].message : "nothing");
        fw_plan_free(plan);
        copy(name, NULL, NULL);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(wires_follow_the_pads, set_up, tear_down),
        cmocka_unit_test_setup_teardown(marks_without_room_are_said, set_up, tear_down),
        cmocka_unit_test_setup_teardown(plates_without_any_mark_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(as_it_is, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_air, set_up, tear_down),
        cmocka_unit_test_setup_teardown(travel, set_up, tear_down),
        cmocka_unit_test_setup_teardown(axes_of_a_body_are_not_its_way, set_up, tear_down),
        cmocka_unit_test_setup_teardown(corners_are_round, set_up, tear_down),
        cmocka_unit_test_setup_teardown(required_poses_count, set_up, tear_down),
        cmocka_unit_test_setup_teardown(disagreements, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
