/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What advice may change, as settings of the description, and how its numbers are typed. */
#include "device/edit.h"
#include "effects/effects.h"
#include "verdict/advice.h"
#include <math.h>
#include <string.h>

/* ---- a number, as somebody would type it ---- */

static const double least_step = 1e-4; /* of the range: nobody asks for a finer digit */
static const double factor_without_bounds = 4.0;
/* of the value, where its end is 0: a load that is taken away altogether is no advice, and a scene
   in which nothing moves is the slowest of all to judge */
static const double nearest_to_0 = 0.01;

/* The unit that the file writes an attribute or parameter in; "": none. The file is opened once. */
static fw_status written_unit(fw_verdict_trial *trial, const char *path,
                              fw_quantity_dimension dimension, const char **text,
                              fw_quantity_unit *unit) {
    if (!trial->written)
        FW_TRY(fw_device_written_open(trial->arena, trial->device, &trial->written));
    FW_TRY(fw_device_written_unit(trial->arena, trial->written, path, dimension, text));
    if (!fw_quantity_unit_parse(*text, strlen(*text), unit, NULL, NULL)) *text = "";
    return FW_OK;
}

const char *fw_verdict_value_text(fw_arena *arena, const fw_verdict_value *value, double x,
                                  int digits) {
    char number[40];
    fw_number_text(number, sizeof number, x, digits);
    return fw_arena_printf(arena, "%s%s%s", number, value->unit_text[0] ? " " : "",
                           value->unit_text);
}

double fw_verdict_value_step(const fw_verdict_value *value, double x) {
    double step = pow(10, floor(log10(x) + 1e-9));
    return fmax(step, value->digit);
}

double fw_verdict_value_rounded(double x, double step) {
    return step >= 1 ? nearbyint(x / step) * step : nearbyint(x / step) / nearbyint(1 / step);
}

/* is it a count? One that is written as a whole number, and cannot be read between two of them */
static fw_status is_count(fw_verdict_trial *trial, const fw_verdict_value *h, bool *count) {
    *count = false;
    if (h->unit_text[0] || h->now != nearbyint(h->now)) return FW_OK;
    double between = h->now + (h->now + 0.5 <= h->high ? 0.5 : -0.5);
    if (between < h->low) return FW_OK;
    const char *value = fw_verdict_value_text(trial->arena, h, between, 12);
    FW_NEED(value);
    fw_arena *scratch = fw_arena_part(trial->arena, 0);
    FW_NEED(scratch);
    const fw_verdict_restated *r = &trial->options->restated;
    const fw_device *device = NULL;
    fw_verdict_variant_verdict *variant =
        fw_arena_array(scratch, fw_verdict_variant_verdict, (size_t)trial->verdict->nvariant);
    const fw_device_set set = {h->path, value};
    fw_status status = variant ? r->with(r->context, scratch, &set, 1, &device, variant) : FW_NOMEM;
    fw_arena_free(scratch);
    *count = status != FW_OK;
    return status == FW_NOMEM || status == FW_CANCELLED ? status : FW_OK;
}

fw_status fw_verdict_value_of_parameter(fw_verdict_trial *trial, const fw_device_parameter *p,
                                        fw_verdict_value *h, bool *ok) {
    *h = (fw_verdict_value){.path = p->name, .unit_text = p->unit};
    *ok = false;
    const bool own = fw_quantity_unit_parse(p->unit, strlen(p->unit), &h->unit, NULL, NULL) &&
                     fw_quantity_dimension_equal(h->unit.dimension, p->dimension);
    const bool pure = fw_quantity_dimension_equal(p->dimension, (fw_quantity_dimension){0});
    if (!own) h->unit_text = "";
    if (!own && !pure) FW_TRY(written_unit(trial, p->name, p->dimension, &h->unit_text, &h->unit));
    if (!h->unit_text[0]) {
        FW_NEED(h->unit_text = fw_quantity_dimension_si(trial->arena, p->dimension));
        h->unit = (fw_quantity_unit){.factor = 1, .dimension = p->dimension};
    }
    double ends[2] = {p->min, p->max}, v = h->now = fw_quantity_unit_from_si(&h->unit, p->value);
    for (int i = 0; i < 2; i++) {
        double away = (i == 0) == (v > 0) ? 1 / factor_without_bounds : factor_without_bounds;
        ends[i] = isinf(ends[i]) ? v * away : fw_quantity_unit_from_si(&h->unit, ends[i]);
    }
    h->low = fmin(v > 0 && ends[0] == 0 ? nearest_to_0 * v : ends[0], v);
    h->high = fmax(v < 0 && ends[1] == 0 ? nearest_to_0 * v : ends[1], v);
    h->range = fmax(v - h->low, h->high - v);
    if (!(h->range > 0)) return FW_OK;
    bool count;
    h->digit = pow(10, floor(log10(least_step * h->range)));
    FW_TRY(is_count(trial, h, &count));
    if (count) h->digit = fmax(h->digit, 1);
    *ok = true;
    return FW_OK;
}

