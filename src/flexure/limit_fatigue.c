/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/limit_kinds.h"
#include <math.h>

/* amplitude that lasts the cycles asked for, once per repetition; the law itself goes to the
   verdict, which counts the cycles of a motion. Data: strain_life.h */
bool fw_limit_fatigue(const fw_limit_input *in, fw_limits *all, fw_limit *limit) {
    const fw_limit_data *d = &in->material->limit;
    if (!(in->asked->cycles > 0)) return false;
    const fw_quantity *const used[] = {&d->fatigue_strength, &d->fatigue_cycles,
                                       &d->fatigue_exponent, &d->ductility, &d->ductility_exponent};
    bool plastic = fw_limit_known(&d->ductility) && fw_limit_known(&d->ductility_exponent);
    all->life = (fw_strain_life){.known = true,
                                 .amplitude_Pa = d->fatigue_strength.value,
                                 .cycles = d->fatigue_cycles.value,
                                 .exponent = d->fatigue_exponent.value,
                                 .youngs_Pa = in->flexure->youngs_Pa,
                                 .ductility = plastic ? d->ductility.value : 0,
                                 .ductility_exponent = plastic ? d->ductility_exponent.value : 0};
    for (int i = 0; i < 3; i++)
        all->life.known = all->life.known && fw_limit_known(used[i]);
    if (!all->life.known) {
        all->missing = "fatigue-strength, fatigue-cycles and fatigue-exponent";
        all->missing_place = in->asked->cycles_place;
        return false;
    }
    if (!(fw_strain_life_elastic_Pa(&all->life) > 0)) {
        all->life.known = false;
        all->missing = "a ductility that leaves some of fatigue-strength elastic";
        all->missing_place = in->asked->cycles_place;
        return false;
    }
    limit->definition =
        plastic ? "amplitude at life (Basquin, Manson and Coffin)" : "amplitude at life (Basquin)";
    limit->source = d->fatigue_strength.source;
    limit->status = fw_limit_weakest(used, plastic ? 5 : 3);
    limit->allowable_Pa = fw_strain_life_amplitude_Pa(&all->life, in->asked->cycles);
    return true;
}
