/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the text of a process pack to its flow. */
#include "base/sort.h"
#include "base/text.h"
#include "process/calibrate.h"
#include "process/pack.h"
#include <stdlib.h>
#include <string.h>

/* ---- the pack ---- */

static int by_id(const void *a, const void *b) {
    const fw_process_id *s = a, *t = b;
    int order = strcmp(s->id, t->id);
    if (!order) order = fw_order_wholes(s->base, t->base);
    return order ? order : fw_order_wholes(s->order, t->order);
}

static void enter(fw_process_pack *pack, const char *id, fw_process_id_kind kind, bool base,
                  void *item, fw_place place) {
    pack->id[pack->nid] = (fw_process_id){id, kind, base, pack->nid, item, place};
    pack->nid++;
}

static void read_source(const fw_xml_record *e, fw_process_source *s) {
    *s = (fw_process_source){fw_process_pack_text(e, "id"), fw_process_pack_text(e, "kind"),
                             fw_process_pack_text(e, "date"), e->element->text};
}

static fw_status read_hazard(fw_process_pack *pack, const fw_xml_record *e, fw_process_hazard *h) {
    const char *name = fw_process_pack_text(e, "name");
    *h = (fw_process_hazard){.id = fw_process_pack_text(e, "id"),
                             .name = name[0] ? name : fw_process_pack_text(e, "id"),
                             .ghs = fw_process_pack_text(e, "ghs"),
                             .reacts_as = fw_process_pack_text(e, "reacts-as"),
                             .reacts = fw_process_reacts_as(fw_process_pack_text(e, "reacts-as")),
                             .ppe = "",
                             .first_aid = "",
                             .waste_stream = "",
                             .waste = "",
                             .buddy = strcmp(fw_process_pack_text(e, "buddy"), "yes") == 0,
                             .wets = strcmp(fw_process_pack_text(e, "wets"), "yes") == 0,
                             .place = e->element->place};
    size_t most = (size_t)fw_xml_children(e, "incompatible");
    FW_NEED(h->incompatible = fw_arena_array(pack->arena, const char *, most));
    most = (size_t)fw_xml_children(e, "attacks");
    FW_NEED(h->attacks = fw_arena_array(pack->arena, const char *, most));
    for (const fw_xml_record *c = e->first_child; c; c = c->next) {
        if (fw_xml_is(c, "ppe"))
            h->ppe = c->element->text;
        else if (fw_xml_is(c, "firstaid"))
            h->first_aid = c->element->text;
        else if (fw_xml_is(c, "waste")) {
            h->waste = c->element->text;
            h->waste_stream = fw_process_pack_text(c, "stream");
        } else if (fw_xml_is(c, "incompatible"))
            h->incompatible[h->nincompatible++] = fw_process_pack_text(c, "with");
        else if (fw_xml_is(c, "attacks"))
            h->attacks[h->nattacks++] = fw_process_pack_text(c, "material");
    }
    return FW_OK;
}

/* of a material's own quantities the process needs what it bears and weighs; the others are device/'s */
static fw_status read_material(fw_process_pack *pack, const fw_xml_record *e,
                               fw_process_material *m) {
    const char *conducts = fw_process_pack_text(e, "conducts");
    *m = (fw_process_material){.id = fw_process_pack_text(e, "id"),
                               .name = fw_process_pack_text(e, "name"),
                               .contaminates = fw_process_pack_text(e, "contaminates"),
                               .holes = strcmp(fw_process_pack_text(e, "holes"), "yes") == 0,
                               .conducts = conducts[0] ? strcmp(conducts, "yes") == 0 : -1,
                               .place = e->element->place};
    for (const fw_xml_record *c = e->first_child; c; c = c->next) {
        const bool density = strcmp(fw_process_pack_text(c, "id"), "density") == 0;
        if (!density && strcmp(fw_process_pack_text(c, "id"), "highest-temperature") != 0) continue;
        fw_quantity *q = fw_arena_one(pack->arena, fw_quantity);
        FW_NEED(q);
        fw_status status = fw_xml_quantity_read(pack->arena, c->element, pack->source,
                                                pack->nsource, pack->diags, q);
        if (status != FW_OK && status != FW_INPUT) return status;
        if (density) {
            m->density = q;
            continue;
        }
        if (!fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension){.K = 1}))
            fw_diag_error(pack->diags, 169, c->element->place,
                          "highest-temperature is not a temperature; write it in Cel or K");
        m->highest_K = q;
    }
    return FW_OK;
}

