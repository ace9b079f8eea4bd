/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer's layers, step by step: what a step needs there, and what else it does to them. */
#include "process/pack.h"
#include "base/constants.h"
#include "base/text.h"
#include "process/films.h"
#include <math.h>
#include <string.h>

fw_status fw_process_lint_absent(fw_process_pack *pack) {
    fw_process_stack stack;
    const fw_process_change *absent = NULL;
    FW_TRY(fw_process_flow_stack(pack->arena, pack->flow, pack->flow->nstep - 1, &stack, &absent));
    if (absent)
        fw_diag_error(pack->diags, 172, absent->place,
                      "<change kind='%s'> needs the material '%s', which is not on the wafer at "
                      "this step",
                      absent->kind, absent->from[0] ? absent->from : absent->material);
    return FW_OK;
}

/* steps in which a chemical or a plasma works on the wafer; in others it is only in the room */
static bool works_on_wafer(const fw_process_step *s) {
    return fw_words_hold("clean anodise displace develop plate wet-etch dry-etch strip release",
                         " ", s->op);
}

static bool is_target(const fw_process_step *s, const char *material) {
    for (int i = 0; i < s->nchange; i++)
        if (strcmp(s->change[i].material, material) == 0 ||
            strcmp(s->change[i].from, material) == 0)
            return true;
    return false;
}

static const fw_process_exposed *spoken_of(const fw_process_step *s, const char *material) {
    for (int i = 0; i < s->nexposed; i++)
        if (strcmp(s->exposed[i].material, material) == 0) return &s->exposed[i];
    return NULL;
}

/* to what the step works with; after: index of the step, or of the one before it */
static fw_status lies_open(fw_process_pack *pack, const fw_process_step *s, int after,
                           const char *material, bool *open) {
    fw_process_stack stack;
    *open = false;
    FW_TRY(fw_process_flow_stack(pack->arena, pack->flow, after, &stack, NULL));
    for (int back = 0; back < 2; back++)
        *open = *open || (fw_process_step_meets(s, back) &&
                          fw_process_stack_open(pack->flow, &stack, material, back));
    return FW_OK;
}

/* one <attacks> of one step: open before the step, or laid open by it */
static fw_status lint_attack(fw_process_pack *pack, int index, const fw_process_hazard *hazard,
                             const char *material) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[index];
    if (is_target(s, material) || spoken_of(s, material)) return FW_OK;
    bool open = false;
    for (int k = index - 1; k <= index && !open; k++)
        FW_TRY(lies_open(pack, s, k, material, &open));
    if (open)
        fw_diag_error(pack->diags, 269, s->place,
                      "step %s: '%s' attacks '%s', which is exposed there, and the pack states "
                      "no rate for it; add <exposed material=\"%s\" rate=\"...\"/> (the rate "
                      "may be unknown), or cover it",
                      s->id, hazard->id, material, material);
    return FW_OK;
}

fw_status fw_process_lint_attacked(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        for (int h = 0; works_on_wafer(s) && h < s->nhazard; h++)
            for (int m = 0; m < s->hazard[h]->nattacks; m++)
                FW_TRY(lint_attack(pack, i, s->hazard[h], s->hazard[h]->attacks[m]));
        for (int x = 0; x < s->nexposed; x++) {
            bool before, after;
            FW_TRY(lies_open(pack, s, i - 1, s->exposed[x].material, &before));
            FW_TRY(lies_open(pack, s, i, s->exposed[x].material, &after));
            if (!before && !after)
                fw_diag_error(pack->diags, 269, s->exposed[x].place,
                              "step %s: '%s' is not exposed at this step, so that it is not "
                              "attacked; remove <exposed>",
                              s->id, s->exposed[x].material);
        }
    }
    return FW_OK;
}

static bool on_wafer(const fw_process_stack *stack, const char *material) {
    for (int column = 0; column < stack->columns; column++)
        if (fw_process_stack_holds(stack, column, material)) return true;
    return false;
}

