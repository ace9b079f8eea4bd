/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a study says on a terminal, before it starts and when it is done. */
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

static void number(fw_text *out, double value, const char *unit) {
    if (isnan(value)) {
        fw_text_add(out, "no value");
        return;
    }
    fw_text_number(out, value, 5);
    if (unit && *unit && strcmp(unit, "1") != 0) fw_text_printf(out, " %s", unit);
}

/* in the unit in which an input is written */
static void input_value(fw_text *out, const fw_study_input *in, double value) {
    number(out, fw_quantity_unit_from_si(&in->unit, value), in->unit_text);
}

static void range_of(fw_text *out, const fw_study *study, int k) {
    const fw_study_input *in = &study->input[k];
    fw_text_printf(out, "  %-24s ", in->what);
    if (in->ntext > 0) {
        for (int i = 0; i < in->ntext; i++)
            fw_text_printf(out, "%s%s", i ? ", " : "", in->text[i]);
    } else if (k < study->nvary) {
        input_value(out, in, in->from);
        fw_text_add(out, " to ");
        input_value(out, in, in->to);
        if (study->asked->kind == FW_STUDY_IS_sweep && study->asked->points != FW_POINTS_SOBOL)
            fw_text_printf(out, ", %d values", in->steps);
        if (in->logarithmic) fw_text_add(out, ", equal ratios");
    } else {
        fw_text_add(out, "differs from device to device");
    }
    fw_text_add(out, "\n");
}

static void seconds(fw_text *out, double s) {
    const double scale = s < 120 ? 1 : s < 7200 ? 60 : 3600;
    fw_text_number(out, s / scale, 2);
    fw_text_add(out, s < 120 ? " s" : s < 7200 ? " min" : " h");
}

static void percent(fw_text *out, double share) {
    /* near 1 the rest is what counts */
    double away = fmin(share, 1 - share);
    int digits = away > 0 ? (int)fmax(2, 1 - floor(log10(100 * away))) : 2;
    fw_text_fixed(out, 100 * share, digits > 9 ? 9 : digits);
    fw_text_add(out, " %");
}

static void limit(fw_text *out, const fw_study_response *response, const char *words, double at) {
    if (isnan(at)) return;
    fw_text_add(out, words);
    fw_study_response_text(out, response, at);
}

fw_status fw_study_asked_text(const fw_study *study, fw_text *out) {
    const fw_device_study *a = study->asked;
    fw_text_printf(out, "%s%s of %s: %s, ", FW_NAMED("study", a->name), study->device_name,
                   fw_device_study_kind_text(a->kind));
    if (a->judge == FW_JUDGE_HINGES)
        fw_text_add(out, "hinges and requirements of each device judged as drawn, and nothing of "
                         "clearances, plates and adhesion: ask check of what is chosen\n");
    else if (a->judge == FW_JUDGE_DIE)
        fw_text_add(out, "each device judged as one die of its flow, by value and not by band\n");
    else
        fw_text_printf(out, "each device judged as %s\n",
                       a->kind == FW_STUDY_IS_yield ? "made"
                                                    : fw_device_study_judge_text(a->judge));
    if (a->yield > 0) {
        fw_text_add(out, "  at a yield of at least ");
        percent(out, a->yield);
        fw_text_add(
            out, ", which is estimated for some devices, each of dies beside the devices above\n");
    }
    for (int k = 0; k < study->options.nset; k++)
        fw_text_printf(out, "  --set \"%s=%s\"\n", study->options.set[k].path,
                       study->options.set[k].value);
    for (int k = 0; k < study->ninput; k++)
        range_of(out, study, k);
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_response *q = &study->response[r];
        fw_text_printf(out, "  %-24s %s, now ", q->asked->name, q->asked->value);
        fw_study_response_text(out, q, q->now);
        limit(out, q, ", at least ", q->min);
        limit(out, q, ", at most ", q->max);
        fw_study_counted_say(out, study, r);
    }
    return fw_text_end(out);
}

/* Dies that a size at a wanted yield usually asks: three first estimates, and of one device a yield by few and by all, at
   every combination of the ends of what is only assumed; of each device of its own searches two. */
