/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The position problem with everything that is known about its result. */
#include "assembly/assembly.h"
#include "base/constants.h"
#include "assembly/closure.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- from any guess ---- */

typedef struct solved {
    double *q; /* (3 nbody) SI; the least mismatch where there is no assembly */
    int iterations, restarts;
} solved;

/* The position problem from any guess: descent, restarts, the pose nearest to the guess, a polish
   to round-off. */

/* a body that weighs as much as every other and has its arm as radius of gyration: what restarts
   move with, so that mass ratios do not steer the search */
static fw_status even_masses(fw_arena *arena, const fw_mechanism *from, double length_m,
                             fw_mechanism *to) {
    *to = *from;
    FW_NEED(to->body = fw_arena_array(arena, fw_mechanism_mass, (size_t)from->nbody));
    double mass = 0;
    for (int b = 0; b < from->nbody; b++)
        mass += from->body[b].mass_kg / from->nbody;
    for (int b = 0; b < from->nbody; b++) {
        to->body[b] = from->body[b];
        to->body[b].mass_kg = mass;
        to->body[b].inertia_kg_m2 = mass * length_m * length_m / 12;
    }
    return FW_OK;
}

/* the largest |Psi| of a joint */
static double residual(fw_assembly_closure *c) {
    return fw_multibody_residual(c->system, fw_multibody_pose_at(c->system, 0, c->u), c->psi);
}

/* points that a rod joins must not coincide, or it has no direction to start with */
static void part_rods(fw_assembly_closure *c, const fw_multibody_pose *pose) {
    const fw_multibody_model *m = c->model;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        double d[2], e[2], n[2];
        if (b->rows != FW_ROWS_ROD) continue;
        fw_multibody_frame(m, pose, i, d, e, n);
        if (hypot(d[0], d[1]) > 1e-9) continue;
        int body = b->b < m->nbody ? b->b : b->a;
        double angle = 2 * FW_PI * fw_assembly_spread(7, (unsigned)i);
        c->u[3 * body] += 1e-4 * cos(angle);
        c->u[3 * body + 1] += 1e-4 * sin(angle);
    }
}

/* from other starts; on success c->u is closed. `search` stays for the explanation of a failure:
   its least mismatch is in r->best. Lengths of both models differ by a factor only. */
static fw_status try_restarts(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                              fw_diags *diags, fw_assembly_closure *c, fw_assembly_closure *search,
                              fw_assembly_restart *r, bool *good) {
    fw_mechanism even;
    double length = c->model->scale.length_m;
    FW_TRY(even_masses(arena, mechanism, length, &even));
    FW_TRY(fw_assembly_closure_new(arena, &even, q, diags, search));
    const fw_multibody_model *model = search->model;
    FW_TRY(fw_assembly_restart_new(arena, model, r));
    search->left = 1000 + (long)(2e8 / model->nblock);
    *good = fw_assembly_restart_close(r, search);
    c->iterations += search->iterations;
    for (int i = 0; i < model->nq; i++)
        c->u[i] = search->u[i] * (i % 3 == 2 ? 1 : model->scale.length_m / length);
    return FW_OK;
}

static const double usable = 1e-9; /* scaled gap: coordinates with fewer digits are of no use */

/* a body a million sizes away, or turned ten thousand times, has no digits left for its joints */
static fw_status too_far(const fw_mechanism *mechanism, const double *guess, fw_diags *diags) {
    int far = 0;
    double most = -1;
    char x[32], y[32], phi[32];
    for (int b = 0; b < mechanism->nbody; b++) {
        const double *q = guess + 3 * b;
        double size = fmax(hypot(q[0], q[1]), fabs(q[2]));
        if (size > most) most = size, far = b;
    }
    const char *id = mechanism->body[far].id;
    return fw_diag_error(diags, 105, (fw_place){0},
                         "the poses to assemble are too far away for double precision: %s%s "
                         "stands at x = %s m, y = %s m, phi = %s rad; check units",
                         FW_NAMED("body", fw_text_name(id)),
                         fw_number_text(x, sizeof x, guess[3 * far], 4),
                         fw_number_text(y, sizeof y, guess[3 * far + 1], 4),
                         fw_number_text(phi, sizeof phi, guess[3 * far + 2], 4));
}

/* the result in SI, polished by a model that stands there: its round-off is that of the mechanism,
   not of a guess far away */
