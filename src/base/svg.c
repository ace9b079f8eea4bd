/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/svg.h"
#include <math.h>
#include <string.h>

const char fw_svg_font_page[] = "system-ui,'DejaVu Sans',sans-serif";
const char fw_svg_font_sheet[] = "Helvetica, Arial, 'Liberation Sans', sans-serif";
const char fw_svg_font_step[] = "Helvetica, Arial, sans-serif";

/* ---- elements ---- */

/* of a template: bytes of its name, bytes up to its content or its end, and a newline behind it */
typedef struct shape {
    size_t name, tag, whole;
    bool line;
} shape;

static shape shape_of(const char *element) {
    shape s = {.name = strcspn(element, " >\n"), .whole = strlen(element)};
    s.line = s.whole > 0 && element[s.whole - 1] == '\n';
    if (s.line) s.whole--;
    s.tag = strcspn(element, ">");
    if (s.tag > s.whole) s.tag = s.whole;
    return s;
}

static void end_tag(fw_text *out, const char *name, size_t n) {
    fw_text_add(out, "</");
    fw_text_bytes(out, name, n);
    fw_text_add(out, ">");
}

static void start_tag(fw_text *out, const char *element, const shape *s, va_list *arguments) {
    fw_text_add(out, "<");
    fw_markup_part(out, element, s->tag, '"', arguments);
}

void fw_svg_put(fw_text *out, const char *element, ...) {
    shape s = shape_of(element);
    va_list arguments;
    va_start(arguments, element);
    start_tag(out, element, &s, &arguments);
    if (s.tag < s.whole) {
        fw_markup_part(out, element + s.tag, s.whole - s.tag, '\'', &arguments);
        end_tag(out, element, s.name);
    } else
        fw_text_add(out, "/>");
    if (s.line) fw_text_add(out, "\n");
    va_end(arguments);
}

void fw_svg_open(fw_text *out, const char *element, ...) {
    shape s = shape_of(element);
    va_list arguments;
    va_start(arguments, element);
    start_tag(out, element, &s, &arguments);
    fw_text_add(out, s.line ? ">\n" : ">");
    va_end(arguments);
}

void fw_svg_close(fw_text *out, const char *name) {
    shape s = shape_of(name);
    end_tag(out, name, s.name);
    if (s.line) fw_text_add(out, "\n");
}

void fw_svg_start(fw_text *out, const char *element, ...) {
    va_list arguments;
    va_start(arguments, element);
    fw_text_add(out, "<");
    fw_markup_part(out, element, strlen(element), '"', &arguments);
    fw_text_add(out, "=\"");
    va_end(arguments);
}

void fw_svg_finish(fw_text *out, const char *end) {
    fw_text_add(out, "\"");
    fw_text_add(out, end);
}

/* ---- the document ---- */

static void attribute(fw_text *out, const char *name, double value, int decimals,
                      const char *unit) {
    fw_text_printf(out, " %s=\"", name);
    fw_text_fixed(out, value, decimals);
    fw_text_printf(out, "%s\"", unit);
}

static void sizes(fw_text *out, const fw_svg_frame *f) {
    bool mm = f->unit_mm > 0.0;
    double factor = mm ? f->unit_mm : 1.0;
    int decimals = mm ? f->mm_decimals : f->decimals;
    attribute(out, "width", factor * f->width, decimals, mm ? "mm" : "");
    attribute(out, "height", factor * f->height, decimals, mm ? "mm" : "");
}

static void attributes(fw_text *out, const char *template) {
    if (!template) return;
    fw_text_add(out, " ");
    fw_markup_part(out, template, strlen(template), '"', NULL); /* no directives */
}

