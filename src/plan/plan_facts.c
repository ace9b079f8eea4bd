/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the mask of one die hands to a flow: areas, edges and openings for the process, and the electrical
   side of the device. */
#include "base/text.h"
#include "layout/layout_rules.h"
#include "plan/stages.h"
#include <math.h>
#include <string.h>

/* ---- areas, edges, openings ---- */

static bool is_structure(fw_layout_role role) {
    return role == FW_ROLE_STRUCTURE || role == FW_ROLE_FLEXURE || role == FW_ROLE_FRAME ||
           role == FW_ROLE_TETHER;
}

/* edges of the material: a joint is a cut between two pieces, not an edge */
double fw_plan_free_perimeter(const fw_geometry_contour *contour) {
    double length = 0.0;
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        if (s->flags & FW_SEGMENT_JOINT) continue;
        length += s->kind == FW_ARC ? s->radius * fabs(s->sweep_rad)
                                    : hypot(s->b.x - s->a.x, s->b.y - s->a.y);
    }
    return length;
}

/* does what is not joined in the layer stay where it is, and insulated? */
bool fw_plan_insulated(const fw_plan_flow *pf) {
    return (pf->use && pf->use->insulating_carrier) || (pf->flow && pf->flow->insulating);
}

static void add_areas(const fw_layout *layout, bool islands, fw_process_mask_facts *facts) {
    for (int i = 0; i < layout->npiece; i++)
        if (layout->piece[i].body == FW_ISLAND && !islands) {
            continue;
        } else if (is_structure(layout->piece[i].role)) {
            facts->structure_area_m2 += fw_geometry_contour_area(&layout->piece[i].contour);
            const double edges_m = fw_plan_free_perimeter(&layout->piece[i].contour);
            facts->perimeter_m += edges_m;
            facts->biased_perimeter_m += edges_m;
        } else if (layout->piece[i].role == FW_ROLE_TEXT || layout->piece[i].role == FW_ROLE_MARK) {
            /* lettering and marks lie in the frame and are taken out of it */
            facts->structure_area_m2 -= fw_geometry_contour_area(&layout->piece[i].contour);
            facts->perimeter_m += fw_geometry_contour_perimeter(&layout->piece[i].contour);
        }
    facts->die_area_m2 = (layout->die.x1 - layout->die.x0) * (layout->die.y1 - layout->die.y0);
}

static void narrowest(const fw_device *device, const fw_layout *layout,
                      fw_process_mask_facts *facts) {
    facts->narrowest_slot_m = layout->narrowest_gap_m;
    if (device->release_pitch_m > 0.0) /* holes are openings of the device layer as well */
        facts->narrowest_slot_m = fmin(
            facts->narrowest_slot_m,
            device->release_hole_m > 0.0 ? device->release_hole_m : 0.3 * device->release_pitch_m);
    facts->narrowest_line_m = (double)INFINITY;
    for (int j = 0; j < device->nrevolute; j++)
        if (device->revolute[j].flexure != FW_NONE)
            facts->narrowest_line_m =
                fmin(facts->narrowest_line_m,
                     fw_device_flexure_narrowest_m(&device->flexure[device->revolute[j].flexure]));
    facts->deepest_hinge_width_m = facts->narrowest_line_m;
}

/* comb drives of the scenes that hold in a flow, each once: scenes may name the same one */
fw_status fw_plan_find_drives(fw_arena *arena, const fw_device *d, const char *flow,
                              fw_process_drive_facts **drive, int *n) {
    size_t most = 0;
    *n = 0;
    for (int i = 0; i < d->nscene; i++)
        most += (size_t)d->scene[i].ncomb;
    FW_NEED(*drive = fw_arena_array(arena, fw_process_drive_facts, most));
    for (int i = 0; i < d->nscene; i++) {
        const fw_device_scene *s = &d->scene[i];
        if (!fw_device_in_flow(s->flow, flow)) continue;
        for (int k = 0; k < s->ncomb; k++) {
            const fw_device_comb *c = &s->comb[k];
            bool there = false;
            for (int l = 0; l < *n && !there; l++)
                there = c->id && (*drive)[l].id && strcmp((*drive)[l].id, c->id) == 0 &&
                        (*drive)[l].gap_m == c->gap_m;
            if (!there) (*drive)[(*n)++] = (fw_process_drive_facts){c->id, c->gap_m, c->place};
        }
    }
    return FW_OK;
}

