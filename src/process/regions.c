/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Regions of the wafer: what plates print parts it into. The device's plate parts structure from field; each <plate>
   besides names what is inside of what it prints, and what is outside ("cavity", "bond"). A column of the layer stack is one
   of the combinations: bit 0 of its code says field, bit p inside of plate p. Test: test_regions.c. */
#include "process/films.h"
#include "process/pack.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

int fw_process_flow_columns(const fw_process_flow *flow) {
    return flow->ncolumn ? flow->ncolumn : 2;
}

static unsigned code_of(const fw_process_flow *flow, int column) {
    return flow->ncolumn ? flow->column_code[column] : (unsigned)column;
}

bool fw_process_where_side(const fw_process_flow *flow, const char *where, fw_process_side *side) {
    *side = (fw_process_side){0, strcmp(where, "field") == 0};
    if (strcmp(where, "structure") == 0 || side->set) return true;
    for (int p = 0; p < flow->nplate; p++) {
        *side = (fw_process_side){p + 1, strcmp(where, flow->plate[p].inside) == 0};
        if (side->set || strcmp(where, flow->plate[p].outside) == 0) return true;
    }
    return false;
}

bool fw_process_side_holds(const fw_process_flow *flow, fw_process_side side, int column) {
    return (code_of(flow, column) >> side.plate & 1u) == (side.set ? 1u : 0u);
}

bool fw_process_where_holds(const fw_process_flow *flow, const char *where, int column) {
    fw_process_side side;
    return strcmp(where, "all") == 0 ||
           (fw_process_where_side(flow, where, &side) && fw_process_side_holds(flow, side, column));
}

bool fw_process_where_is_of_device(const fw_process_flow *flow, const char *where) {
    fw_process_side side;
    return !fw_process_where_side(flow, where, &side) || side.plate == 0;
}

/* do two columns lie beside each other: does one plate alone part them? */
bool fw_process_columns_meet(const fw_process_flow *flow, int a, int b) {
    unsigned other = code_of(flow, a) ^ code_of(flow, b);
    return other && !(other & (other - 1u));
}

bool fw_process_columns_edge(const fw_process_flow *flow, const bool in[], int plate) {
    int n = fw_process_flow_columns(flow);
    for (int a = 0; a < n; a++)
        for (int b = 0; in[a] && b < n; b++)
            if ((code_of(flow, a) ^ code_of(flow, b)) == 1u << plate) return true;
    return false;
}

const char *fw_process_column_name(const fw_process_flow *flow, int column, char name[FW_LABEL]) {
    unsigned code = code_of(flow, column);
    int n = snprintf(name, FW_LABEL, "%s", code & 1u ? "field" : "structure");
    for (int p = 0; p < flow->nplate && n < FW_LABEL; p++)
        n += snprintf(name + n, (size_t)(FW_LABEL - n), ", %s",
                      code >> (p + 1) & 1u ? flow->plate[p].inside : flow->plate[p].outside);
    return name;
}

/* words of `within` that a code satisfies */
static bool lies_within(const fw_process_flow *flow, const char *within, unsigned code) {
    char word[64];
    for (const char *s = within; *s;) {
        size_t n = strcspn(s, " ");
        fw_process_side side;
        snprintf(word, sizeof word, "%.*s", (int)n, s);
        if (n > 0 && n < sizeof word && fw_process_where_side(flow, word, &side) &&
            (code >> side.plate & 1u) != (side.set ? 1u : 0u))
            return false;
        s += n + strspn(s + n, " ");
    }
    return true;
}

static bool is_word(const fw_process_flow *flow, const char *word) {
    fw_process_side side;
    return strcmp(word, "all") == 0 || fw_process_where_side(flow, word, &side);
}

