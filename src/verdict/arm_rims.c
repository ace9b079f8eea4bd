/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies with release holes, cut straight across: what they leave of the body where a hinge's way is strained most, and how
   much the rims of holes are strained at most. Theory: docs/theory/release.md. And what of required poses is open. */
#include "base/constants.h"
#include "base/sort.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- straight cuts through a body with holes ----
   Whatever the stress is, over a cut that parts an end from the body's hinges it comes to what acts on either side. */

fw_status fw_verdict_pierced_boxes(fw_arena *arena, fw_verdict_pierced *body) {
    fw_geometry_box *run = fw_arena_array(arena, fw_geometry_box,
                                          (size_t)(body->n / FW_VERDICT_RUN + 1)),
                    *wide = fw_arena_array(arena, fw_geometry_box,
                                           (size_t)(body->n / FW_VERDICT_WIDE + 1));
    FW_NEED(run && wide);
    for (int i = 0; i < body->n; i++) {
        const fw_geometry_vec2 a = body->line[i].a, b = body->line[i].b;
        const fw_geometry_box own = {fw_lesser(a.x, b.x), fw_lesser(a.y, b.y), fw_greater(a.x, b.x),
                                     fw_greater(a.y, b.y)};
        fw_geometry_box *r = &run[i / FW_VERDICT_RUN], *w = &wide[i / FW_VERDICT_WIDE];
        *r = i % FW_VERDICT_RUN ? fw_box_join(*r, own) : own;
        *w = i % FW_VERDICT_WIDE ? fw_box_join(*w, own) : own;
    }
    body->run = run, body->wide = wide;
    return FW_OK;
}

/* may one of the lines in a box cross the cut, or begin on the end's side farther away than *far2_m2? */
static bool matters_here(const fw_geometry_box *b, fw_geometry_vec2 at, fw_geometry_vec2 across,
                         double far2_m2) {
    const double slack_m = 1e-12, hx = 0.5 * (b->x1 - b->x0), hy = 0.5 * (b->y1 - b->y0),
                 cx = 0.5 * (b->x0 + b->x1) - at.x, cy = 0.5 * (b->y0 + b->y1) - at.y,
                 middle = cx * across.x + cy * across.y,
                 half = hx * fabs(across.x) + hy * fabs(across.y) + slack_m;
    if (middle > half) return false;
    if (middle > -half) return true;
    const double x = fabs(cx) + hx + slack_m, y = fabs(cy) + hy + slack_m;
    return x * x + y * y > far2_m2;
}

/* one line: *n crossings so far */
static void cross(const fw_verdict_pierced *body, int i, fw_geometry_vec2 at,
                  fw_geometry_vec2 across, int *n, double *far2_m2) {
    const fw_geometry_vec2 a = vec_sub(body->line[i].a, at), b = vec_sub(body->line[i].b, at);
    const double from = vec_dot(a, across), to = vec_dot(b, across);
    if (from <= 0) *far2_m2 = fmax(*far2_m2, vec_dot(a, a));
    if ((from > 0) == (to > 0)) return;
    body->room[(*n)++] = vec_dot(vec_along(a, from / (from - to), vec_sub(b, a)), vec_left(across));
}

/* Where lines of the body cross a straight cut through `at`, ascending along vec_left(across): how many. Runs of lines that
   lie on one side, and no farther than another does, are passed over. */
static int crossings(const fw_verdict_pierced *body, fw_geometry_vec2 at, fw_geometry_vec2 across,
                     double *far_m) {
    int n = 0;
    double far2_m2 = *far_m;
    for (int i = 0; i < body->n; i++) {
        if (body->wide && i % FW_VERDICT_WIDE == 0 &&
            !matters_here(&body->wide[i / FW_VERDICT_WIDE], at, across, far2_m2)) {
            i += FW_VERDICT_WIDE - 1;
            continue;
        }
        if (body->run && i % FW_VERDICT_RUN == 0 &&
            !matters_here(&body->run[i / FW_VERDICT_RUN], at, across, far2_m2)) {
            i += FW_VERDICT_RUN - 1;
            continue;
        }
        cross(body, i, at, across, &n, &far2_m2);
    }
    *far_m = sqrt(far2_m2);
    fw_sort_doubles(body->room, (size_t)n);
    return n;
}

