/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion as curves and as tables. */
#include "base/constants.h"
#include "report/report.h"
#include "report/report_page.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Buckets of equal length, of each the least and the greatest sample in order of time: what a plot
   of that many pixels would show, with every peak in its place. in: y (count, step `stride`), most
   >= 4; out: index (most). Returns how many. Cost O(count). Proved by
   tests/unit/report/test_report_plot.c. */
int fw_report_decimate(const double *y, int stride, int count, int most, int *index) {
    if (count <= most || most < 4) {
        int n = count < most ? count : most;
        for (int i = 0; i < n; i++)
            index[i] = i;
        return n;
    }
    int buckets = (most - 2) / 2, n = 0;
    index[n++] = 0;
    for (int b = 0; b < buckets; b++) {
        int from = 1 + (int)((long long)(count - 2) * b / buckets);
        int to = 1 + (int)((long long)(count - 2) * (b + 1) / buckets);
        int least = from, greatest = from;
        for (int i = from; i < to; i++) {
            least = y[(size_t)i * (size_t)stride] < y[(size_t)least * (size_t)stride] ? i : least;
            greatest =
                y[(size_t)i * (size_t)stride] > y[(size_t)greatest * (size_t)stride] ? i : greatest;
        }
        index[n++] = least < greatest ? least : greatest;
        if (least != greatest) index[n++] = least < greatest ? greatest : least;
    }
    index[n++] = count - 1;
    return n;
}

/* Hinge angles against time, one small panel per hinge, so that every curve has its own limit. */

enum { PANEL_WIDTH = FW_REPORT_PANEL_WIDTH, PANEL_HEIGHT = FW_REPORT_PANEL_HEIGHT, HEADING = 36 };
enum { LEFT = 46, RIGHT = 10, TOP = 30, BOTTOM = 34 };

typedef struct panel {
    const fw_mechanism *mechanism;
    const fw_dynamics_motion *motion;
    int pin, points;
    fw_report_axes axes; /* degrees */
    double limit;        /* degrees; NaN: none */
    bool limit_shown;
} panel;

double fw_report_axes_x(const fw_report_axes *a, double t_s) {
    return a->t_end > 0.0 ? a->x + a->width * t_s / a->t_end : a->x;
}

double fw_report_axes_y(const fw_report_axes *a, double value) {
    return a->y + a->height * (a->high - value) / (a->high - a->low);
}

static double place_x(const panel *p, double t_s) {
    return fw_report_axes_x(&p->axes, t_s);
}

static double place_y(const panel *p, double degrees) {
    return fw_report_axes_y(&p->axes, degrees);
}

static double angle(const panel *p, int sample) {
    const fw_dynamics_motion *m = p->motion;
    return FW_DEG_PER_RAD * m->angle_rad[(size_t)sample * (size_t)m->npin + (size_t)p->pin];
}

static void range(panel *p) {
    double peak = fabs(FW_DEG_PER_RAD * p->motion->peak[p->pin].angle_rad);
    double least = 0.0, most = 0.0;
    for (int i = 0; i < p->motion->nsample; i++) {
        least = fmin(least, angle(p, i));
        most = fmax(most, angle(p, i));
    }
    double size = fmax(isfinite(peak) ? peak : 0.0, fmax(-least, most));
    p->limit = FW_DEG_PER_RAD * fw_report_pin_limit(p->mechanism, p->pin);
    /* a limit far away would flatten the curve: said in words instead */
    p->limit_shown = isfinite(p->limit) && size > 0.12 * p->limit;
    if (p->limit_shown) size = fmax(size, p->limit);
    if (!(size > 0.0)) size = isfinite(p->limit) ? p->limit : 1.0;
    p->axes.high = 1.12 * size;
    p->axes.low = -p->axes.high;
}

