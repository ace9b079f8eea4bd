/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <scene> with its loads and actuators. */
#include "device/device_reader.h"
#include <math.h>
#include <string.h>

/* ---- force, torque, gravity, initial ---- */

/* 0 may be stated, for example by a parameter that a study changes; nothing at all is a slip */
static void needs_size(fw_device_scene_reader *s, const fw_xml_record *record, const char *element,
                       const char *x, const char *y, const char *example) {
    if (fw_xml_given(record, x) || fw_xml_given(record, y)) return;
    fw_diag_error(s->r->diags, 93, record->element->place,
                  "<%s> has no magnitude and therefore no effect; give %s or %s, for example "
                  "%s, or remove it",
                  element, x, y, example);
}

static fw_status build_force(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    fw_device_force f = {.body = fw_device_reference(s->r, record, "on"),
                         .x_m = fw_xml_number_or(record, "x", 0.0),
                         .y_m = fw_xml_number_or(record, "y", 0.0),
                         .fx_N = fw_xml_number_or(record, "fx", 0.0),
                         .fy_N = fw_xml_number_or(record, "fy", 0.0),
                         .place = record->element->place};
    needs_size(s, record, "force", "fx", "fy", "fx=\"20 uN\"");
    FW_TRY(fw_device_time_law(s->r, record, &f.law));
    s->scene->force[s->scene->nforce++] = f;
    return FW_OK;
}

static fw_status build_torque(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    fw_device_torque t = {.body = fw_device_reference(s->r, record, "on"),
                          .value_Nm = fw_xml_number_of(record, "value"),
                          .place = record->element->place};
    FW_TRY(fw_device_time_law(s->r, record, &t.law));
    s->scene->torque[s->scene->ntorque++] = t;
    return FW_OK;
}

static fw_status build_gravity(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    if (!fw_xml_given(record, "gz"))
        needs_size(s, record, "gravity", "gx", "gy", "gy=\"-9.81 m/s^2\"");
    s->scene->gravity = true;
    s->scene->gz_m_per_s2 = fw_xml_number_or(record, "gz", 0.0);
    s->scene->gx_m_per_s2 = fw_xml_number_or(record, "gx", 0.0);
    s->scene->gy_m_per_s2 = fw_xml_number_or(record, "gy", 0.0);
    return FW_OK;
}

static fw_status build_initial(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    fw_device_scene *scene = s->scene;
    fw_device_initial v = {.body = fw_device_reference(s->r, record, "body"),
                           .vx_m_per_s = fw_xml_number_or(record, "vx", 0.0),
                           .vy_m_per_s = fw_xml_number_or(record, "vy", 0.0),
                           .omega_rad_per_s = fw_xml_number_or(record, "omega", 0.0),
                           .moves_free = !fw_xml_given(record, "vx") && !fw_xml_given(record, "vy"),
                           .turns_free = !fw_xml_given(record, "omega"),
                           .place = record->element->place};
    if (v.body >= 0 && s->moved[v.body])
        fw_diag_error(s->r->diags, 45, fw_xml_place_of(record, "body"),
                      "body '%s' has two <initial> in this scene (first at line %d); remove one",
                      fw_xml_text_of(record, "body"),
                      scene->initial[s->moved[v.body] - 1].place.line);
    else if (v.body >= 0)
        s->moved[v.body] = scene->ninitial + 1;
    scene->initial[scene->ninitial++] = v;
    return FW_OK;
}

/* ---- tendon, comb-drive, base-motion ---- */

/* ---- tendons ---- */

