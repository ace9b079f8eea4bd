/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials, and what they are known to bear (limit data). */
#include "base/text.h"
#include "device/material.h"
#include "xml/xml_reader.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

/* ---- limit data ---- */

#define PRESSURE .dimension = {-1, 1, -2, 0, 0, 0, 0, 0}
#define AT(name) .offset = offsetof(fw_device_limit_data, name)

typedef struct limit_row {
    fw_quantity_dimension dimension;
    size_t offset;
    double low, high; /* open below, closed above */
    const char *range;
} limit_row;

static const char *const limit_ids[FW_LIMIT_DATA] = {
    "weibull-strength",    "weibull-modulus",   "weibull-area",    "offset-yield",
    "proportional-factor", "film-yield",        "film-yield-rise", "film-exponent",
    "film-thickest",       "fatigue-strength",  "fatigue-cycles",  "fatigue-exponent",
    "ductility",           "ductility-exponent"};

static const limit_row limit_rows[FW_LIMIT_DATA] = {
    {PRESSURE, AT(weibull_strength), 0, 2e11, "above 0 and at most 200 GPa"},
    {AT(weibull_modulus), .low = 0, .high = 200,
     .range = "above 0 and at most 200 (0 or below is no distribution; 3 to 30 are reported)"},
    {.dimension = {.m = 2}, AT(weibull_area), 0, 1, "above 0 and at most 1 m2"},
    {PRESSURE, AT(offset_yield), 0, 2e11, "above 0 and at most 200 GPa"},
    {AT(proportional_factor), .low = 0, .high = 1,
     .range = "above 0 and at most 1 (the proportional limit lies below the 0.2 % offset value)"},
    {PRESSURE, AT(film_yield), 0, 2e11, "above 0 and at most 200 GPa"},
    {PRESSURE, AT(film_yield_rise), 0, 2e11, "above 0 and at most 200 GPa"},
    {AT(film_exponent), .low = 0, .high = 2, .range = "above 0 and at most 2"},
    {.dimension = {.m = 1}, AT(film_thickest), 0, 1e-3, "above 0 and at most 1 mm"},
    {PRESSURE, AT(fatigue_strength), 0, 2e11, "above 0 and at most 200 GPa"},
    {AT(fatigue_cycles), .low = 0, .high = 1e15, .range = "above 0 and at most 1e15"},
    {AT(fatigue_exponent), .low = -1, .high = -1e-6,
     .range = "above -1 and below 0 (more cycles bear less)"},
    {AT(ductility), .low = 0, .high = 10, .range = "above 0 and at most 10"},
    {AT(ductility_exponent), .low = -1, .high = -1e-6,
     .range = "above -1 and below 0 (more cycles bear less)"},
};

fw_quantity *fw_device_limit_data_at(fw_device_limit_data *data, int k) {
    return (fw_quantity *)(void *)((char *)data + limit_rows[k].offset);
}

static const fw_quantity *limit_at(const fw_device_limit_data *data, int k) {
    return (const fw_quantity *)(const void *)((const char *)data + limit_rows[k].offset);
}

const char *fw_device_limit_data_id(int k) {
    return limit_ids[k];
}

static const char *const *limit_data_ids(void) {
    return limit_ids;
}

fw_quantity_dimension fw_device_limit_data_dimension(int k) {
    return limit_rows[k].dimension;
}

static int limit_data_index(const char *id) {
    for (int k = 0; k < FW_LIMIT_DATA; k++)
        if (strcmp(limit_ids[k], id) == 0) return k;
    return -1;
}

static void limit_data_check(int k, const fw_quantity *q, fw_place place, fw_diags *diags) {
    if (q->unknown || (q->value > limit_rows[k].low && q->value <= limit_rows[k].high)) return;
    fw_diag_error(diags, 47, place, "%s must be %s", limit_ids[k], limit_rows[k].range);
}

/* how many of the quantities from..to-1 are known; *first: place of the first of them */
static int limits_known(const fw_device_limit_data *data, int from, int to, fw_place *first) {
    int n = 0;
    for (int k = from; k < to; k++)
        if (!limit_at(data, k)->unknown && n++ == 0) *first = limit_at(data, k)->place;
    return n;
}

