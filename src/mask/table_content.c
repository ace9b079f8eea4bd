/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <pattern kind="undercut-ladder" id="ladder" title="UNDERCUT" from="4 um" .../>: which test
   patterns a flow has, as data. Which attributes a kind takes is in its own row (layout/pattern.h).
 */
#include "mask/content.h"
#include "quantity/expression.h"
#include <math.h>
#include <string.h>

typedef struct reader {
    fw_arena *arena;
    fw_diags *diags;
    const fw_element *element;
    fw_pattern *row;
} reader;

/* n bytes of an attribute's value as a length or a plain number; false: said what is wrong */
static fw_status evaluate(reader *r, const fw_attribute *a, const char *s, size_t n, bool number,
                          double *out, bool *good) {
    fw_expression_error error = {0};
    fw_names none = {0};
    fw_dimension wanted = {.m = number ? 0 : 1};
    fw_status status = fw_expression_evaluate(r->arena, s, n, &none, wanted, out, &error);
    *good = status == FW_OK;
    if (status == FW_NOMEM || status == FW_OK) return status;
    fw_diag_error(r->diags, 185, a->place, "%s: %s", a->name, error.message);
    return FW_OK;
}

static void range(reader *r, const fw_attribute *a, double value, double least, double most,
                  bool number) {
    if (value >= least && value <= most) return;
    double unit = number ? 1 : 1e6;
    char v[32], low[32], high[32];
    fw_diag_error(r->diags, 185, a->place, "%s is %s%s, but must be between %s and %s%s", a->name,
                  fw_number_text(v, sizeof v, value * unit, 6), number ? "" : " um",
                  fw_number_text(low, sizeof low, least * unit, 6),
                  fw_number_text(high, sizeof high, most * unit, 6), number ? "" : " um");
}

static bool on_grid(double x_m) {
    return fabs(x_m * 1e9 - nearbyint(x_m * 1e9)) < 1e-3;
}

/* "4 um, 6 um, 10 um" */
static fw_status read_sizes(reader *r, const fw_attribute *a) {
    fw_pattern *p = r->row;
    for (const char *s = a->value; s;) {
        size_t n = strcspn(s, ",");
        if (p->nsize == FW_PATTERN_SIZES)
            return fw_diag_error(r->diags, 185, a->place, "sizes holds more than %d lengths",
                                 FW_PATTERN_SIZES);
        bool good;
        double *value = &p->size_m[p->nsize];
        FW_TRY(evaluate(r, a, s, n, false, value, &good));
        if (!good) return FW_OK;
        range(r, a, *value, 1e-6, 5e-3, false);
        if (!on_grid(*value))
            fw_diag_error(r->diags, 185, a->place, "sizes must be multiples of 1 nm");
        p->nsize++;
        s = s[n] ? s + n + 1 : NULL;
    }
    return FW_OK;
}

static const fw_pattern_parameter *parameter_named(const fw_pattern_kind *kind, const char *name,
                                                   int *index) {
    for (int i = 0; i < kind->nparameter; i++)
        if (strcmp(kind->parameter[i].name, name) == 0) {
            *index = i;
            return &kind->parameter[i];
        }
    return NULL;
}

static fw_status read_parameter(reader *r, const fw_attribute *a) {
    int i;
    const fw_pattern_parameter *p = parameter_named(r->row->kind, a->name, &i);
    if (!p)
        return fw_diag_error(r->diags, 185, a->place, "a pattern of kind \"%s\" has no \"%s\"",
                             r->row->kind->name, a->name);
    bool good;
    FW_TRY(evaluate(r, a, a->value, strlen(a->value), p->number, &r->row->value[i], &good));
    if (!good) return FW_OK;
    range(r, a, r->row->value[i], p->least, p->most, p->number);
    if (!p->number && !on_grid(r->row->value[i]))
        fw_diag_error(r->diags, 185, a->place, "%s must be a multiple of 1 nm", a->name);
    return FW_OK;
}

