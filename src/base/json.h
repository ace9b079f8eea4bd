/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The writer of JSON: every document of the program goes through it. Members and elements are given
   one after the other, with their key (NULL for an element of a list); commas, escapes, line breaks
   and closing brackets are written here:

     fw_json json = fw_json_new(out, FW_JSON_COMPACT);
     fw_json_object(&json, NULL);
     fw_json_text(&json, "id", "A");
     fw_json_list(&json, "list");
     fw_json_number(&json, NULL, 1, 6);
     fw_json_end(&json);
     fw_json_end(&json);
     return fw_json_finish(&json, "\n");          {"id":"A","list":[1]}

   Errors stick: a want of memory in the text, a wrong nesting (a member without a key, an element
   with one, a bracket too many or too few) in the writer. fw_json_finish tells. No recursion, no
   tree: cost is that of the bytes. Test: test_json.c, which reads random documents back with
   another library. */
#ifndef FW_BASE_JSON_H
#define FW_BASE_JSON_H
#include "base/text.h"
#include <stdbool.h>
#include <stdint.h>

typedef enum fw_json_style {
    FW_JSON_COMPACT,    /* {"a":1,"b":[1,2]}, lines where fw_json_line asks for them */
    FW_JSON_SPACED,     /* {"a": 1, "b": [1, 2]}, the same */
    FW_JSON_INDENTED,   /* every member and element on a line of its own, one blank per level */
    FW_JSON_INDENTED_2, /* two blanks per level */
} fw_json_style;

enum { FW_JSON_DEPTH = 64 }; /* levels that may be open at a time */

typedef struct fw_json_wanted { /* keys, NULL behind the last */
    const char *const *member;  /* of the outermost object; NULL: all */
    const char *const *inner;   /* of what these hold, but for texts, which all stay; NULL: all */
} fw_json_wanted;

typedef struct fw_json { /* read by nobody but base/json.c */
    fw_text *out;
    fw_json_style style;
    int depth;
    uint64_t objects, filled; /* bit k: level k is an object; holds something already */
    bool fresh;               /* the separator of what comes next is written */
    bool wrong;               /* was nested wrongly */
    fw_json_wanted only;
    int left_out;    /* level of a member that is left out; 0: none is */
    fw_text unheard; /* for callers that write a value of their own into it */
} fw_json;

fw_json fw_json_new(fw_text *out, fw_json_style style);
/* Only what is wanted is written; of the rest nothing is, whatever it holds, and its numbers are not made into text.
   In indented styles. Before the outermost object is begun. */
void fw_json_only(fw_json *json, fw_json_wanted wanted);
/* `behind` comes after the document: a line break, or "". FW_INTERNAL: it was nested wrongly */
fw_status fw_json_finish(fw_json *json, const char *behind);

void fw_json_object(fw_json *json, const char *key);
void fw_json_list(fw_json *json, const char *key);
void fw_json_end(fw_json *json); /* of the innermost object or list */
/* The comma that is due, and what follows stands on a new line, behind so many blanks; the same for
   a closing bracket. Not for indented styles, which break every line themselves. */
void fw_json_line(fw_json *json, int blanks);
void fw_json_end_line(fw_json *json, int blanks);

/* are all n bytes UTF-8, without a NUL? */
bool fw_json_is_text(const char *text, size_t n);
/* NULL: null. Bytes that are no UTF-8 (RFC 3629: cut by a message's limit) become '?'. Control
   characters become \u00xx in the compact style, \n, \t and the like in the others */
void fw_json_text(fw_json *json, const char *key, const char *value);
void fw_json_textf(fw_json *json, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4))); /* without %f, %e, %g, as fw_text_printf */
/* so many significant digits, shortest form; null where it is not finite, no minus zero */
void fw_json_number(fw_json *json, const char *key, double value, int digits);
/* the whole double: 17 digits, always with a point or an exponent; null where it is not finite, no
   minus zero */
void fw_json_real(fw_json *json, const char *key, double value);
/* so many decimals, without trailing zeros; null where it is not finite */
void fw_json_fixed(fw_json *json, const char *key, double value, int decimals);
void fw_json_whole(fw_json *json, const char *key, long long value);
void fw_json_truth(fw_json *json, const char *key, bool value);
void fw_json_null(fw_json *json, const char *key);
/* the key, and the text into which the caller writes one value that is JSON already */
fw_text *fw_json_value(fw_json *json, const char *key);
#endif
