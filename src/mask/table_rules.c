/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows <rule> of a layer table; docs/theory/masks.md lists the kinds and their attributes. */
#include "mask/rule.h"
#include "mask/table.h"
#include "quantity/expression.h"
#include <string.h>

enum { ALWAYS = 0, NPRINT = 3 };
static const fw_dimension length = {.m = 1}, area = {.m = 2}, angle = {.rad = 1}, share = {0};

typedef struct attribute_row { /* an attribute and the kinds that take it */
    const char *name;
    unsigned bit;
    bool needed;
} attribute_row;
static const attribute_row attributes[] = {
    {"kind", ALWAYS, true},
    {"layer", ALWAYS, true},
    {"source", ALWAYS, true},
    {"severity", ALWAYS, false},
    {"min", ALWAYS, false},
    {"max", FW_TAKES_MAX, false},
    {"inside", FW_TAKES_INSIDE, true},
    {"from", FW_TAKES_FROM, true},
    {"of", FW_TAKES_OF, false},
    {"window", FW_TAKES_WINDOW, true},
    {"step", FW_TAKES_WINDOW, false},
    {"wavelength", FW_TAKES_PRINT, true},
    {"gap", FW_TAKES_PRINT, true},
    {"resist", FW_TAKES_PRINT, true},
};
enum { NATTRIBUTE = sizeof attributes / sizeof attributes[0] };

typedef struct reader {
    fw_arena *arena;
    fw_diags *diags;
    const fw_mask_table *table;
    fw_mask_rule *rule;
    fw_name_value name[NPRINT]; /* for the formula of min */
    size_t nname;
} reader;

static const fw_rule_row *kind_named(reader *r, const fw_element *e) {
    const fw_attribute *a = fw_xml_attribute(e, "kind");
    const char *names[32];
    size_t n = 0;
    if (!a) {
        fw_diag_error(r->diags, 135, e->place, "<rule> lacks the attribute \"kind\"");
        return NULL;
    }
    const fw_rule_row *row;
    for (size_t i = 0; (row = fw_rule_kind_at(i)); i++) {
        if (row->built_in) continue;
        if (strcmp(row->name, a->value) == 0) return row;
        names[n++] = row->name;
    }
    const char *meant = fw_did_you_mean(a->value, names, n);
    fw_diag_error(
        r->diags, 135, a->place,
        "a rule of kind \"%s\" is unknown%s%s%s; kinds are width space notch feature angle "
        "edge area density enclosure separation",
        a->value, meant ? "; did you mean \"" : "", meant ? meant : "", meant ? "\"?" : "");
    return NULL;
}

static void check_attributes(reader *r, const fw_element *e, const fw_rule_row *kind) {
    for (int i = 0; i < e->nattribute; i++) {
        const fw_attribute *a = &e->attribute[i];
        int k = 0;
        while (k < NATTRIBUTE && strcmp(attributes[k].name, a->name) != 0)
            k++;
        if (k == NATTRIBUTE || (attributes[k].bit != ALWAYS && !(kind->takes & attributes[k].bit)))
            fw_diag_error(r->diags, 135, a->name_place,
                          "a rule of kind \"%s\" has no attribute \"%s\"", kind->name, a->name);
    }
    for (int k = 0; k < NATTRIBUTE; k++)
        if (attributes[k].needed &&
            (attributes[k].bit == ALWAYS || kind->takes & attributes[k].bit) &&
            !fw_xml_attribute(e, attributes[k].name))
            fw_diag_error(r->diags, 135, e->place,
                          "a rule of kind \"%s\" lacks the attribute \"%s\"", kind->name,
                          attributes[k].name);
    if (!fw_xml_attribute(e, "min") && !(kind->takes & FW_TAKES_MAX && fw_xml_attribute(e, "max")))
        fw_diag_error(
            r->diags, 135, e->place, "a rule of kind \"%s\" lacks its limit%s", kind->name,
            kind->takes & FW_TAKES_MAX ? "; add min=\"...\" or max=\"...\"" : "; add min=\"...\"");
}

