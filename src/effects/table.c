/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>
#include <string.h>

/* A build without an effect (-DFW_WITHOUT_EFFECTS of CMake, for measuring what an absent effect
   costs) defines FW_WITHOUT_<name> as 1. FW_GONE_1 then puts a comma in front, so that FW_SECOND
   picks the macro that makes no row. */
#define FW_GONE_1                     ,
#define FW_SECOND(first, second, ...) second
#define FW_A_ROW(name)                &fw_effect_##name,
#define FW_NO_ROW(name)
#define FW_CHOSEN(gone, name)        FW_SECOND(gone FW_NO_ROW, FW_A_ROW, )(name)
#define FW_ROW_UNLESS(without, name) FW_CHOSEN(FW_GONE_##without, name)
#define FW_ROW(without, name)        FW_ROW_UNLESS(without, name)
#define FW_EFFECT(name)              FW_ROW(FW_WITHOUT_##name, name)
#define FW_EFFECT_ELEMENT(name, ...) FW_EFFECT(name)
static const fw_effect_row *const rows[] = {
#include "device/effects.def"
};
enum { ROWS = sizeof rows / sizeof rows[0] };

const fw_effect_row *const *fw_effect_rows(size_t *count) {
    *count = ROWS;
    return rows;
}

fw_status fw_effects_envelope_find(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_device_scene *scene, fw_effects_envelope *envelope) {
    return fw_effects_envelope_of_rows(arena, mechanism, scene, rows, ROWS, envelope);
}

static const char fw_between[] = ", \t"; /* names of a list */

static bool known(fw_word id) {
    for (size_t i = 0; i < ROWS; i++)
        if (fw_word_is(id, rows[i]->id)) return true;
    return false;
}

static fw_status check_list(fw_arena *arena, const char *list, fw_diags *diags) {
    for (fw_word word; list && fw_word_next(&list, fw_between, &word);) {
        if (known(word)) continue;
        fw_text names = fw_text_new(arena);
        const char *id[ROWS], *own = fw_arena_strndup(arena, word.at, word.length);
        FW_NEED(own);
        for (size_t i = 0; i < ROWS; i++) {
            id[i] = rows[i]->id;
            fw_text_printf(&names, "%s%s", i ? ", " : "", id[i]);
        }
        FW_TRY(fw_text_end(&names));
        const char *near = fw_did_you_mean(own, id, ROWS);
        fw_status status = fw_diag_error(
            diags, 110, (fw_place){"--effects", 0, 0},
            "there is no effect \"%.60s\"%s%s%s; known are auto, all, none, or a list of %s", own,
            FW_DID_YOU_MEAN(near), names.data);
        return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
    }
    return FW_OK;
}

/* ---- bounds ---- */

static double or_infinite(double bound) {
    return isnan(bound) ? (double)INFINITY : bound;
}

/* What the envelope does not take in must not change the motion much, or no bound holds that was
   found without it: all bounds grow by 1/(1 - sum of theirs), and are infinite from 1/2 on. */
static fw_status settle(const fw_effect_case *c, fw_effect_entry *entry) {
    double loose = 0;
    int largest = -1;
    for (int i = 0; i < ROWS; i++) {
        if (!entry[i].called_for || c->envelope->taken[i]) continue;
        loose += entry[i].bound;
        if (largest < 0 || entry[i].bound > entry[largest].bound) largest = i;
    }
    for (int i = 0; i < ROWS && loose > 0; i++) {
        if (!entry[i].called_for || rows[i]->kept) continue;
        const bool own = rows[i]->alone && isfinite(entry[i].bound); /* no answer to itself */
        const double others = own ? loose - entry[i].bound : loose;
        if (others < 0.5)
            entry[i].bound /= 1 - others;
        else if (isfinite(entry[i].bound)) {
            entry[i].bound = (double)INFINITY;
            FW_NEED(entry[i].reason = fw_arena_printf(
                        c->arena, "%s%sno bound holds while %s may change the motion much",
                        rows[i]->beside ? entry[i].reason : "kept", rows[i]->beside ? "; " : ": ",
                        rows[largest]->id));
        }
    }
    return FW_OK;
}

/* Keeping what could be left out is never wrong, so that a bound of a device much like this one
   need not be exact: within this factor. */
static const double fw_much_alike = 4;

