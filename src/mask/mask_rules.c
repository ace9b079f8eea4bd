/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All rules of one mask: the kinds that there are, the check, and what it found, in messages and files. */
#include "base/constants.h"
#include "base/text.h"
#include "mask/mask_parts.h"
#include "mask/rule.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the kinds ----
   One line each, in the order of docs/theory/masks.md. */

#define FW_MASK_RULE(name) &fw_mask_kind_##name,
static const fw_mask_rule_kind_row *const kinds[] = {
#include "mask/rules.def"
};
#undef FW_MASK_RULE

const fw_mask_rule_kind_row *fw_mask_rule_kind_at(size_t i) {
    return i < sizeof kinds / sizeof kinds[0] ? kinds[i] : NULL;
}

const char *fw_mask_rule_name(const fw_mask_rule *rule) {
    return rule->kind->name;
}

double fw_mask_rule_row_shown(const fw_mask_rule_kind_row *kind, double value) {
    switch (kind->unit) {
    case FW_UNIT_LENGTH:
        return value * 1e6;
    case FW_UNIT_ANGLE:
        return value * 180 / FW_PI;
    case FW_UNIT_AREA:
        return value * 1e12;
    case FW_UNIT_SHARE:
        return value;
    }
    return value;
}

static const char *unit_name(const fw_mask_rule_kind_row *kind) {
    static const char *const name[] = {"um", "deg", "um2", "of the window"};
    return name[kind->unit];
}

double fw_mask_rule_shown(const fw_mask_rule *rule, double value) {
    return fw_mask_rule_row_shown(rule->kind, value);
}

const char *fw_mask_rule_unit(const fw_mask_rule *rule) {
    return rule->kind->unit == FW_UNIT_SHARE ? "" : unit_name(rule->kind);
}

/* All rules of one mask. The union of pieces that share joints is bounded by their other segments,
   with the material on the left. So width and space of the union need no boolean: every two
   boundary edges that are near enough are looked at, and the side on which the chord leaves tells
   material from empty space. Edges: rules_edges.c; which pairs, and a pair:
   rules_pair.c; places: rules_kinds.c. What a rule makes of it: rule_*.c. */

/* ---- the rules: rows of the table, and what layers say in a word ---- */

static void add_rule(fw_mask_rules *r, const fw_mask_rule_kind_row *kind, int layer,
                     double least_m) {
    const fw_mask_layer *l = &r->table->layer[layer];
    if (!kind->built_in && !(least_m > 0)) return;
    for (int i = 0; i < r->table->nrule; i++) { /* it stands there as a row, with its own reason */
        const fw_mask_rule *rule = &r->table->rule[i];
        if (rule->kind == kind && rule->layer == layer && rule->severity == FW_ERROR) return;
    }
    r->rule[r->nrule++] = (fw_mask_rule){.kind = kind,
                                         .layer = layer,
                                         .other = -1,
                                         .least = least_m,
                                         .most = HUGE_VAL,
                                         .of = kind->usual_of,
                                         .source = l->rule_source ? l->rule_source : "layer table",
                                         .severity = FW_ERROR,
                                         .place = l->place};
}

fw_status fw_mask_rules_list(fw_mask_rules *r) {
    const fw_mask_table *t = r->table;
    size_t most = (size_t)t->nrule + 3 * (size_t)t->nlayer;
    FW_NEED(r->rule = fw_arena_array(r->arena, fw_mask_rule, most));
    for (int k = 0; k < t->nlayer; k++) {
        add_rule(r, &fw_mask_kind_overlap, k, 0);
        add_rule(r, &fw_mask_kind_width, k, t->layer[k].min_width_m);
        add_rule(r, &fw_mask_kind_space, k, t->layer[k].min_space_m);
    }
    for (int i = 0; i < t->nrule; i++)
        r->rule[r->nrule++] = t->rule[i];
    return FW_OK;
}

static void set_limits(fw_mask_rules *r) {
    for (int i = 0; i < r->nrule; i++) {
        const fw_mask_rule *rule = &r->rule[i];
        double *limit = r->search[rule->layer].limit_m;
        for (int k = FW_RULE_WIDTH; k <= FW_RULE_SPACE; k++)
            if (rule->kind->chords & 1u << k) limit[k] = fmax(limit[k], rule->least);
    }
}

