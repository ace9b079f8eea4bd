/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which pieces of a drawing are one part, what the release must do with it, and what holds the bodies on the way. */
#include "base/text.h"
#include "geometry/segment.h"
#include "release/release.h"
#include "release/release_field.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    r->own = r->npart;
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

/* ---- what holds each body while the etch proceeds, and what it hangs on when nothing of it is bonded ----
   A part is bonded until its worst point is free (most_m). When a body lets go, it hangs on the nearest
   parts that are still bonded, through flexures and bodies that are free already; on bases at their
   ground hinges; and on tethers. Bodies that flexures join are one mechanism: it hangs on its anchors
   alone from when the last of its own parts lets go. In: a layout and its distances (m). Out: reaches
   (m) as drawn. Error: that of the distances. Cost: bodies times hinges. Theory: docs/theory/release.md.
   Test: test_hold.c */

typedef struct holder {
    fw_arena *arena;
    const fw_device *device;
    const fw_layout *layout;
    const fw_release *release;
    bool *seen; /* (nbody) of one walk */
} holder;

static const fw_release_part *part_of(const holder *h, fw_layout_role role, int body, int joint) {
    for (int i = 0; i < h->release->npart; i++) {
        const fw_release_part *p = &h->release->part[i];
        if (p->role == role && p->body == body && (role != FW_ROLE_FLEXURE || p->joint == joint))
            return p;
    }
    return NULL;
}

static const fw_release_part *flexure_of(const holder *h, int joint) {
    for (int i = 0; i < h->release->npart; i++)
        if (h->release->part[i].role == FW_ROLE_FLEXURE && h->release->part[i].joint == joint)
            return &h->release->part[i];
    return NULL;
}

static double free_m(const fw_release_part *p) {
    return p ? p->most_m : 0.0;
}

/* the ground hinge's own base: the one whose outline comes nearest to the hinge's centre */
static const fw_release_part *base_of(const holder *h, int joint) {
    const fw_release_part *best = NULL;
    double least = HUGE_VAL;
    for (int i = 0; i < h->release->npart; i++) {
        const fw_release_part *p = &h->release->part[i];
        if (p->role != FW_ROLE_STRUCTURE || p->body != FW_GROUND || p->piece < 0) continue;
        const fw_geometry_contour *c = &h->layout->piece[p->piece].contour;
        for (int k = 0; k < c->count; k++) {
            double t;
            fw_geometry_vec2 on;
            double far = fw_geometry_segment_nearest(&c->segment[k], h->layout->hinge[joint].centre,
                                                     &t, &on);
            if (far < least) least = far, best = p;
        }
    }
    return best;
}

static fw_status add(holder *h, fw_release_body_hold *out, const char *name) {
    size_t n = (size_t)out->nby;
    FW_NEED(name);
    out->holders++;
    FW_NEED(out->by = fw_arena_grow(h->arena, out->by, n, n + 1, sizeof *out->by));
    out->by[out->nby++] = name;
    return FW_OK;
}

static fw_status add_tethers(holder *h, int body, fw_release_body_hold *out) {
    const fw_layout *l = h->layout;
    const char *label = NULL;
    int n = 0;
    for (int i = 0; i < l->ntether; i++)
        if (l->tether[i].body == body) label = l->tether[i].label, n++;
    if (n == 0) return FW_OK;
    FW_TRY(add(h, out,
               n == 1 ? label
                      : fw_arena_printf(h->arena, "%d tethers%s", n, label + strlen("tether"))));
    out->holders += n - 1;
    return FW_OK;
}

/* everything bonded that a body reaches after reach_m, through what is free */
static fw_status walk(holder *h, int body, double reach_m, fw_release_body_hold *out) {
    const fw_layout *l = h->layout;
    if (h->seen[body]) return FW_OK;
    h->seen[body] = true;
    FW_TRY(add_tethers(h, body, out));
    for (int j = 0; j < h->device->nrevolute; j++) {
        const fw_layout_hinge_layout *x = &l->hinge[j];
        int other = x->lower == body ? x->upper : x->lower;
        const fw_release_part *strip = flexure_of(h, j), *next;
        if (!x->drawn || (x->lower != body && x->upper != body)) continue;
        if (free_m(strip) > reach_m) {
            FW_TRY(add(h, out, strip->label));
            continue;
        }
        if (other == FW_GROUND) {
            FW_TRY(
                add(h, out, fw_arena_printf(h->arena, "base at %s%s", FW_NAMED("hinge", x->id))));
            continue;
        }
        next = part_of(h, FW_ROLE_STRUCTURE, other, FW_NONE);
        if (free_m(next) > reach_m)
            FW_TRY(add(h, out, next->label));
        else
            FW_TRY(walk(h, other, reach_m, out));
    }
    return FW_OK;
}

