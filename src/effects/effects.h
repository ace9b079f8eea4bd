/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One file per effect: is it called for by the scene, how far can it move the answer, and its
   force. An effect is active when the scene calls for it and its bound exceeds the accuracy wanted.
   The list of active effects is compiled once per scene; an absent one costs nothing. */
#ifndef FW_EFFECTS_EFFECTS_H
#define FW_EFFECTS_EFFECTS_H
#include "device/device.h"
#include "mechanism/mechanism.h"

typedef enum fw_effect_mode {
    FW_EFFECTS_AUTO,
    FW_EFFECTS_ALL,
    FW_EFFECTS_NONE,
    FW_EFFECTS_LIST
} fw_effect_mode;
typedef struct fw_effect_choice {
    fw_effect_mode mode;
    const char *list; /* comma separated ids, for FW_EFFECTS_LIST */
} fw_effect_choice;

typedef struct fw_effect_entry { /* a line of the ledger */
    const char *id;
    bool called_for, active;
    double bound; /* on the relative change of the peak hinge deflection when left out; inf when
                     the effect is the motion itself; 0 when it is not called for */
    const char *reason;
} fw_effect_entry;
typedef struct fw_effect_ledger {
    fw_effect_entry *item; /* (count) */
    int count;
} fw_effect_ledger;

/* ---- what acts, compiled to plain arrays in SI; an absent effect leaves no entry behind ---- */
typedef struct fw_torsion { /* per pin with a spring or damper */
    int pin, body_a, body_b;
    double stiffness_Nm_per_rad, damping_Nms_per_rad, free_angle_rad;
} fw_torsion;

typedef struct fw_point_load { /* constant force in world axes at a point of a body */
    int body;
    double x_m, y_m, fx_N, fy_N;
} fw_point_load;

typedef struct fw_timed_load { /* force and torque in world axes times a law */
    int body;
    double x_m, y_m, fx_N, fy_N, torque_Nm;
    const fw_law *law;
} fw_timed_load;

typedef struct fw_stop { /* pushes back where side * (angle - at) > 0; angle as of the pin */
    int pin, body_a, body_b;
    double side, at_rad, free_angle_rad, stiffness_Nm_per_rad, damping_Nms_per_rad;
} fw_stop;

typedef struct fw_slide { /* spring and damper along a prismatic joint */
    int tie;
    double stiffness_N_per_m, damping_Ns_per_m;
} fw_slide;

typedef struct fw_terms {
    int nbody;
    double *constant;     /* (3 nbody) force on the centre of mass, torque */
    double *velocity;     /* (3 nbody) initial velocities as the scene states them */
    fw_torsion *torsion;  /* (ntorsion) */
    int *torsion_of;      /* (npin) 1 + index in torsion; 0: none */
    fw_point_load *load;  /* (nload) off the centre of mass */
    fw_timed_load *timed; /* (ntimed) */
    fw_stop *stop;        /* (nstop) */
    fw_slide *slide;      /* (nslide) */
    int *slide_of;        /* (ntie) likewise in slide */
    fw_spring *spring;    /* (nspring) */
    int ntorsion, nload, ntimed, nstop, nslide, nspring;
} fw_terms;

typedef struct fw_effect_case { /* what an effect is asked about */
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_scene *scene;
} fw_effect_case;

typedef struct fw_effect_row { /* one row per effect: adding one is one file and one row */
    const char *id, *summary;
    bool (*called_for)(const fw_effect_case *c);
    /* conservative bound on the relative change when left out; *reason says how it was found */
    fw_status (*bound)(const fw_effect_case *c, double *bound, const char **reason);
    /* adds to the terms; sizes were reserved */
    void (*add)(const fw_effect_case *c, fw_terms *terms);
} fw_effect_row;
const fw_effect_row *const *fw_effect_rows(size_t *count);

/* decides and compiles. A list with an unknown id is FW_USAGE (FW-D110 names the known ones). */
fw_status fw_effects_compile(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                             const fw_effect_choice *choice, double accuracy, fw_diags *diags,
                             fw_effect_ledger *ledger, fw_terms *terms);

/* linear static response of the constrained mechanism about its initial pose to the generalized
   forces `force` (3 nbody), with the springs of `terms`, drivers held: displacements (3 nbody) and
   pin rotations (npin). Stops and slack cables do not act. *valid false when there is none (free
   motion, redundant joints) or the mechanism has more than FW_RESPONSE_MOST unknowns. */
enum { FW_RESPONSE_MOST = 250 };
fw_status fw_static_response(fw_arena *arena, const fw_mechanism *mechanism, const fw_terms *terms,
                             const double *force, double *displacement, double *rotation,
                             bool *valid);
/* generalized forces (3 nbody) of the terms at the initial pose, just behind t = 0: constants,
   loads, springs, slides, stops */
void fw_terms_initial_force(const fw_mechanism *mechanism, const fw_terms *terms, double *force);
/* the same with every timed load at the largest |factor| that it has in (0, end_s) */
void fw_terms_largest_force(const fw_mechanism *mechanism, const fw_terms *terms, double end_s,
                            double *force);

#endif
