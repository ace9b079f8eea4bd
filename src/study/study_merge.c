/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/study_merge.h"
#include "study/study_parts.h"
#include <sys/stat.h>

fw_status fw_study_open_merge(const fw_study_options *options, const char *directory,
                              fw_study **out) {
    fw_study *study = fw_study_new(options);
    *out = study;
    FW_NEED(study);
    const char *file, *name;
    FW_TRY(fw_study_store_said(study->arena, &study->diags, directory, "file", &file));
    FW_TRY(fw_study_store_said(study->arena, &study->diags, directory, "study", &name));
    if (!file || !name)
        return fw_diag_error(&study->diags, 497, (fw_place){.file = directory},
                             "its store does not say which study it is of");
    study->options.file = file;
    study->options.study = name;
    return fw_study_open_in(study);
}

fw_status fw_study_merge(fw_study *study, const char *const *directory, int n) {
    mkdir(study->options.output, 0777); /* what is wrong with it, the store will say */
    FW_TRY(fw_study_store_open(study, &study->store));
    FW_TRY(fw_study_store_merge(study->store, directory, n));
    study->stored_only = true;
    return fw_study_run(study);
}
