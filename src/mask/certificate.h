/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of the certificate. Private to the room. */
#ifndef FW_MASK_CERTIFICATE_H
#define FW_MASK_CERTIFICATE_H
#include "mask/mask.h"

/* ", ..": further members of a layer's object */
void fw_certificate_layer(fw_text *out, const fw_mask_measure *measure);
/* how arcs were flattened, files with their hashes, checks, every shape, every neck; each with a
   comma behind it */
void fw_certificate_shapes(const fw_mask *mask, const fw_output_file *file, int nfile,
                           fw_text *out);

#endif
