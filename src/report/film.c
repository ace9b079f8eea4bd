/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mechanism that moves, as SVG elements that play by themselves: SMIL, which browsers run even
   inside <img>. Drawn bodies by nested transforms, flexures by their outline, everything else as in
   figure.h, all linear between key frames. With 0 frames: a still picture. */
#include "report/figure.h"
#include "base/constants.h"
#include <math.h>

enum { NUMBERS = 100000, MOST_FRAMES = 480, REACH = 200 };

typedef fw_report_film film;

static double instant(const film *f, int frame) {
    return f->motion->t_s[f->motion->nsample - 1] * frame / (f->frames - 1);
}

static double degrees(double rad) { /* clockwise, as in the picture */
    return -FW_DEG_PER_RAD * rad;
}

/* ---- bodies ---- */

/* the innermost of three groups that put what is drawn at the body's drawn place to its pose */
static void from_drawn(const film *f, const fw_mass *m) {
    fw_svg_open(f->out, "g transform='translate({c} {c})'", -fw_report_x(f->view, m->x_m),
                -fw_report_y(f->view, m->y_m));
}

/* the pose at t */
static void body_at(const film *f, int body, double t_s) {
    const fw_mass *m = &f->mechanism->body[body];
    double pose[3];
    fw_report_pose_at(f->motion, body, t_s, pose);
    fw_svg_open(f->out, "g transform='translate({c} {c})'", fw_report_x(f->view, pose[0]),
                fw_report_y(f->view, pose[1]));
    fw_svg_open(f->out, "g transform='rotate({3})'", degrees(pose[2] - m->phi_rad));
    from_drawn(f, m);
}

/* the same, moving */
static void body_motion(const film *f, int body) {
    const fw_mass *m = &f->mechanism->body[body];
    double pose[3];
    if (f->frames == 0) {
        body_at(f, body, f->still_s);
        return;
    }
    fw_report_pose_at(f->motion, body, f->still_s, pose); /* for viewers that do not animate */
    double still = pose[2] - m->phi_rad;
    fw_svg_open(f->out, "g transform='translate({c} {c})'", fw_report_x(f->view, pose[0]),
                fw_report_y(f->view, pose[1]));
    fw_svg_animate_group(f->out, "translate", f->seconds);
    for (int i = 0; i < f->frames; i++) {
        fw_report_pose_at(f->motion, body, instant(f, i), pose);
        fw_markup(f->out, "{r}{c} {c}", i ? ";" : "", fw_report_x(f->view, pose[0]),
                  fw_report_y(f->view, pose[1]));
    }
    fw_svg_finish(f->out, "/>");
    fw_svg_open(f->out, "g transform='rotate({3})'", degrees(still));
    fw_svg_animate_group(f->out, "rotate", f->seconds);
    for (int i = 0; i < f->frames; i++) {
        fw_report_pose_at(f->motion, body, instant(f, i), pose);
        fw_markup(f->out, "{r}{3}", i ? ";" : "", degrees(pose[2] - m->phi_rad));
    }
    fw_svg_finish(f->out, "/>");
    from_drawn(f, m);
}

static void close_body(const film *f) {
    fw_svg_finish(f->out, "/>");
    fw_svg_close(f->out, "g");
    fw_svg_close(f->out, "g");
    fw_svg_close(f->out, "g\n");
}

static void bodies(const film *f) {
    for (int b = 0; b < f->motion->nbody; b++) {
        if (!fw_report_outlined(f->layout, b)) continue;
        body_motion(f, b);
        fw_svg_path(f->out, "fill='{r}' stroke='#57606a' stroke-width='0.7'",
                    f->device->body[b].platform ? "#bcd0e3" : "#d5dbe1");
        fw_report_body_path(f->layout, b, f->view, f->out);
        close_body(f);
    }
}

/* where drawn bodies are at the first sample, dashed */
static void ghost(const film *f) {
    for (int b = 0; f->ghost && b < f->motion->nbody; b++) {
        if (!fw_report_outlined(f->layout, b)) continue;
        body_at(f, b, 0.0);
        fw_svg_path(f->out, "fill='none' stroke='#8c959f' stroke-width='1' stroke-dasharray='4 3'");
        fw_report_body_path(f->layout, b, f->view, f->out);
        close_body(f);
    }
}

/* ---- flexures ---- */

