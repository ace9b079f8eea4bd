/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <material-damping>, <temperature>, <residual-stress>, <air>. */
#include "device/scene_parts.h"
#include "base/constants.h"
#include <math.h>
#include <string.h>

fw_status fw_build_material_damping(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    s->scene->damping[s->scene->ndamping++] =
        (fw_material_damping){.loss_factor = fw_number_of(record, "loss-factor"),
                              .frequency_Hz = fw_number_of(record, "frequency"),
                              .place = record->element->place};
    return FW_OK;
}

fw_status fw_build_temperature(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    fw_temperature t = {.change_K = fw_number_of(record, "change"),
                        .expansion_per_K = fw_number_of(record, "expansion"),
                        .substrate_expansion_per_K = fw_number_of(record, "substrate-expansion"),
                        .modulus_change_per_K = fw_number_of(record, "modulus-change"),
                        .place = record->element->place};
    char label[FW_LABEL], whole[FW_LABEL];
    FW_TRY(fw_time_law(s->r, record, &t.law));
    double part = t.change_K * t.modulus_change_per_K;
    if (part <= -1)
        fw_diag_error(s->r->diags, 93, fw_place_of(record, "modulus-change"),
                      "%s: change times modulus-change is %s, so that Young's modulus would be "
                      "0 or negative; the product must stay above -1",
                      fw_label(record, label), fw_in_unit(whole, part, "1"));
    s->scene->temperature[s->scene->ntemperature++] = t;
    return FW_OK;
}

fw_status fw_build_residual_stress(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    fw_residual_stress stress = {.mean_Pa = fw_number_or(record, "mean", 0.0),
                                 .gradient_Pa_per_m = fw_number_or(record, "gradient", 0.0),
                                 .place = record->element->place};
    if (stress.mean_Pa == 0 && stress.gradient_Pa_per_m == 0)
        fw_diag_error(
            s->r->diags, 93, stress.place,
            "<residual-stress> without stress changes nothing; give mean or gradient, for "
            "example mean=\"50 MPa\", or remove it");
    s->scene->stress[s->scene->nstress++] = stress;
    return FW_OK;
}

/* ---- air ---- */

/* what does not belong to this kind, and what it needs */
static void check_air_kind(fw_reader *r, const fw_record *record, fw_air_kind kind) {
    static const char *const of_squeeze[] = {"against", "x", "y", "direction", "length", "depth"};
    static const char *const gap[] = {"gap"}, *const area[] = {"area"};
    static const char *const squeeze[] = {"on", "gap", "length"};
    static const char *const why[] = {"the body whose wall it is",
                                      "how far the two walls are apart", "how long the wall is"};
    if (kind != FW_AIR_SQUEEZE)
        fw_refused(r, record, 79, of_squeeze, 6,
                   "belongs to kind=\"squeeze\", a film between two walls; remove it");
    if (kind == FW_AIR_SLIDE)
        fw_needed(r, record, 79, gap, 1, "how thick the film is");
    else if (kind == FW_AIR_DRAG)
        fw_refused(r, record, 79, gap, 1,
                   "belongs to a film, and kind=\"drag\" is the open air; remove it, or write "
                   "kind=\"slide\"");
    for (int i = 0; i < 3 && kind == FW_AIR_SQUEEZE; i++)
        fw_needed(r, record, 79, squeeze + i, 1, why[i]);
    if (kind == FW_AIR_SQUEEZE)
        fw_refused(r, record, 79, area, 1,
                   "is length times depth where kind=\"squeeze\"; remove it");
}

/* what it acts on must have a face */
static void check_air_face(fw_reader *r, const fw_record *record, const fw_air *air) {
    static const char *const area[] = {"area"};
    const fw_device *d = r->device;
    char label[FW_LABEL];
    if (air->kind == FW_AIR_SQUEEZE || air->body == FW_NOWHERE) return;
    if (air->body == FW_NONE)
        fw_refused(r, record, 79, area, 1, "is that of one body; name it with on");
    if (fw_given(record, "area")) return;
    for (int i = 0; i < d->nbody; i++) {
        if (fw_body_drawn(&d->body[i]) || (air->body != FW_NONE && air->body != i)) continue;
        fw_diag_error(r->diags, 79, record->element->place,
                      "%s kind=\"%s\": body '%s' is not drawn, so that its face is not known; %s",
                      fw_label(record, label), fw_text_of(record, "kind"),
                      d->body[i].id ? d->body[i].id : "",
                      air->body == FW_NONE ? "give each body an <air> of its own, with on and area"
                                           : "give area, or the body a shape");
        return;
    }
}

/* the open air acts once on a body; films may be above and below it */
static void check_air_once(fw_reader *r, const fw_record *record, const fw_scene *s,
                           const fw_air *air) {
    for (int i = 0; i < s->nair && air->kind == FW_AIR_DRAG && air->body != FW_NOWHERE; i++) {
        const fw_air *other = &s->air[i];
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

fw_status fw_build_air(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    const char *kind = fw_text_of(record, "kind");
    fw_air air = {.body = fw_reference(s->r, record, "on"),
                  .against = fw_reference(s->r, record, "against"),
                  .gap_m = fw_number_of(record, "gap"),
                  .area_m2 = fw_number_of(record, "area"),
                  .x_m = fw_number_or(record, "x", 0.0),
                  .y_m = fw_number_or(record, "y", 0.0),
                  .direction_rad = fw_number_or(record, "direction", 0.0),
                  .length_m = fw_number_of(record, "length"),
                  .depth_m = fw_number_of(record, "depth"),
                  .pressure_Pa = fw_number_or(record, "pressure", FW_STANDARD_ATMOSPHERE_Pa),
                  .temperature_K = fw_number_or(record, "temperature", 293.15),
                  .viscosity_Pas = fw_number_of(record, "viscosity"),
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
        fw_diag_error(s->r->diags, 62, fw_place_of(record, "against"),
                      "<air>: both walls are on '%s' and never come nearer; name another body, or "
                      "ground",
                      fw_text_of(record, "on"));
    s->scene->air[s->scene->nair++] = air;
    return FW_OK;
}
