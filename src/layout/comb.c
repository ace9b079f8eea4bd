/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Electrodes of comb drives and plates: outlines that have exactly the scene's fingers, gap,
   overlap and length, and a stator with lead and bond pad that stands on the carrier by itself. */
#include "geometry/segment.h"
#include "base/constants.h"
#include "layout/draw.h"
#include <math.h>
#include <string.h>

static const double BACK_M = FW_PLATE_BAR_M; /* bar behind the fingers, plate, lead */
static const double PAD_M = 150e-6;          /* side of the part of a pad that is bonded */
static const double STROKE_M = 5e-6;         /* of the letters on it */
static const double MARGIN_M = 10e-6;        /* around them */
static const double FREE_M = 60e-6;   /* of lead and pad from what moves, where there is room */
static const double LEAST_M = 20e-6;  /* and where there is less */
static const double LONGER_M = 10e-6; /* a stator's plate at either end, beyond the gap */
static const double BASE_M = 40e-6;   /* the base may be so much wider than its rule */
enum { FINGERS_MOST = 100, LETTERS = 6 };

double fw_layout_comb_tip(double width_m) {
    return fw_device_comb_tip_m(width_m);
}

double fw_layout_comb_width_shown(void) {
    return fmax(fw_layout_rule.own_width_m, fw_layout_rule.own_tip_m / FW_TIP_SHARE);
}

/* Fingers along +x from a bar behind them, in the frame of the drive:
     finger i   from x = overlap/2 - length to overlap/2,
                about y = (i - (n - 1)/2) 2 (w + g), w wide
   so that n fingers, and n + 1 in the frame turned by 180 degrees, keep the gap g everywhere and
   are engaged by the overlap. Area n w length + bar - 2 n (1 - pi/4) r^2, r of the tips' rounding.
   test_layout_actuators.c */
static fw_status draw_fingers(fw_arena *arena, const fw_layout_local *local,
                              const fw_layout_comb_plan *p, int n, fw_geometry_contour *out) {
    double w = p->width_m, pitch = 2.0 * (w + p->comb->gap_m), r = fw_layout_comb_tip(w);
    double tip = 0.5 * p->comb->overlap_m, root = tip - p->length_m;
    double half = 0.5 * (n - 1) * pitch + 0.5 * w;
    fw_layout_sketch k = fw_layout_sketch_start(arena, local, fw_v(root - BACK_M, -half));
    for (int i = 0; i < n; i++) {
        double low = (i - 0.5 * (n - 1)) * pitch - 0.5 * w, high = low + w;
        if (i > 0) fw_layout_sketch_line(&k, fw_v(root, low), 0);
        fw_layout_sketch_line(&k, fw_v(tip - r, low), 0);
        fw_layout_sketch_arc(&k, fw_v(tip - r, low + r), 0.5 * FW_PI, fw_v(tip, low + r));
        fw_layout_sketch_line(&k, fw_v(tip, high - r), 0);
        fw_layout_sketch_arc(&k, fw_v(tip - r, high - r), 0.5 * FW_PI, fw_v(tip - r, high));
        if (i < n - 1) fw_layout_sketch_line(&k, fw_v(root, high), 0);
    }
    fw_layout_sketch_line(&k, fw_v(root - BACK_M, half), 0);
    return fw_layout_sketch_close(&k, out);
}

static fw_status draw_plate(fw_arena *arena, const fw_layout_local *local, double face, double half,
                            fw_geometry_contour *out) {
    fw_geometry_vec2 p[4] = {
        {face - BACK_M, -half}, {face, -half}, {face, half}, {face - BACK_M, half}};
    return fw_layout_polygon(arena, local, p, 4, -1, out);
}

static fw_layout_local turned(const fw_layout_local *local) {
    return (fw_layout_local){local->origin, -local->c, -local->s, false};
}

fw_status fw_layout_comb_rotor(fw_arena *arena, const fw_layout_comb_plan *p,
                               fw_geometry_contour *rotor) {
    if (p->comb->kind == FW_ELECTRODES_COMB)
        return draw_fingers(arena, &p->local, p, p->comb->fingers, rotor);
    return draw_plate(arena, &p->local, 0.0, 0.5 * p->length_m, rotor);
}

