/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measuring/measuring.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

typedef struct work {
    fw_arena *arena;
    const fw_measuring_request *in;
    fw_measuring *out;
    fw_measuring_item *item;
    const fw_verdict_fabrication_input **input; /* (nitem) of each, where it differs */
    int *ninput;
    int n;
    const fw_process_measurable *reading;
    int nreading;
    fw_process_time *time; /* (nstep) as it is known now */
} work;

/* ---- which inputs ---- */

static const char *in_words(fw_arena *arena, const char *name) {
    char *words = fw_arena_strdup(arena, name);
    for (char *c = words; c && *c; c++)
        if (*c == '_' || *c == '-') *c = ' ';
    return words;
}

/* as the corner, the run sheet or the law calls it */
static const char *name_of(work *w, const fw_quantity *q) {
    const fw_process_flow *f = w->in->flow;
    for (int i = 0; i < f->ncorner; i++)
        if (f->corner[i].q == q) return f->corner[i].name;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nsetting; k++)
            if (f->step[i].setting[k].q == q) return f->step[i].setting[k].name;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        for (int k = 0; k < s->nargument + s->nneed; k++) {
            const fw_process_argument *a =
                k < s->nargument ? &s->argument[k] : &s->need[k - s->nargument];
            if (a->q == q) return in_words(w->arena, a->name);
        }
    }
    return q->id;
}

static fw_status add_quantity(work *w, const fw_quantity *q) {
    fw_measuring_item *item = &w->item[w->n++];
    const fw_process_measurable *r = fw_process_measurable_of(w->reading, w->nreading, q->id);
    *item = (fw_measuring_item){.id = q->id, .q = *q, .unknown = q->unknown};
    if (!fw_process_flow_nominal(w->in->flow, q, &item->value)) item->value = (double)NAN;
    item->before = q->unknown ? (double)NAN : q->uncertainty;
    for (int i = 0; q->unknown && !isnan(item->value) && i < w->in->flow->ncorner; i++) {
        const fw_process_corner *c = &w->in->flow->corner[i];
        if (c->q != q) continue;
        item->q = *c->assumed; /* the range that stands in */
        item->before = c->assumed->uncertainty;
    }
    if (r) item->after = r->uncertainty, item->by = r->by, item->coupon = r->coupon;
    FW_NEED(item->name = name_of(w, q));
    return FW_OK;
}

/* a reading that is no better than what is known already is not worth its time */
static bool better(const fw_measuring_item *item) {
    return item->unknown || item->after < item->before;
}

static fw_status find_quantities(work *w) {
    const fw_process_flow *f = w->in->flow;
    for (int i = 0; i < f->nquantity; i++) {
        const fw_quantity *q = f->quantity[i];
        bool open = q->unknown || q->uncertainty > 0.0 || q->interval;
        if (!open || !q->id || fw_process_flow_quantity(f, q->id) != q) continue;
        if (fw_process_flow_takes(f, q)) FW_TRY(add_quantity(w, q));
    }
    return FW_OK;
}

/* ---- what is made ---- */

static bool same_input(const fw_verdict_fabrication_input *a,
                       const fw_verdict_fabrication_input *b) {
    return a->drawn == b->drawn && a->even == b->even && a->nominal == b->nominal &&
           a->low == b->low && a->high == b->high && a->edge_m == b->edge_m &&
           a->flare_m == b->flare_m && a->thickness == b->thickness && a->youngs == b->youngs;
}

static bool same_inputs(const fw_verdict_fabrication_input *a, int na,
                        const fw_verdict_fabrication_input *b, int nb) {
    for (int i = 0; i < na && na == nb; i++)
        if (!same_input(&a[i], &b[i])) return false;
    return na == nb;
}

/* Where the description states a thickness, that is what is made, as much apart as the pack's own is. A share of it holds
   whoever states it, and is what a laboratory pack takes. */
