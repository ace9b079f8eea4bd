/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer map as a table: one line per place, for wafer probers, spreadsheets and whoever picks
   dies. x and y are of the die's middle from the wafer's centre. */
#include "wafer/wafer.h"
#include "base/svg.h"
#include <math.h>
#include <string.h>

static void csv_heading(const fw_wafer *w, fw_text *out) {
    const fw_device_wafer_asked *asked = &w->device->wafer;
    fw_text_add(out, "die,row,column,x_mm,y_mm,kind,variant");
    for (int k = 0; k < asked->nsweep; k++) {
        const fw_device_sweep *s = &asked->sweep[k];
        fw_text_printf(out, ",%s", w->device->parameter[s->parameter].name);
        if (*s->unit) fw_text_printf(out, " [%s]", s->unit);
    }
    fw_text_add(out, ",verdict,utilisation,note\n");
}

/* what the die is, which need not be what its step asked for */
static fw_status variant(const fw_wafer *w, const fw_wafer_site *s, fw_text *out) {
    int sweeps = w->device->wafer.nsweep;
    if (s->variant < 0) {
        for (int k = 0; k < sweeps + 4; k++)
            fw_text_add(out, ",");
        return FW_OK;
    }
    const fw_wafer_variant *asked = &w->variant[s->variant];
    const fw_wafer_variant *is = fw_wafer_stood_in(asked) ? &w->stand_in : asked;
    fw_text_printf(out, ",%d", s->variant + 1);
    for (int k = 0; k < sweeps; k++) {
        fw_text_add(out, ",");
        fw_text_number(out, fw_wafer_value(w, is, k), 9);
    }
    fw_text_printf(out, ",%s,", is->decision ? is->decision : "");
    if (isfinite(is->utilisation)) fw_text_number(out, is->utilisation, 6);
    fw_text_add(out, ",");
    if (is == asked) return FW_OK;
    const char *values = fw_wafer_values(out->arena, w, asked);
    FW_NEED(values);
    const char *note = fw_arena_printf(out->arena, "nominal die in place of %s", values);
    FW_NEED(note);
    fw_text_csv(out, note);
    return FW_OK;
}

fw_status fw_wafer_write_csv(const fw_wafer *w, fw_text *out) {
    const fw_wafer_grid *g = &w->grid;
    fw_text_reserve(out, 4096 + 96 * (size_t)g->nsite);
    csv_heading(w, out);
    for (int i = 0; i < g->nsite; i++) {
        const fw_wafer_site *s = &g->site[i];
        char name[2 * FW_WAFER_NAME], row[FW_WAFER_NAME];
        fw_text_printf(out, "%s,%s,%d,", fw_wafer_site_name(w, s, name),
                       fw_wafer_row_name(s->row, row), s->column + 1);
        fw_text_fixed(out, 1e-6 * (s->x + 0.5 * g->width), 7);
        fw_text_add(out, ",");
        fw_text_fixed(out, 1e-6 * (s->y + 0.5 * g->height), 7);
        fw_text_printf(out, ",%s", fw_wafer_kind_text(s->kind));
        FW_TRY(variant(w, s, out));
        fw_text_add(out, "\n");
    }
    return fw_text_end(out);
}

/* The wafer map as a picture: rim with flat or notch, edge exclusion, dies coloured by variant with
   their ids, and a legend. 1 user unit = 1 mm; made for people, so rounded to 1 um. */

static const double MARGIN = 6, LEGEND = 88, LINE = 4.2; /* of a wafer of 100 mm */

typedef struct picture {
    const fw_wafer *w;
    fw_text *out;
    double x, y, r; /* mm: centre and radius of the wafer */
    double k;       /* size of lettering and of all that is beside the wafer */
} picture;

/* lightness rises evenly, so that steps keep their order in grey too and for all eyes; between
   points of the viridis map (Smith and van der Walt 2015, CC0) */
