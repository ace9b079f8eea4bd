/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/summary.h"
#include <math.h>
#include <string.h>

static fw_status add(fw_report_summary *s, const char *label, const char *text) {
    FW_NEED(text);
    s->line[s->nline++] = (fw_report_summary_line){label, text};
    return FW_OK;
}

/* ---- what governs ---- */

/* "hinge C uses 65.9 % of its elastic limit (61.3 to 68.1 %) in step-load at 3.1 ms, flow F" */
static fw_status check_text(fw_arena *arena, const fw_verdict_check *c, const char **sentence) {
    fw_text text = fw_text_new(arena);
    fw_text_printf(&text, "%s uses ", c->what);
    fw_text_real(&text, "%.1f %% of ", 100 * c->used);
    fw_text_add(&text, c->of);
    if (isfinite(c->low) && isfinite(c->high)) {
        fw_text_real(&text, " (%.1f to ", 100 * c->low);
        fw_text_real(&text, "%.1f %%)", 100 * c->high);
    }
    fw_text_printf(&text, " in %s", c->scene);
    if (isfinite(c->t_s)) {
        fw_text_add(&text, " at ");
        fw_text_number(&text, c->t_s * 1e3, 4);
        fw_text_add(&text, " ms");
    }
    if (c->flow) fw_text_printf(&text, ", flow %s", c->flow);
    if (c->corner && strcmp(c->corner, "nominal") != 0)
        fw_text_printf(&text, ", with %s", c->corner);
    FW_TRY(fw_text_end(&text));
    *sentence = text.data;
    return FW_OK;
}

/* Where something else than a hinge decides, hinges are of what could be run. */
static fw_status governing(fw_arena *arena, fw_report_summary *s) {
    const char *text;
    const fw_verdict_check *worst = s->has_made ? &s->made : &s->drawn;
    bool alone = s->has_drawn && fw_verdict_is_worse(s->decision, worst->decision);
    if (!s->has_drawn) return add(s, "hinges", "none was run to the end of any scene");
    if (s->has_made) {
        FW_TRY(check_text(arena, &s->made, &text));
        FW_TRY(add(s, alone ? "hinges alone, as made" : "as made, at worst", text));
    }
    FW_TRY(check_text(arena, &s->drawn, &text));
    return add(s, alone ? "hinges alone, as drawn" : "as drawn", text);
}

/* ---- why it is not accepted, each reason once ---- */

static bool said_before(const fw_verdict *v, int variant, int reason) {
    const char *text = v->variant[variant].reason[reason].text;
    for (int i = 0; i <= variant; i++)
        for (int k = 0; k < (i < variant ? v->variant[i].nreason : reason); k++)
            if (strcmp(v->variant[i].reason[k].text, text) == 0) return true;
    return false;
}

static fw_status reasons(fw_arena *arena, const fw_verdict *v, fw_report_summary *s) {
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nreason; k++) {
            const fw_verdict_reason *r = &v->variant[i].reason[k];
            if (r->decision == FW_ACCEPT || said_before(v, i, k)) continue;
            FW_TRY(add(s, r->decision == FW_REJECT ? "rejected because" : "inconclusive because",
                       fw_arena_printf(arena, "%s [FW-D%03d]", r->text, r->number)));
        }
    return FW_OK;
}

/* ---- what to do: the least change that was run and accepted ---- */

static fw_status advice(fw_arena *arena, const fw_verdict *v, fw_report_summary *s) {
    bool searched = v->advice_note && v->advice_note != fw_verdict_not_searched;
    if (v->nproposal == 0) return searched ? add(s, "do", v->advice_note) : FW_OK;
    const fw_verdict_proposal *p = &v->proposal[0];
    fw_text text = fw_text_new(arena);
    fw_text_printf(&text, "%s:", p->text);
    for (int i = 0; i < p->nset; i++)
        fw_text_printf(&text, " --set \"%s=%s\"", p->set[i].path, p->set[i].value);
    FW_TRY(fw_text_end(&text));
    return add(s, "do", text.data);
}

/* ---- what is not guaranteed ---- */

static void number_of(fw_text *text, const fw_verdict_fabrication_input *in, double x) {
    fw_quantity q = in->q;
    q.value = x;
    fw_text_number(text, fw_quantity_in_unit(&q), 4);
}

/* ranges that are assumed, because what they are of is not known: the verdict holds there only */
static int assumed(fw_text *text, const fw_verdict_variant_verdict *v) {
    int count = 0;
    for (int i = 0; i < v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &v->input[i];
        bool pure = !in->q.unit || strcmp(in->q.unit, "1") == 0;
        if (!in->unknown) continue;
        fw_text_printf(text, "%s%s (%s) is not known, and ", count++ ? "; " : "", in->name,
                       in->unknown);
        number_of(text, in, in->low);
        fw_text_add(text, " to ");
        number_of(text, in, in->high);
        fw_text_printf(text,
                       "%s%s is assumed: measure it on the test die, then `flexwright "
                       "calibrate`",
                       pure ? "" : " ", pure ? "" : in->q.unit);
    }
    return count;
}

static fw_status guarantees(fw_arena *arena, const fw_report_input *in, fw_report_summary *s) {
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_flow *f = &in->flow[i];
        fw_text text = fw_text_new(arena);
        if (!f->variant || !f->variant->variant) continue;
        const char *flow = f->variant->variant->flow;
        int said = f->variant->fabricated ? assumed(&text, f->variant) : 0;
        bool makes = !f->flow || f->flow->manufacturable > 0;
        if (makes && said == 0) continue;
        int more = makes ? 0 : f->flow->nreason;
        if (!makes && said == 0 && more > 0) fw_text_add(&text, f->flow->reason[0]), more--;
        if (more > 0) fw_text_printf(&text, "; and %d more below", more);
        FW_TRY(fw_text_end(&text));
        const char *label =
            f->flow && f->flow->manufacturable == 0 ? "cannot be made" : "not guaranteed";
        FW_TRY(add(s, label,
                   fw_arena_printf(arena, "in %s: %s", flow ? flow : "its material",
                                   text.data ? text.data : "")));
    }
    return FW_OK;
}

fw_status fw_report_summarise(fw_arena *arena, const fw_report_input *in, fw_report_summary *s) {
    const fw_verdict *v = in->verdict;
    size_t most = 3 + (size_t)in->nflow;
    for (int i = 0; i < v->nvariant; i++)
        most += (size_t)v->variant[i].nreason;
    *s = (fw_report_summary){.decision = v->decision};
    FW_NEED(s->line = fw_arena_array(arena, fw_report_summary_line, most));
    FW_TRY(fw_verdict_governing(arena, v, false, &s->drawn, &s->has_drawn));
    FW_TRY(fw_verdict_governing(arena, v, true, &s->made, &s->has_made));
    s->has_made = s->has_made && s->made.corner;
    FW_TRY(reasons(arena, v, s));
    FW_TRY(governing(arena, s));
    FW_TRY(advice(arena, v, s));
    return v->decision == FW_REJECT ? FW_OK : guarantees(arena, in, s);
}
