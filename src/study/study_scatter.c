/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What differs from device to device, on which level and where on the wafer: the rows of <uncertain> and <trend> and what
   the packs state, as one map from independent standard normal numbers to the values of a device; and wafers simulated
   by it: what of the spread is between lots, wafers, places, dies and hinges, and the yield by place. */
#include "maths/functions.h"
#include "study/study.h"
#include "study/study_parts.h"
#include "wafer/wafer.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool same(const char *a, const char *b) {
    return !a == !b && (!a || strcmp(a, b) == 0);
}

/* an input of a flow: what its pack states, else a range of which nothing but the ends is known */
static fw_chance_distribution of_input(const fw_verdict_fabrication_input *in) {
    if (!(in->high > in->low))
        return (fw_chance_distribution){.kind = FW_CHANCE_CONSTANT, .mean = in->nominal};
    if (in->unknown)
        return (fw_chance_distribution){
            .kind = FW_CHANCE_INTERVAL, .low = in->low, .high = in->high};
    if (in->q.interval || !(in->sigma > 0))
        return (fw_chance_distribution){
            .kind = FW_CHANCE_UNIFORM, .low = in->low, .high = in->high};
    return (fw_chance_distribution){.kind = FW_CHANCE_NORMAL, .mean = in->nominal, .sd = in->sigma};
}

/* mean: of a row that states none */
static fw_chance_distribution of_uncertain(const fw_device_uncertain *u, double mean) {
    static const fw_chance_kind kind[] = {
        [FW_SPREAD_NORMAL] = FW_CHANCE_NORMAL,   [FW_SPREAD_LOGNORMAL] = FW_CHANCE_LOGNORMAL,
        [FW_SPREAD_UNIFORM] = FW_CHANCE_UNIFORM, [FW_SPREAD_TRUNCATED] = FW_CHANCE_TRUNCATED,
        [FW_SPREAD_TABLE] = FW_CHANCE_TABLE,     [FW_SPREAD_INTERVAL] = FW_CHANCE_INTERVAL};
    return (fw_chance_distribution){.kind = kind[u->spread],
                                    .mean = isnan(u->mean) ? mean : u->mean,
                                    .sd = u->sd,
                                    .low = u->from,
                                    .high = u->to,
                                    .count = (size_t)u->ntable,
                                    .x = u->x,
                                    .p = u->p};
}

/* ---- groups: the rows of one input ---- */

typedef struct builder {
    fw_study *study;
    const fw_verdict_variant_verdict *v;
    fw_study_scatter *s;
    fw_chance_variable *variable;
    const fw_device_uncertain **row; /* (variables) NULL: of the pack */
    double radius_m;                 /* of the wafer; 0: none is asked for */
    fw_chance_correlation *correlation;
    const fw_device_correlation **asked; /* (correlations) */
} builder;

/* the rows of an input become variables; how many */
static int add_rows(builder *b, fw_study_group *g, const char *what, const char *flow,
                    double mean) {
    static const fw_chance_level level[] = {[FW_LEVEL_LOT] = FW_CHANCE_LOT,
                                            [FW_LEVEL_WAFER] = FW_CHANCE_WAFER,
                                            [FW_LEVEL_DIE] = FW_CHANCE_DIE,
                                            [FW_LEVEL_HINGE] = FW_CHANCE_HINGE};
    const fw_device_study *asked = b->study->asked;
    int n = 0;
    for (int k = 0; k < asked->nuncertain; k++) {
        const fw_device_uncertain *u = &asked->uncertain[k];
        if (!same(u->what, what) || !same(u->flow, flow)) continue;
        b->row[b->s->variables] = u;
        b->variable[b->s->variables++] =
            (fw_chance_variable){.name = what,
                                 .distribution = of_uncertain(u, n == 0 ? mean : 0),
                                 .level = level[u->level]};
        if (u->levelled) b->s->levels = true;
        n++;
    }
    g->variables = n;
    return n;
}

