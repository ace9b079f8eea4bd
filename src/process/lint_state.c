/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Can every step be done on the wafer that comes to it? Whether it is wet and with what (wafer_state.c), and whether
   what the step works on lies open (the layers of films.h). The questions a process engineer asks between two lines of
   a run sheet; each is a function here and a row in lint.c. Theory: docs/theory/process.md, "Lint". */
#include "process/films.h"
#include "process/pack.h"
#include <string.h>

/* ---- what a wafer carries along ---- */

static void lint_meeting(fw_process_pack *pack, const fw_process_step *s, fw_place place,
                         const fw_process_hazard *carried, const char *since,
                         const fw_process_hazard *meets) {
    const char *reaction = fw_process_reaction(carried, meets);
    if (reaction)
        fw_diag_error(
            pack->diags, 336, place,
            "step %s brings a wafer that is wet with '%s' (since step %s) into '%s', and "
            "the two must not meet: %s; rinse it before: <finish kind=\"rinse\"/> in step "
            "%s",
            s->id, carried->id, since, meets->id, reaction, since);
    else if (carried && meets && strcmp(carried->id, meets->id) != 0)
        fw_diag_warning(
            pack->diags, 503, place,
            "step %s brings a wafer that is wet with '%s' (since step %s) into '%s': what "
            "it drags along spoils the bath, and is not off the wafer; rinse it in water "
            "before: <finish kind=\"rinse\"/> in step %s",
            s->id, carried->id, since, meets->id, since);
}

/* into the chemicals of the step, and from one rinse of it into the next */
static void lint_carried(fw_process_pack *pack, const fw_process_step *s,
                         const fw_process_wafer *before) {
    const fw_process_flow *f = pack->flow;
    bool wet = before->is[FW_STATE_WET];
    const fw_process_hazard *carried = wet ? before->liquid : NULL;
    const char *since = wet ? f->step[before->since[FW_STATE_WET]].id : s->id;
    if (fw_process_step_in_liquid(s)) {
        for (int h = 0; h < s->nhazard; h++)
            if (s->hazard[h]->wets) lint_meeting(pack, s, s->place, carried, since, s->hazard[h]);
        since = s->id;
        carried = fw_process_step_liquid(s);
    }
    for (int i = 0; i < s->nfinish; i++) {
        const fw_process_finish *r = &s->finish[i];
        if (r->kind != FW_FINISH_RINSE) continue;
        lint_meeting(pack, s, r->place, carried, since, r->with);
        carried = r->with;
        since = s->id;
    }
}

static fw_status lint_arrival(fw_process_pack *pack, const fw_process_step *s,
                              const fw_process_wafer *before) {
    const fw_process_flow *f = pack->flow;
    if (!before->is[FW_STATE_WET] || fw_process_step_takes_wet(s)) return FW_OK;
    const char *wet = fw_process_wafer_words(pack->arena, f, before, FW_STATE_WET);
    const char *from = f->step[before->since[FW_STATE_WET]].id;
    FW_NEED(wet);
    fw_diag_error(pack->diags, 335, s->place,
                  "step %s (%s, at '%s') takes a wafer that is %s since step %s; rinse and dry it "
                  "at the bench of step %s: <finish kind=\"rinse\"/> <finish kind=\"dry\" "
                  "by=\"...\"/>",
                  s->id, s->op, s->equipment ? s->equipment->id : "", wet, from, from);
    return FW_OK;
}

/* acids and bases are rinsed off, not dried on; solvents and water may be dried */
static void lint_residue(fw_process_pack *pack, const fw_process_step *s,
                         const fw_process_wafer *before) {
    const fw_process_hazard *on = before->is[FW_STATE_WET] ? before->liquid : NULL;
    if (fw_process_step_in_liquid(s) && fw_process_step_liquid(s)) on = fw_process_step_liquid(s);
    for (int i = 0; i < s->nfinish; i++) {
        const fw_process_finish *f = &s->finish[i];
        if (f->kind == FW_FINISH_RINSE) on = f->with;
        if (f->kind != FW_FINISH_DRY || !on || !strstr(on->ghs, "GHS05")) continue;
        fw_diag_error(pack->diags, 347, f->place,
                      "step %s dries a wafer that is wet with '%s' (%s): what stays goes on "
                      "etching; rinse before: <finish kind=\"rinse\"/>",
                      s->id, on->id, on->name);
    }
}

