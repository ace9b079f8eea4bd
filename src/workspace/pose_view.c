/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a pose strains, and poses that were looked at before. */
#include "workspace/pose_load.h"
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* ---- places along a flexure at which its strain is looked at ---- */

enum { INSIDE = 16 }; /* parts of an arc */

static double lever_of(const fw_device_flexure *f, const fw_flexure_result *c) {
    double a = 0.5 * f->angle_rad, off = hypot(c->offset_m[0], c->offset_m[1]);
    double arc = hypot(f->radius_m * cos(a) - c->centre_m, f->radius_m * sin(a));
    return (f->kind == FW_FLEXURE_CSFH ? arc : 0.5 * f->length_m) + off;
}

/* no section is farther from the pin than this */
static double farthest(const fw_flexure_path_strain *s, const double pin[2]) {
    double far = 0;
    for (int i = 0; i < s->n; i++)
        far = fmax(far, hypot(s->point[i].x_m - pin[0], s->point[i].y_m - pin[1]));
    return far;
}

/* M(P) = M + (y - yW) Fx - (x - xW) Fy, the force on the second body -F: the lever of F is (y - yW,
   xW - x) */
static fw_workspace_station place(const double pin[2], double x, double y, double bending,
                                  double axial) {
    return (fw_workspace_station){{y - pin[1], pin[0] - x}, bending, axial};
}

/* Stations of an arc: the roots with their concentration, and inside of it places so close that
   between two of them |M| is at most r |F| (1 - cos of half their distance) above the larger. All
   of them are below the moment at the arc's centre and r |F|. */
static void arc(const fw_device_flexure *f, const fw_flexure_result *c, const double pin[2],
                double bending, double kt, double axial, fw_workspace_station *to,
                fw_workspace_section *out) {
    double r = f->radius_m, a = 0.5 * f->angle_rad, inside = bending * c->fibre / c->concentration;
    double above = r * (1.0 - cos(a / INSIDE)) * inside;
    out->roots = 2;
    out->inside = place(pin, 0.0, 0.0, inside, axial + r * inside);
    for (int side = -1; side <= 1; side += 2)
        to[out->n++] = place(pin, r * cos(a), side * r * sin(a), bending, kt * axial);
    for (int i = 1; i < INSIDE; i++) {
        double b = a * (2.0 * i / INSIDE - 1.0);
        to[out->n++] = place(pin, r * cos(b), r * sin(b), inside, axial + above);
    }
}

/* of a flexure that varies: between two sections the moment may rise by an eighth of its second
   difference */
static int varying(const fw_flexure_path_strain *s, const double pin[2], fw_workspace_station *to) {
    for (int i = 0; i < s->n; i++) {
        const fw_flexure_path_point *p = &s->point[i];
        double above = 0.0;
        if (i > 0 && i + 1 < s->n)
            above =
                0.125 * hypot(p[-1].x_m - 2 * p->x_m + p[1].x_m, p[-1].y_m - 2 * p->y_m + p[1].y_m);
        to[i] = place(pin, p->x_m, p->y_m, p->strain_per_Nm,
                      p->strain_per_N + above * p->strain_per_Nm);
    }
    return s->n;
}

/* The strain of eq. 1 and 2 of docs/theory/verdict.md as places along the strip. Where the axis is
   not drawn the force acts on its largest lever, wherever it points. */
