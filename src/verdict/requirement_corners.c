/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requirements of what a flow makes: a band that holds at every corner of the ranges. Each requirement has two ends, the low and
   the high one of its band, which are followed as values: a utilisation has a kink where the other bound becomes the nearer one,
   and there is none where a bound is the drawn value. The corners where the low end is lowest and the high end highest to first
   order are run; elsewhere counts first order, widened by the largest error that it was seen to have. Theory:
   docs/theory/as-fabricated.md. Test: test_made.c. */
#include "base/text.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* an input that moves an end by less than this share of the value does not decide which corner is worst */
static const double fw_of_no_account = 2e-3;

static const fw_verdict_requirement *at_point(const fw_verdict_search *s, int point, int k) {
    const fw_verdict_requirement *list = s->fabricated->corner[point].requirement;
    return list && !list[k].why ? &list[k] : NULL;
}

/* NaN: it has no value there */
static double end_of(const fw_verdict_search *s, int point, int e) {
    const fw_verdict_requirement *r = at_point(s, point, e / 2);
    if (!r) return (double)NAN;
    return e % 2 ? r->high : r->low;
}

static bool is_known(const fw_verdict_search *s, int e) {
    return s->fabricated->ncorner > 0 && !isnan(end_of(s, 0, e));
}

/* ---- first order, in z (fw_verdict_end) ---- */

/* NaN: it has another sign there, or no value */
static double z_of(const fw_verdict_end *end, double value) {
    if (end->sign == 0) return value;
    return end->sign * value > 0 ? end->sign * log(end->sign * value) : (double)NAN;
}

static double value_of(const fw_verdict_end *end, double z) {
    return end->sign == 0 ? z : end->sign * exp(end->sign * z);
}

static double z_at(const fw_verdict_search *s, int point, int e) {
    return z_of(&s->end[e], end_of(s, point, e));
}

/* of all points so far; one that is no number everywhere has none */
static int sign_of(const fw_verdict_search *s, int e) {
    int sign = end_of(s, 0, e) > 0 ? 1 : -1;
    for (int p = 0; p < s->fabricated->ncorner; p++)
        if (!(sign * end_of(s, p, e) > 0)) return 0;
    return sign;
}

void fw_verdict_ends_slopes(fw_verdict_search *s) {
    const fw_verdict_fabrication_input *in = s->v->input;
    for (int e = 0; e < 2 * s->v->nrequirement; e++) {
        fw_verdict_end *end = &s->end[e];
        end->sign = sign_of(s, e);
        for (int i = 0; i < s->v->ninput; i++) {
            int like = s->slope_like[i], p = s->slope_point[i];
            if (like < i) end->slope[i] = end->slope[like] * in[i].edge_m / in[like].edge_m;
            if (p == FW_NONE) continue;
            end->slope[i] =
                (z_at(s, p, e) - z_at(s, 0, e)) / (s->fabricated->corner[p].x[i] - in[i].nominal);
        }
    }
}

static double estimate(const fw_verdict_search *s, int e, unsigned bits) {
    double x[FW_FABRICATION_INPUTS], z = z_at(s, 0, e);
    fw_verdict_search_corner_point(s, bits, x);
    for (int i = 0; i < s->v->ninput; i++)
        z += s->end[e].slope[i] * (x[i] - s->v->input[i].nominal);
    return z;
}

void fw_verdict_ends_compare(fw_verdict_search *s, int point) {
    for (int e = 0; e < 2 * s->v->nrequirement; e++) {
        double off = fabs(z_at(s, point, e) - estimate(s, e, s->bits[point]));
        if (isnan(off) && !isnan(end_of(s, point, e))) off = HUGE_VAL; /* another sign */
        s->end[e].error = fmax(s->end[e].error, off); /* no value: it is inconclusive there */
    }
}

bool fw_verdict_ends_unknown(const fw_verdict_search *s) {
    for (int e = 0; e < 2 * s->v->nrequirement; e++)
        for (int i = 0; is_known(s, e) && i < s->v->ninput; i++)
            if (isnan(s->end[e].slope[i])) return true;
    return false;
}

