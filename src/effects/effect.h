/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of the table, one file each. */
#ifndef FW_EFFECTS_EFFECT_H
#define FW_EFFECTS_EFFECT_H
#include "effects/effects.h"
#include <math.h>
#include <string.h>

#define FW_EFFECT(name)              extern const fw_effect_row fw_effect_##name;
#define FW_EFFECT_ELEMENT(name, ...) FW_EFFECT(name)
#include "device/effects.def"
#undef FW_EFFECT_ELEMENT
#undef FW_EFFECT

/* a new element of the loads, zeroed, with memory for its ports; NULL without memory */
fw_effects_force_element *fw_effects_loads_add_element(fw_arena *arena, fw_effects_loads *loads,
                                                       const fw_effects_element_class *class_,
                                                       int ports);
fw_effects_friction *fw_effects_loads_add_friction(fw_arena *arena, fw_effects_loads *loads);

/* the entry of a pin, made on first use */
fw_effects_torsion *fw_effects_loads_torsion(const fw_mechanism *mechanism, fw_effects_loads *loads,
                                             int pin);
/* of a prismatic joint, made on first use */
fw_effects_slide *fw_effects_loads_slide(fw_effects_loads *loads, int joint);
/* How one drive may stand within the envelope, and how its forces push */
typedef struct fw_effects_comb_reach {
    double aside_m, along_m; /* across it and along it, both bodies against each other */
    double tilt_rad, half_m; /* half of the length that faces the other */
    double square_V2, turns; /* of the voltage at most; of its square's law */
} fw_effects_comb_reach;
bool fw_effects_comb_drives(const fw_device_comb *drive);
int fw_effects_comb_count(const fw_effect_case *c); /* that drive */
fw_effects_comb_reach fw_effects_comb_reaches(const fw_effect_case *c, const fw_device_comb *from,
                                              const fw_effects_comb_element *drive);
/* += of a force along, one across and a couple between the two bodies, of either sign: (3 nbody) */
void fw_effects_comb_push(const fw_effect_case *c, const fw_device_comb *from, double along_N,
                          double across_N, double couple_Nm, double *force);
/* the electrodes of a drive, without their fringe: element.c */
fw_effects_comb_element fw_effects_comb_as_drawn(const fw_effect_case *c,
                                                 const fw_device_comb *from);
/* what the drawing and the geometry say of a flexure suffices for its law at finite rotation */
bool fw_effects_hinge_is_known(const fw_mechanism_hinge *hinge);
/* its pin is no constraint any more: an element stands for it (once, however often it is asked for)
 */
fw_status fw_effects_hinge_release(const fw_effect_case *c, fw_effects_loads *loads, int hinge);
/* those that act as they are in this scene */
bool fw_effects_hinge_flexes(const fw_effect_case *c, int hinge);
fw_status fw_effects_hinges_flex(const fw_effect_case *c, fw_effects_loads *loads);
/* the bound of nonlinear-hinge; *why: NULL, or why there is none */
fw_status fw_effects_hinge_give_bound(const fw_effect_case *c, double *value, const char **why);
/* m: W of b from W of a at most, of a pin of a valid envelope */
double fw_effects_hinge_give_most(const fw_effect_case *c, int pin);
/* all that were released so far have their stiffness times 1 + part + varying law(t); law NULL:
   the same at all times. Once for each set of loads */
fw_status fw_effects_hinges_warm(fw_arena *arena, fw_effects_loads *loads, double part,
                                 double varying, const fw_quantity_law *law);
/* all flexures, pins or released, have their stiffness times 1 + part, and that against forces times 1 + along besides,
   before anything is made exact (fw_effect_choice) */
fw_status fw_effects_hinges_stiffer(const fw_effect_case *c, fw_effects_loads *loads, double part,
                                    double along);
/* the closed forms among the elements become exact beams, in a copy of the elements */
fw_status fw_effects_hinges_exact(fw_arena *arena, const fw_mechanism *mechanism,
                                  fw_effects_loads *loads);
/* hinge of a contact between conjugate surfaces, NULL: none; how far W may move freely, 0: not
   known; false: no gap closes within the motion */
const fw_mechanism_hinge *fw_effects_contact_hinge(const fw_mechanism *mechanism,
                                                   const fw_device_contact_use *use);
double fw_effects_contact_gap(const fw_effect_case *c, const fw_device_contact_use *use,
                              const fw_mechanism_hinge *hinge);
bool fw_effects_contact_may_touch(const fw_effect_case *c);
/* this pin's damper comes from the scene's <material-damping>: joint-damping has nothing to add */
bool fw_effects_material_damped(const fw_effect_case *c, int pin);
/* loss factor of the flexures: the scene's, else the material's; NaN: not known */
double fw_effects_loss(const fw_effect_case *c);
/* N/m: conforming cylinders, convex radius and gap, pressed by `force`: contact.c */
double fw_effects_line_contact(double youngs_Pa, double poisson, double depth_m, double radius_m,
                               double gap_m, double force_N);
