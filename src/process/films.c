/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/films.h"
#include "base/sort.h"
#include "process/pack.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Heights that nobody stated are drawn as this part of the device layer; what is thicker than so
   many device layers, and nothing is made of it, is drawn as thick as half of one. */
static const double UNKNOWN_PART = 0.12, THICK = 3.0, SHORTENED_PART = 0.4;
static const double TOUCH_M = 1e-12;                  /* heights nearer than that are one */
enum { OTHER = FW_STACK_STRUCTURE + FW_STACK_FIELD }; /* OTHER - column: the other one */

typedef struct maker {
    fw_arena *arena;
    const fw_process_flow *flow;
    fw_process_films *films;
    double device_m; /* thickness of the device layer */
    int note_room;
} maker;

static double known(const fw_quantity *q) {
    return q && !q->unknown ? q->value : (double)NAN;
}

static bool same(const char *a, const char *b) {
    return strcmp(a, b) == 0;
}

static fw_status note(maker *m, const char *sentence) {
    FW_NEED(sentence);
    fw_process_films *f = m->films;
    for (int i = 0; i < f->nnote; i++)
        if (same(f->note[i], sentence)) return FW_OK;
    if (f->nnote == m->note_room) {
        int more = m->note_room ? 2 * m->note_room : 4;
        FW_NEED(f->note = fw_arena_grow(m->arena, f->note, (size_t)f->nnote, (size_t)more,
                                        sizeof *f->note));
        m->note_room = more;
    }
    f->note[f->nnote++] = sentence;
    return FW_OK;
}

static fw_status add_film(maker *m, fw_process_film film) {
    fw_process_films *f = m->films;
    if (f->n == f->capacity) {
        int more = f->capacity ? 2 * f->capacity : 16;
        FW_NEED(f->film =
                    fw_arena_grow(m->arena, f->film, (size_t)f->n, (size_t)more, sizeof film));
        f->capacity = more;
    }
    f->film[f->n++] = film;
    return FW_OK;
}

/* what narrow openings have left of a film that is gone from wide ones */
static bool is_floor(const fw_process_film *f) {
    return f->cut && !f->in[FW_STACK_STRUCTURE];
}

static double top_of(const fw_process_films *f, int column) {
    double top = 0.0;
    for (int i = 0; i < f->n; i++)
        if (f->film[i].in[column] && !is_floor(&f->film[i])) top = fmax(top, f->film[i].top_m);
    return top;
}

static double floor_of(const fw_process_films *f) {
    double low = 0.0;
    for (int i = 0; i < f->n; i++)
        low = fmin(low, f->film[i].bottom_m);
    return low;
}

/* ---- walls ---- */

/* where printing leaves the edge: the plate's, less what is known of printing */
static double printed_m(const maker *m) {
    return m->flow->edges.bias_m - m->flow->edges.printed_m;
}

static bool device_is_cut(const maker *m) {
    for (int i = 0; i < m->flow->edges.ncut; i++)
        if (m->flow->edges.cut[i].device) return true;
    return false;
}

/* Known slope of printed walls: d(edge)/dz. Where the device is cut out of a layer the corner
   `taper` is of that cut, else of the resist that the device grows in. */
static double printed_slope(const maker *m) {
    return device_is_cut(m) || !(m->device_m > 0.0) ? 0.0 : -m->flow->edges.flare_m / m->device_m;
}

static double wall_at(const fw_process_film *f, double z_m) {
    double h = f->top_m - f->bottom_m;
    return h > 0.0 ? f->foot_m + (f->head_m - f->foot_m) * (z_m - f->bottom_m) / h : f->foot_m;
}

/* the film in `column` alone that lies next above z (from z on); NULL */
static const fw_process_film *mask_above(const fw_process_films *f, int column, double z_m) {
    const fw_process_film *best = NULL;
    for (int i = 0; i < f->n; i++) {
        const fw_process_film *c = &f->film[i];
        if (c->in[column] && !c->in[OTHER - column] && c->bottom_m >= z_m - TOUCH_M &&
            (!best || c->bottom_m < best->bottom_m))
            best = c;
    }
    return best;
}

/* edge of what covers `column` above a film, that is of the mask of whatever is done beside it */
static double mask_edge(const maker *m, const fw_process_film *film, int column) {
    const fw_process_film *mask = mask_above(m->films, column, film->top_m);
    return mask ? mask->foot_m : printed_m(m);
}

