/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Regions of the wafer, and the stack of layers over each of them, not to scale. */
#include "base/text.h"
#include "process/films.h"
#include "process/pack.h"
#include "process/process_law.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- regions of the wafer: what plates print parts it into ----
   The device's plate parts structure from field; each <plate> besides names what is inside of what it prints, and what is
   outside ("cavity", "bond"). A column of the layer stack is one of the combinations: bit 0 of its code says field, bit p
   inside of plate p. Test: test_regions.c. */

int fw_process_flow_columns(const fw_process_flow *flow) {
    return flow->ncolumn ? flow->ncolumn : 2;
}

static unsigned code_of(const fw_process_flow *flow, int column) {
    return flow->ncolumn ? flow->column_code[column] : (unsigned)column;
}

bool fw_process_where_side(const fw_process_flow *flow, const char *where, fw_process_side *side) {
    *side = (fw_process_side){0, strcmp(where, "field") == 0};
    if (strcmp(where, "structure") == 0 || side->set) return true;
    for (int p = 0; p < flow->nplate; p++) {
        *side = (fw_process_side){p + 1, strcmp(where, flow->plate[p].inside) == 0};
        if (side->set || strcmp(where, flow->plate[p].outside) == 0) return true;
    }
    return false;
}

bool fw_process_side_holds(const fw_process_flow *flow, fw_process_side side, int column) {
    return (code_of(flow, column) >> side.plate & 1u) == (side.set ? 1u : 0u);
}

bool fw_process_where_holds(const fw_process_flow *flow, const char *where, int column) {
    fw_process_side side;
    return strcmp(where, "all") == 0 ||
           (fw_process_where_side(flow, where, &side) && fw_process_side_holds(flow, side, column));
}

bool fw_process_where_is_of_device(const fw_process_flow *flow, const char *where) {
    fw_process_side side;
    return !fw_process_where_side(flow, where, &side) || side.plate == 0;
}

/* do two columns lie beside each other: does one plate alone part them? */
bool fw_process_columns_meet(const fw_process_flow *flow, int a, int b) {
    unsigned other = code_of(flow, a) ^ code_of(flow, b);
    return other && !(other & (other - 1u));
}

bool fw_process_columns_edge(const fw_process_flow *flow, const bool in[], int plate) {
    int n = fw_process_flow_columns(flow);
    for (int a = 0; a < n; a++)
        for (int b = 0; in[a] && b < n; b++)
            if ((code_of(flow, a) ^ code_of(flow, b)) == 1u << plate) return true;
    return false;
}

const char *fw_process_column_name(const fw_process_flow *flow, int column, char name[FW_LABEL]) {
    unsigned code = code_of(flow, column);
    int n = snprintf(name, FW_LABEL, "%s", code & 1u ? "field" : "structure");
    for (int p = 0; p < flow->nplate && n < FW_LABEL; p++)
        n += snprintf(name + n, (size_t)(FW_LABEL - n), ", %s",
                      code >> (p + 1) & 1u ? flow->plate[p].inside : flow->plate[p].outside);
    return name;
}

/* words of `within` that a code satisfies */
static bool lies_within(const fw_process_flow *flow, const char *within, unsigned code) {
    char name[64];
    for (fw_word word; fw_word_next(&within, " ", &word);) {
        fw_process_side side;
        snprintf(name, sizeof name, "%.*s", (int)word.length, word.at);
        if (word.length < sizeof name && fw_process_where_side(flow, name, &side) &&
            (code >> side.plate & 1u) != (side.set ? 1u : 0u))
            return false;
    }
    return true;
}

static bool is_word(const fw_process_flow *flow, const char *word) {
    fw_process_side side;
    return strcmp(word, "all") == 0 || fw_process_where_side(flow, word, &side);
}