/* the direction of the way as seen from the end; does a cut square to it part the end from all other hinges? */
static bool parts(const fw_verdict_pierced *body, fw_geometry_vec2 at, fw_geometry_vec2 way,
                  fw_geometry_vec2 *across) {
    *across = vec_dot(vec_sub(at, body->root), way) < 0 ? vec_scale(-1, way) : way;
    bool apart = !(vec_dot(vec_sub(body->root, at), *across) > 0);
    for (int k = 0; k < body->nhinge; k++)
        apart = apart && (k == body->own || vec_dot(vec_sub(body->hinge[k], at), *across) > 0);
    return apart;
}

void fw_verdict_arm_cut_at_edge(const fw_verdict_pierced *body, fw_verdict_arm *arm) {
    const double *at = body->room;
    double middle = 0, passed = 0, far_m = 0;
    fw_geometry_vec2 across;
    if (!parts(body, arm->edge, arm->along, &across)) return;
    const int n = crossings(body, arm->edge, across, &far_m);
    if (n % 2 != 0) return;
    for (int k = 0; k < n; k += 2)
        arm->cut_m += at[k + 1] - at[k];
    /* the median of what the cut leaves is the place about which its integral of distances is least */
    for (int k = 0; k < n && passed <= 0.5 * arm->cut_m; k += 2) {
        middle = at[k] + 0.5 * arm->cut_m - passed;
        passed += at[k + 1] - at[k];
    }
    for (int k = 0; k < n; k += 2) {
        const double a = at[k] - middle, b = at[k + 1] - middle;
        arm->cut_m2 += 0.5 * (b * fabs(b) - a * fabs(a));
    }
    arm->cut = vec_along(arm->edge, middle, vec_left(across));
}

/* ---- stress at the rims of release holes, at most ----
   Of a place of the way two bounds, of which the lesser counts, each by a factor of Kirsch's hole: the strip of the
   inscribed circle between holes, as if it bore everything alone; and where a straight cut square to the way parts this
   end from the body's other hinges, the beam that this cut leaves, of area A, second moment I about its centroid, and
   with its farthest fibre at c:

     E h strain = k [ |M| c/I + |N|/A + 2 |V|/A ],   M about the centroid

   2: a hole in pure shear has four times the stress, and V over A is half as much again in the middle. A load spreads:
   no more counts of a cut than pi/4 of its distance from the end to either side, as half a plane has 2 F/(pi r) below a
   force. Besides what the end bears, whatever else acts on the body may act on its side of the cut: F_0 at the farthest
   point of that, and M_0. A cut leans by up to 45 degrees, as is shortest; cuts are an eighth of a hole from its middle at
   most. A cut that meets the body in parts with more than a hole between them does not count as one beam, and one without
   a hole has no rim.
   In: lines of the body, m. Out: multipliers, 1/m and 1/m2. Error: of beams; against plane solids of bodies with holes
   tools/solids/rims. Cost: lines times 8 cuts per hole's diameter of the way. Source: G. Kirsch, Z. VDI 42, 1898;
   W. Pilkey, D. Pilkey, Peterson's Stress Concentration Factors, 2008, 4.3 and 4.6 (rows of holes and bars in bending: no
   more on what is left than of one hole); A. Flamant, C. R. Acad. Sci. 114, 1892. Test: test_body_arms.c,
   rims_of_a_row_of_holes. */

typedef struct section {
    double area_m, second_m3, fibre_m; /* over the thickness */
    double wide_m;                     /* from outer edge to outer edge */
    double far_m;                      /* of what lies on the end's side */
    bool holed;                        /* a hole lies in it */
    fw_geometry_vec2 centre, across;
} section;

