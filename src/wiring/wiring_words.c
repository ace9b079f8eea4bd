/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nets, contacts and gaps in words, the same on order sheet, run sheet and report, and as JSON. Test:
   test_wiring_drives.c */
#include "base/text.h"
#include "wiring/wiring.h"
#include <math.h>
#include <stdio.h>

/* ---- sentences ---- */

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

const char *fw_wiring_least_words(char text[64], const fw_wiring_gap *g) {
    const double hardly = 0.01;
    char um[32];
    if (!(g->least_m < (1 - hardly) * g->made_m)) return "";
    fw_number_text(um, sizeof um, 1e6 * fmax(g->least_m, 0), 3);
    snprintf(text, 64, ", or down to %s um with its errors", um);
    return text;
}

fw_status fw_wiring_gap_words(fw_arena *arena, const fw_wiring *w, const fw_wiring_gap *g,
                              const char **out) {
    char um[32], volts[32], field[32], low[32], high[32], least[64];
    const char *b = g->b < w->nnet ? w->net[g->b].name : "handle";
    FW_NEED(*out = fw_arena_printf(
                arena, "%s to %s: %s um%s%s%s, up to %s V, %s V/um", w->net[g->a].name, b,
                fw_number_text(um, sizeof um, 1e6 * g->made_m, 4), g->scene ? " at least in " : "",
                g->scene ? g->scene : "", fw_wiring_least_words(least, g),
                fw_number_text(volts, sizeof volts, g->volts, 4),
                fw_number_text(field, sizeof field, 1e-6 * g->field_V_per_m, 3)));
    if (isnan(g->breakdown_V[0])) return FW_OK;
    FW_NEED(*out = fw_arena_printf(arena, "%s; breaks down between %s and %s V", *out,
                                   fw_number_text(low, sizeof low, g->breakdown_V[0],
                                                  fw_number_plain(g->breakdown_V[0], 3)),
                                   fw_number_text(high, sizeof high, g->breakdown_V[1],
                                                  fw_number_plain(g->breakdown_V[1], 3))));
    return FW_OK;
}

/* ---- JSON ----
   docs/reference/json.md explains every member. */

static const char *kind_word(fw_wiring_kind kind) {
    switch (kind) {
    case FW_WIRING_ROTOR:
        return "rotor";
    case FW_WIRING_STATOR:
        return "stator";
    case FW_WIRING_HELD:
        return "held";
    }
    return "";
}

static const char *fault_word(fw_wiring_fault fault) {
    switch (fault) {
    case FW_WIRING_FINE:
        return NULL;
    case FW_WIRING_NOT_DRAWN:
        return "not drawn";
    case FW_WIRING_SHORTED:
        return "shorted";
    case FW_WIRING_NO_PAD:
        return "no pad";
    }
    return NULL;
}

const char *fw_wiring_contact_word(const fw_wiring_net *net) {
    if (!net->needed || !net->padded) return "none";
    return net->at_edge ? "edge" : "probed";
}

static void place(fw_json *json, const char *key, fw_geometry_vec2 at) {
    fw_json_list(json, key);
    fw_json_real(json, NULL, at.x);
    fw_json_real(json, NULL, at.y);
    fw_json_end(json);
}

static void net(fw_json *json, const fw_wiring_net *n) {
    fw_json_object(json, NULL);
    fw_json_text(json, "net", n->name);
    fw_json_text(json, "kind", kind_word(n->kind));
    fw_json_whole(json, "pieces", n->pieces);
    fw_json_real(json, "area_m2", n->area_m2);
    fw_json_truth(json, "needed", n->needed);
    fw_json_real(json, "low_V", n->low_V);
    fw_json_real(json, "high_V", n->high_V);
    fw_json_text(json, "contact", fw_wiring_contact_word(n));
    if (n->padded) {
        fw_json_list(json, "pad_m");
        const double side[] = {n->pad.x0, n->pad.y0, n->pad.x1, n->pad.y1};
        for (int i = 0; i < 4; i++)
            fw_json_real(json, NULL, side[i]);
        fw_json_end(json);
    } else
        fw_json_null(json, "pad_m");
    fw_json_text(json, "pad_on", n->padded ? n->pad_on : NULL);
    fw_json_truth(json, "tethered", n->tethered);
    fw_json_end(json);
}

static const char *name_of(const fw_wiring *w, int i) {
    return i < 0 ? NULL : i < w->nnet ? w->net[i].name : "handle";
}

static void drive(fw_json *json, const fw_wiring *w, const fw_wiring_drive *d) {
    fw_json_object(json, NULL);
    fw_json_text(json, "drive", d->id);
    fw_json_text(json, "rotor", name_of(w, d->rotor));
    fw_json_text(json, "stator", name_of(w, d->stator));
    fw_json_real(json, "low_V", d->low_V);
    fw_json_real(json, "high_V", d->high_V);
    fw_json_text(json, "fault", fault_word(d->fault));
    fw_json_text(json, "why", d->why);
    fw_json_end(json);
}

static void gap(fw_json *json, const fw_wiring *w, const fw_wiring_gap *g) {
    fw_json_object(json, NULL);
    fw_json_text(json, "a", name_of(w, g->a));
    fw_json_text(json, "b", name_of(w, g->b));
    fw_json_real(json, "drawn_m", g->m);
    place(json, "at_m", g->at[0]);
    fw_json_real(json, "moved_m", g->moved_m);
    fw_json_text(json, "scene", g->scene);
    fw_json_real(json, "t_s", g->t_s);
    fw_json_real(json, "made_m", g->made_m);
    fw_json_real(json, "least_m", g->least_m);
    fw_json_real(json, "voltage_V", g->volts);
    fw_json_real(json, "field_V_per_m", g->field_V_per_m);
    fw_json_list(json, "breakdown_V");
    for (int i = 0; i < 2; i++)
        fw_json_real(json, NULL, g->breakdown_V[i]);
    fw_json_end(json);
    fw_json_end(json);
}

static void sentences(fw_json *json, const char *key, const char *const *list, int n) {
    fw_json_list(json, key);
    for (int i = 0; i < n; i++)
        fw_json_text(json, NULL, list[i]);
    fw_json_end(json);
}

void fw_wiring_json(const fw_wiring *w, fw_json *json) {
    if (!w) {
        fw_json_null(json, "wiring");
        return;
    }
    fw_json_object(json, "wiring");
    fw_json_object(json, "carrier");
    fw_json_truth(json, "insulates", w->carrier.insulates);
    fw_json_text(json, "words", w->carrier.words);
    fw_json_real(json, "thickness_m", w->carrier.thickness_m);
    fw_json_truth(json, "handle", w->carrier.handle);
    fw_json_real(json, "breakdown_V_per_m", w->carrier.breakdown_V_per_m);
    fw_json_real(json, "resistivity_Ohm_m", w->carrier.resistivity_Ohm_m);
    fw_json_text(json, "source", w->carrier.source);
    fw_json_end(json);
    fw_json_list(json, "nets");
    for (int i = 0; i < w->nnet; i++)
        net(json, &w->net[i]);
    fw_json_end(json);
    fw_json_list(json, "drives");
    for (int i = 0; i < w->ndrive; i++)
        drive(json, w, &w->drive[i]);
    fw_json_end(json);
    fw_json_list(json, "gaps");
    for (int i = 0; i < w->ngap; i++)
        gap(json, w, &w->gap[i]);
    fw_json_end(json);
    sentences(json, "refusals", w->refusal, w->nrefusal);
    sentences(json, "open", w->open, w->nopen);
    sentences(json, "remarks", w->remark, w->nremark);
    fw_json_end(json);
}
