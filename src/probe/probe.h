/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a device is for: quantities of its motions and equilibria (<probe> of the description), at
   one instant, along a motion, about an equilibrium. Theory: docs/theory/probes.md. */
#ifndef FW_PROBE_PROBE_H
#define FW_PROBE_PROBE_H
#include "clearance/clearance.h"
#include "dynamics/dynamics.h"
#include "statics/statics.h"

/* ---- at one instant ---- */

typedef struct fw_probe_state {
    double t_s, piece_s;      /* a time inside the smooth piece of the laws that is meant */
    const double *q;          /* (3 nbody) m, rad */
    const double *v;          /* (3 nbody); NULL: at rest */
    const double *angle_rad;  /* (npin) */
    const double *reaction_N; /* (2 npin) on body b; NULL: not known */
    const double *joint_N;    /* (3 njoint) likewise */
    const double *driver_N;   /* (ndriver) likewise */
    /* (all switches of the loads' elements) as held; NULL: as they say themselves */
    const bool *on;
    bool still; /* an equilibrium: laws have values, but no rates */
} fw_probe_state;
fw_probe_state fw_probe_state_of(const fw_dynamics_instant *instant);

/* one probe of a mechanism under the loads of a scene */
typedef struct fw_probe {
    const fw_device_probe *asked;
    const fw_device_probe_kind *kind;
    const struct fw_probe_row *row;
    const fw_mechanism *mechanism;
    fw_effects_loads loads;    /* as they act: free strains applied */
    bool in_scene;             /* false: the scene does not have what carries it; no value */
    fw_effects_port point[2];  /* its points, with the free strain of their bodies; body and world
                                 coordinates of the ground */
    fw_geometry_vec2 drawn[2]; /* where they are drawn, world */
    const fw_effects_force_element *element; /* NULL: none, or it was left out: its force is 0 */
    int spring;                              /* of loads, or FW_NONE */
    double *p, *w, *f;                       /* (3 ports) work of the element */
    bool *on;                                /* (switches) */
    int first_switch;                        /* of the element among all */
    double cable_N_per_m; /* of a drawn tendon alone, without what it acts on; 0: of another */
    const fw_clearance_gap *gap; /* NULL: there are no such outlines */
    double *placed;              /* (3 nbody) work of the gap */
    double walls_m;              /* by how much walls come nearer than drawn */
} fw_probe;

/* One row per kind: adding one is a line in device/probes.def, and its row in probe_kinds.c. SI values
   of the kind's unit; NaN: not known from this state. NULL for what has no course in time. */
struct fw_probe_course;
typedef struct fw_probe_row {
    double (*value)(const fw_probe *p, const fw_probe_state *s);
    double (*across)(const fw_probe *p, const fw_probe_state *s); /* its direction; NULL: nothing */
    /* about an equilibrium, in the modes of small motions there */
    double (*small)(const fw_probe *p, const fw_statics_modes *modes);
    /* extremes within a piece of the motion, into the course, which instants and parabolas may miss;
       NULL: they do not */
    void (*within)(const fw_probe *p, const fw_clearance_path *piece,
                   struct fw_probe_course *course);
    /* how far what it is of has been moved, of which relative errors of the motion are; NULL: by as
       much as the value departs from the drawn one */
    double (*moved)(const fw_probe *p, const fw_probe_state *s);
} fw_probe_row;
#define FW_PROBE(name, ...) extern const fw_probe_row fw_probe_##name;
#include "device/probes.def"
#undef FW_PROBE

static inline int fw_probe_count(const fw_mechanism *mechanism) {
    return mechanism->device ? mechanism->device->nprobe : 0;
}
/* all probes (mechanism->device->nprobe) of a scene of the mechanism's device; loads NULL: none are
   known, and nothing that carries a force is found */
fw_status fw_probe_bind(fw_arena *arena, const fw_mechanism *mechanism,
                        const fw_device_scene *scene, const fw_effects_loads *loads,
                        fw_probe **probe);
