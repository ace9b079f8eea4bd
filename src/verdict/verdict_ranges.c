/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The search over what a flow may make (verdict_corners.c) once more: with other ranges than those that the device
   was judged with, and at any point of them. Behind it, which check a verdict rests on, and why a design is rejected. */
#include "verdict/verdict_fabrication.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- what no mask draws ----
   A contact may be with something that no mask of the device draws. An object, or a stop that is put there, stands where
   it is stated; what is etched of the same layer by a mask that somebody adds has an edge that moves as all do. Where
   the file does not say which, the device is judged as both, which is twice the devices; a trial that is refused as
   placed is not asked again. Decision 151. Test: test_not_drawn.c

   Walls that lean meet first at the face where they stand out most, and from there on over ever more of the depth. How stiff a
   contact is over a part of it no stiffness that is stated says: with all of it from the first touch on nothing presses
   more, and where it begins only as the middles of the walls would meet nothing presses less, for the mean over the depth of
   what overlaps is at least the overlap of the means. So the device is judged as both (device.h, meets_midway). Decision 223.
   Test: tests/cli/test_near_pull_in.py LeaningWalls */

static double largest_of(const fw_verdict_fabricated_verdict *f) {
    double most = -HUGE_VAL;
    for (int i = 0; f && i < f->ncorner * f->ncheck; i++)
        most = fmax(most, f->ln[i]); /* NaN is passed */
    return most;
}

static const char *const how[] = {
    [FW_ACCEPT] = "accepted", [FW_REJECT] = "rejected", [FW_INCONCLUSIVE] = "undecided"};

/* reasons of the worse stand, from `first` on; text NULL: FW_NOMEM */
static fw_status differ(int number, const char *text, int first, fw_verdict_variant_verdict *v) {
    double keep = FW_VERDICT_KEEP_HALF;
    FW_NEED(text);
    for (int i = first; i < v->nreason; i++) {
        if (v->reason[i].decision == FW_REJECT) v->reason[i].decision = FW_INCONCLUSIVE;
        keep = v->reason[i].keep;
    }
    v->decision = FW_INCONCLUSIVE;
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = "as made",
                                                  .flow = v->variant->flow,
                                                  .number = number,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = keep,
                                                  .text = text};
    return FW_OK;
}

static fw_status differ_by_place(fw_arena *arena, const char *id, int first,
                                 const fw_verdict_variant_verdict *placed,
                                 const fw_verdict_variant_verdict *etched,
                                 fw_verdict_variant_verdict *v) {
    const char *text = fw_arena_printf(
        arena,
        "%s%s touches what no mask of %s draws: put there at its place the device is %s as the "
        "flow makes it, and etched of the same layer, so that its edge moves as all edges do, it "
        "is %s: say which it is (undrawn=\"placed\" or undrawn=\"etched\"), or leave the contact "
        "more room",
        FW_NAMED("contact", id), v->variant->flow ? v->variant->flow : "this flow",
        how[placed->decision], how[etched->decision]);
    return differ(657, text, first, v);
}

/* may walls lean, and do contacts of the flow meet? */
static bool contacts_lean(const fw_device *device, const char *flow,
                          const fw_verdict_fabrication_input *input, int ninput) {
    bool leans = false, touch = false;
    for (int i = 0; i < ninput; i++)
        leans = leans || input[i].flare_m != 0 || input[i].flare_at_m != 0;
    for (int i = 0; leans && i < device->nscene; i++)
        touch = touch ||
                (device->scene[i].ncontact > 0 && fw_device_in_flow(device->scene[i].flow, flow));
    return touch;
}

static fw_status meets_midway(fw_arena *arena, const fw_device *device, const fw_device **as) {
    fw_device *d = fw_arena_one(arena, fw_device);
    FW_NEED(d);
    *d = *device;
    d->meets_midway = true;
    *as = d;
    return FW_OK;
}