static void lint_hot(fw_process_pack *pack, const fw_process_step *s, const fw_process_stack *stack,
                     const fw_process_setting *set) {
    const fw_process_flow *f = pack->flow;
    if (set->q->unknown ||
        !fw_quantity_dimension_equal(set->q->dimension, (fw_quantity_dimension){.K = 1}))
        return;
    for (int i = 0; i < f->nprocess_material; i++) {
        const fw_process_material *m = &f->process_material[i];
        if (m != fw_process_flow_material(f, m->id) || !m->highest_K || m->highest_K->unknown ||
            set->q->value <= m->highest_K->value || !on_wafer(stack, m->id))
            continue;
        char at[32], bears[32];
        fw_number_text(at, sizeof at, set->q->value - FW_ICE_POINT_K, 5);
        fw_number_text(bears, sizeof bears, m->highest_K->value - FW_ICE_POINT_K, 5);
        fw_diag_error(pack->diags, 271, s->place,
                      "step %s: %s is %s Cel, but '%s' on the wafer tolerates at most %s Cel "
                      "(its highest-temperature in the pack); remove it before this step, or "
                      "stay below that temperature",
                      s->id, set->name, at, m->id, bears);
    }
}

fw_status fw_process_lint_heat(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        /* what is on the wafer when the step begins, and what it puts there */
        fw_process_stack stack;
        FW_TRY(fw_process_flow_stack(pack->arena, pack->flow, i - 1, &stack, NULL));
        for (int k = 0; k < pack->flow->step[i].nsetting; k++)
            lint_hot(pack, &pack->flow->step[i], &stack, &pack->flow->step[i].setting[k]);
    }
    return FW_OK;
}

/* Once such a material was on the wafer, the wafer carries its traces for good. */
fw_status fw_process_lint_contamination(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int from = 0; from < f->nstep; from++)
        for (int c = 0; c < f->step[from].nchange; c++) {
            const fw_process_change *change = &f->step[from].change[c];
            const fw_process_material *m = fw_process_flow_material(f, change->material);
            bool brings = strcmp(change->kind, "add") == 0 || strcmp(change->kind, "convert") == 0;
            if (!m || !m->contaminates[0] || !brings) continue;
            for (int i = from; i < f->nstep; i++) {
                const fw_process_step *s = &f->step[i];
                if (!s->equipment || fw_words_hold(s->equipment->takes, " ", m->contaminates))
                    continue;
                fw_diag_error(pack->diags, 272, s->place,
                              "step %s takes a wafer with %s ('%s', since step %s) into '%s', "
                              "which does not say takes=\"%s\"; use a tool that does",
                              s->id, m->contaminates, m->id, f->step[from].id, s->equipment->id,
                              m->contaminates);
                return FW_OK; /* the first place is enough: the same tool comes again */
            }
        }
    return FW_OK;
}

static bool has_image(const fw_process_stack *stack, const fw_process_change *c) {
    for (int column = 0; column < stack->columns; column++)
        for (int i = 0; i < stack->n[column]; i++)
            if (fw_process_stack_works_on(stack, c, &stack->cell[column][i]) &&
                stack->cell[column][i].exposed)
                return true;
    return false;
}

fw_status fw_process_lint_exposure(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_step *s = &f->step[i];
            const fw_process_change *c = &s->change[k];
            if (strcmp(c->kind, "pattern") == 0 && !s->mask[0])
                fw_diag_error(pack->diags, 274, s->place,
                              "step %s makes a pattern without naming its mask; add mask=\"...\"",
                              s->id);
            if (strcmp(s->op, "develop") != 0 || strcmp(c->kind, "remove") != 0) continue;
            fw_process_stack stack;
            FW_TRY(fw_process_flow_stack(pack->arena, f, i - 1, &stack, NULL));
            if (on_wafer(&stack, c->material) && !has_image(&stack, c))
                fw_diag_error(pack->diags, 274, c->place,
                              "step %s develops '%s', which no step exposed: a <change "
                              "kind=\"pattern\"> must come before",
                              s->id, c->material);
        }
    return FW_OK;
}

/* An etch of one part only, of a material that lies open in the other part too, takes both. */
fw_status fw_process_lint_masking(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_step *s = &f->step[i];
            const fw_process_change *c = &s->change[k];
            if (strcmp(c->kind, "remove") != 0 || strcmp(c->where, "all") == 0 ||
                !fw_words_hold("wet-etch dry-etch strip release clean", " ", s->op))
                continue;
            fw_process_stack stack;
            FW_TRY(fw_process_flow_stack(pack->arena, f, i - 1, &stack, NULL));
            for (int other = 0; other < stack.columns; other++) {
                const fw_process_cell *open = fw_process_stack_top(&stack, other, c->back);
                char part[FW_LABEL];
                if (fw_process_where_holds(f, c->where, other) || !open ||
                    strcmp(open->material, c->material) != 0)
                    continue;
                fw_diag_error(pack->diags, 275, c->place,
                              "step %s removes '%s' from the %s only, but it lies open in the %s "
                              "too; a mask must cover it there",
                              s->id, c->material, c->where, fw_process_column_name(f, other, part));
                break;
            }
        }
    return FW_OK;
}

