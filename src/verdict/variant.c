/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/verdict_parts.h"
#include "base/constants.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include <math.h>
#include <string.h>

static fw_verdict_decision decide(double low, double high) {
    if (low > 1.0) return FW_REJECT;
    return high < 1.0 ? FW_ACCEPT : FW_INCONCLUSIVE;
}

/* the solids meet first: what happens then is not in the model, so it cannot be accepted */
static void collide(const fw_layout_hinge_layout *drawn, fw_verdict_hinge_verdict *out) {
    out->touches = drawn && drawn->drawn && drawn->free_rad > 0.0 &&
                   fabs(out->peak_angle_rad) > drawn->free_rad;
    if (out->touches && out->decision == FW_ACCEPT) out->decision = FW_INCONCLUSIVE;
}

static double strain_error(const fw_dynamics_motion *motion) {
    const fw_verdict_strain_monitor *observed = motion->observed, *looser = motion->compared;
    if (!observed || !looser || motion->ended) return 0.0;
    return fw_verdict_strain_monitor_error(observed, looser, motion->stats.estimate_margin);
}

static bool combs_pull(const fw_dynamics_motion *motion) {
    const fw_effects_loads *loads = motion->loads;
    for (int i = 0; loads && i < loads->nelement; i++)
        if (fw_effects_comb_of(&loads->element[i])) return true;
    return false;
}

/* what a hinge is judged by, the same for all that is run */
typedef struct judged {
    const fw_mechanism *m;
    const fw_mechanism_hinge *hinge;
    const fw_layout_hinge_layout *drawn;
    double youngs_Pa, safety_factor;
    double repetitions; /* of every scene; NaN: static */
} judged;

/* peak stress at the root as it is, against the plain distribution of strengths */
static void chance(const judged *by, fw_verdict_hinge_verdict *out) {
    const fw_flexure_weibull *w = &by->hinge->limits.weibull;
    if (w->known)
        out->failure_probability =
            fw_flexure_weibull_probability(w, out->peak_strain * by->youngs_Pa);
}

/* a repeated motion that uses more of its fatigue limit than its peak does of the static one: the
   limits become those of this motion, its bands the same share of the larger utilisation */
static void fatigue(const judged *by, const fw_verdict_fatigue *f, fw_verdict_hinge_verdict *out) {
    out->fatigue_utilisation = by->safety_factor * f->utilisation;
    out->damage = f->damage;
    out->cycles = f->cycles;
    if (!(out->fatigue_utilisation > out->utilisation) || !(out->utilisation > 0)) return;
    double more = out->fatigue_utilisation / out->utilisation;
    out->limit = &by->hinge->limits.item[by->hinge->limits.fatigue];
    out->limit_Pa /= more;
    out->limit_angle_rad /= more;
    out->strain_limit /= more;
    out->utilisation *= more;
    out->utilisation_low *= more * f->at_least / f->utilisation;
    out->utilisation_high *= more;
    out->numeric *= more;
}

static bool repeats(const judged *by) {
    return by->repetitions > 0 && by->hinge->limits.life.known;
}

/* what nothing is known to damp may use more behind the scene */
static fw_status count_fatigue(fw_arena *arena, const judged *by,
                               const fw_verdict_strain_monitor *monitor, int k,
                               fw_verdict_hinge_verdict *out) {
    fw_verdict_fatigue f;
    if (!repeats(by) || !monitor->root) return FW_OK;
    FW_TRY(fw_verdict_fatigue_of(arena, &by->hinge->limits.life, monitor->root[k], out->peak_strain,
                                 by->youngs_Pa, by->repetitions,
                                 monitor->after ? &monitor->after[k] : NULL, &f));
    fatigue(by, &f, out);
    const double most = by->safety_factor * f.at_most;
    if (f.at_most > f.utilisation && most > out->utilisation && out->utilisation > 0)
        out->utilisation_high *= most / out->utilisation;
    if (f.at_most > f.damped) out->rung = most;
    return FW_OK;
}

/* utilisation = peak strain (rotation and force, fillets included) over the limit strain; the limit
   angle is what a rotation alone would allow. Band = model errors of it, and the numerical errors
   of the angle over the limit angle and of the search for the strain; without a known axis the low
   end is that of the kindest direction. */