/* a film in both columns becomes one in each; *at is the one in `column` */
static fw_status split(maker *m, int i, int column, double edge_m, int *at) {
    fw_process_film twin = m->films->film[i];
    *at = i;
    if (!twin.in[OTHER - column]) return FW_OK;
    twin.in[column] = false;
    twin.foot_m = twin.head_m = edge_m;
    fw_process_film *f = &m->films->film[i];
    f->in[OTHER - column] = false;
    f->foot_m = f->head_m = edge_m;
    return add_film(m, twin);
}

static void set_wall(fw_process_films *f, const fw_process_film *like, double foot_m,
                     double head_m) {
    for (int i = 0; i < f->n; i++) {
        fw_process_film *c = &f->film[i];
        if (same(c->material, like->material) && c->in[0] != c->in[1] &&
            fabs(c->bottom_m - like->bottom_m) <= TOUCH_M) {
            c->foot_m = foot_m;
            c->head_m = head_m;
        }
    }
}

/* ---- what is added ---- */

/* far from everything: the flow adds it as a whole and takes it away as a whole, if at all */
static bool is_background(const maker *m, const fw_process_change *add) {
    for (int i = 0; i < m->flow->nstep; i++)
        for (int k = 0; k < m->flow->step[i].nchange; k++) {
            const fw_process_change *c = &m->flow->step[i].change[k];
            if (same(c->kind, "remove") && same(c->material, add->material) &&
                (c->thickness || !same(c->where, "all")))
                return false;
        }
    return same(add->where, "all");
}

static fw_status drawn_height(maker *m, const fw_process_change *c, double *height_m,
                              bool *shortened) {
    double t = known(c->thickness);
    *shortened = false;
    *height_m = t;
    if (isnan(t) || !(t > 0.0)) {
        *height_m = UNKNOWN_PART * m->device_m;
        return note(m, fw_arena_printf(m->arena, "The thickness of %s is not known",
                                       fw_process_flow_material_name(m->flow, c->material)));
    }
    if (t > THICK * m->device_m && is_background(m, c)) {
        *shortened = true;
        *height_m = SHORTENED_PART * m->device_m;
    }
    return FW_OK;
}

/* the wall at z between a film that grows in `column` and what stands beside it at `beside_m` */
static double wall_beside(const maker *m, int column, double beside_m, double z_m) {
    double best = printed_m(m), near = (double)INFINITY;
    for (int i = 0; i < m->films->n; i++) {
        const fw_process_film *f = &m->films->film[i];
        if (f->in[0] == f->in[1]) continue;
        bool beside =
            f->in[OTHER - column] && f->bottom_m <= beside_m + TOUCH_M && f->top_m > beside_m;
        double far = beside ? -1.0 : fabs(f->top_m - beside_m);
        if (far >= near) continue;
        near = far;
        best = beside ? wall_at(f, z_m) : f->head_m;
    }
    return best;
}

static fw_status add_front(maker *m, const fw_process_change *c, fw_process_film film,
                           double height_m) {
    double top[] = {top_of(m->films, 0), top_of(m->films, 1)};
    bool whole = same(c->where, "all") && fabs(top[0] - top[1]) <= TOUCH_M;
    for (int column = 0; column < FW_STACK_COLUMNS; column++) {
        if (!fw_process_where_holds(c->where, column)) continue;
        fw_process_film f = film;
        f.in[column] = true;
        if (whole) f.in[OTHER - column] = true;
        f.bottom_m = top[column];
        f.top_m = f.bottom_m + height_m;
        f.foot_m = wall_beside(m, column, f.bottom_m, f.bottom_m);
        f.head_m = wall_beside(m, column, f.top_m - TOUCH_M, f.top_m);
        FW_TRY(add_film(m, f));
        if (whole) break;
    }
    return FW_OK;
}

static fw_status add(maker *m, const fw_process_change *c) {
    fw_process_film film = {.material = c->material, .thickness_m = known(c->thickness)};
    double height;
    FW_TRY(drawn_height(m, c, &height, &film.shortened));
    if (!c->back) return add_front(m, c, film, height);
    film.top_m = floor_of(m->films);
    film.bottom_m = film.top_m - height;
    film.in[0] = fw_process_where_holds(c->where, 0);
    film.in[1] = fw_process_where_holds(c->where, 1);
    film.foot_m = film.head_m = printed_m(m);
    return add_film(m, film);
}

/* ---- what is changed ---- */