/* ---- does an etch go through what lies there? ---- */

static const fw_quantity *argument_of(const fw_process_step *s, const char *name) {
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(s->argument[i].name, name) == 0) return s->argument[i].q;
    return NULL;
}

/* the least that a step says it goes through, over-etch included: what its change states, and what its time is
   computed from where it takes one material only; NULL: it says nothing */
static const fw_quantity *through(const fw_process_step *s, const fw_process_change *c) {
    int removed = 0;
    for (int k = 0; k < s->nchange; k++)
        removed += strcmp(s->change[k].kind, "remove") == 0;
    const fw_quantity *stated = c->thickness,
                      *timed = removed == 1 ? argument_of(s, "thickness") : NULL;
    if (!stated || stated->unknown) return timed && !timed->unknown ? timed : NULL;
    return timed && !timed->unknown && timed->value < stated->value ? timed : stated;
}

/* of what a change takes in a part of the wafer; 0: none; NaN: of a thickness that is not known */
static double lies_in(const fw_process_stack *stack, int column, const fw_process_change *c) {
    double sum = 0.0;
    for (int i = 0; i < stack->n[column]; i++)
        if (fw_process_stack_works_on(stack, c, &stack->cell[column][i]))
            sum += stack->cell[column][i].thickness_m;
    return sum;
}

/* a removal that goes sideways takes the layer that lies there, whose thickness it states */
static fw_status lint_below(fw_process_pack *pack, int index, const fw_process_change *c) {
    const fw_process_flow *f = pack->flow;
    fw_process_stack stack;
    double lies = 0.0;
    char takes[32], there[32];
    if (!c->thickness || c->thickness->unknown) return FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, index - 1, &stack, NULL));
    for (int column = 0; column < stack.columns; column++)
        if (fw_process_where_holds(f, c->where, column))
            lies = fmax(lies, lies_in(&stack, column, c));
    if (!(lies > 0.0) || !(c->thickness->value > 2.0 * lies || c->thickness->value < 0.5 * lies))
        return FW_OK;
    fw_diag_error(pack->diags, 349, c->place,
                  "step %s takes %s um of '%s' (%s) sideways below the device, but %s um lie "
                  "there; state the layer's own thickness",
                  f->step[index].id,
                  fw_number_text(takes, sizeof takes, 1e6 * c->thickness->value, 4), c->material,
                  c->thickness->id, fw_number_text(there, sizeof there, 1e6 * lies, 4));
    return FW_OK;
}

static fw_status lint_through(fw_process_pack *pack, int index, const fw_process_change *c) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[index];
    const fw_quantity *q = through(s, c);
    fw_process_stack stack;
    if (!q || c->reach) return c->reach ? lint_below(pack, index, c) : FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, index - 1, &stack, NULL));
    const double goes = q->value * (1.0 + fmax(s->overrun, 0.0));
    for (int column = 0; column < stack.columns; column++) {
        char part[FW_LABEL], there[32], takes[32];
        const double lies = lies_in(&stack, column, c);
        const bool hollow = c->isotropic && q->value < 0.5 * lies; /* a depth that is meant */
        if (!fw_process_where_holds(f, c->where, column) || hollow || !(lies > goes * (1 + 1e-9)))
            continue;
        fw_diag_error(
            pack->diags, 349, c->place,
            "step %s goes through %s um of '%s' (%s, over-etch included), but %s um lie in "
            "the %s: what is left there covers what comes next; state what lies there, or "
            "take it away first",
            s->id, fw_number_text(takes, sizeof takes, 1e6 * goes, 4), c->material, q->id,
            fw_number_text(there, sizeof there, 1e6 * lies, 4),
            fw_process_column_name(f, column, part));
        return FW_OK;
    }
    return FW_OK;
}

fw_status fw_process_lint_through(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++)
            if (strcmp(f->step[i].change[k].kind, "remove") == 0 &&
                fw_words_hold(f->step[i].change[k].reach ? "wet-etch dry-etch strip release"
                                                         : "wet-etch dry-etch strip",
                              " ", f->step[i].op))
                FW_TRY(lint_through(pack, i, &f->step[i].change[k]));
    return FW_OK;
}

/* ---- what is put on a face that was cleaned ----
   Test: test_lint.c */

