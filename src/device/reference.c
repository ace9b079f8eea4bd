/* SPDX-License-Identifier: GPL-3.0-or-later */
/* docs/reference/device.md */
#include "base/text.h"
#include "device/reader.h"
#include "quantity/law_kind.h"
#include <string.h>

static void add_number(fw_text *out, double value, const char *unit) {
    char buffer[FW_LABEL];
    fw_text_add(out, fw_in_unit(buffer, value, unit));
}

static void add_value(fw_text *out, const fw_attribute_row *a) {
    switch (a->kind) {
    case FW_KIND_TEXT:
        fw_text_add(out, "text");
        break;
    case FW_KIND_ID:
    case FW_KIND_NAME:
        fw_text_add(out, "name");
        break;
    case FW_KIND_ANY:
        fw_text_add(out, "expression");
        break;
    case FW_KIND_TIMED:
        fw_text_printf(out, "expression in time, %s",
                       strcmp(a->unit, "1") == 0 ? "pure number" : a->unit);
        break;
    case FW_KIND_TABLE:
        fw_text_add(out, "points `TIME: NUMBER; ...`");
        break;
    case FW_KIND_REF:
        fw_text_printf(out, "id of a %s%s", fw_space_text(a->space),
                       a->ground ? " or `ground`" : "");
        break;
    case FW_KIND_WORD:
        for (int i = 0; a->words[i]; i++)
            fw_text_printf(out, "%s`%s`", i ? ", " : "", a->words[i]);
        break;
    case FW_KIND_NUMBER:
        if (strcmp(a->unit, "1") == 0)
            fw_text_add(out, a->whole ? "whole number" : "pure number");
        else
            fw_text_printf(out, "%s, e.g. in `%s`", fw_dimension_text(out->arena, a->dimension),
                           a->unit);
        break;
    }
}

static void add_range(fw_text *out, const fw_attribute_row *a) {
    if (!a->ranged) return;
    fw_text_add(out, a->open ? " Above " : " At least ");
    add_number(out, a->min, a->unit);
    fw_text_add(out, ", at most ");
    add_number(out, a->max, a->unit);
    fw_text_printf(out, " (%s).", a->reason);
}

static void add_attribute(fw_text *out, const fw_attribute_row *a) {
    fw_text_printf(out, "| `%s` | ", a->name);
    add_value(out, a);
    fw_text_printf(out, " | %s | %s",
                   a->required   ? "**required**"
                   : a->fallback ? a->fallback
                                 : "",
                   a->sentence);
    add_range(out, a);
    fw_text_add(out, " |\n");
}

#define TABLE_HEAD "\n| attribute | value | when absent | meaning |\n|---|---|---|---|\n"

/* the laws, and their attributes, which are the same for every element that goes with time */
static fw_status add_laws(fw_text *out) {
    fw_device_attributes all;
    fw_text_add(out, "| law | attributes | factor |\n|---|---|---|\n");
    for (const fw_quantity_law_kind *const *kind = fw_quantity_law_kinds; *kind; kind++) {
        fw_text_printf(out, "| `%s` |", (*kind)->name);
        for (int i = 0; i < (*kind)->attributes; i++) {
            const fw_quantity_law_attribute *a = &(*kind)->attribute[i];
            fw_text_printf(out, a->needed ? "%s **`%s`**" : "%s `%s`", i ? "," : "", a->name);
        }
        fw_text_printf(out, " | %s |\n", (*kind)->factor);
    }
    FW_TRY(fw_device_law_attributes(out->arena, &all));
    fw_text_add(out, TABLE_HEAD);
    for (int i = 0; i < all.count; i++)
        add_attribute(out, &all.item[i]);
    return FW_OK;
}

static void add_element(fw_text *out, const fw_element_row *e) {
    fw_text_printf(out, "\n### `<%s>`\n\n%s", e->name, e->sentence);
    if (e->parent[0])
        fw_text_printf(out, " Inside `<%s>`%s.", e->parent, e->once ? ", at most once" : "");
    fw_text_add(out, "\n");
    if (e->nattribute > 0 || e->timed) fw_text_add(out, TABLE_HEAD);
    for (int i = 0; i < e->nattribute; i++)
        add_attribute(out, &e->attribute[i]);
    if (e->timed)
        fw_text_printf(
            out, "| `law` and its attributes | see [Time](#time) | %s | How it goes with time. |\n",
            fw_quantity_law_kinds[0]->name);
}

static void add_units(fw_text *out) {
    size_t count;
    const char *const *names = fw_unit_names(&count);
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
    const fw_element_row *row;
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
    for (int i = 0; (row = fw_element_row_at(i)) != NULL; i++)
        add_element(out, row);
    add_units(out);
    return fw_text_end(out);
}
