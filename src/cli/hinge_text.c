/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/hinge_text.h"
#include "base/constants.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double degrees = 180 / FW_PI;

static void column(fw_text *out, const char *conversion, double value, double scale) {
    if (isfinite(value))
        fw_text_real(out, conversion, value * scale);
    else
        fw_text_printf(out, "%*s", atoi(conversion + 1), "-");
}

static void level_text(fw_text *out, const fw_plan_ladder *l, int i) {
    const fw_report_level *r = &l->row[i];
    fw_text_printf(out, "  %c %-12s", i == l->picked ? '*' : ' ', r->name);
    if (r->state != FW_LEVEL_SOLVED) {
        fw_text_printf(out, "  not here: %s\n", r->why);
        return;
    }
    column(out, "%12.5e", r->stiffness_Nm_per_rad, 1);
    column(out, "%11.3f", r->kx_N_per_m, 1);
    column(out, "%12.3f", r->ky_N_per_m, 1);
    column(out, "%12.3f", r->centre_m[0], 1e6);
    column(out, "%11.3f", r->centre_m[1], 1e6);
    column(out, "%10.5f", r->strain_per_rad, 1);
    column(out, "%8.3f", r->limit_angle_rad, degrees);
    column(out, "%8.3f", r->drift_m, 1e6);
    column(out, "%7.1f", r->error.stiffness, 100);
    column(out, "%6.1f", r->error.kx, 100);
    column(out, "%6.1f", r->error.ky, 100);
    column(out, "%7.2f", r->error.centre_m, 1e6);
    column(out, "%7.1f", r->error.strain, 100);
    column(out, "%10.2e", r->cpu_s, 1);
    fw_text_add(out, "\n");
}

static void drift_text(fw_text *out, const fw_plan_ladder *l) {
    const fw_plan_ladder_drift *d = &l->drift;
    fw_text_add(out, "    axis drifts by ");
    fw_text_real(out, "%.3f", fabs(d->point[0].drift_m) * 1e6);
    fw_text_add(out, " and ");
    fw_text_real(out, "%.3f", fabs(d->point[FW_DRIFT_POINTS - 1].drift_m) * 1e6);
    fw_text_add(out, " um at -+");
    fw_text_real(out, "%.2f", d->limit_rad * degrees);
    fw_text_add(out, " deg");
    if (d->surfaces.gap_m > 0) {
        fw_text_add(out, "; gap ");
        fw_text_real(out, "%.3g", d->surfaces.gap_m * 1e6);
        fw_text_add(out, " um closes by a moment at ");
        for (int side = 0; side < 2; side++) {
            double at = d->contact_rad[side] * degrees;
            if (isfinite(at))
                fw_text_real(out, "%+.1f", at);
            else
                fw_text_add(out, "none");
            fw_text_add(out, side ? " deg" : " / ");
        }
        fw_text_add(out, ", by ");
        fw_text_real(out, "%.4g", d->closing_N[0] * 1e6);
        fw_text_add(out, " uN along or ");
        fw_text_real(out, "%.4g", d->closing_N[1] * 1e6);
        fw_text_add(out, " uN across; a gap of ");
        fw_text_real(out, "%.3f", d->advice.gap_m * 1e6);
        fw_text_add(out, " um would do with the first surface ");
        fw_text_real(out, "%.3f", d->advice.offset_m * 1e6);
        fw_text_add(out, " um off W");
    }
    fw_text_add(out, "\n");
}

void fw_cli_ladder_why(const fw_plan_ladder *l, double accuracy, char *text, size_t n) {
    if (l->reached)
        snprintf(text, n,
                 "the cheapest whose own estimate, %.2g %% of the stiffness, is within the "
                 "accuracy wanted, %.2g %%",
                 l->reaches * 100, accuracy * 100);
    else
        snprintf(text, n,
                 "none reaches the accuracy wanted, %.2g %% of the stiffness; this one, within "
                 "%.2g %%, comes closest",
                 accuracy * 100, l->reaches * 100);
}

static void picked_text(fw_text *out, const fw_plan_ladders *all, const fw_plan_ladder *l) {
    char why[200];
    if (l->picked < 0) return;
    fw_cli_ladder_why(l, all->accuracy, why, sizeof why);
    fw_text_printf(out, "  * %s\n", why);
    if (l->shared < 0) return;
    const fw_plan_ladder *from = &all->item[l->shared];
    fw_text_printf(out, "    solved once with hinge %s%s%s, which is alike\n",
                   fw_plan_ladder_id(from), from->flow ? ", flow " : "",
                   from->flow ? from->flow : "");
}

static void hinge_text(fw_text *out, const fw_plan_ladders *all, const fw_plan_ladder *l) {
    const fw_mechanism_hinge *h = l->hinge;
    const fw_flexure_result *c = &h->closed_form;
    fw_text_printf(out, "  hinge %s%s%s: E ", fw_plan_ladder_id(l), l->flow ? ", flow " : "",
                   l->flow ? l->flow : "");
    fw_text_real(out, "%.2f", c->youngs_Pa * 1e-9);
    fw_text_add(out, " GPa, peak stress ");
    fw_text_real(out, "%.4g", c->stress_per_rad_Pa * 1e-6);
    fw_text_add(out, " MPa/rad, stiffness used ");
    fw_text_real(out, "%.5e", l->mechanism->pin[h->pin].stiffness_Nm_per_rad);
    fw_text_add(out, " N m/rad");
    if (hypot(c->offset_m[0], c->offset_m[1]) > 5e-10) {
        fw_text_add(out, ",\n    crystal moves the elastic centre by ");
        fw_text_real(out, "%.3f", c->offset_m[0] * 1e6);
        fw_text_add(out, " um along and ");
        fw_text_real(out, "%.3f", c->offset_m[1] * 1e6);
        fw_text_add(out, " um across from where it is drawn");
    }
    fw_text_add(out, c->error.outside
                         ? "\n    outside of the shapes that were compared with finite "
                           "elements: errors are guesses\n"
                         : "\n");
    for (int i = 0; i < l->rows; i++)
        level_text(out, l, i);
    picked_text(out, all, l);
    drift_text(out, l);
}

fw_status fw_cli_hinge_print(fw_arena *arena, const fw_plan_ladders *all, bool hint) {
    fw_text out = fw_text_new(arena);
    fw_text_add(&out, "    level         stiffness         kx          ky    centre x   centre y   "
                      "peak     limit   drift"
                      "  +-stiff   +-kx  +-ky +-centre +-peak     cost\n"
                      "                    N m/rad        N/m         N/m          um         um  "
                      "1/rad       deg      um"
                      "        %      %     %      um      %        s\n");
    for (int i = 0; i < all->count; i++)
        hinge_text(&out, all, &all->item[i]);
    if (hint)
        fw_text_add(&out, "  continuum: not asked for, takes seconds for each hinge; --level all "
                          "or --level continuum, or an --accuracy that needs it\n");
    FW_TRY(fw_text_end(&out));
    fputs(out.data, stdout);
    return FW_OK;
}