/* bits of the inputs that move an end by as much as counts */
static unsigned account(const fw_verdict_search *s, int e) {
    const fw_verdict_requirement *r = at_point(s, 0, e / 2);
    const fw_verdict_end *end = &s->end[e];
    double size = fmax(fabs(r->value), fmax(fabs(r->min), fabs(r->max))); /* NaN is passed */
    unsigned bits = 0;
    for (int i = 0; i < s->v->ninput; i++) {
        double range = s->v->input[i].high - s->v->input[i].low;
        if (fabs(end->slope[i]) * range >= fw_of_no_account * (end->sign ? 1 : size) &&
            fw_verdict_search_has_range(&s->v->input[i]))
            bits |= 1u << i;
    }
    return bits;
}

/* where the end is highest (up) or lowest; inputs of no account are low */
static unsigned end_corner(const fw_verdict_search *s, int e, bool up) {
    unsigned counts = account(s, e), bits = 0;
    for (int i = 0; i < s->v->ninput; i++)
        if ((counts >> i & 1u) && (s->end[e].slope[i] > 0) == up) bits |= 1u << i;
    return bits;
}

/* a corner that was run and differs in inputs of no account only; FW_NONE: there is none */
static int run_like(const fw_verdict_search *s, unsigned bits, unsigned counts) {
    for (int p = 0; p < s->fabricated->ncorner; p++)
        if (s->bits[p] != FW_NO_CORNER && ((s->bits[p] ^ bits) & counts) == 0) return p;
    return FW_NONE;
}

/* the end at a corner at most (up) or at least; NaN: not known there */
static double bound(const fw_verdict_search *s, int e, bool up, unsigned bits) {
    int p = run_like(s, bits, account(s, e));
    double z = estimate(s, e, bits);
    z +=
        p != FW_NONE ? z_at(s, p, e) - estimate(s, e, s->bits[p]) : (up ? 1 : -1) * s->end[e].error;
    return value_of(&s->end[e], z);
}

/* ---- what is still to be run ---- */

/* by how much an end may be beyond its bound at this corner, of its size; not above 0: it is within */
static double beyond(const fw_verdict_search *s, int e, unsigned bits) {
    const fw_verdict_requirement *r = at_point(s, 0, e / 2);
    bool up = e % 2;
    double limit = up ? r->max : r->min, size = fmax(fabs(r->value), fabs(limit));
    double off = up ? bound(s, e, up, bits) - limit : limit - bound(s, e, up, bits);
    return isnan(off) ? -HUGE_VAL : off / fmax(size, DBL_MIN);
}

/* at a corner that was run it is not met for certain: whether others are as bad decides nothing */
static bool is_settled(const fw_verdict_search *s, int e) {
    for (int p = 0; p < s->fabricated->ncorner; p++) {
        const fw_verdict_requirement *list = s->fabricated->corner[p].requirement;
        if (list && list[e / 2].decision != FW_ACCEPT) return true;
    }
    return false;
}

unsigned fw_verdict_ends_next(const fw_verdict_search *s) {
    const unsigned fixed = fw_verdict_search_without_range(s->v);
    unsigned next = FW_NO_CORNER;
    double most = 0;
    const bool trial = s->options.corners == FW_CORNERS_FIRST; /* nobody sees its bands */
    for (int e = 0; e < 2 * s->v->nrequirement && !trial; e++) {
        if (!is_known(s, e)) continue;
        unsigned bits = end_corner(s, e, e % 2);
        if (run_like(s, bits, account(s, e)) == FW_NONE) return bits;
    }
    for (int e = 0; e < 2 * s->v->nrequirement; e++)
        for (unsigned bits = 0; is_known(s, e) && !is_settled(s, e) && bits < 1u << s->v->ninput;
             bits++) {
            if ((bits & fixed) || fw_verdict_search_find(s, bits) != FW_NONE) continue;
            double off = beyond(s, e, bits);
            if (off > most) most = off, next = bits;
        }
    return next;
}

