/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A circular arc between conjugate surfaces, by two of its length, radius and angle. */
#include "device/flexure_kind.h"
#include <math.h>

/* exactly two of length, radius, angle; the third follows from length = radius angle */
static bool complete_arc(fw_device_reader *r, const fw_xml_record *record, fw_device_flexure *f) {
    char label[FW_LABEL];
    bool length = fw_xml_given(record, "length"), radius = fw_xml_given(record, "radius");
    bool angle = fw_xml_given(record, "angle");
    if (length + radius + angle != 2) {
        fw_diag_error(r->diags, 58, record->element->place,
                      "%s: a csfh needs exactly two of length, radius and angle (length = radius x "
                      "angle); %d given",
                      fw_xml_label(record, label), length + radius + angle);
        return false;
    }
    if (!length)
        f->length_m = f->radius_m * f->angle_rad;
    else if (!radius)
        f->radius_m = f->length_m / f->angle_rad;
    else
        f->angle_rad = f->length_m / f->radius_m;
    return !fw_xml_failed(record, "length") && !fw_xml_failed(record, "radius") &&
           !fw_xml_failed(record, "angle");
}

static void check_arc(fw_device_reader *r, const fw_xml_record *record,
                      const fw_device_flexure *f) {
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    if (f->angle_rad > 330 * FW_PI / 180 * (1 + 1e-12))
        fw_diag_error(r->diags, 59, f->length_place,
                      "%s: length over radius is an angle of %s; it must be at most 330 deg, else "
                      "the ends of the arc meet; shorten it or take a greater radius",
                      fw_xml_label(record, label), fw_xml_in_unit(a, f->angle_rad, "deg"));
    if (f->width_m >= 2 * f->radius_m)
        fw_diag_error(
            r->diags, 59, fw_xml_place_of(record, "width"),
            "%s: width %s is not below twice the radius (%s), so the inner side of the arc "
            "has no radius left; make it thinner",
            fw_xml_label(record, label), fw_xml_in_unit(a, f->width_m, "um"),
            fw_xml_in_unit(b, 2 * f->radius_m, "um"));
}

static fw_status build(fw_device_reader *r, int at, fw_device_flexure *f) {
    const fw_xml_record *record = &r->xml.record[at];
    f->kind = FW_FLEXURE_CSFH;
    if (!complete_arc(r, record, f)) return FW_OK;
    check_arc(r, record, f);
    if (!(f->width_m < 2 * f->radius_m)) return FW_OK;
    fw_device_flexure_slender(r, record, f);
    fw_device_flexure_middle(r, record, f);
    return FW_OK;
}

static const char *const takes[] = {"length", "radius", "angle", "width-middle", NULL};
const fw_device_flexure_row fw_device_flexure_csfh = {
    .name = "csfh", .takes = takes, .build = build};
