/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <scene>: which of its elements goes where. */
#include "device/scene_parts.h"
#include <math.h>
#include <string.h>

/* a kind of element: how it is read, and where its array is; scenes with one hold it themselves */
#define ARRAY(type, array)                                                                         \
    static bool room_for_##array(fw_arena *arena, fw_scene *s, int n) {                            \
        return (s->array = fw_arena_array(arena, type, (size_t)n)) != NULL;                        \
    }                                                                                              \
    static bool own_##array(fw_arena *arena, fw_scene *s) {                                        \
        size_t n = (size_t)s->n##array;                                                            \
        return (s->array = fw_arena_grow(arena, s->array, n, n, sizeof(type))) != NULL;            \
    }
ARRAY(fw_force, force)
ARRAY(fw_torque, torque)
ARRAY(fw_initial, initial)
ARRAY(fw_tendon, tendon)
ARRAY(fw_comb, comb)
ARRAY(fw_base_motion, base)
ARRAY(fw_friction_use, friction)
ARRAY(fw_contact_use, contact)
ARRAY(fw_material_damping, damping)
ARRAY(fw_temperature, temperature)
ARRAY(fw_residual_stress, stress)
ARRAY(fw_air, air)
ARRAY(fw_scene_part, part)

static const struct {
    const char *element;
    fw_status (*build)(fw_scene_reader *s, int at);
    bool (*room)(fw_arena *arena, fw_scene *s, int n);
    bool (*own)(fw_arena *arena, fw_scene *s);
} kinds[] = {
    {"force", fw_build_force, room_for_force, own_force},
    {"torque", fw_build_torque, room_for_torque, own_torque},
    {"gravity", fw_build_gravity, NULL, NULL},
    {"initial", fw_build_initial, room_for_initial, own_initial},
    {"tendon", fw_build_tendon, room_for_tendon, own_tendon},
    {"comb-drive", fw_build_comb, room_for_comb, own_comb},
    {"base-motion", fw_build_base_motion, room_for_base, own_base},
    {"friction", fw_build_friction, room_for_friction, own_friction},
    {"contact", fw_build_contact, room_for_contact, own_contact},
    {"material-damping", fw_build_material_damping, room_for_damping, own_damping},
    {"temperature", fw_build_temperature, room_for_temperature, own_temperature},
    {"residual-stress", fw_build_residual_stress, room_for_stress, own_stress},
    {"air", fw_build_air, room_for_air, own_air},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static int kind_of(const fw_record *record) {
    for (int k = 0; k < KINDS; k++)
        if (fw_is(record, kinds[k].element)) return k;
    return -1;
}

/* ---- elements that no struct stands for ---- */

static bool is_part(const fw_record *record) {
    return kind_of(record) < 0 && strcmp(record->row->parent, "scene") == 0;
}

double fw_scene_part_number(const fw_scene_part *part, const char *name) {
    for (int i = 0; i < part->count; i++)
        if (strcmp(part->name[i], name) == 0) return part->number[i];
    return (double)NAN;
}

void fw_scene_part_scale(const fw_scene_part *part, const char *name, double by) {
    for (int i = 0; i < part->count; i++)
        if (strcmp(part->name[i], name) == 0) part->number[i] *= by;
}

/* what the table says an absent attribute is, where that is a number */
static double fallback_of(fw_reader *r, const fw_attribute_row *row) {
    double value;
    fw_expression_error error;
    if (!row->fallback ||
        fw_expression_evaluate(r->arena, row->fallback, strlen(row->fallback), &r->names,
                               row->dimension, &value, &error) != FW_OK)
        return (double)NAN;
    return value;
}

static fw_status build_part(fw_scene_reader *s, int at) {
    fw_reader *r = s->r;
    const fw_record *record = &r->record[at];
    const fw_element_row *row = record->row;
    const char **name;
    fw_scene_part part = {.element = row->name,
                          .body = FW_GROUND,
                          .count = row->nattribute,
                          .place = record->element->place};
    FW_NEED(name = fw_arena_array(r->arena, const char *, (size_t)row->nattribute));
    FW_NEED(part.number = fw_arena_array(r->arena, double, (size_t)row->nattribute));
    for (int i = 0; i < row->nattribute; i++) {
        const fw_attribute_row *a = &row->attribute[i];
        name[i] = a->name;
        part.number[i] = (double)NAN;
        if (a->kind == FW_KIND_NUMBER)
            part.number[i] = fw_number_or(record, a->name, fallback_of(r, a));
        else if (a->kind == FW_KIND_REF && strcmp(a->name, "on") == 0)
            part.body = fw_reference(r, record, a->name);
    }
    part.name = name;
    if (row->timed) FW_TRY(fw_time_law(r, record, &part.law));
    s->scene->part[s->scene->npart++] = part;
    return FW_OK;
}

fw_status fw_device_own_scene(fw_arena *arena, fw_scene *s) {
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].own) FW_NEED(kinds[k].own(arena, s));
    FW_NEED(own_part(arena, s));
    for (int i = 0; i < s->npart; i++) {
        fw_scene_part *p = &s->part[i];
        size_t n = (size_t)p->count;
        FW_NEED(p->number = fw_arena_grow(arena, p->number, n, n, sizeof *p->number));
    }
    return FW_OK;
}

