/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The gas, and films of it that two walls squeeze: as dampers, and what dampers lack where the gas is compressed.
   Theory: docs/theory/effects/air.md. */
#include "base/constants.h"
#include "effects/effect.h"
#include "effects/envelope.h"
#include "quantity/law_kind.h"
#include <math.h>

/* ---- the gas ---- */

double fw_effects_air_viscosity(double temperature_K) {
    return 1.458e-6 * pow(temperature_K, 1.5) / (temperature_K + 110.4);
}

/* mean free path mu/p sqrt(pi R T/2), the one that Kn of the slip formulas is made of */
fw_effects_gas fw_effects_gas_of(const fw_device_air *air) {
    fw_effects_gas g = {.pressure_Pa =
                            isnan(air->pressure_Pa) ? FW_STANDARD_ATMOSPHERE_Pa : air->pressure_Pa,
                        .temperature_K = isnan(air->temperature_K) ? 293.15 : air->temperature_K};
    g.viscosity_Pas =
        isnan(air->viscosity_Pas) ? fw_effects_air_viscosity(g.temperature_K) : air->viscosity_Pas;
    g.density_kg_per_m3 = g.pressure_Pa / (FW_DRY_AIR_J_PER_kg_K * g.temperature_K);
    g.path_m =
        g.viscosity_Pas / g.pressure_Pa * sqrt(FW_PI * FW_DRY_AIR_J_PER_kg_K * g.temperature_K / 2);
    return g;
}

/* ---- films between walls ---- */

/* Squeeze film between two side walls that stand opposite each other, length a along the wafer and
   depth b across it: the air must leave through the edges. With the gap g of the walls' middles,

     g = n.(p_1 - p_0),   force along g:  -c(g) g',   c = 12 mu_eff I/g^3,
     I = a b^3/12 (1 - (192 b/(pi^5 a)) sum over odd k of tanh(k pi a/(2 b))/k^5),
     mu_eff = mu/(1 + 9.638 Kn^1.159),   Kn = mean free path/g,

   n the normal of the second wall, which turns with its body; the walls count as parallel. c is
   that of the incompressible Reynolds equation with ambient pressure at the edges: 0.4217 mu
   a^4/g^3 for a square. Source: Blech, J. Lubr. Technol. 105 (1983) 615 (small squeeze numbers);
   Veijola, Kuisma, Lahdenpera and Ryhanen, Sensors and Actuators A 48 (1995) 239 (rarefaction, Kn
   up to 880 within 5 %). Valid for film Reynolds numbers rho omega g^2/mu below 1, and g small
   against both sides; what it lacks where the air is compressed before it flows is below. Test:
   test_air.c (I against a solution by differences). */

static const double slip = 9.638, slip_power = 1.159;

/* the series converges like exp only in its first term; 40 terms leave 1e-9 of what it subtracts.
   tanh(x)/k^5 -> 1/k^5, whose tail behind K is below 1/(8 K^4) */
double fw_effects_rectangle_integral(double a_m, double b_m) {
    double a = fmax(a_m, b_m), b = fmin(a_m, b_m), sum = 0;
    for (int k = 79; k > 0; k -= 2)
        sum += tanh(k * FW_PI * a / (2 * b)) / ((double)k * k * k * k * k);
    return a * b * b * b / 12 * (1 - 192 * b / (FW_PI * FW_PI * FW_PI * FW_PI * FW_PI * a) * sum);
}

fw_effects_squeeze fw_effects_air_squeeze(const fw_effects_gas *gas, double length_m,
                                          double depth_m, double gap_m) {
    return (fw_effects_squeeze){.c0_Nsm2 = 12 * gas->viscosity_Pas *
                                           fw_effects_rectangle_integral(length_m, depth_m),
                                .path_m = gas->path_m,
                                .least_m = 1e-6 * gap_m};
}

double fw_effects_squeeze_at(const fw_effects_squeeze *film, double gap_m, double *slope) {
    double g = fmax(gap_m, film->least_m), rare = slip * pow(film->path_m / g, slip_power);
    double c = film->c0_Nsm2 / (g * g * g * (1 + rare));
    if (slope) *slope = gap_m < g ? 0 : c / g * (slip_power * rare / (1 + rare) - 3);
    return c;
}

