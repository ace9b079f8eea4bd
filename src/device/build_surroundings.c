/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What else acts in a <scene>: surfaces that rub or touch, the material, the air. What else stands beside the device:
   <cell>, finished drawings on the die and on the wafer, read, placed and merged for the layers that they go to. */
#include "device/device_reader.h"
#include "base/constants.h"
#include "base/text.h"
#include "drawing/drawing.h"
#include <math.h>
#include <string.h>

/* ---- friction, contact ---- */

/* ---- friction ---- */

static const char *const joint_text[] = {
    [FW_JOINT_PRISMATIC] = "prismatic", [FW_JOINT_DISTANCE] = "distance", [FW_JOINT_WELD] = "weld"};

/* does the joint have conjugate surfaces, whose radius can serve? */
static bool has_surfaces(const fw_device *d, int joint) {
    int k = d->revolute[joint].flexure;
    return k >= 0 && d->flexure[k].kind != FW_FLEXURE_LEAF && d->flexure[k].gap_m > 0;
}

static void check_what_slides(fw_device_reader *r, const fw_xml_record *record,
                              const fw_device_friction_use *f) {
    static const char *const radius[] = {"radius"};
    const fw_device *d = r->device;
    char label[FW_LABEL];
    fw_xml_label(record, label);
    if (f->joint != FW_NONE && d->joint[f->joint].kind != FW_JOINT_PRISMATIC)
        fw_diag_error(
            r->diags, 77, fw_xml_place_of(record, "on"),
            "%s is a %s joint, in which no surfaces slide; name a revolute or a prismatic "
            "joint, or use damping",
            label, joint_text[d->joint[f->joint].kind]);
    else if (f->joint != FW_NONE)
        fw_device_refused(
            r, record, 77, radius, 1,
            "has no meaning for a prismatic, where friction acts along the line; remove it");
    /* a flexure that could not be read has been reported */
    else if (f->revolute != FW_NONE && !fw_xml_given(record, "radius") &&
             d->revolute[f->revolute].flexure != FW_NOWHERE && !has_surfaces(d, f->revolute))
        fw_diag_error(r->diags, 77, record->element->place,
                      "%s needs radius=\"...\", of the pin on which it slides: the joint has no "
                      "conjugate surfaces to take it from",
                      label);
}

static void check_friction(fw_device_reader *r, const fw_xml_record *record,
                           const fw_device_scene *s, const fw_device_friction_use *f) {
    char label[FW_LABEL], low[FW_LABEL], high[FW_LABEL];
    fw_xml_label(record, label);
    check_what_slides(r, record, f);
    if (f->static_coefficient < f->coefficient)
        fw_diag_error(
            r->diags, 77, fw_xml_place_of(record, "static-coefficient"),
            "%s: static-coefficient %s is below coefficient %s; static friction is at least as "
            "large as sliding friction: exchange them",
            label, fw_xml_in_unit(low, f->static_coefficient, "1"),
            fw_xml_in_unit(high, f->coefficient, "1"));
    for (int i = 0; i < s->nfriction && (f->revolute != FW_NONE || f->joint != FW_NONE); i++)
        if (s->friction[i].revolute == f->revolute && s->friction[i].joint == f->joint) {
            fw_diag_error(r->diags, 97, fw_xml_place_of(record, "on"),
                          "%s: the joint has friction in this scene already (line %d); remove one",
                          label, s->friction[i].place.line);
            return;
        }
}

fw_status fw_device_build_friction(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    int k = fw_device_reference(s->r, record, "on"), joints = s->r->device->nrevolute;
    fw_device_friction_use f = {.revolute = k >= 0 && k < joints ? k : FW_NONE,
                                .joint = k >= joints ? k - joints : FW_NONE,
                                .coefficient = fw_xml_number_of(record, "coefficient"),
                                .static_coefficient =
                                    fw_xml_number_of(record, "static-coefficient"),
                                .radius_m = fw_xml_number_of(record, "radius"),
                                .preload_N = fw_xml_number_or(record, "preload", 0.0),
                                .place = record->element->place};
    check_friction(s->r, record, s->scene, &f);
    s->scene->friction[s->scene->nfriction++] = f;
    return FW_OK;
}

