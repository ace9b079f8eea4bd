/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What would have to be known or held better so that everything a flow may make is accepted: the
   one input that does it alone, by how much; else the share of all ranges. And what dies between the corners of these ranges
   may do. Theory: docs/theory/as-fabricated.md. */
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <float.h>
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

/* ---- what dies between corners may do ----
   Where their modes may lie, and which of the devices that were run stand for them: requirement_corners.c. What is met there,
   though by no device that was run, may strain anything. What one of them meets by o behind a gap g has the energy of its
   swing left there, k o^2 = K (S^2 - g^2) with k its own stiffness and K that of modes there. Where S goes up by u,
   o'^2 = u^2 o^2 + (u^2 - 1) g^2 K/k, and hinges and forces are taken to go up by o'/o, of the hardest over that of the hardest
   run. In: what the search has run. Error: small motions. Test: test_effects.py Resonance */

typedef struct amid {
    int scene;
    double *factor, *each, late; /* of one device that was run, with its modes anywhere */
    double *goes;                /* (nbody) how far anything of a body goes at most */
    double harder;               /* blows, over the hardest of what was run; infinite: none was */
    const char *met;             /* what is met there alone, as words; NULL: nothing */
    const char *what;            /* what may be beyond its limit, as words; NULL: nothing */
    double times;                /* how much farther anything goes than as drawn */
} amid;

/* hinges of one device that was run; what they use there enters `most` */
static fw_status amid_hinges(fw_verdict_search *s, int point, double harder, amid *to) {
    const fw_verdict_fabricated_corner *c = &s->fabricated->corner[point];
    const double *now = c->shaken[to->scene].factor;
    const size_t scenes = (size_t)s->device->nscene;
    for (int h = 0; h < s->v->nhinge; h++) {
        const fw_verdict_hinge_verdict *is = &c->hinge[h];
        const double used = exp(s->ln[(size_t)point * (size_t)s->ncheck + (size_t)h * (scenes + 1) +
                                      (size_t)to->scene]);
        const bool same = is->scene && strcmp(is->scene, s->device->scene[to->scene].name) == 0;
        const double band = is->utilisation > 0 ? is->utilisation_high / is->utilisation : 1,
                     by = to->each[h] * harder;
        if (isnan(used)) continue;
        s->fabricated->hinge[h].most = fmax(s->fabricated->hinge[h].most, used * by + is->numeric);
        if (!to->what && used * band * by / (same ? now[2 * h] : 1) >= 1)
            FW_NEED(to->what = fw_arena_printf(s->arena, "%s%s", FW_NAMED("hinge", is->id)));
    }
    return FW_OK;
}

static bool bears_blows(const fw_device *d, const fw_verdict_requirement *r) {
    const fw_device_probe_row row = d->probe[d->requirement[r->asked].probe].row;
    return row == FW_PROBE_IS_force || row == FW_PROBE_IS_torque || row == FW_PROBE_IS_power;
}

/* requirements of one device that was run; its band has already what an error of its own frequencies does */
static void amid_requirements(fw_verdict_search *s, int point, double harder, amid *to) {
    const fw_verdict_fabricated_corner *c = &s->fabricated->corner[point];
    const fw_verdict_shaken *now = &c->shaken[to->scene];
    double most[2];
    fw_verdict_requirement_factor(to->factor, s->v->nhinge, most);
    most[0] = 1 + fmax(0, most[0] - now->required[0]);
    most[1] = 1 - fmax(0, now->required[1] - most[1]);
    for (int k = 0; c->requirement && k < s->v->nrequirement; k++) {
        fw_verdict_requirement r = c->requirement[k];
        if (r.scene_index != to->scene || !r.measure || r.why) continue;
        if (fw_verdict_requirement_shaken(most, fmax(0, to->late - now->required_late),
                                          s->device->requirement[r.asked].measure, &r))
            fw_verdict_requirement_widen(0, 0, &r);
        if (harder > 1 && bears_blows(s->device, &r)) {
            const double more = (harder - 1) * (isinf(harder) ? 1 : r.swing);
            fw_verdict_requirement_widen(r.size || isnan(r.origin) ? 0 : more, more, &r);
        }
        if (s->fabricated->requirement) {
            fw_verdict_requirement *made = &s->fabricated->requirement[k];
            made->all_low = isnan(made->all_low) ? made->all_low : fmin(made->all_low, r.low);
            made->all_high = isnan(made->all_high) ? made->all_high : fmax(made->all_high, r.high);
        }
        if (!to->what && r.decision != FW_ACCEPT) to->what = r.probe;
    }
}