/* the stator's face is longer than the rotor's by a gap and LONGER_M at either end, so that their
   force has no part across (docs/theory/effects/comb-drive.md) */
fw_status fw_layout_comb_stator(fw_arena *arena, const fw_layout_comb_plan *p,
                                fw_geometry_contour *stator) {
    fw_layout_local other = turned(&p->local);
    double g = p->comb->gap_m;
    if (p->comb->kind == FW_ELECTRODES_COMB)
        return draw_fingers(arena, &other, p, p->comb->fingers + 1, stator);
    return draw_plate(arena, &other, -g, 0.5 * p->length_m + g + LONGER_M, stator);
}

/* ---- what is in the way ---- */

typedef struct obstacle {
    const char *kind, *id;     /* of its name; id NULL: body `body` */
    fw_geometry_boxed outline; /* contour NULL: a disc, which keeps its own distance */
    fw_geometry_vec2 centre;
    double radius_m, space_m; /* space_m: what it asks for by itself; 0: what is asked for */
    int body;
} obstacle;

/* all that stands still while places are tried, in the order in which it is named */
typedef struct obstacles {
    obstacle *item;
    int n;
} obstacles;

static bool within(fw_geometry_box b, fw_geometry_vec2 p) {
    return p.x >= b.x0 && p.x <= b.x1 && p.y >= b.y0 && p.y <= b.y1;
}

/* box: of the outline */
static bool close_by(const fw_geometry_contour *p, fw_geometry_box box, const obstacle *o,
                     double space_m, fw_geometry_vec2 *at) {
    const fw_geometry_contour *q = o->outline.contour;
    const fw_geometry_box b = o->outline.whole;
    fw_geometry_vec2 there;
    if (box.x0 > b.x1 + space_m || b.x0 > box.x1 + space_m || box.y0 > b.y1 + space_m ||
        b.y0 > box.y1 + space_m)
        return false;
    if (fw_geometry_boxed_distance_below(p, &o->outline, space_m, at, &there) <
        space_m * (1.0 - 1e-9))
        return true;
    *at = q->segment[0].a;
    if (within(box, *at) && fw_geometry_contour_contains(p, *at)) return true;
    *at = p->segment[0].a;
    return within(b, *at) && fw_geometry_contour_contains(q, *at);
}

/* the same for a disc */
static bool disc_close_by(const fw_geometry_contour *p, fw_geometry_box b, fw_geometry_vec2 centre,
                          double radius_m, fw_geometry_vec2 *at) {
    double far, t;
    *at = centre;
    if (centre.x < b.x0 - radius_m || centre.x > b.x1 + radius_m || centre.y < b.y0 - radius_m ||
        centre.y > b.y1 + radius_m)
        return false;
    for (int i = 0; i < p->count; i++) {
        far = fw_geometry_segment_nearest(&p->segment[i], centre, &t, at);
        if (far < radius_m) return true;
    }
    *at = centre;
    return fw_geometry_contour_contains(p, centre);
}

static fw_status add_outline(fw_arena *arena, obstacles *o, const char *kind, const char *id,
                             int body, const fw_geometry_contour *outline, double space_m) {
    obstacle *to = &o->item[o->n];
    if (outline->count == 0) return FW_OK;
    *to = (obstacle){.kind = kind, .id = id, .body = body, .space_m = space_m};
    o->n++;
    return fw_geometry_contour_boxed(arena, outline, &to->outline);
}

