/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines and arcs of any width, one after the other: <line> and <arc>. */
#include "device/flexure_kind.h"
#include <math.h>

enum { UNKNOWN = -1 }; /* width where the piece before ends, which was reported */

static bool failed_any(const fw_xml_record *record, const char *const *name, int n) {
    bool failed = false;
    for (int i = 0; i < n; i++)
        failed = failed || fw_xml_failed(record, name[i]);
    return failed;
}

/* one <line> or <arc>; `before`: the width where it begins */
static bool read_piece(fw_device_reader *r, const fw_xml_record *record, double before,
                       fw_geometry_strip_piece *p) {
    static const char *const line[] = {"length", "width", "width-middle", "width-end"};
    static const char *const bent[] = {"radius", "angle", "width", "width-middle", "width-end"};
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    bool arc = fw_xml_is(record, "arc");
    if (arc ? failed_any(record, bent, 5) : failed_any(record, line, 4)) return false;
    double *w = p->width_m;
    w[0] = fw_xml_number_or(record, "width", before);
    if (before == UNKNOWN && !(w[0] > 0)) return false;
    if (before > 0 && fabs(w[0] - before) > 1e-12) {
        fw_diag_error(
            r->diags, 263, fw_xml_place_of(record, "width"),
            "%s: begins with width %s, but the path so far ends with width %s; beam theory does "
            "not cover the stress concentration of such a step: leave width out, or "
            "set width-end before (at the first piece: width of the flexure)",
            fw_xml_label(record, label), fw_xml_in_unit(a, w[0], "um"),
            fw_xml_in_unit(b, before, "um"));
        return false;
    }
    if (before > 0) w[0] = before;
    w[2] = fw_xml_number_or(record, "width-end", w[0]);
    w[1] = fw_xml_number_or(record, "width-middle", 0.5 * (w[0] + w[2]));
    if (!arc) {
        p->length_m = fw_xml_number_of(record, "length");
        return fw_device_flexure_edges(r, record, p);
    }
    double radius = fw_xml_number_of(record, "radius"), angle = fw_xml_number_of(record, "angle");
    if (angle == 0) {
        fw_diag_error(
            r->diags, 262, fw_xml_place_of(record, "angle"),
            "%s: an arc of 0 deg has no length; remove it, or write <line length=\"...\"/>",
            fw_xml_label(record, label));
        return false;
    }
    p->length_m = radius * fabs(angle);
    p->curvature_per_m = copysign(1 / radius, angle);
    return fw_device_flexure_edges(r, record, p);
}

/* children in their order; what is wrong with one is said there and the whole is not judged */
static fw_status read_path(fw_device_reader *r, int at, fw_device_flexure *f) {
    const fw_xml_record *record = &r->xml.record[at];
    char label[FW_LABEL];
    fw_geometry_strip_piece *piece;
    double before = f->width_m;
    bool ok = true;
    int n = 0;
    FW_NEED(piece = fw_arena_array(r->arena, fw_geometry_strip_piece, FW_STRIP_MOST));
    for (int i = at + 1; i < r->xml.nrecord && r->xml.record[i].parent >= at; i++) {
        if (r->xml.record[i].parent != at) continue;
        if (n == FW_STRIP_MOST) {
            fw_diag_error(r->diags, 262, r->xml.record[i].element->place,
                          "%s: a path has at most %d pieces; join some",
                          fw_xml_label(record, label), FW_STRIP_MOST);
            return FW_OK;
        }
        bool good = read_piece(r, &r->xml.record[i], before, &piece[n]);
        before = good ? piece[n].width_m[2] : UNKNOWN;
        ok = ok && good;
        n++;
    }
    f->piece = piece, f->npiece = n, f->width_m = (double)NAN;
    if (ok && n == 0 && !r->xml.unknown_element)
        fw_diag_error(r->diags, 262, record->element->place,
                      "%s: a path needs its pieces: <line length=\"...\"/> and "
                      "<arc radius=\"...\" angle=\"...\"/> in their order",
                      fw_xml_label(record, label));
    if (ok && n > 0) fw_device_flexure_lay(r, record, piece, n, f);
    return FW_OK;
}

static fw_status build(fw_device_reader *r, int at, fw_device_flexure *f) {
    f->kind = FW_FLEXURE_PATH;
    f->angle_rad = 0, f->width_middle_m = 0;
    return fw_xml_failed(&r->xml.record[at], "width") ? FW_OK : read_path(r, at, f);
}

static const char *const takes[] = {NULL};
const fw_device_flexure_row fw_device_flexure_path = {
    .name = "path",
    .takes = takes,
    .refused = {262, "", " belongs to the pieces of a path; move it there"},
    .pieces = true,
    .build = build};
