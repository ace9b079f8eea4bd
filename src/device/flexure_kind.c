/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of <flexure>, a row each, and what they share; questions about a description. */
#include "device/device_reader.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- what kinds share: limits of their widths, and how lines and arcs become one ---- */

static void too_stout(fw_device_reader *r, const fw_xml_record *record, fw_place place,
                      const fw_device_flexure *f) {
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL];
    fw_diag_error(r->diags, 59, place,
                  "%s: width %s is more than a quarter of the length (%s); beam formulas do not "
                  "hold for so stout a flexure; make it thinner or longer",
                  fw_xml_label(record, label), fw_xml_in_unit(a, f->width_m, "um"),
                  fw_xml_in_unit(b, f->length_m, "um"));
}

/* a width above a quarter of the length */
static void check_slender(fw_device_reader *r, const fw_xml_record *record,
                          const fw_device_flexure *f) {
    if (f->width_m > f->length_m / 4 || f->width_middle_m > f->length_m / 4)
        too_stout(r, record, fw_xml_place_of(record, "width"), f);
}

/* least of all widths: below it the data of materials do not hold (table_device.c) */
static const double thinnest_m = 1e-7;

bool fw_device_flexure_edges(fw_device_reader *r, const fw_xml_record *record,
                             const fw_geometry_strip_piece *p) {
    char label[FW_LABEL], a[FW_LABEL], b[FW_LABEL], thin[FW_LABEL + 16] = "vanishes";
    fw_geometry_strip_shape shape;
    double least, most;
    fw_geometry_strip_shape_of(p, &shape);
    fw_geometry_strip_widths(&shape, &least, &most);
    if (!(least >= thinnest_m)) { /* no width at all where its edges are no arcs any more */
        if (least > 0) snprintf(thin, sizeof thin, "falls to %s", fw_xml_in_unit(a, least, "um"));
        fw_diag_error(r->diags, 263, fw_xml_place_of(record, "width-middle"),
                      "%s: between its ends the width %s (least: 0.1 um), "
                      "where its edges run as arcs through start, middle and end; make the widths "
                      "less different, or give the middle as a piece of its own",
                      fw_xml_label(record, label), thin);
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

/* width-middle of a csfh or leaf: both edges one arc, the ends as wide as `width` */
static void check_middle(fw_device_reader *r, const fw_xml_record *record,
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

/* ---- csfh: a circular arc between conjugate surfaces, by two of its length, radius and angle ---- */

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

static fw_status build_csfh(fw_device_reader *r, int at, fw_device_flexure *f) {
    const fw_xml_record *record = &r->xml.record[at];
    f->kind = FW_FLEXURE_CSFH;
    if (!complete_arc(r, record, f)) return FW_OK;
    check_arc(r, record, f);
    if (!(f->width_m < 2 * f->radius_m)) return FW_OK;
    check_slender(r, record, f);
    check_middle(r, record, f);
    return FW_OK;
}

static const char *const csfh_takes[] = {"length", "radius", "angle", "width-middle", NULL};
const fw_device_flexure_row fw_device_flexure_csfh = {
    .name = "csfh", .takes = csfh_takes, .build = build_csfh};

/* ---- leaf: a straight strip of stated length ---- */

static fw_status build_leaf(fw_device_reader *r, int at, fw_device_flexure *f) {
    const fw_xml_record *record = &r->xml.record[at];
    char label[FW_LABEL];
    f->kind = FW_FLEXURE_LEAF;
    if (!f->length_given)
        fw_diag_error(r->diags, 58, record->element->place, "%s: a leaf needs its length",
                      fw_xml_label(record, label));
    check_slender(r, record, f);
    check_middle(r, record, f);
    return FW_OK;
}

static const char *const leaf_takes[] = {"length", "width-middle", NULL};
const fw_device_flexure_row fw_device_flexure_leaf = {
    .name = "leaf",
    .takes = leaf_takes,
    .refused = {58, "a leaf is straight and has no ", "; remove it or write kind=\"csfh\""},
    .build = build_leaf};

/* ---- path: lines and arcs of any width, one after the other, <line> and <arc> ---- */

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

static fw_status build_path(fw_device_reader *r, int at, fw_device_flexure *f) {
    f->kind = FW_FLEXURE_PATH;
    f->angle_rad = 0, f->width_middle_m = 0;
    return fw_xml_failed(&r->xml.record[at], "width") ? FW_OK : read_path(r, at, f);
}

static const char *const path_takes[] = {NULL};
const fw_device_flexure_row fw_device_flexure_path = {
    .name = "path",
    .takes = path_takes,
    .refused = {262, "", " belongs to the pieces of a path; move it there"},
    .pieces = true,
    .build = build_path};

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

bool fw_device_body_drawn(const fw_device_body *body) {
    return !isnan(body->width_m) || !isnan(body->plate_width_m) || body->nshape > 0;
}