static fw_status one_section(fw_arena *arena, const fw_mechanism *m, const fw_mechanism_hinge *h,
                             fw_workspace_section *out) {
    const fw_device_flexure *f = &m->device->flexure[h->flexure];
    const fw_flexure_result *c = &h->closed_form;
    const double pin[2] = {c->centre_m + c->offset_m[0], c->offset_m[1]};
    double scale = h->scale > 0 ? h->scale : 1;
    double bending = c->strain_per_rad / (scale * c->stiffness_Nm_per_rad);
    double area = fw_device_flexure_narrowest_m(f) * m->variant->thickness_m;
    double axial = 1 / (scale * m->variant->material.youngs.value * area);
    double kt = fw_flexure_tension_concentration(f->width_m, h->input.fillet_m);
    bool varies = fw_flexure_input_varies(&h->input);
    size_t most = h->section.n > INSIDE ? (size_t)h->section.n : INSIDE + 1;
    fw_workspace_station *to = fw_arena_array(arena, fw_workspace_station, most);
    FW_NEED(to);
    out->station = to;
    out->moment_Nm_per_rad = scale * c->stiffness_Nm_per_rad;
    bool drawn = isfinite(h->axis_rad);
    out->axis[0] = drawn ? cos(h->axis_rad) : 1.0, out->axis[1] = drawn ? sin(h->axis_rad) : 0.0;
    if (!drawn) {
        double lever = varies ? farthest(&h->section, pin) : lever_of(f, c);
        to[0] = (fw_workspace_station){{0.0, 0.0}, bending, kt * axial + lever * bending};
        out->n = 1;
    } else if (varies) {
        out->n = varying(&h->section, pin, to);
    } else if (f->kind == FW_FLEXURE_CSFH) {
        arc(f, c, pin, bending, kt, axial, to, out);
        return FW_OK;
    } else {
        for (int side = 0; side < 2; side++)
            to[side] = place(pin, 0.0, (side - 0.5) * f->length_m, bending, kt * axial);
        out->n = 2;
    }
    out->roots = out->n;
    return FW_OK;
}

fw_status fw_workspace_sections(fw_arena *arena, const fw_mechanism *m,
                                fw_workspace_section section[FW_SIX]) {
    for (int i = 0; i < FW_SIX; i++) {
        int hinge = m->pin[i].hinge;
        section[i] = (fw_workspace_section){.spring_Nm_per_rad = m->pin[i].stiffness_Nm_per_rad};
        if (hinge != FW_NONE) FW_TRY(one_section(arena, m, &m->hinge[hinge], &section[i]));
    }
    return FW_OK;
}

/* ---- at one box ---- */

/* largest size of what lies in the interval, and the least */
static fw_maths_interval sizes_of(fw_maths_interval a) {
    double far = fmax(fabs(a.lo), fabs(a.hi));
    double near = a.lo > 0.0 ? a.lo : a.hi < 0.0 ? -a.hi : 0.0;
    return (fw_maths_interval){near, far};
}

/* m + sum g_i s_i within rest, |s_i| <= 1 across the box; of many stations of one hinge, which are
   sums of four of these */
typedef struct plane {
    double m, g[3], rest;
} plane;

static plane plane_of(const fw_workspace_jet *a, const double half[3]) {
    plane p = {.m = a->v.m, .rest = a->v.e};
    for (int i = 0; i < 3; i++) {
        p.g[i] = half[i] * a->d[i].m;
        p.rest += half[i] * 0.5 * (a->d[i].e + a->d[i].r);
    }
    p.rest = fw_grown(fw_grown(p.rest));
    if (a->v.r < p.rest) p = (plane){.m = a->v.m, .rest = a->v.r}; /* the box is too large for it */
    return p;
}

typedef struct share { /* of friction in one hinge: per unit of its torque, and that */
    plane fx, fy;
    double near, far, least_Nm, most_Nm;
} share;

typedef struct loaded {       /* of one hinge over one box */
    plane moment, fx, fy;     /* K theta; force in the frame half turned */
    plane along;              /* n.F, n the force's direction in the middle: |F| <= n.F + beside */
    double beside, far, near; /* far and near bound |F| in any case */
    bool slanted;             /* `along` holds */
    const struct share *rub;  /* (nrub) of friction */
    int nrub;
} loaded;