static const fw_effect_entry *acts_by_far(const fw_effect_choice *choice, int i, double accuracy) {
    const fw_effect_ledger *like = choice->mode == FW_EFFECTS_AUTO ? choice->like : NULL;
    if (!like || i >= like->count || strcmp(like->item[i].id, rows[i]->id) != 0) return NULL;
    const fw_effect_entry *e = &like->item[i];
    return e->active && isfinite(e->bound) && e->bound > fw_much_alike * accuracy ? e : NULL;
}

/* Whether hinges give was asked for, whatever their bound is. No other bound grows by it where the envelope has
   taken it in. */
static bool decides_nothing(const fw_effect_case *c, const fw_effect_choice *choice, int i) {
    bool in;
    return choice->untold && c->envelope->taken[i] &&
           fw_effects_hinge_forced(rows[i]->id, choice->hinge, &in);
}

static fw_status find_bounds(const fw_effect_case *c, const fw_effect_choice *choice,
                             double accuracy, fw_effect_entry *entry) {
    for (int i = 0; i < ROWS; i++) {
        const fw_effect_entry *like = acts_by_far(choice, i, accuracy);
        const fw_effect_row *row = rows[i];
        entry[i] = (fw_effect_entry){.id = row->id, .reason = "not called for by the scene"};
        entry[i].called_for = row->called_for(c);
        if (!entry[i].called_for) continue;
        if (row->looked_at) FW_TRY(row->looked_at(c, &entry[i].looked_at));
        if (like && !row->kept) {
            entry[i].bound = like->bound;
            entry[i].reason = "as in a device much like this one";
        } else if (decides_nothing(c, choice, i)) {
            entry[i].bound = (double)INFINITY;
            entry[i].reason = "decided without its bound, which nobody reads";
        } else {
            FW_TRY(row->bound(c, &entry[i].bound, &entry[i].reason));
        }
        entry[i].bound = or_infinite(entry[i].bound);
        entry[i].cost = row->cost * (row->count ? row->count(c) : 1);
    }
    return settle(c, entry);
}

/* ---- decision ---- */

/* how it was found, its number, and what that means */
static fw_status explain(const fw_effect_case *c, fw_effect_entry *entry, double sum,
                         double accuracy, bool last) {
    if (isinf(entry->bound)) return FW_OK; /* its reason is the whole of it */
    char bound[32], wanted[32], all[32];
    fw_percent_text(bound, sizeof bound, entry->bound);
    fw_percent_text(wanted, sizeof wanted, accuracy);
    fw_percent_text(all, sizeof all, sum);
    const char *how = entry->reason;
    if (!entry->active)
        entry->reason = fw_arena_printf(
            c->arena, "%s; at most %s %%, left out: %s%s%sbelow the accuracy wanted, %s %%", how,
            bound, last ? "" : "together with smaller ones ", last ? "" : all, last ? "" : " %, ",
            wanted);
    else if (entry->bound < accuracy)
        entry->reason = fw_arena_printf(c->arena,
                                        "%s; at most %s %%, kept: with what is left out already "
                                        "%s %%, not below the accuracy wanted, %s %%",
                                        how, bound, all, wanted);
    else
        entry->reason =
            fw_arena_printf(c->arena, "%s; at most %s %%, not below the accuracy wanted, %s %%",
                            how, bound, wanted);
    FW_NEED(entry->reason);
    return FW_OK;
}

/* What no motion has: its bound stands beside what was left out. Where there is none it must be small: the share below
   which the closed forms of hinges may be off as well (verdict/decision.c). Twice the share by which forces may change
   is then in its place, since what comes suddenly goes twice as far as at rest. */
static const double fw_beside_small = 0.029, fw_beside_times = 2;

