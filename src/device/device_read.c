/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the text of a device file to its description, step by step; later steps run after mistakes
   of earlier ones, so that one run reports everything. */
#include "base/text.h"
#include "device/device_reader.h"
#include "quantity/law_kind.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* a material is needed where stiffness or mass must be computed; a mass that is stated and could
   not be read is no mass that must be computed */
static void check_material(fw_device_reader *r) {
    const fw_device *d = r->device;
    int without_mass = 0;
    for (int i = 0; i < d->nbody; i++)
        without_mass += !(d->body[i].mass_kg > 0.0);
    for (int i = 0; i < r->xml.nrecord; i++)
        without_mass -= fw_xml_failed(&r->xml.record[i], "mass");
    bool needed = d->nflexure > 0 || without_mass > 0;
    if (needed && fw_xml_count(&r->xml, "material") == 0 && !r->xml.unknown_element)
        fw_diag_error(r->diags, 52, r->xml.root->place,
                      "<device> has no <material>, and flexures or shapes need one; add <material "
                      "ref=\"silicon-100\"/> or another of processes/base.xml");
}

static fw_status build(fw_device_reader *r) {
    size_t errors = r->diags->errors;
    FW_TRY(fw_xml_ids_check(&r->xml));
    FW_TRY(fw_device_build_parts(r));
    FW_TRY(fw_device_build_wafer(r));
    FW_TRY(fw_device_build_flexures(r));
    FW_TRY(fw_device_expand_six_bar(r));
    FW_TRY(fw_device_build_mechanism(r));
    if (r->diags->errors == errors)
        FW_TRY(fw_device_close_rounded(r)); /* else places may be missing */
    FW_TRY(fw_device_build_scenes(r));
    check_material(r);
    return FW_OK;
}

fw_status fw_device_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                         const fw_device_set *set, int nset, fw_diags *diags,
                         const fw_device **device) {
    *device = NULL;
    size_t before = diags->errors;
    fw_device *d = fw_arena_one(arena, fw_device);
    FW_NEED(d);
    fw_device_reader r = {.xml = {.arena = arena, .diags = diags, .table = &fw_device_table},
                          .arena = arena,
                          .diags = diags,
                          .device = d};
    FW_TRY(fw_xml_read(arena, file, xml, n, diags, &r.xml.root));
    FW_NEED(d->source = fw_arena_strndup(arena, xml, n));
    FW_NEED(d->file = fw_arena_strdup(arena, file ? file : ""));
    d->source_length = n;
    FW_TRY(fw_device_sets_apply(&r, set, nset));
    FW_TRY(fw_xml_records_read(&r.xml));
    FW_TRY(fw_xml_words_read(&r.xml));
    FW_TRY(fw_device_parameters_read(&r));
    FW_TRY(fw_xml_numbers_read(&r.xml));
    FW_TRY(build(&r));
    if (diags->failed) return FW_NOMEM;
    *device = d;
    return diags->errors > before ? FW_INPUT : FW_OK;
}

/* ---- questions about a description ---- */

bool fw_device_in_flow(const char *asked, const char *flow) {
    return !asked || (flow && strcmp(asked, flow) == 0);
}

bool fw_device_needs_shapes(const fw_device *device) {
    for (int i = 0; i < device->nbody; i++) {
        const fw_device_body *b = &device->body[i];
        if (isnan(b->mass_kg) || isnan(b->inertia_kg_m2) || isnan(b->x_m) || isnan(b->y_m))
            return true;
    }
    return false;
}

int fw_device_flexure_pieces(const fw_device_flexure *f, fw_geometry_strip_piece *piece) {
    if (f->kind == FW_FLEXURE_PATH) {
        for (int i = 0; i < f->npiece; i++)
            piece[i] = f->piece[i];
        return f->npiece;
    }
    double t = f->width_m, middle = f->width_middle_m > 0 ? f->width_middle_m : t;
    *piece = (fw_geometry_strip_piece){.length_m = f->length_m,
                                       .curvature_per_m =
                                           f->kind == FW_FLEXURE_CSFH ? 1 / f->radius_m : 0,
                                       .width_m = {t, middle, t}};
    return 1;
}

bool fw_device_flexure_varies(const fw_device_flexure *f) {
    return f->kind == FW_FLEXURE_PATH || (f->width_middle_m > 0 && f->width_middle_m != f->width_m);
}

double fw_device_flexure_narrowest_m(const fw_device_flexure *f) {
    return f->width_middle_m > 0 && f->width_middle_m < f->width_m ? f->width_middle_m : f->width_m;
}

/* docs/reference/device.md, device.rng and the list of elements, from the rows of table_*.c. */

