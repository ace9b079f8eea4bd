/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mechanism at an instant, and its motion as a picture that plays by itself. */
#include "base/constants.h"
#include "flexure/path.h"
#include "report/figure.h"
#include "report/report_page.h"
#include <math.h>

enum { CHORDS_PER_TURN = 36 };

/* share of the upper body in the rotation of a point of the flexure: how far along the centre line
   it lies, 0 at the root of `lower`, 1 at the root of `upper` */
static double weight(const fw_layout_hinge_layout *h, const fw_device_flexure *f,
                     const fw_flexure_course *path, fw_geometry_vec2 p) {
    double c = cos(h->axis_rad), s = sin(h->axis_rad);
    double x = p.x - h->arc_centre.x, y = p.y - h->arc_centre.y;
    double lx = c * x + s * y, ly = -s * x + c * y;
    if (path) return fw_flexure_path_nearest(path, lx, ly);
    double w =
        f->kind == FW_FLEXURE_LEAF ? 0.5 + ly / f->length_m : 0.5 + atan2(ly, lx) / f->angle_rad;
    return isfinite(w) ? fmax(0.0, fmin(1.0, w)) : 0.5;
}

static int chords(const fw_geometry_segment *s) {
    if (s->kind == FW_LINE) return 1;
    return 1 + (int)(fmin(fabs(s->sweep_rad), 2.0 * FW_PI) / (2.0 * FW_PI) * CHORDS_PER_TURN);
}

static fw_geometry_vec2 along(const fw_geometry_segment *s, double u) {
    if (s->kind == FW_LINE)
        return (fw_geometry_vec2){s->a.x + u * (s->b.x - s->a.x), s->a.y + u * (s->b.y - s->a.y)};
    double c = cos(u * s->sweep_rad), d = sin(u * s->sweep_rad);
    double x = s->a.x - s->centre.x, y = s->a.y - s->centre.y;
    return (fw_geometry_vec2){s->centre.x + c * x - d * y, s->centre.y + d * x + c * y};
}

static fw_status bend_make(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                           const fw_layout_piece *piece, fw_report_bend *bend) {
    const fw_layout_hinge_layout *h = &layout->hinge[piece->joint];
    const fw_device_flexure *f = &device->flexure[device->revolute[piece->joint].flexure];
    const fw_geometry_contour *contour = &piece->contour;
    const fw_flexure_input in = fw_flexure_input_of(f, h->fillet_m);
    bool varies = fw_device_flexure_varies(f);
    fw_flexure_course path;
    if (varies) fw_flexure_path_of(&in, &path);
    int n = 0;
    for (int i = 0; i < contour->count; i++)
        n += chords(&contour->segment[i]);
    *bend = (fw_report_bend){.piece = piece,
                             .centre = h->centre,
                             .lower = h->lower,
                             .upper = h->upper,
                             .joint = piece->joint};
    FW_NEED(bend->point = fw_arena_array(arena, fw_report_bend_point, (size_t)n));
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        int m = chords(s);
        for (int k = 0; k < m; k++) {
            fw_geometry_vec2 p = along(s, (double)k / m);
            bend->point[bend->npoint++] =
                (fw_report_bend_point){p.x, p.y, weight(h, f, varies ? &path : NULL, p)};
        }
    }
    return FW_OK;
}

fw_status fw_report_bends_make(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               fw_report_bends *bends) {
    *bends = (fw_report_bends){0};
    if (!fw_report_drawn(layout) || !layout->hinge) return FW_OK;
    FW_NEED(bends->item = fw_arena_array(arena, fw_report_bend, (size_t)layout->npiece));
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->role != FW_ROLE_FLEXURE || p->joint < 0 || !layout->hinge[p->joint].drawn ||
            device->revolute[p->joint].flexure < 0)
            continue;
        FW_TRY(bend_make(arena, device, layout, p, &bends->item[bends->count]));
        bends->count++;
    }
    return FW_OK;
}

