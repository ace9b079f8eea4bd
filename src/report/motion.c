/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/constants.h"
#include "base/json.h"
#include "quantity/law_kind.h"
#include "report/report_page.h"
#include <math.h>
#include <string.h>

/* The moving picture of the page: a still at the worst instant, drawn here, and the numbers from
   which the script moves it. */

enum { FRAMES = 400, FEWEST_FRAMES = 30, NUMBERS = 60000 }; /* NUMBERS: in the whole page */

#define PLACED                                                                                     \
    " class='body' data-body='{i}'"                                                                \
    " transform='translate({c} {c}) rotate({4}) translate({c} {c})'"

/* translate(now) rotate translate(-then): picture coordinates, clockwise positive */
static void moving_bodies(const fw_report_page *page, const fw_mechanism *mechanism,
                          const fw_dynamics_motion *motion, double t_s) {
    const fw_report_view *view = &page->view;
    bool drawn = fw_report_drawn(page->in->layout);
    for (int b = 0; b < motion->nbody; b++) {
        const fw_mechanism_mass *m = &mechanism->body[b];
        double pose[3];
        bool platform = page->in->device->body[b].platform;
        fw_report_pose_at(motion, b, t_s, pose);
        double x = fw_report_x(view, pose[0]), y = fw_report_y(view, pose[1]);
        double x0 = -fw_report_x(view, m->x_m), y0 = -fw_report_y(view, m->y_m);
        double turn = -FW_DEG_PER_RAD * (pose[2] - m->phi_rad);
        if (drawn)
            fw_svg_open(page->out, "g" PLACED " fill='{r}' stroke='#57606a' stroke-width='0.7'", b,
                        x, y, turn, x0, y0, platform ? "#bcd0e3" : "#d5dbe1");
        else
            fw_svg_open(page->out,
                        "g" PLACED " fill='#8c959f' fill-opacity='0.25' stroke='{r}' "
                        "stroke-width='5' stroke-linecap='round' stroke-linejoin='round'",
                        b, x, y, turn, x0, y0, platform ? "#7f9fbd" : "#8c959f");
        fw_svg_put(page->out, "use href='#fw-b{i}'", b);
        fw_svg_close(page->out, "g\n");
    }
}

static void flexures(const fw_report_page *page, const fw_mechanism *mechanism,
                     const fw_dynamics_motion *motion, const fw_report_bends *bends, double t_s) {
    fw_text *out = page->out;
    for (int i = 0; i < bends->count; i++) {
        const fw_report_bend *bend = &bends->item[i];
        double limit = fw_report_pin_limit(mechanism, bend->joint);
        double a[3], b[3];
        fw_report_pose_at(motion, mechanism->pin[bend->joint].body_a, t_s, a);
        fw_report_pose_at(motion, mechanism->pin[bend->joint].body_b, t_s, b);
        double angle = b[2] - a[2] - mechanism->pin[bend->joint].free_angle_rad;
        const char *colour = fw_report_utilisation_colour(fabs(angle) / limit);
        fw_svg_path(out, "class='flexure' fill='{r}' stroke='{r}' stroke-width='1.2'", colour,
                    colour);
        for (int k = 0; k < bend->npoint; k++) {
            fw_geometry_vec2 p = fw_report_bent(mechanism, motion, bend, t_s, bend->point[k]);
            fw_markup(out, "{r}{c} {c}", k ? "L" : "M", fw_report_x(&page->view, p.x),
                      fw_report_y(&page->view, p.y));
        }
        fw_text_add(out, "Z");
        fw_svg_path_end(out);
    }
}

static void platform_trace(const fw_report_page *page, const fw_dynamics_motion *motion) {
    const fw_device *device = page->in->device;
    for (int b = 0; b < motion->nbody; b++) {
        if (!device->body[b].platform || motion->nsample < 2) continue;
        int step = 1 + motion->nsample / FRAMES;
        fw_svg_path(page->out,
                    "fill='none' stroke='#0072B2' stroke-width='1' stroke-opacity='0.55'");
        for (int i = 0; i < motion->nsample; i += step) {
            const double *q = motion->q + ((size_t)i * (size_t)motion->nbody + (size_t)b) * 3;
            fw_markup(page->out, "{r}{c} {c}", i ? "L" : "M", fw_report_x(&page->view, q[0]),
                      fw_report_y(&page->view, q[1]));
        }
        fw_svg_path_end(page->out);
    }
}

