/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plan/stages.h"
#include "recipe/recipe.h"
#include <string.h>

typedef struct writer {
    fw_plan *plan;
    fw_output *output;
    fw_arena *scratch; /* one file at a time: a hundred scenes take no more memory than one */
    fw_mark empty;
} writer;

static fw_status put(writer *w, const char *folder, const char *name, const char *ending,
                     const fw_text *text) {
    FW_TRY(fw_text_end(text));
    const char *path = fw_arena_printf(w->plan->arena, "%s%s%s", folder, name, ending);
    FW_NEED(path);
    FW_TRY(fw_output_write(w->output, path, text->data, text->length));
    fw_arena_rewind(w->scratch, w->empty);
    return FW_OK;
}

/* the order sheets name what was written of this flow before them, without the folder */
static fw_status write_order(writer *w, const fw_plan_flow *pf) {
    const char *start = fw_arena_printf(w->plan->arena, "masks/%s.", pf->use->ref);
    FW_NEED(start);
    size_t count;
    const fw_output_file *all = fw_output_files(w->output, &count);
    fw_output_file *own = fw_arena_array(w->plan->arena, fw_output_file, count);
    FW_NEED(own);
    int n = 0;
    for (size_t i = 0; i < count; i++)
        if (strncmp(all[i].name, start, strlen(start)) == 0) {
            own[n] = all[i];
            own[n++].name = all[i].name + strlen("masks/");
        }
    fw_text json = fw_text_new(w->scratch);
    FW_TRY(fw_mask_write_order(pf->mask, own, n, &json));
    FW_TRY(put(w, "masks/", pf->use->ref, ".order.json", &json));
    fw_text text = fw_text_new(w->scratch);
    FW_TRY(fw_mask_write_order_text(pf->mask, own, n, &text));
    return put(w, "masks/", pf->use->ref, ".order.txt", &text);
}

static fw_status write_mask(writer *w, const fw_plan_flow *pf) {
    unsigned set;
    if (!fw_mask_formats(w->plan->options.mask_formats, &set)) return FW_USAGE;
    const fw_mask_format *format;
    for (size_t i = 0; (format = fw_mask_format_at(i)); i++) {
        if (!(set & 1u << i)) continue;
        bool composed = format->write == fw_mask_write_gds; /* for its hash */
        fw_text text = composed ? pf->gds : fw_text_new(w->scratch);
        if (!composed) FW_TRY(format->write(pf->mask, &text));
        FW_TRY(put(w, "masks/", pf->use->ref, format->ending, &text));
    }
    fw_text text = fw_text_new(w->scratch);
    FW_TRY(fw_mask_write_certificate(pf->mask, pf->mask_sha256, &text));
    FW_TRY(put(w, "masks/", pf->use->ref, ".json", &text));
    return write_order(w, pf);
}

static fw_status write_recipe(writer *w, const fw_plan_flow *pf) {
    static const struct {
        const char *ending;
        fw_status (*write)(const fw_flow *flow, const fw_recipe_header *header, fw_text *out);
        bool of_schedule;
    } format[] = {{".html", fw_recipe_write_html, false},
                  {".csv", fw_recipe_write_csv, false},
                  {".ics", fw_recipe_write_ics, false},
                  {".json", fw_recipe_write_json, false},
                  {".schedule.json", fw_recipe_write_schedule_json, true},
                  {".schedule.csv", fw_recipe_write_schedule_csv, true},
                  {".schedule.svg", fw_recipe_write_schedule_svg, true}};
    fw_recipe_header header = fw_plan_recipe_header(w->plan, pf);
    for (size_t i = 0; i < sizeof format / sizeof format[0]; i++) {
        fw_text text = fw_text_new(w->scratch);
        if (format[i].of_schedule && !header.schedule) continue;
        FW_TRY(format[i].write(pf->flow, &header, &text));
        FW_TRY(put(w, "recipes/", pf->use->ref, format[i].ending, &text));
    }
    return FW_OK;
}

/* SCENE.csv and SCENE.svg; where a scene runs in several flows: SCENE.FLOW.csv for the later ones
 */
