/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pipeline: description -> model -> motion -> verdict -> layout -> masks -> process -> recipe
   -> report. One plan owns everything it computed until it is freed; plans do not share state.

   Usage: fw_plan_new, fw_plan_load, then fw_plan_judge and what is wanted of fw_plan_fabricate and
   fw_plan_write. Every stage returns FW_OK or what went wrong; diagnostics are in its `diags`. */
#ifndef FW_PLAN_PLAN_H
#define FW_PLAN_PLAN_H
#include "assembly/assembly.h"
#include "flexure/finite.h"
#include "statics/statics.h"
#include "measuring/measuring.h"
#include "wafer/wafer.h"
#include "report/report.h"
#include "recipe/recipe.h"
#include "schedule/schedule.h"

/* of which flows it is computed what measuring is worth, and how closely */
typedef enum fw_plan_measurements {
    /* bands of undecided ones where advice is sought; else, where recipe or report is written, first
       order */
    FW_MEASUREMENTS_AUTO,
    FW_MEASUREMENTS_ALL, /* bands of all */
    FW_MEASUREMENTS_NONE
} fw_plan_measurements;

typedef struct fw_plan_lab_text { /* a laboratory pack in memory; messages name it so */
    const char *name, *text;
    size_t n;
} fw_plan_lab_text;

enum { FW_PLAN_CORNER = 96 }; /* bytes of a corner's text (fw_plan_corner_text) */
typedef struct fw_plan_options {
    const char *data_directory; /* packs and layer tables; NULL: installed, else source tree */
    const char *flow;           /* only this flow; NULL: all of the device */
    const char *scene;          /* for simulate; NULL: the first */
    fw_verdict_options verdict; /* motion, accuracy, effects */
    double mask_tolerance_m;    /* 0: 5 nm */
    const char *mask_formats;   /* fw_mask_formats; NULL: the usual ones */
    int mask_vertices;          /* most of one GDSII boundary; 0: 4094 */
    const char *mask_flatten;   /* fw_mask_flattening_named; NULL: "inside" */
    const fw_device_set *set;   /* (nset) */
    int nset;
    bool force;       /* masks and recipes of a rejected design too */
    bool drawn_alone; /* masks of the device alone: no test die, no wafer, no schedule */
    bool
        without_masks; /* the verdict does not ask whether masks can be drawn: for studies of hinges alone */
    bool without_changes; /* nobody reads what would be made in place of what a flow refuses */
    int dies; /* above 0: this is one device of a wafer of so many; <wafer> is left alone */
    bool at_equilibrium; /* modes: not about rest */
    bool path;           /* statics: follow the load path */
    /* for assemble: "AB.phi,BC.phi", "10 rad/s,0 rad/s", "0 rad/s^2,..."; NULL: chosen, 0, 0 */
    const char *independent, *rates, *accelerations;
    const char *laboratory;           /* files of laboratory packs, commas between; NULL: none */
    const fw_plan_lab_text *lab_text; /* (nlab_text) packs that are no files, behind those */
    int nlab_text;
    fw_schedule_options schedule; /* wafers, operators, working day */
    size_t memory_cap;            /* 0: 512 MiB */
    const char *cut; /* of the sections: "x1,y1,x2,y2" or "flexure:ID"; NULL: the narrowest gap */
    fw_plan_measurements measurements;
    const char *layers; /* file of the laboratory's layer numbers (mask/mask_parts.h); NULL: none */
    const char *directory; /* of drawings, for fw_plan_load_memory; NULL: none are opened */
    fw_json_wanted wanted; /* of the verdict's JSON, what somebody reads; member NULL: all */
    /* (nwatched) the only corners that devices as made are judged at (fw_plan_corner_text); 0: as verdict.corners says */
    const char (*watched)[FW_PLAN_CORNER];
    int nwatched;
} fw_plan_options;
fw_plan_options fw_plan_options_default(void);

