/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clearances of a motion, judged: of what may meet, and of flexures that bend onto their own two bodies. */
#include "base/constants.h"
#include "base/text.h"
#include "clearance/clearance.h"
#include "geometry/segment.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- what may meet ----
   What clearance/ proves holds for the outlines as drawn and the motion as computed. Of the band: walls as they are
   made come nearer by 2 edge + |flare|; a motion that is off by the share e (its numbers, and what its model of the
   hinges is off by) moves every part by at most e times as far as the pair has moved against each other. Theory:
   docs/theory/clearance.md, section 5. Test: tests/clearance/cases.py, compare.py */

/* of the least clearance, beside 1 nm; distances that are computed for it, and while nothing is decided */
static const double fw_clearance_relative = 2e-3;
/* what a long motion, which is looked at in parts, is taken to be off by; one that is off by more is not decided */
static const double fw_off_at_most = 0.1;
const double fw_verdict_clearance_counts = 0.3;
enum { MOST = 1000, MOST_IN_BOX = 2000, MOST_EVER = 100000 };

static double required(const fw_device *device) {
    return isnan(device->limits.clearance_m) ? 0 : device->limits.clearance_m;
}

/* a bound that is above what is asked for by a tenth of it is enough, and by 1 um where nothing is */
static fw_clearance_wish wish_of(const fw_device *device, const fw_layout *layout,
                                 const bool *may_meet) {
    double asked = required(device);
    return (fw_clearance_wish){.may_meet = may_meet,
                               .relative = fw_clearance_relative,
                               .enough_m = HUGE_VAL,
                               .needed_m =
                                   fw_layout_walls_m(layout) + asked + fmax(1e-6, 0.1 * asked),
                               .most = MOST,
                               .most_ever = MOST_EVER};
}

/* bodies without the discs that hold their flexures, and of what stands one stator */
static fw_status stator_alone(fw_arena *arena, const fw_clearance_things *things, const char *label,
                              fw_clearance_things *out) {
    *out = (fw_clearance_things){.nbody = things->nbody};
    FW_NEED(out->solid = fw_arena_array(arena, fw_clearance_solid, (size_t)things->nbody + 1));
    for (int i = 0; i <= things->nbody; i++) {
        const fw_clearance_solid *from = &things->solid[i];
        fw_clearance_solid *to = &out->solid[i];
        *to = *from;
        to->count = 0;
        FW_NEED(to->edge = fw_arena_array(arena, fw_clearance_edge, (size_t)from->count));
        for (int k = 0; k < from->count; k++) {
            const fw_clearance_edge *e = &from->edge[k];
            if (e->bends || (i == things->nbody && e->label != label)) continue;
            fw_geometry_box box = fw_segment_box(&e->segment);
            to->box = to->count ? fw_box_join(to->box, box) : box;
            to->edge[to->count++] = *e;
        }
    }
    return FW_OK;
}

/* pairs of bodies: they are not looked at where one stator is */
static fw_status all_bodies(fw_arena *arena, const fw_clearance_things *things, bool **among) {
    const int n = things->nbody + 1;
    FW_NEED(*among = fw_arena_array(arena, bool, (size_t)n *(size_t)n));
    for (int i = 0; i < n * n; i++)
        (*among)[i] = i % n < n - 1 && i / n < n - 1;
    return FW_OK;
}

/* the stators of a layout, for a watch of what is drawn */
static fw_status watch_stators(fw_arena *arena, const fw_layout *layout,
                               fw_verdict_clearance_watch *w) {
    if (layout->nelectrode == 0) return FW_OK;
    FW_NEED(w->stator = fw_arena_array(arena, fw_verdict_stator_watch, (size_t)layout->nelectrode));
    bool *among;
    FW_TRY(all_bodies(arena, w->things, &among));
    w->among = among;
    for (int i = 0; i < layout->nelectrode; i++) {
        const char *label = layout->electrode[i].stator;
        if (!label) continue;
        fw_verdict_stator_watch *s = &w->stator[w->nstator++];
        *s = (fw_verdict_stator_watch){.label = label, .least = fw_clearance_nothing()};
        FW_TRY(stator_alone(arena, w->things, label, &s->things));
    }
    return FW_OK;
}

