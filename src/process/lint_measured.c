/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is what a step measures, is timed for or works on there, by the films on the wafer alone? And does nothing lie on what was
   dissolved? Each question is a function here and a row in lint.c, but that of units, which is asked with set points (lint_values.c). Cost: steps times layers. Test: test_measured.c. */
#include "base/text.h"
#include "process/films.h"
#include "process/pack.h"
#include <ctype.h>
#include <string.h>

/* ---- is what is measured there? ----
   A film is on the wafer before a step, or after it, where any column has it. What is read of another piece (a witness, a
   dummy) and what is counted to be none (residue) needs it not. Test: test_measured.c. */

/* its layers before and after a step */
typedef struct around {
    fw_process_stack before, after;
} around;

static fw_status around_step(fw_process_pack *pack, int at, around *a) {
    FW_TRY(fw_process_flow_stack(pack->arena, pack->flow, at - 1, &a->before, NULL));
    return fw_process_flow_stack(pack->arena, pack->flow, at, &a->after, NULL);
}

static bool holds(const fw_process_stack *stack, const char *material) {
    for (int column = 0; column < stack->columns; column++)
        if (fw_process_stack_holds(stack, column, material)) return true;
    return false;
}

static bool is_around(const around *a, const char *material) {
    return holds(&a->before, material) || holds(&a->after, material);
}

/* some of its columns have it, and some have not: it has an edge there. NULL: any two columns are unlike, a hollow in one */
static bool has_edge(const fw_process_stack *stack, const char *material) {
    bool with = false, bare = false;
    for (int column = 0; column < stack->columns; column++) {
        bool there = material && fw_process_stack_holds(stack, column, material);
        with = with || there;
        bare = bare || (material && !there);
        with = with || (!material && stack->n[column] != stack->n[0]);
        for (int i = 0; !material && !with && i < stack->n[column]; i++) {
            const fw_process_cell *c = &stack->cell[column][i], *first = &stack->cell[0][i];
            with = strcmp(c->material, first->material) != 0 || c->height < first->height ||
                   c->height > first->height;
        }
    }
    return with && (bare || !material);
}

static bool edge_around(const around *a, const char *material) {
    return has_edge(&a->before, material) || has_edge(&a->after, material);
}

/* the film whose thickness q is, and that comes on at step *when first; NULL: q is none, or one of several */
static const char *film_of(const fw_process_flow *f, const fw_quantity *q, int *when) {
    const char *material = NULL;
    for (int i = 0; q && i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (c->thickness != q || strcmp(c->kind, "remove") == 0) continue;
            if (material && strcmp(material, c->material) != 0) return NULL;
            if (!material) *when = i;
            material = c->material;
        }
    return material;
}

/* a wafer that is bonded on or mounted later is looked at as it comes in */
static bool comes_in_later(const fw_process_flow *f, int at, int when) {
    return when > at && (fw_process_step_is_op(&f->step[when], "bond") ||
                         fw_process_step_is_op(&f->step[when], "mount"));
}

static void lint_film(fw_process_pack *pack, int at, const around *a, const fw_quantity *q,
                      const char *does) {
    const fw_process_flow *f = pack->flow;
    int when = -1;
    const char *material = film_of(f, q, &when);
    if (!material || is_around(a, material) || comes_in_later(f, at, when)) return;
    fw_diag_error(pack->diags, 623, f->step[at].place,
                  "step %s %s %s, the thickness of '%s', and there is none on the wafer %s: do it "
                  "while that is there, or leave it out",
                  f->step[at].id, does, q->id, material, when > at ? "yet" : "any more");
}

/* q is how deep a later step etches, and nothing else; NULL: it is not */
static const fw_process_step *etched_later(const fw_process_flow *f, int at, const fw_quantity *q) {
    const fw_process_step *first = NULL;
    for (int i = 0; q && i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            if (f->step[i].change[k].thickness != q) continue;
            if (i <= at || strcmp(f->step[i].change[k].kind, "remove") != 0) return NULL;
            if (!first) first = &f->step[i];
        }
    return first;
}

/* What works without a change works on what is there: a device that is cut, where it is freed or driven; a coat, where its
   rim is stripped. */
