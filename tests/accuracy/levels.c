/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every cheap level of the hinges of a device, each worked out once, so that callgrind can count
   the calls of fw_plan_ladder_climb:

   accuracy_levels DEVICE.xml    a row per call, in order: HINGE,LEVEL */
#include "plan/plan.h"
#include <stdio.h>

int main(int argc, char **argv) {
    const fw_plan_options options = fw_plan_options_default();
    fw_plan *plan = fw_plan_new(&options);
    fw_plan_ladders all;
    if (argc != 2 || !plan || fw_plan_load(plan, argv[1]) != FW_OK ||
        fw_plan_ladders_run(plan, FW_LADDER_ONCE, &all) != FW_OK)
        return 1;
    for (int i = 0; i < all.count; i++)
        for (int k = 0; all.item[i].shared < 0 && k < all.item[i].rows; k++)
            printf("%s,%s\n", fw_plan_ladder_id(&all.item[i]),
                   fw_plan_ladder_levels(&(size_t){0})[k].name);
    fw_plan_free(plan);
    return 0;
}