fw_status fw_verdict_clearance_begin(fw_arena *arena, const fw_layout *layout,
                                     const fw_mechanism *m, bool with_stators,
                                     fw_verdict_clearance_watch watch[2],
                                     fw_verdict_variant_verdict *v) {
    fw_clearance_things *things;
    size_t most = (size_t)m->device->nscene + (size_t)m->device->nworkspace;
    size_t solids = (size_t)m->nbody + 1;
    watch[0] = watch[1] = (fw_verdict_clearance_watch){.things = NULL};
    v->nclearance = v->nstator = 0;
    v->things = NULL;
    if (!layout || !layout->drawn) return FW_OK;
    FW_NEED(v->clearance = fw_arena_array(arena, fw_verdict_clearance, most));
    FW_NEED(things = fw_arena_one(arena, fw_clearance_things));
    FW_TRY(fw_clearance_things_of(arena, layout, m, things));
    v->things = things;
    bool *may_meet = fw_arena_array(arena, bool, solids *solids);
    FW_NEED(may_meet);
    for (int i = 0; i < 2; i++) {
        watch[i].things = things;
        watch[i].arena = arena;
        watch[i].wish = wish_of(m->device, layout, may_meet);
        watch[i].within_m = fw_layout_walls_m(layout) + required(m->device);
        FW_TRY(fw_clearance_path_new(arena, m->nbody, &watch[i].path));
        if (with_stators) FW_TRY(watch_stators(arena, layout, &watch[i]));
    }
    if (watch[0].nstator > 0)
        FW_NEED(v->stator =
                    fw_arena_array(arena, fw_wiring_moved, (size_t)watch[0].nstator * most));
    return FW_OK;
}

/* a stated place and a drawn wall, whose corners are rounded, need not agree better */
static const double touches_m = 10e-6;

/* Is the round thing about this point, no larger than the distance, part of what is drawn of the body? A bead that is
   held stands in the open: the ground may carry it, and its frame is none of it. */
static bool is_drawn_there(const fw_mechanism *m, const fw_clearance_things *things, int body,
                           double x_m, double y_m, double distance_m) {
    const fw_clearance_solid *solid = &things->solid[body == FW_GROUND ? things->nbody : body];
    const fw_geometry_vec2 at = fw_mechanism_local_place(m, body, x_m, y_m);
    for (int i = 0; i < solid->count; i++)
        if (!solid->edge[i].bends && fw_geometry_segment_nearest(&solid->edge[i].segment, at, NULL,
                                                                 NULL) <= distance_m + touches_m)
            return true;
    return solid->count == 0;
}

static bool lets_meet(const fw_mechanism *m, const fw_clearance_things *things,
                      const fw_device_contact_use *c) {
    if (c->joint != FW_NONE || c->side == FW_CONTACT_INSIDE) /* a hole is open */
        return c->joint == FW_NONE;
    return is_drawn_there(m, things, c->body_a, c->ax_m, c->ay_m, c->distance_m) &&
           is_drawn_there(m, things, c->body_b, c->bx_m, c->by_m, c->distance_m);
}

/* pairs of which the scene says itself what happens when they touch; conjugate surfaces are no edges here at all */
fw_status fw_verdict_clearance_scene(const fw_mechanism *m, const fw_device_scene *scene,
                                     fw_verdict_clearance_watch watch[2]) {
    const fw_clearance_things *things = watch[0].things;
    if (!things) return FW_OK;
    const int n = things->nbody + 1;
    bool *may_meet = (bool *)watch[0].wish.may_meet; /* ours: of both watches */
    for (int i = 0; i < n * n; i++)
        may_meet[i] = false;
    for (int i = 0; i < scene->ncontact; i++) {
        const fw_device_contact_use *c = &scene->contact[i];
        if (!lets_meet(m, things, c)) continue;
        int a = c->body_a == FW_GROUND ? n - 1 : c->body_a,
            b = c->body_b == FW_GROUND ? n - 1 : c->body_b;
        may_meet[a * n + b] = may_meet[b * n + a] = true;
    }
    return FW_OK;
}

static void empty(fw_verdict_clearance_watch *w) {
    w->path.npiece = 0;
}

/* what is in the path so far leaves it */
static fw_status consume(fw_verdict_clearance_watch *w) {
    if (w->path.npiece > 0) {
        FW_TRY(fw_clearance_of_path(w->arena, w->things, &w->path, &w->wish, &w->least));
        if (w->ways)
            FW_TRY(fw_clearance_way_of_path(w->arena, w->things, &w->path, &w->wish, w->within_m,
                                            &w->way));
        fw_clearance_wish wish = w->wish; /* bodies among each other were looked at */
        wish.may_meet = w->among;
        wish.enough_m = HUGE_VAL;
        for (int i = 0; i < w->nstator; i++)
            FW_TRY(fw_clearance_of_path(w->arena, &w->stator[i].things, &w->path, &wish,
                                        &w->stator[i].least));
    }
    empty(w);
    return FW_OK;
}

