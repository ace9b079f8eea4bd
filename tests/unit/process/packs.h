/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the packs of the source tree, with text replaced on the way. */
#ifndef FW_TESTS_PACKS_H
#define FW_TESTS_PACKS_H
#include "base/output.h"
#include "plain_facts.h"
#include "process/process.h"
#include "test.h"

#define COPPER  "copper-on-porous-silicon"
#define SILICON "al-masked-rie"

static inline const char *pack_text(fw_arena *arena, const char *name, size_t *n) {
    fw_diags diags = fw_diags_new(arena);
    const char *path = fw_arena_printf(arena, "%s/processes/%s.xml", FW_TEST_SOURCE_DIR, name);
    char **data = fw_arena_one(arena, char *);
    assert_true(path && data);
    assert_int_equal(fw_input_read(arena, path, 1u << 23, &diags, data, n), FW_OK);
    return *data;
}

/* `from` must be there; NULL: as it is */
static inline const char *replaced(fw_arena *arena, const char *text, const char *from,
                                   const char *to, size_t *n) {
    if (!from) return text;
    const char *at = strstr(text, from);
    if (!at) fail_msg("'%s' is not in the pack", from);
    const char *head = fw_arena_strndup(arena, text, (size_t)(at - text));
    assert_non_null(head);
    const char *out = fw_arena_printf(arena, "%s%s%s", head, to, at + strlen(from));
    assert_non_null(out);
    *n = strlen(out);
    return out;
}

static inline fw_process_flow *read_pack(fw_arena *arena, const char *name, const char *from,
                                         const char *to, fw_diags *diags) {
    size_t nb = 0, n = 0;
    fw_process_flow *flow = NULL;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, name, &n);
    text = replaced(arena, text, from, to, &n);
    fw_status status =
        fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", text, n, diags, &flow);
    assert_true((status == FW_OK) == (flow != NULL));
    assert_true(status == FW_OK || status == FW_INPUT);
    return flow;
}

static inline fw_process_step *step_of(fw_process_flow *flow, const char *id) {
    for (int i = 0; i < flow->nstep; i++)
        if (strcmp(flow->step[i].id, id) == 0) return &flow->step[i];
    fail_msg("no step %s", id);
    return NULL;
}

/* as a laboratory would state it */
static inline void measured(fw_process_flow *flow, const char *id, double value,
                            double uncertainty) {
    fw_quantity *q = (fw_quantity *)fw_process_flow_quantity(flow, id);
    assert_non_null(q);
    q->unknown = false;
    q->value = value;
    q->uncertainty = uncertainty;
    q->status = FW_MEASURED;
}

#endif
