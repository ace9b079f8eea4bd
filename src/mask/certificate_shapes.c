/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was found of every polygon, so that another program can find it again in the file:
   tests/accept/check_mask.py does. */
#include "mask/certificate.h"
#include "base/constants.h"
#include "mask/flatten.h"
#include "mask/json.h"
#include <math.h>

static double degrees(double rad) {
    return rad * (180 / FW_PI);
}

static void box_nm(fw_text *out, const char *key, fw_box b) {
    fw_text_printf(out, ", \"%s\": ", key);
    if (!(b.x0 <= b.x1)) {
        fw_text_add(out, "null");
        return;
    }
    fw_text_printf(out, "[%ld, %ld, %ld, %ld]", lround(b.x0 * 1e9), lround(b.y0 * 1e9),
                   lround(b.x1 * 1e9), lround(b.y1 * 1e9));
}

/* corners of both sides, edges: the same of a shape and of a layer */
static void corners(fw_text *out, double material_rad, double space_rad, double edge_m,
                    int straight) {
    fw_mask_json_number(out, "sharpest_material_deg", degrees(material_rad), 12);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "sharpest_space_deg", degrees(space_rad), 12);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "edge_error_nm", edge_m * 1e9, 6);
    fw_text_printf(out, ", \"straight_vertices\": %d", straight);
}

void fw_certificate_layer(fw_text *out, const fw_mask_measure *m) {
    fw_text_add(out, ",\n     ");
    corners(out, m->sharpest_material_rad, m->sharpest_space_rad, m->edge_m, m->straight);
    box_nm(out, "box_nm", m->box);
}

static void shape(fw_text *out, const fw_mask *mask, const fw_mask_shape *s) {
    const fw_mask_layer *y = &mask->table->layer[s->layer];
    fw_mask_measure m;
    fw_mask_measure_start(&m);
    fw_mask_measure_add(&m, s);
    fw_text_printf(out, "    {\"gds\": \"%d/%d\", ", y->layer, y->datatype);
    fw_mask_json_text(out, "piece", s->piece->label);
    fw_text_printf(out, ", \"boundaries\": %d, \"vertices\": %d, \"area2_nm2\": %lld,\n     ",
                   s->npart > 0 ? s->npart : 1, s->polygon.count,
                   (long long)fw_polygon_area2(&s->polygon));
    fw_mask_json_number(out, "area_um2", s->area_m2 * 1e12, 17);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "area_bound_um2", s->bound_m2 * 1e12, 6);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "shortest_edge_nm", s->report.shortest_edge_m * 1e9, 12);
    fw_text_add(out, ",\n     ");
    corners(out, s->report.sharpest_material_rad, s->report.sharpest_space_rad, s->edge_m,
            s->report.straight);
    box_nm(out, "box_nm", m.box);
    if (s->npart > 1) {
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "cut_clearance_nm", s->cut_clear_dbu, 12);
    }
    fw_text_add(out, "}");
}

static void neck(fw_text *out, const fw_mask_shape *s) {
    const fw_mask_neck *n = &s->neck;
    fw_text_add(out, "    {");
    fw_mask_json_text(out, "piece", s->piece->label);
    fw_text_add(out, ", \"ends_um\": [");
    for (int k = 0; k < 2; k++) {
        fw_text_add(out, k ? ", [" : "[");
        fw_text_number(out, n->at[k].x * 1e6, 12);
        fw_text_add(out, ", ");
        fw_text_number(out, n->at[k].y * 1e6, 12);
        fw_text_add(out, "]");
    }
    fw_text_add(out, "], ");
    fw_mask_json_number(out, "width_um",
                        1e6 * hypot(n->at[1].x - n->at[0].x, n->at[1].y - n->at[0].y), 12);
    fw_text_add(out, ", \"vertices_nm\": [");
    for (int k = 0; k < 2; k++) {
        fw_text_add(out, k ? ", " : "");
        if (n->on_vertex[k])
            fw_text_printf(out, "[%d, %d]", n->vertex[k].x_dbu, n->vertex[k].y_dbu);
        else
            fw_text_add(out, "null"); /* inside a straight edge */
    }
    fw_text_add(out, "]}");
}

/* one line of the list: what was looked at, of how many, and what it gave */
static void check(fw_text *out, const char *statement, long of, const char *key, double value,
                  bool last) {
    fw_text_add(out, "    {");
    fw_mask_json_text(out, "statement", statement);
    fw_text_printf(out, ", \"of\": %ld, ", of);
    fw_mask_json_number(out, key, value, 12);
    fw_text_add(out, last ? "}\n" : "},\n");
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
        double flat = 0.5e-18 * (double)fw_polygon_area2(&s->polygon);
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
static void checks(fw_text *out, const fw_mask *mask) {
    const sums t = sum(mask);
    fw_text_add(out, "  \"checks\": [\n");
    check(out, "no edge of a polygon crosses or touches another one of it, exact integers",
          mask->nshape, "not_simple", (double)(mask->nshape - t.simple), false);
    check(out, "no edge without length", t.vertices, "zero_edges", (double)t.zero, false);
    check(out, "no edge runs back over the one before it", t.vertices, "spikes", (double)t.spikes,
          false);
    check(out, "no point is a vertex of one polygon twice", t.vertices, "doubled_vertices",
          (double)(t.simple == mask->nshape ? 0 : mask->nshape - t.simple), false);
    check(out, "vertices exactly between their neighbours: kept where joints end", t.vertices,
          "straight_vertices", (double)t.straight, false);
    check(out, "area of each polygon against its exact outline, as a part of the proven bound",
          mask->nshape, "worst_part", t.worst_area, false);
    check(out, "ends of necks that are vertices; the others lie inside straight edges", t.necks,
          "on_vertices", (double)t.on_vertex, true);
    fw_text_add(out, "  ],\n");
}

static void files(fw_text *out, const fw_output_file *file, int n) {
    fw_text_add(out, "  \"files\": [");
    for (int i = 0; i < n; i++) {
        fw_text_add(out, i ? ",\n    {" : "\n    {");
        fw_mask_json_text(out, "name", file[i].name);
        fw_text_printf(out, ", \"bytes\": %zu, ", file[i].size);
        fw_mask_json_text(out, "sha256", file[i].sha256);
        fw_text_add(out, "}");
    }
    fw_text_add(out, n ? "\n  ],\n" : "],\n");
}

void fw_certificate_shapes(const fw_mask *mask, const fw_output_file *file, int nfile,
                           fw_text *out) {
    fw_text_add(out, "  ");
    fw_mask_json_text(out, "flattening", fw_mask_flattening_name(mask->flattening));
    fw_text_add(out, ",\n");
    files(out, file, nfile);
    checks(out, mask);
    fw_text_add(out, "  \"shapes\": [\n");
    for (int i = 0, n = 0; i < mask->nshape; i++) {
        if (mask->shape[i].polygon.count == 0) continue;
        fw_text_add(out, n++ ? ",\n" : "");
        shape(out, mask, &mask->shape[i]);
    }
    fw_text_add(out, "\n  ],\n  \"necks\": [");
    for (int i = 0, n = 0; i < mask->nshape; i++) {
        if (!mask->shape[i].neck.there) continue;
        fw_text_add(out, n++ ? ",\n" : "\n");
        neck(out, &mask->shape[i]);
    }
    fw_text_add(out, "\n  ],\n");
}
