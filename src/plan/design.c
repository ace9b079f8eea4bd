/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public library: order of calls, arguments and ownership; the work is the plan's. */
#include "plan/design.h"
#include "plan/stages.h"
#include <locale.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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

fw_plan *fw_plan_design_plan(fw_design *design) {
    return design ? design->plan : NULL;
}

/* ---- options ---- */

void fw_design_options_init(fw_design_options *options, size_t size) {
    if (!options) return;
    fw_design_options all = {.size = size};
    memset(options, 0, size);
    memcpy(options, &all, size < sizeof all ? size : sizeof all);
}

static bool known(const char *name, fw_multibody_method_row (*at)(size_t)) {
    for (size_t i = 0; name && at(i).name; i++)
        if (strcmp(name, at(i).name) == 0) return true;
    return !name;
}

/* -1: there is no such model */
static int hinge_model_of(const char *text) {
    for (size_t i = 0; i < fw_effects_hinge_model_count(); i++)
        if (!text || strcmp(text, fw_effects_hinge_model_text((fw_effects_hinge_model)i)) == 0)
            return (int)i;
    return -1;
}

static bool is_none(const char *text) {
    return text && strcmp(text, "none") == 0;
}

static bool auto_or_none(const char *text) {
    return !text || strcmp(text, "auto") == 0 || is_none(text);
}

