/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plates on flexures: masses and stiffnesses out of the plane, what they answer to loads, their modes, and the loads
   in the plane that tip them out of it. */
#include "mechanism/mechanism_plates.h"
#include "base/constants.h"
#include "base/sort.h"
#include "flexure/path.h"
#include "geometry/segment.h"
#include "maths/matrix.h"
#include <string.h>

/* ---- what is known ---- */

static bool is_drawn(const fw_mechanism *m, int body) {
    return m->shape && m->shape[body].area_m2 > 0;
}

/* NULL: every joint is a flexure whose direction is known, every body is drawn. *stiff: all but the drawing of bodies is
   there, so that stiffnesses are known and masses are not */
static fw_status missing(fw_arena *arena, const fw_mechanism *m, const char **why, bool *stiff) {
    *why = NULL;
    if (m->nbody > FW_MECHANISM_PLATES_MOST)
        *why = "there are more than 100 bodies";
    else if (m->nhinge == 0)
        *why = "no joint is a flexure";
    *stiff = !*why && m->njoint == 0;
    for (int i = 0; i < m->nbody && !*why; i++)
        if (!is_drawn(m, i))
            FW_NEED(*why = fw_arena_printf(arena, "nothing is drawn of %s%s",
                                           FW_NAMED("body", fw_text_name(m->body[i].id))));
    for (int j = 0; j < m->npin; j++) {
        const fw_mechanism_pin *pin = &m->pin[j];
        bool known = pin->hinge != FW_NONE && isfinite(m->hinge[pin->hinge].axis_rad);
        *stiff = *stiff && known;
        if (!known && !*why)
            FW_NEED(*why = fw_arena_printf(arena, "%s%s is no flexure that is drawn",
                                           FW_NAMED("joint", fw_text_name(pin->id))));
    }
    if (!*why && m->njoint > 0)
        FW_NEED(*why = fw_arena_printf(arena, "%s%s is no flexure",
                                       FW_NAMED("joint", fw_text_name(m->joint[0].id))));
    return FW_OK;
}

/* ---- masses ---- */

/* Of a plate of even thickness about its centre of mass: m; rho h int y^2 dA + m h^2/12 about x, and so on. A stated
   mass, or one that is not at the centroid, has the drawing's shape: its in-plane inertia says how large. A body of which
   nothing is drawn is as wide one way as the other, for coordinates in which stiffnesses are of one size. */
static void put_mass(const fw_mechanism *m, int body, double *to) {
    const fw_mechanism_mass *b = &m->body[body];
    const fw_mechanism_shape even = {.polar_m4 = 1},
                             *s = is_drawn(m, body) ? &m->shape[body] : &even;
    double h = m->variant->thickness_m, own = b->mass_kg * h * h / 12;
    double share = b->inertia_kg_m2 / s->polar_m4;
    double xx = 0.5 * share * (s->polar_m4 + s->spread_m4.x),
           yy = 0.5 * share * (s->polar_m4 - s->spread_m4.x), xy = 0.5 * share * s->spread_m4.y;
    memset(to, 0, 9 * sizeof *to);
    to[0] = b->mass_kg;
    to[4] = yy + own, to[8] = xx + own;
    to[5] = to[7] = -xy;
}

/* ---- stiffnesses ---- */

/* C' = R C R', R a turn of the two rotations by the angle of the flexure's axis */
static void turn(double angle_rad, const double c[3][3], double by, double out[3][3]) {
    double e = cos(angle_rad), s = sin(angle_rad);
    const double r[3][3] = {{1, 0, 0}, {0, e, -s}, {0, s, e}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    sum += r[i][k] * c[k][l] * r[j][l];
            out[i][j] = by * sum;
        }
}