void fw_process_read_plates(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "plate")) continue;
        fw_process_plate p = {.id = fw_process_pack_text(e, "id"),
                              .inside = fw_process_pack_text(e, "inside"),
                              .outside = fw_process_pack_text(e, "outside"),
                              .within = fw_process_pack_text(e, "within"),
                              .shrink = fw_process_pack_quantity(pack, e, "shrink"),
                              .place = e->element->place};
        if (is_word(f, p.inside) || is_word(f, p.outside) || strcmp(p.inside, p.outside) == 0)
            fw_diag_error(pack->diags, 413, p.place,
                          "plate \"%s\" calls its parts \"%s\" and \"%s\", but these words already "
                          "name parts of the wafer; choose others",
                          p.id, p.inside, p.outside);
        if (f->nplate == FW_PROCESS_PLATES)
            fw_diag_error(pack->diags, 413, p.place,
                          "a flow prints at most %d plates besides the device's",
                          FW_PROCESS_PLATES);
        else
            f->plate[f->nplate++] = p;
    }
    for (unsigned code = 0; code < 2u << f->nplate; code++) {
        bool there = true;
        for (int p = 0; p < f->nplate; p++)
            if (code >> (p + 1) & 1u) there = there && lies_within(f, f->plate[p].within, code);
        if (there) f->column_code[f->ncolumn++] = code;
    }
}

static void check_word(fw_process_pack *pack, const char *where, fw_place place) {
    const fw_process_flow *f = pack->flow;
    if (is_word(f, where)) return;
    fw_text known = fw_text_new(pack->arena);
    for (int p = 0; p < f->nplate; p++)
        fw_text_printf(&known, " %s %s", f->plate[p].inside, f->plate[p].outside);
    fw_diag_error(pack->diags, 413, place,
                  "where=\"%s\" is no part of the wafer; there are: all structure field%s", where,
                  fw_text_end(&known) == FW_OK ? known.data : "");
}

void fw_process_check_regions(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++) {
        for (int k = 0; k < f->step[i].nchange; k++)
            check_word(pack, f->step[i].change[k].where, f->step[i].change[k].place);
        for (int k = 0; k < f->step[i].nrequired; k++)
            if (f->step[i].required[k].material)
                check_word(pack, f->step[i].required[k].where, f->step[i].required[k].place);
    }
    for (int i = 0; i < f->nfinished; i++)
        check_word(pack, f->finished[i].where, f->finished[i].place);
}

const fw_quantity *fw_process_flow_hollow(const fw_process_flow *flow, const char *plate,
                                          const fw_process_step **at) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            fw_process_side side;
            if (!c->isotropic || !fw_process_where_side(flow, c->where, &side) || !side.plate ||
                !side.set || strcmp(flow->plate[side.plate - 1].id, plate) != 0)
                continue;
            if (at) *at = &flow->step[i];
            return c->thickness;
        }
    return NULL;
}

/* u = d (1 + overrun): what an isotropic etch of the depth d takes from every edge. In: the pack as it stands, a
   laboratory's values in it. Test: test_regions.c. */
fw_status fw_process_lint_shrink(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int p = 0; p < f->nplate; p++) {
        const fw_process_step *step = NULL;
        const fw_quantity *depth = fw_process_flow_hollow(f, f->plate[p].id, &step),
                          *shrink = f->plate[p].shrink;
        if ((!depth && !shrink) || (depth && depth->unknown) || (shrink && shrink->unknown))
            continue;
        double takes = depth ? depth->value * (1.0 + step->overrun) : 0.0,
               drawn = shrink ? shrink->value : 0.0;
        char a[32], b[32];
        if (fabs(takes - drawn) <= 1e-9 * fmax(takes, drawn)) continue;
        fw_diag_error(
            pack->diags, 420, f->plate[p].place,
            "plate \"%s\" is drawn smaller by %s um (shrink), but %s takes %s um from every edge; "
            "they must be equal: give it shrink=\"...\" of a quantity that is",
            f->plate[p].id, fw_number_text(b, sizeof b, drawn * 1e6, 4),
            step ? fw_arena_printf(pack->arena, "step %s", step->id) : "no isotropic etch",
            fw_number_text(a, sizeof a, takes * 1e6, 4));
    }
    return FW_OK;
}
