/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria, modes and the certified workspace for a terminal. */
#include "base/constants.h"
#include "report/report.h"
#include "report/report_page.h"
#include "statics/statics.h"
#include <math.h>

static double degrees(double rad) {
    return rad * 180.0 / FW_PI;
}

/* eight decimals in a column; what rounds to zero has no sign */
static void column(fw_text *out, double value) {
    fw_text_real(out, " %14.8f", fabs(value) < 5e-9 ? 0.0 : value);
}

static void rank_line(fw_text *out, int dof, const fw_statics_row_rank *r) {
    fw_text_printf(out, "%d degree%s of freedom; ", dof, dof == 1 ? "" : "s");
    if (r->rows == 0) {
        fw_text_add(out, "no joints\n");
        return;
    }
    fw_text_printf(out, "%d of %d constraint rows are independent", r->rank, r->rows);
    const char *joints = r->joints ? fw_text_few(out->arena, r->joints) : NULL;
    out->failed = out->failed || (r->joints && !joints);
    if (!isfinite(r->kept)) { /* of a large mechanism, whose singular values are not computed */
        if (joints) fw_text_printf(out, ": %s repeat each other", joints);
        fw_text_add(out, "\n");
        return;
    }
    fw_text_add(out, " (singular values from 1 to ");
    fw_text_number(out, r->kept, 2);
    if (joints) {
        fw_text_add(out, ", then ");
        fw_text_number(out, r->dropped, 2);
        fw_text_printf(out, ": %s repeat each other", joints);
    }
    fw_text_add(out, ")\n");
}

/* ---- modes ---- */

static void mode_row(fw_text *out, int number, const fw_statics_mode *m) {
    const double(*e)[2] = m->eigenvalue_per_s;
    fw_text_printf(out, "  %4d ", number);
    if (m->omega_rad_per_s > 0) {
        fw_text_real(out, "%13.6g ", m->f_Hz);
        fw_text_real(out, "%13.6g ", m->omega_rad_per_s);
    } else
        fw_text_printf(out, "%13s %13s ", m->kind == FW_MODE_FREE ? "0" : "-", "-");
    if (isfinite(m->damping_ratio))
        fw_text_real(out, "%10.4g %%  ", 100.0 * m->damping_ratio);
    else
        fw_text_printf(out, "%12s  ", "-");
    fw_text_real(out, "%11.4g", e[0][0]);
    if (e[0][1] > 0)
        fw_text_real(out, " +- %.6g i", e[0][1]);
    else
        fw_text_real(out, ", %.4g", e[1][0]);
    fw_text_printf(out, "   %s", m->bodies);
    if (m->kind != FW_MODE_OSCILLATION)
        fw_text_printf(out, "  (%s)", fw_statics_mode_kind_text(m->kind));
    fw_text_add(out, "\n");
}

static void frequencies_off(const fw_statics_modes *modes, fw_text *out) {
    char all[32], model[32], stiffness[32];
    if (!isfinite(modes->frequency_error)) {
        fw_text_add(out, "what the model of the hinges does to frequencies is not known\n");
        return;
    }
    fw_percent_text(all, sizeof all, modes->frequency_error);
    fw_percent_text(model, sizeof model, modes->ledger.hinge.error);
    fw_percent_text(stiffness, sizeof stiffness, modes->stiffness_error);
    const bool soft = modes->stiffness_error > 0.1;
    fw_text_printf(out,
                   "frequencies off by up to %s %%: the model of the hinges %s %%, and %s %s "
                   "%%, the error of %s%s; bodies that bend make them lower\n",
                   all, model, soft ? "by the root of a stiffness that is off by" : "half of",
                   stiffness,
                   soft ? "flexures against what loads leave of them" : "a flexure's stiffness",
                   modes->stiffness_error > 0 ? "" : " (stated ones are taken as they are)");
}

/* where joints or cables rub, a line for each mode */
static void modes_that_stick(const fw_statics_modes *modes, fw_text *out) {
    bool said = false;
    for (int i = 0; i < modes->count; i++) {
        const fw_statics_mode *m = &modes->mode[i];
        if (isnan(m->stuck_Hz)) continue;
        if (!said)
            fw_text_add(out, "\nfriction: all that rubs slides, or all of it sticks\n"
                             "  mode       from Hz         to Hz\n");
        said = true;
        fw_text_printf(out, "  %4d ", i + 1);
        fw_text_real(out, "%13.6g ", m->slid_Hz);
        if (isfinite(m->stuck_Hz))
            fw_text_real(out, "%13.6g\n", m->stuck_Hz);
        else
            fw_text_add(out, "  does not move\n");
    }
}

