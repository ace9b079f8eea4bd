/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A laboratory's calibration: the table of measurements is read, and what follows from it is
   written as a pack. */
#include "base/constants.h"
#include "process/calibrate.h"
#include "process/coupon.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

/* ---- the table of measurements ---- */
/* The table of measurements: CSV as RFC 4180, without line breaks inside fields. */

enum {
    COUPON,
    FEATURE,
    DRAWN,
    MEASURED,
    U,
    UNIT,
    AT,
    U_AT,
    AT_UNIT,
    WARM,
    U_WARM,
    OPEN,
    U_OPEN,
    COLUMNS,
    MOST_ROWS = 5000
};
static const char *const column[COLUMNS] = {"coupon",
                                            "feature",
                                            "drawn_um",
                                            "measured",
                                            "u",
                                            "unit",
                                            "at",
                                            "u_at",
                                            "at_unit",
                                            "temperature_Cel",
                                            "u_temperature_K",
                                            "open_area_cm2",
                                            "u_open_area_cm2"};

typedef struct table {
    fw_arena *arena;
    fw_diags *diags;
    fw_place place;     /* of the line */
    int where[COLUMNS]; /* column of the file, -1: not there */
    char between[2];    /* fields: "," or, where spreadsheets write 3,64, ";" */
} table;

/* the next field of a line, unquoted, without blanks around; *at moves behind its comma */
static const char *field(table *t, const char **at, bool *more) {
    const char *c = *at;
    fw_text out = fw_text_new(t->arena);
    fw_text_add(&out, "");
    while (*c == ' ' || *c == '\t')
        c++;
    if (*c == '"') {
        for (c++; *c && !(*c == '"' && c[1] != '"'); c++) {
            fw_text_bytes(&out, c, 1);
            c += *c == '"';
        }
        c += *c == '"';
        c += strcspn(c, t->between);
    } else {
        size_t n = strcspn(c, t->between), kept = n;
        while (kept > 0 && (c[kept - 1] == ' ' || c[kept - 1] == '\t'))
            kept--;
        fw_text_bytes(&out, c, kept);
        c += n;
    }
    *more = *c == t->between[0];
    *at = c + (*c == t->between[0]);
    return fw_text_end(&out) == FW_OK ? out.data : NULL;
}

enum { MOST_FIELDS = 32 };
static fw_status fields(table *t, const char *line, const char *list[MOST_FIELDS], int *n) {
    bool more = true;
    for (*n = 0; more && *n < MOST_FIELDS; ++*n)
        FW_NEED(list[*n] = field(t, &line, &more));
    return FW_OK;
}

static fw_status header(table *t, const char *line) {
    const char *name[MOST_FIELDS];
    int n;
    if (strchr(line, ';') && !strchr(line, ',')) t->between[0] = ';';
    FW_TRY(fields(t, line, name, &n));
    for (int k = 0; k < COLUMNS; k++)
        t->where[k] = -1;
    fw_status status = FW_OK;
    for (int i = 0; i < n; i++) {
        int k = 0;
        while (k < COLUMNS && strcmp(column[k], name[i]) != 0)
            k++;
        if (k < COLUMNS)
            t->where[k] = i;
        else
            status = fw_diag_error(t->diags, 211, t->place,
                                   "unknown column '%s'; the header is coupon,feature,drawn_um,"
                                   "measured,u,unit,at,u_at,at_unit and, where it is known, "
                                   "temperature_Cel,u_temperature_K,open_area_cm2,u_open_area_cm2",
                                   name[i]);
    }
    for (int k = 0; k <= UNIT; k++)
        if (t->where[k] < 0 && k != FEATURE && k != DRAWN)
            status = fw_diag_error(t->diags, 211, t->place, "the header lacks the column '%s'",
                                   column[k]);
    return status;
}

/* false: there is something that is no number */
static bool number(table *t, const char *text, int k, double *value) {
    *value = (double)NAN;
    if (!*text || fw_number_parse(text, strlen(text), value)) return true;
    fw_diag_error(t->diags, 211, t->place, "%s='%s' is not a number", column[k], text);
    return false;
}

