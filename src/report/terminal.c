/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person reads on a terminal: the verdict, what is required of probes, a motion. */
#include "base/constants.h"
#include "report/report.h"
#include "report/report_page.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- what is required of probes, as tables ---- */

/* at: what is made, with its band over all corners; NULL: as drawn */
static void requirement_row(fw_text *out, const fw_verdict_requirement *r, const char *at) {
    double reach[2];
    fw_verdict_requirement_band(r, reach);
    char text[FW_PROBE_TEXT], low[FW_PROBE_TEXT], high[FW_PROBE_TEXT], band[2 * FW_PROBE_TEXT + 4];
    fw_text_printf(out, "  %-12s %-13s ", r->probe, r->measure ? r->measure : r->kind);
    if (r->why) {
        fw_text_printf(out, "%-12s  %-24s  ", "not known", "");
    } else {
        snprintf(band, sizeof band, "%s..%s", fw_probe_text(low, reach[0], r->unit),
                 fw_probe_text(high, reach[1], r->unit));
        fw_text_printf(out, "%-12s  %-24s  ", fw_probe_text(text, r->value, r->unit), band);
    }
    bool both = !isnan(r->min) && !isnan(r->max);
    snprintf(band, sizeof band, "%s%s%s%s",
             isnan(r->min) ? "<= "
             : both        ? ""
                           : ">= ",
             isnan(r->min) ? "" : fw_probe_text(low, r->min, r->unit), both ? ".." : "",
             isnan(r->max) ? "" : fw_probe_text(high, r->max, r->unit));
    fw_text_printf(out, "%-16s  ", band);
    fw_text_printf(out, "%-11s  ", r->why ? "" : fw_probe_text(text, r->margin, r->unit));
    fw_text_printf(out, "%-12s %s%s", fw_verdict_decision_text(r->decision),
                   r->scene ? r->scene : fw_verdict_at_rest,
                   fw_probe_when(text, r->measure ? (double)NAN : r->t_s));
    if (at)
        fw_text_printf(out, ", %s%s", at,
                       reach[0] != r->low || reach[1] != r->high ? "; the band of all corners"
                                                                 : "");
    else if (r->flow)
        fw_text_printf(out, " (%s)", r->flow);
    fw_text_add(out, "\n");
}

/* value, band, bound, margin, as drawn and at the worst corner */
static void requirements(fw_text *out, const fw_verdict *verdict) {
    bool any = false;
    const char *rigid = NULL;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; k < v->nrequirement; k++) {
            int corner = 0;
            if (v->requirement[k].rigid) rigid = v->requirement[k].rigid;
            const fw_verdict_requirement *worst = fw_verdict_requirement_made(v, k, &corner);
            if (!any)
                fw_text_add(out, "\n  required     of            value         band                "
                                 "      required          margin       verdict      in\n");
            any = true;
            requirement_row(out, &v->requirement[k], NULL);
            if (worst) requirement_row(out, worst, v->fabricated->corner[corner].what);
        }
    }
    if (rigid) fw_text_printf(out, "  %s\n", fw_report_without_bodies(out->arena, rigid));
}

/* ---- probes of one scene ---- */

/* peaks of a motion that fw_probe_monitor has observed; nothing without probes */
static void probes(const fw_mechanism *mechanism, const fw_dynamics_motion *motion, fw_text *out) {
    const int n = fw_probe_count(mechanism);
    const fw_probe_monitor *saw = n > 0 ? motion->observed : NULL;
    bool any = false;
    for (int i = 0; saw && i < n; i++) {
        const fw_device_probe *p = &mechanism->device->probe[i];
        const char *unit = fw_device_probe_kinds[p->row].unit;
        char peak[FW_PROBE_TEXT], error[FW_PROBE_TEXT], at[FW_PROBE_TEXT], final[FW_PROBE_TEXT];
        fw_probe_result r;
        fw_probe_result_of(saw, motion->compared, motion, i, &r);
        if (!r.known) continue;
        if (!any)
            fw_text_add(out,
                        "\n  probe        of            peak          at            +-            "
                        "final\n");
        any = true;
        fw_text_printf(out, "  %-12s %-13s %-13s %-13s %-13s %s\n", p->id,
                       fw_device_probe_kinds[p->row].name, fw_probe_text(peak, r.peak, unit),
                       fw_probe_text(at, r.peak_t_s, "s"), fw_probe_text(error, r.numeric, unit),
                       fw_probe_text(final, r.final, unit));
    }
}