/* of rigid plates about the drawn pose, the first ones; scene: whose loads they lack */
static void modes_across(const fw_mechanism_plates *p, const char *scene, fw_text *out) {
    enum { FEW = 6 };
    char error[32];
    if (p->why) {
        fw_text_printf(out, "\nout of the plane: not known: %s\n", p->why);
        return;
    }
    fw_text_printf(
        out,
        "\nout of the plane, of rigid bodies on their flexures (off by up to %s %%, and lower "
        "with bodies that bend):\n  mode          f Hz  body\n",
        (fw_percent_text(error, sizeof error, 0.5 * p->error), error));
    if (scene)
        fw_text_printf(out,
                       "  (as drawn, without the loads of %s%s, which may take a part of them: "
                       "the bands of check have that)\n",
                       FW_NAMED("scene", scene));
    for (int k = 0; k < p->n && k < FEW; k++) {
        bool tilts = false;
        int body = fw_mechanism_plates_mover(p, k, &tilts);
        fw_text_printf(out, "  %4d ", k + 1);
        fw_text_real(out, "%13.6g  ", p->f_Hz[k]);
        fw_text_printf(out, "%s %s\n", fw_text_name(p->mechanism->body[body].id),
                       tilts ? "tilts" : "goes up and down");
    }
}

fw_status fw_report_modes_text(const fw_mechanism *mechanism, const fw_device_scene *scene,
                               const fw_statics_modes *modes, fw_text *out) {
    fw_text_printf(out, "%s%s, %s\n", FW_NAMED("scene", scene->name ? scene->name : "(none)"),
                   modes->at_equilibrium ? "about the equilibrium under its loads"
                                         : "about the assembled pose, without its loads");
    rank_line(out, modes->dof, &modes->rank);
    if (modes->count == 0) return fw_text_end(out);
    fw_text_add(out, "\n  mode          f Hz   omega rad/s       damping  eigenvalue 1/s"
                     "             bodies\n");
    for (int i = 0; i < modes->count; i++)
        mode_row(out, i + 1, &modes->mode[i]);
    modes_that_stick(modes, out);
    if (modes->ledger.hinge.why) {
        fw_text_printf(out, "\nhinges as %s: %s",
                       fw_effects_hinge_model_text(modes->ledger.hinge.used),
                       modes->ledger.hinge.why);
        fw_text_add(out, "\n");
        frequencies_off(modes, out);
        fw_mechanism_plates plates;
        FW_TRY(fw_mechanism_plates_new(out->arena, mechanism, NULL, &plates));
        modes_across(&plates, modes->at_equilibrium ? scene->name : NULL, out);
    }
    return fw_text_end(out);
}

/* ---- statics ---- */

static void stability(fw_text *out, const fw_statics *s) {
    if (s->negative > 0)
        fw_text_printf(out, "UNSTABLE against %d motion%s", s->negative,
                       s->negative > 1 ? "s" : "");
    else
        fw_text_add(out, s->neutral > 0 ? "indifferent" : "stable");
    if (s->dof > 0) {
        fw_text_add(out, ", lowest stiffness over mass ");
        fw_text_number(out, s->eigenvalue_per_s2[0], 4);
        fw_text_add(out, " 1/s^2");
    }
    if (s->loose) fw_text_printf(out, "; nothing holds %s", s->loose);
    if (s->left_unstable)
        fw_text_add(out, "; the way there left an unstable equilibrium to one of its sides");
    fw_text_add(out, "\n");
}

static void active(fw_text *out, const fw_statics *s) {
    for (int i = 0; i < s->nactive; i++) {
        const fw_statics_active *a = &s->active[i];
        if (a->effect) {
            fw_text_printf(out, "%s %s %s\n", a->effect, a->id ? a->id : "",
                           a->on ? "acts" : "does not act");
            continue;
        }
        fw_text_printf(out, "%s %s%s %s\n", a->side == 0 ? "cable" : "stop of", a->id ? a->id : "",
                       a->side > 0   ? " at its largest angle"
                       : a->side < 0 ? " at its smallest angle"
                                     : "",
                       a->side == 0 ? (a->on ? "is taut" : "is slack")
                                    : (a->on ? "touches" : "is free"));
    }
}