/* value and standard uncertainty with a unit, to SI; false: said what is wrong */
static bool amount(table *t, const char *const *cell, int value_at, double *value, double *u,
                   fw_quantity_dimension *dimension) {
    fw_quantity_unit unit;
    const char *of = cell[value_at + 2];
    if (!number(t, cell[value_at], value_at, value) ||
        !number(t, cell[value_at + 1], value_at + 1, u))
        return false;
    if (isnan(*value) && isnan(*u) && !*of) return true;
    if (isnan(*value) || !fw_quantity_unit_parse(of, strlen(of), &unit, NULL, NULL)) {
        fw_diag_error(t->diags, 211, t->place,
                      "%s='%s' with %s='%s': a number and its unit are needed", column[value_at],
                      cell[value_at], column[value_at + 2], of);
        return false;
    }
    if (isnan(*u)) *u = value_at == AT ? 0.0 : -1.0;
    if (value_at == MEASURED ? !(*u > 0.0) : !(*u >= 0.0)) {
        fw_diag_error(t->diags, 211, t->place, "%s: a standard uncertainty %s is needed",
                      column[value_at + 1], value_at == MEASURED ? "above 0" : "of 0 or more");
        return false;
    }
    *value = fw_quantity_unit_to_si(&unit, *value);
    unit.offset = 0.0;
    *u = fw_quantity_unit_to_si(&unit, *u);
    *dimension = unit.dimension;
    return true;
}

double fw_process_written_uncertainty(const char *number) {
    const char *mantissa = number + strspn(number, " +-"), *point = strchr(mantissa, '.');
    const char *e = strpbrk(mantissa, "eE");
    double power = 0.0;
    if (e)
        fw_number_parse(e + 1 + (e[1] == '+'), strspn(e + 1 + (e[1] == '+'), "-0123456789"),
                        &power);
    if (point && (!e || point < e)) power -= (double)strspn(point + 1, "0123456789");
    return pow(10.0, power) / sqrt(12.0);
}

/* of the bath, in degrees Celsius, and by how much that may be off: as it is written, where nothing is said */
static bool warmth(table *t, const char *const *cell, fw_process_measurement *r) {
    double T, u;
    if (!number(t, cell[WARM], WARM, &T) || !number(t, cell[U_WARM], U_WARM, &u)) return false;
    if (isnan(T)) return true;
    if (isnan(u)) u = fw_process_written_uncertainty(cell[WARM]);
    if (!(T > -FW_ICE_POINT_K) || !(u >= 0.0)) {
        fw_diag_error(t->diags, 211, t->place,
                      "%s='%s', %s='%s': a temperature above absolute zero is needed, and a "
                      "standard uncertainty of 0 or more",
                      column[WARM], cell[WARM], column[U_WARM], cell[U_WARM]);
        return false;
    }
    r->condition[FW_CONDITION_TEMPERATURE] = T + FW_ICE_POINT_K;
    r->condition_uncertainty[FW_CONDITION_TEMPERATURE] = u;
    return true;
}

/* of the wafer, in cm2, likewise */
static bool openness(table *t, const char *const *cell, fw_process_measurement *r) {
    double A, u;
    if (!number(t, cell[OPEN], OPEN, &A) || !number(t, cell[U_OPEN], U_OPEN, &u)) return false;
    if (isnan(A)) return true;
    if (isnan(u)) u = fw_process_written_uncertainty(cell[OPEN]);
    if (!(A > 0.0) || !(u >= 0.0)) {
        fw_diag_error(
            t->diags, 211, t->place,
            "%s='%s', %s='%s': an area above zero is needed, and a standard uncertainty of "
            "0 or more",
            column[OPEN], cell[OPEN], column[U_OPEN], cell[U_OPEN]);
        return false;
    }
    r->condition[FW_CONDITION_OPEN_AREA] = 1e-4 * A;
    r->condition_uncertainty[FW_CONDITION_OPEN_AREA] = 1e-4 * u;
    return true;
}

static bool is_number(int k) {
    return k == DRAWN || k == MEASURED || k == U || k == AT || k == U_AT || k >= WARM;
}

