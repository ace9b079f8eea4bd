/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to the room: meshes of the elastica and one Newton pass over them. Everything here is
   without units: lengths over that of the beam l, moments times C_theta, forces times C_theta l. */
#ifndef FW_FLEXURE_ELASTICA_CORE_H
#define FW_FLEXURE_ELASTICA_CORE_H
#include "flexure/beam.h"

enum { FW_NODES = 8, FW_LEVELS = 5, FW_UNKNOWN = 3 };

/* eight nodes at once: the compiler cuts this into what the processor has */
typedef double fw_nodes __attribute__((vector_size(8 * FW_NODES), may_alias));

typedef struct fw_flexure_rule {
    fw_nodes column[FW_NODES]; /* [j][i]: integral of Lagrange polynomial j to node i */
    fw_nodes node, weight;
    double finer[2][FW_NODES][FW_NODES + 2]; /* start, nodes, end to the nodes of both halves */
    double place[FW_NODES + 2], between[FW_NODES + 2]; /* start, nodes, end; barycentric weights */
} fw_flexure_rule;

/* what is carried along the beam: value and derivatives by the unknowns */
enum { PHI, MOMENT, X, Y, CARRIED };
typedef struct fw_flexure_carried {
    double value[CARRIED], by[CARRIED][FW_UNKNOWN];
} fw_flexure_carried;

typedef struct fw_flexure_element {
    int piece;
    double from, h;    /* from the start of the piece */
    double dx, dy;     /* over the element as made */
    double cumulative; /* rotation under a unit moment up to its start */
    double turn;       /* phi at the end = phi + turn * moment at the start + ... */
    fw_nodes psi, cos_made, sin_made, bend, axial, shear; /* bend: 1/EI */
    fw_nodes turned;              /* phi at the nodes = phi + turned * moment at the start + ... */
    fw_nodes twice[FW_NODES];     /* [j][i]: h^2 A (1/EI) A: of the moment's slope to phi */
    fw_nodes twice_end, once_end; /* the same at the end; h times weight */
    fw_nodes phi;                 /* rotation at the nodes: the unknown */
    fw_nodes kept;                /* phi to go back to */
    fw_nodes change[1 + FW_UNKNOWN];        /* of phi in this pass: itself, by the unknowns */
    double start, start_by[1 + FW_UNKNOWN]; /* phi at the start, the same way */
    double rise;                            /* of the moment, by the present phi */
    /* Where what is carried has grown, the moment at the element's end takes the place of the first
       unknown: that is then (end + shift - by_force.F)/grown; grown 0: it stays. `first` is its
       change in this element */
    double grown, shift, by_force[2], first;
} fw_flexure_element;

typedef struct fw_flexure_mesh {
    int count;
    fw_flexure_element *element;
    bool made;                            /* tables filled */
    double end, end_by[1 + FW_UNKNOWN];   /* phi at the end */
    double turn, turn_by[1 + FW_UNKNOWN]; /* of the second body: that and what its root gives */
    double kept;                          /* turn to go back to */
    double growth;                        /* product of all `grown`; 1: none */
} fw_flexure_mesh;

/* weights of start, nodes and end of an element at places along a mesh, kept: a motion asks for the same
   ones each time */
enum { FW_PLACES = FW_NODES + 2, FW_KEPT_PLACES = 33 };
typedef struct fw_flexure_between {
    int level, n; /* n 0: none */
    double part[FW_KEPT_PLACES], by[FW_KEPT_PLACES][FW_PLACES];
} fw_flexure_between;