static fw_status write_motions(writer *w) {
    fw_plan *plan = w->plan;
    for (int s = 0; s < plan->device->nscene; s++) {
        const fw_scene *scene = &plan->device->scene[s];
        int written = 0;
        for (int i = 0; i < plan->verdict.nvariant; i++) {
            const fw_variant_verdict *v = &plan->verdict.variant[i];
            if (!v->motion || !v->motion[s]) continue;
            const char *name = scene->name;
            if (written++ > 0)
                FW_NEED(name =
                            fw_arena_printf(plan->arena, "%s.%s", scene->name, v->variant->flow));
            fw_text csv = fw_text_new(w->scratch);
            FW_TRY(fw_report_motion_csv(v->mechanism, v->motion[s], &csv));
            FW_TRY(put(w, "motion/", name, ".csv", &csv));
            fw_text svg = fw_text_new(w->scratch);
            FW_TRY(fw_report_motion_svg(w->scratch, plan->device, v->mechanism, v->motion[s], scene,
                                        &plan->verdict, &svg));
            FW_TRY(put(w, "motion/", name, ".svg", &svg));
        }
    }
    return FW_OK;
}

/* the drawing by itself: exact SVG, and a preview for places that show no SVG */
static fw_status write_drawing(writer *w) {
    fw_plan *plan = w->plan;
    fw_text svg = fw_text_new(w->scratch);
    FW_TRY(fw_report_device_svg(w->scratch, plan->device, plan->layout, &plan->verdict, &svg));
    FW_TRY(put(w, "", "device", ".svg", &svg));
    fw_text png = fw_text_new(w->scratch);
    FW_TRY(fw_report_device_png(w->scratch, plan->device, plan->layout, &plan->verdict, 800, &png));
    return put(w, "", "device", ".png", &png);
}

static fw_status write_report(writer *w) {
    fw_text html = fw_text_new(w->scratch);
    FW_TRY(fw_plan_report_html(w->plan, &html));
    return put(w, "", "report", ".html", &html);
}

static fw_status write_all(writer *w, unsigned what) {
    fw_plan *plan = w->plan;
    FW_TRY(fw_plan_assumptions(plan));
    if (what & FW_WRITE_VERDICT) {
        fw_text json = fw_text_new(w->scratch);
        FW_TRY(fw_plan_verdict_json(plan, &json));
        FW_TRY(put(w, "", "verdict", ".json", &json));
    }
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    for (int i = 0; given && i < plan->nflow; i++) {
        if ((what & FW_WRITE_MASKS) && plan->flow[i].mask) FW_TRY(write_mask(w, &plan->flow[i]));
        if ((what & FW_WRITE_RECIPES) && plan->flow[i].flow)
            FW_TRY(write_recipe(w, &plan->flow[i]));
    }
    if (what & FW_WRITE_MOTION) FW_TRY(write_motions(w));
    if (what & FW_WRITE_REPORT) {
        FW_TRY(write_report(w));
        FW_TRY(write_drawing(w));
    }
    size_t count;
    const fw_output_file *file = fw_output_files(w->output, &count);
    plan->files_written = (int)count;
    if (count == 0) return FW_OK; /* a rejected design has no masks: no directory either */
    fw_text manifest = fw_text_new(w->scratch);
    FW_TRY(fw_plan_manifest(plan, file, count, &manifest));
    return put(w, "", "manifest", ".json", &manifest);
}

fw_status fw_plan_write(fw_plan *plan, const char *directory, unsigned what) {
    writer w = {.plan = plan, .scratch = fw_arena_new(plan->options.memory_cap)};
    FW_NEED(w.scratch);
    w.empty = fw_arena_mark(w.scratch);
    plan->files_written = 0;
    fw_status status = fw_output_open(plan->arena, directory, &plan->diags, &w.output);
    if (status == FW_OK) status = write_all(&w, what);
    if (status == FW_OK && plan->files_written > 0)
        status = fw_output_commit(w.output);
    else
        fw_output_abort(w.output);
    if (status != FW_OK) fw_output_abort(w.output);
    fw_arena_free(w.scratch);
    return status;
}
