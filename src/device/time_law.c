/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How loads and drivers go with time: the attributes of a law, read as its row says
 * (quantity/law_kind.h). */
#include "device/device_reader.h"
#include "quantity/law_kind.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const fw_quantity_dimension seconds = {.s = 1}, pure = {0};

static bool owns(const fw_quantity_law_kind *kind, const char *attribute) {
    for (int i = 0; i < kind->attributes; i++)
        if (strcmp(kind->attribute[i].name, attribute) == 0) return true;
    return false;
}

/* an attribute that belongs to other laws */
static void check_foreign(fw_device_reader *r, const fw_xml_record *record,
                          const fw_quantity_law_kind *kind, const char *name) {
    char owners[FW_LABEL] = "";
    if (!fw_xml_cell_of(record, name)->given || owns(kind, name)) return;
    for (const fw_quantity_law_kind *const *k = fw_quantity_law_kinds; *k; k++)
        if (owns(*k, name) && strlen(owners) + strlen((*k)->name) + 8 < sizeof owners)
            snprintf(owners + strlen(owners), sizeof owners - strlen(owners), "%s\"%s\"",
                     owners[0] ? " or " : "", (*k)->name);
    fw_diag_error(r->diags, 67, fw_xml_place_of(record, name),
                  "<%s>: %s does not belong to law=\"%s\"; remove it, or write law=%s",
                  record->row->name, name, kind->name, owners);
}

/* every attribute of the law's own; false after a mistake */
static bool check_attributes(fw_device_reader *r, const fw_xml_record *record,
                             const fw_quantity_law_kind *kind) {
    size_t before = r->diags->errors;
    for (int i = record->row->nattribute + 1; i < record->nattribute; i++)
        check_foreign(r, record, kind, record->attribute[i].name); /* behind `law` itself */
    for (int i = 0; i < kind->attributes; i++)
        if (kind->attribute[i].needed && !fw_xml_given(record, kind->attribute[i].name))
            fw_diag_error(r->diags, 67, fw_xml_place_of(record, "law"),
                          "<%s>: law=\"%s\" needs %s=\"...\"", record->row->name, kind->name,
                          kind->attribute[i].name);
    return r->diags->errors == before;
}

/* ---- tables ---- */

typedef struct table {
    double *t_s, *value;
    int n;
} table;

/* the expression in bytes from..end of the attribute */
static fw_status read_part(fw_device_reader *r, const fw_xml_attribute *a, size_t from, size_t end,
                           fw_quantity_dimension wanted, double *value, bool *ok) {
    fw_quantity_expression_error error;
    fw_status status = fw_quantity_expression_evaluate(r->arena, a->value + from, end - from,
                                                       &r->xml.names, wanted, value, &error);
    if (status == FW_NOMEM) return status;
    if (status != FW_OK) *ok = false;
    return status == FW_OK ? FW_OK : fw_xml_expression_report(&r->xml, a, "table", from, &error);
}

static size_t skip_blanks(const char *text, size_t at) {
    return at + strspn(text + at, " \t\r\n");
}

/* one "TIME: NUMBER" */
static fw_status read_point(fw_device_reader *r, const fw_xml_attribute *a, size_t from, size_t end,
                            table *t, bool *ok) {
    const char *colon = memchr(a->value + from, ':', end - from);
    size_t start = skip_blanks(a->value, from);
    if (!colon) {
        *ok = false;
        fw_diag_error(r->diags, 68, fw_xml_inside(a, start),
                      "table: a point is 'TIME: NUMBER', points are separated by ';', for example "
                      "\"0 ms: 0; 1 ms: 0.5; 2 ms: 1\"; the ':' is missing here");
        return FW_OK;
    }
    size_t middle = (size_t)(colon - a->value);
    double time_s = (double)NAN, value = (double)NAN;
    FW_TRY(read_part(r, a, from, middle, seconds, &time_s, ok));
    FW_TRY(read_part(r, a, middle + 1, end, pure, &value, ok));
    if (!*ok) return FW_OK;
    char now[FW_LABEL], last[FW_LABEL];
    if (t->n > 0 && !(time_s > t->t_s[t->n - 1])) {
        *ok = false;
        fw_diag_error(r->diags, 68, fw_xml_inside(a, start),
                      "table: the times must rise, but %s comes behind %s; sort the points, and "
                      "for a jump give two times that differ a little",
                      fw_xml_in_unit(now, time_s, "ms"),
                      fw_xml_in_unit(last, t->t_s[t->n - 1], "ms"));
        return FW_OK;
    }
    t->t_s[t->n] = time_s;
    t->value[t->n++] = value;
    return FW_OK;
}

