/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The coupons of a log, as calibrate takes them. */
#include "recipe/asrun_parts.h"
#include <math.h>
#include <string.h>

static bool same(const fw_recipe_asrun_entry *a, const fw_recipe_coupon *ca,
                 const fw_recipe_asrun_entry *b, const fw_recipe_coupon *cb) {
    const char *wa = a->wafer ? a->wafer : "", *wb = b->wafer ? b->wafer : "";
    bool drawn = isnan(ca->row.drawn_m) ? isnan(cb->row.drawn_m)
                                        : fabs(ca->row.drawn_m - cb->row.drawn_m) < 1e-12;
    /* a rate is read off several times of one wafer */
    bool under = isnan(ca->row.at) ? isnan(cb->row.at) : ca->row.at == cb->row.at;
    return a->step == b->step && strcmp(wa, wb) == 0 && drawn && under &&
           strcmp(ca->row.coupon, cb->row.coupon) == 0 &&
           strcmp(ca->row.feature, cb->row.feature) == 0;
}

/* read again, in a later entry or further on in this one: the later reading counts */
static bool superseded(const fw_recipe_asrun *run, int entry, int coupon) {
    const fw_recipe_asrun_entry *e = &run->entry[entry];
    for (int i = entry; i < run->nentry; i++)
        for (int k = i == entry ? coupon + 1 : 0; k < run->entry[i].ncoupon; k++)
            if (same(e, &e->coupon[coupon], &run->entry[i], &run->entry[i].coupon[k])) return true;
    return false;
}

fw_status fw_recipe_asrun_readings(fw_arena *arena, const fw_recipe_asrun *run,
                                   fw_process_readings *readings) {
    int most = 0;
    for (int i = 0; i < run->nentry; i++)
        most += run->entry[i].ncoupon;
    *readings = (fw_process_readings){.lot = run->lot};
    FW_NEED(readings->item = fw_arena_array(arena, fw_process_reading, (size_t)most + 1));
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        for (int k = 0; k < e->ncoupon; k++) {
            const fw_recipe_coupon *c = &e->coupon[k];
            if (superseded(run, i, k)) continue;
            fw_process_reading *r = &readings->item[readings->n++];
            *r = (fw_process_reading){.row = c->row,
                                      .wafer = e->wafer ? e->wafer : "",
                                      .step = e->step->id,
                                      .nsite = c->nsite};
            FW_NEED(r->date = fw_arena_strndup(arena, e->end, 10));
            for (int s = 0; s < FW_RECIPE_SITES; s++) {
                double off = c->site[s] - c->row.value;
                if (!isnan(c->site[s])) r->squares += off * off;
            }
        }
    }
    return FW_OK;
}
