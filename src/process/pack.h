/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading a pack, asking of it what a schema cannot see, and judging whether its flow makes a device; private to process/. */
#ifndef FW_PROCESS_PACK_H
#define FW_PROCESS_PACK_H
#include "process/process.h"
#include "process/process_law.h"
#include "xml/xml_reader.h"

typedef enum fw_process_id_kind {
    FW_ID_SOURCE,
    FW_ID_MATERIAL,
    FW_ID_EQUIPMENT,
    FW_ID_HAZARD,
    FW_ID_QUANTITY,
    FW_ID_STEP,
    FW_ID_CONSUMABLE,
    FW_ID_BATH
} fw_process_id_kind;

typedef struct fw_process_id {
    const char *id;
    fw_process_id_kind kind;
    bool base; /* from base.xml */
    int order;
    void *item; /* the thing itself */
    fw_place place;
} fw_process_id;

typedef struct fw_process_pack {
    fw_arena *arena;
    fw_diags *diags;
    fw_process_flow *flow;
    const fw_xml_record *base, *root; /* records of base.xml and of the flow */
    fw_xml_source_text *source;       /* (nsource) flow's first, then base's */
    int nsource;
    fw_process_id *id; /* (nid) sorted once everything is collected */
    int nid;
    const char *lacks; /* what the device has none of; NULL: nothing */
} fw_process_pack;

/* process_read.c: both files as elements; the records of base.xml, or of the flow, checked against the table; and the flow
   of the records, as they stand. The last two are FW_OK although there may be mistakes in them. */
fw_status fw_process_pack_files(fw_xml_reader *base, const char *base_file, const char *base_xml,
                                size_t base_n, fw_xml_reader *own, const char *file,
                                const char *xml, size_t n);
fw_status fw_process_pack_records(fw_xml_reader *reader, bool is_base, const fw_xml_record **root);
fw_status fw_process_pack_flow(fw_process_pack *pack);

/* process_table.c */
extern const fw_xml_table fw_process_pack_table, fw_process_laboratory_table;

/* the thing with this id and kind; NULL and a diagnostic at the attribute when there is none */
void *fw_process_pack_find(fw_process_pack *pack, const fw_xml_attribute *attribute,
                           fw_process_id_kind kind);
const fw_xml_attribute *fw_process_pack_get(const fw_xml_record *e, const char *name);
const char *fw_process_pack_text(const fw_xml_record *e, const char *name); /* "" when absent */
/* "all" when absent */
const char *fw_process_pack_where(const fw_xml_record *e);
/* the quantity that an attribute names; NULL: none, or a diagnostic */
const fw_quantity *fw_process_pack_quantity(fw_process_pack *pack, const fw_xml_record *e,
                                            const char *name);
/* or wrong */
double fw_process_pack_number(const fw_xml_record *e, const char *name, double absent);

/* stack.c: <plate>s, and the words of every `where` (FW-D413) */
void fw_process_read_plates(fw_process_pack *pack);
void fw_process_check_regions(fw_process_pack *pack);

/* process_corners.c: the uncertainty of edges that isotropic etches leave, from what those are computed from; after the
   flow was read, and again when values were replaced */
fw_status fw_process_corners_follow(fw_arena *arena, fw_process_flow *flow);
/* process_corners.c: turns correlated inputs (n) into independent ones that make the same device */
fw_status fw_process_corners_independent(fw_arena *arena, fw_verdict_fabrication_input *input,
                                         int n);

/* the mask or a step computes it: no laboratory states it */
bool fw_process_quantity_computed(const fw_quantity *q);
/* what the law of a step's time takes under this name; NULL: nothing */
bool fw_process_step_sets(const fw_process_step *step, const fw_quantity *q);
const fw_quantity *fw_process_step_argument(const fw_process_step *step, const char *name);
/* the flow's quantity with this id, to be filled in; NULL: it has none */
fw_quantity *fw_process_flow_own_quantity(const fw_process_flow *flow, const char *id);

