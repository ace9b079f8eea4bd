/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of the device beside its hinges, as JSON: probes and requirements, and how near what moves
   comes to what it may meet. */
#include "report/json_parts.h"
#include "report/report.h"
#include <math.h>

/* ---- probes and requirements ---- */

static void value(fw_json *json, const fw_verdict_requirement *r) {
    fw_json_real(json, "value", r->value);
    fw_report_json_pair(json, "band", r->low, r->high);
    fw_json_real(json, "margin", r->margin);
    fw_json_real(json, "utilisation", r->utilisation);
    fw_json_real(json, "t_s", r->t_s);
    fw_json_text(json, "verdict", fw_verdict_decision_text(r->decision));
    fw_json_text(json, "why", r->why);
}

static void made(fw_json *json, const fw_verdict_variant_verdict *v, int k) {
    int corner = 0;
    const fw_verdict_requirement *r = fw_verdict_requirement_made(v, k, &corner);
    if (!r) {
        fw_json_null(json, "as_fabricated");
        return;
    }
    fw_json_object(json, "as_fabricated");
    value(json, r);
    fw_report_json_pair(json, "all_corners_band", r->all_low, r->all_high);
    fw_json_text(json, "corner", v->fabricated->corner[corner].what);
    fw_json_end(json);
}

void fw_report_json_requirement(fw_json *json, const fw_verdict_requirement *r) {
    fw_json_text(json, "probe", r->probe);
    fw_json_text(json, "kind", r->kind);
    fw_json_text(json, "measure", r->measure);
    fw_json_text(json, "unit", r->unit);
    fw_json_text(json, "scene", r->scene);
    fw_json_text(json, "flow", r->flow);
    fw_json_real(json, "min", r->min);
    fw_json_real(json, "max", r->max);
    value(json, r);
    fw_json_text(json, "without_bodies", r->rigid);
}

static void requirement(fw_json *json, const fw_verdict_variant_verdict *v, int k) {
    fw_json_object(json, NULL);
    fw_report_json_requirement(json, &v->requirement[k]);
    made(json, v, k);
    fw_json_end(json);
}

static bool probed(const fw_verdict_variant_verdict *v, int i) {
    return v->probed && v->motion && v->probed[i].known;
}

/* of every scene and flow; nothing where the device has no probe */
static void probes(fw_json *json, const fw_report_input *in) {
    const int n = in->device->nprobe;
    if (n == 0) return;
    fw_json_list(json, "probes");
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &in->verdict->variant[i];
        for (int s = 0; s < in->device->nscene; s++)
            for (int k = 0; k < n; k++)
                if (probed(v, s * n + k))
                    fw_report_json_probe(json, &in->device->probe[k], in->device->scene[s].name,
                                         v->variant->flow, &v->probed[s * n + k]);
    }
    fw_json_end(json);
}

void fw_report_json_requirements(fw_json *json, const fw_report_input *in) {
    probes(json, in);
    fw_json_list(json, "requirements");
    for (int i = 0; i < in->verdict->nvariant; i++)
        for (int k = 0; k < in->verdict->variant[i].nrequirement; k++)
            requirement(json, &in->verdict->variant[i], k);
    fw_json_end(json);
}

/* ---- clearances ---- */

static void place(fw_json *json, const char *key, fw_geometry_vec2 p) {
    fw_json_list(json, key);
    fw_json_real(json, NULL, p.x);
    fw_json_real(json, NULL, p.y);
    fw_json_end(json);
}

static void one(fw_json *json, const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    fw_json_object(json, NULL);
    fw_json_text(json, "scene", c->scene);
    fw_json_text(json, "flow", c->flow);
    fw_json_text(json, "verdict",
                 c->decision == FW_ACCEPT   ? "accept"
                 : c->decision == FW_REJECT ? "reject"
                                            : "inconclusive");
    fw_json_text(json, "a", l->at.a);
    fw_json_text(json, "b", l->at.b);
    fw_json_real(json, "clearance_m", c->m);
    fw_json_real(json, "low_m", c->low_m);
    fw_json_real(json, "high_m", c->high_m);
    fw_json_real(json, "required_m", c->required_m);
    fw_json_real(json, "drawn_m", l->m);
    fw_json_real(json, "proved_m", isfinite(l->low_m) ? l->low_m : (double)NAN);
    fw_json_real(json, "start_m", l->start_m);
    fw_json_truth(json, "meet", l->m <= 0);
    fw_json_real(json, "share", l->share);
    place(json, "at_a_m", l->at.at_a);
    place(json, "at_b_m", l->at.at_b);
    fw_json_real(json, "t_s", c->box == FW_NONE ? l->t_s : (double)NAN);
    fw_json_real(json, "way_share", c->way.a ? c->way.share : (double)NAN);
    fw_json_text(json, "way_a", c->way.a);
    fw_json_text(json, "way_b", c->way.b);
    fw_json_end(json);
}

