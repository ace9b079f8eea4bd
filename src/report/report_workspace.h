/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The certified workspace for people and programs: text, JSON, pictures, the certificate. The same
   bytes every time. */
#ifndef FW_REPORT_REPORT_WORKSPACE_H
#define FW_REPORT_REPORT_WORKSPACE_H
#include "report/report.h"
#include "workspace/map.h"

typedef struct fw_report_workspace_flow { /* one flow: a material and a thickness */
    const char *flow;                     /* NULL: the device's own material */
    const fw_mechanism *mechanism;
    const fw_workspace_map *map;
    const fw_workspace_result *required;
    const fw_workspace_regularity *singular; /* (device->nworkspace) of the boxes that are proved */
} fw_report_workspace_flow;

typedef struct fw_report_workspace {
    const fw_device *device;
    const fw_report_workspace_flow *flow; /* (nflow) */
    int nflow;
} fw_report_workspace;

fw_status fw_report_workspace_text(const fw_report_workspace *in, fw_text *out);
/* schema flexwright.workspace/1 */
fw_status fw_report_workspace_json(const fw_report_workspace *in, fw_text *out);
/* schema flexwright.workspace-certificate/1: what tests/accept/check_certificate.py verifies */
fw_status fw_report_certificate_json(const fw_report_workspace *in, fw_text *out);
/* slices at constant rotation, their boundary coloured by the hinge that is at its limit */
fw_status fw_report_workspace_svg(fw_arena *arena, const fw_report_workspace *in, fw_text *out);
/* the slices and shares of one flow as the inside of an <svg> of FW_SLICES_WIDTH, from `top` down;
 *height 0: there is nothing to draw */
enum { FW_SLICES_WIDTH = 910 };
fw_status fw_report_slices(fw_arena *arena, const fw_report_workspace_flow *flow, double top,
                           double *height, fw_text *out);
#endif
