/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What bodies store as plane solids (mechanism/body_solid.c), in place of beams, where they give much: along a motion, and in
   small motions, of which no scene need know anything. Theory: docs/theory/verdict.md, 5b. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "maths/matrix.h"
#include "mechanism/mechanism_plates.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- along a motion ---- */

typedef fw_verdict_solids solids;

/* where loads act on a body, in any scene; 0 where one of them is narrower than the body's hinges and their ways, or there are
   too many: then all acts in the middle */
static fw_status add_loads(fw_arena *arena, const solids *s, int body, double narrow_m,
                           fw_mechanism_solid_end **end, int *n) {
    enum { LOADS = 16 };
    const double alike = 0.9; /* bars of one width differ by what a way finds of it */
    fw_mechanism_load_end *load;
    int nload, first = *n;
    FW_TRY(fw_mechanism_load_ends(arena, s->m, &load, &nload));
    FW_NEED(*end =
                fw_arena_grow(arena, *end, (size_t)*n, (size_t)*n + (size_t)nload, sizeof **end));
    for (int k = 0; k < nload; k++) {
        const fw_verdict_arm *arm = &s->arm[2 * s->m->nhinge + k];
        if (load[k].body != body || load[k].first != k) continue;
        if (!arm->known || arm->narrow_m < alike * narrow_m || *n - first >= LOADS) {
            *n = first;
            return FW_OK;
        }
        (*end)[(*n)++] = (fw_mechanism_solid_end){.pin = load[k].at, .root = load[k].at};
    }
    return FW_OK;
}

/* hinge ends in the order of hinges and sides, then the middle, then where loads act, if that is known */
static fw_status make_solid(fw_arena *arena, const solids *s, int body, fw_mechanism_solid *out) {
    const fw_mechanism *m = s->m;
    fw_mechanism_line *line;
    int nline, n = 0;
    double narrow = HUGE_VAL;
    fw_mechanism_solid_end *end =
        fw_arena_array(arena, fw_mechanism_solid_end, 2 * (size_t)m->nhinge + 1);
    FW_NEED(end);
    for (int i = 0; i < 2 * m->nhinge; i++) {
        fw_mechanism_solid_end here = {0};
        if (!fw_mechanism_hinge_end(m, body, i, &here.pin, &here.root)) continue;
        end[n++] = here;
        if (s->arm[i].known) narrow = fmin(narrow, s->arm[i].narrow_m);
    }
    const int nhinge = n;
    const fw_geometry_vec2 middle = s->layout->body[body].centroid;
    end[n++] = (fw_mechanism_solid_end){.pin = middle, .root = middle, .nearest = true};
    FW_TRY(add_loads(arena, s, body, narrow, &end, &n));
    FW_TRY(fw_mechanism_body_lines(arena, s->layout, body, &line, &nline));
    const fw_mechanism_solid_mesh as = {.middle = middle, .narrow_m = narrow};
    FW_TRY(fw_mechanism_solid_of(arena, line, nline, &as, end, n, out));
    if (!out->known && n > nhinge + 1)
        FW_TRY(fw_mechanism_solid_of(arena, line, nline, &as, end, nhinge + 1, out));
    out->nhinge = nhinge, out->end = end;
    return FW_OK;
}

/* w (3n) of a body at an instant: what its hinges put on it, axes of the drawn pose, and in its middle, `about`, all else: what
   loads, and inertia, bend beyond that is another bound (theory, 5a). placed: what acts at places is there, and not in the middle; false: the solid has not all of these */