fw_status fw_report_rest_probes_text(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                     const fw_statics *statics, fw_text *out) {
    fw_probe *probe;
    FW_TRY(fw_probe_bind(out->arena, mechanism, scene, statics->loads, &probe));
    for (int i = 0; i < fw_probe_count(mechanism); i++) {
        char text[FW_PROBE_TEXT];
        if (!fw_report_probe_moves(&probe[i])) continue;
        fw_text_printf(out, "%s%s (%s): %s\n", FW_NAMED("probe", probe[i].asked->id),
                       probe[i].kind->name,
                       fw_probe_text(text, fw_probe_at_equilibrium(&probe[i], scene, statics),
                                     probe[i].kind->unit));
    }
    return FW_OK;
}

static double degrees(double rad) {
    return rad * 180.0 / FW_PI;
}

/* ---- verdict ---- */

static void hinge_row(fw_text *out, const fw_verdict_hinge_verdict *h) {
    fw_text_printf(out, "  %-6s ", h->id);
    fw_text_real(out, "%8.2f deg ", degrees(h->peak_angle_rad));
    fw_text_real(out, "%7.2f deg ", degrees(h->limit_angle_rad));
    fw_text_real(out, "%7.3f %% ", 100.0 * h->peak_strain);
    fw_text_real(out, "%6.1f %%  ", 100.0 * h->utilisation);
    fw_text_real(out, "%5.1f..", 100.0 * h->utilisation_low);
    fw_text_real(out, "%-5.1f  ", 100.0 * h->utilisation_high);
    fw_text_printf(out, "%-12s %s", fw_verdict_decision_text(h->decision), h->scene);
    if (h->flow) fw_text_printf(out, " (%s)", h->flow);
    fw_text_add(out, "\n");
}

static void hinges(fw_text *out, const fw_verdict *v) {
    fw_text_add(out, "\n  hinge      peak       limit     strain    used  band %        verdict  "
                     "    in\n");
    for (int k = 0; k < v->nhinge; k++)
        hinge_row(out, &v->hinge[k]);
}

static void number(fw_text *out, const char *before, double value, const char *after) {
    fw_text_add(out, before);
    fw_text_number(out, value, 4);
    fw_text_add(out, after);
}

/* with -v: what strains rest on that nobody stated, by flexure */
static void fillets(fw_text *out, const fw_verdict *v) {
    const fw_mechanism *m = v->nvariant > 0 ? v->variant[0].mechanism : NULL;
    for (int f = 0; m && f < m->device->nflexure; f++) {
        fw_text list = fw_text_new(out->arena);
        double least_m = HUGE_VAL, most_m = -HUGE_VAL;
        if (!isnan(m->device->flexure[f].fillet_m)) continue;
        for (int k = 0; k < m->nhinge; k++)
            if (m->hinge[k].flexure == f && m->hinge[k].input.fillet_m >= 0) {
                least_m = fmin(least_m, m->hinge[k].input.fillet_m);
                most_m = fmax(most_m, m->hinge[k].input.fillet_m);
                fw_text_printf(&list, "%s%s", list.length ? ", " : "",
                               fw_text_name(m->pin[m->hinge[k].pin].id));
            }
        if (least_m > most_m) continue;
        const char *few = fw_text_end(&list) == FW_OK ? fw_text_few(out->arena, list.data) : NULL;
        if (!few) {
            out->failed = true;
            return;
        }
        fw_text_add(out, "  strain and limit of ");
        fw_text_printf(out, "%s rest on fillets of ", few);
        fw_text_number(out, least_m * 1e6, 4);
        if (most_m > least_m) number(out, " to ", most_m * 1e6, "");
        fw_text_add(out, " um at the roots, chosen: none is stated\n");
    }
}