static fw_status polish(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                        fw_diags *diags, const fw_assembly_closure *from, double *q) {
    fw_assembly_closure c;
    double length = from->model->scale.length_m;
    for (int i = 0; i < from->model->nq; i++)
        q[i] = guess[i] + (i % 3 == 2 ? 1 : length) * from->u[i];
    FW_TRY(fw_assembly_closure_new(arena, mechanism, q, diags, &c));
    fw_assembly_closure_descend(&c, 30); /* it was closed: what is left is round-off */
    if (!(residual(&c) <= usable)) return too_far(mechanism, guess, diags);
    for (int i = 0; i < c.model->nq; i++)
        q[i] += (i % 3 == 2 ? 1 : length) * c.u[i];
    return FW_OK;
}

/* why not, and the least mismatch in SI */
static fw_status give_up(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                         fw_diags *diags, fw_assembly_closure *search, fw_assembly_restart *r,
                         solved *out) {
    fw_status status = fw_assembly_closure_explain(arena, mechanism, search, r, diags);
    double length = search->model->scale.length_m;
    for (int i = 0; i < search->model->nq; i++)
        out->q[i] = guess[i] + (i % 3 == 2 ? 1 : length) * search->u[i];
    return status;
}

static fw_status close_up(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                          fw_diags *diags, solved *out) {
    fw_assembly_closure c, search;
    fw_assembly_restart r = {.restarts = 0};
    int *group;
    bool good = true;
    FW_TRY(fw_assembly_closure_new(arena, mechanism, guess, diags, &c));
    if (!(residual(&c) < 1e150)) /* its square must be a number */
        return too_far(mechanism, guess, diags);
    if (fw_assembly_closure_descend(&c, 0)) /* the guess is closed: nothing moves */
        return residual(&c) <= usable ? FW_OK : too_far(mechanism, guess, diags);
    part_rods(&c, fw_multibody_pose_at(c.system, 0, c.u));
    if (!fw_assembly_closure_descend(&c, 500)) {
        FW_TRY(try_restarts(arena, mechanism, guess, diags, &c, &search, &r, &good));
        out->restarts = r.restarts;
        out->iterations = (int)c.iterations;
        if (fw_arena_cancelled(arena)) return FW_CANCELLED;
        c.left = 1000;
        if (!good || !fw_assembly_closure_descend(&c, 100))
            return give_up(arena, mechanism, guess, diags, &search, &r, out);
    }
    FW_NEED(group = fw_arena_array(arena, int, (size_t)c.model->nbody + 1));
    c.left = 5000;
    fw_assembly_closure_unwind(&c, group);
    fw_assembly_closure_nearest(&c);
    out->iterations = (int)c.iterations;
    return polish(arena, mechanism, guess, diags, &c, out->q);
}

/* Psi(q, 0) = 0 from guess (3 nbody) SI; FW_SOLVER with its reason */
static fw_status close_from(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                            fw_diags *diags, solved *out) {
    size_t n = 3 * (size_t)mechanism->nbody;
    *out = (solved){0};
    for (size_t i = 0; i < n; i++)
        if (!isfinite(guess[i]))
            return fw_diag_error(diags, 105, (fw_place){0},
                                 "the position to assemble is not finite");
    FW_NEED(out->q = fw_arena_array(arena, double, n));
    memcpy(out->q, guess, n * sizeof(double));
    if (mechanism->nbody == 0 || mechanism->npin + mechanism->njoint == 0) return FW_OK;
    return close_up(arena, mechanism, guess, diags, out);
}

fw_status fw_assembly_assemble(fw_arena *arena, const fw_mechanism *mechanism, double *q,
                               double *moved_m, fw_diags *diags) {
    solved found;
    *moved_m = 0;
    FW_TRY(close_from(arena, mechanism, q, diags, &found));
    for (int b = 0; b < mechanism->nbody; b++)
        *moved_m =
            fmax(*moved_m, hypot(found.q[3 * b] - q[3 * b], found.q[3 * b + 1] - q[3 * b + 1]));
    memcpy(q, found.q, 3 * (size_t)mechanism->nbody * sizeof(double));
    return FW_OK;
}

/* the mechanism without the pins for which elements stand */
static fw_status without_released(fw_arena *arena, const fw_mechanism *from, const bool *released,
                                  fw_mechanism *to) {
    *to = *from;
    to->npin = 0;
    FW_NEED(to->pin = fw_arena_array(arena, fw_mechanism_pin, (size_t)from->npin));
    for (int i = 0; i < from->npin; i++)
        if (!released[i]) to->pin[to->npin++] = from->pin[i];
    return FW_OK;
}

