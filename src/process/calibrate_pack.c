/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/calibrate.h"
#include <math.h>
#include <string.h>

/* value and uncertainty in the unit of the flow's own quantity */
static bool in_unit(const fw_quantity *q, double value, double u, double *shown, double *u_shown) {
    fw_quantity_unit unit;
    if (!fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL)) return false;
    *shown = fw_quantity_unit_from_si(&unit, value);
    unit.offset = 0.0;
    *u_shown = fw_quantity_unit_from_si(&unit, u);
    return true;
}

static void attribute(fw_text *out, const char *name, const char *value) {
    fw_text_printf(out, " %s=\"", name);
    fw_text_escaped(out, value);
    fw_text_add(out, "\"");
}

static void put_test(fw_text *out, const fw_process_calibrated *c) {
    if (c->freedom == 0) {
        fw_text_add(out, "no residual to test");
        return;
    }
    fw_text_add(out, "chi square ");
    fw_text_number(out, c->chi_square, 3);
    fw_text_printf(out, ", %d degree%s of freedom, probability ", c->freedom,
                   c->freedom > 1 ? "s" : "");
    fw_text_number(out, c->probability, 2);
}

fw_status fw_process_calibration_pack(const fw_process_flow *flow,
                                      const fw_process_calibration *calibration,
                                      const char *measured_file, const char *measured_sha256,
                                      fw_text *out) {
    fw_text_add(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Values of a laboratory. Each "
        "replaces the one with its id where the option lab of flexwright names this file. -->\n"
        "<process xmlns=\"urn:flexwright:process:1\" id=\"lab\" version=\"1\" "
        "title=\"Values of the laboratory\"");
    attribute(out, "flow", flow->id);
    fw_text_add(out, ">\n  <source id=\"coupons\" kind=\"measured\">measured coupons, ");
    fw_text_escaped(out, measured_file);
    fw_text_printf(out, ", SHA-256 %.16s</source>\n", measured_sha256);
    for (int i = 0; i < calibration->count; i++) {
        const fw_process_calibrated *c = &calibration->item[i];
        const fw_quantity *q = fw_process_flow_quantity(flow, c->id);
        double value, u;
        if (!q || !in_unit(q, c->value, c->uncertainty, &value, &u)) return FW_INTERNAL;
        fw_text_add(out, "  <q");
        attribute(out, "id", c->id);
        fw_text_add(out, " value=\"");
        fw_text_number(out, value, 9);
        fw_text_add(out, "\" u=\"");
        fw_text_number(out, u, 4);
        fw_text_add(out, "\"");
        attribute(out, "unit", q->unit);
        fw_text_add(out, " status=\"measured\" src=\"coupons\" note=\"");
        fw_text_escaped(out, c->coupon);
        fw_text_add(out, ": ");
        fw_text_escaped(out, c->note);
        fw_text_add(out, "; ");
        put_test(out, c);
        fw_text_add(out, "\"/>\n");
    }
    fw_text_add(out, "</process>\n");
    return fw_text_end(out);
}

static void put_amount(fw_text *out, const fw_quantity *q, double value, double uncertainty) {
    double shown, u;
    if (!in_unit(q, value, uncertainty, &shown, &u)) return;
    fw_text_number(out, shown, 6);
    fw_text_add(out, " +- ");
    fw_text_number(out, u, 2);
    if (strcmp(q->unit, "1") != 0) fw_text_printf(out, " %s", q->unit);
}

fw_status fw_process_calibration_text(const fw_process_flow *flow,
                                      const fw_process_calibration *calibration, fw_text *out) {
    for (int i = 0; i < calibration->count; i++) {
        const fw_process_calibrated *c = &calibration->item[i];
        const fw_quantity *q = fw_process_flow_quantity(flow, c->id);
        if (!q) return FW_INTERNAL;
        fw_text_printf(out, "%s: ", c->id);
        put_amount(out, q, c->value, c->uncertainty);
        fw_text_add(out, ", was ");
        if (q->unknown)
            fw_text_add(out, "unknown");
        else {
            put_amount(out, q, q->value, q->uncertainty);
            fw_text_printf(out, " (%s)", fw_quantity_value_status_text(q->status));
        }
        fw_text_printf(out, "\n  %s, %d row%s: %s; ", c->coupon, c->rows, c->rows > 1 ? "s" : "",
                       c->note);
        put_test(out, c);
        fw_text_add(out, "\n");
    }
    return fw_text_end(out);
}
