/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a body gives where something acts on it beside its hinges: c (3 x 3) of (M, Fx, Fy) at the place, by which that turns and goes
   against the body's middle. With C of the body as a plane solid (body_solid.c),

     c = B^T C B/(E h),   B = (unit wrench at the place, what the middle puts against it)

   The middle is held on most of the circle inscribed about it. What gives between it and the body's hinges is in the bands
   (verdict/verdict_bending.c). c goes to the place's elements (effects/body_compliance.c).

   Only places count that give something: c k above 1/500 by the circles of a straight way to the middle (walk), k the
   stiffness of what acts there. And none where something else acts on the same body of which the place would feel more
   than a tenth: what one load does at another's place is in no motion. In: outlines of the layout in the drawn pose.
   Error: between meshes, and the directions of a crystal; stated as `off`.
   Range: bodies that nothing but flexures, and no joint or guide, holds; to first order. Cost: none where nothing gives;
   else some 0.05 s a body. Test: test_effects.py SlenderArms. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "maths/matrix.h"
#include "mechanism/mechanism.h"
#include <math.h>
#include <string.h>

/* ---- where loads act ---- */

typedef struct ends {
    const fw_mechanism *m;
    fw_mechanism_load_end *end;
    int n, scene;
} ends;

static void add_end(ends *to, int body, double x_m, double y_m, double known_N,
                    double stiff_N_per_m, const char *what, const char *id) {
    const double same_m = 1e-9;
    if (body == FW_GROUND) return;
    const fw_geometry_vec2 at = fw_mechanism_local_place(to->m, body, x_m, y_m);
    int first = 0;
    while (first < to->n &&
           (to->end[first].body != body || vec_distance(to->end[first].at, at) > same_m))
        first++;
    to->end[to->n++] =
        (fw_mechanism_load_end){.scene = to->scene,
                                .body = body,
                                .first = first,
                                .x_m = x_m,
                                .y_m = y_m,
                                .at = at,
                                .known_N = known_N,
                                .stiff_N_per_m = stiff_N_per_m > 0 ? stiff_N_per_m : 0,
                                .what = what,
                                .id = id};
}

/* in the bar behind the fingers, or in the rotor's face: fingers bear their own shares only */
static void add_rotor(ends *to, const fw_device_comb *c) {
    const double length = isnan(c->length_m) ? 2 * c->overlap_m : c->length_m;
    const double back =
        c->kind == FW_ELECTRODES_COMB ? length - 0.5 * c->overlap_m + 0.5 * FW_FINGER_WIDTH_M : 0;
    const double stator = c->body_a == FW_GROUND ? 0 : to->m->drawn[c->body_a].phi_rad,
                 turn = c->direction_rad + stator - to->m->drawn[c->body_b].phi_rad;
    add_end(to, c->body_b, c->bx_m - back * cos(turn), c->by_m - back * sin(turn), (double)NAN, 0,
            "comb drive", c->id);
}

static void add_scene(ends *to, const fw_device_scene *s) {
    const double by = s->duration_s;
    for (int i = 0; i < s->nforce; i++) {
        const fw_device_force *f = &s->force[i];
        const int before = to->n;
        add_end(to, f->body, f->x_m, f->y_m,
                hypot(f->fx_N, f->fy_N) * fw_quantity_law_largest(f->law, by), 0, "force", NULL);
        if (to->n > before) to->end[before].force = f;
    }
    for (int i = 0; i < s->ntendon; i++) {
        const fw_device_tendon *t = &s->tendon[i];
        for (int k = 0; k < t->neyelet; k++) /* a cable that passes pulls from two sides */
            add_end(to, t->eyelet[k].body, t->eyelet[k].x_m, t->eyelet[k].y_m,
                    t->pull_N * fw_quantity_law_largest(t->law, by) *
                        (k > 0 && k + 1 < t->neyelet ? 2 : 1),
                    t->stiffness_N_per_m * (k > 0 && k + 1 < t->neyelet ? 4 : 1),
                    "eyelet of tendon", t->id);
    }
    for (int i = 0; i < s->ncomb; i++)
        add_rotor(to, &s->comb[i]);
    for (int i = 0; i < s->ncontact; i++) {
        const fw_device_contact_use *c = &s->contact[i];
        if (c->joint != FW_NONE) continue;
        add_end(to, c->body_a, c->ax_m, c->ay_m, (double)NAN, c->stiffness_N_per_m, "contact",
                c->id);
        add_end(to, c->body_b, c->bx_m, c->by_m, (double)NAN, c->stiffness_N_per_m, "contact",
                c->id);
    }
    for (int i = 0; i < to->m->nspring; i++) {
        const fw_device_spring *k = &to->m->spring[i];
        add_end(to, k->body_a, k->ax_m, k->ay_m, (double)NAN, k->stiffness_N_per_m, "spring",
                k->id);
        add_end(to, k->body_b, k->bx_m, k->by_m, (double)NAN, k->stiffness_N_per_m, "spring",
                k->id);
    }
}

