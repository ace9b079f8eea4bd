/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laboratory packs. */
#include "base/text.h"
#include "process/calibrate.h"
#include "process/coupon.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

/* ---- <correlation>: which of its values have errors that go together ---- */

enum { MOST_JOINT = 96 };

typedef struct matrix {
    fw_arena *arena;
    fw_diags *diags;
    fw_process_flow *flow;
    fw_quantity *q[MOST_JOINT]; /* (n) */
    fw_place place[MOST_JOINT]; /* of the values of a row */
    int n;
    double *r; /* (n n) */
} matrix;

/* the word at *at, "" at the end; *at moves behind it */
static const char *word_of(fw_arena *arena, const char **at) {
    fw_word word;
    fw_word_next(at, " \t\r\n", &word);
    return fw_arena_strndup(arena, word.at, word.length);
}

static fw_status names_of(matrix *m, const fw_xml_attribute *of) {
    fw_status status = FW_OK;
    for (const char *at = of->value, *id;;) {
        FW_NEED(id = word_of(m->arena, &at));
        if (!*id) break;
        fw_quantity *q = (fw_quantity *)fw_process_flow_quantity(m->flow, id);
        if (!q)
            status = fw_diag_error(m->diags, 211, of->place, "flow '%s' has no quantity '%s'",
                                   m->flow->id, id);
        for (int i = 0; q && i < m->n; i++)
            if (m->q[i] == q)
                status = fw_diag_error(m->diags, 211, of->place, "'%s' is named twice", id);
        if (m->n == MOST_JOINT)
            return fw_diag_error(m->diags, 211, of->place,
                                 "more than %d quantities in one <correlation>", MOST_JOINT);
        m->q[m->n++] = q;
    }
    FW_TRY(status);
    return m->n >= 2 ? FW_OK
                     : fw_diag_error(m->diags, 211, of->place,
                                     "a <correlation> is of two quantities or more");
}

static fw_status read_row(matrix *m, const fw_xml_record *e, int row) {
    const fw_xml_attribute *of = fw_process_pack_get(e, "of"),
                           *values = fw_process_pack_get(e, "values");
    if (!of || !values) return FW_INPUT; /* said */
    if (row >= m->n || strcmp(of->value, m->q[row]->id) != 0)
        return fw_diag_error(m->diags, 211, of->place,
                             "this is row %d, which is %s%s%s; rows stand in the order of the ids",
                             row + 1, row < m->n ? "of '" : "one too many",
                             row < m->n ? m->q[row]->id : "", row < m->n ? "'" : "");
    m->place[row] = values->place;
    const char *at = values->value, *word;
    for (int k = 0;; k++) {
        FW_NEED(word = word_of(m->arena, &at));
        if (!*word && k == m->n) return FW_OK;
        if (!*word || k == m->n)
            return fw_diag_error(m->diags, 211, values->place,
                                 "the row of '%s' has %s than %d values, one for every id",
                                 of->value, *word ? "more" : "fewer", m->n);
        double r;
        if (!fw_number_parse(word, strlen(word), &r) || !(fabs(r) <= 1.0))
            return fw_diag_error(m->diags, 211, values->place,
                                 "'%s' is no correlation: a number between -1 and 1", word);
        if (k == row && fabs(r - 1.0) > 1e-9)
            return fw_diag_error(m->diags, 211, values->place,
                                 "the correlation of '%s' with itself is 1, not %s", of->value,
                                 word);
        m->r[row * m->n + k] = r;
    }
}

static fw_status check_symmetry(const matrix *m) {
    fw_status status = FW_OK;
    char a[32], b[32];
    for (int i = 0; i < m->n; i++)
        for (int k = 0; k < i; k++)
            if (fabs(m->r[i * m->n + k] - m->r[k * m->n + i]) > 1e-9)
                status = fw_diag_error(
                    m->diags, 211, m->place[i],
                    "%s with %s is %s here and %s in the other row; both are one number",
                    m->q[i]->id, m->q[k]->id, fw_number_text(a, sizeof a, m->r[i * m->n + k], 6),
                    fw_number_text(b, sizeof b, m->r[k * m->n + i], 6));
    return status;
}

