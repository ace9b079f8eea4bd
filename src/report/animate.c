/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion as an SVG that plays by itself. */
#include "report/page.h"

enum { WIDTH = 720, FRAMES = 120, PLAY_SECONDS = 8 };

static void caption(const fw_report_film *f, const char *device, const char *scene) {
    fw_report_markup(f->out,
                     "<text x=\"14\" y=\"24\" font-size=\"14\" fill=\"#1f2328\">{s}, scene {s}: "
                     "{u} in {i} s</text>\n",
                     device, scene, f->motion->t_s[f->motion->nsample - 1], "s", f->seconds);
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
    fw_report_reach_add(&reach, device, layout, mechanism, motion);
    fw_report_view view = fw_report_device_view(device, layout, &reach, WIDTH);
    const fw_report_film film = {.device = device,
                                 .layout = layout,
                                 .mechanism = mechanism,
                                 .motion = motion,
                                 .view = &view,
                                 .out = out,
                                 .frames = FRAMES,
                                 .seconds = PLAY_SECONDS};
    fw_report_markup(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {c} {c}\" "
        "width=\"{c}\" height=\"{c}\" font-family=\"system-ui,'DejaVu Sans',"
        "sans-serif\">\n<title>{s}, scene {s}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        view.width, view.height, view.width, view.height, device->name, scene->name);
    FW_TRY(fw_report_film_draw(arena, &film));
    fw_report_scale_bar_svg(out, &view);
    caption(&film, device->name, scene->name);
    fw_text_add(out, "</svg>\n");
    return fw_text_end(out);
}