/* conjugate gaps of hinges, gaps of the comb drives that hold in this flow */
static fw_status name_gaps(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                           const char *flow, fw_process_mask_facts *facts) {
    fw_process_drive_facts *drive;
    int ndrive, n = 0;
    FW_TRY(fw_plan_find_drives(arena, device, flow, &drive, &ndrive));
    fw_process_mask_gap *gap =
        fw_arena_array(arena, fw_process_mask_gap, (size_t)device->nrevolute + (size_t)ndrive);
    FW_NEED(gap);
    for (int j = 0; j < device->nrevolute; j++) {
        if (!layout->hinge[j].drawn || !(layout->hinge[j].gap_m > 0.0)) continue;
        gap[n] = (fw_process_mask_gap){.kind = FW_GAP_HINGE, .gap_m = layout->hinge[j].gap_m};
        FW_NEED(gap[n++].name = fw_arena_printf(arena, "gap of %s%s",
                                                FW_NAMED("hinge", device->revolute[j].id)));
    }
    for (int i = 0; i < ndrive; i++) {
        gap[n] = (fw_process_mask_gap){.kind = FW_GAP_COMB, .gap_m = drive[i].gap_m};
        FW_NEED(gap[n++].name = fw_arena_printf(arena, "gap of %s%s",
                                                FW_NAMED("comb drive", fw_text_name(drive[i].id))));
    }
    facts->gap = gap;
    facts->ngap = n;
    return FW_OK;
}

/* What flows and their masks are computed of has marks of each flow, which several stages ask for. Drawings of trials
   are others, and are not kept. */
fw_status fw_plan_marked(fw_plan *plan, fw_plan_flow *pf, const fw_layout **marked,
                         fw_layout_no_room *no_room) {
    if (pf->marked_of != plan->layout) {
        fw_layout_no_room *lacks;
        FW_NEED(lacks = fw_arena_one(plan->arena, fw_layout_no_room));
        FW_TRY(fw_mask_frame_marks(plan->arena, pf->table, plan->layout, &pf->marked, lacks));
        pf->no_room = lacks, pf->marked_of = plan->layout;
    }
    *marked = pf->marked;
    if (no_room) *no_room = *pf->no_room;
    return FW_OK;
}

fw_status fw_plan_mask_facts(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_layout *marked, const fw_mechanism_variant *variant,
                             const fw_mask_table *table, bool insulated,
                             fw_process_mask_facts *facts) {
    *facts = (fw_process_mask_facts){.dies = 1, .device_thickness_m = variant->thickness_m};
    if (!layout || !layout->drawn) return FW_OK;
    fw_layout_no_room no_room; /* marks of the flow are taken out of the frame */
    if (!marked) FW_TRY(fw_mask_frame_marks(arena, table, layout, &marked, &no_room));
    add_areas(marked, insulated, facts);
    narrowest(device, layout, facts);
    for (int i = 0; table && i < table->nlayer; i++)
        if (table->layer[i].biased) {
            facts->least_space_m = fmax(facts->least_space_m, table->layer[i].min_space_m);
            facts->least_width_m = fmax(facts->least_width_m, table->layer[i].min_width_m);
        }
    return name_gaps(arena, device, layout, variant->flow, facts);
}

fw_status fw_plan_edge_facts(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_plan_flow *pf, const fw_mechanism_variant *variant,
                             fw_process_mask_facts *facts) {
    const fw_layout *marked = NULL;
    const bool by_reach = layout && layout->drawn && fw_process_flow_wears_by_reach(pf->flow);
    fw_layout_no_room no_room;
    if (by_reach) FW_TRY(fw_mask_frame_marks(arena, pf->table, layout, &marked, &no_room));
    FW_TRY(fw_plan_mask_facts(arena, device, layout, marked, variant, pf->table,
                              fw_plan_insulated(pf), facts));
    if (!by_reach) return FW_OK;
    return fw_release_solve(arena, marked, fw_plan_insulated(pf),
                            fw_process_flow_frees_all(pf->flow), fw_process_flow_bond(pf->flow),
                            &facts->release);
}

/* ---- marks on the frame ----
   Plates of a flow that prints several are put on each other by marks in the uprights of every frame. Where they find no
   room there, the device is drawn again with a wider frame, and where that does not help with a taller die, until
   they do: the die grows by as much, so that nothing within the frame moves. Test: test_hollows.c */