typedef struct fw_plan_flow { /* one variant and, when it is a flow, its pack, mask and recipe */
    const fw_device_flow_use *use; /* NULL: the device's own material without a flow */
    fw_mechanism_variant variant;
    fw_process_flow *flow;         /* NULL: none */
    fw_device_materials materials; /* as the flow has them; none without a flow */
    fw_mask_table *table;          /* with rows for cells on layers of their own */
    bool mask_examined;            /* mask, violated and mask_error say what the rules say */
    const fw_mask *mask;
    const fw_mask *violated; /* the mask where it breaks rules or nearly does, to look at; NULL: it
                                has no findings */
    fw_text gds;             /* of the mask, composed once: its hash is in recipe and certificate */
    const char *mask_error;
    const char *flow_sha256, *mask_sha256;
    const fw_mask_coupons *coupons; /* test die; NULL: the table has none, or it has no room */
    fw_text coupons_gds;
    const char *coupons_sha256;
    const char *coupons_lack; /* "slots (D11), cd (D08)": read by steps, and without room; NULL */
    const fw_wafer *wafer;    /* NULL: none asked for, or no mask */
    /* of its sweep, what is judged worse than the description; NULL: nothing is. "342 of 514 dies are inconclusive in FLOW" */
    const char *dies, *dies_count;
    fw_verdict_decision dies_decision; /* of the worst of them; where dies is not NULL */
    const fw_wafer *single; /* without <wafer>, but with <order>: the plate of one die; else NULL */
    fw_text wafer_gds;      /* composed once, as above */
    const char *wafer_sha256;
    const fw_schedule *schedule; /* after fw_plan_fabricate; NULL: none was made */
    const fw_recipe_cut *cut;    /* the same; NULL: there is nothing to cut */
    const char *file, *xml;      /* the pack as read */
    size_t xml_length;
    const fw_measuring *measuring; /* NULL: not asked for */
    const fw_wafer *measured_on;   /* whose times it is about; NULL: those of the die alone */
    const char *release_change;    /* what opens a window for it; NULL: it has one */
    /* after judging; NULL: nothing is drawn, or the flow frees nothing */
    const fw_release *release;
    const fw_release_hold *hold; /* the same: what its bodies hang on meanwhile */
    /* what breaks them; NULL: there are none, or nothing is judged */
    const fw_statics_tethers *tethers;
    const fw_wiring *wiring; /* after judging; NULL: nothing is drawn */
    /* the plan's drawing with the marks of this flow, and those without room (fw_plan_marked); of which drawing */
    const fw_layout *marked, *marked_of;
    const struct fw_layout_no_room *no_room;
    fw_text release_svg; /* its picture as a fragment, composed once; empty: none */
} fw_plan_flow;

typedef struct fw_plan_input_file { /* for the manifest */
    const char *name, *sha256;
    size_t size;
} fw_plan_input_file;

typedef struct fw_plan {
    fw_arena *arena;
    fw_plan_options options;
    fw_diags diags;
    const char *source_file, *source; /* the device file as read, for carets */
    size_t source_length;
    const fw_device *device;
    fw_device_materials materials;
    fw_plan_flow *flow; /* (nflow) at least one after fw_plan_load */
    int nflow;
    const fw_layout *layout; /* NULL or with faults: it cannot be made */
    struct {                 /* what a scene started from last (fw_plan_start) */
        const fw_device_scene *scene;
        const fw_mechanism *mechanism; /* NULL: none did */
        double moved_m;
    } start;
    int dies; /* made at once; 1 without a wafer */
    fw_verdict verdict;
    const char **because; /* (nbecause) why it is rejected */
    int nbecause;
    const fw_verdict_from_outside *outside; /* (noutside) what it needs and the masks do not have */
    int noutside;
    const char **assumption; /* (nassumption) */
    int nassumption, assumption_capacity;
    int files_written; /* by the last fw_plan_write, the manifest not counted; 0: no directory made
                        */
    fw_plan_input_file input[64];
    int ninput;
    const char *directory; /* of the device file: drawings lie there; NULL: none are opened */
    struct fw_plan_drawing *drawing; /* (ndrawing) as read, each once */
    int ndrawing;
    struct fw_plan_lab *lab; /* (nlab) laboratory packs as read */
    int nlab;
    struct fw_mask_layer_map *layers; /* numbers of the laboratory; NULL: none */
    const char *base_file, *base_xml;
    size_t base_length;
    struct fw_plan **step; /* (nstep) plans of the steps of a wafer's sweeps; NULL: not planned */
    int nstep;
    const struct fw_plan_swept *swept; /* what all devices of its wafer have; NULL: no sweep */
} fw_plan;

