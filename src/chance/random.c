/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of which all that is estimated is made: random ones and Sobol's. */
#include "chance/random.h"
#include "maths/functions.h"

/* ---- random numbers without a state ---- */

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

/* ---- Sobol' points, scrambled ---- */

enum { DEGREE = 11, BITS = FW_CHANCE_SOBOL_BITS };

static const struct number {
    uint16_t polynomial, m[DEGREE];
} number[FW_CHANCE_SOBOL_MOST - 1] = {
#include "chance/sobol_numbers.def"
};

/* v_k = m_k 2^(32-k) for k <= s, and from there v_k = a_1 v_(k-1) + ... + a_s v_(k-s) + 2^-s v_(k-s), sums bit by bit, a
   the coefficients of the polynomial. Dimension 1 is van der Corput's. Source: P. Bratley, B. L. Fox, ACM Trans. Math.
   Software 14 (1988) 88. Test: test_sobol.c */
static void directions(size_t dimension, uint32_t v[BITS]) {
    if (dimension == 0) {
        for (int k = 0; k < BITS; k++)
            v[k] = 1u << (BITS - 1 - k);
        return;
    }
    const struct number *n = &number[dimension - 1];
    int degree = 0;
    while (n->polynomial >> (degree + 1))
        degree++;
    for (int k = 0; k < BITS; k++) {
        if (k < degree) {
            v[k] = (uint32_t)n->m[k] << (BITS - 1 - k);
            continue;
        }
        v[k] = v[k - degree] ^ v[k - degree] >> degree;
        for (int j = 1; j < degree; j++)
            if (n->polynomial >> (degree - j) & 1) v[k] ^= v[k - j];
    }
}

fw_status fw_chance_sobol_new(fw_arena *arena, size_t dimensions, uint64_t seed,
                              fw_chance_sobol *out) {
    if (dimensions > FW_CHANCE_SOBOL_MOST) return FW_LIMIT;
    *out = (fw_chance_sobol){.dimensions = dimensions};
    FW_NEED(out->key = fw_arena_array(arena, uint64_t, dimensions));
    FW_NEED(out->direction = fw_arena_array(arena, uint32_t, dimensions * BITS));
    for (size_t d = 0; d < dimensions; d++) {
        out->key[d] = fw_chance_seed(seed, d);
        directions(d, out->direction + d * BITS);
    }
    return FW_OK;
}

uint32_t fw_chance_sobol_digits(const fw_chance_sobol *sobol, uint64_t sample, size_t dimension) {
    const uint32_t *v = sobol->direction + dimension * BITS;
    uint32_t x = 0;
    for (uint64_t rest = sample; rest; rest &= rest - 1)
        x ^= v[__builtin_ctzll(rest) % BITS];
    return x;
}

/* the finaliser of splitmix64: a bijection of 64 bits in which each bit of the input changes each of the output with
   probability 1/2. Source: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014. */
static uint64_t mixed(uint64_t z) {
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

/* Nested uniform scrambling: digit k of the point is flipped by a random bit that is a function of the digits above it
   alone, so that points which share k digits still do, and each point is uniform. What follows the 32 digits is random.
   Input sample < 2^32 and dimension < dimensions; output in (0, 1), 52 bits. Error of a mean over the first 2^m points:
   variance O(n^-3 log^(d-1) n) for smooth integrands, and never more than a constant times that of random points. Cost:
   some 100 ns. Source: A. B. Owen, Monte Carlo and Quasi-Monte Carlo Methods, 1995, 299 (scrambling); B. Burley,
   J. Computer Graphics Techniques 9 (2020) 4 (by a hash). Test: test_sobol.c */
double fw_chance_sobol_uniform(const fw_chance_sobol *sobol, uint64_t sample, size_t dimension) {
    uint32_t x = fw_chance_sobol_digits(sobol, sample, dimension), flip = 0;
    uint64_t key = sobol->key[dimension];
    for (int k = 0; k < BITS; k++) {
        uint64_t above = k ? x >> (BITS - k) : 0; /* with a leading 1 that tells lengths apart */
        flip |= (uint32_t)(mixed(key + (above | (uint64_t)1 << k)) >> 63) << (BITS - 1 - k);
    }
    uint64_t rest = mixed(key + ((uint64_t)x | (uint64_t)1 << BITS)) >> 44; /* 20 digits more */
    return ((double)((uint64_t)(x ^ flip) << 20 | rest) + 0.5) * 0x1p-52;
}

void fw_chance_sobol_normal(const fw_chance_sobol *sobol, uint64_t sample, double *u) {
    for (size_t d = 0; d < sobol->dimensions; d++)
        u[d] = fw_maths_normal_quantile(fw_chance_sobol_uniform(sobol, sample, d));
}
