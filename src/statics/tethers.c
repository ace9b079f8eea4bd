/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A probe pushes a tether's finger sideways until its neck breaks.

   Bodies are rigid; every hinge is its closed-form compliance at its true centre; a tether is a beam from
   the frame (s = 0) to its body (s = L) of piecewise width w(s): finger, widening, neck. With
   N, V, M the body's forces on its end and P the probe at s = a,

     M(s) = M + V (L - s) + P (a - s) [s < a],    w_end = C (N, V, M) + d P,
     C_VV = int (L - s)^2/EI + 6/5 GA, C_VM = int (L - s)/EI, C_MM = int 1/EI, C_NN = int 1/EA,
     d_V = int_0^a (a - s)(L - s)/EI + 6/5 GA, d_M = int_0^a (a - s)/EI

   (unit-load theorem; Timoshenko's shear with the factor 6/5 of a rectangle). The body's compliance B at
   the neck, a 3 x 3 block of the inverse of the stiffness of all bodies on hinges and other tethers, gives
   (C + B)(N, V, M) = -d P. Stress in the tether 6 |M(s)|/(h w^2) + |N|/(h w), nominal: what the corners add
   is left out, so that it breaks no later. A hinge that bears (M, F) at its centre has at most
   the stress of a moment |M| + |F| rho, rho the farthest of its strip from there, and |F|/(h t). Tried are
   eight places of the probe; of those that break the neck the one with the least share of the hinges is
   taken. In: SI, a mechanism with
   hinges at every joint. Out: force, way, share. Error: that of the closed forms, and of small
   displacements. Cost: (3 nbody)^3/3 for each tether, twice. Source: S. Timoshenko, Strength of Materials I,
   1955, ch. 5 and 11 (beams, unit loads); docs/theory/release.md. Test: test_tethers.c */
#include "statics/statics.h"
#include "base/text.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

enum { PLACES = 8, PANELS = 24, MOST_BODIES = 60 };
static const double BAND = 2.0; /* standard uncertainties, as packs have them */

typedef struct beam { /* one tether */
    double length, cut, neck_from,
        flare_from; /* from the frame: to the body; the cut; where neck and
                                                  widening begin */
    double finger, neck, depth, youngs, shear;
    double c[3][3]; /* axial, lateral, rotation of its end */
    fw_geometry_vec2 end, along, across;
} beam;

typedef struct chain {
    fw_arena *arena;
    const fw_mechanism *m;
    beam *beam;
    int n, size;
    double *k, *u; /* (size x size); (size x 3) */
    int *pivot;
} chain;

/* ---- a tether as a beam ---- */

static double width_at(const beam *b, double s) {
    if (s <= b->flare_from) return b->finger;
    if (s >= b->neck_from) return b->neck;
    double part = (s - b->flare_from) / (b->neck_from - b->flare_from);
    return b->finger + part * (b->neck - b->finger);
}

typedef struct sums { /* over the beam: of the body's end, and of the probe at a */
    double c_aa, d_v, d_m;
} sums;

/* Simpson's rule: exact where the width is constant */
static void integrate(beam *b, double a, double c[3][3], sums *probe) {
    const double stop[] = {0.0, a, b->flare_from, b->neck_from, b->length};
    memset(c, 0, 9 * sizeof(double));
    *probe = (sums){0};
    for (int piece = 0; piece < 4; piece++) {
        double from = fmin(stop[piece], b->length), to = stop[piece + 1];
        if (piece == 1) to = fmax(to, from);
        double step = (to - from) / (2 * PANELS);
        for (int i = 0; step > 0.0 && i <= 2 * PANELS; i++) {
            double s = from + i * step, w = width_at(b, s), h = b->depth;
            double weight = (i == 0 || i == 2 * PANELS ? 1.0 : i % 2 ? 4.0 : 2.0) * step / 3.0;
            double bend = weight * 12.0 / (b->youngs * h * w * w * w),
                   slide = weight * 1.2 / (b->shear * h * w), x = b->length - s;
            c[0][0] += weight / (b->youngs * h * w);
            c[1][1] += bend * x * x + slide;
            c[1][2] += bend * x;
            c[2][2] += bend;
            if (piece > 0) continue;
            probe->c_aa += bend * (a - s) * (a - s) + slide;
            probe->d_v += bend * (a - s) * x + slide;
            probe->d_m += bend * (a - s);
        }
    }
    c[2][1] = c[1][2];
}

static beam beam_of(const fw_mechanism *m, const fw_layout_tether *t) {
    const fw_device_material *material = &m->variant->material;
    double nu = material->poisson.unknown ? 0.25 : material->poisson.value;
    beam b = {.length = t->length_m + t->stub_m,
              .cut = t->length_m,
              .neck_from = t->length_m - t->neck_long_m,
              .flare_from = t->length_m - t->neck_long_m - t->flare_m,
              .finger = t->finger_m,
              .neck = t->neck_m,
              .depth = m->variant->thickness_m,
              .youngs = material->youngs.value,
              .along = {-t->outward.x, -t->outward.y}};
    sums none;
    b.shear = b.youngs / (2.0 * (1.0 + nu));
    b.across = (fw_geometry_vec2){-b.along.y, b.along.x};
    b.end = (fw_geometry_vec2){t->cut.x + t->stub_m * b.along.x, t->cut.y + t->stub_m * b.along.y};
    integrate(&b, 0.0, b.c, &none);
    return b;
}

/* largest stress for the end's forces f and a probe of 1 N at a: at places that are evenly apart, and
   where width or moment have a corner */
static double beam_stress(const beam *b, double a, const double f[3], bool *at_neck) {
    enum { STATIONS = 256, CORNERS = 3 };
    const double corner[CORNERS] = {a, b->flare_from, b->neck_from};
    double most = 0.0;
    for (int i = 0; i <= STATIONS + CORNERS; i++) {
        double s = i <= STATIONS ? b->length * i / STATIONS : corner[i - STATIONS - 1];
        double w = width_at(b, s), moment = f[2] + f[1] * (b->length - s) + (s < a ? a - s : 0.0);
        double stress = 6.0 * fabs(moment) / (b->depth * w * w) + fabs(f[0]) / (b->depth * w);
        if (stress <= most) continue;
        most = stress;
        *at_neck = s >= b->flare_from;
    }
    return most;
}

/* ---- bodies on springs ---- */

/* displacement of a point of a body: rows axial, lateral (along x, y of a frame), rotation */
static void point_rows(const chain *c, int body, fw_geometry_vec2 p, fw_geometry_vec2 x,
                       double row[3][3]) {
    fw_geometry_vec2 y = {-x.y, x.x}, r = {0.0, 0.0};
    if (body >= 0) r = (fw_geometry_vec2){p.x - c->m->body[body].x_m, p.y - c->m->body[body].y_m};
    const double turn_x = -r.y * x.x + r.x * x.y, turn_y = -r.y * y.x + r.x * y.y;
    const double rows[3][3] = {{x.x, x.y, turn_x}, {y.x, y.y, turn_y}, {0.0, 0.0, 1.0}};
    memcpy(row, rows, sizeof rows);
}

/* a spring of stiffness s (3 x 3) between points of two bodies */
static void add_spring(chain *c, const int body[2], fw_geometry_vec2 p, fw_geometry_vec2 x,
                       double s[3][3]) {
    double row[2][3][3];
    for (int side = 0; side < 2; side++)
        point_rows(c, body[side], p, x, row[side]);
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) {
            if (body[a] < 0 || body[b] < 0) continue;
            double sign = a == b ? 1.0 : -1.0;
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    for (int k = 0; k < 3; k++)
                        for (int l = 0; l < 3; l++)
                            c->k[(3 * body[a] + i) * c->size + 3 * body[b] + j] +=
                                sign * row[a][k][i] * s[k][l] * row[b][l][j];
        }
}

