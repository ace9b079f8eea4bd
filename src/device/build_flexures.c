/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <flexure>: what all kinds have, and which kind it is (flexures.def). */
#include "device/flexure_kind.h"
#include <string.h>

#define FW_DEVICE_FLEXURE(name, sentence)                                                          \
    extern const fw_device_flexure_row fw_device_flexure_##name;
#include "device/flexures.def"
#undef FW_DEVICE_FLEXURE
#define FW_DEVICE_FLEXURE(name, sentence) &fw_device_flexure_##name,
static const fw_device_flexure_row *const kinds[] = {
#include "device/flexures.def"
};
#undef FW_DEVICE_FLEXURE
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* ---- what a kind has no use for ---- */

static void refuse_pieces(fw_device_reader *r, int at, const char *kind) {
    char label[FW_LABEL];
    for (int i = at + 1; i < r->xml.nrecord && r->xml.record[i].parent >= at; i++)
        if (r->xml.record[i].parent == at)
            fw_diag_error(r->diags, 262, r->xml.record[i].element->place,
                          "%s: a %s has no pieces of its own; remove <%s>, or write kind=\"path\"",
                          fw_xml_label(&r->xml.record[at], label), kind,
                          r->xml.record[i].row->name);
}

static bool takes(const fw_device_flexure_row *kind, const char *name) {
    for (const char *const *own = kind->takes; *own; own++)
        if (strcmp(*own, name) == 0) return true;
    return false;
}

static void refuse_attributes(fw_device_reader *r, const fw_xml_record *record,
                              const fw_device_flexure_row *kind) {
    static const char *const name[] = {"length", "radius", "angle", "width-middle"};
    char label[FW_LABEL];
    for (int i = 0; i < 4; i++) {
        if (!fw_xml_given(record, name[i]) || takes(kind, name[i])) continue;
        fw_place place = fw_xml_place_of(record, name[i]);
        if (kind->refused.number)
            fw_diag_error(r->diags, kind->refused.number, place, "%s: %s%s%s",
                          fw_xml_label(record, label), kind->refused.before, name[i],
                          kind->refused.after);
        else
            fw_diag_error(r->diags, 58, place, "%s: a %s has no %s; remove it",
                          fw_xml_label(record, label), kind->name, name[i]);
    }
}

/* ---- the whole ---- */

static const fw_device_flexure_row *kind_of(const fw_xml_record *record) {
    const char *name = fw_xml_text_of(record, "kind");
    for (int i = 0; name && i < KINDS; i++)
        if (strcmp(kinds[i]->name, name) == 0) return kinds[i];
    return NULL;
}

static fw_status flexure_of(fw_device_reader *r, int at, fw_device_flexure *f) {
    const fw_xml_record *record = &r->xml.record[at];
    const fw_device_flexure_row *kind = kind_of(record);
    bool length = fw_xml_given(record, "length");
    *f = (fw_device_flexure){.id = fw_xml_text_of(record, "id"),
                             .length_m = fw_xml_number_of(record, "length"),
                             .angle_rad = fw_xml_number_of(record, "angle"),
                             .radius_m = fw_xml_number_of(record, "radius"),
                             .width_m = fw_xml_number_of(record, "width"),
                             .width_middle_m = fw_xml_number_or(record, "width-middle", 0.0),
                             .gap_m = fw_xml_number_or(record, "gap", 0.0),
                             .fillet_m = fw_xml_number_of(record, "fillet"),
                             .fillet_place = fw_xml_place_of(record, "fillet"),
                             .length_given = length,
                             .radius_given = fw_xml_given(record, "radius"),
                             .place = record->element->place,
                             .length_place = fw_xml_place_of(record, length ? "length" : "radius")};
    if (!kind) return FW_OK; /* reported */
    if (!kind->pieces) refuse_pieces(r, at, kind->name);
    refuse_attributes(r, record, kind);
    return kind->build(r, at, f);
}

fw_status fw_device_build_flexures(fw_device_reader *r) {
    fw_device *d = r->device;
    FW_NEED(d->flexure = fw_arena_array(r->arena, fw_device_flexure,
                                        (size_t)fw_xml_count(&r->xml, "flexure")));
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "flexure"))
            FW_TRY(flexure_of(r, i, &d->flexure[d->nflexure++]));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
