/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers in the texts of a pack. A text that would repeat a value names it instead:
     {rie.break}       value and unit of the quantity, "10 min"; of a share its per cent
     {rie.break:s}     in that unit, "600 s"
     {=seed.Rs}        the number alone, for a limit whose unit stands beside it
     {=si.d*0.96}      and so many times it, for a limit that goes with the value
   What is not known is "____". So a value that changes, changes everywhere. Test: test_step_texts.c. */
#include "base/text.h"
#include "process/pack.h"
#include <string.h>

static fw_status keep(fw_process_pack *pack, const char **slot, fw_place place) {
    fw_process_flow *f = pack->flow;
    if (!*slot || !strchr(*slot, '{')) return FW_OK;
    fw_process_text *grown =
        fw_arena_grow(pack->arena, f->text, (size_t)f->ntext, (size_t)f->ntext + 1, sizeof *grown);
    FW_NEED(grown);
    f->text = grown;
    f->text[f->ntext++] = (fw_process_text){slot, *slot, place};
    return FW_OK;
}

static fw_status keep_step(fw_process_pack *pack, fw_process_step *s) {
    FW_TRY(keep(pack, &s->title, s->place));
    FW_TRY(keep(pack, &s->purpose, s->place));
    for (int i = 0; i < s->nendpoint; i++)
        FW_TRY(keep(pack, &s->endpoint[i], s->place));
    for (int i = 0; i < s->nderive; i++)
        FW_TRY(keep(pack, &s->derive[i].name, s->place));
    for (int i = 0; i < s->nfinish; i++)
        FW_TRY(keep(pack, &s->finish[i].text, s->finish[i].place));
    for (int i = 0; i < s->nsetting; i++) {
        FW_TRY(keep(pack, &s->setting[i].name, s->setting[i].place));
        FW_TRY(keep(pack, &s->setting[i].tolerance_low, s->setting[i].place));
        FW_TRY(keep(pack, &s->setting[i].tolerance_high, s->setting[i].place));
    }
    for (int i = 0; i < s->naccept; i++) {
        FW_TRY(keep(pack, &s->accept[i].measure, s->accept[i].place));
        FW_TRY(keep(pack, &s->accept[i].low, s->accept[i].place));
        FW_TRY(keep(pack, &s->accept[i].high, s->accept[i].place));
    }
    for (int i = 0; i < s->non_fail; i++) {
        FW_TRY(keep(pack, &s->on_fail[i].condition, s->place));
        FW_TRY(keep(pack, &s->on_fail[i].text, s->place));
    }
    return FW_OK;
}

fw_status fw_process_pack_texts(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        FW_TRY(keep_step(pack, &pack->flow->step[i]));
    for (int i = 0; i < pack->flow->nopen_point; i++)
        FW_TRY(keep(pack, &pack->flow->open_point[i], pack->flow->place));
    return fw_process_flow_fill_texts(pack->arena, pack->flow, pack->diags);
}

/* what stands between braces, n characters; false: not to be understood */
static bool put(fw_text *out, const fw_process_flow *f, const char *inside, size_t n) {
    bool bare = n > 0 && inside[0] == '=';
    const char *colon = memchr(inside, ':', n), *end = inside + n;
    const char *from = inside + bare, *to = colon ? colon : end;
    char id[128];
    fw_quantity_unit unit;
    if (to <= from || (size_t)(to - from) >= sizeof id) return false;
    const char *star = memchr(from, '*', (size_t)(to - from));
    double times = 1.0;
    if (star && !fw_number_parse(star + 1, (size_t)(to - star - 1), &times)) return false;
    if (star) to = star;
    memcpy(id, from, (size_t)(to - from));
    id[to - from] = '\0';
    const fw_quantity *q = fw_process_flow_quantity(f, id);
    const char *as = q ? q->unit : "";
    size_t as_n = strlen(as);
    bool share = q && q->range && strcmp(q->range, "share") == 0 && strcmp(as, "1") == 0;
    if (colon) {
        as = colon + 1;
        as_n = (size_t)(end - as);
    } else if (share && !bare) {
        as = "%";
        as_n = 1;
    }
    if (!q || !fw_quantity_unit_parse(as, as_n, &unit, NULL, NULL) ||
        !fw_quantity_dimension_equal(unit.dimension, q->dimension))
        return false;
    if (q->unknown)
        fw_text_add(out, "____");
    else
        fw_text_number(out, fw_quantity_unit_from_si(&unit, times * q->value), 4);
    if (bare || (as_n == 1 && as[0] == '1')) return true;
    fw_text_add(out, " ");
    fw_text_bytes(out, as, as_n);
    return true;
}

static fw_status fill(fw_arena *arena, const fw_process_flow *f, fw_process_text *t,
                      fw_diags *diags) {
    fw_text out = fw_text_new(arena);
    fw_text_add(&out, "");
    for (const char *c = t->raw; *c;) {
        const char *open = strchr(c, '{'), *close = open ? strchr(open, '}') : NULL;
        if (!open) {
            fw_text_add(&out, c);
            break;
        }
        fw_text_bytes(&out, c, (size_t)(open - c));
        if (!close || !put(&out, f, open + 1, (size_t)(close - open - 1)))
            return fw_diag_error(diags, 348, t->place,
                                 "'%.60s' in a text names no quantity, or a unit of another "
                                 "dimension; write {id}, {id:unit} or {=id}",
                                 open);
        c = close + 1;
    }
    FW_TRY(fw_text_end(&out));
    *t->slot = out.data;
    return FW_OK;
}

fw_status fw_process_flow_fill_texts(fw_arena *arena, fw_process_flow *flow, fw_diags *diags) {
    for (int i = 0; i < flow->ntext; i++) {
        fw_status status = fill(arena, flow, &flow->text[i], diags);
        if (status != FW_OK && status != FW_INPUT) return status;
    }
    return FW_OK;
}