static bool inverse3(const double a[3][3], double out[3][3]) {
    double det;
    memset(out, 0, 9 * sizeof(double));
    for (int i = 0; i < 3; i++)
        out[i][i] = 1.0;
    return fw_maths_solve3(a, 3, out, &det);
}

/* axial and lateral first, then rotation: the closed form has rotation first */
static bool hinge_stiffness(const fw_mechanism_hinge *h, double s[3][3]) {
    static const int order[] = {1, 2, 0};
    double c[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[i][j] = h->closed_form.compliance[order[i]][order[j]] / h->scale;
    return h->scale > 0.0 && inverse3((const double(*)[3])c, s);
}

static fw_geometry_vec2 axis_of(const fw_mechanism_hinge *h) {
    double a = isnan(h->axis_rad) ? 0.0 : h->axis_rad;
    return (fw_geometry_vec2){cos(a), sin(a)};
}

/* all hinges, and the tethers that hold; false: nothing holds some body */
static bool factor(chain *c, int own, bool others) {
    double s[3][3];
    memset(c->k, 0, (size_t)c->size * (size_t)c->size * sizeof *c->k);
    for (int k = 0; k < c->m->nhinge; k++) {
        const fw_mechanism_hinge *h = &c->m->hinge[k];
        const fw_mechanism_pin *pin = &c->m->pin[h->pin];
        if (!hinge_stiffness(h, s)) return false;
        add_spring(c, (const int[2]){pin->body_a, pin->body_b},
                   fw_mechanism_pin_place(c->m, pin, 0), axis_of(h), s);
    }
    for (int i = 0; others && i < c->n; i++) {
        const beam *b = &c->beam[i];
        if (i == own) continue;
        if (!inverse3((const double(*)[3])b->c, s)) return false;
        add_spring(c, (const int[2]){c->m->layout->tether[i].body, FW_GROUND}, b->end, b->along, s);
    }
    return fw_maths_lu_factor(c->size, c->k, c->pivot);
}

/* u: motions of all bodies under unit forces on the neck; compliance (3 x 3) there */
static void body_compliance(chain *c, int own, double out[3][3]) {
    const beam *b = &c->beam[own];
    int body = c->m->layout->tether[own].body;
    double row[3][3];
    point_rows(c, body, b->end, b->along, row);
    for (int k = 0; k < 3; k++) {
        double *u = c->u + k * c->size;
        memset(u, 0, (size_t)c->size * sizeof *u);
        for (int i = 0; i < 3; i++)
            u[3 * body + i] = row[k][i];
        fw_maths_lu_solve(c->size, c->k, c->pivot, NULL, u);
        for (int i = 0; i < 3; i++) {
            out[i][k] = 0.0;
            for (int j = 0; j < 3; j++)
                out[i][k] += row[i][j] * u[3 * body + j];
        }
    }
}

/* ---- what a hinge bears ---- */

/* farthest of the strip from its centre of compliance, at most */
static double strip_reach(const fw_mechanism *m, const fw_mechanism_hinge *h) {
    const fw_flexure_input *in = &h->input;
    double off = hypot(h->closed_form.offset_m[0], h->closed_form.offset_m[1]);
    if (in->npiece == 0 && in->kind == FW_FLEXURE_CSFH)
        return in->radius_m + fabs(h->closed_form.centre_m) + off;
    if (in->npiece == 0 && in->kind == FW_FLEXURE_LEAF) return 0.5 * in->length_m + off;
    return m->layout->hinge[h->pin].keep_out_m + off;
}

/* stress of hinge k, at most, with forces f on the neck of the tether's body */
static double hinge_stress(const chain *c, int k, const double f[3]) {
    const fw_mechanism_hinge *h = &c->m->hinge[k];
    const fw_mechanism_pin *pin = &c->m->pin[h->pin];
    const int body[2] = {pin->body_a, pin->body_b};
    double s[3][3], move[3] = {0.0, 0.0, 0.0}, force[3] = {0.0, 0.0, 0.0};
    for (int side = 0; side < 2; side++) {
        double row[3][3];
        if (body[side] < 0) continue;
        point_rows(c, body[side], fw_mechanism_pin_place(c->m, pin, 0), axis_of(h), row);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                for (int l = 0; l < 3; l++)
                    move[i] += (side ? 1.0 : -1.0) * row[i][j] *
                               c->u[l * c->size + 3 * body[side] + j] * f[l];
    }
    if (!hinge_stiffness(h, s)) return (double)NAN;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            force[i] += s[i][j] * move[j];
    const fw_flexure_result *r = &h->closed_form;
    double pull = hypot(force[0], force[1]), bend = fabs(force[2]) + pull * strip_reach(c->m, h);
    return r->stress_per_rad_Pa * bend / (r->stiffness_Nm_per_rad * h->scale) +
           pull / (h->input.width_m * c->m->variant->thickness_m);
}

/* ---- one tether ---- */

static bool break_at(chain *c, int own, const double body[3][3], double a,
                     const fw_statics_tethers *all, fw_statics_tether_break *out) {
    beam *b = &c->beam[own];
    double whole[3][3], f[3], own_c[3][3], on_body[3], det;
    sums p;
    integrate(b, a, own_c, &p);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            whole[i][j] = own_c[i][j] + body[i][j];
    double x[3][3] = {{0.0}};
    x[1][0] = -p.d_v, x[2][0] = -p.d_m;
    if (!fw_maths_solve3((const double(*)[3])whole, 1, x, &det)) return false;
    for (int i = 0; i < 3; i++)
        f[i] = x[i][0], on_body[i] = -x[i][0];
    *out = (fw_statics_tether_break){.hinge = FW_NONE};
    out->stress_per_N = beam_stress(b, a, f, &out->at_neck);
    out->force_N = all->strength_Pa / out->stress_per_N;
    out->low_N = all->low_Pa / out->stress_per_N;
    out->high_N = all->high_Pa / out->stress_per_N;
    out->move_m = out->force_N * (p.c_aa + p.d_v * f[1] + p.d_m * f[2]);
    for (int k = 0; k < c->m->nhinge; k++) {
        double share = hinge_stress(c, k, on_body) / out->stress_per_N;
        if (share <= out->hinge_share) continue;
        out->hinge_share = share;
        out->hinge = k;
    }
    return isfinite(out->force_N) && out->force_N > 0.0;
}

static void judge(const chain *c, const fw_statics_tethers *all, fw_statics_tether_break *b) {
    if (b->hinge < 0) return;
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&c->m->hinge[b->hinge].limits);
    double allowed = (limit ? limit->allowable_Pa : all->strength_Pa) / c->m->device->safety_factor;
    b->hinge_used = b->hinge_share * all->strength_Pa / allowed;
    b->hinge_most = b->hinge_share * all->high_Pa / allowed;
}

