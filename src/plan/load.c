/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A description and the packs that it refers to, read: laboratory packs once, applied to every flow. */
#include "base/constants.h"
#include "base/output.h"
#include "base/text.h"
#include "mask/mask_parts.h"
#include "plan/stages.h"
#include "process/calibrate.h"
#include <math.h>
#include <string.h>

/* ---- what was probably meant by a name that is not there ---- */

static fw_status words_of(fw_plan *plan, const char *wrong, const char *const *name, size_t n,
                          const char **words) {
    const char *near = fw_did_you_mean(wrong, name, n);
    FW_NEED(*words = near ? fw_arena_printf(plan->arena, " (did you mean '%s'?)", near) : "");
    return FW_OK;
}

/* " (did you mean 'X'?)" of the device's flows; "": nothing is near */
static fw_status flow_meant(fw_plan *plan, const char *wrong, const char **words) {
    const fw_device *d = plan->device;
    const char **name = fw_arena_array(plan->arena, const char *, (size_t)d->nflow);
    size_t n = 0;
    FW_NEED(name);
    for (int i = 0; i < d->nflow; i++)
        if (d->flow[i].ref) name[n++] = d->flow[i].ref;
    return words_of(plan, wrong, name, n, words);
}

/* the same of all process packs, else which there are */
static fw_status pack_meant(fw_plan *plan, const char *wrong, const char **words) {
    const char *const *all;
    size_t n, flows = 0;
    FW_TRY(fw_data_names(plan->arena, plan->options.data_directory, "processes", &all, &n));
    const char **name = fw_arena_array(plan->arena, const char *, n);
    FW_NEED(name);
    fw_text list = fw_text_new(plan->arena);
    for (size_t i = 0; i < n; i++) {
        if (strcmp(all[i], "base") == 0) continue; /* what all flows share */
        fw_text_printf(&list, "%s%s", flows ? ", " : "", all[i]);
        name[flows++] = all[i];
    }
    FW_TRY(words_of(plan, wrong, name, flows, words));
    if (**words || flows == 0) return fw_text_end(&list);
    FW_TRY(fw_text_end(&list));
    FW_NEED(*words = fw_arena_printf(plan->arena, " (there are %s)", list.data));
    return FW_OK;
}

/* ---- files and laboratory packs ---- */

enum {
    MOST_BYTES = FW_PLAN_FILE_MOST,
    MOST_PACK_BYTES = 1024 * 1024,
    MOST_PACKS = 8,
    MOST_DRAWINGS = 32
};

struct fw_plan_drawing {
    const char *name, *data;
    size_t n;
};
typedef struct fw_plan_drawing fw_plan_drawing_file;

struct fw_plan_lab {
    const char *file, *xml;
    size_t n;
    bool used;
};
typedef struct fw_plan_lab fw_plan_lab_pack;

/* an input file, for the manifest */
static fw_status remember_input(fw_plan *plan, const char *name, const char *data, size_t n) {
    if (plan->ninput == (int)(sizeof plan->input / sizeof plan->input[0])) return FW_OK;
    char hash[65];
    fw_sha256(data, n, hash);
    fw_plan_input_file *input = &plan->input[plan->ninput];
    *input = (fw_plan_input_file){name, fw_arena_strdup(plan->arena, hash), n};
    FW_NEED(input->sha256);
    plan->ninput++;
    return FW_OK;
}

/* a drawing that the description names, from beside the device file; what it says of itself is
   checked before (device/build_shapes.c). Read once, remembered for the manifest. */
