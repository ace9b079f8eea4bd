/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which measurement pays: what is left of the verdict's bands and of the steps' time windows once one
   input of a flow is known as exactly as it can be read. Nothing here estimates: an input is put into
   the flow as a laboratory pack would, and the verdict's own search and the flow's own times are run
   again. Theory: docs/theory/measurements.md. */
#ifndef FW_MEASURING_MEASURING_H
#define FW_MEASURING_MEASURING_H
#include "base/json.h"
#include "process/calibrate.h"
#include "verdict/verdict.h"

typedef struct fw_measuring_window { /* first look to clear by of a step, s; NaN: not computable */
    const char *step;                /* id */
    double before_s[2], after_s[2];
} fw_measuring_window;

typedef struct fw_measuring_item { /* one input, measured alone */
    const char *id;                /* of the flow, for a laboratory pack; NULL: of the material */
    const char *name;              /* "anisotropy" */
    fw_quantity q;                 /* unit, status, source and note of what is known now */
    bool unknown;                  /* nobody knows it; where `value` is one, a range is assumed */
    double value;                  /* SI; kept, for nobody knows what will be read; NaN: none */
    double before, after;          /* standard uncertainties, SI; before: NaN where unknown */
    const char *by; /* what reads it; NULL: nothing in this flow does, and `after` is 0 */
    bool coupon;

    bool made; /* it moves what is made */
    bool open; /* ... by nobody knows how much: nothing is accepted before it is known */
    /* what it makes of the standard uncertainty of what governs, nominal, first order: dU/dx sigma_x of
       the verdict, and what is left of that */
    double share, share_after;
    /* where bands were asked for */
    fw_verdict_band band;               /* of what governs (fw_measuring) */
    const fw_verdict_band *requirement; /* (nrequirement) */
    fw_verdict_decision decision;       /* of the corners */
    const char *governs;                /* what then reaches furthest, which may be another */
    double most;                        /* ... and how far */
    fw_verdict_band governing;          /* ... and its band, from end to end */
    bool decides;                       /* that was inconclusive, and is not any more */
    /* by how much of the limit the band gets narrower; where another governs then, no device that the
       flow makes uses less than the larger of the two lower ends */
    double narrowing;
    int judged; /* devices that were run for it */

    const fw_measuring_window *window; /* (nwindow) those that it changes */
    int nwindow;
    double windows;         /* sum of what the windows lose, relative to the planned times */
    int opens, needed;      /* steps that it alone, or it with others, makes computable */
    const char *needed_for; /* "S03, S09 (with resist type)"; NULL */
} fw_measuring_item;

typedef struct fw_measuring { /* of one flow */
    bool judged_made;         /* else corners were not judged: only windows */
    bool asked;               /* for bands: then it stands in the verdict, too */
    bool banded;              /* the corners were searched again for each input: there are bands */
    int hinge, requirement;   /* of the variant: which governs; the other FW_NONE, or both */
    const char *what;         /* "hinge A", "requirement stroke" */
    double sigma;             /* of it, nominal, first order, all inputs */
    fw_verdict_band band;     /* of it, as it is known now */
    const fw_verdict_band *requirements; /* (nrequirement) */
    const char *const *requirement_name; /* (nrequirement) "requirement stroke (final)" */
    int nrequirement;
    fw_verdict_decision decision;
    const fw_measuring_item *item; /* (nitem) ranked; those that change something */
    int nitem;
    const char *nothing; /* names of those that change nothing, commas between; "" */
    int judged;          /* devices that were run in all beside the verdict's */
    const char *first;   /* a sentence: what to measure first; NULL: nothing that pays */
} fw_measuring;

typedef struct fw_measuring_request {
    const fw_device *device;
    const fw_layout *layout;           /* as judged; may be NULL */
    const fw_verdict_options *options; /* as judged */
    bool bands;                        /* costs the devices of fw_measuring.judged */
    const fw_verdict_variant_verdict *verdict;
    /* read for this alone, and not computed yet: it is changed and computed, and put back but for what
       was computed */
    fw_process_flow *flow;
    const fw_process_mask_facts *drawn; /* that the verdict's inputs are from; NULL: not drawn */
    const fw_process_mask_facts *facts; /* of the times: those of the plate; NULL: no mask */
} fw_measuring_request;

/* Test: tests/unit/measuring/test_measuring.c, tests/cli/test_measurements.py */
fw_status fw_measuring_run(fw_arena *arena, const fw_measuring_request *request,
                           const fw_measuring **out);

/* ---- for those who write it ---- */

/* what is left of the band, or where there are none what it brings to the uncertainty, now and then;
   nothing where it moves nothing that is made */
void fw_measuring_put_worth(fw_text *out, const fw_measuring *measuring,
                            const fw_measuring_item *item);
/* of the step that gains most, "S18: 80.8..99.2 to 84.1..95.9 min, and 2 more steps"; or what it is
   needed for; nothing where it changes no window */
void fw_measuring_put_windows(fw_text *out, const fw_measuring_item *item);
/* the member "measurements" of an object; NULL: null */
void fw_measuring_json(fw_json *json, const fw_measuring *measuring);
/* "79.7..90.9 %"; where a flexure is gone at a corner: "79.7 % to cut through" */
void fw_measuring_put_band(fw_text *out, const fw_verdict_band *band);
/* "0.995 +- 0.0003", in the unit of the quantity, which follows */
void fw_measuring_put_value(fw_text *out, const fw_measuring_item *item, bool after);

/* ---- private to measuring/ ---- */

/* narrowing and decides of the items (n, in any order); those that change something, ranked, into
   m->item; the others' names; the sentence */
fw_status fw_measuring_rank(fw_arena *arena, fw_measuring *m, fw_measuring_item *item, int n);

#endif
