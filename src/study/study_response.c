/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a device that a study looks at: what a decision follows from, and one of a document, by the keys that lead
   to it.

     [DOCUMENT:] KEY ( .KEY | [SELECTOR] )*

   SELECTOR picks elements of a list: a number counts from 0; * is all of them; words with commas between
   pick those of which every word is the value of some text ([stroke,step]: the requirement of that probe in that
   scene). Cost: that of the keys on the way. Test: tests/unit/study/test_response.c */
#include "study/study_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

const fw_study_document fw_study_documents[] = {
    {"verdict", FW_DOCUMENT_VERDICT_JSON, FW_STUDY_STAGE_JUDGE},
    {"simulate", FW_DOCUMENT_SIMULATE_JSON, FW_STUDY_STAGE_SIMULATE},
    {"statics", FW_DOCUMENT_STATICS_JSON, FW_STUDY_STAGE_STATICS},
    {"modes", FW_DOCUMENT_MODES_JSON, FW_STUDY_STAGE_MODES},
    {"workspace", FW_DOCUMENT_WORKSPACE_JSON, FW_STUDY_STAGE_WORKSPACE},
    {"masks", FW_DOCUMENT_MASKS_JSON, FW_STUDY_STAGE_JUDGE | FW_STUDY_STAGE_FABRICATE},
    {"recipes", FW_DOCUMENT_RECIPES_JSON, FW_STUDY_STAGE_JUDGE | FW_STUDY_STAGE_FABRICATE},
};
const int fw_study_document_count = sizeof fw_study_documents / sizeof fw_study_documents[0];

/* ---- units, by the end of a key ---- */

/* "m2_rad" as units are written: "m2 rad"; "N_per_m": "N/m", "per_s": "1/s", "Nm": "N m" */
static bool spelt(const char *key, size_t n, char text[64]) {
    size_t length = 0;
    for (size_t k = 0; k < n; k++) {
        const bool first = k == 0, behind = k > 0 && key[k - 1] == '_';
        if (length + 4 > 64) return false;
        if (n - k > 4 && strncmp(key + k, "per_", 4) == 0 && (first || behind)) {
            if (first) text[length++] = '1';
            if (!first) length--; /* the blank */
            text[length++] = '/', k += 3;
        } else {
            if (k > 0 && key[k] == 'm' && key[k - 1] == 'N') text[length++] = ' ';
            text[length++] = key[k] == '_' ? ' ' : key[k];
        }
    }
    text[length] = '\0';
    return true;
}

static bool is_unit(const char *text) {
    fw_quantity_unit found;
    return fw_quantity_unit_parse(text, strlen(text), &found, NULL, NULL);
}

/* "volume_m2_rad" ends in "m2 rad": the longest end behind a '_' that is a unit; of what is counted by something, as
   "bias_um_per_edge", it is that without. A whole key is one where it has an exponent or a quotient ("m2_rad"): "min_s"
   is a least time. "": there is none */
static fw_status unit_of_key(fw_arena *arena, const char *key, size_t n, const char **unit) {
    char text[64];
    *unit = "";
    for (size_t at = 0; at < n; at++) {
        if (at > 0 && key[at - 1] != '_') continue;
        if (!spelt(key + at, n - at, text)) continue;
        char *per = strrchr(text, '/');
        if (at == 0 && (!memchr(key, '_', n) || (!per && !strpbrk(text, "23")))) continue;
        if (!is_unit(text) && per && at > 0 && !is_unit(per + 1)) *per = '\0';
        if (!is_unit(text)) continue;
        FW_NEED(*unit = fw_arena_strdup(arena, text));
        return FW_OK;
    }
    return FW_OK;
}

/* the last key of a path, without selectors behind it; before: of what stands before that (NULL: of all); *n 0: none */
static void last_key(const char *path, const char *before, const char **key, size_t *n) {
    *key = path, *n = 0;
    for (const char *at = path; *at && at != before;) {
        if (*at == '[') {
            const char *end = strchr(at, ']');
            at = end ? end + 1 : at + strlen(at);
        } else if (*at == '.') {
            at++;
        } else {
            *key = at, *n = strcspn(at, ".[");
            at += *n;
        }
    }
}

