/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Material, limits, flows, workspaces and the die. */
#include "device/reader.h"
#include <math.h>
#include <string.h>

static fw_status read_override(fw_reader *r, const fw_record *record, const char *name,
                               const char *id, fw_dimension dimension, fw_quantity *q) {
    const fw_cell *cell = fw_cell_of(record, name);
    *q = (fw_quantity){.id = id,
                       .unknown = true,
                       .dimension = dimension,
                       .unit = "",
                       .status = FW_STATED,
                       .source = "device file",
                       .place = fw_place_of(record, name)};
    if (!cell->given || !cell->ok) return FW_OK;
    q->unknown = false;
    q->value = cell->number;
    return fw_expression_unit(r->arena, cell->given->value, strlen(cell->given->value), dimension,
                              &q->unit);
}

static fw_status build_material(fw_reader *r, const fw_record *record) {
    static const fw_dimension pressure = {-1, 1, -2, 0, 0, 0, 0}, density = {.m = -3, .kg = 1};
    static const fw_element_row no_row = {.name = "material"};
    fw_element nothing = {.name = "material"};
    fw_record absent = {.row = &no_row, .element = &nothing};
    fw_device *d = r->device;
    const fw_record *from = record ? record : &absent;
    bool broken = false;
    FW_TRY(read_override(r, from, "youngs-modulus", "youngs", pressure, &d->material.youngs));
    FW_TRY(read_override(r, from, "poisson", "poisson", (fw_dimension){0}, &d->material.poisson));
    FW_TRY(read_override(r, from, "density", "density", density, &d->material.density));
    FW_TRY(read_override(r, from, "strength", "strength", pressure, &d->material.strength));
    for (int k = 0; k < FW_LIMIT_DATA; k++) {
        const char *id = fw_limit_data_id(k);
        fw_quantity *q = fw_limit_data_at(&d->material.limit, k);
        FW_TRY(read_override(r, from, id, id, fw_limit_data_dimension(k), q));
        if (record && fw_failed(record, id)) broken = true;
    }
    if (!record) return FW_OK;
    if (!broken)
        fw_limit_data_complete(&d->material.limit, "<material>", record->element->place, r->diags);
    d->material_ref = fw_text_of(record, "ref");
    d->material_place = fw_place_of(record, "ref");
    d->thickness_m = fw_number_of(record, "thickness");
    d->orientation_rad = fw_number_of(record, "orientation");
    return FW_OK;
}

static void build_limits(fw_reader *r, const fw_record *record) {
    fw_device *d = r->device;
    const char *survival = fw_text_of(record, "survival");
    d->safety_factor = fw_number_or(record, "safety-factor", 1.5);
    d->limits_place = record->element->place;
    d->limits =
        (fw_limits_asked){.cycles = fw_number_of(record, "cycles"),
                          .failure_probability = fw_number_of(record, "failure-probability"),
                          .survival = survival && strcmp(survival, "yes") == 0,
                          .cycles_place = fw_place_of(record, "cycles"),
                          .probability_place = fw_place_of(record, "failure-probability")};
}

static fw_flow_use flow_of(const fw_record *record) {
    const char *carrier = fw_text_of(record, "carrier");
    return (fw_flow_use){.ref = fw_text_of(record, "ref"),
                         .insulating_carrier = carrier && strcmp(carrier, "insulating") == 0,
                         .material = fw_text_of(record, "material"),
                         .thickness_m = fw_number_of(record, "thickness"),
                         .orientation_rad = fw_number_of(record, "orientation"),
                         .place = fw_place_of(record, "ref"),
                         .material_place = fw_place_of(record, "material")};
}

static const char *reference_text(fw_reader *r, const fw_record *record, const char *name) {
    return fw_reference(r, record, name) >= 0 ? fw_text_of(record, name) : NULL;
}

static void check_order(fw_reader *r, const fw_record *record, const char *low, const char *high,
                        const char *unit) {
    double a = fw_number_of(record, low), b = fw_number_of(record, high);
    char left[FW_LABEL], right[FW_LABEL];
    if (a > b)
        fw_diag_error(r->diags, 63, fw_place_of(record, low),
                      "workspace: %s %s is above %s %s; exchange them", low,
                      fw_in_unit(left, a, unit), high, fw_in_unit(right, b, unit));
}

