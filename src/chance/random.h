/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of which all that is estimated is made: random ones and Sobol's. */
#ifndef FW_CHANCE_RANDOM_H
#define FW_CHANCE_RANDOM_H
#include "base/arena.h"
#include "base/status.h"
#include <stddef.h>
#include <stdint.h>

/* ---- random numbers ---- */

/* Random numbers without a state: each is a function of seed, sample number and dimension alone, so that samples may be
   computed in any order, in any share of the work, and again. */

void fw_chance_philox(const uint32_t key[2], const uint32_t counter[4], uint32_t out[4]);

/* a seed for a part of the work that shall not repeat numbers of another part */
uint64_t fw_chance_seed(uint64_t seed, uint64_t part);

/* of a counter of four indices, in (0, 1) */
double fw_chance_uniform_at(uint64_t seed, const uint32_t counter[4]);
double fw_chance_uniform(uint64_t seed, uint64_t sample, uint64_t dimension); /* in (0, 1) */
double fw_chance_normal(uint64_t seed, uint64_t sample, uint64_t dimension);  /* mean 0, sd 1 */

/* ---- Sobol' points ---- */

/* Sobol' points with nested uniform scrambling: the first 2^m points fill the cube more evenly than random ones do, each
   by itself uniform. Random access by sample number. */

enum {
    FW_CHANCE_SOBOL_MOST = 337, /* dimensions: all primitive polynomials up to degree 11, and 1 */
    FW_CHANCE_SOBOL_BITS = 32   /* sample < 2^32 */
};

typedef struct fw_chance_sobol {
    size_t dimensions;
    uint64_t *key;       /* (dimensions) of the scrambling */
    uint32_t *direction; /* (dimensions x 32), the leading digit in bit 31 */
} fw_chance_sobol;

/* FW_LIMIT beyond FW_CHANCE_SOBOL_MOST dimensions */
fw_status fw_chance_sobol_new(fw_arena *arena, size_t dimensions, uint64_t seed,
                              fw_chance_sobol *out);

/* the digits of a point before scrambling, as a fraction of 2^32 */
uint32_t fw_chance_sobol_digits(const fw_chance_sobol *sobol, uint64_t sample, size_t dimension);
/* in (0, 1), scrambled */
double fw_chance_sobol_uniform(const fw_chance_sobol *sobol, uint64_t sample, size_t dimension);
/* u (dimensions): standard normal numbers of that point */
void fw_chance_sobol_normal(const fw_chance_sobol *sobol, uint64_t sample, double *u);

#endif