/* ---- variables of advice ---- */

/* a load may also have to grow: a stroke that is required */
static const double least_share = 0.02, most_share = 20;
static const double shortest = 0.25, longest = 12, narrowest = 0.5, widest = 4;

/* ---- how large a change is ---- */

static bool by_ratio(const fw_verdict_variable *v, double x) {
    return (x > 0 && v->value.now > 0) || (x < 0 && v->value.now < 0);
}

/* on the way from now to its ends it keeps its sign */
static bool keeps_sign(const fw_verdict_variable *v) {
    return by_ratio(v, v->value.low) && by_ratio(v, v->value.high);
}

double fw_verdict_variable_z(const fw_verdict_variable *v, double x) {
    return keeps_sign(v) ? log(x / v->value.now) : (x - v->value.now) / v->value.range;
}

double fw_verdict_variable_x(const fw_verdict_variable *v, double z) {
    const double x = keeps_sign(v) ? v->value.now * exp(z) : v->value.now + z * v->value.range;
    return fmin(fmax(x, v->value.low), v->value.high);
}

double fw_verdict_variable_size(const fw_verdict_variable *v, double x) {
    return by_ratio(v, x) ? fabs(log(x / v->value.now)) : fabs(x - v->value.now) / v->value.range;
}

double fw_verdict_variable_typed(const fw_verdict_variable *v, double x) {
    const double away = fabs(x - v->value.now);
    if (fw_verdict_variable_size(v, x) < 1e-3) return v->value.now;
    const double step =
        fw_verdict_value_step(&v->value, fmax(4e-3 * away, 1e-4 * fabs(v->value.now)));
    x = fw_verdict_value_rounded(x, step);
    return fmin(fmax(x, v->value.low), v->value.high);
}

/* ---- which there are ---- */

fw_status fw_verdict_variables_of_parameters(fw_verdict_trial *trial,
                                             fw_verdict_variable **variable, int *count) {
    const fw_device *d = trial->device;
    *count = 0;
    FW_NEED(*variable = fw_arena_array(trial->arena, fw_verdict_variable, (size_t)d->nparameter));
    for (int i = 0; i < d->nparameter; i++) {
        fw_verdict_variable *v = &(*variable)[*count];
        bool ok;
        *v = (fw_verdict_variable){.name = d->parameter[i].name, .kind = FW_PROPOSE_PARAMETER};
        FW_TRY(fw_verdict_value_of_parameter(trial, &d->parameter[i], &v->value, &ok));
        *count += ok && v->value.digit < v->value.range;
    }
    return FW_OK;
}

/* ---- what min and max of parameters allow ---- */

/* what a variable changes: the loads of a scene, or one length of a flexure */
typedef struct subject {
    int scene, flexure; /* one of them, the other FW_NONE */
    double (*of)(const fw_device_flexure *flexure);
} subject;

static double length_of(const fw_device_flexure *f) {
    return f->length_m;
}
static double radius_of(const fw_device_flexure *f) {
    return f->radius_m;
}
static double width_of(const fw_device_flexure *f) {
    return f->width_m;
}

/* the device with a parameter at its min (k 0) or max, or at half and twice its value where it has none; read once. NULL: it
   cannot be read so, or the parameter is there already */
