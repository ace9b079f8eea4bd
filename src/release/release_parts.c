/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which pieces of a drawing are one part, and what the release must do with it. */
#include "release/release_field.h"
#include <math.h>

static bool joined(const fw_geometry_contour *p, const fw_geometry_contour *q) {
    for (int i = 0; i < p->count; i++) {
        const fw_geometry_segment *s = &p->segment[i];
        if (!(s->flags & FW_SEGMENT_JOINT)) continue;
        for (int k = 0; k < q->count; k++)
            if ((q->segment[k].flags & FW_SEGMENT_JOINT) &&
                ((vec_same(s->a, q->segment[k].b) && vec_same(s->b, q->segment[k].a)) ||
                 (vec_same(s->a, q->segment[k].a) && vec_same(s->b, q->segment[k].b))))
                return true;
    }
    return false;
}

static fw_release_duty duty_of(const fw_layout_piece *piece) {
    if (piece->role == FW_ROLE_TETHER) return FW_RELEASE_EITHER;
    return piece->role == FW_ROLE_FLEXURE || piece->body >= 0 ? FW_RELEASE_MOVES : FW_RELEASE_STAYS;
}

/* Pieces of one body are one part; each flexure is; the frame is. Bases and stators are by themselves,
   each with the caps that close cuts in it; so is every tether. */
static bool same_part(const fw_layout *layout, int i, int k) {
    const fw_layout_piece *p = &layout->piece[i], *q = &layout->piece[k];
    if (p->role != q->role || p->body != q->body || p->joint != q->joint) return false;
    if (p->role == FW_ROLE_TETHER) return false;
    return p->role == FW_ROLE_FRAME || p->body >= 0 || joined(&p->contour, &q->contour);
}

fw_status fw_release_parts(fw_arena *arena, const fw_layout *layout, bool islands, int **part_of,
                           fw_release_part **part, int *npart) {
    size_t n = (size_t)layout->npiece;
    *npart = 0;
    FW_NEED(*part_of = fw_arena_array(arena, int, n));
    FW_NEED(*part = fw_arena_array(arena, fw_release_part, n));
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        bool cleared = p->role == FW_ROLE_TEXT || p->role == FW_ROLE_MARK;
        (*part_of)[i] = cleared ? FW_RELEASE_OPENING : FW_RELEASE_MIXED;
        if (p->body == FW_ISLAND && !islands) (*part_of)[i] = FW_RELEASE_MIXED;
        if (p->role != FW_ROLE_STRUCTURE && p->role != FW_ROLE_FLEXURE &&
            p->role != FW_ROLE_FRAME && p->role != FW_ROLE_TETHER)
            continue;
        if ((p->body == FW_ISLAND && !islands) || p->body == FW_NONE - 1) continue;
        int which = -1;
        for (int k = 0; k < i && which < 0; k++)
            if ((*part_of)[k] >= 0 && same_part(layout, i, k)) which = (*part_of)[k];
        if (which < 0) {
            which = (*npart)++;
            const char *label = p->role == FW_ROLE_FRAME ? "frame" : p->label;
            (*part)[which] = (fw_release_part){.label = label,
                                               .duty = duty_of(p),
                                               .role = p->role,
                                               .body = p->body,
                                               .joint = p->joint,
                                               .piece = i,
                                               .kept_m = (double)NAN};
        }
        (*part_of)[i] = which;
        (*part)[which].area_m2 += fw_geometry_contour_area(&p->contour);
    }
    return FW_OK;
}

/* lettering lies within one part, and is taken out of its area */
static void take_lettering(const fw_release_field *f, const fw_layout *layout, const int *part_of,
                           fw_release_part *part) {
    for (int i = 0, first = 0; i < layout->npiece; i++) {
        const fw_geometry_contour *c = &layout->piece[i].contour;
        if (part_of[i] == FW_RELEASE_MIXED || c->count == 0) continue;
        if (part_of[i] >= 0) {
            first += c->count;
            continue;
        }
        if (f->edge[first].part >= 0)
            part[f->edge[first].part].area_m2 -= fw_geometry_contour_area(c);
        first += c->count;
    }
}

double fw_release_bonded(const fw_release_part *part, double reach_m) {
    double at = part->reach_m > 0.0 ? FW_RELEASE_STEPS * reach_m / part->reach_m : HUGE_VAL;
    if (!(at > 0.0)) return part->area_m2;
    if (at >= FW_RELEASE_STEPS) return 0.0;
    int k = (int)at;
    return part->bonded_m2[k] + (at - k) * (part->bonded_m2[k + 1] - part->bonded_m2[k]);
}

/* the reach at which the share is left, on the same straight lines */
static double kept(const fw_release_part *p, double share) {
    double want = share * p->area_m2;
    for (int k = 1; k <= FW_RELEASE_STEPS; k++) {
        double from = p->bonded_m2[k - 1], to = p->bonded_m2[k];
        if (to > want) continue;
        double part = from > to ? (from - want) / (from - to) : 0.0;
        return (k - 1 + part) * p->reach_m / FW_RELEASE_STEPS;
    }
    return p->reach_m;
}

static void find_window(fw_release *r) {
    r->slowest = r->weakest = -1;
    r->needed_m = r->lost_m = (double)NAN;
    for (int i = 0; i < r->npart; i++) {
        fw_release_part *p = &r->part[i];
        if (p->duty == FW_RELEASE_MOVES && (r->slowest < 0 || p->most_m > r->needed_m))
            r->slowest = i, r->needed_m = p->most_m;
        if (p->duty != FW_RELEASE_STAYS) continue;
        p->kept_m = kept(p, r->share);
        if (r->weakest < 0 || p->kept_m < r->lost_m) r->weakest = i, r->lost_m = p->kept_m;
    }
}

fw_status fw_release_solve(fw_arena *arena, const fw_layout *layout, bool islands, bool whole,
                           double share, const fw_release **release) {
    fw_release_field field;
    int *part_of;
    fw_release *r = fw_arena_one(arena, fw_release);
    FW_NEED(r);
    *release = r;
    r->share = share;
    FW_TRY(fw_release_parts(arena, layout, islands, &part_of, &r->part, &r->npart));
    for (int i = 0; whole && i < r->npart; i++)
        if (r->part[i].duty == FW_RELEASE_STAYS && r->part[i].body != FW_ISLAND)
            r->part[i].duty = FW_RELEASE_EITHER;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(fw_release_field_make(arena, layout, part_of, r->npart, &field));
    r->edges = field.nedge;
    fw_release_field_hosts(&field, layout, part_of);
    take_lettering(&field, layout, part_of, r->part);
    if (field.nedge > 0 && r->npart > 0) {
        FW_TRY(fw_release_field_start(&field));
        FW_TRY(fw_release_search(&field, r->part, &r->boxes));
        FW_TRY(fw_release_measure(&field, r->part));
    }
    fw_arena_rewind(arena, mark);
    find_window(r);
    return FW_OK;
}