static bool invert(const double c[3][3], double k[3][3]) {
    double a[3][3], det, size[3];
    for (int i = 0; i < 3; i++) {
        size[i] = 1 / sqrt(c[i][i]); /* of one size, whatever the units */
        for (int j = 0; j < 3; j++)
            k[i][j] = i == j;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            a[i][j] = c[i][j] * size[i] * size[j];
    if (!fw_maths_solve3((const double(*)[3])a, 3, k, &det)) return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            k[i][j] *= size[i] * size[j];
    return true;
}

static fw_status put_hinge(fw_arena *arena, const fw_mechanism *m, int k, const double *give,
                           fw_mechanism_plate_hinge *to, bool *fine) {
    const fw_mechanism_hinge *h = &m->hinge[k];
    fw_flexure_out_of_plane own;
    FW_TRY(fw_flexure_out_of_plane_of(arena, &h->input, &h->closed_form, &own));
    to->pin = fw_mechanism_pin_place(m, &m->pin[h->pin], 0);
    turn(h->axis_rad, (const double(*)[3])own.c, 1 / h->scale, to->c);
    for (int i = 0; give && i < 9; i++)
        to->c[i / 3][i % 3] += give[i];
    *fine = invert((const double(*)[3])to->c, to->k);
    to->length_m = own.length_m, to->error = own.error;
    to->bend_Nm2 = h->scale * own.bend_Nm2, to->twist_Nm2 = h->scale * own.twist_Nm2;
    return FW_OK;
}

/* from a body's coordinates to the place of a pin, rigid: z + turn_x y - turn_y x */
static void lever(const fw_mechanism *m, int body, fw_geometry_vec2 at, double b[3][3]) {
    double x = at.x - m->drawn[body].x_m, y = at.y - m->drawn[body].y_m;
    const double to[3][3] = {{1, y, -x}, {0, 1, 0}, {0, 0, 1}};
    memcpy(b, to, sizeof to);
}

static void spread_hinge(const fw_mechanism *m, const fw_mechanism_pin *pin,
                         const fw_mechanism_plate_hinge *h, int n, double *stiffness) {
    const int body[2] = {pin->body_a, pin->body_b};
    double b[2][3][3] = {0};
    for (int s = 0; s < 2; s++)
        if (body[s] != FW_GROUND) lever(m, body[s], h->pin, b[s]);
    for (int s = 0; s < 2; s++)
        for (int t = 0; t < 2; t++) {
            if (body[s] == FW_GROUND || body[t] == FW_GROUND) continue;
            for (int i = 0; i < 9; i++) {
                double sum = 0;
                for (int k = 0; k < 9; k++)
                    sum += b[s][k / 3][i / 3] * h->k[k / 3][k % 3] * b[t][k % 3][i % 3];
                size_t at =
                    (size_t)(3 * body[s] + i / 3) * (size_t)n + (size_t)(3 * body[t] + i % 3);
                stiffness[at] += s == t ? sum : -sum;
            }
        }
}

/* ---- modes ---- */

/* lower triangle l of M = l l', 3 x 3 */
static void root_of(const double *mass, double l[3][3]) {
    memset(l, 0, 9 * sizeof(double));
    l[0][0] = sqrt(mass[0]);
    l[1][1] = sqrt(mass[4]);
    l[2][1] = mass[7] / l[1][1];
    l[2][2] = sqrt(mass[8] - l[2][1] * l[2][1]);
}

/* l^-1 v, or l'^-1 v, of every body */
static void divide(const fw_mechanism_plates *p, bool transposed, double *v) {
    for (int b = 0; b < p->n / 3; b++, v += 3) {
        double l[3][3];
        root_of(p->mass + 9 * b, l);
        v[0] /= l[0][0];
        if (transposed) {
            v[2] /= l[2][2];
            v[1] = (v[1] - l[2][1] * v[2]) / l[1][1];
        } else {
            v[1] /= l[1][1];
            v[2] = (v[2] - l[2][1] * v[1]) / l[2][2];
        }
    }
}

/* K x = omega^2 M x by l^-1 K l'^-1, M = l l' body by body, and LAPACK's dsyev. Cost 10 n^3 */
static fw_status find_modes(fw_arena *arena, fw_mechanism_plates *p) {
    size_t n = (size_t)p->n;
    double *a, *column;
    fw_maths_lapack_space space;
    FW_NEED(p->per_s2 = fw_arena_array(arena, double, n));
    FW_NEED(p->shape = a = fw_arena_array(arena, double, n *n));
    FW_NEED(column = fw_arena_array(arena, double, n));
    memcpy(a, p->stiffness, n * n * sizeof *a);
    for (size_t i = 0; i < n; i++)
        divide(p, false, a + i * n);
    for (size_t j = 0; j < n; j++) { /* of columns, which are rows of a symmetric matrix */
        for (size_t i = 0; i < n; i++)
            column[i] = a[i * n + j];
        divide(p, false, column);
        for (size_t i = 0; i < n; i++)
            a[i * n + j] = column[i];
    }
    FW_TRY(fw_maths_eigen_space(arena, p->n, &space));
    if (!fw_maths_eigen(p->n, a, p->per_s2, &space)) return FW_SOLVER;
    FW_NEED(p->f_Hz = fw_arena_array(arena, double, n));
    for (size_t k = 0; k < n; k++) {
        divide(p, true, a + k * n);
        p->f_Hz[k] = sqrt(fmax(p->per_s2[k], 0)) / (2 * FW_PI);
    }
    return FW_OK;
}

fw_status fw_mechanism_plates_new(fw_arena *arena, const fw_mechanism *m, const double *give,
                                  fw_mechanism_plates *p) {
    bool fine = true, stiff;
    *p = (fw_mechanism_plates){.mechanism = m};
    FW_TRY(missing(arena, m, &p->why, &stiff));
    if (!stiff) return FW_OK;
    size_t n = 3 * (size_t)m->nbody;
    FW_NEED(p->mass = fw_arena_array(arena, double, 3 * n));
    FW_NEED(p->stiffness = fw_arena_array(arena, double, n *n));
    FW_NEED(p->hinge = fw_arena_array(arena, fw_mechanism_plate_hinge, (size_t)m->nhinge));
    p->n = (int)n;
    for (int b = 0; b < m->nbody; b++)
        put_mass(m, b, p->mass + 9 * b);
    for (int k = 0; k < m->nhinge && fine; k++) {
        fw_mechanism_plate_hinge *h = &p->hinge[k];
        FW_TRY(put_hinge(arena, m, k, give ? give + 9 * k : NULL, h, &fine));
        if (fine) spread_hinge(m, &m->pin[m->hinge[k].pin], h, p->n, p->stiffness);
        p->error = fmax(p->error, h->error);
    }
    fw_status status = fine ? find_modes(arena, p) : FW_SOLVER;
    if (status == FW_NOMEM) return status;
    if (status == FW_OK && p->per_s2[0] > 1e-12 * p->per_s2[n - 1]) return FW_OK;
    *p = (fw_mechanism_plates){.mechanism = m,
                               .why = p->why ? p->why : "not all bodies are held by flexures"};
    return FW_OK;
}

int fw_mechanism_plates_mover(const fw_mechanism_plates *p, int mode, bool *tilts) {
    int most = 0;
    double far = -1;
    for (int b = 0; b < p->n / 3; b++) {
        const double *u = p->shape + (size_t)mode * (size_t)p->n + 3 * b, *mass = p->mass + 9 * b;
        double up = mass[0] * u[0] * u[0],
               turn = mass[4] * u[1] * u[1] + 2 * mass[5] * u[1] * u[2] + mass[8] * u[2] * u[2];
        if (fw_above_rounding(up + turn, far)) far = up + turn, most = b, *tilts = turn > up;
    }
    return most;
}

/* ---- loads and answers ---- */

void fw_mechanism_plates_answer(const fw_mechanism_plates *p, const double *f, double *x) {
    size_t n = (size_t)p->n;
    memset(x, 0, n * sizeof *x);
    for (size_t k = 0; k < n; k++) {
        const double *shape = p->shape + k * n;
        double sum = 0;
        for (size_t i = 0; i < n; i++)
            sum += shape[i] * f[i];
        for (size_t i = 0; i < n; i++)
            x[i] += shape[i] * sum / p->per_s2[k];
    }
}

/* What a flexure on the ground is bent by where the layer would lie on a sphere and the ground is flat: -(z, turns) of the
   sphere at its root there, carried rigidly to the pin; false: it is not on the ground, and follows the sphere */
static bool held_flat(const fw_mechanism_plates *p, int hinge, double curvature_per_m,
                      fw_geometry_vec2 middle, double d[3]) {
    const fw_mechanism_pin *pin = &p->mechanism->pin[p->mechanism->hinge[hinge].pin];
    const bool first = pin->body_a == FW_GROUND;
    const fw_geometry_vec2 to = first ? pin->root_a_m : pin->root_b_m;
    const fw_geometry_vec2 g = vec_sub(vec_add(p->hinge[hinge].pin, to), middle);
    d[0] = -curvature_per_m * (0.5 * vec_dot(g, g) - vec_dot(g, to));
    d[1] = -curvature_per_m * g.y, d[2] = curvature_per_m * g.x;
    return first != (pin->body_b == FW_GROUND);
}

void fw_mechanism_plates_wrench(const fw_mechanism_plates *p, int hinge, const double *x,
                                double curvature_per_m, double wrench[3]) {
    const fw_mechanism_hinge *h = &p->mechanism->hinge[hinge];
    const fw_mechanism_pin *pin = &p->mechanism->pin[h->pin];
    const fw_mechanism_plate_hinge *is = &p->hinge[hinge];
    const int body[2] = {pin->body_a, pin->body_b};
    double apart[3] = {0}, world[3] = {0}, d[3], b[3][3];
    for (int s = 0; s < 2; s++) {
        if (body[s] == FW_GROUND) continue;
        lever(p->mechanism, body[s], is->pin, b);
        for (int i = 0; i < 9; i++)
            apart[i / 3] += (s ? 1 : -1) * b[i / 3][i % 3] * x[3 * body[s] + i % 3];
    }
    const fw_geometry_vec2 middle = fw_mechanism_ground_centre(p->mechanism);
    if (curvature_per_m != 0 && held_flat(p, hinge, curvature_per_m, middle, d))
        for (int i = 0; i < 3; i++)
            apart[i] += (pin->body_a == FW_GROUND ? -1 : 1) * d[i];
    for (int i = 0; i < 9; i++)
        world[i / 3] += is->k[i / 3][i % 3] * apart[i % 3] / h->scale;
    const double e = cos(h->axis_rad), s = sin(h->axis_rad);
    wrench[0] = world[0];
    wrench[1] = e * world[1] + s * world[2], wrench[2] = -s * world[1] + e * world[2];
}

double fw_mechanism_plates_z(const fw_mechanism_plates *p, const double *x, int body,
                             fw_geometry_vec2 at) {
    const fw_mechanism_mass *b = &p->mechanism->drawn[body];
    const double *u = x + 3 * body;
    return u[0] + u[1] * (at.y - b->y_m) - u[2] * (at.x - b->x_m);
}

void fw_mechanism_plates_weight(const fw_mechanism_plates *p, double m_per_s2, double *f) {
    for (int b = 0; b < p->n / 3; b++) {
        f[3 * b] = p->mass[9 * b] * m_per_s2;
        f[3 * b + 1] = f[3 * b + 2] = 0;
    }
}

/* Free of the ground the whole layer, strips and plates alike, would lie on one sphere; the ground is flat instead.
   So x is counted from the sphere z = kappa |r - m|^2/2, and each flexure on the ground is pulled by as much as its
   root there departs from it. */
void fw_mechanism_plates_curl(const fw_mechanism_plates *p, double curvature_per_m,
                              fw_geometry_vec2 *middle, double *f) {
    const fw_mechanism *m = p->mechanism;
    *middle = fw_mechanism_ground_centre(m);
    memset(f, 0, (size_t)p->n * sizeof *f);
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        const int body = pin->body_a == FW_GROUND ? pin->body_b : pin->body_a;
        double b[3][3], d[3], w[3] = {0, 0, 0};
        if (!held_flat(p, k, curvature_per_m, *middle, d)) continue;
        lever(m, body, p->hinge[k].pin, b);
        for (int i = 0; i < 9; i++)
            w[i / 3] += p->hinge[k].k[i / 3][i % 3] * d[i % 3];
        for (int i = 0; i < 9; i++)
            f[3 * body + i / 3] += b[i % 3][i / 3] * w[i % 3];
    }
}

