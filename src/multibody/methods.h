/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of the method table, one file each. Private to multibody/. */
#ifndef FW_MULTIBODY_METHODS_H
#define FW_MULTIBODY_METHODS_H
#include "multibody/model.h"

extern const fw_multibody_method fw_multibody_method_chain, fw_multibody_method_augmented,
    fw_multibody_method_coordinate_partitioning, fw_multibody_method_udwadia_kalaba,
    fw_multibody_method_svd, fw_multibody_method_qr, fw_multibody_method_schur,
    fw_multibody_method_block_least_squares, fw_multibody_method_minimal;

#endif
