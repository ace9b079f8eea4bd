/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One file per effect: is it called for by the scene, how far can it move the answer, and its
   force. An effect is active when the scene calls for it, unless it is among those with the
   smallest bounds, whose sum stays below the accuracy wanted.
   The list of active effects is compiled once per scene; an absent one costs nothing. */
#ifndef FW_EFFECTS_EFFECTS_H
#define FW_EFFECTS_EFFECTS_H
#include "base/diag.h"
#include "device/device.h"
#include "mechanism/mechanism.h"
#include <stdarg.h>

/* ---- force elements ---- */

/* A force element: forces between points of bodies as a function of where the points are, how their
   bodies are turned, how both move, and time. One class per effect that needs more than the plain
   springs, dampers and loads of fw_effects_loads; its whole physics is in one file of this room.
   Everything in SI and world axes.

   A class knows nothing of arms, masses, joints, scaling or other elements: multibody/ takes its
   ports to where the bodies are and its forces and tangents to the equations of motion.

   What every class must satisfy (test: test_elements.c, on random states):
     power balance    f . w = -dE/dt - power[0] + power[1],   power[0] >= 0
     tangent          stiffness = -df/dp, damping = -df/dw
     equilibrium      forces and moments of all ports, the ground's included, add up to nothing
                      (not those of fields from outside, such as drag of the air) */

typedef struct fw_effects_port { /* a point of a body: local, of the ground: world */
    int body;
    double x_m, y_m;
} fw_effects_port;

typedef struct fw_effects_port_state { /* what an element sees */
    double t_s, piece_s;               /* for fw_quantity_law_value(law, t_s, piece_s, ...) */
    /* what actuation is multiplied by: 1, in statics the load factor s (of pulls, draws and squared voltages) */
    double load;
    /* (3 ports) x, y in m from an origin common to all ports, and the turn of its body in rad */
    const double *p;
    const double *w; /* (3 ports) their velocities */
    const bool *on;  /* (switches) held during a step, changed by events */
    bool still;      /* an equilibrium: laws have their values there, but no rates */
} fw_effects_port_state;

typedef struct fw_effects_force_element fw_effects_force_element;
/* of a port: 0 but for those of flexures */
fw_geometry_vec2 fw_effects_element_root(const fw_effects_force_element *element, int port);

typedef struct fw_effects_element_class {
    const char *effect; /* id of its row in the ledger */
    bool closed_form;   /* of a flexure: where it does not hold an exact beam may */
    bool beam;          /* such an exact beam */
    bool electrodes;    /* driven by voltages, which have a factor of their own in statics */
    /* f (3 ports): force on the port and couple on its body; overwritten */
    void (*force)(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f);
    /* (3 ports x 3 ports) row-major, overwritten: -df/dp and -df/dw */
    void (*tangent)(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping);
    double (*energy)(const fw_effects_force_element *e,
                     const fw_effects_port_state *s); /* stored, J; NULL: none */
    /* W: [0] taken away for good, [1] fed in from outside (laws); NULL: none of both */
    void (*power)(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double power[2]);
    /* > 0: switch i should be on. Continuous; does not look at s->on. NULL without switches */
    double (*switch_value)(const fw_effects_force_element *e, const fw_effects_port_state *s,
                           int i);
    /* df/d load (3 ports), overwritten; NULL: it does not depend on it */
    void (*slope)(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f);
    /* false: the state is one that the formula does not hold for (an electrode that touches); *why
       says so and what to do. NULL: it always holds */
    bool (*valid)(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  const char **why);
    /* the force with which its surfaces press on each other, N; NULL: none */
    double (*pressing)(const fw_effects_force_element *e, const fw_effects_port_state *s);
} fw_effects_element_class;

enum { FW_ELEMENT_LAWS = 2 };
struct fw_effects_force_element {
    /* a strain of its body moves either of the first two ports as it does the point this far from it
       (fw_mechanism_pin); else 0 */
    fw_geometry_vec2 root_m[2];
    const fw_effects_element_class *class_;
    const char *id; /* for messages */
    fw_place place;
    fw_effects_port *port; /* (ports) */
    int ports, switches;
    const fw_quantity_law *law[FW_ELEMENT_LAWS]; /* (laws) integration stops at their breaks */
    int laws;
    int pin; /* the pin that it stands for (released), or FW_NONE: its force on its last port's body is that pin's reaction */
    bool dissipates, works; /* its power[0], power[1] can be other than 0 */
    double size_N_per_m;    /* of its stiffness, for the choice of scales; 0: none */
    double force_N;         /* of its largest force that is not elastic, likewise */
    const void *data;       /* the class's own */
};

