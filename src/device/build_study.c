/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <study> with its inputs and responses: of a device file, and of a file of its own. */
#include "device/device_reader.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

/* place of a word in its list; the first where it is absent or was reported */
static int word_of(const fw_xml_record *record, const char *name, const char *const *words,
                   int absent) {
    const char *given = fw_xml_text_of(record, name);
    for (int i = 0; given && words[i]; i++)
        if (strcmp(words[i], given) == 0) return i;
    return absent;
}

/* a value of any dimension, or of *dimension where `known`; NaN: absent or reported */
static fw_status value_of(fw_xml_reader *r, const fw_xml_record *record, const char *name,
                          bool *known, fw_quantity_dimension *dimension, double *value) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    fw_quantity_dimension found;
    bool ok = false;
    *value = (double)NAN;
    if (!cell->given) return FW_OK;
    FW_TRY(fw_xml_attribute_evaluate(r, cell->given, name, *known ? dimension : NULL, &found, value,
                                     &ok));
    if (!ok) *value = (double)NAN;
    if (ok && !*known) *dimension = found, *known = true;
    return FW_OK;
}

/* the unit that a value is written with ("10 um"); NULL: it is an expression, or has none */
static const char *unit_written(fw_arena *arena, const fw_xml_record *record, const char *name) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    const char *text = cell->given ? cell->given->value : "";
    size_t n = strcspn(text, " \t");
    double number;
    fw_quantity_unit unit;
    if (!fw_number_parse(text, n, &number)) return NULL;
    const char *rest = text + n + strspn(text + n, " \t");
    size_t length = strlen(rest);
    while (length > 0 && (rest[length - 1] == ' ' || rest[length - 1] == '\t'))
        length--;
    if (length > 0 && !fw_quantity_unit_parse(rest, length, &unit, NULL, NULL)) return NULL;
    return fw_arena_strndup(arena, rest, length);
}

/* how far values are apart is no temperature of its own: 5 Cel would be 278.15 K */
static void check_difference(fw_xml_reader *r, const fw_xml_record *record, const char *name) {
    const char *written = unit_written(r->arena, record, name);
    fw_quantity_unit unit;
    if (!written || !fw_quantity_unit_parse(written, strlen(written), &unit, NULL, NULL)) return;
    if (unit.offset != 0)
        fw_diag_error(r->diags, 491, fw_xml_place_of(record, name),
                      "%s is a difference of temperatures, and '%s' counts from the ice point; "
                      "write it in K",
                      name, written);
}

/* the first of `names` that is written with a unit decides; "" for pure numbers. A dimension that no
   unit was written with is asked for one. */
static fw_status unit_of(fw_xml_reader *r, const fw_xml_record *record, const char *const *names,
                         fw_quantity_dimension dimension, const char **unit) {
    static const fw_quantity_dimension pure = {0};
    char label[FW_LABEL];
    const char *first = NULL;
    *unit = "";
    for (int i = 0; names[i]; i++) {
        const char *written = unit_written(r->arena, record, names[i]);
        if (!first && fw_xml_given(record, names[i])) first = names[i];
        if (written && (*written || fw_quantity_dimension_equal(dimension, pure))) {
            *unit = written;
            return FW_OK;
        }
    }
    if (fw_quantity_dimension_equal(dimension, pure)) return FW_OK;
    return fw_diag_error(r->diags, 490, fw_xml_place_of(record, first ? first : "what"),
                         "%s: write one of its ends as a number with a unit (\"10 um\"): the "
                         "values of the study are written in it",
                         fw_xml_label(record, label)) == FW_NOMEM
               ? FW_NOMEM
               : FW_OK;
}

/* "8 um; 10 um" into its parts */
static fw_status split(fw_arena *arena, const char *text, const char ***part, int *n) {
    size_t most = 1;
    for (const char *at = text; *at; at++)
        most += *at == ';';
    *n = 0;
    FW_NEED(*part = fw_arena_array(arena, const char *, most));
    while (*text) {
        text += strspn(text, " \t\n");
        size_t length = strcspn(text, ";"), kept = length;
        while (kept > 0 && strchr(" \t\n", text[kept - 1]))
            kept--;
        if (kept > 0) FW_NEED((*part)[(*n)++] = fw_arena_strndup(arena, text, kept));
        text += length + (text[length] == ';');
    }
    return FW_OK;
}

