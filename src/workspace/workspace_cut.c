/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/workspace_cut.h"

/* Volume of {x in [0,1]^3 : m1 x1 + m2 x2 + m3 x3 <= a}, m1 <= m2 <= m3, 0 <= a <= (m1+m2+m3)/2:
   inclusion and exclusion of the corners that the plane has passed,
     6 m1 m2 m3 V = a^3 - (a-m1)+^3 - (a-m2)+^3 - (a-m3)+^3,
   with a^3 - (a-m1)^3 = m1 (3 a^2 - 3 a m1 + m1^2) taken apart, so that nothing cancels and small
   m1 do no harm; beyond m1 + m2 <= m3 the cut is a slanted slab, V = (a - (m1+m2)/2)/m3. in: any
   unit; out: 0..1/2. Error below 2e-15: every bracket is a sum of terms of one sign or a difference
   that leaves more than half of the larger. Cost about 20 flops. Source: the convolution of three
   uniform densities; for fluids Scardovelli and Zaleski, J. Comput. Phys. 164 (2000) 228. Test:
   test_cut.c. */
static double corner(double m1, double m2, double m3, double a) {
    if (a < m1) return a * a * a / (6.0 * m1 * m2 * m3);
    double plain = (a * (a - m1) + m1 * m1 / 3.0) / (2.0 * m2 * m3);
    if (a < m2) return plain;
    if (m1 + m2 <= m3 && a >= m1 + m2) return (a - 0.5 * (m1 + m2)) / m3;
    double over = a - m2;
    if (over > 0.0) plain -= over / m1 * over / m2 * over / (6.0 * m3);
    over = a - m3;
    if (over > 0.0) plain -= over / m1 * over / m2 * over / (6.0 * m3);
    return plain;
}

fw_maths_interval fw_workspace_cut_share(const double p[3], double t) {
    double a = p[0], b = p[1], c = p[2], swap;
    if (a > b) swap = a, a = b, b = swap;
    if (b > c) swap = b, b = c, c = swap;
    if (a > b) swap = a, a = b, b = swap;
    double sum = a + b + c;
    if (t >= fw_up(sum * 0x1.0000000000004p+0)) return (fw_maths_interval){1.0, 1.0};
    if (t <= -fw_up(sum * 0x1.0000000000004p+0)) return (fw_maths_interval){0.0, 0.0};
    if (!(c > 0.0) || !(t > -(double)INFINITY)) return (fw_maths_interval){0.0, 1.0};
    double from = 0.5 * (t + sum), share;
    if (from > 0.5 * sum)
        share = 1.0 - corner(a, b, c, from < sum ? sum - from : 0.0);
    else
        share = corner(a, b, c, from > 0.0 ? from : 0.0);
    /* the distance errs by 4 units of the sum, which is at most 3 c; the share grows at most by the
       distance over c */
    const double slack = 1e-13;
    return (fw_maths_interval){share > slack ? share - slack : 0.0,
                               share < 1.0 - slack ? share + slack : 1.0};
}
