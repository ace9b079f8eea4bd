/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/random.h"
#include "maths/cdf.h"

/* Philox4x32-10: ten rounds, each with two products of 32 bits whose halves change places. Inputs: key and counter; output
   128 bits that pass the statistical tests of TestU01 for every counter. Cost: some 10 ns. Source: J. K. Salmon,
   M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel Random Numbers: As Easy as 1, 2, 3, SC 2011. Test: test_random.c (the
   known answers of that paper's authors). */
void fw_chance_philox(const uint32_t key[2], const uint32_t counter[4], uint32_t out[4]) {
    enum { ROUNDS = 10 };
    uint32_t k0 = key[0], k1 = key[1];
    uint32_t x0 = counter[0], x1 = counter[1], x2 = counter[2], x3 = counter[3];
    for (int round = 0; round < ROUNDS; round++) {
        uint64_t a = (uint64_t)0xD2511F53u * x0, b = (uint64_t)0xCD9E8D57u * x2;
        x0 = (uint32_t)(b >> 32) ^ x1 ^ k0;
        x2 = (uint32_t)(a >> 32) ^ x3 ^ k1;
        x1 = (uint32_t)b;
        x3 = (uint32_t)a;
        k0 += 0x9E3779B9u, k1 += 0xBB67AE85u; /* Weyl sequences */
    }
    out[0] = x0, out[1] = x1, out[2] = x2, out[3] = x3;
}

static uint64_t bits(uint64_t seed, const uint32_t counter[4]) {
    const uint32_t key[2] = {(uint32_t)seed, (uint32_t)(seed >> 32)};
    uint32_t out[4];
    fw_chance_philox(key, counter, out);
    return (uint64_t)out[1] << 32 | out[0];
}

/* Seeds of parts differ by the bits of one Philox block, so that numbers of two parts agree only by chance. No sample has
   the dimension that stands in the counter here. */
uint64_t fw_chance_seed(uint64_t seed, uint64_t part) {
    return bits(
        seed, (const uint32_t[4]){(uint32_t)part, (uint32_t)(part >> 32), UINT32_MAX, UINT32_MAX});
}

/* (k + 1/2) 2^-52 with 52 random bits k: never 0 or 1, least 1.1e-16. Test: test_random.c */
double fw_chance_uniform_at(uint64_t seed, const uint32_t counter[4]) {
    return ((double)(bits(seed, counter) >> 12) + 0.5) * 0x1p-52;
}

double fw_chance_uniform(uint64_t seed, uint64_t sample, uint64_t dimension) {
    return fw_chance_uniform_at(
        seed, (const uint32_t[4]){(uint32_t)sample, (uint32_t)(sample >> 32), (uint32_t)dimension,
                                  (uint32_t)(dimension >> 32)});
}

/* The inverse cdf of the uniform number: |u| <= 8.21, relative error 1e-15. Test: test_random.c */
double fw_chance_normal(uint64_t seed, uint64_t sample, uint64_t dimension) {
    return fw_maths_normal_quantile(fw_chance_uniform(seed, sample, dimension));
}