void fw_svg_begin(fw_text *out, const fw_svg_frame *f) {
    if (f->file) fw_text_add(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    fw_text_add(out, "<svg xmlns=\"http://www.w3.org/2000/svg\"");
    if (f->links) fw_text_add(out, " xmlns:xlink=\"http://www.w3.org/1999/xlink\"");
    attributes(out, f->lead);
    if (f->size == FW_SVG_SIZE_BEFORE) sizes(out, f);
    fw_text_add(out, " viewBox=\"0 0 ");
    fw_text_fixed(out, f->width, f->decimals);
    fw_text_add(out, " ");
    fw_text_fixed(out, f->height, f->decimals);
    fw_text_add(out, "\"");
    if (f->size == FW_SVG_SIZE_BEHIND) sizes(out, f);
    attributes(out, f->trail);
    if (f->font) fw_text_printf(out, " font-family=\"%s\"", f->font);
    if (f->font_size > 0.0) attribute(out, "font-size", f->font_size, f->decimals, "");
    fw_text_add(out, ">\n");
}

void fw_svg_begin_picture(fw_text *out, double width, double height, bool file) {
    fw_svg_begin(out, &(fw_svg_frame){.width = width,
                                      .height = height,
                                      .decimals = 2,
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .file = file,
                                      .lead = "role='img'",
                                      .font = fw_svg_font_page});
}

void fw_svg_title(fw_text *out, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fw_text_add(out, "<title>");
    fw_markup_part(out, format, strlen(format), '\'', &arguments);
    fw_text_add(out, "</title>\n");
    va_end(arguments);
}

void fw_svg_paper(fw_text *out, const char *colour) {
    fw_svg_put(out, "rect width='100%' height='100%' fill='{r}'\n", colour);
}

void fw_svg_end(fw_text *out) {
    fw_text_add(out, "</svg>\n");
}

void fw_svg_inset(fw_text *out, const char *attributes, ...) {
    va_list arguments;
    va_start(arguments, attributes);
    fw_text_add(out, "<svg ");
    fw_markup_part(out, attributes, strlen(attributes), '"', &arguments);
    fw_text_add(out, ">\n");
    va_end(arguments);
}

/* ---- paths ---- */

void fw_svg_path(fw_text *out, const char *attributes, ...) {
    va_list arguments;
    va_start(arguments, attributes);
    fw_text_add(out, "<path ");
    fw_markup_part(out, attributes, strlen(attributes), '"', &arguments);
    fw_text_add(out, *attributes ? " d=\"" : "d=\"");
    va_end(arguments);
}

void fw_svg_path_end(fw_text *out) {
    fw_text_add(out, "\"/>\n");
}

void fw_svg_more(fw_text *out, const char *attributes, ...) {
    size_t n = strlen(attributes);
    if (n == 0) return;
    va_list arguments;
    va_start(arguments, attributes);
    fw_text_add(out, "\" ");
    fw_markup_part(out, attributes, n - 1, '"', &arguments); /* without its last quote */
    va_end(arguments);
}

void fw_svg_point(fw_text *out, char command, double x, double y, int decimals) {
    fw_text_bytes(out, &command, 1);
    fw_text_fixed(out, x, decimals);
    fw_text_add(out, " ");
    fw_text_fixed(out, y, decimals);
}

/* ---- motion ---- */

void fw_svg_animate_path(fw_text *out, int seconds) {
    fw_svg_start(out, "animate attributeName='d' dur='{i}s' repeatCount='indefinite' values",
                 seconds);
}

void fw_svg_animate_group(fw_text *out, const char *transform, int seconds) {
    fw_svg_start(out,
                 "animateTransform attributeName='transform' type='{r}' dur='{i}s' "
                 "repeatCount='indefinite' values",
                 transform, seconds);
}

/* ---- scales ---- */

double fw_svg_nice(double x) {
    if (!isfinite(x) || x <= 0.0) return 1.0;
    double power = pow(10.0, floor(log10(x)));
    static const double step[] = {1.0, 2.0, 5.0, 10.0};
    for (int i = 0; i < 4; i++)
        if (x <= step[i] * power * (1.0 + 1e-9)) return step[i] * power;
    return 10.0 * power;
}

static int decimals_of(double step) {
    int n = 0;
    for (; n < 12 && step < 0.999; n++)
        step *= 10.0;
    return n;
}

void fw_svg_tick(fw_text *out, double value, double step) {
    bool zero = fabs(value) < 1e-9 * step; /* k steps from zero, in floating point */
    if (value < 0.0 && !zero) fw_text_add(out, "\u2212");
    fw_text_fixed(out, zero ? 0.0 : fabs(value), decimals_of(step));
}

double fw_svg_axes_x(const fw_svg_axes *a, double x) {
    return a->left + (a->right - a->left) * (x - a->x0) / (a->x1 - a->x0);
}

double fw_svg_axes_y(const fw_svg_axes *a, double y) {
    return a->bottom - (a->bottom - a->top) * (y - a->y0) / (a->y1 - a->y0);
}

static void tick_at(fw_text *out, double x, double y, const char *anchor, double value,
                    double step) {
    fw_svg_open(out, "text x='{c}' y='{c}' text-anchor='{r}'", x, y, anchor);
    fw_svg_tick(out, value, step);
    fw_svg_close(out, "text");
}

static const char *grid_ink(double k) {
    return fabs(k) < 0.5 ? "#8c959f" : "#eaeef2";
}

void fw_svg_grid(fw_text *out, const fw_svg_axes *a) {
    double sx = fw_svg_nice((a->x1 - a->x0) / a->columns);
    double sy = fw_svg_nice((a->y1 - a->y0) / a->rows);
    for (double k = ceil(a->y0 / sy); k * sy <= a->y1; k += 1.0) {
        double y = fw_svg_axes_y(a, k * sy);
        fw_svg_put(out, "path d='M{c} {c}H{c}' stroke='{r}'", a->left, y, a->right, grid_ink(k));
        tick_at(out, a->left - 7.0, y + 4.0, "end", k * sy, sy);
    }
    for (double k = ceil(a->x0 / sx); k * sx <= a->x1; k += 1.0) {
        double x = fw_svg_axes_x(a, k * sx);
        fw_svg_put(out, "path d='M{c} {c}V{c}' stroke='{r}'", x, a->top, a->bottom, grid_ink(k));
        tick_at(out, x, a->bottom + 16.0, "middle", k * sx, sx);
    }
}
