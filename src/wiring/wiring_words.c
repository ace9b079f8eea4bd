/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts and gaps in words, the same on order sheet, run sheet and report. Test: test_wiring_drives.c */
#include "base/text.h"
#include "wiring/wiring_nets.h"
#include <math.h>
#include <stdio.h>

static const char *range(char text[80], const fw_wiring_net *n) {
    char low[32], high[32];
    if (n->low_V == 0.0 && n->high_V == 0.0) return "0 V";
    fw_number_text(low, sizeof low, n->low_V, 4);
    fw_number_text(high, sizeof high, n->high_V, 4);
    snprintf(text, 80, "%s to %s V", low, high);
    return text;
}

fw_status fw_wiring_contact_words(fw_arena *arena, const fw_wiring_net *n, const char **out) {
    char x[32], y[32], wide[32], volts[80];
    if (!n->needed) {
        *out = n->kind == FW_WIRING_STATOR ? "none is needed: no scene of this flow drives it"
                                           : "none is needed: it floats";
        return FW_OK;
    }
    if (!n->padded) {
        *out = "none has room";
        return FW_OK;
    }
    double side = fmin(n->pad.x1 - n->pad.x0, n->pad.y1 - n->pad.y0);
    FW_NEED(*out = fw_arena_printf(arena, "%s, on %s, within %s um about (%s, %s) um; %s",
                                   n->at_edge ? "at the edge of the chip" : "probed", n->pad_on,
                                   fw_number_text(wide, sizeof wide, 1e6 * side, 4),
                                   fw_number_text(x, sizeof x, 0.5e6 * (n->pad.x0 + n->pad.x1), 5),
                                   fw_number_text(y, sizeof y, 0.5e6 * (n->pad.y0 + n->pad.y1), 5),
                                   range(volts, n)));
    return FW_OK;
}

fw_status fw_wiring_gap_words(fw_arena *arena, const fw_wiring *w, const fw_wiring_gap *g,
                              const char **out) {
    char um[32], volts[32], field[32], low[32], high[32];
    const char *b = g->b < w->nnet ? w->net[g->b].name : "handle";
    FW_NEED(*out = fw_arena_printf(
                arena, "%s to %s: %s um%s%s, up to %s V, %s V/um", w->net[g->a].name, b,
                fw_number_text(um, sizeof um, 1e6 * g->made_m, 4), g->scene ? " at least in " : "",
                g->scene ? g->scene : "", fw_number_text(volts, sizeof volts, g->volts, 4),
                fw_number_text(field, sizeof field, 1e-6 * g->field_V_per_m, 3)));
    if (isnan(g->breakdown_V[0])) return FW_OK;
    FW_NEED(*out = fw_arena_printf(arena, "%s; breaks down between %s and %s V", *out,
                                   fw_number_text(low, sizeof low, g->breakdown_V[0], 3),
                                   fw_number_text(high, sizeof high, g->breakdown_V[1], 3)));
    return FW_OK;
}
