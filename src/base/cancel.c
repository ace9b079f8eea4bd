/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/cancel.h"
#include <stddef.h>

/* lock-free, hence fit for signal handlers, and for other threads too. No other memory hangs on the
   number, so that no order is asked for. */
_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "a signal handler may not wait for a lock");

void fw_cancel_request(fw_cancel *cancel, int number) {
    atomic_store_explicit(&cancel->number, number, memory_order_relaxed);
}

void fw_cancel_clear(fw_cancel *cancel) {
    atomic_store_explicit(&cancel->number, 0, memory_order_relaxed);
}

int fw_cancel_requested(const fw_cancel *cancel) {
    int number = 0;
    for (; cancel && number == 0; cancel = cancel->above)
        number = atomic_load_explicit(&cancel->number, memory_order_relaxed);
    return number;
}