static const double FRAME_STEP_M = 25e-6, HEIGHT_STEP_M = 100e-6;
enum { FRAME_TRIES = 8 };

/* are all marks there with that frame and height? NaN: from the mechanism, as before */
static fw_status have_room(fw_plan *plan, const fw_plan_flow *pf, double frame_m, double height_m,
                           bool *have) {
    fw_device device = *plan->device;
    fw_device_die *die = &device.die;
    const double was_m = isnan(die->frame_m) ? fw_layout_rule.frame_m : die->frame_m;
    const fw_layout *layout = NULL;
    fw_layout_no_room no_room = {.count = 1};
    fw_diags quiet = fw_diags_new(plan->arena);
    fw_mark mark = fw_arena_mark(plan->arena);
    die->width_m += 2.0 * (frame_m - was_m);
    die->height_m = isnan(height_m) ? die->height_m + 2.0 * (frame_m - was_m) : height_m;
    die->frame_m = frame_m;
    fw_status status = fw_layout_build(plan->arena, &device, &quiet, &layout);
    if (status == FW_OK && layout->drawn)
        status = fw_mask_frame_marks(plan->arena, pf->table, layout, &layout, &no_room);
    *have = status == FW_OK && no_room.count == 0;
    fw_arena_rewind(plan->arena, mark);
    return status == FW_GEOMETRY || status == FW_INPUT ? FW_OK : status;
}

/* "frame="224 um"" */
static fw_status find_room(fw_plan *plan, const fw_plan_flow *pf, const fw_layout_no_room *no_room,
                           const char **room) {
    const double was_m = no_room->upright.x1 - no_room->upright.x0,
                 from_m = fmax(no_room->frame_m, was_m),
                 height_m = plan->layout->die.y1 - plan->layout->die.y0;
    bool have = false;
    char um[32];
    *room = NULL;
    for (int k = 0; k < FRAME_TRIES && !have; k++) {
        const double wide_m = from_m + k * FRAME_STEP_M;
        if (!(wide_m > was_m + 1e-9)) continue; /* as it is */
        FW_TRY(have_room(plan, pf, wide_m, (double)NAN, &have));
        if (have)
            FW_NEED(*room = fw_arena_printf(plan->arena, "frame=\"%s um\"",
                                            fw_number_text(um, sizeof um, wide_m * 1e6, 7)));
    }
    for (int k = 1; k <= FRAME_TRIES && !have; k++) {
        const double tall_m = height_m + 2.0 * (from_m - was_m) + k * HEIGHT_STEP_M;
        char tall[32];
        FW_TRY(have_room(plan, pf, from_m, tall_m, &have));
        if (have)
            FW_NEED(*room = fw_arena_printf(plan->arena, "frame=\"%s um\" height=\"%s um\"",
                                            fw_number_text(um, sizeof um, from_m * 1e6, 7),
                                            fw_number_text(tall, sizeof tall, tall_m * 1e6, 8)));
    }
    return FW_OK;
}

fw_status fw_plan_say_no_room(fw_plan *plan, const fw_plan_flow *pf,
                              const fw_layout_no_room *no_room) {
    if (no_room->count == 0 || fw_mask_plates(pf->table) < 2) return FW_OK;
    const fw_geometry_box *b = &no_room->upright;
    const fw_device_wafer_asked *wafer = &plan->device->wafer;
    char mark[2][32], upright[32], at[2][32];
    const char *room;
    FW_TRY(find_room(plan, pf, no_room, &room));
    const char *mend =
        room ? fw_arena_printf(plan->arena, "with <die %s> they are there", room)
             : "no wider frame and no taller die that was tried has room: write a shorter title";
    FW_NEED(mend);
    fw_diag_warning(&plan->diags, 619, plan->device->die.frame_place,
                    "flow %s: %d of the %d marks %s on the frame of every die, by which its plates "
                    "are put on each other, "
                    "find no room: in the upright at (%s, %s) um, %s um wide, nothing of %s um by "
                    "%s um is free and 12 um "
                    "clear of its edges; %s%s",
                    pf->flow->id, no_room->count, no_room->of, no_room->id ? no_room->id : "",
                    fw_number_text(at[0], sizeof at[0], 0.5e6 * (b->x0 + b->x1), 6),
                    fw_number_text(at[1], sizeof at[1], 0.5e6 * (b->y0 + b->y1), 6),
                    fw_number_text(upright, sizeof upright, 1e6 * (b->x1 - b->x0), 6),
                    fw_number_text(mark[0], sizeof mark[0], 1e6 * no_room->width_m, 6),
                    fw_number_text(mark[1], sizeof mark[1], 1e6 * no_room->height_m, 6), mend,
                    wafer->asked && wafer->alignment
                        ? "; without them there are only the alignment sites of the wafer"
                        : "; or add a <wafer> with alignment sites, which have them");
    return plan->diags.failed ? FW_NOMEM : FW_OK;
}