static fw_status usual_dies(const fw_study *study, long *n, long *inside) {
    fw_study *dies = study->dies;
    *n = *inside = 0;
    if (!(study->asked->yield > 0)) return FW_OK;
    const long all = dies->asked->samples, least = FW_CHANCE_BUDGET_LEAST,
               few = (long)fmax(ceil(6 / (1 - study->asked->yield)), (double)least);
    *n = fw_study_count(study);
    for (int flow = 0; flow < dies->plan->nflow; flow++) {
        fw_study_yielding y;
        FW_TRY(fw_study_yielding_begin(dies, flow, 0, &y));
        *n += 3 * (all / 5 > least ? all / 5 : least) + ((few + all) << y.scatter.joint.unknowns);
        *inside += (few + all) * (long)fw_chance_range_inside(y.scatter.joint.unknowns);
        fw_arena_free(y.chance);
    }
    return FW_OK;
}

/* of the devices of a sensitivity some are judged more accurately */
static void about(const fw_study *study, fw_text *out, double devices) {
    const bool derives = study->asked->kind == FW_STUDY_IS_sensitivity;
    const double tight = derives ? (double)fw_study_count_tight(study) : 0;
    if (!(study->seconds_each > 0)) return;
    fw_text_add(out, ", about ");
    seconds(out, (study->seconds_each * (devices - tight) + study->seconds_tight * tight) /
                     fw_study_jobs(study));
    if (study->asked->kind == FW_STUDY_IS_size || study->asked->kind == FW_STUDY_IS_worst_case)
        fw_text_add(out, " to four times that, as devices near limits take longer");
}

static void say_inside(const fw_study *study, fw_text *out, long n) {
    if (n <= 0) return;
    fw_text_printf(out, "; up to %ld more where the ends of what is only assumed do not do", n);
    about(study, out, (double)n);
}

static fw_status plan_of_yield(const fw_study *study, fw_text *out) {
    fw_text_printf(out, "%ld devices where they are merely counted", study->likely);
    about(study, out, (double)study->likely);
    say_inside(study, out, study->inside);
    fw_text_printf(out, "; at most %ld, where failures are rare", study->most);
    about(study, out, (double)study->most);
    fw_text_printf(out, "; in %d threads", fw_study_jobs(study));
    if (study->seconds_each > 0) {
        fw_text_add(out, " (one took ");
        seconds(out, study->seconds_each);
        fw_text_add(out, ")");
    }
    fw_text_printf(out,
                   "\n  %ld estimates of at most %ld devices: as computed, and with every check at "
                   "either end of its band%s; one that merely counts takes %ld, "
                   "16 times a power of two\n",
                   study->estimates, fw_study_count(study),
                   study->inside > 0 ? ", of each flow and at each corner of what is only assumed, "
                                       "and inside where its ends may not be enough"
                   : study->estimates > 3 ? ", of each flow"
                                          : "",
                   study->counted);
    return fw_text_end(out);
}

fw_status fw_study_plan_text(const fw_study *study, fw_text *out) {
    long n = fw_study_count(study), dies, inside, jobs = fw_study_jobs(study);
    FW_TRY(fw_study_asked_text(study, out));
    if (study->asked->kind == FW_STUDY_IS_yield) return plan_of_yield(study, out);
    FW_TRY(usual_dies(study, &dies, &inside));
    fw_text_printf(out, "%s%ld devices%s in %ld threads",
                   study->asked->kind == FW_STUDY_IS_sweep ? "" : "at most ", n,
                   dies > 0 ? fw_arena_printf(study->arena, " and some %ld dies", dies) : "", jobs);
    n += dies;
    if (study->asked->fitted > 0) {
        fw_text_add(out, ", of which response surfaces tell those that they can to within ");
        percent(out, study->asked->fitted);
        fw_text_add(out, "; if all were judged");
    }
    if (study->seconds_each > 0) {
        about(study, out, (double)n);
        fw_text_add(out, " (one took ");
        seconds(out, study->seconds_each);
        if (study->asked->kind == FW_STUDY_IS_sensitivity)
            fw_text_printf(out, "; the %ld that derivatives are taken from are run at 1e-9, ",
                           fw_study_count_tight(study)),
                seconds(out, study->seconds_tight), fw_text_add(out, " each");
        if (dies > 0)
            fw_text_add(out,
                        "; several times as long where the first devices do not have the yield");
        fw_text_add(out, ")");
    }
    say_inside(study, out, inside);
    fw_text_add(out, "\n");
    return fw_text_end(out);
}

/* ---- when it is done ---- */

