/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Devices in threads, and searches, each of which judges one device after the other. */
#include "plan/design.h"
#include "study/study_parts.h"
#include <math.h>
#include <pthread.h>
#include <string.h>
#include <time.h>

fw_status fw_study_keep(fw_study *study, const fw_study_sample *sample) {
    return study->store ? fw_study_store_add(study->store, sample) : FW_OK;
}

int fw_study_jobs(const fw_study *study) {
    return study->options.jobs > 0 ? study->options.jobs : fw_processors();
}

void fw_study_tell(const fw_study *study) {
    const fw_study_options *o = &study->options;
    fw_study_told *t = study->told;
    if (!o->progress || !t || !pthread_equal(t->thread, pthread_self())) return;
    o->progress(o->progress_context, atomic_load(&t->done), -t->most,
                fw_study_now_s() - t->begun_s);
}

/* ---- threads that do the same beside the calling one ---- */

/* A thread without a device of its own helps to judge those of others, whose flows and corners need nothing of each other
   (fw_arena_each): the last search of several, or the only one, has all of them. A study's team counts them while work is
   done; at other times it has none. */
typedef struct crew {
    const fw_study *study;
    void (*work)(void *context); /* of a thread, until nothing is left for it */
    void (*lead)(void *context); /* of the calling thread meanwhile */
    void *context;
    pthread_mutex_t lock;        /* of what follows, and of the context's own */
    pthread_cond_t given, ended; /* there is work; some of it, or a thread, is at its end */
    int alive;
} crew;

static void *member(void *argument) {
    crew *c = argument;
    locale_t before = uselocale(c->study->design->locale);
    c->work(c->context);
    uselocale(before);
    atomic_fetch_add(&c->study->team->idle, 1);
    pthread_mutex_lock(&c->lock);
    c->alive--;
    pthread_cond_signal(&c->ended);
    pthread_mutex_unlock(&c->lock);
    return NULL;
}

/* with so many threads, as far as the system gives them; false: it gave none, and nothing was done */
static bool crew_works(crew *c, int threads) {
    pthread_t thread[FW_JOBS_MOST];
    int n = 0;
    pthread_mutex_init(&c->lock, NULL);
    pthread_cond_init(&c->given, NULL);
    pthread_cond_init(&c->ended, NULL);
    pthread_mutex_lock(&c->lock);
    while (n < threads && n < FW_JOBS_MOST && pthread_create(&thread[n], NULL, member, c) == 0)
        n++;
    c->alive = n;
    pthread_mutex_unlock(&c->lock);
    if (n > 0) c->lead(c->context);
    for (int i = 0; i < n; i++)
        pthread_join(thread[i], NULL);
    atomic_fetch_sub(&c->study->team->idle, n);
    pthread_cond_destroy(&c->ended);
    pthread_cond_destroy(&c->given);
    pthread_mutex_destroy(&c->lock);
    return n > 0;
}

/* a fifth of a second, or until something has ended; the lock is held before and behind */
static void wait_ended(crew *c) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += 200000000L;
    if (until.tv_nsec >= 1000000000L) until.tv_sec++, until.tv_nsec -= 1000000000L;
    pthread_cond_timedwait(&c->ended, &c->lock, &until);
}

/* ---- the same work many times ---- */

typedef struct queue {
    crew crew;
    fw_status (*one)(void *context, long i);
    void *context;
    long n, next;
    fw_status status; /* the first that is not FW_OK */
} queue;

static void take_next(void *context) {
    queue *q = context;
    pthread_mutex_lock(&q->crew.lock);
    while (q->next < q->n && q->status == FW_OK) {
        long i = q->next++;
        pthread_mutex_unlock(&q->crew.lock);
        fw_status status = q->one(q->context, i);
        pthread_mutex_lock(&q->crew.lock);
        if (q->status == FW_OK) q->status = status;
    }
    pthread_mutex_unlock(&q->crew.lock);
}