fw_status fw_mechanism_load_ends(fw_arena *arena, const fw_mechanism *m,
                                 fw_mechanism_load_end **end, int *n) {
    const fw_device *d = m->device;
    const int scenes = d ? d->nscene : 0; /* a mechanism alone has none */
    size_t most = d ? (size_t)d->nprobe : 0;
    for (int i = 0; i < scenes; i++) {
        const fw_device_scene *s = &d->scene[i];
        most += (size_t)(s->nforce + s->ncomb + 2 * s->ncontact + 2 * m->nspring);
        for (int k = 0; k < s->ntendon; k++)
            most += (size_t)s->tendon[k].neyelet;
    }
    ends to = {.m = m};
    FW_NEED(to.end = fw_arena_array(arena, fw_mechanism_load_end, most));
    for (int i = 0; i < scenes; i++) {
        to.scene = i;
        if (fw_device_in_flow(d->scene[i].flow, m->variant->flow)) add_scene(&to, &d->scene[i]);
    }
    to.scene = FW_NONE; /* where a small force is to tell how stiff the device is */
    for (int i = 0; d && i < d->nprobe; i++)
        if (fw_device_probe_kinds[d->probe[i].row].takes == FW_PROBE_TANGENT)
            add_end(&to, d->probe[i].body, d->probe[i].x_m, d->probe[i].y_m, 0, 0, "probe",
                    d->probe[i].id);
    *end = to.end, *n = to.n;
    return FW_OK;
}

/* ---- straight ways ---- */

enum { WALK_STEPS = 200 };

fw_status fw_mechanism_edges_of(fw_arena *arena, const fw_layout *layout, int body,
                                fw_mechanism_edges *to) {
    *to = (fw_mechanism_edges){.body = body};
    fw_mechanism_line *line;
    int n;
    FW_TRY(fw_mechanism_body_lines(arena, layout, body, &line, &n));
    FW_TRY(fw_geometry_lines_new(arena, n, &to->all));
    FW_TRY(fw_geometry_lines_new(arena, n, &to->near));
    FW_NEED(to->off = fw_arena_array(arena, double, (size_t)n + FW_GEOMETRY_LINES_TOGETHER));
    for (int i = 0; i < n; i++)
        if (line[i].edge)
            fw_geometry_lines_add(&to->all, line[i].a.x, line[i].a.y, line[i].b.x, line[i].b.y);
    return FW_OK;
}

static bool is_inside(const fw_layout *layout, int body, fw_geometry_vec2 at) {
    for (int i = 0; i < layout->npiece; i++)
        if (fw_mechanism_is_of(&layout->piece[i], body) &&
            fw_geometry_contour_contains(&layout->piece[i].contour, at))
            return true;
    return false;
}

static void look_around(fw_mechanism_edges *e, fw_geometry_vec2 at) {
    const double free = sqrt(fw_geometry_lines_least_square(&e->all, at, e->off));
    e->centre = at, e->reach = 4 * free, e->near.n = 0;
    for (int i = 0; i < e->all.n; i++)
        if (e->off[i] <= e->reach * e->reach)
            fw_geometry_lines_add(&e->near, e->all.ax[i], e->all.ay[i], e->all.bx[i], e->all.by[i]);
}