static void wrong(fw_xml_reader *r, const fw_xml_record *record, const char *at, const char *what) {
    char label[FW_LABEL];
    fw_diag_error(r->diags, 490, at ? fw_xml_place_of(record, at) : record->element->place,
                  "%s: %s", fw_xml_label(record, label), what);
}

static void check_range(fw_xml_reader *r, const fw_xml_record *record, const fw_device_vary *v) {
    bool from = fw_xml_given(record, "from"), to = fw_xml_given(record, "to");
    if (v->ntext > 0 && (from || to || fw_xml_given(record, "steps")))
        wrong(r, record, "values",
              "values are listed, and from, to and steps say others; keep one");
    else if (v->ntext == 0 && !(from && to))
        wrong(r, record, NULL, "needs from=\"...\" and to=\"...\", or values=\"...\"");
    else if (v->from >= v->to)
        wrong(r, record, "from", "from must be below to; exchange or correct them");
    else if (v->logarithmic && !(v->from > 0))
        wrong(r, record, "scale", "equal ratios need values above 0; make the scale linear");
}

static fw_status build_vary(fw_xml_reader *r, const fw_xml_record *record, fw_device_study *s) {
    static const char *const ends[] = {"from", "to", NULL};
    fw_device_vary v = {
        .what = fw_xml_text_of(record, "what"),
        .unit = "",
        .logarithmic =
            word_of(record, "scale", (const char *const[]){"linear", "logarithmic", NULL}, 0) == 1,
        .steps = fw_xml_whole_or(record, "steps", 11),
        .stepped = fw_xml_given(record, "steps"),
        .place = record->element->place};
    bool known = false;
    size_t before = r->diags->errors;
    const char *values = fw_xml_text_of(record, "values");
    FW_TRY(value_of(r, record, "from", &known, &v.dimension, &v.from));
    FW_TRY(value_of(r, record, "to", &known, &v.dimension, &v.to));
    if (values) FW_TRY(split(r->arena, values, &v.text, &v.ntext));
    if (values && v.ntext == 0) wrong(r, record, "values", "no value is listed");
    if (r->diags->errors == before) check_range(r, record, &v);
    if (r->diags->errors == before && v.ntext == 0)
        FW_TRY(unit_of(r, record, ends, v.dimension, &v.unit));
    if (v.what) s->vary[s->nvary++] = v;
    return FW_OK;
}

/* is it of the same input as an earlier row? */
static bool is_same_input(const char *what, const char *flow, const fw_device_uncertain *u) {
    return strcmp(what, u->what) == 0 && !flow == !u->flow && (!flow || strcmp(flow, u->flow) == 0);
}

/* "1e-8 N m 0.3": a value, whose unit may have blanks within and is (*nunit) long, its dimension that of the first, and a
   share */
static bool read_entry(const char *text, const char **unit_text, size_t *nunit,
                       fw_quantity_dimension *dimension, bool first, double *x, double *p) {
    size_t n = strlen(text), at = n, length = strcspn(text, " \t\n");
    fw_quantity_unit unit = {.factor = 1};
    double number;
    while (at > 0 && !strchr(" \t\n", text[at - 1]))
        at--;
    if (at == 0 || !fw_number_parse(text + at, n - at, p) ||
        !fw_number_parse(text, length, &number))
        return false;
    const char *rest = text + length + strspn(text + length, " \t\n");
    size_t kept = rest < text + at ? (size_t)(text + at - rest) : 0;
    while (kept > 0 && strchr(" \t\n", rest[kept - 1]))
        kept--;
    if (kept > 0 && !fw_quantity_unit_parse(rest, kept, &unit, NULL, NULL)) return false;
    if (first)
        *dimension = unit.dimension, *unit_text = rest, *nunit = kept;
    else if (!fw_quantity_dimension_equal(*dimension, unit.dimension))
        return false;
    *x = fw_quantity_unit_to_si(&unit, number);
    return true;
}

