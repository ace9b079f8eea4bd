/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading a file by a table: what may stand in it, the records of what stood there, and <q>, the number
   that packs are made of. */
#ifndef FW_XML_XML_READER_H
#define FW_XML_XML_READER_H
#include "quantity/quantity.h"
#include "xml/xml.h"

/* ---- the table ----

   What may stand in a file: one row per element, in it one row per attribute. Reading with all its
   complaints, reference pages and schemas come from these rows; rooms above declare theirs
   (device/table_*.c, process/process_table.c, mask/mask_table.c) and build structs of what was
   read. */

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

/* ---- records ----

   A file between its tree and its description: one record per element, one cell per attribute of
   the table. A cell that failed has been reported; whoever needs it keeps silent.

   The steps, in their order: fw_xml_read (xml.h) gives the tree, fw_xml_records_read says what does
   not belong and what is missing, fw_xml_words_read reads ids, names and words, fw_xml_ids_check
   says which ids are given twice, fw_xml_numbers_read reads the numbers. fw_xml_table_read does all
   of it for files whose expressions know no names. */

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
/* a whole number that the table bounds; `otherwise` also when failed, since an int has no NaN */
int fw_xml_whole_or(const fw_xml_record *record, const char *name, int otherwise);
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

/* ---- <q> ----

   An element for one number with unit, uncertainty, status and source. Material and process packs
   share it.

   <q id value unit status src note/> with exactly one of u (standard, in `unit`), urel (relative)
   or lo and hi (uniform between them: u = (hi - lo)/sqrt(12)); or unknown="true" instead of value.
   least and most, both or none, are the range in which a value makes sense at all: what replaces
   this one must lie there too, which catches A for Ao and min for s. range names one of those that
   packs share instead (process/quantity_ranges.def). */

/* what may stand in <q>, for tables (apart) and schemas; fw_xml_quantity_read has the checks */
enum { FW_QUANTITY_ROWS = 17 };
extern const fw_xml_attribute_row fw_xml_quantity_rows[FW_QUANTITY_ROWS];

typedef struct fw_xml_source_text { /* <source id ...>text</source> */
    const char *id, *text, *kind;   /* kind "" or NULL: not said */
} fw_xml_source_text;

/* all <source> children of `parent`, in file order; duplicate or missing ids are errors */
fw_status fw_xml_sources_read(fw_arena *arena, const fw_xml_element *parent, fw_diags *diags,
                              fw_xml_source_text **source, int *nsource);

/* ids of packs: they come into names of files and of cells, into lines of calendars and tables, and into pages */
#define FW_XML_TOKEN "a letter or _ first, then letters, digits, _ - and ., at most 64"
bool fw_xml_is_token(const char *text);

/* false and FW-D278 when the value is outside the plausible range of `range`, which is q itself or
   the one that q replaces */
bool fw_xml_quantity_check_range(const fw_quantity *q, const fw_quantity *range, fw_diags *diags);

/* FW_INPUT when the element is wrong (all its mistakes are in diags); *q is then unknown. `src` is
   resolved among the sources; q->source is the source's text. Attributes that are not named above
   are errors. The value is in SI, degrees Celsius in kelvin. */
fw_status fw_xml_quantity_read(fw_arena *arena, const fw_xml_element *element,
                               const fw_xml_source_text *source, int nsource, fw_diags *diags,
                               fw_quantity *q);

#endif