void fw_process_read_plates(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "plate")) continue;
        fw_process_plate p = {.id = fw_process_pack_text(e, "id"),
                              .inside = fw_process_pack_text(e, "inside"),
                              .outside = fw_process_pack_text(e, "outside"),
                              .within = fw_process_pack_text(e, "within"),
                              .shrink = fw_process_pack_quantity(pack, e, "shrink"),
                              .place = e->element->place};
        if (is_word(f, p.inside) || is_word(f, p.outside) || strcmp(p.inside, p.outside) == 0)
            fw_diag_error(pack->diags, 413, p.place,
                          "plate \"%s\" calls its parts \"%s\" and \"%s\", but these words already "
                          "name parts of the wafer; choose others",
                          p.id, p.inside, p.outside);
        if (f->nplate == FW_PROCESS_PLATES)
            fw_diag_error(pack->diags, 413, p.place,
                          "a flow prints at most %d plates besides the device's",
                          FW_PROCESS_PLATES);
        else
            f->plate[f->nplate++] = p;
    }
    for (unsigned code = 0; code < 2u << f->nplate; code++) {
        bool there = true;
        for (int p = 0; p < f->nplate; p++)
            if (code >> (p + 1) & 1u) there = there && lies_within(f, f->plate[p].within, code);
        if (there) f->column_code[f->ncolumn++] = code;
    }
}

static void check_word(fw_process_pack *pack, const char *where, fw_place place) {
    const fw_process_flow *f = pack->flow;
    if (is_word(f, where)) return;
    fw_text known = fw_text_new(pack->arena);
    for (int p = 0; p < f->nplate; p++)
        fw_text_printf(&known, " %s %s", f->plate[p].inside, f->plate[p].outside);
    fw_diag_error(pack->diags, 413, place,
                  "where=\"%s\" is no part of the wafer; there are: all structure field%s", where,
                  fw_text_end(&known) == FW_OK ? known.data : "");
}

void fw_process_check_regions(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++) {
        for (int k = 0; k < f->step[i].nchange; k++)
            check_word(pack, f->step[i].change[k].where, f->step[i].change[k].place);
        for (int k = 0; k < f->step[i].nrequired; k++)
            if (f->step[i].required[k].material)
                check_word(pack, f->step[i].required[k].where, f->step[i].required[k].place);
    }
    for (int i = 0; i < f->nfinished; i++)
        check_word(pack, f->finished[i].where, f->finished[i].place);
}

const fw_quantity *fw_process_flow_hollow(const fw_process_flow *flow, const char *plate,
                                          const fw_process_step **at) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            fw_process_side side;
            if (!c->isotropic || !fw_process_where_side(flow, c->where, &side) || !side.plate ||
                !side.set || strcmp(flow->plate[side.plate - 1].id, plate) != 0)
                continue;
            if (at) *at = &flow->step[i];
            return c->thickness;
        }
    return NULL;
}

/* thickness of a layer that comes from a step before the last one */
static const fw_quantity *thickness_of(const fw_process_flow *flow, const char *material) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            bool comes = strcmp(c->kind, "add") == 0 || strcmp(c->kind, "convert") == 0;
            if (comes && strcmp(c->material, material) == 0) return c->thickness;
        }
    return NULL;
}

/* the first layer of the front: the device's own, of a wafer that is etched through */
static bool stands_on_nothing(const fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (strcmp(c->kind, "add") == 0 && !c->back)
                return flow->material && strcmp(c->material, flow->material) == 0;
        }
    return false;
}

/* what carries the wafer is taken away from the back, inside of a plate that is printed there */
static bool opened_from_back(const fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            fw_process_side side;
            if (c->back && c->anisotropy && strcmp(c->kind, "remove") == 0 &&
                fw_process_where_side(flow, c->where, &side) && side.plate && side.set)
                return true;
        }
    return false;
}

const fw_quantity *fw_process_flow_gap(const fw_process_flow *flow, bool *open, bool *hollow,
                                       const char **material) {
    *open = false, *hollow = false, *material = NULL;
    for (int p = 0; p < flow->nplate; p++) {
        const fw_quantity *depth = fw_process_flow_hollow(flow, flow->plate[p].id, NULL);
        *hollow = depth != NULL;
        if (depth) return depth;
    }
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (strcmp(c->kind, "remove") != 0 || !c->reach) continue;
            *material = c->material;
            return c->thickness ? c->thickness : thickness_of(flow, c->material);
        }
    *open = stands_on_nothing(flow) || opened_from_back(flow);
    return NULL;
}

/* u = d (1 + overrun): what an isotropic etch of the depth d takes from every edge. In: the pack as it stands, a
   laboratory's values in it. Test: test_regions.c. */