/* where the pack says of which liquid, the verdict of each device says whether it bears that */
static void lint_meniscus(fw_process_pack *pack, const fw_process_step *s,
                          const fw_process_wafer *after) {
    for (int i = 0; i < s->nfinish && after->released; i++) {
        const fw_process_finish *f = &s->finish[i];
        if (f->kind != FW_FINISH_DRY || f->tension || !fw_process_drying_pulls(f->by) ||
            strcmp(f->by, "vapour") == 0)
            continue;
        fw_diag_error(pack->diags, 337, f->place,
                      "step %s dries released devices by %s: the meniscus pulls flexures "
                      "down for good; dry them by=\"critical-point\" or by=\"vapour\", or say from "
                      "what they dry (tension=\"...\"), so that each device is judged by it",
                      s->id, f->by);
    }
}

/* water and vibration of a saw tear off what moves, and a spinner throws it off with the resist */
static void lint_sawn(fw_process_pack *pack, const fw_process_step *s,
                      const fw_process_wafer *before) {
    const bool wet = fw_process_step_takes_wet(s) || fw_process_step_liquid(s);
    if (before->released && wet && fw_process_step_is_op(s, "dice"))
        fw_diag_error(pack->diags, 337, s->place,
                      "step %s dices wafers whose devices are free already: water and shaking tear "
                      "them off; dice before they are released",
                      s->id);
    if (before->released && fw_process_step_is_op(s, "coat"))
        fw_diag_error(pack->diags, 337, s->place,
                      "step %s spins a liquid on devices that are free already: it tears them off, "
                      "and pulls them down as it dries; coat before they are released",
                      s->id);
}

/* finishes that cannot be: a tool that is never pumped is not vented, and a rinse takes time */
static void lint_finish(fw_process_pack *pack, const fw_process_step *s) {
    for (int i = 0; i < s->nfinish; i++) {
        const fw_process_finish *f = &s->finish[i];
        if (f->kind == FW_FINISH_VENT && s->equipment && !s->equipment->vacuum)
            fw_diag_error(pack->diags, 505, f->place,
                          "step %s vents '%s', which does not say vacuum=\"yes\"; say it, or leave "
                          "the finish out",
                          s->id, s->equipment->id);
        if (f->time && !f->time->unknown && !(f->time->value > 0.0))
            fw_diag_error(pack->diags, 347, f->time->replaced ? f->time->place : f->place,
                          "step %s finishes at its bench in no time (%s); give the time, or leave "
                          "it out where it is within the step's own",
                          s->id, f->time->id);
    }
}

/* a hot wafer goes from bake to bake; elsewhere it is cool: resist dries as it is spun on, liquids boil, it breaks */
static void lint_hot(fw_process_pack *pack, const fw_process_step *s,
                     const fw_process_wafer *before) {
    if (!before->is[FW_STATE_HOT] || fw_process_step_is_op(s, "bake")) return;
    const char *from = pack->flow->step[before->since[FW_STATE_HOT]].id;
    fw_diag_error(
        pack->diags, 504, s->place,
        "step %s (%s, at '%s') takes a wafer that is hot from step %s; let it cool there: "
        "<finish kind=\"cool\"/>",
        s->id, s->op, s->equipment ? s->equipment->id : "", from);
}