static bool wrenches_of(const solids *s, const fw_verdict_bending *b, int body,
                        const fw_mechanism_solid *of, const double *instant, bool placed,
                        fw_geometry_vec2 about, double *w) {
    const fw_mechanism *m = s->m;
    const double turn = instant[3 * m->nhinge + body], *acts = instant + 3 * m->nhinge + m->nbody;
    const double same_m = 1e-9;
    double rest[3] = {0}, *first = w;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        if ((i % 2 ? pin->body_b : pin->body_a) != body) continue;
        const double *on = instant + 3 * (i / 2), sign = i % 2 ? 1 : -1;
        const fw_geometry_vec2 force = fw_geometry_vec_rotate(
                                   (fw_geometry_vec2){sign * on[1], sign * on[2]}, -turn),
                               arm = vec_sub(fw_mechanism_pin_place(m, pin, i % 2), about);
        *w++ = -sign * on[0], *w++ = force.x, *w++ = force.y;
        rest[0] -= -sign * on[0] + vec_cross(arm, force);
        rest[1] -= force.x, rest[2] -= force.y;
    }
    double *middle = w;
    bool all = true;
    for (w += 3; w < first + 3 * of->n; w++)
        *w = 0;
    for (int i = 0; placed && i < b->nplace; i++, acts += 3) {
        const fw_verdict_place *at = &b->place[i];
        if (at->body != body) continue;
        const fw_geometry_vec2 place = fw_mechanism_local_place(m, body, at->x_m, at->y_m),
                               arm = vec_sub(place, about),
                               force = fw_geometry_vec_rotate((fw_geometry_vec2){acts[0], acts[1]},
                                                              -turn);
        int end = of->nhinge + 1;
        while (end < of->n && vec_distance(of->end[end].pin, place) > same_m)
            end++;
        if (end == of->n) all = false; /* it stays in the middle */
        if (end == of->n) continue;
        double *to = first + 3 * end;
        to[0] += acts[2], to[1] += force.x, to[2] += force.y;
        rest[0] -= acts[2] + vec_cross(arm, force);
        rest[1] -= force.x, rest[2] -= force.y;
    }
    memcpy(middle, rest, sizeof rest);
    return all;
}

/* largest over instants: as beams, and as solids where these are known, with what acts beside hinges in the middle and where
   it does */
typedef struct stored {
    double beams_J, solids_J, acted_J, gone;
    bool
        mixed; /* of a body as a solid something that acts on it is not in that: it is no form in what acts */
    double *beam_J, *solid_J; /* (nbody) */
} stored;

/* how far the end of a hinge goes over its width, or turns over its limit, against the middle of a solid */
static double end_goes(const solids *s, const fw_mechanism_solid *of, const double *w, int end,
                       const fw_mechanism_hinge *h, fw_geometry_vec2 arm) {
    double to[3], middle[3];
    fw_mechanism_solid_goes(of, s->stiff_N, w, end, to);
    fw_mechanism_solid_goes(of, s->stiff_N, w, of->nhinge, middle);
    const double far =
        hypot(to[1] - middle[1] + middle[0] * arm.y, to[2] - middle[2] - middle[0] * arm.x);
    return fmax(far / h->input.width_m, fabs(to[0] - middle[0]) / h->closed_form.limit_angle_rad);
}

/* of one body: adds to what all store at the instant. sum: as beams; as solids where these are known, of hinges, and of what
   acts; of all that acts where it does, as beams, as solids, and as the stiffer of both */