static void lint_bare(fw_process_pack *pack, const fw_process_step *s, const around *a) {
    const fw_process_flow *f = pack->flow;
    bool coat = false;
    if (s->nchange > 0) return;
    if ((s->bears || fw_process_step_is_op(s, "release")) && f->material &&
        !has_edge(&a->before, f->material))
        fw_diag_error(pack->diags, 623, s->place,
                      "step %s %s the device, and '%s' is not cut there; do it after the step that "
                      "cuts it",
                      s->id, s->bears ? "drives" : "frees", f->material);
    if (!fw_process_step_is_op(s, "strip")) return;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++)
            coat = coat || (fw_process_step_is_op(&f->step[i], "coat") &&
                            holds(&a->before, f->step[i].change[k].material));
    if (!coat)
        fw_diag_error(
            pack->diags, 623, s->place,
            "step %s strips, and there is no coat on the wafer; do it while there is one, "
            "or say by a <change> what it takes off",
            s->id);
}

const fw_quantity *fw_process_limit_quantity(const fw_process_flow *f, const char *const *limit,
                                             const char **raw) {
    for (int i = 0; i < f->ntext; i++) {
        char id[FW_LABEL];
        const char *text = f->text[i].raw;
        if (f->text[i].slot != (const char **)limit || strncmp(text, "{=", 2) != 0) continue;
        const size_t n = strcspn(text + 2, "*}");
        if (n >= sizeof id) continue;
        memcpy(id, text + 2, n);
        id[n] = '\0';
        if (raw) *raw = text;
        return fw_process_flow_quantity(f, id);
    }
    return NULL;
}

bool fw_process_is_difference(const fw_process_flow *flow, const fw_process_accept *a) {
    const char *const *limit[] = {&a->low, &a->high, &a->planned};
    for (size_t i = 0; i < sizeof limit / sizeof limit[0]; i++) {
        const fw_quantity *q = fw_process_limit_quantity(flow, limit[i], NULL);
        if (q && q->range && strcmp(q->range, FW_PROCESS_DIFFERENCE) == 0) return true;
    }
    return a->low[0] == '-';
}

static bool is_word_in(const char *text, const char *word) {
    const size_t n = strlen(word);
    for (const char *p = text; n > 0 && (p = strstr(p, word)); p++)
        if ((p == text || !isalnum((unsigned char)p[-1])) && !isalnum((unsigned char)p[n]))
            return true;
    return false;
}

/* the material that a measurement names, by its id or its name; NULL: none */
static const char *named_in(const fw_process_flow *f, const char *measure) {
    for (int i = 0; i < f->nprocess_material; i++) {
        const fw_process_material *m = &f->process_material[i];
        if (is_word_in(measure, m->id) || is_word_in(measure, m->name)) return m->id;
    }
    return NULL;
}

static bool is_elsewhere(const fw_process_accept *a) {
    return strstr(a->measure, "witness") || strstr(a->measure, "dummy");
}

static bool counts_none(const fw_process_accept *a) {
    double high;
    return !a->low[0] && fw_number_parse(a->high, strlen(a->high), &high) && !(high > 0.0);
}

/* does the step make a layer that a probe can stand on? Wafers come in with the first look, or are bonded and mounted */
static bool makes(const fw_process_step *s, const char *material) {
    static const char none[] = "inspect bond mount coat";
    for (int k = 0; k < s->nchange && !fw_words_hold(none, " ", s->op); k++)
        if (strcmp(s->change[k].kind, "remove") != 0 &&
            strcmp(s->change[k].material, material) == 0)
            return true;
    return false;
}

/* does a layer that was made lie open everywhere? */
static bool layer_on_top(const fw_process_flow *f, const fw_process_stack *stack) {
    bool all = stack->columns > 0;
    for (int column = 0; column < stack->columns; column++) {
        const fw_process_cell *top = fw_process_stack_top(stack, column, false);
        bool made = false;
        for (int i = 0; top && i < f->nstep; i++)
            made = made || makes(&f->step[i], top->material);
        all = all && made;
    }
    return all;
}

/* what a width is read at: an edge of what is named, of the device where a flexure is, or of anything */
static void lint_width(fw_process_pack *pack, const fw_process_step *s, const around *wafer,
                       const fw_process_accept *a, const char *named) {
    const fw_process_flow *f = pack->flow;
    const char *of = named || !is_word_in(a->measure, "flexure") ? named : f->material;
    if (edge_around(wafer, of)) return;
    fw_diag_error(pack->diags, 624, a->place,
                  "step %s measures '%s', and %s has an edge there; measure it after the step that "
                  "opens it",
                  s->id, a->measure, of ? "nothing of it" : "nothing on the wafer");
}

