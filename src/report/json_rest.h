/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FW_REPORT_JSON_REST_H
#define FW_REPORT_JSON_REST_H
#include "statics/modes.h"
#include "statics/pull_in.h"
#include "report/json_common.h"

/* {"BODY": [x, y, phi]} from 3 numbers per body */
json_t *fw_json_by_body(const fw_mechanism *mechanism, const double *triples, bool *failed);
json_t *fw_json_pull_in(const fw_pull_in *p, bool *failed);
json_t *fw_json_rank(const fw_row_rank *rank, bool *failed);
#endif