static fw_status read_drawing(void *of, const char *name, fw_place asked, const char **data,
                              size_t *n) {
    fw_plan *plan = of;
    for (int i = 0; i < plan->ndrawing; i++)
        if (strcmp(plan->drawing[i].name, name) == 0) {
            *data = plan->drawing[i].data;
            *n = plan->drawing[i].n;
            return FW_OK;
        }
    if (!plan->drawing)
        FW_NEED(plan->drawing = fw_arena_array(plan->arena, fw_plan_drawing_file, MOST_DRAWINGS));
    if (plan->ndrawing == MOST_DRAWINGS)
        return fw_diag_error(&plan->diags, 319, asked,
                             "a device names more than %d drawings; draw several layers in one",
                             (int)MOST_DRAWINGS);
    fw_plan_drawing_file *drawing = &plan->drawing[plan->ndrawing];
    const char *path = fw_arena_printf(plan->arena, "%s/%s", plan->directory, name);
    char *bytes;
    FW_NEED(path);
    FW_NEED(drawing->name = fw_arena_strdup(plan->arena, name));
    fw_diags why = fw_diags_new(plan->arena); /* it names the machine's path */
    fw_status status = fw_input_read(plan->arena, path, MOST_BYTES, &why, &bytes, &drawing->n);
    if (status != FW_OK && status != FW_NOMEM)
        return fw_diag_error(&plan->diags, 310, asked,
                             "the drawing %s beside the device file %s; correct the name, or put "
                             "it there",
                             name, why.count > 0 ? why.item[0].message : "cannot be read");
    FW_TRY(status);
    *data = drawing->data = bytes;
    *n = drawing->n;
    plan->ndrawing++;
    return remember_input(plan, drawing->name, bytes, drawing->n);
}

static fw_device_files files_of(fw_plan *plan) {
    return (fw_device_files){read_drawing, plan};
}

/* what fw_device_read_with takes: NULL where no drawings are opened */
static const fw_device_files *files_or_none(const fw_plan *plan, const fw_device_files *files) {
    return plan->directory ? files : NULL;
}

/* what the layers draw that its cells go to, in the flows that are planned */
static fw_status settle_cells(const fw_plan *plan, fw_arena *arena, const fw_device *device,
                              fw_diags *diags) {
    fw_mask_table **table;
    int n = 0;
    if (device->ncell + device->wafer.ncell == 0 || plan->nflow == 0) return FW_OK;
    FW_NEED(table = fw_arena_array(arena, fw_mask_table *, (size_t)plan->nflow));
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].table) table[n++] = plan->flow[i].table;
    return fw_mask_cells_settle(plan->arena, device, table, n, diags);
}

fw_status fw_plan_device_again(fw_plan *plan, fw_arena *arena, const fw_device_set *set, int nset,
                               fw_diags *diags, const fw_device **device) {
    fw_device_files files = files_of(plan);
    FW_TRY(fw_device_read_with(arena, plan->source_file, plan->source, plan->source_length, set,
                               nset, files_or_none(plan, &files), diags, device));
    return settle_cells(plan, arena, *device, diags);
}

/* NULL: there are too many, and that is said */
static fw_plan_lab_pack *next_pack(fw_plan *plan) {
    if (plan->nlab < MOST_PACKS) return &plan->lab[plan->nlab];
    fw_diag_error(&plan->diags, 211, (fw_place){0}, "more than %d laboratory packs", MOST_PACKS);
    return NULL;
}

static fw_status add_pack(fw_plan *plan, fw_plan_lab_pack *pack) {
    const char *slash = strrchr(pack->file, '/');
    plan->nlab++;
    return remember_input(plan, slash ? slash + 1 : pack->file, pack->xml, pack->n);
}

static bool has_packs(const fw_plan *plan) {
    return plan->options.laboratory || plan->options.nlab_text > 0;
}

static fw_status read_packs(fw_plan *plan) {
    const char *at = plan->options.laboratory ? plan->options.laboratory : "";
    fw_plan_lab_pack *pack;
    FW_NEED(plan->lab = fw_arena_array(plan->arena, fw_plan_lab_pack, MOST_PACKS));
    while (*at) {
        size_t n = strcspn(at, ",");
        char *xml;
        if (!(pack = next_pack(plan))) return FW_INPUT;
        FW_NEED(pack->file = fw_arena_strndup(plan->arena, at, n));
        FW_TRY(
            fw_input_read(plan->arena, pack->file, MOST_PACK_BYTES, &plan->diags, &xml, &pack->n));
        pack->xml = xml;
        FW_TRY(add_pack(plan, pack));
        at += n + (at[n] == ',');
    }
    for (int i = 0; i < plan->options.nlab_text; i++) {
        const fw_plan_lab_text *text = &plan->options.lab_text[i];
        if (!(pack = next_pack(plan))) return FW_INPUT;
        *pack = (fw_plan_lab_pack){.file = text->name, .xml = text->text, .n = text->n};
        FW_TRY(add_pack(plan, pack));
    }
    return FW_OK;
}

