/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON of this room: certificate (flexwright.mask/1) with the list of test patterns, findings
   (flexwright.violations/1), order sheet (flexwright.order/1). docs/theory/masks.md and
   docs/reference/json.md explain every member. */
#include "base/json.h"
#include "base/constants.h"
#include "geometry/segment.h"
#include "mask/rule.h"
#include "mask/mask_parts.h"
#include "mask/mask.h"
#include <math.h>

static double degrees(double rad) {
    return rad * (180 / FW_PI);
}

static void gds_of(fw_json *json, const char *key, const fw_mask_layer *y) {
    fw_json_textf(json, key, "%d/%d", y->layer, y->datatype);
}

/* [x, y, ...] */
static void micrometres(fw_json *json, const char *key, const double *metres, int n) {
    fw_json_list(json, key);
    for (int i = 0; i < n; i++)
        fw_json_number(json, NULL, metres[i] * 1e6, 12);
    fw_json_end(json);
}

static void box_um(fw_json *json, const char *key, fw_geometry_box b) {
    micrometres(json, key, (double[]){b.x0, b.y0, b.x1, b.y1}, 4);
}

/* a point to be found under a microscope: four decimals */
static void place(fw_json *json, const char *key, fw_geometry_vec2 at) {
    fw_json_list(json, key);
    fw_json_fixed(json, NULL, at.x * 1e6, 4);
    fw_json_fixed(json, NULL, at.y * 1e6, 4);
    fw_json_end(json);
}

/* every member on a line of its own */
static void line_text(fw_json *json, const char *key, const char *value) {
    fw_json_line(json, 2);
    fw_json_text(json, key, value);
}

/* a list with one line per file; without any, its brackets stand together */
void fw_mask_json_files(fw_json *json, const fw_output_file *file, int n) {
    fw_json_line(json, 2);
    fw_json_list(json, "files");
    for (int i = 0; i < n; i++) {
        fw_json_line(json, 4);
        fw_json_object(json, NULL);
        fw_json_text(json, "name", file[i].name);
        fw_json_whole(json, "bytes", (long long)file[i].size);
        fw_json_text(json, "sha256", file[i].sha256);
        fw_json_end(json);
    }
}

/* ---- findings ---- */

static void other_layer(fw_json *json, const char *key, const fw_mask *mask, int layer) {
    if (layer < 0)
        fw_json_null(json, key);
    else
        gds_of(json, key, &mask->table->layer[layer]);
}

static void finding(fw_json *json, const fw_mask *mask, const fw_mask_finding *f) {
    static const char *const unit[] = {"um", "deg", "um2", "1"};
    const fw_mask_rule_kind_row *kind = f->rule->kind;
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_text(json, "rule", kind->name);
    other_layer(json, "layer", mask, f->rule->layer);
    other_layer(json, "other", mask, f->rule->other);
    fw_json_text(json, "severity", f->rule->severity == FW_ERROR ? "error" : "warning");
    fw_json_text(json, "what", f->what);
    fw_json_line(json, 5);
    fw_json_number(json, "value", fw_mask_rule_row_shown(kind, f->value), 12);
    fw_json_number(json, "limit", fw_mask_rule_row_shown(kind, f->limit), 12);
    fw_json_number(json, "needed", fw_mask_rule_row_shown(kind, f->needed), 12);
    fw_json_text(json, "unit", unit[kind->unit]);
    fw_json_list(json, "at_um");
    for (int i = 0; i < 2; i++)
        micrometres(json, NULL, (double[]){f->at[i].x, f->at[i].y}, 2);
    fw_json_end(json);
    box_um(json, "box_um", f->box);
    fw_json_line(json, 5);
    fw_json_list(json, "pieces");
    for (int i = 0; i < 2 && f->label[i]; i++)
        fw_json_text(json, NULL, f->label[i]);
    fw_json_end(json);
    fw_json_list(json, "edges");
    for (int i = 0; i < 2 && f->label[i] && f->edge[i] >= 0; i++)
        fw_json_whole(json, NULL, f->edge[i]);
    fw_json_end(json);
    fw_json_text(json, "formula", f->rule->formula);
    fw_json_text(json, "reason", f->rule->source);
    fw_json_end(json);
}