static inline bool fw_pin_has_stop(const fw_mechanism_pin *p) {
    return p->stop_stiffness_Nm_per_rad > 0 && (!isnan(p->stop_min_rad) || !isnan(p->stop_max_rad));
}
/* a cable that is not stretched in the drawn pose */
bool fw_effects_spring_slack(const fw_mechanism *mechanism, const fw_device_spring *spring);
/* while loads are put together: does the effect of this id act in the scene? */
static inline bool fw_effects_act(const fw_effect_case *c, const char *id) {
    for (int i = 0; c->ledger && i < c->ledger->count; i++)
        if (strcmp(c->ledger->item[i].id, id) == 0) return c->ledger->item[i].active;
    return !c->ledger;
}
/* of the layer's own lengths where the law of the temperature is 1; NaN: not known */
double fw_effects_layer_expands(const fw_mechanism *m, const fw_device_temperature *t);
/* A length that is not of the layer (of a bead, a spring, a cable), in lengths of the layer, over what it is in metres where
   nothing is warm: temperature.c */
typedef struct fw_effects_foreign {
    double own, grown;           /* relative growth of it and of the layer, for good */
    double varying_own, varying; /* likewise where the law is 1, besides */
    const fw_quantity_law *law;  /* NULL: it stays as it is */
} fw_effects_foreign;
fw_effects_foreign fw_effects_foreign_of(const fw_effect_case *c, double expansion_per_K);
/* that factor, and its rate in 1/s where that is not NULL; piece_s as of fw_quantity_law_value */
double fw_effects_foreign_at(const fw_effects_foreign *f, double t_s, double piece_s, double *rate);
/* the farthest that the factor is from 1 in the scene */
double fw_effects_foreign_most(const fw_effects_foreign *f, double end_s);
/* how much of the distance of a contact is of something that is placed, m: contact.c */
double fw_effects_contact_placed(const fw_mechanism *m, const fw_device_contact_use *use);
/* a spring between two points as an element; of: its rest length under heat with a law, or NULL, at once in series with what
   its bodies give: body_compliance.c */
fw_status fw_effects_spring_element(const fw_effect_case *c, fw_effects_loads *loads,
                                    const fw_device_spring *spring, const fw_effects_foreign *of);
/* the scene has such a length */
bool fw_effects_foreign_in(const fw_effect_case *c);
/* places are asked for or drawn: a free strain moves those by itself, which no bound of what hinges turn by knows of */
bool fw_effects_places_count(const fw_effect_case *c);
/* no loads yet, with room for everything that mechanism and scene can ask for */
fw_status fw_effects_loads_new(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene, fw_effects_loads *loads);

/* ---- flexures that are no pins: closed form and exact beam (hinge_element.c) ---- */

typedef struct fw_effects_exact fw_effects_exact;

/* where the ports are as a flexure sees them, and what the closed form said there last: force, energy and validity ask for
   one pose in turn, and the hinges of a model are worked out side by side before (nonlinear_hinge.c) */
typedef struct fw_effects_bent {
    bool known;
    double p[6];           /* of the ports */
    double c, n, x, y, th; /* of psi, and e.D, n.D = w, v; the rotation (hinge_element.c) */
    fw_flexure_hinge_bent law;
} fw_effects_bent;

typedef struct fw_effects_flexed { /* data of an element; ports: pin on body a, pin on body b */
    fw_flexure_hinge_law law;
    double sense;               /* o: 1 where body a has the root at polar angle -a, else -1 */
    double axis_rad, free_rad;  /* axis less half of the drawn turns */
    double loss_s[2];           /* tau along and across the axis */
    double factor, varying;     /* U times factor + varying law(t): temperature */
    double along;               /* stiffer by that share against forces than described */
    fw_flexure_hinge_rest rest; /* what does not depend on the rotation */
    fw_effects_bent *last;      /* of this law, whatever it is multiplied by */
    fw_effects_exact *exact;    /* NULL: closed form */
} fw_effects_flexed;

static inline bool fw_effects_bent_at(const fw_effects_bent *b, const double *p) {
    return b->known && memcmp(b->p, p, sizeof b->p) == 0;
}
/* all but the law's */
static inline void fw_effects_flexed_place(const fw_effects_flexed *f, const double *p,
                                           fw_effects_bent *b) {
    const double *pa = p, *pb = p + 3;
    const double psi = f->axis_rad + 0.5 * (pa[2] + pb[2]), c = cos(psi), n = sin(psi);
    const double dx = pb[0] - pa[0], dy = pb[1] - pa[1];
    memcpy(b->p, p, sizeof b->p);
    b->c = c, b->n = n, b->x = c * dx + n * dy, b->y = c * dy - n * dx;
    b->th = pb[2] - pa[2] - f->free_rad;
}
static inline bool fw_effects_flexed_loses(const fw_effects_flexed *h) {
    return h->loss_s[0] > 0 || h->loss_s[1] > 0;
}
extern const fw_effects_element_class fw_effects_flexed_class;

