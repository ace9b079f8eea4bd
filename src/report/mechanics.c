/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the equations of motion were given, per flow: masses, stiffnesses, dampings. */
#include "report/page.h"

static void bodies(fw_text *out, const fw_mechanism *m) {
    fw_text_add(
        out, "<div class=\"wide\"><table><caption>Bodies</caption><thead><tr>"
             "<th scope=\"col\">Body</th><th scope=\"col\" class=\"n\">Mass</th>"
             "<th scope=\"col\" class=\"n\">Inertia (mg\u00b7mm\u00b2)</th>"
             "<th scope=\"col\" class=\"n\">Centre of mass x, y (mm)</th></tr></thead><tbody>\n");
    for (int i = 0; i < m->nbody; i++) {
        const fw_mass *b = &m->body[i];
        fw_markup(out,
                  "<tr><th scope=\"row\">{s}</th><td class=\"n\">{u}</td>"
                  "<td class=\"n\">{n}</td><td class=\"n\">{n}, {n}</td></tr>\n",
                  b->id, b->mass_kg * 1e3, "g", b->inertia_kg_m2 * 1e12, b->x_m * 1e3,
                  b->y_m * 1e3);
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

static void hinges(fw_text *out, const fw_mechanism *m) {
    fw_text_add(out, "<div class=\"wide\"><table><caption>Joints</caption><thead><tr>"
                     "<th scope=\"col\">Joint</th><th scope=\"col\" class=\"n\">Stiffness used</th>"
                     "<th scope=\"col\" class=\"n\">From the flexure's geometry</th>"
                     "<th scope=\"col\" class=\"n\">Damping</th></tr></thead><tbody>\n");
    for (int i = 0; i < m->npin; i++) {
        const fw_pin *p = &m->pin[i];
        fw_markup(out, "<tr><th scope=\"row\">{s}</th><td class=\"n\">{u}</td><td class=\"n\">",
                  p->id, p->stiffness_Nm_per_rad, "N\u00b7m/rad");
        if (p->hinge >= 0)
            fw_markup(out, "{u}", m->hinge[p->hinge].closed_form.stiffness_Nm_per_rad,
                      "N\u00b7m/rad");
        else
            fw_text_add(out, "\u2013");
        fw_markup(out, "</td><td class=\"n\">{u}</td></tr>\n", p->damping_Nms_per_rad,
                  "N\u00b7m\u00b7s/rad");
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

void fw_report_mechanics(fw_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    for (int i = 0; i < v->nvariant; i++) {
        const fw_mechanism *m = v->variant[i].mechanism;
        const fw_variant *a = v->variant[i].variant;
        if (!m || !a) continue;
        fw_markup(out, "<h3>Masses and stiffnesses used{r}{s}</h3>\n<p class=\"soft\">{s}{r}",
                  a->flow ? ", " : "", a->flow,
                  a->material.name ? a->material.name : a->material.id,
                  a->material.name || a->material.id ? ", " : "");
        fw_markup(out, "{u} thick.</p>\n", a->thickness_m, "m");
        bodies(out, m);
        hinges(out, m);
    }
}
