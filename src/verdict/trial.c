/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A changed copy of the device, judged again: how far each of its checks is from its limit. */
#include "verdict/advice.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- checks as numbers ----
   Every check of a device as one number g: 0 at its limit, above 0 beyond it, nearly linear in
   what may be changed. Of each flow, in this order:

     joints        ln of the largest utilisation of the flexure in any scene or required pose
     requirements  ln of the utilisation; without one, the missing margin over the larger of bound
                   and value
     scenes        clearance: what is missing of it over the distance at the start; of a pair that
                   meets, the part of the motion that is left then comes to it
     boxes         the same of required workspaces
     scenes        ln(needed / present pull-in margin)
     scenes        ln(1 / keep) of any other reason against the scene
     one           the same of reasons about no scene (a workspace out of reach, a flexure gone)

   Utilisations have their bands, but for what closer numbers would take away. What the corners make
   of a check is kept beside it: a device that is rejected as drawn has none, and a jump is no slope.

   Test: test_advice.py. */

enum { OTHERS = 1 };

typedef struct block { /* where the checks of a flow begin */
    double *joint, *requirement, *clearance, *box, *pull_in, *reason, *other;
} block;

static int size_of(const fw_device *d, int nrequirement) {
    return d->nrevolute + nrequirement + 3 * d->nscene + d->nworkspace + OTHERS;
}

static block block_of(const fw_verdict_trial *trial, int variant, double *at) {
    const fw_device *d = trial->device;
    for (int i = 0; i < variant; i++)
        at += size_of(d, trial->verdict->variant[i].nrequirement);
    block b = {.joint = at};
    b.requirement = b.joint + d->nrevolute;
    b.clearance = b.requirement + trial->verdict->variant[variant].nrequirement;
    b.box = b.clearance + d->nscene;
    b.pull_in = b.box + d->nworkspace;
    b.reason = b.pull_in + d->nscene;
    b.other = b.reason + d->nscene;
    return b;
}

static fw_status checks_new(fw_arena *arena, fw_verdict_trial *trial) {
    trial->ncheck = 0;
    for (int i = 0; i < trial->verdict->nvariant; i++)
        trial->ncheck += size_of(trial->device, trial->verdict->variant[i].nrequirement);
    FW_NEED(trial->check = fw_arena_array(arena, double, (size_t)trial->ncheck));
    FW_NEED(trial->made = fw_arena_array(arena, double, (size_t)trial->ncheck));
    return FW_OK;
}

/* the larger of the two; NaN: not known */
static void raise_to(double *g, double to) {
    *g = fmax(*g, to);
}

static void of_hinge(double *joint, const fw_verdict_hinge_verdict *h, const fw_layout *layout) {
    const double meet = h->touches && layout ? layout->hinge[h->joint].free_rad : 0;
    double used = h->utilisation_high - h->numeric;
    if (!h->scene) return;
    if (meet > 0) used = fmax(used, fabs(h->peak_angle_rad) / meet);
    if (h->decision == FW_REJECT) used = fmax(used, h->utilisation);
    if (used > 1e-6) raise_to(&joint[h->joint], log(used));
}

static double of_requirement(const fw_verdict_requirement *r) {
    if (r->why || isnan(r->value)) return (double)NAN;
    if (r->utilisation_high > 0) {
        const double numeric = r->value != 0 ? r->utilisation * r->numeric / fabs(r->value) : 0;
        return log(fmax(r->utilisation_high - numeric, r->utilisation));
    }
    const double bound = isnan(r->min) ? r->max : r->min;
    const double size = fmax(fabs(bound), fabs(r->value));
    const double missing = fmax(isnan(r->min) ? -HUGE_VAL : r->min - r->low,
                                isnan(r->max) ? -HUGE_VAL : r->high - r->max);
    return size > 0 ? missing / size : (double)NAN;
}

/* continuous where the pair begins to meet */
static double of_clearance(const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    const double start = fmax(l->start_m, 1e-7), band = fmax(c->high_m - c->m, 0);
    if (l->m <= 0) return 1 - l->share + (c->required_m + c->wall_m + band) / start + 0.01;
    return (c->required_m - c->low_m) / start;
}

static int scene_of(const fw_device *d, const char *name) {
    for (int i = 0; name && i < d->nscene; i++)
        if (strcmp(d->scene[i].name, name) == 0) return i;
    return FW_NONE;
}

