/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a material is known to bear, beside its plain strength: data of processes/base.xml, with the
   device file's own overrides. What the numbers mean: docs/theory/limits-of-materials.md. */
#ifndef FW_DEVICE_MATERIAL_H
#define FW_DEVICE_MATERIAL_H
#include "quantity/quantity.h"

struct fw_xml_source_text;

typedef struct fw_device_limit_data { /* each unknown where the material has none */
    /* fracture: P_f = 1 - exp(-(A/A0) (sigma/sigma0)^m); the three only together */
    fw_quantity weibull_strength; /* Pa: sigma0 */
    fw_quantity weibull_modulus;  /* 1: m */
    fw_quantity weibull_area;     /* m2: A0, on which sigma0 was found */
    /* yield */
    fw_quantity offset_yield;        /* Pa: 0.2 % offset */
    fw_quantity proportional_factor; /* 1: proportional limit over the 0.2 % offset value */
    /* 0.2 % offset of a film: film_yield + film_yield_rise (t/1 um)^-film_exponent */
    fw_quantity film_yield, film_yield_rise; /* Pa */
    fw_quantity film_exponent;               /* 1 */
    fw_quantity film_thickest;               /* m: up to which the law was found */
    /* fatigue, fully reversed */
    fw_quantity fatigue_strength;   /* Pa: stress amplitude that lasts fatigue_cycles */
    fw_quantity fatigue_cycles;     /* 1 */
    fw_quantity fatigue_exponent;   /* 1: b of Basquin's law, below 0 */
    fw_quantity ductility;          /* 1: eps_f' of Manson and Coffin's law */
    fw_quantity ductility_exponent; /* 1: c of it, below 0 */
} fw_device_limit_data;

enum { FW_LIMIT_DATA = 14 }; /* quantities above */
/* the k-th of them, by its place in the struct; its id in packs, which is also the attribute's name
   in <material>; its dimension */
fw_quantity *fw_device_limit_data_at(fw_device_limit_data *data, int k);
const char *fw_device_limit_data_id(int k);
fw_quantity_dimension fw_device_limit_data_dimension(int k);
/* FW-D233, FW-D234: what belongs together and is not all there */
void fw_device_limit_data_complete(const fw_device_limit_data *data, const char *whose,
                                   fw_place place, fw_diags *diags);

/* Materials: data of processes/base.xml, with the device file's own overrides. */

typedef struct fw_device_material {
    const char *id, *name;
    fw_quantity youngs;    /* Pa, for bending in the wafer plane */
    fw_quantity poisson;   /* 1; of a crystal out of the plane */
    fw_quantity density;   /* kg/m3 */
    fw_quantity strength;  /* Pa: stress that the safety factor divides */
    const char *criterion; /* "fracture", "proportional limit", "yield" */
    fw_quantity loss;      /* 1: loss factor eta of the material damping, for c = eta k/omega */
    fw_quantity
        expansion; /* 1/K, thermal, of length, at 300 K; in the mean over a change dT from there */
    fw_quantity expansion_slope,
        expansion_curvature;    /* + slope dT + curvature dT^2: 1/K2, 1/K3; unknown: 0 */
    fw_quantity modulus_change; /* 1/K: (dE/dT)/E */
    fw_quantity c11, c12, c44;  /* Pa: of a cubic crystal in a (100) wafer; unknown: isotropic */
    fw_device_limit_data limit; /* what else is known of what it bears */
    bool strength_stated;       /* by the device file: it rules alone */
    bool plane_by_constants; /* of a crystal of which the device file states E alone: see below */
} fw_device_material;

typedef struct fw_device_material_override { /* attributes of <material>; unknown where absent */
    fw_quantity youngs, poisson, density, strength;
    fw_device_limit_data limit;
} fw_device_material_override;

typedef struct fw_device_materials {
    fw_device_material *item; /* (count) */
    int count;
    const struct fw_xml_source_text *source; /* (nsource) where its numbers are from */
    int nsource;
} fw_device_materials;

/* mean coefficient over a change from 300 K, of three such quantities; 1/K, NaN: not known */
double fw_device_mean_expansion(const fw_quantity *expansion, const fw_quantity *slope,
                                const fw_quantity *curvature, double change_K);

/* reads the <material> elements of a pack (base.xml) */
fw_status fw_device_materials_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                                   fw_diags *diags, fw_device_materials *materials);
/* those of a flow: its own, and of the shared ones what it does not give again; one that it does counts as a whole */
fw_status fw_device_materials_of_flow(fw_arena *arena, const char *file, const char *xml, size_t n,
                                      const fw_device_materials *shared, fw_diags *diags,
                                      fw_device_materials *materials);
const fw_device_material *fw_device_material_find(const fw_device_materials *materials,
                                                  const char *id);
/* the material with overrides applied; an override's source is "device file". A stated modulus
   makes a crystal isotropic: its constants are unknown then. */
fw_device_material fw_device_material_with(const fw_device_material *material,
                                           const fw_device_material_override *override);
/* all three constants are known: its modulus goes with the direction */
bool fw_device_material_is_crystal(const fw_device_material *material);
/* Stress over strain of a layer that is stretched alike in all directions of its plane, Pa; NaN where it is not known */
double fw_device_material_biaxial_Pa(const fw_device_material *material);

#endif
