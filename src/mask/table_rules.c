/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows <rule> of a layer table, read, and told in a certificate; docs/theory/masks.md lists the kinds and their
   attributes. */
#include "mask/mask_parts.h"
#include "mask/rule.h"
#include <stdio.h>
#include <string.h>

/* ---- what rows of other elements have too ---- */

const char *const fw_mask_yes_no[] = {"yes", "no", NULL};

bool fw_mask_is_plain(const char *text) {
    size_t n = strlen(text);
    for (size_t i = 0; i < n; i++)
        if ((unsigned char)text[i] < 0x20 || (unsigned char)text[i] > 0x7e) return false;
    return n > 0 && n <= 400;
}

bool fw_mask_is_name(const char *s) {
    size_t n = strlen(s);
    if (n == 0 || n > 32) return false;
    return strspn(s, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-") == n;
}

/* digits alone, at most FW_MASK_LARGEST_NUMBER; behind them, or NULL */
static const char *number_at(const char *s, int *value) {
    *value = 0;
    if (*s < '0' || *s > '9') return NULL;
    for (; *s >= '0' && *s <= '9'; s++) {
        *value = 10 * *value + (*s - '0');
        if (*value > FW_MASK_LARGEST_NUMBER) return NULL;
    }
    return s;
}

bool fw_mask_gds_pair(const char *s, int *number, int *datatype) {
    s = number_at(s, number);
    if (!s || *s != '/') return false;
    s = number_at(s + 1, datatype);
    return s && *s == '\0';
}

bool fw_mask_says(const fw_xml_record *record, const char *name, const char *word) {
    const char *text = fw_xml_text_of(record, name);
    return text && strcmp(text, word) == 0;
}

/* ---- rows: which attributes there are depends on the kind ---- */

const fw_xml_numbers fw_mask_rule_numbers = {.element = 135,
                                             .misplaced = 135,
                                             .attribute = 135,
                                             .missing = 135,
                                             .text = 49,
                                             .word = 135,
                                             .form = 141,
                                             .range = 135};

static const fw_quantity_dimension length = {.m = 1};
static const char *const severities[] = {"error", "warning", NULL};
static const char *const sides[] = {"outline", "polygon", NULL};
static const char *const insides[] = {"island", "hole", NULL};

typedef struct limit_unit { /* of min and max, by fw_mask_rule_unit_kind */
    fw_quantity_dimension dimension;
    const char *unit;
    double most;
} limit_unit;
static const limit_unit limits[] = {[FW_UNIT_LENGTH] = {{.m = 1}, "um", 1e-2},
                                    [FW_UNIT_ANGLE] = {{.rad = 1}, "deg", FW_PI},
                                    [FW_UNIT_AREA] = {{.m = 2}, "um^2", 1e-4},
                                    [FW_UNIT_SHARE] = {{0}, "%", 1}};

#define REQUIRED .required = true
#define ABOVE_0(up_to)                                                                             \
    .ranged = true, .open = true, .max = (up_to), .reason = "of something on a mask"
enum { ALWAYS = 0 };

static const struct {
    unsigned taken; /* by kinds that take this; ALWAYS: by all */
    fw_xml_attribute_row row;
} attributes[] = {
    {ALWAYS, {"kind", REQUIRED, .sentence = "What is looked at."}},
    {ALWAYS, {"layer", REQUIRED, .sentence = "id of the layer that is looked at."}},
    {ALWAYS, {"source", FW_MASK_PLAIN, REQUIRED, .sentence = "Where the rule is from."}},
    {ALWAYS,
     {"severity", .kind = FW_KIND_WORD, .words = severities, .fallback = "error",
      .sentence = "warning: the mask is made all the same."}},
    {ALWAYS, {"min", ABOVE_0(0), .sentence = "The least that is allowed."}},
    {FW_TAKES_MAX, {"max", ABOVE_0(0), .sentence = "The most that is allowed."}},
    {FW_TAKES_INSIDE, {"inside", REQUIRED, .sentence = "id of the layer around."}},
    {FW_TAKES_FROM, {"from", REQUIRED, .sentence = "id of the other layer."}},
    {FW_TAKES_OF, {"of", .kind = FW_KIND_WORD, .sentence = "What of it is looked at."}},
    {FW_TAKES_WINDOW,
     {"window", FW_MASK_LENGTH, ABOVE_0(1e-1), REQUIRED, .sentence = "Side of the window."}},
    {FW_TAKES_WINDOW,
     {"step", FW_MASK_LENGTH, ABOVE_0(1e-1), .fallback = "window",
      .sentence = "From window to window."}},
    {FW_TAKES_PRINT,
     {"wavelength", FW_MASK_LENGTH, ABOVE_0(1e-2), REQUIRED, .sentence = "Of the light."}},
    {FW_TAKES_PRINT,
     {"gap", FW_MASK_LENGTH, ABOVE_0(1e-2), REQUIRED, .sentence = "Between mask and resist."}},
    {FW_TAKES_PRINT,
     {"resist", FW_MASK_LENGTH, ABOVE_0(1e-2), REQUIRED, .sentence = "Its thickness."}},
};
enum { NATTRIBUTE = sizeof attributes / sizeof attributes[0] };

static const fw_mask_rule_kind_row *kind_named(fw_xml_reader *r, const fw_xml_element *e) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, "kind");
    if (!a) {
        fw_diag_error(r->diags, 135, e->place,
                      "<rule> needs kind=\"...\", which says what is looked at");
        return NULL;
    }
    const fw_mask_rule_kind_row *row;
    size_t rows = 0, n = 0;
    for (; (row = fw_mask_rule_kind_at(rows)); rows++)
        if (!row->built_in && strcmp(row->name, a->value) == 0) return row;
    const char **names = fw_arena_array(r->arena, const char *, rows);
    for (size_t i = 0; names && i < rows; i++) {
        row = fw_mask_rule_kind_at(i);
        if (!row->built_in) names[n++] = row->name;
    }
    fw_text known = fw_text_new(r->arena);
    for (size_t i = 0; i < n; i++)
        fw_text_printf(&known, "%s%s", i ? ", " : "", names[i]);
    const char *meant = fw_did_you_mean(a->value, names, n);
    fw_diag_error(r->diags, 135, a->place, "<rule> kind=\"%.64s\" is not one of: %s%s%s%s",
                  a->value, fw_text_end(&known) == FW_OK ? known.data : "", FW_DID_YOU_MEAN(meant));
    return NULL;
}

