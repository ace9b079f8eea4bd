/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two functions per hinge kind, whose rows are in flexure_table.c, and what they share. Private to
   the room. */
#ifndef FW_FLEXURE_KINDS_H
#define FW_FLEXURE_KINDS_H
#include "flexure/flexure.h"

void fw_flexure_csfh_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_csfh(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
void fw_flexure_leaf_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_leaf(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
void fw_flexure_path_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_path(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
fw_flexure_error fw_flexure_path_errors(const fw_flexure_shape *shape, const fw_flexure_input *in);

/* of all kinds and materials; flexure_errors.c */
void fw_flexure_shape_marks(fw_flexure_shape *shape);
fw_flexure_error fw_flexure_errors(const fw_flexure_shape *shape, const fw_flexure_input *in,
                                   const fw_flexure_result *result);

/* the peak: at the fillet of a root (root: fw_flexure_root_peak), or between the roots where the
   fillets are wide; beside it the fit (5). beam: t/2 over length and roots, of a crystal in its
   modulus; inside: of the fibre between the roots over it */
void fw_flexure_peak_strain(const fw_flexure_shape *shape, double beam, double inside, double root,
                            fw_flexure_result *out);

/* dL/E of a root whose tangent has cos 4 psi, psi from [100] */
double fw_flexure_root_m_per_Pa(const fw_flexure_shape *shape, const fw_flexure_crystal *crystal,
                                double cos4);

#endif