/* how far the device as drawn would have to go to go as far, the body counts that would have to most */
static double farther_than_drawn(const fw_verdict_search *s, const amid *a) {
    const double hardly = 1e-3, *drawn = s->v->shaken ? s->v->shaken[a->scene].most : NULL;
    const int nh = s->v->nhinge, nb = s->v->mechanism->nbody;
    double farthest = 0, times = 1;
    for (int b = 0; drawn && b < nb; b++)
        farthest = fmax(farthest, drawn[nh + b]);
    for (int b = 0; drawn && b < nb; b++)
        if (drawn[nh + b] > hardly * farthest) times = fmax(times, a->goes[b] / drawn[nh + b]);
    return times;
}

/* ---- what is met ---- */

static bool is_met(const fw_verdict_reach *r) {
    return r->closes_m >= r->gap_m;
}

/* m by which a device that was run meets it with its modes anywhere; not above 0: it does not */
static double meets_by(const fw_verdict_reach *r, double up, double own) {
    const double softly = r->gives_m_per_N > 0 && r->stiff_N_per_m > 0
                              ? 1 / (r->gives_m_per_N * r->stiff_N_per_m)
                              : HUGE_VAL; /* K/k; not known: as hard as may be */
    if (is_met(r)) {
        const double o = r->closes_m - r->gap_m, more = fmax(1, up / own), g = fmax(r->gap_m, 0);
        if (more == 1) return o;
        return sqrt(more * more * o * o + softly * g * g * (more * more - 1));
    }
    const double far = fw_verdict_reach_takes(r, up);
    return far < r->gap_m ? 0 : fmax(DBL_MIN, sqrt(softly * (far * far - r->gap_m * r->gap_m)));
}

static bool same_reach(const fw_verdict_reach *a, const fw_verdict_reach *b) {
    return a->pin == b->pin && fw_text_same(a->id, b->id);
}

/* the blow of one thing that a device between corners may meet, over the hardest of those that were run */
static fw_status one_met(fw_verdict_search *s, const fw_verdict_reach *of, double most, amid *to) {
    double run = 0;
    for (int p = 0; p < s->fabricated->ncorner; p++) {
        const fw_verdict_shaken *there = s->fabricated->corner[p].shaken;
        for (int c = 0; there && c < there[to->scene].nreach; c++) {
            const fw_verdict_reach *r = &there[to->scene].reach[c];
            if (same_reach(r, of)) run = fmax(run, r->closes_m - r->gap_m);
        }
    }
    if (run > 0) {
        to->harder = fmax(to->harder, most / run);
        return FW_OK;
    }
    to->harder = HUGE_VAL;
    if (!to->met) FW_NEED(to->met = fw_verdict_reach_name(s->arena, s->v->mechanism, of));
    return FW_OK;
}

static fw_status amid_met(fw_verdict_search *s, int point, amid *to) {
    const fw_verdict_shaken *now = &s->fabricated->corner[point].shaken[to->scene];
    const int first = s->v->nhinge + s->v->mechanism->nbody;
    for (int c = 0; c < now->nreach; c++) {
        const double by = meets_by(&now->reach[c], to->each[first + c], now->each[first + c]);
        if (by > 0) FW_TRY(one_met(s, &now->reach[c], by, to));
    }
    return FW_OK;
}

/* ---- all of a scene ---- */

