/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How near nets come to each other, what difference of potential stands across the gap, and what it bears. */
#include "base/constants.h"
#include "base/text.h"
#include "geometry/segment.h"
#include "wiring/wiring.h"
#include <math.h>

/* ---- what air bears ----
   From where to where air breaks down between two conductors.

     V = B p d/(ln(A p d) - ln ln(1 + 1/gamma)),   A = 15/(cm Torr), B = 365 V/(cm Torr)      Paschen
     V >= (B/A) e ln(1 + 1/gamma),                 its least value, at p d = (e/A) ln(1 + 1/gamma)

   gamma, the electrons that an ion frees at the cathode, is not known for etched silicon or plated copper: 0.005
   to 0.02 gives the range, whose least values, 260 and 350 V, enclose the 327 V measured for air. Left of its least
   value the curve of Paschen would rise again; measured voltages do not, so the least value holds on there.
   Below 6 um electrons leave the cathode by the field alone and the voltage falls with the gap: the lower end
   goes straight to 0 from there (43 V/um, below what is measured), the upper end is 350 V/um at most.

   p: at room temperature; of warmer air that of the same density. Thin air bears less across a wide gap, down to the
   least value; of still thinner air, left of it, nothing but 350 V/um is known to be too much.

   In: gap, m, 0 to about 1 mm (E/p of the constants: 100 to 800 V/(cm Torr)); density over that at 1 atm. Out: V. Error: the range is one
   of flat, clean metal; edges, burrs and dust lower it, damp lowers it below 1 um. Cost: four logarithms. Source:
   Y. P. Raizer, Gas Discharge Physics (1991), for A and B; P. G. Slade, E. D. Taylor, IEEE Trans. Components and
   Packaging Technol. 25 (2002) 390: Paschen's curve above 6 um, field emission below 4 um; A. Peschot et al., Appl.
   Phys. Lett. 105 (2014) 123109: 350 V/um below 1 um. Test: test_wiring_breakdown.c */

static const double TORR = FW_STANDARD_ATMOSPHERE_Pa / 760.0;
static const double TOWNSEND_A = 15.0 / 1e-2, TOWNSEND_B = 365.0 / 1e-2; /* per m and Torr */
static const double GAMMA[2] = {0.02, 0.005};
static const double EMISSION_BELOW_M = 6e-6, HIGHEST_FIELD_V_per_m = 350e6;

static double paschen(double gap_m, double density, double gamma) {
    double pd = gap_m * density * (FW_STANDARD_ATMOSPHERE_Pa / TORR), loss = log1p(1.0 / gamma);
    double least_pd = FW_E * loss / TOWNSEND_A;
    if (pd <= least_pd) return TOWNSEND_B * least_pd;
    return TOWNSEND_B * pd / (log(TOWNSEND_A * pd) - log(loss));
}

void fw_wiring_breakdown(double gap_m, double density, double volts[2]) {
    const double least_m =
        FW_E * log1p(1.0 / GAMMA[1]) / (TOWNSEND_A * density) * (TORR / FW_STANDARD_ATMOSPHERE_Pa);
    if (!(gap_m > 0.0)) {
        volts[0] = volts[1] = 0.0;
        return;
    }
    volts[0] = paschen(gap_m, density, GAMMA[0]) * fmin(1.0, gap_m / EMISSION_BELOW_M);
    volts[1] = fmin(paschen(gap_m, density, GAMMA[1]), HIGHEST_FIELD_V_per_m * gap_m);
    if (density < 0.5 && gap_m < least_m) volts[1] = HIGHEST_FIELD_V_per_m * gap_m;
}

/* ---- gaps between nets ----
   In: nets with their potentials. A net that nobody contacts may have any potential between those of its
   neighbours, so the largest difference that there is counts. The gap is the lesser of that drawn and the
   least over the motions, less what walls come nearer by as made. The lower end of what it bears is that of the least
   that it may be: by what motions are off by, near a resonance, at all corners of the flow. That least gap and the
   largest voltage of any scene are taken to come together, so that no time between is missed. Field: V/gap of parallel
   faces; at edges and tips it is higher, which the range of fw_wiring_breakdown does not know. Test: test_wiring_drives.c */

typedef struct span {
    double low, high;
} span;

/* potentials that a net may have */
static span potential(const fw_wiring *w, int net) {
    span all = {0.0, 0.0};
    if (net < w->nnet && w->net[net].needed) return (span){w->net[net].low_V, w->net[net].high_V};
    if (net < w->nnet && w->net[net].kind == FW_WIRING_ROTOR && w->net[net].needed) return all;
    for (int i = 0; i < w->nnet; i++) {
        all.low = fmin(all.low, w->net[i].low_V);
        all.high = fmax(all.high, w->net[i].high_V);
    }
    return all;
}

static double difference(span p, span q) {
    return fmax(p.high - q.low, q.high - p.low);
}