double fw_effects_air_depth(const fw_mechanism *m, const fw_device_air *air) {
    if (!isnan(air->depth_m)) return air->depth_m;
    return m->variant ? m->variant->thickness_m : (double)NAN;
}

typedef struct opening { /* gap, its rate, its gradient (6) by the ports and that of its rate */
    double gap, rate, by[6], rate_by[6], n[2], t[2];
} opening;

/* d = p1 - p0, n(phi1), t = dn/dphi1: the gradient is (-n, 0, n, t.d); second derivatives -t and t
   of (p0, phi1), (p1, phi1), and -n.d of (phi1, phi1) */
static opening opening_at(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const fw_effects_squeeze *film = e->data;
    const double *p = s->p, *w = s->w;
    double angle = p[5] + film->angle_rad, dx = p[3] - p[0], dy = p[4] - p[1];
    opening o = {.n = {cos(angle), sin(angle)}};
    o.t[0] = -o.n[1], o.t[1] = o.n[0];
    o.gap = o.n[0] * dx + o.n[1] * dy;
    o.by[0] = -o.n[0], o.by[1] = -o.n[1];
    o.by[3] = o.n[0], o.by[4] = o.n[1];
    o.by[5] = o.t[0] * dx + o.t[1] * dy;
    for (int i = 0; i < 6; i++)
        o.rate += o.by[i] * w[i];
    for (int k = 0; k < 2; k++) {
        o.rate_by[k] = -o.t[k] * w[5];
        o.rate_by[3 + k] = o.t[k] * w[5];
        o.rate_by[5] += o.t[k] * (w[3 + k] - w[k]);
    }
    o.rate_by[5] -= o.gap * w[5];
    return o;
}

static void squeeze_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          double *f) {
    opening o = opening_at(e, s);
    double modal_load = -fw_effects_squeeze_at(e->data, o.gap, NULL) * o.rate;
    for (int i = 0; i < 6; i++)
        f[i] = modal_load * o.by[i];
}

static void squeeze_tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                            double *stiffness, double *damping) {
    opening o = opening_at(e, s);
    double slope, c = fw_effects_squeeze_at(e->data, o.gap, &slope), modal_load = -c * o.rate;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            damping[6 * i + j] = c * o.by[i] * o.by[j];
            stiffness[6 * i + j] = o.by[i] * (slope * o.rate * o.by[j] + c * o.rate_by[j]);
        }
    for (int k = 0; k < 2; k++) {
        stiffness[6 * k + 5] += modal_load * o.t[k];
        stiffness[6 * 5 + k] += modal_load * o.t[k];
        stiffness[6 * (3 + k) + 5] -= modal_load * o.t[k];
        stiffness[6 * 5 + 3 + k] -= modal_load * o.t[k];
    }
    stiffness[6 * 5 + 5] += modal_load * o.gap;
}

static void squeeze_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          double out[2]) {
    opening o = opening_at(e, s);
    out[0] = fw_effects_squeeze_at(e->data, o.gap, NULL) * o.rate * o.rate;
    out[1] = 0;
}

static bool squeeze_valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          const char **why) {
    if (opening_at(e, s).gap > ((const fw_effects_squeeze *)e->data)->least_m) return true;
    *why = "the walls of its squeeze film touch, and a film of no thickness has no formula: widen "
           "the gap, or state a <contact> that holds the walls apart";
    return false;
}

static const fw_effects_element_class squeeze_class = {.effect = "air",
                                                       .force = squeeze_force,
                                                       .tangent = squeeze_tangent,
                                                       .power = squeeze_power,
                                                       .valid = squeeze_valid};

static double turn_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0 : m->body[body].phi_rad;
}