/* other ways of doing steps of this flow that the laboratory packs choose */
static fw_status choices_of_packs(fw_plan *plan, const char *flow, fw_process_choice **choice,
                                  int *n) {
    if (!has_packs(plan)) return FW_OK;
    if (!plan->lab) FW_TRY(read_packs(plan));
    for (int i = 0; i < plan->nlab; i++) {
        fw_plan_lab_pack *pack = &plan->lab[i];
        int before = *n;
        FW_TRY(
            fw_process_lab_choices(plan->arena, pack->file, pack->xml, pack->n, flow, choice, n));
        pack->used = pack->used || *n > before;
    }
    return FW_OK;
}

/* the laboratory packs of the options, into one flow */
static fw_status apply_packs(fw_plan *plan, fw_process_flow *flow) {
    if (!has_packs(plan)) return FW_OK;
    if (!plan->lab) FW_TRY(read_packs(plan));
    for (int i = 0; i < plan->nlab; i++) {
        fw_plan_lab_pack *pack = &plan->lab[i];
        int before = flow->noverride + flow->ntool_time;
        FW_TRY(
            fw_process_lab_apply(plan->arena, pack->file, pack->xml, pack->n, flow, &plan->diags));
        pack->used = pack->used || flow->noverride + flow->ntool_time > before;
    }
    FW_TRY(fw_process_lab_ask(plan->arena, flow, &plan->diags));
    FW_TRY(fw_process_lab_ask_bias(plan->arena, flow, &plan->diags));
    return fw_schedule_tool_words(flow, &plan->diags);
}

/* after all flows were read: warns of packs that no flow of the device took */
static fw_status warn_of_unused_packs(fw_plan *plan) {
    for (int i = 0; i < plan->nlab; i++) {
        const fw_plan_lab_pack *pack = &plan->lab[i];
        const char *flow, *words;
        fw_place at;
        if (pack->used) continue;
        FW_TRY(fw_process_lab_flow(plan->arena, pack->file, pack->xml, pack->n, &flow, &at));
        FW_TRY(flow_meant(plan, flow, &words));
        fw_diag_warning(&plan->diags, 211, at,
                        "this laboratory pack has no effect: it is for the flow '%s', of which "
                        "nothing that it replaces is planned here%s",
                        flow, words);
    }
    return plan->diags.failed ? FW_NOMEM : FW_OK;
}

/* ---- the laboratory's layer numbers ---- */

static fw_status read_layers(fw_plan *plan) {
    char *text;
    size_t n;
    const char *file = plan->options.layers;
    FW_TRY(fw_input_read(plan->arena, file, MOST_PACK_BYTES, &plan->diags, &text, &n));
    const char *slash = strrchr(file, '/');
    FW_TRY(remember_input(plan, slash ? slash + 1 : file, text, n));
    FW_NEED(plan->layers = fw_arena_one(plan->arena, fw_mask_layer_map));
    return fw_mask_layer_map_read(plan->arena, file, text, n, &plan->diags, plan->layers);
}

/* lines that no flow of the device has a layer for */
static fw_status check_layers(fw_plan *plan) {
    if (!plan->layers) return FW_OK;
    const fw_mask_table **table =
        fw_arena_array(plan->arena, const fw_mask_table *, (size_t)plan->nflow);
    FW_NEED(table);
    int n = 0;
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].table) table[n++] = plan->flow[i].table;
    return fw_mask_layer_map_finish(plan->arena, plan->layers, table, n, &plan->diags);
}