void fw_mechanism_plates_modal(const fw_mechanism_plates *p, const double *f, double *amplitude) {
    size_t n = (size_t)p->n;
    for (size_t k = 0; k < n; k++) {
        amplitude[k] = 0;
        for (size_t i = 0; i < n; i++)
            amplitude[k] += p->shape[k * n + i] * f[i] / p->per_s2[k];
    }
}

/* ---- stiffness beside that in the plane ---- */

/* the same bodies and flexures in the plane, (x, y, turn) a body, lengths of turns in `unit_m` */
fw_status fw_mechanism_plates_in_plane(const fw_mechanism_plates *p, const double *give,
                                       double unit_m, double *stiffness) {
    const fw_mechanism *m = p->mechanism;
    size_t n = (size_t)p->n;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_hinge *h = &m->hinge[k];
        const fw_mechanism_pin *pin = &m->pin[h->pin];
        const int body[2] = {pin->body_a, pin->body_b};
        double turned[3][3], own[3][3];
        turn(h->axis_rad, h->closed_form.compliance, 1 / h->scale, turned); /* of (turn, x, y) */
        for (int i = 0; give && i < 9; i++)
            turned[i / 3][i % 3] += give[9 * k + i];
        if (!invert((const double(*)[3])turned, own)) return FW_SOLVER;
        double b[2][3][3] = {0};
        for (int s = 0; s < 2; s++) {
            if (body[s] == FW_GROUND) continue;
            double x = p->hinge[k].pin.x - m->drawn[body[s]].x_m,
                   y = p->hinge[k].pin.y - m->drawn[body[s]].y_m;
            const double to[3][3] = {{0, 0, 1 / unit_m}, {1, 0, -y / unit_m}, {0, 1, x / unit_m}};
            memcpy(b[s], to, sizeof to);
        }
        for (int s = 0; s < 2; s++)
            for (int t = 0; t < 2; t++) {
                if (body[s] == FW_GROUND || body[t] == FW_GROUND) continue;
                for (int i = 0; i < 9; i++) {
                    double sum = 0;
                    for (int q = 0; q < 9; q++)
                        sum += b[s][q / 3][i / 3] * own[q / 3][q % 3] * b[t][q % 3][i % 3];
                    size_t at = (size_t)(3 * body[s] + i / 3) * n + (size_t)(3 * body[t] + i % 3);
                    stiffness[at] += s == t ? sum : -sum;
                }
            }
    }
    return FW_OK;
}

