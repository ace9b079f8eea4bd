/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/json.h"
#include "base/text.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *comma, *colon;
    int indent; /* blanks per level; 0: lines are the caller's */
    bool short_escapes;
} form[] = {
    [FW_JSON_COMPACT] = {",", ":", 0, false},
    [FW_JSON_SPACED] = {", ", ": ", 0, true},
    [FW_JSON_INDENTED] = {",", ": ", 1, true},
    [FW_JSON_INDENTED_2] = {",", ": ", 2, true},
};

fw_json fw_json_new(fw_text *out, fw_json_style style) {
    return (fw_json){.out = out, .style = style};
}

void fw_json_only(fw_json *json, fw_json_wanted wanted) {
    json->only = wanted;
    json->unheard = fw_text_new(json->out->arena);
}

static bool is_among(const char *const *wanted, const char *key) {
    for (; wanted && *wanted; wanted++)
        if (strcmp(*wanted, key) == 0) return true;
    return !wanted;
}

/* is what comes next left out, or in something that is? */
static bool is_unheard_of(fw_json *json, const char *key, bool text) {
    if (!json->only.member || json->depth == 0) return false;
    if (json->left_out > 0 && json->depth > json->left_out) return true;
    const bool heard = !key              ? true
                       : json->depth > 1 ? text || is_among(json->only.inner, key)
                                         : is_among(json->only.member, key);
    json->left_out = heard ? 0 : json->depth;
    return !heard;
}

static bool is_unheard(fw_json *json, const char *key) {
    return is_unheard_of(json, key, false);
}

/* the end of something that is left out */
static bool ends_unheard(fw_json *json) {
    if (!(json->left_out > 0 && json->depth > json->left_out)) return false;
    json->depth--;
    return true;
}

fw_status fw_json_finish(fw_json *json, const char *behind) {
    fw_text_add(json->out, behind);
    FW_TRY(fw_text_end(json->out));
    return json->wrong || json->depth != 0 || !(json->filled & 1) ? FW_INTERNAL : FW_OK;
}

/* ---- strings ---- */

/* length of the UTF-8 character at s, 0: it is none */
static size_t character(const unsigned char *s) {
    unsigned code;
    return fw_text_utf8((const char *)s, &code);
}

bool fw_json_is_text(const char *text, size_t n) {
    const char *at = text;
    while (*at && character((const unsigned char *)at))
        at += character((const unsigned char *)at);
    return (size_t)(at - text) == n;
}

/* a character that may not stand in a string as it is */
static void escape(fw_text *out, char c, bool short_form) {
    static const char control[] = "\b\f\n\r\t", letter[] = "bfnrt";
    const char *at = short_form ? strchr(control, c) : NULL;
    if (c == '"' || c == '\\')
        fw_text_bytes(out, (const char[]){'\\', c}, 2);
    else if (at)
        fw_text_bytes(out, (const char[]){'\\', letter[at - control]}, 2);
    else
        fw_text_printf(out, short_form ? "\\u%04X" : "\\u%04x", (unsigned)c);
}

static void string(fw_json *json, const char *text) {
    fw_text *out = json->out;
    fw_text_bytes(out, "\"", 1);
    for (const char *s = text; *s;) {
        const char *from = s;
        size_t n = 0;
        while (*s && *s != '"' && *s != '\\' && (unsigned char)*s >= 0x20 &&
               (n = character((const unsigned char *)s)) > 0)
            s += n;
        fw_text_bytes(out, from, (size_t)(s - from));
        if (!*s) break;
        if ((unsigned char)*s >= 0x80)
            fw_text_bytes(out, "?", 1);
        else
            escape(out, *s, form[json->style].short_escapes);
        s++;
    }
    fw_text_bytes(out, "\"", 1);
}

/* ---- nesting ---- */

static void new_line(fw_json *json, int blanks) {
    static const char blank[] = "                                ";
    fw_text_bytes(json->out, "\n", 1);
    for (; blanks > 0; blanks -= (int)sizeof blank - 1)
        fw_text_bytes(json->out, blank,
                      (size_t)(blanks < (int)sizeof blank - 1 ? blanks : (int)sizeof blank - 1));
}

static uint64_t level(const fw_json *json) {
    return (uint64_t)1 << json->depth;
}

/* what is due before the next member or element, and its key */
static void next(fw_json *json, const char *key) {
    int indent = form[json->style].indent;
    bool first = !(json->filled & level(json)), object = json->objects & level(json);
    if (object != (key != NULL) || (json->depth == 0 && !first)) json->wrong = true;
    if (!json->fresh && !first) {
        const char *comma = form[json->style].comma;
        fw_text_bytes(json->out, comma, strlen(comma));
    }
    if (indent && json->depth > 0) new_line(json, indent * json->depth);
    json->filled |= level(json);
    json->fresh = false;
    if (!key) return;
    string(json, key);
    fw_text_add(json->out, form[json->style].colon);
}