static void body_stores(const solids *s, const fw_verdict_bending *b, int body,
                        const fw_mechanism_solid *of, const double *instant, double *w,
                        stored *most, double sum[6]) {
    const fw_mechanism *m = s->m;
    const double rad = instant[3 * m->nhinge + body];
    const fw_verdict_turn turn = {rad, cos(rad), sin(rad)};
    const fw_geometry_vec2 about = s->layout->body[body].centroid;
    const fw_verdict_places places = {body, b->nplace, s->nend, b->place, s->end};
    double beam = 0, meet, aside, softer[2];
    fw_verdict_softer(m, s->arm, b, body, softer);
    if (of->known) wrenches_of(s, b, body, of, instant, false, about, w);
    for (int i = 0, end = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_hinge *h = &m->hinge[i / 2];
        const fw_mechanism_pin *pin = &m->pin[h->pin];
        const double *on = instant + 3 * (i / 2);
        if ((i % 2 ? pin->body_b : pin->body_a) != body) continue;
        const fw_geometry_vec2 arm = vec_sub(fw_mechanism_pin_place(m, pin, i % 2), about);
        if (of->known)
            most->gone = fmax(most->gone, softer[0] * end_goes(s, of, w, end++, h, arm));
        else if (s->arm[i].known)
            most->gone =
                fmax(most->gone, fw_verdict_arm_gone(b, h, &s->arm[i], -on[0], on + 1, &turn));
        if (s->arm[i].known)
            beam += fw_verdict_arm_energy_J(&s->arm[i], s->stiff_N, -on[0], on[1], on[2], &turn);
    }
    const double all =
        fw_verdict_beams_J(m, s->arm, s->stiff_N, instant, &turn, &places, &meet, &aside);
    beam += meet;
    const double one =
        of->known ? softer[0] * fw_mechanism_solid_energy_J(of, s->stiff_N, w) : beam;
    double acted = one, known = all;
    if (of->known) {
        const bool placed = wrenches_of(s, b, body, of, instant, true, about, w);
        if (of->n > of->nhinge + 1)
            acted = softer[1] * fw_mechanism_solid_energy_J(of, s->stiff_N, w);
        known = placed ? acted : fmin(all, pow(sqrt(one) + sqrt(aside), 2)); /* two in step */
        most->mixed = most->mixed || !placed;
    }
    most->beam_J[body] = fmax(most->beam_J[body], beam);
    most->solid_J[body] = fmax(most->solid_J[body], one);
    sum[0] += beam, sum[1] += one, sum[2] += acted;
    sum[3] += all, sum[4] += known, sum[5] += fmin(all, known);
}

static fw_status take_solids(fw_arena *arena, const solids *s, const fw_mechanism_solid *solid,
                             fw_verdict_bending *b) {
    const fw_mechanism *m = s->m;
    const size_t bodies = (size_t)m->nbody;
    stored most = {.beam_J = fw_arena_array(arena, double, bodies),
                   .solid_J = fw_arena_array(arena, double, bodies)};
    int most_ends = 0;
    for (int i = 0; i < m->nbody; i++)
        most_ends = solid[i].n > most_ends ? solid[i].n : most_ends;
    double *w = fw_arena_array(arena, double, 3 * (size_t)most_ends + 3);
    FW_NEED(most.beam_J && most.solid_J ? w : NULL);
    for (int k = 0; k < b->kept->n; k++) {
        const double *instant =
            b->kept->instant + (size_t)k * fw_verdict_instant_size(m, b->nplace);
        double sum[6] = {0};
        for (int i = 0; i < m->nbody; i++)
            body_stores(s, b, i, &solid[i], instant, w, &most, sum);
        most.beams_J = fmax(most.beams_J, sum[0]), most.solids_J = fmax(most.solids_J, sum[1]);
        most.acted_J = fmax(most.acted_J, sum[2]);
    }
    if (!(most.beams_J > 0)) return FW_OK;
    bool acted = true;
    for (int i = 0; i < b->nplace; i++) {
        const fw_mechanism_solid *of = &solid[b->place[i].body];
        acted = acted && (!(b->place[i].force_N > 0) || (of->known && of->n > of->nhinge + 1));
    }
    if (acted) b->acted_J = b->bodies_J * most.acted_J / most.beams_J;
    b->bodies_J *= most.solids_J / most.beams_J;
    b->gone = most.gone;
    for (int i = 0; i < m->nbody; i++)
        if (most.beam_J[i] > 0) b->body_J[i] *= most.solid_J[i] / most.beam_J[i];
    return FW_OK;
}

/* room for what acts on every end, in scenes and where stiffnesses are asked for */
static fw_status ends_new(fw_arena *arena, solids *s) {
    fw_mechanism_load_end *load;
    int n;
    FW_TRY(fw_mechanism_load_ends(arena, s->m, &load, &n));
    s->nend = 2 * s->m->nhinge + n;
    FW_NEED(s->end = fw_arena_array(arena, double, 3 * (size_t)s->nend + 3));
    return FW_OK;
}

