/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linked into programs that clang builds with -fsanitize-coverage=inline-8bit-counters,pc-table (option FW_EDGES): at the end
   of a program, the file FW_EDGES_TO/NAME-PID.edges has one byte for each edge of its control flow, not 0 where it was passed,
   and NAME.places has where each is: the address in the program's file and 1 at the start of a function, both 8 bytes.
   tests/edges/edges.py reads them. Without FW_EDGES_TO nothing is written. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* what the compiler calls at the start of every unit, with the same section each time */
void __sanitizer_cov_8bit_counters_init(const uint8_t *begin, const uint8_t *end);
void __sanitizer_cov_pcs_init(const uintptr_t *begin, const uintptr_t *end);

/* the linker's: where the program's file, or the shared library that this is linked into, begins in memory */
extern const char __ehdr_start __attribute__((visibility("hidden")));
extern char *program_invocation_short_name;

static const uint8_t *edge, *edge_end;
static const uintptr_t *place, *place_end; /* two of each: address, flags */

void __sanitizer_cov_8bit_counters_init(const uint8_t *begin, const uint8_t *end) {
    edge = begin, edge_end = end;
}

void __sanitizer_cov_pcs_init(const uintptr_t *begin, const uintptr_t *end) {
    place = begin, place_end = end;
}

static FILE *opened(const char *directory, const char *format, const char *name) {
    char path[4096];
    int most = snprintf(path, sizeof path, format, directory, name, (int)getpid());
    return most < (int)sizeof path ? fopen(path, "wb") : NULL;
}

__attribute__((destructor)) static void edges_write(void) {
    const char *directory = getenv("FW_EDGES_TO");
    if (!directory || edge == edge_end) return;
    FILE *to = opened(directory, "%s/%s-%d.edges", program_invocation_short_name);
    if (to) fwrite(edge, 1, (size_t)(edge_end - edge), to), fclose(to);
    to = opened(directory, "%s/%s.places", program_invocation_short_name);
    if (!to) return;
    for (const uintptr_t *p = place; p < place_end; p += 2) {
        const uint64_t row[2] = {p[0] - (uintptr_t)&__ehdr_start, p[1] & 1};
        fwrite(row, sizeof row, 1, to);
    }
    fclose(to);
}