fw_status fw_process_lint_shrink(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int p = 0; p < f->nplate; p++) {
        const fw_process_step *step = NULL;
        const fw_quantity *depth = fw_process_flow_hollow(f, f->plate[p].id, &step),
                          *shrink = f->plate[p].shrink;
        if ((!depth && !shrink) || (depth && depth->unknown) || (shrink && shrink->unknown))
            continue;
        double takes = depth ? depth->value * (1.0 + step->overrun) : 0.0,
               drawn = shrink ? shrink->value : 0.0;
        char a[32], b[32];
        if (fabs(takes - drawn) <= 1e-9 * fmax(takes, drawn)) continue;
        fw_diag_error(
            pack->diags, 420, f->plate[p].place,
            "plate \"%s\" is drawn smaller by %s um (shrink), but %s takes %s um from every edge; "
            "they must be equal: give it shrink=\"...\" of a quantity that is",
            f->plate[p].id, fw_number_text(b, sizeof b, drawn * 1e6, 4),
            step ? fw_arena_printf(pack->arena, "step %s", step->id) : "no isotropic etch",
            fw_number_text(a, sizeof a, takes * 1e6, 4));
    }
    return FW_OK;
}

bool fw_process_change_is_background(const fw_process_flow *flow, const fw_process_change *add,
                                     double *depth_m) {
    const double thick =
        add->thickness && !add->thickness->unknown ? add->thickness->value : (double)NAN;
    *depth_m = 0.0;
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (strcmp(c->kind, "remove") != 0 || strcmp(c->material, add->material) != 0) continue;
            double t = c->thickness && !c->thickness->unknown ? c->thickness->value : (double)NAN;
            const bool shallow = c->isotropic && t < 0.5 * thick,
                       through = c->back && c->thickness == add->thickness;
            if (shallow) *depth_m = fmax(*depth_m, t);
            if (!shallow && !through && (c->thickness || strcmp(c->where, "all") != 0))
                return false;
        }
    return strcmp(add->where, "all") == 0;
}

/* ---- the stack ---- */

/* a tenfold thickness is drawn 2.5 units higher, so that 1 um and 500 um are both seen */
static double drawn_height(const fw_quantity *thickness) {
    if (!thickness || thickness->unknown || !(thickness->value > 0.0)) return 3.0;
    return 1.5 + 2.5 * log10(1.0 + thickness->value / 0.1e-6);
}

static double top_of(const fw_process_stack *s, int column) {
    double top = 0.0;
    for (int i = 0; i < s->n[column]; i++)
        top = fmax(top, s->cell[column][i].bottom + s->cell[column][i].height);
    return top;
}

static double bottom_of(const fw_process_stack *s) {
    double bottom = 0.0;
    for (int column = 0; column < s->columns; column++)
        for (int i = 0; i < s->n[column]; i++)
            bottom = fmin(bottom, s->cell[column][i].bottom);
    return bottom;
}

static void insert(fw_process_stack *s, int column, int at, fw_process_cell cell) {
    fw_process_cell *list = s->cell[column];
    memmove(list + at + 1, list + at, (size_t)(s->n[column] - at) * sizeof *list);
    list[at] = cell;
    s->n[column]++;
}

static bool add(fw_process_stack *s, int column, const fw_process_change *c, double below,
                double ground) {
    double height = drawn_height(c->thickness);
    double thickness = c->thickness && !c->thickness->unknown ? c->thickness->value : (double)NAN;
    double bottom = c->back ? below - height : c->spans ? ground : top_of(s, column);
    insert(s, column, c->back ? 0 : s->n[column],
           (fw_process_cell){c->material, thickness, bottom, height, false, c->back});
    return true;
}

bool fw_process_step_from_back(const fw_process_step *step) {
    for (int k = 0; k < step->nchange; k++)
        if (step->change[k].back && strcmp(step->change[k].kind, "add") != 0) return true;
    return false;
}

bool fw_process_step_meets(const fw_process_step *step, bool back) {
    const bool from_back = fw_process_step_from_back(step);
    return back ? from_back : !from_back || strcmp(step->op, "dry-etch") != 0;
}

bool fw_process_stack_works_on(const fw_process_stack *s, const fw_process_change *c,
                               const fw_process_cell *cell) {
    const char *on = strcmp(c->kind, "convert") == 0 ? c->from : c->material;
    if (strcmp(cell->material, on) != 0 || cell->back == c->back)
        return strcmp(cell->material, on) == 0;
    for (int column = 0; column < s->columns; column++)
        for (int i = 0; i < s->n[column]; i++)
            if (s->cell[column][i].back == c->back && strcmp(s->cell[column][i].material, on) == 0)
                return false;
    return true;
}

