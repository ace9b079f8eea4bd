/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The equations of motion of a planar mechanism in reference-point coordinates q = (x, y, phi) of
   every body's centre of mass: M q'' + G^T lambda = Q(q, q', t),   Psi(q, t) = 0,   G = dPsi/dq,
   and the methods that solve them. The compiled scene is model.h, for the rooms of motion above
   this one. Theory: docs/theory/dynamics.md, docs/theory/methods.md. */
#ifndef FW_MULTIBODY_MULTIBODY_H
#define FW_MULTIBODY_MULTIBODY_H
#include "base/diag.h"
#include "effects/effects.h"
#include "mechanism/mechanism.h"

typedef struct fw_multibody_method_row { /* feeds --help and reference pages */
    const char *name, *summary;
} fw_multibody_method_row;
/* the i-th method; name NULL behind the last */
fw_multibody_method_row fw_multibody_method_at(size_t i);

#endif
