/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Do the values make sense, wherever they come from: a pack, a laboratory, calibrate? Read once with the pack and again
   when a laboratory has replaced some (fw_process_flow_lint_values). Are their uncertainties ones? Can the prices be
   added? Does a filling serve a wafer? */
#include "process/calibrate.h"
#include "process/films.h"
#include "process/pack.h"
#include "xml/xml_reader.h"
#include <math.h>
#include <string.h>

/* ---- ranges ---- */

typedef struct range {
    const char *name, *unit;
    double least, most; /* in the unit */
    const char *reason;
} range;

static const range ranges[] = {
#define X(name, unit, least, most, reason) {name, unit, least, most, reason},
#include "process/quantity_ranges.def"
#undef X
};

enum { RANGES = sizeof ranges / sizeof ranges[0] };

typedef struct units { /* of the rows, each read when it is first asked for; at first {0} */
    fw_quantity_unit of[RANGES];
    bool read[RANGES];
} units;

static const fw_quantity_unit *unit_of(units *u, int row) {
    if (!u->read[row])
        u->read[row] = fw_quantity_unit_parse(ranges[row].unit, strlen(ranges[row].unit),
                                              &u->of[row], NULL, NULL);
    return &u->of[row];
}

/* index, or -1 */
static int row_of(units *u, const char *name, fw_quantity_dimension dimension) {
    for (int i = 0; i < RANGES; i++)
        if (strcmp(ranges[i].name, name) == 0 &&
            fw_quantity_dimension_equal(unit_of(u, i)->dimension, dimension))
            return i;
    return -1;
}

/* How exactly something is read, and how long a wafer may wait, is found by its id (calibrate.h, wafer_state.c): each is of
   a kind whose range it need not name. */
static int row_of_id(units *u, const fw_quantity *q) {
    static const char waits[] = "-longest";
    const size_t n = q->id ? strlen(q->id) : 0, of_wait = sizeof waits - 1;
    if (n > of_wait && strcmp(q->id + n - of_wait, waits) == 0)
        return row_of(u, "wait", q->dimension);
    return n && strncmp(q->id, FW_PROCESS_READ, strlen(FW_PROCESS_READ)) == 0
               ? row_of(u, "reading", q->dimension)
               : -1;
}

static int range_of(units *u, const fw_quantity *q) {
    const int by_id = q->range ? -1 : row_of_id(u, q);
    return by_id >= 0 ? by_id : row_of(u, q->range ? q->range : "", q->dimension);
}

/* has its kind a plausible range at all? Else nothing could be told of its values, and mostly its unit is a slip */
static bool is_of_a_kind(units *u, const fw_quantity *q, fw_diags *diags) {
    if (q->least != 0.0 || q->most != 0.0 || q->range || range_of(u, q) >= 0) return true;
    fw_diag_error(diags, 547, q->place,
                  "'%s' is in %s, and no value of a process is of that kind; correct its unit, or "
                  "state least=\"...\" and most=\"...\"",
                  q->id ? q->id : "q", q->unit);
    return false;
}

static bool in_range(units *u, const fw_quantity *q, fw_diags *diags) {
    if (q->least != 0.0 || q->most != 0.0) return fw_xml_quantity_check_range(q, q, diags);
    int at = q->unknown ? -1 : range_of(u, q);
    if (at < 0) return true;
    const range *r = &ranges[at];
    double least = fw_quantity_unit_to_si(unit_of(u, at), r->least),
           most = fw_quantity_unit_to_si(unit_of(u, at), r->most);
    if (q->value >= least && q->value <= most) return true;
    char is[32], low[32], high[32];
    fw_diag_error(diags, 278, q->place,
                  "'%s' is %s %s, outside its plausible range of %s to %s %s (%s); correct the "
                  "value or its unit",
                  q->id ? q->id : "q", fw_number_text(is, sizeof is, fw_quantity_in_unit(q), 6),
                  q->unit, fw_number_text(low, sizeof low, r->least, 4),
                  fw_number_text(high, sizeof high, r->most, 4), r->unit, r->reason);
    return false;
}