/* ---- loads in the plane that tip it ---- */

/* from a body's centre of mass to what acts on it by the scenes, where nothing is drawn of it */
static double farthest_load(const fw_mechanism *m, int body) {
    double far = 0;
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *s = &m->spring[i];
        if (s->body_a == body) far = fmax(far, hypot(s->ax_m, s->ay_m));
        if (s->body_b == body) far = fmax(far, hypot(s->bx_m, s->by_m));
    }
    for (int i = 0; i < m->device->nscene; i++) {
        const fw_device_scene *s = &m->device->scene[i];
        for (int k = 0; k < s->nforce; k++)
            if (s->force[k].body == body) far = fmax(far, hypot(s->force[k].x_m, s->force[k].y_m));
        for (int k = 0; k < s->ntendon; k++)
            for (int l = 0; l < s->tendon[k].neyelet; l++) {
                const fw_device_eyelet *e = &s->tendon[k].eyelet[l];
                if (e->body == body) far = fmax(far, hypot(e->x_m, e->y_m));
            }
        for (int k = 0; k < s->ncomb; k++) {
            const fw_device_comb *c = &s->comb[k];
            const double half = isnan(c->length_m) ? c->overlap_m : 0.5 * c->length_m,
                         wide = 2 * c->fingers * (c->gap_m + fw_device_comb_width_m(c));
            const fw_geometry_vec2 at = fw_mechanism_local_place(m, c->body_b, c->bx_m, c->by_m);
            if (c->body_a != body && c->body_b != body) continue;
            far = fmax(far, half + wide + c->gap_m +
                                hypot(at.x - m->drawn[body].x_m, at.y - m->drawn[body].y_m));
        }
        for (int k = 0; k < s->ncontact; k++) {
            const fw_device_contact_use *c = &s->contact[k];
            const double round = isnan(c->distance_m) ? 0 : c->distance_m;
            if (c->joint != FW_NONE) continue;
            if (c->body_a == body && !c->face) far = fmax(far, round + hypot(c->ax_m, c->ay_m));
            if (c->body_b == body) far = fmax(far, round + hypot(c->bx_m, c->by_m));
        }
    }
    return far;
}

