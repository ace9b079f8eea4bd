/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <mechanism>: its bodies; joints are in build_joints.c. */
#include "device/reader.h"
#include <math.h>

void fw_mass_check(fw_reader *r, const fw_record *record, bool shape, const char *shape_advice) {
    char label[FW_LABEL];
    bool mass = fw_given(record, "mass"), inertia = fw_given(record, "inertia");
    if (mass != inertia)
        fw_diag_error(
            r->diags, 64, fw_place_of(record, mass ? "mass" : "inertia"),
            "%s: mass and inertia belong together; add the %s, or remove this one and give "
            "a shape",
            fw_label(record, label), mass ? "inertia" : "mass");
    else if (!mass && !shape)
        fw_diag_error(r->diags, 61, record->element->place,
                      "%s has neither mass and inertia nor a shape; give both, or %s",
                      fw_label(record, label), shape_advice);
}

bool fw_body_drawn(const fw_body *body) {
    return !isnan(body->width_m) || !isnan(body->plate_width_m);
}

void fw_wafer_check(fw_reader *r, const fw_record *record, const char *name, double value_m) {
    const double most_m = 0.3;
    char label[FW_LABEL], value[FW_LABEL];
    if (!(fabs(value_m) > most_m * (1 + 1e-12))) return;
    fw_diag_error(
        r->diags, 47, fw_place_of(record, name),
        "%s: %s puts it at %s; what is drawn must lie within -300 mm and 300 mm (wafers are at "
        "most 300 mm wide); leave the width out for a mechanism that is only computed",
        fw_label(record, label), name, fw_in_unit(value, value_m, "mm"));
}

static fw_body body_of(fw_reader *r, const fw_record *record) {
    bool wide = fw_given(record, "plate-width"), high = fw_given(record, "plate-height");
    char label[FW_LABEL];
    if (wide != high)
        fw_diag_error(r->diags, 64, fw_place_of(record, wide ? "plate-width" : "plate-height"),
                      "%s: plate-width and plate-height belong together; add the other",
                      fw_label(record, label));
    fw_mass_check(r, record, fw_given(record, "width") || wide || high,
                  "width (bars to its joints) or plate-width and plate-height");
    fw_body b = {.id = fw_text_of(record, "id"),
                 .mass_kg = fw_number_of(record, "mass"),
                 .inertia_kg_m2 = fw_number_of(record, "inertia"),
                 .x_m = fw_number_of(record, "x"),
                 .y_m = fw_number_of(record, "y"),
                 .phi_rad = fw_number_or(record, "phi", 0.0),
                 .width_m = fw_number_of(record, "width"),
                 .plate_width_m = fw_number_of(record, "plate-width"),
                 .plate_height_m = fw_number_of(record, "plate-height"),
                 .plate_x_m = (double)NAN,
                 .plate_y_m = (double)NAN,
                 .plate_angle_rad = fw_number_or(record, "plate-angle", 0.0),
                 .place = record->element->place,
                 .width_place = fw_place_of(record, "width")};
    if (wide && high) {
        b.plate_x_m = fw_number_or(record, "plate-x", b.x_m);
        b.plate_y_m = fw_number_or(record, "plate-y", b.y_m);
    }
    if (fw_body_drawn(&b)) {
        fw_wafer_check(r, record, "x", b.x_m);
        fw_wafer_check(r, record, "y", b.y_m);
        fw_wafer_check(r, record, "plate-x", b.plate_x_m);
        fw_wafer_check(r, record, "plate-y", b.plate_y_m);
    }
    return b;
}

static void check_present(fw_reader *r) {
    const fw_record *mechanism = NULL;
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "mechanism")) mechanism = &r->record[i];
    if (r->unknown_element || r->device->nbody > 0) return;
    if (mechanism)
        fw_diag_error(r->diags, 52, mechanism->element->place,
                      "<mechanism> has no <body>; add at least one");
    else
        fw_diag_error(r->diags, 52, r->root->place,
                      "<device> has no mechanism; add <six-bar> or <mechanism>");
}

fw_status fw_build_mechanism(fw_reader *r) {
    fw_device *d = r->device;
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "body")) d->body[d->nbody++] = body_of(r, &r->record[i]);
    check_present(r);
    return fw_build_joints(r);
}