/* ---- uncertainties ---- */

/* What bounds a quantity's error: its plausible range. An interval lies within it; a standard uncertainty is at most half
   as wide; what cannot be below 0 is not more uncertain than it is large, a temperature (K, far from its zero) not by more
   than a quarter. */
static double most_uncertain(const fw_quantity *q, double least, double most) {
    const double width = 0.5 * (most - least);
    const bool hot = fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension){.K = 1});
    if (!(least >= 0.0) || !(q->value > 0.0)) return width;
    return fmin(width, hot ? 0.25 * q->value : q->value);
}

static const char *end_text(char text[32], const fw_quantity *q, double value) {
    fw_quantity end = *q;
    end.value = value;
    return fw_number_text(text, 32, fw_quantity_in_unit(&end), 6);
}

static void too_uncertain(units *u, const fw_quantity *q, fw_diags *diags) {
    const int at = range_of(u, q);
    const bool own = q->least != 0.0 || q->most != 0.0;
    if (q->unknown || (at < 0 && !own)) return;
    const double least = own ? q->least : fw_quantity_unit_to_si(unit_of(u, at), ranges[at].least),
                 most = own ? q->most : fw_quantity_unit_to_si(unit_of(u, at), ranges[at].most),
                 slack = 1e-9 * (most - least), limit = most_uncertain(q, least, most);
    char low[32], high[32], from[32], to[32];
    if (q->interval && (q->low < least - slack || q->high > most + slack)) {
        fw_diag_error(diags, 530, q->place,
                      "'%s' is said to lie between %s and %s %s, outside its plausible range of %s "
                      "to %s %s (%s); correct the ends or their unit, or name another range",
                      q->id ? q->id : "q", end_text(low, q, q->low), end_text(high, q, q->high),
                      q->unit, end_text(from, q, least), end_text(to, q, most), q->unit,
                      own ? "its least and most" : ranges[at].reason);
    } else if (!q->interval && q->uncertainty > limit * (1.0 + 1e-9)) {
        const double unit = q->value != 0.0 && !fw_quantity_dimension_equal(
                                                   q->dimension, (fw_quantity_dimension){.K = 1})
                                ? fw_quantity_in_unit(q) / q->value
                                : 1.0;
        fw_diag_error(diags, 530, q->place,
                      "'%s' has a standard uncertainty of %s %s, but more than %s makes no sense "
                      "for it; correct u or its unit, or leave the value unknown",
                      q->id ? q->id : "q",
                      fw_number_text(low, sizeof low, q->uncertainty * unit, 4), q->unit,
                      fw_number_text(high, sizeof high, limit * unit, 4));
    }
}

static bool is_count(const fw_quantity *q) {
    return q->range && (strcmp(q->range, "count") == 0 || fw_quantity_is_word(q));
}

/* a pack knows which of its numbers are exact: sizes that are chosen, limits, things that are counted */
void fw_process_warn_exact(const fw_quantity *q, const fw_quantity *was, fw_diags *diags) {
    const bool exact = !q->unknown && !q->interval && !(q->uncertainty > 0.0),
               chosen = was && !was->unknown && !(was->uncertainty > 0.0);
    if (!exact || chosen || is_count(was ? was : q)) return;
    if (q->unit && fw_quantity_unit_currency(q->unit)) return; /* an offer is an exact number */
    if (q->status == FW_MEASURED)
        fw_diag_warning(diags, 531, q->place,
                        "'%s' is measured, and stated without an uncertainty (u = 0), so that "
                        "times and corners take it for exact; give what instrument and sites leave",
                        was ? was->id : q->id);
    else if (was && !was->unknown)
        fw_diag_warning(diags, 531, q->place,
                        "'%s' replaces an uncertain value by an exact one (u = 0), so that its "
                        "range falls out of times and corners; give the uncertainty that is left",
                        was->id);
}

bool fw_process_quantity_in_range(const fw_quantity *q, fw_diags *diags) {
    units u = {0};
    return in_range(&u, q, diags);
}

