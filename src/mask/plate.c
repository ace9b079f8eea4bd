/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which layers make the plate: "1/0 NOT 2/0 NOT 3/0". */
#include "mask/order.h"
#include <stdlib.h>
#include <string.h>

static int layer_named(const fw_mask_table *table, const char *s, char **end) {
    if (*s < '0' || *s > '9') return -1;
    long layer = strtol(s, end, 10), datatype = -1;
    if (**end != '/' || (*end)[1] < '0' || (*end)[1] > '9') return -1;
    datatype = strtol(*end + 1, end, 10);
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].layer == layer && table->layer[k].datatype == datatype) return k;
    return -1;
}

/* behind "AND " and so on, or NULL */
static const char *behind_operator(const char *s) {
    static const char *const word[] = {" AND ", " OR ", " NOT ", " XOR "};
    for (int i = 0; i < 4; i++)
        if (strncmp(s, word[i], strlen(word[i])) == 0) return s + strlen(word[i]);
    return NULL;
}

bool fw_mask_plate_layers(const fw_mask_table *table, bool *named, int *first, const char **wrong) {
    const char *s = table->plate;
    *first = -1;
    while (s) {
        char *end;
        int k = layer_named(table, s, &end);
        *wrong = s;
        if (k < 0) return false;
        if (*first < 0) *first = k;
        if (named) named[k] = true;
        s = *end ? behind_operator(end) : NULL;
        *wrong = end;
        if (*end && !s) return false;
    }
    return true;
}

/* the operator before `s` */
static fw_geometry_set_rule rule_before(const char *s) {
    static const struct {
        const char *word;
        fw_geometry_set_rule rule;
    } known[] = {{" AND ", FW_SET_AND}, {" NOT ", FW_SET_NOT}, {" XOR ", FW_SET_XOR}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strncmp(s - strlen(known[i].word), known[i].word, strlen(known[i].word)) == 0)
            return known[i].rule;
    return FW_SET_OR;
}

fw_status fw_mask_plate_terms(fw_arena *arena, const fw_mask_table *table,
                              fw_mask_plate_term **term, int *n) {
    *n = 0;
    size_t most = table->plate ? strlen(table->plate) / 3 + 1 : (size_t)table->nlayer;
    FW_NEED(*term = fw_arena_array(arena, fw_mask_plate_term, most));
    for (int k = 0; !table->plate && k < table->nlayer; k++)
        if (table->layer[k].biased) (*term)[(*n)++] = (fw_mask_plate_term){k, FW_SET_OR};
    for (const char *s = table->plate; s;) {
        char *end;
        int k = layer_named(table, s, &end);
        if (k < 0) return FW_INPUT; /* cannot be: the table was read */
        (*term)[(*n)++] = (fw_mask_plate_term){k, s == table->plate ? FW_SET_OR : rule_before(s)};
        s = *end ? behind_operator(end) : NULL;
    }
    return FW_OK;
}
