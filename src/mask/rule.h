/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of design rules: one file rule_NAME.c with its row each, and one line in rule_kinds.c.
   Private to the room and its tests. */
#ifndef FW_MASK_RULE_H
#define FW_MASK_RULE_H
#include "mask/rules_search.h"

typedef enum fw_mask_rule_unit_kind {
    FW_UNIT_LENGTH,
    FW_UNIT_ANGLE,
    FW_UNIT_AREA,
    FW_UNIT_SHARE
} fw_mask_rule_unit_kind;

enum { /* attributes of <rule> beside kind, layer, min, source and severity */
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
    double tolerance_m;
    fw_mask_rule *rule; /* (nrule) the table's, and those that layers state themselves */
    int nrule;
    fw_mask_rule_search *search; /* (table->nlayer) edges, and what was found between them */
    fw_mask_finding *finding;
    int nfinding, room;
    bool no_memory;
} fw_mask_rules;

typedef struct fw_mask_rule_kind_row {
    const char *name;   /* kind="..." */
    const char *advice; /* what to do */
    int number;         /* of the diagnostic */
    int marker;         /* data type on the marker layer */
    fw_mask_rule_unit_kind unit;
    unsigned takes; /* attributes; INSIDE, FROM, PRINT and WINDOW are needed too */
    unsigned of, usual_of;
    bool built_in; /* no row of the table says it */
    fw_status (*check)(fw_mask_rules *rules, const fw_mask_rule *rule);
} fw_mask_rule_kind_row;

extern const fw_mask_rule_kind_row fw_mask_kind_width, fw_mask_kind_space, fw_mask_kind_notch,
    fw_mask_kind_feature, fw_mask_kind_enclosure, fw_mask_kind_separation, fw_mask_kind_angle,
    fw_mask_kind_edge, fw_mask_kind_area, fw_mask_kind_density, fw_mask_kind_overlap;
const fw_mask_rule_kind_row *fw_mask_rule_kind_at(size_t i); /* NULL behind the last row */

/* length in um, angle in degrees, area in um2 */
double fw_mask_rule_row_shown(const fw_mask_rule_kind_row *kind, double value);
const char *fw_mask_rule_unit_name(const fw_mask_rule_kind_row *kind);

/* ---- for the kinds ---- */
void fw_mask_rules_add(fw_mask_rules *rules, fw_mask_finding finding);
/* the rule's findings among the chords of a layer: one for each place where a chord of that kind is
   below the limit. `pick` (may be NULL) says which pairs of shapes count */
fw_status fw_mask_rules_chords(fw_mask_rules *rules, const fw_mask_rule *rule,
                               fw_mask_rule_kind kind,
                               bool (*pick)(const fw_mask_rules *rules,
                                            const fw_mask_rule_finding *f, const void *with),
                               const void *with);
/* chords between the rule's two layers below its limit, and edges that cross (rules_between.c) */
fw_status fw_mask_rules_between(fw_mask_rules *rules, const fw_mask_rule *rule,
                                fw_mask_rule_search *between);
/* what was found between layers as places: one alone where a shape crosses, lies in or outside */
fw_status fw_mask_rules_distances(fw_mask_rules *rules, const fw_mask_rule *rule,
                                  fw_mask_rule_search *between);
/* the shape of a layer that holds the point; NULL: none */
const fw_mask_rule_range *fw_mask_rules_holding(const fw_mask_rules *rules, int layer,
                                                fw_geometry_vec2 at);
/* is the edge the first one of its shape, or behind a joint? From there to the next joint all lie
   on the same side of an outline that they do not cross */
bool fw_mask_rules_first(const fw_mask_rules *rules, const fw_mask_rule_edge *edge);
/* connected pieces of a layer: group[shape] is the least shape joined to it; -1: other layer */
fw_status fw_mask_rules_islands(const fw_mask_rules *rules, int layer, int **group);
fw_geometry_box fw_mask_box_around(fw_geometry_vec2 p, fw_geometry_vec2 q);

/* ---- the whole (mask_rules.c) ---- */
fw_status fw_mask_rules_start(fw_mask_rules *rules, fw_mask_measure *measure);
/* those that need polygons, or those that do not */
fw_status fw_mask_rules_check(fw_mask_rules *rules, bool polygons);
/* worst few of each rule, and how many there are; the number of findings that are errors */
fw_status fw_mask_rules_tell(fw_mask_rules *rules, fw_diags *diags, int *nbroken);

#endif