static fw_status add(fw_arena *arena, fw_quantity *q, const char *id, double r) {
    fw_quantity_correlated *grown =
        fw_arena_array(arena, fw_quantity_correlated, (size_t)(q->ncorrelated + 1));
    FW_NEED(grown);
    int n = 0;
    for (int i = 0; i < q->ncorrelated; i++)
        if (strcmp(q->correlated[i].id, id) != 0) grown[n++] = q->correlated[i];
    if (r != 0.0) grown[n++] = (fw_quantity_correlated){id, r};
    q->correlated = grown;
    q->ncorrelated = n;
    return FW_OK;
}

/* a <correlation> of a laboratory pack into the quantities of the flow (FW-D211) */
static fw_status read_correlation(fw_arena *arena, const fw_xml_record *e, fw_process_flow *flow,
                                  fw_diags *diags) {
    matrix *m = fw_arena_one(arena, matrix);
    const fw_xml_attribute *of = fw_process_pack_get(e, "of");
    FW_NEED(m);
    if (!of) return FW_INPUT; /* said */
    m->arena = arena, m->diags = diags, m->flow = flow;
    FW_TRY(names_of(m, of));
    double *L = fw_arena_array(arena, double, (size_t)(m->n * m->n));
    FW_NEED(m->r = fw_arena_array(arena, double, (size_t)(m->n * m->n)));
    FW_NEED(L);
    int row = 0;
    for (const fw_xml_record *c = e->first_child; c; c = c->next)
        if (fw_xml_is(c, "row")) FW_TRY(read_row(m, c, row++));
    if (row < m->n)
        return fw_diag_error(diags, 211, of->place,
                             "the <correlation> has %d rows for %d quantities", row, m->n);
    FW_TRY(check_symmetry(m));
    if (!fw_process_correlation_possible(m->r, m->n, L))
        return fw_diag_error(diags, 211, of->place,
                             "no errors can be correlated like this: the matrix is not positive "
                             "semidefinite; take the one that calibrate wrote");
    for (int i = 0; i < m->n; i++)
        for (int k = 0; k < m->n; k++)
            if (k != i)
                FW_TRY(add(arena, m->q[i], m->q[k]->id,
                           m->r[i * m->n + k] * fw_process_lab_read_part(m->q[i]) *
                               fw_process_lab_read_part(m->q[k])));
    return FW_OK;
}

/* what is known of a quantity that is replaced holds no longer */
static fw_status forget_correlation(fw_arena *arena, fw_process_flow *flow, const char *id) {
    for (int i = 0; i < flow->nquantity; i++)
        if (flow->quantity[i]->ncorrelated > 0) FW_TRY(add(arena, flow->quantity[i], id, 0.0));
    return FW_OK;
}

/* ---- when its machines may be used; what the words mean is looked at by schedule/ ---- */

static fw_status known(fw_arena *arena, const fw_process_flow *flow, const fw_xml_attribute *a,
                       fw_diags *diags) {
    const char **id = fw_arena_array(arena, const char *, (size_t)flow->nequipment);
    FW_NEED(id);
    for (int i = 0; i < flow->nequipment; i++) {
        id[i] = flow->equipment[i].id;
        if (strcmp(id[i], a->value) == 0) return FW_OK;
    }
    const char *best = fw_did_you_mean(a->value, id, (size_t)flow->nequipment);
    return fw_diag_error(diags, 376, a->place, "flow '%s' has no equipment '%s'%s%s%s", flow->id,
                         a->value, FW_DID_YOU_MEAN(best));
}

