/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One step of the run sheet, and what is made at its head. */
#include "base/svg.h"
#include "recipe/recipe_profile.h"
#include "recipe/recipe.h"
#include "process/process_law.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* What is made, at the head of the run sheet: the block behind the cut, and widths to look for. */

static void parts(const fw_recipe_section_plan *plan, fw_text *out) {
    enum {
        MOST = 8
    }; /* a cut across a whole device meets dozens: they are in the picture of sections */
    if (plan->npart == 0 || plan->npart > MOST) return;
    fw_text_add(out, "<p>Along the cut, from the left: ");
    for (int i = 0; i < plan->npart; i++) {
        fw_text_add(out, i ? ", " : "");
        fw_text_escaped(out, plan->part[i].label ? plan->part[i].label : "");
    }
    fw_text_add(out, ".</p>\n");
}

static void width(fw_text *out, double m) {
    fw_text_add(out, "<td class=\"n\">");
    if (isnan(m))
        fw_text_add(out, "-");
    else
        fw_recipe_put_value(out, m * 1e6);
    fw_text_add(out, "</td>");
}

static double rounded(double m) { /* to 1 nm: what a microscope can tell, and more */
    return isnan(m) ? m : 1e-9 * floor(m * 1e9 + 0.5);
}

static void openings(const fw_recipe_section_plan *plan, fw_text *out) {
    enum { MOST = 6 };
    if (plan->nopening == 0 || plan->nopening > MOST) return;
    fw_text_add(out, "<table class=\"small\"><tr><th>Opening at, µm</th><th class=\"n\">drawn</th>"
                     "<th class=\"n\">mask</th><th class=\"n\">top</th><th class=\"n\">bottom"
                     "</th><th class=\"n\">deep</th></tr>\n");
    for (int i = 0; i < plan->nopening; i++) {
        const fw_recipe_section_opening *o = &plan->opening[i];
        const double value[] = {o->drawn_m, o->mask_m, o->top_m, o->bottom_m, o->depth_m};
        fw_text_add(out, "<tr><td>");
        fw_recipe_put_value(out, rounded(0.5 * (o->from_m + o->to_m)) * 1e6);
        fw_text_add(out, "</td>");
        for (int k = 0; k < 5; k++)
            width(out, rounded(value[k]));
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</table>\n");
}

fw_status fw_recipe_html_pictures(const fw_process_flow *flow, const fw_recipe_header *header,
                                  fw_recipe_slicer *slicer, const fw_recipe_section_scale *scale,
                                  fw_text *out) {
    double height;
    fw_recipe_section_plan plan;
    fw_text body = fw_text_new(out->arena);
    fw_text_add(&body, "");
    FW_TRY(fw_recipe_section_plan_of(slicer, flow, &plan));
    FW_TRY(fw_recipe_block_draw(slicer, flow, scale, flow->nstep - 1, 420.0, &body, &height));
    FW_TRY(fw_text_end(&body));
    fw_text_add(out, "<h3>What is made</h3>\n<div class=\"pair made\"><div><p>Sections: ");
    fw_text_escaped(out, header->cut->name);
    fw_text_add(out,
                ", to scale along the cut, heights as each picture says. Walls stand where mask, "
                "printing and etches leave them. Hatched: nobody stated its thickness. A zigzag: "
                "drawn thinner than it is. The picture shows the finished wafer behind the same "
                "cut, seen from above.</p>\n");
    parts(&plan, out);
    openings(&plan, out);
    fw_text_add(out, "</div><div>");
    fw_svg_begin(out, &(fw_svg_frame){.width = 420,
                                      .height = ceil(height),
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .trail = "role='img'"});
    fw_svg_title(out, "finished wafer at the cut");
    fw_text_add(out, body.data);
    fw_svg_close(out, "svg");
    fw_text_add(out, "</div></div>\n");
    return FW_OK;
}

static void tagged(fw_text *out, const char *text) {
    fw_text_printf(out, "<span class=\"tag %s\">%s</span>", text, text);
}

/* "[3]": number of the source in the list at the end; other text as it is */
static void source_of(const fw_process_flow *flow, const char *source, const int *number,
                      fw_text *out) {
    if (!source || !source[0]) return;
    for (int i = 0; i < flow->nsource; i++)
        if (strcmp(flow->source[i].text, source) == 0) {
            fw_text_printf(out, "[%d]", number[i]);
            return;
        }
    fw_text_escaped(out, source);
}

/* how the mask comes to lie on what is there */
static void alignment(const fw_process_flow *flow, const fw_process_step *s, fw_text *out) {
    const fw_process_align *a = &s->align;
    if (!a->to) return;
    bool below = false; /* what it is aligned to */
    for (const fw_process_step *to = flow->step; to < s; to++)
        if (strcmp(to->mask, a->to) == 0) below = fw_process_step_on_back(to);
    const bool back = fw_process_step_on_back(s);
    fw_text_add(out, "<p><b>Align</b> plate ");
    fw_text_escaped(out, s->mask);
    fw_text_add(out, back ? " on the back, mirrored, to " : " to ");
    fw_text_escaped(out, a->to);
    if (below != back)
        fw_text_printf(out, " on the %s, seen through the wafer or from below",
                       below ? "back" : "front");
    else if (back)
        fw_text_add(out, " on the same side");
    if (a->marks[0]) {
        const char *mark = a->marks;
        fw_text_add(out, " by the marks ");
        while (*mark) { /* names with blanks between */
            size_t n = strcspn(mark, " ");
            char name[128];
            snprintf(name, sizeof name, "%.*s", (int)n, mark);
            fw_text_escaped(out, name);
            mark += n + strspn(mark + n, " ");
            if (*mark) fw_text_add(out, strchr(mark, ' ') ? ", " : " and ");
        }
    }
    fw_text_add(out, "; images at most ");
    if (a->overlay->unknown)
        fw_text_add(out, "______");
    else
        fw_recipe_put_value(out, fw_quantity_in_unit(a->overlay));
    fw_text_add(out, " ");
    fw_recipe_put_unit(out, a->overlay->unit);
    fw_text_add(out, " apart. Read: ______</p>\n");
}

static double asked_of(const fw_wiring_net *net) {
    return fmax(fabs(net->low_V), fabs(net->high_V));
}

/* the least voltage at which a gap beside the net may break down; HUGE_VAL: none is known */
static double breaks_at(const fw_wiring *w, int net) {
    double least = HUGE_VAL;
    for (int i = 0; i < w->ngap; i++)
        if ((w->gap[i].a == net || w->gap[i].b == net) && w->gap[i].volts > 0.0)
            least = fmin(least, w->gap[i].breakdown_V[0]); /* fmin ignores what is not known */
    return least;
}

/* "stator of cx: up to 200 V, which is all that the equipment bears; the device asks for 240 V" */
static void tested_to(const fw_process_step *s, const fw_wiring *w, int net, fw_text *out) {
    const double asked = asked_of(&w->net[net]), breaks = breaks_at(w, net),
                 bears = s->bears->unknown ? HUGE_VAL : s->bears->value,
                 most = fmin(asked, fmin(bears, breaks));
    fw_text_escaped(out, w->net[net].name);
    fw_text_add(out, " up to <b>");
    fw_text_number(out, most < asked && most == breaks ? floor(most) : most, 4);
    fw_text_add(out, " V</b>");
    if (most == asked) return;
    fw_text_add(out, most == bears ? ", all that the equipment bears"
                                   : ", above which a gap may break down");
    fw_text_add(out, " (the device asks for ");
    fw_text_number(out, asked, 4);
    fw_text_add(out, " V)");
}

/* a step that drives the device: how far, drive by drive */
static void drives(const fw_process_step *s, const fw_wiring *w, fw_text *out) {
    int n = 0;
    if (!s->bears || !w || w->ndrive == 0) return;
    fw_text_add(out, "<p class=\"note\"><b>Voltages:</b> ");
    for (int i = 0; i < w->nnet; i++) {
        if (!fw_wiring_is_driven(&w->net[i])) continue;
        fw_text_add(out, n++ ? "; " : "");
        tested_to(s, w, i, out);
    }
    fw_text_add(out, n ? ". " : "no scene drives anything. ");
    if (s->bears->unknown)
        fw_text_add(out, "What the equipment bears is not known: ______ V (");
    else {
        fw_text_add(out, "The equipment bears ");
        fw_text_number(out, s->bears->value, 4);
        fw_text_printf(out, " V (%s, ", fw_quantity_value_status_text(s->bears->status));
    }
    fw_text_escaped(out, s->bears->id);
    fw_text_add(out, ").</p>\n");
}

/* other ways of doing it, and the one that was chosen */
static void ways(const fw_process_flow *flow, const fw_process_step *s, fw_text *out) {
    for (int i = 0; i < flow->nalternative; i++) {
        const fw_process_alternative *a = &flow->alternative[i];
        if (strcmp(a->step, s->id) != 0) continue;
        fw_text_add(out, a->chosen  ? "<p class=\"small\"><b>Chosen by the laboratory:</b> "
                         : a->unfit ? "<p class=\"small\"><b>Not for this device:</b> <s>"
                                    : "<p class=\"small\"><b>Another way:</b> ");
        fw_text_escaped(out, a->title);
        fw_text_add(out, " (");
        fw_text_escaped(out, a->id);
        fw_text_add(out, a->chosen ? "), instead of: " : a->unfit ? ")</s>: " : ")");
        fw_text_escaped(out, a->chosen ? a->instead_of : a->unfit ? a->unfit : "");
        fw_text_add(out, ".</p>\n");
    }
}

static void step_head(const fw_process_flow *flow, const fw_process_step *s,
                      const fw_recipe_header *header, bool picture, fw_text *out) {
    bool of_dies = fw_process_step_is_of_dies(flow, (int)(s - flow->step));
    fw_text_add(out, "<header><h2><span class=\"box\"></span>");
    fw_text_escaped(out, s->id);
    fw_text_add(out, "&ensp;");
    fw_text_escaped(out, s->title);
    fw_text_printf(out, "</h2><div class=\"meta\">%s%s%s</div></header>\n",
                   s->in_source ? "described in the source" : "added, not in the source",
                   s->mask[0] ? "<br>mask " : "", s->mask);
    fw_text_add(out, picture ? "<div class=\"pair\"><div><p>" : "<p>");
    fw_text_escaped(out, s->purpose);
    fw_text_add(out, "</p>\n");
    alignment(flow, s, out);
    ways(flow, s, out);
    fw_text_add(out, "<div class=\"bench\">");
    if (s->equipment) {
        fw_text_add(out, "<p class=\"small tool\"><b>Equipment:</b> ");
        fw_text_escaped(out, s->equipment->class_);
        if (s->equipment->text[0]) {
            fw_text_add(out, "; ");
            fw_text_escaped(out, s->equipment->text);
        }
        if (s->batch > 1 && !fw_process_step_is_of_lot(s))
            fw_text_printf(out, ". Up to %s%d wafers at once", of_dies ? "the dies of " : "",
                           s->batch);
        if (fw_process_step_is_of_lot(s)) fw_text_add(out, ". Once per lot");
        fw_text_add(out, ".");
        fw_recipe_html_fillings(flow, s, header, out);
        fw_text_add(out, "</p>\n");
    } else if (s->nuse > 0) {
        fw_text_add(out, "<p class=\"small tool\">");
        fw_recipe_html_fillings(flow, s, header, out);
        fw_text_add(out, "</p>\n");
    }
}

/* What is computed, to the second digit of its uncertainty: nobody can set what stands behind that, and nothing bears it. Below
   100 four digits are printed of everything, which are few enough. */
static double as_known(const fw_quantity *q, bool derived) {
    const double value = fw_quantity_in_unit(q), u = fw_recipe_row_uncertainty(q);
    if (!derived || !(u > 0.0) || !(fabs(value) >= 100.0) || !(u < fabs(value))) return value;
    const double place = fmax(pow(10.0, floor(log10(u)) - 1.0), 1e-3);
    return place >= 1.0 ? floor(value / place + 0.5) * place
                        : floor(value * (1.0 / place) + 0.5) / (1.0 / place);
}

static void value_cell(const fw_quantity *q, bool derived, fw_text *out) {
    if (q->unknown) {
        fw_text_add(out, "____________");
        if (strcmp(q->unit, "1") != 0) {
            fw_text_add(out, " ");
            fw_recipe_put_unit(out, q->unit);
        }
        return;
    }
    fw_text_add(out, "<b>");
    if (q->word)
        fw_text_escaped(out, q->word);
    else
        fw_recipe_put_value(out, as_known(q, derived));
    fw_text_add(out, "</b>");
    if (q->word) return;
    double u = fw_recipe_row_uncertainty(q);
    if (u > 0.0) {
        fw_text_add(out, " ± ");
        if (u >= 99.5 && u < 1e6) {
            const double place = derived ? pow(10.0, floor(log10(u)) - 1.0) : 1.0;
            fw_text_fixed(out, floor(u / place + 0.5) * place, 0);
        } else
            fw_text_number(out, u, 2);
    }
    fw_text_add(out, " ");
    fw_recipe_put_unit(out, q->unit);
}

static void quantity_row(const fw_process_flow *flow, const fw_recipe_row *row, const int *number,
                         fw_text *out) {
    const fw_quantity *q = row->q;
    fw_text_add(out, "<tr><td>");
    fw_text_escaped(out, row->name);
    fw_text_add(out, "</td><td class=\"n\">");
    value_cell(q, row->derived, out);
    fw_text_add(out, "</td><td>");
    fw_recipe_put_limits(out, row->low, row->high);
    fw_text_add(out, "</td><td>");
    tagged(out, q->unknown ? "unknown" : fw_quantity_value_status_text(q->status));
    if (!q->unknown && q->uncertainty > 0.0 && q->u_status != q->status) {
        fw_text_add(out, " ± ");
        tagged(out, fw_quantity_value_status_text(q->u_status));
    }
    fw_text_add(out, " ");
    source_of(flow, q->source, number, out);
    if (q->note) {
        fw_text_add(out, " <span class=\"muted\">");
        fw_text_escaped(out, q->note);
        fw_text_add(out, "</span>");
    }
    fw_text_add(out, "</td><td></td></tr>\n");
}

/* a stated time, known: the window below shows it with its status */
static bool only_the_time(const fw_process_step *s, const fw_recipe_row *row, int n) {
    const fw_process_law *law = fw_process_law_find(s->law);
    return n == 1 && law && law->stated && row[0].q == s->argument[0].q && !row[0].q->unknown;
}

/* in the order in which the sheet names them; of two sources with one text the first */
static void number_sources(const fw_process_flow *flow, const fw_recipe_row *row, int n,
                           int *number, int *last) {
    for (int k = 0; k < n; k++) {
        int i = 0;
        while (i < flow->nsource &&
               (!row[k].q->source || strcmp(flow->source[i].text, row[k].q->source) != 0))
            i++;
        if (i < flow->nsource && number[i] == 0) number[i] = ++*last;
    }
}

fw_status fw_recipe_source_numbers(fw_arena *arena, const fw_process_flow *flow, int **number) {
    int last = 0;
    FW_NEED(*number = fw_arena_array(arena, int, (size_t)flow->nsource + 1));
    for (int i = 0; i <= flow->nsource; i++)
        (*number)[i] = 0;
    for (int i = 0; i < flow->nstep; i++) {
        fw_recipe_row *row = NULL;
        int n = 0;
        FW_TRY(fw_recipe_step_rows(arena, &flow->step[i], &row, &n));
        if (!only_the_time(&flow->step[i], row, n)) number_sources(flow, row, n, *number, &last);
    }
    return FW_OK;
}

static fw_status quantities(const fw_process_flow *flow, const fw_process_step *s,
                            const int *number, fw_text *out) {
    fw_recipe_row *row = NULL;
    int n = 0, derived = 0;
    FW_TRY(fw_recipe_step_rows(out->arena, s, &row, &n));
    if (n == 0 || only_the_time(s, row, n)) return FW_OK;
    fw_text_add(out, "<table class=\"small\"><thead><tr><th style=\"width:25%\">Setting</th><th "
                     "class=\"n\">Planned</th><th style=\"width:10%\">Allowed</th><th "
                     "style=\"width:42%\">Status, source"
                     "</th><th style=\"width:16mm\">Actual</th></tr>"
                     "</thead><tbody>\n");
    for (int i = 0; i < n; i++) {
        if (row[i].derived && derived++ == 0)
            fw_text_add(out,
                        "<tr class=\"group\"><th colspan=\"5\">Computed for this step</th></tr>\n");
        quantity_row(flow, &row[i], number, out);
    }
    fw_text_add(out, "</tbody></table>\n");
    return FW_OK;
}

static fw_status time_box(const fw_process_step *s, fw_text *out) {
    const fw_process_time *t = &s->time;
    if (!t->computable) {
        const char *missing = fw_recipe_missing_list(out->arena, t);
        FW_NEED(missing);
        fw_text_add(out, "<p class=\"nc\"><b>TIME NOT COMPUTABLE</b>, missing: ");
        fw_text_escaped(out, missing);
        fw_text_add(out, ".</p>\n");
        return FW_OK;
    }
    static const char *const name[] = {"Planned", "First look", "Clear by", "Stop",
                                       "At the machine"};
    const double value[] = {t->nominal_s, t->first_look_s, t->clear_by_s, t->stop_s, s->booked_s};
    fw_text_add(out, "<table class=\"window\"><tr>");
    for (int i = 0; i < 5; i++) {
        fw_text_printf(out, "<td><span>%s</span> %s", name[i], i == 0 ? "<b>" : "");
        fw_schedule_put_duration(out, value[i]);
        fw_text_add(out, i == 0 ? "</b></td>" : "</td>");
    }
    fw_text_add(out, "</tr></table>\n");
    return FW_OK;
}

/* the law of its time, and what makes it uncertain */
static void time_words(const fw_process_step *s, fw_text *out) {
    const fw_process_time *t = &s->time;
    if (!t->computable) return;
    fw_text_add(out, "<span class=\"small\">Time: law <i>");
    fw_text_escaped(out, s->law);
    fw_text_add(out, "</i>, ");
    tagged(out, fw_quantity_value_status_text(t->status));
    if (t->ncontribution > 0) {
        fw_text_add(out, ", uncertainty ");
        tagged(out, fw_quantity_value_status_text(t->u_status));
        fw_text_add(out, ", from ");
        for (int i = 0; i < t->ncontribution && i < 4; i++) {
            fw_text_add(out, i ? ", " : "");
            fw_text_escaped(out, t->contribution[i]);
        }
    }
    if (s->pulse && s->booked_s > t->nominal_s * (1.0 + s->overrun) + s->finish_s + 1e-6) {
        fw_text_add(out, "; a pause of ");
        fw_schedule_put_duration(out, s->pause->value);
        fw_text_add(out, " after every ");
        fw_schedule_put_duration(out, s->pulse->value);
    }
    fw_text_add(out, ".</span> ");
}

/* at the same bench, after the step's own time */
static fw_status finishes(const fw_process_step *s, fw_text *out) {
    if (s->nfinish == 0) return FW_OK;
    fw_text_add(out, "<b>Before it leaves the bench:</b> ");
    for (int i = 0; i < s->nfinish; i++) {
        const fw_process_finish *f = &s->finish[i];
        const char *words = fw_recipe_finish_words(out->arena, f);
        FW_NEED(words);
        fw_text_add(out, i ? "; " : "");
        fw_text_escaped(out, words);
        if (f->time && !f->time->unknown) {
            fw_text_add(out, " (");
            fw_schedule_put_duration(out, f->time->value);
            fw_text_printf(out, ", %s)", fw_quantity_value_status_text(f->time->status));
        }
        if (f->text[0] && f->kind != FW_FINISH_RINSE) {
            fw_text_add(out, ", ");
            fw_text_escaped(out, f->text);
        }
    }
    fw_text_add(out, ". ");
    return FW_OK;
}

/* what the wafer is like then, and how long it may wait like that */
static void waits(const fw_process_flow *flow, int index, fw_text *out) {
    for (int i = 0; i < flow->nwait; i++) {
        const fw_process_wait *w = &flow->wait[i];
        if (w->from != index) continue;
        fw_text_add(out, "<p class=\"small note\"><b>Now the wafer is ");
        fw_text_escaped(out, w->is);
        fw_text_add(out, ":</b> start ");
        fw_text_escaped(out, flow->step[w->to].id);
        fw_text_add(out, " within ");
        fw_schedule_put_duration(out, w->max_s);
        fw_text_printf(out, " (%s), since %s.</p>\n",
                       w->q ? fw_quantity_value_status_text(w->q->status) : "assumed", w->why);
    }
}

/* the step parts the wafer: what the sheet is of behind it */
static void parting(const fw_process_flow *flow, const fw_process_step *s, fw_text *out) {
    const fw_quantity *dies = fw_process_flow_quantity(flow, "mask.dies");
    bool mapped = dies && !dies->unknown && dies->value > 1; /* else of one die, without a map */
    if (!s->parts) return;
    fw_text_add(out, "<p class=\"small note\"><b>From here on the sheet is of dies");
    if (mapped) fw_text_printf(out, ", %.0f devices of each wafer", dies->value);
    fw_text_add(out, ":</b> those of a wafer stay together in a box or basket of its own, with the "
                     "wafer's number on it.");
    if (mapped)
        fw_text_add(out, " A die is told by its row and column on the wafer map: they stand on its "
                         "frame where ids are drawn. Alignment sites and test dies come off with "
                         "them.");
    fw_text_add(out, "</p>\n");
}

/* how long, when it is done, and what follows at the bench: one after the other */
static fw_status endpoints(const fw_process_step *s, fw_text *out) {
    fw_text_add(out, "<p>");
    time_words(s, out);
    for (int i = 0; i < s->nendpoint; i++) {
        fw_text_add(out, "<b>Endpoint:</b> ");
        fw_text_escaped(out, s->endpoint[i]);
        fw_text_add(out, " ");
    }
    FW_TRY(finishes(s, out));
    fw_text_add(out, "</p>\n");
    return FW_OK;
}

static void holds(const fw_process_step *s, fw_text *out) {
    for (int i = 0; i < s->nlag; i++) {
        const fw_process_lag *l = &s->lag[i];
        fw_text_add(out, "<p class=\"note\"><b>Hold:</b> start ");
        if (!isnan(l->min_s)) {
            fw_text_add(out, "not before ");
            fw_schedule_put_duration(out, l->min_s);
        }
        fw_text_add(out, !isnan(l->min_s) && !isnan(l->max_s) ? " and " : "");
        if (!isnan(l->max_s)) {
            fw_text_add(out, "within ");
            fw_schedule_put_duration(out, l->max_s);
        }
        fw_text_add(out, " after the end of ");
        fw_text_escaped(out, l->from);
        fw_text_add(out, ".</p>\n");
    }
}

/* what the chemical takes along; how much of it the plan cannot say better than its quantity */
static void exposures(const fw_process_flow *flow, const fw_process_step *s, fw_text *out) {
    for (int i = 0; i < s->nexposed; i++) {
        const fw_process_exposed *x = &s->exposed[i];
        const fw_quantity *q = x->rate ? x->rate : x->selectivity;
        fw_text_add(out, "<p class=\"note\"><b>Lies open:</b> ");
        fw_text_escaped(out, fw_process_flow_material_name(flow, x->material));
        if (q->unknown) {
            fw_text_printf(out, ". This step takes some of it; the %s is not known (",
                           x->rate ? "rate" : "selectivity");
            fw_text_escaped(out, q->id);
            fw_text_add(out, "): look at it.</p>\n");
            continue;
        }
        fw_text_add(out, x->rate ? ", taken at " : ", at a selectivity of ");
        fw_text_number(out, fw_quantity_in_unit(q), 4);
        fw_text_add(out, x->rate ? " " : "");
        if (x->rate) fw_recipe_put_unit(out, q->unit);
        fw_text_printf(out, " (%s).</p>\n", fw_quantity_value_status_text(q->status));
    }
}

/* what the section of this step cannot know, where the step before had not said it */
static fw_status section_notes(const fw_process_flow *flow, int index, fw_text *out) {
    fw_process_films now, before;
    FW_TRY(fw_process_flow_films(out->arena, flow, index, &now));
    FW_TRY(fw_process_flow_films(out->arena, flow, index - 1, &before));
    for (int i = 0; i < now.nnote; i++) {
        if (!fw_process_films_is_new(&now, &before, i)) continue;
        fw_text_add(out, "<p class=\"small muted\">");
        fw_text_escaped(out, now.note[i]);
        fw_text_add(out, ".</p>\n");
    }
    return FW_OK;
}

void fw_recipe_html_step(const fw_process_flow *flow, int index, const fw_recipe_header *header,
                         fw_recipe_slicer *slicer, const fw_recipe_section_scale *scale,
                         const int *number, fw_text *out) {
    const fw_process_step *s = &flow->step[index];
    bool changes = fw_process_step_changes(s); /* else the wafer looks as before */
    fw_text_add(out, "<section class=\"step\" id=\"");
    fw_text_escaped(out, s->id);
    fw_text_add(out, "\">\n");
    step_head(flow, s, header, changes, out);
    fw_recipe_html_hazard_line(flow, s, out);
    fw_text_add(out, "</div>\n");
    drives(s, header->wiring, out);
    holds(s, out);
    exposures(flow, s, out);
    if (slicer && changes && section_notes(flow, index, out) != FW_OK) out->failed = 1;
    if (changes && endpoints(s, out) != FW_OK)
        out->failed = 1; /* there is room beside the picture */
    fw_text_add(out, changes ? "</div><div>" : "");
    fw_status drawn = !changes ? FW_OK
                      : slicer ? fw_recipe_section_exact(slicer, flow, scale, index, out)
                               : fw_recipe_section_svg(flow, index, out);
    if (drawn != FW_OK) out->failed = 1;
    fw_text_add(out, changes ? "</div></div>\n" : "");
    if (quantities(flow, s, number, out) != FW_OK || time_box(s, out) != FW_OK) out->failed = 1;
    if (!changes && endpoints(s, out) != FW_OK) out->failed = 1;
    fw_recipe_html_wafers(s, fw_process_step_is_of_dies(flow, index), header, out);
    fw_recipe_html_outcome(flow, index, header, out);
    parting(flow, s, out);
    waits(flow, index, out);
    fw_text_add(out, "</section>\n");
}
