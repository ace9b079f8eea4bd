/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FW_TESTS_PLAIN_FACTS_H
#define FW_TESTS_PLAIN_FACTS_H
#include "process/process.h"

/* a 3 mm device on a 5.6 by 5 mm die, 30 times */
static const fw_process_mask_facts plain_facts = {.structure_area_m2 = 5e-6,
                                                  .die_area_m2 = 28e-6,
                                                  .perimeter_m = 0.08,
                                                  .narrowest_slot_m = 10e-6,
                                                  .narrowest_line_m = 10e-6,
                                                  .deepest_hinge_width_m = 10e-6,
                                                  .dies = 30};

#endif
