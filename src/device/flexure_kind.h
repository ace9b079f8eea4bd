/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of <flexure>: a row, in flexure_kind.c or in a file of its own, and a line in flexures.def each.
   What is made of lines and arcs needs no more: as a path (fw_device_flexure_lay) it has its mechanics,
   its outline and its solid. Private to device/. */
#ifndef FW_DEVICE_FLEXURE_KIND_H
#define FW_DEVICE_FLEXURE_KIND_H
#include "device/device_reader.h"

typedef struct fw_device_flexure_row {
    const char *name;
    /* NULL-terminated: those of length, radius, angle and width-middle that it goes by. Any other
       is refused: "<before>NAME<after>", or with number 0 in general words */
    const char *const *takes;
    struct {
        int number; /* of the diagnostic */
        const char *before, *after;
    } refused;
    bool pieces; /* it has <line> and <arc> inside; else they are refused */
    /* from the record `at`; *flexure has what the attributes say. What is wrong is a diagnostic */
    fw_status (*build)(fw_device_reader *r, int at, fw_device_flexure *flexure);
} fw_device_flexure_row;

/* edges of a piece: each must lie on its side of the centre line all along */
bool fw_device_flexure_edges(fw_device_reader *r, const fw_xml_record *record,
                             const fw_geometry_strip_piece *piece);
/* makes the flexure a path of these pieces (n >= 1, kept), whose edges are right: its length, turn
   and least width. One that meets itself is reported */
void fw_device_flexure_lay(fw_device_reader *r, const fw_xml_record *record,
                           const fw_geometry_strip_piece *piece, int n, fw_device_flexure *f);

#endif
