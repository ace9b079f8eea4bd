/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <mechanism>: bodies, turning joints and springs. */
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
                 .place = record->element->place};
    if (wide && high) {
        b.plate_x_m = fw_number_or(record, "plate-x", b.x_m);
        b.plate_y_m = fw_number_or(record, "plate-y", b.y_m);
    }
    return b;
}

/* both ends of a joint or spring; false when one is not known */
static bool read_ends(fw_reader *r, const fw_record *record, int *a, int *b) {
    *a = fw_reference(r, record, "a");
    *b = fw_reference(r, record, "b");
    if (*a == FW_NOWHERE || *b == FW_NOWHERE) return false;
    if (*a != *b) return true;
    char label[FW_LABEL];
    fw_diag_error(r->diags, 62, fw_place_of(record, "b"),
                  "%s joins '%s' to itself; a and b must be two bodies, or a body and ground",
                  fw_label(record, label), fw_text_of(record, "a"));
    return false;
}

/* world = pose of the body * local; NaN while the body's pose waits for its shape */
static void to_world(const fw_device *d, int body, double lx_m, double ly_m, double *x_m,
                     double *y_m) {
    *x_m = lx_m;
    *y_m = ly_m;
    if (body < 0) return;
    const fw_body *b = &d->body[body];
    double c = cos(b->phi_rad), s = sin(b->phi_rad);
    *x_m = b->x_m + c * lx_m - s * ly_m;
    *y_m = b->y_m + s * lx_m + c * ly_m;
}

static fw_joint revolute_of(fw_reader *r, const fw_record *record) {
    fw_joint j = {.id = fw_text_of(record, "id"),
                  .x_m = (double)NAN,
                  .y_m = (double)NAN,
                  .ax_m = fw_number_or(record, "a-x", 0.0),
                  .ay_m = fw_number_or(record, "a-y", 0.0),
                  .bx_m = fw_number_or(record, "b-x", 0.0),
                  .by_m = fw_number_or(record, "b-y", 0.0),
                  .stiffness_Nm_per_rad = fw_number_of(record, "stiffness"),
                  .damping_Nms_per_rad = fw_number_of(record, "damping"),
                  .free_angle_rad = fw_number_or(record, "free-angle", 0.0),
                  .flexure = fw_reference(r, record, "hinge"),
                  .axis_rad = fw_number_of(record, "axis"),
                  .place = record->element->place};
    if (read_ends(r, record, &j.body_a, &j.body_b))
        to_world(r->device, j.body_a, j.ax_m, j.ay_m, &j.x_m, &j.y_m);
    return j;
}

static fw_spring spring_of(fw_reader *r, const fw_record *record) {
    fw_spring s = {.id = fw_text_of(record, "id"),
                   .ax_m = fw_number_or(record, "a-x", 0.0),
                   .ay_m = fw_number_or(record, "a-y", 0.0),
                   .bx_m = fw_number_or(record, "b-x", 0.0),
                   .by_m = fw_number_or(record, "b-y", 0.0),
                   .stiffness_N_per_m = fw_number_of(record, "stiffness"),
                   .damping_Ns_per_m = fw_number_or(record, "damping", 0.0),
                   .length_m = fw_number_or(record, "length", 0.0),
                   .place = record->element->place};
    read_ends(r, record, &s.body_a, &s.body_b);
    return s;
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
    FW_NEED(d->spring = fw_arena_array(r->arena, fw_spring, (size_t)fw_count(r, "spring")));
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "body")) d->body[d->nbody++] = body_of(r, &r->record[i]);
    check_present(r);
    for (int i = 0; i < r->nrecord; i++) {
        if (fw_is(&r->record[i], "revolute"))
            d->joint[d->njoint++] = revolute_of(r, &r->record[i]);
        else if (fw_is(&r->record[i], "spring"))
            d->spring[d->nspring++] = spring_of(r, &r->record[i]);
    }
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
