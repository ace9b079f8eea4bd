/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report.h"
#include "base/constants.h"
#include <math.h>
#include <string.h>

static double degrees(double rad) {
    return rad * 180.0 / FW_PI;
}

/* um for a device, mm and m for what is larger */
static const char *unit_of(double size_m, double *factor) {
    *factor = size_m < 0.02 ? 1e6 : size_m < 20 ? 1e3 : 1;
    return size_m < 0.02 ? "um" : size_m < 20 ? "mm" : "m";
}

static double extent(const fw_report_assembly *in) {
    double most = 0;
    for (int i = 0; i < in->assembly->ngap; i++)
        for (int k = 0; k < 2; k++)
            most = fmax(most, hypot(in->assembly->gap[i].x_m[k], in->assembly->gap[i].y_m[k]));
    return most;
}

static void length(fw_text *out, double metres, double size_m) {
    double factor;
    const char *unit = unit_of(size_m, &factor);
    fw_text_number(out, metres * factor, 4);
    fw_text_printf(out, " %s", unit);
}

static void joint_table(const fw_report_assembly *in, double size, fw_text *out) {
    const fw_assembly *a = in->assembly;
    double factor, least = 1e-12 * size;
    const char *unit = unit_of(size, &factor);
    bool any = false;
    for (int i = 0; i < a->ngap; i++) {
        const fw_assembly_joint_gap *g = &a->gap[i];
        if (g->gap_m <= least && g->gap_rad <= 1e-12) continue;
        if (!any) fw_text_printf(out, "\n  joint        open in the guess by\n");
        any = true;
        fw_text_printf(out, "  %-10s", fw_text_name(g->id));
        if (g->gap_m > least) fw_text_real(out, "%12.4f ", g->gap_m * factor);
        if (g->gap_m > least) fw_text_add(out, unit);
        if (g->gap_rad > 1e-12) fw_text_real(out, "  %10.4f deg", degrees(g->gap_rad));
        fw_text_add(out, "\n");
    }
}

static void body_table(const fw_report_assembly *in, double size, fw_text *out) {
    const fw_assembly *a = in->assembly;
    double factor;
    const char *unit = unit_of(size, &factor);
    fw_text_printf(
        out, "\n  body          x %-2s         y %-2s      phi deg     moved %-2s   turned deg\n",
        unit, unit, unit);
    for (int b = 0; b < a->nbody; b++) {
        fw_text_printf(out, "  %-8s", fw_text_name(in->mechanism->body[b].id));
        double frame[3];
        fw_mechanism_frame_pose(&in->mechanism->body[b], a->after + 3 * b, frame);
        fw_text_real(out, "%12.4f", frame[0] * factor);
        fw_text_real(out, "%13.4f", frame[1] * factor);
        fw_text_real(out, "%13.5f", degrees(frame[2]));
        fw_text_real(out, "%13.4f", a->moved_m[b] * factor);
        fw_text_real(out, "%13.5f\n", degrees(a->turned_rad[b]));
    }
}

static void freedom(const fw_assembly_rank_result *r, fw_text *out) {
    fw_text_printf(out, "\n%d degree%s of freedom: %d unknowns, %d constraint rows", r->dof,
                   r->dof == 1 ? "" : "s", r->unknowns, r->rows);
    if (!r->known) {
        fw_text_printf(out, " (counted: beyond %d unknowns no rank is computed)\n", FW_RANK_MOST);
        return;
    }
    fw_text_printf(out, " of rank %d", r->rank);
    fw_text_real(out, " (singular values: smallest kept %.2g", r->kept);
    if (r->rank < r->rows) fw_text_real(out, ", largest dropped %.1e", r->dropped);
    fw_text_add(out, " of the largest)\n");
    if (!r->clear)
        fw_text_add(out, "  the gap between them is small: the position is close to a singular "
                         "one, and the count may be that of the singular position\n");
    if (r->nredundant == 0) return;
    fw_text_add(out, "  redundant here, because other joints already impose it:");
    for (int i = 0; i < r->nredundant; i++)
        fw_text_printf(out, " %s", r->redundant[i]);
    fw_text_add(out, "\n");
}