/* others work, and this thread says how far they are */
static void tell_meanwhile(void *context) {
    queue *q = context;
    pthread_mutex_lock(&q->crew.lock);
    while (q->crew.alive > 0) {
        wait_ended(&q->crew);
        pthread_mutex_unlock(&q->crew.lock);
        fw_study_tell(q->crew.study);
        pthread_mutex_lock(&q->crew.lock);
    }
    pthread_mutex_unlock(&q->crew.lock);
}

static fw_status all_alone(queue *q) {
    locale_t before = uselocale(q->crew.study->design->locale);
    while (q->next < q->n && q->status == FW_OK)
        q->status = q->one(q->context, q->next++);
    uselocale(before);
    return q->status;
}

fw_status fw_study_each(const fw_study *study, long n, fw_status (*one)(void *context, long i),
                        void *context) {
    queue q = {.crew = {.study = study, .work = take_next, .lead = tell_meanwhile},
               .one = one,
               .context = context,
               .n = n};
    const int all = fw_study_jobs(study), jobs = n < 1 ? 1 : n < all ? (int)n : all;
    q.crew.context = &q;
    atomic_fetch_add(&study->team->idle, all - jobs);
    fw_status status = jobs > 1 && crew_works(&q.crew, jobs) ? q.status : all_alone(&q);
    atomic_fetch_sub(&study->team->idle, all - jobs);
    return status;
}

/* ---- samples ----
   The calling thread gives out samples, takes those that end and looks at the clock; each worker judges one at
   a time. A sample does not know which thread it is in, so the results are the same for any number of them.
   Slots bound the memory: twice as many samples as threads are under way. */

enum { TELL_EACH = 1024 }; /* of samples that are not wanted */

typedef enum slot_state { FREE, GIVEN, TAKEN, ENDED } slot_state; /* TAKEN: by a worker */

typedef struct slot {
    fw_study_sample sample;
    slot_state state;
    fw_status status;
} slot;

typedef struct pool {
    fw_study *study;
    fw_arena *scratch; /* of one run */
    const fw_study_work *work;
    crew crew;
    slot *slot;
    int nslot;
    bool over; /* no more samples come */
    bool changed;
    fw_status status; /* the first that ends the study */
    long done;
    double begun_s;
} pool;

static slot *find(pool *p, slot_state state) {
    for (int i = 0; i < p->nslot; i++)
        if (p->slot[i].state == state) return &p->slot[i];
    return NULL;
}

static void judge_given(void *context) {
    pool *p = context;
    pthread_mutex_lock(&p->crew.lock);
    for (;;) {
        slot *s = find(p, GIVEN);
        if (!s && p->over) break;
        if (!s) {
            atomic_fetch_add(&p->study->team->idle, 1);
            pthread_cond_wait(&p->crew.given, &p->crew.lock);
            atomic_fetch_sub(&p->study->team->idle, 1);
            continue;
        }
        s->state = TAKEN;
        pthread_mutex_unlock(&p->crew.lock);
        bool changed = false;
        s->status = fw_study_evaluate(p->study, p->study->options.cancel, &s->sample, &changed);
        pthread_mutex_lock(&p->crew.lock);
        p->changed = p->changed || changed;
        s->state = ENDED;
        pthread_cond_signal(&p->crew.ended);
    }
    pthread_mutex_unlock(&p->crew.lock);
}

/* ---- the calling thread ---- */

static void tell(pool *p) {
    const fw_study_options *o = &p->study->options;
    fw_study_tell(p->study);
    if (o->progress && !p->study->told)
        o->progress(o->progress_context, p->done, p->work->n, fw_study_now_s() - p->begun_s);
}

static void count(pool *p) {
    p->done++;
    if (p->study->told) atomic_fetch_add(&p->study->told->done, 1);
}

static void end_with(pool *p, fw_status status) {
    if (p->status == FW_OK) p->status = status;
}