static fw_status read_eyelets(fw_device_reader *r, int at, fw_device_tendon *t) {
    int most = 0;
    for (int i = at + 1; i < r->xml.nrecord && r->xml.record[i].parent >= at; i++)
        most += fw_xml_is(&r->xml.record[i], "eyelet");
    FW_NEED(t->eyelet = fw_arena_array(r->arena, fw_device_eyelet, (size_t)most));
    for (int i = at + 1; i < r->xml.nrecord && r->xml.record[i].parent >= at; i++)
        if (fw_xml_is(&r->xml.record[i], "eyelet"))
            t->eyelet[t->neyelet++] = (fw_device_eyelet){
                .body = fw_device_reference(r, &r->xml.record[i], "on"),
                .x_m = fw_xml_number_or(&r->xml.record[i], "x", 0.0),
                .y_m = fw_xml_number_or(&r->xml.record[i], "y", 0.0),
                .hole_m = fw_xml_number_or(&r->xml.record[i], "hole", FW_EYELET_HOLE_M),
                .ring_m = fw_xml_number_or(&r->xml.record[i], "ring", FW_EYELET_RING_M),
                .place = r->xml.record[i].element->place};
    return FW_OK;
}

/* in the world; NaN while the body's pose waits for its shape */
static void drawn_at(const fw_device *d, const fw_device_eyelet *e, double *x_m, double *y_m) {
    *x_m = e->x_m;
    *y_m = e->y_m;
    if (e->body < 0) return;
    const fw_device_body *b = &d->body[e->body];
    double c = cos(b->phi_rad), s = sin(b->phi_rad);
    *x_m = b->x_m + c * e->x_m - s * e->y_m;
    *y_m = b->y_m + s * e->x_m + c * e->y_m;
}

/* on one body they always coincide; on two they do so as drawn, and the pull has no direction */
static bool coincide(const fw_device *d, const fw_device_eyelet *a, const fw_device_eyelet *b) {
    double ax, ay, bx, by;
    if (a->body == FW_NOWHERE || b->body == FW_NOWHERE) return false;
    if (a->body == b->body) return a->x_m == b->x_m && a->y_m == b->y_m;
    drawn_at(d, a, &ax, &ay);
    drawn_at(d, b, &bx, &by);
    return hypot(ax - bx, ay - by) <= 1e-9 * fmax(hypot(ax, ay), hypot(bx, by));
}

static void check_path(fw_device_reader *r, const fw_xml_record *record,
                       const fw_device_tendon *t) {
    char label[FW_LABEL];
    bool moves = false;
    fw_xml_label(record, label);
    if (t->neyelet < 2) {
        if (!r->xml.unknown_element)
            fw_diag_error(r->diags, 74, t->place,
                          "%s has %s; a cable needs at least two: where it is fixed, and where it "
                          "leaves to its actuator",
                          label, t->neyelet ? "one <eyelet>" : "no <eyelet>");
        return;
    }
    for (int i = 1; i < t->neyelet; i++) {
        const fw_device_eyelet *a = &t->eyelet[i - 1], *b = &t->eyelet[i];
        moves |= a->body != b->body;
        if (coincide(r->device, a, b))
            fw_diag_error(
                r->diags, 74, b->place,
                "%s: this eyelet is at the same point as the one before it (line %d), so the cable "
                "has no direction between them; move this eyelet, or remove it",
                label, a->place.line);
    }
    if (!moves && t->eyelet[0].body != FW_NOWHERE)
        fw_diag_error(
            r->diags, 74, t->place,
            "%s: all eyelets are on %s, so its tension cannot move one body against another; put "
            "an eyelet on another body, or on ground",
            label, t->eyelet[0].body < 0 ? "ground" : "one body");
}