/* "utilisation", "utilisation_band": of a limit */
static bool is_share(const char *key, size_t n) {
    static const char used[] = "utilisation";
    const size_t length = sizeof used - 1;
    return n >= length && strncmp(key, used, length) == 0 && (n == length || key[length] == '_');
}

/* what stands in the unit that the document says beside it, as a requirement's value in that of its probe */
static bool is_of_unit_beside(const char *key, size_t n) {
    static const char *const keys[] = {"value",       "band",        "all_corners_band",
                                       "margin",      "min",         "max",
                                       "nominal",     "low",         "high",
                                       "limit",       "needed",      "peak",
                                       "maximum",     "minimum",     "final",
                                       "across",      "error",       "u",
                                       "final_error", "level_error", "u_measured",
                                       "uncertainty"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (strlen(keys[i]) == n && memcmp(keys[i], key, n) == 0) return true;
    return false;
}

/* of its last key, or of the one around that has it, "time_s.nominal" */
static fw_status unit_of_path(fw_arena *arena, const char *path, const char **unit) {
    const char *key, *before = NULL;
    size_t n;
    *unit = "";
    for (last_key(path, before, &key, &n); n > 0 && !**unit; last_key(path, before, &key, &n)) {
        if (n > 9 && strncmp(key, "relative_", 9) == 0) return FW_OK; /* of the number itself */
        FW_TRY(unit_of_key(arena, key, n, unit));
        before = key;
    }
    return FW_OK;
}

static bool well_formed(const char *path) {
    if (!*path || *path == '.' || *path == '[') return false;
    for (const char *at = path; *at;) {
        if (*at == '[') {
            size_t n = strcspn(at, "]");
            if (at[n] != ']' || n < 2) return false;
            at += n + 1;
            if (*at && *at != '.' && *at != '[') return false;
        } else if (*at == '.') {
            if (!at[1] || at[1] == '.' || at[1] == '[') return false;
            at++;
        } else {
            at += strcspn(at, ".[");
        }
    }
    return true;
}

/* n: bytes of the name that was asked for */
static fw_status no_document(fw_arena *arena, const fw_device_respond *asked, size_t n,
                             fw_diags *diags) {
    fw_text names = fw_text_new(arena);
    for (int i = 0; i < fw_study_document_count; i++)
        fw_text_printf(&names, "%s%s",
                       i == 0                            ? ""
                       : i + 1 < fw_study_document_count ? ", "
                                                         : " and ",
                       fw_study_documents[i].name);
    FW_TRY(fw_text_end(&names));
    return fw_diag_error(diags, 492, asked->place,
                         "response '%s': there is no document '%.*s'; there are %s", asked->name,
                         (int)n, asked->value, names.data);
}

fw_status fw_study_response_parse(fw_arena *arena, const fw_device_respond *asked, fw_diags *diags,
                                  fw_study_response *response) {
    const char *key, *colon = strchr(asked->value, ':'), *bracket = strchr(asked->value, '[');
    size_t n = 0;
    if (colon && bracket && bracket < colon) colon = NULL; /* of a selector */
    *response = (fw_study_response){.asked = asked, .path = asked->value, .now = (double)NAN};
    if (colon) {
        n = (size_t)(colon - asked->value);
        response->path = colon + 1 + strspn(colon + 1, " ");
        response->document = -1;
        for (int i = 0; i < fw_study_document_count; i++)
            if (strlen(fw_study_documents[i].name) == n &&
                memcmp(fw_study_documents[i].name, asked->value, n) == 0)
                response->document = i;
        if (response->document < 0) return no_document(arena, asked, n, diags);
    }
    if (!well_formed(response->path))
        return fw_diag_error(diags, 492, asked->place,
                             "response '%s': \"%s\" is no path; write keys with dots between and "
                             "elements of lists in brackets: hinges[C].utilisation",
                             asked->name, response->path);
    last_key(response->path, NULL, &key, &n);
    response->share = is_share(key, n);
    response->unit_beside = is_of_unit_beside(key, n);
    response->unit = "";
    response->min = asked->min, response->max = asked->max;
    return response->share || response->unit_beside
               ? FW_OK
               : unit_of_path(arena, response->path, &response->unit);
}

/* small and large ones have a prefix: 251.94 um, not 0.00025194 m */
static bool wants_prefix(double value, const char *unit) {
    static const char *const takes[] = {"m", "s", "N",  "F",  "V",   "A",   "W",
                                        "J", "C", "Hz", "Pa", "N/m", "m/s", "m/s^2"};
    const double size = fabs(value);
    bool one = false;
    for (size_t k = 0; k < sizeof takes / sizeof takes[0]; k++)
        one |= strcmp(unit, takes[k]) == 0;
    return one && size > 0 && (size < 0.01 || size >= 1e5);
}

static void value_text(fw_text *out, const fw_study_response *response, double value,
                       const char *percent) {
    const char *unit = response->unit;
    char text[64];
    if (isnan(value)) {
        fw_text_add(out, "no value");
    } else if (wants_prefix(value, response->share ? "" : unit)) {
        fw_text_add(out, fw_prefixed_text(text, sizeof text, value, unit, 5));
    } else if (response->share) {
        fw_text_printf(out, "%s%s", fw_percent_text(text, sizeof text, value), percent);
    } else {
        fw_text_number(out, value, 5);
        if (*unit && strcmp(unit, "1") != 0) fw_text_printf(out, " %s", unit);
    }
}

void fw_study_response_text(fw_text *out, const fw_study_response *response, double value) {
    value_text(out, response, value, " %");
}

void fw_study_change_text(fw_text *out, const fw_study_response *response, double change) {
    value_text(out, response, change, " percentage points");
}

double fw_study_response_drawn(const fw_study_response *response, double value) {
    return response->share ? 100 * value : value;
}

const char *fw_study_response_drawn_in(const fw_study_response *response) {
    return response->share ? "%" : response->unit;
}

/* ---- the way through a document ---- */

typedef struct walk {
    const fw_study_response *response;
    const json_t *root;
    double value;
    long found;   /* numbers that were met */
    bool strange; /* something else than a number was met */
    char *why;
    size_t n;                  /* bytes of why */
    const char *beside, *unit; /* of the object that it is in; of what was met */
    bool mixed;                /* of several */
    char several[200]; /* what names the elements that are meant of the first list; "": none */
} walk;

static void say(walk *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(walk *w, const char *format, ...) {
    va_list list;
    if (w->why[0]) return; /* the first says it */
    va_start(list, format);
    vsnprintf(w->why, w->n, format, list);
    va_end(list);
}

/* the keys of an object, or what names the elements of a list, for messages */
static void names_of(const json_t *node, char *text, size_t n) {
    static const char *const naming[] = {"id", "probe", "name", "part", "flow", "scene"};
    size_t used = 0;
    text[0] = '\0';
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)node, key, value) {
        if (used + strlen(key) + 3 < n)
            used += (size_t)snprintf(text + used, n - used, "%s%s", used ? " " : "", key);
    }
    for (size_t i = 0; json_is_array(node) && i < json_array_size(node); i++) {
        const json_t *item = json_array_get(node, i);
        const char *name = NULL;
        for (size_t k = 0; k < sizeof naming / sizeof naming[0] && !name; k++)
            name = json_string_value(json_object_get(item, naming[k]));
        if (name && used + strlen(name) + 3 < n)
            used += (size_t)snprintf(text + used, n - used, "%s%s", used ? " " : "", name);
    }
}

