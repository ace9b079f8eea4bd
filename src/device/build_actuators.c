/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <tendon>, <comb-drive>, <base-motion>. */
#include "device/scene_parts.h"
#include <math.h>
#include <string.h>

/* ---- tendons ---- */

static fw_status read_eyelets(fw_reader *r, int at, fw_tendon *t) {
    int most = 0;
    for (int i = at + 1; i < r->nrecord && r->record[i].parent >= at; i++)
        most += fw_is(&r->record[i], "eyelet");
    FW_NEED(t->eyelet = fw_arena_array(r->arena, fw_eyelet, (size_t)most));
    for (int i = at + 1; i < r->nrecord && r->record[i].parent >= at; i++)
        if (fw_is(&r->record[i], "eyelet"))
            t->eyelet[t->neyelet++] =
                (fw_eyelet){.body = fw_reference(r, &r->record[i], "on"),
                            .x_m = fw_number_or(&r->record[i], "x", 0.0),
                            .y_m = fw_number_or(&r->record[i], "y", 0.0),
                            .hole_m = fw_number_or(&r->record[i], "hole", FW_EYELET_HOLE_M),
                            .ring_m = fw_number_or(&r->record[i], "ring", FW_EYELET_RING_M),
                            .place = r->record[i].element->place};
    return FW_OK;
}

/* in the world; NaN while the body's pose waits for its shape */
static void drawn_at(const fw_device *d, const fw_eyelet *e, double *x_m, double *y_m) {
    *x_m = e->x_m;
    *y_m = e->y_m;
    if (e->body < 0) return;
    const fw_body *b = &d->body[e->body];
    double c = cos(b->phi_rad), s = sin(b->phi_rad);
    *x_m = b->x_m + c * e->x_m - s * e->y_m;
    *y_m = b->y_m + s * e->x_m + c * e->y_m;
}

/* on one body they always coincide; on two they do so as drawn, and the pull has no direction */
static bool coincide(const fw_device *d, const fw_eyelet *a, const fw_eyelet *b) {
    double ax, ay, bx, by;
    if (a->body == FW_NOWHERE || b->body == FW_NOWHERE) return false;
    if (a->body == b->body) return a->x_m == b->x_m && a->y_m == b->y_m;
    drawn_at(d, a, &ax, &ay);
    drawn_at(d, b, &bx, &by);
    return hypot(ax - bx, ay - by) <= 1e-9 * fmax(hypot(ax, ay), hypot(bx, by));
}

static void check_path(fw_reader *r, const fw_record *record, const fw_tendon *t) {
    char label[FW_LABEL];
    bool moves = false;
    fw_label(record, label);
    if (t->neyelet < 2) {
        if (!r->unknown_element)
            fw_diag_error(r->diags, 74, t->place,
                          "%s has %s; a cable needs at least two: where it is fixed, and where it "
                          "leaves to its actuator",
                          label, t->neyelet ? "one <eyelet>" : "no <eyelet>");
        return;
    }
    for (int i = 1; i < t->neyelet; i++) {
        const fw_eyelet *a = &t->eyelet[i - 1], *b = &t->eyelet[i];
        moves |= a->body != b->body;
        if (coincide(r->device, a, b))
            fw_diag_error(
                r->diags, 74, b->place,
                "%s: this eyelet lies where the one before it does (line %d), so that the "
                "cable has no direction there; move or remove it",
                label, a->place.line);
    }
    if (!moves && t->eyelet[0].body != FW_NOWHERE)
        fw_diag_error(
            r->diags, 74, t->place,
            "%s: all eyelets are on %s, so that its pull moves nothing; put one on another "
            "body, or on ground",
            label, t->eyelet[0].body < 0 ? "ground" : "one body");
}

static void check_pull_or_draw(fw_reader *r, const fw_record *record) {
    static const char *const of_draw[] = {"stiffness", "damping", "slack"};
    char label[FW_LABEL];
    bool pull = fw_given(record, "pull"), draw = fw_given(record, "draw");
    fw_label(record, label);
    if (pull && draw)
        fw_diag_error(r->diags, 75, fw_place_of(record, "draw"),
                      "%s: pull gives the tension and draw the length, and an actuator keeps only "
                      "one of them; remove one",
                      label);
    else if (!pull && !draw)
        fw_diag_error(
            r->diags, 75, record->element->place,
            "%s needs pull=\"...\", the tension, or draw=\"...\", the length that is taken "
            "in",
            label);
    else if (pull)
        fw_refused(r, record, 75, of_draw, 3,
                   "changes nothing where the tension is given by pull; remove it, or write draw");
    else
        fw_needed(r, record, 75, of_draw, 1, "a drawn cable pulls because it is stretched");
}

/* a law below 0 would make the cable push; looked for at instants and on both sides of breaks */
static void check_law_pulls(fw_reader *r, const fw_record *record, const fw_law *law,
                            double duration_s) {
    enum { INSTANTS = 512 };
    for (int i = 0; law && i <= INSTANTS && isfinite(duration_s); i++) {
        double t_s = duration_s * i / INSTANTS, value[3];
        fw_law_value(law, t_s, t_s, value);
        if (!(value[0] < -1e-12)) continue;
        char label[FW_LABEL], at[FW_LABEL];
        fw_diag_error(r->diags, 98, fw_place_of(record, "law"),
                      "%s: the law makes the pull negative (at %s), and a cable only pulls; add a "
                      "constant, for example law=\"expression\" factor=\"(1 - cos(2*pi*t/(1 "
                      "ms)))/2\"",
                      fw_label(record, label), fw_in_unit(at, t_s, "ms"));
        return;
    }
}