/* ---- what it says ---- */

static bool is_worse(const fw_verdict_requirement *a, const fw_verdict_requirement *b) {
    if (a->decision != b->decision) return fw_verdict_is_worse(a->decision, b->decision);
    return isnan(a->utilisation) || isnan(b->utilisation) ? a->margin < b->margin
                                                          : a->utilisation > b->utilisation;
}

void fw_verdict_ends_apart(fw_verdict_search *s, int point,
                           const fw_verdict_fabricated_corner *narrower) {
    for (int e = 0; narrower->requirement && e < 2 * s->v->nrequirement; e++) {
        const fw_verdict_requirement *r = &narrower->requirement[e / 2];
        fw_verdict_end *end = &s->end[e];
        const double was = end_of(s, point, e),
                     now = r->why ? (double)NAN : (e % 2 ? r->high : r->low);
        if (isnan(was) || isnan(now)) continue; /* it is undecided there */
        const double z = fabs(z_of(end, now) - z_of(end, was));
        end->apart[0] += isnan(z) ? HUGE_VAL : z, end->apart[1] += fabs(now - was);
    }
}

/* By what hinges that differ may change of it besides: by their shares; by their sum where one of them turns or empties it */
static double with_apart(const fw_verdict_end *end, double value, int way) {
    const double much = 1, z = z_of(end, value);
    if (end->apart[1] == 0) return value;
    return end->sign == 0 || isnan(z) || !(end->apart[0] < much)
               ? value + way * end->apart[1]
               : value_of(end, z + way * end->apart[0]);
}

/* over all corners; NaN where the nominal device is rejected and no other was run, and where it has no value at some corner */
static void cover(const fw_verdict_search *s, int k, fw_verdict_requirement *made) {
    const unsigned fixed = fw_verdict_search_without_range(s->v);
    made->all_low = made->all_high = (double)NAN;
    for (int p = 0; p < s->fabricated->ncorner; p++)
        if (s->first == 0 || !at_point(s, p, k)) return;
    for (int p = 0; p < s->fabricated->ncorner; p++) {
        if (s->fabricated->corner[p].sign) continue;
        made->all_low = fmin(made->all_low, end_of(s, p, 2 * k));
        made->all_high = fmax(made->all_high, end_of(s, p, 2 * k + 1));
    }
    bool size = isnan(made->origin) && made->all_low >= 0; /* and not below 0 */
    for (unsigned bits = 0; bits < 1u << s->v->ninput; bits++) {
        if ((bits & fixed) || fw_verdict_search_find(s, bits) != FW_NONE) continue;
        made->all_low = fmin(made->all_low, bound(s, 2 * k, false, bits));
        made->all_high = fmax(made->all_high, bound(s, 2 * k + 1, true, bits));
    }
    made->all_low = with_apart(&s->end[2 * k], made->all_low, -1);
    made->all_high = with_apart(&s->end[2 * k + 1], made->all_high, 1);
    for (int p = 0; p < s->fabricated->ncorner; p++) {
        made->all_low = fmin(made->all_low, end_of(s, p, 2 * k));
        made->all_high = fmax(made->all_high, end_of(s, p, 2 * k + 1));
    }
    if (size) made->all_low = fmax(made->all_low, 0);
}

fw_status fw_verdict_ends_made(fw_verdict_search *s) {
    fw_verdict_fabricated_verdict *f = s->fabricated;
    size_t n = (size_t)s->v->nrequirement;
    FW_NEED(f->requirement = fw_arena_array(s->arena, fw_verdict_requirement, n));
    FW_NEED(f->requirement_corner = fw_arena_array(s->arena, int, n));
    for (int k = 0; k < s->v->nrequirement; k++) {
        const fw_verdict_requirement *worst = NULL;
        for (int p = 0; p < f->ncorner; p++) {
            const fw_verdict_requirement *list = f->corner[p].requirement;
            if (!list || (worst && !is_worse(&list[k], worst))) continue;
            worst = &list[k], f->requirement_corner[k] = p;
        }
        f->requirement[k] = worst ? *worst : s->v->requirement[k];
        if (!worst) f->requirement_corner[k] = FW_NONE;
        cover(s, k, &f->requirement[k]);
    }
    return FW_OK;
}

