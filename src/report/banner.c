/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report_page.h"
#include <math.h>
#include <string.h>

static void band(fw_text *out, const fw_verdict_hinge_verdict *h) {
    fw_markup(out, "{p}", h->utilisation);
    if (isfinite(h->utilisation_low) && isfinite(h->utilisation_high))
        fw_markup(out, " ({p} to {p})", h->utilisation_low, h->utilisation_high);
}

static bool has_reasons(const fw_verdict *v) {
    for (int i = 0; i < v->nvariant; i++)
        if (v->variant[i].nreason > 0) return true;
    return false;
}

/* scenes that are not accepted for something else than a hinge */
static void reasons(fw_text *out, const fw_verdict *v) {
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nreason; k++) {
            const fw_verdict_reason *r = &v->variant[i].reason[k];
            fw_markup(out, "<p class=\"why\">{r}: {s} (FW-D{i}).</p>\n",
                      r->decision == FW_REJECT ? "REJECTED" : "Inconclusive", r->text, r->number);
        }
}

static void why(fw_text *out, const fw_verdict *v) {
    static const char *const closing[] = {
        [FW_ACCEPT] = "Every hinge stays inside its elastic range, error band included.",
        [FW_INCONCLUSIVE] = "The error band straddles the limit: neither accepted nor rejected.",
        [FW_REJECT] = "REJECTED: it leaves its elastic range.",
    };
    fw_text_add(out, "<p class=\"why\">");
    if (v->governing >= 0 && v->governing < v->nhinge) {
        const fw_verdict_hinge_verdict *h = &v->hinge[v->governing];
        fw_verdict_decision decision = has_reasons(v) ? h->decision : v->decision;
        fw_markup(out, "Hinge {s} turns by {d}; {r}{d} is allowed", h->id, fabs(h->peak_angle_rad),
                  decision == FW_REJECT ? "only " : "", h->limit_angle_rad);
        if (h->force_share > 0.0) /* rotation alone would be less: say where the rest comes from */
            fw_markup(out,
                      " when nothing else loads it. With the force that it carries it "
                      "uses {p} of its limit. ",
                      h->utilisation);
        else
            fw_markup(out, ": {p} of its limit. ", h->utilisation);
        fw_text_add(out, closing[decision]);
    } else
        fw_text_add(out, "No hinge of this device was run to its end.");
    fw_text_add(out, "</p>\n");
    reasons(out, v);
}

static void limit(fw_text *out, const fw_verdict_hinge_verdict *h) {
    if (!h->limit) return;
    fw_markup(out, "<div><dt>Limit ({s}, {s})</dt><dd>{s}: {u}; {s}</dd></div>",
              h->limit->criterion, fw_quantity_value_status_text(h->limit->status),
              h->limit->definition, h->limit_Pa, "Pa", h->limit->source);
    if (isfinite(h->fatigue_utilisation) && isfinite(h->damage) && h->cycles > 0)
        fw_markup(out,
                  "<div><dt>Fatigue (Miner's sum)</dt><dd>{p} of the amplitude that lasts "
                  "({n})</dd></div>",
                  h->fatigue_utilisation, h->damage);
    if (isfinite(h->failure_probability) && h->failure_probability > 0)
        fw_markup(out, "<div><dt>Probability of fracture at the peak</dt><dd>{n}</dd></div>",
                  h->failure_probability);
}

static void facts(fw_text *out, const fw_verdict *v) {
    if (v->governing < 0 || v->governing >= v->nhinge) return;
    const fw_verdict_hinge_verdict *h = &v->hinge[v->governing];
    fw_markup(out,
              "<dl><div><dt>Governing hinge</dt><dd>{s}</dd></div>"
              "<div><dt>Utilisation (error band)</dt><dd>",
              h->id);
    band(out, h);
    fw_markup(out,
              "</dd></div><div><dt>Flow</dt><dd>{s}</dd></div><div><dt>Scene</dt>"
              "<dd>{s}</dd></div><div><dt>Instant</dt><dd>",
              h->flow ? h->flow : "\u2013", h->scene ? h->scene : "\u2013");
    if (isfinite(h->t_s))
        fw_markup(out, "{u}", h->t_s, "s");
    else
        fw_text_add(out, "any pose");
    fw_markup(out, "</dd></div><div><dt>Peak strain (limit)</dt><dd>{p} ({p})</dd></div>",
              h->peak_strain, h->strain_limit);
    limit(out, h);
    fw_text_add(out, "</dl>\n");
}

static void set_this(fw_text *out, const char *path, const char *value) {
    if (path && value) fw_markup(out, " <code>--set &#39;{s}={s}&#39;</code>", path, value);
}

static void parameters(fw_text *out, const fw_verdict *v) {
    if (v->nparameter == 0) return;
    fw_text_add(out, "<p>One parameter alone:</p>\n<ul>\n");
    for (int i = 0; i < v->nparameter; i++) {
        const fw_verdict_parameter_advice *p = &v->parameter[i];
        fw_markup(out, "<li>{s}", p->text);
        set_this(out, p->name, p->value_text);
        fw_text_add(out, "</li>\n");
    }
    fw_text_add(out, "</ul>\n");
}