void fw_verdict_clearance_trace(void *context, const fw_dynamics_piece *piece) {
    const fw_verdict_strain_monitor *monitor = context;
    fw_verdict_clearance_watch *w = monitor->clearance;
    if (monitor->probe) fw_probe_monitor_trace(monitor->probe, piece);
    if (!w || !w->things) return;
    if (!piece) {
        empty(w);
        w->path.begun = false;
        w->path.njump = 0;
        w->path.jump_m = 0;
        w->parts = false, w->wish.beyond = 0;
        w->least = fw_clearance_nothing();
        w->way = (fw_clearance_way){.share = fw_verdict_clearance_counts};
        for (int i = 0; i < w->nstator; i++)
            w->stator[i].least = fw_clearance_nothing();
        w->status = FW_OK;
        return;
    }
    if (w->status == FW_OK && fw_clearance_path_full(&w->path)) {
        w->wish.off = fw_off_at_most, w->wish.beyond = 1;
        w->parts = true;
        w->status = consume(w);
    }
    if (w->status == FW_OK) fw_clearance_path_add(&w->path, piece);
}

/* ---- judged ---- */

/* of its motion, with which the pair keeps what is asked for: known where it meets; else distance falls in proportion */
static double keep_of(const fw_verdict_clearance *c, double target_m) {
    const fw_clearance_least *l = &c->least;
    if (l->m <= 0) return l->share;
    double lost = l->start_m - l->m;
    return lost > 0 ? fmin(1, fmax(0, (l->start_m - target_m) / lost)) : 0.5;
}

/* a pair that meets after a share of its motion is rejected where it would with a motion less by its error, too */
static void decide(fw_verdict_clearance *c, double off) {
    const fw_clearance_least *l = &c->least;
    double band = off * l->moved_m;
    c->m = l->m - c->wall_m;
    c->low_m = (isfinite(l->low_m) ? l->low_m : -band) - c->wall_m - c->parts_m;
    c->high_m = c->m + band;
    bool meet = l->m <= 0;
    bool enough = c->required_m > 0 ? c->low_m >= c->required_m : c->low_m > 0;
    bool less = c->required_m > 0 ? c->high_m < c->required_m : c->high_m < 0;
    if (meet) less = less || l->share * (1 + off) < 1;
    if (meet && less) c->high_m = fmin(c->high_m, c->m);
    c->decision = enough ? FW_ACCEPT : less ? FW_REJECT : FW_INCONCLUSIVE;
    if (l->at.bound && c->decision == FW_REJECT) c->decision = FW_INCONCLUSIVE;
    c->keep = keep_of(c, c->required_m + c->wall_m);
}

static const char *micrometres(char text[32], double m) {
    return fw_number_text(text, 32, 1e6 * m, 3);
}

static const char *name_of(const char *label) {
    return label ? label : "a part";
}

/* "link AB and the frame meet", "... come within 3.2 um of each other" */
static const char *what_happens(fw_arena *arena, const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    char drawn[32], made[32], low[32], high[32], asked[32];
    if (l->m <= 0)
        return l->at.bound ? "may meet: the strip's bent shape is only bounded," : "meet";
    const char *text = fw_arena_printf(arena, "come within %s um of each other as drawn",
                                       micrometres(drawn, l->m));
    if (text && fw_clearance_has_no_band(l))
        return fw_arena_printf(arena, "%s, and how far links go there is not bounded,", text);
    if (text && c->wall_m != 0)
        text = fw_arena_printf(arena, "%s, %s um as made", text, micrometres(made, c->m));
    if (text)
        text = fw_arena_printf(arena, "%s (%s to %s um with the errors of the motion)", text,
                               micrometres(low, c->low_m), micrometres(high, c->high_m));
    if (text && c->required_m > 0)
        text = fw_arena_printf(arena, "%s, and %s um are asked for", text,
                               micrometres(asked, c->required_m));
    return text;
}

/* in um, to a nanometre: a coordinate of 0 has been rounded off */
static const char *place_text(char text[32], double x_m) {
    return fw_number_text(text, 32, 1e-3 * nearbyint(1e9 * x_m) + 0.0, 5);
}

