/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/rule.h"
#include "mask/mask_parts.h"
#include "mask/mask.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const role_names[] = {
    [FW_ROLE_STRUCTURE] = "structure", [FW_ROLE_FLEXURE] = "flexure", [FW_ROLE_FRAME] = "frame",
    [FW_ROLE_TETHER] = "tether",       [FW_ROLE_TEXT] = "text",       [FW_ROLE_MARK] = "mark",
    [FW_ROLE_DICING] = "dicing",       [FW_ROLE_BACK] = "back",       [FW_ROLE_CAVITY] = "cavity",
    [FW_ROLE_LAND] = "land",           [FW_ROLE_METAL] = "metal",     [FW_ROLE_COUNT] = NULL};
const char *const *fw_mask_role_names(void) {
    return role_names;
}

static const char *const tones[] = {"data clear", "data dark", NULL};

/* ---- forms of text ---- */

static bool is_gds(const char *s) {
    int layer, datatype;
    return fw_mask_gds_pair(s, &layer, &datatype);
}

static bool is_colour(const char *s) {
    return strlen(s) == 7 && s[0] == '#' && strspn(s + 1, "0123456789abcdefABCDEF") == 6;
}

/* ---- patterns ---- */

/* <pattern kind="undercut-ladder" id="ladder" title="UNDERCUT" from="4 um" .../>: which test
   patterns a flow has, as data. Which attributes a kind takes is in its own row (layout/pattern.h).
 */

static const fw_xml_numbers pattern_numbers = {.element = 185,
                                               .misplaced = 185,
                                               .attribute = 185,
                                               .at_value = true,
                                               .missing = 185,
                                               .text = 49,
                                               .word = 185,
                                               .form = 185,
                                               .range = 185,
                                               .expression = 185};

/* rows: those that every kind has, and those of its parameters */

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

static fw_status pattern_row(fw_xml_reader *r, const fw_xml_element *e,
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

static fw_status patterns_build(fw_xml_reader *r, fw_mask_table *table) {
    const fw_xml_record *root = r->record;
    fw_layout_pattern *pattern =
        fw_arena_array(r->arena, fw_layout_pattern, (size_t)fw_xml_children(root, "pattern"));
    FW_NEED(pattern);
    table->pattern = pattern;
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "pattern")) continue;
        fw_layout_pattern *p = &pattern[table->npattern];
        FW_TRY(read_pattern(r, e, p));
        for (int i = 0; i < table->npattern; i++)
            if (strcmp(pattern[i].id, p->id) == 0)
                fw_diag_error(r->diags, 185, p->place,
                              "two test patterns have the id \"%s\"; measured values name it",
                              p->id);
        table->npattern++;
    }
    return FW_OK;
}

/* ---- rows ---- */

#define REQUIRED .required = true
#define NAME                                                                                       \
    .kind = FW_KIND_FORM, .form = fw_mask_is_name, .reason = "a name of 1 to 32 of A-Z a-z 0-9 _ -"
#define LEAST                                                                                      \
    FW_MASK_LENGTH, .ranged = true, .max = 1e-2, .reason = "no design rule is wider than 10 mm",   \
                    .fallback = "no rule"

static const fw_xml_attribute_row root_rows[] = {
    {"flow", NAME, REQUIRED, .sentence = "Flow that the masks are for."},
    {"reading", FW_MASK_PLAIN,
     .sentence = "Of a flow with one plate: how it is read, such as right-reading chrome down."},
    {"order", FW_MASK_PLAIN, .sentence = "Of a flow with one plate: what the mask shop is told."},
    {"plate", FW_MASK_PLAIN,
     .sentence = "Of a flow with one plate: layers with AND, OR, NOT or XOR between, 1/0 NOT 2/0."},
};
static const fw_xml_attribute_row layer_rows[] = {
    {"gds", .kind = FW_KIND_FORM, .form = is_gds, REQUIRED,
     .reason = "LAYER/DATATYPE, both 0 to 65535, for example 1/0; every mask shop reads 1 to 63",
     .sentence = "Its numbers in GDSII and OASIS."},
    {"id", NAME, REQUIRED, .sentence = "Name that rules use."},
    {"name", NAME, REQUIRED, .sentence = "Name in files of masks."},
    {"purpose", FW_MASK_PLAIN, REQUIRED, .sentence = "What it is for."},
    {"tone", .kind = FW_KIND_WORD, .words = tones, REQUIRED,
     .sentence = "What the data are on the plate."},
    {"colour", .kind = FW_KIND_FORM, .form = is_colour, REQUIRED,
     .reason = "#rrggbb, for example #3d6aa8", .sentence = "In pictures."},
    {"roles", .kind = FW_KIND_WORDS, .words = role_names, .sentence = "What is drawn on it."},
    {"biased", FW_MASK_YES_NO, .sentence = "Does the bias of the process apply?"},
    {"source", FW_MASK_PLAIN, .sentence = "Where its rule is from."},
    {"min-width", LEAST, .sentence = "Narrowest that is printed."},
    {"min-space", LEAST, .sentence = "Nearest that is printed apart."},
    {"documentation", FW_MASK_YES_NO, .sentence = "yes: for people; nothing is exposed."},
    {"shrink", .kind = FW_KIND_FORM, .form = is_name_of_quantity,
     .reason = "the id of a quantity of the flow",
     .sentence = "Length by which its step widens what is printed: it is drawn so much smaller."},
    {"grow", .kind = FW_KIND_FORM, .form = is_name_of_quantity,
     .reason = "the id of a quantity of the flow",
     .sentence = "Length by which its step narrows what is printed: it is drawn so much larger."},
};
static const fw_xml_element_row rows[] = {
    {"mask-table", "", FW_MASK_ROWS(root_rows), .sentence = "The layers of a flow's masks."},
    {"layer", "mask-table", "id", .needed = true, FW_MASK_ROWS(layer_rows),
     .sentence = "A layer of the masks."},
    {"rule", "mask-table", .specialise = fw_mask_rule_row, .numbers = &fw_mask_rule_numbers,
     .sentence = "A design rule of a layer."},
    {"pattern", "mask-table", .specialise = pattern_row, .numbers = &pattern_numbers,
     .sentence = "A test pattern."},
    {0},
};
static const fw_xml_element_row *const parts[] = {rows, fw_mask_plate_rows, NULL};
static const char *const spaces[] = {"name"};

