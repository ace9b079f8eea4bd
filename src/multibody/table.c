/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The methods that can be asked for by name. */
#include "multibody/methods.h"
#include <string.h>

static const fw_method *const methods[] = {
    &fw_method_chain,
    &fw_method_minimal,
    &fw_method_augmented,
    &fw_method_coordinate_partitioning,
    &fw_method_udwadia_kalaba,
    &fw_method_svd,
    &fw_method_qr,
    &fw_method_schur,
    &fw_method_block_least_squares,
};
enum { METHODS = sizeof methods / sizeof methods[0] };

const fw_method *fw_method_find(const char *name) {
    if (!name) return methods[0];
    for (size_t i = 0; i < METHODS; i++)
        if (strcmp(methods[i]->name, name) == 0) return methods[i];
    return NULL;
}

fw_method_row fw_method_at(size_t i) {
    return i < METHODS ? (fw_method_row){methods[i]->name, methods[i]->summary}
                       : (fw_method_row){NULL, NULL};
}
