/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One interface over all integrators, and their table. */
#include "maths/ode.h"
#include <float.h>
#include <math.h>
#include <string.h>

#define FW_MATHS_INTEGRATOR(name) extern const fw_maths_stepper_row fw_maths_##name##_row;
#include "maths/integrators.def"
#undef FW_MATHS_INTEGRATOR
#define FW_MATHS_INTEGRATOR(name) &fw_maths_##name##_row,
static const fw_maths_stepper_row *const table[] = {
#include "maths/integrators.def"
};
#undef FW_MATHS_INTEGRATOR

const fw_maths_stepper_row *const *fw_maths_stepper_table(size_t *count) {
    *count = sizeof table / sizeof table[0];
    return table;
}

const fw_maths_stepper_row *fw_maths_stepper_find(const char *name) {
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (strcmp(table[i]->name, name) == 0) return table[i];
    return NULL;
}

static bool contradicts(const fw_maths_stepper_row *row, const fw_maths_ode *ode) {
    return ode->n < 1 || ode->controlled < 0 || ode->controlled > ode->n || ode->positions < 0 ||
           2 * ode->positions > ode->controlled || (row->second_order && ode->positions < 1);
}

fw_status fw_maths_stepper_new(fw_arena *arena, const fw_maths_stepper_row *row,
                               const fw_maths_ode *ode, double rtol, const double *atol,
                               fw_maths_stepper **stepper) {
    fw_maths_stepper *s = NULL;
    double *y_old, *y, *f_old, *f, *tolerance;
    fw_maths_ode_apart *apart = NULL;
    *stepper = NULL;
    if (contradicts(row, ode)) return FW_INPUT;
    FW_NEED(y_old = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(y = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(f_old = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(f = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(tolerance = fw_maths_ode_vector(arena, ode->n));
    if (row->implicit && !ode->jacobian && ode->controlled >= FW_ODE_MANY)
        FW_TRY(fw_maths_ode_apart_new(arena, ode, &apart));
    FW_TRY(row->create(arena, ode, &s)); /* last: what it holds outside the arena has an owner */
    s->row = row;
    s->apart = apart;
    s->ode = *ode;
    s->rtol = rtol;
    s->atol = atol;
    s->h_max = (double)INFINITY;
    s->spectral_radius = 0.9;
    s->padded = fw_maths_ode_padded(ode->n);
    s->y_old = y_old, s->y = y, s->f_old = f_old, s->f = f, s->tolerance = tolerance;
    *stepper = s;
    return FW_OK;
}

void fw_maths_stepper_free(fw_maths_stepper *s) {
    if (s && s->row->destroy) s->row->destroy(s);
}

void fw_maths_stepper_start(fw_maths_stepper *s, double t, const double *y, double t_end) {
    size_t bytes = (size_t)s->ode.n * sizeof *y;
    for (int c = 0; c < s->padded; c++) /* never zero: 0/0 is not an error of zero */
        s->tolerance[c] = c < s->ode.controlled ? fmax(s->atol[c], DBL_MIN) : (double)INFINITY;
    memmove(s->y, y, bytes);
    memcpy(s->y_old, s->y, bytes);
    s->t = s->t_old = t;
    s->t_end = t_end;
    s->h = 0;
    s->dense_ready = false;
    fw_maths_ode_evaluate(s, t, s->y, s->f);
    memcpy(s->f_old, s->f, bytes);
    s->row->start(s);
}

fw_maths_ode_result fw_maths_stepper_step(fw_maths_stepper *s) {
    if (s->t >= s->t_end) return FW_ODE_STEP;
    s->dense_ready = false;
    return s->row->step(s);
}

static void ready(fw_maths_stepper *s) {
    if (!s->dense_ready && s->h > 0) s->row->prepare(s);
    s->dense_ready = true;
}

void fw_maths_stepper_dense(fw_maths_stepper *s, double theta, double *y) {
    ready(s);
    if (s->h > 0)
        s->row->dense(s, theta, y);
    else
        memcpy(y, s->y, (size_t)s->ode.n * sizeof *y);
}

void fw_maths_stepper_component(fw_maths_stepper *s, int a, double wa, int b, double wb,
                                double theta, double *value, double *slope) {
    ready(s);
    *slope = 0;
    if (s->h > 0)
        s->row->component(s, a, wa, b, wb, theta, value, slope);
    else
        *value = wa * s->y[a] + (b < 0 ? 0 : wb * s->y[b]);
}