static fw_status build_table(fw_xml_reader *r, const fw_xml_record *record,
                             fw_device_uncertain *u) {
    const char *text = fw_xml_text_of(record, "table"), **part, *what = NULL, *unit = "";
    char label[FW_LABEL];
    size_t nunit = 0;
    int n;
    if (!text) return FW_OK;
    FW_TRY(split(r->arena, text, &part, &n));
    FW_NEED(u->x = fw_arena_array(r->arena, double, (size_t)n + 1));
    FW_NEED(u->p = fw_arena_array(r->arena, double, (size_t)n + 1));
    u->ntable = n;
    if (n < 2) what = "a table has two values at least, the first with 0 and the last with 1";
    for (int i = 0; i < n && !what; i++) {
        if (!read_entry(part[i], &unit, &nunit, &u->dimension, i == 0, &u->x[i], &u->p[i]))
            what = fw_arena_printf(
                r->arena,
                "'%s' is no value with a share: a number with its unit, a blank and a share, as in "
                "\"8 um 0.3\" or \"1e-8 N m 0.3\", all of one dimension",
                part[i]);
        else if (i > 0 && !(u->x[i] > u->x[i - 1] && u->p[i] >= u->p[i - 1]))
            what = "values rise, and so do shares";
    }
    if (!what && (u->p[0] != 0 || u->p[n - 1] != 1)) what = "shares go from 0 to 1";
    if (what)
        return fw_diag_error(r->diags, 491, fw_xml_place_of(record, "table"), "%s: %s",
                             fw_xml_label(record, label), what) == FW_NOMEM
                   ? FW_NOMEM
                   : FW_OK;
    u->from = u->x[0], u->to = u->x[n - 1];
    FW_NEED(u->unit = fw_arena_strndup(r->arena, unit, nunit));
    static const fw_quantity_dimension pure = {0};
    if (fw_quantity_dimension_equal(u->dimension, pure)) u->unit = "";
    return FW_OK;
}

/* the <vary> that chooses it, so that what is uncertain is a deviation from that; -1: none */
static int chosen_by(const fw_device_study *s, const char *what, const char *flow) {
    for (int k = 0; k < s->nvary && what && !flow; k++)
        if (strcmp(s->vary[k].what, what) == 0) return k;
    return -1;
}

/* which of mean, sd, from and to a spread is stated by; further: it is a deviation, from an earlier row's mean or from
   what is chosen */