/* The error of a run that came to where an element's formula does not hold, FW-D242; `at`: where in
   the run, `why`: of its `valid`. FW_SOLVER, or FW_NOMEM */
fw_status fw_effects_element_ended(const fw_effects_force_element *e, const char *scene,
                                   const char *at, const char *why, fw_diags *diags);
/* where the ports are, from body poses q (3 nbody) and velocities v (3 nbody; NULL: at rest), SI */
void fw_effects_element_place_ports(const fw_effects_force_element *e, const double *q,
                                    const double *v, double *p, double *w);
/* generalised forces (3 nbody): += those of f (3 ports) at poses q */
void fw_effects_element_add_forces(const fw_effects_force_element *e, const double *q,
                                   const double *f, double *force);
/* where entries of a matrix go: into a dense one (n x n, row-major), or to whoever takes them */
typedef struct fw_effects_matrix {
    int n;
    double *dense;
    void (*add)(void *to, int row, int column, double value);
    void *to;
} fw_effects_matrix;
static inline void fw_effects_matrix_add(const fw_effects_matrix *m, int row, int column,
                                         double value) {
    if (m->dense)
        m->dense[(size_t)row * (size_t)m->n + (size_t)column] += value;
    else
        m->add(m->to, row, column, value);
}
/* generalised stiffness and damping of 3 nbody coordinates (damping may be NULL): += J^T K J and the
   turning of the arms under f */
void fw_effects_element_spread(const fw_effects_force_element *e, const double *q, const double *v,
                               const double *f, const double *stiffness, const double *damping,
                               const fw_effects_matrix *whole_stiffness,
                               const fw_effects_matrix *whole_damping);

/* ---- effects ---- */

typedef enum fw_effect_mode {
    FW_EFFECTS_AUTO,
    FW_EFFECTS_ALL,
    FW_EFFECTS_NONE,
    FW_EFFECTS_LIST,
    FW_EFFECTS_WHOLE /* all, without having been asked for: equilibria and modes for auto */
} fw_effect_mode;
/* How flexures enter the mechanism, the cheapest first. AUTO: pins where the bound on what they change is below the accuracy,
   else compliance, and elastica where the step there is computed to change more than the accuracy (statics/statics.h). */
typedef enum fw_effects_hinge_model {
    FW_HINGE_AUTO,
    FW_HINGE_REVOLUTE,   /* pins at the elastic centres */
    FW_HINGE_COMPLIANCE, /* three degrees of freedom at finite rotation in closed form (finite.h) */
    FW_HINGE_ELASTICA    /* geometrically exact beams (beam.h) */
} fw_effects_hinge_model;
size_t fw_effects_hinge_model_count(void);
const char *fw_effects_hinge_model_text(fw_effects_hinge_model model);
const char *fw_effects_hinge_model_summary(fw_effects_hinge_model model); /* for forms */

typedef struct fw_effect_choice {
    fw_effect_mode mode;
    const char *list;             /* comma separated ids, for FW_EFFECTS_LIST */
    fw_effects_hinge_model hinge; /* other than AUTO: whatever the mode says of nonlinear-hinge */
    double below; /* > 0: auto came to this level because the one below was off by so much */
    const char *below_of; /* of what; NULL: of the largest hinge angle */
    bool pins_first;      /* hinge is REVOLUTE because pins are tried before anything else */
    bool ended;     /* hinge is ELASTICA because the closed form does not hold where this leads */
    bool elsewhere; /* likewise, because exact beams may rest elsewhere */
    bool untold;    /* nobody reads bounds: those that decide nothing are not found */
    /* All flexures have 1 + `stiffer` times their stiffness, as if their modulus had (0: as described), and beside that 1 + `along`
       times their stiffness against forces: of leaves along the strip alone */
    double stiffer, along;
    const struct fw_effect_ledger *like; /* of a device much like this one, or NULL: what acts there
                                            by far is taken to act here without finding its bound */
} fw_effect_choice;

