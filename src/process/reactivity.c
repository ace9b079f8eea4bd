/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which liquids must not meet: a table of what they react as.

   Every liquid of a pack belongs to groups (reacts-as), and a pair of groups has a consequence or none. Two liquids must
   not meet if a group of one and a group of the other have a consequence, unless one of the two holds both already: what
   is mixed in it has met. In: the groups of two hazards. Out: the consequence in words. Validity: the groups below, in
   amounts that stay on a wafer or go into a can; what a mixture does beyond its groups an <incompatible> of the pack
   says. Cost: one look at each row. Source: groups and consequences of H. K. Hatayama and others, A Method for
   Determining the Compatibility of Hazardous Wastes, EPA-600/2-80-076 (1980), chart of binary combinations, its groups 1
   to 4, 10, 11, 15, 19 and 104; ammonium salts with bases, iodine with ammonia and hypochlorite with ammonia: any
   textbook of inorganic chemistry. Test: test_lint.c liquids_react_by_their_groups. */
#include "base/text.h"
#include "process/pack.h"
#include <string.h>

static const char *const groups[] = {
    "acid",   "oxidising-acid", "organic-acid", "base",     "ammonia", "ammonium", "alcohol",
    "ketone", "oxidiser",       "hypochlorite", "fluoride", "iodine",  "cyanide",  "none",
};

/* the worst first: of two liquids with several pairs the first one is told */
static const struct {
    const char *a, *b, *what;
} rows[] = {
    {"cyanide", "acid", "hydrogen cyanide is set free"},
    {"cyanide", "oxidising-acid", "hydrogen cyanide is set free"},
    {"cyanide", "organic-acid", "hydrogen cyanide is set free"},
    {"iodine", "ammonia", "they make nitrogen triiodide, which explodes when it is dry"},
    {"oxidising-acid", "alcohol", "they may catch fire or explode"},
    {"oxidising-acid", "ketone", "they may catch fire or explode"},
    {"oxidiser", "ketone", "they make peroxides that explode"},
    {"oxidiser", "organic-acid", "they make peroxides that explode"},
    {"fluoride", "oxidising-acid", "hydrogen fluoride is set free"},
    {"hypochlorite", "acid", "chlorine is set free"},
    {"hypochlorite", "oxidising-acid", "chlorine is set free"},
    {"hypochlorite", "organic-acid", "chlorine is set free"},
    {"hypochlorite", "ammonia", "chloramines are set free"},
    {"hypochlorite", "ammonium", "chloramines are set free"},
    {"hypochlorite", "alcohol", "they may catch fire"},
    {"hypochlorite", "ketone", "they may catch fire"},
    {"oxidiser", "alcohol", "they may catch fire"},
    {"ammonium", "base", "ammonia is set free"},
    {"oxidising-acid", "organic-acid", "they heat each other and give off gas"},
    {"acid", "base", "they heat each other and spatter"},
    {"oxidising-acid", "base", "they heat each other and spatter"},
    {"organic-acid", "base", "they heat each other and spatter"},
    {"acid", "ammonia", "they heat each other and spatter"},
    {"oxidising-acid", "ammonia", "they heat each other and spatter"},
    {"acid", "ketone", "they heat each other"},
};

static bool is_group(const char *word, size_t length) {
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if (strlen(groups[i]) == length && memcmp(groups[i], word, length) == 0) return true;
    return false;
}

static bool is_in(const char *group, const char *words) {
    const size_t length = strlen(group);
    for (const char *at = words; *at; at += strspn(at, " ")) {
        const size_t n = strcspn(at, " ");
        if (n == length && memcmp(at, group, n) == 0) return true;
        at += n;
    }
    return false;
}

static bool holds_both(const fw_process_hazard *of, const char *g, const char *h) {
    return is_in(g, of->reacts_as) && is_in(h, of->reacts_as);
}

static const char *between(const fw_process_hazard *a, const fw_process_hazard *b) {
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *g = rows[i].a, *h = rows[i].b;
        if (holds_both(a, g, h) || holds_both(b, g, h)) continue;
        if ((is_in(g, a->reacts_as) && is_in(h, b->reacts_as)) ||
            (is_in(h, a->reacts_as) && is_in(g, b->reacts_as)))
            return rows[i].what;
    }
    return NULL;
}

static bool excludes(const fw_process_hazard *a, const fw_process_hazard *b) {
    for (int i = 0; i < a->nincompatible; i++)
        if (strcmp(a->incompatible[i], b->id) == 0) return true;
    return false;
}

const char *fw_process_reaction(const fw_process_hazard *a, const fw_process_hazard *b) {
    if (!a || !b) return NULL;
    const char *what = between(a, b);
    if (!what && (excludes(a, b) || excludes(b, a))) what = "the pack says so";
    return what;
}

static fw_status all_groups(fw_arena *arena, const char **text) {
    fw_text list = fw_text_new(arena);
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "", groups[i]);
    FW_TRY(fw_text_end(&list));
    *text = list.data;
    return FW_OK;
}

/* every liquid says what it reacts as, in words of the table */
fw_status fw_process_lint_reactivity(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    const char *known;
    FW_TRY(all_groups(pack->arena, &known));
    for (int i = 0; i < f->nhazard; i++) {
        const fw_process_hazard *h = &f->hazard[i];
        if (h->wets && !*h->reacts_as)
            fw_diag_error(
                pack->diags, 501, h->place,
                "hazard '%s' is a liquid and does not say what it reacts as, so that nobody "
                "knows what it must not meet; add reacts-as with some of: %s",
                h->id, known);
        for (const char *at = h->reacts_as; *at; at += strspn(at, " ")) {
            const size_t n = strcspn(at, " ");
            if (!is_group(at, n))
                fw_diag_error(
                    pack->diags, 502, h->place,
                    "hazard '%s' reacts as '%.*s', which is no group that is known; there "
                    "are: %s",
                    h->id, (int)n, at, known);
            at += n;
        }
    }
    return FW_OK;
}
