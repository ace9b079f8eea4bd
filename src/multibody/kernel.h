/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fast right-hand side of the method `chain` for plain models: all joints are pins, the effects
   torsion springs and dampers between bodies and constant forces at the bodies' own points.

   One source (kernel_blocks.c) serves one design and lanes of designs. One design: baseline
   instructions, no contraction, one order of operations, hence the same bits on every processor.
   State y = (u, v, [d]) and units as in model.h. */
#ifndef FW_MULTIBODY_KERNEL_H
#define FW_MULTIBODY_KERNEL_H
#include "multibody/model.h"

typedef struct fw_multibody_kernel fw_multibody_kernel;

/* A pivot block is healthy when its smaller eigenvalue exceeds this share of 1/m_a + 1/m_b; with
   all of them healthy one plain solve is enough. Near a singular position the pivot falls with the
   square of the angle p to it: A02 leaves health at p = 1e-3 rad. Closer than that the plain
   solution is the better one of S lambda = r (N = 5, p = 1e-4: error of the accelerations 1e-9, and
   1e-2 by six sweeps), but it takes the round-off of the pose for a motion out of the branch: with
   1e-12 here N = 40 does not get through. The sweeps leave such motions out. What is singular by
   structure leaves pivots of some round-offs, 1e-16 to 1e-14. Test: test_kernel.c, test_simulate.c
   (windows). */
static const double fw_healthy = 1e-6;

typedef struct fw_multibody_kernel_norms { /* after the last projection; scaled */
    double position, velocity;
} fw_multibody_kernel_norms;

/* *kernel = NULL when the model is not plain. The model must live as long as the kernel. */
fw_status fw_multibody_kernel_new(fw_arena *arena, const fw_multibody_model *model,
                                  fw_multibody_kernel **kernel);
/* f (ny) = y' at y (ny); NaN where the equations cannot be solved. Allocates nothing. */
void fw_multibody_kernel_rhs(fw_multibody_kernel *k, const double *y, double *f);
/* an accepted step: y onto Psi = 0 and G v = 0 in place, then f there; starts with the factor of
   the last evaluation. false: it does not get there; y is not usable */
bool fw_multibody_kernel_project(fw_multibody_kernel *k, double *y, double *f);
/* (2 npin) joint forces of the last evaluation, pins in the order of the model */
const double *fw_multibody_kernel_lambda(fw_multibody_kernel *k);
fw_multibody_kernel_norms fw_multibody_kernel_norms_of(const fw_multibody_kernel *k);

/* ---- lanes ----

   Many designs of one topology at once: every lane of a register carries a design with its own
   masses, stiffnesses, geometry and loads. Plain models only. The instruction set is chosen at run
   time; wide lanes may contract products and sums, so they agree with the single kernel to
   round-off and not to the bit.

   A batch is laid out in groups of `width` designs. A state vector y holds group after group, in a
   group component after component (ny of them, as in model.h), in a component lane after lane.
   Lanes that no design fills repeat the last design. */
typedef struct fw_multibody_lanes fw_multibody_lanes;

/* names of the instruction sets of this processor, best first; NULL after the last */
const char *fw_multibody_lanes_set(int i);
/* *lanes = NULL when a model is not plain, or has not the joints, springs and state of the first.
   `set` NULL: the best; FW_USAGE for one that this processor has not. count > 0. */
fw_status fw_multibody_lanes_new(fw_arena *arena, const fw_multibody_model *const *models,
                                 int count, const char *set, fw_multibody_lanes **lanes);
int fw_multibody_lanes_width(const fw_multibody_lanes *l);
const char *fw_multibody_lanes_set_name(const fw_multibody_lanes *l);
size_t
fw_multibody_lanes_size(const fw_multibody_lanes *l); /* doubles in a state vector of the batch */

/* state y (ny) of one design into the batch, and out of it */
void fw_multibody_lanes_put(const fw_multibody_lanes *l, int design, const double *y,
                            double *batch);
void fw_multibody_lanes_get(const fw_multibody_lanes *l, int design, const double *batch,
                            double *y);

/* f = y' of every design, all with the vectors aligned as the arena aligns them. Allocates nothing.
   A design that has no solution gets NaN accelerations, the others are not touched by it. */
void fw_multibody_lanes_rhs(fw_multibody_lanes *l, const double *y, double *f);
/* an accepted step of all designs: y onto the constraints in place, then f there; false: some
   design does not get there */
bool fw_multibody_lanes_project(fw_multibody_lanes *l, double *y, double *f);
void fw_multibody_lanes_lambda(const fw_multibody_lanes *l, int design,
                               double *lambda); /* (2 nblock), after rhs */

