/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A figure of the program as PDF, for a paper: the drawing operators of a page for the elements that our
   pictures have. In: SVG as this program writes it (paths, rectangles, circles, ellipses, lines, polylines, polygons,
   lettering, groups, pictures within it, what `use` repeats; translate, rotate, scale and matrix; classes of one style
   sheet; clip paths of one outline). What moves is drawn as it stands at the beginning. Out: PDF 1.4, one page; the same
   bytes for the same figure, with no date and no name of a machine. A pixel is three quarters of a point and a millimetre a millimetre,
   but what would be less than an inch is enlarged by a power of ten. What is repeated is written once for each style
   that it takes (a form of the file). Lettering is Helvetica and Symbol, which every reader has, with
   their own widths; arcs are curves of third order of at most 90 degrees, right to 3e-4 of the radius. FW_INPUT:
   an element or a letter that this does not know, named in *unknown. Test: tests/cli/test_manners.py, figures. */
#include "base/constants.h"
#include "report/report_page.h"
#include "xml/xml.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEEP = 64, DASHES = 8 };
enum { MOST_ELEMENTS = 5000000 }; /* that a form repeats is counted once */

typedef struct paint {
    bool drawn;
    unsigned rgb;
} paint;

typedef struct style {
    paint fill, stroke;
    double width, fill_opacity, stroke_opacity, opacity, size, dash[DASHES];
    int ndash, anchor; /* -1 start, 0 middle, 1 end */
    int cap, join;     /* as PDF counts them */
    bool bold, hidden, even_odd;
    const char *clip,
        *unknown; /* of the element alone, not of what is in it: NULL, or what follows the name */
} style;

typedef struct repeated { /* what `use` draws, in one style */
    const fw_xml_node *node;
    style style;
} repeated;

typedef struct converter {
    fw_arena *arena;
    const fw_xml_node *root;
    const char *rules; /* of the style sheet; NULL */
    fw_report_pdf pdf;
    fw_text *out;  /* the operators of the page, or of the form that is being written */
    repeated *use; /* (pdf.nform, of room for nroom) */
    int nroom, nstate_room;
    int depth;
    long elements;
    double box[4]; /* of the picture that an element is in, for what is stated in per cent of it */
    double x, y;   /* of lettering, behind what was shown last */
    bool blank;    /* a blank is due before what lettering follows */
    const char **unknown;
} converter;

/* ---- reading ---- */

static bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

static bool is_named(const fw_xml_node *n, const char *name) {
    return n->name && strcmp(n->name, name) == 0;
}

static bool is_one_of(const fw_xml_node *n, const char *const *name) {
    for (; *name; name++)
        if (is_named(n, *name)) return true;
    return false;
}

static double number_of(const fw_xml_node *n, const char *name, double usual) {
    const char *v = fw_xml_node_value(n, name);
    return v ? strtod(v, NULL) : usual;
}

/* the first element of a name, or with an id, of a tree; NULL: there is none */
static const fw_xml_node *found_in(const fw_xml_node *root, const char *name, const char *id) {
    for (const fw_xml_node *n = root; n;) {
        const char *own = id ? fw_xml_node_value(n, "id") : NULL;
        if (n->name && (id ? own && strcmp(own, id) == 0 : is_named(n, name))) return n;
        if (n->first) {
            n = n->first;
            continue;
        }
        while (n && !n->next)
            n = n == root ? NULL : n->parent;
        n = n ? n->next : NULL;
    }
    return NULL;
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
    if (says(name, length, "clip-path")) s->clip = says(v, n, "none") ? NULL : v;
    if (says(name, length, "mask") && !says(v, n, "none")) s->unknown = "mask";
    if (says(name, length, "filter") && !says(v, n, "none")) s->unknown = "filter";
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
    if (says(name, length, "stroke-linecap"))
        s->cap = says(v, n, "round") ? 1 : says(v, n, "square") ? 2 : 0;
    if (says(name, length, "stroke-linejoin"))
        s->join = says(v, n, "round") ? 1 : says(v, n, "bevel") ? 2 : 0;
    if (!says(name, length, "stroke-dasharray")) return;
    s->ndash = 0;
    for (char *next; s->ndash < DASHES; v = next + (*next == ',')) {
        const double d = strtod(v, &next);
        if (next == v) break;
        s->dash[s->ndash++] = d;
    }
}

