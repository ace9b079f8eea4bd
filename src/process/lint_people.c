/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/lint.h"
#include <string.h>

/* a hazard that speaks of hydrofluoric acid and does not say whether it may be handled alone */
static void lint_acid(fw_process_pack *pack) {
    for (int part = 0; part < 2; part++) {
        const fw_xml_record *root = part == 0 ? pack->base : pack->root;
        for (const fw_xml_record *h = root->first_child; h; h = h->next) {
            bool named = false, antidote = false;
            if (!fw_xml_is(h, "hazard")) continue;
            for (const fw_xml_record *c = h->first_child; c; c = c->next) {
                named = named || strstr(c->element->text, "hydrofluoric") ||
                        strstr(c->element->text, "HF ");
                antidote = antidote || strstr(c->element->text, "gluconate");
            }
            if (!named || strcmp(fw_process_pack_text(h, "buddy"), "no") == 0) continue;
            if (!fw_process_pack_get(h, "buddy"))
                fw_diag_error(pack->diags, 174, h->element->place,
                              "hazard '%s' mentions hydrofluoric acid: state buddy=\"yes\", or "
                              "buddy=\"no\" where nobody handles the acid itself",
                              fw_process_pack_text(h, "id"));
            else if (!antidote)
                fw_diag_error(pack->diags, 174, h->element->place,
                              "hazard '%s' is hydrofluoric acid and its first aid does not name "
                              "calcium gluconate",
                              fw_process_pack_text(h, "id"));
        }
    }
}

static void lint_step(fw_process_pack *pack, const fw_process_step *s) {
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

fw_status fw_process_lint_people(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        lint_step(pack, &pack->flow->step[i]);
    lint_acid(pack);
    return FW_OK;
}

static bool excludes(const fw_process_hazard *a, const fw_process_hazard *b) {
    for (int i = 0; i < a->nincompatible; i++)
        if (strcmp(a->incompatible[i], b->id) == 0) return true;
    return false;
}

/* two steps on one bench whose chemicals must not meet; once per pair of hazards */
static void lint_bench(fw_process_pack *pack, const fw_process_flow *f) {
    for (int i = 0; i < f->nstep; i++)
        for (int j = 0; j <= i; j++) {
            const fw_process_step *a = &f->step[j], *b = &f->step[i];
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

/* what must not meet must not be collected in one can either */
static void lint_waste(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nhazard; i++)
        for (int j = 0; j < i; j++) {
            const fw_process_hazard *a = &f->hazard[j], *b = &f->hazard[i];
            if ((excludes(a, b) || excludes(b, a)) && strcmp(a->waste_stream, b->waste_stream) == 0)
                fw_diag_error(pack->diags, 175, b->place,
                              "%s and %s must not meet, but both go to the waste '%s'; give one of "
                              "them a stream of its own",
                              a->id, b->id, b->waste_stream);
        }
}

fw_status fw_process_lint_chemicals(fw_process_pack *pack) {
    lint_bench(pack, pack->flow);
    lint_waste(pack);
    return FW_OK;
}