/* of every device that was run first what it meets, then what that leaves of hinges and requirements */
static fw_status look_between(fw_verdict_search *s, amid *to) {
    const fw_verdict_fabricated_verdict *f = s->fabricated;
    const int nh = s->v->nhinge, nb = s->v->mechanism->nbody;
    const size_t factors = 2 * (size_t)nh + 2, points = (size_t)f->ncorner;
    double *factor = fw_arena_array(s->arena, double, points *factors),
           *late = fw_arena_array(s->arena, double, points),
           **each = fw_arena_array(s->arena, double *, points);
    FW_NEED(factor && late && each ? factor : NULL);
    for (int p = 0; p < f->ncorner; p++) {
        const fw_verdict_shaken *there = f->corner[p].shaken;
        fw_verdict_shaken own;
        if (!there || there[to->scene].n == 0 || !fw_verdict_leads(s, to->scene, p)) continue;
        FW_TRY(fw_verdict_anywhere(s, to->scene, p, &own));
        to->factor = factor + (size_t)p * factors;
        FW_NEED(to->each = each[p] =
                    fw_arena_array(s->arena, double, (size_t)nh + (size_t)nb + (size_t)own.nreach));
        FW_TRY(fw_verdict_shaken_within(s->arena, s->v->mechanism, to->scene, &own,
                                        f->all ? FW_VERDICT_NO_SOFTER : FW_VERDICT_OF_ANY,
                                        to->factor, to->each, &late[p]));
        for (int b = 0; b < nb; b++)
            to->goes[b] = fmax(to->goes[b], own.most[nh + b] * to->each[nh + b]);
        FW_TRY(amid_met(s, p, to));
    }
    for (int p = 0; p < f->ncorner; p++) {
        const fw_verdict_shaken *there = f->corner[p].shaken;
        if (!there || !each[p]) continue;
        to->factor = factor + (size_t)p * factors, to->each = each[p], to->late = late[p];
        FW_TRY(amid_hinges(s, p, to->harder, to));
        amid_requirements(s, p, to->harder, to);
    }
    to->times = farther_than_drawn(s, to);
    for (int k = 0; k < s->v->nclearance; k++) {
        const fw_verdict_clearance *of = &s->v->clearance[k];
        if (!to->what && of->scene_index == to->scene && of->box == FW_NONE &&
            fw_verdict_may_come(of, to->times))
            to->what = "a distance between parts";
    }
    return FW_OK;
}

static fw_status tell_between(fw_verdict_search *s, const amid *a, fw_verdict_variant_verdict *v) {
    const fw_device_scene *scene = &s->device->scene[a->scene];
    const char *flow = v->variant->flow ? v->variant->flow : "this flow";
    char most[32];
    const char *text =
        a->met
            ? fw_arena_printf(
                  s->arena,
                  "as %s makes it a mode may lie where the law of %s%s shakes it hardest, and "
                  "%s may be met there, though at no corner of its ranges: everything goes up to "
                  "%s times as far as drawn, and what hinges and contacts bear then is not known; "
                  "leave it more room, keep the frequencies apart by more than the flow moves "
                  "them, or state what damps",
                  flow, FW_NAMED("scene", scene->name), a->met,
                  fw_number_text(most, sizeof most, a->times, 2))
            : fw_arena_printf(
                  s->arena,
                  "as %s makes it a mode may lie where the law of %s%s shakes it hardest, though "
                  "at no corner of its ranges: up to %s times what it does as drawn, and %s may "
                  "then be beyond its limit; keep the frequencies apart by more than the flow "
                  "moves them, or state what damps",
                  flow, FW_NAMED("scene", scene->name),
                  fw_number_text(most, sizeof most, a->times, 2), a->what);
    FW_NEED(s->fabricated->reason = text);
    s->fabricated->decision = v->decision = FW_INCONCLUSIVE;
    return fw_verdict_scene_reason(v, scene, a->met ? 731 : 636, FW_INCONCLUSIVE,
                                   FW_VERDICT_KEEP_HALF, text);
}

/* ---- rows as made ----
   What is said of a requirement, or of a hinge, as made is what its own band allows: that of all corners is wider than the one of
   any device that was run, by what lies between them and by hinges that differ. Test: test_heated.py, Rows; test_effects.py */

bool fw_verdict_row_settle(fw_verdict_requirement *made) {
    const bool held = !(fmin(made->low, made->all_low) < made->min) && /* NaN is passed */
                      !(fmax(made->high, made->all_high) > made->max);
    if (held || made->why || made->decision != FW_ACCEPT) return false;
    made->decision = FW_INCONCLUSIVE;
    return true;
}

const fw_verdict_requirement *fw_verdict_requirement_made(const fw_verdict_variant_verdict *v,
                                                          int k, int *corner) {
    const fw_verdict_fabricated_verdict *f = v->fabricated;
    if (!f || !f->requirement || f->requirement_corner[k] == FW_NONE) return NULL;
    *corner = f->requirement_corner[k];
    return &f->requirement[k];
}