/* is this place of the probe better? The finger is to come off at the neck; then the least share of the
   hinges counts */
static bool better(const fw_statics_tether_break *now, const fw_statics_tether_break *best) {
    if (now->at_neck != best->at_neck) return now->at_neck;
    return now->hinge_share < best->hinge_share;
}

static bool find_break(chain *c, int own, const fw_statics_tethers *all, fw_statics_tether *t) {
    const beam *b = &c->beam[own];
    double body[3][3], best = 0.0;
    bool found = false;
    if (!factor(c, own, false)) return false;
    body_compliance(c, own, body);
    for (int k = 1; k <= PLACES; k++) {
        double a = b->flare_from * k / PLACES;
        fw_statics_tether_break now;
        if (!break_at(c, own, (const double(*)[3])body, a, all, &now)) continue;
        if (found && !better(&now, &t->last)) continue;
        found = true;
        best = a;
        t->last = now;
    }
    if (!found) return false;
    t->probe_m = b->cut - best;
    judge(c, all, &t->last);
    if (!factor(c, own, true)) return false;
    body_compliance(c, own, body);
    if (!break_at(c, own, (const double(*)[3])body, best, all, &t->first)) return false;
    judge(c, all, &t->first);
    return true;
}

static const char *cannot(const fw_mechanism *m) {
    const fw_device_material *material = &m->variant->material;
    if (m->nbody > MOST_BODIES) return "more than 60 bodies";
    if (m->njoint > 0 || m->nhinge < m->npin) return "a joint of the mechanism is no flexure";
    if (material->strength.unknown || material->youngs.unknown)
        return "strength or Young's modulus of the material is not known";
    if (!(m->variant->thickness_m > 0.0)) return "the thickness is not known";
    return NULL;
}