/* bodies but one, hinges, and the drives before one */
static fw_status list_obstacles(const fw_layout_drawing *d, int body, int before, obstacles *o) {
    const fw_device *device = d->device;
    const size_t most = (size_t)(device->nbody + device->nrevolute + 2 * before + d->neyelet + 1);
    o->n = 0;
    FW_NEED(o->item = fw_arena_array(d->arena, obstacle, most));
    for (int b = 0; b < device->nbody; b++)
        if (b != body) FW_TRY(add_outline(d->arena, o, "", NULL, b, &d->plain[b], 0.0));
    for (int j = 0; j < device->nrevolute; j++)
        o->item[o->n++] = (obstacle){.kind = fw_text_kind("hinge ", device->revolute[j].id),
                                     .id = device->revolute[j].id,
                                     .centre = d->layout->hinge[j].centre,
                                     .radius_m = d->layout->hinge[j].keep_out_m};
    for (int i = 0; i < before; i++) {
        const char *id = fw_text_name(d->comb[i].comb->id);
        if (d->comb[i].off) continue;
        const fw_geometry_contour *own[] = {&d->comb[i].rotor, &d->comb[i].stator};
        for (int k = 0; k < 2; k++)
            FW_TRY(add_outline(d->arena, o, fw_text_kind("comb drive ", id), id, FW_NONE, own[k],
                               0.0));
    }
    return FW_OK;
}

/* besides: the rings of others, and where the bar between two ground hinges will be */
static fw_status list_for_stator(const fw_layout_drawing *d, int rotor, int before, obstacles *o) {
    int joint[3];
    FW_TRY(list_obstacles(d, rotor, before, o));
    for (int i = 0; i < d->neyelet; i++) {
        const fw_layout_eyelet_plan *e = &d->eyelet[i];
        if (!e->off)
            o->item[o->n++] =
                (obstacle){.kind = *fw_text_kind("tendon ", e->tendon->id) ? "an eyelet of tendon "
                                                                           : "an eyelet of ",
                           .id = e->tendon->id ? e->tendon->id : "",
                           .centre = e->at,
                           .radius_m = 0.5 * e->hole_m + e->ring_m + LEAST_M};
    }
    if (fw_layout_body_joints(d->device, FW_GROUND, joint, 3) == 2 && !fw_layout_own_bases(d)) {
        fw_geometry_contour *bar = fw_arena_one(d->arena, fw_geometry_contour);
        FW_NEED(bar);
        FW_TRY(fw_geometry_contour_bar(
            d->arena, fw_layout_joint_point(d->device, joint[0]),
            fw_layout_joint_point(d->device, joint[1]),
            fmax(fw_layout_rule.base_width_m, d->device->die.anchor_m) + BASE_M, bar));
        FW_TRY(add_outline(d->arena, o, "", "the base", FW_NONE, bar, LEAST_M));
    }
    return FW_OK;
}

/* the first one that is nearer than the space; NULL: none */
static const obstacle *crossed(const obstacles *o, const fw_geometry_contour *c, double space_m,
                               fw_geometry_vec2 *at) {
    const fw_geometry_box box = fw_geometry_contour_box(c);
    for (int i = 0; i < o->n; i++) {
        const obstacle *p = &o->item[i];
        const double space = p->space_m > 0.0 ? p->space_m : space_m;
        if (p->outline.contour ? close_by(c, box, p, space, at)
                               : disc_close_by(c, box, p->centre, p->radius_m, at))
            return p;
    }
    return NULL;
}

static fw_status name(fw_layout_drawing *d, const obstacle *o, fw_geometry_vec2 at,
                      const char **what) {
    char x[32], y[32];
    const char *id = o->id ? o->id : fw_layout_body_label(d, o->body);
    FW_NEED(id);
    FW_NEED(*what = fw_arena_printf(d->arena, "%s%s at (%s, %s) um", o->kind, id,
                                    fw_layout_um(x, at.x), fw_layout_um(y, at.y)));
    return FW_OK;
}

/* *what: what is crossed first, and where; NULL: nothing */
static fw_status name_crossed(fw_layout_drawing *d, const obstacles *o,
                              const fw_geometry_contour *c, double space_m, const char **what) {
    fw_geometry_vec2 at;
    const obstacle *p = crossed(o, c, space_m, &at);
    *what = NULL;
    return p ? name(d, p, at, what) : FW_OK;
}

