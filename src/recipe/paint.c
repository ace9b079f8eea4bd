/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colours and names of films, the same in every picture of a run sheet. */
#include "recipe/profile.h"
#include <string.h>

static const struct {
    const char *material, *fill;
} palette[] = {
    {"silicon-100", "#b9c2cf"},   {"silicon-substrate", "#a7b1c2"}, {"porous-silicon", "#e9dfc6"},
    {"copper-plated", "#d98a52"}, {"copper-seed", "#8c4a21"},       {"aluminium", "#7d868f"},
    {"resist", "#f4c4cc"},        {"carrier-wax", "#f3eaa5"},       {"carrier", "#e2e2e2"}};

/* materials without a place in the palette take one of four tints by the sum of their letters */
const char *fw_paint_fill(const char *material, bool exposed) {
    static const char *const others[] = {"#c7dcc1", "#d5c9e3", "#c6e0e4", "#eed2bb"};
    unsigned sum = 0;
    if (exposed) return "#fdeef0";
    for (size_t i = 0; i < sizeof palette / sizeof palette[0]; i++)
        if (strcmp(palette[i].material, material) == 0) return palette[i].fill;
    for (const char *c = material; *c; c++)
        sum = 31 * sum + (unsigned char)*c;
    return others[sum % 4];
}

const char *fw_paint_name(const fw_flow *flow, const char *material, char shown[32]) {
    enum { MOST = 26 };
    const char *name = fw_flow_material_name(flow, material);
    size_t n = strcspn(name, ",(");
    while (n > 0 && name[n - 1] == ' ')
        n--;
    if (n > MOST) n = MOST;
    while (n > 0 && ((unsigned char)name[n] & 0xC0) == 0x80)
        n--;
    memcpy(shown, name, n);
    shown[n] = '\0';
    return shown;
}
