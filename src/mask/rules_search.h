/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges of one layer and what is found between them. Private to the room and its tests. */
#ifndef FW_MASK_RULES_SEARCH_H
#define FW_MASK_RULES_SEARCH_H
#include "geometry/segment.h"
#include "mask/rules.h"

typedef struct fw_rule_edge { /* a segment of a shape that is no joint */
    fw_segment s;
    fw_box box;
    int shape, segment;
    bool corner_a, corner_b; /* the outline turns there, across joints too */
    double slack_m;          /* what flattening may take away on this side */
    fw_vec2 along; /* unit tangent in the middle; unused of arcs of half a turn and more */
    double sin_half, cos_half; /* of half its sweep; a line: 0, 1 */
    fw_segment *part;          /* (nparts) of at most 7.5 degrees; NULL until they are needed */
    fw_box *part_box;
    int nparts;
} fw_rule_edge;

typedef struct fw_rule_range { /* the edges of one shape */
    int first, count, shape;
    fw_box box; /* joints included */
} fw_rule_range;

typedef enum fw_rule_kind { FW_RULE_WIDTH, FW_RULE_SPACE, FW_RULE_OVERLAP } fw_rule_kind;

typedef struct fw_finding { /* a chord that is shorter than a rule; edges that meet */
    fw_rule_kind kind;
    int shape[2], segment[2];
    double value_m, slack_m; /* its length; what flattening may take of it */
    fw_vec2 at[2];
    const fw_rule_edge *edge[2]; /* NULL: one lies inside the other */
    fw_box box;                  /* of the whole place, by fw_rule_places */
} fw_finding;

typedef struct fw_rule_search { /* one layer */
    fw_arena *arena;
    const fw_mask_shape *shape;
    int index;         /* of the layer */
    double limit_m[2]; /* largest rule for widths and for spaces; 0: there is none */
    fw_rule_edge *edge;
    struct fw_rule_starts *start; /* where edges begin */
    fw_rule_range *range;         /* (nrange) by the left end of their boxes */
    int nedge, nrange;
    double slack_m; /* largest of any edge */
    fw_mask_measure *measure;
    fw_finding *found; /* (nfound) grows */
    int nfound, room;
    double cap_m;    /* pairs farther apart than this and the rules are not looked at */
    bool everything; /* for the tests: no pair is passed over */
    bool no_memory;
} fw_rule_search;

/* rules_edges.c */
fw_status fw_rule_edges(fw_rule_search *in, int nshape, double tolerance_m);
bool fw_rule_parts(fw_rule_search *in, fw_rule_edge *e); /* false: no memory */
/* which edges begin at a place, by the bits of its coordinates: the next one after edge `after`, or
   -1 for the first; -1: there is none. In the order of the edges. Cost O(1). */
int fw_rule_start_at(const fw_rule_search *in, fw_vec2 at, int after);
/* rules_search.c: every pair of edges that may matter */
void fw_rule_look(fw_rule_search *in);
/* rules_pair.c */
void fw_rule_pair(fw_rule_search *in, fw_rule_edge *p, fw_rule_edge *q);
void fw_rule_own(fw_rule_search *in, fw_rule_edge *e);
void fw_rule_add(fw_rule_search *in, fw_finding f);
void fw_rule_report(fw_rule_search *in, fw_finding f); /* the same, the lesser shape first */
/* rules_places.c: the chords of one kind that are below a limit, as places: the shortest chord of
   each, in the order of shapes. Sorts `list`. */
fw_status fw_rule_places(fw_arena *arena, fw_finding *list, int n, double limit_m, fw_finding **out,
                         int *nout);
/* what a rule asks of a pair of edges; 0: there is none */
double fw_rule_needed(const fw_rule_search *in, fw_rule_kind kind, double slack_m);
/* beyond this a chord of that kind changes nothing */
double fw_rule_bound(const fw_rule_search *in, fw_rule_kind kind);

#endif
