/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion as an SVG that plays by itself: SMIL, which browsers run even inside <img>. Bodies by
   two nested transforms, flexures by their outline, both linear between key frames. */
#include "report/page.h"
#include <math.h>

static const double DEGREES = 57.29577951308232;

enum { WIDTH = 720, FRAMES = 120, PLAY_SECONDS = 8, NUMBERS = 100000 };

typedef struct film {
    const fw_mechanism *mechanism;
    const fw_motion *motion;
    const fw_report_view *view;
    fw_text *out;
    double end_s;
    int frames;
} film;

static double instant(const film *f, int frame) {
    return f->end_s * frame / (f->frames - 1);
}

static void timing(const film *f) {
    fw_report_markup(f->out, "dur=\"{i}s\" repeatCount=\"indefinite\"", PLAY_SECONDS);
}

static void body_motion(const film *f, int body) {
    const fw_mass *m = &f->mechanism->body[body];
    double pose[3];
    fw_report_pose_at(f->motion, body, 0.0, pose); /* for viewers that do not animate */
    fw_report_markup(f->out,
                     "<g transform=\"translate({c} {c})\"><animateTransform "
                     "attributeName=\"transform\" type=\"translate\" ",
                     fw_report_x(f->view, pose[0]), fw_report_y(f->view, pose[1]));
    timing(f);
    fw_text_add(f->out, " values=\"");
    for (int i = 0; i < f->frames; i++) {
        fw_report_pose_at(f->motion, body, instant(f, i), pose);
        fw_report_markup(f->out, "{r}{c} {c}", i ? ";" : "", fw_report_x(f->view, pose[0]),
                         fw_report_y(f->view, pose[1]));
    }
    fw_text_add(f->out, "\"/><g><animateTransform attributeName=\"transform\" type=\"rotate\" ");
    timing(f);
    fw_text_add(f->out, " values=\"");
    for (int i = 0; i < f->frames; i++) {
        fw_report_pose_at(f->motion, body, instant(f, i), pose);
        double turn = -DEGREES * (pose[2] - m->phi_rad);
        fw_text_add(f->out, i ? ";" : "");
        fw_text_fixed(f->out, isfinite(turn) ? turn : 0.0, 3);
    }
    fw_report_markup(f->out, "\"/><g transform=\"translate({c} {c})\">",
                     -fw_report_x(f->view, m->x_m), -fw_report_y(f->view, m->y_m));
}

static void bodies(const film *f, const fw_device *device, const fw_layout *layout) {
    bool drawn = fw_report_drawn(layout);
    for (int b = 0; b < f->motion->nbody; b++) {
        bool platform = device->body[b].platform;
        body_motion(f, b);
        if (drawn)
            fw_report_markup(f->out,
                             "<path fill=\"{r}\" stroke=\"#57606a\" stroke-width=\"0.7\" d=\"",
                             platform ? "#bcd0e3" : "#d5dbe1");
        else
            fw_report_markup(f->out,
                             "<path fill=\"none\" stroke=\"{r}\" stroke-width=\"7\" "
                             "stroke-linecap=\"round\" d=\"",
                             platform ? "#7f9fbd" : "#9aa4ae");
        if (drawn)
            fw_report_body_path(layout, b, f->view, f->out);
        else
            fw_report_body_sticks(device, b, f->view, f->out);
        fw_text_add(f->out, "\"/></g></g></g>\n");
    }
}

