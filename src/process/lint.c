/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/pack.h"
#include "process/films.h"
#include <math.h>
#include <string.h>

/* what a tool takes is what some material brings along */
static void lint_takes(fw_process_pack *pack, const fw_process_equipment *e) {
    const char *words = e->takes;
    for (fw_word word; fw_word_next(&words, " ", &word);) {
        bool known = false;
        for (int i = 0; i < pack->flow->nprocess_material; i++) {
            const char *group = pack->flow->process_material[i].contaminates;
            known =
                known || (strlen(group) == word.length && memcmp(group, word.at, word.length) == 0);
        }
        if (!known)
            fw_diag_error(pack->diags, 165, e->place,
                          "'%s' takes=\"%.*s\": no material contaminates with that; correct the "
                          "word, or say contaminates=\"...\" of the material",
                          e->id, (int)word.length, word.at);
    }
}

/* quantities that the program itself looks for, whatever ranges they state */
static void lint_known(fw_process_pack *pack) {
    static const struct {
        const char *id, *what;
        fw_quantity_dimension kind;
    } known[] = {
        {"insulator.breakdown", "a voltage per length", {.m = 1, .kg = 1, .s = -3, .A = -1}},
        {"insulator.resistivity", "a resistivity", {.m = 3, .kg = 1, .s = -3, .A = -2}},
        {"release.bond", "a share", {0}},
        {"isopropanol.tension", "a force per length", {.kg = 1, .s = -2}},
        {"dry.angle", "an angle", {.rad = 1}}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const fw_quantity *q = fw_process_flow_quantity(pack->flow, known[i].id);
        if (!q || fw_quantity_dimension_equal(q->dimension, known[i].kind)) continue;
        fw_diag_error(pack->diags, 547, q->place, "'%s' is in %s, and is %s; correct its unit",
                      q->id, q->unit, known[i].what);
    }
}

/* <hazard> children that name something elsewhere */
static fw_status lint_names(fw_process_pack *pack) {
    lint_known(pack);
    for (int part = 0; part < 2; part++) {
        const fw_xml_record *root = part == 0 ? pack->base : pack->root;
        for (const fw_xml_record *h = root->first_child; h; h = h->next)
            for (const fw_xml_record *c = h->first_child; c && fw_xml_is(h, "hazard");
                 c = c->next) {
                const fw_xml_attribute *with = fw_process_pack_get(c, "with"),
                                       *material = fw_process_pack_get(c, "material");
                if (fw_xml_is(c, "incompatible") && with)
                    fw_process_pack_find(pack, with, FW_ID_HAZARD);
                if (fw_xml_is(c, "attacks") && material)
                    fw_process_pack_find(pack, material, FW_ID_MATERIAL);
            }
    }
    for (int i = 0; i < pack->flow->nequipment; i++) {
        const fw_process_equipment *e = &pack->flow->equipment[i];
        const char *words = e->brings;
        for (fw_word word; fw_word_next(&words, " ", &word);) {
            fw_xml_attribute brings = {.name = "brings", .place = e->place};
            FW_NEED(brings.value = fw_arena_strndup(pack->arena, word.at, word.length));
            fw_process_pack_find(pack, &brings, FW_ID_HAZARD);
        }
        lint_takes(pack, e);
    }
    return FW_OK;
}

/* a hold starts at the end of an earlier step, and a step is repeated from itself or before */
static fw_status lint_order(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nlag; k++)
            for (int j = i; j < f->nstep; j++)
                if (strcmp(f->step[i].lag[k].from, f->step[j].id) == 0)
                    fw_diag_error(pack->diags, 276, f->step[i].lag[k].place,
                                  "<lag> of step %s counts from step %s, which is not before it; "
                                  "name an earlier step",
                                  f->step[i].id, f->step[j].id);
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].non_fail; k++)
            if (strcmp(f->step[i].on_fail[k].then, "rework") == 0 &&
                !f->step[i].on_fail[k].go_to[0])
                fw_diag_error(pack->diags, 276, f->step[i].place,
                              "<on-fail if=\"%s\"> of step %s says rework, and not from which step "
                              "on; add goto=\"%s\", or that of an earlier step",
                              f->step[i].on_fail[k].condition, f->step[i].id, f->step[i].id);
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].non_fail; k++)
            if (f->step[i].on_fail[k].go_to[0] &&
                fw_words_hold("continue scrap", " ", f->step[i].on_fail[k].then))
                fw_diag_error(
                    pack->diags, 276, f->step[i].place,
                    "<on-fail if=\"%s\"> of step %s says %s, and goes on with step %s all "
                    "the same; write then=\"rework\", or leave goto out",
                    f->step[i].on_fail[k].condition, f->step[i].id, f->step[i].on_fail[k].then,
                    f->step[i].on_fail[k].go_to);
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].non_fail; k++)
            for (int j = i + 1; j < f->nstep; j++)
                if (strcmp(f->step[i].on_fail[k].go_to, f->step[j].id) == 0)
                    fw_diag_error(pack->diags, 276, f->step[i].place,
                                  "<on-fail> of step %s goes on with step %s, which is not done "
                                  "yet; name the step itself or an earlier one",
                                  f->step[i].id, f->step[j].id);
    return FW_OK;
}

