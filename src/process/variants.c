/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ways in which a flow may be run, and the flow of one device: alternatives that a laboratory chose are put in their
   places, what the device does not need is taken out, and every other way is asked the same questions, so that whoever
   needs it next finds it sound. And a step as it was run with other settings. */
#include "base/text.h"
#include "process/calibrate.h"
#include "process/pack.h"
#include "process/process_law.h"
#include <math.h>
#include <string.h>

/* ---- other ways of doing a step ----
   <alternative> holds a whole <step> with the id of the one whose place it takes when a laboratory pack says
   <choose alternative="...">. It is put there before anything is read from the steps, so that every check, time and picture
   is of the flow as it is run. */

static fw_xml_record *step_of(const fw_xml_record *root, const char *id, fw_xml_record **before) {
    *before = NULL;
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (fw_xml_is(e, "step") && strcmp(fw_process_pack_text(e, "id"), id) == 0)
            return (fw_xml_record *)e;
        *before = (fw_xml_record *)e;
    }
    return NULL;
}

static const fw_xml_record *inner_step(const fw_xml_record *alternative) {
    for (const fw_xml_record *e = alternative->first_child; e; e = e->next)
        if (fw_xml_is(e, "step")) return e;
    return NULL;
}

static void put(const fw_xml_record *root, fw_xml_record *step, fw_xml_record *old,
                fw_xml_record *before) {
    step->next = old->next;
    if (before)
        before->next = step;
    else
        ((fw_xml_record *)root)->first_child = step;
}

/* <alternative>s of the flow, each with its step; mistakes are FW-D375 */
static fw_status list(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    size_t most = (size_t)fw_xml_children(pack->root, "alternative");
    FW_NEED(f->alternative = fw_arena_array(pack->arena, fw_process_alternative, most));
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "alternative")) continue;
        const fw_xml_record *step = inner_step(e);
        fw_xml_record *before;
        fw_process_alternative a = {.id = fw_process_pack_text(e, "id"),
                                    .title = fw_process_pack_text(e, "title"),
                                    .step = step ? fw_process_pack_text(step, "id") : "",
                                    .place = e->element->place};
        for (int i = 0; i < f->nalternative; i++)
            if (strcmp(f->alternative[i].id, a.id) == 0)
                fw_diag_error(pack->diags, 375, a.place,
                              "alternative '%s' is there twice; rename "
                              "one",
                              a.id);
        if (fw_xml_children(e, "step") != 1)
            fw_diag_error(pack->diags, 375, a.place,
                          "<alternative> holds one <step>, the one that takes another's place");
        else if (!step_of(pack->root, a.step, &before))
            fw_diag_error(pack->diags, 375, step->element->place,
                          "there is no step '%s' whose place this one could take; give it the id "
                          "of a step of the flow",
                          a.step);
        else
            f->alternative[f->nalternative++] = a;
    }
    return FW_OK;
}

static fw_status no_such(const fw_process_pack *pack, const fw_process_choice *c) {
    const fw_process_flow *f = pack->flow;
    const char **name = fw_arena_array(pack->arena, const char *, (size_t)f->nalternative);
    FW_NEED(name);
    for (int i = 0; i < f->nalternative; i++)
        name[i] = f->alternative[i].id;
    const char *best = fw_did_you_mean(c->alternative, name, (size_t)f->nalternative);
    fw_diag_error(pack->diags, 375, c->place, "flow '%s' has no alternative '%s'%s%s%s", f->id,
                  c->alternative, FW_DID_YOU_MEAN(best));
    return FW_OK;
}

static fw_status choose(fw_process_pack *pack, const fw_process_choice *c) {
    fw_process_flow *f = pack->flow;
    fw_process_alternative *a = NULL;
    for (int i = 0; i < f->nalternative; i++)
        if (strcmp(f->alternative[i].id, c->alternative) == 0) a = &f->alternative[i];
    if (!a) return no_such(pack, c);
    for (int i = 0; i < f->nalternative; i++)
        if (f->alternative[i].chosen && strcmp(f->alternative[i].step, a->step) == 0) {
            fw_diag_error(pack->diags, 375, c->place,
                          "'%s' and '%s' are both for step %s; use one of them",
                          f->alternative[i].id, a->id, a->step);
            return FW_OK;
        }
    a->chosen = true;
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next) {
        fw_xml_record *before, *old = step_of(pack->root, a->step, &before);
        if (!fw_xml_is(e, "alternative") || strcmp(fw_process_pack_text(e, "id"), a->id) != 0)
            continue;
        a->instead_of = fw_process_pack_text(old, "title");
        put(pack->root, (fw_xml_record *)inner_step(e), old, before);
        break;
    }
    return FW_OK;
}

