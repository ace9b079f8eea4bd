/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands in packs, flows and steps, by its name; also where a text names it. And the reasons of a judgement, which all
   that judge a flow add to. */
#include "base/text.h"
#include "process/coupon.h"
#include "process/pack.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

fw_quantity *fw_process_flow_own_quantity(const fw_process_flow *flow, const char *id) {
    for (int i = flow->nquantity - 1; i >= 0; i--) /* the flow's own come after the shared ones */
        if (flow->quantity[i]->id && strcmp(flow->quantity[i]->id, id) == 0)
            return flow->quantity[i];
    return NULL;
}

const fw_quantity *fw_process_flow_quantity(const fw_process_flow *flow, const char *id) {
    return fw_process_flow_own_quantity(flow, id);
}

const fw_process_material *fw_process_flow_material(const fw_process_flow *flow, const char *id) {
    for (int i = flow->nprocess_material - 1; i >= 0; i--)
        if (strcmp(flow->process_material[i].id, id) == 0) return &flow->process_material[i];
    return NULL;
}

const fw_process_left_out *fw_process_flow_left_out(const fw_process_flow *flow, const char *id) {
    for (int i = 0; i < flow->nleft_out; i++)
        if (strcmp(flow->left_out[i].id, id) == 0) return &flow->left_out[i];
    return NULL;
}

const char *fw_process_flow_material_name(const fw_process_flow *flow, const char *id) {
    const fw_process_material *m = fw_process_flow_material(flow, id);
    return m ? m->name : id;
}

void fw_process_quantity_range(const fw_quantity *q, double *low, double *high) {
    *low = q->interval ? q->low : q->value - 2.0 * q->uncertainty;
    *high = q->interval ? q->high : q->value + 2.0 * q->uncertainty;
}

void fw_process_wear_range(const fw_process_wear *w, double *low, double *high) {
    *low = fmax(w->loss_m - 2.0 * w->uncertainty_m, 0.0);
    *high = fmax(w->loss_m + 2.0 * w->uncertainty_m, w->most_m);
}

bool fw_process_quantity_computed(const fw_quantity *q) {
    return strncmp(q->id, "mask.", 5) == 0 || (q->status == FW_DERIVED && q->unknown);
}

const fw_quantity *fw_process_step_argument(const fw_process_step *s, const char *name) {
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(s->argument[i].name, name) == 0) return s->argument[i].q;
    return NULL;
}

bool fw_process_corner_counts(const fw_process_corner *c) {
    return !c->within || c->within->unknown || c->within->status != FW_MEASURED;
}

bool fw_process_accept_is_due(const fw_process_accept *a, int wafer) {
    return wafer == 0 || (a->every < 99 && wafer % a->every == 0);
}

bool fw_process_step_is_of_lot(const fw_process_step *s) {
    enum { ONCE_PER_LOT = 99 }; /* batch of a pack */
    return s->batch >= ONCE_PER_LOT;
}

bool fw_process_step_is_of_dies(const fw_process_flow *flow, int index) {
    bool parted = false;
    for (int i = 0; i < index; i++)
        parted = parted || flow->step[i].parts;
    return parted;
}

int fw_process_step_load(const fw_process_step *s) {
    int capacity = s->equipment && s->equipment->capacity > 0 ? s->equipment->capacity : 1;
    int load = s->batch < capacity ? s->batch : capacity;
    return load < 1 ? 1 : load;
}

const fw_quantity *fw_process_law_input(const fw_process_law_use *use, const char *name) {
    for (int i = 0; i < use->nargument; i++)
        if (strcmp(use->argument[i].name, name) == 0)
            return use->argument[i].q->unknown ? NULL : use->argument[i].q;
    return NULL;
}

fw_status fw_process_step_derive(fw_arena *arena, fw_process_step *step, const char *name,
                                 double value, double uncertainty_si,
                                 fw_quantity_dimension dimension, const char *unit,
                                 fw_quantity_value_status status, const char *source) {
    fw_quantity *q = fw_arena_one(arena, fw_quantity);
    const fw_quantity **grown = fw_arena_grow(arena, step->derived, (size_t)step->nderived,
                                              (size_t)step->nderived + 1, sizeof *step->derived);
    FW_NEED(q && grown);
    /* what is computed is at best derived */
    status = fw_process_status_worse(status, FW_DERIVED);
    bool known = isfinite(value) && isfinite(uncertainty_si);
    *q = (fw_quantity){.id = name,
                       .unknown = !known,
                       .value = known ? value : 0.0,
                       .uncertainty = known ? fabs(uncertainty_si) : 0.0,
                       .dimension = dimension,
                       .unit = unit,
                       .status = status,
                       .u_status = status,
                       .source = source,
                       .place = step->place};
    grown[step->nderived++] = q;
    step->derived = grown;
    return FW_OK;
}

