/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a design holds. Private to design.c, design_documents.c and study/design_tradeoff.c. */
#ifndef FW_PLAN_DESIGN_STATE_H
#define FW_PLAN_DESIGN_STATE_H
#include "plan/design.h"
#include <locale.h>

enum { READ = 1, JUDGED = 2, FABRICATED = 4, SIMULATED = 8, MODES = 16, STATICS = 32 }; /* done */
enum { TRADEOFF = 1 << 16 };
enum { ASSEMBLED = 64, ASSEMBLY_TRIED = 128, WORKSPACE = 256 };
enum { NDOCUMENT = FW_DOCUMENT_TRADEOFF_SVG + 1 };
enum { NTRADEOFF = FW_DOCUMENT_TRADEOFF_SVG - FW_DOCUMENT_TRADEOFF_JSON + 1 };
struct fw_study_tradeoff;

struct fw_design {
    fw_plan *plan;    /* its arena holds this struct too */
    fw_cancel cancel; /* of this design; its arenas carry it */
    locale_t locale;
    unsigned done;
    bool tried; /* a description was given, read or not */
    fw_device_set *set;
    int set_capacity;
    const char *wrong_option; /* a sentence, or NULL */
    const fw_dynamics_motion *motion;
    const fw_statics_modes *modes;
    const fw_statics *statics;
    const fw_mechanism *mechanism; /* of `scene`, the same for all three */
    const fw_device_scene *scene;
    fw_plan_assembly assembly;
    fw_report_workspace workspace;
    const struct fw_study_tradeoff *tradeoff;
    /* of a later room, which sets them with the result */
    fw_status (*tradeoff_document[NTRADEOFF])(const struct fw_study_tradeoff *t, fw_text *out);
    fw_report_terminal_style style;
    double read_s, judge_s, simulate_s; /* CPU time of these stages */
    fw_text document[NDOCUMENT];        /* data NULL: not composed, or out of date */
    fw_diagnostic *diagnostic;          /* (FW_DIAG_MOST) */
};

typedef struct fw_plan_bytes {
    const char *name;
    const void *data; /* NULL: the file `name` */
    size_t n;
} fw_plan_bytes;

/* says what was called wrongly: FW_USAGE */
fw_status fw_plan_design_usage(fw_design *d, const char *what);
/* work in the "C" locale of this thread, so that the caller's cannot change a byte */
int fw_plan_design_run(fw_design *d, fw_status (*work)(fw_design *d, void *argument),
                       void *argument);
void fw_plan_design_forget_documents(fw_design *d);

#endif