static fw_status set_aside(const fw_effect_case *c, fw_effect_entry *entry,
                           fw_effect_ledger *ledger) {
    char text[32];
    for (int i = 0; i < ROWS; i++) {
        fw_effect_entry *e = &entry[i];
        double share;
        if (!e->called_for || !rows[i]->beside) continue;
        e->active = false;
        e->cost = 0;
        if (rows[i]->alone) {
            double rad;
            FW_TRY(rows[i]->alone(c, &rad, &ledger->rubs));
            if (isfinite(e->bound)) {
                /* it was found in rad: the floor, which may be far below the motion, takes no part in it */
                ledger->beside_rad += e->bound * c->envelope->floor;
                fw_number_text(text, sizeof text, 1e3 * e->bound * c->envelope->floor, 3);
                FW_NEED(e->reason = fw_arena_printf(c->arena,
                                                    "%s; at most %s mrad of a hinge, in every band",
                                                    e->reason, text));
                continue;
            }
        }
        if (isfinite(e->bound)) {
            ledger->beside += e->bound;
            fw_percent_text(text, sizeof text, e->bound);
            FW_NEED(e->reason = fw_arena_printf(c->arena, "%s; at most %s %%, in every band",
                                                e->reason, text));
            continue;
        }
        FW_TRY(rows[i]->beside(c, &share));
        e->open = share;
        if (share > fw_beside_small) {
            ledger->undecided = e->reason;
            ledger->undecided_share = fmax(ledger->undecided_share, share);
            continue;
        }
        ledger->beside += fw_beside_times * share;
        fw_percent_text(text, sizeof text, fw_beside_times * share);
        FW_NEED(e->reason = fw_arena_printf(
                    c->arena, "%s: twice what it changes of forces, %s %%, is in every band",
                    e->reason, text));
    }
    return FW_OK;
}

fw_status fw_effects_found_bound(fw_arena *arena, const char *id, const char *how, double bound,
                                 fw_effect_ledger *ledger, bool *found) {
    char text[32];
    *found = false;
    if (!(bound <= fw_beside_small)) return FW_OK;
    ledger->undecided = NULL, ledger->undecided_share = 0;
    for (int i = 0; i < ledger->count; i++) {
        fw_effect_entry *e = &ledger->item[i];
        if (strcmp(e->id, id) == 0 && e->open > 0) {
            if (!(e->open > fw_beside_small)) ledger->beside -= fw_beside_times * e->open;
            ledger->beside += bound;
            e->bound = bound, e->open = 0, *found = true;
            fw_percent_text(text, sizeof text, bound);
            FW_NEED(e->reason =
                        fw_arena_printf(arena, "%s; at most %s %%, in every band", how, text));
        }
        if (!(e->open > fw_beside_small)) continue;
        ledger->undecided = e->reason;
        ledger->undecided_share = fmax(ledger->undecided_share, e->open);
    }
    return FW_OK;
}

/* What the formula of something that acts leaves out. It is a share of what is seen; that beside is one of the truth, of which
   what is seen is at least 1 less it. */
static const double fw_lacking_told = 1e-3;

static fw_status take_lacking(const fw_effect_case *c, int i, fw_effect_entry *e,
                              fw_effect_ledger *ledger) {
    char text[32];
    double share = 0;
    const char *words = NULL;
    if (!e->active || !rows[i]->lacking) return FW_OK;
    FW_TRY(rows[i]->lacking(c, &share, &words));
    if (!(share > 0)) return FW_OK;
    ledger->beside += share / (1 + share);
    ledger->lacking_share = share;
    if (!words || share < fw_lacking_told) return FW_OK;
    ledger->lacking = words;
    fw_percent_text(text, sizeof text, share);
    FW_NEED(e->reason = fw_arena_printf(c->arena, "%s; %s: %s %% of what is seen, in every band",
                                        e->reason, words, text));
    return FW_OK;
}

/* smallest bounds first, while their sum stays below the accuracy; hinges as they were asked for */
static fw_status leave_out_small(const fw_effect_case *c, double accuracy,
                                 const fw_effect_choice *choice, bool calm,
                                 fw_effect_entry *entry) {
    bool settled[ROWS], in;
    double sum = 0;
    for (int i = 0; i < ROWS; i++) {
        settled[i] = !entry[i].called_for || (calm && rows[i]->calms) || rows[i]->beside;
        if (!settled[i] && fw_effects_hinge_forced(rows[i]->id, choice->hinge, &in)) {
            settled[i] = true;
            entry[i].active = in;
            entry[i].reason = fw_effects_hinge_forced_reason(choice);
        }
        if (entry[i].looked_at && isfinite(entry[i].bound)) { /* else it stays anyway */
            settled[i] = entry[i].active = true;
            entry[i].reason = entry[i].looked_at;
        }
        if (calm && rows[i]->calms && entry[i].called_for) {
            entry[i].active = true;
            if (isfinite(entry[i].bound))
                entry[i].reason = "kept: left out only where hinges are pins without it too, since "
                                  "those that give would vibrate on and take many more steps";
        }
    }
    for (int k = 0; k < ROWS; k++) {
        int least = -1;
        for (int i = 0; i < ROWS; i++)
            if (!settled[i] && (least < 0 || entry[i].bound < entry[least].bound)) least = i;
        if (least < 0) break;
        settled[least] = true;
        double with = sum + entry[least].bound;
        bool first = sum == 0;
        entry[least].active = rows[least]->kept || !(with < accuracy);
        if (!rows[least]->kept) FW_TRY(explain(c, &entry[least], with, accuracy, first));
        if (!entry[least].active) sum = with;
    }
    return FW_OK;
}

