/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/limit_kinds.h"

/* what the device file states of its own material */
bool fw_limit_stated(const fw_limit_input *in, fw_limits *all, fw_limit *limit) {
    (void)all;
    if (!in->material->strength_stated) return false;
    fw_limit_plain(&in->material->strength,
                   "strength as the device file states it, which rules alone", limit);
    return true;
}