void fw_verdict_requirement_band(const fw_verdict_requirement *r, double band[2]) {
    band[0] = isnan(r->all_low) ? r->low : r->all_low;
    band[1] = isnan(r->all_high) ? r->high : r->all_high;
}

/* the first of all that none of its devices, but its band may be beyond its limit; NULL: there is none */
static const char *settle_rows(fw_verdict_search *s) {
    fw_verdict_fabricated_verdict *f = s->fabricated;
    const char *first = NULL;
    for (int k = 0; f->requirement && k < s->v->nrequirement; k++)
        if (fw_verdict_row_settle(&f->requirement[k]) && !first)
            first = fw_verdict_requirement_text(s->arena, &f->requirement[k]);
    for (int h = 0; h < s->v->nhinge; h++) {
        fw_verdict_hinge_verdict *row = &f->corner[f->hinge[h].corner].hinge[h];
        if (row->decision == FW_ACCEPT && f->hinge[h].most >= 1) row->decision = FW_INCONCLUSIVE;
    }
    return first;
}

static fw_status tell_row(fw_verdict_search *s, const char *row, fw_verdict_variant_verdict *v) {
    FW_NEED(s->fabricated->reason = fw_arena_printf(
                s->arena,
                "as %s makes it no device that was run is beyond a limit, but one may be: %s",
                v->variant->flow ? v->variant->flow : "this flow", row));
    s->fabricated->decision = v->decision = FW_INCONCLUSIVE;
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = "as made",
                                                  .flow = v->variant->flow,
                                                  .number = 744,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = FW_VERDICT_KEEP_HALF,
                                                  .text = s->fabricated->reason};
    return FW_OK;
}

fw_status fw_verdict_between_corners(fw_verdict_search *s, fw_verdict_variant_verdict *v) {
    const fw_verdict_shaken *nominal =
        s->fabricated->ncorner > 1 ? s->fabricated->corner[0].shaken : NULL;
    double *goes = fw_arena_array(s->arena, double, (size_t)v->mechanism->nbody);
    bool accepted = s->fabricated->decision == FW_ACCEPT;
    FW_NEED(goes);
    for (int i = 0; nominal && i < s->device->nscene; i++) {
        amid a = {.scene = i, .goes = goes, .harder = 1};
        if (nominal[i].n == 0) continue;
        memset(goes, 0, (size_t)v->mechanism->nbody * sizeof *goes);
        FW_TRY(look_between(s, &a));
        if (!accepted || (!a.met && !a.what)) continue;
        FW_TRY(tell_between(s, &a, v));
        accepted = false;
    }
    const char *row = settle_rows(s);
    return row && accepted ? tell_row(s, row, v) : FW_OK;
}

double fw_verdict_band_above(const fw_verdict_search *s, int hinge) {
    double most = 1.0;
    for (int c = 0; c < s->fabricated->ncorner; c++) {
        const fw_verdict_hinge_verdict *h = &s->fabricated->corner[c].hinge[hinge];
        if (h->scene && h->utilisation > 0)
            most = fmax(most, h->utilisation_high / h->utilisation); /* NaN is passed */
    }
    return most;
}

/* ---- how many there may be, for who waits ---- */

/* No more points are run than the nominal one, one for the slopes of each input, all corners, each hinge alone and the
   patterns of hinges that differ. Usually first order leaves a few of them, which nobody knows before. */
fw_status fw_verdict_search_most(fw_verdict_search *s) {
    const unsigned fixed = fw_verdict_search_without_range(s->v);
    int free = 0, apart = 0;
    for (int i = 0; i < s->v->ninput; i++) {
        free += !(fixed >> i & 1u);
        if (s->v->input[i].local != 0.0) apart = s->device->nrevolute + FW_MOST_APART;
    }
    FW_NEED(s->told = fw_arena_one(s->arena, fw_progress_whole));
    *s->told = (fw_progress_whole){.what = "judging what a flow makes of it",
                                   .of = -(1.0 + free + (1u << free) + s->v->nsuspect + apart),
                                   .unit = "devices"};
    return FW_OK;
}
