/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a PDF is made of: the operators of outlines, the fonts that every reader has, with their letters and how wide
   they are, and the objects of the file. */
#include "base/constants.h"
#include "report/report_page.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- outlines ---- */

static void write_numbers(fw_text *out, const double *v, int n, int decimals,
                          const char *operator) {
    for (int i = 0; i < n; i++) {
        fw_text_fixed(out, isfinite(v[i]) ? v[i] : 0, decimals);
        fw_text_add(out, " ");
    }
    fw_text_printf(out, "%s\n", operator);
}

void fw_report_pdf_numbers(fw_text *out, const double *v, int n, const char *operator) {
    write_numbers(out, v, n, 6, operator);
}

void fw_report_pdf_matrix(fw_text *out, const double *m) {
    write_numbers(out, m, 6, 12, "cm"); /* of a plate in micrometres a step is 0.003 points */
}

/* behind what separates the numbers of a list */
static const char *behind_comma(const char *s) {
    return s + strspn(s, ", \n\t\r");
}

int fw_report_pdf_list(const char *s, int most, double *v) {
    int n = 0;
    for (char *next; s && n < most; s = next) {
        const double one = strtod(s = behind_comma(s), &next);
        if (next == s) break;
        v[n++] = one;
    }
    return n;
}

double fw_report_pdf_size(const char *size) {
    static const struct {
        const char *unit;
        double points;
    } known[] = {{"mm", 72 / 25.4}, {"cm", 72 / 2.54}, {"in", 72}, {"pt", 1}, {"", 0.75}};
    char *unit;
    const double v = strtod(size, &unit);
    size_t i = 0;
    while (*known[i].unit && strncmp(unit, known[i].unit, 2) != 0)
        i++;
    return v * known[i].points;
}

typedef struct ellipse { /* a turned and stretched circle of radius 1 */
    double x, y, rx, ry, co, si;
} ellipse;

static void on(const ellipse *e, double u, double v, double *to) {
    to[0] = e->x + e->co * e->rx * u - e->si * e->ry * v;
    to[1] = e->y + e->si * e->rx * u + e->co * e->ry * v;
}

static void curve(fw_text *out, const ellipse *e, double from, double to) {
    const int parts = (int)ceil(fabs(to - from) / (0.5 * FW_PI) - 1e-9);
    const double step = parts > 0 ? (to - from) / parts : 0, k = 4.0 / 3.0 * tan(0.25 * step);
    for (int i = 0; i < parts; i++) {
        const double a = from + i * step, b = a + step;
        double v[6];
        on(e, cos(a) - k * sin(a), sin(a) + k * cos(a), v);
        on(e, cos(b) + k * sin(b), sin(b) - k * cos(b), v + 2);
        on(e, cos(b), sin(b), v + 4);
        fw_report_pdf_numbers(out, v, 6, "c");
    }
}

/* a path's arc: v has both radii, the turn of the axes in degrees, large and sweep */
static void arc_to(fw_text *out, const double p[2], const double *v, const double q[2]) {
    const double turn = v[2] * FW_PI / 180;
    ellipse e = {0, 0, fabs(v[0]), fabs(v[1]), cos(turn), sin(turn)};
    if (!(e.rx > 0 && e.ry > 0)) { /* a line, as SVG has it */
        fw_report_pdf_numbers(out, q, 2, "l");
        return;
    }
    const double dx = q[0] - p[0], dy = q[1] - p[1];
    double u = (e.co * dx + e.si * dy) / e.rx, w = (e.co * dy - e.si * dx) / e.ry, d = hypot(u, w);
    if (!(d > 0)) return;
    if (d > 2) { /* the radii grow until they reach */
        e.rx *= 0.5 * d, e.ry *= 0.5 * d;
        u *= 2 / d, w *= 2 / d, d = 2;
    }
    const bool sweep = v[4] != 0;
    const double high = sqrt(fmax(1 - 0.25 * d * d, 0)) * ((v[3] != 0) == sweep ? -1 : 1) / d;
    const double cu = 0.5 * u - high * w, cw = 0.5 * w + high * u; /* centre, from p */
    double centre[2];
    e.x = p[0], e.y = p[1];
    on(&e, cu, cw, centre);
    e.x = centre[0], e.y = centre[1];
    const double from = atan2(-cw, -cu);
    double to = atan2(w - cw, u - cu);
    if (sweep && to < from) to += FW_TURN;
    if (!sweep && to > from) to -= FW_TURN;
    curve(out, &e, from, to);
}