static void press(const fw_workspace_jet2 *f, const double half[3], loaded *p) {
    fw_maths_interval x = sizes_of(fw_jet_range(&f->x, half)),
                      y = sizes_of(fw_jet_range(&f->y, half));
    p->far = fw_grown(sqrt(fw_grown(x.hi * x.hi + y.hi * y.hi)));
    p->near = fmax(fw_down(sqrt(x.lo * x.lo + y.lo * y.lo)) * (1.0 - 1e-15), 0.0);
    p->slanted = false;
    double n = hypot(f->x.v.m, f->y.v.m);
    if (!(n > 0.0) || !isfinite(p->far)) return;
    double nx = f->x.v.m / n, ny = f->y.v.m / n; /* of length 1 within 2^-51 */
    fw_workspace_jet along = fw_jet_add(fw_jet_scaled(f->x, nx), fw_jet_scaled(f->y, ny));
    fw_workspace_jet across = fw_jet_sub(fw_jet_scaled(f->y, nx), fw_jet_scaled(f->x, ny));
    fw_maths_interval least = fw_jet_range(&along, half),
                      off = sizes_of(fw_jet_range(&across, half));
    if (!(least.lo > 0.0)) return;
    p->along = plane_of(&along, half);
    p->beside = fw_grown(fw_grown(0.5 * off.hi * off.hi) / least.lo) + 1e-14 * p->far;
    p->slanted = true;
}

/* What friction adds at most: sum of T_j (bending |lever.G_j| + axial |G_j|), which is where the signs are such that all of
   it bends further. */
static fw_maths_interval rubbed(const fw_workspace_station *at, const loaded *p, double slope[3]) {
    fw_maths_interval sum = {0, 0};
    const double w = at->bending_per_Nm, x = at->lever_m[0], y = at->lever_m[1];
    for (int j = 0; j < p->nrub; j++) {
        const double m = x * p->rub[j].fx.m + y * p->rub[j].fy.m;
        double reach = fabs(x) * p->rub[j].fx.rest + fabs(y) * p->rub[j].fy.rest;
        const double turn = m < 0 ? -1 : 1;
        for (int i = 0; i < 3; i++) {
            const double g = x * p->rub[j].fx.g[i] + y * p->rub[j].fy.g[i];
            reach += fabs(g);
            slope[i] += turn * p->rub[j].most_Nm * w * g;
        }
        const double slack =
            (fabs(x * p->rub[j].fx.m) + fabs(y * p->rub[j].fy.m) + reach) * 0x1p-46;
        sum.hi +=
            p->rub[j].most_Nm * (w * (fabs(m) + reach + slack) + at->axial_per_N * p->rub[j].far);
        sum.lo += p->rub[j].least_Nm *
                  (w * fmax(fabs(m) - reach - slack, 0) + at->axial_per_N * p->rub[j].near);
    }
    return (fw_maths_interval){sum.lo * (1 - 0x1p-40), sum.hi * (1 + 0x1p-40)};
}

/* Range of bending |M - lever.F| + axial |F|. The sums of planes are rounded as numbers are: they
   err by a few units of the sizes that are added. */
static fw_maths_interval one_station(const fw_workspace_station *at, const loaded *p,
                                     double slope[3]) {
    double w = at->bending_per_Nm, x = at->lever_m[0], y = at->lever_m[1], ax = at->axial_per_N;
    double m = w * (p->moment.m - x * p->fx.m - y * p->fy.m), g[3], reach = 0.0, size;
    size = w * (fabs(p->moment.m) + fabs(x * p->fx.m) + fabs(y * p->fy.m));
    double rest = w * (p->moment.rest + fabs(x) * p->fx.rest + fabs(y) * p->fy.rest);
    for (int i = 0; i < 3; i++) {
        g[i] = w * (p->moment.g[i] - x * p->fx.g[i] - y * p->fy.g[i]);
        size += w * (fabs(p->moment.g[i]) + fabs(x * p->fx.g[i]) + fabs(y * p->fy.g[i]));
        reach += fabs(g[i]);
    }
    double sign = m < 0.0 ? -1.0 : 1.0, slack = (size + rest + ax * p->far) * 0x1p-46;
    double hi = fabs(m) + reach + rest + ax * p->far + slack;
    double lo = fabs(m) - reach - rest - slack;
    lo = (lo > 0.0 ? lo : 0.0) + fw_down(ax * p->near);
    if (p->slanted) {
        double q = ax * p->along.m, more = ax * (p->along.rest + p->beside), up = 0.0, down = 0.0;
        for (int i = 0; i < 3; i++) {
            up += fabs(g[i] + ax * p->along.g[i]);
            down += fabs(g[i] - ax * p->along.g[i]);
        }
        up = m + q + up + rest + more + slack, down = -m + q + down + rest + more + slack;
        double most = up > down ? up : down;
        if (most < hi) hi = most;
    }
    for (int i = 0; i < 3; i++)
        slope[i] = sign * g[i] + (p->slanted ? ax * p->along.g[i] : 0.0);
    return (fw_maths_interval){lo, hi};
}