fw_status fw_statics_tethers_find(fw_arena *arena, const fw_mechanism *m,
                                  const fw_statics_tethers **out) {
    const fw_layout *l = m->layout;
    *out = NULL;
    if (!l || !l->drawn || l->ntether == 0) return FW_OK;
    const fw_quantity *strength = &m->variant->material.strength;
    const char *criterion = m->variant->material.criterion;
    fw_statics_tethers *all = fw_arena_one(arena, fw_statics_tethers);
    FW_NEED(all);
    FW_NEED(all->item = fw_arena_array(arena, fw_statics_tether, (size_t)l->ntether));
    *out = all;
    all->n = l->ntether;
    all->criterion = criterion ? criterion : "strength";
    all->brittle = !criterion || strcmp(criterion, "fracture") == 0;
    for (int i = 0; i < all->n; i++)
        all->item[i].drawn = &l->tether[i];
    all->why = cannot(m);
    if (all->why) return FW_OK;
    all->strength_Pa = strength->value;
    all->low_Pa = strength->interval ? strength->low
                                     : fmax(strength->value - BAND * strength->uncertainty, 0.0);
    all->high_Pa =
        strength->interval ? strength->high : strength->value + BAND * strength->uncertainty;
    chain c = {.arena = arena, .m = m, .n = all->n, .size = 3 * m->nbody};
    size_t size = (size_t)c.size;
    FW_NEED(c.beam = fw_arena_array(arena, beam, (size_t)c.n));
    FW_NEED(c.k = fw_arena_array(arena, double, size *size));
    FW_NEED(c.u = fw_arena_array(arena, double, 3 * size));
    FW_NEED(c.pivot = fw_arena_array(arena, int, size));
    for (int i = 0; i < c.n; i++)
        c.beam[i] = beam_of(m, &l->tether[i]);
    for (int i = 0; i < all->n && !all->why; i++) {
        if (!find_break(&c, i, all, &all->item[i]))
            all->why = "hinges alone do not hold every body";
        if (all->item[i].last.hinge_share < all->item[all->keep].last.hinge_share) all->keep = i;
    }
    return FW_OK;
}

