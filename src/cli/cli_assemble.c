/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"
#include <stdio.h>
#include <sys/stat.h>

static int save_in(fw_design *design, const char *directory, const char *name, int document) {
    char path[4200];
    if (snprintf(path, sizeof path, "%s/%s", directory, name) >= (int)sizeof path)
        return FW_STATUS_IO;
    return fw_design_save(design, document, path);
}

/* the picture is worth most where the joints do not close: it is saved in any case */
static int save_pictures(fw_design *design, const fw_cli_options *options, bool closed) {
    int status = FW_STATUS_OK;
    if (options->svg) status = fw_design_save(design, FW_DOCUMENT_ASSEMBLE_SVG, options->svg);
    if (status != FW_STATUS_OK || !options->output) return status;
    mkdir(options->output, 0777); /* what is wrong with it, saving will say */
    status = save_in(design, options->output, "assemble.svg", FW_DOCUMENT_ASSEMBLE_SVG);
    if (status != FW_STATUS_OK || !closed) return status;
    return save_in(design, options->output, "assemble.json", FW_DOCUMENT_ASSEMBLE_JSON);
}

static int run(fw_design *design, const fw_cli_options *options) {
    int status = fw_design_assemble(design);
    if (status != FW_STATUS_OK && status != FW_STATUS_SOLVER) return status;
    int saved = save_pictures(design, options, status == FW_STATUS_OK);
    if (status != FW_STATUS_OK || saved != FW_STATUS_OK)
        return status != FW_STATUS_OK ? status : saved;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_ASSEMBLE_JSON);
    if (options->quiet || fw_cli_session_file_on_stdout(options)) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_ASSEMBLE_TEXT);
}

int fw_cli_command_assemble(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    return fw_cli_session_close(design, options, run(design, options), 0);
}