/* ---- contact ---- */

static void check_hinge(fw_device_reader *r, const fw_xml_record *record, const fw_device_scene *s,
                        fw_device_contact_use *c, int k) {
    static const char *const of_points[] = {"a",   "a-x",  "a-y",      "b",       "b-x",
                                            "b-y", "side", "distance", "undrawn", "expansion"};
    const fw_device *d = r->device;
    char label[FW_LABEL];
    fw_xml_label(record, label);
    fw_device_refused(
        r, record, 78, of_points, 10,
        "describes a contact of two points, and this one is on a hinge; remove it, or write "
        "two contacts");
    if (k < 0) return;
    int flexure = k < d->nrevolute ? d->revolute[k].flexure : FW_NONE;
    if (flexure == FW_NOWHERE) return; /* reported */
    if (flexure < 0) {
        fw_diag_error(
            r->diags, 78, fw_xml_place_of(record, "on"),
            "%s: '%s' is not a hinge with a flexure, so that it has no surfaces; name one, "
            "or give a, b, side and distance instead of on",
            label, fw_xml_text_of(record, "on"));
        return;
    }
    c->joint = k;
    if (!fw_xml_given(record, "gap") && d->flexure[flexure].gap_m == 0)
        fw_diag_error(
            r->diags, 78, fw_xml_place_of(record, "on"),
            "%s: flexure '%s' of this hinge has no gap, and so no conjugate surfaces; give "
            "it a gap, or give one here",
            label, d->flexure[flexure].id ? d->flexure[flexure].id : "");
    for (int i = 0; i < s->ncontact; i++)
        if (s->contact[i].joint == k)
            fw_diag_error(r->diags, 97, fw_xml_place_of(record, "on"),
                          "%s: the hinge has a contact in this scene already (line %d); remove one",
                          label, s->contact[i].place.line);
}

static void check_points(fw_device_reader *r, const fw_xml_record *record,
                         fw_device_contact_use *c) {
    static const char *const needs[] = {"a", "b", "side", "distance", "stiffness"};
    static const char *const why[] = {
        "what carries the first of the two that touch; or on=\"...\", a hinge",
        "what carries the second of the two that touch",
        ("inside (a disc in a hole) or outside (side by side), with the distance of the two "
         "centres when they touch, like side=\"outside\" distance=\"40 um\" stiffness=\"100 N/m\""),
        "of the two centres when the two touch, like distance=\"40 um\"",
        "force per length by which they come too near, like stiffness=\"100 N/m\""};
    static const char *const gap[] = {"gap"};
    char label[FW_LABEL];
    for (int i = 0; i < 5; i++)
        if (fw_device_needed(r, record, 78, needs + i, 1, why[i]) && i == 0) return;
    fw_device_refused(r, record, 78, gap, 1,
                      "is that of a hinge's surfaces; for two points write distance instead");
    if (c->face && c->side != FW_CONTACT_OUTSIDE)
        fw_diag_error(
            r->diags, 78, fw_xml_place_of(record, "a-face"),
            "%s: nothing is inside a flat face; write side=\"outside\", or leave a-face out",
            fw_xml_label(record, label));
    if (c->side == FW_CONTACT_OUTSIDE && !c->face && c->distance_m == 0)
        fw_diag_error(r->diags, 78, fw_xml_place_of(record, "distance"),
                      "%s: two circles side by side touch at the sum of their radii, so that "
                      "distance must be above 0",
                      fw_xml_label(record, label));
    if (fw_xml_given(record, "a") && fw_xml_given(record, "b") && c->body_a == c->body_b &&
        c->body_a != FW_NOWHERE)
        fw_diag_error(r->diags, 62, fw_xml_place_of(record, "b"),
                      "%s: '%s' cannot touch itself; a and b must be two bodies, or a body and "
                      "ground",
                      fw_xml_label(record, label), fw_xml_text_of(record, "a"));
}

