/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include <math.h>

enum { CURVES = 90 }; /* at full resolution in the whole page */

static void law(fw_text *out, const fw_law *law) {
    if (!law) return;
    fw_report_markup(out, " times a {s}", fw_law_kind_text(law->kind));
    if (law->kind == FW_LAW_SINE) fw_report_markup(out, " of {u}", law->frequency_Hz, "Hz");
    if (law->kind == FW_LAW_RAMP) fw_report_markup(out, " over {u}", law->rise_s, "s");
    bool starts = law->kind <= FW_LAW_SINE;
    if (starts && law->start_s > 0) fw_report_markup(out, " from {u} on", law->start_s, "s");
    if (starts && isfinite(law->end_s)) fw_report_markup(out, " until {u}", law->end_s, "s");
    if (law->kind >= FW_LAW_TABLE) fw_text_add(out, " in time");
}

static void loads(fw_text *out, const fw_device *device, const fw_scene *s) {
    fw_report_markup(out, "<p class=\"soft\">{u}", s->duration_s, "s");
    for (int i = 0; i < s->nforce; i++) {
        fw_report_markup(out, "; force on {s} ({u}, {u})", device->body[s->force[i].body].id,
                         s->force[i].fx_N, "N", s->force[i].fy_N, "N");
        law(out, s->force[i].law);
    }
    for (int i = 0; i < s->ntorque; i++) {
        fw_report_markup(out, "; torque on {s} {u}", device->body[s->torque[i].body].id,
                         s->torque[i].value_Nm, "N\u00b7m");
        law(out, s->torque[i].law);
    }
    for (int i = 0; i < device->ndriver; i++)
        fw_report_markup(out, "; joint {s} driven in time", device->driver[i].id);
    if (s->gravity)
        fw_report_markup(out, "; gravity ({n}, {n}) m/s\u00b2", s->gx_m_per_s2, s->gy_m_per_s2);
    if (s->ninitial) fw_text_add(out, "; bodies start with a velocity");
    fw_text_add(out,
                ". Dashed: as drawn. Blue trace: centre of the platform. The still picture shows "
                "the worst instant.");
    if (device->die.tethers)
        fw_text_add(out, " Tethers are not drawn here: they are broken at the bodies before use.");
    fw_text_add(out, "</p>\n");
}

static fw_status one(fw_page *page, const fw_variant_verdict *v, int scene, int number) {
    fw_text *out = page->out;
    const fw_device *device = page->in->device;
    const fw_scene *s = &device->scene[scene];
    const char *flow = v->variant ? v->variant->flow : NULL;
    char *title = fw_arena_printf(page->arena, "Hinge angles in scene %s", s->name);
    FW_NEED(title);
    fw_report_markup(out,
                     "<figure class=\"motion\" id=\"motion-{i}\"><figcaption><h3>{s}{r}{s}</h3>\n",
                     number, s->name, flow ? ", " : "", flow);
    loads(out, device, s);
    fw_text_add(out, "</figcaption>\n<div class=\"both\"><div>\n");
    FW_TRY(fw_report_player(page, v, scene, number));
    fw_text_add(out, "</div>\n");
    const fw_motion *motion = v->motion[scene];
    int panels = motion->npin < FW_REPORT_PANELS ? motion->npin : FW_REPORT_PANELS;
    int curves = panels * page->nmotion;
    int points = curves > CURVES ? FW_REPORT_CURVE * CURVES / curves : FW_REPORT_CURVE;
    const fw_report_figure figure = {2, points, false, title};
    FW_TRY(fw_report_panels(page->arena, v->mechanism, motion, &figure, out));
    fw_text_add(out, "</div></figure>\n");
    return fw_text_end(out);
}

fw_status fw_report_section_motion(fw_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    int number = 0;
    if (page->nmotion == 0) fw_text_add(page->out, "<p>No scene was simulated.</p>\n");
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; v->motion && k < page->in->device->nscene; k++)
            if (v->motion[k]) FW_TRY(one(page, v, k, ++number));
    }
    return fw_text_end(page->out);
}