/* which criterion governs, its number, status and source, and what was asked for beside */
static void limit(fw_text *out, const fw_verdict_hinge_verdict *h, const fw_report_input *in) {
    const fw_device_limits_asked *asked = &in->device->limits;
    if (h->limit) {
        fw_text_printf(out, "(limit by %s: %s, ", h->limit->criterion, h->limit->definition);
        number(out, "", h->limit_Pa * 1e-6, " MPa at the peak / safety factor ");
        number(out, "", in->device->safety_factor, "; ");
        fw_text_printf(out, "%s: %s)\n", fw_quantity_value_status_text(h->limit->status),
                       h->limit->source);
    }
    if (asked->failure_probability > 0 && !isnan(h->failure_probability)) {
        number(out, "(it breaks with probability ", h->failure_probability, " at this peak, ");
        number(out, "one of all hinges with ", in->verdict->failure_probability, "; ");
        number(out, "asked: ", asked->failure_probability, ")\n");
    }
    if (!isnan(h->fatigue_utilisation) && asked->cycles > 0) {
        number(out, "(fatigue: ", 100 * h->fatigue_utilisation, " % of what lasts ");
        number(out, "", asked->cycles, " repetitions of ");
        number(out, "", h->cycles, " counted cycles, safety factor included; ");
        number(out, "damage ", h->damage, " without it)\n");
    }
}

/* more about the hinge that governs as drawn */
static void governing(fw_text *out, const fw_verdict_hinge_verdict *h, const fw_report_input *in) {
    fw_text_printf(out, "\n%s%s in %s:\n", FW_NAMED("hinge", h->id), h->scene);
    if (h->force_share > 0.0) {
        fw_text_real(out, "(its rotation alone would use %.1f %%, the force it carries the rest)\n",
                     100.0 * h->utilisation * (1.0 - h->force_share));
    }
    if (h->actuation) fw_text_printf(out, "(the pose is held by: %s)\n", h->actuation);
    fw_text band = fw_text_new(out->arena);
    if (fw_report_band_words(&band, h)) fw_text_printf(out, "(its band is made of: %s)\n", band.data);
    if (band.failed) out->failed = true;
    limit(out, h, in);
    if (h->touches)
        fw_text_printf(out,
                       "(its drawn solids meet before that angle: the motion is not possible)\n");
}

/* the first reasons; all of them in detail and in the report */
static void flow(fw_text *out, const fw_report_flow *rf, int detail) {
    enum { FEW = 3 };
    const fw_process_flow *f = rf->flow;
    fw_text_printf(out, "\nflow %s: manufacturable: %s\n", rf->variant->variant->flow,
                   f->manufacturable > 0    ? "yes"
                   : f->manufacturable == 0 ? "NO"
                                            : "not guaranteed");
    if (rf->mask_error) fw_text_printf(out, "  no mask: %s\n", rf->mask_error);
    int shown = detail > 0 || f->nreason <= FEW ? f->nreason : FEW;
    for (int i = 0; i < shown; i++)
        fw_text_printf(out, "  - %s\n", f->reason[i]);
    if (shown < f->nreason)
        fw_text_printf(out, "  and %d more (in the report, or with -v)\n", f->nreason - shown);
    const char *release;
    if (fw_process_release_words(out->arena, f, &release) != FW_OK) out->failed = true;
    if (!out->failed && release) fw_text_printf(out, "  %s\n", release);
    if (detail > 0) {
        if (fw_process_hold_words(out->arena, f, &release) != FW_OK) out->failed = true;
        if (!out->failed && release) fw_text_printf(out, "  %s\n", release);
        if (rf->variant->mechanism && fw_statics_tethers_words(out->arena, rf->variant->mechanism,
                                                               rf->tethers, &release) != FW_OK)
            out->failed = true;
        if (!out->failed && rf->tethers) fw_text_printf(out, "  %s\n", release);
    }
    fw_text_printf(out, "  %d steps, computed times add up to ", f->nstep);
    fw_text_number(out, f->total_s / 3600.0, 3);
    fw_text_printf(out, " h; %d steps not computable\n", f->not_computable);
}

static void pull_ins(fw_text *out, const fw_report_input *in) {
    const fw_verdict *v = in->verdict;
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; v->variant[i].pull_in && k < in->device->nscene; k++) {
            const fw_statics_pull_in *p = v->variant[i].pull_in[k];
            if (!p || p->kind == FW_PULL_IN_NONE) continue;
            const fw_mechanism_variant *variant = v->variant[i].variant;
            fw_text_printf(out, "\npull-in in %s", in->device->scene[k].name);
            if (variant && variant->flow) fw_text_printf(out, " (%s)", variant->flow);
            fw_text_printf(out, ": %s%s at ", FW_NAMED("comb drive", p->comb));
            fw_text_number(out, p->voltage_V, 4);
            const bool several = in->device->scene[k].ncomb > 1;
            fw_text_add(out, " V (at least ");
            fw_text_number(out, fw_statics_pull_in_least_V(p), 4);
            fw_text_printf(out, " V; %s)%s%s%s; the scene asks for up to ",
                           fw_statics_pull_in_kind_text(p->kind), several ? " " : "",
                           several ? p->together : "", several ? ", slowly" : "");
            fw_text_number(out, p->largest_V, 4);
            fw_text_add(out, " V\n");
        }
}