/* Solids are made of bodies that as beams give a hundredth of what the hinges do, where all of them come to what is told */
static fw_status by_solids(fw_arena *arena, const fw_layout *layout, fw_verdict_bending *b,
                           fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const double hardly = 0.01;
    solids s = {.m = m, .layout = layout, .arm = b->arm, .stiff_N = b->stiff_N};
    if (!b->kept || b->kept->n == 0 || !(b->bodies_J > fw_verdict_bending_told * b->hinges_J))
        return FW_OK;
    FW_TRY(ends_new(arena, &s));
    fw_mechanism_solid *solid = fw_arena_array(arena, fw_mechanism_solid, (size_t)m->nbody);
    FW_NEED(solid);
    for (int i = 0; i < m->nbody; i++) {
        if (v->solid) solid[i] = v->solid[i];
        if (!solid[i].fine && b->body_J[i] > hardly * b->hinges_J)
            FW_TRY(make_solid(arena, &s, i, &solid[i]));
    }
    v->solid = solid;
    return take_solids(arena, &s, solid, b);
}

fw_status fw_verdict_bending_end(fw_arena *arena, const fw_layout *layout,
                                 fw_verdict_strain_monitor *monitor,
                                 fw_verdict_strain_monitor *other, fw_verdict_variant_verdict *v) {
    if (layout) FW_TRY(by_solids(arena, layout, &monitor->bending, v));
    if (layout) FW_TRY(by_solids(arena, layout, &other->bending, v));
    fw_verdict_places_end(&monitor->bending);
    fw_verdict_places_end(&other->bending);
    return FW_OK;
}

/* ---- small motions ----
   A load f at rest displaces rigid bodies on flexures that give by

     u = sum over modes of phi (phi . f)/(M omega^2)

   and flexures put on their bodies by it what is in balance with f. With what bodies store by that, U_b(f), the theorem of
   least complementary energy bounds what the whole device gives, c_h of rigid bodies:

     c(f) <= c_h(f) + 2 U_b(f)

   In: the mechanism at rest, arms (body_arms.c), solids where they are known. Out: 2 U_b(f) of a place, m/N, with the way from there to the
   body's middle. Range: flexures with an axis, no joints beside them, all modes found. Error: a
   bound; from the other side bodies are rigid. Of frequencies: body_swing.c. Cost: one search for modes at rest. Source: S. Timoshenko, J. Goodier,
   Theory of Elasticity, 3rd ed., art. 86. Test: test_effects.py
   BodiesInSmallMotions */

typedef struct small {
    fw_arena *arena;
    solids s;
    const fw_mechanism_solid *solid;
    const fw_statics_modes *modes;
    fw_verdict_bending at; /* the place that is loaded, or none */
    fw_verdict_place place;
    double *f, *u, *instant, *w;
    stored most;
} small;

enum { MOST_BODIES = 40 };

static bool has_laws(const fw_mechanism *m) {
    for (int k = 0; k < m->nhinge; k++) {
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&m->hinge[k].law, 0, &at);
        if (!isfinite(m->hinge[k].axis_rad) || !(at.kx_N_per_m.value > 0) ||
            !isfinite(at.kx_N_per_m.value) || !(at.ky_N_per_m.value > 0) ||
            !isfinite(at.ky_N_per_m.value))
            return false;
    }
    return m->nhinge > 0 && m->njoint == 0 && m->layout != NULL && m->nbody <= MOST_BODIES;
}

/* *modes NULL: they are not all found */
static fw_status modes_at_rest(fw_arena *arena, const fw_mechanism *m, const fw_effect_choice *with,
                               const fw_statics_modes **modes) {
    static const fw_device_scene nothing = {.name = "(none)", .duration_s = 1};
    fw_statics_mode_options o = {.effects = *with, .accuracy = 0.03};
    o.effects.hinge = FW_HINGE_COMPLIANCE;
    fw_diags own = fw_diags_new(arena);
    *modes = NULL;
    const fw_status status = fw_statics_small_motions(arena, m, &nothing, &o, &own, modes);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    if (status != FW_OK || (*modes)->count < (*modes)->dof) *modes = NULL;
    for (int k = 0; *modes && k < (*modes)->count; k++)
        if (!((*modes)->mode[k].stiffness_per_s2 > 0)) *modes = NULL;
    return FW_OK;
}

