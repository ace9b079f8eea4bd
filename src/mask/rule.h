/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Design rules: edges of one layer and what is found between them, the kinds of rules, the check of
   a mask, and its findings in the room's outputs. Private to the room and its tests. */
#ifndef FW_MASK_RULE_H
#define FW_MASK_RULE_H
#include "base/sort.h"
#include "geometry/segment.h"
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include "xml/xml_reader.h"

/* ---- edges of one layer, and what is found between them ---- */

typedef struct fw_mask_rule_edge { /* a segment of a shape that is no joint */
    fw_geometry_segment s;
    fw_geometry_box box;
    int shape, segment;
    bool corner_a, corner_b; /* the outline turns there, across joints too */
    double slack_m;          /* how far the edges that are written may be from it */
    fw_geometry_vec2 along; /* unit tangent in the middle; unused of arcs of half a turn and more */
    double sin_half, cos_half;            /* of half its sweep; a line: 0, 1 */
    struct fw_mask_rule_written *written; /* (nwritten) NULL until they are needed */
    int *near;                            /* (nwritten) of them, while a pair is judged */
    int nwritten;
    fw_geometry_box written_box; /* of all of them */
} fw_mask_rule_edge;

/* an edge of the polygon that is written, with the material on its left */
typedef struct fw_mask_rule_written {
    fw_geometry_point a, b;
    fw_geometry_box box; /* m */
} fw_mask_rule_written;

typedef struct fw_mask_rule_range { /* the edges of one shape */
    int first, count, shape;
    fw_geometry_box box; /* joints included */
} fw_mask_rule_range;

typedef enum fw_mask_rule_kind { FW_RULE_WIDTH, FW_RULE_SPACE, FW_RULE_OVERLAP } fw_mask_rule_kind;

typedef struct fw_mask_rule_finding { /* a chord that is shorter than a rule; edges that meet */
    fw_mask_rule_kind kind;
    int shape[2], segment[2];
    double value_m, slack_m; /* its length; how much longer the outlines' own may be */
    fw_geometry_vec2 at[2];
    const fw_mask_rule_edge *edge[2]; /* NULL: one lies inside the other */
    fw_geometry_box box;              /* of the whole place, by fw_mask_rule_places */
} fw_mask_rule_finding;

enum {
    FW_MASK_FOUND_MOST = 20000
}; /* shipped devices have none; places take a time that goes with the square */

typedef struct fw_mask_rule_search { /* one layer */
    fw_arena *arena;
    const fw_mask_shape *shape;
    int index;         /* of the layer */
    double limit_m[2]; /* largest rule for widths and for spaces; 0: there is none */
    fw_mask_rule_edge *edge;
    struct fw_mask_rule_starts *start; /* where edges begin */
    fw_mask_rule_range *range;         /* (nrange) by the left end of their boxes */
    int nedge, nrange;
    double slack_m;     /* largest of any edge */
    double tolerance_m; /* of flattening */
    fw_mask_measure *measure;
    fw_mask_rule_finding *found; /* (nfound) grows */
    int nfound, room;
    int most;        /* findings that are kept; 0: all */
    double cap_m;    /* pairs farther apart than this and the rules are not looked at */
    bool everything; /* for the tests: no pair is passed over */
    bool no_memory;
    bool crowded; /* there were more: the search ended there */
} fw_mask_rule_search;

/* By how much, as a sine, a corner between two edges may be sharper than it was drawn, where both came from a
   drawing on the grid: each end is off by at most 0.71 nm. Else 0. */
static inline double fw_mask_rule_lean(const fw_mask_rule_edge *p, const fw_mask_rule_edge *q) {
    if (!(p->s.flags & q->s.flags & FW_SEGMENT_ROUNDED)) return 0;
    return 1.42 * FW_GEOMETRY_GRID_M *
           (1 / vec_distance(p->s.a, p->s.b) + 1 / vec_distance(q->s.a, q->s.b));
}

/* outlines farther apart than this have no chord between written edges that breaks a rule; 0: there
   is none */
static inline double fw_mask_rule_needed(const fw_mask_rule_search *in, fw_mask_rule_kind kind,
                                         double slack_m) {
    double limit = in->limit_m[kind];
    return limit > 0 ? limit + slack_m : 0;
}
/* shorter than a rule: distances on the grid are known to 1e-15 m, and those that differ from a limit
   differ by more */
