/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of design rules: one file rule_NAME.c with its row each, and one line in rule_kinds.c.
   Private to the room and its tests. */
#ifndef FW_MASK_RULE_H
#define FW_MASK_RULE_H
#include "mask/rules_search.h"

typedef enum fw_rule_unit {
    FW_UNIT_LENGTH,
    FW_UNIT_ANGLE,
    FW_UNIT_AREA,
    FW_UNIT_SHARE
} fw_rule_unit;

enum { /* attributes of <rule> beside kind, layer, min, source and severity */
       FW_TAKES_INSIDE = 1,
       FW_TAKES_FROM = 2,
       FW_TAKES_OF = 4,
       FW_TAKES_MAX = 8,
       FW_TAKES_WINDOW = 16,
       FW_TAKES_PRINT = 32, /* wavelength, gap, resist: names for the formula of min */
};

typedef struct fw_rules { /* one mask while it is checked */
    fw_arena *arena;
    const fw_mask_table *table;
    const fw_mask_shape *shape; /* (nshape) */
    int nshape;
    double tolerance_m;
    fw_mask_rule *rule; /* (nrule) the table's, and those that layers state themselves */
    int nrule;
    fw_rule_search *search; /* (table->nlayer) edges, and what was found between them */
    fw_mask_finding *finding;
    int nfinding, room;
    bool no_memory;
} fw_rules;

typedef struct fw_rule_row {
    const char *name;   /* kind="..." */
    const char *advice; /* what to do */
    int number;         /* of the diagnostic */
    int marker;         /* data type on the marker layer */
    fw_rule_unit unit;
    unsigned takes; /* attributes; INSIDE, FROM, PRINT and WINDOW are needed too */
    unsigned of, usual_of;
    bool built_in; /* no row of the table says it */
    fw_status (*check)(fw_rules *rules, const fw_mask_rule *rule);
} fw_rule_row;

extern const fw_rule_row fw_kind_width, fw_kind_space, fw_kind_notch, fw_kind_feature,
    fw_kind_enclosure, fw_kind_separation, fw_kind_angle, fw_kind_edge, fw_kind_area,
    fw_kind_density, fw_kind_overlap;
const fw_rule_row *fw_rule_kind_at(size_t i); /* NULL behind the last row */

/* length in um, angle in degrees, area in um2 */
double fw_rule_shown(const fw_rule_row *kind, double value);
const char *fw_rule_unit_name(const fw_rule_row *kind);

/* ---- for the kinds ---- */
void fw_rules_add(fw_rules *rules, fw_mask_finding finding);
/* the rule's findings among the chords of a layer: one for each place where a chord of that kind is
   below the limit. `pick` (may be NULL) says which pairs of shapes count */
fw_status fw_rules_chords(fw_rules *rules, const fw_mask_rule *rule, fw_rule_kind kind,
                          bool (*pick)(const fw_rules *rules, const fw_finding *f,
                                       const void *with),
                          const void *with);
/* chords between the rule's two layers below its limit, and edges that cross (rules_between.c) */
fw_status fw_rules_between(fw_rules *rules, const fw_mask_rule *rule, fw_rule_search *between);
/* what was found between layers as places: one alone where a shape crosses, lies in or outside */
fw_status fw_rules_distances(fw_rules *rules, const fw_mask_rule *rule, fw_rule_search *between);
/* the shape of a layer that holds the point; NULL: none */
const fw_rule_range *fw_rules_holding(const fw_rules *rules, int layer, fw_vec2 at);
/* is the edge the first one of its shape, or behind a joint? From there to the next joint all lie
   on the same side of an outline that they do not cross */
bool fw_rules_first(const fw_rules *rules, const fw_rule_edge *edge);
/* connected pieces of a layer: group[shape] is the least shape joined to it; -1: other layer */
fw_status fw_rules_islands(const fw_rules *rules, int layer, int **group);
fw_box fw_box_around(fw_vec2 p, fw_vec2 q);

/* ---- the whole (rules.c) ---- */
fw_status fw_rules_start(fw_rules *rules, fw_mask_measure *measure);
/* those that need polygons, or those that do not */
fw_status fw_rules_check(fw_rules *rules, bool polygons);
/* worst few of each rule, and how many there are; the number of findings that are errors */
fw_status fw_rules_tell(fw_rules *rules, fw_diags *diags, int *nbroken);

#endif