/* ---- the electrical side ----
   What the flow stands on, nets, and what they make of its judgement. */

/* the material that insulates the layer from what is below it: the first one added that does not conduct */
static const fw_process_change *insulator_of(const fw_process_flow *flow, bool *handle) {
    *handle = false;
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            const fw_process_material *m = fw_process_flow_material(flow, c->material);
            if (strcmp(c->kind, "add") != 0) continue;
            if (m && m->conducts == 0) return c;
            *handle = true;
        }
    return NULL;
}

static double known(const fw_process_flow *flow, const char *id, const char **source) {
    const fw_quantity *q = fw_process_flow_quantity(flow, id);
    if (!q || q->unknown) return (double)NAN;
    if (source) *source = q->source;
    return q->value;
}

static fw_status carrier_of(fw_plan *plan, const fw_plan_flow *pf, fw_wiring_carrier *out) {
    const fw_process_flow *flow = pf->flow;
    *out = (fw_wiring_carrier){.insulates = fw_plan_insulated(pf),
                               .thickness_m = (double)NAN,
                               .breakdown_V_per_m = (double)NAN,
                               .resistivity_Ohm_m = (double)NAN};
    if (!out->insulates) {
        FW_NEED(out->words = fw_arena_printf(
                    plan->arena,
                    "nothing: the layer (%s) is one sheet or stands on a conductor, and all that "
                    "stands on the carrier is one net with it",
                    fw_process_flow_material_name(flow, flow->material)));
        return FW_OK;
    }
    if (!flow->insulating) {
        out->words =
            "an insulating carrier, as the description says in <flow carrier>: what is not "
            "joined in the layer is insulated; how well is not known";
        return FW_OK;
    }
    const fw_process_change *c = insulator_of(flow, &out->handle);
    out->breakdown_V_per_m = known(flow, "insulator.breakdown", &out->source);
    out->resistivity_Ohm_m = known(flow, "insulator.resistivity", &out->source);
    if (!c || !c->thickness || c->thickness->unknown) {
        out->handle = false;
        out->words = "an insulating carrier, as the flow says: what is not joined in the layer is "
                     "insulated; how well is not known";
        return FW_OK;
    }
    const fw_quantity *bears = fw_process_flow_quantity(flow, "insulator.breakdown");
    char um[32];
    out->thickness_m = c->thickness->value;
    if (bears && !bears->unknown)
        out->breakdown_share = hypot(bears->uncertainty / bears->value,
                                     c->thickness->uncertainty / c->thickness->value);
    FW_NEED(out->words = fw_arena_printf(plan->arena, "%s, %s um thick%s",
                                         fw_process_flow_material_name(flow, c->material),
                                         fw_number_text(um, sizeof um, 1e6 * out->thickness_m, 4),
                                         out->handle ? ", on a handle that conducts" : ""));
    return FW_OK;
}

static double outermost(const fw_process_edge *e) {
    return fmax(e->top_m, fmax(e->middle_m, e->bottom_m)); /* fmax ignores what is not known */
}

/* by how much two walls may come nearer than drawn: what the flow leaves of its edges, at the ends of all ranges */
static double walls_of(const fw_process_flow *flow) {
    double most = 0.0;
    for (int i = 0; i < flow->edges.ncls && flow->edges.solved; i++) {
        const fw_process_edge_class *c = &flow->edges.cls[i];
        most = fmax(most, fmax(outermost(&c->edge), fmax(outermost(&c->low), outermost(&c->high))));
    }
    return 2.0 * most;
}

static const fw_verdict_variant_verdict *verdict_of(const fw_plan *plan, const fw_plan_flow *pf) {
    ptrdiff_t i = pf - plan->flow;
    return plan->verdict.variant && i < plan->verdict.nvariant ? &plan->verdict.variant[i] : NULL;
}