/* an isotropic etch that leaves most of a layer hollows it out (films.c); drawn is how much lower its top is then, or how
   much higher its bottom */
static bool hollow_out(fw_process_stack *s, int column, const fw_process_change *c) {
    int top = c->back && s->n[column] > 0 ? 0 : s->n[column] - 1;
    if (!c->isotropic || !c->thickness || c->thickness->unknown || top < 0) return false;
    fw_process_cell *cell = &s->cell[column][top];
    double depth = c->thickness->value;
    if (!(depth < 0.5 * cell->thickness_m) || strcmp(cell->material, c->material) != 0)
        return false;
    double lower = fmin(drawn_height(c->thickness), 0.6 * cell->height);
    cell->thickness_m -= depth;
    cell->height -= lower;
    if (c->back) cell->bottom += lower;
    return true;
}

/* which: per cell, does the change work on it? As the wafer is before it, since columns are done one after the other */
static bool take_away(fw_process_stack *s, int column, const fw_process_change *c,
                      const bool *which) {
    int kept = 0, before = s->n[column];
    if (hollow_out(s, column, c)) return true;
    for (int i = 0; i < before; i++)
        if (!which[i]) s->cell[column][kept++] = s->cell[column][i];
    s->n[column] = kept;
    return kept < before;
}

static bool expose(fw_process_stack *s, int column, const bool *which) {
    bool found = false;
    for (int i = 0; i < s->n[column]; i++)
        if (which[i]) s->cell[column][i].exposed = found = true;
    return found;
}

/* the outer part of the outermost cell of material `from` becomes `material` */
static bool convert(fw_process_stack *s, int column, const fw_process_change *c,
                    const bool *which) {
    int i = c->back ? 0 : s->n[column] - 1, step = c->back ? 1 : -1;
    while (i >= 0 && i < s->n[column] && !which[i])
        i += step;
    if (i < 0 || i == s->n[column]) return false;
    fw_process_cell *old = &s->cell[column][i];
    double height = fmin(drawn_height(c->thickness), 0.6 * old->height);
    double thickness = c->thickness && !c->thickness->unknown ? c->thickness->value : (double)NAN;
    double bottom = c->back ? old->bottom : old->bottom + old->height - height;
    old->height -= height;
    if (c->back) old->bottom += height;
    if (!isnan(thickness)) old->thickness_m -= thickness;
    insert(s, column, c->back ? i : i + 1,
           (fw_process_cell){c->material, thickness, bottom, height, false, c->back});
    return true;
}

/* which: (capacity x columns) */
static bool apply(const fw_process_flow *flow, fw_process_stack *s, const fw_process_change *c,
                  bool *which) {
    const size_t room = (size_t)s->capacity;
    bool found = false;
    for (int column = 0; column < s->columns; column++)
        for (int i = 0; i < s->n[column]; i++)
            which[(size_t)column * room + (size_t)i] =
                fw_process_stack_works_on(s, c, &s->cell[column][i]);
    double below = bottom_of(s);
    double ground = 0.0; /* the highest top: what spans lies on it */
    for (int column = 0; column < s->columns; column++)
        ground = fmax(ground, top_of(s, column));
    for (int column = 0; column < s->columns; column++) {
        const bool *on = which + (size_t)column * room;
        if (!fw_process_where_holds(flow, c->where, column)) continue;
        if (strcmp(c->kind, "add") == 0)
            found = add(s, column, c, below, ground) || found;
        else if (strcmp(c->kind, "remove") == 0)
            found = take_away(s, column, c, on) || found;
        else if (strcmp(c->kind, "pattern") == 0)
            found = expose(s, column, on) || found;
        else
            found = convert(s, column, c, on) || found;
    }
    return found;
}

