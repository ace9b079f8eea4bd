/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <pattern kind="undercut-ladder" id="ladder" title="UNDERCUT" from="4 um" .../>: which test
   patterns a flow has, as data. Which attributes a kind takes is in its own row (layout/pattern.h).
 */
#include "mask/mask_table.h"
#include <math.h>
#include <string.h>

const fw_xml_numbers fw_mask_pattern_numbers = {.element = 185,
                                                .misplaced = 185,
                                                .attribute = 185,
                                                .at_value = true,
                                                .missing = 185,
                                                .text = 49,
                                                .word = 185,
                                                .form = 185,
                                                .range = 185,
                                                .expression = 185};

/* ---- rows: those that every kind has, and those of its parameters ---- */

static bool is_title(const char *text) { /* as long as lettering can be */
    return fw_mask_is_plain(text) && strlen(text) <= 24;
}

static bool is_id(const char *text) {
    return fw_mask_is_plain(text) && strlen(text) <= 32;
}

static bool is_name_of_quantity(const char *text) {
    return fw_mask_is_plain(text) && strlen(text) <= 100;
}

static const fw_xml_attribute_row common[] = {
    {"kind", .required = true, .sentence = "What is drawn."},
    {"id", .kind = FW_KIND_FORM, .form = is_id, .reason = "plain ASCII of 1 to 32 characters",
     .fallback = "kind", .sentence = "Measured values name it."},
    {"title", .kind = FW_KIND_FORM, .form = is_title, .reason = "plain ASCII of 1 to 24 characters",
     .fallback = "kind", .sentence = "Lettering beside it."},
    {"gives", .kind = FW_KIND_FORM, .form = is_name_of_quantity,
     .reason = "plain ASCII of 1 to 100 characters",
     .sentence = "Quantity of the process that is found with it."},
    {"measure", FW_MASK_PLAIN, .sentence = "What to do with it."},
    {"source", FW_MASK_PLAIN, .sentence = "Where it is from."},
    {"bias", FW_MASK_YES_NO, .sentence = "Is the bias of the process added to its edges?"},
};
enum { COMMON = sizeof common / sizeof common[0] };

static fw_xml_attribute_row parameter_row(const fw_layout_pattern_parameter *p) {
    return (fw_xml_attribute_row){p->name,
                                  .kind = FW_KIND_NUMBER,
                                  .dimension = {.m = p->number ? 0 : 1},
                                  .unit = p->number ? "1" : "um",
                                  .ranged = true,
                                  .min = p->least,
                                  .max = p->most,
                                  .reason = "what the pattern is drawn for",
                                  .required = isnan(p->usual),
                                  .sentence = "Of the pattern."};
}

static const fw_layout_pattern_kind *kind_named(fw_xml_reader *r, const fw_xml_element *e) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, "kind");
    const fw_layout_pattern_kind *kind = a ? fw_layout_pattern_kind_named(a->value) : NULL;
    if (kind) return kind;
    fw_text known = fw_text_new(r->arena);
    for (size_t i = 0; (kind = fw_layout_pattern_kind_at(i)); i++)
        fw_text_printf(&known, "%s%s", i ? " " : "", kind->name);
    fw_diag_error(r->diags, 185, a ? a->place : e->place, "<pattern> needs a kind; there are: %s",
                  fw_text_end(&known) == FW_OK ? known.data : "");
    return NULL;
}

fw_status fw_mask_pattern_row(fw_xml_reader *r, const fw_xml_element *e,
                              const fw_xml_element_row **row) {
    const fw_layout_pattern_kind *kind = kind_named(r, e);
    const fw_xml_element_row *any = *row;
    *row = NULL;
    if (!kind) return FW_OK;
    fw_xml_element_row *made = fw_arena_one(r->arena, fw_xml_element_row);
    fw_xml_attribute_row *list =
        fw_arena_array(r->arena, fw_xml_attribute_row, COMMON + 1 + (size_t)kind->nparameter);
    FW_NEED(made && list ? made : NULL);
    *made = *any;
    made->attribute = list;
    for (int i = 0; i < COMMON; i++)
        list[made->nattribute++] = common[i];
    for (int i = 0; i < kind->nparameter; i++)
        list[made->nattribute++] = parameter_row(&kind->parameter[i]);
    if (kind->sizes)
        list[made->nattribute++] =
            (fw_xml_attribute_row){"sizes", .required = true, .sentence = kind->sizes};
    FW_NEED(made->name = fw_arena_printf(r->arena, "pattern kind=\"%s\"", kind->name));
    *row = made;
    return FW_OK;
}

