/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law that is an expression in time. It has no proved bounds: samples would have to stand for a
   proof. Test: test_time_law.c, test_stride.c */
#include "quantity/law_kind.h"
#include "quantity/program.h"
#include <math.h>

static void value_of(const fw_quantity_law *law, double t_s, double piece_s, double value[3]) {
    fw_quantity_program_value_in(law->program, t_s, piece_s, value);
}

enum { SAMPLES = 2000, SWITCHES_MOST = 1000 };

/* Switches of abs, min, max: the sides are compared at SAMPLES instants, and where two neighbours
   differ the switch is halved down to neighbouring numbers. Two switches between neighbours may
   hide each other; the integrator's own error control then meets the bend. */
static void breaks_of(const fw_quantity_law *law, fw_quantity_law_breaks *b) {
    const fw_quantity_program *program = law->program;
    if (fw_quantity_program_smooth(program) || !isfinite(b->end_s)) return;
    double left = 0;
    uint64_t at_left = fw_quantity_program_branches(program, 0);
    for (int i = 1; i <= SAMPLES && b->count < SWITCHES_MOST; i++) {
        double right = b->end_s * i / SAMPLES;
        const uint64_t at_right = fw_quantity_program_branches(program, right);
        while (at_left != at_right && b->count < SWITCHES_MOST) {
            double low = left, high = right;
            for (double middle = low + (high - low) / 2; middle > low && middle < high;
                 middle = low + (high - low) / 2)
                if (fw_quantity_program_branches(program, middle) == at_left)
                    low = middle;
                else
                    high = middle;
            fw_quantity_law_break(b, high);
            left = high;
            at_left = fw_quantity_program_branches(program, high);
        }
        left = right;
        at_left = at_right;
    }
}

static bool is_ready(const fw_quantity_law *law) {
    return law->program != NULL;
}

/* time does not occur in it */
static bool is_straight(const fw_quantity_law *law) {
    for (int i = 0; i < law->program->count; i++)
        if (law->program->step[i].op == FW_OP_TIME) return false;
    return true;
}

static const fw_quantity_law_attribute attributes[] = {{"factor", FW_QUANTITY_LAW_EXPRESSION,
                                                        .needed = true, .unit = "1",
                                                        .sentence = "the factor at the time t"}};
const fw_quantity_law_kind fw_quantity_law_expression = {.name = "expression",
                                                         .factor =
                                                             "an expression in time, a pure number",
                                                         .words = " in time",
                                                         FW_LAW_ROWS(attributes),
                                                         .value = value_of,
                                                         .breaks = breaks_of,
                                                         .straight = is_straight,
                                                         .is_ready = is_ready};
