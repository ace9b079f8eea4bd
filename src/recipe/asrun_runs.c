/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which entries of a log belong together: what became of wafers, runs of one step on one wafer, what a later run took the
   place of or overtook, wafers in one machine at one time, what a wafer waited. */
#include "base/text.h"
#include "recipe/asrun_parts.h"
#include "schedule/schedule.h"
#include <math.h>
#include <string.h>

/* ---- what became of wafers ---- */

const char *fw_recipe_fate_word(fw_recipe_fate fate) {
    static const char *const word[] = {NULL, "held", "resumed", "scrapped"};
    return word[fate];
}

const fw_recipe_asrun_entry *fw_recipe_asrun_out(const fw_recipe_asrun *run, const char *wafer,
                                                 double time_s) {
    const fw_recipe_asrun_entry *last = NULL;
    for (const fw_recipe_asrun_entry *e = run->entry; e < run->entry + run->nentry; e++)
        if (e->fate != FW_FATE_RUN && strcmp(e->wafer, wafer) == 0 && e->start_s < time_s) last = e;
    return last && last->fate != FW_FATE_RESUMED ? last : NULL;
}

bool fw_recipe_asrun_expects(const fw_recipe_asrun *run, const fw_process_step *step,
                             const char *wafer) {
    const fw_recipe_asrun_entry *last = NULL;
    for (const fw_recipe_asrun_entry *e = run->entry; e < run->entry + run->nentry; e++)
        if (e->step == step && (!e->wafer || strcmp(e->wafer, wafer) == 0)) last = e;
    if (last && !fw_recipe_asrun_overtaken(run, last, wafer)) return false;
    return !fw_recipe_asrun_out(run, wafer, (double)INFINITY);
}

int fw_recipe_asrun_count(const fw_process_flow *flow, const fw_recipe_asrun *run, int steps,
                          fw_recipe_fate fate) {
    int n = 0;
    for (int i = 0; i < run->nwafer; i++) {
        const fw_recipe_asrun_entry *out =
            fw_recipe_asrun_out(run, run->wafer[i], (double)INFINITY);
        const bool before = out && out->at < flow->step + steps;
        n += before ? out->fate == fate : fate == FW_FATE_RUN;
    }
    return n;
}

/* ---- runs of one step on one wafer ---- */

bool fw_recipe_asrun_replaces(const fw_recipe_asrun_entry *e, const fw_recipe_asrun_entry *o) {
    double line;
    return e->replaces && fw_number_parse(e->replaces, strlen(e->replaces), &line) &&
           line == o->line;
}

bool fw_recipe_asrun_taken_back(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *o) {
    for (const fw_recipe_asrun_entry *by = o + 1; by < run->entry + run->nentry; by++)
        if (fw_recipe_asrun_replaces(by, o)) return true;
    return false;
}

/* by an entry of the same run, or by one that was made later and begins earlier, which takes its place (decision 159) */
static bool is_replaced(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *o) {
    for (const fw_recipe_asrun_entry *by = o + 1; by < run->entry + run->nentry; by++)
        if (by->step == o->step && fw_text_same(by->wafer, o->wafer) &&
            (by->start_s <= o->start_s || by->start_s < o->end_s ||
             fw_recipe_asrun_replaces(by, o)))
            return true;
    return false;
}

bool fw_recipe_asrun_is_last(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    for (const fw_recipe_asrun_entry *later = e + 1; later < run->entry + run->nentry; later++)
        if (later->step == e->step && fw_text_same(later->wafer, e->wafer)) return false;
    return true;
}

/* A load is an entry of each of its wafers, alike: they share its time. As many loads one after the other as the step takes
   for them, and (*together) how many share it. So do wafers that a step of the whole lot was logged for. */
double fw_recipe_asrun_loads(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                             int *together) {
    *together = 1;
    if (!e->wafer) return e->loads;
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++)
        *together += o->step == e->step && o->wafer && strcmp(o->wafer, e->wafer) != 0 &&
                     o->start_s == e->start_s && o->end_s == e->end_s && !is_replaced(run, o);
    return fw_process_step_is_of_lot(e->step) ? fw_process_step_times(run->flow, e->step, *together)
                                              : (*together + e->step->batch - 1) / e->step->batch;
}

