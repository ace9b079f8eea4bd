/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The electrical side of a drawing: which of its pieces are one conductor (a net), what the actuators ask
   of them, where each is contacted, how near two of them come and what the gap between them bears.

   A net is what hangs together in the device layer: pieces that share a cut, or that touch. Tethers are
   broken before use and join nothing to the body that they hold. In a flow whose carrier conducts, all
   that stands on it is one net with it. Theory: docs/theory/wiring.md. */
#ifndef FW_WIRING_WIRING_H
#define FW_WIRING_WIRING_H
#include "base/json.h"
#include "layout/layout.h"

typedef enum fw_wiring_kind {
    FW_WIRING_ROTOR,  /* with something that moves */
    FW_WIRING_STATOR, /* stands on the carrier by itself, with an electrode */
    FW_WIRING_HELD    /* part of the frame, or a base, that nothing that moves hangs on */
} fw_wiring_kind;

/* what is below the device layer, as the flow states it */
typedef struct fw_wiring_carrier {
    bool insulates;
    const char *words;  /* "oxide of 2 um (buried silicon dioxide)"; never NULL */
    double thickness_m; /* of the insulator; NaN: thick, or not known */
    bool handle;        /* a conductor lies below the insulator: a net of its own */
    double breakdown_V_per_m, resistivity_Ohm_m; /* of the insulator; NaN: not known */
    double
        breakdown_share; /* relative standard uncertainty of what it bears, strength and thickness together */
    const char *source; /* of these; NULL */
} fw_wiring_carrier;

/* the least distance of a stator from all that moves, over the motions of a flow (verdict/) */
typedef struct fw_wiring_moved {
    const char *stator; /* label of its piece */
    const char *scene;
    int index; /* of the scene; behind the last scene required boxes */
    double m, t_s;
    double start_m, moved_m; /* distance where the motion begins; how far the two go at most */
    /* least that it may be, by what the motion is off by and at all corners of the flow */
    double low_m;
    fw_geometry_vec2 at;
} fw_wiring_moved;

typedef struct fw_wiring_asked {
    const char *flow; /* of whose scenes the drives are asked for; NULL: of none */
    fw_wiring_carrier carrier;
    const fw_wiring_moved *moved; /* (nmoved) */
    int nmoved;
    double wall_m; /* by how much two walls come nearer than drawn in this flow; 0: as drawn */
    double sag_m;  /* by how much what moves comes down to its carrier at most; 0: not known */
} fw_wiring_asked;

typedef struct fw_wiring_net {
    const char *name; /* "rotor and frame", "stator of comb drive upper" */
    fw_wiring_kind kind;
    int pieces;
    double area_m2;
    bool frame, carrier,
        tethered;        /* has a part of the frame; is one with the carrier; tethers hold a body on
                                      it that is not of it until they are broken */
    fw_geometry_vec2 at; /* a point of its outline */
    bool needed;         /* an actuator puts a potential on it */
    double low_V, high_V; /* against the rotor, over all scenes of the flow */
    bool padded;          /* has room for a contact: the largest square on what is held */
    fw_geometry_box pad;
    const char *pad_on; /* label of the piece */
    bool at_edge;       /* that piece ends at the chip's edge with a track: else it is probed */
} fw_wiring_net;

typedef enum fw_wiring_fault {
    FW_WIRING_FINE,
    FW_WIRING_NOT_DRAWN, /* the drive is not on the mask */
    FW_WIRING_SHORTED,   /* both of its sides are one net */
    FW_WIRING_NO_PAD     /* a side has no room for a contact */
} fw_wiring_fault;

typedef struct fw_wiring_drive { /* of a scene that holds in the flow, each place once */
    const fw_device_comb *comb;
    const char *id;
    int rotor, stator; /* nets; -1: not on the mask */
    double low_V, high_V;
    fw_geometry_vec2 at; /* world; NaN where it is not drawn */
    fw_wiring_fault fault;
    const char *why; /* a sentence: what is wrong, where, what to do; NULL: nothing */
} fw_wiring_drive;

typedef struct
    fw_wiring_gap { /* between two nets, a < b; b = nnet: the handle below the insulator */
    int a, b;
    double m; /* as drawn; 0: they touch */
    fw_geometry_vec2 at[2];
    const char *label[2];
    double moved_m,
        t_s; /* the least over the motions, and when; NaN: none was run, or nothing moves */
    const char *scene;
    double made_m;  /* the lesser of both less what walls come nearer by */
    double least_m; /* likewise of the least that it may be (fw_wiring_moved.low_m) */
    double volts;   /* the largest potential difference that the drives ask for */
    double field_V_per_m;
    /* in air, or of the insulator: from (of the least gap), to (of that as computed); NaN: not known */
    double breakdown_V[2];
} fw_wiring_gap;

