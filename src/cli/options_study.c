/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the options of study take. */
#include "cli/options_study.h"
#include <math.h>
#include <string.h>

const char *fw_cli_take_study(fw_cli_options *o, const char *v) {
    o->study = v;
    return *v ? NULL : "needs the name of a study";
}

const char *fw_cli_take_jobs(fw_cli_options *o, const char *v) {
    double n;
    if (!fw_number_parse(v, strlen(v), &n) || n != floor(n) || n < 1 || n > 256)
        return "is not a whole number from 1 to 256";
    o->jobs = (int)n;
    return NULL;
}

const char *fw_cli_take_shard(fw_cli_options *o, const char *v) {
    size_t n = strcspn(v, "/");
    double shard, shards;
    bool read = v[n] == '/' && fw_number_parse(v, n, &shard) &&
                fw_number_parse(v + n + 1, strlen(v + n + 1), &shards);
    if (!read || shard != floor(shard) || shards != floor(shards) || shards < 1 ||
        shards > 100000 || shard < 1 || shard > shards)
        return "is not I/N with whole numbers from 1 to 100000, I at most N";
    o->shard = (int)shard, o->shards = (int)shards;
    return NULL;
}

const char *fw_cli_take_resume(fw_cli_options *o, const char *v) {
    (void)v;
    o->resume = true;
    return NULL;
}

const char *fw_cli_take_plan_only(fw_cli_options *o, const char *v) {
    (void)v;
    o->plan_only = true;
    return NULL;
}
