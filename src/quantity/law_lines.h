/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The random law: a sum of lines. Private to quantity/. */
#ifndef FW_QUANTITY_LAW_LINES_H
#define FW_QUANTITY_LAW_LINES_H
#include "quantity/law.h"

void fw_lines_value(const fw_law *law, double t_s, double value[3]);
double fw_lines_largest(const fw_law *law, double end_s);

#endif