static fw_device_undrawn undrawn_of(const char *word) {
    if (!word) return FW_UNDRAWN_NOT_SAID;
    return strcmp(word, "placed") == 0 ? FW_UNDRAWN_PLACED : FW_UNDRAWN_ETCHED;
}

fw_status fw_device_build_contact(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    const char *side = fw_xml_text_of(record, "side");
    bool hinge = fw_xml_given(record, "on");
    fw_device_contact_use c = {.id = fw_xml_text_of(record, "id"),
                               .joint = FW_NONE,
                               .side = side && strcmp(side, "outside") == 0 ? FW_CONTACT_OUTSIDE
                                                                            : FW_CONTACT_INSIDE,
                               .body_a = fw_device_reference(s->r, record, "a"),
                               .body_b = fw_device_reference(s->r, record, "b"),
                               .ax_m = fw_xml_number_or(record, "a-x", 0.0),
                               .ay_m = fw_xml_number_or(record, "a-y", 0.0),
                               .bx_m = fw_xml_number_or(record, "b-x", 0.0),
                               .by_m = fw_xml_number_or(record, "b-y", 0.0),
                               .face = fw_xml_given(record, "a-face"),
                               .face_rad = fw_xml_number_or(record, "a-face", 0.0),
                               .distance_m = fw_xml_number_of(record, hinge ? "gap" : "distance"),
                               .stiffness_N_per_m = fw_xml_number_of(record, "stiffness"),
                               .damping_Ns_per_m = fw_xml_number_or(record, "damping", 0.0),
                               .undrawn = undrawn_of(fw_xml_text_of(record, "undrawn")),
                               .expansion_per_K = fw_xml_number_or(record, "expansion", 0.0),
                               .place = record->element->place};
    if (hinge)
        check_hinge(s->r, record, s->scene, &c, fw_device_reference(s->r, record, "on"));
    else
        check_points(s->r, record, &c);
    s->scene->contact[s->scene->ncontact++] = c;
    return FW_OK;
}

/* ---- material-damping, temperature, residual-stress, air ---- */

fw_status fw_device_build_material_damping(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    s->scene->damping[s->scene->ndamping++] =
        (fw_device_material_damping){.loss_factor = fw_xml_number_of(record, "loss-factor"),
                                     .frequency_Hz = fw_xml_number_of(record, "frequency"),
                                     .place = record->element->place};
    return FW_OK;
}

fw_status fw_device_build_temperature(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    fw_device_temperature t = {.change_K = fw_xml_number_of(record, "change"),
                               .expansion_per_K = fw_xml_number_of(record, "expansion"),
                               .substrate_expansion_per_K =
                                   fw_xml_number_of(record, "substrate-expansion"),
                               .modulus_change_per_K = fw_xml_number_of(record, "modulus-change"),
                               .place = record->element->place};
    char label[FW_LABEL], whole[FW_LABEL];
    FW_TRY(fw_device_time_law(s->r, record, &t.law));
    double part = t.change_K * t.modulus_change_per_K;
    if (part <= -1)
        fw_diag_error(s->r->diags, 93, fw_xml_place_of(record, "modulus-change"),
                      "%s: change times modulus-change is %s, so that Young's modulus would be "
                      "0 or negative; the product must stay above -1",
                      fw_xml_label(record, label), fw_xml_in_unit(whole, part, "1"));
    s->scene->temperature[s->scene->ntemperature++] = t;
    return FW_OK;
}

fw_status fw_device_build_residual_stress(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    fw_device_residual_stress stress = {.mean_Pa = fw_xml_number_or(record, "mean", 0.0),
                                        .gradient_Pa_per_m =
                                            fw_xml_number_or(record, "gradient", 0.0),
                                        .place = record->element->place};
    /* a stated 0 is a stress, as the end of a range that a study looks at is */
    if (!fw_xml_given(record, "mean") && !fw_xml_given(record, "gradient"))
        fw_diag_error(
            s->r->diags, 93, stress.place,
            "<residual-stress> without stress changes nothing; give mean or gradient, for "
            "example mean=\"50 MPa\", or remove it");
    s->scene->stress[s->scene->nstress++] = stress;
    return FW_OK;
}