fw_status fw_effects_squeeze_add(const fw_effect_case *c, fw_effects_loads *loads,
                                 const fw_device_air *air) {
    const fw_mechanism *m = c->mechanism;
    fw_effects_squeeze *data = fw_arena_one(c->arena, fw_effects_squeeze);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &squeeze_class, 2);
    FW_NEED(data && e);
    const fw_effects_gas gas = fw_effects_gas_of(air);
    *data = fw_effects_air_squeeze(&gas, air->length_m, fw_effects_air_depth(m, air), air->gap_m);
    double out = air->direction_rad + turn_of(m, air->body), frame = turn_of(m, air->against);
    data->angle_rad = out - frame;
    fw_geometry_vec2 wall = fw_mechanism_local_place(m, air->body, air->x_m, air->y_m);
    fw_geometry_vec2 other = {wall.x + air->gap_m * cos(out), wall.y + air->gap_m * sin(out)};
    if (air->against != FW_GROUND) { /* into its frame */
        const fw_mechanism_mass *b = &m->body[air->against];
        double dx = other.x - b->x_m, dy = other.y - b->y_m;
        other = (fw_geometry_vec2){cos(frame) * dx + sin(frame) * dy,
                                   -sin(frame) * dx + cos(frame) * dy};
    }
    e->id = air->body == FW_GROUND ? "ground" : m->body[air->body].id;
    e->place = air->place;
    e->port[0] = (fw_effects_port){air->body, air->x_m, air->y_m};
    e->port[1] = (fw_effects_port){air->against, other.x, other.y};
    e->dissipates = true;
    e->data = data;
    return FW_OK;
}

/* ---- bound: the largest speeds that the envelope allows ---- */

static void add_to(double *force, int body, double arm_m, double most_N) {
    if (body == FW_GROUND) return;
    force[3 * body] += most_N, force[3 * body + 1] += most_N;
    force[3 * body + 2] += arm_m * most_N;
}

/* false: the walls may come so close that nothing can be said */
/* m: the least gap that the reach of both bodies leaves; false: less than a hundredth of it is left for sure. lever: of both
   walls about their bodies, and of the middles about the turning normal */
static bool least_gap(const fw_effect_case *c, const fw_device_air *a, double *least,
                      double lever[3]) {
    const fw_effects_envelope *e = c->envelope;
    lever[0] = hypot(a->x_m, a->y_m), lever[1] = 0;
    if (a->against != FW_GROUND) {
        fw_geometry_vec2 wall = fw_mechanism_local_place(c->mechanism, a->body, a->x_m, a->y_m);
        const fw_mechanism_mass *b = &c->mechanism->body[a->against];
        lever[1] = hypot(wall.x - b->x_m, wall.y - b->y_m) + a->gap_m;
    }
    const double moved = fw_effects_envelope_point(e->reach, a->body, lever[0]) +
                         fw_effects_envelope_point(e->reach, a->against, lever[1]);
    const double turned = a->against == FW_GROUND ? 0 : e->reach[3 * a->against + 2];
    lever[2] = a->gap_m + moved;
    *least = a->gap_m - moved - turned * lever[2];
    return *least > 0.01 * a->gap_m;
}

/* force (3 nbody) += what a film pushes with at most; false: the walls may come so close that nothing can be said */
bool fw_effects_squeeze_push(const fw_effect_case *c, const fw_device_air *a, double *force) {
    const fw_effects_envelope *e = c->envelope;
    const fw_effects_gas gas = fw_effects_gas_of(a);
    const fw_effects_squeeze film =
        fw_effects_air_squeeze(&gas, a->length_m, fw_effects_air_depth(c->mechanism, a), a->gap_m);
    double least, lever[3];
    if (!least_gap(c, a, &least, lever)) return false;
    double spin = a->against == FW_GROUND ? 0 : e->speed[3 * a->against + 2];
    double rate = fw_effects_envelope_point(e->speed, a->body, lever[0]) +
                  fw_effects_envelope_point(e->speed, a->against, lever[1]);
    double most = fw_effects_squeeze_at(&film, least, NULL) * (rate + spin * lever[2]);
    add_to(force, a->body, lever[0], most);
    add_to(force, a->against, lever[1] + lever[2], most);
    return true;
}

/* ---- what a damper lacks: the gas is compressed before it flows ---- */