static void findings(fw_json *json, const fw_mask *mask) {
    fw_json_line(json, 2);
    fw_json_list(json, "findings");
    for (int i = 0; i < mask->nfinding; i++)
        finding(json, mask, &mask->finding[i]);
    if (mask->nfinding)
        fw_json_end_line(json, 2);
    else
        fw_json_end(json);
}

fw_status fw_mask_write_findings(const fw_mask *mask, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    line_text(&json, "schema", "flexwright.violations/1");
    line_text(&json, "device", mask->device);
    line_text(&json, "flow", mask->flow);
    line_text(&json, "cell", mask->cell);
    line_text(&json, "version", FW_VERSION);
    fw_json_line(&json, 2);
    fw_json_whole(&json, "errors", mask->nbroken);
    fw_json_whole(&json, "warnings", mask->nfinding - mask->nbroken);
    fw_json_line(&json, 2);
    fw_json_whole(&json, "marker_layer", fw_mask_marker_layer(mask->table));
    findings(&json, mask);
    fw_json_end_line(&json, 0);
    return fw_json_finish(&json, "\n");
}

/* ---- the certificate: layers ---- */

static void box_nm(fw_json *json, const char *key, fw_geometry_box b) {
    const double side[] = {b.x0, b.y0, b.x1, b.y1};
    if (!(b.x0 <= b.x1)) {
        fw_json_null(json, key);
        return;
    }
    fw_json_list(json, key);
    for (int i = 0; i < 4; i++)
        fw_json_whole(json, NULL, lround(side[i] * 1e9));
    fw_json_end(json);
}

/* corners of both sides, edges: the same of a shape and of a layer */
static void corners(fw_json *json, double material_rad, double space_rad, double edge_m,
                    int straight) {
    fw_json_line(json, 5);
    fw_json_number(json, "sharpest_material_deg", degrees(material_rad), 12);
    fw_json_number(json, "sharpest_space_deg", degrees(space_rad), 12);
    fw_json_number(json, "edge_error_nm", edge_m * 1e9, 6);
    fw_json_whole(json, "straight_vertices", straight);
}

static void layer(fw_json *json, const fw_mask_layer *y, const fw_mask_measure *m) {
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    gds_of(json, "gds", y);
    fw_json_text(json, "id", y->id);
    fw_json_text(json, "name", y->name);
    fw_json_text(json, "purpose", y->purpose);
    fw_json_text(json, "tone", y->tone);
    fw_json_line(json, 5);
    fw_json_truth(json, "biased", y->biased);
    fw_json_whole(json, "polygons", m->shapes);
    fw_json_whole(json, "vertices", m->vertices);
    fw_json_line(json, 5);
    fw_json_number(json, "area_um2", m->area_m2 * 1e12, 17);
    fw_json_number(json, "polygon_area_um2", m->polygon_area_m2 * 1e12, 17);
    fw_json_number(json, "area_bound_um2", m->bound_m2 * 1e12, 6);
    fw_json_line(json, 5);
    fw_json_number(json, "perimeter_um", m->perimeter_m * 1e6, 12);
    fw_json_number(json, "min_width_um", m->width_m * 1e6, 9);
    fw_json_number(json, "min_space_um", m->space_m * 1e6, 9);
    if (m->unfinished) fw_json_truth(json, "unfinished", true);
    fw_json_line(json, 5);
    fw_json_number(json, "rule_width_um", y->min_width_m * 1e6, 9);
    fw_json_number(json, "rule_space_um", y->min_space_m * 1e6, 9);
    fw_json_text(json, "rule_source", y->rule_source ? y->rule_source : "");
    fw_json_line(json, 5);
    fw_json_number(json, "shortest_edge_nm", m->shortest_edge_m * 1e9, 6);
    fw_json_number(json, "sharpest_corner_deg", degrees(m->sharpest_rad), 6);
    corners(json, m->sharpest_material_rad, m->sharpest_space_rad, m->edge_m, m->straight);
    box_nm(json, "box_nm", m->box);
    fw_json_end(json);
}

/* ---- the certificate: what was found of every polygon, so that another program can find it again
   in the file (tests/accept/check_mask.py does) ---- */