static const char *mend_of(fw_arena *arena, const fw_verdict_clearance *c,
                           const fw_verdict_variant_verdict *v) {
    const char *beside = c->box == FW_NONE ? v->motion[c->scene_index]->ledger.undecided : NULL;
    if (c->parts_m > 0 && c->low_m + c->parts_m > c->required_m)
        return beside ? fw_arena_printf(
                            arena,
                            "that is enough, but the motion may be off by more than the 10 %% "
                            "that parts of a long scene are followed with, because %s: lower that "
                            "first (FW-D607)",
                            beside)
                      : "that is enough, but so long a scene is followed in parts, and what its "
                        "motion is off by beyond 10 % comes off as of what moves farthest: shorten "
                        "the scene, or make bodies that give stiffer";
    if (fw_clearance_has_no_band(&c->least))
        return "require poses farther from the limit of reach, where a leg is all but stretched";
    if (c->least.at.tether)
        return "a tether stands first on the frame's nearest side: turn that side from the motion, "
               "widen <die clearance>, or hold the body in another way (<die tethers=\"no\"/>)";
    if (strncmp(name_of(c->least.at.b), "frame", 5) == 0)
        return "give the frame more room (<die clearance>) or let it move less; where they are to "
               "meet, give the scene a <contact>";
    return c->box != FW_NONE || c->least.at.lane
               ? "draw them further apart or let them move less"
               : "draw them further apart or let them move less; where they are to meet, give the "
                 "scene a <contact>";
}

static fw_status give_reason(fw_arena *arena, const fw_verdict_clearance *c, const char *where,
                             fw_verdict_variant_verdict *v) {
    const fw_clearance_least *l = &c->least;
    const bool unknown = l->given_up || l->at.bound || fw_clearance_has_no_band(l);
    char x[32], y[32], share[32];
    if (c->decision == FW_ACCEPT) return FW_OK;
    const char *what = what_happens(arena, c), *mend = mend_of(arena, c, v), *then = "", *text;
    if (c->box == FW_NONE && (l->m <= 0 || c->keep < 1))
        then = fw_arena_printf(arena, "; with %s %% of that motion %s",
                               fw_number_text(share, sizeof share, 100 * c->keep, 3),
                               c->required_m > 0 ? "they keep what is asked for"
                                                 : "they would just not meet");
    FW_NEED(what && mend && then ? then : NULL);
    FW_NEED(text =
                fw_arena_printf(arena, "%s and %s %s in %s, at (%s, %s) um%s: %s", name_of(l->at.a),
                                name_of(l->at.b), what, where, place_text(x, l->at.at_a.x),
                                place_text(y, l->at.at_a.y), then, mend));
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = c->scene,
                                                  .flow = c->flow,
                                                  .number = unknown ? 295 : 294,
                                                  .decision = c->decision,
                                                  .keep = fmin(fmax(0.98 * c->keep, 1e-3), 0.99),
                                                  .text = text};
    return FW_OK;
}

/* where a sequence of equilibria jumps nothing says which way the mechanism takes */
static void warn_jump(const fw_device_scene *scene, const fw_clearance_path *path,
                      fw_diags *diags) {
    char t[32], by[32];
    fw_diag_warning(
        diags, 296, scene->place,
        "%s%s goes at once, after %s ms, from one equilibrium to another (%s um of a "
        "body's centre of mass): between them clearances are those of the straight way, "
        "and the real one is not known without inertia",
        FW_NAMED("scene", scene->name), fw_number_text(t, sizeof t, 1e3 * path->jump_s, 4),
        fw_number_text(by, sizeof by, 1e6 * path->jump_m, 3));
}

static fw_wiring_moved moved_of(const char *stator, const char *scene, int index,
                                const fw_clearance_least *l) {
    return (fw_wiring_moved){stator,    scene,      index,      l->m,
                             l->t_s,    l->start_m, l->moved_m, isfinite(l->low_m) ? l->low_m : 0,
                             l->at.at_a};
}