/* ---- the description and its flows ---- */

/* a file below the data directory; its name in messages and the manifest is the relative one */
static fw_status read_data(fw_plan *plan, const char *name, fw_place asked, char **data,
                           size_t *n) {
    const char *path;
    FW_TRY(fw_data_path(plan->arena, plan->options.data_directory, name, &path));
    if (!path) {
        fw_diag_error(&plan->diags, 224, asked,
                      "data file %s was not found: set FLEXWRIGHT_DATA to the directory that holds "
                      "processes/ and masks/, or correct the name",
                      name);
        return FW_INPUT;
    }
    FW_TRY(fw_input_read(plan->arena, path, MOST_BYTES, &plan->diags, data, n));
    return remember_input(plan, name, *data, *n);
}

static const char *material_names(fw_plan *plan, const char *wrong) {
    fw_text names = fw_text_new(plan->arena);
    const char **all = fw_arena_array(plan->arena, const char *, (size_t)plan->materials.count);
    for (int i = 0; all && i < plan->materials.count; i++)
        all[i] = plan->materials.item[i].id;
    const char *near =
        wrong && all ? fw_did_you_mean(wrong, all, (size_t)plan->materials.count) : NULL;
    if (near) fw_text_printf(&names, "did you mean '%s'? ", near);
    fw_text_add(&names, "choose one of");
    for (int i = 0; i < plan->materials.count; i++)
        if (!plan->materials.item[i].youngs.unknown)
            fw_text_printf(&names, " %s", plan->materials.item[i].id);
    return names.failed ? "" : names.data;
}

fw_status fw_plan_need_material(fw_plan *plan) {
    if (plan->device->material_ref) return FW_OK;
    return fw_diag_error(&plan->diags, 225, (fw_place){plan->device->file, 1, 1},
                         "no <material>: add <material ref=\"...\"/>; %s",
                         material_names(plan, NULL));
}

/* the description's own material, as the flow has it: what explicit masses and stiffnesses refer to */
static fw_status own_material(fw_plan *plan, const fw_plan_flow *pf, fw_device_material *material) {
    const fw_device *d = plan->device;
    FW_TRY(fw_plan_need_material(plan));
    *material = fw_device_material_with(fw_plan_material(plan, pf, d->material_ref), &d->material);
    return FW_OK;
}

/* thickness of the variant: of the <flow>, else of the device, else of the pack */
static double thickness_of(const fw_device *d, const fw_device_flow_use *use,
                           const fw_process_flow *flow) {
    if (use && !isnan(use->thickness_m)) return use->thickness_m;
    if (!isnan(d->thickness_m)) return d->thickness_m;
    if (flow && flow->thickness && !flow->thickness->unknown) return flow->thickness->value;
    return (double)NAN;
}

/* of a wafer as it is usually cut: the flat, along <110>, parallel to x */
static double orientation_of(const fw_device *d, const fw_device_flow_use *use) {
    if (use && !isnan(use->orientation_rad)) return use->orientation_rad;
    return isnan(d->orientation_rad) ? 0.25 * FW_PI : d->orientation_rad;
}

