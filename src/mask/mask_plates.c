/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <plate>: one row for each plate that a flow prints, in the order of printing; a table with one plate says the same in
   attributes of its root. <content>: what they draw besides the device. Page: docs/theory/plates.md. */
#include "mask/mask_parts.h"
#include "layout/layout.h"
#include "mask/rule.h"
#include <math.h>
#include <string.h>

/* ---- kinds of content ---- */

#define FW_MASK_CONTENT(name) extern const fw_mask_content_kind fw_mask_content_##name;
#include "mask/contents.def"
#undef FW_MASK_CONTENT

static const fw_mask_content_kind *const kinds[] = {
#define FW_MASK_CONTENT(name) &fw_mask_content_##name,
#include "mask/contents.def"
#undef FW_MASK_CONTENT
};

static const fw_mask_content_kind *content_kind_at(size_t i) {
    return i < sizeof kinds / sizeof kinds[0] ? kinds[i] : NULL;
}

static const fw_mask_content_kind *kind_of(const char *name) {
    const fw_mask_content_kind *kind;
    for (size_t i = 0; (kind = content_kind_at(i)); i++)
        if (name && strcmp(kind->name, name) == 0) return kind;
    return NULL;
}

/* ---- rows ---- */

static const char *const sides[] = {"front", "back", NULL};

static const fw_xml_attribute_row plate_attributes[] = {
    {"id", .kind = FW_KIND_ID, .required = true,
     .sentence = "Names it in steps and in the names of files."},
    {"title", FW_MASK_PLAIN, .required = true, .sentence = "What it is, for people."},
    {"layers", FW_MASK_PLAIN, .required = true,
     .sentence = "Layers with AND, OR, NOT or XOR between: 1/0 NOT 2/0."},
    {"reading", FW_MASK_PLAIN, .required = true,
     .sentence = "How it is read, such as right-reading chrome down."},
    {"order", FW_MASK_PLAIN, .sentence = "What the mask shop is told."},
    {"aligned-to", .kind = FW_KIND_ID,
     .sentence = "Plate printed before whose marks it is put on."},
    {"marks", .kind = FW_KIND_WORD, .words = sides, .fallback = "front",
     .sentence = "From which side of the wafer these marks are seen."},
    {"overlay", FW_MASK_LENGTH, .ranged = true, .open = true, .max = 1e-4,
     .reason = "what aligners reach", .sentence = "Budget between the two plates."},
};

static const fw_xml_attribute_row content_common[] = {
    {"kind", .required = true, .sentence = "What is drawn."},
    {"source", FW_MASK_PLAIN, .required = true, .sentence = "Where its lengths are from."},
};
enum { COMMON = sizeof content_common / sizeof content_common[0] };

static fw_xml_attribute_row parameter_row(const fw_mask_content_parameter *p) {
    return (fw_xml_attribute_row){p->name,
                                  .kind = FW_KIND_NUMBER,
                                  .dimension = {.m = 1},
                                  .unit = "um",
                                  .ranged = true,
                                  .min = p->least,
                                  .max = p->most,
                                  .reason = "what can be drawn with it",
                                  .required = isnan(p->usual),
                                  .sentence = p->sentence};
}

static fw_status content_row(fw_xml_reader *r, const fw_xml_element *e,
                             const fw_xml_element_row **row) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, "kind");
    const fw_mask_content_kind *kind = kind_of(a ? a->value : NULL);
    const fw_xml_element_row *any = *row;
    *row = NULL;
    if (!kind) {
        fw_text known = fw_text_new(r->arena);
        for (size_t i = 0; (kind = content_kind_at(i)); i++)
            fw_text_printf(&known, "%s%s", i ? " " : "", kind->name);
        fw_diag_error(r->diags, 410, a ? a->place : e->place,
                      "<content> needs a kind; there are: %s",
                      fw_text_end(&known) == FW_OK ? known.data : "");
        return FW_OK;
    }
    fw_xml_element_row *made = fw_arena_one(r->arena, fw_xml_element_row);
    fw_xml_attribute_row *list =
        fw_arena_array(r->arena, fw_xml_attribute_row, COMMON + (size_t)kind->nparameter);
    FW_NEED(made && list ? made : NULL);
    *made = *any;
    made->attribute = list;
    for (int i = 0; i < COMMON; i++)
        list[made->nattribute++] = content_common[i];
    for (int i = 0; i < kind->nparameter; i++)
        list[made->nattribute++] = parameter_row(&kind->parameter[i]);
    FW_NEED(made->name = fw_arena_printf(r->arena, "content kind=\"%s\"", kind->name));
    *row = made;
    return FW_OK;
}

