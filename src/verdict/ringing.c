/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What comes again while a mode still rings. All that a scene puts on its modes acts together (7a of docs/theory/verdict.md):
   of every mode its modal force, the law of each, and what a unit of it bends hinges and moves bodies by. Of hinge or body i,
   b_ki by how far mode k swings in the motion, c_ij where what is prescribed by law j holds it at rest, S_i the most of the
   motion,

     A_i = max over time of |sum of b_ki q_k + sum of (c_ij - sum of b_ki p_kj) f_j|/S_i

   q_k the oscillator, p_kj its part of law j: the modes ring, and what they leave out is where it rests. A_i(w) - A_i as
   computed widens by one mode that lies elsewhere, or is damped by either end of a loss factor, for all that do; and of all together where all lie lower, or higher, by
   one share, since then what rings in one may meet what rings in another.

   In: the motion, modes, loads. Out: answers of hinges and bodies. Range: small motions; modes that bend or move by a hundredth
   of what does most. Error: frequencies half a radian apart at the end. Cost: fw_quantity_law_swings_of. Test: test_effects.py */
#include "base/constants.h"
#include "geometry/segment.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* the elements of its motion, and how far one unit of each driver that moves, then of each heat, then the stress of layers,
   holds every body from where it rests (rows of 3 nbody) */
typedef struct acting {
    const fw_effects_loads *loads;
    const double *way;
    int ways; /* the last ones of loads_on */
} acting;

/* ---- what loads do to a mode ----
   The modal force of everything that a scene puts on a mode, at a law of 1: forces, torques, shaking and weight by the mode's
   shape u; voltages (whose law acts by its square) and tendons by what their elements say at the pose, f . w with w the
   ports' way by u. Drivers, heat and stress have no force: where they hold the device at rest, x, is found as an equilibrium, and
   u . M x omega^2 is the modal force that would. In: shapes and poses in SI. Range: small motions, as modes are; of what
   goes far the way to its farthest value stands for all. Test: test_effects.py,
   test_what_comes_again_whatever_drives_it */

static double with_masses(const fw_mechanism *m, const double *u, double ax, double ay) {
    double sum = 0;
    for (int b = 0; b < m->nbody; b++)
        sum += m->body[b].mass_kg * (u[3 * b] * ax + u[3 * b + 1] * ay);
    return sum;
}

/* how many there are at most; by NULL: laws alone */
static int loads_most(const fw_mechanism *m, const fw_device_scene *s, const acting *by) {
    return s->nforce + s->ntorque + s->nbase + s->ncomb + s->ntendon + s->ntemperature +
           m->ndriver + 3 + (by && by->loads ? by->loads->nelement : 0);
}

/* of an element without its law */
static double element_on(const fw_effects_force_element *e, const double *q, const double *shape) {
    double p[3 * FW_VERDICT_PORTS], w[3 * FW_VERDICT_PORTS], f[3 * FW_VERDICT_PORTS], sum = 0;
    if (!fw_verdict_element_forces(e, q, p, f)) return 0;
    fw_effects_element_place_ports(e, q, shape, p, w);
    for (int i = 0; i < 3 * e->ports; i++)
        sum += f[i] * w[i];
    return isfinite(sum) ? sum : 0;
}

/* combs and tendons: shape NULL: their laws alone */
static int elements_on(const fw_device_scene *s, const acting *by, const double *q,
                       const double *shape, double unit, fw_quantity_law_load *load) {
    int n = 0;
    for (int i = 0; !shape && i < s->ncomb; i++)
        if (s->comb[i].voltage_V != 0)
            load[n++] = (fw_quantity_law_load){s->comb[i].law, 1, true, 0, false};
    for (int i = 0; !shape && i < s->ntendon; i++) {
        const fw_device_tendon *t = &s->tendon[i];
        if (!(isnan(t->pull_N) ? t->draw_m == 0 : t->pull_N == 0))
            load[n++] = (fw_quantity_law_load){t->law, 1, false, 0, false};
    }
    for (int i = 0; shape && by->loads && i < by->loads->nelement; i++) {
        const fw_effects_force_element *e = &by->loads->element[i];
        load[n++] =
            (fw_quantity_law_load){e->laws > 0 ? e->law[0] : NULL, element_on(e, q, shape) / unit,
                                   e->class_->electrodes, 0, false};
    }
    return n;
}

