/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What plates draw besides the device: each content with its drawing, its judgement and its row. */
#include "mask/mask_parts.h"
#include "release/release.h"
#include <math.h>

/* ---- hollows ----
   cavity: hollows in the carrier below all that moves, and the ground that is left below what is held.

   Drawn is the hollow as it shall be at the bonded face. Its layers have shrink and grow: an etch that widens the opening by
   u is printed u inside of it (land u outside). Judged is whether every held part keeps a bonded square of side

       bond + 2 overlay

   where overlay is the budget between the plate that prints the hollow and that of the device. Theory: docs/theory/plates.md;
   test: test_plates.c. */

enum { MARGIN, WALL, STEP, BOND };

static fw_release_cavity_asked asked_by(const fw_mask_content *c) {
    return (fw_release_cavity_asked){
        .margin_m = c->value[MARGIN], .wall_m = c->value[WALL], .step_m = c->value[STEP]};
}

static fw_status draw_cavity(const fw_mask_content *content, fw_mask_sheet *sheet) {
    fw_release_cavity_asked asked = asked_by(content);
    fw_release_cavity cavity;
    asked.drawn_only = true;
    FW_TRY(fw_release_cavity_make(sheet->arena, sheet->device, &asked, &cavity));
    for (int i = 0; i < cavity.hollow.count; i++)
        FW_TRY(fw_mask_sheet_add(sheet, FW_ROLE_CAVITY, FW_NONE - 1, "cavity",
                                 &cavity.hollow.contour[i]));
    for (int i = 0; i < cavity.land.count; i++)
        FW_TRY(fw_mask_sheet_add(sheet, FW_ROLE_LAND, FW_NONE - 1, "ground within a cavity",
                                 &cavity.land.contour[i]));
    return FW_OK;
}

static fw_status judge_cavity(const fw_mask_content *content, const fw_mask_table *table,
                              const fw_layout *layout, fw_mask_verdict *verdict) {
    fw_release_cavity_asked asked = asked_by(content);
    fw_release_cavity cavity;
    double overlay = fw_mask_overlay_m(table, FW_ROLE_CAVITY),
           least = content->value[BOND] + 2 * overlay;
    FW_TRY(fw_release_cavity_make(verdict->arena, layout, &asked, &cavity));
    verdict->widest_hollow_m = fmax(verdict->widest_hollow_m, cavity.widest.x1 - cavity.widest.x0);
    for (int i = 0; i < cavity.nground; i++) {
        const fw_release_ground *g = &cavity.ground[i];
        double side = g->square.x1 - g->square.x0;
        char have[32], need[32], bond[32], by[32], margin[32];
        if (side >= least - 1e-12) continue;
        FW_TRY(fw_mask_verdict_add(
            verdict, fw_arena_printf(
                         verdict->arena,
                         "%s is bonded to the carrier on a square of %s um at most, and needs one "
                         "of %s um (%s um, "
                         "and twice the overlay of %s um between the plates): around what moves "
                         "the carrier is "
                         "hollow for %s um; make it wider there, or move it away from what moves",
                         g->label, fw_number_text(have, sizeof have, side * 1e6, 4),
                         fw_number_text(need, sizeof need, least * 1e6, 4),
                         fw_number_text(bond, sizeof bond, content->value[BOND] * 1e6, 4),
                         fw_number_text(by, sizeof by, overlay * 1e6, 4),
                         fw_number_text(margin, sizeof margin, content->value[MARGIN] * 1e6, 4))));
    }
    return FW_OK;
}

const fw_mask_content_kind fw_mask_content_cavity = {
    .name = "cavity",
    .what = "hollows in the carrier below all that moves",
    .parameter = {{"margin", (double)NAN, 5e-6, 500e-6,
                   "From what moves to the edge of the hollow."},
                  {"wall", 40e-6, 5e-6, 500e-6,
                   "Narrowest ground between two hollows that stands."},
                  {"step", 10e-6, 2e-6, 50e-6, "Of the grid that its edges lie on."},
                  {"bond", 80e-6, 5e-6, 1e-3, "Side of a bonded square that holds a part."}},
    .nparameter = 4,
    .draw = draw_cavity,
    .judge = judge_cavity,
};

/* ---- metal of pads ----
   pad-metal: the metal of bond pads, one square on every part that is held and is not the frame: bases, and stators with their
   pads. It lies in the largest square within the part that is clear of its edges and of lettering, at most `side` large.
   Judged is whether every such part has room for one of `least`. Theory: docs/theory/plates.md; test: test_plates.c. */

enum { SIDE, LEAST, INSET };
static const double STEP_M = 5e-6;

static bool is_held(const fw_layout *layout, const fw_layout_piece *p) {
    return !fw_layout_cell_of(layout, p) && p->role == FW_ROLE_STRUCTURE &&
           (p->body == FW_GROUND || p->body == FW_ISLAND);
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

static fw_status draw_pad_metal(const fw_mask_content *content, fw_mask_sheet *sheet) {
    for (int i = 0; i < sheet->device->npiece; i++) {
        fw_geometry_box b;
        fw_geometry_contour square;
        if (!is_held(sheet->device, &sheet->device->piece[i])) continue;
        FW_TRY(square_of(sheet->arena, content, sheet->device, i, &b));
        if (b.x1 - b.x0 < content->value[LEAST] - 1e-12) continue;
        FW_TRY(fw_geometry_contour_rectangle(sheet->arena, b, &square));
        FW_TRY(
            fw_mask_sheet_add(sheet, FW_ROLE_METAL, FW_NONE - 1, "metal of a bond pad", &square));
    }
    return FW_OK;
}

static fw_status judge_pad_metal(const fw_mask_content *content, const fw_mask_table *table,
                                 const fw_layout *layout, fw_mask_verdict *verdict) {
    bool grounded = false;
    (void)table;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        fw_geometry_box b;
        char least[32];
        if (!is_held(layout, p)) continue;
        FW_TRY(square_of(verdict->arena, content, layout, i, &b));
        bool room = b.x1 - b.x0 >= content->value[LEAST] - 1e-12;
        verdict->pads += room;
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
    .draw = draw_pad_metal,
    .judge = judge_pad_metal,
};
