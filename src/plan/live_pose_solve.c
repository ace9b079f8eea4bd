/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inverse kinematics for dragging: of a six-bar in closed form, of anything else by closing its
   joints about a body that hardly gives way. */
#include "assembly/assembly.h"
#include "plan/live_request.h"
#include "workspace/workspace.h"
#include <math.h>
#include <string.h>

static void rest_of(const fw_mechanism *m, double *q) {
    for (int b = 0; b < m->nbody; b++) {
        q[3 * b] = m->body[b].x_m;
        q[3 * b + 1] = m->body[b].y_m;
        q[3 * b + 2] = m->body[b].phi_rad;
    }
}

/* size of the mechanism at rest: larger extent of its pins and centres of mass, m */
static double size_of(const fw_mechanism *m) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int i = -m->nbody; i < m->npin; i++) {
        fw_geometry_vec2 p =
            i < 0 ? (fw_geometry_vec2){m->body[i + m->nbody].x_m, m->body[i + m->nbody].y_m}
                  : fw_mechanism_pin_place(m, &m->pin[i], 0);
        low[0] = fmin(low[0], p.x), high[0] = fmax(high[0], p.x);
        low[1] = fmin(low[1], p.y), high[1] = fmax(high[1], p.y);
    }
    double size = fmax(high[0] - low[0], high[1] - low[1]);
    return size > 0 && isfinite(size) ? size : 1e-3;
}

int fw_plan_pose_body(const fw_mechanism *m) {
    int heaviest = FW_NONE;
    for (int b = 0; b < m->nbody; b++) {
        if (m->device->body[b].platform) return b;
        if (heaviest == FW_NONE || m->body[b].mass_kg > m->body[heaviest].mass_kg) heaviest = b;
    }
    return heaviest;
}

static void angles_of(const fw_mechanism *m, const double *q, double *angle) {
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        angle[i] = (p->body_b == FW_GROUND ? 0.0 : q[3 * p->body_b + 2]) -
                   (p->body_a == FW_GROUND ? 0.0 : q[3 * p->body_a + 2]) - p->free_angle_rad;
    }
}

/* ---- six-bar ---- */

/* puts body b of a pin where the pin's angle and body a say, or body a likewise */
static void place(const fw_mechanism_pin *p, double angle, bool put_b, double *q) {
    int from = put_b ? p->body_a : p->body_b, to = put_b ? p->body_b : p->body_a;
    double fx = put_b ? p->ax_m : p->bx_m, fy = put_b ? p->ay_m : p->by_m;
    double tx = put_b ? p->bx_m : p->ax_m, ty = put_b ? p->by_m : p->ay_m;
    double turn = put_b ? angle + p->free_angle_rad : -angle - p->free_angle_rad;
    double x = fx, y = fy, phi = turn;
    if (from != FW_GROUND) {
        double c = cos(q[3 * from + 2]), s = sin(q[3 * from + 2]);
        x = q[3 * from] + c * fx - s * fy;
        y = q[3 * from + 1] + s * fx + c * fy;
        phi += q[3 * from + 2];
    }
    q[3 * to] = x - cos(phi) * tx + sin(phi) * ty;
    q[3 * to + 1] = y - sin(phi) * tx - cos(phi) * ty;
    q[3 * to + 2] = phi;
}

/* bodies from the angles of all pins, outward from the ground */
static void place_all(const fw_mechanism *m, const double *angle, bool *stands, double *q) {
    memset(stands, 0, (size_t)m->nbody * sizeof *stands);
    for (bool more = true; more;) {
        more = false;
        for (int i = 0; i < m->npin; i++) {
            const fw_mechanism_pin *p = &m->pin[i];
            bool a = p->body_a == FW_GROUND || stands[p->body_a];
            bool b = p->body_b == FW_GROUND || stands[p->body_b];
            if (a == b) continue;
            place(p, angle[i], a, q);
            stands[a ? p->body_b : p->body_a] = true;
            more = true;
        }
    }
}