/* Crossings (n) of a cut, from the way: is it one beam, with holes and nothing wider between its parts, and does a hole of
   the limb in which the way runs lie within `reach`? */
static bool one_beam(const double *x, int n, double hole_m, double reach, bool *holed) {
    const double apart = 1.02 * hole_m, seam_m = 1e-9;
    int first = 0;
    *holed = false;
    if (n == 0 || n % 2 != 0) return false;
    while (first + 2 < n && x[first + 1] < 0)
        first += 2;
    int last = first;
    for (; last + 2 < n && x[last + 2] - x[last + 1] <= apart; last += 2)
        *holed = *holed || (x[last + 2] - x[last + 1] > seam_m && x[last + 1] < reach);
    for (; first > 0 && x[first] - x[first - 1] <= apart; first -= 2)
        *holed = *holed || (x[first] - x[first - 1] > seam_m && x[first] > -reach);
    return first == 0 && last + 2 == n;
}

/* what the cut leaves within `reach` of the way; false: it parts nothing, or is not one beam */
static bool section_at(const fw_verdict_pierced *body, fw_geometry_vec2 at, fw_geometry_vec2 way,
                       section *out) {
    const double *x = body->room, reach = 0.25 * FW_PI * vec_distance(at, body->root);
    double first = 0, low = HUGE_VAL, high = -HUGE_VAL;
    *out = (section){.area_m = 0};
    const bool apart = parts(body, at, way, &out->across);
    const int n = crossings(body, at, out->across, &out->far_m);
    if (!one_beam(x, n, body->hole_m, reach, &out->holed) || !apart) return false;
    out->wide_m = x[n - 1] - x[0];
    for (int k = 0; k < n; k += 2) {
        const double a = fmax(x[k], -reach), b = fmin(x[k + 1], reach);
        if (!(b > a)) continue;
        low = fmin(low, a), high = fmax(high, b);
        out->area_m += b - a;
        first += 0.5 * (b * b - a * a);
        out->second_m3 += (b * b * b - a * a * a) / 3;
    }
    if (!(out->area_m > 0)) return false;
    const double middle = first / out->area_m;
    out->second_m3 -= middle * first;
    out->fibre_m = fmax(high - middle, middle - low);
    out->far_m += fabs(middle);
    out->centre = vec_along(at, middle, vec_left(out->across));
    return out->second_m3 > 0;
}

/* multipliers of one place, as those of the arm */
typedef struct rims {
    double m2, x_m, y_m, all_m, rest_m, rest_m2;
} rims;

static rims of_strip(fw_geometry_vec2 r, double w) {
    const double bends = 6 / (w * w);
    return (rims){bends,
                  bends * fabs(r.y) + 1 / w,
                  bends * fabs(r.x) + 1 / w,
                  bends * vec_length(r) + 1 / w,
                  0,
                  0};
}

static rims of_section(fw_geometry_vec2 r, const section *s) {
    const double bends = s->fibre_m / s->second_m3, shear = 2, x = fabs(s->across.x),
                 y = fabs(s->across.y), most = sqrt(1 + shear * shear);
    return (rims){bends,
                  bends * fabs(r.y) + (x + shear * y) / s->area_m,
                  bends * fabs(r.x) + (y + shear * x) / s->area_m,
                  bends * vec_length(r) + most / s->area_m,
                  bends * s->far_m + most / s->area_m,
                  bends};
}

/* A way goes in steps from cell to cell, and a cut that leans leaves more than a square one: of those that lean by up to 45
   degrees to either side, the one that is shortest from edge to edge */
static fw_geometry_vec2 squarest(const fw_verdict_pierced *body, fw_geometry_vec2 at,
                                 fw_geometry_vec2 way) {
    enum { SIDES = 3 };
    double least = HUGE_VAL;
    fw_geometry_vec2 best = way;
    for (int k = -SIDES; k <= SIDES; k++) {
        const fw_geometry_vec2 to = fw_geometry_vec_rotate(way, 0.25 * FW_PI * k / SIDES);
        section s;
        if (section_at(body, at, to, &s) && s.wide_m < least) least = s.wide_m, best = to;
    }
    return best;
}

