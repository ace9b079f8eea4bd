/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <wafer> and its sweeps. Whether dies fit is asked where the die is known. */
#include "device/reader.h"
#include <math.h>
#include <string.h>

enum { MOST_VARIANTS = 64 };

static bool says(const fw_record *record, const char *name, const char *word) {
    const char *text = fw_text_of(record, name);
    return text && strcmp(text, word) == 0;
}

static fw_wafer_side side_of(const fw_record *record) {
    if (says(record, "flat-side", "top")) return FW_SIDE_TOP;
    if (says(record, "flat-side", "left")) return FW_SIDE_LEFT;
    return says(record, "flat-side", "right") ? FW_SIDE_RIGHT : FW_SIDE_BOTTOM;
}

static fw_wafer_asked wafer_of(const fw_record *record) {
    double tests = fw_number_or(record, "test-dies", 0);
    return (fw_wafer_asked){.asked = true,
                            .diameter_m = fw_number_or(record, "diameter", 0.1),
                            .flat_m = fw_number_of(record, "flat"),
                            .edge_m = fw_number_or(record, "edge-exclusion", 3e-3),
                            .pitch_x_m = fw_number_of(record, "pitch-x"),
                            .pitch_y_m = fw_number_of(record, "pitch-y"),
                            .side = side_of(record),
                            .centre = says(record, "centre", "die")      ? FW_CENTRE_DIE
                                      : says(record, "centre", "street") ? FW_CENTRE_STREET
                                                                         : FW_CENTRE_AUTO,
                            .alignment = says(record, "alignment", "2 sites"),
                            .tests = isfinite(tests) ? (int)tests : 0,
                            .blocks = says(record, "assign", "blocks"),
                            .plate_m = fw_number_of(record, "plate"),
                            .title = fw_text_of(record, "title"),
                            .place = record->element->place};
}

/* one end of a sweep, in the parameter's own dimension */
static fw_status read_end(fw_reader *r, const fw_record *record, const char *name,
                          const fw_parameter *p, double *value, bool *ok) {
    const fw_cell *cell = fw_cell_of(record, name);
    fw_dimension found;
    *ok = false;
    if (!cell->given) return FW_OK; /* reported as missing */
    return fw_attribute_evaluate(r, cell->given, name, &p->dimension, &found, value, ok);
}

static bool fits(const char *unit, fw_dimension dimension) {
    fw_unit u = {0};
    static const fw_dimension pure;
    if (!*unit) return fw_dimension_equal(dimension, pure);
    return fw_unit_parse(unit, strlen(unit), &u, NULL, NULL) &&
           fw_dimension_equal(u.dimension, dimension);
}

/* the unit in which steps are written: of `from`, else of the parameter */
static fw_status unit_of(fw_reader *r, const fw_record *record, const fw_parameter *p,
                         const char **unit, bool *ok) {
    const char *from = fw_cell_of(record, "from")->given->value;
    FW_TRY(fw_expression_unit(r->arena, from, strlen(from), p->dimension, unit));
    if (!fits(*unit, p->dimension)) *unit = p->unit ? p->unit : "";
    *ok = fits(*unit, p->dimension);
    if (!*ok)
        fw_diag_error(
            r->diags, 190, fw_place_of(record, "from"),
            "<sweep>: from=\"%s\" has no unit of its own in which the steps of '%s' could "
            "be written; write it with one",
            from, p->name);
    return FW_OK;
}

static fw_status add_sweep(fw_reader *r, const fw_record *record) {
    fw_wafer_asked *w = &r->device->wafer;
    int k = fw_reference(r, record, "parameter");
    double steps = fw_number_of(record, "steps");
    if (k < 0 || k >= r->device->nparameter || !isfinite(steps)) return FW_OK;
    const fw_parameter *p = &r->device->parameter[k];
    fw_sweep s = {.parameter = k, .steps = (int)steps, .place = record->element->place};
    bool from, to, unit = false;
    FW_TRY(read_end(r, record, "from", p, &s.from, &from));
    FW_TRY(read_end(r, record, "to", p, &s.to, &to));
    if (from) FW_TRY(unit_of(r, record, p, &s.unit, &unit));
    if (!from || !to || !unit) return FW_OK;
    if (w->nsweep == 1 && w->sweep[0].parameter == k) {
        fw_diag_error(r->diags, 190, s.place, "<sweep>: '%s' is swept twice; remove one", p->name);
        return FW_OK;
    }
    if (w->nsweep == 1 && w->sweep[0].steps * s.steps > MOST_VARIANTS) {
        fw_diag_error(r->diags, 190, s.place,
                      "<sweep>: %d times %d steps are %d different devices; at most %d are judged "
                      "and drawn",
                      w->sweep[0].steps, s.steps, w->sweep[0].steps * s.steps, MOST_VARIANTS);
        return FW_OK;
    }
    if (w->nsweep < 2) w->sweep[w->nsweep++] = s;
    return FW_OK;
}

fw_status fw_build_wafer(fw_reader *r) {
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "wafer")) r->device->wafer = wafer_of(&r->record[i]);
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "sweep")) FW_TRY(add_sweep(r, &r->record[i]));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