/* ---- pieces inside each other: no edges meet then ---- */
static bool box_inside(fw_geometry_box in, fw_geometry_box out) {
    return in.x0 >= out.x0 && in.x1 <= out.x1 && in.y0 >= out.y0 && in.y1 <= out.y1;
}

static void look_at_nested(fw_mask_rule_search *in, const fw_mask_rule_range *r,
                           const fw_mask_rule_range *out) {
    if (!box_inside(r->box, out->box)) return;
    const fw_mask_rule_edge *e = &in->edge[r->first];
    fw_geometry_vec2 at = fw_geometry_segment_point(&e->s, 0.5);
    if (fw_geometry_contour_contains(&in->shape[out->shape].contour, at))
        fw_mask_rule_report(in, (fw_mask_rule_finding){.kind = FW_RULE_OVERLAP,
                                                       .shape = {r->shape, out->shape},
                                                       .segment = {e->segment, 0},
                                                       .at = {at, at}});
}

static void look_at_nesting(fw_mask_rule_search *in) {
    for (int i = 0; i < in->nrange; i++)
        for (int j = i + 1; j < in->nrange && in->range[j].box.x0 <= in->range[i].box.x1; j++) {
            look_at_nested(in, &in->range[i], &in->range[j]);
            look_at_nested(in, &in->range[j], &in->range[i]);
        }
}

static double perimeter_of(const fw_mask_rule_edge *e, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += fw_geometry_segment_length(&e[i].s);
    return sum;
}

static fw_status look_at_layer(fw_mask_rules *r, int k, fw_mask_measure *m) {
    fw_mask_rule_search *in = &r->search[k];
    m->width_m = m->space_m = HUGE_VAL;
    FW_TRY(fw_mask_rule_edges(in, r->nshape, r->tolerance_m));
    m->perimeter_m = perimeter_of(in->edge, in->nedge);
    fw_mask_rule_search_run(in);
    look_at_nesting(in);
    if (m->width_m > FW_MASK_LOOK_M) m->width_m = HUGE_VAL;
    if (m->space_m > FW_MASK_LOOK_M) m->space_m = HUGE_VAL;
    return in->no_memory ? FW_NOMEM : FW_OK;
}

fw_status fw_mask_rules_start(fw_mask_rules *r, fw_mask_measure *measure) {
    int n = r->table->nlayer;
    FW_TRY(fw_mask_rules_list(r));
    FW_NEED(r->search = fw_arena_array(r->arena, fw_mask_rule_search, (size_t)n));
    for (int k = 0; k < n; k++)
        r->search[k] = (fw_mask_rule_search){.arena = r->arena,
                                             .index = k,
                                             .shape = r->shape,
                                             .measure = &measure[k],
                                             .most = FW_MASK_FOUND_MOST};
    set_limits(r);
    for (int k = 0; k < n; k++)
        FW_TRY(look_at_layer(r, k, &measure[k]));
    return FW_OK;
}

fw_status fw_mask_rules_check(fw_mask_rules *r, bool polygons) {
    for (int i = 0; i < r->nrule; i++)
        if ((r->rule[i].of == FW_OF_POLYGON) == polygons)
            FW_TRY(r->rule[i].kind->check(r, &r->rule[i]));
    return r->no_memory ? FW_NOMEM : FW_OK;
}

/* ---- findings as messages ----
   The worst few of each rule, with their number. */

enum { MOST_TOLD = 4 }; /* of one rule */

/* < 1: the smaller the worse */
static double badness(const fw_mask_finding *f) {
    if (f->value > f->needed) return f->needed / f->value; /* a density that is too high */
    return f->needed > 0 ? f->value / f->needed : 0;
}

static int by_badness(const void *left, const void *right) {
    const fw_mask_finding *p = *(const fw_mask_finding *const *)left,
                          *q = *(const fw_mask_finding *const *)right;
    int order = fw_order_doubles(badness(p), badness(q));
    return order ? order : (p > q) - (p < q); /* of one array */
}

static const char *piece(fw_arena *arena, const char *label, int edge) {
    return edge < 0 ? label : fw_arena_printf(arena, "%s (edge %d)", label, edge);
}

