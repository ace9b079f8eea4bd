/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a flow makes of a device: independent inputs (an edge, an etch, a thickness, a modulus),
   each with its range, and what they do to widths, gaps, sections and masses. Theory:
   docs/theory/as-fabricated.md. */
#ifndef FW_VERDICT_VERDICT_FABRICATION_H
#define FW_VERDICT_VERDICT_FABRICATION_H
#include "mechanism/mechanism.h"

/* corners and wear of a flow at most, and with the two expansions of a scene that heats: 256 corners; and what no corner
   names and nobody knows, which has none */
enum {
    FW_FLOW_INPUTS = 6,
    FW_RANGED_INPUTS = FW_FLOW_INPUTS + 2,
    FW_FABRICATION_INPUTS = FW_RANGED_INPUTS + 2
};

/* one input x, in the SI unit of its quantity. The state that it makes is linear in it:
     edge += edge_m (x - even) + edge_at_m, flare += flare_m (x - drawn) + flare_at_m, relative
   thickness and modulus likewise, and thermal expansions in 1/K */
typedef struct fw_verdict_fabrication_input {
    const char *name; /* "printed edge" */
    fw_quantity q;    /* unit, status, source and note of the range */
    double drawn;     /* at which what stands is as drawn */
    double even;      /* at which edges are where they are drawn: what the mask compensates */
    double nominal, low, high, sigma; /* low <= nominal <= high; sigma: standard uncertainty */
    double edge_m, flare_m, thickness, youngs; /* per unit of x */
    double expansion, substrate; /* likewise of the layer, of what holds its anchors */
    /* the same at drawn and even: 0, but where an input goes with others (process/process_corners.c) */
    double edge_at_m, flare_at_m, thickness_at, youngs_at, expansion_at, substrate_at;
    double
        local; /* edges of every hinge apart from the others, per unit of x either way; such an input has no
                     corners of its own, and ranges from -d to d about a nominal 0 */
    const char *unknown; /* id of the quantity that is not known, for which this range is assumed;
                            NULL: it is known */
    /* ... and nothing is assumed for it: it has no range and moves nothing, and nothing is accepted before it is known.
       Such inputs stand last */
    bool open;
} fw_verdict_fabrication_input;

typedef struct fw_verdict_fabrication {
    double edge_m;                        /* edges of the material stand out by this, mid-depth */
    double flare_m;                       /* see fw_device_flexure */
    double thickness_ratio, youngs_ratio; /* of the variant's own */
    double expansion_per_K, substrate_per_K; /* beside the variant's own */
    double local_m;          /* edges of hinge j stand out by sign[j] local_m more */
    const signed char *sign; /* (nrevolute) NULL: all alike */
} fw_verdict_fabrication;

typedef struct fw_verdict_fabricated_device { /* copies; what they do not change is shared */
    fw_device device;
    fw_layout layout;
    const fw_layout *drawn; /* &layout, or NULL without a drawing */
    fw_mechanism_variant variant;
    const char *gone; /* a sentence: a flexure is cut through, a gap closed; NULL */
} fw_verdict_fabricated_device;

/* is something not known, of which not even a range is assumed? No device can then stand for all that may be made. Test:
   test_made.c, what_nobody_knows_stays_open; tests/cli/test_measurements.py */
bool fw_verdict_fabrication_open(const fw_verdict_fabrication_input *input, int ninput);
fw_verdict_fabrication fw_verdict_fabrication_at(const fw_verdict_fabrication_input *input,
                                                 int ninput, const double *x);
/* In: the device as drawn (layout may be NULL) in a variant. Solids grow by 2 edge, gaps lose it. Flexures: width, gap,
   length (an arc its angle), concave fillets - edge, trapezoid section; stated stiffness by the ratio of the closed
   forms, stated damping by its root; hinge points move with the centres of elastic weights; bodies:
   mass and inertia with the area, A + P edge; combs, plates, squeezed films and contacts; how far hinges turn until
   solids touch. Thickness and modulus scale what is stated as another flow would.
   Test: test_made.c, test_made_by_hand.c */
fw_status fw_verdict_fabrication_build(fw_arena *arena, const fw_device *device,
                                       const fw_layout *layout, const fw_mechanism_variant *variant,
                                       const fw_verdict_fabrication *fabricated,
                                       fw_verdict_fabricated_device *out);

/* ---- what the verdict says of the corners ---- */

typedef struct fw_verdict_fabricated_hinge {
    int corner;    /* of those that were run, the tightest */
    double most;   /* bound on the utilisation at any corner, run or not, numbers included */
    double sigma;  /* of the nominal utilisation, first order, inputs independent */
    double *share; /* (ninput) dU/dx sigma_x */
} fw_verdict_fabricated_hinge;

/* How far edges may lie beyond all that the corners make of them, either way, before something that is accepted is not.
   Test: test_ranges.c, room_of_edges; tests/cli/test_mask_certificate.py */
typedef struct fw_verdict_edge_room {
    /* which hinge, requirement or distance decides, and how it goes; NULL: not known */
    const char *says;
    double edge_m;   /* to first order; HUGE_VAL: nothing of it changes with edges */
    double looked_m; /* how far the corners themselves move edges either way */
} fw_verdict_edge_room;

/* Of one die, by value: a reason without a share fails it, whatever any band says (sure) or not, or leaves open whether it
   holds. low, high: logarithm of the largest share of a limit that any check uses at the lower and the upper end of its own
   band */
typedef struct fw_verdict_by_value {
    bool fails, sure, open;
    double low, high;
} fw_verdict_by_value;

struct fw_verdict_variant_verdict;
/* surface tension of a liquid that wets and that it surely bears as it dries, N/m; NaN: not judged */
double fw_verdict_dries(const struct fw_verdict_variant_verdict *verdict);

#endif