static void branches(const fw_assembly *a, fw_text *out) {
    int same = 0;
    for (int i = 0; i < a->nelbow; i++) {
        const fw_assembly_elbow *e = &a->elbow[i];
        if (e->guess == e->found) {
            same++;
            continue;
        }
        fw_text_printf(out, "branch: elbow at %s is %s\n", e->id,
                       e->found == 0   ? "stretched flat"
                       : e->guess == 0 ? "flat in the guess, and had to take one side"
                                       : "on the other side than in the guess");
    }
    if (same == a->nelbow && same > 0)
        fw_text_printf(out, "branch: %s of the guess\n",
                       same == 1 ? "the elbow is on the side" : "all elbows are on the side");
}

static void alternatives(const fw_report_assembly *in, double size, fw_text *out) {
    const fw_assembly *a = in->assembly;
    if (a->nelbow == 0) return;
    if (a->nalternative == 0) {
        fw_text_add(out, "no other assembly was found by mirroring elbows\n");
        return;
    }
    fw_text_printf(out, "other assemblies%s, by their distance from the guess (this one: ",
                   a->more ? " (the first that were found)" : "");
    length(out, a->distance_m, size);
    fw_text_add(out, ")\n");
    for (int i = 0; i < a->nalternative; i++) {
        fw_text_add(out, "  ");
        length(out, a->alternative[i].distance_m, size);
        fw_text_add(out, "  with other sides at");
        bool any = false;
        for (int e = 0; e < a->nelbow; e++)
            if (a->alternative[i].side[e] != a->elbow[e].found)
                fw_text_printf(out, " %s", a->elbow[e].id), any = true;
        if (!any) fw_text_add(out, " no elbow");
        fw_text_add(out, a->alternative[i].distance_m < a->distance_m * (1 - 1e-9)
                             ? "  (nearer: start from its poses, in --json, to get it)\n"
                             : "\n");
    }
}

/* ---- motion ---- */

static void coordinates(const fw_report_assembly *in, fw_text *out) {
    const fw_assembly_coordinate_choice *c = &in->kinematics->independent;
    if (c->count == 0) return;
    fw_text_printf(out, "independent coordinates %s: %s, condition ",
                   c->automatic ? "by pivoting" : "as asked", c->text);
    fw_text_number(out, c->condition, 3);
    if (c->better) {
        fw_text_printf(out, "; %s would have ", c->better);
        fw_text_number(out, c->better_condition, 3);
    }
    fw_text_add(out, "\n");
}

/* what is below 1e-12 of the largest of its kind is round-off and reads 0; rotations and torques
   are compared as lengths and forces at the mechanism's size */
static double clean(double value, double most) {
    return fabs(value) <= 1e-12 * most ? 0 : value;
}

static double largest_motion(const double *all, int nbody, double size) {
    double most = 0;
    for (int i = 0; i < 3 * nbody; i++)
        most = fmax(most, fabs(all[i]) * (i % 3 == 2 ? size : 1));
    return most;
}

static double largest_force(const fw_assembly_kinematics *k) {
    double most = 0;
    for (int i = 0; i < 2 * k->npin; i++)
        most = fmax(most, fabs(k->reaction_N[i]));
    for (int i = 0; i < 3 * k->njoint; i++)
        if (i % 3 != 2) most = fmax(most, fabs(k->joint_N[i]));
    return most;
}

static void velocities(const fw_report_assembly *in, double size, fw_text *out) {
    const fw_mechanism *m = in->mechanism;
    const fw_assembly_kinematics *k = in->kinematics;
    double factor;
    const char *unit = unit_of(size, &factor);
    const double most[2] = {largest_motion(k->v, m->nbody, size),
                            largest_motion(k->a, m->nbody, size)};
    fw_text_printf(out,
                   "\n  body        vx %s/s     vy %s/s  omega rad/s     ax %s/s2     ay %s/s2  "
                   "alpha rad/s2\n",
                   unit, unit, unit, unit);
    for (int b = 0; b < m->nbody; b++) {
        double v[3], a[3], phi = in->assembly->after[3 * b + 2];
        fw_mechanism_frame_velocity(&m->body[b], phi, k->v + 3 * b, v);
        fw_mechanism_frame_acceleration(&m->body[b], phi, k->v[3 * b + 2], k->a + 3 * b, a);
        fw_text_printf(out, "  %-8s", fw_text_name(m->body[b].id));
        for (int c = 0; c < 6; c++) {
            bool turns = c % 3 == 2;
            double value = c < 3 ? v[c] : a[c - 3];
            value = clean(value, most[c / 3] / (turns ? size : 1));
            fw_text_real(out, "%13.5g", value * (turns ? 1 : factor));
        }
        fw_text_add(out, "\n");
    }
}

