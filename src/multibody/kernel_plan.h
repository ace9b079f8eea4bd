/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the kernels run over: index tables of one topology, and records of numbers in which every
   number is `width` doubles, one per design. Private to the kernels of dynamics/. */
#ifndef FW_MULTIBODY_KERNEL_PLAN_H
#define FW_MULTIBODY_KERNEL_PLAN_H
#include "multibody/kernel.h"

typedef struct fw_kernel_plan {
    int bodies, pins, blocks, extras, torsions;
    int nq, ny;
    bool dissipates;
    const int *body;   /* (2 pins); the ground is body `bodies` */
    const int *column; /* (pins + 1) first block below the diagonal of each column */
    const int *row;    /* (blocks) */
    const int *arm;    /* (2 blocks) arms of row and column at the shared body, 2 pin + side */
    const int *extra;  /* (3 extras) further shared bodies: block and its two arms */
    const int *first;  /* (pins + 1) first update of each column */
    const fw_update *update;
    const int *torsion; /* (2 torsions) */
} fw_kernel_plan;

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

typedef struct fw_core fw_core;
typedef struct fw_core_ops { /* one row per instruction set */
    const char *name;
    int width;
    void (*rhs)(fw_core *k, const double *y, double *f);
    bool (*singular)(fw_core *k, const double *u); /* is a pivot sick at this pose? */
    bool (*project)(fw_core *k, double *y, double *f);
} fw_core_ops;

struct fw_core {
    fw_kernel_plan plan;
    const fw_core_ops *ops;
    double *body, *pin, *block, *extra, *torsion; /* constants */
    double *size;                                 /* (1) largest |offset| + arms of each design */
    double *rate;                                 /* (1) y' is multiplied by it */
    double *state, *row, *coupling, *keep;        /* work */
    double *angle, *sine, *cosine;                /* (bodies) width 1 only */
    double healthy;
    bool redundant; /* some pivot vanishes in every pose: no use to try the plain solution */
    fw_kernel_norms norms;
};

bool fw_core_plain(const fw_model *model);
/* what the pivot of a pin is measured against */
double fw_pin_floor(const fw_model *model, int pin);
fw_status fw_kernel_plan_new(fw_arena *arena, const fw_model *model, fw_kernel_plan *plan);
/* memory for `ops->width` designs of this plan */
fw_status fw_core_new(fw_arena *arena, const fw_kernel_plan *plan, const fw_core_ops *ops,
                      fw_core *core);
/* after all lanes are filled: sets `redundant` */
fw_status fw_core_examine(fw_arena *arena, fw_core *core);
/* the numbers of a model of the same topology into one lane */
void fw_core_fill(fw_core *core, const fw_model *model, int lane);

extern const fw_core_ops fw_core_single;
extern const fw_core_ops fw_core_sse2, fw_core_avx2, fw_core_avx512;

/* sine and cosine of x (n); see kernel_sincos.h */
void fw_sincos_array(int n, const double *x, double *sine, double *cosine);

/* ---- paths: kernel_trail.c, kernel_path.h ---- */
typedef struct fw_trail { /* pins in a row; the bodies around them, one more */
    int *pin, *body;
    int *torsion; /* the pin of every spring, by its number in the row */
    int count;
} fw_trail;
/* false: the joints do not form one path, or a spring does not sit across one of them */
fw_status fw_trail_find(fw_arena *arena, const fw_model *model, fw_trail *trail, bool *found);

typedef struct fw_path_ops { /* one row per instruction set */
    const char *name;
    int width; /* designs at once */
    /* of `width` models with this trail */
    fw_status (*create)(fw_arena *arena, const fw_model *const *models, const fw_trail *trail,
                        void **path);
    void (*rhs)(void *path, const double *y, double *f);
    bool (*project)(void *path, double *y, double *f);
    void (*lambda)(const void *path, int lane, double *lambda);
    fw_kernel_norms (*norms)(const void *path);
    void (*set_healthy)(void *path, double relative);
    void (*set_rate)(void *path, const double *rate); /* (width) y' is multiplied by it */
} fw_path_ops;
/* one design: the i-th encoding that this processor has, best first, NULL after the last; all give
   the same bits */
const fw_path_ops *fw_path_single(int i);
extern const fw_path_ops fw_path_baseline, fw_path_single_avx, fw_path_single_avx512;
extern const fw_path_ops fw_path_sse2, fw_path_avx2, fw_path_avx512;

#endif
