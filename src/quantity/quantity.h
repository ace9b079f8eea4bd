/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers with unit, uncertainty, status and source. Inside, all values are SI. */
#ifndef FW_QUANTITY_QUANTITY_H
#define FW_QUANTITY_QUANTITY_H
#include "base/arena.h"
#include "base/diag.h"
#include "base/status.h"
#include <stdbool.h>
#include <stdint.h>

/* exponents of m, kg, s, A, K, mol, rad and money. The angle is kept apart so that "5 deg" is not "0.0873" by
   accident; where a formula multiplies by an angle the table says so (N m/rad). All currencies are one
   dimension and nothing knows their rates: who adds prices asks fw_quantity_unit_currency. */
typedef struct fw_quantity_dimension {
    int8_t m, kg, s, A, K, mol, rad, money;
} fw_quantity_dimension;

bool fw_quantity_dimension_equal(fw_quantity_dimension a, fw_quantity_dimension b);
/* "m s^-1"; or the name of a known one: "length", "torsional stiffness" */
const char *fw_quantity_dimension_text(fw_arena *arena, fw_quantity_dimension d);
/* its unit in SI, which fw_quantity_unit_parse takes: "N", "N m/rad", "kg m^2"; "": of a pure number; NULL: no memory */
const char *fw_quantity_dimension_si(fw_arena *arena, fw_quantity_dimension d);

/* one row of the unit table: "um", "mA/cm2" is composed of rows. `offset` for Cel only. */
typedef struct fw_quantity_unit {
    double factor; /* value_SI = value * factor + offset */
    double offset;
    fw_quantity_dimension dimension;
} fw_quantity_unit;

/* parses a unit expression: products by space, "." or "*", "/", integer exponents behind the symbol
   (cm2, s-1, um^2), e.g. "N m/rad", "mA/cm2", "Ao/s", "g/cm3", "{sccm}", "1". false when unknown;
   *wrong (may be NULL) then points at the offending symbol inside text, *wrong_n its length. */
bool fw_quantity_unit_parse(const char *text, size_t n, fw_quantity_unit *unit, const char **wrong,
                            size_t *wrong_n);
/* value in the unit -> SI and back. A factor such as 1e-6 divides by 1e6, so that "10 um" is the
   very number 10e-6. */
double fw_quantity_unit_to_si(const fw_quantity_unit *unit, double value);
double fw_quantity_unit_from_si(const fw_quantity_unit *unit, double value);
/* the currency of a price, "EUR" of "EUR/L"; NULL: there is none in it */
const char *fw_quantity_unit_currency(const char *text);
/* all unit symbols, for "did you mean" and the reference page */
const char *const *fw_quantity_unit_names(size_t *count);
/* "did you mean 'um'?" for a misspelt unit, or NULL. Of several that are equally near the one with
   the same first letter wins (a prefix is a factor of 1000), then `usual`, the unit of the place
   (may be NULL). */
const char *fw_quantity_unit_suggestion(const char *symbol, size_t n, const char *usual);

typedef enum fw_quantity_value_status { /* from best to worst; a result inherits the worst of its
                                           inputs */
                                        FW_MEASURED,
                                        FW_STATED,
                                        FW_DERIVED,
                                        FW_TYPICAL,
                                        FW_ASSUMED
} fw_quantity_value_status;
const char *fw_quantity_value_status_text(fw_quantity_value_status status);
bool fw_quantity_value_status_parse(const char *text, fw_quantity_value_status *status);

typedef struct fw_quantity_correlated { /* what a quantity was fitted together with */
    const char *id;
    double correlation; /* -1 to 1 */
} fw_quantity_correlated;

