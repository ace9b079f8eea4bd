/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plan from its beginning to its end; and the description of a loaded one read again with other settings, where what
   was read of packs stays: those that are asked for, and those of the steps of a wafer's sweeps. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

fw_plan_options fw_plan_options_default(void) {
    return (fw_plan_options){
        .verdict = {.motion = {.accuracy = 1e-3, .samples = 1001}, .with_advice = true}};
}

fw_plan *fw_plan_new(const fw_plan_options *options) {
    fw_arena *arena = fw_arena_new(options->memory_cap);
    if (!arena) return NULL;
    fw_plan *plan = fw_arena_one(arena, fw_plan);
    if (!plan) {
        fw_arena_free(arena);
        return NULL;
    }
    *plan = (fw_plan){.arena = arena, .options = *options, .diags = fw_diags_new(arena)};
    return plan;
}

void fw_plan_free_steps(fw_plan *plan) {
    for (int i = 0; i < plan->nstep; i++)
        if (plan->step[i]) fw_arena_free(plan->step[i]->arena); /* steps have none of their own */
    plan->nstep = 0;
}

void fw_plan_free(fw_plan *plan) {
    if (!plan) return;
    fw_plan_free_steps(plan);
    fw_arena_free(plan->arena);
}

bool fw_plan_is_final(fw_status status) {
    return status == FW_NOMEM || status == FW_CANCELLED || status == FW_INTERNAL ||
           status == FW_IO || status == FW_USAGE;
}

/* ---- once more, with other settings ---- */

/* a plan of its own for messages and memory, over the packs of this one */
fw_status fw_plan_restated(const fw_plan *plan, fw_arena *arena, const fw_device_set *set, int nset,
                           fw_diags *said, const fw_device **device,
                           fw_verdict_variant_verdict *variant) {
    size_t n = (size_t)plan->options.nset, more = (size_t)nset;
    fw_device_set *sets = fw_arena_array(arena, fw_device_set, n + more);
    fw_plan_flow *flow = fw_arena_array(arena, fw_plan_flow, (size_t)plan->nflow);
    FW_NEED(sets && flow ? sets : NULL);
    if (n > 0) memcpy(sets, plan->options.set, n * sizeof *sets);
    if (nset > 0) memcpy(sets + n, set, more * sizeof *sets); /* of two for one the last holds */
    memcpy(flow, plan->flow, (size_t)plan->nflow * sizeof *flow);
    fw_plan other = *plan;
    fw_diags none = fw_diags_new(arena);
    if (!said) said = &none;
    other.arena = arena;
    other.flow = flow;
    FW_TRY(fw_plan_device_again(&other, arena, sets, plan->options.nset + nset, said, device));
    other.diags = *said;
    fw_status status = fw_plan_take_device(&other, *device);
    *said = other.diags;
    for (int i = 0; i < plan->nflow && status == FW_OK; i++)
        status = fw_plan_fabricated_of(arena, &flow[i], &variant[i]);
    return status;
}

/* of the same packs and materials, in the same order? */
static bool names_the_same(const fw_device *a, const fw_device *b) {
    bool same = a->nflow == b->nflow && a->die.tethers == b->die.tethers &&
                fw_text_same(a->material_ref, b->material_ref);
    for (int i = 0; same && i < a->nflow; i++)
        same = fw_text_same(a->flow[i].ref, b->flow[i].ref) &&
               fw_text_same(a->flow[i].material, b->flow[i].material);
    return same;
}

fw_status fw_plan_load_again(fw_plan *plan, const fw_device_set *set, int nset, bool *same) {
    const fw_device *device = NULL;
    fw_status status = fw_plan_device_again(plan, plan->arena, set, nset, &plan->diags, &device);
    *same = status == FW_OK && names_the_same(plan->device, device);
    plan->options.set = set, plan->options.nset = nset;
    if (*same && (device->nflow > 0 || device->material_ref))
        status = fw_plan_take_device(plan, device);
    else if (*same)
        plan->device = device;
    *same = *same && status == FW_OK;
    return fw_plan_is_final(status) ? status : FW_OK;
}

/* of the descriptions, diagnostics are said anew */
static bool said_of_others(const fw_plan *plan) {
    for (size_t i = 0; i < plan->diags.count; i++)
        if (!fw_text_same(plan->diags.item[i].place.file, plan->source_file)) return true;
    return false;
}

