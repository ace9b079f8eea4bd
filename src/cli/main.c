/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/options.h"

int main(int argc, char **argv) {
    return fw_cli_run(argc, argv);
}