fw_status fw_layout_actuator_crosses(fw_layout_drawing *d, const fw_geometry_contour *c, int body,
                                     double space_m, int before, const char **what) {
    obstacles all;
    fw_geometry_vec2 at;
    fw_mark mark = fw_arena_mark(d->arena);
    *what = NULL;
    FW_TRY(list_obstacles(d, body, before, &all));
    const obstacle *p = crossed(&all, c, space_m, &at), first = p ? *p : (obstacle){0};
    fw_arena_rewind(d->arena, mark);
    return p ? name(d, &first, at, what) : FW_OK;
}

/* ---- lead and pad ---- */

typedef struct candidate {
    double from, ahead, aside; /* along the bar; away from it; then to one side */
    const char *letter;
    double letter_m; /* width of it */
} candidate;

static double pad_of(const fw_layout_drawing *d) {
    return d->device->die.pad_m > 0.0 ? d->device->die.pad_m : PAD_M;
}

/* from the electrode, around one corner or none, into the middle of the pad */
typedef struct lead {
    fw_geometry_vec2 start, beyond, corner, middle; /* beyond: half a lead past the corner */
    bool turns;
    fw_geometry_box pad; /* axis-parallel, on the grid */
    fw_geometry_vec2 letter_at, pad_at;
} lead;

static lead lead_of(const fw_layout_drawing *d, const fw_layout_comb_plan *p, const candidate *c) {
    double face = p->comb->kind == FW_ELECTRODES_COMB ? p->length_m - 0.5 * p->comb->overlap_m
                                                      : p->comb->gap_m;
    fw_geometry_vec2 u = fw_v(p->local.c, p->local.s), n = fw_left(u), way = u;
    lead l = {.turns = c->aside != 0.0};
    l.start = fw_add(fw_add(p->local.origin, face + 0.5 * BACK_M, u), c->from, n);
    l.corner = fw_add(l.start, 0.5 * BACK_M + c->ahead, u);
    fw_geometry_vec2 end = l.corner;
    if (l.turns) {
        way = c->aside > 0.0 ? n : fw_v(-n.x, -n.y);
        end = fw_add(end, c->aside, n);
        l.beyond = fw_add(l.corner, 0.5 * BACK_M, u);
    }
    double text = c->letter_m, pad = pad_of(d), wide = fmax(pad, text + 2.0 * MARGIN_M),
           strip = 9.0 * STROKE_M + 2.0 * MARGIN_M;
    double high = pad + strip;
    double reach = fmin(fabs(way.x) > 1e-9 ? 0.5 * wide / fabs(way.x) : HUGE_VAL,
                        fabs(way.y) > 1e-9 ? 0.5 * high / fabs(way.y) : HUGE_VAL);
    l.middle = fw_add(end, reach - 0.25 * BACK_M, way);
    double x0 = fw_layout_to_grid(l.middle.x - 0.5 * wide),
           y0 = fw_layout_to_grid(l.middle.y - 0.5 * high);
    l.pad = (fw_geometry_box){x0, y0, x0 + wide, y0 + high};
    l.letter_at =
        fw_v(fw_layout_to_grid(x0 + 0.5 * (wide - text)), fw_layout_to_grid(y0 + MARGIN_M));
    l.pad_at = fw_v(fw_layout_to_grid(x0 + 0.5 * wide), fw_layout_to_grid(y0 + strip + 0.5 * pad));
    return l;
}

/* The bars of a lead and its pad, each a part to unite, where all of them keep their distance from everything: npart 0
   where not. The pad is in the way most often, so that nothing else is drawn then. */
static fw_status draw_lead(fw_layout_drawing *d, const lead *l, const obstacles *all,
                           double space_m, fw_geometry_contour part[3], int *npart) {
    fw_geometry_contour pad;
    fw_geometry_vec2 at;
    int n = 0;
    *npart = 0;
    FW_TRY(fw_geometry_contour_rectangle(d->arena, l->pad, &pad));
    if (crossed(all, &pad, space_m, &at)) return FW_OK;
    if (l->turns)
        FW_TRY(fw_geometry_contour_bar(d->arena, l->start, l->beyond, BACK_M, &part[n++]));
    /* into the middle of the pad, whatever its edge is like where it is reached */
    FW_TRY(fw_geometry_contour_bar(d->arena, l->turns ? l->corner : l->start, l->middle, BACK_M,
                                   &part[n++]));
    for (int i = 0; i < n; i++)
        if (crossed(all, &part[i], space_m, &at)) return FW_OK;
    part[n++] = pad;
    *npart = n;
    return FW_OK;
}