/* ---- air ---- */

/* what does not belong to this kind, and what it needs */
static void check_air_kind(fw_device_reader *r, const fw_xml_record *record,
                           fw_device_air_kind kind) {
    static const char *const of_squeeze[] = {"against", "x", "y", "direction", "length", "depth"};
    static const char *const gap[] = {"gap"}, *const area[] = {"area"};
    static const char *const squeeze[] = {"on", "gap", "length"};
    static const char *const why[] = {"the body whose wall it is",
                                      "how far the two walls are apart", "how long the wall is"};
    if (kind != FW_AIR_SQUEEZE)
        fw_device_refused(r, record, 79, of_squeeze, 6,
                          "belongs to kind=\"squeeze\", a film between two walls; remove it");
    if (kind == FW_AIR_SLIDE)
        fw_device_needed(r, record, 79, gap, 1, "how thick the film is");
    else if (kind == FW_AIR_DRAG)
        fw_device_refused(
            r, record, 79, gap, 1,
            "belongs to a film, and kind=\"drag\" is the open air; remove it, or write "
            "kind=\"slide\"");
    for (int i = 0; i < 3 && kind == FW_AIR_SQUEEZE; i++)
        fw_device_needed(r, record, 79, squeeze + i, 1, why[i]);
    if (kind == FW_AIR_SQUEEZE)
        fw_device_refused(r, record, 79, area, 1,
                          "is length times depth where kind=\"squeeze\"; remove it");
}

/* what it acts on must have a face */
static void check_air_face(fw_device_reader *r, const fw_xml_record *record,
                           const fw_device_air *air) {
    static const char *const area[] = {"area"};
    const fw_device *d = r->device;
    char label[FW_LABEL];
    if (air->kind == FW_AIR_SQUEEZE || air->body == FW_NOWHERE) return;
    if (air->body == FW_NONE)
        fw_device_refused(r, record, 79, area, 1, "is that of one body; name it with on");
    if (fw_xml_given(record, "area")) return;
    for (int i = 0; i < d->nbody; i++) {
        if (fw_device_body_drawn(&d->body[i]) || d->body[i].shape_failed) continue;
        if (air->body != FW_NONE && air->body != i) continue;
        fw_diag_error(r->diags, 79, record->element->place,
                      "%s kind=\"%s\": body '%s' is not drawn, so that its face is not known; %s",
                      fw_xml_label(record, label), fw_xml_text_of(record, "kind"),
                      d->body[i].id ? d->body[i].id : "",
                      air->body == FW_NONE ? "give each body an <air> of its own, with on and area"
                                           : "give area, or the body a shape");
        return;
    }
}

/* the open air acts once on a body; films may be above and below it */
static void check_air_once(fw_device_reader *r, const fw_xml_record *record,
                           const fw_device_scene *s, const fw_device_air *air) {
    for (int i = 0; i < s->nair && air->kind == FW_AIR_DRAG && air->body != FW_NOWHERE; i++) {
        const fw_device_air *other = &s->air[i];
        if (other->kind != FW_AIR_DRAG ||
            (other->body != air->body && other->body != FW_NONE && air->body != FW_NONE))
            continue;
        fw_diag_error(
            r->diags, 97, record->element->place,
            "<air> kind=\"drag\" acts on the same body as that at line %d, and would count "
            "twice; remove one",
            other->place.line);
        return;
    }
}

