/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shards of a study, run apart without a word between them, put together. */
#ifndef FW_STUDY_STUDY_MERGE_H
#define FW_STUDY_STUDY_MERGE_H
#include "study/study.h"

/* as fw_study_open, of the file and the study that the store of a shard names */
fw_status fw_study_open_merge(const fw_study_options *options, const char *directory,
                              fw_study **study);
/* the rows of all shards into options.output, then the result: the same bytes as of one run. FW-D497: a
   shard is missing, twice, not complete or of another study */
fw_status fw_study_merge(fw_study *study, const char *const *directory, int n);

#endif
