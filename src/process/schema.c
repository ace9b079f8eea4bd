/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which elements, attributes and words a pack may hold. The same rules as processes/process.rng,
   with the place of every mistake. */
#include "process/pack.h"
#include <string.h>

typedef struct rule {
    const char *name;
    const char *attributes; /* a trailing ! means required */
    const char *children;   /* likewise: one or more */
} rule;

static const rule rules[] = {
    {"process", "id! version! title! material thickness carrier",
     "source! material equipment hazard q corner open-point step"},
    {"source", "id! kind! date", ""},
    {"material", "id! name! criterion contaminates holes", "q"},
    {"equipment", "id! class! capacity! takes", ""},
    {"hazard", "id! ghs! buddy", "ppe! firstaid! waste! incompatible attacks"},
    {"ppe", "", ""},
    {"firstaid", "", ""},
    {"waste", "stream!", ""},
    {"incompatible", "with!", ""},
    {"attacks", "material!", ""},
    {"corner", "of! name! q assumed", ""},
    {"open-point", "", ""},
    {"step", "id! op! title! equipment! in-source! mask batch second-signature attended",
     "purpose! change exposed set time! derive endpoint! accept! hazard-ref on-fail! lag"},
    {"purpose", "", ""},
    {"change",
     "kind! material! thickness where from side profile anisotropy compensate spread "
     "reach",
     ""},
    {"exposed", "material! rate selectivity", ""},
    {"set", "name! q! tol-lo! tol-hi!", ""},
    {"time", "law! overrun! k! shape", "arg needs expr"},
    {"derive", "name! unit! law! shape id most", "arg expr"},
    {"arg", "name! q!", ""},
    {"needs", "name! q!", ""},
    {"expr", "", ""},
    {"endpoint", "", ""},
    {"accept", "measure! lo! hi! unit! sites! every!", ""},
    {"hazard-ref", "ref!", ""},
    {"on-fail", "if! then! goto", ""},
    {"lag", "from! min max unit!", ""},
};
enum { RULE_COUNT = sizeof rules / sizeof rules[0] };

typedef struct words {
    const char *element, *attribute, *allowed;
} words;

static const words lists[] = {
    {"process", "carrier", "none insulating"},
    {"corner", "of", "edge taper anisotropy thickness youngs"},
    {"step", "op",
     "clean anodise displace coat bake expose develop plate deposit wet-etch dry-etch strip "
     "release "
     "mount hold inspect"},
    {"step", "in-source", "yes no"},
    {"step", "second-signature", "yes no"},
    {"hazard", "buddy", "yes no"},
    {"material", "holes", "yes no"},
    {"source", "kind", "publication datasheet handbook measured convention assumed"},
    {"change", "kind", "add remove convert pattern"},
    {"change", "where", "all structure field"},
    {"change", "side", "front back"},
    {"change", "profile", "isotropic anisotropic"},
    {"change", "compensate", "top middle bottom"},
    {"time", "shape", "slot cylinder linear"},
    {"derive", "shape", "slot cylinder linear"},
    {"on-fail", "then", "rework continue hold scrap"},
};

enum { WORDS = 24 };
/* splits a list into words; required[i] says whether word i ended with '!' */
static int split(const char *list, char word[WORDS][24], bool *required) {
    int n = 0;
    while (*list && n < WORDS) {
        size_t length = strcspn(list, " ");
        required[n] = length > 0 && list[length - 1] == '!';
        size_t bare = required[n] ? length - 1 : length;
        if (bare > 0 && bare < 24) {
            memcpy(word[n], list, bare);
            word[n++][bare] = '\0';
        }
        list += length + strspn(list + length, " ");
    }
    return n;
}

static const char *suggest(fw_arena *arena, const char *wrong, char word[WORDS][24], int n) {
    const char *names[WORDS];
    for (int i = 0; i < n; i++)
        names[i] = word[i];
    const char *best = fw_did_you_mean(wrong, names, (size_t)n);
    if (!best) return "";
    const char *text = fw_arena_printf(arena, "; did you mean '%s'?", best);
    return text ? text : "";
}