/* a scene that acts across the plane, and by how much more than its forces the device may tip out of it */
static void across(fw_text *out, const fw_verdict_across *s, const fw_mechanism_below *below) {
    const bool looked = !isnan(s->tips);
    if (!s->asked && !looked) return;
    fw_text_printf(out, "  %s: ", s->scene);
    if (s->asked) {
        if (isfinite(s->lowest_m)) {
            number(out, "down by up to ", -1e6 * s->lowest_m, " um");
            number(out, ", tilted by up to ", degrees(s->tilt_rad), " deg; below it: ");
        } else
            fw_text_add(out, "how far down is not known; below it: ");
        fw_text_add(out, below->known ? below->words : "not known");
        if (isfinite(s->strained) && s->strained_hinge)
            number(out, "; in the plane and across it a hinge uses at most ", 100 * s->strained,
                   " % of its limit");
        fw_text_add(out, looked ? "; " : "");
    }
    if (looked && !fw_verdict_across_tips(s)) fw_text_add(out, "nothing that tips it was found");
    if (looked && fw_verdict_across_tips(s)) {
        number(out, "does not tip below ", s->tips, " times its forces, which may be off by ");
        number(out, "", 100 * s->tips_error,
               s->tips > 0 ? " %: sure up to " : " %: nothing is sure");
        if (s->tips > 0) number(out, "", s->tips / (1 + s->tips_error), "");
    }
    fw_text_add(out, "\n");
}

/* one line a flow, and one for each scene that has something to say across the plane */
static void out_of_plane(fw_text *out, const fw_verdict *v) {
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_out_of_plane *o = v->variant[i].out_of_plane;
        const char *flow = v->variant[i].variant->flow;
        if (!o || (o->why && o->nscene == 0)) continue;
        fw_text_printf(out, "\nout of the plane%s%s, as drawn: ", flow ? ", " : "",
                       flow ? flow : "");
        if (o->why || o->nmode == 0) {
            fw_text_printf(out, "not known: %s\n", o->why);
            continue;
        }
        number(out, "swings from ", o->mode[0].f_Hz, " Hz on (");
        number(out, "", o->mode[0].low_Hz, " to ");
        number(out, "", o->mode[0].high_Hz, " Hz; ");
        fw_text_printf(out, "%s%s %s)", FW_NAMED("body", o->mode[0].body),
                       o->mode[0].tilts ? "tilts" : "goes up and down");
        if (isfinite(o->ratio)) number(out, "; its stiffness is ", o->ratio, " of that in it");
        number(out, "; its weight lowers it by ", 1e9 * o->weight_m, " nm");
        number(out, ", at most ", 1e9 * o->weight_most_m, " nm\n");
        for (int k = 0; k < o->nscene; k++)
            across(out, &o->scene[k], &v->variant[i].variant->below);
    }
}

/* a line each: what a scene presses onto something that is placed, whose surfaces nobody knows, and the force that opens it.
   By Johnson, Kendall and Roberts a ball of radius R comes off at 3/2 pi W R, whatever it is made of */
static void placed(fw_text *out, const fw_verdict_variant_verdict *of) {
    const fw_verdict_stiction *s = of->stiction;
    char opens[32], radius[32], work[32];
    for (int k = 0; s && k < s->nstuck; k++) {
        const fw_verdict_stuck *c = &s->stuck[k];
        if (!c->contact || !c->why || c->decision != FW_ACCEPT) continue;
        fw_text_printf(out, "  %s%s in %s%s: %s, so that whether it lets go is not judged",
                       FW_NAMED("contact", c->contact), FW_NAMED("scene", c->scene), c->why);
        if (isfinite(c->opens_N[0]))
            fw_text_printf(out, "; the flexures open it with %s uN",
                           fw_number_text(opens, sizeof opens, 1e6 * c->opens_N[0], 3));
        if (isfinite(c->opens_N[0]) && c->radius_m > 0)
            fw_text_printf(out,
                           ", which takes a ball of relative radius %s um off a work of adhesion "
                           "up to %s mJ/m2 "
                           "(JKR, 2 F/(3 pi R))",
                           fw_number_text(radius, sizeof radius, 1e6 * c->radius_m, 3),
                           fw_number_text(work, sizeof work,
                                          2e3 * c->opens_N[0] / (3 * FW_PI * c->radius_m), 3));
        fw_text_add(out, "\n");
    }
}

