/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The peak strain of every hinge, followed along the motion. Private to the room and its tests. */
#ifndef FW_VERDICT_STRAIN_MONITOR_H
#define FW_VERDICT_STRAIN_MONITOR_H
#include "dynamics/dynamics.h"
#include "maths/rainflow.h"
#include "verdict/strain.h"

typedef struct fw_verdict_strain_peak {
    double strain, t_s; /* largest so far, and when */
    double between;     /* what the parabola added to the largest sample: the error of the search */
    double t[2], s[2];  /* the last two instants */
    int seen;
} fw_verdict_strain_peak;

typedef struct fw_verdict_strain_monitor { /* of one run */
    const fw_mechanism *mechanism;
    const fw_layout *layout; /* NULL: bounds instead of the drawn axis */
    fw_arena *arena;
    fw_flexure_elastica **beam; /* (nhinge) made when first needed; NULL: not yet */
    bool no_memory; /* for them: strains are those of the closed form, and the run has failed */
    fw_verdict_strain_peak *hinge; /* (nhinge) */
    fw_maths_turning (
        *root)[2]; /* (nhinge) of the strain at either root; NULL: nobody counts cycles */
} fw_verdict_strain_monitor;

/* cycles: also keep the turning points that fatigue needs */
fw_status fw_verdict_strain_monitor_new(fw_arena *arena, const fw_mechanism *mechanism,
                                        const fw_layout *layout, bool cycles,
                                        fw_verdict_strain_monitor *monitor);
/* an fw_dynamics_observer; context is the watch */
void fw_verdict_strain_monitor_record(void *context, const fw_dynamics_instant *instant);
/* Strains of which the numerical error is known from two runs. What stiff axes carry is known less
   well than the rotation: peaks of forces that ride on them come nearer with a tighter tolerance,
   but not at the order of the method. Error: twice what any hinge's largest strain differs by (1.1
   times was seen, test_hard_verdict.c), times the margin of the two runs; the largest difference
   of all hinges counts for each, since one alone may agree by chance. */
double fw_verdict_strain_monitor_error(const fw_verdict_strain_monitor *saw,
                                       const fw_verdict_strain_monitor *looser, double margin);
/* that over ten times the accuracy wanted of the lowest limit:
   fw_dynamics_motion_options.unsettled */
double fw_verdict_strain_monitor_unsettled(const void *saw, const void *looser, double margin,
                                           double accuracy);
/* one more instant of one hinge */
void fw_verdict_strain_peak_add(fw_verdict_strain_peak *peak, double t_s, double strain);

#endif