static fw_status unite(fw_arena *arena, const fw_geometry_contour *electrode,
                       const fw_geometry_contour *part, int npart, fw_geometry_contour *out,
                       bool *good) {
    fw_geometry_contour whole = *electrode;
    fw_geometry_vec2 where;
    *good = false;
    for (int i = 0; i < npart; i++) {
        fw_geometry_region a = {&whole, 1}, b = {(fw_geometry_contour *)&part[i], 1}, both;
        fw_status status = fw_geometry_region_boolean(arena, &a, &b, FW_UNION, &both);
        if (status == FW_GEOMETRY || (status == FW_OK && both.count != 1)) return FW_OK;
        FW_TRY(status);
        whole = both.contour[0];
    }
    fw_status status = fw_geometry_contour_round(arena, &whole, fw_layout_rule.corner_m,
                                                 fw_layout_rule.corner_m, out, &where);
    *good = status == FW_OK;
    return status == FW_GEOMETRY ? FW_OK : status;
}

static fw_status try_lead(fw_layout_drawing *d, fw_layout_comb_plan *p,
                          const fw_geometry_contour *electrode, const obstacles *all,
                          const candidate *c, double space_m, bool *done) {
    fw_geometry_contour part[3], whole;
    const lead l = lead_of(d, p, c);
    int npart;
    *done = false;
    FW_TRY(draw_lead(d, &l, all, space_m, part, &npart));
    if (npart == 0) return FW_OK;
    FW_TRY(unite(d->arena, electrode, part, npart, &whole, done));
    if (!*done) return FW_OK;
    p->stator = whole;
    p->letter = c->letter;
    p->letter_at = l.letter_at, p->pad_at = l.pad_at;
    return FW_OK;
}

/* the nearest place: straight on first, then round one corner; the drive's id on the pad where that
   is short enough and there is room, else its number */
static fw_status find_place(fw_layout_drawing *d, fw_layout_comb_plan *p,
                            const fw_geometry_contour *electrode, bool *done) {
    obstacles all; /* its own rotor's body is one */
    static const double ahead[] = {60e-6,  80e-6,  110e-6, 150e-6, 220e-6,
                                   320e-6, 450e-6, 650e-6, 900e-6, 1300e-6},
                        from[] = {0.0, 0.4, -0.4, 0.8, -0.8},
                        aside[] = {0.0,    200e-6,  -200e-6, 400e-6,  -400e-6,
                                   700e-6, -700e-6, 1100e-6, -1100e-6};
    int n = p->comb->fingers;
    double half = p->comb->kind == FW_ELECTRODES_COMB
                      ? n * (p->width_m + p->comb->gap_m) + 0.5 * p->width_m
                      : 0.5 * p->length_m + p->comb->gap_m + LONGER_M;
    const char *number = fw_arena_printf(d->arena, "V%d", (int)(p - d->comb) + 1),
               *id = p->comb->id;
    FW_NEED(number);
    half = fmax(0.0, half - 0.5 * BACK_M);
    *done = false;
    FW_TRY(list_for_stator(d, FW_NONE, (int)(p - d->comb), &all));
    for (int round = 0; round < 4; round++) {
        double space = round < 2 ? FREE_M : LEAST_M;
        bool named = round % 2 == 0;
        if (named && (!id || strlen(id) > LETTERS || fw_layout_text_lacks(id))) continue;
        const char *letter = named ? id : number;
        double letter_m = fw_layout_text_width(letter, 9.0 * STROKE_M, STROKE_M);
        for (size_t t = 0; t < sizeof aside / sizeof aside[0]; t++)
            for (size_t a = 0; a < sizeof ahead / sizeof ahead[0]; a++)
                for (size_t f = 0; f < sizeof from / sizeof from[0]; f++) {
                    candidate c = {from[f] * half, ahead[a], aside[t], letter, letter_m};
                    if (half <= 0.0 && f > 0) continue;
                    fw_mark mark = fw_arena_mark(d->arena);
                    FW_TRY(try_lead(d, p, electrode, &all, &c, space, done));
                    if (*done) return FW_OK;
                    fw_arena_rewind(d->arena, mark);
                }
    }
    return FW_OK;
}