void fw_report_axes_draw(const fw_report_axes *p, fw_text *out) {
    double right = p->x + p->width, bottom = p->y + p->height;
    double step = fw_svg_nice((p->high - p->low) / 6.0);
    fw_svg_open(out, "g font-size='10' fill='#57606a' stroke='none'");
    for (int k = (int)ceil(p->low / step); k <= (int)floor(p->high / step); k++) {
        double value = k * step, y = fw_report_axes_y(p, value);
        if (value < p->low || value > p->high) continue;
        fw_svg_put(out, "path d='M{c} {c}H{c}' stroke='{r}'", p->x, y, right,
                   k == 0 ? "#8c959f" : "#eaeef2");
        fw_svg_open(out, "text x='{c}' y='{c}' text-anchor='end'", p->x - 5.0, y + 3.5);
        fw_svg_tick(out, value, step);
        fw_svg_close(out, "text");
    }
    double t_step = fw_svg_nice(p->t_end / p->time_unit / 5.5);
    for (int k = 0; k <= 8; k++) {
        double t = k * t_step * p->time_unit;
        if (t > p->t_end * (1.0 + 1e-9)) break;
        fw_svg_put(out, "path d='M{c} {c}v4' stroke='#8c959f'", fw_report_axes_x(p, t), bottom);
        fw_svg_open(out, "text x='{c}' y='{c}' text-anchor='middle'", fw_report_axes_x(p, t),
                    bottom + 15.0);
        fw_svg_tick(out, k * t_step, t_step);
        fw_svg_close(out, "text");
    }
    fw_svg_put(out, "text x='{c}' y='{c}' text-anchor='end'>time ({r})", right, bottom + 28.0,
               p->time_name);
    fw_svg_put(out, "path d='M{c} {c}V{c}H{c}' fill='none' stroke='#8c959f'", p->x, p->y, bottom,
               right);
    fw_svg_close(out, "g\n");
}

static void limits(const panel *p, fw_text *out) {
    if (!p->limit_shown) return;
    double top = place_y(p, p->limit), low = place_y(p, -p->limit);
    fw_svg_put(
        out,
        "path d='M{c} {c}h{c}V{c}h-{c}zM{c} {c}h{c}V{c}h-{c}z' fill='#D55E00' fill-opacity='0.08'",
        p->axes.x, p->axes.y, p->axes.width, top, p->axes.width, p->axes.x, low, p->axes.width,
        p->axes.y + p->axes.height, p->axes.width);
    fw_svg_put(
        out,
        "path d='M{c} {c}h{c}M{c} {c}h{c}' stroke='#D55E00' stroke-dasharray='5 3' fill='none'\n",
        p->axes.x, top, p->axes.width, p->axes.x, low, p->axes.width);
}

static fw_status curve(fw_arena *arena, const panel *p, fw_text *out) {
    const fw_dynamics_motion *m = p->motion;
    if (m->nsample == 0) return FW_OK;
    int *index;
    int most = p->points < 4 ? 4 : p->points;
    FW_NEED(index = fw_arena_array(arena, int, (size_t)most));
    int n = fw_report_decimate(m->angle_rad + p->pin, m->npin, m->nsample, most, index);
    fw_svg_path(out, "fill='none' stroke='#0072B2' stroke-width='1.4' stroke-linejoin='round'");
    for (int i = 0; i < n; i++)
        fw_markup(out, "{r}{c} {c}",
                  i == 0   ? "M"
                  : i == 1 ? "L"
                           : " ",
                  place_x(p, m->t_s[index[i]]), place_y(p, angle(p, index[i])));
    fw_svg_path_end(out);
    return FW_OK;
}

static void peak_mark(const panel *p, fw_text *out) {
    const fw_dynamics_peak *peak = &p->motion->peak[p->pin];
    if (!isfinite(peak->angle_rad) || !isfinite(peak->t_s)) return;
    double x = place_x(p, peak->t_s), y = place_y(p, FW_DEG_PER_RAD * peak->angle_rad);
    bool left = x > p->axes.x + 0.55 * p->axes.width;
    fw_svg_put(out, "circle cx='{c}' cy='{c}' r='3' fill='#1f2328'", x, y);
    fw_svg_put(out,
               "text x='{c}' y='{c}' font-size='10.5' fill='#1f2328' stroke='#fff' "
               "stroke-width='3' paint-order='stroke' text-anchor='{r}'>{D}\u00b0 at {n} {r}\n",
               left ? x - 7.0 : x + 7.0,
               peak->angle_rad > 0.0 ? fmax(y - 5.0, p->axes.y + 9.0)
                                     : fmin(y + 13.0, p->axes.y + p->axes.height - 3.0),
               left ? "end" : "start", peak->angle_rad, peak->t_s / p->axes.time_unit,
               p->axes.time_name);
}