static void force_arrows(const fw_dynamics_motion *motion, const fw_device_scene *scene, double t_s,
                         const fw_report_view *view, fw_text *out) {
    for (int i = 0; i < scene->nforce; i++) {
        const fw_device_force *f = &scene->force[i];
        double size = hypot(f->fx_N, f->fy_N), pose[3];
        if (!(size > 0.0) || !isfinite(size) || f->body < 0 || f->body >= motion->nbody) continue;
        fw_report_pose_at(motion, f->body, t_s, pose);
        double c = cos(pose[2]), s = sin(pose[2]);
        double x = pose[0] + c * f->x_m - s * f->y_m, y = pose[1] + s * f->x_m + c * f->y_m;
        double dx = f->fx_N / size, dy = -f->fy_N / size;
        /* the tip points at where the force acts */
        fw_svg_open(out, "g class='force' data-force='{i}' transform='translate({c} {c})'", i,
                    fw_report_x(view, x), fw_report_y(view, y));
        fw_svg_put(out,
                   "path d='M{c} {c}L0 0M{c} {c}L0 0L{c} {c}' fill='none' stroke='#8E3B6F' "
                   "stroke-width='2'",
                   -44.0 * dx, -44.0 * dy, -9.0 * dx - 4.0 * dy, -9.0 * dy + 4.0 * dx,
                   -9.0 * dx + 4.0 * dy, -9.0 * dy - 4.0 * dx);
        fw_svg_put(
            out,
            "text x='{c}' y='{c}' font-size='13' fill='#8E3B6F' text-anchor='middle'>{u}{r}{r}",
            -58.0 * dx, -54.0 * dy + 4.0, size, "N", f->law ? " \u00d7 " : "",
            f->law ? fw_quantity_law_name(f->law) : "");
        fw_svg_close(out, "g\n");
    }
}

/* ---- numbers for the script: px and degrees, so that it needs no units ---- */

static void plain(fw_json *json, double value, int decimals) {
    fw_json_fixed(json, NULL, isfinite(value) ? value : 0.0, decimals);
}

/* a length on the page, no farther away than anybody looks */
static void px(fw_json *json, double value) {
    plain(json, fmax(-1e6, fmin(1e6, value)), 2);
}

static void frames_data(fw_json *json, const fw_report_page *page, const fw_dynamics_motion *motion,
                        int frames) {
    double end = motion->t_s[motion->nsample - 1];
    fw_json_list(json, "t");
    for (int i = 0; i < frames; i++)
        fw_json_number(json, NULL, end * i / (frames - 1), 6);
    fw_json_end(json);
    fw_json_line(json, 0);
    fw_json_list(json, "q");
    for (int i = 0; i < frames; i++)
        for (int b = 0; b < motion->nbody; b++) {
            double pose[3];
            fw_report_pose_at(motion, b, end * i / (frames - 1), pose);
            plain(json, fw_report_x(&page->view, pose[0]), 2);
            plain(json, fw_report_y(&page->view, pose[1]), 2);
            plain(json, FW_DEG_PER_RAD * pose[2], 4);
        }
    fw_json_end(json);
}

