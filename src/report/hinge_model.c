/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/hinge_model.h"
#include <math.h>

static bool stepped(const fw_statics_level_step *s) {
    return s && !s->why_not;
}

/* ---- text ---- */

/* the body that the next level moves most, by the larger of both */
static int most_moved(const fw_mechanism *m, const fw_statics_level_step *s) {
    int best = 0;
    double most = -1;
    for (int b = 0; b < m->nbody; b++) {
        const double *p = s->at.q + 3 * b, *q = s->up.q + 3 * b;
        double way = hypot(q[0] - p[0], q[1] - p[1]);
        if (way > most) most = way, best = b;
    }
    return best;
}

static void pose_line(const fw_mechanism *m, const fw_statics_level_step *s, int b, fw_text *out) {
    const double *p = s->at.q + 3 * b, *q = s->up.q + 3 * b;
    fw_text_printf(out, "    %-8s ", m->body[b].id ? m->body[b].id : "");
    fw_text_real(out, "%+11.5f ", (q[0] - p[0]) * 1e6);
    fw_text_real(out, "%+11.5f ", (q[1] - p[1]) * 1e6);
    fw_text_real(out, "%+11.6f", (q[2] - p[2]) * 1e3);
    fw_text_add(out, "\n");
}

static void strain_line(const fw_mechanism *m, const fw_statics_level_step *s, int k,
                        fw_text *out) {
    int pin = m->hinge[k].pin;
    fw_text_printf(out, "    %-8s ", m->pin[pin].id);
    fw_text_real(out, "%+11.6f ", (s->up.angle_rad[pin] - s->at.angle_rad[pin]) * 1e3);
    if (isfinite(s->at.strain[k]) && isfinite(s->up.strain[k])) {
        fw_text_real(out, "%10.6f %% ", 100 * s->at.strain[k]);
        fw_text_real(out, "%+10.6f %%", 100 * (s->up.strain[k] - s->at.strain[k]));
    }
    fw_text_add(out, "\n");
}

void fw_report_hinge_model(const fw_mechanism *m, const fw_effects_hinge_use *use,
                           const fw_statics_level_step *s, fw_text *out) {
    enum { FEW = 12 };
    if (!use->why) return;
    fw_text_printf(out, "\nhinges as %s: %s\n", fw_effects_hinge_model_text(use->used), use->why);
    if (s && s->why_not) fw_text_printf(out, "  no step to the next level: %s\n", s->why_not);
    if (!stepped(s)) return;
    char by[32];
    fw_percent_text(by, sizeof by, s->relative);
    fw_text_printf(out, "  %s there instead changes hinge angles by up to %s %% of the largest",
                   fw_effects_hinge_model_text(s->next), by);
    if (isfinite(s->t_s)) {
        fw_text_add(out, " (at ");
        fw_text_number(out, s->t_s * 1e3, 4);
        fw_text_add(out, " ms, under the loads and inertia forces of that instant)");
    }
    fw_text_add(out, "\n    body            x um        y um    phi mrad\n");
    if (m->nbody > FEW)
        pose_line(m, s, most_moved(m, s), out);
    else
        for (int b = 0; b < m->nbody; b++)
            pose_line(m, s, b, out);
    fw_text_add(out, "    hinge      angle mrad  peak strain      change\n");
    for (int k = 0; k < m->nhinge && k < FEW; k++)
        strain_line(m, s, k, out);
    if (m->nhinge > FEW) fw_text_printf(out, "    and %d more\n", m->nhinge - FEW);
}

/* ---- the page ---- */

static void row(fw_text *out, const char *scene, const char *flow, const fw_mechanism *m,
                const fw_dynamics_motion *x) {
    const fw_statics_level_step *s = x->level;
    const fw_effects_hinge_use *use = &x->ledger.hinge;
    double strain = 0, largest = 0;
    fw_markup(out, "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{s}</td>", scene, flow,
              fw_effects_hinge_model_text(use->used));
    if (!stepped(s)) {
        fw_markup(out,
                  "<td>\u2013</td><td class=\"n\">\u2013</td><td class=\"n\">\u2013"
                  "</td><td class=\"n\">\u2013</td><td>{s}{s}{s}</td></tr>\n",
                  use->why, s && s->why_not ? "; " : "", s ? s->why_not : NULL);
        return;
    }
    for (int k = 0; k < m->nhinge; k++) {
        strain = fmax(strain, fabs(s->up.strain[k] - s->at.strain[k]));
        largest = fmax(largest, s->at.strain[k]);
    }
    const double *p = s->at.q + 3 * most_moved(m, s), *q = s->up.q + 3 * most_moved(m, s);
    fw_markup(out,
              "<td>{s}</td><td class=\"n\">{p}</td><td class=\"n\">{u}</td><td "
              "class=\"n\">{p}</td><td>{s}</td></tr>\n",
              fw_effects_hinge_model_text(s->next), s->relative, hypot(q[0] - p[0], q[1] - p[1]),
              "m", largest > 0 ? strain / largest : (double)NAN, use->why);
}

void fw_report_section_levels(fw_report_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    fw_text *out = page->out;
    bool any = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; v->motion && k < page->in->device->nscene; k++) {
            if (!v->motion[k] || !v->motion[k]->ledger.hinge.why) continue;
            if (!any)
                fw_text_add(out,
                            "<div class=\"wide\"><table><caption>Hinges: how they were taken, and "
                            "what the next level changes at the largest peak, under the loads and "
                            "inertia forces of that instant: hinge angles over the largest, the "
                            "way of the body that moves most, peak strains over the largest."
                            "</caption><thead><tr><th scope=\"col\">Scene</th><th scope=\"col\">"
                            "Flow</th><th scope=\"col\">Hinges</th><th scope=\"col\">Next</th>"
                            "<th scope=\"col\" class=\"n\">Angles</th><th scope=\"col\" "
                            "class=\"n\">Way</th><th scope=\"col\" class=\"n\">Strain</th><th "
                            "scope=\"col\">Why</th></tr></thead><tbody>\n");
            any = true;
            row(out, page->in->device->scene[k].name,
                v->variant && v->variant->flow ? v->variant->flow : "\u2013", v->mechanism,
                v->motion[k]);
        }
    }
    if (any) fw_text_add(out, "</tbody></table></div>\n");
}