typedef struct fw_effects_hinge_use { /* how the hinges were taken */
    fw_effects_hinge_model used;
    const char *why; /* NULL: there are no hinges */
    double error;    /* computed change of the largest hinge angle by the next level, relative; of
                        the elastica what its solver tells; NaN: not computed */
    bool pins_first; /* pins with stated stiffnesses, tried before anything else */
} fw_effects_hinge_use;

typedef struct fw_effect_entry { /* a line of the ledger */
    const char *id;
    bool called_for, active;
    /* on the relative change of the peak hinge deflection when left out, inf when the effect is the motion; instructions per
       right-hand side when it is on, as measured once (docs/theory/effects/costs.md). 0 when it is not called for. open: by what
       share what no motion has may change forces, where nothing bounds it */
    double bound, cost, open;
    const char *reason;
    const char *looked_at; /* why auto keeps it whatever its bound is (fw_effect_row); or NULL */
} fw_effect_entry;
typedef struct fw_effect_ledger {
    fw_effect_entry *item; /* (count) */
    int count;
    double left_out; /* sum of the bounds of what auto left out; 0 where the choice was asked for */
    /* likewise of what no motion has, whatever was asked for; where nothing bounds it, and it is small, twice the share by which
       it may change forces; what those do at most that are bounded alone */
    double beside, beside_rad;
    double rubs; /* share by which they change the tension of a cable that bends */
    /* What no motion has, matters and nothing bounds, a sentence; what the formula of an active effect leaves out, a clause,
       which is in every band; NULL: nothing. By which they may change forces; of what is seen */
    const char *undecided, *lacking;
    double undecided_share, lacking_share;
    /* share of the largest deflection that what is looked at by its velocity moves: the bound of inertia where auto keeps
       it for that; else infinite */
    double swing;
    fw_effects_hinge_use hinge;
} fw_effect_ledger;
/* ---- what acts, compiled to plain arrays in SI; an absent effect leaves no entry behind ---- */
typedef struct fw_effects_torsion { /* per pin with a spring or damper */
    int pin, body_a, body_b;
    double stiffness_Nm_per_rad, damping_Nms_per_rad, free_angle_rad;
} fw_effects_torsion;

typedef struct fw_effects_point_load { /* constant force in world axes at a point of a body */
    int body;
    double x_m, y_m, fx_N, fy_N;
} fw_effects_point_load;

typedef struct fw_effects_timed_load { /* force and torque in world axes times a law */
    int body;
    double x_m, y_m, fx_N, fy_N, torque_Nm;
    const fw_quantity_law *law;
} fw_effects_timed_load;

typedef struct
    fw_effects_stop { /* pushes back where side * (angle - at) > 0; angle as of the pin */
    int pin, body_a, body_b;
    double side, at_rad, free_angle_rad, stiffness_Nm_per_rad, damping_Nms_per_rad;
} fw_effects_stop;

typedef struct fw_effects_slide { /* spring and damper along a prismatic joint */
    int joint;
    double stiffness_N_per_m, damping_Ns_per_m;
} fw_effects_slide;

/* Coulomb friction along one coordinate: the angle of a pin or the travel of a prismatic joint. It
   sticks while |Q| <= mu_s N r at rest and slides with Q = -mu_k N r sign(rate), r: radius (travel:
   1). N = preload + the force of what presses: a contact element, or else the joint's own force. */
typedef struct fw_effects_friction {
    int pin, joint; /* one of them, the other FW_NONE */
    int element;    /* index of the contact that presses, or FW_NONE: the joint's reaction */
    double static_coefficient, kinetic_coefficient, radius_m, preload_N;
    const char *id;
    fw_place place;
} fw_effects_friction;

/* The ground that stretches with time: its points stand at p + strain law(t) (p - centre). */
typedef struct fw_effects_stretch {
    double strain;
    fw_geometry_vec2 centre_m;
    const fw_quantity_law *law; /* NULL: nothing of the kind */
    double grown;               /* by how much the layer's own lengths grow where the law is 1 */
} fw_effects_stretch;