/* Linearised Reynolds equation of a gas between rigid parallel walls a x b, at constant temperature and ambient pressure
   at the edges: each term of its double sine series is a spring and a damper in series,

     K(i w) = sum over odd m, n of k i w t/(1 + i w t),   k = p a b/g 64/(pi^4 m^2 n^2),
     t = 12 mu_eff/(p g^2 ((m pi/a)^2 + (n pi/b)^2)),   sum of k t = c,

   and the damper alone is short of it by D = K - i w c = sum of k w^2 t^2/(1 + i w t). In: SI; out: K, N/m, and |D|. Terms up
   to m, n = 31: K within 3 %, and Im K, by which D is divided, too small. Source: W. E. Langlois, Quart. Appl. Math. 20
   (1962) 131; Blech, as above. Test: test_air.c compressed_film (differences in time), test_film_springs.py */
enum { TERMS_MOST = 31 };
static const double fw_terms_miss = 1.04; /* the spring is at most so many times what these have */

double fw_effects_squeeze_lacks_N_per_m(const fw_effects_gas *gas, double length_m, double depth_m,
                                        double gap_m, double omega_per_s, double stiffness[2]) {
    const double rare = slip * pow(gas->path_m / gap_m, slip_power), w = omega_per_s,
                 flows = 12 * gas->viscosity_Pas / (1 + rare) / (gas->pressure_Pa * gap_m * gap_m),
                 all = gas->pressure_Pa * length_m * depth_m / gap_m * 64 /
                       (FW_PI * FW_PI * FW_PI * FW_PI);
    double lacks[2] = {0, 0};
    stiffness[0] = stiffness[1] = 0;
    for (int m = 1; m <= TERMS_MOST; m += 2)
        for (int n = 1; n <= TERMS_MOST; n += 2) {
            const double x = m * FW_PI / length_m, y = n * FW_PI / depth_m,
                         wt = w * flows / (x * x + y * y), k = all / ((double)m * m * n * n),
                         part = k * wt / (1 + wt * wt);
            stiffness[0] += part * wt, stiffness[1] += part;
            lacks[0] += part * wt, lacks[1] += part * wt * wt;
        }
    return hypot(lacks[0], lacks[1]);
}

/* One film of a scene, and what of it counts in the share below */
typedef struct film {
    const fw_device_air *of;
    fw_effects_gas gas;
    double depth_m, gap_m; /* the least gap that the envelope leaves, where it leaves half of it */
    double *opens;         /* (modes) by how much a mode of size 1 opens it */
} film;

/* Whatever else holds the wall, what moves the film at w meets at least i w c with the damper and Im K with the film; so the film's
   gap goes at most 1 + |D|/Im K times as far as with the damper, and no less than 1/(1 + |D|/(w c)) times as far */
static double share_at(const film *f, double omega_per_s) {
    double k[2];
    const double lacks = fw_effects_squeeze_lacks_N_per_m(&f->gas, f->of->length_m, f->depth_m,
                                                          f->gap_m, omega_per_s, k);
    return k[1] > 0 ? lacks / k[1] : 0;
}

static double opens_by(const fw_mechanism *m, int body, fw_geometry_vec2 at, fw_geometry_vec2 n,
                       const double *shape) {
    if (body == FW_GROUND) return 0;
    const double x = at.x - m->body[body].x_m, y = at.y - m->body[body].y_m;
    const double *u = shape + 3 * body;
    return n.x * (u[0] - y * u[2]) + n.y * (u[1] + x * u[2]);
}

