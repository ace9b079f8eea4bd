/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a flexure bears: one row per criterion, each from the material's own data, the lowest
   allowable stress governs. All are peak stresses at the root's fillet, before the safety factor.
   Theory, definitions and sources: docs/theory/limits-of-materials.md; which rules by default:
   docs/decisions/0014-which-limit-rules.md. */
#ifndef FW_FLEXURE_LIMIT_H
#define FW_FLEXURE_LIMIT_H
#include "flexure/flexure.h"
#include "flexure/strain_life.h"
#include "flexure/weibull.h"

typedef struct fw_flexure_limit {
    const char *criterion;  /* the row's name: "strength", "fracture", "yield", "fatigue" */
    const char *definition; /* what kind of number it is */
    double allowable_Pa;    /* fatigue: amplitude, fully reversed, of `cycles` equal cycles */
    fw_quantity_value_status status; /* the weakest of what went into it */
    const char *source;              /* of the number that it rests on most */
} fw_flexure_limit;

enum { FW_LIMITS = 4 };

typedef struct fw_flexure_limits {
    fw_flexure_limit item[FW_LIMITS]; /* (count) those that apply, in the order of the table */
    int count;
    int governing;               /* index of the lowest, fatigue left out; FW_NONE: nothing known */
    int fatigue;                 /* index of it, or FW_NONE */
    fw_flexure_weibull weibull;  /* of this flexure; .known: its data hold */
    fw_flexure_strain_life life; /* .known where fatigue >= 0 */
    const char *missing;         /* what was asked for and has no data; NULL: nothing */
    fw_place missing_place;      /* of what asked */
} fw_flexure_limits;

typedef struct fw_flexure_limit_input {
    const fw_device_material *material;
    const fw_flexure_input *flexure; /* shape, with its fillet; youngs_Pa of strain and stress */
    const fw_device_limits_asked *asked;
    int nhinge; /* of the whole device: in series, each may break it */
} fw_flexure_limit_input;

typedef struct fw_flexure_limit_row { /* adding a criterion is one function and one row */
    const char *name, *summary;
    /* true: *limit is what it allows. May say in `all` what it found beside, or missed */
    bool (*of)(const fw_flexure_limit_input *in, fw_flexure_limits *all, fw_flexure_limit *limit);
} fw_flexure_limit_row;
const fw_flexure_limit_row *fw_flexure_limit_rows(size_t *count);
void fw_flexure_limits_of(const fw_flexure_limit_input *in, fw_flexure_limits *limits);

/* NULL where nothing is known */
const fw_flexure_limit *fw_flexure_limits_governing(const fw_flexure_limits *limits);

#endif
