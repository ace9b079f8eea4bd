/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the public library hands out: documents, one row each, and numbers, a row per set, composed when first
   asked for; files, and diagnostics. */
#include "base/json.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "report/report.h"
#include <stdio.h>
#include <string.h>

/* ---- documents ---- */

static fw_status verdict_json(fw_design *d, fw_text *out) {
    return fw_plan_verdict_json(d->plan, out);
}

static fw_status verdict_text(fw_design *d, fw_text *out) {
    return fw_plan_verdict_text(d->plan, d->style, out);
}

static fw_status simulate_json(fw_design *d, fw_text *out) {
    FW_TRY(fw_plan_design_know(d, FW_WANTED_FIGURES));
    return fw_report_simulate_json(d->mechanism, d->motion, out);
}

static fw_status simulate_text(fw_design *d, fw_text *out) {
    FW_TRY(fw_plan_design_know(d, FW_WANTED_FIGURES));
    return fw_report_simulate_text(d->scene, d->mechanism, d->motion, out);
}

/* with all of its rows */
static const fw_dynamics_motion *whole(const fw_design *d) {
    fw_dynamics_motion_rows(d->motion, 0, d->motion->nsample);
    return d->motion;
}

static fw_status motion_csv(fw_design *d, fw_text *out) {
    return fw_report_motion_csv(d->mechanism, whole(d), d->scene, out);
}

static fw_status forces_csv(fw_design *d, fw_text *out) {
    return fw_report_forces_csv(d->mechanism, whole(d), out);
}

static fw_status animation_svg(fw_design *d, fw_text *out) {
    return fw_report_animation_svg(d->plan->arena, d->plan->device, d->plan->layout, d->mechanism,
                                   whole(d), d->scene, out);
}

static fw_status modes_json(fw_design *d, fw_text *out) {
    return fw_report_modes_json(d->mechanism, d->scene, d->modes, out);
}

static fw_status modes_text(fw_design *d, fw_text *out) {
    return fw_report_modes_text(d->mechanism, d->scene, d->modes, out);
}

static fw_status modes_svg(fw_design *d, fw_text *out) {
    const fw_plan *p = d->plan;
    return fw_report_modes_svg(p->arena, p->device, p->layout, d->mechanism, d->scene, d->modes,
                               out);
}

static fw_status statics_json(fw_design *d, fw_text *out) {
    return fw_report_statics_json(d->mechanism, d->scene, d->statics, out);
}

static fw_status statics_text(fw_design *d, fw_text *out) {
    return fw_report_statics_text(d->mechanism, d->scene, d->statics, out);
}

static fw_status statics_svg(fw_design *d, fw_text *out) {
    const fw_plan *p = d->plan;
    return fw_report_statics_svg(p->arena, p->device, p->layout, d->mechanism, d->scene, d->statics,
                                 out);
}

static fw_status load_path_csv(fw_design *d, fw_text *out) {
    return fw_report_load_path_csv(d->mechanism, d->statics, out);
}

static fw_status load_path_svg(fw_design *d, fw_text *out) {
    const fw_plan *p = d->plan;
    return fw_report_load_path_svg(p->arena, p->device, d->mechanism, d->scene, d->statics, out);
}

static fw_report_assembly assembly_input(const fw_design *d) {
    const fw_plan_assembly *a = &d->assembly;
    return (fw_report_assembly){d->plan->device, d->plan->layout, a->mechanism, a->scene,
                                a->assembly,     a->kinematics,   a->motion,    a->closed};
}

static fw_status assemble_json(fw_design *d, fw_text *out) {
    fw_report_assembly in = assembly_input(d);
    return fw_report_assemble_json(&in, out);
}

static fw_status assemble_text(fw_design *d, fw_text *out) {
    fw_report_assembly in = assembly_input(d);
    return fw_report_assemble_text(&in, out);
}

static fw_status assemble_svg(fw_design *d, fw_text *out) {
    fw_report_assembly in = assembly_input(d);
    return fw_report_assemble_svg(d->plan->arena, &in, out);
}

static fw_status workspace_json(fw_design *d, fw_text *out) {
    return fw_report_workspace_json(&d->workspace, out);
}

static fw_status workspace_text(fw_design *d, fw_text *out) {
    return fw_report_workspace_text(&d->workspace, out);
}