static fw_status read_table(fw_device_reader *r, const fw_xml_record *record, const char *name,
                            fw_quantity_law *law, bool *ok) {
    const fw_xml_attribute *a = fw_xml_cell_of(record, name)->given;
    size_t n = strlen(a->value), most = 1;
    *ok = !fw_xml_full(r->diags) &&
          !fw_quantity_expression_uses(a->value, n, r->xml.lost, r->xml.nlost);
    for (size_t i = 0; i < n; i++)
        most += a->value[i] == ';';
    table t = {.n = 0};
    FW_NEED(t.t_s = fw_arena_array(r->arena, double, most));
    FW_NEED(t.value = fw_arena_array(r->arena, double, most));
    for (size_t from = 0; *ok && skip_blanks(a->value, from) < n;) {
        const char *mark = memchr(a->value + from, ';', n - from);
        size_t end = mark ? (size_t)(mark - a->value) : n;
        FW_TRY(read_point(r, a, from, end, &t, ok));
        from = mark ? end + 1 : n;
    }
    if (*ok && t.n < 2) {
        *ok = false;
        fw_diag_error(r->diags, 68, a->place,
                      "table: %d point%s given, at least two are needed, for example \"0 ms: 0; 1 "
                      "ms: 0.5; 2 ms: 1\"",
                      t.n, t.n == 1 ? " is" : "s are");
    }
    law->table_t_s = t.t_s;
    law->table_value = t.value;
    law->ntable = t.n;
    return FW_OK;
}

/* ---- expressions ---- */

fw_status fw_device_time_program(fw_device_reader *r, const fw_xml_record *record, const char *name,
                                 fw_quantity_dimension wanted,
                                 const fw_quantity_program **program) {
    const fw_xml_attribute *a = fw_xml_cell_of(record, name)->given;
    fw_quantity_expression_error error;
    fw_quantity_program *p;
    *program = NULL;
    if (!a || fw_xml_full(r->diags) ||
        fw_quantity_expression_uses(a->value, strlen(a->value), r->xml.lost, r->xml.nlost))
        return FW_OK;
    fw_status status = fw_quantity_program_compile(r->arena, a->value, strlen(a->value),
                                                   &r->xml.names, wanted, &p, &error);
    if (status == FW_NOMEM) return status;
    if (status != FW_OK) return fw_xml_expression_report(&r->xml, a, name, 0, &error);
    *program = p;
    return FW_OK;
}

/* a pole between the instants is met by the integration itself */
void fw_device_finite_check(fw_device_reader *r, const fw_xml_record *record, const char *name,
                            const fw_quantity_law *law, double duration_s) {
    enum { INSTANTS = 64 };
    for (int i = 0; i <= INSTANTS && isfinite(duration_s); i++) {
        double t_s = duration_s * i / INSTANTS, value[3];
        fw_quantity_law_value(law, t_s, t_s, value);
        if (isfinite(value[0])) continue;
        char at[FW_LABEL];
        fw_diag_error(r->diags, 69, fw_xml_place_of(record, name),
                      "%s has no finite value at %s; check divisors, roots, logarithms and "
                      "exponents",
                      name, fw_xml_in_unit(at, t_s, "ms"));
        return;
    }
}

/* ---- laws ---- */

static fw_status read_attribute(fw_device_reader *r, const fw_xml_record *record,
                                const fw_quantity_law_attribute *a, fw_quantity_law *law,
                                bool *ok) {
    const double number = fw_xml_number_or(record, a->name, a->absent);
    switch (a->form) {
    case FW_QUANTITY_LAW_NUMBER:
        memcpy((char *)law + a->offset, &number, sizeof number);
        return FW_OK;
    case FW_QUANTITY_LAW_POINTS:
        return read_table(r, record, a->name, law, ok);
    case FW_QUANTITY_LAW_EXPRESSION:
        FW_TRY(fw_device_time_program(r, record, a->name, pure, &law->program));
        *ok = law->program != NULL;
        if (*ok)
            fw_device_finite_check(r, record, a->name, law,
                                   fw_xml_number_of(&r->xml.record[record->parent], "duration"));
        return FW_OK;
    }
    return FW_OK;
}

static void report_mistake(fw_device_reader *r, const fw_xml_record *record,
                           const fw_quantity_law *law, const fw_quantity_law_mistake *m) {
    char first[FW_LABEL], second[FW_LABEL];
    const fw_quantity_law_attribute *a = law->kind->attribute, *b = a;
    while (strcmp(a->name, m->attribute) != 0)
        a++;
    while (strcmp(b->name, m->other) != 0)
        b++;
    fw_diag_error(r->diags, m->number, fw_xml_place_of(record, a->name), "<%s>: %s %s %s %s %s; %s",
                  record->row->name, a->name,
                  fw_xml_in_unit(first, fw_quantity_law_number(law, a), a->unit), m->relation,
                  b->name, fw_xml_in_unit(second, fw_quantity_law_number(law, b), b->unit),
                  m->advice);
}

