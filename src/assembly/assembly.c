/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The position problem with everything that is known about its result. */
#include "assembly/assembly.h"
#include "base/constants.h"
#include "assembly/branch.h"
#include "assembly/solved.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

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
    fw_assembly_solved solved;
    size_t n = 3 * (size_t)mechanism->nbody;
    *assembly = NULL;
    FW_TRY(prepare(arena, mechanism, guess, diags, assembly));
    fw_status status = fw_assembly_close(arena, mechanism, guess, diags, &solved);
    if (status != FW_OK && (status != FW_SOLVER || !*assembly)) return status;
    fw_assembly *a = *assembly;
    memcpy(a->after, solved.q, n * sizeof(double));
    a->iterations = solved.iterations;
    a->restarts = solved.restarts;
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

/* a guess that was far off may have led to another assembly than was meant: that is a warning */
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
    if (fmax(moved, turned * size) > 1e-6 * size)
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
