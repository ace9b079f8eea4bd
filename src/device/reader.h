/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A device file between its tree and its description: one record per element, one cell per
   attribute of the table. A cell that failed has been reported; whoever needs it keeps silent.
   Private to device/. */
#ifndef FW_DEVICE_READER_H
#define FW_DEVICE_READER_H
#include "device/device.h"
#include "device/table.h"
#include "device/xml.h"

typedef struct fw_cell {
    const fw_attribute *given; /* NULL: absent */
    bool ok;                   /* read, evaluated, in range */
    bool missing;              /* required and absent, or misspelt: reported */
    double number;             /* SI */
} fw_cell;

typedef struct fw_record {
    fw_element *element;
    const fw_element_row *row;
    const fw_attribute_row *attribute; /* (nattribute) of the row, those of laws included */
    int nattribute;
    fw_cell *cell; /* (nattribute) */
    int parent;    /* index, -1 for the root */
} fw_record;

typedef struct fw_override { /* --set of a parameter: its declared value still gives the dimension
                              */
    const fw_element *element;
    const fw_attribute *attribute;
} fw_override;

typedef struct fw_id_index { /* ids of one space by hash; grows with the description */
    int *slot;               /* (1 << bits) 1 + index, 0: free */
    int bits, entered;
} fw_id_index;

typedef struct fw_reader {
    fw_arena *arena;
    fw_diags *diags;
    const char *file;
    fw_element *root;
    fw_record *record; /* (nrecord) in file order */
    int nrecord;
    fw_override *override_; /* (noverride) */
    int noverride;
    fw_name_value *name; /* parameters with a value */
    fw_names names;
    const char **lost; /* (nlost) names of parameters without a value */
    size_t nlost;
    bool broken[FW_SPACE_COUNT]; /* an id of this space could not be read: do not miss it again */
    bool unknown_element;        /* something is there that could not be read */
    fw_id_index index[FW_SPACE_COUNT];
    fw_device_attributes
        attributes[FW_ELEMENTS_MOST]; /* per row of the table; item NULL: not met yet */
    fw_device *device;
} fw_reader;

/* set.c, records.c, cells.c, parameter.c: the steps in their order */
fw_status fw_sets_apply(fw_reader *r, const fw_set *set, int nset);
fw_status fw_records_read(fw_reader *r);
fw_status fw_words_read(fw_reader *r); /* ids, names, words */
fw_status fw_parameters_read(fw_reader *r);
fw_status fw_cells_read(fw_reader *r); /* numbers */
fw_status fw_ids_check(fw_reader *r);

/* one step per part of the description */
fw_status fw_build_parts(fw_reader *r);
fw_status fw_build_wafer(fw_reader *r); /* <wafer> with its sweeps */
fw_status fw_build_flexures(fw_reader *r);
fw_status fw_expand_six_bar(fw_reader *r); /* bodies 0..4 and joints 0..5 */
fw_status fw_build_mechanism(fw_reader *r);
fw_status fw_build_joints(fw_reader *r);
fw_status fw_build_scenes(fw_reader *r);
/* close.c: poses whose joints are open by what rounded numbers leave (FW-D132) */
fw_status fw_close_rounded(fw_reader *r);

/* values of a record; names must be in the table */
const fw_cell *fw_cell_of(const fw_record *record, const char *name);
bool fw_given(const fw_record *record, const char *name);  /* or meant to be */
bool fw_failed(const fw_record *record, const char *name); /* given or required, without a value */
double fw_number_of(const fw_record *record, const char *name); /* NaN when absent or failed */
double fw_number_or(const fw_record *record, const char *name, double absent); /* NaN when failed */
const char *fw_text_of(const fw_record *record, const char *name); /* NULL when absent or failed */
fw_place fw_place_of(const fw_record *record, const char *name);   /* the element's when absent */

enum { FW_LABEL = 128 };
const char *fw_label(const fw_record *record, char buffer[FW_LABEL]); /* flexure 'A' */
/* "12 um" in the unit of messages */
const char *fw_in_unit(char buffer[FW_LABEL], double value, const char *unit);
int fw_count(const fw_reader *r, const char *element);
bool fw_is(const fw_record *record, const char *element);
/* is the report full? then looking for suggestions is no use */
bool fw_full(const fw_reader *r);
bool fw_id_valid(const char *id, bool hyphen);
/* evaluates an attribute; *ok tells, errors are reported (an expression's at its own column).
   wanted NULL: any dimension, which comes back in *found. */
fw_status fw_attribute_evaluate(fw_reader *r, const fw_attribute *a, const char *what,
                                const fw_dimension *wanted, fw_dimension *found, double *value,
                                bool *ok);
/* what evaluating `part` bytes of an attribute found wrong, at its own column */
fw_status fw_expression_report(fw_reader *r, const fw_attribute *a, const char *what, size_t part,
                               const fw_expression_error *error);
/* time_law.c: the law of a load, NULL for one that is constant from the start or was reported */
fw_status fw_time_law(fw_reader *r, const fw_record *record, const fw_law **law);
/* an attribute as an expression in time; *program NULL when it is absent or was reported */
fw_status fw_time_program(fw_reader *r, const fw_record *record, const char *name,
                          fw_dimension wanted, const fw_program **program);
/* error where the law is not finite at one of some instants of [0, duration_s] */
void fw_finite_check(fw_reader *r, const fw_record *record, const char *name, const fw_law *law,
                     double duration_s);

enum { FW_NOWHERE = -2 };
/* index of what the attribute refers to (joints first, then ties njoint + i), FW_GROUND (==
   FW_NONE) for "ground" or when it is absent, FW_NOWHERE when there is none: that has been reported
 */
int fw_reference(fw_reader *r, const fw_record *record, const char *name);
bool fw_body_drawn(const fw_body *body); /* it has a width or a plate */
/* what is drawn must lie on a wafer */
void fw_wafer_check(fw_reader *r, const fw_record *record, const char *name, double value_m);
/* mass and inertia both or neither, and one of them or a shape */
void fw_mass_check(fw_reader *r, const fw_record *record, bool shape, const char *shape_advice);

#endif