/* a step whose own chemicals must not meet; told, since some cleans are baths one after the other in one step */
static void lint_mixture(fw_process_pack *pack, const fw_process_step *s) {
    for (int i = 0; i < s->nhazard; i++)
        for (int k = 0; k < i; k++) {
            const char *what = fw_process_reaction(s->hazard[k], s->hazard[i]);
            if (what)
                fw_diag_warning(pack->diags, 175, s->place,
                                "step %s works with %s and %s, which must not meet: %s; make two "
                                "steps of it, at two benches, with a rinse between them",
                                s->id, s->hazard[k]->id, s->hazard[i]->id, what);
        }
}

/* two steps on one bench whose chemicals must not meet; once per pair of hazards */
static void lint_bench(fw_process_pack *pack, const fw_process_flow *f) {
    for (int i = 0; i < f->nstep; i++) {
        lint_mixture(pack, &f->step[i]);
        for (int j = 0; j < i; j++) {
            const fw_process_step *a = &f->step[j], *b = &f->step[i];
            if (a->equipment != b->equipment) continue;
            for (int s = 0; s < a->nhazard; s++)
                for (int t = 0; t < b->nhazard; t++)
                    if (fw_process_reaction(a->hazard[s], b->hazard[t]))
                        fw_diag_warning(pack->diags, 175, b->place,
                                        "steps %s and %s use the same %s, but %s and %s must not "
                                        "meet: use two benches and two waste cans",
                                        a->id, b->id, a->equipment->id, a->hazard[s]->id,
                                        b->hazard[t]->id);
        }
    }
}

/* what must not meet must not be collected in one can either */
static void lint_waste(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nhazard; i++)
        for (int j = 0; j < i; j++) {
            const fw_process_hazard *a = &f->hazard[j], *b = &f->hazard[i];
            if (fw_process_reaction(a, b) && strcmp(a->waste_stream, b->waste_stream) == 0)
                fw_diag_error(pack->diags, 175, b->place,
                              "%s and %s must not meet, but both go to the waste '%s'; give one of "
                              "them a stream of its own",
                              a->id, b->id, b->waste_stream);
        }
}

static fw_status lint_chemicals(fw_process_pack *pack) {
    lint_bench(pack, pack->flow);
    lint_waste(pack);
    return FW_OK;
}