static void check_spread(fw_xml_reader *r, const fw_xml_record *record,
                         const fw_device_uncertain *u, bool further) {
    static const char *const name[] = {"mean", "sd", "from", "to"};
    static const unsigned needs[] = {
        [FW_SPREAD_NORMAL] = 3,     [FW_SPREAD_LOGNORMAL] = 3, [FW_SPREAD_UNIFORM] = 12,
        [FW_SPREAD_TRUNCATED] = 15, [FW_SPREAD_TABLE] = 0,     [FW_SPREAD_INTERVAL] = 12};
    char label[FW_LABEL];
    bool free_mean = u->spread == FW_SPREAD_NORMAL && u->flow && !further;
    for (int i = 0; i < 4; i++) {
        bool given = fw_xml_given(record, name[i]), needed = needs[u->spread] >> i & 1u;
        if (i == 0 && further && u->spread == FW_SPREAD_NORMAL) needed = false;
        if (given == needed || (i == 0 && free_mean)) continue;
        fw_diag_error(
            r->diags, 491, given ? fw_xml_place_of(record, name[i]) : record->element->place,
            needed ? "%s: spread=\"%s\" needs %s=\"...\""
            : further
                ? "%s: spread=\"%s\" is a deviation here, from the first row of the input or from "
                  "what is chosen, and has no %s; remove it"
                : "%s: spread=\"%s\" has no %s; remove it, or name another spread",
            fw_xml_label(record, label), fw_device_study_words_of.spread[u->spread], name[i]);
        return;
    }
    const bool table = fw_xml_given(record, "table");
    if (table != (u->spread == FW_SPREAD_TABLE))
        fw_diag_error(
            r->diags, 491, table ? fw_xml_place_of(record, "table") : record->element->place,
            table ? "%s: a table belongs to spread=\"table\"; remove it, or name that spread"
                  : "%s: spread=\"table\" needs table=\"7.8 um 0; 8 um 0.3; 8.4 um 1\"",
            fw_xml_label(record, label));
    else if (u->sd <= 0)
        fw_diag_error(r->diags, 491, fw_xml_place_of(record, "sd"),
                      "%s: a spread must be above 0; what has none is no uncertainty",
                      fw_xml_label(record, label));
    else if (u->from >= u->to)
        fw_diag_error(r->diags, 491, fw_xml_place_of(record, "from"),
                      "%s: from must be below to; exchange or correct them",
                      fw_xml_label(record, label));
    else if (u->spread == FW_SPREAD_LOGNORMAL && u->mean <= 0)
        fw_diag_error(r->diags, 491, fw_xml_place_of(record, "mean"),
                      "%s: a lognormal spread is of values above 0", fw_xml_label(record, label));
}

/* what a level, and a further row of an input, ask for */
static void check_level(fw_xml_reader *r, const fw_xml_record *record, const fw_device_study *s,
                        const fw_device_uncertain *u, bool further) {
    char label[FW_LABEL];
    const char *what = NULL;
    bool all = strncmp(u->what, "flexure[*]/", 11) == 0;
    if (further && u->spread != FW_SPREAD_NORMAL && u->spread != FW_SPREAD_UNIFORM)
        what = "it is a deviation, from the mean of the input's first row or from what is chosen: "
               "normal with sd, or uniform with from and to about 0";
    else if (further && u->spread == FW_SPREAD_UNIFORM && !(u->from < 0 && u->to > 0))
        what = "it is a deviation, from the mean of the input's first row or from what is chosen: "
               "from is below 0 and to above";
    else if (u->spread == FW_SPREAD_INTERVAL && (u->levelled || further))
        what =
            "an interval is one value of which nothing is known, on no level; remove the level, or "
            "name a spread";
    else if (u->level == FW_LEVEL_HINGE && u->flow)
        what = "a flow makes all hinges of a die alike; what differs from hinge to hinge is an "
               "attribute of the flexures, what=\"flexure[*]/@width\"";
    else if (u->level == FW_LEVEL_HINGE && !all)
        what = "what differs from hinge to hinge is an attribute of all flexures, "
               "what=\"flexure[*]/@width\"";
    for (int k = 0; k < s->nuncertain && !what; k++) {
        const fw_device_uncertain *before = &s->uncertain[k];
        if (!is_same_input(u->what, u->flow, before)) continue;
        if (before->level == u->level)
            what = "the input has a row of this level; rows of one input are of different levels";
        else if (before->spread == FW_SPREAD_INTERVAL)
            what = "an input of which only an interval is known has no levels";
        else if (!fw_quantity_dimension_equal(before->dimension, u->dimension))
            what = "its rows are of different dimensions";
    }
    if (what)
        fw_diag_error(r->diags, 556, record->element->place, "%s: %s", fw_xml_label(record, label),
                      what);
}