/* "3,64" of a table whose fields are parted by semicolons is 3.64 */
static fw_status with_point(table *t, const char **cell) {
    if (!strchr(*cell, ',') || strchr(*cell, '.')) return FW_OK;
    char *copy = fw_arena_strdup(t->arena, *cell);
    FW_NEED(copy);
    *strchr(copy, ',') = '.';
    *cell = copy;
    return FW_OK;
}

static fw_status one_row(table *t, const char *line, fw_process_measurement *r, bool *good) {
    const char *name[MOST_FIELDS], *cell[COLUMNS];
    int n;
    FW_TRY(fields(t, line, name, &n));
    for (int k = 0; k < COLUMNS; k++)
        cell[k] = t->where[k] >= 0 && t->where[k] < n ? name[t->where[k]] : "";
    for (int k = 0; k < COLUMNS && t->between[0] == ';'; k++)
        if (is_number(k)) FW_TRY(with_point(t, &cell[k]));
    *r = (fw_process_measurement){.coupon = fw_process_coupon_called(cell[COUPON]),
                                  .feature = cell[FEATURE],
                                  .place = t->place};
    /* a line of the ladder that is gone or stands was looked at, not measured */
    bool counted = fw_process_coupon_is_looked_at(r);
    if (counted && !*cell[MEASURED])
        *r = (fw_process_measurement){.coupon = fw_process_coupon_called(cell[COUPON]),
                                      .feature = cell[FEATURE],
                                      .place = t->place,
                                      .uncertainty = 1.0,
                                      .dimension = {.m = 1}};
    *good = number(t, cell[DRAWN], DRAWN, &r->drawn_m);
    r->drawn_m *= 1e-6;
    if (!(counted && !*cell[MEASURED]))
        *good = amount(t, cell, MEASURED, &r->value, &r->uncertainty, &r->dimension) && *good;
    *good = amount(t, cell, AT, &r->at, &r->at_uncertainty, &r->at_dimension) && *good;
    *good = warmth(t, cell, r) && *good;
    *good = openness(t, cell, r) && *good;
    if (*good && !counted && isnan(r->value)) {
        fw_diag_error(t->diags, 211, t->place,
                      "this row lacks measured, u or unit; it needs all three");
        *good = false;
    }
    return FW_OK;
}

static bool blank(const char *line) {
    return line[strspn(line, " \t,;")] == '\0' || line[strspn(line, " \t")] == '#';
}

/* ---- rows that read the very same ---- */

static bool same(double a, double b) {
    return (isnan(a) && isnan(b)) || fabs(a - b) <= 1e-12 * fabs(a);
}

/* of one thing, read under the same */
static bool of_one(const fw_process_measurement *a, const fw_process_measurement *b) {
    return strcmp(a->coupon, b->coupon) == 0 && strcmp(a->feature, b->feature) == 0 &&
           same(a->drawn_m, b->drawn_m) && same(a->at, b->at) &&
           same(a->condition[FW_CONDITION_TEMPERATURE], b->condition[FW_CONDITION_TEMPERATURE]) &&
           same(a->condition[FW_CONDITION_OPEN_AREA], b->condition[FW_CONDITION_OPEN_AREA]);
}

/* Rows of one thing whose spread is 0: the instrument does not resolve what they scatter by, so that they are off by the same
   and their mean is known no better than one of them. They count once, as sites of a log do (calibrate_wafers.c). Test:
   test_calibrate.c, rows_that_read_the_same */
static void once(fw_process_measurement *row, int *n, fw_diags *diags) {
    int kept = 0;
    for (int i = 0; i < *n; i++) {
        int copies = 0, first = i;
        bool spread = fw_process_coupon_is_looked_at(&row[i]);
        for (int k = 0; k < *n; k++)
            if (of_one(&row[k], &row[i]))
                spread = spread || !same(row[k].value, row[i].value), copies++,
                first = k < first ? k : first;
        row[i].once = !spread && copies > 1 && first < i;
        if (!spread && copies > 1 && first == i)
            fw_diag_warning(diags, 681, row[i].place,
                            "%d rows of %s read the very same: their spread says nothing of how "
                            "exactly, and they count as one row",
                            copies, row[i].coupon);
    }
    for (int i = 0; i < *n; i++)
        if (!row[i].once) row[kept++] = row[i];
    *n = kept;
}