void fw_report_advice(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    if (v->nadvice == 0 && !v->advice_note && v->nparameter == 0) return;
    fw_markup(out, "<aside class=\"advice\"><h2>{r}</h2>\n",
              v->nadvice ? "What would be accepted" : "Advice");
    if (v->nadvice) {
        fw_text_add(out, "<ul>\n");
        for (int i = 0; i < v->nadvice; i++) {
            const fw_verdict_advice *a = &v->advice[i];
            fw_markup(out, "<li>{s}", a->text);
            set_this(out, a->set_path, a->value_text);
            fw_text_add(out, "</li>\n");
        }
        fw_text_add(out, "</ul>\n");
        if (!v->advice_note)
            fw_markup(out, "<p>{r}</p>\n",
                      v->advice_verified ? "All of these changes together were run and accepted."
                                         : "These changes together were not confirmed by a run.");
    }
    if (v->advice_note) fw_markup(out, "<p>{s}</p>\n", v->advice_note);
    parameters(out, v);
    fw_text_add(out, "</aside>\n");
}

void fw_report_banner(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    fw_markup(out,
              "<header style=\"background:{r}\"><div class=\"in\"><h1>{s}: elastic verdict"
              "</h1>\n<p class=\"word\">{r}</p>\n",
              fw_report_decision_colour(v->decision), page->in->device->name,
              fw_report_decision_word(v->decision));
    why(out, v);
    if (v->drawn != v->decision)
        fw_markup(out, "<p class=\"why\">The drawn geometry alone: {r}.</p>\n",
                  fw_report_decision_word(v->drawn));
    facts(out, v);
    fw_text_add(out, "</div></header>\n");
}

fw_status fw_report_section_device(fw_report_page *page) {
    const fw_device *device = page->in->device;
    fw_text *out = page->out;
    const fw_verdict *verdict = page->in->verdict;
    fw_text_add(out, "<div class=\"two\"><figure style=\"margin:0\">");
    fw_svg_begin(out, &(fw_svg_frame){.width = page->view.width,
                                      .height = page->view.height + 30.0,
                                      .decimals = 2,
                                      .lead = "class='drawing' role='img'"});
    fw_svg_title(out, "{s}: hinges coloured by utilisation", device->name);
    FW_TRY(fw_report_drawing(device, page->in->layout, verdict, &page->view, true, out));
    fw_svg_end(out);
    if (!fw_report_drawn(page->in->layout))
        fw_markup(out, "<figcaption class=\"soft\">Schematic. {s}</figcaption>\n",
                  page->in->layout ? page->in->layout->why_not : NULL);
    fw_text_add(out,
                "</figure>\n<div><h3>What it is made of</h3><table><thead><tr><th scope=\"col\">"
                "Flow</th><th scope=\"col\">Material</th><th scope=\"col\" class=\"n\">Thickness"
                "</th><th scope=\"col\">Verdict</th></tr></thead><tbody>\n");
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        const fw_device_material *m = &v->variant->material;
        fw_markup(out,
                  "<tr><th scope=\"row\">{s}</th><td>{s}</td><td class=\"n\">{u}</td>"
                  "<td><span class=\"tag\" style=\"background:{r}\">{r}</span></td></tr>\n",
                  v->variant->flow ? v->variant->flow : "none", m->name ? m->name : m->id,
                  v->variant->thickness_m, "m", fw_report_decision_colour(v->decision),
                  fw_report_decision_word(v->decision));
    }
    fw_text_add(out, "</tbody></table>\n");
    if (device->nparameter)
        fw_text_add(out,
                    "<h3>Parameters</h3><table><thead><tr><th scope=\"col\">Name</th>"
                    "<th scope=\"col\" class=\"n\">Value</th><th scope=\"col\">Meaning</th></tr>"
                    "</thead><tbody>\n");
    for (int i = 0; i < device->nparameter; i++) {
        const fw_device_parameter *p = &device->parameter[i];
        fw_quantity_unit unit;
        const char *name = p->unit ? p->unit : "";
        bool known = name[0] && fw_quantity_unit_parse(name, strlen(name), &unit, NULL, NULL);
        double value = known ? (p->value - unit.offset) / unit.factor : p->value;
        fw_markup(out, "<tr><th scope=\"row\"><code>{s}</code></th><td class=\"n\">", p->name);
        fw_markup_number(out, value, 6);
        fw_markup(out, " {s}</td><td>{s}{r}</td></tr>\n", known ? name : "", p->doc,
                  p->overridden ? " <strong>(set on the command line)</strong>" : "");
    }
    if (device->nparameter) fw_text_add(out, "</tbody></table>\n");
    fw_text_add(out, "</div></div>\n");
    return fw_text_end(out);
}