static fw_status differ_by_lean(fw_arena *arena, int first, const fw_verdict_variant_verdict *one,
                                const fw_verdict_variant_verdict *midway,
                                fw_verdict_variant_verdict *v) {
    const char *text = fw_arena_printf(
        arena,
        "walls of %s lean, so that contacts meet first at the face of the layer where they stand "
        "out most: with their whole stiffness from there on the device is %s, and with none before "
        "the middles of the walls meet it is %s; how stiff they are between is not known: leave "
        "them more room, or etch straighter walls",
        v->variant->flow ? v->variant->flow : "this flow", how[one->decision],
        how[midway->decision]);
    return differ(712, text, first, v);
}

static double end_of(double all, double of_corner) {
    return isnan(all) ? of_corner : all;
}

/* bands of what is required hold what either says */
static void hold_both(const fw_verdict_variant_verdict *one,
                      const fw_verdict_variant_verdict *other, fw_verdict_variant_verdict *v) {
    for (int k = 0; k < v->nrequirement; k++) {
        if (!one->fabricated->requirement || !other->fabricated->requirement) return;
        const fw_verdict_requirement *a = &one->fabricated->requirement[k],
                                     *b = &other->fabricated->requirement[k];
        fw_verdict_requirement *to = &v->fabricated->requirement[k];
        if (a->why || b->why) continue;
        const double low = fmin(a->low, b->low), high = fmax(a->high, b->high);
        if (!isnan(a->all_low) || !isnan(b->all_low)) {
            to->all_low = fmin(end_of(a->all_low, a->low), end_of(b->all_low, b->low));
            to->all_high = fmax(end_of(a->all_high, a->high), end_of(b->all_high, b->high));
        }
        to->low = low, to->high = high, fw_verdict_row_settle(to);
    }
}

/* all ways in which contacts may meet; in haste only until one is refused */
static fw_status of_contacts(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict_options *options, fw_verdict_variant_verdict *v) {
    enum { ETCHED = 1, MIDWAY = 2, WAYS = 4 };
    const bool asked = v->ninput > 0 && options->corners != FW_CORNERS_NONE,
               leans = asked && contacts_lean(device, v->variant->flow, v->input, v->ninput);
    const char *id = asked ? fw_verdict_undrawn_not_said(device, layout, v->variant->flow) : NULL;
    const size_t n = (size_t)v->nreason, most = fw_verdict_reasons_most(device, v->nrequirement);
    const fw_verdict_variant_verdict drawn = *v;
    fw_verdict_variant_verdict of[WAYS];
    bool known[WAYS] = {true}, same = true;
    FW_TRY(fw_verdict_as_fabricated(arena, device, layout, options, v));
    const bool quick = options->corners != FW_CORNERS_AUTO;
    if (!(id || leans) || !v->fabricated || (quick && v->decision != FW_ACCEPT)) return FW_OK;
    of[0] = *v;
    for (int way = 1; way < WAYS; way++) {
        const fw_device *as = device;
        if (((way & ETCHED) && !id) || ((way & MIDWAY) && !leans)) continue;
        if (quick && v->decision != FW_ACCEPT) break;
        if (way & ETCHED) FW_TRY(fw_verdict_undrawn_as(arena, device, FW_UNDRAWN_ETCHED, &as));
        if (way & MIDWAY) FW_TRY(meets_midway(arena, as, &as));
        of[way] = drawn;
        FW_NEED(of[way].reason =
                    fw_arena_grow(arena, of[way].reason, n, most, sizeof *of[way].reason));
        FW_TRY(fw_verdict_as_fabricated(arena, as, layout, options, &of[way]));
        if (!(known[way] = of[way].fabricated != NULL)) continue;
        of[way].fabricated->etched = (way & ETCHED) != 0;
        of[way].fabricated->midway = (way & MIDWAY) != 0;
        const fw_verdict_variant_verdict before = *v;
        const bool as_before = before.decision == of[way].decision;
        const bool tighter = largest_of(of[way].fabricated) > largest_of(before.fabricated);
        const bool worse = fw_verdict_is_worse(of[way].decision, before.decision);
        if (as_before ? tighter : worse) *v = of[way];
        hold_both(&before, &of[way], v);
        same = same && as_before;
    }
    if (same) return FW_OK;
    if (quick) {
        v->decision = FW_INCONCLUSIVE;
        return FW_OK;
    }
    for (int way = 0; way < WAYS; way += MIDWAY)
        if (known[way] && known[way | ETCHED] && of[way].decision != of[way | ETCHED].decision)
            return differ_by_place(arena, id, (int)n, &of[way], &of[way | ETCHED], v);
    return differ_by_lean(arena, (int)n, &of[0], &of[MIDWAY], v);
}