static fw_status acting_of(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                           const fw_effects_loads *loads, acting *by, const char **unknown) {
    fw_verdict_held_ways held;
    FW_TRY(fw_verdict_ways_held(arena, m, s, &held));
    *by = (acting){.loads = loads, .way = held.way, .ways = held.n}, *unknown = held.unknown;
    return FW_OK;
}

static int loads_on(const fw_mechanism *m, const fw_device_scene *s, const acting *by,
                    const double *q, const double *shape, double square, double unit,
                    fw_quantity_law_load *load) {
    int n = 0;
    for (int i = 0; i < s->nforce; i++) {
        const fw_device_force *f = &s->force[i];
        if (f->body == FW_GROUND) continue;
        const double *u = shape ? shape + 3 * f->body : NULL;
        const fw_geometry_vec2 arm =
            fw_geometry_vec_rotate((fw_geometry_vec2){f->x_m, f->y_m}, u ? q[3 * f->body + 2] : 0);
        const double sum =
            !u ? 1 : f->fx_N * (u[0] - arm.y * u[2]) + f->fy_N * (u[1] + arm.x * u[2]);
        load[n++] = (fw_quantity_law_load){.law = f->law, .size = sum / unit};
    }
    for (int i = 0; i < s->ntorque; i++)
        if (s->torque[i].body != FW_GROUND)
            load[n++] = (fw_quantity_law_load){
                .law = s->torque[i].law,
                .size =
                    shape ? s->torque[i].value_Nm * shape[3 * s->torque[i].body + 2] / unit : 1};
    for (int i = 0; i < s->nbase; i++)
        if (s->base[i].ax_m_per_s2 != 0 || s->base[i].ay_m_per_s2 != 0)
            load[n++] = (fw_quantity_law_load){
                .law = s->base[i].law,
                .size =
                    shape ? -with_masses(m, shape, s->base[i].ax_m_per_s2, s->base[i].ay_m_per_s2) /
                                unit
                          : 1};
    if (s->gx_m_per_s2 != 0 || s->gy_m_per_s2 != 0)
        load[n++] = (fw_quantity_law_load){
            .size = shape ? with_masses(m, shape, s->gx_m_per_s2, s->gy_m_per_s2) / unit : 1};
    n += elements_on(s, by, q, shape, unit, load + n);
    const int laws = fw_verdict_laws_held(m, s, load + n);
    for (int i = 0; shape && i < laws; i++) {
        const double *way = by->way + (size_t)i * 3 * (size_t)m->nbody;
        load[n + i].size = fw_verdict_mass_form(m, shape, way) * square / unit;
    }
    return n + laws;
}

fw_status fw_verdict_comes_again(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                                 bool *again, fw_quantity_law_pieces *pieces) {
    fw_quantity_law_load *load =
        fw_arena_array(arena, fw_quantity_law_load, (size_t)loads_most(m, s, NULL));
    FW_NEED(load);
    int n = loads_on(m, s, NULL, NULL, NULL, 1, 1, load);
    /* velocities that a scene begins with ring on as what comes at once does (fw_verdict_shaken_mode.start) */
    if (s->ninitial > 0) load[n++] = (fw_quantity_law_load){.size = 1};
    *again = fw_quantity_law_come_again(load, n, s->duration_s);
    return *again ? fw_quantity_law_pieces_of(arena, load, n, s->duration_s, pieces) : FW_OK;
}

/* ---- how far each mode swings, and bends what ---- */

/* How a hinge is bent: its turn, and what its ends are displaced by. A leaf that is displaced across itself by u and not
   turned has root moments 6 EI u/L^2, one that is turned by theta EI theta/L: u counts as 6/L of a turn. Arcs are strained
   about as much; along a leaf nothing gives that far. */
typedef fw_verdict_bends bent;

bent fw_verdict_bend_of(const fw_mechanism_hinge *h, double turn, double x_m, double y_m) {
    const double by = h->law.length_m > 0 ? 6 / h->law.length_m : 0;
    return (bent){turn, by * x_m, by * y_m};
}

