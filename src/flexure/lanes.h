/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the laws of a hinge are written in: one number of one hinge or, where FW_FOUR_HINGES is
   defined first, those of four hinges that do not know of each other. The text of a law is the same
   for both and so are its operations, one by one and in their order: of four at once each has the
   bits it has alone (test_four.c). Only what is the same for all may be asked with `if`. Private to
   the room. */
#ifndef FW_FLEXURE_LANES_H
#define FW_FLEXURE_LANES_H
#include <math.h>
#include <stdint.h>
#include <string.h>

#define FW_INLINE static inline __attribute__((always_inline))

typedef double fw_pair __attribute__((vector_size(16))); /* two of a kind of one hinge */
typedef uint64_t fw_bits __attribute__((vector_size(16)));

#ifdef FW_FOUR_HINGES

typedef double fw_flexure_real __attribute__((vector_size(32)));
typedef int64_t fw_masks __attribute__((vector_size(32)));
typedef struct fw_flexure_both { /* two of a kind, of each hinge */
    fw_flexure_real a, b;
} fw_flexure_both;
/* a: as most hinges are; b: of every one. All four are usual, or they are not worked out at once */
#define FW_IF_USUAL(usual, a, b) ((void)(usual), (a))

FW_INLINE fw_flexure_real fw_all(double x) {
    return (fw_flexure_real){x, x, x, x};
}
FW_INLINE fw_flexure_real fw_where(fw_masks where, fw_flexure_real a, fw_flexure_real b) {
    return (fw_flexure_real)(((fw_masks)a & where) | ((fw_masks)b & ~where));
}
FW_INLINE fw_flexure_real fw_larger(fw_flexure_real a, fw_flexure_real b) {
    return fw_where(a > b, a, b);
}
FW_INLINE fw_flexure_real fw_smaller(fw_flexure_real a, fw_flexure_real b) {
    return fw_where(a < b, a, b);
}
FW_INLINE fw_flexure_real fw_size(fw_flexure_real x) {
    return (fw_flexure_real)((fw_masks)x & INT64_MAX);
}
/* that, but of what x is below 0 for, the other */
FW_INLINE fw_flexure_real fw_unless_below_0(fw_flexure_real x, fw_flexure_real that,
                                            fw_flexure_real other) {
    return fw_where(x < 0, other, that);
}
FW_INLINE fw_flexure_real fw_mantissa(fw_flexure_real x) {
    return (fw_flexure_real)(((fw_masks)x & 0xfffffffffffff) | 0x3ff0000000000000);
}
/* table[k stride], k the bits of x from `shift` on, as many as `mask` leaves */
FW_INLINE fw_flexure_real fw_fetch(const double *table, int stride, fw_flexure_real x, int shift,
                                   int64_t mask) {
    fw_masks k = (((fw_masks)x >> shift) & mask) * stride;
    return (fw_flexure_real){table[k[0]], table[k[1]], table[k[2]], table[k[3]]};
}
FW_INLINE fw_flexure_both fw_both_of(fw_flexure_real a, fw_flexure_real b) {
    return (fw_flexure_both){a, b};
}
FW_INLINE fw_flexure_real fw_first(fw_flexure_both x) {
    return x.a;
}
FW_INLINE fw_flexure_real fw_second(fw_flexure_both x) {
    return x.b;
}
FW_INLINE fw_flexure_both fw_quotients(fw_flexure_real a, fw_flexure_real b, fw_flexure_real over,
                                       fw_flexure_real under) {
    return (fw_flexure_both){a / over, b / under};
}
FW_INLINE fw_flexure_both fw_both_madd(fw_flexure_both by, fw_flexure_both x, fw_flexure_both to) {
    return (fw_flexure_both){to.a + by.a * x.a, to.b + by.b * x.b};
}

/* of one of the two */
FW_INLINE fw_flexure_real fw_cubic(const double c[][2], int one, fw_flexure_real z,
                                   fw_flexure_real z2) {
    return (c[0][one] + z * c[1][one]) + z2 * (c[2][one] + z * c[3][one]);
}
FW_INLINE fw_flexure_both fw_cubics(const double c[4][2], fw_flexure_real z, fw_flexure_real z2) {
    return (fw_flexure_both){fw_cubic(c, 0, z, z2), fw_cubic(c, 1, z, z2)};
}
FW_INLINE fw_flexure_both fw_quintics(const double c[6][2], fw_flexure_real z, fw_flexure_real z2,
                                      fw_flexure_real z4) {
    return (fw_flexure_both){fw_cubic(c, 0, z, z2) + z4 * (c[4][0] + z * c[5][0]),
                             fw_cubic(c, 1, z, z2) + z4 * (c[4][1] + z * c[5][1])};
}
FW_INLINE fw_flexure_both fw_septics(const double c[8][2], fw_flexure_real z, fw_flexure_real z2,
                                     fw_flexure_real z4) {
    return (fw_flexure_both){fw_cubic(c, 0, z, z2) + z4 * fw_cubic(c + 4, 0, z, z2),
                             fw_cubic(c, 1, z, z2) + z4 * fw_cubic(c + 4, 1, z, z2)};
}