static plane along_of(const fw_workspace_jet2 *t, const fw_workspace_jet2 *f, bool across,
                      const double half[3]) {
    const fw_workspace_jet a =
        fw_jet_tight(across ? fw_jet2_cross(*t, *f) : fw_jet2_dot(*t, *f), half);
    return plane_of(&a, half);
}

static int shares_of(const fw_workspace_pose_load *o, int hinge, const fw_workspace_rub *rub,
                     share to[FW_SIX]) {
    const fw_workspace_jet2 *t = &o->frame[hinge];
    int n = 0;
    for (int j = 0; j < FW_SIX; j++) {
        if (!rub->rubs[j]) continue;
        const fw_workspace_jet2 *g = &rub->force[j][hinge];
        loaded size = {0};
        press(g, o->half, &size);
        to[n++] = (share){.fx = along_of(t, g, false, o->half),
                          .fy = along_of(t, g, true, o->half),
                          .near = size.near,
                          .far = size.far,
                          .least_Nm = rub->least_Nm[j],
                          .most_Nm = rub->most_Nm[j]};
    }
    return n;
}

fw_maths_interval fw_workspace_pose_strain(const fw_workspace_hold *hold,
                                           const fw_workspace_pose_load *o, int hinge,
                                           const fw_workspace_jet2 *force,
                                           const fw_workspace_rub *rub, double slope[3]) {
    const fw_workspace_section *s = &hold->section[hinge];
    fw_maths_interval all = {0.0, 0.0};
    if (s->n == 0) return all;
    fw_workspace_jet2 t = o->frame[hinge];
    fw_workspace_jet along = fw_jet_tight(fw_jet2_dot(t, *force), o->half),
                     across = fw_jet_tight(fw_jet2_cross(t, *force), o->half),
                     moment = fw_jet_scaled(o->theta[hinge], s->moment_Nm_per_rad);
    loaded p = {.moment = plane_of(&moment, o->half),
                .fx = plane_of(&along, o->half),
                .fy = plane_of(&across, o->half)};
    press(force, o->half, &p);
    share of_friction[FW_SIX];
    if (rub) p.nrub = shares_of(o, hinge, rub, of_friction), p.rub = of_friction;
    for (int i = 0; i < s->n; i++) {
        double now[3];
        if (i == s->roots && p.nrub == 0 && one_station(&s->inside, &p, now).hi <= all.hi) break;
        fw_maths_interval one = one_station(&s->station[i], &p, now);
        if (p.nrub > 0) {
            const fw_maths_interval more = rubbed(&s->station[i], &p, now);
            one.lo += more.lo, one.hi += more.hi;
        }
        if (one.lo > all.lo) all.lo = one.lo;
        for (int k = 0; k < 3 && slope && one.hi > all.hi; k++)
            slope[k] = now[k];
        if (!(one.hi <= all.hi) && !isnan(all.hi)) all.hi = one.hi; /* NaN is kept */
    }
    return all;
}

