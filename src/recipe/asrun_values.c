/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of an as-run log: what was measured at the sites of a wafer, and coupons. */
#include "base/text.h"
#include "process/calibrate.h"
#include "process/process_law.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe_words.h"
#include <math.h>
#include <string.h>

/* ---- numbers at the sites of a wafer with their unit ---- */

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

/* ---- what became of wafers ---- */

const char *fw_recipe_fate_word(fw_recipe_fate fate) {
    static const char *const word[] = {NULL, "held", "resumed", "scrapped"};
    return word[fate];
}

const fw_recipe_asrun_entry *fw_recipe_asrun_out(const fw_recipe_asrun *run, const char *wafer,
                                                 double time_s) {
    const fw_recipe_asrun_entry *last = NULL;
    for (const fw_recipe_asrun_entry *e = run->entry; e < run->entry + run->nentry; e++)
        if (e->fate != FW_FATE_RUN && strcmp(e->wafer, wafer) == 0 && e->start_s < time_s) last = e;
    return last && last->fate != FW_FATE_RESUMED ? last : NULL;
}

bool fw_recipe_asrun_expects(const fw_recipe_asrun *run, const fw_process_step *step,
                             const char *wafer) {
    for (const fw_recipe_asrun_entry *e = run->entry; e < run->entry + run->nentry; e++)
        if (e->step == step && (!e->wafer || strcmp(e->wafer, wafer) == 0)) return false;
    return !fw_recipe_asrun_out(run, wafer, (double)INFINITY);
}

int fw_recipe_asrun_count(const fw_process_flow *flow, const fw_recipe_asrun *run, int steps,
                          fw_recipe_fate fate) {
    int n = 0;
    for (int i = 0; i < run->nwafer; i++) {
        const fw_recipe_asrun_entry *out =
            fw_recipe_asrun_out(run, run->wafer[i], (double)INFINITY);
        const bool before = out && out->at < flow->step + steps;
        n += before ? out->fate == fate : fate == FW_FATE_RUN;
    }
    return n;
}

/* ---- the coupons of a log, as calibrate takes them ---- */

/* Is b, which comes later, in the place of a? It reads the same feature of the same drawn size again. A rate is read off
   several times of one wafer, which are readings of their own; where all readings of a coupon are of one run, another `at` is
   that of the run that counts, or corrects what was mistyped. Other drawn sizes are other readings, and stay. */
static bool same_reading(const fw_recipe_asrun_entry *a, const fw_recipe_coupon *ca,
                         const fw_recipe_asrun_entry *b, const fw_recipe_coupon *cb) {
    const char *wa = a->wafer ? a->wafer : "", *wb = b->wafer ? b->wafer : "";
    bool drawn = isnan(ca->row.drawn_m) ? isnan(cb->row.drawn_m)
                                        : fabs(ca->row.drawn_m - cb->row.drawn_m) < 1e-12;
    bool under = isnan(ca->row.at) ? isnan(cb->row.at) : ca->row.at == cb->row.at;
    if (a->step != b->step || strcmp(wa, wb) != 0 || !drawn ||
        strcmp(ca->row.coupon, cb->row.coupon) != 0 ||
        strcmp(ca->row.feature, cb->row.feature) != 0)
        return false;
    return under || (a != b && fw_process_coupon_of_one_run(ca->row.coupon));
}

/* in a later entry or further on in this one; the last such reading counts */
static bool read_again(const fw_recipe_asrun *run, int entry, int coupon,
                       fw_recipe_read_again *again) {
    const fw_recipe_asrun_entry *e = &run->entry[entry];
    *again = (fw_recipe_read_again){.entry = e, .coupon = &e->coupon[coupon]};
    for (int i = entry; i < run->nentry; i++)
        for (int k = i == entry ? coupon + 1 : 0; k < run->entry[i].ncoupon; k++)
            if (same_reading(e, again->coupon, &run->entry[i], &run->entry[i].coupon[k])) {
                again->by = &run->entry[i];
                again->by_coupon = &run->entry[i].coupon[k];
            }
    return again->by;
}