/* In and out: q SI. Least squares of all gaps, then the joints that are left are closed from there. Exact where all close,
   as fw_assembly_assemble is. Test: test_start_velocity.c open_pins_begin_at_rest */
fw_status fw_assembly_assemble_giving(fw_arena *arena, const fw_mechanism *mechanism,
                                      const bool *released, double *q, double *moved_m,
                                      fw_diags *diags) {
    const int n = 3 * mechanism->nbody;
    bool gives = false, finite = true;
    for (int i = 0; i < mechanism->npin; i++)
        gives = gives || (released && released[i]);
    for (int i = 0; i < n; i++)
        finite = finite && isfinite(q[i]);
    if (!gives || !finite) return fw_assembly_assemble(arena, mechanism, q, moved_m, diags);
    fw_assembly_closure c;
    FW_TRY(fw_assembly_closure_new(arena, mechanism, q, diags, &c));
    if (fw_assembly_closure_descend(&c, 500) || !(residual(&c) < 1e150))
        return fw_assembly_assemble(arena, mechanism, q, moved_m, diags);
    fw_mechanism left;
    double *open, most = 0;
    FW_NEED(open = fw_arena_array(arena, double, (size_t)n));
    for (int i = 0; i < n; i++)
        open[i] = q[i] + (i % 3 == 2 ? 1 : c.model->scale.length_m) * c.u[i];
    FW_TRY(without_released(arena, mechanism, released, &left));
    FW_TRY(fw_assembly_assemble(arena, &left, open, moved_m, diags));
    for (int b = 0; b < mechanism->nbody; b++)
        most = fmax(most, hypot(open[3 * b] - q[3 * b], open[3 * b + 1] - q[3 * b + 1]));
    memcpy(q, open, (size_t)n * sizeof(double));
    *moved_m = most;
    return FW_OK;
}

/* ---- what there is to say of it ---- */

static fw_geometry_vec2 place(const double *q, int body, double x, double y) {
    if (body == FW_GROUND) return (fw_geometry_vec2){x, y};
    double c = cos(q[3 * body + 2]), s = sin(q[3 * body + 2]);
    return (fw_geometry_vec2){q[3 * body] + c * x - s * y, q[3 * body + 1] + s * x + c * y};
}

/* largest gap in m; gaps of angles count with the scene's length. `gap` may be NULL. */
static fw_status find_gaps(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                           fw_diags *diags, fw_assembly_joint_gap *gap, double *largest) {
    fw_assembly_closure c;
    *largest = 0;
    if (mechanism->npin + mechanism->njoint == 0) return FW_OK;
    FW_TRY(fw_assembly_closure_new(arena, mechanism, q, diags, &c)); /* leaves psi */
    const fw_multibody_model *m = c.model;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        double metres, radian;
        fw_assembly_block_gap(m, i, c.psi, &metres, &radian);
        *largest = fmax(*largest, fmax(metres, radian * m->scale.length_m));
        if (!gap) continue;
        int to = b->pin != FW_NONE     ? b->pin
                 : b->joint != FW_NONE ? m->npin + b->joint
                                       : m->npin + m->njoint + b->driver;
        gap[to].gap_m = fmax(gap[to].gap_m, metres);
        gap[to].gap_rad = fmax(gap[to].gap_rad, radian);
    }
    return FW_OK;
}

static void describe_gaps(const fw_mechanism *m, const double *q, fw_assembly_joint_gap *gap) {
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        fw_geometry_vec2 a = place(q, p->body_a, p->ax_m, p->ay_m),
                         b = place(q, p->body_b, p->bx_m, p->by_m);
        gap[i] = (fw_assembly_joint_gap){p->id, 0, 0, {a.x, b.x}, {a.y, b.y}, i, FW_NONE, FW_NONE};
    }
    gap += m->npin;
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        fw_geometry_vec2 a = place(q, t->body_a, t->ax_m, t->ay_m),
                         b = place(q, t->body_b, t->bx_m, t->by_m);
        gap[i] = (fw_assembly_joint_gap){t->id, 0, 0, {a.x, b.x}, {a.y, b.y}, FW_NONE, i, FW_NONE};
    }
    gap += m->njoint;
    for (int i = 0; i < m->ndriver; i++)
        gap[i] = (fw_assembly_joint_gap){
            .id = m->driver[i].id, .pin = FW_NONE, .joint = FW_NONE, .driver = i};
}