void fw_verdict_displaced(const fw_statics_modes *modes, const double *f, double *u) {
    const size_t n = 3 * (size_t)modes->nbody;
    memset(u, 0, n * sizeof *u);
    for (int k = 0; k < modes->count; k++) {
        const fw_statics_mode *mode = &modes->mode[k];
        double by = 0;
        for (size_t i = 0; i < n; i++)
            by += mode->shape[i] * f[i];
        by /= mode->modal_mass_kg_m2 * mode->stiffness_per_s2;
        for (size_t i = 0; i < n; i++)
            u[i] += by * mode->shape[i];
    }
}

/* moment of the flexure, and force on body b, world, as an instant of a motion has them */
static void hinge_puts(const small *x, int hinge, double on[3]) {
    const fw_mechanism *m = x->s.m;
    const fw_mechanism_hinge *h = &m->hinge[hinge];
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    fw_flexure_hinge_at at;
    fw_geometry_vec2 d = {0, 0};
    double turn = 0;
    for (int side = 0; side < 2; side++) {
        const int body = side ? pin->body_b : pin->body_a;
        const double sign = side ? 1 : -1, *u = x->u + 3 * body;
        if (body == FW_GROUND) continue;
        const fw_geometry_vec2 r =
            vec_sub(fw_mechanism_pin_place(m, pin, side),
                    (fw_geometry_vec2){m->drawn[body].x_m, m->drawn[body].y_m});
        d.x += sign * (u[0] - u[2] * r.y), d.y += sign * (u[1] + u[2] * r.x);
        turn += sign * u[2];
    }
    fw_flexure_hinge_law_at(&h->law, 0, &at);
    const double c = cos(h->axis_rad), s = sin(h->axis_rad),
                 along = at.kx_N_per_m.value * (c * d.x + s * d.y),
                 across = at.ky_N_per_m.value * (c * d.y - s * d.x);
    on[0] = pin->stiffness_Nm_per_rad * turn;
    on[1] = across * s - along * c, on[2] = -along * s - across * c;
}

/* 2 U_b of the load x->f: as beams, and as solids where they are known, with what acts at the place there, too, if that is known */
static void load_stores(small *x, double *beams, double *found) {
    const fw_mechanism *m = x->s.m;
    double sum[6] = {0};
    fw_verdict_displaced(x->modes, x->f, x->u);
    for (int k = 0; k < m->nhinge; k++)
        hinge_puts(x, k, x->instant + 3 * k);
    for (int i = 0; i < m->nbody; i++)
        body_stores(&x->s, &x->at, i, &x->solid[i], x->instant, x->w, &x->most, sum);
    const double bases = fw_verdict_bases_J(m, x->s.arm, x->s.stiff_N, x->instant, x->s.end);
    *beams = 2 * (sum[0] + bases), *found = 2 * ((x->at.nplace > 0 ? sum[5] : sum[1]) + bases);
}

/* Of all that bodies may store those that store a twentieth of it are made solids */
static fw_status make_solids(small *x, fw_verdict_variant_verdict *v) {
    const int n = x->s.m->nbody;
    const double part = 0.05;
    double all = 0;
    fw_mechanism_solid *solid = fw_arena_array(x->arena, fw_mechanism_solid, (size_t)n);
    FW_NEED(solid);
    for (int i = 0; i < n; i++)
        all += x->most.beam_J[i];
    for (int i = 0; i < n; i++) {
        solid[i] = x->solid[i];
        if (!solid[i].fine && x->most.beam_J[i] > part * all)
            FW_TRY(make_solid(x->arena, &x->s, i, &solid[i]));
    }
    x->solid = v->solid = solid;
    return FW_OK;
}

