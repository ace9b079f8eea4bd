/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/diag.h"
#include "base/sort.h"
#include "base/status.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const fw_diag_entry table[] = {
#define X(number, title, text) {number, title, text},
#include "base/diagnostics.def"
#undef X
};

const fw_diag_entry *fw_diag_table(size_t *count) {
    *count = sizeof table / sizeof table[0];
    return table;
}

const fw_diag_entry *fw_diag_find(int number) {
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (table[i].number == number) return &table[i];
    return NULL;
}

const char *fw_place_file(fw_place place) {
    const char *slash = place.file ? strrchr(place.file, '/') : NULL;
    return slash ? slash + 1 : place.file ? place.file : "";
}

fw_diags fw_diags_new(fw_arena *arena) {
    return (fw_diags){.arena = arena};
}

bool fw_diags_reserve(fw_diags *diags) {
    fw_diag *item =
        fw_arena_grow(diags->arena, diags->item, diags->count, FW_DIAG_MOST, sizeof *diags->item);
    if (!item) return false;
    diags->item = item;
    diags->capacity = FW_DIAG_MOST;
    return true;
}

void fw_diags_call(fw_diags *diags) {
    diags->before = diags->count;
    diags->failed = 0; /* the call that it was of has answered so */
}

static bool take_out(fw_diags *diags, size_t i) {
    diags->count--;
    memmove(&diags->item[i], &diags->item[i + 1], (diags->count - i) * sizeof diags->item[0]);
    if (i < diags->before) diags->before--;
    return true;
}

/* In a full list the oldest error of earlier calls goes first; then, before an error is lost, the last note or else warning.
   false: there is none */
static bool make_room(fw_diags *diags, fw_severity severity) {
    for (size_t i = 0; i < diags->before; i++)
        if (diags->item[i].severity == FW_ERROR) return take_out(diags, i);
    for (fw_severity least = FW_NOTE; severity == FW_ERROR && least != FW_ERROR;
         least = least == FW_NOTE ? FW_WARNING : FW_ERROR)
        for (size_t i = diags->count; i-- > 0;)
            if (diags->item[i].severity == least) return take_out(diags, i);
    return false;
}

static bool is_said(const fw_diags *diags, int number, fw_place place) {
    for (size_t i = 0; i < diags->count; i++)
        if (diags->item[i].number == number && diags->item[i].place.line == place.line &&
            diags->item[i].place.column == place.column && place.line > 0)
            return true;
    return false;
}

bool fw_diag_said(fw_diags *diags, int number, fw_place place) {
    diags->once = number;
    return is_said(diags, number, place);
}

/* counts it, and says whether there is a place for it */
static bool has_place(fw_diags *diags, const fw_diag *kind) {
    if (kind->severity == FW_ERROR) diags->errors++;
    if (kind->unreliable) diags->unreliable++;
    if (diags->count < FW_DIAG_MOST) return true;
    diags->dropped++;
    return make_room(diags, kind->severity);
}

void fw_diags_put(fw_diags *diags, fw_diag ready) {
    if (!has_place(diags, &ready)) diags->count--;
    if (diags->count < diags->capacity) diags->item[diags->count++] = ready;
}

/* kind: all but the message */
static void add(fw_diags *diags, fw_diag kind, const char *format, va_list arguments) {
    kind.once = kind.once || kind.number == diags->once;
    if (kind.severity == FW_ERROR && diags->reason) kind.reason = diags->reason;
    diags->reason = 0;
    if (!has_place(diags, &kind)) return;
    if (diags->count == diags->capacity) {
        size_t more = diags->capacity ? 2 * diags->capacity : 8;
        fw_diag *item =
            fw_arena_grow(diags->arena, diags->item, diags->count, more, sizeof *diags->item);
        if (!item) {
            diags->failed = 1;
            return;
        }
        diags->item = item;
        diags->capacity = more;
    }
    char buffer[2048];
    vsnprintf(buffer, sizeof buffer, format, arguments);
    /* it may quote what a stranger wrote */
    kind.message = fw_text_shown(diags->arena, buffer, strlen(buffer));
    if (!kind.message) {
        diags->failed = 1;
        return;
    }
    diags->item[diags->count++] = kind;
}