static void outline(const film *f, const fw_report_bend *bend, double t_s) {
    for (int k = 0; k < bend->npoint; k++) {
        fw_vec2 p = fw_report_bent(f->mechanism, f->motion, bend, t_s, bend->point[k]);
        fw_markup(f->out, "{r}{c} {c}", k ? "L" : "M", fw_report_x(f->view, p.x),
                  fw_report_y(f->view, p.y));
    }
    fw_text_add(f->out, "Z");
}

static void flexures(const film *f, const fw_report_bends *bends) {
    int numbers = 0;
    for (int i = 0; i < bends->count; i++)
        numbers += 2 * bends->item[i].npoint;
    film coarse = *f; /* fewer key frames where outlines have many points */
    while (coarse.frames > 16 && (long)coarse.frames * numbers > NUMBERS)
        coarse.frames = coarse.frames * 3 / 4;
    for (int i = 0; i < bends->count; i++) {
        const fw_report_bend *bend = &bends->item[i];
        double u = fabs(f->motion->peak[bend->joint].angle_rad) /
                   fw_report_pin_limit(f->mechanism, bend->joint);
        const char *colour = fw_report_utilisation_colour(u);
        fw_svg_path(f->out, "fill='{r}' stroke='{r}' stroke-width='1.2'", colour, colour);
        outline(f, bend, f->still_s);
        if (f->frames == 0) {
            fw_svg_path_end(f->out);
            continue;
        }
        fw_svg_finish(f->out, ">");
        fw_svg_animate_path(f->out, f->seconds);
        for (int k = 0; k < coarse.frames; k++) {
            fw_text_add(f->out, k ? ";" : "");
            outline(f, bend, instant(&coarse, k));
        }
        fw_svg_finish(f->out, "/>");
        fw_svg_close(f->out, "path\n");
    }
}

/* ---- everything else: figure.c ---- */

/* drawn already, as an outline or as a flexure */
static bool shown(const fw_layout *layout, const fw_figure_part *part) {
    if (part->pin != FW_NONE)
        return fw_report_drawn(layout) && layout->hinge && layout->hinge[part->pin].drawn;
    bool body = part->role == FW_FIGURE_BODY || part->role == FW_FIGURE_PLATE;
    return body && fw_report_outlined(layout, part->of);
}

static fw_status all_poses(fw_arena *arena, const film *f, fw_figure_pen *pen) {
    int n = f->motion->nbody, frames = f->frames;
    double *still, *frame;
    FW_NEED(still = fw_arena_array(arena, double, 3 * (size_t)n));
    FW_NEED(frame = fw_arena_array(arena, double, 3 * (size_t)n * (size_t)(frames + 1)));
    for (int b = 0; b < n; b++) {
        fw_report_pose_at(f->motion, b, f->still_s, still + 3 * b);
        for (int i = 0; i < frames; i++)
            fw_report_pose_at(f->motion, b, instant(f, i),
                              frame + 3 * ((size_t)i * (size_t)n + (size_t)b));
    }
    pen->still = still, pen->frame = frame;
    return FW_OK;
}

static void figure_ghost(const film *f, const fw_figure *figure, const fw_figure_pen *pen) {
    if (!f->ghost) return;
    fw_svg_open(f->out, "g fill='none' stroke='#8c959f' stroke-dasharray='4 3'\n");
    for (int i = 0; i < figure->count; i++)
        if (!shown(f->layout, &figure->part[i]))
            fw_figure_ghost(&figure->part[i], f->motion->q, pen);
    fw_svg_close(f->out, "g\n");
}

static void still_parts(const film *f) {
    if (!fw_report_drawn(f->layout)) return;
    fw_svg_path(f->out, "fill='#eceff2' stroke='#b6bec7' stroke-width='0.7'");
    for (int i = 0; i < f->layout->npiece; i++) {
        const fw_piece *p = &f->layout->piece[i];
        if (p->role == FW_ROLE_FRAME ||
            ((p->body == FW_GROUND || p->body == FW_ISLAND) && p->role == FW_ROLE_STRUCTURE))
            fw_report_path(f->out, f->view, &p->contour);
    }
    fw_svg_path_end(f->out);
}

/* enough key frames for smooth turns: a straight way between two of them cuts a corner */
static int frames_for(const film *f) {
    double most = 0.0;
    for (int b = 0; b < f->motion->nbody; b++) {
        double turned = 0.0;
        for (int k = 1; k < f->motion->nsample; k++) {
            const double *q = f->motion->q + 3 * ((size_t)k * (size_t)f->motion->nbody + (size_t)b);
            turned += fabs(q[2] - q[2 - 3 * f->motion->nbody]);
        }
        most = fmax(most, turned);
    }
    double wanted = most / 0.25;
    return wanted > MOST_FRAMES ? MOST_FRAMES : wanted > f->frames ? (int)wanted : f->frames;
}