void fw_workspace_rub_signs(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                            int hinge, const fw_workspace_jet2 *force, const fw_workspace_rub *rub,
                            int sign[FW_SIX]) {
    const fw_workspace_section *s = &hold->section[hinge];
    const fw_workspace_jet2 *t = &o->frame[hinge];
    double most = -1;
    memset(sign, 0, FW_SIX * sizeof *sign);
    for (int i = 0; i < s->n; i++) {
        const fw_workspace_station *at = &s->station[i];
        const double c = t->x.v.m, n = t->y.v.m, x = at->lever_m[0], y = at->lever_m[1];
        const double fx = c * force->x.v.m + n * force->y.v.m,
                     fy = c * force->y.v.m - n * force->x.v.m;
        const double m = s->moment_Nm_per_rad * o->theta[hinge].v.m - x * fx - y * fy;
        double lever[FW_SIX] = {0}, all = fabs(m);
        for (int j = 0; j < FW_SIX; j++) {
            const fw_workspace_jet2 *g = &rub->force[j][hinge];
            if (!rub->rubs[j]) continue;
            lever[j] = -x * (c * g->x.v.m + n * g->y.v.m) - y * (c * g->y.v.m - n * g->x.v.m);
            all += rub->most_Nm[j] * fabs(lever[j]);
        }
        all = at->bending_per_Nm * all + at->axial_per_N * hypot(fx, fy);
        for (int j = 0; j < FW_SIX && all > most; j++)
            sign[j] = !rub->rubs[j] ? 0 : (m < 0) == (lever[j] < 0) ? 1 : -1;
        most = fmax(most, all);
    }
}

/* ---- poses that were looked at before ----
   Of the devices of a study much is the same to the last bit: where everything is, unless a
   pin moves; forces, unless a spring, a grip or the platform does; the strain of a hinge, unless it is another one. What is
   kept carries the number of what it was found with, and is found again with the same alone; forces where something is given
   or rubs are not kept. Test: test_pose_strain.c what_devices_have_in_common */

enum {
    POSES = 1024, /* a power of 2: one place for each box */
    GRIPS = 8,    /* the first ones of a hold, of which forces are kept */
    BOXES = 256,  /* that have room for them: 3 MB */
    KINDS = 4,    /* flows take turns */
    WORDS = 320
};

typedef struct kind { /* what something was found with, as numbers */
    long is;          /* 0: there is none */
    int n;
    double word[WORDS];
} kind;

typedef struct kinds {
    kind item[KINDS];
    int next; /* to be replaced */
} kinds;

typedef struct placed {
    fw_workspace_box3 box;
    long of; /* 0: of none */
    bool reached;
    char at[offsetof(fw_workspace_pose_load, own)];
    long filled, forces;        /* counted; forces of `grip` */
    fw_workspace_gripped *grip; /* (GRIPS) or NULL */
} placed;

struct fw_workspace_poses {
    fw_arena *arena;
    long of, filled, kind; /* counted: mechanisms, boxes, kinds */
    fw_workspace_loop loop;
    double axis[FW_SIX][2];        /* 0, 0: no section */
    placed *item;                  /* (POSES) */
    int roomy;                     /* boxes that have room for forces */
    const fw_workspace_hold *hold; /* that is looked at now */
    long forces, section[FW_SIX];  /* its numbers; 0: forces are not kept */
    kinds of_forces, of_section[FW_SIX];
};

fw_status fw_workspace_poses_new(fw_arena *arena, fw_workspace_poses **poses) {
    FW_NEED(*poses = fw_arena_one(arena, fw_workspace_poses));
    (*poses)->arena = arena;
    FW_NEED((*poses)->item = fw_arena_array(arena, placed, POSES));
    return FW_OK;
}

static void say(kind *k, double word) {
    if (k->n < WORDS) k->word[k->n] = word;
    k->n++;
}

/* its number, that of an equal one where there is one; 0: it is too long to be known again */
static long number_of(fw_workspace_poses *p, kinds *all, const kind *now) {
    if (now->n > WORDS) return 0;
    for (int i = 0; i < KINDS; i++) {
        const kind *was = &all->item[i];
        if (was->is > 0 && was->n == now->n &&
            memcmp(was->word, now->word, (size_t)now->n * sizeof *now->word) == 0)
            return was->is;
    }
    kind *to = &all->item[all->next];
    all->next = (all->next + 1) % KINDS;
    *to = *now;
    return to->is = ++p->kind;
}