/* the range that the first one of an id gives holds for every one that replaces it */
fw_status fw_process_lint_ranges(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    units u = {0};
    for (int i = 0; i < f->nquantity; i++) {
        fw_quantity *q = f->quantity[i];
        if (q->range && range_of(&u, q) < 0)
            fw_diag_error(pack->diags, 169, q->place,
                          "range='%s' of '%s' is of another dimension than its unit", q->range,
                          q->id);
        for (int j = 0; j < i; j++) {
            const fw_quantity *first = f->quantity[j];
            if (!q->id || !first->id || strcmp(q->id, first->id) != 0) continue;
            if (!fw_quantity_dimension_equal(q->dimension, first->dimension))
                fw_diag_error(pack->diags, 169, q->place,
                              "'%s' replaces the quantity of line %d, which has another dimension; "
                              "give it a unit of that dimension, or another id",
                              q->id, first->place.line);
            else
                fw_xml_quantity_check_range(q, first, pack->diags);
        }
        bool own = fw_process_flow_own_quantity(f, q->id) == q && q->status != FW_DERIVED;
        bool asked = q->least != 0.0 || q->most != 0.0; /* when its element was read */
        if (!is_of_a_kind(&u, q, pack->diags)) continue;
        if (own && (!asked || q->replaced) && !in_range(&u, q, pack->diags)) continue;
        if (own) too_uncertain(&u, q, pack->diags);
        if (own && !q->replaced) fw_process_warn_exact(q, NULL, pack->diags);
    }
    const fw_process_material *m = f->process_material;
    for (const fw_process_material *end = m + f->nprocess_material; m < end; m++)
        if (m->highest_K && m == fw_process_flow_material(f, m->id))
            in_range(&u, m->highest_K, pack->diags);
    return FW_OK;
}

/* ---- set points ---- */

static double bound_of(const char *text) {
    double value;
    return text[0] && fw_number_parse(text, strlen(text), &value) ? value : (double)NAN;
}

static bool limits_cross(fw_process_pack *pack, const fw_process_step *s, const char *what,
                         double low, double high, fw_place place) {
    if (!(low > high)) return false;
    char a[32], b[32];
    fw_diag_error(pack->diags, 342, place,
                  "step %s: the lower limit of '%s', %s, is above the upper one, %s; exchange them",
                  s->id, what, fw_number_text(a, sizeof a, low, 6),
                  fw_number_text(b, sizeof b, high, 6));
    return true;
}

static void lint_setting(fw_process_pack *pack, const fw_process_step *s,
                         const fw_process_setting *set) {
    double low = bound_of(set->tolerance_low), high = bound_of(set->tolerance_high);
    if (limits_cross(pack, s, set->name, low, high, set->place) || set->q->unknown) return;
    double is = fw_quantity_in_unit(set->q), slack = 1e-9 * fabs(is);
    if (!(is < low - slack) && !(is > high + slack)) return;
    char value[32];
    fw_diag_error(pack->diags, 342, set->q->replaced ? set->q->place : set->place,
                  "step %s sets '%s' to %s %s (%s), but allows %s%s%s %s only; correct the value, "
                  "or what the step allows",
                  s->id, set->name, fw_number_text(value, sizeof value, is, 6), set->q->unit,
                  set->q->id ? set->q->id : "q",
                  isnan(low)    ? "at most "
                  : isnan(high) ? "at least "
                                : "",
                  isnan(low) ? "" : set->tolerance_low,
                  isnan(high)  ? ""
                  : isnan(low) ? set->tolerance_high
                               : fw_arena_printf(pack->arena, " to %s", set->tolerance_high),
                  set->q->unit);
}