static fw_status film_of(const fw_effect_case *c, const fw_device_air *a, film *to) {
    const fw_mechanism *m = c->mechanism;
    const fw_effects_envelope *e = c->envelope;
    const double angle = a->direction_rad + turn_of(m, a->body);
    const fw_geometry_vec2 n = {cos(angle), sin(angle)},
                           wall = fw_mechanism_local_place(m, a->body, a->x_m, a->y_m),
                           other = {wall.x + a->gap_m * n.x, wall.y + a->gap_m * n.y};
    *to = (film){.of = a,
                 .gas = fw_effects_gas_of(a),
                 .depth_m = fw_effects_air_depth(m, a),
                 .gap_m = a->gap_m};
    FW_NEED(to->opens = fw_arena_array(c->arena, double, (size_t)e->modes));
    for (int j = 0; j < e->modes; j++) {
        const double *shape = e->shape + (size_t)j * (size_t)e->n;
        to->opens[j] =
            opens_by(m, a->against, other, n, shape) - opens_by(m, a->body, wall, n, shape);
    }
    if (!e->valid) return FW_OK;
    double least, lever[3];
    if (least_gap(c, a, &least, lever) && least > 0.5 * a->gap_m) to->gap_m = least;
    return FW_OK;
}

/* The share of a mode in how far the film opens, in turns of pins and in ways of bodies, each over the largest of all modes
   together: the largest of the three */
static double largest_part(const double *shape, int count, int step, int modes, int j,
                           const double *size) {
    double most = 0, all = 0;
    for (int i = 0; i < count; i++) {
        double sum = 0;
        if (step == 3 && i % 3 == 2) continue;
        for (int l = 0; l < modes; l++)
            sum += fabs(shape[(size_t)l * (size_t)count + (size_t)i]) * size[l];
        all = fmax(all, sum);
        most = fmax(most, fabs(shape[(size_t)j * (size_t)count + (size_t)i]) * size[j]);
    }
    return all > 0 ? most / all : 0;
}

static double part_of_mode(const fw_effects_envelope *e, const film *f, int j) {
    double all = 0;
    for (int l = 0; l < e->modes; l++)
        all += fabs(f->opens[l]) * e->amplitude[l];
    const double own = all > 0 ? fabs(f->opens[j]) * e->amplitude[j] / all : 0,
                 most = fmax(own, fmax(largest_part(e->turn, e->npin, 1, e->modes, j, e->amplitude),
                                       largest_part(e->shape, e->n, 3, e->modes, j, e->amplitude)));
    return isfinite(most) ? most : 1;
}

/* At most where a mode lies with the springs of all films: from above, so that whatever step ends it is above */
static double stiffened(const film *films, int count, double omega_per_s, int j) {
    double k[2], w2 = omega_per_s * omega_per_s, at2 = HUGE_VAL;
    for (int step = 0; step < 6; step++) {
        double more = 0;
        for (int i = 0; i < count; i++) {
            const film *f = &films[i];
            if (isinf(at2))
                k[0] = f->gas.pressure_Pa * f->of->length_m * f->depth_m / f->gap_m;
            else
                fw_effects_squeeze_lacks_N_per_m(&f->gas, f->of->length_m, f->depth_m, f->gap_m,
                                                 sqrt(at2), k);
            more += f->opens[j] * f->opens[j] * k[0] * (isinf(at2) ? 1 : fw_terms_miss);
        }
        at2 = w2 + more;
        if (!(more > 1e-4 * w2)) break;
    }
    return sqrt(at2);
}

typedef struct shaker { /* a law that acts in the scene, as films see it */
    const fw_quantity_law *law;
    bool coordinate, squared;
} shaker;

enum { SHAKERS_MOST = 64 };

static int shakers_of(const fw_effect_case *c, shaker *to) {
    const fw_device_scene *s = c->scene;
    int n = 0;
#define TAKE(count, of, coordinate, squared)                                                       \
    for (int i = 0; i < (count) && n < SHAKERS_MOST; i++)                                          \
    to[n++] = (shaker){(of)[i].law, coordinate, squared}
    TAKE(s->nforce, s->force, false, false);
    TAKE(s->ntorque, s->torque, false, false);
    TAKE(s->ntendon, s->tendon, false, false);
    TAKE(s->nbase, s->base, false, false);
    TAKE(s->npart, s->part, false, true);
    TAKE(s->ntemperature, s->temperature, true, false);
    TAKE(s->ncomb, s->comb, false, true);
#undef TAKE
    for (int i = 0; i < c->mechanism->ndriver && n < SHAKERS_MOST; i++)
        to[n++] = (shaker){&c->mechanism->driver[i].law, true, false};
    if ((s->ninitial > 0 || s->gravity || s->gx_m_per_s2 != 0 || s->gy_m_per_s2 != 0 ||
         s->ncontact > 0 || s->nfriction > 0 || s->nstress > 0) &&
        n < SHAKERS_MOST)
        to[n++] = (shaker){NULL, false, false}; /* comes at once, or with blows */
    if (n == SHAKERS_MOST) to[0] = (shaker){NULL, false, false};
    return n;
}