bool fw_recipe_asrun_read_again(const fw_recipe_asrun *run, int *entry, int *coupon,
                                fw_recipe_read_again *again) {
    for (; *entry < run->nentry; ++*entry, *coupon = 0)
        while (*coupon < run->entry[*entry].ncoupon)
            if (read_again(run, *entry, (*coupon)++, again)) return true;
    return false;
}

static void warn_again(const fw_recipe_read_again *again, fw_diags *diags) {
    const char *wafer = again->entry->wafer;
    fw_diag_warning(diags, 610, again->coupon->row.place,
                    "'%s' of step %s%s%s does not count: line %d reads it again ('%s'). %s",
                    again->coupon->text, again->entry->step->id, wafer ? ", wafer " : "",
                    wafer ? wafer : "", again->by->line, again->by_coupon->text,
                    FW_RECIPE_KEEP_BOTH);
}

/* All readings of the coupon are of one run, but what stands under `at` is not the same: both count, and one may be
   mistyped. Told once of a coupon, wafer and step. */
static void warn_apart(const fw_process_readings *r, fw_diags *diags) {
    const fw_process_reading *last = &r->item[r->n - 1];
    const fw_process_measurement *b = &last->row;
    if (isnan(b->at) || !fw_process_coupon_of_one_run(b->coupon)) return;
    for (int i = 0; i < r->n - 1; i++) {
        const fw_process_measurement *a = &r->item[i].row;
        if (strcmp(r->item[i].step, last->step) != 0 ||
            strcmp(r->item[i].wafer, last->wafer) != 0 || strcmp(a->coupon, b->coupon) != 0)
            continue;
        const double u = hypot(fmax(a->at_uncertainty, 0.0), fmax(b->at_uncertainty, 0.0));
        if (fabs(a->at - b->at) <= 2.0 * u + 1e-12 * fabs(a->at)) continue;
        fw_diag_warning(diags, 611, b->place,
                        "coupon %s of step %s%s%s is of one run, but lines %d and %d say that it "
                        "was under something else (at=); each reading counts with its own. Where "
                        "one is mistyped, log its readings again; where both were measured, say "
                        "by u-at= how exactly",
                        b->coupon, last->step, last->wafer[0] ? ", wafer " : "", last->wafer,
                        (int)a->place.line, (int)b->place.line);
        return;
    }
}

/* of a wafer that was scrapped or held by then: what was read is of another state than the flow's */
static bool is_out(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                   const fw_recipe_coupon *c, fw_diags *diags) {
    const fw_recipe_asrun_entry *out =
        e->wafer ? fw_recipe_asrun_out(run, e->wafer, e->end_s) : NULL;
    if (!out) return false;
    fw_diag_warning(diags, 604, c->row.place,
                    "'%s' of step %s does not count: wafer %s was %s at %s before (line %d)",
                    c->text, e->step->id, e->wafer, fw_recipe_fate_word(out->fate), out->at->id,
                    out->line);
    return true;
}

double fw_recipe_asrun_limit(const char *text, double absent) {
    double value;
    return text[0] && fw_number_parse(text, strlen(text), &value) ? value : absent;
}

bool fw_recipe_asrun_inside(const char *low, const char *high, double value) {
    return value >= fw_recipe_asrun_limit(low, -(double)INFINITY) &&
           value <= fw_recipe_asrun_limit(high, (double)INFINITY);
}

bool fw_recipe_asrun_allowed(const fw_recipe_set *set) {
    return isnan(set->value) || fw_recipe_asrun_inside(set->low, set->high, set->value);
}

/* Readings of a step that was not run as it is meant to be speak of that run. They count, since nobody else knows whether
   what they tell depends on it. Times are not looked at: they are planned for a device, and this is of its log alone */