static fw_status build_uncertain(fw_xml_reader *r, const fw_xml_record *record,
                                 fw_device_study *s) {
    static const char *const parts[] = {"mean", "from", "to", "sd", NULL};
    const fw_device_study_words *words = &fw_device_study_words_of;
    fw_device_uncertain u = {
        .what = fw_xml_text_of(record, "what"),
        .flow = fw_xml_text_of(record, "flow"),
        .level = (fw_device_level)word_of(record, "level", words->level, FW_LEVEL_DIE),
        .levelled = fw_xml_given(record, "level"),
        .unit = "",
        .spread = (fw_device_spread)word_of(record, "spread", words->spread, 0),
        .place = record->element->place};
    u.chosen = chosen_by(s, u.what, u.flow);
    u.deviates = u.chosen >= 0;
    bool known = false, further = u.deviates;
    size_t before = r->diags->errors;
    for (int k = 0; k < s->nuncertain && u.what; k++)
        further = further || is_same_input(u.what, u.flow, &s->uncertain[k]);
    FW_TRY(value_of(r, record, "mean", &known, &u.dimension, &u.mean));
    FW_TRY(value_of(r, record, "from", &known, &u.dimension, &u.from));
    FW_TRY(value_of(r, record, "to", &known, &u.dimension, &u.to));
    FW_TRY(value_of(r, record, "sd", &known, &u.dimension, &u.sd));
    check_difference(r, record, "sd");
    if (r->diags->errors == before) check_spread(r, record, &u, further);
    if (u.spread == FW_SPREAD_TABLE) {
        if (r->diags->errors == before) FW_TRY(build_table(r, record, &u));
    } else if (r->diags->errors == before)
        FW_TRY(unit_of(r, record, parts, u.dimension, &u.unit));
    if (r->diags->errors == before && u.what) check_level(r, record, s, &u, further);
    if (u.what) s->uncertain[s->nuncertain++] = u;
    return FW_OK;
}

static fw_status build_trend(fw_xml_reader *r, const fw_xml_record *record, fw_device_study *s) {
    fw_device_trend t = {.what = fw_xml_text_of(record, "what"),
                         .flow = fw_xml_text_of(record, "flow"),
                         .place = record->element->place};
    char label[FW_LABEL];
    bool known = false;
    size_t before = r->diags->errors;
    FW_TRY(value_of(r, record, "radial", &known, &t.dimension, &t.radial));
    FW_TRY(value_of(r, record, "along-x", &known, &t.dimension, &t.along_x));
    FW_TRY(value_of(r, record, "along-y", &known, &t.dimension, &t.along_y));
    check_difference(r, record, "radial");
    check_difference(r, record, "along-x");
    check_difference(r, record, "along-y");
    const char *what = known || r->diags->errors > before
                           ? NULL
                           : "needs radial=\"...\", along-x=\"...\" or along-y=\"...\"";
    for (int k = 0; k < s->ntrend && t.what && !what; k++)
        if (strcmp(t.what, s->trend[k].what) == 0 && !t.flow == !s->trend[k].flow &&
            (!t.flow || strcmp(t.flow, s->trend[k].flow) == 0))
            what = "the input has a trend; keep one row, with all three numbers";
    if (what) fw_diag_error(r->diags, 557, t.place, "%s: %s", fw_xml_label(record, label), what);
    double *const part[] = {&t.radial, &t.along_x, &t.along_y};
    for (int k = 0; k < 3; k++)
        if (isnan(*part[k])) *part[k] = 0;
    if (t.what) s->trend[s->ntrend++] = t;
    return FW_OK;
}

static void build_correlation(const fw_xml_record *record, fw_device_study *s) {
    const fw_device_correlation c = {.of = fw_xml_text_of(record, "of"),
                                     .with = fw_xml_text_of(record, "with"),
                                     .flow = fw_xml_text_of(record, "flow"),
                                     .value = fw_xml_number_or(record, "value", 0),
                                     .place = record->element->place};
    if (c.of && c.with) s->correlation[s->ncorrelation++] = c;
}

