/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a device file says beside its mechanism and scenes. */
#include "device/device_reader.h"
#include <math.h>
#include <string.h>

/* ---- <flexure>: what all kinds have, and which kind it is (flexures.def) ---- */

#define FW_DEVICE_FLEXURE(name, sentence)                                                          \
    extern const fw_device_flexure_row fw_device_flexure_##name;
#include "device/flexures.def"
#undef FW_DEVICE_FLEXURE
#define FW_DEVICE_FLEXURE(name, sentence) &fw_device_flexure_##name,
static const fw_device_flexure_row *const flexure_kinds[] = {
#include "device/flexures.def"
};
#undef FW_DEVICE_FLEXURE
enum { FLEXURE_KINDS = sizeof flexure_kinds / sizeof flexure_kinds[0] };

/* ---- what a kind has no use for ---- */

static void refuse_pieces(fw_device_reader *r, int at, const char *kind) {
    char label[FW_LABEL];
    for (int i = at + 1; i < r->xml.nrecord && r->xml.record[i].parent >= at; i++)
        if (r->xml.record[i].parent == at)
            fw_diag_error(r->diags, 262, r->xml.record[i].element->place,
                          "%s: a %s has no pieces of its own; remove <%s>, or write kind=\"path\"",
                          fw_xml_label(&r->xml.record[at], label), kind,
                          r->xml.record[i].row->name);
}

static bool takes_attribute(const fw_device_flexure_row *kind, const char *name) {
    for (const char *const *own = kind->takes; *own; own++)
        if (strcmp(*own, name) == 0) return true;
    return false;
}

static void refuse_attributes(fw_device_reader *r, const fw_xml_record *record,
                              const fw_device_flexure_row *kind) {
    static const char *const name[] = {"length", "radius", "angle", "width-middle"};
    char label[FW_LABEL];
    for (int i = 0; i < 4; i++) {
        if (!fw_xml_given(record, name[i]) || takes_attribute(kind, name[i])) continue;
        fw_place place = fw_xml_place_of(record, name[i]);
        if (kind->refused.number)
            fw_diag_error(r->diags, kind->refused.number, place, "%s: %s%s%s",
                          fw_xml_label(record, label), kind->refused.before, name[i],
                          kind->refused.after);
        else
            fw_diag_error(r->diags, 58, place, "%s: a %s has no %s; remove it",
                          fw_xml_label(record, label), kind->name, name[i]);
    }
}

/* ---- the whole ---- */

static const fw_device_flexure_row *kind_of(const fw_xml_record *record) {
    const char *name = fw_xml_text_of(record, "kind");
    for (int i = 0; name && i < FLEXURE_KINDS; i++)
        if (strcmp(flexure_kinds[i]->name, name) == 0) return flexure_kinds[i];
    return NULL;
}

static fw_status flexure_of(fw_device_reader *r, int at, fw_device_flexure *f) {
    const fw_xml_record *record = &r->xml.record[at];
    const fw_device_flexure_row *kind = kind_of(record);
    bool length = fw_xml_given(record, "length");
    *f = (fw_device_flexure){.id = fw_xml_text_of(record, "id"),
                             .length_m = fw_xml_number_of(record, "length"),
                             .angle_rad = fw_xml_number_of(record, "angle"),
                             .radius_m = fw_xml_number_of(record, "radius"),
                             .width_m = fw_xml_number_of(record, "width"),
                             .width_middle_m = fw_xml_number_or(record, "width-middle", 0.0),
                             .gap_m = fw_xml_number_or(record, "gap", 0.0),
                             .fillet_m = fw_xml_number_of(record, "fillet"),
                             .fillet_place = fw_xml_place_of(record, "fillet"),
                             .length_given = length,
                             .radius_given = fw_xml_given(record, "radius"),
                             .place = record->element->place,
                             .length_place = fw_xml_place_of(record, length ? "length" : "radius")};
    if (!kind) return FW_OK; /* reported */
    if (!kind->pieces) refuse_pieces(r, at, kind->name);
    refuse_attributes(r, record, kind);
    return kind->build(r, at, f);
}

fw_status fw_device_build_flexures(fw_device_reader *r) {
    fw_device *d = r->device;
    FW_NEED(d->flexure = fw_arena_array(r->arena, fw_device_flexure,
                                        (size_t)fw_xml_count(&r->xml, "flexure")));
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "flexure"))
            FW_TRY(flexure_of(r, i, &d->flexure[d->nflexure++]));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- material, limits, flow, workspace, die ---- */