fw_status fw_verdict_solids_new(fw_arena *arena, const fw_verdict_variant_verdict *v, solids *s) {
    const fw_mechanism *m = v->mechanism;
    const size_t bodies = (size_t)m->nbody;
    size_t ends = 2 * (size_t)m->nhinge + 64;
    const fw_mechanism_solid *none = fw_arena_array(arena, fw_mechanism_solid, bodies);
    FW_NEED(none);
    *s = (solids){.m = m,
                  .layout = m->layout,
                  .arm = v->arm,
                  .solid = v->solid ? v->solid : none,
                  .stiff_N = m->variant->material.youngs.value * m->variant->thickness_m};
    for (int i = 0; i < m->nbody; i++)
        if (s->solid[i].known) ends += (size_t)s->solid[i].n;
    FW_NEED(s->w = fw_arena_array(arena, double, 3 * ends + 2 * bodies));
    s->each = s->w + 3 * ends;
    return ends_new(arena, s);
}

static fw_status small_new(fw_arena *arena, const fw_verdict_variant_verdict *v, small *x) {
    const fw_mechanism *m = v->mechanism;
    const size_t bodies = (size_t)m->nbody;
    x->arena = arena;
    FW_TRY(fw_verdict_solids_new(arena, v, &x->s));
    x->solid = x->s.solid, x->w = x->s.w;
    x->at = (fw_verdict_bending){.arm = v->arm, .stiff_N = x->s.stiff_N, .place = &x->place};
    FW_NEED(x->f = fw_arena_array(arena, double, 6 * bodies + fw_verdict_instant_size(m, 1)));
    x->u = x->f + 3 * bodies, x->instant = x->u + 3 * bodies;
    FW_NEED(x->most.beam_J = fw_arena_array(arena, double, 2 * bodies));
    x->most.solid_J = x->most.beam_J + bodies;
    return FW_OK;
}

void fw_verdict_solids_J(const solids *s, const fw_verdict_bending *b, const double *instant,
                         double both[2], bool *mixed) {
    double sum[6] = {0};
    stored most = {.beam_J = s->each, .solid_J = s->each + s->m->nbody};
    for (int i = 0; i < s->m->nbody; i++)
        body_stores(s, b, i, &s->solid[i], instant, s->w, &most, sum);
    *mixed = *mixed || most.mixed;
    const double bases = fw_verdict_bases_J(s->m, s->arm, s->stiff_N, instant, s->end);
    both[0] = sum[3] + bases, both[1] = sum[4] + bases;
}

fw_status fw_verdict_unit_load(fw_arena *arena, const solids *s, const fw_statics_modes *modes,
                               int body, fw_geometry_vec2 at, double direction_rad, double *on) {
    small x = {.s = *s, .modes = modes};
    const double fx = cos(direction_rad), fy = sin(direction_rad);
    const fw_geometry_vec2 r =
        vec_sub(at, (fw_geometry_vec2){s->m->drawn[body].x_m, s->m->drawn[body].y_m});
    FW_NEED(x.f = fw_arena_array(arena, double, 6 * (size_t)s->m->nbody));
    x.u = x.f + 3 * s->m->nbody;
    x.f[3 * body] = fx, x.f[3 * body + 1] = fy, x.f[3 * body + 2] = r.x * fy - r.y * fx;
    fw_verdict_displaced(modes, x.f, x.u);
    for (int k = 0; k < s->m->nhinge; k++)
        hinge_puts(&x, k, on + 3 * k);
    return FW_OK;
}

/* a unit load at the probe's place, and as what acts there */
static fw_status load_place(small *x, const fw_probe *p) {
    const fw_mechanism *m = x->s.m;
    const fw_effects_port *at = &p->point[0];
    const double c = cos(p->asked->direction_rad), s = sin(p->asked->direction_rad);
    fw_mechanism_load_end *end;
    int n;
    FW_TRY(fw_mechanism_load_ends(x->arena, m, &end, &n));
    const fw_geometry_vec2 r =
        vec_sub(fw_mechanism_local_place(m, at->body, at->x_m, at->y_m),
                (fw_geometry_vec2){m->drawn[at->body].x_m, m->drawn[at->body].y_m});
    double *f = x->f + 3 * at->body, *acts = x->instant + 3 * m->nhinge + m->nbody;
    f[0] = acts[0] = c, f[1] = acts[1] = s, f[2] = r.x * s - r.y * c;
    for (int k = 0; k < n; k++) {
        const int by = 2 * m->nhinge + end[k].first;
        if (end[k].scene != FW_NONE || end[k].id != p->asked->id) continue;
        x->place = (fw_verdict_place){.body = end[k].body,
                                      .x_m = end[k].x_m,
                                      .y_m = end[k].y_m,
                                      .arm = &x->s.arm[by],
                                      .end = by};
        x->at.nplace = x->s.arm[by].known;
    }
    return FW_OK;
}

