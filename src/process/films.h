/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer's layers after a step: drawn not to scale (stacks), as films with heights and walls,
   and what wet steps take of the device itself. */
#ifndef FW_PROCESS_FILMS_H
#define FW_PROCESS_FILMS_H
#include "process/process.h"
#include "xml/xml_reader.h"

/* ---- stacks! ---- */
/* The wafer's layers after a step, as the <change> elements make them: two columns, one through the
   structure and one through the field beside it. Heights are drawn heights, not to scale. */

typedef struct fw_process_cell {
    const char *material;
    double thickness_m;    /* NaN: unknown */
    double bottom, height; /* drawn, in units of about a millimetre on paper */
    bool exposed;          /* latent image in resist */
    bool back;             /* was put on the back of the wafer */
} fw_process_cell;

/* the first two columns of every flow; with further plates there are more (stack.c) */
enum { FW_STACK_STRUCTURE, FW_STACK_FIELD };

typedef struct fw_process_stack {
    fw_process_cell *cell[FW_STACK_MOST]; /* (n), bottom to top; removed ones are gone */
    int n[FW_STACK_MOST], capacity, columns;
} fw_process_stack;

/* ---- parts of the wafer: stack.c ---- */
typedef struct
    fw_process_side { /* of what a plate prints; plate 0: the device's, of which set says field */
    int plate;
    bool set;
} fw_process_side;
int fw_process_flow_columns(const fw_process_flow *flow);
/* false: "all", or no part of the wafer */
bool fw_process_where_side(const fw_process_flow *flow, const char *where, fw_process_side *side);
bool fw_process_side_holds(const fw_process_flow *flow, fw_process_side side, int column);
/* is the column in this part of the wafer ("all", "structure", "field", "cavity" ...)? */
bool fw_process_where_holds(const fw_process_flow *flow, const char *where, int column);
/* do edges of what is removed there lie at those of the device, not at those of another plate? */
bool fw_process_where_is_of_device(const fw_process_flow *flow, const char *where);
/* has what lies in these columns, all on one side of a plate, edges at that plate's? Not what another plate prints within
   that side alone */
bool fw_process_columns_edge(const fw_process_flow *flow, const bool in[], int plate);
/* does one plate alone part them? */
bool fw_process_columns_meet(const fw_process_flow *flow, int a, int b);
/* "structure", "field, cavity" */
const char *fw_process_column_name(const fw_process_flow *flow, int column, char name[FW_LABEL]);

/* layers after step `index` (-1: before the first). *absent (may be NULL) is the first change that
   touches a material which is not there, else NULL. */
fw_status fw_process_flow_stack(fw_arena *arena, const fw_process_flow *flow, int index,
                                fw_process_stack *stack, const fw_process_change **absent);

/* Is what a change adds far from everything: added and taken away as a whole, if at all, etched through from the back, or
   hollowed out to no more than *depth_m? Then pictures draw it thinner than it is. */
bool fw_process_change_is_background(const fw_process_flow *flow, const fw_process_change *add,
                                     double *depth_m);

/* as change `change` of step `step` finds it */
fw_status fw_process_flow_stack_before(fw_arena *arena, const fw_process_flow *flow, int step,
                                       int change, fw_process_stack *stack);

/* is there a film of the material in the column? */
bool fw_process_stack_holds(const fw_process_stack *stack, int column, const char *material);
/* outermost film of a column, seen from the front or from the back; NULL: it has none */
const fw_process_cell *fw_process_stack_top(const fw_process_stack *stack, int column, bool back);
/* does an etch of the flow run sideways below the device, through this material? */
bool fw_process_flow_runs_below(const fw_process_flow *flow, const char *material);
/* What carries a finished device. *carries: the thickest of all films below it, where it is held; NULL: none,
   since the layer is the wafer itself. *faces: what is next below it where a gap is, or where an etch has run
   sideways, one that conducts before one that does not; NULL: nothing is. Test: test_below.c */
fw_status fw_process_flow_ground(fw_arena *arena, const fw_process_flow *flow,
                                 const fw_process_material **carries,
                                 const fw_process_material **faces);