static bool path_goes(const fw_statics_path *p) {
    for (size_t n = 3 * (size_t)p->nbody, k = 0; k < n; k++)
        if (fabs(p->q[(size_t)(p->count - 1) * n + k] - p->q[k]) > 1e-12) return true;
    return false;
}

static void path_events(fw_text *out, const fw_statics *s) {
    const fw_statics_path *p = s->path;
    int shown = 0;
    fw_text_printf(out, "\nload path: %d points, %s\n", p->count,
                   p->complete ? "up to the full load" : "NOT up to the full load");
    for (int i = 0; i < p->count; i++) {
        if (p->mark[i] == FW_PATH_POINT || p->mark[i] == FW_PATH_END) continue;
        if (shown++ == 0) fw_text_add(out, "  load factor      what\n");
        fw_text_real(out, "  %14.10f   ", p->factor[i]);
        fw_text_add(out, fw_report_path_mark(p->mark[i]));
        if (p->which[i] != FW_NONE)
            fw_text_printf(out, " of %s",
                           s->active[p->which[i]].id ? s->active[p->which[i]].id : "");
        if (isfinite(p->snap_m[i])) {
            fw_text_real(out, ": snaps by up to %.4g um", p->snap_m[i] * 1e6);
            fw_text_real(out, " and %.4g deg", degrees(p->snap_rad[i]));
        }
        fw_text_add(out, "\n");
    }
    const int second = fw_report_path_second(p);
    if (second != FW_NONE) {
        fw_text_real(out, "  stable a second time behind load factor %.4g", p->factor[second]);
        fw_text_add(out, p->factor[second] < 0
                             ? ": without the loads it stays there\n"
                             : ": with less of the loads it goes back from there\n");
    }
    if (shown == 0)
        fw_text_printf(out, "  no limit point, no bifurcation: %s\n",
                       path_goes(p) ? "the load only pushes further"
                                    : "nothing moves, as where the scene's loads end at 0");
}

/* joints other than revolute, and drivers; torques about point b */
static void joints(const fw_mechanism *m, const fw_statics *s, fw_report_magnitude force,
                   fw_text *out) {
    if (m->njoint > 0)
        fw_text_printf(out, "\n  joint         force on b, x and y in %-2s       torque N m\n",
                       force.unit);
    for (int k = 0; k < m->njoint; k++) {
        fw_text_printf(out, "  %-8s ", m->joint[k].id);
        column(out, s->joint_N[3 * k] * force.per_si);
        column(out, s->joint_N[3 * k + 1] * force.per_si);
        fw_text_real(out, " %14.6g", s->joint_N[3 * k + 2]);
        fw_text_add(out, "\n");
    }
    if (m->ndriver > 0) fw_text_add(out, "\n  driver          holds with\n");
    for (int k = 0; k < m->ndriver; k++) {
        bool turns = m->driver[k].revolute != FW_NONE;
        fw_text_printf(out, "  %-8s ", m->driver[k].id);
        fw_text_real(out, " %14.6g ", s->driver_N[k] * (turns ? 1 : force.per_si));
        fw_text_printf(out, "%s\n", turns ? "N m" : force.unit);
    }
}