static void movements(const fw_mechanism *m, fw_assembly *a) {
    double sum = 0, mass = 0;
    for (int b = 0; b < m->nbody; b++) {
        const fw_mechanism_mass *body = &m->body[b];
        double dx = a->after[3 * b] - a->before[3 * b];
        double dy = a->after[3 * b + 1] - a->before[3 * b + 1];
        double turn = a->after[3 * b + 2] - a->before[3 * b + 2];
        a->moved_m[b] = hypot(dx, dy);
        a->turned_rad[b] = turn;
        a->most_moved_m = fmax(a->most_moved_m, a->moved_m[b]);
        a->most_turned_rad = fmax(a->most_turned_rad, fabs(turn));
        sum += body->mass_kg * (dx * dx + dy * dy) + body->inertia_kg_m2 * turn * turn;
        mass += body->mass_kg;
    }
    a->distance_m = mass > 0 ? sqrt(sum / mass) : 0;
}

static fw_status prepare(fw_arena *arena, const fw_mechanism *m, const double *guess,
                         fw_diags *diags, fw_assembly **assembly) {
    size_t n = (size_t)m->nbody;
    fw_assembly *a = fw_arena_one(arena, fw_assembly);
    FW_NEED(a);
    a->nbody = m->nbody;
    a->ngap = m->npin + m->njoint + m->ndriver;
    FW_NEED(a->before = fw_arena_array(arena, double, 3 * n));
    FW_NEED(a->after = fw_arena_array(arena, double, 3 * n));
    FW_NEED(a->moved_m = fw_arena_array(arena, double, n));
    FW_NEED(a->turned_rad = fw_arena_array(arena, double, n));
    FW_NEED(a->gap = fw_arena_array(arena, fw_assembly_joint_gap, (size_t)a->ngap));
    memcpy(a->before, guess, 3 * n * sizeof *guess);
    memcpy(a->after, guess, 3 * n * sizeof *guess);
    for (size_t i = 0; i < 3 * n; i++)
        if (!isfinite(guess[i])) return FW_OK; /* said by the search */
    describe_gaps(m, guess, a->gap);
    FW_TRY(find_gaps(arena, m, guess, diags, a->gap, &a->gap_before_m));
    *assembly = a;
    return FW_OK;
}

fw_status fw_assembly_solve(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                            fw_diags *diags, fw_assembly **assembly) {
    solved found;
    size_t n = 3 * (size_t)mechanism->nbody;
    *assembly = NULL;
    FW_TRY(prepare(arena, mechanism, guess, diags, assembly));
    fw_status status = close_from(arena, mechanism, guess, diags, &found);
    if (status != FW_OK && (status != FW_SOLVER || !*assembly)) return status;
    fw_assembly *a = *assembly;
    memcpy(a->after, found.q, n * sizeof(double));
    a->iterations = found.iterations;
    a->restarts = found.restarts;
    movements(mechanism, a);
    FW_TRY(find_gaps(arena, mechanism, a->after, diags, NULL, &a->gap_after_m));
    if (status != FW_OK) return status;
    FW_TRY(fw_assembly_rank(arena, mechanism, a->after, diags, &a->rank));
    FW_TRY(fw_assembly_elbows_find(arena, mechanism, &a->elbow, &a->nelbow));
    for (int i = 0; i < a->nelbow; i++) {
        a->elbow[i].guess = fw_assembly_elbow_side(mechanism, a->before, &a->elbow[i]);
        a->elbow[i].found = fw_assembly_elbow_side(mechanism, a->after, &a->elbow[i]);
    }
    return fw_assembly_alternatives_find(arena, mechanism, diags, a);
}

/* of the largest part: arms of joints, lengths of rods, distances between bodies */
static double size_of(const fw_mechanism *m) {
    double size = DBL_MIN;
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        size = fmax(size, fmax(hypot(p->ax_m, p->ay_m), hypot(p->bx_m, p->by_m)));
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        size = fmax(size, fmax(hypot(t->ax_m, t->ay_m), hypot(t->bx_m, t->by_m)));
        size = fmax(size, t->kind == FW_JOINT_DISTANCE ? t->length_m : 0);
    }
    for (int b = 1; b < m->nbody; b++)
        size = fmax(size, hypot(m->body[b].x_m - m->body[0].x_m, m->body[b].y_m - m->body[0].y_m));
    return size;
}

