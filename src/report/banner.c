/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The first sections of the page: decision, advice, what is made, what the flows may make of it, and which
   measurement pays. */
#include "report/report.h"
#include "report/report_page.h"
#include <math.h>
#include <string.h>

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

static void facts(fw_text *out, const fw_verdict_hinge_verdict *h) {
    fw_markup(out,
              "<dl><div><dt>Governing hinge as drawn</dt><dd>{s}, which turns by {d} of {d}</dd>"
              "</div><div><dt>Peak strain (limit)</dt><dd>{p} ({p})</dd></div>",
              h->id, fabs(h->peak_angle_rad), h->limit_angle_rad, h->peak_strain, h->strain_limit);
    limit(out, h);
    fw_text_add(out, "</dl>\n");
}

static void set_this(fw_text *out, const char *path, const char *value) {
    if (path && value) fw_markup(out, " <code>--set &#39;{s}={s}&#39;</code>", path, value);
}

/* those alone that accept are among the proposals */
static void parameters(fw_text *out, const fw_verdict *v) {
    int said = 0;
    for (int i = 0; i < v->nparameter; i++) {
        const fw_verdict_parameter_advice *p = &v->parameter[i];
        if (p->found == FW_PARAMETER_ACCEPTS) continue;
        if (said++ == 0) fw_text_add(out, "<p>Not by one parameter alone:</p>\n<ul>\n");
        fw_markup(out, "<li>{s}</li>\n", p->text);
    }
    if (said > 0) fw_text_add(out, "</ul>\n");
}

void fw_report_advice(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    if (v->nproposal == 0 && !v->advice_note && v->nparameter == 0) return;
    fw_markup(out, "<aside class=\"advice\"><h2>{r}</h2>\n",
              v->nproposal ? "What would be accepted" : "Advice");
    if (v->nproposal)
        fw_text_add(out, "<p>The least change first; each was run and accepted.</p>\n<ol>\n");
    for (int i = 0; i < v->nproposal; i++) {
        const fw_verdict_proposal *p = &v->proposal[i];
        fw_markup(out, "<li>{s}", p->text);
        for (int k = 0; k < p->nset; k++)
            set_this(out, p->set[k].path, p->set[k].value);
        fw_text_add(out, "</li>\n");
    }
    if (v->nproposal) fw_text_add(out, "</ol>\n");
    if (v->advice_note) fw_markup(out, "<p>{s}</p>\n", v->advice_note);
    parameters(out, v);
    fw_text_add(out, "</aside>\n");
}

fw_status fw_report_banner(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    fw_report_summary top;
    FW_TRY(fw_report_summarise(out->arena, page->in, &top));
    fw_markup(out,
              "<header style=\"background:{r}\"><div class=\"in\"><h1>{s}: elastic verdict"
              "</h1>\n<p class=\"word\">{r}</p>\n",
              fw_report_decision_colour(v->decision), page->in->device->name,
              fw_report_decision_word(v->decision));
    if (top.unmade)
        fw_markup(out, "<p class=\"why\">But it cannot be made in {s}.</p>\n", top.unmade);
    if (top.dies) fw_markup(out, "<p class=\"why\">But {s}.</p>\n", top.dies);
    if (v->drawn != v->decision)
        fw_markup(out, "<p class=\"why\">The drawn geometry alone: {r}.</p>\n",
                  fw_report_decision_word(v->drawn));
    for (int i = 0; i < top.nline; i++)
        fw_markup(out, "<p class=\"why\"><b>{s}:</b> {s}</p>\n", top.line[i].label,
                  top.line[i].text);
    if (top.has_drawn) facts(out, top.drawn.hinge);
    fw_text_add(out, "</div></header>\n");
    return FW_OK;
}