static const struct {
    const char *op, *after, *does;
    bool dry;
    double most_s;
    const char *why;
} fresh[] = {
    {"plate", "clean", "cleans", false, 2 * 3600.0,
     "metal oxidises and takes up grease, and what is plated on it peels"},
    {"bond", "clean", "cleans", false, 8 * 3600.0,
     "a cleaned face gathers water and particles, and the bond has voids"},
    {"coat", "bake", "bakes dry", true, 24 * 3600.0,
     "it takes up water again, and resist holds badly"},
};

/* The longest that the flow lets pass from the end of step `from` to the start of step `to`, times of steps between aside:
   by its holds and by what the wafer's states bear. INFINITY: nothing limits it. */
static fw_status longest_between(fw_process_pack *pack, int from, int to, double *longest) {
    const fw_process_flow *f = pack->flow;
    double *s = fw_arena_array(pack->arena, double, (size_t)(to - from + 1));
    FW_NEED(s);
    for (int i = from + 1; i <= to; i++) {
        s[i - from] = (double)INFINITY;
        for (int j = from; j < i; j++)
            for (int k = 0; k < f->step[i].nlag; k++)
                if (strcmp(f->step[i].lag[k].from, f->step[j].id) == 0)
                    s[i - from] = fmin(s[i - from], s[j - from] + f->step[i].lag[k].max_s);
        for (int k = 0; k < f->nwait; k++)
            if (f->wait[k].to == i && f->wait[k].from >= from)
                s[i - from] = fmin(s[i - from], s[f->wait[k].from - from] + f->wait[k].max_s);
    }
    *longest = s[to - from];
    return FW_OK;
}

static bool wet_between(const fw_process_flow *f, int from, int to) {
    for (int i = from + 1; i < to; i++)
        if (fw_process_step_in_liquid(&f->step[i])) return true;
    return false;
}

fw_status fw_process_lint_fresh(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    FW_TRY(fw_process_flow_waits(pack->arena, pack->flow));
    for (int i = 0; i < f->nstep; i++)
        for (size_t r = 0; r < sizeof fresh / sizeof *fresh; r++) {
            int from = i - 1;
            if (!fw_process_step_is_op(&f->step[i], fresh[r].op)) continue;
            while (from >= 0 && !fw_process_step_is_op(&f->step[from], fresh[r].after))
                from--;
            if (from < 0) continue; /* never cleaned or baked: FW-D346, FW-D341 */
            if (fresh[r].dry && wet_between(f, from, i)) continue; /* FW-D341 */
            double longest;
            char is[32], most[32];
            FW_TRY(longest_between(pack, from, i, &longest));
            if (longest <= fresh[r].most_s) continue;
            fw_diag_warning(
                pack->diags, 614, f->step[i].place,
                "step %s (%s) may come %s%s after step %s, which %s what it "
                "works on: %s; add <lag from=\"%s\" max=\"...\"/> of %s h at most",
                f->step[i].id, f->step[i].op,
                isinf(longest) ? "at any time" : fw_number_text(is, sizeof is, longest / 3600.0, 3),
                isinf(longest) ? "" : " h", f->step[from].id, fresh[r].does, fresh[r].why,
                f->step[from].id, fw_number_text(most, sizeof most, fresh[r].most_s / 3600.0, 3));
        }
    return FW_OK;
}

/* ---- where a wafer goes that is done again ---- */

/* does the text on the sheet take something off first? */
static bool takes_off_first(const char *text) {
    static const char *const words[] = {"strip", "remove", "take off", "etch off"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strstr(text, words[i])) return true;
    return false;
}

/* A rework that goes back to an earlier bath brings what has come on since: what that bath attacks, and is not meant to. */
static fw_status lint_back_into(fw_process_pack *pack, int at, int again,
                                const fw_process_on_fail *rework) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[again];
    for (int h = 0; works_on_wafer(s) && h < s->nhazard; h++)
        for (int m = 0; m < s->hazard[h]->nattacks; m++) {
            const char *material = s->hazard[h]->attacks[m];
            bool open;
            if (is_target(s, material) || spoken_of(s, material)) continue;
            FW_TRY(lies_open(pack, s, at, material, &open));
            if (!open) continue;
            fw_diag_error(pack->diags, 615, f->step[at].place,
                          "<on-fail if=\"%s\"> of step %s sends a wafer with open '%s' back to "
                          "step %s, whose '%s' attacks that; say in its text how it is taken off "
                          "before (\"strip ...\"), or go back to a step that does not harm it",
                          rework->condition, f->step[at].id, material, s->id, s->hazard[h]->id);
            return FW_OK;
        }
    return FW_OK;
}