void fw_report_json_clearances(fw_json *json, const fw_verdict *v) {
    fw_json_list(json, "clearances");
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nclearance; k++)
            one(json, &v->variant[i].clearance[k]);
    fw_json_end(json);
}

/* ---- out of the plane ---- */

static void plate_modes(fw_json *json, const fw_verdict_out_of_plane *o) {
    enum { FEW = 6 };
    fw_json_list(json, "modes");
    for (int k = 0; k < o->nmode && k < FEW; k++) {
        const fw_verdict_plate_mode *m = &o->mode[k];
        fw_json_object(json, NULL);
        fw_json_real(json, "f_Hz", m->f_Hz);
        fw_report_json_pair(json, "band_Hz", m->low_Hz, m->high_Hz);
        fw_json_text(json, "body", m->body);
        fw_json_text(json, "kind", m->tilts ? "tilt" : "up and down");
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void across(fw_json *json, const fw_verdict_across *s) {
    fw_json_object(json, NULL);
    fw_json_text(json, "scene", s->scene);
    if (s->asked) {
        fw_json_real(json, "lowest_m", s->lowest_m);
        fw_json_real(json, "lowest_at_rest_m", s->sure_m);
        fw_json_real(json, "highest_m", s->highest_m);
        fw_json_real(json, "tilt_rad", s->tilt_rad);
        fw_json_real(json, "dynamic", s->dynamic);
        fw_json_text(json, "body", s->body);
        fw_json_real(json, "strained", s->strained);
        fw_json_real(json, "strained_sure", s->strained_sure);
        fw_json_text(json, "strained_hinge", s->strained_hinge);
    }
    const bool tips = fw_verdict_across_tips(s);
    fw_json_real(json, "tips_at", tips ? s->tips : (double)NAN);
    fw_json_real(json, "tips_error", tips ? s->tips_error : (double)NAN);
    fw_json_real(json, "lift_m", s->lift_m);
    fw_json_text(json, "verdict", fw_verdict_decision_text(s->decision));
    fw_json_end(json);
}

static void below(fw_json *json, const fw_mechanism_below *b) {
    fw_json_object(json, "below");
    fw_json_text(json, "words", b->known ? b->words : "not known");
    fw_json_real(json, "gap_m", b->known ? b->m : (double)NAN);
    fw_json_end(json);
}

void fw_report_json_out_of_plane(fw_json *json, const fw_verdict *v) {
    fw_json_list(json, "out_of_plane");
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_out_of_plane *o = v->variant[i].out_of_plane;
        if (!o) continue;
        fw_json_object(json, NULL);
        fw_json_text(json, "flow", v->variant[i].variant->flow);
        fw_json_truth(json, "known", !o->why);
        fw_json_text(json, "why", o->why);
        below(json, &v->variant[i].variant->below);
        fw_json_real(json, "stiffness_error", o->error);
        fw_json_text(json, "body", o->body);
        fw_json_real(json, "stiffness_N_per_m", o->why ? (double)NAN : o->across_N_per_m);
        fw_json_real(json, "stiffness_over_in_plane", o->why ? (double)NAN : o->ratio);
        fw_json_real(json, "weight_sag_m", o->why ? (double)NAN : o->weight_m);
        fw_json_real(json, "weight_sag_most_m", o->why ? (double)NAN : o->weight_most_m);
        plate_modes(json, o);
        fw_json_list(json, "scenes");
        for (int k = 0; k < o->nscene && !o->why; k++)
            across(json, &o->scene[k]);
        fw_json_end(json);
        fw_json_end(json);
    }
    fw_json_end(json);
}

/* ---- stiction ---- */

static double or_nothing(double value) {
    return isfinite(value) ? value : (double)NAN;
}

static void pull(fw_json *json, const char *key, const fw_verdict_pull *p) {
    fw_json_object(json, key);
    fw_json_truth(json, "known", p->known);
    fw_report_json_pair(json, "number", or_nothing(p->number[0]), or_nothing(p->number[1]));
    fw_report_json_pair(json, "bears_N_per_m", or_nothing(p->tension_N_per_m[0]),
                        or_nothing(p->tension_N_per_m[1]));
    fw_json_text(json, "a", p->a);
    fw_json_text(json, "b", p->b);
    fw_json_real(json, "gap_m", p->known && p->gap_m > 0 ? p->gap_m : (double)NAN);
    fw_json_real(json, "stiffness_N_per_m", p->stiffness_N_per_m);
    fw_json_end(json);
}

static void drying(fw_json *json, const fw_mechanism_drying *d) {
    static const char *const how[] = {[FW_DRIED_UNKNOWN] = "not known",
                                      [FW_DRIED_NEVER] = "never wet",
                                      [FW_DRIED_CALM] = "without a meniscus",
                                      [FW_DRIED_PULLED] = "with a meniscus"};
    bool pulled = d->how == FW_DRIED_PULLED;
    fw_json_object(json, "drying");
    fw_json_text(json, "how", how[d->how]);
    fw_json_text(json, "words", d->words);
    fw_json_real(json, "tension_N_per_m", pulled ? d->tension_N_per_m : (double)NAN);
    fw_report_json_pair(json, "pulls_N_per_m", pulled ? d->tension_low * d->cos_low : (double)NAN,
                        pulled ? d->tension_high * d->cos_high : (double)NAN);
    fw_json_end(json);
    fw_json_object(json, "adhesion");
    fw_json_real(json, "J_per_m2", d->adhesion_J_per_m2);
    fw_report_json_pair(json, "band_J_per_m2", d->adhesion_low, d->adhesion_high);
    fw_json_text(json, "source", d->adhesion_words);
    fw_json_end(json);
}

static void stuck(fw_json *json, const fw_verdict_stiction *s) {
    fw_json_list(json, "contacts");
    for (int k = 0; k < s->nstuck; k++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "scene", s->stuck[k].scene);
        fw_json_text(json, "hinge", s->stuck[k].hinge);
        fw_json_text(json, "contact", s->stuck[k].contact);
        fw_json_real(json, "holds_N", s->stuck[k].holds_N[1]);
        fw_json_real(json, "holds_at_least_N", s->stuck[k].holds_N[0]);
        fw_json_real(json, "opens_N", s->stuck[k].opens_N[0]);
        fw_json_text(json, "why", s->stuck[k].why);
        fw_json_text(json, "verdict", fw_verdict_decision_text(s->stuck[k].decision));
        fw_json_end(json);
    }
    fw_json_end(json);
}

fw_status fw_report_json_stiction(fw_arena *arena, fw_json *json, const fw_verdict *v) {
    fw_json_list(json, "stiction");
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_stiction *s = v->variant[i].stiction;
        const char *words;
        if (!s) continue;
        FW_TRY(fw_verdict_drying_words(arena, &v->variant[i], &words));
        fw_json_object(json, NULL);
        fw_json_text(json, "flow", v->variant[i].variant->flow);
        fw_json_text(json, "verdict", fw_verdict_decision_text(s->decision));
        fw_json_text(json, "needs", words);
        fw_json_text(json, "why", s->why);
        drying(json, &v->variant[i].variant->drying);
        pull(json, "below", &s->below);
        pull(json, "beside", &s->beside);
        fw_report_json_pair(json, "peel", or_nothing(s->peel[0]), or_nothing(s->peel[1]));
        fw_json_text(json, "peeled", s->peeled);
        fw_json_real(json, "peels_up_to_J_per_m2", or_nothing(s->adhesion_J_per_m2));
        fw_json_truth(json, "tethered", s->tethered);
        stuck(json, s);
        fw_json_end(json);
    }
    fw_json_end(json);
    return FW_OK;
}