static const fw_xml_table table_of_layers = {.file = "layer table",
                                             .root = "mask-table",
                                             .urn = "urn:flexwright:masks:1",
                                             .head = "flow=\"...\"",
                                             .source = "src/mask/mask_table.c",
                                             .part = parts,
                                             .space = spaces,
                                             .nspace = 1,
                                             .numbers = {.root = 140,
                                                         .element = 140,
                                                         .misplaced = 140,
                                                         .needed = 140,
                                                         .attribute = 140,
                                                         .at_value = true,
                                                         .missing = 140,
                                                         .text = 49,
                                                         .word = 141,
                                                         .form = 141,
                                                         .range = 141}};

/* ---- layers ---- */

static unsigned roles_of(const fw_xml_record *record) {
    const char *text = fw_xml_text_of(record, "roles");
    unsigned roles = 0;
    for (const char *s = text ? text : ""; *s;) {
        size_t n = strcspn(s, " \t\r\n");
        for (unsigned k = 0; k < FW_ROLE_COUNT; k++)
            if (strlen(role_names[k]) == n && memcmp(role_names[k], s, n) == 0) roles |= 1u << k;
        s += n + strspn(s + n, " \t\r\n");
    }
    return roles;
}

int fw_mask_layer_of_role(const fw_mask_table *table, const char *role) {
    for (unsigned r = 0; r < FW_ROLE_COUNT; r++)
        for (int k = 0; strcmp(role_names[r], role) == 0 && k < table->nlayer; k++)
            if (table->layer[k].roles & 1u << r) return k;
    return -1;
}

static fw_mask_layer layer_of(fw_diags *diags, const fw_xml_record *record) {
    fw_mask_layer l = {.id = fw_xml_text_of(record, "id"),
                       .name = fw_xml_text_of(record, "name"),
                       .purpose = fw_xml_text_of(record, "purpose"),
                       .tone = fw_xml_text_of(record, "tone"),
                       .colour = fw_xml_text_of(record, "colour"),
                       .roles = roles_of(record),
                       .biased = fw_mask_says(record, "biased", "yes"),
                       .rule_source = fw_xml_text_of(record, "source"),
                       .documentation = fw_mask_says(record, "documentation", "yes"),
                       .shrink = fw_xml_text_of(record, "shrink"),
                       .grow = fw_xml_text_of(record, "grow"),
                       .place = record->element->place};
    const char *gds = fw_xml_text_of(record, "gds");
    if (!gds || !fw_mask_gds_pair(gds, &l.layer, &l.datatype)) l.layer = l.datatype = -1;
    const fw_xml_cell *width = fw_xml_cell_of(record, "min-width"),
                      *space = fw_xml_cell_of(record, "min-space");
    l.min_width_m = width->ok ? width->number : 0.0;
    l.min_space_m = space->ok ? space->number : 0.0;
    if ((l.min_width_m > 0 || l.min_space_m > 0) && !fw_xml_given(record, "source"))
        fw_diag_error(diags, 140, l.place,
                      "<layer> has a design rule without its reason; add source=\"...\"");
    if ((l.biased && (l.shrink || l.grow)) || (l.shrink && l.grow))
        fw_diag_error(diags, 141, l.place,
                      "a layer takes one of biased, shrink and grow: each says what its step does "
                      "to an edge");
    if (l.documentation && l.roles)
        fw_diag_error(diags, 141, l.place,
                      "a documentation layer is never exposed, so no role may be drawn on it; "
                      "remove roles or documentation");
    return l;
}