fw_status fw_build_tendon(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    fw_tendon t = {.id = fw_text_of(record, "id"),
                   .pull_N = fw_number_of(record, "pull"),
                   .draw_m = fw_number_of(record, "draw"),
                   .stiffness_N_per_m = fw_number_or(record, "stiffness", 0.0),
                   .damping_Ns_per_m = fw_number_or(record, "damping", 0.0),
                   .slack_m = fw_number_or(record, "slack", 0.0),
                   .place = record->element->place};
    FW_TRY(read_eyelets(s->r, at, &t));
    check_path(s->r, record, &t);
    check_pull_or_draw(s->r, record);
    FW_TRY(fw_time_law(s->r, record, &t.law));
    if (fw_given(record, "pull")) check_law_pulls(s->r, record, t.law, s->duration_s);
    s->scene->tendon[s->scene->ntendon++] = t;
    return FW_OK;
}

/* ---- combs ---- */

static void check_comb(fw_reader *r, const fw_record *record, const fw_comb *c) {
    static const char *const of_comb[] = {"fingers", "overlap", "width"}, *const of_plate[] = {
                                                                              "length"};
    const char *kind = fw_text_of(record, "kind");
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    fw_label(record, label);
    if (!fw_given(record, "voltage"))
        fw_diag_error(r->diags, 76, record->element->place,
                      "%s has no voltage, so that it pulls at nothing; add voltage=\"...\"", label);
    else if (c->voltage_V == 0)
        fw_diag_error(
            r->diags, 76, fw_place_of(record, "voltage"),
            "%s: with voltage 0 V it exerts no force; give a voltage, or remove the drive", label);
    if (c->body_a == c->body_b && c->body_b >= 0)
        fw_diag_error(r->diags, 62, fw_place_of(record, "against"),
                      "%s: rotor and stator are both on '%s' and never move against each other; "
                      "name another body, or ground",
                      label, fw_text_of(record, "on"));
    if (!kind) return;
    if (c->kind == FW_ELECTRODES_PLATE) {
        fw_refused(r, record, 76, of_comb, 3,
                   "belongs to kind=\"comb\"; two plates have a length and a gap: remove it");
        fw_needed(r, record, 76, of_plate, 1, "how long the two faces are");
        return;
    }
    fw_needed(r, record, 76, of_comb, 1, "how many fingers the rotor has");
    fw_needed(r, record, 76, of_comb + 1, 1, "by which the fingers are engaged");
    if (c->overlap_m > c->length_m * (1 + 1e-12))
        fw_diag_error(r->diags, 76, fw_place_of(record, "overlap"),
                      "%s: the overlap %s is more than the fingers' length %s; the fingers "
                      "would touch the opposite electrode; make the overlap shorter or the "
                      "fingers longer",
                      label, fw_in_unit(a, c->overlap_m, "um"), fw_in_unit(b, c->length_m, "um"));
}

fw_status fw_build_comb(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    const char *kind = fw_text_of(record, "kind");
    double fingers = fw_number_or(record, "fingers", 0.0);
    fw_comb c = {.id = fw_text_of(record, "id"),
                 .kind =
                     kind && strcmp(kind, "plate") == 0 ? FW_ELECTRODES_PLATE : FW_ELECTRODES_COMB,
                 .body_a = fw_reference(s->r, record, "against"),
                 .body_b = fw_reference(s->r, record, "on"),
                 .bx_m = fw_number_or(record, "x", 0.0),
                 .by_m = fw_number_or(record, "y", 0.0),
                 .direction_rad = fw_number_of(record, "direction"),
                 .fingers = isnan(fingers) ? 0 : (int)fingers,
                 .gap_m = fw_number_of(record, "gap"),
                 .overlap_m = fw_number_of(record, "overlap"),
                 .length_m = fw_number_of(record, "length"),
                 .depth_m = fw_number_of(record, "depth"),
                 .width_m = fw_number_or(record, "width", FW_FINGER_WIDTH_M),
                 .voltage_V = fw_number_of(record, "voltage"),
                 .place = record->element->place};
    check_comb(s->r, record, &c);
    FW_TRY(fw_time_law(s->r, record, &c.law));
    s->scene->comb[s->scene->ncomb++] = c;
    return FW_OK;
}

/* ---- base motion ---- */

fw_status fw_build_base_motion(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    fw_base_motion b = {.ax_m_per_s2 = fw_number_or(record, "ax", 0.0),
                        .ay_m_per_s2 = fw_number_or(record, "ay", 0.0),
                        .place = record->element->place};
    if (b.ax_m_per_s2 == 0 && b.ay_m_per_s2 == 0)
        fw_diag_error(
            s->r->diags, 93, b.place,
            "<base-motion> needs an acceleration; give ax or ay, for example ax=\"100 m/s^2\", "
            "or remove it");
    FW_TRY(fw_time_law(s->r, record, &b.law));
    s->scene->base[s->scene->nbase++] = b;
    return FW_OK;
}