static void heading(const panel *p, fw_text *out) {
    double u = fabs(FW_DEG_PER_RAD * p->motion->peak[p->pin].angle_rad) / p->limit;
    fw_svg_open(out, "text x='{c}' y='{c}' font-size='13' font-weight='600' fill='#1f2328'",
                p->axes.x, p->axes.y - 9.0);
    fw_markup(out, "{s} ", p->mechanism->pin[p->pin].id);
    fw_svg_put(out, "tspan class='readout' font-size='11.5' font-weight='400'>");
    fw_svg_close(out, "text");
    fw_svg_open(out, "text x='{c}' y='{c}' font-size='10.5' text-anchor='end' fill='#57606a'",
                p->axes.x + p->axes.width, p->axes.y - 9.0);
    if (isfinite(u))
        fw_markup(out, "{p} of limit \u00b1{D}\u00b0{r}", u, p->limit / FW_DEG_PER_RAD,
                  p->limit_shown ? "" : " (off scale)");
    else
        fw_text_add(out, "no limit");
    fw_svg_close(out, "text");
    fw_svg_put(out,
               "text x='{c}' y='{c}' font-size='10' fill='#57606a' text-anchor='end' "
               "transform='rotate(-90 {c} {c})'>angle (\u00b0)\n",
               p->axes.x - 36.0, p->axes.y, p->axes.x - 36.0, p->axes.y);
}

static fw_status draw_panel(fw_arena *arena, const panel *p, fw_text *out) {
    fw_svg_open(out, "g class='panel' data-pin='{i}' data-x='{c}' data-w='{c}'\n", p->pin,
                p->axes.x, p->axes.width);
    heading(p, out);
    fw_report_axes_draw(&p->axes, out);
    limits(p, out);
    FW_TRY(curve(arena, p, out));
    peak_mark(p, out);
    fw_svg_put(out, "path class='cursor' d='M0 {c}v{c}' stroke='#1f2328' visibility='hidden'",
               p->axes.y, p->axes.height);
    fw_svg_close(out, "g\n");
    return FW_OK;
}

/* the most used pins, in the order of the file */
static int choose(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                  int chosen[FW_REPORT_PANELS]) {
    int n = 0;
    for (int k = 0; k < motion->npin; k++) {
        double u = fabs(motion->peak[k].angle_rad) / fw_report_pin_limit(mechanism, k);
        int better = 0;
        for (int j = 0; j < motion->npin && better < FW_REPORT_PANELS; j++) {
            double v = fabs(motion->peak[j].angle_rad) / fw_report_pin_limit(mechanism, j);
            if (j != k && isfinite(v) && (!isfinite(u) || v > u))
                better++;
            else if (j < k && (v == u || (!isfinite(v) && !isfinite(u))))
                better++;
        }
        if (better < FW_REPORT_PANELS && n < FW_REPORT_PANELS) chosen[n++] = k;
    }
    return n;
}

fw_report_axes fw_report_axes_at(const fw_dynamics_motion *motion, int i, int columns, double top) {
    double end = motion->nsample ? motion->t_s[motion->nsample - 1] : 0.0;
    double t_end = isfinite(end) && end > 0.0 ? end : 1.0;
    return (fw_report_axes){.x = (i % columns) * PANEL_WIDTH + LEFT,
                            .y = top + (i / columns) * PANEL_HEIGHT + TOP,
                            .width = PANEL_WIDTH - LEFT - RIGHT,
                            .height = PANEL_HEIGHT - TOP - BOTTOM,
                            .t_end = t_end,
                            .time_unit = t_end < 2e-3  ? 1e-6
                                         : t_end < 2.0 ? 1e-3
                                                       : 1.0,
                            .time_name = t_end < 2e-3  ? "\u00b5s"
                                         : t_end < 2.0 ? "ms"
                                                       : "s"};
}

