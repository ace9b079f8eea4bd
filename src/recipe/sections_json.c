/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/sections.h"
#include "recipe/words.h"
#include <math.h>

static void number(fw_text *out, const char *before, double value) {
    fw_text_add(out, before);
    fw_put_or_null(out, value);
}

static void named(fw_text *out, const char *before, const char *text) {
    fw_text_add(out, before);
    fw_put_json(out, text);
}

static void cut(const fw_recipe_cut *c, const fw_section_scale *scale, fw_text *out) {
    named(out, ",\"cut\":{\"name\":", c->name);
    number(out, ",\"from_m\":[", c->line.at.x);
    number(out, ",", c->line.at.y);
    number(out, "],\"to_m\":[", c->line.at.x + c->length_m * c->line.along.x);
    number(out, ",", c->line.at.y + c->length_m * c->line.along.y);
    number(out, "],\"length_m\":", c->length_m);
    number(out, ",\"exaggeration\":", scale->exaggeration);
    fw_text_add(out, "}");
}

static void along(const fw_section_plan *plan, fw_text *out) {
    fw_text_add(out, ",\n\"parts\":[");
    for (int i = 0; i < plan->npart; i++) {
        named(out, i ? ",{\"label\":" : "{\"label\":", plan->part[i].label);
        number(out, ",\"from_m\":", plan->part[i].from_m);
        number(out, ",\"to_m\":", plan->part[i].to_m);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "],\n\"openings\":[");
    for (int i = 0; i < plan->nopening; i++) {
        const fw_section_opening *o = &plan->opening[i];
        number(out, i ? ",{\"from_m\":" : "{\"from_m\":", o->from_m);
        number(out, ",\"to_m\":", o->to_m);
        number(out, ",\"drawn_m\":", o->drawn_m);
        number(out, ",\"mask_m\":", o->mask_m);
        number(out, ",\"top_m\":", o->top_m);
        number(out, ",\"bottom_m\":", o->bottom_m);
        number(out, ",\"depth_m\":", o->depth_m);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static void area(const fw_patch *p, fw_text *out) {
    const double corner[4][2] = {{p->low_m[0], p->bottom_m},
                                 {p->low_m[1], p->bottom_m},
                                 {p->high_m[1], p->top_m},
                                 {p->high_m[0], p->top_m}};
    for (int i = 0; i < 4; i++) {
        number(out, i ? ",[" : "[[", corner[i][0]);
        number(out, ",", corner[i][1]);
        fw_text_add(out, i < 3 ? "]" : "]]");
    }
}

/* patches of one film follow each other */
static void films(const fw_cross_section *p, fw_text *out) {
    fw_text_add(out, ",\"films\":[");
    for (int i = 0; i < p->n;) {
        const fw_film *f = p->patch[i].film;
        named(out, i ? ",\n{\"material\":" : "{\"material\":", f->material);
        number(out, ",\"thickness_m\":", f->thickness_m);
        fw_text_printf(out, ",\"shortened\":%s,\"exposed\":%s,\"areas_m\":[",
                       f->shortened ? "true" : "false", f->exposed ? "true" : "false");
        for (int first = i; i < p->n && p->patch[i].film == f; i++) {
            fw_text_add(out, i > first ? "," : "");
            area(&p->patch[i], out);
        }
        fw_text_add(out, "]}");
    }
    fw_text_add(out, "]");
}

static fw_status step(fw_slicer *slicer, const fw_flow *flow, int index, fw_text *out) {
    const fw_step *s = &flow->step[index];
    fw_cross_section p;
    named(out, "{\"id\":", s->id);
    named(out, ",\"title\":", s->title);
    fw_text_printf(out, ",\"changes\":%s", fw_step_changes(s) ? "true" : "false");
    if (fw_step_changes(s)) { /* else as before */
        FW_TRY(fw_cross_section_of(slicer, flow, index, &p));
        films(&p, out);
        fw_text_add(out, ",\"notes\":[");
        for (int i = 0; i < p.films.nnote; i++)
            named(out, i ? "," : "", p.films.note[i]);
        fw_text_add(out, "]");
    }
    fw_text_add(out, "}");
    return FW_OK;
}

fw_status fw_recipe_write_sections_json(const fw_flow *flow, const fw_recipe_header *header,
                                        fw_text *out) {
    fw_slicer slicer;
    fw_section_scale scale;
    fw_section_plan plan;
    FW_TRY(fw_slicer_start(out->arena, header->mask, header->cut, &slicer));
    FW_TRY(fw_section_scale_of(out->arena, flow, header->cut, &scale));
    FW_TRY(fw_section_plan_of(&slicer, flow, &plan));
    named(out, "{\"schema\":", "flexwright.sections/1");
    named(out, ",\"flow\":", flow->id);
    named(out, ",\"device\":", header->device);
    fw_text_printf(out, ",\"rejected\":%s", header->rejected ? "true" : "false");
    if (header->rejected) named(out, ",\"banner\":", "REJECTED");
    cut(header->cut, &scale, out);
    along(&plan, out);
    fw_text_add(out, ",\n\"steps\":[");
    for (int i = 0; i < flow->nstep; i++) {
        fw_text_add(out, i ? ",\n" : "\n");
        FW_TRY(step(&slicer, flow, i, out));
    }
    fw_text_add(out, "]}\n");
    return fw_text_end(out);
}
