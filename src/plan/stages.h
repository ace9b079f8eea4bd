/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the stages of the pipeline. Private to the room. */
#ifndef FW_PLAN_STAGES_H
#define FW_PLAN_STAGES_H
#include "base/output.h"
#include "plan/plan.h"

enum {
    FW_PLAN_FILE_MOST = 8 * 1024 * 1024
}; /* bytes of a description, pack, layer table or drawing */

/* FW_INPUT when the device names no material: what is judged or made needs one, a motion does
   not */
fw_status fw_plan_need_material(fw_plan *plan);
/* the description of a loaded plan read again with nset more settings, and its variants, in `arena`;
   what was read of packs is shared. FW_INPUT: they are not allowed; *said, where there is one, says why */
fw_status fw_plan_restated(const fw_plan *plan, fw_arena *arena, const fw_device_set *set, int nset,
                           fw_diags *said, const fw_device **device,
                           fw_verdict_variant_verdict *variant);
/* A loaded plan with other settings in place of its own, which must live as long as it: the description is
   read again, what was read of packs stays. *same false: it names other packs or materials, or has mistakes;
   the plan is of no further use then. */
fw_status fw_plan_load_again(fw_plan *plan, const fw_device_set *set, int nset, bool *same);
/* Another text of n bytes, which are copied, in place of the description of a plan that was read and nothing else, before
   fw_plan_load_again. *same false: files that are not the description are others by now, or something was said of them */
fw_status fw_plan_replace_source(fw_plan *plan, const char *xml, size_t n, bool *same);
/* have the packs and layer tables that a plan was read with the same bytes on disk? *same false also where it names drawings */
fw_status fw_plan_same_packs(const fw_plan *plan, bool *same);
void fw_plan_free_steps(fw_plan *plan); /* of a wafer's sweeps */
/* a description that names the same packs in place of the one before, and its variants of them */
fw_status fw_plan_take_device(fw_plan *plan, const fw_device *device);
/* the description's text read once more with other settings, and the drawings that it names */
fw_status fw_plan_device_again(fw_plan *plan, fw_arena *arena, const fw_device_set *set, int nset,
                               fw_diags *diags, const fw_device **device);
/* the variant of a flow, and what that may make of a device that is not drawn yet */
fw_status fw_plan_fabricated_of(fw_arena *arena, const fw_plan_flow *flow,
                                fw_verdict_variant_verdict *v);
/* the flow of a pack read once more, with the laboratory's values: to be changed by whoever asks */
fw_status fw_plan_flow_again(const fw_plan *plan, const fw_plan_flow *pf, fw_process_flow **flow);
/* a material as the flow has it: its own, or the shared one; NULL: there is none */
const fw_device_material *fw_plan_material(const fw_plan *plan, const fw_plan_flow *pf,
                                           const char *id);
/* warns of what <material> states and nothing goes by, and of a range that is gone with it (FW-D210, FW-D733) */
void fw_plan_look_at_material(fw_plan *plan, const fw_plan_flow *pf, const fw_device_material *m);
bool fw_plan_insulated(const fw_plan_flow *pf);
/* (nlayer of its table) what layers with shrink or grow get at every edge, m; FW_INPUT (FW-D411): not a known length */
fw_status fw_plan_layer_bias(fw_plan *plan, const fw_plan_flow *pf, const double **bias_m);
/* do the steps and plates of a flow and the rows of its layer table speak of the same plates and patterns?
   FW-D372, FW-D412, FW-D421 (plates.c) */
void fw_plan_check_table(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table);
/* what is below the device once the flow has freed it (plates.c) */
fw_status fw_plan_find_below(fw_plan *plan, const fw_plan_flow *pf, fw_mechanism_below *below);
fw_status fw_plan_find_ground(fw_plan *plan, const fw_plan_flow *pf, fw_mechanism_variant *v);
/* which expansions the device's scenes leave to the material and the substrate of the variant */
void fw_plan_find_heated(const fw_device *device, const char *flow, fw_mechanism_variant *variant);
/* how the flow dries it, and what of adhesion it knows (plates.c) */
fw_status fw_plan_find_drying(fw_plan *plan, const fw_plan_flow *pf, fw_mechanism_drying *drying);
/* is what moves over its hollow wherever it goes, and is the hollow as deep as the scenes' air? Reasons of the flow,
   FW-D422; once the verdict is there (plates.c) */
fw_status fw_plan_check_hollows(fw_plan *plan, const fw_plan_flow *pf, fw_diags *diags);
/* the plan's drawing, which is there, with the marks of a flow on its frame: found once. no_room may be NULL */
fw_status fw_plan_marked(fw_plan *plan, fw_plan_flow *pf, const fw_layout **marked,
                         fw_layout_no_room *no_room);
/* what the verdict computes edges with: of one die, with its distances where what the device loses goes by them */
fw_status fw_plan_edge_facts(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_plan_flow *pf, const fw_mechanism_variant *variant,
                             fw_process_mask_facts *facts);
/* areas, edges and openings of one die, from the exact outlines; layout NULL or not drawn: zeros. marked NULL: its
   marks are found here, else it has them */