/* <tool> of a laboratory pack (FW-D376) */
static fw_status read_tools(fw_arena *arena, const fw_xml_record *root, fw_process_flow *flow,
                            fw_diags *diags) {
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "tool")) continue;
        const fw_xml_attribute *equipment = fw_process_pack_get(e, "equipment"),
                               *open = fw_process_pack_get(e, "open"),
                               *days = fw_process_pack_get(e, "days"),
                               *closed = fw_process_pack_get(e, "closed"),
                               *to = fw_process_pack_get(e, "to");
        if (!equipment) continue; /* said by the table */
        fw_status status = known(arena, flow, equipment, diags);
        if (status == FW_NOMEM) return status;
        if ((open != NULL) == (closed != NULL) || (days && !open) || (to && !closed)) {
            fw_diag_error(diags, 376, e->element->place,
                          "<tool> says either when it is open, with days, or from when it is "
                          "closed, with to");
            continue;
        }
        fw_process_tool_time *grown =
            fw_arena_grow(arena, flow->tool_time, (size_t)flow->ntool_time,
                          (size_t)flow->ntool_time + 1, sizeof *grown);
        FW_NEED(grown);
        flow->tool_time = grown;
        grown[flow->ntool_time++] = (fw_process_tool_time){.equipment = equipment->value,
                                                           .open = open ? open->value : NULL,
                                                           .days = days ? days->value : "",
                                                           .from = closed ? closed->value : NULL,
                                                           .to = to       ? to->value
                                                                 : closed ? closed->value
                                                                          : NULL,
                                                           .place = e->element->place};
    }
    return FW_OK;
}

/* ---- with what its values were found ---- */

static fw_status no_such(fw_process_flow *flow, fw_diags *diags, const fw_xml_attribute *id) {
    const char *best = NULL;
    int least = 3;
    for (int i = 0; i < flow->nquantity; i++) {
        int d = fw_edit_distance(id->value, flow->quantity[i]->id, 2);
        if (d >= least) continue;
        least = d;
        best = flow->quantity[i]->id;
    }
    const size_t stem = strcspn(id->value, ".") + 1; /* "cavity.depth": others of the cavity */
    for (int i = 0; !best && id->value[stem - 1] == '.' && i < flow->nquantity; i++)
        if (strncmp(flow->quantity[i]->id, id->value, stem) == 0 &&
            strncmp(flow->quantity[i]->id + stem, id->value + stem, 1) == 0)
            best = flow->quantity[i]->id;
    return fw_diag_error(diags, 211, id->place, "flow '%s' has no quantity '%s'%s%s%s", flow->id,
                         id->value, FW_DID_YOU_MEAN(best));
}

/* "1.2 um", "unknown" */
static fw_status bare(fw_arena *arena, const fw_quantity *q, const char **text) {
    fw_text out = fw_text_new(arena);
    if (q->unknown || q->word)
        fw_text_add(&out, q->unknown ? "unknown" : q->word);
    else {
        fw_text_number(&out, fw_quantity_in_unit(q), 6);
        if (strcmp(q->unit, "1") != 0) fw_text_printf(&out, " %s", q->unit);
    }
    FW_TRY(fw_text_end(&out));
    *text = out.data;
    return FW_OK;
}

/* a value as it was; false: said what is wrong */
static bool value_then(const fw_xml_record *e, const fw_quantity *q, fw_diags *diags,
                       double *value) {
    const fw_xml_attribute *is = fw_process_pack_get(e, "value"),
                           *unit = fw_process_pack_get(e, "unit");
    fw_quantity_unit u;
    *value = (double)NAN;
    if (!is) return true;
    if (unit && fw_number_parse(is->value, strlen(is->value), value) &&
        fw_quantity_unit_parse(unit->value, strlen(unit->value), &u, NULL, NULL) &&
        fw_quantity_dimension_equal(u.dimension, q->dimension)) {
        *value = fw_quantity_unit_to_si(&u, *value);
        return true;
    }
    fw_diag_error(diags, 211, is->place, "<with> of '%s' needs a number and its unit", q->id);
    return false;
}