/* nobody takes a wafer out of a tool under vacuum; a next step may be in the same tool */
static void lint_pumped(fw_process_pack *pack, const fw_process_step *s,
                        const fw_process_wafer *before) {
    const char *in = before->with[FW_STATE_VACUUM];
    if (!before->is[FW_STATE_VACUUM] || (s->equipment && strcmp(s->equipment->id, in) == 0)) return;
    const char *from = pack->flow->step[before->since[FW_STATE_VACUUM]].id;
    fw_diag_error(pack->diags, 505, s->place,
                  "step %s is at '%s', but since step %s the wafer lies under vacuum in '%s'; vent "
                  "it: <finish kind=\"vent\"/> in step %s",
                  s->id, s->equipment ? s->equipment->id : "", from, in, from);
}

fw_status fw_process_lint_states(fw_process_pack *pack) {
    fw_process_wafer now = {0};
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        lint_carried(pack, s, &now);
        FW_TRY(lint_arrival(pack, s, &now));
        lint_residue(pack, s, &now);
        lint_hot(pack, s, &now);
        lint_pumped(pack, s, &now);
        lint_sawn(pack, s, &now);
        lint_finish(pack, s);
        fw_process_wafer_pass(pack->flow, i, &now);
        lint_meniscus(pack, s, &now);
    }
    return FW_OK;
}

/* ---- is what a step works on there, and open? ---- */

/* a removal, a conversion and an exposure need what they work on open to them; one that reaches sideways needs it open
   anywhere */
static fw_status lint_open(fw_process_pack *pack, int step, int change) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[step];
    const fw_process_change *c = &s->change[change];
    const char *on = strcmp(c->kind, "convert") == 0 ? c->from : c->material;
    fw_process_stack stack;
    /* what carried the wafer comes off with what held it, in any order */
    const bool demounts = c->back && fw_process_step_is_op(s, "release");
    if (strcmp(c->kind, "add") == 0 || demounts) return FW_OK;
    FW_TRY(fw_process_flow_stack_before(pack->arena, f, step, change, &stack));
    if (c->reach && fw_process_stack_open(f, &stack, on, c->back)) return FW_OK;
    for (int column = 0; column < stack.columns; column++) {
        char part[FW_LABEL];
        const char *by;
        const fw_process_cell *cell = fw_process_stack_find(f, &stack, column, on, c->back, &by);
        bool other = cell && cell->back && !c->back; /* of the other face */
        if (!fw_process_where_holds(f, c->where, column) || !cell || !by || other) continue;
        fw_diag_error(pack->diags, c->back ? 564 : 339, c->place,
                      c->back
                          ? "step %s works on '%s' in the %s from the back, where '%s' covers it; "
                            "take that off before, name the part where it is open (where), or "
                            "leave side=\"back\" out"
                          : "step %s works on '%s' in the %s, but there it lies below '%s'; "
                            "take that off before, or name the part where it is open (where)",
                      s->id, on, fw_process_column_name(f, column, part), by);
        return FW_OK;
    }
    return FW_OK;
}

static const char *top(const fw_process_stack *stack, int column, bool back) {
    const fw_process_cell *cell = fw_process_stack_top(stack, column, back);
    return cell ? cell->material : NULL;
}

/* metal grows on what conducts, everywhere where that lies open */
static fw_status lint_plating(fw_process_pack *pack, int step, int change) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[step];
    const fw_process_change *c = &s->change[change];
    fw_process_stack stack;
    if (!fw_process_step_is_op(s, "plate") || strcmp(c->kind, "add") != 0) return FW_OK;
    FW_TRY(fw_process_flow_stack_before(pack->arena, f, step, change, &stack));
    for (int column = 0; column < stack.columns; column++) {
        char part[FW_LABEL];
        const char *on = top(&stack, column, c->back);
        const fw_process_material *m = on ? fw_process_flow_material(f, on) : NULL;
        bool wanted = fw_process_where_holds(f, c->where, column);
        fw_process_column_name(f, column, part);
        if (wanted && (!on || (m && m->conducts == 0)))
            fw_diag_error(pack->diags, 340, c->place,
                          "step %s plates '%s' on '%s', which carries no current; a seed must lie "
                          "open in the %s",
                          s->id, c->material, on ? on : "nothing", part);
        else if (!wanted && m && m->conducts == 1)
            fw_diag_error(pack->diags, 340, c->place,
                          "step %s plates '%s' in the %s only, but '%s' lies open in the %s too "
                          "and carries current; a mould must cover it",
                          s->id, c->material, c->where, on, part);
    }
    return FW_OK;
}