fw_status fw_diag_error(fw_diags *diags, int number, fw_place place, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add(diags, (fw_diag){.number = number, .severity = FW_ERROR, .place = place}, format,
        arguments);
    va_end(arguments);
    return diags->failed ? FW_NOMEM : FW_INPUT;
}

fw_diags *fw_diags_because(fw_diags *diags, int reason) {
    diags->reason = reason;
    return diags;
}

fw_status fw_diag_formula_ended(fw_diags *diags, int number, fw_diag_ended ended, fw_place place,
                                const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add(diags, (fw_diag){.number = number, .severity = FW_ERROR, .place = place, .ended = ended},
        format, arguments);
    va_end(arguments);
    return diags->failed ? FW_NOMEM : FW_INPUT;
}

void fw_diag_warning(fw_diags *diags, int number, fw_place place, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add(diags, (fw_diag){.number = number, .severity = FW_WARNING, .place = place}, format,
        arguments);
    va_end(arguments);
}

void fw_diag_unreliable(fw_diags *diags, int number, fw_place place, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add(diags,
        (fw_diag){.number = number, .severity = FW_WARNING, .place = place, .unreliable = true},
        format, arguments);
    va_end(arguments);
}

void fw_diag_note(fw_diags *diags, int number, fw_place place, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add(diags, (fw_diag){.number = number, .severity = FW_NOTE, .place = place}, format, arguments);
    va_end(arguments);
}

static void add_text(fw_diags *diags, fw_diag kind, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add(diags, kind, format, arguments);
    va_end(arguments);
}

void fw_diags_add(fw_diags *diags, const fw_diag *d, fw_severity severity) {
    fw_diag kind = {.number = d->number,
                    .severity = severity,
                    .place = d->place,
                    .ended = severity == d->severity ? d->ended : FW_ENDED_NOT,
                    .unreliable = d->unreliable && severity == d->severity,
                    .once = d->once,
                    .reason = d->reason};
    add_text(diags, kind, "%s", d->message);
}

void fw_diags_take(fw_diags *diags, const fw_diags *from) {
    for (size_t i = 0; i < from->count; i++) {
        const fw_diag *d = &from->item[i];
        if (!d->once || !is_said(diags, d->number, d->place)) fw_diags_add(diags, d, d->severity);
    }
}

static void show_line(fw_text *out, const char *source, size_t n, fw_place place) {
    size_t start = 0;
    for (int line = 1; line < place.line; line++) {
        const char *end = memchr(source + start, '\n', n - start);
        if (!end) return;
        start = (size_t)(end - source) + 1;
    }
    const char *end = memchr(source + start, '\n', n - start);
    size_t length = end ? (size_t)(end - source) - start : n - start;
    if (length > 200 || (size_t)place.column > length + 1 || place.column < 1) return;
    const char *shown = fw_text_shown(out->arena, source + start, length);
    const char *before = fw_text_shown(out->arena, source + start, (size_t)place.column - 1);
    if (!shown || !before) {
        out->failed = 1;
        return;
    }
    fw_text_printf(out, "  %4d | %s\n       | ", place.line, shown);
    while (*before) { /* one column per character */
        fw_text_character(&before);
        fw_text_add(out, " ");
    }
    fw_text_add(out, "^\n");
}

static int in_file_order(const void *left, const void *right) {
    const fw_diag *a = *(const fw_diag *const *)left, *b = *(const fw_diag *const *)right;
    int order = fw_order_wholes(a->place.line, b->place.line);
    if (!order) order = fw_order_wholes(a->place.column, b->place.column);
    return order ? order : (a > b) - (a < b);
}

void fw_diags_print(const fw_diags *diags, fw_text *out, const char *file, const char *source,
                    size_t n, int colour) {
    static const char *const word[] = {"note", "warning", "error"};
    static const char *const paint[] = {"\033[36m", "\033[35m", "\033[1;31m"};
    const fw_diag *order[FW_DIAG_MOST];
    for (size_t i = 0; i < diags->count; i++)
        order[i] = &diags->item[i];
    qsort(order, diags->count, sizeof order[0], in_file_order);
    for (size_t i = 0; i < diags->count; i++) {
        const fw_diag *d = order[i];
        const char *name = d->place.file ? d->place.file : "";
        name = fw_text_shown(out->arena, name, strlen(name));
        if (!name) out->failed = 1;
        if (d->place.file && name) fw_text_printf(out, "%s:", name);
        if (d->place.line > 0) fw_text_printf(out, "%d:%d:", d->place.line, d->place.column);
        fw_text_printf(out, "%s%s%s%s: %s [FW-D%03d]\n", d->place.file ? " " : "",
                       colour ? paint[d->severity] : "", word[d->severity], colour ? "\033[0m" : "",
                       d->message, d->number);
        if (source && d->place.line > 0 && d->place.file && strcmp(d->place.file, file) == 0)
            show_line(out, source, n, d->place);
    }
    if (diags->dropped) fw_text_printf(out, "%zu more not shown\n", diags->dropped);
}

