/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Process packs (XML in processes/), time laws and the computed flow. A number that is not known is
   `unknown`, and what needs it is NOT COMPUTABLE with the name of what is missing. */
#ifndef FW_PROCESS_PROCESS_H
#define FW_PROCESS_PROCESS_H
#include "base/json.h"
#include "device/material.h"
#include "process/fixed_point.h"
#include "quantity/quantity.h"
#include "release/release.h"
#include "verdict/verdict_fabrication.h"
#include <stdbool.h>
typedef struct fw_process_source {
    const char *id, *kind, *date, *text;
} fw_process_source;

typedef struct fw_process_hazard {
    const char *id, *name, *ghs, *ppe, *first_aid, *waste_stream, *waste;
    const char *reacts_as;     /* groups of reactivity.c, a blank between them; "": not said */
    unsigned reacts;           /* the same, a bit for each */
    const char **incompatible; /* (nincompatible) */
    const char **attacks;      /* (nattacks) materials that it dissolves or sputters */
    int nincompatible, nattacks;
    bool buddy; /* never alone: a step with it needs a second signature and first aid */
    bool wets;  /* a liquid: a wafer leaves it wet, and carries it along */
    fw_place place;
} fw_process_hazard;

typedef struct fw_process_equipment {
    const char *id, *class_, *text;
    int capacity;
    const char *takes;  /* groups of contaminants it may meet: "copper"; "" = none */
    const char *brings; /* ids of hazards of whatever is done there; "" = none */
    fw_place place;
    bool vacuum;              /* wafers lie in a pumped chamber */
    bool sees_back;           /* aligns to marks of the face that lies down, or below a layer */
    const fw_quantity *price; /* money per s; may be unknown */
} fw_process_equipment;

typedef struct fw_process_material { /* for the wafer's layer stack */
    const char *id, *name;
    const char *contaminates; /* group, "copper"; "" = none */
    bool holes;               /* a film that does not protect what is below it */
    int conducts;             /* metal can be plated on it: 1 yes, 0 no, -1: not said */
    const fw_quantity *highest_K, *density; /* temperature that it bears; NULL: not said */
    fw_place place;
} fw_process_material;

typedef enum fw_process_amount { /* what a consumable is counted in */
                                 FW_AMOUNT_L,
                                 FW_AMOUNT_kg,
                                 FW_AMOUNT_PIECE
} fw_process_amount;

typedef struct fw_process_consumable {
    const char *id, *name;
    fw_process_amount amount;
    const fw_process_hazard *hazard; /* NULL: none */
    const fw_quantity *price;        /* money per m3, per kg or for a piece; may be unknown */
    fw_place place;
} fw_process_consumable;

typedef struct fw_process_part { /* of a bath */
    const fw_process_consumable *of;
    const fw_quantity *q;      /* parts by volume; kg/m3 or mol/m3 of the bath, or share by mass */
    const fw_quantity *factor; /* molar mass of mol/m3, density of a share; NULL: none is needed */
} fw_process_part;

typedef struct fw_process_bath {
    const char *id, *name, *text;
    const fw_process_hazard *hazard; /* of the mixture */
    const fw_quantity *volume;       /* of one filling, m3; NULL: one part is stated */
    const fw_quantity *one_part;     /* m3; NULL */
    const fw_quantity *serves; /* wafers, one after the other; NULL: all of a lot in one step */
    const fw_quantity *keeps;  /* s, from when it was mixed on; NULL: not said */
    fw_process_part *part;     /* (npart) */
    int npart;
    fw_place place;
} fw_process_bath;

typedef enum fw_process_taker { FW_PER_WAFER, FW_PER_LOAD, FW_PER_LOT } fw_process_taker;

typedef struct fw_process_use { /* <uses>: one of bath and consumable */
    const fw_process_bath *bath;
    const fw_process_consumable *consumable;
    const fw_quantity *q; /* of the consumable */
    fw_process_taker per;
    fw_place place;
} fw_process_use;

typedef struct fw_process_align { /* of the mask that a step exposes */
    const char *to, *marks;
    bool back;
    const fw_quantity *overlay; /* m */
    fw_place place;
} fw_process_align;

typedef struct fw_process_argument {
    const char *name;
    const fw_quantity *q;
} fw_process_argument;

typedef struct fw_process_setting {
    const char *name;
    const fw_quantity *q;
    const char *tolerance_low, *tolerance_high; /* as written, unit of q; "" = none */
    fw_place place;
} fw_process_setting;