/* what nobody knows holds it open, whatever the devices do that were run */
fw_status fw_verdict_as_made(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict_options *options, fw_verdict_variant_verdict *v) {
    const char *text;
    FW_TRY(of_contacts(arena, device, layout, options, v));
    if (options->corners == FW_CORNERS_NONE || (v->drawn == FW_REJECT && !options->all_made))
        return FW_OK;
    FW_TRY(fw_verdict_not_known(arena, v, &text));
    if (!text) return FW_OK;
    v->decision = fw_verdict_worse(v->decision, FW_INCONCLUSIVE);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = "as made",
                                                  .flow = v->variant->flow,
                                                  .number = 694,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = FW_VERDICT_KEEP_HALF,
                                                  .not_by_loads = true,
                                                  .not_by_width = true,
                                                  .text = text};
    return FW_OK;
}

/* the device as the governing of the two was judged */
static fw_status as_judged(fw_arena *arena, const fw_verdict_variant_verdict *v,
                           const fw_device **device) {
    const fw_verdict_fabricated_verdict *f = v->fabricated;
    if (f && f->etched) FW_TRY(fw_verdict_undrawn_as(arena, *device, FW_UNDRAWN_ETCHED, device));
    if (f && f->midway) FW_TRY(meets_midway(arena, *device, device));
    return FW_OK;
}

/* ---- other ranges ----
   The bands that they leave. Theory: docs/theory/measurements.md. */

/* what was run for the verdict, found again by what was made */
static fw_status take_known(fw_arena *arena, const fw_verdict_variant_verdict *v,
                            fw_verdict_search *s) {
    const fw_verdict_fabricated_verdict *f = v->fabricated;
    if (!f || f->ncheck != s->ncheck) return FW_OK;
    fw_verdict_known *known = fw_arena_array(arena, fw_verdict_known, (size_t)f->ncorner);
    FW_NEED(known);
    for (int i = 0; i < f->ncorner; i++)
        known[i] =
            (fw_verdict_known){fw_verdict_fabrication_at(v->input, v->ninput, f->corner[i].x),
                               &f->corner[i], f->ln + (size_t)i * (size_t)f->ncheck};
    s->known = known;
    s->nknown = f->ncorner;
    return FW_OK;
}

/* ---- bands of what was run ---- */

static void widen(fw_verdict_band *b, double used) {
    if (isnan(used)) return;
    b->low = isnan(b->low) ? used : fmin(b->low, used);
    b->high = isnan(b->high) ? used : fmax(b->high, used);
}

/* nothing of it was judged, and something speaks against it: a flexure is gone */
static bool is_gone(const fw_verdict_fabricated_corner *c, int nhinge) {
    for (int k = 0; k < nhinge; k++)
        if (c->hinge[k].scene) return false;
    return c->why && !c->requirement;
}

static void bands(const fw_verdict_search *s, fw_verdict_band *hinge,
                  fw_verdict_band *requirement) {
    const fw_verdict_band none = {(double)NAN, (double)NAN};
    int nhinge = s->v->nhinge, nrequirement = s->v->nrequirement;
    for (int k = 0; k < nhinge; k++)
        hinge[k] = none;
    for (int i = 0; i < nrequirement; i++)
        requirement[i] = none;
    for (int c = 0; c < s->fabricated->ncorner; c++) {
        const fw_verdict_fabricated_corner *corner = &s->fabricated->corner[c];
        bool gone = is_gone(corner, nhinge);
        for (int k = 0; k < nhinge; k++)
            if (gone || corner->hinge[k].scene)
                widen(&hinge[k], gone ? (double)INFINITY : corner->hinge[k].utilisation);
        for (int i = 0; i < nrequirement; i++)
            if (gone || corner->requirement)
                widen(&requirement[i],
                      gone ? (double)INFINITY : corner->requirement[i].utilisation);
    }
}