/* takes every sample that has ended; the lock is held before and behind */
static void take_ended(pool *p) {
    slot *s;
    while ((s = find(p, ENDED)) != NULL) {
        if (s->status != FW_OK) end_with(p, s->status);
        pthread_mutex_unlock(&p->crew.lock);
        if (s->status == FW_OK) {
            fw_status status = fw_study_keep(p->study, &s->sample);
            if (status == FW_OK && p->work->take)
                status = p->work->take(p->work->context, &s->sample);
            end_with(p, status);
            count(p);
        }
        tell(p);
        pthread_mutex_lock(&p->crew.lock);
        s->state = FREE;
    }
}

static void wait_and_tell(pool *p) {
    wait_ended(&p->crew);
    pthread_mutex_unlock(&p->crew.lock);
    tell(p);
    pthread_mutex_lock(&p->crew.lock);
}

/* a sample that the store has is taken as it is; the lock is not held */
static fw_status from_store(pool *p, fw_study_sample *sample, bool *there) {
    *there = false;
    if (!p->study->store || p->work->anew) return FW_OK;
    FW_TRY(fw_study_store_get(p->study->store, sample->i, sample, there));
    if (!*there) return FW_OK;
    count(p);
    return p->work->take ? p->work->take(p->work->context, sample) : FW_OK;
}

/* fills a free slot with sample k: *given, or it is not wanted, or was in the store */
static fw_status give(pool *p, slot *s, long k, bool *given) {
    bool wanted = true, there = false;
    *given = false;
    if (fw_cancel_requested(p->study->options.cancel)) return FW_CANCELLED;
    FW_TRY(p->work->fill(p->work->context, k, &s->sample, &wanted));
    if (!wanted) {
        count(p);
        if (k % TELL_EACH == 0) tell(p);
        return FW_OK;
    }
    FW_TRY(from_store(p, &s->sample, &there));
    if (!there && p->study->stored_only && !p->work->anew)
        return fw_diag_error(
            &p->study->diags, 497, (fw_place){.file = p->study->options.file},
            "sample %ld is in none of the shards; run the shard that has it to its "
            "end with --resume",
            s->sample.i);
    *given = !there;
    return FW_OK;
}

static void run(void *context) {
    pool *p = context;
    pthread_mutex_lock(&p->crew.lock);
    for (long k = 0; k < p->work->n && p->status == FW_OK;) {
        take_ended(p);
        slot *s = find(p, FREE);
        if (!s) {
            wait_and_tell(p);
            continue;
        }
        bool given;
        pthread_mutex_unlock(&p->crew.lock);
        fw_status status = give(p, s, k++, &given);
        pthread_mutex_lock(&p->crew.lock);
        if (status != FW_OK) end_with(p, status);
        if (status != FW_OK || !given) continue;
        s->state = GIVEN;
        pthread_cond_signal(&p->crew.given);
    }
    p->over = true;
    if (p->status != FW_OK) /* what was not begun is not */
        for (int i = 0; i < p->nslot; i++)
            if (p->slot[i].state == GIVEN) p->slot[i].state = FREE;
    pthread_cond_broadcast(&p->crew.given);
    while (find(p, GIVEN) || find(p, TAKEN) || find(p, ENDED)) {
        take_ended(p);
        if (find(p, GIVEN) || find(p, TAKEN)) wait_and_tell(p);
    }
    pthread_mutex_unlock(&p->crew.lock);
}

/* one thread: this one */
static void run_alone(pool *p) {
    for (long k = 0; k < p->work->n && p->status == FW_OK; k++) {
        slot *s = &p->slot[0];
        bool given;
        fw_status status = give(p, s, k, &given);
        if (status == FW_OK && given) {
            status = fw_study_evaluate(p->study, p->study->options.cancel, &s->sample, &p->changed);
            if (status == FW_OK) status = fw_study_keep(p->study, &s->sample);
            if (status == FW_OK && p->work->take)
                status = p->work->take(p->work->context, &s->sample);
            count(p);
            tell(p);
        }
        end_with(p, status);
    }
}