fw_status fw_process_lint_reach(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        for (int k = 0; k < pack->flow->step[i].nchange; k++) {
            FW_TRY(lint_open(pack, i, k));
            FW_TRY(lint_plating(pack, i, k));
        }
    return FW_OK;
}

/* ---- what a step requires ---- */

static int step_index(const fw_process_flow *f, const char *id) {
    for (int i = 0; i < f->nstep; i++)
        if (strcmp(f->step[i].id, id) == 0) return i;
    return f->nstep;
}

/* *wrong: what is not as required, in words; NULL: all is */
static fw_status unlike(fw_process_pack *pack, int step, const fw_process_wafer *before,
                        const fw_process_requirement *r, const char **wrong) {
    const fw_process_flow *f = pack->flow;
    fw_process_stack stack;
    *wrong = NULL;
    if (r->step) {
        if (step_index(f, r->step) >= step)
            FW_NEED(*wrong = fw_arena_printf(
                        pack->arena, "step %s, which must come before it, comes later", r->step));
        return FW_OK;
    }
    if (r->state) {
        for (int k = 0; k < FW_STATES; k++)
            if (strcmp(fw_process_state_key((fw_process_state)k), r->state) == 0 &&
                before->is[k] == r->present)
                return FW_OK;
        FW_NEED(*wrong = fw_arena_printf(pack->arena, "it wants a wafer that is %s'%s'",
                                         r->present ? "" : "not ", r->state));
        return FW_OK;
    }
    FW_TRY(fw_process_flow_stack(pack->arena, f, step - 1, &stack, NULL));
    char part[FW_LABEL];
    for (int column = 0; column < stack.columns && !*wrong; column++)
        if (fw_process_where_holds(f, r->where, column) &&
            fw_process_stack_holds(&stack, column, r->material) != r->present)
            FW_NEED(*wrong = fw_arena_printf(pack->arena, "'%s' is %s in the %s", r->material,
                                             r->present ? "not there" : "still there",
                                             fw_process_column_name(f, column, part)));
    return FW_OK;
}

/* the chamber that was prepared is the next one that the wafer comes to */
static void lint_chamber(fw_process_pack *pack, const fw_process_step *s,
                         const fw_process_wafer *before) {
    const char *in = before->with[FW_STATE_SEASONED];
    if (!before->is[FW_STATE_SEASONED] || (s->equipment && strcmp(s->equipment->id, in) == 0))
        return;
    fw_diag_error(pack->diags, 345, s->place,
                  "step %s is at '%s', but since step %s the wafer sits in '%s', which was "
                  "prepared for it; do it before that step, or after what is done there",
                  s->id, s->equipment ? s->equipment->id : "",
                  pack->flow->step[before->since[FW_STATE_SEASONED]].id, in);
}

static bool makes_layer(const fw_process_step *s) {
    for (int k = 0; k < s->nchange; k++)
        if (strcmp(s->change[k].kind, "remove") != 0 && !s->change[k].back) return true;
    return false;
}