static void pull_in(const fw_statics_pull_in *p, fw_text *out) {
    static const char *const how[] = {"", "snaps along the drive",
                                      "moves aside between the fingers",
                                      "tilts between the fingers"};
    fw_text_add(out, "\npull-in: ");
    if (p->kind == FW_PULL_IN_NONE && isinf(p->voltage_V))
        fw_text_printf(out, "none, at whatever voltage: %s\n", p->why);
    else if (p->kind == FW_PULL_IN_NONE) {
        fw_text_number(out, p->voltage_V, 6);
        fw_text_printf(out, " V at %s%s are stable, then %s\n", FW_NAMED("comb drive", p->comb),
                       p->why);
    } else {
        fw_text_number(out, p->voltage_V, 6);
        fw_text_printf(out, " V at %s%s (%s): it %s", FW_NAMED("comb drive", p->comb),
                       fw_statics_pull_in_kind_text(p->kind), how[p->kind]);
        fw_text_printf(out, ", %s%s moves most\n", FW_NAMED("body", fw_text_name(p->body)));
    }
    fw_text_add(out, "  the scene asks for up to ");
    fw_text_number(out, p->largest_V, 6);
    fw_text_add(out, isfinite(p->margin) ? " V, margin " : " V");
    if (isfinite(p->margin)) fw_text_number(out, p->margin, 4);
    const char *grows = isnan(p->at_s) ? "all drives grow together" : p->together;
    fw_text_printf(out, "; %s, slowly\n  %s may add up to ", grows,
                   fw_statics_pull_in_fringe_text(p));
    fw_text_number(out, 100 * p->fringe, 2);
    fw_text_add(out, " % of the pull and lower it by about half of that\n");
    if (!(p->fingers > 1e-3)) return;
    fw_text_add(out, "  fingers bend: by themselves they surely hold up to ");
    fw_text_number(out, p->fingers_V, 4);
    fw_text_add(out, " V, and 1/V^2 of both adds up at most\n");
}

/* where friction may hold it: the pose above, more or less this */
static void friction(const fw_mechanism *m, const fw_statics_friction_range *f, fw_text *out) {
    if (f->why) {
        fw_text_printf(out, "\nfriction: how far from here it may rest is not known: %s\n", f->why);
        return;
    }
    double far = 0;
    for (int i = 0; i < 3 * m->nbody; i++)
        far = i % 3 == 2 ? far : fmax(far, f->q[i]);
    const fw_report_magnitude length = fw_report_magnitude_of(FW_MEASURE_LENGTH, far);
    fw_text_printf(out,
                   "\nfriction may hold it anywhere within this of the places above%s\n"
                   "  centre of           x %-2s           y %-2s        phi deg\n",
                   f->first_order ? " (first order)" : "", length.unit, length.unit);
    for (int b = 0; b < m->nbody; b++)
        for (int side = 0; side < 2; side++) {
            const double *to = (side ? f->to_q : f->from_q) + 3 * b;
            fw_text_printf(out, "  %-8s %-4s", side ? "" : m->body[b].id, side ? "to" : "from");
            column(out, to[0] * length.per_si);
            column(out, to[1] * length.per_si);
            column(out, degrees(to[2]));
            fw_text_add(out, "\n");
        }
    for (int i = 0; i < f->count; i++) {
        fw_text_printf(out, "  friction of %s is at most ", f->joint[i]);
        fw_text_number(out, f->limit[i], 4);
        fw_text_add(out, f->slides[i] ? " N\n" : " N m\n");
    }
}

fw_status fw_report_statics_text(const fw_mechanism *m, const fw_device_scene *scene,
                                 const fw_statics *s, fw_text *out) {
    fw_text_printf(out, "%s%s: equilibrium under its loads, ", FW_NAMED("scene", scene->name));
    stability(out, s);
    rank_line(out, s->dof, &s->rank);
    active(out, s);
    FW_TRY(fw_report_rest_probes_text(m, scene, s, out));
    double far = 0, strong = 0;
    for (int i = 0; i < 3 * m->nbody; i++)
        far = i % 3 == 2 ? far : fmax(far, fabs(s->q[i]));
    for (int i = 0; i < 2 * m->npin; i++)
        strong = fmax(strong, fabs(s->reaction_N[i]));
    for (int i = 0; i < 3 * m->njoint; i++)
        strong = i % 3 == 2 ? strong : fmax(strong, fabs(s->joint_N[i]));
    for (int i = 0; i < m->ndriver; i++)
        strong = m->driver[i].revolute != FW_NONE ? strong : fmax(strong, fabs(s->driver_N[i]));
    const fw_report_magnitude length = fw_report_magnitude_of(FW_MEASURE_LENGTH, far);
    const fw_report_magnitude force = fw_report_magnitude_of(FW_MEASURE_FORCE, strong);
    fw_text_printf(out, "\n  body              x %-2s           y %-2s        phi deg\n",
                   length.unit, length.unit);
    for (int b = 0; b < m->nbody; b++) {
        fw_text_printf(out, "  %-8s ", m->body[b].id);
        double frame[3];
        fw_mechanism_frame_pose(&m->body[b], s->q + 3 * b, frame);
        column(out, frame[0] * length.per_si);
        column(out, frame[1] * length.per_si);
        column(out, degrees(frame[2]));
        fw_text_add(out, "\n");
    }
    if (m->npin > 0)
        fw_text_printf(out, "\n  joint         angle deg     force on b, x and y in %s\n",
                       force.unit);
    for (int k = 0; k < m->npin; k++) {
        fw_text_printf(out, "  %-8s ", m->pin[k].id);
        column(out, degrees(s->angle_rad[k]));
        column(out, s->reaction_N[2 * k] * force.per_si);
        column(out, s->reaction_N[2 * k + 1] * force.per_si);
        fw_text_add(out, "\n");
    }
    joints(m, s, force, out);
    if (s->friction) friction(m, s->friction, out);
    if (s->pull_in) pull_in(s->pull_in, out);
    if (s->path) path_events(out, s);
    fw_report_hinge_model(m, &s->ledger.hinge, s->level, out);
    return fw_text_end(out);
}