static fw_status read_override(fw_device_reader *r, const fw_xml_record *record, const char *name,
                               const char *id, fw_quantity_dimension dimension, fw_quantity *q) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    *q = (fw_quantity){.id = id,
                       .unknown = true,
                       .dimension = dimension,
                       .unit = "",
                       .status = FW_STATED,
                       .source = "device file",
                       .place = fw_xml_place_of(record, name)};
    if (!cell->given || !cell->ok) return FW_OK;
    q->unknown = false;
    q->value = cell->number;
    return fw_quantity_expression_unit(r->arena, cell->given->value, strlen(cell->given->value),
                                       dimension, &q->unit);
}

static fw_status build_material(fw_device_reader *r, const fw_xml_record *record) {
    static const fw_quantity_dimension pressure = {-1, 1, -2, 0, 0, 0, 0, 0},
                                       density = {.m = -3, .kg = 1};
    static const fw_xml_element_row no_row = {.name = "material"};
    fw_xml_element nothing = {.name = "material"};
    fw_xml_record absent = {.row = &no_row, .element = &nothing};
    fw_device *d = r->device;
    const fw_xml_record *from = record ? record : &absent;
    bool broken = false;
    FW_TRY(read_override(r, from, "youngs-modulus", "youngs", pressure, &d->material.youngs));
    FW_TRY(read_override(r, from, "poisson", "poisson", (fw_quantity_dimension){0},
                         &d->material.poisson));
    FW_TRY(read_override(r, from, "density", "density", density, &d->material.density));
    FW_TRY(read_override(r, from, "strength", "strength", pressure, &d->material.strength));
    for (int k = 0; k < FW_LIMIT_DATA; k++) {
        const char *id = fw_device_limit_data_id(k);
        fw_quantity *q = fw_device_limit_data_at(&d->material.limit, k);
        FW_TRY(read_override(r, from, id, id, fw_device_limit_data_dimension(k), q));
        if (record && fw_xml_failed(record, id)) broken = true;
    }
    if (!record) return FW_OK;
    if (!broken)
        fw_device_limit_data_complete(&d->material.limit, "<material>", record->element->place,
                                      r->diags);
    d->material_ref = fw_xml_text_of(record, "ref");
    d->material_place = fw_xml_place_of(record, "ref");
    d->thickness_m = fw_xml_number_of(record, "thickness");
    d->orientation_rad = fw_xml_number_of(record, "orientation");
    return FW_OK;
}

static void build_limits(fw_device_reader *r, const fw_xml_record *record) {
    fw_device *d = r->device;
    const char *survival = fw_xml_text_of(record, "survival");
    d->safety_factor = fw_xml_number_or(record, "safety-factor", 1.5);
    d->limits_place = record->element->place;
    d->limits = (fw_device_limits_asked){
        .cycles = fw_xml_number_of(record, "cycles"),
        .failure_probability = fw_xml_number_of(record, "failure-probability"),
        .clearance_m = fw_xml_number_of(record, "clearance"),
        .clearance_place = fw_xml_place_of(record, "clearance"),
        .survival = survival && strcmp(survival, "yes") == 0,
        .cycles_place = fw_xml_place_of(record, "cycles"),
        .probability_place = fw_xml_place_of(record, "failure-probability")};
}

static fw_device_flow_use flow_of(const fw_xml_record *record) {
    const char *carrier = fw_xml_text_of(record, "carrier");
    return (fw_device_flow_use){.ref = fw_xml_text_of(record, "ref"),
                                .insulating_carrier = carrier && strcmp(carrier, "insulating") == 0,
                                .material = fw_xml_text_of(record, "material"),
                                .thickness_m = fw_xml_number_of(record, "thickness"),
                                .orientation_rad = fw_xml_number_of(record, "orientation"),
                                .place = fw_xml_place_of(record, "ref"),
                                .material_place = fw_xml_place_of(record, "material")};
}

static const char *reference_text(fw_device_reader *r, const fw_xml_record *record,
                                  const char *name) {
    return fw_device_reference(r, record, name) >= 0 ? fw_xml_text_of(record, name) : NULL;
}

static void check_order(fw_device_reader *r, const fw_xml_record *record, const char *low,
                        const char *high, const char *unit) {
    double a = fw_xml_number_of(record, low), b = fw_xml_number_of(record, high);
    char left[FW_LABEL], right[FW_LABEL];
    if (a > b)
        fw_diag_error(r->diags, 63, fw_xml_place_of(record, low),
                      "workspace: %s %s is above %s %s; exchange them", low,
                      fw_xml_in_unit(left, a, unit), high, fw_xml_in_unit(right, b, unit));
}