fw_status fw_process_lint_required(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_wafer now = {0};
    bool clean = false, asked = false;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        for (int k = 0; k < s->nrequired; k++) {
            const char *wrong;
            FW_TRY(unlike(pack, i, &now, &s->required[k], &wrong));
            if (wrong)
                fw_diag_error(pack->diags, 345, s->required[k].place, "step %s: %s", s->id, wrong);
        }
        lint_chamber(pack, s, &now);
        clean = clean || fw_process_step_is_op(s, "clean");
        if (!clean && !asked && !fw_process_step_is_op(s, "inspect") && makes_layer(s)) {
            asked = true;
            fw_diag_warning(pack->diags, 346, s->place,
                            "step %s is the first that works on the wafer, and no step has cleaned "
                            "it before; add one",
                            s->id);
        }
        fw_process_wafer_pass(f, i, &now);
    }
    return FW_OK;
}

/* ---- bakes ---- */

static bool has_change(const fw_process_step *s, const char *kind) {
    for (int k = 0; k < s->nchange; k++)
        if (strcmp(s->change[k].kind, kind) == 0) return true;
    return false;
}

/* a wet or dry etch of one part that a resist masks */
static bool masked_by(const fw_process_flow *f, const fw_process_step *s,
                      const fw_process_stack *stack, const char *resist) {
    for (int k = 0; k < s->nchange; k++) {
        const fw_process_change *c = &s->change[k];
        if (strcmp(c->kind, "remove") != 0 || strcmp(c->where, "all") == 0) continue;
        for (int column = 0; column < stack->columns; column++) {
            const char *mask =
                fw_process_where_holds(f, c->where, column) ? NULL : top(stack, column, c->back);
            if (mask && strcmp(mask, resist) == 0) return true;
        }
    }
    return false;
}

static const fw_quantity *heat_of(const fw_process_step *s) {
    for (int k = 0; k < s->nsetting; k++)
        if (fw_quantity_dimension_equal(s->setting[k].q->dimension,
                                        (fw_quantity_dimension){.K = 1}))
            return s->setting[k].q;
    return NULL;
}

/* what a resist has kept at its soft bake stays in it below that */
static void lint_hard(fw_process_pack *pack, const fw_process_step *s,
                      const fw_process_step *soft) {
    const fw_quantity *hard = heat_of(s), *first = heat_of(soft);
    if (!hard || !first || hard->unknown || first->unknown || hard->value >= first->value) return;
    char is[32], was[32];
    fw_diag_warning(pack->diags, 341, hard->replaced ? hard->place : s->place,
                    "step %s bakes the developed resist at %s %s, cooler than its soft bake "
                    "(%s %s in step %s): nothing more leaves it, and it holds no better; bake "
                    "hotter, or leave it out",
                    s->id, fw_number_text(is, sizeof is, fw_quantity_in_unit(hard), 4), hard->unit,
                    fw_number_text(was, sizeof was, fw_quantity_in_unit(first), 4), first->unit,
                    soft->id);
}

typedef struct baked {
    bool dehydrated;             /* baked since it was last wet, or new */
    bool hard;                   /* the resist was baked after it was developed */
    const char *resist;          /* spun on last; NULL: none */
    const fw_process_step *soft; /* its soft bake; NULL: none yet */
    bool developed;
} baked;