static fw_status build_respond(fw_xml_reader *r, const fw_xml_record *record, fw_device_study *s) {
    const fw_device_study_words *words = &fw_device_study_words_of;
    fw_device_respond q = {
        .name = fw_xml_text_of(record, "name"),
        .value = fw_xml_text_of(record, "value"),
        .take = (fw_device_respond_take)word_of(record, "take", words->take, FW_TAKE_ONE),
        .goal = (fw_device_respond_goal)word_of(record, "goal", words->goal, FW_GOAL_NONE),
        .place = record->element->place,
        .min_place = fw_xml_place_of(record, "min"),
        .max_place = fw_xml_place_of(record, "max")};
    bool known = false;
    FW_TRY(value_of(r, record, "min", &known, &q.dimension, &q.min));
    FW_TRY(value_of(r, record, "max", &known, &q.dimension, &q.max));
    if (q.min > q.max) wrong(r, record, "min", "min is above max; exchange them");
    for (int i = 0; q.name && i < s->nrespond; i++)
        if (strcmp(s->respond[i].name, q.name) == 0)
            wrong(r, record, "name", "another response of this study has the name; rename one");
    if (q.name && q.value) s->respond[s->nrespond++] = q;
    return FW_OK;
}

/* an input that is chosen twice, or chosen and left to chance, has two values */
static void check_inputs(fw_xml_reader *r, const fw_device_study *s) {
    for (int i = 0; i < s->nuncertain; i++) {
        const fw_device_uncertain *u = &s->uncertain[i];
        if (u->deviates && s->yield > 0 &&
            (s->vary[u->chosen].ntext > 0 ||
             !fw_quantity_dimension_equal(u->dimension, s->vary[u->chosen].dimension)))
            fw_diag_error(r->diags, 491, u->place,
                          "study '%s': '%.80s' is chosen between from and to; what it differs by "
                          "is of the same dimension, and listed values have no spread of their own",
                          s->name ? s->name : "", u->what);
    }
    for (int i = 0; i < s->nvary + s->nuncertain; i++) {
        const char *what = i < s->nvary ? s->vary[i].what : s->uncertain[i - s->nvary].what;
        fw_place place = i < s->nvary ? s->vary[i].place : s->uncertain[i - s->nvary].place;
        for (int k = 0; k < i; k++) {
            const char *other = k < s->nvary ? s->vary[k].what : s->uncertain[k - s->nvary].what;
            /* several rows of chance add up, level by level */
            if (strcmp(what, other) != 0 || (i >= s->nvary && k >= s->nvary)) continue;
            if (s->yield > 0 && i >= s->nvary) continue; /* chosen, and made off by something */
            fw_diag_error(r->diags, 490, place,
                          "study '%s': '%.80s' has two rows; an input is chosen or left to chance, "
                          "once",
                          s->name ? s->name : "", what);
            return;
        }
    }
}

/* what response surfaces cannot tell; NULL: they may */
static const char *unfit(const fw_device_study *s) {
    if (s->kind == FW_STUDY_IS_yield)
        return "fitted=\"...\" belongs to kind=\"sweep\"; a yield judges every die that it counts, "
               "and "
               "chooses few: remove it, or take a sweep with as=\"die\", of whose rows the share "
               "that "
               "is accepted is the yield of one flow";
    if (s->kind != FW_STUDY_IS_sweep) return "fitted=\"...\" belongs to kind=\"sweep\"; remove it";
    if (s->points == FW_POINTS_LIST)
        return "a list has few points, and each is judged; remove fitted, or take "
               "points=\"sobol\"";
    if (s->judge == FW_JUDGE_MADE)
        return "fitted=\"...\" tells devices as drawn, since what flows make of them is searched "
               "in each device anew; take as=\"drawn\" or as=\"hinges\", or as=\"die\", which is "
               "one of what a flow may make; or remove it";
    for (int k = 0; k < s->nvary; k++)
        if (s->vary[k].ntext > 0)
            return "fitted=\"...\" goes between values, and a <vary> lists its own; give it from "
                   "and to, or remove fitted";
    return NULL;
}

