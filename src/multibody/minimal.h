/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order in which `minimal` places bodies one after another, from the ground. Private to
 * multibody/. */
#ifndef FW_MULTIBODY_MINIMAL_H
#define FW_MULTIBODY_MINIMAL_H
#include "multibody/model.h"

/* a body turned about a pin of placed bodies, a dyad of two, or a body that nothing holds */
typedef struct fw_multibody_placing {
    bool dyad;
    int body[2];  /* the bodies placed; one: body[0] */
    int block[3]; /* pins: placed - body[0], body[0] - body[1], body[1] - placed; one: block[0] */
    int turn;     /* one: block that keeps its angle, or FW_NONE */
    int rate;     /* one: index of its angle among the independent ones, or FW_NONE */
    bool loose;   /* x, y and angle are independent, from `rate` on; no block */
} fw_multibody_placing;

typedef struct fw_multibody_placing_plan {
    fw_multibody_placing *step; /* (count) */
    int count, rates;           /* independent coordinates */
    int *rate_body;             /* (rates) */
    int *rate_axis;             /* (rates) 0 x, 1 y, 2 angle */
} fw_multibody_placing_plan;

enum { FW_MOST_RATES = 200 }; /* N is dense */

/* FW_SOLVER with a diagnostic that names the body where it ends */
fw_status fw_multibody_placing_find(fw_arena *arena, const fw_multibody_model *m,
                                    const fw_mechanism *mechanism, fw_diags *diags,
                                    fw_multibody_placing_plan *plan);

/* which side of a block a body is on: 0 (a) or 1 (b) */
static inline int fw_layout_side(const fw_multibody_model *m, int block, int body) {
    return m->body[2 * block] == body ? 0 : 1;
}
/* the body on the other side */
static inline int fw_across(const fw_multibody_model *m, int block, int body) {
    return m->body[2 * block + 1 - fw_layout_side(m, block, body)];
}

#endif