fw_status fw_report_section_device(fw_report_page *page) {
    const fw_device *device = page->in->device;
    fw_text *out = page->out;
    const fw_verdict *verdict = page->in->verdict;
    double legend;
    FW_TRY(fw_report_legend_height(page->arena, device, page->in->layout, verdict, &legend));
    fw_text_add(out, "<div class=\"two\"><figure style=\"margin:0\">");
    fw_svg_begin(out, &(fw_svg_frame){.width = page->view.width,
                                      .height = page->view.height + legend,
                                      .decimals = 2,
                                      .lead = "class='drawing' role='img'"});
    fw_svg_title(out, "{s}: hinges coloured by utilisation", device->name);
    FW_TRY(fw_report_drawing(device, page->in->layout, verdict, &page->view, true, out));
    fw_svg_end(out);
    if (!fw_report_drawn(page->in->layout))
        fw_markup(out, "<figcaption class=\"soft\">Schematic. {s}</figcaption>\n",
                  page->in->layout ? page->in->layout->why_not : NULL);
    else if (page->in->layout->nfault > 0)
        fw_text_add(out, "<figcaption class=\"soft\">This layout cannot be made, and no mask is: "
                         "parts, hinges and places in red have a number and a row below the "
                         "picture, the whole sentence is among the <a href=\"#messages\">messages"
                         "</a>.</figcaption>\n");
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

/* ---- what is made, with the numbers that the equations of motion are given ---- */

/* What the equations of motion were given, per flow: masses, stiffnesses, dampings. */

static void bodies(fw_text *out, const fw_mechanism *m) {
    fw_text_add(
        out, "<div class=\"wide\"><table><caption>Bodies</caption><thead><tr>"
             "<th scope=\"col\">Body</th><th scope=\"col\" class=\"n\">Mass</th>"
             "<th scope=\"col\" class=\"n\">Inertia (mg\u00b7mm\u00b2)</th>"
             "<th scope=\"col\" class=\"n\">Centre of mass x, y (mm)</th></tr></thead><tbody>\n");
    for (int i = 0; i < m->nbody; i++) {
        const fw_mechanism_mass *b = &m->body[i];
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
        const fw_mechanism_pin *p = &m->pin[i];
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

void fw_report_mechanics(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    for (int i = 0; i < v->nvariant; i++) {
        const fw_mechanism *m = v->variant[i].mechanism;
        const fw_mechanism_variant *a = v->variant[i].variant;
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

/* What the flows make of the device: in the terminal and on the page. */

static double in_unit(const fw_verdict_fabrication_input *in, double x) {
    fw_quantity q = in->q;
    q.value = x;
    return fw_quantity_in_unit(&q);
}

static const char *unit_of(const fw_verdict_fabrication_input *in) {
    bool pure = !in->q.unit || (in->q.unit[0] == '1' && !in->q.unit[1]);
    return pure ? "" : in->q.unit;
}

/* ---- what the flows may make of it: on the terminal ---- */

static void assumed(fw_text *out, const fw_verdict_variant_verdict *v) {
    for (int i = 0; i < v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &v->input[i];
        if (!in->unknown) continue;
        fw_text_printf(out, "  %s is not known (%s): ", in->name, in->unknown);
        if (in->open) {
            fw_text_add(out, "no range is assumed, and nothing is accepted until it is measured\n");
            continue;
        }
        fw_text_number(out, in_unit(in, in->low), 4);
        fw_text_add(out, " to ");
        fw_text_number(out, in_unit(in, in->high), 4);
        fw_text_printf(out, "%s%s is assumed, and the verdict holds there only\n",
                       *unit_of(in) ? " " : "", unit_of(in));
    }
}

void fw_report_fabricated_text(fw_text *out, const fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (!v->fabricated) continue;
        int k = fw_verdict_most_used(v);
        fw_text_printf(out, "\nas %s makes it: %s (as drawn: %s)\n", v->variant->flow,
                       fw_verdict_decision_text(v->fabricated->decision),
                       fw_verdict_decision_text(v->drawn));
        if (k != FW_NONE) {
            const fw_verdict_fabricated_hinge *m = &v->fabricated->hinge[k];
            const fw_verdict_fabricated_corner *c = &v->fabricated->corner[m->corner];
            const fw_verdict_hinge_verdict *h = &c->hinge[k];
            fw_text_printf(out, "  tightest: %s%s, ", FW_NAMED("hinge", h->id));
            fw_text_real(out, "%.1f %% ", 100.0 * h->utilisation);
            fw_text_real(out, "(%.1f..", 100.0 * h->utilisation_low);
            fw_text_real(out, "%.1f) ", 100.0 * h->utilisation_high);
            fw_text_printf(out, "in %s at %s; nominal ", h->scene, c->what);
            fw_text_real(out, "%.1f", 100.0 * v->fabricated->corner[0].hinge[k].utilisation);
            fw_text_real(out, " +- %.1f %%\n", 100.0 * m->sigma);
        }
        assumed(out, v);
    }
}

/* ---- what the flows may make of it: on the page ---- */

static void ranges(fw_text *out, const fw_verdict_variant_verdict *v) {
    fw_text_add(out, "<div class=\"wide\"><table><caption>What is not fabricated exactly as "
                     "drawn</caption><thead><tr><th scope=\"col\">Input</th><th scope=\"col\" "
                     "class=\"n\">Nominal</th><th scope=\"col\" class=\"n\">From</th><th "
                     "scope=\"col\" class=\"n\">To</th><th scope=\"col\">Status</th><th "
                     "scope=\"col\">Source</th></tr></thead><tbody>\n");
    for (int i = 0; i < v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &v->input[i];
        if (in->open) {
            fw_markup(out,
                      "<tr class=\"bad\"><th scope=\"row\">{s}</th><td class=\"n\"></td><td "
                      "class=\"n\"></td><td class=\"n\"></td><td>not known, and nothing is "
                      "assumed: {s}</td><td>{s}{s}{s}</td></tr>\n",
                      in->name, in->unknown, in->q.source, in->q.note ? "; " : "", in->q.note);
            continue;
        }
        fw_markup(out,
                  "<tr><th scope=\"row\">{s}</th><td class=\"n\">{n} {s}</td><td "
                  "class=\"n\">{n}</td><td class=\"n\">{n}</td><td>{s}{s}{s}</td><td>{s}"
                  "{s}{s}</td></tr>\n",
                  in->name, in_unit(in, in->nominal), unit_of(in), in_unit(in, in->low),
                  in_unit(in, in->high), fw_quantity_value_status_text(in->q.status),
                  in->unknown ? ": not known, " : "", in->unknown, in->q.source,
                  in->q.note ? "; " : "", in->q.note);
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

static void tightest_row(fw_text *out, const fw_verdict_variant_verdict *v, int k) {
    const fw_verdict_fabricated_hinge *m = &v->fabricated->hinge[k];
    const fw_verdict_fabricated_corner *c = &v->fabricated->corner[m->corner];
    const fw_verdict_hinge_verdict *h = &c->hinge[k];
    fw_markup(out,
              "<tr{r}><th scope=\"row\">{s}</th><td class=\"n\">{p}</td><td class=\"n\">{p}"
              "</td><td class=\"n\">{p}</td><td class=\"n\">{p} to {p}</td><td class=\"n\">{p}"
              "</td><td>{s}</td><td>{s}</td></tr>\n",
              h->decision == FW_ACCEPT ? "" : " class=\"bad\"", h->id, v->hinge[k].utilisation,
              v->fabricated->corner[0].hinge[k].utilisation, h->utilisation, h->utilisation_low,
              h->utilisation_high, m->most, h->scene, c->what);
}

static void tightest(fw_text *out, const fw_verdict_variant_verdict *v) {
    fw_text_add(out,
                "<div class=\"wide\"><table><caption>The highest utilisation of the devices that "
                "were run, and a bound for every corner by first order</caption><thead><tr><th "
                "scope=\"col\">Hinge"
                "</th><th scope=\"col\" class=\"n\">As drawn</th><th scope=\"col\" class=\"n\">"
                "Nominal</th><th scope=\"col\" class=\"n\">Tightest</th><th scope=\"col\" "
                "class=\"n\">Error band</th><th scope=\"col\" class=\"n\">At most</th><th "
                "scope=\"col\">Scene</th><th scope=\"col\">Where</th></tr></thead><tbody>\n");
    for (int k = 0; k < v->nhinge; k++)
        if (v->fabricated->corner[v->fabricated->hinge[k].corner].hinge[k].scene)
            tightest_row(out, v, k);
    fw_text_add(out, "</tbody></table></div>\n");
}

static void sigma_row(fw_text *out, const fw_verdict_variant_verdict *v, int k) {
    const fw_verdict_fabricated_hinge *m = &v->fabricated->hinge[k];
    fw_markup(out, "<tr><th scope=\"row\">{s}</th><td class=\"n\">", v->hinge[k].id);
    fw_text_fixed(out, 100.0 * m->sigma, 2);
    fw_text_add(out, "</td>");
    for (int i = 0; i < v->ninput; i++) {
        fw_text_add(out, "<td class=\"n\">");
        fw_text_fixed(out, 100.0 * m->share[i], 2);
        fw_text_add(out, "</td>");
    }
    fw_text_add(out, "</tr>\n");
}

static void sigmas(fw_text *out, const fw_verdict_variant_verdict *v) {
    fw_text_add(out,
                "<div class=\"wide\"><table><caption>Standard uncertainty of the nominal "
                "utilisation, and what the inputs contribute, in per cent of the limit"
                "</caption><thead><tr><th scope=\"col\">Hinge</th><th scope=\"col\" class=\"n\">"
                "In all</th>");
    for (int i = 0; i < v->ninput; i++)
        fw_markup(out, "<th scope=\"col\" class=\"n\">{s}</th>", v->input[i].name);
    fw_text_add(out, "</tr></thead><tbody>\n");
    for (int k = 0; k < v->nhinge; k++)
        sigma_row(out, v, k);
    fw_text_add(out, "</tbody></table></div>\n");
}

static void one_flow(fw_text *out, const fw_verdict_variant_verdict *v) {
    const fw_verdict_fabricated_verdict *m = v->fabricated;
    fw_markup(out,
              "<h3>{s}: {s}</h3>\n<p>As drawn: {s}. {i} devices within the ranges were run{s}"
              "; first-order estimates were within {p} of them.</p>\n",
              v->variant->flow, fw_verdict_decision_text(m->decision),
              fw_verdict_decision_text(v->drawn), m->ncorner,
              m->all ? ", every corner among them" : "", m->error);
    if (m->reason)
        fw_markup(out, "<p><strong>{s}</strong>{s}{s}.</p>\n", m->reason, m->control ? "; " : "",
                  m->control);
    ranges(out, v);
    tightest(out, v);
    sigmas(out, v);
}

fw_status fw_report_section_fabricated(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    bool any = false;
    for (int i = 0; i < v->nvariant; i++)
        any = any || v->variant[i].fabricated;
    if (!any)
        fw_text_add(page->out, v->drawn != FW_ACCEPT
                                   ? "<p>Not examined: the drawn geometry is not accepted.</p>\n"
                                   : "<p>Only the drawn geometry was judged.</p>\n");
    for (int i = 0; i < v->nvariant; i++)
        if (v->variant[i].fabricated) one_flow(page->out, &v->variant[i]);
    return fw_text_end(page->out);
}

/* ---- which measurement pays: on the page ---- */

bool fw_report_has_measurements(const fw_report_page *page) {
    for (int i = 0; i < page->in->nflow; i++)
        if (page->in->flow[i].measuring) return true;
    return false;
}

static fw_status value_text(fw_arena *arena, const fw_measuring_item *x, bool after,
                            const char **out) {
    fw_text text = fw_text_new(arena);
    fw_measuring_put_value(&text, x, after);
    FW_TRY(fw_text_end(&text));
    *out = text.data;
    return FW_OK;
}

/* "S18: 80.8..99.2 to 84.1..95.9 min" of the step whose window loses most, and how many more there are */
static fw_status window_text(fw_arena *arena, const fw_measuring_item *x, const char **out) {
    fw_text text = fw_text_new(arena);
    fw_measuring_put_windows(&text, x);
    FW_TRY(fw_text_end(&text));
    *out = text.length ? text.data : "";
    return FW_OK;
}

static fw_status measurement_row(fw_report_page *page, const fw_measuring *m, int i) {
    const fw_measuring_item *x = &m->item[i];
    const char *before, *after, *windows;
    fw_text worth = fw_text_new(page->arena);
    FW_TRY(value_text(page->arena, x, false, &before));
    FW_TRY(value_text(page->arena, x, true, &after));
    FW_TRY(window_text(page->arena, x, &windows));
    fw_measuring_put_worth(&worth, m, x);
    FW_TRY(fw_text_end(&worth));
    fw_markup(page->out,
              "<tr><td class=\"n\">{i}</td><th scope=\"row\">{s}{s}{s}{s}</th><td>{s}{s}</td>"
              "<td>{s}</td><td>{s}</td><td class=\"n\">{s}</td><td>{s}</td></tr>\n",
              i + 1, x->name, x->id ? " (" : "", x->id, x->id ? ")" : "", before,
              x->unknown && !isnan(x->value) ? " (assumed)" : "",
              x->by     ? x->by
              : x->open ? ""
                        : "nothing here",
              isnan(x->value) ? "" : after, worth.length ? worth.data : "", windows);
    return FW_OK;
}

static fw_status measurements_of_flow(fw_report_page *page, const fw_report_flow *f) {
    const fw_measuring *m = f->measuring;
    fw_text band = fw_text_new(page->arena);
    fw_markup(page->out, "<h3>{s}</h3>\n", f->flow ? f->flow->id : "");
    if (m->first) fw_markup(page->out, "<p><strong>{s}</strong></p>\n", m->first);
    if (m->what && m->banded) {
        fw_measuring_put_band(&band, &m->band);
        FW_TRY(fw_text_end(&band));
        fw_markup(page->out,
                  "<p>As it is known now, {s} uses {s} of its limit over all that the flow may "
                  "make ({s}). {i} more devices were run for this.</p>\n",
                  m->what, band.data, fw_verdict_decision_text(m->decision), m->judged);
    }
    if (m->nitem > 0) {
        fw_markup(
            page->out,
            "<div class=\"wide\"><table><caption>Each input measured alone, its value kept: {r}, "
            "and of the steps' time windows (first look to clear by)</caption><thead><tr><th "
            "scope=\"col\" class=\"n\">Rank</th><th scope=\"col\">Input</th><th scope=\"col\">"
            "Now</th><th scope=\"col\">Read by</th><th scope=\"col\">Then</th><th scope=\"col\" "
            "class=\"n\">{r}</th><th scope=\"col\">Windows</th></tr></thead><tbody>\n",
            m->banded ? "what would be left of the band"
                      : "what it brings to the standard uncertainty, now and then (bands: "
                        "--measurements all)",
            m->banded ? "Band" : "Uncertainty");
        for (int i = 0; i < m->nitem; i++)
            FW_TRY(measurement_row(page, m, i));
        fw_text_add(page->out, "</tbody></table></div>\n"
                               "<p>Where nothing here reads an input, it is taken to be known "
                               "exactly: a bound on what any measurement of it can do.</p>\n");
    }
    if (m->nothing[0])
        fw_markup(page->out, "<p>Measuring these changes nothing: {s}.</p>\n", m->nothing);
    return fw_text_end(page->out);
}

fw_status fw_report_section_measurements(fw_report_page *page) {
    for (int i = 0; i < page->in->nflow; i++)
        if (page->in->flow[i].measuring) FW_TRY(measurements_of_flow(page, &page->in->flow[i]));
    return fw_text_end(page->out);
}

/* ---- which measurement pays: on the terminal ---- */

enum { RANKED = 6 }; /* on the terminal; all of them stand in the report */

static void ranking(fw_text *out, const fw_measuring *m) {
    int n = 0;
    if (!m->what || !m->banded) return;
    fw_text_printf(out, "  of the band of %s, ", m->what);
    fw_measuring_put_band(out, &m->band);
    fw_text_add(out, ", an input that is measured alone leaves:\n");
    for (int i = 0; i < m->nitem && n < RANKED; i++) {
        if (!m->item[i].made && !m->item[i].open) continue;
        fw_text_printf(out, "  %d  %s (%s): ", ++n, m->item[i].name,
                       m->item[i].by     ? m->item[i].by
                       : m->item[i].open ? m->item[i].id
                                         : "read by nothing here");
        fw_measuring_put_worth(out, m, &m->item[i]);
        fw_text_add(out, "\n");
    }
}

/* where bands were asked for: by --measurements all, or because it is undecided what a flow makes */
void fw_report_measurements_text(fw_text *out, const fw_report_input *in, bool ranked) {
    for (int i = 0; i < in->nflow; i++) {
        const fw_measuring *m = in->flow[i].measuring;
        if (!m || !m->asked) continue;
        if (m->first)
            fw_text_printf(out, "\n%s: %s\n", in->flow[i].flow ? in->flow[i].flow->id : "",
                           m->first);
        if (ranked) ranking(out, m);
    }
}
