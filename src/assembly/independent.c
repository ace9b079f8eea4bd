/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which coordinates can be given freely: rows of the null space of G that are independent. */
#include "assembly/independent.h"
#include <math.h>
#include <string.h>

static const double hopeless = 1e8; /* condition from which a choice is refused */
static const char *const axis_name[] = {"x", "y", "phi"};

static const char *name_of(const char *id) {
    return id ? id : "(unnamed)";
}

static fw_status write_names(fw_arena *arena, const fw_mechanism *m,
                             const fw_assembly_coordinate_choice *c, const char **text) {
    fw_text out = fw_text_new(arena);
    fw_text_add(&out, "");
    for (int i = 0; i < c->count; i++)
        fw_text_printf(&out, "%s%s.%s", i ? "," : "", name_of(m->body[c->item[i].body].id),
                       axis_name[c->item[i].axis]);
    *text = out.data;
    return fw_text_end(&out);
}

fw_status fw_assembly_independent_rows(fw_arena *arena, const fw_maths_singular *space, int rank,
                                       const fw_assembly_coordinate_choice *choice,
                                       fw_maths_singular *rows) {
    int f = choice->count, n = space->columns;
    double *part;
    FW_NEED(part = fw_arena_array(arena, double, (size_t)f *(size_t)f));
    for (int i = 0; i < f; i++)
        for (int k = 0; k < f; k++)
            part[i * f + k] =
                space->v[(rank + k) * n + 3 * choice->item[i].body + choice->item[i].axis];
    return fw_maths_singular_new(arena, f, f, part, rows);
}

/* v = N z with orthonormal N: |v| <= |v_I| / (smallest singular value of N_I) */
static fw_status measure(fw_arena *arena, const fw_maths_singular *space, int rank,
                         fw_assembly_coordinate_choice *c) {
    fw_maths_singular rows;
    c->condition = 1;
    if (c->count == 0) return FW_OK;
    FW_TRY(fw_assembly_independent_rows(arena, space, rank, c, &rows));
    double least = rows.sigma[c->count - 1];
    c->condition = least > 0 ? fmax(1, 1 / least) : (double)INFINITY;
    return FW_OK;
}

/* greedy pivoting on the rows of N (nq x f): the longest remainder wins; an angle wins over a
   longer one of at most twice its length, because that is what people turn. Source: QR with column
   pivoting, Golub and Van Loan, ch. 5.4. Test: test_kinematics.c. */
static fw_status pivot(fw_arena *arena, const fw_maths_singular *space, int rank,
                       fw_assembly_coordinate_choice *c) {
    int n = space->columns, f = n - rank;
    double *left; /* (n x f) */
    FW_NEED(left = fw_arena_array(arena, double, (size_t)n *(size_t)f));
    FW_NEED(c->item = fw_arena_array(arena, fw_assembly_coordinate, (size_t)f));
    c->count = f;
    c->automatic = true;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < f; k++)
            left[i * f + k] = space->v[(rank + k) * n + i];
    for (int take = 0; take < f; take++) {
        int best = -1;
        double most = 0, norm = 0;
        for (int i = 0; i < n; i++) {
            double square = 0;
            for (int k = 0; k < f; k++)
                square += left[i * f + k] * left[i * f + k];
            double weighed = square * (i % 3 == 2 ? 4 : 1);
            if (weighed > most * (1 + 1e-9)) most = weighed, norm = sqrt(square), best = i;
        }
        if (best < 0) return FW_SOLVER;
        c->item[take] = (fw_assembly_coordinate){best / 3, best % 3};
        double *row = left + best * f;
        for (int k = 0; k < f; k++)
            row[k] /= norm;
        for (int i = 0; i < n; i++) {
            double share = 0;
            if (i == best) continue;
            for (int k = 0; k < f; k++)
                share += left[i * f + k] * row[k];
            for (int k = 0; k < f; k++)
                left[i * f + k] -= share * row[k];
        }
        memset(row, 0, (size_t)f * sizeof *row);
    }
    for (int i = 1; i < f; i++) { /* in the order of the file */
        fw_assembly_coordinate one = c->item[i];
        int k = i;
        for (; k > 0 && 3 * c->item[k - 1].body + c->item[k - 1].axis > 3 * one.body + one.axis;
             k--)
            c->item[k] = c->item[k - 1];
        c->item[k] = one;
    }
    return measure(arena, space, rank, c);
}

/* ---- what the user asks for ---- */