/* its trend stands at its first variable; through which normal part other places are told of */
static void add_trend(builder *b, fw_study_group *g, const char *what, const char *flow) {
    const fw_device_study *asked = b->study->asked;
    for (int k = 0; k < asked->ntrend; k++) {
        const fw_device_trend *t = &asked->trend[k];
        if (!same(t->what, what) || !same(t->flow, flow)) continue;
        g->trend = t;
        b->s->trends++;
        b->s->levels = true;
        b->variable[g->first].trend = (fw_chance_trend){.radius_m = b->radius_m,
                                                        .radial = t->radial,
                                                        .along_x = t->along_x,
                                                        .along_y = t->along_y};
    }
    g->carrier = -1;
    for (int v = g->first; v < g->first + g->variables; v++) {
        const fw_chance_variable *x = &b->variable[v];
        bool normal = x->distribution.kind == FW_CHANCE_NORMAL && x->level != FW_CHANCE_HINGE;
        if (normal &&
            (g->carrier < 0 || x->distribution.sd > b->variable[g->carrier].distribution.sd))
            g->carrier = v;
    }
}

static void add_input(builder *b, int k) {
    const fw_verdict_fabrication_input *in = &b->v->input[k];
    fw_study_group *g = &b->s->group[b->s->groups++];
    *g = (fw_study_group){.what = in->name,
                          .unit = in->q.unit ? in->q.unit : "1",
                          .first = b->s->variables,
                          .at = b->s->npoint,
                          .count = 1};
    const char *flow = b->v->variant->flow;
    if (!flow || add_rows(b, g, in->name, flow, in->nominal) == 0) {
        /* what a pack knows of a quantity holds for a lot: all of its wafers have the same liquid and the same rates */
        b->variable[b->s->variables++] = (fw_chance_variable){
            .name = in->name, .distribution = of_input(in), .level = FW_CHANCE_LOT};
        g->variables = 1;
    }
    add_trend(b, g, in->name, flow);
    b->s->npoint++;
}

static void add_setting(builder *b, const fw_study_input *in) {
    const fw_device_uncertain *u = in->uncertain;
    int last = b->s->groups - 1;
    if (last >= 0 && b->s->group[last].asked == u) { /* another flexure of the same rows */
        b->s->group[last].count++;
    } else {
        fw_study_group *g = &b->s->group[b->s->groups++];
        *g = (fw_study_group){.what = u->what,
                              .unit = u->unit,
                              .asked = u,
                              .first = b->s->variables,
                              .at = b->s->npoint,
                              .count = 1};
        add_rows(b, g, u->what, NULL, (double)NAN);
        add_trend(b, g, u->what, NULL);
    }
    b->s->npoint++;
}

/* ---- places ---- */

static int by_radius(const void *a, const void *b) {
    const fw_study_place *p = a, *q = b;
    double r = hypot(p->at.x_m, p->at.y_m), s = hypot(q->at.x_m, q->at.y_m);
    return r < s ? -1 : r > s ? 1 : p->number - q->number;
}

/* the dies of the wafer, from the centre outwards; steps of its sweeps are all taken to be this device */
static fw_status take_places(builder *b) {
    fw_study *study = b->study;
    fw_study_scatter *s = b->s;
    const fw_plan *plan = study->plan;
    const fw_device_wafer_asked *asked = &plan->device->wafer;
    if (!asked->asked) return FW_OK;
    fw_wafer_form form;
    fw_wafer_grid grid;
    fw_geometry_box die = plan->layout->die;
    FW_TRY(fw_wafer_form_of(asked, &study->diags, &form));
    FW_TRY(fw_wafer_grid_fill(study->arena, &form, asked,
                              (int32_t)ceil((die.x1 - die.x0) * 1e9 - 1e-3),
                              (int32_t)ceil((die.y1 - die.y0) * 1e9 - 1e-3), &study->diags, &grid));
    FW_TRY(fw_wafer_assign(&form, asked, &study->diags, &grid));
    s->rim_m = 0.5 * form.diameter_m;
    s->flat_m = form.flat_m, s->side = form.side;
    s->die_x_m = 1e-9 * grid.width, s->die_y_m = 1e-9 * grid.height;
    FW_NEED(s->place = fw_arena_array(study->arena, fw_study_place, (size_t)grid.nsite));
    for (int i = 0; i < grid.nsite; i++) {
        const fw_wafer_site *site = &grid.site[i];
        char row[FW_WAFER_NAME], column[FW_WAFER_NAME];
        if (site->kind != FW_WAFER_DIE) continue;
        fw_study_place *p = &s->place[s->places++];
        p->number = i;
        p->at.x_m = 1e-9 * (site->x + 0.5 * grid.width);
        p->at.y_m = 1e-9 * (site->y + 0.5 * grid.height);
        FW_NEED(p->id = fw_arena_printf(study->arena, "%s%s", fw_wafer_row_name(site->row, row),
                                        fw_wafer_column_name(&grid, site->column, column)));
    }
    if (s->places > 1) qsort(s->place, s->places, sizeof *s->place, by_radius);
    b->radius_m = s->rim_m;
    return FW_OK;
}