static fw_status judge_scene(fw_arena *arena, const judged *by, const fw_dynamics_motion *motion,
                             const fw_verdict_strain_monitor *monitor, int k, const char *scene,
                             fw_verdict_hinge_verdict *out) {
    const fw_dynamics_peak *peak = &motion->peak[by->hinge->pin];
    const fw_verdict_largest *strain = &monitor->hinge[k].strain;
    const fw_flexure_result *c = &by->hinge->closed_form;
    double by_angle = fabs(peak->angle_rad) / c->limit_angle_rad;
    out->scene = scene;
    out->peak_angle_rad = peak->angle_rad;
    out->angle_error_rad = peak->error_rad;
    out->peak_strain = strain->value;
    out->utilisation = strain->value / out->strain_limit;
    out->force_share = out->utilisation > by_angle ? 1.0 - by_angle / out->utilisation : 0.0;
    out->t_s = strain->t_s;
    /* a run that was ended went a whole turn, or to several times a limit: no error of its own changes that */
    double numeric =
        motion->ended ? 0.0
                      : out->angle_error_rad / c->limit_angle_rad +
                            (strain->between + strain_error(motion) +
                             fmin(strain->value, fw_verdict_lost_swing(by->m, by->hinge, motion))) /
                                out->strain_limit;
    const double beside = fw_verdict_motion_beside(motion);
    if (isfinite(numeric)) /* angles have it in their errors: it counts once */
        numeric -= fmin(fw_verdict_motion_beside_rad(motion) / c->limit_angle_rad,
                        beside * out->utilisation);
    const bool lost = monitor->hinge[k].lost;
    double moved = lost ? fw_verdict_model_not_known : fw_verdict_motion_model_error(by->m, motion);
    double bent = fw_verdict_bending_counted(motion);
    out->numeric = numeric;
    const fw_flexure_error *e = &c->error;
    double least =
        fmin(monitor->hinge[k].least + strain->between, strain->value) / out->strain_limit;
    double most = fmax(monitor->hinge[k].most + strain->between, strain->value) / out->strain_limit;
    const double lasting = fw_verdict_motion_lasting_error(by->m);
    /* not of a figure that stands for the reference cases */
    bool usual =
        motion->ledger.hinge.used == FW_HINGE_REVOLUTE || moved >= fw_verdict_model_error.motion;
    /* what contacts leave ringing, and what combs pull, goes with more than the first power of the stiffness */
    const bool rings = motion->level && motion->level->blows > 0;
    usual = usual || rings;
    double less =
        usual || combs_pull(motion) ? 0 : lasting - fw_verdict_motion_lasting_below(by->m);
    double more = usual ? 0 : lasting - fw_verdict_motion_lasting_above(by->m);
    double up = fmax(moved - more, 0) + beside + bent, down = fmax(moved - less, 0) + beside;
    double stays = fmin(down, lasting + beside);
    double share = out->utilisation > 0 ? 1 / out->utilisation : 0, kept = least * share;
    double above = e->above_anywhere + fmax(most * share - 1, 0) * (1 + e->above_anywhere + up);
    if (rings) above = fmax(above, e->above);
    /* bodies give as they do whatever computes the hinges */
    out->lasting = fmin(up - bent, lasting + beside) + bent + above;
    const double stated = by->hinge->stated_less;
    out->lasting_low = stays + stated + bent + e->strain_anywhere;
    if (out->utilisation > 0) out->lasting_low += 1 - kept;
    out->utilisation_low =
        fmax(0.0, least * (1.0 - down - stated - bent - e->strain_anywhere) - numeric);
    out->utilisation_high = out->utilisation * (1.0 + up + above) + numeric;
    double below = fmin(lasting - less, down);
    double stiff = fmin(fw_verdict_motion_lasting_above(by->m), up - bent);
    out->parts = (fw_verdict_band_parts){.root = {kept * e->strain_anywhere, above},
                                         .stiffness = {kept * (below + stated), stiff},
                                         .model = {kept * (down - below), up - bent - stiff},
                                         .place = {1 - kept, 0},
                                         .bodies = {kept * bent, bent},
                                         .numbers = {share * numeric, share * numeric}};
    chance(by, out);
    FW_TRY(count_fatigue(arena, by, monitor, k, out));
    out->decision = decide(out->utilisation_low, out->utilisation_high);
    out->open = lost;
    if (lost && out->decision == FW_ACCEPT) out->decision = FW_INCONCLUSIVE;
    collide(by->drawn, out);
    return FW_OK;
}

/* Share of the strain by which the moment that a fillet is strained by may be below that at the block's face:
   |dM/ds| is at most the force */
