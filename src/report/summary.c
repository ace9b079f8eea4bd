/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report_page.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

static fw_status add(fw_report_summary *s, const char *label, const char *text) {
    FW_NEED(text);
    s->line[s->nline++] = (fw_report_summary_line){label, text};
    return FW_OK;
}

/* ---- what governs ---- */

/* "hinge C uses 65.9 % of its elastic limit (61.3 to 68.1 %; no corner of the flow is above 71.0 %)" */
static void use_of(fw_text *text, const fw_verdict_check *c) {
    fw_text_printf(text, "%s uses ", c->what);
    fw_text_real(text, "%.1f %% of ", 100 * c->used);
    fw_text_add(text, c->of);
    if (!isfinite(c->low) || !isfinite(c->high)) return;
    fw_text_real(text, " (%.1f to ", 100 * c->low);
    fw_text_real(text, "%.1f %%", 100 * c->high);
    if (!isfinite(c->most) && !isnan(c->most))
        fw_text_add(text, "; of what the flow makes between its corners that is not known");
    else if (c->most > c->high)
        fw_text_real(text, "; no corner of the flow is above %.1f %%", 100 * c->most);
    fw_text_add(text, ")");
}

/* "... in step-load at 3.1 ms, flow F, with thickness 49 um" */
static fw_status check_text(fw_arena *arena, const fw_verdict_check *c, const char **sentence) {
    fw_text text = fw_text_new(arena);
    if (c->requirement)
        fw_text_add(&text, c->of);
    else
        use_of(&text, c);
    fw_text_printf(&text, c->requirement && !c->requirement->scene ? ", %s" : " in %s", c->scene);
    if (isfinite(c->t_s) && !c->requirement) {
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

static bool has_reason(const fw_verdict *v, fw_verdict_decision decision) {
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nreason; k++)
            if (v->variant[i].reason[k].decision == decision) return true;
    return false;
}

/* less than is told of it, whichever end of its band is taken */
static bool bears_nothing(const fw_verdict_check *c) {
    return c->decision == FW_ACCEPT && c->used < 5e-4 && c->high < 5e-4;
}

/* A hinge that bears nothing is no news where a requirement governs. Where something else than a hinge decides, hinges are of
   what could be run. One that is rejected as
   drawn, beside other reasons, is one of them; as made it stands among them already (FW-D237). */
static fw_status hinges(fw_arena *arena, const fw_verdict *v, fw_report_summary *s) {
    const char *text;
    const bool also = s->drawn.decision == FW_REJECT && has_reason(v, FW_REJECT);
    const fw_verdict_check *worst = s->has_made ? &s->made : &s->drawn;
    bool alone = s->has_drawn && fw_verdict_is_worse(s->decision, worst->decision);
    if (!s->has_drawn) return add(s, "hinges", "none was run to the end of any scene");
    if (s->governing.requirement && bears_nothing(worst) && bears_nothing(&s->drawn)) return FW_OK;
    if (s->has_made) {
        FW_TRY(check_text(arena, &s->made, &text));
        FW_TRY(add(s, alone ? "hinges alone, as made" : "as made, at the worst corner run", text));
    }
    FW_TRY(check_text(arena, &s->drawn, &text));
    return add(s,
               alone  ? "hinges alone, as drawn"
               : also ? "and because, as drawn"
                      : "as drawn",
               text);
}

/* the requirement that is nearest to its bound; one that speaks against the device is among the
   reasons already. Where it governs, no hinge uses as much of its limit */
static fw_status required(fw_arena *arena, const fw_verdict *v, fw_report_summary *s) {
    fw_verdict_check tightest;
    const char *text;
    bool found;
    FW_TRY(fw_verdict_governing(arena, v, FW_CHECK_REQUIREMENTS, true, &tightest, &found));
    if (!found || tightest.decision != FW_ACCEPT) return FW_OK;
    FW_TRY(check_text(arena, &tightest, &text));
    if (s->governing.requirement && s->has_drawn && isfinite(tightest.used)) {
        char used[32];
        fw_number_text(used, sizeof used, 100 * tightest.used, 3);
        FW_NEED(text = fw_arena_printf(arena, "%s; it governs: %s %% of its bound is used", text,
                                       used));
    }
    return add(s, tightest.corner ? "required, as made" : "required, as drawn", text);
}

/* of the way until they meet: what takes less is in the tables alone */
static const double fw_told_share = 0.5;

/* "; link stage and stator of comb drive upper take 54 % of the way until they meet": of another pair than the nearest, or of another
   scene; "": none takes a share that counts */
static const char *way_text(fw_arena *arena, const fw_verdict *v,
                            const fw_verdict_clearance *least) {
    const fw_verdict_clearance *most = NULL;
    char share[32];
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nclearance; k++) {
            const fw_verdict_clearance *c = &v->variant[i].clearance[k];
            if (c->way.a && (!most || c->way.share > most->way.share)) most = c;
        }
    if (!most || most->way.share <= fw_told_share) return "";
    const fw_clearance_least *l = &most->least;
    if (most == least && l->start_m - l->m > fw_told_share * l->start_m) return "";
    return fw_arena_printf(arena, "; %s and %s take %s %% of the way until they %s%s%s",
                           most->way.a, most->way.b,
                           fw_number_text(share, sizeof share, 100 * most->way.share, 3),
                           most->required_m > 0 ? "have just what is asked for" : "meet",
                           most == least ? "" : " in ", most == least ? "" : most->scene);
}

