/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading of layer tables: mask_table.c has the rows of <mask-table> and <layer>; those of <rule>
   and <pattern> depend on their kind. Private to the room. */
#ifndef FW_MASK_MASK_TABLE_H
#define FW_MASK_MASK_TABLE_H
#include "mask/mask.h"
#include "xml/xml_reader.h"

#define FW_MASK_ROWS(a) .attribute = (a), .nattribute = sizeof(a) / sizeof((a)[0])
/* text that goes into files of masks, which some readers take in plain ASCII only */
#define FW_MASK_PLAIN                                                                              \
    .kind = FW_KIND_FORM, .form = fw_mask_is_plain,                                                \
    .reason = "plain ASCII of 1 to 400 characters: some mask readers refuse all else"
#define FW_MASK_YES_NO .kind = FW_KIND_WORD, .words = fw_mask_yes_no, .fallback = "no"
#define FW_MASK_LENGTH .kind = FW_KIND_NUMBER, .dimension = {.m = 1}, .unit = "um"

extern const char *const fw_mask_yes_no[];
bool fw_mask_is_plain(const char *text);
bool fw_mask_says(const fw_xml_record *record, const char *name, const char *word);

/* rows for one <rule> or <pattern> by its kind; *row NULL: there is no such kind, which is told */
fw_status fw_mask_rule_row(fw_xml_reader *r, const fw_xml_element *e,
                           const fw_xml_element_row **row);
fw_status fw_mask_pattern_row(fw_xml_reader *r, const fw_xml_element *e,
                              const fw_xml_element_row **row);
extern const fw_xml_numbers fw_mask_rule_numbers, fw_mask_pattern_numbers;

/* what was read, once all layers are known */
fw_status fw_mask_rules_build(fw_xml_reader *r, fw_mask_table *table);
fw_status fw_mask_patterns_build(fw_xml_reader *r, fw_mask_table *table);

#endif
