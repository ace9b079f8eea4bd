/* SPDX-License-Identifier: GPL-3.0-or-later */
/* whole DEVICE.xml [--rims]: the outlines of everything that moves and of what it hangs on, as drawn, one piece after the other on
   standard output, and what its layer is made of, for tools/solids/gallery. m, Pa, kg/m3, degrees:

     layer THICKNESS DENSITY YOUNGS POISSON C11 C12 C44 ORIENTATION     C11 0: isotropic; of [100] from +x
     body INDEX ID
     hinge ID X Y                                                       its pin
     piece BODY JOINT                                                   BODY -1: ground, JOINT -1: no flexure
     line X0 Y0 X1 Y1 | arc X0 Y0 X1 Y1 CX CY SWEEP

   With --rims, of devices with release holes, for tools/solids/rims:

     holes DIAMETER
     end BODY HINGE PINX PINY ROOTX ROOTY RIMX RIMY    of a hinge in a body, and what fw_verdict_arm_rims has there:
         M2 X Y REST REST2                             multipliers of a moment, of forces along x and y, and of the rest;
         M2 X Y                                        those of one strip that bears everything alone */
#include "base/text.h"
#include "layout/layout.h"
#include "mechanism/mechanism.h"
#include "verdict/strain.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int say(const fw_diags *diags, const char *what) {
    for (size_t i = 0; i < diags->count; i++)
        if (diags->item[i].severity == FW_ERROR) fprintf(stderr, "%s\n", diags->item[i].message);
    fprintf(stderr, "whole: %s\n", what);
    return 1;
}

static char *read_all(fw_arena *arena, const char *name, size_t *n) {
    FILE *file = fopen(name, "rb");
    const size_t room = (size_t)1 << 21;
    char *text = fw_arena_raw(arena, room);
    *n = file && text ? fread(text, 1, room - 1, file) : 0;
    if (file) fclose(file);
    return *n > 0 ? text : NULL;
}

static void outline(const fw_geometry_contour *c) {
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        const bool arc = s->kind == FW_ARC;
        printf("%s %.17g %.17g %.17g %.17g", arc ? "arc" : "line", s->a.x, s->a.y, s->b.x, s->b.y);
        if (arc) printf(" %.17g %.17g %.17g", s->centre.x, s->centre.y, s->sweep_rad);
        printf("\n");
    }
}

static int rims(fw_arena *arena, const fw_device *d, const fw_layout *layout,
                const fw_device_material *of, fw_diags *diags) {
    const fw_mechanism_variant variant = {
        .material = *of,
        .thickness_m = isnan(d->thickness_m) ? 50e-6 : d->thickness_m,
        .orientation_rad = d->orientation_rad,
        .explicit_mass_scale = 1,
        .explicit_stiffness_scale = 1,
        .explicit_damping_scale = 1};
    const fw_mechanism *m;
    fw_verdict_arm *arm;
    if (fw_mechanism_build(arena, d, layout, &variant, diags, &m) != FW_OK ||
        fw_verdict_body_arms(arena, m, layout, &arm) != FW_OK)
        return say(diags, "no mechanism");
    printf("holes %.17g\n", d->release_hole_m > 0 ? d->release_hole_m : 0.3 * d->release_pitch_m);
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const int body = i % 2 ? pin->body_b : pin->body_a;
        const fw_verdict_arm *a = &arm[i];
        if (body == FW_GROUND || !a->known) continue;
        const fw_geometry_vec2 at = fw_mechanism_pin_place(m, pin, i % 2),
                               root = i % 2 ? pin->root_b_m : pin->root_a_m;
        const double c = cos(m->drawn[body].phi_rad), s = sin(m->drawn[body].phi_rad);
        printf("end %d %s %.17g %.17g %.17g %.17g %.17g %.17g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n",
               body, pin->id, at.x, at.y, at.x + c * root.x - s * root.y, at.y + s * root.x + c * root.y, a->rim.x, a->rim.y,
               a->rim_m2, a->rim_x_m, a->rim_y_m, a->rim_rest_m, a->rim_rest_m2, a->edge_m2,
               a->edge_x_m, a->edge_y_m);
    }
    return 0;
}

int main(int argc, char **argv) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const char *packs = FW_SOURCE_DATA_DIR "/processes/base.xml";
    fw_device_materials all;
    const fw_device *d = NULL;
    const fw_layout *layout = NULL;
    size_t n;
    const bool with_rims = argc == 3 && strcmp(argv[2], "--rims") == 0;
    if (argc != 2 && !with_rims) return say(&diags, "whole DEVICE.xml [--rims]");
    char *xml = read_all(arena, argv[1], &n);
    if (!xml || fw_device_read(arena, argv[1], xml, n, NULL, 0, &diags, &d) != FW_OK)
        return say(&diags, "no device");
    char *base = read_all(arena, packs, &n);
    if (!base || fw_device_materials_read(arena, packs, base, n, &diags, &all) != FW_OK)
        return say(&diags, "no materials");
    const fw_device_material *found = d->material_ref ? fw_device_material_find(&all, d->material_ref)
                                                      : NULL;
    if (!found) return say(&diags, "unknown material");
    const fw_device_material of = fw_device_material_with(found, &d->material);
    if (fw_layout_build(arena, d, &diags, &layout) != FW_OK || !layout->drawn)
        return say(&diags, "it is not drawn");
    const bool crystal = fw_device_material_is_crystal(&of);
    printf("layer %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n",
           isnan(d->thickness_m) ? 50e-6 : d->thickness_m, of.density.value, of.youngs.value,
           of.poisson.value, crystal ? of.c11.value : 0, crystal ? of.c12.value : 0,
           crystal ? of.c44.value : 0, (isnan(d->orientation_rad) ? 0.78539816339744831 : d->orientation_rad) * 180 / 3.14159265358979323846);
    for (int b = 0; b < d->nbody; b++)
        printf("body %d %s\n", b, d->body[b].id);
    for (int k = 0; k < layout->npiece; k++) {
        const fw_layout_piece *p = &layout->piece[k];
        const bool moves = p->role == FW_ROLE_STRUCTURE || p->role == FW_ROLE_FLEXURE;
        if (!moves || p->body < FW_GROUND) continue;
        printf("piece %d %d\n", p->body, p->joint);
        outline(&p->contour);
    }
    const int status = with_rims ? rims(arena, d, layout, &of, &diags) : 0;
    fw_arena_free(arena);
    return status;
}