/* hinges, requirements and clearances have numbers of their own */
static bool has_number(const fw_verdict_reason *r) {
    static const int own[] = {204, 237, 238, 294, 295, 330};
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        if (r->number == own[i]) return true;
    return false;
}

static void of_reason(const fw_device *d, block b, const char *scene, double keep) {
    const int i = scene_of(d, scene);
    raise_to(i == FW_NONE ? b.other : &b.reason[i], log(1 / fmin(fmax(keep, 1e-3), 0.99)));
}

static void of_corners(const fw_verdict_variant_verdict *v, const fw_device *d, block b,
                       const fw_layout *layout) {
    const fw_verdict_fabricated_verdict *f = v->fabricated;
    for (int i = 0; f && i < f->ncorner; i++) {
        const fw_verdict_fabricated_corner *c = &f->corner[i];
        for (int k = 0; k < v->nhinge; k++)
            of_hinge(b.joint, &c->hinge[k], layout);
        for (int k = 0; c->requirement && k < v->nrequirement; k++)
            raise_to(&b.requirement[k], of_requirement(&c->requirement[k]));
        bool required = false; /* then it is one of the requirements */
        for (int k = 0; c->requirement && k < v->nrequirement; k++)
            required = required || c->requirement[k].decision != FW_ACCEPT;
        if (c->why && c->decision != FW_ACCEPT && !required)
            of_reason(d, b, c->scene, c->scene ? c->keep : 0.7);
    }
}

static void of_variant(const fw_verdict_variant_verdict *v, const fw_device *d, block b,
                       const fw_layout *layout, bool brief) {
    for (int k = 0; k < v->nhinge; k++)
        of_hinge(b.joint, &v->hinge[k], layout);
    for (int k = 0; k < v->nrequirement; k++)
        raise_to(&b.requirement[k], of_requirement(&v->requirement[k]));
    for (int k = 0; k < v->nclearance; k++) {
        const fw_verdict_clearance *c = &v->clearance[k];
        const int i = c->box == FW_NONE ? scene_of(d, c->scene) : c->box;
        if (i != FW_NONE && !(brief && c->decision == FW_ACCEPT))
            raise_to(c->box == FW_NONE ? &b.clearance[i] : &b.box[i], of_clearance(c));
    }
    for (int i = 0; i < d->nscene; i++) {
        const fw_statics_pull_in *p = v->pull_in ? v->pull_in[i] : NULL;
        if (p && p->kind != FW_PULL_IN_NONE && p->margin > 0)
            raise_to(&b.pull_in[i], log(fw_statics_pull_in_margin(p) / p->margin));
    }
    for (int k = 0; k < v->nreason; k++)
        if (v->reason[k].decision != FW_ACCEPT && !has_number(&v->reason[k]))
            of_reason(d, b, v->reason[k].scene, v->reason[k].keep);
}

static void checks_of(fw_verdict_trial *trial, const fw_verdict *verdict, const fw_layout *layout) {
    for (int k = 0; k < trial->ncheck; k++)
        trial->check[k] = trial->made[k] = (double)NAN;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (v->nrequirement != trial->verdict->variant[i].nrequirement) continue;
        of_variant(v, trial->device, block_of(trial, i, trial->check), layout, trial->brief);
        of_corners(v, trial->device, block_of(trial, i, trial->made), layout);
    }
}

/* ---- the copy and its verdict ---- */

static fw_status copy_scenes(fw_arena *arena, fw_device *d) {
    size_t n = (size_t)d->nscene;
    FW_NEED(d->scene = fw_arena_grow(arena, d->scene, n, n, sizeof *d->scene));
    for (size_t i = 0; i < n; i++)
        FW_TRY(fw_device_own_scene(arena, &d->scene[i]));
    return FW_OK;
}

static fw_status copy_device(fw_arena *arena, const fw_device *device, fw_device **copy) {
    FW_NEED(*copy = fw_arena_one(arena, fw_device));
    fw_device *d = *copy;
    *d = *device;
    size_t f = (size_t)d->nflexure, w = (size_t)d->nworkspace;
    FW_NEED(d->flexure = fw_arena_grow(arena, d->flexure, f, f, sizeof *d->flexure));
    FW_NEED(d->workspace = fw_arena_grow(arena, d->workspace, w, w, sizeof *d->workspace));
    return copy_scenes(arena, d);
}

