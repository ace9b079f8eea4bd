/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"
#include "process/pack.h"
#include "quantity/quantity.h"
#include <math.h>
#include <string.h>

static fw_status dimension_error(fw_process_pack *pack, const fw_xml_record *e, const char *what,
                                 fw_quantity_dimension got, fw_quantity_dimension wanted) {
    const fw_xml_attribute *a = fw_process_pack_get(e, "q");
    const char *is = fw_quantity_dimension_text(pack->arena, got),
               *want = fw_quantity_dimension_text(pack->arena, wanted);
    FW_NEED(is && want);
    fw_diag_error(pack->diags, 169, a->place, "argument '%s' takes %s, but '%s' is %s", what, want,
                  a->value, is);
    return FW_OK;
}

/* <arg> and <needs> children of <time> or <derive> */
static fw_status read_arguments(fw_process_pack *pack, const fw_xml_record *e, const char *child,
                                fw_process_argument **list, int *n) {
    size_t most = (size_t)fw_xml_children(e, child);
    FW_NEED(*list = fw_arena_array(pack->arena, fw_process_argument, most));
    for (const fw_xml_record *c = e->first_child; c; c = c->next) {
        if (!fw_xml_is(c, child)) continue;
        const fw_quantity *q = fw_process_pack_quantity(pack, c, "q");
        const char *name = fw_process_pack_text(c, "name");
        for (int i = 0; i < *n; i++)
            if (strcmp((*list)[i].name, name) == 0)
                fw_diag_error(pack->diags, 164, c->element->place, "argument '%s' is given twice",
                              name);
        if (q) (*list)[(*n)++] = (fw_process_argument){name, q};
    }
    if (*n > FW_LAW_ARGUMENTS) {
        fw_diag_error(pack->diags, 171, e->element->place, "a law takes at most %d arguments",
                      FW_LAW_ARGUMENTS);
        *n = FW_LAW_ARGUMENTS;
    }
    return FW_OK;
}

static bool names_argument(const fw_xml_record *e, const char *argument) {
    for (const fw_xml_record *c = e->first_child; c; c = c->next)
        if (fw_xml_is(c, "arg") && strcmp(fw_process_pack_text(c, "name"), argument) == 0)
            return true;
    return false;
}

/* What a law corrects by belongs together: with one of it left out, nothing would be corrected and nothing said. What nobody
   knows is named as that. */
static void check_correction(fw_process_pack *pack, const fw_xml_record *e,
                             const fw_process_law *law) {
    const char *has = NULL, *lacks = NULL;
    for (int i = 0; i < law->nargument; i++) {
        const char *name = law->argument[i].name;
        if (law->argument[i].need == FW_LAW_WHEN_KNOWN)
            *(names_argument(e, name) ? &has : &lacks) = name;
    }
    if (has && lacks)
        fw_diag_error(
            pack->diags, 678, e->element->place,
            "law '%s' is given '%s' and not '%s', without which it corrects nothing: name "
            "that as well (unknown=\"true\" where nobody knows it), or leave both out",
            law->name, has, lacks);
}

static fw_status check_arguments(fw_process_pack *pack, const fw_xml_record *e,
                                 const fw_process_law *law) {
    for (const fw_xml_record *c = e->first_child; c; c = c->next) {
        const fw_xml_attribute *name = fw_process_pack_get(c, "name"),
                               *q = fw_process_pack_get(c, "q");
        if (!fw_xml_is(c, "arg") || !name || !q) continue;
        int at = fw_process_law_argument_index(law, name->value);
        if (at < 0) {
            const char *names[FW_LAW_ARGUMENTS];
            for (int i = 0; i < law->nargument; i++)
                names[i] = law->argument[i].name;
            const char *best = fw_did_you_mean(name->value, names, (size_t)law->nargument);
            fw_diag_error(pack->diags, 167, name->place, "law '%s' has no argument '%s'%s%s%s",
                          law->name, name->value, FW_DID_YOU_MEAN(best));
            continue;
        }
        const fw_quantity *value = fw_process_pack_quantity(pack, c, "q");
        if (value && !law->argument[at].any_dimension &&
            !fw_quantity_dimension_equal(value->dimension, law->argument[at].dimension))
            FW_TRY(dimension_error(pack, c, name->value, value->dimension,
                                   law->argument[at].dimension));
    }
    for (int i = 0; i < law->nargument; i++) {
        if (law->argument[i].need == FW_LAW_REQUIRED && !names_argument(e, law->argument[i].name))
            fw_diag_error(pack->diags, 168, e->element->place, "law '%s' needs the argument '%s'",
                          law->name, law->argument[i].name);
    }
    check_correction(pack, e, law);
    return FW_OK;
}