/* min and max are in the kind's own unit; where there are names for a formula, min is read when
   they have values */
static fw_xml_attribute_row attribute_of(const fw_mask_rule_kind_row *kind,
                                         fw_xml_attribute_row row) {
    bool min = strcmp(row.name, "min") == 0, max = strcmp(row.name, "max") == 0;
    if (min || max) {
        const limit_unit *unit = &limits[kind->unit];
        row.kind = min && kind->takes & FW_TAKES_PRINT ? FW_KIND_TEXT : FW_KIND_NUMBER;
        row.dimension = unit->dimension;
        row.unit = unit->unit;
        row.max = unit->most;
    }
    if (strcmp(row.name, "of") == 0) row.words = kind->of & FW_OF_OUTLINE ? sides : insides;
    return row;
}

fw_status fw_mask_rule_row(fw_xml_reader *r, const fw_xml_element *e,
                           const fw_xml_element_row **row) {
    const fw_mask_rule_kind_row *kind = kind_named(r, e);
    fw_xml_element_row *made = fw_arena_one(r->arena, fw_xml_element_row);
    fw_xml_attribute_row *list = fw_arena_array(r->arena, fw_xml_attribute_row, NATTRIBUTE);
    FW_NEED(made && list ? made : NULL);
    const fw_xml_element_row *any = *row;
    *row = NULL;
    if (!kind) return FW_OK;
    *made = *any;
    made->attribute = list;
    for (int k = 0; k < NATTRIBUTE; k++)
        if (attributes[k].taken == ALWAYS || kind->takes & attributes[k].taken)
            list[made->nattribute++] = attribute_of(kind, attributes[k].row);
    FW_NEED(made->name = fw_arena_printf(r->arena, "rule kind=\"%s\"", kind->name));
    *row = made;
    return FW_OK;
}

