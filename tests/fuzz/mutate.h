/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes that leave a file what it is: XML by the tables of its rows, records of GDSII, pairs of DXF, words of lines. */
#ifndef FW_TESTS_FUZZ_MUTATE_H
#define FW_TESTS_FUZZ_MUTATE_H
#include "xml/xml_reader.h"
#include <stddef.h>
#include <stdint.h>

/* what is changed: n bytes at data, of which there is room for `room` */
typedef struct fuzz_text {
    char *data;
    size_t n, room;
} fuzz_text;

extern uint64_t fuzz_seed; /* of all that is drawn; xorshift64 (Marsaglia 2003) */
size_t fuzz_below(size_t n);

/* table NULL: values and elements of the text itself */
void fuzz_mutate_xml(fuzz_text *text, const fw_xml_table *table);
void fuzz_mutate_number(fuzz_text *text);
void fuzz_mutate_gds(fuzz_text *text);
void fuzz_smaller_arrays(fuzz_text *text);
void fuzz_mutate_lines(fuzz_text *text); /* of DXF, logs, tables, layer maps, requests */
void fuzz_mutate_bytes(fuzz_text *text);

#endif