static fw_device_workspace_box workspace_of(fw_device_reader *r, const fw_xml_record *record) {
    check_order(r, record, "x-min", "x-max", "um");
    check_order(r, record, "y-min", "y-max", "um");
    check_order(r, record, "phi-min", "phi-max", "deg");
    return (fw_device_workspace_box){.flow = reference_text(r, record, "flow"),
                                     .x_min_m = fw_xml_number_of(record, "x-min"),
                                     .x_max_m = fw_xml_number_of(record, "x-max"),
                                     .y_min_m = fw_xml_number_of(record, "y-min"),
                                     .y_max_m = fw_xml_number_of(record, "y-max"),
                                     .phi_min_rad = fw_xml_number_of(record, "phi-min"),
                                     .phi_max_rad = fw_xml_number_of(record, "phi-max"),
                                     .place = record->element->place};
}

static void build_die(fw_device *d, const fw_xml_record *record) {
    const char *tethers = fw_xml_text_of(record, "tethers"), *fill = fw_xml_text_of(record, "fill");
    d->die = (fw_device_die){.width_m = fw_xml_number_of(record, "width"),
                             .height_m = fw_xml_number_of(record, "height"),
                             .frame_m = fw_xml_number_of(record, "frame"),
                             .lane_m = fw_xml_number_of(record, "lane"),
                             .clearance_m = fw_xml_number_of(record, "clearance"),
                             .anchor_m = fw_xml_number_of(record, "anchor"),
                             .pad_m = fw_xml_number_of(record, "pad"),
                             .title = fw_xml_text_of(record, "title"),
                             .tethers = !tethers || strcmp(tethers, "no") != 0,
                             .fill = fill && strcmp(fill, "yes") == 0,
                             .width_place = fw_xml_place_of(record, "width"),
                             .height_place = fw_xml_place_of(record, "height"),
                             .frame_place = fw_xml_place_of(record, "frame"),
                             .title_place = fw_xml_place_of(record, "title")};
    d->release_pitch_m = fw_xml_number_of(record, "release-pitch");
    d->release_hole_m = fw_xml_number_of(record, "release-hole");
}

/* flows before the rest, because scenes and workspaces refer to them */
static fw_status build_flows(fw_device_reader *r) {
    fw_device *d = r->device;
    FW_NEED(d->flow = fw_arena_array(r->arena, fw_device_flow_use,
                                     (size_t)fw_xml_count(&r->xml, "flow")));
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "flow")) d->flow[d->nflow++] = flow_of(&r->xml.record[i]);
    return FW_OK;
}

