/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text from templates, and numbers as people read them: for HTML and SVG.

   A directive of a template is a letter or digit in braces:

     {s}        const char *   escaped; NULL: nothing
     {r}        const char *   as it is, for markup of our own
     {i}        int
     {l}        long
     {c}        double         coordinate of a picture, at most 2 decimals
     {1} ... {9} double        coordinate with at most 1, 2, 3, 4, 6 or 9 decimals
     {n}        double         4 significant digits
     {e}        double         2 significant digits
     {u}        double, const char *   value with SI prefix and unit, 4 digits
     {d}        double         rad, shown in degrees with their sign, 4 digits
     {D}        double         the same for columns: no sign, zeros at the end are kept
     {p}        double         ratio, shown in per cent
     {h}        double         seconds, shown as a duration

   A number that is not finite becomes a dash; a coordinate that is not, 0. */
#ifndef FW_BASE_MARKUP_H
#define FW_BASE_MARKUP_H
#include "base/text.h"
#include <stdarg.h>

void fw_markup(fw_text *out, const char *format, ...);
/* the first n bytes of a template; `quote` is written wherever it has an apostrophe */
void fw_markup_part(fw_text *out, const char *format, size_t n, char quote, va_list *arguments);

void fw_markup_number(fw_text *out, double value, int digits);

#endif