/* a line a flow: how it is dried, and what the device needs */
static fw_status stiction(fw_text *out, const fw_verdict *v) {
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_variant_verdict *of = &v->variant[i];
        const char *needs, *flow = of->variant->flow;
        FW_TRY(fw_verdict_drying_words(out->arena, of, &needs));
        if (!needs || of->variant->drying.how == FW_DRIED_NEVER) continue;
        fw_text_printf(out, "\ndrying%s%s: %s; %s\n", flow ? ", " : "", flow ? flow : "",
                       of->variant->drying.words, needs);
        placed(out, of);
    }
    return FW_OK;
}

/* those alone that accept are among the proposals */
static void parameters(fw_text *out, const fw_verdict *v) {
    int said = 0;
    for (int i = 0; i < v->nparameter; i++) {
        const fw_verdict_parameter_advice *p = &v->parameter[i];
        if (p->found == FW_PARAMETER_ACCEPTS) continue;
        if (said++ == 0) fw_text_add(out, "\nnot by one parameter alone:\n");
        fw_text_printf(out, "  %s\n", p->text);
    }
}

static void advice(fw_text *out, const fw_verdict *v) {
    if (v->nproposal == 0 && !v->advice_note) return;
    fw_text_add(out, v->nproposal > 0
                         ? "\nwhat to change, the least first (each was run and accepted):\n"
                         : "\nwhat to change:\n");
    for (int i = 0; i < v->nproposal; i++) {
        const fw_verdict_proposal *p = &v->proposal[i];
        fw_text_printf(out, "  %d. %s\n", i + 1, p->text);
        for (int k = 0; k < p->nset; k++)
            fw_text_printf(out, "     --set \"%s=%s\"\n", p->set[k].path, p->set[k].value);
    }
    if (v->advice_note) fw_text_printf(out, "  %s\n", v->advice_note);
}

static void summary(fw_text *out, const fw_report_summary *s) {
    for (int i = 0; i < s->nline; i++)
        fw_text_printf(out, "%s: %s\n", s->line[i].label, s->line[i].text);
}

fw_status fw_report_verdict_text(const fw_report_input *input, fw_report_terminal_style style,
                                 fw_text *out) {
    const fw_verdict *v = input->verdict;
    fw_report_summary top;
    static const char *const paint[] = {"\033[1;32m", "\033[1;33m", "\033[1;31m"};
    FW_TRY(fw_report_summarise(out->arena, input, &top));
    fw_text_printf(out, "%s: %s%s%s", input->device->name, style.colour ? paint[v->decision] : "",
                   fw_report_decision_word(v->decision), style.colour ? "\033[0m" : "");
    if (v->drawn != v->decision)
        fw_text_printf(out, " (as drawn: %s)", fw_report_decision_word(v->drawn));
    if (top.unmade) fw_text_printf(out, ", but cannot be made in %s", top.unmade);
    if (top.dies) fw_text_printf(out, ", but %s", top.dies);
    fw_text_add(out, "\n");
    summary(out, &top);
    if (style.detail >= 0 && top.has_drawn) governing(out, top.drawn.hinge, input);
    if (style.detail >= 0 && v->nhinge > 0) hinges(out, v);
    if (style.detail > 0) fillets(out, v);
    if (style.detail >= 0) requirements(out, v);
    if (style.detail >= 0) pull_ins(out, input);
    if (style.detail >= 0) out_of_plane(out, v);
    if (style.detail >= 0) FW_TRY(stiction(out, v));
    if (style.detail >= 0) fw_report_fabricated_text(out, v);
    fw_report_measurements_text(out, input, style.detail >= 0);
    advice(out, v);
    parameters(out, v);
    for (int i = 0; style.detail >= 0 && v->decision != FW_REJECT && i < input->nflow; i++)
        if (input->flow[i].flow) flow(out, &input->flow[i], style.detail);
    return fw_text_end(out);
}

/* ---- one scene ---- */