/* ---- scenes ---- */

bool fw_refused(fw_reader *r, const fw_record *record, int number, const char *const *names, int n,
                const char *why) {
    char label[FW_LABEL];
    for (int i = 0; i < n; i++)
        if (fw_given(record, names[i])) {
            fw_diag_error(r->diags, number, fw_place_of(record, names[i]), "%s: %s %s",
                          fw_label(record, label), names[i], why);
            return true;
        }
    return false;
}

bool fw_needed(fw_reader *r, const fw_record *record, int number, const char *const *names, int n,
               const char *why) {
    char label[FW_LABEL];
    for (int i = 0; i < n; i++)
        if (!fw_given(record, names[i])) {
            fw_diag_error(r->diags, number, record->element->place, "%s needs %s=\"...\": %s",
                          fw_label(record, label), names[i], why);
            return true;
        }
    return false;
}

static fw_status build_scene(fw_reader *r, int at, fw_scene *s, int *moved) {
    const fw_record *record = &r->record[at];
    int count[KINDS] = {0}, parts = 0;
    *s = (fw_scene){.name = fw_text_of(record, "name"),
                    .duration_s = fw_number_of(record, "duration"),
                    .place = record->element->place};
    if (fw_reference(r, record, "flow") >= 0) s->flow = fw_text_of(record, "flow");
    fw_scene_reader reader = {r, s, s->duration_s, moved};
    for (int i = at + 1; i < r->nrecord && r->record[i].parent >= at; i++) {
        int k = kind_of(&r->record[i]);
        if (k >= 0) count[k]++;
        parts += is_part(&r->record[i]);
    }
    FW_NEED(room_for_part(r->arena, s, parts));
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].room) FW_NEED(kinds[k].room(r->arena, s, count[k]));
    for (int i = at + 1; i < r->nrecord && r->record[i].parent >= at; i++) {
        int k = kind_of(&r->record[i]);
        if (k >= 0) FW_TRY(kinds[k].build(&reader, i));
        if (is_part(&r->record[i])) FW_TRY(build_part(&reader, i));
    }
    for (int i = 0; i < s->ninitial; i++)
        if (s->initial[i].body >= 0) moved[s->initial[i].body] = 0; /* for the next scene */
    return FW_OK;
}

/* a driver must have a value as long as the longest scene lasts */
static void check_drivers(fw_reader *r) {
    const fw_device *d = r->device;
    double longest_s = 0;
    for (int i = 0; i < d->nscene; i++)
        if (d->scene[i].duration_s > longest_s) longest_s = d->scene[i].duration_s;
    for (int i = 0, k = 0; i < r->nrecord && k < d->ndriver; i++)
        if (fw_is(&r->record[i], "driver")) {
            const fw_law *law = &d->driver[k++].law;
            if (law->program) fw_finite_check(r, &r->record[i], "value", law, longest_s);
        }
}

fw_status fw_build_scenes(fw_reader *r) {
    fw_device *d = r->device;
    int *moved = fw_arena_array(r->arena, int, (size_t)d->nbody);
    FW_NEED(moved);
    FW_NEED(d->scene = fw_arena_array(r->arena, fw_scene, (size_t)fw_count(r, "scene")));
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "scene")) FW_TRY(build_scene(r, i, &d->scene[d->nscene++], moved));
    check_drivers(r);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
