/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The result of `assemble`: document, terminal text, picture of before and after. */
#ifndef FW_REPORT_REPORT_ASSEMBLY_H
#define FW_REPORT_REPORT_ASSEMBLY_H
#include "base/text.h"
#include "assembly/assembly.h"
#include "assembly/kinematics.h"

typedef struct fw_report_assembly {
    const fw_device *device;
    const fw_layout *layout;       /* NULL or not drawn: bodies as lines between their joints */
    const fw_mechanism *mechanism; /* stands in the guess */
    const fw_device_scene *scene;  /* its loads; NULL: none */
    const fw_assembly *assembly;
    const fw_assembly_kinematics *kinematics; /* NULL: not computed */
    bool motion;                              /* rates were given, or drivers move it */
    bool closed;
} fw_report_assembly;

/* schema flexwright.assemble/1 */
fw_status fw_report_assemble_json(const fw_report_assembly *input, fw_text *out);
fw_status fw_report_assemble_text(const fw_report_assembly *input, fw_text *out);
/* guess and assembled position side by side, open joints in red with their size */
fw_status fw_report_assemble_svg(fw_arena *arena, const fw_report_assembly *input, fw_text *out);

#endif
