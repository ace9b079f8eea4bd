/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flag that a signal handler sets and long loops look at. */
#ifndef FW_BASE_CANCEL_H
#define FW_BASE_CANCEL_H

void fw_cancel_request(int signal_number); /* async-signal-safe */
int fw_cancel_requested(void);             /* the signal number, or 0 */
void fw_cancel_clear(void);

#endif