/* what e's wafer has been through, too: an entry of the same wafer, or one of the whole lot */
static bool of_its_wafer(const fw_recipe_asrun_entry *o, const fw_recipe_asrun_entry *e) {
    return !o->wafer || (e->wafer && strcmp(o->wafer, e->wafer) == 0);
}

const fw_recipe_asrun_entry *fw_recipe_asrun_run_before(const fw_recipe_asrun *run,
                                                        const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *before = NULL;
    for (const fw_recipe_asrun_entry *o = e; e->step && o-- > run->entry;) /* the last ones first */
        if (o->step == e->step && of_its_wafer(o, e) && o->end_s <= e->start_s &&
            (!before || o->start_s > before->start_s) && !is_replaced(run, o))
            before = o;
    return before;
}

/* Does step x make or take away what step s works on, so that s begins anew? What s removes or prints is put there, or what
   it adds is removed. What changes nothing itself, as a bake, begins anew after whatever changes the wafer. */
static bool renews(const fw_process_step *x, const fw_process_step *s) {
    bool anew = s->nchange == 0 && x->nchange > 0 && x < s;
    for (int i = 0; i < s->nchange; i++)
        for (int k = 0; k < x->nchange; k++) {
            const bool adds = strcmp(s->change[i].kind, "add") == 0,
                       takes = strcmp(x->change[k].kind, "remove") == 0,
                       puts = strcmp(x->change[k].kind, "add") == 0;
            anew = anew || (strcmp(s->change[i].material, x->change[k].material) == 0 &&
                            (adds ? takes : puts));
        }
    return anew;
}

const fw_recipe_asrun_entry *fw_recipe_asrun_goes_on_from(const fw_recipe_asrun *run,
                                                          const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *from =
        e->step && fw_process_step_adds_up(e->step) ? fw_recipe_asrun_run_before(run, e) : NULL;
    for (int i = 0; from && i < run->nentry; i++) {
        const fw_recipe_asrun_entry *x = &run->entry[i];
        if (x->step && x->step != e->step && of_its_wafer(x, e) && x->start_s >= from->start_s &&
            x->start_s < e->start_s && renews(x->step, e->step))
            return NULL;
    }
    return from;
}

static bool inspects(const fw_process_step *s) {
    return strcmp(s->op, "inspect") == 0;
}

/* is the material bonded to the wafer later on, and not there before? */
static bool is_bonded_later(const fw_process_flow *flow, const fw_process_step *s,
                            const char *material) {
    bool later = false;
    for (const fw_process_step *x = flow->step; x < flow->step + flow->nstep; x++)
        for (int k = 0; k < x->nchange; k++) {
            if (strcmp(x->change[k].material, material) != 0) continue;
            if (x < s) return false;
            later = later || (strcmp(x->op, "bond") == 0 && strcmp(x->change[k].kind, "add") == 0);
        }
    return later;
}

/* what is looked at while what it will be a part of is made elsewhere: the second wafer of a bond, before it is there */
static bool is_beside(const fw_process_flow *flow, const fw_process_step *step) {
    for (int i = 0; i < step->nrequired; i++)
        if (step->required[i].material && !step->required[i].present && inspects(step) &&
            is_bonded_later(flow, step, step->required[i].material))
            return true;
    return fw_process_step_is_of_lot(step);
}

/* Is this what an inspection looks at? The step that it requires or that stands before it, and whatever makes or takes away a
   material that it requires to be there or gone */
static bool is_looked_at(const fw_process_step *made, const fw_process_step *by) {
    bool is = made + 1 == by;
    for (int i = 0; i < by->nrequired; i++) {
        const fw_process_requirement *r = &by->required[i];
        is = is || (r->step && strcmp(r->step, made->id) == 0);
        for (int k = 0; r->material && k < made->nchange; k++)
            is = is || strcmp(made->change[k].material, r->material) == 0;
    }
    return is;
}

static bool is_of(const fw_recipe_asrun_entry *e, const char *wafer) {
    return !e->wafer || !wafer || strcmp(e->wafer, wafer) == 0;
}

