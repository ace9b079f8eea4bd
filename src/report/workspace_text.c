/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report_workspace.h"
#include "base/constants.h"
#include <math.h>

static void range(fw_text *out, fw_maths_interval a, double factor, int digits) {
    fw_text_number(out, a.lo * factor, digits);
    fw_text_add(out, " to ");
    fw_text_number(out, a.hi * factor, digits);
}

static void bracket(fw_text *out, fw_maths_interval a, double factor, int digits) {
    fw_text_add(out, "[");
    fw_text_number(out, a.lo * factor, digits);
    fw_text_add(out, ", ");
    fw_text_number(out, a.hi * factor, digits);
    fw_text_add(out, "]");
}

static void pose(fw_text *out, const double at[3]) {
    fw_text_add(out, "(");
    fw_text_number(out, at[0] * 1e6, 4);
    fw_text_add(out, " um, ");
    fw_text_number(out, at[1] * 1e6, 4);
    fw_text_add(out, " um, ");
    fw_text_number(out, at[2] * FW_DEG_PER_RAD, 4);
    fw_text_add(out, " deg)");
}

static void singularities(fw_text *out, const fw_mechanism *m, const fw_workspace_regularity *s) {
    const fw_workspace_triangle *least = &s->passive[0];
    int regular = 0, inside = 0;
    for (int i = 0; i < FW_TRIANGLES; i++) {
        const fw_workspace_triangle *t = &s->passive[i];
        regular += t->regular;
        inside += t->positive && t->negative;
        if (t->length_m.lo < least->length_m.lo) least = t;
    }
    for (int side = 0; side < 2; side++) {
        fw_text_printf(out, "  elbow %s: %s, sine ", m->pin[side ? 4 : 1].id,
                       s->regular[side] ? "never stretched or folded (proved)"
                                        : "NOT proved to stay bent");
        range(out, s->sine[side], 1.0, 4);
        fw_text_add(out, "\n");
    }
    fw_text_printf(out, "  %d of %d choices of three driven hinges are regular everywhere (proved)",
                   regular, FW_TRIANGLES);
    if (inside > 0) fw_text_printf(out, "; %d become singular inside", inside);
    fw_text_printf(out, "\n  least favourable: %s, %s, %s passive, arm at least ",
                   m->pin[least->hinge[0]].id, m->pin[least->hinge[1]].id,
                   m->pin[least->hinge[2]].id);
    fw_text_number(out, least->length_m.lo * 1e6, 3);
    fw_text_add(out, " um, ");
    fw_text_number(out, least->length_m.hi * 1e6, 3);
    fw_text_add(out, " um at ");
    pose(out, least->pose);
    fw_text_add(out, "\n");
}

static void reachable(fw_text *out, const fw_report_workspace_flow *f) {
    const fw_workspace_map *map = f->map;
    static const char *const unit[] = {"x (um)", "y (um)", "rotation (deg)"};
    fw_text_add(out, "reachable within the elastic limits (certified by interval arithmetic)\n");
    fw_text_add(out, "  volume ");
    bracket(out, map->volume.value, 1e12, 8);
    fw_text_add(out, " um2 rad = ");
    bracket(out, map->volume.value, 1e12 * FW_DEG_PER_RAD, 8);
    fw_text_printf(out, " um2 deg, %ld boxes\n", map->volume.boxes);
    for (int c = 0; c < 3; c++) {
        double factor = c < 2 ? 1e6 : FW_DEG_PER_RAD;
        fw_text_printf(out, "  %-15s from ", unit[c]);
        bracket(out, map->survey.least[c], factor, 6);
        fw_text_add(out, " to ");
        bracket(out, map->survey.most[c], factor, 6);
        fw_text_add(out, "\n");
    }
    for (int i = 0; i < FW_SLICES; i++) {
        fw_text_add(out, "  area at ");
        fw_text_real(out, "%8.4f", map->slice[i].phi_rad * FW_DEG_PER_RAD);
        fw_text_add(out, " deg  ");
        bracket(out, map->slice[i].area.value, 1e12, 6);
        fw_text_add(out, " um2\n");
    }
    fw_text_add(out, "  the boundary belongs to");
    for (int i = 0; i < FW_SIX; i++) {
        fw_text_printf(out, "%s %s ", i ? "," : "", f->mechanism->pin[i].id);
        fw_text_real(out, "%.1f %%", 100.0 * map->survey.share[i]);
    }
    fw_text_add(out, "\n  volume grows with all limits to the power ");
    fw_text_number(out, map->survey.exponent, 3);
    fw_text_add(out, "\n");
    singularities(out, f->mechanism, &map->survey.singular);
}

