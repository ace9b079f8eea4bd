/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/pose_load.h"
#include <math.h>

enum { INSIDE = 16 }; /* parts of an arc */

static double lever_of(const fw_device_flexure *f, const fw_flexure_result *c) {
    double a = 0.5 * f->angle_rad, off = hypot(c->offset_m[0], c->offset_m[1]);
    double arc = hypot(f->radius_m * cos(a) - c->centre_m, f->radius_m * sin(a));
    return (f->kind == FW_FLEXURE_CSFH ? arc : 0.5 * f->length_m) + off;
}

/* no section is farther from the pin than this */
static double farthest(const fw_flexure_path_strain *s, const double pin[2]) {
    double far = 0;
    for (int i = 0; i < s->n; i++)
        far = fmax(far, hypot(s->point[i].x_m - pin[0], s->point[i].y_m - pin[1]));
    return far;
}

/* M(P) = M + (y - yW) Fx - (x - xW) Fy, the force on the second body -F: the lever of F is (y - yW,
   xW - x) */
static fw_workspace_station place(const double pin[2], double x, double y, double bending,
                                  double axial) {
    return (fw_workspace_station){{y - pin[1], pin[0] - x}, bending, axial};
}

/* Stations of an arc: the roots with their concentration, and inside of it places so close that
   between two of them |M| is at most r |F| (1 - cos of half their distance) above the larger. All
   of them are below the moment at the arc's centre and r |F|. */
static void arc(const fw_device_flexure *f, const fw_flexure_result *c, const double pin[2],
                double bending, double kt, double axial, fw_workspace_station *to,
                fw_workspace_section *out) {
    double r = f->radius_m, a = 0.5 * f->angle_rad, inside = bending * c->fibre / c->concentration;
    double above = r * (1.0 - cos(a / INSIDE)) * inside;
    out->roots = 2;
    out->inside = place(pin, 0.0, 0.0, inside, axial + r * inside);
    for (int side = -1; side <= 1; side += 2)
        to[out->n++] = place(pin, r * cos(a), side * r * sin(a), bending, kt * axial);
    for (int i = 1; i < INSIDE; i++) {
        double b = a * (2.0 * i / INSIDE - 1.0);
        to[out->n++] = place(pin, r * cos(b), r * sin(b), inside, axial + above);
    }
}

/* of a flexure that varies: between two sections the moment may rise by an eighth of its second
   difference */
static int varying(const fw_flexure_path_strain *s, const double pin[2], fw_workspace_station *to) {
    for (int i = 0; i < s->n; i++) {
        const fw_flexure_path_point *p = &s->point[i];
        double above = 0.0;
        if (i > 0 && i + 1 < s->n)
            above =
                0.125 * hypot(p[-1].x_m - 2 * p->x_m + p[1].x_m, p[-1].y_m - 2 * p->y_m + p[1].y_m);
        to[i] = place(pin, p->x_m, p->y_m, p->strain_per_Nm,
                      p->strain_per_N + above * p->strain_per_Nm);
    }
    return s->n;
}

/* The strain of eq. 1 and 2 of docs/theory/verdict.md as places along the strip. Where the axis is
   not drawn the force acts on its largest lever, wherever it points. */
static fw_status one_section(fw_arena *arena, const fw_mechanism *m, const fw_mechanism_hinge *h,
                             fw_workspace_section *out) {
    const fw_device_flexure *f = &m->device->flexure[h->flexure];
    const fw_flexure_result *c = &h->closed_form;
    const double pin[2] = {c->centre_m + c->offset_m[0], c->offset_m[1]};
    double scale = h->scale > 0 ? h->scale : 1;
    double bending = c->strain_per_rad / (scale * c->stiffness_Nm_per_rad);
    double area = fw_device_flexure_narrowest_m(f) * m->variant->thickness_m;
    double axial = 1 / (scale * m->variant->material.youngs.value * area);
    double kt = fw_flexure_tension_concentration(f->width_m, h->input.fillet_m);
    bool varies = fw_flexure_input_varies(&h->input);
    size_t most = h->section.n > INSIDE ? (size_t)h->section.n : INSIDE + 1;
    fw_workspace_station *to = fw_arena_array(arena, fw_workspace_station, most);
    FW_NEED(to);
    out->station = to;
    out->moment_Nm_per_rad = scale * c->stiffness_Nm_per_rad;
    bool drawn = isfinite(h->axis_rad);
    out->axis[0] = drawn ? cos(h->axis_rad) : 1.0, out->axis[1] = drawn ? sin(h->axis_rad) : 0.0;
    if (!drawn) {
        double lever = varies ? farthest(&h->section, pin) : lever_of(f, c);
        to[0] = (fw_workspace_station){{0.0, 0.0}, bending, kt * axial + lever * bending};
        out->n = 1;
    } else if (varies) {
        out->n = varying(&h->section, pin, to);
    } else if (f->kind == FW_FLEXURE_CSFH) {
        arc(f, c, pin, bending, kt, axial, to, out);
        return FW_OK;
    } else {
        for (int side = 0; side < 2; side++)
            to[side] = place(pin, 0.0, (side - 0.5) * f->length_m, bending, kt * axial);
        out->n = 2;
    }
    out->roots = out->n;
    return FW_OK;
}

fw_status fw_workspace_sections(fw_arena *arena, const fw_mechanism *m,
                                fw_workspace_section section[FW_SIX]) {
    for (int i = 0; i < FW_SIX; i++) {
        int hinge = m->pin[i].hinge;
        section[i] = (fw_workspace_section){.spring_Nm_per_rad = m->pin[i].stiffness_Nm_per_rad};
        if (hinge != FW_NONE) FW_TRY(one_section(arena, m, &m->hinge[hinge], &section[i]));
    }
    return FW_OK;
}