static void take_motion(const fw_wiring *w, const fw_layout *layout, const fw_wiring_asked *asked,
                        fw_wiring_gap *g) {
    g->moved_m = g->t_s = (double)NAN;
    g->least_m = g->m;
    if (w->net[g->a].kind != FW_WIRING_ROTOR || w->net[g->b].kind != FW_WIRING_STATOR) return;
    for (int k = 0; k < asked->nmoved; k++) {
        const fw_wiring_moved *m = &asked->moved[k];
        bool mine = false;
        for (int i = 0; i < layout->npiece && !mine; i++)
            mine = w->net_of[i] == g->b && layout->piece[i].label == m->stator;
        if (mine) g->least_m = fmin(g->least_m, fmin(m->low_m, m->m));
        if (!mine || !(isnan(g->moved_m) || m->m < g->moved_m)) continue;
        g->moved_m = m->m;
        g->t_s = m->t_s;
        g->scene = m->scene;
    }
}

/* the least of the thinnest air, and what surely is too much of the densest, and of the thinnest where that is more */
static void air_bears(const fw_wiring *w, double gap_m, double volts[2]) {
    double dense[2];
    fw_wiring_breakdown(gap_m, w->density[1], dense);
    fw_wiring_breakdown(gap_m, w->density[0], volts);
    volts[0] = fmin(volts[0], dense[0]), volts[1] = fmax(volts[1], dense[1]);
}

/* from what the least gap may bear to what that as computed surely does not */
static void bears_in_air(const fw_wiring *w, fw_wiring_gap *g) {
    double least[2];
    air_bears(w, g->made_m, g->breakdown_V);
    air_bears(w, g->least_m, least);
    g->breakdown_V[0] = fmin(g->breakdown_V[0], least[0]);
}

static void bear(const fw_wiring *w, fw_wiring_gap *g) {
    g->volts = difference(potential(w, g->a), potential(w, g->b));
    g->field_V_per_m = g->made_m > 0.0 ? g->volts / g->made_m : HUGE_VAL;
    bears_in_air(w, g);
}

/* ---- what there is to say ---- */

static fw_status say_gap(fw_arena *arena, const fw_wiring *w, const fw_wiring_gap *g,
                         const char **out) {
    char gap[32], volts[32], field[32], low[32], high[32], x[32], y[32], least[64];
    FW_NEED(*out = fw_arena_printf(
                arena,
                "between %s and %s there are up to %s V across %s um%s (%s V/um) at (%s, %s) "
                "um%s%s%s, "
                "and air breaks down between %s and %s V",
                w->net[g->a].name, g->b < w->nnet ? w->net[g->b].name : "the handle",
                fw_number_text(volts, sizeof volts, g->volts, 4),
                fw_number_text(gap, sizeof gap, 1e6 * g->made_m, 4),
                fw_wiring_least_words(least, g),
                fw_number_text(field, sizeof field, 1e-6 * g->field_V_per_m, 3),
                fw_number_text(x, sizeof x, 1e6 * g->at[0].x, 5),
                fw_number_text(y, sizeof y, 1e6 * g->at[0].y, 5), g->scene ? " in " : "",
                g->scene ? fw_text_kind("scene ", g->scene) : "", g->scene ? g->scene : "",
                fw_number_text(low, sizeof low, g->breakdown_V[0],
                               fw_number_plain(g->breakdown_V[0], 3)),
                fw_number_text(high, sizeof high, g->breakdown_V[1],
                               fw_number_plain(g->breakdown_V[1], 3))));
    return FW_OK;
}

static fw_status judge_gap(fw_arena *arena, fw_wiring *w, const fw_wiring_gap *g) {
    const char *what;
    if (!(g->volts > 0.0)) return FW_OK;
    if (!(g->made_m > 0.0)) {
        FW_NEED(what = fw_arena_printf(arena,
                                       "%s and %s touch%s%s%s while they are at different "
                                       "potentials, which shorts the drive: let them move less, or "
                                       "draw them further apart",
                                       w->net[g->a].name, w->net[g->b].name, g->scene ? " in " : "",
                                       g->scene ? fw_text_kind("scene ", g->scene) : "",
                                       g->scene ? g->scene : ""));
        return fw_wiring_say(arena, &w->refusal, &w->nrefusal, what);
    }
    if (g->volts < g->breakdown_V[0]) return FW_OK;
    FW_TRY(say_gap(arena, w, g, &what));
    bool surely = g->volts > g->breakdown_V[1];
    FW_NEED(what = fw_arena_printf(arena, "%s: ask for less voltage, or for a wider gap%s", what,
                                   surely ? "" : ", or measure it"));
    return surely ? fw_wiring_say(arena, &w->refusal, &w->nrefusal, what)
                  : fw_wiring_say(arena, &w->open, &w->nopen, what);
}

/* the conductor below the insulator: across it below what is held, and across the air that the release leaves
   below what moves, which is as thin */