/* tries the expression once; unknown inputs stand in as different numbers near 1 */
static fw_status check_expression(fw_process_pack *pack, const fw_xml_record *e, const char *text,
                                  fw_place place, const fw_process_argument *argument, int n,
                                  fw_quantity_dimension wanted) {
    fw_quantity_name_value item[FW_LAW_ARGUMENTS];
    for (int i = 0; i < n; i++) {
        const fw_quantity *q = argument[i].q;
        item[i] = (fw_quantity_name_value){argument[i].name, q->unknown ? 1.0 + 0.01 * i : q->value,
                                           q->dimension};
    }
    fw_quantity_names names = {item, (size_t)n};
    fw_quantity_expression_error error = {0};
    double value = 0.0;
    fw_status status = fw_quantity_expression_evaluate(pack->arena, text, strlen(text), &names,
                                                       wanted, &value, &error);
    if (status != FW_INPUT) return status;
    if (!strchr(text, '\n')) place.column += (int)error.offset;
    fw_diag_error(pack->diags, 170, place, "<%s>: %s", e->row->name,
                  error.message ? error.message : "the expression has no value");
    return FW_OK;
}

static fw_status read_expression(fw_process_pack *pack, const fw_xml_record *e,
                                 const fw_process_law *law, const fw_process_argument *argument,
                                 int n, fw_quantity_dimension wanted, const char **expression) {
    *expression = "";
    const fw_xml_record *found = NULL;
    for (const fw_xml_record *c = e->first_child; c; c = c->next)
        if (fw_xml_is(c, "expr")) found = c;
    if ((law && !law->argument) != (found != NULL)) {
        fw_diag_error(pack->diags, 170, e->element->place,
                      found ? "<expr> belongs to law='expr' only" : "law='expr' needs an <expr>");
        return FW_OK;
    }
    if (!found) return FW_OK;
    *expression = found->element->text;
    return check_expression(pack, e, found->element->text, found->element->text_place, argument, n,
                            wanted);
}

static const fw_process_law *law_of(fw_process_pack *pack, const fw_xml_record *e) {
    const fw_xml_attribute *a = fw_process_pack_get(e, "law");
    const fw_process_law *law = a ? fw_process_law_find(a->value) : NULL;
    if (!a || law) return law;
    const char *names[32];
    size_t n = 0;
    for (int i = 0; n < 32 && fw_process_law_row(i); i++)
        names[n++] = fw_process_law_row(i)->name;
    const char *best = fw_did_you_mean(a->value, names, n);
    fw_diag_error(pack->diags, 166, a->place, "there is no law '%s'%s%s%s", a->value,
                  FW_DID_YOU_MEAN(best));
    return NULL;
}