void fw_process_step_overrun(fw_process_step *s) {
    const fw_quantity *q = s->overrun_from;
    if (q) s->overrun = q->unknown ? 0.0 : q->value;
}

const fw_xml_attribute *fw_process_pack_get(const fw_xml_record *e, const char *name) {
    return fw_xml_cell_of(e, name)->given;
}

const char *fw_process_pack_text(const fw_xml_record *e, const char *name) {
    const fw_xml_attribute *a = fw_process_pack_get(e, name);
    return a ? a->value : "";
}

const char *fw_process_pack_where(const fw_xml_record *e) {
    const fw_xml_attribute *a = fw_process_pack_get(e, "where");
    return a ? a->value : "all";
}

const fw_quantity *fw_process_pack_quantity(fw_process_pack *pack, const fw_xml_record *e,
                                            const char *name) {
    const fw_xml_attribute *a = fw_process_pack_get(e, name);
    return a ? fw_process_pack_find(pack, a, FW_ID_QUANTITY) : NULL;
}

double fw_process_pack_number(const fw_xml_record *e, const char *name, double absent) {
    const fw_xml_cell *cell = fw_xml_cell_of(e, name);
    return cell->ok ? cell->number : absent;
}

/* the flow's own one wins over the shared one */
static const fw_process_id *find(const fw_process_pack *pack, const char *id) {
    int low = 0, high = pack->nid;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (strcmp(pack->id[middle].id, id) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < pack->nid && strcmp(pack->id[low].id, id) == 0 ? &pack->id[low] : NULL;
}

static const char *nearest(const fw_process_pack *pack, const char *wrong,
                           fw_process_id_kind kind) {
    const char *best = NULL;
    int least = 3;
    for (int i = 0; i < pack->nid; i++) {
        int d = pack->id[i].kind == kind ? fw_edit_distance(wrong, pack->id[i].id, 2) : 3;
        if (d < least) {
            least = d;
            best = pack->id[i].id;
        }
    }
    return best;
}

void *fw_process_pack_find(fw_process_pack *pack, const fw_xml_attribute *attribute,
                           fw_process_id_kind kind) {
    static const char *const word[] = {"source",   "material", "equipment",  "hazard",
                                       "quantity", "step",     "consumable", "bath"};
    const fw_process_id *found = find(pack, attribute->value);
    if (found && found->kind == kind) return found->item;
    const char *best = nearest(pack, attribute->value, kind);
    fw_diag_error(pack->diags, 165, attribute->place, "%s='%s': there is no %s with this id%s%s%s",
                  attribute->name, attribute->value, word[kind], FW_DID_YOU_MEAN(best));
    return NULL;
}

/* ---- numbers in the texts of a pack ----
   A text that would repeat a value names it instead:
     {rie.break}       value and unit of the quantity, "10 min"; of a share its per cent
     {rie.break:s}     in that unit, "600 s"
     {=seed.Rs}        the number alone, for a limit whose unit stands beside it
     {=si.d*0.96}      and so many times it, for a limit that goes with the value
   What is not known is "____". So a value that changes, changes everywhere. Test: test_step_texts.c. */

static fw_status keep(fw_process_pack *pack, const char **slot, fw_place place) {
    fw_process_flow *f = pack->flow;
    if (!*slot || !strchr(*slot, '{')) return FW_OK;
    fw_process_text *grown =
        fw_arena_grow(pack->arena, f->text, (size_t)f->ntext, (size_t)f->ntext + 1, sizeof *grown);
    FW_NEED(grown);
    f->text = grown;
    f->text[f->ntext++] = (fw_process_text){slot, *slot, place};
    return FW_OK;
}

static fw_status keep_step(fw_process_pack *pack, fw_process_step *s) {
    FW_TRY(keep(pack, &s->title, s->place));
    FW_TRY(keep(pack, &s->purpose, s->place));
    for (int i = 0; i < s->nendpoint; i++)
        FW_TRY(keep(pack, &s->endpoint[i], s->place));
    for (int i = 0; i < s->nderive; i++)
        FW_TRY(keep(pack, &s->derive[i].name, s->place));
    for (int i = 0; i < s->nfinish; i++)
        FW_TRY(keep(pack, &s->finish[i].text, s->finish[i].place));
    for (int i = 0; i < s->nsetting; i++) {
        FW_TRY(keep(pack, &s->setting[i].name, s->setting[i].place));
        FW_TRY(keep(pack, &s->setting[i].tolerance_low, s->setting[i].place));
        FW_TRY(keep(pack, &s->setting[i].tolerance_high, s->setting[i].place));
    }
    for (int i = 0; i < s->naccept; i++) {
        FW_TRY(keep(pack, &s->accept[i].measure, s->accept[i].place));
        FW_TRY(keep(pack, &s->accept[i].low, s->accept[i].place));
        FW_TRY(keep(pack, &s->accept[i].high, s->accept[i].place));
        FW_TRY(keep(pack, &s->accept[i].planned, s->accept[i].place));
    }
    for (int i = 0; i < s->non_fail; i++) {
        FW_TRY(keep(pack, &s->on_fail[i].condition, s->place));
        FW_TRY(keep(pack, &s->on_fail[i].text, s->place));
    }
    return FW_OK;
}

fw_status fw_process_pack_texts(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        FW_TRY(keep_step(pack, &pack->flow->step[i]));
    for (int i = 0; i < pack->flow->nleft_out; i++)
        FW_TRY(keep(pack, &pack->flow->left_out[i].title, pack->flow->place));
    for (int i = 0; i < pack->flow->nequipment; i++)
        FW_TRY(keep(pack, &pack->flow->equipment[i].text, pack->flow->equipment[i].place));
    for (int i = 0; i < pack->flow->nopen_point; i++)
        FW_TRY(keep(pack, &pack->flow->open_point[i], pack->flow->place));
    return fw_process_flow_fill_texts(pack->arena, pack->flow, pack->diags);
}

/* what stands between braces, n characters; false: not to be understood */
static bool put(fw_text *out, const fw_process_flow *f, const char *inside, size_t n) {
    bool bare = n > 0 && inside[0] == '=';
    const char *colon = memchr(inside, ':', n), *end = inside + n;
    const char *from = inside + bare, *to = colon ? colon : end;
    char id[128];
    fw_quantity_unit unit;
    if (to <= from || (size_t)(to - from) >= sizeof id) return false;
    const char *star = memchr(from, '*', (size_t)(to - from));
    double times = 1.0;
    if (star && !fw_number_parse(star + 1, (size_t)(to - star - 1), &times)) return false;
    if (star) to = star;
    memcpy(id, from, (size_t)(to - from));
    id[to - from] = '\0';
    const fw_quantity *q = fw_process_flow_quantity(f, id);
    const char *as = q ? q->unit : "";
    size_t as_n = strlen(as);
    bool share = q && q->range && strcmp(q->range, "share") == 0 && strcmp(as, "1") == 0;
    if (colon) {
        as = colon + 1;
        as_n = (size_t)(end - as);
    } else if (share && !bare) {
        as = "%";
        as_n = 1;
    }
    if (!q || !fw_quantity_unit_parse(as, as_n, &unit, NULL, NULL) ||
        !fw_quantity_dimension_equal(unit.dimension, q->dimension))
        return false;
    if (q->unknown)
        fw_text_add(out, "____");
    else
        fw_text_number(out, fw_quantity_unit_from_si(&unit, times * q->value), 4);
    if (bare || (as_n == 1 && as[0] == '1')) return true;
    fw_text_add(out, " ");
    fw_text_bytes(out, as, as_n);
    return true;
}

static fw_status fill(fw_arena *arena, const fw_process_flow *f, fw_process_text *t,
                      fw_diags *diags) {
    fw_text out = fw_text_new(arena);
    fw_text_add(&out, "");
    for (const char *c = t->raw; *c;) {
        const char *open = strchr(c, '{'), *close = open ? strchr(open, '}') : NULL;
        if (!open) {
            fw_text_add(&out, c);
            break;
        }
        fw_text_bytes(&out, c, (size_t)(open - c));
        if (!close || !put(&out, f, open + 1, (size_t)(close - open - 1)))
            return fw_diag_error(diags, 348, t->place,
                                 "'%.60s' in a text names no quantity, or a unit of another "
                                 "dimension; write {id}, {id:unit} or {=id}",
                                 open);
        c = close + 1;
    }
    FW_TRY(fw_text_end(&out));
    *t->slot = out.data;
    return FW_OK;
}

fw_status fw_process_flow_fill_texts(fw_arena *arena, fw_process_flow *flow, fw_diags *diags) {
    for (int i = 0; i < flow->ntext; i++) {
        fw_status status = fill(arena, flow, &flow->text[i], diags);
        if (status != FW_OK && status != FW_INPUT) return status;
    }
    return FW_OK;
}

/* ---- reasons of a judgement, and numbers in their sentences ---- */

const char *fw_process_judge_number(fw_process_numbers *list, double value, int digits) {
    char *text = list->text[list->n++ % 8];
    return fw_number_text(text, sizeof list->text[0], value, digits);
}

const char *fw_process_judge_um(fw_process_numbers *list, double value_m) {
    return fw_process_judge_number(list, value_m * 1e6, 4);
}

double fw_process_judge_known(const fw_quantity *q) {
    return q && !q->unknown ? q->value : (double)NAN;
}

static fw_status append(fw_arena *arena, fw_process_flow *f, const char *why) {
    const char **grown =
        fw_arena_grow(arena, f->reason, (size_t)f->nreason, (size_t)f->nreason + 1, sizeof *grown);
    FW_NEED(why && grown);
    f->reason = grown;
    f->reason[f->nreason++] = why;
    return FW_OK;
}

void fw_process_judge_to_front(fw_process_flow *f, int from) {
    for (int i = from; i < f->nreason; i++) {
        const char *why = f->reason[i];
        memmove(f->reason + i - from + 1, f->reason + i - from, (size_t)from * sizeof *f->reason);
        f->reason[i - from] = why;
    }
}

fw_status fw_process_flow_add_reason(fw_arena *arena, fw_process_flow *flow, int manufacturable,
                                     const char *why) {
    FW_TRY(append(arena, flow, why));
    if (manufacturable == 0) flow->fails = why;
    if (manufacturable == 0) fw_process_judge_to_front(flow, flow->nreason - 1);
    if (manufacturable == 0 || flow->manufacturable != 0) flow->manufacturable = manufacturable;
    return FW_OK;
}

void fw_process_flow_lead(fw_process_flow *flow, int from) {
    if (from >= flow->nreason || flow->manufacturable == 0) return;
    fw_process_judge_to_front(flow, from);
    if (!flow->fails) flow->fails = flow->reason[0];
}

static fw_process_answer worse(fw_process_answer a, fw_process_answer b) {
    if (a == FW_ANSWER_NO || b == FW_ANSWER_NO) return FW_ANSWER_NO;
    return a == FW_ANSWER_OPEN || b == FW_ANSWER_OPEN ? FW_ANSWER_OPEN : FW_ANSWER_FINE;
}

fw_status fw_process_judge_reason(fw_process_judge *j, fw_process_answer weight, const char *format,
                                  ...) {
    char text[1200];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length >= (int)sizeof text) { /* cut a very long list, never inside a character */
        size_t end = sizeof text - 4;
        while (end > 0 && ((unsigned char)text[end] & 0xC0) == 0x80)
            end--;
        memcpy(text + end, "...", 4);
    }
    FW_TRY(append(j->arena, j->flow, fw_arena_strdup(j->arena, text)));
    if (weight == FW_ANSWER_NO && j->verdict != FW_ANSWER_NO)
        j->flow->fails = j->flow->reason[j->flow->nreason - 1];
    j->verdict = worse(j->verdict, weight);
    return FW_OK;
}