/* SI; NaN: not in this scene, or not known */
double fw_probe_value(const fw_probe *p, const fw_probe_state *s);
double fw_probe_across(const fw_probe *p, const fw_probe_state *s);
/* of a distance, opening or gap as it is drawn; of all else 0 */
double fw_probe_origin(const fw_probe *p);
/* at a row of a motion whose probes are bound to its loads */
double fw_probe_at_row(const fw_probe *p, const fw_dynamics_motion *motion, int row);
/* is it a length or an angle, which the pose alone says? */
bool fw_probe_has_rate(const fw_probe *p);
/* By how much a length between points (displacement, distance, opening) may differ at a pose q where each coordinate is off by
   `off` at most (both 3 nbody) and what contacts close by is not: probe.c. Infinite: it is no such length. room: 9 nbody */
double fw_probe_beside(const fw_probe *p, const fw_effects_force_element *const *contact, int count,
                       double t_s, const double *q, const double *off, double *room);
/* m or N of a contact, as it says itself: above 0 where it is closed at a pose (3 nbody) */
double fw_probe_contact_closes(const fw_effects_force_element *contact, const double *q);
/* d/dt of its value there, SI; NaN without a rate. room: 3 nbody + npin. Cost: two values */
double fw_probe_rate_at_row(const fw_probe *p, const fw_dynamics_motion *motion, int row,
                            double *room);
double fw_probe_at_equilibrium(const fw_probe *p, const fw_device_scene *scene,
                               const fw_statics *statics);

/* of a gap as it is where the mechanism starts, and of electrodes as they are drawn; NaN: not known */
double fw_probe_gap_drawn(const fw_probe *p);
double fw_probe_capacitance_drawn(const fw_probe *p);
/* by how much more two outlines that meet as drawn may be apart as made: walls that are etched away
   leave that open */
double fw_probe_gap_etched_m(const fw_probe *p);

/* ---- along a motion: probe_course.c ---- */

typedef struct fw_probe_extreme {
    double value, t_s;
    double between; /* what the parabola added to the nearest instant: the error of the search */
} fw_probe_extreme;

typedef struct fw_probe_course { /* of one probe */
    fw_probe_extreme maximum, minimum;
    fw_probe_extreme across; /* largest size across its direction */
    double final;
    double t[2], s[2], a[2]; /* the last two instants */
    int samples;             /* behind the last jump */
    bool searched;           /* `within` was asked: */
    double below, above;     /* proved: no value is beyond these */
    double moved;            /* the largest */
    double met;              /* of a gap that has closed: what that was by then, at most */
    bool meets;
    int count;            /* in all; 0: it has no value in this scene */
    double *time, *value; /* (kept) every instant and extreme, where and from when asked for */
    size_t kept, room;
} fw_probe_course;

enum {
    FW_PROBE_KEPT_LATE = 1 << 17
}; /* instants of the end of a course, before they are thinned out */

typedef struct fw_probe_monitor { /* of one run */
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    const bool *history; /* (nprobe) whose whole course is kept; NULL: none */
    const bool *late;    /* (nprobe) whose course is kept from late_s on; NULL: none */
    double late_s;       /* known with the loads */
    /* finds it for a motion under monitor->loads, which may be a row of equilibria; NULL: from the start on */
    fw_status (*late_from)(const void *of, const struct fw_probe_monitor *monitor, double *late_s);
    const void *of;
    const bool *judged;            /* (nprobe) by which a run is near enough; NULL: none */
    const double *asked;           /* (nprobe) SI, the largest size that is required of it */
    const bool *only;              /* (nprobe) that are looked at; NULL: all */
    const fw_effects_loads *loads; /* that `probe` is bound to */
    fw_probe *probe;               /* (nprobe) */
    fw_probe_course *course;       /* (nprobe) */
    bool within;                   /* some kind looks within pieces: */
    fw_clearance_path piece;       /* the one that is looked at */
    bool no_memory;                /* the run has failed */
} fw_probe_monitor;

/* a distance, the tension of a cable, or what presses in a contact: never below 0 */
bool fw_probe_is_size(const fw_device *device, const fw_device_probe *asked);
/* scene: one of mechanism->device */
fw_status fw_probe_monitor_new(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene, const bool *history, const bool *only,
                               fw_probe_monitor *monitor);
/* an fw_dynamics_observer of whole instants; context is the monitor */
void fw_probe_monitor_record(void *context, const fw_dynamics_instant *instant);

/* an fw_dynamics_glance: no extreme that is followed lies in the step, which its thirds stand for; they are not recorded yet */
bool fw_probe_monitor_glance(const fw_probe_monitor *monitor, const fw_dynamics_instant *third);

