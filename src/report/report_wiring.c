/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nets of a flow: a drawing in which every conductor has a colour and its contact a frame, and a table. */
#include "report/report_page.h"
#include <math.h>

enum { WIDE = 420, STRIP = 24 };

static const char *colour_of(int net) { /* the rotor's is grey, as that of all structure */
    return net == 0 ? "#9aa7b4" : fw_report_layer_colour(NULL, net);
}

static void picture(fw_text *out, const fw_wiring *w) {
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
fw_status fw_report_wiring(fw_text *out, const fw_wiring *w) {
    if (!w || w->ndrive == 0) return FW_OK;
    picture(out, w);
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
