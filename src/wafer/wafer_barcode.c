/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Code 39: a text as bars and gaps, two widths of them. A sign is five bars with four gaps between
   them. Which of the five bars are wide is one of ten patterns; which gap is wide tells four groups of
   ten signs apart; four signs more have narrow bars and three wide gaps. A narrow gap stands between
   signs, and the sign * before and behind the text. A reader takes it in either direction, so a mirror
   image, too.
   In: a text of A to Z, 0 to 9, space and - . $ / + %. Out: elements from the first bar on, bar and gap
   in turn. Source: ISO/IEC 16388 (Code 39). Test: test_wafer_build.c, by a table of all signs. */
#include "wafer/wafer_parts.h"
#include <string.h>

enum { BARS = 5, PATTERNS = 10 };
static const char bars[PATTERNS][BARS + 1] = {"10001", "01001", "11000", "00101", "10100",
                                              "01100", "00011", "10010", "01010", "00110"};
static const struct {
    const char *signs; /* in the order of the patterns of bars */
    const char *gaps;
} group[] = {
    {"1234567890", "0100"}, {"ABCDEFGHIJ", "0010"}, {"KLMNOPQRST", "0001"}, {"UVWXYZ-. *", "1000"}};
static const char odd[] = "$/+%"; /* which gap of theirs is narrow: the last one first */

static bool wide(char sign, int element) {
    const char *at = strchr(odd, sign);
    if (at) return element % 2 && element / 2 != 3 - (int)(at - odd);
    for (size_t k = 0; k < sizeof group / sizeof group[0]; k++) {
        const char *found = strchr(group[k].signs, sign);
        if (!found) continue;
        return (element % 2 ? group[k].gaps[element / 2]
                            : bars[found - group[k].signs][element / 2]) == '1';
    }
    return false; /* the reader of files lets no other sign pass */
}

fw_status fw_wafer_barcode(fw_arena *arena, const char *text, bool **element, int *n) {
    int length = (int)strlen(text) + 2;
    *n = 0;
    FW_NEED(*element = fw_arena_array(arena, bool, (size_t)length * 10));
    for (int i = 0; i < length; i++) {
        char sign = '*';
        if (i > 0 && i < length - 1) sign = text[i - 1];
        for (int k = 0; k < 9; k++)
            (*element)[(*n)++] = wide(sign, k);
        if (i + 1 < length) (*element)[(*n)++] = false;
    }
    return FW_OK;
}
