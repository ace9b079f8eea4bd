/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/table.h"
#include "mask/content.h"
#include "mask/order.h"
#include "quantity/expression.h"
#include <stdlib.h>
#include <string.h>

static const char name_space[] = "urn:flexwright:masks:1";

typedef struct role_name {
    const char *name;
    fw_role role;
} role_name;
static const role_name roles[] = {
    {"structure", FW_ROLE_STRUCTURE}, {"flexure", FW_ROLE_FLEXURE}, {"frame", FW_ROLE_FRAME},
    {"tether", FW_ROLE_TETHER},       {"text", FW_ROLE_TEXT},       {"mark", FW_ROLE_MARK},
    {"dicing", FW_ROLE_DICING},       {"back", FW_ROLE_BACK},
};
enum { NROLE = sizeof roles / sizeof roles[0] };

typedef struct reader {
    fw_arena *arena;
    fw_diags *diags;
    fw_mask_layer *layer; /* being read */
} reader;

/* ---- one function per kind of value; mistakes are collected and reading goes on ---- */
void fw_table_text(fw_diags *diags, const fw_attribute *a, const char **out) {
    size_t n = strlen(a->value);
    for (size_t i = 0; i < n; i++)
        if ((unsigned char)a->value[i] < 0x20 || (unsigned char)a->value[i] > 0x7e) {
            fw_diag_error(diags, 141, a->place,
                          "%s=\"%s\" is not plain ASCII, which some mask readers refuse; write it "
                          "without other characters",
                          a->name, a->value);
            return;
        }
    if (n == 0 || n > 400)
        fw_diag_error(diags, 141, a->place, "%s has %zu characters; give 1 to 400", a->name, n);
    else
        *out = a->value;
}