static fw_status run_work(pool *p, int jobs) {
    p->nslot = jobs > 1 ? 2 * jobs : 1;
    FW_NEED(p->slot = fw_arena_array(p->scratch, slot, (size_t)p->nslot));
    for (int i = 0; i < p->nslot; i++)
        FW_TRY(fw_study_sample_new(p->scratch, p->study, &p->slot[i].sample));
    if (jobs < 2 || !crew_works(&p->crew, jobs)) run_alone(p);
    if (p->changed)
        return fw_diag_error(&p->study->diags, 500, (fw_place){.file = p->study->device_path},
                             "the device file, or a pack or drawing that it names, was changed "
                             "while the study ran; run it again (its samples so far are of the "
                             "former one)");
    return p->status;
}

fw_status fw_study_pool_run(fw_study *study, const fw_study_work *work) {
    const int all = fw_study_jobs(study), jobs = work->n < 1     ? 1
                                                 : work->n < all ? (int)work->n
                                                                 : all;
    pool p = {.study = study,
              .work = work,
              .crew = {.study = study, .work = judge_given, .lead = run, .context = &p},
              .scratch = fw_arena_part(study->arena, 0)};
    FW_NEED(p.scratch);
    p.begun_s = fw_study_now_s();
    atomic_fetch_add(&study->team->idle, all - jobs);
    fw_status status = run_work(&p, jobs);
    atomic_fetch_sub(&study->team->idle, all - jobs);
    fw_arena_free(p.scratch);
    return status;
}

/* ---- local searches (study_descent.c), several at once ----
   For the least value of an objective where constraints are at most 0. In: shares of the ranges as starts; every candidate
   is written with few digits, read, drawn and judged as that text says, so that what is found is a design and no rounding
   of one. The best of all that was tried counts, not the last. Each gives the same whatever runs beside it. Of a size that
   watches corners (study_made.c) a device is looked at in all of them only where it would be the best. Cost: `most`
   devices each. */

typedef struct board { /* of all searches of one run */
    fw_study *study;
    fw_study_search *search;
    pthread_mutex_t lock; /* of status and the store */
    fw_status status;
} board;

typedef struct one { /* of one search */
    board *board;
    fw_study_search *s;
    fw_study_sample now;
    fw_study_tried *tried; /* what the search sees of it */
} one;

static int ranged(const fw_study *study) {
    int n = 0;
    for (int k = 0; k < study->nvary; k++)
        n += study->input[k].ntext == 0;
    return n;
}

static fw_status fill(const fw_study *study, const fw_study_search *s, const double *share,
                      fw_study_sample *sample) {
    int at = 0;
    for (int k = 0; k < study->ninput; k++)
        if (k < study->nvary && study->input[k].ntext == 0)
            FW_TRY(fw_study_input_at(&study->input[k], share[at++], s->digits, sample->text[k],
                                     &sample->value[k]));
        else
            memcpy(sample->text[k], s->from->text[k], FW_STUDY_TEXT),
                sample->value[k] = s->from->value[k];
    return FW_OK;
}

/* what was judged, as the search sees it */
static void see(const fw_study_search *s, const fw_study_sample *sample, fw_study_tried *t) {
    t->f = sample->run ? s->objective(s->context, sample) : (double)NAN;
    t->untold = true;
    for (int k = 0; k < s->nconstraint; k++)
        t->c[k] = (double)NAN;
    if (!isnan(t->f)) s->constraint(s->context, sample, t->c, &t->untold);
    if (s->part) s->part(s->context, sample, t->part);
}

/* would it be the best of those that were looked at in all corners? */
static bool is_better(const one *o) {
    const fw_study_search *s = o->s;
    see(s, &o->now, o->tried);
    return fw_study_search_better(o->tried->f, fw_study_tried_worst(o->tried, s->nconstraint),
                                  s->than_f, s->than_c);
}

/* what a device that was looked at in all corners says of those that come later */
static void learn(const one *o, double c) {
    fw_study_search *s = o->s;
    if (s->watch.n == 0 || fw_study_is_partly(&o->now)) return;
    fw_study_watch_add(&s->watch, o->now.corner);
    if (fw_study_search_better(o->tried->f, c, s->than_f, s->than_c))
        s->than_f = o->tried->f, s->than_c = c;
}