/* does a selector of the style sheet, an element or a class, mean this one? */
static bool selects(const char *selector, size_t n, const fw_xml_node *node) {
    if (n > 0 && *selector != '.') return says(selector, n, node->name);
    const char *list = fw_xml_node_value(node, "class");
    for (const char *s = list; s && *s;) {
        const size_t own = strcspn(s, " ");
        if (own == n - 1 && memcmp(s, selector + 1, own) == 0) return true;
        s += own + (s[own] == ' ');
    }
    return false;
}

static void declarations(style *s, const char *from, const char *until) {
    while (from < until) {
        const size_t name = strcspn(from, ":;}"), all = strcspn(from, ";}");
        const char *v = from + name + 1;
        while (is_space(*v))
            v++;
        if (name < all) set(s, from, name, v, (size_t)(from + all - v));
        from += all + 1;
        while (from < until && is_space(*from))
            from++;
    }
}

static void apply_rules(const converter *c, const fw_xml_node *node, style *s) {
    for (const char *r = c->rules; r && *r;) {
        const char *body = r + strcspn(r, "{");
        if (!*body) return;
        const char *end = body + strcspn(body, "}");
        for (const char *one = r; one < body;) {
            while (is_space(*one) || *one == ',')
                one++;
            const size_t n = strcspn(one, ",{ \n");
            if (selects(one, n, node)) declarations(s, body + 1, end);
            one += n + 1;
        }
        r = end + (*end == '}');
        while (is_space(*r))
            r++;
    }
}

static style style_of(const converter *c, const fw_xml_node *node, const style *around) {
    static const char *const name[] = {
        "fill",           "stroke",          "stroke-width",     "fill-opacity",
        "stroke-opacity", "opacity",         "font-size",        "font-weight",
        "text-anchor",    "visibility",      "stroke-dasharray", "fill-rule",
        "stroke-linecap", "stroke-linejoin", "display",          "clip-path",
        "mask",           "filter"};
    style s = *around;
    s.clip = s.unknown = NULL;
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        const char *v = fw_xml_node_value(node, name[i]);
        if (v) set(&s, name[i], strlen(name[i]), v, strlen(v));
    }
    apply_rules(c, node, &s);
    const char *own = fw_xml_node_value(node, "style");
    if (own) declarations(&s, own, own + strlen(own));
    return s;
}

/* ---- writing ---- */

static void colour(fw_text *out, unsigned rgb, const char *operator) {
    const double v[3] = {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0};
    fw_report_pdf_numbers(out, v, 3, operator);
}

/* which of the file's pairs of opacities this is */
static fw_status state_of(converter *c, double fill, double stroke, int *number) {
    fw_report_pdf *p = &c->pdf;
    int i = 0;
    while (i < p->nstate && !(p->state[i][0] == fill && p->state[i][1] == stroke))
        i++;
    *number = i;
    if (i < p->nstate) return FW_OK;
    if (i == c->nstate_room) {
        c->nstate_room = 2 * i + 16;
        p->state = fw_arena_grow(c->arena, p->state, (size_t)i, (size_t)c->nstate_room,
                                 sizeof p->state[0]);
        FW_NEED(p->state);
    }
    p->state[i][0] = fill, p->state[i][1] = stroke;
    p->nstate++;
    return FW_OK;
}