static void colour(int i, int n, char text[8]) {
    static const double stop[][3] = {{68, 1, 84},    {65, 68, 135},  {42, 120, 142},
                                     {34, 168, 132}, {122, 209, 81}, {253, 231, 37}};
    double t = n > 1 ? 5.0 * i / (n - 1) : 3, whole = fmin(floor(t), 4);
    static const char digit[] = "0123456789abcdef";
    text[0] = '#';
    for (int k = 0; k < 3; k++) {
        double v =
            stop[(int)whole][k] + (t - whole) * (stop[(int)whole + 1][k] - stop[(int)whole][k]);
        int byte = (int)floor(v + 0.5);
        text[1 + 2 * k] = digit[byte / 16];
        text[2 + 2 * k] = digit[byte % 16];
    }
    text[7] = '\0';
}

static bool dark(int i, int n) {
    return n > 1 ? i < 0.55 * (n - 1) : false;
}

/* circle of radius r about the centre with a chord at `chord` from it, on the flat's side */
static void rim(const picture *p, double r, double chord, const char *style) {
    if (chord >= r) {
        fw_svg_put(p->out, "circle cx='{3}' cy='{3}' r='{3}' {r}\n", p->x, p->y, r, style);
        return;
    }
    /* from one end of the chord the long way round to the other, in screen coordinates */
    double half = sqrt(r * r - chord * chord);
    static const double turn[4][2] = {{0, 1}, {0, -1}, {-1, 0}, {1, 0}}; /* outward, y down */
    const double *u = turn[p->w->form.side];
    fw_svg_put(p->out, "path d='M{3} {3}A{3} {3} 0 1 1 {3} {3}Z' {r}\n",
               p->x + u[0] * chord - u[1] * half, p->y + u[1] * chord + u[0] * half, r, r,
               p->x + u[0] * chord + u[1] * half, p->y + u[1] * chord - u[0] * half, style);
}

static void notch(const picture *p) {
    const fw_wafer_form *f = &p->w->form;
    if (f->notch_m == 0) return;
    static const double turn[4][2] = {{0, 1}, {0, -1}, {-1, 0}, {1, 0}};
    const double *u = turn[f->side];
    double x = p->x + u[0] * p->r, y = p->y + u[1] * p->r, d = f->notch_m * 1e3;
    fw_svg_put(p->out,
               "path d='M{3} {3}L{3} {3}L{3} {3}' fill='#ffffff' stroke='#404040' "
               "stroke-width='0.2'\n",
               x - u[1] * d, y + u[0] * d, x - u[0] * d, y - u[1] * d, x + u[1] * d, y - u[0] * d);
}

static void cross(const picture *p, double x, double y, double a) {
    fw_svg_put(p->out, "path stroke='#000000' stroke-width='{3}' d='M{3} {3}h{3}M{3} {3}v{3}'\n",
               0.25 * p->k, x - a, y, 2 * a, x, y - a, 2 * a);
}

static void box(const picture *p, double x, double y, double w, double h, const char *fill,
                bool stood_in) {
    fw_svg_put(p->out, "rect x='{3}' y='{3}' width='{3}' height='{3}' fill='{r}'{r}\n", x, y, w, h,
               fill, stood_in ? " stroke=\"#c00000\" stroke-dasharray=\"0.6 0.4\"" : "");
}

