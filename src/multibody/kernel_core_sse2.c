/* SPDX-License-Identifier: GPL-3.0-or-later */
#define FW_W         2
#define FW_BRIEF     1
#define FW_CORE      fw_core_sse2
#define FW_CORE_NAME "sse2"
#include "multibody/kernel_core.h"