/* a latent image: what of the film lies in one column becomes exposed */
static fw_status expose(maker *m, const fw_process_change *c) {
    double slope = printed_slope(m),
           foot = printed_m(m) + (slope != 0.0 ? 0.5 * m->flow->edges.flare_m : 0.0);
    double base = (double)INFINITY;
    for (int i = 0; i < m->films->n; i++)
        if (same(m->films->film[i].material, c->material))
            base = fmin(base, m->films->film[i].bottom_m);
    for (int column = 0; column < FW_STACK_COLUMNS; column++)
        for (int i = 0, n = m->films->n; i < n; i++) {
            int at = i;
            if (!same(m->films->film[i].material, c->material) ||
                !fw_process_where_holds(c->where, column) || !m->films->film[i].in[column])
                continue;
            if (!same(c->where, "all")) FW_TRY(split(m, i, column, foot, &at));
            fw_process_film *f = &m->films->film[at];
            f->exposed = true;
            set_wall(m->films, f, foot + slope * (f->bottom_m - base),
                     foot + slope * (f->top_m - base));
        }
    return FW_OK;
}

/* the upper part of the topmost film of `from` becomes `material` */
static fw_status convert(maker *m, const fw_process_change *c) {
    double height, t = known(c->thickness);
    bool shortened;
    for (int column = 0; column < FW_STACK_COLUMNS; column++) {
        int at = -1;
        for (int i = 0; i < m->films->n; i++)
            if (m->films->film[i].in[column] && same(m->films->film[i].material, c->from) &&
                (at < 0 || m->films->film[i].top_m > m->films->film[at].top_m))
                at = i;
        if (at < 0 || !fw_process_where_holds(c->where, column)) continue;
        FW_TRY(drawn_height(m, c, &height, &shortened));
        if (!same(c->where, "all"))
            FW_TRY(split(m, at, column, mask_edge(m, &m->films->film[at], OTHER - column), &at));
        fw_process_film *f = &m->films->film[at], fabricated = *f;
        height = fmin(height, 0.6 * (f->top_m - f->bottom_m));
        fabricated.material = c->material;
        fabricated.thickness_m = t;
        fabricated.shortened = false;
        fabricated.bottom_m = f->top_m = f->top_m - height;
        fabricated.foot_m = f->head_m = wall_at(f, fabricated.bottom_m);
        if (!isnan(t)) f->thickness_m -= t;
        FW_TRY(add_film(m, fabricated));
        if (fabricated.in[OTHER - column]) break; /* both columns at once */
    }
    return FW_OK;
}

/* ---- what is removed ---- */

static void drop(fw_process_films *f, int i) {
    memmove(f->film + i, f->film + i + 1, (size_t)(f->n - i - 1) * sizeof *f->film);
    f->n--;
}

/* Walls after a cut: top (1 - A) E, foot (1 - A) (E - D - lag of the open field) behind the edge of
   the mask, that of a cut through another layer than the device's with its foot alone, as in
   fw_process_fixed_point_edge; an unknown A counts as 1. */
static fw_status cut_walls(maker *m, const fw_process_change *c, const fw_process_cut *cut,
                           double edge_m, double way, fw_process_film *f) {
    const fw_process_fixed_point *p = &m->flow->edges;
    double field = p->ncls ? p->cls[p->field].opening_m : (double)INFINITY;
    double loss = isnan(cut->anisotropy) || isnan(cut->etched_m) ? 0.0 : 1.0 - cut->anisotropy;
    double foot = fw_process_cut_foot(cut, field), flare = cut->device ? 0.5 * p->flare_m : 0.0;
    f->mask_edge_m = edge_m;
    f->cut = cut;
    f->foot_m = edge_m - way * (loss > 0.0 ? loss * foot : 0.0) + flare;
    f->head_m =
        edge_m - way * (loss > 0.0 ? loss * (cut->device ? cut->etched_m : foot) : 0.0) - flare;
    if (!isnan(cut->anisotropy) && !isnan(cut->etched_m)) return FW_OK;
    return note(
        m, fw_arena_printf(m->arena,
                           "What step %s takes sideways is not known (%s): its walls are drawn "
                           "straight",
                           cut->step->id, c->anisotropy->id ? c->anisotropy->id : "anisotropy"));
}