typedef struct fw_process_change {
    const char *kind, *material;  /* add remove convert pattern */
    const fw_quantity *thickness; /* may be NULL */
    /* "all", "structure" (what stays of the device), "field", a part of a plate */
    const char *where;
    bool spans;                    /* lies on the highest ground, hollows below it stay hollow */
    const char *from;              /* convert: the material that is turned into `material`; "" */
    bool back;                     /* on the back of the wafer */
    bool isotropic;                /* undercuts the mask by thickness (1 + overrun) per edge */
    const fw_quantity *anisotropy; /* of a masked etch, A = 1 - lateral/vertical; may be NULL */
    const fw_quantity *spread; /* of a plating, largest local thickness over mean; may be NULL */
    /* the change is made inside a circle of this diameter; may be NULL */
    const fw_quantity *across;
    const fw_quantity *reach; /* of a removal: so far sideways from every opening, below what stays;
                                 may be NULL */
    fw_process_face compensate; /* the face that the mask brings to where it is drawn */
    fw_place place;
} fw_process_change;

/* a material that the step's chemistry takes along, by either */
typedef struct fw_process_exposed {
    const char *material;
    const fw_quantity *rate; /* m/s; may be unknown, NULL */
    /* 1, of the etched material to this one; may be unknown, NULL */
    const fw_quantity *selectivity;
    bool uncovered; /* computed: bare only once what the step takes off is through */
    fw_place place;
} fw_process_exposed;

typedef struct fw_process_accept {
    const char *measure, *low, *high, *planned, *unit; /* planned: what a wafer as planned reads */
    const char *coupon;                                /* id of the pattern that is looked at; "" */
    int sites, every;
    fw_place place;
} fw_process_accept;

typedef struct fw_process_on_fail {
    const char *condition, *then, *go_to, *text;
} fw_process_on_fail;

typedef struct fw_process_lag {
    const char *from;
    double min_s, max_s; /* NaN = none */
    fw_place place;
} fw_process_lag;

/* <requires>: what must be true of the wafer before the step; one of step, material and state */
typedef struct fw_process_requirement {
    const char *step;     /* must have been done before; NULL */
    const char *material; /* is there, or is not; NULL */
    const char *where;    /* of the material: "all", "structure", "field" */
    const char *state;    /* key of wafer_states.def; NULL */
    bool present;
    fw_place place;
} fw_process_requirement;

/* <finish>: what is done at the same bench before the wafer leaves it */
typedef enum fw_process_finish_kind {
    FW_FINISH_RINSE,
    FW_FINISH_DRY,
    FW_FINISH_COOL,
    FW_FINISH_VENT
} fw_process_finish_kind;

typedef struct fw_process_finish {
    fw_process_finish_kind kind;
    const fw_process_hazard *with;      /* rinse: in what; NULL: deionised water */
    const char *by;                     /* dry: "spin", "nitrogen", "critical-point" ...; "" */
    const fw_quantity *tension, *angle; /* dry: of the meniscus, N/m and rad; NULL: not said */
    const fw_quantity *time;            /* NULL: within the step's own time */
    const char *text;                   /* "" */
    fw_place place;
} fw_process_finish;

/* how long a wafer may wait between two steps because of what it is like (wafer_state.c) */
typedef struct fw_process_wait {
    int from, to;         /* steps: end of the one, start of the other */
    double max_s, most_s; /* most_s: no pack can state more */
    const fw_quantity *q; /* where max_s is from; NULL: the program's own default, assumed */
    bool first_only;      /* of a lot that goes through one by one: for the first wafer */
    const char *is, *why; /* "wet with h.pan"; "it goes on etching, ..." */
} fw_process_wait;

/* <derive>: another law on the way, for orientation or as an input */
typedef struct fw_process_derive {
    const char *name, *unit, *law, *shape, *expression;
    fw_process_argument *argument; /* (nargument) */
    int nargument;
    fw_quantity_dimension dimension;
    fw_quantity *q; /* when it has an id: where the value goes, so that later laws can use it */
    const fw_quantity *most; /* above it the plan warns (FW-D279); may be NULL */
} fw_process_derive;