/* ---- table ---- */

static void header(const fw_mechanism *m, fw_text *out) {
    fw_text_add(out, "load_factor,lowest_per_s2,negative,mark");
    for (int b = 0; b < m->nbody; b++) {
        const char *id = m->body[b].id;
        fw_text_printf(out, ",%s.x_m,%s.y_m,%s.phi_rad", id, id, id);
    }
    for (int k = 0; k < m->npin; k++) {
        const char *id = m->pin[k].id;
        fw_text_printf(out, ",%s.angle_rad,%s.fx_N,%s.fy_N", id, id, id);
    }
    for (int k = 0; k < m->njoint; k++) {
        const char *id = m->joint[k].id;
        fw_text_printf(out, ",%s.fx_N,%s.fy_N,%s.torque_Nm", id, id, id);
    }
    for (int k = 0; k < m->ndriver; k++)
        fw_text_printf(out, ",%s.drive_%s", m->driver[k].id,
                       m->driver[k].revolute != FW_NONE ? "Nm" : "N");
    fw_text_add(out, "\n");
}

static void cells(fw_text *out, const double *value, int count) {
    for (int i = 0; i < count; i++) {
        fw_text_add(out, ",");
        fw_text_number(out, value[i], 17);
    }
}

static void row(const fw_mechanism *m, const double *q, const double *angle, const double *force,
                const double *joint, const double *driver, fw_text *out) {
    for (int b = 0; b < m->nbody; b++) {
        double frame[3];
        fw_mechanism_frame_pose(&m->body[b], q + 3 * b, frame);
        cells(out, frame, 3);
    }
    for (int k = 0; k < m->npin; k++) {
        const double value[3] = {angle[k], force[2 * k], force[2 * k + 1]};
        cells(out, value, 3);
    }
    cells(out, joint, 3 * m->njoint);
    cells(out, driver, m->ndriver);
    fw_text_add(out, "\n");
}

static void lead(fw_text *out, double factor, double lowest, int negative,
                 fw_statics_path_mark mark) {
    fw_text_number(out, factor, 17);
    fw_text_add(out, ",");
    if (isfinite(lowest)) fw_text_number(out, lowest, 17);
    fw_text_printf(out, ",%d,%s", negative, fw_report_path_mark(mark));
}

fw_status fw_report_load_path_csv(const fw_mechanism *m, const fw_statics *s, fw_text *out) {
    header(m, out);
    const fw_statics_path *p = s->path;
    size_t n = 3 * (size_t)m->nbody, pins = (size_t)m->npin;
    if (!p) {
        lead(out, 1, s->eigenvalues > 0 ? s->eigenvalue_per_s2[0] : (double)NAN, s->negative,
             FW_PATH_END);
        row(m, s->q, s->angle_rad, s->reaction_N, s->joint_N, s->driver_N, out);
    }
    for (size_t i = 0; p && i < (size_t)p->count; i++) {
        lead(out, p->factor[i], p->lowest_per_s2[i], p->negative[i], p->mark[i]);
        row(m, p->q + i * n, p->angle_rad + i * pins, p->reaction_N + 2 * i * pins,
            p->joint_N + 3 * i * (size_t)m->njoint, p->driver_N + i * (size_t)m->ndriver, out);
    }
    return fw_text_end(out);
}

/* ---- the certified workspace ---- */