static void check_pull_or_draw(fw_device_reader *r, const fw_xml_record *record) {
    static const char *const of_draw[] = {"stiffness", "damping", "slack", "expansion"};
    char label[FW_LABEL];
    bool pull = fw_xml_given(record, "pull"), draw = fw_xml_given(record, "draw");
    fw_xml_label(record, label);
    if (pull && draw)
        fw_diag_error(r->diags, 75, fw_xml_place_of(record, "draw"),
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
        fw_device_refused(
            r, record, 75, of_draw, 4,
            "changes nothing where the tension is given by pull; remove it, or write draw");
    else
        fw_device_needed(r, record, 75, of_draw, 1, "a drawn cable pulls because it is stretched");
}

/* a law below 0 would make the cable push; looked for at instants and on both sides of breaks */
static void check_law_pulls(fw_device_reader *r, const fw_xml_record *record,
                            const fw_quantity_law *law, double duration_s) {
    enum { INSTANTS = 512 };
    for (int i = 0; law && i <= INSTANTS && isfinite(duration_s); i++) {
        double t_s = duration_s * i / INSTANTS, value[3];
        fw_quantity_law_value(law, t_s, t_s, value);
        if (!(value[0] < -1e-12)) continue;
        char label[FW_LABEL], at[FW_LABEL];
        fw_diag_error(r->diags, 98, fw_xml_place_of(record, "law"),
                      "%s: the law makes the pull negative (at %s), and a cable only pulls; add a "
                      "constant, for example law=\"expression\" factor=\"(1 - cos(2*pi*t/(1 "
                      "ms)))/2\"",
                      fw_xml_label(record, label), fw_xml_in_unit(at, t_s, "ms"));
        return;
    }
}

static fw_status build_tendon(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    fw_device_tendon t = {.id = fw_xml_text_of(record, "id"),
                          .pull_N = fw_xml_number_of(record, "pull"),
                          .draw_m = fw_xml_number_of(record, "draw"),
                          .stiffness_N_per_m = fw_xml_number_or(record, "stiffness", 0.0),
                          .damping_Ns_per_m = fw_xml_number_or(record, "damping", 0.0),
                          .slack_m = fw_xml_number_or(record, "slack", 0.0),
                          .expansion_per_K = fw_xml_number_or(record, "expansion", 0.0),
                          .place = record->element->place};
    FW_TRY(read_eyelets(s->r, at, &t));
    check_path(s->r, record, &t);
    check_pull_or_draw(s->r, record);
    FW_TRY(fw_device_time_law(s->r, record, &t.law));
    if (fw_xml_given(record, "pull")) check_law_pulls(s->r, record, t.law, s->duration_s);
    s->scene->tendon[s->scene->ntendon++] = t;
    return FW_OK;
}

/* ---- combs ---- */

static void check_comb(fw_device_reader *r, const fw_xml_record *record, const fw_device_comb *c) {
    static const char *const of_comb[] = {"fingers", "overlap", "width"}, *const of_plate[] = {
                                                                              "length"};
    const char *kind = fw_xml_text_of(record, "kind");
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    fw_xml_label(record, label);
    if (!fw_xml_given(record, "voltage"))
        fw_diag_error(
            r->diags, 76, record->element->place,
            "%s has no voltage; add voltage=\"...\", which may be 0 V where its electrodes "
            "are only in the way",
            label);
    if (c->body_a == c->body_b && c->body_b >= 0)
        fw_diag_error(r->diags, 62, fw_xml_place_of(record, "against"),
                      "%s: rotor and stator are both on '%s' and never move against each other; "
                      "name another body, or ground",
                      label, fw_xml_text_of(record, "on"));
    if (!kind) return;
    if (c->kind == FW_ELECTRODES_PLATE) {
        fw_device_refused(
            r, record, 76, of_comb, 3,
            "belongs to kind=\"comb\"; two plates have a length and a gap: remove it");
        fw_device_needed(r, record, 76, of_plate, 1, "how long the two faces are");
        return;
    }
    fw_device_needed(r, record, 76, of_comb, 1, "how many fingers the rotor has");
    fw_device_needed(r, record, 76, of_comb + 1, 1, "by which the fingers are engaged");
    if (c->overlap_m > c->length_m * (1 + 1e-12))
        fw_diag_error(r->diags, 76, fw_xml_place_of(record, "overlap"),
                      "%s: the overlap %s is more than the fingers' length %s; the fingers "
                      "would touch the opposite electrode; make the overlap shorter or the "
                      "fingers longer",
                      label, fw_xml_in_unit(a, c->overlap_m, "um"),
                      fw_xml_in_unit(b, c->length_m, "um"));
}

bool fw_device_same_comb(const fw_device_comb *p, const fw_device_comb *q) {
    bool length = p->length_m == q->length_m || (isnan(p->length_m) && isnan(q->length_m));
    return p->kind == q->kind && p->body_a == q->body_a && p->body_b == q->body_b &&
           p->bx_m == q->bx_m && p->by_m == q->by_m && p->direction_rad == q->direction_rad &&
           p->fingers == q->fingers && p->gap_m == q->gap_m && p->width_m == q->width_m && length &&
           (p->kind == FW_ELECTRODES_PLATE || p->overlap_m == q->overlap_m);
}

/* One pair of electrodes has one voltage: of two, the field goes with the square of their sum, and two drives would pull by the
   sum of their squares */
static void check_alone(fw_device_scene_reader *s, const fw_xml_record *record,
                        const fw_device_comb *c) {
    for (int i = 0; i < s->scene->ncomb; i++) {
        const fw_device_comb *other = &s->scene->comb[i];
        if (c->voltage_V == 0 || other->voltage_V == 0 || !fw_device_same_comb(other, c)) continue;
        fw_diag_error(s->r->diags, 714, record->element->place,
                      "%s%s and %s%s are the same electrodes, and put two voltages between them in "
                      "one scene: what is between "
                      "them is one voltage, whose square pulls; put both into one comb-drive, "
                      "whose law=\"expression\" says "
                      "how the voltages add up over time",
                      FW_NAMED("comb drive", fw_text_name(c->id)),
                      FW_NAMED("comb drive", fw_text_name(other->id)));
        return;
    }
}

static fw_status build_comb(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    const char *kind = fw_xml_text_of(record, "kind"), *pad = fw_xml_text_of(record, "pad");
    double fingers = fw_xml_number_or(record, "fingers", 0.0);
    fw_device_comb c = {.id = fw_xml_text_of(record, "id"),
                        .kind = kind && strcmp(kind, "plate") == 0 ? FW_ELECTRODES_PLATE
                                                                   : FW_ELECTRODES_COMB,
                        .body_a = fw_device_reference(s->r, record, "against"),
                        .body_b = fw_device_reference(s->r, record, "on"),
                        .bx_m = fw_xml_number_or(record, "x", 0.0),
                        .by_m = fw_xml_number_or(record, "y", 0.0),
                        .direction_rad = fw_xml_number_of(record, "direction"),
                        .fingers = isnan(fingers) ? 0 : (int)fingers,
                        .gap_m = fw_xml_number_of(record, "gap"),
                        .overlap_m = fw_xml_number_of(record, "overlap"),
                        .length_m = fw_xml_number_of(record, "length"),
                        .depth_m = fw_xml_number_of(record, "depth"),
                        .width_m = fw_xml_number_or(record, "width", 0.0),
                        .voltage_V = fw_xml_number_of(record, "voltage"),
                        .pad_at_edge = pad && strcmp(pad, "edge") == 0,
                        .place = record->element->place};
    check_comb(s->r, record, &c);
    check_alone(s, record, &c);
    FW_TRY(fw_device_time_law(s->r, record, &c.law));
    s->scene->comb[s->scene->ncomb++] = c;
    return FW_OK;
}

/* ---- base motion ---- */

static fw_status build_base_motion(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    fw_device_base_motion b = {.ax_m_per_s2 = fw_xml_number_or(record, "ax", 0.0),
                               .ay_m_per_s2 = fw_xml_number_or(record, "ay", 0.0),
                               .az_m_per_s2 = fw_xml_number_or(record, "az", 0.0),
                               .place = record->element->place};
    /* a stated 0 is an acceleration, as the end of a sweep of shocks is */
    if (!fw_xml_given(record, "ax") && !fw_xml_given(record, "ay") && !fw_xml_given(record, "az"))
        fw_diag_error(
            s->r->diags, 93, b.place,
            "<base-motion> needs an acceleration; give ax, ay or az, for example ax=\"100 m/s^2\", "
            "or remove it");
    FW_TRY(fw_device_time_law(s->r, record, &b.law));
    s->scene->base[s->scene->nbase++] = b;
    return FW_OK;
}

/* ---- which of its elements goes where ---- */

/* a kind of element: how it is read, and where its array is; scenes with one hold it themselves */
#define ARRAY(type, array)                                                                         \
    static bool room_for_##array(fw_arena *arena, fw_device_scene *s, int n) {                     \
        return (s->array = fw_arena_array(arena, type, (size_t)n)) != NULL;                        \
    }                                                                                              \
    static bool own_##array(fw_arena *arena, fw_device_scene *s) {                                 \
        size_t n = (size_t)s->n##array;                                                            \
        return (s->array = fw_arena_grow(arena, s->array, n, n, sizeof(type))) != NULL;            \
    }
