/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep: every response at each of many points, chosen beforehand. Points are numbered; point i of a grid
   has the digits of i in mixed radix, the last input the fastest. As a die (as="die") each has besides a value of its own of
   everything that its flow and <uncertain> make differ, and a place on the wafer where there are trends: further numbers of
   its point of a Sobol' sequence, of a grid numbers of its own. What is only known by an interval goes evenly over it. */
#include "chance/random.h"
#include "device/edit.h"
#include "maths/functions.h"
#include "study/study_parts.h"
#include "xml/xml.h"
#include <ctype.h>
#include <math.h>
#include <string.h>

enum { SOBOL_USUAL = 256, SWEEP_MOST = 100000000, SOBOL_DIGITS = 9, SETTING_DIGITS = 12 };
enum { SEED_USUAL = 1 }; /* of a study that states none */
enum { DIES = 2 };       /* of the seed: numbers that nothing else uses */

typedef struct sweep {
    const fw_study *study;
    fw_chance_sobol sobol;
    fw_study_scatter *scatter;            /* of dies; else NULL */
    double *u, *unknown, *drawn, *values; /* of one die */
    long n;
} sweep;

/* number d, 0..1, of what is left to chance in point k */
static double share_of(const sweep *s, long k, size_t d) {
    const fw_device_study *asked = s->study->asked;
    return asked->points == FW_POINTS_SOBOL
               ? fw_chance_sobol_uniform(&s->sobol, (uint64_t)k, (size_t)s->study->nvary + d)
               : fw_chance_uniform(fw_chance_seed((uint64_t)asked->seed, DIES), (uint64_t)k, d);
}

static fw_status at_die(const sweep *s, long k, fw_study_sample *sample) {
    const fw_study *study = s->study;
    const fw_study_scatter *scatter = s->scatter;
    const fw_chance_joint *joint = &scatter->joint;
    const int ninput = scatter->ninput, first = study->nvary;
    for (size_t d = 0; d < scatter->dimensions; d++)
        s->u[d] = fw_maths_normal_quantile(share_of(s, k, d));
    for (size_t i = 0; i < joint->unknowns; i++) {
        const fw_chance_distribution *d = &joint->variable[joint->unknown[i]].distribution;
        s->unknown[i] = d->low + (d->high - d->low) * share_of(s, k, scatter->dimensions + i);
    }
    fw_study_scatter_point(scatter, s->u, s->unknown, fw_study_scatter_at(scatter, s->u), s->drawn,
                           s->values);
    for (int i = 0; i < study->nsetting; i++)
        FW_TRY(fw_study_input_write(&study->input[first + i], s->values[ninput + i], SETTING_DIGITS,
                                    sample->text[first + i], &sample->value[first + i]));
    for (int i = 0; i < ninput; i++) {
        sample->value[first + study->nsetting + i] = s->values[i];
        sample->text[first + study->nsetting + i][0] = '\0'; /* no setting of the device */
    }
    return FW_OK;
}

static fw_status at_grid(const fw_study *study, long k, fw_study_sample *sample) {
    for (int v = study->nvary; v-- > 0;) {
        int steps = fw_study_input_steps(&study->input[v]);
        FW_TRY(fw_study_input_step(&study->input[v], (int)(k % steps), sample->text[v],
                                   &sample->value[v]));
        k /= steps;
    }
    return FW_OK;
}

static fw_status at_chosen(const sweep *s, long k, fw_study_sample *sample) {
    const fw_study *study = s->study;
    switch (study->asked->points) {
    case FW_POINTS_GRID:
        return at_grid(study, k, sample);
    case FW_POINTS_LIST:
        for (int v = 0; v < study->nvary; v++)
            FW_TRY(
                fw_study_input_step(&study->input[v], (int)k, sample->text[v], &sample->value[v]));
        return FW_OK;
    case FW_POINTS_SOBOL:
        for (int v = 0; v < study->nvary; v++)
            FW_TRY(fw_study_input_at(&study->input[v],
                                     fw_chance_sobol_uniform(&s->sobol, (uint64_t)k, (size_t)v),
                                     SOBOL_DIGITS, sample->text[v], &sample->value[v]));
        return FW_OK;
    }
    return FW_INTERNAL;
}

/* the inputs of point k */
static fw_status at_point(const void *context, long k, fw_study_sample *sample) {
    const sweep *s = context;
    sample->i = k;
    FW_TRY(at_chosen(s, k, sample));
    return s->scatter ? at_die(s, k, sample) : FW_OK;
}

static fw_status fill(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const sweep *s = context;
    sample->i = k;
    *wanted = fw_study_is_due(s->study, k);
    return *wanted ? at_point(s, k, sample) : FW_OK;
}