fw_status fw_device_build_parts(fw_device_reader *r) {
    fw_device *d = r->device;
    double nan_ = (double)NAN;
    d->safety_factor = 1.5;
    d->limits =
        (fw_device_limits_asked){.cycles = nan_, .failure_probability = nan_, .clearance_m = nan_};
    d->thickness_m = nan_;
    d->orientation_rad = nan_;
    d->die = (fw_device_die){.width_m = nan_,
                             .height_m = nan_,
                             .frame_m = nan_,
                             .lane_m = nan_,
                             .clearance_m = nan_,
                             .anchor_m = nan_,
                             .pad_m = nan_,
                             .tethers = true};
    FW_TRY(build_material(r, NULL));
    FW_TRY(build_flows(r));
    size_t boxes = (size_t)fw_xml_count(&r->xml, "workspace");
    FW_NEED(d->workspace = fw_arena_array(r->arena, fw_device_workspace_box, boxes));
    for (int i = 0; i < r->xml.nrecord; i++) {
        const fw_xml_record *record = &r->xml.record[i];
        if (fw_xml_is(record, "device"))
            d->name = fw_xml_text_of(record, "name");
        else if (fw_xml_is(record, "material"))
            FW_TRY(build_material(r, record));
        else if (fw_xml_is(record, "limits"))
            build_limits(r, record);
        else if (fw_xml_is(record, "workspace"))
            d->workspace[d->nworkspace++] = workspace_of(r, record);
        else if (fw_xml_is(record, "die"))
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

/* ---- wafer ---- */

enum { MOST_VARIANTS = 64 };

static bool says(const fw_xml_record *record, const char *name, const char *word) {
    const char *text = fw_xml_text_of(record, name);
    return text && strcmp(text, word) == 0;
}

static fw_device_wafer_side side_of(const fw_xml_record *record) {
    if (says(record, "flat-side", "top")) return FW_SIDE_TOP;
    if (says(record, "flat-side", "left")) return FW_SIDE_LEFT;
    return says(record, "flat-side", "right") ? FW_SIDE_RIGHT : FW_SIDE_BOTTOM;
}

/* nothing is said */
static const fw_device_order_asked no_order = {.scale = 1,
                                               .size_m = (double)NAN,
                                               .thickness_m = (double)NAN,
                                               .cd_m = (double)NAN,
                                               .registration_m = (double)NAN,
                                               .defect_m = (double)NAN,
                                               .quantity = 1};

/* what it does not say is that of `other` */
static fw_device_order_asked order_of(const fw_xml_record *record,
                                      const fw_device_order_asked *other) {
    fw_device_order_asked o = *other;
    const struct {
        const char *name;
        double *value;
    } number[] = {{"scale", &o.scale},
                  {"size", &o.size_m},
                  {"thickness", &o.thickness_m},
                  {"cd-tolerance", &o.cd_m},
                  {"registration", &o.registration_m},
                  {"defect", &o.defect_m}};
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++)
        *number[i].value = fw_xml_number_or(record, number[i].name, *number[i].value);
    if (fw_xml_given(record, "material")) o.quartz = says(record, "material", "quartz");
    if (fw_xml_given(record, "tone")) o.inverted = says(record, "tone", "inverted");
    if (fw_xml_given(record, "mirror"))
        o.mirror = says(record, "mirror", "yes")  ? FW_MIRROR_YES
                   : says(record, "mirror", "no") ? FW_MIRROR_NO
                                                  : FW_MIRROR_READ;
    if (fw_xml_given(record, "pellicle")) o.pellicle = says(record, "pellicle", "yes");
    if (fw_xml_given(record, "flat-line")) o.flat_line = says(record, "flat-line", "yes");
    if (fw_xml_given(record, "barcode")) o.barcode = fw_xml_text_of(record, "barcode");
    o.quantity = fw_xml_whole_or(record, "quantity", o.quantity);
    o.plate = fw_xml_text_of(record, "plate");
    o.place = record->element->place;
    return o;
}

static void twice(fw_device_reader *r, fw_place place, const char *plate) {
    fw_diag_error(r->diags, 550, place, "<order>: there is one of %s%s%s already; keep one of them",
                  plate ? "plate \"" : "all plates", plate ? plate : "", plate ? "\"" : "");
}

const fw_device_order_asked *fw_device_order_of(const fw_device_wafer_asked *wafer,
                                                const char *plate) {
    for (int i = 0; i < wafer->nordered; i++)
        if (strcmp(wafer->ordered[i].plate, plate) == 0) return &wafer->ordered[i];
    return &wafer->order;
}

/* the one of all plates first: those of one plate take from it what they do not say */
static fw_status read_orders(fw_device_reader *r) {
    fw_device_wafer_asked *w = &r->device->wafer;
    int n = 0;
    w->order = no_order;
    for (int i = 0; i < r->xml.nrecord; i++) {
        const fw_xml_record *e = &r->xml.record[i];
        if (!fw_xml_is(e, "order")) continue;
        n++;
        if (fw_xml_given(e, "plate")) continue;
        if (w->written) twice(r, e->element->place, NULL);
        w->order = order_of(e, &no_order);
        w->written = true;
    }
    fw_device_order_asked *one = fw_arena_array(r->arena, fw_device_order_asked, (size_t)n);
    FW_NEED(one);
    w->ordered = one;
    w->written = n > 0;
    for (int i = 0; i < r->xml.nrecord; i++) {
        const fw_xml_record *e = &r->xml.record[i];
        if (!fw_xml_is(e, "order") || !fw_xml_given(e, "plate")) continue;
        fw_device_order_asked o = order_of(e, &w->order);
        for (int k = 0; o.plate && k < w->nordered; k++)
            if (strcmp(one[k].plate, o.plate) == 0) twice(r, o.place, o.plate);
        if (fw_xml_given(e, "size"))
            fw_diag_error(r->diags, 550, fw_xml_place_of(e, "size"),
                          "<order>: size is one for all plates; state it in the <order> without "
                          "plate, or as plate of <wafer>");
        if (o.plate) one[w->nordered++] = o;
    }
    return FW_OK;
}

static fw_device_wafer_asked wafer_of(const fw_xml_record *record) {
    double tests = fw_xml_number_or(record, "test-dies", 0);
    return (fw_device_wafer_asked){.asked = true,
                                   .diameter_m = fw_xml_number_or(record, "diameter", 0.1),
                                   .flat_m = fw_xml_number_of(record, "flat"),
                                   .edge_m = fw_xml_number_or(record, "edge-exclusion", 3e-3),
                                   .pitch_x_m = fw_xml_number_of(record, "pitch-x"),
                                   .pitch_y_m = fw_xml_number_of(record, "pitch-y"),
                                   .side = side_of(record),
                                   .centre = says(record, "centre", "die")      ? FW_CENTRE_DIE
                                             : says(record, "centre", "street") ? FW_CENTRE_STREET
                                                                                : FW_CENTRE_AUTO,
                                   .alignment = says(record, "alignment", "2 sites"),
                                   .tests = isfinite(tests) ? (int)tests : 0,
                                   .blocks = says(record, "assign", "blocks"),
                                   .plate_m = fw_xml_number_of(record, "plate"),
                                   .title = fw_xml_text_of(record, "title"),
                                   .place = record->element->place};
}

/* one end of a sweep, in the parameter's own dimension */
static fw_status read_end(fw_device_reader *r, const fw_xml_record *record, const char *name,
                          const fw_device_parameter *p, double *value, bool *ok) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    fw_quantity_dimension found;
    *ok = false;
    if (!cell->given) return FW_OK; /* reported as missing */
    return fw_xml_attribute_evaluate(&r->xml, cell->given, name, &p->dimension, &found, value, ok);
}