static fw_status handle_gaps(fw_arena *arena, double sag_m, fw_wiring *w) {
    const fw_wiring_carrier *c = &w->carrier;
    char volts[32], um[32], low[32], high[32];
    if (!c->insulates || !c->handle || !(c->thickness_m > 0.0)) return FW_OK;
    for (int i = 0; i < w->nnet; i++) {
        fw_wiring_gap *g = &w->gap[w->ngap++];
        *g = (fw_wiring_gap){.a = i,
                             .b = w->nnet,
                             .m = c->thickness_m,
                             .at = {w->net[i].at, w->net[i].at},
                             .label = {w->net[i].name, "handle"},
                             .moved_m = (double)NAN,
                             .t_s = (double)NAN,
                             .made_m = c->thickness_m,
                             .least_m = c->thickness_m};
        g->volts = difference(potential(w, i), potential(w, w->nnet));
        g->field_V_per_m = g->volts / c->thickness_m;
        const double bears = c->breakdown_V_per_m * c->thickness_m;
        g->breakdown_V[0] = bears * fmax(0.0, 1.0 - 2.0 * c->breakdown_share);
        g->breakdown_V[1] = bears * (1.0 + 2.0 * c->breakdown_share);
        if (w->net[i].kind == FW_WIRING_ROTOR) {
            g->least_m = fmax(c->thickness_m - sag_m, 0);
            bears_in_air(w, g);
        }
        if (!(g->volts > 0.0) || isnan(g->breakdown_V[0]) || g->volts < g->breakdown_V[0]) continue;
        FW_TRY(fw_wiring_say(
            arena, &w->open, &w->nopen,
            fw_arena_printf(arena,
                            "between %s and the handle there may be %s V across %s um of %s, which "
                            "breaks down between %s and %s V: tie the handle to the rotor's "
                            "potential, or ask for less voltage",
                            w->net[i].name, fw_number_text(volts, sizeof volts, g->volts, 4),
                            fw_number_text(um, sizeof um, 1e6 * c->thickness_m, 3),
                            w->net[i].kind == FW_WIRING_ROTOR ? "air" : "insulator",
                            fw_number_text(low, sizeof low, g->breakdown_V[0],
                                           fw_number_plain(g->breakdown_V[0], 3)),
                            fw_number_text(high, sizeof high, g->breakdown_V[1],
                                           fw_number_plain(g->breakdown_V[1], 3)))));
    }
    return FW_OK;
}

static fw_status remarks(fw_arena *arena, const fw_layout *layout, fw_wiring *w) {
    for (int i = 0; i < w->nnet; i++) {
        const fw_wiring_net *n = &w->net[i];
        if (n->kind == FW_WIRING_HELD && w->ndrive > 0)
            FW_TRY(
                fw_wiring_say(arena, &w->remark, &w->nremark,
                              fw_arena_printf(arena,
                                              "%s is contacted by nothing and floats between the "
                                              "potentials of its neighbours",
                                              n->name)));
        if (n->tethered)
            FW_TRY(fw_wiring_say(arena, &w->remark, &w->nremark,
                                 fw_arena_printf(arena,
                                                 "until its tethers are broken %s is one conductor "
                                                 "with what they hold",
                                                 n->name)));
    }
    (void)layout;
    if (w->ndrive == 0 || !w->carrier.insulates || !w->carrier.handle) return FW_OK;
    return fw_wiring_say(arena, &w->remark, &w->nremark,
                         "the handle below the insulator is a conductor by itself: tie it to the "
                         "rotor's potential, so that it pulls at nothing that moves");
}

fw_status fw_wiring_gaps(fw_arena *arena, const fw_layout *layout, const fw_wiring_asked *asked,
                         fw_wiring *w) {
    size_t n = (size_t)w->nnet;
    fw_geometry_box *box;
    fw_geometry_contour *contour;
    FW_NEED(w->gap = fw_arena_array(arena, fw_wiring_gap, n * (n + 1) / 2));
    FW_NEED(box = fw_arena_array(arena, fw_geometry_box, (size_t)layout->npiece));
    FW_NEED(contour = fw_arena_array(arena, fw_geometry_contour, (size_t)layout->npiece));
    for (int i = 0; i < layout->npiece; i++) {
        contour[i] = layout->piece[i].contour;
        if (w->net_of[i] >= 0) box[i] = fw_geometry_contour_box(&contour[i]);
    }
    for (int a = 0; a < w->nnet; a++)
        for (int b = a + 1; b < w->nnet; b++) {
            fw_wiring_near near = fw_wiring_least(layout, contour, box, w->net_of, a, b);
            if (near.piece[0] < 0) continue;
            fw_wiring_gap *g = &w->gap[w->ngap++];
            *g = (fw_wiring_gap){.a = a, .b = b, .m = near.m};
            for (int k = 0; k < 2; k++) {
                g->at[k] = near.at[k];
                g->label[k] = layout->piece[near.piece[k]].label;
            }
            take_motion(w, layout, asked, g);
            g->made_m = (g->moved_m < g->m ? g->moved_m : g->m) - asked->wall_m;
            g->least_m -= asked->wall_m;
            bear(w, g);
            FW_TRY(judge_gap(arena, w, g));
        }
    FW_TRY(handle_gaps(arena, asked->sag_m, w));
    return remarks(arena, layout, w);
}