/* bill.c: baths and prices of both files, once all ids are known and before the steps; then what
   a step takes of them, and how its mask is aligned */
fw_status fw_process_pack_baths(fw_process_pack *pack);
void fw_process_pack_use(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *step);
void fw_process_pack_align(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *step);

fw_status fw_process_pack_steps(fw_process_pack *pack);
/* after the steps: keeps the texts that name values (FW-D348) */
fw_status fw_process_pack_texts(fw_process_pack *pack);
fw_status fw_process_flow_fill_texts(fw_arena *arena, fw_process_flow *flow, fw_diags *diags);
/* takes the share from its quantity, where it has one */
void fw_process_step_overrun(fw_process_step *step);
/* its derived values, its time and what it is booked for */
fw_status fw_process_step_compute(fw_arena *arena, fw_process_step *step);
/* one pass of fw_process_flow_compute */
fw_status fw_process_flow_compute_once(fw_arena *arena, fw_process_flow *flow,
                                       const fw_process_mask_facts *facts, fw_diags *diags);
/* <corner>s of the flow; mistakes are FW-D260 */
void fw_process_pack_corners(fw_process_pack *pack);

/* What a schema cannot see in a pack. Private to process/. A check is a function and a row in
   lint.c; those that need times and the mask run after the flow was computed. */

fw_status fw_process_pack_lint(fw_process_pack *pack);

/* what people and benches do: lint_bench.c (FW-D174, FW-D539, FW-D577 to FW-D579) */
fw_status fw_process_lint_people(fw_process_pack *pack);
fw_status fw_process_lint_hands(fw_process_pack *pack);
fw_status fw_process_lint_longest(fw_process_pack *pack);
fw_status fw_process_lint_lags(fw_process_pack *pack);
fw_status fw_process_lint_rinses(fw_process_pack *pack);
fw_status fw_process_lint_aired(fw_process_pack *pack); /* wafer_state.c (FW-D618) */
fw_status fw_process_lint_critical(fw_process_pack *pack);
fw_status fw_process_lint_lifted(fw_process_pack *pack);
fw_status fw_process_lint_baths(fw_process_pack *pack);
fw_status fw_process_lint_stock(fw_process_pack *pack);
/* why no step of its kind takes so long, or is over so soon; NULL: some do */
const char *fw_process_step_unkept(const fw_process_step *step, double time_s);

/* layers of the wafer, step by step (FW-D172, FW-D269, FW-D271 to FW-D275) */
fw_status fw_process_lint_absent(fw_process_pack *pack);
fw_status fw_process_lint_attacked(fw_process_pack *pack);
fw_status fw_process_lint_heat(fw_process_pack *pack);
fw_status fw_process_lint_parted(fw_process_pack *pack);
fw_status fw_process_lint_contamination(fw_process_pack *pack);
fw_status fw_process_lint_exposure(fw_process_pack *pack);
fw_status fw_process_lint_masking(fw_process_pack *pack);
fw_status fw_process_lint_through(fw_process_pack *pack);
/* masks one after the other (FW-D373) */
/* numbers, plate, tool and bath of its own: lint_inputs.c (FW-D373, FW-D559, FW-D561, FW-D606, FW-D608, FW-D609) */
fw_status fw_process_lint_inputs(fw_process_pack *pack);
fw_status fw_process_lint_places(fw_process_pack *pack);
fw_status fw_process_lint_wanted(fw_process_pack *pack); /* FW-D588, FW-D593, FW-D628, FW-D633 */
fw_status fw_process_lint_carried(fw_process_pack *pack);
fw_status fw_process_lint_plates(fw_process_pack *pack);
fw_status fw_process_lint_shrink(fw_process_pack *pack);
fw_status fw_process_lint_overlay(fw_process_pack *pack);
/* what is put on, sent back and accepted (FW-D614 to FW-D616) */
fw_status fw_process_lint_fresh(fw_process_pack *pack);
fw_status fw_process_lint_reworked(fw_process_pack *pack);
fw_status fw_process_lint_accepted(fw_process_pack *pack);
/* what is measured and undermined: lint_measured.c (FW-D623, FW-D624, FW-D634) */
fw_status fw_process_lint_measured(fw_process_pack *pack);
fw_status fw_process_lint_dust(fw_process_pack *pack);
/* the quantity that a limit "{=al.d*0.95}" names, and its text (raw, or NULL); NULL: it names none */
const fw_quantity *fw_process_limit_quantity(const fw_process_flow *flow, const char *const *limit,
                                             const char **raw);