static inline bool fw_mask_rule_short(double value_m, double limit_m) {
    return value_m < limit_m - 1e-15;
}
/* beyond this a chord of that kind changes nothing */
static inline double fw_mask_rule_bound(const fw_mask_rule_search *in, fw_mask_rule_kind kind) {
    double least = kind == FW_RULE_WIDTH ? in->measure->width_m : in->measure->space_m;
    if (in->everything) return HUGE_VAL;
    return fw_greater(fw_mask_rule_needed(in, kind, 2 * in->slack_m), fw_lesser(least, in->cap_m));
}

/* rules_edges.c */
fw_status fw_mask_rule_edges(fw_mask_rule_search *in, int nshape, double tolerance_m);
/* which edges begin at a place, by the bits of its coordinates: the next one after edge `after`, or
   -1 for the first; -1: there is none. In the order of the edges. Cost O(1). */
int fw_mask_rule_start_at(const fw_mask_rule_search *in, fw_geometry_vec2 at, int after);
/* rules_pair.c: every pair of edges that may matter */
void fw_mask_rule_search_run(fw_mask_rule_search *in);
/* rules_written.c */
void fw_mask_rule_add(fw_mask_rule_search *in, fw_mask_rule_finding f);
/* the same, the lesser shape first */
void fw_mask_rule_report(fw_mask_rule_search *in, fw_mask_rule_finding f);
/* what is written of an edge, once; false: no memory */
bool fw_mask_rule_write(fw_mask_rule_search *in, fw_mask_rule_edge *e);
/* findings between what is written of two edges, or of one and itself. square: the two meet at a
   corner of the outline that is not below 90 degrees */
void fw_mask_rule_judge(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q,
                        bool square);
/* least distance between what is written of two edges, whatever way they face, and where; INFINITY
   where it is not below the limit */
double fw_mask_rule_apart(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q,
                          double limit_m, fw_geometry_vec2 at[2]);
/* rules_kinds.c: the chords of one kind that are below a limit, as places: the shortest chord of
   each, in the order of shapes. Sorts `list`. */
fw_status fw_mask_rule_places(fw_arena *arena, fw_mask_rule_finding *list, int n, double limit_m,
                              fw_mask_rule_finding **out, int *nout);

/* ---- kinds: each has its check and its row in a file rule_*.c, and one line in rules.def ---- */

typedef enum fw_mask_rule_unit_kind {
    FW_UNIT_LENGTH,
    FW_UNIT_ANGLE,
    FW_UNIT_AREA,
    FW_UNIT_SHARE
} fw_mask_rule_unit_kind;

/* attributes of <rule> beside kind, layer, min, source and severity */
enum {
    FW_TAKES_INSIDE = 1,
    FW_TAKES_FROM = 2,
    FW_TAKES_OF = 4,
    FW_TAKES_MAX = 8,
    FW_TAKES_WINDOW = 16,
    FW_TAKES_PRINT = 32, /* wavelength, gap, resist: names for the formula of min */
};

typedef struct fw_mask_rules { /* one mask while it is checked */
    fw_arena *arena;
    const fw_mask_table *table;
    const fw_mask_shape *shape; /* (nshape) */
    int nshape;
    const fw_layout *layout; /* for messages: what a place belongs to; NULL: not known */
    double tolerance_m;
    const double *bias_m; /* (table->nlayer) for messages: by how much edges stand outside of what is drawn; NULL: not known */
    fw_mask_rule *rule; /* (nrule) the table's, and those that layers state themselves */
    int nrule;
    fw_mask_rule_search *search; /* (table->nlayer) edges, and what was found between them */
    fw_mask_finding *finding;
    int nfinding, room;
    bool no_memory;
} fw_mask_rules;

/* chords that a kind judges */
enum {
    FW_CHORD_WIDTH = 1 << FW_RULE_WIDTH,
    FW_CHORD_SPACE = 1 << FW_RULE_SPACE,
};

typedef struct fw_mask_rule_kind_row {
    const char *name;   /* kind="..." */
    const char *advice; /* what to do */
    int number;         /* of the diagnostic */
    int marker;         /* data type on the marker layer */
    fw_mask_rule_unit_kind unit;
    unsigned takes; /* attributes; INSIDE, FROM, PRINT and WINDOW are needed too */
    unsigned of, usual_of;
    unsigned chords; /* FW_CHORD_...: which ones its least holds for, so that they are searched */
    bool built_in;   /* no row of the table says it */
    fw_status (*check)(fw_mask_rules *rules, const fw_mask_rule *rule);
} fw_mask_rule_kind_row;