/* <with> of a laboratory pack (FW-D211) */
static fw_status read_with(fw_arena *arena, const fw_xml_record *root, fw_process_flow *flow,
                           fw_diags *diags) {
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        const fw_xml_attribute *id = fw_process_pack_get(e, "q");
        if (!fw_xml_is(e, "with") || !id) continue; /* said by the table */
        const fw_quantity *q = fw_process_flow_quantity(flow, id->value);
        double value;
        if (!q) {
            FW_TRY(no_such(flow, diags, id) == FW_NOMEM ? FW_NOMEM : FW_OK);
            continue;
        }
        if (!value_then(e, q, diags, &value)) continue;
        fw_process_was_with *grown = fw_arena_grow(arena, flow->was_with, (size_t)flow->nwas_with,
                                                   (size_t)flow->nwas_with + 1, sizeof *grown);
        FW_NEED(grown);
        flow->was_with = grown;
        grown[flow->nwas_with++] = (fw_process_was_with){.q = q,
                                                         .value = value,
                                                         .results = fw_process_pack_text(e, "of"),
                                                         .place = e->element->place};
    }
    return FW_OK;
}

static bool is_another(const fw_process_was_with *w) {
    static const double same = 1e-6; /* a pack is written with nine digits */
    if (isnan(w->value) || w->q->unknown) return isnan(w->value) == !w->q->unknown;
    return fabs(w->q->value - w->value) > same * fmax(fabs(w->q->value), fabs(w->value));
}

/* of the results of the pack those that the flow still has from it, "" for none */
static const char *still_used(fw_arena *arena, const fw_process_flow *flow,
                              const fw_process_was_with *w) {
    fw_text out = fw_text_new(arena);
    fw_text_add(&out, "");
    for (const char *at = w->results, *id; (id = word_of(arena, &at)) && *id;) {
        const fw_quantity *q = fw_process_flow_quantity(flow, id);
        if (q && q->replaced && q->place.file && strcmp(q->place.file, w->place.file) == 0)
            fw_text_printf(&out, "%s%s", out.length ? ", " : "", id);
    }
    return fw_text_end(&out) == FW_OK ? out.data : NULL;
}

/* was it read on one wafer, or in a table? A laboratory that states how its wafers differ says so itself */
static bool is_of_one(const fw_quantity *q) {
    return q->replaced && q->spread_taken && q->status == FW_MEASURED && q->place.file;
}

/* of one file: the values of it that the plan uses, which do not say how wafers differ. Test: test_wafers.c,
   one_wafer_keeps_the_spread. */
static fw_status ask_spread(fw_arena *arena, const fw_process_flow *flow, int first,
                            fw_diags *diags) {
    const char *file = flow->quantity[first]->place.file;
    fw_text out = fw_text_new(arena);
    int n = 0;
    for (int i = 0; i < flow->nquantity; i++) {
        const fw_quantity *q = flow->quantity[i];
        fw_quantity_unit unit;
        if (!is_of_one(q) || strcmp(q->place.file, file) != 0) continue;
        if (i < first) return FW_OK; /* told with that one */
        fw_text_printf(&out, "%s%s (", n++ ? ", " : "", q->id);
        if (q->spread > 0.0 &&
            fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL)) {
            unit.offset = 0.0;
            fw_text_add(&out, "taken to be +- ");
            fw_text_number(&out, fw_quantity_unit_from_si(&unit, q->spread), 2);
            if (strcmp(q->unit, "1") != 0) fw_text_printf(&out, " %s", q->unit);
        } else
            fw_text_add(&out, "not known, and taken to be nothing");
        fw_text_add(&out, ")");
    }
    FW_TRY(fw_text_end(&out));
    fw_diag_warning(diags, 734, flow->quantity[first]->place,
                    "nobody has measured how wafers differ in %s: the readings are of one wafer or "
                    "of a table. Calibrate from a log of several wafers",
                    out.data);
    return FW_OK;
}

/* d = |x - x_then|: a value that calibrate found follows from others of the flow, and holds with those. Test:
   test_calibrate.c, found_with_other_values. */