static void add(walk *w, double value) {
    const fw_device_respond_take take = w->response->asked->take;
    w->mixed =
        w->mixed ||
        (w->found > 0 && (!w->unit != !w->beside || (w->unit && strcmp(w->unit, w->beside) != 0)));
    w->unit = w->beside;
    if (w->found++ == 0)
        w->value = value;
    else
        switch (take) {
        case FW_TAKE_ONE:
            break;
        case FW_TAKE_LARGEST:
            w->value = fmax(w->value, value);
            break;
        case FW_TAKE_LEAST:
            w->value = fmin(w->value, value);
            break;
        case FW_TAKE_SUM:
            w->value += value;
            break;
        }
}

/* a number, a truth, the word of a decision, or null */
static void take_leaf(walk *w, const json_t *node) {
    const char *text = json_string_value(node);
    if (json_is_number(node))
        add(w, json_number_value(node));
    else if (json_is_boolean(node))
        add(w, json_is_true(node) ? 1 : 0);
    else if (json_is_null(node))
        add(w, (double)NAN);
    else if (text && (strcmp(text, "accept") == 0 || strcmp(text, "reject") == 0 ||
                      strcmp(text, "inconclusive") == 0))
        add(w, strcmp(text, "accept") == 0 ? 1 : 0);
    else {
        char names[160];
        names_of(node, names, sizeof names);
        w->strange = true;
        say(w, "it leads to %s, not to a number%s%s",
            text                  ? "a text"
            : json_is_array(node) ? "a list"
                                  : "an object",
            names[0] ? "; below it are " : "", names);
    }
}

