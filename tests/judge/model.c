/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    enum load_kind kind;
    int numbers;
    int has_body;
} KINDS[] = {
    {"force", LOAD_FORCE, 4, 1}, {"torque", LOAD_TORQUE, 1, 1}, {"comb", LOAD_COMB, 8, 1},
    {"shake", LOAD_SHAKE, 2, 0}, {"heat", LOAD_HEAT, 5, 0},     {"start", LOAD_START, 3, 1},
    {"slide", HOLD_SLIDE, 2, 1}, {"rod", HOLD_ROD, 5, 1},       {"turn", HOLD_TURN, 1, 1}};

static int numbers(FILE *in, int n, double *out) {
    for (int i = 0; i < n; i++)
        if (fscanf(in, "%lf", out + i) != 1) return 1;
    return 0;
}

static int read_span(FILE *in, struct span *span) {
    if (fscanf(in, "%d %lf", &span->steps, &span->step) != 2 || span->steps < 1 ||
        span->steps > 4000)
        return 1;
    int n = 2 * span->steps + 1;
    span->place = calloc((size_t)n, sizeof *span->place);
    if (!span->place) return 1;
    for (int i = 0; i < n; i++) {
        double v[7];
        if (numbers(in, 7, v)) return 1;
        span->place[i] = (struct place){v[0], v[1], v[2], v[3], v[4], v[5], v[6]};
    }
    return 0;
}

static int read_flexure(FILE *in, struct flexure *f) {
    double v[11];
    if (fscanf(in, "%d %d %d", &f->a, &f->b, &f->spans) != 3 || numbers(in, 11, v) || f->spans < 1)
        return 1;
    f->x = v[0];
    f->y = v[1];
    f->psi = v[2];
    f->root[0] = (struct root){v[3], v[4], v[5], v[6]};
    f->root[1] = (struct root){v[7], v[8], v[9], v[10]};
    f->softer = 1;
    f->span = calloc((size_t)f->spans, sizeof *f->span);
    if (!f->span) return 1;
    for (int i = 0; i < f->spans; i++)
        if (read_span(in, f->span + i)) return 1;
    struct shot rest;
    beam_shoot(f, (double[3]){0, 0, 0}, 0, &rest);
    f->bx = f->x + cos(f->psi) * rest.x - sin(f->psi) * rest.y;
    f->by = f->y + sin(f->psi) * rest.x + cos(f->psi) * rest.y;
    return 0;
}

static int read_load(FILE *in, const char *word, struct model *model) {
    for (size_t i = 0; i < sizeof KINDS / sizeof KINDS[0]; i++) {
        if (strcmp(word, KINDS[i].name)) continue;
        if (model->loads >= LOADS) return 1;
        struct load *load = &model->load[model->loads++];
        load->kind = KINDS[i].kind;
        if (KINDS[i].has_body &&
            (fscanf(in, "%d", &load->body) != 1 || load->body < 1 || load->body > model->bodies))
            return 1;
        return numbers(in, KINDS[i].numbers, load->number);
    }
    return 1;
}

int model_read(const char *path, struct model *model) {
    FILE *in = fopen(path, "r");
    char word[32];
    int bad = !in;
    memset(model, 0, sizeof *model);
    while (!bad && fscanf(in, "%31s", word) == 1) {
        if (!strcmp(word, "body")) {
            double v[4];
            bad = model->bodies >= BODIES || numbers(in, 4, v);
            if (!bad) model->body[++model->bodies] = (struct body){v[0], v[1], v[2], v[3]};
        } else if (!strcmp(word, "flexure")) {
            bad = model->flexures >= FLEXURES || read_flexure(in, &model->flexure[model->flexures]);
            model->flexures++;
        } else if (!strcmp(word, "motion")) {
            bad = numbers(in, 1, &model->duration);
        } else if (!strcmp(word, "pulse")) {
            bad = numbers(in, 1, &model->pulse);
        } else {
            bad = read_load(in, word, model);
        }
    }
    if (in) (void)fclose(in);
    if (bad) (void)fprintf(stderr, "%s: not a model\n", path);
    return bad;
}

void model_point(const struct model *model, const double *q, int k, double px, double py,
                 double out[2]) {
    double c = cos(q[3 * k + 2]), s = sin(q[3 * k + 2]);
    out[0] = model->body[k].x + q[3 * k] + c * px - s * py;
    out[1] = model->body[k].y + q[3 * k + 1] + s * px + c * py;
}