fw_status fw_process_lab_ask(fw_arena *arena, const fw_process_flow *flow, fw_diags *diags) {
    for (int i = 0; i < flow->nwas_with; i++) {
        const fw_process_was_with *w = &flow->was_with[i];
        fw_quantity then = *w->q;
        const char *results, *was, *is;
        if (!is_another(w)) continue;
        then.value = w->value, then.unknown = isnan(w->value), then.uncertainty = 0.0;
        FW_NEED(results = still_used(arena, flow, w));
        if (!*results) continue;
        FW_TRY(bare(arena, &then, &was));
        FW_TRY(bare(arena, w->q, &is));
        fw_diag_warning(diags, 676, w->place,
                        "%s %s found with %s = %s, and %s is %s now (%s): the plan takes both "
                        "together. Calibrate again, with the packs of this plan named by --lab",
                        results, strchr(results, ',') ? "were" : "was", w->q->id, was, w->q->id, is,
                        w->q->source ? w->q->source : "the flow");
    }
    for (int i = 0; i < flow->nquantity; i++) {
        if (is_of_one(flow->quantity[i])) FW_TRY(ask_spread(arena, flow, i, diags));
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- values that replace those of a flow by id ---- */

static fw_status amount(fw_arena *arena, const fw_quantity *q, const char **text) {
    fw_text out = fw_text_new(arena);
    if (q->unknown || q->word)
        fw_text_add(&out, q->unknown ? "unknown" : q->word);
    else {
        fw_quantity_unit unit;
        double u = q->uncertainty;
        if (fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL)) {
            unit.offset = 0.0;
            u = fw_quantity_unit_from_si(&unit, u);
        }
        fw_text_number(&out, fw_quantity_in_unit(q), 6);
        fw_text_add(&out, " +- ");
        fw_text_number(&out, u, 2);
        if (strcmp(q->unit, "1") != 0) fw_text_printf(&out, " %s", q->unit);
    }
    if (!q->unknown) fw_text_printf(&out, " (%s)", fw_quantity_value_status_text(q->status));
    FW_TRY(fw_text_end(&out));
    *text = out.data;
    return FW_OK;
}

static fw_status replace(fw_arena *arena, fw_process_flow *flow, fw_diags *diags,
                         const fw_xml_attribute *id, const fw_quantity *new) {
    fw_quantity *old = (fw_quantity *)fw_process_flow_quantity(flow, id->value);
    if (!old) return no_such(flow, diags, id);
    if (fw_process_quantity_computed(old))
        return fw_diag_error(diags, 211, id->place,
                             "'%s' is computed from this device's mask or by a step, so that a "
                             "laboratory pack cannot replace it; state the quantities that it "
                             "is computed from",
                             id->value);
    if (!fw_quantity_dimension_equal(old->dimension, new->dimension)) {
        const char *is = fw_quantity_dimension_text(arena, new->dimension),
                   *want = fw_quantity_dimension_text(arena, old->dimension);
        FW_NEED(is ? want : NULL);
        return fw_diag_error(
            diags, 211, id->place,
            "'%s' is %s in the process pack, and not %s; write it in a unit of that kind",
            id->value, want, is);
    }
    if (!new->unknown && fw_quantity_is_word(old) != (new->word != NULL))
        return fw_diag_error(diags, 728, new->place,
                             new->word
                                 ? "'%s' is a number; write value=\"...\" with its "
                                   "uncertainty, and not a word"
                                 : "'%s' is no number: say by word=\"...\" what it is called, "
                                   "without a value and an uncertainty",
                             id->value);
    if (old->replaced && old->place.file &&
        new->place.file &&strcmp(old->place.file, new->place.file) == 0)
        return fw_diag_error(diags, 211, id->place,
                             "'%s' is given twice, first in line %d; keep the one that holds",
                             id->value, old->place.line);
    fw_process_warn_exact(new, old, diags);
    fw_process_override o = {.id = old->id, .source = new->source};
    FW_TRY(amount(arena, old, &o.was));
    const fw_quantity was = *old;
    o.before = was;
    FW_TRY(forget_correlation(arena, flow, old->id));
    *old = *new;
    old->id = was.id;
    old->least = was.least; /* what makes sense is the pack's to say */
    old->most = was.most;
    old->range = was.range;
    old->replaced = true;
    FW_TRY(amount(arena, old, &o.is));
    /* what a step allows, and texts that name the value, are in the pack's unit; prices keep the
       laboratory's currency */
    if (!fw_quantity_unit_currency(old->unit)) old->unit = was.unit;
    fw_diag_note(diags, 198, id->place, "%s: %s = %s replaces %s; %s", flow->id, o.id, o.is, o.was,
                 o.source);
    fw_process_override *grown = fw_arena_grow(arena, flow->override, (size_t)flow->noverride,
                                               (size_t)flow->noverride + 1, sizeof *grown);
    FW_NEED(grown);
    flow->override = grown;
    flow->override[flow->noverride++] = o;
    return FW_OK;
}

static fw_status replace_all(fw_arena *arena, const fw_xml_record *root, fw_process_flow *flow,
                             fw_diags *diags) {
    const bool former = strcmp(fw_process_pack_text(root, "version"), "1") == 0;
    size_t before = diags->errors;
    fw_xml_source_text *source;
    int nsource;
    fw_status status = fw_xml_sources_read(arena, root->element, diags, &source, &nsource);
    if (status != FW_OK && status != FW_INPUT) return status;
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        const fw_xml_attribute *id = fw_process_pack_get(e, "id");
        fw_quantity q;
        if (!fw_xml_is(e, "q")) continue;
        status = fw_xml_quantity_read(arena, e->element, source, nsource, diags, &q);
        if (status == FW_INPUT) continue;
        FW_TRY(status);
        const fw_quantity *own = id ? fw_process_flow_quantity(flow, id->value) : NULL;
        if (own && former) FW_TRY(fw_process_lab_keep_spread(arena, flow, own->id, &q));
        if (id && (status = replace(arena, flow, diags, id, &q)) != FW_OK && status != FW_INPUT)
            return status;
    }
    if (diags->errors == before)
        for (const fw_xml_record *e = root->first_child; e; e = e->next) {
            if (!fw_xml_is(e, "correlation")) continue;
            status = read_correlation(arena, e, flow, diags);
            if (status != FW_OK && status != FW_INPUT) return status;
        }
    FW_TRY(read_with(arena, root, flow, diags));
    fw_status tools = read_tools(arena, root, flow, diags);
    if (tools != FW_OK && tools != FW_INPUT) return tools;
    return diags->failed ? FW_NOMEM : diags->errors > before ? FW_INPUT : FW_OK;
}

