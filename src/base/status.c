/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/status.h"

const char *fw_status_text(fw_status status) {
    switch (status) {
#define FW_STATUS_CASE(code, exit_status, text)                                                    \
    case FW_##code:                                                                                \
        return text;
        FW_STATUS_TABLE(FW_STATUS_CASE)
#undef FW_STATUS_CASE
    }
    return "unknown status";
}

int fw_status_exit(fw_status status) {
    switch (status) {
#define FW_STATUS_CASE(code, exit_status, text)                                                    \
    case FW_##code:                                                                                \
        return exit_status;
        FW_STATUS_TABLE(FW_STATUS_CASE)
#undef FW_STATUS_CASE
    }
    return 70;
}
