/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the text of a device file to its description, step by step; later steps run after mistakes
   of earlier ones, so that one run reports everything. */
#include "device/device_reader.h"
#include <math.h>
#include <string.h>

/* a material is needed where stiffness or mass must be computed; a mass that is stated and could
   not be read is no mass that must be computed */
static void check_material(fw_device_reader *r) {
    const fw_device *d = r->device;
    int without_mass = 0;
    for (int i = 0; i < d->nbody; i++)
        without_mass += !(d->body[i].mass_kg > 0.0);
    for (int i = 0; i < r->xml.nrecord; i++)
        without_mass -= fw_xml_failed(&r->xml.record[i], "mass");
    bool needed = d->nflexure > 0 || without_mass > 0;
    if (needed && fw_xml_count(&r->xml, "material") == 0 && !r->xml.unknown_element)
        fw_diag_error(r->diags, 52, r->xml.root->place,
                      "<device> has no <material>, and flexures or shapes need one; add <material "
                      "ref=\"silicon-100\"/> or another of processes/base.xml");
}

static fw_status build(fw_device_reader *r) {
    size_t errors = r->diags->errors;
    FW_TRY(fw_xml_ids_check(&r->xml));
    FW_TRY(fw_device_build_parts(r));
    FW_TRY(fw_device_build_wafer(r));
    FW_TRY(fw_device_build_flexures(r));
    FW_TRY(fw_device_expand_six_bar(r));
    FW_TRY(fw_device_build_mechanism(r));
    if (r->diags->errors == errors)
        FW_TRY(fw_device_close_rounded(r)); /* else places may be missing */
    FW_TRY(fw_device_build_scenes(r));
    check_material(r);
    return FW_OK;
}

fw_status fw_device_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                         const fw_device_set *set, int nset, fw_diags *diags,
                         const fw_device **device) {
    *device = NULL;
    size_t before = diags->errors;
    fw_device *d = fw_arena_one(arena, fw_device);
    FW_NEED(d);
    fw_device_reader r = {.xml = {.arena = arena, .diags = diags, .table = &fw_device_table},
                          .arena = arena,
                          .diags = diags,
                          .device = d};
    FW_TRY(fw_xml_read(arena, file, xml, n, diags, &r.xml.root));
    FW_NEED(d->source = fw_arena_strndup(arena, xml, n));
    FW_NEED(d->file = fw_arena_strdup(arena, file ? file : ""));
    d->source_length = n;
    FW_TRY(fw_device_sets_apply(&r, set, nset));
    FW_TRY(fw_xml_records_read(&r.xml));
    FW_TRY(fw_xml_words_read(&r.xml));
    FW_TRY(fw_device_parameters_read(&r));
    FW_TRY(fw_xml_numbers_read(&r.xml));
    FW_TRY(build(&r));
    if (diags->failed) return FW_NOMEM;
    *device = d;
    return diags->errors > before ? FW_INPUT : FW_OK;
}

/* ---- questions about a description ---- */

bool fw_device_in_flow(const char *asked, const char *flow) {
    return !asked || (flow && strcmp(asked, flow) == 0);
}

bool fw_device_needs_shapes(const fw_device *device) {
    for (int i = 0; i < device->nbody; i++) {
        const fw_device_body *b = &device->body[i];
        if (isnan(b->mass_kg) || isnan(b->inertia_kg_m2) || isnan(b->x_m) || isnan(b->y_m))
            return true;
    }
    return false;
}

int fw_device_flexure_pieces(const fw_device_flexure *f, fw_geometry_strip_piece *piece) {
    if (f->kind == FW_FLEXURE_PATH) {
        for (int i = 0; i < f->npiece; i++)
            piece[i] = f->piece[i];
        return f->npiece;
    }
    double t = f->width_m, middle = f->width_middle_m > 0 ? f->width_middle_m : t;
    *piece = (fw_geometry_strip_piece){.length_m = f->length_m,
                                       .curvature_per_m =
                                           f->kind == FW_FLEXURE_CSFH ? 1 / f->radius_m : 0,
                                       .width_m = {t, middle, t}};
    return 1;
}

bool fw_device_flexure_varies(const fw_device_flexure *f) {
    return f->kind == FW_FLEXURE_PATH || (f->width_middle_m > 0 && f->width_middle_m != f->width_m);
}

double fw_device_flexure_narrowest_m(const fw_device_flexure *f) {
    return f->width_middle_m > 0 && f->width_middle_m < f->width_m ? f->width_middle_m : f->width_m;
}