static void required(fw_text *out, const fw_device *d, const fw_report_workspace_flow *f, int k) {
    const fw_device_workspace_box *b = &d->workspace[k];
    const fw_workspace_proof *p = &f->required->proof[k];
    fw_text_add(out, "required: x ");
    range(out, (fw_maths_interval){b->x_min_m, b->x_max_m}, 1e6, 6);
    fw_text_add(out, " um, y ");
    range(out, (fw_maths_interval){b->y_min_m, b->y_max_m}, 1e6, 6);
    fw_text_add(out, " um, rotation ");
    range(out, (fw_maths_interval){b->phi_min_rad, b->phi_max_rad}, FW_DEG_PER_RAD, 6);
    fw_text_add(out, " deg\n");
    if (!f->required->box_reachable[k]) {
        fw_text_add(out, "  NOT REACHABLE: the mechanism cannot be assembled at ");
        const double at[3] = {f->required->fail_x_m, f->required->fail_y_m,
                              f->required->fail_phi_rad};
        if (f->required->fail_box == k)
            pose(out, at);
        else
            fw_text_add(out, "a pose of it");
        fw_text_add(out, "\n");
        return;
    }
    if (!p->proved) {
        fw_text_add(out, "  reachable at every sampled pose; NOT PROVED\n");
        return;
    }
    fw_text_printf(out, "  every pose can be assembled on the drawn branch (proved, %ld boxes)\n",
                   p->boxes);
    for (int i = 0; i < FW_SIX; i++) {
        fw_maths_interval a = p->angle_rad[i];
        fw_text_printf(out, "  %-6s", f->mechanism->pin[i].id);
        fw_text_real(out, " %9.4f to", a.lo * FW_DEG_PER_RAD);
        fw_text_real(out, " %9.4f deg", a.hi * FW_DEG_PER_RAD);
        if (!f->map->none) {
            double limit = f->map->limit_rad[i], most = fmax(fabs(a.lo), fabs(a.hi));
            bool beyond = p->most[i].angle_rad.lo > limit || p->least[i].angle_rad.hi < -limit;
            fw_text_real(out, ", limit %.4f deg: ", limit * FW_DEG_PER_RAD);
            fw_text_real(out, "%.1f %%, ", 100.0 * most / limit);
            fw_text_add(out, most <= limit ? "within (proved)"
                             : beyond      ? "BEYOND (proved)"
                                           : "undecided");
        }
        fw_text_add(out, "\n");
    }
    singularities(out, f->mechanism, &f->singular[k]);
}

fw_status fw_report_workspace_text(const fw_report_workspace *in, fw_text *out) {
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_workspace_flow *f = &in->flow[i];
        if (i > 0) fw_text_add(out, "\n");
        fw_text_printf(out, "%s\n", f->flow ? f->flow : f->mechanism->variant->material.id);
        if (f->map->none)
            fw_text_printf(out, "no reachable set: %s\n", f->map->none);
        else
            reachable(out, f);
        for (int k = 0; k < in->device->nworkspace; k++)
            if (f->required->asked && f->required->asked[k]) required(out, in->device, f, k);
    }
    return fw_text_end(out);
}