/* From a body's centre of mass to the corner of the boxes of what is drawn of it; where nothing is, to its flexures and
   to what acts on it */
static double farthest(const fw_mechanism *m, int body) {
    double far = is_drawn(m, body) ? 0 : farthest_load(m, body);
    for (int j = 0; !is_drawn(m, body) && j < m->npin; j++) {
        const fw_mechanism_pin *pin = &m->pin[j];
        if (pin->body_a == body) far = fmax(far, hypot(pin->ax_m, pin->ay_m));
        if (pin->body_b == body) far = fmax(far, hypot(pin->bx_m, pin->by_m));
    }
    for (int i = 0; m->layout && i < m->layout->npiece; i++) {
        const fw_layout_piece *piece = &m->layout->piece[i];
        if (piece->body != body || !fw_layout_is_wall(piece)) continue;
        fw_geometry_box box = fw_geometry_contour_box(&piece->contour);
        double x = fmax(fabs(box.x0 - m->drawn[body].x_m), fabs(box.x1 - m->drawn[body].x_m));
        double y = fmax(fabs(box.y0 - m->drawn[body].y_m), fabs(box.y1 - m->drawn[body].y_m));
        far = fmax(far, hypot(x, y));
    }
    return far;
}

/* The same of a force F, of direction f, that acts anywhere up to `far` from the centre of mass: its work |F| far |g f| |g| is at most
   |F| far (share g^2 + (g f)^2/share)/2, whatever share > 0 is. A tilt about the force's own line has little of it. */