/* ---- what is asked that is not there ---- */

/* a row of a flow: is there such a quantity of this flow, of this dimension? One of another flow is its own affair. */
static fw_status check_row(fw_study *study, const char *what, const char *flow, int number,
                           fw_quantity_dimension dimension, fw_place place) {
    const fw_verdict *verdict = &study->plan->verdict;
    const fw_verdict_variant_verdict *v = NULL;
    fw_text names = fw_text_new(study->arena);
    for (int i = 0; i < verdict->nvariant; i++)
        if (same(verdict->variant[i].variant->flow, flow)) v = &verdict->variant[i];
    for (int i = 0; i < study->plan->device->nflow && !v; i++)
        if (same(study->plan->device->flow[i].ref, flow)) return FW_OK; /* --flow leaves it out */
    if (!v)
        return fw_diag_error(&study->diags, number, place,
                             "study '%s': the device names no flow '%s'", study->asked->name, flow);
    for (int k = 0; k < v->ninput; k++) {
        const char *unit = v->input[k].q.unit ? v->input[k].q.unit : "1";
        fw_quantity_unit parsed = {.factor = 1};
        if (!same(v->input[k].name, what)) {
            fw_text_printf(&names, "%s %s", k ? "," : "", v->input[k].name);
            continue;
        }
        bool known = strcmp(unit, "1") == 0 ||
                     fw_quantity_unit_parse(unit, strlen(unit), &parsed, NULL, NULL);
        if (!known || fw_quantity_dimension_equal(parsed.dimension, dimension)) return FW_OK;
        return fw_diag_error(&study->diags, number, place,
                             "study '%s': %s of %s is in %s, and what is stated of it is not",
                             study->asked->name, what, flow, unit);
    }
    return fw_diag_error(&study->diags, number, place,
                         "study '%s': %s makes nothing differ that is called '%s'; it has%s",
                         study->asked->name, flow, what, names.failed ? "" : names.data);
}

static fw_status check_trend(fw_study *study, const fw_device_trend *t) {
    const fw_device_study *a = study->asked;
    if (!study->plan->device->wafer.asked)
        return fw_diag_error(&study->diags, 557, t->place,
                             "study '%s': a trend goes over a wafer, and the device has none; add "
                             "<wafer diameter=\"100 mm\"/> to it",
                             a->name);
    if (t->flow) return check_row(study, t->what, t->flow, 557, t->dimension, t->place);
    for (int k = 0; k < a->nuncertain; k++)
        if (same(a->uncertain[k].what, t->what) && !a->uncertain[k].flow) {
            if (fw_quantity_dimension_equal(a->uncertain[k].dimension, t->dimension)) return FW_OK;
            return fw_diag_error(&study->diags, 557, t->place,
                                 "study '%s': the trend of '%s' is of another dimension than its "
                                 "<uncertain>",
                                 a->name, t->what);
        }
    return fw_diag_error(&study->diags, 557, t->place,
                         "study '%s': '%s' has a trend and no <uncertain>; add one, or with "
                         "flow=\"...\" name the flow that it is a quantity of",
                         a->name, t->what);
}