static void model_data(fw_json *json, const fw_report_page *page, const fw_mechanism *mechanism,
                       const fw_dynamics_motion *motion) {
    fw_json_line(json, 0);
    fw_json_list(json, "b");
    for (int b = 0; b < motion->nbody; b++) {
        const fw_mechanism_mass *m = &mechanism->body[b];
        fw_json_list(json, NULL);
        px(json, fw_report_x(&page->view, m->x_m));
        px(json, fw_report_y(&page->view, m->y_m));
        plain(json, FW_DEG_PER_RAD * m->phi_rad, 4);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_line(json, 0);
    fw_json_list(json, "p");
    for (int k = 0; k < motion->npin; k++) {
        const fw_mechanism_pin *p = &mechanism->pin[k];
        fw_json_list(json, NULL);
        fw_json_whole(json, NULL, p->body_a);
        fw_json_whole(json, NULL, p->body_b);
        plain(json, FW_DEG_PER_RAD * p->free_angle_rad, 6);
        plain(json, FW_DEG_PER_RAD * fw_report_pin_limit(mechanism, k), 6); /* 0: none */
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void bend_data(fw_json *json, const fw_report_view *view, const fw_report_bend *bend) {
    fw_json_list(json, NULL);
    fw_json_whole(json, NULL, bend->joint);
    fw_json_whole(json, NULL, bend->lower);
    fw_json_whole(json, NULL, bend->upper);
    px(json, fw_report_x(view, bend->centre.x));
    px(json, fw_report_y(view, bend->centre.y));
    fw_json_list(json, NULL);
    for (int k = 0; k < bend->npoint; k++) {
        px(json, fw_report_x(view, bend->point[k].x_m));
        px(json, fw_report_y(view, bend->point[k].y_m));
        plain(json, bend->point[k].weight, 3);
    }
    fw_json_end(json);
    fw_json_end(json);
}

static void shape_data(fw_json *json, const fw_report_page *page, const fw_report_bends *bends,
                       const fw_device_scene *scene) {
    const fw_report_view *view = &page->view;
    fw_json_line(json, 0);
    fw_json_list(json, "f");
    for (int i = 0; i < bends->count; i++) {
        if (i) fw_json_line(json, 0);
        bend_data(json, view, &bends->item[i]);
    }
    fw_json_end(json);
    fw_json_line(json, 0);
    fw_json_list(json, "a");
    for (int i = 0; i < scene->nforce; i++) {
        const fw_device_force *f = &scene->force[i];
        fw_json_list(json, NULL);
        fw_json_whole(json, NULL, f->body);
        px(json, f->x_m * view->scale);
        px(json, f->y_m * view->scale);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static int frames_of(const fw_report_page *page, const fw_dynamics_motion *motion) {
    if (motion->nsample < 2 || motion->nbody < 1) return 0;
    int share = NUMBERS / (page->nmotion > 0 ? page->nmotion : 1) / (3 * motion->nbody);
    int frames = share < FRAMES ? share : FRAMES;
    frames = frames < motion->nsample ? frames : motion->nsample;
    return frames >= FEWEST_FRAMES || frames == motion->nsample ? frames : 0;
}

static void controls(fw_text *out, int number) {
    fw_markup(out,
              "<div class=\"controls\" hidden=\"hidden\"><button type=\"button\" "
              "class=\"play\">Play</button><label>Speed <select class=\"speed\">"
              "<option value=\"0.25\">\u00bc</option><option value=\"0.5\">\u00bd</option>"
              "<option value=\"1\" selected=\"selected\">1</option>"
              "<option value=\"2\">2</option><option value=\"4\">4</option></select></label>"
              "<input class=\"time\" type=\"range\" min=\"0\" max=\"1000\" step=\"1\" "
              "value=\"0\" aria-label=\"Time in scene {i}\"/><output class=\"now\"></output>"
              "</div>\n",
              number);
}

/* player of one motion: still picture at the worst instant, controls, data for the script */
static fw_status player(fw_report_page *page, const fw_verdict_variant_verdict *variant, int scene,
                        int number) {
    const fw_dynamics_motion *motion = variant->motion[scene];
    const fw_mechanism *mechanism = variant->mechanism;
    const fw_device_scene *s = &mechanism->device->scene[scene];
    fw_report_worst worst = fw_report_motion_worst(mechanism, motion);
    fw_report_bends bends;
    FW_TRY(fw_report_bends_make(page->arena, page->in->device, page->in->layout, &bends));
    fw_text *out = page->out;
    fw_svg_begin(out, &(fw_svg_frame){.width = page->view.width,
                                      .height = page->view.height,
                                      .decimals = 2,
                                      .lead = "class='stage' role='img'"});
    fw_svg_title(out, "{s}: the mechanism at {u}", s->name, worst.t_s, "s");
    if (fw_report_drawn(page->in->layout))
        fw_svg_put(out,
                   "use href='#fw-fixed' fill='#eceff2' stroke='#b6bec7' stroke-width='0.7'\n");
    fw_svg_open(out, "g fill='none' stroke='#8c959f' stroke-width='0.8' stroke-dasharray='3 2'");
    for (int b = 0; b < motion->nbody; b++)
        fw_svg_put(out, "use href='#fw-b{i}'", b);
    fw_svg_close(out, "g\n");
    moving_bodies(page, mechanism, motion, worst.t_s);
    flexures(page, mechanism, motion, &bends, worst.t_s);
    platform_trace(page, motion);
    force_arrows(motion, s, worst.t_s, &page->view, out);
    fw_report_scale_bar_svg(out, &page->view);
    fw_svg_end(out);
    int frames = frames_of(page, motion);
    if (frames < 2) return fw_text_end(out);
    controls(out, number);
    fw_text_add(out, "<script type=\"application/json\">");
    fw_json json = fw_json_new(out, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    frames_data(&json, page, motion, frames);
    model_data(&json, page, mechanism, motion);
    shape_data(&json, page, &bends, s);
    fw_json_line(&json, 0);
    fw_json_number(&json, "at", worst.t_s, 6);
    fw_json_end(&json);
    return fw_json_finish(&json, "</script>\n");
}

enum { CURVES = 90 }; /* at full resolution in the whole page */

/* the value of an attribute in the words of a law; false: as it is when it is not given */
static bool attribute(fw_text *out, const fw_quantity_law *law, const char *name, size_t n) {
    const fw_quantity_law_attribute *a = law->kind->attribute, *end = a + law->kind->attributes;
    while (a < end && !(strlen(a->name) == n && memcmp(a->name, name, n) == 0))
        a++;
    if (a == end) return false;
    double value = fw_quantity_law_number(law, a);
    if (a->whole)
        fw_text_fixed(out, value, 0);
    else
        fw_markup(out, "{u}", value, a->si_unit);
    return value != a->absent;
}

/* the words of a law's row (quantity/law_kind.h) from `words` up to the character `stop`; *given:
   some attribute among them has a value of its own */
static const char *words(fw_text *out, const fw_quantity_law *law, const char *words_, char stop,
                         bool *given) {
    const char *at = words_;
    for (; *at && *at != stop; at++) {
        if (*at == '[') {
            bool own = false;
            fw_text part = fw_text_new(out->arena);
            at = words(&part, law, at + 1, ']', &own);
            if (fw_text_end(&part) != FW_OK) out->failed = 1;
            if (own) fw_text_bytes(out, part.data, part.length);
        } else if (*at == '{') {
            size_t n = strcspn(at + 1, "}");
            *given = attribute(out, law, at + 1, n) || *given;
            at += n + 1;
        } else
            fw_text_bytes(out, at, 1);
    }
    return at;
}

static void write_law(void *context, const fw_quantity_law *law) {
    fw_text *out = context;
    bool given = false;
    if (!law) return;
    fw_markup(out, " times a {s}", law->kind->name);
    words(out, law, law->kind->words, '\0', &given);
}

static void write_markup(void *context, const char *format, va_list arguments) {
    va_list own;
    va_copy(own, arguments);
    fw_markup_part(context, format, strlen(format), '\'', &own);
    va_end(own);
}

static void loads(fw_text *out, const fw_device *device, const fw_device_scene *s) {
    fw_markup(out, "<p class=\"soft\">{u}", s->duration_s, "s");
    fw_effects_describe(device, s, &(fw_effects_words){write_markup, write_law, out});
    for (int i = 0; i < device->ndriver; i++)
        fw_markup(out, "; joint {s} driven in time", device->driver[i].id);
    fw_text_add(out,
                ". Dashed: as drawn. Blue trace: centre of the platform. The still picture shows "
                "the worst instant.");
    if (device->die.tethers)
        fw_text_add(out, " Tethers are not drawn here: they are broken at the bodies before use.");
    fw_text_add(out, "</p>\n");
}

static fw_status one(fw_report_page *page, const fw_verdict_variant_verdict *v, int scene,
                     int number) {
    fw_text *out = page->out;
    const fw_device *device = page->in->device;
    const fw_device_scene *s = &device->scene[scene];
    const char *flow = v->variant ? v->variant->flow : NULL;
    char *title = fw_arena_printf(page->arena, "Hinge angles in %s%s", FW_NAMED("scene", s->name));
    FW_NEED(title);
    fw_markup(out, "<figure class=\"motion\" id=\"motion-{i}\"><figcaption><h3>{s}{r}{s}</h3>\n",
              number, s->name, flow ? ", " : "", flow);
    loads(out, device, s);
    fw_text_add(out, "</figcaption>\n<div class=\"both\"><div>\n");
    FW_TRY(player(page, v, scene, number));
    fw_text_add(out, "</div>\n");
    const fw_dynamics_motion *motion = v->motion[scene];
    int panels = motion->npin < FW_REPORT_PANELS ? motion->npin : FW_REPORT_PANELS;
    int curves = panels * page->nmotion;
    int points = curves > CURVES ? FW_REPORT_CURVE * CURVES / curves : FW_REPORT_CURVE;
    const fw_report_figure figure = {2, points, false, title};
    FW_TRY(fw_report_panels(page->arena, v->mechanism, motion, &figure, out));
    fw_text_add(out, "</div>");
    const fw_report_figure probes = {4, points, false, s->name};
    FW_TRY(fw_report_probe_panels(page->arena, v, scene, &probes, out));
    fw_text_add(out, "</figure>\n");
    return fw_text_end(out);
}

fw_status fw_report_section_motion(fw_report_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    int number = 0;
    if (page->nmotion == 0) fw_text_add(page->out, "<p>No scene was simulated.</p>\n");
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; v->motion && k < page->in->device->nscene; k++)
            if (v->motion[k]) FW_TRY(one(page, v, k, ++number));
    }
    return fw_text_end(page->out);
}
