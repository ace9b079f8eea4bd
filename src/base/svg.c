/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text from templates, numbers as people read them, and the elements of pictures that are made of both. */
#include "base/svg.h"
#include "base/constants.h"
#include <math.h>
#include <string.h>

/* ---- templates ---- */

/* "5.7e-05" as 5.7 times ten to a raised exponent */
static void scientific(fw_text *out, const char *number) {
    static const char *const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    const char *e = strchr(number, 'e');
    if (!e) {
        fw_text_add(out, number);
        return;
    }
    fw_text_bytes(out, number, (size_t)(e - number));
    fw_text_add(out, "\u00d710");
    e++;
    if (*e == '-') fw_text_add(out, "\u207b");
    for (e++; *e == '0' && e[1];)
        e++;
    for (; *e >= '0' && *e <= '9'; e++)
        fw_text_add(out, raised[*e - '0']);
}

/* fw_text_fixed drops the zeros at the end; here they are put back */
static void fixed_with_zeros(fw_text *out, double value, int decimals) {
    size_t before = out->length;
    fw_text_fixed(out, value, decimals);
    if (out->failed || decimals == 0) return;
    const char *point = strchr(out->data + before, '.');
    int have = point ? (int)strlen(point + 1) : 0;
    if (!point) fw_text_add(out, ".");
    for (; have < decimals; have++)
        fw_text_add(out, "0");
}

void fw_markup_number(fw_text *out, double value, int digits) {
    if (!isfinite(value)) {
        fw_text_add(out, "\u2013");
        return;
    }
    char text[64];
    fw_number_text(text, sizeof text, fabs(value), digits);
    if (value < 0.0) fw_text_add(out, "\u2212"); /* the true minus sign */
    scientific(out, text);
}

/* `digits` significant ones, zeros at the end kept, so that columns of results line up */
static void padded(fw_text *out, double value, int digits) {
    double size = fabs(value);
    if (!(size >= 1e-4 && size < 1e4)) {
        fw_markup_number(out, value, digits);
        return;
    }
    int decimals = digits - 1;
    for (double power = 10.0; decimals > 0 && size >= power * (1.0 - 0.5 * pow(10.0, -digits));)
        power *= 10.0, decimals--;
    for (double power = 1.0;
         decimals < digits + 3 && size < power * (1.0 - 0.5 * pow(10.0, -digits));)
        power /= 10.0, decimals++;
    if (value < 0.0) fw_text_add(out, "\u2212");
    fixed_with_zeros(out, size, decimals);
}

static void append_si(fw_text *out, double value, const char *unit, int digits) {
    static const struct {
        double factor;
        const char *prefix;
    } row[] = {{1e9, "G"},       {1e6, "M"},  {1e3, "k"},   {1.0, ""},   {1e-3, "m"},
               {1e-6, "\u00b5"}, {1e-9, "n"}, {1e-12, "p"}, {1e-15, "f"}};
    enum { ROWS = sizeof row / sizeof row[0], PLAIN = 3 };
    int i = PLAIN;
    double size = fabs(value);
    if (isfinite(value) && size > 0.0)
        for (i = 0; i < ROWS - 1 && size < 0.99995 * row[i].factor;)
            i++;
    fw_markup_number(out, value / row[i].factor, digits);
    if (size > 0.0 && (unit[0] || row[i].prefix[0])) {
        fw_text_add(out, "\u00a0"); /* number and unit stay on one line */
        fw_text_add(out, row[i].prefix);
        fw_text_escaped(out, unit);
    } /* a plain 0 needs no unit */
}

static void percent(fw_text *out, double ratio) {
    double value = 100.0 * ratio;
    if (!isfinite(value) || fabs(value) >= 1e6 || fabs(value) < 0.1)
        fw_markup_number(out, value, 3);
    else {
        if (value < 0.0) fw_text_add(out, "\u2212");
        double size = fabs(value);
        fixed_with_zeros(out, size, size < 9.995 ? 2 : size < 99.95 ? 1 : 0);
    }
    fw_text_add(out, "\u00a0%");
}

static void duration(fw_text *out, double seconds) {
    if (!isfinite(seconds) || fabs(seconds) < 60.0 || fabs(seconds) >= 3.6e9) {
        append_si(out, seconds, "s", 3);
        return;
    }
    long whole = lround(fabs(seconds));
    if (seconds < 0.0) fw_text_add(out, "\u2212");
    if (whole < 7200)
        fw_text_printf(out, "%ld\u00a0min", whole / 60);
    else
        fw_text_printf(out, "%ld\u00a0h", whole / 3600);
    long rest = whole < 7200 ? whole % 60 : whole % 3600 / 60;
    if (rest) fw_text_printf(out, " %ld\u00a0%s", rest, whole < 7200 ? "s" : "min");
}

