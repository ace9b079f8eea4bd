/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A figure of the program as PDF, for a paper: the drawing operators of a page for the elements that our
   pictures have. In: SVG as this program writes it (paths of lines and arcs, rectangles, circles, lines, polylines,
   lettering, groups and pictures within it with translate, rotate and scale, classes of one style sheet). What moves is
   drawn as it stands at the beginning. Out: PDF 1.4, one page, a pixel three quarters of a point; the same bytes for the same
   figure, with no date and no name of a machine. Lettering is Helvetica and Symbol, which every reader has, with
   their own widths; arcs are curves of third order of at most 90 degrees, right to 3e-4 of the radius. FW_INPUT:
   an element or a letter that this does not know, named in *unknown. Test: tests/cli/test_manners.py, figures. */
#include "base/constants.h"
#include "report/report_page.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEEP = 64, MOST_STATES = 64, DASHES = 8 };

typedef struct paint {
    bool drawn;
    unsigned rgb;
} paint;

typedef struct style {
    paint fill, stroke;
    double width, fill_opacity, stroke_opacity, opacity, size, dash[DASHES];
    int ndash, anchor; /* -1 start, 0 middle, 1 end */
    bool bold, hidden, even_odd, round;
} style;

typedef struct tag {                    /* of an element, in the text of the figure */
    const char *name, *attribute, *end; /* end: '>' or "/>" */
    size_t length;
    bool closes, empty;
} tag;

typedef struct converter {
    fw_arena *arena;
    const char *svg, *rules; /* rules: of the style sheet; NULL */
    fw_text *out;            /* the page's operators */
    style stack[DEEP];
    bool saved[DEEP]; /* the graphics state was, for a transform */
    int depth;
    double box[DEEP]
              [4]; /* of the picture that an element is in, for what is stated in per cent of it */
    double x, y;   /* of lettering, behind what was shown last */
    double state[MOST_STATES][2];
    int nstate;
    const char **unknown;
} converter;

/* ---- reading ---- */

static bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

static tag tag_at(const char *s) {
    tag t = {.closes = s[1] == '/'};
    t.name = s + (t.closes ? 2 : 1);
    t.length = strcspn(t.name, " \n\t/>");
    t.attribute = t.name + t.length;
    for (t.end = t.attribute; *t.end && *t.end != '>'; t.end += *t.end != '\0')
        if (*t.end == '"') t.end += strcspn(t.end + 1, "\"") + 1;
    t.empty = *t.end && t.end[-1] == '/';
    return t;
}

static bool is_named(const tag *t, const char *name) {
    return strlen(name) == t->length && memcmp(t->name, name, t->length) == 0;
}

/* the value of an attribute, n bytes of it; NULL: it has none */
static const char *value_of(const tag *t, const char *name, size_t *n) {
    const size_t length = strlen(name);
    for (const char *s = t->attribute; s < t->end;) {
        while (s < t->end && (is_space(*s) || *s == '/'))
            s++;
        const size_t own = strcspn(s, "=/> \n");
        if (s[own] != '=' || s[own + 1] != '"') break;
        const char *value = s + own + 2;
        *n = strcspn(value, "\"");
        if (own == length && memcmp(s, name, own) == 0) return value;
        s = value + *n + 1;
    }
    return NULL;
}

static double number_of(const tag *t, const char *name, double usual) {
    size_t n;
    const char *v = value_of(t, name, &n);
    return v ? strtod(v, NULL) : usual;
}

static bool says(const char *v, size_t n, const char *word) {
    return strlen(word) == n && memcmp(v, word, n) == 0;
}

static paint paint_of(const char *v, size_t n, paint usual) {
    if (says(v, n, "none")) return (paint){false, 0};
    if (*v != '#') return says(v, n, "white") ? (paint){true, 0xffffff} : usual;
    unsigned long c = strtoul(v + 1, NULL, 16);
    if (n == 4) c = (c >> 8 & 15) * 0x110000 + (c >> 4 & 15) * 0x1100 + (c & 15) * 0x11;
    return (paint){true, (unsigned)c};
}