static void as_described(const fw_verdict_variant_verdict *v, fw_measuring_item *item) {
    for (int k = 0; k < v->ninput; k++) {
        const fw_verdict_fabrication_input *in = &v->input[k];
        if (in->thickness == 0 || !in->q.id || strcmp(in->q.id, item->id) != 0 ||
            !fw_quantity_dimension_equal(item->q.dimension, in->q.dimension))
            continue;
        const double ratio = in->nominal / item->value;
        if (!(ratio > 0) || !isfinite(ratio)) return;
        item->value *= ratio, item->before *= ratio, item->after *= ratio;
        return;
    }
}

/* does it hold the verdict open until it is known? Then it has the name that the verdict gives it */
static void holds_open(const fw_verdict_variant_verdict *v, fw_measuring_item *item) {
    for (int i = 0; i < v->ninput; i++)
        if (v->input[i].open && strcmp(v->input[i].unknown, item->id) == 0)
            item->open = true, item->name = v->input[i].name;
}

/* an input that no better reading exists of changes nothing, and one without any value cannot be tried */
static fw_status find_made(work *w) {
    const fw_verdict_variant_verdict *v = w->in->verdict;
    for (int i = 0; i < w->n; i++) {
        fw_measuring_item *item = &w->item[i];
        holds_open(v, item);
        if (isnan(item->value) || !better(item)) continue;
        const fw_process_with with = {item->id, item->value, item->after};
        FW_TRY(fw_process_flow_fabricated_with(w->arena, w->in->flow, &with, w->in->drawn,
                                               v->variant, &w->input[i], &w->ninput[i]));
        item->made = !same_inputs(w->input[i], w->ninput[i], v->input, v->ninput);
        as_described(v, item);
    }
    return FW_OK;
}

/* what is the material's own is no quantity of the flow: known exactly, it has no range */
static fw_status add_materials(work *w) {
    const fw_verdict_variant_verdict *v = w->in->verdict;
    for (int i = 0; i < v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &v->input[i];
        if (in->youngs == 0.0 || in->unknown) continue;
        fw_verdict_fabrication_input *list =
            fw_arena_grow(w->arena, v->input, (size_t)v->ninput, (size_t)v->ninput, sizeof *list);
        FW_NEED(list);
        list[i].low = list[i].high = list[i].nominal;
        list[i].sigma = 0.0;
        w->input[w->n] = list;
        w->ninput[w->n] = v->ninput;
        w->item[w->n++] = (fw_measuring_item){.name = in->name,
                                              .q = in->q,
                                              .value = in->nominal,
                                              .before = in->sigma,
                                              .made = in->high > in->low};
    }
    return FW_OK;
}

/* ---- first order ---- */

static const fw_verdict_fabrication_input *named_like(const work *w, int i,
                                                      const fw_verdict_fabrication_input *like) {
    for (int k = 0; k < w->ninput[i]; k++)
        if (strcmp(w->input[i][k].name, like->name) == 0) return &w->input[i][k];
    return NULL;
}

/* s^2 = sum (dU/dx sigma_x)^2 over the inputs of the verdict that the measurement changes, with sigma_x
   as it is now and as it would be; the slopes are the verdict's own. Shares of the limit. Range: first
   order about the nominal device. Source: docs/theory/as-fabricated.md. Test: test_measuring.c. */
static void find_shares(work *w, int hinge) {
    const fw_verdict_variant_verdict *v = w->in->verdict;
    const double *share = v->fabricated->hinge[hinge].share;
    w->out->sigma = v->fabricated->hinge[hinge].sigma;
    for (int i = 0; i < w->n; i++) {
        fw_measuring_item *item = &w->item[i];
        for (int k = 0; item->made && k < v->ninput; k++) {
            const fw_verdict_fabrication_input *now = &v->input[k], *then = named_like(w, i, now);
            if (then && same_input(now, then) && now->sigma == then->sigma) continue;
            double left = then && now->sigma > 0.0 ? then->sigma / now->sigma : 0.0;
            item->share = hypot(item->share, share[k]);
            item->share_after = hypot(item->share_after, share[k] * left);
        }
    }
}

