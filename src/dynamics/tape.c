/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Passes over a scene that come again. Devices of a study often differ in what moves nothing: the strength of a
   material, the width of a flexure whose stiffness is stated, a gap. Their motion is the same to the last bit, and
   only those who look at it see something else. So a pass is kept with all that it showed, and shown again to whoever
   asks for one from the same numbers.

   What a pass is made of is its key: everything that the steps of a plain model, its peaks and its rows depend on, as
   bytes. One that differs in a single bit is computed. So no motion depends on which others were computed before.

   A pass is kept when it is asked for a second time: where all devices move differently nothing is kept.
   Test: test_tape.c */
#include "base/text.h"
#include "dynamics/run.h"
#include <stdint.h>
#include <string.h>

enum { KEPT = 6, SEEN = 16 };
static const size_t most_bytes = (size_t)4 << 20; /* of a pass; a thread keeps KEPT of them */

typedef struct ending { /* of a pass, as others read it */
    fw_dynamics_peaks peaks;
    fw_multibody_record record;
    long steps, rejected, rhs, jacobians, factorisations, taken;
    double t, *y;
    double next_choice_check;
    /* of the answer */
    fw_multibody_energy first;
    double drift, largest;
    int rows;
    fw_dynamics_motion motion; /* the arrays of its rows alone */
    bool *waits;               /* (rows) NULL: none does */
} ending;

typedef struct kept { /* its arena holds all of it; NULL: nothing is kept here */
    fw_dynamics_tape tape;
    double *key;
    size_t nkey;
    ending ending;
    long number; /* among all that its thread kept */
    double
        steady; /* what it rests on is stable, and so much of its stiffness is left; 0: not known */
} kept;

struct fw_dynamics_tapes {
    fw_arena *arena;
    kept pass[KEPT];
    int next;            /* of them: to be replaced */
    long number;         /* of the last one */
    uint64_t seen[SEEN]; /* sums of keys that were asked for once */
    int next_seen;
    double *key; /* of the pass at hand */
    size_t nkey, most;
};

fw_status fw_dynamics_tapes_new(fw_arena *arena, fw_dynamics_tapes **tapes) {
    FW_NEED(*tapes = fw_arena_one(arena, fw_dynamics_tapes));
    (*tapes)->arena = arena;
    return FW_OK;
}

static void forget(kept *pass) {
    fw_arena_free(pass->tape.arena);
    *pass = (kept){.nkey = 0};
}

void fw_dynamics_tapes_free(fw_dynamics_tapes *tapes) {
    for (int i = 0; tapes && i < KEPT; i++)
        forget(&tapes->pass[i]);
}

/* ---- keys ---- */

static fw_status put(fw_dynamics_tapes *t, const double *x, size_t n) {
    if (t->nkey + n > t->most) {
        const size_t most = 2 * (t->nkey + n);
        FW_NEED(t->key = fw_arena_grow(t->arena, t->key, t->nkey, most, sizeof *t->key));
        t->most = most;
    }
    if (n > 0) memcpy(t->key + t->nkey, x, n * sizeof *x);
    t->nkey += n;
    return FW_OK;
}

/* of a row of a table, or a function: where it stands */
static fw_status put_bits(fw_dynamics_tapes *t, uintptr_t bits) {
    double x = 0;
    memcpy(&x, &bits, sizeof bits < sizeof x ? sizeof bits : sizeof x);
    return put(t, &x, 1);
}

static fw_status put_model(fw_dynamics_tapes *t, const fw_multibody_model *m) {
    const size_t bodies = (size_t)m->nbody + 1, blocks = (size_t)m->nblock;
    const double sizes[] = {m->nbody,          m->nblock,        m->npin,        m->ny,
                            m->rows,           m->dissipated,    m->ntorsion,    m->size,
                            m->scale.length_m, m->scale.mass_kg, m->scale.time_s};
    FW_TRY(put(t, sizes, sizeof sizes / sizeof sizes[0]));
    FW_TRY(put_bits(t, (uintptr_t)m->method));
    FW_TRY(put(t, m->origin, 3 * bodies));
    FW_TRY(put(t, m->mass, bodies - 1));
    FW_TRY(put(t, m->inertia, bodies - 1));
    FW_TRY(put(t, m->minv, bodies));
    FW_TRY(put(t, m->jinv, bodies));
    FW_TRY(put(t, m->constant, 3 * bodies));
    FW_TRY(put(t, m->local, 4 * blocks));
    FW_TRY(put(t, m->offset, 2 * blocks));
    for (size_t i = 0; i < blocks; i++) {
        const double ends[] = {m->body[2 * i], m->body[2 * i + 1]};
        FW_TRY(put(t, ends, 2));
    }
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *s = &m->torsion[i];
        const double of[] = {s->a, s->b, s->k, s->c, s->angle0};
        FW_TRY(put(t, of, sizeof of / sizeof of[0]));
    }
    return FW_OK;
}