fw_status fw_process_lint_reworked(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int at = 0; at < f->nstep; at++)
        for (int k = 0; k < f->step[at].non_fail; k++)
            for (int j = 0; j < at; j++)
                if (strcmp(f->step[at].on_fail[k].go_to, f->step[j].id) == 0 &&
                    !takes_off_first(f->step[at].on_fail[k].text))
                    FW_TRY(lint_back_into(pack, at, j, &f->step[at].on_fail[k]));
    return FW_OK;
}

/* ---- is what is accepted what was made? ---- */

/* is it the thickness of a layer that is measured? Not a difference, a spread or a width */
static bool is_thickness(const fw_process_accept *a) {
    static const char *const other[] = {"against", "below", "spread", "left", "lost", "width"};
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        if (strstr(a->measure, other[i])) return false;
    return strstr(a->measure, "thickness") || strstr(a->measure, "step height");
}

static bool accepted(const fw_process_accept *a, const fw_quantity_unit *unit, double thickness_m) {
    double low, high, value = fw_quantity_unit_from_si(unit, thickness_m);
    if (a->low[0] && fw_number_parse(a->low, strlen(a->low), &low) && value < low) return false;
    if (a->high[0] && fw_number_parse(a->high, strlen(a->high), &high) && value > high)
        return false;
    return true;
}

/* Some layer that the step puts on, or where it puts none one that lies there or comes on, is accepted as it is meant. *meant: the first
   that was asked for, m; NaN: none has a known thickness. */
static fw_status some_accepted(fw_process_pack *pack, int at, const fw_process_accept *a,
                               const fw_quantity_unit *unit, double *meant, bool *some) {
    const fw_process_step *s = &pack->flow->step[at];
    double all_m = 0.0;
    bool adds = false, unknown = false;
    fw_process_stack stack;
    *meant = (double)NAN;
    *some = false;
    for (int k = 0; k < s->nchange; k++) {
        const fw_process_change *c = &s->change[k];
        if (strcmp(c->kind, "add") != 0) continue;
        adds = true;
        unknown = unknown || !c->thickness || c->thickness->unknown;
        if (unknown) continue;
        all_m += c->thickness->value;
        *some = *some || accepted(a, unit, c->thickness->value) || accepted(a, unit, all_m);
        if (isnan(*meant)) *meant = c->thickness->value;
    }
    *some = *some || unknown;
    for (int i = at + 1; i < pack->flow->nstep && !adds; i++) /* a wafer that is bonded on later */
        for (int k = 0; k < pack->flow->step[i].nchange; k++) {
            const fw_process_change *c = &pack->flow->step[i].change[k];
            const bool known = c->thickness && !c->thickness->unknown;
            *some = *some || (strcmp(c->kind, "add") == 0 && known &&
                              accepted(a, unit, c->thickness->value));
        }
    FW_TRY(fw_process_flow_stack(pack->arena, pack->flow, at, &stack, NULL));
    for (int column = 0; column < stack.columns && !*some; column++)
        for (int i = 0; i < stack.n[column]; i++) {
            const fw_process_cell *c = &stack.cell[column][i];
            double lies_m = 0.0;
            bool own = !adds;
            for (int k = 0; k < s->nchange; k++)
                own = own || strcmp(s->change[k].material, c->material) == 0;
            for (int j = 0; j < stack.n[column]; j++)
                if (strcmp(stack.cell[column][j].material, c->material) == 0)
                    lies_m += stack.cell[column][j].thickness_m;
            *some = *some || (own && (isnan(lies_m) || accepted(a, unit, lies_m)));
            if (own && isnan(*meant)) *meant = lies_m;
        }
    return FW_OK;
}

fw_status fw_process_lint_accepted(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    const fw_quantity_dimension length = FW_DIM_LENGTH;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].naccept; k++) {
            const fw_process_accept *a = &f->step[i].accept[k];
            fw_quantity_unit unit;
            double meant;
            bool some;
            char is[32];
            if (!is_thickness(a) ||
                !fw_quantity_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL) ||
                !fw_quantity_dimension_equal(unit.dimension, length))
                continue;
            FW_TRY(some_accepted(pack, i, a, &unit, &meant, &some));
            if (some || isnan(meant)) continue;
            fw_diag_error(
                pack->diags, 616, a->place,
                "step %s accepts a %s of %s to %s %s, but the layer is meant to be %s %s thick: "
                "every wafer that comes out right is refused; write the limits from the quantity "
                "of the layer ({=...*0.95})",
                f->step[i].id, a->measure, a->low[0] ? a->low : "any", a->high[0] ? a->high : "any",
                a->unit, fw_number_text(is, sizeof is, fw_quantity_unit_from_si(&unit, meant), 4),
                a->unit);
        }
    return FW_OK;
}

