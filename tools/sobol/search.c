/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds src/chance/sobol_numbers.def: cc -O2 search.c -o search && ./search (20 s). Which polynomials are primitive is
   found by running through the powers of x. Initial numbers are tried at random, because there are too many to try all:
   the choice is kept whose 2^m points, m = 5, 7 .. 15, have the least sum of 2^(2t - m) over the pairs with all dimensions
   before, t the quality parameter of the pair as a net (S. Joe, F. Y. Kuo, SIAM J. Sci. Comput. 30 (2008) 2635, from whom
   the aim is). */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { DIMENSIONS = 337, BITS = 32, TRIES = 96, SIZES = 6, MOST = 16 };
static const int size[SIZES] = {5, 7, 9, 11, 13, 15};
static uint32_t kept[DIMENSIONS][SIZES][MOST];
static uint64_t state = 20260101;

static uint64_t next(void) {
    uint64_t z = (state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static int degree_of(uint32_t p) {
    return 31 - __builtin_clz(p);
}

static int primitive(uint32_t p) {
    int s = degree_of(p);
    uint32_t order = 1, x = 2;
    if (s == 1) return p == 3;
    for (; x != 1 && order < 1u << s; order++) {
        x <<= 1;
        if (x >> s & 1) x ^= p;
    }
    return x == 1 && order == (1u << s) - 1;
}

static void directions(uint32_t p, const uint32_t *m, uint32_t *v) {
    int s = degree_of(p);
    for (int k = 0; k < BITS; k++) {
        v[k] = k < s ? m[k] << (31 - k) : v[k - s] ^ (v[k - s] >> s);
        for (int j = 1; k >= s && j < s; j++)
            if (p >> (s - j) & 1) v[k] ^= v[k - j];
    }
}

/* the first m rows of the generator matrix, one row a word */
static void rows(const uint32_t *v, int m, uint32_t *row) {
    for (int i = 0; i < m; i++) {
        row[i] = 0;
        for (int k = 0; k < m; k++)
            row[i] |= (v[k] >> (31 - i) & 1u) << k;
    }
}

static int independent(uint32_t *basis, uint32_t x) {
    while (x) {
        int top = degree_of(x);
        if (!basis[top]) {
            basis[top] = x;
            return 1;
        }
        x ^= basis[top];
    }
    return 0;
}

/* m less the largest d for which any i rows of a and d - i of b are independent */
static int quality(const uint32_t *a, const uint32_t *b, int m) {
    uint32_t first[MOST] = {0};
    int least = m;
    for (int i = 0; i <= m; i++) {
        if (i && !independent(first, a[i - 1])) return m - (least < i - 1 ? least : i - 1);
        uint32_t basis[MOST];
        memcpy(basis, first, sizeof basis);
        int j = 0;
        while (i + j < least && j < m && independent(basis, b[j]))
            j++;
        if (i + j < least) least = i + j;
    }
    return m - least;
}

/* the best initial numbers for polynomial p as dimension d, whose rows are kept */
static void search(uint32_t p, int d) {
    uint32_t best[MOST] = {0}, m[MOST], v[BITS], now[SIZES][MOST];
    double lowest = 1e300;
    int degree = degree_of(p);
    for (int t = 0; t < (degree <= 2 ? 4 : degree == 3 ? 64 : TRIES); t++) {
        for (int k = 0; k < degree; k++)
            m[k] = k ? (uint32_t)(next() >> (64 - k)) << 1 | 1u : 1;
        directions(p, m, v);
        for (int s = 0; s < SIZES; s++)
            rows(v, size[s], now[s]);
        double sum = 0;
        for (int i = 0; i < d && sum < lowest; i++)
            for (int s = 0; s < SIZES; s++)
                sum += (double)(1u << 2 * quality(kept[i][s], now[s], size[s])) / (1u << size[s]);
        if (sum >= lowest) continue;
        lowest = sum;
        memcpy(best, m, sizeof m);
        memcpy(kept[d], now, sizeof now);
    }
    printf("{%u, {", p);
    for (int k = 0; k < degree; k++)
        printf("%s%u", k ? ", " : "", best[k]);
    printf("}},\n");
}

int main(void) {
    uint32_t v[BITS];
    for (int k = 0; k < BITS; k++)
        v[k] = 1u << (31 - k);
    for (int s = 0; s < SIZES; s++)
        rows(v, size[s], kept[0][s]);
    int d = 1;
    for (uint32_t p = 3; d < DIMENSIONS; p += 2)
        if (primitive(p)) search(p, d++);
    return 0;
}