static void range(fw_text *out, fw_maths_interval a, double factor, int digits) {
    fw_text_number(out, a.lo * factor, digits);
    fw_text_add(out, " to ");
    fw_text_number(out, a.hi * factor, digits);
}

static void bracket(fw_text *out, fw_maths_interval a, double factor, int digits) {
    fw_text_add(out, "[");
    fw_text_number(out, a.lo * factor, digits);
    fw_text_add(out, ", ");
    fw_text_number(out, a.hi * factor, digits);
    fw_text_add(out, "]");
}

static void pose(fw_text *out, const double at[3]) {
    fw_text_add(out, "(");
    fw_text_number(out, at[0] * 1e6, 4);
    fw_text_add(out, " um, ");
    fw_text_number(out, at[1] * 1e6, 4);
    fw_text_add(out, " um, ");
    fw_text_number(out, at[2] * FW_DEG_PER_RAD, 4);
    fw_text_add(out, " deg)");
}

static void singularities(fw_text *out, const fw_mechanism *m, const fw_workspace_regularity *s) {
    const fw_workspace_triangle *least = &s->passive[0];
    int regular = 0, inside = 0;
    for (int i = 0; i < FW_TRIANGLES; i++) {
        const fw_workspace_triangle *t = &s->passive[i];
        regular += t->regular;
        inside += t->positive && t->negative;
        if (t->length_m.lo < least->length_m.lo) least = t;
    }
    for (int side = 0; side < 2; side++) {
        fw_text_printf(out, "  elbow %s: %s, sine ", m->pin[side ? 4 : 1].id,
                       s->regular[side] ? "never stretched or folded (proved)"
                                        : "NOT proved to stay bent");
        range(out, s->sine[side], 1.0, 4);
        fw_text_add(out, "\n");
    }
    fw_text_printf(out, "  %d of %d choices of three driven hinges are regular everywhere (proved)",
                   regular, FW_TRIANGLES);
    if (inside > 0) fw_text_printf(out, "; %d become singular inside", inside);
    fw_text_printf(out, "\n  least favourable: %s, %s, %s passive, arm at least ",
                   m->pin[least->hinge[0]].id, m->pin[least->hinge[1]].id,
                   m->pin[least->hinge[2]].id);
    fw_text_number(out, least->length_m.lo * 1e6, 3);
    fw_text_add(out, " um, ");
    fw_text_number(out, least->length_m.hi * 1e6, 3);
    fw_text_add(out, " um at ");
    pose(out, least->pose);
    fw_text_add(out, "\n");
}

static void reachable(fw_text *out, const fw_report_workspace_flow *f) {
    const fw_workspace_map *map = f->map;
    static const char *const unit[] = {"x (um)", "y (um)", "rotation (deg)"};
    fw_text_add(out, "reachable within the elastic limits (certified by interval arithmetic)\n");
    fw_text_add(out, "  volume ");
    bracket(out, map->volume.value, 1e12, 8);
    fw_text_add(out, " um2 rad = ");
    bracket(out, map->volume.value, 1e12 * FW_DEG_PER_RAD, 8);
    double relative = (map->volume.value.hi - map->volume.value.lo) / map->volume.value.hi;
    fw_text_printf(out, " um2 deg, %ld boxes\n", map->volume.boxes);
    if (relative > 0.01) {
        fw_text_real(out,
                     "  (certified to %.2g %% only: a leg comes close to stretched or folded)\n",
                     100.0 * relative);
    }
    for (int c = 0; c < 3; c++) {
        double factor = c < 2 ? 1e6 : FW_DEG_PER_RAD;
        fw_text_printf(out, "  %-15s from ", unit[c]);
        bracket(out, map->survey.least[c], factor, 6);
        fw_text_add(out, " to ");
        bracket(out, map->survey.most[c], factor, 6);
        fw_text_add(out, "\n");
    }
    for (int i = 0; i < FW_SLICES; i++) {
        fw_text_add(out, "  area at ");
        fw_text_real(out, "%8.4f", map->slice[i].phi_rad * FW_DEG_PER_RAD);
        fw_text_add(out, " deg  ");
        bracket(out, map->slice[i].area.value, 1e12, 6);
        fw_text_add(out, " um2\n");
    }
    fw_text_add(out, "  the boundary belongs to");
    for (int i = 0; i < FW_SIX; i++) {
        fw_text_printf(out, "%s %s ", i ? "," : "", f->mechanism->pin[i].id);
        fw_text_real(out, "%.1f %%", 100.0 * map->survey.share[i]);
    }
    fw_text_add(out, "\n  volume grows with all limits to the power ");
    fw_text_number(out, map->survey.exponent, 3);
    fw_text_add(out, "\n");
    singularities(out, f->mechanism, &map->survey.singular);
}