static fw_status read_law(fw_device_reader *r, const fw_xml_record *record,
                          const fw_quantity_law_kind *kind, fw_quantity_law *law, bool *ok) {
    fw_quantity_law_mistake mistake;
    *law = (fw_quantity_law){.kind = kind, .end_s = (double)INFINITY};
    for (int i = 0; i < kind->attributes; i++)
        if (fw_xml_failed(record, kind->attribute[i].name)) *ok = false;
    for (int i = 0; *ok && i < kind->attributes; i++)
        FW_TRY(read_attribute(r, record, &kind->attribute[i], law, ok));
    if (*ok && kind->is_wrong && kind->is_wrong(law, &mistake)) {
        report_mistake(r, record, law, &mistake);
        *ok = false;
    }
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

/* a law that is 0 for the whole scene: what begins when it is over, or a table's first entries */
static void check_start(fw_device_reader *r, const fw_xml_record *record,
                        const fw_quantity_law *law) {
    double end_s = fw_xml_number_of(&r->xml.record[record->parent], "duration");
    bool late = law->start_s >= end_s;
    bool empty = law->kind->may_be_nothing && !(fw_quantity_law_largest(law, end_s) > 0);
    char label[FW_LABEL], end[FW_LABEL];
    if (!(late || empty) || isnan(end_s)) return;
    fw_diag_warning(r->diags, 99,
                    fw_xml_place_of(record, late ? "start" : law->kind->may_be_nothing),
                    "%s: its law is 0 until the scene ends at %s, so that it has no effect; let "
                    "it begin earlier, or make the scene longer",
                    fw_xml_label(record, label), fw_xml_in_unit(end, end_s, "ms"));
}

/* a law that grows on behind the scene's end: a ramp that is longer, points of a table that nothing reaches */
static void check_reach(fw_device_reader *r, const fw_xml_record *record,
                        const fw_quantity_law *law) {
    enum { BREAKS = 256 };
    const double end_s = fw_xml_number_of(&r->xml.record[record->parent], "duration");
    double at_s[BREAKS], last_s = 0;
    char label[FW_LABEL], end[FW_LABEL], last[FW_LABEL], part[32];
    if (!law->kind->largest || !(end_s > 0) || !isfinite(end_s)) return;
    const int n = fw_quantity_law_breaks_of(law, (double)INFINITY, at_s, BREAKS);
    for (int i = 0; i < n && i < BREAKS; i++)
        last_s = fmax(last_s, at_s[i]);
    if (!(last_s > end_s * (1 + 1e-9)) || !isfinite(last_s)) return;
    const double most = fw_quantity_law_largest(law, last_s),
                 met = fw_quantity_law_largest(law, end_s);
    if (!(met > 0) || !(met < 0.99 * most)) return;
    fw_diag_warning(r->diags, 701, fw_xml_place_of(record, "law"),
                    "%s: where the scene ends, at %s, its law has come to %s %% of what it comes "
                    "to, at %s: nothing is said of what the rest does in the plane; make the scene "
                    "longer, or let the "
                    "law be as far as it is meant to come",
                    fw_xml_label(record, label), fw_xml_in_unit(end, end_s, "ms"),
                    fw_number_text(part, sizeof part, 100 * met / most, 3),
                    fw_xml_in_unit(last, last_s, "ms"));
}

/* Every period takes some ten steps, and a run 10 million of them at most (FW-D108). Of what a mean
   would leave out no bound is known. */
static const double fw_most_periods = 1e6;

static void check_periods(fw_device_reader *r, const fw_xml_record *record,
                          const fw_quantity_law *law) {
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    double duration_s = fw_xml_number_of(&r->xml.record[record->parent], "duration");
    double rate_Hz = wave.fastest_Hz;
    double periods = rate_Hz * (fmin(wave.to_s, duration_s) - wave.from_s);
    char label[FW_LABEL], rate[FW_LABEL], end[FW_LABEL];
    if (!(wave.repeats && isfinite(duration_s) && periods > fw_most_periods)) return;
    fw_diag_error(
        r->diags, 250, fw_xml_place_of(record, wave.attribute),
        "%s: %s %s makes more than a million periods in this scene, and each of them would be "
        "followed; make the scene no longer than %s, or, where the mechanism cannot follow, give "
        "the mean of the load without a law and judge what that leaves out",
        fw_xml_label(record, label), wave.attribute, fw_xml_in_unit(rate, rate_Hz, "Hz"),
        fw_xml_in_unit(end, fw_most_periods / rate_Hz, "ms"));
}

fw_status fw_device_time_law(fw_device_reader *r, const fw_xml_record *record,
                             const fw_quantity_law **law) {
    const char *name = fw_xml_text_of(record, "law");
    bool ok = true;
    *law = NULL;
    if (!name && fw_xml_given(record, "law")) return FW_OK; /* misspelt: reported */
    const fw_quantity_law_kind *kind = name ? fw_quantity_law_find(name) : fw_quantity_law_kinds[0];
    if (!check_attributes(r, record, kind)) return r->diags->failed ? FW_NOMEM : FW_OK;
    fw_quantity_law *own = fw_arena_one(r->arena, fw_quantity_law);
    FW_NEED(own);
    FW_TRY(read_law(r, record, kind, own, &ok));
    if (ok && !fw_quantity_law_is_constant(own)) *law = own;
    if (ok) check_start(r, record, own);
    if (ok) check_reach(r, record, own);
    if (ok) check_periods(r, record, own);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
