/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Student's t, for means of few readings. */
#ifndef FW_MATHS_STUDENT_H
#define FW_MATHS_STUDENT_H

double fw_maths_student_quantile(double p, double n);

#endif