/* "thickness_2" after "thickness_1": what a curve is read along rises from pair to pair */
static void lint_pairs(fw_process_pack *pack, const fw_process_step *s,
                       const fw_process_argument *argument, int n) {
    static const char *const along[] = {"value_", "thickness_"};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            for (size_t a = 0; a < sizeof along / sizeof *along; a++) {
                const size_t length = strlen(along[a]);
                const fw_quantity *p = argument[i].q, *q = argument[k].q;
                if (strncmp(argument[i].name, along[a], length) != 0 ||
                    strncmp(argument[k].name, along[a], length) != 0 ||
                    argument[k].name[length] != argument[i].name[length] + 1 || p->unknown ||
                    q->unknown || p->value < q->value)
                    continue;
                fw_diag_error(pack->diags, 342, q->replaced ? q->place : s->place,
                              "step %s reads a curve whose points do not rise: '%s' is not above "
                              "'%s'; correct them, or exchange the pairs",
                              s->id, q->id, p->id);
            }
}

/* a bake drives water and solvent out, which no room's warmth does */
static void lint_cold(fw_process_pack *pack, const fw_process_step *s,
                      const fw_process_setting *set) {
    const double least_K = 323.15; /* 50 Cel */
    if (!fw_process_step_is_op(s, "bake") || set->q->unknown || set->q->value >= least_K ||
        !fw_quantity_dimension_equal(set->q->dimension, (fw_quantity_dimension){.K = 1}))
        return;
    char is[32];
    fw_diag_error(
        pack->diags, 532, set->q->replaced ? set->q->place : set->place,
        "step %s bakes at %s %s (%s), where nothing leaves a resist or a wafer; a bake is "
        "above 50 Cel, a rest is op=\"hold\"",
        s->id, fw_number_text(is, sizeof is, fw_quantity_in_unit(set->q), 4), set->q->unit,
        set->q->id);
}

/* ... and nothing that is as thick as a wafer gets warm in seconds */
static void lint_short(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const fw_quantity *t = fw_process_step_argument(s, "time");
    if (!fw_process_step_is_op(s, "bake") || !law || !law->stated || !t || t->unknown ||
        t->value >= 10.0 || !(t->value > 0.0)) /* of no time at all: FW-D534 */
        return;
    fw_diag_error(pack->diags, 532, t->replaced ? t->place : s->place,
                  "step %s bakes for less than ten seconds (%s), in which no wafer gets warm; "
                  "is its unit right?",
                  s->id, t->id);
}

/* thicknesses, depths and widths of laws: a length below 0 is an edge's, which no law takes */
static void lint_lengths(fw_process_pack *pack, const fw_process_step *s,
                         const fw_process_argument *argument, int n) {
    char is[32];
    for (int i = 0; i < n; i++) {
        const fw_quantity *q = argument[i].q;
        if (q->unknown || !(q->value < 0.0) ||
            !fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_LENGTH))
            continue;
        fw_diag_error(pack->diags, 278, q->place,
                      "'%s' is %s %s, and step %s computes with it as its %s, which is not below "
                      "0; correct the value",
                      q->id, fw_number_text(is, sizeof is, fw_quantity_in_unit(q), 6), q->unit,
                      s->id, argument[i].name);
    }
}

/* the shortest time that does is not above the longest that harms nothing */
static void lint_between(fw_process_pack *pack, const fw_process_step *s) {
    const fw_quantity *least = fw_process_step_argument(s, "shortest"),
                      *most = fw_process_step_argument(s, "longest");
    if (!least || !most || least->unknown || most->unknown || least->value <= most->value) return;
    fw_diag_error(pack->diags, 342, least->replaced ? least->place : s->place,
                  "step %s: the shortest time, '%s', is above the longest one, '%s'; correct them",
                  s->id, least->id, most->id);
}

/* ---- what a kind of step can do ---- */

typedef struct step_range {
    const char *op, *at, *name, *unit;
    double least, most; /* in the unit */
    const char *reason;
} step_range;

static const step_range step_ranges[] = {
#define X(op, at, name, unit, least, most, reason) {op, at, name, unit, least, most, reason},
#include "process/step_ranges.def"
#undef X
};

enum { STEP_RANGES = sizeof step_ranges / sizeof step_ranges[0] };

typedef struct step_units { /* of the rows, read once */
    fw_quantity_unit of[STEP_RANGES];
} step_units;