static double faded(const fw_mechanism_hinge *h, double force_N, double strain) {
    const fw_flexure_result *c = &h->closed_form;
    double per_Nm = c->strain_per_rad / (h->scale * c->stiffness_Nm_per_rad);
    return strain > 0
               ? per_Nm * force_N * fmax(h->section.reach_m[0], h->section.reach_m[1]) / strain
               : 0;
}

/* every repetition is taken to go to the worst pose and as far to the other side */
static void workspace_fatigue(const judged *by, fw_verdict_hinge_verdict *out) {
    if (!repeats(by)) return;
    const fw_maths_cycle one = {2 * out->peak_strain * by->youngs_Pa, 0, 1};
    const fw_flexure_strain_life *law = &by->hinge->limits.life;
    const double used = fw_verdict_fatigue_utilisation(law, &one, 1, by->repetitions),
                 damage = fw_verdict_miner(law, &one, 1, by->repetitions, 1);
    const fw_verdict_fatigue f = {used, damage, 1, used, used, used};
    fatigue(by, &f, out);
}

/* Peak strain of all required poses, by rotation and the joint forces that hold them. Of the band:
   the closed form's strain; its stiffness, which the forces go by and the rotations do not; what
   drift and give of the hinges may add at the worst pose, or take away; what the proof leaves open
   (downward). Where forces cannot be computed a rotation alone accepts nothing. */
static void judge_workspace(const judged *by, const fw_workspace_result *workspace,
                            fw_verdict_hinge_verdict *out) {
    const fw_workspace_peak *peak = &workspace->peak[by->hinge->pin];
    const fw_workspace_load *load = &workspace->load[by->hinge->pin];
    const fw_flexure_result *c = &by->hinge->closed_form;
    double by_angle = fabs(peak->angle_rad) / c->limit_angle_rad;
    out->scene = "workspace";
    out->peak_angle_rad = peak->angle_rad;
    out->angle_error_rad = peak->error_rad;
    out->t_s = (double)NAN;
    out->utilisation =
        load->known ? load->strain * (1.0 + load->added) / out->strain_limit : by_angle;
    out->peak_strain = out->utilisation * out->strain_limit;
    out->actuation = load->actuation;
    out->joint_force_N = load->known ? load->force_N : (double)NAN;
    out->over_rotation = load->known ? load->over_rotation : (double)NAN;
    if (out->utilisation > by_angle) out->force_share = 1.0 - by_angle / out->utilisation;
    double share =
        load->known && load->over_rotation > 0.0 ? fabs(1.0 - 1.0 / load->over_rotation) : 0.0;
    /* hinges that are alike put on each other what they bear: by a power of the stiffness from that of a turn to that of
       a load, as in a motion */
    double moved = share * fw_verdict_motion_lasting_above(by->m);
    double down = share * (fw_verdict_motion_lasting_below(by->m) + by->hinge->stated_less);
    double fades = load->known ? faded(by->hinge, load->force_N, out->peak_strain) : 0;
    double numeric =
        load->known ? load->error / out->strain_limit : peak->error_rad / c->limit_angle_rad;
    out->numeric = 0.0; /* no run makes the proof closer */
    double low = down + c->error.strain + fades + load->relief;
    out->lasting = moved + c->error.above + load->give;
    out->lasting_low = low;
    out->utilisation_low = fmax(0.0, out->utilisation * (1.0 - low) - numeric);
    out->utilisation_high = out->utilisation * (1.0 + out->lasting);
    if (!workspace->certified) out->utilisation_high += numeric;
    double open = out->utilisation > 0 ? numeric / out->utilisation : 0;
    out->parts = (fw_verdict_band_parts){.root = {c->error.strain, c->error.above},
                                         .stiffness = {down, moved},
                                         .model = {load->relief, load->give},
                                         .place = {fades, 0},
                                         .numbers = {open, workspace->certified ? 0 : open}};
    chance(by, out);
    workspace_fatigue(by, out);
    out->decision = decide(out->utilisation_low, out->utilisation_high);
    out->open = !load->known;
    if (!load->known && out->decision == FW_ACCEPT) out->decision = FW_INCONCLUSIVE;
    collide(by->drawn, out);
}