/* index of the layer with that id; -1: there is none, which is told */
static int layer_named(reader *r, const fw_attribute *a) {
    const fw_mask_table *t = r->table;
    const char **names = fw_arena_array(r->arena, const char *, (size_t)t->nlayer);
    size_t n = 0;
    for (int k = 0; names && k < t->nlayer; k++) {
        if (!t->layer[k].id || t->layer[k].documentation) continue;
        if (strcmp(t->layer[k].id, a->value) == 0) return k;
        names[n++] = t->layer[k].id;
    }
    const char *meant = names ? fw_did_you_mean(a->value, names, n) : NULL;
    fw_diag_error(r->diags, 135, a->place, "%s=\"%s\" is not the id of a layer that is drawn%s%s%s",
                  a->name, a->value, meant ? "; did you mean \"" : "", meant ? meant : "",
                  meant ? "\"?" : "");
    return -1;
}

static fw_status read_value(reader *r, const fw_element *e, const char *name, fw_dimension wanted,
                            double most, double *out) {
    const fw_attribute *a = fw_xml_attribute(e, name);
    if (!a) return FW_OK;
    fw_expression_error error = {0};
    fw_names names = {r->name, r->nname};
    double value = 0;
    fw_status status = fw_expression_evaluate(r->arena, a->value, strlen(a->value), &names, wanted,
                                              &value, &error);
    if (status == FW_NOMEM) return status;
    if (status != FW_OK) {
        fw_diag_error(r->diags, error.number, fw_xml_inside(a, error.offset), "%s", error.message);
        return FW_OK;
    }
    if (!(value > 0 && value <= most)) {
        char number[32], limit[32];
        fw_diag_error(r->diags, 135, a->place,
                      "%s=\"%s\" is %s in SI units, not above 0 and at most %s", name, a->value,
                      fw_number_text(number, sizeof number, value, 6),
                      fw_number_text(limit, sizeof limit, most, 6));
        return FW_OK;
    }
    *out = value;
    return FW_OK;
}

static fw_status read_printing(reader *r, const fw_element *e) {
    static const char *const print[NPRINT] = {"wavelength", "gap", "resist"};
    for (int i = 0; i < NPRINT; i++) {
        double value = 0;
        FW_TRY(read_value(r, e, print[i], length, 1e-2, &value));
        r->name[i] = (fw_name_value){print[i], value, length};
    }
    r->nname = NPRINT;
    return FW_OK;
}

static fw_status read_limits(reader *r, const fw_element *e, const fw_rule_row *kind) {
    static const fw_dimension *const dimension[] = {&length, &angle, &area, &share};
    static const double most[] = {1e-2, FW_PI, 1e-4, 1};
    fw_mask_rule *rule = r->rule;
    if (kind->takes & FW_TAKES_PRINT) FW_TRY(read_printing(r, e));
    FW_TRY(read_value(r, e, "min", *dimension[kind->unit], most[kind->unit], &rule->least));
    r->nname = 0;
    if (kind->takes & FW_TAKES_MAX)
        FW_TRY(read_value(r, e, "max", *dimension[kind->unit], most[kind->unit], &rule->most));
    if (rule->least > rule->most)
        fw_diag_error(r->diags, 135, fw_xml_attribute(e, "max")->place,
                      "max=\"%s\" is below min=\"%s\"", fw_xml_attribute(e, "max")->value,
                      fw_xml_attribute(e, "min")->value);
    if (!(kind->takes & FW_TAKES_WINDOW)) return FW_OK;
    FW_TRY(read_value(r, e, "window", length, 1e-1, &rule->window_m));
    rule->step_m = rule->window_m;
    return read_value(r, e, "step", length, 1e-1, &rule->step_m);
}

static void read_of(reader *r, const fw_element *e, const fw_rule_row *kind) {
    static const struct {
        const char *word;
        unsigned of;
    } word[] = {{"outline", FW_OF_OUTLINE},
                {"polygon", FW_OF_POLYGON},
                {"island", FW_OF_ISLAND},
                {"hole", FW_OF_HOLE}};
    const fw_attribute *a = fw_xml_attribute(e, "of");
    r->rule->of = kind->usual_of;
    if (!a || !(kind->takes & FW_TAKES_OF)) return;
    for (size_t i = 0; i < sizeof word / sizeof word[0]; i++)
        if (strcmp(a->value, word[i].word) == 0 && kind->of & word[i].of) {
            r->rule->of = word[i].of;
            return;
        }
    fw_diag_error(r->diags, 135, a->place, "of=\"%s\" of a rule of kind \"%s\" must be %s",
                  a->value, kind->name,
                  kind->of & FW_OF_OUTLINE ? "\"outline\" or \"polygon\""
                                           : "\"island\" or \"hole\", or left out for both");
}

