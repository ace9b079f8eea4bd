/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/linear.h"
#include <math.h>

/* [K G^T; G 0] [dq; lambda] = [F; 0] at the initial pose, rows balanced by a length and a
   stiffness. Geometric stiffness (lambda Psi_qq, turning loads) is left out: callers take a factor
   for it. Inputs SI; outputs displacement (3 nbody) in m and rad, rotation (npin) in rad. Cost the
   cube of 3 nbody + the rows of joints and drivers, over 3. Source: standard static condensation
   of a constrained system. Test: test_effects.c. */
fw_status fw_effects_static_response(fw_arena *arena, const fw_mechanism *m,
                                     const fw_effects_loads *loads, const double *force,
                                     double *displacement, double *rotation, bool *valid) {
    int total = fw_effects_linear_size(m, loads);
    *valid = false;
    if (total > FW_RESPONSE_MOST || total == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    fw_effects_linear s;
    bool elastic;
    FW_TRY(fw_effects_linear_new(arena, m, loads, &s, &elastic));
    if (elastic) {
        double *x, *f;
        FW_NEED(x = fw_arena_array(arena, double, (size_t)total));
        FW_NEED(f = fw_arena_array(arena, double, (size_t)s.n));
        for (int i = 0; i < s.n; i++)
            f[i] = force[i] / fw_effects_linear_force_unit(&s, i);
        FW_TRY(fw_effects_linear_solve(arena, &s, f, x, valid));
        for (int i = 0; i < s.n; i++) {
            displacement[i] = x[i] * fw_effects_linear_unit(&s, i);
            *valid = *valid && isfinite(displacement[i]);
        }
        for (int i = 0; i < m->npin; i++) {
            int a = m->pin[i].body_a, b = m->pin[i].body_b;
            rotation[i] = (b == FW_GROUND ? 0 : displacement[3 * b + 2]) -
                          (a == FW_GROUND ? 0 : displacement[3 * a + 2]);
        }
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
