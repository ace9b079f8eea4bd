/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coupons in the as-run log: what calibrate reads. */
#include "base/text.h"
#include "process/calibrate.h"
#include "recipe/asrun_parts.h"
#include <math.h>
#include <string.h>

/* a number with its unit, SI */
static fw_status amount(const fw_recipe_asrun_reader *r, const char *name, const char *text,
                        double *value, fw_quantity_dimension *dimension, bool difference) {
    fw_recipe_asrun_values v;
    fw_quantity_unit unit;
    FW_TRY(fw_recipe_asrun_values_read(r, name, text, 1, &v));
    if (!fw_quantity_unit_parse(v.unit, strlen(v.unit), &unit, NULL, NULL))
        return fw_diag_error(r->diags, 282, r->place, "%s=%s: a number and its unit are needed",
                             name, text);
    if (difference) unit.offset = 0.0;
    *value = fw_quantity_unit_to_si(&unit, v.site[0]);
    *dimension = unit.dimension;
    return FW_OK;
}

static fw_status same(const fw_recipe_asrun_reader *r, const char *name, fw_quantity_dimension a,
                      fw_quantity_dimension b) {
    if (fw_quantity_dimension_equal(a, b)) return FW_OK;
    return fw_diag_error(r->diags, 282, r->place, "%s is of another dimension than %s", name,
                         strcmp(name, "u") == 0 ? "value" : "at");
}

static fw_status sites(const fw_recipe_asrun_reader *r, const char *text, fw_recipe_coupon *c) {
    fw_recipe_asrun_values v;
    fw_quantity_unit unit;
    FW_TRY(fw_recipe_asrun_values_read(r, "value", text, 0, &v));
    if (!fw_quantity_unit_parse(v.unit, strlen(v.unit), &unit, NULL, NULL))
        return fw_diag_error(r->diags, 282, r->place, "value=%s: a number and its unit are needed",
                             text);
    const fw_quantity any = {.id = "value"};
    FW_TRY(fw_recipe_asrun_values_in(r, c->row.coupon, v.unit, &any, &v));
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        c->site[i] = isnan(v.site[i]) ? v.site[i] : fw_quantity_unit_to_si(&unit, v.site[i]);
    c->nsite = v.n;
    c->row.value = fw_recipe_asrun_mean(c->site);
    c->row.dimension = unit.dimension;
    return FW_OK;
}

typedef struct given { /* texts as they are written, NULL: not */
    const char *drawn, *value, *u, *at, *u_at;
} given;

static fw_status read_amounts(const fw_recipe_asrun_reader *r, const given *g,
                              fw_recipe_coupon *c) {
    fw_process_measurement *m = &c->row;
    fw_quantity_dimension d = {0};
    if (g->drawn) {
        FW_TRY(amount(r, "drawn", g->drawn, &m->drawn_m, &d, false));
        if (!fw_quantity_dimension_equal(d, (fw_quantity_dimension){.m = 1}))
            return fw_diag_error(r->diags, 282, r->place, "drawn=%s is no length", g->drawn);
    }
    if (g->value) FW_TRY(sites(r, g->value, c));
    if (g->u) {
        FW_TRY(amount(r, "u", g->u, &m->uncertainty, &d, true));
        FW_TRY(same(r, "u", d, m->dimension));
    }
    if (g->at) FW_TRY(amount(r, "at", g->at, &m->at, &m->at_dimension, false));
    if (g->at) m->at_uncertainty = 0.0;
    if (g->u_at) {
        FW_TRY(amount(r, "u-at", g->u_at, &m->at_uncertainty, &d, true));
        FW_TRY(same(r, "u-at", d, m->at_dimension));
    }
    if (!(m->uncertainty >= 0.0) || m->at_uncertainty < 0.0)
        return fw_diag_error(r->diags, 282, r->place, "u and u-at are not below 0");
    return FW_OK;
}

static fw_status read_word(const fw_recipe_asrun_reader *r, char *word, fw_recipe_coupon *c,
                           given *g) {
    enum { FIELDS = 5 };
    static const char *const known[FIELDS + 1] = {"drawn", "value", "u", "at", "u-at", "feature"};
    const char **of[] = {&g->drawn, &g->value, &g->u, &g->at, &g->u_at};
    char *equal = strchr(word, '=');
    if (strncmp(word, "feature=", 8) == 0) { /* as the column of a table is called */
        word += 8;
        equal = NULL;
    }
    if (!equal) {
        if (c->row.feature[0])
            return fw_diag_error(r->diags, 282, r->place,
                                 "'%s' is a second feature of the coupon; one is '%s'", word,
                                 c->row.feature);
        c->row.feature = word;
        return FW_OK;
    }
    *equal = '\0';
    for (size_t i = 0; i < FIELDS; i++)
        if (strcmp(word, known[i]) == 0) {
            if (*of[i]) return fw_diag_error(r->diags, 282, r->place, "%s is given twice", word);
            *of[i] = equal + 1;
            return FW_OK;
        }
    return fw_recipe_asrun_unknown(r, "a coupon has no", word, known, FIELDS + 1);
}

/* "arde-slots, drawn=10 um, value=45.6 45.4 45.7 45.5 45.6 um, u=0.1 um, at=90 min, u-at=6 s"; the first word is the kind,
   a second one without = the feature. What its row must have is the coupon's own to say. */
fw_status fw_recipe_asrun_coupon_read(const fw_recipe_asrun_reader *r, const char *text,
                                      fw_recipe_coupon *c) {
    char *copy = fw_arena_strdup(r->arena, text);
    given g = {0};
    FW_NEED(copy);
    *c = (fw_recipe_coupon){.text = text};
    c->row = (fw_process_measurement){.feature = "",
                                      .drawn_m = (double)NAN,
                                      .value = (double)NAN,
                                      .at = (double)NAN,
                                      .at_uncertainty = (double)NAN,
                                      .place = r->place};
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        c->site[i] = (double)NAN;
    for (char *at = copy; at;) {
        char *word = fw_recipe_asrun_word(&at, ',');
        if (!c->row.coupon)
            c->row.coupon = word;
        else if (word[0])
            FW_TRY(read_word(r, word, c, &g));
    }
    FW_TRY(read_amounts(r, &g, c));
    bool counted = strcmp(c->row.feature, "gone") == 0 || strcmp(c->row.feature, "stands") == 0;
    if (counted && !g.value) { /* looked at, not measured */
        c->row.value = 0.0;
        c->row.dimension = (fw_quantity_dimension){.m = 1};
    } else if (!g.value)
        return fw_diag_error(r->diags, 282, r->place, "coupon %s lacks value=", c->row.coupon);
    else if (c->nsite == 1 && !(c->row.uncertainty > 0.0))
        return fw_diag_error(r->diags, 282, r->place,
                             "coupon %s is read at one site, so that nothing says how exactly: add "
                             "u=, the standard uncertainty of the instrument",
                             c->row.coupon);
    return fw_process_measurement_check(&c->row, r->diags);
}