/* a number, or a quantity of its own so that it is written once */
static void read_overrun(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *s) {
    const fw_xml_attribute *a = fw_process_pack_get(e, "overrun");
    double value;
    if (!a) return;
    if (fw_number_parse(a->value, strlen(a->value), &value)) {
        s->overrun = value;
        if (!(value >= 0.0 && value <= 3.0)) /* a range: docs/theory/process.md */
            fw_diag_error(pack->diags, 171, a->place,
                          "overrun=\"%s\" is not between 0 and 3: it is a share of the time, and "
                          "what lasts four times as long as it takes has another time",
                          a->value);
        return;
    }
    s->overrun_from = fw_process_pack_find(pack, a, FW_ID_QUANTITY);
    if (s->overrun_from &&
        !fw_quantity_dimension_equal(s->overrun_from->dimension, (fw_quantity_dimension){0}))
        fw_diag_error(pack->diags, 169, a->place, "'%s' is no share; give it the unit 1 or %%",
                      a->value);
    fw_process_step_overrun(s);
}

static fw_status read_time(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *s) {
    const fw_process_law *law = law_of(pack, e);
    const fw_xml_attribute *id = fw_process_pack_get(e, "id");
    read_overrun(pack, e, s);
    if (id) s->planned = fw_process_pack_find(pack, id, FW_ID_QUANTITY);
    s->k = fw_process_pack_number(e, "k", 2.0);
    s->shape = fw_process_pack_text(e, "shape");
    s->pulse = fw_process_pack_quantity(pack, e, "pulse");
    s->pause = fw_process_pack_quantity(pack, e, "pause");
    if ((s->pulse != NULL) != (s->pause != NULL))
        fw_diag_error(pack->diags, 162, e->element->place,
                      "parts and pauses belong together: give pulse and pause, or neither");
    const fw_quantity *part[] = {s->pulse, s->pause};
    for (int i = 0; i < 2; i++)
        if (part[i] &&
            !fw_quantity_dimension_equal(part[i]->dimension, (fw_quantity_dimension)FW_DIM_TIME))
            fw_diag_error(pack->diags, 169, e->element->place, "'%s' is not a time", part[i]->id);
    FW_TRY(read_arguments(pack, e, "arg", &s->argument, &s->nargument));
    FW_TRY(read_arguments(pack, e, "needs", &s->need, &s->nneed));
    if (!law) return FW_OK;
    s->law = law->name;
    if (law->argument) FW_TRY(check_arguments(pack, e, law));
    return read_expression(pack, e, law, s->argument, s->nargument,
                           (fw_quantity_dimension)FW_DIM_TIME, &s->expression);
}

static fw_status read_derive(fw_process_pack *pack, const fw_xml_record *e, fw_process_derive *d) {
    const fw_process_law *law = law_of(pack, e);
    const fw_xml_attribute *unit = fw_process_pack_get(e, "unit"),
                           *id = fw_process_pack_get(e, "id");
    d->name = fw_process_pack_text(e, "name");
    d->unit = fw_process_pack_text(e, "unit");
    d->shape = fw_process_pack_text(e, "shape");
    fw_quantity_unit parsed = {0};
    if (unit && !fw_quantity_unit_parse(unit->value, strlen(unit->value), &parsed, NULL, NULL))
        fw_diag_error(pack->diags, 169, unit->place, "'%s' is not a unit", unit->value);
    d->dimension = parsed.dimension;
    if (id) d->q = fw_process_pack_find(pack, id, FW_ID_QUANTITY);
    d->most = fw_process_pack_quantity(pack, e, "most");
    if (d->most && !fw_quantity_dimension_equal(d->most->dimension, d->dimension))
        fw_diag_error(pack->diags, 169, e->element->place,
                      "most='%s' cannot be the limit of a value in '%s'; name a quantity of the "
                      "same dimension",
                      d->most->id, d->unit);
    FW_TRY(read_arguments(pack, e, "arg", &d->argument, &d->nargument));
    if (!law) return FW_OK;
    d->law = law->name;
    if (law->argument) {
        FW_TRY(check_arguments(pack, e, law));
        if (!fw_quantity_dimension_equal(d->dimension, (fw_quantity_dimension)FW_DIM_TIME))
            fw_diag_error(
                pack->diags, 169, e->element->place,
                "law '%s' gives a time, and unit='%s' is no unit of time; write s, min or h",
                law->name, d->unit);
    }
    return read_expression(pack, e, law, d->argument, d->nargument, d->dimension, &d->expression);
}