static void shape(fw_json *json, const fw_mask *mask, const fw_mask_shape *s) {
    fw_mask_measure m;
    fw_mask_measure_start(&m);
    fw_mask_measure_add(&m, s);
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    gds_of(json, "gds", &mask->table->layer[s->layer]);
    fw_json_text(json, "piece", s->piece->label);
    fw_json_whole(json, "boundaries", s->npart > 0 ? s->npart : 1);
    fw_json_whole(json, "vertices", s->polygon.count);
    fw_json_whole(json, "area2_nm2", (long long)fw_geometry_polygon_area2(&s->polygon));
    fw_json_line(json, 5);
    fw_json_number(json, "area_um2", s->area_m2 * 1e12, 17);
    fw_json_number(json, "area_bound_um2", s->bound_m2 * 1e12, 6);
    fw_json_number(json, "shortest_edge_nm", s->report.shortest_edge_m * 1e9, 12);
    corners(json, s->report.sharpest_material_rad, s->report.sharpest_space_rad, s->edge_m,
            s->report.straight);
    box_nm(json, "box_nm", m.box);
    if (s->npart > 1) fw_json_number(json, "cut_clearance_nm", s->cut_clear_dbu, 12);
    fw_json_end(json);
}

static void neck(fw_json *json, const fw_mask_shape *s) {
    const fw_mask_neck *n = &s->neck;
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_text(json, "piece", s->piece->label);
    fw_json_list(json, "ends_um");
    for (int k = 0; k < 2; k++)
        micrometres(json, NULL, (double[]){n->at[k].x, n->at[k].y}, 2);
    fw_json_end(json);
    fw_json_number(json, "width_um", 1e6 * hypot(n->at[1].x - n->at[0].x, n->at[1].y - n->at[0].y),
                   12);
    fw_json_list(json, "vertices_nm");
    for (int k = 0; k < 2; k++) {
        if (!n->on_vertex[k]) { /* inside a straight edge */
            fw_json_null(json, NULL);
            continue;
        }
        fw_json_list(json, NULL);
        fw_json_whole(json, NULL, n->vertex[k].x_dbu);
        fw_json_whole(json, NULL, n->vertex[k].y_dbu);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_end(json);
}

/* one line of the list: what was looked at, of how many, and what it gave */
static void check(fw_json *json, const char *statement, long of, const char *key, double value) {
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_text(json, "statement", statement);
    fw_json_whole(json, "of", of);
    fw_json_number(json, key, value, 12);
    fw_json_end(json);
}

typedef struct sums {
    long boundaries, vertices, necks, on_vertex;
    long simple, zero, spikes, straight;
    double worst_area; /* of its bound */
} sums;

static sums sum(const fw_mask *mask) {
    sums t = {0};
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        double flat = 0.5e-18 * (double)fw_geometry_polygon_area2(&s->polygon);
        if (s->polygon.count == 0) continue;
        t.boundaries += s->npart > 0 ? s->npart : 1;
        t.vertices += s->polygon.count;
        t.simple += s->report.simple;
        t.zero += s->report.zero_edges;
        t.spikes += s->report.spikes;
        t.straight += s->report.straight;
        t.necks += s->neck.there ? 2 : 0;
        t.on_vertex += s->neck.there ? s->neck.on_vertex[0] + s->neck.on_vertex[1] : 0;
        if (s->bound_m2 > 0)
            t.worst_area = fmax(t.worst_area, fabs(flat - s->area_m2) / s->bound_m2);
    }
    return t;
}

/* counted here, from what each check left behind */
static void checks(fw_json *json, const fw_mask *mask) {
    const sums t = sum(mask);
    fw_json_line(json, 2);
    fw_json_list(json, "checks");
    check(json, "no edge of a polygon crosses or touches another one of it, exact integers",
          mask->nshape, "not_simple", (double)(mask->nshape - t.simple));
    check(json, "no edge without length", t.vertices, "zero_edges", (double)t.zero);
    check(json, "no edge runs back over the one before it", t.vertices, "spikes", (double)t.spikes);
    check(json, "no point is a vertex of one polygon twice", t.vertices, "doubled_vertices",
          (double)(t.simple == mask->nshape ? 0 : mask->nshape - t.simple));
    check(json, "vertices exactly between their neighbours: kept where joints end", t.vertices,
          "straight_vertices", (double)t.straight);
    check(json, "area of each polygon against its exact outline, as a part of the proven bound",
          mask->nshape, "worst_part", t.worst_area);
    check(json, "ends of necks that are vertices; the others lie inside straight edges", t.necks,
          "on_vertices", (double)t.on_vertex);
    fw_json_end_line(json, 2);
}