static fw_status at_end(fw_verdict_trial *trial, int i, int k, const fw_device **out) {
    const fw_device_parameter *p = &trial->device->parameter[i];
    const double end = k == 0 ? p->min : p->max;
    const double to = isfinite(end) ? end : p->value * (k == 0 ? 0.5 : 2);
    fw_verdict_trial_end *kept;
    if (!trial->end)
        FW_NEED(trial->end = fw_arena_array(trial->arena, fw_verdict_trial_end,
                                            2 * (size_t)trial->device->nparameter));
    kept = &trial->end[2 * i + k];
    if (!kept->read && to != p->value) {
        const fw_verdict_restated *r = &trial->options->restated;
        const char *unit = fw_quantity_dimension_si(trial->arena, p->dimension);
        fw_verdict_variant_verdict *variant = fw_arena_array(
            trial->arena, fw_verdict_variant_verdict, (size_t)trial->verdict->nvariant);
        const char *text =
            unit ? fw_arena_printf(trial->arena, "%.17g%s%s", to, *unit ? " " : "", unit) : NULL;
        if (!variant || !text) return FW_NOMEM;
        const fw_device_set set = {p->name, text};
        fw_status status = r->with(r->context, trial->arena, &set, 1, &kept->device, variant);
        if (status == FW_NOMEM || status == FW_CANCELLED) return status;
        if (status != FW_OK) kept->device = NULL;
    }
    kept->read = true;
    *out = kept->device;
    return FW_OK;
}

/* of the loads or the length in `then`: the least and largest share of what they are now */
static fw_status shares_of(fw_verdict_trial *trial, const subject *what, const fw_device *then,
                           double *low, double *high) {
    fw_effects_load_values *values; /* now, then */
    if (what->scene == FW_NONE) {
        double share = what->of(&then->flexure[what->flexure]) /
                       what->of(&trial->device->flexure[what->flexure]);
        *low = fmin(*low, share), *high = fmax(*high, share);
        return FW_OK;
    }
    FW_NEED(values = fw_arena_array(trial->arena, fw_effects_load_values, 2));
    fw_effects_find_load_values(&trial->device->scene[what->scene], &values[0]);
    fw_effects_find_load_values(&then->scene[what->scene], &values[1]);
    for (int i = 0; values[0].count == values[1].count && i < values[0].count; i++) {
        const fw_effects_load_value *now = &values[0].item[i];
        double share = values[1].item[i].value / now->value;
        if (now->squared) share *= share;
        *low = fmin(*low, share), *high = fmax(*high, share);
    }
    return FW_OK;
}

/* how far parameters let something go */
typedef struct leeway {
    bool hangs;     /* it is another with another value of one of them */
    bool free[2];   /* no min or max holds its least, its largest share */
    double most[2]; /* what the ends lead to; 1 and 1: to nothing else */
} leeway;

static fw_status add_leeway(fw_verdict_trial *trial, const subject *what, int i, leeway *w) {
    const fw_device_parameter *p = &trial->device->parameter[i];
    for (int k = 0; k < 2; k++) {
        const bool declared = isfinite(k == 0 ? p->min : p->max);
        const fw_device *then;
        double low = 1, high = 1;
        FW_TRY(at_end(trial, i, k, &then));
        if (then) FW_TRY(shares_of(trial, what, then, &low, &high));
        const bool less = low<1 - 1e-9, more = high> 1 + 1e-9;
        w->hangs = w->hangs || less || more;
        w->free[0] = w->free[0] || (!declared && less);
        w->free[1] = w->free[1] || (!declared && more);
        if (declared) w->most[0] = fmin(w->most[0], low), w->most[1] = fmax(w->most[1], high);
    }
    return FW_OK;
}

/* What hangs on parameters goes no farther than the min and max of that one which lets it go farthest: as shares of
   what it is now, 0 and INFINITY where nothing holds it. */
