/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/pack.h"
#include "process/stack.h"
#include <string.h>

/* "stated" is a claim about a publication: it needs one as its source */
static void lint_stated(fw_pack *pack, const fw_element *root) {
    for (const fw_element *c = root->first_child; c; c = c->next) {
        const fw_attribute *src = fw_pack_get(c, "src");
        if (strcmp(c->name, "q") != 0 || !src || strcmp(fw_pack_text(c, "status"), "stated") != 0)
            continue;
        const fw_source *s = fw_pack_find(pack, src, FW_ID_SOURCE);
        if (s && strcmp(s->kind, "publication") != 0 && strcmp(s->kind, "datasheet") != 0)
            fw_diag_error(pack->diags, 173, src->place,
                          "'%s' has status stated, but its source is of kind %s; use typical or "
                          "assumed, or name the publication",
                          fw_pack_text(c, "id"), s->kind);
    }
}

static void lint_people(fw_pack *pack, const fw_step *s) {
    for (int i = 0; i < s->nhazard; i++) {
        if (!s->hazard[i]->buddy) continue;
        if (!s->second_signature)
            fw_diag_error(pack->diags, 174, s->place,
                          "step %s has the hazard '%s', which nobody handles alone: add "
                          "second-signature=\"yes\"",
                          s->id, s->hazard[i]->id);
        if (!s->hazard[i]->first_aid[0])
            fw_diag_error(pack->diags, 174, s->hazard[i]->place, "hazard '%s' has no first aid",
                          s->hazard[i]->id);
    }
}

static bool excludes(const fw_hazard *a, const fw_hazard *b) {
    for (int i = 0; i < a->nincompatible; i++)
        if (strcmp(a->incompatible[i], b->id) == 0) return true;
    return false;
}

/* two steps on one bench whose chemicals must not meet; once per pair of hazards */
static void lint_bench(fw_pack *pack, const fw_flow *f) {
    for (int i = 0; i < f->nstep; i++)
        for (int j = 0; j <= i; j++) {
            const fw_step *a = &f->step[j], *b = &f->step[i];
            if (a->equipment != b->equipment) continue;
            for (int s = 0; s < a->nhazard; s++)
                for (int t = 0; t < b->nhazard; t++)
                    if (excludes(a->hazard[s], b->hazard[t]) ||
                        excludes(b->hazard[t], a->hazard[s]))
                        fw_diag_warning(pack->diags, 175, b->place,
                                        "steps %s and %s use the same %s, but %s and %s must not "
                                        "meet: use two benches and two waste cans",
                                        a->id, b->id, a->equipment->id, a->hazard[s]->id,
                                        b->hazard[t]->id);
        }
}

static void lint_hazard_names(fw_pack *pack) {
    for (int part = 0; part < 2; part++) {
        const fw_element *root = part == 0 ? pack->base : pack->root;
        for (const fw_element *h = root->first_child; h; h = h->next)
            for (const fw_element *c = h->first_child; c && strcmp(h->name, "hazard") == 0;
                 c = c->next) {
                const fw_attribute *with = fw_pack_get(c, "with");
                if (strcmp(c->name, "incompatible") == 0 && with)
                    fw_pack_find(pack, with, FW_ID_HAZARD);
            }
    }
}

fw_status fw_pack_lint(fw_pack *pack) {
    const fw_flow *f = pack->flow;
    fw_stack stack;
    const fw_change *absent = NULL;
    lint_stated(pack, pack->base);
    lint_stated(pack, pack->root);
    lint_hazard_names(pack);
    for (int i = 0; i < f->nstep; i++)
        lint_people(pack, &f->step[i]);
    lint_bench(pack, f);
    FW_TRY(fw_flow_stack(pack->arena, f, f->nstep - 1, &stack, &absent));
    if (absent)
        fw_diag_error(pack->diags, 172, absent->place,
                      "<change kind='%s'> needs the material '%s', which is not on the wafer at "
                      "this step",
                      absent->kind, absent->from[0] ? absent->from : absent->material);
    return FW_OK;
}