static void statistics(fw_text *out, const fw_dynamics_motion_stats *s) {
    fw_text_printf(out, "%ld steps, %ld rejected, %ld right-hand sides, %ld projections, ",
                   s->steps, s->rejected, s->rhs, s->projections);
    fw_text_real(out, "%.2f ms of CPU\nrelative tolerance ", s->cpu_s * 1e3);
    fw_text_number(out, s->rtol, 3);
    fw_text_add(out, ", largest constraint norm ");
    fw_text_number(out, s->max_constraint_norm, 2);
    fw_text_add(out, " (velocity ");
    fw_text_number(out, s->max_velocity_norm, 2);
    fw_text_add(out, "), energy balance ");
    fw_text_number(out, s->energy_error, 2);
    fw_text_add(out, "\n");
    if (s->events > 0)
        fw_text_printf(out, "%ld events: stops, cables, jumps of a driver's speed\n", s->events);
    if (s->jacobians > 0)
        fw_text_printf(out, "%ld Jacobians, %ld factorisations\n", s->jacobians, s->factorisations);
    fw_text_add(out, "\n");
}

static void timed(fw_text *out, double value, double t, double error) {
    fw_text_real(out, " %15.5g ", value);
    fw_text_real(out, "%13.5f ", t);
    fw_text_real(out, "%10.1e", error);
}

static double strongest(const fw_dynamics_force_peak *p, int count, double most) {
    for (int i = 0; p && i < count; i++)
        most = fmax(most, p[i].force_N);
    return most;
}

static void angle_peaks(const fw_mechanism *m, const fw_dynamics_motion *motion,
                        fw_report_magnitude time, fw_report_magnitude force, fw_text *out) {
    if (motion->npin == 0) return;
    fw_text_printf(out, "  joint    peak angle deg         at %-2s     +- deg", time.unit);
    if (motion->force_peak)
        fw_text_printf(out, "   peak force %-2s         at %-2s      +- %s", force.unit, time.unit,
                       force.unit);
    fw_text_add(out, "\n");
    for (int i = 0; i < motion->npin; i++) {
        fw_text_printf(out, "  %-6s ", m->pin[i].id);
        fw_text_real(out, "%16.4f ", degrees(motion->peak[i].angle_rad));
        fw_text_real(out, "%12.5f ", motion->peak[i].t_s * time.per_si);
        fw_text_real(out, "%10.1e", degrees(motion->peak[i].error_rad));
        if (motion->force_peak)
            timed(out, motion->force_peak[i].force_N * force.per_si,
                  motion->force_peak[i].t_s * time.per_si,
                  motion->force_peak[i].error_N * force.per_si);
        fw_text_add(out, "\n");
    }
}

static void force_line(fw_text *out, const char *id, const char *what, double value,
                       const char *unit, double t, const char *time, double error) {
    fw_text_printf(out, "  %-8s %-7s", id, what);
    fw_text_real(out, " %14.6g ", value);
    fw_text_printf(out, "%-3s", unit);
    fw_text_real(out, " %13.5f ", t);
    fw_text_add(out, time);
    fw_text_real(out, "   %8.1e\n", error);
}

/* a line per force, torque and travel: their units differ */
static void joint_peaks(const fw_mechanism *m, const fw_dynamics_motion *motion,
                        fw_report_magnitude time, fw_report_magnitude force, fw_text *out) {
    if (!motion->joint_peak || motion->njoint + motion->ndriver == 0) return;
    double far = 0;
    for (int i = 0; i < motion->njoint; i++)
        far = fmax(far, fabs(motion->travel_peak[i].travel_m));
    const fw_report_magnitude length = fw_report_magnitude_of(FW_MEASURE_LENGTH, far);
    fw_text_add(out, "\n  joint, driver         peak                  at              +-\n");
    for (int i = 0; i < motion->njoint + motion->ndriver; i++) {
        bool joint = i < motion->njoint;
        int k = joint ? i : i - motion->njoint;
        const fw_dynamics_force_peak *p = joint ? &motion->joint_peak[k] : &motion->driver_peak[k];
        const char *id = joint ? m->joint[k].id : m->driver[k].id;
        bool is_force = joint || m->driver[k].revolute == FW_NONE;
        bool turns = joint ? m->joint[k].kind != FW_JOINT_DISTANCE : !is_force;
        if (joint && m->joint[k].kind == FW_JOINT_PRISMATIC) {
            const fw_dynamics_travel_peak *t = &motion->travel_peak[k];
            force_line(out, id, "travel", t->travel_m * length.per_si, length.unit,
                       t->t_s * time.per_si, time.unit, t->error_m * length.per_si);
        }
        if (is_force)
            force_line(out, id, "force", p->force_N * force.per_si, force.unit,
                       p->t_s * time.per_si, time.unit, p->error_N * force.per_si);
        if (turns)
            force_line(out, id, "torque", p->torque_Nm, "N m", p->torque_t_s * time.per_si,
                       time.unit, p->torque_error_Nm);
    }
}