static const struct {
    const char *asks;
    fw_status (*check)(fw_process_pack *pack);
    bool values; /* looks at values, which a laboratory may replace; and at nothing of the file */
} rules[] = {
    {"do hazards and tools name hazards and materials that exist?", lint_names, false},
    {"do waiting times count from earlier steps?", lint_order, false},
    {"does every value make sense, and keep dimension and range where it is replaced?",
     fw_process_lint_ranges, true},
    {"are set points inside their own tolerances, and lower limits below upper ones?",
     fw_process_lint_settings, true},
    {"can prices be added, and does a filling serve a wafer?", fw_process_lint_prices, true},
    {"has every layer a thickness, and is none made of more than there is?",
     fw_process_lint_thicknesses, true},
    {"is nobody alone with what is dangerous, and is there first aid?", fw_process_lint_people,
     false},
    {"are times ones that hands and benches keep?", fw_process_lint_hands, true},
    {"is nothing left wet, unbaked or hot for longer than it bears?", fw_process_lint_longest,
     true},
    {"does a step that is done in a liquid use some?", fw_process_lint_baths, false},
    {"is there something in every bath, and is the wafer one?", fw_process_lint_stock, true},
    {"does every liquid say what it reacts as?", fw_process_lint_reactivity, false},
    {"is every bath a liquid at its temperature?", fw_process_lint_warmth, true},
    {"do chemicals stay apart that must not meet?", lint_chemicals, false},
    {"is what a step changes on the wafer?", fw_process_lint_absent, false},
    {"is resist exposed through a mask before it is developed?", fw_process_lint_exposure, false},
    {"does something cover what an etch shall leave?", fw_process_lint_masking, false},
    {"does every etch go through what lies there?", fw_process_lint_through, true},
    {"is said how fast a chemical takes what it should not?", fw_process_lint_attacked, false},
    {"does every layer bear the temperature?", fw_process_lint_heat, true},
    {"is a wafer dry, cool and out of vacuum where a step wants it, and rinsed before another "
     "chemical?",
     fw_process_lint_states, false},
    {"does the wafer bear the waits that the flow lets it wait?", fw_process_lint_lags, false},
    {"does what a step works on lie open, and does metal grow where it shall?",
     fw_process_lint_reach, false},
    {"does no rinse take off what lies open?", fw_process_lint_rinses, false},
    {"is water not left to dry in air where there is a drier?", fw_process_lint_aired, false},
    {"does a critical point dryer get what it takes up?", fw_process_lint_critical, false},
    {"is what is plated or bonded cleaned shortly before?", fw_process_lint_fresh, false},
    {"does no rework bring a layer into a bath that attacks it?", fw_process_lint_reworked, false},
    {"is a layer accepted that is as thick as it is meant?", fw_process_lint_accepted, true},
    {"is nothing dissolved below a film that stays?", fw_process_lint_undermined, false},
    {"is what is measured there, and what a step is timed for?", fw_process_lint_measured, false},
    {"is what is sawn covered, and what was pressed on cleaned?", fw_process_lint_dust, false},
    {"is what lifts off thinner than its resist?", fw_process_lint_lifted, true},
    {"is what a step requires of the wafer true of the wafer that comes?", fw_process_lint_required,
     false},
    {"is resist baked before it is used, and the wafer before it is coated?", fw_process_lint_bakes,
     false},
    {"is nothing done again that comes once?", fw_process_lint_again, false},
    {"is a step what it says that it is, and timed for what it does?", fw_process_lint_kind, true},
    {"does a step take numbers and times of its own?", fw_process_lint_inputs, true},
    {"is it done at a tool that treats wafers, in a bath that is enough?", fw_process_lint_places,
     true},
    {"does it say which wafer it wants, and is that one baked and flat enough?",
     fw_process_lint_wanted, true},
    {"does no wafer drip with what etches on its way to another bench?", fw_process_lint_carried,
     false},
    {"is resist as thick as bakes and doses are computed for?", fw_process_lint_coats, true},
    {"is no resist baked once more before it is developed?", fw_process_lint_baked, false},
    {"is what is prepared used, and what is wet said to be?", fw_process_lint_prepared, false},
    {"is the device finished when the flow has ended?", fw_process_lint_end, false},
    {"does nothing stay on it that nobody wants there?", fw_process_lint_left, false},
    {"is it as thick as the flow says?", fw_process_lint_made, true},
    {"is every mask but the first aligned to one before it?", fw_process_lint_plates, false},
    {"is a mask aligned as well as anybody can, and no worse?", fw_process_lint_overlay, true},
    {"is a plate drawn smaller by what its etch takes sideways?", fw_process_lint_shrink, true},
    {"is what a step uses up, and what its tool brings, among its hazards?", fw_process_lint_uses,
     false},
    {"is a wafer that is in pieces handled as dies?", fw_process_lint_parted, false},
    {"do contaminated wafers stay in tools that take them?", fw_process_lint_contamination, false},
    {"does an etch take what it shall, and of the front alone?", fw_process_lint_chemistry, false},
    {"are ratios ratios, and constants those of the metal that is plated?", fw_process_lint_meant,
     true},
    {"does every corner move what is made, and has what is uncertain one?", fw_process_lint_corners,
     false},
};

fw_status fw_process_pack_lint(fw_process_pack *pack) {
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        FW_TRY(rules[i].check(pack));
    return FW_OK;
}

/* how far what is on the wafer reaches across, m. Without a <wafer> one die lies in the middle of the pack's own, and of
   all rectangles of its area the square has the shortest diagonal. 0: nothing is drawn */
static double across_m(const fw_process_mask_facts *facts) {
    if (!facts) return 0.0;
    if (facts->wafer_reach_m > 0.0) return 2.0 * facts->wafer_reach_m;
    return facts->die_area_m2 > 0.0 ? sqrt(2.0 * facts->die_area_m2) : 0.0;
}