static bool fits(const char *unit, fw_quantity_dimension dimension) {
    fw_quantity_unit u = {0};
    static const fw_quantity_dimension pure;
    if (!*unit) return fw_quantity_dimension_equal(dimension, pure);
    return fw_quantity_unit_parse(unit, strlen(unit), &u, NULL, NULL) &&
           fw_quantity_dimension_equal(u.dimension, dimension);
}

/* the unit in which steps are written: of `from`, else of the parameter */
static fw_status unit_of(fw_device_reader *r, const fw_xml_record *record,
                         const fw_device_parameter *p, const char **unit, bool *ok) {
    const char *from = fw_xml_cell_of(record, "from")->given->value;
    FW_TRY(fw_quantity_expression_unit(r->arena, from, strlen(from), p->dimension, unit));
    if (!fits(*unit, p->dimension)) *unit = p->unit ? p->unit : "";
    *ok = fits(*unit, p->dimension);
    if (!*ok)
        fw_diag_error(
            r->diags, 190, fw_xml_place_of(record, "from"),
            "<sweep>: from=\"%s\" has no unit of its own in which the steps of '%s' could "
            "be written; write it with one",
            from, p->name);
    return FW_OK;
}

static fw_status add_sweep(fw_device_reader *r, const fw_xml_record *record) {
    fw_device_wafer_asked *w = &r->device->wafer;
    int k = fw_device_reference(r, record, "parameter");
    double steps = fw_xml_number_of(record, "steps");
    if (k < 0 || k >= r->device->nparameter || !isfinite(steps)) return FW_OK;
    const fw_device_parameter *p = &r->device->parameter[k];
    fw_device_sweep s = {.parameter = k, .steps = (int)steps, .place = record->element->place};
    bool from, to, unit = false;
    FW_TRY(read_end(r, record, "from", p, &s.from, &from));
    FW_TRY(read_end(r, record, "to", p, &s.to, &to));
    if (from) FW_TRY(unit_of(r, record, p, &s.unit, &unit));
    if (!from || !to || !unit) return FW_OK;
    if (w->nsweep == 1 && w->sweep[0].parameter == k) {
        fw_diag_error(r->diags, 190, s.place, "<sweep>: '%s' is swept twice; remove one", p->name);
        return FW_OK;
    }
    if (w->nsweep == 1 && w->sweep[0].steps * s.steps > MOST_VARIANTS) {
        fw_diag_error(r->diags, 190, s.place,
                      "<sweep>: %d times %d steps are %d different devices; at most %d are judged "
                      "and drawn",
                      w->sweep[0].steps, s.steps, w->sweep[0].steps * s.steps, MOST_VARIANTS);
        return FW_OK;
    }
    if (w->nsweep < 2) w->sweep[w->nsweep++] = s;
    return FW_OK;
}

fw_status fw_device_build_wafer(fw_device_reader *r) {
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "wafer")) r->device->wafer = wafer_of(&r->xml.record[i]);
    FW_TRY(read_orders(r));
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "sweep")) FW_TRY(add_sweep(r, &r->xml.record[i]));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
