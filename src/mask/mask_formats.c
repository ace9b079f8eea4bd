/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The formats in which a mask is written: formats.def. */
#include "mask/mask.h"
#include "mask/mask_writers.h"
#include <string.h>

#define FW_MASK_FORMAT(name_, ending_, ...)                                                        \
    {.name = #name_, .ending = ending_, .write = fw_mask_write_##name_, __VA_ARGS__},
static const fw_mask_format format_row[] = {
#include "mask/formats.def"
};
#undef FW_MASK_FORMAT
enum { NFORMAT = sizeof format_row / sizeof format_row[0] };
_Static_assert(NFORMAT <= 32, "sets of formats are bits of an unsigned");

const fw_mask_format *fw_mask_format_at(size_t i) {
    return i < NFORMAT ? &format_row[i] : NULL;
}

static bool wanted(unsigned *set, const char *word, size_t n) {
    bool all = n == 3 && memcmp(word, "all", 3) == 0, found = false;
    for (unsigned i = 0; i < NFORMAT; i++)
        if (all || (strlen(format_row[i].name) == n && memcmp(format_row[i].name, word, n) == 0)) {
            *set |= 1u << i;
            found = true;
        }
    return found;
}

bool fw_mask_formats(const char *list, unsigned *set) {
    *set = 0;
    for (unsigned i = 0; i < NFORMAT; i++)
        if (format_row[i].always || (!list && format_row[i].usual)) *set |= 1u << i;
    for (const char *s = list; s; s = strchr(s, ',') ? strchr(s, ',') + 1 : NULL)
        if (!wanted(set, s, strcspn(s, ","))) return false;
    return true;
}