/* a die that is larger than the pack's own wafer */
static fw_status lint_own_wafer(fw_arena *arena, fw_process_flow *flow,
                                const fw_process_mask_facts *facts) {
    const fw_quantity *q = fw_process_flow_quantity(flow, "wafer.D");
    double needs = across_m(facts);
    if (!q || q->unknown || needs <= q->value || (facts && facts->wafer_diameter_m > 0.0))
        return FW_OK;
    char a[32], b[32];
    return fw_process_flow_add_reason(
        arena, flow, 0,
        fw_arena_printf(arena,
                        "the die reaches across %s mm at least, but the wafer is %s mm wide "
                        "(wafer.D). Nearest change: a smaller die, or a <wafer> in the description",
                        fw_number_text(a, sizeof a, needs * 1e3, 4),
                        fw_number_text(b, sizeof b, q->value * 1e3, 4)));
}

/* ", or ...": what keeps every die within a circle, m: the wafer's rim left free as far as that; where not one die fits, only
   a smaller one */
static const char *within_across(fw_arena *arena, const fw_process_mask_facts *facts, double is) {
    char e[32];
    if (!(facts->wafer_diameter_m > is) || sqrt(2.0 * facts->die_area_m2) > is)
        return ", or a smaller die";
    /* up to the next tenth of a millimetre */
    const double edge_mm = ceil(5e3 * (facts->wafer_diameter_m - is) - 1e-6) / 10.0;
    return fw_arena_printf(arena, ", or edge-exclusion=\"%s mm\" of the <wafer>",
                           fw_number_text(e, sizeof e, edge_mm, 6));
}

/* dies outside the circle that a step works in: their devices are not made */
static fw_status lint_across(fw_arena *arena, fw_process_flow *flow,
                             const fw_process_mask_facts *facts, const fw_process_step *s,
                             const fw_process_change *c) {
    if (!c->across || c->across->unknown) return FW_OK;
    double needs = across_m(facts), is = c->across->value;
    if (needs <= is) return FW_OK;
    char a[32], b[32];
    const char *change = within_across(arena, facts, is);
    FW_NEED(change);
    return fw_process_flow_add_reason(
        arena, flow, 0,
        fw_arena_printf(arena,
                        "step %s works inside a circle of %s mm (%s), but the outermost die "
                        "reaches across %s mm. Nearest change: a tool that wide%s",
                        s->id, fw_number_text(a, sizeof a, is * 1e3, 4),
                        c->across->id ? c->across->id : "across",
                        fw_number_text(b, sizeof b, needs * 1e3, 4), change));
}

fw_status fw_process_lint_wafer(fw_arena *arena, fw_process_flow *flow,
                                const fw_process_mask_facts *facts) {
    FW_TRY(lint_own_wafer(arena, flow, facts));
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++)
            FW_TRY(lint_across(arena, flow, facts, &flow->step[i], &flow->step[i].change[k]));
    return FW_OK;
}

fw_status fw_process_flow_lint_values(fw_arena *arena, fw_process_flow *flow, fw_diags *diags) {
    fw_process_pack pack = {.arena = arena, .diags = diags, .flow = flow};
    FW_TRY(fw_process_flow_fill_texts(arena, flow, diags)); /* tolerances that go with a value */
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        if (rules[i].values) FW_TRY(rules[i].check(&pack));
    return FW_OK;
}

/* What the computed times do to the layers: known only with the mask and the device's thickness. */

static const fw_quantity *derived_named(const fw_process_step *s, const char *name) {
    for (int i = 0; i < s->nderived; i++)
        if (s->derived[i]->id && strcmp(s->derived[i]->id, name) == 0) return s->derived[i];
    return NULL;
}

/* A derived value above what the pack allows it (<derive most>): what a bath gives to one wafer,
   for example. Test: test_lint.c, most. */
static fw_status lint_most(fw_arena *arena, fw_process_flow *flow, const fw_process_step *s,
                           const fw_process_derive *d, fw_diags *diags) {
    const fw_quantity *q = derived_named(s, d->name);
    if (!q || q->unknown || !d->most || d->most->unknown || q->value <= d->most->value)
        return FW_OK;
    char is[32], most[32];
    fw_quantity limit = *d->most;
    limit.unit = q->unit;
    fw_number_text(is, sizeof is, fw_quantity_in_unit(q), 4);
    fw_number_text(most, sizeof most, fw_quantity_in_unit(&limit), 4);
    const char *gap = strcmp(q->unit, "1") == 0 ? "" : " ", *unit = gap[0] ? q->unit : "";
    fw_diag_warning(diags, 279, s->place, "step %s: %s is %s%s%s, above the %s%s%s of %s", s->id,
                    d->name, is, gap, unit, most, gap, unit, d->most->id);
    const char *why = fw_arena_printf(
        arena, "step %s: %s is %s%s%s, above the limit of %s%s%s (%s; %s)", s->id, d->name, is, gap,
        unit, most, gap, unit, d->most->id, fw_quantity_value_status_text(d->most->status));
    return fw_process_flow_add_reason(arena, flow, -1, why);
}

