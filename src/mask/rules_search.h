/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges of one layer and what is found between them. Private to the room and its tests. */
#ifndef FW_MASK_RULES_SEARCH_H
#define FW_MASK_RULES_SEARCH_H
#include "geometry/segment.h"
#include "mask/mask_rules.h"

typedef struct fw_mask_rule_edge { /* a segment of a shape that is no joint */
    fw_geometry_segment s;
    fw_geometry_box box;
    int shape, segment;
    bool corner_a, corner_b; /* the outline turns there, across joints too */
    double slack_m;          /* what flattening may take away on this side */
    fw_geometry_vec2 along; /* unit tangent in the middle; unused of arcs of half a turn and more */
    double sin_half, cos_half; /* of half its sweep; a line: 0, 1 */
    fw_geometry_segment *part; /* (nparts) of at most 7.5 degrees; NULL until they are needed */
    fw_geometry_box *part_box;
    int nparts;
} fw_mask_rule_edge;

typedef struct fw_mask_rule_range { /* the edges of one shape */
    int first, count, shape;
    fw_geometry_box box; /* joints included */
} fw_mask_rule_range;

typedef enum fw_mask_rule_kind { FW_RULE_WIDTH, FW_RULE_SPACE, FW_RULE_OVERLAP } fw_mask_rule_kind;

typedef struct fw_mask_rule_finding { /* a chord that is shorter than a rule; edges that meet */
    fw_mask_rule_kind kind;
    int shape[2], segment[2];
    double value_m, slack_m; /* its length; what flattening may take of it */
    fw_geometry_vec2 at[2];
    const fw_mask_rule_edge *edge[2]; /* NULL: one lies inside the other */
    fw_geometry_box box;              /* of the whole place, by fw_mask_rule_places */
} fw_mask_rule_finding;

typedef struct fw_mask_rule_search { /* one layer */
    fw_arena *arena;
    const fw_mask_shape *shape;
    int index;         /* of the layer */
    double limit_m[2]; /* largest rule for widths and for spaces; 0: there is none */
    fw_mask_rule_edge *edge;
    struct fw_mask_rule_starts *start; /* where edges begin */
    fw_mask_rule_range *range;         /* (nrange) by the left end of their boxes */
    int nedge, nrange;
    double slack_m; /* largest of any edge */
    fw_mask_measure *measure;
    fw_mask_rule_finding *found; /* (nfound) grows */
    int nfound, room;
    double cap_m;    /* pairs farther apart than this and the rules are not looked at */
    bool everything; /* for the tests: no pair is passed over */
    bool no_memory;
} fw_mask_rule_search;

/* rules_edges.c */
fw_status fw_mask_rule_edges(fw_mask_rule_search *in, int nshape, double tolerance_m);
bool fw_mask_rule_parts(fw_mask_rule_search *in, fw_mask_rule_edge *e); /* false: no memory */
/* which edges begin at a place, by the bits of its coordinates: the next one after edge `after`, or
   -1 for the first; -1: there is none. In the order of the edges. Cost O(1). */
int fw_mask_rule_start_at(const fw_mask_rule_search *in, fw_geometry_vec2 at, int after);
/* rules_search.c: every pair of edges that may matter */
void fw_mask_rule_search_run(fw_mask_rule_search *in);
/* rules_pair.c */
void fw_mask_rule_pair(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q);
void fw_mask_rule_own(fw_mask_rule_search *in, fw_mask_rule_edge *e);
void fw_mask_rule_add(fw_mask_rule_search *in, fw_mask_rule_finding f);
void fw_mask_rule_report(fw_mask_rule_search *in,
                         fw_mask_rule_finding f); /* the same, the lesser shape first */
/* rules_places.c: the chords of one kind that are below a limit, as places: the shortest chord of
   each, in the order of shapes. Sorts `list`. */
fw_status fw_mask_rule_places(fw_arena *arena, fw_mask_rule_finding *list, int n, double limit_m,
                              fw_mask_rule_finding **out, int *nout);
/* what a rule asks of a pair of edges; 0: there is none */
double fw_mask_rule_needed(const fw_mask_rule_search *in, fw_mask_rule_kind kind, double slack_m);
/* beyond this a chord of that kind changes nothing */
double fw_mask_rule_bound(const fw_mask_rule_search *in, fw_mask_rule_kind kind);

#endif