fw_status fw_verdict_clearance_judge(fw_arena *arena, const fw_device_scene *scene, int i,
                                     const fw_layout *layout, bool brief, fw_diags *diags,
                                     fw_verdict_variant_verdict *v) {
    const fw_dynamics_motion *motion = v->motion[i];
    if (!v->things || !motion || motion->ended || !motion->observed) return FW_OK;
    fw_verdict_clearance_watch *w = ((fw_verdict_strain_monitor *)motion->observed)->clearance;
    double off = fw_verdict_motion_model_error(v->mechanism, motion) +
                 fw_dynamics_motion_ways_off(motion, true) + fw_verdict_bending_moving(motion);
    if (!isfinite(off)) off = 1;
    FW_TRY(w->status);
    w->wish.off = w->parts ? fmax(off, fw_off_at_most) : off;
    w->wish.enough_m = brief ? w->wish.needed_m + v->bends_m : HUGE_VAL;
    if (w->path.njump > 0) warn_jump(scene, &w->path, diags);
    FW_TRY(consume(w));
    const double more = w->parts ? fmax(0, off - fw_off_at_most) : 0;
    for (int k = 0; k < w->nstator; k++) {
        fw_clearance_least *l = &w->stator[k].least;
        l->low_m -= more * l->farthest_m;
        if (l->known) v->stator[v->nstator++] = moved_of(w->stator[k].label, scene->name, i, l);
    }
    if (!w->least.known) return FW_OK; /* nothing moves against anything */
    fw_verdict_clearance *c = &v->clearance[v->nclearance++];
    *c = (fw_verdict_clearance){.scene = scene->name,
                                .flow = v->mechanism->variant->flow,
                                .scene_index = i,
                                .box = FW_NONE,
                                .least = w->least,
                                .way = w->way,
                                .parts_m = more * w->least.farthest_m,
                                .wall_m = fw_layout_walls_m(layout),
                                .required_m = required(v->mechanism->device)};
    decide(c, off);
    c->least.given_up = c->least.given_up || (c->parts_m > 0 && c->decision == FW_INCONCLUSIVE);
    char t[32];
    const char *where = fw_arena_printf(arena, "%s%s after %s ms", FW_NAMED("scene", scene->name),
                                        fw_number_text(t, sizeof t, 1e3 * c->least.t_s, 4));
    FW_NEED(where);
    return give_reason(arena, c, where, v);
}

/* once: what rides on the platform or on a link and does not go with it as drawn */
static fw_status say_open(fw_arena *arena, const fw_device *device, int body,
                          fw_verdict_variant_verdict *v) {
    const char *text;
    for (int i = 0; i < v->nreason; i++)
        if (v->reason[i].number == 295 && v->reason[i].not_by_loads) return FW_OK;
    FW_NEED(
        text = fw_arena_printf(
            arena,
            "how near %s%s comes in the required workspace is not known: it rides on the "
            "six-bar by a joint without a flexure or is pulled by a spring, so that its pose does "
            "not follow from the platform's: hold it by a flexure or a weld",
            FW_NAMED("body", device->body[body].id)));
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = "workspace",
                                                  .flow = v->mechanism->variant->flow,
                                                  .number = 295,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = FW_VERDICT_KEEP_HALF,
                                                  .not_by_loads = true,
                                                  .not_by_width = true,
                                                  .text = text};
    return FW_OK;
}

/* the least distance of every stator from all that moves, over the poses of a required box */
static fw_status stators_of_box(fw_arena *arena, const fw_layout *layout, int index,
                                const fw_clearance_wish *wish, fw_verdict_variant_verdict *v) {
    const fw_device_workspace_box *box = &v->mechanism->device->workspace[index];
    fw_clearance_wish own = *wish;
    bool *among;
    FW_TRY(all_bodies(arena, v->things, &among));
    own.may_meet = among;
    for (int i = 0; v->stator && i < layout->nelectrode; i++) {
        const char *label = layout->electrode[i].stator;
        fw_clearance_things alone;
        fw_clearance_least least = fw_clearance_nothing();
        bool known;
        int open;
        if (!label) continue;
        FW_TRY(stator_alone(arena, v->things, label, &alone));
        FW_TRY(fw_clearance_of_box(arena, &alone, v->mechanism, box, &own, &least, &known, &open));
        if (!known || !least.known) continue;
        least.t_s = (double)NAN;
        v->stator[v->nstator++] =
            moved_of(label, "workspace", v->mechanism->device->nscene + index, &least);
    }
    return FW_OK;
}

/* Required poses are what the platform is asked to take: where it goes itself the only errors are those of the walls.
   Links go by what their hinges are: as far off as motions with that model. */
