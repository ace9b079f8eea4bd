/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wavefront OBJ: every point of the grid twice, bottom and top, then the triangles, a group for
   each piece. 1 unit = 1 um. Pieces that meet share points. */
#include "mask/solid.h"
#include <stdlib.h>

typedef struct points { /* each once, in order */
    fw_point *at;
    size_t count;
} points;

static int by_place(const void *left, const void *right) {
    const fw_point *p = left, *q = right;
    if (p->x_dbu != q->x_dbu) return p->x_dbu < q->x_dbu ? -1 : 1;
    return (p->y_dbu > q->y_dbu) - (p->y_dbu < q->y_dbu);
}

static fw_status gather(fw_arena *arena, const fw_solid *solid, points *out) {
    size_t n = 0;
    for (int i = 0; i < solid->npiece; i++)
        n += (size_t)solid->piece[i].polygon.count;
    *out = (points){fw_arena_array(arena, fw_point, n), 0};
    FW_NEED(out->at);
    for (int i = 0; i < solid->npiece; i++)
        for (int k = 0; k < solid->piece[i].polygon.count; k++)
            out->at[out->count++] = solid->piece[i].polygon.vertex[k];
    qsort(out->at, n, sizeof *out->at, by_place);
    size_t kept = 0;
    for (size_t i = 0; i < n; i++)
        if (kept == 0 || by_place(&out->at[kept - 1], &out->at[i]) != 0)
            out->at[kept++] = out->at[i];
    out->count = kept;
    return FW_OK;
}

/* number of the point at the bottom; at the top one more */
static long number_of(const points *all, fw_point p) {
    const fw_point *found = bsearch(&p, all->at, all->count, sizeof p, by_place);
    return 2 * (found - all->at) + 1;
}

static void vertices(fw_text *out, const points *all, double top_um) {
    for (size_t i = 0; i < all->count; i++)
        for (int top = 0; top < 2; top++) {
            fw_text_add(out, "v ");
            fw_text_fixed(out, 1e-3 * all->at[i].x_dbu, 3);
            fw_text_add(out, " ");
            fw_text_fixed(out, 1e-3 * all->at[i].y_dbu, 3);
            fw_text_add(out, " ");
            fw_text_fixed(out, top ? top_um : 0, 6);
            fw_text_add(out, "\n");
        }
}

static void face(fw_text *out, long a, long b, long c) {
    fw_text_printf(out, "f %ld %ld %ld\n", a, b, c);
}

static fw_status piece(fw_text *out, fw_arena *arena, const fw_solid_piece *s, const points *all) {
    const fw_polygon *p = &s->polygon;
    long *id = fw_arena_array(arena, long, (size_t)p->count);
    FW_NEED(id);
    for (int i = 0; i < p->count; i++)
        id[i] = number_of(all, p->vertex[i]);
    fw_text_add(out, "g ");
    for (const char *c = s->shape->piece->label; *c; c++) /* a name has no spaces */
        fw_text_bytes(out, *c <= ' ' && *c >= 0 ? "_" : c, 1);
    fw_text_add(out, "\n");
    for (int i = 0; i < p->count - 2; i++) {
        const int *v = s->triangle[i].vertex;
        face(out, id[v[0]] + 1, id[v[1]] + 1, id[v[2]] + 1);
        face(out, id[v[0]], id[v[2]], id[v[1]]);
    }
    for (int i = 0; i < p->count; i++) {
        if (!s->wall[i]) continue;
        long a = id[i], b = id[i + 1 < p->count ? i + 1 : 0];
        face(out, a, b, b + 1);
        face(out, a, b + 1, a + 1);
    }
    return FW_OK;
}

fw_status fw_mask_write_obj(const fw_mask *mask, fw_text *out) {
    fw_solid solid;
    points all;
    FW_TRY(fw_mask_solid(out->arena, mask, &solid));
    FW_TRY(gather(out->arena, &solid, &all));
    fw_text_reserve(out, 64 * all.count + 24 * (size_t)solid.triangles + 4096);
    fw_text_printf(out, "# %sflexwright " FW_VERSION ", 1 unit = 1 um, %s\no %s\n",
                   mask->rejected ? "REJECTED, " : "",
                   mask->thickness_m > 0 ? "walls vertical" : "THICKNESS NOT KNOWN", mask->cell);
    vertices(out, &all, 1e6 * solid.thickness_m);
    for (int i = 0; i < solid.npiece; i++)
        FW_TRY(piece(out, out->arena, &solid.piece[i], &all));
    return fw_text_end(out);
}
