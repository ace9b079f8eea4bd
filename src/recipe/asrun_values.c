/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of an as-run log: numbers at the sites of a wafer with their unit. */
#include "base/text.h"
#include "recipe/asrun_parts.h"
#include <math.h>
#include <string.h>

const char *const fw_recipe_site_name[FW_RECIPE_SITES] = {"centre", "top", "left", "bottom",
                                                          "right"};

static int site_of(const char *name, size_t n) {
    if (n == 6 && strncmp(name, "center", 6) == 0) return 0;
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        if (strlen(fw_recipe_site_name[i]) == n && strncmp(fw_recipe_site_name[i], name, n) == 0)
            return i;
    return -1;
}

fw_status fw_recipe_asrun_unknown(const fw_recipe_asrun_reader *r, const char *what,
                                  const char *name, const char *const *known, int n) {
    fw_text list = fw_text_new(r->arena);
    fw_text_add(&list, n ? "" : "none");
    for (int i = 0; i < n; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "", known[i]);
    FW_TRY(fw_text_end(&list));
    const char *meant = n ? fw_did_you_mean(name, known, (size_t)n) : NULL;
    return fw_diag_error(r->diags, 282, r->place, "%s '%s'; there are: %s%s%s%s", what, name,
                         list.data, meant ? "; did you mean '" : "", meant ? meant : "",
                         meant ? "'?" : "");
}

char *fw_recipe_asrun_word(char **at, char separator) {
    char *word = *at + strspn(*at, " "), *end = strchr(word, separator);
    *at = end ? end + 1 : NULL;
    if (end) *end = '\0';
    for (size_t n = strlen(word); n > 0 && word[n - 1] == ' ';)
        word[--n] = '\0';
    return word;
}

typedef struct scan {
    int position; /* of the next number without a name; -1: they have names */
    bool named;
} scan;

/* one word of the values; false: the unit begins here */
static bool one(fw_recipe_asrun_values *v, scan *s, const char *word, size_t n,
                const char **wrong) {
    const char *colon = memchr(word, ':', n);
    double number;
    int at = s->position;
    if (colon) {
        at = site_of(word, (size_t)(colon - word));
        if (at < 0) *wrong = "a site is centre, top, left, bottom or right";
        n -= (size_t)(colon + 1 - word);
        word = colon + 1;
        s->named = true;
    } else
        s->position++;
    if (!fw_number_parse(word, n, &number)) {
        if (colon) *wrong = "a number stands behind the name of a site";
        return false;
    }
    if (!colon && s->named) *wrong = "either all sites have names, or none";
    if (at >= FW_RECIPE_SITES) *wrong = "there are five sites: centre, top, left, bottom, right";
    if (*wrong) return true;
    if (!isnan(v->site[at])) *wrong = "a site is given twice";
    v->site[at] = number;
    v->n++;
    return true;
}

fw_status fw_recipe_asrun_values_read(const fw_recipe_asrun_reader *r, const char *name,
                                      const char *text, int sites, fw_recipe_asrun_values *v) {
    /* four sites are those of the rim */
    scan s = {.position = sites == 4 ? 1 : 0};
    const char *wrong = NULL, *at = text + strspn(text, " ");
    *v = (fw_recipe_asrun_values){.unit = ""};
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        v->site[i] = (double)NAN;
    for (size_t n; *at && !wrong; at += n + strspn(at + n, " ")) {
        n = strcspn(at, " ");
        if (one(v, &s, at, n, &wrong)) continue;
        FW_NEED(v->unit = fw_arena_strdup(r->arena, at));
        break;
    }
    if (!wrong && v->n == 0) wrong = "give a number in the unit of the run sheet, or yes or no";
    if (!wrong && !s.named && sites > 0 && v->n != 1 && v->n != sites)
        return fw_diag_error(r->diags, 282, r->place,
                             "%s=%s has %d values, and is measured at %d %s; where fewer are, name "
                             "them: %s:9.1 %s:8.9",
                             name, text, v->n, sites, sites > 1 ? "sites" : "site",
                             fw_recipe_site_name[0], fw_recipe_site_name[2]);
    if (wrong) return fw_diag_error(r->diags, 282, r->place, "%s=%s: %s", name, text, wrong);
    return FW_OK;
}

fw_status fw_recipe_asrun_values_in(const fw_recipe_asrun_reader *r, const char *name,
                                    const char *unit, const fw_quantity *range,
                                    fw_recipe_asrun_values *v) {
    fw_quantity_unit is, want;
    const char *written = v->unit[0] ? v->unit : unit;
    bool known = fw_quantity_unit_parse(unit, strlen(unit), &want, NULL, NULL);
    if (!known || !fw_quantity_unit_parse(written, strlen(written), &is, NULL, NULL) ||
        !fw_quantity_dimension_equal(is.dimension, want.dimension)) {
        if (strcmp(written, unit) == 0) return FW_OK; /* "drops": counted as they are */
        return fw_diag_error(r->diags, 282, r->place, "%s is given in %s; '%s' is no such unit",
                             name, strcmp(unit, "1") == 0 ? "plain numbers" : unit, v->unit);
    }
    fw_quantity q = range ? *range : (fw_quantity){0};
    q.unknown = false;
    q.unit = unit;
    q.dimension = want.dimension;
    q.place = r->place;
    q.id = name;
    for (int i = 0; i < FW_RECIPE_SITES; i++) {
        if (isnan(v->site[i])) continue;
        q.value = fw_quantity_unit_to_si(&is, v->site[i]);
        if (range && !fw_process_quantity_in_range(&q, r->diags)) return FW_INPUT;
        /* what is written in the unit that is wanted stays the number that it is */
        if (strcmp(written, unit) != 0) v->site[i] = fw_quantity_unit_from_si(&want, q.value);
    }
    return FW_OK;
}

double fw_recipe_asrun_mean(const double *site) {
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        if (!isnan(site[i])) sum += site[i], n++;
    return sum / n;
}