/* what is known of openings that are wide enough: in the last pass of fw_process_flow_compute, which the reasons are of */
fw_status fw_process_judge_openings(const fw_process_judge *j, const char **text) {
    const fw_process_flow *f = j->flow;
    fw_process_numbers t = {0};
    const char *fails = f->nearest_known ? f->nearest_fails : NULL;
    *text = NULL;
    if (f->nearest_known && !isnan(f->nearest_gap_m))
        FW_NEED(*text = fw_arena_printf(
                    j->arena, "openings at least %s um wide%s",
                    fw_process_judge_um(&t, f->nearest_gap_m),
                    f->nearest_undrawn ? " (they are between outlines, and were not drawn anew)"
                                       : ""));
    else if (f->nearest_known && f->nearest_refused)
        FW_NEED(*text = fw_arena_printf(j->arena, "no width of the openings alone is enough%s%s%s",
                                        fails ? " (" : "", fails ? fails : "", fails ? ")" : ""));
    return FW_OK;
}

/* what was judged with the whole flow (flow.c), in words */
fw_status fw_process_judge_nearest(const fw_process_judge *j, const char **text) {
    const fw_process_flow *f = j->flow;
    const bool gap = f->nearest_known && !isnan(f->nearest_gap_m),
               steep = f->nearest_known && !isnan(f->nearest_anisotropy);
    fw_process_numbers t = {0};
    fw_text list = fw_text_new(j->arena);
    const char *openings;
    FW_TRY(fw_process_judge_openings(j, &openings));
    if (!openings) openings = "no width of the openings alone is enough";
    if (gap || !steep) fw_text_add(&list, openings);
    if (steep)
        fw_text_printf(&list, "%san etch with an anisotropy of at least %s", gap ? ", or " : "",
                       fw_process_judge_number(&t, f->nearest_anisotropy, 5));
    if (!gap && !steep) fw_text_add(&list, "; a thinner layer or another etch");
    FW_TRY(fw_text_end(&list));
    *text = list.data;
    return FW_OK;
}