/* "A and B 3.2 um (2.8 to 3.6) in close", behind one of the same pair and scene "3.2 um (2.8 to 3.6)" */
static const char *near_text(fw_arena *arena, const fw_verdict_clearance *c,
                             const fw_verdict_clearance *behind) {
    char m[32], low[32], high[32];
    const fw_clearance_meet *at = &c->least.at, *of = behind ? &behind->least.at : NULL;
    const bool same = of && strcmp(at->a, of->a) == 0 && strcmp(at->b, of->b) == 0 &&
                      strcmp(c->scene, behind->scene) == 0;
    const char *text =
        fw_arena_printf(arena, "%s um (%s to %s)", fw_number_text(m, sizeof m, 1e6 * c->m, 3),
                        fw_number_text(low, sizeof low, 1e6 * c->low_m, 3),
                        fw_number_text(high, sizeof high, 1e6 * c->high_m, 3));
    if (!text || same) return text;
    return fw_arena_printf(arena, "%s and %s %s in %s", at->a, at->b, text, c->scene);
}

/* of all corners that were run, the one of which the least is surely left; NULL: none was looked for */
static const fw_verdict_fabricated_corner *nearest_corner(const fw_verdict *v) {
    const fw_verdict_fabricated_corner *least = NULL;
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_fabricated_verdict *f = v->variant[i].fabricated;
        for (int k = 0; f && k < f->ncorner; k++) {
            const fw_verdict_fabricated_corner *c = &f->corner[k];
            if (c->clearance && (!least || c->clearance->low_m < least->clearance->low_m))
                least = c;
        }
    }
    return least;
}

/* The least of all scenes and required poses; what meets, or is not known, is among the reasons already. Where corners
   were run and clearances count, the less of drawn and made comes first, and the other behind it. */
static fw_status nearest(fw_arena *arena, const fw_verdict *v, fw_report_summary *s) {
    const fw_verdict_clearance *least = NULL;
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nclearance; k++) {
            const fw_verdict_clearance *c = &v->variant[i].clearance[k];
            if (!least || c->low_m < least->low_m) least = c;
        }
    if (!least || least->least.m <= 0 || !isfinite(least->low_m)) return FW_OK;
    const char *way = way_text(arena, v, least);
    FW_NEED(way);
    const fw_verdict_fabricated_corner *corner = nearest_corner(v);
    if (!corner || corner->clearance->least.m <= 0 || !isfinite(corner->clearance->low_m))
        return add(s, s->has_made ? "nearest, as drawn" : "nearest",
                   fw_arena_printf(arena, "%s%s", near_text(arena, least, NULL), way));
    const bool less = corner->clearance->low_m < least->low_m;
    const char *made = near_text(arena, corner->clearance, less ? NULL : least),
               *drawn = near_text(arena, least, less ? corner->clearance : NULL);
    FW_NEED(made && drawn ? made : NULL);
    const bool nominal = !corner->what || strcmp(corner->what, "nominal") == 0;
    const char *at = nominal ? "" : fw_arena_printf(arena, ", with %s", corner->what);
    FW_NEED(at);
    if (less)
        return add(s, "nearest, as made at the corners run",
                   fw_arena_printf(arena, "%s%s; as drawn %s%s", made, at, drawn, way));
    return add(
        s, "nearest, as drawn",
        fw_arena_printf(arena, "%s%s; as made at the corners run %s%s", drawn, way, made, at));
}

