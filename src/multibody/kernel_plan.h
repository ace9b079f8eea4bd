/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the kernels run over: index tables of one topology, and records of numbers in which every
   number is `width` doubles, one per design. Private to the kernels. */
#ifndef FW_MULTIBODY_KERNEL_PLAN_H
#define FW_MULTIBODY_KERNEL_PLAN_H
#include "multibody/kernel.h"

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

/* sine and cosine of one angle, as the kernel of one design takes them (kernel_vector.h) */
void fw_multibody_kernel_sincos(double angle_rad, double *sine, double *cosine);

#endif
