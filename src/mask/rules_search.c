/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which pairs of edges are looked at: shapes whose boxes are near enough, by a sweep along x, and
   of those the edges whose boxes are. Cost O(n log n + pairs of neighbours). Test:
   test_rules_search.c. */
#include "mask/rule.h"
#include <math.h>

static double reach(const fw_mask_rule_search *in) {
    return fw_greater(fw_mask_rule_bound(in, FW_RULE_WIDTH), fw_mask_rule_bound(in, FW_RULE_SPACE));
}

static void look_inside(fw_mask_rule_search *in, const fw_mask_rule_range *r) {
    fw_mask_rule_edge *e = in->edge + r->first;
    for (int i = 0; i < r->count; i++) {
        fw_mask_rule_own(in, &e[i]);
        double far = reach(in); /* only a pair that was looked at changes it */
        fw_geometry_box own = e[i].box;
        for (int j = i + 1; j < r->count && e[j].box.x0 - own.x1 <= far; j++) {
            if (fw_box_gap(own, e[j].box) > far) continue;
            fw_mask_rule_pair(in, &e[i], &e[j]);
            far = reach(in);
        }
    }
}

static void look_between(fw_mask_rule_search *in, const fw_mask_rule_range *r,
                         const fw_mask_rule_range *s) {
    for (int i = 0; i < r->count; i++) {
        fw_mask_rule_edge *p = &in->edge[r->first + i], *q = &in->edge[s->first];
        fw_geometry_box own = p->box;
        double far = reach(in);
        if (fw_box_gap(own, s->box) > far) continue;
        for (int j = 0; j < s->count && q[j].box.x0 - own.x1 <= far; j++) {
            if (fw_box_gap(own, q[j].box) > far) continue;
            fw_mask_rule_pair(in, p, &q[j]);
            far = reach(in);
        }
    }
}

static void search_pairs(fw_mask_rule_search *in) {
    for (int i = 0; i < in->nrange; i++) /* first: what a shape measures bounds the rest */
        look_inside(in, &in->range[i]);
    for (int i = 0; i < in->nrange; i++)
        for (int j = i + 1; j < in->nrange; j++) {
            const fw_mask_rule_range *r = &in->range[i], *s = &in->range[j];
            double far = reach(in);
            if (s->box.x0 - r->box.x1 > far) break;
            if (fw_box_gap(r->box, s->box) <= far) look_between(in, r, s);
        }
}

/* Near pairs first: most layers have a width and a space of some um, and then nothing beyond these
   is looked at. Where they have not, again up to what was found, or with a larger cap. What stands
   in the end is what the last round alone finds, in its order. */
void fw_mask_rule_search_run(fw_mask_rule_search *in) {
    for (double cap_m = 12e-6;;) {
        in->cap_m = fw_lesser(cap_m, FW_MASK_LOOK_M);
        in->measure->width_m = in->measure->space_m = HUGE_VAL;
        in->nfound = 0;
        search_pairs(in);
        double found_m = fw_greater(in->measure->width_m, in->measure->space_m);
        if (in->everything || found_m <= in->cap_m || in->cap_m >= FW_MASK_LOOK_M) return;
        cap_m = isinf(found_m) ? 3 * cap_m : found_m;
    }
}