/* what a kind needs to have anything to do */
static void check_kind(fw_xml_reader *r, const fw_xml_record *record, const fw_device_study *s) {
    int goals = 0;
    for (int i = 0; i < s->nrespond; i++)
        goals += s->respond[i].goal != FW_GOAL_NONE;
    const char *what = NULL;
    switch (s->kind) {
    case FW_STUDY_IS_sweep:
        if (s->nvary == 0 && s->judge != FW_JUDGE_DIE) what = "a sweep needs at least one <vary>";
        if (s->nvary == 0 && s->judge == FW_JUDGE_DIE && s->points != FW_POINTS_SOBOL)
            what = "dies of one device are so many as samples say; add points=\"sobol\"";
        break;
    case FW_STUDY_IS_yield:
        break;
    case FW_STUDY_IS_size:
        if (s->nvary == 0) what = "a size needs at least one <vary>: what may be chosen";
        if (goals == 0)
            what = "a size needs goal=\"minimise\" or \"maximise\" at one <respond>, or at two";
        if (goals > 2) what = "more than two goals; leave the others as limits";
        break;
    case FW_STUDY_IS_sensitivity:
    case FW_STUDY_IS_worst_case:
        if (s->nvary == 0)
            what =
                "needs at least one <vary what=\"...\" from=\"...\" to=\"...\"/>: the range of an "
                "input of the device. The flow's own quantities are no inputs of it: what check "
                "and as=\"made\" say is at the corners of their ranges already; for devices as "
                "they scatter write kind=\"sweep\" as=\"die\" points=\"sobol\" "
                "samples=\"200\" without <vary>";
        break;
    case FW_STUDY_KINDS:
        break;
    }
    if (!what && s->kind != FW_STUDY_IS_size && goals > 0)
        what = "a goal belongs to kind=\"size\"; remove it";
    if (!what && s->kind != FW_STUDY_IS_yield && s->nrespond == 0)
        what = "nothing is asked; add <respond name=\"...\" value=\"governing.utilisation\"/>";
    bool yield = s->kind == FW_STUDY_IS_yield, wanted = s->yield > 0;
    const bool die = s->judge == FW_JUDGE_DIE, chance = yield || wanted || die;
    if (!what && die && s->kind != FW_STUDY_IS_sweep)
        what = "as=\"die\" belongs to kind=\"sweep\"; a yield is of dies in any case";
    if (!what && wanted && s->kind != FW_STUDY_IS_size)
        what = "yield=\"...\" is wanted of a size; remove it, or make kind=\"size\" of it";
    if (!what && wanted && goals > 1)
        what = "a wanted yield and two goals; keep one goal, and make the other a limit";
    if (!what && !chance && s->ntrend > 0)
        what = "<trend> belongs to kind=\"yield\", to a size with yield=\"...\" or to a sweep "
               "as=\"die\"; remove it";
    if (!what && !chance && s->ncorrelation > 0)
        what =
            "<correlation> belongs to kind=\"yield\", to a size with yield=\"...\" or to a sweep "
            "as=\"die\"; remove it";
    if (!what && yield && s->nvary > 0)
        what = "a yield chooses nothing; remove <vary>, or make it <uncertain>";
    for (int i = 0; !what && yield && i < s->nrespond; i++)
        if (isnan(s->respond[i].min) && isnan(s->respond[i].max))
            what = "a <respond> of a yield is a limit that its dies have to hold beside what check "
                   "asks; give it min or max, or remove it";
    if (!what && !chance && s->nuncertain > 0)
        what = "<uncertain> belongs to kind=\"yield\", to a size with yield=\"...\" or to a sweep "
               "as=\"die\"; remove it, or make it <vary>";
    if (!what && s->kind != FW_STUDY_IS_sweep && fw_xml_given(record, "points"))
        what = "points belong to kind=\"sweep\"; remove them";
    if (!what && s->fitted > 0) what = unfit(s);
    if (!what && yield && s->judge != FW_JUDGE_MADE)
        what = "a yield is of devices as they are made; take as=\"made\", or leave as out";
    if (!what && s->kind == FW_STUDY_IS_size && s->judge == FW_JUDGE_HINGES)
        what = "kind=\"size\" returns what check accepts, and hinges alone do not say that; take "
               "as=\"drawn\" or as=\"made\"";
    if (what) wrong(r, record, NULL, what);
}