/* a hinge that has turned once, or to several times its limit, is past it: the rest of the scene is not needed */
static void warn_ended(const fw_device_scene *scene, const fw_dynamics_motion *motion,
                       fw_diags *diags) {
    char t[32], turned[32];
    double most = 0;
    for (int i = 0; i < motion->npin; i++)
        most = fmax(most, fabs(motion->peak[i].angle_rad));
    fw_diag_warning(diags, 205, scene->place,
                    "%s%s was ended after %s ms, when a joint had turned by %s deg: the load "
                    "is far beyond what these hinges can take; lower it",
                    FW_NAMED("scene", scene->name),
                    fw_number_text(t, sizeof t, motion->end_s * 1e3, 4),
                    fw_number_text(turned, sizeof turned, most * 180 / FW_PI, 3));
}

/* The band holds what the model of the hinges is computed to be off by. A better one than the first of
   these is asked for where the verdict is undecided, than the second for a device whose bands are
   shown, and neither for trials, first looks and corners. */
static const double fw_hinges_good_enough = 0.03, fw_hinges_good = 0.01;
/* and exact beams only where they take a second, of an undecided device ten; who wants to wait longer asks for them */
static const long fw_most_beams = 100000, fw_most_beams_undecided = 4000000;
/* Evaluations after which a motion far beyond what hinges bear is followed no further, some seconds; of a trial some
   tenths of one. A scene of a device that works takes some thousand. */
static const long fw_hopeless_rhs = 300000, fw_hopeless_trial_rhs = 20000;

/* In evaluations of hinges. An exact beam counts for as many closed forms as it costs, an evaluation of all
   else for one (a single arm on one hinge: half of its time), and so does each comb. All runs count that were
   made for a motion: one that touches something stiff is run up to seven times. */
static double work_of(const fw_mechanism *m, const fw_device_scene *scene,
                      const fw_dynamics_motion *motion) {
    const fw_dynamics_motion_stats *s = &motion->stats;
    const double each = motion->ledger.hinge.used == FW_HINGE_ELASTICA ? 30 : 1;
    const double evaluations = (double)(s->all_rhs > s->rhs ? s->all_rhs : s->rhs);
    return evaluations * (each * m->nhinge + 1 + scene->ncomb);
}

/* of a trial, or a corner, only whether it is accepted is of account */
static bool is_brief(const fw_verdict_options *options, const fw_verdict_variant_verdict *v) {
    return (options->decision_only || v->like) && !options->values;
}

