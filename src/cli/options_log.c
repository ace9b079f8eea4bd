/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the options of log take. */
#include "cli/options_log.h"
#include "recipe/asrun.h"
#include <string.h>

const char *fw_cli_take_run(fw_cli_options *o, const char *v) {
    o->run = v;
    return *v ? NULL : "needs the name of a file";
}

const char *fw_cli_take_entry(fw_cli_options *o, const char *v) {
    o->entry = v;
    return *v ? NULL : "needs the words of an entry, see flexwright log --help";
}

const char *fw_cli_take_entries(fw_cli_options *o, const char *v) {
    o->entries = v;
    return *v ? NULL : "needs the name of a file";
}

const char *fw_cli_take_lot(fw_cli_options *o, const char *v) {
    o->lot = v;
    for (const char *c = v; *c; c++)
        if ((unsigned char)*c < 0x20) return "has characters that cannot stand in a line";
    return *v && strlen(v) <= 100 ? NULL : "needs 1 to 100 characters";
}

const char *fw_cli_take_wafer_ids(fw_cli_options *o, const char *v) {
    fw_arena *arena = fw_arena_new(0);
    const char *wrong = "could not be looked at: out of memory";
    o->wafer_ids = v;
    if (arena) (void)fw_recipe_asrun_wafers(arena, v, &wrong);
    fw_arena_free(arena);
    return wrong;
}

const char *fw_cli_take_wafer(fw_cli_options *o, const char *v) {
    o->wafer = v;
    return *v ? NULL : "needs the id of a wafer";
}

const char *fw_cli_take_instrument(fw_cli_options *o, const char *v) {
    o->instrument = v;
    return *v ? NULL : "needs the name of an instrument";
}

const char *fw_cli_take_report(fw_cli_options *o, const char *v) {
    o->report = v;
    return *v ? NULL : "needs the name of a file";
}

static const char *logged(fw_cli_options *o, const char *before, const char *v) {
    if (!*v || strchr(v, ';')) return "needs words without a semicolon";
    if (o->nlogged == FW_MOST_SETS) return "is given more than 64 times";
    o->logged[o->nlogged].before = before;
    o->logged[o->nlogged++].words = v;
    return NULL;
}

const char *fw_cli_take_site(fw_cli_options *o, const char *v) {
    return strchr(v, '=') ? logged(o, "", v)
                          : "needs MEASURE=VALUES, like \"thickness=9.1 9.0 9.2 9.1 9.1 um\"";
}

const char *fw_cli_take_setting(fw_cli_options *o, const char *v) {
    return strchr(v, '=') ? logged(o, "set ", v) : "needs NAME=VALUE, like \"power=251 W\"";
}

const char *fw_cli_take_coupon(fw_cli_options *o, const char *v) {
    return logged(o, "coupon=", v);
}
