/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The top of every result, for the terminal, the page, the report and programs alike: the decision,
   why, what governs as it will be fabricated and as drawn, what to do, and what is not guaranteed
   with the measurement that would settle it. Private to the room. */
#ifndef FW_REPORT_SUMMARY_H
#define FW_REPORT_SUMMARY_H
#include "report/report.h"

typedef struct fw_report_summary_line {
    const char *label; /* "rejected because", "as made, at worst", "do", "nearest", ... */
    const char *text;  /* a sentence without its full stop */
} fw_report_summary_line;

typedef struct fw_report_summary {
    fw_verdict_decision decision;
    fw_verdict_check made, drawn; /* of the hinges, those that govern */
    bool has_made, has_drawn;     /* has_made: a flow was judged as it makes it */
    /* of all checks, as made where that was judged, and as drawn */
    fw_verdict_check governing, governing_drawn;
    bool governs;                 /* something was run */
    fw_report_summary_line *line; /* (nline) in the order in which they are read */
    int nline;
} fw_report_summary;

fw_status fw_report_summarise(fw_arena *arena, const fw_report_input *input,
                              fw_report_summary *summary);

#endif
