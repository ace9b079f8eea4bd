/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials: data of processes/base.xml, with the device file's own overrides. */
#ifndef FW_DEVICE_MATERIAL_H
#define FW_DEVICE_MATERIAL_H
#include "quantity/quantity.h"

typedef struct fw_material {
    const char *id, *name;
    fw_quantity youngs;    /* Pa, for bending in the wafer plane */
    fw_quantity poisson;   /* 1 */
    fw_quantity density;   /* kg/m3 */
    fw_quantity strength;  /* Pa: stress that the safety factor divides */
    const char *criterion; /* "fracture", "proportional limit", "yield" */
    fw_quantity loss;      /* 1: loss factor eta of the material damping, for c = eta k/omega */
    fw_quantity expansion; /* 1/K, thermal, of length */
    fw_quantity modulus_change; /* 1/K: (dE/dT)/E */
    fw_quantity c11, c12, c44;  /* Pa: of a cubic crystal in a (100) wafer; unknown: isotropic */
} fw_material;

typedef struct fw_material_override { /* attributes of <material>; unknown where absent */
    fw_quantity youngs, poisson, density, strength;
} fw_material_override;

typedef struct fw_materials {
    fw_material *item; /* (count) */
    int count;
} fw_materials;

/* reads the <material> elements of a pack (base.xml) */
fw_status fw_materials_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                            fw_diags *diags, fw_materials *materials);
const fw_material *fw_material_find(const fw_materials *materials, const char *id);
/* the material with overrides applied; an override's source is "device file". A stated modulus
   makes a crystal isotropic: its constants are unknown then. */
fw_material fw_material_with(const fw_material *material, const fw_material_override *override);
/* all three constants are known: its modulus goes with the direction */
bool fw_material_is_crystal(const fw_material *material);

#endif