struct fw_flexure_elastica {
    const fw_flexure_beam *beam;
    fw_flexure_beam_linear linear;
    fw_flexure_rule rule;
    fw_flexure_mesh mesh[FW_LEVELS];
    int *per_piece;             /* elements of each piece on the coarsest mesh */
    fw_flexure_beam_pose *pose; /* starts of the pieces */
    double floor; /* what rounding leaves of a change: more where it is stiff along its chord */
    bool stiff;   /* it hardly stretches: stiffnesses of W differ a hundredfold */
    double twice_soft_rad; /* twice the angle of the direction in which W is softest */
    double length_m, soft; /* units: l, C_theta */
    double root[2];        /* rotation per moment */
    double arm[2];         /* from the end to the point that is watched, as made */
    bool hinged;
    double p[FW_UNKNOWN], kept[FW_UNKNOWN]; /* moment (hinged: rotation) at the start, Fx, Fy */
    int solved;                             /* level of the last solution, -1: none */
    int least;                              /* level to begin on, unless from the last solution */
    bool
        halved; /* the mesh before it has a solution that is good enough; after `again`: it is that */
    bool moved;       /* by `again` since the solution */
    double square;    /* as in fw_flexure_newton, of the solution; 0: not known */
    double last[6];   /* its twist and wrench */
    double judged[2]; /* rotation and force of the last one whose error was looked at */
    double sign;      /* of its determinant over `unloaded` */
    fw_flexure_elastica_end kind[3]; /* for which `unloaded` was worked out */
    double unloaded;                 /* determinant of the unloaded beam; 0: none is held */
    int passes;
    fw_flexure_between between;
};

/* the end of the beam after a pass: twist and wrench for unchanged unknowns, and by them */
typedef struct fw_flexure_end_state {
    double value[6], by[6][FW_UNKNOWN];
} fw_flexure_end_state;

void fw_flexure_rule_fill(fw_flexure_rule *rule);
void fw_flexure_element_fill(const fw_flexure_elastica *e, fw_flexure_element *el);
void fw_flexure_mesh_fill(fw_flexure_elastica *e, int level);
void fw_flexure_mesh_refine(fw_flexure_elastica *e,
                            int level); /* phi of the next level from that of this one */

void fw_flexure_element_pass(fw_flexure_element *el, const double force[2],
                             fw_flexure_carried *carried);
void fw_flexure_mesh_pass(fw_flexure_elastica *e, int level, fw_flexure_end_state *end);
/* over element n of a solved mesh: values alone */
void fw_flexure_solved_pass(fw_flexure_elastica *e, int n, fw_flexure_carried *carried);
/* adds the change for dp to phi and p; answers the largest change, *span the largest |phi| */
double fw_flexure_mesh_update(fw_flexure_elastica *e, int level, const double *dp, double *span);
void fw_flexure_elastica_begin(const fw_flexure_elastica *e, fw_flexure_carried *carried);

typedef struct fw_flexure_goal { /* what is given, without units */
    fw_flexure_elastica_end given[3];
    double value[3];
    bool eased;     /* of the place only what lies along `soft`; the force across stays */
    double soft[2]; /* unit vector */
} fw_flexure_goal;

typedef struct fw_flexure_newton {
    double tolerance; /* on the change that would come next, over the largest rotation */
    double last;      /* on the last change itself, so that the tangent is as good */
    double contract;  /* largest quotient of two changes */
    double loose;     /* below it a change need not fall against the one before */
    double sign;      /* wanted of the determinant, 0: any */
    double square;    /* a change over the square of the one before; 0: not known. In and out */
    /* out: */
    double ratio, change, stability, span; /* span: largest rotation inside, at most 1 */
    fw_flexure_end_state end;              /* after the last change, derivatives before it */
} fw_flexure_newton;

typedef struct fw_flexure_way {
    bool warm;
    const double *guess; /* (6) twist and wrench of another law; NULL: none */
    double tolerance;
    double sign;
    double reached;
    int steps;
} fw_flexure_way;

bool fw_flexure_newton_run(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                           fw_flexure_newton *n);
/* for another kind of task than the last: the determinant of the unloaded beam, 0 where nothing
   holds it, and the sign of the present one */
void fw_flexure_elastica_unloaded(fw_flexure_elastica *e, const fw_flexure_goal *g);
/* a solution on this mesh: from the last one, from the wound beam, or along the branch; false:
   none. Where the branch ends before, w->reached is below 1 and g holds that part of the values. */
bool fw_flexure_elastica_reach(fw_flexure_elastica *e, int level, fw_flexure_goal *g,
                               fw_flexure_way *w, fw_flexure_newton *n);

#endif