static fw_status states(converter *c, const style *s) {
    int i;
    FW_TRY(state_of(c, s->opacity * s->fill_opacity, s->opacity * s->stroke_opacity, &i));
    fw_text_printf(c->out, "/G%d gs\n", i);
    if (s->fill.drawn) colour(c->out, s->fill.rgb, "rg");
    if (!s->stroke.drawn) return FW_OK;
    colour(c->out, s->stroke.rgb, "RG");
    fw_report_pdf_numbers(c->out, &s->width, 1, "w");
    fw_text_printf(c->out, "%d J %d j\n[", s->cap, s->join);
    fw_report_pdf_numbers(c->out, s->dash, s->ndash, "] 0 d");
    return FW_OK;
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

/* ---- lettering ---- */

typedef struct
    run { /* of lettering: blanks are one, as SVG has them, and none stands at its beginning or end */
    const char *at;
    bool first, due; /* nothing was shown before; a blank is due */
} run;

/* the next letter; 0: the end */
static unsigned next_letter(run *r) {
    while (is_space(*r->at))
        r->due = !r->first, r->at++;
    if (!*r->at) return 0;
    if (r->due) {
        r->due = false;
        return ' ';
    }
    r->first = false;
    return fw_text_character(&r->at);
}

static void show_once(converter *c, const char *text, const style *s, bool first, int mode) {
    run r = {text, first, c->blank};
    int font = 0;
    bool raised = false;
    fw_report_letter l;
    fw_text_printf(c->out, "BT %d Tr 1 0 0 -1 ", mode);
    const double at[2] = {c->x, c->y};
    fw_report_pdf_numbers(c->out, at, 2, "Tm");
    for (unsigned u; (u = next_letter(&r)) != 0;) {
        fw_report_letter_of(u, s->bold, &l); /* they are known: width_of looked */
        if (l.font != font || l.raised != raised) {
            if (font) fw_text_add(c->out, "> Tj\n");
            if (l.raised != raised) {
                const double rise = l.raised ? FW_REPORT_PDF_RISE * s->size : 0;
                fw_report_pdf_numbers(c->out, &rise, 1, "Ts");
            }
            const double size = l.raised ? FW_REPORT_PDF_SMALL * s->size : s->size;
            fw_text_printf(c->out, "/F%d ", l.font);
            fw_report_pdf_numbers(c->out, &size, 1, "Tf");
            fw_text_add(c->out, "<");
        }
        font = l.font, raised = l.raised;
        fw_text_printf(c->out, "%02x", l.code);
    }
    fw_text_add(c->out, font ? "> Tj" : "");
    fw_text_add(c->out, raised ? " 0 Ts ET\n" : " ET\n");
}

/* adds the width of a text; false: a letter is not known */
static bool width_of(converter *c, run *r, const style *s, double *wide) {
    fw_report_letter l;
    for (;;) {
        const char *one = r->at;
        const unsigned u = next_letter(r);
        if (u == 0) return true;
        if (!fw_report_letter_of(u, s->bold, &l)) {
            while (is_space(*one))
                one++;
            *c->unknown = fw_text_shown(c->arena, one, (size_t)(r->at - one));
            return false;
        }
        *wide += l.width * s->size;
    }
}

static bool is_left_out(const fw_xml_node *n) {
    static const char *const name[] = {"title", "desc", "style",    "script",           "animate",
                                       "set",   "defs", "metadata", "animateTransform", "clipPath",
                                       NULL};
    return is_one_of(n, name);
}

/* of what an element of lettering holds, up to what has a place of its own; false: likewise */
static bool width_of_all(converter *c, const fw_xml_node *node, const style *s, run *r,
                         double *wide, bool *ended) {
    for (const fw_xml_node *n = node->first; n && !*ended; n = n->next) {
        if (!n->name) {
            r->at = n->text;
            if (!width_of(c, r, s, wide)) return false;
        } else if (!is_left_out(n)) {
            *ended = fw_xml_node_value(n, "x") != NULL;
            const style own = style_of(c, n, s);
            if (!*ended && !width_of_all(c, n, &own, r, wide, ended)) return false;
        }
    }
    return true;
}

static fw_status show(converter *c, const char *text, const style *s, bool *first) {
    double wide = 0;
    run r = {text, *first, c->blank};
    if (!width_of(c, &r, s, &wide)) return FW_INPUT;
    if (wide > 0 && !s->hidden) {
        FW_TRY(states(c, s));
        if (s->stroke.drawn && s->width > 0) show_once(c, text, s, *first, 1);
        if (s->fill.drawn) show_once(c, text, s, *first, 0);
    }
    *first = r.first, c->blank = r.due;
    c->x += wide;
    return FW_OK;
}

/* text, tspan and a: at places of their own or behind what was shown before */
static fw_status lettering(converter *c, const fw_xml_node *node, const style *s, bool *first) {
    const char *x = fw_xml_node_value(node, "x");
    const bool begins = is_named(node, "text");
    c->y = number_of(node, "y", begins ? 0 : c->y) + number_of(node, "dy", 0);
    c->x += number_of(node, "dx", 0);
    if (x || begins) {
        double wide = 0;
        bool ended = false;
        *first = true, c->blank = false;
        run r = {"", true, false};
        if (!width_of_all(c, node, s, &r, &wide, &ended)) return FW_INPUT;
        c->x = (x ? strtod(x, NULL) : 0) + number_of(node, "dx", 0) - (s->anchor + 1) * 0.5 * wide;
    }
    for (const fw_xml_node *n = node->first; n; n = n->next) {
        if (!n->name) {
            FW_TRY(show(c, n->text, s, first));
        } else if (is_named(n, "tspan") || is_named(n, "a")) {
            const style own = style_of(c, n, s);
            if (c->depth >= DEEP) return FW_INPUT;
            c->depth++;
            FW_TRY(lettering(c, n, &own, first));
            c->depth--;
        } else if (!is_left_out(n)) {
            *c->unknown = fw_text_shown(c->arena, n->name, strlen(n->name));
            return FW_INPUT;
        }
    }
    return FW_OK;
}

/* ---- elements ---- */

static const char *const shapes[] = {"path",    "rect",     "circle",  "line",
                                     "ellipse", "polyline", "polygon", NULL};

/* a picture within the picture: its place, cut off at its edges */
static void inner(converter *c, const fw_xml_node *n) {
    const char *box = fw_xml_node_value(n, "viewBox");
    const double x = number_of(n, "x", 0), y = number_of(n, "y", 0);
    double b[4] = {0, 0, number_of(n, "width", 0), number_of(n, "height", 0)};
    const double wide = b[2], high = b[3];
    fw_report_pdf_list(box, 4, b);
    const double k = b[2] > 0 && b[3] > 0 ? fmin(wide / b[2], high / b[3]) : 1;
    const double m[6] = {
        k, 0, 0, k, x + 0.5 * (wide - k * b[2]) - k * b[0], y + 0.5 * (high - k * b[3]) - k * b[1]};
    fw_report_pdf_matrix(c->out, m);
    fw_report_pdf_numbers(c->out, b, 4, "re W n");
    memcpy(c->box, b, sizeof b);
}

/* false: a value that is none of ours */
static bool outline(converter *c, const fw_xml_node *n) {
    double v[4] = {number_of(n, "x", 0), number_of(n, "y", 0), number_of(n, "width", 0),
                   number_of(n, "height", 0)};
    if (is_named(n, "rect")) {
        const char *wide = fw_xml_node_value(n, "width");
        if (wide && strchr(wide, '%')) memcpy(v, c->box, sizeof v); /* all of it */
        fw_report_pdf_rectangle(c->out, v, number_of(n, "rx", number_of(n, "ry", 0)),
                                number_of(n, "ry", number_of(n, "rx", 0)));
    } else if (is_named(n, "circle") || is_named(n, "ellipse")) {
        const double r = number_of(n, "r", 0);
        fw_report_pdf_ellipse(c->out, number_of(n, "cx", 0), number_of(n, "cy", 0),
                              number_of(n, "rx", r), number_of(n, "ry", r));
    } else if (is_named(n, "line")) {
        const double a[2] = {number_of(n, "x1", 0), number_of(n, "y1", 0)},
                     b[2] = {number_of(n, "x2", 0), number_of(n, "y2", 0)};
        fw_report_pdf_numbers(c->out, a, 2, "m");
        fw_report_pdf_numbers(c->out, b, 2, "l");
    } else {
        const bool path = is_named(n, "path");
        const char *d = fw_xml_node_value(n, path ? "d" : "points");
        return !d || (path ? fw_report_pdf_path(c->out, d)
                           : fw_report_pdf_points(c->out, d, is_named(n, "polygon")));
    }
    return true;
}

/* draws no more than what lies within the one outline of a clipPath; v: url(#ID) and what follows it */
static fw_status clip(converter *c, const char *v) {
    const char *id = strncmp(v, "url(#", 5) == 0 ? v + 5 : "";
    const char *named = fw_arena_printf(c->arena, "%.*s", (int)strcspn(id, ")"), id);
    FW_NEED(named);
    const fw_xml_node *by = *named ? found_in(c->root, NULL, named) : NULL;
    const char *units = by ? fw_xml_node_value(by, "clipPathUnits") : NULL;
    const fw_xml_node *only = NULL;
    *c->unknown = "clip-path";
    if (!by || !is_named(by, "clipPath") || (units && strcmp(units, "userSpaceOnUse") != 0))
        return FW_INPUT;
    for (const fw_xml_node *n = by->first; n; n = n->next) {
        if (!n->name || is_left_out(n)) continue;
        if (only || !is_one_of(n, shapes)) return FW_INPUT; /* a union is none of ours */
        only = n;
    }
    if (!only || fw_xml_node_value(only, "transform") || fw_xml_node_value(by, "transform"))
        return FW_INPUT;
    const char *rule = fw_xml_node_value(only, "clip-rule");
    if (!outline(c, only)) return FW_INPUT;
    fw_text_add(c->out, rule && strcmp(rule, "evenodd") == 0 ? "W* n\n" : "W n\n");
    return FW_OK;
}

static fw_status element(converter *c, const fw_xml_node *n, const style *around);

static fw_status inside(converter *c, const fw_xml_node *n, const style *s) {
    for (const fw_xml_node *child = n->first; child; child = child->next)
        if (child->name) FW_TRY(element(c, child, s));
    return FW_OK;
}

static bool same_paint(paint a, paint b) {
    return a.drawn == b.drawn && (!a.drawn || a.rgb == b.rgb);
}

static bool same_style(const style *a, const style *b) {
    bool same = same_paint(a->fill, b->fill) && same_paint(a->stroke, b->stroke) &&
                a->width == b->width && a->fill_opacity == b->fill_opacity &&
                a->stroke_opacity == b->stroke_opacity && a->opacity == b->opacity &&
                a->size == b->size && a->ndash == b->ndash && a->anchor == b->anchor &&
                a->cap == b->cap && a->join == b->join && a->bold == b->bold &&
                a->hidden == b->hidden && a->even_odd == b->even_odd;
    for (int i = 0; same && i < a->ndash; i++)
        same = a->dash[i] == b->dash[i];
    return same;
}

/* the number of the form that draws a node in a style; it is written where there is none yet */
static fw_status form_of(converter *c, const fw_xml_node *node, const style *s, int *number) {
    fw_report_pdf *p = &c->pdf;
    int i = 0;
    while (i < p->nform && !(c->use[i].node == node && same_style(&c->use[i].style, s)))
        i++;
    *number = i;
    if (i < p->nform) return FW_OK;
    fw_text form = fw_text_new(c->arena), *before = c->out;
    c->out = &form;
    const fw_status status = is_named(node, "symbol") ? inside(c, node, s) : element(c, node, s);
    c->out = before;
    FW_TRY(status);
    FW_TRY(fw_text_end(&form));
    if (p->nform == c->nroom) { /* what it repeats itself is in the list already */
        const size_t had = (size_t)p->nform, room = 2 * had + 16;
        FW_NEED(c->use = fw_arena_grow(c->arena, c->use, had, room, sizeof *c->use));
        FW_NEED(p->form = fw_arena_grow(c->arena, p->form, had, room, sizeof *p->form));
        c->nroom = (int)room;
    }
    *number = p->nform++;
    c->use[*number] = (repeated){node, *s};
    p->form[*number] = form;
    return FW_OK;
}

static fw_status again(converter *c, const fw_xml_node *n, const style *s) {
    const char *id = fw_xml_node_value(n, "href");
    const fw_xml_node *node = id && *id == '#' ? found_in(c->root, NULL, id + 1) : NULL;
    int number;
    if (!node) {
        *c->unknown = id ? fw_text_shown(c->arena, id, strlen(id)) : "use";
        return FW_INPUT;
    }
    const double m[6] = {1, 0, 0, 1, number_of(n, "x", 0), number_of(n, "y", 0)};
    fw_report_pdf_matrix(c->out, m);
    FW_TRY(form_of(c, node, s, &number));
    fw_text_printf(c->out, "/X%d Do\n", number);
    return FW_OK;
}

static fw_status element(converter *c, const fw_xml_node *n, const style *around) {
    static const char *const group[] = {"g", "svg", "a", NULL};
    const bool drawn = is_one_of(n, shapes), text = is_named(n, "text"), use = is_named(n, "use");
    if (is_left_out(n) || is_named(n, "symbol")) return FW_OK;
    *c->unknown = fw_text_shown(c->arena, n->name, strlen(n->name));
    if (!(drawn || text || use || is_one_of(n, group))) return FW_INPUT;
    if (c->depth >= DEEP || ++c->elements > MOST_ELEMENTS) return FW_INPUT;
    const style s = style_of(c, n, around);
    const char *moved = fw_xml_node_value(n, "transform");
    const bool within = is_named(n, "svg") && n != c->root,
               saved = moved || within || use || s.clip;
    if (s.unknown) {
        *c->unknown = s.unknown;
        return FW_INPUT;
    }
    double box[4];
    bool first = true;
    fw_status status = FW_OK;
    memcpy(box, c->box, sizeof box);
    c->depth++;
    if (saved) fw_text_add(c->out, "q\n");
    fw_report_pdf_transform(c->out, moved);
    if (s.clip) FW_TRY(clip(c, s.clip));
    if (within) inner(c, n);
    if (drawn && !s.hidden) {
        FW_TRY(states(c, &s));
        if (!outline(c, n)) return FW_INPUT;
        finish(c, &s);
    } else if (text) {
        status = lettering(c, n, &s, &first);
    } else if (use && !s.hidden) {
        status = again(c, n, &s);
    } else if (!drawn && !use) {
        status = inside(c, n, &s);
    }
    if (saved) fw_text_add(c->out, "Q\n");
    c->depth--;
    memcpy(c->box, box, sizeof box);
    return status;
}

fw_status fw_report_figure_pdf(fw_arena *arena, const char *svg, size_t n, fw_text *pdf,
                               const char **unknown, int *line) {
    fw_text page = fw_text_new(arena);
    fw_xml_node *tree;
    converter c = {.arena = arena, .out = &page, .unknown = unknown};
    const style usual = {.fill = {true, 0},
                         .width = 1,
                         .fill_opacity = 1,
                         .stroke_opacity = 1,
                         .opacity = 1,
                         .size = 16,
                         .anchor = -1};
    *unknown = NULL;
    FW_TRY(fw_xml_tree(arena, svg, n, &tree, line));
    if (!is_named(tree, "svg")) return FW_INPUT;
    c.root = tree;
    const fw_xml_node *sheet = found_in(tree, "style", NULL);
    c.rules = sheet && sheet->first ? sheet->first->text : NULL;
    const char *wide = fw_xml_node_value(tree, "width"), *high = fw_xml_node_value(tree, "height");
    double view[4] = {0, 0, wide ? strtod(wide, NULL) : 0, high ? strtod(high, NULL) : 0};
    fw_report_pdf_list(fw_xml_node_value(tree, "viewBox"), 4, view);
    if (!(view[2] > 0 && view[3] > 0)) return FW_INPUT;
    memcpy(c.box, view, sizeof view);
    const double points = wide && !strchr(wide, '%') ? fw_report_pdf_size(wide) : 0.75 * view[2];
    double k = points / view[2];
    if (!(k * view[2] > 1e-9 && k * view[3] > 1e-9 && k * (view[2] + view[3]) < 1e9))
        return FW_INPUT;
    while (k * fmax(view[2], view[3]) < 72)
        k *= 10;
    c.pdf = (fw_report_pdf){.page = &page, .wide = k * view[2], .high = k * view[3]};
    const double flip[6] = {k, 0, 0, -k, -k * view[0], c.pdf.high + k * view[1]};
    fw_report_pdf_matrix(&page, flip);
    FW_TRY(element(&c, tree, &usual));
    FW_TRY(fw_text_end(&page));
    fw_report_pdf_file(&c.pdf, pdf);
    return fw_text_end(pdf);
}
