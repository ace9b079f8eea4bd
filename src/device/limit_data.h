/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a material is known to bear, beside its plain strength: data of processes/base.xml, with the
   device file's own overrides. What the numbers mean: docs/theory/limits-of-materials.md. */
#ifndef FW_DEVICE_LIMIT_DATA_H
#define FW_DEVICE_LIMIT_DATA_H
#include "quantity/quantity.h"

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
int fw_device_limit_data_index(const char *id);    /* -1: none of that id */
const char *const *fw_device_limit_data_ids(void); /* (FW_LIMIT_DATA) */
/* FW-D047 at `place` where the value is out of its range */
void fw_device_limit_data_check(int k, const fw_quantity *q, fw_place place, fw_diags *diags);
/* FW-D233, FW-D234: what belongs together and is not all there */
void fw_device_limit_data_complete(const fw_device_limit_data *data, const char *whose,
                                   fw_place place, fw_diags *diags);
/* all unknown */
fw_device_limit_data fw_device_limit_data_none(fw_place place);

#endif