static void say_actuator(kind *k, const fw_workspace_actuator *a) {
    say(k, a->kind), say(k, a->body), say(k, a->against), say(k, a->pulls), say(k, a->platform);
    say(k, a->direction[0]), say(k, a->direction[1]), say(k, a->npoint);
    for (int i = 0; i < a->npoint; i++)
        say(k, a->point[i].body), say(k, a->point[i].x_m), say(k, a->point[i].y_m);
}

static void say_station(kind *k, const fw_workspace_station *s) {
    say(k, s->lever_m[0]), say(k, s->lever_m[1]), say(k, s->bending_per_Nm), say(k, s->axial_per_N);
}

static void keep_forces_of(fw_workspace_poses *p, const fw_workspace_hold *h) {
    kind all = {.n = 0};
    say(&all, h->length_m);
    for (int i = 0; i < 5; i++)
        say(&all, h->at[i].x), say(&all, h->at[i].y);
    for (int i = 0; i < h->nactuator; i++)
        say_actuator(&all, &h->actuator[i]);
    for (int i = 0; i < h->ngrip && i < GRIPS; i++)
        for (int j = 0; j < 3; j++)
            say(&all, h->grip[i].actuator[j]), say(&all, h->grip[i].wrench);
    for (int i = 0; i < FW_SIX; i++) {
        const fw_workspace_section *s = &h->section[i];
        kind one = {.n = 0};
        say(&all, s->spring_Nm_per_rad);
        say(&one, s->moment_Nm_per_rad), say(&one, s->n), say(&one, s->roots);
        say_station(&one, &s->inside);
        for (int j = 0; j < s->n; j++)
            say_station(&one, &s->station[j]);
        p->section[i] = number_of(p, &p->of_section[i], &one);
    }
    p->forces = number_of(p, &p->of_forces, &all);
}

void fw_workspace_poses_are_of(fw_workspace_poses *p, const fw_workspace_hold *hold, bool whole) {
    double axis[FW_SIX][2] = {{0}};
    p->hold = hold, p->forces = 0;
    if (whole) keep_forces_of(p, hold);
    for (int i = 0; i < FW_SIX; i++)
        if (hold->section[i].n > 0) memcpy(axis[i], hold->section[i].axis, sizeof axis[i]);
    if (p->of > 0 && memcmp(&p->loop, hold->loop, sizeof p->loop) == 0 &&
        memcmp(p->axis, axis, sizeof axis) == 0)
        return;
    p->of++;
    p->loop = *hold->loop;
    memcpy(p->axis, axis, sizeof axis);
}

static placed *place_in(const fw_workspace_poses *p, const fw_workspace_box3 *box) {
    uint64_t word[sizeof *box / sizeof(uint64_t)], sum = 0;
    memcpy(word, box, sizeof word);
    for (size_t i = 0; i < sizeof word / sizeof word[0]; i++)
        sum = (sum ^ word[i] ^ sum >> 29) * UINT64_C(0x9e3779b97f4a7c15);
    return &p->item[sum >> 32 & (POSES - 1)];
}

/* *kept: where it stands now; NULL: nowhere */
static bool places(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                   fw_workspace_pose_load *o, placed **kept) {
    fw_workspace_poses *p = hold->poses;
    *kept = NULL;
    if (!p || p->hold != hold) return fw_workspace_pose_places(hold, box, NULL, o);
    placed *was = *kept = place_in(p, box);
    if (was->of == p->of && memcmp(&was->box, box, sizeof *box) == 0) {
        memcpy(o, was->at, sizeof was->at);
        return was->reached;
    }
    was->reached = fw_workspace_pose_places(hold, box, NULL, o);
    was->of = p->of, was->box = *box;
    was->filled = ++p->filled, was->forces = 0;
    memcpy(was->at, o, sizeof was->at);
    return was->reached;
}