static fw_process_face face_of(const char *word) {
    return strcmp(word, "top") == 0      ? FW_FACE_TOP
           : strcmp(word, "bottom") == 0 ? FW_FACE_BOTTOM
                                         : FW_FACE_MIDDLE;
}

static void want_length(fw_process_pack *pack, const fw_xml_record *e, const fw_quantity *q,
                        const char *what, const char *units) {
    if (q && !fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_LENGTH))
        fw_diag_error(pack->diags, 169, e->element->place,
                      "%s <change> is not a length; write it in %s", what, units);
}

static void read_change(fw_process_pack *pack, const fw_xml_record *e, fw_process_change *c) {
    const fw_xml_attribute *material = fw_process_pack_get(e, "material"),
                           *from = fw_process_pack_get(e, "from");
    *c = (fw_process_change){.kind = fw_process_pack_text(e, "kind"),
                             .material = fw_process_pack_text(e, "material"),
                             .thickness = fw_process_pack_quantity(pack, e, "thickness"),
                             .where = fw_process_pack_where(e),
                             .spans = strcmp(fw_process_pack_text(e, "spans"), "yes") == 0,
                             .from = fw_process_pack_text(e, "from"),
                             .back = strcmp(fw_process_pack_text(e, "side"), "back") == 0,
                             .isotropic =
                                 strcmp(fw_process_pack_text(e, "profile"), "isotropic") == 0,
                             .anisotropy = fw_process_pack_quantity(pack, e, "anisotropy"),
                             .spread = fw_process_pack_quantity(pack, e, "spread"),
                             .across = fw_process_pack_quantity(pack, e, "across"),
                             .reach = fw_process_pack_quantity(pack, e, "reach"),
                             .compensate = face_of(fw_process_pack_text(e, "compensate")),
                             .place = e->element->place};
    if (material) fw_process_pack_find(pack, material, FW_ID_MATERIAL);
    if (from)
        fw_process_pack_find(pack, from, FW_ID_MATERIAL);
    else if (strcmp(c->kind, "convert") == 0)
        fw_diag_error(pack->diags, 162, e->element->place, "<change kind='convert'> needs 'from'");
    want_length(pack, e, c->thickness, "the thickness of", "um or nm");
    want_length(pack, e, c->reach, "the reach of", "um or nm");
    want_length(pack, e, c->across, "across of", "mm");
    if (c->reach && strcmp(c->kind, "remove") != 0)
        fw_diag_error(pack->diags, 161, e->element->place,
                      "reach is how far a removal goes sideways: it belongs to kind='remove' only");
    if (c->isotropic && !c->thickness)
        fw_diag_error(pack->diags, 162, e->element->place, "profile='isotropic' needs a thickness");
}

static void read_exposed(fw_process_pack *pack, const fw_xml_record *e, fw_process_exposed *x) {
    const fw_xml_attribute *material = fw_process_pack_get(e, "material");
    *x = (fw_process_exposed){.material = fw_process_pack_text(e, "material"),
                              .rate = fw_process_pack_quantity(pack, e, "rate"),
                              .selectivity = fw_process_pack_quantity(pack, e, "selectivity"),
                              .place = e->element->place};
    if (material) fw_process_pack_find(pack, material, FW_ID_MATERIAL);
    if (!fw_process_pack_get(e, "rate") == !fw_process_pack_get(e, "selectivity"))
        fw_diag_error(
            pack->diags, 162, e->element->place,
            "<exposed> needs either 'rate' or 'selectivity'; the quantity may be unknown");
    if (x->rate &&
        !fw_quantity_dimension_equal(x->rate->dimension, (fw_quantity_dimension){.m = 1, .s = -1}))
        fw_diag_error(
            pack->diags, 169, e->element->place,
            "the rate of <exposed> is not a length per time; write it in nm/min or um/min");
    if (x->selectivity &&
        !fw_quantity_dimension_equal(x->selectivity->dimension, (fw_quantity_dimension){0}))
        fw_diag_error(pack->diags, 169, e->element->place,
                      "the selectivity of <exposed> is a ratio of two rates and has no unit");
}