static void set(style *s, const char *name, size_t length, const char *v, size_t n) {
    if (says(name, length, "fill")) s->fill = paint_of(v, n, s->fill);
    if (says(name, length, "stroke")) s->stroke = paint_of(v, n, s->stroke);
    if (says(name, length, "stroke-width")) s->width = strtod(v, NULL);
    if (says(name, length, "fill-opacity")) s->fill_opacity = strtod(v, NULL);
    if (says(name, length, "stroke-opacity")) s->stroke_opacity = strtod(v, NULL);
    if (says(name, length, "opacity")) s->opacity *= strtod(v, NULL);
    if (says(name, length, "font-size")) s->size = strtod(v, NULL);
    if (says(name, length, "font-weight")) s->bold = says(v, n, "bold") || (*v >= '6' && *v <= '9');
    if (says(name, length, "font")) { /* "bold 11px Helvetica" */
        s->bold = n > 4 && memcmp(v, "bold", 4) == 0;
        s->size = strtod(v + (s->bold ? 5 : 0), NULL);
    }
    if (says(name, length, "text-anchor"))
        s->anchor = says(v, n, "middle") ? 0 : says(v, n, "end") ? 1 : -1;
    if (says(name, length, "visibility")) s->hidden = says(v, n, "hidden");
    if (says(name, length, "display") && says(v, n, "none")) s->hidden = true;
    if (says(name, length, "fill-rule")) s->even_odd = says(v, n, "evenodd");
    if (says(name, length, "stroke-linecap")) s->round = says(v, n, "round");
    if (!says(name, length, "stroke-dasharray")) return;
    s->ndash = 0;
    for (char *next; s->ndash < DASHES; v = next + (*next == ',')) {
        const double d = strtod(v, &next);
        if (next == v) break;
        s->dash[s->ndash++] = d;
    }
}

/* does a selector of the style sheet, an element or a class, mean this one? */
static bool selects(const char *selector, size_t n, const tag *t) {
    size_t k;
    if (n > 0 && *selector != '.') return n == t->length && memcmp(selector, t->name, n) == 0;
    const char *list = value_of(t, "class", &k);
    for (const char *s = list; list && s < list + k;) {
        const size_t own = strcspn(s, " \"");
        if (own == n - 1 && memcmp(s, selector + 1, own) == 0) return true;
        s += own + 1;
    }
    return false;
}

static void declarations(style *s, const char *from, const char *until) {
    while (from < until) {
        const size_t name = strcspn(from, ":;}\""), all = strcspn(from, ";}\"");
        const char *v = from + name + 1;
        while (is_space(*v))
            v++;
        if (name < all) set(s, from, name, v, (size_t)(from + all - v));
        from += all + 1;
    }
}

static void apply_rules(const converter *c, const tag *t, style *s) {
    for (const char *r = c->rules; r && *r && *r != '<';) {
        const char *body = r + strcspn(r, "{<");
        if (*body != '{') return;
        const char *end = body + strcspn(body, "}");
        for (const char *one = r; one < body;) {
            while (is_space(*one) || *one == ',')
                one++;
            const size_t n = strcspn(one, ",{ ");
            if (selects(one, n, t)) declarations(s, body + 1, end);
            one += n + 1;
        }
        r = end + (*end == '}');
        while (is_space(*r))
            r++;
    }
}

static style style_of(const converter *c, const tag *t, const style *around) {
    static const char *const name[] = {"fill",           "stroke",           "stroke-width",
                                       "fill-opacity",   "stroke-opacity",   "opacity",
                                       "font-size",      "font-weight",      "text-anchor",
                                       "visibility",     "stroke-dasharray", "fill-rule",
                                       "stroke-linecap", "display"};
    style s = *around;
    size_t n;
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        const char *v = value_of(t, name[i], &n);
        if (v) set(&s, name[i], strlen(name[i]), v, n);
    }
    apply_rules(c, t, &s);
    const char *own = value_of(t, "style", &n);
    if (own) declarations(&s, own, own + n);
    return s;
}

/* ---- writing ---- */

static void number(fw_text *out, double v) {
    fw_text_fixed(out, v, 6);
    fw_text_add(out, " ");
}

static void numbers(fw_text *out, const double *v, int n, const char *operator) {
    for (int i = 0; i < n; i++)
        number(out, v[i]);
    fw_text_printf(out, "%s\n", operator);
}

static void colour(fw_text *out, unsigned rgb, const char *operator) {
    const double v[3] = {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0};
    numbers(out, v, 3, operator);
}