const char *fw_verdict_ends_why(fw_verdict_search *s, int corner) {
    const fw_verdict_fabricated_verdict *f = s->fabricated;
    const fw_verdict_fabricated_corner *c = &f->corner[corner];
    for (int k = 0; c->why && f->requirement && c->requirement && k < s->v->nrequirement; k++) {
        if (f->requirement_corner[k] != corner) continue;
        const char *own = fw_verdict_requirement_text(s->arena, &c->requirement[k]), *made;
        if (own && strncmp(own, c->why, strlen(own)) != 0) continue;
        made = own ? fw_verdict_requirement_text(s->arena, &f->requirement[k]) : NULL;
        return made ? fw_arena_printf(s->arena, "%s%s", made, c->why + strlen(own)) : NULL;
    }
    return c->why ? c->why : "it is not accepted";
}

/* ---- how much further edges may lie ----
   Room of one check, r = (z_limit - z_most)/|dz/de| with z_most at the corner that is worst for it (its band and what first
   order was off by included), and de the way of an edge; the least of all hinges in all scenes, requirements at both their
   bounds, distances, pull-in, and what tips. In: what the search has run; where a plate is asked for one device more, and three at
   most: the corner with the least room with its edges further out, whose |dz/de| counts where it is more. Out: m of every
   edge, either way. Range: first order, so that who uses it takes half, and goes no further than the corners went again.
   Test: test_ranges.c, room_of_edges; test_third_flow.py, OrderedPlate. */

bool fw_verdict_search_edges_only(const fw_verdict_fabrication_input *in) {
    return fw_verdict_search_has_range(in) && in->edge_m != 0.0 && in->flare_m == 0.0 &&
           in->thickness == 0.0 && in->youngs == 0.0 && in->expansion == 0.0 &&
           in->substrate == 0.0;
}

/* ln of the most that a check uses at any corner */
static double most_of(const fw_verdict_search *s, int check) {
    const int n = s->v->ninput;
    double most = -HUGE_VAL, first = s->ln[check];
    unsigned worst = 0;
    for (int p = 0; p < s->fabricated->ncorner; p++)
        most = fmax(most, s->ln[(size_t)p * (size_t)s->ncheck + (size_t)check]); /* NaN is passed */
    for (int i = 0; i < n; i++) {
        const fw_verdict_fabrication_input *in = &s->v->input[i];
        const double slope = s->slope[check * n + i];
        if (!fw_verdict_search_has_range(in)) continue;
        worst |= slope > 0.0 ? 1u << i : 0u;
        first += slope * ((slope > 0.0 ? in->high : in->low) - in->nominal);
    }
    if (s->fabricated->all || fw_verdict_search_find(s, worst) != FW_NONE) return most;
    return fmax(most, first + (check < s->nplane ? s->fabricated->error : s->across_error));
}

/* ln of the upper end of a hinge's band at any corner. Each that was run has a band of its own, as close as its decision
   asked for: the verdict stands on the upper end of each, and not on the widest band at the most that is used. Of those
   that were not run, of hinges that differ and of a resonance between corners the bound, with the band of the worst that
   was. Test: tests/cli/test_third_flow.py, OrderedPlate */