/* every word of the selector is the value of some text of the element */
static bool selected(const json_t *item, const char *selector, size_t n) {
    for (size_t at = 0; at < n;) {
        size_t end = at;
        while (end < n && selector[end] != ',')
            end++;
        size_t from = at + strspn(selector + at, " ");
        bool is = false;
        const char *key;
        json_t *value;
        if (json_is_string(item))
            is = strlen(json_string_value(item)) == end - from &&
                 memcmp(json_string_value(item), selector + from, end - from) == 0;
        json_object_foreach((json_t *)item, key, value) {
            const char *text = json_string_value(value);
            is = is || (text && strlen(text) == end - from &&
                        memcmp(text, selector + from, end - from) == 0);
        }
        if (!is) return false;
        at = end + 1;
    }
    return true;
}

/* "[stroke,draw,final]": every word that names an element, or its number where it has none */
static void selector_of(const json_t *item, size_t number, char *text, size_t n) {
    static const char *const naming[] = {"id", "name", "probe", "part", "flow", "scene", "measure"};
    size_t used = (size_t)snprintf(text, n, "[");
    for (size_t k = 0; k < sizeof naming / sizeof naming[0]; k++) {
        const char *word = json_string_value(json_object_get(item, naming[k]));
        if (word && used + strlen(word) + 3 < n)
            used += (size_t)snprintf(text + used, n - used, "%s%s", used > 1 ? "," : "", word);
    }
    if (used == 1) used += (size_t)snprintf(text + used, n - used, "%zu", number);
    snprintf(text + used, n - used, "]");
}

/* what would name this one alone, beside those that are meant as well */
static void note_one(walk *w, const json_t *item, size_t number) {
    static const char more[] = ", ...";
    char one[120];
    const size_t used = strlen(w->several), room = sizeof w->several - used;
    selector_of(item, number, one, sizeof one);
    if (strstr(w->several, one)) snprintf(one, sizeof one, "[%zu]", number); /* named alike */
    if (strlen(one) + sizeof more + 2 < room)
        snprintf(w->several + used, room, "%s%s", used > 0 ? ", " : "", one);
    else if (used > sizeof more && strcmp(w->several + used - (sizeof more - 1), more) != 0)
        snprintf(w->several + used, room, "%s", more);
}

static void go(walk *w, const json_t *node, const char *path);