/* ---- what was read ---- */

typedef struct reader {
    fw_xml_reader *r;
    const fw_mask_table *table;
    fw_mask_rule *rule;
} reader;

static bool is_drawn(const fw_mask_layer *layer) {
    return layer->id && !layer->documentation;
}

/* index of the layer with that id; -1: there is none, which is told */
static int layer_named(reader *r, const fw_xml_attribute *a) {
    const fw_mask_table *t = r->table;
    size_t n = 0;
    for (int k = 0; k < t->nlayer; k++)
        if (is_drawn(&t->layer[k]) && strcmp(t->layer[k].id, a->value) == 0) return k;
    const char **names = fw_arena_array(r->r->arena, const char *, (size_t)t->nlayer);
    for (int k = 0; names && k < t->nlayer; k++)
        if (is_drawn(&t->layer[k])) names[n++] = t->layer[k].id;
    const char *meant = names ? fw_did_you_mean(a->value, names, n) : NULL;
    fw_diag_error(r->r->diags, 135, a->place,
                  "%s=\"%s\" is not the id of a layer that is drawn%s%s%s", a->name, a->value,
                  meant ? "; did you mean \"" : "", meant ? meant : "", meant ? "\"?" : "");
    return -1;
}

static void read_layers(reader *r, const fw_xml_record *e) {
    fw_mask_rule *rule = r->rule;
    const fw_xml_attribute *a = fw_xml_cell_of(e, "layer")->given,
                           *other = fw_xml_cell_of(e, "inside")->given;
    if (!other) other = fw_xml_cell_of(e, "from")->given;
    if (a) rule->layer = layer_named(r, a);
    if (other) rule->other = layer_named(r, other);
    if (a && other && rule->layer >= 0 && rule->layer == rule->other)
        fw_diag_error(r->r->diags, 135, other->place,
                      "%s=\"%s\" is the rule's own layer; name another one", other->name,
                      other->value);
}

static double value_of(const fw_xml_record *e, const char *name, double absent) {
    const fw_xml_cell *cell = fw_xml_cell_of(e, name);
    return cell->ok ? cell->number : absent;
}

/* min as a formula of wavelength, gap and resist */
static fw_status read_formula(reader *r, const fw_xml_record *e) {
    static const char *const print[] = {"wavelength", "gap", "resist"};
    enum { NPRINT = sizeof print / sizeof print[0] };
    const fw_xml_attribute *a = fw_xml_cell_of(e, "min")->given;
    fw_quantity_name_value name[NPRINT];
    for (int i = 0; i < NPRINT; i++)
        name[i] = (fw_quantity_name_value){print[i], value_of(e, print[i], 0.0), length};
    const limit_unit *unit = &limits[r->rule->kind->unit];
    fw_quantity_dimension found;
    double value;
    bool ok;
    if (!a) return FW_OK;
    r->r->names = (fw_quantity_names){name, NPRINT};
    fw_status status =
        fw_xml_attribute_evaluate(r->r, a, "min", &unit->dimension, &found, &value, &ok);
    r->r->names = (fw_quantity_names){0};
    FW_TRY(status);
    if (!fw_mask_is_plain(a->value))
        fw_diag_error(r->r->diags, 141, a->place, "min must be plain ASCII of 1 to 400 characters");
    else
        r->rule->formula = a->value;
    char number[FW_LABEL], most[FW_LABEL];
    if (ok && !(value > 0 && value <= unit->most))
        fw_diag_error(r->r->diags, 135, a->place, "min is %s; it must be above 0 and at most %s",
                      fw_xml_in_unit(number, value, unit->unit),
                      fw_xml_in_unit(most, unit->most, unit->unit));
    else if (ok)
        r->rule->least = value;
    return FW_OK;
}

