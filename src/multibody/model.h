/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The compiled scene: one mechanism and its active effects in plain arrays, scaled by the scene's
   own length, mass and time. It is const for everybody once fw_multibody_model_new has made it;
   what moves is a fw_multibody_system (system.h), of which one model may have many.

   Reference-point coordinates q = (x, y, phi) of every body's centre of mass, bodies 0 .. nbody -
   1. The ground is body nbody: it has no state and no mass (minv = jinv = 0). A state is

     y = (u, v, dissipated, worked)

   with displacements u (3 nbody) from the assembled pose `origin`, velocities v (3 nbody), then,
   where something needs them, the dissipated energy and the work of drivers and of loads that go
   with time.

   Constraints come in blocks of two rows between two bodies a and b. What has one row leaves the
   second one empty (0 = 0); a weld is a pin and a turn. So S = G M^-1 G^T has 2 x 2 blocks whatever
   the joints are. Blocks stand in the order of elimination.

   Arrays are written (length); arms and other vectors are x, y pairs, 2 x 2 and 2 x 3 blocks are
   row-major. */
#ifndef FW_MULTIBODY_MODEL_H
#define FW_MULTIBODY_MODEL_H
#include "base/diag.h"
#include "effects/effects.h"
#include "mechanism/mechanism.h"

typedef struct fw_multibody_scale { /* one unit of the model in SI */
    double length_m, mass_kg, time_s;
} fw_multibody_scale;

/* ---- constraints ----

   d = x_b + r_b - x_a - r_a runs from point a to point b; e(phi_a) and n(phi_a) are axis and normal
   fixed in a; f is a constant or, with a driver, a law in time.

     rows     first row                 second row   which is
     PIN      -d_x = 0                  -d_y = 0     a revolute joint; +lambda is the force on b
     SLIDE    phi_b - phi_a - f = 0     n.d = 0      a prismatic joint
     ROD      |d| - f = 0               empty        a massless rod between two points
     TURN     phi_b - phi_a - f = 0     empty        an angle that is kept or driven
     TRAVEL   e.d - f = 0               empty        a driven prismatic joint */
typedef enum fw_multibody_rows {
    FW_ROWS_PIN,
    FW_ROWS_SLIDE,
    FW_ROWS_ROD,
    FW_ROWS_TURN,
    FW_ROWS_TRAVEL
} fw_multibody_rows;

typedef struct fw_multibody_block {
    fw_multibody_rows rows;
    int a, b;                   /* bodies */
    double cos_axis, sin_axis;  /* in the frame of a */
    double value;               /* f without its law; TURN, SLIDE: less the angle at the origin */
    const fw_quantity_law *law; /* of a driver: f = value + law; NULL: constant */
    double unit;                /* of the law: SI per scaled */
    int pin, joint, driver;     /* of the mechanism, or FW_NONE */
} fw_multibody_block;

/* ---- forces ---- */

typedef struct fw_multibody_torsion { /* spring and damper about a pin */
    int a, b;                         /* bodies */
    double k, c, angle0;              /* angle0: angle - free angle at the assembled pose */
} fw_multibody_torsion;

typedef struct fw_multibody_load { /* constant force at a point of a body */
    int body;
    double x, y, fx, fy; /* local arm; force in world axes */
} fw_multibody_load;

typedef struct fw_multibody_timed_load { /* force and torque times a law */
    int body;
    double x, y, fx, fy, torque;
    const fw_quantity_law *law;
} fw_multibody_timed_load;

typedef struct fw_multibody_spring { /* between two points: model->spring_end */
    int a, b;
    double k, c, length;
    bool cable; /* only pulls */
} fw_multibody_spring;

typedef struct fw_multibody_stop { /* acts beyond an angle */
    int a, b, pin;
    double side, at, k, c; /* at: angle from the assembled pose's */
} fw_multibody_stop;

typedef struct fw_multibody_slide { /* spring and damper along a prismatic joint */
    int a, b, block;                /* the joint's SLIDE block has points and axis */
    double k, c, free;
} fw_multibody_slide;

typedef struct fw_multibody_element { /* a force element (effects/effects.h) on the bodies */
    const fw_effects_force_element *own;
    /* ports in scaled units, those of the ground from the centre */
    fw_effects_force_element scaled;
    bool electrodes;              /* a comb drive: goes with the loading's `drive` */
    int *body;                    /* (ports) */
    int first_switch, first_port; /* where its own begin among those of all elements */
} fw_multibody_element;

typedef struct fw_multibody_stretch { /* ground points that move with a law: constraints.c */
    const fw_quantity_law *law;       /* NULL: the ground stands still */
    double strain, centre[2];         /* a point of the ground gains strain (point - centre) law */
    double *block, *spring; /* (2 nblock) of d, (4 nspring) of ends, per unit of the law */
} fw_multibody_stretch;

typedef struct fw_multibody_friction_joint { /* Coulomb friction: multibody_friction.c */
    int a, b;                                /* bodies */
    int block;          /* of the joint; FW_NONE: an element stands for the pin */
    bool slides;        /* along a prismatic joint; else it turns about a pin */
    int element;        /* what presses, or FW_NONE: the joint's own force */
    double rest, slide; /* coefficient times radius (travel: 1), static and kinetic */
    double preload;
    const char *id;
    fw_place place;
} fw_multibody_friction_joint;

