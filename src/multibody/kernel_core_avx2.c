/* SPDX-License-Identifier: GPL-3.0-or-later */
#define FW_W         4
#define FW_BRIEF     1
#define FW_CORE      fw_core_avx2
#define FW_CORE_NAME "avx2"
#include "multibody/kernel_core.h"