static void coordinate(fw_text *out, double value, int decimals) {
    fw_text_fixed(out, isfinite(value) ? value : 0.0, decimals);
}

static void directive(fw_text *out, char kind, va_list *arguments) {
    switch (kind) {
    case 's': {
        const char *s = va_arg(*arguments, const char *);
        fw_text_escaped(out, s ? s : "");
        break;
    }
    case 'r': {
        const char *s = va_arg(*arguments, const char *);
        fw_text_add(out, s ? s : "");
        break;
    }
    case 'i':
        fw_text_printf(out, "%d", va_arg(*arguments, int));
        break;
    case 'l':
        fw_text_printf(out, "%ld", va_arg(*arguments, long));
        break;
    case 'c': {
        double value = va_arg(*arguments, double);
        /* what lies far outside every picture must not cost a line of digits */
        coordinate(out, isfinite(value) ? fmax(-1e6, fmin(1e6, value)) : 0.0, 2);
        break;
    }
    case '1':
    case '2':
    case '3':
    case '4':
    case '6':
    case '9':
        coordinate(out, va_arg(*arguments, double), kind - '0');
        break;
    case 'n':
        fw_markup_number(out, va_arg(*arguments, double), 4);
        break;
    case 'e':
        fw_markup_number(out, va_arg(*arguments, double), 2);
        break;
    case 'u': {
        double value = va_arg(*arguments, double);
        append_si(out, value, va_arg(*arguments, const char *), 4);
        break;
    }
    case 'd':
        fw_markup_number(out, va_arg(*arguments, double) * 180.0 / FW_PI, 4);
        fw_text_add(out, "\u00b0");
        break;
    case 'D':
        padded(out, va_arg(*arguments, double) * 180.0 / FW_PI, 4);
        break;
    case 'p':
        percent(out, va_arg(*arguments, double));
        break;
    case 'h':
        duration(out, va_arg(*arguments, double));
        break;
    default:
        out->failed = 1; /* a directive that does not exist: a mistake of the caller */
    }
}

void fw_markup_part(fw_text *out, const char *format, size_t n, char quote, va_list *arguments) {
    for (const char *at = format, *end = format + n; at < end;) {
        size_t plain = 0, left = (size_t)(end - at);
        while (plain < left && at[plain] != '{' && (at[plain] != '\'' || quote == '\''))
            plain++;
        fw_text_bytes(out, at, plain);
        at += plain;
        if (at == end) return;
        if (*at == '{' && end - at > 2 && at[2] == '}') {
            directive(out, at[1], arguments);
            at += 3;
            continue;
        }
        fw_text_bytes(out, *at == '{' ? at : &quote, 1);
        at++;
    }
}

void fw_markup(fw_text *out, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fw_markup_part(out, format, strlen(format), '\'', &arguments);
    va_end(arguments);
}

/* ---- elements of SVG ---- */

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

const char fw_svg_font_page[] = "system-ui,'DejaVu Sans',sans-serif";
const char fw_svg_font_sheet[] = "Helvetica, Arial, 'Liberation Sans', sans-serif";
const char fw_svg_font_step[] = "Helvetica, Arial, sans-serif";

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
    /* lines are counted: of a range of few last bits the next multiple of a step is the same number */
    for (int i = 0; i <= a->rows && a->rows > 0; i++) {
        const double k = ceil(a->y0 / sy) + i;
        if (k * sy > a->y1) break;
        double y = fw_svg_axes_y(a, k * sy);
        fw_svg_put(out, "path d='M{c} {c}H{c}' stroke='{r}'", a->left, y, a->right, grid_ink(k));
        tick_at(out, a->left - 7.0, y + 4.0, "end", k * sy, sy);
    }
    for (int i = 0; i <= a->columns && a->columns > 0; i++) {
        const double k = ceil(a->x0 / sx) + i;
        if (k * sx > a->x1) break;
        double x = fw_svg_axes_x(a, k * sx);
        fw_svg_put(out, "path d='M{c} {c}V{c}' stroke='{r}'", x, a->top, a->bottom, grid_ink(k));
        tick_at(out, x, a->bottom + 16.0, "middle", k * sx, sx);
    }
}