/* false: it counts from a step that this device does not need */
static bool read_lag(fw_process_pack *pack, const fw_xml_record *e, fw_process_lag *lag) {
    const fw_xml_attribute *unit = fw_process_pack_get(e, "unit"),
                           *from = fw_process_pack_get(e, "from");
    fw_quantity_unit parsed = {.factor = 1.0};
    if (unit &&
        (!fw_quantity_unit_parse(unit->value, strlen(unit->value), &parsed, NULL, NULL) ||
         !fw_quantity_dimension_equal(parsed.dimension, (fw_quantity_dimension)FW_DIM_TIME)))
        fw_diag_error(pack->diags, 169, unit->place, "'%s' is not a unit of time", unit->value);
    if (from && fw_process_flow_left_out(pack->flow, from->value)) return false;
    lag->from = from ? from->value : "";
    lag->place = e->element->place;
    lag->min_s = fw_process_pack_number(e, "min", (double)NAN) * parsed.factor;
    lag->max_s = fw_process_pack_number(e, "max", (double)NAN) * parsed.factor;
    if (from) fw_process_pack_find(pack, from, FW_ID_STEP);
    if (lag->min_s > lag->max_s)
        fw_diag_error(pack->diags, 171, e->element->place,
                      "<lag>: min is longer than max; exchange them, or make max longer");
    return true;
}

/* the words of `finishes` in process_table.c */
static bool finish_kind(const char *word, fw_process_finish_kind *kind) {
    static const char *const words[] = {[FW_FINISH_RINSE] = "rinse",
                                        [FW_FINISH_DRY] = "dry",
                                        [FW_FINISH_COOL] = "cool",
                                        [FW_FINISH_VENT] = "vent"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i], word) == 0) {
            *kind = (fw_process_finish_kind)i;
            return true;
        }
    return false;
}

/* a surface tension and an angle, of what dries */
static void check_meniscus(fw_process_pack *pack, const fw_xml_record *e,
                           const fw_process_finish *f) {
    static const fw_quantity_dimension tension = {.kg = 1, .s = -2}, angle = {.rad = 1};
    const struct {
        const char *name;
        const fw_quantity *q;
        fw_quantity_dimension is;
        const char *words;
    } of[] = {{"tension", f->tension, tension, "surface tension; write it in mN/m"},
              {"angle", f->angle, angle, "angle; write it in deg"}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const fw_xml_attribute *a = fw_process_pack_get(e, of[i].name);
        if (!of[i].q) continue;
        if (f->kind != FW_FINISH_DRY)
            fw_diag_error(pack->diags, 343, a->place,
                          "%s is of a meniscus: it belongs to kind=\"dry\" only", of[i].name);
        if (!fw_quantity_dimension_equal(of[i].q->dimension, of[i].is))
            fw_diag_error(pack->diags, 343, a->place, "'%s' is no %s", a->value, of[i].words);
    }
}

