/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every hinge by models of growing fidelity, with what each says of its own error. */
#include "report/page.h"

static void within(fw_text *out, double error) {
    fw_text_add(out, " <span class=\"soft\">\u00b1 ");
    fw_markup_number(out, error * 100, 2);
    fw_text_add(out, " %</span></td><td class=\"n\">");
}

static void level(fw_text *out, const fw_report_level *l) {
    fw_markup(out, "<td>{s}</td>", l->name);
    if (l->state != FW_LEVEL_SOLVED) {
        fw_markup(out, "<td colspan=\"7\">not here: {s}</td></tr>\n", l->why);
        return;
    }
    fw_markup(out, "<td class=\"n\">{u}", l->stiffness_Nm_per_rad, "N\u00b7m/rad");
    within(out, l->error.stiffness);
    fw_markup(out, "{u}", l->kx_N_per_m, "N/m");
    within(out, l->error.kx);
    fw_markup(out, "{u}", l->ky_N_per_m, "N/m");
    within(out, l->error.ky);
    fw_text_fixed(out, l->centre_m[0] * 1e6, 2);
    fw_text_add(out, ", ");
    fw_text_fixed(out, l->centre_m[1] * 1e6, 2);
    fw_text_add(out, " <span class=\"soft\">\u00b1 ");
    fw_markup_number(out, l->error.centre_m * 1e6, 2);
    fw_markup(out, "</span></td><td class=\"n\">{n}", l->strain_per_rad);
    within(out, l->error.strain);
    fw_markup(out, "{D}</td><td class=\"n\">", l->limit_angle_rad);
    if (l->drift_m >= 0)
        fw_markup(out, "{u}", l->drift_m, "m");
    else
        fw_text_add(out, "\u2013");
    fw_text_add(out, "</td></tr>\n");
}

static void rows(fw_text *out, const fw_report_hinge *h) {
    for (int k = 0; k < h->nlevel; k++) {
        fw_text_add(out, "<tr>");
        if (k == 0)
            fw_markup(out, "<th scope=\"rowgroup\" rowspan=\"{i}\">{s}{r}{s}</th>", h->nlevel,
                      h->id, h->flow ? ", " : "", h->flow);
        level(out, &h->level[k]);
    }
}

fw_status fw_report_ladder(fw_page *page) {
    const fw_report_input *in = page->in;
    fw_text *out = page->out;
    if (in->nhinge == 0) return FW_OK;
    fw_text_add(
        out,
        "<h3>The hinges by models of growing fidelity</h3>\n<div class=\"wide\"><table><caption>"
        "What each model says of the flexure and, behind \u00b1, of its own error. Kx is along the "
        "axis of symmetry, Ky across. The compliance model is the hinge at its limit angle, the "
        "others are at rest; drift of the axis under a pure moment is at the limit angle. A solid "
        "model is <code>flexwright hinge --level continuum</code>.</caption><thead><tr>"
        "<th scope=\"col\">Hinge</th><th scope=\"col\">Model</th><th scope=\"col\" "
        "class=\"n\">Stiffness</th><th scope=\"col\" class=\"n\">Kx</th><th scope=\"col\" "
        "class=\"n\">Ky</th><th scope=\"col\" class=\"n\">Elastic centre x, y (\u00b5m)</th>"
        "<th scope=\"col\" class=\"n\">Peak strain per rad</th><th scope=\"col\" class=\"n\">Limit "
        "(\u00b0)</th><th scope=\"col\" class=\"n\">Drift</th></tr></thead><tbody>\n");
    for (int i = 0; i < in->nhinge; i++)
        rows(out, &in->hinge[i]);
    fw_text_add(out, "</tbody></table></div>\n<div class=\"wide\">");
    FW_TRY(fw_report_hinges_picture(in->device, in->hinge, in->nhinge, out));
    fw_text_add(out, "</div>\n");
    return fw_text_end(out);
}