typedef struct fw_effects_loads {
    int nbody;
    double *constant;             /* (3 nbody) force on the centre of mass, torque */
    double *velocity;             /* (3 nbody) initial velocities as the scene states them */
    fw_effects_torsion *torsion;  /* (ntorsion) */
    int *torsion_of;              /* (npin) 1 + index in torsion; 0: none */
    fw_effects_point_load *load;  /* (nload) off the centre of mass */
    fw_effects_timed_load *timed; /* (ntimed) */
    fw_effects_stop *stop;        /* (nstop) */
    fw_effects_slide *slide;      /* (nslide) */
    int *slide_of;                /* (njoint) likewise in slide */
    fw_device_spring *spring;     /* (nspring) */
    int ntorsion, nload, ntimed, nstop, nslide, nspring;
    fw_effects_force_element *element; /* (nelement) see effects.h */
    bool *released; /* (npin) the pin is not a constraint: an element stands for it */
    fw_effects_friction *friction; /* (nfriction) */
    int nelement, nfriction, nreleased;
    /* free strains, from fabrication or temperature, that act from the start on: arms of every body
       and, last, of the ground are longer by it (fw_mechanism_strained) */
    double *strain; /* (nbody + 1) */
    bool strained;
    double grown; /* of that, by how much the layer's own lengths have grown */
    fw_effects_stretch stretch;
    bool quasi_static; /* inertia is left out: the motion is a sequence of equilibria */
} fw_effects_loads;

struct fw_effects_envelope;
typedef struct fw_effect_case { /* what an effect is asked about */
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    const struct fw_effects_envelope *envelope; /* envelope.h: how large the motion can become */
    fw_diags *diags;                            /* NULL: mistakes are not reported, only returned */
    const fw_effect_ledger *ledger; /* while loads are put together: what acts; NULL: all */
} fw_effect_case;

/* ---- the scene in words, and less of it ---- */

/* Where a row writes its part of the sentence about a scene. The format is that of reports
   (report/report_page.h): {s} text, {u} a value and its SI unit, {n} a number, {i} a whole one. */
typedef struct fw_effects_words {
    void (*write)(void *context, const char *format, va_list arguments);
    void (*write_law)(void *context,
                      const fw_quantity_law *law); /* " times a ramp over 2 ms"; nothing for NULL */
    void *context;
} fw_effects_words;
static inline void fw_effects_say(const fw_effects_words *words, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    words->write(words->context, format, arguments);
    va_end(arguments);
}
static inline void fw_effects_say_law(const fw_effects_words *words, const fw_quantity_law *law) {
    words->write_law(words->context, law);
}

typedef struct fw_effects_load { /* something that a scene can be given less of */
    const char *name;            /* "tendon pulls" */
    bool ordinary; /* a force or torque: goes without saying where there is nothing else */
    bool squared;  /* forces go with its square: a voltage */
} fw_effects_load;
typedef struct fw_effects_load_scaling {
    fw_effects_load item[16]; /* (count) */
    int count;
} fw_effects_load_scaling;
static inline void fw_effects_add_load(fw_effects_load_scaling *loads, fw_effects_load load) {
    size_t room = sizeof loads->item / sizeof loads->item[0];
    if ((size_t)loads->count < room) loads->item[loads->count++] = load;
}

/* one attribute of a scene's element that goes with its loads, as a path of --set names it */
typedef struct fw_effects_load_value {
    const char *element, *id; /* "tendon", "TL"; id NULL: `number` says which */
    int number;               /* among those of this name in the scene, from 1 */
    const char *attribute;
    const char *unit; /* SI */
    double value;
    bool squared; /* forces go with its square */
} fw_effects_load_value;
typedef struct fw_effects_load_values {
    fw_effects_load_value item[64]; /* (count) */
    int count;
    bool more; /* than there is room for */
} fw_effects_load_values;
/* what is 0 stays so, whatever it is multiplied by: it is left out */
static inline void fw_effects_add_load_value(fw_effects_load_values *values,
                                             fw_effects_load_value value) {
    size_t room = sizeof values->item / sizeof values->item[0];
    if (value.value == 0) return;
    if ((size_t)values->count < room)
        values->item[values->count++] = value;
    else
        values->more = true;
}

/* What a mechanism made of solids (continuum/device_deck.c) does with an effect that the scene calls for */
typedef enum fw_effects_solid {
    FW_EFFECTS_SOLID_REFUSED, /* nothing is written: without the effect it would be another device */
    FW_EFFECTS_SOLID_HAS,     /* the solids have it, or the writer gives it to them */
    FW_EFFECTS_SOLID_NO_PART  /* it has no part in an equilibrium under the loads at the end */
} fw_effects_solid;

