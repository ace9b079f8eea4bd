/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion as an SVG that plays by itself. */
#include "report/page.h"

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
                                  const fw_mechanism *mechanism, const fw_motion *motion,
                                  const fw_scene *scene, fw_text *out) {
    if (motion->nsample < 2) return FW_USAGE;
    fw_box reach = fw_report_box_empty();
    FW_TRY(fw_report_poses_reach(arena, &reach, layout, mechanism, motion));
    fw_report_view view = fw_report_poses_view(device, layout, &reach, WIDTH);
    const fw_report_film film = {.device = device,
                                 .layout = layout,
                                 .mechanism = mechanism,
                                 .motion = motion,
                                 .view = &view,
                                 .out = out,
                                 .frames = FRAMES,
                                 .seconds = PLAY_SECONDS};
    double height = HEAD + view.height;
    fw_svg_begin(out, &(fw_svg_frame){.width = view.width,
                                      .height = height,
                                      .decimals = 2,
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .file = true,
                                      .lead = "role='img'",
                                      .font = fw_svg_font_page});
    fw_svg_title(out, "{s}, scene {s}", device->name, scene->name);
    fw_svg_paper(out, "#fff");
    fw_svg_put(out,
               "text x='14' y='25' font-size='14' fill='#1f2328'>{s}, scene {s}: {u} in {i} s\n",
               device->name, scene->name, motion->t_s[motion->nsample - 1], "s", PLAY_SECONDS);
    fw_svg_inset(out, "y='{i}' width='{c}' height='{c}'", HEAD, view.width, view.height);
    FW_TRY(fw_report_film_draw(arena, &film));
    fw_report_scale_bar_svg(out, &view);
    progress(&film);
    fw_svg_end(out);
    fw_svg_end(out);
    return fw_text_end(out);
}