/* the first `changes` changes of step `step`, and all of those before */
static fw_status stack_of(fw_arena *arena, const fw_process_flow *flow, int step, int changes,
                          fw_process_stack *stack, const fw_process_change **absent) {
    int most = 0;
    for (int i = 0; i < flow->nstep && i <= step; i++)
        most += flow->step[i].nchange;
    *stack = (fw_process_stack){.capacity = most + 1, .columns = fw_process_flow_columns(flow)};
    if (absent) *absent = NULL;
    bool *which = fw_arena_array(arena, bool, (size_t)stack->capacity *(size_t)stack->columns);
    FW_NEED(which);
    for (int column = 0; column < stack->columns; column++)
        FW_NEED(stack->cell[column] = fw_arena_array(arena, fw_process_cell, (size_t)most + 1));
    for (int i = 0; i < flow->nstep && i <= step; i++)
        for (int j = 0; j < flow->step[i].nchange && (i < step || j < changes); j++)
            if (!apply(flow, stack, &flow->step[i].change[j], which) && absent && !*absent)
                *absent = &flow->step[i].change[j];
    return FW_OK;
}

fw_status fw_process_flow_stack(fw_arena *arena, const fw_process_flow *flow, int index,
                                fw_process_stack *stack, const fw_process_change **absent) {
    int all = index >= 0 && index < flow->nstep ? flow->step[index].nchange : 0;
    return stack_of(arena, flow, index, all, stack, absent);
}

fw_status fw_process_flow_stack_before(fw_arena *arena, const fw_process_flow *flow, int step,
                                       int change, fw_process_stack *stack) {
    return stack_of(arena, flow, step, change, stack, NULL);
}

bool fw_process_stack_holds(const fw_process_stack *stack, int column, const char *material) {
    for (int i = 0; i < stack->n[column]; i++)
        if (strcmp(stack->cell[column][i].material, material) == 0) return true;
    return false;
}

const fw_process_cell *fw_process_stack_top(const fw_process_stack *stack, int column, bool back) {
    int n = stack->n[column];
    return n > 0 ? &stack->cell[column][back ? 0 : n - 1] : NULL;
}

/* how far a column reaches towards a face, from the wafer's own front; -INFINITY: nothing is left of it */
static double reaches(const fw_process_stack *s, int column, bool back) {
    double out = -(double)INFINITY;
    for (int i = 0; i < s->n[column]; i++) {
        const fw_process_cell *c = &s->cell[column][i];
        out = fmax(out, back ? -c->bottom : c->bottom + c->height);
    }
    return back ? out : fmax(out, 0.0);
}

const fw_process_cell *fw_process_stack_find(const fw_process_flow *flow,
                                             const fw_process_stack *stack, int column,
                                             const char *material, bool back, const char **cover) {
    double beside = (double)INFINITY;
    const int n = stack->n[column];
    for (int k = 0; k < stack->columns; k++)
        if (fw_process_columns_meet(flow, column, k))
            beside = fmin(beside, reaches(stack, k, back));
    *cover = NULL;
    for (int i = 0; i < n; i++) {
        const fw_process_cell *c = &stack->cell[column][back ? i : n - 1 - i];
        if (strcmp(c->material, material) == 0) {
            if ((back ? -c->bottom : c->bottom + c->height) > beside + 1e-9) *cover = NULL;
            return c;
        }
        const fw_process_material *m = fw_process_flow_material(flow, c->material);
        if (!*cover && !(m && m->holes)) *cover = c->material;
    }
    return NULL;
}

bool fw_process_stack_open(const fw_process_flow *flow, const fw_process_stack *stack,
                           const char *material, bool back) {
    const char *cover;
    for (int column = 0; column < stack->columns; column++)
        if (fw_process_stack_find(flow, stack, column, material, back, &cover) && !cover)
            return true;
    return false;
}

bool fw_process_step_is_wet(const fw_process_step *s) {
    static const char *const wet[] = {"wet-etch", "strip", "release", "clean", "develop"};
    for (size_t i = 0; i < sizeof wet / sizeof *wet; i++)
        if (strcmp(s->op, wet[i]) == 0) return true;
    for (int k = 0; k < s->nchange; k++)
        if (s->change[k].reach || s->change[k].isotropic) return true;
    return fw_process_step_in_liquid(s);
}

/* ---- what is new after a step ---- */

bool fw_process_films_is_new(const fw_process_films *now, const fw_process_films *before, int i) {
    for (int k = 0; k < before->nnote; k++)
        if (strcmp(before->note[k], now->note[i]) == 0) return false;
    return true;
}

bool fw_process_step_changes(const fw_process_step *step) {
    return step->nchange > 0 || step->nexposed > 0;
}