fw_status fw_process_measurements_read(fw_arena *arena, const char *file, const char *text,
                                       size_t n, fw_diags *diags,
                                       fw_process_measurement **measurement, int *nmeasurement) {
    table t = {.arena = arena, .diags = diags, .place = {.file = file}, .between = ","};
    size_t before = diags->errors, lines = 1;
    bool headed = false;
    const char *end = text + n, *at = text;
    *nmeasurement = 0;
    if (memchr(text, '\0', n))
        return fw_diag_error(
            diags, 211, t.place,
            "the file holds a byte that is zero, so that it is no text; save the table as CSV");
    if (n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) at += 3; /* a spreadsheet's mark of UTF-8 */
    for (const char *c = at; c < end; c++)
        lines += *c == '\n';
    if (lines > MOST_ROWS)
        return fw_diag_error(diags, 211, t.place,
                             "the table has more than the %d lines that are read; divide it",
                             MOST_ROWS);
    FW_NEED(*measurement = fw_arena_array(arena, fw_process_measurement, lines));
    while (at < end) {
        const char *stop = memchr(at, '\n', (size_t)(end - at));
        size_t length = (size_t)((stop ? stop : end) - at);
        if (length > 0 && at[length - 1] == '\r') length--;
        const char *line = fw_arena_strndup(arena, at, length);
        FW_NEED(line);
        t.place.line++;
        t.place.column = 1;
        at = stop ? stop + 1 : end;
        if (blank(line)) continue;
        if (!headed) {
            FW_TRY(header(&t, line));
            headed = true;
            continue;
        }
        bool good;
        FW_TRY(one_row(&t, line, &(*measurement)[*nmeasurement], &good));
        *nmeasurement += good;
    }
    once(*measurement, nmeasurement, diags);
    if (diags->failed) return FW_NOMEM;
    return diags->errors > before ? FW_INPUT : FW_OK;
}

/* ---- the pack ---- */

/* value and uncertainty in the unit of the flow's own quantity; what is 0 but for rounding is 0 */
static bool in_unit(const fw_quantity *q, double value, double u, double *shown, double *u_shown) {
    fw_quantity_unit unit;
    if (!fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL)) return false;
    *shown = fw_quantity_unit_from_si(&unit, value);
    unit.offset = 0.0;
    *u_shown = fw_quantity_unit_from_si(&unit, u);
    if (fabs(*shown) < 1e-9 * *u_shown) *shown = 0.0;
    return true;
}

static void attribute(fw_text *out, const char *name, const char *value) {
    fw_text_printf(out, " %s=\"", name);
    fw_text_escaped(out, value);
    fw_text_add(out, "\"");
}

/* "; etched at 35 Cel, corrected to pan.T-reference = 22 Cel by the law arrhenius of step S14"; nothing where it was at that */
static void put_condition(const fw_process_flow *flow, const fw_process_calibrated *c,
                          fw_process_condition which, fw_text *out) {
    static const double same = 1e-5; /* relative; 3 mK */
    const fw_process_step *s =
        c->most[which] > 0.0 ? fw_process_flow_corrects(flow, which, c->id) : NULL;
    const fw_quantity *from = NULL;
    fw_quantity_unit unit;
    if (s) from = fw_process_step_argument(s, fw_process_condition_reference(which));
    if (!s || !fw_quantity_unit_parse(from->unit, strlen(from->unit), &unit, NULL, NULL)) return;
    const double near = same * from->value;
    if (fabs(c->least[which] - from->value) < near && fabs(c->most[which] - from->value) < near)
        return;
    fw_text_add(out, "; etched at ");
    fw_text_number(out, fw_quantity_unit_from_si(&unit, c->least[which]), 4);
    if (c->most[which] - c->least[which] > near) {
        fw_text_add(out, " to ");
        fw_text_number(out, fw_quantity_unit_from_si(&unit, c->most[which]), 4);
    }
    fw_text_printf(out, " %s%s, corrected to ", from->unit,
                   which == FW_CONDITION_OPEN_AREA ? " open" : "");
    fw_text_escaped(out, from->id ? from->id : "the reference value");
    fw_text_add(out, " = ");
    fw_text_number(out, fw_quantity_in_unit(from), 4);
    fw_text_printf(out, " %s by the law %s of step %s", from->unit, s->law, s->id);
}

