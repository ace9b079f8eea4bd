/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <flexure>: what all kinds have, and which kind it is (flexures.def). */
#include "device/flexure_kind.h"
#include <math.h>
#include <string.h>

#define FW_DEVICE_FLEXURE(name, sentence)                                                          \
    extern const fw_device_flexure_row fw_device_flexure_##name;
#include "device/flexures.def"
#undef FW_DEVICE_FLEXURE
#define FW_DEVICE_FLEXURE(name, sentence) &fw_device_flexure_##name,
static const fw_device_flexure_row *const kinds[] = {
#include "device/flexures.def"
};
#undef FW_DEVICE_FLEXURE
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* ---- what kinds share ---- */

void fw_device_flexure_slender(fw_device_reader *r, const fw_xml_record *record,
                               const fw_device_flexure *f) {
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    if (f->width_m > f->length_m / 4 || f->width_middle_m > f->length_m / 4)
        fw_diag_error(
            r->diags, 59, fw_xml_place_of(record, "width"),
            "%s: width %s is more than a quarter of the length (%s); beam formulas do not "
            "hold for so stout a flexure; make it thinner or longer",
            fw_xml_label(record, label), fw_xml_in_unit(a, f->width_m, "um"),
            fw_xml_in_unit(b, f->length_m, "um"));
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
    if (f->width_m > f->length_m / 4)
        fw_diag_error(
            r->diags, 59, record->element->place,
            "%s: width %s is more than a quarter of the length (%s); beam formulas do not "
            "hold for so stout a flexure; make it thinner or longer",
            fw_xml_label(record, label), fw_xml_in_unit(a, f->width_m, "um"),
            fw_xml_in_unit(b, f->length_m, "um"));
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

/* ---- what a kind has no use for ---- */

static void refuse_pieces(fw_device_reader *r, int at, const char *kind) {
    char label[FW_LABEL];
    for (int i = at + 1; i < r->xml.nrecord && r->xml.record[i].parent >= at; i++)
        if (r->xml.record[i].parent == at)
            fw_diag_error(r->diags, 262, r->xml.record[i].element->place,
                          "%s: a %s has no pieces of its own; remove <%s>, or write kind=\"path\"",
                          fw_xml_label(&r->xml.record[at], label), kind,
                          r->xml.record[i].row->name);
}

static bool takes(const fw_device_flexure_row *kind, const char *name) {
    for (const char *const *own = kind->takes; *own; own++)
        if (strcmp(*own, name) == 0) return true;
    return false;
}

static void refuse_attributes(fw_device_reader *r, const fw_xml_record *record,
                              const fw_device_flexure_row *kind) {
    static const char *const name[] = {"length", "radius", "angle", "width-middle"};
    char label[FW_LABEL];
    for (int i = 0; i < 4; i++) {
        if (!fw_xml_given(record, name[i]) || takes(kind, name[i])) continue;
        fw_place place = fw_xml_place_of(record, name[i]);
        if (kind->refused.number)
            fw_diag_error(r->diags, kind->refused.number, place, "%s: %s%s%s",
                          fw_xml_label(record, label), kind->refused.before, name[i],
                          kind->refused.after);
        else
            fw_diag_error(r->diags, 58, place, "%s: a %s has no %s; remove it",
                          fw_xml_label(record, label), kind->name, name[i]);
    }
}

/* ---- the whole ---- */

static const fw_device_flexure_row *kind_of(const fw_xml_record *record) {
    const char *name = fw_xml_text_of(record, "kind");
    for (int i = 0; name && i < KINDS; i++)
        if (strcmp(kinds[i]->name, name) == 0) return kinds[i];
    return NULL;
}

static fw_status flexure_of(fw_device_reader *r, int at, fw_device_flexure *f) {
    const fw_xml_record *record = &r->xml.record[at];
    const fw_device_flexure_row *kind = kind_of(record);
    bool length = fw_xml_given(record, "length");
    *f = (fw_device_flexure){.id = fw_xml_text_of(record, "id"),
                             .length_m = fw_xml_number_of(record, "length"),
                             .angle_rad = fw_xml_number_of(record, "angle"),
                             .radius_m = fw_xml_number_of(record, "radius"),
                             .width_m = fw_xml_number_of(record, "width"),
                             .width_middle_m = fw_xml_number_or(record, "width-middle", 0.0),
                             .gap_m = fw_xml_number_or(record, "gap", 0.0),
                             .fillet_m = fw_xml_number_of(record, "fillet"),
                             .fillet_place = fw_xml_place_of(record, "fillet"),
                             .length_given = length,
                             .radius_given = fw_xml_given(record, "radius"),
                             .place = record->element->place,
                             .length_place = fw_xml_place_of(record, length ? "length" : "radius")};
    if (!kind) return FW_OK; /* reported */
    if (!kind->pieces) refuse_pieces(r, at, kind->name);
    refuse_attributes(r, record, kind);
    return kind->build(r, at, f);
}

fw_status fw_device_build_flexures(fw_device_reader *r) {
    fw_device *d = r->device;
    FW_NEED(d->flexure = fw_arena_array(r->arena, fw_device_flexure,
                                        (size_t)fw_xml_count(&r->xml, "flexure")));
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "flexure"))
            FW_TRY(flexure_of(r, i, &d->flexure[d->nflexure++]));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
