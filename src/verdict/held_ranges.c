/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What would have to be known or held better so that everything a flow may make is accepted: the
   one input that does it alone, by how much; else the share of all ranges. Theory: docs/theory/as-fabricated.md. */
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* Bisected in turn by one look at every device, by two, and by as many as its decision needs, each of which may cost
   a hundred times as much as the one before: a motion with its inertia in place of a row of equilibria. So closer ones
   leave more of a range open between what is refused for certain and what is accepted. */
enum { STAGES = 3 };
static const int looks_of[STAGES] = {1, 2, 0};
static const double left_open[STAGES] = {1.0 / 256, 1.0 / 24, 1.0 / 6}; /* of the range */

typedef struct box { /* the ranges, made narrower */
    double low[FW_FABRICATION_INPUTS], high[FW_FABRICATION_INPUTS];
} box;

typedef enum answer {
    ACCEPTED,
    UNDECIDED,
    REFUSED
} answer; /* undecided: closer numbers may decide */

/* No more boxes are asked than there are ends to hold, their bisections, and all together. Each has at most the devices
   that were not accepted. */
static double most_asked(const fw_verdict_search *s) {
    double boxes = s->v->ninput + 1, failed = 0;
    for (int i = 0; i < STAGES; i++)
        boxes += ceil(-log2(left_open[i]));
    for (int c = 0; c < s->fabricated->ncorner; c++)
        failed += s->fabricated->corner[c].decision != FW_ACCEPT;
    return boxes * failed;
}

/* a device at a point of the ranges, not kept as a corner */
static fw_status ask_point(const fw_verdict_search *from, const double *x, const signed char *sign,
                           int most_looks, answer *out) {
    fw_verdict_fabricated_corner corner;
    fw_verdict_search at = *from, *s = &at;
    double *ln;
    s->sign = sign;
    s->most_looks = most_looks;
    FW_NEED(ln = fw_arena_array(s->arena, double, (size_t)s->ncheck));
    FW_TRY(fw_verdict_search_point(s, x, &corner, ln));
    *out = corner.decision == FW_ACCEPT         ? ACCEPTED
           : most_looks > 0 && corner.undecided ? UNDECIDED
                                                : REFUSED;
    return FW_OK;
}

static void moved_into(const box *b, const fw_verdict_fabricated_corner *corner, int n, double *x) {
    for (int i = 0; i < n; i++)
        x[i] = fmin(fmax(corner->x[i], b->low[i]), b->high[i]);
}

/* all devices that were not accepted, at once, where threads help */
static fw_status failed_ahead(fw_verdict_search *s, const box *b, int most_looks) {
    const fw_verdict_fabricated_verdict *f = s->fabricated;
    const size_t width = (size_t)s->v->ninput, most = (size_t)f->ncorner;
    double *x = fw_arena_array(s->arena, double, most *width);
    const signed char **sign = fw_arena_array(s->arena, const signed char *, most);
    FW_NEED(x && sign ? x : NULL);
    size_t n = 0;
    for (size_t c = 0; c < most; c++) {
        if (f->corner[c].decision == FW_ACCEPT) continue;
        sign[n] = f->corner[c].sign;
        moved_into(b, &f->corner[c], s->v->ninput, x + width * n++);
    }
    s->most_looks = most_looks;
    return fw_verdict_search_ahead(s, x, sign, n);
}

/* Is all of a smaller box accepted? Every device that was not is moved to where the box ends and is
   run there. One that was accepted is not run again: the search takes utilisations to be monotone
   in each input, so that moving it inwards does not make it the worst one. The governing device is
   the first: it is the likeliest to fail again. */
static fw_status ask_box(const fw_verdict_search *from, const box *b, int most_looks, answer *out) {
    const fw_verdict_fabricated_verdict *fabricated = from->fabricated;
    fw_verdict_search at = *from, *s = &at;
    FW_TRY(failed_ahead(s, b, most_looks));
    *out = ACCEPTED;
    for (int turn = -1; turn < fabricated->ncorner && *out != REFUSED; turn++) {
        int c = turn < 0 ? fabricated->at : turn;
        if ((turn >= 0 && c == fabricated->at) || fabricated->corner[c].decision == FW_ACCEPT)
            continue;
        double x[FW_FABRICATION_INPUTS];
        answer a;
        moved_into(b, &fabricated->corner[c], s->v->ninput, x);
        FW_TRY(ask_point(s, x, fabricated->corner[c].sign, most_looks, &a));
        if (a != ACCEPTED) *out = a; /* a refusal ends it */
    }
    return FW_OK;
}