/* ---- ways of doing a step that nobody chose ---- */

/* a laboratory may have replaced its value */
static const fw_quantity *own(const fw_process_flow *flow, const fw_quantity *q) {
    return q ? fw_process_flow_quantity(flow, q->id) : NULL;
}

fw_status fw_plan_judge_alternatives(fw_plan *plan, const fw_plan_flow *pf) {
    const fw_verdict_variant_verdict *v = verdict_of(plan, pf);
    for (int i = 0; v && v->variant && pf->flow && i < pf->flow->nalternative; i++) {
        fw_process_alternative *a = &pf->flow->alternative[i];
        fw_mechanism_drying drying;
        fw_process_drying of = a->drying;
        const char *words;
        int number;
        a->unfit = NULL;
        if (a->chosen || of.how != FW_DRIED_PULLED || strcmp(of.step->id, a->step) != 0) continue;
        of.tension = own(pf->flow, of.tension), of.angle = own(pf->flow, of.angle);
        FW_TRY(fw_plan_drying_of(plan, pf, &of, &drying));
        const fw_verdict_decision bears = fw_verdict_drying_bears(v, &drying, &number);
        if (bears == FW_ACCEPT) continue;
        FW_TRY(fw_verdict_drying_words(plan->arena, v, &words));
        FW_NEED(a->unfit =
                    fw_arena_printf(plan->arena, "%s (with it the verdict is %s, FW-D%d)", words,
                                    bears == FW_REJECT ? "reject" : "inconclusive", number));
    }
    return FW_OK;
}

/* ---- nets and what equipment bears ---- */

/* drives that ask for more than a step bears that is to test them (FW-D594) */
static fw_status judge_bearing(fw_plan *plan, fw_process_flow *flow, const fw_process_step *s,
                               const fw_wiring *w) {
    const char *worst = NULL;
    double most = 0.0;
    int beyond = 0;
    for (int i = 0; s->bears && !s->bears->unknown && i < w->ndrive; i++) {
        double asked = fmax(fabs(w->drive[i].low_V), fabs(w->drive[i].high_V));
        if (!(asked > s->bears->value * (1.0 + 1e-9))) continue;
        beyond++;
        if (asked > most) most = asked, worst = w->drive[i].id;
    }
    if (!beyond) return FW_OK;
    char volts[32], bears[32];
    return fw_process_flow_add_reason(
        plan->arena, flow, -1,
        fw_arena_printf(plan->arena,
                        "drive %s asks for %s V%s, and what step %s tests it with bears %s V (%s): "
                        "beyond that nothing is tested before it is used; ask for less, or state "
                        "what the laboratory's own equipment bears [FW-D594]",
                        worst, fw_number_text(volts, sizeof volts, most, 4),
                        beyond > 1 ? ", and is not the only one" : "", s->id,
                        fw_number_text(bears, sizeof bears, s->bears->value, 4), s->bears->id));
}

/* as wide as fw_wafer_alignment_mask makes them */
static bool sites_have_room(const fw_plan *plan, const fw_layout_no_room *no_room) {
    const fw_geometry_box *die = &plan->layout->die;
    const double least_m = fmin(die->x1 - die->x0, die->y1 - die->y0),
                 arm_m = fmin(0.6 * least_m, 2e-3) / 14.0;
    return plan->device->wafer.alignment &&
           fmax(no_room->width_m, no_room->height_m) <= 5.0 * arm_m;
}

/* plates on a wafer without any of those marks */
static fw_status judge_marks(fw_plan *plan, fw_plan_flow *pf) {
    const fw_layout *layout;
    fw_layout_no_room no_room;
    if (!plan->device->wafer.asked || fw_mask_plates(pf->table) < 2) return FW_OK;
    FW_TRY(fw_plan_marked(plan, pf, &layout, &no_room));
    if (no_room.count == 0 || no_room.count < no_room.of || sites_have_room(plan, &no_room))
        return FW_OK;
    return fw_process_flow_add_reason(
        plan->arena, pf->flow, 0,
        fw_arena_printf(
            plan->arena,
            "nothing on the wafer shows how its plates lie on each other: no frame has room for "
            "the "
            "marks %s, and no alignment site has them; write the <die> that the warning names, or "
            "<wafer alignment=\"2 sites\"> where dies are large enough [FW-D619]",
            no_room.id ? no_room.id : ""));
}