void fw_verdict_arm_rims(const fw_verdict_pierced *body, fw_geometry_vec2 pin,
                         fw_geometry_vec2 from, fw_geometry_vec2 until, double w,
                         fw_verdict_arm *arm) {
    const double length = vec_distance(from, until);
    const int steps = body->hole_m > 0 ? (int)ceil(4 * length / body->hole_m) : 0;
    if (steps == 0) return;
    const fw_geometry_vec2 way = vec_unit(vec_sub(until, from)),
                           cut = squarest(body, vec_along(from, 0.5 * length, way), way);
    for (int i = 0; i < steps; i++) {
        const fw_geometry_vec2 at = vec_along(from, (i + 0.5) * length / steps, way);
        section s;
        rims most = of_strip(vec_sub(at, pin), w);
        const bool beam_like = section_at(body, at, cut, &s);
        if (!s.holed) continue; /* no rim is there */
        if (beam_like) {
            const rims beam = of_section(vec_sub(s.centre, pin), &s);
            if (beam.m2 < most.m2 && beam.all_m < most.all_m) most = beam;
        }
        if (most.all_m > arm->rim_m) arm->rim_m = most.all_m, arm->rim = at;
        arm->rim_m2 = fmax(arm->rim_m2, most.m2);
        arm->rim_x_m = fmax(arm->rim_x_m, most.x_m);
        arm->rim_y_m = fmax(arm->rim_y_m, most.y_m);
        arm->rim_rest_m = fmax(arm->rim_rest_m, most.rest_m);
        arm->rim_rest_m2 = fmax(arm->rim_rest_m2, most.rest_m2);
    }
}

/* Stress at the rim of a round hole in a plate that is pulled, at most, over the stress far away: 3; of a cubic
   crystal in its (100) plane 1 + sqrt(2 (1 - nu) + E/G) along [110], and along [100]. Source: S. Lekhnitskii, Anisotropic
   Plates, 1968, section 43. */
static double rim_factor(const fw_device_material *of) {
    if (!fw_device_material_is_crystal(of)) return 3;
    const double c11 = of->c11.value, c12 = of->c12.value, c44 = of->c44.value,
                 all = (c11 - c12) * (c11 + 2 * c12), s11 = (c11 + c12) / all, s12 = -c12 / all;
    const double off = s11 - s12 - 0.5 / c44, /* turned by 45 degrees */
        t11 = s11 - 0.5 * off, t12 = s12 + 0.5 * off, t44 = 2 * (s11 - s12);
    return 1 + sqrt(fmax(2 * (1 + s12 / s11) + 1 / (c44 * s11), 2 * (1 + t12 / t11) + t44 / t11));
}

double fw_verdict_arm_rims_bear(const fw_mechanism *m, int hinge, const fw_verdict_arm *arm,
                                double moment_Nm, double force_N, const double *along_N,
                                const double rest[2]) {
    double by_force = force_N * arm->rim_m;
    if (along_N) by_force = fmin(by_force, along_N[0] * arm->rim_x_m + along_N[1] * arm->rim_y_m);
    if (rest) by_force += rest[0] * arm->rim_rest_m + rest[1] * arm->rim_rest_m2;
    return rim_factor(&m->variant->material) * (moment_Nm * arm->rim_m2 + by_force) /
           fw_verdict_arm_allowed_N_per_m(m, hinge, arm);
}

/* ---- what is said of surfaces that a scene or a liquid closes (verdict_stiction.c judges them) ---- */

void fw_verdict_pull_number(const fw_mechanism_drying *drying, fw_verdict_pull *to) {
    bool pulled = drying->how == FW_DRIED_PULLED;
    double most = drying->tension_high * drying->cos_high,
           least = drying->tension_low * drying->cos_low;
    to->number[0] = pulled && most > 0 ? to->tension_N_per_m[0] / most : HUGE_VAL;
    to->number[1] = pulled && least > 0 ? to->tension_N_per_m[1] / least : HUGE_VAL;
}

