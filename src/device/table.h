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
                        FW_SPACE_TENDON,
                        FW_SPACE_COMB,
                        FW_SPACE_CONTACT,
                        FW_SPACE_COUNT
} fw_space;

typedef struct fw_attribute_row {
    const char *name;
    fw_kind kind;
    bool required;
    fw_dimension dimension;
    const char *unit;         /* in messages and on the reference page */
    bool ranged, open;        /* open: the lower bound itself is excluded */
    bool whole;               /* a whole number */
    bool difference;          /* of temperatures: not counted from the zero of a scale */
    double min, max;          /* SI */
    const char *reason;       /* where the range comes from */
    const char *fallback;     /* what holds when it is absent, for the page; NULL: nothing */
    const char *const *words; /* NULL-terminated */
    fw_space space;
    bool ground; /* a reference may be "ground" */
    const char *sentence;
} fw_attribute_row;

typedef struct fw_element_row {
    const char *name, *parent;         /* parent "" for the root */
    const char *key;                   /* the attribute that names it in --set, or NULL */
    fw_space space;                    /* where the key must be unique */
    bool within;                       /* ... among those of its parent only */
    bool once;                         /* at most one in its parent */
    int most;                          /* of them in a file; 0: no limit of its own */
    const fw_attribute_row *attribute; /* (nattribute) its own */
    int nattribute;
    bool timed; /* it goes with time: behind its own it has the attributes of all laws
                   (quantity/laws.def) */
    const char *sentence;
} fw_element_row;

typedef struct fw_device_attributes { /* all that an element may have */
    const fw_attribute_row *item;     /* (count) */
    int count;
} fw_device_attributes;

/* a new element is one row in one of the parts, table_*.c */
extern const fw_element_row fw_table_device[], fw_table_mechanism[], fw_table_scene[],
    fw_table_effects[];
extern const int fw_table_device_count, fw_table_mechanism_count, fw_table_scene_count,
    fw_table_effects_count;
enum { FW_ELEMENTS_MOST = 64, FW_ATTRIBUTES_MOST = 32 };     /* in the table; of an element */
const fw_element_row *fw_element_row_at(int i);              /* NULL behind the last */
int fw_element_index(const char *name);                      /* or -1 */
const fw_element_row *fw_element_row_find(const char *name); /* or NULL */
/* law_attributes.c: of the element's row, those of laws included; in the arena where there are
 * such. FW_NOMEM */
fw_status fw_device_attributes_of(fw_arena *arena, const fw_element_row *row,
                                  fw_device_attributes *all);
/* `law` and the attributes of all laws, each once */
fw_status fw_device_law_attributes(fw_arena *arena, fw_device_attributes *all);
const char *fw_space_text(fw_space space); /* "flexure" */
bool fw_kind_is_expression(fw_kind kind);

#endif