static const char *pieces(fw_arena *arena, const fw_mask_finding *f) {
    if (!f->label[0]) return "the layer";
    const char *p = piece(arena, f->label[0], f->edge[0]);
    if (!f->label[1]) return p;
    const char *q = piece(arena, f->label[1], f->edge[1]);
    return p && q ? fw_arena_printf(arena, "%s and %s", p, q) : NULL;
}

/* two edges that follow each other, or the arc between them, may be a sharp corner, which no room helps */
static bool may_be_a_corner(const fw_mask_finding *f) {
    bool of_one = f->label[0] && f->label[1] && strcmp(f->label[0], f->label[1]) == 0;
    return f->rule->kind->chords != 0 && of_one && abs(f->edge[0] - f->edge[1]) <= 1;
}

/* of a width or a space that the bias has made less, what has to be drawn for it */
static const char *drawn_for(fw_arena *arena, const fw_mask_finding *f, double bias_m) {
    const fw_mask_rule_kind_row *kind = f->rule->kind;
    const double less = (kind->chords & FW_CHORD_SPACE ? 2 : -2) * bias_m;
    char needed[32], by[32];
    if (!(less > 1e-9) || (kind->chords != FW_CHORD_SPACE && kind->chords != FW_CHORD_WIDTH))
        return kind->advice;
    fw_number_text(needed, sizeof needed, 1e6 * (f->needed + less), 6);
    fw_number_text(by, sizeof by, 1e6 * less, 4);
    return fw_arena_printf(arena, "%s (the mask has %s um less than is drawn: %s um drawn will do)",
                           kind->advice, by, needed);
}

static const char *advice_of(fw_arena *arena, const fw_mask_finding *f, double bias_m) {
    const fw_mask_rule_kind_row *kind = f->rule->kind;
    if (!may_be_a_corner(f)) return drawn_for(arena, f, bias_m);
    return fw_arena_printf(arena, "%s; round the corner if it is one of less than 90 degrees",
                           kind->advice);
}

/* no width or space of nothing is told of outlines that meet, but that they do */
static bool meet(const fw_mask_finding *f) {
    return f->rule->kind->chords != 0 && f->value == 0 && !may_be_a_corner(f);
}

static const char *sentence(fw_arena *arena, const fw_layout *layout, const fw_mask_layer *layer,
                            const fw_mask_finding *f, double bias_m) {
    const fw_mask_rule *rule = f->rule;
    const fw_mask_rule_kind_row *kind = rule->kind;
    const char *who = pieces(arena, f), *unit = unit_name(kind);
    char at[80], value[32], needed[32], limit[32];
    fw_mask_place_text(at, sizeof at, vec_scale(0.5, vec_add(f->at[0], f->at[1])));
    fw_number_text(value, sizeof value, fw_mask_rule_row_shown(kind, f->value), 6);
    fw_number_text(needed, sizeof needed, fw_mask_rule_row_shown(kind, f->needed), 6);
    if (strcmp(value, needed) == 0) /* less than one part in a million: all digits */
        fw_number_text(value, sizeof value, fw_mask_rule_row_shown(kind, f->value), 12);
    fw_number_text(limit, sizeof limit, fw_mask_rule_row_shown(kind, f->limit), 6);
    if (!who) return NULL;
    /* on a layer of a cell's own nothing is of a hinge */
    const bool own = layer->roles == 1u << FW_ROLE_CELL || !layout;
    const char *cause =
        own ? "" : fw_mask_cause(arena, layout, vec_scale(0.5, vec_add(f->at[0], f->at[1])));
    const char *advice = advice_of(arena, f, bias_m);
    if (!cause || !advice) return NULL;
    if (meet(f))
        return fw_arena_printf(
            arena, "%s: outlines cross or touch at %s, where layer %s needs %s of %s %s (%s); %s%s",
            who, at, layer->name, f->what, needed, unit, rule->source,
            "move the two apart, or join them", cause);
    if (kind->built_in)
        return fw_arena_printf(arena, "%s meet at %s on layer %s without a shared joint; %s%s", who,
                               at, layer->name, kind->advice, cause);
    return fw_arena_printf(
        arena, "%s: %s of %s %s at %s; layer %s %s %s %s (rule %s %s%s%s; %s); %s", who, f->what,
        value, unit, at, layer->name, f->value > f->needed ? "takes at most" : "needs", needed,
        unit, limit, unit, rule->formula ? ", " : "", rule->formula ? rule->formula : "",
        rule->source, advice);
}

