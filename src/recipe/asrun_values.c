/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of an as-run log: what was measured at the sites of a wafer, and coupons. */
#include "base/text.h"
#include "process/calibrate.h"
#include "process/process_law.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe.h"
#include "schedule/schedule.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- numbers at the sites of a wafer with their unit ---- */

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
                         list.data, FW_DID_YOU_MEAN(meant));
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
        FW_NEED(v->unit = fw_recipe_unit_of_printed(r->arena, at));
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

/* ---- the wafers of a lot ---- */

static bool plain_id(const char *id, size_t n) {
    for (size_t i = 0; i < n; i++)
        if (!strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.", id[i]))
            return false;
    return n > 0 && n <= 32;
}

static const char *counted(fw_arena *arena, int n) {
    fw_text list = fw_text_new(arena);
    for (int i = 1; i <= n; i++)
        fw_text_printf(&list, "%s%d", i > 1 ? "," : "", i);
    return fw_text_end(&list) == FW_OK ? list.data : NULL;
}

const char *fw_recipe_asrun_wafers(fw_arena *arena, const char *text, const char **wrong) {
    double number;
    int n = 0;
    static const char needs[] =
        "needs how many wafers there are, 1 to 50, or up to 50 ids of letters, digits, -, _ and . "
        "with commas between";
    *wrong = NULL;
    if (!strchr(text, ',') && fw_number_parse(text, strlen(text), &number)) {
        if (!(number >= 1.0 && number <= FW_RECIPE_WAFERS && number == floor(number))) {
            *wrong = needs;
            return NULL;
        }
        return counted(arena, (int)number);
    }
    for (const char *at = text; !*wrong; n++) {
        size_t length = strcspn(at, ",");
        if (!plain_id(at, length) || n == FW_RECIPE_WAFERS) *wrong = needs;
        for (const char *other = text; other < at && !*wrong; other += strcspn(other, ",") + 1)
            if (strcspn(other, ",") == length && strncmp(other, at, length) == 0)
                *wrong = "has a wafer twice";
        if (!at[length]) break;
        at += length + 1;
    }
    return *wrong ? NULL : fw_arena_strdup(arena, text);
}

/* ---- coupons: what calibrate reads ---- */

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

static fw_status same_dimension(const fw_recipe_asrun_reader *r, const char *name,
                                fw_quantity_dimension a, fw_quantity_dimension b) {
    if (fw_quantity_dimension_equal(a, b)) return FW_OK;
    return fw_diag_error(r->diags, 282, r->place, "%s is of another dimension than %s", name,
                         strcmp(name, "u") == 0 ? "value" : "at");
}

static fw_status read_sites(const fw_recipe_asrun_reader *r, const char *text,
                            fw_recipe_coupon *c) {
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
    const char *condition[FW_CONDITIONS], *u_condition[FW_CONDITIONS];
} given;

static const char *const condition_word[FW_CONDITIONS] = {
    [FW_CONDITION_TEMPERATURE] = "temperature", [FW_CONDITION_OPEN_AREA] = "open-area"};
static const char *const u_condition_word[FW_CONDITIONS] = {
    [FW_CONDITION_TEMPERATURE] = "u-temperature", [FW_CONDITION_OPEN_AREA] = "u-open-area"};

/* temperature of the bath, open area of the wafer; how far off it may be is taken from how it is written, where nothing is
   said */
static fw_status read_condition(const fw_recipe_asrun_reader *r, const given *g,
                                fw_process_condition k, fw_process_measurement *m) {
    static const struct {
        const char *what, *such, *u_unit;
        fw_quantity_dimension is;
    } of[FW_CONDITIONS] = {
        [FW_CONDITION_TEMPERATURE] = {"a temperature", "35 Cel", "K", FW_DIM_TEMPERATURE},
        [FW_CONDITION_OPEN_AREA] = {"an area", "60 cm2", "cm2", FW_DIM_AREA}};
    fw_quantity_dimension d = {0}, of_u = of[k].is;
    fw_quantity_unit unit;
    fw_recipe_asrun_values v;
    FW_TRY(amount(r, condition_word[k], g->condition[k], &m->condition[k], &d, false));
    FW_TRY(fw_recipe_asrun_values_read(r, condition_word[k], g->condition[k], 1, &v));
    if (fw_quantity_unit_parse(v.unit, strlen(v.unit), &unit, NULL, NULL)) {
        unit.offset = 0.0;
        m->condition_uncertainty[k] =
            fw_quantity_unit_to_si(&unit, fw_process_written_uncertainty(g->condition[k]));
    }
    if (g->u_condition[k])
        FW_TRY(amount(r, u_condition_word[k], g->u_condition[k], &m->condition_uncertainty[k],
                      &of_u, true));
    if (fw_quantity_dimension_equal(d, of[k].is) && fw_quantity_dimension_equal(of_u, of[k].is) &&
        m->condition[k] > 0.0 && m->condition_uncertainty[k] >= 0.0)
        return FW_OK;
    return fw_diag_error(r->diags, 282, r->place,
                         "%s=%s: %s is needed, such as %s, and %s in %s, not below 0",
                         condition_word[k], g->condition[k], of[k].what, of[k].such,
                         u_condition_word[k], of[k].u_unit);
}

static fw_status read_amounts(const fw_recipe_asrun_reader *r, const given *g,
                              fw_recipe_coupon *c) {
    fw_process_measurement *m = &c->row;
    fw_quantity_dimension d = {0};
    if (g->drawn) {
        FW_TRY(amount(r, "drawn", g->drawn, &m->drawn_m, &d, false));
        if (!fw_quantity_dimension_equal(d, (fw_quantity_dimension){.m = 1}))
            return fw_diag_error(r->diags, 282, r->place, "drawn=%s is no length", g->drawn);
    }
    if (g->value) FW_TRY(read_sites(r, g->value, c));
    if (g->u) {
        FW_TRY(amount(r, "u", g->u, &m->uncertainty, &d, true));
        FW_TRY(same_dimension(r, "u", d, m->dimension));
    }
    if (g->at) FW_TRY(amount(r, "at", g->at, &m->at, &m->at_dimension, false));
    if (g->at) m->at_uncertainty = 0.0;
    if (g->u_at) {
        FW_TRY(amount(r, "u-at", g->u_at, &m->at_uncertainty, &d, true));
        FW_TRY(same_dimension(r, "u-at", d, m->at_dimension));
    }
    if (!(m->uncertainty >= 0.0) || m->at_uncertainty < 0.0)
        return fw_diag_error(r->diags, 282, r->place, "u and u-at are not below 0");
    for (int k = 0; k < FW_CONDITIONS; k++)
        if (g->condition[k]) FW_TRY(read_condition(r, g, (fw_process_condition)k, m));
    return FW_OK;
}

static fw_status read_word(const fw_recipe_asrun_reader *r, char *word, fw_recipe_coupon *c,
                           given *g) {
    enum { FIELDS = 9 };
    static const char *const known[FIELDS + 1] = {
        "drawn",       "value",         "u",         "at",          "u-at",
        "temperature", "u-temperature", "open-area", "u-open-area", "feature"};
    const char **of[FIELDS] = {&g->drawn,
                               &g->value,
                               &g->u,
                               &g->at,
                               &g->u_at,
                               &g->condition[FW_CONDITION_TEMPERATURE],
                               &g->u_condition[FW_CONDITION_TEMPERATURE],
                               &g->condition[FW_CONDITION_OPEN_AREA],
                               &g->u_condition[FW_CONDITION_OPEN_AREA]};
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
            c->row.coupon = fw_process_coupon_called(word);
        else if (word[0])
            FW_TRY(read_word(r, word, c, &g));
    }
    FW_TRY(read_amounts(r, &g, c));
    bool counted = fw_process_coupon_is_looked_at(&c->row);
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

/* ---- at which step a coupon was read ---- */

fw_status fw_recipe_asrun_stage(fw_arena *arena, const fw_recipe_asrun *run,
                                const fw_recipe_asrun_entry *e, const fw_recipe_coupon *c,
                                fw_process_measurement *row, bool *there, fw_diags *diags) {
    fw_process_coupon_stage stage;
    const char *where;
    *row = c->row;
    FW_TRY(fw_process_coupon_stage_at(arena, run->flow, row, e->step, there, &stage, &where));
    if (!*there) {
        fw_diag_warning(diags, 706, row->place,
                        "'%s' of step %s does not count: %s reads %s, so that nobody knows what "
                        "this is of",
                        c->text, e->step->id, row->coupon, where);
        return diags->failed ? FW_NOMEM : FW_OK;
    }
    row->of = stage.gives;
    const fw_recipe_asrun_entry *not = fw_recipe_asrun_not_there(run, e, &stage);
    if (!not ) return FW_OK;
    *there = false;
    fw_diag_warning(diags, 707, row->place,
                    "'%s' of step %s%s%s does not count: by the times of the log step %s (line %d, "
                    "%s) was run %s it, so that %s",
                    c->text, e->step->id, e->wafer ? ", wafer " : "", e->wafer ? e->wafer : "",
                    not ->step->id, not ->line, not ->start,
                    not ->step == stage.from ? "after" : "before",
                    not ->step == stage.from ? "there was nothing to read yet"
                                             : "what it reads was no longer there");
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- does an entry contradict itself? ---- */

static bool is_time(fw_quantity_dimension d) {
    return fw_quantity_dimension_equal(d, (fw_quantity_dimension)FW_DIM_TIME);
}

/* the last run of the step that makes what the coupon reads, of the entry's wafer and not after it */
static const fw_recipe_asrun_entry *
run_of(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, const fw_process_step *step) {
    const fw_recipe_asrun_entry *of = NULL;
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++)
        if (o->step == step && (!o->wafer || !e->wafer || strcmp(o->wafer, e->wafer) == 0) &&
            !fw_recipe_asrun_taken_back(run, o) && o->start_s <= e->start_s &&
            (!of || o->start_s >= of->start_s))
            of = o;
    return of;
}

/* It cannot have been etched for longer than its run took; for less it may, handling and pauses are in that */
static fw_status ask_time_of(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                             const fw_recipe_coupon *c, fw_place place, fw_diags *diags) {
    static const double sure = 3.0;
    fw_process_coupon_stage stage;
    const char *where;
    bool there;
    if (isnan(c->row.at) || !is_time(c->row.at_dimension)) return FW_OK;
    FW_TRY(fw_process_coupon_stage_at(diags->arena, run->flow, &c->row, e->step, &there, &stage,
                                      &where));
    const fw_recipe_asrun_entry *of = stage.from ? run_of(run, e, stage.from) : NULL;
    if (!of) return FW_OK;
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, of);
    const double most = runs.took_s + runs.n * fw_recipe_asrun_clock_s(of) +
                        sure * fmax(c->row.at_uncertainty, 0.0);
    if (!(c->row.at > most)) return FW_OK;
    fw_text took = fw_text_new(diags->arena), at = fw_text_new(diags->arena);
    fw_schedule_put_duration(&took, runs.took_s);
    fw_schedule_put_duration(&at, c->row.at);
    FW_TRY(fw_text_end(&took));
    FW_TRY(fw_text_end(&at));
    fw_diag_warning(diags, 709, place,
                    "coupon %s says that it was etched for %s (at=), and by its times step %s%s%s "
                    "took %s in all (line %d): one of them is wrong",
                    c->row.coupon, at.data, of->step->id, of->wafer ? " of wafer " : "",
                    of->wafer ? of->wafer : "", took.data, of->line);
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* what the mask lost and what is left of it are what was put there */
static fw_status ask_mask_of(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                             const fw_recipe_coupon *c, fw_place place, fw_diags *diags) {
    static const double sure = 3.0;
    const fw_quantity *mask = fw_process_coupon_mask(run->flow, &c->row);
    char lost[32], left[32], there[32];
    for (int i = 0; mask && !mask->unknown && i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
        fw_quantity_unit unit;
        if (!a || isnan(m->number) ||
            strcmp(fw_process_coupon_called(a->coupon), c->row.coupon) != 0 ||
            !fw_quantity_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL) ||
            !fw_quantity_dimension_equal(unit.dimension, mask->dimension))
            continue;
        double squares = 0.0;
        for (int k = 0; k < FW_RECIPE_SITES; k++) {
            const double off = isnan(m->site[k]) ? 0.0 : m->site[k] - m->number;
            squares += off * off;
        }
        const double rest = fw_quantity_unit_to_si(&unit, m->number),
                     scatter = fw_quantity_unit_to_si(&unit, sqrt(squares)) / fmax(m->nsite, 1.0);
        const double off = fabs(c->row.value + rest - mask->value),
                     u = hypot(hypot(mask->uncertainty, fmax(c->row.uncertainty, 0.0)), scatter);
        if (off <= sure * u) continue;
        fw_diag_warning(
            diags, 709, place,
            "coupon %s says that %s um were lost, and %s = %s um that so many are left: together "
            "they are not the %s um that were put there (%s): one of them is wrong",
            c->row.coupon, fw_number_text(lost, sizeof lost, 1e6 * c->row.value, 4), m->measure,
            fw_number_text(left, sizeof left, 1e6 * rest, 4),
            fw_number_text(there, sizeof there, 1e6 * mask->value, 4), mask->id);
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_recipe_asrun_ask_contradictions(const fw_recipe_asrun *run,
                                             const fw_recipe_asrun_entry *e, fw_place place,
                                             fw_diags *diags) {
    for (int i = 0; i < e->ncoupon; i++) {
        FW_TRY(ask_time_of(run, e, &e->coupon[i], place, diags));
        FW_TRY(ask_mask_of(run, e, &e->coupon[i], place, diags));
    }
    return FW_OK;
}

/* ---- times ----
   Of a log with a zone, and where an entry says how far its clock is ahead of UTC, a duration is what passed in truth also
   where the clock was changed meanwhile. Test: test_asrun.c, clocks_that_are_changed */

/* "+02:00" */
static const char *put_ahead(char text[16], double ahead_s) {
    const int minutes = (int)lround(fabs(ahead_s) / 60.0);
    snprintf(text, 16, "%c%02d:%02d", ahead_s < 0.0 ? '-' : '+', minutes / 60 % 100, minutes % 60);
    return text;
}

/* a time of the clock of the log's zone that says no more of itself, as one of UTC: that clock has it once */
static fw_status time_of_zone(const fw_recipe_asrun_reader *r, const char *name, const char *text,
                              double *time_s) {
    double utc_s[2] = {*time_s, *time_s};
    char first[16], second[16];
    const double clock_s = *time_s;
    const int n = fw_schedule_zone_times(r->run->zone, clock_s, utc_s);
    *time_s = utc_s[0];
    if (n == 1) return FW_OK;
    if (n < 1)
        return fw_diag_error(r->diags, 717, r->place,
                             "%s=%s: no clock of this log's zone (%s) shows that time, for it is "
                             "set forward over it; correct the time, or write behind it how far "
                             "the clock was ahead of UTC",
                             name, text, r->run->zone);
    return fw_diag_error(r->diags, 717, r->place,
                         "%s=%s: the clock of this log's zone (%s) is set back over that time and "
                         "shows it twice; write %s=%s%s before the change, %s=%s%s behind it",
                         name, text, r->run->zone, name, text, put_ahead(first, clock_s - utc_s[0]),
                         name, text, put_ahead(second, clock_s - utc_s[1]));
}

/* that a log has of its times is known of all of them, or of none */
static fw_status check_said(const fw_recipe_asrun_reader *r, const char *name, const char *text,
                            double ahead_s, double other_s) {
    const bool begun = !isnan(r->run->ahead_s);
    if (!isnan(ahead_s) || r->run->zone || (isnan(other_s) && !(begun && r->fresh))) return FW_OK;
    return fw_diag_error(r->diags, 718, r->place,
                         "%s=%s does not say how far its clock is ahead of UTC, and %s does: write "
                         "Z or the like of +01:00 behind it, for else nobody knows how long it "
                         "took over a change of the clocks",
                         name, text,
                         isnan(other_s) ? "an earlier entry of this log" : "the other time");
}

fw_status fw_recipe_asrun_times(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e) {
    double ahead_s[2] = {(double)NAN, (double)NAN}, time_s[2] = {(double)NAN, (double)NAN};
    const char *const text[2] = {e->start, e->end}, *const name[2] = {"start", "end"};
    for (int k = 0; k < 2; k++)
        if (text[k] && !fw_recipe_asrun_time_read(text[k], &time_s[k], &ahead_s[k]))
            return FW_INTERNAL; /* it was looked at */
    /* of UTC, or of the clock that is so far ahead of it as the first of all times that say so */
    const double first_s = !isnan(r->run->ahead_s) ? r->run->ahead_s
                           : !isnan(ahead_s[0])    ? ahead_s[0]
                                                   : ahead_s[1];
    for (int k = 0; k < 2; k++) {
        if (!text[k]) continue;
        if (text[1 - k]) FW_TRY(check_said(r, name[k], text[k], ahead_s[k], ahead_s[1 - k]));
        if (!isnan(ahead_s[k]))
            time_s[k] += (r->run->zone ? 0.0 : first_s) - ahead_s[k];
        else if (r->run->zone)
            FW_TRY(time_of_zone(r, name[k], text[k], &time_s[k]));
    }
    e->start_s = time_s[0], e->end_s = time_s[1];
    e->ahead_s = first_s;
    return FW_OK;
}

/* ---- what is not accepted, at once ---- */

static fw_status ask_value(const fw_recipe_asrun_entry *e, const char *what, fw_text *value,
                           fw_place place, fw_diags *diags) {
    FW_TRY(fw_text_end(value));
    fw_diag_warning(diags, 736, place,
                    "step %s%s%s: %s = %s; do what the sheet says of that before the next step%s",
                    e->step->id, e->wafer ? " of wafer " : "", e->wafer ? e->wafer : "", what,
                    value->data, e->deviation ? "" : ", and write down why (deviation=...)");
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_recipe_asrun_ask_values(const fw_recipe_asrun_entry *e, fw_place place,
                                     fw_diags *diags) {
    for (const fw_recipe_measured *m = e->measured; m < e->measured + e->nmeasured; m++) {
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
        fw_text text = fw_text_new(diags->arena);
        if (fw_recipe_asrun_accepted(m)) continue;
        fw_text_printf(&text, "%s, accepted is ", m->value);
        if (isnan(m->number))
            fw_text_add(&text, "yes");
        else
            fw_recipe_put_span(&text, m->low, m->high);
        if (!isnan(m->number) && strcmp(a->unit, "1") != 0) fw_text_printf(&text, " %s", a->unit);
        FW_TRY(ask_value(e, m->measure, &text, place, diags));
    }
    for (const fw_recipe_set *s = e->set; s < e->set + e->nset; s++) {
        fw_text text = fw_text_new(diags->arena);
        if (fw_recipe_asrun_allowed(s)) continue;
        fw_recipe_asrun_put_set(s, &text);
        fw_text_add(&text, ", the step allows ");
        fw_recipe_put_span(&text, s->low, s->high);
        if (strcmp(s->q->unit, "1") != 0) fw_text_printf(&text, " %s", s->q->unit);
        FW_TRY(ask_value(e, s->name, &text, place, diags));
    }
    return FW_OK;
}
