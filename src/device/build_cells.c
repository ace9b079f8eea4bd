/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <cell>: finished drawings on the die and on the wafer, read, placed and merged for the layers that they go to. */
#include "base/text.h"
#include "device/device_reader.h"
#include "drawing/drawing.h"
#include <math.h>
#include <string.h>

static fw_status misread(fw_device_reader *r, const fw_xml_record *record, const char *what) {
    return fw_diag_error(r->diags, 568, fw_xml_place_of(record, "layers"),
                         "<cell>: layers=\"%.64s\" %s; write it as in \"1/0>mask; 2/0>text\"",
                         fw_xml_text_of(record, "layers"), what);
}

/* a part of the text without the blanks around it */
static const char *part_of(fw_arena *arena, const char *at, size_t n) {
    while (n > 0 && *at == ' ')
        at++, n--;
    while (n > 0 && at[n - 1] == ' ')
        n--;
    return fw_arena_strndup(arena, at, n);
}

/* "1/0>mask; 2/0>text" */
static fw_status read_maps(fw_device_reader *r, const fw_xml_record *record, fw_drawing_map *map,
                           int *n) {
    const char *at = fw_xml_text_of(record, "layers");
    *n = 0;
    if (!at) return FW_OK;
    for (bool more = true; more;) {
        size_t length = strcspn(at, ";,"), from = strcspn(at, ">");
        const char *own = part_of(r->arena, at, length);
        FW_NEED(own);
        if (*own == '\0' && at[length] == '\0' && *n > 0) break; /* a last semicolon */
        if (from >= length) return misread(r, record, "has a part without '>'");
        if (*n == FW_DRAWING_MAPS_MOST) return misread(r, record, "has more than 32 parts");
        fw_drawing_map *m = &map[(*n)++];
        FW_NEED(m->from = part_of(r->arena, at, from));
        FW_NEED(m->to = part_of(r->arena, at + from + 1, length - from - 1));
        if (!*m->from || !*m->to || strchr(m->to, '>'))
            return misread(r, record, "lacks a layer on a side of '>'");
        more = at[length] != '\0';
        at += length + more;
    }
    return FW_OK;
}

static bool any_failed(const fw_xml_record *record) {
    for (int i = 0; i < record->nattribute; i++)
        if ((record->cell[i].given || record->cell[i].missing) && !record->cell[i].ok) return true;
    return false;
}

static bool says_yes(const fw_xml_record *record, const char *name) {
    const char *word = fw_xml_text_of(record, name);
    return word && strcmp(word, "yes") == 0;
}

static fw_drawing_cell_asked asked_by(const fw_xml_record *record) {
    const char *unit = fw_xml_text_of(record, "unit");
    return (fw_drawing_cell_asked){.file = fw_xml_text_of(record, "file"),
                                   .cell = fw_xml_text_of(record, "cell"),
                                   .unit = unit,
                                   .unit_m = fw_device_drawing_unit_m(unit),
                                   .usual = "mask",
                                   .pose = {fw_xml_number_or(record, "x", 0),
                                            fw_xml_number_or(record, "y", 0),
                                            fw_xml_number_or(record, "angle", 0)},
                                   .mirrored = says_yes(record, "mirror"),
                                   .place = fw_xml_place_of(record, "file"),
                                   .cell_place = fw_xml_place_of(record, "cell"),
                                   .unit_place = fw_xml_place_of(record, "unit"),
                                   .layers_place = fw_xml_place_of(record, "layers")};
}

static fw_status keep(fw_device_reader *r, const fw_xml_record *record,
                      const fw_drawing_cell *drawing, fw_device_cell *cell) {
    const char *id = fw_xml_text_of(record, "id"), *file = fw_xml_text_of(record, "file");
    *cell = (fw_device_cell){.file = file,
                             .name = id              ? id
                                     : drawing->name ? drawing->name
                                                     : file,
                             .biased = says_yes(record, "bias"),
                             .nlayer = drawing->nlayer,
                             .place = record->element->place,
                             .layers_place = fw_xml_given(record, "layers")
                                                 ? fw_xml_place_of(record, "layers")
                                                 : record->element->place};
    FW_NEED(cell->layer = fw_arena_array(r->arena, fw_device_cell_layer, (size_t)drawing->nlayer));
    for (int i = 0; i < drawing->nlayer; i++)
        cell->layer[i] = (fw_device_cell_layer){
            .to = drawing->layer[i].to, .drawn = &drawing->layer[i], .role = FW_CELL_ROLE_OPEN};
    return FW_OK;
}

/* *read: false where something was reported */
static fw_status read_cell(fw_device_reader *r, const fw_xml_record *record, fw_device_cell *cell,
                           bool *read) {
    fw_drawing_map map[FW_DRAWING_MAPS_MOST] = {0};
    fw_drawing_cell_asked asked = asked_by(record);
    fw_drawing_cell drawing;
    const char *data;
    size_t n;
    *read = false;
    if (any_failed(record) || !asked.file) return FW_OK; /* reported */
    asked.map = map;
    fw_status status = read_maps(r, record, map, &asked.nmap);
    if (status == FW_OK) status = fw_device_drawing_open(r, record, &data, &n);
    if (status == FW_OK)
        status = fw_drawing_cell_read(r->arena, data, n, &asked, r->diags, &drawing);
    if (status == FW_INPUT || status == FW_IO || status == FW_LIMIT) return FW_OK; /* reported */
    FW_TRY(status);
    *read = true;
    return keep(r, record, &drawing, cell);
}

/* of the die, or of the wafer */
static fw_status build(fw_device_reader *r, const char *parent, const fw_device_cell **out,
                       int *count) {
    fw_device_cell *cell;
    int n = 0;
    for (int i = 0; i < r->xml.nrecord; i++)
        n += fw_xml_is(&r->xml.record[i], "cell");
    if (n == 0) return FW_OK;
    FW_NEED(cell = fw_arena_array(r->arena, fw_device_cell, (size_t)n));
    for (int i = 0; i < r->xml.nrecord; i++) {
        const fw_xml_record *record = &r->xml.record[i];
        bool read = false;
        if (!fw_xml_is(record, "cell") || record->parent < 0 ||
            !fw_xml_is(&r->xml.record[record->parent], parent))
            continue;
        FW_TRY(read_cell(r, record, &cell[*count], &read));
        *count += read;
    }
    *out = cell;
    return FW_OK;
}

fw_status fw_device_build_cells(fw_device_reader *r) {
    FW_TRY(build(r, "device", &r->device->cell, &r->device->ncell));
    FW_TRY(build(r, "wafer", &r->device->wafer.cell, &r->device->wafer.ncell));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