static void read_finish(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *s) {
    const fw_xml_attribute *with = fw_process_pack_get(e, "with"),
                           *by = fw_process_pack_get(e, "by"), *q = fw_process_pack_get(e, "q");
    fw_process_finish f = {.by = by ? by->value : "",
                           .tension = fw_process_pack_quantity(pack, e, "tension"),
                           .angle = fw_process_pack_quantity(pack, e, "angle"),
                           .time = fw_process_pack_quantity(pack, e, "q"),
                           .text = e->element->text,
                           .place = e->element->place};
    if (with) f.with = fw_process_pack_find(pack, with, FW_ID_HAZARD);
    if (!finish_kind(fw_process_pack_text(e, "kind"), &f.kind)) return; /* said by the schema */
    if (with && f.kind != FW_FINISH_RINSE)
        fw_diag_error(pack->diags, 343, with->place,
                      "with is what a wafer is rinsed in: it belongs to kind=\"rinse\" only");
    if (with && f.with && !f.with->wets)
        fw_diag_error(pack->diags, 343, with->place,
                      "'%s' is no liquid (wets=\"yes\" of its <hazard>), so that nothing can be "
                      "rinsed in it",
                      f.with->id);
    if ((by != NULL) != (f.kind == FW_FINISH_DRY))
        fw_diag_error(pack->diags, 343, e->element->place,
                      by ? "by is how a wafer is dried: it belongs to kind=\"dry\" only"
                         : "<finish kind=\"dry\"> needs by: a meniscus pulls compliant parts down, "
                           "so that it matters how they are dried");
    check_meniscus(pack, e, &f);
    if (f.time &&
        !fw_quantity_dimension_equal(f.time->dimension, (fw_quantity_dimension)FW_DIM_TIME))
        fw_diag_error(pack->diags, 169, q->place, "'%s' is not a time; write it in s or min",
                      q->value);
    s->finish[s->nfinish++] = f;
}

static void read_required(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *s) {
    const fw_xml_attribute *step = fw_process_pack_get(e, "step"),
                           *material = fw_process_pack_get(e, "material"),
                           *state = fw_process_pack_get(e, "state");
    if ((step != NULL) + (material != NULL) + (state != NULL) != 1)
        fw_diag_error(pack->diags, 345, e->element->place,
                      "<requires> names one thing: a step, a material or a state");
    if (step && fw_process_flow_left_out(pack->flow, step->value)) return;
    if (step) fw_process_pack_find(pack, step, FW_ID_STEP);
    if (material) fw_process_pack_find(pack, material, FW_ID_MATERIAL);
    s->required[s->nrequired++] =
        (fw_process_requirement){.step = step ? step->value : NULL,
                                 .material = material ? material->value : NULL,
                                 .state = state ? state->value : NULL,
                                 .where = fw_process_pack_where(e),
                                 .present = strcmp(fw_process_pack_text(e, "is"), "absent") != 0,
                                 .place = e->element->place};
}

static void read_set(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *s) {
    const fw_quantity *q = fw_process_pack_quantity(pack, e, "q");
    static const char *const bound[] = {"tol-lo", "tol-hi"};
    for (int i = 0; i < 2; i++) {
        const fw_xml_attribute *a = fw_process_pack_get(e, bound[i]);
        double value;
        if (a && a->value[0] && !strchr(a->value, '{') &&
            !fw_number_parse(a->value, strlen(a->value), &value))
            fw_diag_error(pack->diags, 171, a->place, "%s='%s' is not a number", a->name, a->value);
    }
    if (q)
        s->setting[s->nsetting++] =
            (fw_process_setting){.name = fw_process_pack_text(e, "name"),
                                 .q = q,
                                 .tolerance_low = fw_process_pack_text(e, "tol-lo"),
                                 .tolerance_high = fw_process_pack_text(e, "tol-hi"),
                                 .place = e->element->place};
}

/* false: it is not measured on this device */
static bool read_accept(const fw_process_pack *pack, const fw_xml_record *e, fw_process_accept *a) {
    const fw_xml_attribute *with = fw_process_pack_get(e, "only-with");
    if (with && pack->lacks && strcmp(with->value, pack->lacks) == 0) return false;
    *a = (fw_process_accept){.measure = fw_process_pack_text(e, "measure"),
                             .low = fw_process_pack_text(e, "lo"),
                             .high = fw_process_pack_text(e, "hi"),
                             .planned = fw_process_pack_text(e, "planned"),
                             .unit = fw_process_pack_text(e, "unit"),
                             .coupon = fw_process_pack_text(e, "coupon"),
                             .sites = (int)fw_process_pack_number(e, "sites", 1.0),
                             .every = (int)fw_process_pack_number(e, "every", 1.0),
                             .place = e->element->place};
    return true;
}