static fw_status put_problem(fw_dynamics_tapes *t, const fw_dynamics_problem *p) {
    const fw_mechanism *m = p->mechanism;
    const double of[] = {p->amplitude,
                         p->most_angle,
                         fw_dynamics_end(p),
                         m->npin,
                         m->njoint,
                         p->scene->duration_s,
                         p->idle,
                         p->system->projecting,
                         p->system->baumgarte};
    FW_TRY(put(t, of, sizeof of / sizeof of[0]));
    FW_TRY(put(t, p->q0, (size_t)p->model->nq));
    FW_TRY(put(t, p->start, (size_t)p->model->ny));
    for (int i = 0; i < m->npin; i++) {
        const double pin[] = {m->pin[i].body_a, m->pin[i].body_b, m->pin[i].free_angle_rad,
                              p->model->pin_block[i]};
        FW_TRY(put(t, pin, sizeof pin / sizeof pin[0]));
    }
    return FW_OK;
}

static fw_status put_pass(fw_dynamics_tapes *t, const fw_dynamics_run *r, const fw_maths_stepper *s,
                          const fw_dynamics_peaks *peaks) {
    const fw_dynamics_motion *x = r->record.motion;
    const fw_dynamics_peaks *marked = peaks->marked;
    const double of[] = {s->rtol,
                         s->h_max,
                         s->h_fixed,
                         r->record.full,
                         peaks->sized,
                         x->nsample,
                         x->late != NULL,
                         fw_dynamics_record_is_observed(&r->record),
                         fw_dynamics_record_is_traced(&r->record),
                         r->control.patience,
                         marked ? marked->nmark : -1};
    FW_TRY(put(t, of, sizeof of / sizeof of[0]));
    FW_TRY(put_bits(t, (uintptr_t)s->row));
    FW_TRY(put(t, s->atol, (size_t)r->problem.model->ny));
    return marked ? put(t, marked->mark_t, (size_t)marked->nmark) : FW_OK;
}

/* of the key's words */
static uint64_t sum_of(const fw_dynamics_tapes *t) {
    uint64_t sum = FW_HASH_BEGIN;
    for (size_t i = 0; i < t->nkey; i++) {
        uint64_t word;
        memcpy(&word, &t->key[i], sizeof word);
        sum = fw_hash_add(sum, word);
    }
    return sum;
}

/* Of plain models alone: what acts on them goes neither with time nor with what happened before, so that nothing else
   of the system is part of a pass. */
static bool may_be_kept(const fw_dynamics_run *r, const fw_maths_stepper *s,
                        const fw_dynamics_peaks *peaks) {
    const fw_dynamics_problem *p = &r->problem;
    const fw_dynamics_motion_options *o = p->options;
    return o->tapes && p->system->kernel && p->npiece == 1 && p->nstride == 0 &&
           p->mechanism->ndriver == 0 && peaks->nstrip == 0 && s->row->dense_parts <= 1 &&
           !o->reactions && !o->whole && !o->energies && r->control.trial == 0;
}

/* Angles beyond which a run is hopeless differ with what a hinge bears, and nothing reads them before so many evaluations
   were made: a pass of fewer is that of all of them. */
static bool is_short_of_hopeless(const fw_dynamics_motion_options *o, long rhs) {
    return !o->hopeless_rad || rhs <= o->hopeless_rhs;
}

static kept *find(fw_dynamics_tapes *t, const fw_dynamics_motion_options *o) {
    for (int i = 0; i < KEPT; i++) {
        kept *pass = &t->pass[i];
        if (pass->tape.arena && pass->nkey == t->nkey &&
            memcmp(pass->key, t->key, t->nkey * sizeof *t->key) == 0 &&
            is_short_of_hopeless(o, pass->ending.rhs))
            return pass;
    }
    return NULL;
}