static void states(converter *c, const style *s) {
    const double fill = s->opacity * s->fill_opacity, stroke = s->opacity * s->stroke_opacity;
    int i = 0;
    while (i < c->nstate && !(c->state[i][0] == fill && c->state[i][1] == stroke))
        i++;
    if (i == MOST_STATES) i = 0;
    if (i == c->nstate) c->nstate++;
    c->state[i][0] = fill, c->state[i][1] = stroke;
    fw_text_printf(c->out, "/G%d gs\n", i);
    if (s->fill.drawn) colour(c->out, s->fill.rgb, "rg");
    if (!s->stroke.drawn) return;
    colour(c->out, s->stroke.rgb, "RG");
    numbers(c->out, &s->width, 1, "w");
    fw_text_printf(c->out, "%d J\n[", s->round);
    for (int k = 0; k < s->ndash; k++)
        number(c->out, s->dash[k]);
    fw_text_add(c->out, "] 0 d\n");
}

static void finish(converter *c, const style *s) {
    const bool fill = s->fill.drawn, stroke = s->stroke.drawn && s->width > 0;
    fw_text_printf(c->out, "%s%s\n",
                   fill && stroke ? "B"
                   : fill         ? "f"
                   : stroke       ? "S"
                                  : "n",
                   fill && s->even_odd ? "*" : "");
}

static void curve(fw_text *out, double x, double y, double r, double from, double to) {
    const int parts = (int)ceil(fabs(to - from) / (0.5 * FW_PI) - 1e-9);
    const double step = parts > 0 ? (to - from) / parts : 0, k = 4.0 / 3.0 * tan(0.25 * step);
    for (int i = 0; i < parts; i++) {
        const double a = from + i * step, b = a + step;
        const double v[6] = {x + r * (cos(a) - k * sin(a)),
                             y + r * (sin(a) + k * cos(a)),
                             x + r * (cos(b) + k * sin(b)),
                             y + r * (sin(b) - k * cos(b)),
                             x + r * cos(b),
                             y + r * sin(b)};
        numbers(out, v, 6, "c");
    }
}

/* of a circle, as paths have it */
static void arc_to(fw_text *out, const double p[2], double r, bool large, bool sweep,
                   const double q[2]) {
    const double dx = q[0] - p[0], dy = q[1] - p[1], d = hypot(dx, dy);
    r = fmax(r, 0.5 * d);
    const double high = sqrt(fmax(r * r - 0.25 * d * d, 0)) * (large == sweep ? -1 : 1);
    if (!(d > 0)) return;
    const double x = 0.5 * (p[0] + q[0]) - high * dy / d, y = 0.5 * (p[1] + q[1]) + high * dx / d;
    const double from = atan2(p[1] - y, p[0] - x);
    double to = atan2(q[1] - y, q[0] - x);
    if (sweep && to < from) to += FW_TURN;
    if (!sweep && to > from) to -= FW_TURN;
    curve(out, x, y, r, from, to);
}

/* false: a command that none of our figures has */
static bool path(fw_text *out, const char *d, const char *end) {
    double at[2] = {0, 0}, first[2] = {0, 0}, v[7];
    for (char way = 0; d < end;) {
        while (d < end && (is_space(*d) || *d == ','))
            d++;
        if (d >= end) return true;
        if (strchr("MmLlHhVvAaZz", *d)) way = *d++;
        const bool relative = way >= 'a';
        const char upper = relative ? (char)(way - 32) : way;
        if (upper == 'Z') {
            fw_text_add(out, "h\n");
            at[0] = first[0], at[1] = first[1], way = 0;
            continue;
        }
        const int n = upper == 'A' ? 7 : upper == 'M' || upper == 'L' ? 2 : upper ? 1 : 0;
        for (int i = 0; i < n; i++) {
            char *next;
            while (is_space(*d) || *d == ',')
                d++;
            v[i] = strtod(d, &next);
            if (next == d || next > end) return false;
            d = next;
        }
        if (n == 0) return false;
        const double dx = relative ? at[0] : 0, dy = relative ? at[1] : 0;
        const double to[2] = {upper == 'V' ? at[0] : v[n > 2 ? 5 : 0] + dx,
                              upper == 'H' ? at[1] : v[n > 2 ? 6 : n - 1] + dy};
        if (upper == 'A')
            arc_to(out, at, v[0], v[3] != 0, v[4] != 0, to);
        else
            numbers(out, to, 2, upper == 'M' ? "m" : "l");
        at[0] = to[0], at[1] = to[1];
        if (upper == 'M') first[0] = at[0], first[1] = at[1], way = relative ? 'l' : 'L';
    }
    return true;
}