/* the tightest device that the flow may make, where that is worse than the drawn one */
static void remember_fabricated(const fw_verdict_variant_verdict *v, fw_verdict_trial_hinge *to,
                                const fw_layout *layout) {
    const fw_verdict_fabricated_verdict *fabricated = v->fabricated;
    for (int k = 0; k < v->nhinge; k++) {
        const fw_verdict_hinge_verdict *h =
            &fabricated->corner[fabricated->hinge[k].corner].hinge[k];
        if (h->joint != to->joint || !h->scene) continue;
        double meet = h->touches && layout ? layout->hinge[h->joint].free_rad : 0.0;
        to->decision = fw_verdict_worse(to->decision, h->decision);
        if (h->utilisation_high > to->utilisation_high) {
            to->utilisation_high = h->utilisation_high;
            to->scene = h->scene;
            to->flow = v->variant->flow;
        }
        to->likely = fmax(to->likely, h->utilisation_high - h->numeric);
        if (meet > 0.0) to->reach = fmax(to->reach, fabs(h->peak_angle_rad) / meet);
    }
}

static bool same_corner(const double *a, const double *b, int n) {
    for (int k = 0; k < n; k++)
        if (fabs(a[k] - b[k]) > 1e-9 * fmax(fabs(a[k]), fabs(b[k]))) return false;
    return true;
}

/* x becomes the first one; of too many that which governed longest ago goes */
static void suspect_first(fw_verdict_suspects *s, const double *x, int n) {
    int at = 0;
    while (at < s->count && !same_corner(s->x[at], x, n))
        at++;
    if (at == s->count && s->count < FW_VERDICT_SUSPECTS) s->count++;
    if (at == FW_VERDICT_SUSPECTS) at--;
    for (int i = at; i > 0; i--)
        memcpy(s->x[i], s->x[i - 1], sizeof s->x[i]);
    memcpy(s->x[0], x, (size_t)n * sizeof *x);
}

/* a point of the ranges `from` at the same place of the ranges `to` */
static double carried(const fw_verdict_fabrication_input *from,
                      const fw_verdict_fabrication_input *to, double x) {
    double wide = from->high - from->low;
    return wide > 0 ? to->low + (x - from->low) / wide * (to->high - to->low) : to->nominal;
}

static void keep_suspects(fw_verdict_trial *trial, const fw_verdict_variant_verdict *variant) {
    for (int i = 0; i < trial->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &variant[i], *was = &trial->verdict->variant[i];
        double x[FW_FABRICATION_INPUTS];
        if (!v->fabricated || was->ninput != v->ninput) continue;
        for (int k = 0; k < v->ninput; k++)
            x[k] = carried(&v->input[k], &was->input[k],
                           v->fabricated->corner[v->fabricated->at].x[k]);
        suspect_first(&trial->suspect[i], x, v->ninput); /* of an accepted device the tightest */
    }
}