/* the circle that a step works in lies on the wafer */
static fw_status lint_circle(fw_arena *arena, fw_process_flow *flow, const fw_process_step *s,
                             const fw_process_change *c, fw_diags *diags) {
    const fw_quantity *wafer = fw_process_flow_quantity(flow, "wafer.D");
    char is[32], most[32];
    if (!c->across || c->across->unknown || !wafer || wafer->unknown ||
        (c->across->value > 0.0 && c->across->value <= wafer->value))
        return FW_OK;
    const char *why = fw_arena_printf(
        arena,
        "step %s works inside a circle of %s mm (%s) on a wafer of %s mm. Nearest change: %s",
        s->id, fw_number_text(is, sizeof is, 1e3 * c->across->value, 4),
        c->across->id ? c->across->id : "across",
        fw_number_text(most, sizeof most, 1e3 * wafer->value, 4),
        c->across->value > 0.0 ? "a tool for this wafer" : "a larger wafer, or a narrower rim");
    FW_NEED(why);
    fw_diag_warning(diags, 608, c->place, "%s", why);
    return fw_process_flow_add_reason(arena, flow, 0, why);
}

/* a time so uncertain that its first look would be before the start */
static fw_status lint_uncertain(fw_arena *arena, fw_process_flow *flow, const fw_process_step *s) {
    char u[32];
    if (!s->time.computable || s->k * s->time.relative_uncertainty < 1.0) return FW_OK;
    return fw_process_flow_add_reason(
        arena, flow, -1,
        fw_arena_printf(
            arena,
            "the time of step %s has a standard uncertainty of %s %%: there is no first "
            "look that is early enough; look from the start on, or measure %s first",
            s->id, fw_number_text(u, sizeof u, 100.0 * s->time.relative_uncertainty, 3),
            s->time.ncontribution ? s->time.contribution[0] : "its inputs"));
}

/* a time of nothing: an input is 0 that is none */
static fw_status lint_lasts(fw_arena *arena, fw_process_flow *flow, const fw_process_step *s,
                            fw_diags *diags) {
    if (!s->time.computable) return FW_OK;
    if (!(s->time.nominal_s > 0.0)) {
        fw_diag_warning(diags, 534, s->place,
                        "step %s takes no time by its law (%s): one of its inputs is 0", s->id,
                        s->law);
        return fw_process_flow_add_reason(
            arena, flow, 0,
            fw_arena_printf(arena,
                            "step %s takes no time by its law (%s): nothing is done. Nearest "
                            "change: the inputs that are 0",
                            s->id, s->law));
    }
    const fw_process_law *law = fw_process_law_find(s->law);
    const bool stated = !law || law->stated; /* was asked before, but with its pauses */
    const double t = s->pulse ? fmax(s->time.nominal_s, s->booked_s) : s->time.nominal_s;
    const char *why = fw_process_step_unkept(s, t);
    if (!why || (stated && !s->pulse)) return FW_OK;
    char is[32];
    fw_number_text(is, sizeof is, t / 60.0, 4);
    fw_diag_warning(
        diags, 577, s->place,
        "step %s (%s) takes %s min by its law (%s)%s, but %s; correct what it is computed "
        "from",
        s->id, s->op, is, s->law, s->pulse ? " and its pauses" : "", why);
    return fw_process_flow_add_reason(
        arena, flow, -1,
        fw_arena_printf(arena, "step %s takes %s min by its law (%s)%s, but %s", s->id, is, s->law,
                        s->pulse ? " and its pauses" : "", why));
}