static void check_words(fw_pack *pack, const fw_element *e, const fw_attribute *a) {
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        char word[WORDS][24];
        bool required[WORDS], found = false;
        if (strcmp(lists[i].element, e->name) != 0 || strcmp(lists[i].attribute, a->name) != 0)
            continue;
        int n = split(lists[i].allowed, word, required);
        for (int j = 0; j < n; j++)
            found = found || strcmp(word[j], a->value) == 0;
        if (!found)
            fw_diag_error(pack->diags, 163, a->place, "%s='%s' is not one of: %s%s", a->name,
                          a->value, lists[i].allowed, suggest(pack->arena, a->value, word, n));
    }
}

static void check_attributes(fw_pack *pack, const fw_element *e, const rule *r) {
    char word[WORDS][24];
    bool required[WORDS];
    int n = split(r->attributes, word, required);
    for (int i = 0; i < e->nattribute; i++) {
        bool found = false;
        for (int j = 0; j < n; j++)
            found = found || strcmp(word[j], e->attribute[i].name) == 0;
        if (!found)
            fw_diag_error(pack->diags, 161, e->attribute[i].place, "<%s> has no attribute '%s'%s",
                          e->name, e->attribute[i].name,
                          suggest(pack->arena, e->attribute[i].name, word, n));
        check_words(pack, e, &e->attribute[i]);
    }
    for (int j = 0; j < n; j++)
        if (required[j] && !fw_xml_attribute(e, word[j]))
            fw_diag_error(pack->diags, 162, e->place, "<%s> needs the attribute '%s'", e->name,
                          word[j]);
}

static const rule *rule_of(const char *name) {
    for (int i = 0; i < RULE_COUNT; i++)
        if (strcmp(rules[i].name, name) == 0) return &rules[i];
    return NULL;
}

static void check_children(fw_pack *pack, const fw_element *e, const rule *r) {
    char word[WORDS][24];
    bool required[WORDS];
    int n = split(r->children, word, required);
    for (const fw_element *c = e->first_child; c; c = c->next) {
        bool found = false;
        for (int j = 0; j < n; j++)
            found = found || strcmp(word[j], c->name) == 0;
        if (!found)
            fw_diag_error(pack->diags, 160, c->place, "<%s> does not belong in <%s>%s", c->name,
                          e->name, suggest(pack->arena, c->name, word, n));
    }
    for (int j = 0; j < n; j++)
        if (required[j] && fw_pack_count(e, word[j]) == 0)
            fw_diag_error(pack->diags, 180, e->place, "<%s> needs a <%s> inside", e->name, word[j]);
}

static void check_element(fw_pack *pack, const fw_element *e) {
    const rule *r = rule_of(e->name);
    if (!r) /* <q> is read elsewhere; unknown ones were reported at their parent */
        return;
    check_attributes(pack, e, r);
    check_children(pack, e, r);
    for (const fw_element *c = e->first_child; c; c = c->next)
        check_element(pack, c); /* depth is limited by the XML reader */
}

fw_status fw_pack_check(fw_pack *pack, const fw_element *root, bool is_base) {
    if (strcmp(root->name, "process") != 0 || !root->space ||
        strcmp(root->space, "urn:flexwright:process:1") != 0)
        return fw_diag_error(pack->diags, 178, root->place,
                             "a process pack starts with <process "
                             "xmlns=\"urn:flexwright:process:1\">, not with <%s>",
                             root->name);
    check_element(pack, root);
    if (is_base && fw_pack_count(root, "step") > 0)
        fw_diag_error(pack->diags, 160, root->place,
                      "the shared pack holds no <step>; steps belong to a flow");
    if (!is_base && fw_pack_count(root, "step") == 0)
        fw_diag_error(pack->diags, 180, root->place, "a flow needs a <step>");
    return FW_OK;
}