/* nothing differs from the drawing */
static void as_drawn(const fw_verdict_variant_verdict *v, fw_verdict_band *hinge,
                     fw_verdict_band *requirement, fw_verdict_ranges *out) {
    for (int k = 0; k < v->nhinge; k++) {
        double used = v->hinge[k].scene ? v->hinge[k].utilisation : (double)NAN;
        hinge[k] = (fw_verdict_band){used, used};
    }
    for (int i = 0; i < v->nrequirement; i++) {
        double used = v->requirement[i].utilisation;
        requirement[i] = (fw_verdict_band){used, used};
    }
    out->decision = v->drawn;
}

/* ---- both ends ---- */

/* the largest check of a hinge, of the nominal device */
static int check_of(const fw_verdict_search *s, int hinge) {
    int checks = s->device->nscene + 1, check = FW_NONE;
    for (int r = hinge * checks; r < (hinge + 1) * checks; r++)
        if (!isnan(s->ln[r]) && (check == FW_NONE || s->ln[r] > s->ln[check])) check = r;
    return check;
}

static fw_status run_ends(fw_verdict_search *s, int hinge) {
    const fw_verdict_variant_verdict *v = s->v;
    int check = hinge == FW_NONE ? FW_NONE : check_of(s, hinge);
    int requirements = v->nhinge * (s->device->nscene + 1) + s->device->nscene;
    if (check != FW_NONE) FW_TRY(fw_verdict_search_ends(s, check));
    for (int i = 0; i < v->nrequirement; i++)
        FW_TRY(fw_verdict_search_ends(s, requirements + i));
    return FW_OK;
}

static fw_status run(fw_arena *scratch, const fw_device *device, const fw_layout *layout,
                     const fw_verdict_options *options, const fw_verdict_variant_verdict *v,
                     const fw_verdict_variant_verdict *with, int hinge, fw_verdict_band *of_hinge,
                     fw_verdict_band *of_requirement, fw_verdict_ranges *out) {
    fw_verdict_search s;
    FW_TRY(fw_verdict_search_begin(scratch, device, layout, options, with, &s));
    FW_TRY(take_known(scratch, v, &s));
    FW_TRY(fw_verdict_search_corners(&s));
    fw_verdict_search_govern(&s); /* by the corners that the verdict itself looks at */
    out->decision = s.fabricated->decision;
    FW_TRY(run_ends(&s, hinge));
    bands(&s, of_hinge, of_requirement);
    out->judged = s.judged;
    return FW_OK;
}

/* Bands of the utilisation over the box of ranges, by the corners that the verdict's own search runs,
   and by the two corners at which a check is highest and lowest to first order.
   In: v as judged; input (ninput) in SI. Out: shares of limits, 1. Range: as the verdict's, one device
   for each corner; where first order is off by more than 0.3 all corners are run. Error: that of a run,
   of the corners that were run; between them as far as utilisation is monotone. Cost: the devices of
   out->judged. Source: docs/theory/measurements.md. Test: test_ranges.c. */
fw_status fw_verdict_ranges_judge(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_verdict_options *options,
                                  const fw_verdict_variant_verdict *v,
                                  const fw_verdict_fabrication_input *input, int ninput, int hinge,
                                  fw_verdict_ranges *out) {
    fw_verdict_band *of_hinge = fw_arena_array(arena, fw_verdict_band, (size_t)v->nhinge),
                    *of_requirement =
                        fw_arena_array(arena, fw_verdict_band, (size_t)v->nrequirement);
    FW_NEED(of_hinge && of_requirement ? of_hinge : NULL);
    *out = (fw_verdict_ranges){.hinge = of_hinge, .requirement = of_requirement};
    if (ninput == 0) {
        as_drawn(v, of_hinge, of_requirement, out);
        return FW_OK;
    }
    fw_verdict_variant_verdict with = *v;
    with.input = input;
    with.ninput = ninput;
    with.nsuspect = 0;
    fw_arena *scratch = fw_arena_part(arena, 0);
    FW_NEED(scratch);
    fw_status status = as_judged(scratch, v, &device);
    if (status == FW_OK)
        status =
            run(scratch, device, layout, options, v, &with, hinge, of_hinge, of_requirement, out);
    fw_arena_free(scratch);
    return status;
}

