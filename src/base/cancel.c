/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/cancel.h"
#include <signal.h>

static volatile sig_atomic_t requested;

void fw_cancel_request(int signal_number) {
    requested = signal_number;
}
int fw_cancel_requested(void) {
    return requested;
}
void fw_cancel_clear(void) {
    requested = 0;
}