static void put_conditions(const fw_process_flow *flow, const fw_process_calibrated *c,
                           fw_text *out) {
    for (int k = 0; k < FW_CONDITIONS; k++)
        put_condition(flow, c, (fw_process_condition)k, out);
}

/* how wafers are taken to differ, as long as no reading of several says it */
static void put_spread_of(const fw_quantity *q, double spread, fw_text *out) {
    double value, s;
    if (!in_unit(q, q->value, spread, &value, &s)) return;
    fw_text_add(out, " spread=\"");
    fw_text_number(out, s, 4);
    fw_text_add(out, "\"");
}

static void put_test(fw_text *out, const fw_process_calibrated *c) {
    if (c->freedom == 0) {
        fw_text_add(out, "no residual to test");
        return;
    }
    fw_text_add(out, "chi square ");
    fw_text_number(out, c->chi_square, 3);
    fw_text_printf(out, ", %d degree%s of freedom, probability ", c->freedom,
                   c->freedom > 1 ? "s" : "");
    fw_text_number(out, c->probability, 2);
}

static void put_packs(const fw_process_calibration *c, fw_text *out) {
    if (!c->packs) return;
    fw_text_add(out, "; for use with ");
    fw_text_escaped(out, c->packs);
}

/* of one value: its wafers, readings and days */
static void put_source(const fw_process_calibration *of, const fw_process_calibrated *c,
                       fw_text *out) {
    if (!c->source) return;
    fw_text_printf(out, "  <source id=\"%s-measured\" kind=\"measured\"", c->id);
    if (c->date) attribute(out, "date", c->date);
    fw_text_add(out, ">");
    fw_text_escaped(out, c->source);
    put_packs(of, out);
    fw_text_add(out, "</source>\n");
}

/* a row for every quantity, so that a person can read it, and a slip is seen as one */
static void put_correlation(const fw_process_calibration *c, fw_text *out) {
    if (c->njoint == 0) return;
    fw_text_add(out, "  <correlation of=\"");
    for (int i = 0; i < c->njoint; i++)
        fw_text_printf(out, "%s%s", i ? " " : "", c->joint[i]);
    fw_text_add(out, "\">\n");
    for (int i = 0; i < c->njoint; i++) {
        fw_text_add(out, "    <row");
        attribute(out, "of", c->joint[i]);
        fw_text_add(out, " values=\"");
        for (int k = 0; k < c->njoint; k++) {
            fw_text_add(out, k ? " " : "");
            fw_text_number(out, c->correlation[i * c->njoint + k], 6);
        }
        fw_text_add(out, "\"/>\n");
    }
    fw_text_add(out, "  </correlation>\n");
}

/* values of the flow that this was found with: a plan that has others says so */
static void put_with(const fw_process_calibration *c, fw_text *out) {
    for (int i = 0; i < c->nwith; i++) {
        const fw_quantity *q = c->with[i].q;
        bool told = false;
        for (int k = 0; k < c->count; k++)
            told = told || strcmp(c->item[k].id, q->id) == 0; /* found itself */
        for (int k = 0; k < i; k++)
            told = told || c->with[k].q == q;
        if (told) continue;
        fw_text_add(out, "  <with");
        attribute(out, "q", q->id);
        if (!q->unknown) {
            fw_text_add(out, " value=\"");
            fw_text_number(out, fw_quantity_in_unit(q), 9);
            fw_text_add(out, "\"");
            attribute(out, "unit", q->unit);
        }
        fw_text_add(out, " of=\"");
        for (int k = i, n = 0; k < c->nwith; k++)
            if (c->with[k].q == q) fw_text_printf(out, "%s%s", n++ ? " " : "", c->with[k].of);
        fw_text_add(out, "\"/>\n");
    }
}