static void shapes(fw_json *json, const fw_mask *mask) {
    fw_json_line(json, 2);
    fw_json_list(json, "shapes");
    for (int i = 0; i < mask->nshape; i++)
        if (mask->shape[i].polygon.count > 0) shape(json, mask, &mask->shape[i]);
    fw_json_end_line(json, 2);
    fw_json_line(json, 2);
    fw_json_list(json, "necks");
    for (int i = 0; i < mask->nshape; i++)
        if (mask->shape[i].neck.there) neck(json, &mask->shape[i]);
    fw_json_end_line(json, 2);
}

/* ---- the certificate: the document ---- */

static void head(fw_json *json, const fw_mask *mask, const char *gds_sha256) {
    line_text(json, "schema", "flexwright.mask/1");
    line_text(json, "device", mask->device);
    line_text(json, "flow", mask->flow);
    line_text(json, "cell", mask->cell);
    line_text(json, "version", FW_VERSION);
    fw_json_line(json, 2);
    fw_json_truth(json, "rejected", mask->rejected);
    fw_mask_json_because(json, mask);
    line_text(json, "gds_sha256", gds_sha256 ? gds_sha256 : "");
    line_text(json, "reading", mask->table->reading);
    fw_json_line(json, 2);
    fw_json_whole(json, "grid_nm", 1);
    fw_json_number(json, "tolerance_nm", mask->tolerance_m * 1e9, 9);
    fw_json_number(json, "edge_error_nm", mask->tolerance_m * 1e9 + FW_SQRT_HALF, 9);
    fw_json_line(json, 2);
    fw_json_number(json, "bias_um_per_edge", mask->bias_m * 1e6, 9);
    fw_json_text(json, "bias", "process bias included, mask CD bias 0");
    fw_json_line(json, 2);
    box_um(json, "extent_um", mask->box);
}

static void proven(fw_json *json, const fw_mask *mask) {
    fw_json_line(json, 2);
    fw_json_list(json, "proven");
    fw_json_text(json, NULL, "every polygon simple, in exact integers");
    fw_json_text(json, NULL, "areas within the bound");
    fw_json_text(json, NULL, "both sides of every joint on the same grid points");
    if (mask->nbroken == 0)
        fw_json_text(json, NULL,
                     "width and space above the rules, of exact outlines or of polygons as "
                     "written, as each rule says");
    fw_json_end(json);
}

/* members of the certificate, to which others may be added */
static fw_status certificate(fw_json *json, const fw_mask *mask, const char *gds_sha256,
                             const fw_output_file *file, int nfile) {
    const char **note;
    int n;
    FW_TRY(fw_mask_notes(json->out->arena, mask, &note, &n));
    head(json, mask, gds_sha256);
    proven(json, mask);
    findings(json, mask);
    FW_TRY(fw_mask_rules_json(json, mask->table));
    fw_json_line(json, 2);
    fw_json_list(json, "layers");
    for (int k = 0; k < mask->table->nlayer; k++)
        layer(json, &mask->table->layer[k], &mask->measure[k]);
    fw_json_end_line(json, 2);
    fw_mask_cells_json(json, mask);
    line_text(json, "flattening", fw_mask_flattening_name(mask->flattening));
    fw_mask_json_files(json, file, nfile);
    if (nfile)
        fw_json_end_line(json, 2);
    else
        fw_json_end(json);
    checks(json, mask);
    shapes(json, mask);
    fw_mask_wiring_json(json, mask);
    fw_json_line(json, 2);
    fw_json_list(json, "notes");
    for (int i = 0; i < n; i++) {
        fw_json_line(json, 4);
        fw_json_text(json, NULL, note[i]);
    }
    fw_json_end_line(json, 2);
    return FW_OK;
}

fw_status fw_mask_write_certificate(const fw_mask *mask, const char *gds_sha256, fw_text *out) {
    return fw_mask_write_certificate_of(mask, gds_sha256, NULL, 0, out);
}

fw_status fw_mask_write_certificate_of(const fw_mask *mask, const char *gds_sha256,
                                       const fw_output_file *file, int nfile, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    FW_TRY(certificate(&json, mask, gds_sha256, file, nfile));
    fw_json_end_line(&json, 0);
    return fw_json_finish(&json, "\n");
}