static void remember(fw_verdict_trial *trial, const fw_verdict *verdict, const fw_layout *layout) {
    trial->nhinge = verdict->nhinge;
    trial->decision = verdict->decision;
    trial->fabricated = 0;
    checks_of(trial, verdict, layout);
    trial->all_made = true;
    for (int i = 0; i < verdict->nvariant; i++) {
        trial->fabricated += verdict->variant[i].fabricated != NULL;
        trial->all_made =
            trial->all_made && (verdict->variant[i].fabricated || verdict->variant[i].ninput == 0);
    }
    for (int k = 0; k < verdict->nhinge; k++) {
        const fw_verdict_hinge_verdict *h = &verdict->hinge[k];
        double meet = h->touches && layout ? layout->hinge[h->joint].free_rad : 0.0;
        trial->hinge[k] =
            (fw_verdict_trial_hinge){.joint = h->joint,
                                     .decision = h->decision,
                                     .utilisation_high = h->utilisation_high,
                                     .likely = h->utilisation_high - h->numeric,
                                     .reach = meet > 0.0 ? fabs(h->peak_angle_rad) / meet : 0.0,
                                     .scene = h->scene,
                                     .flow = h->flow};
        for (int i = 0; i < verdict->nvariant; i++)
            if (verdict->variant[i].fabricated)
                remember_fabricated(&verdict->variant[i], &trial->hinge[k], layout);
    }
    for (int i = 0; i < verdict->nvariant; i++)
        for (int k = 0; k < verdict->variant[i].nreason; k++) {
            const fw_verdict_reason *r = &verdict->variant[i].reason[k];
            if (r->number == 237 || r->number == 238) continue; /* as made: here and above */
            trial->hinge[trial->nhinge++] =
                (fw_verdict_trial_hinge){.joint = FW_NONE,
                                         .decision = r->decision,
                                         .utilisation_high = 1 / r->keep,
                                         .likely = 1 / r->keep,
                                         .not_by_loads = r->not_by_loads,
                                         .not_by_width = r->not_by_width,
                                         .either_way = r->either_way,
                                         .scene = r->scene,
                                         .flow = r->flow};
        }
    for (int i = 0; i < verdict->nvariant; i++) { /* beside hinges; gone: has no utilisation */
        const fw_verdict_fabricated_verdict *fabricated = verdict->variant[i].fabricated;
        if (!fabricated || fabricated->decision == FW_ACCEPT) continue;
        const fw_verdict_fabricated_corner *c = &fabricated->corner[fabricated->at];
        if (!c->why) continue;
        trial->hinge[trial->nhinge++] =
            (fw_verdict_trial_hinge){.joint = FW_NONE,
                                     .decision = fabricated->decision,
                                     .utilisation_high = c->scene ? 1 / c->keep : 1.3,
                                     .likely = c->scene ? 1 / c->keep : 1.3,
                                     .not_by_loads = c->not_by_loads,
                                     .not_by_width = c->not_by_width,
                                     .scene = c->scene ? c->scene : "as made",
                                     .flow = verdict->variant[i].variant->flow};
    }
}

/* is it drawn, where the device as described is? Of bodies without shapes nothing is drawn whatever is changed */
static bool may_stand(const fw_verdict_trial *trial, const fw_layout *layout) {
    return layout && (layout->drawn || (trial->shapeless && layout->nfault == 0));
}

fw_status fw_verdict_trial_reset(fw_verdict_trial *trial) {
    for (int i = 0; i < trial->device->nscene; i++)
        trial->share[i] = 1;
    return copy_device(trial->arena, trial->device, &trial->changed);
}

fw_status fw_verdict_trial_start(fw_arena *arena, const fw_device *device,
                                 const fw_verdict_options *options, const fw_verdict *verdict,
                                 fw_verdict_trial *trial) {
    *trial = (fw_verdict_trial){
        .arena = arena, .device = device, .options = options, .verdict = verdict, .drawn = true};
    size_t n = (size_t)verdict->nvariant;
    const int asked = device->nrequirement * (device->nscene + 1);
    size_t most = (size_t)device->nrevolute + n * (fw_verdict_reasons_most(device, asked) + 1);
    FW_NEED(trial->suspect = fw_arena_array(arena, fw_verdict_suspects, n));
    FW_NEED(trial->hinge = fw_arena_array(arena, fw_verdict_trial_hinge, most));
    FW_NEED(trial->share = fw_arena_array(arena, double, (size_t)device->nscene));
    FW_TRY(checks_new(arena, trial));
    FW_TRY(fw_verdict_trial_reset(trial));
    const fw_layout *described = verdict->layout;
    trial->shapeless = described && !described->drawn && described->nfault == 0;
    remember(trial, verdict, verdict->layout);
    keep_suspects(trial, verdict->variant);
    trial->excess_as_described = fw_verdict_trial_excess(trial);
    return FW_OK;
}

/* ---- how closely it is looked at ---- */

/* of a motion: as at a corner. A quasi-static motion is solved at every one. */
static const int samples_of_a_glance = 65;

static fw_verdict_options options_of(fw_verdict_trial *trial, fw_verdict_look look) {
    fw_verdict_options o = *trial->options;
    o.coarse_first = true;
    if (o.corners == FW_CORNERS_AUTO) o.corners = FW_CORNERS_FIRST;
    o.work = &trial->work, o.motion.spent = &trial->spent;
    o.values = true; /* of clearances: they say which corners are run */
    trial->brief = look != FW_LOOK_VALUES;
    if (look == FW_LOOK_WHOLE) return o;
    if (o.motion.rtol <= 0) o.motion.accuracy = fmax(o.motion.accuracy, fw_verdict_first_accuracy);
    if (o.corners == FW_CORNERS_FIRST) o.corners = FW_CORNERS_SUSPECT;
    if (o.motion.samples > samples_of_a_glance) o.motion.samples = samples_of_a_glance;
    o.at_a_glance = true;
    o.decision_only = look == FW_LOOK_GLANCE;
    o.values = look == FW_LOOK_VALUES;
    return o;
}

