/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public library: order of calls, arguments and ownership; the work is the plan's. */
#include "plan/design.h"
#include "base/cancel.h"
#include "plan/stages.h"
#include "report/json.h"
#include "report/rest.h"
#include <locale.h>
#include <stdlib.h>
#include <string.h>

enum { READ = 1, JUDGED = 2, FABRICATED = 4, SIMULATED = 8, MODES = 16, STATICS = 32 }; /* done */
enum { ASSEMBLED = 64, ASSEMBLY_TRIED = 128 };
enum { NDOCUMENT = FW_DOCUMENT_ASSEMBLE_SVG + 1 };

struct fw_design {
    fw_plan *plan; /* its arena holds this struct too */
    locale_t locale;
    unsigned done;
    bool tried; /* a description was given, read or not */
    fw_set *set;
    int set_capacity;
    const char *wrong_option; /* a sentence, or NULL */
    const fw_motion *motion;
    const fw_modes *modes;
    const fw_statics *statics;
    const fw_mechanism *mechanism; /* of `scene`, the same for all three */
    const fw_scene *scene;
    fw_plan_assembly assembly;
    fw_terminal_style style;
    fw_text document[NDOCUMENT]; /* data NULL: not composed, or out of date */
    fw_diagnostic *diagnostic;   /* (FW_DIAG_MOST) */
};