/* distance to the nearest edge, and the direction away from it */
static double free_at(fw_mechanism_edges *e, fw_geometry_vec2 at, fw_geometry_vec2 *away) {
    double least = fw_geometry_lines_least_square(&e->near, at, e->off), t;
    if (!(sqrt(least) + vec_distance(at, e->centre) < e->reach)) {
        look_around(e, at);
        least = fw_geometry_lines_least_square(&e->near, at, e->off);
    }
    int i = 0;
    while (i + 1 < e->near.n && e->off[i] != least)
        i++;
    const fw_geometry_vec2 a = {e->near.ax[i], e->near.ay[i]}, b = {e->near.bx[i], e->near.by[i]};
    *away = vec_unit(vec_sub(at, vec_line_foot(a, b, at, &t)));
    return sqrt(least);
}

/* From circle to circle towards the middle and away from the nearest edge, each begun inside the one before, so that
   no edge lies between them */
bool fw_mechanism_walk(const fw_layout *layout, fw_mechanism_edges *edge, fw_geometry_vec2 pin,
                       fw_geometry_vec2 root, const fw_mechanism_walker *walker) {
    const double step = 0.7, sideways = 0.7;
    const fw_geometry_vec2 middle = layout->body[edge->body].centroid;
    fw_geometry_vec2 at = root, away;
    double free = free_at(edge, root, &away), left = vec_distance(root, middle);
    const double length = left,
                 begins = 0.02 * length; /* the flexure's own root is in its closed form */
    double gone = 0;
    bool known = length > 0;
    away = vec_unit(vec_sub(root, pin));
    for (int i = 0; known && left > 0; i++) {
        const fw_geometry_vec2 to_middle = vec_scale(1 / left, vec_sub(middle, at)),
                               way = vec_unit(vec_add(to_middle, vec_scale(sideways, away)));
        const bool last = left < step * free;
        fw_geometry_vec2 to = last ? middle : vec_along(at, step * free, way), beside;
        double there = free_at(edge, to, &away);
        if (there < free && !last) { /* off the crest */
            const fw_geometry_vec2 on = vec_along(to, 0.6 * (free - there), away);
            const double more = free_at(edge, on, &beside);
            if (more > there) to = on, there = more, away = beside;
        }
        known =
            i < WALK_STEPS && there > 1e-3 * length && (i > 0 || is_inside(layout, edge->body, to));
        const fw_geometry_vec2 half = vec_along(at, 0.5, vec_sub(to, at));
        if (gone > begins) {
            walker->add(walker->to, at, at, half, 2 * free);
            walker->add(walker->to, to, half, to, 2 * there);
        }
        gone += vec_distance(at, to);
        at = to, free = there, left = last ? 0 : vec_distance(at, middle);
    }
    return known;
}

/* ---- what may be worth a solid ---- */

enum {
    PLACES = 12, /* of one body: more are left to bounds */
    FEW = 600    /* cells */
};
static const double fw_hardly_gives = 0.002, fw_felt_elsewhere = 0.1;

typedef struct
    way { /* of a unit force at its end, along x and y, times E h; and the directions that it bends along */
    fw_geometry_vec2 place;
    double xx, yy;
    double narrow_m;
    double turned_rad, bent, bent_cos4; /* [100] from +x; weights of cos 4 psi */
} way;

static void add_to_way(void *to, fw_geometry_vec2 at, fw_geometry_vec2 from, fw_geometry_vec2 until,
                       double wide_m) {
    way *s = to;
    const double length = vec_distance(from, until), w3 = wide_m * wide_m * wide_m;
    if (!(length > 0)) return;
    const fw_geometry_vec2 r = vec_sub(at, s->place), along = vec_sub(until, from);
    const double shear = 3.2 * length / wide_m, bent = 12 * length * vec_dot(r, r) / w3;
    s->xx += 12 * length * r.y * r.y / w3 + shear;
    s->yy += 12 * length * r.x * r.x / w3 + shear;
    s->bent += bent;
    s->narrow_m = fmin(s->narrow_m, wide_m);
    s->bent_cos4 += bent * cos(4 * (atan2(along.y, along.x) - s->turned_rad));
}

typedef struct candidate {
    int end; /* of the load ends, the first at its place */
    bool straight;
    way way;
} candidate;

/* stiffest thing that acts there, as it feels the place: a cable that passes pulls from two sides */
static double stiffest_at(const fw_mechanism_load_end *end, int n, int first) {
    double most = 0;
    for (int k = first; k < n; k++)
        if (end[k].first == first) most = fmax(most, end[k].stiff_N_per_m);
    return most;
}

static double stiff_N(const fw_mechanism *m) {
    return m->variant->material.youngs.value * m->variant->thickness_m;
}

