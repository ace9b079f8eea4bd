/* SPDX-License-Identifier: GPL-3.0-or-later */
#define FW_W         1
#define FW_CORE      fw_core_single
#define FW_CORE_NAME "baseline"
#include "multibody/kernel_core.h"