typedef struct fw_effect_row { /* one row per effect: adding one is one file and one row */
    const char *id, *summary;
    bool (*called_for)(const fw_effect_case *c);
    /* conservative bound on the relative change when left out; *reason says how it was found */
    fw_status (*bound)(const fw_effect_case *c, double *bound, const char **reason);
    /* *why: something that the device looks at goes by what the bound says nothing of, and auto
       keeps the effect however small that is; left alone where nothing does. NULL: nothing can */
    fw_status (*looked_at)(const fw_effect_case *c, const char **why);
    /* adds to the loads; sizes of the plain arrays were reserved */
    fw_status (*add)(const fw_effect_case *c, fw_effects_loads *loads);
    bool adds_blindly; /* whatever the envelope is: that of what is kept need not be found first */
    /* for what acts until it is left out: changes the loads when the effect was called for and is
       not active. NULL: nothing is to be done */
    fw_status (*leave_out)(const fw_effect_case *c, fw_effects_loads *loads);
    double cost; /* instructions per right-hand side and instance (callgrind, gcc -O2) */
    int (*count)(const fw_effect_case *c); /* instances; NULL: 1 */
    /* of an active effect, before add: errors and warnings on what is asked of it; NULL: none */
    fw_status (*check)(const fw_effect_case *c, fw_diags *diags);
    /* of what is not called for: a warning where the scene states it all the same; NULL: nothing calls for it else */
    void (*idle)(const fw_effect_case *c, fw_diags *diags);
    bool calms; /* left out by auto only where hinges are pins: those that give vibrate on without
                   it, and every step has to follow them */
    /* of what is called for: puts behind the reason, in every mode, what a reader has to know; NULL: nothing */
    fw_status (*note)(const fw_effect_case *c, const char **reason);
    bool by_rate;         /* acts on velocities only: it has no part in an equilibrium */
    bool unbounded_stays; /* not left out where its bound is infinite, whatever was asked for */
    bool alone_stays;     /* likewise where nothing else moves the mechanism */
    bool kept;    /* never left out, whatever was asked for: without it there is nothing to judge */
    bool passive; /* of what is kept: springs, which move nothing by themselves */
    /* no motion has it: never active, whatever was asked for, and its bound is in every error. share: of what it
       changes the forces, for where nothing bounds what that does; NULL: it is in the motion */
    fw_status (*beside)(const fw_effect_case *c, double *share);
    /* of such an effect whose forces are what they are however far the motion goes: by how many rad all of it may turn a
       hinge further (infinite: nothing bounds that), and by what share it changes a tension; NULL: its bound is one of others */
    fw_status (*alone)(const fw_effect_case *c, double *rad, double *share);
    /* of what acts: what its own formula leaves out of it, as a share of what is seen by which values may be off, in every band,
       and in words (NULL: nothing); the member NULL: nothing */
    fw_status (*lacking)(const fw_effect_case *c, double *share, const char **words);
    /* its part of the sentence about a scene, each item behind "; "; NULL: nothing that the scene states */
    void (*describe)(const fw_device *device, const fw_device_scene *scene,
                     const fw_effects_words *words);
    /* what of it advice may ask for less of; scale makes the forces of a copy `by` times as large;
       values: the attributes that it would change. All or none */
    void (*loads)(const fw_device_scene *scene, fw_effects_load_scaling *loads);
    void (*scale)(fw_device_scene *scene, double by);
    void (*values)(const fw_device_scene *scene, fw_effects_load_values *values);
    fw_effects_solid solid;
} fw_effect_row;
/* `add` of an effect that moves nothing in the plane, active or not: it is judged, or bounded, beside the motion */
fw_status fw_effects_add_nothing(const fw_effect_case *c, fw_effects_loads *loads);
const fw_effect_row *const *fw_effect_rows(size_t *count);
/* what all rows say of a scene: words, loads, and scaled loads (false: there is nothing to scale) */
void fw_effects_describe(const fw_device *device, const fw_device_scene *scene,
                         const fw_effects_words *words);
