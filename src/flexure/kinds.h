/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two functions per hinge kind; table.c has their rows. Private to the room. */
#ifndef FW_FLEXURE_KINDS_H
#define FW_FLEXURE_KINDS_H
#include "flexure/flexure.h"

void fw_csfh_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_csfh(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
void fw_leaf_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_leaf(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);

/* error.c: factor by which a shape outside of those compared widens its errors; the errors */
double fw_flexure_widening(const fw_flexure_shape *shape);
/* what lifts the peak strain above all continuum figures: they are up to 1.9 % (leaf 2.7 %) higher
   than the closed form, 4.3 % (8.3 %) with fillets below t/4 */
double fw_flexure_safe(const fw_flexure_shape *shape);
fw_flexure_error fw_flexure_errors(const fw_flexure_shape *shape, const fw_flexure_input *in,
                                   const fw_flexure_result *result);
void fw_path_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_path(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
fw_flexure_error fw_path_errors(const fw_flexure_shape *shape, const fw_flexure_input *in);

/* dL/E of a root whose tangent has cos 4 psi, psi from [100]; section.c */
double fw_root_m_per_Pa(const fw_flexure_shape *shape, const fw_crystal *crystal, double cos4);

#endif