typedef struct fw_process_time { /* what a law returns */
    bool computable;
    double nominal_s, first_look_s, clear_by_s, stop_s;
    double relative_uncertainty;
    double slowed; /* nominal over the time of openings that do not lag; 1 without a lag */
    fw_quantity_value_status status;   /* worst of the inputs */
    fw_quantity_value_status u_status; /* worst of the uncertainties that count */
    const char **missing;              /* (nmissing) names of unknown inputs */
    int nmissing;
    const char **contribution; /* (ncontribution) "area 5 %", largest first */
    int ncontribution;
} fw_process_time;

typedef struct fw_process_step {
    const char *id, *op, *title, *purpose, *mask;
    const fw_process_equipment *equipment;
    bool in_source, parts, second_signature; /* parts: leaves="dies" */
    int batch;
    fw_process_change *change;
    fw_process_exposed *exposed;
    fw_process_setting *setting;
    const char *law, *expression;
    double overrun, k;
    const fw_quantity *overrun_from; /* NULL: overrun is a number of the pack */
    fw_process_argument *argument;
    const char **endpoint;
    fw_process_accept *accept;
    const fw_process_hazard **hazard;
    fw_process_on_fail *on_fail;
    fw_process_lag *lag;
    fw_process_finish *finish;        /* (nfinish) in their order */
    fw_process_requirement *required; /* (nrequired) */
    fw_process_use *use;              /* (nuse) */
    fw_process_align align;           /* to NULL: none */
    int nchange, nexposed, nsetting, nargument, nendpoint, naccept, nhazard, non_fail, nlag,
        nfinish, nrequired, nuse;
    fw_process_time time; /* computed */
    /* (nderived) computed on the way: current, charge, mass, rpm ... */
    const fw_quantity **derived;
    fw_place place;
    const char *shape; /* of the law: "slot", "cylinder", "linear" or "" */
    /* (nneed) inputs that must be known although the law does not take them */
    fw_process_argument *need;
    fw_process_derive *derive; /* (nderive) */
    int nneed, nderive, nderived;
    fw_quantity *planned; /* <time id>: the time with its over-etch goes there; NULL: none */
    double attended_s;    /* somebody must be there for this long; 0: unattended */
    double finish_s;      /* of all <finish>es; computed */
    const fw_quantity *pulse, *pause; /* done in parts with pauses between; NULL: at a stretch */
    const fw_quantity *bears; /* V that it drives the device with; NULL: it does not drive it */
    /* what the machine is taken for: the time of the law with the over-etch, the pauses, the finishes, and what handling
       takes beyond them (attended_s). Nominal, and at the stop time; 0 where the time is not computable */
    double booked_s, booked_stop_s;
    double booked_stop_own_s; /* the latter without what attendance takes beyond it */
} fw_process_step;

/* <finished>: what must be true of the wafer when the flow has ended */
typedef struct fw_process_finished {
    const char *material, *where; /* "all", "structure", "field" */
    bool present;
    fw_place place;
} fw_process_finished;

/* a text that names values between braces (process_find.c) */
typedef struct fw_process_text {
    const char **slot; /* where it is shown, filled in */
    const char *raw;
    fw_place place;
} fw_process_text;

typedef struct fw_process_override {    /* a value of the laboratory in the place of the pack's */
    const char *id, *was, *is, *source; /* "0.97 +- 0.02 (assumed)" */
    fw_quantity before;
} fw_process_override;

/* <with> of a laboratory pack: a value of the flow, as it was where calibrate found what the pack has */
typedef struct fw_process_was_with {
    const fw_quantity *q;
    double value;        /* SI; NaN: it was not known */
    const char *results; /* ids with blanks between */
    fw_place place;
} fw_process_was_with;

/* <tool> of a laboratory: when a machine may be used, or a stretch of days on which it may not */
typedef struct fw_process_tool_time {
    const char *equipment;
    const char *open, *days; /* "09:00-17:00"; "Mon Tue", "": every day; open NULL: it is closed */
    const char *from, *to;   /* dates, both included; NULL: open */
    fw_place place;
} fw_process_tool_time;

typedef struct fw_process_drying {
    fw_mechanism_dried how;
    const fw_process_step *step;
    const fw_process_finish *finish;
    const fw_quantity *tension, *angle;
} fw_process_drying;

typedef struct fw_process_alternative { /* another way of doing a step */
    const char *id, *title, *step;
    bool chosen;
    fw_process_drying
        drying; /* of the flow with it; zeroed where it is chosen. Its quantities: by id */
    const char *
        unfit; /* why the verdict does not accept it for this device; NULL: it does, or was not asked */
    const char *instead_of; /* title of the step whose place it took; NULL: not chosen */
    fw_place place;
} fw_process_alternative;