const char *fw_status_text(fw_status status) {
    switch (status) {
#define FW_STATUS_CASE(code, exit_status, text)                                                    \
    case FW_##code:                                                                                \
        return text;
        FW_STATUS_TABLE(FW_STATUS_CASE)
#undef FW_STATUS_CASE
    }
    return "unknown status";
}

int fw_status_exit(fw_status status) {
    switch (status) {
#define FW_STATUS_CASE(code, exit_status, text)                                                    \
    case FW_##code:                                                                                \
        return exit_status;
        FW_STATUS_TABLE(FW_STATUS_CASE)
#undef FW_STATUS_CASE
    }
    return 70;
}

/* ---- what was probably meant ---- */

int fw_edit_distance(const char *a, const char *b, int limit) {
    enum { LONGEST = 64 };
    size_t na = strlen(a), nb = strlen(b);
    if (na > LONGEST || nb > LONGEST) return limit + 1;
    int row[3][LONGEST + 1];
    for (size_t j = 0; j <= nb; j++)
        row[0][j] = (int)j;
    for (size_t i = 1; i <= na; i++) {
        int *now = row[i % 3], *up = row[(i + 2) % 3], *up2 = row[(i + 1) % 3];
        now[0] = (int)i;
        for (size_t j = 1; j <= nb; j++) {
            int best = up[j - 1] + (a[i - 1] != b[j - 1]);
            if (up[j] + 1 < best) best = up[j] + 1;
            if (now[j - 1] + 1 < best) best = now[j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                up2[j - 2] + 1 < best)
                best = up2[j - 2] + 1;
            now[j] = best;
        }
    }
    int d = row[na % 3][nb];
    return d > limit ? limit + 1 : d;
}

/* The one name that begins as the word does, for four letters or more and nearly all of the shorter of the two:
   "requirement" for "require", "step" for "step-load". Several that do so equally well are none. */
static const char *begins_alike(const char *word, const char *const *names, size_t count) {
    const char *best = NULL;
    size_t most = 3, length = strlen(word);
    bool several = false;
    for (size_t i = 0; i < count; i++) {
        const size_t other = strlen(names[i]), shorter = length < other ? length : other;
        size_t same = 0;
        while (same < shorter && word[same] == names[i][same])
            same++;
        if (same < most || same < 4 || 4 * same < 3 * shorter) continue;
        several = same == most && best && strcmp(best, names[i]) != 0;
        most = same, best = names[i];
    }
    return several ? NULL : best;
}

const char *fw_did_you_mean(const char *word, const char *const *names, size_t count) {
    const char *best = NULL;
    int least = 3;
    for (size_t i = 0; i < count; i++) {
        int d = fw_edit_distance(word, names[i], 2);
        if (d < least && (size_t)d < strlen(names[i])) {
            least = d;
            best = names[i];
        }
    }
    return best ? best : begins_alike(word, names, count);
}

const char *fw_text_meant(fw_arena *arena, const char *word, const char *const *names,
                          size_t count) {
    enum { MOST = 12 };
    const char *near = fw_did_you_mean(word, names, count);
    if (near) return fw_arena_printf(arena, "; did you mean '%s'?", near);
    fw_text list = fw_text_new(arena);
    fw_text_add(&list, "");
    for (size_t i = 0, same, listed = 0; i < count && listed <= MOST; i++) {
        for (same = 0; strcmp(names[same], names[i]) != 0;)
            same++;
        if (same < i) continue;
        fw_text_printf(&list, "%s%s", listed ? " " : "; there are ",
                       listed < MOST ? names[i] : "...");
        listed++;
    }
    return fw_text_end(&list) == FW_OK ? list.data : NULL;
}
