/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other ways of doing a step: <alternative> holds a whole <step> with the id of the one whose place it takes when a
   laboratory pack says <choose alternative="...">. It is put there before anything is read from the steps, so that every
   check, time and picture is of the flow as it is run. */
#include "base/text.h"
#include "process/calibrate.h"
#include "process/pack.h"
#include <string.h>

static fw_xml_record *step_of(const fw_xml_record *root, const char *id, fw_xml_record **before) {
    *before = NULL;
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (fw_xml_is(e, "step") && strcmp(fw_process_pack_text(e, "id"), id) == 0)
            return (fw_xml_record *)e;
        *before = (fw_xml_record *)e;
    }
    return NULL;
}

static const fw_xml_record *inner_step(const fw_xml_record *alternative) {
    for (const fw_xml_record *e = alternative->first_child; e; e = e->next)
        if (fw_xml_is(e, "step")) return e;
    return NULL;
}

static void put(const fw_xml_record *root, fw_xml_record *step, fw_xml_record *old,
                fw_xml_record *before) {
    step->next = old->next;
    if (before)
        before->next = step;
    else
        ((fw_xml_record *)root)->first_child = step;
}

/* <alternative>s of the flow, each with its step; mistakes are FW-D375 */
static fw_status list(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    size_t most = (size_t)fw_xml_children(pack->root, "alternative");
    FW_NEED(f->alternative = fw_arena_array(pack->arena, fw_process_alternative, most));
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "alternative")) continue;
        const fw_xml_record *step = inner_step(e);
        fw_xml_record *before;
        fw_process_alternative a = {.id = fw_process_pack_text(e, "id"),
                                    .title = fw_process_pack_text(e, "title"),
                                    .step = step ? fw_process_pack_text(step, "id") : "",
                                    .place = e->element->place};
        for (int i = 0; i < f->nalternative; i++)
            if (strcmp(f->alternative[i].id, a.id) == 0)
                fw_diag_error(pack->diags, 375, a.place,
                              "alternative '%s' is there twice; rename "
                              "one",
                              a.id);
        if (fw_xml_children(e, "step") != 1)
            fw_diag_error(pack->diags, 375, a.place,
                          "<alternative> holds one <step>, the one that takes another's place");
        else if (!step_of(pack->root, a.step, &before))
            fw_diag_error(pack->diags, 375, step->element->place,
                          "there is no step '%s' whose place this one could take; give it the id "
                          "of a step of the flow",
                          a.step);
        else
            f->alternative[f->nalternative++] = a;
    }
    return FW_OK;
}

static fw_status no_such(const fw_process_pack *pack, const fw_process_choice *c) {
    const fw_process_flow *f = pack->flow;
    const char **name = fw_arena_array(pack->arena, const char *, (size_t)f->nalternative);
    FW_NEED(name);
    for (int i = 0; i < f->nalternative; i++)
        name[i] = f->alternative[i].id;
    const char *best = fw_did_you_mean(c->alternative, name, (size_t)f->nalternative);
    fw_diag_error(pack->diags, 375, c->place, "flow '%s' has no alternative '%s'%s%s%s", f->id,
                  c->alternative, best ? "; did you mean '" : "", best ? best : "",
                  best ? "'?" : "");
    return FW_OK;
}

static fw_status choose(fw_process_pack *pack, const fw_process_choice *c) {
    fw_process_flow *f = pack->flow;
    fw_process_alternative *a = NULL;
    for (int i = 0; i < f->nalternative; i++)
        if (strcmp(f->alternative[i].id, c->alternative) == 0) a = &f->alternative[i];
    if (!a) return no_such(pack, c);
    for (int i = 0; i < f->nalternative; i++)
        if (f->alternative[i].chosen && strcmp(f->alternative[i].step, a->step) == 0) {
            fw_diag_error(pack->diags, 375, c->place,
                          "'%s' and '%s' are both for step %s; use one of them",
                          f->alternative[i].id, a->id, a->step);
            return FW_OK;
        }
    a->chosen = true;
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next) {
        fw_xml_record *before, *old = step_of(pack->root, a->step, &before);
        if (!fw_xml_is(e, "alternative") || strcmp(fw_process_pack_text(e, "id"), a->id) != 0)
            continue;
        a->instead_of = fw_process_pack_text(old, "title");
        put(pack->root, (fw_xml_record *)inner_step(e), old, before);
        break;
    }
    return FW_OK;
}

fw_status fw_process_pack_choose(fw_process_pack *pack, const fw_process_choice *choice, int n) {
    pack->flow->id = fw_process_pack_text(pack->root, "id");
    FW_TRY(list(pack));
    for (int i = 0; i < n; i++)
        FW_TRY(choose(pack, &choice[i]));
    return FW_OK;
}

/* ---- what a laboratory pack chooses ---- */

fw_status fw_process_lab_choices(fw_arena *arena, const char *file, const char *xml, size_t n,
                                 const char *flow, fw_process_choice **choice, int *nchoice) {
    fw_diags quiet = fw_diags_new(arena); /* what is wrong is said when its values are applied */
    fw_xml_element *root = NULL;
    fw_status status = fw_xml_read(arena, file, xml, n, &quiet, &root);
    if (status == FW_NOMEM) return status;
    const fw_xml_attribute *of = root ? fw_xml_attribute_of(root, "flow") : NULL;
    if (status != FW_OK || !of || strcmp(of->value, flow) != 0) return FW_OK;
    for (const fw_xml_element *e = root->first_child; e; e = e->next) {
        const fw_xml_attribute *a =
            strcmp(e->name, "choose") == 0 ? fw_xml_attribute_of(e, "alternative") : NULL;
        if (!a) continue;
        fw_process_choice *grown =
            fw_arena_grow(arena, *choice, (size_t)*nchoice, (size_t)*nchoice + 1, sizeof *grown);
        FW_NEED(grown);
        grown[(*nchoice)++] = (fw_process_choice){a->value, a->place};
        *choice = grown;
    }
    return FW_OK;
}
