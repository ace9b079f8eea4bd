/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One function per criterion; limit.c has their rows. Private to the room. */
#ifndef FW_FLEXURE_LIMIT_KINDS_H
#define FW_FLEXURE_LIMIT_KINDS_H
#include "flexure/limit.h"

bool fw_limit_stated(const fw_limit_input *in, fw_limits *all, fw_limit *limit);
bool fw_limit_fracture(const fw_limit_input *in, fw_limits *all, fw_limit *limit);
bool fw_limit_yield(const fw_limit_input *in, fw_limits *all, fw_limit *limit);
bool fw_limit_fatigue(const fw_limit_input *in, fw_limits *all, fw_limit *limit);

/* a quantity that was never filled has no id */
bool fw_limit_known(const fw_quantity *q);
/* the material's criterion says that it fractures */
bool fw_limit_brittle(const fw_material *material);
/* from one quantity, as it is */
void fw_limit_plain(const fw_quantity *q, const char *definition, fw_limit *limit);
fw_value_status fw_limit_weakest(const fw_quantity *const *q, int n);

#endif