static bool was_seen(fw_dynamics_tapes *t) {
    const uint64_t sum = sum_of(t);
    for (int i = 0; i < SEEN; i++)
        if (t->seen[i] == sum) return true;
    t->seen[t->next_seen] = sum;
    t->next_seen = (t->next_seen + 1) % SEEN;
    return false;
}

/* ---- how it ends ---- */

static double *copied(fw_arena *arena, const double *from, size_t n) {
    double *to = fw_arena_raw(arena, n * sizeof *to + 1);
    if (to && n > 0) memcpy(to, from, n * sizeof *to);
    return to;
}

static fw_status keep_peaks(fw_arena *arena, const fw_dynamics_peaks *from, fw_dynamics_peaks *to) {
    const size_t n = (size_t)from->npin, marks = (size_t)from->nmark;
    *to = *from;
    FW_NEED(to->peak = fw_arena_array(arena, fw_dynamics_peak, n));
    memcpy(to->peak, from->peak, n * sizeof *to->peak);
    FW_NEED(to->mark_t = copied(arena, from->mark_t, marks));
    FW_NEED(to->mark = copied(arena, from->mark, marks * n));
    FW_NEED(to->size = copied(arena, from->size, marks * n));
    return FW_OK;
}

static void put_back_peaks(const fw_dynamics_peaks *from, fw_dynamics_peaks *to) {
    const size_t n = (size_t)from->npin, marks = (size_t)from->nmark;
    to->nmark = from->nmark, to->displaced = from->displaced;
    memcpy(to->peak, from->peak, n * sizeof *to->peak);
    memcpy(to->mark_t, from->mark_t, marks * sizeof *to->mark_t);
    memcpy(to->mark, from->mark, marks * n * sizeof *to->mark);
    memcpy(to->size, from->size, marks * n * sizeof *to->size);
}

enum { COLUMNS = 7, WAITING = 3 }; /* of a row; the first ones a row that waits has, too */

typedef struct column {
    double **at;
    size_t width;
} column;

static void columns_of(fw_dynamics_motion *x, column *out) {
    const size_t n = 3 * (size_t)x->nbody, pins = (size_t)x->npin;
    const column all[COLUMNS] = {{&x->t_s, 1},
                                 {&x->q, n},
                                 {&x->v, n},
                                 {&x->accel, n},
                                 {&x->angle_rad, pins},
                                 {&x->reaction_N, 2 * pins},
                                 {&x->joint_N, 3 * (size_t)x->njoint}};
    memcpy(out, all, sizeof all);
}

static fw_status keep_rows(fw_arena *arena, fw_dynamics_motion *from, ending *to) {
    column a[COLUMNS], b[COLUMNS];
    const size_t rows = (size_t)to->rows;
    to->motion = *from;
    columns_of(from, a), columns_of(&to->motion, b);
    for (int c = 0; c < COLUMNS; c++)
        FW_NEED(*b[c].at = copied(arena, *a[c].at, rows * a[c].width));
    FW_NEED(to->waits = fw_arena_array(arena, bool, rows));
    for (int i = 0; i < to->rows; i++)
        to->waits[i] = fw_dynamics_motion_waits(from, i);
    return FW_OK;
}

static void put_back_rows(ending *from, fw_dynamics_recorder *record) {
    column a[COLUMNS], b[COLUMNS];
    columns_of(&from->motion, a), columns_of(record->motion, b);
    for (int c = 0; c < COLUMNS; c++)
        for (size_t i = 0, n = a[c].width; i < (size_t)from->rows; i++)
            if (c < WAITING || !from->waits[i])
                memcpy(*b[c].at + i * n, *a[c].at + i * n, n * sizeof(double));
    for (int i = 0; i < from->rows; i++)
        fw_dynamics_record_waits(record, i, from->waits[i]);
    record->row = from->rows;
}

static fw_status keep_ending(kept *pass, const fw_dynamics_run *r, const fw_maths_stepper *s,
                             const fw_dynamics_peaks *peaks) {
    fw_arena *arena = pass->tape.arena;
    ending *e = &pass->ending;
    *e = (ending){.record = r->problem.system->record,
                  .steps = s->steps,
                  .rejected = s->rejected,
                  .rhs = s->rhs,
                  .jacobians = s->jacobians,
                  .factorisations = s->factorisations,
                  .taken = r->control.taken,
                  .t = s->t,
                  .next_choice_check = r->control.next_choice_check,
                  .first = r->record.first,
                  .drift = r->record.drift,
                  .largest = r->record.largest,
                  .rows = r->record.row};
    FW_NEED(e->y = copied(arena, s->y, (size_t)r->problem.model->ny));
    FW_TRY(keep_peaks(arena, peaks, &e->peaks));
    return r->record.full ? keep_rows(arena, r->record.motion, e) : FW_OK;
}

