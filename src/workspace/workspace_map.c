/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/map.h"
#include <math.h>

const fw_workspace_effort fw_workspace_usual = {.relative = 2e-3, .most = 400000, .level = 6};
const fw_workspace_effort fw_workspace_quick = {.relative = 1e-2, .most = 80000, .level = 5};

static const double slice_relative = 1e-3, extent_relative = 1e-3;
enum { SLICE_BOXES = 100000, EXTENT_BOXES = 20000 };

/* elastic limits of the six hinges; false: one has none */
static bool limits_of(const fw_mechanism *m, double limit_rad[FW_SIX]) {
    for (int i = 0; i < FW_SIX; i++) {
        int hinge = m->pin[i].hinge;
        limit_rad[i] = hinge == FW_NONE ? (double)NAN : m->hinge[hinge].closed_form.limit_angle_rad;
        if (!(limit_rad[i] > 0.0 && limit_rad[i] < 3.0)) return false;
    }
    return true;
}

fw_status fw_workspace_map_make(fw_arena *arena, const fw_mechanism *m, fw_workspace_effort effort,
                                fw_workspace_map *map) {
    *map = (fw_workspace_map){0};
    const char *held = NULL;
    if (!m->device->six_bar || m->npin < FW_SIX)
        map->none = "the mechanism is not a <six-bar>";
    else if (!fw_workspace_loop_set_up(m, &map->loop))
        map->none = "a leg is stretched or folded in the drawn pose";
    else if (!limits_of(m, map->limit_rad))
        map->none = "a hinge has no elastic limit: give every hinge of the six-bar a flexure";
    if (map->none) return FW_OK;
    FW_TRY(fw_workspace_six_bar_foreign_joint(arena, m, &held));
    if (held) {
        FW_NEED(map->none = fw_arena_printf(arena, "%s holds or drives the six-bar", held));
        return FW_OK;
    }
    map->limits = fw_workspace_limits_symmetric(map->limit_rad);
    FW_TRY(fw_workspace_reach_volume(arena, &map->loop, &map->limits,
                                     (fw_workspace_proof_effort){effort.relative, effort.most},
                                     &map->volume));
    FW_TRY(fw_workspace_reach_survey(arena, &map->loop, &map->limits, effort.level, &map->survey));
    FW_TRY(fw_workspace_reach_extents(arena, &map->loop, &map->limits, extent_relative,
                                      EXTENT_BOXES, &map->survey));
    for (int i = 0; i < FW_SLICES; i++) {
        double step = i - FW_SLICES / 2;
        double end = step < 0.0 ? -map->survey.least[2].hi : map->survey.most[2].lo;
        fw_workspace_slice *s = &map->slice[i];
        s->phi_rad = isfinite(end) ? step * end / (FW_SLICES / 2 + 1) : 0.0;
        FW_TRY(fw_workspace_reach_area(arena, &map->loop, &map->limits, s->phi_rad,
                                       (fw_workspace_proof_effort){slice_relative, SLICE_BOXES},
                                       &s->area));
    }
    return FW_OK;
}

int fw_workspace_governs(const fw_workspace_map *map, const fw_mechanism *m, const double pose[3],
                         double *utilisation) {
    double angle[FW_SIX];
    int leg, worst = 0;
    *utilisation = 2.0;
    if (!fw_workspace_six_bar_inverse(m, pose[0], pose[1], pose[2], angle, &leg)) return FW_NONE;
    *utilisation = 0.0;
    for (int i = 0; i < FW_SIX; i++) {
        double now = fabs(angle[i]) / map->limit_rad[i];
        if (now > *utilisation) *utilisation = now, worst = i;
    }
    return worst;
}