static void read_severity(reader *r, const fw_element *e) {
    const fw_attribute *a = fw_xml_attribute(e, "severity");
    r->rule->severity = FW_ERROR;
    if (a && strcmp(a->value, "warning") == 0)
        r->rule->severity = FW_WARNING;
    else if (a && strcmp(a->value, "error") != 0)
        fw_diag_error(r->diags, 135, a->place, "severity=\"%s\" must be \"error\" or \"warning\"",
                      a->value);
}

static void read_layers(reader *r, const fw_element *e) {
    fw_mask_rule *rule = r->rule;
    const fw_attribute *a = fw_xml_attribute(e, "layer"), *other = fw_xml_attribute(e, "inside");
    if (!other) other = fw_xml_attribute(e, "from");
    if (a) rule->layer = layer_named(r, a);
    if (other) rule->other = layer_named(r, other);
    if (a && other && rule->layer >= 0 && rule->layer == rule->other)
        fw_diag_error(r->diags, 135, other->place, "%s=\"%s\" is the rule's own layer", other->name,
                      other->value);
}

static fw_status read_rule(reader *r, const fw_element *e) {
    const fw_rule_row *kind = kind_named(r, e);
    if (!kind) return FW_OK;
    *r->rule =
        (fw_mask_rule){.kind = kind, .layer = -1, .other = -1, .most = HUGE_VAL, .place = e->place};
    check_attributes(r, e, kind);
    read_layers(r, e);
    FW_TRY(read_limits(r, e, kind));
    read_of(r, e, kind);
    read_severity(r, e);
    const fw_attribute *min = fw_xml_attribute(e, "min"), *source = fw_xml_attribute(e, "source");
    if (min && kind->takes & FW_TAKES_PRINT) fw_table_text(r->diags, min, &r->rule->formula);
    if (source) fw_table_text(r->diags, source, &r->rule->source);
    if (e->first_child)
        fw_diag_error(r->diags, 135, e->first_child->place, "<rule> has no child elements");
    return FW_OK;
}

static bool twice(const fw_mask_rule *p, const fw_mask_rule *q) {
    return p->kind == q->kind && p->layer == q->layer && p->other == q->other && p->of == q->of &&
           p->severity == q->severity && p->window_m == q->window_m;
}

static void check_twice(reader *r, const fw_mask_table *t) {
    for (int j = 0; j < t->nrule; j++) {
        const fw_mask_rule *q = &t->rule[j];
        if (!q->kind || q->layer < 0) continue;
        const fw_mask_layer *l = &t->layer[q->layer];
        bool own = (q->kind == &fw_kind_width && l->min_width_m > 0) ||
                   (q->kind == &fw_kind_space && l->min_space_m > 0);
        if (own && q->severity == FW_ERROR)
            fw_diag_error(r->diags, 135, q->place,
                          "layer \"%s\" has min-%s in line %d already; keep one of the two", l->id,
                          q->kind->name, l->place.line);
        for (int i = 0; i < j; i++)
            if (t->rule[i].kind && twice(&t->rule[i], q))
                fw_diag_error(
                    r->diags, 135, q->place,
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
        double *least = r->kind == &fw_kind_width   ? &l->min_width_m
                        : r->kind == &fw_kind_space ? &l->min_space_m
                                                    : NULL;
        if (!least) continue;
        *least = r->least;
        if (!l->rule_source) l->rule_source = r->source;
    }
}

fw_status fw_table_rules(fw_arena *arena, const fw_element *root, fw_diags *diags,
                         fw_mask_table *table) {
    reader r = {.arena = arena, .diags = diags, .table = table};
    size_t n = 0;
    for (const fw_element *e = root->first_child; e; e = e->next)
        n += strcmp(e->name, "rule") == 0;
    FW_NEED(table->rule = fw_arena_array(arena, fw_mask_rule, n));
    for (const fw_element *e = root->first_child; e; e = e->next) {
        if (strcmp(e->name, "rule") != 0) continue;
        r.rule = &table->rule[table->nrule++];
        FW_TRY(read_rule(&r, e));
    }
    check_twice(&r, table);
    tell_layers(table);
    return FW_OK;
}
