/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The results of a study as documents: JSON (schema flexwright.study/1), CSV (a row each sample), a text for a
   terminal, pictures and one page. After fw_study_run. */
#ifndef FW_STUDY_STUDY_WRITE_H
#define FW_STUDY_STUDY_WRITE_H
#include "study/study.h"

fw_status fw_study_json(const fw_study *study, fw_text *out);
fw_status fw_study_text(const fw_study *study, fw_text *out);
/* inputs and responses as they were asked for; before it runs, too */
fw_status fw_study_asked_text(const fw_study *study, fw_text *out);
/* rows go to the file as they are read: memory does not grow with them */
fw_status fw_study_csv_save(fw_study *study, const char *path);

typedef struct fw_study_picture {
    const char *name;  /* "map-C", of its file NAME.svg */
    const char *title; /* a sentence */
    fw_text svg;
} fw_study_picture;
/* what there is to look at, by kind */
fw_status fw_study_pictures(fw_study *study, const fw_study_picture **picture, int *n);

/* the page: the pictures, which are also files of their own, and the numbers; it needs nothing beside it */
fw_status fw_study_html(const fw_study *study, const fw_study_picture *picture, int n,
                        fw_text *out);

/* study.json, study.csv, study.html and pictures/ into the output directory, each whole or not at all */
fw_status fw_study_write(fw_study *study);

#endif