/* names of files in the data directory have a slash, and no other input has one */
fw_status fw_plan_same_packs(const fw_plan *plan, bool *same) {
    fw_mark mark = fw_arena_mark(plan->arena);
    fw_diags silent = fw_diags_new(plan->arena);
    *same = plan->ndrawing == 0;
    for (int i = 1; i < plan->ninput && *same; i++) {
        const fw_plan_input_file *input = &plan->input[i];
        const char *path;
        char *bytes, hash[65];
        size_t n;
        if (!strchr(input->name, '/')) continue;
        FW_TRY(fw_data_path(plan->arena, plan->options.data_directory, input->name, &path));
        *same = false;
        if (!path) break;
        fw_status status = fw_input_read(plan->arena, path, input->size, &silent, &bytes, &n);
        if (status == FW_NOMEM) return status;
        if (status != FW_OK || n != input->size) break;
        fw_sha256(bytes, n, hash);
        *same = strcmp(hash, input->sha256) == 0;
    }
    fw_arena_rewind(plan->arena, mark);
    return FW_OK;
}

fw_status fw_plan_replace_source(fw_plan *plan, const char *xml, size_t n, bool *same) {
    char *copy;
    *same = n <= FW_PLAN_FILE_MOST && !said_of_others(plan);
    if (*same) FW_TRY(fw_plan_same_packs(plan, same));
    if (!*same) return FW_OK;
    plan->diags = fw_diags_new(plan->arena);
    FW_NEED(copy = fw_arena_strndup(plan->arena, xml, n));
    plan->source = copy;
    plan->source_length = n;
    plan->input[0].size = n;
    const fw_text text = {.data = copy, .length = n};
    return fw_plan_hash(plan, &text, &plan->input[0].sha256);
}

/* ---- the steps of a wafer's sweeps, and how many dies there are with the largest of them ---- */

int fw_plan_sweep_steps(const fw_device_wafer_asked *w) {
    int n = 1;
    for (int k = 0; k < w->nsweep; k++)
        n *= w->sweep[k].steps;
    return n;
}

/* value of the sweep at step k, in its unit, as --set takes it */
static fw_status value_of(fw_arena *arena, const fw_device_sweep *s, int k, double *value,
                          const char **text) {
    fw_quantity_unit u = {.factor = 1};
    if (*s->unit) fw_quantity_unit_parse(s->unit, strlen(s->unit), &u, NULL, NULL);
    double from = fw_quantity_unit_from_si(&u, s->from), to = fw_quantity_unit_from_si(&u, s->to);
    char number[40];
    fw_number_text(number, sizeof number, from + (to - from) * k / (s->steps - 1), 12);
    double shown;
    if (!fw_number_parse(number, strlen(number), &shown)) return FW_INTERNAL;
    *value = fw_quantity_unit_to_si(&u, shown);
    FW_NEED(*text = fw_arena_printf(arena, "%s%s%s", number, *s->unit ? " " : "", s->unit));
    return FW_OK;
}

fw_status fw_plan_sweep_settings(fw_plan *plan, int v, fw_device_set **out, double *value) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    size_t n = (size_t)plan->options.nset;
    fw_device_set *set = fw_arena_array(plan->arena, fw_device_set, n + 2);
    FW_NEED(set);
    if (n > 0) memcpy(set, plan->options.set, n * sizeof *set);
    for (int k = 0, rest = v; k < w->nsweep; rest /= w->sweep[k++].steps) {
        const fw_device_sweep *s = &w->sweep[k];
        set[n + (size_t)k].path = plan->device->parameter[s->parameter].name;
        FW_TRY(value_of(plan->arena, s, rest % s->steps, &value[k], &set[n + (size_t)k].value));
    }
    *out = set;
    return FW_OK;
}

/* "step 2 (pitch = 300 um)" */
fw_status fw_plan_step_name(fw_plan *plan, int v, const char **name) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    fw_text text = fw_text_new(plan->arena);
    fw_device_set *set;
    double value[2];
    FW_TRY(fw_plan_sweep_settings(plan, v, &set, value));
    fw_text_printf(&text, "step %d (", v + 1);
    for (int k = 0; k < w->nsweep; k++)
        fw_text_printf(&text, "%s%.60s = %s", k ? ", " : "", set[plan->options.nset + k].path,
                       set[plan->options.nset + k].value);
    fw_text_add(&text, ")");
    FW_TRY(fw_text_end(&text));
    *name = text.data;
    return FW_OK;
}

