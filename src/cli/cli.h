/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program: one file per command, one row per command and per option in a table that also feeds
   --help and the reference page. */
#ifndef FW_CLI_CLI_H
#define FW_CLI_CLI_H

/* exit status of the contract */
int fw_cli_run(int argc, char **argv);

#endif