static fw_status read_limits(reader *r, const fw_xml_record *e) {
    const fw_mask_rule_kind_row *kind = r->rule->kind;
    fw_mask_rule *rule = r->rule;
    if (!fw_xml_given(e, "min") && !fw_xml_given(e, "max"))
        fw_diag_error(r->r->diags, 135, e->element->place,
                      "<%s> lacks its limit; add min=\"...\"%s", e->row->name,
                      kind->takes & FW_TAKES_MAX ? " or max=\"...\"" : "");
    if (kind->takes & FW_TAKES_PRINT)
        FW_TRY(read_formula(r, e));
    else
        rule->least = value_of(e, "min", 0.0);
    rule->most = value_of(e, "max", HUGE_VAL);
    if (rule->least > rule->most)
        fw_diag_error(r->r->diags, 135, fw_xml_place_of(e, "max"), "max=\"%s\" is below min=\"%s\"",
                      fw_xml_text_of(e, "max"), fw_xml_text_of(e, "min"));
    rule->window_m = value_of(e, "window", 0.0);
    rule->step_m = value_of(e, "step", rule->window_m);
    return FW_OK;
}

static unsigned of_word(const fw_xml_record *e, unsigned usual) {
    static const struct {
        const char *word;
        unsigned of;
    } word[] = {{"outline", FW_OF_OUTLINE},
                {"polygon", FW_OF_POLYGON},
                {"island", FW_OF_ISLAND},
                {"hole", FW_OF_HOLE}};
    for (size_t i = 0; i < sizeof word / sizeof word[0]; i++)
        if (fw_mask_says(e, "of", word[i].word)) return word[i].of;
    return usual;
}

static fw_status read_rule(reader *r, const fw_xml_record *e) {
    const fw_mask_rule_kind_row *kind = kind_named(r->r, e->element);
    *r->rule =
        (fw_mask_rule){.kind = kind,
                       .layer = -1,
                       .other = -1,
                       .most = HUGE_VAL,
                       .of = of_word(e, kind->usual_of),
                       .severity = fw_mask_says(e, "severity", "warning") ? FW_WARNING : FW_ERROR,
                       .source = fw_xml_text_of(e, "source"),
                       .place = e->element->place};
    read_layers(r, e);
    return read_limits(r, e);
}

static bool twice(const fw_mask_rule *p, const fw_mask_rule *q) {
    return p->kind == q->kind && p->layer == q->layer && p->other == q->other && p->of == q->of &&
           p->severity == q->severity && p->window_m == q->window_m;
}

static void check_twice(fw_diags *diags, const fw_mask_table *t) {
    for (int j = 0; j < t->nrule; j++) {
        const fw_mask_rule *q = &t->rule[j];
        if (!q->kind || q->layer < 0) continue;
        const fw_mask_layer *l = &t->layer[q->layer];
        bool own = (q->kind == &fw_mask_kind_width && l->min_width_m > 0) ||
                   (q->kind == &fw_mask_kind_space && l->min_space_m > 0);
        if (own && q->severity == FW_ERROR)
            fw_diag_error(diags, 135, q->place,
                          "layer \"%s\" has min-%s in line %d already; keep one of the two", l->id,
                          q->kind->name, l->place.line);
        for (int i = 0; i < j; i++)
            if (t->rule[i].kind && twice(&t->rule[i], q))
                fw_diag_error(
                    diags, 135, q->place,
                    "the rule \"%s\" of layer \"%s\" stands twice, first in line %d; keep "
                    "one",
                    q->kind->name, l->id, t->rule[i].place.line);
    }
}

