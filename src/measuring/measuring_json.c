/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The same numbers for every document that shows them: verdict.json and the recipe's. */
#include "base/json.h"
#include "measuring/measuring.h"
#include <math.h>
#include <string.h>

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
    fw_json_real(json, "value", fw_measuring_in_unit(&x->q, x->value, false));
    fw_json_real(json, "u", fw_measuring_in_unit(&x->q, x->before, true));
    fw_json_real(json, "u_measured", fw_measuring_in_unit(&x->q, x->after, true));
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
