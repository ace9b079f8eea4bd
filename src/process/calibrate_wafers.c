/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coupons of a lot: several wafers, several sites of each. And what is asked after, in what is given and in what is found. */
#include "process/coupon.h"
#include "process/pack.h"
#include "maths/functions.h"
#include <math.h>
#include <string.h>

enum { MOST_WAFERS = 64, MOST_IDS = FW_COUPON_RESULTS + FW_COUPON_USED };

typedef struct wafer { /* calibrated by itself */
    const char *name;
    fw_process_measurement *row; /* (nrow) */
    double *chance, *shared; /* (nrow) standard uncertainties: of the sites, of the instrument */
    int *reading;            /* (nrow) which one it was */
    int nrow;
    fw_process_calibration found;
    fw_process_covariance of_chance, of_shared;
} wafer;

typedef struct lot {
    fw_arena *arena;
    const fw_process_flow *flow;
    const fw_process_readings *readings;
    fw_diags *diags;
    wafer *wafer; /* (nwafer) */
    int nwafer;
    const char *id[MOST_IDS]; /* (nid) items of any wafer, then what the coupons used of the flow */
    int nid, nitem;
} lot;

static bool alike(const fw_process_reading *a, const fw_process_reading *b) {
    return strcmp(a->row.coupon, b->row.coupon) == 0 && strcmp(a->row.feature, b->row.feature) == 0;
}

/* of the same, too: edges of resist and of metal do not scatter alike */
static bool scatter_alike(const fw_process_reading *a, const fw_process_reading *b) {
    return alike(a, b) && fw_text_same(a->row.of, b->row.of);
}

/* Two standard uncertainties stand for 95.45 % of a normal distribution wherever the plan uses them. A deviation that is
   known from n degrees of freedom only is widened by t(97.725 %, n)/2, so that they do so here.
   Source: JCGM 100:2008, G.3. Test: test_wafers.c, coverage. */
static double widened(int n) {
    return 0.5 * fw_maths_student_quantile(0.97724986805182079, n);
}

/* Of the sites of one reading: s^2/nsite, s pooled over all readings of the same coupon and feature, which scatter alike,
   s^2 = sum of squares/sum(nsite - 1). *freedom: that sum; 0: one site each, and nothing is known */
static double chance_of(const fw_process_readings *all, const fw_process_reading *of,
                        int *freedom) {
    double squares = 0.0;
    *freedom = 0;
    for (int i = 0; i < all->n; i++)
        if (scatter_alike(&all->item[i], of) && all->item[i].nsite > 1) {
            squares += all->item[i].squares;
            *freedom += all->item[i].nsite - 1;
        }
    if (*freedom == 0 || of->nsite == 0) return 0.0;
    return sqrt(squares / *freedom / of->nsite) * widened(*freedom);
}

static fw_status add_row(lot *l, wafer *w, int index) {
    const fw_process_reading *r = &l->readings->item[index];
    int freedom;
    double chance = chance_of(l->readings, r, &freedom);
    w->row[w->nrow] = r->row;
    w->chance[w->nrow] = chance;
    w->shared[w->nrow] = r->row.uncertainty;
    w->reading[w->nrow] = index;
    w->row[w->nrow].uncertainty = r->nsite == 0 ? 1.0 : hypot(chance, r->row.uncertainty);
    if (!(w->row[w->nrow++].uncertainty > 0.0))
        return fw_diag_error(l->diags, 211, r->row.place,
                             "all sites of %s read the same, so that nothing says how exactly: add "
                             "u=, the standard uncertainty of the instrument",
                             r->row.coupon);
    return FW_OK;
}

/* ---- one reading that was logged twice ---- */

/* but for rounding, as sites in another order have it */
static bool same_number(double a, double b) {
    return (isnan(a) && isnan(b)) || fabs(a - b) <= 1e-9 * fmax(fabs(a), fabs(b));
}

/* Sites of one coupon of one wafer that read the very same are one reading, at whatever steps it was logged. The scatter of
   sites is far above the last digit, so that two do not agree by chance in all of them. */
static bool same_reading(const fw_process_reading *a, const fw_process_reading *b) {
    return alike(a, b) && strcmp(a->wafer, b->wafer) == 0 && a->nsite == b->nsite &&
           same_number(a->row.value, b->row.value) && same_number(a->row.drawn_m, b->row.drawn_m) &&
           same_number(a->row.at, b->row.at) &&
           (a->nsite < 2 || fabs(sqrt(a->squares) - sqrt(b->squares)) <= 1e-9 * fabs(a->row.value));
}