static fw_status lint_bake(fw_process_pack *pack, int i, const fw_process_wafer *before, baked *b) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[i];
    bool etches = fw_process_step_is_op(s, "wet-etch") || fw_process_step_is_op(s, "dry-etch"),
         coats = fw_process_step_is_op(s, "coat");
    if (before->is[FW_STATE_UNBAKED] &&
        (has_change(s, "pattern") || etches || coats || fw_process_step_is_op(s, "develop")))
        fw_diag_error(pack->diags, 341, s->place,
                      "step %s takes '%s' that no step has baked since step %s; add a soft bake "
                      "between them",
                      s->id, before->with[FW_STATE_UNBAKED],
                      f->step[before->since[FW_STATE_UNBAKED]].id);
    if (before->is[FW_STATE_IMAGE] && has_change(s, "pattern"))
        fw_diag_warning(
            pack->diags, 506, s->place,
            "step %s exposes '%s', which step %s has exposed and nobody has developed: both "
            "doses add up; leave one out, or develop between them",
            s->id, before->with[FW_STATE_IMAGE], f->step[before->since[FW_STATE_IMAGE]].id);
    if (coats && !b->dehydrated)
        fw_diag_warning(pack->diags, 341, s->place,
                        "step %s spins a resist on a wafer that was not baked since it was last "
                        "wet: it holds badly; add a dehydration bake before it",
                        s->id);
    if (etches && b->resist && !b->hard) {
        fw_process_stack stack;
        FW_TRY(fw_process_flow_stack(pack->arena, f, i - 1, &stack, NULL));
        if (masked_by(f, s, &stack, b->resist))
            fw_diag_warning(pack->diags, 341, s->place,
                            "step %s etches through '%s' that was not baked since it was "
                            "developed: it lifts or flows; add a hard bake before it",
                            s->id, b->resist);
    }
    if (fw_process_step_is_op(s, "bake") && b->developed && b->soft) lint_hard(pack, s, b->soft);
    if (fw_process_step_is_op(s, "bake") && before->is[FW_STATE_UNBAKED]) b->soft = s;
    for (int k = 0; coats && k < s->nchange; k++)
        if (strcmp(s->change[k].kind, "add") == 0) b->resist = s->change[k].material;
    if (coats || fw_process_step_is_op(s, "strip")) b->developed = false, b->soft = NULL;
    if (fw_process_step_is_op(s, "develop")) b->hard = false, b->developed = true;
    if (fw_process_step_is_op(s, "bake")) b->dehydrated = b->hard = true;
    if (fw_process_step_in_liquid(s) && !fw_process_step_is_op(s, "develop")) b->dehydrated = false;
    return FW_OK;
}

/* Metal on a resist is lifted off with it: hard-baked, its edges have flowed to slopes that the metal closes over, and
   solvents hardly take it. Test: test_lint.c, flows_of_wrong_steps. */
static fw_status lint_lifted_hard(fw_process_pack *pack, int i, const baked *b) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[i];
    fw_process_stack stack;
    if (!b->resist || !b->hard || !b->developed || !fw_process_step_is_op(s, "deposit"))
        return FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, i - 1, &stack, NULL));
    for (int k = 0; k < s->nchange; k++)
        for (int column = 0; column < stack.columns; column++) {
            const char *on = top(&stack, column, s->change[k].back);
            if (strcmp(s->change[k].kind, "add") != 0 || !on || strcmp(on, b->resist) != 0 ||
                !fw_process_where_holds(f, s->change[k].where, column))
                continue;
            fw_diag_warning(pack->diags, 630, s->change[k].place,
                            "step %s puts '%s' on '%s' that was baked since it was developed: its "
                            "edges have flowed, metal closes over them, and it lifts off badly; "
                            "leave the hard bake out",
                            s->id, s->change[k].material, b->resist);
            return FW_OK;
        }
    return FW_OK;
}

fw_status fw_process_lint_bakes(fw_process_pack *pack) {
    fw_process_wafer now = {0};
    baked b = {0};
    for (int i = 0; i < pack->flow->nstep; i++) {
        FW_TRY(lint_lifted_hard(pack, i, &b));
        FW_TRY(lint_bake(pack, i, &now, &b));
        fw_process_wafer_pass(pack->flow, i, &now);
    }
    return FW_OK;
}

/* ---- the end ---- */

static void lint_end_layer(fw_process_pack *pack, const fw_process_stack *stack,
                           const char *material, const char *where, bool present, fw_place place) {
    for (int column = 0; column < stack->columns; column++) {
        char part[FW_LABEL];
        if (!fw_process_where_holds(pack->flow, where, column) ||
            fw_process_stack_holds(stack, column, material) == present)
            continue;
        fw_diag_error(pack->diags, 338, place,
                      present ? "the flow ends without '%s' in the %s; a step that makes it is "
                                "missing, or one takes it off that should not"
                              : "the flow ends with '%s' still in the %s; a step that takes it off "
                                "is missing",
                      material, fw_process_column_name(pack->flow, column, part));
        return;
    }
}

