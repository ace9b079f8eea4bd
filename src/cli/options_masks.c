/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the options of masks take. */
#include "cli/options_masks.h"
#include "mask/mask.h"
#include <stdio.h>
#include <string.h>

const char *fw_cli_take_tolerance(fw_cli_options *o, const char *v) {
    double nm;
    if (!fw_number_parse(v, strlen(v), &nm) || !(nm >= 0.36 && nm <= 1000.0))
        return "needs nanometres from 0.36 (below, rounding to the 1 nm grid would bend arcs the "
               "wrong way) to 1000, both included";
    o->design.mask_tolerance_m = nm * 1e-9;
    return NULL;
}

/* "needs gds, svg ..." */
static const char *wrong_format(void) {
    static char text[640];
    snprintf(text, sizeof text, "needs %s", fw_cli_mask_format_names());
    return text;
}

const char *fw_cli_take_mask_format(fw_cli_options *o, const char *v) {
    unsigned set;
    o->design.mask_formats = v;
    return fw_mask_formats(v, &set) ? NULL : wrong_format();
}

const char *fw_cli_take_mask_flatten(fw_cli_options *o, const char *v) {
    fw_geometry_flattening kind;
    o->design.mask_flatten = v;
    return *v && fw_mask_flattening_named(v, &kind) ? NULL : "needs inside or equal-area";
}

const char *fw_cli_take_layers(fw_cli_options *o, const char *v) {
    o->design.layers = v;
    return *v ? NULL : "needs the name of a file";
}

const char *fw_cli_take_mask_vertices(fw_cli_options *o, const char *v) {
    static const char *const word[] = {"199", "4094", "8190"};
    static const int32_t most[] = {199, 4094, 8190};
    for (int i = 0; i < 3; i++)
        if (strcmp(v, word[i]) == 0) {
            o->design.mask_vertices = most[i];
            return NULL;
        }
    return "needs 199, 4094 or 8190";
}