#else

typedef double fw_flexure_real;
typedef fw_pair fw_flexure_both;
#define FW_IF_USUAL(usual, a, b) ((usual) ? (a) : (b))

FW_INLINE fw_flexure_real fw_all(double x) {
    return x;
}
/* one instruction each, where fmin and fmax are calls; the second where the first is no number */
FW_INLINE fw_flexure_real fw_larger(fw_flexure_real a, fw_flexure_real b) {
    return a > b ? a : b;
}
FW_INLINE fw_flexure_real fw_smaller(fw_flexure_real a, fw_flexure_real b) {
    return a < b ? a : b;
}
FW_INLINE fw_flexure_real fw_size(fw_flexure_real x) {
    return fabs(x);
}
FW_INLINE fw_flexure_real fw_unless_below_0(fw_flexure_real x, fw_flexure_real that,
                                            fw_flexure_real other) {
    return x < 0 ? other : that;
}
FW_INLINE fw_flexure_real fw_mantissa(fw_flexure_real x) {
    fw_bits bits = ((fw_bits)(fw_pair){x, x} & 0xfffffffffffff) | 0x3ff0000000000000;
    return ((fw_pair)bits)[0];
}
FW_INLINE fw_flexure_real fw_fetch(const double *table, int stride, fw_flexure_real x, int shift,
                                   int64_t mask) {
    int64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return table[stride * ((bits >> shift) & mask)];
}
FW_INLINE fw_flexure_both fw_both_of(fw_flexure_real a, fw_flexure_real b) {
    return (fw_flexure_both){a, b};
}
FW_INLINE fw_flexure_real fw_first(fw_flexure_both x) {
    return x[0];
}
FW_INLINE fw_flexure_real fw_second(fw_flexure_both x) {
    return x[1];
}
/* {a/over, b/under}: divisions take their time, but two at once no longer */
FW_INLINE fw_flexure_both fw_quotients(fw_flexure_real a, fw_flexure_real b, fw_flexure_real over,
                                       fw_flexure_real under) {
    return (fw_flexure_both){a, b} / (fw_flexure_both){over, under};
}
FW_INLINE fw_flexure_both fw_both_madd(fw_flexure_both by, fw_flexure_both x, fw_flexure_both to) {
    return to + by * x;
}

/* two polynomials at once, powers of z given, in pairs of pairs (Estrin) */
FW_INLINE fw_flexure_both fw_cubic_of(const double c[][2], fw_flexure_both z, fw_flexure_both z2) {
    const fw_flexure_both k[4] = {
        {c[0][0], c[0][1]}, {c[1][0], c[1][1]}, {c[2][0], c[2][1]}, {c[3][0], c[3][1]}};
    return (k[0] + z * k[1]) + z2 * (k[2] + z * k[3]);
}
FW_INLINE fw_flexure_both fw_cubics(const double c[4][2], fw_flexure_real z, fw_flexure_real z2) {
    return fw_cubic_of(c, (fw_flexure_both){z, z}, (fw_flexure_both){z2, z2});
}
FW_INLINE fw_flexure_both fw_quintics(const double c[6][2], fw_flexure_real z, fw_flexure_real z2,
                                      fw_flexure_real z4) {
    return fw_cubics(c, z, z2) +
           (fw_flexure_both){z4, z4} *
               ((fw_flexure_both){c[4][0], c[4][1]} +
                (fw_flexure_both){z, z} * (fw_flexure_both){c[5][0], c[5][1]});
}
FW_INLINE fw_flexure_both fw_septics(const double c[8][2], fw_flexure_real z, fw_flexure_real z2,
                                     fw_flexure_real z4) {
    return fw_cubics(c, z, z2) + (fw_flexure_both){z4, z4} * fw_cubics(c + 4, z, z2);
}

#endif
#endif