static void force(fw_text *out, double value, double most, const char *unit) {
    fw_text_real(out, "%13.5g ", clean(value, most));
    fw_text_add(out, unit);
}

static void forces(const fw_report_assembly *in, double size, fw_text *out) {
    static const char *const axis[] = {"x", "y", "phi"};
    const fw_mechanism *m = in->mechanism;
    const fw_assembly_kinematics *k = in->kinematics;
    double most = largest_force(k);
    fw_text_printf(out, "\n  joint force on its second body%s%s%s\n",
                   in->scene ? ", loads of scene " : "",
                   in->scene ? fw_text_name(in->scene->name) : "",
                   k->unique ? "" : "; redundant joints share it, the least forces are shown");
    for (int i = 0; i < m->npin; i++) {
        fw_text_printf(out, "  %-8s", fw_text_name(m->pin[i].id));
        force(out, k->reaction_N[2 * i], most, "N");
        force(out, k->reaction_N[2 * i + 1], most, "N\n");
    }
    for (int i = 0; i < m->njoint; i++) {
        fw_text_printf(out, "  %-8s", fw_text_name(m->joint[i].id));
        force(out, k->joint_N[3 * i], most, "N");
        force(out, k->joint_N[3 * i + 1], most, "N");
        force(out, k->joint_N[3 * i + 2], most * size, "N m\n");
    }
    for (int i = 0; i < m->ndriver; i++) {
        bool turns = m->driver[i].revolute != FW_NONE;
        fw_text_printf(out, "  %-8s", fw_text_name(m->driver[i].id));
        force(out, k->driver_N[i], most * (turns ? size : 1), turns ? "N m" : "N");
        fw_text_add(out, " along its coordinate\n");
    }
    for (int i = 0; i < k->independent.count; i++) {
        const fw_assembly_coordinate *c = &k->independent.item[i];
        bool turns = c->axis == 2;
        fw_text_printf(out, "  %s.%s is driven by ", fw_text_name(m->body[c->body].id),
                       axis[c->axis]);
        fw_text_number(out, clean(k->drive[i], most * (turns ? size : 1)), 5);
        fw_text_printf(out, " %s\n", turns ? "N m" : "N");
    }
}

fw_status fw_report_assemble_text(const fw_report_assembly *in, fw_text *out) {
    const fw_assembly *a = in->assembly;
    double size = extent(in);
    fw_text_printf(out, "%s: ", in->device->name);
    if (a->iterations == 0)
        fw_text_add(out, in->device->rounded
                             ? "the description's poses close all joints, after what rounding left "
                               "open was closed as it was read (FW-D132, shown with -v)\n"
                             : "the description's own poses close all joints; nothing was moved\n");
    else {
        fw_text_printf(out, "assembled in %d iterations", a->iterations);
        if (a->restarts) fw_text_printf(out, " and %d restarts", a->restarts);
        fw_text_add(out, "\nlargest open joint: ");
        length(out, a->gap_before_m, size);
        fw_text_add(out, " in the guess, ");
        length(out, a->gap_after_m, size);
        fw_text_add(out, " now; largest movement ");
        length(out, a->most_moved_m, size);
        fw_text_add(out, ", ");
        fw_text_number(out, degrees(a->most_turned_rad), 4);
        fw_text_add(out, " deg\n");
        joint_table(in, size, out);
    }
    body_table(in, size, out);
    freedom(&a->rank, out);
    if (in->kinematics) coordinates(in, out);
    branches(a, out);
    alternatives(in, size, out);
    if (in->kinematics && in->motion) {
        velocities(in, size, out);
        forces(in, size, out);
    }
    return fw_text_end(out);
}