typedef struct fw_process_choice { /* of a laboratory */
    const char *alternative;
    fw_place place;
} fw_process_choice;

/* a step that this device does not need (only-with), so that the flow is run without it */
typedef struct fw_process_left_out {
    const char *id, *title;
    const char *before; /* the step that stood behind it; "": none did */
    const char *why;    /* "the device has no tethers" */
} fw_process_left_out;

/* a plate that the flow prints besides the device's: <plate>. Its parts of the wafer are named where changes say
   where; `within`: words of which all hold wherever the inside is */
typedef struct fw_process_plate {
    const char *id, *inside, *outside, *within;
    const fw_quantity *shrink; /* printed so much inside of what is drawn; NULL: as drawn */
    fw_place place;
} fw_process_plate;
enum { FW_PROCESS_PLATES = 2, FW_STACK_MOST = 8 }; /* 2 to the plates, the device's included */

typedef struct fw_process_flow {
    const char *id, *version, *title, *file, *sha256;
    const char *material;         /* id of the structural material */
    const fw_quantity *thickness; /* of the device layer */
    fw_process_source *source;
    fw_process_hazard *hazard;
    fw_process_equipment *equipment;
    fw_quantity **quantity;
    fw_process_step *step;
    int nsource, nhazard, nequipment, nquantity, nstep;
    double total_s;               /* sum over computable steps */
    int not_computable;           /* steps */
    fw_process_fixed_point edges; /* bias, time and gaps, solved together; computed */
    double bias_m;         /* edges.bias_m: what the mask adds to every drawn edge, known part */
    const char *bias_note; /* what is in it, and what is not known */
    bool insulating;       /* carrier="insulating" of the pack: what is not joined in the layer is
                              insulated */
    int manufacturable;    /* 1 yes, 0 no, -1 not guaranteed until something is measured */
    const char **reason;   /* (nreason) */
    int nreason;
    const char
        *fails; /* of them: why it cannot be made, else what does not come out right with what is
                          assumed; NULL: none is */
    fw_process_material *process_material; /* (nprocess_material) */
    fw_process_corner *corner;             /* (ncorner) */
    fw_process_finished *finished;         /* (nfinished) */
    /* (nopen_point) what the source leaves open; ids of the quantities that close it, NULL: none do */
    const char **open_point, **open_until;
    fw_process_consumable *consumable;   /* (nconsumable) */
    fw_process_bath *bath;               /* (nbath) */
    fw_process_alternative *alternative; /* (nalternative) */
    fw_process_left_out *left_out;       /* (nleft_out) in the order of the pack */
    fw_process_tool_time *tool_time;     /* (ntool_time) */
    int nalternative, nleft_out, ntool_time;
    fw_process_was_with *was_with; /* (nwas_with) */
    int nwas_with;
    int nprocess_material, nopen_point, ncorner, nfinished, nconsumable, nbath;
    int count[FW_ASSUMED + 1];     /* quantities that the steps use, by status */
    int unknown;                   /* ... and that are unknown */
    fw_process_override *override; /* (noverride) */
    int noverride;
    /* of what is refused, or not etched through: an opening, an anisotropy of the device's cut, an over-etch of it, a
       layer and a reach with which the whole flow refuses nothing; NaN: there is none. Known after
       fw_process_flow_compute. */
    double nearest_gap_m, nearest_anisotropy, nearest_overetch, nearest_layer_m, nearest_reach_m;
    bool nearest_known;
    bool nearest_undrawn, nearest_refused; /* nobody drew that opening anew; it was looked for */
    const char *nearest_fails; /* what refuses what the steps alone would take; NULL: nothing */
    /* the step in whose planned time an opening is not etched through, and the over-etch that this alone would take, in
       hundredths; -1: none */
    int behind;
    double behind_overetch;
    /* of the mask's facts; NULL: nothing is drawn, or no step frees anything */
    const fw_release *release;
    const fw_release_hold *hold; /* what holds each body meanwhile; NULL likewise */
    double release_foot_m;       /* how far the foot of the walls stands outside of what is drawn */
    /* how much farther the etch runs from a wide opening than from the one that its time is computed for: with
       the lag as it is known, and at the worst of its range; 1: no law has a lag */
    double release_wide, release_wide_most;
    bool release_lag_known; /* the law of its time knows how narrow openings fall behind */
    bool no_window;         /* what must stay is lost before all that moves is free */
    bool tight;             /* something on the mask prints in perfect contact only */
    fw_process_plate plate[FW_PROCESS_PLATES]; /* (nplate) in the order of printing */
    /* (ncolumn) what the columns of its stacks are: stack.c */
    unsigned column_code[FW_STACK_MOST];
    int nplate, ncolumn;
    fw_process_wait *wait; /* (nwait) computed */
    fw_process_text *text; /* (ntext) */
    int nwait, ntext;
    fw_place place;
} fw_process_flow;