static fw_workspace_box workspace_of(fw_reader *r, const fw_record *record) {
    check_order(r, record, "x-min", "x-max", "um");
    check_order(r, record, "y-min", "y-max", "um");
    check_order(r, record, "phi-min", "phi-max", "deg");
    return (fw_workspace_box){.flow = reference_text(r, record, "flow"),
                              .x_min_m = fw_number_of(record, "x-min"),
                              .x_max_m = fw_number_of(record, "x-max"),
                              .y_min_m = fw_number_of(record, "y-min"),
                              .y_max_m = fw_number_of(record, "y-max"),
                              .phi_min_rad = fw_number_of(record, "phi-min"),
                              .phi_max_rad = fw_number_of(record, "phi-max"),
                              .place = record->element->place};
}

static void build_die(fw_device *d, const fw_record *record) {
    const char *tethers = fw_text_of(record, "tethers"), *fill = fw_text_of(record, "fill");
    d->die = (fw_die){.width_m = fw_number_of(record, "width"),
                      .height_m = fw_number_of(record, "height"),
                      .frame_m = fw_number_of(record, "frame"),
                      .lane_m = fw_number_of(record, "lane"),
                      .clearance_m = fw_number_of(record, "clearance"),
                      .title = fw_text_of(record, "title"),
                      .tethers = !tethers || strcmp(tethers, "no") != 0,
                      .fill = fill && strcmp(fill, "yes") == 0,
                      .width_place = fw_place_of(record, "width"),
                      .height_place = fw_place_of(record, "height"),
                      .title_place = fw_place_of(record, "title")};
    d->release_pitch_m = fw_number_of(record, "release-pitch");
    d->release_hole_m = fw_number_of(record, "release-hole");
}

/* flows before the rest, because scenes and workspaces refer to them */
static fw_status build_flows(fw_reader *r) {
    fw_device *d = r->device;
    FW_NEED(d->flow = fw_arena_array(r->arena, fw_flow_use, (size_t)fw_count(r, "flow")));
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "flow")) d->flow[d->nflow++] = flow_of(&r->record[i]);
    return FW_OK;
}

fw_status fw_build_parts(fw_reader *r) {
    fw_device *d = r->device;
    double nan_ = (double)NAN;
    d->safety_factor = 1.5;
    d->limits = (fw_limits_asked){.cycles = nan_, .failure_probability = nan_};
    d->thickness_m = nan_;
    d->orientation_rad = nan_;
    d->die = (fw_die){.width_m = nan_,
                      .height_m = nan_,
                      .frame_m = nan_,
                      .lane_m = nan_,
                      .clearance_m = nan_,
                      .tethers = true};
    FW_TRY(build_material(r, NULL));
    FW_TRY(build_flows(r));
    size_t boxes = (size_t)fw_count(r, "workspace");
    FW_NEED(d->workspace = fw_arena_array(r->arena, fw_workspace_box, boxes));
    for (int i = 0; i < r->nrecord; i++) {
        const fw_record *record = &r->record[i];
        if (fw_is(record, "device"))
            d->name = fw_text_of(record, "name");
        else if (fw_is(record, "material"))
            FW_TRY(build_material(r, record));
        else if (fw_is(record, "limits"))
            build_limits(r, record);
        else if (fw_is(record, "workspace"))
            d->workspace[d->nworkspace++] = workspace_of(r, record);
        else if (fw_is(record, "die"))
            build_die(d, record);
    }
    const fw_quantity *stated = &d->material.strength;
    if (!stated->unknown && !isnan(d->limits.failure_probability))
        fw_diag_warning(r->diags, 236, d->limits.probability_place,
                        "failure-probability has no meaning for the device's own material, "
                        "because its strength is stated as a plain number (line %d) without a "
                        "statistical distribution; remove one of the two",
                        stated->place.line);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