static fw_status read_one(fw_process_pack *pack, const fw_xml_record *e, bool base) {
    fw_process_flow *f = pack->flow;
    const fw_xml_attribute *id = fw_process_pack_get(e, "id");
    if (fw_xml_is(e, "open-point")) {
        const fw_xml_attribute *until = fw_process_pack_get(e, "until");
        f->open_until[f->nopen_point] = until ? until->value : NULL;
        f->open_point[f->nopen_point++] = e->element->text;
        return FW_OK;
    }
    if (!id && fw_xml_is(e, "q"))
        fw_diag_error(pack->diags, 162, e->element->place, "<q> needs the attribute 'id'");
    if (!id) return FW_OK;
    if (fw_xml_is(e, "source")) {
        fw_process_source *s = &f->source[f->nsource++];
        read_source(e, s);
        enter(pack, id->value, FW_ID_SOURCE, base, s, id->place);
    } else if (fw_xml_is(e, "material")) {
        fw_process_material *m = &f->process_material[f->nprocess_material++];
        FW_TRY(read_material(pack, e, m));
        enter(pack, id->value, FW_ID_MATERIAL, base, m, id->place);
    } else if (fw_xml_is(e, "equipment")) {
        fw_process_equipment *q = &f->equipment[f->nequipment++];
        int capacity = (int)fw_process_pack_number(e, "capacity", 1.0);
        *q = (fw_process_equipment){.id = id->value,
                                    .class_ = fw_process_pack_text(e, "class"),
                                    .text = e->element->text,
                                    .capacity = capacity,
                                    .takes = fw_process_pack_text(e, "takes"),
                                    .brings = fw_process_pack_text(e, "brings"),
                                    .place = e->element->place,
                                    .vacuum = strcmp(fw_process_pack_text(e, "vacuum"), "yes") == 0,
                                    .sees_back =
                                        strcmp(fw_process_pack_text(e, "sees-back"), "yes") == 0};
        enter(pack, id->value, FW_ID_EQUIPMENT, base, q, id->place);
    } else if (fw_xml_is(e, "hazard")) {
        fw_process_hazard *h = &f->hazard[f->nhazard++];
        FW_TRY(read_hazard(pack, e, h));
        enter(pack, id->value, FW_ID_HAZARD, base, h, id->place);
    } else if (fw_xml_is(e, "consumable")) {
        fw_process_consumable *c = &f->consumable[f->nconsumable++];
        *c = (fw_process_consumable){.id = id->value, .place = e->element->place};
        enter(pack, id->value, FW_ID_CONSUMABLE, base, c, id->place);
    } else if (fw_xml_is(e, "bath")) {
        fw_process_bath *b = &f->bath[f->nbath++];
        *b = (fw_process_bath){.id = id->value, .place = e->element->place};
        enter(pack, id->value, FW_ID_BATH, base, b, id->place);
    } else if (fw_xml_is(e, "q")) {
        fw_quantity *q = fw_arena_one(pack->arena, fw_quantity);
        FW_NEED(q);
        fw_status status = fw_xml_quantity_read(pack->arena, e->element, pack->source,
                                                pack->nsource, pack->diags, q);
        if (status != FW_OK && status != FW_INPUT) return status;
        q->id = id->value;
        f->quantity[f->nquantity++] = q;
        enter(pack, id->value, FW_ID_QUANTITY, base, q, id->place);
    }
    return FW_OK;
}

/* <derive id> and <time id> make a quantity that is computed later */
static fw_status read_derived_ids(fw_process_pack *pack, const fw_xml_record *step) {
    for (const fw_xml_record *c = step->first_child; c; c = c->next) {
        const fw_xml_attribute *id = fw_process_pack_get(c, "id");
        const bool time = fw_xml_is(c, "time");
        if ((!time && !fw_xml_is(c, "derive")) || !id) continue;
        fw_quantity *q = fw_arena_one(pack->arena, fw_quantity);
        FW_NEED(q);
        *q = (fw_quantity){.id = id->value,
                           .unknown = true,
                           .unit = time ? "min" : fw_process_pack_text(c, "unit"),
                           .status = FW_DERIVED,
                           .u_status = FW_DERIVED,
                           .source = "computed",
                           .place = c->element->place};
        fw_quantity_unit unit;
        if (fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL))
            q->dimension = unit.dimension;
        pack->flow->quantity[pack->flow->nquantity++] = q;
        enter(pack, id->value, FW_ID_QUANTITY, false, q, id->place);
    }
    return FW_OK;
}

