/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output.h"
#include "cli/session.h"
#include "continuum/continuum.h"
#include <jansson.h>
#include <stdio.h>

int fw_cli_command_doctor(fw_cli_options *options) {
    static const char *const needed[] = {"processes/base.xml", "processes/al-masked-rie.xml",
                                         "processes/copper-on-porous-silicon.xml",
                                         "masks/al-masked-rie.xml",
                                         "masks/copper-on-porous-silicon.xml"};
    fw_arena *arena = fw_arena_new(0);
    if (!arena) return fw_status_exit(FW_NOMEM);
    printf("flexwright %s\ncompiler %s\njansson %s\n", FW_VERSION, __VERSION__, JANSSON_VERSION);
    int missing = 0;
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
        const char *path = NULL;
        if (fw_data_path(arena, options->design.data_directory, needed[i], &path) != FW_OK)
            path = NULL;
        printf("%-40s %s\n", needed[i], path ? path : "MISSING");
        missing += !path;
    }
    const char *solver = fw_continuum_program(arena, "ccx"); /* no part of what must be there */
    printf("%-40s %s\n", "ccx (continuum level of hinges)", solver ? solver : fw_continuum_install);
#if defined(__x86_64__)
    printf("processor: fma %s, avx2 %s\n", __builtin_cpu_supports("fma") ? "yes" : "no",
           __builtin_cpu_supports("avx2") ? "yes" : "no");
#endif
    fw_arena_free(arena);
    return missing ? fw_status_exit(FW_IO) : 0;
}