/* what goes no further stays where it is */
static const double fw_stays_m = 1e-8;

void fw_statics_tethers_watch(const fw_statics_tethers *all, const fw_mechanism *m,
                              const char *scene, const double *q, int nrow) {
    for (int i = 0; i < all->n; i++) {
        fw_statics_tether *t = &all->item[i];
        const int body = t->drawn->body;
        if (body < 0) continue;
        const fw_mechanism_mass *at = &m->drawn[body];
        const fw_geometry_vec2 cut = t->drawn->cut, out = t->drawn->outward;
        for (int row = 0; row < nrow; row++) {
            const double *now = q + 3 * ((size_t)row * (size_t)m->nbody + (size_t)body);
            double c = cos(now[2] - at->phi_rad), s = sin(now[2] - at->phi_rad);
            double x = cut.x - at->x_m, y = cut.y - at->y_m;
            double toward =
                (now[0] + c * x - s * y - cut.x) * out.x + (now[1] + s * x + c * y - cut.y) * out.y;
            if (toward > fw_stays_m && toward > t->toward_m) t->toward_m = toward, t->scene = scene;
        }
    }
}

/* ---- what breaking them asks, for documents and for the run sheet ---- */

static const char *hinge_of(const fw_mechanism *m, int hinge) {
    return hinge < 0 ? NULL : m->pin[m->hinge[hinge].pin].id;
}

