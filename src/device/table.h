/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of elements and attributes: validation, the reference page and the schema come from
   it. Private to device/. */
#ifndef FW_DEVICE_TABLE_H
#define FW_DEVICE_TABLE_H
#include "quantity/quantity.h"

typedef enum fw_kind {
    FW_KIND_TEXT,
    FW_KIND_ID,     /* [A-Za-z_][A-Za-z0-9_-]*, at most 64 */
    FW_KIND_NAME,   /* of a parameter: as an id without '-' */
    FW_KIND_WORD,   /* one of `words` */
    FW_KIND_NUMBER, /* expression of `dimension` */
    FW_KIND_ANY,    /* expression of any dimension */
    FW_KIND_TIMED,  /* expression in time of `dimension`; read when what it drives is known */
    FW_KIND_TABLE,  /* "TIME: NUMBER; TIME: NUMBER ..." */
    FW_KIND_REF     /* id in `space` */
} fw_kind;

typedef enum fw_space { /* ids are unique within one of these */
                        FW_SPACE_NONE,
                        FW_SPACE_PARAMETER,
                        FW_SPACE_FLOW,
                        FW_SPACE_FLEXURE,
                        FW_SPACE_BODY,
                        FW_SPACE_JOINT,
                        FW_SPACE_SPRING,
                        FW_SPACE_DRIVER,
                        FW_SPACE_SCENE,
                        FW_SPACE_COUNT
} fw_space;

typedef struct fw_attribute_row {
    const char *name;
    fw_kind kind;
    bool required;
    fw_dimension dimension;
    const char *unit;     /* in messages and on the reference page */
    bool ranged, open;    /* open: the lower bound itself is excluded */
    double min, max;      /* SI */
    const char *reason;   /* where the range comes from */
    const char *fallback; /* what holds when it is absent, for the page; NULL: nothing */
    const char *const *words, *const *later; /* NULL-terminated; later: not in this version */
    fw_space space;
    bool ground; /* a reference may be "ground" */
    const char *sentence;
} fw_attribute_row;

typedef struct fw_element_row {
    const char *name, *parent;         /* parent "" for the root */
    const char *key;                   /* the attribute that names it in --set, or NULL */
    fw_space space;                    /* where the key must be unique */
    bool once;                         /* at most one in its parent */
    bool later;                        /* not in this version */
    int most;                          /* of them in a file; 0: no limit of its own */
    const fw_attribute_row *attribute; /* (nattribute) */
    int nattribute;
    const char *sentence;
} fw_element_row;

const fw_element_row *fw_device_table(int *count);
const fw_element_row *fw_element_row_find(const char *name); /* or NULL */
const char *fw_space_text(fw_space space);                   /* "flexure" */
bool fw_kind_is_expression(fw_kind kind);

#endif
