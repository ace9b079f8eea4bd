/* SPDX-License-Identifier: GPL-3.0-or-later */
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
#ifndef FW_EFFECTS_ELEMENT_H
#define FW_EFFECTS_ELEMENT_H
#include "mechanism/mechanism.h"

typedef struct fw_effects_port { /* a point of a body: local, of the ground: world */
    int body;
    double x_m, y_m;
} fw_effects_port;

typedef struct fw_effects_port_state { /* what an element sees */
    double t_s, piece_s;               /* for fw_quantity_law_value(law, t_s, piece_s, ...) */
    double load;     /* actuation is multiplied by it: 1, in statics the load factor s (of
                            pulls, draws and squared voltages) */
    const double *p; /* (3 ports) x, y in m from an origin common to all ports, and the turn of
                            its body in rad */
    const double *w; /* (3 ports) their velocities */
    const bool *on;  /* (switches) held during a step, changed by events */
    bool still;      /* an equilibrium: laws have their values there, but no rates */
} fw_effects_port_state;

typedef struct fw_effects_force_element fw_effects_force_element;
/* of a port: 0 but for those of flexures */
fw_geometry_vec2 fw_effects_element_root(const fw_effects_force_element *element, int port);

typedef struct fw_effects_element_class {
    const char *effect; /* id of its row in the ledger */
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
    int pin;                /* the pin that it stands for (released), or FW_NONE: its force on
                               its last port's body is then that pin's reaction */
    bool dissipates, works; /* its power[0], power[1] can be other than 0 */
    double size_N_per_m;    /* of its stiffness, for the choice of scales; 0: none */
    double force_N;         /* of its largest force that is not elastic, likewise */
    const void *data;       /* the class's own */
};

/* where the ports are, from body poses q (3 nbody) and velocities v (3 nbody; NULL: at rest), SI */
void fw_effects_element_place_ports(const fw_effects_force_element *e, const double *q,
                                    const double *v, double *p, double *w);
/* generalised forces (3 nbody): += those of f (3 ports) at poses q */
void fw_effects_element_add_forces(const fw_effects_force_element *e, const double *q,
                                   const double *f, double *force);
/* generalised stiffness and damping (n x n, n = 3 nbody; damping may be NULL): += J^T K J and the
   turning of the arms under f */
void fw_effects_element_spread(const fw_effects_force_element *e, int nbody, const double *q,
                               const double *v, const double *f, const double *stiffness,
                               const double *damping, double *whole_stiffness,
                               double *whole_damping);

#endif
