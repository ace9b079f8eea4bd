/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file between its tree and its description: one record per element, one cell per attribute of
   the table. A cell that failed has been reported; whoever needs it keeps silent.

   The steps, in their order: fw_xml_read (xml.h) gives the tree, fw_xml_records_read says what does
   not belong and what is missing, fw_xml_words_read reads ids, names and words, fw_xml_ids_check
   says which ids are given twice, fw_xml_numbers_read reads the numbers. fw_xml_table_read does all
   of it for files whose expressions know no names. */
#ifndef FW_XML_XML_READER_H
#define FW_XML_XML_READER_H
#include "quantity/quantity.h"
#include "xml/xml_table.h"
#include "xml/xml.h"

typedef struct fw_xml_cell {
    const fw_xml_attribute *given; /* NULL: absent */
    bool ok;                       /* read, evaluated, in range */
    bool missing;                  /* required and absent, or misspelt: reported */
    double number;                 /* SI */
} fw_xml_cell;

typedef struct fw_xml_record {
    fw_xml_element *element;
    const fw_xml_element_row *row;
    const fw_xml_attribute_row *attribute; /* (nattribute) of the row, those of laws included */
    int nattribute;
    fw_xml_cell *cell;                              /* (nattribute) */
    int parent;                                     /* index, -1 for the root */
    const struct fw_xml_record *first_child, *next; /* in file order; set when all are read */
} fw_xml_record;

typedef struct fw_xml_reader {
    fw_arena *arena;
    fw_diags *diags;
    const fw_xml_table *table;
    fw_xml_element *root;
    fw_xml_record *record; /* (nrecord) in file order */
    int nrecord, capacity;
    fw_quantity_names names; /* with a value, for expressions */
    const char **lost;       /* (nlost) names that have no value: what uses them keeps silent */
    size_t nlost;
    const char **celsius; /* (ncelsius) names whose value counts from the zero of degrees Celsius */
    size_t ncelsius;
    bool broken[FW_XML_SPACES_MOST]; /* an id of this space could not be read: do not miss it again
                                      */
    fw_xml_attributes timed[FW_ELEMENTS_MOST]; /* per row of the table; item NULL: not met yet */
    bool unknown_element;                      /* something is there that could not be read */
} fw_xml_reader;

fw_status fw_xml_records_read(fw_xml_reader *r);
fw_status fw_xml_words_read(fw_xml_reader *r); /* all but numbers */
fw_status fw_xml_ids_check(fw_xml_reader *r);
fw_status fw_xml_numbers_read(fw_xml_reader *r);
/* FW_OK although there were mistakes; FW_INPUT when there is no record to go on with */
fw_status fw_xml_table_read(fw_arena *arena, const fw_xml_table *table, const char *file,
                            const char *xml, size_t n, fw_diags *diags, fw_xml_reader *r);

/* values of a record; names must be in the table */
const fw_xml_cell *fw_xml_cell_of(const fw_xml_record *record, const char *name);
bool fw_xml_given(const fw_xml_record *record, const char *name); /* or meant to be */
bool fw_xml_failed(const fw_xml_record *record,
                   const char *name); /* given or required, without a value */
double fw_xml_number_of(const fw_xml_record *record,
                        const char *name); /* NaN when absent or failed */
double fw_xml_number_or(const fw_xml_record *record, const char *name,
                        double absent); /* NaN when failed */
const char *fw_xml_text_of(const fw_xml_record *record,
                           const char *name); /* NULL when absent or failed */
fw_place fw_xml_place_of(const fw_xml_record *record,
                         const char *name); /* the element's when absent */

enum { FW_LABEL = 128 };
const char *fw_xml_label(const fw_xml_record *record, char buffer[FW_LABEL]); /* flexure 'A' */
/* "12 um" in the unit of messages */
const char *fw_xml_in_unit(char buffer[FW_LABEL], double value, const char *unit);
bool fw_xml_is(const fw_xml_record *record, const char *element);
int fw_xml_count(const fw_xml_reader *r, const char *element);
int fw_xml_children(const fw_xml_record *record, const char *element);
/* is the report full? then looking for suggestions is no use */
bool fw_xml_full(const fw_diags *diags);
const fw_xml_numbers *fw_xml_numbers_of(const fw_xml_reader *r, const fw_xml_element_row *row);

/* evaluates an attribute; *ok tells, errors are reported (an expression's at its own column).
   wanted NULL: any dimension, which comes back in *found. */
fw_status fw_xml_attribute_evaluate(fw_xml_reader *r, const fw_xml_attribute *a, const char *what,
                                    const fw_quantity_dimension *wanted,
                                    fw_quantity_dimension *found, double *value, bool *ok);
/* what evaluating `part` bytes of an attribute found wrong, at its own column */
fw_status fw_xml_expression_report(fw_xml_reader *r, const fw_xml_attribute *a, const char *what,
                                   size_t part, const fw_quantity_expression_error *error);

#endif
