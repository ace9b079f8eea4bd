/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials: data of processes/base.xml, with the device file's own overrides. */
#ifndef FW_DEVICE_MATERIAL_H
#define FW_DEVICE_MATERIAL_H
#include "device/limit_data.h"

typedef struct fw_device_material {
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
    fw_device_limit_data limit; /* what else is known of what it bears */
    bool strength_stated;       /* by the device file: it rules alone */
} fw_device_material;

typedef struct fw_device_material_override { /* attributes of <material>; unknown where absent */
    fw_quantity youngs, poisson, density, strength;
    fw_device_limit_data limit;
} fw_device_material_override;

typedef struct fw_device_materials {
    fw_device_material *item; /* (count) */
    int count;
} fw_device_materials;

/* reads the <material> elements of a pack (base.xml) */
fw_status fw_device_materials_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                                   fw_diags *diags, fw_device_materials *materials);
const fw_device_material *fw_device_material_find(const fw_device_materials *materials,
                                                  const char *id);
/* the material with overrides applied; an override's source is "device file". A stated modulus
   makes a crystal isotropic: its constants are unknown then. */
fw_device_material fw_device_material_with(const fw_device_material *material,
                                           const fw_device_material_override *override);
/* all three constants are known: its modulus goes with the direction */
bool fw_device_material_is_crystal(const fw_device_material *material);

#endif