/* A thickness that a pack states beside the planned one is about what is planned with that pack: one that stays is about what
   it was stated with, so that it follows the plan. Test: test_corners.c thickness_follows_its_plan. */
static void aim_anew(fw_process_flow *flow, const char *file) {
    for (int i = 0; i < flow->ncorner && !flow->thickness->unknown; i++) {
        const fw_quantity *q = flow->corner[i].q;
        if (flow->corner[i].aim_m > 0.0 && q->replaced && q->place.file &&
            strcmp(q->place.file, file) == 0)
            flow->corner[i].aim_m = flow->thickness->value;
    }
}

fw_status fw_process_lab_apply(fw_arena *arena, const char *file, const char *xml, size_t n,
                               fw_process_flow *flow, fw_diags *diags) {
    fw_xml_reader r = {.arena = arena, .diags = diags, .table = &fw_process_laboratory_table};
    size_t before = diags->errors;
    FW_TRY(fw_xml_read(arena, file, xml, n, diags, &r.root));
    const fw_xml_attribute *of = fw_xml_attribute_of(r.root, "flow");
    bool other = of && strcmp(of->value, flow->id) != 0; /* of another flow of the device */
    if (other && strcmp(r.root->name, r.table->root) == 0 &&
        strcmp(r.root->space, r.table->urn) == 0)
        return FW_OK;
    FW_TRY(fw_xml_records_read(&r));
    FW_TRY(fw_xml_words_read(&r));
    if (!of || other) return FW_INPUT;
    FW_TRY(replace_all(arena, r.record, flow, diags));
    aim_anew(flow, file);
    FW_TRY(fw_process_flow_lint_values(arena, flow, diags));
    for (int i = 0; i < flow->nstep; i++)
        fw_process_step_overrun(&flow->step[i]);
    FW_TRY(fw_process_corners_follow(arena, flow));
    FW_TRY(fw_process_flow_waits(arena, flow)); /* their longest times are values, too */
    return diags->errors > before ? FW_INPUT : FW_OK;
}

