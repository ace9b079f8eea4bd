/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "schedule/schedule_words.h"
#include <math.h>

void fw_schedule_put_duration(fw_text *out, double seconds) {
    if (seconds < 99.5) {
        fw_text_number(out, seconds, seconds < 9.95 ? 2 : 3);
        fw_text_add(out, " s");
        return;
    }
    long total = lround(fmin(seconds, 1e9));
    if (total < 7200) {
        fw_text_printf(out, "%ld min", total / 60);
        if (total % 60) fw_text_printf(out, " %ld s", total % 60);
        return;
    }
    total = (total + 30) / 60;
    fw_text_printf(out, "%ld h", total / 60);
    if (total % 60) fw_text_printf(out, " %ld min", total % 60);
}
