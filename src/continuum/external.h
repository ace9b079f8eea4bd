/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running an external program: in a directory of its own that nobody else can read, without a
   shell, with a limit of time, and gone when this process is. Private to the room
   but for study/, which counts its own instructions so. docs/decisions/0012-continuum.md */
#ifndef FW_CONTINUUM_EXTERNAL_H
#define FW_CONTINUUM_EXTERNAL_H
#include "continuum/continuum.h"

typedef struct fw_continuum_external_room { /* a private temporary directory */
    char path[512];
    const fw_arena *work; /* a request to stop it ends the program that runs here */
} fw_continuum_external_room;

typedef enum fw_continuum_external_end {
    FW_EXTERNAL_DONE,    /* exit status 0 */
    FW_EXTERNAL_FAILED,  /* another one, or a signal */
    FW_EXTERNAL_TIMEOUT, /* killed by us */
    FW_EXTERNAL_CANCELLED
} fw_continuum_external_end;

typedef struct fw_continuum_external_run {
    fw_continuum_external_end end;
    int code;     /* exit status, or minus the signal */
    double cpu_s; /* user and system */
} fw_continuum_external_run;

/* below $TMPDIR or /tmp; FW_IO */
fw_status fw_continuum_external_room_open(const fw_arena *work, fw_continuum_external_room *room);
void fw_continuum_external_room_close(
    fw_continuum_external_room *room); /* removes it and all that is in it */
fw_status fw_continuum_external_write(const fw_continuum_external_room *room, const char *name,
                                      const char *data, size_t n);
/* argv[0] is an absolute path; output and error go to `log` in the room, input is empty; one
   thread. FW_IO: it could not be started */
fw_status fw_continuum_external_call(const fw_continuum_external_room *room,
                                     const char *const *argv, const char *log, double timeout_s,
                                     fw_continuum_external_run *run);
/* the same where we are and with our own environment: for this program itself, whose arguments name
   files as we see them */
fw_status fw_continuum_external_call_here(const fw_continuum_external_room *room,
                                          const char *const *argv, const char *log,
                                          double timeout_s, fw_continuum_external_run *run);

#endif
