/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <correlation> of a laboratory pack: which of its values have errors that go together. */
#include "process/coupon.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

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
    *at += strspn(*at, " \t\r\n");
    size_t n = strcspn(*at, " \t\r\n");
    const char *word = fw_arena_strndup(arena, *at, n);
    *at += n;
    return word;
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

/* Is R + e I positive definite? Cholesky's factorization: the first pivot that is not above zero says no. e = 1e-5 stands
   for what is lost by writing six digits. R (n n) symmetric with a unit diagonal. Cost n^3/3.
   Source: Golub and Van Loan, Matrix Computations, 4.2. Test: test_correlation.c, wrong_matrices. */
bool fw_process_correlation_possible(const double *r, int n, double *L) {
    const double lost = 1e-5;
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= i; k++) {
            double sum = r[i * n + k] + (i == k ? lost : 0.0);
            for (int j = 0; j < k; j++)
                sum -= L[i * n + j] * L[k * n + j];
            if (i == k && !(sum > 0.0)) return false;
            L[i * n + k] = i == k ? sqrt(sum) : sum / L[k * n + k];
        }
    return true;
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

fw_status fw_process_correlation_read(fw_arena *arena, const fw_xml_record *e,
                                      fw_process_flow *flow, fw_diags *diags) {
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
            if (k != i) FW_TRY(add(arena, m->q[i], m->q[k]->id, m->r[i * m->n + k]));
    return FW_OK;
}

fw_status fw_process_correlation_forget(fw_arena *arena, fw_process_flow *flow, const char *id) {
    for (int i = 0; i < flow->nquantity; i++)
        if (flow->quantity[i]->ncorrelated > 0) FW_TRY(add(arena, flow->quantity[i], id, 0.0));
    return FW_OK;
}
