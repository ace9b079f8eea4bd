/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/members.h"
#include "recipe/sections.h"
#include "recipe/words.h"

static void number(fw_text *out, const char *key, double value) {
    fw_put_number(out, key, value, FW_PLAIN_DIGITS);
}

static void point(fw_text *out, const char *key, double x_m, double y_m) {
    fw_put_open(out, key, '[');
    number(out, NULL, x_m);
    number(out, NULL, y_m);
    fw_text_add(out, "]");
}

static void cut(const fw_recipe_cut *c, const fw_section_scale *scale, fw_text *out) {
    fw_put_open(out, "cut", '{');
    fw_put_words(out, "name", c->name);
    point(out, "from_m", c->line.at.x, c->line.at.y);
    point(out, "to_m", c->line.at.x + c->length_m * c->line.along.x,
          c->line.at.y + c->length_m * c->line.along.y);
    number(out, "length_m", c->length_m);
    number(out, "exaggeration", scale->exaggeration);
    fw_text_add(out, "}");
}

static void along(const fw_section_plan *plan, fw_text *out) {
    fw_put_line(out);
    fw_put_open(out, "parts", '[');
    for (int i = 0; i < plan->npart; i++) {
        fw_put_open(out, NULL, '{');
        fw_put_words(out, "label", plan->part[i].label);
        number(out, "from_m", plan->part[i].from_m);
        number(out, "to_m", plan->part[i].to_m);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
    fw_put_line(out);
    fw_put_open(out, "openings", '[');
    for (int i = 0; i < plan->nopening; i++) {
        const fw_section_opening *o = &plan->opening[i];
        fw_put_open(out, NULL, '{');
        number(out, "from_m", o->from_m);
        number(out, "to_m", o->to_m);
        number(out, "drawn_m", o->drawn_m);
        number(out, "mask_m", o->mask_m);
        number(out, "top_m", o->top_m);
        number(out, "bottom_m", o->bottom_m);
        number(out, "depth_m", o->depth_m);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static void area(const fw_patch *p, fw_text *out) {
    fw_put_open(out, NULL, '[');
    point(out, NULL, p->low_m[0], p->bottom_m);
    point(out, NULL, p->low_m[1], p->bottom_m);
    point(out, NULL, p->high_m[1], p->top_m);
    point(out, NULL, p->high_m[0], p->top_m);
    fw_text_add(out, "]");
}

/* patches of one film follow each other */
static void films(const fw_cross_section *p, fw_text *out) {
    fw_put_open(out, "films", '[');
    for (int i = 0; i < p->n;) {
        const fw_film *f = p->patch[i].film;
        if (i > 0) fw_put_line(out);
        fw_put_open(out, NULL, '{');
        fw_put_words(out, "material", f->material);
        number(out, "thickness_m", f->thickness_m);
        fw_put_truth(out, "shortened", f->shortened);
        fw_put_truth(out, "exposed", f->exposed);
        fw_put_open(out, "areas_m", '[');
        for (; i < p->n && p->patch[i].film == f; i++)
            area(&p->patch[i], out);
        fw_text_add(out, "]}");
    }
    fw_text_add(out, "]");
}

static fw_status step(fw_slicer *slicer, const fw_flow *flow, int index, fw_text *out) {
    const fw_step *s = &flow->step[index];
    fw_cross_section p;
    fw_put_open(out, NULL, '{');
    fw_put_words(out, "id", s->id);
    fw_put_words(out, "title", s->title);
    fw_put_truth(out, "changes", fw_step_changes(s));
    if (fw_step_changes(s)) { /* else as before */
        FW_TRY(fw_cross_section_of(slicer, flow, index, &p));
        films(&p, out);
        fw_put_open(out, "notes", '[');
        for (int i = 0; i < p.films.nnote; i++)
            fw_put_words(out, NULL, p.films.note[i]);
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
    fw_put_open(out, NULL, '{');
    fw_put_words(out, "schema", "flexwright.sections/1");
    fw_put_words(out, "flow", flow->id);
    fw_put_words(out, "device", header->device);
    fw_put_truth(out, "rejected", header->rejected);
    if (header->rejected) fw_put_words(out, "banner", "REJECTED");
    cut(header->cut, &scale, out);
    along(&plan, out);
    fw_put_line(out);
    fw_put_open(out, "steps", '[');
    for (int i = 0; i < flow->nstep; i++) {
        fw_put_line(out);
        FW_TRY(step(&slicer, flow, i, out));
    }
    fw_text_add(out, "]}\n");
    return fw_text_end(out);
}