static double upper_end(const fw_verdict_search *s, int check) {
    const fw_verdict_fabricated_verdict *f = s->fabricated;
    const int k = check / (s->device->nscene + 1);
    const fw_verdict_fabricated_hinge *h = &f->hinge[k];
    const fw_verdict_hinge_verdict *worst = &f->corner[h->corner].hinge[k];
    const double bound = log(h->most), band = log(worst->utilisation_high / worst->utilisation);
    double most = -HUGE_VAL;
    bool apart = false;
    for (int p = 0; p < f->ncorner; p++) {
        const fw_verdict_hinge_verdict *is = &f->corner[p].hinge[k];
        const double ln = s->ln[(size_t)p * (size_t)s->ncheck + (size_t)check];
        const double high =
            fmin(ln + log(is->utilisation_high / is->utilisation), log(is->utilisation_high));
        most = fmax(most, fmax(ln, high)); /* NaN is passed */
    }
    for (int i = 0; i < s->v->ninput; i++)
        apart = apart || s->v->input[i].local != 0.0;
    if (!(h->most > (worst->utilisation + worst->numeric) * (1 + 1e-9))) return most;
    return fmax(most, (apart ? bound : fmin(bound, most_of(s, check))) + fmax(band, 0));
}

enum { LOOKS = 3 };

typedef struct outwards { /* a corner, and the way that its edges go */
    int corner, way;
} outwards;

static bool is_same(outwards a, outwards b) {
    return a.corner == b.corner && a.way == b.way;
}

typedef struct edges {
    fw_verdict_search *s;
    int input;   /* whose slopes are those of edges */
    double room; /* the least so far */
    const char *says;
    outwards worst, now; /* of what has the least room; of what is looked at */
    struct {             /* (nlook) corners with edges that lie further by moved_m */
        outwards of;
        double moved_m, *ln;
        fw_verdict_fabricated_corner is;
    } look[LOOKS];
    int nlook;
} edges;

/* what a point has of a check, or, below 0, of end -1 - `of` */
static double z_at_point(const fw_verdict_search *s, int of, int point) {
    return of < 0 ? z_at(s, point, -1 - of) : s->ln[(size_t)point * (size_t)s->ncheck + (size_t)of];
}

/* the same of look k */
static double z_at_look(const edges *e, int of, int k) {
    const fw_verdict_requirement *r = e->look[k].is.requirement;
    if (of >= 0) return e->look[k].ln[of];
    r = r && !r[(-1 - of) / 2].why ? &r[(-1 - of) / 2] : NULL;
    return r ? z_of(&e->s->end[-1 - of], (-1 - of) % 2 ? r->high : r->low) : (double)NAN;
}

/* Per m of an edge: first order about the nominal device, and where somebody has looked further out from the corner that is
   worst (up: has most) what it is from there, if that is more: what is thin there bends by more than what is drawn */
static double steepest(edges *e, int of, bool up, double slope) {
    const fw_verdict_search *s = e->s;
    int worst = FW_NONE;
    for (int p = 0; p < s->fabricated->ncorner; p++) {
        const double z = z_at_point(s, of, p);
        if (s->fabricated->corner[p].sign || isnan(z)) continue;
        const double most = worst == FW_NONE ? z : z_at_point(s, of, worst);
        if (worst == FW_NONE || (up ? z > most : z < most)) worst = p;
    }
    e->now = (outwards){worst, (slope > 0) == up ? 1 : -1};
    for (int k = 0; k < e->nlook; k++) {
        if (!is_same(e->look[k].of, e->now)) continue;
        const double by =
            (z_at_look(e, of, k) - z_at_point(s, of, worst)) / (e->now.way * e->look[k].moved_m);
        if (isnan(by) || (by * slope > 0 && fabs(by) > fabs(slope))) slope = by;
    }
    return slope;
}

/* "lines 0.1 um wider change that by -0.0137 %": a line that is wider by d has each edge moved by d/2;
   unit NULL: a share */
static fw_status keep(edges *e, double room, const char *what, double per_edge, const char *unit) {
    if (!(room < e->room) && !(isnan(room) && !isnan(e->room))) return FW_OK;
    const double wider = 0.1e-6;
    char change[FW_PROBE_TEXT];
    const double by = 0.5 * per_edge * wider;
    if (unit)
        fw_probe_text(change, by, unit);
    else
        fw_number_text(change, sizeof change - 2, 100 * by, 3), strcat(change, " %");
    FW_NEED(what);
    e->room = room, e->worst = e->now;
    FW_NEED(e->says = isnan(per_edge)
                          ? fw_arena_printf(e->s->arena,
                                            "%s: how it changes with a width is not known", what)
                          : fw_arena_printf(e->s->arena, "%s; lines 0.1 um wider change that by %s",
                                            what, change));
    return FW_OK;
}