/* runs every scene of this variant; watch[i] and other[i] follow the strains of its two runs */
static fw_status run_scenes(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                            const fw_mechanism *m, const fw_verdict_options *options,
                            fw_diags *diags, fw_verdict_variant_verdict *v,
                            fw_verdict_strain_monitor *monitor, fw_verdict_strain_monitor *other) {
    size_t n = (size_t)device->nscene;
    const bool brief = is_brief(options, v);
    fw_dynamics_motion_options motion = options->motion;
    motion.within_limits = true;
    if (motion.most_angle_rad <= 0) motion.most_angle_rad = FW_TURN;
    motion.most_beams = motion.hinge_accuracy > 0 ? fw_most_beams_undecided : fw_most_beams;
    motion.strains_apart = fw_verdict_level_strains;
    motion.sparing = options->coarse_first;
    motion.effects.untold = motion.effects.untold || options->decision_only || v->corner;
    motion.hopeless_rhs =
        brief || options->at_a_glance || v->corner ? fw_hopeless_trial_rhs : fw_hopeless_rhs;
    if (motion.hinge_accuracy <= 0)
        motion.hinge_accuracy =
            fmax(motion.accuracy, brief || options->at_a_glance || v->corner ? fw_hinges_good_enough
                                                                             : fw_hinges_good);
    FW_NEED(v->motion = fw_arena_alloc(arena, n, sizeof *v->motion));
    FW_NEED(v->pull_in = fw_arena_alloc(arena, n, sizeof *v->pull_in));
    FW_NEED(v->left = fw_arena_array(arena, double, n));
    FW_NEED(v->slowest_s = fw_arena_array(arena, double, 2 * n));
    const size_t reasons = fw_verdict_reasons_most(device, v->nrequirement);
    FW_NEED(v->reason = fw_arena_array(arena, fw_verdict_reason, reasons));
    FW_TRY(fw_verdict_bent(arena, device, v));
    fw_verdict_clearance_watch watch[2];
    FW_TRY(fw_verdict_clearance_begin(
        arena, options->hinges_only ? NULL : layout, m,
        v->corner ? !options->decision_only && !options->at_a_glance : !brief, watch, v));
    watch[0].ways = watch[1].ways = options->ways || !(options->bounded || (brief && v->corner));
    for (size_t i = 0; i < n; i++) {
        const fw_device_scene *scene = &m->device->scene[i];
        if (!fw_device_in_flow(scene->flow, m->variant->flow)) continue;
        if (options->only_scene && strcmp(options->only_scene, scene->name) != 0) continue;
        FW_TRY(fw_verdict_strain_monitor_new(arena, m, device->limits.cycles > 0, &monitor[i]));
        fw_verdict_strain_monitor_watch(&monitor[i], &motion);
        motion.unsettled = fw_verdict_strain_monitor_unsettled;
        FW_TRY(fw_verdict_strain_monitor_new(arena, m, device->limits.cycles > 0, &other[i]));
        motion.other = &other[i];
        FW_TRY(
            fw_verdict_bending_watch(arena, m, v->arm, v->straight, (int)i, &monitor[i].bending));
        FW_TRY(fw_verdict_bending_watch(arena, m, v->arm, v->straight, (int)i, &other[i].bending));
        monitor[i].clearance = &watch[0], other[i].clearance = &watch[1];
        FW_TRY(fw_verdict_touch_watch(arena, scene, &monitor[i]));
        FW_TRY(fw_verdict_touch_watch(arena, scene, &other[i]));
        FW_TRY(fw_verdict_clearance_scene(m, scene, watch));
        fw_probe_monitor *seen[2];
        const bool required = options->coarse_first || v->corner;
        FW_TRY(fw_verdict_requirements_watch(arena, m, (int)i, v, required, seen));
        monitor[i].probe = seen[0], other[i].probe = seen[1];
        monitor[i].trial = other[i].trial = options->decision_only && !options->values;
        motion.whole = motion.trace_both = seen[0] != NULL;
        motion.trace = seen[0] || watch[0].things ? fw_verdict_clearance_trace : NULL;
        motion.like = v->like ? v->like[i] : NULL;
        motion.effects.like = motion.like ? &motion.like->ledger : NULL;
        const int first = v->nreason;
        FW_TRY(fw_verdict_scene(arena, scene, (int)i, &motion, diags, v));
        if (monitor[i].no_memory) return FW_NOMEM;
        if (options->work && v->motion[i]) *options->work += work_of(m, scene, v->motion[i]);
        fw_dynamics_spent_less(motion.spent, v->motion[i]);
        /* a glance of a search takes bodies as beams: what it finds is judged with all */
        const bool beams = options->work && options->at_a_glance;
        FW_TRY(fw_verdict_bending_end(arena, beams ? NULL : layout, &monitor[i], &other[i], v));
        if (!v->corner) fw_verdict_bending_tell(m, scene, v->motion[i], diags);
        FW_TRY(fw_verdict_rings_on(arena, m, scene, v->motion[i], &monitor[i].after));
        other[i].after = monitor[i].after;
        FW_TRY(fw_verdict_courses_end(arena, &monitor[i]));
        FW_TRY(fw_verdict_courses_end(arena, &other[i]));
        if (v->motion[i])
            FW_TRY(
                fw_verdict_level_strains(arena, m, v->motion[i]->loads, v->motion[i]->level, NULL));
        FW_TRY(fw_verdict_bending_judge(arena, (int)i, v->motion[i], v));
        const bool told = options->ways && !options->decision_only; /* of a corner: how near */
        FW_TRY(fw_verdict_clearance_judge(arena, scene, (int)i, layout,
                                          (brief && !told) || options->bounded, diags, v));
        FW_TRY(watch[0].status != FW_OK ? watch[0].status : watch[1].status);
        if (v->motion[i] && seen[0]) {
            const fw_verdict_strain_monitor *saw = v->motion[i]->observed,
                                            *looser = v->motion[i]->compared;
            FW_TRY(fw_verdict_requirements_of_scene(m, (int)i, saw->probe,
                                                    looser ? looser->probe : NULL, v));
        }
        fw_verdict_unstable_leaves_open(v, (int)i, first);
        if (v->motion[i] && v->motion[i]->ended) warn_ended(scene, v->motion[i], diags);
    }
    return FW_OK;
}