/* what calms hinges that give stays with them; with what is kept so the sum is another one */
static fw_status decide_auto(const fw_effect_case *c, double accuracy,
                             const fw_effect_choice *choice, fw_effect_entry *entry) {
    fw_effect_entry first[ROWS];
    bool gives = false, loose = false;
    memcpy(first, entry, sizeof first);
    FW_TRY(leave_out_small(c, accuracy, choice, false, first));
    for (int i = 0; i < ROWS; i++) {
        if (strcmp(rows[i]->id, "nonlinear-hinge") == 0) gives = first[i].active;
        loose = loose || (rows[i]->calms && first[i].called_for && !first[i].active);
    }
    if (gives && loose) return leave_out_small(c, accuracy, choice, true, entry);
    memcpy(entry, first, sizeof first);
    return FW_OK;
}

/* something of the scene or the mechanism moves it, other than weight and the base: what is kept
   besides springs
 */
static bool moved(const fw_effect_case *c) {
    for (int i = 0; i < ROWS; i++)
        if (rows[i]->kept && !rows[i]->passive && rows[i]->called_for(c)) return true;
    return c->mechanism->ndriver > 0;
}

/* stays whatever was asked for: what is kept; a stop that may be reached, as springs do, and
   inertia where nothing says that it does not matter; weight where nothing else moves the mechanism
 */
static bool belongs(const fw_effect_case *c, const fw_effect_row *row,
                    const fw_effect_entry *entry) {
    return row->kept || (row->unbounded_stays && isinf(entry->bound)) ||
           (row->alone_stays && !moved(c));
}

static void decide_asked(const fw_effect_case *c, const fw_effect_choice *choice,
                         fw_effect_entry *entry) {
    bool whole = choice->mode == FW_EFFECTS_WHOLE;
    bool all = whole || choice->mode == FW_EFFECTS_ALL, list = choice->mode == FW_EFFECTS_LIST;
    for (int i = 0; i < ROWS; i++) {
        fw_effect_entry *e = &entry[i];
        if (!e->called_for || rows[i]->beside) continue;
        if (fw_effects_hinge_forced(e->id, choice->hinge, &e->active)) {
            e->reason = fw_effects_hinge_forced_reason(choice);
            continue;
        }
        bool in = all || (list && fw_words_hold(choice->list, fw_between, e->id)),
             stays = belongs(c, rows[i], e);
        e->active = in || stays;
        if (all)
            e->reason = whole ? "called for: equilibria and modes leave nothing out"
                              : "called for, and all effects were asked for";
        else if (in && !rows[i]->kept)
            e->reason = "called for, and in the list asked for";
        else if (!stays)
            e->reason = list ? "called for, but not in the list"
                             : "called for, but no effect was asked for";
        else if (rows[i]->alone_stays)
            e->reason = "nothing but weight and the base moves the mechanism: it is the motion "
                        "itself";
    }
}

void fw_effects_in_equilibrium(fw_effect_ledger *ledger) {
    for (int i = 0; i < ledger->count && i < ROWS; i++) {
        fw_effect_entry *e = &ledger->item[i];
        bool inertia = strcmp(e->id, "inertia") == 0;
        if (!e->called_for || !e->active || !(inertia || rows[i]->by_rate)) continue;
        e->active = false;
        e->reason = inertia ? "nothing moves in an equilibrium"
                            : "acts on velocities: it has no part in an equilibrium";
    }
}