/* an fw_dynamics_tracer, which gaps need; context is the monitor */
void fw_probe_monitor_trace(void *context, const fw_dynamics_piece *piece);

/* fw_dynamics_motion_options.unsettled of probes: twice what two runs differ by, times the margin,
   over thirty times the accuracy wanted (at most 3 %) of the largest departure from the drawn value,
   or of a millionth of what is required where it goes no farther: loads that balance each other leave
   round-off, which no tolerance settles; the worst of those that are judged */
double fw_probe_monitor_unsettled(const fw_probe_monitor *tighter, const fw_probe_monitor *looser,
                                  double margin, double accuracy);

typedef struct fw_probe_result { /* what a motion did, and by how much that may be off */
    double maximum, maximum_t_s, minimum, minimum_t_s, final;
    double peak, peak_t_s; /* the larger size of both, with its sign */
    double across, across_t_s;
    /* what it is as drawn, without any error: of a distance, opening or gap, else 0. Relative errors
       are of what is beyond it, or, of a gap, of how far its outlines were moved against each other */
    double origin;
    double moved; /* of a gap; else NaN */
    /* of a gap that has closed: the share of its motion by which it has, so that one that is less by all its errors closes it, too, as
       clearances have it; NaN: it has not, or walls that are etched away leave it open */
    double met;
    /* errors of extremes, of the final value, of `across`: what two runs and the search between
       instants say, and effects left out; infinite without a second run */
    double numeric, final_numeric, across_numeric;
    /* relative, of the model of the hinges: what the next one changes of the value, and of
       `across`, at the motion's largest hinge angle; NaN: not known */
    double level, across_level;
    bool known; /* it has a value in this scene */
} fw_probe_result;
/* monitors: of the motion, and of the looser run (NULL: there was none) */
void fw_probe_result_of(const fw_probe_monitor *monitor, const fw_probe_monitor *looser,
                        const fw_dynamics_motion *motion, int probe, fw_probe_result *result);

/* What still goes to and fro where a motion ends: the last three turns of a course that was kept over the last three periods
   of its slowest mode (slowest_s), and its end, where no more than one and a half half-periods are behind the last of them. A fast
   mode of a little hides the turns of a slow one of much: turns are looked for with ever larger ways between them, of half-periods
   up to 1.5 times that of the slowest mode. What goes one way besides, behind a ramp that has just ended, is between no turns.
   Amplitude 0: it is at rest, or goes one way. Error: that of the parabolas between instants. Cost: what was kept of three periods,
   some fifteen times. Test: test_probe.c rings_as_it_ends, test_probe.py */
typedef struct fw_probe_ring {
    double amplitude, low, high;
} fw_probe_ring;
void fw_probe_rings(const fw_probe_course *course, double slowest_s, fw_probe_ring *ring);
/* from when on a scene that ends there is kept for that; nothing swings: its end */
double fw_probe_rings_from(double end_s, double slowest_s);

/* least and largest of a course that was kept, from an instant on, its last two instants at the least */
void fw_probe_range(const fw_probe_course *course, double from_s, double *low, double *high);

/* Time after which the probe stays within `band` of `rest`: the last crossing, by the line between two instants. Of a course
   that was kept; 0: it never left */
double fw_probe_settling_s(const fw_probe_course *course, double rest, double band);

/* "354 uN": four digits and a prefix for a value in an SI unit */
enum { FW_PROBE_TEXT = 48 };
const char *fw_probe_text(char buffer[FW_PROBE_TEXT], double value, const char *unit);

/* " at 15 ms"; of NaN nothing */
const char *fw_probe_when(char buffer[FW_PROBE_TEXT], double t_s);

/* ---- about an equilibrium: probe_kinds.c ---- */

/* SI; NaN: there is no such mode, or nothing holds it */
double fw_probe_small(const fw_probe *p, const fw_statics_modes *modes);
/* By what it may be less and more where joints and cables rub, which may all slide and all stick: ratios to it. mode: of a
   frequency, from 1 on; else 0. 1, 1: nothing rubs */
void fw_probe_small_rubs(const fw_probe *p, const fw_statics_modes *modes, int mode, double by[2]);
/* relative: stiffness and compliance go with the square of frequencies; infinite: not known */
double fw_probe_small_error(const fw_probe *p, const fw_statics_modes *modes);

#endif