/* same id, same GDSII pair, a role on two layers, two documentation layers */
static void check_collisions(const fw_mask_table *table, fw_diags *diags) {
    for (int j = 1; j < table->nlayer; j++)
        for (int i = 0; i < j; i++) {
            const fw_mask_layer *a = &table->layer[i], *b = &table->layer[j];
            if (a->id && b->id && strcmp(a->id, b->id) == 0)
                fw_diag_error(diags, 142, b->place,
                              "layer id \"%s\" is used twice, first in line %d", b->id,
                              a->place.line);
            if (a->layer >= 0 && a->layer == b->layer && a->datatype == b->datatype)
                fw_diag_error(diags, 142, b->place,
                              "layer %d/%d is used twice, first in line %d; choose a free number",
                              b->layer, b->datatype, a->place.line);
            for (unsigned k = 0; k < FW_ROLE_COUNT; k++)
                if (a->roles & b->roles & 1u << k)
                    fw_diag_error(diags, 142, b->place,
                                  "role \"%s\" is drawn on two layers, first in line %d; keep one",
                                  role_names[k], a->place.line);
            if (a->documentation && b->documentation)
                fw_diag_error(diags, 142, b->place,
                              "two documentation layers, first in line %d; keep one",
                              a->place.line);
        }
}

fw_status fw_mask_table_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                             fw_diags *diags, fw_mask_table *table) {
    *table = (fw_mask_table){0};
    size_t errors = diags->errors;
    fw_xml_reader r;
    FW_TRY(fw_xml_table_read(arena, &table_of_layers, file, xml, n, diags, &r));
    const fw_xml_record *root = r.record;
    table->flow = fw_xml_text_of(root, "flow");
    size_t count = (size_t)fw_xml_children(root, "layer");
    FW_NEED(table->layer = fw_arena_array(arena, fw_mask_layer, count));
    for (const fw_xml_record *e = root->first_child; e; e = e->next)
        if (fw_xml_is(e, "layer")) table->layer[table->nlayer++] = layer_of(diags, e);
    check_collisions(table, diags);
    FW_TRY(fw_mask_plates_build(&r, table));
    FW_TRY(fw_mask_contents_build(&r, table));
    FW_TRY(patterns_build(&r, table));
    FW_TRY(fw_mask_rules_build(&r, table));
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}

/* ---- what a mask says about itself, for the documentation layer and the heads of files ---- */

int fw_mask_notes_layer(const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].documentation) return k;
    return -1;
}

typedef struct lines {
    fw_arena *arena;
    const char **line;
    int count;
} lines;

fw_status fw_mask_note(fw_arena *arena, const char *key, const char *value, const char **line) {
    FW_NEED(value);
    fw_text text = fw_text_new(arena);
    const char *at = fw_arena_printf(arena, "%s%s%s", key, *key ? "=" : "", value);
    FW_NEED(at);
    while (*at) { /* readers take ASCII only; a whole character is one <U+00B5> */
        const char *letter = at;
        unsigned code = fw_text_character(&at);
        bool plain = code >= 0x20 && code <= 0x7e;
        if (text.length + (plain ? 1 : 10) > FW_MASK_NOTE_MOST) break;
        if (plain)
            fw_text_bytes(&text, letter, 1);
        else
            fw_text_printf(&text, "<U+%04X>", code);
    }
    *line = text.data ? text.data : "";
    return fw_text_end(&text);
}

static fw_status add(lines *l, const char *key, const char *value) {
    return fw_mask_note(l->arena, key, value, &l->line[l->count++]);
}

static fw_status add_layers(lines *l, const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++) {
        const fw_mask_layer *y = &table->layer[k];
        char key[32];
        snprintf(key, sizeof key, "layer %d/%d", y->layer, y->datatype);
        const char *value = fw_arena_printf(l->arena, "%s; %s; %s", y->name, y->tone, y->purpose);
        FW_NEED(value);
        FW_TRY(add(l, key, value));
    }
    return FW_OK;
}

fw_status fw_mask_notes(fw_arena *arena, const fw_mask *mask, const char ***line, int *count) {
    enum { OWN = 10 };
    lines l = {arena, NULL, 0};
    size_t most = OWN + (size_t)mask->table->nlayer + (size_t)mask->nnote;
    FW_NEED(l.line = fw_arena_array(arena, const char *, most));
    char number[32];
    if (mask->rejected) FW_TRY(add(&l, "status", "REJECTED"));
    FW_TRY(add(&l, "device", mask->device));
    FW_TRY(add(&l, "title", mask->title));
    FW_TRY(add(&l, "program", "flexwright " FW_VERSION));
    FW_TRY(add(&l, "flow", mask->flow));
    FW_TRY(add(&l, "reading", mask->table->reading));
    if (mask->table->order) FW_TRY(add(&l, "order", mask->table->order));
    FW_TRY(
        add(&l, "bias_um_per_edge", fw_number_text(number, sizeof number, mask->bias_m * 1e6, 6)));
    FW_TRY(add(&l, "bias", "process bias included, mask CD bias 0"));
    FW_TRY(
        add(&l, "tolerance_nm", fw_number_text(number, sizeof number, mask->tolerance_m * 1e9, 6)));
    FW_TRY(add_layers(&l, mask->table));
    for (int i = 0; i < mask->nnote; i++)
        FW_TRY(add(&l, "", mask->note[i]));
    *line = l.line;
    *count = l.count;
    return FW_OK;
}
