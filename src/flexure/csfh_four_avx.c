/* SPDX-License-Identifier: GPL-3.0-or-later */
/* csfh_four.c once more, compiled for AVX (CMakeLists.txt), whose registers hold four numbers: the
   same operations, hence the same bits. Only called where the processor has it. */
#ifdef __AVX__
#define fw_flexure_csfh_four fw_flexure_csfh_four_avx
#include "flexure/csfh_four.c"
#else
typedef int fw_flexure_no_avx; /* another kind of processor */
#endif