/* ---- why it is not accepted, each reason once ---- */

static fw_status reasons_of(fw_arena *arena, const fw_verdict *v, fw_verdict_decision decision,
                            const char *label, fw_report_summary *s) {
    const char *words;
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nreason; k++) {
            if (v->variant[i].reason[k].decision != decision) continue;
            FW_TRY(fw_verdict_reason_words(arena, v, i, k, &words));
            if (words) FW_TRY(add(s, label, words));
        }
    return FW_OK;
}

static fw_status undecided(fw_arena *arena, const fw_verdict *v, fw_report_summary *s) {
    return reasons_of(arena, v, FW_INCONCLUSIVE, "inconclusive because", s);
}

/* ---- what to do: the least change that was run and accepted ---- */

enum { FEW_SETTINGS = 3 }; /* more are told where all proposals are */

/* the least change that gives up nothing of what is asked for, where there is one */
static const fw_verdict_proposal *first_of(const fw_verdict *v) {
    for (int i = 0; i < v->nproposal; i++)
        if (v->proposal[i].kind != FW_PROPOSE_LOADS) return &v->proposal[i];
    return &v->proposal[0];
}

/* what is wrong with a drawing says itself what to do */
static fw_status advice(fw_arena *arena, const fw_verdict *v, bool fault, fw_report_summary *s) {
    bool searched = v->advice_note && v->advice_note != fw_verdict_not_searched && !fault;
    if (v->nproposal == 0) return searched ? add(s, "do", v->advice_note) : FW_OK;
    const fw_verdict_proposal *p = first_of(v);
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, p->text);
    if (p->nset <= FEW_SETTINGS) fw_text_add(&text, ":");
    for (int i = 0; p->nset <= FEW_SETTINGS && i < p->nset; i++)
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
        if (!in->unknown || in->open) continue; /* what nobody assumes is among the reasons */
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

static const char *flow_of(const fw_report_flow *f) {
    const char *flow = f->variant->variant->flow;
    return flow ? flow : "its material";
}

/* a flow says no to what hinges bear: the reason that says so, and how many more there are */
static fw_status unmade(fw_arena *arena, const fw_report_input *in, fw_report_summary *s) {
    fw_text list = fw_text_new(arena);
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_flow *f = &in->flow[i];
        if (!f->variant || !f->variant->variant || !f->flow || f->flow->manufacturable != 0)
            continue;
        const char *why = f->flow->fails;
        if (!why) why = f->flow->nreason > 0 ? f->flow->reason[0] : "";
        const char *more = f->flow->nreason > 1
                               ? fw_arena_printf(arena, "; and %d more below", f->flow->nreason - 1)
                               : "";
        FW_NEED(more);
        fw_text_printf(&list, "%s%s", list.length ? ", " : "", flow_of(f));
        FW_TRY(
            add(s, "cannot be made", fw_arena_printf(arena, "in %s: %s%s", flow_of(f), why, more)));
    }
    FW_TRY(fw_text_end(&list));
    if (list.length) s->unmade = list.data;
    return FW_OK;
}

/* dies of a sweep are devices of their own, with verdicts of their own */
static fw_status other_dies(fw_arena *arena, const fw_report_input *in, fw_report_summary *s) {
    fw_text list = fw_text_new(arena);
    for (int i = 0; i < in->nflow; i++) {
        if (!in->flow[i].dies) continue;
        fw_text_printf(&list, "%s%s", list.length ? ", " : "", in->flow[i].dies_count);
        FW_TRY(add(s, "dies", in->flow[i].dies));
    }
    FW_TRY(fw_text_end(&list));
    if (list.length) s->dies = list.data;
    return FW_OK;
}

/* First what already the values assumed say no to; then what they are; then how much more there is. */
static fw_status guarantees(fw_arena *arena, const fw_report_input *in, fw_report_summary *s) {
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_flow *f = &in->flow[i];
        fw_text text = fw_text_new(arena), ranges = fw_text_new(arena);
        if (!f->variant || !f->variant->variant) continue;
        const bool known = f->variant->fabricated && assumed(&ranges, f->variant) > 0;
        const bool open = f->flow && f->flow->manufacturable < 0;
        const char *first = open ? f->flow->fails : NULL;
        if (!open && !known) continue;
        if (open && !first && !known && f->flow->nreason > 0) first = f->flow->reason[0];
        FW_TRY(fw_text_end(&ranges));
        if (first) fw_text_add(&text, first);
        if (known) fw_text_printf(&text, "%s%s", first ? "; " : "", ranges.data);
        const int more = open ? f->flow->nreason - (first != NULL) : 0;
        if (more > 0) fw_text_printf(&text, "; and %d more below", more);
        FW_TRY(fw_text_end(&text));
        FW_TRY(add(s, "not guaranteed",
                   fw_arena_printf(arena, "in %s: %s", flow_of(f), text.data ? text.data : "")));
    }
    return FW_OK;
}