typedef struct fw_process_mask_facts { /* what the mask hands to the flow */
    double structure_area_m2;          /* of one die: what is plated, or masked by aluminium */
    double die_area_m2;
    double perimeter_m, biased_perimeter_m;    /* all edges as drawn; those that the bias moves */
    double narrowest_slot_m, narrowest_line_m; /* as drawn; INFINITY: none */
    double deepest_hinge_width_m;              /* narrowest flexure, as drawn; 0: none */
    /* side of the largest square within a hollow below the device; 0: it has none */
    double widest_hollow_m;
    int pads; /* of one die, with metal for a wire; 0: it has none */
    int dies; /* on the wafer or coupon */
    /* of all that the wafer's plate places, test dies and alignment sites too; 0: so many times the die's own */
    double wafer_structure_m2, wafer_perimeter_m, wafer_biased_m;
    /* of the wafer itself, whose rim lies in a bath or a plasma as its dies do, and how far from its centre the outermost die reaches; 0: no wafer is laid out */
    double wafer_area_m2, wafer_diameter_m, wafer_reach_m;
    double device_thickness_m; /* as the device file wants it; 0 or NaN: the pack's own */
    /* (ngap) openings by name, as drawn; the narrowest slot need not be among them */
    const fw_process_mask_gap *gap;
    int ngap;
    /* distances from its openings, of a flow that releases it; NULL: nothing is drawn */
    const fw_release *release;
    const fw_release_hold *hold; /* what holds its bodies meanwhile; NULL: not looked for */
    const char *release_change;  /* what opens a window for it; NULL: not looked for */
    /* what the rules of the biased layers ask for on the mask; 0: nothing */
    double least_space_m, least_width_m;
    const fw_process_redraw *redraw; /* NULL: changes are judged by these facts alone */
} fw_process_mask_facts;

/* id of the quantity that a pack leaves to the fixed point: the narrowest opening in the layer that
   masks the etch, with the bias that the mask has */
#define FW_MASK_OPENING "mask.narrowest-opening"
/* ... and of where the printed edge lies against the drawn one */
#define FW_PROCESS_PRINTED_EDGE "litho.edge"

/* does a step etch sideways, below what stands? */
bool fw_process_flow_releases(const fw_process_flow *flow);
/* the step that does, and how far; NULL and NaN: none does, or nobody knows */
const fw_process_step *fw_process_flow_release_step(const fw_process_flow *flow, double *reach_m);
/* how far it has run, over-etch included, from the widest openings */
double fw_process_release_run(const fw_process_flow *flow, const fw_process_step *step,
                              double reach_m);
/* the window in a sentence, for a run sheet; NULL: the flow has no release, or nothing is drawn. FW_NOMEM */
fw_status fw_process_release_words(fw_arena *arena, const fw_process_flow *flow, const char **out);
/* member "release" of an open object: window, and every part with its reach */
void fw_process_release_json(const fw_process_flow *flow, fw_json *json);
/* which body lets go when, on what it hangs then, and the anchors: sentences; NULL likewise */
fw_status fw_process_hold_words(fw_arena *arena, const fw_process_flow *flow, const char **out);
/* is that etch to take its layer from below everything, frame and bases too (where="all")? */
bool fw_process_flow_frees_all(const fw_process_flow *flow);
/* share of its bond that what must stay has to keep, 0 where the pack does not say */
double fw_process_flow_bond(const fw_process_flow *flow);

typedef struct fw_process_drive_facts { /* a comb drive of a scene that holds in the flow */
    const char *id;
    double gap_m; /* as drawn */
    fw_place place;
} fw_process_drive_facts;

/* reads base.xml and FLOW.xml; all mistakes in diags */
fw_status fw_process_flow_read(fw_arena *arena, const char *base_file, const char *base_xml,
                               size_t base_n, const char *file, const char *xml, size_t n,
                               fw_diags *diags, fw_process_flow **flow);