/* plain ASCII of 1 to `most` characters: it may go into GDSII and into lettering */
static void read_words(reader *r, const fw_attribute *a, size_t most, const char **out) {
    size_t n = strlen(a->value);
    bool plain = n > 0 && n <= most;
    for (size_t i = 0; i < n; i++)
        if ((unsigned char)a->value[i] < 0x20 || (unsigned char)a->value[i] > 0x7e) plain = false;
    if (plain)
        *out = a->value;
    else
        fw_diag_error(r->diags, 185, a->place, "%s must be plain ASCII of 1 to %zu characters",
                      a->name, most);
}

static fw_status read_attribute(reader *r, const fw_attribute *a) {
    const char *n = a->name;
    fw_pattern *p = r->row;
    if (strcmp(n, "kind") == 0) return FW_OK;
    if (strcmp(n, "id") == 0)
        read_words(r, a, 32, &p->id);
    else if (strcmp(n, "title") == 0)
        read_words(r, a, 24, &p->title);
    else if (strcmp(n, "gives") == 0)
        read_words(r, a, 100, &p->gives);
    else if (strcmp(n, "measure") == 0)
        read_words(r, a, 400, &p->measure);
    else if (strcmp(n, "source") == 0)
        read_words(r, a, 400, &p->source);
    else if (strcmp(n, "bias") == 0) {
        p->biased = strcmp(a->value, "yes") == 0;
        if (!p->biased && strcmp(a->value, "no") != 0)
            fw_diag_error(r->diags, 185, a->place, "bias must be \"yes\" or \"no\"");
    } else if (strcmp(n, "sizes") == 0 && p->kind->sizes)
        return read_sizes(r, a);
    else
        return read_parameter(r, a);
    return FW_OK;
}

static fw_status unknown_kind(reader *r, const fw_attribute *kind) {
    fw_text known = fw_text_new(r->arena);
    const fw_pattern_kind *k;
    for (size_t i = 0; (k = fw_pattern_kind_at(i)); i++)
        fw_text_printf(&known, "%s%s", i ? " " : "", k->name);
    FW_TRY(fw_text_end(&known));
    fw_place at = kind ? kind->place : r->element->place;
    fw_diag_error(r->diags, 185, at, "<pattern> needs a kind; there are: %s", known.data);
    return FW_OK;
}

static fw_status read_pattern(reader *r) {
    const fw_element *e = r->element;
    const fw_attribute *kind = fw_xml_attribute(e, "kind");
    fw_pattern *p = r->row;
    *p = (fw_pattern){.place = e->place};
    p->kind = kind ? fw_pattern_kind_named(kind->value) : NULL;
    if (!p->kind) return unknown_kind(r, kind);
    p->id = p->title = p->kind->name;
    for (int i = 0; i < p->kind->nparameter; i++)
        p->value[i] = p->kind->parameter[i].usual;
    for (int i = 0; i < e->nattribute; i++) {
        fw_status status = read_attribute(r, &e->attribute[i]);
        if (status != FW_OK && status != FW_INPUT) return status;
    }
    if (p->kind->sizes && p->nsize == 0)
        fw_diag_error(r->diags, 185, e->place, "a pattern of kind \"%s\" needs sizes (%s)",
                      p->kind->name, p->kind->sizes);
    return FW_OK;
}

fw_status fw_mask_table_content(fw_arena *arena, const fw_element *root, fw_diags *diags,
                                fw_mask_table *table) {
    size_t n = 0;
    for (const fw_element *e = root->first_child; e; e = e->next)
        n += strcmp(e->name, "pattern") == 0;
    fw_pattern *row = fw_arena_array(arena, fw_pattern, n);
    FW_NEED(row);
    table->pattern = row;
    for (const fw_element *e = root->first_child; e; e = e->next) {
        if (strcmp(e->name, "pattern") != 0) continue;
        reader r = {arena, diags, e, &row[table->npattern]};
        FW_TRY(read_pattern(&r));
        if (!r.row->kind) continue;
        for (int i = 0; i < table->npattern; i++)
            if (strcmp(row[i].id, r.row->id) == 0)
                fw_diag_error(diags, 185, e->place,
                              "two test patterns have the id \"%s\"; measured values name it",
                              r.row->id);
        table->npattern++;
    }
    return FW_OK;
}
