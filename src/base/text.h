/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A growing text in an arena. Errors stick: check `failed` (or fw_text_end) once, at the end.
   Numbers never depend on the locale. */
#ifndef FW_BASE_TEXT_H
#define FW_BASE_TEXT_H
#include "base/arena.h"
#include "base/status.h"
#include <stddef.h>
#include <stdint.h>

typedef struct fw_text {
    fw_arena *arena;
    char *data; /* always NUL-terminated once something was added */
    size_t length, capacity;
    int failed;
} fw_text;

/* bytes of the UTF-8 character at the start of the string (RFC 3629), 0: it is none; *code: which */
size_t fw_text_utf8(const char *string, unsigned *code);
/* the character at *at, which moves behind it; U+FFFD for a byte that is no UTF-8 */
unsigned fw_text_character(const char **at);
/* an order to who shows a text, in place of something to be read: a control character (C0, DEL, C1), or what turns the
   order of reading or breaks the line (U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069) */
bool fw_text_is_order(unsigned code);
/* UTF-8 without any of them */
bool fw_text_is_line(const char *string);
/* n bytes as one line that may be shown anywhere: C0 is a blank, other orders and bytes that are no UTF-8 are U+FFFD.
   NULL: no memory. Test: test_growing_text.c */
const char *fw_text_shown(fw_arena *arena, const char *string, size_t n);

fw_text fw_text_new(fw_arena *arena);
void fw_text_add(fw_text *text, const char *string);
/* room for so many bytes more at once, where a large text's size is known before */
void fw_text_reserve(fw_text *text, size_t more);
void fw_text_bytes(fw_text *text, const void *data, size_t n);
/* n bytes more, to be filled by the caller; NULL: no memory, and the text has failed */
unsigned char *fw_text_room(fw_text *text, size_t n);
/* printf without %f, %e, %g: those follow the locale; use fw_text_number */
void fw_text_printf(fw_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* `digits` significant digits, shortest form, '.' always; 17 round-trips */
void fw_text_number(fw_text *text, double value, int digits);
/* fixed decimals without trailing zeros (for SVG coordinates and tables) */
void fw_text_fixed(fw_text *text, double value, int decimals);
/* one printf conversion of a double ("%8.2f", "%.1e"), with '.' in every locale: aligned tables */
void fw_text_real(fw_text *text, const char *conversion, double value);
/* escape & < > " ' for XML and HTML; control characters become spaces, other orders and what is no UTF-8 U+FFFD */
void fw_text_escaped(fw_text *text, const char *string);
/* a field of CSV (RFC 4180), quoted where needed; line breaks and orders become spaces, and what a spreadsheet would take
   for a formula gets a quote in front */
void fw_text_csv(fw_text *text, const char *string);
fw_status fw_text_end(const fw_text *text); /* FW_OK or FW_NOMEM */

/* the same fixed decimals (at most 17) into a buffer of FW_FIXED_BYTES; returns the end, where a
   NUL is: for writers of millions of numbers */
enum { FW_FIXED_BYTES = 352 };
char *fw_fixed_text(char *buffer, double value, int decimals);
/* the same with six decimals, faster; and two of them with a blank between, without a NUL, into
   2 * FW_FIXED_BYTES */
char *fw_millionths_text(char *buffer, double value);
char *fw_place_text(char *buffer, double x, double y);
/* the same into a caller's buffer of n bytes; returns buffer */
char *fw_number_text(char *buffer, size_t n, double value, int digits);
/* "354 uN": a value in a unit of SI with the prefix that leaves one to three digits before the point, down to 1e-9 (of farads
   1e-15) and up to 1e9 */
char *fw_prefixed_text(char *buffer, size_t n, double value, const char *unit, int digits);
/* so many digits, or as many as a number below a million needs to be written without an exponent */
static inline int fw_number_plain(double value, int digits) {
    double most = 1;
    for (int i = 0; i < digits; i++)
        most *= 10;
    while (digits < 6 && (value >= most || value <= -most))
        most *= 10, digits++;
    return digits;
}
/* 100 times `part` to three digits, below a million without an exponent: "0.364", "11100" */
char *fw_percent_text(char *buffer, size_t n, double part);
/* whole string is one finite number ('.' decimal, optional exponent, no hex, inf or nan)? */
int fw_number_parse(const char *string, size_t n, double *value);
/* Words of a list: letters between separators (of which there may be several). */
typedef struct fw_word {
    const char *at; /* not ended by a NUL */
    size_t length;
} fw_word;
/* the first word of *rest, behind which *rest moves; false: there is none left */
bool fw_word_next(const char **rest, const char *separators, fw_word *word);
bool fw_word_is(fw_word word, const char *name);
/* is this one of them? An empty name is none */
bool fw_words_hold(const char *words, const char *separators, const char *name);
/* alike; NULL is like NULL alone */
bool fw_text_same(const char *a, const char *b);
/* what of `from` has room in `to` (n > 4), with "..." where that is not all; never cut inside a character */
void fw_text_cut(char *to, size_t n, const char *from);
/* Sentences name things by their kind and their id, "hinge A"; an id that begins with its kind, as "hinge-2" does, says it
   itself. For "%s%s": FW_NAMED("hinge", id). Test: tests/unit/base/test_markup.c */
#define FW_NAMED(kind, id) fw_text_kind(kind " ", id), (id)
const char *fw_text_kind(const char *kind,
                         const char *id); /* kind, with its space at the end, or "" */
/* what nobody named (NULL) is "(unnamed)" */
const char *fw_text_name(const char *id);

/* Of a list with ", " between its ids, for people: all where they are eight at most, else the first eight "and 92 more". NULL: memory is short, or there is no list */
const char *fw_text_few(fw_arena *arena, const char *list);

/* FNV-1a of bytes, or of words: where a key lies in a table in memory, and whether two are surely different. It is no
   proof that they are alike. */
static const uint64_t FW_HASH_BEGIN = 14695981039346656037u;
static inline uint64_t fw_hash_add(uint64_t hash, uint64_t word) {
    return (hash ^ word) * 1099511628211u;
}

/* SHA-256 (FIPS 180-4). */

/* 64 hexadecimal digits and a NUL into `text` */
void fw_sha256(const void *data, size_t n, char text[65]);

#endif
