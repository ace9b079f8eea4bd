/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is made of each flow: its own section, nets, masks, what breaks design rules, recipes. */
#include "mask/mask.h"
#include "report/report_page.h"
#include <math.h>

/* ---- nets of a flow ----
   A drawing in which every conductor has a colour and its contact a frame, and a table. */

enum { WIDE = 420, STRIP = 24 }; /* the second is for the scale bar */

static const char *colour_of(int net) { /* the rotor's is grey, as that of all structure */
    return net == 0 ? "#9aa7b4" : fw_report_layer_colour(NULL, net);
}

static void nets_picture(fw_text *out, const fw_wiring *w) {
    const fw_layout *l = w->layout;
    double size = fmax(l->die.x1 - l->die.x0, l->die.y1 - l->die.y0);
    fw_report_view view = fw_report_view_fit(l->die, WIDE, 0.02 * size);
    fw_svg_begin(out, &(fw_svg_frame){.width = view.width,
                                      .height = view.height + STRIP,
                                      .decimals = 2,
                                      .lead = "class='drawing' role='img'"});
    fw_svg_title(out, "Nets, each in a colour of its own, with their contacts");
    for (int net = 0; net < w->nnet; net++) {
        const fw_wiring_net *n = &w->net[net];
        fw_svg_path(out, "fill='{r}' stroke='{r}' stroke-width='0.4'", colour_of(net),
                    colour_of(net));
        for (int i = 0; i < w->npiece; i++)
            if (w->net_of[i] == net) fw_report_path(out, &view, &l->piece[i].contour);
        fw_svg_path_end(out);
        if (!n->needed || !n->padded) continue;
        fw_geometry_segment side[4];
        const fw_geometry_vec2 at[5] = {{n->pad.x0, n->pad.y0},
                                        {n->pad.x1, n->pad.y0},
                                        {n->pad.x1, n->pad.y1},
                                        {n->pad.x0, n->pad.y1},
                                        {n->pad.x0, n->pad.y0}};
        for (int k = 0; k < 4; k++)
            side[k] = (fw_geometry_segment){.kind = FW_LINE, .a = at[k], .b = at[k + 1]};
        fw_geometry_contour square = {side, 4};
        fw_svg_path(out, "fill='none' stroke='#b42318' stroke-width='1.2'");
        fw_report_path(out, &view, &square);
        fw_svg_path_end(out);
    }
    view.height += STRIP;
    fw_report_scale_bar_svg(out, &view);
    fw_svg_end(out);
}

/* nets, contacts and gaps, of a device that something drives */
static fw_status nets(fw_text *out, const fw_wiring *w) {
    if (!w || w->ndrive == 0) return FW_OK;
    nets_picture(out, w);
    fw_markup(out,
              "<p>Insulated by: {s}.</p>\n<div class=\"wide\"><table><caption>Nets, where each is "
              "contacted, and the gaps between them</caption><tbody>\n",
              w->carrier.words);
    for (int i = 0; i < w->nnet; i++) {
        const char *words;
        FW_TRY(fw_wiring_contact_words(out->arena, &w->net[i], &words));
        fw_markup(out,
                  "<tr><th scope=\"row\"><span class=\"swatch\" "
                  "style=\"background:{r}\"></span>{s}</th><td>{s}</td></tr>\n",
                  colour_of(i), w->net[i].name, words);
    }
    for (int i = 0; i < w->ngap; i++) {
        const char *words;
        FW_TRY(fw_wiring_gap_words(out->arena, w, &w->gap[i], &words));
        fw_markup(out, "<tr><th scope=\"row\">gap</th><td>{s}</td></tr>\n", words);
    }
    for (int i = 0; i < w->nremark; i++)
        fw_markup(out, "<tr><th scope=\"row\">note</th><td>{s}</td></tr>\n", w->remark[i]);
    fw_text_add(out, "</tbody></table></div>\n");
    return FW_OK;
}

/* ---- the sections ---- */