/* the laws, and their attributes, which are the same for every element that goes with time */
static fw_status add_laws(fw_text *out) {
    fw_xml_attributes all;
    fw_text_add(out, "| law | attributes | factor |\n|---|---|---|\n");
    for (const fw_quantity_law_kind *const *kind = fw_quantity_law_kinds; *kind; kind++) {
        fw_text_printf(out, "| `%s` |", (*kind)->name);
        for (int i = 0; i < (*kind)->attributes; i++) {
            const fw_quantity_law_attribute *a = &(*kind)->attribute[i];
            fw_text_printf(out, a->needed ? "%s **`%s`**" : "%s `%s`", i ? "," : "", a->name);
        }
        fw_text_printf(out, " | %s |\n", (*kind)->factor);
    }
    FW_TRY(fw_xml_law_attributes(out->arena, &all));
    fw_text_add(out, FW_XML_PAGE_HEAD);
    for (int i = 0; i < all.count; i++)
        fw_xml_page_attribute(&fw_device_table, &all.item[i], out);
    return FW_OK;
}

static void add_element(fw_text *out, const fw_xml_element_row *e) {
    fw_xml_page_element(e, out);
    if (e->nattribute > 0 || e->timed) fw_text_add(out, FW_XML_PAGE_HEAD);
    for (int i = 0; i < e->nattribute; i++)
        fw_xml_page_attribute(&fw_device_table, &e->attribute[i], out);
    if (e->timed)
        fw_text_printf(
            out, "| `law` and its attributes | see [Time](#time) | %s | How it goes with time. |\n",
            fw_quantity_law_kinds[0]->name);
}

static void add_units(fw_text *out) {
    size_t count;
    const char *const *names = fw_quantity_unit_names(&count);
    fw_text_add(
        out, "\n## Units\n\nSymbols are joined by a space, `.`, `*` or `/` and may carry a whole "
             "exponent: `N m/rad`, `mA/cm2`, `um^2`, `s^-1`. `Ao` is the Angstrom, `Cel` the "
             "degree Celsius, `{sccm}` gas flow (1 cm3 per minute at 273.15 K and 101325 Pa)."
             "\n\n");
    for (size_t i = 0; i < count; i++)
        fw_text_printf(out, "%s`%s`", i ? ", " : "", names[i]);
    fw_text_add(out, "\n");
}

fw_status fw_device_reference_markdown(fw_text *out) {
    const fw_xml_element_row *row;
    fw_text_add(out,
                "<!-- generated from src/device/table_*.c; do not edit -->\n"
                "# Device files\n\n"
                "A device file is XML in UTF-8, at most 8 MiB, without DOCTYPE, entities of its "
                "own or processing instructions. The schema for editors is "
                "[device.rng](device.rng).\n\n"
                "## Values\n\n"
                "A physical value is a number with its unit or an expression: `10 um`, `2*t + 5 "
                "um`, `1.711e-6 N m/rad`. A unit binds tighter than `*` and `/`; names are "
                "parameters; `sqrt exp ln sin cos tan asin acos atan atan2 min max abs` and `pi` "
                "are known. Both sides of `+` and `-` need the same kind of unit, and the result "
                "the kind of the attribute. The angle is a kind of its own; only a product or "
                "quotient may lack or carry an extra `rad` (length / angle is a radius).\n\n"
                "`--set NAME=VALUE` changes a parameter, `--set ELEMENT[ID]/@ATTRIBUTE=VALUE` an "
                "attribute (`flexure[A]/@length=312 um`); `[ID]` may be left out where there is "
                "one such element.\n\n"
                "## Time\n\n"
                "Loads are constant from the start, or go with time by their `law`, a factor that "
                "multiplies them:\n\n");
    FW_TRY(add_laws(out));
    fw_text_add(
        out, "\nIn an expression in time `t` or `time` is the time in s, to be used with its unit: "
             "`sin(2*pi*t/(10 ms))`, `3 rad/s * t`, `min(1, t/(5 ms))`. Where a parameter is "
             "called `t`, `time` must be written.\n\n"
             "## Elements\n");
    for (int i = 0; (row = fw_xml_row_at(&fw_device_table, i)) != NULL; i++)
        add_element(out, row);
    add_units(out);
    return fw_text_end(out);
}

fw_status fw_device_relax_ng(fw_text *out) {
    return fw_xml_schema(&fw_device_table, out);
}

fw_status fw_device_table_json(fw_text *out) {
    return fw_xml_table_json(&fw_device_table, out);
}

/* Ids: unique within their kind, and references that lead somewhere. */

static size_t count_of(const fw_device *d, fw_device_space space) {
    switch (space) {
    case FW_SPACE_PARAMETER:
        return (size_t)d->nparameter;
    case FW_SPACE_FLOW:
        return (size_t)d->nflow;
    case FW_SPACE_FLEXURE:
        return (size_t)d->nflexure;
    case FW_SPACE_BODY:
        return (size_t)d->nbody;
    case FW_SPACE_JOINT:
        return (size_t)d->nrevolute + (size_t)d->njoint;
    case FW_SPACE_NONE:
    case FW_SPACE_SPRING: /* nothing refers to these */
    case FW_SPACE_DRIVER:
    case FW_SPACE_SCENE:
    case FW_SPACE_TENDON:
    case FW_SPACE_COMB:
    case FW_SPACE_CONTACT:
    case FW_SPACE_COUNT:
        break;
    }
    return 0;
}

typedef struct named {
    const char *id;
    fw_place place;
} named;

