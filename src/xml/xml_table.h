/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What may stand in a file, as a table: one row per element, in it one row per attribute. Reading
   with all its complaints, reference pages and schemas come from these rows; rooms above declare
   theirs (device/table_*.c, process/process_table.c, mask/mask_table.c) and build structs of what
   was read. */
#ifndef FW_XML_XML_TABLE_H
#define FW_XML_XML_TABLE_H
#include "quantity/quantity.h"

typedef enum fw_xml_kind {
    FW_KIND_TEXT,
    FW_KIND_ID,      /* [A-Za-z_][A-Za-z0-9_-]*, at most 64 */
    FW_KIND_NAME,    /* of a parameter: as an id without '-' */
    FW_KIND_WORD,    /* one of `words` */
    FW_KIND_WORDS,   /* some of `words`, with blanks between */
    FW_KIND_FORM,    /* text that `form` accepts */
    FW_KIND_DECIMAL, /* digits alone: the unit is stated elsewhere, or there is none */
    FW_KIND_NUMBER,  /* expression of `dimension` */
    FW_KIND_ANY,     /* expression of any dimension */
    FW_KIND_TIMED,   /* expression in time of `dimension`; read when what it drives is known */
    FW_KIND_TABLE,   /* "TIME: NUMBER; TIME: NUMBER ..." */
    FW_KIND_REF      /* id in `space` */
} fw_xml_kind;

typedef struct fw_xml_attribute_row {
    const char *name;
    fw_xml_kind kind;
    bool required;
    fw_quantity_dimension dimension;
    const char *unit;         /* in messages and on the reference page */
    bool ranged, open;        /* open: the lower bound itself is excluded */
    bool whole;               /* a whole number */
    bool difference;          /* of temperatures: not counted from the zero of a scale */
    double min, max;          /* SI */
    const char *reason;       /* where the range comes from; of a form: what it must look like */
    const char *fallback;     /* what holds when it is absent, for the page; NULL: nothing */
    const char *const *words; /* NULL-terminated */
    bool (*form)(const char *text);
    const char *datatype; /* of a text or an id, for the schema alone: a type of XML Schema */
    int space;            /* of a reference; a table numbers its spaces from 1 */
    bool ground;          /* a reference may be "ground" */
    const char *sentence;
} fw_xml_attribute_row;

struct fw_xml_reader;
struct fw_xml_element;

typedef struct fw_xml_element_row {
    const char *name, *parent; /* parent "" for the root; several with blanks between */
    const char *key;           /* the attribute that names it in --set, or NULL */
    int space;                 /* where the key must be unique; 0: nowhere */
    bool within;               /* ... among those of its parent only */
    bool once;                 /* at most one in its parent */
    bool needed;               /* at least one in its parent */
    bool text;                 /* may hold text */
    bool apart; /* its attributes are read by a function of its own, as those of <q> are */
    int most;   /* of them in a file; 0: no limit of its own */
    const fw_xml_attribute_row *attribute; /* (nattribute) its own */
    int nattribute;
    bool timed; /* it goes with time: behind its own it has the attributes of all laws
                   (quantity/laws.def) */
    const char *sentence;
    const struct fw_xml_numbers *numbers; /* NULL: those of the table */
    /* which attributes there are may depend on the element itself: *row is then a row made for it,
       or NULL where that was reported; the function NULL: this row */
    fw_status (*specialise)(struct fw_xml_reader *r, const struct fw_xml_element *e,
                            const struct fw_xml_element_row **row);
} fw_xml_element_row;

typedef struct fw_xml_attributes {    /* all that an element may have */
    const fw_xml_attribute_row *item; /* (count) */
    int count;
} fw_xml_attributes;

/* The number of the diagnostic (base/diagnostics.def) for each class of mistake. Which class a
   mistake belongs to, its place and its words are the same in every file. */
typedef struct fw_xml_numbers {
    int root;               /* the file begins with something else */
    int element, misplaced; /* an unknown one, a known one that does not belong there */
    int once, most, needed; /* one too many in its parent, in the file; none where one must be */
    int attribute, missing; /* an unknown one, none where one must be */
    bool at_value;          /* an unknown attribute is shown at its value, not at its name */
    int text;               /* text where none belongs */
    int word, form, name, range, whole, decimal; /* values */
    int expression; /* shown at the start of the value; 0: its own number at its own column */
    int twice;      /* an id is given again */
} fw_xml_numbers;

typedef struct fw_xml_table {
    const char *file;                      /* what such a file is: "device file" */
    const char *root, *urn;                /* first element and its namespace */
    const char *head;                      /* its other attributes, for messages: "name=\"...\"" */
    const char *source;                    /* where the rows stand, for the head of the schema */
    const fw_xml_element_row *const *part; /* NULL-terminated; each ends with a row without name */
    const char *const *space;              /* (nspace) what the ids of a space name: "flexure" */
    int nspace;
    int names; /* the space of names that expressions may use; 0: none */
    fw_xml_numbers numbers;
} fw_xml_table;

enum {
    FW_ELEMENTS_MOST = 64,   /* rows of a table */
    FW_ATTRIBUTES_MOST = 32, /* of an element */
    FW_XML_SPACES_MOST = 16
};

const fw_xml_element_row *fw_xml_row_at(const fw_xml_table *table,
                                        int i);                    /* NULL behind the last */
int fw_xml_row_index(const fw_xml_table *table, const char *name); /* or -1 */
const fw_xml_element_row *fw_xml_row_find(const fw_xml_table *table,
                                          const char *name);               /* or NULL */
bool fw_xml_row_inside(const fw_xml_element_row *row, const char *parent); /* may it stand there? */
/* Elements of one name that stand in different parents have a row each: the one that may stand in
   this parent, else the first of that name; -1, NULL: there is none */
int fw_xml_row_index_in(const fw_xml_table *table, const char *name, const char *parent);
const fw_xml_element_row *fw_xml_row_in(const fw_xml_table *table, const char *name,
                                        const char *parent);
/* xml_quantity.c: of the element's row, those of laws included; in the arena where there are
   such */
fw_status fw_xml_attributes_of(fw_arena *arena, const fw_xml_element_row *row,
                               fw_xml_attributes *all);
/* `law` and the attributes of all laws, each once */
fw_status fw_xml_law_attributes(fw_arena *arena, fw_xml_attributes *all);

/* generated from the rows: a RELAX NG schema, a list of elements in JSON (part of
   flexwright.table/1), and for the reference page the cells of one attribute */
fw_status fw_xml_schema(const fw_xml_table *table, fw_text *out);
fw_status fw_xml_table_json(const fw_xml_table *table, fw_text *out);
#define FW_XML_PAGE_HEAD "\n| attribute | value | when absent | meaning |\n|---|---|---|---|\n"
void fw_xml_page_attribute(const fw_xml_table *table, const fw_xml_attribute_row *row,
                           fw_text *out);
/* heading, sentence and where it stands, before its attributes */
void fw_xml_page_element(const fw_xml_element_row *row, fw_text *out);

#endif