/* ---- what a step takes along ---- */

/* Relative uncertainty of what is lost at a rate r in a time T of the step's own rate R. The step lasts as planned, or until
   somebody sees its end: where r is R the planned time takes by r, with the error of r, and a time that ends with the film
   takes what the film was, with the error of everything else in T. One of both is so: the larger counts. Of another rate
   both are off. u relative, 1. Source: docs/theory/process.md, "What a step takes along". Test: test_wear.c. */
double fw_process_lost_uncertainty(bool own, double u_rate, double u_time) {
    const double rest = sqrt(fmax(0.0, u_time * u_time - u_rate * u_rate));
    return own ? fmax(u_rate, rest) : hypot(u_rate, u_time);
}

/* the farthest that the step etches: down, or sideways below what stands (solved_m where the pack leaves that to the mask) */
double fw_process_step_depth(const fw_process_step *s, double solved_m) {
    double deepest = (double)NAN;
    for (int i = 0; i < s->nchange; i++) {
        const fw_process_change *c = &s->change[i];
        const fw_quantity *d = c->reach ? c->reach : c->thickness;
        const double far =
            c->reach && c->reach->status == FW_DERIVED ? solved_m : fw_process_judge_known(d);
        if (strcmp(c->kind, "remove") == 0 && !isnan(far))
            deepest = fmax(isnan(deepest) ? 0.0 : deepest, far);
    }
    return deepest;
}

