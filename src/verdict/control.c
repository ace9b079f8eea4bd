/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What would have to be known or held better so that everything a flow may make is accepted: the
   one input that does it alone, by how much; else the share of all ranges. */
#include "verdict/corners.h"
#include <math.h>
#include <string.h>

enum { HALVINGS = 8 };

typedef struct box {
    double low[FW_FABRICATION_INPUTS], high[FW_FABRICATION_INPUTS];
} box;

static box whole(const fw_verdict_variant_verdict *v) {
    box b = {{0}, {0}};
    for (int i = 0; i < v->ninput; i++)
        b.low[i] = v->input[i].low, b.high[i] = v->input[i].high;
    return b;
}

/* every device that was not accepted, moved to where the smaller box ends; the governing one first:
   it is the likeliest to fail again */
static fw_status box_accepts(const fw_verdict_search *s, const box *b, bool *accepted) {
    const fw_verdict_fabricated_verdict *fabricated = s->fabricated;
    *accepted = true;
    for (int turn = -1; turn < fabricated->ncorner && *accepted; turn++) {
        int c = turn < 0 ? fabricated->at : turn;
        if ((turn >= 0 && c == fabricated->at) || fabricated->corner[c].decision == FW_ACCEPT)
            continue;
        double x[FW_FABRICATION_INPUTS];
        for (int i = 0; i < s->v->ninput; i++)
            x[i] = fmin(fmax(fabricated->corner[c].x[i], b->low[i]), b->high[i]);
        FW_TRY(fw_verdict_search_accepts(s, x, accepted));
    }
    return FW_OK;
}

/* ---- one input alone ---- */

static int governing_row(const fw_verdict_search *s) {
    const fw_verdict_fabricated_verdict *fabricated = s->fabricated;
    int rows = s->device->nscene + 1, row = FW_NONE;
    if (fabricated->governing == FW_NONE) return FW_NONE;
    const double *ln = s->ln + (size_t)fabricated->at * (size_t)s->nrow;
    for (int r = fabricated->governing * rows; r < (fabricated->governing + 1) * rows; r++)
        if (!isnan(ln[r]) && (row == FW_NONE || ln[r] > ln[row])) row = r;
    return row;
}

/* how much of the governing utilisation an input makes, ln, and at which end; without a row (a
   flexure is gone) the end that the point is at */
static double weight(const fw_verdict_search *s, int row, int i, bool *low_is_bad) {
    const fw_verdict_fabrication_input *in = &s->v->input[i];
    double range = in->high - in->low, x = s->fabricated->corner[s->fabricated->at].x[i];
    double slope = row == FW_NONE ? (double)NAN : s->slope[row * s->v->ninput + i];
    *low_is_bad = isnan(slope) || slope == 0.0 ? x < in->nominal : slope < 0.0;
    if (isnan(slope)) return fabs(x - in->nominal) * fabs(in->edge_m) * 1e6; /* um: edges cut */
    return fabs(slope) * range;
}

/* rounded towards the good end, to a hundredth of the range and better */
static double rounded(double x, double range, bool up) {
    double unit = pow(10.0, floor(log10(range)) - 2.0);
    return unit * (up ? ceil(x / unit - 1e-9) : floor(x / unit + 1e-9));
}

static fw_status hold_one(fw_verdict_search *s, int i, bool low_is_bad, bool *done) {
    const fw_verdict_fabrication_input *in = &s->v->input[i];
    double bad = low_is_bad ? in->low : in->high, good = low_is_bad ? in->high : in->low;
    box b = whole(s->v);
    double *end = low_is_bad ? &b.low[i] : &b.high[i];
    *end = good;
    FW_TRY(box_accepts(s, &b, done));
    for (int k = 0; *done && k < HALVINGS; k++) {
        bool accepted;
        *end = 0.5 * (bad + good);
        FW_TRY(box_accepts(s, &b, &accepted));
        if (accepted)
            good = *end;
        else
            bad = *end;
    }
    if (!*done) return FW_OK;
    good = rounded(good, in->high - in->low, low_is_bad);
    s->fabricated->held = i;
    s->fabricated->held_low = low_is_bad ? fmin(good, in->high) : in->low;
    s->fabricated->held_high = low_is_bad ? in->high : fmax(good, in->low);
    return FW_OK;
}

static fw_status report_one(fw_verdict_search *s, bool low_is_bad) {
    const fw_verdict_fabrication_input *in = &s->v->input[s->fabricated->held];
    const char *at = fw_verdict_fabrication_value(
        s->arena, in, low_is_bad ? s->fabricated->held_low : s->fabricated->held_high);
    const char *low = fw_verdict_fabrication_value(s->arena, in, in->low),
               *high = fw_verdict_fabrication_value(s->arena, in, in->high);
    FW_NEED(at && low && high ? at : NULL);
    FW_NEED(s->fabricated->control = fw_arena_printf(
                s->arena, "accepted where %s is known to be %s %s (here %s to %s%s%s%s)", in->name,
                low_is_bad ? "at least" : "at most", at, low, high,
                in->unknown ? ", assumed: " : "", in->unknown ? in->unknown : "",
                in->unknown ? " is not known" : ""));
    return FW_OK;
}

/* ---- all of them ---- */

static fw_status hold_all(fw_verdict_search *s) {
    double bad = 1.0, good = 0.0;
    if (s->fabricated->corner[0].decision != FW_ACCEPT) {
        s->fabricated->control =
            "no single input of the flow, held to its best, makes it accepted: give "
            "the flexures more margin";
        return FW_OK;
    }
    for (int k = 0; k < HALVINGS; k++) {
        double share = 0.5 * (bad + good);
        bool accepted;
        box b;
        for (int i = 0; i < s->v->ninput; i++) {
            const fw_verdict_fabrication_input *in = &s->v->input[i];
            b.low[i] = in->nominal + share * (in->low - in->nominal);
            b.high[i] = in->nominal + share * (in->high - in->nominal);
        }
        FW_TRY(box_accepts(s, &b, &accepted));
        if (accepted)
            good = share;
        else
            bad = share;
    }
    char percent[32];
    s->fabricated->held_share = 0.01 * floor(100.0 * good);
    fw_number_text(percent, sizeof percent, 100.0 * s->fabricated->held_share, 3);
    FW_NEED(s->fabricated->control = fw_arena_printf(
                s->arena,
                "no single input is enough; accepted where every range is %s %% as wide about its "
                "nominal",
                percent));
    return FW_OK;
}

fw_status fw_verdict_fabrication_control(fw_verdict_search *s) {
    int row = governing_row(s), n = s->v->ninput;
    bool tried[FW_FABRICATION_INPUTS] = {false}, done = false;
    for (int turn = 0; turn < n; turn++) {
        int next = FW_NONE;
        double most = -1.0;
        bool low_is_bad, low = false;
        for (int i = 0; i < n; i++) {
            double w = weight(s, row, i, &low_is_bad);
            if (!tried[i] && w > most) most = w, next = i, low = low_is_bad;
        }
        if (next == FW_NONE) break;
        tried[next] = true;
        FW_TRY(hold_one(s, next, low, &done));
        if (done) return report_one(s, low);
    }
    return hold_all(s);
}