ARRAY(fw_device_force, force)
ARRAY(fw_device_torque, torque)
ARRAY(fw_device_initial, initial)
ARRAY(fw_device_tendon, tendon)
ARRAY(fw_device_comb, comb)
ARRAY(fw_device_base_motion, base)
ARRAY(fw_device_friction_use, friction)
ARRAY(fw_device_contact_use, contact)
ARRAY(fw_device_material_damping, damping)
ARRAY(fw_device_temperature, temperature)
ARRAY(fw_device_residual_stress, stress)
ARRAY(fw_device_air, air)
ARRAY(fw_device_scene_part, part)

static const struct {
    const char *element;
    fw_status (*build)(fw_device_scene_reader *s, int at);
    bool (*room)(fw_arena *arena, fw_device_scene *s, int n);
    bool (*own)(fw_arena *arena, fw_device_scene *s);
} kinds[] = {
    {"force", build_force, room_for_force, own_force},
    {"torque", build_torque, room_for_torque, own_torque},
    {"gravity", build_gravity, NULL, NULL},
    {"initial", build_initial, room_for_initial, own_initial},
    {"tendon", build_tendon, room_for_tendon, own_tendon},
    {"comb-drive", build_comb, room_for_comb, own_comb},
    {"base-motion", build_base_motion, room_for_base, own_base},
    {"friction", fw_device_build_friction, room_for_friction, own_friction},
    {"contact", fw_device_build_contact, room_for_contact, own_contact},
    {"material-damping", fw_device_build_material_damping, room_for_damping, own_damping},
    {"temperature", fw_device_build_temperature, room_for_temperature, own_temperature},
    {"residual-stress", fw_device_build_residual_stress, room_for_stress, own_stress},
    {"air", fw_device_build_air, room_for_air, own_air},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static int kind_of(const fw_xml_record *record) {
    for (int k = 0; k < KINDS; k++)
        if (fw_xml_is(record, kinds[k].element)) return k;
    return -1;
}

/* ---- elements that no struct stands for ---- */

static bool is_part(const fw_xml_record *record) {
    return kind_of(record) < 0 && strcmp(record->row->parent, "scene") == 0;
}

double fw_device_scene_part_number(const fw_device_scene_part *part, const char *name) {
    for (int i = 0; i < part->count; i++)
        if (strcmp(part->name[i], name) == 0) return part->number[i];
    return (double)NAN;
}

void fw_device_scene_part_scale(const fw_device_scene_part *part, const char *name, double by) {
    for (int i = 0; i < part->count; i++)
        if (strcmp(part->name[i], name) == 0) part->number[i] *= by;
}

/* what the table says an absent attribute is, where that is a number */
static double fallback_of(fw_device_reader *r, const fw_xml_attribute_row *row) {
    double value;
    fw_quantity_expression_error error;
    if (!row->fallback ||
        fw_quantity_expression_evaluate(r->arena, row->fallback, strlen(row->fallback),
                                        &r->xml.names, row->dimension, &value, &error) != FW_OK)
        return (double)NAN;
    return value;
}

static fw_status build_part(fw_device_scene_reader *s, int at) {
    fw_device_reader *r = s->r;
    const fw_xml_record *record = &r->xml.record[at];
    const fw_xml_element_row *row = record->row;
    const char **name;
    fw_device_scene_part part = {.element = row->name,
                                 .body = FW_GROUND,
                                 .count = row->nattribute,
                                 .place = record->element->place};
    FW_NEED(name = fw_arena_array(r->arena, const char *, (size_t)row->nattribute));
    FW_NEED(part.number = fw_arena_array(r->arena, double, (size_t)row->nattribute));
    for (int i = 0; i < row->nattribute; i++) {
        const fw_xml_attribute_row *a = &row->attribute[i];
        name[i] = a->name;
        part.number[i] = (double)NAN;
        if (a->kind == FW_KIND_NUMBER)
            part.number[i] = fw_xml_number_or(record, a->name, fallback_of(r, a));
        else if (a->kind == FW_KIND_REF && strcmp(a->name, "on") == 0)
            part.body = fw_device_reference(r, record, a->name);
    }
    part.name = name;
    if (row->timed) FW_TRY(fw_device_time_law(r, record, &part.law));
    s->scene->part[s->scene->npart++] = part;
    return FW_OK;
}

fw_status fw_device_own_scene(fw_arena *arena, fw_device_scene *s) {
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].own) FW_NEED(kinds[k].own(arena, s));
    FW_NEED(own_part(arena, s));
    for (int i = 0; i < s->ntendon; i++) {
        fw_device_tendon *t = &s->tendon[i];
        size_t n = (size_t)t->neyelet;
        FW_NEED(t->eyelet = fw_arena_grow(arena, t->eyelet, n, n, sizeof *t->eyelet));
    }
    for (int i = 0; i < s->npart; i++) {
        fw_device_scene_part *p = &s->part[i];
        size_t n = (size_t)p->count;
        FW_NEED(p->number = fw_arena_grow(arena, p->number, n, n, sizeof *p->number));
    }
    return FW_OK;
}