static void into_list(walk *w, const json_t *node, const char *path) {
    size_t n = strcspn(path, "]") - 1, items = json_array_size(node), met = 0;
    const char *selector = path + 1, *rest = selector + n + 1;
    bool all = n == 1 && *selector == '*', number = strspn(selector, "0123456789") == n && n < 9;
    if (!json_is_array(node)) {
        say(w, "what stands before [%.*s] is no list", (int)n, selector);
        return;
    }
    const bool first = w->several[0] == '\0';
    long index = 0;
    for (size_t k = 0; number && k < n; k++)
        index = 10 * index + (selector[k] - '0');
    for (size_t i = 0; i < items; i++) {
        const json_t *item = json_array_get(node, i);
        if (!(all || (number ? (long)i == index : selected(item, selector, n)))) continue;
        if (first) note_one(w, item, i);
        met++;
        go(w, item, rest);
    }
    if (met == 0 && !all) {
        char names[200];
        names_of(node, names, sizeof names);
        say(w, "the list has no [%.*s]%s%s", (int)n, selector, names[0] ? "; it has " : "", names);
    }
}

/* the key of an object that was probably meant; NULL: none is near */
static const char *nearest(const json_t *node, const char *word) {
    const char *key, *best = NULL;
    json_t *value;
    int least = 3;
    json_object_foreach((json_t *)node, key, value) {
        const int d = fw_edit_distance(word, key, 2);
        if (d < least && (size_t)d < strlen(key)) least = d, best = key;
    }
    return best;
}

/* behind the keys of one document, the names of the others */
static void say_others(walk *w) {
    size_t at = strlen(w->why);
    const char *before = "; of other documents, with the name in front: ";
    for (int i = 0; i < fw_study_document_count; i++) {
        if (i == w->response->document) continue;
        snprintf(w->why + at, w->n - at, "%s%s:", before, fw_study_documents[i].name);
        at += strlen(w->why + at), before = " ";
    }
}

static void into_object(walk *w, const json_t *node, const char *path) {
    size_t n = strcspn(path, ".[");
    char key[80], names[220];
    snprintf(key, sizeof key, "%.*s", (int)n, path);
    const json_t *next = json_object_get(node, key);
    if (next) {
        const char *outside = w->beside, *unit = json_string_value(json_object_get(node, "unit"));
        if (unit) w->beside = unit;
        go(w, next, path + n);
        w->beside = outside;
        return;
    }
    if (json_is_null(node)) { /* what would hold it is not there: no number, and no mistake */
        add(w, (double)NAN);
        return;
    }
    names_of(node, names, sizeof names);
    const char *near = nearest(node, key);
    say(w, "there is no '%s'%s%s%s%s%s", key, FW_DID_YOU_MEAN(near),
        names[0] ? near ? " There are " : "; there are " : "", names);
    if (node == w->root) say_others(w);
}

static void go(walk *w, const json_t *node, const char *path) {
    if (*path == '.') path++;
    if (!*path)
        take_leaf(w, node);
    else if (*path == '[' && json_is_null(node))
        add(w, (double)NAN);
    else if (*path == '[')
        into_list(w, node, path);
    else
        into_object(w, node, path);
}

bool fw_study_response_of_hinges(const fw_study_response *response) {
    static const char *const key[] = {"governing.", "hinges[", "requirements[", "hinge_model[",
                                      "failure_probability"};
    bool is = false;
    if (fw_study_documents[response->document].document != FW_DOCUMENT_VERDICT_JSON) return false;
    for (size_t i = 0; i < sizeof key / sizeof key[0]; i++)
        is = is || strncmp(response->path, key[i], strlen(key[i])) == 0;
    return is;
}

bool fw_study_response_find(const fw_study_response *response, const json_t *root, double *value,
                            const char **unit, char *why, size_t n) {
    walk w = {.response = response, .root = root, .value = (double)NAN, .why = why, .n = n};
    why[0] = '\0';
    go(&w, root, response->path);
    if (w.found > 1 && response->asked->take == FW_TAKE_ONE)
        say(&w,
            "it leads to %ld numbers, of %s: name one of them, or say take=\"largest\", least or "
            "sum",
            w.found, w.several);
    *value = w.found > 0 ? w.value : (double)NAN;
    if (unit) *unit = w.mixed ? NULL : w.unit;
    return why[0] == '\0';
}

bool fw_study_draws(const fw_study *study) {
    return study->asked->kind == FW_STUDY_IS_yield || study->asked->judge == FW_JUDGE_DIE;
}