/* the places of a body at which things act whose force goes by how they move; *n 0: none of them gives enough to count */
static fw_status find_candidates(fw_arena *arena, const fw_mechanism *m, int body,
                                 const fw_mechanism_load_end *end, int nend, candidate *found,
                                 int *n, double *free_m) {
    fw_mechanism_edges edges = {.all = {.n = 0}};
    fw_geometry_vec2 away;
    *n = 0, *free_m = 0;
    for (int k = 0; k < nend; k++) {
        if (end[k].body != body || end[k].first != k) continue;
        const double stiff = stiffest_at(end, nend, k);
        if (!(stiff > 0)) continue;
        if (edges.all.n == 0) FW_TRY(fw_mechanism_edges_of(arena, m->layout, body, &edges));
        candidate c = {.end = k,
                       .way = {.place = end[k].at,
                               .narrow_m = HUGE_VAL,
                               .turned_rad = m->variant->orientation_rad}};
        const fw_mechanism_walker walker = {add_to_way, &c.way};
        c.straight =
            edges.all.n > 0 && fw_mechanism_walk(m->layout, &edges, end[k].at, end[k].at, &walker);
        const bool hardly =
            c.straight && fmax(c.way.xx, c.way.yy) * stiff / stiff_N(m) < fw_hardly_gives;
        if (!hardly && *n < PLACES) found[(*n)++] = c;
    }
    const fw_geometry_vec2 middle = m->layout->body[body].centroid;
    if (*n > 0 && is_inside(m->layout, body, middle)) *free_m = free_at(&edges, middle, &away);
    return FW_OK;
}

/* nothing but flexures hold it */
static bool on_flexures(const fw_mechanism *m, int body) {
    for (int i = 0; i < m->njoint; i++)
        if (m->joint[i].body_a == body || m->joint[i].body_b == body) return false;
    for (int j = 0; j < m->npin; j++)
        if ((m->pin[j].body_a == body || m->pin[j].body_b == body) && m->pin[j].hinge == FW_NONE)
            return false;
    return true;
}

/* ---- what they give ---- */

typedef struct
    held { /* a body as a solid: hinges, the middle, then every place at which something acts */
    const fw_mechanism *m;
    int body, nhinge, n;
    fw_mechanism_solid_end *end; /* (n) */
    int *load;                   /* (n) of the load ends, from nhinge + 1 on */
    fw_mechanism_solid solid;
    double *wrench, *other; /* (3n) */
} held;

static fw_status solid_of_body(fw_arena *arena, held *h, const fw_mechanism_load_end *end, int nend,
                               double narrow_m, double reach_m, int cells) {
    const fw_mechanism *m = h->m;
    const size_t most = 2 * (size_t)m->nhinge + 1 + (size_t)nend;
    fw_mechanism_line *line;
    int nline;
    FW_NEED(h->end = fw_arena_array(arena, fw_mechanism_solid_end, most));
    FW_NEED(h->load = fw_arena_array(arena, int, most));
    for (int i = 0; i < 2 * m->nhinge; i++) {
        fw_mechanism_solid_end here = {0};
        if (fw_mechanism_hinge_end(m, h->body, i, &here.pin, &here.root)) h->end[h->n++] = here;
    }
    h->nhinge = h->n;
    const fw_geometry_vec2 middle = m->layout->body[h->body].centroid;
    h->end[h->n++] = (fw_mechanism_solid_end){
        .pin = middle, .root = middle, .nearest = true, .reach_m = reach_m};
    for (int k = 0; k < nend; k++)
        if (end[k].body == h->body && end[k].first == k && h->n < h->nhinge + 1 + PLACES) {
            h->load[h->n] = k;
            h->end[h->n++] = (fw_mechanism_solid_end){.pin = end[k].at, .root = end[k].at};
        }
    FW_TRY(fw_mechanism_body_lines(arena, m->layout, h->body, &line, &nline));
    const fw_mechanism_solid_mesh as = {.middle = middle,
                                        .narrow_m = narrow_m,
                                        .edge_m = m->layout->edge_m,
                                        .cells = cells,
                                        .area_m2 = m->layout->body[h->body].area_m2,
                                        .close = true};
    FW_TRY(fw_mechanism_solid_of(arena, line, nline, &as, h->end, h->n, &h->solid));
    FW_NEED(h->wrench = fw_arena_array(arena, double, 6 * (size_t)h->n));
    h->other = h->wrench + 3 * (size_t)h->n;
    return FW_OK;
}