static int count_ids(const fw_xml_record *root) {
    int n = 0;
    for (const fw_xml_record *c = root->first_child; c; c = c->next) {
        n++;
        if (fw_xml_is(c, "step")) n += fw_xml_children(c, "derive") + fw_xml_children(c, "time");
        if (fw_xml_is(c, "consumable") || fw_xml_is(c, "equipment")) n++; /* its price */
    }
    return n;
}

static fw_status make_room(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    size_t n = (size_t)count_ids(pack->base) + (size_t)count_ids(pack->root);
    FW_NEED(pack->id = fw_arena_array(pack->arena, fw_process_id, n));
    FW_NEED(f->source = fw_arena_array(pack->arena, fw_process_source, n));
    FW_NEED(f->hazard = fw_arena_array(pack->arena, fw_process_hazard, n));
    FW_NEED(f->equipment = fw_arena_array(pack->arena, fw_process_equipment, n));
    FW_NEED(f->process_material = fw_arena_array(pack->arena, fw_process_material, n));
    FW_NEED(f->quantity = fw_arena_array(pack->arena, fw_quantity *, n));
    FW_NEED(f->corner = fw_arena_array(pack->arena, fw_process_corner, n));
    FW_NEED(f->finished = fw_arena_array(pack->arena, fw_process_finished, n));
    FW_NEED(f->consumable = fw_arena_array(pack->arena, fw_process_consumable, n));
    FW_NEED(f->bath = fw_arena_array(pack->arena, fw_process_bath, n));
    FW_NEED(f->open_point = fw_arena_array(pack->arena, const char *, n));
    FW_NEED(f->open_until = fw_arena_array(pack->arena, const char *, n));
    FW_NEED(f->step = fw_arena_array(pack->arena, fw_process_step,
                                     (size_t)fw_xml_children(pack->root, "step")));
    return FW_OK;
}

static fw_status read_sources(fw_process_pack *pack) {
    fw_xml_source_text *list[2];
    int n[2];
    FW_TRY(fw_xml_sources_read(pack->arena, pack->root->element, pack->diags, &list[0], &n[0]));
    FW_TRY(fw_xml_sources_read(pack->arena, pack->base->element, pack->diags, &list[1], &n[1]));
    pack->nsource = n[0] + n[1];
    FW_NEED(pack->source = fw_arena_array(pack->arena, fw_xml_source_text, (size_t)pack->nsource));
    for (int i = 0; i < pack->nsource; i++)
        pack->source[i] = i < n[0] ? list[0][i] : list[1][i - n[0]];
    return FW_OK;
}

static void report_duplicates(fw_process_pack *pack) {
    for (int i = 1; i < pack->nid; i++) {
        const fw_process_id *a = &pack->id[i - 1], *b = &pack->id[i];
        if (strcmp(a->id, b->id) != 0) continue;
        if (a->base == b->base && b->kind != FW_ID_SOURCE)
            fw_diag_error(pack->diags, 164, b->place,
                          "id '%s' is used twice; it was given at line %d first", b->id,
                          a->place.line);
        else if (a->base != b->base && a->kind != b->kind)
            fw_diag_error(pack->diags, 164, a->place,
                          "id '%s' is something else in the shared pack (line %d); choose another",
                          a->id, b->place.line);
        else if (a->base != b->base)
            fw_diag_note(pack->diags, 177, a->place,
                         "'%s' replaces the one of the shared pack (line %d)", a->id,
                         b->place.line);
    }
}

/* the quantities until which a point is open are ones of the flow */
static fw_status check_open_points(fw_process_pack *pack) {
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next) {
        const fw_xml_attribute *until =
            fw_xml_is(e, "open-point") ? fw_process_pack_get(e, "until") : NULL;
        for (const char *at = until ? until->value : ""; *at;) {
            const size_t n = strcspn(at, " ");
            fw_xml_attribute one = *until;
            FW_NEED(one.value = fw_arena_strndup(pack->arena, at, n));
            if (n > 0) fw_process_pack_find(pack, &one, FW_ID_QUANTITY);
            at += n + strspn(at + n, " ");
        }
    }
    return FW_OK;
}