static const fw_xml_numbers numbers = {.element = 410,
                                       .misplaced = 410,
                                       .attribute = 410,
                                       .at_value = true,
                                       .missing = 410,
                                       .text = 49,
                                       .word = 410,
                                       .form = 410,
                                       .range = 410,
                                       .expression = 410};

const fw_xml_element_row fw_mask_plate_rows[] = {
    {"plate", "mask-table", FW_MASK_ROWS(plate_attributes), .numbers = &numbers,
     .sentence = "A plate of a flow that prints several, in the order of printing."},
    {"content", "mask-table", .specialise = content_row, .numbers = &numbers,
     .sentence = "What a plate draws besides the device."},
    {0},
};

/* ---- building ---- */

static void check_layers(const fw_mask_table *table, const fw_mask_plate_row *p, fw_place place,
                         const char *attribute, fw_diags *diags) {
    int first;
    const char *wrong;
    if (!p->layers || fw_mask_plate_layers(table, p->layers, NULL, &first, &wrong)) return;
    fw_diag_error(diags, 133, place,
                  "%s=\"%s\" cannot be read at \"%s\"; write layers of this table with AND, OR, "
                  "NOT or XOR between, for example \"1/0 NOT 2/0\"",
                  attribute, p->layers, wrong);
}

/* a table with one plate says it in the attributes of its root */
static void check_only_plate(fw_xml_reader *r, const fw_mask_table *table) {
    const fw_xml_record *root = r->record;
    const fw_mask_plate_row own = fw_mask_plate_at(table, 0);
    check_layers(table, &own, fw_xml_place_of(root, "plate"), "plate", r->diags);
    if (!fw_xml_given(root, "reading"))
        fw_diag_error(r->diags, 140, root->element->place,
                      "<mask-table> needs the attribute reading, such as \"right-reading chrome "
                      "down\", or rows <plate>");
}

static void read_plate(fw_xml_reader *r, fw_mask_table *table, const fw_xml_record *e,
                       fw_mask_plate_row *p) {
    const fw_xml_cell *overlay = fw_xml_cell_of(e, "overlay");
    *p = (fw_mask_plate_row){.id = fw_xml_text_of(e, "id"),
                             .title = fw_xml_text_of(e, "title"),
                             .layers = fw_xml_text_of(e, "layers"),
                             .reading = fw_xml_text_of(e, "reading"),
                             .order = fw_xml_text_of(e, "order"),
                             .aligned_to = fw_xml_text_of(e, "aligned-to"),
                             .back = fw_mask_says(e, "marks", "back"),
                             .overlay_m = overlay->ok ? overlay->number : (double)NAN,
                             .place = e->element->place};
    if (!p->id) p->id = "";
    if (!p->title) p->title = "";
    if (!p->reading) p->reading = "";
    check_layers(table, p, fw_xml_place_of(e, "layers"), "layers", r->diags);
    if (fw_mask_plate_named(table, p->id) >= 0)
        fw_diag_error(r->diags, 410, p->place, "two plates have the id \"%s\"", p->id);
    if (p->aligned_to && fw_mask_plate_named(table, p->aligned_to) < 0)
        fw_diag_error(r->diags, 410, fw_xml_place_of(e, "aligned-to"),
                      "plate \"%s\" is aligned to \"%s\", which no row above it is: a plate can be "
                      "put only on what was printed before",
                      p->id, p->aligned_to);
    if (table->nplate > 0 && (!p->aligned_to || isnan(p->overlay_m)))
        fw_diag_error(r->diags, 410, p->place,
                      "plate \"%s\" is not the first that is printed; say which one it is put on, "
                      "and how well: aligned-to=\"...\" overlay=\"3 um\"",
                      p->id);
}

static bool draws_structure(const fw_mask_table *table, const fw_mask_plate_row *p, bool *named) {
    int first;
    const char *wrong;
    memset(named, 0, (size_t)table->nlayer * sizeof *named);
    if (!p->layers || !fw_mask_plate_layers(table, p->layers, named, &first, &wrong)) return false;
    for (int k = 0; k < table->nlayer; k++)
        if (named[k] && table->layer[k].roles & 1u << FW_ROLE_STRUCTURE) return true;
    return false;
}