static void settings(fw_text *out, const fw_study *study, char (*text)[FW_STUDY_TEXT]) {
    for (int k = 0; k < study->nvary; k++)
        fw_text_printf(out, " --set \"%s=%s\"", study->input[k].what, text[k]);
    fw_text_add(out, "\n");
}

static void say_samples(fw_text *out, const fw_study *study) {
    const fw_study_result *r = study->result;
    fw_text_printf(out, "%ld devices", r->run + r->failed);
    if (r->accepted + r->rejected + r->inconclusive + r->partly > 0)
        fw_text_printf(out, ": %ld accepted, %ld rejected, %ld inconclusive", r->accepted,
                       r->rejected, r->inconclusive);
    if (r->partly > 0) fw_text_printf(out, ", %ld no better than these", r->partly);
    if (r->failed > 0)
        fw_text_printf(out, "; %ld could not be judged (number %ld: %s)", r->failed, r->example_at,
                       r->example_why);
    fw_text_add(out, "\n");
}

/* of a sweep of which response surfaces told most devices */
static void say_fitted(fw_text *out, const fw_study *study) {
    const fw_study_fitted *f = study->result->fitted;
    if (!f) return;
    if (f->told == 0) {
        fw_text_add(out, "  all of them were judged: response surfaces told none\n");
        return;
    }
    fw_text_printf(out,
                   "  %ld of them were told by response surfaces of %ld that were judged, %ld more "
                   "were judged since the surfaces left them open\n",
                   f->told, f->judged, f->open);
    if (f->checked > 0)
        fw_text_printf(out,
                       "  %ld were told first and then judged, to see: all came as told; so, at "
                       "95 %%, fewer than 1 in %ld of those told is told wrongly\n",
                       f->checked, f->checked / 3 > 1 ? f->checked / 3 : 1);
}

static void say_ranges(fw_text *out, const fw_study *study) {
    say_fitted(out, study);
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_response *q = &study->response[r];
        const fw_study_extreme *e = &study->result->extreme[r];
        fw_text_printf(out, "  %-24s ", q->asked->name);
        if (e->n == 0) {
            fw_text_add(out, "no value in any device\n");
            continue;
        }
        fw_study_response_text(out, q, e->least);
        fw_text_printf(out, " (number %ld) to ", e->least_at);
        fw_study_response_text(out, q, e->largest);
        fw_text_printf(out, " (number %ld)", e->largest_at);
        if (e->n < study->result->run + study->result->failed)
            fw_text_printf(out, ", in %ld devices", e->n);
        if (study->result->fitted && study->result->fitted->told > 0) {
            fw_text_add(out, "; told ones to within ");
            fw_study_change_text(out, q, study->result->fitted->off[r]);
        }
        fw_text_add(out, "\n");
    }
}

static void say_ends(fw_text *out, const fw_study *study) {
    for (int r = 0; r < study->nresponse; r++)
        for (int e = 0; e < 2; e++) {
            const fw_study_end *end = &study->result->end[2 * r + e];
            const fw_study_extreme *all = &study->result->extreme[r];
            fw_text_printf(out, "  %-24s %s ", study->response[r].asked->name,
                           e == 0 ? "least" : "largest");
            if (!end->known) {
                fw_text_add(out, "not known: no value in any device\n");
                continue;
            }
            if (all->without.at < 0)
                fw_text_add(out, "found ");
            else
                fw_text_printf(out, "of the %ld that have one ", all->n);
            fw_study_response_text(out, &study->response[r], end->value);
            fw_text_add(out, " at");
            settings(out, study, end->text);
        }
}

/* of inputs whose derivatives are not taken at the description */
static void say_elsewhere(fw_text *out, const fw_study *study) {
    for (int k = 0; k < study->ninput; k++) {
        const fw_study_input *in = &study->input[k];
        if (fw_study_input_is_inside(in)) continue;
        fw_text_printf(out, "  derivatives are taken at %s = ", in->what);
        input_value(out, in, fw_study_input_centre(in));
        fw_text_add(out, ", the middle of its range: ");
        if (isnan(in->now)) {
            fw_text_add(out, "it is no parameter, whose value in the description would be taken\n");
            continue;
        }
        fw_text_add(out, "the description has ");
        input_value(out, in, in->now);
        fw_text_add(out, ", outside of it\n");
    }
}