/* ---- what the devices of a swept wafer hand to a flow together ----
   They lie in one bath and one plasma, and one bias is on their plate. So every one of them is computed with the narrowest
   opening and line of all, the mean of their areas and edges, and of a release with the farthest that any of them needs
   and the least that any of them bears. The device of the description is one of them: it stands in for a step that has no
   mask, and has a mask of its own. Theory: docs/theory/wafer.md. Test: test_swept.c. */

typedef struct of_flow { /* as it is gathered */
    fw_process_mask_facts facts;
    fw_release release;
    int n;
} of_flow;

/* of every opening by its name the narrowest of all devices, as "gap of hinge A of step 1 (w = 3 um)" */
static fw_status add_gaps(fw_plan *plan, const char *name, const fw_process_mask_facts *f,
                          fw_process_mask_facts *all) {
    const size_t n = (size_t)all->ngap, more = n + (size_t)f->ngap;
    fw_process_mask_gap *gap = fw_arena_grow(plan->arena, all->gap, n, more, sizeof *gap);
    FW_NEED(gap);
    all->gap = gap;
    for (int i = 0; i < f->ngap; i++) {
        const size_t length = strlen(f->gap[i].name);
        int at = 0;
        while (at < all->ngap && (strncmp(gap[at].name, f->gap[i].name, length) != 0 ||
                                  strncmp(gap[at].name + length, " of ", 4) != 0))
            at++;
        if (at < all->ngap && gap[at].gap_m <= f->gap[i].gap_m) continue;
        gap[at] = f->gap[i];
        FW_NEED(gap[at].name = fw_arena_printf(plan->arena, "%s of %s", f->gap[i].name, name));
        if (at == all->ngap) all->ngap++;
    }
    return FW_OK;
}

/* what may be lost, and of what moves the part that is free last */
static fw_status add_release(fw_plan *plan, const char *name, const fw_release *r, fw_release *to) {
    const size_t n = (size_t)to->npart;
    FW_NEED(to->part =
                fw_arena_grow(plan->arena, to->part, n, n + (size_t)r->npart, sizeof *to->part));
    for (int i = 0; i < r->npart; i++) {
        if (r->part[i].duty == FW_RELEASE_MOVES && i != r->slowest) continue;
        fw_release_part *p = &to->part[to->npart];
        *p = r->part[i];
        FW_NEED(p->label = fw_arena_printf(plan->arena, "%s of %s", p->label ? p->label : "a piece",
                                           name));
        if (i == r->slowest && !(to->needed_m >= r->needed_m))
            to->slowest = to->npart, to->needed_m = r->needed_m;
        if (i == r->weakest && !(to->lost_m <= r->lost_m))
            to->weakest = to->npart, to->lost_m = r->lost_m;
        to->npart++;
    }
    to->share = r->share;
    return FW_OK;
}

/* one drawing in one flow; marked: with the marks of the flow */
static fw_status add_to_flow(fw_plan *plan, fw_arena *scratch, const char *name,
                             const fw_device *device, const fw_layout *layout,
                             const fw_mechanism_variant *variant, const fw_plan_flow *pf,
                             of_flow *to) {
    const fw_layout *marked;
    fw_layout_no_room no_room;
    fw_process_mask_facts f, *all = &to->facts;
    const fw_release *r;
    const bool insulated = fw_plan_insulated(pf);
    FW_TRY(fw_mask_frame_marks(scratch, pf->table, layout, &marked, &no_room));
    FW_TRY(fw_plan_mask_facts(scratch, device, layout, marked, variant, pf->table, insulated, &f));
    to->n++;
    all->structure_area_m2 += f.structure_area_m2;
    all->die_area_m2 += f.die_area_m2;
    all->perimeter_m += f.perimeter_m;
    all->biased_perimeter_m += f.biased_perimeter_m;
    all->narrowest_slot_m = fmin(all->narrowest_slot_m, f.narrowest_slot_m);
    all->narrowest_line_m = fmin(all->narrowest_line_m, f.narrowest_line_m);
    all->deepest_hinge_width_m = fmin(all->deepest_hinge_width_m, f.deepest_hinge_width_m);
    FW_TRY(add_gaps(plan, name, &f, all));
    if (!fw_process_flow_releases(pf->flow)) return FW_OK;
    FW_TRY(fw_release_solve(scratch, marked, insulated, fw_process_flow_frees_all(pf->flow),
                            fw_process_flow_bond(pf->flow), &r));
    return add_release(plan, name, r, &to->release);
}

