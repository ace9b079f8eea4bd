/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the commands share. Private to the room. */
#ifndef FW_CLI_SESSION_H
#define FW_CLI_SESSION_H
#include "base/output.h"
#include "cli/options.h"
#include "plan/plan.h"

#define COMMAND(name_, argument_, summary_, example_, text_, options_)                             \
    int fw_cli_command_##name_(fw_cli_options *options);
#include "cli/commands.def"
#undef COMMAND

/* a design that was read, or NULL with *exit_status set and everything said */
fw_design *fw_cli_session_open(fw_cli_options *options, int *exit_status);
/* prints the diagnostics on standard error and frees; returns the exit status */
int fw_cli_session_close(fw_design *design, const fw_cli_options *options, int status,
                         int result_if_ok);
/* says so where there is no design to say it of; returns the exit status */
int fw_cli_session_no_memory(void);
/* a line on standard error with -v */
void fw_cli_session_stage(const fw_cli_options *options, const char *stage);
/* a directory of results that would be refused is refused before the work; NULL: none is written */
int fw_cli_session_target(fw_design *design, const char *directory);
/* a document (FW_DOCUMENT_...) on standard output; returns the library's status */
int fw_cli_session_print(fw_design *design, const fw_cli_options *options, int document);

typedef struct fw_cli_session_file {
    int document; /* FW_DOCUMENT_... */
    const char *name;
} fw_cli_session_file;
/* documents as files of a directory, which is made where it is not there and may hold others: all of
   them or none; returns the library's status */
int fw_cli_session_save(fw_design *design, const char *directory, const fw_cli_session_file *file,
                        size_t count);
/* the same of bytes */
int fw_cli_session_put(fw_plan *plan, const char *directory, const fw_output_member *file,
                       size_t count);
/* --csv - : the table has standard output for itself */
bool fw_cli_session_file_on_stdout(const fw_cli_options *options);

/* ---- cli_laboratory.c: what is kept beside a log shows that no line of it was removed (FW-D280, FW-D283) ---- */

struct fw_recipe_asrun;
fw_status fw_cli_check_head(fw_arena *arena, fw_diags *diags, const char *file, bool begun,
                            const struct fw_recipe_asrun *run);

/* ---- cli_hinge.c: input decks of the continuum level for a person's own solver ---- */

/* Into DIRECTORY, made when it is not there, for every flow of the plan (the plan is loaded):
   hinge-ID[-FLOW].inp       unit loads on each flexure
   hinge-ID[-FLOW]-large.inp a quarter, half, three quarters and all of its limit angle
   mechanism-SCENE[-FLOW].inp the whole mechanism under each scene's loads at its end; where it
                             cannot be written a warning (FW-D213) says why
   each file whole or not at all. refinement 0: the default. *files counts them. */
fw_status fw_cli_decks(fw_plan *plan, const char *directory, double refinement, int *files);

#endif
