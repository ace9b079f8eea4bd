/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plan/design.h"
#include "study/study_parts.h"
#include <pthread.h>
#include <unistd.h>

int fw_study_jobs(const fw_study *study) {
    long there = sysconf(_SC_NPROCESSORS_ONLN);
    int jobs = study->options.jobs > 0 ? study->options.jobs : there > 0 ? (int)there : 1;
    return jobs > FW_STUDY_JOBS_MOST ? FW_STUDY_JOBS_MOST : jobs;
}

typedef struct queue {
    const fw_study *study;
    fw_status (*one)(void *context, long i);
    void *context;
    pthread_mutex_t lock; /* of what follows */
    long n, next;
    fw_status status; /* the first that is not FW_OK */
} queue;

static void *worker(void *argument) {
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
    pthread_mutex_unlock(&q->lock);
    uselocale(before);
    return NULL;
}

fw_status fw_study_each(const fw_study *study, long n, fw_status (*one)(void *context, long i),
                        void *context) {
    queue q = {.study = study, .one = one, .context = context, .n = n};
    pthread_t thread[FW_STUDY_JOBS_MOST];
    int jobs = fw_study_jobs(study), running = 0;
    pthread_mutex_init(&q.lock, NULL);
    for (; jobs > 1 && running < jobs && running < n; running++)
        if (pthread_create(&thread[running], NULL, worker, &q) != 0) break;
    if (running == 0) worker(&q);
    for (int i = 0; i < running; i++)
        pthread_join(thread[i], NULL);
    pthread_mutex_destroy(&q.lock);
    return q.status;
}
