/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What clearance/ finds, judged: bands, what is asked for, and reasons. Private to the room. */
#ifndef FW_VERDICT_VERDICT_CLEARANCE_H
#define FW_VERDICT_VERDICT_CLEARANCE_H
#include "verdict/verdict.h"

/* one stator alone against all that moves: what shorts the drive */
typedef struct fw_verdict_stator_watch {
    const char *label;
    fw_clearance_things things;
    fw_clearance_least least;
} fw_verdict_stator_watch;

typedef struct fw_verdict_clearance_watch { /* of one run of a scene */
    const fw_clearance_things *things;      /* NULL: nothing is drawn */
    fw_arena *arena;
    fw_clearance_path path;
    fw_clearance_wish wish;
    fw_clearance_least least;        /* of what has left the path */
    bool parts;                      /* something has, before the motion's end */
    fw_verdict_stator_watch *stator; /* (nstator) */
    int nstator;
    const bool *among; /* (nsolid x nsolid) all pairs but those with what stands */
    fw_status status;
} fw_verdict_clearance_watch;

/* room for all scenes of a variant; layout may be NULL. with_stators: each is looked at by itself, too */
fw_status fw_verdict_clearance_begin(fw_arena *arena, const fw_layout *layout,
                                     const fw_mechanism *mechanism, bool with_stators,
                                     fw_verdict_clearance_watch watch[2],
                                     fw_verdict_variant_verdict *v);
/* which pairs the scene lets meet */
fw_status fw_verdict_clearance_scene(const fw_mechanism *m, const fw_device_scene *scene,
                                     fw_verdict_clearance_watch watch[2]);
/* an fw_dynamics_tracer; context is the strain monitor */
void fw_verdict_clearance_trace(void *context, const fw_dynamics_piece *piece);
/* Scene i, whose motion is v->motion[i]: its clearance, and a reason where it is not accepted.
   brief: only whether it is, which is proved with a fraction of the distances. */
fw_status fw_verdict_clearance_judge(fw_arena *arena, const fw_device_scene *scene, int i,
                                     const fw_layout *layout, bool brief, fw_diags *diags,
                                     fw_verdict_variant_verdict *v);
/* Share of what there is to use up: of a motion, the distance that is lost over what may be lost; of a
   required box, what is asked for over what is left. 0.001 to 1000; above 1 it is too little. */
double fw_verdict_clearance_used(const fw_verdict_clearance *clearance);
/* every required box of the flow that can be reached as a whole; after fw_workspace_required */
fw_status fw_verdict_clearance_boxes(fw_arena *arena, const fw_device *device,
                                     const fw_layout *layout, bool brief,
                                     fw_verdict_variant_verdict *v);
/* every flexure against its own two bodies; after the hinges */
fw_status fw_verdict_clearance_strips(fw_arena *arena, const fw_layout *layout,
                                      fw_verdict_variant_verdict *v);

#endif