/* ---- lettering ---- */

/* the next letter of a text up to `end`; entities are what they stand for */
static unsigned next_letter(const char **at) {
    static const struct {
        const char *name;
        char is;
    } entity[] = {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
    for (size_t i = 0; **at == '&' && i < sizeof entity / sizeof entity[0]; i++) {
        const size_t n = strlen(entity[i].name);
        if (strncmp(*at, entity[i].name, n) != 0) continue;
        *at += n;
        return (unsigned char)entity[i].is;
    }
    return fw_text_character(at);
}

static fw_status show_once(converter *c, const char *from, const char *end, const style *s,
                           double x, int mode) {
    int font = 0;
    fw_text_printf(c->out, "BT %d Tr 1 0 0 -1 ", mode);
    number(c->out, x);
    numbers(c->out, &c->y, 1, "Tm");
    while (from < end) {
        fw_report_letter l;
        if (!fw_report_letter_of(next_letter(&from), s->bold, &l)) return FW_INPUT;
        if (l.font != font) {
            fw_text_printf(c->out, "%s/F%d ", font ? "> Tj\n" : "", l.font);
            number(c->out, s->size);
            fw_text_add(c->out, "Tf <");
        }
        font = l.font;
        fw_text_printf(c->out, "%02x", l.code);
    }
    fw_text_add(c->out, font ? "> Tj ET\n" : "ET\n");
    return FW_OK;
}

/* width of lettering up to `end`; false: a letter is not known */
static bool width_of(converter *c, const char *from, const char *end, const style *s,
                     double *wide) {
    while (from < end) {
        const char *one = from;
        fw_report_letter l;
        if (!fw_report_letter_of(next_letter(&from), s->bold, &l)) {
            *c->unknown = fw_text_shown(c->arena, one, (size_t)(from - one));
            return false;
        }
        *wide += l.width * s->size;
    }
    return true;
}

/* of all runs of an element of lettering, up to one that has a place of its own; `at` behind its first tag */
static bool width_of_all(converter *c, const char *at, const style *s, double *wide) {
    const style *now = s;
    style inner;
    size_t n;
    for (int deep = 0; *at; at++) {
        const char *end = at + strcspn(at, "<");
        if (!width_of(c, at, end, now, wide)) return false;
        if (!*end) return true;
        const tag t = tag_at(end);
        if (!*t.end) return true;
        if (t.closes ? deep-- == 0 : value_of(&t, "x", &n) != NULL) return true;
        deep += !t.closes && !t.empty;
        inner = t.closes ? *s : style_of(c, &t, s);
        now = t.closes ? s : &inner;
        at = t.end;
    }
    return true;
}

static fw_status show(converter *c, const char *from, const char *end) {
    const style *s = &c->stack[c->depth];
    double wide = 0;
    if (from >= end || s->hidden) return FW_OK;
    if (!width_of(c, from, end, s, &wide)) return FW_INPUT;
    states(c, s);
    if (s->stroke.drawn && s->width > 0) FW_TRY(show_once(c, from, end, s, c->x, 1));
    if (s->fill.drawn) FW_TRY(show_once(c, from, end, s, c->x, 0));
    c->x += wide;
    return FW_OK;
}

/* ---- elements ---- */

static void transform(converter *c, const char *v, const char *end) {
    while (v < end) {
        double n[6] = {0}, m[6] = {1, 0, 0, 1, 0, 0};
        int count = 0;
        const char *word = v;
        v += strcspn(v, "(\"");
        if (*v++ != '(') return;
        for (char *next; count < 6 && v < end; v = next + strspn(next, ", ")) {
            n[count] = strtod(v, &next);
            if (next == v) break;
            count++;
        }
        v += strcspn(v, ")\"");
        if (*v++ != ')') return;
        v += strspn(v, " ,");
        if (strncmp(word, "translate", 9) == 0) m[4] = n[0], m[5] = n[1];
        if (strncmp(word, "scale", 5) == 0) m[0] = n[0], m[3] = count > 1 ? n[1] : n[0];
        if (strncmp(word, "matrix", 6) == 0) memcpy(m, n, sizeof m);
        if (strncmp(word, "rotate", 6) == 0) {
            const double a = n[0] * FW_PI / 180, co = cos(a), si = sin(a);
            m[0] = co, m[1] = si, m[2] = -si, m[3] = co;
            m[4] = n[1] - co * n[1] + si * n[2], m[5] = n[2] - si * n[1] - co * n[2];
        }
        numbers(c->out, m, 6, "cm");
    }
}

/* a picture within the picture: its place, cut off at its edges */
static void inner(converter *c, const tag *t) {
    size_t n;
    char *next;
    const char *box = value_of(t, "viewBox", &n);
    const double x = number_of(t, "x", 0), y = number_of(t, "y", 0);
    double b[4] = {0, 0, number_of(t, "width", 0), number_of(t, "height", 0)};
    const double wide = b[2], high = b[3];
    for (int i = 0; box && i < 4; i++, box = next)
        b[i] = strtod(box, &next);
    const double k = b[2] > 0 && b[3] > 0 ? fmin(wide / b[2], high / b[3]) : 1;
    const double m[6] = {
        k, 0, 0, k, x + 0.5 * (wide - k * b[2]) - k * b[0], y + 0.5 * (high - k * b[3]) - k * b[1]};
    numbers(c->out, m, 6, "cm");
    numbers(c->out, b, 4, "re W n");
    memcpy(c->box[c->depth], b, sizeof b);
}

static bool shape(converter *c, const tag *t, const style *s) {
    size_t n;
    double v[4] = {number_of(t, "x", 0), number_of(t, "y", 0), number_of(t, "width", 0),
                   number_of(t, "height", 0)};
    const char *wide = value_of(t, "width", &n);
    if (wide && n > 0 && wide[n - 1] == '%') memcpy(v, c->box[c->depth], sizeof v); /* all of it */
    states(c, s);
    if (is_named(t, "rect")) {
        numbers(c->out, v, 4, "re");
    } else if (is_named(t, "circle")) {
        const double x = number_of(t, "cx", 0), y = number_of(t, "cy", 0), r = number_of(t, "r", 0),
                     from[2] = {x + r, y};
        numbers(c->out, from, 2, "m");
        curve(c->out, x, y, r, 0, FW_TURN);
    } else if (is_named(t, "line")) {
        const double a[2] = {number_of(t, "x1", 0), number_of(t, "y1", 0)},
                     b[2] = {number_of(t, "x2", 0), number_of(t, "y2", 0)};
        numbers(c->out, a, 2, "m");
        numbers(c->out, b, 2, "l");
    } else {
        const char *d = value_of(t, "d", &n);
        if (d && !path(c->out, d, d + n)) return false;
    }
    finish(c, s);
    return true;
}

/* what is behind an element that is not drawn */
static const char *skip(const char *s, const tag *t) {
    if (t->empty) return t->end + 1;
    for (; *s; s++)
        if (s[0] == '<' && s[1] == '/' && strncmp(s + 2, t->name, t->length) == 0)
            return s + strcspn(s, ">") + 1;
    return s;
}

static bool is_shape(const tag *t) {
    return is_named(t, "path") || is_named(t, "rect") || is_named(t, "circle") ||
           is_named(t, "line");
}

static bool is_group(const tag *t) {
    return is_named(t, "g") || is_named(t, "svg") || is_named(t, "text") || is_named(t, "tspan") ||
           is_named(t, "a");
}

static bool is_left_out(const tag *t) {
    return is_named(t, "title") || is_named(t, "desc") || is_named(t, "style") ||
           is_named(t, "script") || is_named(t, "animate") || is_named(t, "animateTransform") ||
           is_named(t, "set") || is_named(t, "?xml") || is_named(t, "metadata");
}

static void leave(converter *c) {
    if (c->saved[c->depth]) fw_text_add(c->out, "Q\n");
    c->depth--;
}

/* false: it has a letter that is not known */
static bool enter(converter *c, const tag *t, const style *s) {
    size_t n;
    const char *v = value_of(t, "transform", &n);
    const bool within = is_named(t, "svg") && c->depth > 0;
    c->stack[++c->depth] = *s;
    memcpy(c->box[c->depth], c->box[c->depth - 1], sizeof c->box[0]);
    c->saved[c->depth] = v || within;
    if (v || within) fw_text_add(c->out, "q\n");
    if (v) transform(c, v, v + n);
    if (within) inner(c, t);
    if (!is_named(t, "text") && !is_named(t, "tspan")) return true;
    double wide = 0;
    v = value_of(t, "x", &n);
    c->y = number_of(t, "y", is_named(t, "text") ? 0 : c->y) + number_of(t, "dy", 0);
    if (!v && is_named(t, "tspan")) return true;
    if (s->anchor >= 0 && !t->empty && !width_of_all(c, t->end + 1, s, &wide)) return false;
    c->x = (v ? strtod(v, NULL) : 0) - (s->anchor + 1) * 0.5 * wide;
    return true;
}

static fw_status element(converter *c, const char **at) {
    const tag t = tag_at(*at);
    *at = *t.end ? t.end + 1 : t.end;
    if (t.closes) {
        if (c->depth > 0) leave(c);
        return FW_OK;
    }
    if (is_left_out(&t)) {
        *at = is_named(&t, "?xml") ? *at : skip(*at, &t);
        return FW_OK;
    }
    const style s = style_of(c, &t, &c->stack[c->depth]);
    *c->unknown = fw_text_shown(c->arena, t.name, t.length);
    if (c->depth + 2 >= DEEP || !(is_shape(&t) || is_group(&t))) return FW_INPUT;
    if (!enter(c, &t, &s)) return FW_INPUT;
    if (is_shape(&t) && !s.hidden && !shape(c, &t, &s)) return FW_INPUT;
    if (t.empty) leave(c);
    return FW_OK;
}

static bool in_text(const converter *c, const char *s) {
    while (s > c->svg && *--s != '>') {
    }
    while (s > c->svg && *s != '<')
        s--;
    const tag t = tag_at(s);
    return is_named(&t, "tspan") || (is_named(&t, "text") && !t.closes);
}

/* the first element of a name; NULL: there is none */
static const char *first_of(const char *s, const char *name) {
    while ((s = strchr(s, '<'))) {
        const tag t = tag_at(s);
        if (is_named(&t, name) && !t.closes) return s;
        s++;
    }
    return NULL;
}

fw_status fw_report_figure_pdf(fw_arena *arena, const char *svg, fw_text *pdf,
                               const char **unknown) {
    fw_text page = fw_text_new(arena);
    const char *start = first_of(svg, "svg"), *sheet = first_of(svg, "style");
    converter c = {.arena = arena, .svg = svg, .out = &page, .unknown = unknown};
    c.rules = sheet ? sheet + strcspn(sheet, ">") : NULL;
    if (c.rules && *c.rules) c.rules++;
    c.stack[0] = (style){.fill = {true, 0},
                         .width = 1,
                         .fill_opacity = 1,
                         .stroke_opacity = 1,
                         .opacity = 1,
                         .size = 16,
                         .anchor = -1};
    *unknown = NULL;
    if (!start) return FW_INPUT;
    const tag root = tag_at(start);
    double size[2] = {number_of(&root, "width", 0), number_of(&root, "height", 0)};
    size_t n;
    char *next;
    const char *box = value_of(&root, "viewBox", &n);
    double view[4] = {0, 0, size[0], size[1]};
    for (int i = 0; box && i < 4; i++, box = next)
        view[i] = strtod(box, &next);
    if (!(view[2] > 0 && view[3] > 0)) return FW_INPUT;
    memcpy(c.box[0], view, sizeof view);
    const double k = 0.75, wide = k * view[2], high = k * view[3];
    const double flip[6] = {k, 0, 0, -k, -k * view[0], high + k * view[1]};
    numbers(&page, flip, 6, "cm");
    for (const char *s = start; *s;) {
        if (*s == '<') {
            FW_TRY(element(&c, &s));
            continue;
        }
        const char *end = s + strcspn(s, "<");
        if (in_text(&c, s)) FW_TRY(show(&c, s, end));
        s = end;
    }
    FW_TRY(fw_text_end(&page));
    fw_report_pdf_file(&page, wide, high, (const double(*)[2])c.state, c.nstate, pdf);
    return fw_text_end(pdf);
}