/* the same with other ways of doing some steps (FW-D375), and without what only a device needs that has what this one
   `lacks` ("tethers"; NULL: it lacks nothing). FW-D590: nothing is left */
fw_status fw_process_flow_read_chosen(fw_arena *arena, const char *base_file, const char *base_xml,
                                      size_t base_n, const char *file, const char *xml, size_t n,
                                      const fw_process_choice *choice, int nchoice,
                                      const char *lacks, fw_diags *diags, fw_process_flow **flow);
/* the step with this id that the device does not need; NULL: there is none */
const fw_process_left_out *fw_process_flow_left_out(const fw_process_flow *flow, const char *id);
/* computes every step's time, the bias and the judgement from the mask's own numbers. May be called again with other facts.
   facts NULL or without any area: no mask yet, what needs it is NOT COMPUTABLE. */
fw_status fw_process_flow_compute(fw_arena *arena, fw_process_flow *flow,
                                  const fw_process_mask_facts *facts, fw_diags *diags);
/* after fw_process_flow_compute: adds to the judgement whether rotor and stator of the drives (n)
   are insulated from each other (the pack's carrier, or the device's own) and their gaps can be
   made. Warns with FW-D207 and FW-D208. */
fw_status fw_process_flow_judge_drives(fw_arena *arena, fw_process_flow *flow,
                                       bool insulating_carrier, const fw_process_drive_facts *drive,
                                       int n, fw_diags *diags);
/* the checks that look at values, once more: after a laboratory has replaced some */
fw_status fw_process_flow_lint_values(fw_arena *arena, fw_process_flow *flow, fw_diags *diags);
/* false and FW-D278 where the value makes no sense: outside least and most of q, its named range, or that of its
   dimension */
bool fw_process_quantity_in_range(const fw_quantity *q, fw_diags *diags);
/* range of a difference of two widths, which may be below 0; one is accepted: by its limits, or what they name */
#define FW_PROCESS_DIFFERENCE "difference"
bool fw_process_is_difference(const fw_process_flow *flow, const fw_process_accept *accept);
/* one reason more of the judgement. 0: the flow cannot make the device, said before all others; -1:
   not guaranteed, said behind them. `why` is kept. */
fw_status fw_process_flow_add_reason(fw_arena *arena, fw_process_flow *flow, int manufacturable,
                                     const char *why);
/* those from `from` on hold with all that is assumed: they are said before what is not known, the first of them in the
   headline where nothing else fails there. Nothing where the flow cannot make the device. */
void fw_process_flow_lead(fw_process_flow *flow, int from);
/* what the step etches isotropically inside of a plate (*at, which may be NULL): the depth of its hollows; NULL: none does */
const fw_quantity *fw_process_flow_hollow(const fw_process_flow *flow, const char *plate,
                                          const struct fw_process_step **at);
/* what is below the device once it is free: the depth of its hollow, or the thickness of what an etch takes away below it
   (NULL and *open: the layer is the wafer itself, etched through, and nothing is). NULL and not open: not known.
   *hollow, *material: which of both. Test: test_below.c */
const fw_quantity *fw_process_flow_gap(const fw_process_flow *flow, bool *open, bool *hollow,
                                       const char **material);
/* How devices that are free are dried: the finish that pulls hardest, or the last one that does not pull. FW_DRIED_NEVER:
   nothing wets them any more; UNKNOWN: the flow frees nothing. tension and angle of a meniscus, which may be NULL.
   Test: test_wafer_state.c */
fw_process_drying fw_process_flow_drying(const fw_process_flow *flow);
/* the range of a corner: lo to hi where the pack gives that, else two standard uncertainties either way; SI */
void fw_process_quantity_range(const fw_quantity *q, double *low, double *high);
const fw_quantity *fw_process_flow_quantity(const fw_process_flow *flow, const char *id);
/* does it expose the wafer's back? By its <align>, or by what it changes: a first plate has nothing to align to */
bool fw_process_step_on_back(const fw_process_step *step);
/* once for all wafers together, whatever the machine takes */
bool fw_process_step_is_of_lot(const fw_process_step *step);
/* do several runs of it on one wafer come to one longer run: is its time that of an amount? */
bool fw_process_step_adds_up(const fw_process_step *step);
/* does what it does go on for as long as a wafer is left in it: in a bath, under a current? */
bool fw_process_step_runs_on(const fw_process_step *step);
/* does it go on until somebody ends it: a bath that the wafer is taken out of, a current that is switched off? */
bool fw_process_step_is_ended(const fw_process_step *step);
/* does step `index` handle the dies of each wafer, because one before it parted them? */
bool fw_process_step_is_of_dies(const fw_process_flow *flow, int index);
/* is it measured on this wafer of the lot (from 0)? The first one, and every so many behind it */
bool fw_process_accept_is_due(const fw_process_accept *accept, int wafer);
/* most wafers that go through a step at once: what the pack and the machine both allow */
int fw_process_step_load(const fw_process_step *step);
/* or NULL */
const fw_process_material *fw_process_flow_material(const fw_process_flow *flow, const char *id);
/* the id when unknown */
const char *fw_process_flow_material_name(const fw_process_flow *flow, const char *id);