const char *fw_verdict_range_words(fw_arena *arena, const double number[2]) {
    char low[32], high[32];
    fw_number_text(low, sizeof low, number[0], 3);
    fw_number_text(high, sizeof high, number[1], 3);
    return isfinite(number[1]) ? fw_arena_printf(arena, "%s to %s", low, high)
                               : fw_arena_printf(arena, "%s at least", low);
}

static const char *uN(char *to, size_t size, double force_N) {
    return fw_number_text(to, size, 1e6 * force_N, 3);
}

static const char *not_known(fw_arena *arena, const fw_verdict_stuck *s) {
    char opens[32];
    const char *opened = "";
    if (s->opens_N[0] > 0)
        opened = fw_arena_printf(arena, " (flexures open it with %s uN)",
                                 uN(opens, sizeof opens, s->opens_N[0]));
    if (!opened) return NULL;
    return fw_arena_printf(
        arena,
        "%s%s touches in %s%s, and whether it comes free again is not known: %s%s; let it touch a "
        "bump (b is its centre, distance its radius), or leave it more room",
        FW_NAMED("contact", s->contact), FW_NAMED("scene", s->scene), s->why, opened);
}

const char *fw_verdict_limb_text(fw_arena *arena, const fw_layout *layout,
                                 const fw_mechanism_limb *limb) {
    char x[32], y[32];
    return fw_arena_printf(arena, "a slender part of %s at (%s, %s) um",
                           layout->piece[limb->piece[0]].label,
                           fw_number_text(x, sizeof x, 1e6 * limb->at.x, 4),
                           fw_number_text(y, sizeof y, 1e6 * limb->at.y, 4));
}

const char *fw_verdict_stuck_text(fw_arena *arena, const fw_verdict_stuck *s,
                                  double adhesion_J_per_m2) {
    char low[32], holds[32], opens[32], least[32], times[32];
    const bool sure = s->decision == FW_REJECT;
    const double share = s->opens_N[0] / s->holds_N[1];
    if (s->contact && s->why) return not_known(arena, s);
    uN(low, sizeof low, s->holds_N[0]);
    uN(holds, sizeof holds, s->holds_N[1]);
    uN(opens, sizeof opens, s->opens_N[sure]);
    if (!s->contact)
        return fw_arena_printf(
            arena,
            "the surfaces of %s%s may meet in %s%s and stay closed: adhesion may hold them with up "
            "to %s uN, and the flexure opens them with %s uN; a wider gap, a stiffer flexure or "
            "surfaces that hold less (surface.adhesion of the flow) let them go",
            FW_NAMED("hinge", s->hinge), FW_NAMED("scene", s->scene), holds, opens);
    return fw_arena_printf(
        arena,
        "%s%s touches in %s%s and %s closed: adhesion holds it with %s to %s uN over the height of "
        "the layer, and the flexures open it with %s uN; it comes free for sure of surfaces that "
        "hold at most %s mJ/m2 (a coating, or surface.adhesion as measured), by flexures or a gap "
        "%s times as stiff or wide, and the sooner the smaller its radius is",
        FW_NAMED("contact", s->contact), FW_NAMED("scene", s->scene), sure ? "stays" : "may stay",
        low, holds, opens,
        fw_number_text(least, sizeof least, 1e3 * adhesion_J_per_m2 * pow(share, 1.5), 2),
        fw_number_text(times, sizeof times, 1 / share, 3));
}

/* ---- what of required poses is open ---- */