void fw_effects_find_loads(const fw_device_scene *scene, fw_effects_load_scaling *loads);
bool fw_effects_scale(fw_device_scene *scene, double by);
/* the attributes that this changes */
void fw_effects_find_load_values(const fw_device_scene *scene, fw_effects_load_values *values);

/* decides and compiles. Auto leaves effects out, the smallest bound first, while the sum of their
   bounds stays below the accuracy; none and lists leave out what is not kept. A list with an
   unknown id is FW_USAGE (FW-D110 names the known ones). */
fw_status fw_effects_compile(fw_arena *arena, const fw_mechanism *mechanism,
                             const fw_device_scene *scene, const fw_effect_choice *choice,
                             double accuracy, fw_diags *diags, fw_effect_ledger *ledger,
                             fw_effects_loads *loads);

/* A copy of the loads with the hinges taken one level above `used`: pins released, or closed forms
   as exact beams, springs and dampers with them. *next: that level, or `used` where there is none
   (elastica, no hinge that could) */
fw_status fw_effects_hinges_up(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene, const fw_effects_loads *loads,
                               fw_effects_hinge_model used, fw_effects_loads *up,
                               fw_effects_hinge_model *next);

/* nonlinear_hinge.c: the closed forms among the elements (n) side by side. What their forces, energies and powers will ask for at
   the ports p (3 each, of all elements in turn) is worked out at once, to the bits of each alone. NULL: fewer than two */
typedef struct fw_effects_beside fw_effects_beside;
fw_status fw_effects_beside_new(fw_arena *arena, int n, const fw_effects_force_element *e,
                                fw_effects_beside **out);
void fw_effects_beside_bend(fw_effects_beside *beside, const double *p);

/* Before a motion: exact beams answer from lattices of their solutions (flexure/finite.h), taken from
   the arena; NULL, after it: each by itself again */
fw_status fw_effects_hinges_follow(fw_arena *arena, const fw_effects_loads *loads);
extern const double fw_effects_followed_error; /* relative, of their forces then */

/* the ledger of equilibria: neither inertia nor what acts on velocities has a part in them */
void fw_effects_in_equilibrium(fw_effect_ledger *ledger);
/* a copy in the arena that the arrays are in; NULL: out of memory */
const fw_effects_loads *fw_effects_loads_keep(fw_arena *arena, const fw_effects_loads *loads);

/* The mechanism that the loads act on: `mechanism` itself, or where they hold strains one with
   those strains, whose pose is to be assembled again; points in the loads (forces, springs, ports)
   follow. Once after each fw_effects_compile. */
fw_status fw_effects_strain(fw_arena *arena, const fw_mechanism *mechanism, fw_effects_loads *loads,
                            const fw_mechanism **strained);
/* Under free strains the model counts in lengths of the layer, about the mean of the ground's points. What is told of places is
   what masks, other chips and microscopes see, which stay with the substrate. */
typedef struct fw_effects_growth {
    fw_geometry_vec2 centre_m;
    double ground, ground_per_s; /* strain of the ground's points against the layer, and its rate */
    double grown, grown_per_s;   /* of the layer's own lengths */
} fw_effects_growth;
/* Strain of the ground's points against the layer: by all heat of a scene its least and its most, from before anything is warm
   to the largest changes; by stress, which stays; and the largest relative change of the modulus by heat */
void fw_effects_heat_strains(const fw_mechanism *mechanism, const fw_device_scene *scene,
                             double strain[2]);
double fw_effects_stress_strain(const fw_mechanism *mechanism, const fw_device_scene *scene);
double fw_effects_softened(const fw_mechanism *mechanism, const fw_device_scene *scene);
static inline bool fw_effects_has_growth(const fw_effects_loads *loads) {
    return loads && (loads->strained || loads->stretch.law);
}
/* still: laws have their values, but no rates */
fw_effects_growth fw_effects_growth_at(const fw_mechanism *mechanism, const fw_effects_loads *loads,
                                       double t_s, double piece_s, bool still);
/* Of a place or displacement as the model has it: beside the point of the substrate which is drawn there, in metres */
fw_geometry_vec2 fw_effects_beside_substrate(const fw_effects_growth *growth,
                                             fw_geometry_vec2 place_m, fw_geometry_vec2 drawn_m);
/* places of bodies (3 nbody, out may be q) in a world in which the substrate stays as it is drawn; what bodies are
   longer by there, relative */