/* bodies that flexures join to this one get its group */
static void spread(const holder *h, int *group, int of) {
    for (bool again = true; again;) {
        again = false;
        for (int j = 0; j < h->device->nrevolute; j++) {
            const fw_layout_hinge_layout *x = &h->layout->hinge[j];
            if (!x->drawn || x->lower < 0 || x->upper < 0) continue;
            if ((group[x->lower] == of) == (group[x->upper] == of)) continue;
            group[x->lower] = group[x->upper] = of;
            again = true;
        }
    }
}

/* the anchors of a mechanism, and which of them keeps its bond longest */
static fw_status anchors(holder *h, const int *group, int of, fw_release_group_hold *out) {
    const fw_layout *l = h->layout;
    fw_text text = fw_text_new(h->arena);
    const fw_release_part *frame = part_of(h, FW_ROLE_FRAME, FW_GROUND, FW_NONE);
    out->last_anchor_m = -HUGE_VAL;
    for (int j = 0; j < h->device->nrevolute; j++) {
        const fw_layout_hinge_layout *x = &l->hinge[j];
        int body = x->lower == FW_GROUND ? x->upper : x->upper == FW_GROUND ? x->lower : FW_NONE;
        if (!x->drawn || body < 0 || group[body] != of) continue;
        const fw_release_part *base = base_of(h, j);
        fw_text_printf(&text, "%shinge %s", out->ground_hinges++ ? ", " : "", x->id);
        if (base && base->most_m > out->last_anchor_m)
            out->last_anchor_m = base->most_m, out->last_anchor = base->label;
    }
    for (int i = 0; i < l->ntether; i++)
        out->tethers += group[l->tether[i].body] == of;
    if (out->tethers > 0 && frame && frame->most_m > out->last_anchor_m)
        out->last_anchor_m = frame->most_m, out->last_anchor = "frame, by the tethers";
    if (!out->last_anchor) out->last_anchor_m = (double)NAN;
    FW_TRY(fw_text_end(&text));
    out->at = text.length ? text.data : "";
    return FW_OK;
}

static void own_bonds(const holder *h, const int *group, int of, fw_release_group_hold *out) {
    for (int i = 0; i < h->release->npart; i++) {
        const fw_release_part *p = &h->release->part[i];
        int body = p->body;
        if (p->duty != FW_RELEASE_MOVES) continue;
        if (p->role == FW_ROLE_FLEXURE && body < 0) { /* of a ground hinge: the body's */
            const fw_layout_hinge_layout *x = &h->layout->hinge[p->joint];
            body = x->lower >= 0 ? x->lower : x->upper;
        }
        if (body < 0 || group[body] != of || p->most_m <= out->hangs_m) continue;
        out->hangs_m = p->most_m;
        out->last_bond = p->label;
    }
}

static int by_reach(const void *a, const void *b) {
    const fw_release_body_hold *p = a, *q = b;
    if (p->free_m != q->free_m) return p->free_m < q->free_m ? -1 : 1;
    return (p->body > q->body) - (p->body < q->body);
}

fw_status fw_release_hold_find(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_release *release, const fw_release_hold **out) {
    holder h = {.arena = arena, .device = device, .layout = layout, .release = release};
    size_t n = (size_t)device->nbody;
    fw_release_hold *found = fw_arena_one(arena, fw_release_hold);
    int *group = fw_arena_array(arena, int, n);
    FW_NEED(found && group ? found : NULL);
    FW_NEED(h.seen = fw_arena_array(arena, bool, n));
    FW_NEED(found->body = fw_arena_array(arena, fw_release_body_hold, n));
    FW_NEED(found->group = fw_arena_array(arena, fw_release_group_hold, n));
    for (int b = 0; b < device->nbody; b++)
        group[b] = FW_NONE;
    for (int b = 0; b < device->nbody; b++) {
        const fw_release_part *p = part_of(&h, FW_ROLE_STRUCTURE, b, FW_NONE);
        if (!p) continue;
        if (group[b] == FW_NONE) {
            fw_release_group_hold *g = &found->group[found->ngroup];
            group[b] = found->ngroup++;
            spread(&h, group, group[b]);
            own_bonds(&h, group, group[b], g);
            FW_TRY(anchors(&h, group, group[b], g));
        }
        fw_release_body_hold *own = &found->body[found->nbody++];
        *own = (fw_release_body_hold){
            .body = b, .group = group[b], .label = p->label, .free_m = p->most_m};
        for (size_t i = 0; i < n; i++)
            h.seen[i] = false;
        FW_TRY(walk(&h, b, own->free_m, own));
    }
    qsort(found->body, (size_t)found->nbody, sizeof *found->body, by_reach);
    *out = found;
    return FW_OK;
}
