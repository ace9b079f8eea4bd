/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of design rules: one line each, in the order of docs/theory/masks.md. */
#include "mask/rule.h"

static const fw_mask_rule_kind_row *const table[] = {
    &fw_mask_kind_width,     &fw_mask_kind_space,      &fw_mask_kind_notch,   &fw_mask_kind_feature,
    &fw_mask_kind_angle,     &fw_mask_kind_edge,       &fw_mask_kind_area,    &fw_mask_kind_density,
    &fw_mask_kind_enclosure, &fw_mask_kind_separation, &fw_mask_kind_overlap,
};

const fw_mask_rule_kind_row *fw_mask_rule_kind_at(size_t i) {
    return i < sizeof table / sizeof table[0] ? table[i] : NULL;
}

const char *fw_mask_rule_name(const fw_mask_rule *rule) {
    return rule->kind->name;
}

double fw_mask_rule_row_shown(const fw_mask_rule_kind_row *kind, double value) {
    switch (kind->unit) {
    case FW_UNIT_LENGTH:
        return value * 1e6;
    case FW_UNIT_ANGLE:
        return value * 180 / FW_PI;
    case FW_UNIT_AREA:
        return value * 1e12;
    case FW_UNIT_SHARE:
        return value;
    }
    return value;
}

const char *fw_mask_rule_unit_name(const fw_mask_rule_kind_row *kind) {
    static const char *const name[] = {"um", "deg", "um2", "of the window"};
    return name[kind->unit];
}

double fw_mask_rule_shown(const fw_mask_rule *rule, double value) {
    return fw_mask_rule_row_shown(rule->kind, value);
}

const char *fw_mask_rule_unit(const fw_mask_rule *rule) {
    return rule->kind->unit == FW_UNIT_SHARE ? "" : fw_mask_rule_unit_name(rule->kind);
}