/* required poses in which nothing bounds what drift and give of the hinges add */
static fw_status judge_give(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_workspace_load *worst = NULL;
    for (int i = 0; i < FW_SIX && !worst; i++)
        if (v->workspace.load[i].known && isinf(v->workspace.load[i].give))
            worst = &v->workspace.load[i];
    if (!worst) return FW_OK;
    return fw_verdict_workspace_reason(
        v, 535, FW_INCONCLUSIVE,
        fw_arena_printf(
            arena,
            "what drift and give of the hinges change in required poses is not known: held by "
            "%s, no equilibrium of hinges that give was found; hold the platform where it is "
            "needed, ask for a smaller box, or take hinges that give less",
            worst->actuation));
}

/* what drives the device in its scenes holds no required pose well: what it must give has no bound there */
static fw_status judge_held(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_workspace_result *w = &v->workspace;
    char volume[32], needed[32];
    if (!w->badly_by) return FW_OK;
    return fw_verdict_workspace_reason(
        v, 536, FW_INCONCLUSIVE,
        fw_arena_printf(
            arena,
            "the actuators of the scenes hold the required workspace badly: the best three, %s, "
            "have unit wrenches of a volume of %s in one of its poses, and %s is needed; forces "
            "grow without bound towards 0, so that the strain is computed for a wrench on the "
            "platform instead; drive it at another place, ask for a smaller box, or state in a "
            "scene two forces and a torque on the platform if they hold it",
            w->badly_by, fw_number_text(volume, sizeof volume, w->badly, 2),
            fw_number_text(needed, sizeof needed, FW_WORKSPACE_HOLDS_WELL, 2)));
}

/* what poses do not count, or do not tell the size of */
static fw_status judge_unknown(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_workspace_result *w = &v->workspace;
    const char *text[3] = {NULL, NULL, NULL};
    static const int number[3] = {710, 711, 646};
    if (w->left_out)
        FW_NEED(text[0] = fw_arena_printf(
                    arena,
                    "required poses are judged without %s: that may strain hinges there, too; "
                    "judge such poses as scenes, or leave it out where it does not act in them",
                    w->left_out));
    if (w->presses_itself)
        FW_NEED(text[1] =
                    fw_arena_printf(arena,
                                    "in required poses friction of scene %s presses hinges so that "
                                    "it grows without end: they jam; smaller radii or "
                                    "coefficients, or what holds better, keep away from there",
                                    w->presses_itself));
    if (w->unknown)
        FW_NEED(text[2] = fw_arena_printf(
                    arena,
                    "required poses have to be held against %s, too, and do not tell how strong "
                    "that is: it ends at what rides on the six-bar; let it act on a body of the "
                    "six-bar or on the ground, or judge such a pose as a scene",
                    w->unknown));
    for (int i = 0; i < 3; i++)
        if (text[i]) FW_TRY(fw_verdict_workspace_reason(v, number[i], FW_INCONCLUSIVE, text[i]));
    return FW_OK;
}

/* a required pose that no pose of the legs has: nothing of a hinge can be said there */
static const char *beyond_text(fw_arena *arena, const fw_workspace_result *w) {
    const fw_workspace_beyond *b = &w->beyond;
    const char *leg = b->leg ? "F-E-D" : "A-B-C", *most = "by an amount that is not known";
    char x[32], y[32], phi[32], lacks[32], by[32];
    fw_number_text(x, sizeof x, b->pose[0] * 1e6, 4);
    fw_number_text(y, sizeof y, b->pose[1] * 1e6, 4);
    fw_number_text(phi, sizeof phi, b->pose[2] * FW_DEG_PER_RAD, 3);
    fw_number_text(lacks, sizeof lacks, fmax(b->lacks_m, 0) * 1e6, 3);
    if (b->turns)
        return fw_arena_printf(arena,
                               "the required workspace holds a pose out of reach: dx = %s um, dy = "
                               "%s um, turned by %s deg, and within their limits hinges %s turn it "
                               "by no more than %s deg together",
                               x, y, phi, leg,
                               fw_number_text(by, sizeof by, b->gives_rad * FW_DEG_PER_RAD, 3));
    if (b->certain)
        return fw_arena_printf(arena,
                               "the required workspace holds a pose out of reach: dx = %s um, dy = "
                               "%s um, turned by %s deg, where leg %s lacks %s um and its flexures "
                               "give no more than %s um within their limits",
                               x, y, phi, leg, lacks,
                               fw_number_text(by, sizeof by, b->gives_m * 1e6, 3));
    if (isfinite(b->gives_m))
        most = fw_arena_printf(arena, "by up to %s um",
                               fw_number_text(by, sizeof by, b->gives_m * 1e6, 3));
    return most ? fw_arena_printf(
                      arena,
                      "the required workspace holds a pose that pins do not reach, and flexures "
                      "may: dx = %s um, dy = %s um, turned by %s deg, where leg %s lacks %s um, "
                      "and its flexures may give %s within their limits; what that strains is not "
                      "known: judge such a pose as a scene with the force that takes the platform "
                      "there, ask for a smaller box, or draw the legs farther from stretched",
                      x, y, phi, leg, lacks, most)
                : NULL;
}