/* how far anything drawn comes down, under its weight on a table and in scenes */
static double sag_of(const fw_verdict_variant_verdict *v) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    if (!o || o->why) return 0;
    double sag_m = o->weight_m;
    for (int i = 0; i < o->nscene; i++)
        sag_m = fmax(sag_m, -o->scene[i].lowest_m);
    return sag_m;
}

fw_status fw_plan_wiring(fw_plan *plan, fw_plan_flow *pf) {
    const fw_layout *layout;
    fw_layout_no_room no_room;
    if (!pf->flow || !plan->layout || !plan->layout->drawn) return FW_OK;
    FW_TRY(judge_marks(plan, pf));
    if (!pf->wiring) {
        const fw_verdict_variant_verdict *v = verdict_of(plan, pf);
        fw_wiring_asked asked = {.flow = pf->variant.flow, .wall_m = walls_of(pf->flow)};
        if (v) asked.moved = v->stator, asked.nmoved = v->nstator, asked.sag_m = sag_of(v);
        FW_TRY(carrier_of(plan, pf, &asked.carrier));
        FW_TRY(fw_plan_marked(plan, pf, &layout, &no_room));
        FW_TRY(fw_wiring_find(plan->arena, plan->device, layout, &asked, &pf->wiring));
    }
    const fw_wiring *w = pf->wiring;
    bool routed = false;
    for (int i = 0; i < plan->layout->nelectrode; i++)
        routed = routed || plan->layout->electrode[i].routed;
    if (routed && !w->carrier.insulates)
        FW_TRY(fw_process_flow_add_reason(
            plan->arena, pf->flow, 0,
            "tracks to the chip's edge cut the frame, which hangs on nothing in a flow without an "
            "insulating carrier: leave pad=\"edge\" out for this flow"));
    for (int i = w->nrefusal - 1; i >= 0 && w->carrier.insulates; i--)
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, 0, w->refusal[i]));
    const int before = pf->flow->nreason;
    for (int i = 0; i < w->nopen; i++)
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, -1, w->open[i]));
    for (int i = 0; i < pf->flow->nstep; i++)
        FW_TRY(judge_bearing(plan, pf->flow, &pf->flow->step[i], w));
    fw_process_flow_lead(pf->flow, before);
    return FW_OK;
}

/* likewise its wafer, where the description lays one out */
static void check_wafer(fw_plan *plan, const fw_plan_flow *pf) {
    const fw_quantity *q = pf->flow ? fw_process_flow_quantity(pf->flow, "wafer.D") : NULL;
    const double is_m = plan->device->wafer.diameter_m;
    char is[32], was[32];
    if (!q || !q->replaced || q->unknown || !plan->device->wafer.asked) return;
    if (!(fabs(q->value - is_m) > 1e-9 * is_m)) return;
    fw_number_text(was, sizeof was, q->value * 1e3, 6);
    fw_number_text(is, sizeof is, is_m * 1e3, 6);
    fw_diag_warning(&plan->diags, 529, q->place,
                    "'%s' is %s mm here, but the <wafer> of the description is %s mm wide, which "
                    "holds: state there what the laboratory uses: --set \"wafer/@diameter=%s mm\"",
                    q->id, was, is, was);
}

/* a laboratory that has measured the wafer is overruled by the description, and told so */
void fw_plan_check_thickness(fw_plan *plan, const fw_plan_flow *pf) {
    const fw_quantity *q = pf->flow ? pf->flow->thickness : NULL;
    const double is_m = pf->variant.thickness_m;
    const bool own = pf->use && !isnan(pf->use->thickness_m);
    char is[32], was[32];
    check_wafer(plan, pf);
    if (!q || !q->replaced || q->unknown || fabs(q->value - is_m) <= 1e-9 * is_m) return;
    fw_number_text(was, sizeof was, q->value * 1e6, 6);
    fw_number_text(is, sizeof is, is_m * 1e6, 6);
    fw_diag_warning(&plan->diags, 507, q->place,
                    "'%s' is %s um here, but the device is described as %s um thick, which "
                    "holds: state there what was measured: --set \"%s%s%s/@thickness=%s um\"",
                    q->id, was, is, own ? "flow[" : "material", own ? pf->use->ref : "",
                    own ? "]" : "", was);
}
