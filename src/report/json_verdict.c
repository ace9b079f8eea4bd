/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The verdict as JSON: hinges as drawn and as the flows make them, flows, effects, advice. */
#include "report/report.h"
#include "report/json_parts.h"
#include "report/report_page.h"
#include <math.h>

static const char *word(fw_verdict_decision decision) {
    return decision == FW_ACCEPT ? "accept" : decision == FW_REJECT ? "reject" : "inconclusive";
}

/* ---- what the flows make of the device ---- */

static void as_fabricated_input(fw_json *json, const fw_verdict_fabrication_input *in) {
    fw_quantity q = in->q;
    const struct {
        const char *key;
        double value;
    } number[] = {{"nominal", in->nominal}, {"low", in->low}, {"high", in->high}};
    fw_json_object(json, NULL);
    fw_json_text(json, "name", in->name);
    fw_json_text(json, "unit", q.unit);
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++) {
        q.value = number[i].value;
        fw_json_real(json, number[i].key, in->open ? (double)NAN : fw_quantity_in_unit(&q));
    }
    fw_json_text(json, "status", fw_quantity_value_status_text(q.status));
    fw_json_text(json, "source", q.source);
    fw_json_text(json, "not_known", in->unknown);
    fw_json_end(json);
}

static void corner(fw_json *json, const fw_verdict_fabricated_corner *c, int nhinge) {
    double most = 0.0;
    for (int k = 0; k < nhinge; k++)
        most = fmax(most, c->hinge[k].utilisation);
    fw_json_object(json, NULL);
    fw_json_text(json, "at", c->what);
    fw_json_text(json, "verdict", fw_verdict_decision_text(c->decision));
    fw_json_real(json, "utilisation", most > 0.0 ? most : (double)NAN);
    fw_json_text(json, "why", c->why);
    fw_json_end(json);
}

static void held(fw_json *json, const fw_verdict_variant_verdict *v) {
    const fw_verdict_fabricated_verdict *m = v->fabricated;
    if (m->held == FW_NONE) {
        fw_json_null(json, "held");
        return;
    }
    fw_quantity q = v->input[m->held].q;
    fw_json_object(json, "held");
    fw_json_text(json, "name", v->input[m->held].name);
    q.value = m->held_low;
    fw_json_real(json, "low", fw_quantity_in_unit(&q));
    q.value = m->held_high;
    fw_json_real(json, "high", fw_quantity_in_unit(&q));
    fw_json_end(json);
}

/* of one flow; null where nothing was judged but the drawing */
static void as_fabricated(fw_json *json, const fw_verdict_variant_verdict *v) {
    const fw_verdict_fabricated_verdict *m = v->fabricated;
    if (!m) {
        fw_json_null(json, "as_fabricated");
        return;
    }
    fw_json_object(json, "as_fabricated");
    fw_json_text(json, "verdict", fw_verdict_decision_text(m->decision));
    fw_json_list(json, "inputs");
    for (int i = 0; i < v->ninput; i++)
        as_fabricated_input(json, &v->input[i]);
    fw_json_end(json);
    fw_json_list(json, "corners");
    for (int i = 0; i < m->ncorner; i++)
        corner(json, &m->corner[i], v->nhinge);
    fw_json_end(json);
    fw_json_truth(json, "all_corners", m->all);
    fw_json_real(json, "estimate_error", m->error);
    fw_json_text(json, "reason", m->reason);
    fw_json_text(json, "control", m->control);
    held(json, v);
    fw_json_real(json, "held_share", m->held_share);
    fw_json_end(json);
}