static fw_status make_variant(fw_plan *plan, fw_plan_flow *pf) {
    const fw_device *d = plan->device;
    const fw_device_flow_use *use = pf->use;
    fw_mechanism_variant *v = &pf->variant;
    fw_device_material own;
    FW_TRY(own_material(plan, pf, &own));
    fw_place place = use ? use->place : d->material_place;
    *v = (fw_mechanism_variant){.flow = use ? use->ref : NULL,
                                .material = own,
                                .substrate_expansion = {.unknown = true},
                                .thickness_m = thickness_of(d, use, pf->flow),
                                .orientation_rad = orientation_of(d, use)};
    if (use && use->material && !fw_text_same(use->material, d->material_ref))
        v->material = *fw_plan_material(plan, pf, use->material);
    FW_TRY(fw_plan_find_ground(plan, pf, v));
    FW_TRY(fw_plan_find_below(plan, pf, &v->below));
    FW_TRY(fw_plan_find_drying(plan, pf, &v->drying));
    if (isnan(v->thickness_m))
        return fw_diag_error(&plan->diags, 226, place,
                             "the thickness of the device layer is not known: give thickness on "
                             "<material> or <flow>");
    fw_plan_check_thickness(plan, pf);
    const fw_device_material *m = &v->material;
    if (m->youngs.unknown || m->density.unknown || m->strength.unknown || m->poisson.unknown)
        return fw_diag_error(
            &plan->diags, 225, place,
            "material '%s' has no modulus, Poisson number, density or strength: it "
            "cannot be the device layer; %s",
            m->id, material_names(plan, NULL));
    fw_plan_look_at_material(plan, pf, m);
    if (pf->flow && pf->flow->material && !fw_text_same(pf->flow->material, m->id))
        fw_diag_warning(&plan->diags, 227, place,
                        "flow '%s' makes devices of %s, but %s is asked for: give "
                        "material=\"%s\" on <flow>",
                        use->ref, pf->flow->material, m->id, pf->flow->material);
    double own_thickness = isnan(d->thickness_m) ? v->thickness_m : d->thickness_m;
    double stiff = m->youngs.value * v->thickness_m / (own.youngs.value * own_thickness);
    double mass = m->density.value * v->thickness_m / (own.density.value * own_thickness);
    v->explicit_stiffness_scale = stiff;
    v->explicit_mass_scale = mass;
    v->explicit_damping_scale = sqrt(stiff * mass);
    return FW_OK;
}

/* a mechanism that states all its masses and has no flexure moves without a material; a verdict
   asks for one (fw_plan_need_material) */
static fw_mechanism_variant mechanism_alone(void) {
    const fw_quantity unknown = {.unknown = true};
    const fw_device_material none = {.id = "none",
                                     .name = "no material",
                                     .youngs = unknown,
                                     .poisson = unknown,
                                     .density = unknown,
                                     .strength = unknown,
                                     .criterion = "",
                                     .loss = unknown,
                                     .expansion = unknown,
                                     .expansion_slope = unknown,
                                     .expansion_curvature = unknown,
                                     .modulus_change = unknown,
                                     .c11 = unknown,
                                     .c12 = unknown,
                                     .c44 = unknown};
    return (fw_mechanism_variant){.material = none,
                                  .substrate_expansion = unknown,
                                  .thickness_m = 1, /* nothing is made of it */
                                  .explicit_mass_scale = 1,
                                  .explicit_stiffness_scale = 1,
                                  .explicit_damping_scale = 1};
}

/* as the laboratory packs of the options have it */
static fw_status read_flow(fw_plan *plan, const fw_plan_flow *pf, fw_process_flow **flow) {
    fw_process_choice *choice = NULL;
    int n = 0;
    FW_TRY(choices_of_packs(plan, pf->use->ref, &choice, &n));
    FW_TRY(fw_process_flow_read_chosen(plan->arena, plan->base_file, plan->base_xml,
                                       plan->base_length, pf->file, pf->xml, pf->xml_length, choice,
                                       n, plan->device->die.tethers ? NULL : "tethers",
                                       &plan->diags, flow));
    return apply_packs(plan, *flow);
}

/* one without is not read a second time for them */
static bool has_materials(const char *xml, size_t n) {
    static const char own[] = "<material", with_prefix[] = ":material";
    return memmem(xml, n, own, sizeof own - 1) ||
           memmem(xml, n, with_prefix, sizeof with_prefix - 1);
}