static fw_status lint_end_state(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_wafer *after;
    FW_TRY(fw_process_flow_wafers(pack->arena, f, &after));
    const fw_process_wafer *last = &after[f->nstep - 1];
    for (int state = 0; state < FW_STATES; state++) {
        if (!last->is[state]) continue;
        const char *is = fw_process_wafer_words(pack->arena, f, last, (fw_process_state)state);
        FW_NEED(is);
        fw_diag_error(pack->diags, 338, f->step[f->nstep - 1].place,
                      "the flow ends with wafers %s (since step %s): %s", is,
                      f->step[last->since[state]].id,
                      fw_process_state_why((fw_process_state)state));
    }
    return FW_OK;
}

/* the lowest of a column that the device hangs on: what touches below it, down to where nothing does or an etch runs
   sideways; NULL: it hangs on nothing, or is the wafer itself */
static const char *hangs_on(const fw_process_flow *f, const fw_process_cell *cell, int i,
                            bool *insulated) {
    if (i == 0) return NULL;
    for (; i > 0; i--) {
        const fw_process_cell *c = &cell[i], *on = c - 1;
        const fw_process_material *m = fw_process_flow_material(f, on->material);
        if (on->bottom + on->height < c->bottom - 1e-9 || on->back) return NULL;
        *insulated = *insulated || (m && m->conducts == 0);
        if (fw_process_flow_runs_below(f, on->material)) return NULL;
    }
    return cell[0].material;
}

/* Somewhere the device has nothing below it: a hollow, a layer that was taken away, or a way that an etch runs sideways.
   And where the pack says that its carrier insulates, something that carries no current is below it. */
static void lint_end_below(fw_process_pack *pack, const fw_process_stack *stack) {
    const fw_process_flow *f = pack->flow;
    const char *bonded = NULL;
    bool free = false, insulated = false;
    for (int column = 0; f->material && column < stack->columns; column++)
        for (int i = 0; i < stack->n[column]; i++) {
            const fw_process_cell *cell = stack->cell[column];
            if (strcmp(cell[i].material, f->material) != 0) continue;
            const char *on = hangs_on(f, cell, i, &insulated);
            if (on) bonded = on;
            free = free || !on;
            break;
        }
    if (bonded && !free)
        fw_diag_error(
            pack->diags, 338, f->place,
            "the flow ends with '%s' bonded to '%s' everywhere: nothing frees the device; "
            "etch away what is below it (reach=\"...\" of a removal), or hollow it out",
            f->material, bonded);
    if (f->insulating && !insulated)
        fw_diag_warning(
            pack->diags, 338, f->place,
            "carrier=\"insulating\", but nothing that carries no current lies below the "
            "device when the flow ends: whatever it is put on must insulate");
}

/* a finished wafer is dry and safe, has its device and no resist, and what <finished> says */
fw_status fw_process_lint_end(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_stack stack;
    if (f->nstep == 0) return FW_OK;
    FW_TRY(lint_end_state(pack));
    FW_TRY(fw_process_flow_stack(pack->arena, f, f->nstep - 1, &stack, NULL));
    for (int i = 0; i < f->nfinished; i++)
        lint_end_layer(pack, &stack, f->finished[i].material, f->finished[i].where,
                       f->finished[i].present, f->finished[i].place);
    if (f->material) lint_end_layer(pack, &stack, f->material, "structure", true, f->place);
    lint_end_below(pack, &stack);
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; fw_process_step_is_op(&f->step[i], "coat") && k < f->step[i].nchange; k++)
            if (strcmp(f->step[i].change[k].kind, "add") == 0)
                lint_end_layer(pack, &stack, f->step[i].change[k].material, "all", false,
                               f->step[i].place);
    return FW_OK;
}