/* from the store, or run and kept */
static fw_status evaluate(one *o) {
    board *b = o->board;
    bool there = false, changed = false;
    fw_status status = FW_OK;
    pthread_mutex_lock(&b->lock);
    if (b->status != FW_OK) status = b->status;
    if (status == FW_OK && b->study->store)
        status = fw_study_store_get(b->study->store, o->now.i, &o->now, &there);
    if (status == FW_OK && !there && b->study->stored_only)
        status = fw_diag_error(&b->study->diags, 497, (fw_place){.file = b->study->options.file},
                               "sample %ld is in none of the shards; run the shard that has it to "
                               "its end with --resume",
                               o->now.i);
    pthread_mutex_unlock(&b->lock);
    if (status != FW_OK || there) return status;
    FW_TRY(fw_study_evaluate(b->study, b->study->options.cancel, &o->now, &changed));
    if (fw_study_is_partly(&o->now) && is_better(o)) {
        o->now.watch = NULL;
        FW_TRY(fw_study_evaluate(b->study, b->study->options.cancel, &o->now, &changed));
    }
    if (o->s->besides && o->now.run) FW_TRY(o->s->besides(o->s->beside, &o->now));
    pthread_mutex_lock(&b->lock);
    status = fw_study_keep(b->study, &o->now);
    pthread_mutex_unlock(&b->lock);
    fw_study_tell(b->study);
    return status;
}

/* the best is kept */
static void numbers(one *o) {
    fw_study_search *s = o->s;
    const fw_study_tried *t = o->tried;
    see(s, &o->now, o->tried);
    const double c = fw_study_tried_worst(t, s->nconstraint);
    learn(o, c);
    if (s->keeps_all) fw_study_sample_copy(o->board->study, &o->now, &s->all[s->used - 1]);
    if (s->used > 1 && !fw_study_search_better(t->f, c, s->f, s->c)) return;
    s->f = t->f, s->c = c;
    fw_study_sample_copy(o->board->study, &o->now, &s->best);
}

static bool judge(void *context, fw_study_tried *t) {
    one *o = context;
    board *b = o->board;
    o->tried = t;
    o->now.i = o->s->first + o->s->used++;
    o->now.watch = o->s->watch.n > 0 ? &o->s->watch : NULL;
    if (b->study->told) atomic_fetch_add(&b->study->told->done, 1);
    fw_status status = fill(b->study, o->s, t->x, &o->now);
    if (status == FW_OK) status = evaluate(o);
    if (status == FW_OK) status = fill(b->study, o->s, t->x, &o->now); /* texts, after the store */
    if (status != FW_OK) {
        pthread_mutex_lock(&b->lock);
        if (b->status == FW_OK) b->status = status;
        pthread_mutex_unlock(&b->lock);
        o->now.run = false;
    }
    numbers(o);
    return status == FW_OK;
}

static fw_status search(board *b, fw_study_search *s, fw_arena *arena) {
    one o = {.board = b, .s = s};
    fw_study_descent d = {.n = ranged(b->study),
                          .m = s->nconstraint,
                          .most = s->most,
                          .parts = s->parts,
                          .judge = judge,
                          .context = &o,
                          .tried = s->tried};
    FW_TRY(fw_study_sample_new(arena, b->study, &o.now));
    s->used = 0;
    if (d.n == 0) {
        judge(&o, s->tried);
        return FW_OK;
    }
    if (s->descend) return s->descend(&d, s->start, arena);
    if (s->known && s->begin != FW_NONE) d.from = &s->known[s->begin];
    return s->known ? fw_study_descent_models(&d, s->known, s->nknown, arena)
                    : fw_study_descent_cobyla(&d, s->start, arena);
}

static fw_status search_one(void *context, long i) {
    board *b = context;
    fw_arena *arena = fw_arena_new(0);
    FW_NEED(arena);
    fw_status status = search(b, &b->search[i], arena);
    fw_arena_free(arena);
    return status == FW_OK ? b->status : status;
}