fw_status fw_process_lint_undermined(fw_process_pack *pack);
/* hazards of what a step uses up (FW-D374) */
fw_status fw_process_lint_uses(fw_process_pack *pack);
/* after fw_process_flow_judge: does the flow reach every die of the wafer? */
fw_status fw_process_lint_wafer(fw_arena *arena, fw_process_flow *flow,
                                const fw_process_mask_facts *facts);
/* values (FW-D278, FW-D342, FW-D344) */
fw_status fw_process_lint_ranges(fw_process_pack *pack);
fw_status fw_process_lint_settings(fw_process_pack *pack);
/* FW-D342, FW-D533: is what is measured, and are its limits, in a unit, and in the same one? */
void fw_process_lint_unit(fw_process_pack *pack, const fw_process_step *s,
                          const fw_process_accept *a);
/* FW-D531: a measured value, or one in the place of `was` (NULL: of nothing), without an uncertainty */
void fw_process_warn_exact(const fw_quantity *q, const fw_quantity *was, fw_diags *diags);
fw_status fw_process_lint_prices(fw_process_pack *pack);
fw_status fw_process_lint_thicknesses(fw_process_pack *pack);
/* the wafer between steps (FW-D335 to FW-D341) */
fw_status fw_process_lint_states(fw_process_pack *pack);
fw_status fw_process_lint_reach(fw_process_pack *pack);
fw_status fw_process_lint_required(fw_process_pack *pack);
fw_status fw_process_lint_bakes(fw_process_pack *pack);
fw_status fw_process_lint_end(fw_process_pack *pack);
fw_status fw_process_lint_left(fw_process_pack *pack);
/* twice, or for another layer than lies there: lint_again.c (FW-D520 to FW-D527) */
fw_status fw_process_lint_again(fw_process_pack *pack);
fw_status fw_process_lint_coats(fw_process_pack *pack);
fw_status fw_process_lint_kind(fw_process_pack *pack);
fw_status fw_process_lint_baked(fw_process_pack *pack);
fw_status fw_process_lint_prepared(fw_process_pack *pack);
fw_status fw_process_lint_made(fw_process_pack *pack);
unsigned fw_process_reacts_as(const char *words); /* a bit for each group that is known */
/* what happens where the two meet, in words; NULL: nothing that is known, or one is NULL */
const char *fw_process_reaction(const fw_process_hazard *a, const fw_process_hazard *b);
fw_status fw_process_lint_reactivity(fw_process_pack *pack);
bool fw_process_only_dries(const fw_process_hazard *h);
fw_status fw_process_lint_warmth(fw_process_pack *pack);
fw_status fw_process_lint_chemistry(fw_process_pack *pack); /* reactivity.c (FW-D629, FW-D632) */
fw_status
fw_process_lint_meant(fw_process_pack *pack); /* reactivity.c (FW-D669, FW-D674, FW-D675) */
/* measurable.c (FW-D664, FW-D665) */
fw_status fw_process_lint_corners(fw_process_pack *pack);

/* what a step takes of a material that lies open, nominal and at two standard uncertainties; m, NaN
   when an input is not known */
double fw_process_exposed_loss(const fw_process_step *step, const fw_process_exposed *exposed,
                               double *most_m);