typedef struct narrowing { /* the box at a number t */
    int input; /* one end of it is at t; FW_NONE: every range is t times as wide about its nominal value */
    bool low_is_bad;
} narrowing;

static box ranges_at(const fw_verdict_variant_verdict *v, narrowing by, double t) {
    box b = {{0}, {0}};
    for (int i = 0; i < v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &v->input[i];
        const bool all = by.input == FW_NONE;
        b.low[i] = all ? in->nominal + t * (in->low - in->nominal) : in->low;
        b.high[i] = all ? in->nominal + t * (in->high - in->nominal) : in->high;
        if (i == by.input) *(by.low_is_bad ? &b.low[i] : &b.high[i]) = t;
    }
    return b;
}

/* between t = bad, where it is not accepted, and *good, where it is: *good comes nearer */
static fw_status narrow(const fw_verdict_search *s, narrowing by, double bad, double *good) {
    const double whole = fabs(*good - bad);
    double refused = bad;
    for (int i = 0; i < STAGES; i++) {
        double open = refused;
        while (fabs(*good - open) > left_open[i] * whole * (1 + 1e-9)) {
            const double t = 0.5 * (open + *good);
            const box b = ranges_at(s->v, by, t);
            answer a;
            FW_TRY(ask_box(s, &b, looks_of[i], &a));
            *(a == ACCEPTED ? good : &open) = t;
            if (a == REFUSED) refused = t;
        }
    }
    return FW_OK;
}

/* ---- one input alone ---- */

/* the largest check of the governing hinge at the governing point; FW_NONE: no hinge governs */
static int governing_check(const fw_verdict_search *s) {
    const fw_verdict_fabricated_verdict *fabricated = s->fabricated;
    int checks = s->device->nscene + 1, check = FW_NONE;
    if (fabricated->governing == FW_NONE) return FW_NONE;
    const double *ln = s->ln + (size_t)fabricated->at * (size_t)s->ncheck;
    for (int r = fabricated->governing * checks; r < (fabricated->governing + 1) * checks; r++)
        if (!isnan(ln[r]) && (check == FW_NONE || ln[r] > ln[check])) check = r;
    return check;
}

/* How much an input makes of the governing check, as the change of ln U over its range, and which
   end of the range is the bad one. Where there is no slope (no hinge governs, because a flexure is
   gone): by how many micrometres the input has moved edges at the governing point, for it is the
   edges that cut a flexure through, and the end on whose side that point is. Only the order of the
   inputs counts: it is that in which they are tried. */
static double weight(const fw_verdict_search *s, int check, int i, bool *low_is_bad) {
    const fw_verdict_fabrication_input *in = &s->v->input[i];
    double range = in->high - in->low, x = s->fabricated->corner[s->fabricated->at].x[i];
    double slope = check == FW_NONE ? (double)NAN : s->slope[check * s->v->ninput + i];
    if (in->local != 0.0) { /* its corners are those where hinges differ, with one sign */
        *low_is_bad = false;
        return 0.0;
    }
    *low_is_bad = isnan(slope) || slope == 0.0 ? x < in->nominal : slope < 0.0;
    if (isnan(slope)) return fabs(x - in->nominal) * fabs(in->edge_m) * 1e6;
    return fabs(slope) * range;
}

/* rounded towards the good end, so that what is said is accepted: to the power of ten between a
   thousandth and a hundredth of the range; a value that is round but for 1e-9 of that stays */
static double rounded(double x, double range, bool up) {
    double unit = pow(10.0, floor(log10(range)) - 2.0);
    return unit * (up ? ceil(x / unit - 1e-9) : floor(x / unit + 1e-9));
}

/* Moves the bad end of input i towards its good one until all is accepted. *done false: not even the
   good end alone is enough. */
static fw_status hold_one(fw_verdict_search *s, int i, bool low_is_bad, bool *done) {
    const fw_verdict_fabrication_input *in = &s->v->input[i];
    const narrowing by = {i, low_is_bad};
    double bad = low_is_bad ? in->low : in->high, good = low_is_bad ? in->high : in->low;
    if (in->local != 0.0) good = in->nominal; /* all alike */
    const box end = ranges_at(s->v, by, good);
    answer a;
    FW_TRY(ask_box(s, &end, 0, &a));
    *done = a == ACCEPTED;
    if (!*done) return FW_OK;
    FW_TRY(narrow(s, by, bad, &good));
    good = rounded(good, in->high - in->low, low_is_bad);
    s->fabricated->held = i;
    s->fabricated->held_low = low_is_bad ? fmin(good, in->high) : in->low;
    s->fabricated->held_high = low_is_bad ? in->high : fmax(good, in->low);
    return FW_OK;
}

