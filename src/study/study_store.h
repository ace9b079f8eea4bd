/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The samples of a study on disk: DIR/study.sqlite, a row each, which other programs may ask with
   ordinary SQL while the study runs (write-ahead log). Rows come in any order; when all are there the
   file is written once more in the order of their numbers, so that its bytes depend on nothing but
   the samples. Memory does not grow with them.

     study(key, value)    what it is of: hash, name, kind, seed, shard ...
     sample(i, state, why, limit_used, INPUT..., RESPONSE...)
                          state: accept, reject, inconclusive, run (not judged), failed; inputs and
                          responses in SI under their own names, listed words as text

   Test: tests/cli/test_study.py */
#ifndef FW_STUDY_STUDY_STORE_H
#define FW_STUDY_STUDY_STORE_H
#include "study/study.h"

typedef struct fw_study_store fw_study_store;

/* Opens or makes the store of the study's output directory. resume: one that is there goes on, if it is
   of this study (FW-D495); else one that is there is begun anew, and anything that is no store of ours is left
   alone (FW-D496). */
fw_status fw_study_store_open(fw_study *study, fw_study_store **store);
/* commits what is open; NULL allowed */
void fw_study_store_close(fw_study_store *store);
/* FW_IO: FW-D496, and what was added before is whole */
fw_status fw_study_store_add(fw_study_store *store, const fw_study_sample *sample);
/* is sample i there? Then inputs, responses and decision are filled in */
fw_status fw_study_store_get(fw_study_store *store, long i, fw_study_sample *sample, bool *found);
long fw_study_store_count(fw_study_store *store);
/* all of them by number; `row` has the store's own room for inputs and responses. Texts of inputs are
   there only where values are listed. */
fw_status fw_study_store_each(fw_study_store *store,
                              fw_status (*row)(void *context, const fw_study_sample *sample),
                              void *context);
/* the file written once more, in order, without a log; the store stays open for reading */
fw_status fw_study_store_finish(fw_study_store *store);
/* the rows of the shards' stores into this one: FW-D497 where one is of another study, missing, twice
   or not complete */
fw_status fw_study_store_merge(fw_study_store *store, const char *const *directory, int n);
/* what a store says of itself under a key ("file"), for merging; *value NULL: nothing */
fw_status fw_study_store_said(fw_arena *arena, fw_diags *diags, const char *directory,
                              const char *key, const char **value);

#endif