/* d (1 + overrun) of that, as often as the time is longer than that of wide openings: R T, how deep a wide opening would be
   etched. m; NaN: not known */
static double wide_depth(const fw_process_step *s) {
    const double slowed = s->time.computable ? s->time.slowed : 1.0;
    double solved = (double)NAN;
    for (int i = 0; i < s->nchange; i++)
        if (s->change[i].reach) solved = fw_process_judge_known(s->change[i].reach);
    return fw_process_step_depth(s, solved) * slowed * (1.0 + s->overrun);
}

/* Loss of an exposed material in a step, nominal and at two standard uncertainties:
     by rate r:            l = r T (1 + overrun),           u/l of fw_process_lost_uncertainty
     by selectivity S:     l = d (T/T_wide)(1 + overrun)/S, u/l = u_S/S
   r m/s, T the step's nominal time, T_wide that of openings that do not lag, s; d m the depth that the step removes; l m.
   What lies below that depth is bare for 1 - 1/((T/T_wide)(1 + overrun)) of all that time, and T_wide, too, may be 2 u_T
   shorter. NaN when an input is not known. Source: docs/theory/process.md, What a step takes along. Test: test_lint.c, loss,
   mask_lasts_as_planned, bare_once_it_is_through. */
double fw_process_exposed_loss(const fw_process_step *s, const fw_process_exposed *x,
                               double *most_m) {
    double loss = (double)NAN, share = 0.0;
    if (x->rate && !x->rate->unknown && s->time.computable) {
        loss = x->rate->value * s->time.nominal_s * (1.0 + s->overrun);
        share = fw_process_lost_uncertainty(x->rate == fw_process_step_argument(s, "rate"),
                                            x->rate->uncertainty / x->rate->value,
                                            s->time.relative_uncertainty);
    } else if (x->selectivity && !x->selectivity->unknown) {
        loss = wide_depth(s) / x->selectivity->value;
        share = x->selectivity->uncertainty / x->selectivity->value;
    }
    *most_m = share < 0.5 ? loss / (1.0 - 2.0 * share) : (double)INFINITY;
    if (!x->uncovered || !s->time.computable) return loss;
    const double through = 1.0 / (s->time.slowed * (1.0 + s->overrun)),
                 sooner = fmax(0.0, 1.0 - 2.0 * s->time.relative_uncertainty);
    *most_m *= 1.0 - through * sooner;
    return loss * (1.0 - through);
}