static fw_status report_one(fw_verdict_search *s, bool low_is_bad) {
    const fw_verdict_fabrication_input *in = &s->v->input[s->fabricated->held];
    const char *at = fw_verdict_search_value_text(
        s->arena, in, low_is_bad ? s->fabricated->held_low : s->fabricated->held_high);
    const char *low = fw_verdict_search_value_text(s->arena, in, in->low),
               *high = fw_verdict_search_value_text(s->arena, in, in->high);
    FW_NEED(at && low && high ? at : NULL);
    FW_NEED(s->fabricated->control = fw_arena_printf(
                s->arena, "accepted where %s is known to be %s %s (here %s to %s%s%s%s)", in->name,
                low_is_bad ? "at least" : "at most", at, low, high,
                in->unknown ? ", assumed: " : "", in->unknown ? in->unknown : "",
                in->unknown ? " is not known" : ""));
    return FW_OK;
}

/* ---- all of them ---- */

/* the share of all ranges, about the nominal values, at which everything is accepted */
static fw_status hold_all(fw_verdict_search *s) {
    double good = 0.0;
    /* corner 0 is the nominal device: where it is not accepted no share of the ranges is */
    if (s->fabricated->corner[0].decision != FW_ACCEPT) {
        s->fabricated->control =
            s->fabricated->governing == FW_NONE
                ? "no single input of the flow, even held at its best value, makes the design "
                  "acceptable: the drawing needs more margin there"
                : "no single input of the flow, even held at its best value, makes the design "
                  "acceptable: give the flexures more margin";
        return FW_OK;
    }
    FW_TRY(narrow(s, (narrowing){.input = FW_NONE}, 1.0, &good));
    char percent[32];
    s->fabricated->held_share = 0.01 * floor(100.0 * good);
    fw_number_text(percent, sizeof percent, 100.0 * s->fabricated->held_share, 3);
    FW_NEED(s->fabricated->control = fw_arena_printf(
                s->arena,
                "no single input is enough; accepted where every range is %s %% as wide about its "
                "nominal value",
                percent));
    return FW_OK;
}

/* the inputs one by one, the one that makes most of the governing check first; then all together */
fw_status fw_verdict_fabrication_control(fw_verdict_search *s) {
    int check = governing_check(s), n = s->v->ninput;
    s->told->what = "looking for what would have to be held", s->told->done = 0;
    s->told->of = -most_asked(s);
    bool tried[FW_FABRICATION_INPUTS] = {false}, done = false;
    for (int turn = 0; turn < n; turn++) {
        int next = FW_NONE;
        double most = -1.0;
        bool low_is_bad, low = false;
        for (int i = 0; i < n; i++) {
            double w = weight(s, check, i, &low_is_bad);
            if (!tried[i] && w > most) most = w, next = i, low = low_is_bad;
        }
        if (next == FW_NONE) break;
        tried[next] = true;
        FW_TRY(hold_one(s, next, low, &done));
        if (done) return report_one(s, low);
    }
    return hold_all(s);
}

/* ---- what nobody knows ----
   A quantity that moves what is made, is not known, and has no assumed range. Nothing that is run stands for what is
   made then, so that nothing is accepted, and nothing is rejected that is not rejected as drawn. */

fw_status fw_verdict_not_known(fw_arena *arena, const fw_verdict_variant_verdict *v,
                               const char **text) {
    fw_text list = fw_text_new(arena);
    int n = 0;
    *text = NULL;
    for (int i = 0; i < v->ninput; i++)
        if (v->input[i].open)
            fw_text_printf(&list, "%s%s (%s)", n++ ? ", " : "", v->input[i].name,
                           v->input[i].unknown);
    if (n == 0) return FW_OK;
    FW_TRY(fw_text_end(&list));
    FW_NEED(*text = fw_arena_printf(
                arena,
                "what %s makes of it is not known, and no range is assumed: %s; measure %s and "
                "state it in a laboratory pack (a <corner> may have an assumed range)",
                v->variant->flow ? v->variant->flow : "this flow", list.data,
                n > 1 ? "each of them" : "it"));
    return FW_OK;
}