fw_status fw_verdict_required_poses(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_workspace_result *w = &v->workspace;
    if (!w->required) return FW_OK;
    if (w->reachable) {
        FW_TRY(judge_held(arena, v));
        FW_TRY(judge_unknown(arena, v));
        return judge_give(arena, v);
    }
    return fw_verdict_workspace_reason(v, w->beyond.certain ? 201 : 727,
                                       w->beyond.certain ? FW_REJECT : FW_INCONCLUSIVE,
                                       beyond_text(arena, w));
}

/* ---- what takes hold where it is met ----
   A contact, a stop of a joint or a cable does nothing until it is met, so that nothing of it is in proportion to anything.
   What it leaves is followed instead: g at the start, the most c that the motion takes of it, and by modes what a swing adds,
   S (up - 1) with S the way that it goes and up as of a hinge (resonance.c). Not met where c + S (up - 1) < g. In: elements
   of the motion. Error: small motions; of c the cubic between samples. Test: test_effects.py, Resonance */

enum { REACH_PORTS = 64 };

/* what an element says of itself with its ports moved by `by` of w; > 0: it is met */
static double says(const fw_effects_force_element *e, const double *p, const double *w, double by) {
    double at[3 * REACH_PORTS], still[3 * REACH_PORTS] = {0};
    bool on[REACH_PORTS] = {false};
    for (int i = 0; i < 3 * e->ports; i++)
        at[i] = p[i] + by * w[i];
    const fw_effects_port_state state = {.load = 1, .p = at, .w = still, .on = on, .still = true};
    return e->class_->switch_value(e, &state, 0);
}

/* of what it says, per way of the port by which it goes most */
static double per_way(const fw_effects_force_element *e, const double *q) {
    const double little_m = 1e-8;
    double p[3 * REACH_PORTS], w[3 * REACH_PORTS], most = 0;
    fw_effects_element_place_ports(e, q, NULL, p, w);
    memset(w, 0, sizeof w);
    for (int i = 0; i < e->ports; i++) {
        double slope[2];
        for (int axis = 0; axis < 2; axis++) {
            double *along = &w[3 * i + axis];
            *along = 1;
            slope[axis] = (says(e, p, w, little_m) - says(e, p, w, -little_m)) / (2 * little_m);
            *along = 0;
        }
        most = fmax(most, hypot(slope[0], slope[1]));
    }
    return most;
}

/* m by which it is met, below 0: that it leaves */
static double overlap_at(const fw_verdict_reach *r, const double *q) {
    double p[3 * REACH_PORTS], w[3 * REACH_PORTS];
    const fw_effects_stop *t = r->stop;
    if (t) {
        const double a = t->body_a == FW_GROUND ? 0 : q[3 * t->body_a + 2],
                     b = t->body_b == FW_GROUND ? 0 : q[3 * t->body_b + 2];
        return t->side * (b - a - t->free_angle_rad - t->at_rad) / r->per_m;
    }
    fw_effects_element_place_ports(r->element, q, NULL, p, w);
    return says(r->element, p, w, 0) / r->per_m;
}