/* with the ends that its samples leave it */
static void say_part(fw_text *out, double value, double low, double high, const char *of) {
    fw_text_number(out, value, 2);
    if (!isnan(low) && !isnan(high)) {
        fw_text_add(out, " (");
        fw_text_number(out, low, 2);
        fw_text_add(out, " to ");
        fw_text_number(out, high, 2);
        fw_text_add(out, ")");
    }
    fw_text_add(out, of);
}

/* a slope as what half the range would make of it, and what that may be off by */
static void say_derivative(fw_text *out, const fw_study *study, int k, const fw_study_response *q,
                           const fw_study_derivative *d) {
    const fw_study_input *in = &study->input[k];
    const double half = 0.5 * (in->to - in->from);
    if (isnan(d->value) && !isnan(d->slope[0])) {
        fw_text_add(out, "its derivative is not known: half the range would change it by ");
        fw_study_change_text(out, q, d->slope[0] * half);
        fw_text_add(out, " by devices as far as ");
        input_value(out, in, d->wide);
        fw_text_add(out, ", and by ");
        fw_study_change_text(out, q, d->slope[1] * half);
        fw_text_add(out, " by those as near as ");
        input_value(out, in, d->over);
        return;
    }
    if (isnan(d->value)) {
        fw_text_add(out,
                    "its derivative is not known: a device that it is taken from has no value");
        return;
    }
    fw_text_add(out, "half its range changes it by ");
    fw_study_change_text(out, q, d->spread);
    fw_text_add(out, " (to within ");
    fw_text_number(out, fw_study_response_drawn(q, d->error * half), 2);
    fw_text_add(out, ")");
    if (d->wide > 0) {
        fw_text_add(out, ", by its slope over ");
        input_value(out, in, d->over);
        fw_text_add(out, ", which ends within ");
        input_value(out, in, d->wide);
    }
}

static void say_sensitivity(fw_text *out, const fw_study *study) {
    const fw_study_result *result = study->result;
    say_elsewhere(out, study);
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_response *q = &study->response[r];
        fw_text_printf(out, "  %s, now ", q->asked->name);
        fw_study_response_text(out, q, q->now);
        fw_text_add(out, "\n");
        for (int k = 0; k < study->ninput; k++) {
            size_t at = (size_t)r * (size_t)study->ninput + (size_t)k;
            const fw_study_derivative *d = &result->derivative[at];
            const fw_study_index *x = result->index ? &result->index[at] : NULL;
            fw_text_printf(out, "    %-22s ", study->input[k].what);
            say_derivative(out, study, k, q, d);
            if (x && isnan(x->total)) {
                fw_text_add(out, "; at the accuracy asked it does not vary over the ranges");
            } else if (x) {
                fw_text_add(out, "; share of its variance ");
                say_part(out, x->first, x->first_low, x->first_high, " alone, ");
                say_part(out, x->total, x->total_low, x->total_high, " with others");
            }
            fw_text_add(out, "\n");
        }
    }
}

static void say_found(fw_text *out, const fw_study *study, const fw_study_found *f) {
    fw_text_add(out, " ");
    for (int r = 0; r < study->nresponse; r++) {
        fw_text_printf(out, "%s %s ", r ? "," : "", study->response[r].asked->name);
        fw_study_response_text(out, &study->response[r], f->response[r]);
    }
    fw_text_add(out, "\n   ");
    settings(out, study, f->text);
    for (int k = 0; k < f->nlimit; k++)
        fw_text_printf(out, "    %s: %s\n", f->excess > 0 ? "in the way" : "it ends where",
                       f->limit[k]);
}

static void say_size(fw_text *out, const fw_study *study) {
    const fw_study_result *r = study->result;
    if (r->nfound == 0) {
        fw_text_add(out, "no device was found that holds every limit and is accepted");
        if (study->asked->yield > 0) {
            fw_text_add(out, " and has a yield of ");
            percent(out, study->asked->yield);
            if (r->may_be > 0)
                fw_text_printf(out, " (that of %ld of %ld accepted devices was estimated%s)",
                               r->estimated, r->may_be,
                               r->estimated < r->may_be
                                   ? ", the last of them those that are farthest from their limits"
                                   : "");
        }
        if (r->nearest.text) {
            fw_text_add(out, "; the nearest:\n");
            say_found(out, study, &r->nearest);
        } else {
            fw_text_add(out, "\n");
        }
    } else {
        if (r->nfound == 1)
            fw_text_printf(out, "the best that was found (accepted, number %ld):\n", r->found[0].i);
        else
            fw_text_printf(out, "%ld devices that no other beats in both goals", r->unbeaten);
        if (r->nfound > 1 && r->unbeaten > r->nfound)
            fw_text_printf(out, "; %d of them, evenly along the front", r->nfound);
        if (r->nfound > 1) fw_text_add(out, ":\n");
        for (int i = 0; i < r->nfound; i++)
            say_found(out, study, &r->found[i]);
    }
}