/* outermost film of the material in a column, seen from the front or from the back; NULL: it is not there. *cover: material
   of the outermost film beyond it that has no holes; NULL: it lies open there, or at its side, where it stands out beyond
   the other columns */
const fw_process_cell *fw_process_stack_find(const fw_process_flow *flow,
                                             const fw_process_stack *stack, int column,
                                             const char *material, bool back, const char **cover);

/* does `material` lie open anywhere on that face: on top of a column, below films that have holes, or at its side, where it
   stands out beyond the other columns */
bool fw_process_stack_open(const fw_process_flow *flow, const fw_process_stack *stack,
                           const char *material, bool back);

/* A material may lie on both faces: a change works on what was put on its own face, and on what was put on the other one
   where there is nothing of it on its own. Does change c work on that cell? */
bool fw_process_stack_works_on(const fw_process_stack *stack, const fw_process_change *c,
                               const fw_process_cell *cell);
/* does it work on the wafer's back: does a change but an addition? */
bool fw_process_step_from_back(const fw_process_step *step);
/* Does what a step works with meet that face? A plasma meets the one that it works on; a bath the front, and the back where
   something is done to it */
bool fw_process_step_meets(const fw_process_step *step, bool back);

/* ---- wear ---- */
/* What wet steps take of the device itself when it stands: the removal of a seed, for example,
   takes copper from every open face. Private to process/. */

/* does what the step works with attack walls as it attacks tops: a liquid, or a gas that runs sideways? */
bool fw_process_step_is_wet(const fw_process_step *step);
/* Pure: from the pack's own quantities, whether or not steps were computed. way_m: from the openings to the middle of what
   must come free, as the walls stand when all has been taken; it gives the reach of a release that is left to the mask. NaN:
   not known */
fw_status fw_process_flow_wear(fw_arena *arena, const fw_process_flow *flow, double way_m,
                               fw_process_wear *wear);

/* The wafer after a step, as films with heights and walls: what the <change>s of the pack make of
   it, with what the fixed point knows of edges, depths and lags. Where the walls lie on the wafer
   follows from the mask (recipe/recipe_profile.h). Call after fw_process_flow_compute.

   A film lies in one of two columns, or in both: the structure, which is what the plate draws, and
   the field around it. Where it is in one only, its wall stands beside the drawn edge by a known
   amount, at its bottom and at its top. Theory: docs/theory/films.md. */

typedef struct fw_process_film {
    const char *material;
    bool in[FW_STACK_MOST];
    double bottom_m, top_m; /* as drawn: to scale but where `thickness_m` says otherwise */
    double thickness_m;     /* NaN: nobody stated it */
    bool shortened;         /* drawn thinner than it is: far from everything that is made */
    bool exposed;           /* latent image in resist */
    bool back;              /* was put on the back of the wafer */
    double foot_m, head_m;  /* the structure's wall at bottom and top, outside the drawn edge */
    struct {                /* the same of what further plates print */
        double foot_m, head_m;
    } further[FW_PROCESS_PLATES];
    /* of the field: etched by this; what the lag leaves is its floor. In the structure: its foot
       follows the width of the opening beside it */
    const fw_process_cut *cut;
    double mask_edge_m; /* with a cut: edge of what masked it */
    double reach_m;     /* above 0: an etch from every opening has taken the film so far
                           sideways, out of the field and from below the structure */
} fw_process_film;

typedef struct fw_process_films {
    fw_process_film *film; /* (n) by bottom_m */
    int n, capacity;
    bool changed;      /* the last step changed something */
    const char **note; /* (nnote) what the picture of this step cannot know, each a sentence */
    int nnote;
} fw_process_films;

/* after step `index` (-1: before the first) */
fw_status fw_process_flow_films(fw_arena *arena, const fw_process_flow *flow, int index,
                                fw_process_films *films);
/* how deep an opening of w_m gets: z + lag(w, z) = E, at most the cut's depth; m. An unknown lag
   counts as none. */
double fw_process_cut_depth(const fw_process_cut *cut, double w_m);
/* is note i not among those of the films before? */
bool fw_process_films_is_new(const fw_process_films *now, const fw_process_films *before, int i);
/* does the step change the wafer's films? */
bool fw_process_step_changes(const fw_process_step *step);

#endif