/* ---- bands ---- */

static fw_status name_requirements(work *w) {
    const fw_verdict_variant_verdict *v = w->in->verdict;
    const char **name = fw_arena_array(w->arena, const char *, (size_t)v->nrequirement);
    FW_NEED(name);
    for (int i = 0; i < v->nrequirement; i++) {
        const fw_verdict_requirement *r = &v->requirement[i];
        FW_NEED(name[i] = fw_arena_printf(w->arena, "%s%s (%s)", FW_NAMED("requirement", r->probe),
                                          r->measure ? r->measure : r->kind));
    }
    w->out->requirement_name = name;
    w->out->nrequirement = v->nrequirement;
    return FW_OK;
}

/* of all bands the one that reaches furthest: of the hinges, then of the requirements; the hinge that reaches
   furthest of the hinges */
static fw_status find_most(work *w, const fw_verdict_ranges *r, fw_measuring_item *item,
                           int *hinge) {
    const fw_verdict_variant_verdict *v = w->in->verdict;
    item->most = (double)NAN;
    item->governing = (fw_verdict_band){(double)NAN, (double)NAN};
    *hinge = FW_NONE;
    for (int k = 0; k < v->nhinge; k++) {
        if (isnan(r->hinge[k].high) || r->hinge[k].high <= item->most) continue;
        item->governing = r->hinge[k];
        item->most = item->governing.high;
        *hinge = k;
    }
    if (*hinge != FW_NONE)
        FW_NEED(item->governs =
                    fw_arena_printf(w->arena, "%s%s", FW_NAMED("hinge", v->hinge[*hinge].id)));
    for (int i = 0; i < v->nrequirement; i++) {
        if (isnan(r->requirement[i].high) || r->requirement[i].high <= item->most) continue;
        item->governing = r->requirement[i];
        item->most = item->governing.high;
        item->governs = w->out->requirement_name[i];
    }
    return FW_OK;
}

/* the band that reaches furthest governs */
static fw_status govern(work *w, const fw_verdict_ranges *r, int hinge) {
    const fw_verdict_variant_verdict *v = w->in->verdict;
    fw_measuring *out = w->out;
    double most = -1.0;
    out->hinge = out->requirement = FW_NONE;
    out->band = (fw_verdict_band){(double)NAN, (double)NAN};
    if (hinge != FW_NONE && !isnan(r->hinge[hinge].high)) {
        out->hinge = hinge;
        out->band = r->hinge[hinge];
        most = out->band.high;
        FW_NEED(out->what =
                    fw_arena_printf(w->arena, "%s%s", FW_NAMED("hinge", v->hinge[hinge].id)));
    }
    for (int i = 0; i < v->nrequirement; i++) {
        if (!(r->requirement[i].high > most)) continue;
        out->hinge = FW_NONE, out->requirement = i;
        out->band = r->requirement[i];
        most = out->band.high;
        out->what = out->requirement_name[i];
    }
    out->requirements = r->requirement;
    out->decision = r->decision;
    out->judged = r->judged;
    return FW_OK;
}

/* With the ranges of one measurement. Both ends of a band are run of one hinge alone: where another governs
   then, of that one, too, as the verdict itself would with those ranges. */
static fw_status judge_item(work *w, fw_measuring_item *item, int hinge) {
    const fw_measuring_request *in = w->in;
    fw_measuring *out = w->out;
    int k = (int)(item - w->item), other;
    fw_verdict_ranges then;
    FW_TRY(fw_verdict_ranges_judge(w->arena, in->device, in->layout, in->options, in->verdict,
                                   w->input[k], w->ninput[k], hinge, &then));
    if (out->hinge != FW_NONE) item->band = then.hinge[out->hinge];
    if (out->requirement != FW_NONE) item->band = then.requirement[out->requirement];
    item->decision = then.decision;
    item->requirement = then.requirement;
    item->judged = then.judged;
    FW_TRY(find_most(w, &then, item, &other));
    if (other != hinge && other != FW_NONE) {
        FW_TRY(fw_verdict_ranges_judge(w->arena, in->device, in->layout, in->options, in->verdict,
                                       w->input[k], w->ninput[k], other, &then));
        FW_TRY(find_most(w, &then, item, &other));
        item->judged += then.judged;
    }
    out->judged += item->judged;
    return FW_OK;
}

