/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of design rules: one line each, in the order of docs/theory/masks.md. */
#include "mask/rule.h"

static const fw_rule_row *const table[] = {
    &fw_kind_width,     &fw_kind_space,      &fw_kind_notch,   &fw_kind_feature,
    &fw_kind_angle,     &fw_kind_edge,       &fw_kind_area,    &fw_kind_density,
    &fw_kind_enclosure, &fw_kind_separation, &fw_kind_overlap,
};

const fw_rule_row *fw_rule_kind_at(size_t i) {
    return i < sizeof table / sizeof table[0] ? table[i] : NULL;
}

const char *fw_mask_rule_name(const fw_mask_rule *rule) {
    return rule->kind->name;
}

double fw_rule_shown(const fw_rule_row *kind, double value) {
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

const char *fw_rule_unit_name(const fw_rule_row *kind) {
    static const char *const name[] = {"um", "deg", "um2", "of the window"};
    return name[kind->unit];
}

double fw_mask_rule_shown(const fw_mask_rule *rule, double value) {
    return fw_rule_shown(rule->kind, value);
}

const char *fw_mask_rule_unit(const fw_mask_rule *rule) {
    return rule->kind->unit == FW_UNIT_SHARE ? "" : fw_rule_unit_name(rule->kind);
}
