/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the text of a device file to its description, step by step; later steps run after mistakes
   of earlier ones, so that one run reports everything. */
#include "base/text.h"
#include "device/device_reader.h"
#include "quantity/law_kind.h"

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
    FW_TRY(fw_device_build_cells(r));
    FW_TRY(fw_device_build_flexures(r));
    FW_TRY(fw_device_expand_six_bar(r));
    FW_TRY(fw_device_build_mechanism(r));
    if (r->diags->errors == errors)
        FW_TRY(fw_device_close_rounded(r)); /* else places may be missing */
    FW_TRY(fw_device_build_scenes(r));
    FW_TRY(fw_device_build_probes(r));
    FW_TRY(fw_device_build_studies(r));
    check_material(r);
    return FW_OK;
}

fw_status fw_device_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                         const fw_device_set *set, int nset, fw_diags *diags,
                         const fw_device **device) {
    return fw_device_read_with(arena, file, xml, n, set, nset, NULL, diags, device);
}

fw_status fw_device_read_with(fw_arena *arena, const char *file, const char *xml, size_t n,
                              const fw_device_set *set, int nset, const fw_device_files *files,
                              fw_diags *diags, const fw_device **device) {
    *device = NULL;
    size_t before = diags->errors;
    fw_device *d = fw_arena_one(arena, fw_device);
    FW_NEED(d);
    fw_device_reader r = {.xml = {.arena = arena, .diags = diags, .table = &fw_device_table},
                          .arena = arena,
                          .diags = diags,
                          .device = d,
                          .files = files};
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
             "degree Celsius, `{sccm}` gas flow (1 cm3 per minute at 273.15 K and 101325 Pa). "
             "For the prefix `u` the sign of micro may stand (U+00B5, or the Greek letter U+03BC)."
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
                "one such element, and steps and numbers say which of several: "
                "`scene[push]/force[2]/@fx`.\n\n"
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