/* "hinge D: at most 2.62 % of its limit" */
static const char *name_of(const fw_verdict_search *s, int check, double most) {
    const int scenes = s->device->nscene, hinges = s->v->nhinge * (scenes + 1);
    const int distances = hinges + scenes + s->v->nrequirement;
    const fw_device_scene *scene = s->device->scene;
    char used[32];
    fw_percent_text(used, sizeof used, most);
    if (check < hinges)
        return fw_arena_printf(s->arena, "%s%s: at most %s %% of its limit",
                               FW_NAMED("hinge", s->v->hinge[check / (scenes + 1)].id), used);
    if (check < hinges + scenes)
        return fw_arena_printf(s->arena, "pull-in of %s%s: at most %s %% of its limit",
                               FW_NAMED("scene", scene[check - hinges].name), used);
    if (check >= s->nplane)
        return fw_arena_printf(s->arena, "out of its plane in %s%s: at most %s %% of its limit",
                               FW_NAMED("scene", scene[(check - s->nplane) % scenes].name), used);
    if (check >= distances + scenes)
        return fw_arena_printf(s->arena, "distances over required poses: at most %s %% used", used);
    return fw_arena_printf(s->arena, "distances in %s%s: at most %s %% used",
                           FW_NAMED("scene", scene[check - distances].name), used);
}

static fw_status room_of_check(edges *e, int check) {
    fw_verdict_search *s = e->s;
    const int scenes = s->device->nscene, hinges = s->v->nhinge * (scenes + 1), n = s->v->ninput;
    const int distances = hinges + scenes + s->v->nrequirement;
    const bool distance = check >= distances && check < s->nplane;
    double most = most_of(s, check), limit = check < s->nplane ? 0.0 : log(FW_NEAR_TIPPING);
    double least = check >= s->nplane ? FW_FLAT_BELOW
                   : distance         ? fw_verdict_clearance_counts
                                      : 0.0;
    const double slope =
        steepest(e, check, true, s->slope[check * n + e->input] / s->v->input[e->input].edge_m);
    if (check < hinges) most = upper_end(s, check);
    if (most < log(least) || (isnan(slope) && most < log(FW_FAR_BELOW)) || slope == 0.0)
        return FW_OK;
    return keep(e, fmax(0.0, limit - most) / fabs(slope), name_of(s, check, exp(most)),
                exp(most) * slope, NULL);
}

/* of one bound of a requirement; both as they are, where the bound has another sign */
static fw_status room_of_end(edges *e, int end) {
    fw_verdict_search *s = e->s;
    const fw_verdict_requirement *made = &s->fabricated->requirement[end / 2];
    const bool up = end % 2;
    const double bound = up ? made->max : made->min, worst = up ? made->all_high : made->all_low;
    const fw_verdict_end *of = &s->end[end];
    const double slope =
        steepest(e, -1 - end, up, of->slope[e->input] / s->v->input[e->input].edge_m);
    const double size = of->sign ? fabs(worst) : 1.0; /* dv/dz */
    double way = z_of(of, bound) - z_of(of, worst), per = slope;
    char is[FW_PROBE_TEXT], asked[FW_PROBE_TEXT];
    if (isnan(bound) || slope == 0.0) return FW_OK;
    if (isnan(way)) way = bound - worst, per = slope * size;
    const char *what = fw_arena_printf(s->arena, "%s%s (%s): at %s %s at any corner, %s required",
                                       FW_NAMED("requirement", made->probe),
                                       made->measure ? made->measure : made->kind,
                                       up ? "most" : "least", fw_probe_text(is, worst, made->unit),
                                       fw_probe_text(asked, bound, made->unit));
    return keep(e, fmax(0.0, up ? way : -way) / fabs(per), what, slope * size, made->unit);
}

