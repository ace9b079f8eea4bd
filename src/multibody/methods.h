/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of the method table, one file each. Private to multibody/. */
#ifndef FW_MULTIBODY_METHODS_H
#define FW_MULTIBODY_METHODS_H
#include "multibody/model.h"

extern const fw_method fw_method_chain, fw_method_augmented, fw_method_coordinate_partitioning,
    fw_method_udwadia_kalaba, fw_method_svd, fw_method_qr, fw_method_schur,
    fw_method_block_least_squares, fw_method_minimal;

#endif
