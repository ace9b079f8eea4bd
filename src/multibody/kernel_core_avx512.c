/* SPDX-License-Identifier: GPL-3.0-or-later */
#define FW_W         8
#define FW_BRIEF     1
#define FW_CORE      fw_core_avx512
#define FW_CORE_NAME "avx512"
#include "multibody/kernel_core.h"