void fw_device_limit_data_complete(const fw_device_limit_data *data, const char *whose,
                                   fw_place place, fw_diags *diags) {
    int n = limits_known(data, 0, 3, &place);
    if (n == 1 || n == 2)
        fw_diag_error(diags, 233, place,
                      "%s has %d of weibull-strength, weibull-modulus and weibull-area: a strength "
                      "holds only for the area and the scatter that it was found with; give all "
                      "three or none",
                      whose, n);
    n = !data->fatigue_strength.unknown + !data->fatigue_cycles.unknown;
    if (n == 1)
        fw_diag_error(diags, 234,
                      data->fatigue_strength.unknown ? data->fatigue_cycles.place
                                                     : data->fatigue_strength.place,
                      "%s has one of fatigue-strength and fatigue-cycles: an amplitude holds only "
                      "for a number of cycles; give both or none",
                      whose);
}

static fw_device_limit_data limit_data_none(fw_place place) {
    fw_device_limit_data none;
    memset(&none, 0, sizeof none);
    for (int k = 0; k < FW_LIMIT_DATA; k++)
        *fw_device_limit_data_at(&none, k) = (fw_quantity){.id = limit_ids[k],
                                                           .unknown = true,
                                                           .dimension = limit_rows[k].dimension,
                                                           .unit = "",
                                                           .status = FW_ASSUMED,
                                                           .source = "",
                                                           .place = place};
    return none;
}

/* ---- materials ---- */

enum {
    YOUNGS,
    POISSON,
    DENSITY,
    STRENGTH,
    LOSS,
    EXPANSION,
    EXPANSION_SLOPE,
    EXPANSION_CURVATURE,
    MODULUS_CHANGE,
    C11,
    C12,
    C44,
    IDS
};
static const char *const ids[IDS] = {"youngs",
                                     "poisson",
                                     "density",
                                     "strength",
                                     "loss",
                                     "expansion",
                                     "expansion-slope",
                                     "expansion-curvature",
                                     "modulus-change",
                                     "c11",
                                     "c12",
                                     "c44"};

static const fw_quantity_dimension dimension_of[IDS] = {[YOUNGS] = {-1, 1, -2, 0, 0, 0, 0, 0},
                                                        [DENSITY] = {.m = -3, .kg = 1},
                                                        [STRENGTH] = {-1, 1, -2, 0, 0, 0, 0, 0},
                                                        [EXPANSION] = {.K = -1},
                                                        [EXPANSION_SLOPE] = {.K = -2},
                                                        [EXPANSION_CURVATURE] = {.K = -3},
                                                        [MODULUS_CHANGE] = {.K = -1},
                                                        [C11] = {-1, 1, -2, 0, 0, 0, 0, 0},
                                                        [C12] = {-1, 1, -2, 0, 0, 0, 0, 0},
                                                        [C44] = {-1, 1, -2, 0, 0, 0, 0, 0}};

static fw_quantity *slot(fw_device_material *m, int k) {
    fw_quantity *const all[IDS] = {&m->youngs,
                                   &m->poisson,
                                   &m->density,
                                   &m->strength,
                                   &m->loss,
                                   &m->expansion,
                                   &m->expansion_slope,
                                   &m->expansion_curvature,
                                   &m->modulus_change,
                                   &m->c11,
                                   &m->c12,
                                   &m->c44};
    return all[k];
}

double fw_device_mean_expansion(const fw_quantity *expansion, const fw_quantity *slope,
                                const fw_quantity *curvature, double change_K) {
    if (expansion->unknown) return (double)NAN;
    const double rises = slope->unknown ? 0 : slope->value;
    const double bends = curvature->unknown ? 0 : curvature->value;
    return expansion->value + change_K * (rises + change_K * bends);
}

static int index_of(const char *id) {
    for (int k = 0; k < IDS; k++)
        if (strcmp(ids[k], id) == 0) return k;
    return -1;
}

static fw_place place_of(const fw_xml_element *e, const char *name) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, name);
    return a ? a->place : e->place;
}

