/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ladder of `flexwright hinge`: one hinge by models of growing fidelity and cost. A level is a
   file with one function and a row in hinge_ladder.c. Private to the room. */
#ifndef FW_CLI_HINGE_LADDER_H
#define FW_CLI_HINGE_LADDER_H
#include "flexure/drift.h"
#include "mechanism/mechanism.h"

typedef struct fw_ladder_case {
    fw_arena *arena; /* of this evaluation: freed when it has been measured */
    const fw_mechanism *mechanism;
    const fw_hinge *hinge; /* its input is what every level starts from */
} fw_ladder_case;

typedef struct fw_ladder_row {
    double centre_m[2];                                  /* elastic centre, world, drawn pose */
    double stiffness_Nm_per_rad, kx_N_per_m, ky_N_per_m; /* x along the hinge's axis */
    double strain_per_rad, limit_angle_rad;
    fw_flexure_error error; /* the level's own estimate */
    double cpu_s;           /* of one evaluation, measured */
} fw_ladder_row;

typedef struct fw_ladder_level {
    const char *name, *summary;
    /* fills all but cpu_s; *exists = false: this level has nothing for this hinge, no row */
    fw_status (*work)(const fw_ladder_case *c, fw_ladder_row *row, bool *exists);
} fw_ladder_level;

const fw_ladder_level *fw_ladder_levels(size_t *count);
/* one level, repeated until the clock can see it (at least once, at most for 2 ms) */
fw_status fw_ladder_climb(const fw_ladder_case *c, const fw_ladder_level *level, fw_ladder_row *row,
                          bool *exists);
/* hinge frame to world: where the pin + (along, across) is in the drawn pose; the pin is at W */
void fw_ladder_place(const fw_ladder_case *c, double along_m, double across_m, double world_m[2]);

fw_status fw_ladder_closed_form(const fw_ladder_case *c, fw_ladder_row *row, bool *exists);
fw_status fw_ladder_compliance(const fw_ladder_case *c, fw_ladder_row *row, bool *exists);

/* ---- hinge_drift.c: what the finite rotation does, on either side of rest ---- */
enum { FW_DRIFT_POINTS = 41 };
typedef struct fw_ladder_drift {
    fw_surfaces surfaces;   /* aside_rad NaN: not drawn */
    double limit_rad;       /* the range: +- this */
    double contact_rad[2];  /* pure moment: at what rotations of the pin, - and +; NaN: none in
                               the range up to half a turn */
    double closing_N[2];    /* force along and across that closes the gap at rest; NaN: no gap */
    fw_drift_advice advice; /* for +- limit */
    fw_drift_point point[FW_DRIFT_POINTS]; /* from - to + limit, rotation of the pin */
} fw_ladder_drift;
void fw_ladder_drift_of(const fw_ladder_case *c, fw_ladder_drift *out);

#endif
