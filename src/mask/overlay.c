/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How well plates lie on each other: each is put on one that was printed before, within a budget.

   Between two plates lie the budgets of both ways back to where they meet, added, since the errors of one alignment and of
   the next may lie the same way. In: rows <plate>. Out: m. Test: test_plates.c. */
#include "mask/mask_plates.h"
#include <math.h>

/* budgets of the rows from a plate back to the first, added: errors of one alignment and the next may lie the same way */
static double from_first(const fw_mask_table *table, int plate) {
    double sum = 0.0;
    for (int steps = 0; plate >= 0 && steps < table->nplate; steps++) {
        if (!isnan(table->plates[plate].overlay_m)) sum += table->plates[plate].overlay_m;
        plate = fw_mask_plate_named(table, table->plates[plate].aligned_to);
    }
    return sum;
}

static bool is_before(const fw_mask_table *table, int early, int late) {
    for (int steps = 0; late >= 0 && steps <= table->nplate; steps++) {
        if (late == early) return true;
        late = fw_mask_plate_named(table, table->plates[late].aligned_to);
    }
    return false;
}

/* over the plate where both ways back meet */
double fw_mask_overlay_between_m(const fw_mask_table *table, int a, int b) {
    int meet = a;
    for (int steps = 0; meet >= 0 && !is_before(table, meet, b) && steps < table->nplate; steps++)
        meet = fw_mask_plate_named(table, table->plates[meet].aligned_to);
    double shared = meet >= 0 ? from_first(table, meet) : 0.0;
    return from_first(table, a) + from_first(table, b) - 2.0 * shared;
}

int fw_mask_plate_of_role(const fw_mask_table *table, fw_layout_role role) {
    for (int p = 0; p < table->nplate; p++)
        for (int k = 0; k < table->nlayer; k++)
            if (table->layer[k].roles & 1u << role && fw_mask_plate_draws(table, p, k)) return p;
    return -1;
}

double fw_mask_overlay_m(const fw_mask_table *table, fw_layout_role role) {
    int plate = fw_mask_plate_of_role(table, role); /* one plate has nothing to be put on */
    return plate < 0 ? 0.0 : fw_mask_overlay_between_m(table, plate, table->device_plate);
}
