/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The compiled scene: everything of one mechanism and its active effects in plain arrays, scaled by
   the scene's own length, mass and time, pins in the order of elimination. Private to dynamics/.

   State y = (u, v, d): displacements u (3 nbody) from the assembled pose, velocities v (3 nbody),
   dissipated energy d (only when something dissipates). The ground is body nbody: no mass terms. */
#ifndef FW_DYNAMICS_MODEL_H
#define FW_DYNAMICS_MODEL_H
#include "dynamics/dynamics.h"
#include "maths/dop853.h"

typedef struct fw_scale { /* one unit of the model in SI */
    double length_m, mass_kg, time_s;
} fw_scale;

typedef struct fw_model_torsion {
    int a, b;            /* bodies */
    double k, c, angle0; /* angle - free angle at the assembled pose */
} fw_model_torsion;

typedef struct fw_model_load {
    int body;
    double x, y, fx, fy; /* local arm, force in world axes */
} fw_model_load;

typedef struct fw_model_spring {
    int a, b;
    double ax, ay, bx, by; /* local arms */
    double k, c, length;
} fw_model_spring;

/* ---- sparse block LDL^T of S = G M^-1 G^T, 2 x 2 blocks, one row of blocks per pin ---- */
typedef struct fw_coupling { /* a body shared by two pins: block += sign (I/m + r_row r_col^T/J) */
    int block, row_arm, column_arm, body;
    double sign;
} fw_coupling;

typedef struct fw_update { /* block[to] -= factor[left] block[right]^T */
    int to, left, right;
} fw_update;

typedef struct fw_chain {
    int pins, blocks, ncoupling;
    int *column; /* (pins + 1) first block below the diagonal of each column */
    int *row;    /* (blocks) */
    int *first;  /* (pins + 1) first update of each column */
    fw_update *update;
    fw_coupling *coupling;  /* (ncoupling) */
    double *diagonal;       /* (3 pins) xx, xy, yy of S */
    double *isotropic;      /* (pins) 1/m_a + 1/m_b: the smaller eigenvalue of a diagonal block */
    double shift;           /* eps of the last factorisation */
    double *pivot;          /* (3 pins) inverse of the pivot blocks */
    double *block, *factor; /* (4 blocks) S below the diagonal, then L */
} fw_chain;

typedef struct fw_model {
    fw_scale scale;
    int nbody, npin;
    int nq, ny; /* 3 nbody; length of the state */
    bool dissipates;
    double *origin;         /* (3 (nbody + 1)) assembled pose, unscaled angle, scaled x and y */
    double *mass, *inertia; /* (nbody) */
    double *minv, *jinv;    /* (nbody + 1), 0 for the ground */
    int *pin;               /* (npin) pin of the mechanism, by order of elimination */
    int *body;              /* (2 npin) bodies a and b */
    double *local;          /* (4 npin) local arms of a and b */
    double *offset;         /* (2 npin) x_a - x_b of the origins */
    double *constant;       /* (3 (nbody + 1)) forces / masses: accelerations; 0 for ground */
    fw_model_torsion *torsion;
    fw_model_load *load;
    fw_model_spring *spring;
    int ntorsion, nload, nspring;
    double size; /* largest |offset| + arms: round-off of Psi is eps times this */
    fw_chain chain;
    /* work */
    double *cosine, *sine;         /* (nbody + 1) */
    double *arm;                   /* (4 npin) arms in world axes */
    double *accel;                 /* (3 (nbody + 1)) */
    double *lambda, *right, *more; /* (2 npin) */
    bool broken;                   /* a pivot was not positive: the state is not usable */
    /* kept over a run */
    long projections;
    double worst_position, worst_velocity;
} fw_model;

/* check.c: everything that comes in; errors are reported */
fw_status fw_check_options(const fw_motion_options *options, const fw_scene *scene,
                           fw_diags *diags);
fw_status fw_check_motion(const fw_mechanism *mechanism, const fw_scene *scene, fw_diags *diags);
fw_status fw_check_names(const fw_motion_options *options, fw_diags *diags, fw_motion *motion);

/* scale.c: terms may be NULL (assembly: no forces) */
fw_status fw_model_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_terms *terms,
                       const double *q, double duration_s, fw_model **model);

/* topology.c: elimination order of the pins (order[k] = pin), then the schedule */
fw_status fw_topology_order(fw_arena *arena, const fw_mechanism *mechanism, int *order);
fw_status fw_chain_compile(fw_arena *arena, fw_model *model);

/* block_chain.c */
void fw_chain_assemble(fw_model *m);               /* S from the arms */
bool fw_chain_factor(fw_chain *c, double epsilon); /* false: not positive */
void fw_chain_solve(const fw_chain *c, double *x); /* (S + eps D) x = x, in place; D = isotropic */
/* S x = right by the proximal iteration; right is kept, x (2 pins) */
void fw_chain_proximal(const fw_chain *c, const double *right, double *x, double *more);

/* rhs.c */
void fw_model_pose(fw_model *m, const double *u);                  /* sines and arms */
void fw_model_forces(fw_model *m, const double *y);                /* accel = M^-1 Q */
void fw_model_accelerate(fw_model *m, const double *y, double *f); /* arms and factor are there */
void fw_model_rhs(void *model, double t, const double *y, double *f);
/* a -= M^-1 G^T lambda for (x, y, phi) triples a */
void fw_model_apply(const fw_model *m, const double *lambda, double *a);
/* r = G v */
void fw_model_jacobian(const fw_model *m, const double *v, double *r);

/* project.c */
double fw_model_residual(fw_model *m, const double *u, double *psi); /* largest |Psi|; sets arms */
bool fw_model_project(void *model, double t, double *y, double *f);
bool fw_model_project_position(fw_model *m, double *u);
bool fw_model_project_velocity(fw_model *m, double *v);

/* energy.c */
typedef struct fw_energy {
    double kinetic, elastic, work, dissipated;
} fw_energy;
fw_energy fw_model_energy(fw_model *m, const double *y);

/* peak.c */
typedef struct fw_peaks {
    double *start; /* (npin of the mechanism) angle at the assembled pose */
    int *a, *b;    /* (npin) bodies */
    fw_peak *peak; /* (npin) time scaled */
    int npin;
} fw_peaks;
fw_status fw_peaks_new(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                       fw_peaks *peaks);
double fw_peaks_angle(const fw_peaks *peaks, int pin, const double *y);
void fw_peaks_step(fw_peaks *peaks, const fw_model *m, fw_dop853 *s);

static const double fw_epsilon = 1e-8; /* proximal term, relative to 1/m_a + 1/m_b of each pin */

#endif