void fw_report_pose_at(const fw_dynamics_motion *motion, int body, double t_s, double pose[3]) {
    pose[0] = pose[1] = pose[2] = 0.0;
    if (body < 0 || body >= motion->nbody || motion->nsample == 0) return;
    int low = 0, high = motion->nsample - 1;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (motion->t_s[middle] <= t_s)
            low = middle;
        else
            high = middle;
    }
    double span = motion->t_s[high] - motion->t_s[low];
    double u = span > 0.0 ? fmax(0.0, fmin(1.0, (t_s - motion->t_s[low]) / span)) : 0.0;
    size_t wide = 3 * (size_t)motion->nbody;
    const double *a = motion->q + (size_t)low * wide + 3 * (size_t)body;
    const double *b = motion->q + (size_t)high * wide + 3 * (size_t)body;
    for (int k = 0; k < 3; k++)
        pose[k] = a[k] + u * (b[k] - a[k]);
}

fw_geometry_vec2 fw_report_moved(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                 int body, double t_s, fw_geometry_vec2 drawn) {
    if (body < 0 || body >= motion->nbody) return drawn;
    double pose[3];
    fw_report_pose_at(motion, body, t_s, pose);
    const fw_mechanism_mass *m = &mechanism->body[body];
    double c = cos(pose[2] - m->phi_rad), s = sin(pose[2] - m->phi_rad);
    double x = drawn.x - m->x_m, y = drawn.y - m->y_m;
    return (fw_geometry_vec2){pose[0] + c * x - s * y, pose[1] + s * x + c * y};
}

static double turned(const fw_mechanism *mechanism, const fw_dynamics_motion *motion, int body,
                     double t_s) {
    if (body < 0 || body >= motion->nbody) return 0.0;
    double pose[3];
    fw_report_pose_at(motion, body, t_s, pose);
    return pose[2] - mechanism->body[body].phi_rad;
}

/* p(t) = W(t) + R((1-w) a + w b) (p - W), a and b the rotations of the two bodies since the drawing
   and w the share along the centre line: meets both bodies exactly, in between an illustration. */
fw_geometry_vec2 fw_report_bent(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                const fw_report_bend *bend, double t_s,
                                fw_report_bend_point point) {
    fw_geometry_vec2 w = fw_report_moved(mechanism, motion, bend->lower, t_s, bend->centre);
    double a = turned(mechanism, motion, bend->lower, t_s);
    double b = turned(mechanism, motion, bend->upper, t_s);
    double angle = a + point.weight * (b - a), c = cos(angle), s = sin(angle);
    double x = point.x_m - bend->centre.x, y = point.y_m - bend->centre.y;
    return (fw_geometry_vec2){w.x + c * x - s * y, w.y + s * x + c * y};
}

void fw_report_reach_add(fw_geometry_box *box, const fw_device *device, const fw_layout *layout,
                         const fw_mechanism *mechanism, const fw_dynamics_motion *motion) {
    enum { INSTANTS = 64 };
    if (motion->nsample == 0) return;
    double end = motion->t_s[motion->nsample - 1];
    for (int j = 0; j < device->nrevolute; j++)
        for (int i = 0; i <= INSTANTS; i++) {
            fw_geometry_vec2 p =
                fw_report_moved(mechanism, motion, device->revolute[j].body_a, end * i / INSTANTS,
                                fw_report_hinge_point(device, layout, j));
            fw_report_box_add(box, p.x, p.y);
        }
}

double fw_report_pin_limit(const fw_mechanism *mechanism, int pin) {
    int h = pin >= 0 && pin < mechanism->npin ? mechanism->pin[pin].hinge : FW_NONE;
    if (h < 0 || h >= mechanism->nhinge) return (double)NAN;
    double limit = mechanism->hinge[h].closed_form.limit_angle_rad;
    return isfinite(limit) && limit > 0.0 ? limit : (double)NAN;
}

fw_report_worst fw_report_motion_worst(const fw_mechanism *mechanism,
                                       const fw_dynamics_motion *motion) {
    fw_report_worst worst = {.pin = FW_NONE};
    for (int k = 0; k < motion->npin; k++) {
        double u = fabs(motion->peak[k].angle_rad) / fw_report_pin_limit(mechanism, k);
        if (isfinite(u) && (worst.pin == FW_NONE || u > worst.utilisation))
            worst = (fw_report_worst){k, u, motion->peak[k].t_s};
    }
    if (!isfinite(worst.t_s)) worst.t_s = 0.0;
    return worst;
}