fw_status fw_device_build_air(fw_device_scene_reader *s, int at) {
    const fw_xml_record *record = &s->r->xml.record[at];
    const char *kind = fw_xml_text_of(record, "kind");
    fw_device_air air = {.body = fw_device_reference(s->r, record, "on"),
                         .against = fw_device_reference(s->r, record, "against"),
                         .gap_m = fw_xml_number_of(record, "gap"),
                         .area_m2 = fw_xml_number_of(record, "area"),
                         .x_m = fw_xml_number_or(record, "x", 0.0),
                         .y_m = fw_xml_number_or(record, "y", 0.0),
                         .direction_rad = fw_xml_number_or(record, "direction", 0.0),
                         .length_m = fw_xml_number_of(record, "length"),
                         .depth_m = fw_xml_number_of(record, "depth"),
                         .pressure_Pa =
                             fw_xml_number_or(record, "pressure", FW_STANDARD_ATMOSPHERE_Pa),
                         .temperature_K = fw_xml_number_or(record, "temperature", 293.15),
                         .viscosity_Pas = fw_xml_number_of(record, "viscosity"),
                         .place = record->element->place};
    if (kind) {
        air.kind = strcmp(kind, "squeeze") == 0 ? FW_AIR_SQUEEZE
                   : strcmp(kind, "drag") == 0  ? FW_AIR_DRAG
                                                : FW_AIR_SLIDE;
        check_air_kind(s->r, record, air.kind);
        check_air_face(s->r, record, &air);
        check_air_once(s->r, record, s->scene, &air);
    }
    if (air.kind == FW_AIR_SQUEEZE && air.body >= 0 && air.body == air.against)
        fw_diag_error(s->r->diags, 62, fw_xml_place_of(record, "against"),
                      "<air>: both walls are on '%s' and never come nearer; name another body, or "
                      "ground",
                      fw_xml_text_of(record, "on"));
    s->scene->air[s->scene->nair++] = air;
    return FW_OK;
}

/* ---- drawings beside the device ---- */

static fw_status misread(fw_device_reader *r, const fw_xml_record *record, const char *what) {
    return fw_diag_error(r->diags, 568, fw_xml_place_of(record, "layers"),
                         "<cell>: layers=\"%.64s\" %s; write it as in \"1/0>mask; 2/0>text\"",
                         fw_xml_text_of(record, "layers"), what);
}

/* a part of the text without the blanks around it */
static const char *part_of(fw_arena *arena, const char *at, size_t n) {
    while (n > 0 && *at == ' ')
        at++, n--;
    while (n > 0 && at[n - 1] == ' ')
        n--;
    return fw_arena_strndup(arena, at, n);
}

/* "1/0>mask; 2/0>text" */
static fw_status read_maps(fw_device_reader *r, const fw_xml_record *record, fw_drawing_map *map,
                           int *n) {
    const char *at = fw_xml_text_of(record, "layers");
    *n = 0;
    if (!at) return FW_OK;
    for (bool more = true; more;) {
        size_t length = strcspn(at, ";,"), from = strcspn(at, ">");
        const char *own = part_of(r->arena, at, length);
        FW_NEED(own);
        if (*own == '\0' && at[length] == '\0' && *n > 0) break; /* a last semicolon */
        if (from >= length) return misread(r, record, "has a part without '>'");
        if (*n == FW_DRAWING_MAPS_MOST) return misread(r, record, "has more than 32 parts");
        fw_drawing_map *m = &map[(*n)++];
        FW_NEED(m->from = part_of(r->arena, at, from));
        FW_NEED(m->to = part_of(r->arena, at + from + 1, length - from - 1));
        if (!*m->from || !*m->to || strchr(m->to, '>'))
            return misread(r, record, "lacks a layer on a side of '>'");
        more = at[length] != '\0';
        at += length + more;
    }
    return FW_OK;
}

static bool any_failed(const fw_xml_record *record) {
    for (int i = 0; i < record->nattribute; i++)
        if ((record->cell[i].given || record->cell[i].missing) && !record->cell[i].ok) return true;
    return false;
}

static bool says_yes(const fw_xml_record *record, const char *name) {
    const char *word = fw_xml_text_of(record, name);
    return word && strcmp(word, "yes") == 0;
}

