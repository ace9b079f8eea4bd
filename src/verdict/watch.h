/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The peak strain of every hinge, followed along the motion. Private to the room and its tests. */
#ifndef FW_VERDICT_WATCH_H
#define FW_VERDICT_WATCH_H
#include "dynamics/dynamics.h"
#include "maths/rainflow.h"
#include "verdict/strain.h"

typedef struct fw_strain_peak {
    double strain, t_s; /* largest so far, and when */
    double between;     /* what the parabola added to the largest sample: the error of the search */
    double t[2], s[2];  /* the last two instants */
    int seen;
} fw_strain_peak;

typedef struct fw_watch { /* of one run */
    const fw_mechanism *mechanism;
    const fw_layout *layout; /* NULL: bounds instead of the drawn axis */
    fw_arena *arena;
    fw_elastica **beam; /* (nhinge) made when first needed; NULL: not yet */
    bool no_memory;     /* for them: strains are those of the closed form, and the run has failed */
    fw_strain_peak *hinge; /* (nhinge) */
    fw_turning (*root)[2]; /* (nhinge) of the strain at either root; NULL: nobody counts cycles */
} fw_watch;

/* cycles: also keep the turning points that fatigue needs */
fw_status fw_watch_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_layout *layout,
                       bool cycles, fw_watch *watch);
/* an fw_observer; context is the watch */
void fw_watch_see(void *context, const fw_instant *instant);
/* Strains of which the numerical error is known from two runs. What stiff axes carry is known less
   well than the rotation: peaks of forces that ride on them come nearer with a tighter tolerance,
   but not at the order of the method. Error: twice what any hinge's largest strain differs by (1.1
   times was seen, test_hard_verdict.c), times the margin of the two runs; the largest difference
   of all hinges counts for each, since one alone may agree by chance. */
double fw_watch_error(const fw_watch *saw, const fw_watch *looser, double margin);
/* that over ten times the accuracy wanted of the lowest limit: fw_motion_options.unsettled */
double fw_watch_unsettled(const void *saw, const void *looser, double margin, double accuracy);
/* one more instant of one hinge */
void fw_strain_peak_add(fw_strain_peak *peak, double t_s, double strain);

#endif