/* each once: `kept` is what counts */
static fw_status leave_out_copies(fw_arena *arena, const fw_process_readings *all, fw_diags *diags,
                                  fw_process_readings *kept) {
    *kept = *all;
    kept->n = 0;
    FW_NEED(kept->item = fw_arena_array(arena, fw_process_reading, (size_t)all->n + 1));
    for (int i = 0; i < all->n; i++) {
        const fw_process_reading *now = &all->item[i];
        int before = 0;
        while (before < kept->n && !same_reading(&kept->item[before], now))
            before++;
        if (before == kept->n) {
            kept->item[kept->n++] = *now;
            continue;
        }
        const fw_process_reading *was = &kept->item[before];
        fw_diag_warning(
            diags, 662, now->row.place,
            "%s of step %s%s%s reads site by site what line %d has of step %s: it is one "
            "reading, and counts once",
            now->row.coupon, now->step, now->wafer[0] ? ", wafer " : "", now->wafer,
            was->row.place.line, was->step);
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

static fw_status wafer_of(lot *l, const char *name, wafer **w) {
    for (int i = 0; i < l->nwafer; i++)
        if (strcmp(l->wafer[i].name, name) == 0) {
            *w = &l->wafer[i];
            return FW_OK;
        }
    if (l->nwafer == MOST_WAFERS) return FW_LIMIT;
    size_t n = (size_t)l->readings->n;
    *w = &l->wafer[l->nwafer++];
    (*w)->name = name;
    FW_NEED((*w)->row = fw_arena_array(l->arena, fw_process_measurement, n));
    FW_NEED((*w)->chance = fw_arena_array(l->arena, double, n));
    FW_NEED((*w)->shared = fw_arena_array(l->arena, double, n));
    FW_NEED((*w)->reading = fw_arena_array(l->arena, int, n));
    return FW_OK;
}

static fw_status note_ids(lot *l, const wafer *w, bool items) {
    int from = items ? 0 : w->found.count, to = items ? w->found.count : w->of_shared.m;
    for (int k = from; k < to; k++) {
        bool known = items && w->found.item[k].of_wafer;
        for (int i = 0; i < l->nid; i++)
            known = known || strcmp(l->id[i], w->of_shared.id[k]) == 0;
        if (known) continue;
        if (l->nid == MOST_IDS) return FW_LIMIT;
        l->id[l->nid++] = w->of_shared.id[k];
    }
    return FW_OK;
}

static fw_status calibrate_each(lot *l) {
    fw_status status = FW_OK;
    for (int i = 0; i < l->nwafer; i++) {
        wafer *w = &l->wafer[i];
        size_t said = l->diags->count;
        fw_status of_wafer =
            fw_process_calibrate(l->arena, l->flow, w->row, w->nrow, l->diags, &w->found);
        if (of_wafer == FW_INPUT) {
            status = FW_INPUT;
            for (size_t d = said; w->name[0] && d < l->diags->count; d++)
                FW_NEED(l->diags->item[d].message = fw_arena_printf(
                            l->arena, "wafer %s: %s", w->name, l->diags->item[d].message));
            continue;
        }
        FW_TRY(of_wafer);
        FW_TRY(fw_process_coupon_covariance(l->arena, l->flow, w->row, w->nrow, &w->found,
                                            w->chance, false, &w->of_chance));
        FW_TRY(fw_process_coupon_covariance(l->arena, l->flow, w->row, w->nrow, &w->found,
                                            w->shared, true, &w->of_shared));
    }
    FW_TRY(status);
    for (int i = 0; i < l->nwafer; i++)
        FW_TRY(note_ids(l, &l->wafer[i], true));
    l->nitem = l->nid;
    for (int i = 0; i < l->nwafer; i++)
        FW_TRY(note_ids(l, &l->wafer[i], false));
    return FW_OK;
}

/* which of a wafer's results has the id; -1: none. Where its edge is otherwise than planned is none */
static int at(const wafer *w, const char *id) {
    for (int i = 0; i < w->of_shared.m; i++)
        if (strcmp(w->of_shared.id[i], id) == 0)
            return i < w->found.count && w->found.item[i].of_wafer ? -1 : i;
    return -1;
}

typedef struct moments { /* of one id over the wafers that have it */
    int n;
    double mean, variance;       /* of the values; variance of one wafer, n - 1 */
    double chance, shared, rest; /* variances: mean of the wafers' own; rest of the fit's */
    double between, u;           /* scatter from wafer to wafer, variance; what is stated */
    double gain; /* of the part of u that is chance once more; 0: wafers differ by more */
} moments;

/* what the fit states beyond what its rows carry (a ladder read by what stands) */
static double rest_of(const wafer *w, int k) {
    double u = w->found.item[k].uncertainty;
    int m = w->of_shared.m;
    return fmax(u * u - w->of_chance.C[k * m + k] - w->of_shared.C[k * m + k], 0.0);
}

/* u^2 = (chance + rest)/W + shared + b (1 + 1/W). shared, of the instrument and of what all wafers were measured under,
   does not average out. The last term is there because the plan is about the next wafer, not about the mean of these:
   b = variance (t(W - 1)/2)^2 - chance - rest, what really differs from wafer to wafer, widened for the few that there
   are, but at least (chance + rest) sqrt(2/(W - 1)), the standard uncertainty of such an estimate where nothing differs: a
   scatter that cannot be seen is not taken to be absent. Then it is correlated as chance is. One wafer: b is not known, and
   what the flow has for it is added (coupon_fit.c).
   Source: DerSimonian and Laird, Control. Clin. Trials 7 (1986) 177 (moments); JCGM 100:2008, G.3 and E.4.3 (deviation of
   a variance). Test: test_wafers.c, coverage. */
static moments moments_of(const lot *l, const char *id, const wafer *without) {
    moments o = {0};
    for (int i = 0; i < l->nwafer; i++) {
        const wafer *w = &l->wafer[i];
        int k = at(w, id), m = w->of_shared.m;
        if (k < 0 || k >= w->found.count || w == without) continue;
        o.n++;
        o.mean += w->found.item[k].value;
        o.chance += w->of_chance.C[k * m + k];
        o.shared += w->of_shared.C[k * m + k];
        o.rest += rest_of(w, k);
    }
    o.mean /= o.n, o.chance /= o.n, o.shared /= o.n, o.rest /= o.n;
    for (int i = 0; i < l->nwafer; i++) {
        int k = at(&l->wafer[i], id);
        if (k < 0 || k >= l->wafer[i].found.count || &l->wafer[i] == without) continue;
        double off = l->wafer[i].found.item[k].value - o.mean;
        o.variance += o.n > 1 ? off * off / (o.n - 1) : 0.0;
    }
    double own = o.chance + o.rest, wide = o.n > 1 ? widened(o.n - 1) : 0.0, next = 1.0 + 1.0 / o.n;
    double unseen = o.n > 1 ? own * sqrt(2.0 / (o.n - 1)) : 0.0;
    o.between = fmax(o.variance - own, 0.0);
    double b = fmax(o.variance * wide * wide - own, unseen);
    if (o.between < unseen) o.gain = sqrt(b / own * next); /* nothing says that they differ */
    o.u = sqrt(own / o.n + o.shared + b * next);
    return o;
}

/* covariance of two means: what is by chance is independent from wafer to wafer, what is shared is the same in all */
static double covariance_of(const lot *l, const char *a, const char *b, double gains) {
    double chance = 0.0, shared = 0.0;
    int na = 0, nb = 0, both = 0;
    for (int i = 0; i < l->nwafer; i++) {
        const wafer *w = &l->wafer[i];
        int p = at(w, a), q = at(w, b), m = w->of_shared.m;
        na += p >= 0, nb += q >= 0;
        if (p < 0 || q < 0) continue;
        both++;
        chance += w->of_chance.C[p * m + q];
        shared += w->of_shared.C[p * m + q];
    }
    if (both == 0) return 0.0;
    return chance / ((double)na * nb) + shared / both + gains * chance / both;
}

/* ---- in words ---- */

/* Relatively, of what lies on one side of 0; where an edge lies, or a slope, may be 0 itself, and differs by so much of its
   unit. Test: test_wafers.c, edges_about_nothing */
static void put_spread(const lot *l, const char *id, double part, double whole, fw_text *out) {
    const fw_quantity *of = fw_process_flow_quantity(l->flow, id);
    fw_quantity below = of ? *of : (fw_quantity){0};
    fw_quantity_unit unit;
    fw_diags quiet = fw_diags_new(l->arena);
    below.value = -1e-9 * part, below.unknown = false;
    if (of && part > 0.0 && fw_process_quantity_in_range(&below, &quiet) &&
        fw_quantity_unit_parse(of->unit, strlen(of->unit), &unit, NULL, NULL)) {
        unit.offset = 0.0;
        fw_text_number(out, fw_quantity_unit_from_si(&unit, part), 2);
        fw_text_printf(out, " %s", of->unit);
        return;
    }
    fw_text_number(out, whole != 0.0 ? 100.0 * part / fabs(whole) : 0.0, 2);
    fw_text_add(out, " %");
}

static fw_status note_of(const lot *l, const moments *o, const char *id, const char *first,
                         const char **note) {
    fw_text text = fw_text_new(l->arena);
    fw_text_add(&text, first);
    if (o->n > 1) {
        fw_text_printf(&text, "; mean of %d wafers, which differ by ", o->n);
        put_spread(l, id, sqrt(o->between), o->mean, &text);
        fw_text_printf(&text, " (standard, %d degree%s of freedom); the next wafer is meant",
                       o->n - 1, o->n > 2 ? "s" : "");
    }
    FW_TRY(fw_text_end(&text));
    *note = text.data;
    return FW_OK;
}

/* is it a reading of a coupon of c; of one whose feature is a quantity, of that one? */
static bool behind(const lot *l, const fw_process_calibrated *c, const fw_process_reading *r) {
    if (!strstr(c->coupon, r->row.coupon) || (r->row.of && strcmp(r->row.of, c->id) != 0) ||
        r->row.of_wafer)
        return false;
    return !fw_process_flow_quantity(l->flow, r->row.feature) || strcmp(r->row.feature, c->id) == 0;
}

/* "arde-slots of wafers 1, 2, 3: 105 readings, 84 degrees of freedom, step S18, 2026-11-20 to 2026-11-22; lot L7, log
   lot7.log" */
static fw_status source_of(const lot *l, fw_process_calibrated *c) {
    const char *first = NULL, *last = NULL, *step = NULL;
    int readings = 0, freedom = 0;
    fw_text text = fw_text_new(l->arena), wafers = fw_text_new(l->arena);
    fw_text_add(&wafers, "");
    for (int i = 0, n = 0; i < l->nwafer; i++) {
        const wafer *w = &l->wafer[i];
        bool any = false;
        for (int k = 0; k < w->nrow; k++) {
            const fw_process_reading *r = &l->readings->item[w->reading[k]];
            if (!behind(l, c, r)) continue;
            any = true;
            readings += r->nsite > 0 ? r->nsite : 1;
            freedom += r->nsite > 1 ? r->nsite - 1 : 0;
            if (!first || strcmp(r->date, first) < 0) first = r->date;
            if (!last || strcmp(r->date, last) > 0) last = r->date;
            step = r->step;
        }
        if (any && w->name[0]) fw_text_printf(&wafers, "%s%s", n++ ? ", " : "", w->name);
    }
    FW_TRY(fw_text_end(&wafers));
    fw_text_printf(&text, "%s%s%s: n = %d reading%s", c->coupon,
                   wafers.length ? strchr(wafers.data, ',') ? " of wafers " : " of wafer " : "",
                   wafers.data, readings, readings == 1 ? "" : "s");
    if (freedom > 0) fw_text_printf(&text, ", %d degrees of freedom of the sites", freedom);
    if (step) fw_text_printf(&text, ", step %s, %s", step, first);
    if (step && strcmp(first, last) != 0) fw_text_printf(&text, " to %s", last);
    if (l->readings->lot) fw_text_printf(&text, "; lot %s", l->readings->lot);
    fw_text_printf(&text, "; log %s, SHA-256 %.16s", l->readings->file, l->readings->sha256);
    FW_TRY(fw_text_end(&text));
    c->source = text.data;
    c->date = last;
    return FW_OK;
}

/* ---- the whole lot ---- */

static fw_status combine(lot *l, fw_process_calibrated *c, const char *id, double *gain) {
    moments o = moments_of(l, id, NULL);
    char text[32];
    *c = (fw_process_calibrated){.id = id, .value = o.mean, .uncertainty = o.u};
    *gain = o.gain;
    for (int i = 0; i < l->nwafer; i++) {
        int k = at(&l->wafer[i], id);
        if (k < 0 || k >= l->wafer[i].found.count) continue;
        const fw_process_calibrated *of = &l->wafer[i].found.item[k];
        if (!c->coupon || strlen(of->coupon) > strlen(c->coupon)) c->coupon = of->coupon;
        for (int m = 0; m < FW_CONDITIONS && !c->note; m++)
            c->least[m] = of->least[m], c->most[m] = of->most[m];
        fw_process_calibrated_join(c, of);
        if (!c->note) c->note = of->note;
        c->chi_square += of->chi_square;
        c->freedom += of->freedom;
        c->rows += of->rows;
    }
    c->probability = fw_process_chi_square_above(c->chi_square, c->freedom);
    if (c->probability < FW_COUPON_LEAST_PROBABILITY)
        return fw_diag_error(l->diags, 212, l->readings->item[0].row.place,
                             "the values of %s scatter more around their model than their "
                             "uncertainties allow, all wafers together: a probability of %s; %s is "
                             "not calibrated from them",
                             c->coupon, fw_number_text(text, sizeof text, c->probability, 2), id);
    FW_TRY(note_of(l, &o, id, c->note, &c->note));
    if (o.n == 1) FW_TRY(fw_process_calibrated_spread(l->arena, l->flow, "of one wafer", c));
    return source_of(l, c);
}

/* ---- a wafer that is not like the others ---- */

/* t = |x_i - mean of the others|/(s sqrt(1 + 1/n)), s their scatter or, where that is larger, what their readings are off by;
   against Student's t of n - 1 degrees of freedom, which one wafer in a hundred exceeds where nothing is odd. n others, at
   least two: of two wafers nobody knows which one is odd. The worst one. Test: test_wafers.c, one_that_is_odd. */
static const wafer *odd_one(const lot *l, const char *id, double *times) {
    static const double seldom = 0.995; /* on either side */
    const wafer *odd = NULL;
    *times = 1.0;
    for (int i = 0; i < l->nwafer; i++) {
        const wafer *w = &l->wafer[i];
        const int k = at(w, id);
        if (k < 0 || k >= w->found.count) continue;
        const moments o = moments_of(l, id, w);
        const double s = sqrt(fmax(o.variance, o.chance + o.rest) * (1.0 + 1.0 / o.n));
        if (o.n < 2 || !(s > 0.0)) continue;
        const double t = fabs(w->found.item[k].value - o.mean) /
                         (s * fw_maths_student_quantile(seldom, o.n - 1));
        if (t > *times) odd = w, *times = t;
    }
    return odd;
}

/* "-1.2", in the unit of the quantity */
static void put_in_unit(const lot *l, const char *id, double si, bool difference, fw_text *out) {
    const fw_quantity *q = fw_process_flow_quantity(l->flow, id);
    fw_quantity_unit unit;
    if (q && fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL)) {
        if (difference) unit.offset = 0.0;
        si = fw_quantity_unit_from_si(&unit, si);
    }
    fw_text_number(out, si, difference ? 2 : 4);
}

static void put_stated(const lot *l, const char *id, const moments *o, fw_text *out) {
    put_in_unit(l, id, o->mean, false, out);
    fw_text_add(out, " +- ");
    put_in_unit(l, id, o->u, true, out);
}

/* FW-D692 */
static fw_status ask_odd(const lot *l, const char *id) {
    double times;
    const wafer *w = odd_one(l, id, &times);
    const fw_quantity *q = fw_process_flow_quantity(l->flow, id);
    fw_text text = fw_text_new(l->arena);
    if (!w) return FW_OK;
    const moments all = moments_of(l, id, NULL), others = moments_of(l, id, w);
    fw_text_printf(&text, "wafer %s reads %s as ", w->name, id);
    put_in_unit(l, id, w->found.item[at(w, id)].value, false, &text);
    if (q && strcmp(q->unit, "1") != 0) fw_text_printf(&text, " %s", q->unit);
    fw_text_printf(&text, ", and the other %d wafers as ", others.n);
    put_in_unit(l, id, others.mean, false, &text);
    fw_text_add(&text, ", beyond what they differ by; without it ");
    put_stated(l, id, &others, &text);
    fw_text_add(&text, ", with it ");
    put_stated(l, id, &all, &text);
    FW_TRY(fw_text_end(&text));
    fw_diag_warning(l->diags, 692, w->row[0].place,
                    "%s. Look how it was run and read; where that was not as planned leave it out "
                    "(--without %s)",
                    text.data, w->name);
    return l->diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_process_calibrate_wafers(fw_arena *arena, const fw_process_flow *flow,
                                      const fw_process_readings *readings, fw_diags *diags,
                                      fw_process_calibration *calibration) {
    lot *l = fw_arena_one(arena, lot);
    fw_status status = FW_OK;
    FW_NEED(l);
    fw_process_readings kept;
    FW_TRY(leave_out_copies(arena, readings, diags, &kept));
    readings = &kept;
    l->arena = arena, l->flow = flow, l->readings = readings, l->diags = diags;
    FW_NEED(l->wafer = fw_arena_array(arena, wafer, MOST_WAFERS));
    if (readings->n == 0 && readings->left_out > 0)
        return fw_diag_error(diags, 211, (fw_place){.file = readings->file},
                             "of %d reading%s of coupons in the log none counts; why, the "
                             "warnings say of each, and nothing is calibrated",
                             readings->left_out, readings->left_out > 1 ? "s" : "");
    if (readings->n == 0)
        return fw_diag_error(diags, 211, (fw_place){.file = readings->file},
                             "the log holds no coupon; enter what was read with --coupon");
    for (int i = 0; i < readings->n; i++) {
        wafer *w;
        FW_TRY(wafer_of(l, readings->item[i].wafer, &w));
        fw_status of_row = add_row(l, w, i);
        if (of_row == FW_NOMEM) return of_row;
        if (of_row != FW_OK) status = of_row;
    }
    FW_TRY(status);
    FW_TRY(calibrate_each(l));
    fw_process_covariance all = {.id = l->id, .m = l->nid};
    double deviation[MOST_IDS] = {0}, gain[MOST_IDS] = {0};
    fw_process_calibrated *item = fw_arena_array(arena, fw_process_calibrated, (size_t)l->nitem);
    FW_NEED(item);
    FW_NEED(all.C = fw_arena_array(arena, double, (size_t)(all.m * all.m)));
    for (int i = 0; i < l->nitem; i++)
        FW_TRY(combine(l, &item[i], l->id[i], &gain[i]));
    for (int i = 0; i < l->nitem; i++)
        FW_TRY(ask_odd(l, l->id[i]));
    for (int i = 0; i < all.m; i++)
        for (int k = 0; k < all.m; k++)
            all.C[i * all.m + k] = covariance_of(l, l->id[i], l->id[k], gain[i] * gain[k]);
    for (int i = 0; i < all.m; i++)
        deviation[i] = i < l->nitem ? item[i].uncertainty : sqrt(all.C[i * all.m + i]);
    *calibration = (fw_process_calibration){.item = item, .count = l->nitem};
    for (int i = 0; i < l->nwafer; i++)
        for (int k = 0; k < l->wafer[i].found.nwith; k++)
            FW_TRY(fw_process_calibration_with(arena, calibration, &l->wafer[i].found.with[k]));
    return fw_process_coupon_joint(arena, &all, deviation, calibration);
}

/* ---- what is asked after ---- */

/* Residuals that agree better than one in a thousand of such tables would, with more than a few of them: the same coupon
   tells several values, and is named once. Test: test_calibrate.c, too_good */
static void ask_too_good(const fw_process_calibration *calibration, int i, const char *file,
                         fw_diags *diags) {
    static const double most = 0.999;
    static const int few = 3;
    const fw_process_calibrated *c = &calibration->item[i];
    char p[32];
    if (!(c->probability > most) || c->freedom <= few) return;
    for (int k = 0; k < i; k++) {
        const fw_process_calibrated *other = &calibration->item[k];
        if (strcmp(other->coupon, c->coupon) == 0 && other->chi_square == c->chi_square) return;
    }
    fw_diag_warning(diags, 663, (fw_place){.file = file},
                    "readings of %s agree with their law better than their uncertainties let them: "
                    "%d degrees of freedom, probability %s of a larger chi square. Readings that "
                    "were copied, or a u= that is of an error which all of them share, look so",
                    c->coupon, c->freedom, fw_number_text(p, sizeof p, c->probability, 5));
}

/* A rate that the law of a step corrects is that under its reference conditions, and under which ones the coupon was etched
   not every reading says. Test: test_calibrate.c, rates_of_a_temperature, of_open_areas. */
static void ask_condition(const fw_process_flow *flow, const fw_process_calibrated *c,
                          fw_process_condition which, const char *file, fw_diags *diags) {
    static const struct {
        int number;
        const char *more, *at, *log, *table;
        double of;       /* its value is asked for so much more */
        double relative; /* ... and that share of it more */
    } say[FW_CONDITIONS] = {
        [FW_CONDITION_TEMPERATURE] = {668, "a kelvin more", "at which temperature it was etched",
                                      "set temperature= of the step, or temperature= of the coupon",
                                      "columns temperature_Cel and u_temperature_K", 1.0, 0.0},
        [FW_CONDITION_OPEN_AREA] = {677, "twice that area", "how much of its wafer was open",
                                    "open-area= of the coupon, or set the open area of the step",
                                    "columns open_area_cm2 and u_open_area_cm2", 0.0, 1.0}};
    const fw_process_step *s = fw_process_flow_corrects(flow, which, c->id);
    fw_process_coupon_work *w = s ? fw_arena_one(diags->arena, fw_process_coupon_work) : NULL;
    double times;
    char at[32], more[32];
    if (!w || c->most[which] > 0.0) return;
    const fw_quantity *from = fw_process_step_argument(s, fw_process_condition_reference(which)),
                      *to = fw_process_step_corrects(s, which, c->id);
    *w = (fw_process_coupon_work){.arena = diags->arena, .flow = flow, .diags = diags};
    if (fw_process_step_speed(w, s, which,
                              from->value * (1.0 + say[which].relative) + say[which].of,
                              &times) != FW_OK)
        return;
    fw_diag_warning(
        diags, say[which].number, (fw_place){.file = file},
        "%s is written as the rate at %s = %s %s, and plans correct it from there to %s (%s "
        "makes it %s times as fast); not every reading of %s says %s. Say so (%s), and it is "
        "corrected",
        c->id, from->id, fw_number_text(at, sizeof at, fw_quantity_in_unit(from), 4), from->unit,
        to->id, say[which].more, fw_number_text(more, sizeof more, times, 4), c->coupon,
        say[which].at, c->source ? say[which].log : say[which].table);
}

/* Nothing that a laboratory reads is known to one part in a hundred thousand; a spread of 0, or a u= in another unit than its
   value, says so. Test: test_calibrate.c, rows_that_read_the_same */
static void ask_too_exact(const fw_process_calibrated *c, const char *file, fw_diags *diags) {
    static const double least = 1e-5;
    char parts[32];
    const double u = fw_process_calibrated_read_u(c);
    if (!(u < least * fabs(c->value))) return;
    fw_diag_warning(
        diags, 682, (fw_place){.file = file},
        "%s of %s would be known to one part in %s: no instrument reads so exactly. Give "
        "what it may be off by as u, in the unit of the value",
        c->id, c->coupon, fw_number_text(parts, sizeof parts, fabs(c->value) / u, 2));
}

/* d = |x - x_0| against 5 sqrt(u^2 + u_0^2): of a normal distribution one in two million. In and out: SI. Test:
   test_calibrate.c, far_from_the_plan. */
void fw_process_calibration_ask(const fw_process_flow *flow,
                                const fw_process_calibration *calibration, const char *file,
                                fw_diags *diags) {
    for (int i = 0; i < calibration->count; i++) {
        const fw_process_calibrated *c = &calibration->item[i];
        const fw_quantity *old = fw_process_flow_quantity(flow, c->id);
        char times[32];
        ask_too_good(calibration, i, file, diags);
        ask_too_exact(c, file, diags);
        for (int k = 0; k < FW_CONDITIONS; k++)
            ask_condition(flow, c, (fw_process_condition)k, file, diags);
        if (!old || old->unknown || !(old->uncertainty > 0.0)) continue;
        double far =
            fabs(c->value - old->value) / hypot(fw_process_calibrated_read_u(c), old->uncertainty);
        const fw_process_coupon *kind = fw_process_coupon_kind(c->coupon);
        if (!(far > 5.0)) continue;
        fw_diag_warning(diags, 643, (fw_place){.file = file},
                        "%s lies %s times its uncertainty from what the flow has: before a plan "
                        "goes by it, look at units, drawn sizes and rows of %s%s%s",
                        c->id, fw_number_text(times, sizeof times, far, 2), c->coupon,
                        kind && kind->mistaken ? "; " : "",
                        kind && kind->mistaken ? kind->mistaken : "");
    }
}
