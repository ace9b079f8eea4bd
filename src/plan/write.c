/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The documents that span the flows of a plan (those of one flow are composed in its own room), the
   manifest, and the directory that holds them all. */
#include "base/json.h"
#include "plan/plan.h"
#include "plan/stages.h"
#include "recipe/recipe.h"
#include "report/report.h"
#include <string.h>

static fw_report_flow *report_flows(fw_plan *plan) {
    fw_report_flow *flow = fw_arena_array(plan->arena, fw_report_flow, (size_t)plan->nflow);
    for (int i = 0; flow && i < plan->nflow; i++)
        flow[i] =
            (fw_report_flow){&plan->verdict.variant[i],
                             plan->flow[i].flow,
                             plan->flow[i].mask,
                             plan->flow[i].mask_error,
                             plan->flow[i].violated,
                             plan->flow[i].measuring,
                             plan->flow[i].release_svg.length ? &plan->flow[i].release_svg : NULL,
                             plan->flow[i].wiring,
                             plan->flow[i].tethers,
                             plan->flow[i].dies,
                             plan->flow[i].dies_count};
    return flow;
}

fw_report_input fw_plan_report_input(fw_plan *plan) {
    return (fw_report_input){.device = plan->device,
                             .layout = plan->layout,
                             .verdict = &plan->verdict,
                             .flow = report_flows(plan),
                             .nflow = plan->nflow,
                             .version = FW_VERSION,
                             .assumption = plan->assumption,
                             .nassumption = plan->nassumption,
                             .outside = plan->outside,
                             .noutside = plan->noutside,
                             .diags = &plan->diags,
                             .wanted = plan->options.wanted};
}

fw_status fw_plan_verdict_json(fw_plan *plan, fw_text *out) {
    fw_report_input input = fw_plan_report_input(plan);
    FW_NEED(input.flow);
    return fw_report_verdict_json(&input, out);
}

fw_status fw_plan_verdict_text(fw_plan *plan, fw_report_terminal_style style, fw_text *out) {
    fw_report_input input = fw_plan_report_input(plan);
    FW_NEED(input.flow);
    return fw_report_verdict_text(&input, style, out);
}

/* mechanisms are built again: what there is to say of them has been said by the verdict */
static fw_status report_ladders(fw_plan *plan, fw_plan_ladders *ladders) {
    fw_diags said = plan->diags;
    plan->diags = fw_diags_new(plan->arena);
    fw_status status = fw_plan_ladders_run(plan, FW_LADDER_ONCE, ladders);
    plan->diags = said;
    return status;
}

/* The map of a release, where the flow has one: a file, and a fragment that the run sheet and the report take. */
static fw_status draw_release(fw_plan *plan, fw_plan_flow *pf, fw_text *file) {
    const fw_layout *marked;
    const fw_release_map *map;
    fw_layout_no_room no_room;
    if (!pf->flow || !pf->flow->release || !plan->layout) return FW_OK;
    if (pf->release_svg.length && !file) return FW_OK;
    fw_arena *scratch = fw_arena_part(plan->arena, plan->options.memory_cap);
    FW_NEED(scratch);
    bool islands = fw_plan_insulated(pf);
    fw_status status = fw_mask_frame_marks(scratch, pf->table, plan->layout, &marked, &no_room);
    if (status == FW_OK) status = fw_recipe_release_map(scratch, pf->flow, marked, islands, &map);
    if (status == FW_OK && map && pf->release_svg.length == 0) {
        pf->release_svg = fw_text_new(plan->arena);
        status = fw_recipe_write_release_svg(scratch, pf->flow, marked, islands, map, false,
                                             &pf->release_svg);
    }
    if (status == FW_OK && map && file)
        status = fw_recipe_write_release_svg(scratch, pf->flow, marked, islands, map, true, file);
    fw_arena_free(scratch);
    return status;
}

fw_status fw_plan_report_html(fw_plan *plan, fw_text *out) {
    FW_TRY(fw_plan_assumptions(plan));
    FW_TRY(fw_plan_measurements_find(plan, true));
    fw_plan_ladders ladders;
    fw_report_hinge *hinge;
    for (int i = 0; i < plan->nflow; i++)
        FW_TRY(draw_release(plan, &plan->flow[i], NULL));
    fw_report_input input = fw_plan_report_input(plan);
    FW_NEED(input.flow);
    FW_TRY(report_ladders(plan, &ladders));
    FW_TRY(fw_plan_report_hinges(plan, &ladders, &hinge));
    input.hinge = hinge, input.nhinge = ladders.count;
    return fw_report_write_html(plan->arena, &input, out);
}

