/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What goes wrong when something is done twice, or for another layer than the one that lies there: a hollow etched
   twice, a second carrier, a second coat that the bake is not timed for. Each question is a function here and a row in
   lint.c. Generated test: tests/process/orders.py, every step once more right behind itself and at the end of its phase;
   test_lint.c does_not_again_what_harms. */
#include "base/text.h"
#include "process/films.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

static fw_status is_there(fw_process_pack *pack, int step, int change, const char *material,
                          bool *there) {
    fw_process_stack stack;
    *there = false;
    FW_TRY(fw_process_flow_stack_before(pack->arena, pack->flow, step, change, &stack));
    for (int column = 0; column < stack.columns; column++)
        *there = *there || fw_process_stack_holds(&stack, column, material);
    return FW_OK;
}

/* Films grow on films of their own kind; wafers, carriers, wax and paste come once. */
static fw_status lint_second(fw_process_pack *pack, int i, int k) {
    static const char grow[] = "deposit coat displace plate";
    const fw_process_step *s = &pack->flow->step[i];
    const fw_process_change *c = &s->change[k];
    bool there;
    if (strcmp(c->kind, "add") != 0 || fw_words_hold(grow, " ", s->op)) return FW_OK;
    FW_TRY(is_there(pack, i, k, c->material, &there));
    if (there)
        fw_diag_error(pack->diags, 520, c->place,
                      "step %s (%s) puts '%s' where it lies already; leave the step out, or take "
                      "off the first before it",
                      s->id, s->op, c->material);
    return FW_OK;
}

/* Displacement: metal ions take their electrons from what they cover, so that a closed film ends it. */
static fw_status lint_displaced(fw_process_pack *pack, int i, int k) {
    const fw_process_flow *f = pack->flow;
    const fw_process_change *c = &f->step[i].change[k];
    fw_process_stack stack;
    if (!fw_process_step_is_op(&f->step[i], "displace") || strcmp(c->kind, "add") != 0)
        return FW_OK;
    FW_TRY(fw_process_flow_stack_before(pack->arena, f, i, k, &stack));
    for (int column = 0; column < stack.columns; column++) {
        const fw_process_cell *on = fw_process_stack_top(&stack, column);
        if (!on || !fw_process_where_holds(f, c->where, column) ||
            strcmp(on->material, c->material) != 0)
            continue;
        fw_diag_error(pack->diags, 521, c->place,
                      "step %s deposits '%s' by displacement on '%s' itself, which gives it no "
                      "electrons; leave the step out, or strip the first film before it",
                      f->step[i].id, c->material, c->material);
        return FW_OK;
    }
    return FW_OK;
}

/* ---- a depth that is etched into a layer ---- */

static bool same_depth(const fw_process_change *a, const fw_process_change *b) {
    return strcmp(a->kind, "remove") == 0 && strcmp(b->kind, "remove") == 0 && a->thickness &&
           a->thickness == b->thickness && strcmp(a->material, b->material) == 0;
}

/* Two removals of one quantity, of one material, in one part of the wafer, that both leave something of it: the depths
   add up. Two depths that are meant are two quantities. */
static fw_status lint_depth(fw_process_pack *pack, int i, int k) {
    const fw_process_flow *f = pack->flow;
    const fw_process_change *c = &f->step[i].change[k];
    fw_process_stack stack;
    if (strcmp(c->kind, "remove") != 0 || !c->thickness || c->reach) return FW_OK;
    FW_TRY(fw_process_flow_stack_before(pack->arena, f, i, k + 1, &stack));
    for (int j = 0; j < i; j++)
        for (int l = 0; l < f->step[j].nchange; l++) {
            const fw_process_change *first = &f->step[j].change[l];
            bool both = false;
            for (int column = 0; column < stack.columns && same_depth(first, c); column++)
                both = both || (fw_process_where_holds(f, c->where, column) &&
                                fw_process_where_holds(f, first->where, column) &&
                                fw_process_stack_holds(&stack, column, c->material));
            if (!both) continue;
            fw_diag_error(pack->diags, 522, c->place,
                          "step %s etches the depth '%s' into '%s' where step %s has etched it "
                          "already: the depths add up; leave one out, or give the second depth a "
                          "quantity of its own",
                          f->step[i].id, c->thickness->id, c->material, f->step[j].id);
            return FW_OK;
        }
    return FW_OK;
}

fw_status fw_process_lint_again(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            FW_TRY(lint_second(pack, i, k));
            FW_TRY(lint_displaced(pack, i, k));
            FW_TRY(lint_depth(pack, i, k));
        }
    return FW_OK;
}

/* ---- is the resist as thick as its bake and its dose are computed for? ---- */

static const fw_quantity *thickness_of(const fw_process_argument *argument, int n) {
    for (int i = 0; i < n; i++)
        if (strcmp(argument[i].name, "thickness") == 0) return argument[i].q;
    return NULL;
}

/* the resist that the step treats as a whole: bakes, lets rest, exposes; NULL: it does not */
static const char *treated(const fw_process_step *s, const fw_process_wafer *before) {
    for (int k = 0; k < s->nchange; k++)
        if (strcmp(s->change[k].kind, "pattern") == 0) return s->change[k].material;
    if (fw_process_step_is_op(s, "bake") && before->is[FW_STATE_UNBAKED])
        return before->with[FW_STATE_UNBAKED];
    if (fw_process_step_is_op(s, "hold") && before->is[FW_STATE_COATED])
        return before->with[FW_STATE_COATED];
    return NULL;
}

