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

/* what was written so far under names that begin so, without the folder */
static fw_status files_of(writer *w, const char *flow, const char *behind, fw_output_file **own,
                          int *n) {
    const char *start = fw_arena_printf(w->plan->arena, "masks/%s%s", flow, behind);
    FW_NEED(start);
    size_t count;
    const fw_output_file *all = fw_output_files(w->output, &count);
    FW_NEED(*own = fw_arena_array(w->plan->arena, fw_output_file, count));
    *n = 0;
    for (size_t i = 0; i < count; i++)
        if (strncmp(all[i].name, start, strlen(start)) == 0) {
            (*own)[*n] = all[i];
            (*own)[(*n)++].name = all[i].name + strlen("masks/");
        }
    return FW_OK;
}

/* the order sheets name what was written before them */
static fw_status write_order(writer *w, const fw_mask *mask, const char *name) {
    fw_output_file *own;
    int n;
    FW_TRY(files_of(w, name, ".", &own, &n));
    fw_text json = fw_text_new(w->scratch);
    FW_TRY(fw_mask_write_order(mask, own, n, &json));
    FW_TRY(put(w, "masks/", name, ".order.json", &json));
    fw_text text = fw_text_new(w->scratch);
    FW_TRY(fw_mask_write_order_text(mask, own, n, &text));
    return put(w, "masks/", name, ".order.txt", &text);
}

typedef struct mask_files { /* a mask: the device's, or the test die's with its list */
    const char *name;
    const fw_mask *mask;
    const fw_text *gds;
    const char *sha256;
    const fw_mask_coupons *coupons; /* NULL: the device's */
} mask_files;

/* masks, or the pictures of them */
static fw_status write_formats(writer *w, const mask_files *m, unsigned set, bool pictures) {
    const fw_mask_format *format;
    for (size_t i = 0; (format = fw_mask_format_at(i)); i++) {
        if (!(set & 1u << i) || format->picture != pictures) continue;
        bool composed = format->write == fw_mask_write_gds; /* for its hash */
        fw_text text = composed ? *m->gds : fw_text_new(w->scratch);
        if (!composed) FW_TRY(format->write(m->mask, &text));
        FW_TRY(put(w, "masks/", m->name, format->ending, &text));
    }
    return FW_OK;
}

static fw_status write_one(writer *w, const mask_files *m) {
    unsigned set;
    if (!fw_mask_formats(w->plan->options.mask_formats, &set)) return FW_USAGE;
    FW_TRY(write_formats(w, m, set, false));
    fw_output_file *own;
    int n;
    FW_TRY(files_of(w, m->name, ".", &own, &n));
    fw_text text = fw_text_new(w->scratch);
    FW_TRY(m->coupons ? fw_mask_write_coupons(m->coupons, m->sha256, own, n, &text)
                      : fw_mask_write_certificate_of(m->mask, m->sha256, own, n, &text));
    FW_TRY(put(w, "masks/", m->name, ".json", &text));
    FW_TRY(write_order(w, m->mask, m->name));
    if (m->coupons) return FW_OK;
    return write_formats(w, m, set, true); /* behind the order sheets, which do not name them */
}

static fw_status write_mask(writer *w, const fw_plan_flow *pf) {
    FW_TRY(write_one(w, &(mask_files){pf->use->ref, pf->mask, &pf->gds, pf->mask_sha256, NULL}));
    if (!pf->coupons) return FW_OK;
    const char *name = fw_arena_printf(w->plan->arena, "%s-coupons", pf->use->ref);
    FW_NEED(name);
    return write_one(w, &(mask_files){name, pf->coupons->mask, &pf->coupons_gds, pf->coupons_sha256,
                                      pf->coupons});
}

/* where rules are broken: the list, KLayout's marker database, and the outlines with markers */
static fw_status write_violations(writer *w, const fw_plan_flow *pf) {
    fw_text text = fw_text_new(w->scratch);
    FW_TRY(fw_mask_write_findings(pf->violated, &text));
    FW_TRY(put(w, "masks/", pf->use->ref, ".violations.json", &text));
    text = fw_text_new(w->scratch);
    FW_TRY(fw_mask_write_lyrdb(pf->violated, &text));
    FW_TRY(put(w, "masks/", pf->use->ref, ".violations.lyrdb", &text));
    const fw_mask *marked;
    FW_TRY(fw_mask_marked(w->plan->arena, pf->violated, &marked));
    text = fw_text_new(w->scratch);
    FW_TRY(fw_mask_write_gds(marked, &text));
    return put(w, "masks/", pf->use->ref, ".violations.gds", &text);
}

