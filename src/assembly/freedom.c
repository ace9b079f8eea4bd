/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can still move: degrees of freedom, rows of G that say nothing new, and coordinates that can be given freely. */
#include "assembly/closure.h"
#include "assembly/assembly.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

/* ---- how many, and the rows that are redundant ---- */

static const double threshold = 1e-10; /* of sigma, relative: the gap found there is reported */

/* file order: pins, joints, drivers */
static int file_place(const fw_multibody_model *m, const fw_multibody_block *b) {
    if (b->pin != FW_NONE) return b->pin;
    return b->joint != FW_NONE ? m->npin + b->joint : m->npin + m->njoint + b->driver;
}

static fw_status block_of_rows(fw_arena *arena, const fw_multibody_model *m, int **block) {
    FW_NEED(*block = fw_arena_array(arena, int, (size_t)m->rows));
    for (int i = 0, row = 0; i < m->nblock; i++) {
        fw_multibody_rows kind = m->block[i].rows;
        (*block)[row++] = i;
        if (kind == FW_ROWS_PIN || kind == FW_ROWS_SLIDE) (*block)[row++] = i;
    }
    return FW_OK;
}

/* rows in file order, each less its share in those before (twice, for orthogonality); `left` is
   what remains of its length, 1 = all new. Cost rows^2 unknowns. */
static void remainders(const fw_multibody_model *m, const int *block, int *order, double *g,
                       double *left) {
    size_t n = (size_t)m->nq;
    for (int i = 0; i < m->rows; i++) {
        int k = i; /* insertion by file place keeps both rows of a block together */
        for (; k > 0 &&
               file_place(m, &m->block[block[order[k - 1]]]) > file_place(m, &m->block[block[i]]);
             k--)
            order[k] = order[k - 1];
        order[k] = i;
    }
    for (int i = 0; i < m->rows; i++) {
        double *row = g + (size_t)order[i] * n, before = 0, after = 0;
        for (size_t c = 0; c < n; c++)
            before += row[c] * row[c];
        for (int pass = 0; pass < 2; pass++)
            for (int k = 0; k < i; k++) {
                const double *other = g + (size_t)order[k] * n;
                double share = 0;
                for (size_t c = 0; c < n; c++)
                    share += row[c] * other[c];
                for (size_t c = 0; c < n; c++)
                    row[c] -= share * other[c];
            }
        for (size_t c = 0; c < n; c++)
            after += row[c] * row[c];
        left[i] = before > 0 ? sqrt(after / before) : 0;
        bool nothing = left[i] < 1e-9;
        for (size_t c = 0; c < n; c++)
            row[c] = nothing ? 0 : row[c] / sqrt(after);
    }
}

/* the rows with least left are the redundant ones; their joints are named once each */
static fw_status name_redundant(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_multibody_model *m, double *g,
                                fw_assembly_rank_result *out) {
    int *block, *order;
    double *left;
    FW_TRY(block_of_rows(arena, m, &block));
    FW_NEED(order = fw_arena_array(arena, int, (size_t)m->rows));
    FW_NEED(left = fw_arena_array(arena, double, (size_t)m->rows));
    FW_NEED(out->redundant = fw_arena_array(arena, const char *, (size_t)m->rows));
    remainders(m, block, order, g, left);
    for (int need = m->rows - out->rank; need > 0; need--) {
        int least = -1;
        for (int i = 0; i < m->rows; i++)
            if (left[i] >= 0 && (least < 0 || left[i] < left[least])) least = i;
        left[least] = -1; /* taken */
    }
    for (int i = 0, last = -1; i < m->rows; i++) {
        int here = file_place(m, &m->block[block[order[i]]]);
        if (left[i] < 0 && here != last)
            out->redundant[out->nredundant++] =
                fw_multibody_block_name(mechanism, &m->block[block[order[i]]]);
        if (left[i] < 0) last = here;
    }
    return FW_OK;
}

/* dof = unknowns - rank(G), G scaled at q (3 nbody, SI). The rank is where the singular values drop
   below 1e-10 of the largest; both neighbours of the drop are handed out, so that nobody has to
   believe it. statics/ has its own (fw_statics_equilibrium_rank says why). Cost of a singular value
   decomposition. Test: test_assemble.c. */
fw_status fw_assembly_rank(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                           fw_diags *diags, fw_assembly_rank_result *out) {
    const fw_multibody_model *m;
    fw_multibody_system *system;
    double *g, *still;
    fw_maths_singular s;
    FW_TRY(fw_multibody_model_new(arena, mechanism, NULL, q, 1, NULL, &m));
    FW_TRY(fw_multibody_system_new(arena, m, mechanism, diags, &system));
    *out = (fw_assembly_rank_result){
        .unknowns = m->nq, .rows = m->rows, .rank = m->rows, .clear = true};
    out->dof = m->nq - m->rows;
    if (m->nq > FW_RANK_MOST || m->rows > 2 * FW_RANK_MOST) return FW_OK;
    FW_NEED(still = fw_arena_array(arena, double, (size_t)m->nq));
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(g = fw_arena_array(arena, double, (size_t)m->rows *(size_t)m->nq));
    const fw_multibody_pose *pose = fw_multibody_pose_at(system, 0, still);
    fw_multibody_dense_jacobian(m, pose, g);
    FW_TRY(fw_maths_singular_new(arena, m->rows, m->nq, g, &s));
    int least = m->rows < m->nq ? m->rows : m->nq, rank = 0;
    while (rank < least && s.sigma[rank] > threshold * s.sigma[0])
        rank++;
    out->known = true;
    out->rank = rank;
    out->dof = m->nq - rank;
    out->kept = rank > 0 ? s.sigma[rank - 1] / s.sigma[0] : 0;
    out->dropped = rank < least ? s.sigma[rank] / s.sigma[0] : 0;
    out->clear = out->kept >= 1e4 * out->dropped && (rank == 0 || out->kept > 1e-6);
    fw_arena_rewind(arena, mark);
    if (rank == m->rows) return FW_OK;
    FW_NEED(g = fw_arena_array(arena, double, (size_t)m->rows *(size_t)m->nq));
    fw_multibody_dense_jacobian(m, pose, g);
    return name_redundant(arena, mechanism, m, g, out);
}

/* ---- the coordinates that can be given freely: independent rows of the null space of G ---- */

static const double hopeless = 1e8; /* condition from which a choice is refused */
static const char *const axis_name[] = {"x", "y", "phi"};

static fw_status write_names(fw_arena *arena, const fw_mechanism *m,
                             const fw_assembly_coordinate_choice *c, const char **text) {
    fw_text out = fw_text_new(arena);
    fw_text_add(&out, "");
    for (int i = 0; i < c->count; i++)
        fw_text_printf(&out, "%s%s.%s", i ? "," : "", fw_text_name(m->body[c->item[i].body].id),
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
        FW_NEED(names[i] = fw_arena_printf(arena, "%s.%s", fw_text_name(m->body[i / 3].id),
                                           axis_name[i % 3]));
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
            const char *id = fw_text_name(m->body[b].id);
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
                return refuse(fw_diag_error(
                    diags, 117, (fw_place){0}, "independent coordinate %s.%s is named twice",
                    fw_text_name(m->body[to->body].id), axis_name[to->axis]));
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