static void add_somewhere(const double *force_N, double far, double share, double *at, int n) {
    double f = hypot(force_N[0], force_N[1]), half = 0.5 * f * far;
    if (!(f > 0)) return;
    double cx = force_N[0] / f, cy = force_N[1] / f;
    at[0] += half * (share + cy * cy / share); /* turns (x, y) are (g_y, -g_x) */
    at[1] -= half * cx * cy / share, at[n] -= half * cx * cy / share;
    at[n + 1] += half * (share + cx * cx / share);
}

/* What a plate loses of its stiffness against tilt g = grad z under forces F at r in the plane, -g' (sum F r') g/2 of
   second-order work: stiffness (sum F r' + r F')/2 is added to the tilts, here less it in `lost` (n x n) */
static void add_tipping(const fw_mechanism_plates *p, const fw_mechanism_plates_pressed *by,
                        double *lost, double *rest, double share) {
    const fw_mechanism *m = p->mechanism;
    const double *force_N = by->force_N;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        for (int side = 0; side < 2; side++) {
            int body = side ? pin->body_b : pin->body_a;
            double sign = side ? -1 : 1, fx = sign * force_N[2 * k], fy = sign * force_N[2 * k + 1];
            if (body == FW_GROUND) continue;
            double x = p->hinge[k].pin.x - m->drawn[body].x_m,
                   y = p->hinge[k].pin.y - m->drawn[body].y_m;
            double gxx = fx * x, gyy = fy * y, gxy = 0.5 * (fx * y + fy * x);
            double *at = lost + (size_t)(3 * body + 1) * (size_t)p->n + 3 * body + 1;
            at[0] += gyy, at[1] -= gxy; /* turns (x, y) are (g_y, -g_x) */
            at[p->n] -= gxy, at[p->n + 1] += gxx;
            rest[2 * body] -= fx, rest[2 * body + 1] -= fy;
        }
    }
    for (int b = 0; b < m->nbody; b++) {
        double *at = lost + (size_t)(3 * b + 1) * (size_t)p->n + 3 * b + 1, most = by->else_Nm[b];
        if (isnan(most))
            add_somewhere(&rest[2 * b], farthest(m, b), share, at, p->n);
        else
            at[0] += most, at[p->n + 1] += most;
    }
}