static fw_status load_flow(fw_plan *plan, fw_plan_flow *pf) {
    const char *name = fw_arena_printf(plan->arena, "processes/%s.xml", pf->use->ref);
    FW_NEED(name);
    char *xml;
    size_t n;
    FW_TRY(read_data(plan, name, pf->use->place, &xml, &n));
    pf->flow_sha256 = plan->input[plan->ninput - 1].sha256;
    pf->file = name, pf->xml = xml, pf->xml_length = n;
    FW_TRY(read_flow(plan, pf, &pf->flow));
    if (has_materials(xml, n))
        FW_TRY(fw_device_materials_of_flow(plan->arena, name, xml, n, &plan->materials,
                                           &plan->diags, &pf->materials));
    name = fw_arena_printf(plan->arena, "masks/%s.xml", pf->use->ref);
    FW_NEED(name);
    FW_TRY(read_data(plan, name, pf->use->place, &xml, &n));
    fw_mask_table *table = fw_arena_one(plan->arena, fw_mask_table);
    FW_NEED(table);
    FW_TRY(fw_mask_table_read(plan->arena, name, xml, n, &plan->diags, table));
    pf->table = table;
    if (plan->options.layers && !plan->layers) FW_TRY(read_layers(plan));
    if (plan->layers)
        FW_TRY(fw_mask_layer_map_apply(plan->arena, plan->layers, table, &plan->diags));
    size_t errors = plan->diags.errors;
    fw_plan_check_table(&plan->diags, pf->flow, table);
    return plan->diags.errors > errors ? FW_INPUT : FW_OK;
}

fw_status fw_plan_flow_again(const fw_plan *plan, const fw_plan_flow *pf, fw_process_flow **flow) {
    fw_plan other = *plan;
    other.diags = fw_diags_new(plan->arena); /* what there is to say of it has been said */
    return read_flow(&other, pf, flow);
}

static const char *flow_names(fw_plan *plan) {
    fw_text names = fw_text_new(plan->arena);
    fw_text_add(&names, "it has");
    for (int i = 0; i < plan->device->nflow; i++)
        fw_text_printf(&names, "%s %s", i ? "," : "", plan->device->flow[i].ref);
    if (plan->device->nflow == 0)
        fw_text_add(&names, " none; leave the option out, or add a <flow>");
    return names.failed ? "it has others" : names.data;
}

/* what is asked for is not among those of the device, which may have none at all */
static fw_status no_such_flow(fw_plan *plan) {
    const char *meant = "";
    if (plan->device->nflow > 0) FW_TRY(flow_meant(plan, plan->options.flow, &meant));
    return fw_diag_error(&plan->diags, 228, (fw_place){.file = plan->device->file},
                         "the device has no flow '%s': %s%s", plan->options.flow, flow_names(plan),
                         meant);
}

static fw_status load_flows(fw_plan *plan) {
    const fw_device *d = plan->device;
    int most = d->nflow > 0 ? d->nflow : 1;
    FW_NEED(plan->flow = fw_arena_array(plan->arena, fw_plan_flow, (size_t)most));
    if (d->nflow == 0 && plan->options.flow) return no_such_flow(plan);
    if (d->nflow == 0 && !d->material_ref) {
        plan->nflow = 1;
        plan->flow[0].variant = mechanism_alone();
        return FW_OK;
    }
    if (d->nflow == 0) {
        plan->nflow = 1;
        return make_variant(plan, &plan->flow[0]);
    }
    for (int i = 0; i < d->nflow; i++) {
        if (plan->options.flow && !fw_text_same(plan->options.flow, d->flow[i].ref)) continue;
        fw_plan_flow *pf = &plan->flow[plan->nflow++];
        pf->use = &d->flow[i];
        FW_TRY(load_flow(plan, pf));
        FW_TRY(make_variant(plan, pf));
    }
    return plan->nflow > 0 ? FW_OK : no_such_flow(plan);
}

fw_status fw_plan_fabricated_of(fw_arena *arena, const fw_plan_flow *pf,
                                fw_verdict_variant_verdict *v) {
    v->variant = &pf->variant;
    if (!pf->flow) return FW_OK;
    return fw_process_flow_fabricated(arena, pf->flow, NULL, &pf->variant, &v->input, &v->ninput);
}

