/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Can the prices be added? Does a filling serve a wafer? Is every mask but the first aligned to one before it? */
#include "process/pack.h"
#include <string.h>

static void one_currency(fw_process_pack *pack, const fw_quantity *price, const char **first) {
    const char *is = price->unknown ? NULL : fw_quantity_unit_currency(price->unit);
    if (!is) return;
    if (!*first) *first = is;
    if (*first != is)
        fw_diag_error(pack->diags, 371, price->place,
                      "'%s' is in %s, and another price is in %s; the rate is not known here: give "
                      "all prices in one currency",
                      price->id, is, *first);
}

fw_status fw_process_lint_prices(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    const char *first = NULL;
    for (int i = 0; i < f->nconsumable; i++)
        one_currency(pack, f->consumable[i].price, &first);
    for (int i = 0; i < f->nequipment; i++)
        one_currency(pack, f->equipment[i].price, &first);
    for (int i = 0; i < f->nbath; i++) {
        const fw_quantity *q = f->bath[i].serves;
        if (q && !q->unknown && !(q->value >= 1.0))
            fw_diag_error(pack->diags, 370, q->place,
                          "a filling of bath '%s' serves less than one wafer (%s); make the volume "
                          "larger, or correct the number",
                          f->bath[i].id, q->id);
    }
    return FW_OK;
}

/* ---- hazards: of what is used as it is; a bath is a mixture, with the hazard that the step names ---- */

static void named(fw_process_pack *pack, const fw_process_step *s, const fw_process_use *u,
                  const fw_process_consumable *c) {
    bool there = !c->hazard;
    for (int i = 0; i < s->nhazard && !there; i++)
        there = s->hazard[i] == c->hazard;
    if (!there)
        fw_diag_error(pack->diags, 374, u->place,
                      "step %s uses '%s', whose hazard '%s' it does not name; add <hazard-ref "
                      "ref=\"%s\"/>",
                      s->id, c->id, c->hazard->id, c->hazard->id);
}

fw_status fw_process_lint_uses(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        for (int k = 0; k < s->nuse; k++) {
            const fw_process_use *u = &s->use[k];
            if (u->consumable) named(pack, s, u, u->consumable);
        }
    }
    return FW_OK;
}

/* ---- masks ---- */

static const fw_process_step *exposed_before(const fw_process_flow *f, int before,
                                             const char *mask) {
    for (int i = 0; i < before; i++)
        if (f->step[i].mask[0] && (!mask || strcmp(f->step[i].mask, mask) == 0)) return &f->step[i];
    return NULL;
}

static void aligned(fw_process_pack *pack, const fw_process_flow *f, int at) {
    const fw_process_step *s = &f->step[at], *first = exposed_before(f, at, NULL);
    if (!s->align.to) {
        if (s->mask[0] && first && strcmp(first->mask, s->mask) != 0)
            fw_diag_error(
                pack->diags, 373, s->place,
                "step %s exposes mask %s after %s did mask %s, and does not say how it is "
                "aligned; add <align to=\"%s\" overlay=\"...\"/>",
                s->id, s->mask, first->id, first->mask, first->mask);
        return;
    }
    if (!s->mask[0])
        fw_diag_error(pack->diags, 373, s->align.place,
                      "step %s exposes no mask, so that there is nothing to align", s->id);
    else if (!exposed_before(f, at, s->align.to))
        fw_diag_error(pack->diags, 373, s->align.place,
                      "step %s aligns mask %s to '%s', which no earlier step has exposed; name a "
                      "mask that is on the wafer by then",
                      s->id, s->mask, s->align.to);
}

fw_status fw_process_lint_plates(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        aligned(pack, pack->flow, i);
    return FW_OK;
}
