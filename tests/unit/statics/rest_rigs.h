/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small structures with known equilibria, for the tests of statics and modes. */
#ifndef FW_TEST_REST_RIGS_H
#define FW_TEST_REST_RIGS_H
#include "dynamics/models.h"

typedef struct fixture {
    fw_arena *arena;
    fw_diags diags;
} fixture;

static inline fixture begin(void) {
    fixture f = {.arena = fw_arena_new(0)};
    assert_non_null(f.arena);
    f.diags = fw_diags_new(f.arena);
    return f;
}

static inline bool said(const fixture *f, int number) {
    for (size_t i = 0; i < f->diags.count; i++)
        if (f->diags.item[i].number == number) return true;
    return false;
}

/* ground and `body` slide along the direction `axis` through (x, y) and the body's centre of mass
 */
static inline fw_device_joint *rig_guide(fixture *f, rig *r, int body, double x, double y,
                                         double axis) {
    if (!r->m.joint) r->m.joint = fw_arena_array(f->arena, fw_device_joint, 8);
    fw_device_joint *t = &r->m.joint[r->m.njoint++];
    *t = (fw_device_joint){.id = "guide",
                           .kind = FW_JOINT_PRISMATIC,
                           .body_a = FW_GROUND,
                           .body_b = body,
                           .ax_m = x,
                           .ay_m = y,
                           .axis_rad = axis};
    return t;
}

/* von Mises truss: springs k from (-b, 0) and (b, 0) to a body on a vertical guide at (0, h), load
   P downwards. With y the height and L^2 = b^2 + y^2: P(y) = 2 k y (L0 / L - 1); limit points where
   L^3 = L0 b^2. */
static inline rig rig_truss(fixture *f, double b, double h, double k, double load) {
    rig r = rig_new(f->arena, 1, 0, 2);
    rig_body(&r, "apex", 1, 1, 0, h, 0);
    rig_guide(f, &r, 0, 0, 0, acos(0.0));
    rig_spring(&r, "spring", FW_GROUND, -b, 0, 0, 0, 0, k, hypot(b, h));
    rig_spring(&r, "spring", FW_GROUND, b, 0, 0, 0, 0, k, hypot(b, h));
    rig_force(&r, 0, 0, -load);
    r.scene.duration_s = 1;
    return r;
}
static inline double truss_load(double b, double h, double k, double y) {
    return 2 * k * y * (hypot(b, h) / hypot(b, y) - 1);
}
static inline double truss_fold(double b, double h) { /* height of the upper limit point */
    double l = cbrt(hypot(b, h) * b * b);
    return sqrt(l * l - b * b);
}

/* a bar that stands on a torsion spring k at the origin, length l, pressed at its top by P: buckles
   at P = k / l; buckled where k theta = P l sin theta */
static inline rig rig_mast(fixture *f, double l, double k, double load) {
    rig r = rig_new(f->arena, 1, 1, 0);
    rig_body(&r, "mast", 2, 0.3, 0, 0.4 * l, 0);
    rig_pin(&r, "foot", FW_GROUND, 0, 0, 0, k, 0);
    rig_force(&r, 0, 0, -load);
    r.scene.force[0].y_m = 0.6 * l;
    r.scene.duration_s = 1;
    return r;
}

/* column of two bars of length l, pinned below, guided above, torsion spring k between them,
   pressed by P: buckles at P = 2 k / l */
static inline rig rig_column(fixture *f, double l, double k, double load) {
    rig r = rig_new(f->arena, 3, 3, 0);
    rig_body(&r, "lower", 1, 0.1, 0, l / 2, 0);
    rig_body(&r, "upper", 1, 0.1, 0, 1.5 * l, 0);
    rig_body(&r, "head", 1, 0.1, 0, 2 * l, 0);
    rig_pin(&r, "foot", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "knee", 0, 1, 0, l, k, 0);
    rig_pin(&r, "neck", 1, 2, 0, 2 * l, 0, 0);
    rig_guide(f, &r, 2, 0, 0, acos(0.0));
    rig_force(&r, 2, 0, -load);
    r.scene.duration_s = 1;
    return r;
}

#endif
