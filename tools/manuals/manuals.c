/* SPDX-License-Identifier: GPL-3.0-or-later */
/* manuals DIRECTORY: writes there the manual pages flexwright.1 and flexwright-COMMAND.1, and completions
   flexwright.bash, _flexwright (zsh) and flexwright.fish. */
#include "cli/cli.h"
#include <stdio.h>
#include <string.h>

static fw_status save(const char *directory, const char *name, const fw_text *text) {
    char path[4200];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE *file = text->failed ? NULL : fopen(path, "wb");
    if (!file) return FW_IO;
    const bool written = fwrite(text->data, 1, text->length, file) == text->length;
    return fclose(file) == 0 && written ? FW_OK : FW_IO;
}

static fw_status manuals(fw_arena *arena, const char *directory) {
    size_t n;
    const fw_cli_command *command = fw_cli_command_table(&n);
    fw_text page = fw_text_new(arena);
    fw_cli_manual(NULL, &page);
    FW_TRY(save(directory, "flexwright.1", &page));
    for (size_t i = 0; i < n; i++) {
        char name[80];
        fw_text text = fw_text_new(arena);
        snprintf(name, sizeof name, "flexwright-%s.1", command[i].name);
        fw_cli_manual(&command[i], &text);
        FW_TRY(save(directory, name, &text));
    }
    return FW_OK;
}

static fw_status completions(fw_arena *arena, const char *directory) {
    static const struct {
        fw_cli_shell shell;
        const char *name;
    } file[] = {{FW_SHELL_BASH, "flexwright.bash"},
                {FW_SHELL_ZSH, "_flexwright"},
                {FW_SHELL_FISH, "flexwright.fish"}};
    for (size_t i = 0; i < sizeof file / sizeof file[0]; i++) {
        fw_text text = fw_text_new(arena);
        fw_cli_completion(file[i].shell, &text);
        FW_TRY(save(directory, file[i].name, &text));
    }
    return FW_OK;
}

int main(int argc, char **argv) {
    fw_arena *arena = fw_arena_new(0);
    if (argc != 2 || !arena) return 2;
    fw_status status = manuals(arena, argv[1]);
    if (status == FW_OK) status = completions(arena, argv[1]);
    if (status != FW_OK) fprintf(stderr, "manuals: %s could not be written\n", argv[1]);
    fw_arena_free(arena);
    return status == FW_OK ? 0 : 1;
}
