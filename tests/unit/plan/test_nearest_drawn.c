/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Openings that a flow proposes where it is refused, stated as whoever follows the proposal states them: the plan of that
   device refuses nothing, masks included. */
#include "test.h"
#include "plan/plan.h"
#include <math.h>

static const char form[] =
    "<process xmlns=\"urn:flexwright:process:1\" id=\"lab\" flow=\"al-masked-rie\" version=\"1\" "
    "title=\"lab\"><source id=\"own\" kind=\"measured\"/>"
    "<q id=\"rie.A\" value=\"%g\" u=\"0\" unit=\"1\" status=\"measured\" src=\"own\"/>"
    "<q id=\"rie.S\" value=\"%g\" u=\"0\" unit=\"1\" status=\"measured\" src=\"own\"/>"
    "<q id=\"rie.overetch\" value=\"%g\" u=\"0\" unit=\"1\" status=\"measured\" src=\"own\"/></process>";

typedef struct etch {
    double A, S, over;
} etch;

static fw_plan *judged(const char *device, const char *const *hinge, int n, double gap_um,
                       const etch *of) {
    static char lab[1000], path[4][64], value[4][32], file[200];
    static fw_device_set set[4];
    snprintf(lab, sizeof lab, form, of->A, of->S, of->over);
    snprintf(file, sizeof file, "%s/docs/gallery/%s/device.xml", FW_TEST_SOURCE_DIR, device);
    for (int i = 0; i < n; i++) {
        snprintf(path[i], sizeof path[i], "flexure[%s]/@gap", hinge[i]);
        snprintf(value[i], sizeof value[i], "%g um", gap_um);
        set[i] = (fw_device_set){path[i], value[i]};
    }
    const fw_plan_lab_text text = {"lab.xml", lab, strlen(lab)};
    fw_plan_options options = fw_plan_options_default();
    options.flow = "al-masked-rie";
    options.set = set, options.nset = n;
    options.lab_text = &text, options.nlab_text = 1;
    options.verdict.with_advice = false;
    fw_plan *plan = fw_plan_new(&options);
    if (fw_plan_load(plan, file) != FW_OK || fw_plan_judge(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "no message");
    return plan;
}

/* "openings at least 10.8 um wide", um; NaN: the flow says no such thing */
static double proposed(const fw_process_flow *f) {
    double um = (double)NAN;
    for (int i = 0; i < f->nreason && isnan(um); i++) {
        const char *at = strstr(f->reason[i], "openings at least ");
        if (at) sscanf(at, "openings at least %lf um wide", &um);
    }
    return um;
}

static const char *reason(const fw_process_flow *f, const char *words) {
    for (int i = 0; i < f->nreason; i++)
        if (strstr(f->reason[i], words)) return f->reason[i];
    return NULL;
}

/* what is proposed is made, and the flow does not say that of what its mask or its drawing refuses: heads, eyelets and
   corners are drawn anew beside a wider gap */
static void what_is_proposed_has_a_mask(void **state) {
    (void)state;
    static const struct {
        const char *device, *hinge[4];
        int n;
        double gap_um;
        etch of;
        const char *fails; /* NULL: a width is proposed */
    } row[] = {
        {"leaf-four-bar", {"leaf"}, 1, 3.0, {0.96, 0.1, 0.1}, NULL},
        {"free-form-gripper", {"pivot"}, 1, 3.0, {0.96, 0.1, 0.1}, NULL},
        {"free-form-gripper", {"pivot"}, 1, 3.0, {0.94, 0.1, 0.1}, "its mask: link left cannot take the bias"},
        {"four-tendons", {"leg", "knee", "hand"}, 3, 3.0, {0.94, 0.1, 0.1}, "no room for eyelet of tendon"},
        {"free-form-four-bar", {"swelling", "hairpin", "hook"}, 3, 4.0, {0.9425, 0.271, 0.3}, "its mask: link crank"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i += (size_t)test_fewest(1, 2)) {
        fw_plan *plan = judged(row[i].device, row[i].hinge, row[i].n, row[i].gap_um, &row[i].of);
        const fw_process_flow *f = plan->flow[0].flow;
        const double um = proposed(f);
        assert_int_equal(f->manufacturable, 0);
        if (row[i].fails) {
            assert_true(isnan(um));
            const char *says = reason(f, "no width of the openings alone is enough (drawn with openings of ");
            if (!says || !strstr(says, row[i].fails)) fail_msg("%s: %s", row[i].device, f->reason[0]);
            fw_plan_free(plan);
            continue;
        }
        assert_true(um > row[i].gap_um);
        fw_plan_free(plan);
        plan = judged(row[i].device, row[i].hinge, row[i].n, um, &row[i].of);
        if (plan->flow[0].flow->manufacturable == 0) fail_msg("%g um: %s", um, plan->flow[0].flow->reason[0]);
        fw_plan_free(plan);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_proposed_has_a_mask)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