/* what makes a drive impossible whatever is around it */
static fw_status impossible(fw_layout_drawing *d, const fw_layout_comb_plan *p, const char **why) {
    const fw_device_comb *c = p->comb;
    char um[32];
    *why = NULL;
    if (c->body_a >= 0) {
        *why = "its stator is on a body, which is joined to the rotor in the layer: nothing "
               "insulates one from the other";
    } else if (c->kind == FW_ELECTRODES_COMB && c->fingers > FINGERS_MOST) {
        *why = "more than 100 fingers of one comb are computed, but not drawn";
    } else if (c->kind == FW_ELECTRODES_COMB &&
               p->length_m - c->overlap_m < fw_layout_rule.corner_m * (1.0 - 1e-9)) {
        FW_NEED(*why = fw_arena_printf(d->arena,
                                       "its fingers end %s um before the root of the others, and "
                                       "10 um are needed for the corners there: make them longer",
                                       fw_layout_um(um, p->length_m - c->overlap_m)));
    }
    return FW_OK;
}

fw_status fw_layout_stator_place(fw_layout_drawing *d, fw_layout_comb_plan *p, const char **why) {
    fw_geometry_contour electrode;
    obstacles all;
    const char *what;
    bool done;
    p->stator = (fw_geometry_contour){NULL, 0};
    p->routed = false;
    FW_TRY(impossible(d, p, why));
    if (*why) return FW_OK;
    FW_TRY(fw_layout_comb_stator(d->arena, p, &electrode));
    FW_TRY(list_for_stator(d, p->comb->body_b, (int)(p - d->comb), &all));
    FW_TRY(name_crossed(d, &all, &electrode, LEAST_M, &what));
    if (!what) {
        all.n = 0;
        FW_TRY(add_outline(d->arena, &all, "its own rotor's body ", NULL, p->comb->body_b,
                           &d->plain[p->comb->body_b], p->comb->gap_m * (1.0 - 1e-6)));
        FW_TRY(name_crossed(d, &all, &electrode, LEAST_M, &what));
    }
    if (what) {
        FW_NEED(*why =
                    fw_arena_printf(d->arena, "its stator would cross or nearly touch %s", what));
        return FW_OK;
    }
    FW_TRY(find_place(d, p, &electrode, &done));
    if (!done)
        *why = "between the bodies around it there is no free place for its lead and its bond pad "
               "(150 um by 215 um, 20 um from everything)";
    return FW_OK;
}

/* ---- stators, as what else is drawn sees them ---- */

bool fw_layout_stators_drawn(const fw_layout_drawing *d) {
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off) return true;
    return false;
}

bool fw_layout_near_stator(const fw_layout_drawing *d, const fw_geometry_contour *c,
                           double space_m) {
    for (int i = 0; i < d->ncomb; i++) {
        const fw_geometry_contour *s = &d->comb[i].stator;
        if (d->comb[i].off || s->count == 0) continue;
        if (fw_geometry_contour_distance_below(s, c, space_m, NULL, NULL) < space_m ||
            fw_geometry_contour_contains(c, s->segment[0].a))
            return true;
    }
    return false;
}

const fw_layout_electrode *fw_layout_electrode_of(const fw_layout *layout,
                                                  const fw_device_comb *comb) {
    for (int i = 0; i < layout->nelectrode; i++)
        if (fw_device_same_comb(layout->electrode[i].comb, comb)) return &layout->electrode[i];
    return NULL;
}
