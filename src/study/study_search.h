/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Searches over the inputs of a study: what is judged next (study_descent.c), several of them at once (study_pool.c), and
   fronts of two goals (study_search.c). Private to the room and its tests. */
#ifndef FW_STUDY_STUDY_SEARCH_H
#define FW_STUDY_STUDY_SEARCH_H
#include "study/study.h"

/* ---- what is judged next ---- */

typedef struct fw_study_tried { /* a device that was judged, as a search sees it */
    double *x;                  /* shares of the ranged inputs */
    double f, *c;               /* objective, constraints; NaN: none */
    bool untold;                /* it does not hold, and none of these numbers says by how much */
    double *part;               /* of numbers that are the largest of several: these, in turn */
} fw_study_tried;

typedef struct fw_study_descent {
    int n, m, most; /* shares, 0..1 each; constraints, at least one; what may be judged */
    const int *
        parts; /* (m + 1) how many the objective, and each constraint, has; 0: it is itself. NULL: none has any */
    /* t->x is given, the rest is wanted; false: it is over */
    bool (*judge)(void *context, fw_study_tried *t);
    void *context;
    fw_study_tried *tried; /* room for `most`; (used) in their order */
    int used;
    bool over;
    double step;                /* first one of COBYLA, share of a range; 0: the usual one */
    const fw_study_tried *from; /* of models: where they begin, of what is known; NULL: the best */
} fw_study_descent;
/* the largest constraint; NaN: as bad as can be */
double fw_study_tried_worst(const fw_study_tried *t, int m);
/* from start, which becomes its end */
typedef fw_status fw_study_descend(fw_study_descent *d, double *start, fw_arena *arena);
fw_study_descend fw_study_descent_cobyla;
/* from what was judged already, on from the best of it */
fw_status fw_study_descent_models(fw_study_descent *d, const fw_study_tried *known, int nknown,
                                  fw_arena *arena);
/* a is better than b: feasible before infeasible, then by objective, or by constraint */
bool fw_study_search_better(double fa, double ca, double fb, double cb);
typedef struct fw_study_on_front { /* a device, and two goals, the less the better */
    double f[2];
    int at;        /* its number among those that were judged */
    double excess; /* of its limits */
} fw_study_on_front;
/* those of n that no other one beats, first, by the first goal: how many; of the same goals one. NaN: left out */
int fw_study_front(fw_study_on_front *p, int n);
/* a front with at most so many (>= 2) of its devices, evenly along it, both ends among them: how many */
int fw_study_front_thinned(fw_study_on_front *p, int n, int most);
/* levels of the second goal in the widest gaps of a front, at most so many, behind those that were tried: how many */
int fw_study_front_levels(const fw_study_on_front *p, int n, double *level, int had, int most);
/* result->found: the front of n devices, whose numbers are those of `sample` */
fw_status fw_study_front_keep(fw_study *study, const fw_study_sample *sample, fw_study_on_front *p,
                              int n, struct fw_study_result *result);

/* ---- local searches ---- */

typedef struct fw_study_search {
    /* of a sample that was run: what is to be small, and what must not be above 0 (NaN: as bad as can be), as many as
       `nconstraint`. *untold: it does not hold, and none of these numbers says by how much */
    double (*objective)(const void *context, const fw_study_sample *sample);
    int nconstraint;
    void (*constraint)(const void *context, const fw_study_sample *sample, double *c, bool *untold);
    /* of each that is the largest of several, these, `parts` (nconstraint + 1) of the objective and of each constraint, npart in
       all; NULL: none is */
    void (*part)(const void *context, const fw_study_sample *sample, double *part);
    const int *parts;
    int npart;
    /* what is looked at besides check, of a sample that was run and is not in the store: sample->used may rise by it;
       NULL: nothing. Called by several threads at once. */
    fw_status (*besides)(const void *beside, fw_study_sample *sample);
    const void *context, *beside;
    /* shares 0..1 of the ranges of the ranged inputs; listed ones keep their texts */
    double *start;
    const fw_study_sample *from; /* texts of listed inputs */
    /* NULL: COBYLA from the start. Else what was judged already (nknown), of the same texts of listed inputs: models of it
       say what is judged next, from the best of it on, or from the start (its number; FW_NONE: the best) */
    const fw_study_tried *known;
    int nknown, begin;
    fw_study_descend *descend; /* NULL: COBYLA, or models where `known` is */
    int most;                  /* evaluations */
    int digits;                /* of the values that are tried */
    long first;                /* number of its first sample */
    /* out: the best sample, feasible first; its objective and constraint */
    fw_study_sample best;
    double f, c;           /* c: the largest constraint */
    fw_study_tried *tried; /* (used) in their order */
    int used;
    fw_study_watch watch; /* at the corners of these, but for what is better than_f, than_c */
    double than_f, than_c;
    bool keeps_all;       /* in: `all` is wanted */
    fw_study_sample *all; /* (used) */
} fw_study_search;
/* begins at a sample: its shares, and its texts of listed inputs */
fw_status fw_study_search_from(const fw_study *study, const fw_study_sample *from,
                               fw_study_search *search);
/* by the largest share of a range that their inputs are apart; 1 where a listed one differs */
double fw_study_search_apart(const fw_study *study, const fw_study_sample *a,
                             const fw_study_sample *b);
/* search->known: of these samples those that have the texts of its start; search->begin: that one, else FW_NONE */
fw_status fw_study_search_knows(const fw_study *study, fw_study_search *search,
                                const fw_study_sample *sample, int nsample);
/* n searches, in threads: each gives the same whatever runs beside it */
fw_status fw_study_search_run(fw_study *study, fw_study_search *search, int n);

/* ---- what a size may judge ---- */

enum {
    FW_SIZE_SEARCHES =
        4, /* shares of a goal's budget: local searches, and one from all that was judged */
    FW_SIZE_EACH = 19,        /* devices of a search for each input, and so many more */
    FW_SIZE_LEVELS = 9,       /* of the second goal, at once */
    FW_SIZE_LISTS_MOST = 1000 /* combinations of listed values */
};
/* shares of a budget that nobody asked for */
int fw_study_size_searches(const fw_study *study, int goals);
#endif