void fw_report_pdf_ellipse(fw_text *out, double x, double y, double rx, double ry) {
    const ellipse e = {x, y, rx, ry, 1, 0};
    const double from[2] = {x + rx, y};
    fw_report_pdf_numbers(out, from, 2, "m");
    curve(out, &e, 0, FW_TURN);
    fw_text_add(out, "h\n");
}

void fw_report_pdf_rectangle(fw_text *out, const double *box, double rx, double ry) {
    rx = fmin(rx, 0.5 * box[2]), ry = fmin(ry, 0.5 * box[3]);
    if (!(rx > 0 && ry > 0)) {
        fw_report_pdf_numbers(out, box, 4, "re");
        return;
    }
    for (int i = 0; i < 4; i++) { /* round corners, the first one right above */
        const double a = (i - 1) * 0.5 * FW_PI;
        const bool left = i > 1, low = i == 1 || i == 2;
        const ellipse e = {left ? box[0] + rx : box[0] + box[2] - rx,
                           low ? box[1] + box[3] - ry : box[1] + ry,
                           rx,
                           ry,
                           1,
                           0};
        double from[2];
        on(&e, cos(a), sin(a), from);
        fw_report_pdf_numbers(out, from, 2, i == 0 ? "m" : "l");
        curve(out, &e, a, a + 0.5 * FW_PI);
    }
    fw_text_add(out, "h\n");
}

bool fw_report_pdf_points(fw_text *out, const char *s, bool closed) {
    double v[2];
    for (bool first = true; *(s = behind_comma(s)); first = false) {
        for (int i = 0; i < 2; i++) {
            char *next;
            v[i] = strtod(s = behind_comma(s), &next);
            if (next == s) return false;
            s = next;
        }
        fw_report_pdf_numbers(out, v, 2, first ? "m" : "l");
    }
    if (closed) fw_text_add(out, "h\n");
    return true;
}

/* numbers of a path's command, NULL behind its letter: it is none */
static int numbers_of(char upper) {
    static const char letters[] = "MLHVAZCSQT", counts[] = "2211706442";
    const char *at = upper ? strchr(letters, upper) : NULL;
    return at ? counts[at - letters] - '0' : -1;
}

typedef struct pen { /* of a path */
    double at[2], first[2], control[2];
    char before; /* the curve that `control` is of, 'C' or 'Q'; 0: none */
} pen;

/* the control points and the end of a curve, as one of third order */
static void bend(fw_text *out, pen *p, char upper, const double *v, const double *to) {
    const char order = upper == 'C' || upper == 'S' ? 'C' : 'Q';
    double b[6] = {v[0], v[1], v[2], v[3], to[0], to[1]};
    if (upper == 'S' || upper == 'T') { /* the first control point mirrors the last one */
        memcpy(b + 2, v, 2 * sizeof *v);
        for (int k = 0; k < 2; k++)
            b[k] = p->before == order ? 2 * p->at[k] - p->control[k] : p->at[k];
    }
    memcpy(p->control, order == 'C' ? b + 2 : b, sizeof p->control);
    for (int k = 0; order == 'Q' && k < 2; k++) {
        const double q = b[k];
        b[k] = (p->at[k] + 2 * q) / 3, b[k + 2] = (to[k] + 2 * q) / 3;
    }
    fw_report_pdf_numbers(out, b, 6, "c");
    p->before = order;
}

bool fw_report_pdf_path(fw_text *out, const char *d) {
    pen p = {.before = 0};
    double v[7];
    for (char way = 0; *(d = behind_comma(d));) {
        if (strchr("MmLlHhVvAaZzCcSsQqTt", *d)) way = *d++;
        const bool relative = way >= 'a';
        const char upper = relative ? (char)(way - 32) : way;
        const int n = numbers_of(upper);
        if (n < 0) return false;
        if (n == 0) {
            fw_text_add(out, "h\n");
            memcpy(p.at, p.first, sizeof p.at);
            p.before = way = 0;
            continue;
        }
        for (int i = 0; i < n; i++) {
            char *next;
            v[i] = strtod(d = behind_comma(d), &next);
            if (next == d) return false;
            d = next;
        }
        const bool across = upper == 'H', up = upper == 'V';
        for (int i = upper == 'A' ? 5 : 0; relative && i < n; i++)
            v[i] += p.at[up ? 1 : (i + (upper == 'A')) % 2];
        const double to[2] = {up ? p.at[0] : v[n > 1 ? n - 2 : 0], across ? p.at[1] : v[n - 1]};
        const bool bent = strchr("CSQT", upper) != NULL;
        if (bent)
            bend(out, &p, upper, v, to);
        else if (upper == 'A')
            arc_to(out, p.at, v, to);
        else
            fw_report_pdf_numbers(out, to, 2, upper == 'M' ? "m" : "l");
        memcpy(p.at, to, sizeof p.at);
        if (!bent) p.before = 0;
        if (upper == 'M') memcpy(p.first, to, sizeof to), way = relative ? 'l' : 'L';
    }
    return true;
}