static void site(const picture *p, const fw_wafer_site *s) {
    const fw_wafer_grid *g = &p->w->grid;
    double w = g->width * 1e-6, h = g->height * 1e-6, least = fmin(w, h);
    double x = p->x + s->x * 1e-6, y = p->y - s->y * 1e-6 - h;
    char fill[8] = "#ffffff", name[2 * FW_WAFER_NAME];
    const fw_wafer_variant *v = s->variant >= 0 ? &p->w->variant[s->variant] : NULL;
    if (v) colour(s->variant, p->w->nvariant, fill);
    box(p, x, y, w, h, s->kind == FW_WAFER_TEST ? "#c8c8c8" : fill, v && fw_wafer_stood_in(v));
    if (s->kind == FW_WAFER_ALIGNMENT) cross(p, x + 0.5 * w, y + 0.5 * h, 0.35 * least);
    if (s->kind == FW_WAFER_ALIGNMENT) return;
    bool light = v && dark(s->variant, p->w->nvariant);
    fw_svg_put(p->out, "text x='{3}' y='{3}' font-size='{3}' fill='{r}'>{r}\n", x + 0.5 * w,
               y + 0.5 * h + 0.12 * fmin(w, h * 2.2), 0.36 * fmin(w, 2.2 * h),
               light ? "#ffffff" : "#000000", fw_wafer_site_name(p->w, s, name));
}

/* ---- legend ---- */

static void line(const picture *p, double x, double *y, const char *text) {
    fw_svg_put(p->out, "text x='{3}' y='{3}'>{s}\n", x, *y, text);
    *y += LINE * p->k;
}

static fw_status facts(const picture *p, double x, double *y) {
    const fw_wafer *w = p->w;
    fw_arena *a = p->out->arena;
    char n[6][32];
    const double mm[] = {w->form.diameter_m,   w->form.plate_m,       w->form.edge_m,
                         w->grid.width * 1e-9, w->grid.height * 1e-9, w->form.flat_m};
    for (int i = 0; i < 6; i++)
        fw_number_text(n[i], sizeof n[i], mm[i] * 1e3, 6);
    char px[32], py[32];
    fw_number_text(px, sizeof px, w->grid.pitch_x * 1e-6, 6);
    fw_number_text(py, sizeof py, w->grid.pitch_y * 1e-6, 6);
    const char *text[] = {
        fw_arena_printf(a, "flow %s", w->flow),
        fw_arena_printf(a, "wafer %s mm, %s%s%s", n[0],
                        w->form.flat_m > 0    ? "flat "
                        : w->form.notch_m > 0 ? "notch"
                                              : "no flat",
                        w->form.flat_m > 0 ? n[5] : "", w->form.flat_m > 0 ? " mm" : ""),
        fw_arena_printf(a, "edge exclusion %s mm, plate %s mm", n[2], n[1]),
        fw_arena_printf(a, "die %s mm x %s mm", n[3], n[4]),
        fw_arena_printf(a, "pitch %s mm x %s mm", px, py),
        fw_arena_printf(a, "%d dies, %d alignment, %d test", w->dies, w->alignments, w->tests)};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        FW_NEED(text[i]);
        line(p, x, y, text[i]);
    }
    return FW_OK;
}

/* what the legend says of each step */
static fw_status variant_texts(const fw_wafer *w, fw_arena *a, const char ***out) {
    const char **text = fw_arena_array(a, const char *, (size_t)w->nvariant);
    FW_NEED(text);
    for (int v = 0; v < w->nvariant; v++) {
        const fw_wafer_variant *u = &w->variant[v];
        char used[32];
        const char *values = fw_wafer_values(a, w, u), *number = "";
        FW_NEED(values);
        if (w->nvariant > 1) FW_NEED(number = fw_arena_printf(a, "%d  ", v + 1));
        fw_percent_text(used, sizeof used, u->utilisation);
        FW_NEED(text[v] = fw_arena_printf(
                    a, "%s%s%s%d dies, %s%s%s%s", number, values, *values ? ": " : "", u->dies,
                    u->decision ? u->decision : "not judged", isfinite(u->utilisation) ? ", " : "",
                    isfinite(u->utilisation) ? used : "",
                    isfinite(u->utilisation) ? " % of limit" : ""));
    }
    *out = text;
    return FW_OK;
}

