/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include "quantity/law_kind.h"
#include <math.h>
#include <string.h>

enum { CURVES = 90 }; /* at full resolution in the whole page */

/* the value of an attribute in the words of a law; false: as it is when it is not given */
static bool attribute(fw_text *out, const fw_law *law, const char *name, size_t n) {
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
static const char *words(fw_text *out, const fw_law *law, const char *words_, char stop,
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

static void law(fw_text *out, const fw_law *law) {
    bool given = false;
    if (!law) return;
    fw_markup(out, " times a {s}", law->kind->name);
    words(out, law, law->kind->words, '\0', &given);
}

static const char *body_text(const fw_device *device, int body) {
    return body < 0 ? "ground" : device->body[body].id;
}

static void actuators(fw_text *out, const fw_device *device, const fw_scene *s) {
    for (int i = 0; i < s->ntendon; i++) {
        const fw_tendon *t = &s->tendon[i];
        bool pulled = !isnan(t->pull_N);
        fw_markup(out, "; cable {s} {s} {u}", t->id, pulled ? "pulls with" : "taken in by",
                  pulled ? t->pull_N : t->draw_m, pulled ? "N" : "m");
        law(out, t->law);
    }
    for (int i = 0; i < s->ncomb; i++) {
        const fw_comb *c = &s->comb[i];
        fw_markup(out, "; {s} {s} between {s} and {s} at {u}",
                  c->kind == FW_ELECTRODES_COMB ? "comb" : "plates", c->id,
                  body_text(device, c->body_b), body_text(device, c->body_a), c->voltage_V, "V");
        law(out, c->law);
    }
    for (int i = 0; i < s->nbase; i++) {
        fw_markup(out, "; base shaken with ({n}, {n}) m/s\u00b2", s->base[i].ax_m_per_s2,
                  s->base[i].ay_m_per_s2);
        law(out, s->base[i].law);
    }
}

static void surroundings(fw_text *out, const fw_device *device, const fw_scene *s) {
    static const char *const air[] = {[FW_AIR_SLIDE] = "sliding film",
                                      [FW_AIR_SQUEEZE] = "squeezed film",
                                      [FW_AIR_DRAG] = "drag"};
    for (int i = 0; i < s->nfriction; i++)
        fw_markup(out, "; friction in {s}, coefficient {n}",
                  s->friction[i].joint != FW_NONE ? device->joint[s->friction[i].joint].id
                                                  : device->tie[s->friction[i].tie].id,
                  s->friction[i].coefficient);
    for (int i = 0; i < s->ncontact; i++)
        fw_markup(out, "; contact {s}", s->contact[i].id);
    if (s->ndamping) fw_text_add(out, "; damping by the material");
    for (int i = 0; i < s->ntemperature; i++) {
        fw_markup(out, "; temperature changed by {n} K", s->temperature[i].change_K);
        law(out, s->temperature[i].law);
    }
    for (int i = 0; i < s->nstress; i++)
        fw_markup(out, "; residual stress {u}", s->stress[i].mean_Pa, "Pa");
    for (int i = 0; i < s->nair; i++)
        fw_markup(out, "; air: {s} on {s}, {u}", air[s->air[i].kind],
                  s->air[i].body < 0 ? "all bodies" : device->body[s->air[i].body].id,
                  s->air[i].pressure_Pa, "Pa");
}

static void loads(fw_text *out, const fw_device *device, const fw_scene *s) {
    fw_markup(out, "<p class=\"soft\">{u}", s->duration_s, "s");
    for (int i = 0; i < s->nforce; i++) {
        fw_markup(out, "; force on {s} ({u}, {u})", device->body[s->force[i].body].id,
                  s->force[i].fx_N, "N", s->force[i].fy_N, "N");
        law(out, s->force[i].law);
    }
    for (int i = 0; i < s->ntorque; i++) {
        fw_markup(out, "; torque on {s} {u}", device->body[s->torque[i].body].id,
                  s->torque[i].value_Nm, "N\u00b7m");
        law(out, s->torque[i].law);
    }
    for (int i = 0; i < device->ndriver; i++)
        fw_markup(out, "; joint {s} driven in time", device->driver[i].id);
    if (s->gravity)
        fw_markup(out, "; gravity ({n}, {n}) m/s\u00b2", s->gx_m_per_s2, s->gy_m_per_s2);
    actuators(out, device, s);
    surroundings(out, device, s);
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
    fw_markup(out, "<figure class=\"motion\" id=\"motion-{i}\"><figcaption><h3>{s}{r}{s}</h3>\n",
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