/* once for all flows: the layout is the same */
static fw_status layout_faults(fw_arena *arena, const fw_layout *layout, fw_report_summary *s) {
    if (!layout || layout->nfault == 0) return FW_OK;
    const fw_layout_fault *f = &layout->fault[0];
    const char *text = fw_arena_printf(arena, "%s [FW-D%03d]", f->message, f->number);
    FW_NEED(text);
    if (layout->nfault > 1)
        text = fw_arena_printf(arena, "%s; and %d more, marked in the drawing", text,
                               layout->nfault - 1);
    return add(s, "cannot be made", text);
}

/* beside what is not guaranteed: what the verdict takes for granted, and the chip does not have */
static fw_status outside(fw_arena *arena, const fw_report_input *in, fw_report_summary *s) {
    if (in->noutside == 0) return FW_OK;
    const fw_verdict_from_outside *first = &in->outside[0];
    const char *more =
        in->noutside > 1 ? fw_arena_printf(arena, "; and %d more", in->noutside - 1) : "";
    FW_NEED(more);
    return add(s, "from outside",
               fw_arena_printf(arena, "%s [FW-D%03d]%s", first->text, first->number, more));
}

/* what a scene ended before is not in the verdict, whatever that is */
static fw_status ends_early(fw_arena *arena, const fw_verdict *v, fw_report_summary *s) {
    for (int i = 0; i < v->nvariant; i++)
        if (v->variant[i].ends_early)
            return add(s, "not judged",
                       fw_arena_printf(arena, "%s [FW-D691]", v->variant[i].ends_early));
    return FW_OK;
}

fw_status fw_report_summarise(fw_arena *arena, const fw_report_input *in, fw_report_summary *s) {
    const fw_verdict *v = in->verdict;
    size_t most = 8 + 3 * (size_t)in->nflow;
    for (int i = 0; i < v->nvariant; i++)
        most += (size_t)v->variant[i].nreason;
    const int all = FW_CHECK_HINGES | FW_CHECK_REQUIREMENTS;
    *s = (fw_report_summary){.decision = v->decision};
    FW_NEED(s->line = fw_arena_array(arena, fw_report_summary_line, most));
    FW_TRY(fw_verdict_governing(arena, v, FW_CHECK_HINGES, false, &s->drawn, &s->has_drawn));
    FW_TRY(fw_verdict_governing(arena, v, FW_CHECK_HINGES, true, &s->made, &s->has_made));
    FW_TRY(fw_verdict_governing(arena, v, all, false, &s->governing_drawn, &s->governs));
    FW_TRY(fw_verdict_governing(arena, v, all, true, &s->governing, &s->governs));
    s->has_made = s->has_made && s->made.corner;
    FW_TRY(layout_faults(arena, in->layout, s));
    const bool drawn = !in->layout || in->layout->nfault == 0;
    if (drawn && v->decision != FW_REJECT) FW_TRY(unmade(arena, in, s));
    FW_TRY(other_dies(arena, in, s));
    const bool rejected =
        v->decision == FW_REJECT; /* what rejects comes before what is not known */
    FW_TRY(reasons_of(arena, v, FW_REJECT, "rejected because", s));
    if (!rejected) FW_TRY(undecided(arena, v, s));
    const bool first =
        s->governing.requirement != NULL; /* what governs is told before the others */
    if (first) FW_TRY(required(arena, v, s));
    FW_TRY(hinges(arena, v, s));
    FW_TRY(advice(arena, v, in->layout && in->layout->nfault > 0, s));
    if (rejected) FW_TRY(undecided(arena, v, s));
    if (!first) FW_TRY(required(arena, v, s));
    FW_TRY(nearest(arena, v, s));
    FW_TRY(ends_early(arena, v, s));
    FW_TRY(outside(arena, in, s));
    return rejected ? FW_OK : guarantees(arena, in, s);
}