bool fw_workspace_poses_find(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                             fw_workspace_pose_load *o) {
    placed *unused;
    return places(hold, box, o, &unused);
}

fw_status fw_workspace_view_new(fw_arena *arena, const fw_workspace_hold *hold,
                                fw_workspace_view *view) {
    const size_t n = (size_t)hold->nactuator + 1;
    *view = (fw_workspace_view){.hold = hold};
    FW_NEED(view->response = fw_arena_array(arena, fw_workspace_response, n));
    FW_NEED(view->responded = fw_arena_array(arena, bool, n));
    return FW_OK;
}

bool fw_workspace_view_at(fw_workspace_view *v, const fw_workspace_box3 *box) {
    v->owned = false, v->here_of = FW_NONE;
    memset(v->responded, 0, (size_t)v->hold->nactuator * sizeof *v->responded);
    const bool reached = places(v->hold, box, &v->load, &v->kept);
    v->filled = v->kept ? v->kept->filled : 0;
    return reached;
}

/* where forces of the first grips are kept; NULL: nowhere, or another box has taken the place meanwhile */
static fw_workspace_gripped *kept_grips(const fw_workspace_view *v) {
    fw_workspace_poses *p = v->hold->poses;
    placed *k = v->kept;
    if (!k || p->hold != v->hold || p->forces == 0 || k->filled != v->filled) return NULL;
    if (v->hold->ngiven > 0 || v->hold->rubs) return NULL;
    if (!k->grip && p->roomy < BOXES) {
        k->grip = fw_arena_array(p->arena, fw_workspace_gripped, GRIPS);
        p->roomy += k->grip != NULL;
    }
    if (k->grip && k->forces != p->forces)
        for (int i = 0; i < GRIPS; i++)
            k->grip[i].known = false;
    k->forces = p->forces;
    return k->grip;
}

static fw_workspace_gripped *room_of(fw_workspace_view *v, int grip) {
    fw_workspace_gripped *kept = grip < GRIPS ? kept_grips(v) : NULL;
    if (kept) return &kept[grip];
    if (v->here_of != grip) v->here.known = false;
    v->here_of = grip;
    return &v->here;
}

fw_workspace_gripped *fw_workspace_view_grip(fw_workspace_view *v, int grip) {
    const fw_workspace_hold *h = v->hold;
    const fw_workspace_grip *by = &h->grip[grip];
    fw_workspace_gripped *to = room_of(v, grip);
    if (to->known) return to;
    if (!v->owned) fw_workspace_pose_own(h, &v->load);
    v->owned = true;
    for (int k = 0; k < 3 && !by->wrench; k++) {
        const int i = by->actuator[k];
        if (!v->responded[i])
            fw_workspace_pose_response(h, &v->load, &h->actuator[i], &v->response[i]);
        v->responded[i] = true;
    }
    to->holds = fw_workspace_pose_forces(h, &v->load, v->response, by, &to->certain, to->own,
                                         to->force, &v->rub);
    memset(to->section, 0, sizeof to->section);
    to->known = true;
    return to;
}

fw_maths_interval fw_workspace_view_strain(const fw_workspace_view *v, fw_workspace_gripped *by,
                                           int hinge, double slope[3]) {
    const fw_workspace_poses *p = v->hold->poses;
    const long section = by == &v->here ? 0 : p->section[hinge];
    if (section == 0 || by->section[hinge] != section) {
        memset(by->slope[hinge], 0, sizeof by->slope[hinge]);
        by->strain[hinge] =
            fw_workspace_pose_strain(v->hold, &v->load, hinge, &by->force[hinge],
                                     v->hold->rubs ? &v->rub : NULL, by->slope[hinge]);
        by->section[hinge] = section;
    }
    if (slope) memcpy(slope, by->slope[hinge], sizeof by->slope[hinge]);
    return by->strain[hinge];
}
