/* SPDX-License-Identifier: GPL-3.0-or-later */
#define FW_W         8
#define FW_BRIEF     1
#define FW_SIDES     2
#define FW_PATH      fw_path_avx512
#define FW_PATH_NAME "avx512"
#include "multibody/kernel_path.h"
