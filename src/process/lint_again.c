/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What goes wrong when something is done twice, or for another layer than the one that lies there: a hollow etched
   twice, a second carrier, a second coat that the bake is not timed for. Each question is a function here and a row in
   lint.c. Generated test: tests/process/orders.py, every step once more right behind itself and at the end of its phase;
   test_lint.c does_not_again_what_harms. */
#include "base/constants.h"
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
        const fw_process_cell *on = fw_process_stack_top(&stack, column, c->back);
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

/* the side that it was spun on last before step `at` */
static bool coated_back(const fw_process_flow *f, int at, const char *resist) {
    bool back = false;
    for (int i = 0; i < at; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (strcmp(c->kind, "add") == 0 && strcmp(c->material, resist) == 0) back = c->back;
        }
    return back;
}

/* In all columns alike, since nothing has opened it yet; m, NaN where a coat is not known */
static double coated_m(const fw_process_stack *stack, const char *resist, bool back) {
    double sum = 0.0;
    for (int i = 0; i < stack->n[FW_STACK_FIELD]; i++)
        if (strcmp(stack->cell[FW_STACK_FIELD][i].material, resist) == 0 &&
            stack->cell[FW_STACK_FIELD][i].back == back)
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
            double lies_m = coated_m(&stack, resist, coated_back(f, i, resist));
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

/* ---- is a step what it says that it is? ---- */

static const fw_process_step *opens_next(const fw_process_flow *f, int from, const char *material,
                                         const fw_process_change **by) {
    for (int i = from; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (strcmp(c->material, material) != 0 || strcmp(c->kind, "remove") != 0) continue;
            *by = c;
            return fw_process_step_is_op(&f->step[i], "develop") ? &f->step[i] : NULL;
        }
    return NULL;
}

/* light names the part that the developer opens: the plate's tone and the resist's are both in it */
static void lint_opened(fw_process_pack *pack, int i) {
    const fw_process_step *s = &pack->flow->step[i];
    for (int k = 0; k < s->nchange; k++) {
        const fw_process_change *c = &s->change[k], *by = NULL;
        if (strcmp(c->kind, "pattern") != 0) continue;
        const fw_process_step *opens = opens_next(pack->flow, i + 1, c->material, &by);
        if (opens && strcmp(by->where, c->where) != 0)
            fw_diag_error(
                pack->diags, 559, by->place,
                "step %s develops '%s' in the part '%s', but step %s exposes it for the part "
                "'%s'; name the same part in both",
                opens->id, c->material, by->where, s->id, c->where);
    }
}

static const fw_quantity *timed_for(const fw_process_step *s) {
    const fw_quantity *thickness = fw_process_step_argument(s, "thickness");
    return thickness ? thickness : fw_process_step_argument(s, "depth");
}

/* the one thickness that a step adds, converts or takes away is what its time is computed for; an etch that goes deeper
   than it is timed for is told by what lies there (FW-D349), a release by how far it reaches */
static void lint_timed(fw_process_pack *pack, const fw_process_step *s) {
    const fw_quantity *timed = timed_for(s), *stated = NULL;
    char is[32], by[32];
    for (int k = 0; k < s->nchange; k++) {
        const fw_process_change *c = &s->change[k];
        const fw_quantity *of = c->reach ? c->reach : c->thickness;
        if (!of) continue;
        if (stated) return;
        if (c->reach && timed && timed != of &&
            !(timed->id && of->id && strcmp(timed->id, of->id) == 0))
            fw_diag_error(pack->diags, 561, s->place,
                          "the time of step %s is computed for '%s', but the step reaches '%s' "
                          "sideways; name the same quantity in its <time> and its <change>",
                          s->id, timed->id, of->id);
        if (c->reach) return;
        stated = of;
    }
    if (!timed || !stated || timed->unknown || stated->unknown ||
        fabs(timed->value - stated->value) <= 1e-6 * stated->value)
        return;
    fw_diag_error(
        pack->diags, 561, s->place,
        "the time of step %s is computed for %s um (%s), but the step is of %s um (%s); name "
        "the same quantity in its <time> and its <change>",
        s->id, fw_number_text(is, sizeof is, 1e6 * timed->value, 4), timed->id,
        fw_number_text(by, sizeof by, 1e6 * stated->value, 4), stated->id);
}

static bool on_the_wafer(const fw_process_stack *stack, const char *material) {
    bool there = false;
    for (int column = 0; column < stack->columns; column++)
        there = there || fw_process_stack_holds(stack, column, material);
    return there;
}

/* A step that is done again works on what is still there: nothing exposes a resist that was stripped long before.
   What comes on at the step itself, or before it in its own changes, needs not be there. */
static fw_status lint_redone(fw_process_pack *pack, int at, int again,
                             const fw_process_on_fail *f) {
    const fw_process_step *s = &pack->flow->step[again];
    fw_process_stack before, after;
    FW_TRY(fw_process_flow_stack(pack->arena, pack->flow, at - 1, &before, NULL));
    FW_TRY(fw_process_flow_stack(pack->arena, pack->flow, at, &after, NULL));
    for (int k = 0; k < s->nchange; k++) {
        const fw_process_change *c = &s->change[k];
        const char *on = strcmp(c->kind, "convert") == 0 ? c->from : c->material;
        if (strcmp(c->kind, "add") == 0) return FW_OK;
        if (!on[0] || on_the_wafer(&before, on) || on_the_wafer(&after, on)) continue;
        fw_diag_error(
            pack->diags, 276, pack->flow->step[at].place,
            "<on-fail if=\"%s\"> of step %s goes on with step %s, which works on '%s', and "
            "that is not on the wafer any more; go back to where it is put on",
            f->condition, pack->flow->step[at].id, s->id, on);
        return FW_OK;
    }
    return FW_OK;
}

static fw_status lint_reworks(fw_process_pack *pack, int at) {
    const fw_process_flow *f = pack->flow;
    for (int k = 0; k < f->step[at].non_fail; k++)
        for (int j = 0; j < at; j++)
            if (strcmp(f->step[at].on_fail[k].go_to, f->step[j].id) == 0)
                FW_TRY(lint_redone(pack, at, j, &f->step[at].on_fail[k]));
    return FW_OK;
}

/* what a kind of step does to the wafer, of which it has at least one */
static void lint_op(fw_process_pack *pack, const fw_process_step *s) {
    static const struct {
        const char *op, *kind;
    } does[] = {{"coat", "add"},       {"deposit", "add"},     {"plate", "add"},
                {"displace", "add"},   {"bond", "add"},        {"expose", "pattern"},
                {"develop", "remove"}, {"wet-etch", "remove"}, {"dry-etch", "remove"},
                {"anodise", "convert"}};
    for (size_t i = 0; i < sizeof does / sizeof does[0]; i++) {
        bool has = false;
        for (int k = 0; k < s->nchange; k++)
            has = has || strcmp(s->change[k].kind, does[i].kind) == 0;
        if (fw_process_step_is_op(s, does[i].op) && !has)
            fw_diag_error(pack->diags, 562, s->place,
                          "step %s (%s) changes nothing in the way of its kind; add its <change "
                          "kind=\"%s\">, or correct op",
                          s->id, s->op, does[i].kind);
    }
    for (int k = 0; k < s->nchange; k++) /* wafers come in with an inspection */
        if (fw_process_step_is_op(s, "inspect") && strcmp(s->change[k].kind, "add") != 0)
            fw_diag_error(pack->diags, 562, s->change[k].place,
                          "step %s (inspect) changes the wafer; what only measures does not: "
                          "correct op, or leave the <change> out",
                          s->id);
}

/* Below the least speed resist does not level within its spin time, above the largest no chuck holds the wafer; spinners
   of laboratories turn at 100 to 12 000 rpm. */
static void lint_spin(fw_process_pack *pack, const fw_process_step *s) {
    const double rpm = FW_TURN / 60, least = 100 * rpm, most = 12000 * rpm;
    if (!s->law || strcmp(s->law, "spin") != 0) return;
    const fw_quantity *const q[4] = {fw_process_step_argument(s, "thickness"),
                                     fw_process_step_argument(s, "reference_thickness"),
                                     fw_process_step_argument(s, "reference_speed"),
                                     fw_process_step_argument(s, "exponent")};
    for (int k = 0; k < 4; k++)
        if (!q[k] || q[k]->unknown || !(q[k]->value > 0)) return;
    const double speed = q[2]->value * pow(q[1]->value / q[0]->value, 1 / q[3]->value);
    if (speed >= least && speed <= most) return;
    char at[32], um[32];
    fw_diag_error(
        pack->diags, 563, q[0]->replaced ? q[0]->place : s->place,
        "step %s would spin at %s rpm for %s um (%s) by its spin curve, and spinners turn at 100 "
        "to 12000 rpm; take a resist for that thickness, or several coats",
        s->id, fw_number_text(at, sizeof at, speed / rpm, 3),
        fw_number_text(um, sizeof um, 1e6 * q[0]->value, 4), q[0]->id);
}

bool fw_process_step_sets(const fw_process_step *s, const fw_quantity *q) {
    for (int k = 0; k < s->nsetting; k++)
        if (s->setting[k].q == q) return true;
    return false;
}

/* Liquids take all directions alike, but for bases in silicon, whose planes they find. */
static void lint_profile(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_hazard *in = fw_process_step_liquid(s);
    if (!in || !fw_process_step_in_liquid(s)) return;
    for (int k = 0; k < s->nchange; k++) {
        const fw_process_change *c = &s->change[k];
        if (strcmp(c->kind, "remove") != 0 || !c->anisotropy) continue;
        if (fw_words_hold(in->reacts_as, " ", "base") && strncmp(c->material, "silicon", 7) == 0)
            continue;
        fw_diag_error(pack->diags, 540, c->place,
                      "step %s etches '%s' in '%s' and calls that anisotropic, but this bath takes "
                      "as much sideways as down; write profile=\"isotropic\"",
                      s->id, c->material, in->id);
    }
}

/* does the time of a step go by q, by what the step derives on the way, too? */
static bool goes_by(const fw_process_step *s, const fw_quantity *q) {
    for (int i = 0; i < s->nargument; i++) {
        if (s->argument[i].q == q) return true;
        for (int k = 0; k < s->nderive; k++)
            for (int j = 0; s->derive[k].q == s->argument[i].q && j < s->derive[k].nargument; j++)
                if (s->derive[k].argument[j].q == q) return true;
    }
    return false;
}

/* an etch that runs sideways until its reach is run, whatever step does it; false: said */
static bool lint_run(fw_process_pack *pack, const fw_process_step *s) {
    for (int k = 0; k < s->nchange; k++) {
        const fw_quantity *reach = s->change[k].reach;
        if (!reach || goes_by(s, reach)) continue;
        fw_diag_error(pack->diags, 541, s->place,
                      "step %s (%s) runs sideways until '%s' is run, and its time goes by '%s' "
                      "alone, however far that is; write the law \"rate\" with that reach as its "
                      "thickness and its rate sideways, unknown where nobody knows it, and give a "
                      "time to plan with by --planned",
                      s->id, s->op, reach->id, s->nargument ? s->argument[0].q->id : "its law");
        return false;
    }
    return true;
}

/* A layer that is etched or plated by a clock that does not know its thickness: no window, no over-etch, and no other
   time for another thickness. */
static void lint_clock(fw_process_pack *pack, const fw_process_step *s) {
    static const char by_rate[] = "anodise dry-etch plate wet-etch";
    const fw_process_law *law = fw_process_law_find(s->law);
    if (!lint_run(pack, s) || !law || !law->stated || !fw_words_hold(by_rate, " ", s->op)) return;
    for (int k = 0; k < s->nchange; k++)
        if (s->change[k].thickness || s->change[k].reach) {
            const bool current =
                fw_process_step_is_op(s, "plate") || fw_process_step_is_op(s, "anodise");
            fw_diag_error(
                pack->diags, 541, s->place,
                "step %s (%s) takes the time '%s', whatever the thickness '%s' is; write the law "
                "%s with its %s, unknown where nobody knows it, and give a time to plan with by "
                "--planned",
                s->id, s->op, s->nargument ? s->argument[0].q->id : "",
                s->change[k].thickness ? s->change[k].thickness->id : s->change[k].reach->id,
                current ? "\"faraday\"" : "\"rate\" or \"arrhenius\"",
                current ? "current density" : "rate");
            return;
        }
}

/* a plasma is set by its pressure before anything else; a value that nobody knows is a blank on the sheet */
static void lint_plasma(fw_process_pack *pack, const fw_process_step *s) {
    const fw_quantity_dimension pressure = FW_DIM(-1, 1, -2, 0, 0, 0, 0);
    const fw_quantity *q = NULL;
    if (!fw_process_step_is_op(s, "dry-etch")) return;
    for (int k = 0; k < s->nsetting; k++)
        if (fw_quantity_dimension_equal(s->setting[k].q->dimension, pressure)) q = s->setting[k].q;
    if (q && !q->unknown && !(q->value >= 1e-3 && q->value <= 5000.0))
        fw_diag_error(pack->diags, 278, q->replaced ? q->place : s->place,
                      "step %s (dry-etch) is set to %s Pa (%s), but a plasma that etches a wafer "
                      "evenly burns between 0.001 and 5000 Pa; is the unit right?",
                      s->id, fw_number_text((char[32]){0}, 32, q->value, 4), q->id);
    if (q) return;
    fw_diag_error(pack->diags, 542, s->place,
                  "step %s (dry-etch) does not say at which pressure: nobody can run it, and its "
                  "rate means nothing; add a <set> of it, with an unknown value if need be",
                  s->id);
}

/* a setting that is called by its kind is of that kind: "bath temperature" is none of minutes */
static void lint_called(fw_process_pack *pack, const fw_process_step *s) {
    static const struct {
        const char *word;
        fw_quantity_dimension kind;
    } called[] = {{"temperature", {.K = 1}},
                  {"pressure", {.m = -1, .kg = 1, .s = -2}},
                  {"power", {.m = 2, .kg = 1, .s = -3}},
                  {"voltage", {.m = 2, .kg = 1, .s = -3, .A = -1}},
                  {"current density", {.m = -2, .A = 1}},
                  {"diameter", {.m = 1}},
                  {"thickness", {.m = 1}}};
    for (int k = 0; k < s->nsetting; k++)
        for (size_t i = 0; i < sizeof called / sizeof *called; i++) {
            const fw_process_setting *set = &s->setting[k];
            const size_t n = strlen(set->name), w = strlen(called[i].word);
            if (n < w || strcmp(set->name + n - w, called[i].word) != 0 ||
                (n > w && set->name[n - w - 1] != ' ') ||
                fw_quantity_dimension_equal(set->q->dimension, called[i].kind))
                continue;
            fw_diag_error(pack->diags, 548, set->place,
                          "step %s sets a '%s' to '%s', which is in %s; name the quantity that is "
                          "meant, or call the setting what it is",
                          s->id, set->name, set->q->id, set->q->unit);
        }
}

/* a step that is done in parts: of a second at least, else pauses never end */
static void lint_parted_time(fw_process_pack *pack, const fw_process_step *s) {
    if (s->pulse && !s->pulse->unknown && s->pulse->value < 1.0)
        fw_diag_error(pack->diags, 278, s->pulse->replaced ? s->pulse->place : s->place,
                      "step %s is done in parts of less than a second (%s); give the time between "
                      "two pauses",
                      s->id, s->pulse->id);
}

static bool says_nothing(const char *text) {
    return !text || text[strspn(text, " \t\r\n")] == '\0';
}

/* what people read: what a step is, what for, and how its end is seen */
static void lint_words(fw_process_pack *pack, const fw_process_step *s) {
    const char *empty = says_nothing(s->title)     ? "title"
                        : says_nothing(s->purpose) ? "purpose"
                                                   : NULL;
    for (int k = 0; k < s->nendpoint; k++)
        if (says_nothing(s->endpoint[k])) empty = "endpoint";
    for (int k = 0; k < s->naccept; k++)
        if (says_nothing(s->accept[k].measure)) empty = "measure of an <accept>";
    for (int k = 0; k < s->non_fail; k++)
        if (says_nothing(s->on_fail[k].condition)) empty = "condition of an <on-fail>";
    if (empty)
        fw_diag_error(pack->diags, 171, s->place,
                      "step %s: its %s says nothing, and whoever stands there reads it on the "
                      "sheet; write it",
                      s->id, empty);
}

fw_status fw_process_lint_kind(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        lint_opened(pack, i);
        lint_timed(pack, s);
        lint_op(pack, s);
        lint_spin(pack, s);
        lint_profile(pack, s);
        lint_clock(pack, s);
        lint_plasma(pack, s);
        lint_called(pack, s);
        lint_parted_time(pack, s);
        lint_words(pack, s);
        FW_TRY(lint_reworks(pack, i));
    }
    return FW_OK;
}
