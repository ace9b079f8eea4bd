/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All that an arena holds, byte by byte, so that it can be as it was at the same addresses: for work that begins over
   and over from the same state, whatever it changes of it. Pointers into the arena stay good; what is not in it (files,
   memory of libraries) is the caller's affair. */
#ifndef FW_BASE_ARENA_COPY_H
#define FW_BASE_ARENA_COPY_H
#include "base/arena.h"

typedef struct fw_arena_copy {
    fw_mark mark;
    unsigned char *bytes; /* of malloc; NULL: none */
} fw_arena_copy;

/* false: no memory. What is rewound from then on stays with the arena for the next time */
bool fw_arena_copy_take(fw_arena *arena, fw_arena_copy *copy);
/* The arena must not have been rewound behind the copy meanwhile. Cost: that of copying the bytes */
void fw_arena_copy_put_back(fw_arena *arena, const fw_arena_copy *copy);
void fw_arena_copy_free(fw_arena_copy *copy);

#endif
