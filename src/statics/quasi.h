/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion of a scene, with inertia or as a sequence of equilibria, whichever its effects ask
   for. Theory: docs/theory/effects/inertia.md. */
#ifndef FW_STATICS_QUASI_H
#define FW_STATICS_QUASI_H
#include "dynamics/dynamics.h"

/* Compiles the effects. Where inertia is left out (loads->quasi_static) the motion is the sequence
   of stable equilibria under the loads and drivers of each time, in the form of
   fw_dynamics_simulate: v is du/dt of that row, accel its derivative; peaks lie on equilibria
   solved for at their times; stats.steps: equilibria, stats.rhs: evaluations of forces and tangent.
   Starting velocities and damping have no part in it. Where the row ends, as at a fold, and where
   inertia acts, it is fw_dynamics_simulate's; the ledger says so. A method, integrator or tolerance
   that was asked for by name needs inertia too, unless effects were chosen by hand. */
fw_status fw_statics_move_scene(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_device_scene *scene,
                                const fw_dynamics_motion_options *options, fw_diags *diags,
                                const fw_dynamics_motion **motion);

/* the row of equilibria alone. FW_SOLVER: it ends before the scene does, or there is none; *why
   says where and is good for the ledger. */
fw_status fw_statics_quasi_static_motion(fw_arena *arena, const fw_mechanism *mechanism,
                                         const fw_device_scene *scene,
                                         const fw_dynamics_motion_options *options,
                                         const fw_effect_ledger *ledger,
                                         const fw_effects_loads *loads, fw_diags *diags,
                                         const fw_dynamics_motion **motion, const char **why);

#endif
