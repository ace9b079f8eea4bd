/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One design. The _avx and _avx512 files are the same operations in shorter encodings: no
   contraction there either, so that all give the same bits. Test: test_kernel.c. */
#define FW_W         2
#define FW_SIDES     1
#define FW_PATH      fw_path_baseline
#define FW_PATH_NAME "baseline"
#include "multibody/kernel_path.h"