/* A mechanism that moves, as SVG elements that play by themselves: SMIL, which browsers run even
   inside <img>. Drawn bodies by nested transforms, flexures by their outline, everything else as in
   figure.h, all linear between key frames. With 0 frames: a still picture. */

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
static void from_drawn(const film *f, const fw_mechanism_mass *m) {
    fw_svg_open(f->out, "g transform='translate({c} {c})'", -fw_report_x(f->view, m->x_m),
                -fw_report_y(f->view, m->y_m));
}

/* the pose at t */
static void body_at(const film *f, int body, double t_s) {
    const fw_mechanism_mass *m = &f->mechanism->body[body];
    double pose[3];
    fw_report_pose_at(f->motion, body, t_s, pose);
    fw_svg_open(f->out, "g transform='translate({c} {c})'", fw_report_x(f->view, pose[0]),
                fw_report_y(f->view, pose[1]));
    fw_svg_open(f->out, "g transform='rotate({3})'", degrees(pose[2] - m->phi_rad));
    from_drawn(f, m);
}

/* the same, moving */
static void body_motion(const film *f, int body) {
    const fw_mechanism_mass *m = &f->mechanism->body[body];
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
        fw_geometry_vec2 p = fw_report_bent(f->mechanism, f->motion, bend, t_s, bend->point[k]);
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
static bool shown(const fw_layout *layout, const fw_report_figure_part *part) {
    if (part->pin != FW_NONE)
        return fw_report_drawn(layout) && layout->hinge && layout->hinge[part->pin].drawn;
    bool body = part->role == FW_FIGURE_BODY || part->role == FW_FIGURE_PLATE;
    return body && fw_report_outlined(layout, part->of);
}

static fw_status all_poses(fw_arena *arena, const film *f, fw_report_figure_pen *pen) {
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

static void figure_ghost(const film *f, const fw_report_drawing_figure *figure,
                         const fw_report_figure_pen *pen) {
    if (!f->ghost) return;
    fw_svg_open(f->out, "g fill='none' stroke='#8c959f' stroke-dasharray='4 3'\n");
    for (int i = 0; i < figure->count; i++)
        if (!shown(f->layout, &figure->part[i]))
            fw_report_figure_ghost(&figure->part[i], f->motion->q, pen);
    fw_svg_close(f->out, "g\n");
}

static void still_parts(const film *f) {
    if (!fw_report_drawn(f->layout)) return;
    fw_svg_path(f->out, "fill='#eceff2' stroke='#b6bec7' stroke-width='0.7'");
    for (int i = 0; i < f->layout->npiece; i++) {
        const fw_layout_piece *p = &f->layout->piece[i];
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
    fw_report_drawing_figure figure;
    fw_report_bends bends;
    FW_TRY(fw_report_figure_make(arena, f.mechanism, f.motion->q, f.motion->nsample, &figure));
    FW_TRY(fw_report_bends_make(arena, f.device, f.layout, &bends));
    long numbers = 1;
    for (int i = 0; i < figure.count; i++)
        numbers += shown(f.layout, &figure.part[i]) ? 0 : fw_report_figure_numbers(&figure.part[i]);
    for (int b = 0; b < f.motion->nbody; b++)
        numbers += fw_report_outlined(f.layout, b) ? 3 : 0;
    if (f.frames) f.frames = frames_for(&f);
    while (f.frames > 16 && f.frames * numbers > NUMBERS)
        f.frames = f.frames * 3 / 4;
    fw_report_figure_pen pen = {.view = f.view,
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
        if (!shown(f.layout, &figure.part[i])) fw_report_figure_draw(&figure.part[i], &pen);
    figure_ghost(&f, &figure, &pen);
    return fw_text_end(f.out);
}

/* ---- poses that are no motion in time ---- */

fw_status fw_report_poses(fw_arena *arena, const fw_mechanism *mechanism, int count, double *q,
                          fw_dynamics_motion *motion) {
    *motion = (fw_dynamics_motion){
        .nbody = mechanism->nbody, .npin = mechanism->npin, .nsample = count, .q = q};
    FW_NEED(motion->t_s = fw_arena_array(arena, double, (size_t)count));
    FW_NEED(motion->peak = fw_arena_array(arena, fw_dynamics_peak, (size_t)mechanism->npin));
    for (int i = 0; i < count; i++)
        motion->t_s[i] = count > 1 ? (double)i / (count - 1) : 0.0;
    for (int i = 0; i < mechanism->npin; i++)
        motion->peak[i].angle_rad = (double)NAN; /* flexures without a colour of utilisation */
    return FW_OK;
}

/* corners of what is drawn of a body */
static void outline_reach(fw_geometry_box *box, const fw_layout *layout, const fw_mechanism *m,
                          int body, const fw_dynamics_motion *motion) {
    int step = 1 + motion->nsample / REACH;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->body != body || p->role != FW_ROLE_STRUCTURE) continue;
        fw_geometry_box b = fw_geometry_contour_box(&p->contour);
        for (int k = motion->nsample - 1; k >= 0; k -= step)
            for (int c = 0; c < 4; c++) {
                fw_geometry_vec2 at = {c & 1 ? b.x1 : b.x0, c & 2 ? b.y1 : b.y0};
                at = fw_report_moved(m, motion, body, motion->t_s[k], at);
                fw_report_box_add(box, at.x, at.y);
            }
    }
}

fw_status fw_report_poses_reach(fw_arena *arena, fw_geometry_box *box, const fw_layout *layout,
                                const fw_mechanism *mechanism, const fw_dynamics_motion *motion) {
    fw_report_drawing_figure figure;
    FW_TRY(fw_report_figure_make(arena, mechanism, motion->q, motion->nsample, &figure));
    for (int i = 0; i < figure.count; i++)
        if (!shown(layout, &figure.part[i]))
            fw_report_figure_reach(box, &figure.part[i], motion->q, motion->nsample, motion->nbody);
    for (int b = 0; b < motion->nbody; b++)
        if (fw_report_outlined(layout, b)) outline_reach(box, layout, mechanism, b, motion);
    return FW_OK;
}

fw_report_view fw_report_poses_view(const fw_device *device, const fw_layout *layout,
                                    const fw_geometry_box *reach, double width) {
    if (fw_report_drawn(layout)) return fw_report_device_view(device, layout, reach, width);
    return fw_report_figure_view(reach, width);
}

/* The motion as an SVG that plays by itself. */

enum { WIDTH = 720, HEAD = 38, FRAMES = 120, PLAY_SECONDS = 8 };

static void progress(const fw_report_film *f) {
    fw_svg_open(f->out, "rect x='0' y='{c}' height='4' width='0' fill='#0072B2'",
                f->view->height - 4.0);
    fw_svg_put(
        f->out,
        "animate attributeName='width' from='0' to='{c}' dur='{i}s' repeatCount='indefinite'",
        f->view->width, f->seconds);
    fw_svg_close(f->out, "rect\n");
}

fw_status fw_report_animation_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                  const fw_device_scene *scene, fw_text *out) {
    if (motion->nsample < 2) return FW_USAGE;
    fw_geometry_box reach = fw_report_box_empty();
    FW_TRY(fw_report_poses_reach(arena, &reach, layout, mechanism, motion));
    fw_report_view view = fw_report_poses_view(device, layout, &reach, WIDTH);
    const fw_report_film clip = {.device = device,
                                 .layout = layout,
                                 .mechanism = mechanism,
                                 .motion = motion,
                                 .view = &view,
                                 .out = out,
                                 .frames = FRAMES,
                                 .seconds = PLAY_SECONDS};
    double height = HEAD + view.height;
    fw_svg_begin_picture(out, view.width, height, true);
    fw_svg_title(out, "{s}, scene {s}", device->name, scene->name);
    fw_svg_paper(out, "#fff");
    fw_svg_put(out,
               "text x='14' y='25' font-size='14' fill='#1f2328'>{s}, scene {s}: {u} in {i} s\n",
               device->name, scene->name, motion->t_s[motion->nsample - 1], "s", PLAY_SECONDS);
    fw_svg_inset(out, "y='{i}' width='{c}' height='{c}'", HEAD, view.width, view.height);
    FW_TRY(fw_report_film_draw(arena, &clip));
    fw_report_scale_bar_svg(out, &view);
    progress(&clip);
    fw_svg_end(out);
    fw_svg_end(out);
    return fw_text_end(out);
}