static named name_of(const fw_device *d, fw_device_space space, size_t i) {
    size_t joints = (size_t)d->nrevolute;
    if (space == FW_SPACE_PARAMETER) return (named){d->parameter[i].name, d->parameter[i].place};
    named n = space == FW_SPACE_FLOW      ? (named){d->flow[i].ref, d->flow[i].place}
              : space == FW_SPACE_FLEXURE ? (named){d->flexure[i].id, d->flexure[i].place}
              : space == FW_SPACE_BODY    ? (named){d->body[i].id, d->body[i].place}
              : i < joints                ? (named){d->revolute[i].id, d->revolute[i].place}
                           : (named){d->joint[i - joints].id, d->joint[i - joints].place};
    if (!n.id) n.id = "";
    return n;
}

/* ---- the index: open addressing, at most half full; the first of equal ids stays ---- */

static uint64_t hash_of(const char *id) { /* FNV-1a */
    uint64_t hash = 14695981039346656037u;
    for (; *id; id++)
        hash = (hash ^ (unsigned char)*id) * 1099511628211u;
    return hash ^ (hash >> 32);
}

/* slot of the id, or the free one where it belongs */
static int *slot_of(const fw_device *d, fw_device_space space, const fw_device_id_index *x,
                    const char *id) {
    size_t mask = ((size_t)1 << x->bits) - 1, at = (size_t)hash_of(id) & mask;
    while (x->slot[at] && strcmp(name_of(d, space, (size_t)x->slot[at] - 1).id, id) != 0)
        at = (at + 1) & mask;
    return &x->slot[at];
}

/* what was built since the last look-up comes in; false when memory is short */
static bool enter(fw_device_reader *r, fw_device_space space) {
    const fw_device *d = r->device;
    fw_device_id_index *x = &r->index[space];
    size_t n = count_of(d, space);
    if (!x->slot || n > ((size_t)1 << x->bits) / 2) {
        for (x->bits = 5; n > ((size_t)1 << x->bits) / 2;)
            x->bits++;
        x->slot = fw_arena_array(r->arena, int, (size_t)1 << x->bits);
        x->entered = 0;
    }
    for (; x->slot && (size_t)x->entered < n; x->entered++) {
        int *slot = slot_of(d, space, x, name_of(d, space, (size_t)x->entered).id);
        if (*slot == 0) *slot = x->entered + 1;
    }
    return x->slot != NULL;
}

enum { SUGGESTIONS_MOST = 2000 }; /* ids that a misspelt one is compared with */

/* either end of the reference may be the misspelt one, so the message names both places */
static void report_dangling(fw_device_reader *r, const fw_xml_record *record,
                            const fw_xml_attribute_row *row, const fw_xml_attribute *a) {
    const fw_device *d = r->device;
    size_t n = count_of(d, (fw_device_space)row->space);
    const char *kind = fw_device_table.space[row->space], *better = NULL;
    char label[FW_LABEL], list[200] = "";
    size_t used = 0;
    int least = 3;
    fw_place there = {0};
    for (size_t i = 0; i < n && i < SUGGESTIONS_MOST && !fw_xml_full(r->diags); i++) {
        const named other = name_of(d, (fw_device_space)row->space, i);
        const char *id = other.id;
        int distance = fw_edit_distance(a->value, id, 2);
        if (distance < least && (size_t)distance < strlen(id)) {
            least = distance;
            better = id;
            there = other.place;
        }
        if (used + strlen(id) + 3 < sizeof list)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? " " : "", id);
    }
    fw_xml_label(record, label);
    if (better && strlen(a->value) > 2)
        fw_diag_error(r->diags, 46, a->place,
                      "%s: there is no %s '%.64s'; did you mean '%s', declared at %d:%d? Make the "
                      "two alike",
                      label, kind, a->value, better, there.line, there.column);
    else
        fw_diag_error(r->diags, 46, a->place, "%s: there is no %s '%.64s'; declared %s: %s", label,
                      kind, a->value, n == 1 ? "is" : "are", n ? list : "none");
}

int fw_device_reference(fw_device_reader *r, const fw_xml_record *record, const char *name) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    if (cell->missing || (cell->given && !cell->ok)) return FW_NOWHERE;
    if (!cell->given) return FW_NONE;
    const fw_xml_attribute_row *row = record->attribute;
    while (strcmp(row->name, name) != 0)
        row++;
    const char *id = cell->given->value;
    if (strcmp(id, "ground") == 0 && row->space == FW_SPACE_BODY) {
        if (row->ground) return FW_GROUND;
        char label[FW_LABEL];
        fw_diag_error(r->diags, 46, cell->given->place,
                      "%s: the ground is fixed and cannot be "
                      "used here; name a body",
                      fw_xml_label(record, label));
        return FW_NOWHERE;
    }
    if (!enter(r, (fw_device_space)row->space)) {
        r->diags->failed = 1; /* memory is short: every step ends with asking for this */
        return FW_NOWHERE;
    }
    int found = *slot_of(r->device, (fw_device_space)row->space, &r->index[row->space], id);
    if (found) return found - 1;
    if (!r->xml.broken[row->space]) report_dangling(r, record, row, cell->given);
    return FW_NOWHERE;
}