/* ---- what was read ---- */

static bool on_grid(double x_m) {
    return fabs(x_m * 1e9 - nearbyint(x_m * 1e9)) < 1e-3;
}

/* one of "4 um, 6 um, 10 um": n bytes at s */
static fw_status read_size(fw_xml_reader *r, const fw_xml_attribute *a, const char *s, size_t n,
                           fw_layout_pattern *p, bool *good) {
    fw_quantity_expression_error error = {0};
    fw_quantity_names none = {0};
    double *value = &p->size_m[p->nsize];
    fw_status status = fw_quantity_expression_evaluate(
        r->arena, s, n, &none, (fw_quantity_dimension){.m = 1}, value, &error);
    if (status == FW_NOMEM) return status;
    *good = status == FW_OK;
    if (!*good)
        fw_diag_error(r->diags, 185, a->place, "sizes: %s", error.message);
    else if (!(*value >= 1e-6 && *value <= 5e-3)) {
        char text[FW_LABEL];
        fw_diag_error(r->diags, 185, a->place, "sizes: %s is not at least 1 um and at most 5000 um",
                      fw_xml_in_unit(text, *value, "um"));
    } else if (!on_grid(*value))
        fw_diag_error(r->diags, 185, a->place, "sizes must be multiples of 1 nm");
    p->nsize++;
    return FW_OK;
}

static fw_status read_sizes(fw_xml_reader *r, const fw_xml_attribute *a, fw_layout_pattern *p) {
    bool good = true;
    for (const char *s = a->value; s && good;) {
        size_t n = strcspn(s, ",");
        if (p->nsize == FW_PATTERN_SIZES) {
            fw_diag_error(r->diags, 185, a->place, "sizes holds more than %d lengths",
                          FW_PATTERN_SIZES);
            return FW_OK;
        }
        FW_TRY(read_size(r, a, s, n, p, &good));
        s = s[n] ? s + n + 1 : NULL;
    }
    return FW_OK;
}

static fw_status read_pattern(fw_xml_reader *r, const fw_xml_record *e, fw_layout_pattern *p) {
    const fw_layout_pattern_kind *kind = fw_layout_pattern_kind_named(fw_xml_text_of(e, "kind"));
    const char *id = fw_xml_text_of(e, "id"), *title = fw_xml_text_of(e, "title");
    *p = (fw_layout_pattern){.kind = kind,
                             .biased = fw_mask_says(e, "bias", "yes"),
                             .id = id ? id : kind->name,
                             .title = title ? title : kind->name,
                             .gives = fw_xml_text_of(e, "gives"),
                             .measure = fw_xml_text_of(e, "measure"),
                             .source = fw_xml_text_of(e, "source"),
                             .place = e->element->place};
    for (int i = 0; i < kind->nparameter; i++) {
        const fw_layout_pattern_parameter *from = &kind->parameter[i];
        const fw_xml_cell *cell = fw_xml_cell_of(e, from->name);
        p->value[i] = cell->ok ? cell->number : from->usual;
        if (cell->ok && !from->number && !on_grid(p->value[i]))
            fw_diag_error(r->diags, 185, cell->given->place, "%s must be a multiple of 1 nm",
                          from->name);
    }
    const fw_xml_attribute *sizes = fw_xml_cell_of(e, "sizes")->given;
    return sizes ? read_sizes(r, sizes, p) : FW_OK;
}

fw_status fw_mask_patterns_build(fw_xml_reader *r, fw_mask_table *table) {
    const fw_xml_record *root = r->record;
    fw_layout_pattern *row =
        fw_arena_array(r->arena, fw_layout_pattern, (size_t)fw_xml_children(root, "pattern"));
    FW_NEED(row);
    table->pattern = row;
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "pattern")) continue;
        fw_layout_pattern *p = &row[table->npattern];
        FW_TRY(read_pattern(r, e, p));
        for (int i = 0; i < table->npattern; i++)
            if (strcmp(row[i].id, p->id) == 0)
                fw_diag_error(r->diags, 185, p->place,
                              "two test patterns have the id \"%s\"; measured values name it",
                              p->id);
        table->npattern++;
    }
    return FW_OK;
}