static fw_status tell_otherwise(fw_arena *arena, const fw_recipe_asrun_entry *e, fw_diags *diags) {
    fw_text text = fw_text_new(arena);
    if (e->ncoupon == 0 || !e->step) return FW_OK;
    for (int i = 0; i < e->nset; i++)
        if (!fw_recipe_asrun_allowed(&e->set[i])) {
            fw_text_printf(&text, "; %s was ", e->set[i].name);
            fw_recipe_put_value(&text, e->set[i].value);
            if (strcmp(e->set[i].q->unit, "1") != 0)
                fw_text_printf(&text, " %s", e->set[i].q->unit);
        }
    if (e->deviation) fw_text_printf(&text, "; written down: %s", e->deviation);
    if (text.length == 0) return FW_OK;
    FW_TRY(fw_text_end(&text));
    fw_diag_warning(diags, 652, (fw_place){0},
                    "what was read of step %s (line %d of the log) is of a run that went otherwise "
                    "than planned%s; it counts like any other: leave it out where what it tells "
                    "depends on that",
                    e->step->id, e->line, text.data);
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_recipe_asrun_readings(fw_arena *arena, const fw_recipe_asrun *run, fw_diags *diags,
                                   fw_process_readings *readings) {
    int most = 0;
    for (int i = 0; i < run->nentry; i++)
        most += run->entry[i].ncoupon;
    *readings = (fw_process_readings){.lot = run->lot};
    FW_NEED(readings->item = fw_arena_array(arena, fw_process_reading, (size_t)most + 1));
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        FW_TRY(tell_otherwise(arena, e, diags));
        for (int k = 0; k < e->ncoupon; k++) {
            const fw_recipe_coupon *c = &e->coupon[k];
            fw_recipe_read_again again;
            if (is_out(run, e, c, diags)) continue;
            if (read_again(run, i, k, &again)) {
                warn_again(&again, diags);
                continue;
            }
            fw_process_reading *r = &readings->item[readings->n++];
            *r = (fw_process_reading){.row = c->row,
                                      .wafer = e->wafer ? e->wafer : "",
                                      .step = e->step->id,
                                      .nsite = c->nsite};
            FW_NEED(r->date = fw_arena_strndup(arena, e->end, 10));
            for (int s = 0; s < FW_RECIPE_SITES; s++) {
                double off = c->site[s] - c->row.value;
                if (!isnan(c->site[s])) r->squares += off * off;
            }
            warn_apart(readings, diags);
        }
    }
    return FW_OK;
}

const fw_process_accept *fw_recipe_asrun_accept(const fw_process_step *step, const char *measure) {
    for (int i = 0; i < step->naccept; i++)
        if (strcmp(step->accept[i].measure, measure) == 0) return &step->accept[i];
    return NULL;
}

/* ---- does what was measured go with the time that it took? ----
   Where the step's own law has the time of a thickness that the step adds or takes away, and what is accepted holds that
   thickness from both sides, time and reading say one thing twice. */

/* the amount that the law takes; NULL: its time is not that of an outcome (a bake, a spin) */
static const fw_process_argument *amount_of_law(const fw_process_step *s) {
    for (int i = 0; i < s->nargument; i++) {
        const fw_process_argument *a = &s->argument[i];
        if (strcmp(a->name, "thickness") != 0 && strcmp(a->name, "depth") != 0) continue;
        for (int k = 0; k < s->nchange; k++)
            if (s->change[k].thickness == a->q) return a;
    }
    return NULL;
}

/* what was measured of it, SI; NaN: nothing */
static double amount_measured(const fw_recipe_asrun_entry *e, const fw_quantity *planned,
                              const fw_recipe_measured **as) {
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, e->measured[i].measure);
        fw_quantity_unit unit;
        if (!a || isnan(e->measured[i].number) || !a->low[0] || !a->high[0] ||
            !fw_quantity_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL) ||
            !fw_quantity_dimension_equal(unit.dimension, planned->dimension) ||
            !fw_recipe_asrun_inside(a->low, a->high,
                                    fw_quantity_unit_from_si(&unit, planned->value)))
            continue;
        *as = &e->measured[i];
        return fw_quantity_unit_to_si(&unit, e->measured[i].number);
    }
    return (double)NAN;
}