static bool is_identifier(const char *s) {
    size_t n = strlen(s);
    if (n == 0 || n > 32) return false;
    return strspn(s, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-") == n;
}

static void read_identifier(reader *r, const fw_attribute *a, const char **out) {
    if (is_identifier(a->value))
        *out = a->value;
    else
        fw_diag_error(r->diags, 141, a->place,
                      "%s=\"%s\" is not a name: use 1 to 32 of A-Z a-z 0-9 _ -", a->name, a->value);
}

static void read_gds(reader *r, const fw_attribute *a) {
    const char *s = a->value;
    char *end;
    long layer = strtol(s, &end, 10), datatype = -1;
    bool ok = s[0] >= '0' && s[0] <= '9' && *end == '/' && end[1] >= '0' && end[1] <= '9';
    if (ok) {
        datatype = strtol(end + 1, &end, 10);
        ok = *end == '\0' && layer >= 1 && layer <= 63 && datatype >= 0 && datatype <= 63;
    }
    if (!ok) {
        fw_diag_error(r->diags, 141, a->place,
                      "gds=\"%s\" is not LAYER/DATATYPE with layer 1 to 63 and data type 0 to 63 "
                      "(the range that every mask shop reads); write for example \"1/0\"",
                      s);
        return;
    }
    r->layer->layer = (int)layer;
    r->layer->datatype = (int)datatype;
}

static void read_tone(reader *r, const fw_attribute *a) {
    if (strcmp(a->value, "data clear") == 0 || strcmp(a->value, "data dark") == 0)
        r->layer->tone = a->value;
    else
        fw_diag_error(r->diags, 141, a->place,
                      "tone=\"%s\" is ambiguous; say \"data clear\" or \"data dark\"", a->value);
}

static void read_colour(reader *r, const fw_attribute *a) {
    if (strlen(a->value) == 7 && a->value[0] == '#' &&
        strspn(a->value + 1, "0123456789abcdefABCDEF") == 6)
        r->layer->colour = a->value;
    else
        fw_diag_error(r->diags, 141, a->place, "colour=\"%s\" is not #rrggbb, e.g. \"#3d6aa8\"",
                      a->value);
}

static void read_yes(reader *r, const fw_attribute *a, bool *out) {
    *out = strcmp(a->value, "yes") == 0;
    if (!*out && strcmp(a->value, "no") != 0)
        fw_diag_error(r->diags, 141, a->place, "%s=\"%s\" must be \"yes\" or \"no\"", a->name,
                      a->value);
}

static void read_roles(reader *r, const fw_attribute *a) {
    for (const char *s = a->value; *s;) {
        s += strspn(s, " \t\r\n");
        size_t n = strcspn(s, " \t\r\n");
        int k = 0;
        while (k < NROLE && !(strlen(roles[k].name) == n && memcmp(roles[k].name, s, n) == 0))
            k++;
        if (n > 0 && k == NROLE)
            fw_diag_error(r->diags, 141, a->place,
                          "role \"%.*s\" is unknown; roles are structure flexure frame tether text "
                          "mark dicing back",
                          (int)(n > 40 ? 40 : n), s);
        else if (n > 0)
            r->layer->roles |= 1u << roles[k].role;
        s += n;
    }
}

static fw_status read_length(reader *r, const fw_attribute *a, double *out) {
    fw_expression_error error = {0};
    fw_names none = {0};
    fw_dimension length = {.m = 1};
    double value = 0;
    fw_status status =
        fw_expression_evaluate(r->arena, a->value, strlen(a->value), &none, length, &value, &error);
    if (status == FW_NOMEM) return status;
    if (status != FW_OK) {
        fw_place place = a->place;
        if (a->exact) place.column += (int)error.offset;
        fw_diag_error(r->diags, error.number, place, "%s", error.message);
        return FW_OK;
    }
    if (!(value >= 0 && value <= 1e-2)) {
        char number[64];
        fw_diag_error(r->diags, 141, a->place, "%s is %s um; a design rule is between 0 and 10 mm",
                      a->name, fw_number_text(number, sizeof number, value * 1e6, 6));
        return FW_OK;
    }
    *out = value;
    return FW_OK;
}

static const char *const attributes[] = {"gds",    "id",        "name",      "purpose",
                                         "tone",   "colour",    "roles",     "biased",
                                         "source", "min-width", "min-space", "documentation"};

static fw_status read_attribute(reader *r, const fw_attribute *a) {
    fw_mask_layer *l = r->layer;
    const char *n = a->name;
    if (strcmp(n, "gds") == 0)
        read_gds(r, a);
    else if (strcmp(n, "id") == 0)
        read_identifier(r, a, &l->id);
    else if (strcmp(n, "name") == 0)
        read_identifier(r, a, &l->name);
    else if (strcmp(n, "purpose") == 0)
        fw_table_text(r->diags, a, &l->purpose);
    else if (strcmp(n, "tone") == 0)
        read_tone(r, a);
    else if (strcmp(n, "colour") == 0)
        read_colour(r, a);
    else if (strcmp(n, "roles") == 0)
        read_roles(r, a);
    else if (strcmp(n, "biased") == 0)
        read_yes(r, a, &l->biased);
    else if (strcmp(n, "documentation") == 0)
        read_yes(r, a, &l->documentation);
    else if (strcmp(n, "source") == 0)
        fw_table_text(r->diags, a, &l->rule_source);
    else if (strcmp(n, "min-width") == 0)
        return read_length(r, a, &l->min_width_m);
    else if (strcmp(n, "min-space") == 0)
        return read_length(r, a, &l->min_space_m);
    else {
        const char *meant =
            fw_did_you_mean(n, attributes, sizeof attributes / sizeof attributes[0]);
        fw_diag_error(r->diags, 140, a->place, "<layer> has no attribute \"%s\"%s%s%s", n,
                      meant ? "; did you mean \"" : "", meant ? meant : "", meant ? "\"?" : "");
    }
    return FW_OK;
}

static fw_status read_layer(reader *r, const fw_element *e) {
    r->layer->place = e->place;
    for (int i = 0; i < e->nattribute; i++)
        FW_TRY(read_attribute(r, &e->attribute[i]));
    static const char *const required[] = {"gds", "id", "name", "purpose", "tone", "colour"};
    for (size_t i = 0; i < sizeof required / sizeof required[0]; i++)
        if (!fw_xml_attribute(e, required[i]))
            fw_diag_error(r->diags, 140, e->place, "<layer> lacks the attribute \"%s\"",
                          required[i]);
    bool rule = r->layer->min_width_m > 0 || r->layer->min_space_m > 0;
    if (rule && !fw_xml_attribute(e, "source"))
        fw_diag_error(r->diags, 140, e->place,
                      "<layer> has a design rule without its reason; add source=\"...\"");
    if (r->layer->documentation && r->layer->roles)
        fw_diag_error(r->diags, 141, e->place,
                      "a documentation layer is never exposed, so no role may be drawn on it; "
                      "remove roles or documentation");
    if (e->first_child)
        fw_diag_error(r->diags, 140, e->first_child->place, "<layer> has no child elements");
    return FW_OK;
}

static void check_plate(const fw_mask_table *table, const fw_element *root, fw_diags *diags) {
    int first;
    const char *wrong;
    if (fw_plate_layers(table, NULL, &first, &wrong)) return;
    fw_diag_error(diags, 133, fw_xml_attribute(root, "plate")->place,
                  "plate=\"%s\" cannot be read at \"%s\"; write layers of this table with AND, OR, "
                  "NOT or XOR between, for example \"1/0 NOT 2/0\"",
                  table->plate, wrong);
}

/* same id, same GDSII pair, a role on two layers, two documentation layers */
static void check_collisions(const fw_mask_table *table, fw_diags *diags) {
    for (int j = 1; j < table->nlayer; j++)
        for (int i = 0; i < j; i++) {
            const fw_mask_layer *a = &table->layer[i], *b = &table->layer[j];
            if (a->id && b->id && strcmp(a->id, b->id) == 0)
                fw_diag_error(diags, 142, b->place,
                              "layer id \"%s\" is used twice, first in line %d", b->id,
                              a->place.line);
            if (a->layer > 0 && a->layer == b->layer && a->datatype == b->datatype)
                fw_diag_error(diags, 142, b->place,
                              "layer %d/%d is used twice, first in line %d; choose a free number",
                              b->layer, b->datatype, a->place.line);
            for (int k = 0; k < NROLE; k++)
                if (a->roles & b->roles & 1u << roles[k].role)
                    fw_diag_error(diags, 142, b->place,
                                  "role \"%s\" is drawn on two layers, first in line %d; keep one",
                                  roles[k].name, a->place.line);
            if (a->documentation && b->documentation)
                fw_diag_error(diags, 142, b->place,
                              "two documentation layers, first in line %d; keep one",
                              a->place.line);
        }
}

static void read_root(reader *r, const fw_element *root, fw_mask_table *table) {
    for (int i = 0; i < root->nattribute; i++) {
        const fw_attribute *a = &root->attribute[i];
        if (strcmp(a->name, "flow") == 0)
            read_identifier(r, a, &table->flow);
        else if (strcmp(a->name, "reading") == 0)
            fw_table_text(r->diags, a, &table->reading);
        else if (strcmp(a->name, "order") == 0)
            fw_table_text(r->diags, a, &table->order);
        else if (strcmp(a->name, "plate") == 0)
            fw_table_text(r->diags, a, &table->plate);
        else
            fw_diag_error(r->diags, 140, a->place, "<mask-table> has no attribute \"%s\"", a->name);
    }
    if (!fw_xml_attribute(root, "flow"))
        fw_diag_error(r->diags, 140, root->place, "<mask-table> lacks the attribute \"flow\"");
    if (!fw_xml_attribute(root, "reading"))
        fw_diag_error(r->diags, 140, root->place,
                      "<mask-table> lacks the attribute \"reading\", e.g. \"right-reading chrome "
                      "down\"");
}

fw_status fw_mask_table_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                             fw_diags *diags, fw_mask_table *table) {
    *table = (fw_mask_table){0};
    size_t errors = diags->errors;
    fw_element *root = NULL;
    fw_status status = fw_xml_read(arena, file, xml, n, diags, &root);
    if (status != FW_OK || !root) return status != FW_OK ? status : FW_INPUT;
    if (strcmp(root->name, "mask-table") != 0 || !root->space ||
        strcmp(root->space, name_space) != 0)
        return fw_diag_error(diags, 140, root->place,
                             "the file must hold <mask-table xmlns=\"%s\">, not <%s>", name_space,
                             root->name);
    reader r = {arena, diags, NULL};
    read_root(&r, root, table);
    size_t count = 0;
    for (const fw_element *e = root->first_child; e; e = e->next)
        count++;
    FW_NEED(table->layer = fw_arena_array(arena, fw_mask_layer, count));
    FW_TRY(fw_mask_table_content(arena, root, diags, table));
    for (const fw_element *e = root->first_child; e; e = e->next) {
        if (strcmp(e->name, "rule") == 0) continue; /* when all layers are known */
        if (strcmp(e->name, "pattern") == 0) continue;
        if (strcmp(e->name, "layer") != 0) {
            fw_diag_error(diags, 140, e->place,
                          "<mask-table> holds only <layer>, <rule> and <pattern>, not <%s>",
                          e->name);
            continue;
        }
        r.layer = &table->layer[table->nlayer++];
        FW_TRY(read_layer(&r, e));
    }
    if (table->nlayer == 0) fw_diag_error(diags, 140, root->place, "<mask-table> has no <layer>");
    check_collisions(table, diags);
    check_plate(table, root, diags);
    FW_TRY(fw_table_rules(arena, root, diags, table));
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}