double fw_verdict_reach_by(const fw_verdict_reach *r, const double *q, const double *u) {
    const double little_m = 1e-8;
    double p[3 * REACH_PORTS], w[3 * REACH_PORTS], most = 0;
    const fw_effects_stop *t = r->stop;
    if (t)
        return t->side *
               ((t->body_b == FW_GROUND ? 0 : u[3 * t->body_b + 2]) -
                (t->body_a == FW_GROUND ? 0 : u[3 * t->body_a + 2])) /
               r->per_m;
    fw_effects_element_place_ports(r->element, q, u, p, w);
    for (int i = 0; i < r->element->ports; i++)
        most = fmax(most, hypot(w[3 * i], w[3 * i + 1]));
    if (!(most > 0)) return 0;
    const double by = little_m / most;
    return (says(r->element, p, w, by) - says(r->element, p, w, -by)) / (2 * by * r->per_m);
}

/* the largest and least overlap of a motion, by cubics through values and rates at its samples */
static void follow(const fw_dynamics_motion *x, const fw_verdict_reach *r, double *least,
                   double *most) {
    enum { BETWEEN = 8 };
    const size_t n = 3 * (size_t)x->nbody;
    double value = overlap_at(r, x->q), rate = fw_verdict_reach_by(r, x->q, x->v);
    *least = *most = value;
    for (int i = 1; i < x->nsample; i++) {
        const double *q = x->q + (size_t)i * n, *v = x->v + (size_t)i * n;
        const double to = overlap_at(r, q), goes = fw_verdict_reach_by(r, q, v),
                     dt = x->t_s[i] - x->t_s[i - 1];
        for (int k = 1; k <= BETWEEN; k++) {
            const double t = (double)k / BETWEEN, left = 1 - t;
            const double at = left * left * ((1 + 2 * t) * value + t * dt * rate) +
                              t * t * ((1 + 2 * left) * to - left * dt * goes);
            *least = fmin(*least, at), *most = fmax(*most, at);
        }
        value = to, rate = goes;
    }
}

static void take_reach(const fw_dynamics_motion *x, const double *q, fw_verdict_reach r,
                       fw_verdict_shaken *to) {
    double least, most;
    if (!(r.per_m > 0) || !isfinite(r.per_m)) return;
    follow(x, &r, &least, &most);
    r.gap_m = -overlap_at(&r, x->q);
    r.closes_m = most + r.gap_m, r.goes_m = fmax(r.closes_m, -r.gap_m - least);
    r.rests = overlap_at(&r, q) > 0;
    to->reach[to->nreach++] = r;
}

fw_status fw_verdict_reach_find(fw_arena *arena, const fw_dynamics_motion *x, double unit_m,
                                const double *q, fw_verdict_shaken *to) {
    const fw_effects_loads *loads = x->loads;
    to->nreach = 0, to->reach = NULL;
    if (!loads) return FW_OK;
    FW_NEED(to->reach = fw_arena_array(arena, fw_verdict_reach,
                                       (size_t)loads->nelement + (size_t)loads->nstop));
    for (int i = 0; i < loads->nelement; i++) {
        const fw_effects_force_element *e = &loads->element[i];
        if (e->switches != 1 || e->ports > REACH_PORTS || e->laws > 0 || !e->class_->switch_value)
            continue;
        take_reach(x, q,
                   (fw_verdict_reach){.id = e->id,
                                      .pin = FW_NONE,
                                      .element = e,
                                      .stiff_N_per_m = e->size_N_per_m,
                                      .per_m = per_way(e, x->q)},
                   to);
    }
    for (int i = 0; i < loads->nstop; i++)
        take_reach(x, q,
                   (fw_verdict_reach){.pin = loads->stop[i].pin,
                                      .stop = &loads->stop[i],
                                      .stiff_N_per_m =
                                          loads->stop[i].stiffness_Nm_per_rad / (unit_m * unit_m),
                                      .per_m = 1 / unit_m},
                   to);
    return FW_OK;
}