/* one end: an input that differs, and has no trend, by which other places are told of from its values alone */
static fw_status check_correlated(fw_study *study, const fw_device_correlation *c,
                                  const char *what) {
    const fw_device_study *a = study->asked;
    const fw_device_uncertain *row = NULL;
    for (int k = 0; k < a->nuncertain && !row; k++)
        if (same(a->uncertain[k].what, what) && same(a->uncertain[k].flow, c->flow))
            row = &a->uncertain[k];
    for (int k = 0; k < a->ntrend; k++)
        if (same(a->trend[k].what, what) && same(a->trend[k].flow, c->flow))
            return fw_diag_error(&study->diags, 589, c->place,
                                 "study '%s': '%s' has a trend over the wafer, and what has one is "
                                 "not correlated with others; remove one of both",
                                 a->name, what);
    if (!row && !c->flow)
        return fw_diag_error(
            &study->diags, 589, c->place,
            "study '%s': '%s' is correlated and has no <uncertain>; add one, or with "
            "flow=\"...\" name the flow that it is a quantity of",
            a->name, what);
    if (row) return FW_OK;
    for (int i = 0; i < study->plan->verdict.nvariant; i++) {
        const fw_verdict_variant_verdict *v = &study->plan->verdict.variant[i];
        for (int k = 0; same(v->variant->flow, c->flow) && k < v->ninput; k++)
            if (same(v->input[k].name, what)) return FW_OK;
    }
    for (int i = 0; i < study->plan->device->nflow; i++)
        if (same(study->plan->device->flow[i].ref, c->flow))
            for (int k = 0; k < study->plan->verdict.nvariant; k++)
                if (same(study->plan->verdict.variant[k].variant->flow, c->flow))
                    return fw_diag_error(&study->diags, 589, c->place,
                                         "study '%s': %s makes nothing differ that is called '%s'",
                                         a->name, c->flow, what);
    return FW_OK; /* of a flow that is not judged, or that check_row refuses */
}

/* Beforehand: the share of an input beyond what its parameter allows. Of several rows the normal ones are one. */
static fw_status say_beyond(fw_study *study, const fw_study_input *in) {
    const fw_device *d = study->plan->device;
    fw_chance_distribution all = of_uncertain(in->uncertain, (double)NAN);
    for (const fw_device_uncertain *u = in->uncertain + 1;
         u < study->asked->uncertain + study->asked->nuncertain; u++)
        if (!u->flow && same(u->what, in->what) && u->spread == FW_SPREAD_NORMAL)
            all.mean += isnan(u->mean) ? 0 : u->mean, all.sd = hypot(all.sd, u->sd);
    const char *text = "a part";
    char share[32];
    if (fw_chance_distribution_check(study->arena, &all, &text) != FW_OK) return FW_OK;
    for (int k = 0; k < d->nparameter; k++) {
        const fw_device_parameter *p = &d->parameter[k];
        const bool ends = all.kind == FW_CHANCE_INTERVAL; /* of no distribution */
        if (strcmp(p->name, in->what) != 0) continue;
        const double beyond = ends ? all.low < p->min || all.high > p->max
                                   : fw_chance_distribution_cdf(&all, p->min) + 1 -
                                         fw_chance_distribution_cdf(&all, p->max);
        if (!(beyond >= 1e-12)) continue; /* no tail is known so far out */
        text = ends ? "a part" : fw_number_text(share, sizeof share, beyond, 2);
        fw_diag_warning(&study->diags, 738, in->place,
                        "study '%s': <uncertain what=\"%s\"> goes beyond min or max of the "
                        "parameter: %s of all devices lies there, and cannot be judged; declare a "
                        "wider range, or state spread=\"truncated\" with ends within it",
                        study->asked->name, in->what, text);
    }
    return study->diags.failed ? FW_NOMEM : FW_OK;
}

fw_status fw_study_scatter_check(fw_study *study) {
    const fw_device_study *a = study->asked;
    size_t before = study->diags.errors;
    fw_status status = FW_OK;
    for (int k = 0; k < a->nuncertain && status != FW_NOMEM; k++)
        if (a->uncertain[k].flow)
            status = check_row(study, a->uncertain[k].what, a->uncertain[k].flow, 556,
                               a->uncertain[k].dimension, a->uncertain[k].place);
    for (int k = study->nvary; k < study->nvary + study->nsetting && status != FW_NOMEM; k++)
        status = say_beyond(study, &study->input[k]);
    for (int k = 0; k < a->ntrend && status != FW_NOMEM; k++)
        status = check_trend(study, &a->trend[k]);
    for (int k = 0; k < a->ncorrelation && status != FW_NOMEM; k++) {
        status = check_correlated(study, &a->correlation[k], a->correlation[k].of);
        if (status == FW_OK)
            status = check_correlated(study, &a->correlation[k], a->correlation[k].with);
    }
    /* whether all of them together can be, before anything is run */
    for (int i = 0; a->ncorrelation > 0 && status == FW_OK && i < study->plan->verdict.nvariant;
         i++) {
        fw_study_scatter all;
        status = fw_study_scatter_of(study, &study->plan->verdict.variant[i], &all);
    }
    return status == FW_NOMEM ? FW_NOMEM : study->diags.errors > before ? FW_INPUT : FW_OK;
}