fw_status fw_verdict_clearance_boxes(fw_arena *arena, const fw_device *device,
                                     const fw_layout *layout, bool brief,
                                     fw_verdict_variant_verdict *v) {
    for (int i = 0; v->things && v->workspace.required && i < device->nworkspace; i++) {
        const fw_device_workspace_box *asked = &device->workspace[i];
        bool known;
        int open;
        if (!v->workspace.asked[i] || !v->workspace.box_reachable[i]) continue;
        fw_clearance_wish wish = wish_of(device, layout, NULL);
        wish.off = fw_verdict_model_error.motion;
        wish.most = MOST_IN_BOX;
        if (brief) wish.enough_m = wish.needed_m;
        fw_clearance_least least = fw_clearance_nothing();
        FW_TRY(fw_clearance_of_box(arena, v->things, v->mechanism, asked, &wish, &least, &known,
                                   &open));
        if (open != FW_NONE) FW_TRY(say_open(arena, device, open, v));
        FW_TRY(stators_of_box(arena, layout, i, &wish, v));
        if (!known || !least.known) continue;
        fw_verdict_clearance *c = &v->clearance[v->nclearance++];
        *c = (fw_verdict_clearance){.scene = "workspace",
                                    .flow = v->mechanism->variant->flow,
                                    .scene_index = FW_NONE,
                                    .box = i,
                                    .least = least,
                                    .wall_m = fw_layout_walls_m(layout),
                                    .required_m = required(device)};
        decide(c, wish.off);
        if (least.m <= 0 && !least.at.bound)
            c->decision = FW_REJECT; /* a pose that is required meets */
        char x[32], y[32], phi[32];
        const char *where =
            fw_arena_printf(arena, "the required pose dx = %s um, dy = %s um, turned by %s deg",
                            fw_number_text(x, sizeof x, 1e6 * least.platform[0], 4),
                            fw_number_text(y, sizeof y, 1e6 * least.platform[1], 4),
                            fw_number_text(phi, sizeof phi, FW_DEG_PER_RAD * least.platform[2], 3));
        FW_NEED(where);
        FW_TRY(give_reason(arena, c, where, v));
    }
    return FW_OK;
}

/* ---- flexures and their own bodies ----
   Flexures that bend onto their own two bodies: what turned and strained each most, in all scenes and
   required poses, bounds where its strip can be (clearance/clearance_strip.c). What a flow makes of
   walls and widths is allowed for and not run again at every corner. Test: tests/clearance/cases.py */

/* of rotation and curvature, and on either wall: more than corners differ by from the drawn device */
static const double fw_made_share = 0.1, fw_made_m = 1e-6;

typedef struct seen {            /* most of a hinge */
    double turn, strain, forced; /* forced: HUGE_VAL where it is not known apart */
} seen;

static seen most_of_scenes(const fw_verdict_variant_verdict *v, int k) {
    const fw_mechanism *m = v->mechanism;
    const int pin = m->hinge[k].pin;
    seen most = {0, 0, 0};
    for (int i = 0; i < m->device->nscene; i++) {
        const fw_dynamics_motion *motion = v->motion[i];
        if (!motion || !motion->observed) continue;
        const fw_verdict_strain_monitor *saw = motion->observed;
        double off = fw_verdict_motion_model_error(m, motion);
        const fw_dynamics_peak *peak = &motion->peak[pin];
        double error = isfinite(peak->error_rad) ? peak->error_rad : 0;
        most.turn = fmax(most.turn, fabs(peak->angle_rad) * (1 + off) + error);
        most.strain = fmax(most.strain, saw->hinge[k].strain.value * (1 + off));
        most.forced = fmax(most.forced, saw->hinge[k].forced + off * saw->hinge[k].strain.value);
    }
    return most;
}

static seen most_of_boxes(const fw_verdict_variant_verdict *v, int k) {
    const fw_mechanism_hinge *hinge = &v->mechanism->hinge[k];
    seen most = {0, 0, HUGE_VAL};
    if (!v->workspace.required || !v->workspace.reachable || hinge->pin >= FW_SIX) return most;
    const fw_workspace_peak *peak = &v->workspace.peak[hinge->pin];
    const fw_workspace_load *load = &v->workspace.load[hinge->pin];
    most.turn = fabs(peak->angle_rad) + peak->error_rad;
    most.strain = most.turn * hinge->closed_form.strain_per_rad;
    if (load->known) most.strain = fmax(most.strain, load->strain);
    return most;
}