/* before anything was run */
static fw_verdict_hinge_verdict blank_verdict(const judged *by) {
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&by->hinge->limits);
    double allowed = limit ? limit->allowable_Pa : by->m->variant->material.strength.value;
    return (fw_verdict_hinge_verdict){.id = by->m->pin[by->hinge->pin].id,
                                      .joint = by->hinge->pin,
                                      .flow = by->m->variant->flow,
                                      .limit = limit,
                                      .limit_Pa = allowed,
                                      .strain_limit = allowed / by->safety_factor / by->youngs_Pa,
                                      .limit_angle_rad = by->hinge->closed_form.limit_angle_rad,
                                      .joint_force_N = (double)NAN,
                                      .over_rotation = (double)NAN,
                                      .failure_probability = (double)NAN,
                                      .fatigue_utilisation = (double)NAN,
                                      .damage = (double)NAN,
                                      .cycles = (double)NAN};
}

/* by what a mode that lies elsewhere, or what the layer presses, may do more or less; NULL: nothing */
static void widen(const double factor[2], fw_verdict_hinge_verdict *h) {
    const double up = factor ? factor[0] - 1 : 0, down = factor ? 1 - factor[1] : 0;
    if (!(up > 0) && !(down > 0)) return;
    h->utilisation_high += h->utilisation * up, h->lasting += up;
    h->utilisation_low *= factor[1], h->lasting_low += down;
    h->parts.model[0] += down, h->parts.model[1] += up;
    if (h->decision != FW_INCONCLUSIVE)
        h->decision = decide(h->utilisation_low, h->utilisation_high);
}

/* What a formula lacks is a share of all of that: what is seen has it already (fw_verdict_motion_beside) */
static void lacks_of_that(double up, double share, fw_verdict_hinge_verdict *h) {
    widen((const double[2]){1 + (up - 1) * share, 1}, h);
}

/* and by what flexures weigh (flexure_swing.c): strains */
static void weigh_on(const double strain[2], fw_verdict_hinge_verdict *h) {
    const double share = h->peak_strain > 0 ? 1 / h->peak_strain : 0,
                 by[2] = {1 + strain[0] * share, fmax(1 - strain[1] * share, 0)};
    widen(by, h);
}

static fw_status judge_hinge(fw_arena *arena, const fw_device *device, const judged *by, int k,
                             const fw_verdict_strain_monitor *monitor, fw_diags *diags,
                             fw_verdict_variant_verdict *v) {
    const fw_verdict_hinge_verdict blank = blank_verdict(by);
    double *used = v->used + (size_t)k * ((size_t)device->nscene + 1);
    v->hinge[k] = blank;
    for (int i = 0; i <= device->nscene; i++)
        used[i] = (double)NAN;
    for (int i = 0; i < device->nscene; i++) {
        if (!v->motion[i]) continue;
        fw_verdict_hinge_verdict now = blank;
        const fw_verdict_strain_monitor *saw = v->motion[i]->observed;
        const fw_verdict_shaken *shaken = v->shaken ? &v->shaken[i] : NULL; /* NULL: nobody asked */
        FW_TRY(judge_scene(arena, by, v->motion[i], saw ? saw : &monitor[i], k,
                           device->scene[i].name, &now));
        widen(shaken ? shaken->factor + 2 * k : NULL, &now);
        lacks_of_that(shaken ? shaken->factor[2 * k] : 1, v->motion[i]->ledger.lacking_share, &now);
        widen(shaken && shaken->grown ? shaken->grown + 2 * k : NULL, &now);
        if (shaken && shaken->flexed) weigh_on(shaken->flexed + 2 * k, &now);
        if (now.touches) FW_TRY(fw_verdict_touching(arena, by->drawn, &now, diags, v));
        used[i] = now.utilisation;
        fw_verdict_keep_worst(&v->hinge[k], &now);
    }
    /* the poses that can be reached; what rides on the six-bar does not bend in them */
    if (v->workspace.required && (v->workspace.reachable || v->workspace.in_part) &&
        by->hinge->pin < FW_SIX) {
        fw_verdict_hinge_verdict now = blank;
        judge_workspace(by, &v->workspace, &now);
        if (now.touches) FW_TRY(fw_verdict_touching(arena, by->drawn, &now, diags, v));
        used[device->nscene] = now.utilisation;
        fw_verdict_keep_worst(&v->hinge[k], &now);
    }
    return fw_verdict_touching(arena, by->drawn, &v->hinge[k], NULL, v);
}