/* rad/s: of the fastest sine that a law is made of over and over; 0: of none */
static double sines_of(const shaker *s) {
    if (fw_quantity_law_is_constant(s->law)) return 0;
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(s->law);
    return wave.repeats ? 2 * FW_PI * wave.fastest_Hz * (s->squared ? 2 : 1) : 0;
}

/* What a law sets ringing at w, over what it does at rest: of sines, by where they begin and by their rate there */
static double rings_at(const shaker *s, double end_s, double omega_per_s) {
    const double sines = sines_of(s);
    double first[3];
    if (!(sines > 0)) return fw_quantity_law_jolt(s->law, s->coordinate, end_s, omega_per_s);
    fw_quantity_law_value(s->law, 0, 0, first);
    const double most = fw_quantity_law_largest(s->law, end_s);
    return fmin(1, (most > 0 ? fabs(first[0]) / most : 0) + 2 * sines / omega_per_s);
}

typedef struct lacking { /* share by which values may differ, and where most of it is from */
    double share, omega_per_s, of_that;
    const char *where;
} lacking;

static void add_share(lacking *to, double share, double omega_per_s, const char *where) {
    to->share += share;
    if (share > to->of_that) to->of_that = share, to->omega_per_s = omega_per_s, to->where = where;
}

/* what rings in modes that are known: no more than what rings can differ by, twice what its frequency's share is, and
   what a little spring can do within the scene */
static void add_modes(const fw_effect_case *c, const film *films, int count, const film *f,
                      const shaker *s, int shakers, lacking *to) {
    const fw_effects_envelope *e = c->envelope;
    const double end = c->scene->duration_s;
    for (int j = 0; j < e->modes; j++) {
        const double part = part_of_mode(e, f, j);
        double rings = 0, k[2];
        bool on = false;
        if (!(part > 1e-6)) continue;
        const double w = stiffened(films, count, e->omega[j], j), twice = 2 * share_at(f, w);
        for (int i = 0; i < shakers; i++) {
            rings = fmax(rings, rings_at(&s[i], end, e->omega[j]));
            on = on || (!(sines_of(&s[i]) > 0) && fw_quantity_law_goes_to_and_fro(s[i].law, end));
        }
        const double lacks = fw_effects_squeeze_lacks_N_per_m(&f->gas, f->of->length_m, f->depth_m,
                                                              f->gap_m, w, k),
                     apart = lacks * f->opens[j] * f->opens[j] * end / e->omega[j];
        const double differs = on ? twice : rings * fmin(1, twice);
        add_share(to, part * fmin(differs, on ? HUGE_VAL : apart), w, "where a mode rings");
    }
}

/* modes are not known: those below a frequency differ by twice its share, those above ring by what laws set ringing there */
static void add_unknown(const fw_effect_case *c, const film *f, const shaker *s, int shakers,
                        lacking *to) {
    const double end = c->scene->duration_s;
    double least = 1, at = 0;
    for (double w = 2 * FW_PI; w < 1e9; w *= 2) {
        double rings = 0;
        for (int i = 0; i < shakers; i++)
            rings = fmax(rings, rings_at(&s[i], end, w));
        const double now = rings + 2 * share_at(f, w);
        if (now < least || at == 0) least = fmin(1, now), at = w;
    }
    add_share(to, least, at, "where modes, which are not known, may ring");
}

