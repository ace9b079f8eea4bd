/* SPDX-License-Identifier: GPL-3.0-or-later */
#define FW_W 2
#include "multibody/kernel_plan.h"
#include "multibody/kernel_sincos.h"
#include <math.h>

void fw_sincos_array(int n, const double *x, double *sine, double *cosine) {
    bits outside = {0};
    for (int i = 0; i < n; i += 2) {
        int j = i + 1 < n ? i + 1 : i;
        real a = {x[i], x[j]}, s, c;
        outside |= bits_of(fw_sincos_range - real_abs(a));
        real_sincos(a, &s, &c);
        sine[i] = s[0], cosine[i] = c[0];
        sine[j] = s[1], cosine[j] = c[1];
    }
    if (!bits_any(bits_negative(outside))) return;
    for (int i = 0; i < n; i++)
        if (fabs(x[i]) > fw_sincos_range) sincos(x[i], &sine[i], &cosine[i]);
}
