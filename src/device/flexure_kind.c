/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What kinds of <flexure> share: limits of their widths, and how lines and arcs become one. */
#include "device/flexure_kind.h"
#include <math.h>

static void too_stout(fw_device_reader *r, const fw_xml_record *record, fw_place place,
                      const fw_device_flexure *f) {
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    fw_diag_error(r->diags, 59, place,
                  "%s: width %s is more than a quarter of the length (%s); beam formulas do not "
                  "hold for so stout a flexure; make it thinner or longer",
                  fw_xml_label(record, label), fw_xml_in_unit(a, f->width_m, "um"),
                  fw_xml_in_unit(b, f->length_m, "um"));
}

void fw_device_flexure_slender(fw_device_reader *r, const fw_xml_record *record,
                               const fw_device_flexure *f) {
    if (f->width_m > f->length_m / 4 || f->width_middle_m > f->length_m / 4)
        too_stout(r, record, fw_xml_place_of(record, "width"), f);
}

/* least of all widths: below it the data of materials do not hold (table_device.c) */
static const double thinnest_m = 1e-7;

bool fw_device_flexure_edges(fw_device_reader *r, const fw_xml_record *record,
                             const fw_geometry_strip_piece *p) {
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    fw_geometry_strip_shape shape;
    double least, most;
    fw_geometry_strip_shape_of(p, &shape);
    fw_geometry_strip_widths(&shape, &least, &most);
    if (!(least >= thinnest_m)) {
        fw_diag_error(r->diags, 263, fw_xml_place_of(record, "width-middle"),
                      "%s: between its ends the width vanishes or falls to %s (least: 0.1 um), "
                      "where its edges run as arcs through start, middle and end; make the widths "
                      "less different, or give the middle as a piece of its own",
                      fw_xml_label(record, label), fw_xml_in_unit(a, least, "um"));
        return false;
    }
    if (p->curvature_per_m == 0 || most < 2 / fabs(p->curvature_per_m)) return true;
    fw_diag_error(r->diags, 263, fw_xml_place_of(record, "width"),
                  "%s: width %s is not below twice the radius (%s), so the inner edge of the arc "
                  "has no radius left; make it thinner, or take a greater radius",
                  fw_xml_label(record, label), fw_xml_in_unit(a, most, "um"),
                  fw_xml_in_unit(b, 2 / fabs(p->curvature_per_m), "um"));
    return false;
}

void fw_device_flexure_middle(fw_device_reader *r, const fw_xml_record *record,
                              const fw_device_flexure *f) {
    fw_geometry_strip_piece one;
    if (!(f->width_middle_m > 0 && f->width_m > 0 && f->length_m > 0)) return;
    fw_device_flexure_pieces(f, &one);
    fw_device_flexure_edges(r, record, &one);
}

/* a path that meets itself, and ends that lie too near to each other for two bodies */
static void check_whole(fw_device_reader *r, const fw_xml_record *record,
                        const fw_device_flexure *f) {
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    int i, j;
    if (fw_geometry_strip_crosses(f->piece, f->npiece, &i, &j)) {
        fw_diag_error(r->diags, 264, record->element->place,
                      i == j ? "%s: piece %d meets itself; make its angle smaller"
                             : "%s: the path crosses itself: pieces %d and %d; change lengths or "
                               "angles",
                      fw_xml_label(record, label), i + 1, j + 1);
        return;
    }
    fw_geometry_pose end = fw_geometry_strip_end(f->piece, f->npiece, (fw_geometry_pose){0});
    double apart = hypot(end.x_m, end.y_m);
    double wide = f->piece[0].width_m[0] + f->piece[f->npiece - 1].width_m[2];
    if (apart < 2 * wide)
        fw_diag_error(r->diags, 264, record->element->place,
                      "%s: its two ends are %s apart; two roots need twice the sum of the widths "
                      "there (%s): open the path",
                      fw_xml_label(record, label), fw_xml_in_unit(a, apart, "um"),
                      fw_xml_in_unit(b, 2 * wide, "um"));
    if (f->width_m > f->length_m / 4) too_stout(r, record, record->element->place, f);
}

void fw_device_flexure_lay(fw_device_reader *r, const fw_xml_record *record,
                           const fw_geometry_strip_piece *piece, int n, fw_device_flexure *f) {
    double least = HUGE_VAL;
    f->kind = FW_FLEXURE_PATH;
    f->piece = piece, f->npiece = n, f->angle_rad = 0;
    f->length_m = fw_geometry_strip_length(piece, n);
    for (int i = 0; i < n; i++) {
        fw_geometry_strip_shape shape;
        double low, high;
        fw_geometry_strip_shape_of(&piece[i], &shape);
        fw_geometry_strip_widths(&shape, &low, &high);
        least = fmin(least, low);
        f->angle_rad += piece[i].curvature_per_m * piece[i].length_m;
    }
    f->width_m = least;
    check_whole(r, record, f);
}
