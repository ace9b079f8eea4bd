/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/cancel.h"
#include <stdatomic.h>

/* lock-free, hence fit for signal handlers, and for other threads too */
static atomic_int requested;
_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "a signal handler may not wait for a lock");

void fw_cancel_request(int signal_number) {
    requested = signal_number;
}
int fw_cancel_requested(void) {
    return requested;
}
void fw_cancel_clear(void) {
    requested = 0;
}
