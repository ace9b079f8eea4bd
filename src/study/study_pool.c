/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Devices in threads. */
#include "plan/design.h"
#include "study/study_parts.h"
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

fw_status fw_study_keep(fw_study *study, const fw_study_sample *sample) {
    return study->store ? fw_study_store_add(study->store, sample) : FW_OK;
}

/* ---- the same work many times ---- */

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

/* a fifth of a second, or until it is signalled */
static void wait_a_little(pthread_cond_t *signal, pthread_mutex_t *lock) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += 200000000L;
    if (until.tv_nsec >= 1000000000L) until.tv_sec++, until.tv_nsec -= 1000000000L;
    pthread_cond_timedwait(signal, lock, &until);
}

typedef struct queue {
    const fw_study *study;
    fw_status (*one)(void *context, long i);
    void *context;
    pthread_mutex_t lock; /* of what follows */
    pthread_cond_t ended; /* a thread is at its end */
    int running;
    long n, next;
    fw_status status; /* the first that is not FW_OK */
} queue;

static void *in_thread(void *argument) {
    queue *q = argument;
    locale_t before = uselocale(q->study->design->locale);
    pthread_mutex_lock(&q->lock);
    while (q->next < q->n && q->status == FW_OK) {
        long i = q->next++;
        pthread_mutex_unlock(&q->lock);
        fw_status status = q->one(q->context, i);
        pthread_mutex_lock(&q->lock);
        if (q->status == FW_OK) q->status = status;
    }
    q->running--;
    pthread_cond_signal(&q->ended);
    pthread_mutex_unlock(&q->lock);
    uselocale(before);
    return NULL;
}

fw_status fw_study_each(const fw_study *study, long n, fw_status (*one)(void *context, long i),
                        void *context) {
    queue q = {.study = study, .one = one, .context = context, .n = n};
    pthread_t thread[FW_JOBS_MOST];
    int jobs = fw_study_jobs(study), running = 0;
    pthread_mutex_init(&q.lock, NULL);
    pthread_cond_init(&q.ended, NULL);
    pthread_mutex_lock(&q.lock);
    for (; jobs > 1 && running < jobs && running < n; running++, q.running++)
        if (pthread_create(&thread[running], NULL, in_thread, &q) != 0) break;
    while (q.running > 0) { /* others work, and this thread says how far they are */
        wait_a_little(&q.ended, &q.lock);
        pthread_mutex_unlock(&q.lock);
        fw_study_tell(study);
        pthread_mutex_lock(&q.lock);
    }
    pthread_mutex_unlock(&q.lock);
    if (running == 0) in_thread(&q);
    for (int i = 0; i < running; i++)
        pthread_join(thread[i], NULL);
    pthread_cond_destroy(&q.ended);
    pthread_mutex_destroy(&q.lock);
    return q.status;
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
    pthread_mutex_t lock;
    pthread_cond_t given, ended;
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

static void *worker(void *argument) {
    pool *p = argument;
    pthread_mutex_lock(&p->lock);
    for (;;) {
        slot *s = find(p, GIVEN);
        if (!s && p->over) break;
        if (!s) {
            pthread_cond_wait(&p->given, &p->lock);
            continue;
        }
        s->state = TAKEN;
        pthread_mutex_unlock(&p->lock);
        bool changed = false;
        s->status = fw_study_evaluate(p->study, p->study->options.cancel, &s->sample, &changed);
        pthread_mutex_lock(&p->lock);
        p->changed = p->changed || changed;
        s->state = ENDED;
        pthread_cond_signal(&p->ended);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
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
        pthread_mutex_unlock(&p->lock);
        if (s->status == FW_OK) {
            fw_status status = fw_study_keep(p->study, &s->sample);
            if (status == FW_OK && p->work->take)
                status = p->work->take(p->work->context, &s->sample);
            end_with(p, status);
            count(p);
        }
        tell(p);
        pthread_mutex_lock(&p->lock);
        s->state = FREE;
    }
}

static void wait_ended(pool *p) {
    wait_a_little(&p->ended, &p->lock);
    pthread_mutex_unlock(&p->lock);
    tell(p);
    pthread_mutex_lock(&p->lock);
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

static void run(pool *p) {
    pthread_mutex_lock(&p->lock);
    for (long k = 0; k < p->work->n && p->status == FW_OK;) {
        take_ended(p);
        slot *s = find(p, FREE);
        if (!s) {
            wait_ended(p);
            continue;
        }
        bool given;
        pthread_mutex_unlock(&p->lock);
        fw_status status = give(p, s, k++, &given);
        pthread_mutex_lock(&p->lock);
        if (status != FW_OK) end_with(p, status);
        if (status != FW_OK || !given) continue;
        s->state = GIVEN;
        pthread_cond_signal(&p->given);
    }
    p->over = true;
    if (p->status != FW_OK) /* what was not begun is not */
        for (int i = 0; i < p->nslot; i++)
            if (p->slot[i].state == GIVEN) p->slot[i].state = FREE;
    pthread_cond_broadcast(&p->given);
    while (find(p, GIVEN) || find(p, TAKEN) || find(p, ENDED)) {
        take_ended(p);
        if (find(p, GIVEN) || find(p, TAKEN)) wait_ended(p);
    }
    pthread_mutex_unlock(&p->lock);
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

static fw_status with_threads(pool *p, int jobs) {
    pthread_t *thread = fw_arena_array(p->scratch, pthread_t, (size_t)jobs);
    int n = 0;
    FW_NEED(thread);
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->given, NULL);
    pthread_cond_init(&p->ended, NULL);
    while (n < jobs && pthread_create(&thread[n], NULL, worker, p) == 0)
        n++;
    if (n > 0)
        run(p);
    else
        run_alone(p);
    for (int i = 0; i < n; i++)
        pthread_join(thread[i], NULL);
    pthread_mutex_destroy(&p->lock);
    pthread_cond_destroy(&p->given);
    pthread_cond_destroy(&p->ended);
    return FW_OK;
}

static fw_status run_work(pool *p, int jobs) {
    p->nslot = jobs > 1 ? 2 * jobs : 1;
    FW_NEED(p->slot = fw_arena_array(p->scratch, slot, (size_t)p->nslot));
    for (int i = 0; i < p->nslot; i++)
        FW_TRY(fw_study_sample_new(p->scratch, p->study, &p->slot[i].sample));
    if (jobs > 1)
        FW_TRY(with_threads(p, jobs));
    else
        run_alone(p);
    if (p->changed)
        return fw_diag_error(&p->study->diags, 500, (fw_place){.file = p->study->device_path},
                             "the device file, or a pack or drawing that it names, was changed "
                             "while the study ran; run it again (its samples so far are of the "
                             "former one)");
    return p->status;
}

fw_status fw_study_pool_run(fw_study *study, const fw_study_work *work) {
    int jobs = fw_study_jobs(study);
    if (jobs > work->n) jobs = work->n > 0 ? (int)work->n : 1;
    pool p = {.study = study, .work = work, .scratch = fw_arena_part(study->arena, 0)};
    FW_NEED(p.scratch);
    p.begun_s = fw_study_now_s();
    fw_status status = run_work(&p, jobs);
    fw_arena_free(p.scratch);
    return status;
}