/* ---- any point ----
   One device that a flow may make, at any point of its inputs: the largest share of a limit that it uses, for
   whoever draws many of them. Theory: docs/theory/as-fabricated.md. */

/* a flexure cut through, or a scene that cannot be run through, is beyond its limit by no known share */
static const double beyond = 0.5;

/* what is refused for sure fails at both ends of its bands, and what is not accepted at the upper one, whatever its shares */
static void read_by_bands(const fw_verdict_by_value *b, fw_verdict_made *out) {
    const bool sure = b->sure || out->decision == FW_REJECT;
    const double low = sure && b->low <= 0 ? beyond : b->low;
    const double high = out->decision != FW_ACCEPT && b->high <= 0 ? beyond : b->high;
    out->low = isnan(out->ln) ? out->ln : fmin(low, out->ln);
    out->high = isnan(out->ln) ? out->ln : fmax(high, out->ln);
}

fw_status fw_verdict_die_at(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                            const fw_verdict_options *options, const fw_verdict_variant_verdict *v,
                            const double *x, fw_verdict_die *die) {
    fw_verdict_search s;
    fw_verdict_options glance = *options;
    fw_verdict_made *out = &die->made;
    glance.at_a_glance = true; /* the value counts, not the decision */
    FW_TRY(as_judged(arena, v, &device));
    fw_verdict_by_value by_value = {0};
    FW_TRY(fw_verdict_search_begin(arena, device, layout, &glance, v, &s));
    s.by_value = &by_value;
    s.told->of = 0; /* who draws them counts them */
    FW_TRY(fw_verdict_search_run(&s, x, FW_NO_CORNER));
    const fw_verdict_fabricated_corner *c = &s.fabricated->corner[0];
    *out = (fw_verdict_made){.decision = c->decision, .ln = -HUGE_VAL};
    die->hinge = c->hinge, die->requirement = c->requirement;
    die->ln = s.ln;
    for (int r = 0; r < s.ncheck; r++)
        out->ln = fmax(out->ln, s.ln[r]); /* NaN is passed */
    /* what would meet first is looked for no further than it counts: up to there a clearance has no number of its own */
    const int clearances = v->nhinge * (device->nscene + 1) + device->nscene + v->nrequirement;
    for (int r = clearances; r < clearances + device->nscene; r++)
        if (s.ln[r] <= log(fw_verdict_clearance_counts)) s.ln[r] = (double)NAN;
    out->why = c->why;
    if (c->decision == FW_REJECT && out->ln <= 0 && c->why) out->ln = beyond;
    if (by_value.fails && out->ln <= 0) out->ln = beyond;
    if (by_value.open && out->ln <= 0) out->ln = (double)NAN;
    if (!isfinite(out->ln)) out->ln = c->decision == FW_REJECT ? beyond : (double)NAN;
    read_by_bands(&by_value, out);
    return FW_OK;
}

fw_status fw_verdict_made_at(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict_options *options, const fw_verdict_variant_verdict *v,
                             const double *x, fw_verdict_made *out) {
    fw_arena *scratch = fw_arena_part(arena, 0);
    FW_NEED(scratch);
    fw_verdict_die die;
    fw_status status = fw_verdict_die_at(scratch, device, layout, options, v, x, &die);
    if (status == FW_OK) {
        *out = die.made;
        if (out->why && !(out->why = fw_arena_strdup(arena, out->why))) status = FW_NOMEM;
    }
    fw_arena_free(scratch);
    return status;
}

/* ---- which check ----
   Of all flows, as each makes the device, or as it is drawn. */

int fw_verdict_most_used(const fw_verdict_variant_verdict *v) {
    int worst = FW_NONE;
    double most = -1.0;
    for (int k = 0; k < v->nhinge; k++) {
        const fw_verdict_hinge_verdict *h =
            &v->fabricated->corner[v->fabricated->hinge[k].corner].hinge[k];
        if (h->scene && h->utilisation > most) most = h->utilisation, worst = k;
    }
    return worst;
}

