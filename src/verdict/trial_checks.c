/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every check of a device as one number g: 0 at its limit, above 0 beyond it, nearly linear in
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

   Test: tests/cli/test_advice.py. */
#include "verdict/trial.h"
#include <math.h>
#include <string.h>

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

fw_status fw_verdict_trial_checks_new(fw_arena *arena, fw_verdict_trial *trial) {
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
    static const int own[] = {237, 238, 294, 295, 330};
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

void fw_verdict_trial_checks(fw_verdict_trial *trial, const fw_verdict *verdict,
                             const fw_layout *layout) {
    for (int k = 0; k < trial->ncheck; k++)
        trial->check[k] = trial->made[k] = (double)NAN;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (v->nrequirement != trial->verdict->variant[i].nrequirement) continue;
        of_variant(v, trial->device, block_of(trial, i, trial->check), layout, trial->brief);
        of_corners(v, trial->device, block_of(trial, i, trial->made), layout);
    }
}