/* where two outlines meet at a hinge, that hinge: whatever rules that breaks, it is one mistake */
static const fw_layout_hinge_layout *meets_at(const fw_mask_rules *r, const fw_mask_finding *f) {
    if (!r->layout || !(meet(f) || f->rule->kind->built_in)) return NULL;
    return fw_mask_hinge_at(r->layout, vec_scale(0.5, vec_add(f->at[0], f->at[1])));
}

/* a cell of the description stands at a line of it, and so does the flexure of a hinge at which outlines meet */
static fw_place place_of(const fw_mask_rules *r, const fw_mask_finding *f) {
    for (int i = 0; r->layout && i < r->layout->ncell; i++)
        for (int side = 0; side < 2; side++)
            if (r->layout->cell[i].label == f->label[side])
                return r->layout->cell[i].of->layers_place;
    const fw_layout_hinge_layout *hinge = meets_at(r, f);
    return hinge ? hinge->place : (fw_place){0};
}

/* of the first that are told: is one of them at the hinge of f? */
static bool named_before(const fw_mask_rules *r, const fw_mask_finding *const *told, int ntold,
                         const fw_mask_finding *f) {
    const fw_layout_hinge_layout *hinge = meets_at(r, f);
    for (int i = 0; hinge && i < ntold; i++)
        if (meets_at(r, told[i]) == hinge) return true;
    return false;
}

static fw_status tell(fw_mask_rules *r, const fw_mask_finding *f, fw_diags *diags) {
    const int layer = f->rule->layer;
    const char *text =
        sentence(r->arena, r->layout, &r->table->layer[layer], f, r->bias_m ? r->bias_m[layer] : 0);
    FW_NEED(text);
    fw_place place = place_of(r, f);
    if (f->rule->severity == FW_ERROR)
        fw_diag_error(diags, f->rule->kind->number, place, "%s", text);
    else
        fw_diag_warning(diags, f->rule->kind->number, place, "%s", text);
    return FW_OK;
}

static void tell_rest(const fw_mask_rules *r, const fw_mask_rule *rule, int more, fw_diags *diags) {
    fw_place place = {0};
    const char *layer = r->table->layer[rule->layer].name, *flow = r->table->flow;
    fw_diag_note(diags, 159, place,
                 "%d more place(s) on layer %s break the rule \"%s\"; all of them are in "
                 "%s.violations.lyrdb, .gds and .json, or in the mask's certificate where the rule "
                 "is a warning",
                 more, layer, rule->kind->name, flow);
}

/* where places are too many to be looked for, whatever the table says of their rules */
static void tell_crowded(const fw_mask_rules *r, fw_diags *diags, int *nbroken) {
    for (int k = 0; k < r->table->nlayer; k++) {
        if (!r->search[k].crowded) continue;
        if (r->search[k].measure) r->search[k].measure->unfinished = true;
        fw_place place = {0};
        for (int i = 0; i < r->nfinding && !place.line; i++)
            if (r->finding[i].rule->layer == k) place = place_of(r, &r->finding[i]);
        fw_diag_error(diags, 592, place,
                      "on layer %s edges are nearer to each other than its rules ask for at more "
                      "than %d pairs, and what is beyond these was not looked at; draw it with "
                      "fewer and longer edges, or leave it out",
                      r->table->layer[k].name, FW_MASK_FOUND_MOST);
        ++*nbroken;
    }
}