/* the codes of the header are those of base/status.h */
#define SAME(code, exit_status, text)                                                              \
    _Static_assert((int)FW_STATUS_##code == (int)FW_##code, "flexwright.h: " #code);
FW_STATUS_TABLE(SAME)
#undef SAME
_Static_assert((int)FW_SEVERITY_NOTE == (int)FW_NOTE &&
                   (int)FW_SEVERITY_WARNING == (int)FW_WARNING &&
                   (int)FW_SEVERITY_ERROR == (int)FW_ERROR,
               "flexwright.h: severities");
_Static_assert((int)FW_DESIGN_VERDICT == (int)FW_WRITE_VERDICT &&
                   (int)FW_DESIGN_MASKS == (int)FW_WRITE_MASKS &&
                   (int)FW_DESIGN_RECIPES == (int)FW_WRITE_RECIPES &&
                   (int)FW_DESIGN_MOTION == (int)FW_WRITE_MOTION &&
                   (int)FW_DESIGN_REPORT == (int)FW_WRITE_REPORT &&
                   (int)FW_DESIGN_EVERYTHING == (int)FW_WRITE_ALL,
               "flexwright.h: what is written");

const char *fw_library_version(void) {
    return FW_VERSION;
}

const char *fw_status_name(int status) {
    switch (status) {
#define NAME(code, exit_status, text)                                                              \
    case FW_STATUS_##code:                                                                         \
        return text;
        FW_STATUS_TABLE(NAME)
#undef NAME
    }
    return "unknown status";
}

fw_plan *fw_design_plan(fw_design *design) {
    return design ? design->plan : NULL;
}

/* ---- options ---- */

void fw_design_options_init(fw_design_options *options, size_t size) {
    if (!options) return;
    fw_design_options all = {.size = size};
    memset(options, 0, size);
    memcpy(options, &all, size < sizeof all ? size : sizeof all);
}

static bool known(const char *name, fw_method_row (*at)(size_t)) {
    for (size_t i = 0; name && at(i).name; i++)
        if (strcmp(name, at(i).name) == 0) return true;
    return !name;
}

/* what is wrong, or NULL; 0 and NULL are defaults. Comparisons are written so that NaN fails. */
static const char *wrong_option(const fw_design_options *o) {
    if (o->accuracy != 0.0 && !(o->accuracy >= 1e-12 && o->accuracy <= 0.1))
        return "accuracy must be 0 (default) or between 1e-12 and 0.1";
    if (o->rtol != 0.0 && !(o->rtol >= 1e-14 && o->rtol <= 1e-2))
        return "rtol must be 0 (from the accuracy) or between 1e-14 and 1e-2";
    if (o->samples != 0 && !(o->samples >= 2 && o->samples <= 1000000))
        return "samples must be 0 (default) or between 2 and 1000000";
    /* below 1.42 nm, rounding to the 1 nm grid would bend arcs the wrong way */
    if (o->mask_tolerance_m != 0.0 && !(o->mask_tolerance_m >= 1.42e-9 * (1.0 - 1e-12) &&
                                        o->mask_tolerance_m <= 1e-6 * (1.0 + 1e-12)))
        return "mask_tolerance_m must be 0 (default) or between 1.42e-9 and 1e-6";
    if (!known(o->method, fw_method_at)) return "method is not known in this version";
    if (!known(o->integrator, fw_integrator_at)) return "integrator is not known in this version";
    if (!known(o->stabilise, fw_stabilisation_at)) return "there is no such stabilisation";
    if (o->at && strcmp(o->at, "rest") != 0 && strcmp(o->at, "equilibrium") != 0)
        return "at must be \"rest\" or \"equilibrium\"";
    return NULL;
}

/* a struct that is not from fw_design_options_init, or of a later version with fields in use that
   are not known here: better refused than silently ignored */
static const char *wrong_size(const fw_design_options *o) {
    enum { LARGEST = 4096 };
    if (o->size < offsetof(fw_design_options, flow) || o->size > LARGEST)
        return "options must come from fw_design_options_default()";
    const unsigned char *byte = (const unsigned char *)o;
    for (size_t i = sizeof *o; i < o->size; i++)
        if (byte[i]) return "an option is set that this version of the library does not know";
    return NULL;
}

static fw_effect_choice effects_of(const char *text) {
    static const char *const word[] = {"auto", "all", "none"};
    for (int i = 0; i < 3; i++)
        if (!text || strcmp(text, word[i]) == 0) return (fw_effect_choice){(fw_effect_mode)i, NULL};
    return (fw_effect_choice){FW_EFFECTS_LIST, text};
}

static fw_status keep(fw_arena *arena, const char **text) {
    if (*text) FW_NEED(*text = fw_arena_strdup(arena, *text));
    return FW_OK;
}

/* the fields that the caller's header knew, their strings copied into the design */
static fw_status take_options(fw_design *d, const fw_design_options *given) {
    fw_design_options o = {0};
    d->wrong_option = given ? wrong_size(given) : NULL;
    if (d->wrong_option) return FW_OK;
    if (given) memcpy(&o, given, given->size < sizeof o ? given->size : sizeof o);
    fw_arena *arena = d->plan->arena;
    const char **text[] = {&o.data_directory, &o.flow,       &o.scene,        &o.effects,
                           &o.method,         &o.integrator, &o.stabilise,    &o.at,
                           &o.independent,    &o.rates,      &o.accelerations};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        FW_TRY(keep(arena, text[i]));
    d->wrong_option = wrong_option(&o);
    fw_plan_options *p = &d->plan->options;
    fw_motion_options *m = &p->verdict.motion;
    p->data_directory = o.data_directory;
    p->flow = o.flow;
    p->scene = o.scene;
    p->mask_tolerance_m = o.mask_tolerance_m;
    p->force = o.force != 0;
    p->path = o.path != 0;
    p->at_equilibrium = o.at && strcmp(o.at, "equilibrium") == 0;
    p->independent = o.independent;
    p->rates = o.rates;
    p->accelerations = o.accelerations;
    m->effects = effects_of(o.effects);
    m->method = o.method;
    m->integrator = o.integrator;
    m->stabilise = o.stabilise;
    m->rtol = o.rtol;
    if (o.accuracy != 0.0) m->accuracy = o.accuracy;
    if (o.samples != 0) m->samples = o.samples;
    return FW_OK;
}

/* ---- life ---- */

static size_t cap_of(const fw_design_options *options) {
    size_t end = offsetof(fw_design_options, memory_cap) + sizeof options->memory_cap;
    return options && options->size >= end ? options->memory_cap : 0;
}

static fw_status fill(fw_design *d, const fw_design_options *options) {
    FW_NEED(d->diagnostic = fw_arena_array(d->plan->arena, fw_diagnostic, FW_DIAG_MOST));
    FW_TRY(take_options(d, options));
    d->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return d->locale == (locale_t)0 ? FW_NOMEM : FW_OK;
}

fw_design *fw_design_new(const fw_design_options *options) {
    fw_plan_options defaults = fw_plan_options_default();
    defaults.memory_cap = cap_of(options);
    fw_plan *plan = fw_plan_new(&defaults);
    fw_design *design = plan ? fw_arena_one(plan->arena, fw_design) : NULL;
    if (design) {
        *design = (fw_design){.plan = plan};
        if (fill(design, options) == FW_OK) return design;
    }
    fw_plan_free(plan);
    return NULL;
}

void fw_design_free(fw_design *design) {
    if (!design) return;
    if (design->locale != (locale_t)0) freelocale(design->locale);
    fw_plan_free(design->plan);
}

/* ---- calls ---- */

static fw_status usage(fw_design *d, const char *what) {
    fw_status status = fw_diag_error(&d->plan->diags, 230, (fw_place){0}, "%s", what);
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

/* all work runs in the "C" locale of this thread, so that the caller's cannot change a byte */
static int run(fw_design *d, fw_status (*work)(fw_design *d, void *argument), void *argument) {
    locale_t before = uselocale(d->locale);
    fw_status status = work(d, argument);
    uselocale(before);
    return (int)status;
}

static void forget_documents(fw_design *d) {
    for (int i = 0; i < NDOCUMENT; i++)
        d->document[i] = (fw_text){0};
}

/* a stage is done once; `work` is not called again after it succeeded */
static int stage(fw_design *d, unsigned before, const char *missing, unsigned self,
                 fw_status (*work)(fw_design *d, void *argument)) {
    if (!d) return FW_STATUS_USAGE;
    if (!(d->done & before)) return (int)usage(d, missing);
    if (d->done & self) return FW_STATUS_OK;
    int status = run(d, work, NULL);
    if (status == FW_STATUS_OK) d->done |= self;
    forget_documents(d);
    return status;
}

int fw_design_set(fw_design *design, const char *path, const char *value) {
    if (!design) return FW_STATUS_USAGE;
    if (!path || !value || !path[0]) return (int)usage(design, "set needs a path and a value");
    if (design->tried) return (int)usage(design, "set values before the description is read");
    fw_plan_options *o = &design->plan->options;
    fw_arena *arena = design->plan->arena;
    if (o->nset == design->set_capacity) {
        int more = design->set_capacity ? 2 * design->set_capacity : 16;
        fw_set *grown =
            fw_arena_grow(arena, design->set, (size_t)o->nset, (size_t)more, sizeof *grown);
        if (!grown) return FW_STATUS_NOMEM;
        design->set = grown;
        design->set_capacity = more;
        o->set = grown;
    }
    fw_set set = {fw_arena_strdup(arena, path), fw_arena_strdup(arena, value)};
    if (!set.path || !set.value) return FW_STATUS_NOMEM;
    design->set[o->nset++] = set;
    return FW_STATUS_OK;
}

typedef struct bytes {
    const char *name;
    const void *data; /* NULL: the file `name` */
    size_t n;
} bytes;

static fw_status read_work(fw_design *d, void *argument) {
    const bytes *in = argument;
    fw_arena *arena = d->plan->arena;
    const char *name = fw_arena_strdup(arena, in->name);
    FW_NEED(name);
    if (!in->data) return fw_plan_load(d->plan, name);
    char *copy = fw_arena_strndup(arena, in->data, in->n);
    FW_NEED(copy);
    return fw_plan_load_memory(d->plan, name, copy, in->n);
}

static int read_from(fw_design *d, bytes in) {
    if (d->tried) return (int)usage(d, "one design reads one description");
    if (d->wrong_option) return (int)usage(d, d->wrong_option);
    d->tried = true;
    int status = run(d, read_work, &in);
    if (status == FW_STATUS_OK) d->done |= READ;
    return status;
}

int fw_design_read(fw_design *design, const char *path) {
    if (!design) return FW_STATUS_USAGE;
    if (!path) return (int)usage(design, "read needs the name of a file");
    return read_from(design, (bytes){.name = path});
}

int fw_design_read_memory(fw_design *design, const char *name, const void *xml, size_t n) {
    if (!design) return FW_STATUS_USAGE;
    if (!xml) return (int)usage(design, "read_memory needs the bytes of a description");
    if (n > SIZE_MAX / 2) return (int)usage(design, "read_memory: the length is not possible");
    return read_from(design, (bytes){name ? name : "memory", xml, n});
}

const char *fw_design_name(const fw_design *design) {
    return design && design->plan->device ? design->plan->device->name : NULL;
}

static fw_status judge_work(fw_design *d, void *argument) {
    (void)argument;
    return fw_plan_judge(d->plan);
}

int fw_design_judge(fw_design *design) {
    return stage(design, READ, "read a description before judging it", JUDGED, judge_work);
}

int fw_design_decision(const fw_design *design) {
    if (!design || !(design->done & JUDGED)) return -1;
    const fw_plan *plan = design->plan;
    if (plan->verdict.decision == FW_REJECT) return 1;
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].flow && plan->flow[i].flow->manufacturable == 0) return 1;
    return plan->verdict.decision == FW_INCONCLUSIVE ? 4 : 0;
}