static const char *name_of(const fw_report_flow *f) {
    if (f->flow && f->flow->id) return f->flow->id;
    if (f->variant && f->variant->variant && f->variant->variant->flow)
        return f->variant->variant->flow;
    return "flow";
}

static void manufacturable(fw_text *out, const fw_process_flow *flow) {
    fw_markup(out, "<p>{s}{r}", flow->title, flow->title ? ". " : "");
    fw_text_add(out, flow->manufacturable > 0
                         ? "<strong>Manufacturable</strong> with the numbers known."
                     : flow->manufacturable == 0
                         ? "<strong class=\"no\">Not manufacturable</strong> in this flow."
                         : "<strong>Not guaranteed</strong> until something is measured.");
    fw_text_add(out, "</p>\n");
    if (flow->nreason == 0) return;
    fw_text_add(out, "<ul class=\"plain\">\n");
    for (int i = 0; i < flow->nreason; i++)
        fw_markup(out, "<li>{s}</li>\n", flow->reason[i]);
    fw_text_add(out, "</ul>\n");
}

fw_status fw_report_section_flows(fw_report_page *page) {
    fw_text *out = page->out;
    if (page->in->nflow == 0) fw_text_add(out, "<p>The description names no flow.</p>\n");
    for (int i = 0; i < page->in->nflow; i++) {
        const fw_report_flow *f = &page->in->flow[i];
        fw_markup(out, "<h3>{s} ", name_of(f));
        if (f->variant)
            fw_markup(out, "<span class=\"tag\" style=\"background:{r}\">{r}</span>",
                      fw_report_decision_colour(f->variant->decision),
                      fw_report_decision_word(f->variant->decision));
        fw_text_add(out, "</h3>\n");
        if (f->flow) manufacturable(out, f->flow);
        FW_TRY(nets(out, f->wiring));
        if (f->variant && f->variant->nhinge)
            fw_report_hinge_table(out, f->variant->hinge, f->variant->nhinge, false,
                                  "Hinges in this flow");
    }
    return fw_text_end(out);
}

enum { THUMBNAIL = 520, MOST_SEGMENTS = 12000 };

static long segments_of(const fw_mask *mask) {
    long segments = 0;
    for (int i = 0; i < mask->nshape; i++)
        segments += mask->shape[i].contour.count;
    return segments;
}

/* one path per layer, from the exact outlines; text goes first when there is too much */
static void thumbnail(fw_text *out, const fw_mask *mask) {
    bool with_text = segments_of(mask) <= MOST_SEGMENTS;
    fw_geometry_box box = mask->box;
    fw_report_view view =
        fw_report_view_fit(box, THUMBNAIL, 0.02 * fmax(box.x1 - box.x0, box.y1 - box.y0));
    fw_svg_begin(out, &(fw_svg_frame){.width = view.width,
                                      .height = view.height + STRIP,
                                      .decimals = 2,
                                      .lead = "class='drawing' role='img'"});
    fw_svg_title(out, "Mask {s}, all layers", mask->flow);
    for (int layer = 0; layer < mask->table->nlayer; layer++) {
        const char *colour = fw_report_layer_colour(mask->table->layer[layer].colour, layer);
        fw_svg_path(out, "fill='{r}' fill-opacity='0.6' stroke='{r}' stroke-width='0.4'", colour,
                    colour);
        for (int i = 0; i < mask->nshape; i++) {
            const fw_mask_shape *s = &mask->shape[i];
            if (s->layer == layer && (with_text || !s->piece || s->piece->role != FW_ROLE_TEXT))
                fw_report_path(out, &view, &s->contour);
        }
        fw_svg_path_end(out);
    }
    view.height += STRIP;
    fw_report_scale_bar_svg(out, &view);
    fw_svg_end(out);
}

static void length_or_dash(fw_text *out, double value) {
    if (value > 0.0 && isfinite(value))
        fw_markup(out, "<td class=\"n\">{u}</td>", value, "m");
    else
        fw_text_add(out, "<td class=\"n\">\u2013</td>");
}