static void put_back(kept *pass, fw_dynamics_run *r, fw_maths_stepper *s,
                     fw_dynamics_peaks *peaks) {
    ending *e = &pass->ending;
    fw_dynamics_recorder *record = &r->record;
    r->problem.system->record = e->record;
    s->steps = e->steps, s->rejected = e->rejected, s->rhs = e->rhs;
    s->jacobians = e->jacobians, s->factorisations = e->factorisations;
    s->t = e->t;
    memcpy(s->y, e->y, (size_t)r->problem.model->ny * sizeof *s->y);
    r->control.taken = e->taken, r->control.steps += e->taken;
    r->control.next_choice_check = e->next_choice_check;
    put_back_peaks(&e->peaks, peaks);
    if (!record->full) return;
    record->first = e->first, record->drift = e->drift, record->largest = e->largest;
    put_back_rows(e, record);
}

/* ---- a pass ---- */

static fw_status replay(kept *pass, fw_dynamics_run *r, fw_maths_stepper *s,
                        fw_dynamics_peaks *peaks) {
    if (fw_arena_cancelled(r->problem.arena)) return FW_CANCELLED;
    fw_dynamics_record_again(&r->record, pass->tape.first);
    put_back(pass, r, s, peaks);
    FW_TRY(fw_dynamics_run_limits(r, s));
    fw_dynamics_record_end(&r->record, false, s->t);
    if (!r->record.full) return FW_OK;
    r->record.motion->tapes = r->problem.options->tapes;
    r->record.motion->again = pass->number;
    return FW_OK;
}

double *fw_dynamics_motion_steady(const fw_dynamics_motion *x) {
    for (int i = 0; x->tapes && i < KEPT; i++)
        if (x->tapes->pass[i].tape.arena && x->tapes->pass[i].number == x->again)
            return &x->tapes->pass[i].steady;
    return NULL;
}

/* room for one more; NULL: there is none, and it is not kept */
static kept *begin(fw_dynamics_tapes *t) {
    kept *pass = &t->pass[t->next];
    t->next = (t->next + 1) % KEPT;
    forget(pass);
    pass->tape.arena = fw_arena_part(t->arena, most_bytes);
    pass->key = pass->tape.arena ? copied(pass->tape.arena, t->key, t->nkey) : NULL;
    pass->nkey = t->nkey;
    pass->number = ++t->number;
    if (pass->key) return pass;
    forget(pass);
    return NULL;
}

/* computed, and kept unless it ended before its scene did, or in an error, or what is hopeless was asked */
static fw_status record(kept *pass, fw_dynamics_run *r, fw_maths_stepper *s,
                        fw_dynamics_peaks *peaks) {
    if (pass) r->record.tape = &pass->tape;
    const fw_status status = fw_dynamics_run_pass(r, s, peaks);
    r->record.tape = NULL;
    const bool whole = status == FW_OK && s->t >= fw_dynamics_end(&r->problem) &&
                       is_short_of_hopeless(r->problem.options, s->rhs);
    if (pass && !(whole && !pass->tape.torn && keep_ending(pass, r, s, peaks) == FW_OK))
        forget(pass);
    return status;
}

fw_status fw_dynamics_tape_pass(fw_dynamics_run *r, fw_maths_stepper *s, fw_dynamics_peaks *peaks) {
    fw_dynamics_tapes *t = r->problem.options->tapes;
    if (!may_be_kept(r, s, peaks)) return fw_dynamics_run_pass(r, s, peaks);
    t->nkey = 0;
    FW_TRY(put_model(t, r->problem.model));
    FW_TRY(put_problem(t, &r->problem));
    FW_TRY(put_pass(t, r, s, peaks));
    kept *pass = find(t, r->problem.options);
    return pass ? replay(pass, r, s, peaks) : record(was_seen(t) ? begin(t) : NULL, r, s, peaks);
}
