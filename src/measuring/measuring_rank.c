/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which measurement goes first, and what is said of it, in words and as JSON. */
#include "base/json.h"
#include "base/sort.h"
#include "base/text.h"
#include "measuring/measuring.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* bands and windows that differ by less than this are alike: rounding, and what nobody reads */
static const double alike = 1e-6;

/* ---- what a measurement does ---- */

/* infinite where a flexure was gone at a corner, and is not any more */
static double narrowing(const fw_verdict_band *now, const fw_verdict_band *then) {
    if (isnan(now->high) || isnan(then->high)) return 0.0;
    if (isinf(now->high) && isinf(then->high)) return 0.0;
    return (now->high - now->low) - (then->high - then->low);
}

static bool band_moves(const fw_verdict_band *now, const fw_verdict_band *then) {
    if (isnan(now->high) || isnan(then->high)) return isnan(now->high) != isnan(then->high);
    if (isinf(now->high) != isinf(then->high)) return true;
    return fabs(now->low - then->low) > alike ||
           (isfinite(now->high) && fabs(now->high - then->high) > alike);
}

static bool another_governs(const fw_measuring *m, const fw_measuring_item *item) {
    return m->what && item->governs && strcmp(item->governs, m->what) != 0;
}

/* of what the device uses: where another governs then, at least what the one that governed still does */
static fw_verdict_band band_then(const fw_measuring *m, const fw_measuring_item *item) {
    if (!another_governs(m, item) || !isfinite(item->most)) return item->band;
    return (fw_verdict_band){fmax(item->band.low, item->governing.low), item->most};
}

static bool changes(const fw_measuring *m, const fw_measuring_item *item) {
    if (item->nwindow > 0 || item->needed > 0 || item->open) return true;
    if (!item->made) return false;
    if (!m->banded) return item->share - item->share_after > alike;
    for (int i = 0; i < m->nrequirement; i++)
        if (band_moves(&m->requirements[i], &item->requirement[i])) return true;
    return item->decision != m->decision || band_moves(&m->band, &item->band) ||
           another_governs(m, item);
}

/* ---- the order ---- */

static int more(double a, double b) {
    return fw_order_doubles(round(b / alike), round(a / alike));
}

/* What keeps the verdict open goes first, then what decides, then what narrows the governing band most, then, as where no bands were asked
   for, what takes most of its standard uncertainty; then what makes steps computable, then what narrows
   their windows; the rest by name, so that the order is always the same. */
static int by_worth(const void *x, const void *y) {
    const fw_measuring_item *a = x, *b = y;
    if (a->open != b->open) return a->open ? -1 : 1;
    if (a->decides != b->decides) return a->decides ? -1 : 1;
    int order = more(a->narrowing, b->narrowing);
    if (!order) order = more(a->share - a->share_after, b->share - b->share_after);
    if (!order) order = b->opens - a->opens;
    if (!order) order = b->needed - a->needed;
    if (!order) order = more(a->windows, b->windows);
    if (!order && (a->id == NULL) != (b->id == NULL)) order = a->id ? -1 : 1;
    return order || !a->id ? order : strcmp(a->id, b->id);
}

/* ---- words ---- */

static void percent(fw_text *out, double share) {
    fw_text_real(out, "%.1f", 100.0 * share);
}

static void put_shares(fw_text *out, const fw_measuring_item *item) {
    fw_text_number(out, 100.0 * item->share, 2);
    fw_text_add(out, " to ");
    fw_text_number(out, 100.0 * item->share_after, 2);
    fw_text_add(out, " %");
}

void fw_measuring_put_band(fw_text *out, const fw_verdict_band *band) {
    if (isnan(band->high)) {
        fw_text_add(out, "not known");
        return;
    }
    if (isinf(band->low)) {
        fw_text_add(out, "cut through");
        return;
    }
    const double no_end =
        100; /* a min above 0 of what may be next to nothing, or on the other side of 0 */
    percent(out, band->low);
    if (band->high >= no_end && isfinite(band->high)) {
        fw_text_add(out, " % to next to nothing of what is asked for");
        return;
    }
    if (isinf(band->high)) {
        fw_text_add(out, " % to cut through");
        return;
    }
    fw_text_add(out, "..");
    percent(out, band->high);
    fw_text_add(out, " %");
}