/* these patterns are of the device's layer, and every pattern is of a layer that was opened */
static void lint_coupon(fw_process_pack *pack, const fw_process_step *s, const around *wafer,
                        const fw_process_accept *a) {
    static const char device[] = "slots ladder cantilevers break-beams";
    const char *of = fw_words_hold(device, " ", a->coupon) ? pack->flow->material : NULL;
    if (!a->coupon[0] || edge_around(wafer, of)) return;
    fw_diag_error(pack->diags, 624, a->place,
                  "step %s looks at the coupon '%s', and '%s' is not patterned there; look after "
                  "the step that opens it",
                  s->id, a->coupon, of ? of : "the wafer");
}

/* what was mounted that is as stiff as a wafer; NULL: nothing */
static const char *carrier_on(const fw_process_flow *f, int at, const fw_process_stack *stack) {
    const double least_m = 1e-4; /* films, wax and paste bend along */
    for (int i = 0; i < at; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (fw_process_step_is_op(&f->step[i], "mount") && strcmp(c->kind, "add") == 0 &&
                c->thickness && !c->thickness->unknown && c->thickness->value >= least_m &&
                holds(stack, c->material))
                return c->material;
        }
    return NULL;
}

/* a wafer that is bonded flat to another one has that one's bow */
static void lint_bow(fw_process_pack *pack, int at, const around *wafer,
                     const fw_process_accept *a) {
    const fw_process_flow *f = pack->flow;
    const bool bow = is_word_in(a->measure, "bow") || is_word_in(a->measure, "warp");
    const char *carrier = bow ? carrier_on(f, at, &wafer->before) : NULL;
    if (carrier)
        fw_diag_error(pack->diags, 600, a->place,
                      "step %s measures '%s' of a wafer that is on '%s', which holds it flat: what "
                      "is read says nothing of its films; measure it before it is mounted",
                      f->step[at].id, a->measure, carrier);
}

static void lint_read(fw_process_pack *pack, const fw_process_step *s, const around *wafer,
                      const fw_process_accept *a) {
    const fw_process_flow *f = pack->flow;
    const char *named = named_in(f, a->measure);
    if (named && (a->low[0] || a->high[0]) && !is_around(wafer, named))
        fw_diag_error(pack->diags, 624, a->place,
                      "step %s measures '%s', and there is no '%s' on the wafer, before it or "
                      "after; measure it while it is there",
                      s->id, a->measure, named);
    else if (is_word_in(a->measure, "width"))
        lint_width(pack, s, wafer, a, named);
    else if (is_word_in(a->measure, "step height") && !edge_around(wafer, NULL))
        fw_diag_error(pack->diags, 624, a->place,
                      "step %s measures '%s', and the wafer has no step: every layer covers all of "
                      "it; measure it on a witness, or after a layer was opened",
                      s->id, a->measure);
    else if (is_word_in(a->measure, "sheet resistance") && !layer_on_top(f, &wafer->before) &&
             !layer_on_top(f, &wafer->after))
        fw_diag_warning(pack->diags, 624, a->place,
                        "step %s measures '%s', and no layer that a step has put on lies open: it "
                        "is the wafer's own; measure it after the layer, or remove it",
                        s->id, a->measure);
}

fw_status fw_process_lint_measured(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        around wafer;
        FW_TRY(around_step(pack, i, &wafer));
        lint_bare(pack, s, &wafer);
        for (int k = 0; k < s->nargument; k++)
            if (strcmp(s->argument[k].name, "thickness") == 0)
                lint_film(pack, i, &wafer, s->argument[k].q, "is timed for");
        for (int k = 0; k < s->naccept; k++) {
            const fw_process_accept *a = &s->accept[k];
            lint_coupon(pack, s, &wafer, a);
            if (is_elsewhere(a) || counts_none(a)) continue;
            const fw_quantity *q = fw_process_limit_quantity(f, &a->low, NULL);
            if (!q) q = fw_process_limit_quantity(f, &a->high, NULL);
            lint_film(pack, i, &wafer, q, "accepts a wafer by");
            const fw_process_step *etch = etched_later(f, i, q);
            if (etch)
                fw_diag_error(pack->diags, 623, s->place,
                              "step %s accepts a wafer by %s, and step %s etches so deep later; "
                              "look after it",
                              s->id, q->id, etch->id);
            lint_read(pack, s, &wafer, a);
            lint_bow(pack, i, &wafer, a);
        }
    }
    return FW_OK;
}