void model_root(const struct model *model, const double *q, const struct flexure *f, int which,
                double share, double out[2]) {
    int k = which ? f->b : f->a;
    double x = which ? f->bx : f->x, y = which ? f->by : f->y;
    if (k) {
        model_point(model, q, k, x - model->body[k].x, y - model->body[k].y, out);
        return;
    }
    out[0] = x;
    out[1] = y;
    for (int i = 0; i < model->loads; i++) {
        const double *v = model->load[i].number;
        if (model->load[i].kind != LOAD_HEAT) continue;
        double strain = (1 + v[1] * share) / (1 + v[0] * share) - 1;
        out[0] += strain * (x - v[3]);
        out[1] += strain * (y - v[4]);
    }
}

double model_law(const struct model *model, double time) {
    if (model->pulse <= 0) return 1;
    return time < model->pulse ? sin(acos(-1.0) * time / model->pulse) : 0;
}

static void push(const struct model *model, const double *q, int k, const double at[2], double fx,
                 double fy, double couple, double *force) {
    double lx = at[0] - model->body[k].x - q[3 * k], ly = at[1] - model->body[k].y - q[3 * k + 1];
    force[3 * k] += fx;
    force[3 * k + 1] += fy;
    force[3 * k + 2] += couple + lx * fy - ly * fx;
}

/* Capacitance of a gap m between fingers of width w and depth h, over eps0 h and length: of its faces, and of the field at
   both edges, each of which is that of an electrode which is deeper by (2) of docs/theory/effects/fringe-field.md */
static double of_gap(double m, double w, double h) {
    double k = m / (w + m);
    double deeper =
        m / (2 * acos(-1.0)) * (log((1 - k * k) / (k * k)) + log((1 + k) / (1 - k)) / k);
    return (1 + 2 * deeper / h) / m;
}

/* minus its slope by m, from a symmetrical difference */
static double closing(double m, double w, double h) {
    double d = 1e-4 * m;
    return (8 * (of_gap(m - d, w, h) - of_gap(m + d, w, h)) -
            (of_gap(m - 2 * d, w, h) - of_gap(m + 2 * d, w, h))) /
           (12 * d);
}

/* number[3] is half of eps0 h n V^2, [6] width and [7] depth of the fingers; C' of docs/theory/effects/comb-drive.md by a
   rule of Gauss. */
static void comb(const struct model *model, const double *q, const struct load *load, double share,
                 double *force) {
    static const double NODE[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                   0.9602898564975363};
    static const double WEIGHT[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                     0.1012285362903763};
    const double *v = load->number;
    const struct body *body = &model->body[load->body];
    double at[2], c = cos(v[2]), s = sin(v[2]), g = v[4], tilt = q[3 * load->body + 2];
    model_point(model, q, load->body, v[0], v[1], at);
    double dx = at[0] - body->x - v[0], dy = at[1] - body->y - v[1];
    double x = dx * c + dy * s, y = -dx * s + dy * c;
    double low = -v[5] / 2 - x, high = v[5] / 2, half = (high - low) / 2, middle = (high + low) / 2;
    double along = of_gap(g - y - tilt * low, v[6], v[7]) + of_gap(g + y + tilt * low, v[6], v[7]);
    double across = 0, couple = 0;
    for (int i = 0; i < 8; i++) {
        double at_s = middle + half * (i < 4 ? NODE[i] : -NODE[i - 4]), w = half * WEIGHT[i % 4];
        double one = g - y - tilt * at_s, two = g + y + tilt * at_s,
               slope = closing(one, v[6], v[7]) - closing(two, v[6], v[7]);
        across += w * slope;
        couple += w * slope * at_s;
    }
    double size = v[3] * share * share;
    push(model, q, load->body, at, size * (along * c - across * s), size * (along * s + across * c),
         size * couple, force);
}

void model_loads(const struct model *model, const double *q, double share, double time,
                 double *force) {
    double now = share * model_law(model, time), at[2];
    for (int i = 0; i < model->loads; i++) {
        const struct load *load = &model->load[i];
        const double *v = load->number;
        if (load->kind == LOAD_FORCE) {
            model_point(model, q, load->body, v[0], v[1], at);
            push(model, q, load->body, at, now * v[2], now * v[3], 0, force);
        } else if (load->kind == LOAD_TORQUE) {
            force[3 * load->body + 2] += now * v[0];
        } else if (load->kind == LOAD_COMB) {
            comb(model, q, load, now, force);
        } else if (load->kind == LOAD_SHAKE) {
            for (int k = 1; k <= model->bodies; k++) {
                force[3 * k] -= model->body[k].mass * now * v[0];
                force[3 * k + 1] -= model->body[k].mass * now * v[1];
            }
        }
    }
}