typedef struct fw_wiring {
    fw_wiring_carrier carrier;
    fw_wiring_net *net; /* (nnet) rotor first, then stators, then what is held */
    int nnet;
    const fw_layout *layout; /* that they were found in */
    const int *net_of;       /* (npiece) of the layout's pieces; -1: no conductor */
    int npiece;
    fw_wiring_drive *drive; /* (ndrive) */
    int ndrive;
    fw_wiring_gap *gap; /* (ngap) of every pair of nets */
    int ngap;
    double density
        [2]; /* of the air, least and largest over the scenes that put a voltage, over that at 1 atm */
    const char **refusal; /* (nrefusal) sentences: why the flow cannot make the device work */
    int nrefusal;
    const char **open; /* (nopen) what is not guaranteed */
    int nopen;
    const char **remark; /* (nremark) what whoever contacts it should know */
    int nremark;
} fw_wiring;

/* Nets, what is asked of them, pads and gaps of a layout that is drawn. Cost: joints sorted; of every pair of
   nets the pairs of edges whose boxes are nearer than the least distance so far. Refusals are in the
   result; FW_NOMEM and FW_LIMIT are all that fails. */
fw_status fw_wiring_find(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                         const fw_wiring_asked *asked, const fw_wiring **wiring);

/* From where to where air breaks down between conductors `gap_m` apart, V. density: over that at 1 atm and 20 degrees */
void fw_wiring_breakdown(double gap_m, double density, double volts[2]);

/* What the outlines of a mask say of the same nets: pieces are those of the layout, with the contours of the
   mask (count 0: not on it). */
typedef struct fw_wiring_on_mask {
    int nnet;       /* pieces of conductor that hang together there, lettering aside */
    bool same;      /* the same nets as drawn */
    double least_m; /* between two of them; HUGE_VAL: there is only one */
    fw_geometry_vec2 at[2];
    const char *label[2];
    const char *differs; /* a sentence; NULL: nothing does */
} fw_wiring_on_mask;
fw_status fw_wiring_compare(fw_arena *arena, const fw_wiring *wiring, const fw_layout *layout,
                            const fw_geometry_contour *contour, fw_wiring_on_mask *found);

const char *fw_wiring_contact_word(const fw_wiring_net *net); /* "probed", "edge", "none" */
/* where a net is contacted, and what a gap bears, in words */
/* ", or down to 12.6 um with its errors"; "": it is hardly less than computed */
const char *fw_wiring_least_words(char text[64], const fw_wiring_gap *gap);
fw_status fw_wiring_contact_words(fw_arena *arena, const fw_wiring_net *net, const char **out);
fw_status fw_wiring_gap_words(fw_arena *arena, const fw_wiring *wiring, const fw_wiring_gap *gap,
                              const char **out);
/* member "wiring" of an open object; NULL: null */
void fw_wiring_json(const fw_wiring *wiring, fw_json *json);

/* ---- between the files of the room ---- */

/* Which pieces hang together: part[i] is the lowest index of a piece of the same conductor, -1: no conductor.
   contour: of each piece, count 0: not there. Joined are pieces with a common cut, and, where `touching`, those
   whose outlines meet. */
fw_status fw_wiring_parts(fw_arena *arena, const fw_layout *layout,
                          const fw_geometry_contour *contour, bool islands, bool touching,
                          int *part);
bool fw_wiring_conducts(const fw_layout_piece *piece, bool islands);
/* do two outlines share a JOINT? */
bool fw_wiring_share_cut(const fw_geometry_contour *p, const fw_geometry_contour *q);
/* the least distance of two parts, and where, but for tethers and the bodies that they hold; HUGE_VAL: one is not
   there. boxes: (npiece) */
typedef struct fw_wiring_near {
    double m;
    fw_geometry_vec2 at[2];
    int piece[2];
} fw_wiring_near;
fw_wiring_near fw_wiring_least(const fw_layout *layout, const fw_geometry_contour *contour,
                               const fw_geometry_box *box, const int *part, int a, int b);

/* gaps, fields, and what there is to say of them (wiring_gaps.c) */
fw_status fw_wiring_gaps(fw_arena *arena, const fw_layout *layout, const fw_wiring_asked *asked,
                         fw_wiring *w);

/* adds a sentence to a list with room for it; NULL: FW_NOMEM */
fw_status fw_wiring_say(fw_arena *arena, const char ***list, int *n, const char *sentence);
static inline bool fw_wiring_is_driven(const fw_wiring_net *net) {
    return net->low_V < 0.0 || net->high_V > 0.0;
}

#endif