/* positive where a formula divides by it; Poisson's ratio within its stable range */
static void check_value(fw_arena *arena, const fw_xml_element *e, int k, const fw_quantity *q,
                        fw_diags *diags) {
    if (!fw_quantity_dimension_equal(q->dimension, dimension_of[k])) {
        fw_diag_error(diags, 25, place_of(e, "unit"),
                      "%s: the dimension must be '%s', and \"%s\" is '%s'; correct the unit",
                      ids[k], fw_quantity_dimension_text(arena, dimension_of[k]), q->unit,
                      fw_quantity_dimension_text(arena, q->dimension));
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
    case EXPANSION_SLOPE:
        wrong = !(fabs(q->value) <= 1e-6);
        range = "between -1 and 1 ppm/K2 (no expansion changes by 1 ppm/K over a kelvin)";
        break;
    case EXPANSION_CURVATURE:
        wrong = !(fabs(q->value) <= 1e-8);
        range = "between -0.01 and 0.01 ppm/K3";
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

/* one of fw_device_limit_data */
static fw_status read_limit(fw_arena *arena, const fw_xml_element *e,
                            const fw_xml_source_text *source, int nsource, fw_diags *diags, int k,
                            fw_device_material *m) {
    fw_quantity q, *slot_ = fw_device_limit_data_at(&m->limit, k);
    fw_status status = fw_xml_quantity_read(arena, e, source, nsource, diags, &q);
    if (status != FW_OK) return status == FW_NOMEM ? status : FW_OK;
    const fw_quantity_dimension wanted = fw_device_limit_data_dimension(k);
    if (slot_->id)
        fw_diag_error(diags, 45, place_of(e, "id"), "material '%s' has '%s' twice; remove one",
                      m->id, q.id);
    else if (!fw_quantity_dimension_equal(q.dimension, wanted))
        fw_diag_error(diags, 25, place_of(e, "unit"),
                      "%s: the dimension must be '%s', and \"%s\" is '%s'; correct the unit", q.id,
                      fw_quantity_dimension_text(arena, wanted), q.unit,
                      fw_quantity_dimension_text(arena, q.dimension));
    else
        limit_data_check(k, &q, place_of(e, "value"), diags);
    *slot_ = q;
    return FW_OK;
}

static fw_status read_child(fw_arena *arena, const fw_xml_element *e,
                            const fw_xml_source_text *source, int nsource, fw_diags *diags,
                            fw_device_material *m) {
    const fw_xml_attribute *id = fw_xml_attribute_of(e, "id");
    int k = id ? index_of(id->value) : -1;
    int limit = id && k < 0 ? limit_data_index(id->value) : -1;
    if (limit >= 0) return read_limit(arena, e, source, nsource, diags, limit, m);
    if (id && k < 0) {
        const char *better = fw_did_you_mean(id->value, ids, IDS);
        if (!better) better = fw_did_you_mean(id->value, limit_data_ids(), FW_LIMIT_DATA);
        if (better)
            fw_diag_error(diags, 72, id->place,
                          "material '%s' has no quantity '%s'; did you mean "
                          "'%s'?",
                          m->id, id->value, better);
        return FW_OK; /* other quantities belong to the flows */
    }
    fw_quantity q;
    fw_status status = fw_xml_quantity_read(arena, e, source, nsource, diags, &q);
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
static void check_crystal(const fw_xml_element *e, const fw_device_material *m, fw_diags *diags) {
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

static fw_status read_material(fw_arena *arena, const fw_xml_element *e,
                               const fw_xml_source_text *source, int nsource, fw_diags *diags,
                               fw_device_material *m) {
    const fw_xml_attribute *name = fw_xml_attribute_of(e, "name");
    const fw_xml_attribute *criterion = fw_xml_attribute_of(e, "criterion");
    *m = (fw_device_material){.id = fw_xml_attribute_of(e, "id")->value};
    m->name = name ? name->value : m->id;
    m->criterion = criterion ? criterion->value : "";
    for (const fw_xml_element *q = e->first_child; q; q = q->next)
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
    fw_device_limit_data none = limit_data_none(e->place);
    for (int k = 0; k < FW_LIMIT_DATA; k++)
        if (!fw_device_limit_data_at(&m->limit, k)->id)
            *fw_device_limit_data_at(&m->limit, k) = *fw_device_limit_data_at(&none, k);
    const char *whose = fw_arena_printf(arena, "material '%s'", m->id);
    FW_NEED(whose);
    fw_device_limit_data_complete(&m->limit, whose, e->place, diags);
    return FW_OK;
}

static fw_status read_all(fw_arena *arena, const fw_xml_element *root, fw_diags *diags,
                          fw_device_materials *materials) {
    for (const fw_xml_element *e = root->first_child; e; e = e->next) {
        if (strcmp(e->name, "material") != 0) continue;
        const fw_xml_attribute *id = fw_xml_attribute_of(e, "id");
        if (!id || !id->value[0])
            fw_diag_error(diags, 43, e->place, "<material> has no id; add id=\"...\"");
        else if (fw_device_material_find(materials, id->value))
            fw_diag_error(diags, 45, id->place, "material '%s' is given twice; rename one",
                          id->value);
        else
            FW_TRY(read_material(arena, e, materials->source, materials->nsource, diags,
                                 &materials->item[materials->count++]));
    }
    return FW_OK;
}

/* the flow's sources come first: it may give one of the shared ones again */
static fw_status join_sources(fw_arena *arena, const fw_xml_source_text *own, int nown,
                              const fw_device_materials *shared, fw_device_materials *materials) {
    const int more = shared ? shared->nsource : 0;
    fw_xml_source_text *all = fw_arena_array(arena, fw_xml_source_text, (size_t)(nown + more));
    FW_NEED(all);
    for (int i = 0; i < nown + more; i++)
        all[i] = i < nown ? own[i] : shared->source[i - nown];
    materials->source = all;
    materials->nsource = nown + more;
    return FW_OK;
}

fw_status fw_device_materials_of_flow(fw_arena *arena, const char *file, const char *xml, size_t n,
                                      const fw_device_materials *shared, fw_diags *diags,
                                      fw_device_materials *materials) {
    size_t before = diags->errors;
    *materials = (fw_device_materials){0};
    fw_xml_element *root;
    fw_xml_source_text *source;
    int nsource, count = shared ? shared->count : 0;
    FW_TRY(fw_xml_read(arena, file, xml, n, diags, &root));
    if (fw_xml_sources_read(arena, root, diags, &source, &nsource) == FW_NOMEM) return FW_NOMEM;
    FW_TRY(join_sources(arena, source, nsource, shared, materials));
    for (const fw_xml_element *e = root->first_child; e; e = e->next)
        count += strcmp(e->name, "material") == 0;
    FW_NEED(materials->item = fw_arena_array(arena, fw_device_material, (size_t)count));
    FW_TRY(read_all(arena, root, diags, materials));
    for (int i = 0; shared && i < shared->count; i++)
        if (!fw_device_material_find(materials, shared->item[i].id))
            materials->item[materials->count++] = shared->item[i];
    return diags->failed ? FW_NOMEM : diags->errors > before ? FW_INPUT : FW_OK;
}

fw_status fw_device_materials_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                                   fw_diags *diags, fw_device_materials *materials) {
    return fw_device_materials_of_flow(arena, file, xml, n, NULL, diags, materials);
}

const fw_device_material *fw_device_material_find(const fw_device_materials *materials,
                                                  const char *id) {
    for (int i = 0; id && i < materials->count; i++)
        if (strcmp(materials->item[i].id, id) == 0) return &materials->item[i];
    return NULL;
}

fw_device_material fw_device_material_with(const fw_device_material *material,
                                           const fw_device_material_override *override) {
    fw_device_material m = *material;
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
    if (!override->youngs.unknown && override->youngs.unit) {
        m.plane_by_constants = fw_device_material_is_crystal(&m) &&
                               (override->poisson.unknown || !override->poisson.unit);
        m.c11.unknown = m.c12.unknown = m.c44.unknown = true;
    }
    m.strength_stated = override->strength.unit && !override->strength.unknown;
    fw_device_limit_data stated = override->limit;
    for (int k = 0; k < FW_LIMIT_DATA; k++) {
        const fw_quantity *q = fw_device_limit_data_at(&stated, k);
        if (!q->unit || q->unknown) continue;
        *fw_device_limit_data_at(&m.limit, k) = *q;
        fw_device_limit_data_at(&m.limit, k)->source = "device file";
    }
    return m;
}

bool fw_device_material_is_crystal(const fw_device_material *m) {
    const fw_quantity *const all[] = {&m->c11, &m->c12, &m->c44};
    for (int i = 0; i < 3; i++)
        if (all[i]->unknown || !(all[i]->value > 0)) return false;
    return true;
}

/* Biaxial modulus M of the plane of a layer, whose faces bear nothing:
     isotropic                     M = E/(1 - nu)
     cubic, cut (100)              M = c11 + c12 - 2 c12^2/c11, alike in every direction of the plane
   A crystal's E is one of many directions and its nu is out of the plane, so that E/(1 - nu) of the two is nobody's: of
   silicon 213 GPa in place of 180.3. Where the device file states E of a crystal alone, its nu is still the crystal's, and
   the constants hold; with both, E/(1 - nu) of these. In: Pa; out: Pa, exact. Error: of the constants' uncertainties,
   (1 + 2 (c12/c11)^2) u(c11) and (1 - 4 c12/c11) u(c12), 0.4 % of silicon, which is within the range of E at corners.
   Source: W. A. Brantley, J. Appl. Phys. 44 (1973) 534. Test: test_material.c biaxial_of_a_crystal */
double fw_device_material_biaxial_Pa(const fw_device_material *m) {
    const double a = m->c11.value, b = m->c12.value;
    if (fw_device_material_is_crystal(m) || m->plane_by_constants) return a + b - 2 * b * b / a;
    if (m->youngs.unknown || m->poisson.unknown || !(m->youngs.value > 0)) return (double)NAN;
    return m->youngs.value / (1 - m->poisson.value);
}
