/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plates of a table: which there are, what they draw, how well they lie on each other, and the lists that
   contents add to. */
#include "layout/layout.h"
#include "mask/mask_parts.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- plates and their lists ---- */

int fw_mask_plates(const fw_mask_table *table) {
    return table->nplate ? table->nplate : 1;
}

fw_mask_plate_row fw_mask_plate_at(const fw_mask_table *table, int i) {
    if (table->nplate) return table->plates[i];
    return (fw_mask_plate_row){.id = "device",
                               .title = "the device",
                               .layers = table->plate,
                               .reading = table->reading,
                               .order = table->order,
                               .overlay_m = (double)NAN};
}

int fw_mask_plate_named(const fw_mask_table *table, const char *id) {
    for (int i = 0; id && i < table->nplate; i++)
        if (strcmp(table->plates[i].id, id) == 0) return i;
    return -1;
}

double fw_mask_content_m(const fw_mask_table *table, const char *kind, const char *parameter) {
    for (int i = 0; i < table->ncontent; i++) {
        const fw_mask_content_kind *k = table->content[i].kind;
        for (int j = 0; strcmp(k->name, kind) == 0 && j < k->nparameter; j++)
            if (strcmp(k->parameter[j].name, parameter) == 0) return table->content[i].value[j];
    }
    return (double)NAN;
}

fw_status fw_mask_sheet_add(fw_mask_sheet *sheet, fw_layout_role role, int body, const char *label,
                            const fw_geometry_contour *contour) {
    fw_layout_piece piece = {
        .role = role, .body = body, .joint = FW_NONE, .label = label, .contour = *contour};
    return fw_layout_add(sheet->arena, piece, &sheet->piece, &sheet->npiece, &sheet->capacity);
}

fw_status fw_mask_verdict_add(fw_mask_verdict *verdict, const char *text) {
    FW_NEED(text);
    if (verdict->n == verdict->room) {
        int more = 2 * verdict->room + 8;
        FW_NEED(verdict->reason = fw_arena_grow(verdict->arena, verdict->reason, (size_t)verdict->n,
                                                (size_t)more, sizeof *verdict->reason));
        verdict->room = more;
    }
    verdict->reason[verdict->n++] = text;
    return FW_OK;
}

/* ---- which layers make a plate: "1/0 NOT 2/0 NOT 3/0" ---- */

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

bool fw_mask_plate_layers(const fw_mask_table *table, const char *layers, bool *named, int *first,
                          const char **wrong) {
    const char *s = layers;
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

bool fw_mask_plate_draws(const fw_mask_table *table, int plate, int layer) {
    for (const char *s = fw_mask_plate_at(table, plate).layers; s;) {
        char *end;
        int k = layer_named(table, s, &end);
        if (k < 0 || k == layer) return k == layer;
        s = *end ? behind_operator(end) : NULL;
    }
    return false;
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
    return fw_mask_plate_terms_of(arena, table, table->device_plate, term, n);
}

fw_status fw_mask_plate_terms_of(fw_arena *arena, const fw_mask_table *table, int plate,
                                 fw_mask_plate_term **term, int *n) {
    const char *layers = fw_mask_plate_at(table, plate).layers;
    *n = 0;
    size_t most = layers ? strlen(layers) / 3 + 1 : (size_t)table->nlayer;
    FW_NEED(*term = fw_arena_array(arena, fw_mask_plate_term, most));
    for (int k = 0; !layers && k < table->nlayer; k++)
        if (table->layer[k].biased) (*term)[(*n)++] = (fw_mask_plate_term){k, FW_SET_OR};
    for (const char *s = layers; s;) {
        char *end;
        int k = layer_named(table, s, &end);
        if (k < 0) return FW_INPUT; /* cannot be: the table was read */
        (*term)[(*n)++] = (fw_mask_plate_term){k, s == layers ? FW_SET_OR : rule_before(s)};
        s = *end ? behind_operator(end) : NULL;
    }
    return FW_OK;
}

/* ---- how well plates lie on each other ----
   Each is put on one that was printed before, within a budget.

   Between two plates lie the budgets of both ways back to where they meet, added, since the errors of one alignment and of
   the next may lie the same way. In: rows <plate>. Out: m. Test: test_plates.c. */

/* budgets of the rows from a plate back to the first, added: errors of one alignment and the next may lie the same way */
static double from_first(const fw_mask_table *table, int plate) {
    double sum = 0.0;
    for (int steps = 0; plate >= 0 && steps < table->nplate; steps++) {
        if (!isnan(table->plates[plate].overlay_m)) sum += table->plates[plate].overlay_m;
        plate = fw_mask_plate_named(table, table->plates[plate].aligned_to);
    }
    return sum;
}

static bool is_before(const fw_mask_table *table, int early, int late) {
    for (int steps = 0; late >= 0 && steps <= table->nplate; steps++) {
        if (late == early) return true;
        late = fw_mask_plate_named(table, table->plates[late].aligned_to);
    }
    return false;
}

/* over the plate where both ways back meet */
double fw_mask_overlay_between_m(const fw_mask_table *table, int a, int b) {
    int meet = a;
    for (int steps = 0; meet >= 0 && !is_before(table, meet, b) && steps < table->nplate; steps++)
        meet = fw_mask_plate_named(table, table->plates[meet].aligned_to);
    double shared = meet >= 0 ? from_first(table, meet) : 0.0;
    return from_first(table, a) + from_first(table, b) - 2.0 * shared;
}

int fw_mask_plate_of_role(const fw_mask_table *table, fw_layout_role role) {
    for (int p = 0; p < table->nplate; p++)
        for (int k = 0; k < table->nlayer; k++)
            if (table->layer[k].roles & 1u << role && fw_mask_plate_draws(table, p, k)) return p;
    return -1;
}

double fw_mask_overlay_m(const fw_mask_table *table, fw_layout_role role) {
    int plate = fw_mask_plate_of_role(table, role); /* one plate has nothing to be put on */
    return plate < 0 ? 0.0 : fw_mask_overlay_between_m(table, plate, table->device_plate);
}