/* a value in the unit of a quantity; a difference of temperatures has no zero point; NaN stays */
static double in_unit(const fw_quantity *like, double x, bool difference) {
    fw_quantity_unit unit;
    fw_quantity q = *like;
    if (isnan(x)) return x;
    q.value = x;
    if (!difference) return fw_quantity_in_unit(&q);
    if (!q.unit || !fw_quantity_unit_parse(q.unit, strlen(q.unit), &unit, NULL, NULL)) return x;
    unit.offset = 0.0;
    return fw_quantity_unit_from_si(&unit, x);
}

void fw_measuring_put_value(fw_text *out, const fw_measuring_item *item, bool after) {
    double u = after ? item->after : item->before;
    if (after && !item->by && !isnan(item->value)) {
        fw_text_add(out, "if known exactly");
        return;
    }
    if (isnan(item->value) || (!after && item->unknown && isnan(u))) {
        fw_text_add(out, "unknown");
        return;
    }
    if (!after && item->q.interval) {
        fw_text_number(out, in_unit(&item->q, item->q.low, false), 4);
        fw_text_add(out, " to ");
        fw_text_number(out, in_unit(&item->q, item->q.high, false), 4);
    } else {
        fw_text_number(out, in_unit(&item->q, item->value, false), 6);
        fw_text_add(out, " +- ");
        fw_text_number(out, in_unit(&item->q, u, true), 2);
    }
    if (item->q.unit && strcmp(item->q.unit, "1") != 0) fw_text_printf(out, " %s", item->q.unit);
}

void fw_measuring_put_worth(fw_text *out, const fw_measuring *m, const fw_measuring_item *item) {
    if (item->open) fw_text_add(out, "nothing is accepted before it is known");
    if (!item->made) return;
    if (m->banded) {
        fw_measuring_put_band(out, &item->band);
        if (another_governs(m, item) && isfinite(item->most)) {
            fw_text_printf(out, "; %s then governs with ", item->governs);
            fw_measuring_put_band(out, &item->governing);
        }
        if (item->decides)
            fw_text_add(out, item->decision == FW_ACCEPT ? ": accepted" : ": rejected");
    } else {
        put_shares(out, item);
    }
}

/* ---- windows ---- */

/* what a window loses, relative to where it lies */
static double lost(const fw_measuring_window *w) {
    if (isnan(w->before_s[0]) || isnan(w->after_s[0])) return 0.0;
    return ((w->before_s[1] - w->before_s[0]) - (w->after_s[1] - w->after_s[0])) / w->before_s[1];
}

static void put_window(fw_text *out, const double *s, double unit_s) {
    if (isnan(s[0])) {
        fw_text_add(out, "not computable");
        return;
    }
    fw_text_number(out, s[0] / unit_s, 4);
    fw_text_add(out, "..");
    fw_text_number(out, s[1] / unit_s, 4);
}

void fw_measuring_put_windows(fw_text *out, const fw_measuring_item *item) {
    int best = 0;
    for (int i = 1; i < item->nwindow; i++)
        if (lost(&item->window[i]) > lost(&item->window[best])) best = i;
    if (item->nwindow > 0) {
        const fw_measuring_window *w = &item->window[best];
        double longest = isnan(w->before_s[1]) ? w->after_s[1] : w->before_s[1];
        bool minutes = longest >= 600.0;
        fw_text_printf(out, "%s: ", w->step);
        put_window(out, w->before_s, minutes ? 60.0 : 1.0);
        fw_text_add(out, " to ");
        put_window(out, w->after_s, minutes ? 60.0 : 1.0);
        fw_text_add(out, minutes ? " min" : " s");
        if (item->nwindow > 1)
            fw_text_printf(out, ", and %d more step%s", item->nwindow - 1,
                           item->nwindow > 2 ? "s" : "");
    }
    if (item->needed_for)
        fw_text_printf(out, "%snot computable without it: %s", item->nwindow ? "; " : "",
                       item->needed_for);
}

/* a proper name takes no article */
static bool proper(const char *name) {
    return name[0] >= 'A' && name[0] <= 'Z';
}

