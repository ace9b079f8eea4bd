/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer map as a table: one line per place, for wafer probers, spreadsheets and whoever picks
   dies. x and y are of the die's middle from the wafer's centre. */
#include "wafer/wafer_notes.h"
#include <math.h>

static void heading(const fw_wafer *w, fw_text *out) {
    const fw_device_wafer_asked *asked = &w->device->wafer;
    fw_text_add(out, "die,row,column,x_mm,y_mm,kind,variant");
    for (int k = 0; k < asked->nsweep; k++) {
        const fw_device_sweep *s = &asked->sweep[k];
        fw_text_printf(out, ",%s", w->device->parameter[s->parameter].name);
        if (*s->unit) fw_text_printf(out, " [%s]", s->unit);
    }
    fw_text_add(out, ",verdict,utilisation,note\n");
}

/* a note holds commas */
static void quoted(fw_text *out, const char *text) {
    fw_text_add(out, "\"");
    for (const char *s = text; *s; s++) {
        if (*s == '"') fw_text_add(out, "\"");
        fw_text_bytes(out, *s == '\n' ? " " : s, 1);
    }
    fw_text_add(out, "\"");
}

/* what the die is, which need not be what its step asked for */
static fw_status variant(const fw_wafer *w, const fw_wafer_site *s, fw_text *out) {
    int sweeps = w->device->wafer.nsweep;
    if (s->variant < 0) {
        for (int k = 0; k < sweeps + 4; k++)
            fw_text_add(out, ",");
        return FW_OK;
    }
    const fw_wafer_variant *asked = &w->variant[s->variant];
    const fw_wafer_variant *is = fw_wafer_stood_in(asked) ? &w->stand_in : asked;
    fw_text_printf(out, ",%d", s->variant + 1);
    for (int k = 0; k < sweeps; k++) {
        fw_text_add(out, ",");
        fw_text_number(out, fw_wafer_value(w, is, k), 9);
    }
    fw_text_printf(out, ",%s,", is->decision ? is->decision : "");
    if (isfinite(is->utilisation)) fw_text_number(out, is->utilisation, 6);
    fw_text_add(out, ",");
    if (is == asked) return FW_OK;
    const char *values = fw_wafer_values(out->arena, w, asked);
    FW_NEED(values);
    const char *note = fw_arena_printf(out->arena, "nominal die in place of %s", values);
    FW_NEED(note);
    quoted(out, note);
    return FW_OK;
}

fw_status fw_wafer_write_csv(const fw_wafer *w, fw_text *out) {
    const fw_wafer_grid *g = &w->grid;
    fw_text_reserve(out, 4096 + 96 * (size_t)g->nsite);
    heading(w, out);
    for (int i = 0; i < g->nsite; i++) {
        const fw_wafer_site *s = &g->site[i];
        char name[2 * FW_WAFER_NAME], row[FW_WAFER_NAME];
        fw_text_printf(out, "%s,%s,%d,", fw_wafer_site_name(w, s, name),
                       fw_wafer_row_name(s->row, row), s->column + 1);
        fw_text_fixed(out, 1e-6 * (s->x + 0.5 * g->width), 7);
        fw_text_add(out, ",");
        fw_text_fixed(out, 1e-6 * (s->y + 0.5 * g->height), 7);
        fw_text_printf(out, ",%s", fw_wafer_kind_text(s->kind));
        FW_TRY(variant(w, s, out));
        fw_text_add(out, "\n");
    }
    return fw_text_end(out);
}