static void peaks(const fw_mechanism *m, const fw_dynamics_motion *motion, fw_report_magnitude time,
                  fw_text *out) {
    double most = strongest(motion->force_peak, motion->npin, 0);
    most = strongest(motion->joint_peak, motion->njoint, most);
    most = strongest(motion->driver_peak, motion->ndriver, most);
    const fw_report_magnitude force = fw_report_magnitude_of(FW_MEASURE_FORCE, most);
    angle_peaks(m, motion, time, force, out);
    joint_peaks(m, motion, time, force, out);
}

/* what the scene calls for, line by line; the rest in one */
static void ledger(fw_text *out, const fw_effect_ledger *l) {
    fw_text_add(out,
                "\neffects of the scene; bound: the most that leaving one out changes the peak of "
                "any hinge,\nrelative to the largest; cost: instructions per evaluation of the "
                "forces\n\n  effect             active  bound %   cost    why\n");
    for (int i = 0; i < l->count; i++) {
        const fw_effect_entry *e = &l->item[i];
        if (!e->called_for) continue;
        char bound[32] = "inf";
        if (isfinite(e->bound)) fw_percent_text(bound, sizeof bound, e->bound);
        fw_text_printf(out, "  %-18s %-6s  %-8s  ", e->id, e->active ? "yes" : "no", bound);
        if (e->cost > 0)
            fw_text_real(out, "%-6.0f  ", e->cost);
        else
            fw_text_add(out, "-       ");
        fw_text_printf(out, "%s\n", e->reason);
    }
    bool any = false;
    for (int i = 0; i < l->count; i++) {
        if (l->item[i].called_for) continue;
        fw_text_printf(out, any ? ", %s" : "  not called for: %s", l->item[i].id);
        any = true;
    }
    if (any) fw_text_add(out, "\n");
    if (l->left_out > 0)
        fw_text_real(out, "  sum of the bounds of what is left out: %.2g %%\n", 100 * l->left_out);
}

fw_status fw_report_simulate_text(const fw_device_scene *scene, const fw_mechanism *m,
                                  const fw_dynamics_motion *motion, fw_text *out) {
    fw_text_printf(out, "%s%s over ", FW_NAMED("scene", scene->name));
    const fw_report_magnitude time = fw_report_magnitude_of(FW_MEASURE_TIME, scene->duration_s);
    fw_text_real(out, "%g ", scene->duration_s * time.per_si);
    fw_text_printf(out, "%s, method %s, integrator %s (%s)\n", time.unit, motion->method,
                   motion->integrator, motion->reason);
    if (strcmp(motion->stabilise, "projection") != 0)
        fw_text_printf(out, "stabilisation: %s\n", motion->stabilise);
    if (motion->method_report) fw_text_printf(out, "%s\n", motion->method_report);
    fw_text_printf(out, "%s\n", motion->tolerance);
    statistics(out, &motion->stats);
    peaks(m, motion, time, out);
    probes(m, motion, out);
    fw_report_hinge_model(m, &motion->ledger.hinge, motion->level, out);
    ledger(out, &motion->ledger);
    return fw_text_end(out);
}

fw_report_magnitude fw_report_magnitude_of(fw_report_measure measure, double largest_si) {
    enum { MOST = 5 };
    static const fw_report_magnitude table[3][MOST + 1] = {
        {{"nm", 1e9}, {"um", 1e6}, {"mm", 1e3}, {"m", 1}, {"km", 1e-3}},
        {{"nN", 1e9}, {"uN", 1e6}, {"mN", 1e3}, {"N", 1}, {"kN", 1e-3}, {"MN", 1e-6}},
        {{"ns", 1e9}, {"us", 1e6}, {"ms", 1e3}, {"s", 1}},
    };
    const fw_report_magnitude *row = table[measure];
    int i = 0;
    while (i < MOST && row[i + 1].unit && fabs(largest_si) * row[i + 1].per_si >= 1)
        i++;
    return largest_si == 0 ? row[2] : row[i]; /* mm, mN, ms */
}