static void contributions(fw_json *json, const fw_verdict_variant_verdict *v,
                          const fw_verdict_fabricated_hinge *h) {
    fw_json_list(json, "contributions");
    for (int i = 0; i < v->ninput; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "name", v->input[i].name);
        fw_json_real(json, "utilisation", h->share[i]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static const fw_verdict_hinge_verdict *tightest(const fw_verdict_variant_verdict *v, int joint,
                                                int *at) {
    for (int k = 0; v->fabricated && k < v->nhinge; k++) {
        if (v->hinge[k].joint != joint) continue;
        const fw_verdict_hinge_verdict *h =
            &v->fabricated->corner[v->fabricated->hinge[k].corner].hinge[k];
        *at = k;
        return h->scene ? h : NULL;
    }
    return NULL;
}

/* of one hinge, the tightest of these flows */
static void as_fabricated_hinge(fw_json *json, const fw_verdict_variant_verdict *variant,
                                int nvariant, int joint) {
    const fw_verdict_hinge_verdict *worst = NULL;
    const fw_verdict_variant_verdict *v = NULL;
    int k = 0;
    for (int i = 0; i < nvariant; i++) {
        int at = 0;
        const fw_verdict_hinge_verdict *h = tightest(&variant[i], joint, &at);
        if (h && (!worst || h->utilisation > worst->utilisation))
            worst = h, v = &variant[i], k = at;
    }
    if (!worst) {
        fw_json_null(json, "as_fabricated");
        return;
    }
    const fw_verdict_fabricated_hinge *h = &v->fabricated->hinge[k];
    fw_json_object(json, "as_fabricated");
    fw_json_real(json, "utilisation", worst->utilisation);
    fw_report_json_pair(json, "utilisation_band", worst->utilisation_low, worst->utilisation_high);
    fw_json_text(json, "verdict", fw_verdict_decision_text(worst->decision));
    fw_json_text(json, "corner", v->fabricated->corner[h->corner].what);
    fw_json_text(json, "flow", worst->flow);
    fw_json_text(json, "scene", worst->scene);
    fw_json_real(json, "peak_angle_rad", worst->peak_angle_rad);
    fw_json_real(json, "limit_angle_rad", worst->limit_angle_rad);
    fw_json_real(json, "most", h->most);
    fw_json_real(json, "nominal", v->fabricated->corner[0].hinge[k].utilisation);
    fw_json_real(json, "sigma", h->sigma);
    contributions(json, v, h);
    fw_json_end(json);
}

/* ---- hinges ---- */

/* which criterion governs, and what it rests on */
static void limit(fw_json *json, const fw_verdict_hinge_verdict *h) {
    const fw_flexure_limit *l = h->limit;
    fw_json_text(json, "criterion", l ? l->criterion : NULL);
    fw_json_text(json, "limit_definition", l ? l->definition : NULL);
    fw_json_real(json, "limit_Pa", h->limit_Pa);
    fw_json_text(json, "limit_source", l ? l->source : NULL);
    fw_json_text(json, "limit_status", l ? fw_quantity_value_status_text(l->status) : NULL);
    fw_json_real(json, "failure_probability", h->failure_probability);
    fw_json_real(json, "fatigue_utilisation", h->fatigue_utilisation);
    fw_json_real(json, "damage", h->damage);
    fw_json_real(json, "cycles", h->cycles);
}

/* shares of the utilisation, downwards and upwards */
static void band_parts(fw_json *json, const fw_verdict_band_parts *p) {
    fw_json_object(json, "band_parts");
    fw_report_json_pair(json, "root", p->root[0], p->root[1]);
    fw_report_json_pair(json, "stiffness", p->stiffness[0], p->stiffness[1]);
    fw_report_json_pair(json, "hinge_model", p->model[0], p->model[1]);
    fw_report_json_pair(json, "place", p->place[0], p->place[1]);
    fw_report_json_pair(json, "bodies", p->bodies[0], p->bodies[1]);
    fw_report_json_pair(json, "numbers", p->numbers[0], p->numbers[1]);
    fw_json_end(json);
}

/* members of the object about one hinge */
static void hinge(fw_json *json, const fw_verdict_hinge_verdict *h) {
    fw_json_text(json, "id", h->id);
    fw_json_real(json, "peak_angle_rad", h->peak_angle_rad);
    fw_json_real(json, "angle_error_rad", h->angle_error_rad);
    fw_json_real(json, "limit_angle_rad", h->limit_angle_rad);
    fw_json_real(json, "peak_strain", h->peak_strain);
    fw_json_real(json, "strain_limit", h->strain_limit);
    fw_json_real(json, "utilisation", h->utilisation);
    fw_json_real(json, "force_share", h->force_share);
    fw_json_text(json, "scene", h->scene);
    fw_json_real(json, "t_s", h->t_s);
    fw_json_text(json, "flow", h->flow);
    fw_report_json_pair(json, "utilisation_band", h->utilisation_low, h->utilisation_high);
    band_parts(json, &h->parts);
    fw_json_text(json, "verdict", word(h->decision));
    fw_json_text(json, "actuation", h->actuation);
    fw_json_real(json, "joint_force_N", h->joint_force_N);
    fw_json_real(json, "over_rotation", h->over_rotation);
    limit(json, h);
}

/* with what these flows make of them */
static void hinges(fw_json *json, const fw_verdict_hinge_verdict *item, int count,
                   const fw_verdict_variant_verdict *variant, int nvariant) {
    fw_json_list(json, "hinges");
    for (int i = 0; i < count; i++) {
        fw_json_object(json, NULL);
        hinge(json, &item[i]);
        as_fabricated_hinge(json, variant, nvariant, item[i].joint);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void governing(fw_json *json, const fw_verdict_hinge_verdict *item, int count, int index) {
    if (index < 0 || index >= count) {
        fw_json_null(json, "governing");
        return;
    }
    fw_json_object(json, "governing");
    hinge(json, &item[index]);
    fw_json_end(json);
}

/* of the whole device: at the corner of the flow that is worst, or as drawn */
static void check(fw_json *json, const char *key, const fw_verdict_check *c, bool found) {
    if (!found) {
        fw_json_null(json, key);
        return;
    }
    fw_json_object(json, key);
    fw_json_text(json, "what", c->what);
    if (c->hinge) hinge(json, c->hinge);
    if (c->requirement) fw_report_json_requirement(json, c->requirement);
    fw_json_text(json, "corner", c->corner);
    fw_json_end(json);
}

/* the first lines of every result, as they are read */
static void summary(fw_json *json, const fw_report_summary *s) {
    fw_json_list(json, "summary");
    for (int i = 0; i < s->nline; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "label", s->line[i].label);
        fw_json_text(json, "text", s->line[i].text);
        fw_json_end(json);
    }
    fw_json_end(json);
}

/* ---- workspace: the required boxes; certified when all of them are ---- */

static void box(fw_json *json, const fw_device_workspace_box *b,
                const fw_verdict_variant_verdict *v, bool reachable) {
    double volume =
        (b->x_max_m - b->x_min_m) * (b->y_max_m - b->y_min_m) * (b->phi_max_rad - b->phi_min_rad);
    fw_json_object(json, NULL);
    fw_json_text(json, "flow", v->variant ? v->variant->flow : NULL);
    fw_report_json_pair(json, "x_m", b->x_min_m, b->x_max_m);
    fw_report_json_pair(json, "y_m", b->y_min_m, b->y_max_m);
    fw_report_json_pair(json, "phi_rad", b->phi_min_rad, b->phi_max_rad);
    fw_json_truth(json, "reachable", reachable);
    fw_json_truth(json, "certified", v->workspace.certified);
    fw_json_real(json, "volume_m2_rad", volume);
    fw_json_end(json);
}

/* which hinge the required poses strain most, and what holds it there */
static void loads(fw_json *json, const fw_verdict_variant_verdict *v) {
    for (int i = 0; i < FW_SIX; i++) {
        const fw_workspace_load *l = &v->workspace.load[i];
        if (!l->known) continue;
        fw_json_object(json, NULL);
        fw_json_text(json, "id", v->mechanism->pin[i].id);
        fw_json_text(json, "flow", v->variant ? v->variant->flow : NULL);
        fw_json_real(json, "strain", l->strain);
        fw_json_real(json, "strain_error", l->error);
        fw_report_json_reals(json, "pose", (double[]){l->x_m, l->y_m, l->phi_rad}, 3);
        fw_json_real(json, "angle_rad", l->angle_rad);
        fw_json_real(json, "joint_force_N", l->force_N);
        fw_json_real(json, "joint_force_most_N", l->most_N);
        fw_json_real(json, "over_rotation", l->over_rotation);
        fw_json_real(json, "added", l->added);
        fw_json_real(json, "give", l->give);
        fw_json_real(json, "relief", l->relief);
        fw_json_text(json, "actuation", l->actuation);
        fw_json_end(json);
    }
}

static void workspace(fw_json *json, const fw_report_input *in) {
    bool certified = true, any = false;
    double volume = (double)NAN, rims = (double)NAN;
    fw_json_object(json, "workspace");
    fw_json_list(json, "required");
    for (int i = 0, at = 0; i < in->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &in->verdict->variant[i];
        if (!v->workspace.required) continue;
        any = true;
        certified = certified && v->workspace.certified && v->workspace.reachable;
        volume = fmin(volume, v->workspace.volume_m2_rad); /* fmin ignores the first NaN */
        rims = fmax(rims, fw_verdict_bending_rims_required(v, &at));
        for (int k = 0; k < in->device->nworkspace; k++)
            if (v->workspace.asked && v->workspace.asked[k])
                box(json, &in->device->workspace[k], v, v->workspace.box_reachable[k]);
    }
    fw_json_end(json);
    fw_json_truth(json, "certified", any && certified);
    fw_json_real(json, "volume", volume); /* least of the boxes, m2 rad */
    fw_json_real(json, "hole_rims", rims);
    fw_json_list(json, "actuation");
    for (int i = 0; i < in->verdict->nvariant; i++)
        if (in->verdict->variant[i].workspace.required) loads(json, &in->verdict->variant[i]);
    fw_json_end(json);
    fw_json_end(json);
}

/* ---- flows, effects, advice ---- */

static void flow(fw_json *json, const fw_report_flow *f) {
    const fw_verdict_variant_verdict *v = f->variant;
    const char *id = f->flow ? f->flow->id : v && v->variant ? v->variant->flow : NULL;
    fw_json_object(json, NULL);
    fw_json_text(json, "id", id);
    if (f->flow && f->flow->manufacturable >= 0)
        fw_json_truth(json, "manufacturable", f->flow->manufacturable);
    else
        fw_json_null(json, "manufacturable");
    fw_json_list(json, "reasons");
    for (int i = 0; f->flow && i < f->flow->nreason; i++)
        fw_json_text(json, NULL, f->flow->reason[i]);
    fw_json_end(json);
    fw_json_text(json, "mask_error", f->mask_error);
    if (f->flow) fw_process_release_json(f->flow, json);
    if (f->flow) fw_wiring_json(f->wiring, json);
    if (v && v->mechanism) fw_statics_tethers_json(json, v->mechanism, f->tethers);
    if (v) {
        fw_json_text(json, "verdict", word(v->decision));
        governing(json, v->hinge, v->nhinge, v->governing);
        hinges(json, v->hinge, v->nhinge, v, 1);
        fw_json_text(json, "drawn", word(v->drawn));
        as_fabricated(json, v);
    }
    /* what is found with the recipes, to first order, stands there: a verdict does not change by them */
    fw_measuring_json(json, f->measuring && f->measuring->asked ? f->measuring : NULL);
    fw_json_end(json);
}

static const char *flow_of(const fw_verdict_variant_verdict *v) {
    return v->variant ? v->variant->flow : NULL;
}

static void effects(fw_json *json, const fw_report_input *in) {
    fw_json_list(json, "effects");
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &in->verdict->variant[i];
        for (int k = 0; v->motion && k < in->device->nscene; k++)
            if (v->motion[k])
                fw_report_json_effects(json, &v->motion[k]->ledger, in->device->scene[k].name,
                                       flow_of(v));
    }
    fw_json_end(json);
}

/* of every scene with hinges, in every flow */
static void hinge_models(fw_json *json, const fw_report_input *in) {
    fw_json_list(json, "hinge_model");
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &in->verdict->variant[i];
        for (int k = 0; v->motion && k < in->device->nscene; k++) {
            const fw_dynamics_motion *x = v->motion[k];
            if (!x || !x->ledger.hinge.why) continue;
            fw_json_object(json, NULL);
            fw_report_json_hinge_model(json, v->mechanism, &x->ledger.hinge, x->level);
            fw_json_real(json, "model_error", fw_verdict_motion_model_error(v->mechanism, x));
            fw_json_real(json, "bodies_give", fw_verdict_bending_share(x));
            fw_json_real(json, "bases_give", fw_verdict_bases_share(x));
            int at[2];
            const fw_verdict_band rims = fw_verdict_bending_rims(v->mechanism, x, at);
            fw_json_real(json, "hole_rims", rims.high);
            fw_json_real(json, "hole_rims_least", rims.low);
            fw_json_text(json, "scene", in->device->scene[k].name);
            fw_json_text(json, "flow", flow_of(v));
            fw_json_end(json);
        }
    }
    fw_json_end(json);
}

/* of every scene with comb drives; nothing is written where no scene has any */
static void pull_ins(fw_json *json, const fw_report_input *in) {
    bool any = false;
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &in->verdict->variant[i];
        for (int k = 0; v->pull_in && k < in->device->nscene; k++) {
            if (!v->pull_in[k]) continue;
            if (!any) fw_json_list(json, "pull_in");
            any = true;
            fw_json_object(json, NULL);
            fw_report_json_pull_in(json, v->pull_in[k]);
            fw_json_text(json, "scene", in->device->scene[k].name);
            fw_json_text(json, "flow", flow_of(v));
            fw_json_end(json);
        }
    }
    if (any) fw_json_end(json);
}