/* ---- the description read again ---- */

static const fw_dynamics_motion *const *motions_of(const fw_verdict_trial *trial, int i) {
    return (const fw_dynamics_motion *const *)trial->verdict->variant[i].motion;
}

/* ranges follow what was changed (a thickness), and so do the corners that governed last */
static fw_status take_suspects(const fw_verdict_trial *trial, fw_arena *scratch, int i,
                               fw_verdict_variant_verdict *v) {
    const fw_verdict_variant_verdict *was = &trial->verdict->variant[i];
    const fw_verdict_suspects *from = &trial->suspect[i];
    if (from->count == 0 || was->ninput != v->ninput) return FW_OK;
    const size_t n = (size_t)v->ninput;
    double *x = fw_arena_array(scratch, double, (size_t)from->count *n);
    FW_NEED(x);
    for (int j = 0; j < from->count; j++)
        for (size_t k = 0; k < n; k++)
            x[(size_t)j * n + k] = carried(&was->input[k], &v->input[k], from->x[j][k]);
    v->suspect = x;
    v->nsuspect = from->count;
    return FW_OK;
}

/* An arena of its own, given back at once: a plan runs dozens of trials. What a trial is at is told as how much of the
   work that all may take has been done: no search goes on beyond that, and most end before. */
static fw_arena *scratch_of(fw_verdict_trial *trial) {
    fw_arena *scratch = fw_arena_part(trial->arena, 0);
    if (!scratch) return NULL;
    const double most = trial->most_work, share = most > 0 ? trial->work / most : 0.0;
    trial->told = (fw_progress_whole){.what = "looking for changes that would be accepted",
                                      .done = 100 * fmin(share, 1.0),
                                      .of = most > 0 ? -100 : 0,
                                      .unit = "%"};
    fw_arena_tell_of(scratch, &trial->told);
    fw_arena_tell(scratch, "", 0, 0, "");
    return scratch;
}

static fw_status restate(fw_verdict_trial *trial, fw_arena *scratch, const fw_device_set *set,
                         int nset, const fw_verdict_options *options) {
    const fw_verdict_restated *r = &trial->options->restated;
    int n = trial->verdict->nvariant;
    const fw_device *device = NULL;
    const fw_layout *layout = NULL;
    fw_diags diags = fw_diags_new(scratch);
    fw_verdict again = {.nvariant = n,
                        .variant = fw_arena_array(scratch, fw_verdict_variant_verdict, (size_t)n)};
    FW_NEED(again.variant);
    FW_TRY(r->with(r->context, scratch, set, nset, &device, again.variant));
    for (int i = 0; i < n; i++) {
        if (device->nscene == trial->device->nscene) again.variant[i].like = motions_of(trial, i);
        FW_TRY(take_suspects(trial, scratch, i, &again.variant[i]));
    }
    FW_TRY(fw_verdict_run(scratch, device, options, &diags, &again, &layout));
    remember(trial, &again, layout);
    keep_suspects(trial, again.variant);
    trial->drawn = may_stand(trial, layout);
    return FW_OK;
}

/* ---- settings that were accepted ----
   A search ends with what it has judged wholly, and a proposal is judged wholly once more before it is made. */

typedef struct fw_verdict_accepted {
    const fw_device_set *set; /* (nset) */
    int nset;
    const struct fw_verdict_accepted *before;
} fw_verdict_accepted;

bool fw_verdict_trial_accepted(const fw_verdict_trial *trial, const fw_device_set *set, int nset) {
    for (const fw_verdict_accepted *a = trial->accepted; a; a = a->before) {
        int same = 0;
        while (a->nset == nset && same < nset && strcmp(a->set[same].path, set[same].path) == 0 &&
               strcmp(a->set[same].value, set[same].value) == 0)
            same++;
        if (a->nset == nset && same == nset) return true;
    }
    return false;
}

