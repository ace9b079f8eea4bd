/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the reference page of device files and their schema: for tests/arch/additions.py. */
#include "base/text.h"
#include "device/device.h"
#include <stdio.h>

int main(void) {
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    if (fw_device_reference_markdown(&text) != FW_OK || fw_device_relax_ng(&text) != FW_OK)
        return 1;
    fwrite(text.data, 1, text.length, stdout);
    fw_arena_free(arena);
    return 0;
}