static fw_status share_between(fw_verdict_trial *trial, const subject *what, double share[2]) {
    leeway w = {.most = {1, 1}};
    bool bounded = false;
    const fw_device *d = trial->device;
    for (int i = 0; i < d->nparameter; i++)
        bounded = bounded || isfinite(d->parameter[i].min) || isfinite(d->parameter[i].max);
    for (int i = 0; bounded && i < d->nparameter; i++)
        FW_TRY(add_leeway(trial, what, i, &w));
    share[0] = w.hangs && !w.free[0] ? w.most[0] : 0;
    share[1] = w.hangs && !w.free[1] ? w.most[1] : (double)INFINITY;
    return FW_OK;
}

/* *ok: something is left to choose from */
static fw_status keep_between(fw_verdict_trial *trial, const subject *what, fw_verdict_value *v,
                              bool *ok) {
    double share[2];
    FW_TRY(share_between(trial, what, share));
    v->low = fmax(v->low, share[0] * v->now), v->high = fmin(v->high, share[1] * v->now);
    v->range = fmax(v->high - v->now, v->now - v->low);
    *ok = v->range > 1e-6 * v->now;
    return FW_OK;
}

bool fw_verdict_flexure_within(fw_verdict_trial *trial, int flexure) {
    const fw_device_flexure *f = &trial->changed->flexure[flexure];
    double (*const of[])(const fw_device_flexure *) = {length_of, width_of};
    for (int k = 0; k < 2; k++) {
        double share[2], now = of[k](&trial->device->flexure[flexure]), to = of[k](f);
        if (share_between(trial, &(subject){FW_NONE, flexure, of[k]}, share) != FW_OK) return false;
        if (to < share[0] * now - 1e-12 || to > share[1] * now + 1e-12) return false;
    }
    return true;
}

/* ---- those of flexures, loads and boxes ---- */

static const double fw_finest_length_m = 1e-7; /* what is drawn is not stated more finely */

fw_status fw_verdict_value_of_length(fw_verdict_trial *trial, const char *path, double m,
                                     double least, double most, fw_verdict_value *v) {
    *v = (fw_verdict_value){.path = path};
    FW_TRY(written_unit(trial, path, (fw_quantity_dimension){.m = 1}, &v->unit_text, &v->unit));
    if (!v->unit_text[0]) {
        v->unit_text = "um";
        fw_quantity_unit_parse("um", 2, &v->unit, NULL, NULL);
    }
    v->now = fw_quantity_unit_from_si(&v->unit, m);
    v->digit = pow(10, nearbyint(log10(fw_quantity_unit_from_si(&v->unit, fw_finest_length_m))));
    v->low = least * v->now, v->high = most * v->now, v->range = v->high - v->now;
    return FW_OK;
}

/* of `part`, whose unit is the SI one: it becomes the file's, where that has one */
static fw_status as_written(fw_verdict_trial *trial, fw_verdict_part *part) {
    fw_quantity_unit si = {.factor = 1};
    const char *text;
    fw_quantity_unit_parse(part->unit, strlen(part->unit), &si, NULL, NULL);
    FW_TRY(written_unit(trial, part->path, si.dimension, &text, &part->as));
    part->prefixed = !text[0] && !strchr(part->unit, '/');
    if (text[0])
        part->unit = text;
    else
        part->as = si;
    return FW_OK;
}

static fw_status add_attribute(fw_verdict_trial *trial, int flexure, const char *attribute,
                               double (*of)(const fw_device_flexure *), double least, double most,
                               fw_verdict_variable *variable, int *count) {
    const fw_device_flexure *f = &trial->device->flexure[flexure];
    const char *path = fw_arena_printf(trial->arena, "flexure[%s]/@%s", f->id, attribute);
    fw_verdict_variable *v = &variable[*count];
    bool ok;
    FW_NEED(path);
    *v = (fw_verdict_variable){.kind = FW_PROPOSE_FLEXURES};
    FW_TRY(fw_verdict_value_of_length(trial, path, of(f), least, most, &v->value));
    FW_NEED(v->name =
                fw_arena_printf(trial->arena, "%s of %s%s", attribute, FW_NAMED("flexure", f->id)));
    FW_TRY(keep_between(trial, &(subject){FW_NONE, flexure, of}, &v->value, &ok));
    *count += ok;
    return FW_OK;
}