/* which one prints the device; exactly one must */
static fw_status find_device_plate(fw_xml_reader *r, fw_mask_table *table) {
    bool *named = fw_arena_array(r->arena, bool, (size_t)table->nlayer);
    int found = 0;
    FW_NEED(named);
    for (int i = 0; i < table->nplate; i++) {
        if (!draws_structure(table, &table->plates[i], named)) continue;
        if (found++ == 0) table->device_plate = i;
    }
    if (found == 1 || r->diags->errors > 0) return FW_OK;
    fw_diag_error(r->diags, 410, r->record->element->place,
                  "%d of %d plates print the layer with the role \"structure\"; exactly one must",
                  found, table->nplate);
    return FW_OK;
}

fw_status fw_mask_plates_build(fw_xml_reader *r, fw_mask_table *table) {
    static const char *const of_one[] = {"plate", "reading", "order"};
    const fw_xml_record *root = r->record;
    int n = fw_xml_children(root, "plate");
    const char *reading = fw_xml_text_of(root, "reading");
    table->plate = fw_xml_text_of(root, "plate");
    table->reading = reading ? reading : "";
    table->order = fw_xml_text_of(root, "order");
    if (n == 0) {
        check_only_plate(r, table);
        return FW_OK;
    }
    for (size_t i = 0; i < sizeof of_one / sizeof of_one[0]; i++)
        if (fw_xml_given(root, of_one[i]))
            fw_diag_error(
                r->diags, 410, fw_xml_place_of(root, of_one[i]),
                "%s is of a table with one plate; this one has rows <plate>, which say it "
                "each for itself",
                of_one[i]);
    FW_NEED(table->plates = fw_arena_array(r->arena, fw_mask_plate_row, (size_t)n));
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "plate")) continue;
        read_plate(r, table, e, &table->plates[table->nplate]);
        table->nplate++;
    }
    FW_TRY(find_device_plate(r, table));
    const fw_mask_plate_row *own = &table->plates[table->device_plate];
    table->plate = own->layers;
    table->reading = own->reading;
    table->order = own->order;
    return FW_OK;
}

fw_status fw_mask_contents_build(fw_xml_reader *r, fw_mask_table *table) {
    const fw_xml_record *root = r->record;
    fw_mask_content *content =
        fw_arena_array(r->arena, fw_mask_content, (size_t)fw_xml_children(root, "content"));
    FW_NEED(content);
    table->content = content;
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "content")) continue;
        const fw_mask_content_kind *kind = kind_of(fw_xml_text_of(e, "kind"));
        fw_mask_content *c = &content[table->ncontent++];
        *c = (fw_mask_content){
            .kind = kind, .source = fw_xml_text_of(e, "source"), .place = e->element->place};
        for (int i = 0; i < kind->nparameter; i++) {
            const fw_xml_cell *cell = fw_xml_cell_of(e, kind->parameter[i].name);
            c->value[i] = cell->ok ? cell->number : kind->parameter[i].usual;
        }
    }
    return FW_OK;
}

/* ---- drawing ---- */

fw_status fw_mask_contents_add(fw_arena *arena, const fw_mask_table *table, const fw_layout *marked,
                               const fw_layout **layout) {
    *layout = marked;
    if (table->ncontent == 0 || !marked->drawn || marked->nfault > 0) return FW_OK;
    fw_mask_sheet sheet = {.arena = arena, .device = marked, .npiece = marked->npiece};
    sheet.capacity = marked->npiece + 32;
    FW_NEED(sheet.piece = fw_arena_array(arena, fw_layout_piece, (size_t)sheet.capacity));
    memcpy(sheet.piece, marked->piece, (size_t)marked->npiece * sizeof *sheet.piece);
    for (int i = 0; i < table->ncontent; i++)
        FW_TRY(table->content[i].kind->draw(&table->content[i], &sheet));
    fw_layout *own = fw_arena_one(arena, fw_layout);
    FW_NEED(own);
    *own = *marked;
    own->piece = sheet.piece;
    own->npiece = sheet.npiece;
    *layout = own;
    return FW_OK;
}

/* ---- judging ---- */

fw_status fw_mask_contents_judge(fw_arena *arena, const fw_mask_table *table,
                                 const fw_layout *layout, fw_mask_verdict *verdict) {
    *verdict = (fw_mask_verdict){.arena = arena};
    if (!layout || !layout->drawn || layout->nfault > 0) return FW_OK;
    for (int i = 0; i < table->ncontent; i++)
        FW_TRY(table->content[i].kind->judge(&table->content[i], table, layout, verdict));
    return FW_OK;
}