fw_status fw_report_film_draw(fw_arena *arena, const fw_report_film *from) {
    film f = *from;
    fw_figure figure;
    fw_report_bends bends;
    FW_TRY(fw_figure_make(arena, f.mechanism, f.motion->q, f.motion->nsample, &figure));
    FW_TRY(fw_report_bends_make(arena, f.device, f.layout, &bends));
    long numbers = 1;
    for (int i = 0; i < figure.count; i++)
        numbers += shown(f.layout, &figure.part[i]) ? 0 : fw_figure_numbers(&figure.part[i]);
    for (int b = 0; b < f.motion->nbody; b++)
        numbers += fw_report_outlined(f.layout, b) ? 3 : 0;
    if (f.frames) f.frames = frames_for(&f);
    while (f.frames > 16 && f.frames * numbers > NUMBERS)
        f.frames = f.frames * 3 / 4;
    fw_figure_pen pen = {.view = f.view,
                         .out = f.out,
                         .nbody = f.motion->nbody,
                         .frames = f.frames,
                         .seconds = f.seconds,
                         .mark = f.small || f.motion->nbody > 30 ? 3.5 : 5.5};
    FW_TRY(all_poses(arena, &f, &pen));
    still_parts(&f);
    ghost(&f);
    bodies(&f);
    flexures(&f, &bends);
    for (int i = 0; i < figure.count; i++)
        if (!shown(f.layout, &figure.part[i])) fw_figure_draw(&figure.part[i], &pen);
    figure_ghost(&f, &figure, &pen);
    return fw_text_end(f.out);
}

/* ---- poses that are no motion in time ---- */

fw_status fw_report_poses(fw_arena *arena, const fw_mechanism *mechanism, int count, double *q,
                          fw_motion *motion) {
    *motion =
        (fw_motion){.nbody = mechanism->nbody, .npin = mechanism->npin, .nsample = count, .q = q};
    FW_NEED(motion->t_s = fw_arena_array(arena, double, (size_t)count));
    FW_NEED(motion->peak = fw_arena_array(arena, fw_peak, (size_t)mechanism->npin));
    for (int i = 0; i < count; i++)
        motion->t_s[i] = count > 1 ? (double)i / (count - 1) : 0.0;
    for (int i = 0; i < mechanism->npin; i++)
        motion->peak[i].angle_rad = (double)NAN; /* flexures without a colour of utilisation */
    return FW_OK;
}

/* corners of what is drawn of a body */
static void outline_reach(fw_box *box, const fw_layout *layout, const fw_mechanism *m, int body,
                          const fw_motion *motion) {
    int step = 1 + motion->nsample / REACH;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_piece *p = &layout->piece[i];
        if (p->body != body || p->role != FW_ROLE_STRUCTURE) continue;
        fw_box b = fw_contour_box(&p->contour);
        for (int k = motion->nsample - 1; k >= 0; k -= step)
            for (int c = 0; c < 4; c++) {
                fw_vec2 at = {c & 1 ? b.x1 : b.x0, c & 2 ? b.y1 : b.y0};
                at = fw_report_moved(m, motion, body, motion->t_s[k], at);
                fw_report_box_add(box, at.x, at.y);
            }
    }
}

fw_status fw_report_poses_reach(fw_arena *arena, fw_box *box, const fw_layout *layout,
                                const fw_mechanism *mechanism, const fw_motion *motion) {
    fw_figure figure;
    FW_TRY(fw_figure_make(arena, mechanism, motion->q, motion->nsample, &figure));
    for (int i = 0; i < figure.count; i++)
        if (!shown(layout, &figure.part[i]))
            fw_figure_reach(box, &figure.part[i], motion->q, motion->nsample, motion->nbody);
    for (int b = 0; b < motion->nbody; b++)
        if (fw_report_outlined(layout, b)) outline_reach(box, layout, mechanism, b, motion);
    return FW_OK;
}

fw_report_view fw_report_poses_view(const fw_device *device, const fw_layout *layout,
                                    const fw_box *reach, double width) {
    if (fw_report_drawn(layout)) return fw_report_device_view(device, layout, reach, width);
    return fw_figure_view(reach, width);
}
