/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The head of an as-run log: how many entries it has, and the chain of the last one. A chain alone shows nothing of lines
   that were taken off at the end; a head beside the log does, unless both were changed. It is written after the line, so
   that a log that was interrupted between the two has one entry more than its head says, and is whole.
     flexwright-log-head TAB entries=12 TAB chain=...
   Test: test_asrun.c, heads. */
#include "base/text.h"
#include "recipe/asrun.h"
#include <stdio.h>
#include <string.h>

static const char first_word[] = "flexwright-log-head\tentries=";

fw_status fw_recipe_asrun_head(fw_arena *arena, int nentry, const char *chain, const char **line) {
    FW_NEED(*line = fw_arena_printf(arena, "%s%d\tchain=%s\n", first_word, nentry, chain));
    return FW_OK;
}

static fw_status torn(fw_diags *diags, fw_place place, const char *what) {
    return fw_diag_error(diags, 280, place, "the head of the log %s", what);
}

fw_status fw_recipe_asrun_check_head(const fw_recipe_asrun *run, const char *file, const char *text,
                                     size_t n, fw_diags *diags) {
    fw_place place = {file, 1, 1};
    int entries = -1, end = 0;
    char chain[65];
    if (n <= sizeof first_word || strncmp(text, first_word, sizeof first_word - 1) != 0 ||
        sscanf(text + sizeof first_word - 1, "%9d\tchain=%64[0-9a-f]\n%n", &entries, chain, &end) !=
            2 ||
        sizeof first_word - 1 + (size_t)end != n || entries < 0 || strlen(chain) != 64)
        return torn(diags, place,
                    "is damaged; restore it, or keep both as they are and begin a new log");
    if (entries > run->nentry)
        return fw_diag_error(
            diags, 280, place,
            "the log has %d entries, but its head says %d: lines were removed at its "
            "end",
            run->nentry, entries);
    const char *there = entries > 0 ? run->entry[entries - 1].chain : run->begun;
    if (strcmp(there, chain) != 0)
        return torn(diags, place,
                    "is of other entries: lines were changed, or it is of another log");
    return FW_OK;
}