/* "3 mm and 4 deg": the angle where it counts, of lengths of `size` */
static char *amount(char *to, size_t n, double metres, double radian, double size,
                    fw_assembly_length_unit unit) {
    char number[48];
    bool turns = radian * size > 1e-6 * metres, shifts = metres > 1e-6 * radian * size;
    fw_assembly_length_text(to, n, metres, unit);
    if (!turns) return to;
    fw_number_text(number, sizeof number, radian * 180 / FW_PI, 4);
    size_t at = shifts ? strlen(to) : 0;
    snprintf(to + at, n - at, "%s%s deg", shifts ? " and " : "", number);
    return to;
}

/* a guess that was far off may have led to another assembly than was meant: that is unreliable */
static void report_moved(const fw_mechanism *m, const fw_assembly_joint_gap *gap, const double *q,
                         double size, fw_diags *diags) {
    double moved = 0, turned = 0, open = 0, askew = 0;
    for (int b = 0; b < m->nbody; b++) {
        moved = fmax(moved, hypot(q[3 * b] - m->body[b].x_m, q[3 * b + 1] - m->body[b].y_m));
        turned = fmax(turned, fabs(q[3 * b + 2] - m->body[b].phi_rad));
    }
    for (int i = 0; i < m->npin + m->njoint + m->ndriver; i++)
        open = fmax(open, gap[i].gap_m), askew = fmax(askew, gap[i].gap_rad);
    const fw_assembly_length_unit unit =
        fw_assembly_length_unit_for(fmax(open, moved), fmax(open, moved));
    char before[96], way[96], text[400];
    const fw_place place = {.file = m->device ? m->device->file : NULL};
    snprintf(text, sizeof text,
             "the poses that the description states leave joints open by up to %s; they are "
             "used as an initial guess, and bodies were moved by up to %s to close the joints; "
             "`flexwright assemble` lists the closed poses",
             amount(before, sizeof before, open, askew, size, unit),
             amount(way, sizeof way, moved, turned, size, unit));
    double most = fmax(moved, turned * size);
    if (most > fw_assembly_another_start * size)
        fw_diag_unreliable(diags, 115, place, "%s; another branch may have been meant", text);
    else if (most > 1e-6 * size)
        fw_diag_warning(diags, 115, place, "%s", text);
    else
        fw_diag_note(diags, 115, place, "%s", text);
}

fw_status fw_assembly_assembled(fw_arena *arena, const fw_mechanism *mechanism, fw_diags *diags,
                                const fw_mechanism **assembled, double *moved_m) {
    size_t n = 3 * (size_t)mechanism->nbody;
    double *q, moved = 0, largest, size = size_of(mechanism);
    size_t joints = (size_t)(mechanism->npin + mechanism->njoint + mechanism->ndriver);
    fw_assembly_joint_gap *gap = fw_arena_array(arena, fw_assembly_joint_gap, joints);
    FW_NEED(gap);
    *assembled = mechanism;
    if (moved_m) *moved_m = 0;
    FW_NEED(q = fw_arena_array(arena, double, n));
    for (int b = 0; b < mechanism->nbody; b++) {
        const fw_mechanism_mass *body = &mechanism->body[b];
        q[3 * b] = body->x_m, q[3 * b + 1] = body->y_m, q[3 * b + 2] = body->phi_rad;
    }
    FW_TRY(find_gaps(arena, mechanism, q, diags, gap, &largest));
    if (largest <= 1e-9 * size) return FW_OK;
    FW_TRY(fw_assembly_assemble(arena, mechanism, q, &moved, diags));
    if (moved_m) *moved_m = moved;
    fw_mechanism *copy = fw_arena_one(arena, fw_mechanism);
    FW_NEED(copy);
    *copy = *mechanism;
    FW_NEED(copy->body = fw_arena_array(arena, fw_mechanism_mass, (size_t)mechanism->nbody));
    for (int b = 0; b < mechanism->nbody; b++) {
        copy->body[b] = mechanism->body[b];
        copy->body[b].x_m = q[3 * b], copy->body[b].y_m = q[3 * b + 1];
        copy->body[b].phi_rad = q[3 * b + 2];
    }
    *assembled = copy;
    report_moved(mechanism, gap, q, size, diags);
    return FW_OK;
}
