/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mode shapes over the mechanism: one panel each, every one plays its own period. */
#include "report/page.h"
#include "report/rest.h"
#include <math.h>

enum { PANEL = 330, GAP = 10, HEAD = 40, CAPTION = 44, FRAMES = 25, SECONDS = 2, STILL = 6 };

typedef struct sheet {
    fw_arena *arena;
    const fw_device *device;
    const fw_layout *layout;
    const fw_mechanism *mechanism;
    const fw_modes *modes;
    fw_report_view view;
    fw_text *out;
} sheet;

static int drawn_modes(const fw_modes *modes) {
    int n = 0;
    while (n < modes->count && modes->mode[n].frame)
        n++;
    return n;
}

static void caption(const sheet *s, int k) {
    const fw_mode *m = &s->modes->mode[k];
    double y = s->view.height + 16.0;
    fw_svg_open(s->out, "text x='4' y='{c}' font-size='13' fill='#1f2328'", y);
    fw_svg_put(s->out, "tspan font-weight='700'>{i}", k + 1);
    fw_text_add(s->out, "  ");
    if (m->kind == FW_MODE_OSCILLATION || m->kind == FW_MODE_OVERDAMPED)
        fw_markup(s->out, "{u}, damping {p}", m->f_Hz, "Hz", m->damping_ratio);
    if (m->kind != FW_MODE_OSCILLATION)
        fw_markup(s->out, "{r}{s}", m->omega_rad_per_s > 0 ? ", " : "", fw_mode_kind_text(m->kind));
    if (m->kind == FW_MODE_UNSTABLE)
        fw_markup(s->out, ", grows with {n} 1/s", m->eigenvalue_per_s[0][0]);
    fw_svg_close(s->out, "text");
    fw_svg_put(s->out, "text x='4' y='{c}' font-size='11' fill='#57606a'>moves {s}\n", y + 16.0,
               m->bodies);
}

static fw_status panel(const sheet *s, int k, double x, double y) {
    fw_motion motion;
    FW_TRY(
        fw_report_poses(s->arena, s->mechanism, FW_MODE_FRAMES, s->modes->mode[k].frame, &motion));
    const fw_report_film film = {.device = s->device,
                                 .layout = s->layout,
                                 .mechanism = s->mechanism,
                                 .motion = &motion,
                                 .view = &s->view,
                                 .out = s->out,
                                 .frames = FRAMES,
                                 .seconds = SECONDS,
                                 .still_s = motion.t_s[STILL],
                                 .ghost = true,
                                 .small = true};
    fw_svg_open(s->out, "g transform='translate({c} {c})'", x, y);
    fw_svg_inset(s->out, "width='{c}' height='{c}' viewBox='0 0 {c} {c}'", s->view.width,
                 s->view.height, s->view.width, s->view.height);
    fw_svg_put(s->out, "rect width='100%' height='100%' fill='#fff' stroke='#d0d7de'\n");
    FW_TRY(fw_report_film_draw(s->arena, &film));
    if (k == 0) fw_report_scale_bar_svg(s->out, &s->view);
    fw_svg_end(s->out);
    caption(s, k);
    fw_svg_close(s->out, "g\n");
    return fw_text_end(s->out);
}

static fw_status reach(sheet *s, int count) {
    fw_box box = fw_report_box_empty();
    for (int k = 0; k < count; k++) {
        fw_motion motion;
        FW_TRY(fw_report_poses(s->arena, s->mechanism, FW_MODE_FRAMES, s->modes->mode[k].frame,
                               &motion));
        FW_TRY(fw_report_poses_reach(s->arena, &box, s->layout, s->mechanism, &motion));
    }
    s->view = fw_report_poses_view(s->device, s->layout, &box, PANEL);
    return FW_OK;
}

fw_status fw_report_modes_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                              const fw_mechanism *mechanism, const fw_scene *scene,
                              const fw_modes *modes, fw_text *out) {
    sheet s = {.arena = arena,
               .device = device,
               .layout = layout,
               .mechanism = mechanism,
               .modes = modes,
               .out = out};
    int count = drawn_modes(modes), columns = count < 3 ? (count > 0 ? count : 1) : 3;
    int rows = (count + columns - 1) / columns;
    FW_TRY(reach(&s, count));
    double width = columns * (PANEL + GAP) + GAP, high = s.view.height + CAPTION;
    if (width < 480.0) width = 480.0;
    double height = HEAD + rows * (high + GAP) + 14.0;
    fw_svg_begin(out, &(fw_svg_frame){.width = width,
                                      .height = height,
                                      .decimals = 2,
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .file = true,
                                      .lead = "role='img'",
                                      .font = fw_svg_font_page});
    fw_svg_title(out, "{s}: modes", device->name);
    fw_svg_paper(out, "#fff");
    fw_svg_put(
        out,
        "text x='{i}' y='25' font-size='15' font-weight='600' fill='#1f2328'>{s}: modes {r}{s}\n",
        GAP, device->name,
        modes->at_equilibrium ? "about the equilibrium in scene " : "about rest, scene ",
        scene->name ? scene->name : "");
    for (int k = 0; k < count; k++)
        FW_TRY(
            panel(&s, k, GAP + (k % columns) * (PANEL + GAP), HEAD + (k / columns) * (high + GAP)));
    fw_svg_open(out, "text x='{i}' y='{c}' font-size='11' fill='#57606a'", GAP, height - 8.0);
    fw_markup(out, "{r}",
              count ? "Amplitudes are enlarged; dashed: the pose of rest."
                    : "Joints and drivers leave nothing free to oscillate.");
    if (count < modes->count) fw_markup(out, " The first {i} of {i} modes.", count, modes->count);
    fw_svg_close(out, "text\n");
    fw_svg_end(out);
    return fw_text_end(out);
}
