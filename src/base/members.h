/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compact JSON into a text, member by member. The comma that is due is written here: one is due
   unless the text ends in an opening bracket, a colon, a comma or a line break. So elements and
   members are given one after the other, with key NULL for an element of a list:

     fw_put_open(out, NULL, '{');  fw_put_text(out, "id", "A");  fw_put_open(out, "list", '[');
     fw_put_number(out, NULL, 1, 6);  fw_text_add(out, "]}");      {"id":"A","list":[1]}

   Errors stick in the text. Test: test_members.c */
#ifndef FW_BASE_MEMBERS_H
#define FW_BASE_MEMBERS_H
#include "base/text.h"
#include <stdbool.h>

/* the comma that is due, and a line break: what follows stands on a line of its own */
void fw_put_line(fw_text *out);
/* the comma that is due and "key": (key NULL: only the comma); a value has to follow */
void fw_put_key(fw_text *out, const char *key);
void fw_put_open(fw_text *out, const char *key, char bracket); /* '{' or '[' */
/* NULL: null. Bytes that are no UTF-8 (RFC 3629: cut by a message's limit) become '?' */
void fw_put_text(fw_text *out, const char *key, const char *value);
/* so many significant digits, shortest form; null where it is not finite, no minus zero */
void fw_put_number(fw_text *out, const char *key, double value, int digits);
/* so many decimals, without trailing zeros; null where it is not finite */
void fw_put_fixed(fw_text *out, const char *key, double value, int decimals);
void fw_put_whole(fw_text *out, const char *key, long value);
void fw_put_truth(fw_text *out, const char *key, bool value);
void fw_put_null(fw_text *out, const char *key);
#endif