fw_status fw_process_calibration_pack(const fw_process_flow *flow,
                                      const fw_process_calibration *calibration,
                                      const char *measured_file, const char *measured_sha256,
                                      fw_text *out) {
    fw_text_add(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Values of a laboratory. Each "
        "replaces the one with its id where the option lab of flexwright names this file. -->\n"
        "<process xmlns=\"urn:flexwright:process:1\" id=\"lab\" version=\"2\" "
        "title=\"Values of the laboratory\"");
    attribute(out, "flow", flow->id);
    fw_text_add(out, ">\n");
    if (calibration->count == 0 || !calibration->item[0].source) {
        fw_text_add(out, "  <source id=\"coupons\" kind=\"measured\">measured coupons, ");
        fw_text_escaped(out, measured_file);
        fw_text_printf(out, ", SHA-256 %.16s", measured_sha256);
        put_packs(calibration, out);
        fw_text_add(out, "</source>\n");
    }
    for (int i = 0; i < calibration->count; i++)
        put_source(calibration, &calibration->item[i], out);
    for (int i = 0; i < calibration->count; i++) {
        const fw_process_calibrated *c = &calibration->item[i];
        const fw_quantity *q = fw_process_flow_quantity(flow, c->id);
        double value, u;
        if (!q || !in_unit(q, c->value, c->uncertainty, &value, &u)) return FW_INTERNAL;
        fw_text_add(out, "  <q");
        attribute(out, "id", c->id);
        fw_text_add(out, " value=\"");
        fw_text_number(out, value, 9);
        fw_text_add(out, "\" u=\"");
        fw_text_number(out, u, 4);
        fw_text_add(out, "\"");
        if (c->spread_taken) put_spread_of(q, c->spread, out);
        attribute(out, "unit", q->unit);
        fw_text_add(out, " status=\"measured\"");
        attribute(out, "src",
                  c->source ? fw_arena_printf(out->arena, "%s-measured", c->id) : "coupons");
        fw_text_add(out, " note=\"");
        fw_text_escaped(out, c->coupon);
        fw_text_add(out, ": ");
        fw_text_escaped(out, c->note);
        put_conditions(flow, c, out);
        fw_text_add(out, "; ");
        put_test(out, c);
        fw_text_add(out, "\"/>\n");
    }
    put_correlation(calibration, out);
    put_with(calibration, out);
    fw_text_add(out, "</process>\n");
    return fw_text_end(out);
}

static void put_amount(fw_text *out, const fw_quantity *q, double value, double uncertainty) {
    double shown, u;
    if (!in_unit(q, value, uncertainty, &shown, &u)) return;
    fw_text_number(out, shown, 6);
    fw_text_add(out, " +- ");
    fw_text_number(out, u, 2);
    if (strcmp(q->unit, "1") != 0) fw_text_printf(out, " %s", q->unit);
}

fw_status fw_process_calibration_text(const fw_process_flow *flow,
                                      const fw_process_calibration *calibration, fw_text *out) {
    for (int i = 0; i < calibration->count; i++) {
        const fw_process_calibrated *c = &calibration->item[i];
        const fw_quantity *q = fw_process_flow_quantity(flow, c->id);
        if (!q) return FW_INTERNAL;
        fw_text_printf(out, "%s: ", c->id);
        put_amount(out, q, c->value, c->uncertainty);
        fw_text_add(out, ", was ");
        if (q->unknown)
            fw_text_add(out, "unknown");
        else {
            put_amount(out, q, q->value, q->uncertainty);
            fw_text_printf(out, " (%s)", fw_quantity_value_status_text(q->status));
        }
        fw_text_printf(out, "\n  %s, %d row%s: %s", c->coupon, c->rows, c->rows > 1 ? "s" : "",
                       c->note);
        put_conditions(flow, c, out);
        fw_text_add(out, "; ");
        put_test(out, c);
        fw_text_add(out, "\n");
    }
    static const double worth = 0.05; /* weaker ones change no window that a person reads */
    for (int i = 0; i < calibration->njoint; i++)
        for (int k = i + 1; k < calibration->njoint; k++) {
            double r = calibration->correlation[i * calibration->njoint + k];
            if (fabs(r) < worth) continue;
            fw_text_printf(out, "%s with %s: correlation ", calibration->joint[i],
                           calibration->joint[k]);
            fw_text_number(out, r, 2);
            fw_text_add(out, "\n");
        }
    return fw_text_end(out);
}