double fw_verdict_bends_most(fw_verdict_bends b) {
    return fabs(b.turn) + hypot(b.x, b.y);
}

/* by a small displacement u about the pose q */
static bent bent_by(const fw_mechanism *m, const fw_mechanism_hinge *h, const double *q,
                    const double *u) {
    const fw_mechanism_pin *p = &m->pin[h->pin];
    const int body[2] = {p->body_a, p->body_b};
    const double local[2][2] = {{p->ax_m, p->ay_m}, {p->bx_m, p->by_m}};
    double turn = 0, x = 0, y = 0;
    for (int i = 0; i < 2; i++) {
        const int b = body[i];
        if (b == FW_GROUND) continue;
        const double sign = i ? 1 : -1;
        const fw_geometry_vec2 arm =
            fw_geometry_vec_rotate((fw_geometry_vec2){local[i][0], local[i][1]}, q[3 * b + 2]);
        turn += sign * u[3 * b + 2];
        x += sign * (u[3 * b] - arm.y * u[3 * b + 2]);
        y += sign * (u[3 * b + 1] + arm.x * u[3 * b + 2]);
    }
    return fw_verdict_bend_of(h, turn, x, y);
}

/* between two poses, exactly */
static double bent_between(const fw_mechanism *m, const fw_mechanism_hinge *h, const double *from,
                           const double *to) {
    const fw_mechanism_pin *p = &m->pin[h->pin];
    double turn = 0;
    if (p->body_a != FW_GROUND) turn -= to[3 * p->body_a + 2] - from[3 * p->body_a + 2];
    if (p->body_b != FW_GROUND) turn += to[3 * p->body_b + 2] - from[3 * p->body_b + 2];
    const fw_geometry_vec2 before = fw_mechanism_pin_opened(p, from),
                           after = fw_mechanism_pin_opened(p, to);
    return fw_verdict_bends_most(
        fw_verdict_bend_of(h, turn, after.x - before.x, after.y - before.y));
}

/* u . M (x, y) of one body, by what it is given turned back by `turn` */
static double of_body(const fw_mechanism *m, int b, const double *u, const double *of,
                      double turn) {
    const fw_geometry_vec2 at = fw_geometry_vec_rotate((fw_geometry_vec2){of[0], of[1]}, -turn);
    const fw_mechanism_mass *is = &m->body[b];
    return is->mass_kg * (u[0] * at.x + u[1] * at.y) + is->inertia_kg_m2 * u[2] * of[2];
}