static void read_step_units(step_units *u) {
    for (int i = 0; i < STEP_RANGES; i++)
        fw_quantity_unit_parse(step_ranges[i].unit, strlen(step_ranges[i].unit), &u->of[i], NULL,
                               NULL);
}

static bool is_oven(const fw_process_step *s) {
    return fw_process_step_load(s) > 1 || (s->equipment && s->equipment->vacuum);
}

static bool is_of_step(const step_range *r, const fw_process_step *s, const char *name) {
    const bool any =
        strcmp(r->name, "*") == 0 && strcmp(name, "finish") != 0 && strcmp(name, "uses") != 0;
    return (r->op[0] == '\0' || fw_process_step_is_op(s, r->op)) &&
           (any || strcmp(r->name, name) == 0) && (r->at[0] == '\0' || is_oven(s));
}

static void not_of_step(fw_process_pack *pack, const fw_process_step *s, const step_range *r,
                        const fw_quantity *q, bool fast) {
    char is[32], least[32], most[32];
    const char *value = fw_number_text(is, sizeof is, fw_quantity_in_unit(q), 4),
               *low = fw_number_text(least, sizeof least, r->least, 4),
               *high = fw_number_text(most, sizeof most, r->most, 4), *id = q->id ? q->id : "q",
               *unit = q->unit;
    const fw_place place = q->replaced ? q->place : s->place;
    if (fast)
        fw_diag_error(pack->diags, 544, place,
                      "step %s (%s) computes with a rate of %s %s (%s), but none is above %s %s: "
                      "%s; correct the value or its unit",
                      s->id, s->op, value, unit, id, high, r->unit, r->reason);
    else
        fw_diag_error(pack->diags, 587, place,
                      "step %s (%s) takes %s %s (%s), where only %s to %s %s make sense: %s; "
                      "correct the value or its unit",
                      s->id, s->op, value, unit, id, low, high, r->unit, r->reason);
}

/* name: what the step takes it for. A stated time of none is FW-D534 */
static void lint_of_step(fw_process_pack *pack, const step_units *u, const fw_process_step *s,
                         const char *name, const fw_quantity *q) {
    const bool no_time = q && !(q->value > 0.0) && !(q->value < 0.0) && strcmp(name, "time") == 0;
    if (!q || q->unknown || q->word || no_time) return;
    for (int i = 0; i < STEP_RANGES; i++) {
        const step_range *r = &step_ranges[i];
        const fw_quantity_unit *unit = &u->of[i];
        if (!fw_quantity_dimension_equal(unit->dimension, q->dimension) || !is_of_step(r, s, name))
            continue;
        const double least = fw_quantity_unit_to_si(unit, r->least) * (1.0 - 1e-9),
                     most = fw_quantity_unit_to_si(unit, r->most) * (1.0 + 1e-9);
        const bool small = q->value<least, large = q->value> most;
        if (!small && !large) continue;
        not_of_step(pack, s, r, q, large && strcmp(r->name, "rate") == 0);
        return;
    }
}

/* a time that is worked out is another thing than one that is stated */
static void lint_arguments(fw_process_pack *pack, const step_units *u, const fw_process_step *s,
                           const char *law, const fw_process_argument *argument, int n) {
    const fw_process_law *of = fw_process_law_find(law);
    for (int i = 0; i < n; i++)
        if (strcmp(argument[i].name, "time") != 0 || (of && of->stated))
            lint_of_step(pack, u, s, argument[i].name, argument[i].q);
}

static void lint_step_ranges(fw_process_pack *pack, const step_units *u, const fw_process_step *s) {
    lint_arguments(pack, u, s, s->law, s->argument, s->nargument);
    for (int k = 0; k < s->nderive; k++)
        lint_arguments(pack, u, s, s->derive[k].law, s->derive[k].argument, s->derive[k].nargument);
    for (int k = 0; k < s->nsetting; k++)
        lint_of_step(pack, u, s, "set", s->setting[k].q);
    for (int k = 0; k < s->nfinish; k++)
        lint_of_step(pack, u, s, "finish", s->finish[k].time);
    for (int k = 0; k < s->nuse; k++)
        lint_of_step(pack, u, s, "uses", s->use[k].q);
    lint_of_step(pack, u, s, "pulse", s->pulse);
}

