/* SPDX-License-Identifier: GPL-3.0-or-later */
/* pad-metal: the metal of bond pads, one square on every part that is held and is not the frame: bases, and stators with their
   pads. It lies in the largest square within the part that is clear of its edges and of lettering, at most `side` large.
   Judged is whether every such part has room for one of `least`. Theory: docs/theory/plates.md; test: test_plates.c. */
#include "mask/mask_plates.h"
#include "release/release_cavity.h"
#include <math.h>

enum { SIDE, LEAST, INSET };
static const double STEP_M = 5e-6;

static bool is_held(const fw_layout_piece *p) {
    return p->role == FW_ROLE_STRUCTURE && (p->body == FW_GROUND || p->body == FW_ISLAND);
}

/* one of the pieces of a part that are joined: the one with the largest square stands for it */
static fw_status square_of(fw_arena *arena, const fw_mask_content *content, const fw_layout *layout,
                           int piece, fw_geometry_box *square) {
    fw_geometry_box b;
    FW_TRY(fw_release_square_in(arena, layout, piece, content->value[INSET], STEP_M, &b));
    double side = fmin(b.x1 - b.x0, content->value[SIDE]);
    double x = 0.5 * (b.x0 + b.x1), y = 0.5 * (b.y0 + b.y1);
    *square = (fw_geometry_box){x - 0.5 * side, y - 0.5 * side, x + 0.5 * side, y + 0.5 * side};
    return FW_OK;
}

static fw_status draw(const fw_mask_content *content, fw_mask_sheet *sheet) {
    for (int i = 0; i < sheet->device->npiece; i++) {
        fw_geometry_box b;
        fw_geometry_contour square;
        if (!is_held(&sheet->device->piece[i])) continue;
        FW_TRY(square_of(sheet->arena, content, sheet->device, i, &b));
        if (b.x1 - b.x0 < content->value[LEAST] - 1e-12) continue;
        FW_TRY(fw_geometry_contour_rectangle(sheet->arena, b, &square));
        FW_TRY(
            fw_mask_sheet_add(sheet, FW_ROLE_METAL, FW_NONE - 1, "metal of a bond pad", &square));
    }
    return FW_OK;
}

static fw_status judge(const fw_mask_content *content, const fw_mask_table *table,
                       const fw_layout *layout, fw_mask_verdict *verdict) {
    bool grounded = false;
    (void)table;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        fw_geometry_box b;
        char least[32];
        if (!is_held(p)) continue;
        FW_TRY(square_of(verdict->arena, content, layout, i, &b));
        bool room = b.x1 - b.x0 >= content->value[LEAST] - 1e-12;
        if (p->body == FW_GROUND) grounded = grounded || room;
        if (room || p->body == FW_GROUND) continue;
        FW_TRY(fw_mask_verdict_add(
            verdict,
            fw_arena_printf(verdict->arena,
                            "%s has no room for the metal of a bond pad, which needs %s um clear "
                            "of its edges and of "
                            "lettering; make its pad larger",
                            p->label,
                            fw_number_text(least, sizeof least, content->value[LEAST] * 1e6, 4))));
    }
    if (grounded) return FW_OK;
    return fw_mask_verdict_add(verdict,
                               "no base has room for the metal of a bond pad, so that nothing "
                               "connects what moves; make a base wider");
}

const fw_mask_content_kind fw_mask_content_pad_metal = {
    .name = "pad-metal",
    .what = "metal of bond pads on what is held",
    .parameter = {{"side", 120e-6, 30e-6, 1e-3, "Of its square, at most."},
                  {"least", 80e-6, 30e-6, 1e-3, "... and at least: what a wire needs."},
                  {"inset", 10e-6, 1e-6, 100e-6, "From the edges of what carries it."}},
    .nparameter = 3,
    .draw = draw,
    .judge = judge,
};