static fw_status read_everything(fw_process_pack *pack) {
    for (int part = 0; part < 2; part++) {
        const fw_xml_record *root = part == 0 ? pack->base : pack->root;
        for (const fw_xml_record *c = root->first_child; c; c = c->next) {
            FW_TRY(read_one(pack, c, part == 0));
            if (fw_xml_is(c, "step")) FW_TRY(read_derived_ids(pack, c));
        }
    }
    fw_process_step *step = pack->flow->step;
    for (const fw_xml_record *c = pack->root->first_child; c; c = c->next)
        if (fw_xml_is(c, "step")) {
            const fw_xml_attribute *id = fw_process_pack_get(c, "id");
            if (id) enter(pack, id->value, FW_ID_STEP, false, step, id->place);
            step++;
        }
    qsort(pack->id, (size_t)pack->nid, sizeof *pack->id, by_id);
    report_duplicates(pack);
    return check_open_points(pack);
}

static void read_head(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    const fw_xml_attribute *material = fw_process_pack_get(pack->root, "material"),
                           *thickness = fw_process_pack_get(pack->root, "thickness");
    f->id = fw_process_pack_text(pack->root, "id");
    f->version = fw_process_pack_text(pack->root, "version");
    f->title = fw_process_pack_text(pack->root, "title");
    f->place = pack->root->element->place;
    f->bias_note = "";
    f->insulating = strcmp(fw_process_pack_text(pack->root, "carrier"), "insulating") == 0;
    if (!material || !thickness) {
        fw_diag_error(pack->diags, 162, pack->root->element->place,
                      "a flow needs the attributes 'material' and 'thickness' of its device layer");
        return;
    }
    f->material = material->value;
    fw_process_pack_find(pack, material, FW_ID_MATERIAL);
    f->thickness = fw_process_pack_find(pack, thickness, FW_ID_QUANTITY);
    if (f->thickness &&
        !fw_quantity_dimension_equal(f->thickness->dimension, (fw_quantity_dimension)FW_DIM_LENGTH))
        fw_diag_error(pack->diags, 169, thickness->place,
                      "'%s' is not a length; write it in um or nm", thickness->value);
}

static void read_finished(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next) {
        const fw_xml_attribute *material = fw_process_pack_get(e, "material");
        if (!fw_xml_is(e, "finished") || !material) continue;
        fw_process_pack_find(pack, material, FW_ID_MATERIAL);
        f->finished[f->nfinished++] =
            (fw_process_finished){.material = material->value,
                                  .where = fw_process_pack_where(e),
                                  .present = strcmp(fw_process_pack_text(e, "is"), "present") == 0,
                                  .place = e->element->place};
    }
}

fw_status fw_process_pack_flow(fw_process_pack *pack) {
    size_t errors = pack->diags->errors;
    fw_status status = read_sources(pack);
    if (status != FW_OK && status != FW_INPUT) return status;
    FW_TRY(make_room(pack));
    FW_TRY(read_everything(pack));
    read_head(pack);
    fw_process_read_plates(pack);
    fw_process_pack_corners(pack);
    read_finished(pack);
    FW_TRY(fw_process_pack_baths(pack));
    FW_TRY(fw_process_pack_steps(pack));
    FW_TRY(fw_process_pack_texts(pack));
    fw_process_check_regions(pack);
    if (pack->diags->errors == errors) FW_TRY(fw_process_pack_lint(pack));
    if (pack->diags->errors > errors) return FW_OK;
    FW_TRY(fw_process_corners_follow(pack->arena, pack->flow));
    return fw_process_flow_waits(pack->arena, pack->flow);
}

fw_status fw_process_pack_records(fw_xml_reader *r, bool is_base, const fw_xml_record **root) {
    FW_TRY(fw_xml_records_read(r));
    FW_TRY(fw_xml_words_read(r));
    FW_TRY(fw_xml_numbers_read(r));
    *root = r->record;
    const fw_place place = r->root->place;
    int steps = fw_xml_children(*root, "step");
    if (is_base && steps > 0)
        fw_diag_error(r->diags, 160, place,
                      "the shared pack holds no <step>; steps belong to a flow");
    if (!is_base && steps == 0) fw_diag_error(r->diags, 180, place, "a flow needs a <step>");
    return FW_OK;
}

fw_status fw_process_pack_files(fw_xml_reader *base, const char *base_file, const char *base_xml,
                                size_t base_n, fw_xml_reader *own, const char *file,
                                const char *xml, size_t n) {
    fw_status first =
        fw_xml_read(base->arena, base_file, base_xml, base_n, base->diags, &base->root);
    fw_status second = fw_xml_read(own->arena, file, xml, n, own->diags, &own->root);
    if (first == FW_NOMEM || second == FW_NOMEM) return FW_NOMEM;
    if (first != FW_OK || second != FW_OK) return first != FW_OK ? first : second;
    return base->root && own->root ? FW_OK : FW_INPUT;
}