/* ---- the share of a failure probability that each hinge may have ----
   Limits come with equal shares of what is asked of the device: U_k there, so that its hazard is (U_k)^m/n of what is allowed,
   times the safety factor's power. All stresses together may grow until the sum of these is 1, which makes

     U = (sum over k of U_k^m/n)^(1/m)

   the device's utilisation: equation (3) of docs/theory/limits-of-materials.md with n replaced by n' = sum (U_k/U_max)^m,
   flexures as strained as the one that is strained most. So every limit is n^(1/m)/n'^(1/m) times as large, ends of bands
   likewise with those of all. In: hinges as judged; out: their limits, utilisations and decisions. Test:
   tests/cli/test_limits.py */
static bool by_probability(const fw_verdict_hinge_verdict *h) {
    return h->limit && strcmp(h->limit->criterion, "fracture") == 0;
}

static void rescale(double u, double low, double high, fw_verdict_hinge_verdict *h) {
    h->utilisation *= u, h->utilisation_low *= low, h->utilisation_high *= high;
    h->limit_Pa /= u, h->strain_limit /= u, h->limit_angle_rad /= u;
    h->numeric *= u;
    h->lasting = (1 + h->lasting) * high / u - 1;
    h->lasting_low = 1 - (1 - h->lasting_low) * low / u;
    h->decision = decide(h->utilisation_low, h->utilisation_high);
    if ((h->touches || h->open) && h->decision == FW_ACCEPT) h->decision = FW_INCONCLUSIVE;
}

static void share_out(const fw_device *device, const fw_mechanism *m,
                      fw_verdict_variant_verdict *v) {
    const double asked = device->limits.failure_probability, hazard = -log1p(-asked);
    const double modulus = m->nhinge > 0 ? m->hinge[0].limits.weibull.modulus : 0;
    double sum[3] = {0}, most[3] = {0}, by[3];
    if (!(asked > 0)) return;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_verdict_hinge_verdict *h = &v->hinge[k];
        const fw_flexure_weibull *w = &m->hinge[k].limits.weibull;
        if (!w->known || w->modulus != modulus || !(h->failure_probability < 1)) return;
        const double own = device->safety_factor *
                           pow(-log1p(-h->failure_probability) * m->nhinge / hazard, 1 / modulus);
        const double of = h->utilisation > 0 ? own / h->utilisation : 0;
        const double use[3] = {own, of * h->utilisation_low, of * h->utilisation_high};
        for (int i = 0; i < 3; i++)
            sum[i] += pow(use[i], modulus) / m->nhinge, most[i] = fmax(most[i], use[i]);
    }
    for (int i = 0; i < 3; i++)
        by[i] = most[i] > 0 && isfinite(most[i]) ? fmin(pow(sum[i], 1 / modulus) / most[i], 1) : 1;
    for (int k = 0; k < m->nhinge; k++) {
        if (!by_probability(&v->hinge[k])) continue;
        rescale(by[0], by[1], by[2], &v->hinge[k]);
        for (int i = 0; i <= device->nscene; i++)
            v->used[(size_t)k * ((size_t)device->nscene + 1) + (size_t)i] *= by[0];
    }
}

static fw_status judge_hinges(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                              const fw_verdict_strain_monitor *monitor, fw_diags *diags,
                              fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_layout_hinge_layout *drawn = layout && layout->drawn ? layout->hinge : NULL;
    for (int k = 0; k < m->nhinge; k++) {
        const judged by = {.m = m,
                           .hinge = &m->hinge[k],
                           .drawn = drawn ? &drawn[m->hinge[k].pin] : NULL,
                           .youngs_Pa = m->variant->material.youngs.value,
                           .safety_factor = device->safety_factor,
                           .repetitions = device->limits.cycles};
        FW_TRY(judge_hinge(arena, device, &by, k, monitor, diags, v));
    }
    share_out(device, m, v);
    return FW_OK;
}

/* each hinge may break the device: its survival is the product of theirs */
static fw_status in_series(fw_arena *arena, fw_verdict_variant_verdict *v) {
    double *each;
    int n = 0;
    FW_NEED(each = fw_arena_array(arena, double, (size_t)v->nhinge));
    for (int k = 0; k < v->nhinge; k++)
        if (!isnan(v->hinge[k].failure_probability)) each[n++] = v->hinge[k].failure_probability;
    v->failure_probability =
        n > 0 && n == v->nhinge ? fw_flexure_series_probability(each, n) : (double)NAN;
    return FW_OK;
}

/* nothing asks what bodies give but the bands of hinges */
static bool only_hinges_ask(const fw_device *device, const fw_mechanism *m,
                            const fw_verdict_options *options,
                            const fw_verdict_variant_verdict *v) {
    return options->bounded && !options->grid_ways && options->hinges_only &&
           v->nrequirement == 0 && !(device->release_pitch_m > 0) &&
           !fw_verdict_out_of_plane_asked(m);
}