fw_status fw_plan_take_device(fw_plan *plan, const fw_device *device) {
    const fw_device *before = plan->device;
    plan->device = device;
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (pf->use) pf->use = &device->flow[pf->use - before->flow];
        FW_TRY(make_variant(plan, pf));
    }
    return FW_OK;
}

fw_status fw_plan_load(fw_plan *plan, const char *path) {
    char *xml;
    size_t n;
    FW_TRY(fw_input_read(plan->arena, path, MOST_BYTES, &plan->diags, &xml, &n));
    if (strcmp(path, "-") == 0) return fw_plan_load_memory(plan, "standard input", xml, n);
    const char *slash = strrchr(path, '/');
    size_t up_to = !slash ? 0 : slash == path ? 1 : (size_t)(slash - path);
    FW_NEED(plan->directory = slash ? fw_arena_strndup(plan->arena, path, up_to) : ".");
    return fw_plan_load_memory(plan, path, xml, n);
}

/* what the device names in the data directory, all of it, also when the device has other
   mistakes */
static fw_status check_references(fw_plan *plan, const fw_device *d) {
    fw_status status = FW_OK;
    if (d->material_ref && !fw_device_material_find(&plan->materials, d->material_ref))
        status =
            fw_diag_error(&plan->diags, 225, d->material_place, "material '%s' is not in %s: %s",
                          d->material_ref, plan->base_file, material_names(plan, d->material_ref));
    for (int i = 0; i < d->nflow; i++) {
        const fw_device_flow_use *use = &d->flow[i];
        const char *name =
            use->ref ? fw_arena_printf(plan->arena, "processes/%s.xml", use->ref) : "";
        FW_NEED(name);
        const char *path = name;
        if (*name) FW_TRY(fw_data_path(plan->arena, plan->options.data_directory, name, &path));
        if (!path) {
            const char *meant;
            FW_TRY(pack_meant(plan, use->ref, &meant));
            status = fw_diag_error(&plan->diags, 224, use->place,
                                   "there is no process pack %s%s; correct the name, or set "
                                   "FLEXWRIGHT_DATA to the directory that holds it",
                                   name, meant);
        }
        if (use->material && !fw_device_material_find(&plan->materials, use->material))
            status = fw_diag_error(&plan->diags, 225, use->material_place,
                                   "material '%s' is not in %s: %s", use->material, plan->base_file,
                                   material_names(plan, use->material));
    }
    return status;
}

fw_status fw_plan_load_memory(fw_plan *plan, const char *file, const char *xml, size_t n) {
    if (n > MOST_BYTES)
        return fw_diag_error(&plan->diags, 221, (fw_place){.file = file},
                             "is larger than %d bytes, the most that is read from one file",
                             MOST_BYTES);
    if (!plan->directory) plan->directory = plan->options.directory;
    plan->source_file = file;
    plan->source = xml;
    plan->source_length = n;
    const char *base = strrchr(file, '/');
    FW_TRY(remember_input(plan, base ? base + 1 : file, xml, n));
    const fw_device *device = NULL;
    fw_status read = fw_plan_device_again(plan, plan->arena, plan->options.set, plan->options.nset,
                                          &plan->diags, &device);
    if (read != FW_OK && (read != FW_INPUT || !device)) return read;
    char *base_xml;
    plan->base_file = "processes/base.xml";
    FW_TRY(
        read_data(plan, plan->base_file, (fw_place){.file = file}, &base_xml, &plan->base_length));
    plan->base_xml = base_xml;
    FW_TRY(fw_device_materials_read(plan->arena, plan->base_file, base_xml, plan->base_length,
                                    &plan->diags, &plan->materials));
    fw_status references = check_references(plan, device);
    if (read != FW_OK) return read; /* a device with mistakes is for nobody else */
    FW_TRY(references);
    plan->device = device;
    FW_TRY(load_flows(plan));
    FW_TRY(check_layers(plan));
    FW_TRY(settle_cells(plan, plan->arena, device, &plan->diags));
    return warn_of_unused_packs(plan);
}