/* one film, of which `column` is etched beside a mask on the other column */
static fw_status etch_beside(maker *m, const fw_process_step *s, const fw_process_change *c, int i,
                             int column) {
    double edge = mask_edge(m, &m->films->film[i], OTHER - column);
    double way = column == FW_STACK_FIELD ? 1.0 : -1.0; /* the structure shrinks, or the field */
    const fw_process_cut *cut = fw_process_fixed_point_cut(&m->flow->edges, c->anisotropy);
    int at;
    FW_TRY(split(m, i, column, edge, &at));
    fw_process_film gone = m->films->film[at], walls = gone;
    walls.foot_m = walls.head_m = edge;
    if (c->isotropic && !isnan(known(c->thickness)))
        walls.foot_m = walls.head_m = edge - way * known(c->thickness) * (1.0 + s->overrun);
    if (cut) FW_TRY(cut_walls(m, c, cut, edge, way, &walls));
    set_wall(m->films, &gone, walls.foot_m, walls.head_m);
    for (int k = 0; cut && k < m->films->n; k++) { /* what stays beside it has a foot of its own */
        fw_process_film *f = &m->films->film[k];
        if (f->in[OTHER - column] && !f->in[column] && same(f->material, gone.material) &&
            fabs(f->bottom_m - gone.bottom_m) <= TOUCH_M) {
            f->cut = cut;
            f->mask_edge_m = edge;
        }
    }
    bool floors =
        cut && cut->lag != FW_LAG_NONE && !isnan(cut->lag_value) && column == FW_STACK_FIELD;
    if (!floors) {
        drop(m->films, at);
        return FW_OK;
    }
    m->films->film[at].cut = cut; /* stays as what narrow openings have left */
    m->films->film[at].mask_edge_m = edge;
    if (!fw_process_lag_is_guess(cut->lag_quantity)) return FW_OK;
    return note(
        m, fw_arena_printf(m->arena, "The lag of narrow openings in step %s is assumed (%s)",
                           cut->step->id, cut->lag_quantity->id ? cut->lag_quantity->id : "lag"));
}

/* an etch that runs sideways from every opening: out of the field, and from below the structure */
static fw_status undercut(maker *m, const fw_process_step *s, const fw_process_change *c) {
    double reach = known(c->reach);
    for (int i = m->films->n - 1; i >= 0; i--) {
        fw_process_film *f = &m->films->film[i];
        if (!same(f->material, c->material)) continue;
        if (isnan(reach) || !f->in[FW_STACK_STRUCTURE]) {
            drop(m->films, i);
            continue;
        }
        if (f->in[FW_STACK_FIELD]) {
            f->foot_m = f->head_m = mask_edge(m, f, FW_STACK_STRUCTURE);
            f->in[FW_STACK_FIELD] = false;
        }
        f->reach_m = fmax(f->reach_m, reach * (1.0 + s->overrun));
    }
    if (!isnan(reach)) return FW_OK;
    return note(m, fw_arena_printf(m->arena,
                                   "How far step %s reaches sideways is not known: drawn as if it "
                                   "reached everywhere",
                                   s->id));
}

/* a stated depth that is less than the film's thickness */
static bool is_shallow(const fw_process_change *c, const fw_process_film *f) {
    double t = known(c->thickness);
    return !c->anisotropy && !c->isotropic && t > 0.0 && t < 0.98 * f->thickness_m && !f->shortened;
}

static void thin(const fw_process_change *c, fw_process_film *f) {
    double t = known(c->thickness), left = f->thickness_m - t;
    if (c->back)
        f->bottom_m += t;
    else {
        f->head_m = wall_at(f, f->top_m - t);
        f->top_m -= t;
    }
    f->thickness_m = left;
}

static fw_status take_away(maker *m, const fw_process_step *s, const fw_process_change *c) {
    bool whole = same(c->where, "all"), etch = c->isotropic || c->anisotropy;
    int column = same(c->where, "structure") ? FW_STACK_STRUCTURE : FW_STACK_FIELD;
    if (c->reach) return undercut(m, s, c);
    for (int i = m->films->n - 1; i >= 0; i--) { /* what is split off comes behind */
        fw_process_film *f = &m->films->film[i];
        if (!same(f->material, c->material) || (!whole && !f->in[column])) continue;
        if (is_shallow(c, f)) {
            int at = i;
            if (!whole) FW_TRY(split(m, i, column, mask_edge(m, f, OTHER - column), &at));
            thin(c, &m->films->film[at]);
        } else if (!whole && (etch || f->in[OTHER - column])) {
            FW_TRY(etch_beside(m, s, c, i, column));
        } else {
            drop(m->films, i);
        }
    }
    return FW_OK;
}

/* the part of film i that lies open on top becomes a film of its own where the other part is covered; -1: none is open */
static fw_status open_part(maker *m, int i, const double top[], int *open) {
    const fw_process_film *f = &m->films->film[i];
    bool up[FW_STACK_COLUMNS];
    for (int column = 0; column < FW_STACK_COLUMNS; column++)
        up[column] = f->in[column] && fabs(f->top_m - top[column]) <= TOUCH_M;
    *open = up[0] || up[1] ? i : -1;
    if (*open < 0 || !f->in[0] || !f->in[1] || up[0] == up[1]) return FW_OK;
    int column = up[0] ? 0 : 1;
    return split(m, i, column, mask_edge(m, f, OTHER - column), open);
}

