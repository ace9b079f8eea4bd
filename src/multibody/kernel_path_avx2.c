/* SPDX-License-Identifier: GPL-3.0-or-later */
#define FW_W         4
#define FW_BRIEF     1
#define FW_SIDES     2
#define FW_PATH      fw_path_avx2
#define FW_PATH_NAME "avx2"
#include "multibody/kernel_path.h"