static const char *limit_of(const fw_verdict_hinge_verdict *h) {
    bool by_fatigue = h->limit && strcmp(h->limit->criterion, "fatigue") == 0;
    return by_fatigue ? "its fatigue limit" : "its elastic limit";
}

static fw_verdict_check hinge_check(const fw_verdict_hinge_verdict *h, const char *flow,
                                    const char *corner) {
    return (fw_verdict_check){.of = limit_of(h),
                              .used = h->utilisation,
                              .low = h->utilisation_low,
                              .high = h->utilisation_high,
                              .flow = flow,
                              .scene = h->scene,
                              .corner = corner,
                              .t_s = h->t_s,
                              .most = (double)NAN,
                              .decision = fw_verdict_by_band(h),
                              .hinge = h};
}

/* a bound that is what was drawn has no share of it: only its decision counts */
static fw_verdict_check of_requirement(const fw_verdict_requirement *r, const char *corner) {
    return (fw_verdict_check){.used = r->utilisation,
                              .low = r->utilisation_low,
                              .high = r->utilisation_high,
                              .flow = r->flow,
                              .scene = r->scene ? r->scene : fw_verdict_at_rest,
                              .corner = corner,
                              .t_s = r->t_s,
                              .most = (double)NAN,
                              .decision = r->decision,
                              .requirement = r};
}

static void keep(fw_verdict_check *worst, bool *found, fw_verdict_check now) {
    if (*found) {
        const bool more = now.used > worst->used || (isnan(worst->used) && !isnan(now.used));
        if (!fw_verdict_is_worse(now.decision, worst->decision) &&
            !(now.decision == worst->decision && more))
            return;
    }
    *worst = now, *found = true;
}

static void drawn(const fw_verdict_variant_verdict *v, int kinds, fw_verdict_check *worst,
                  bool *found) {
    for (int k = 0; (kinds & FW_CHECK_HINGES) && k < v->nhinge; k++)
        if (v->hinge[k].scene)
            keep(worst, found,
                 hinge_check(&v->hinge[k], v->variant ? v->variant->flow : NULL, NULL));
    for (int k = 0; (kinds & FW_CHECK_REQUIREMENTS) && k < v->nrequirement; k++)
        keep(worst, found, of_requirement(&v->requirement[k], NULL));
}

/* of what was run: every corner */
static void as_made(const fw_verdict_variant_verdict *v, int kinds, fw_verdict_check *worst,
                    bool *found) {
    for (int c = 0; c < v->fabricated->ncorner; c++) {
        const fw_verdict_fabricated_corner *corner = &v->fabricated->corner[c];
        for (int k = 0; (kinds & FW_CHECK_HINGES) && k < v->nhinge; k++)
            if (corner->hinge[k].scene)
                keep(worst, found, hinge_check(&corner->hinge[k], v->variant->flow, corner->what));
    }
    for (int k = 0; (kinds & FW_CHECK_REQUIREMENTS) && k < v->nrequirement; k++) {
        int c;
        const fw_verdict_requirement *r = fw_verdict_requirement_made(v, k, &c);
        if (r) keep(worst, found, of_requirement(r, v->fabricated->corner[c].what));
    }
}

/* what no corner exceeds, run or not */
static double most_of(const fw_verdict *verdict) {
    double most = (double)NAN;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; v->fabricated && k < v->nhinge; k++)
            most = fmax(most, v->fabricated->hinge[k].most);
    }
    return most;
}

fw_status fw_verdict_governing(fw_arena *arena, const fw_verdict *verdict, int kinds, bool made,
                               fw_verdict_check *check, bool *found) {
    *found = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (made && v->fabricated)
            as_made(v, kinds, check, found);
        else
            drawn(v, kinds, check, found);
    }
    if (!*found) return FW_OK;
    if (made && check->hinge) check->most = most_of(verdict);
    const fw_verdict_requirement *r = check->requirement;
    check->what = r ? fw_arena_printf(arena, "%s%s (%s)", FW_NAMED("requirement", r->probe),
                                      r->measure ? r->measure : r->kind)
                    : fw_arena_printf(arena, "%s%s", FW_NAMED("hinge", check->hinge->id));
    FW_NEED(check->what);
    if (r) FW_NEED(check->of = fw_verdict_requirement_text(arena, r));
    return FW_OK;
}

