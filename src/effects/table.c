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
static const fw_effect_row *const rows[] = {
#include "effects/effects.def"
};
enum { ROWS = sizeof rows / sizeof rows[0] };

const fw_effect_row *const *fw_effect_rows(size_t *count) {
    *count = ROWS;
    return rows;
}

/* is `id` one of the comma separated names? */
static bool listed(const char *list, const char *id) {
    size_t n = strlen(id);
    for (const char *at = list; at && *at;) {
        at += strspn(at, ", \t");
        size_t length = strcspn(at, ", \t");
        if (length == n && strncmp(at, id, n) == 0) return true;
        at += length;
    }
    return false;
}

static bool known(const char *id, size_t n) {
    for (size_t i = 0; i < ROWS; i++)
        if (strlen(rows[i]->id) == n && strncmp(rows[i]->id, id, n) == 0) return true;
    return false;
}

static fw_status check_list(fw_arena *arena, const char *list, fw_diags *diags) {
    for (const char *at = list; at && *at;) {
        at += strspn(at, ", \t");
        size_t n = strcspn(at, ", \t");
        if (n && !known(at, n)) {
            fw_text names = fw_text_new(arena);
            for (size_t i = 0; i < ROWS; i++)
                fw_text_printf(&names, "%s%s", i ? ", " : "", rows[i]->id);
            FW_TRY(fw_text_end(&names));
            fw_status status = fw_diag_error(
                diags, 110, (fw_place){"--effects", 0, 0},
                "there is no effect \"%.*s\"; known are auto, all, none, or a list of %s",
                n > 60 ? 60 : (int)n, at, names.data);
            return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
        }
        at += n;
    }
    return FW_OK;
}

/* active or not, and in words why */
static fw_status decide(const fw_effect_case *c, const fw_effect_row *row,
                        const fw_effect_choice *choice, double accuracy, fw_effect_entry *entry) {
    *entry = (fw_effect_entry){.id = row->id, .reason = "not called for by the scene"};
    entry->called_for = row->called_for(c);
    if (!entry->called_for) return FW_OK;
    entry->cost = row->cost * (row->count ? row->count(c) : 1);
    const char *how = "";
    FW_TRY(row->bound(c, &entry->bound, &how));
    char bound[32], wanted[32];
    fw_number_text(bound, sizeof bound, entry->bound, 3);
    fw_number_text(wanted, sizeof wanted, accuracy, 3);
    switch (choice->mode) {
    case FW_EFFECTS_AUTO:
        entry->active = !(entry->bound < accuracy);
        if (isinf(entry->bound))
            entry->reason = how;
        else
            FW_NEED(entry->reason =
                        fw_arena_printf(c->arena, "%s = %s, %s the accuracy wanted %s", how, bound,
                                        entry->active ? "not below" : "below", wanted));
        return FW_OK;
    case FW_EFFECTS_ALL:
        entry->active = true;
        entry->reason = "called for, and all effects were asked for";
        return FW_OK;
    case FW_EFFECTS_NONE:
    case FW_EFFECTS_LIST:
    default:
        /* loads and stiffness are the motion itself: without them there would be nothing to judge
         */
        entry->active = isinf(entry->bound) ||
                        (choice->mode == FW_EFFECTS_LIST && listed(choice->list, row->id));
        entry->reason = isinf(entry->bound) ? how
                        : entry->active     ? "called for, and in the list asked for"
                        : choice->mode == FW_EFFECTS_NONE
                            ? "called for, but no effect was asked for"
                            : "called for, but not in the list";
        return FW_OK;
    }
}

fw_status fw_effects_compile(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                             const fw_effect_choice *choice, double accuracy, fw_diags *diags,
                             fw_effect_ledger *ledger, fw_terms *terms) {
    fw_envelope envelope;
    FW_TRY(fw_envelope_find(arena, mechanism, scene, &envelope));
    const fw_effect_case c = {arena, mechanism, scene, &envelope};
    if (choice->mode == FW_EFFECTS_LIST) FW_TRY(check_list(arena, choice->list, diags));
    FW_NEED(ledger->item = fw_arena_array(arena, fw_effect_entry, ROWS));
    ledger->count = ROWS;
    FW_TRY(fw_terms_new(arena, mechanism, scene, terms));
    for (size_t i = 0; i < ROWS; i++) {
        FW_TRY(decide(&c, rows[i], choice, accuracy, &ledger->item[i]));
        const fw_effect_entry *entry = &ledger->item[i];
        if (entry->active)
            FW_TRY(rows[i]->add(&c, terms));
        else if (entry->called_for && rows[i]->leave_out)
            FW_TRY(rows[i]->leave_out(&c, terms));
    }
    return FW_OK;
}