/* the envelope is worth its cost only where something could be left out */
static fw_status look_around(const fw_effect_case *c, fw_effects_envelope *envelope) {
    for (int i = 0; i < ROWS; i++)
        if (!rows[i]->kept && rows[i]->called_for(c))
            return fw_effects_envelope_find(c->arena, c->mechanism, c->scene, envelope);
    return FW_OK;
}

fw_status fw_effects_compile(fw_arena *arena, const fw_mechanism *mechanism,
                             const fw_device_scene *scene, const fw_effect_choice *choice,
                             double accuracy, fw_diags *diags, fw_effect_ledger *ledger,
                             fw_effects_loads *loads) {
    fw_effects_envelope envelope = {.why_not = "no effect asked for it"};
    const fw_effect_case c = {arena, mechanism, scene, &envelope, diags, NULL};
    if (choice->mode == FW_EFFECTS_LIST) FW_TRY(check_list(arena, choice->list, diags));
    FW_NEED(ledger->item = fw_arena_array(arena, fw_effect_entry, ROWS));
    ledger->count = ROWS;
    ledger->left_out = ledger->beside = ledger->beside_rad = ledger->rubs = 0;
    ledger->undecided = ledger->lacking = NULL;
    ledger->undecided_share = ledger->lacking_share = 0;
    ledger->swing = (double)INFINITY;
    FW_TRY(fw_effects_loads_new(arena, mechanism, scene, loads));
    FW_NEED(envelope.taken = fw_arena_array(arena, bool, ROWS));
    FW_TRY(look_around(&c, &envelope));
    FW_TRY(find_bounds(&c, choice, accuracy, ledger->item));
    if (choice->mode == FW_EFFECTS_AUTO)
        FW_TRY(decide_auto(&c, accuracy, choice, ledger->item));
    else
        decide_asked(&c, choice, ledger->item);
    FW_TRY(set_aside(&c, ledger->item, ledger));
    fw_effect_case acting = c;
    acting.ledger = ledger;
    for (int i = 0; i < ROWS; i++) {
        fw_effect_entry *e = &ledger->item[i];
        FW_TRY(take_lacking(&c, i, e, ledger));
        if (e->called_for && rows[i]->note) FW_TRY(rows[i]->note(&c, &e->reason));
        if (!e->called_for && rows[i]->idle && !choice->untold && diags) rows[i]->idle(&c, diags);
        bool forced, was;
        forced = fw_effects_hinge_forced(e->id, choice->hinge, &was);
        if (choice->mode == FW_EFFECTS_AUTO && e->called_for && !e->active && !forced &&
            !rows[i]->beside)
            ledger->left_out += e->bound;
        if (e->active && e->looked_at) ledger->swing = e->bound;
        if (e->active) {
            if (rows[i]->check) FW_TRY(rows[i]->check(&c, diags));
            FW_TRY(rows[i]->add(&acting, loads));
        } else if (e->called_for && rows[i]->leave_out)
            FW_TRY(rows[i]->leave_out(&c, loads));
    }
    if (choice->stiffer != 0 || choice->along != 0)
        FW_TRY(fw_effects_hinges_stiffer(&c, loads, choice->stiffer, choice->along));
    return fw_effects_hinge_settle(&c, choice, ledger, loads);
}

/* What the rows say of a scene: in words, what can be made less, and making it less. */

void fw_effects_describe(const fw_device *device, const fw_device_scene *scene,
                         const fw_effects_words *words) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    for (size_t i = 0; i < count; i++)
        if (row[i]->describe) row[i]->describe(device, scene, words);
}

void fw_effects_find_loads(const fw_device_scene *scene, fw_effects_load_scaling *loads) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    *loads = (fw_effects_load_scaling){0};
    for (size_t i = 0; i < count; i++)
        if (row[i]->loads) row[i]->loads(scene, loads);
}

void fw_effects_find_load_values(const fw_device_scene *scene, fw_effects_load_values *values) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    *values = (fw_effects_load_values){.count = 0};
    for (size_t i = 0; i < count; i++)
        if (row[i]->values) row[i]->values(scene, values);
}

bool fw_effects_scale(fw_device_scene *scene, double by) {
    size_t count;
    fw_effects_load_scaling loads;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    for (size_t i = 0; i < count; i++)
        if (row[i]->scale) row[i]->scale(scene, by);
    fw_effects_find_loads(scene, &loads);
    return loads.count > 0;
}