/* ---- wafers that were printed before ---- */

/* the range that the verdict had before; false: none */
static bool range_before(const fw_process_corner *c, const fw_quantity *was, double *low,
                         double *high) {
    const fw_quantity *q = was->unknown ? c->assumed : was;
    if (!q || q->unknown) return false;
    fw_process_quantity_range(q, low, high);
    return true;
}

/* The bias of the mask follows where edges come out, so that a verdict with another value is about another plate. What lies
   within the range that was judged before holds for the old plate, too; x outside of it is told. SI. Test: test_corners.c
   another_bias. */
fw_status fw_process_lab_ask_bias(fw_arena *arena, const fw_process_flow *flow, fw_diags *diags) {
    for (int i = 0; i < flow->ncorner; i++) {
        const fw_process_corner *c = &flow->corner[i];
        const fw_process_override *o = NULL;
        const char *is, *apart = "";
        double low, high;
        for (int k = 0; k < flow->noverride; k++)
            if (c->q && strcmp(flow->override[k].id, c->q->id) == 0) o = &flow->override[k];
        if ((c->of != FW_CORNER_EDGE && c->of != FW_CORNER_ANISOTROPY) || !o || c->q->unknown ||
            !range_before(c, &o->before, &low, &high) ||
            (c->q->value >= low && c->q->value <= high))
            continue;
        FW_TRY(bare(arena, c->q, &is));
        const double edge_m = o->before.unknown ? 0.0 : o->before.value;
        if (c->of == FW_CORNER_EDGE)
            FW_NEED(apart = fw_arena_printf(arena, ", where lines come out %.3g um %s than here",
                                            2e6 * fabs(c->q->value - edge_m),
                                            c->q->value < edge_m ? "narrower" : "wider"));
        fw_diag_warning(
            diags, 683, c->q->place,
            "%s is %s, beyond what it was taken to be before (%s): the mask makes up for "
            "it, so that bias, times and verdict are of a plate that is drawn anew. "
            "They are not of a wafer that was printed with the plate before%s: judge that "
            "one without this value, by --set of the widths that it has, and --corners "
            "none",
            c->q->id, is, o->was, apart);
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- what a laboratory pack chooses ---- */

fw_status fw_process_lab_flow(fw_arena *arena, const char *file, const char *xml, size_t n,
                              const char **flow, fw_place *place) {
    fw_diags quiet = fw_diags_new(arena);
    fw_xml_element *root = NULL;
    fw_status status = fw_xml_read(arena, file, xml, n, &quiet, &root);
    const fw_xml_attribute *of = root ? fw_xml_attribute_of(root, "flow") : NULL;
    *flow = of ? of->value : "";
    *place = of ? of->place : (fw_place){.file = file};
    return status == FW_NOMEM ? status : FW_OK;
}

fw_status fw_process_lab_choices(fw_arena *arena, const char *file, const char *xml, size_t n,
                                 const char *flow, fw_process_choice **choice, int *nchoice) {
    fw_diags quiet = fw_diags_new(arena); /* what is wrong is said when its values are applied */
    fw_xml_element *root = NULL;
    fw_status status = fw_xml_read(arena, file, xml, n, &quiet, &root);
    if (status == FW_NOMEM) return status;
    const fw_xml_attribute *of = root ? fw_xml_attribute_of(root, "flow") : NULL;
    if (status != FW_OK || !of || strcmp(of->value, flow) != 0) return FW_OK;
    for (const fw_xml_element *e = root->first_child; e; e = e->next) {
        const fw_xml_attribute *a =
            strcmp(e->name, "choose") == 0 ? fw_xml_attribute_of(e, "alternative") : NULL;
        if (!a) continue;
        fw_process_choice *grown =
            fw_arena_grow(arena, *choice, (size_t)*nchoice, (size_t)*nchoice + 1, sizeof *grown);
        FW_NEED(grown);
        grown[(*nchoice)++] = (fw_process_choice){a->value, a->place};
        *choice = grown;
    }
    return FW_OK;
}