static fw_status workspace_svg(fw_design *d, fw_text *out) {
    return fw_report_workspace_svg(d->plan->arena, &d->workspace, out);
}

static fw_status certificate_json(fw_design *d, fw_text *out) {
    return fw_report_certificate_json(&d->workspace, out);
}

static fw_status table_json(fw_design *d, fw_text *out) {
    (void)d;
    return fw_plan_table_json(out);
}

static fw_status tradeoff_json(fw_design *d, fw_text *out) {
    return d->tradeoff_document[0](d->tradeoff, out);
}

static fw_status tradeoff_text(fw_design *d, fw_text *out) {
    return d->tradeoff_document[1](d->tradeoff, out);
}

static fw_status tradeoff_csv(fw_design *d, fw_text *out) {
    return d->tradeoff_document[2](d->tradeoff, out);
}

static fw_status tradeoff_svg(fw_design *d, fw_text *out) {
    return d->tradeoff_document[3](d->tradeoff, out);
}

static fw_status masks_json(fw_design *d, fw_text *out) {
    return fw_plan_masks_json(d->plan, out);
}

static fw_status recipes_json(fw_design *d, fw_text *out) {
    return fw_plan_recipes_json(d->plan, out);
}

static fw_status device_svg(fw_design *d, fw_text *out) {
    fw_plan *p = d->plan;
    return fw_report_device_svg(p->arena, p->device, p->layout, &p->verdict, out);
}

static fw_status report_html(fw_design *d, fw_text *out) {
    return fw_plan_report_html(d->plan, out);
}

/* those serious enough for the style; notes of a quiet run are not lost, only not shown */
static bool wanted(fw_severity severity, int detail) {
    switch (severity) {
    case FW_NOTE:
        return detail > 0;
    case FW_WARNING:
        return detail >= 0;
    case FW_ERROR:
        break;
    }
    return true;
}

static fw_status diagnostics_text(fw_design *d, fw_text *out) {
    const fw_plan *p = d->plan;
    fw_diag item[FW_DIAG_MOST];
    fw_diags shown = p->diags;
    shown.item = item;
    shown.count = 0;
    for (size_t i = 0; i < p->diags.count; i++)
        if (p->diags.item[i].unreliable || wanted(p->diags.item[i].severity, d->style.detail))
            item[shown.count++] = p->diags.item[i];
    fw_diags_print(&shown, out, p->source_file, p->source, p->source_length, d->style.colour);
    return fw_text_end(out);
}