static void layers(fw_text *out, const fw_mask *mask) {
    fw_text_add(out,
                "<div class=\"wide\"><table><caption>Layers, with the least width and space found "
                "on the exact outlines against the rule</caption><thead><tr><th scope=\"col\">"
                "Layer</th><th scope=\"col\">Purpose</th><th scope=\"col\" class=\"n\">Shapes"
                "</th><th scope=\"col\" class=\"n\">Vertices</th><th scope=\"col\" "
                "class=\"n\">Area</th><th scope=\"col\" class=\"n\">Shortest edge</th><th "
                "scope=\"col\" class=\"n\">Width</th><th scope=\"col\" class=\"n\">Rule</th><th "
                "scope=\"col\" class=\"n\">Space</th><th scope=\"col\" class=\"n\">Rule</th>"
                "</tr></thead><tbody>\n");
    for (int i = 0; i < mask->table->nlayer; i++) {
        const fw_mask_layer *l = &mask->table->layer[i];
        const fw_mask_measure none = {0}, *m = mask->measure ? &mask->measure[i] : &none;
        fw_markup(out,
                  "<tr><th scope=\"row\"><span class=\"swatch\" style=\"background:{r}\"></span>"
                  "{i}/{i} {s}</th><td>{s}{r}{s}{r}</td><td class=\"n\">{i}</td><td "
                  "class=\"n\">{i}</td><td class=\"n\">{n} mm\u00b2</td>",
                  fw_report_layer_colour(l->colour, i), l->layer, l->datatype,
                  l->name ? l->name : l->id, l->purpose, l->tone && l->tone[0] ? ", " : "", l->tone,
                  l->biased ? ", biased" : "", m->shapes, m->vertices, m->area_m2 * 1e6);
        length_or_dash(out, m->shortest_edge_m);
        length_or_dash(out, m->width_m);
        length_or_dash(out, l->min_width_m);
        length_or_dash(out, m->space_m);
        length_or_dash(out, l->min_space_m);
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

static fw_status one(fw_text *out, const fw_report_flow *f) {
    const fw_mask *mask = f->mask;
    fw_text_add(out, "<div class=\"two\">\n");
    thumbnail(out, mask);
    fw_text_add(out, "<div>");
    if (mask->rejected)
        fw_text_add(out, "<p><strong class=\"no\">REJECTED: written on request; every file "
                         "carries this mark.</strong></p>\n");
    fw_markup(out,
              "<table><tbody><tr><th scope=\"row\">Cell</th><td>{s}</td></tr>"
              "<tr><th scope=\"row\">Size</th><td>{u} \u00d7 {u}</td></tr>"
              "<tr><th scope=\"row\">Bias per edge</th><td>{u}</td></tr>"
              "<tr><th scope=\"row\">Arc tolerance</th><td>{u}, grid 1\u00a0nm</td></tr>"
              "<tr><th scope=\"row\">Reading</th><td>{s}</td></tr>"
              "{r}{s}{r}"
              "<tr><th scope=\"row\">Polygons</th><td>{i}</td></tr></tbody></table>\n",
              mask->cell, mask->box.x1 - mask->box.x0, "m", mask->box.y1 - mask->box.y0, "m",
              mask->bias_m, "m", mask->tolerance_m, "m", mask->table->reading,
              mask->table->order ? "<tr><th scope=\"row\">Order</th><td>" : "",
              mask->table->order ? mask->table->order : "", mask->table->order ? "</td></tr>" : "",
              mask->nshape);
    if (f->flow && f->flow->bias_note)
        fw_markup(out, "<p class=\"soft small\">{s}</p>\n", f->flow->bias_note);
    if (mask->nnote) fw_text_add(out, "<p class=\"soft small\">Written on the mask: ");
    for (int i = 0; i < mask->nnote; i++)
        fw_markup(out, "{r}{s}", i ? "; " : "", mask->note[i]);
    fw_text_add(out, mask->nnote ? "</p>\n" : "");
    fw_text_add(out, "</div></div>\n");
    layers(out, mask);
    if (mask->edges && segments_of(mask) <= MOST_SEGMENTS) return fw_mask_outlines_part(mask, out);
    return FW_OK;
}

/* ---- places where a mask breaks design rules ---- */

enum { MOST_ROWS = 60 };

static void row(fw_text *out, const fw_mask *mask, const fw_mask_finding *f) {
    const fw_mask_rule *rule = f->rule;
    const fw_mask_layer *layer = &mask->table->layer[rule->layer];
    const char *unit = fw_mask_rule_unit(rule);
    bool too_much = f->value > f->needed;
    fw_markup(out,
              "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{i}/{i} {s}</td><td "
              "class=\"n\">{n} {r}</td><td class=\"n\">{r} {n} {r}</td><td "
              "class=\"n\">{n}, {n}</td><td>{s}{r}{s}</td><td>{s}</td></tr>\n",
              fw_mask_rule_name(rule), rule->severity == FW_ERROR ? "error" : "warning",
              layer->layer, layer->datatype, layer->name, fw_mask_rule_shown(rule, f->value), unit,
              too_much ? "\u2264" : "\u2265", fw_mask_rule_shown(rule, f->needed), unit,
              0.5e6 * (f->at[0].x + f->at[1].x), 0.5e6 * (f->at[0].y + f->at[1].y),
              f->label[0] ? f->label[0] : "", f->label[1] ? ", " : "",
              f->label[1] ? f->label[1] : "", rule->source);
}

static void time_cells(fw_text *out, const fw_process_step *step) {
    const fw_process_time *t = &step->time;
    if (t->computable) {
        fw_markup(out, "<td class=\"n\">{h}", t->nominal_s);
        if (t->relative_uncertainty > 0.0 && isfinite(t->relative_uncertainty))
            fw_markup(out, " \u00b1\u00a0{e}\u00a0%", 100.0 * t->relative_uncertainty);
        fw_markup(out,
                  "</td><td class=\"n\">{h}</td><td class=\"n\">{h}</td><td "
                  "class=\"n\">{h}</td><td>{s}",
                  t->first_look_s, t->clear_by_s, t->stop_s,
                  fw_quantity_value_status_text(t->status));
        for (int i = 0; i < t->ncontribution && i < 3; i++)
            fw_markup(out, "{r}{s}", i ? ", " : "; ", t->contribution[i]);
        fw_text_add(out, "</td>");
    } else if (t->nmissing || (step->law && step->law[0])) {
        fw_text_add(out, "<td colspan=\"5\"><strong class=\"no\">NOT COMPUTABLE</strong>");
        for (int i = 0; i < t->nmissing; i++)
            fw_markup(out, "{r}{s}", i ? ", " : ": needs ", t->missing[i]);
        fw_text_add(out, "</td>");
    } else
        fw_text_add(out, "<td class=\"n\">\u2013</td><td></td><td></td><td></td><td></td>");
}

static void steps(fw_text *out, const fw_process_flow *flow) {
    fw_text_add(out,
                "<div class=\"wide\"><table><caption>Steps in order. A step that the source does "
                "not state is marked; a time is only given where every number it needs is known."
                "</caption><thead><tr><th scope=\"col\" class=\"n\">No.</th><th scope=\"col\">"
                "Step</th><th scope=\"col\" class=\"n\">Time</th><th scope=\"col\" "
                "class=\"n\">First look</th><th scope=\"col\" class=\"n\">Clear by</th>"
                "<th scope=\"col\" class=\"n\">Stop</th>"
                "<th scope=\"col\">Worst input</th></tr></thead><tbody>\n");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        fw_markup(out, "<tr><td class=\"n\">{i}</td><th scope=\"row\" class=\"step\">{s}{r}</th>",
                  i + 1, s->title ? s->title : s->id,
                  s->in_source ? "" : " <span class=\"soft\">(not in the source)</span>");
        time_cells(out, s);
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

/* when every place is free */
static void release(fw_text *out, const fw_report_flow *f) {
    if (!f->release) return;
    fw_text_add(out, "<figure class=\"wide release\"><figcaption>Release: when every place is free"
                     "</figcaption>\n");
    fw_text_bytes(out, f->release->data, f->release->length);
    fw_text_add(out, "</figure>\n");
}

static void paragraph(fw_text *out, const char *words) {
    if (words) fw_markup(out, "<p>{s}.</p>\n", words);
}

/* what holds the device meanwhile, and what breaks the last that does */
static fw_status hanging(fw_text *out, const fw_report_flow *f) {
    const char *words;
    FW_TRY(fw_process_hold_words(out->arena, f->flow, &words));
    paragraph(out, words);
    if (!f->variant || !f->variant->mechanism) return FW_OK;
    FW_TRY(fw_statics_tethers_words(out->arena, f->variant->mechanism, f->tethers, &words));
    paragraph(out, words);
    return FW_OK;
}

fw_status fw_report_section_recipes(fw_report_page *page) {
    fw_text *out = page->out;
    for (int i = 0; i < page->in->nflow; i++) {
        const fw_process_flow *flow = page->in->flow[i].flow;
        if (!flow) continue;
        fw_markup(out, "<h3>{s}</h3>\n<p>{i} steps, {h} over those that can be computed; ",
                  flow->id, flow->nstep, flow->total_s);
        if (flow->not_computable)
            fw_markup(out, "<strong class=\"no\">{i} not computable</strong>.</p>\n",
                      flow->not_computable);
        else
            fw_text_add(out, "none is missing.</p>\n");
        release(out, &page->in->flow[i]);
        FW_TRY(hanging(out, &page->in->flow[i]));
        steps(out, flow);
    }
    if (page->in->nflow == 0) fw_text_add(out, "<p>The description names no flow.</p>\n");
    return fw_text_end(out);
}

/* errors first */
static void findings_table(fw_text *out, const fw_mask *mask) {
    int rows = 0;
    fw_text_add(out, "<div class=\"wide\"><table><caption>Where design rules are broken</caption>"
                     "<thead><tr><th scope=\"col\">Rule</th><th scope=\"col\">Severity</th><th "
                     "scope=\"col\">Layer</th><th scope=\"col\" class=\"n\">Found</th><th "
                     "scope=\"col\" class=\"n\">Needed</th><th scope=\"col\" class=\"n\">At x, y "
                     "(um)</th><th scope=\"col\">Pieces</th><th scope=\"col\">Reason</th></tr>"
                     "</thead><tbody>\n");
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < mask->nfinding; i++) {
            bool error = mask->finding[i].rule->severity == FW_ERROR;
            if (error == (pass == 0) && rows++ < MOST_ROWS) row(out, mask, &mask->finding[i]);
        }
    fw_text_add(out, "</tbody></table></div>\n");
    if (rows > MOST_ROWS) fw_markup(out, "<p>and {i} more.</p>\n", rows - MOST_ROWS);
    fw_markup(out,
              "<p class=\"soft small\">With chords and boxes in "
              "masks/{s}.violations.json, as markers in masks/{s}.violations.gds, and in "
              "masks/{s}.violations.lyrdb for KLayout.</p>\n",
              mask->flow, mask->flow, mask->flow);
}

/* ---- masks ---- */

fw_status fw_report_section_masks(fw_report_page *page) {
    fw_text *out = page->out;
    for (int i = 0; i < page->in->nflow; i++) {
        const fw_report_flow *f = &page->in->flow[i];
        const char *flow = f->flow ? f->flow->id : f->mask ? f->mask->flow : NULL;
        fw_markup(out, "<h3>{s}</h3>\n", flow ? flow : "flow");
        if (f->mask)
            FW_TRY(one(out, f));
        else if (f->mask_error)
            fw_markup(out, "<p><strong class=\"no\">No mask:</strong> {s}</p>\n", f->mask_error);
        else
            fw_markup(out, "<p>No mask{r}.</p>\n",
                      page->in->verdict->decision == FW_REJECT
                          ? ": a rejected design gets none unless it is forced"
                          : " was made");
        if (f->violated) findings_table(out, f->violated);
    }
    if (page->in->nflow == 0) fw_text_add(out, "<p>The description names no flow.</p>\n");
    return fw_text_end(out);
}
