/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of test patterns. */
#include "layout/pattern.h"
#include <string.h>

#define FW_LAYOUT_PATTERN(name) extern const fw_layout_pattern_kind fw_layout_pattern_##name;
#include "layout/patterns.def"
#undef FW_LAYOUT_PATTERN
#define FW_LAYOUT_PATTERN(name) &fw_layout_pattern_##name,
static const fw_layout_pattern_kind *const kinds[] = {
#include "layout/patterns.def"
};
#undef FW_LAYOUT_PATTERN
enum { NKIND = sizeof kinds / sizeof kinds[0] };

const fw_layout_pattern_kind *fw_layout_pattern_kind_at(size_t i) {
    return i < NKIND ? kinds[i] : NULL;
}

const fw_layout_pattern_kind *fw_layout_pattern_kind_named(const char *name) {
    for (size_t i = 0; i < NKIND; i++)
        if (strcmp(kinds[i]->name, name) == 0) return kinds[i];
    return NULL;
}

fw_status fw_layout_pattern_draw(fw_arena *arena, const fw_layout_pattern *pattern,
                                 double width_rule_m, double space_rule_m, double bias_m,
                                 fw_layout_coupon *coupon) {
    *coupon = (fw_layout_coupon){.pattern = pattern};
    fw_layout_pen pen = {.arena = arena,
                         .pattern = pattern,
                         .coupon = coupon,
                         .width_rule_m = width_rule_m,
                         .space_rule_m = space_rule_m,
                         .bias_m = pattern->biased ? bias_m : 0.0};
    return pattern->kind->draw(&pen);
}
