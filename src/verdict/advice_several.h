/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smallest change of several values at once that is accepted. Private to the room. */
#ifndef FW_VERDICT_ADVICE_SEVERAL_H
#define FW_VERDICT_ADVICE_SEVERAL_H
#include "verdict/advice_variables.h"

typedef struct fw_verdict_several {
    bool accepted; /* the device at x was read, drawn, run and accepted */
    bool ended;    /* the search was ended before it was done */
    double *x;     /* (count) in the units of the variables */
    double size;   /* sum of the sizes of all changes */
    int looks;
} fw_verdict_several;

/* smaller_than: the size of a change that is known; what is not clearly smaller is not looked for.
   most_work: trial->work may come to */
fw_status fw_verdict_change_several(fw_verdict_trial *trial, const fw_verdict_variable *variable,
                                    int count, double smaller_than, double most_work,
                                    fw_verdict_several *out);

#endif