/* What bodies add to the compliance of a place, with the way to the middle */
static fw_status small_gives(small *x, const fw_probe *p, double gives, double *most) {
    const size_t bodies = (size_t)x->s.m->nbody;
    double beams, found;
    memset(x->f, 0, 3 * bodies * sizeof *x->f);
    memset(x->most.beam_J, 0, 2 * bodies * sizeof *x->most.beam_J);
    x->at.nplace = 0;
    FW_TRY(load_place(x, p));
    load_stores(x, &beams, &found);
    *most = x->at.nplace > 0 ? found : fmin(beams, found) + gives;
    return FW_OK;
}

/* of the same at rest with flexures that give: a stiffness, or omega^2 */
static double at_rest_is(const fw_probe *p, const fw_statics_modes *modes, int mode) {
    if (p->kind->takes != FW_PROBE_TANGENT)
        return mode <= modes->count ? modes->mode[mode - 1].stiffness_per_s2 : (double)NAN;
    const double value = fw_probe_small(p, modes);
    return p->asked->row == FW_PROBE_IS_compliance ? 1 / value : value;
}

/* Loads soften and stiffen what they leave of a stiffness k, at rest k_0: the series with bodies takes k_0 - 1/(1/k_0 + c) of
   it, and of what loads have made stiffer as much more */
static double left_of_series(double k, double k0, double c) {
    const double whole = fmax(k, k0);
    return fmax(0, 1 - (whole - 1 / (1 / whole + c)) / k);
}

/* to (count): what bodies add to 1/omega^2 of the first modes (body_swing.c), s2, with what directions of a crystal may be off by
   and beams by their corners. *why NULL, or a clause: it is not known */
fw_status fw_verdict_soft_swings(fw_arena *arena, const fw_verdict_soft *soft,
                                 const fw_verdict_variant_verdict *v, int count, double *to,
                                 const char **why) {
    const double crystal = 0.15;
    *why = "joints that are no flexures with an axis hold its bodies, or too many of them, so that "
           "what "
           "these do by their own mass is not known";
    if (!soft->modes) return FW_OK;
    double *heavy = fw_arena_array(arena, double, (size_t)count);
    fw_mechanism_plates p;
    FW_NEED(heavy);
    FW_TRY(fw_verdict_slowest_swings(arena, v->mechanism, v->arm, count, to, why));
    FW_TRY(fw_mechanism_plates_new(arena, v->mechanism, NULL, &p));
    FW_TRY(fw_verdict_heavy(arena, &p, false, count, heavy)); /* flexures between their ends */
    for (int k = 0; k < count; k++) {
        const double rigid = k < soft->modes->count ? 1 / soft->modes->mode[k].stiffness_per_s2 : 0;
        to[k] = fmax((1 + crystal) * fmax(0, to[k] - rigid), heavy[k] - rigid);
    }
    return FW_OK;
}

fw_status fw_verdict_soft_new(fw_arena *arena, const fw_effect_choice *with, double of_scenes,
                              const fw_verdict_variant_verdict *v, fw_verdict_soft *soft) {
    *soft = (fw_verdict_soft){.looked = true, .of_scenes = of_scenes};
    if (!v->arm || !has_laws(v->mechanism)) return FW_OK;
    return modes_at_rest(arena, v->mechanism, with, &soft->modes);
}

