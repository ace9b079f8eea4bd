/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nets of the drawing found again on the mask, in its certificate and on its order sheets. Theory:
   docs/theory/wiring.md; tests: test_wiring_mask.c, tests/accept/kl_nets.py */
#include "mask/mask_writers.h"
#include "mask/mask_polygons.h"
#include <math.h>

/* contours of the mask for the pieces of the layout: exact outlines with the bias, of which the polygons are
   proved to be within the tolerance */
fw_status fw_mask_wiring_check(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                               fw_diags *diags) {
    const fw_wiring *w = mask->wiring;
    fw_geometry_contour *contour;
    if (!w || w->npiece != layout->npiece) {
        mask->wiring = NULL;
        return FW_OK;
    }
    FW_NEED(contour = fw_arena_array(arena, fw_geometry_contour, (size_t)layout->npiece));
    for (int k = 0; k < mask->nshape; k++) {
        ptrdiff_t i = mask->shape[k].piece - layout->piece;
        bool device = mask->table->layer[mask->shape[k].layer].biased;
        if (device && w->net_of[i] >= 0) contour[i] = mask->shape[k].contour;
    }
    FW_TRY(fw_wiring_compare(arena, w, layout, contour, &mask->wired));
    if (mask->wired.same) return FW_OK;
    mask->nbroken++; /* no rule of a layer, but as good as one */
    return fw_diag_error(diags, 441, (fw_place){0}, "%s", mask->wired.differs);
}

static void place(fw_json *json, const char *key, fw_geometry_vec2 at) {
    fw_json_list(json, key);
    fw_json_fixed(json, NULL, at.x * 1e6, 4);
    fw_json_fixed(json, NULL, at.y * 1e6, 4);
    fw_json_end(json);
}

void fw_mask_wiring_json(fw_json *json, const fw_mask *mask) {
    const fw_wiring_on_mask *m = &mask->wired;
    if (!mask->wiring) return;
    fw_json_line(json, 2);
    fw_wiring_json(mask->wiring, json);
    fw_json_line(json, 2);
    fw_json_object(json, "nets_on_mask");
    fw_json_whole(json, "nets", m->nnet);
    fw_json_truth(json, "as_drawn", m->same);
    fw_json_number(json, "least_um", m->least_m * 1e6, 12);
    if (isfinite(m->least_m)) {
        place(json, "from_um", m->at[0]);
        place(json, "to_um", m->at[1]);
    }
    fw_json_list(json, "between");
    for (int i = 0; i < 2 && isfinite(m->least_m); i++)
        fw_json_text(json, NULL, m->label[i]);
    fw_json_end(json);
    fw_json_end(json);
}

/* only where something is driven: else there is nothing to contact */
static bool is_driven(const fw_mask *mask) {
    return mask->wiring && mask->wiring->ndrive > 0 && mask->wiring->carrier.insulates;
}

static bool has_pad(const fw_wiring_net *n) {
    return n->needed && n->padded;
}

static fw_geometry_vec2 middle(const fw_wiring_net *n) {
    return (fw_geometry_vec2){0.5 * (n->pad.x0 + n->pad.x1), 0.5 * (n->pad.y0 + n->pad.y1)};
}

fw_status fw_mask_ports(fw_arena *arena, const fw_mask *mask, fw_mask_port **port, int *count) {
    *count = 0;
    *port = NULL;
    if (!is_driven(mask) || mask->wiring->nnet == 0) return FW_OK;
    FW_NEED(*port = fw_arena_array(arena, fw_mask_port, (size_t)mask->wiring->nnet));
    for (int i = 0; i < mask->wiring->nnet; i++) {
        const fw_wiring_net *n = &mask->wiring->net[i];
        if (!has_pad(n)) continue;
        const fw_geometry_vec2 at = middle(n);
        fw_mask_port *p = &(*port)[(*count)++];
        *p = (fw_mask_port){NULL, (int32_t)lround(at.x * 1e9), (int32_t)lround(at.y * 1e9)};
        FW_TRY(fw_mask_note(arena, "port", n->name, &p->note));
    }
    return FW_OK;
}

void fw_mask_wiring_order_json(fw_json *json, const fw_mask *mask) {
    if (!is_driven(mask)) return;
    fw_json_line(json, 2);
    fw_json_list(json, "contacts");
    for (int i = 0; i < mask->wiring->nnet; i++) {
        const fw_wiring_net *n = &mask->wiring->net[i];
        fw_json_line(json, 4);
        fw_json_object(json, NULL);
        fw_json_text(json, "net", n->name);
        fw_json_text(json, "contact", fw_wiring_contact_word(n));
        if (has_pad(n)) {
            place(json, "centre_um", middle(n));
            fw_json_fixed(json, "side_um", (n->pad.x1 - n->pad.x0) * 1e6, 4);
        }
        fw_json_end(json);
    }
    fw_json_end_line(json, 2);
}

fw_status fw_mask_wiring_order_text(const fw_mask *mask, fw_text *out) {
    if (!is_driven(mask)) return FW_OK;
    fw_text_add(out, "\ncontacts, net by net\n");
    for (int i = 0; i < mask->wiring->nnet; i++) {
        const char *words;
        FW_TRY(fw_wiring_contact_words(out->arena, &mask->wiring->net[i], &words));
        fw_text_printf(out, "%s: %s\n", mask->wiring->net[i].name, words);
    }
    return FW_OK;
}
