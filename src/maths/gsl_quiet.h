/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FW_MATHS_GSL_QUIET_H
#define FW_MATHS_GSL_QUIET_H

/* GSL answers by statuses and NaN from here on: its own handler of errors would end the process. It is one for the
   process, and designs run in parallel: it is written once */
void fw_maths_gsl_quiet(void);

#endif
