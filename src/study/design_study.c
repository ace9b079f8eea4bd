/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fw_design_study of the public library: a study with the options and settings of a design. */
#include "plan/design.h"
#include "study/study_store.h"
#include "study/study.h"
#include <string.h>

typedef struct asked {
    const char *file;
    fw_study_settings settings;
    const char *json;
    size_t length;
} asked;

/* the design's own progress is told of devices */
static void told(void *context, long done, long all, double seconds) {
    fw_design *d = context;
    (void)seconds;
    fw_arena_tell(d->plan->arena, "judging devices", (double)done, (double)all, "devices");
}

static fw_status run(fw_study *study, fw_design *d, asked *a) {
    fw_text json = fw_text_new(d->plan->arena);
    FW_TRY(fw_study_run(study));
    if (a->settings.shards > 0) return FW_OK; /* merging makes the results */
    FW_TRY(fw_study_write(study));
    FW_TRY(fw_study_json(study, &json));
    a->json = json.data, a->length = json.length;
    return FW_OK;
}

static fw_status work(fw_design *d, void *argument) {
    asked *a = argument;
    const fw_study_options o = {.design = d->given,
                                .set = d->set,
                                .nset = d->plan->options.nset,
                                .file = a->file,
                                .study = a->settings.study,
                                .output = a->settings.directory,
                                .jobs = a->settings.jobs,
                                .shard = a->settings.shard,
                                .shards = a->settings.shards,
                                .resume = a->settings.resume != 0,
                                .cancel = &d->cancel,
                                .progress = told,
                                .progress_context = d};
    fw_study *study;
    fw_status status = fw_study_open(&o, &study);
    FW_NEED(study);
    if (status == FW_OK) status = run(study, d, a);
    fw_diags_take(&d->plan->diags, &study->diags);
    fw_study_free(study);
    return d->plan->diags.failed ? FW_NOMEM : status;
}

static const char *wrong(const fw_study_settings *s) {
    if (!s->directory || !s->directory[0]) return "a study needs a directory for its samples";
    if (s->jobs < 0 || s->jobs > FW_STUDY_JOBS_MOST) return "jobs of a study are 1 to 256, or 0";
    if (s->shards < 0 || s->shards > FW_STUDY_SHARDS_MOST ||
        (s->shards > 0 && (s->shard < 1 || s->shard > s->shards)))
        return "shard of a study is 1 to shards, and shards at most 100000; 0 and 0: all of it";
    return NULL;
}

int fw_design_study(fw_design *design, const char *file, const fw_study_settings *settings,
                    const char **json, size_t *length) {
    asked a = {.file = file};
    if (json) *json = NULL;
    if (length) *length = 0;
    if (!design) return FW_STATUS_USAGE;
    if (!file || !settings || settings->size < offsetof(fw_study_settings, study) ||
        settings->size > 4096)
        return (int)fw_plan_design_usage(design, "a study needs a file and its settings");
    memcpy(&a.settings, settings,
           settings->size < sizeof a.settings ? settings->size : sizeof a.settings);
    if (wrong(&a.settings)) return (int)fw_plan_design_usage(design, wrong(&a.settings));
    int status = fw_plan_design_run(design, work, &a);
    if (status == FW_STATUS_OK && json) *json = a.json;
    if (status == FW_STATUS_OK && length) *length = a.length;
    return status;
}