static fw_verdict_value share(double least, double most) {
    fw_verdict_value v = {
        .path = "", .unit_text = "", .now = 1, .low = least, .high = most, .digit = 1e-4};
    v.unit = (fw_quantity_unit){.factor = 1};
    v.range = fmax(v.high - 1, 1 - v.low);
    return v;
}

/* an arc that states both keeps its angle */
static fw_status add_length_and_radius(fw_verdict_trial *trial, int flexure,
                                       fw_verdict_variable *variable, int *count) {
    const fw_device_flexure *f = &trial->device->flexure[flexure];
    fw_verdict_variable *v = &variable[*count];
    fw_verdict_part *part;
    bool length, radius;
    *v = (fw_verdict_variable){
        .kind = FW_PROPOSE_FLEXURES, .value = share(shortest, longest), .npart = 2};
    FW_NEED(part = fw_arena_array(trial->arena, fw_verdict_part, 2));
    part[0] = (fw_verdict_part){.unit = "m", .value = f->length_m};
    part[1] = (fw_verdict_part){.unit = "m", .value = f->radius_m};
    FW_NEED(part[0].path = fw_arena_printf(trial->arena, "flexure[%s]/@length", f->id));
    FW_NEED(part[1].path = fw_arena_printf(trial->arena, "flexure[%s]/@radius", f->id));
    FW_TRY(as_written(trial, &part[0]));
    FW_TRY(as_written(trial, &part[1]));
    FW_NEED(v->name = fw_arena_printf(trial->arena, "length and radius of %s%s",
                                      FW_NAMED("flexure", f->id)));
    v->part = part;
    FW_TRY(keep_between(trial, &(subject){FW_NONE, flexure, length_of}, &v->value, &length));
    FW_TRY(keep_between(trial, &(subject){FW_NONE, flexure, radius_of}, &v->value, &radius));
    *count += length && radius;
    return FW_OK;
}

static fw_status add_flexure(fw_verdict_trial *trial, int flexure, fw_verdict_variable *variable,
                             int *count) {
    const fw_device_flexure *f = &trial->device->flexure[flexure];
    bool radius = f->kind == FW_FLEXURE_CSFH && f->radius_given;
    if (f->kind == FW_FLEXURE_PATH) return FW_OK;
    if (radius && f->length_given)
        FW_TRY(add_length_and_radius(trial, flexure, variable, count));
    else
        FW_TRY(add_attribute(trial, flexure, radius ? "radius" : "length",
                             radius ? radius_of : length_of, shortest, longest, variable, count));
    if (!fw_device_flexure_varies(f))
        FW_TRY(
            add_attribute(trial, flexure, "width", width_of, narrowest, widest, variable, count));
    return FW_OK;
}

fw_status fw_verdict_variable_of_loads(fw_verdict_trial *trial, int scene, fw_verdict_variable *v,
                                       bool *ok) {
    const fw_device_scene *s = &trial->device->scene[scene];
    fw_effects_load_values *values;
    fw_verdict_part *part;
    FW_NEED(values = fw_arena_one(trial->arena, fw_effects_load_values));
    fw_effects_find_load_values(s, values);
    *ok = values->count > 0 && !values->more;
    *v = (fw_verdict_variable){.kind = FW_PROPOSE_LOADS, .value = share(least_share, most_share)};
    FW_NEED(part = fw_arena_array(trial->arena, fw_verdict_part, (size_t)values->count));
    for (int i = 0; i < values->count; i++) {
        const fw_effects_load_value *l = &values->item[i];
        const char *which = l->id ? l->id : fw_arena_printf(trial->arena, "%d", l->number);
        FW_NEED(which);
        part[i] = (fw_verdict_part){.unit = l->unit, .value = l->value, .squared = l->squared};
        FW_NEED(part[i].path = fw_arena_printf(trial->arena, "scene[%s]/%s[%s]/@%s", s->name,
                                               l->element, which, l->attribute));
        FW_TRY(as_written(trial, &part[i]));
    }
    v->part = part, v->npart = values->count;
    FW_NEED(v->name = fw_arena_printf(trial->arena, "loads of %s%s", FW_NAMED("scene", s->name)));
    if (*ok) FW_TRY(keep_between(trial, &(subject){scene, FW_NONE, NULL}, &v->value, ok));
    return FW_OK;
}