static void open(fw_json *json, const char *key, bool object) {
    if (!is_unheard(json, key)) {
        next(json, key);
        fw_text_bytes(json->out, object ? "{" : "[", 1);
    }
    if (json->depth + 1 >= FW_JSON_DEPTH) {
        json->wrong = true;
        return;
    }
    json->depth++;
    json->filled &= ~level(json);
    json->objects = object ? json->objects | level(json) : json->objects & ~level(json);
}

void fw_json_object(fw_json *json, const char *key) {
    open(json, key, true);
}

void fw_json_list(fw_json *json, const char *key) {
    open(json, key, false);
}

static void close_level(fw_json *json) {
    if (json->depth == 0 || json->fresh) {
        json->wrong = true;
        return;
    }
    fw_text_bytes(json->out, json->objects & level(json) ? "}" : "]", 1);
    json->depth--;
}

void fw_json_end(fw_json *json) {
    if (ends_unheard(json)) return;
    int indent = form[json->style].indent;
    if (indent && json->filled & level(json)) new_line(json, indent * (json->depth - 1));
    close_level(json);
}

void fw_json_line(fw_json *json, int blanks) {
    if (json->filled & level(json)) fw_text_bytes(json->out, ",", 1);
    new_line(json, blanks);
    json->fresh = true;
}

void fw_json_end_line(fw_json *json, int blanks) {
    new_line(json, blanks);
    close_level(json);
}

/* ---- values ---- */

fw_text *fw_json_value(fw_json *json, const char *key) {
    json->unheard.length = 0;
    if (is_unheard(json, key)) return &json->unheard;
    next(json, key);
    return json->out;
}

void fw_json_null(fw_json *json, const char *key) {
    if (is_unheard(json, key)) return;
    next(json, key);
    fw_text_bytes(json->out, "null", 4);
}

void fw_json_truth(fw_json *json, const char *key, bool value) {
    if (is_unheard(json, key)) return;
    next(json, key);
    fw_text_add(json->out, value ? "true" : "false");
}

void fw_json_whole(fw_json *json, const char *key, long long value) {
    if (is_unheard(json, key)) return;
    next(json, key);
    fw_text_printf(json->out, "%lld", value);
}

void fw_json_text(fw_json *json, const char *key, const char *value) {
    if (is_unheard_of(json, key, true)) return;
    if (!value) {
        fw_json_null(json, key);
        return;
    }
    next(json, key);
    string(json, value);
}

void fw_json_textf(fw_json *json, const char *key, const char *format, ...) {
    char *text = NULL;
    va_list arguments;
    if (is_unheard_of(json, key, true)) return;
    va_start(arguments, format);
    int n = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (n >= 0) text = fw_arena_array(json->out->arena, char, (size_t)n + 1);
    if (!text) {
        json->out->failed = 1;
        return;
    }
    va_start(arguments, format);
    vsnprintf(text, (size_t)n + 1, format, arguments);
    va_end(arguments);
    fw_json_text(json, key, text);
}

void fw_json_number(fw_json *json, const char *key, double value, int digits) {
    if (is_unheard(json, key)) return;
    if (isfinite(value))
        fw_text_number(fw_json_value(json, key), value, digits);
    else
        fw_json_null(json, key);
}

void fw_json_fixed(fw_json *json, const char *key, double value, int decimals) {
    if (is_unheard(json, key)) return;
    if (isfinite(value))
        fw_text_fixed(fw_json_value(json, key), value, decimals);
    else
        fw_json_null(json, key);
}

/* "1.0", "0.10000000000000001", "1e-6": an exponent without plus sign and leading zeros */
void fw_json_real(fw_json *json, const char *key, double value) {
    char text[64];
    if (is_unheard(json, key)) return;
    if (!isfinite(value)) {
        fw_json_null(json, key);
        return;
    }
    fw_number_text(text, sizeof text - 2, value, 17);
    char *e = strchr(text, 'e');
    if (e) {
        char *digit = e[1] == '-' ? e + 2 : e + 1, *from = e + 2;
        while (*from == '0')
            from++;
        memmove(digit, from, strlen(from) + 1);
    } else if (!strchr(text, '.'))
        memcpy(text + strlen(text), ".0", 3);
    fw_text_add(fw_json_value(json, key), text);
}