static void read_on_fail(fw_process_pack *pack, const fw_xml_record *e, fw_process_on_fail *f) {
    const fw_xml_attribute *go_to = fw_process_pack_get(e, "goto");
    const fw_process_left_out *gone =
        go_to ? fw_process_flow_left_out(pack->flow, go_to->value) : NULL;
    *f = (fw_process_on_fail){fw_process_pack_text(e, "if"), fw_process_pack_text(e, "then"),
                              gone    ? gone->before
                              : go_to ? go_to->value
                                      : "",
                              e->element->text};
    if (go_to && !gone) fw_process_pack_find(pack, go_to, FW_ID_STEP);
}

static fw_status read_child(fw_process_pack *pack, const fw_xml_record *c, fw_process_step *s) {
    if (fw_xml_is(c, "purpose"))
        s->purpose = c->element->text;
    else if (fw_xml_is(c, "change"))
        read_change(pack, c, &s->change[s->nchange++]);
    else if (fw_xml_is(c, "exposed"))
        read_exposed(pack, c, &s->exposed[s->nexposed++]);
    else if (fw_xml_is(c, "set"))
        read_set(pack, c, s);
    else if (fw_xml_is(c, "time"))
        return s->law ? FW_OK : read_time(pack, c, s);
    else if (fw_xml_is(c, "derive"))
        return read_derive(pack, c, &s->derive[s->nderive++]);
    else if (fw_xml_is(c, "endpoint"))
        s->endpoint[s->nendpoint++] = c->element->text;
    else if (fw_xml_is(c, "accept"))
        s->naccept += read_accept(pack, c, &s->accept[s->naccept]);
    else if (fw_xml_is(c, "hazard-ref")) {
        const fw_xml_attribute *ref = fw_process_pack_get(c, "ref");
        const fw_process_hazard *h = ref ? fw_process_pack_find(pack, ref, FW_ID_HAZARD) : NULL;
        if (h) s->hazard[s->nhazard++] = h;
    } else if (fw_xml_is(c, "on-fail"))
        read_on_fail(pack, c, &s->on_fail[s->non_fail++]);
    else if (fw_xml_is(c, "lag"))
        s->nlag += read_lag(pack, c, &s->lag[s->nlag]);
    else if (fw_xml_is(c, "finish"))
        read_finish(pack, c, s);
    else if (fw_xml_is(c, "requires"))
        read_required(pack, c, s);
    else if (fw_xml_is(c, "uses"))
        fw_process_pack_use(pack, c, s);
    else if (fw_xml_is(c, "align"))
        fw_process_pack_align(pack, c, s);
    return FW_OK;
}

static fw_status make_room(fw_arena *arena, const fw_xml_record *e, fw_process_step *s) {
    FW_NEED(s->change =
                fw_arena_array(arena, fw_process_change, (size_t)fw_xml_children(e, "change")));
    FW_NEED(s->exposed =
                fw_arena_array(arena, fw_process_exposed, (size_t)fw_xml_children(e, "exposed")));
    FW_NEED(s->setting =
                fw_arena_array(arena, fw_process_setting, (size_t)fw_xml_children(e, "set")));
    FW_NEED(s->derive =
                fw_arena_array(arena, fw_process_derive, (size_t)fw_xml_children(e, "derive")));
    FW_NEED(s->endpoint =
                fw_arena_array(arena, const char *, (size_t)fw_xml_children(e, "endpoint")));
    FW_NEED(s->accept =
                fw_arena_array(arena, fw_process_accept, (size_t)fw_xml_children(e, "accept")));
    FW_NEED(s->hazard = fw_arena_array(arena, const fw_process_hazard *,
                                       (size_t)fw_xml_children(e, "hazard-ref")));
    FW_NEED(s->on_fail =
                fw_arena_array(arena, fw_process_on_fail, (size_t)fw_xml_children(e, "on-fail")));
    FW_NEED(s->lag = fw_arena_array(arena, fw_process_lag, (size_t)fw_xml_children(e, "lag")));
    FW_NEED(s->required = fw_arena_array(arena, fw_process_requirement,
                                         (size_t)fw_xml_children(e, "requires")));
    FW_NEED(s->use = fw_arena_array(arena, fw_process_use, (size_t)fw_xml_children(e, "uses")));
    FW_NEED(s->finish =
                fw_arena_array(arena, fw_process_finish, (size_t)fw_xml_children(e, "finish")));
    return FW_OK;
}