/* Of the strip itself: what its roots have more is the fillets'; under rotation alone its curvature is
   even, forces may bend it most between the roots. Of required poses forces are not known apart: there
   curvature of either sign along the whole strip is allowed for. Between the instants that were looked
   at forces are taken to add a tenth more; their other sign is at most twice as large, and equal in a
   straight strip, where a fifth more is for what its own bending adds to the lever. */
static fw_clearance_bend bend_of(const fw_verdict_variant_verdict *v, int k, const seen *most) {
    const double between = 1.1, other_sign = 2, lever = 1.2;
    const fw_mechanism_hinge *hinge = &v->mechanism->hinge[k];
    fw_clearance_bend b = fw_clearance_bend_of(v->mechanism, hinge);
    double made = (1 + fw_made_share) * (1 + fw_verdict_model_error.strain);
    const fw_flexure_result *c = &hinge->closed_form;
    const double per = made * b.curvature_per_m / b.strain,
                 at_root = per / fmax(1, c->concentration), inside = per / fmax(1, c->fibre);
    const double turned = fmin(most->turn * c->strain_per_rad, most->strain);
    b.turn_rad = (1 + fw_made_share) * most->turn;
    b.strain = made * most->strain;
    b.curvature_per_m = isfinite(most->forced)
                            ? fmin(inside * most->strain, at_root * turned + inside * most->forced)
                            : at_root * most->strain;
    b.forced_per_m = (b.straight ? lever : other_sign) * between * inside * most->forced;
    return b;
}

static const fw_layout_piece *piece_of(const fw_layout *layout, int joint) {
    for (int i = 0; i < layout->npiece; i++)
        if (layout->piece[i].role == FW_ROLE_FLEXURE && layout->piece[i].joint == joint)
            return &layout->piece[i];
    return NULL;
}

static fw_status say(fw_arena *arena, const fw_layout_piece *piece, const fw_clearance_edge *met,
                     double turn_rad, fw_verdict_variant_verdict *v) {
    char turn[32];
    const char *text;
    FW_NEED(
        text = fw_arena_printf(
            arena,
            "the %s may come to %s, its own root or ring, within the %s deg that it turns by, "
            "margins included: its bent strip is not proved to keep off; use a longer flexure, a "
            "smaller subtended angle or a smaller load",
            piece->label, met->label ? met->label : "its body",
            fw_number_text(turn, sizeof turn, FW_DEG_PER_RAD * turn_rad, 3)));
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = NULL,
                                                  .flow = v->mechanism->variant->flow,
                                                  .number = 295,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = FW_VERDICT_KEEP_MOST,
                                                  .text = text};
    return FW_OK;
}

static fw_status look_at(fw_arena *arena, const fw_layout *layout, const fw_layout_piece *piece,
                         const fw_clearance_bend *bend, fw_verdict_variant_verdict *v,
                         const fw_clearance_edge **met) {
    fw_clearance_strip strip;
    if (!(bend->curvature_per_m > 0) || !isfinite(bend->curvature_per_m)) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(fw_clearance_strip_of(arena, layout, piece, &strip));
    const double wall = 2 * (layout->edge_m + fw_made_m) + fabs(layout->flare_m);
    if (strip.known) FW_TRY(fw_clearance_strip_meets(arena, v->things, &strip, bend, wall, met));
    fw_arena_rewind(arena, mark);
    return *met ? say(arena, piece, *met, bend->turn_rad, v) : FW_OK;
}

fw_status fw_verdict_clearance_strips(fw_arena *arena, const fw_layout *layout,
                                      fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    if (!v->things || v->corner) return FW_OK; /* allowed for */
    for (int k = 0; k < m->nhinge; k++) {
        const fw_layout_piece *piece = piece_of(layout, m->hinge[k].pin);
        if (!piece || !layout->hinge[m->hinge[k].pin].drawn || v->hinge[k].decision != FW_ACCEPT)
            continue; /* where it is not accepted it bends too far in any case */
        const seen most[2] = {most_of_scenes(v, k), most_of_boxes(v, k)};
        const fw_clearance_bend bend[2] = {bend_of(v, k, &most[0]), bend_of(v, k, &most[1])};
        const fw_clearance_edge *met = NULL;
        for (int i = fw_clearance_bend_covers(&bend[1], &bend[0]); i < 2 && !met; i++)
            FW_TRY(look_at(arena, layout, piece, &bend[i], v, &met));
    }
    return FW_OK;
}