/* what the joint force makes of it, under the actuation that is worst for this hinge */
static void with_force(fw_text *out, const fw_report_workspace_flow *f, int box, int i) {
    const fw_workspace_strain_proof *p = &f->required->strain[box];
    int hinge = f->mechanism->pin[i].hinge;
    if (!p->hold || hinge == FW_NONE) return;
    double limit = f->map->limit_rad[i] * f->mechanism->hinge[hinge].closed_form.strain_per_rad;
    fw_text_real(out, "; with its joint force %.1f %%", 100.0 * p->strain[i] / limit);
    fw_text_add(out, p->proved ? " (proved)" : " (sampled)");
}

static void required(fw_text *out, const fw_device *d, const fw_report_workspace_flow *f, int k) {
    const fw_device_workspace_box *b = &d->workspace[k];
    const fw_workspace_proof *p = &f->required->proof[k];
    fw_text_add(out, "required: x ");
    range(out, (fw_maths_interval){b->x_min_m, b->x_max_m}, 1e6, 6);
    fw_text_add(out, " um, y ");
    range(out, (fw_maths_interval){b->y_min_m, b->y_max_m}, 1e6, 6);
    fw_text_add(out, " um, rotation ");
    range(out, (fw_maths_interval){b->phi_min_rad, b->phi_max_rad}, FW_DEG_PER_RAD, 6);
    fw_text_add(out, " deg\n");
    if (!f->required->box_reachable[k]) {
        const bool here = f->required->fail_box == k, sure = here && f->required->beyond.certain;
        fw_text_add(out, sure ? "  NOT REACHABLE, whatever its flexures give: "
                              : "  NOT REACHED BY PINS, perhaps by flexures that give: ");
        if (here)
            pose(out, f->required->beyond.pose);
        else
            fw_text_add(out, "a pose of it");
        fw_text_add(out, "\n");
        return;
    }
    if (!p->proved) {
        fw_text_add(out, "  reachable at every sampled pose; NOT PROVED\n");
        return;
    }
    fw_text_printf(out, "  every pose can be assembled on the drawn branch (proved, %ld boxes)\n",
                   p->boxes);
    for (int i = 0; i < FW_SIX; i++) {
        fw_maths_interval a = p->angle_rad[i];
        fw_text_printf(out, "  %-6s", f->mechanism->pin[i].id);
        fw_text_real(out, " %9.4f to", a.lo * FW_DEG_PER_RAD);
        fw_text_real(out, " %9.4f deg", a.hi * FW_DEG_PER_RAD);
        if (!f->map->none) {
            double limit = f->map->limit_rad[i], most = fmax(fabs(a.lo), fabs(a.hi));
            bool beyond = p->most[i].angle_rad.lo > limit || p->least[i].angle_rad.hi < -limit;
            fw_text_real(out, ", limit %.4f deg: ", limit * FW_DEG_PER_RAD);
            fw_text_real(out, "%.1f %%, ", 100.0 * most / limit);
            fw_text_add(out, most <= limit ? "within (proved)"
                             : beyond      ? "BEYOND (proved)"
                                           : "undecided");
            with_force(out, f, k, i);
        }
        fw_text_add(out, "\n");
    }
    singularities(out, f->mechanism, &f->singular[k]);
}

fw_status fw_report_workspace_text(const fw_report_workspace *in, fw_text *out) {
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_workspace_flow *f = &in->flow[i];
        if (i > 0) fw_text_add(out, "\n");
        fw_text_printf(out, "%s\n", f->flow ? f->flow : f->mechanism->variant->material.id);
        if (f->map->none)
            fw_text_printf(out, "no reachable set: %s\n", f->map->none);
        else
            reachable(out, f);
        for (int k = 0; k < in->device->nworkspace; k++)
            if (f->required->asked && f->required->asked[k]) required(out, in->device, f, k);
    }
    return fw_text_end(out);
}