static fw_status write_wafer(writer *w, const fw_plan_flow *pf) {
    unsigned set;
    if (!pf->wafer) return FW_OK;
    if (!fw_mask_formats(w->plan->options.mask_formats, &set)) return FW_USAGE;
    const char *name = fw_arena_printf(w->plan->arena, "%s-wafer", pf->use->ref);
    FW_NEED(name);
    FW_TRY(put(w, "masks/", name, ".gds", &pf->wafer_gds));
    const fw_mask_format *format;
    for (size_t i = 0; (format = fw_mask_format_at(i)); i++) {
        fw_status (*write)(const fw_wafer *wafer, fw_text *out) = NULL;
        if (set & 1u << i && format->write == fw_mask_write_svg) write = fw_wafer_write_svg;
        if (set & 1u << i && format->write == fw_mask_write_oasis) write = fw_wafer_write_oasis;
        if (!write) continue;
        fw_text text = fw_text_new(w->scratch);
        FW_TRY(write(pf->wafer, &text));
        FW_TRY(put(w, "masks/", name, format->ending, &text));
    }
    fw_text csv = fw_text_new(w->scratch);
    FW_TRY(fw_wafer_write_csv(pf->wafer, &csv));
    FW_TRY(put(w, "masks/", name, ".csv", &csv));
    fw_text map = fw_text_new(w->scratch);
    FW_TRY(fw_wafer_write_map(pf->wafer, &map));
    FW_TRY(put(w, "masks/", name, "-map.svg", &map));
    fw_text json = fw_text_new(w->scratch);
    FW_TRY(fw_wafer_write_json(pf->wafer, pf->wafer_sha256, &json));
    FW_TRY(put(w, "masks/", name, ".json", &json));
    fw_output_file *own;
    int n;
    FW_TRY(files_of(w, pf->use->ref, "-wafer", &own, &n));
    fw_text order = fw_text_new(w->scratch);
    FW_TRY(fw_wafer_write_order(pf->wafer, own, n, &order));
    return put(w, "masks/", name, ".order.txt", &order);
}

static fw_status write_recipe(writer *w, const fw_plan_flow *pf) {
    static const struct {
        const char *ending;
        fw_status (*write)(const fw_process_flow *flow, const fw_recipe_header *header,
                           fw_text *out);
        bool of_schedule, of_cut;
    } format[] = {{".html", fw_recipe_write_html, .of_cut = false},
                  {".csv", fw_recipe_write_csv, .of_cut = false},
                  {".ics", fw_recipe_write_ics, .of_cut = false},
                  {".json", fw_recipe_write_json, .of_cut = false},
                  {".schedule.json", fw_recipe_write_schedule_json, .of_schedule = true},
                  {".schedule.csv", fw_recipe_write_schedule_csv, .of_schedule = true},
                  {".schedule.svg", fw_recipe_write_schedule_svg, .of_schedule = true},
                  {".sections.svg", fw_recipe_write_sections_svg, .of_cut = true},
                  {".sections.json", fw_recipe_write_sections_json, .of_cut = true},
                  {".stack.svg", fw_recipe_write_stack_svg, .of_cut = true}};
    fw_recipe_header header = fw_plan_recipe_header(w->plan, pf);
    for (size_t i = 0; i < sizeof format / sizeof format[0]; i++) {
        fw_text text = fw_text_new(w->scratch);
        if (format[i].of_schedule && !header.schedule) continue;
        if (format[i].of_cut && !header.cut) continue;
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
        const fw_device_scene *scene = &plan->device->scene[s];
        int written = 0;
        for (int i = 0; i < plan->verdict.nvariant; i++) {
            const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
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
        if ((what & FW_WRITE_MASKS) && plan->flow[i].violated)
            FW_TRY(write_violations(w, &plan->flow[i]));
        if (what & FW_WRITE_MASKS) FW_TRY(write_wafer(w, &plan->flow[i]));
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
    writer w = {.plan = plan, .scratch = fw_arena_part(plan->arena, plan->options.memory_cap)};
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