static fw_drawing_cell_asked asked_by(const fw_xml_record *record) {
    const char *unit = fw_xml_text_of(record, "unit");
    return (fw_drawing_cell_asked){.file = fw_xml_text_of(record, "file"),
                                   .cell = fw_xml_text_of(record, "cell"),
                                   .unit = unit,
                                   .unit_m = fw_device_drawing_unit_m(unit),
                                   .usual = "mask",
                                   .pose = {fw_xml_number_or(record, "x", 0),
                                            fw_xml_number_or(record, "y", 0),
                                            fw_xml_number_or(record, "angle", 0)},
                                   .mirrored = says_yes(record, "mirror"),
                                   .place = fw_xml_place_of(record, "file"),
                                   .cell_place = fw_xml_place_of(record, "cell"),
                                   .unit_place = fw_xml_place_of(record, "unit"),
                                   .layers_place = fw_xml_place_of(record, "layers")};
}

static fw_status keep(fw_device_reader *r, const fw_xml_record *record,
                      const fw_drawing_cell *drawing, fw_device_cell *cell) {
    const char *id = fw_xml_text_of(record, "id"), *file = fw_xml_text_of(record, "file");
    *cell = (fw_device_cell){.file = file,
                             .name = id              ? id
                                     : drawing->name ? drawing->name
                                                     : file,
                             .biased = says_yes(record, "bias"),
                             .nlayer = drawing->nlayer,
                             .place = record->element->place,
                             .layers_place = fw_xml_given(record, "layers")
                                                 ? fw_xml_place_of(record, "layers")
                                                 : record->element->place};
    FW_NEED(cell->layer = fw_arena_array(r->arena, fw_device_cell_layer, (size_t)drawing->nlayer));
    for (int i = 0; i < drawing->nlayer; i++)
        cell->layer[i] = (fw_device_cell_layer){
            .to = drawing->layer[i].to, .drawn = &drawing->layer[i], .role = FW_CELL_ROLE_OPEN};
    return FW_OK;
}

/* *read: false where something was reported */
static fw_status read_cell(fw_device_reader *r, const fw_xml_record *record, fw_device_cell *cell,
                           bool *read) {
    fw_drawing_map map[FW_DRAWING_MAPS_MOST] = {0};
    fw_drawing_cell_asked asked = asked_by(record);
    fw_drawing_cell drawing;
    const char *data;
    size_t n;
    *read = false;
    if (any_failed(record) || !asked.file) return FW_OK; /* reported */
    asked.map = map;
    fw_status status = read_maps(r, record, map, &asked.nmap);
    if (status == FW_OK) status = fw_device_drawing_open(r, record, &data, &n);
    if (status == FW_OK)
        status = fw_drawing_cell_read(r->arena, data, n, &asked, r->diags, &drawing);
    if (status == FW_INPUT || status == FW_IO || status == FW_LIMIT) return FW_OK; /* reported */
    FW_TRY(status);
    *read = true;
    return keep(r, record, &drawing, cell);
}

/* of the die, or of the wafer */
static fw_status build(fw_device_reader *r, const char *parent, const fw_device_cell **out,
                       int *count) {
    fw_device_cell *cell;
    int n = 0;
    for (int i = 0; i < r->xml.nrecord; i++)
        n += fw_xml_is(&r->xml.record[i], "cell");
    if (n == 0) return FW_OK;
    FW_NEED(cell = fw_arena_array(r->arena, fw_device_cell, (size_t)n));
    for (int i = 0; i < r->xml.nrecord; i++) {
        const fw_xml_record *record = &r->xml.record[i];
        bool read = false;
        if (!fw_xml_is(record, "cell") || record->parent < 0 ||
            !fw_xml_is(&r->xml.record[record->parent], parent))
            continue;
        FW_TRY(read_cell(r, record, &cell[*count], &read));
        *count += read;
    }
    *out = cell;
    return FW_OK;
}

fw_status fw_device_build_cells(fw_device_reader *r) {
    FW_TRY(build(r, "device", &r->device->cell, &r->device->ncell));
    FW_TRY(build(r, "wafer", &r->device->wafer.cell, &r->device->wafer.ncell));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