static lacking lacking_of(const fw_effect_case *c, const film *films, int count, const film *f,
                          const shaker *s, int shakers) {
    lacking of = {.where = ""}, steady = of;
    for (int i = 0; i < shakers; i++) {
        const double w = sines_of(&s[i]), share = w > 0 ? 2 * share_at(f, w) : 0;
        if (share > steady.share)
            steady = (lacking){.share = share, .omega_per_s = w, .where = "of a law"};
    }
    if (steady.share > 0) add_share(&of, steady.share, steady.omega_per_s, steady.where);
    if (c->envelope->modes > 0)
        add_modes(c, films, count, f, s, shakers, &of);
    else
        add_unknown(c, f, s, shakers, &of);
    return of;
}

static const char *say(fw_arena *arena, const fw_effect_case *c, const film *f, const lacking *of) {
    char number[32], at[32], gap[32], spring[32];
    double k[2];
    const double w = of->omega_per_s, rare = slip * pow(f->gas.path_m / f->gap_m, slip_power),
                 across = fmin(f->of->length_m, f->depth_m);
    fw_effects_squeeze_lacks_N_per_m(&f->gas, f->of->length_m, f->depth_m, f->gap_m, w, k);
    const double squeeze = 12 * f->gas.viscosity_Pas / (1 + rare) * w * across * across /
                           (f->gas.pressure_Pa * f->gap_m * f->gap_m);
    const char *id = f->of->body == FW_GROUND ? "ground" : c->mechanism->body[f->of->body].id;
    return fw_arena_printf(
        arena,
        "the squeezed film on %s%s, of gap %s um, has the squeeze number %s at %s kHz, %s: its gas "
        "is "
        "compressed before it flows away, and pushes back as a spring of %s N/m would, which no "
        "motion has",
        FW_NAMED("body", id), fw_number_text(gap, sizeof gap, 1e6 * f->gap_m, 3),
        fw_number_text(number, sizeof number, squeeze, 2),
        fw_number_text(at, sizeof at, 1e-3 * w / (2 * FW_PI), 3), of->where,
        fw_number_text(spring, sizeof spring, k[0], 3));
}

static fw_status films_of(const fw_effect_case *c, film **films, int *count) {
    const fw_device_scene *s = c->scene;
    *count = 0;
    FW_NEED(*films = fw_arena_array(c->arena, film, (size_t)s->nair));
    for (int i = 0; i < s->nair; i++)
        if (s->air[i].kind == FW_AIR_SQUEEZE && fw_effects_air_depth(c->mechanism, &s->air[i]) > 0)
            FW_TRY(film_of(c, &s->air[i], &(*films)[(*count)++]));
    return FW_OK;
}

/* Of all films the one that lacks most. Out: the share of what is seen by which the truth may be beyond it or short of it */
fw_status fw_effects_squeeze_lacking(const fw_effect_case *c, double *share, const char **words) {
    film *films;
    shaker shakers[SHAKERS_MOST];
    const int acting = shakers_of(c, shakers);
    int count;
    *share = 0, *words = NULL;
    FW_TRY(films_of(c, &films, &count));
    for (int i = 0; i < count; i++) {
        const lacking of = lacking_of(c, films, count, &films[i], shakers, acting);
        if (!(of.share > *share)) continue;
        *share = of.share;
        FW_NEED(*words = say(c->arena, c, &films[i], &of));
    }
    return FW_OK;
}

/* A mode of this shape (3 nbody) and modal mass, with the springs of all films of a scene: one of the damped system is no higher */
fw_status fw_effects_squeeze_raised(fw_arena *arena, const fw_mechanism *m,
                                    const fw_device_scene *scene, const double *shape, double mass,
                                    double omega_per_s, double *raised_per_s) {
    const int n = 3 * m->nbody;
    const fw_effects_envelope e = {
        .n = n, .modes = 1, .shape = fw_arena_array(arena, double, (size_t)n)};
    const fw_effect_case c = {.arena = arena, .mechanism = m, .scene = scene, .envelope = &e};
    film *films;
    int count;
    FW_NEED(e.shape);
    *raised_per_s = omega_per_s;
    for (int i = 0; i < n; i++)
        e.shape[i] = mass > 0 ? shape[i] / sqrt(mass) : 0;
    FW_TRY(films_of(&c, &films, &count));
    if (count > 0) *raised_per_s = stiffened(films, count, omega_per_s, 0);
    return FW_OK;
}
