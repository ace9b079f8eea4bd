/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include <math.h>
#include <string.h>

enum { MOST = 200 };

typedef struct used {
    const fw_quantity *q;
    const char *where, *name;
} used;

typedef struct used_list {
    used item[MOST];
    int count, dropped;
} used_list;

static void place_cell(fw_text *out, const fw_quantity *q) {
    fw_markup(out, "<td>{s}{r}{s}", q->source, q->source && q->note ? "; " : "", q->note);
    if (q->place.file && q->place.line > 0)
        fw_markup(out, " <span class=\"soft\">{s}:{i}</span>", fw_place_file(q->place),
                  q->place.line);
    fw_text_add(out, "</td>");
}

static void quantity_row(fw_text *out, const used *u) {
    const fw_quantity *q = u->q;
    fw_unit unit = {1.0, 0.0, {0, 0, 0, 0, 0, 0, 0}};
    bool known =
        q->unit && q->unit[0] && fw_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL);
    fw_markup(out, "<tr><th scope=\"row\">{s}</th><td>{s}</td><td class=\"n\">", u->name, u->where);
    if (q->unknown)
        fw_text_add(out, "<strong class=\"no\">unknown</strong>");
    else {
        fw_markup(out, "{n}", (q->value - unit.offset) / unit.factor);
        if (q->uncertainty > 0.0) fw_markup(out, " \u00b1 {e}", q->uncertainty / unit.factor);
        fw_markup(out, " {s}", known && strcmp(q->unit, "1") != 0 ? q->unit : "");
    }
    fw_markup(out, "</td><td>{s}</td>", q->unknown ? "unknown" : fw_value_status_text(q->status));
    place_cell(out, q);
    fw_text_add(out, "</tr>\n");
}

static void quantity_head(fw_text *out, const char *caption) {
    fw_markup(out,
              "<div class=\"wide\"><table><caption>{s}</caption><thead><tr><th scope=\"col\">"
              "Quantity</th><th scope=\"col\">Used in</th><th scope=\"col\" class=\"n\">Value"
              "</th><th scope=\"col\">Status</th><th scope=\"col\">Source</th></tr></thead>"
              "<tbody>\n",
              caption);
}

static void materials(fw_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    quantity_head(out, "Materials as used, with the device file's own values where it gives them");
    for (int i = 0; i < v->nvariant; i++) {
        const fw_material *m = &v->variant[i].variant->material;
        const char *where = m->name ? m->name : m->id;
        const used row[] = {{&m->youngs, where, "Young's modulus"},
                            {&m->poisson, where, "Poisson's ratio"},
                            {&m->density, where, "density"},
                            {&m->strength, where, m->criterion ? m->criterion : "strength"},
                            {&m->loss, where, "loss factor"}};
        for (size_t k = 0; k < sizeof row / sizeof row[0]; k++)
            if (row[k].q->unit || row[k].q->source || row[k].q->unknown) quantity_row(out, &row[k]);
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

static void consider(used_list *list, const fw_quantity *q, const char *name, const char *where) {
    if (!q || q->unknown || (q->status != FW_TYPICAL && q->status != FW_ASSUMED)) return;
    for (int i = 0; i < list->count; i++)
        if (list->item[i].q == q) return;
    if (list->count == MOST) {
        list->dropped++;
        return;
    }
    list->item[list->count++] = (used){q, where, q->id ? q->id : name};
}

static void collect(used_list *list, const fw_flow *flow) {
    consider(list, flow->thickness, "device layer thickness", flow->id);
    for (int i = 0; i < flow->nstep; i++) {
        const fw_step *s = &flow->step[i];
        const char *where = s->title ? s->title : s->id;
        for (int k = 0; k < s->nargument; k++)
            consider(list, s->argument[k].q, s->argument[k].name, where);
        for (int k = 0; k < s->nsetting; k++)
            consider(list, s->setting[k].q, s->setting[k].name, where);
    }
}

static fw_status process_quantities(fw_page *page) {
    used_list *list;
    FW_NEED(list = fw_arena_one(page->arena, used_list));
    for (int i = 0; i < page->in->nflow; i++)
        if (page->in->flow[i].flow) collect(list, page->in->flow[i].flow);
    if (list->count == 0) return FW_OK;
    fw_text *out = page->out;
    quantity_head(out,
                  "Process numbers that nobody measured or stated for this device: replace them "
                  "with your own");
    for (int i = 0; i < list->count; i++)
        quantity_row(out, &list->item[i]);
    fw_text_add(out, "</tbody></table></div>\n");
    if (list->dropped) fw_markup(out, "<p>{i} more are not shown.</p>\n", list->dropped);
    return fw_text_end(out);
}

static void scaling(fw_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    for (int i = 0; i < v->nvariant; i++) {
        const fw_variant *a = v->variant[i].variant;
        if (a->explicit_mass_scale == 1.0 && a->explicit_stiffness_scale == 1.0 &&
            a->explicit_damping_scale == 1.0)
            continue;
        fw_markup(out,
                  "<li>{s}: masses, stiffnesses and dampings that the file states hold for the "
                  "device's own material and thickness; here they are multiplied by {n}, {n} "
                  "and {n} (density \u00d7 thickness, modulus \u00d7 thickness, and the root of "
                  "their product: the same modal damping).</li>\n",
                  a->flow ? a->flow : "this variant", a->explicit_mass_scale,
                  a->explicit_stiffness_scale, a->explicit_damping_scale);
    }
}

static void models(fw_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    double most = 0.0;
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; v->variant[i].mechanism && k < v->variant[i].mechanism->nhinge; k++)
            most = fmax(most, v->variant[i].mechanism->hinge[k].closed_form.limit_uncertainty);
    fw_markup(out,
              "<li>Hinges: pseudo-rigid bodies, revolute joints at the elastic centres; "
              "closed-form curved-beam theory with depth and root corrections and the "
              "concentration at the fillet. Standard uncertainty of the limit angle from the "
              "model: up to {p}.</li>\n<li>Safety factor {n}, applied to the material's "
              "limit.</li>\n<li>Bodies between the hinges are rigid; the motion stays in the "
              "plane of the wafer.</li>\n",
              most, page->in->device->safety_factor);
}

fw_status fw_report_section_assumptions(fw_page *page) {
    fw_text *out = page->out;
    fw_text_add(out, "<ul class=\"plain\">\n");
    if (page->in->nassumption == 0) { /* the caller's own list says it in more detail */
        models(page);
        scaling(page);
    }
    for (int i = 0; i < page->in->nassumption; i++)
        fw_markup(out, "<li>{s}</li>\n", page->in->assumption[i]);
    fw_text_add(out, "</ul>\n");
    if (page->in->verdict->nvariant) materials(page);
    fw_report_mechanics(page);
    return process_quantities(page);
}