/* Asked pose, or where that is out of reach the last reachable one on the straight way to it from
   rest: the first failure among 64 equal parts, then halving to 1e-12 of the way.
   in: displacement (m, m, rad); out: six angles, q; exact up to rounding, cost below 200 inverse
   solutions of 1 us each. Test: test_live_pose.c (forward kinematics, joints closed, random
   poses). */
static fw_status six_bar(fw_arena *arena, const fw_mechanism *m, const double asked[3],
                         fw_plan_posed *out) {
    enum { PARTS = 64, HALVINGS = 34 };
    double angle[FW_SIX], share = 1.0;
    int leg = 0, blamed = 0;
    bool *stands = fw_arena_array(arena, bool, (size_t)m->nbody);
    FW_NEED(stands);
    out->reachable = fw_workspace_six_bar_inverse(m, asked[0], asked[1], asked[2], angle, &blamed);
    if (!out->reachable) {
        double low = 0.0, high = 1.0;
        for (int i = 1; i <= PARTS; i++) {
            double s = (double)i / PARTS;
            high = s;
            if (!fw_workspace_six_bar_inverse(m, s * asked[0], s * asked[1], s * asked[2], angle,
                                              &leg))
                break;
            low = s;
        }
        for (int i = 0; i < HALVINGS; i++) {
            double s = 0.5 * (low + high);
            if (fw_workspace_six_bar_inverse(m, s * asked[0], s * asked[1], s * asked[2], angle,
                                             &leg))
                low = s;
            else
                high = s, blamed = leg;
        }
        share = low;
        if (!fw_workspace_six_bar_inverse(m, share * asked[0], share * asked[1], share * asked[2],
                                          angle, &leg))
            return FW_SOLVER;
        out->reason = fw_arena_printf(arena, "leg %s-%s-%s is stretched or folded there",
                                      m->pin[blamed ? 5 : 0].id, m->pin[blamed ? 4 : 1].id,
                                      m->pin[blamed ? 3 : 2].id);
        FW_NEED(out->reason);
    }
    memcpy(out->angle_rad, angle, sizeof angle);
    place_all(m, angle, stands, out->q);
    for (int k = 0; k < 3; k++)
        out->at[k] = share * asked[k];
    out->closed_form = true;
    out->share = share;
    return FW_OK;
}

/* ---- anything else ---- */

static const double heavy = 1e6;

/* bodies that weigh alike but the one that is held, which may turn where its angle is not asked
   for; drivers let go */
static fw_status held(fw_arena *arena, const fw_mechanism *from, int body, bool turns, double size,
                      fw_mechanism *to) {
    *to = *from;
    to->ndriver = 0;
    FW_NEED(to->body = fw_arena_array(arena, fw_mechanism_mass, (size_t)from->nbody));
    for (int b = 0; b < from->nbody; b++) {
        to->body[b] = from->body[b];
        to->body[b].mass_kg = b == body ? heavy : 1.0;
        to->body[b].inertia_kg_m2 = (turns ? 1.0 : to->body[b].mass_kg) * size * size / 12.0;
    }
    return FW_OK;
}

static double apart(const double *a, const double *b, bool turns, double size) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]) / size, turns ? 0.0 : a[2] - b[2]);
}

/* closes all joints with `body` at `target`, or as near to it as they allow; q is start and result.
   The closed pose nearest in the mass metric leaves a heavy body behind its place by about
   1/heavy of what the others have to move: aimed so much farther, it stands there. */
