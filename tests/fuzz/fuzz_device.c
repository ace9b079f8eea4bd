/* SPDX-License-Identifier: GPL-3.0-or-later */
/* libFuzzer: any bytes as a device file, as a pack, and as an expression. A status that contradicts
   the diagnostics is a crash, too. Run: fuzz_device -dict=tests/fuzz/device.dict CORPUS tests/bad
 */
#include "device/device.h"
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n) {
    fw_arena *arena = fw_arena_new((size_t)64 * 1024 * 1024);
    if (!arena) return 0;
    const char *text = (const char *)data;
    const fw_device_set set[] = {{"link", "130 um"}, {"flexure[A]/@length", "312 um"}};
    for (int nset = 0; nset <= 2; nset += 2) {
        fw_diags diags = fw_diags_new(arena);
        const fw_device *device;
        fw_status s = fw_device_read(arena, "fuzz", text, n, set, nset, &diags, &device);
        if ((s == FW_OK && !device) || (s == FW_OK && diags.errors > 0) ||
            (s == FW_INPUT && diags.errors == 0))
            __builtin_trap();
    }
    fw_diags diags = fw_diags_new(arena);
    fw_device_materials materials;
    fw_status s = fw_device_materials_read(arena, "fuzz", text, n, &diags, &materials);
    if (s == FW_INPUT && diags.errors == 0) __builtin_trap();
    if (n < 5000) {
        double value;
        fw_quantity_expression_error error;
        s = fw_quantity_expression_evaluate(arena, text, n, NULL, (fw_quantity_dimension){.m = 1},
                                            &value, &error);
        if (s == FW_INPUT && (!error.message || error.offset > n)) __builtin_trap();
        fw_quantity_program *program;
        s = fw_quantity_program_compile(arena, text, n, NULL, (fw_quantity_dimension){.s = 1},
                                        &program, &error);
        if (s == FW_INPUT && (!error.message || error.offset > n)) __builtin_trap();
        for (int i = -1; s == FW_OK && i < 2; i++) {
            double v[3];
            fw_quantity_program_value(program, 0.5 * i, v);
        }
    }
    fw_arena_free(arena);
    return 0;
}