/* In all columns alike, since nothing has opened it yet; m, NaN where a coat is not known */
static double coated_m(const fw_process_stack *stack, const char *resist) {
    double sum = 0.0;
    for (int i = 0; i < stack->n[FW_STACK_FIELD]; i++)
        if (strcmp(stack->cell[FW_STACK_FIELD][i].material, resist) == 0)
            sum += stack->cell[FW_STACK_FIELD][i].thickness_m;
    return sum;
}

static void compare_coat(fw_process_pack *pack, const fw_process_step *s, const char *resist,
                         double lies_m, const fw_quantity *q) {
    /* a second coat comes out 0.9 to 1.1 times as thick as the first, so that two coats are known to 5 % */
    const double slack = 0.1;
    if (!q || q->unknown || !(lies_m > 0.0) || fabs(lies_m - q->value) <= slack * q->value) return;
    char is[32], timed[32];
    fw_diag_error(pack->diags, 523, q->replaced ? q->place : s->place,
                  "step %s is computed for %s um of '%s' (%s), but %s um lie there; correct the "
                  "coats or that thickness",
                  s->id, fw_number_text(timed, sizeof timed, 1e6 * q->value, 4), resist, q->id,
                  fw_number_text(is, sizeof is, 1e6 * lies_m, 4));
}

fw_status fw_process_lint_coats(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_wafer now = {0};
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        const char *resist = treated(s, &now);
        if (resist) {
            fw_process_stack stack;
            FW_TRY(fw_process_flow_stack(pack->arena, f, i - 1, &stack, NULL));
            double lies_m = coated_m(&stack, resist);
            compare_coat(pack, s, resist, lies_m, thickness_of(s->argument, s->nargument));
            for (int k = 0; k < s->nderive; k++)
                compare_coat(pack, s, resist, lies_m,
                             thickness_of(s->derive[k].argument, s->derive[k].nargument));
        }
        fw_process_wafer_pass(f, i, &now);
    }
    return FW_OK;
}

/* ---- a bake too many ---- */

/* heat decomposes what makes a resist sensitive: one soft bake before the exposure, at most one bake of the image */
fw_status fw_process_lint_baked(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_wafer now = {0};
    int image_baked = -1;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        bool bakes = fw_process_step_is_op(s, "bake"), image = now.is[FW_STATE_IMAGE];
        int first = now.is[FW_STATE_COATED] && !now.is[FW_STATE_UNBAKED]
                        ? now.since[FW_STATE_COATED]
                    : image ? image_baked
                            : -1;
        if (bakes && first >= 0)
            fw_diag_warning(pack->diags, 524, s->place,
                            "step %s bakes '%s' once more, which step %s has baked: its dose and "
                            "its developing time are those of one bake; leave one out",
                            s->id, now.with[image ? FW_STATE_IMAGE : FW_STATE_COATED],
                            f->step[first].id);
        fw_process_wafer_pass(f, i, &now);
        image_baked = !now.is[FW_STATE_IMAGE] ? -1 : bakes && image ? i : image_baked;
    }
    return FW_OK;
}

/* ---- does the flow make the thickness that it names? ---- */

fw_status fw_process_lint_made(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_stack stack;
    if (!f->thickness || f->thickness->unknown || !f->material) return FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, f->nstep - 1, &stack, NULL));
    double sum = 0.0;
    for (int i = 0; i < stack.n[FW_STACK_STRUCTURE]; i++)
        if (strcmp(stack.cell[FW_STACK_STRUCTURE][i].material, f->material) == 0)
            sum += stack.cell[FW_STACK_STRUCTURE][i].thickness_m;
    if (!(sum > 0.0) || fabs(sum - f->thickness->value) <= 1e-6 * f->thickness->value) return FW_OK;
    char is[32], wants[32];
    fw_diag_error(pack->diags, 525, f->place,
                  "the steps leave %s um of '%s', but the device layer is %s um thick (%s); "
                  "correct the steps, or that thickness",
                  fw_number_text(is, sizeof is, 1e6 * sum, 4), f->material,
                  fw_number_text(wants, sizeof wants, 1e6 * f->thickness->value, 4),
                  f->thickness->id);
    return FW_OK;
}

/* ---- what is prepared is used, and what is wet is said to be ---- */

/* a cell or a jig that the wafer is put into belongs to the next step */
static void lint_mounted(fw_process_pack *pack, int i) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[i], *next = i + 1 < f->nstep ? s + 1 : NULL;
    if (!fw_process_step_is_op(s, "mount") || s->nchange > 0 || !s->equipment ||
        s->equipment->vacuum || (next && next->equipment == s->equipment))
        return;
    fw_diag_warning(pack->diags, 526, s->place,
                    "step %s mounts the wafer at '%s', and %s%s does not use it; leave the step "
                    "out, or put it before the one that it is for",
                    s->id, s->equipment->id, next ? "step " : "nothing", next ? next->id : "");
}

/* these are always done in a liquid: which one decides on gloves, rinse, bench and waste */
static void lint_liquid(fw_process_pack *pack, const fw_process_step *s) {
    static const char wet[] = "anodise displace develop plate wet-etch";
    if (!fw_words_hold(wet, " ", s->op) || fw_process_step_liquid(s)) return;
    fw_diag_error(pack->diags, 527, s->place,
                  "step %s (%s) is done in a liquid, and none of its hazards is one; add the "
                  "<hazard-ref> of its bath",
                  s->id, s->op);
}

fw_status fw_process_lint_prepared(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        lint_mounted(pack, i);
        lint_liquid(pack, &pack->flow->step[i]);
    }
    return FW_OK;
}