static void one_break(fw_json *json, const char *key, const fw_mechanism *m,
                      const fw_statics_tether_break *b) {
    fw_json_object(json, key);
    fw_json_real(json, "force_N", b->force_N);
    fw_json_real(json, "low_N", b->low_N);
    fw_json_real(json, "high_N", b->high_N);
    fw_json_real(json, "move_m", b->move_m);
    fw_json_truth(json, "at_neck", b->at_neck);
    fw_json_text(json, "hinge", hinge_of(m, b->hinge));
    fw_json_real(json, "hinge_share", b->hinge_share);
    fw_json_real(json, "hinge_used", b->hinge_used);
    fw_json_real(json, "hinge_most", b->hinge_most);
    fw_json_end(json);
}

void fw_statics_tethers_json(fw_json *json, const fw_mechanism *m,
                             const fw_statics_tethers *tethers) {
    if (!tethers) return;
    fw_json_object(json, "tethers");
    fw_json_text(json, "not_computed", tethers->why);
    fw_json_text(json, "criterion", tethers->criterion);
    fw_json_real(json, "strength_Pa", tethers->why ? (double)NAN : tethers->strength_Pa);
    fw_json_text(json, "break_last",
                 tethers->why ? NULL : tethers->item[tethers->keep].drawn->label);
    fw_json_list(json, "items");
    for (int i = 0; i < tethers->n; i++) {
        const fw_statics_tether *t = &tethers->item[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "tether", t->drawn->label);
        fw_json_list(json, "cut_m");
        fw_json_real(json, NULL, t->drawn->cut.x);
        fw_json_real(json, NULL, t->drawn->cut.y);
        fw_json_end(json);
        fw_json_real(json, "neck_m", t->drawn->neck_m);
        fw_json_real(json, "length_m", t->drawn->length_m);
        fw_json_real(json, "toward_m", t->toward_m);
        fw_json_text(json, "toward_scene", t->scene);
        if (!tethers->why) {
            fw_json_real(json, "probe_m", t->probe_m);
            one_break(json, "first", m, &t->first);
            one_break(json, "last", m, &t->last);
        }
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_end(json);
}

static const char *number(char out[32], double value) {
    return fw_number_text(out, 32, value, 3);
}

static void say_hinge(fw_text *text, const fw_mechanism *m, const fw_statics_tethers *all,
                      const fw_statics_tether_break *b) {
    char used[32], most[32];
    const char *hinge = hinge_of(m, b->hinge);
    if (!hinge) return;
    fw_text_printf(text, ", and %s%s bears at most %s %% of its limit", FW_NAMED("hinge", hinge),
                   number(used, 100.0 * b->hinge_used));
    if (all->high_Pa > all->strength_Pa)
        fw_text_printf(text, " (%s %% where the tether is as strong as its band allows)",
                       number(most, 100.0 * b->hinge_most));
    if (b->hinge_share >= 1.0)
        fw_text_add(text,
                    ": THE HINGE BREAKS BEFORE THE TETHER; hold the body beside the neck with "
                    "a second probe");
    else if (b->hinge_most > 1.0)
        fw_text_add(text, ": beyond its limit; hold the body beside the neck with a second probe");
}

static void say_one(fw_text *text, const fw_mechanism *m, const fw_statics_tethers *all,
                    const fw_statics_tether *t, const fw_statics_tether_break *b) {
    const bool band = all->high_Pa > all->low_Pa;
    char at[2][32], probe[32], force[3][32], move[32];
    fw_text_printf(
        text,
        "the %s at (%s, %s) um, pushed sideways on its finger %s um from the neck, %s%s at %s mN",
        t->drawn->label, fw_number_text(at[0], 32, 1e6 * t->drawn->cut.x, 5),
        fw_number_text(at[1], 32, 1e6 * t->drawn->cut.y, 5), number(probe, 1e6 * t->probe_m),
        all->brittle ? "breaks" : "yields", b->at_neck ? "" : " in the finger, not at the neck,",
        number(force[0], 1e3 * b->force_N));
    if (band)
        fw_text_printf(text, " (%s to %s)", number(force[1], 1e3 * b->low_N),
                       number(force[2], 1e3 * b->high_N));
    else
        fw_text_add(text, " (no band of the strength is stated)");
    fw_text_printf(text, ", when the probe has gone %s um", number(move, 1e6 * b->move_m));
    say_hinge(text, m, all, b);
}

/* what the neck leaves open is not known: a body that goes towards its finger meets it */
static const double fw_meets_m = 1e-6;

static void say_in_the_way(fw_text *text, const fw_statics_tethers *all) {
    char x[32], y[32], by[32];
    int n = 0;
    for (int i = 0; i < all->n; i++) {
        const fw_statics_tether *t = &all->item[i];
        if (!(t->toward_m > fw_meets_m)) continue;
        fw_text_add(text,
                    n++ ? "; "
                        : ". Then break these fingers off at the frame, too, for their bodies "
                          "move against what is left of them: ");
        fw_text_printf(text, "the %s at (%s, %s) um (%s um in %s%s)", t->drawn->label,
                       fw_number_text(x, 32, 1e6 * t->drawn->cut.x, 5),
                       fw_number_text(y, 32, 1e6 * t->drawn->cut.y, 5),
                       number(by, 1e6 * t->toward_m), FW_NAMED("scene", t->scene));
    }
}

fw_status fw_statics_tethers_words(fw_arena *arena, const fw_mechanism *m,
                                   const fw_statics_tethers *tethers, const char **out) {
    enum { FEW = 4 };
    fw_text text = fw_text_new(arena);
    char at[2][32];
    *out = NULL;
    if (!tethers) return FW_OK;
    const fw_layout_tether *keep = tethers->item[tethers->keep].drawn;
    if (tethers->why) {
        fw_text_printf(&text, "Force to break the tethers: NOT COMPUTABLE, %s", tethers->why);
        say_in_the_way(&text, tethers);
        FW_TRY(fw_text_end(&text));
        *out = text.data;
        return FW_OK;
    }
    fw_text_add(&text, tethers->n > 1 ? "Break the tethers one at a time with a probe in the plane "
                                        "of the wafer"
                                      : "Break the tether with a probe in the plane of the wafer");
    if (tethers->n > 1)
        fw_text_printf(&text, ", the one at (%s, %s) um last",
                       fw_number_text(at[0], 32, 1e6 * keep->cut.x, 5),
                       fw_number_text(at[1], 32, 1e6 * keep->cut.y, 5));
    if (!tethers->brittle)
        fw_text_printf(
            &text,
            ". The forces are those of the material's %s: what parts a metal is not known, so bend "
            "each finger to and fro, or cut it",
            tethers->criterion);
    for (int i = 0, said = 0; i < tethers->n && said < FEW; i++) {
        const fw_statics_tether *t = &tethers->item[i];
        if (i == tethers->keep) continue;
        said++;
        fw_text_add(&text, ". While all others hold, ");
        say_one(&text, m, tethers, t, &t->first);
    }
    if (tethers->n > FEW + 1)
        fw_text_printf(&text, ". Of %d more the recipe's JSON says it", tethers->n - FEW - 1);
    fw_text_add(&text, tethers->n > 1 ? ". Last, " : ". As the only one, ");
    say_one(&text, m, tethers, &tethers->item[tethers->keep], &tethers->item[tethers->keep].last);
    say_in_the_way(&text, tethers);
    FW_TRY(fw_text_end(&text));
    *out = text.data;
    return FW_OK;
}