/* ---- wafers that are in pieces ----
   What a device's plate leaves of the field lies between all dies. Where nothing of any layer is left there, and the
   structure still is, what was a wafer is as many pieces as there are dies, whatever the plate is of. Test:
   test_lint.c. */

static bool in_pieces(const fw_process_flow *f, const fw_process_stack *stack) {
    fw_process_side field;
    bool stands = false;
    if (!fw_process_where_side(f, "field", &field)) return false;
    for (int column = 0; column < stack->columns; column++) {
        bool of_field = fw_process_side_holds(f, field, column);
        if (of_field && stack->n[column] > 0) return false;
        stands = stands || (!of_field && stack->n[column] > 0);
    }
    return stands;
}

/* a step after which the field may be empty, which it was not before */
static bool takes_away(const fw_process_step *s) {
    for (int i = 0; i < s->nchange; i++)
        if (strcmp(s->change[i].kind, "remove") == 0 &&
            strcmp(s->change[i].where, "structure") != 0)
            return true;
    return false;
}

/* What lies between the dies after a dry etch has gone through there: less than 100 um are film, wax or paste, which no
   clamp holds and no helium presses on. Test: test_lint.c, flows_of_wrong_steps. */
static void lint_carrier(fw_process_pack *pack, const fw_process_step *s,
                         const fw_process_stack *stack) {
    const fw_process_flow *f = pack->flow;
    const double least_m = 1e-4;
    double most_m = 0.0;
    fw_process_side field;
    bool stands = false, gone = takes_away(s);
    char is[32];
    if (!fw_process_step_is_op(s, "dry-etch") || !fw_process_where_side(f, "field", &field)) return;
    for (int column = 0; column < stack->columns; column++) {
        double sum = 0.0;
        if (!fw_process_side_holds(f, field, column)) {
            stands = stands || stack->n[column] > 0;
            continue;
        }
        for (int i = 0; i < stack->n[column]; i++)
            sum += stack->cell[column][i].thickness_m;
        for (int k = 0; k < s->nchange; k++)
            gone = gone && !fw_process_stack_holds(stack, column, s->change[k].material);
        most_m = isnan(sum) ? (double)INFINITY : fmax(most_m, sum);
    }
    if (stands && gone && most_m < least_m)
        fw_diag_error(pack->diags, 625, s->place,
                      "step %s etches through the wafer, and between the dies %s um are left of "
                      "what lies below: that carries no wafer in its chamber; put it on a carrier "
                      "before (op=\"mount\", a layer with side=\"back\")",
                      s->id, fw_number_text(is, sizeof is, 1e6 * most_m, 3));
}

fw_status fw_process_lint_parted(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    bool before = false;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        fw_process_stack stack;
        if (!s->parts && (before || !takes_away(s))) continue;
        FW_TRY(fw_process_flow_stack(pack->arena, f, i, &stack, NULL));
        bool pieces = in_pieces(f, &stack), dies = before || s->parts;
        if (!dies && i + 1 < f->nstep) lint_carrier(pack, s, &stack);
        if (pieces && !dies && i + 1 < f->nstep) {
            fw_diag_warning(pack->diags, 552, s->place,
                            "after step %s nothing is left between the dies: the wafer is in "
                            "pieces, and the steps behind it are of wafers; say leaves=\"dies\" in "
                            "the step that parts it, or leave a layer in the field",
                            s->id);
            return FW_OK;
        }
        if (s->parts && !pieces && strcmp(s->op, "dice") != 0)
            fw_diag_error(pack->diags, 552, s->place,
                          "step %s leaves dies, but layers of the wafer still join them in the "
                          "field and the step is no \"dice\"; remove leaves=\"dies\", or say what "
                          "it takes away",
                          s->id);
        if (s->parts && before)
            fw_diag_error(pack->diags, 552, s->place,
                          "step %s leaves dies, and a step before it has parted the wafer already; "
                          "keep leaves=\"dies\" in one of them",
                          s->id);
        before = dies;
    }
    return FW_OK;
}