/* ---- all of it ---- */

static fw_status fault(const builder *b, const fw_chance_fault *f) {
    const fw_study *study = b->study;
    const fw_device_uncertain *row =
        f->variable < (size_t)b->s->variables ? b->row[f->variable] : NULL;
    const bool pair = f->correlation < (size_t)b->s->correlations;
    return fw_diag_error(&b->study->diags, pair ? 589 : 491,
                         pair                     ? b->asked[f->correlation]->place
                         : row                    ? row->place
                         : b->s->correlations > 0 ? b->asked[0]->place
                                                  : study->asked->place,
                         "study '%s': %s", study->asked->name, f->why ? f->why : "?");
}

/* the first variable of an input, which has its mean; -1: it does not differ in this flow */
static int variable_of(const builder *b, const char *what, const char *flow) {
    for (int i = 0; i < b->s->groups; i++) {
        const fw_study_group *g = &b->s->group[i];
        const bool of_flow = !g->asked;
        if (of_flow == (flow != NULL) && same(g->what, what) &&
            (!flow || same(flow, b->v->variant->flow)))
            return g->first;
    }
    return -1;
}

/* those of this flow and of the device */
static fw_status add_correlations(builder *b) {
    const fw_device_study *a = b->study->asked;
    FW_NEED(b->correlation =
                fw_arena_array(b->study->arena, fw_chance_correlation, (size_t)a->ncorrelation));
    FW_NEED(b->asked = fw_arena_array(b->study->arena, const fw_device_correlation *,
                                      (size_t)a->ncorrelation));
    for (int k = 0; k < a->ncorrelation; k++) {
        const fw_device_correlation *c = &a->correlation[k];
        const int of = variable_of(b, c->of, c->flow), with = variable_of(b, c->with, c->flow);
        if (of < 0 || with < 0) continue;
        b->asked[b->s->correlations] = c;
        b->correlation[b->s->correlations++] =
            (fw_chance_correlation){(size_t)of, (size_t)with, c->value};
    }
    return FW_OK;
}

fw_status fw_study_scatter_of(fw_study *study, const fw_verdict_variant_verdict *v,
                              fw_study_scatter *s) {
    size_t most = (size_t)(v->ninput + study->asked->nuncertain), groups = most;
    builder b = {.study = study, .v = v, .s = s};
    fw_chance_fault wrong = {0};
    *s = (fw_study_scatter){.ninput = v->ninput};
    if (fw_verdict_fabrication_open(v->input, v->ninput))
        return fw_diag_error(&study->diags, 695, study->asked->place,
                             "study '%s': what flow %s makes is not known, and no range is "
                             "assumed: %s (%s); state it in a laboratory pack, or give an assumed "
                             "range",
                             study->asked->name, v->variant->flow, v->input[v->ninput - 1].name,
                             v->input[v->ninput - 1].unknown);
    FW_NEED(b.variable = fw_arena_array(study->arena, fw_chance_variable, most));
    FW_NEED(b.row = fw_arena_array(study->arena, const fw_device_uncertain *, most));
    FW_NEED(s->group = fw_arena_array(study->arena, fw_study_group, groups));
    FW_TRY(take_places(&b));
    for (int k = 0; k < v->ninput; k++)
        add_input(&b, k);
    for (int k = 0; k < study->nsetting; k++)
        add_setting(&b, &study->input[study->nvary + k]);
    FW_TRY(add_correlations(&b));
    fw_status status = fw_chance_joint_new(
        study->arena, (size_t)study->plan->device->nflexure, (size_t)s->variables, b.variable,
        (size_t)s->correlations, b.correlation, &s->joint, &wrong);
    if (status == FW_INPUT) return fault(&b, &wrong);
    FW_TRY(status);
    /* where a trend goes over the wafer it matters where a die is: one number more */
    s->dimensions = s->joint.dimensions + (s->trends > 0);
    FW_NEED(s->middle = fw_arena_array(study->arena, double, s->joint.unknowns + 1));
    for (size_t k = 0; k < s->joint.unknowns; k++) {
        const fw_chance_distribution *d = &b.variable[s->joint.unknown[k]].distribution;
        s->middle[k] = 0.5 * (d->low + d->high);
    }
    return FW_OK;
}