fw_status fw_mask_rules_tell(fw_mask_rules *r, fw_diags *diags, int *nbroken) {
    *nbroken = 0;
    tell_crowded(r, diags, nbroken);
    const fw_mask_finding **list =
        fw_arena_alloc(r->arena, 2 * (size_t)r->nfinding, sizeof(const fw_mask_finding *));
    FW_NEED(list);
    const fw_mask_finding **told = list + r->nfinding; /* of all rules */
    int ntold = 0;
    for (int i = 0; i < r->nrule; i++) {
        const fw_mask_rule *rule = &r->rule[i];
        int n = 0;
        for (int k = 0; k < r->nfinding; k++)
            if (r->finding[k].rule == rule) list[n++] = &r->finding[k];
        if (n) qsort(list, (size_t)n, sizeof *list, by_badness);
        if (rule->severity == FW_ERROR) *nbroken += n;
        const int before = ntold;
        for (int k = 0; k < n && ntold - before < MOST_TOLD; k++) {
            if (named_before(r, told, ntold, list[k])) continue;
            FW_TRY(tell(r, list[k], diags));
            told[ntold++] = list[k];
        }
        if (n > ntold - before) tell_rest(r, rule, n - (ntold - before), diags);
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* A mask to look at: what is drawn, and a rectangle for each finding on a layer that the table does
   not use, with a data type for each kind of rule. A marker is the place itself where that is a
   window, an island or a hole; else the shortest chord, edge or corner with its own length, at
   least 1 um, on all sides. */

enum { HIGHEST = 60 };
static const double LEAST_M = 1e-6;

int fw_mask_marker_layer(const fw_mask_table *table) {
    for (int layer = HIGHEST; layer > 0; layer--) {
        bool used = false;
        for (int k = 0; k < table->nlayer; k++)
            used = used || table->layer[k].layer == layer;
        if (!used) return layer;
    }
    return HIGHEST;
}

/* what a marker covers: the chord, edge, corner or window, and at least 1 um around it */
static fw_geometry_box marker_of(const fw_mask_finding *f) {
    const fw_mask_rule_kind_row *kind = f->rule->kind;
    if (kind->unit == FW_UNIT_SHARE || kind->unit == FW_UNIT_AREA) return f->box;
    double more = fmax(LEAST_M, vec_distance(f->at[0], f->at[1]));
    fw_geometry_box b = fw_mask_box_around(f->at[0], f->at[1]);
    return (fw_geometry_box){b.x0 - more, b.y0 - more, b.x1 + more, b.y1 + more};
}

/* what lies beyond 2^30 nm is refused, but there can be findings all the same */
static int32_t on_grid(double x_dbu) {
    return (int32_t)fmax(-1073741823.0, fmin(1073741823.0, x_dbu));
}

static fw_status mark(fw_arena *arena, const fw_mask_finding *f, int layer, fw_mask_shape *out) {
    fw_geometry_box b = marker_of(f);
    int32_t x0 = on_grid(floor(b.x0 / FW_GEOMETRY_GRID_M)),
            x1 = on_grid(ceil(b.x1 / FW_GEOMETRY_GRID_M));
    int32_t y0 = on_grid(floor(b.y0 / FW_GEOMETRY_GRID_M)),
            y1 = on_grid(ceil(b.y1 / FW_GEOMETRY_GRID_M));
    fw_layout_piece *piece = fw_arena_one(arena, fw_layout_piece);
    FW_NEED(piece);
    *piece = (fw_layout_piece){
        .role = FW_ROLE_MARK, .body = FW_NONE, .joint = FW_NONE, .label = f->what};
    fw_geometry_point *v = fw_arena_array(arena, fw_geometry_point, 4);
    FW_NEED(v);
    v[0] = (fw_geometry_point){x0, y0}, v[1] = (fw_geometry_point){x1, y0};
    v[2] = (fw_geometry_point){x1, y1}, v[3] = (fw_geometry_point){x0, y1};
    *out = (fw_mask_shape){.layer = layer, .piece = piece, .polygon = {v, 4}};
    fw_geometry_box grid = {x0 * FW_GEOMETRY_GRID_M, y0 * FW_GEOMETRY_GRID_M,
                            x1 * FW_GEOMETRY_GRID_M, y1 * FW_GEOMETRY_GRID_M};
    return fw_geometry_contour_rectangle(arena, grid, &out->contour);
}

/* the table with a marker layer for each kind that was found; by[kind's marker]: its index */
static fw_status marked_table(fw_arena *arena, const fw_mask *mask, int by[64],
                              fw_mask_table *table) {
    size_t nkind = 0;
    while (fw_mask_rule_kind_at(nkind))
        nkind++;
    *table = *mask->table;
    table->layer = fw_arena_array(arena, fw_mask_layer, (size_t)table->nlayer + nkind);
    FW_NEED(table->layer);
    memcpy(table->layer, mask->table->layer, (size_t)table->nlayer * sizeof *table->layer);
    int number = fw_mask_marker_layer(mask->table);
    for (size_t i = 0; i < nkind; i++) {
        const fw_mask_rule_kind_row *kind = fw_mask_rule_kind_at(i);
        by[kind->marker] = -1;
        for (int k = 0; k < mask->nfinding && by[kind->marker] < 0; k++)
            if (mask->finding[k].rule->kind == kind) by[kind->marker] = table->nlayer;
        if (by[kind->marker] < 0) continue;
        const char *name = fw_arena_printf(arena, "BAD_%s", kind->name);
        FW_NEED(name);
        table->layer[table->nlayer++] =
            (fw_mask_layer){.layer = number,
                            .datatype = kind->marker,
                            .id = name,
                            .name = name,
                            .purpose = "places where this rule is broken, not on the plate",
                            .tone = "data dark",
                            .colour = "#d01020"};
    }
    return FW_OK;
}

fw_status fw_mask_marked(fw_arena *arena, const fw_mask *mask, const fw_mask **marked) {
    fw_mask_table *table = fw_arena_one(arena, fw_mask_table);
    fw_mask *m = fw_arena_one(arena, fw_mask);
    int by[64];
    FW_NEED(table);
    FW_NEED(m);
    FW_TRY(marked_table(arena, mask, by, table));
    *m = *mask;
    m->table = table;
    m->measure = NULL; /* of what is drawn only */
    m->nshape = 0;
    m->shape = fw_arena_array(arena, fw_mask_shape, (size_t)(mask->nshape + mask->nfinding));
    FW_NEED(m->shape);
    for (int i = 0; i < mask->nshape; i++) /* one that could not be flattened has no polygon */
        if (mask->shape[i].polygon.count > 0) m->shape[m->nshape++] = mask->shape[i];
    for (int i = 0; i < mask->nfinding; i++) {
        const fw_mask_finding *f = &mask->finding[i];
        fw_mask_shape *shape = &m->shape[m->nshape++];
        FW_TRY(mark(arena, f, by[f->rule->kind->marker], shape));
        m->box = fw_box_join(m->box, fw_geometry_contour_box(&shape->contour));
    }
    *marked = m;
    return FW_OK;
}

/* KLayout's report database, for its marker browser: a category for each rule that is broken, and
   in it an item for each place, with the shortest chord as an edge, the whole place as a box (um),
   and what it is. Texts are in apostrophes with \ before ' and \. Format: as KLayout 0.28 writes it
   (class ReportDatabase of its reference); accepted by ReportDatabase#load, which
   tests/cli/test_violations.py does. */

static void xml(fw_text *out, const char *s) {
    for (; *s; s++) {
        const char *instead = *s == '&' ? "&amp;" : *s == '<' ? "&lt;" : *s == '>' ? "&gt;" : NULL;
        if (instead)
            fw_text_add(out, instead);
        else
            fw_text_bytes(out, s, 1);
    }
}

static void text_value(fw_text *out, const char *name, const char *s) {
    fw_text_add(out, "    <value>text: '");
    xml(out, name);
    for (const char *at = s; *at; at++) {
        if (*at == '\'' || *at == '\\') fw_text_add(out, "\\");
        char one[2] = {*at, '\0'};
        xml(out, one);
    }
    fw_text_add(out, "'</value>\n");
}

static void numbers(fw_text *out, fw_geometry_vec2 p, fw_geometry_vec2 q) {
    fw_text_add(out, "(");
    fw_text_number(out, p.x * 1e6, 12);
    fw_text_add(out, ",");
    fw_text_number(out, p.y * 1e6, 12);
    fw_text_add(out, ";");
    fw_text_number(out, q.x * 1e6, 12);
    fw_text_add(out, ",");
    fw_text_number(out, q.y * 1e6, 12);
    fw_text_add(out, ")");
}

/* of a rule: "width 1/0", "enclosure 2/0 1/0 warning"; no two rules have the same */
static void category_name(fw_text *out, const fw_mask *mask, const fw_mask_rule *rule) {
    const fw_mask_layer *l = &mask->table->layer[rule->layer];
    fw_text_printf(out, "%s %d/%d", rule->kind->name, l->layer, l->datatype);
    if (rule->other >= 0) {
        l = &mask->table->layer[rule->other];
        fw_text_printf(out, " %d/%d", l->layer, l->datatype);
    }
    if (rule->of == FW_OF_POLYGON) fw_text_add(out, " polygon");
    if (rule->of == FW_OF_ISLAND) fw_text_add(out, " island");
    if (rule->of == FW_OF_HOLE) fw_text_add(out, " hole");
    if (rule->kind->unit == FW_UNIT_SHARE) {
        fw_text_add(out, " in ");
        fw_text_number(out, rule->window_m * 1e6, 6);
        fw_text_add(out, " um");
    }
    if (rule->severity != FW_ERROR) fw_text_add(out, " warning");
}

static void category(fw_text *out, const fw_mask *mask, const fw_mask_finding *f) {
    fw_text_add(out, "  <category>\n   <name>");
    category_name(out, mask, f->rule);
    fw_text_add(out, "</name>\n   <description>layer ");
    xml(out, mask->table->layer[f->rule->layer].name);
    fw_text_add(out, ": ");
    xml(out, f->rule->kind->name);
    fw_text_add(out, ", limit ");
    fw_text_number(out, fw_mask_rule_row_shown(f->rule->kind, f->limit), 6);
    fw_text_printf(out, " %s; ", unit_name(f->rule->kind));
    xml(out, f->rule->source);
    fw_text_add(out, "</description>\n   <categories>\n   </categories>\n  </category>\n");
}

static void item(fw_text *out, const fw_mask *mask, const fw_mask_finding *f) {
    fw_text_add(out, "  <item>\n   <tags/>\n   <category>'");
    category_name(out, mask, f->rule);
    fw_text_printf(out,
                   "'</category>\n   <cell>%s</cell>\n   <visited>false</visited>\n"
                   "   <multiplicity>1</multiplicity>\n   <image/>\n   <values>\n",
                   mask->cell);
    fw_geometry_box b = marker_of(f);
    fw_geometry_vec2 low = {b.x0, b.y0}, high = {b.x1, b.y1};
    bool chord = !vec_same(f->at[0], f->at[1]) && f->rule->kind->unit == FW_UNIT_LENGTH;
    fw_text_add(out, chord ? "    <value>edge: " : "    <value>box: ");
    numbers(out, chord ? f->at[0] : low, chord ? f->at[1] : high);
    fw_text_add(out, "</value>\n");
    if (chord) {
        fw_text_add(out, "    <value>box: ");
        numbers(out, (fw_geometry_vec2){f->box.x0, f->box.y0},
                (fw_geometry_vec2){f->box.x1, f->box.y1});
        fw_text_add(out, "</value>\n");
    }
    char value[32];
    fw_number_text(value, sizeof value, fw_mask_rule_row_shown(f->rule->kind, f->value), 9);
    text_value(out, meet(f) ? "outlines cross or touch" : f->what, "");
    fw_text_printf(out, "    <value>float: %s</value>\n", value);
    for (int i = 0; i < 2 && f->label[i]; i++)
        text_value(out, "piece: ", f->label[i]);
    fw_text_add(out, "   </values>\n  </item>\n");
}

fw_status fw_mask_write_lyrdb(const fw_mask *mask, fw_text *out) {
    fw_text_add(out, "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<report-database>\n "
                     "<description>Design rules of flow ");
    xml(out, mask->flow);
    fw_text_add(out, ", device ");
    xml(out, mask->device);
    fw_text_printf(out,
                   "</description>\n <original-file>%s.violations.gds</original-file>\n "
                   "<generator>flexwright " FW_VERSION "</generator>\n "
                   "<top-cell>%s</top-cell>\n <tags>\n </tags>\n <categories>\n",
                   mask->flow, mask->cell);
    for (int i = 0; i < mask->nfinding; i++) /* those of one rule follow each other */
        if (i == 0 || mask->finding[i].rule != mask->finding[i - 1].rule)
            category(out, mask, &mask->finding[i]);
    fw_text_printf(out,
                   " </categories>\n <cells>\n  <cell>\n   <name>%s</name>\n   <variant/>\n"
                   "   <references>\n   </references>\n  </cell>\n </cells>\n <items>\n",
                   mask->cell);
    for (int i = 0; i < mask->nfinding; i++)
        item(out, mask, &mask->finding[i]);
    fw_text_add(out, " </items>\n</report-database>\n");
    return fw_text_end(out);
}
