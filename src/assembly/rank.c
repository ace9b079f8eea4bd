/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can still move, and which rows of G say nothing new. */
#include "assembly/closure.h"
#include "maths/dense.h"
#include <math.h>
#include <string.h>

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