fw_plan *fw_plan_new(const fw_plan_options *options); /* NULL: out of memory */
void fw_plan_free(fw_plan *plan);                     /* NULL allowed */
/* reads the device ("-": standard input), the drawings beside it and the packs it refers to */
fw_status fw_plan_load(fw_plan *plan, const char *path);
/* the same from n bytes that a NUL follows and that live as long as the plan; `file` names them.
   Drawings lie in options.directory */
fw_status fw_plan_load_memory(fw_plan *plan, const char *file, const char *xml, size_t n);
/* layout, mechanism, motion, workspace, verdict (and advice); times and judgement of the flows, with what the masks of a
   design that is not rejected refuse */
fw_status fw_plan_judge(fw_plan *plan);
/* the corner that governs what each flow makes of the device, for options.watched; "": of some flow none was looked at */
void fw_plan_corner_text(const fw_plan *plan, char text[FW_PLAN_CORNER]);
/* for a picture of the motion: as drawn, what hinges use in the scene that is shown, in the first flow that it holds
   in, and nothing else. One variant of plan->verdict, which decides nothing; none where no scene is to be moved */
fw_status fw_plan_judge_shown(fw_plan *plan);
/* is the day stated that a schedule needs? FW_INPUT: of a loaded plan that is to be fabricated, before it is judged */
fw_status fw_plan_check_dates(fw_plan *plan);
/* masks with each flow's bias; a rejected design gets none unless forced */
fw_status fw_plan_fabricate(fw_plan *plan);

enum { /* what fw_plan_write writes */
       FW_WRITE_VERDICT = 1,
       FW_WRITE_MASKS = 2,
       FW_WRITE_RECIPES = 4,
       FW_WRITE_MOTION = 8,
       FW_WRITE_REPORT = 16,
       FW_WRITE_ALL = 31
};
/* the directory appears complete or not at all, with its manifest */
fw_status fw_plan_write(fw_plan *plan, const char *directory, unsigned what);
/* where judging ended because the layout cannot be made: its drawing with the faults marked and the
   manifest; nothing where the layout has none */
fw_status fw_plan_write_marked(fw_plan *plan, const char *directory);
enum {                        /* what is asked of a simulated scene beside its motion */
       FW_WANTED_FIGURES = 1, /* errors, and largest forces and travels */
       FW_WANTED_ENERGIES = 2 /* energies and constraint norm of every row */
};
/* one scene of one variant, for simulate; *mechanism too. What is wanted besides does not change
   the motion. Where the tolerance is not stated the figures are what it is chosen by: *wanted then
   has them too. Without them rows may wait (fw_dynamics_motion_rows). */
fw_status fw_plan_simulate(fw_plan *plan, unsigned *wanted, const fw_dynamics_motion **motion,
                           const fw_mechanism **mechanism, const fw_device_scene **scene);
/* modes and equilibrium likewise */
fw_status fw_plan_modes(fw_plan *plan, const fw_statics_modes **modes,
                        const fw_mechanism **mechanism, const fw_device_scene **scene);
fw_status fw_plan_statics(fw_plan *plan, const fw_statics **statics, const fw_mechanism **mechanism,
                          const fw_device_scene **scene);

/* the reachable set and the required poses in every flow, proved where that can be */
fw_status fw_plan_workspace(fw_plan *plan, fw_report_workspace *workspace);

typedef struct fw_plan_assembly {
    const fw_device_scene *scene;  /* its loads; NULL: the device has none */
    const fw_mechanism *mechanism; /* stands in the guess: as the description states it */
    const fw_assembly *assembly;   /* NULL: not even started */
    const fw_assembly_kinematics *kinematics;
    bool closed, motion;
} fw_plan_assembly;
/* the position problem, and velocities, accelerations and forces for the given rates */
fw_status fw_plan_assemble(fw_plan *plan, fw_plan_assembly *assembly);

/* ---- documents: the first three after fw_plan_judge, the others after fw_plan_fabricate ---- */
fw_status fw_plan_verdict_json(fw_plan *plan, fw_text *out);
fw_status fw_plan_verdict_text(fw_plan *plan, fw_report_terminal_style style, fw_text *out);
fw_status fw_plan_report_html(fw_plan *plan, fw_text *out);
fw_status fw_plan_masks_json(fw_plan *plan, fw_text *out);
fw_status fw_plan_recipes_json(fw_plan *plan, fw_text *out);