static void reasons(fw_json *json, const fw_verdict *v) {
    fw_json_list(json, "reasons");
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nreason; k++) {
            const fw_verdict_reason *r = &v->variant[i].reason[k];
            fw_json_object(json, NULL);
            fw_json_text(json, "scene", r->scene);
            fw_json_text(json, "flow", r->flow);
            fw_json_text(json, "verdict", word(r->decision));
            fw_json_textf(json, "code", "FW-D%03d", r->number);
            fw_json_text(json, "text", r->text);
            fw_json_end(json);
        }
    fw_json_end(json);
}

/* nothing is written where all is drawn */
static void not_drawn(fw_json *json, const fw_layout *layout) {
    if (!layout || layout->nmissing == 0) return;
    fw_json_list(json, "not_drawn");
    for (int i = 0; i < layout->nmissing; i++) {
        const fw_layout_missing *m = &layout->missing[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "part", m->name);
        fw_json_list(json, "at_m");
        fw_json_real(json, NULL, m->at.x);
        fw_json_real(json, NULL, m->at.y);
        fw_json_end(json);
        fw_json_whole(json, "line", m->place.line);
        fw_json_whole(json, "column", m->place.column);
        fw_json_textf(json, "code", "FW-D%03d", m->number);
        fw_json_text(json, "why", m->why);
        fw_json_text(json, "nearest_room", m->room);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void accuracy(fw_json *json, const fw_verdict *v) {
    fw_json_object(json, "accuracy");
    fw_json_real(json, "wanted", v->accuracy_wanted);
    fw_json_real(json, "estimated", v->accuracy_estimated);
    fw_json_real(json, "left_out", v->accuracy_left_out);
    fw_json_end(json);
}

static void advice(fw_json *json, const fw_verdict *v) {
    static const char *const kind[] = {"parameter", "flexures", "holes", "loads", "several"};
    fw_json_list(json, "advice");
    for (int i = 0; i < v->nproposal; i++) {
        const fw_verdict_proposal *p = &v->proposal[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "kind", kind[p->kind]);
        fw_json_list(json, "set");
        for (int k = 0; k < p->nset; k++) {
            fw_json_object(json, NULL);
            fw_json_text(json, "path", p->set[k].path);
            fw_json_text(json, "value", p->set[k].value);
            fw_json_end(json);
        }
        fw_json_end(json);
        fw_json_real(json, "change", p->change);
        fw_json_text(json, "text", p->text);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void parameters(fw_json *json, const fw_verdict *v) {
    static const char *const found[] = {"accepts", "none", "not looked at"};
    fw_json_list(json, "advice_parameters");
    for (int i = 0; i < v->nparameter; i++) {
        const fw_verdict_parameter_advice *p = &v->parameter[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "set", p->name);
        fw_json_text(json, "found", found[p->found]);
        fw_json_text(json, "value", p->value_text);
        fw_json_real(json, "value_SI", p->to);
        fw_json_real(json, "now_SI", p->from);
        fw_json_real(json, "change", p->change);
        fw_json_real(json, "from_SI", p->low);
        fw_json_real(json, "to_SI", p->high);
        fw_json_text(json, "text", p->text);
        fw_json_end(json);
    }
    fw_json_end(json);
}

fw_status fw_report_verdict_json(const fw_report_input *input, fw_text *out) {
    const fw_verdict *v = input->verdict;
    fw_report_summary top;
    FW_TRY(fw_report_summarise(out->arena, input, &top));
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    if (input->wanted.member) fw_json_only(&json, input->wanted);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.verdict/1");
    fw_json_text(&json, "device", input->device->name);
    fw_json_text(&json, "version", input->version);
    fw_json_text(&json, "verdict", word(v->decision));
    fw_json_text(&json, "drawn", word(v->drawn));
    if (v->decision == FW_REJECT) fw_json_text(&json, "banner", "REJECTED");
    summary(&json, &top);
    check(&json, "governing", &top.governing, top.governs);
    check(&json, "governing_drawn", &top.governing_drawn, top.governs);
    hinges(&json, v->hinge, v->nhinge, v->variant, v->nvariant);
    fw_json_real(&json, "failure_probability", v->failure_probability);
    fw_json_real(&json, "repetitions", input->device->limits.cycles);
    workspace(&json, input);
    fw_json_list(&json, "flows");
    for (int i = 0; i < input->nflow; i++)
        flow(&json, &input->flow[i]);
    fw_json_end(&json);
    effects(&json, input);
    hinge_models(&json, input);
    pull_ins(&json, input);
    fw_report_json_requirements(&json, input);
    reasons(&json, v);
    not_drawn(&json, input->layout);
    fw_report_json_clearances(&json, v);
    fw_report_json_out_of_plane(&json, v);
    FW_TRY(fw_report_json_stiction(out->arena, &json, v));
    accuracy(&json, v);
    advice(&json, v);
    fw_json_text(&json, "advice_note", v->advice_note);
    parameters(&json, v);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}