static void say_place(fw_text *out, const fw_study_levels *l, size_t q) {
    percent(out, l->at[q].value);
    fw_text_printf(out, " at %s (", l->scatter->place[q].id);
    percent(out, l->at[q].low);
    fw_text_add(out, " to ");
    percent(out, l->at[q].high);
    fw_text_add(out, ")");
}

static void say_places(fw_text *out, const fw_study_levels *l) {
    size_t least = 0, most = 0;
    if (!l->at) return;
    for (size_t q = 0; q < l->scatter->places; q++) {
        if (l->at[q].value < l->at[least].value) least = q;
        if (l->at[q].value > l->at[most].value) most = q;
    }
    fw_text_printf(out, "  of %zu dies on the wafer: ", l->scatter->places);
    say_place(out, l, least);
    fw_text_add(out, ", ");
    say_place(out, l, most);
    fw_text_add(out, "\n");
}

/* "29.53 % (0 to 40.1 %)": what a simulation of so many dies finds is not what is */
static void say_within(fw_text *out, const fw_chance_share *s, int places) {
    fw_text_fixed(out, 100 * s->value, places);
    fw_text_add(out, " % (");
    fw_text_fixed(out, 100 * s->low, places);
    fw_text_add(out, " to ");
    fw_text_fixed(out, 100 * s->high, places);
    fw_text_add(out, " %)");
}

/* what is on which level, of the spread of what devices use */
static void say_levels(fw_text *out, const fw_study_levels *l) {
    const struct {
        const char *name;
        const fw_chance_share *share;
        bool always;
    } row[] = {{"from lot to lot", &l->used.lot, true},
               {"from wafer to wafer", &l->used.wafer, true},
               {"by place on the wafer", &l->used.place, l->at != NULL},
               {"from die to die", &l->used.die, true},
               {"from hinge to hinge", &l->used.hinge, l->hinges}};
    if (l->used.units == 0 || !(l->used.variance > 0)) return;
    fw_text_add(out, "  of the spread of what devices use, ");
    for (size_t k = 0, n = 0; k < sizeof row / sizeof row[0]; k++) {
        if (!row[k].always) continue;
        fw_text_add(out, n++ ? ", " : "");
        say_within(out, row[k].share, 0);
        fw_text_printf(out, " is %s", row[k].name);
    }
    fw_text_add(out, " (");
    fw_text_printf(out, "%ld devices of simulated wafers)\n", l->devices);
    fw_text_add(out, "  the yield of a wafer is off by ");
    say_within(out, &l->held.wafer_sd, 1);
    fw_text_add(out, ", that of a lot by ");
    say_within(out, &l->held.lot_sd, 1);
    fw_text_add(out, " (standard deviations)\n");
    say_places(out, l);
    if (l->not_judged > 0)
        fw_text_printf(out, "  %ld of these devices could not be judged and are left out\n",
                       l->not_judged);
}

static void between(fw_text *out, double low, double high) {
    percent(out, low);
    fw_text_add(out, " to ");
    percent(out, high);
}

static void say_end(fw_text *out, const fw_study_flow_yield *y, const fw_study_yield_end *end) {
    percent(out, end->value);
    fw_text_add(out, " (");
    between(out, end->low, end->high);
    fw_text_add(out, " by sampling");
    for (int k = 0; k < y->nassumed; k++) {
        fw_quantity_unit unit = {.factor = 1};
        const char *of = y->assumed_unit[k];
        fw_quantity_unit_parse(of, strlen(of), &unit, NULL, NULL);
        fw_text_printf(out, "%s %s ", k ? "," : ";", y->assumed[k]);
        number(out, fw_quantity_unit_from_si(&unit, end->at[k]), of);
    }
}