/* ---- the ladder of `flexwright hinge` ----
   One hinge by models of growing fidelity and cost. A level is a function and a row of ladder_levels.c.
   docs/theory/flexure-errors.md. */

typedef struct fw_plan_ladder_case {
    fw_arena *arena; /* of this evaluation: freed when it has been measured */
    const fw_mechanism *mechanism;
    const fw_mechanism_hinge *hinge; /* its input is what every level starts from */
    fw_diags *diags;                 /* for what a level has to say */
} fw_plan_ladder_case;

typedef struct fw_plan_ladder_level {
    const char *name, *summary;
    bool external; /* takes seconds and a program that need not be installed */
    /* fills a row but cpu_s and centre_m; row->state says whether there is one */
    fw_status (*work)(const fw_plan_ladder_case *c, fw_report_level *row);
} fw_plan_ladder_level;

enum { FW_LADDER_LEVELS_MOST = 8 };
const fw_plan_ladder_level *fw_plan_ladder_levels(size_t *count);

typedef enum fw_plan_ladder_wanted {
    FW_LADDER_CHEAP = -1, /* all but those of external programs */
    FW_LADDER_AUTO = -2,  /* the same, and external ones where those do not reach the accuracy */
    FW_LADDER_ALL = -3,
    FW_LADDER_ONCE = -4  /* as CHEAP, each level run once: what it costs is not wanted */
} fw_plan_ladder_wanted; /* else: index of the one level */

enum { FW_DRIFT_POINTS = 41 };
typedef struct fw_plan_ladder_drift {
    fw_flexure_surfaces surfaces; /* aside_rad NaN: not drawn */
    double limit_rad;             /* the range: +- this */
    double contact_rad[2]; /* pure moment: at what rotations of the pin, - and +; NaN: none in
                               the range up to half a turn */
    double closing_N[2];   /* force along and across that closes the gap at rest; NaN: no gap */
    fw_flexure_drift_advice advice;                /* for +- limit */
    fw_flexure_drift_point point[FW_DRIFT_POINTS]; /* from - to + limit, rotation of the pin */
} fw_plan_ladder_drift;

typedef struct fw_plan_ladder { /* of one hinge in one flow */
    const char *flow;
    const fw_mechanism *mechanism;
    const fw_mechanism_hinge *hinge;
    fw_report_level row[FW_LADDER_LEVELS_MOST]; /* (rows) */
    int rows;
    int picked;   /* cheapest row whose own error is below the accuracy; where none is, the best */
    bool reached; /* it is below */
    double reaches; /* error of the picked row's stiffness */
    int shared;     /* index of the ladder that was solved for this one too; -1: its own */
    fw_plan_ladder_drift drift;
} fw_plan_ladder;

typedef struct fw_plan_ladders {
    fw_plan_ladder *item; /* (count) */
    int count;
    double accuracy; /* wanted, relative, of the rotation that a moment makes: of the stiffness */
} fw_plan_ladders;

/* the layout for what needs the hinges only: one that cannot be made is a warning, and what can be
   shown of it says where the hinges are and how they are drawn; NULL: nothing does */
fw_status fw_plan_hinges_layout(fw_plan *plan, const fw_layout **layout);
fw_status fw_plan_hinges_mechanism(fw_plan *plan, const fw_layout *layout,
                                   const fw_mechanism_variant *variant,
                                   const fw_mechanism **mechanism);
/* every hinge in every flow of a loaded plan; hinges that are alike are solved once */
fw_status fw_plan_ladders_run(fw_plan *plan, int wanted, fw_plan_ladders *out);
/* the same for the report */
fw_status fw_plan_report_hinges(fw_plan *plan, const fw_plan_ladders *all, fw_report_hinge **out);
const char *fw_plan_ladder_id(const fw_plan_ladder *ladder);

/* One level; measured: repeated until the clock can see it, at most for 2 ms. Visible because
   callgrind counts what each call of it costs (tests/accuracy/levels.c). */
fw_status fw_plan_ladder_climb(const fw_plan_ladder_case *c, const fw_plan_ladder_level *level,
                               bool measured, fw_report_level *row);

#endif