/* lists the alternatives, and puts the chosen ones in the places of their steps */
static fw_status choose_alternatives(fw_process_pack *pack, const fw_process_choice *choice,
                                     int n) {
    pack->flow->id = fw_process_pack_text(pack->root, "id");
    FW_TRY(list(pack));
    for (int i = 0; i < n; i++)
        FW_TRY(choose(pack, &choice[i]));
    return FW_OK;
}

/* ---- what this device does not need ----
   A step with only-with="tethers" is there for devices that have some. For one that has none it is taken out before
   anything is read from the steps, as an alternative is put in: sheet, tables, schedule, log and cost know nothing of it,
   and the sheet says so where it stood. Test: test_alternative.c. */

static bool is_needed(const fw_process_pack *pack, const fw_xml_record *e) {
    return !pack->lacks || strcmp(fw_process_pack_text(e, "only-with"), pack->lacks) != 0;
}

static const char *next_needed(const fw_process_pack *pack, const fw_xml_record *e) {
    while ((e = e->next))
        if (fw_xml_is(e, "step") && is_needed(pack, e)) return fw_process_pack_text(e, "id");
    return "";
}

static fw_status leave_out(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    fw_xml_record *root = (fw_xml_record *)pack->root, *before = NULL, *e;
    if (!pack->lacks) return FW_OK;
    FW_NEED(f->left_out = fw_arena_array(pack->arena, fw_process_left_out,
                                         (size_t)fw_xml_children(root, "step")));
    for (e = (fw_xml_record *)root->first_child; e; e = (fw_xml_record *)e->next) {
        if (!fw_xml_is(e, "step") || is_needed(pack, e)) {
            before = e;
            continue;
        }
        fw_process_left_out *l = &f->left_out[f->nleft_out++];
        *l = (fw_process_left_out){.id = fw_process_pack_text(e, "id"),
                                   .title = fw_process_pack_text(e, "title"),
                                   .before = next_needed(pack, e)};
        FW_NEED(l->why = fw_arena_printf(pack->arena, "the device has no %s", pack->lacks));
        if (before)
            before->next = e->next;
        else
            root->first_child = e->next;
    }
    if (f->nleft_out > 0 && fw_xml_children(root, "step") == 0)
        fw_diag_error(pack->diags, 590, root->element->place,
                      "every step of flow '%s' is for devices with %s only, and this one has none; "
                      "take only-with off those that every device needs",
                      f->id, pack->lacks);
    return FW_OK;
}

/* ---- alternatives that nobody chose: a laboratory finds them as sound as the flow itself ---- */

static bool is_said(const fw_diags *diags, const fw_diag *d) {
    for (size_t i = 0; i < diags->count; i++)
        if (diags->item[i].number == d->number && strcmp(diags->item[i].message, d->message) == 0)
            return true;
    return false;
}

/* what is said of another flow of the pack, and not of the flow as it is */
static fw_status tell(fw_process_pack *pack, const fw_diags *of, const char *which,
                      const char *name) {
    for (size_t i = 0; i < of->count; i++) {
        fw_diag d = of->item[i];
        if (d.severity == FW_NOTE || is_said(pack->diags, &d)) continue;
        FW_NEED(d.message = fw_arena_printf(pack->arena, "%s '%s': %s", which, name, d.message));
        fw_diags_add(pack->diags, &d, d.severity);
    }
    return of->failed ? FW_NOMEM : FW_OK;
}

/* in the place of its step, chosen or not, and out again */
static fw_status lint_alternative(fw_process_pack *pack, const fw_xml_record *e,
                                  fw_process_alternative *a) {
    fw_diags diags = fw_diags_new(pack->arena);
    fw_process_pack other = {.arena = pack->arena,
                             .diags = &diags,
                             .base = pack->base,
                             .root = pack->root,
                             .lacks = pack->lacks};
    fw_xml_record *before, *old = step_of(pack->root, a->step, &before),
                           *inner = (fw_xml_record *)inner_step(e);
    if (!old) return FW_OK; /* this device does not need the step, whichever way it is done */
    const fw_xml_record *next = inner->next;
    FW_NEED(other.flow = fw_arena_one(pack->arena, fw_process_flow));
    other.flow->left_out = pack->flow->left_out, other.flow->nleft_out = pack->flow->nleft_out;
    put(pack->root, inner, old, before);
    fw_status status = fw_process_pack_flow(&other);
    if (before)
        before->next = old;
    else
        ((fw_xml_record *)pack->root)->first_child = old;
    inner->next = next;
    FW_TRY(status);
    if (diags.errors == 0) a->drying = fw_process_flow_drying(other.flow);
    return tell(pack, &diags, "with the alternative", a->id);
}