/* ---- schedule of the block L D L^T of S: a row of 2 x 2 blocks per constraint block ---- */

/* a body in two blocks: block += sign J_row M^-1 J_column^T */
typedef struct fw_multibody_coupling {
    int block, row_arm, column_arm, body;
    double sign;
} fw_multibody_coupling;

typedef struct fw_multibody_update { /* block[to] -= factor[left] block[right]^T */
    int to, left, right;
} fw_multibody_update;

typedef struct fw_multibody_chain {
    int pins, blocks, ncoupling; /* pins: rows of blocks; blocks: below the diagonal */
    int *column;                 /* (pins + 1) first block below the diagonal of each column */
    int *row;                    /* (blocks) */
    int *first;                  /* (pins + 1) first update of each column */
    fw_multibody_update *update;
    fw_multibody_coupling *coupling; /* (ncoupling) */
    double *isotropic;               /* (2 pins) D of the proximal term: 1/m_a + 1/m_b of a pin */
} fw_multibody_chain;

/* ---- the model ---- */

typedef struct fw_multibody_model {
    fw_multibody_scale scale;
    const struct fw_multibody_method *method; /* system.h */
    int nbody, nblock, npin, njoint, ndriver;
    int nq, ny;             /* 3 nbody; length of the state */
    int rows;               /* constraint rows that are not empty */
    int dissipated, worked; /* index in the state, or -1 */
    bool plain;    /* every block is a pin: arms say everything, Jacobians are not filled */
    bool driven;   /* some block has a law, or the ground stretches */
    bool special;  /* elements, released pins, friction or a stretching ground: no fast path */
    int nreleased; /* pins that are not constraints */
    double size;   /* largest |offset| + arms: round-off of Psi is eps times this */
    /* bodies */
    double *origin;         /* (3 (nbody + 1)) assembled pose, unscaled angle, scaled x and y */
    double *mass, *inertia; /* (nbody) */
    double *minv, *jinv;    /* (nbody + 1), 0 for the ground */
    /* constraints */
    fw_multibody_block *block;       /* (nblock) */
    int *body;                       /* (2 nblock) bodies a and b */
    double *local;                   /* (4 nblock) local arms of a and b */
    double *offset;                  /* (2 nblock) x_a - x_b of the origins */
    int *pin_block;                  /* (npin) block of a pin, FW_NONE: released */
    int *joint_block, *driver_block; /* (njoint), (ndriver) first block of those */
    fw_multibody_chain chain;
    /* forces */
    double *constant; /* (3 (nbody + 1)) constant forces / masses; 0 for the ground */
    int ntorsion, nload, ntimed, nstop, nslide, nspring, nelement, nfriction;
    fw_multibody_torsion *torsion;
    fw_multibody_load *load;
    fw_multibody_timed_load *timed;
    fw_multibody_stop *stop;
    fw_multibody_slide *slide;
    fw_multibody_spring *spring;
    double *spring_end; /* (4 nspring) local ends in a and b */
    int ncable;         /* of the springs */
    fw_multibody_element *element;
    struct fw_effects_beside
        *beside; /* flexures among them that are worked out side by side, or NULL */
    int nswitch, nport, most_ports; /* of all elements, of all elements, of the largest one */
    int *pin_element;               /* (npin) element that stands for a pin, or FW_NONE */
    fw_multibody_friction_joint *friction;
    fw_multibody_stretch stretch;
} fw_multibody_model;

/* q (3 nbody): the pose that becomes u = 0, SI. loads may be NULL (assembly: no forces); method
   NULL: chain */
fw_status fw_multibody_model_new(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_effects_loads *loads, const double *q, double duration_s,
                                 const struct fw_multibody_method *method,
                                 const fw_multibody_model **model);

/* model.c: what comes in from mechanism and scene; errors are reported */
fw_status fw_multibody_check_motion(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                    fw_diags *diags);
/* id of the joint or driver that a block belongs to */
const char *fw_multibody_block_name(const fw_mechanism *mechanism, const fw_multibody_block *block);
fw_place fw_multibody_block_place(const fw_mechanism *mechanism, const fw_multibody_block *block);

/* block_chain.c: elimination order of blocks between bodies (2 n; `ground` does not couple):
   order[k] = block */
fw_status fw_multibody_topology_order(fw_arena *arena, int n, const int *body, int ground,
                                      int *order);

static const double fw_epsilon = 1e-8; /* proximal term, relative to 1/m_a + 1/m_b of each pin */

/* system.c */
typedef struct fw_multibody_method_row { /* feeds --help and reference pages */
    const char *name, *summary;
} fw_multibody_method_row;
/* the i-th method; name NULL behind the last */
fw_multibody_method_row fw_multibody_method_at(size_t i);

/* N of one scaled unit of force */
static inline double fw_multibody_newton(const fw_multibody_model *m) {
    const fw_multibody_scale s = m->scale;
    return s.mass_kg * s.length_m / (s.time_s * s.time_s);
}

/* constraint rows of a block that are not empty */
static inline int fw_multibody_row_count(const fw_multibody_block *block) {
    return block->rows == FW_ROWS_PIN || block->rows == FW_ROWS_SLIDE ? 2 : 1;
}

#endif