/* a layer's rules of width and space stand in the layer too, where other rooms look for them */
static void tell_layers(fw_mask_table *t) {
    for (int i = 0; i < t->nrule; i++) {
        const fw_mask_rule *r = &t->rule[i];
        if (!r->kind || r->layer < 0 || r->severity != FW_ERROR) continue;
        fw_mask_layer *l = &t->layer[r->layer];
        double *least = r->kind == &fw_mask_kind_width   ? &l->min_width_m
                        : r->kind == &fw_mask_kind_space ? &l->min_space_m
                                                         : NULL;
        if (!least) continue;
        *least = r->least;
        if (!l->rule_source) l->rule_source = r->source;
    }
}

fw_status fw_mask_rules_build(fw_xml_reader *r, fw_mask_table *table) {
    const fw_xml_record *root = r->record;
    reader work = {.r = r, .table = table};
    FW_NEED(table->rule =
                fw_arena_array(r->arena, fw_mask_rule, (size_t)fw_xml_children(root, "rule")));
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "rule")) continue;
        work.rule = &table->rule[table->nrule++];
        FW_TRY(read_rule(&work, e));
    }
    check_twice(r->diags, table);
    tell_layers(table);
    return FW_OK;
}

/* ---- the rules that a mask is judged by, in its certificate: for programs that check the same polygons themselves, as the
   scripts of klayout/ do. Limits are numbers here, whatever expression the table has. ---- */

static const char *of_text(unsigned of) {
    static const struct {
        unsigned of;
        const char *word;
    } words[] = {{FW_OF_OUTLINE, "outline"},
                 {FW_OF_POLYGON, "polygon"},
                 {FW_OF_ISLAND, "island"},
                 {FW_OF_HOLE, "hole"}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (of == words[i].of) return words[i].word;
    return NULL; /* both, or the kind knows no difference */
}

static void gds_of(fw_json *json, const char *key, const fw_mask_table *table, int layer) {
    char text[32];
    if (layer < 0) {
        fw_json_null(json, key);
        return;
    }
    snprintf(text, sizeof text, "%d/%d", table->layer[layer].layer, table->layer[layer].datatype);
    fw_json_text(json, key, text);
}

static void bound(fw_json *json, const char *key, const fw_mask_rule *rule, double value) {
    if (value > 0 && value < HUGE_VAL)
        fw_json_number(json, key, fw_mask_rule_row_shown(rule->kind, value), 12);
    else
        fw_json_null(json, key);
}

static void length_um(fw_json *json, const char *key, double length_m) {
    if (length_m > 0)
        fw_json_number(json, key, length_m * 1e6, 12);
    else
        fw_json_null(json, key);
}

fw_status fw_mask_rules_json(fw_json *json, const fw_mask_table *table) {
    static const char *const unit[] = {"um", "deg", "um2", "1"};
    fw_mask_rules rules = {.arena = json->out->arena, .table = table};
    FW_TRY(fw_mask_rules_list(&rules));
    fw_json_line(json, 2);
    fw_json_list(json, "rules");
    for (int i = 0; i < rules.nrule; i++) {
        const fw_mask_rule *rule = &rules.rule[i];
        if (table->layer[rule->layer].documentation) continue;
        fw_json_line(json, 4);
        fw_json_object(json, NULL);
        fw_json_text(json, "kind", rule->kind->name);
        gds_of(json, "layer", table, rule->layer);
        gds_of(json, "other", table, rule->other);
        fw_json_text(json, "of", of_text(rule->of));
        bound(json, "min", rule, rule->least);
        bound(json, "max", rule, rule->most);
        fw_json_text(json, "unit", unit[rule->kind->unit]);
        length_um(json, "window_um", rule->window_m);
        length_um(json, "step_um", rule->step_m);
        fw_json_text(json, "severity", rule->severity == FW_ERROR ? "error" : "warning");
        fw_json_whole(json, "code", rule->kind->number);
        fw_json_text(json, "formula", rule->formula);
        fw_json_text(json, "source", rule->source);
        fw_json_end(json);
    }
    fw_json_end_line(json, 2);
    return FW_OK;
}
