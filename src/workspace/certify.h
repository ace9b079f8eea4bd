/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A required box of poses, proved. Private to the room and its tests. */
#ifndef FW_WORKSPACE_CERTIFY_H
#define FW_WORKSPACE_CERTIFY_H
#include "workspace/loop.h"

typedef enum fw_workspace_proof_end { FW_PROVED, FW_REFUTED, FW_UNDECIDED } fw_workspace_proof_end;

/* FW_REFUTED: the mechanism cannot be assembled at `pose`. Ends of ranges are within `relative` of
   the truth. FW_UNDECIDED: more than `most` boxes, or boxes that cannot be halved any more. */
fw_status fw_workspace_certify_box(fw_arena *arena, const fw_workspace_loop *loop,
                                   const fw_workspace_box3 *box, double relative, long most,
                                   fw_workspace_proof *proof, double pose[3],
                                   fw_workspace_proof_end *end);

#endif