typedef struct fw_quantity {
    const char *id;   /* may be NULL */
    bool unknown;     /* no value: whatever needs it is NOT COMPUTABLE */
    const char *word; /* of what is no number (which resist): its name, and value is 0; else NULL */
    double value;     /* SI */
    double uncertainty; /* standard, absolute, SI; >= 0 */
    bool interval;      /* the uncertainty was given as a range: low to high, SI */
    double low, high;
    bool spread_taken;  /* some of the uncertainty is how wafers are taken to differ, not read: */
    double spread;      /* so much, standard, SI; 0: nothing says it */
    double least, most; /* plausible range, SI; both 0: none was given */
    const char *range;  /* name of a plausible range of packs; NULL: that of its dimension */
    bool replaced;      /* by a laboratory: `place` is in its file */
    fw_quantity_dimension dimension;
    const char *unit; /* as written, for printing */
    fw_quantity_value_status status;
    fw_quantity_value_status u_status;        /* of the uncertainty, which may be somebody else's */
    const char *source;                       /* text of the source */
    const char *note;                         /* may be NULL */
    const fw_quantity_correlated *correlated; /* (ncorrelated) all others are independent of it */
    int ncorrelated;
    fw_place place;
} fw_quantity;

/* of the errors of two different quantities, -1 to 1; 0 where nothing is known of it */
double fw_quantity_correlation(const fw_quantity *a, const fw_quantity *b);

/* it is named and not measured: known by a word, or unknown and of the range "word" */
bool fw_quantity_is_word(const fw_quantity *q);
/* value in its own unit, e.g. 9 for 9e-6 m in "um" */
double fw_quantity_in_unit(const fw_quantity *q);

/* ---- days, of sources and of calendars ---- */

/* "2026-11-23", whatever follows: days since 1970-01-01, negative before. false: no date of the
   years 1 to 9999 */
bool fw_quantity_date_parse(const char *text, long *day);
/* year, month and day of the month of a day since 1970-01-01 */
void fw_quantity_civil(long day, long civil[3]);

/* ---- expressions ----

   Arithmetic with units, dimension-checked: "2*t + 5 um", "1.711e-6 N m/rad", "sqrt(a^2+b^2)".

   Grammar: sum of products of powers; numbers may be followed by a unit ("5 um", "20 mA/cm2"); a
   unit binds tighter than * and /. Names are parameters. Functions: sqrt exp ln sin cos tan asin
   acos atan atan2 min max abs. `pi` is known. `t` may be a variable (time laws). */

typedef struct fw_quantity_name_value {
    const char *name;
    double value; /* SI */
    fw_quantity_dimension dimension;
} fw_quantity_name_value;

typedef struct fw_quantity_names {
    const fw_quantity_name_value *item;
    size_t count;
} fw_quantity_names;

typedef struct fw_quantity_expression_error {
    size_t offset;       /* byte offset into the text where it went wrong */
    int number;          /* diagnostic number 020-039 */
    const char *message; /* complete sentence with what to do */
} fw_quantity_expression_error;

/* evaluates `text` (n bytes). FW_OK, FW_INPUT with *error filled, or FW_NOMEM.
   A bare number where `wanted` has a dimension is an error that suggests the unit. */
fw_status fw_quantity_expression_evaluate(fw_arena *arena, const char *text, size_t n,
                                          const fw_quantity_names *names,
                                          fw_quantity_dimension wanted, double *value,
                                          fw_quantity_expression_error *error);

/* the same where any dimension will do (parameters): the dimension found comes back */
fw_status fw_quantity_expression_evaluate_any(fw_arena *arena, const char *text, size_t n,
                                              const fw_quantity_names *names, double *value,
                                              fw_quantity_dimension *dimension,
                                              fw_quantity_expression_error *error);
/* the first unit written in the text that has this dimension, "" when there is none */
fw_status fw_quantity_expression_unit(fw_arena *arena, const char *text, size_t n,
                                      fw_quantity_dimension dimension, const char **unit);
/* could a parameter not have this name: it is a unit symbol, a function or pi */
bool fw_quantity_expression_reserved(const char *name);

/* does the text use one of these names? (to keep one mistake from being reported again) */
bool fw_quantity_expression_uses(const char *text, size_t n, const char *const *names,
                                 size_t count);

/* names used in the text, in order of appearance, without duplicates (for parameter ordering) */
fw_status fw_quantity_expression_names(fw_arena *arena, const char *text, size_t n,
                                       const char *const **names, size_t *count);

#endif
