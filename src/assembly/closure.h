/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of the assembly: descent on |Psi|^2, placing bodies along a spanning tree, restarts.
   Everything is in the model's scaled units. Private to assembly/. */
#ifndef FW_ASSEMBLY_CLOSURE_H
#define FW_ASSEMBLY_CLOSURE_H
#include "assembly/assembly.h"
#include "multibody/system.h"

/* ---- closure.c: descent from a guess ---- */
typedef struct fw_assembly_closure {
    const fw_arena *arena; /* whose request to stop ends the descent */
    const fw_multibody_model *model;
    fw_multibody_system *system;
    fw_multibody_chain_numbers chain;
    double *u;                           /* (3 nbody) displacements from the guess */
    double *trial, *step, *psi, *lambda; /* work */
    double *held, *wanted;               /* (3 nbody) work of the way to the nearest pose */
    double *kept;                        /* (nblock) angle, length or travel that a block keeps */
    bool *active;                        /* (nblock) blocks that count */
    double *soft;                        /* (2 nblock) a mismatch counts divided by this */
    double promise;                      /* first-order decrease of the mismatch along the step */
    double goal;                         /* |Psi| of a closed mechanism */
    long iterations, left;               /* done; most that may follow */
} fw_assembly_closure;

/* for a mechanism at q (3 nbody, SI), which becomes u = 0; psi is that of u = 0 */
fw_status fw_assembly_closure_new(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                                  fw_diags *diags, fw_assembly_closure *c);
/* sum over active blocks of |Psi|^2 / soft^2; psi is set, *pose (NULL: not asked for) that of u */
double fw_assembly_closure_mismatch(fw_assembly_closure *c, const double *u,
                                    const fw_multibody_pose **pose);
/* from c->u downhill; true: every active block is closed to round-off */
bool fw_assembly_closure_descend(fw_assembly_closure *c, int most);
/* a closed c->u to the closed pose nearest to u = 0 in the mass metric */
void fw_assembly_closure_nearest(fw_assembly_closure *c);
/* angles that went round come back to within half a turn of the guess, where joints allow it */
void fw_assembly_closure_unwind(const fw_assembly_closure *c, int *group);
/* distance of the mass metric from u = 0, squared */
double fw_assembly_closure_distance(const fw_assembly_closure *c, const double *u);

/* ---- closure.c: other starts ---- */
typedef struct fw_assembly_tree {
    int *order;  /* (nbody) bodies in the order in which they are placed */
    int *parent; /* (nbody) body that it is joined to; nbody: the ground; -1: nothing */
    int *stage;  /* (nblock) place in `order` at which both bodies of a block stand */
    bool *link;  /* (nblock) joins a body to its parent: closed by placing it */
    int *first;  /* (nbody + 1) blocks of a body: item[first[b]] .. */
    int *item;   /* (2 nblock) */
} fw_assembly_tree;

/* closes the active blocks from other starts: body by body along the tree, loops as they close,
   then with turned bodies. best (3 nbody) ends as the least mismatch *value of all active blocks.
   work: 3 nbody doubles and nblock flags. */
typedef struct fw_assembly_restart {
    fw_assembly_tree tree;
    double *best, *saved;
    double value; /* least mismatch so far */
    bool *wanted; /* (nblock) active set to reach */
    bool *loop;   /* (nbody) bodies of the loop at hand */
    int restarts;
    bool cut; /* ended by the bound on its steps, not because all starts were tried */
} fw_assembly_restart;
fw_status fw_assembly_restart_new(fw_arena *arena, const fw_multibody_model *m,
                                  fw_assembly_restart *r);
bool fw_assembly_restart_close(fw_assembly_restart *r, fw_assembly_closure *c);

/* uniform in [0, 1): the same number for the same arguments, everywhere */
double fw_assembly_spread(unsigned stream, unsigned index);

/* ---- loops.c ---- */
/* what cannot close, in words; psi at the best pose */
fw_status fw_assembly_closure_explain(fw_arena *arena, const fw_mechanism *mechanism,
                                      fw_assembly_closure *c, fw_assembly_restart *r,
                                      fw_diags *diags);
typedef struct fw_assembly_length_unit {
    const char *name;
    double per_m;
} fw_assembly_length_unit;
/* one unit for lengths of one sentence: that of the longest, but so that the shortest keeps
   digits */
fw_assembly_length_unit fw_assembly_length_unit_for(double longest_m, double shortest_m);
char *fw_assembly_length_text(char *to, size_t n, double metres, fw_assembly_length_unit unit);
void fw_assembly_block_gap(const fw_multibody_model *m, int block, const double *psi, double *gap_m,
                           double *gap_rad);

/* ---- branch.c: elbows and other assemblies ---- */

/* Elbows and other assemblies. Private to assembly/. */

/* dyads whose mirror image may close too; (*count) of at most npin */
fw_status fw_assembly_elbows_find(fw_arena *arena, const fw_mechanism *mechanism,
                                  fw_assembly_elbow **elbow, int *count);
/* +1, -1, or 0 where it is flat; q (3 nbody) SI */
int fw_assembly_elbow_side(const fw_mechanism *mechanism, const double *q,
                           const fw_assembly_elbow *elbow);
fw_status fw_assembly_alternatives_find(fw_arena *arena, const fw_mechanism *mechanism,
                                        fw_diags *diags, fw_assembly *found);

/* ---- freedom.c ---- */

/* degrees of freedom at q (3 nbody) SI */
fw_status fw_assembly_rank(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                           fw_diags *diags, fw_assembly_rank_result *out);

#endif