static fw_status lint_alternatives(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next)
        for (int i = 0; fw_xml_is(e, "alternative") && i < f->nalternative; i++)
            if (!f->alternative[i].chosen &&
                strcmp(f->alternative[i].id, fw_process_pack_text(e, "id")) == 0)
                FW_TRY(lint_alternative(pack, e, &f->alternative[i]));
    return FW_OK;
}

/* ---- devices that need other steps: whoever draws one finds the flow as sound as for this one ---- */

typedef struct records { /* of the flow's root, as they followed each other */
    fw_xml_record **item;
    int n;
} records;

static fw_status remember(fw_process_pack *pack, records *list) {
    fw_xml_record *root = (fw_xml_record *)pack->root;
    *list = (records){0};
    for (const fw_xml_record *e = root->first_child; e; e = e->next)
        list->n++;
    FW_NEED(list->item = fw_arena_array(pack->arena, fw_xml_record *, (size_t)list->n));
    list->n = 0;
    for (fw_xml_record *e = (fw_xml_record *)root->first_child; e; e = (fw_xml_record *)e->next)
        list->item[list->n++] = e;
    return FW_OK;
}

static void restore(fw_process_pack *pack, const records *list) {
    ((fw_xml_record *)pack->root)->first_child = list->n > 0 ? list->item[0] : NULL;
    for (int i = 0; i < list->n; i++)
        list->item[i]->next = i + 1 < list->n ? list->item[i + 1] : NULL;
}

/* the flow for a device that lacks `lacks` (NULL: nothing), with the alternatives that were chosen, and each of the others
   in its place */
static fw_status lint_other(fw_process_pack *pack, const char *lacks, const char *which,
                            const char *name) {
    fw_diags diags = fw_diags_new(pack->arena);
    const size_t n = (size_t)pack->flow->nalternative;
    fw_process_pack other = {.arena = pack->arena,
                             .diags = &diags,
                             .base = pack->base,
                             .root = pack->root,
                             .lacks = lacks};
    FW_NEED(other.flow = fw_arena_one(pack->arena, fw_process_flow));
    FW_NEED(other.flow->alternative = fw_arena_array(pack->arena, fw_process_alternative, n));
    for (size_t i = 0; i < n; i++)
        other.flow->alternative[other.flow->nalternative++] = pack->flow->alternative[i];
    FW_TRY(leave_out(&other));
    if (diags.errors == 0) FW_TRY(fw_process_pack_flow(&other));
    if (diags.errors == 0) FW_TRY(lint_alternatives(&other));
    return tell(pack, &diags, which, name);
}

/* of a step; "": every device needs it */
static const char *held_by(const fw_xml_record *e) {
    return fw_xml_is(e, "step") ? fw_process_pack_text(e, "only-with") : "";
}

/* whole: the records before anything was left out of them */
static fw_status lint_others(fw_process_pack *pack, const records *whole) {
    records own;
    FW_TRY(remember(pack, &own));
    for (int i = 0; i < whole->n; i++) {
        const char *with = held_by(whole->item[i]);
        bool asked = !with[0];
        for (int k = 0; k < i && !asked; k++)
            asked = strcmp(held_by(whole->item[k]), with) == 0;
        if (asked) continue;
        const bool lacks = pack->lacks && strcmp(pack->lacks, with) == 0;
        restore(pack, whole);
        FW_TRY(lint_other(pack, lacks ? NULL : with,
                          lacks ? "for a device with" : "for a device without", with));
    }
    restore(pack, &own);
    return FW_OK;
}

fw_status fw_process_flow_read(fw_arena *arena, const char *base_file, const char *base_xml,
                               size_t base_n, const char *file, const char *xml, size_t n,
                               fw_diags *diags, fw_process_flow **flow) {
    return fw_process_flow_read_chosen(arena, base_file, base_xml, base_n, file, xml, n, NULL, 0,
                                       NULL, diags, flow);
}