/* ---- what falls on a wafer ----
   A blade throws chips and water, and the plates of a bonder leave grains where they press. Test: test_measured.c. */

/* is a coat on top of every column of the front? */
static bool is_covered(const fw_process_flow *f, const fw_process_stack *stack) {
    bool all = stack->columns > 0;
    for (int column = 0; column < stack->columns; column++) {
        const fw_process_cell *top = fw_process_stack_top(stack, column, false);
        bool coat = false;
        for (int i = 0; top && i < f->nstep; i++)
            for (int k = 0; k < f->step[i].nchange; k++)
                coat = coat || (fw_process_step_is_op(&f->step[i], "coat") &&
                                strcmp(f->step[i].change[k].material, top->material) == 0);
        all = all && (coat || !fw_process_where_holds(f, "structure", column));
    }
    return all;
}

/* the first step behind `at` that films or etches the wafer; NULL: none does */
static const fw_process_step *worked_on_later(const fw_process_flow *f, int at) {
    static const char ops[] = "dry-etch wet-etch deposit coat plate bond";
    for (int i = at + 1; i < f->nstep; i++)
        if (fw_words_hold(ops, " ", f->step[i].op)) return &f->step[i];
    return NULL;
}

fw_status fw_process_lint_dust(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *pressed = NULL;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i], *later = worked_on_later(f, i);
        if (fw_process_step_is_op(s, "dice") && later) {
            fw_process_stack before;
            FW_TRY(fw_process_flow_stack(pack->arena, f, i - 1, &before, NULL));
            if (!is_covered(f, &before))
                fw_diag_warning(pack->diags, 601, s->place,
                                "step %s saws or breaks a wafer whose structures lie open, and "
                                "step %s works on them later: chips of the cut mask that; do it "
                                "while resist covers them",
                                s->id, later->id);
        }
        if (fw_process_step_is_op(s, "clean")) pressed = NULL;
        if (pressed && (fw_process_step_is_op(s, "coat") || fw_process_step_is_op(s, "deposit"))) {
            fw_diag_warning(pack->diags, 602, s->place,
                            "step %s covers a face that step %s has pressed on, and nothing cleans "
                            "it between: grains of its plates make holes in what comes on it; add "
                            "a step with op=\"clean\"",
                            s->id, pressed->id);
            pressed = NULL;
        }
        if (fw_process_step_is_op(s, "bond")) pressed = s;
    }
    return FW_OK;
}

/* ---- what lies on what is dissolved ----
   A film over the field that loses what is below it hangs on nothing: it breaks, and settles on the devices. Of the
   device's own layer that is its release. Test: test_measured.c. */

/* what lies on `material` in a column; NULL: it is not there, or nothing does. What came on at the back is below all. */
static const char *lies_on(const fw_process_stack *stack, int column, const char *material) {
    const fw_process_cell *cell = stack->cell[column];
    for (int i = 0; i + 1 < stack->n[column]; i++)
        if (!cell[i].back && strcmp(cell[i].material, material) == 0 &&
            strcmp(cell[i + 1].material, material) != 0)
            return cell[i + 1].material;
    return NULL;
}

/* the film of the field that loses `material` below it and stays; NULL: none does, or it is held at the rim of a window,
   beyond which the material still lies below it */
static const char *undermined(const fw_process_flow *f, const fw_process_stack *before,
                              const fw_process_stack *after, const char *material) {
    const char *film = NULL;
    for (int column = 0; column < before->columns; column++) {
        const char *above = lies_on(before, column, material);
        if (above && lies_on(after, column, material)) return NULL;
        if (above && fw_process_where_holds(f, "field", column) &&
            !(f->material && strcmp(above, f->material) == 0) &&
            fw_process_stack_holds(after, column, above))
            film = above;
    }
    return film;
}