/* judge_etch.c: exposed materials that lie open only once their step is through, before losses are asked for; what is lost of
   a layer against what earlier steps left of it (FW-D270), and what a mould holds (FW-D273) */
fw_status fw_process_flow_uncover(fw_arena *arena, fw_process_flow *flow);
fw_status fw_process_lint_loss(fw_arena *arena, fw_process_flow *flow, int index,
                               const fw_process_exposed *exposed, fw_diags *diags);
fw_status fw_process_lint_mould(fw_arena *arena, fw_process_flow *flow, int index,
                                const fw_process_change *change, fw_diags *diags);

double fw_process_step_depth(const fw_process_step *step, double solved_m);
/* the relative uncertainty of what is lost at a rate, the step's own or another, in a time */
double fw_process_lost_uncertainty(bool own, double u_rate, double u_time);

/* after fw_process_flow_judge: adds to its reasons what the steps' times do to the layers, and
   derived values above their limits (FW-D270, FW-D273, FW-D279) */
fw_status fw_process_lint_computed(fw_arena *arena, fw_process_flow *flow, fw_diags *diags);

/* ---- what a wafer is like after every step ----
   Wet and with what, under resist that is not baked, hot, in a pumped chamber; and how long it may wait like that. Follows
   from the steps' operations, changes, chemicals and <finish>es alone, so that a pack cannot forget it. Theory:
   docs/theory/process.md, "What a wafer is like between steps". */

typedef enum fw_process_state {
#define X(name, key, longest, most, is, why) FW_STATE_##name,
#include "process/wafer_states.def"
#undef X
    FW_STATES
} fw_process_state;

typedef struct fw_process_wafer { /* after a step */
    bool is[FW_STATES];
    int since[FW_STATES];            /* index of the step that brought it about */
    const char *with[FW_STATES];     /* id of the chemical, resist or tool */
    const fw_process_hazard *liquid; /* WET: NULL is deionised water, or what no chemical names */
    bool released; /* compliant parts are free: a meniscus that dries pulls them down */
} fw_process_wafer;

/* of every step (nstep); pure */
fw_status fw_process_flow_wafers(fw_arena *arena, const fw_process_flow *flow,
                                 fw_process_wafer **wafer);
/* from one step on: *wafer is that before the step and becomes that after it */
void fw_process_wafer_pass(const fw_process_flow *flow, int step, fw_process_wafer *wafer);
/* fills in flow->wait, one for every state that a step brings about: when a flow was read, and again when values were
   replaced */
fw_status fw_process_flow_waits(fw_arena *arena, fw_process_flow *flow);
bool fw_process_step_is_op(const fw_process_step *step, const char *op);
/* what happens to a wafer that is left in the step: step_kinds.def */
typedef enum fw_process_goes_on {
    FW_GOES_ON_NOT,
    FW_GOES_ON_IN_BATH,
    FW_GOES_ON_UNDER_CURRENT
} fw_process_goes_on;
fw_process_goes_on fw_process_step_goes_on(const fw_process_step *step);
/* the last of its chemicals that wets; NULL: none does */
const fw_process_hazard *fw_process_step_liquid(const fw_process_step *step);
/* does the step work in a liquid? */
bool fw_process_step_in_liquid(const fw_process_step *step);
/* may a wet wafer come to the step? */
bool fw_process_step_takes_wet(const fw_process_step *step);
/* "wet with phosphoric acid bath (h.pan)" */
/* does a meniscus pass over what is dried this way? */
bool fw_process_drying_pulls(const char *by);
const char *fw_process_wafer_words(fw_arena *arena, const fw_process_flow *flow,
                                   const fw_process_wafer *wafer, fw_process_state state);
const char *fw_process_state_why(fw_process_state state);
const char *fw_process_state_key(fw_process_state state);
const char *fw_process_state_is(fw_process_state state); /* "wet with" */
double
fw_process_state_most_s(fw_process_state state); /* longer makes no sense whatever a pack says */