fw_status fw_verdict_soft_leaves(fw_arena *arena, fw_verdict_soft *soft, const fw_probe *p,
                                 int mode, double value, bool closely,
                                 fw_verdict_variant_verdict *v, double *left) {
    const bool is_mode = p->kind->takes != FW_PROBE_TANGENT,
               yields = p->asked->row == FW_PROBE_IS_compliance;
    const double k = is_mode ? pow(FW_TURN * value, 2) : yields ? 1 / value : value;
    double gives, most;
    FW_TRY(fw_verdict_place_gives(arena, v->mechanism, v->arm, p->asked, &gives));
    const double soft_by_scenes = 1 + soft->of_scenes + gives * k;
    *left = 1 / (is_mode ? sqrt(soft_by_scenes) : soft_by_scenes);
    soft->why = NULL;
    if (is_mode && v->arm) {
        double *adds = fw_arena_array(arena, double, (size_t)mode);
        FW_NEED(adds);
        FW_TRY(fw_verdict_soft_swings(arena, soft, v, mode, adds, &soft->why));
        const double rest = mode <= (soft->modes ? soft->modes->count : 0)
                                ? at_rest_is(p, soft->modes, mode)
                                : (double)NAN;
        if (!soft->why && rest > 0 && k > 0) *left = sqrt(left_of_series(k, rest, adds[mode - 1]));
        return FW_OK;
    }
    if (!soft->modes || (is_mode ? mode > soft->modes->count : p->point[0].body == FW_GROUND))
        return FW_OK;
    const double k0 = at_rest_is(p, soft->modes, mode);
    small x = {.modes = soft->modes};
    if (!(k0 > 0) || !(k > 0)) return FW_OK;
    FW_TRY(small_new(arena, v, &x));
    FW_TRY(small_gives(&x, p, gives, &most));
    if (closely) {
        FW_TRY(make_solids(&x, v));
        FW_TRY(small_new(arena, v, &x));
        FW_TRY(small_gives(&x, p, gives, &most));
    }
    *left = left_of_series(k, k0, most);
    return FW_OK;
}

/* *less: by how much, of either kind; the mode in the plane that lies next above one across it as rigid bodies have it may be the lower one */
fw_status fw_verdict_soft_overtakes(fw_arena *arena, const fw_effect_choice *with,
                                    const fw_statics_modes *modes,
                                    const fw_verdict_variant_verdict *v,
                                    const fw_verdict_requirement *r, double *less) {
    fw_verdict_soft soft;
    const char *why;
    int k = 0;
    const fw_device *d = v->mechanism->device;
    *less = 0;
    if (d->probe[d->requirement[r->asked].probe].plane != FW_PLANE_EITHER || r->why || !modes ||
        !v->arm)
        return FW_OK;
    while (k < modes->count && modes->mode[k].f_Hz <= r->value)
        k++;
    double *adds = fw_arena_array(arena, double, (size_t)k + 1);
    FW_NEED(adds);
    FW_TRY(fw_verdict_soft_new(arena, with, 0, v, &soft));
    FW_TRY(fw_verdict_soft_swings(arena, &soft, v, k + 1, adds, &why));
    const bool rigid = k < modes->count;
    const double off = rigid ? fmin(fw_statics_mode_error(&modes->mode[k]), 1) : 0,
                 s2 = adds[k] + (rigid ? 1 / modes->mode[k].stiffness_per_s2 : 0),
                 low = why || !(s2 > 0) ? r->low : (1 - off) / (FW_TURN * sqrt(s2));
    *less = fmax(0, r->low - low);
    return FW_OK;
}

/* NULL: there are none */
fw_status fw_verdict_modes_about(fw_arena *arena, const fw_mechanism *m,
                                 const fw_device_scene *scene, bool at_equilibrium, double accuracy,
                                 const fw_statics_modes **modes) {
    const fw_statics_mode_options o = {.accuracy = accuracy, .at_equilibrium = at_equilibrium};
    fw_diags own = fw_diags_new(arena);
    *modes = NULL;
    fw_status status = fw_statics_small_motions(arena, m, scene, &o, &own, modes);
    if (status == FW_CANCELLED) return status;
    return status == FW_NOMEM || own.failed ? FW_NOMEM : FW_OK;
}
