/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"
#include "base/output.h"
#include "continuum/continuum.h"
#include "plan/ladder.h"
#include <math.h>

typedef struct writer {
    fw_plan *plan;
    const char *directory;
    double refinement;
    const fw_layout *layout;
    const fw_mechanism *mechanism;
    const char *flow; /* NULL: the device's own material */
    int *files;
} writer;

/* ids are the user's: a file name keeps letters, digits, '-' and '_' of them */
static const char *plain(fw_arena *arena, const char *id) {
    char *name = fw_arena_strdup(arena, id ? id : "unnamed");
    for (char *c = name; c && *c; c++)
        if (!((*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ||
              *c == '-' || *c == '_'))
            *c = '_';
    return name;
}

static fw_status save(const writer *w, const char *kind, const char *id, const char *end,
                      const fw_text *deck) {
    fw_arena *arena = w->plan->arena;
    const char *name = plain(arena, id), *flow = w->flow ? plain(arena, w->flow) : "";
    FW_TRY(fw_text_end(deck));
    FW_NEED(name);
    FW_NEED(flow);
    const char *path = fw_arena_printf(arena, "%s/%s-%s%s%s%s.inp", w->directory, kind, name,
                                       w->flow ? "-" : "", flow, end);
    FW_NEED(path);
    FW_TRY(fw_output_single(arena, path, deck->data, deck->length, &w->plan->diags));
    ++*w->files;
    return FW_OK;
}

static fw_status one_hinge(const writer *w, int h) {
    fw_plan *plan = w->plan;
    const fw_mechanism_hinge *hinge = &w->mechanism->hinge[h];
    const fw_continuum_material material = fw_continuum_material_of(w->mechanism, hinge);
    fw_continuum_options options = {.refinement = w->refinement, .nangle = 4};
    fw_place place = plan->device->flexure[hinge->flexure].place;
    fw_continuum_shape shape;
    if (fw_flexure_input_varies(&hinge->input)) {
        fw_diag_warning(&plan->diags, 213, place,
                        "no deck of %s%s: solids are made of one arc or line of one width",
                        FW_NAMED("hinge", w->mechanism->pin[hinge->pin].id));
        return FW_OK;
    }
    fw_continuum_shape_of(&hinge->input, &shape);
    for (int i = 0; i < options.nangle; i++)
        options.angle_rad[i] = 0.25 * (i + 1) * hinge->closed_form.limit_angle_rad;
    for (int large = 0; large < 2; large++) {
        fw_text deck = fw_text_new(plan->arena);
        options.large = large;
        FW_TRY(fw_continuum_hinge_deck(plan->arena, &shape, &material, &options, place,
                                       &plan->diags, &deck));
        FW_TRY(save(w, "hinge", w->mechanism->pin[hinge->pin].id, large ? "-large" : "", &deck));
    }
    return FW_OK;
}

/* what cannot be written is a warning and no failure: the hinges are there */
static fw_status whole_mechanism(const writer *w, const fw_device_scene *scene) {
    fw_plan *plan = w->plan;
    fw_diags own = fw_diags_new(plan->arena);
    fw_continuum_solid_device device;
    fw_text deck = fw_text_new(plan->arena);
    fw_status status =
        fw_continuum_solid_device_of(plan->arena, w->mechanism, scene, &own, &device);
    if (status == FW_OK)
        status = fw_continuum_solid_deck(plan->arena, &device,
                                         &(fw_continuum_solid_options){.refinement = w->refinement},
                                         &own, &deck);
    if (status == FW_GEOMETRY && own.count > 0) {
        fw_diag_warning(&plan->diags, 213, own.item[0].place, "%s%s: %s",
                        FW_NAMED("scene", scene->name), own.item[0].message);
        return FW_OK;
    }
    FW_TRY(status);
    return save(w, "mechanism", scene->name, "", &deck);
}

fw_status fw_cli_decks(fw_plan *plan, const char *directory, double refinement, int *files) {
    const fw_device *device = plan->device;
    writer w = {.plan = plan, .directory = directory, .refinement = refinement, .files = files};
    bool made;
    *files = 0;
    FW_TRY(fw_plan_hinges_layout(plan, &w.layout));
    FW_TRY(fw_output_directory(plan->arena, directory, &made));
    for (int i = 0; i < plan->nflow; i++) {
        const fw_mechanism_variant *variant = &plan->flow[i].variant;
        w.flow = variant->flow;
        FW_TRY(fw_plan_hinges_mechanism(plan, w.layout, variant, &w.mechanism));
        for (int h = 0; h < w.mechanism->nhinge; h++)
            FW_TRY(one_hinge(&w, h));
        bool whole = !w.layout || w.layout->nfault == 0 || !fw_device_needs_shapes(device);
        for (int s = 0; whole && s < device->nscene; s++) /* masses that nothing states are not */
            if (fw_device_in_flow(device->scene[s].flow, variant->flow))
                FW_TRY(whole_mechanism(&w, &w.mechanism->device->scene[s]));
    }
    return FW_OK;
}