double fw_effects_on_substrate(const fw_effects_growth *growth, int nbody, const double *q,
                               double *out);
/* of that mechanism, one whose ground is as a law stretches it at the start: for assembling there
 */
fw_status fw_effects_at_start(fw_arena *arena, const fw_mechanism *mechanism,
                              const fw_effects_loads *loads, const fw_mechanism **start);

/* linear static response of the constrained mechanism about its initial pose to the generalized
   forces `force` (3 nbody), with the springs of `loads`, drivers held: displacements (3 nbody) and
   pin rotations (npin). Stops and slack cables do not act. *valid false when there is none (free
   motion, redundant joints) or the mechanism has more than FW_RESPONSE_MOST unknowns. */
enum { FW_RESPONSE_MOST = 250 };
fw_status fw_effects_static_response(fw_arena *arena, const fw_mechanism *mechanism,
                                     const fw_effects_loads *loads, const double *force,
                                     double *displacement, double *rotation, bool *valid);
/* generalized forces (3 nbody) of the loads at the initial pose, just behind t = 0: constants,
   loads, springs, slides, stops, elements */
void fw_effects_loads_initial_force(const fw_mechanism *mechanism, const fw_effects_loads *loads,
                                    double *force);
/* the same with every timed load at the largest |factor| that it has in (0, end_s) */
void fw_effects_loads_largest_force(const fw_mechanism *mechanism, const fw_effects_loads *loads,
                                    double end_s, double *force);

/* What a comb drive's element holds, for those who look for pull-in. Physics: comb_drive.c. */

/* Fingers' ends: what of their field goes with the distance of tips from the other comb's root, and what does not */
typedef struct fw_effects_comb_tips {
    double slot_m;        /* (width + 2 gap)/(2 pi), by which their field falls e times */
    double back_m;        /* rounded tips are as if they stood so much farther from the root */
    double face, term[3]; /* of the law of distance */
    double ends; /* of one tip beside one gap: overlap over gap that it adds, far from a root */
    double aside, less[3];   /* of the law of what ends add to the stiffness across */
    double spread_m, edge_m; /* of the fingers across, root mean square; depth by which edges act */
    double corners_F;        /* of plates: where edges and ends meet, as drawn */
} fw_effects_comb_tips;

typedef struct fw_effects_comb_element {
    fw_device_electrodes kind;
    double gap_m, overlap_m, length_m, depth_m; /* overlap of combs; length of fingers or plate */
    double face_Fm; /* eps0 depth fingers: C is this times an integral of ds over the gap */
    double direction_rad, turn_rad; /* in the stator's frame; phi_b - phi_a as drawn */
    double voltage_V;
    double width_m;      /* of the fingers; of a plate across its face */
    double lean_m;       /* as in fw_device_comb: the least gap is by that less than gap_m */
    double edge_F_per_m; /* eps0 fingers */
    fw_effects_comb_tips tip;
    /* the field at the edges of a gap and at an end, where it counts: fringe_field.c; else NULL */
    double (*edge)(const struct fw_effects_comb_element *c, double gap_m, double slope[2]);
    double (*end)(const struct fw_effects_comb_element *c, double gap_m, double slope[2]);
} fw_effects_comb_element;

/* NULL: some other class */
const fw_effects_comb_element *fw_effects_comb_of(const fw_effects_force_element *e);
/* x along the direction, y across it (m), tilt (rad) of the rotor against the stator; p as in
   fw_effects_port_state */
void fw_effects_comb_place(const fw_effects_force_element *e, const double *p, double place[3]);
/* place' for port velocities w (or the place's change under a small motion) */
void fw_effects_comb_rate(const fw_effects_force_element *e, const double *p, const double *w,
                          double rate[3]);
/* C in F at a place; slope (3) and bend (3 x 3) are its first and second derivatives, may be NULL.
   NaN where the electrodes touch. */
double fw_effects_comb_capacitance(const fw_effects_comb_element *c, const double place[3],
                                   double *slope, double *bend);
/* The fringe at both edges of a gap between fingers, or between two bars of this width and depth, over eps0 and their
   length; slope: its first and second derivative by the gap, 1/m and 1/m^2, may be NULL. */
