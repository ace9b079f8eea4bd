/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"
#include <locale.h>
#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t fw_text_utf8(const char *string, unsigned *code) {
    const unsigned char *s = (const unsigned char *)string;
    *code = s[0];
    if (s[0] < 0x80) return 1;
    size_t n = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
    unsigned least = n == 2 ? 0x80 : n == 3 ? 0x800 : 0x10000;
    *code = s[0] & (0x7fU >> n);
    if (s[0] < 0xc2 || s[0] > 0xf4) return 0;
    for (size_t i = 1; i < n; i++) {
        if ((s[i] & 0xc0) != 0x80) return 0;
        *code = *code << 6 | (s[i] & 0x3fU);
    }
    return *code >= least && *code <= 0x10ffff && (*code < 0xd800 || *code > 0xdfff) ? n : 0;
}

unsigned fw_text_character(const char **at) {
    unsigned code;
    size_t n = fw_text_utf8(*at, &code);
    *at += n > 0 ? n : 1;
    return n > 0 ? code : 0xfffd;
}

bool fw_text_is_order(unsigned code) {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x200e || code == 0x200f ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

bool fw_text_is_line(const char *string) {
    unsigned code;
    for (size_t n; *string; string += n)
        if ((n = fw_text_utf8(string, &code)) == 0 || fw_text_is_order(code)) return false;
    return true;
}

static const char NO_CHARACTER[] = "\xef\xbf\xbd"; /* U+FFFD */

/* the character at s as it may be shown; bytes of it that are there: at most n */
static size_t shown(fw_text *out, const char *s, size_t n) {
    unsigned code;
    /* a sequence that is cut off ends with the string: none of its bytes is read beyond n */
    char whole[5] = {0};
    memcpy(whole, s, n < 4 ? n : 4);
    const size_t length = fw_text_utf8(whole, &code);
    if (length == 1 && code < 0x20)
        fw_text_bytes(out, " ", 1);
    else if (length == 0 || fw_text_is_order(code))
        fw_text_add(out, NO_CHARACTER);
    else
        fw_text_bytes(out, s, length);
    return length ? length : 1;
}

const char *fw_text_shown(fw_arena *arena, const char *string, size_t n) {
    size_t plain = 0;
    while (plain < n && string[plain] >= ' ' && string[plain] <= '~')
        plain++;
    if (plain == n) return fw_arena_strndup(arena, string, n);
    fw_text out = fw_text_new(arena);
    fw_text_reserve(&out, n);
    for (size_t at = 0; at < n;)
        at += shown(&out, string + at, n - at);
    return fw_text_end(&out) == FW_OK ? out.data : NULL;
}

fw_text fw_text_new(fw_arena *arena) {
    return (fw_text){.arena = arena};
}

static int reserve(fw_text *text, size_t more) {
    if (text->failed) return 0;
    if (more > SIZE_MAX / 4 - text->length) {
        text->failed = 1;
        return 0;
    }
    size_t need = text->length + more + 1;
    if (need <= text->capacity) return 1;
    size_t capacity = text->capacity ? 2 * text->capacity : 256;
    if (capacity < need) capacity = need; /* a size that is known before */
    char *data = fw_arena_raw(text->arena, capacity);
    if (!data) {
        text->failed = 1;
        return 0;
    }
    if (text->length) memcpy(data, text->data, text->length);
    data[text->length] = '\0';
    text->data = data;
    text->capacity = capacity;
    return 1;
}

void fw_text_reserve(fw_text *text, size_t more) {
    reserve(text, more);
}

unsigned char *fw_text_room(fw_text *text, size_t n) {
    if (!reserve(text, n)) return NULL;
    unsigned char *at = (unsigned char *)text->data + text->length;
    text->length += n;
    text->data[text->length] = '\0';
    return at;
}

void fw_text_bytes(fw_text *text, const void *data, size_t n) {
    unsigned char *at = fw_text_room(text, n);
    if (at && n) memcpy(at, data, n);
}

void fw_text_add(fw_text *text, const char *string) {
    fw_text_bytes(text, string, strlen(string));
}

void fw_text_printf(fw_text *text, const char *format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int n = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (n < 0)
        text->failed = 1;
    else if (reserve(text, (size_t)n)) {
        vsnprintf(text->data + text->length, (size_t)n + 1, format, again);
        text->length += (size_t)n;
    }
    va_end(again);
}

/* printf and strtod follow LC_NUMERIC; the program never calls setlocale, but a caller of the
   library may have: replace whatever decimal point came out. */
static void force_point(char *buffer) {
    const char *point = localeconv()->decimal_point;
    if (point[0] == '.' && point[1] == '\0') return;
    char *found = strstr(buffer, point);
    if (!found) return;
    *found = '.';
    memmove(found + 1, found + strlen(point), strlen(found + strlen(point)) + 1);
}

char *fw_number_text(char *buffer, size_t n, double value, int digits) {
    if (value == 0.0) value = 0.0; /* no minus zero */
    snprintf(buffer, n, "%.*g", digits, value);
    force_point(buffer);
    return buffer;
}

char *fw_prefixed_text(char *buffer, size_t n, double value, const char *unit, int digits) {
    static const char *const prefix[] = {"f", "p", "n", "u", "m", "", "k", "M", "G"};
    char number[32];
    int k = 5, least = strcmp(unit, "F") == 0 ? 0 : 2; /* nobody counts in picometres */
    double size = fabs(value) * (1 + 1e-12);
    while (isfinite(size) && size > 0 && size < 1 && k > least)
        size *= 1e3, value *= 1e3, k--;
    while (isfinite(size) && size >= 1e3 && k < 8)
        size *= 1e-3, value *= 1e-3, k++;
    fw_number_text(number, sizeof number, value, digits);
    snprintf(buffer, n, "%s %s%s", number, prefix[k], unit);
    return buffer;
}

char *fw_percent_text(char *buffer, size_t n, double part) {
    double value = 100 * part, size = fabs(value);
    if (!(size >= 999.5 && size < 999500)) return fw_number_text(buffer, n, value, 3);
    double unit = size < 9995 ? 10 : size < 99950 ? 100 : 1000;
    return fw_number_text(buffer, n, round(value / unit) * unit, 7);
}

void fw_text_number(fw_text *text, double value, int digits) {
    char buffer[64];
    fw_text_add(text, fw_number_text(buffer, sizeof buffer, value, digits));
}

static char *fixed_by_library(char *buffer, double value, int decimals) {
    snprintf(buffer, FW_FIXED_BYTES, "%.*f", decimals, value);
    force_point(buffer);
    char *end = buffer + strlen(buffer);
    if (strchr(buffer, '.')) {
        while (end[-1] == '0')
            end--;
        if (end[-1] == '.') end--;
        *end = '\0';
    }
    if (strcmp(buffer, "-0") != 0) return end;
    buffer[0] = '0';
    buffer[1] = '\0';
    return buffer + 1;
}

static const char pair[] = "0001020304050607080910111213141516171819"
                           "2021222324252627282930313233343536373839"
                           "4041424344454647484950515253545556575859"
                           "6061626364656667686970717273747576777879"
                           "8081828384858687888990919293949596979899";

/* `places` digits of n that end before `end` */
static void digits(char *end, uint64_t n, int places) {
    for (; places >= 2; places -= 2, n /= 100)
        memcpy(end -= 2, pair + 2 * (n % 100), 2);
    if (places) end[-1] = (char)('0' + n % 10);
}

static int places_of(uint64_t n) {
    int places = 1;
    for (; n >= 1000; n /= 1000)
        places += 3;
    return places + (n >= 10) + (n >= 100);
}

/* three digits of each number below 1000, and one byte to spare */
#define TENS(h, t) h t "0" h t "1" h t "2" h t "3" h t "4" h t "5" h t "6" h t "7" h t "8" h t "9"
#define HUNDREDS(h)                                                                                \
    TENS(h, "0")                                                                                   \
    TENS(h, "1")                                                                                   \
    TENS(h, "2")                                                                                   \
    TENS(h, "3") TENS(h, "4") TENS(h, "5") TENS(h, "6") TENS(h, "7") TENS(h, "8") TENS(h, "9")
static const char triple[] = HUNDREDS("0") HUNDREDS("1") HUNDREDS("2") HUNDREDS("3") HUNDREDS("4")
    HUNDREDS("5") HUNDREDS("6") HUNDREDS("7") HUNDREDS("8") HUNDREDS("9");

/* three digits, and a byte that the next ones write over */
static inline void put_three(char *at, uint32_t n) {
    memcpy(at, triple + 3 * n, 4);
}

/* without zeros at the front; the end */
static inline char *put_leading(char *at, uint32_t n) {
    unsigned skip = (unsigned)(n < 100) + (n < 10);
    memcpy(at, triple + 3 * n + skip, 4);
    return at + 3 - skip;
}

/* n millionths, without zeros at the ends: millions of coordinates are written so, most of them
   whole thousandths. n < 10^15; up to 4 bytes behind the end are written over, no NUL is. */
static inline char *millionths(char *at, uint64_t n) {
    uint64_t thousandths = n / 1000, whole = thousandths / 1000;
    uint32_t low = (uint32_t)(n - 1000 * thousandths);
    uint32_t high = (uint32_t)(thousandths - 1000 * whole);
    if (whole < 1000)
        at = put_leading(at, (uint32_t)whole);
    else {
        uint32_t thousands = (uint32_t)(whole / 1000), rest = (uint32_t)whole - 1000 * thousands;
        if (thousands < 1000)
            at = put_leading(at, thousands);
        else {
            uint32_t millions = thousands / 1000;
            at = put_leading(at, millions);
            put_three(at, thousands - 1000 * millions);
            at += 3;
        }
        put_three(at, rest);
        at += 3;
    }
    if (high | low) {
        const char *end = triple + 3 * (low ? low : high);
        unsigned last = end[2] == '0', both = last & (end[1] == '0');
        *at = '.';
        put_three(at + 1, high);
        if (low) {
            put_three(at + 4, low);
            at += 3;
        }
        at += 4 - last - both;
    }
    return at;
}

/* value 10^d as an integer, rounded as printf does, a hundred times faster. In: any value and
   number of decimals d. Below 2^40 the product's own error is less than 2^-13, so the nearest
   integer is known unless the product lies within 2^-12 of halfway: that, and all that is larger,
   goes to the library. So the digits are those of printf always. Test: test_growing_text.c. */
char *fw_fixed_text(char *buffer, double value, int decimals) {
    static const double ten[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
    double product = decimals >= 0 && decimals <= 12 ? fabs(value) * ten[decimals] : HUGE_VAL;
    if (!(product < 1099511627776.0)) return fixed_by_library(buffer, value, decimals);
    uint64_t n = (uint64_t)(int64_t)product;
    double rest = product - (double)(int64_t)n;
    if (fabs(rest - 0.5) < 0x1p-12) return fixed_by_library(buffer, value, decimals);
    n += rest > 0.5;
    char *at = buffer;
    if (value < 0 && n > 0) *at++ = '-';
    uint64_t one = (uint64_t)ten[decimals], whole = n / one;
    int places = places_of(whole);
    digits(at += places, whole, places);
    if (n != whole * one) {
        *at = '.';
        digits(at += 1 + decimals, n - whole * one, decimals);
        while (at[-1] == '0')
            at--;
    }
    *at = '\0';
    return at;
}

/* the nearest whole number of millionths, as above; false: the library decides */
static inline int in_millionths(double value, int64_t *n) {
    double product = fabs(value) * 1e6;
    if (!(product < 1099511627776.0)) return 0;
    *n = (int64_t)product;
    double rest = product - (double)*n;
    *n += rest > 0.5; /* below 2^40 + 1 */
    return fabs(rest - 0.5) >= 0x1p-12;
}

char *fw_millionths_text(char *buffer, double value) {
    int64_t n;
    if (!in_millionths(value, &n)) return fw_fixed_text(buffer, value, 6);
    *buffer = '-';
    char *end = millionths(buffer + (value < 0 && n > 0), (uint64_t)n);
    *end = '\0';
    return end;
}

char *fw_place_text(char *buffer, double x, double y) {
    int64_t nx, ny;
    int both = in_millionths(x, &nx) & in_millionths(y, &ny);
    if (!both) {
        char *end = fw_millionths_text(buffer, x);
        *end++ = ' ';
        return fw_millionths_text(end, y);
    }
    *buffer = '-';
    char *end = millionths(buffer + (x < 0 && nx > 0), (uint64_t)nx);
    *end = ' ';
    *++end = '-';
    return millionths(end + (y < 0 && ny > 0), (uint64_t)ny);
}

void fw_text_fixed(fw_text *text, double value, int decimals) {
    char buffer[FW_FIXED_BYTES];
    char *end =
        decimals == 6 ? fw_millionths_text(buffer, value) : fw_fixed_text(buffer, value, decimals);
    fw_text_bytes(text, buffer, (size_t)(end - buffer));
}

void fw_text_real(fw_text *text, const char *conversion, double value) {
    char buffer[400];
    int n = snprintf(buffer, sizeof buffer, conversion, value);
    int zero = isfinite(value) && n > 0 && (size_t)n < sizeof buffer;
    if (zero && signbit(value) && !strpbrk(buffer, "123456789")) /* shown as zero: no sign */
        n = snprintf(buffer, sizeof buffer, conversion, 0.0);
    if (n < 0 || (size_t)n >= sizeof buffer) {
        text->failed = 1;
        return;
    }
    force_point(buffer);
    fw_text_add(text, buffer);
}

void fw_text_escaped(fw_text *text, const char *string) {
    for (const unsigned char *s = (const unsigned char *)string; *s; s++) {
        if (*s >= 0x7f) { /* a whole character at once */
            const size_t n = strnlen((const char *)s, 4);
            s += shown(text, (const char *)s, n) - 1;
            continue;
        }
        switch (*s) {
        case '&':
            fw_text_add(text, "&amp;");
            break;
        case '<':
            fw_text_add(text, "&lt;");
            break;
        case '>':
            fw_text_add(text, "&gt;");
            break;
        case '"':
            fw_text_add(text, "&quot;");
            break;
        case '\'':
            fw_text_add(text, "&#39;");
            break;
        default: {
            char c = *s < 0x20 && *s != '\n' && *s != '\t' ? ' ' : (char)*s;
            fw_text_bytes(text, &c, 1);
        }
        }
    }
}

void fw_text_csv(fw_text *text, const char *string) {
    /* the wide forms of = + - @ count in spreadsheets, too */
    static const char *const wide[] = {"\xef\xbc\x9d", "\xef\xbc\x8b", "\xef\xbc\x8d",
                                       "\xef\xbc\xa0"};
    const char *first = string + strspn(string, " \t\r\n");
    bool formula = *string == '\t' || *string == '\r' || (*first && strchr("=+-@", *first));
    for (size_t i = 0; i < sizeof wide / sizeof wide[0]; i++)
        formula = formula || strncmp(first, wide[i], 3) == 0;
    bool quoted = formula || strpbrk(string, ",\"\r\n");
    if (quoted) fw_text_add(text, formula ? "\"'" : "\"");
    for (const char *at = string; *at;) {
        if (*at == '"') fw_text_bytes(text, "\"", 1);
        at += shown(text, at, strnlen(at, 4));
    }
    if (quoted) fw_text_bytes(text, "\"", 1);
}

fw_status fw_text_end(const fw_text *text) {
    return text->failed ? FW_NOMEM : FW_OK;
}

/* [+-] digits [. digits] [e [+-] digits], nothing before or after */
static int number_shape(const char *s, size_t n) {
    size_t i = 0, digits = 0;
    if (i < n && (s[i] == '+' || s[i] == '-')) i++;
    for (; i < n && s[i] >= '0' && s[i] <= '9'; i++)
        digits++;
    if (i < n && s[i] == '.')
        for (i++; i < n && s[i] >= '0' && s[i] <= '9'; i++)
            digits++;
    if (digits == 0) return 0;
    if (i < n && (s[i] == 'e' || s[i] == 'E')) {
        i++;
        if (i < n && (s[i] == '+' || s[i] == '-')) i++;
        size_t first = i;
        while (i < n && s[i] >= '0' && s[i] <= '9')
            i++;
        if (i == first) return 0;
    }
    return i == n;
}

int fw_number_parse(const char *string, size_t n, double *value) {
    char buffer[512];
    const char *point = localeconv()->decimal_point;
    if (n == 0 || n + strlen(point) >= sizeof buffer || !number_shape(string, n)) return 0;
    size_t length = 0;
    for (size_t i = 0; i < n; i++) {
        if (string[i] == '.') {
            memcpy(buffer + length, point, strlen(point));
            length += strlen(point);
        } else
            buffer[length++] = string[i];
    }
    buffer[length] = '\0';
    *value = strtod(buffer, NULL);
    return isfinite(*value);
}

bool fw_word_next(const char **rest, const char *separators, fw_word *word) {
    word->at = *rest + strspn(*rest, separators);
    word->length = strcspn(word->at, separators);
    *rest = word->at + word->length;
    return word->length > 0;
}

bool fw_word_is(fw_word word, const char *name) {
    return strlen(name) == word.length && memcmp(name, word.at, word.length) == 0;
}

bool fw_words_hold(const char *words, const char *separators, const char *name) {
    for (fw_word word; fw_word_next(&words, separators, &word);)
        if (fw_word_is(word, name)) return true;
    return false;
}

bool fw_text_same(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* words of a kind stand with a space in it, and in ids with whatever may stand there */
const char *fw_text_kind(const char *kind, const char *id) {
    size_t n = strlen(kind) - 1;
    for (size_t i = 0; id && i < n; i++) {
        const bool same = kind[i] == ' ' ? id[i] == '-' || id[i] == '_' || id[i] == '.'
                                         : tolower((unsigned char)id[i]) == kind[i];
        if (!same) return kind;
    }
    return id && !isalpha((unsigned char)id[n]) ? "" : kind;
}

const char *fw_text_name(const char *id) {
    return id ? id : "(unnamed)";
}

/* SHA-256, FIPS 180-4 sections 4.1.2, 5.1.1 and 6.2. Test: test_hash.c (FIPS examples). */

/* first 32 bits of the fractional parts of the cube roots of the first 64 primes */
static const uint32_t k[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t turn(uint32_t x, int n) {
    return x >> n | x << (32 - n);
}

/* one round; the eight variables change their places by their names, not by moves */
static inline void round_of(uint32_t a, uint32_t b, uint32_t c, uint32_t *d, uint32_t e, uint32_t f,
                            uint32_t g, uint32_t *h, uint32_t add) {
    const uint32_t s1 = turn(e, 6) ^ turn(e, 11) ^ turn(e, 25);
    const uint32_t s0 = turn(a, 2) ^ turn(a, 13) ^ turn(a, 22);
    const uint32_t t1 = *h + s1 + (g ^ (e & (f ^ g))) + add;
    *d += t1;
    *h = t1 + s0 + ((a & b) | (c & (a | b)));
}

static void block(uint32_t state[8], const unsigned char *p) {
    uint32_t w[64];
    for (int i = 0; i < 16; i++)
        w[i] = (uint32_t)p[4 * i] << 24 | (uint32_t)p[4 * i + 1] << 16 |
               (uint32_t)p[4 * i + 2] << 8 | p[4 * i + 3];
    for (int i = 16; i < 64; i++) {
        uint32_t s0 = turn(w[i - 15], 7) ^ turn(w[i - 15], 18) ^ w[i - 15] >> 3;
        uint32_t s1 = turn(w[i - 2], 17) ^ turn(w[i - 2], 19) ^ w[i - 2] >> 10;
        w[i] = w[i - 16] + s0 + w[i - 7] + s1;
    }
    uint32_t a = state[0], b = state[1], c = state[2], d = state[3];
    uint32_t e = state[4], f = state[5], g = state[6], h = state[7];
    for (int i = 0; i < 64; i += 8) {
        round_of(a, b, c, &d, e, f, g, &h, k[i] + w[i]);
        round_of(h, a, b, &c, d, e, f, &g, k[i + 1] + w[i + 1]);
        round_of(g, h, a, &b, c, d, e, &f, k[i + 2] + w[i + 2]);
        round_of(f, g, h, &a, b, c, d, &e, k[i + 3] + w[i + 3]);
        round_of(e, f, g, &h, a, b, c, &d, k[i + 4] + w[i + 4]);
        round_of(d, e, f, &g, h, a, b, &c, k[i + 5] + w[i + 5]);
        round_of(c, d, e, &f, g, h, a, &b, k[i + 6] + w[i + 6]);
        round_of(b, c, d, &e, f, g, h, &a, k[i + 7] + w[i + 7]);
    }
    const uint32_t add[8] = {a, b, c, d, e, f, g, h};
    for (int i = 0; i < 8; i++)
        state[i] += add[i];
}

void fw_sha256(const void *data, size_t n, char text[65]) {
    /* first 32 bits of the fractional parts of the square roots of the first 8 primes */
    uint32_t h[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                     0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    const unsigned char *p = data;
    size_t whole = n / 64;
    for (size_t i = 0; i < whole; i++)
        block(h, p + 64 * i);
    unsigned char tail[128] = {0};
    size_t rest = n - 64 * whole, length = rest < 56 ? 64 : 128;
    if (rest) memcpy(tail, p + 64 * whole, rest);
    tail[rest] = 0x80;
    for (size_t i = 0; i < 8; i++)
        tail[length - 1 - i] = (unsigned char)((uint64_t)n * 8 >> 8 * i);
    for (size_t i = 0; i < length; i += 64)
        block(h, tail + i);
    static const char digit[] = "0123456789abcdef";
    for (int i = 0; i < 32; i++) {
        uint32_t byte = h[i / 4] >> (24 - 8 * (i % 4)) & 0xff;
        text[2 * i] = digit[byte >> 4];
        text[2 * i + 1] = digit[byte & 15];
    }
    text[64] = '\0';
}

void fw_text_cut(char *to, size_t n, const char *from) {
    size_t end = strlen(from);
    if (end < n) {
        memcpy(to, from, end + 1);
        return;
    }
    end = n - 4;
    while (end > 0 && ((unsigned char)from[end] & 0xC0) == 0x80)
        end--;
    memcpy(to, from, end);
    memcpy(to + end, "...", 4);
}

const char *fw_text_few(fw_arena *arena, const char *list) {
    enum { NAMED = 8 };
    const char *end = NULL;
    int n = 1;
    for (const char *next = list; next && (next = strstr(next, ", ")); next += 2)
        if (n++ == NAMED) end = next;
    if (!end) return list;
    return fw_arena_printf(arena, "%.*s and %d more", (int)(end - list), list, n - NAMED);
}
