/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/estimate.h"
#include "chance/automatic.h"
#include "chance/estimators.h"
#include <string.h>

static const struct method {
    const char *id, *text;
} methods[] = {
#define ROW(name, id, text) {id, text},
    FW_CHANCE_METHODS(ROW)
#undef ROW
};

const char *fw_chance_method_id(fw_chance_method method) {
    return methods[method].id;
}

const char *fw_chance_method_text(fw_chance_method method) {
    return methods[method].text;
}

fw_status fw_chance_method_find(const char *id, fw_chance_method *method) {
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        if (strcmp(methods[i].id, id) == 0) {
            *method = (fw_chance_method)i;
            return FW_OK;
        }
    return FW_INPUT;
}

static fw_status run_of(fw_arena *arena, const fw_chance_limit *limit, const fw_chance_options *o,
                        fw_chance_run *run, const char **why) {
    *run = (fw_chance_run){.arena = arena,
                           .limit = limit,
                           .seed = o->seed,
                           .budget = o->budget,
                           .batch = o->batch ? o->batch : FW_CHANCE_BATCH,
                           .level = o->level != 0 ? o->level : 0.95};
    if (limit->dimensions < 1)
        *why = "nothing scatters, so that there is no probability to be estimated";
    else if (o->budget < FW_CHANCE_BUDGET_LEAST)
        *why = "a probability takes at least 200 evaluations";
    else if (!(run->level > 0 && run->level < 1))
        *why = "the level of an interval is above 0 and below 1";
    else
        return FW_OK;
    return FW_INPUT;
}

static fw_status by_method(fw_chance_run *run, fw_chance_method method, fw_chance_estimate *out) {
    switch (method) {
    case FW_CHANCE_AUTO:
        return fw_chance_automatic(run, out);
    case FW_CHANCE_MONTE_CARLO:
        return fw_chance_monte_carlo(run, out);
    case FW_CHANCE_QUASI:
        return fw_chance_quasi(run, out);
    case FW_CHANCE_IMPORTANCE:
        return fw_chance_around_points(run, out);
    case FW_CHANCE_SUBSET:
        return fw_chance_in_subsets(run, out);
    }
    return FW_INTERNAL;
}

fw_status fw_chance_estimate_run(fw_arena *arena, const fw_chance_limit *limit,
                                 const fw_chance_options *options, fw_chance_estimate *out,
                                 const char **why) {
    fw_chance_run run;
    *why = NULL;
    FW_TRY(run_of(arena, limit, options, &run, why));
    *out =
        (fw_chance_estimate){.method = options->method, .reason = "asked for", .level = run.level};
    FW_TRY(by_method(&run, options->method, out));
    out->evaluations = run.used;
    out->unevaluated = run.unevaluated;
    return FW_OK;
}
