/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/limit_kinds.h"
#include <math.h>
#include <string.h>

static const fw_limit_row table[FW_LIMITS] = {
    {"strength", "the strength that the device file states, alone", fw_limit_stated},
    {"fracture", "the strength of what breaks: plain, or at a failure probability",
     fw_limit_fracture},
    {"yield", "the proportional limit of metals; for survival the 0.2 % offset", fw_limit_yield},
    {"fatigue", "the amplitude that lasts a number of cycles", fw_limit_fatigue},
};

const fw_limit_row *fw_limit_rows(size_t *count) {
    *count = FW_LIMITS;
    return table;
}

bool fw_limit_known(const fw_quantity *q) {
    return q->id && !q->unknown;
}

bool fw_limit_brittle(const fw_material *material) {
    return material->criterion && strncmp(material->criterion, "fracture", 8) == 0;
}

void fw_limit_plain(const fw_quantity *q, const char *definition, fw_limit *limit) {
    limit->allowable_Pa = q->value;
    limit->status = q->status;
    limit->source = q->source ? q->source : "";
    limit->definition = definition;
}

fw_value_status fw_limit_weakest(const fw_quantity *const *q, int n) {
    fw_value_status worst = FW_MEASURED;
    for (int i = 0; i < n; i++)
        if (q[i]->status > worst) worst = q[i]->status;
    return worst;
}

/* Material -> what it allows this flexure. A stated strength is the only static one.
   Cost: one pow per criterion. Test: test_limits.c the_lowest_governs, a_stated_strength_is_alone
 */
void fw_limits_of(const fw_limit_input *in, fw_limits *limits) {
    *limits = (fw_limits){.governing = FW_NONE, .fatigue = FW_NONE};
    for (size_t i = 0; i < FW_LIMITS; i++) {
        fw_limit found = {.criterion = table[i].name};
        bool fatigue = table[i].of == fw_limit_fatigue;
        if (limits->count > 0 && in->material->strength_stated && !fatigue) continue;
        if (!table[i].of(in, limits, &found)) continue;
        int k = limits->count++;
        limits->item[k] = found;
        if (fatigue)
            limits->fatigue = k;
        else if (limits->governing == FW_NONE ||
                 found.allowable_Pa < limits->item[limits->governing].allowable_Pa)
            limits->governing = k;
    }
}

const fw_limit *fw_limits_governing(const fw_limits *limits) {
    return limits->governing == FW_NONE ? NULL : &limits->item[limits->governing];
}