fw_status fw_verdict_variant(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_mechanism *m, const fw_verdict_options *options,
                             fw_diags *diags, fw_verdict_variant_verdict *v) {
    v->mechanism = m;
    v->governing = FW_NONE;
    v->nreason = 0, v->bent = false, v->nhinge = m->nhinge;
    FW_NEED(v->hinge = fw_arena_array(arena, fw_verdict_hinge_verdict, (size_t)m->nhinge));
    size_t rows = (size_t)m->nhinge * ((size_t)device->nscene + 1);
    FW_NEED(v->used = fw_arena_array(arena, double, rows));
    fw_verdict_strain_monitor *monitor =
        fw_arena_array(arena, fw_verdict_strain_monitor, (size_t)device->nscene);
    fw_verdict_strain_monitor *other =
        fw_arena_array(arena, fw_verdict_strain_monitor, (size_t)device->nscene);
    FW_NEED(monitor && other ? monitor : NULL);
    FW_TRY(fw_verdict_requirements_list(arena, m, v));
    FW_TRY(fw_verdict_bending_begin(arena, layout, m, only_hinges_ask(device, m, options, v), v));
    FW_TRY(run_scenes(arena, device, layout, m, options, diags, v, monitor, other));
    if (options->only_scene) return judge_hinges(arena, device, layout, monitor, diags, v);
    const bool brief = is_brief(options, v) || v->corner || options->hinges_only;
    double *bodies;
    FW_NEED(bodies = fw_arena_array(arena, double, (size_t)device->nscene));
    for (int i = 0; i < device->nscene; i++)
        bodies[i] = fw_verdict_bending_share(v->motion[i]);
    FW_TRY(fw_verdict_out_of_plane_judge(arena, m, brief, options->bounded, diags, v));
    FW_TRY(fw_verdict_detune(arena, m, bodies, &options->motion, &fw_verdict_required_of_scenes,
                             brief, diags, v));
    fw_verdict_bent_leaves_open(v, 0);
    if (!options->hinges_only)
        FW_TRY(fw_verdict_stiction_judge(arena, m, brief || options->bounded, v));
    int first = v->nreason;
    FW_TRY(fw_verdict_requirements_end(arena, m, &options->motion, v));
    FW_TRY(fw_workspace_required(arena, m, options->kept, diags, &v->workspace));
    FW_TRY(fw_verdict_bending_judge_required(arena, v));
    fw_verdict_bent_leaves_open(v, first);
    FW_TRY(fw_verdict_clearance_boxes(arena, device, layout,
                                      is_brief(options, v) || options->bounded, v));
    const bool banded = v->corner && !(options->decision_only || options->hinges_only);
    if (!brief || banded) FW_TRY(fw_verdict_hangs_in_plane(arena, v));
    FW_TRY(fw_verdict_flexures_shaken(arena, brief, diags, v));
    FW_TRY(judge_hinges(arena, device, layout, monitor, diags, v));
    if (!brief) FW_TRY(fw_verdict_tell_still(arena, diags, v));
    FW_TRY(fw_verdict_tell_repeated(arena, monitor, v));
    FW_TRY(in_series(arena, v));
    FW_TRY(fw_verdict_out_of_plane_strain(arena, v));
    first = v->nreason;
    FW_TRY(fw_verdict_clearance_strips(arena, layout, v));
    fw_verdict_bent_leaves_open(v, first);
    v->decision = FW_ACCEPT;
    for (int k = 0; k < v->nhinge; k++) {
        if (!v->hinge[k].scene || v->bent) /* nothing was run, or the motion of another device */
            v->hinge[k].decision = FW_INCONCLUSIVE;
        v->decision = fw_verdict_worse(v->decision, v->hinge[k].decision);
        if (v->hinge[k].scene &&
            (v->governing == FW_NONE || fw_verdict_governs(&v->hinge[k], &v->hinge[v->governing])))
            v->governing = k;
    }
    FW_TRY(fw_verdict_tell_lacking(arena, v));
    FW_TRY(fw_verdict_required_poses(arena, v));
    FW_TRY(fw_verdict_missing(arena, device, layout, v));
    for (int i = 0; i < v->nreason; i++)
        v->decision = fw_verdict_worse(v->decision, v->reason[i].decision);
    v->drawn = v->decision;
    return FW_OK;
}