fw_status fw_process_lint_settings(fw_process_pack *pack) {
    step_units of_steps;
    read_step_units(&of_steps);
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        for (int k = 0; k < s->nsetting; k++)
            lint_setting(pack, s, &s->setting[k]), lint_cold(pack, s, &s->setting[k]);
        for (int k = 0; k < s->naccept; k++)
            fw_process_lint_unit(pack, s, &s->accept[k]);
        lint_between(pack, s);
        lint_short(pack, s);
        lint_pairs(pack, s, s->argument, s->nargument);
        lint_step_ranges(pack, &of_steps, s);
        if (s->expression[0] == '\0') lint_lengths(pack, s, s->argument, s->nargument);
        for (int k = 0; k < s->nderive; k++)
            lint_pairs(pack, s, s->derive[k].argument, s->derive[k].nargument);
        for (int k = 0; k < s->naccept; k++)
            limits_cross(pack, s, s->accept[k].measure, bound_of(s->accept[k].low),
                         bound_of(s->accept[k].high), s->accept[k].place);
    }
    return FW_OK;
}

/* ---- thicknesses ---- */

/* how uncertain a film is known to be, as it was put there; m */
static double film_uncertainty(const fw_process_flow *f, int before, const char *material) {
    double u = 0.0;
    for (int i = 0; i < before; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (strcmp(c->kind, "add") == 0 && strcmp(c->material, material) == 0 && c->thickness)
                u = fmax(u, c->thickness->uncertainty);
        }
    return u;
}

/* a layer has a thickness, and more of it cannot be turned into another one than there is for sure, within two standard
   uncertainties of either */
static fw_status lint_thickness(fw_process_pack *pack, int step, int change) {
    const fw_process_flow *f = pack->flow;
    const fw_process_change *c = &f->step[step].change[change];
    fw_process_stack stack;
    if (!c->thickness || c->thickness->unknown) return FW_OK;
    if (!(c->thickness->value > 0.0)) {
        fw_diag_error(pack->diags, 278, c->thickness->replaced ? c->thickness->place : c->place,
                      "step %s changes a layer by the thickness '%s', which is not above 0",
                      f->step[step].id, c->thickness->id ? c->thickness->id : "q");
        return FW_OK;
    }
    if (strcmp(c->kind, "convert") != 0) return FW_OK;
    FW_TRY(fw_process_flow_stack_before(pack->arena, f, step, change, &stack));
    for (int column = 0; column < stack.columns; column++)
        for (int i = stack.n[column] - 1; i >= 0; i--) {
            const fw_process_cell *cell = &stack.cell[column][i];
            if (strcmp(cell->material, c->from) != 0) continue;
            const double sure =
                hypot(film_uncertainty(f, step, c->from), c->thickness->uncertainty);
            if (!(c->thickness->value >= cell->thickness_m - 2.0 * sure)) break;
            char made[32], is[32];
            fw_diag_error(pack->diags, 344, c->thickness->replaced ? c->thickness->place : c->place,
                          "step %s turns %s um of '%s' into '%s', but the layer is only %s um "
                          "thick, with uncertainties of which nothing may be left",
                          f->step[step].id,
                          fw_number_text(made, sizeof made, c->thickness->value * 1e6, 6), c->from,
                          c->material, fw_number_text(is, sizeof is, cell->thickness_m * 1e6, 6));
            return FW_OK;
        }
    return FW_OK;
}

fw_status fw_process_lint_thicknesses(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        for (int k = 0; k < pack->flow->step[i].nchange; k++)
            FW_TRY(lint_thickness(pack, i, k));
    return FW_OK;
}

/* ---- prices ---- */