bool fw_process_step_is_op(const fw_process_step *s, const char *op) {
    return strcmp(s->op, op) == 0;
}

bool fw_process_step_on_back(const fw_process_step *s) {
    bool back = s->align.to && s->align.back;
    for (int k = 0; k < s->nchange; k++)
        back = back || (strcmp(s->change[k].kind, "pattern") == 0 && s->change[k].back);
    return back;
}

const fw_process_hazard *fw_process_step_liquid(const fw_process_step *s) {
    for (int i = s->nhazard - 1; i >= 0; i--)
        if (s->hazard[i]->wets) return s->hazard[i];
    return NULL;
}

/* operations that are always done in a liquid, whatever the pack says of its chemicals */
static bool always_in_liquid(const fw_process_step *s) {
    static const char *const op[] = {"anodise", "displace", "develop", "plate", "wet-etch"};
    for (size_t i = 0; i < sizeof op / sizeof *op; i++)
        if (fw_process_step_is_op(s, op[i])) return true;
    return false;
}

bool fw_process_step_in_liquid(const fw_process_step *s) {
    static const char *const may[] = {"clean", "strip", "release"};
    if (always_in_liquid(s)) return true;
    for (size_t i = 0; i < sizeof may / sizeof *may; i++)
        if (fw_process_step_is_op(s, may[i])) return fw_process_step_liquid(s) != NULL;
    return false;
}

/* ---- the steps that coupons are of ---- */

/* how thick the material was when it was put there last, before the step */
static const fw_quantity *put_there(const fw_process_flow *flow, int before, const char *material) {
    for (int i = before - 1; i >= 0; i--)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (strcmp(c->kind, "add") == 0 && strcmp(c->material, material) == 0)
                return c->thickness;
        }
    return NULL;
}

fw_process_etch fw_process_flow_etch(const fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->nchange; k++) {
            const fw_process_change *c = &s->change[k];
            if (!c->anisotropy || strcmp(c->kind, "remove") != 0 || !flow->material ||
                strcmp(c->material, flow->material) != 0)
                continue;
            fw_process_etch e = {.rate = fw_process_step_argument(s, "rate"),
                                 .lag = fw_process_step_argument(s, "probability"),
                                 .anisotropy = c->anisotropy,
                                 .over_etch = s->overrun_from};
            for (int x = 0; x < s->nexposed && !e.selectivity; x++) {
                e.selectivity = s->exposed[x].selectivity;
                if (e.selectivity) e.mask = put_there(flow, i, s->exposed[x].material);
            }
            return e;
        }
    }
    return (fw_process_etch){0};
}

/* what comes of the thickness that is planned, by the corner of the device layer; NULL: no quantity says it */
static const char *made_thickness(const fw_process_flow *flow) {
    for (int i = 0; i < flow->ncorner; i++)
        if (flow->corner[i].of == FW_CORNER_THICKNESS && flow->corner[i].q)
            return flow->corner[i].q->id;
    return NULL;
}

fw_process_plating fw_process_flow_plating(const fw_process_flow *flow, const char *efficiency) {
    fw_process_plating best = {0};
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        const fw_quantity *eta = fw_process_step_argument(s, "efficiency");
        if (!s->law || strcmp(s->law, "faraday") != 0 || !eta || !eta->id ||
            !fw_process_step_is_op(s, "plate"))
            continue;
        fw_process_plating is = {.thickness = fw_process_step_argument(s, "thickness"),
                                 .density = fw_process_step_argument(s, "density"),
                                 .valence = fw_process_step_argument(s, "valence"),
                                 .molar_mass = fw_process_step_argument(s, "molar_mass"),
                                 .efficiency = eta};
        for (int k = 0; k < s->nchange; k++)
            if (strcmp(s->change[k].kind, "add") == 0) is.material = s->change[k].material;
        const bool device =
            is.material && flow->material && strcmp(is.material, flow->material) == 0;
        if (device) is.made = made_thickness(flow);
        if (strcmp(eta->id, efficiency) == 0) return is;
        if (!best.efficiency || (device && !best.made)) best = is;
    }
    return best;
}