fw_status fw_plan_masks_json(fw_plan *plan, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.masks/1");
    fw_json_list(&json, "masks");
    for (int i = 0; i < plan->nflow; i++) {
        const fw_plan_flow *f = &plan->flow[i];
        if (!f->mask) continue;
        FW_TRY(fw_mask_write_certificate(f->mask, f->mask_sha256, fw_json_value(&json, NULL)));
    }
    fw_json_end(&json);
    fw_json_list(&json, "violations");
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].violated)
            FW_TRY(fw_mask_write_findings(plan->flow[i].violated, fw_json_value(&json, NULL)));
    fw_json_end(&json);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

/* of a rejected device */
static fw_status no_recipe(fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.recipe/1");
    fw_json_null(&json, "flow");
    fw_json_list(&json, "steps");
    fw_json_end(&json);
    fw_json_null(&json, "total_s");
    fw_json_truth(&json, "rejected", true);
    fw_json_text(&json, "banner", "REJECTED");
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

static fw_status recipe(const fw_plan *plan, int flow, fw_text *out) {
    fw_recipe_header header = fw_plan_recipe_header(plan, &plan->flow[flow]);
    return fw_recipe_write_json(plan->flow[flow].flow, &header, out);
}

/* one flow: its recipe; several: a document that holds them all */
fw_status fw_plan_recipes_json(fw_plan *plan, fw_text *out) {
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    if (plan->nflow == 1)
        return given && plan->flow[0].flow ? recipe(plan, 0, out) : no_recipe(out);
    if (plan->nflow == 0) return no_recipe(out);
    fw_json json = fw_json_new(out, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.recipes/1");
    fw_json_list(&json, "recipes");
    for (int i = 0; given && i < plan->nflow; i++)
        if (plan->flow[i].flow) FW_TRY(recipe(plan, i, fw_json_value(&json, NULL)));
    fw_json_end(&json);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

/* ---- the manifest ---- */

static void file(fw_json *json, const char *name, size_t bytes, const char *sha256) {
    fw_json_object(json, NULL);
    fw_json_text(json, "name", name);
    fw_json_whole(json, "bytes", (long long)bytes);
    fw_json_text(json, "sha256", sha256);
    fw_json_end(json);
}

static const char *effects_text(const fw_effect_choice *e) {
    static const char *const mode[] = {"auto", "all", "none", "list"};
    return e->mode == FW_EFFECTS_LIST && e->list ? e->list : mode[e->mode];
}

static void schedule(fw_json *json, const fw_schedule_options *c) {
    fw_json_object(json, "schedule");
    fw_json_whole(json, "wafers", c->wafers ? c->wafers : 1);
    fw_json_whole(json, "operators", c->operators ? c->operators : 1);
    fw_json_text(json, "day", c->day ? c->day : FW_WORKING_DAY);
    fw_json_text(json, "planning_times", c->planned);
    fw_json_end(json);
}

static void options(fw_json *json, const fw_plan_options *o) {
    const fw_dynamics_motion_options *motion = &o->verdict.motion;
    fw_json_object(json, "options");
    fw_json_real(json, "mask_tolerance_nm",
                 o->mask_tolerance_m > 0 ? o->mask_tolerance_m * 1e9 : 5.0);
    fw_json_text(json, "mask_formats", o->mask_formats);
    fw_json_whole(json, "mask_vertices", o->mask_vertices ? o->mask_vertices : 4094);
    if (o->layers) {
        const char *slash = strrchr(o->layers, '/');
        fw_json_text(json, "layers", slash ? slash + 1 : o->layers);
    }
    fw_json_real(json, "accuracy", motion->accuracy);
    fw_json_text(json, "effects", effects_text(&motion->effects));
    fw_json_text(json, "hinge_model", fw_effects_hinge_model_text(motion->effects.hinge));
    fw_json_text(json, "flow", o->flow);
    fw_json_truth(json, "force", o->force);
    fw_json_text(json, "method", motion->method);
    fw_json_text(json, "integrator", motion->integrator);
    fw_json_text(json, "stabilise", motion->stabilise);
    fw_json_list(json, "set");
    for (int i = 0; i < o->nset; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "path", o->set[i].path);
        fw_json_text(json, "value", o->set[i].value);
        fw_json_end(json);
    }
    fw_json_end(json);
    schedule(json, &o->schedule);
    fw_json_text(json, "mask_flatten",
                 o->mask_flatten && *o->mask_flatten ? o->mask_flatten : "inside");
    fw_json_end(json);
}

/* hash of every input and output, the options, the version; no clock, no machine */
static fw_status manifest_json(const fw_plan *plan, const fw_output_file *output, size_t count,
                               fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_INDENTED_2);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.manifest/1");
    fw_json_text(&json, "program", "flexwright");
    fw_json_text(&json, "version", FW_VERSION);
    fw_json_text(&json, "device", plan->device->name);
    options(&json, &plan->options);
    fw_json_list(&json, "inputs");
    for (int i = 0; i < plan->ninput; i++)
        file(&json, plan->input[i].name, plan->input[i].size, plan->input[i].sha256);
    fw_json_end(&json);
    fw_json_list(&json, "outputs");
    for (size_t i = 0; i < count; i++)
        file(&json, output[i].name, output[i].size, output[i].sha256);
    fw_json_end(&json);
    if (plan->verdict.decision == FW_REJECT) fw_json_text(&json, "banner", "REJECTED");
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

/* ---- the directory ---- */

typedef struct writer {
    fw_plan *plan;
    fw_output *output;
    fw_arena *scratch; /* one file at a time: a hundred scenes take no more memory than one */
    fw_mark empty;
} writer;

static fw_status put(writer *w, const char *folder, const char *name, const char *ending,
                     const fw_text *text) {
    FW_TRY(fw_text_end(text));
    if (fw_arena_cancelled(w->plan->arena)) return FW_CANCELLED;
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
        if (strncmp(all[i].name, start, strlen(start)) == 0 && !strstr(all[i].name, ".order.")) {
            (*own)[*n] = all[i];
            (*own)[(*n)++].name = all[i].name + strlen("masks/");
        }
    return FW_OK;
}

/* ".cavity" where a flow prints several plates, "" where it prints one; NULL: no memory */
static const char *of_plate(writer *w, const fw_mask_table *table, int plate) {
    const char *id = fw_mask_plate_at(table, plate).id;
    return fw_mask_plates(table) < 2 ? "" : fw_arena_printf(w->plan->arena, ".%s", id);
}

static fw_status put_order(writer *w, const fw_mask_table *table, int plate, const char *name,
                           const char *form, const fw_text *text) {
    const char *of = of_plate(w, table, plate);
    const char *ending = of ? fw_arena_printf(w->plan->arena, "%s.order.%s", of, form) : NULL;
    FW_NEED(ending);
    return put(w, "masks/", name, ending, text);
}

static bool is_solid(const char *file) {
    const size_t length = strlen(file);
    const fw_mask_format *format;
    for (size_t i = 0; (format = fw_mask_format_at(i)); i++) {
        const size_t end = strlen(format->ending);
        if (format->solid && length > end && strcmp(file + length - end, format->ending) == 0)
            return true;
    }
    return false;
}

/* an order sheet for each plate; they name what was written before them, but for what no shop writes a plate from */
static fw_status write_order(writer *w, const fw_mask *mask, const char *name) {
    fw_output_file *own;
    int n, kept = 0;
    FW_TRY(files_of(w, name, ".", &own, &n));
    for (int i = 0; i < n; i++)
        if (!is_solid(own[i].name)) own[kept++] = own[i];
    n = kept;
    for (int plate = 0; plate < fw_mask_plates(mask->table); plate++) {
        fw_text text = fw_text_new(w->scratch);
        FW_TRY(fw_mask_write_order(mask, plate, own, n, &text));
        FW_TRY(put_order(w, mask->table, plate, name, "json", &text));
        text = fw_text_new(w->scratch);
        FW_TRY(fw_mask_write_order_text(mask, plate, own, n, &text));
        FW_TRY(put_order(w, mask->table, plate, name, "txt", &text));
    }
    return FW_OK;
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
    /* behind the order sheets, which do not name them */
    return m->coupons ? FW_OK : write_formats(w, m, set, true);
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

static fw_status write_wafer(writer *w, const fw_plan_flow *pf, unsigned set) {
    const fw_mask_format *format;
    const char *name = fw_arena_printf(w->plan->arena, "%s-wafer", pf->use->ref);
    FW_NEED(name);
    for (size_t i = 0; (format = fw_mask_format_at(i)); i++) {
        if (!(set & 1u << i) || !format->plate) continue;
        bool composed = format->write == fw_mask_write_gds; /* for its hash */
        fw_text data = composed ? pf->wafer_gds : fw_text_new(w->scratch);
        if (!composed) FW_TRY(fw_wafer_write_format(pf->wafer, format, &data));
        FW_TRY(put(w, "masks/", name, format->ending, &data));
    }
    fw_text text = fw_text_new(w->scratch);
    FW_TRY(fw_wafer_write_csv(pf->wafer, &text));
    FW_TRY(put(w, "masks/", name, ".csv", &text));
    text = fw_text_new(w->scratch);
    FW_TRY(fw_wafer_write_map(pf->wafer, &text));
    FW_TRY(put(w, "masks/", name, "-map.svg", &text));
    text = fw_text_new(w->scratch);
    FW_TRY(fw_wafer_write_json(pf->wafer, pf->wafer_sha256, &text));
    FW_TRY(put(w, "masks/", name, ".json", &text));
    fw_output_file *own;
    int n;
    FW_TRY(files_of(w, pf->use->ref, "-wafer", &own, &n));
    for (int plate = 0; plate < fw_mask_plates(pf->table); plate++) {
        text = fw_text_new(w->scratch);
        FW_TRY(fw_wafer_write_order(pf->wafer, plate, own, n, &text));
        FW_TRY(put_order(w, pf->table, plate, name, "txt", &text));
    }
    return FW_OK;
}

static fw_status write_written_plate(writer *w, const fw_plan_flow *pf, const fw_wafer *wafer,
                                     int plate, unsigned set, fw_arena *arena) {
    fw_wafer_written written;
    const char *of = of_plate(w, pf->table, plate);
    const char *name = of ? fw_arena_printf(w->plan->arena, "%s-plate%s", pf->use->ref, of) : NULL;
    FW_NEED(name);
    FW_TRY(fw_wafer_written_of(arena, wafer, plate, &written));
    const fw_mask_format *format;
    for (size_t i = 0; (format = fw_mask_format_at(i)); i++) {
        if (!(set & 1u << i) || !format->plate || format->plate == fw_mask_plate_svg) continue;
        fw_text text = fw_text_new(w->scratch);
        FW_TRY(fw_wafer_write_written(&written, format, &text));
        FW_TRY(put(w, "masks/", name, format->ending, &text));
    }
    fw_output_file *own;
    int n;
    fw_text order = fw_text_new(w->scratch);
    FW_TRY(files_of(w, name, ".", &own, &n));
    FW_TRY(fw_wafer_write_written_order_json(wafer, &written, own, n, &order));
    FW_TRY(put(w, "masks/", name, ".order.json", &order));
    order = fw_text_new(w->scratch);
    FW_TRY(fw_wafer_write_written_order(wafer, &written, own, n, &order));
    return put(w, "masks/", name, ".order.txt", &order);
}

/* the layered plate, and each plate as the shop writes it */
static fw_status write_plates(writer *w, const fw_plan_flow *pf) {
    const fw_wafer *wafer = pf->wafer ? pf->wafer : pf->single;
    unsigned set;
    if (!fw_mask_formats(w->plan->options.mask_formats, &set)) return FW_USAGE;
    if (pf->wafer) FW_TRY(write_wafer(w, pf, set));
    fw_status status = FW_OK;
    for (int plate = 0; wafer && plate < fw_mask_plates(pf->table) && status == FW_OK; plate++) {
        fw_arena *own = fw_arena_part(w->plan->arena, 0); /* one plate at a time is in hand */
        FW_NEED(own);
        status = write_written_plate(w, pf, wafer, plate, set, own);
        fw_arena_free(own);
    }
    return status;
}

/* beside the run sheet or, where only masks are asked for, beside them */
static fw_status write_release(writer *w, fw_plan_flow *pf, const char *folder) {
    fw_text svg = fw_text_new(w->scratch);
    FW_TRY(draw_release(w->plan, pf, &svg));
    return svg.length ? put(w, folder, pf->use->ref, ".release.svg", &svg) : FW_OK;
}

static fw_status write_recipe(writer *w, fw_plan_flow *pf) {
    static const struct {
        const char *ending;
        fw_status (*write)(const fw_process_flow *flow, const fw_recipe_header *header,
                           fw_text *out);
        bool of_schedule, of_cut, of_measuring;
    } format[] = {{".html", fw_recipe_write_html, .of_cut = false},
                  {".csv", fw_recipe_write_csv, .of_cut = false},
                  {".ics", fw_recipe_write_ics, .of_cut = false},
                  {".json", fw_recipe_write_json, .of_cut = false},
                  {".measurements.json", fw_recipe_write_measurements_json, .of_measuring = true},
                  {".schedule.json", fw_recipe_write_schedule_json, .of_schedule = true},
                  {".schedule.csv", fw_recipe_write_schedule_csv, .of_schedule = true},
                  {".schedule.svg", fw_recipe_write_schedule_svg, .of_schedule = true},
                  {".sections.svg", fw_recipe_write_sections_svg, .of_cut = true},
                  {".sections.json", fw_recipe_write_sections_json, .of_cut = true},
                  {".stack.svg", fw_recipe_write_stack_svg, .of_cut = true}};
    FW_TRY(write_release(w, pf, "recipes/"));
    fw_recipe_header header = fw_plan_recipe_header(w->plan, pf);
    for (size_t i = 0; i < sizeof format / sizeof format[0]; i++) {
        fw_text text = fw_text_new(w->scratch);
        if (format[i].of_schedule && !header.schedule) continue;
        if (format[i].of_cut && !header.cut) continue;
        if (format[i].of_measuring && !header.measuring) continue;
        FW_TRY(format[i].write(pf->flow, &header, &text));
        FW_TRY(put(w, "recipes/", pf->use->ref, format[i].ending, &text));
    }
    return FW_OK;
}

/* SCENE.csv and SCENE.svg; where a scene runs in several flows: SCENE.FLOW.csv for the later ones */
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
            FW_TRY(fw_report_motion_csv(v->mechanism, v->motion[s], &v->mechanism->device->scene[s],
                                        &csv));
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

static fw_status write_manifest(writer *w) {
    size_t count;
    const fw_output_file *file = fw_output_files(w->output, &count);
    w->plan->files_written = (int)count;
    if (count == 0) return FW_OK; /* a rejected design has no masks: no directory either */
    fw_text manifest = fw_text_new(w->scratch);
    FW_TRY(manifest_json(w->plan, file, count, &manifest));
    return put(w, "", "manifest", ".json", &manifest);
}

static fw_status write_all(writer *w, unsigned what) {
    fw_plan *plan = w->plan;
    FW_TRY(fw_plan_assumptions(plan));
    if (what & (FW_WRITE_RECIPES | FW_WRITE_REPORT)) FW_TRY(fw_plan_measurements_find(plan, true));
    if (what & FW_WRITE_VERDICT) {
        fw_text json = fw_text_new(w->scratch);
        FW_TRY(fw_plan_verdict_json(plan, &json));
        FW_TRY(put(w, "", "verdict", ".json", &json));
    }
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    for (int i = 0; given && i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        const bool masks = what & FW_WRITE_MASKS, recipes = what & FW_WRITE_RECIPES;
        if (masks && pf->mask) FW_TRY(write_mask(w, pf));
        if (masks && pf->mask && !recipes) FW_TRY(write_release(w, pf, "masks/"));
        if (masks && pf->violated) FW_TRY(write_violations(w, pf));
        if (masks) FW_TRY(write_plates(w, pf));
        if (recipes && pf->flow) FW_TRY(write_recipe(w, pf));
    }
    if (what & FW_WRITE_MOTION) FW_TRY(write_motions(w));
    if (what & FW_WRITE_REPORT) {
        FW_TRY(write_report(w));
        FW_TRY(write_drawing(w));
    }
    return write_manifest(w);
}

/* a layout that cannot be made, of a device that cannot be judged without it */
static fw_status write_marked(writer *w, unsigned what) {
    (void)what;
    FW_TRY(write_drawing(w));
    return write_manifest(w);
}

static fw_status write_directory(fw_plan *plan, const char *directory, unsigned what,
                                 fw_status (*write)(writer *w, unsigned what)) {
    writer w = {.plan = plan, .scratch = fw_arena_part(plan->arena, plan->options.memory_cap)};
    FW_NEED(w.scratch);
    w.empty = fw_arena_mark(w.scratch);
    plan->files_written = 0;
    fw_status status = fw_output_open(plan->arena, directory, &plan->diags, &w.output);
    if (status == FW_OK) status = write(&w, what);
    const bool whole = status == FW_OK && plan->files_written > 0;
    if (whole) status = fw_output_commit(w.output);
    if (!whole || status != FW_OK) fw_output_abort(w.output);
    fw_arena_free(w.scratch);
    return status;
}

fw_status fw_plan_write(fw_plan *plan, const char *directory, unsigned what) {
    return write_directory(plan, directory, what, write_all);
}

fw_status fw_plan_write_marked(fw_plan *plan, const char *directory) {
    if (!plan->layout || plan->layout->nfault == 0) return FW_OK;
    return write_directory(plan, directory, 0, write_marked);
}