typedef struct fw_multibody_lanes_run {
    long steps, rejected, rhs; /* over all groups */
} fw_multibody_lanes_run;
/* every design from y over its own duration (scaled), group by group in lockstep: all designs of a
   group share the fraction of the duration that a step covers. The tolerance of the group's step is
   rtol / sqrt(width), so that no design's own error norm exceeds what rtol allows alone. atol (ny)
   for all designs. Integrator dop853. FW_SOLVER: some design stops. */
fw_status fw_multibody_lanes_integrate(fw_arena *arena, fw_multibody_lanes *l,
                                       const double *duration, double rtol, const double *atol,
                                       double *y, fw_multibody_lanes_run *run);

/* ---- what the kernels run over: private to them ---- */

/* What the kernels run over: index tables of one topology, and records of numbers in which every
   number is `width` doubles, one per design. Private to the kernels. */

enum { FW_LOOP_LEAST = 3, FW_LOOP_MOST = 6, FW_WIDTH_MOST = 8 };

typedef struct fw_multibody_kernel_plan {
    int bodies, pins, blocks, extras, torsions;
    int nq, ny;
    bool dissipates;
    const int *body;   /* (2 pins); the ground is body `bodies` */
    const int *column; /* (pins + 1) first block below the diagonal of each column */
    const int *row;    /* (blocks) */
    const int *arm;    /* (2 blocks) arms of row and column at the shared body, 2 pin + side */
    const int *extra;  /* (3 extras) further shared bodies: block and its two arms */
    const int *first;  /* (pins + 1) first update of each column */
    const fw_multibody_update *update;
    const int *torsion; /* (2 torsions) */
    /* one closed loop of all bodies, both ends on the ground, every spring across one of its pins:
       pin i of the loop lies between its bodies i and i + 1, of which the first and last are the
       ground */
    bool loop;
    int loop_pin[FW_LOOP_MOST + 1], loop_body[FW_LOOP_MOST + 2];
    const int *loop_torsion; /* (torsions) the place of their pins in the loop */
} fw_multibody_kernel_plan;

enum { /* records of constants */
       FW_MINV,
       FW_JINV,
       FW_AX,
       FW_AY,
       FW_AT,
       FW_PHI0,
       FW_BODY = 8,
       FW_LOCAL = 0,
       FW_MASSES = 4,
       FW_OFFSET,
       FW_FLOOR = 7,
       FW_PIN = 8,
       FW_BLOCK = 2,  /* sign/m, sign/J */
       FW_TORSION = 4 /* k, c, k angle0 */
};
enum { /* records of work */
       FW_C,
       FW_S,
       FW_PHI,
       FW_SPEED,
       FW_A,
       FW_STATE = 8, /* per body; acceleration 3 */
       FW_ARM = 0,
       FW_DIAGONAL = 4,
       FW_X = 7,
       FW_PIVOT = 9,
       FW_ROW = 12, /* per pin */
       FW_B = 0,
       FW_L = 4,
       FW_COUPLING = 8, /* per block */
       FW_KEEP = 4      /* per pin: plain solution, sum */
};

typedef struct fw_multibody_core fw_multibody_core;
typedef struct fw_multibody_core_ops { /* one row per width and instruction set */
    const char *name;
    int width;
    void (*rhs)(fw_multibody_core *k, const double *y, double *f);
    bool (*singular)(fw_multibody_core *k, const double *u); /* is a pivot sick at this pose? */
    bool (*project)(fw_multibody_core *k, double *y, double *f);
    /* the form of closed loops: memory, and the numbers of one lane */
    fw_status (*loop_new)(fw_arena *arena, fw_multibody_core *k);
    void (*loop_fill)(fw_multibody_core *k, const fw_multibody_model *model, int lane);
} fw_multibody_core_ops;

struct fw_multibody_core {
    fw_multibody_kernel_plan plan;
    const fw_multibody_core_ops *ops;
    double *body, *pin, *block, *extra, *torsion; /* constants */
    double *size;                                 /* (1) largest |offset| + arms of each design */
    double *rate;                                 /* (1) y' is multiplied by it */
    double *state, *row, *coupling, *keep;        /* work */
    struct loop *loop;                            /* NULL: by the blocks alone */
    double healthy;
    bool redundant; /* some pivot vanishes in every pose: no use to try the plain solution */
    fw_multibody_kernel_norms norms;
};

struct fw_multibody_kernel {
    fw_multibody_core core; /* of width 1 */
    double *lambda;         /* (2 pins) */
};

bool fw_multibody_core_plain(const fw_multibody_model *model);

/* one design, and lanes of them where the processor has neither of the others */
extern const fw_multibody_core_ops fw_multibody_core_single;
extern const fw_multibody_core_ops fw_multibody_core_avx2, fw_multibody_core_avx512;

/* sine and cosine of one angle, as the kernel of one design takes them (maths/lanes.h) */
void fw_multibody_kernel_sincos(double angle_rad, double *sine, double *cosine);

#endif