fw_status fw_verdict_variable_of_box(fw_verdict_trial *trial, int box, fw_verdict_variable *v,
                                     bool *ok) {
    const fw_device_workspace_box *w = &trial->device->workspace[box];
    const struct {
        const char *attribute;
        double value;
        bool angle;
    } end[] = {{"x-min", w->x_min_m, false},      {"x-max", w->x_max_m, false},
               {"y-min", w->y_min_m, false},      {"y-max", w->y_max_m, false},
               {"phi-min", w->phi_min_rad, true}, {"phi-max", w->phi_max_rad, true}};
    fw_verdict_part *part;
    *v = (fw_verdict_variable){.kind = FW_PROPOSE_LOADS, .value = share(least_share, 1)};
    FW_NEED(part = fw_arena_array(trial->arena, fw_verdict_part, 6));
    for (int i = 0; i < 6; i++) {
        if (end[i].value == 0) continue;
        fw_verdict_part *p = &part[v->npart++];
        *p = (fw_verdict_part){.unit = end[i].angle ? "rad" : "m", .value = end[i].value};
        FW_NEED(p->path =
                    fw_arena_printf(trial->arena, "workspace[%d]/@%s", box + 1, end[i].attribute));
        FW_TRY(as_written(trial, p));
    }
    v->part = part;
    *ok = v->npart > 0;
    FW_NEED(v->name = fw_arena_printf(trial->arena, "required workspace%s%s", w->flow ? " of " : "",
                                      w->flow ? w->flow : ""));
    return FW_OK;
}

fw_status fw_verdict_variables_of_attributes(fw_verdict_trial *trial,
                                             fw_verdict_variable **variable, int *count) {
    const fw_device *d = trial->device;
    size_t most = 2 * (size_t)d->nflexure + (size_t)d->nscene + (size_t)d->nworkspace;
    bool ok;
    *count = 0;
    FW_NEED(*variable = fw_arena_array(trial->arena, fw_verdict_variable, most));
    for (int i = 0; i < d->nflexure; i++)
        FW_TRY(add_flexure(trial, i, *variable, count));
    for (int i = 0; i < d->nscene; i++) {
        FW_TRY(fw_verdict_variable_of_loads(trial, i, &(*variable)[*count], &ok));
        *count += ok;
    }
    for (int i = 0; i < d->nworkspace; i++) {
        FW_TRY(fw_verdict_variable_of_box(trial, i, &(*variable)[*count], &ok));
        *count += ok;
    }
    return FW_OK;
}

/* only rims that may not bear ask for fewer or smaller holes */
static bool rims_speak(const fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        const fw_verdict_fabricated_verdict *made = v->fabricated;
        for (int k = 0; k < v->nreason; k++)
            if (v->reason[k].number == FW_VERDICT_RIMS) return true;
        for (int k = 0; made && k < made->ncorner; k++)
            if (made->corner[k].number == FW_VERDICT_RIMS) return true;
    }
    return false;
}

/* how many times the pitch, and which share of the diameter, are looked at; no hole is smaller than that */
static const double fw_farthest_holes = 4, fw_smallest_share = 0.3, fw_smallest_hole_m = 8e-6;