/* was the step of o run on the wafer before e ended? Then o repeats it, and is not only late in the log */
bool fw_recipe_asrun_is_again(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *o,
                              const fw_recipe_asrun_entry *e, const char *wafer) {
    for (const fw_recipe_asrun_entry *b = run->entry; b < run->entry + run->nentry; b++)
        if (b != o && b->step == o->step && is_of(b, wafer) && b->start_s < e->end_s &&
            !fw_recipe_asrun_taken_back(run, b))
            return true;
    return false;
}

/* The step that e inspects was run after it for the first time: what e looked at was not there yet */
static bool is_too_early(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                         const fw_recipe_asrun_entry *o) {
    return inspects(e->step) && is_looked_at(o->step, e->step) && !is_beside(run->flow, e->step) &&
           o->end_s > e->end_s + fw_recipe_asrun_clock_s(e);
}

/* An inspection tells of the wafer as it was: whatever was done again before it has it look again, and so has the step that it
   inspects where that was run after it alone. So has what works on a film that was made anew. The first such run in the log. */
const fw_recipe_asrun_entry *fw_recipe_asrun_overtaken(const fw_recipe_asrun *run,
                                                       const fw_recipe_asrun_entry *e,
                                                       const char *wafer) {
    if (!e->step || fw_process_step_is_of_lot(e->step)) return NULL;
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++)
        if (o->step && o->step < e->step && !inspects(o->step) &&
            !fw_process_step_is_of_lot(o->step) && is_of(o, wafer) && o->start_s >= e->end_s &&
            !is_replaced(run, o) &&
            (fw_recipe_asrun_is_again(run, o, e, wafer)
                 ? inspects(e->step) || renews(o->step, e->step)
                 : is_too_early(run, e, o)))
            return o;
    return NULL;
}

/* the last entry of the step and of the wafer that stands in the log */
static bool is_last_of(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                       const char *wafer) {
    for (const fw_recipe_asrun_entry *later = e + 1; later < run->entry + run->nentry; later++)
        if (later->step == e->step && is_of(later, wafer)) return false;
    return true;
}

