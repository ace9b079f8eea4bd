/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "device/material.h"
#include "base/text.h"
#include "device/quantity_xml.h"
#include <math.h>
#include <string.h>

enum { YOUNGS, POISSON, DENSITY, STRENGTH, LOSS, EXPANSION, MODULUS_CHANGE, C11, C12, C44, IDS };
static const char *const ids[IDS] = {"youngs",    "poisson",        "density", "strength", "loss",
                                     "expansion", "modulus-change", "c11",     "c12",      "c44"};

static const fw_dimension dimension_of[IDS] = {
    [YOUNGS] = {-1, 1, -2, 0, 0, 0, 0},   [DENSITY] = {.m = -3, .kg = 1},
    [STRENGTH] = {-1, 1, -2, 0, 0, 0, 0}, [EXPANSION] = {.K = -1},
    [MODULUS_CHANGE] = {.K = -1},         [C11] = {-1, 1, -2, 0, 0, 0, 0},
    [C12] = {-1, 1, -2, 0, 0, 0, 0},      [C44] = {-1, 1, -2, 0, 0, 0, 0}};

static fw_quantity *slot(fw_material *m, int k) {
    fw_quantity *const all[IDS] = {&m->youngs, &m->poisson,   &m->density,        &m->strength,
                                   &m->loss,   &m->expansion, &m->modulus_change, &m->c11,
                                   &m->c12,    &m->c44};
    return all[k];
}

static int index_of(const char *id) {
    for (int k = 0; k < IDS; k++)
        if (strcmp(ids[k], id) == 0) return k;
    return -1;
}

static fw_place place_of(const fw_element *e, const char *name) {
    const fw_attribute *a = fw_xml_attribute(e, name);
    return a ? a->place : e->place;
}

/* positive where a formula divides by it; Poisson's ratio within its stable range */
static void check_value(fw_arena *arena, const fw_element *e, int k, const fw_quantity *q,
                        fw_diags *diags) {
    if (!fw_dimension_equal(q->dimension, dimension_of[k])) {
        fw_diag_error(diags, 25, place_of(e, "unit"),
                      "%s: the dimension must be '%s', and \"%s\" is '%s'; correct the unit",
                      ids[k], fw_dimension_text(arena, dimension_of[k]), q->unit,
                      fw_dimension_text(arena, q->dimension));
        return;
    }
    bool wrong = !(q->value > 0.0);
    const char *range = "above 0";
    switch (k) {
    case POISSON:
        wrong = !(q->value > -1.0 && q->value <= 0.5);
        range = "above -1 and at most 0.5 (elastic stability)";
        break;
    case LOSS:
        wrong = !(q->value >= 0.0);
        range = "at least 0 (a negative one would feed energy in)";
        break;
    case EXPANSION: /* some shrink when they warm up, but none by as much as this */
    case MODULUS_CHANGE:
        wrong = !(fabs(q->value) <= 0.01);
        range = "between -10000 and 10000 ppm/K (no solid changes by 1 % per kelvin)";
        break;
    }
    if (!q->unknown && wrong)
        fw_diag_error(diags, 47, place_of(e, "value"), "%s must be %s", ids[k], range);
}

/* one of limit_data.h */
static fw_status read_limit(fw_arena *arena, const fw_element *e, const fw_source_text *source,
                            int nsource, fw_diags *diags, int k, fw_material *m) {
    fw_quantity q, *slot_ = fw_limit_data_at(&m->limit, k);
    fw_status status = fw_quantity_read(arena, e, source, nsource, diags, &q);
    if (status != FW_OK) return status == FW_NOMEM ? status : FW_OK;
    const fw_dimension wanted = fw_limit_data_dimension(k);
    if (slot_->id)
        fw_diag_error(diags, 45, place_of(e, "id"), "material '%s' has '%s' twice; remove one",
                      m->id, q.id);
    else if (!fw_dimension_equal(q.dimension, wanted))
        fw_diag_error(diags, 25, place_of(e, "unit"),
                      "%s: the dimension must be '%s', and \"%s\" is '%s'; correct the unit", q.id,
                      fw_dimension_text(arena, wanted), q.unit,
                      fw_dimension_text(arena, q.dimension));
    else
        fw_limit_data_check(k, &q, place_of(e, "value"), diags);
    *slot_ = q;
    return FW_OK;
}

static fw_status read_child(fw_arena *arena, const fw_element *e, const fw_source_text *source,
                            int nsource, fw_diags *diags, fw_material *m) {
    const fw_attribute *id = fw_xml_attribute(e, "id");
    int k = id ? index_of(id->value) : -1;
    int limit = id && k < 0 ? fw_limit_data_index(id->value) : -1;
    if (limit >= 0) return read_limit(arena, e, source, nsource, diags, limit, m);
    if (id && k < 0) {
        const char *better = fw_did_you_mean(id->value, ids, IDS);
        if (!better) better = fw_did_you_mean(id->value, fw_limit_data_ids(), FW_LIMIT_DATA);
        if (better)
            fw_diag_error(diags, 72, id->place,
                          "material '%s' has no quantity '%s'; did you mean "
                          "'%s'?",
                          m->id, id->value, better);
        return FW_OK; /* other quantities belong to the flows */
    }
    fw_quantity q;
    fw_status status = fw_quantity_read(arena, e, source, nsource, diags, &q);
    if (status != FW_OK || !id) return status == FW_NOMEM ? status : FW_OK;
    if (slot(m, k)->id)
        return fw_diag_error(diags, 45, id->place, "material '%s' has '%s' twice; remove one",
                             m->id, ids[k]) == FW_NOMEM
                   ? FW_NOMEM
                   : FW_OK;
    check_value(arena, e, k, &q, diags);
    *slot(m, k) = q;
    return FW_OK;
}