/* of one record of a <study>; parent >= 0: its children are those that name it */
static fw_status build_study(fw_xml_reader *r, int at, fw_device_study *s) {
    const fw_xml_record *record = &r->record[at];
    const fw_device_study_words *words = &fw_device_study_words_of;
    size_t before = r->diags->errors;
    *s = (fw_device_study){
        .name = fw_xml_text_of(record, "name"),
        .kind = (fw_device_study_kind)word_of(record, "kind", words->kind, 0),
        .points = (fw_device_study_points)word_of(record, "points", words->points, FW_POINTS_GRID),
        .judge = (fw_device_study_judge)word_of(record, "as", words->judge, FW_JUDGE_MADE),
        .samples = fw_xml_whole_or(record, "samples", 0),
        .seed = fw_xml_whole_or(record, "seed", 1),
        .confidence = fw_xml_number_or(record, "confidence", 0.95),
        .confident = fw_xml_given(record, "confidence"),
        .yield = fw_xml_number_or(record, "yield", 0),
        .fitted = fw_xml_number_or(record, "fitted", 0),
        .place = record->element->place};
    size_t varied = (size_t)fw_xml_children(record, "vary"),
           uncertain = (size_t)fw_xml_children(record, "uncertain"),
           trends = (size_t)fw_xml_children(record, "trend"),
           correlations = (size_t)fw_xml_children(record, "correlation"),
           responses = (size_t)fw_xml_children(record, "respond");
    FW_NEED(s->vary = fw_arena_array(r->arena, fw_device_vary, varied));
    FW_NEED(s->uncertain = fw_arena_array(r->arena, fw_device_uncertain, uncertain));
    FW_NEED(s->trend = fw_arena_array(r->arena, fw_device_trend, trends));
    FW_NEED(s->correlation = fw_arena_array(r->arena, fw_device_correlation, correlations));
    FW_NEED(s->respond = fw_arena_array(r->arena, fw_device_respond, responses));
    for (const fw_xml_record *c = record->first_child; c; c = c->next)
        if (fw_xml_is(c, "vary")) FW_TRY(build_vary(r, c, s));
    for (const fw_xml_record *c = record->first_child; c; c = c->next) {
        if (fw_xml_is(c, "uncertain")) FW_TRY(build_uncertain(r, c, s));
        if (fw_xml_is(c, "trend")) FW_TRY(build_trend(r, c, s));
        if (fw_xml_is(c, "correlation")) build_correlation(c, s);
        if (fw_xml_is(c, "respond")) FW_TRY(build_respond(r, c, s));
    }
    check_inputs(r, s);
    /* of a row that was refused nothing can be said: it may be what the kind needs */
    const bool whole = (size_t)s->nvary == varied && (size_t)s->nuncertain == uncertain &&
                       (size_t)s->ntrend == trends && (size_t)s->ncorrelation == correlations &&
                       (size_t)s->nrespond == responses;
    if (whole && r->diags->errors == before && !fw_xml_failed(record, "kind"))
        check_kind(r, record, s);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_device_build_studies(fw_device_reader *r) {
    fw_device *d = r->device;
    size_t n = (size_t)fw_xml_count(&r->xml, "study");
    if (n == 0) return FW_OK;
    FW_NEED(d->study = fw_arena_array(r->arena, fw_device_study, n));
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "study"))
            FW_TRY(build_study(&r->xml, i, &d->study[d->nstudy++]));
    return FW_OK;
}

fw_status fw_device_study_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                               fw_diags *diags, const fw_device_study **study) {
    fw_xml_reader r;
    size_t before = diags->errors;
    *study = NULL;
    FW_TRY(fw_xml_table_read(arena, &fw_device_study_table, file, xml, n, diags, &r));
    fw_device_study *s = fw_arena_one(arena, fw_device_study);
    FW_NEED(s);
    FW_TRY(build_study(&r, 0, s));
    s->device = fw_xml_text_of(&r.record[0], "device");
    if (diags->errors > before) return FW_INPUT;
    *study = s;
    return FW_OK;
}
