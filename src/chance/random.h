/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random numbers without a state: each is a function of seed, sample number and dimension alone, so that samples may be
   computed in any order, in any share of the work, and again. */
#ifndef FW_CHANCE_RANDOM_H
#define FW_CHANCE_RANDOM_H
#include <stdint.h>

void fw_chance_philox(const uint32_t key[2], const uint32_t counter[4], uint32_t out[4]);

/* a seed for a part of the work that shall not repeat numbers of another part */
uint64_t fw_chance_seed(uint64_t seed, uint64_t part);

/* of a counter of four indices, in (0, 1) */
double fw_chance_uniform_at(uint64_t seed, const uint32_t counter[4]);
double fw_chance_uniform(uint64_t seed, uint64_t sample, uint64_t dimension); /* in (0, 1) */
double fw_chance_normal(uint64_t seed, uint64_t sample, uint64_t dimension);  /* mean 0, sd 1 */

#endif
