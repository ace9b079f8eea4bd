/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The design rules of the drawing: every length and share that the file does not state, each with
   its reason. Private to the room. Lengths in m, angles in rad, shares without unit. What the file
   states is never replaced by one of these: where both cannot hold, the drawing is refused and the
   message names the rule's value. */
#ifndef FW_LAYOUT_LAYOUT_RULES_H
#define FW_LAYOUT_LAYOUT_RULES_H

typedef struct fw_layout_rules {
    /* ---- what every mask can show ---- */
    double least_space_m;  /* between parts that move apart, unless a gap is set smaller: etching
                              widens either part by up to 1.1 um, and dust of 5 um must not wedge */
    double corner_m;       /* radius of rounded corners: no sharp notch where a crack begins */
    double own_width_m;    /* within one outline, a mask rule of 4 um and a bias of 1.1 um per edge
                              leave: width, */
    double own_space_m;    /* space, */
    double own_hollow_m;   /* hollow radius, */
    double own_bend_m;     /* the same where an arc turns by more than 45 degrees: its two ends face
                              each other across it, and of a quarter turn written in chords within
                              5 nm the first and the last are 1.33 radii apart, */
    double own_tip_m;      /* and convex radius there */
    double least_corner_m; /* corners that do not fit are halved, not below this: smaller ones are
                              lost in the resolution of a mask (0.5 um) */
    double sounder_share;  /* an outline is preferred to an earlier attempt that is so much worse */
    double least_head_corner_m; /* the same inside a hinge's head, which the body rounds again */

    /* ---- root blocks ---- */
    double block_depth_m;      /* of a root block inside the centre line of the flexure: as the ring
                                  is thick, so that the block is no softer than the ring */
    double block_depth_widths; /* and at least as many flexure widths: a clamp as in the formulas */
    double block_depth_radii;  /* but no farther than half-way to the centre of an arc */
    double half_space_share;   /* of the least space, from a block to the hinge's axis: one half,
                                  and 5 % for the rounding of the two corners */
    double root_flat_m;        /* of the root's face beside a fillet: the fillet ends on a line */
    double fillet_radii;       /* the largest fillet in inner radii of an arc: beyond it the cut
                                  would be nearer to the middle of the arc than to its root */
    double fillet_lengths;     /* and in lengths of a straight leaf: half of it stays uniform */
    double fillet_least_widths; /* a smaller fillet is none: stress concentration as of a notch */
    double fillet_step;         /* factor between the radii that are tried at the ends of a path */
    double cut_least_rad;       /* half angle of an arc that remains between its two fillets */
    double leaf_spaces;         /* shortest leaf in least spaces: the blocks at its ends face each
                                   other, one space and two corners */
    double beyond_fillet_m;     /* from the end of a path's fillet to the cut */
    double cut_share_only;      /* of the only piece of a path that a cut may take: two cuts fit */
    double cut_share_last;      /* of the last of several pieces */
    double path_clear_spaces;   /* least spaces behind the cut from where on a path keeps clear of
                                   the body that it is rooted in */
    double block_behind_widths; /* of the block behind the root, in flexure widths, where the neck
                                   runs on into it */
    double block_least_widths;  /* and where the block's far side gives way to the other block */

    /* ---- rings about the hinge point ---- */
    double free_rad;         /* rotation that rings and blocks leave free where they can: more than
                                any flexure of silicon bears */
    double ring_m;           /* thickness of a ring that carries a conjugate surface, */
    double ring_least_m;     /* of the smallest hinges, */
    double ring_sizes;       /* in between as a share of the flexure's size, */
    double ring_widths;      /* and at least as many flexure widths: the ring has to be rigid */
    double ring_free_m;      /* between flexure and inner ring, of the smallest hinges, */
    double ring_free_most_m; /* of the largest: an etch must reach in, more is only larger, */
    double ring_free_sizes;  /* in between as a share of the flexure's size */
    double beside_ring_m;    /* free width around the outer ring */
    double ring_past_rad;    /* how far a ring may run on past the bulge: 100 degrees, a third of a
                                turn less than the closed ring that could not be assembled */
    double ring_from_face_m; /* arc length that stays free between a ring's end and the block, */
    double ring_from_neck_m; /* and the neck: a slit of two least widths of the mask */
    double facing_least_rad; /* of two conjugate surfaces: below 20 degrees they guide nothing */

    /* ---- necks, from the outer ring to a bar or a plate ---- */
    double neck_rings;        /* greatest half width in outer radii of its ring: at one half the
                                 neck would leave the ring as a tangent */
    double neck_inset_m;      /* of the neck's edge from the bar's, so that they cannot coincide */
    double block_step_m;      /* from a block to a bar drawn beside it: room for two corners */
    double neck_beyond_m;     /* from the keep-out disc to the neck's end, in a bar, */
    double neck_into_plate_m; /* and from the edge of the plate or of the disc cut out of it */
    double neck_beside_block_m; /* a neck that meets its block's far side ends so much later */
    double neck_corner_clear_m; /* no corner of the neck's end nearer to the plate's edge: that
                                   would leave a tiny step; */
    double neck_corner_step_m;  /* the neck is made longer by this, */
    int neck_corner_steps;      /* so many times at most: once across the edge is enough */
    double neck_ring_share;     /* half width of a neck that ends on the ring, in radii of it */
    double neck_plate_share;    /* half width of a neck in the lesser side of its plate */
    double neck_width_m;        /* between a plate and its hinge, where the body has no width */
    double tooth_search_m;      /* along a plate's rim beside a neck: a tooth narrower than this is
                                   covered by the neck */
    double tooth_step_m;        /* of that search */
    double tooth_past_m;        /* how far the neck then reaches beyond the plate's corner */
    double tooth_turn_rad;      /* how far round the hinge the neck may reach for it */
    double tooth_longer_m;      /* the wider neck ends so much deeper in the plate */
    double tooth_room_m;        /* but the block has to end so much before the corner */
    double solid_ring_share;    /* of the ring's thickness: there a neck begins to be whole, */
    double solid_past_m;        /* and so far beyond where the block's far side leaves it */
    double form_neck_least;   /* ranges of the free dimensions of a head (hinge_head.c): least share
                                 of the neck's half width, at which it is still twice as stiff as
                                 the flexure's root; */
    double form_behind_least; /* block behind the root, in flexure widths: clamped at 1.6, */
    double form_behind_most;  /* and beyond 7.5 in the way of the neck */
    double form_longer_m;     /* neck: two corners and a step longer at most */
    double form_wider_m;      /* disc in the body's own plate, likewise */
    int form_attempts;        /* at most at one head: ten times as many as 99 of 100 take */
    double block_ring_clear_m; /* a far side that turns does so this much inside the ring */
    double far_side_least_m;   /* shortest edge of a block's far side */
    double far_side_ahead_m;   /* an edge that meets the far side nearer than this meets nothing */
    double opposite_norm;      /* directions to the two bodies whose sum is shorter than this are
                                  opposite: their bisector would be an accident of rounding */
    double straight_rad;       /* a bar that leaves its leaf's line by less gets a straight head, */
    double oblique_rad;        /* a neck that leads into a plate may leave it by this, */
    double oblique_step_rad;   /* tried in such steps, */
    double oblique_side_rad;   /* and the plate's side is that much off square at most; */
    double straight_clear_m; /* its plate begins this much behind the root: room for two corners */
    double off_leg_rad;      /* a leaf that is turned off a leg by this is said to be, where pins
                                  alone do not move: at 1 degree it gives twice as much along it */
    double across_leg_rad;   /* and by this wherever it is */

    /* ---- bars and hubs ---- */
    double bar_overlap_m;      /* length on which a bar lies inside the neck that it starts in, */
    double bar_inset_m;        /* it starts inside the neck's edge by this */
    double bar_rise_m;         /* and rises by this on that length: the two edges cross at about 5
                                  degrees, so that no step is left wherever they cross */
    double bar_steepest;       /* slope of the shoulder beyond the neck where the gentle one does
                                  not reach the stated width: 45 degrees keep clear of the disc */
    double bar_full_share;     /* of the bar between neck and middle that has its full width */
    double hub_clear_m;        /* a hub beside its hinges: a flexure's length and this away */
    double hub_radii;          /* of the disc under the bars that meet, in half widths of a bar */
    double base_width_m;       /* bar between the ground hinges, or two widths of the widest body */
    double pedestal_share;     /* of the way to the frame where the pedestal of a single ground
                                  hinge begins; */
    double pedestal_reach;     /* the hinge's own bar runs on to twice that, inside of it */
    double pedestal_widths;    /* its half width in half widths of that bar */
    double pedestal_bar_share; /* half width in the distance of the two hinges of a base */
    double pedestal_clear_m;   /* of its edge from the keep-out discs of those hinges */
    double lug_near_m;         /* an unsound place this near to an eyelet of the platform is laid to
                                  the eyelet, which then moves; else to the nearest hinge */
    double lug_shift_m;        /* by multiples of this: more than the least space and the corner */

    /* ---- eyelets of platforms whose tendons the file does not place ---- */
    double eye_m;             /* inner radius: a wire of 50 um goes through with a tool's tip */
    double eye_outer_m;       /* outer radius */
    double eye_stem_m;        /* half width of the stem */
    double eye_height_m;      /* of the eye's middle over the plate's edge */
    double eye_foot_m;        /* of the stem inside the plate */
    double eye_open_from_rad; /* the opening lies across the pull, */
    double eye_open_rad;      /* and is narrower than the wire's hook is long */
    double eye_clear_m;       /* from the keep-out disc of any hinge */
    double eye_far_share;     /* of the plate's half width: places on the edge away from the
                                 mechanism, */
    double eye_near_share;    /* on the opposite edge, where hinges are, */
    double eye_between_share; /* and what either pair leaves to the plate's corner */
    double eye_pair_m;        /* half the free width between the two of a pair, beside the eyes */
    double eye_from_corner_m; /* on a short edge, from the plate's corner to the stem */

    /* ---- frame, tethers ---- */
    double frame_m;
    double lane_m;
    double clearance_m;       /* mechanism to frame, where the file states none */
    double clearance_least_m; /* the same in a die of stated size: a tether's stub and a finger */
    double stub_m;            /* of the frame towards the base, so that the cut has square sides */
    double tether_m;          /* width of a finger */
    double tether_neck_m;     /* at the body, where it breaks */
    double tether_stub_m;     /* of the frame; longer than its rounded corners, as at the base */
    double strip_clear_m;     /* of pedestals, fingers and stators from other parts: they may stand
                                 anywhere, so that they keep more than the least space */
    double strip_disc_m;      /* and from a hinge's keep-out disc, which is free of parts already */
    double fingers_apart_m;   /* between two tethers: a needle breaks one and leaves the other */
    double finger_works_m;    /* from where a body meets something: no stub between the two */
    double finger_beside_m;   /* on either side of a finger its own body keeps the least space */
    double finger_step_m;     /* of the search along it */
    double finger_least_m;    /* from the window's edge to the cut: stub, finger and neck fit */
    double tether_cut_m;      /* the cut lies at most this far outside the body: else its edge there
                                 is not straight */
    double neck_straight_m;   /* beyond the rounded corners, so that the cut is square */
    double neck_long_m;       /* of the narrow part, before it widens to the finger */
    double frame_cut_clear_m; /* of the cut across a frame bar from stubs, eyelets and corners */
    double frame_cut_step_m;  /* of the search for it, from the middle of the bar, */
    int frame_cut_steps;      /* so many to either side */
} fw_layout_rules;

extern const fw_layout_rules fw_layout_rule; /* layout_rules.c */
#endif