static void say_decision(fw_text *text, const fw_measuring_item *item) {
    if (!item->decides) return;
    fw_text_add(text, item->decision == FW_ACCEPT ? ", and all that the flow makes is accepted"
                                                  : ", and what the flow makes is rejected");
}

static void say_band(fw_text *text, const fw_measuring *m, const fw_measuring_item *item) {
    fw_text_printf(text, "the band of %s goes from ", m->what);
    fw_measuring_put_band(text, &m->band);
    fw_text_add(text, " to ");
    fw_measuring_put_band(text, &item->band);
    if (another_governs(m, item) && isfinite(item->most)) {
        fw_text_printf(text, " (%s then governs, with ", item->governs);
        fw_measuring_put_band(text, &item->governing);
        fw_text_add(text, ")");
    }
    say_decision(text, item);
}

static void say_share(fw_text *text, const fw_measuring *m, const fw_measuring_item *item) {
    fw_text_printf(text, "the standard uncertainty that it brings to %s goes from ", m->what);
    put_shares(text, item);
    fw_text_add(text, " of the limit, of ");
    fw_text_number(text, 100.0 * m->sigma, 2);
    fw_text_add(text, " % in all");
}

static bool pays(const fw_measuring *m, const fw_measuring_item *item) {
    if (item->open) return true;
    if (!m->what) return false;
    return m->banded ? item->decides || item->narrowing > alike
                     : item->share - item->share_after > alike;
}

/* what is worth more, and cannot be had: a bound on what knowing it would do */
static void say_unread(fw_text *text, const fw_measuring *m, const fw_measuring_item *item) {
    fw_text_printf(text, "; %s%s would be worth more, ", proper(item->name) ? "" : "the ",
                   item->name);
    fw_measuring_put_worth(text, m, item);
    fw_text_add(text, " if it were known exactly, but nothing in this flow reads it");
}

/* "Measure the anisotropy first (rie.A; coupon undercut-ladder, with cd-lines): the band of hinge A goes
   from 79.7..90.9 % to 83.1..86.0 %." The first that can be read; where none can, the first of all. */
static fw_status say_first(fw_arena *arena, fw_measuring *m) {
    const fw_measuring_item *top = m->nitem ? &m->item[0] : NULL, *item = top;
    if (!top || !pays(m, top)) return FW_OK;
    for (int i = 0; i < m->nitem && !item->by && !top->open; i++)
        if (m->item[i].by && pays(m, &m->item[i])) item = &m->item[i];
    fw_text text = fw_text_new(arena);
    fw_text_printf(&text, "Measure %s%s first (", proper(item->name) ? "" : "the ", item->name);
    const char *by = item->by     ? item->by
                     : item->open ? NULL /* a coupon may, once there is a value to expect */
                                  : "nothing in this flow reads it";
    fw_text_printf(&text, "%s%s%s): %s", item->id ? item->id : "", item->id && by ? "; " : "",
                   by ? by : "", by == item->by ? "" : "if it were known exactly, ");
    if (item->open)
        fw_text_add(&text, "it moves what is made by nobody knows how much, and nothing is "
                           "accepted before it is known");
    else if (m->banded)
        say_band(&text, m, item);
    else
        say_share(&text, m, item);
    if (item != top) say_unread(&text, m, top);
    fw_text_add(&text, ".");
    FW_TRY(fw_text_end(&text));
    m->first = text.data;
    return FW_OK;
}

fw_status fw_measuring_rank(fw_arena *arena, fw_measuring *m, fw_measuring_item *item, int n) {
    fw_text nothing = fw_text_new(arena);
    int kept = 0;
    for (int i = 0; i < n; i++) {
        fw_measuring_item *x = &item[i];
        const fw_verdict_band then = band_then(m, x);
        x->narrowing = x->made && m->banded ? narrowing(&m->band, &then) : 0.0;
        x->decides = x->made && m->banded && m->decision == FW_INCONCLUSIVE &&
                     x->decision != FW_INCONCLUSIVE;
        if (changes(m, x)) {
            item[kept++] = *x;
            continue;
        }
        fw_text_printf(&nothing, "%s%s%s%s%s", nothing.length ? ", " : "", x->name,
                       x->id ? " (" : "", x->id ? x->id : "", x->id ? ")" : "");
    }
    if (kept > 1) qsort(item, (size_t)kept, sizeof *item, by_worth);
    fw_text_add(&nothing, "");
    FW_TRY(fw_text_end(&nothing));
    m->nothing = nothing.length ? nothing.data : "";
    m->item = item;
    m->nitem = kept;
    return say_first(arena, m);
}