static fw_status room_of_all(edges *e) {
    fw_verdict_search *s = e->s;
    const int requirements = s->v->nhinge * (s->device->nscene + 1) + s->device->nscene;
    e->room = HUGE_VAL, e->says = "nothing asked changes with edges", e->worst.corner = FW_NONE;
    for (int r = 0; r < s->ncheck; r++)
        if ((r < requirements || r >= requirements + s->v->nrequirement) && !isnan(s->ln[r]))
            FW_TRY(room_of_check(e, r));
    for (int k = 0; k < 2 * s->v->nrequirement; k++)
        FW_TRY(room_of_end(e, k));
    return FW_OK;
}

/* the corner that leaves least room, with its edges out by as much as there seems to be, and as far as corners have gone at
   most; *more false: that is known, or there is no room */
static fw_status look_outwards(edges *e, double looked_m, bool *more) {
    fw_verdict_search *s = e->s;
    const double moved_m = fmin(e->room, looked_m);
    double x[FW_FABRICATION_INPUTS];
    *more = e->worst.corner != FW_NONE && moved_m > 0 && e->nlook < LOOKS;
    for (int k = 0; k < e->nlook; k++)
        *more = *more && !is_same(e->look[k].of, e->worst);
    if (!*more) return FW_OK;
    memcpy(x, s->fabricated->corner[e->worst.corner].x, (size_t)s->v->ninput * sizeof *x);
    x[e->input] += e->worst.way * moved_m / s->v->input[e->input].edge_m;
    e->look[e->nlook].of = e->worst, e->look[e->nlook].moved_m = moved_m;
    FW_NEED(e->look[e->nlook].ln = fw_arena_array(s->arena, double, (size_t)s->ncheck));
    FW_TRY(fw_verdict_search_point(s, x, &e->look[e->nlook].is, e->look[e->nlook].ln));
    s->judged++, e->nlook++;
    return FW_OK;
}

fw_status fw_verdict_edge_room_made(fw_verdict_search *s) {
    const fw_device_wafer_asked *w = &s->device->wafer;
    edges e = {.s = s, .input = FW_NONE};
    double looked = 0.0;
    for (int i = s->v->ninput - 1; i >= 0; i--) {
        const fw_verdict_fabrication_input *in = &s->v->input[i];
        if (!fw_verdict_search_edges_only(in)) continue;
        looked += fabs(in->edge_m) * fmin(in->high - in->nominal, in->nominal - in->low);
        e.input = i;
    }
    s->fabricated->room = (fw_verdict_edge_room){.edge_m = (double)NAN};
    if (e.input == FW_NONE || s->first == 0) return FW_OK;
    FW_TRY(room_of_all(&e));
    for (bool more = w->asked || w->written; more;) { /* else nobody orders a plate by it */
        FW_TRY(look_outwards(&e, looked, &more));
        if (more) FW_TRY(room_of_all(&e));
    }
    s->fabricated->room = (fw_verdict_edge_room){e.says, e.room, looked};
    return FW_OK;
}

/* ---- between corners ----
   A corner at which a mode is lower and one at which it is higher may both be shaken less than a device between them,
   whose mode is where the law is. Of each mode that swings at the nominal device

     ln w = ln w0 + sum of slopes d ln w/dx (x - x0)

   over all ranges, by the runs that slopes are made of, and at least what was met at any corner; with the error at either
   end. Of devices alone that the same contacts hold: a jaw that presses has another mode than one that is open, which is no
   softness of any die. Every device that was run is widened by what it may do anywhere there (fw_verdict_shaken_within), loads by its
   stiffness, too, and the most of all counts: of dies at one frequency that goes farthest which weighs least, and ranges have
   their lightest die at a corner; it is softer than the nominal one by more than its frequency says. All that is as made has
   it: bands of requirements, what a hinge uses at most (held_ranges.c). Test: test_effects.py Resonance */