static void variants(const picture *p, const char *const *text, double x, double *y) {
    const fw_wafer *w = p->w;
    const double k = p->k;
    *y += 0.5 * LINE * k;
    for (int v = 0; v < w->nvariant; v++) {
        const bool stood_in = fw_wafer_stood_in(&w->variant[v]);
        char fill[8];
        colour(v, w->nvariant, fill);
        box(p, x, *y - 0.62 * LINE * k, 3 * k, 3 * k, fill, stood_in);
        line(p, x + 4.6 * k, y, text[v]);
        if (stood_in) line(p, x + 4.6 * k, y, "nominal dies instead (dashed)");
    }
    if (w->alignments > 0) {
        cross(p, x + 1.5 * k, *y - 0.28 * LINE * k, 1.5 * k);
        line(p, x + 4.6 * k, y, "alignment site");
    }
    if (w->tests > 0) {
        box(p, x, *y - 0.62 * LINE * k, 3 * k, 3 * k, "#c8c8c8", false);
        line(p, x + 4.6 * k, y, "test die");
    }
}

static int legend_lines(const fw_wafer *w) {
    int n = 12 + w->nvariant;
    for (int v = 0; v < w->nvariant; v++)
        n += fw_wafer_stood_in(&w->variant[v]);
    return n;
}

fw_status fw_wafer_write_map(const fw_wafer *w, fw_text *out) {
    double r = 0.5e3 * w->form.diameter_m, k = r / 50, margin = MARGIN * k;
    const char **text;
    FW_TRY(variant_texts(w, out->arena, &text));
    size_t longest = 0;
    for (int v = 0; v < w->nvariant; v++)
        longest = strlen(text[v]) > longest ? strlen(text[v]) : longest;
    k *= fmin(1, fmax(0.5, 100.0 / (LINE * legend_lines(w)))); /* many steps: smaller letters */
    double width =
        2 * r + 3 * margin +
        k * fmax(LEGEND, fmax(6 + 1.65 * (double)longest, 2.5 * (double)strlen(w->title)));
    double height = fmax(2 * r + 2 * margin, margin + LINE * k * legend_lines(w));
    picture p = {w, out, margin + r, margin + r, r, k};
    fw_text_reserve(out, 8192 + 256 * (size_t)w->grid.nsite);
    fw_svg_begin(out, &(fw_svg_frame){.width = width,
                                      .height = height,
                                      .decimals = 3,
                                      .file = true,
                                      .lead = "version='1.1'",
                                      .font = "sans-serif",
                                      .font_size = 3 * k});
    fw_svg_title(out, "{s}: wafer map", w->title);
    fw_svg_paper(out, "#ffffff");
    double chord = sqrt(r * r - 0.25e6 * w->form.flat_m * w->form.flat_m);
    rim(&p, r, w->form.flat_m > 0 ? chord : r,
        "fill=\"#f0f0f0\" stroke=\"#404040\" stroke-width=\"0.3\"");
    notch(&p);
    double inner = r - w->form.edge_m * 1e3;
    rim(&p, inner, w->form.flat_m > 0 ? chord - w->form.edge_m * 1e3 : inner,
        "fill=\"none\" stroke=\"#c00000\" stroke-width=\"0.2\" stroke-dasharray=\"1.5 1\"");
    fw_svg_open(out, "g text-anchor='middle' stroke-width='0.15'\n");
    for (int i = 0; i < w->grid.nsite; i++)
        site(&p, &w->grid.site[i]);
    fw_svg_close(out, "g\n");
    double x = 2 * r + 2 * margin, y = margin + LINE * k;
    fw_svg_open(out, "g font-size='{3}' font-weight='bold'\n", 4 * k);
    line(&p, x, &y, w->title);
    if (w->rejected) line(&p, x, &y, "REJECTED");
    fw_svg_close(out, "g\n");
    FW_TRY(facts(&p, x, &y));
    fw_svg_open(out, "g stroke-width='0.3'\n");
    variants(&p, text, x, &y);
    fw_svg_close(out, "g\n");
    fw_svg_end(out);
    return fw_text_end(out);
}