static fw_status fabricate_work(fw_design *d, void *argument) {
    (void)argument;
    return fw_plan_fabricate(d->plan);
}

int fw_design_fabricate(fw_design *design) {
    return stage(design, JUDGED, "judge a design before masks are made", FABRICATED,
                 fabricate_work);
}

/* kept only of stages that succeeded, so that an earlier one's documents stay whole */
static fw_status subject(fw_design *d, const fw_mechanism *mechanism, const fw_scene *scene) {
    d->mechanism = mechanism;
    d->scene = scene;
    return FW_OK;
}

static fw_status modes_work(fw_design *d, void *argument) {
    (void)argument;
    const fw_mechanism *mechanism;
    const fw_scene *scene;
    FW_TRY(fw_plan_modes(d->plan, &d->modes, &mechanism, &scene));
    return subject(d, mechanism, scene);
}

int fw_design_modes(fw_design *design) {
    return stage(design, READ, "read a description before its modes are computed", MODES,
                 modes_work);
}

static fw_status statics_work(fw_design *d, void *argument) {
    (void)argument;
    const fw_mechanism *mechanism;
    const fw_scene *scene;
    FW_TRY(fw_plan_statics(d->plan, &d->statics, &mechanism, &scene));
    return subject(d, mechanism, scene);
}