fw_status fw_process_lint_undermined(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 1; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            fw_process_stack before, after;
            if (strcmp(c->kind, "remove") != 0) continue;
            FW_TRY(fw_process_flow_stack(pack->arena, f, i - 1, &before, NULL));
            FW_TRY(fw_process_flow_stack(pack->arena, f, i, &after, NULL));
            const char *above = undermined(f, &before, &after, c->material);
            if (above)
                fw_diag_error(pack->diags, 634, c->place,
                              "step %s dissolves '%s' below '%s', which stays in the field and "
                              "lies on nothing then: it comes off in flakes; take '%s' off before",
                              f->step[i].id, c->material, above, above);
        }
    return FW_OK;
}

/* ---- in what unit? ---- */

/* "{=al.d*0.95}" is a number in the unit of al.d, and the limit is read in that of the measurement */
static void lint_limit_in(fw_process_pack *pack, const fw_process_step *s,
                          const fw_process_accept *a, const char *const *limit) {
    const char *raw;
    const fw_quantity *q = fw_process_limit_quantity(pack->flow, limit, &raw);
    if (!q || !q->unit || strcmp(q->unit, a->unit) == 0) return;
    fw_diag_error(pack->diags, 342, a->place,
                  "step %s measures '%s' in %s, and its limit %s is a number in %s; write "
                  "unit=\"%s\"",
                  s->id, a->measure, a->unit, raw, q->unit, q->unit);
}

/* what is measured has a unit, or is counted in a word of the laboratory: not in a misspelt unit */
static void lint_measured_in(fw_process_pack *pack, const fw_process_step *s,
                             const fw_process_accept *a) {
    fw_quantity_unit unit;
    const size_t n = strlen(a->unit), longest = 4;
    if (n == 0 || n > longest || fw_quantity_unit_parse(a->unit, n, &unit, NULL, NULL)) return;
    const char *better = fw_quantity_unit_suggestion(a->unit, n, NULL);
    if (better)
        fw_diag_warning(pack->diags, 533, a->place,
                        "step %s measures '%s' in '%s', which is no unit; did you mean '%s'?",
                        s->id, a->measure, a->unit, better);
}

void fw_process_lint_unit(fw_process_pack *pack, const fw_process_step *s,
                          const fw_process_accept *a) {
    lint_measured_in(pack, s, a);
    lint_limit_in(pack, s, a, &a->low);
    lint_limit_in(pack, s, a, &a->high);
    lint_limit_in(pack, s, a, &a->planned);
}

/* ---- what is left in the end ---- */

static bool meant_to_stay(const fw_process_flow *f, const char *material, int column) {
    for (int i = 0; i < f->nfinished; i++)
        if (f->finished[i].present && strcmp(f->finished[i].material, material) == 0 &&
            fw_process_where_holds(f, f->finished[i].where, column))
            return true;
    return f->material && strcmp(f->material, material) == 0;
}

/* A mask, a cap on pads or a carrier that nobody takes off is told once: what lies on the device in the end, or was put
   on the back, belongs there only where <finished> says so. A pack that says nothing of its end at all is only told. */
fw_status fw_process_lint_left(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_stack stack;
    if (f->nstep == 0) return FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, f->nstep - 1, &stack, NULL));
    for (int column = 0; f->material && column < stack.columns; column++) {
        bool above = false;
        for (int i = 0; i < stack.n[column]; i++) {
            const fw_process_cell *cell = &stack.cell[column][i];
            char part[FW_LABEL];
            above = above || strcmp(cell->material, f->material) == 0;
            if ((!above && !cell->back) || meant_to_stay(f, cell->material, column)) continue;
            fw_process_column_name(f, column, part);
            const char *why = fw_arena_printf(
                pack->arena,
                "the flow ends with '%s' left %s in the %s, and nothing says that it belongs "
                "there; take it off, or say <finished material=\"%s\" is=\"present\" "
                "where=\"...\"/>",
                cell->material, cell->back ? "on the back" : "on the device", part, cell->material);
            FW_NEED(why);
            if (f->nfinished > 0)
                fw_diag_error(pack->diags, 644, f->place, "%s", why);
            else
                fw_diag_warning(pack->diags, 644, f->place, "%s", why);
            return FW_OK;
        }
    }
    return FW_OK;
}