/* a mode as it is at a point, of what is held as `like`; NULL: nothing is known of it there */
static const fw_verdict_shaken_mode *mode_at(const fw_verdict_search *s, int point, int scene,
                                             int number, const fw_verdict_shaken *like) {
    const fw_verdict_shaken *there = s->fabricated->corner[point].shaken;
    for (int k = 0; there && fw_verdict_held_alike(&there[scene], like) && k < there[scene].n; k++)
        if (there[scene].mode[k].number == number) return &there[scene].mode[k];
    return NULL;
}

static void hold_mode(const fw_verdict_shaken_mode *at, fw_verdict_shaken_mode *mode) {
    mode->low = fmin(mode->low, at->low), mode->high = fmax(mode->high, at->high);
    mode->soft = fmin(mode->soft, at->soft), mode->stiff = fmax(mode->stiff, at->stiff);
}

/* of the nominal device; by[2]: ln of how far down and up its range is from it */
static void spread_mode(const fw_verdict_search *s, int scene, fw_verdict_shaken_mode *mode,
                        double by[2]) {
    const fw_verdict_fabrication_input *in = s->v->input;
    const fw_verdict_shaken *own = &s->fabricated->corner[0].shaken[scene];
    const double w = mode->omega;
    double slope[FW_FABRICATION_INPUTS] = {0}, up = 0, down = 0;
    for (int i = 0; i < s->v->ninput && s->first > 0; i++) {
        const int like = s->slope_like[i], p = s->slope_point[i];
        const fw_verdict_shaken_mode *at =
            p == FW_NONE ? NULL : mode_at(s, p, scene, mode->number, own);
        if (like < i) slope[i] = slope[like] * in[i].edge_m / in[like].edge_m;
        if (at) slope[i] = log(at->omega / w) / (s->fabricated->corner[p].x[i] - in[i].nominal);
        if (!fw_verdict_search_has_range(&in[i])) continue;
        const double a = slope[i] * (in[i].high - in[i].nominal),
                     b = slope[i] * (in[i].low - in[i].nominal);
        up += fmax(0, fmax(a, b)), down += fmin(0, fmin(a, b));
    }
    mode->low *= exp(down), mode->high *= exp(up);
    mode->soft *= exp(down), mode->stiff *= exp(up);
    by[0] = down, by[1] = up;
    for (int p = 0; p < s->fabricated->ncorner; p++) {
        const fw_verdict_shaken_mode *at = mode_at(s, p, scene, mode->number, own);
        if (at) hold_mode(at, mode);
    }
}

fw_status fw_verdict_anywhere(const fw_verdict_search *s, int scene, int point,
                              fw_verdict_shaken *to) {
    const fw_verdict_shaken *nominal = &s->fabricated->corner[0].shaken[scene];
    *to = s->fabricated->corner[point].shaken[scene];
    const size_t n = (size_t)to->n;
    FW_NEED(to->mode = fw_arena_grow(s->arena, to->mode, n, n, sizeof *to->mode));
    for (int k = 0; k < to->n; k++) {
        fw_verdict_shaken_mode *mode = &to->mode[k];
        for (int p = 0; p < s->fabricated->ncorner; p++) {
            const fw_verdict_shaken_mode *at = mode_at(s, p, scene, mode->number, to);
            if (at) hold_mode(at, mode);
        }
        for (int i = 0; i < nominal->n; i++) {
            fw_verdict_shaken_mode wide = nominal->mode[i];
            double by[2];
            if (wide.number != mode->number) continue;
            spread_mode(s, scene, &wide, by);
            if (!fw_verdict_held_alike(
                    nominal, to)) { /* as far from itself as two dies are from each other */
                wide = *mode;
                wide.low *= exp(by[0] - by[1]), wide.soft *= exp(by[0] - by[1]);
                wide.high *= exp(by[1] - by[0]), wide.stiff *= exp(by[1] - by[0]);
            }
            hold_mode(&wide, mode);
        }
    }
    return FW_OK;
}
