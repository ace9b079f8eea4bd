/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Third part of kernel_path.h: the numbers of the models, and the row of functions. */

/* end 0 counts from the front, end 1 from the back; where the value of that end and design goes */
static inline record *at_end(path *p, int i, int end) {
    return RECORD(p, i, FW_SIDES == 2 ? end : 0);
}
static inline int lane_of(int end, int design) {
    return FW_SIDES == 2 ? design : end;
}

static void fill_body(path *p, const fw_model *m, const fw_trail *t, int i, int end, int design) {
    record *r = at_end(p, i, end);
    int lane = lane_of(end, design), body = t->body[end ? t->count - i : i];
    bool ground = body == m->nbody;
    r->body[ENDS == 2 ? end : 0] = ground ? 0 : body;
    r->moves[lane] = ground ? 0 : -1;
    r->cosine[lane] = 1;
    if (ground) return;
    r->minv[lane] = m->minv[body], r->jinv[lane] = m->jinv[body];
    r->ax[lane] = m->constant[3 * body], r->ay[lane] = m->constant[3 * body + 1];
    r->at[lane] = m->constant[3 * body + 2];
    r->phi0[lane] = m->origin[3 * body + 2];
}

static void fill_pin(path *p, const fw_model *m, const fw_trail *t, int i, int end, int design) {
    record *r = at_end(p, i, end);
    int lane = lane_of(end, design), pin = t->pin[end ? t->count - 1 - i : i];
    bool same = m->body[2 * pin] == t->body[end ? t->count - i : i];
    const double *l = m->local + 4 * pin;
    double sign = same ? 1 : -1;
    r->pin[ENDS == 2 ? end : 0] = pin, r->sign[ENDS == 2 ? end : 0] = sign;
    r->outer_x[lane] = l[same ? 0 : 2], r->outer_y[lane] = l[same ? 1 : 3];
    r->inner_x[lane] = l[same ? 2 : 0], r->inner_y[lane] = l[same ? 3 : 1];
    r->masses[lane] = m->minv[m->body[2 * pin]] + m->minv[m->body[2 * pin + 1]];
    r->floor[lane] = fw_pin_floor(m, pin);
    r->offset_x[lane] = sign * m->offset[2 * pin];
    r->offset_y[lane] = sign * m->offset[2 * pin + 1];
}

/* a spring across its pin of the row, on the sides that hold the pin */
static void fill_torsion(path *p, const fw_model *m, const fw_trail *t, int spring, int end,
                         int design) {
    const fw_model_torsion *s = &m->torsion[spring];
    int at = t->torsion[spring], i = end ? t->count - 1 - at : at, lane = lane_of(end, design);
    if (i >= p->records) return;
    record *r = at_end(p, i, end);
    int outer = t->body[end ? at + 1 : at];
    r->k[lane] += s->k, r->c[lane] += s->c;
    r->torque0[lane] += (s->a == outer ? 1 : -1) * s->k * s->angle0;
}

static fw_status create(fw_arena *arena, const fw_model *const *models, const fw_trail *t,
                        void **out) {
    const fw_model *m = models[0];
    path *p = fw_arena_one(arena, path);
    FW_NEED(p);
    int n = t->count;
    p->pins = n, p->half = n / 2, p->even = n % 2 == 0, p->records = n - n / 2;
    p->bodies = p->records + (p->even ? 1 : 0);
    p->nq = m->nq, p->ny = m->ny, p->dissipates = m->dissipated >= 0, p->healthy = fw_healthy;
    p->first = t->body[0] == m->nbody && t->body[n] == m->nbody && n > 1 ? 1 : 0;
    FW_NEED(p->r = fw_arena_array(arena, record, (size_t)(p->bodies * FW_SIDES)));
    FW_NEED(p->keep = fw_arena_array(arena, real, (size_t)(4 * p->records * FW_SIDES)));
    for (int design = 0; design < DESIGNS; design++) {
        m = models[design];
        for (int end = 0; end < 2; end++) {
            for (int i = 0; i < p->bodies; i++)
                fill_body(p, m, t, i, end, design);
            for (int i = 0; i < p->records; i++)
                fill_pin(p, m, t, i, end, design);
            for (int i = 0; i < m->ntorsion; i++)
                fill_torsion(p, m, t, i, end, design);
            p->size[lane_of(end, design)] = m->size;
        }
    }
    p->rate = real_of(1);
#if FW_SIDES == 2
    FW_TRY(create_loop(arena, models, t, p));
#endif
    *out = p;
    return FW_OK;
}

/* leaves no upper halves behind: baseline code that runs next would wait for them */
#if defined(__AVX__)
#define END_OF_PATH() __builtin_ia32_vzeroupper()
#else
#define END_OF_PATH() ((void)0)
#endif

static void row_rhs(void *p, const double *y, double *f) {
    path_rhs(p, y, f);
    END_OF_PATH();
}

static bool row_project(void *p, double *y, double *f) {
    bool good = path_project(p, y, f);
    END_OF_PATH();
    return good;
}

static void row_lambda(const void *context, int design, double *lambda) {
    const path *p = context;
    for (int i = 0; i < p->records; i++)
        for (int end = 0; end < 2; end++) {
            const record *r = at_end((path *)(uintptr_t)context, i, end);
            int e = ENDS == 2 ? end : 0, lane = lane_of(end, design);
            lambda[2 * r->pin[e]] = r->sign[e] * r->x0[lane];
            lambda[2 * r->pin[e] + 1] = r->sign[e] * r->x1[lane];
        }
}

static fw_kernel_norms row_norms(const void *p) {
    return ((const path *)p)->norms;
}
static void row_set_healthy(void *p, double relative) {
    ((path *)p)->healthy = relative;
}
static void row_set_rate(void *p, const double *rate) {
    path *of = p;
    of->rated = false;
    for (int i = 0; i < DESIGNS && FW_SIDES == 2; i++) {
        of->rate[i] = rate[i];
        of->rated |= rate[i] != 1;
    }
}

const fw_path_ops FW_PATH = {FW_PATH_NAME, DESIGNS,   create,          row_rhs,     row_project,
                             row_lambda,   row_norms, row_set_healthy, row_set_rate};