void fw_report_pdf_transform(fw_text *out, const char *v) {
    while (v && *v) {
        double n[6] = {0}, m[6] = {1, 0, 0, 1, 0, 0};
        int count = 0;
        while (*v && strchr(" \n\t\r", *v))
            v++;
        const char *word = v;
        v += strcspn(v, "(");
        if (*v++ != '(') return;
        for (char *next; count < 6; v = next + strspn(next, ", ")) {
            n[count] = strtod(v, &next);
            if (next == v) break;
            count++;
        }
        v += strcspn(v, ")");
        if (*v++ != ')') return;
        v += strspn(v, " ,\n");
        if (strncmp(word, "translate", 9) == 0) m[4] = n[0], m[5] = n[1];
        if (strncmp(word, "scale", 5) == 0) m[0] = n[0], m[3] = count > 1 ? n[1] : n[0];
        if (strncmp(word, "matrix", 6) == 0) memcpy(m, n, sizeof m);
        if (strncmp(word, "rotate", 6) == 0) {
            const double a = n[0] * FW_PI / 180, co = cos(a), si = sin(a);
            m[0] = co, m[1] = si, m[2] = -si, m[3] = co;
            m[4] = n[1] - co * n[1] + si * n[2], m[5] = n[2] - si * n[1] - co * n[2];
        }
        fw_report_pdf_matrix(out, m);
    }
}

/* ---- letters ---- */

/* widths of Helvetica and its bold face from the blank to ~, in thousandths (Adobe's metrics of the base fonts) */
static const short width_of[2][95] = {
    {278,  278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
     556,  556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
     1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
     667,  778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
     333,  556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
     556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584},
    {278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278,
     556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 333, 333, 584, 584, 584, 611,
     975, 722, 722, 722, 722, 667, 611, 778, 722, 278, 556, 722, 611, 833, 722, 778,
     667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 333, 278, 333, 584, 556,
     333, 556, 611, 556, 611, 556, 333, 611, 611, 278, 278, 556, 278, 889, 611, 611,
     611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389, 280, 389, 584}};

static const struct {
    unsigned letter;
    unsigned char code;
    short width;
} symbol[] = {/* of the font Symbol */
              {0x2212, 0x2d, 549}, {0x2192, 0xae, 987}, {0x2190, 0xac, 987}, {0x2264, 0xa3, 549},
              {0x2265, 0xb3, 549}, {0x2248, 0xbb, 549}, {0x221e, 0xa5, 713}, {0x3b1, 0x61, 631},
              {0x3b2, 0x62, 549},  {0x3b5, 0x65, 439},  {0x3b8, 0x71, 521},  {0x3bc, 0x6d, 576},
              {0x3c0, 0x70, 549},  {0x3c3, 0x73, 603},  {0x3c6, 0x6a, 603},  {0x3c9, 0x77, 686},
              {0x3a9, 0x57, 768},  {0x394, 0x44, 612},  {0x3bb, 0x6c, 549},  {0x3b6, 0x7a, 494}};

/* a raised figure or sign of a power of ten, which the fonts have of 1, 2 and 3 alone; 0: it is none */
static unsigned raised_of(unsigned u) {
    if (u == 0x2070 || (u >= 0x2074 && u <= 0x2079)) return '0' + (u - 0x2070);
    return u == 0x207a   ? '+'
           : u == 0x207b ? 0x2212
           : u == 0xb9   ? '1'
           : u == 0xb2   ? '2'
           : u == 0xb3   ? '3'
                         : 0;
}

