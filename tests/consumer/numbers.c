/* SPDX-License-Identifier: GPL-3.0-or-later */
/* numbers DEVICE.xml [DATA_DIRECTORY]: numbers without JSON, in the common part of C and C++: which share
   of its limit each hinge uses, where the platform is at the end of the first scene, how far the work is.
   Exit status: 0, or 100 + status. */
#include <flexwright.h>
#include <stdio.h>
#include <string.h>

static const double *reals(fw_design *design, int numbers, const char *name) {
    const fw_array *a = fw_design_array_named(design, numbers, name);
    return a && a->type == FW_ARRAY_REAL ? (const double *)a->data : NULL;
}

static int told(void *context, const char *what, double done, double of, const char *unit) {
    (void)what, (void)done, (void)of, (void)unit;
    ++*(long *)context;
    return 0; /* not 0 cancels */
}

static int hinges(fw_design *design) {
    const fw_array *drawn = fw_design_array_named(design, FW_NUMBERS_HINGES, "utilisation");
    const double *made = reals(design, FW_NUMBERS_HINGES, "made_utilisation");
    if (!drawn || !made) return FW_STATUS_INTERNAL;
    for (size_t i = 0; i < drawn->extent[0]; i++)
        printf("hinge %s: %.1f %% as drawn, %.1f %% as made\n", drawn->label[0][i],
               100 * ((const double *)drawn->data)[i], 100 * made[i]);
    return FW_STATUS_OK;
}

/* rows x bodies x (x, y, phi) */
static int platform(fw_design *design, const char *body) {
    const fw_array *q = fw_design_array_named(design, FW_NUMBERS_MOTION, "q");
    const double *t = reals(design, FW_NUMBERS_MOTION, "t");
    if (!q || !t || q->dimensions != 3) return FW_STATUS_INTERNAL;
    const size_t rows = q->extent[0], bodies = q->extent[1];
    for (size_t b = 0; b < bodies; b++) {
        const double *end = (const double *)q->data + ((rows - 1) * bodies + b) * q->extent[2];
        if (strcmp(q->label[1][b], body) != 0) continue;
        printf("%s at %g ms: x %.3f um, y %.3f um, phi %.5f rad (%s)\n", body, 1e3 * t[rows - 1],
               1e6 * end[0], 1e6 * end[1], end[2], q->unit);
        return FW_STATUS_OK;
    }
    return FW_STATUS_INTERNAL;
}

int main(int argc, char **argv) {
    fw_design_options options = fw_design_options_default();
    long times = 0;
    if (argc < 2 || argc > 3) {
        fprintf(stderr, "usage: numbers DEVICE.xml [DATA_DIRECTORY]\n");
        return 99;
    }
    if (argc > 2) options.data_directory = argv[2];
    fw_design *design = fw_design_new(&options);
    if (!design) return 100 + FW_STATUS_NOMEM;
    int status = fw_design_progress(design, told, &times);
    if (status == FW_STATUS_OK) status = fw_design_read(design, argv[1]);
    if (status == FW_STATUS_OK) status = fw_design_judge(design);
    if (status == FW_STATUS_OK) status = hinges(design);
    if (status == FW_STATUS_OK) status = fw_design_simulate(design);
    if (status == FW_STATUS_OK) status = platform(design, "CD");
    if (status == FW_STATUS_OK) printf("told of progress: %s\n", times > 0 ? "yes" : "no");
    for (size_t i = 0; status != FW_STATUS_OK && i < fw_design_diagnostics(design); i++)
        fprintf(stderr, "%s\n", fw_design_diagnostic(design, i)->message);
    fw_design_free(design);
    return status == FW_STATUS_OK ? 0 : 100 + status;
}