/* ---- scenes ---- */

static fw_status build_scene(fw_device_reader *r, int at, fw_device_scene *s, int *moved) {
    const fw_xml_record *record = &r->xml.record[at];
    int count[KINDS] = {0}, parts = 0;
    *s = (fw_device_scene){.name = fw_xml_text_of(record, "name"),
                           .duration_s = fw_xml_number_of(record, "duration"),
                           .place = record->element->place};
    if (fw_device_reference(r, record, "flow") >= 0) s->flow = fw_xml_text_of(record, "flow");
    fw_device_scene_reader reader = {r, s, s->duration_s, moved};
    for (int i = at + 1; i < r->xml.nrecord && r->xml.record[i].parent >= at; i++) {
        int k = kind_of(&r->xml.record[i]);
        if (k >= 0) count[k]++;
        parts += is_part(&r->xml.record[i]);
    }
    FW_NEED(room_for_part(r->arena, s, parts));
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].room) FW_NEED(kinds[k].room(r->arena, s, count[k]));
    for (int i = at + 1; i < r->xml.nrecord && r->xml.record[i].parent >= at; i++) {
        int k = kind_of(&r->xml.record[i]);
        if (k >= 0) FW_TRY(kinds[k].build(&reader, i));
        if (is_part(&r->xml.record[i])) FW_TRY(build_part(&reader, i));
    }
    for (int i = 0; i < s->ninitial; i++)
        if (s->initial[i].body >= 0) moved[s->initial[i].body] = 0; /* for the next scene */
    return FW_OK;
}

/* a driver must have a value as long as the longest scene lasts */
static void check_drivers(fw_device_reader *r) {
    const fw_device *d = r->device;
    double longest_s = 0;
    for (int i = 0; i < d->nscene; i++)
        if (d->scene[i].duration_s > longest_s) longest_s = d->scene[i].duration_s;
    for (int i = 0, k = 0; i < r->xml.nrecord && k < d->ndriver; i++)
        if (fw_xml_is(&r->xml.record[i], "driver")) {
            const fw_quantity_law *law = &d->driver[k++].law;
            if (law->program) fw_device_finite_check(r, &r->xml.record[i], "value", law, longest_s);
        }
}

fw_status fw_device_build_scenes(fw_device_reader *r) {
    fw_device *d = r->device;
    int *moved = fw_arena_array(r->arena, int, (size_t)d->nbody);
    FW_NEED(moved);
    FW_NEED(d->scene =
                fw_arena_array(r->arena, fw_device_scene, (size_t)fw_xml_count(&r->xml, "scene")));
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "scene"))
            FW_TRY(build_scene(r, i, &d->scene[d->nscene++], moved));
    check_drivers(r);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