/* ---- what a flow makes of a device, for the verdict ---- */

/* the flow's <corner>s as independent inputs of a variant; those without any range are left out.
   What an etch takes sideways is that of the fixed point with these facts of the mask (NULL:
   nothing drawn), the same that fw_process_flow_compute gives the mask and the recipe. */
fw_status fw_process_flow_fabricated(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_process_mask_facts *facts,
                                     const fw_mechanism_variant *variant,
                                     const fw_verdict_fabrication_input **input, int *ninput);

/* ---- what a lot uses up, and what it costs where prices are given: bill.c ---- */

typedef struct fw_process_bill_bath {
    const fw_process_bath *bath;
    int fillings;        /* for the lot; 0: not known */
    double *part_amount; /* (bath->npart) of one filling, m3 or kg; NaN: not known */
    const char *steps;   /* "S14, S21" */
    const char *missing; /* names of what is not known; "" */
} fw_process_bill_bath;

typedef struct fw_process_bill_row {
    const fw_process_consumable *consumable;
    double amount; /* for the lot: m3, kg or pieces; NaN: not known */
    double cost;   /* in the bill's currency; NaN: not known */
    const char *steps;
    const char *missing; /* of the amount; "" */
} fw_process_bill_row;

typedef struct fw_process_bill_machine {
    const fw_process_equipment *equipment;
    double booked_s; /* of all loads; NaN: a step's time is not computable */
    double cost;
    const char *steps;
} fw_process_bill_machine;

typedef struct fw_process_bill {
    int wafers;
    fw_process_bill_bath *bath;       /* (nbath) in the order in which the steps meet them */
    fw_process_bill_row *row;         /* (nrow) */
    fw_process_bill_machine *machine; /* (nmachine) */
    int nbath, nrow, nmachine;
    const char *currency; /* "EUR"; NULL: no price is known */
    /* sums of what is known, and how many rows and machines they leave out */
    double consumables_cost, machines_cost;
    int rows_without, machines_without;
} fw_process_bill;

/* A bath with parts of volume v_i takes V v_i / sum v of the liquid i for a filling of volume V, and
   V c of what is weighed, c its mass per volume: as stated, amount per volume times molar mass, or share
   by mass times the bath's density. V is stated, or one part times the sum of parts. Fillings: one
   for every step that uses it, or ceil(wafers x steps / serves). A consumable of a step is taken once a
   wafer, once for each load, or once. Loads are those of a schedule (load, nstep, 0 where it has none of a step), or full ones,
   ceil(wafers / batch). Cost = amount x price, machine time = booked time x loads.
   flow: computed; wafers >= 1; load: NULL without a schedule. Amounts SI, nominal: uncertainties are not carried, since bottles are
   bought and not measured; mixing is taken as ideal (volumes add). Cost O(steps x consumables). Test: tests/unit/process/test_bill.c. */
/* fillings for so many wafers, or as many as a schedule mixes, if more (load, as below); 0: not known. The bath that a step mixes for the lot, whose volume it sets; NULL: none. How often
   a lot of so many needs that; 1 of other steps */
int fw_process_bath_fillings(const fw_process_flow *flow, const fw_process_bath *bath, int wafers,
                             const int *load);
const fw_process_bath *fw_process_step_mixes(const fw_process_flow *flow,
                                             const fw_process_step *step);
int fw_process_step_times(const fw_process_flow *flow, const fw_process_step *step, int wafers);
fw_status fw_process_flow_bill(fw_arena *arena, const fw_process_flow *flow, int wafers,
                               const int *load, fw_process_bill *bill);

#endif
