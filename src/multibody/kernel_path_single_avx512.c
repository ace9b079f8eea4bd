/* SPDX-License-Identifier: GPL-3.0-or-later */
#define FW_W         2
#define FW_SIDES     1
#define FW_PATH      fw_path_single_avx512
#define FW_PATH_NAME "avx512"
#include "multibody/kernel_path.h"