static fw_status refuse(fw_status status) {
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

static fw_status unknown_name(fw_arena *arena, const fw_mechanism *m, const char *word,
                              const char *suggestion, fw_diags *diags) {
    const char **names;
    FW_NEED(names = fw_arena_array(arena, const char *, 3 * (size_t)m->nbody));
    for (int i = 0; i < 3 * m->nbody; i++)
        FW_NEED(names[i] =
                    fw_arena_printf(arena, "%s.%s", name_of(m->body[i / 3].id), axis_name[i % 3]));
    const char *near = fw_did_you_mean(word, names, 3 * (size_t)m->nbody);
    return refuse(fw_diag_error(diags, 117, (fw_place){0},
                                "there is no coordinate '%.80s'%s%s%s; write BODY.x, BODY.y or "
                                "BODY.phi, for example %s",
                                word, near ? "; did you mean " : "", near ? near : "",
                                near ? "?" : "", suggestion));
}

static bool find_coordinate(const fw_mechanism *m, const char *word, size_t n,
                            fw_assembly_coordinate *c) {
    for (int b = 0; b < m->nbody; b++)
        for (int axis = 0; axis < 3; axis++) {
            const char *id = name_of(m->body[b].id);
            size_t length = strlen(id);
            if (n == length + 1 + strlen(axis_name[axis]) && strncmp(word, id, length) == 0 &&
                word[length] == '.' &&
                strncmp(word + length + 1, axis_name[axis], strlen(axis_name[axis])) == 0) {
                *c = (fw_assembly_coordinate){b, axis};
                return true;
            }
        }
    return false;
}

static fw_status read_list(fw_arena *arena, const fw_mechanism *m, const char *asked,
                           const char *suggestion, fw_diags *diags,
                           fw_assembly_coordinate_choice *c) {
    FW_NEED(c->item = fw_arena_array(arena, fw_assembly_coordinate, strlen(asked) + 1));
    for (const char *at = asked; *at;) {
        size_t n = strcspn(at, ",");
        const char *next = at + n + (at[n] == ',');
        while (n > 0 && *at == ' ')
            at++, n--;
        while (n > 0 && at[n - 1] == ' ')
            n--;
        fw_assembly_coordinate *to = &c->item[c->count];
        if (!find_coordinate(m, at, n, to)) {
            const char *word = fw_arena_strndup(arena, at, n);
            FW_NEED(word);
            return unknown_name(arena, m, word, suggestion, diags);
        }
        for (int i = 0; i < c->count; i++)
            if (c->item[i].body == to->body && c->item[i].axis == to->axis)
                return refuse(fw_diag_error(diags, 117, (fw_place){0},
                                            "independent coordinate %s.%s is named twice",
                                            name_of(m->body[to->body].id), axis_name[to->axis]));
        c->count++;
        at = next;
    }
    return FW_OK;
}

static fw_status judge(const fw_assembly_coordinate_choice *c,
                       const fw_assembly_coordinate_choice *own, const char *asked,
                       fw_diags *diags) {
    char number[32];
    if (c->condition < hopeless) return FW_OK;
    return refuse(fw_diag_error(
        diags, 117, (fw_place){0},
        "%s cannot be independent coordinates here: their rates do not determine the motion "
        "(condition %s); %s can (condition %s)",
        asked,
        isfinite(c->condition) ? fw_number_text(number, sizeof number, c->condition, 2)
                               : "infinite",
        own->text, fw_number_text((char[32]){0}, 32, own->condition, 3)));
}

fw_status fw_assembly_independent_choose(fw_arena *arena, const fw_mechanism *mechanism,
                                         const fw_maths_singular *space, int rank,
                                         const char *asked, fw_diags *diags,
                                         fw_assembly_coordinate_choice *choice) {
    fw_assembly_coordinate_choice own = {0};
    FW_TRY(pivot(arena, space, rank, &own));
    FW_TRY(write_names(arena, mechanism, &own, &own.text));
    *choice = own;
    if (!asked || !*asked) return FW_OK;
    fw_assembly_coordinate_choice c = {0};
    FW_TRY(read_list(arena, mechanism, asked, own.count ? own.text : "AB.phi", diags, &c));
    if (c.count != own.count)
        return refuse(fw_diag_error(
            diags, 117, (fw_place){0},
            "the mechanism has %d degree%s of freedom, and %d independent coordinate%s named%s%s",
            own.count, own.count == 1 ? "" : "s", c.count, c.count == 1 ? " is" : "s are",
            own.count ? "; for example " : "", own.count ? own.text : ""));
    FW_TRY(write_names(arena, mechanism, &c, &c.text));
    FW_TRY(measure(arena, space, rank, &c));
    FW_TRY(judge(&c, &own, c.text, diags));
    if (own.condition * 10 < c.condition) c.better = own.text, c.better_condition = own.condition;
    *choice = c;
    return FW_OK;
}