double fw_effects_comb_edge(double gap_m, double width_m, double slope[2]);
double fw_effects_plate_edge(double gap_m, double width_m, double depth_m, double slope[2]);
/* the same at one end of a plate of this length against a longer one, over eps0 and depth */
double fw_effects_plate_end(double gap_m, double width_m, double length_m, double slope[2]);
double fw_effects_plate_corners(const fw_effects_comb_element *c); /* F, as drawn */
/* Of a finger's tip beside one gap, at a distance from the other comb's root: what the root adds to its capacitance over eps0
   and depth; and by which overlap, in gaps, it is as if longer against a motion across. slope: first and second derivative by
   the distance. */
fw_effects_comb_tips fw_effects_comb_tips_of(double gap_m, double width_m, int fingers);
double fw_effects_comb_tip(const fw_effects_comb_tips *tip, double away_m, double slope[2]);
double fw_effects_comb_tip_aside(const fw_effects_comb_tips *tip, double away_m, double slope[2]);
/* that distance with the rotor at x, and the least of any finger at a tilt */
double fw_effects_comb_away(const fw_effects_comb_element *c, double x_m, double tilt_rad);
/* what tips add to the pull along, over that of parallel faces */
double fw_effects_comb_tip_share(const fw_effects_comb_element *c, double away_m);
/* what the fringe fields that are not in it may add to the pull, relative, as drawn (place NULL) or at a place: what stands
   below or near changes half of what the long edges do, and tips are known less well */
double fw_effects_comb_fringe(const fw_effects_comb_element *c, const double *place);
/* of its capacitance at a place, relative, by what is not known of edges, ends and corners: more or less */
double fw_effects_comb_capacitance_off(const fw_effects_comb_element *c, const double place[3]);
/* why the formulas of edges and tips do not hold for what is drawn, a clause; NULL: they do */
const char *fw_effects_comb_out_of_range(const fw_effects_comb_element *c);

/* V up to which the fingers of a comb surely do not snap by themselves; infinite: it is no comb, or its material is not
   known. edges: the field there counts */
double fw_effects_comb_fingers_V(const fw_effects_comb_element *c, const fw_mechanism_variant *made,
                                 bool edges);

/* ---- eyelet_friction.c ---- */

/* of cables on eyelets, of this scene; 0: none is stated */
double fw_effects_eyelet_friction_of(const fw_device_scene *scene);
/* of a cable's path over eyelets at these places (3 ports as fw_effects_port_state.p): by how much the tension of each
   segment (ports - 1) may be larger than that of the whole, relative, whichever way it slips. kept: the actuator keeps the
   tension behind the last eyelet; else its mean stays */
void fw_effects_eyelet_friction_shares(const double *p, int ports, double coefficient, bool kept,
                                       double *share);

/* ---- levitation.c ---- */

/* something that conducts may be below what is drawn; N up by which one drive may be lifted at most */
bool fw_effects_levitation_may_be(const fw_mechanism *mechanism);
double fw_effects_levitation_N(const fw_device_comb *drive, const fw_device_scene *scene);
/* generalised forces (3 nbody) across the plane of all drives; the first of them that lifts anything, or NULL */
const fw_device_comb *fw_effects_levitation_lift(const fw_mechanism *mechanism,
                                                 const fw_device_scene *scene, double *force);

/* ---- adhesion.c: surfaces that have met ---- */

/* of surfaces of a hinge that is drawn, or of bodies of known radius, in a flow that knows their adhesion */
typedef struct fw_effects_adhered {
    bool known;
    double holds_N, opens_N; /* at most, by adhesion; what a hinge's flexure alone gives back */
} fw_effects_adhered;
fw_effects_adhered fw_effects_adhesion_of(const fw_effect_case *effect_case,
                                          const fw_device_contact_use *use,
                                          double adhesion_J_per_m2);
double fw_effects_adhesion_holds(double youngs_Pa, double poisson, double depth_m, double radius_m,
                                 double gap_m, double adhesion_J_per_m2);
/* of a contact between two bodies: relative radius at most (NaN: not known); what is left of it at q (3 nbody; NULL: as
   drawn), and how that goes with q (slope, or NULL) */
double fw_effects_contact_radius(const fw_device_contact_use *use);
double fw_effects_contact_open(const fw_mechanism *mechanism, const fw_device_contact_use *use,
                               const double *q, double *slope);

#endif