fw_status fw_plan_diags_json(const fw_diags *diags, fw_text *out) {
    static const char *const severity[] = {
        [FW_NOTE] = "note", [FW_WARNING] = "warning", [FW_ERROR] = "error"};
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.diagnostics/1");
    fw_json_list(&json, "diagnostics");
    for (size_t i = 0; i < diags->count; i++) {
        const fw_diag *item = &diags->item[i];
        char code[16];
        snprintf(code, sizeof code, "FW-D%03d", item->number);
        fw_json_object(&json, NULL);
        fw_json_text(&json, "code", code);
        fw_json_text(&json, "severity", severity[item->severity]);
        fw_json_text(&json, "file", item->place.file);
        fw_json_whole(&json, "line", item->place.line);
        fw_json_whole(&json, "column", item->place.column);
        fw_json_text(&json, "message", item->message);
        fw_json_end(&json);
    }
    fw_json_end(&json);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

static fw_status diagnostics_json(fw_design *d, fw_text *out) {
    return fw_plan_diags_json(&d->plan->diags, out);
}

/* one row per document: what must be done before it, and who composes it */
static const struct {
    unsigned needs;
    fw_status (*compose)(fw_design *d, fw_text *out);
} document_table[FW_DESIGN_DOCUMENTS] = {
    [FW_DOCUMENT_VERDICT_JSON] = {FW_DONE_JUDGED, verdict_json},
    [FW_DOCUMENT_VERDICT_TEXT] = {FW_DONE_JUDGED, verdict_text},
    [FW_DOCUMENT_SIMULATE_JSON] = {FW_DONE_SIMULATED, simulate_json},
    [FW_DOCUMENT_SIMULATE_TEXT] = {FW_DONE_SIMULATED, simulate_text},
    [FW_DOCUMENT_MOTION_CSV] = {FW_DONE_SIMULATED, motion_csv},
    [FW_DOCUMENT_FORCES_CSV] = {FW_DONE_SIMULATED, forces_csv},
    [FW_DOCUMENT_ANIMATION_SVG] = {FW_DONE_SIMULATED, animation_svg},
    [FW_DOCUMENT_MASKS_JSON] = {FW_DONE_FABRICATED, masks_json},
    [FW_DOCUMENT_RECIPES_JSON] = {FW_DONE_FABRICATED, recipes_json},
    [FW_DOCUMENT_DEVICE_SVG] = {FW_DONE_JUDGED, device_svg},
    [FW_DOCUMENT_REPORT_HTML] = {FW_DONE_JUDGED, report_html},
    [FW_DOCUMENT_DIAGNOSTICS_TEXT] = {0, diagnostics_text},
    [FW_DOCUMENT_DIAGNOSTICS_JSON] = {0, diagnostics_json},
    [FW_DOCUMENT_MODES_JSON] = {FW_DONE_MODES, modes_json},
    [FW_DOCUMENT_MODES_TEXT] = {FW_DONE_MODES, modes_text},
    [FW_DOCUMENT_MODES_SVG] = {FW_DONE_MODES, modes_svg},
    [FW_DOCUMENT_STATICS_JSON] = {FW_DONE_STATICS, statics_json},
    [FW_DOCUMENT_STATICS_TEXT] = {FW_DONE_STATICS, statics_text},
    [FW_DOCUMENT_STATICS_SVG] = {FW_DONE_STATICS, statics_svg},
    [FW_DOCUMENT_LOAD_PATH_CSV] = {FW_DONE_STATICS, load_path_csv},
    [FW_DOCUMENT_LOAD_PATH_SVG] = {FW_DONE_STATICS, load_path_svg},
    [FW_DOCUMENT_ASSEMBLE_JSON] = {FW_DONE_ASSEMBLED, assemble_json},
    [FW_DOCUMENT_ASSEMBLE_TEXT] = {FW_DONE_ASSEMBLED, assemble_text},
    [FW_DOCUMENT_ASSEMBLE_SVG] = {FW_DONE_ASSEMBLY_TRIED, assemble_svg},
    [FW_DOCUMENT_WORKSPACE_JSON] = {FW_DONE_WORKSPACE, workspace_json},
    [FW_DOCUMENT_WORKSPACE_TEXT] = {FW_DONE_WORKSPACE, workspace_text},
    [FW_DOCUMENT_WORKSPACE_SVG] = {FW_DONE_WORKSPACE, workspace_svg},
    [FW_DOCUMENT_CERTIFICATE_JSON] = {FW_DONE_WORKSPACE, certificate_json},
    [FW_DOCUMENT_TABLE_JSON] = {0, table_json},
    [FW_DOCUMENT_PREVIEW_JSON] = {FW_DONE_READ, fw_plan_design_preview_json},
    [FW_DOCUMENT_TRADEOFF_JSON] = {FW_DONE_TRADEOFF, tradeoff_json},
    [FW_DOCUMENT_TRADEOFF_TEXT] = {FW_DONE_TRADEOFF, tradeoff_text},
    [FW_DOCUMENT_TRADEOFF_CSV] = {FW_DONE_TRADEOFF, tradeoff_csv},
    [FW_DOCUMENT_TRADEOFF_SVG] = {FW_DONE_TRADEOFF, tradeoff_svg},
};

static fw_status document_work(fw_design *d, void *argument) {
    int which = *(const int *)argument;
    fw_text text = fw_text_new(d->plan->arena);
    fw_text_add(&text, ""); /* so that an empty document has a NUL too */
    FW_TRY(document_table[which].compose(d, &text));
    FW_TRY(fw_text_end(&text));
    d->document[which] = text;
    return FW_OK;
}

int fw_design_document(fw_design *design, int document, const char **text, size_t *length) {
    if (text) *text = NULL;
    if (length) *length = 0;
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (!text) return (int)fw_plan_design_usage(design, "document needs a place for the text");
    if (document < 0 || document >= FW_DESIGN_DOCUMENTS || !document_table[document].compose)
        return (int)fw_plan_design_usage(design, "no such document");
    unsigned needs = document_table[document].needs;
    if ((design->done & needs) != needs)
        return (int)fw_plan_design_usage(design,
                                         "the stage that makes this document was not called");
    fw_text *have = &design->document[document];
    const bool grows = document == FW_DOCUMENT_DIAGNOSTICS_TEXT ||
                       document == FW_DOCUMENT_DIAGNOSTICS_JSON; /* these come at any time */
    if (!have->data || grows) {
        int status = fw_plan_design_run(design, document_work, &document);
        if (status != FW_STATUS_OK) return status;
    }
    *text = have->data;
    if (length) *length = have->length;
    return FW_STATUS_OK;
}

static fw_status save_work(fw_design *d, void *argument) {
    const fw_plan_bytes *b = argument;
    const char *path = fw_arena_strdup(d->plan->arena, b->name); /* diagnostics keep it */
    FW_NEED(path);
    return fw_output_single(d->plan->arena, path, b->data, b->n, &d->plan->diags);
}

int fw_design_save(fw_design *design, int document, const char *path) {
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (!path || !path[0])
        return (int)fw_plan_design_usage(design, "save needs the name of a file");
    const char *text;
    size_t n;
    int status = fw_design_document(design, document, &text, &n);
    if (status != FW_STATUS_OK) return status;
    return fw_plan_design_run(design, save_work, &(fw_plan_bytes){path, text, n});
}

int fw_design_text_style(fw_design *design, int detail, int colour) {
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (detail < FW_DETAIL_QUIET || detail > FW_DETAIL_VERBOSE)
        return (int)fw_plan_design_usage(design, "detail is -1, 0 or 1");
    design->style = (fw_report_terminal_style){detail, colour != 0};
    fw_plan_design_forget_documents(design);
    return FW_STATUS_OK;
}

/* ---- files ---- */

typedef struct target {
    const char *directory;
    unsigned what;
} target;

static fw_status write_work(fw_design *d, void *argument) {
    const target *t = argument;
    const char *directory = fw_arena_strdup(d->plan->arena, t->directory);
    FW_NEED(directory);
    return fw_plan_write(d->plan, directory, t->what);
}

int fw_design_write(fw_design *design, const char *directory, unsigned what) {
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (!directory || !directory[0])
        return (int)fw_plan_design_usage(design, "write needs a directory");
    if (what & ~(unsigned)FW_DESIGN_EVERYTHING)
        return (int)fw_plan_design_usage(design,
                                         "write knows the bits of FW_DESIGN_EVERYTHING only");
    if (!(design->done & FW_DONE_JUDGED))
        return (int)fw_plan_design_usage(design, "judge a design before writing it");
    if ((what & (FW_DESIGN_MASKS | FW_DESIGN_RECIPES)) && !(design->done & FW_DONE_FABRICATED))
        return (int)fw_plan_design_usage(design,
                                         "call fabricate before masks and recipes are written");
    return fw_plan_design_run(design, write_work, &(target){directory, what});
}

int fw_design_files_written(const fw_design *design) {
    return design && design->plan ? design->plan->files_written : 0;
}

/* ---- numbers ---- */

static const struct {
    unsigned needs;
    fw_plan_compose *compose;
} set_table[FW_DESIGN_NUMBERS] = {
    [FW_NUMBERS_PARAMETERS] = {FW_DONE_READ, fw_plan_numbers_parameters},
    [FW_NUMBERS_SCENES] = {FW_DONE_READ, fw_plan_numbers_scenes},
    [FW_NUMBERS_HINGES] = {FW_DONE_JUDGED, fw_plan_numbers_hinges},
    [FW_NUMBERS_FLOW_HINGES] = {FW_DONE_JUDGED, fw_plan_numbers_flow_hinges},
    [FW_NUMBERS_FLOWS] = {FW_DONE_JUDGED, fw_plan_numbers_flows},
    [FW_NUMBERS_GOVERNING] = {FW_DONE_JUDGED, fw_plan_numbers_governing},
    [FW_NUMBERS_CLEARANCES] = {FW_DONE_JUDGED, fw_plan_numbers_clearances},
    [FW_NUMBERS_REQUIREMENTS] = {FW_DONE_JUDGED, fw_plan_numbers_requirements},
    [FW_NUMBERS_PROBES] = {FW_DONE_JUDGED, fw_plan_numbers_probes},
    [FW_NUMBERS_MOTION] = {FW_DONE_SIMULATED, fw_plan_numbers_motion},
    [FW_NUMBERS_PEAKS] = {FW_DONE_SIMULATED, fw_plan_numbers_peaks},
    [FW_NUMBERS_MOTION_PROBES] = {FW_DONE_SIMULATED, fw_plan_numbers_motion_probes},
    [FW_NUMBERS_MODES] = {FW_DONE_MODES, fw_plan_numbers_modes},
    [FW_NUMBERS_STATICS] = {FW_DONE_STATICS, fw_plan_numbers_statics},
    [FW_NUMBERS_LOAD_PATH] = {FW_DONE_STATICS, fw_plan_numbers_load_path},
    [FW_NUMBERS_ASSEMBLY] = {FW_DONE_ASSEMBLED, fw_plan_numbers_assembly},
    [FW_NUMBERS_WORKSPACE] = {FW_DONE_WORKSPACE, fw_plan_numbers_workspace},
};

static bool is_set(int numbers) {
    return numbers >= 0 && numbers < FW_DESIGN_NUMBERS;
}

static fw_status compose(fw_design *d, void *argument) {
    const int numbers = *(const int *)argument;
    fw_plan_arrays *to = fw_arena_one(d->plan->arena, fw_plan_arrays);
    FW_NEED(to);
    to->arena = d->plan->arena;
    FW_TRY(set_table[numbers].compose(d, to));
    if (to->no_memory) return FW_NOMEM;
    d->numbers[numbers] = to;
    return FW_OK;
}

int fw_design_arrays(fw_design *design, int numbers, size_t *count) {
    if (count) *count = 0;
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (!is_set(numbers)) return (int)fw_plan_design_usage(design, "no such set of numbers");
    const unsigned needs = set_table[numbers].needs;
    if ((design->done & needs) != needs)
        return (int)fw_plan_design_usage(design,
                                         "the stage that makes these numbers was not called");
    if (!design->numbers[numbers]) {
        const int status = fw_plan_design_run(design, compose, &numbers);
        if (status != FW_STATUS_OK) return status;
    }
    if (count) *count = design->numbers[numbers]->count;
    return FW_STATUS_OK;
}

/* composed, if that can be; it adds no diagnostic where it cannot */
static const fw_plan_arrays *set_of(fw_design *design, int numbers) {
    if (!design || !is_set(numbers)) return NULL;
    const unsigned needs = set_table[numbers].needs;
    if ((design->done & needs) != needs) return NULL;
    if (!design->numbers[numbers] && fw_design_arrays(design, numbers, NULL) != FW_STATUS_OK)
        return NULL;
    return design->numbers[numbers];
}

const fw_array *fw_design_array(fw_design *design, int numbers, size_t i) {
    const fw_plan_arrays *set = set_of(design, numbers);
    return set && i < set->count ? set->item[i] : NULL;
}

const fw_array *fw_design_array_named(fw_design *design, int numbers, const char *name) {
    const fw_plan_arrays *set = set_of(design, numbers);
    for (size_t i = 0; set && name && i < set->count; i++)
        if (strcmp(set->item[i]->name, name) == 0) return set->item[i];
    return NULL;
}

/* ---- what is said of it ---- */

int fw_design_unreliable(const fw_design *design) {
    return design && design->plan && design->plan->diags.unreliable > 0;
}

size_t fw_design_diagnostics(const fw_design *design) {
    return design ? design->plan->diags.count : 0;
}

const fw_diagnostic *fw_design_diagnostic(fw_design *design, size_t i) {
    if (!design || i >= design->plan->diags.count) return NULL;
    const fw_diag *d = &design->plan->diags.item[i];
    design->diagnostic[i] = (fw_diagnostic){.number = d->number,
                                            .severity = (int32_t)d->severity,
                                            .file = d->place.file,
                                            .line = d->place.line,
                                            .column = d->place.column,
                                            .message = d->message,
                                            .system_error = d->reason};
    return &design->diagnostic[i];
}

size_t fw_design_diagnostics_before(const fw_design *design) {
    return design ? design->plan->diags.before : 0;
}