/* a device as far as it can be drawn; what is wrong with it is said when it is planned */
static fw_status add_device(fw_plan *plan, fw_arena *scratch, const char *name,
                            const fw_device *device, const fw_verdict_variant_verdict *variant,
                            of_flow *of, fw_plan_swept *swept) {
    fw_diags silent = fw_diags_new(scratch);
    const fw_layout *layout = NULL;
    fw_status status = fw_layout_build(scratch, device, &silent, &layout);
    if (status == FW_GEOMETRY || status == FW_INPUT) return FW_OK;
    FW_TRY(status);
    if (!layout->drawn) return FW_OK;
    swept->width_m = fmax(swept->width_m, layout->die.x1 - layout->die.x0);
    swept->height_m = fmax(swept->height_m, layout->die.y1 - layout->die.y0);
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].flow && plan->flow[i].table)
            FW_TRY(add_to_flow(plan, scratch, name, device, layout,
                               variant ? variant[i].variant : &plan->flow[i].variant,
                               &plan->flow[i], &of[i]));
    return FW_OK;
}

static fw_status add_step(fw_plan *plan, fw_arena *scratch, int v, of_flow *of,
                          fw_plan_swept *swept) {
    const fw_device *device = NULL;
    const char *name;
    fw_device_set *set;
    double value[2];
    fw_verdict_variant_verdict *variant =
        fw_arena_array(scratch, fw_verdict_variant_verdict, (size_t)plan->nflow);
    FW_NEED(variant);
    FW_TRY(fw_plan_step_name(plan, v, &name));
    FW_TRY(fw_plan_sweep_settings(plan, v, &set, value));
    fw_status status = fw_plan_restated(plan, scratch, set + plan->options.nset,
                                        plan->device->wafer.nsweep, NULL, &device, variant);
    if (status == FW_OK) status = add_device(plan, scratch, name, device, variant, of, swept);
    return fw_plan_is_final(status) ? status : FW_OK;
}

static fw_status finish(fw_plan *plan, const of_flow *of, fw_plan_swept *swept) {
    for (int i = 0; i < plan->nflow; i++) {
        fw_process_mask_facts *f = &swept->of[i];
        fw_release *release = fw_arena_one(plan->arena, fw_release);
        const double share = of[i].n > 0 ? 1.0 / of[i].n : 0.0;
        FW_NEED(release);
        *release = of[i].release;
        *f = of[i].facts;
        f->structure_area_m2 *= share, f->die_area_m2 *= share;
        f->perimeter_m *= share, f->biased_perimeter_m *= share;
        if (release->npart > 0) f->release = release;
        if (release->slowest < 0 || release->weakest < 0) continue;
        FW_NEED(
            f->release_change = fw_arena_printf(
                plan->arena,
                "leave what comes free so late or holds so little out of the <sweep>, or give %s "
                "closer openings (release-pitch) or %s more to hold by",
                release->part[release->slowest].label, release->part[release->weakest].label));
    }
    return FW_OK;
}