static fw_status keep_accepted(fw_verdict_trial *trial, const fw_device_set *set, int nset) {
    const size_t n = (size_t)nset;
    fw_verdict_accepted *a = fw_arena_one(trial->arena, fw_verdict_accepted);
    fw_device_set *own = fw_arena_array(trial->arena, fw_device_set, n);
    FW_NEED(a && own ? own : NULL);
    for (size_t i = 0; i < n; i++) {
        FW_NEED(own[i].path = fw_arena_strdup(trial->arena, set[i].path));
        FW_NEED(own[i].value = fw_arena_strdup(trial->arena, set[i].value));
    }
    *a = (fw_verdict_accepted){own, nset, trial->accepted};
    trial->accepted = a;
    return FW_OK;
}

/* evaluations of motions that failed or were computed again, in those of hinges as work_of of variant.c has them */
static void count_spent(fw_verdict_trial *trial) {
    const double beam = 30, all = (double)atomic_exchange(&trial->spent.all, 0),
                 beams = (double)atomic_exchange(&trial->spent.beams, 0);
    const int hinges = trial->device->nrevolute;
    trial->work += fmax(all, 0) * (hinges + 1) + fmax(beams, 0) * (beam - 1) * hinges;
}

fw_status fw_verdict_trial_restate(fw_verdict_trial *trial, const fw_device_set *set, int nset,
                                   fw_verdict_look look) {
    const fw_verdict_options o = options_of(trial, look);
    fw_arena *scratch = scratch_of(trial);
    FW_NEED(scratch);
    fw_status status = restate(trial, scratch, set, nset, &o);
    fw_arena_free(scratch);
    count_spent(trial);
    for (int k = 0; k < trial->nhinge; k++) /* their names are gone */
        trial->hinge[k].scene = trial->hinge[k].flow = NULL;
    if (status == FW_OK)
        return look == FW_LOOK_WHOLE && trial->drawn && trial->decision == FW_ACCEPT
                   ? keep_accepted(trial, set, nset)
                   : FW_OK;
    trial->nhinge = 0;
    trial->decision = FW_REJECT;
    trial->drawn = false;
    for (int k = 0; k < trial->ncheck; k++)
        trial->check[k] = trial->made[k] = (double)NAN;
    return status == FW_NOMEM || status == FW_CANCELLED ? status : FW_OK;
}

double fw_verdict_trial_excess(const fw_verdict_trial *trial) {
    double most = trial->nhinge > 0 ? 0.0 : (double)NAN;
    for (int k = 0; k < trial->nhinge; k++)
        most = fmax(most, fmax(trial->hinge[k].likely, trial->hinge[k].reach));
    for (int i = 0; i < trial->verdict->nvariant;
         i++) { /* what is met counts, too: no jump at the limit */
        const double *drawn = block_of(trial, i, trial->check).requirement,
                     *made = block_of(trial, i, trial->made).requirement;
        for (int k = 0; k < trial->verdict->variant[i].nrequirement; k++)
            most = fmax(most, exp(fmax(drawn[k], made[k]))); /* NaN: not known */
    }
    return most;
}

/* ---- a copy that was changed ---- */

fw_status fw_verdict_trial_run(fw_verdict_trial *trial, fw_verdict_look look) {
    int n = trial->verdict->nvariant;
    fw_arena *scratch = scratch_of(trial);
    FW_NEED(scratch);
    fw_diags diags = fw_diags_new(scratch);
    const fw_layout *layout = NULL;
    const fw_verdict_options o = options_of(trial, look);
    fw_verdict again = {.nvariant = n,
                        .variant = fw_arena_array(scratch, fw_verdict_variant_verdict, (size_t)n)};
    fw_status status = again.variant ? FW_OK : FW_NOMEM;
    for (int i = 0; status == FW_OK && i < n; i++)
        again.variant[i] =
            (fw_verdict_variant_verdict){.variant = trial->verdict->variant[i].variant,
                                         .input = trial->verdict->variant[i].input,
                                         .ninput = trial->verdict->variant[i].ninput,
                                         .like = motions_of(trial, i)};
    for (int i = 0; status == FW_OK && i < n; i++)
        status = take_suspects(trial, scratch, i, &again.variant[i]);
    if (status == FW_OK)
        status = fw_verdict_run(scratch, trial->changed, &o, &diags, &again, &layout);
    trial->drawn = status == FW_OK && may_stand(trial, layout);
    if (status == FW_OK) {
        remember(trial, &again, layout);
        keep_suspects(trial, again.variant);
    } else {
        trial->decision = FW_REJECT;
    }
    fw_arena_free(scratch);
    count_spent(trial);
    return status == FW_NOMEM || status == FW_CANCELLED ? status : FW_OK;
}