/* FW-D707: x looked at what is run after it; `now` is whichever of the two is entered now */
static fw_status ask_too_early(const fw_recipe_asrun_entry *x, const fw_recipe_asrun_entry *by,
                               fw_place place, fw_diags *diags) {
    fw_diag_warning(
        diags, 707, place,
        "step %s%s%s (%s to %s) was done before step %s, which it inspects (%s to %s): it "
        "looked at a wafer without it, and what it found counts no more; log %s again, "
        "or its right times",
        x->step->id, x->wafer ? " of wafer " : "", x->wafer ? x->wafer : "", x->start, x->end,
        by->step->id, by->start, by->end, x->step->id);
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_recipe_asrun_ask_overtaken(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                        fw_place place, fw_diags *diags) {
    fw_text list = fw_text_new(diags->arena);
    int n = 0;
    for (const fw_recipe_asrun_entry *x = run->entry; x < run->entry + run->nentry; x++) {
        if (!x->step || !is_of(x, e->wafer) || !is_last_of(run, x, e->wafer)) continue;
        const fw_recipe_asrun_entry *by = fw_recipe_asrun_overtaken(run, x, e->wafer);
        if (!by || (by != e && x != e)) continue;
        if (!fw_recipe_asrun_is_again(run, by, x, e->wafer))
            FW_TRY(ask_too_early(x, by, place, diags));
        else if (by == e)
            fw_text_printf(&list, "%s%s (line %d)", n++ ? ", " : "", x->step->id, x->line);
    }
    if (n == 0) return FW_OK;
    FW_TRY(fw_text_end(&list));
    fw_diag_warning(diags, 687, place,
                    "step %s%s%s was run again, after %s: what was done or found there is no "
                    "longer so, and counts no more; log %s again",
                    e->step->id, e->wafer ? " of wafer " : "", e->wafer ? e->wafer : "", list.data,
                    n > 1 ? "these steps" : "that step");
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* The last of the runs that make and end what is read, by the times of the log; where none is before e, the first one that makes
   it. Test: test_asrun.c, lines_in_the_resist */
const fw_recipe_asrun_entry *fw_recipe_asrun_not_there(const fw_recipe_asrun *run,
                                                       const fw_recipe_asrun_entry *e,
                                                       const fw_process_coupon_stage *stage) {
    const fw_recipe_asrun_entry *last = NULL, *later = NULL;
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++) {
        const bool makes = o->step && o->step == stage->from,
                   ends = o->step && o->step == stage->until;
        if ((!makes && !ends) || !is_of(o, e->wafer) || is_replaced(run, o)) continue;
        if (o == e) return NULL;
        const bool before = makes ? o->start_s < e->end_s : o->end_s <= e->start_s;
        if (before && (!last || o->start_s > last->start_s)) last = o;
        if (makes && !before && !later) later = o;
    }
    if (!last) return later;
    return last->step == stage->until ? last : NULL;
}

fw_recipe_runs fw_recipe_asrun_runs(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    const fw_process_time *last = &e->as_set->time;
    fw_recipe_runs all = {0};
    for (; e; e = fw_recipe_asrun_goes_on_from(run, e)) {
        const fw_process_time *of = &e->as_set->time;
        const bool known = last->computable && of->computable && of->nominal_s > 0.0;
        int together;
        const double took = (e->end_s - e->start_s) / fw_recipe_asrun_loads(run, e, &together);
        all.n++;
        all.took_s += took;
        all.time_s += known ? took * last->nominal_s / of->nominal_s : took;
    }
    return all;
}

/* ---- wafers in one machine at one time ---- */

double fw_recipe_asrun_clock_s(const fw_recipe_asrun_entry *e) {
    const bool to_the_second = e->start[16] == ':' && e->end[16] == ':';
    return to_the_second ? 0.0 : 60.0;
}

/* Machines of one name are one, and so are those that no entry names */
static bool same_machine(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b) {
    return a->step->equipment && a->step->equipment == b->step->equipment &&
           fw_text_same(a->tool, b->tool);
}

/* Of the wafers that an entry is of, those that are in the machine at one time: all of them, unless its time is enough for
   their loads one after the other. Of entries that share their time each has its part. */
static double at_once_of(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    int together;
    const double loads = fw_recipe_asrun_loads(run, e, &together),
                 took_s = e->end_s - e->start_s + fw_recipe_asrun_clock_s(e);
    const double wafers = e->wafer ? 1.0 : fmin(loads * e->step->batch, fmax(run->nwafer, 1.0));
    const fw_process_time *time = &e->as_set->time;
    const bool enough = !time->computable || took_s >= loads * time->first_look_s;
    return enough ? wafers / loads : wafers;
}

/* is the wafer of o surely in the machine when `at` begins, or in one load with it? */
static bool is_in(const fw_recipe_asrun_entry *o, const fw_recipe_asrun_entry *at) {
    const bool alike = o->step == at->step && o->start_s == at->start_s && o->end_s == at->end_s;
    return alike ||
           (o->start_s <= at->start_s && o->end_s - at->start_s > fw_recipe_asrun_clock_s(o));
}

/* How many wafers are in the machine of the entry with it at one time, by all entries of the machine or by those of its step
   alone; 0: no machine is known, or the step is once for a lot */
static int at_once(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, bool of_its_step) {
    const fw_recipe_asrun_entry *const end = run->entry + run->nentry;
    double most = 0.0;
    if (!e->step || fw_process_step_is_of_lot(e->step) || is_replaced(run, e)) return 0;
    for (const fw_recipe_asrun_entry *at = run->entry; at < end; at++) {
        double n = 0.0; /* when that entry begins */
        for (const fw_recipe_asrun_entry *o = run->entry; o < end && is_in(e, at); o++)
            if (o->step && same_machine(o, e) && !fw_process_step_is_of_lot(o->step) &&
                (!of_its_step || o->step == e->step) && !is_replaced(run, o) && is_in(o, at))
                n += at_once_of(run, o);
        most = fmax(most, n);
    }
    return (int)lround(ceil(most - 1e-6));
}

fw_status fw_recipe_asrun_too_many(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_asrun_entry *e, const char **is,
                                   const char **allowed) {
    const int batch = e->step->batch,
              capacity = e->step->equipment ? e->step->equipment->capacity : 0,
              of_step = at_once(run, e, true), of_all = at_once(run, e, false);
    *is = NULL;
    if (of_step <= batch && of_all <= capacity) return FW_OK;
    const bool step = of_step > batch;
    *is = fw_arena_printf(arena, "%d wafers", step ? of_step : of_all);
    *allowed = fw_arena_printf(arena, "%d in %s", step ? batch : capacity, e->step->equipment->id);
    FW_NEED(*is);
    FW_NEED(*allowed);
    return FW_OK;
}

fw_status fw_recipe_asrun_ask_at_once(fw_arena *arena, const fw_recipe_asrun *run,
                                      const fw_recipe_asrun_entry *e, fw_place place,
                                      fw_diags *diags) {
    const char *is, *allowed;
    FW_TRY(fw_recipe_asrun_too_many(arena, run, e, &is, &allowed));
    if (!is) return FW_OK;
    fw_diag_warning(
        diags, 659, place,
        "step %s: by their times %s were in one machine at once, and the step is planned "
        "for %s; give every wafer or load its own start and end, or the name of the "
        "machine that each was in (tool=), where there are several",
        e->step->id, is, allowed);
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- what a wafer waited ---- */

/* of one wafer, or one of them of the whole lot */
static bool shares_wafer(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b) {
    return !a->wafer || !b->wafer || strcmp(a->wafer, b->wafer) == 0;
}

void fw_recipe_put_wait_limits(fw_text *out, const fw_recipe_wait *wait) {
    fw_schedule_put_duration(out, wait->min_s);
    fw_text_add(out, isnan(wait->max_s) ? " or more" : " to ");
    if (!isnan(wait->max_s)) fw_schedule_put_duration(out, wait->max_s);
}

void fw_recipe_put_waited(fw_text *out, const fw_recipe_wait *wait) {
    const bool early = wait->waited_s < 0.0;
    fw_text_add(out, early ? "began " : "waited ");
    fw_schedule_put_duration(out, fabs(wait->waited_s));
    fw_text_printf(out, early ? " before %s ended" : " since %s", wait->since);
    if (wait->is && !early) fw_text_printf(out, ", %s", wait->is);
}

/* of which entry of the step the wafer came to e: the last one, which takes the place of those before; one that was run again
   after e is another run, where there was one for e already. NULL: it is not in the log */
static const fw_recipe_asrun_entry *came_from(const fw_recipe_asrun *run, const char *step,
                                              const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *from = NULL;
    for (const fw_recipe_asrun_entry *of = run->entry; of < run->entry + run->nentry; of++) {
        if (!of->step || strcmp(of->step->id, step) != 0 || fw_recipe_asrun_taken_back(run, of))
            continue;
        /* what is done without a wafer is done for each of them */
        if (!shares_wafer(of, e) && (of->wafer || !fw_process_step_is_of_lot(of->step))) continue;
        const bool again = from && of > e && of->start_s >= e->start_s;
        if (!again) from = of;
    }
    return from;
}

/* the step of the flow that the log has of this wafer before that of e; NULL: none, or e is beside the wafer */
static const fw_process_step *step_before(const fw_recipe_asrun *run,
                                          const fw_recipe_asrun_entry *e) {
    const fw_process_step *before = NULL;
    for (int i = 0; i < run->nentry && !is_beside(run->flow, e->step); i++) {
        const fw_recipe_asrun_entry *of = &run->entry[i];
        if (of->step && of->step < e->step && shares_wafer(of, e) &&
            !is_beside(run->flow, of->step) && (!before || of->step > before))
            before = of->step;
    }
    return before;
}

bool fw_recipe_asrun_left_out(const fw_recipe_asrun *run, const fw_process_step *step,
                              const char *wafer) {
    bool later = false;
    if (run->nentry == 0 || is_beside(run->flow, step)) return false;
    for (const fw_recipe_asrun_entry *e = run->entry; e < run->entry + run->nentry; e++) {
        if (!e->step || !is_of(e, wafer)) continue;
        if (e->step == step) return false;
        later = later || (e->step > step && !is_beside(run->flow, e->step));
    }
    return later;
}

/* of several loads in one entry, or in entries that share their time, one wafer is through while another is not */
static bool in_loads(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    int together;
    return fw_recipe_asrun_loads(run, e, &together) > 1.0;
}

static void wait_since(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                       fw_recipe_wait *wait) {
    const fw_recipe_asrun_entry *from = came_from(run, wait->since, e);
    wait->from = from;
    wait->waited_s = from ? e->start_s - from->end_s : (double)NAN;
    if (wait->waited_s < 0.0 && (in_loads(run, e) || in_loads(run, from)))
        wait->waited_s = (double)NAN;
    wait->fine = !(wait->waited_s < wait->min_s) && !(wait->waited_s > wait->max_s);
}

/* An earlier run of e's step ended the wait already, and is judged by it. From there on the wafer may wait as long again before
   it goes on; true: it did not wait longer */
static bool is_over(const fw_recipe_asrun *run, fw_recipe_wait *wait,
                    const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *before = wait->from ? fw_recipe_asrun_run_before(run, e) : NULL;
    if (!before || before->start_s < wait->from->end_s) return false;
    wait->since = e->step->id;
    wait->from = before;
    wait->min_s = 0.0, wait->waited_s = e->start_s - before->end_s;
    wait->fine = !(wait->waited_s > wait->max_s);
    return wait->fine;
}

/* A chamber is seasoned for the wafer that comes first: another one was in it before e */
static bool is_later_one(const fw_recipe_asrun *run, const fw_recipe_wait *wait,
                         const fw_recipe_asrun_entry *e) {
    for (const fw_recipe_asrun_entry *of = run->entry; of < run->entry + run->nentry; of++)
        if (of->step == e->step && !shares_wafer(of, e) && wait->from &&
            of->start_s >= wait->from->end_s && of->start_s < e->start_s)
            return true;
    return false;
}

/* what the flow says of the wafer's state, which this step ends; false: nothing, or not of this wafer */
static bool wait_in_state(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                          const fw_process_wait *w, fw_recipe_wait *wait) {
    if (&run->flow->step[w->to] != e->step) return false;
    *wait = (fw_recipe_wait){.since = run->flow->step[w->from].id, .is = w->is, .max_s = w->max_s};
    wait_since(run, e, wait);
    return !is_over(run, wait, e) && (!w->first_only || !is_later_one(run, wait, e));
}

bool fw_recipe_asrun_wait_stands(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                 const fw_recipe_wait *wait) {
    bool again = false;
    if (strcmp(wait->since, e->step->id) == 0) return true; /* between two of its runs */
    for (const fw_recipe_asrun_entry *later = e + 1; later < run->entry + run->nentry; later++)
        if (later->step == e->step && fw_recipe_asrun_run_before(run, later) == e) {
            if (came_from(run, wait->since, later) == wait->from) return true;
            again = true;
        }
    return !again && fw_recipe_asrun_is_last(run, e);
}

bool fw_recipe_asrun_wait(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, int *i,
                          fw_recipe_wait *wait) {
    const int nlag = e->step->nlag, nwait = run->flow->nwait;
    int k;
    while ((k = (*i)++) < nlag) {
        const fw_process_lag *lag = &e->step->lag[k];
        *wait = (fw_recipe_wait){
            .since = lag->from, .min_s = isnan(lag->min_s) ? 0.0 : lag->min_s, .max_s = lag->max_s};
        wait_since(run, e, wait);
        if (!is_over(run, wait, e)) return true;
    }
    for (int n = k - nlag; n < nwait; n++, (*i)++)
        if (wait_in_state(run, e, &run->flow->wait[n], wait)) return true;
    const fw_process_step *before = *i == nlag + nwait + 1 ? step_before(run, e) : NULL;
    if (!before) return false;
    *wait = (fw_recipe_wait){.since = before->id, .max_s = (double)NAN};
    for (int n = 0; n < nlag; n++) /* it has been told */
        if (strcmp(e->step->lag[n].from, before->id) == 0) return false;
    for (const fw_process_wait *w = run->flow->wait; w < run->flow->wait + nwait; w++)
        if (w->from == before - run->flow->step && w->to == e->step - run->flow->step) return false;
    wait_since(run, e, wait);
    return wait->waited_s < 0.0;
}

static fw_status ask_wait(const fw_recipe_asrun_entry *e, const fw_recipe_wait *wait,
                          fw_place place, fw_diags *diags) {
    fw_text text = fw_text_new(diags->arena);
    /* of one wafer at two steps at once ask_place has said it */
    if (e->start_s < wait->from->end_s && wait->from->start_s < e->end_s &&
        !fw_process_step_is_of_lot(e->step) && !fw_process_step_is_of_lot(wait->from->step))
        return FW_OK;
    fw_text_printf(&text, "step %s%s%s ", e->step->id, e->wafer ? " of wafer " : "",
                   e->wafer ? e->wafer : "");
    fw_recipe_put_waited(&text, wait);
    if (wait->waited_s < 0.0) {
        fw_text_printf(&text,
                       " (%s to %s), and comes after it: one of these times is wrong; an entry "
                       "with the right ones takes the place of the wrong one",
                       wait->from->start, wait->from->end);
    } else {
        fw_text_add(&text, ", and allowed is ");
        fw_recipe_put_wait_limits(&text, wait);
        fw_text_add(&text, "; look at what that leaves before the next step");
        fw_text_add(&text, e->deviation ? "" : ", and write down why (deviation=...)");
    }
    FW_TRY(fw_text_end(&text));
    fw_diag_warning(diags, 648, place, "%s", text.data);
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_recipe_asrun_ask_waits(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                    fw_place place, fw_diags *diags) {
    for (const fw_recipe_asrun_entry *of = run->entry; of <= e; of++) {
        int i = 0;
        if (!of->step || (of != e && !fw_recipe_asrun_is_last(run, of))) continue;
        for (fw_recipe_wait wait; fw_recipe_asrun_wait(run, of, &i, &wait);)
            if (!wait.fine && (of == e || wait.from == e))
                FW_TRY(ask_wait(of, &wait, place, diags));
    }
    return FW_OK;
}

bool fw_recipe_asrun_is_behind(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *o,
                               const fw_recipe_asrun_entry *e) {
    return o != e && o->step && e->step && o->step < e->step && is_of(o, e->wafer) &&
           o->start_s <= e->start_s && !fw_recipe_asrun_taken_back(run, o) &&
           fw_recipe_asrun_is_last(run, o) && !fw_recipe_asrun_overtaken(run, o, e->wafer);
}

/* ---- what a coupon was etched at ---- */

static void condition_of_run(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                             const char *rate, fw_process_condition which,
                             fw_process_measurement *row) {
    const fw_recipe_asrun_entry *of =
        NULL; /* the run; what is read later of it has its start, too */
    fw_quantity_unit unit;
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *o = &run->entry[i];
        if (o->step && fw_process_step_corrects(o->step, which, rate) && is_of(o, e->wafer) &&
            !fw_recipe_asrun_taken_back(run, o) && o->start_s <= e->start_s &&
            (!of || o->start_s > of->start_s))
            of = o;
    }
    for (int i = 0; of && i < run->nentry && !(row->condition[which] > 0.0); i++) {
        const fw_recipe_asrun_entry *o = &run->entry[run->nentry - 1 - i]; /* the last one counts */
        if (o->step != of->step || !is_of(o, of->wafer) || o->start_s != of->start_s) continue;
        for (int k = 0; k < o->nset; k++) {
            const fw_recipe_set *s = &o->set[k];
            if (!s->q || isnan(s->value) ||
                s->q != fw_process_step_corrects(o->step, which, rate) ||
                !fw_quantity_unit_parse(s->q->unit, strlen(s->q->unit), &unit, NULL, NULL))
                continue;
            row->condition[which] = fw_quantity_unit_to_si(&unit, s->value);
            unit.offset = 0.0;
            row->condition_uncertainty[which] =
                s->q->unknown
                    ? fw_quantity_unit_to_si(&unit, fw_process_written_uncertainty(s->text))
                    : s->q->uncertainty;
        }
    }
}

/* the temperature and the open area of a rate that was read in this entry and does not say them: what was set of the run that it
   is of, which is the last one of the wafer, by then, of a step whose law takes the rate; else they stay not said */
void fw_recipe_asrun_etched_at(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                               fw_process_measurement *row) {
    const char *rate = fw_process_coupon_rate(run->flow, row);
    for (int k = 0; rate && k < FW_CONDITIONS; k++)
        condition_of_run(run, e, rate, (fw_process_condition)k, row);
}