const fw_study_place *fw_study_scatter_place(const fw_study_scatter *s, double share) {
    if (s->places == 0) return NULL;
    size_t k = (size_t)(share * (double)s->places);
    return &s->place[k < s->places ? k : s->places - 1];
}

const fw_chance_place *fw_study_scatter_at(const fw_study_scatter *s, const double *u) {
    if (s->dimensions == s->joint.dimensions) return NULL;
    const fw_study_place *p =
        fw_study_scatter_place(s, fw_maths_normal_cdf(u[s->joint.dimensions]));
    return p ? &p->at : NULL;
}

void fw_study_scatter_point(const fw_study_scatter *s, const double *u, const double *unknown,
                            const fw_chance_place *place, double *x, double *point) {
    fw_chance_joint_map(&s->joint, u, unknown ? unknown : s->middle, place, x);
    for (int i = 0; i < s->groups; i++) {
        const fw_study_group *g = &s->group[i];
        for (int h = 0; h < g->count; h++) {
            double sum = 0;
            for (int k = g->first; k < g->first + g->variables; k++) {
                bool own = s->joint.variable[k].level == FW_CHANCE_HINGE;
                sum += x[s->joint.value_first[k] + (own ? (size_t)h : 0)];
            }
            point[g->at + h] = sum;
        }
    }
}

/* ---- simulated wafers ---- */

enum { UNITS_LEAST = 25, UNITS_AT_ONCE = 64 };

typedef struct simulated { /* all dies of all units, a unit behind the other */
    fw_study *study;
    const fw_study_scatter *s;
    fw_chance_nested_order order;
    int members;
    size_t units, n;
    double *ln, *held; /* (n) */
    size_t *place, *unit;
    double *away; /* (n x trends) */
} simulated;

static bool has_hinges(const fw_study_scatter *s) {
    for (int v = 0; v < s->variables; v++)
        if (s->joint.variable[v].level == FW_CHANCE_HINGE) return true;
    return false;
}

static fw_status room_of(simulated *all) {
    fw_arena *arena = all->study->arena;
    size_t n = all->n, trends = (size_t)all->s->trends;
    FW_NEED(all->ln = fw_arena_array(arena, double, n));
    FW_NEED(all->held = fw_arena_array(arena, double, n));
    FW_NEED(all->place = fw_arena_array(arena, size_t, n));
    FW_NEED(all->unit = fw_arena_array(arena, size_t, n));
    FW_NEED(all->away = fw_arena_array(arena, double, n *trends + 1));
    return FW_OK;
}

/* the normal part of every input with a trend, by which a die tells of other places */
static void carry(const simulated *all, const double *u, double *away) {
    const fw_study_scatter *s = all->s;
    for (int i = 0, t = 0; i < s->groups; i++) {
        const fw_study_group *g = &s->group[i];
        if (!g->trend) continue;
        away[t++] = g->carrier < 0 ? 0
                                   : s->joint.variable[g->carrier].distribution.sd *
                                         u[s->joint.u_first[g->carrier]];
    }
}

/* units from `first` on: their points are drawn here and judged together */
static fw_status judge_units(simulated *all, size_t first, size_t units, long number,
                             fw_study_judge *judge, void *context) {
    const fw_study_scatter *s = all->s;
    fw_arena *scratch = fw_arena_part(all->study->arena, 0);
    FW_NEED(scratch);
    size_t n = units * (size_t)all->members, from = first * (size_t)all->members;
    double *point = fw_arena_array(scratch, double, n *(size_t)s->npoint),
           *u = fw_arena_array(scratch, double, s->joint.dimensions + 1),
           *x = fw_arena_array(scratch, double, s->joint.values + 1);
    fw_status status = point && u && x ? FW_OK : FW_NOMEM;
    for (size_t k = 0; status == FW_OK && k < n; k++) {
        fw_chance_place who = {0};
        size_t at = from + k, unit = at / (size_t)all->members;
        int member = (int)(at % (size_t)all->members);
        fw_chance_nested_member(&all->order, unit, member, &who, &all->place[at]);
        all->unit[at] = unit;
        if (s->places > 0) {
            who.x_m = s->place[all->place[at]].at.x_m;
            who.y_m = s->place[all->place[at]].at.y_m;
        }
        fw_chance_nested_draw(&s->joint, (uint64_t)all->study->asked->seed, &who, member, u);
        carry(all, u, all->away + at * (size_t)s->trends);
        fw_study_scatter_point(s, u, NULL, s->places > 0 ? &who : NULL, x,
                               point + k * (size_t)s->npoint);
    }
    if (status == FW_OK) status = judge(context, number + (long)from, n, point, all->ln + from);
    fw_arena_free(scratch);
    return status;
}