static fw_status tell_attended(fw_arena *arena, fw_process_flow *flow, const fw_process_step *s,
                               int number, double needed_s, fw_diags *diags) {
    const bool current = fw_process_step_goes_on(s) == FW_GOES_ON_UNDER_CURRENT;
    char is[32], t[32], to[32];
    fw_number_text(is, sizeof is, s->attended_s / 60.0, 4);
    fw_number_text(t, sizeof t, needed_s / 60.0, 4);
    fw_number_text(to, sizeof to, ceil(needed_s / 60.0), 6);
    const char *why =
        number == 617
            ? fw_arena_printf(arena,
                              "somebody is at step %s for %s min (attended), but from its first "
                              "look to its stop time are %s min: nobody %s. Nearest change: "
                              "attended=\"%s\", or a time that is known better",
                              s->id, is, t,
                              current
                                  ? "switches the current off when it is through, and it goes on"
                                  : "sees when it is through",
                              to)
            : fw_arena_printf(arena,
                              "somebody stands at step %s for %s min (attended), which takes %s "
                              "min at most by its law: more than an hour longer. Nearest change: "
                              "attended=\"%s\"",
                              s->id, is, t, to);
    FW_NEED(why);
    fw_diag_warning(diags, number, s->place, "%s", why);
    return fw_process_flow_add_reason(arena, flow, -1, why);
}

bool fw_process_step_is_ended(const fw_process_step *s) {
    const fw_process_goes_on how = fw_process_step_goes_on(s);
    const fw_process_hazard *in = fw_process_step_in_liquid(s) ? fw_process_step_liquid(s) : NULL;
    const bool acts = how == FW_GOES_ON_UNDER_CURRENT ||
                      (how == FW_GOES_ON_IN_BATH && in && !fw_process_only_dries(in));
    return acts && !s->pulse;
}

/* Somebody waits for the end of what goes on until it is ended: of a bath that is seen to be through, of a current that is
   switched off, from the first look to the stop time. Whoever is there for less comes back to what went on alone. A chamber
   stops by itself, and a solvent takes nothing else, however long. And nobody is there for hours longer than a computed step takes; of stated times that was asked before.
   Test: test_lint.c, who_is_there. */
static fw_status lint_watched(fw_arena *arena, fw_process_flow *flow, const fw_process_step *s,
                              fw_diags *diags) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const double window_s = s->time.stop_s - s->time.first_look_s;
    const bool stated = !law || law->stated;
    if (!s->time.computable) return FW_OK;
    if (fw_process_step_is_ended(s) && s->attended_s < window_s * (1.0 - 1e-9))
        return tell_attended(arena, flow, s, 617, window_s, diags);
    if (!stated && s->attended_s > s->booked_stop_own_s + 3600.0)
        return tell_attended(arena, flow, s, 609, s->booked_stop_own_s, diags);
    return FW_OK;
}

/* A limit that is a number of the pack does not follow a value that was changed, and one that does may still be far from
   it: where what is planned is not accepted, every wafer that comes out right is refused. Test: test_accepted.c. */
static void lint_planned(const fw_process_step *s, const fw_process_accept *a, fw_diags *diags) {
    double planned, low, high;
    if (!fw_number_parse(a->planned, strlen(a->planned), &planned)) return;
    const bool under = fw_number_parse(a->low, strlen(a->low), &low) && planned < low,
               over = fw_number_parse(a->high, strlen(a->high), &high) && planned > high;
    if (!under && !over) return;
    fw_diag_warning(
        diags, 667, a->place,
        "step %s measures '%s', of which %s %s is planned, and accepts no %s than %s: every wafer "
        "that comes out right is refused; change what is planned, or the limit",
        s->id, a->measure, a->planned, a->unit, under ? "less" : "more", under ? a->low : a->high);
}

fw_status fw_process_lint_computed(fw_arena *arena, fw_process_flow *flow, fw_diags *diags) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        FW_TRY(lint_uncertain(arena, flow, s));
        FW_TRY(lint_lasts(arena, flow, s, diags));
        FW_TRY(lint_watched(arena, flow, s, diags));
        for (int k = 0; k < s->nexposed; k++)
            FW_TRY(fw_process_lint_loss(arena, flow, i, &s->exposed[k], diags));
        for (int k = 0; k < s->naccept; k++)
            lint_planned(s, &s->accept[k], diags);
        for (int k = 0; k < s->nderive; k++)
            FW_TRY(lint_most(arena, flow, s, &s->derive[k], diags));
        for (int k = 0; k < s->nchange; k++)
            FW_TRY(lint_circle(arena, flow, s, &s->change[k], diags));
        for (int k = 0; k < s->nchange && strcmp(s->op, "plate") == 0; k++)
            if (strcmp(s->change[k].kind, "add") == 0 && strcmp(s->change[k].where, "all") != 0)
                FW_TRY(fw_process_lint_mould(arena, flow, i, &s->change[k], diags));
    }
    return FW_OK;
}
