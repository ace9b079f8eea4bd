/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The writers of all formats, one for each line of formats.def. Private to mask/. */
#ifndef FW_MASK_FORMAT_H
#define FW_MASK_FORMAT_H
#include "mask/mask.h"

#define FW_MASK_FORMAT(name, ...) fw_status fw_mask_write_##name(const fw_mask *mask, fw_text *out);
#include "mask/formats.def"
#undef FW_MASK_FORMAT

#endif