static fw_status judge_items(work *w, int hinge) {
    const fw_measuring_request *in = w->in;
    fw_measuring *out = w->out;
    fw_verdict_ranges now;
    int most;
    FW_TRY(fw_verdict_ranges_judge(w->arena, in->device, in->layout, in->options, in->verdict,
                                   in->verdict->input, in->verdict->ninput, hinge, &now));
    FW_TRY(name_requirements(w));
    FW_TRY(govern(w, &now, hinge));
    for (int i = 0; i < w->n; i++) {
        fw_measuring_item *item = &w->item[i];
        item->band = out->band;
        item->decision = out->decision;
        item->requirement = out->requirements;
        FW_TRY(find_most(w, &now, item, &most));
        if (item->made) FW_TRY(judge_item(w, item, hinge));
    }
    return FW_OK;
}

static fw_status look_at_made(work *w) {
    const fw_verdict_variant_verdict *v = w->in->verdict;
    int hinge = fw_verdict_most_used(v);
    w->out->decision = v->fabricated->decision;
    if (hinge != FW_NONE) {
        find_shares(w, hinge);
        w->out->hinge = hinge;
        FW_NEED(w->out->what =
                    fw_arena_printf(w->arena, "%s%s", FW_NAMED("hinge", v->hinge[hinge].id)));
    }
    w->out->banded = w->in->bands;
    return w->in->bands ? judge_items(w, hinge) : FW_OK;
}

/* ---- windows ---- */

/* a window whose ends move by less than this part of the time is the same to whoever stands there */
static const double little = 1e-4;

static bool differ(double a, double b) {
    return isnan(a) != isnan(b) || fabs(a - b) > little * fmax(fabs(a), fabs(b));
}

static void window_of(const fw_process_time *t, double *s) {
    s[0] = t->computable ? t->first_look_s : (double)NAN;
    s[1] = t->computable ? t->clear_by_s : (double)NAN;
}

static fw_status compare_times(work *w, fw_measuring_item *item, const fw_process_time *then) {
    const fw_process_flow *f = w->in->flow;
    fw_measuring_window *list = fw_arena_array(w->arena, fw_measuring_window, (size_t)f->nstep);
    FW_NEED(list);
    for (int i = 0; i < f->nstep; i++) {
        fw_measuring_window *x = &list[item->nwindow];
        x->step = f->step[i].id;
        window_of(&w->time[i], x->before_s);
        window_of(&then[i], x->after_s);
        if (!differ(x->before_s[0], x->after_s[0]) && !differ(x->before_s[1], x->after_s[1]))
            continue;
        item->nwindow++;
        if (isnan(x->before_s[0]))
            item->opens++;
        else if (!isnan(x->after_s[0]))
            item->windows += (x->before_s[1] - x->before_s[0]) / w->time[i].nominal_s -
                             (x->after_s[1] - x->after_s[0]) / then[i].nominal_s;
    }
    item->window = list;
    return FW_OK;
}

