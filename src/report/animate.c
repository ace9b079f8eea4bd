/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion as an SVG that plays by itself. */
#include "report/page.h"

enum { WIDTH = 720, HEAD = 38, FRAMES = 120, PLAY_SECONDS = 8 };

static void progress(const fw_report_film *f) {
    fw_report_markup(f->out,
                     "<rect x=\"0\" y=\"{c}\" height=\"4\" width=\"0\" fill=\"#0072B2\">"
                     "<animate attributeName=\"width\" from=\"0\" to=\"{c}\" dur=\"{i}s\" "
                     "repeatCount=\"indefinite\"/></rect>\n",
                     f->view->height - 4.0, f->view->width, f->seconds);
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
    fw_report_markup(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {c} {c}\" "
        "width=\"{c}\" height=\"{c}\" font-family=\"system-ui,'DejaVu Sans',"
        "sans-serif\">\n<title>{s}, scene {s}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<text x=\"14\" y=\"25\" font-size=\"14\" fill=\"#1f2328\">{s}, scene {s}: {u} in {i} s"
        "</text>\n<svg y=\"{i}\" width=\"{c}\" height=\"{c}\">\n",
        view.width, height, view.width, height, device->name, scene->name, device->name,
        scene->name, motion->t_s[motion->nsample - 1], "s", PLAY_SECONDS, HEAD, view.width,
        view.height);
    FW_TRY(fw_report_film_draw(arena, &film));
    fw_report_scale_bar_svg(out, &view);
    progress(&film);
    fw_text_add(out, "</svg>\n</svg>\n");
    return fw_text_end(out);
}