/* ---- the list of test patterns ---- */

static fw_geometry_vec2 on_die(const fw_layout_coupon *c, fw_geometry_vec2 p) {
    return (fw_geometry_vec2){c->at.x + p.x, c->at.y + p.y};
}

static void feature(fw_json *json, const fw_layout_coupon *c, const fw_layout_feature *f) {
    fw_json_line(json, 8);
    fw_json_object(json, NULL);
    fw_json_text(json, "feature", f->name);
    fw_json_number(json, "drawn_um", f->drawn_m * 1e6, 9);
    place(json, "from_um", on_die(c, f->from));
    place(json, "to_um", on_die(c, f->to));
    fw_json_end(json);
}

static void coupon(fw_json *json, const fw_layout_coupon *c) {
    const fw_layout_pattern *p = c->pattern;
    const char *const line[][2] = {{"what", p->kind->what},
                                   {"measure", p->measure},
                                   {"formula", c->formula},
                                   {"source", p->source}};
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_text(json, "coupon", p->id);
    fw_json_text(json, "kind", p->kind->name);
    fw_json_text(json, "title", p->title);
    fw_json_line(json, 5);
    fw_json_truth(json, "placed", c->placed);
    fw_json_truth(json, "biased", p->biased);
    fw_json_text(json, "gives", p->gives);
    for (int i = 0; i < 4; i++) {
        fw_json_line(json, 5);
        fw_json_text(json, line[i][0], line[i][1]);
    }
    fw_json_line(json, 5);
    fw_json_list(json, "figures");
    for (int i = 0; i < c->nfigure; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "name", c->figure[i].name);
        fw_json_number(json, "value", c->figure[i].value, 9);
        fw_json_text(json, "unit", c->figure[i].unit);
        fw_json_end(json);
    }
    fw_json_end(json);
    if (c->placed) {
        fw_json_line(json, 5);
        place(json, "corner_um", c->at);
        place(json, "size_um", (fw_geometry_vec2){c->width_m, c->height_m});
        fw_json_line(json, 5);
        fw_json_list(json, "features");
        for (int i = 0; i < c->nfeature; i++)
            feature(json, c, &c->feature[i]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

/* the certificate of the test die, and its patterns as further members */
fw_status fw_mask_write_coupons(const fw_mask_coupons *coupons, const char *gds_sha256,
                                const fw_output_file *file, int nfile, fw_text *out) {
    const fw_layout_content *content = coupons->content;
    fw_json json = fw_json_new(out, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    FW_TRY(certificate(&json, coupons->mask, gds_sha256, file, nfile));
    fw_json_line(&json, 2);
    fw_json_number(&json, "fill_density", content->fill_density, 9);
    fw_json_number(&json, "fill_area_um2", content->fill_area_m2 * 1e12, 12);
    fw_json_line(&json, 2);
    fw_json_list(&json, "coupons");
    for (int i = 0; i < content->ncoupon; i++)
        coupon(&json, &content->coupon[i]);
    fw_json_end_line(&json, 2);
    fw_json_end_line(&json, 0);
    return fw_json_finish(&json, "\n");
}

/* ---- the order sheet ---- */

static void yes_no(fw_json *json, const char *key, int value) {
    if (value < 0)
        fw_json_null(json, key);
    else
        fw_json_truth(json, key, value);
}

static void order_head(fw_json *json, const fw_mask *mask, const fw_mask_order *order) {
    static const char *const sense[] = {"right-reading", "wrong-reading"};
    const fw_mask_plate_row own = fw_mask_plate_at(mask->table, order->plate_index), *row = &own;
    line_text(json, "schema", "flexwright.order/1");
    line_text(json, "mask", order->name);
    line_text(json, "device", mask->device);
    fw_json_text(json, "flow", mask->flow);
    fw_json_text(json, "cell", mask->cell);
    fw_json_text(json, "version", FW_VERSION);
    fw_json_line(json, 2);
    yes_no(json, "rejected", mask->rejected);
    fw_mask_json_because(json, mask);
    fw_mask_json_set(json, mask->table, order);
    fw_mask_cells_json(json, mask);
    line_text(json, "plate", row->layers);
    line_text(json, "plate_text", row->order);
    line_text(json, "polygon_tone", order->tone);
    fw_json_text(json, "field", order->field);
    line_text(json, "reading", row->reading);
    line_text(json, "reading_chrome_up", order->mirror < 0 ? NULL : sense[order->mirror]);
    yes_no(json, "mirror_seen_chrome_up", order->mirror);
    fw_json_text(json, "mirror_axis", order->mirror == 1 ? "x becomes -x" : NULL);
    yes_no(json, "mirrored_in_data", 0);
}

static void sizes(fw_json *json, const fw_mask *mask, const fw_mask_order *order) {
    fw_json_line(json, 2);
    fw_json_number(json, "min_feature_um", order->width_m * 1e6, 9);
    fw_json_number(json, "min_space_um", order->space_m * 1e6, 9);
    if (order->unfinished) fw_json_truth(json, "unfinished", true);
    fw_json_line(json, 2);
    fw_json_number(json, "bias_um_per_edge", fw_mask_plate_bias_m(mask, order->plate_index) * 1e6,
                   9);
    fw_json_truth(json, "bias_in_data", true);
    fw_json_whole(json, "mask_cd_bias_um", 0);
    fw_json_line(json, 2);
    fw_json_whole(json, "grid_nm", 1);
    fw_json_number(json, "tolerance_nm", mask->tolerance_m * 1e9, 9);
    fw_json_line(json, 2);
    box_um(json, "extent_um", mask->box);
    fw_json_line(json, 2);
    fw_json_whole(json, "vertex_limit", mask->vertex_limit);
    fw_json_line(json, 2);
    fw_json_whole(json, "polygons", order->polygons);
    fw_json_whole(json, "vertices", order->vertices);
}

static void order_layer(fw_json *json, const fw_mask *mask, const fw_mask_order *order, int k) {
    const fw_mask_layer *y = &mask->table->layer[k];
    const fw_mask_measure *m = &mask->measure[k];
    int polygons, vertices;
    fw_mask_order_count(mask, k, &polygons, &vertices);
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    gds_of(json, "gds", y);
    fw_json_text(json, "name", y->name);
    fw_json_text(json, "polygon_tone", y->documentation ? NULL : y->tone);
    yes_no(json, "on_plate", order->plate[k]);
    yes_no(json, "biased", y->biased);
    fw_json_line(json, 5);
    fw_json_whole(json, "polygons", polygons);
    fw_json_whole(json, "vertices", vertices);
    fw_json_number(json, "min_width_um", m->width_m * 1e6, 9);
    fw_json_number(json, "min_space_um", m->space_m * 1e6, 9);
    if (m->unfinished) fw_json_truth(json, "unfinished", true);
    fw_json_text(json, "purpose", y->purpose);
    fw_json_end(json);
}

static void site(fw_json *json, const fw_mask *mask, const fw_mask_order_site *s, int number) {
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_whole(json, "site", number);
    gds_of(json, "gds", &mask->table->layer[s->layer]);
    fw_json_text(json, "what", s->what);
    fw_json_text(json, "kind", s->space ? "space" : "width");
    fw_json_number(json, "cd_um", vec_distance(s->from, s->to) * 1e6, 9);
    fw_json_line(json, 5);
    place(json, "centre_um", vec_along(s->from, 0.5, vec_sub(s->to, s->from)));
    place(json, "from_um", s->from);
    place(json, "to_um", s->to);
    fw_json_end(json);
}

fw_status fw_mask_write_order(const fw_mask *mask, int plate, const fw_output_file *file, int nfile,
                              fw_text *out) {
    fw_mask_order order;
    FW_TRY(fw_mask_order_gather(out->arena, mask, plate, &order));
    fw_json json = fw_json_new(out, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    order_head(&json, mask, &order);
    sizes(&json, mask, &order);
    fw_json_line(&json, 2);
    fw_json_list(&json, "layers");
    for (int k = 0; k < mask->table->nlayer; k++)
        order_layer(&json, mask, &order, k);
    fw_json_end_line(&json, 2);
    fw_json_line(&json, 2);
    fw_json_list(&json, "cd_sites");
    for (int i = 0; i < order.nsite; i++)
        site(&json, mask, &order.site[i], i + 1);
    fw_json_end_line(&json, 2);
    fw_mask_wiring_order_json(&json, mask);
    fw_mask_json_files(&json, file, nfile);
    fw_json_end_line(&json, 2);
    fw_json_end_line(&json, 0);
    return fw_json_finish(&json, "\n");
}