/* w += what the middle puts against the unit wrench `k` at a place */
static void balance(const held *h, fw_geometry_vec2 at, int k, double *w) {
    const int by = h->nhinge;
    const fw_geometry_vec2 r = vec_sub(at, h->end[by].pin);
    w[3 * by] -= (k == 0) + r.x * (k == 2) - r.y * (k == 1);
    w[3 * by + 1] -= k == 1, w[3 * by + 2] -= k == 2;
}

static double work(const held *h, const double *c, const double *a, const double *b) {
    const int rows = 3 * h->n;
    double sum = 0;
    for (int i = 0; i < rows; i++)
        for (int j = 0; a[i] != 0 && j < rows; j++)
            sum += a[i] * c[i * rows + j] * b[j];
    return sum;
}

/* c (3 x 3) between two of its ends, of one mesh, times E h, world axes */
static void give_between(const held *h, const double *mesh, int a, int b, double *c) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            memset(h->wrench, 0, 6 * (size_t)h->n * sizeof *h->wrench);
            balance(h, h->end[a].pin, i, h->wrench);
            balance(h, h->end[b].pin, j, h->other);
            h->wrench[3 * a + i] += 1, h->other[3 * b + j] += 1;
            c[3 * i + j] = work(h, mesh, h->wrench, h->other);
        }
}

/* of forces */
static double size_of(const double *c) {
    return hypot(hypot(c[4], c[5]), hypot(c[7], c[8]));
}

static double apart(const double *a, const double *b) {
    double by[9];
    for (int i = 0; i < 9; i++)
        by[i] = a[i] - b[i];
    return size_of(by);
}

/* would it feel what acts elsewhere on the body, or something else at the same place? */
static bool feels_others(const held *h, const fw_mechanism_load_end *end, int nend, int at,
                         double own) {
    double c[9];
    for (int k = 0; k < nend; k++) {
        const fw_mechanism_load_end *one = &end[h->load[at]], *other = &end[k];
        if (other->body != h->body || other->scene == FW_NONE) continue;
        const bool same_thing = one->id && other->id && strcmp(one->id, other->id) == 0;
        if (other->first == h->load[at]) {
            if (!same_thing) return true;
            continue;
        }
        int by = h->nhinge + 1;
        while (by < h->n && h->load[by] != other->first)
            by++;
        if (by == h->n) return true;
        give_between(h, h->solid.fine, at, by, c);
        if (size_of(c) > fw_felt_elsewhere * own) return true;
    }
    return false;
}

/* by how much 1/E h of a body may be off that is bent along what a way runs along: *mean, relative error */
static double per_stiff(const fw_mechanism *m, const candidate *of, double *off) {
    const fw_mechanism_variant *v = m->variant;
    const double along = 0.03; /* a way that runs along one direction has no other */
    *off = 0;
    if (!fw_device_material_is_crystal(&v->material)) return 1 / stiff_N(m);
    const fw_flexure_crystal k = fw_flexure_crystal_cubic(
        v->material.c11.value, v->material.c12.value, v->material.c44.value, 0);
    const double cos4 = of->straight && of->way.bent > 0 ? of->way.bent_cos4 / of->way.bent : 0,
                 per_Pa = k.a0_per_Pa + k.a1_per_Pa * cos4;
    *off = of->straight ? along : fabs(k.a1_per_Pa) / k.a0_per_Pa;
    return per_Pa / v->thickness_m;
}