/* a grid of more than SWEEP_MOST: more than that */
long fw_study_count_sweep(const fw_study *study) {
    long n = 1;
    if (study->asked->points == FW_POINTS_SOBOL)
        return study->asked->samples > 0 ? study->asked->samples : SOBOL_USUAL;
    if (study->asked->points == FW_POINTS_LIST) return fw_study_input_steps(&study->input[0]);
    for (int v = 0; v < study->nvary && n <= SWEEP_MOST; v++)
        n *= fw_study_input_steps(&study->input[v]);
    return n;
}

fw_status fw_study_check_sweep(fw_study *study) {
    const long n = fw_study_count_sweep(study);
    if (n > SWEEP_MOST)
        return fw_diag_error(&study->diags, 490, study->asked->place,
                             "the grid has more than %d points; take fewer steps, or "
                             "points=\"sobol\" with so many samples as are wanted",
                             (int)SWEEP_MOST);
    for (int v = 0; study->asked->points == FW_POINTS_LIST && v < study->nvary; v++) {
        const fw_study_input *in = &study->input[v];
        int steps = fw_study_input_steps(in);
        if (steps != n)
            return fw_diag_error(&study->diags, 490, in->place,
                                 "points=\"list\" takes the values of all inputs side by side, and "
                                 "'%s' has %d where '%s' has %ld; give each as many",
                                 in->what, steps, study->input[0].what, n);
    }
    return FW_OK;
}

/* ---- what is stated and has no effect ---- */

static fw_status idle(fw_study *study, fw_place place, const char *what, const char *why) {
    fw_diag_warning(&study->diags, 737, place, "study '%s': %s has no effect: %s",
                    study->asked->name, what, why);
    return study->diags.failed ? FW_NOMEM : FW_OK;
}

/* Does a text have the name as a word of its own? It stands in an expression, or in some other text, of which it is not known
   that it is none. */
static bool has_word(const char *text, const char *name) {
    const size_t n = strlen(name);
    for (const char *at = strstr(text, name); at; at = strstr(at + 1, name)) {
        const bool begins = at == text || !(isalnum((unsigned char)at[-1]) || at[-1] == '_');
        if (begins && !isalnum((unsigned char)at[n]) && at[n] != '_') return true;
    }
    return false;
}

/* of any attribute of an element and of what is in it and behind it */
static bool is_said(const fw_xml_element *e, const char *name) {
    for (; e; e = e->next) {
        for (int i = 0; i < e->nattribute; i++)
            if (has_word(e->attribute[i].value, name)) return true;
        if (has_word(e->text, name) || is_said(e->first_child, name)) return true;
    }
    return false;
}

/* the description without studies and without parameter k, all else set as the study and its line set it: does anything still
   say the parameter's name? What cannot be told is taken to */
static fw_status is_used(fw_study *study, fw_arena *scratch, int k, bool *used) {
    const fw_device *d = study->plan->device;
    const int inputs = study->nvary + study->nsetting;
    const int most = inputs + study->options.nset + d->nstudy + 1;
    fw_device_text_change *change = fw_arena_array(scratch, fw_device_text_change, (size_t)most);
    fw_diags quiet = fw_diags_new(scratch);
    fw_text text = fw_text_new(scratch);
    int n = 0;
    *used = true;
    FW_NEED(change);
    for (int i = 0; i < study->options.nset; i++)
        if (strchr(study->options.set[i].path, '/'))
            change[n++] = (fw_device_text_change){.path = study->options.set[i].path, .value = "0"};
    for (int i = 0; i < inputs; i++)
        if (strchr(study->input[i].what, '/'))
            change[n++] = (fw_device_text_change){.path = study->input[i].what, .value = "0"};
    if (n == 0 || !d->source) return FW_OK;
    for (int i = 0; i < d->nstudy; i++)
        change[n++] = (fw_device_text_change){
            .kind = FW_CHANGE_REMOVE,
            .path = fw_arena_printf(scratch, "study[%s]", d->study[i].name)};
    change[n++] = (fw_device_text_change){
        .kind = FW_CHANGE_REMOVE,
        .path = fw_arena_printf(scratch, "parameter[%s]", study->input[k].what)};
    for (int i = 0; i < n; i++)
        FW_NEED(change[i].path);
    const fw_status status =
        fw_device_edit(scratch, d->file, d->source, d->source_length, change, n, &quiet, &text);
    fw_xml_element *root = NULL;
    if (status == FW_OK)
        FW_NEED(fw_xml_read(scratch, d->file, text.data, text.length, &quiet, &root) == FW_NOMEM
                    ? NULL
                    : scratch);
    if (root) *used = is_said(root, study->input[k].what);
    return status == FW_NOMEM ? FW_NOMEM : FW_OK;
}