fw_status fw_process_flow_read_chosen(fw_arena *arena, const char *base_file, const char *base_xml,
                                      size_t base_n, const char *file, const char *xml, size_t n,
                                      const fw_process_choice *choice, int nchoice,
                                      const char *lacks, fw_diags *diags, fw_process_flow **flow) {
    fw_xml_reader base = {.arena = arena, .diags = diags, .table = &fw_process_pack_table};
    fw_xml_reader own = base;
    fw_process_pack pack = {.arena = arena, .diags = diags, .lacks = lacks};
    size_t errors = diags->errors;
    *flow = NULL;
    FW_TRY(fw_process_pack_files(&base, base_file, base_xml, base_n, &own, file, xml, n));
    FW_TRY(fw_process_pack_records(&base, true, &pack.base));
    FW_TRY(fw_process_pack_records(&own, false, &pack.root));
    FW_NEED(pack.flow = fw_arena_one(arena, fw_process_flow));
    char hash[65];
    fw_sha256(xml, n, hash);
    FW_NEED(pack.flow->sha256 = fw_arena_strdup(arena, hash));
    pack.flow->file = file;
    FW_TRY(choose_alternatives(&pack, choice, nchoice));
    records whole;
    FW_TRY(remember(&pack, &whole));
    FW_TRY(leave_out(&pack));
    FW_TRY(fw_process_pack_flow(&pack));
    if (diags->errors == errors) FW_TRY(lint_alternatives(&pack));
    if (diags->errors == errors) FW_TRY(lint_others(&pack, &whole));
    if (diags->failed) return FW_NOMEM;
    if (diags->errors > errors) return FW_INPUT;
    *flow = pack.flow;
    return FW_OK;
}

/* ---- a step as it was set ---- */

typedef struct replaced { /* quantities, and the copies that take their place */
    const fw_quantity **from;
    fw_quantity *to;
    int n;
} replaced;

static fw_quantity *replacement(const replaced *r, const fw_quantity *q) {
    for (int i = 0; i < r->n; i++)
        if (r->from[i] == q) return &r->to[i];
    return NULL;
}

static const fw_quantity *as_replaced(const replaced *r, const fw_quantity *q) {
    const fw_quantity *by = replacement(r, q);
    return by ? by : q;
}

static fw_quantity *replace(replaced *r, const fw_quantity *q) {
    r->from[r->n] = q;
    r->to[r->n] = *q;
    return &r->to[r->n++];
}

static fw_status with_replaced(fw_arena *arena, const replaced *r,
                               const fw_process_argument *argument, int n,
                               fw_process_argument **list) {
    FW_NEED(*list = fw_arena_array(arena, fw_process_argument, (size_t)n + 1));
    for (int i = 0; i < n; i++)
        (*list)[i] = (fw_process_argument){argument[i].name, as_replaced(r, argument[i].q)};
    return FW_OK;
}

/* what a step is to reach and not what it is done under: what it adds, what the resist needs, how long */
static bool is_asked(const fw_process_step *s, const fw_quantity *q) {
    for (int i = 0; i < s->nchange; i++)
        if (s->change[i].thickness == q && strcmp(s->change[i].kind, "add") == 0) return true;
    return fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_TIME) ||
           fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_DOSE);
}

/* the quantity that a derived one is written to, as *times of it; NULL: it is in no law */
static const fw_quantity *behind(const fw_process_step *s, const fw_quantity *derived, double value,
                                 double *times) {
    const fw_process_law *law = fw_process_law_find(s->law);
    *times = 1.0;
    for (int i = 0; i < s->nderive; i++)
        if (s->derive[i].q && strcmp(s->derive[i].name, derived->id) == 0) return s->derive[i].q;
    const bool in_proportion = law && law->derived && strcmp(law->derived, derived->id) == 0 &&
                               !derived->unknown && derived->value > 0.0;
    for (int i = 0; in_proportion && i < s->nargument; i++)
        if (strcmp(s->argument[i].name, law->of_argument) == 0 && s->argument[i].q) {
            *times = s->argument[i].q->value / derived->value;
            return s->argument[i].q->unknown || !(value > 0.0) ? NULL : s->argument[i].q;
        }
    return NULL;
}

static void set_one(replaced *r, const fw_process_step *s, const fw_process_set *set) {
    const fw_quantity *q = set->planned;
    double times = 1.0;
    for (int i = 0; i < s->nderived; i++)
        if (s->derived[i] == set->planned) q = behind(s, s->derived[i], set->value, &times);
    if (!q || isnan(set->value) || is_asked(s, q)) return;
    fw_quantity *to = replacement(r, q);
    if (!to) to = replace(r, q);
    to->value = set->value * times;
    to->uncertainty = set->uncertainty * times;
    to->unknown = to->interval = false;
}