/* Each flexure alone: 1/factor is at most  N (2 L/pi)^2/EI + M (2 L/pi)/sqrt(EI GJ), by Wirtinger's inequality on the
   developed strip, clamped at one end: Euler's and Prandtl's loads of a cantilever, added. N is what presses it, since what
   pulls a straight strip keeps it flat; the moment is that of its rotation and of the force across over its length */
static double hinge_alone(const fw_mechanism_plate_hinge *h, const double most[3]) {
    double l = 2 * h->length_m / FW_PI, M = most[1] + 0.5 * sqrt(most[2]) * h->length_m;
    return sqrt(most[0]) * l * l / h->bend_Nm2 + M * l / sqrt(h->bend_Nm2 * h->twist_Nm2);
}

/* Largest eigenvalue of lost x = (1/factor) K x, in the modes' coordinates; where Frobenius' norm is below `little`
   that norm, which is no less. lost, a (n x n) and part (n) are used up */
static fw_status tilts_alone(fw_arena *arena, const fw_mechanism_plates *p, const double *lost,
                             double little, double *a, double *part, double *largest) {
    const size_t n = (size_t)p->n;
    fw_maths_lapack_space space;
    for (size_t k = 0; k < n; k++) {
        for (size_t i = 0; i < n; i++) {
            part[i] = 0;
            for (size_t j = 0; j < n; j++)
                part[i] += lost[i * n + j] * p->shape[k * n + j];
        }
        for (size_t l = 0; l < n; l++) {
            double sum = 0;
            for (size_t i = 0; i < n; i++)
                sum += p->shape[l * n + i] * part[i];
            a[k * n + l] = sum / sqrt(p->per_s2[k] * p->per_s2[l]);
        }
    }
    double squares = 0;
    for (size_t i = 0; i < n * n; i++)
        squares += a[i] * a[i];
    *largest = sqrt(squares);
    if (*largest < little) return FW_OK;
    FW_TRY(fw_maths_eigen_space(arena, p->n, &space));
    if (!fw_maths_eigen(p->n, a, part, &space)) return FW_SOLVER;
    *largest = fmax(part[n - 1], 0);
    return FW_OK;
}

/* Lower bound of Foppl and Papkovich: with each part of what gives taken alone, 1/factor <= sum of theirs. Plates on
   flexures without second-order work inside them, the least of what the shares below bound it by; of the flexures the
   worst one, since each has the forces of its own. In: N, N m. Source: Tarnai, Int. J. Mech. Sci. 37 (1995). Cost 10 n^3
   for each share. Test: test_mechanism_plates.c */
fw_status fw_mechanism_plates_buckling(fw_arena *arena, const fw_mechanism_plates *p,
                                       const fw_mechanism_plates_pressed *by, double *factor,
                                       int *hinge) {
    static const double share[] = {1, 0.5, 0.25, 0.125};
    const size_t n = (size_t)p->n, nbody = (size_t)p->mechanism->nbody;
    double *lost, *a, *part, *rest, worst = 0, least = HUGE_VAL;
    bool known = true;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(lost = fw_arena_array(arena, double, n *n));
    FW_NEED(a = fw_arena_array(arena, double, n *n));
    FW_NEED(part = fw_arena_array(arena, double, n));
    FW_NEED(rest = fw_arena_array(arena, double, 2 * nbody + 1));
    for (size_t b = 0; b < nbody; b++)
        known = known && !isnan(by->else_Nm[b]);
    *hinge = FW_NONE;
    for (int k = 0; k < p->mechanism->nhinge; k++) {
        double alone = hinge_alone(&p->hinge[k], by->most + 3 * k);
        if (alone > worst) worst = alone, *hinge = k;
    }
    for (size_t i = 0; i < (known ? 1 : sizeof share / sizeof *share); i++) {
        double largest;
        memset(lost, 0, n * n * sizeof *lost);
        memset(rest, 0, (2 * nbody + 1) * sizeof *rest);
        add_tipping(p, by, lost, rest, share[i]);
        FW_TRY(tilts_alone(arena, p, lost, by->enough > 0 ? 1 / by->enough - worst : 0, a, part,
                           &largest));
        least = fmin(least, largest);
    }
    double all = least + worst;
    *factor = all > 0 ? 1 / all : HUGE_VAL;
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