/* ---- by place ---- */

static double trend_at(const fw_device_trend *t, const fw_chance_place *at, double rim_m) {
    double x = at->x_m / rim_m, y = at->y_m / rim_m;
    return t->radial * (x * x + y * y - 0.5) + t->along_x * x + t->along_y * y;
}

static fw_status map(simulated *all, fw_study_levels *out) {
    const fw_study_scatter *s = all->s;
    fw_arena *arena = all->study->arena;
    size_t trends = (size_t)s->trends;
    double *sd = fw_arena_array(arena, double, trends),
           *trend = fw_arena_array(arena, double, trends * s->places);
    double *failed = fw_arena_array(arena, double, all->n);
    fw_chance_share *at = fw_arena_array(arena, fw_chance_share, s->places);
    FW_NEED(sd && trend && failed && at ? at : NULL);
    for (int i = 0, t = 0; i < s->groups; i++) {
        const fw_study_group *g = &s->group[i];
        if (!g->trend) continue;
        sd[t] = g->carrier < 0 ? 0 : s->joint.variable[g->carrier].distribution.sd;
        for (size_t q = 0; q < s->places; q++)
            trend[q * trends + (size_t)t] = trend_at(g->trend, &s->place[q].at, s->rim_m);
        t++;
    }
    for (size_t k = 0; k < all->n; k++)
        failed[k] = isnan(all->held[k]) ? (double)NAN : 1 - all->held[k];
    const fw_chance_map m = {.n = all->n,
                             .places = s->places,
                             .trends = trends,
                             .place = all->place,
                             .unit = all->unit,
                             .failed = failed,
                             .away = all->away,
                             .sd = sd,
                             .trend = trend};
    FW_TRY(fw_chance_map_of(arena, &m, all->study->asked->confidence, at));
    out->at = at;
    return FW_OK;
}

/* What is only known by an interval stands at its middle. A device that could not be judged is left out with its unit, and
   counted. Test: tests/cli/test_study.py, tests/unit/chance/test_nested.c */
fw_status fw_study_levels_run(fw_study *study, const fw_study_scatter *scatter, long devices,
                              long first, fw_study_judge *judge, void *context,
                              fw_study_levels *out) {
    bool hinges = has_hinges(scatter);
    simulated all = {.study = study,
                     .s = scatter,
                     .members = hinges ? FW_CHANCE_UNIT_MOST : FW_CHANCE_UNIT_PLAIN};
    *out = (fw_study_levels){.hinges = hinges, .scatter = scatter};
    all.units = (size_t)devices / (size_t)all.members;
    if (all.units < UNITS_LEAST) all.units = UNITS_LEAST;
    all.n = all.units * (size_t)all.members;
    FW_TRY(room_of(&all));
    FW_TRY(fw_chance_nested_order_new(study->arena, (uint64_t)study->asked->seed, scatter->places,
                                      &all.order));
    for (size_t k = 0; k < all.units; k += UNITS_AT_ONCE) {
        size_t now = all.units - k < UNITS_AT_ONCE ? all.units - k : UNITS_AT_ONCE;
        if (fw_cancel_requested(study->options.cancel)) return FW_CANCELLED;
        FW_TRY(judge_units(&all, k, now, first, judge, context));
    }
    for (size_t k = 0; k < all.n; k++) {
        all.held[k] = isnan(all.ln[k]) ? (double)NAN : all.ln[k] < 0 ? 1 : 0;
        out->not_judged += isnan(all.ln[k]) != 0;
    }
    out->devices = (long)all.n;
    double level = study->asked->confidence;
    if (fw_chance_nested_of(all.units, all.members, all.ln, level, &out->used) != FW_OK ||
        fw_chance_nested_of(all.units, all.members, all.held, level, &out->held) != FW_OK)
        return FW_OK; /* hardly a device could be judged: the yield says so */
    return scatter->trends > 0 && scatter->places > 0 ? map(&all, out) : FW_OK;
}