/* what the step derives by itself has copies of its own, and is not derived where it was set */
static fw_status derive_as_set(fw_arena *arena, replaced *r, const fw_process_step *s,
                               fw_process_step *out) {
    FW_NEED(out->derive = fw_arena_array(arena, fw_process_derive, (size_t)s->nderive + 1));
    out->nderive = 0;
    for (int i = 0; i < s->nderive; i++) {
        if (s->derive[i].q && replacement(r, s->derive[i].q)) continue;
        out->derive[out->nderive] = s->derive[i];
        if (s->derive[i].q) out->derive[out->nderive].q = replace(r, s->derive[i].q);
        out->nderive++;
    }
    for (int i = 0; i < out->nderive; i++) {
        fw_process_derive *d = &out->derive[i];
        FW_TRY(with_replaced(arena, r, d->argument, d->nargument, &d->argument));
    }
    return FW_OK;
}

/* The laws of the step once more, with everything that they write in copies. Test: test_asrun.c, what_was_set_counts. */
fw_status fw_process_step_as_set(fw_arena *arena, const fw_process_step *s,
                                 const fw_process_set *set, int n, const fw_process_step **out) {
    const size_t most = (size_t)(n + s->nderive + 1);
    replaced r = {0};
    *out = s;
    FW_NEED(r.from = fw_arena_array(arena, const fw_quantity *, most));
    FW_NEED(r.to = fw_arena_array(arena, fw_quantity, most));
    for (int i = 0; i < n; i++)
        set_one(&r, s, &set[i]);
    if (r.n == 0) return FW_OK;
    fw_process_step *copy = fw_arena_array(arena, fw_process_step, 1);
    FW_NEED(copy);
    *copy = *s;
    FW_TRY(derive_as_set(arena, &r, s, copy));
    if (s->planned) copy->planned = replace(&r, s->planned);
    FW_TRY(with_replaced(arena, &r, s->argument, s->nargument, &copy->argument));
    FW_TRY(with_replaced(arena, &r, s->need, s->nneed, &copy->need));
    copy->overrun_from = as_replaced(&r, s->overrun_from);
    copy->pulse = as_replaced(&r, s->pulse), copy->pause = as_replaced(&r, s->pause);
    fw_process_step_overrun(copy);
    FW_TRY(fw_process_step_compute(arena, copy));
    /* somebody who is there for a shorter etch hands it over as fast as for a longer one */
    const double more =
        s->booked_stop_s - s->booked_stop_own_s + copy->booked_stop_own_s - copy->booked_stop_s;
    if (s->time.computable && copy->time.computable)
        copy->booked_s += more, copy->booked_stop_s += more;
    if (copy->time.computable != s->time.computable ||
        fabs(copy->time.nominal_s - s->time.nominal_s) > 1e-9 * s->time.nominal_s ||
        fabs(copy->booked_stop_s - s->booked_stop_s) > 1e-9 * s->booked_stop_s)
        *out = copy;
    return FW_OK;
}

fw_status fw_process_step_time_of(fw_arena *arena, const fw_process_step *step, int argument,
                                  double amount_m, fw_process_law_answer *answer) {
    fw_process_argument list[FW_LAW_ARGUMENTS];
    *answer = (fw_process_law_answer){0};
    if (step->nargument > FW_LAW_ARGUMENTS) return FW_OK;
    for (int i = 0; i < step->nargument; i++)
        list[i] = step->argument[i];
    fw_quantity amount = *list[argument].q;
    amount.value = amount_m;
    amount.uncertainty = 0.0; /* it is what is asked */
    amount.unknown = false;
    list[argument].q = &amount;
    const fw_process_law_use use = {.law = fw_process_law_find(step->law),
                                    .shape = step->shape,
                                    .expression = step->expression,
                                    .wanted = FW_DIM_TIME,
                                    .argument = list,
                                    .nargument = step->nargument};
    return fw_process_law_evaluate(arena, &use, answer);
}

fw_status fw_process_step_amount_in(fw_arena *arena, const fw_process_step *step, int argument,
                                    double time_s, double *amount_m) {
    enum { ROUNDS = 12 };
    for (int i = 0; i < ROUNDS; i++) {
        fw_process_law_answer answer;
        FW_TRY(fw_process_step_time_of(arena, step, argument, *amount_m, &answer));
        if (!answer.computable || !(answer.value > 0)) break;
        *amount_m *= time_s / answer.value;
    }
    return FW_OK;
}