static void open_svg(const fw_report_figure *figure, int width, double height, fw_text *out) {
    fw_svg_begin(out,
                 &(fw_svg_frame){.width = width,
                                 .height = height,
                                 .decimals = 2,
                                 .file = figure->standalone,
                                 .size = figure->standalone ? FW_SVG_SIZE_BEHIND : FW_SVG_SIZE_NONE,
                                 .lead = "class='plots' role='img'",
                                 .font = fw_svg_font_page});
    fw_svg_title(out, "{s}", figure->title);
    if (!figure->standalone) return;
    fw_svg_paper(out, "#fff");
    fw_svg_put(out, "text x='{i}' y='24' font-size='15' font-weight='600'>{s}\n", LEFT,
               figure->title);
}

fw_status fw_report_panels(fw_arena *arena, const fw_mechanism *mechanism,
                           const fw_dynamics_motion *motion, const fw_report_figure *figure,
                           fw_text *out) {
    int chosen[FW_REPORT_PANELS];
    int n = choose(mechanism, motion, chosen), columns = figure->columns;
    double top = figure->standalone ? HEADING : 0.0;
    double height = top + (double)((n + columns - 1) / columns) * PANEL_HEIGHT;
    height += motion->npin > n ? 20.0 : 0.0;
    open_svg(figure, columns * PANEL_WIDTH, height, out);
    panel p = {.mechanism = mechanism, .motion = motion, .points = figure->curve_points};
    for (int i = 0; i < n; i++) {
        p.pin = chosen[i];
        p.axes = fw_report_axes_at(motion, i, columns, top);
        range(&p);
        FW_TRY(draw_panel(arena, &p, out));
    }
    if (motion->npin > n)
        fw_svg_put(
            out,
            "text x='{i}' y='{c}' font-size='11' fill='#57606a'>The {i} most used of {i} joints.\n",
            LEFT, height - 6.0, n, motion->npin);
    fw_svg_end(out);
    return fw_text_end(out);
}

fw_status fw_report_motion_svg(fw_arena *arena, const fw_device *device,
                               const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               const fw_device_scene *scene, const fw_verdict *verdict,
                               fw_text *out) {
    const char *flow = mechanism->variant ? mechanism->variant->flow : NULL;
    char *title = fw_arena_printf(
        arena, "%s%s, %s%s%s%s: hinge angles and their limits", fw_report_rejected(verdict),
        device->name ? device->name : "device", FW_NAMED("scene", scene->name ? scene->name : ""),
        flow ? ", " : "", flow ? flow : "");
    FW_NEED(title);

    const fw_report_figure figure = {3, 2 * FW_REPORT_CURVE, true, title};
    return fw_report_panels(arena, mechanism, motion, &figure, out);
}

/* ---- motions as tables ---- */

/* RFC 4180: quoted only where a name needs it */
static void name(fw_text *out, const char *id, const char *suffix) {
    bool quote = strpbrk(id, ",\"\r\n") != NULL;
    fw_text_add(out, quote ? ",\"" : ",");
    for (; *id; id++) {
        if (*id == '"') fw_text_add(out, "\"");
        fw_text_bytes(out, id, 1);
    }
    fw_text_add(out, suffix);
    if (quote) fw_text_add(out, "\"");
}

static void cell(fw_text *out, double value) {
    if (isfinite(value)) fw_text_number(out, value, 17);
}

/* columns of a centre of mass that is not the origin of its body's frame */
static int extra(const fw_mechanism_mass *body) {
    return body->frame.x != 0 || body->frame.y != 0 ? 2 : 0;
}

/* probes of this scene that have a course in time, each in its SI unit */
static fw_status probe_columns(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               const fw_device_scene *scene, fw_text *out, fw_probe **probe) {
    const int n = fw_probe_count(mechanism);
    *probe = NULL;
    if (n == 0) return FW_OK;
    FW_TRY(fw_probe_bind(out->arena, mechanism, scene, motion->loads, probe));
    for (int i = 0; i < n; i++) {
        const fw_probe *p = &(*probe)[i];
        if (!fw_report_probe_moves(p)) continue;
        char suffix[64];
        snprintf(suffix, sizeof suffix, ".%s_%s", p->kind->name, p->kind->suffix);
        name(out, p->asked->id, suffix);
    }
    return FW_OK;
}

bool fw_report_probe_moves(const fw_probe *p) {
    return p->in_scene && fw_device_probe_moves(p->kind);
}

/* per body its frame's pose and velocities, and where the centre of mass is apart from it that;
   probes */
