/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/continuum.h"
#include "plan/ladder.h"
#include <math.h>

/* [100] lies at minus the angle that the hinge's axis has from it */
static fw_continuum_material material_of(const fw_plan_ladder_case *c) {
    const fw_flexure_input *in = &c->hinge->input;
    const fw_device_material *m = &c->mechanism->variant->material;
    if (!in->crystal.known)
        return (fw_continuum_material){.youngs_Pa = in->youngs_Pa, .poisson = in->poisson};
    return (fw_continuum_material){.cubic = true,
                                   .c11_Pa = m->c11.value,
                                   .c12_Pa = m->c12.value,
                                   .c44_Pa = m->c44.value,
                                   .crystal_rad =
                                       -0.25 * atan2(in->crystal.sin4, in->crystal.cos4)};
}

static const char *unfit(const fw_plan_ladder_case *c) {
    const fw_flexure_input *in = &c->hinge->input;
    if (in->crystal.known && !in->crystal.aligned)
        return "the direction of the hinge in the crystal is not known";
    if (fw_flexure_input_varies(in)) return "solids are made of one arc or line of one width";
    return in->fillet_m > 0 ? NULL : "roots without fillets have no finite strain";
}

/* The solid with fillets and root blocks (src/continuum), linear, two meshes. Its own error is what
   the meshes differ by and what the model leaves open: whether the blocks' sides are held (2.7e-4
   of K of H2, 0.028 um of W), of which kx and ky feel up to five times as much; peak strains
   scatter by 1 % with the mesh. docs/theory/continuum.md */
fw_status fw_plan_ladder_continuum(const fw_plan_ladder_case *c, fw_report_level *row) {
    const fw_flexure_input *in = &c->hinge->input;
    const fw_flexure_result *r = &c->hinge->closed_form;
    *row = (fw_report_level){.state = FW_LEVEL_NONE, .why = unfit(c)};
    if (row->why) return FW_OK;
    const fw_continuum_material material = material_of(c);
    fw_continuum_shape shape;
    fw_continuum_result s;
    fw_diags own = fw_diags_new(c->arena);
    fw_place place = c->mechanism->device->flexure[c->hinge->flexure].place;
    fw_continuum_shape_of(in, &shape);
    fw_status status = fw_continuum_hinge(c->arena, &shape, &material, &(fw_continuum_options){0},
                                          place, &own, &s);
    if (status == FW_GEOMETRY || status == FW_SOLVER) { /* the other levels hold all the same */
        row->why = "the solid could not be solved";
        for (size_t i = 0; i < own.count; i++)
            fw_diag_warning(c->diags, own.item[i].number, place, "%s", own.item[i].message);
        return FW_OK;
    }
    FW_TRY(status);
    if (!s.installed) {
        row->state = FW_LEVEL_MISSING, row->why = s.missing;
        return FW_OK;
    }
    double strain = in->crystal.known ? s.stress_per_rad_Pa / in->youngs_Pa : s.strain_per_rad;
    double mesh = s.stiffness_error, left = 5e-4;
    *row = (fw_report_level){
        .at_m = {s.centre_x_m - r->centre_m - r->offset_m[0], s.centre_y_m - r->offset_m[1]},
        .stiffness_Nm_per_rad = s.stiffness_Nm_per_rad,
        .kx_N_per_m = s.kx_N_per_m,
        .ky_N_per_m = s.ky_N_per_m,
        .strain_per_rad = strain,
        .limit_angle_rad = in->strength_Pa / (in->safety_factor * in->youngs_Pa * strain),
        .drift_m = (double)NAN,
        .error = {.stiffness = mesh + left,
                  .kx = 5 * (mesh + left),
                  .ky = 5 * (mesh + left),
                  .strain = s.strain_error + 0.01,
                  .centre_m = s.centre_error_m + 0.004 * in->width_m},
        .cpu_s = s.cpu_s};
    row->moment_Nm = row->stiffness_Nm_per_rad * row->limit_angle_rad;
    return FW_OK;
}