/* what the step's chemical takes of films that lie open on top (fw_process_exposed_loss), and of
   the device's walls where it is a liquid (films.h) */
static fw_status wear(maker *m, const fw_process_step *s, const fw_process_exposed *x) {
    double most, loss = fw_process_exposed_loss(s, x, &most);
    double top[] = {top_of(m->films, 0), top_of(m->films, 1)};
    bool open = false, walls = fw_process_step_is_wet(s) && x->rate && m->flow->material &&
                               same(x->material, m->flow->material);
    for (int i = m->films->n - 1; i >= 0; i--) {
        const fw_process_film *whole = &m->films->film[i];
        int at = -1;
        if (same(whole->material, x->material) && !whole->shortened && !isnan(whole->thickness_m))
            FW_TRY(open_part(m, i, top, &at));
        if (at < 0) continue;
        open = true;
        if (isnan(loss)) continue;
        fw_process_film *f = &m->films->film[at];
        if (loss >= f->thickness_m) {
            drop(m->films, at);
            continue;
        }
        f->head_m = wall_at(f, f->top_m - loss);
        f->top_m -= loss;
        f->thickness_m -= loss;
        if (!walls || f->in[FW_STACK_FIELD]) continue;
        f->foot_m -= loss;
        f->head_m -= loss;
    }
    if (!open || !isnan(loss)) return FW_OK;
    return note(m, fw_arena_printf(m->arena, "How much %s step %s takes is not known",
                                   fw_process_flow_material_name(m->flow, x->material), s->id));
}

/* ---- all steps ---- */

static fw_status apply(maker *m, const fw_process_step *s, const fw_process_change *c) {
    if (same(c->kind, "add")) return add(m, c);
    if (same(c->kind, "remove")) return take_away(m, s, c);
    if (same(c->kind, "pattern")) return expose(m, c);
    return convert(m, c);
}

bool fw_process_films_is_new(const fw_process_films *now, const fw_process_films *before, int i) {
    for (int k = 0; k < before->nnote; k++)
        if (same(before->note[k], now->note[i])) return false;
    return true;
}

bool fw_process_step_changes(const fw_process_step *step) {
    return step->nchange > 0 || step->nexposed > 0;
}

static int by_height(const void *left, const void *right) {
    const fw_process_film *p = left, *q = right;
    int order = fw_order_doubles(p->bottom_m, q->bottom_m);
    return order ? order : fw_order_wholes(q->in[FW_STACK_STRUCTURE], p->in[FW_STACK_STRUCTURE]);
}

/* Every change of every step up to `index`, in order. Heights add up from the first film, the back
   of the wafer downward. Cost O(steps x films). Source of walls and depths:
   process/fixed_point.c. Test: test_films.c: the three packs step by step, walls against
   fw_process_fixed_point_edge, depths against t(w). */
fw_status fw_process_flow_films(fw_arena *arena, const fw_process_flow *flow, int index,
                                fw_process_films *films) {
    double device = known(flow->thickness);
    maker m = {arena, flow, films, device > 0.0 ? device : 10e-6, 0};
    *films = (fw_process_films){0};
    for (int i = 0; i < flow->nstep && i <= index; i++) {
        const fw_process_step *s = &flow->step[i];
        films->changed = fw_process_step_changes(s);
        for (int k = 0; k < s->nchange; k++)
            FW_TRY(apply(&m, s, &s->change[k]));
        for (int k = 0; k < s->nexposed; k++)
            FW_TRY(wear(&m, s, &s->exposed[k]));
    }
    if (films->n > 1) qsort(films->film, (size_t)films->n, sizeof *films->film, by_height);
    return FW_OK;
}

/* z + lag(w, z) = E by bisection: the left side rises with z. In: the cut with its E, the opening w
   m. Out: m, error 1e-15 of the depth. Test: test_films.c, depth: z = D and E where they should. */
double fw_process_cut_depth(const fw_process_cut *cut, double w_m) {
    double E = cut->etched_m;
    if (isnan(E)) return cut->depth_m;
    double lag = fw_process_cut_lag(cut, w_m, cut->depth_m);
    if (isnan(lag)) return fmin(E, cut->depth_m);
    if (cut->depth_m + lag <= E) return cut->depth_m;
    double low = 0.0, high = cut->depth_m;
    for (int i = 0; i < 50; i++) {
        double z = 0.5 * (low + high);
        if (z + fw_process_cut_lag(cut, w_m, z) <= E)
            low = z;
        else
            high = z;
    }
    return low;
}
