/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How near what moves comes to what it may meet: a table, and a picture of each pair where it is
   nearest. */
#include "base/constants.h"
#include "report/report.h"
#include "report/report_page.h"
#include <math.h>

enum { PICTURE = 360, PICTURES = 6 };

/* the smallest window that shows the place: some times the distance, at least 120 um */
static fw_geometry_box window_of(const fw_clearance_least *l) {
    double half = fmax(120e-6, 3 * l->m);
    double x = 0.5 * (l->at.at_a.x + l->at.at_b.x), y = 0.5 * (l->at.at_a.y + l->at.at_b.y);
    return (fw_geometry_box){x - half, y - half, x + half, y + half};
}

/* outlines of one of the two where it is then */
static fw_status solid(fw_report_page *page, const fw_verdict_variant_verdict *v,
                       const fw_clearance_least *l, int which, const fw_report_view *view) {
    const fw_layout *layout = page->in->verdict->layout;
    const int body = which ? l->b : l->a;
    const char *const ink = which ? "#0072B2" : "#D55E00", *const fill =
                                                               which ? "#d6e6f2" : "#f8e0d2";
    fw_geometry_pose move = {0, 0, 0};
    if (body != FW_GROUND) {
        const fw_clearance_solid *s = &v->things->solid[body];
        const fw_clearance_pose p = l->pose[which];
        double turn = p.phi_rad - s->turned_rad, c = cos(turn), n = sin(turn);
        move = (fw_geometry_pose){p.x_m - (c * s->centre.x - n * s->centre.y),
                                  p.y_m - (n * s->centre.x + c * s->centre.y), turn};
    }
    fw_svg_path(page->out, "fill='{r}' stroke='{r}' stroke-width='1.2'", fill, ink);
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        bool fixed = p->body == FW_GROUND || p->body == FW_ISLAND;
        bool wall =
            p->role == FW_ROLE_STRUCTURE || p->role == FW_ROLE_FRAME || p->role == FW_ROLE_TETHER;
        if (!wall || (body == FW_GROUND ? !fixed : p->body != body)) continue;
        fw_geometry_contour moved;
        FW_TRY(fw_geometry_contour_transform(page->arena, &p->contour, move, false, &moved));
        fw_report_path(page->out, view, &moved);
    }
    fw_svg_path_end(page->out);
    return FW_OK;
}

static fw_status picture(fw_report_page *page, const fw_verdict_variant_verdict *v,
                         const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    const fw_report_view view = fw_report_view_fit(window_of(l), PICTURE, 0);
    double x0 = fw_report_x(&view, l->at.at_a.x), y0 = fw_report_y(&view, l->at.at_a.y);
    double x1 = fw_report_x(&view, l->at.at_b.x), y1 = fw_report_y(&view, l->at.at_b.y);
    fw_markup(page->out, "<figure class=\"pair\">\n");
    fw_svg_begin_picture(page->out, view.width, view.height, false);
    fw_svg_title(page->out, "{s} and {s} where they are nearest in {s}", l->at.a, l->at.b,
                 c->scene);
    fw_svg_paper(page->out, "#fff");
    for (int which = 0; which < 2; which++)
        FW_TRY(solid(page, v, l, which, &view));
    fw_svg_put(page->out, "path d='M{c} {c}L{c} {c}' stroke='#1f2328' stroke-width='1.5'", x0, y0,
               x1, y1);
    fw_svg_put(page->out,
               "circle cx='{c}' cy='{c}' r='9' fill='none' stroke='#1f2328' stroke-width='1.5'",
               0.5 * (x0 + x1), 0.5 * (y0 + y1));
    fw_report_scale_bar_svg(page->out, &view);
    fw_svg_end(page->out);
    fw_markup(page->out, "<figcaption>{s} (orange) and {s} (blue) in {s}", l->at.a, l->at.b,
              c->scene);
    if (c->box == FW_NONE)
        fw_markup(page->out, " at {h}", l->t_s);
    else
        fw_markup(page->out, ", the platform at ({u}, {u}, {d})", l->platform[0], "m",
                  l->platform[1], "m", l->platform[2]);
    fw_markup(page->out, ": {r}</figcaption></figure>\n",
              l->m <= 0 ? "they meet in the circle" : "the line is their distance as drawn");
    return FW_OK;
}

static void row(fw_text *out, const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    fw_markup(out, "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{s}, {s}</td>", c->scene,
              c->flow ? c->flow : "", l->at.a, l->at.b);
    if (l->m <= 0)
        fw_markup(out, "<td>they meet</td><td></td>");
    else
        fw_markup(out, "<td>{u}</td><td>{u} to {u}</td>", c->m, "m", c->low_m, "m", c->high_m, "m");
    if (c->required_m > 0)
        fw_markup(out, "<td>{u}</td>", c->required_m, "m");
    else
        fw_markup(out, "<td>apart</td>");
    if (c->box == FW_NONE)
        fw_markup(out, "<td>{h}</td>", l->t_s);
    else
        fw_markup(out, "<td></td>");
    fw_markup(out, "<td>({u}, {u})</td><td>{s}</td></tr>\n", l->at.at_a.x, "m", l->at.at_a.y, "m",
              fw_verdict_decision_text(c->decision));
}

fw_status fw_report_section_clearance(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    int n = 0, shown = 0;
    for (int i = 0; i < v->nvariant; i++)
        n += v->variant[i].nclearance;
    if (n == 0) {
        fw_markup(page->out, "<p>Nothing that is drawn moves against anything else.</p>\n");
        return FW_OK;
    }
    fw_markup(page->out,
              "<table><caption>The least distance of everything that moves from what it may meet, "
              "over the whole motion, between its samples too, and over every required pose. "
              "Range: what is proved, less and more what the motion may be off by. Halves of "
              "hinges: <a href=\"#hinges\">hinges</a>.</caption>\n<thead><tr>"
              "<th>Scene</th><th>Flow</th><th>Pair</th><th>Least</th><th>Range</th>"
              "<th>Asked for</th><th>At</th><th>Place</th><th>Verdict</th></tr></thead><tbody>\n");
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nclearance; k++)
            row(page->out, &v->variant[i].clearance[k]);
    fw_markup(page->out, "</tbody></table>\n<div class=\"pairs\">\n");
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; v->layout && k < v->variant[i].nclearance && shown < PICTURES; k++, shown++)
            FW_TRY(picture(page, &v->variant[i], &v->variant[i].clearance[k]));
    fw_markup(page->out, "</div>\n");
    return FW_OK;
}