/* ---- can this flow make this device? ---- */

typedef enum fw_process_answer { FW_ANSWER_NO, FW_ANSWER_OPEN, FW_ANSWER_FINE } fw_process_answer;

typedef struct fw_process_judge {
    fw_arena *arena;
    fw_process_flow *flow;
    const fw_process_mask_facts *facts; /* may be NULL */
    fw_diags *diags;
    fw_text note;
    fw_process_answer verdict;
} fw_process_judge;

/* up to eight numbers of one sentence */
typedef struct fw_process_numbers {
    char text[8][32];
    int n;
} fw_process_numbers;
const char *fw_process_judge_number(fw_process_numbers *list, double value, int digits);
const char *fw_process_judge_um(fw_process_numbers *list, double value_m);
double fw_process_judge_known(const fw_quantity *q); /* NaN where it is not */

/* appends a reason; the verdict becomes no better than `weight` */
fw_status fw_process_judge_reason(fw_process_judge *j, fw_process_answer weight, const char *format,
                                  ...) __attribute__((format(printf, 3, 4)));
/* the reasons from `from` on come before all others, in their order */
void fw_process_judge_to_front(fw_process_flow *flow, int from);
/* what etches do to edges and gaps, from the fixed point (judge_etch.c) */
fw_status fw_process_judge_etching(fw_process_judge *j);

/* from the distances of the device's openings: the reach that frees it (judge_release.c) */
fw_status fw_process_judge_release(fw_process_judge *j);
/* is this a reach that the pack leaves to the mask? */
bool fw_process_release_solves(const fw_process_flow *flow, const fw_quantity *q);
/* fills the reaches that the pack leaves to the mask; after the edges are solved */
void fw_process_release_fill(fw_process_flow *flow, const fw_process_mask_facts *facts);

/* fills bias_note, manufacturable and reason. Edges and steps must have been computed. */
fw_status fw_process_flow_judge(fw_arena *arena, fw_process_flow *flow,
                                const fw_process_mask_facts *facts, fw_diags *diags);

/* What lateral etching does to a flexure, and how fine a mould can be printed. */

/* widths at the top and the bottom of a beam after an etch that lasts T = depth_equivalent/R */
void fw_process_undercut_widths(double width_m, double anisotropy, double depth_m, double etched_m,
                                double *top_m, double *bottom_m);
/* k/k0 of a trapezoidal section against a rectangle of width w0, bending in the wafer plane */
double fw_process_undercut_stiffness(double top_m, double bottom_m, double w0_m);
/* anisotropy at which the top edge of a beam is just cut through */
double fw_process_undercut_cut(double width_m, double etched_m);
/* smallest anisotropy that keeps k/k0 >= 1 - tolerance; straight: full undercut over the depth */
double fw_process_undercut_needed(double width_m, double depth_m, double etched_m, double tolerance,
                                  int straight);
/* smallest line or space, contact or proximity printing */
double fw_process_print_limit(double wavelength_m, double gap_m, double resist_m);

/* what change the whole flow was judged with and does not refuse, in words */
fw_status fw_process_judge_nearest(const fw_process_judge *j, const char **text);
/* ... of openings alone, or that none is enough; NULL: it was not looked for, of a flow that is not refused */
fw_status fw_process_judge_openings(const fw_process_judge *j, const char **text);

/* one pass of a flow for the facts of a mask: fw_process_flow_compute_once, given by who calls */
typedef fw_status fw_process_compute(fw_arena *arena, fw_process_flow *flow,
                                     const fw_process_mask_facts *facts, fw_diags *diags);
/* the changes with which the whole flow refuses nothing (flow->nearest_...), and the flow computed once more with them known */
fw_status fw_process_judge_changes(fw_arena *arena, fw_process_flow *flow,
                                   const fw_process_mask_facts *facts, fw_process_compute *compute);

#endif