static void one_currency(fw_process_pack *pack, const fw_quantity *price, const char **first) {
    const char *is = price->unknown ? NULL : fw_quantity_unit_currency(price->unit);
    if (!is) return;
    if (!*first) *first = is;
    if (*first != is)
        fw_diag_error(pack->diags, 371, price->place,
                      "'%s' is in %s, and another price is in %s; the rate is not known here: give "
                      "all prices in one currency",
                      price->id, is, *first);
}

fw_status fw_process_lint_prices(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    const char *first = NULL;
    for (int i = 0; i < f->nconsumable; i++)
        one_currency(pack, f->consumable[i].price, &first);
    for (int i = 0; i < f->nequipment; i++)
        one_currency(pack, f->equipment[i].price, &first);
    for (int i = 0; i < f->nbath; i++) {
        const fw_quantity *q = f->bath[i].serves;
        if (q && !q->unknown && !(q->value >= 1.0))
            fw_diag_error(pack->diags, 370, q->place,
                          "a filling of bath '%s' serves less than one wafer (%s); make the volume "
                          "larger, or correct the number",
                          f->bath[i].id, q->id);
    }
    return FW_OK;
}

/* ---- hazards of what is used as it is, and of baths ---- */

static bool names(const fw_process_step *s, const char *hazard) {
    for (int i = 0; i < s->nhazard; i++)
        if (strcmp(s->hazard[i]->id, hazard) == 0) return true;
    return false;
}

static void named(fw_process_pack *pack, const fw_process_step *s, const fw_process_use *u) {
    const char *id = u->bath ? u->bath->id : u->consumable->id;
    const fw_process_hazard *hazard = u->bath ? u->bath->hazard : u->consumable->hazard;
    if (hazard && !names(s, hazard->id))
        fw_diag_error(pack->diags, 374, u->place,
                      "step %s uses '%s', whose hazard '%s' it does not name; add <hazard-ref "
                      "ref=\"%s\"/>",
                      s->id, id, hazard->id, hazard->id);
}

/* what a wafer is rinsed in at the end */
static void finished_in(fw_process_pack *pack, const fw_process_step *s) {
    for (int k = 0; k < s->nfinish; k++) {
        const fw_process_hazard *with = s->finish[k].with;
        if (with && !names(s, with->id))
            fw_diag_error(pack->diags, 374, s->finish[k].place,
                          "step %s rinses in '%s', which it does not name as a hazard; add "
                          "<hazard-ref ref=\"%s\"/>",
                          s->id, with->id, with->id);
    }
}

/* what hurts at a tool whatever is done there */
static void brought(fw_process_pack *pack, const fw_process_step *s) {
    const char *words = s->equipment ? s->equipment->brings : "";
    for (fw_word word; fw_word_next(&words, " ", &word);) {
        const char *id = fw_arena_strndup(pack->arena, word.at, word.length);
        if (id && !names(s, id))
            fw_diag_error(pack->diags, 528, s->place,
                          "step %s is at '%s', which brings '%s', and does not name it; add "
                          "<hazard-ref ref=\"%s\"/>",
                          s->id, s->equipment->id, id, id);
    }
}

static bool is_with_buddy(const fw_process_step *s) {
    for (int i = 0; i < s->nhazard; i++)
        if (s->hazard[i]->buddy) return true;
    return false;
}

/* at a bench of something that nobody handles alone every step is of that kind */
static void beside(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_flow *f = pack->flow;
    if (is_with_buddy(s) || !s->equipment) return;
    for (int i = 0; i < f->nstep; i++) {
        if (f->step[i].equipment != s->equipment || !is_with_buddy(&f->step[i])) continue;
        fw_diag_error(pack->diags, 528, s->place,
                      "step %s is at '%s', where step %s works with what nobody handles alone, and "
                      "names no such hazard; add its <hazard-ref>, or use another bench",
                      s->id, s->equipment->id, f->step[i].id);
        return;
    }
}

fw_status fw_process_lint_uses(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        for (int k = 0; k < s->nuse; k++)
            named(pack, s, &s->use[k]);
        finished_in(pack, s);
        brought(pack, s);
        beside(pack, s);
    }
    return FW_OK;
}