static fw_status add_give(const held *h, const fw_mechanism_load_end *end, int nend,
                          const candidate *of, fw_mechanism *m) {
    const double most_off = 0.25; /* of a mesh that is too coarse for the arm nothing is taken */
    double fine[9], coarse[9], crystal;
    int at = h->nhinge + 1;
    while (at < h->n && h->load[at] != of->end)
        at++;
    if (at == h->n) return FW_OK;
    give_between(h, h->solid.fine, at, at, fine);
    give_between(h, h->solid.coarse, at, at, coarse);
    const double own = size_of(fine), per_N = per_stiff(m, of, &crystal),
                 off = apart(fine, coarse) / own + crystal;
    if (!(own > 0) || !(off < most_off) ||
        own * per_N * stiffest_at(end, nend, of->end) < fw_hardly_gives ||
        feels_others(h, end, nend, at, own))
        return FW_OK;
    const fw_mechanism_load_end *e = &end[of->end];
    fw_mechanism_give *to = &m->give[m->ngive++];
    *to = (fw_mechanism_give){.body = e->body, .x_m = e->x_m, .y_m = e->y_m, .off = off};
    const double turn = -m->drawn[h->body].phi_rad, c = cos(turn), s = sin(turn),
                 axes[9] = {1, 0, 0, 0, c, -s, 0, s, c};
    for (int i = 0; i < 9; i++) /* R c R^T */
        for (int k = 0; k < 9; k++)
            to->c[i] += per_N * axes[3 * (i / 3) + k / 3] * fine[k] * axes[3 * (i % 3) + k % 3];
    return FW_OK;
}

/* A few cells tell what is far from counting, at a tenth of the cost: they are off by a third where an arm is as wide as two */
static bool hardly_give(const held *h, const fw_mechanism_load_end *end, int nend,
                        const candidate *found, int n) {
    const double far = 0.5;
    double c[9], off;
    if (!h->solid.known) return false;
    for (int i = 0; i < n; i++)
        for (int at = h->nhinge + 1; at < h->n; at++) {
            if (h->load[at] != found[i].end) continue;
            give_between(h, h->solid.fine, at, at, c);
            if (size_of(c) * per_stiff(h->m, &found[i], &off) *
                    stiffest_at(end, nend, found[i].end) >
                far * fw_hardly_gives)
                return false;
        }
    return true;
}

static fw_status gives_of_body(fw_arena *scratch, fw_mechanism *m, int body,
                               const fw_mechanism_load_end *end, int nend) {
    candidate found[PLACES];
    held h = {.m = m, .body = body};
    const double held_by = 0.7; /* of the circle about the middle */
    double free_m;
    int n;
    FW_TRY(find_candidates(scratch, m, body, end, nend, found, &n, &free_m));
    if (n == 0) return FW_OK;
    double narrow_m =
        HUGE_VAL; /* twice as many cells across it as bodies have that are asked as a whole */
    for (int i = 0; i < n; i++)
        narrow_m = fmin(narrow_m, found[i].straight ? 0.5 * found[i].way.narrow_m : 0);
    held glance = h;
    FW_TRY(solid_of_body(scratch, &glance, end, nend, 0, held_by * free_m, FEW));
    if (hardly_give(&glance, end, nend, found, n)) return FW_OK;
    FW_TRY(solid_of_body(scratch, &h, end, nend, narrow_m, held_by * free_m, 0));
    for (int i = 0; h.solid.known && h.nhinge > 0 && i < n; i++)
        FW_TRY(add_give(&h, end, nend, &found[i], m));
    return FW_OK;
}

fw_status fw_mechanism_find_gives(fw_arena *arena, fw_mechanism *m) {
    fw_mechanism_load_end *end;
    int nend;
    bool any = false;
    m->ngive = 0;
    if (!m->layout || !m->layout->drawn || !m->device || m->variant->material.youngs.unknown)
        return FW_OK;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &nend));
    for (int k = 0; k < nend; k++)
        any = any || end[k].stiff_N_per_m > 0;
    if (!any) return FW_OK;
    FW_NEED(m->give = fw_arena_array(arena, fw_mechanism_give, (size_t)nend));
    for (int body = 0; body < m->nbody; body++) {
        if (!on_flexures(m, body)) continue;
        fw_arena *scratch = fw_arena_part(arena, 0);
        FW_NEED(scratch);
        const fw_status status = gives_of_body(scratch, m, body, end, nend);
        fw_arena_free(scratch);
        FW_TRY(status);
    }
    return FW_OK;
}

const fw_mechanism_give *fw_mechanism_give_at(const fw_mechanism *m, int body, double x_m,
                                              double y_m) {
    const double same_m = 1e-9;
    for (int i = 0; i < m->ngive; i++) {
        const fw_mechanism_give *g = &m->give[i];
        if (g->body == body && fabs(g->x_m - x_m) < same_m && fabs(g->y_m - y_m) < same_m) return g;
    }
    return NULL;
}