int fw_design_statics(fw_design *design) {
    return stage(design, READ, "read a description before its equilibrium is computed", STATICS,
                 statics_work);
}

static fw_status simulate_work(fw_design *d, void *argument) {
    (void)argument;
    const fw_mechanism *mechanism;
    const fw_scene *scene;
    FW_TRY(fw_plan_simulate(d->plan, &d->motion, &mechanism, &scene));
    return subject(d, mechanism, scene);
}

int fw_design_simulate(fw_design *design) {
    return stage(design, READ, "read a description before simulating it", SIMULATED, simulate_work);
}

/* ---- assemble ---- */

static fw_status assemble_work(fw_design *d, void *argument) {
    (void)argument;
    return fw_plan_assemble(d->plan, &d->assembly);
}

int fw_design_assemble(fw_design *design) {
    int status =
        stage(design, READ, "read a description before assembling it", ASSEMBLED, assemble_work);
    if (design && design->assembly.assembly) design->done |= ASSEMBLY_TRIED;
    return status;
}

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
    if (!design) return FW_STATUS_USAGE;
    if (!directory || !directory[0]) return (int)usage(design, "write needs a directory");
    if (what & ~(unsigned)FW_DESIGN_EVERYTHING)
        return (int)usage(design, "write knows the bits of FW_DESIGN_EVERYTHING only");
    if (!(design->done & JUDGED)) return (int)usage(design, "judge a design before writing it");
    if ((what & (FW_DESIGN_MASKS | FW_DESIGN_RECIPES)) && !(design->done & FABRICATED))
        return (int)usage(design, "call fabricate before masks and recipes are written");
    return run(design, write_work, &(target){directory, what});
}

int fw_design_files_written(const fw_design *design) {
    return design && design->plan ? design->plan->files_written : 0;
}

/* ---- documents ---- */

static fw_status verdict_json(fw_design *d, fw_text *out) {
    return fw_plan_verdict_json(d->plan, out);
}

static fw_status verdict_text(fw_design *d, fw_text *out) {
    return fw_plan_verdict_text(d->plan, d->style, out);
}

static fw_status simulate_json(fw_design *d, fw_text *out) {
    return fw_report_simulate_json(d->mechanism, d->motion, out);
}

static fw_status simulate_text(fw_design *d, fw_text *out) {
    return fw_report_simulate_text(d->scene, d->mechanism, d->motion, out);
}

static fw_status motion_csv(fw_design *d, fw_text *out) {
    return fw_report_motion_csv(d->mechanism, d->motion, out);
}

static fw_status animation_svg(fw_design *d, fw_text *out) {
    return fw_report_animation_svg(d->plan->arena, d->plan->device, d->plan->layout, d->mechanism,
                                   d->motion, d->scene, out);
}

static fw_status modes_json(fw_design *d, fw_text *out) {
    return fw_report_modes_json(d->mechanism, d->scene, d->modes, out);
}