/* what is wrong, or NULL; 0 and NULL are defaults. Comparisons are written so that NaN fails. */
static const char *wrong_option(const fw_design_options *o) {
    if (o->accuracy != 0.0 &&
        !(o->accuracy >= FW_ACCURACY_LEAST && o->accuracy <= FW_ACCURACY_MOST))
        return "accuracy must be 0 (default) or between 1e-12 and 0.1";
    if (o->rtol != 0.0 && !(o->rtol >= FW_RTOL_LEAST && o->rtol <= FW_RTOL_MOST))
        return "rtol must be 0 (from the accuracy) or between 1e-14 and 1e-2";
    if (o->samples != 0 && !(o->samples >= 2 && o->samples <= 1000000))
        return "samples must be 0 (default) or between 2 and 1000000";
    /* below 0.36 nm, rounding to the 1 nm grid would bend every arc the wrong way */
    if (o->mask_tolerance_m != 0.0 && !(o->mask_tolerance_m >= 0.36e-9 * (1.0 - 1e-12) &&
                                        o->mask_tolerance_m <= 1e-6 * (1.0 + 1e-12)))
        return "mask_tolerance_m must be 0 (default) or between 0.36e-9 and 1e-6";
    if (hinge_model_of(o->hinge_model) < 0)
        return "hinge_model must name one of the models that flexwright plan --help lists";
    unsigned formats;
    if (!fw_mask_formats(o->mask_formats, &formats))
        return "mask_formats must name some of the formats that flexwright plan --help lists, with "
               "commas between, or be \"all\"";
    fw_geometry_flattening flattening;
    if (!fw_mask_flattening_named(o->mask_flatten, &flattening))
        return "mask_flatten must be \"inside\" or \"equal-area\"";
    if (o->mask_vertices != 0 && o->mask_vertices != 199 && o->mask_vertices != 4094 &&
        o->mask_vertices != 8190)
        return "mask_vertices must be 0 (default), 199, 4094 or 8190";
    fw_schedule_calendar day;
    if (o->day && !fw_schedule_calendar_parse(o->day, &day))
        return "day must be like \"08:00-18:00\", or \"none\" for round the clock";
    if (o->wafers < 0 || o->wafers > 50 || o->operators < 0 || o->operators > 50)
        return "wafers and operators must be 0 (default) or between 1 and 50";
    if (!known(o->method, fw_multibody_method_at)) return "method is not known in this version";
    if (!known(o->integrator, fw_dynamics_integrator_at))
        return "integrator is not known in this version";
    if (!known(o->stabilise, fw_dynamics_stabilisation_at)) return "there is no such stabilisation";
    if (!auto_or_none(o->corners)) return "corners must be auto or none";
    if (!auto_or_none(o->advice)) return "advice must be auto or none";
    if (!auto_or_none(o->measurements) && strcmp(o->measurements, "all") != 0)
        return "measurements must be auto, all or none";
    if (o->jobs < 0 || o->jobs > FW_JOBS_MOST)
        return "jobs must be 0 (default) or between 1 and 256";
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
        if (!text || strcmp(text, word[i]) == 0)
            return (fw_effect_choice){.mode = (fw_effect_mode)i};
    return (fw_effect_choice){.mode = FW_EFFECTS_LIST, .list = text};
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
    const char **text[] = {&o.data_directory, &o.flow,         &o.scene,         &o.effects,
                           &o.method,         &o.integrator,   &o.stabilise,     &o.at,
                           &o.independent,    &o.rates,        &o.accelerations, &o.corners,
                           &o.hinge_model,    &o.mask_formats, &o.mask_flatten,  &o.day,
                           &o.planning_times, &o.laboratory,   &o.cut,           &o.advice,
                           &o.measurements,   &o.layers,       &o.directory};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        FW_TRY(keep(arena, text[i]));
    d->wrong_option = wrong_option(&o);
    d->given = o;
    d->given.size = sizeof o;
    fw_plan_options *p = &d->plan->options;
    fw_dynamics_motion_options *m = &p->verdict.motion;
    p->data_directory = o.data_directory;
    p->flow = o.flow;
    p->scene = o.scene;
    p->mask_tolerance_m = o.mask_tolerance_m;
    p->mask_formats = o.mask_formats;
    p->mask_vertices = o.mask_vertices;
    p->mask_flatten = o.mask_flatten;
    p->laboratory = o.laboratory;
    p->layers = o.layers;
    p->directory = o.directory;
    p->cut = o.cut;
    p->schedule = (fw_schedule_options){
        .wafers = o.wafers, .operators = o.operators, .day = o.day, .planned = o.planning_times};
    p->force = o.force != 0;
    p->path = o.path != 0;
    p->at_equilibrium = o.at && strcmp(o.at, "equilibrium") == 0;
    p->independent = o.independent;
    p->rates = o.rates;
    p->accelerations = o.accelerations;
    if (is_none(o.corners)) p->verdict.corners = FW_CORNERS_NONE;
    if (is_none(o.advice)) p->verdict.with_advice = false;
    p->measurements = is_none(o.measurements)        ? FW_MEASUREMENTS_NONE
                      : auto_or_none(o.measurements) ? FW_MEASUREMENTS_AUTO
                                                     : FW_MEASUREMENTS_ALL;
    m->effects = effects_of(o.effects);
    if (!d->wrong_option) m->effects.hinge = (fw_effects_hinge_model)hinge_model_of(o.hinge_model);
    m->method = o.method;
    m->integrator = o.integrator;
    m->stabilise = o.stabilise;
    m->rtol = o.rtol;
    if (o.accuracy != 0.0) m->accuracy = o.accuracy;
    if (o.samples != 0) m->samples = o.samples;
    d->team.idle = o.jobs > 1 ? o.jobs - 1 : 0;
    if (o.figures) d->wanted |= FW_WANTED_FIGURES;
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
    FW_NEED(fw_diags_reserve(&d->plan->diags));
    const size_t given = cap_of(options), cap = given ? given : FW_ARENA_USUAL;
    const bool whole = cap % ((size_t)1 << 20) == 0;
    FW_NEED(d->over_cap = fw_arena_printf(
                d->plan->arena,
                "out of memory: this design may take %zu %s, and what was asked for takes more; "
                "allow more (memory_cap; --memory of the commands), or ask for less (a lower "
                "accuracy, one flow, fewer samples, fewer steps of a <sweep>)",
                whole ? cap >> 20 : cap, whole ? "MiB" : "bytes"));
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
        fw_arena_stop_with(plan->arena, &design->cancel);
        fw_arena_tell_with(plan->arena, &design->progress);
        fw_arena_help_with(plan->arena, &design->team);
        fw_arena_capped_with(plan->arena, &design->capped);
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

bool fw_plan_design_begin(fw_design *d) {
    if (!d) return false;
    fw_diags_call(&d->plan->diags);
    atomic_store(&d->capped, false);
    return true;
}

/* the status of a call; where there was no memory, with a message that needs none */
static fw_status answer(fw_design *d, fw_status status) {
    fw_diags *diags = &d->plan->diags;
    if (status != FW_NOMEM) return status;
    for (size_t i = diags->before; i < diags->count; i++)
        if (diags->item[i].number == 720 || diags->item[i].number == 721) return status;
    const bool capped = atomic_load(&d->capped);
    fw_diags_put(diags, (fw_diag){.number = capped ? 720 : 721,
                                  .severity = FW_ERROR,
                                  .message = capped ? d->over_cap
                                                    : "out of memory: the machine has no more of "
                                                      "it, whatever the design may take; end "
                                                      "other programs, or ask for less"});
    return status;
}

fw_status fw_plan_design_usage(fw_design *d, const char *what) {
    fw_status status = fw_diag_error(&d->plan->diags, 230, (fw_place){0}, "%s", what);
    return answer(d, status == FW_NOMEM ? FW_NOMEM : FW_USAGE);
}

/* all work runs in the "C" locale of this thread, so that the caller's cannot change a byte */
int fw_plan_design_run(fw_design *d, fw_status (*work)(fw_design *d, void *argument),
                       void *argument) {
    locale_t before = uselocale(d->locale);
    bool whole = !d->plan->diags.failed;
    fw_status status = work(d, argument);
    uselocale(before);
    /* a warning that found no room must not make a result look better than it is, and an error that
       found none is not the description's */
    if (status != FW_CANCELLED && whole && d->plan->diags.failed) status = FW_NOMEM;
    return (int)answer(d, status);
}

void fw_plan_design_forget_documents(fw_design *d) {
    for (int i = 0; i < FW_DESIGN_DOCUMENTS; i++)
        d->document[i] = (fw_text){0};
    for (int i = 0; i < FW_DESIGN_NUMBERS; i++)
        d->numbers[i] = NULL;
}

/* CPU time */
static double seconds_since(clock_t start) {
    return (double)(clock() - start) / CLOCKS_PER_SEC;
}

/* a stage is done once; `work` is not called again after it succeeded */
static int stage(fw_design *d, unsigned before, const char *missing, unsigned self,
                 fw_status (*work)(fw_design *d, void *argument)) {
    if (!fw_plan_design_begin(d)) return FW_STATUS_USAGE;
    if (!(d->done & before)) return (int)fw_plan_design_usage(d, missing);
    if (d->done & self) return FW_STATUS_OK;
    clock_t before_work = clock();
    int status = fw_plan_design_run(d, work, NULL);
    if (status == FW_STATUS_OK) d->done |= self;
    if (self == FW_DONE_JUDGED) d->judge_s = seconds_since(before_work);
    if (self == FW_DONE_SIMULATED) d->simulate_s = seconds_since(before_work);
    fw_plan_design_forget_documents(d);
    return status;
}

int fw_design_set(fw_design *design, const char *path, const char *value) {
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (!path || !value || !path[0])
        return (int)fw_plan_design_usage(design, "set needs a path and a value");
    if (design->tried)
        return (int)fw_plan_design_usage(design, "set values before the description is read");
    fw_plan_options *o = &design->plan->options;
    fw_arena *arena = design->plan->arena;
    if (o->nset == design->set_capacity) {
        int more = design->set_capacity ? 2 * design->set_capacity : 16;
        fw_device_set *grown =
            fw_arena_grow(arena, design->set, (size_t)o->nset, (size_t)more, sizeof *grown);
        if (!grown) return (int)answer(design, FW_NOMEM);
        design->set = grown;
        design->set_capacity = more;
        o->set = grown;
    }
    fw_device_set set = {fw_arena_strdup(arena, path), fw_arena_strdup(arena, value)};
    if (!set.path || !set.value) return (int)answer(design, FW_NOMEM);
    design->set[o->nset++] = set;
    return FW_STATUS_OK;
}

static fw_status read_work(fw_design *d, void *argument) {
    const fw_plan_bytes *in = argument;
    fw_arena *arena = d->plan->arena;
    const char *name = fw_arena_strdup(arena, in->name);
    FW_NEED(name);
    if (!in->data) return fw_plan_load(d->plan, name);
    char *copy = fw_arena_strndup(arena, in->data, in->n);
    FW_NEED(copy);
    return fw_plan_load_memory(d->plan, name, copy, in->n);
}

static int read_from(fw_design *d, fw_plan_bytes in) {
    if (d->tried) return (int)fw_plan_design_usage(d, "one design reads one description");
    if (d->wrong_option) return (int)fw_plan_design_usage(d, d->wrong_option);
    d->tried = true;
    clock_t start = clock();
    int status = fw_plan_design_run(d, read_work, &in);
    d->read_s = seconds_since(start);
    if (status == FW_STATUS_OK) d->done |= FW_DONE_READ;
    return status;
}

int fw_design_read(fw_design *design, const char *path) {
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (!path) return (int)fw_plan_design_usage(design, "read needs the name of a file");
    return read_from(design, (fw_plan_bytes){.name = path});
}

int fw_design_read_memory(fw_design *design, const char *name, const void *xml, size_t n) {
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (!xml)
        return (int)fw_plan_design_usage(design,
                                         "fw_design_read_memory needs the text of a "
                                         "description: the pointer is NULL or the length is 0");
    if (n > SIZE_MAX / 2)
        return (int)fw_plan_design_usage(design, "read_memory: the length is not possible");
    return read_from(design, (fw_plan_bytes){name ? name : "memory", xml, n});
}

const char *fw_design_name(const fw_design *design) {
    return design && design->plan->device ? design->plan->device->name : NULL;
}

static fw_status judge_work(fw_design *d, void *argument) {
    (void)argument;
    return fw_plan_judge(d->plan);
}

int fw_design_judge(fw_design *design) {
    return stage(design, FW_DONE_READ, "read a description before judging it", FW_DONE_JUDGED,
                 judge_work);
}

int fw_design_decision(const fw_design *design) {
    if (!design || !(design->done & FW_DONE_JUDGED)) return -1;
    const fw_plan *plan = design->plan;
    bool open = plan->verdict.decision == FW_INCONCLUSIVE,
         rejected = plan->verdict.decision == FW_REJECT;
    for (const fw_plan_flow *pf = plan->flow; pf < plan->flow + plan->nflow; pf++) {
        open = open || pf->dies;
        rejected = rejected || (pf->dies && pf->dies_decision == FW_REJECT) ||
                   (pf->flow && pf->flow->manufacturable == 0);
    }
    return rejected ? 1 : open ? 4 : 0;
}

static fw_status fabricate_work(fw_design *d, void *argument) {
    (void)argument;
    return fw_plan_fabricate(d->plan);
}

int fw_design_fabricate(fw_design *design) {
    return stage(design, FW_DONE_JUDGED, "judge a design before masks are made", FW_DONE_FABRICATED,
                 fabricate_work);
}

/* kept only of stages that succeeded, so that an earlier one's documents stay whole */
static fw_status subject(fw_design *d, const fw_mechanism *mechanism,
                         const fw_device_scene *scene) {
    d->mechanism = mechanism;
    d->scene = scene;
    return FW_OK;
}

static fw_status modes_work(fw_design *d, void *argument) {
    (void)argument;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    FW_TRY(fw_plan_modes(d->plan, &d->modes, &mechanism, &scene));
    return subject(d, mechanism, scene);
}

int fw_design_modes(fw_design *design) {
    return stage(design, FW_DONE_READ, "read a description before its modes are computed",
                 FW_DONE_MODES, modes_work);
}

static fw_status statics_work(fw_design *d, void *argument) {
    (void)argument;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    FW_TRY(fw_plan_statics(d->plan, &d->statics, &mechanism, &scene));
    return subject(d, mechanism, scene);
}

int fw_design_statics(fw_design *design) {
    return stage(design, FW_DONE_READ, "read a description before its equilibrium is computed",
                 FW_DONE_STATICS, statics_work);
}

static fw_status simulate_work(fw_design *d, void *argument) {
    (void)argument;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    unsigned wanted = d->wanted;
    FW_TRY(fw_plan_simulate(d->plan, &wanted, &d->motion, &mechanism, &scene));
    d->known = wanted;
    return subject(d, mechanism, scene);
}

/* The scene once more: the same motion, to the last bit. What there was to say of it was said, but
   what fails now. */
fw_status fw_plan_design_know(fw_design *d, unsigned wanted) {
    const fw_dynamics_motion *motion;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    if (!(wanted & ~d->known)) return FW_OK;
    wanted |= d->known;
    clock_t start = clock();
    fw_diags said = d->plan->diags;
    d->plan->diags = fw_diags_new(d->plan->arena);
    fw_status status = fw_plan_simulate(d->plan, &wanted, &motion, &mechanism, &scene);
    fw_diags own = d->plan->diags;
    d->plan->diags = said;
    for (size_t i = 0; status != FW_OK && i < own.count; i++)
        if (own.item[i].severity == FW_ERROR)
            fw_diag_error(&d->plan->diags, own.item[i].number, own.item[i].place, "%s",
                          own.item[i].message);
    FW_TRY(status);
    d->known = wanted;
    d->motion = motion;
    d->simulate_s += seconds_since(start);
    return subject(d, mechanism, scene);
}

int fw_design_simulate(fw_design *design) {
    return stage(design, FW_DONE_READ, "read a description before simulating it", FW_DONE_SIMULATED,
                 simulate_work);
}

static fw_status workspace_work(fw_design *d, void *argument) {
    (void)argument;
    return fw_plan_workspace(d->plan, &d->workspace);
}

int fw_design_workspace(fw_design *design) {
    return stage(design, FW_DONE_READ, "read a description before its workspace is computed",
                 FW_DONE_WORKSPACE, workspace_work);
}

/* ---- assemble ---- */

static fw_status assemble_work(fw_design *d, void *argument) {
    (void)argument;
    return fw_plan_assemble(d->plan, &d->assembly);
}

int fw_design_assemble(fw_design *design) {
    int status = stage(design, FW_DONE_READ, "read a description before assembling it",
                       FW_DONE_ASSEMBLED, assemble_work);
    if (design && design->assembly.assembly) design->done |= FW_DONE_ASSEMBLY_TRIED;
    return status;
}

/* ---- cancelling ---- */

void fw_design_cancel(fw_design *design) {
    if (design) fw_cancel_request(&design->cancel, SIGINT);
}

void fw_design_cancel_clear(fw_design *design) {
    if (design) fw_cancel_clear(&design->cancel);
}

int fw_design_progress(fw_design *design, fw_progress_told *told, void *context) {
    if (!design) return FW_STATUS_USAGE;
    design->progress = (fw_progress){told, context, &design->cancel};
    return FW_STATUS_OK;
}

void fw_plan_design_cancel_with(fw_design *design, const fw_cancel *above) {
    design->cancel.above = above;
}

/* ---- one design after the other ---- */

fw_status fw_plan_keep(fw_design *design, fw_plan_kept *kept) {
    *kept = (fw_plan_kept){.design = design};
    if (design->done != FW_DONE_READ) return FW_USAGE;
    return fw_arena_copy_take(design->plan->arena, &kept->copy) ? FW_OK : FW_NOMEM;
}

typedef struct again {
    const char *xml; /* (n) NULL: the description as it was */
    size_t n;
    const fw_device_set *set;
    int nset;
    bool *same;
} again;

static fw_status again_work(fw_design *d, void *argument) {
    const again *a = argument;
    if (a->xml) FW_TRY(fw_plan_replace_source(d->plan, a->xml, a->n, a->same));
    if (a->xml && !*a->same) return FW_OK;
    return fw_plan_load_again(d->plan, a->set, a->nset, a->same);
}

static fw_status begin_again(fw_plan_kept *kept, again *a) {
    *a->same = false;
    fw_plan_free_steps(kept->design->plan); /* they have arenas of their own */
    fw_arena_copy_put_back(kept->design->plan->arena, &kept->copy);
    clock_t start = clock();
    fw_status status = (fw_status)fw_plan_design_run(kept->design, again_work, a);
    kept->design->read_s = seconds_since(start);
    return status;
}

fw_status fw_plan_kept_again(fw_plan_kept *kept, const fw_device_set *set, int nset, bool *same) {
    return begin_again(kept, &(again){.set = set, .nset = nset, .same = same});
}

fw_status fw_plan_kept_with(fw_plan_kept *kept, const char *xml, size_t n, const fw_device_set *set,
                            int nset, bool *same) {
    return begin_again(kept, &(again){xml, n, set, nset, same});
}

void fw_plan_kept_free(fw_plan_kept *kept) {
    fw_arena_copy_free(&kept->copy);
}