/* what is said of a step is what its machine can do; more wafers than places would be run in loads that nobody wrote */
static void batch_fits(fw_process_pack *pack, const fw_xml_record *e, const fw_process_step *s) {
    const fw_xml_attribute *batch = fw_process_pack_get(e, "batch");
    if (!batch || !s->equipment) return;
    if (fw_process_step_is_of_lot(s) && !fw_words_hold("hold mount clean inspect", " ", s->op))
        fw_diag_error(
            pack->diags, 558, batch->place,
            "step %s (%s) is written once for a lot (batch=\"%d\"), but is done to every wafer: "
            "write batch=\"%d\", which is what %s takes",
            s->id, s->op, s->batch, s->equipment->capacity, s->equipment->id);
    if (fw_process_step_is_of_lot(s)) return;
    if (s->batch > s->equipment->capacity)
        fw_diag_error(pack->diags, 558, batch->place,
                      "step %s is for %d wafers at once, and %s takes %d (its capacity): write "
                      "batch=\"%d\", or the capacity that the machine has",
                      s->id, s->batch, s->equipment->id, s->equipment->capacity,
                      s->equipment->capacity);
}

/* what drives the device bears a voltage, and nothing else (FW-D547) */
static const fw_quantity *bearing(fw_process_pack *pack, const fw_xml_record *e) {
    const fw_quantity *q = fw_process_pack_quantity(pack, e, "bears");
    const fw_quantity_dimension voltage = {.m = 2, .kg = 1, .s = -3, .A = -1};
    if (q && !fw_quantity_dimension_equal(q->dimension, voltage))
        fw_diag_error(pack->diags, 547, fw_process_pack_get(e, "bears")->place,
                      "what a step bears is a voltage, and '%s' is in %s; correct its unit", q->id,
                      q->unit);
    return q;
}

static fw_status read_step(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *s) {
    const fw_xml_attribute *equipment = fw_process_pack_get(e, "equipment");
    *s = (fw_process_step){.id = fw_process_pack_text(e, "id"),
                           .op = fw_process_pack_text(e, "op"),
                           .title = fw_process_pack_text(e, "title"),
                           .purpose = "",
                           .mask = fw_process_pack_text(e, "mask"),
                           .in_source = strcmp(fw_process_pack_text(e, "in-source"), "yes") == 0,
                           .parts = strcmp(fw_process_pack_text(e, "leaves"), "dies") == 0,
                           .batch = (int)fw_process_pack_number(e, "batch", 1.0),
                           .expression = "",
                           .shape = "",
                           .k = 2.0,
                           .second_signature =
                               strcmp(fw_process_pack_text(e, "second-signature"), "yes") == 0,
                           .attended_s = 60.0 * fw_process_pack_number(e, "attended", 0.0),
                           .bears = bearing(pack, e),
                           .place = e->element->place};
    if (equipment) s->equipment = fw_process_pack_find(pack, equipment, FW_ID_EQUIPMENT);
    batch_fits(pack, e, s);
    FW_TRY(make_room(pack->arena, e, s));
    for (const fw_xml_record *c = e->first_child; c; c = c->next)
        FW_TRY(read_child(pack, c, s));
    return FW_OK;
}

fw_status fw_process_pack_steps(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    for (const fw_xml_record *c = pack->root->first_child; c; c = c->next)
        if (fw_xml_is(c, "step")) FW_TRY(read_step(pack, c, &f->step[f->nstep++]));
    return FW_OK;
}
