/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The methods that can be asked for by name. */
#include "multibody/method.h"
#include <string.h>

static const fw_multibody_method *const methods[] = {
    &fw_multibody_method_chain,
    &fw_multibody_method_minimal,
    &fw_multibody_method_augmented,
    &fw_multibody_method_coordinate_partitioning,
    &fw_multibody_method_udwadia_kalaba,
    &fw_multibody_method_svd,
    &fw_multibody_method_qr,
    &fw_multibody_method_schur,
    &fw_multibody_method_block_least_squares,
};
enum { METHODS = sizeof methods / sizeof methods[0] };

const fw_multibody_method *fw_multibody_method_find(const char *name) {
    if (!name) return methods[0];
    for (size_t i = 0; i < METHODS; i++)
        if (strcmp(methods[i]->name, name) == 0) return methods[i];
    return NULL;
}

fw_multibody_method_row fw_multibody_method_at(size_t i) {
    return i < METHODS ? (fw_multibody_method_row){methods[i]->name, methods[i]->summary}
                       : (fw_multibody_method_row){NULL, NULL};
}