static fw_status say_steps(fw_study *study, const fw_device_vary *v) {
    const bool stepped =
        study->asked->kind == FW_STUDY_IS_sweep && study->asked->points != FW_POINTS_SOBOL;
    if (!v->stepped || stepped) return FW_OK;
    return idle(study, v->place, "steps=\"...\"",
                "they are of a grid or a list, and values come from all of the range");
}

static fw_status say_input(fw_study *study, int k) {
    const fw_study_input *in = &study->input[k];
    if (isnan(in->now)) return FW_OK; /* no parameter */
    const char *what = fw_arena_printf(study->arena, "<%s what=\"%s\">",
                                       k < study->nvary ? "vary" : "uncertain", in->what);
    fw_arena *scratch = what ? fw_arena_part(study->arena, 0) : NULL;
    FW_NEED(scratch);
    bool used;
    fw_status status = is_used(study, scratch, k, &used);
    fw_arena_free(scratch);
    if (status == FW_OK && !used)
        status = idle(study, in->place, what,
                      "nothing of the description uses it but what is set by itself, by another "
                      "<vary> or <uncertain> or by --set");
    return status;
}

fw_status fw_study_say_idle(fw_study *study) {
    const fw_device_study *a = study->asked;
    const bool chosen = a->kind == FW_STUDY_IS_sweep;
    if (a->samples > 0 && chosen && a->points != FW_POINTS_SOBOL)
        FW_TRY(idle(study, a->place, "samples=\"...\"",
                    "a grid or a list has as many devices as the values of its inputs make; take "
                    "points=\"sobol\" for so many"));
    if (a->seed != SEED_USUAL && chosen && a->points != FW_POINTS_SOBOL && a->judge != FW_JUDGE_DIE)
        FW_TRY(
            idle(study, a->place, "seed=\"...\"", "nothing of a grid or a list is left to chance"));
    const bool intervals = a->kind == FW_STUDY_IS_sensitivity || a->kind == FW_STUDY_IS_yield ||
                           (a->kind == FW_STUDY_IS_size && a->yield > 0);
    if (a->confident && !intervals)
        FW_TRY(idle(study, a->place, "confidence=\"...\"",
                    "there are no intervals that it would be of"));
    for (int k = 0; k < study->nvary; k++)
        FW_TRY(say_steps(study, &a->vary[k]));
    for (int k = 0; k < study->nvary + study->nsetting; k++)
        FW_TRY(say_input(study, k));
    return FW_OK;
}

/* a die is made by one flow, and something is to differ */
fw_status fw_study_dies_check(fw_study *study) {
    const fw_verdict *v = &study->plan->verdict;
    if (v->nvariant != 1)
        return fw_diag_error(&study->diags, 658, study->asked->place,
                             "study '%s': a die is made by one flow, and the device has %d; name "
                             "one, as with --flow %s",
                             study->asked->name, v->nvariant, v->variant[0].variant->flow);
    if (study->ninput > study->nvary) return FW_OK;
    return fw_diag_error(&study->diags, 491, study->asked->place,
                         "study '%s': nothing differs from die to die; add an <uncertain>, or take "
                         "as=\"drawn\"",
                         study->asked->name);
}

static fw_status dies_of(fw_study *study, sweep *s) {
    fw_arena *arena = study->arena;
    FW_NEED(s->scatter = fw_arena_one(arena, fw_study_scatter));
    FW_TRY(fw_study_scatter_of(study, &study->plan->verdict.variant[0], s->scatter));
    FW_NEED(s->u = fw_arena_array(arena, double, s->scatter->dimensions + 1));
    FW_NEED(s->unknown = fw_arena_array(arena, double, s->scatter->joint.unknowns + 1));
    FW_NEED(s->drawn = fw_arena_array(arena, double, s->scatter->joint.values + 1));
    FW_NEED(s->values = fw_arena_array(arena, double, (size_t)s->scatter->npoint + 1));
    return FW_OK;
}

fw_status fw_study_kind_sweep(fw_study *study, fw_study_result *result) {
    sweep s = {.study = study, .n = fw_study_count_sweep(study)};
    if (study->asked->judge == FW_JUDGE_DIE) FW_TRY(dies_of(study, &s));
    const size_t chance = s.scatter ? s.scatter->dimensions + s.scatter->joint.unknowns : 0;
    if (study->asked->points == FW_POINTS_SOBOL)
        FW_TRY(fw_chance_sobol_new(study->arena, (size_t)study->nvary + chance,
                                   (uint64_t)study->asked->seed, &s.sobol));
    const fw_study_points points = {.n = s.n, .at = at_point, .context = &s};
    if (study->asked->fitted > 0) return fw_study_fitted_run(study, &points, result);
    const fw_study_work work = {.n = s.n, .fill = fill, .context = &s};
    return fw_study_pool_run(study, &work);
}