fw_status fw_plan_mask_facts(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_layout *marked, const fw_mechanism_variant *variant,
                             const fw_mask_table *table, bool insulated,
                             fw_process_mask_facts *facts);
/* comb drives of the scenes that hold in a flow, each once: scenes may name the same one */
fw_status fw_plan_find_drives(fw_arena *arena, const fw_device *d, const char *flow,
                              fw_process_drive_facts **drive, int *n);
/* edges of the material: a joint is a cut between two pieces, not an edge */
double fw_plan_free_perimeter(const fw_geometry_contour *contour);
/* nets, contacts and gaps in a flow, once, and what they add to its judgement (plan_facts.c) */
fw_status fw_plan_wiring(fw_plan *plan, fw_plan_flow *pf);
/* after the verdict: which alternatives of the flow it does not accept for this device, and why */
fw_status fw_plan_judge_alternatives(fw_plan *plan, const fw_plan_flow *pf);
/* what a way of drying means for a device: find_drying for the flow's own */
fw_status fw_plan_drying_of(fw_plan *plan, const fw_plan_flow *pf, const fw_process_drying *of,
                            fw_mechanism_drying *drying);
/* FW-D507, where a laboratory states another thickness of the device than the description (plan_facts.c) */
void fw_plan_check_thickness(fw_plan *plan, const fw_plan_flow *pf);
/* what steps read off patterns that found no room on the test die: pf->coupons_lack */
fw_status fw_plan_coupons_unread(fw_plan *plan, fw_plan_flow *pf);
/* a warning where a frame has no room for marks that the flow's plates are put on each other by (FW-D619) */
fw_status fw_plan_say_no_room(fw_plan *plan, const fw_plan_flow *pf,
                              const fw_layout_no_room *no_room);
/* times, bias and judgement of every flow, from the exact outlines */
fw_status fw_plan_compute_flows(fw_plan *plan);
/* what measuring is worth, of the flows that the options name (plan_flows.c). written: for a
   recipe or a report that is about to be */
fw_status fw_plan_measurements_find(fw_plan *plan, bool written);
/* once the plate is laid out: currents and rates for what is really on it. What there is to say of
   the flow has been said. */
fw_status fw_plan_compute_wafers(fw_plan *plan);
/* masks and test dies of the flows, as fw_plan_fabricate says; and who does what when, of every
   flow that will be written */
fw_status fw_plan_masks(fw_plan *plan);
/* their first half, which belongs to the verdict: draws and examines the mask of every flow of a design that is not rejected */
fw_status fw_plan_masks_examine(fw_plan *plan);
/* of one flow; rejected: the mask says that the design is */
fw_status fw_plan_mask_examine(fw_plan *plan, fw_plan_flow *pf, bool rejected);
fw_status fw_plan_schedules(fw_plan *plan);

/* ---- steps of a wafer's sweeps ---- */
int fw_plan_sweep_steps(const fw_device_wafer_asked *asked);
/* the settings of a plan and those of step v behind them: of two for one parameter the last holds.
   value: of every sweep, SI */
fw_status fw_plan_sweep_settings(fw_plan *plan, int v, fw_device_set **set, double *value);
/* "step 2 (pitch = 300 um)" */
fw_status fw_plan_step_name(fw_plan *plan, int v, const char **name);
/* what all devices of a swept wafer hand to its flows together: load_again.c */
typedef struct fw_plan_swept {
    fw_process_mask_facts *of; /* (nflow) no area: nothing is drawn */
    double width_m, height_m;  /* of the largest die */
} fw_plan_swept;
/* plan->swept, NULL without a sweep; the plan of a step keeps what its wafer has */
fw_status fw_plan_find_swept(fw_plan *plan);
/* the facts of one of its devices become those that its flow is computed with; nothing without a sweep */
fw_status fw_plan_join_swept(const fw_plan *plan, fw_arena *arena, int flow,
                             fw_process_mask_facts *facts);
/* does it end the whole plan, not one step of it? */
bool fw_plan_is_final(fw_status status);
/* plan->dies, from what <wafer> asks for */
fw_status fw_plan_count_dies(fw_plan *plan);

fw_status fw_plan_hash(fw_plan *plan, const fw_text *text, const char **sha256);
/* once per plan, after judging */
fw_status fw_plan_assumptions(fw_plan *plan);
fw_report_input fw_plan_report_input(fw_plan *plan);
/* the named scene, else the first one that holds in a flow of this plan; NULL: said why not */
const fw_device_scene *fw_plan_scene(fw_plan *plan);
/* the mechanism in the variant that the scene (NULL: any) holds for, with its drawing in
   plan->layout where there is one */
fw_status fw_plan_mechanism(fw_plan *plan, const fw_device_scene *scene,
                            const fw_mechanism **mechanism);
fw_recipe_header fw_plan_recipe_header(const fw_plan *plan, const fw_plan_flow *pf);

/* *scene of the description, or where that is NULL the one asked for, else the first; its mechanism,
   drawn if possible. *scene becomes that of the mechanism */
fw_status fw_plan_start(fw_plan *plan, const fw_mechanism **mechanism,
                        const fw_device_scene **scene, double *moved_m);

#endif