/* ---- why it is not accepted ----
   Each reason once: what stands at the top of every result, on certificates, order sheets and run
   sheets that are written all the same. */

/* a requirement is of a scene, and its sentence is of its value alone */
static bool is_of_scene(const fw_verdict_reason *r) {
    return r->number == 330 || r->number == 331;
}

static bool is_same(const fw_verdict_reason *a, const fw_verdict_reason *b) {
    return a->decision == b->decision && a->number == b->number && strcmp(a->text, b->text) == 0 &&
           (!is_of_scene(a) || fw_text_same(a->scene, b->scene));
}

static bool says(const fw_verdict_variant_verdict *v, int n, const fw_verdict_reason *r) {
    for (int k = 0; k < n; k++)
        if (is_same(&v->reason[k], r)) return true;
    return false;
}

/* ", flow one and two": of those that say it; "" where all do, or the sentence names it itself */
static void flows_of(fw_text *text, const fw_verdict *v, const fw_verdict_reason *r) {
    int count = 0, named = 0;
    for (int i = 0; i < v->nvariant; i++)
        count += says(&v->variant[i], v->variant[i].nreason, r);
    for (int i = 0; i < v->nvariant && count < v->nvariant; i++) {
        const char *flow = v->variant[i].variant ? v->variant[i].variant->flow : NULL;
        if (!flow || strstr(r->text, flow) || !says(&v->variant[i], v->variant[i].nreason, r))
            continue;
        fw_text_printf(text, "%s%s", named++ ? " and " : ", flow ", flow);
    }
}

fw_status fw_verdict_reason_words(fw_arena *arena, const fw_verdict *verdict, int variant,
                                  int reason, const char **words) {
    const fw_verdict_variant_verdict *v = verdict->variant;
    const fw_verdict_reason *r = &v[variant].reason[reason];
    bool before = says(&v[variant], reason, r);
    for (int i = 0; i < variant; i++)
        before = before || says(&v[i], v[i].nreason, r);
    *words = NULL;
    if (before) return FW_OK;
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, r->text);
    if (is_of_scene(r) && strcmp(r->scene, fw_verdict_at_rest) != 0)
        fw_text_printf(&text, r->number == 331 ? ", in %s" : " in %s", r->scene);
    flows_of(&text, verdict, r);
    fw_text_printf(&text, " [FW-D%03d]", r->number);
    FW_TRY(fw_text_end(&text));
    *words = text.data;
    return FW_OK;
}

static fw_status rejection_of_hinge(fw_arena *arena, const fw_verdict_hinge_verdict *h,
                                    const char **text) {
    char used[32];
    fw_percent_text(used, sizeof used, h->utilisation);
    FW_NEED(*text = fw_arena_printf(arena, "%s%s uses %s %% of its limit in %s%s%s",
                                    FW_NAMED("hinge", h->id), used, h->scene,
                                    h->flow ? ", flow " : "", h->flow ? h->flow : ""));
    return FW_OK;
}

fw_status fw_verdict_rejections(fw_arena *arena, const fw_verdict *verdict, const char ***text,
                                int *n) {
    int most = verdict->nhinge;
    const char *one;
    *n = 0;
    for (int i = 0; i < verdict->nvariant; i++)
        most += verdict->variant[i].nreason;
    FW_NEED(*text = fw_arena_alloc(arena, (size_t)most, sizeof **text));
    for (int k = 0; k < verdict->nhinge; k++) {
        if (verdict->hinge[k].decision != FW_REJECT || !verdict->hinge[k].scene) continue;
        FW_TRY(rejection_of_hinge(arena, &verdict->hinge[k], &one));
        (*text)[(*n)++] = one;
    }
    for (int i = 0; i < verdict->nvariant; i++)
        for (int k = 0; k < verdict->variant[i].nreason; k++) {
            if (verdict->variant[i].reason[k].decision != FW_REJECT) continue;
            FW_TRY(fw_verdict_reason_words(arena, verdict, i, k, &one));
            if (one) (*text)[(*n)++] = one;
        }
    return FW_OK;
}
