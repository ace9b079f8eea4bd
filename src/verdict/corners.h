/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Devices at points of the ranges of a flow, run and kept. Private to the room. */
#ifndef FW_VERDICT_CORNERS_H
#define FW_VERDICT_CORNERS_H
#include "verdict/verdict.h"

typedef struct fw_verdict_search {
    fw_arena *arena; /* of the plan */
    const fw_device *device;
    const fw_layout *layout;
    fw_verdict_options options;
    const fw_verdict_variant_verdict *v; /* as drawn */
    fw_verdict_fabricated_verdict *fabricated;
    int nrow;   /* hinge k in scene i: k (nscene + 1) + i; then pull-in of every scene */
    double *ln; /* (points x nrow) ln of the utilisation at each point that was run; NaN: none */
    unsigned *bits; /* (points) of a corner, bit i: input i is high; FW_NO_CORNER: no corner */
    const fw_verdict_fabricated_corner *known; /* a point that was run before the others, or NULL */
    const double *known_ln;                    /* (nrow) */
    int first;     /* how many points there were when the slopes were known */
    double *slope; /* (nrow x ninput) d ln U / dx about the nominal; NaN: none */
} fw_verdict_search;

enum { FW_MOST_POINTS = 2 + FW_FABRICATION_INPUTS + (1 << FW_FABRICATION_INPUTS) };
#define FW_NO_CORNER (~0u)

/* runs the device at x and keeps it as the next corner of s->made */
fw_status fw_verdict_search_run(fw_verdict_search *s, const double *x, unsigned bits);
/* the same without keeping: is it accepted? */
fw_status fw_verdict_search_accepts(const fw_verdict_search *s, const double *x, bool *accepted);
/* "12.5 um" of an input */
const char *fw_verdict_fabrication_value(fw_arena *arena, const fw_verdict_fabrication_input *input,
                                         double x);
/* what would have to be held so that it accepts: made->held and control */
fw_status fw_verdict_fabrication_control(fw_verdict_search *s);

#endif