/* how far a mode is from where it began, in units of its shape */
static double way_from(const fw_mechanism *m, const fw_statics_mode *mode,
                       const fw_dynamics_motion *motion, int row) {
    double sum = 0;
    for (int b = 0; b < m->nbody; b++) {
        const double *from = motion->q + 3 * b, *to = from + (size_t)row * 3 * (size_t)m->nbody;
        const double way[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
        sum += of_body(m, b, mode->shape + 3 * b, way, 0.5 * way[2]);
    }
    return sum / mode->modal_mass_kg_m2;
}

/* largest modal speed over w of every mode: in the scene, and in the last period of its frequency; how far it goes from the
   start, no less than the first (bodies that turn: along the chord); *start: its speed there, with its sign */
static void see_swings(const fw_mechanism *m, const fw_statics_modes *modes,
                       const fw_dynamics_motion *motion, int k, double swings[3], double *start) {
    const fw_statics_mode *mode = &modes->mode[k];
    const double w = mode->omega_rad_per_s, late = motion->end_s - 2 * FW_PI / w;
    swings[0] = swings[1] = swings[2] = *start = 0;
    for (int r = 0; r < motion->nsample; r++) {
        const double *v = motion->v + (size_t)r * 3 * (size_t)m->nbody;
        const double speed = fw_verdict_mass_form(m, mode->shape, v);
        const double now = fabs(speed) / (mode->modal_mass_kg_m2 * w);
        if (r == 0) *start = speed / mode->modal_mass_kg_m2;
        swings[0] = fmax(swings[0], now);
        swings[2] = fmax(swings[2], fmax(now, fabs(way_from(m, mode, motion, r))));
        if (motion->t_s[r] >= late || r + 2 >= motion->nsample) swings[1] = fmax(swings[1], now);
    }
}

/* S of every hinge, and how far every body goes (nhinge + nbody) */
static void see_most(const fw_mechanism *m, const fw_dynamics_motion *motion, double unit_m,
                     double *most) {
    const size_t n = 3 * (size_t)m->nbody;
    for (int r = 1; r < motion->nsample; r++) {
        const double *from = motion->q, *to = motion->q + (size_t)r * n;
        for (int h = 0; h < m->nhinge; h++)
            most[h] = fmax(most[h], bent_between(m, &m->hinge[h], from, to));
        for (int b = 0; b < m->nbody; b++) {
            const double u[3] = {to[3 * b] - from[3 * b], to[3 * b + 1] - from[3 * b + 1],
                                 to[3 * b + 2] - from[3 * b + 2]};
            most[m->nhinge + b] =
                fmax(most[m->nhinge + b], hypot(u[0], u[1]) + unit_m * fabs(u[2]));
        }
    }
}

/* of hinge, body or what may be met i */
static bent seen_by(const fw_mechanism *m, const fw_statics_modes *modes,
                    const fw_verdict_shaken *s, const double *u, int i) {
    const int met = i - m->nhinge - m->nbody;
    if (i < m->nhinge) return bent_by(m, &m->hinge[i], modes->q, u);
    if (met >= 0) return (bent){.x = fw_verdict_reach_by(&s->reach[met], modes->q, u)};
    const double *of = u + 3 * (i - m->nhinge);
    return (bent){modes->unit_length_m * of[2], of[0], of[1]};
}

/* over what does it most; what hardly does beside the others is moved by them */
static void put_bends(const fw_mechanism *m, const fw_statics_modes *modes,
                      const fw_verdict_shaken *s, const double *u, double unit, bent *to) {
    const double hardly = 1e-3;
    const int nh = m->nhinge;
    const double *most = s->most, bends = fw_verdict_most_of(most, nh),
                 goes = fw_verdict_most_of(most + nh, m->nbody);
    for (int i = 0; i < nh + m->nbody + s->nreach; i++) {
        if (!(most[i] > hardly * (i < nh ? bends : goes))) continue;
        const bent of = seen_by(m, modes, s, u, i);
        const double by = unit / most[i];
        to[i] = (bent){by * of.turn, by * of.x, by * of.y};
    }
}

fw_status fw_verdict_swings(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                            bool again, const fw_statics_modes *modes,
                            const fw_dynamics_motion *motion, int most_modes,
                            fw_verdict_shaken *to) {
    const double hardly = 1e-3, rings = 0.01;
    acting by = {0};
    fw_dynamics_motion_rows(motion, 0, motion->nsample); /* they wait for whom reads them */
    FW_TRY(fw_verdict_reach_find(arena, motion, modes->unit_length_m, modes->q, to));
    fw_verdict_reach_gives(modes, most_modes, false, to);
    const int rows = m->nhinge + m->nbody + to->nreach;
    FW_NEED(to->most = fw_arena_array(arena, double, (size_t)rows));
    see_most(m, motion, modes->unit_length_m, to->most);
    for (int i = rows - to->nreach, c = 0; i < rows; i++)
        to->most[i] = to->reach[c++].goes_m;
    if (again) {
        FW_TRY(acting_of(arena, m, s, motion->loads, &by, &to->unknown));
        FW_NEED(to->way = fw_arena_array(arena, bent, (size_t)rows * (size_t)by.ways));
        to->ways = by.ways;
        for (int j = 0; j < by.ways; j++)
            put_bends(m, modes, to, by.way + (size_t)j * 3 * (size_t)m->nbody, 1,
                      to->way + (size_t)j * (size_t)rows);
    }
    for (int k = 0; k < modes->count && k < most_modes; k++) {
        const fw_statics_mode *mode = &modes->mode[k];
        double swings[3], start, share = 0;
        if (!(mode->stiffness_per_s2 > 0) || !mode->shape) continue;
        see_swings(m, modes, motion, k, swings, &start);
        fw_verdict_shaken_mode *out = &to->mode[to->n];
        FW_NEED(out->bends = fw_arena_array(arena, bent, (size_t)rows));
        put_bends(m, modes, to, mode->shape, swings[0], out->bends);
        for (int i = 0; i < rows; i++)
            share = fmax(share, fw_verdict_bends_most(out->bends[i]));
        if (!(share > hardly)) continue;
        out->number = k;
        out->omega = mode->omega_rad_per_s;
        for (int i = 0; i < 3; i++)
            out->damping[i] = fw_verdict_damping_of(mode);
        out->late = swings[1] / swings[0], out->goes = swings[2] / swings[0];
        out->start = start / swings[0];
        to->n++;
        if (!again || !(share > rings)) continue;
        FW_NEED(to->load =
                    fw_arena_array(arena, fw_quantity_law_load, (size_t)loads_most(m, s, &by)));
        to->nload = loads_on(m, s, &by, modes->q, mode->shape, mode->stiffness_per_s2,
                             mode->modal_mass_kg_m2 * mode->stiffness_per_s2 * swings[0], to->load);
        FW_NEED(out->size = fw_arena_array(arena, double, (size_t)to->nload + 1));
        for (int j = 0; j < to->nload; j++)
            out->size[j] = to->load[j].size;
    }
    return FW_OK;
}

/* ---- what they may do more or less ---- */

double fw_verdict_soft_within(fw_verdict_softness softer, const fw_verdict_shaken_mode *mode,
                              double at) {
    const double is = fmin(fmax(at, mode->soft), mode->stiff),
                 by = mode->omega / fmax(is, mode->least); /* bands hold all that bodies give */
    return softer == FW_VERDICT_AS_STIFF ? fmax(1, by * by / mode->held)
                                         : fw_verdict_soft_by(softer, mode->omega, is);
}

typedef struct rings { /* of several modes at once */
    const fw_quantity_law_pieces *pieces;
    const fw_verdict_shaken *shaken;
    const fw_verdict_shaken_mode *mode[FW_QUANTITY_OSCILLATORS];
    int n, rows;
    fw_verdict_softness softer;
    fw_verdict_damped damped;
    double *by, *less;
    fw_quantity_law_seen seen;
} rings;

static fw_status make_room(fw_arena *arena, int modes, rings *r) {
    const size_t rows = 3 * (size_t)r->rows, loads = (size_t)r->shaken->nload;
    FW_NEED(r->by = fw_arena_array(arena, double, rows *(size_t)modes));
    FW_NEED(r->less = fw_arena_array(arena, double, rows *loads));
    FW_NEED(r->seen.most = fw_arena_array(arena, double, FW_QUANTITY_LANES *rows));
    FW_NEED(r->seen.row = fw_arena_array(arena, fw_quantity_law_row, rows));
    return FW_OK;
}

static double part_of(bent b, int i) {
    return i == 0 ? b.turn : i == 1 ? b.x : b.y;
}

/* what a row sees of the modes, and has less of what is prescribed */
static void put_rows(rings *r) {
    const fw_verdict_shaken *s = r->shaken;
    r->seen.by = r->by, r->seen.less = s->ways > 0 ? r->less : NULL, r->seen.n = 3 * r->rows;
    for (int i = 0; i < r->seen.n; i++) {
        for (int k = 0; k < r->n; k++)
            r->by[i * r->n + k] = part_of(r->mode[k]->bends[i / 3], i % 3);
        for (int j = 0; j < s->ways; j++) {
            const int load = s->nload - s->ways + j;
            double less = -part_of(s->way[j * r->rows + i / 3], i % 3);
            for (int k = 0; k < r->n; k++)
                less += r->by[i * r->n + k] * r->mode[k]->size[load];
            r->less[i * s->nload + load] = less;
        }
    }
}

/* A (rows, lanes) with all frequencies times[] as high, each within its own error. Returns the steps, or -1 */
static double answers_at(rings *r, const double *times, double *answer) {
    enum { LANES = FW_QUANTITY_LANES };
    const fw_verdict_shaken *s = r->shaken;
    const fw_quantity_law_loads on = {s->load, s->nload, s->ways, r->pieces};
    fw_quantity_law_oscillator o[FW_QUANTITY_OSCILLATORS];
    for (int k = 0; k < r->n; k++) {
        const fw_verdict_shaken_mode *mode = r->mode[k];
        o[k] = (fw_quantity_law_oscillator){
            mode->damping[r->damped], mode->start, mode->size, {0}, {0}};
        for (int l = 0; l < LANES; l++) {
            const double at = fmin(fmax(times[l] * mode->omega, mode->low), mode->high);
            o[k].omega_per_s[l] = at;
            o[k].scale[l] = fw_verdict_soft_within(r->softer, mode, at);
        }
    }
    const double steps = fw_quantity_law_swings_of(&on, o, r->n, &r->seen);
    for (int i = 0; steps >= 0 && i < r->rows; i++) {
        const double *most = r->seen.most + (size_t)(3 * i * LANES);
        for (int l = 0; l < LANES; l++)
            answer[i * LANES + l] = most[l] + hypot(most[LANES + l], most[2 * LANES + l]);
    }
    return steps;
}

/* what takes too long to follow is as large as its laws allow */
static void as_allowed(const rings *r, double end_s, fw_verdict_answer *to) {
    const fw_verdict_shaken *s = r->shaken;
    double *bound = memset(r->seen.most, 0, (size_t)r->rows * sizeof *bound);
    for (int k = 0; k < r->n; k++) {
        const fw_verdict_shaken_mode *mode = r->mode[k];
        const double most = fw_quantity_law_bound_of(s->load, mode->size, s->nload, end_s) +
                            fabs(mode->start) / mode->low;
        for (int i = 0; i < r->rows; i++)
            if (fw_verdict_bends_most(mode->bends[i]) > 0)
                bound[i] += 2 * most * fw_verdict_bends_most(mode->bends[i]);
    }
    for (int i = 0; i < r->rows; i++)
        to[i] = (fw_verdict_answer){1 + bound[i], 0, 1 + bound[i]};
}

/* strained: what is stiffer goes less far and bears as much */
static void take_answer(const rings *r, double times, double now, double as_computed,
                        fw_verdict_answer *to) {
    const double strained = now / fmin(1, fw_verdict_soft_by(r->softer, 1, times));
    to->up = fmax(to->up, 1 + now - as_computed);
    to->down = fmin(to->down, 1 + now - as_computed);
    to->strained = fmax(to->strained, 1 + strained - as_computed);
}

/* does what damps most leave another swing than what damps least, by the end? */
static bool dies_sooner(const rings *r, double end_s) {
    const double same = 1e-3;
    double most = 0;
    for (int k = 0; k < r->n; k++) {
        const double *of = r->mode[k]->damping;
        most = fmax(most, (of[FW_VERDICT_MOST_DAMPED] - of[FW_VERDICT_LEAST_DAMPED]) *
                              r->mode[k]->omega * end_s);
    }
    return most > same;
}

/* to: more or less than as computed, 1 where it does as much */
static fw_status ring(fw_arena *arena, rings *r, double end_s, fw_verdict_answer *to) {
    enum { LANES = FW_QUANTITY_LANES };
    const double most_steps = 4e6, fewest = 40;
    double low = 1, high = 1, width = 0, times[LANES];
    double *now = fw_arena_array(arena, double, (1 + LANES) * (size_t)r->rows),
           *as_computed = now + LANES * r->rows;
    FW_NEED(now);
    for (int k = 0; k < r->n; k++) {
        const fw_verdict_shaken_mode *mode = r->mode[k];
        low = fmin(low, mode->low / mode->omega), high = fmax(high, mode->high / mode->omega);
        width = fmax(width, mode->high - mode->low);
    }
    put_rows(r);
    for (int l = 0; l < LANES; l++)
        times[l] = 1;
    double steps = answers_at(r, times, now);
    const double n = fmin(2 + ceil(width * end_s / 0.5), fmax(fewest, most_steps / fmax(steps, 1)));
    for (int i = 0; i < r->rows; i++)
        to[i] = (fw_verdict_answer){1, 1, 1}, as_computed[i] = now[i * LANES];
    for (int end = 0; end < 2 && (end == 0 || dies_sooner(r, end_s)); end++) {
        r->damped = end ? FW_VERDICT_MOST_DAMPED : FW_VERDICT_LEAST_DAMPED;
        for (double k = 0; steps >= 0 && k < n; k += LANES) {
            for (int l = 0; l < LANES; l++)
                times[l] = low + (high - low) * fmin((k + l) / (n - 1), 1);
            steps = answers_at(r, times, now);
            for (int i = 0; steps >= 0 && i < LANES * r->rows; i++)
                take_answer(r, times[i % LANES], now[i], as_computed[i / LANES], &to[i / LANES]);
        }
    }
    if (steps < 0) as_allowed(r, end_s, to);
    return FW_OK;
}

fw_status fw_verdict_rings_again(fw_arena *arena, const fw_quantity_law_pieces *pieces,
                                 double end_s, const fw_verdict_shaken *shaken, int mode, int rows,
                                 fw_verdict_softness softer, fw_verdict_answer *to) {
    rings r = {.pieces = pieces, .shaken = shaken, .rows = rows, .softer = softer};
    for (int i = 0; i < rows; i++)
        to[i] = (fw_verdict_answer){1, 1, 1};
    for (int k = 0; k < shaken->n; k++)
        if ((mode == FW_NONE || mode == k) && shaken->mode[k].size)
            r.mode[r.n++] = &shaken->mode[k];
    if (r.n < (mode == FW_NONE ? 2 : 1)) return FW_OK;
    FW_TRY(make_room(arena, r.n, &r));
    return ring(arena, &r, end_s, to);
}

/* ---- what rings on where a scene ends ----
   A device does not stop ringing there. Where its loads stay what they are at the end it swings about the equilibrium under
   them, and every mode k by

     a_k = hypot(p_k, p_k'/omega_k),   p_k = u_k . M (q - q_rest)/m_k,

   which falls by its logarithmic decrement 2 pi zeta/sqrt(1 - zeta^2) from one swing to the next. In: the last instant, modes
   about that equilibrium. Out: of every hinge what it rests at and what modes ring by, over the most that it was bent by in the
   scene. The swings of the mode that bends it most carry those of the others. Range: small motions about q_rest; shares may be
   more by theta^2/2 of the largest turn, or by what way and forces are apart (a tenth at most), but not than all of the peak.
   No equilibrium: all of it, by the least that damps any mode. Test: test_limits.py, test_what_rings_on_behind_... */

enum { MODES_AFTER = 8 }; /* of one hinge, those that bend it most */

static double decrement_of(double damping_ratio) {
    const double z = fmin(fmax(damping_ratio, 0), 0.99); /* NaN: nothing is known, 0 */
    return 2 * FW_PI * z / sqrt(1 - z * z);
}

/* How far a mode swings about where it rests, in units of its shape. A body that turns by theta about a far pin comes nearer
   to it by r theta^2/2, which strains nothing; taken for a swing of what is stiff along, it would be the largest of all. So
   way, speed and acceleration are turned back with the body (a way by half: so it is along the chord), and p is the smaller of
   the way and of what the forces of that instant hold, -(p'' + 2 zeta omega p')/omega^2. *more: by the larger, relative */
static double swing_at_end(const fw_mechanism *m, const fw_statics_modes *modes, int k,
                           const fw_dynamics_motion *x, double *more) {
    const fw_statics_mode *mode = &modes->mode[k];
    const size_t last = (size_t)(x->nsample - 1) * 3 * (size_t)m->nbody;
    const double w = mode->omega_rad_per_s, damping = fmax(mode->damping_ratio, 0);
    double at = 0, speed = 0, pulls = 0;
    for (int b = 0; b < m->nbody; b++) {
        const double *rest = modes->q + 3 * b, *q = x->q + last + 3 * b, turned = q[2] - rest[2];
        const double *of = mode->shape + 3 * b, way[3] = {q[0] - rest[0], q[1] - rest[1], turned};
        at += of_body(m, b, of, way, 0.5 * turned);
        speed += of_body(m, b, of, x->v + last + 3 * b, turned);
        pulls += of_body(m, b, of, x->accel + last + 3 * b, turned);
    }
    const double held = fabs(pulls / w + 2 * damping * speed) / w, way = fabs(at),
                 swing = hypot(fmin(way, held), speed / w);
    *more = swing > 0 ? hypot(fmax(way, held), speed / w) / swing - 1 : 0;
    return swing / mode->modal_mass_kg_m2;
}

static void keep_ring(fw_verdict_after *to, fw_verdict_ring ring) {
    int at = to->n < MODES_AFTER ? to->n++ : MODES_AFTER;
    for (; at > 0 && to->ring[at - 1].share < ring.share; at--)
        if (at < MODES_AFTER) to->ring[at] = to->ring[at - 1];
    if (at < MODES_AFTER) to->ring[at] = ring;
}

static void rings_of(const fw_mechanism *m, const fw_statics_modes *modes, int h, double most,
                     const double *q0, const double *swing, fw_verdict_after *to) {
    const double hardly = 1e-3, much = 0.1, *more = swing + modes->count;
    to->rest = fmin(bent_between(m, &m->hinge[h], q0, modes->q) / most, 1);
    for (int k = 0; k < modes->count; k++) {
        if (!(swing[k] > 0)) continue;
        const fw_statics_mode *by = &modes->mode[k];
        const bent bends = bent_by(m, &m->hinge[h], modes->q, by->shape);
        const double share = fw_verdict_bends_most(bends) * swing[k] / most;
        if (!(share > hardly)) continue;
        if (to->n == 0 || share > to->ring[0].share) to->more = fmin(fmax(to->more, more[k]), much);
        keep_ring(to, (fw_verdict_ring){fmin(share, 1), decrement_of(by->damping_ratio),
                                        by->omega_rad_per_s});
    }
}

fw_status fw_verdict_rings_on(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                              const fw_dynamics_motion *x, fw_verdict_after **after) {
    const size_t nh = (size_t)m->nhinge;
    const double hardly = 1e-3, much = 0.1;
    const fw_statics_modes *modes, *unloaded = NULL;
    double *most, *swing, least = (double)INFINITY, turned = 0;
    bool lives = false;
    *after = NULL;
    for (size_t h = 0; h < nh && m->device && m->device->limits.cycles > 0; h++)
        lives = lives || m->hinge[h].limits.life.known;
    if (!lives || !x || x->ended || x->nsample < 2 || (x->loads && x->loads->quasi_static))
        return FW_OK;
    FW_NEED(*after = fw_arena_array(arena, fw_verdict_after, nh));
    FW_NEED(most = fw_arena_array(arena, double, nh + (size_t)m->nbody));
    FW_TRY(fw_verdict_modes_about(arena, m, s, true, 0.03, &modes));
    if (!modes) FW_TRY(fw_verdict_modes_about(arena, m, s, false, 0.03, &unloaded));
    for (int k = 0; unloaded && k < unloaded->count; k++)
        if (unloaded->mode[k].omega_rad_per_s > 0)
            least = fmin(least, decrement_of(unloaded->mode[k].damping_ratio));
    for (size_t h = 0; !modes && h < nh; h++)
        keep_ring(&(*after)[h], (fw_verdict_ring){1, isfinite(least) ? least : 0, 1});
    if (!modes) return FW_OK;
    fw_dynamics_motion_rows(x, 0, x->nsample);
    see_most(m, x, modes->unit_length_m, most);
    FW_NEED(swing = fw_arena_array(arena, double, 2 * (size_t)modes->count));
    for (int k = 0; k < modes->count; k++)
        if (modes->mode[k].stiffness_per_s2 > 0 && modes->mode[k].shape)
            swing[k] = swing_at_end(m, modes, k, x, swing + modes->count + k);
    for (int k = 0; k < m->npin; k++)
        turned = fmax(turned, fabs(x->peak[k].angle_rad));
    const double bends = fw_verdict_most_of(most, m->nhinge);
    for (int h = 0; h < m->nhinge; h++) {
        (*after)[h].more = fmin(0.5 * turned * turned, much);
        if (most[h] > hardly * bends) rings_of(m, modes, h, most[h], x->q, swing, &(*after)[h]);
    }
    return FW_OK;
}

/* equilibria do not ring */
fw_status fw_verdict_rings_from(const void *v, const fw_probe_monitor *w, double *late_s) {
    const int scene = (int)(w->scene - w->mechanism->device->scene);
    double slowest_s = 0;
    if (!w->loads->quasi_static) FW_TRY(fw_verdict_slowest_s(w->arena, v, scene, &slowest_s));
    *late_s = fw_probe_rings_from(w->scene->duration_s, slowest_s);
    return FW_OK;
}