static void outline(const film *f, const fw_report_bend *bend, double t_s) {
    for (int k = 0; k < bend->npoint; k++) {
        fw_vec2 p = fw_report_bent(f->mechanism, f->motion, bend, t_s, bend->point[k]);
        fw_report_markup(f->out, "{r}{c} {c}", k ? "L" : "M", fw_report_x(f->view, p.x),
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
        fw_report_markup(f->out, "<path fill=\"{r}\" stroke=\"{r}\" stroke-width=\"1.2\" d=\"",
                         colour, colour);
        outline(f, bend, 0.0);
        fw_text_add(f->out, "\"><animate attributeName=\"d\" ");
        timing(f);
        fw_text_add(f->out, " values=\"");
        for (int k = 0; k < coarse.frames; k++) {
            fw_text_add(f->out, k ? ";" : "");
            outline(f, bend, instant(&coarse, k));
        }
        fw_text_add(f->out, "\"/></path>\n");
    }
}

static void pins(const film *f, const fw_layout *layout) {
    for (int k = 0; k < f->motion->npin; k++) {
        if (fw_report_drawn(layout) && layout->hinge && layout->hinge[k].drawn) continue;
        const fw_pin *pin = &f->mechanism->pin[k];
        fw_text_add(f->out,
                    "<circle r=\"4.5\" fill=\"#fff\" stroke=\"#1f2328\" stroke-width=\"1.5\">"
                    "<animateTransform attributeName=\"transform\" type=\"translate\" ");
        timing(f);
        fw_text_add(f->out, " values=\"");
        for (int i = 0; i < f->frames; i++) {
            double pose[3];
            fw_report_pose_at(f->motion, pin->body_a, instant(f, i), pose);
            double c = cos(pose[2]), s = sin(pose[2]);
            fw_report_markup(f->out, "{r}{c} {c}", i ? ";" : "",
                             fw_report_x(f->view, pose[0] + c * pin->ax_m - s * pin->ay_m),
                             fw_report_y(f->view, pose[1] + s * pin->ax_m + c * pin->ay_m));
        }
        fw_text_add(f->out, "\"/></circle>\n");
    }
}

static void still_parts(const film *f, const fw_layout *layout) {
    if (!fw_report_drawn(layout)) return;
    fw_text_add(f->out, "<path fill=\"#eceff2\" stroke=\"#b6bec7\" stroke-width=\"0.7\" d=\"");
    for (int i = 0; i < layout->npiece; i++) {
        const fw_piece *p = &layout->piece[i];
        if (p->role == FW_ROLE_FRAME || (p->body == FW_GROUND && p->role == FW_ROLE_STRUCTURE))
            fw_report_path(f->out, f->view, &p->contour);
    }
    fw_text_add(f->out, "\"/>\n");
}

static void caption(const film *f, const char *device, const char *scene) {
    fw_report_markup(f->out,
                     "<text x=\"14\" y=\"24\" font-size=\"14\" fill=\"#1f2328\">{s}, scene {s}: "
                     "{u} in {i} s</text>\n",
                     device, scene, f->end_s, "s", PLAY_SECONDS);
    fw_report_markup(f->out,
                     "<rect x=\"0\" y=\"{c}\" height=\"4\" width=\"0\" fill=\"#0072B2\">"
                     "<animate attributeName=\"width\" from=\"0\" to=\"{c}\" ",
                     f->view->height - 4.0, f->view->width);
    timing(f);
    fw_text_add(f->out, "/></rect>\n");
}

fw_status fw_report_animation_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_mechanism *mechanism, const fw_motion *motion,
                                  const fw_scene *scene, fw_text *out) {
    if (motion->nsample < 2) return FW_USAGE;
    fw_box reach = fw_report_box_empty();
    fw_report_reach_add(&reach, device, layout, mechanism, motion);
    fw_report_view view = fw_report_device_view(device, layout, &reach, WIDTH);
    film f = {mechanism, motion, &view, out, motion->t_s[motion->nsample - 1], FRAMES};
    while (f.frames > 16 && (long)f.frames * motion->nbody * 3 > NUMBERS)
        f.frames = f.frames * 3 / 4;
    fw_report_bends bends;
    FW_TRY(fw_report_bends_make(arena, device, layout, &bends));
    fw_report_markup(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {c} {c}\" "
        "width=\"{c}\" height=\"{c}\" font-family=\"system-ui,'DejaVu Sans',"
        "sans-serif\">\n<title>{s}, scene {s}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        view.width, view.height, view.width, view.height, device->name, scene->name);
    still_parts(&f, layout);
    bodies(&f, device, layout);
    flexures(&f, &bends);
    pins(&f, layout);
    fw_report_scale_bar_svg(out, &view);
    caption(&f, device->name, scene->name);
    fw_text_add(out, "</svg>\n");
    return fw_text_end(out);
}