bool fw_report_letter_of(unsigned u, bool bold, fw_report_letter *l) {
    if (raised_of(u)) {
        fw_report_letter_of(raised_of(u), bold, l);
        l->raised = true, l->width *= FW_REPORT_PDF_SMALL;
        return true;
    }
    static const struct {
        unsigned letter;
        unsigned char code;
        short width;
    } typographic[] = {{0x2013, 0x96, 556}, {0x2014, 0x97, 1000}, {0x2026, 0x85, 1000},
                       {0x2019, 0x92, 222}, {0x2022, 0x95, 350},  {0x20ac, 0x80, 556}};
    *l = (fw_report_letter){.font = bold ? 2 : 1, .code = (unsigned char)u, .width = 0.556};
    if (u >= 32 && u < 127) l->width = width_of[bold][u - 32] / 1000.0;
    if (u == 0xa0 || u == 0xb7) l->width = 0.278;
    if (u == 0xb0) l->width = 0.4;
    if (u == 0xb1 || u == 0xd7) l->width = 0.584;
    if (u == 0x202f || u == 0x2009)
        *l = (fw_report_letter){.font = l->font, .code = ' ', .width = 0.278};
    if ((u >= 32 && u < 127) || (u >= 0xa0 && u < 0x100) || l->code == ' ') return true;
    for (size_t i = 0; i < sizeof typographic / sizeof typographic[0]; i++)
        if (typographic[i].letter == u) {
            *l = (fw_report_letter){.font = l->font,
                                    .code = typographic[i].code,
                                    .width = typographic[i].width / 1000.0};
            return true;
        }
    for (size_t i = 0; i < sizeof symbol / sizeof symbol[0]; i++)
        if (symbol[i].letter == u) {
            *l = (fw_report_letter){
                .font = 3, .code = symbol[i].code, .width = symbol[i].width / 1000.0};
            return true;
        }
    return false;
}

/* ---- the file: objects, where each begins, no date ---- */

typedef struct objects {
    fw_text *out, where; /* where: rows of the table of places */
    int count;
} objects;

static void begin(objects *o) {
    fw_text_printf(&o->where, "%010zu 00000 n \n", o->out->length);
    fw_text_printf(o->out, "%d 0 obj<<", ++o->count);
}

static void stream(objects *o, const fw_text *content) {
    fw_text_printf(o->out, "/Length %zu>>stream\n", content->length);
    fw_text_bytes(o->out, content->data, content->length);
    fw_text_add(o->out, "\nendstream endobj\n");
}

void fw_report_pdf_file(const fw_report_pdf *p, fw_text *pdf) {
    static const char *const font[] = {"Helvetica/Encoding/WinAnsiEncoding",
                                       "Helvetica-Bold/Encoding/WinAnsiEncoding", "Symbol"};
    enum { FONT = 5, RESOURCES = 8, FORM = 9 }; /* numbers of objects */
    objects o = {pdf, fw_text_new(pdf->arena), 0};
    fw_text_add(pdf, "%PDF-1.4\n");
    begin(&o);
    fw_text_add(pdf, "/Type/Catalog/Pages 2 0 R>>endobj\n");
    begin(&o);
    fw_text_add(pdf, "/Type/Pages/Kids[3 0 R]/Count 1>>endobj\n");
    begin(&o);
    const double box[4] = {0, 0, p->wide, p->high};
    fw_text_add(pdf, "/Type/Page/Parent 2 0 R/MediaBox[");
    fw_report_pdf_numbers(pdf, box, 4, "]");
    fw_text_printf(pdf, "/Contents 4 0 R/Resources %d 0 R>>endobj\n", RESOURCES);
    begin(&o);
    stream(&o, p->page);
    for (int i = 0; i < 3; i++) {
        begin(&o);
        fw_text_printf(pdf, "/Type/Font/Subtype/Type1/BaseFont/%s>>endobj\n", font[i]);
    }
    begin(&o);
    fw_text_printf(pdf, "/Font<</F1 %d 0 R/F2 %d 0 R/F3 %d 0 R>>/ExtGState<<", FONT, FONT + 1,
                   FONT + 2);
    for (int i = 0; i < p->nstate; i++) {
        fw_text_printf(pdf, "/G%d<</ca ", i);
        fw_report_pdf_numbers(pdf, &p->state[i][0], 1, "/CA");
        fw_report_pdf_numbers(pdf, &p->state[i][1], 1, ">>");
    }
    fw_text_add(pdf, ">>/XObject<<");
    for (int i = 0; i < p->nform; i++)
        fw_text_printf(pdf, "/X%d %d 0 R\n", i, FORM + i);
    fw_text_add(pdf, ">>>>endobj\n");
    for (int i = 0; i < p->nform; i++) { /* what is repeated may lie anywhere */
        begin(&o);
        fw_text_printf(
            pdf,
            "/Type/XObject/Subtype/Form/BBox[-1000000 -1000000 1000000 1000000]/Resources %d 0 R",
            RESOURCES);
        stream(&o, &p->form[i]);
    }
    const size_t table = pdf->length;
    fw_text_printf(pdf, "xref\n0 %d\n0000000000 65535 f \n", o.count + 1);
    fw_text_bytes(pdf, o.where.data, o.where.length);
    pdf->failed |= o.where.failed;
    fw_text_printf(pdf, "trailer<</Size %d/Root 1 0 R>>\nstartxref\n%zu\n%%%%EOF\n", o.count + 1,
                   table);
}