typedef struct timing { /* the law of a step as it was run */
    fw_arena *arena;
    const fw_process_step *step;
    fw_process_argument argument[FW_LAW_ARGUMENTS];
    fw_quantity
        q[FW_LAW_ARGUMENTS]; /* those that were set otherwise; of the amount, what is asked of */
    int amount;
} timing;

static bool as_run(fw_arena *arena, const fw_recipe_asrun_entry *e,
                   const fw_process_argument *amount, timing *t) {
    const fw_process_step *s = e->step;
    if (s->nargument > FW_LAW_ARGUMENTS) return false;
    *t = (timing){.arena = arena, .step = s, .amount = (int)(amount - s->argument)};
    for (int i = 0; i < s->nargument; i++) {
        fw_quantity_unit unit;
        t->argument[i] = s->argument[i];
        if (!s->argument[i].q) continue;
        t->q[i] = *s->argument[i].q;
        t->argument[i].q = &t->q[i];
        for (int k = 0; k < e->nset; k++) {
            const fw_quantity *set = e->set[k].q;
            if (set != s->argument[i].q || isnan(e->set[k].value)) continue;
            if (!fw_quantity_unit_parse(set->unit, strlen(set->unit), &unit, NULL, NULL))
                return false;
            t->q[i].value = fw_quantity_unit_to_si(&unit, e->set[k].value);
            t->q[i].unknown = false;
        }
    }
    t->q[t->amount].uncertainty = 0.0; /* it is what is asked */
    t->q[t->amount].unknown = false;
    return true;
}

static fw_status time_for(timing *t, double amount_m, fw_process_law_answer *answer) {
    const fw_process_step *s = t->step;
    t->q[t->amount].value = amount_m;
    const fw_process_law_use use = {.law = fw_process_law_find(s->law),
                                    .shape = s->shape,
                                    .expression = s->expression,
                                    .wanted = FW_DIM_TIME,
                                    .argument = t->argument,
                                    .nargument = s->nargument};
    return fw_process_law_evaluate(t->arena, &use, answer);
}

/* the amount of so much time, from one nearby: times rise with it, not far from in proportion */
static fw_status amount_in(timing *t, double time_s, double *amount_m) {
    enum { ROUNDS = 12 };
    for (int i = 0; i < ROUNDS; i++) {
        fw_process_law_answer answer;
        FW_TRY(time_for(t, *amount_m, &answer));
        if (!answer.computable || !(answer.value > 0)) break;
        *amount_m *= time_s / answer.value;
    }
    return FW_OK;
}

fw_status fw_recipe_asrun_amount_in_time(fw_arena *arena, const fw_recipe_asrun_entry *e,
                                         double loads, double read_s,
                                         fw_recipe_amount_in_time *out) {
    const fw_process_step *s = e->step;
    timing t;
    fw_process_law_answer answer;
    *out = (fw_recipe_amount_in_time){.fits = true};
    const fw_process_argument *amount = s && e->fate == FW_FATE_RUN ? amount_of_law(s) : NULL;
    if (!amount || amount->q->unknown || !s->time.computable) return FW_OK;
    const double measured = amount_measured(e, amount->q, &out->measured);
    if (!(measured > 0) || !as_run(arena, e, amount, &t)) return FW_OK;
    FW_TRY(time_for(&t, measured, &answer));
    if (!answer.computable || !(answer.value > 0)) return FW_OK;
    /* handling, pauses and what is finished at the machine may be in it or not */
    const double more = s->booked_stop_s - s->time.stop_s,
                 off = s->k * answer.uncertainty / answer.value, actual_s = e->end_s - e->start_s;
    const bool brief = actual_s + read_s < answer.value * (1.0 - off);
    const double longest = answer.value * (1.0 + off) * (1.0 + s->overrun) + more;
    if (!brief && actual_s - read_s <= loads * longest) return FW_OK;
    out->fits = false;
    out->law_m = measured;
    out->time_s = brief ? actual_s : actual_s / loads - more;
    out->off = off;
    out->formula = fw_process_law_find(s->law)->formula;
    return amount_in(&t, out->time_s, &out->law_m);
}