bool fw_effects_exact_is_known(const fw_mechanism_hinge *hinge);
/* along: a strip that stretches 1 + this times less */
fw_status fw_effects_exact_new(fw_arena *arena, const fw_mechanism_hinge *hinge, double along,
                               fw_effects_exact **out);
extern const fw_effects_element_class fw_effects_exact_class;
extern const double fw_effects_exact_tolerance; /* relative, of its forces */

/* How a choice of level enters the decision on effects (hinge_source.c). */

/* this effect is in or out because of the level asked for, whatever else is asked */
bool fw_effects_hinge_forced(const char *effect, fw_effects_hinge_model asked, bool *in);
const char *fw_effects_hinge_forced_reason(const fw_effect_choice *choice);
/* after everything was added: fills ledger->hinge, makes beams of closed forms where asked for */
fw_status fw_effects_hinge_settle(const fw_effect_case *c, const fw_effect_choice *choice,
                                  fw_effect_ledger *ledger, fw_effects_loads *loads);

/* ---- air.c, squeeze_film.c, and their tests ---- */

typedef struct fw_effects_gas { /* dry air, or what the scene states of it */
    double pressure_Pa, temperature_K, viscosity_Pas, density_kg_per_m3;
    double path_m; /* mean free path */
} fw_effects_gas;

/* Sutherland's law for dry air, 170 K to 1900 K within 2 %: 1.458e-6 T^1.5/(T + 110.4) */
double fw_effects_air_viscosity(double temperature_K);
fw_effects_gas fw_effects_gas_of(const fw_device_air *air);

typedef struct fw_effects_damper { /* of a body: force by speed, couple by angular speed */
    double force_Ns_per_m, couple_Nms;
} fw_effects_damper;

typedef struct fw_effects_face { /* of a body seen from above */
    double area_m2, polar_m4, perimeter_m;
} fw_effects_face;
/* stated, or as drawn; area NaN where neither is known */
fw_effects_face fw_effects_air_face(const fw_mechanism *mechanism, const fw_device_air *air,
                                    int body);

/* film of `gap` between the face of a body and the ground below it */
fw_effects_damper fw_effects_air_slide(const fw_effects_gas *gas, const fw_effects_face *face,
                                       double gap_m);

/* open air around a thin body that moves in its own plane */
fw_effects_damper fw_effects_air_drag(const fw_effects_gas *gas, const fw_effects_face *face);

/* film between two walls that approach each other */
typedef struct fw_effects_squeeze {
    double c0_Nsm2; /* coefficient times gap^3, without rarefaction */
    double path_m;
    double angle_rad; /* of the normal, towards `against`, in its frame */
    double least_m;   /* below this gap the coefficient stays as it is there */
} fw_effects_squeeze;
/* integral of the solution of -laplace u = 1, u = 0 around, over a x b, m4 */
double fw_effects_rectangle_integral(double a_m, double b_m);
fw_effects_squeeze fw_effects_air_squeeze(const fw_effects_gas *gas, double length_m,
                                          double depth_m, double gap_m);
/* coefficient at a gap, N s/m, and its derivative by the gap (may be NULL) */
double fw_effects_squeeze_at(const fw_effects_squeeze *film, double gap_m, double *slope);
double fw_effects_air_depth(const fw_mechanism *mechanism,
                            const fw_device_air *air); /* NaN: not known */
/* its element; what it pushes with at most within the envelope: force (3 nbody) +=, false: nothing bounds that */
fw_status fw_effects_squeeze_add(const fw_effect_case *c, fw_effects_loads *loads,
                                 const fw_device_air *air);
bool fw_effects_squeeze_push(const fw_effect_case *c, const fw_device_air *air, double *force);
/* K(i omega) of the gas as it is compressed and flows, N/m, and by how much the damper alone is off it */
double fw_effects_squeeze_lacks_N_per_m(const fw_effects_gas *gas, double length_m, double depth_m,
                                        double gap_m, double omega_per_s, double stiffness[2]);
/* what the films of a scene lack as dampers: the share of what is seen by which a value may be off; words: NULL, nothing */
fw_status fw_effects_squeeze_lacking(const fw_effect_case *c, double *share, const char **words);

/* ---- ends of fingers (element.c) ---- */

/* of the gap: as near to the other comb's root as the law of tips goes */
#define FW_EFFECTS_COMB_NEAREST_ROOT 0.2
/* Edges act on what ends of fingers have far from the root, and on what the root adds, by so much of what they do at faces:
   solutions in space of fingers of 8 um with gaps of 10, 10 to 50 um deep (docs/theory/effects/comb-drive.md) */
#define FW_EFFECTS_COMB_EDGE_AT_ENDS 1.42
#define FW_EFFECTS_COMB_EDGE_AT_ROOT 0.3
#endif