fw_status fw_plan_find_swept(fw_plan *plan) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    if (plan->options.dies > 0) return FW_OK; /* a step: its plan has those of the whole wafer */
    plan->swept = NULL;
    if (!w->asked || w->nsweep == 0) return FW_OK;
    fw_plan_swept *swept = fw_arena_one(plan->arena, fw_plan_swept);
    of_flow *of = fw_arena_array(plan->arena, of_flow, (size_t)plan->nflow);
    FW_NEED(swept && of ? of : NULL);
    FW_NEED(swept->of = fw_arena_array(plan->arena, fw_process_mask_facts, (size_t)plan->nflow));
    for (int i = 0; i < plan->nflow; i++) {
        of[i].facts.narrowest_slot_m = of[i].facts.narrowest_line_m =
            of[i].facts.deepest_hinge_width_m = (double)INFINITY;
        of[i].release = (fw_release){
            .slowest = -1, .weakest = -1, .needed_m = (double)NAN, .lost_m = (double)NAN};
    }
    fw_arena *scratch = fw_arena_part(plan->arena, plan->options.memory_cap);
    FW_NEED(scratch);
    fw_mark empty = fw_arena_mark(scratch);
    fw_status status =
        add_device(plan, scratch, "the device of the description", plan->device, NULL, of, swept);
    for (int v = 0; v < fw_plan_sweep_steps(w) && status == FW_OK; v++) {
        fw_arena_rewind(scratch, empty);
        status = add_step(plan, scratch, v, of, swept);
    }
    fw_arena_free(scratch);
    FW_TRY(status);
    plan->swept = swept;
    return finish(plan, of, swept);
}

static fw_status join_releases(fw_arena *arena, const fw_release *all, const fw_release **own) {
    const fw_release *r = *own;
    fw_release *both = fw_arena_one(arena, fw_release);
    FW_NEED(both);
    *both = *r;
    FW_NEED(both->part = fw_arena_array(arena, fw_release_part, (size_t)(r->npart + all->npart)));
    memcpy(both->part, r->part, (size_t)r->npart * sizeof *r->part);
    memcpy(both->part + r->npart, all->part, (size_t)all->npart * sizeof *r->part);
    both->npart = r->npart + all->npart;
    if (all->slowest >= 0 && !(r->needed_m >= all->needed_m))
        both->slowest = r->npart + all->slowest, both->needed_m = all->needed_m;
    if (all->weakest >= 0 && !(r->lost_m <= all->lost_m))
        both->weakest = r->npart + all->weakest, both->lost_m = all->lost_m;
    *own = both;
    return FW_OK;
}

fw_status fw_plan_join_swept(const fw_plan *plan, fw_arena *arena, int flow,
                             fw_process_mask_facts *facts) {
    const fw_process_mask_facts *all = plan->swept ? &plan->swept->of[flow] : NULL;
    if (!all || !(all->die_area_m2 > 0.0) || !(facts->die_area_m2 > 0.0)) return FW_OK;
    const int ngap = facts->ngap + all->ngap;
    fw_process_mask_gap *gap = fw_arena_array(arena, fw_process_mask_gap, (size_t)ngap + 1);
    FW_NEED(gap);
    for (int i = 0; i < ngap; i++)
        gap[i] = i < facts->ngap ? facts->gap[i] : all->gap[i - facts->ngap];
    facts->gap = gap, facts->ngap = ngap;
    facts->structure_area_m2 = all->structure_area_m2, facts->die_area_m2 = all->die_area_m2;
    facts->perimeter_m = all->perimeter_m, facts->biased_perimeter_m = all->biased_perimeter_m;
    facts->narrowest_slot_m = fmin(facts->narrowest_slot_m, all->narrowest_slot_m);
    facts->narrowest_line_m = fmin(facts->narrowest_line_m, all->narrowest_line_m);
    facts->deepest_hinge_width_m = fmin(facts->deepest_hinge_width_m, all->deepest_hinge_width_m);
    facts->release_change = all->release_change ? all->release_change : facts->release_change;
    return facts->release && all->release ? join_releases(arena, all->release, &facts->release)
                                          : FW_OK;
}

fw_status fw_plan_count_dies(fw_plan *plan) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    plan->dies = plan->options.dies > 0 ? plan->options.dies : 1;
    if (plan->options.dies > 0 || !w->asked || !plan->layout || !plan->layout->drawn) return FW_OK;
    if (!plan->swept) FW_TRY(fw_plan_find_swept(plan));
    fw_arena *scratch = fw_arena_part(plan->arena, plan->options.memory_cap);
    FW_NEED(scratch);
    fw_geometry_box die = plan->layout->die;
    if (plan->swept) {
        die.x1 = fmax(die.x1, die.x0 + plan->swept->width_m);
        die.y1 = fmax(die.y1, die.y0 + plan->swept->height_m);
    }
    fw_status status = fw_wafer_dies(scratch, w, die, &plan->dies);
    fw_arena_free(scratch);
    if (plan->dies == 0) plan->dies = 1; /* why, the wafer says */
    return status;
}
