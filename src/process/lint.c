/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/lint.h"
#include <string.h>

/* "stated" is a claim about a publication: it needs one as its source */
static fw_status lint_stated(fw_process_pack *pack) {
    for (int part = 0; part < 2; part++) {
        const fw_xml_record *root = part == 0 ? pack->base : pack->root;
        for (const fw_xml_record *c = root->first_child; c; c = c->next) {
            const fw_xml_attribute *src = fw_process_pack_get(c, "src");
            if (!fw_xml_is(c, "q") || !src ||
                strcmp(fw_process_pack_text(c, "status"), "stated") != 0)
                continue;
            const fw_process_source *s = fw_process_pack_find(pack, src, FW_ID_SOURCE);
            if (s && strcmp(s->kind, "publication") != 0 && strcmp(s->kind, "datasheet") != 0)
                fw_diag_error(pack->diags, 173, src->place,
                              "'%s' has status stated, but its source is of kind %s; use typical "
                              "or assumed, or name the publication",
                              fw_process_pack_text(c, "id"), s->kind);
        }
    }
    return FW_OK;
}

/* <hazard> children that name something elsewhere */
static fw_status lint_names(fw_process_pack *pack) {
    for (int part = 0; part < 2; part++) {
        const fw_xml_record *root = part == 0 ? pack->base : pack->root;
        for (const fw_xml_record *h = root->first_child; h; h = h->next)
            for (const fw_xml_record *c = h->first_child; c && fw_xml_is(h, "hazard");
                 c = c->next) {
                const fw_xml_attribute *with = fw_process_pack_get(c, "with"),
                                       *material = fw_process_pack_get(c, "material");
                if (fw_xml_is(c, "incompatible") && with)
                    fw_process_pack_find(pack, with, FW_ID_HAZARD);
                if (fw_xml_is(c, "attacks") && material)
                    fw_process_pack_find(pack, material, FW_ID_MATERIAL);
            }
    }
    return FW_OK;
}

/* a hold starts at the end of an earlier step, and a step is repeated from itself or before */
static fw_status lint_order(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nlag; k++)
            for (int j = i; j < f->nstep; j++)
                if (strcmp(f->step[i].lag[k].from, f->step[j].id) == 0)
                    fw_diag_error(pack->diags, 276, f->step[i].lag[k].place,
                                  "<lag> of step %s counts from step %s, which is not before it; "
                                  "name an earlier step",
                                  f->step[i].id, f->step[j].id);
    return FW_OK;
}

/* the range that the first one of an id gives holds for every one that replaces it */
static fw_status lint_plausible(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 1; i < f->nquantity; i++) {
        fw_quantity *q = f->quantity[i];
        for (int j = 0; j < i; j++) {
            const fw_quantity *first = f->quantity[j];
            if (!q->id || !first->id || strcmp(q->id, first->id) != 0) continue;
            if (!fw_quantity_dimension_equal(q->dimension, first->dimension))
                fw_diag_error(pack->diags, 169, q->place,
                              "'%s' replaces a quantity of another dimension, in line %d", q->id,
                              first->place.line);
            else
                fw_xml_quantity_check_range(q, first, pack->diags);
        }
    }
    return FW_OK;
}

static const struct {
    const char *asks;
    fw_status (*check)(fw_process_pack *pack);
} rules[] = {
    {"does every value that claims to be stated name a publication?", lint_stated},
    {"do hazards name hazards and materials that exist?", lint_names},
    {"do waiting times count from earlier steps?", lint_order},
    {"do replaced values keep dimension and range?", lint_plausible},
    {"is nobody alone with what is dangerous, and is there first aid?", fw_process_lint_people},
    {"do chemicals stay apart that must not meet?", fw_process_lint_chemicals},
    {"is what a step changes on the wafer?", fw_process_lint_absent},
    {"is resist exposed through a mask before it is developed?", fw_process_lint_exposure},
    {"does something cover what an etch shall leave?", fw_process_lint_masking},
    {"is said how fast a chemical takes what it should not?", fw_process_lint_attacked},
    {"does every layer bear the temperature?", fw_process_lint_heat},
    {"do contaminated wafers stay in tools that take them?", fw_process_lint_contamination},
};

fw_status fw_process_pack_lint(fw_process_pack *pack) {
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        FW_TRY(rules[i].check(pack));
    return FW_OK;
}