static fw_status modes_text(fw_design *d, fw_text *out) {
    return fw_report_modes_text(d->scene, d->modes, out);
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
static fw_status diagnostics_text(fw_design *d, fw_text *out) {
    const fw_plan *p = d->plan;
    fw_diag item[FW_DIAG_MOST];
    fw_diags shown = p->diags;
    shown.item = item;
    shown.count = 0;
    for (size_t i = 0; i < p->diags.count; i++)
        if ((int)p->diags.item[i].severity >= (int)FW_WARNING - d->style.detail)
            item[shown.count++] = p->diags.item[i];
    fw_diags_print(&shown, out, p->source_file, p->source, p->source_length, d->style.colour);
    return fw_text_end(out);
}

/* one row per document: what must be done before it, and who composes it */
static const struct {
    unsigned needs;
    fw_status (*compose)(fw_design *d, fw_text *out);
} document_table[NDOCUMENT] = {
    [FW_DOCUMENT_VERDICT_JSON] = {JUDGED, verdict_json},
    [FW_DOCUMENT_VERDICT_TEXT] = {JUDGED, verdict_text},
    [FW_DOCUMENT_SIMULATE_JSON] = {SIMULATED, simulate_json},
    [FW_DOCUMENT_SIMULATE_TEXT] = {SIMULATED, simulate_text},
    [FW_DOCUMENT_MOTION_CSV] = {SIMULATED, motion_csv},
    [FW_DOCUMENT_ANIMATION_SVG] = {SIMULATED, animation_svg},
    [FW_DOCUMENT_MASKS_JSON] = {FABRICATED, masks_json},
    [FW_DOCUMENT_RECIPES_JSON] = {FABRICATED, recipes_json},
    [FW_DOCUMENT_DEVICE_SVG] = {JUDGED, device_svg},
    [FW_DOCUMENT_REPORT_HTML] = {JUDGED, report_html},
    [FW_DOCUMENT_DIAGNOSTICS_TEXT] = {0, diagnostics_text},
    [FW_DOCUMENT_MODES_JSON] = {MODES, modes_json},
    [FW_DOCUMENT_MODES_TEXT] = {MODES, modes_text},
    [FW_DOCUMENT_MODES_SVG] = {MODES, modes_svg},
    [FW_DOCUMENT_STATICS_JSON] = {STATICS, statics_json},
    [FW_DOCUMENT_STATICS_TEXT] = {STATICS, statics_text},
    [FW_DOCUMENT_STATICS_SVG] = {STATICS, statics_svg},
    [FW_DOCUMENT_LOAD_PATH_CSV] = {STATICS, load_path_csv},
    [FW_DOCUMENT_LOAD_PATH_SVG] = {STATICS, load_path_svg},
    [FW_DOCUMENT_ASSEMBLE_JSON] = {ASSEMBLED, assemble_json},
    [FW_DOCUMENT_ASSEMBLE_TEXT] = {ASSEMBLED, assemble_text},
    [FW_DOCUMENT_ASSEMBLE_SVG] = {ASSEMBLY_TRIED, assemble_svg},
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
    if (!design) return FW_STATUS_USAGE;
    if (!text) return (int)usage(design, "document needs a place for the text");
    if (document < 0 || document >= NDOCUMENT || !document_table[document].compose)
        return (int)usage(design, "no such document");
    unsigned needs = document_table[document].needs;
    if ((design->done & needs) != needs)
        return (int)usage(design, "the stage that makes this document was not called");
    fw_text *have = &design->document[document];
    if (!have->data || document == FW_DOCUMENT_DIAGNOSTICS_TEXT) { /* these come at any time */
        int status = run(design, document_work, &document);
        if (status != FW_STATUS_OK) return status;
    }
    *text = have->data;
    if (length) *length = have->length;
    return FW_STATUS_OK;
}

static fw_status save_work(fw_design *d, void *argument) {
    const bytes *b = argument;
    const char *path = fw_arena_strdup(d->plan->arena, b->name); /* diagnostics keep it */
    FW_NEED(path);
    return fw_output_single(d->plan->arena, path, b->data, b->n, &d->plan->diags);
}

int fw_design_save(fw_design *design, int document, const char *path) {
    if (!design) return FW_STATUS_USAGE;
    if (!path || !path[0]) return (int)usage(design, "save needs the name of a file");
    const char *text;
    size_t n;
    int status = fw_design_document(design, document, &text, &n);
    if (status != FW_STATUS_OK) return status;
    return run(design, save_work, &(bytes){path, text, n});
}

int fw_design_text_style(fw_design *design, int detail, int colour) {
    if (!design) return FW_STATUS_USAGE;
    if (detail < FW_DETAIL_QUIET || detail > FW_DETAIL_VERBOSE)
        return (int)usage(design, "detail is -1, 0 or 1");
    design->style = (fw_terminal_style){detail, colour != 0};
    forget_documents(design);
    return FW_STATUS_OK;
}

/* ---- diagnostics, cancelling ---- */

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
                                            .message = d->message};
    return &design->diagnostic[i];
}

void fw_design_cancel(fw_design *design) {
    (void)design; /* the flag is the process's today */
    fw_cancel_request(2);
}

void fw_design_cancel_clear(fw_design *design) {
    (void)design;
    fw_cancel_clear();
}