#define FW_MASK_RULE(name) extern const fw_mask_rule_kind_row fw_mask_kind_##name;
#include "mask/rules.def"
#undef FW_MASK_RULE
const fw_mask_rule_kind_row *fw_mask_rule_kind_at(size_t i); /* NULL behind the last row */

/* length in um, angle in degrees, area in um2 */
double fw_mask_rule_row_shown(const fw_mask_rule_kind_row *kind, double value);

/* ---- for the kinds: rules_kinds.c ---- */
void fw_mask_rules_add(fw_mask_rules *rules, fw_mask_finding finding);
/* the rule's findings among the chords of a layer: one for each place where a chord of that kind is
   below the limit. `pick` (may be NULL) says which pairs of shapes count */
fw_status fw_mask_rules_chords(fw_mask_rules *rules, const fw_mask_rule *rule,
                               fw_mask_rule_kind kind,
                               bool (*pick)(const fw_mask_rules *rules,
                                            const fw_mask_rule_finding *f, const void *with),
                               const void *with);
/* the shape of a layer that holds the point; NULL: none */
const fw_mask_rule_range *fw_mask_rules_holding(const fw_mask_rules *rules, int layer,
                                                fw_geometry_vec2 at);
/* is the edge the first one of its shape, or behind a joint? From there to the next joint all lie
   on the same side of an outline that they do not cross */
bool fw_mask_rules_first(const fw_mask_rules *rules, const fw_mask_rule_edge *edge);
/* connected pieces of a layer: group[shape] is the least shape joined to it; -1: other layer */
fw_status fw_mask_rules_islands(const fw_mask_rules *rules, int layer, int **group);
fw_geometry_box fw_mask_box_around(fw_geometry_vec2 p, fw_geometry_vec2 q);
/* -1, 0, 1: p left of, at, right of q; below, at, above it where both are at one x */
static inline int fw_mask_order_places(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    int order = fw_order_doubles(p.x, q.x);
    return order ? order : fw_order_doubles(p.y, q.y);
}

/* ---- the whole (mask_rules.c) ---- */
fw_status fw_mask_rules_start(fw_mask_rules *rules, fw_mask_measure *measure);
/* those that need polygons, or those that do not */
fw_status fw_mask_rules_check(fw_mask_rules *rules, bool polygons);
/* worst few of each rule, and how many there are; the number of findings that are errors */
fw_status fw_mask_rules_tell(fw_mask_rules *rules, fw_diags *diags, int *nbroken);

/* ---- findings in files ---- */

/* all rules of a table, those that its layers state included, into rule and nrule */
fw_status fw_mask_rules_list(fw_mask_rules *rules);
/* table_rules.c: the same as `rules` of the certificate */
fw_status fw_mask_rules_json(fw_json *json, const fw_mask_table *table);

/* the highest layer up to 60 that the table does not use */
int fw_mask_marker_layer(const fw_mask_table *table);

/* ---- rows of a layer table: of <rule> and what is shared with the others ---- */

#define FW_MASK_ROWS(a) .attribute = (a), .nattribute = sizeof(a) / sizeof((a)[0])
/* text that goes into files of masks, which some readers take in plain ASCII only */
#define FW_MASK_PLAIN                                                                              \
    .kind = FW_KIND_FORM, .form = fw_mask_is_plain,                                                \
    .reason = "plain ASCII of 1 to 400 characters: some mask readers refuse all else"
#define FW_MASK_YES_NO .kind = FW_KIND_WORD, .words = fw_mask_yes_no, .fallback = "no"
#define FW_MASK_LENGTH .kind = FW_KIND_NUMBER, .dimension = {.m = 1}, .unit = "um"

/* table_rules.c */
extern const char *const fw_mask_yes_no[];
bool fw_mask_is_plain(const char *text);
bool fw_mask_says(const fw_xml_record *record, const char *name, const char *word);

/* the row for one <rule> by its kind; *row NULL: there is no such kind, which is told */
fw_status fw_mask_rule_row(fw_xml_reader *r, const fw_xml_element *e,
                           const fw_xml_element_row **row);
extern const fw_xml_numbers fw_mask_rule_numbers;

/* what was read, once all layers are known */
fw_status fw_mask_rules_build(fw_xml_reader *r, fw_mask_table *table);

#endif