fw_status fw_verdict_variables_of_holes(fw_verdict_trial *trial, fw_verdict_variable **variable,
                                        int *count) {
    const fw_device *d = trial->device;
    const double pitch = d->release_pitch_m,
                 hole = d->release_hole_m > 0 ? d->release_hole_m : 0.3 * pitch;
    const double least = fmax(fw_smallest_share, fw_smallest_hole_m / hole);
    *count = 0;
    FW_NEED(*variable = fw_arena_array(trial->arena, fw_verdict_variable, 2));
    if (!(pitch > 0) || !rims_speak(trial->verdict)) return FW_OK;
    fw_verdict_variable *v = &(*variable)[(*count)++];
    *v = (fw_verdict_variable){.kind = FW_PROPOSE_HOLES, .name = "pitch of release holes"};
    FW_TRY(fw_verdict_value_of_length(trial, "die/@release-pitch", pitch, 1, fw_farthest_holes,
                                      &v->value));
    if (!(d->release_hole_m > 0) || !(least < 1)) return FW_OK; /* it goes with the pitch */
    v = &(*variable)[(*count)++];
    *v = (fw_verdict_variable){.kind = FW_PROPOSE_HOLES, .name = "diameter of release holes"};
    FW_TRY(fw_verdict_value_of_length(trial, "die/@release-hole", hole, least, 1, &v->value));
    v->value.range = v->value.now - v->value.low;
    return FW_OK;
}

/* ---- as settings, and in words ---- */

/* "112.5 uN": in the file's unit, or with the prefix that leaves one to three digits before the point */
static const char *part_text(fw_arena *arena, const fw_verdict_part *p, double by) {
    static const struct {
        const char *sign;
        double factor;
    } prefix[] = {{"", 1}, {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}, {"p", 1e-12}};
    const double value = fw_quantity_unit_from_si(&p->as, p->value * (p->squared ? sqrt(by) : by));
    char number[40];
    size_t k = 0;
    while (p->prefixed && k + 1 < sizeof prefix / sizeof prefix[0] &&
           fabs(value) < prefix[k].factor)
        k++;
    return fw_arena_printf(arena, "%s %s%s",
                           fw_number_text(number, sizeof number, value / prefix[k].factor, 5),
                           prefix[k].sign, p->unit);
}

fw_status fw_verdict_variables_settings(fw_arena *arena, const fw_verdict_variable *variable,
                                        int count, const double *x, const fw_device_set **set,
                                        int *nset) {
    size_t most = 0;
    fw_device_set *s;
    for (int i = 0; i < count; i++)
        most += variable[i].npart ? (size_t)variable[i].npart : 1;
    FW_NEED(s = fw_arena_array(arena, fw_device_set, most));
    *nset = 0;
    for (int i = 0; i < count; i++) {
        const fw_verdict_variable *v = &variable[i];
        if (x[i] == v->value.now) continue;
        for (int k = 0; k < v->npart; k++) {
            const char *value = part_text(arena, &v->part[k], x[i]);
            FW_NEED(value);
            s[(*nset)++] = (fw_device_set){v->part[k].path, value};
        }
        if (v->npart > 0) continue;
        const char *value = fw_verdict_value_text(arena, &v->value, x[i], 12);
        FW_NEED(value);
        s[(*nset)++] = (fw_device_set){v->value.path, value};
    }
    *set = s;
    return FW_OK;
}

static fw_status add_text(fw_arena *arena, const fw_verdict_variable *v, double x, fw_text *text) {
    if (v->npart > 0) {
        fw_text_printf(text, "the %s to ", v->name);
        fw_text_number(text, 100 * x, 4);
        fw_text_add(text, " %");
        return FW_OK;
    }
    const char *to = fw_verdict_value_text(arena, &v->value, x, 12);
    const char *now = fw_verdict_value_text(arena, &v->value, v->value.now, 6);
    FW_NEED(to && now ? to : NULL);
    fw_text_printf(text, "%s %s (now %s)", v->name, to, now);
    return FW_OK;
}

fw_status fw_verdict_variables_text(fw_arena *arena, const fw_verdict_variable *variable, int count,
                                    const double *x, const char **text) {
    int left = 0, said = 0;
    fw_text t = fw_text_new(arena);
    for (int i = 0; i < count; i++)
        left += x[i] != variable[i].value.now;
    const int all = left;
    for (int i = 0; i < count; i++) {
        if (x[i] == variable[i].value.now) continue;
        left--;
        if (said++ > 0) fw_text_add(&t, left == 0 ? " and " : ", ");
        FW_TRY(add_text(arena, &variable[i], x[i], &t));
    }
    fw_text_add(&t, all > 1 ? " together: accepted" : ": accepted");
    FW_TRY(fw_text_end(&t));
    *text = t.data;
    return FW_OK;
}