static fw_status close_at(fw_arena *arena, const fw_mechanism *m, int body, const double target[3],
                          bool turns, double size, double *q) {
    double aim[3] = {target[0], target[1], target[2]}, moved;
    if (turns) aim[2] = q[3 * body + 2];
    for (int round = 0; round < 4; round++) {
        fw_mark mark = fw_arena_mark(arena);
        fw_diags quiet = fw_diags_new(arena);
        memcpy(q + (size_t)3 * (size_t)body, aim, sizeof aim);
        fw_status status = fw_assembly_assemble(arena, m, q, &moved, &quiet);
        fw_arena_rewind(arena, mark);
        FW_TRY(status);
        double off = apart(q + (size_t)3 * (size_t)body, target, turns, size);
        if (off < 1e-13 || off > 1e-3) break; /* there, or as near as it goes */
        for (int k = 0; k < 2 + !turns; k++)
            aim[k] += target[k] - q[3 * body + k];
    }
    return FW_OK;
}

/* In steps of a twentieth of the mechanism or a tenth of a radian, so that it stays on its branch.
   in: displacement of `body` from rest (m, m, rad), start (3 nbody) or NULL; out: q with joints
   closed to round-off, at[] as asked to 1e-7 of the size (what the search for the nearest pose
   leaves) or `reachable` false: then the pose nearest in the mass metric. Cost: some 50 us per step
   and body. Source: docs/theory/assembly.md. Test: test_live_pose.c (against the closed form of the
   six-bar, four-bar against its coupler curve). */
static fw_status closing(fw_arena *arena, const fw_mechanism *m, int body, const double asked[3],
                         const double *from, fw_plan_posed *out) {
    enum { STEPS_MOST = 40 };
    fw_mechanism free_mechanism;
    double size = size_of(m), *rest, target[3], start[3];
    size_t n = 3 * (size_t)m->nbody;
    FW_NEED(rest = fw_arena_array(arena, double, n));
    rest_of(m, rest);
    memcpy(out->q, from ? from : rest, n * sizeof *rest);
    bool turns = isnan(asked[2]);
    FW_TRY(held(arena, m, body, turns, size, &free_mechanism));
    const double *at_rest = rest + (size_t)3 * (size_t)body,
                 *now = out->q + (size_t)3 * (size_t)body;
    double way[3], far = 0.0;
    for (int k = 0; k < 3; k++) {
        double most = k < 2 ? 20.0 * size : 100.0; /* beyond, it is out of reach all the same */
        start[k] = now[k];
        way[k] = at_rest[k] + fmax(-most, fmin(most, asked[k])) - start[k];
        if (k == 2 && turns) way[k] = 0.0;
    }
    far = fmax(hypot(way[0], way[1]) / (0.05 * size), fabs(way[2]) / 0.1);
    int steps = (int)fmin(STEPS_MOST, fmax(1.0, ceil(far)));
    for (int i = 1; i <= steps; i++) {
        for (int k = 0; k < 3; k++)
            target[k] = start[k] + way[k] * i / steps;
        FW_TRY(close_at(arena, &free_mechanism, body, target, turns, size, out->q));
    }
    angles_of(m, out->q, out->angle_rad);
    for (int k = 0; k < 3; k++)
        out->at[k] = now[k] - at_rest[k];
    out->reachable = apart(out->at, asked, turns, size) < 1e-7;
    out->share = (double)NAN;
    if (!out->reachable)
        out->reason =
            "the joints do not let the body go there; shown is the nearest pose that they "
            "allow";
    return FW_OK;
}

fw_status fw_plan_pose_solve(fw_arena *arena, const fw_mechanism *m, int body,
                             const double asked[3], const double *from, fw_plan_posed *out) {
    *out = (fw_plan_posed){0};
    FW_NEED(out->q = fw_arena_array(arena, double, 3 * (size_t)m->nbody));
    FW_NEED(out->angle_rad = fw_arena_array(arena, double, (size_t)m->npin));
    if (body < 0 || body >= m->nbody) return FW_USAGE;
    /* further joints would take freedom from the platform */
    bool plain = m->device->six_bar && m->npin == FW_SIX && m->njoint == 0 && m->nbody == 5;
    const double upright[3] = {asked[0], asked[1], isnan(asked[2]) ? 0.0 : asked[2]};
    if (plain && body == 2) return six_bar(arena, m, upright, out);
    return closing(arena, m, body, asked, from, out);
}
