/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What breaking the tethers asks, for documents and for the run sheet. */
#include "base/text.h"
#include "statics/tethers.h"
#include <math.h>

static const char *hinge_of(const fw_mechanism *m, int hinge) {
    return hinge < 0 ? NULL : m->pin[m->hinge[hinge].pin].id;
}

static void one_break(fw_json *json, const char *key, const fw_mechanism *m,
                      const fw_statics_tether_break *b) {
    fw_json_object(json, key);
    fw_json_real(json, "force_N", b->force_N);
    fw_json_real(json, "low_N", b->low_N);
    fw_json_real(json, "high_N", b->high_N);
    fw_json_real(json, "move_m", b->move_m);
    fw_json_truth(json, "at_neck", b->at_neck);
    fw_json_text(json, "hinge", hinge_of(m, b->hinge));
    fw_json_real(json, "hinge_share", b->hinge_share);
    fw_json_real(json, "hinge_used", b->hinge_used);
    fw_json_real(json, "hinge_most", b->hinge_most);
    fw_json_end(json);
}

void fw_statics_tethers_json(fw_json *json, const fw_mechanism *m,
                             const fw_statics_tethers *tethers) {
    if (!tethers) return;
    fw_json_object(json, "tethers");
    fw_json_text(json, "not_computed", tethers->why);
    fw_json_text(json, "criterion", tethers->criterion);
    fw_json_real(json, "strength_Pa", tethers->why ? (double)NAN : tethers->strength_Pa);
    fw_json_text(json, "break_last",
                 tethers->why ? NULL : tethers->item[tethers->keep].drawn->label);
    fw_json_list(json, "items");
    for (int i = 0; i < tethers->n; i++) {
        const fw_statics_tether *t = &tethers->item[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "tether", t->drawn->label);
        fw_json_list(json, "cut_m");
        fw_json_real(json, NULL, t->drawn->cut.x);
        fw_json_real(json, NULL, t->drawn->cut.y);
        fw_json_end(json);
        fw_json_real(json, "neck_m", t->drawn->neck_m);
        fw_json_real(json, "length_m", t->drawn->length_m);
        fw_json_real(json, "toward_m", t->toward_m);
        fw_json_text(json, "toward_scene", t->scene);
        if (!tethers->why) {
            fw_json_real(json, "probe_m", t->probe_m);
            one_break(json, "first", m, &t->first);
            one_break(json, "last", m, &t->last);
        }
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_end(json);
}

static const char *number(char out[32], double value) {
    return fw_number_text(out, 32, value, 3);
}

static void say_hinge(fw_text *text, const fw_mechanism *m, const fw_statics_tethers *all,
                      const fw_statics_tether_break *b) {
    char used[32], most[32];
    const char *hinge = hinge_of(m, b->hinge);
    if (!hinge) return;
    fw_text_printf(text, ", and hinge %s bears at most %s %% of its limit", hinge,
                   number(used, 100.0 * b->hinge_used));
    if (all->high_Pa > all->strength_Pa)
        fw_text_printf(text, " (%s %% where the tether is as strong as its band allows)",
                       number(most, 100.0 * b->hinge_most));
    if (b->hinge_share >= 1.0)
        fw_text_add(text,
                    ": THE HINGE BREAKS BEFORE THE TETHER; hold the body beside the neck with "
                    "a second probe");
    else if (b->hinge_most > 1.0)
        fw_text_add(text, ": beyond its limit; hold the body beside the neck with a second probe");
}

static void say_one(fw_text *text, const fw_mechanism *m, const fw_statics_tethers *all,
                    const fw_statics_tether *t, const fw_statics_tether_break *b) {
    const bool band = all->high_Pa > all->low_Pa;
    char at[2][32], probe[32], force[3][32], move[32];
    fw_text_printf(
        text,
        "the %s at (%s, %s) um, pushed sideways on its finger %s um from the neck, %s%s at %s mN",
        t->drawn->label, fw_number_text(at[0], 32, 1e6 * t->drawn->cut.x, 5),
        fw_number_text(at[1], 32, 1e6 * t->drawn->cut.y, 5), number(probe, 1e6 * t->probe_m),
        all->brittle ? "breaks" : "yields", b->at_neck ? "" : " in the finger, not at the neck,",
        number(force[0], 1e3 * b->force_N));
    if (band)
        fw_text_printf(text, " (%s to %s)", number(force[1], 1e3 * b->low_N),
                       number(force[2], 1e3 * b->high_N));
    else
        fw_text_add(text, " (no band of the strength is stated)");
    fw_text_printf(text, ", when the probe has gone %s um", number(move, 1e6 * b->move_m));
    say_hinge(text, m, all, b);
}

/* what the neck leaves open is not known: a body that goes towards its finger meets it */
static const double fw_meets_m = 1e-6;

static void say_in_the_way(fw_text *text, const fw_statics_tethers *all) {
    char x[32], y[32], by[32];
    int n = 0;
    for (int i = 0; i < all->n; i++) {
        const fw_statics_tether *t = &all->item[i];
        if (!(t->toward_m > fw_meets_m)) continue;
        fw_text_add(text,
                    n++ ? "; "
                        : ". Then break these fingers off at the frame, too, for their bodies "
                          "move against what is left of them: ");
        fw_text_printf(text, "the %s at (%s, %s) um (%s um in scene %s)", t->drawn->label,
                       fw_number_text(x, 32, 1e6 * t->drawn->cut.x, 5),
                       fw_number_text(y, 32, 1e6 * t->drawn->cut.y, 5),
                       number(by, 1e6 * t->toward_m), t->scene);
    }
}

fw_status fw_statics_tethers_words(fw_arena *arena, const fw_mechanism *m,
                                   const fw_statics_tethers *tethers, const char **out) {
    enum { FEW = 4 };
    fw_text text = fw_text_new(arena);
    char at[2][32];
    *out = NULL;
    if (!tethers) return FW_OK;
    const fw_layout_tether *keep = tethers->item[tethers->keep].drawn;
    if (tethers->why) {
        fw_text_printf(&text, "Force to break the tethers: NOT COMPUTABLE, %s", tethers->why);
        say_in_the_way(&text, tethers);
        FW_TRY(fw_text_end(&text));
        *out = text.data;
        return FW_OK;
    }
    fw_text_add(&text, tethers->n > 1 ? "Break the tethers one at a time with a probe in the plane "
                                        "of the wafer"
                                      : "Break the tether with a probe in the plane of the wafer");
    if (tethers->n > 1)
        fw_text_printf(&text, ", the one at (%s, %s) um last",
                       fw_number_text(at[0], 32, 1e6 * keep->cut.x, 5),
                       fw_number_text(at[1], 32, 1e6 * keep->cut.y, 5));
    if (!tethers->brittle)
        fw_text_printf(
            &text,
            ". The forces are those of the material's %s: what parts a metal is not known, so bend "
            "each finger to and fro, or cut it",
            tethers->criterion);
    for (int i = 0, said = 0; i < tethers->n && said < FEW; i++) {
        const fw_statics_tether *t = &tethers->item[i];
        if (i == tethers->keep) continue;
        said++;
        fw_text_add(&text, ". While all others hold, ");
        say_one(&text, m, tethers, t, &t->first);
    }
    if (tethers->n > FEW + 1)
        fw_text_printf(&text, ". Of %d more the recipe's JSON says it", tethers->n - FEW - 1);
    fw_text_add(&text, tethers->n > 1 ? ". Last, " : ". As the only one, ");
    say_one(&text, m, tethers, &tethers->item[tethers->keep], &tethers->item[tethers->keep].last);
    say_in_the_way(&text, tethers);
    FW_TRY(fw_text_end(&text));
    *out = text.data;
    return FW_OK;
}