/* steps that cannot be computed without it: "S03 (with sputter power)" */
static fw_status find_needed(work *w, fw_measuring_item *item) {
    const fw_process_flow *f = w->in->flow;
    const char *mark = fw_arena_printf(w->arena, "(%s)", item->id);
    fw_text text = fw_text_new(w->arena);
    FW_NEED(mark);
    item->opens = 0;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_time *t = &w->time[i];
        bool named = false;
        for (int k = 0; k < t->nmissing; k++)
            named = named || strstr(t->missing[k], mark);
        if (t->computable || !named) continue;
        item->needed++;
        item->opens += t->nmissing == 1;
        fw_text_printf(&text, "%s%s", text.length ? ", " : "", f->step[i].id);
        if (t->nmissing == 2)
            for (int k = 0; k < 2; k++)
                if (!strstr(t->missing[k], mark))
                    fw_text_printf(&text, " (with %s)", t->missing[k]);
        if (t->nmissing > 2) fw_text_printf(&text, " (with %d others)", t->nmissing - 1);
    }
    FW_TRY(fw_text_end(&text));
    item->needed_for = text.length ? text.data : NULL;
    return FW_OK;
}

static fw_status find_windows(work *w) {
    const fw_measuring_request *in = w->in;
    const fw_process_with none = {.id = NULL};
    size_t steps = (size_t)in->flow->nstep;
    FW_NEED(w->time = fw_arena_array(w->arena, fw_process_time, steps));
    FW_TRY(fw_process_flow_times_with(w->arena, in->flow, &none, in->facts, w->time));
    fw_process_time *then = fw_arena_array(w->arena, fw_process_time, steps);
    FW_NEED(then);
    for (int i = 0; i < w->n; i++) {
        fw_measuring_item *item = &w->item[i];
        if (!item->id) continue;
        if (item->unknown) FW_TRY(find_needed(w, item));
        if (isnan(item->value) || !better(item)) continue;
        /* the device file may have set the value since, with its uncertainty in proportion */
        const fw_quantity *q = fw_process_flow_quantity(in->flow, item->id);
        double value = q && !q->unknown ? q->value : item->value;
        const fw_process_with with = {item->id, value, item->after};
        fw_arena *scratch = fw_arena_part(w->arena, 0);
        FW_NEED(scratch);
        fw_status status = fw_process_flow_times_with(scratch, in->flow, &with, in->facts, then);
        if (status == FW_OK) status = compare_times(w, item, then);
        fw_arena_free(scratch);
        FW_TRY(status);
    }
    return FW_OK;
}

/* ---- the whole ---- */

/* What each input of a flow is worth, measured alone: sigma_x becomes that of its reading, the value is
   kept; the ranges of what is made and the times of all steps follow as from a laboratory pack, and the
   corners are searched again. In: SI. Out: bands as shares of limits, windows in s. Range: that of the
   verdict's search; a value that turns out beside the nominal one moves the band and is not in it.
   Error: none beside those of the search and of the laws. Cost: out->judged devices, and one pass over
   the flow's laws per input. Source: docs/theory/measurements.md. Test: test_measuring.c. */
fw_status fw_measuring_run(fw_arena *arena, const fw_measuring_request *request,
                           const fw_measuring **out) {
    const fw_verdict_variant_verdict *v = request->verdict;
    size_t most = (size_t)request->flow->nquantity + (size_t)v->ninput;
    fw_measuring *m = fw_arena_one(arena, fw_measuring);
    work w = {.arena = arena,
              .in = request,
              .out = m,
              .item = fw_arena_array(arena, fw_measuring_item, most),
              .input = fw_arena_array(arena, const fw_verdict_fabrication_input *, most),
              .ninput = fw_arena_array(arena, int, most)};
    FW_NEED(m && w.item && w.input && w.ninput ? m : NULL);
    *m = (fw_measuring){.hinge = FW_NONE, .requirement = FW_NONE, .nothing = ""};
    m->judged_made = v->fabricated != NULL;
    m->asked = request->bands;
    FW_TRY(fw_process_measurables(arena, request->flow, &w.reading, &w.nreading));
    FW_TRY(find_quantities(&w));
    if (m->judged_made) {
        FW_TRY(find_made(&w));
        FW_TRY(add_materials(&w));
        FW_TRY(look_at_made(&w));
    }
    FW_TRY(find_windows(&w));
    FW_TRY(fw_measuring_rank(arena, m, w.item, w.n));
    *out = m;
    return FW_OK;
}