/* ---- the same numbers for every document that shows them: verdict.json and the recipe's ---- */

/* [low, high]; an end where a flexure is gone is null, as one that is not known */
static void band(fw_json *json, const char *key, const fw_verdict_band *b) {
    fw_json_list(json, key);
    fw_json_real(json, NULL, b->low);
    fw_json_real(json, NULL, b->high);
    fw_json_end(json);
}

static void bands(fw_json *json, const fw_measuring *m, const fw_verdict_band *of) {
    fw_json_list(json, "requirements");
    for (int i = 0; i < m->nrequirement; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "name", m->requirement_name[i]);
        band(json, "band", &of[i]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void seconds(fw_json *json, const char *key, const double *s) {
    if (isnan(s[0])) {
        fw_json_null(json, key);
        return;
    }
    fw_json_list(json, key);
    fw_json_real(json, NULL, s[0]);
    fw_json_real(json, NULL, s[1]);
    fw_json_end(json);
}

static void windows(fw_json *json, const fw_measuring_item *item) {
    fw_json_list(json, "windows");
    for (int i = 0; i < item->nwindow; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "step", item->window[i].step);
        seconds(json, "before_s", item->window[i].before_s);
        seconds(json, "after_s", item->window[i].after_s);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_real(json, "windows_narrowing", item->windows);
    fw_json_whole(json, "opens", item->opens);
    fw_json_text(json, "needed_for", item->needed_for);
}

static void item(fw_json *json, const fw_measuring *m, const fw_measuring_item *x) {
    fw_json_object(json, NULL);
    fw_json_text(json, "id", x->id);
    fw_json_text(json, "name", x->name);
    fw_json_truth(json, "known", !x->unknown);
    fw_json_text(json, "unit", x->q.unit);
    fw_json_text(json, "kind",
                 fw_quantity_is_word(&x->q)                       ? "word"
                 : x->q.range && strcmp(x->q.range, "count") == 0 ? "count"
                                                                  : "number");
    fw_json_real(json, "value", in_unit(&x->q, x->value, false));
    fw_json_real(json, "u", in_unit(&x->q, x->before, true));
    fw_json_real(json, "u_measured", in_unit(&x->q, x->after, true));
    fw_json_text(json, "status", fw_quantity_value_status_text(x->q.status));
    fw_json_text(json, "read_by", x->by);
    fw_json_truth(json, "coupon", x->coupon);
    if (m->judged_made) {
        fw_json_real(json, "share", x->share);
        fw_json_real(json, "share_measured", x->share_after);
    }
    if (m->banded) {
        band(json, "band", &x->band);
        fw_json_real(json, "narrowing", x->narrowing);
        fw_json_text(json, "governs", x->governs);
        fw_json_real(json, "most", x->most);
        band(json, "governing_band", &x->governing);
        fw_json_text(json, "verdict", fw_verdict_decision_text(x->decision));
        fw_json_truth(json, "decides", x->decides);
        bands(json, m, x->requirement);
    }
    windows(json, x);
    fw_json_whole(json, "devices", x->judged);
    fw_json_end(json);
}

void fw_measuring_json(fw_json *json, const fw_measuring *m) {
    if (!m) {
        fw_json_null(json, "measurements");
        return;
    }
    fw_json_object(json, "measurements");
    fw_json_text(json, "of", m->what);
    if (m->judged_made) fw_json_real(json, "sigma", m->sigma);
    if (m->banded) {
        band(json, "band", &m->band);
        fw_json_text(json, "verdict", fw_verdict_decision_text(m->decision));
        bands(json, m, m->requirements);
    }
    fw_json_text(json, "first", m->first);
    fw_json_list(json, "ranked");
    for (int i = 0; i < m->nitem; i++)
        item(json, m, &m->item[i]);
    fw_json_end(json);
    fw_json_text(json, "no_effect", m->nothing);
    fw_json_whole(json, "devices", m->judged);
    fw_json_end(json);
}
