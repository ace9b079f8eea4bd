/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/members.h"
#include <math.h>
#include <string.h>

/* ---- commas and keys ---- */

static void next(fw_text *out) {
    if (out->length > 0 && !strchr("{[:,\n", out->data[out->length - 1]))
        fw_text_bytes(out, ",", 1);
}

void fw_put_line(fw_text *out) {
    next(out);
    fw_text_bytes(out, "\n", 1);
}

void fw_put_key(fw_text *out, const char *key) {
    next(out);
    if (!key) return;
    fw_text_bytes(out, "\"", 1);
    fw_text_add(out, key);
    fw_text_bytes(out, "\":", 2);
}

void fw_put_open(fw_text *out, const char *key, char bracket) {
    fw_put_key(out, key);
    fw_text_bytes(out, &bracket, 1);
}

/* ---- values ---- */

/* length of the UTF-8 character at s, 0: it is none (RFC 3629) */
static size_t character(const unsigned char *s) {
    if (s[0] < 0x80) return 1;
    size_t n = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
    unsigned least = n == 2 ? 0x80 : n == 3 ? 0x800 : 0x10000;
    unsigned code = s[0] & (0x7fU >> n);
    if (s[0] < 0xc2 || s[0] > 0xf4) return 0;
    for (size_t i = 1; i < n; i++) {
        if ((s[i] & 0xc0) != 0x80) return 0;
        code = code << 6 | (s[i] & 0x3fU);
    }
    return code >= least && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff) ? n : 0;
}

static void repaired(fw_text *out, const char *text) {
    char *whole = fw_arena_strdup(out->arena, text);
    if (!whole) {
        out->failed = 1;
        return;
    }
    for (char *at = whole; *at;) {
        size_t step = character((const unsigned char *)at);
        if (!step) *at = '?';
        at += step ? step : 1;
    }
    fw_text_json(out, whole);
}

void fw_put_text(fw_text *out, const char *key, const char *value) {
    fw_put_key(out, key);
    if (!value) {
        fw_text_add(out, "null");
        return;
    }
    const char *at = value;
    while (*at && character((const unsigned char *)at))
        at += character((const unsigned char *)at);
    if (*at)
        repaired(out, value);
    else
        fw_text_json(out, value);
}

void fw_put_number(fw_text *out, const char *key, double value, int digits) {
    fw_put_key(out, key);
    if (value == 0.0) value = 0.0; /* no minus zero */
    if (isfinite(value))
        fw_text_number(out, value, digits);
    else
        fw_text_add(out, "null");
}

void fw_put_fixed(fw_text *out, const char *key, double value, int decimals) {
    fw_put_key(out, key);
    if (isfinite(value))
        fw_text_fixed(out, value, decimals);
    else
        fw_text_add(out, "null");
}

void fw_put_whole(fw_text *out, const char *key, long value) {
    fw_put_key(out, key);
    fw_text_printf(out, "%ld", value);
}

void fw_put_truth(fw_text *out, const char *key, bool value) {
    fw_put_key(out, key);
    fw_text_add(out, value ? "true" : "false");
}

void fw_put_null(fw_text *out, const char *key) {
    fw_put_key(out, key);
    fw_text_add(out, "null");
}