fw_status fw_study_search_from(const fw_study *study, const fw_study_sample *from,
                               fw_study_search *s) {
    int at = 0;
    s->from = from;
    FW_NEED(s->start = fw_arena_array(study->arena, double, (size_t)study->nvary + 1));
    for (int k = 0; k < study->nvary; k++)
        if (study->input[k].ntext == 0)
            s->start[at++] = fw_study_input_share(&study->input[k], from->value[k]);
    return FW_OK;
}

static bool same_lists(const fw_study *study, const fw_study_sample *a, const fw_study_sample *b) {
    for (int k = 0; k < study->nvary; k++)
        if (study->input[k].ntext > 0 && strcmp(a->text[k], b->text[k]) != 0) return false;
    return true;
}

double fw_study_search_apart(const fw_study *study, const fw_study_sample *a,
                             const fw_study_sample *b) {
    double most = 0;
    for (int k = 0; k < study->nvary; k++) {
        const fw_study_input *in = &study->input[k];
        if (in->ntext > 0)
            most = strcmp(a->text[k], b->text[k]) != 0 ? 1 : most;
        else
            most = fmax(most, fabs(a->value[k] - b->value[k]) / (in->to - in->from));
    }
    return most;
}

fw_status fw_study_search_knows(const fw_study *study, fw_study_search *s,
                                const fw_study_sample *sample, int nsample) {
    fw_study_tried *known;
    FW_NEED(known = fw_arena_array(study->arena, fw_study_tried, (size_t)nsample + 1));
    s->known = known, s->begin = FW_NONE;
    for (int i = 0; i < nsample; i++) {
        fw_study_search shares;
        if (!same_lists(study, &sample[i], s->from)) continue;
        if (&sample[i] == s->from) s->begin = s->nknown;
        fw_study_tried *t = &known[s->nknown++];
        FW_NEED(t->c = fw_arena_array(study->arena, double, (size_t)s->nconstraint));
        FW_NEED(t->part = fw_arena_array(study->arena, double, (size_t)s->npart));
        FW_TRY(fw_study_search_from(study, &sample[i], &shares));
        t->x = shares.start;
        see(s, &sample[i], t);
    }
    return FW_OK;
}

static fw_status room_for_tried(const fw_study *study, fw_study_search *s) {
    const size_t n = (size_t)ranged(study), most = (size_t)(s->most > 0 ? s->most : 1);
    double *x = fw_arena_array(study->arena, double, most *n + 1),
           *c = fw_arena_array(study->arena, double, most *(size_t)s->nconstraint + 1),
           *part = fw_arena_array(study->arena, double, most *(size_t)s->npart + 1);
    FW_NEED(x && c && part ? x : NULL);
    FW_NEED(s->tried = fw_arena_array(study->arena, fw_study_tried, most));
    for (size_t i = 0; i < most; i++)
        s->tried[i].x = x + i * n, s->tried[i].c = c + i * (size_t)s->nconstraint,
        s->tried[i].part = part + i * (size_t)s->npart;
    if (!s->keeps_all) return FW_OK;
    FW_NEED(s->all = fw_arena_array(study->arena, fw_study_sample, most));
    for (size_t i = 0; i < most; i++)
        FW_TRY(fw_study_sample_new(study->arena, study, &s->all[i]));
    return FW_OK;
}

fw_status fw_study_search_run(fw_study *study, fw_study_search *search, int n) {
    board b = {.study = study, .search = search};
    for (int i = 0; i < n; i++) {
        search[i].f = search[i].c = (double)NAN;
        FW_TRY(fw_study_sample_new(study->arena, study, &search[i].best));
        FW_TRY(room_for_tried(study, &search[i]));
    }
    pthread_mutex_init(&b.lock, NULL);
    fw_status status = fw_study_each(study, n, search_one, &b);
    pthread_mutex_destroy(&b.lock);
    return status;
}