fw_status fw_report_motion_csv(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               const fw_device_scene *scene, fw_text *out) {
    static const char *const suffix[] = {".x_m",        ".y_m",        ".phi_rad",
                                         ".vx_m_per_s", ".vy_m_per_s", ".omega_rad_per_s",
                                         ".com_x_m",    ".com_y_m"};
    fw_text_add(out, "t_s");
    for (int b = 0; b < motion->nbody; b++)
        for (int k = 0; k < 6 + extra(&mechanism->body[b]); k++)
            name(out, mechanism->body[b].id, suffix[k]);
    fw_probe *probe;
    FW_TRY(probe_columns(mechanism, motion, scene, out, &probe));
    fw_text_add(out, "\n");
    size_t wide = 3 * (size_t)motion->nbody;
    for (int i = 0; i < motion->nsample && !out->failed; i++) {
        cell(out, motion->t_s[i]);
        for (int b = 0; b < motion->nbody; b++) {
            const fw_mechanism_mass *body = &mechanism->body[b];
            size_t at = (size_t)i * wide + 3 * (size_t)b;
            const double *q = motion->q + at, *v = motion->v + at;
            double frame[6];
            if (extra(body)) {
                fw_mechanism_frame_pose(body, q, frame);
                fw_mechanism_frame_velocity(body, q[2], v, frame + 3);
                q = frame, v = frame + 3;
            }
            for (int k = 0; k < 6; k++) {
                fw_text_add(out, ",");
                cell(out, k < 3 ? q[k] : v[k - 3]);
            }
            for (int k = 0; k < extra(body); k++) {
                fw_text_add(out, ",");
                cell(out, motion->q[at + (size_t)k]);
            }
        }
        for (int k = 0; probe && k < fw_probe_count(mechanism); k++) {
            if (!fw_report_probe_moves(&probe[k])) continue;
            fw_text_add(out, ",");
            cell(out, fw_probe_at_row(&probe[k], motion, i));
        }
        fw_text_add(out, "\n");
    }
    return fw_text_end(out);
}

/* accelerations of all bodies, forces of all joints and drivers */
fw_status fw_report_forces_csv(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               fw_text *out) {
    static const char *const of_body[] = {".ax_m_per_s2", ".ay_m_per_s2", ".alpha_rad_per_s2"};
    static const char *const of_joint[] = {".fx_N", ".fy_N", ".torque_Nm"};
    fw_text_add(out, "t_s");
    for (int i = 0; i < 3 * motion->nbody; i++)
        name(out, mechanism->body[i / 3].id, of_body[i % 3]);
    for (int i = 0; i < 2 * motion->npin; i++)
        name(out, mechanism->pin[i / 2].id, of_joint[i % 2]);
    for (int i = 0; i < 3 * motion->njoint; i++)
        name(out, mechanism->joint[i / 3].id, of_joint[i % 3]);
    for (int i = 0; i < motion->ndriver; i++) {
        const fw_device_driver *d = &mechanism->driver[i];
        name(out, d->id, d->revolute != FW_NONE ? ".drive_Nm" : ".drive_N");
    }
    fw_text_add(out, "\n");
    const struct {
        const double *value;
        int wide;
    } part[] = {{motion->reaction_N, 2 * motion->npin},
                {motion->joint_N, 3 * motion->njoint},
                {motion->driver_N, motion->ndriver}};
    for (int i = 0; i < motion->nsample && !out->failed; i++) {
        cell(out, motion->t_s[i]);
        for (int b = 0; b < motion->nbody; b++) {
            size_t at = 3 * ((size_t)i * (size_t)motion->nbody + (size_t)b);
            double value[3];
            fw_mechanism_frame_acceleration(&mechanism->body[b], motion->q[at + 2],
                                            motion->v[at + 2], motion->accel + at, value);
            for (int k = 0; k < 3; k++) {
                fw_text_add(out, ",");
                cell(out, value[k]);
            }
        }
        for (size_t k = 0; k < sizeof part / sizeof part[0]; k++)
            for (int c = 0; c < part[k].wide; c++) {
                fw_text_add(out, ",");
                cell(out, part[k].value[(size_t)i * (size_t)part[k].wide + (size_t)c]);
            }
        fw_text_add(out, "\n");
    }
    return fw_text_end(out);
}