/* one number, or from the least to the most over what is only assumed: the two are never one population */
static void say_share(fw_text *out, const fw_study_flow_yield *y) {
    say_end(out, y, &y->least);
    if (y->nassumed > 0) {
        fw_text_add(out, ") to ");
        say_end(out, y, &y->most);
        fw_text_add(out, "), as is what is only assumed; ");
    } else {
        fw_text_add(out, "; ");
    }
    between(out, y->low, y->high);
    fw_text_add(out, " with what the model may be off by");
    fw_text_add(out, y->nassumed > 0 ? "\n" : ")\n");
}

/* where so few fail that the yield is all nines */
static void say_failing(fw_text *out, const fw_study_yield_end *end) {
    if (end->low < 0.9999) return;
    fw_text_add(out, "  of all devices ");
    fw_text_number(out, 1 - end->value, 2);
    fw_text_add(out, " fail (");
    fw_text_number(out, 1 - end->high, 2);
    fw_text_add(out, " to ");
    fw_text_number(out, 1 - end->low, 2);
    fw_text_add(out, " by sampling)\n");
}

/* of a number of devices that was asked for and is not the one that was judged */
static void say_devices(fw_text *out, const fw_study *study, const fw_study_flow_yield *y) {
    fw_text_printf(out, "  %ld devices by %s: %s\n", y->evaluations, y->method, y->reason);
    /* those of a size are devices that it tries */
    if (study->asked->kind != FW_STUDY_IS_yield) return;
    if (study->asked->samples <= 0 || study->asked->samples == y->evaluations) return;
    fw_text_printf(out, "  samples=\"%d\" is the most for one estimate, and one took %ld",
                   study->asked->samples, y->each);
    if (y->nassumed > 0)
        fw_text_printf(out, "; there is one at each of %ld settings of what is only assumed",
                       y->settings);
    fw_text_add(out, "\n");
}

static void say_yield(fw_text *out, const fw_study *study) {
    for (int i = 0; i < study->result->nyield; i++) {
        const fw_study_flow_yield *y = &study->result->yield[i];
        fw_text_printf(out, "%s: yield ", y->flow ? y->flow : study->device_name);
        say_share(out, y);
        say_failing(out, &y->least);
        say_devices(out, study, y);
        if (y->sought) fw_text_printf(out, "  %s\n", y->sought);
        if (y->caution) fw_text_printf(out, "  %s\n", y->caution);
        if (y->unevaluated > 0)
            fw_text_printf(out, "  %ld of them could not be judged: they count both ways\n",
                           y->unevaluated);
        if (y->levels) say_levels(out, y->levels);
        if (!y->share) continue;
        fw_text_add(out, "  the nearest device that fails is ");
        fw_text_number(out, y->beta, 3);
        fw_text_add(out, " standard deviations away; of that way ");
        for (int k = 0; k < y->ninput; k++) {
            fw_text_printf(out, "%s%s has ", k ? ", " : "", y->input[k]);
            percent(out, y->share[k]);
        }
        fw_text_add(out, "\n");
    }
}

fw_status fw_study_text(const fw_study *study, fw_text *out) {
    fw_text_printf(out, "%s%s of %s: %s%s\n", FW_NAMED("study", study->asked->name),
                   study->device_name, fw_device_study_kind_text(study->asked->kind),
                   study->asked->judge == FW_JUDGE_HINGES
                       ? ", of hinges and requirements as drawn alone (not of clearances, plates, "
                         "adhesion)"
                       : "");
    say_samples(out, study);
    switch (study->asked->kind) {
    case FW_STUDY_IS_sweep:
        say_ranges(out, study);
        break;
    case FW_STUDY_IS_yield:
        say_yield(out, study);
        break;
    case FW_STUDY_IS_size:
        say_size(out, study);
        say_yield(out, study); /* of what was found, where one is wanted */
        break;
    case FW_STUDY_IS_sensitivity:
        say_sensitivity(out, study);
        break;
    case FW_STUDY_IS_worst_case:
        say_ends(out, study);
        break;
    case FW_STUDY_KINDS:
        break;
    }
    fw_study_without_say(out, study);
    if (study->result->how) fw_text_printf(out, "%s\n", study->result->how);
    return fw_text_end(out);
}

int fw_study_decision(const fw_study *study) {
    const fw_study_result *r = study->result;
    if (!study->asked || !r || study->options.shards > 0) return 0; /* of a shard: merging says */
    if (study->asked->kind == FW_STUDY_IS_size) return r->nfound == 0 ? 1 : 0;
    return r->failed > 0 && r->run == 0 ? 4 : 0;
}