/* all three or none, and stable against every strain: C44 > 0, C11 > |C12|, C11 + 2 C12 > 0 (Born)
 */
static void check_crystal(const fw_element *e, const fw_material *m, fw_diags *diags) {
    int given = !m->c11.unknown + !m->c12.unknown + !m->c44.unknown;
    double a = m->c11.value, b = m->c12.value;
    if (given > 0 && given < 3)
        fw_diag_error(
            diags, 209, e->place,
            "material '%s' has %d of c11, c12 and c44; a cubic crystal has all three, any "
            "other material none",
            m->id, given);
    else if (given == 3 && !(a > fabs(b) && a + 2 * b > 0))
        fw_diag_error(
            diags, 209, e->place,
            "material '%s' is not stable: c11 must be above |c12|, and c11 + 2 c12 above 0", m->id);
}

static fw_status read_material(fw_arena *arena, const fw_element *e, const fw_source_text *source,
                               int nsource, fw_diags *diags, fw_material *m) {
    const fw_attribute *name = fw_xml_attribute(e, "name");
    const fw_attribute *criterion = fw_xml_attribute(e, "criterion");
    *m = (fw_material){.id = fw_xml_attribute(e, "id")->value};
    m->name = name ? name->value : m->id;
    m->criterion = criterion ? criterion->value : "";
    for (const fw_element *q = e->first_child; q; q = q->next)
        if (strcmp(q->name, "q") == 0)
            FW_TRY(read_child(arena, q, source, nsource, diags, m));
        else
            fw_diag_error(diags, 40, q->place,
                          "<%.64s> is not known inside <material>; only <q> is", q->name);
    for (int k = 0; k < IDS; k++)
        if (!slot(m, k)->id)
            *slot(m, k) = (fw_quantity){.id = ids[k],
                                        .unknown = true,
                                        .dimension = dimension_of[k],
                                        .unit = "",
                                        .status = FW_ASSUMED,
                                        .source = "",
                                        .place = e->place};
    check_crystal(e, m, diags);
    fw_limit_data none = fw_limit_data_none(e->place);
    for (int k = 0; k < FW_LIMIT_DATA; k++)
        if (!fw_limit_data_at(&m->limit, k)->id)
            *fw_limit_data_at(&m->limit, k) = *fw_limit_data_at(&none, k);
    const char *whose = fw_arena_printf(arena, "material '%s'", m->id);
    FW_NEED(whose);
    fw_limit_data_complete(&m->limit, whose, e->place, diags);
    return FW_OK;
}

fw_status fw_materials_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                            fw_diags *diags, fw_materials *materials) {
    size_t before = diags->errors;
    *materials = (fw_materials){0};
    fw_element *root;
    fw_source_text *source;
    int nsource, count = 0;
    FW_TRY(fw_xml_read(arena, file, xml, n, diags, &root));
    if (fw_sources_read(arena, root, diags, &source, &nsource) == FW_NOMEM) return FW_NOMEM;
    for (const fw_element *e = root->first_child; e; e = e->next)
        count += strcmp(e->name, "material") == 0;
    FW_NEED(materials->item = fw_arena_array(arena, fw_material, (size_t)count));
    for (const fw_element *e = root->first_child; e; e = e->next) {
        if (strcmp(e->name, "material") != 0) continue;
        const fw_attribute *id = fw_xml_attribute(e, "id");
        if (!id || !id->value[0])
            fw_diag_error(diags, 43, e->place, "<material> has no id; add id=\"...\"");
        else if (fw_material_find(materials, id->value))
            fw_diag_error(diags, 45, id->place, "material '%s' is given twice; rename one",
                          id->value);
        else
            FW_TRY(read_material(arena, e, source, nsource, diags,
                                 &materials->item[materials->count++]));
    }
    return diags->failed ? FW_NOMEM : diags->errors > before ? FW_INPUT : FW_OK;
}

const fw_material *fw_material_find(const fw_materials *materials, const char *id) {
    for (int i = 0; id && i < materials->count; i++)
        if (strcmp(materials->item[i].id, id) == 0) return &materials->item[i];
    return NULL;
}

fw_material fw_material_with(const fw_material *material, const fw_material_override *override) {
    fw_material m = *material;
    const fw_quantity *const from[] = {&override->youngs, &override->poisson, &override->density,
                                       &override->strength};
    for (int k = 0; k < 4; k++) {
        if (from[k]->unknown || !from[k]->unit) /* unit NULL: an override that was never filled */
            continue;
        const char *id = slot(&m, k)->id;
        *slot(&m, k) = *from[k];
        slot(&m, k)->id = id;
        slot(&m, k)->source = "device file";
    }
    if (!override->youngs.unknown && override->youngs.unit)
        m.c11.unknown = m.c12.unknown = m.c44.unknown = true;
    m.strength_stated = override->strength.unit && !override->strength.unknown;
    fw_limit_data stated = override->limit;
    for (int k = 0; k < FW_LIMIT_DATA; k++) {
        const fw_quantity *q = fw_limit_data_at(&stated, k);
        if (!q->unit || q->unknown) continue;
        *fw_limit_data_at(&m.limit, k) = *q;
        fw_limit_data_at(&m.limit, k)->source = "device file";
    }
    return m;
}

bool fw_material_is_crystal(const fw_material *m) {
    const fw_quantity *const all[] = {&m->c11, &m->c12, &m->c44};
    for (int i = 0; i < 3; i++)
        if (all[i]->unknown || !(all[i]->value > 0)) return false;
    return true;
}
