/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The run sheet: one file, no scripts, made for A4 or Letter, as the printer has it, and a pen. */
#include "recipe/recipe_profile.h"
#include "recipe/recipe.h"
#include <math.h>
#include <string.h>

/* ---- what to measure first ---- */

enum { SHOWN = 5 }; /* all of them stand in the report */

static void measured_cell(fw_text *out, const char *class, fw_text *text) {
    fw_text_printf(out, "<td%s>", class);
    fw_text_escaped(out, fw_text_end(text) == FW_OK && text->length ? text->data : "");
    fw_text_add(out, "</td>");
}

static void measured_row(fw_text *out, const fw_measuring *m, int i) {
    const fw_measuring_item *x = &m->item[i];
    fw_text input = fw_text_new(out->arena), now = fw_text_new(out->arena),
            then = fw_text_new(out->arena), worth = fw_text_new(out->arena),
            windows = fw_text_new(out->arena);
    fw_text_printf(&input, "%s%s%s%s", x->name, x->id ? " (" : "", x->id ? x->id : "",
                   x->id ? ")" : "");
    fw_measuring_put_value(&now, x, false);
    if (x->unknown && !isnan(x->value)) fw_text_add(&now, " (assumed)");
    fw_text_add(&then, x->by ? x->by : "nothing in this flow");
    if (!isnan(x->value)) {
        fw_text_add(&then, x->by ? ": " : "; ");
        fw_measuring_put_value(&then, x, true);
    }
    fw_measuring_put_worth(&worth, m, x);
    fw_measuring_put_windows(&windows, x);
    fw_text_printf(out, "<tr><td class=\"n\">%d</td>", i + 1);
    measured_cell(out, "", &input);
    measured_cell(out, "", &now);
    measured_cell(out, "", &then);
    measured_cell(out, " class=\"n\"", &worth);
    measured_cell(out, "", &windows);
    fw_text_add(out, "</tr>\n");
}

/* what to type of the coupons of those rows, and of the file that keeps it */
static void put_forms(const fw_measuring *m, fw_text *out) {
    fw_text forms = fw_text_new(out->arena);
    fw_process_coupon_read read[SHOWN];
    int n = 0;
    for (int i = 0; i < m->nitem && i < SHOWN; i++)
        read[n++] = (fw_process_coupon_read){m->item[i].by, m->item[i].id};
    if (fw_process_coupon_forms(read, n, &forms) != FW_OK) {
        out->failed = 1;
        return;
    }
    if (forms.length == 0) return;
    fw_text_add(out,
                "<p class=\"small\">What was read goes into the log of the lot (flexwright log, "
                "--coupon \"...\"), five sites in one line, and from there to calibrate: ");
    fw_text_escaped(out, forms.data);
    fw_text_add(out, ".</p>\n");
}

/* the first five of what to measure first; nothing where it was not asked for */
static void put_measurements(const fw_recipe_header *header, fw_text *out) {
    const fw_measuring *m = header->measuring;
    if (!m || m->nitem == 0) return;
    fw_text_add(out, "<h3>What to measure first</h3>\n");
    if (m->what) {
        fw_text_add(out, "<p class=\"small\">");
        fw_text_escaped(out, m->first ? m->first : "No single measurement narrows the verdict.");
        fw_text_add(out, "</p>\n");
    }
    fw_text_printf(
        out,
        "<table class=\"small\"><thead><tr><th class=\"n\"></th><th>Input</th><th>Now</th>"
        "<th>Read by</th><th class=\"n\">%s</th><th>Time window, first look to clear by"
        "</th></tr></thead><tbody>\n",
        m->banded ? "Band then" : "Uncertainty that it brings");
    for (int i = 0; i < m->nitem && i < SHOWN; i++)
        measured_row(out, m, i);
    fw_text_add(out, "</tbody></table>\n");
    put_forms(m, out);
    if (m->nitem > SHOWN)
        fw_text_printf(out,
                       "<p class=\"small\">%d more inputs, worth less, stand in the report.</p>\n",
                       m->nitem - SHOWN);
}

/* ---- the sheet ---- */

static void cell(fw_text *out, const char *text) {
    fw_text_add(out, "<td>");
    fw_text_escaped(out, text);
    fw_text_add(out, "</td>");
}

/* the table of values that a laboratory replaced; nothing without */
static void overrides_table(const fw_process_flow *flow, fw_text *out) {
    if (flow->noverride == 0) return;
    fw_text_printf(out,
                   "<h3>Values of the laboratory: %d</h3>\n<table class=\"small\"><thead><tr>"
                   "<th>Value</th><th>Laboratory</th><th>In the process file</th><th>Source</th>"
                   "</tr></thead><tbody>\n",
                   flow->noverride);
    for (int i = 0; i < flow->noverride; i++) {
        const fw_process_override *o = &flow->override[i];
        fw_text_add(out, "<tr>");
        cell(out, o->id);
        cell(out, o->is);
        cell(out, o->was);
        cell(out, o->source);
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</tbody></table>\n");
}

static const char style[] =
    "@page{margin:8mm 12mm 10mm}\n"
    "*{box-sizing:border-box}\n"
    "body{font:8.5pt/1.17 Helvetica,Arial,'Liberation Sans','DejaVu Sans "
    "Condensed',sans-serif;color:#000;background:#fff;"
    "max-width:186mm;margin:0 auto;padding:4mm 0}\n"
    "h1{font-size:17pt;line-height:1.15;margin:0 0 1mm}\n"
    "h2{font-size:11pt;line-height:1.2;margin:0}\n"
    "h3{font-size:10pt;margin:2mm 0 0.6mm;break-after:avoid}\n"
    "p{margin:0.5mm 0}\n"
    ".lead{color:#333;margin-bottom:3mm}\n"
    "table{border-collapse:collapse;width:100%;margin:0.8mm 0}\n"
    "td.id{white-space:nowrap}\n"
    "th,td{border:0.5pt solid #888;padding:0.2mm 1mm;text-align:left;vertical-align:top}\n"
    "th{font-weight:bold;background:#f0f0f0;-webkit-print-color-adjust:exact;"
    "print-color-adjust:exact}\n"
    "td.n,th.n{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}\n"
    "tr{break-inside:avoid}\ntr.group{break-after:avoid}\nthead{display:table-header-group}\n"
    ".blank td{height:5.4mm}\n.blank td.k{width:21%;background:#f7f7f7}\n"
    ".hash{font-family:'DejaVu Sans Mono',monospace;font-size:7pt;word-break:break-all}\n"
    ".box{display:inline-block;width:3.3mm;height:3.3mm;border:1pt solid #000;"
    "vertical-align:-0.6mm;margin-right:2mm}\n"
    ".tag{display:inline-block;border:0.5pt solid #000;border-radius:1.6mm;padding:0 1.3mm;"
    "font-size:7.5pt;white-space:nowrap}\n"
    ".tag.assumed,.tag.unknown{border-style:dashed}\n.tag.unknown{font-weight:bold}\n"
    ".note{border-left:2.2pt solid #000;padding:0.3mm 0 0.3mm 2.5mm;margin:1mm 0}\n"
    ".nc{border:1.4pt solid #000;padding:1.2mm 2mm;margin:1.5mm 0}\n"
    ".step{border:0.9pt solid #000;padding:0.6mm 2mm;margin:0 0 0.9mm;box-decoration-break:clone;"
    "-webkit-box-decoration-break:clone}\n"
    ".step>header{display:flex;justify-content:space-between;align-items:flex-start;gap:4mm;"
    "border-bottom:0.5pt solid #888;padding-bottom:0.8mm;margin-bottom:0.8mm;break-after:avoid}\n"
    /* a heading keeps its table, and a table what is to be done where it went wrong */
    ".step>p:not(:last-child),.bench,.step>.window,.step>.pair{break-after:avoid}\n"
    ".bench,.step>p{break-inside:avoid}.outcome{break-before:avoid}\n"
    ".pair,.window,.hazard,.note,.nc{break-inside:avoid}\n"
    ".meta{font-size:8pt;text-align:right;white-space:nowrap;padding-top:0.8mm}\n"
    ".pair{display:flex;gap:4mm;align-items:flex-start}\n.pair>div:first-child{flex:1}\n"
    ".release{margin:2mm 0;break-inside:avoid}.release svg{width:120mm;height:auto;display:block}\n"
    ".pair>div:last-child{width:58mm}\n.pair svg{width:58mm;height:auto;display:block}\n"
    ".summary .box{width:2.5mm;height:2.5mm;vertical-align:-0.3mm}\n"
    ".made>div:last-child,.made svg{width:47mm!important}\n"
    ".small{font-size:7.2pt}\n.muted{color:#444}\ntd .muted{font-size:6.5pt;line-height:1.1}\n"
    ".tool,.hazard{display:inline-block;vertical-align:middle;margin:0.5mm 3mm 0.5mm 0}\n"
    ".hazard{border:0.9pt solid #000;padding:0.2mm 1.5mm;font-size:8pt}\n"
    ".window td{text-align:center;white-space:nowrap}\n.window span{font-size:7.2pt;color:#333}\n"
    ".actual "
    "td{height:6.4mm;width:12.5%;font-size:7pt;color:#444}\n.sources "
    "li{break-inside:avoid}\n.sources{columns:3;column-gap:9mm;"
    "padding-left:5mm}\n"
    ".wafers td{height:4.8mm}\n.wafers .box{vertical-align:middle}\n"
    ".wafers th{font-size:6.8pt;line-height:1.05}\n.wafers td.w{white-space:nowrap}\n.wafers "
    "td.off{background:#ddd;"
    "-webkit-print-color-adjust:exact;print-color-adjust:exact}\n"
    ".s{display:inline-block;width:8.6mm;height:4.4mm;border:0.4pt solid #888;margin-right:0.5mm;"
    "vertical-align:middle}\n"
    ".narrow .s{width:6.8mm}\n"
    ".outcome{display:flex;justify-content:space-between;align-items:flex-end;gap:4mm;margin:0.5mm "
    "0}\n"
    ".counts{white-space:nowrap}\n"
    ".rejected{border:2.2pt solid #000;text-align:center;font-size:13pt;font-weight:bold;"
    "letter-spacing:0.08em;padding:1.6mm;margin:0 0 3mm}\n.because{font-weight:bold}\n"
    "@media screen{.rejected{position:sticky;top:0;background:#fff;z-index:1}}\n"
    "@media print{body{max-width:none;padding:0}a{color:#000;text-decoration:none}}\n";

static void margin_boxes(const fw_process_flow *flow, const fw_recipe_header *h, fw_text *out) {
    fw_text_add(out, "@page{@bottom-left{content:\"");
    /* inside a CSS string: only letters, digits and a few marks of the id get through */
    for (const char *c = flow->id; *c; c++)
        if (strchr("-_.", *c) || (*c >= '0' && *c <= '9') || (*c >= 'A' && *c <= 'Z') ||
            (*c >= 'a' && *c <= 'z'))
            fw_text_bytes(out, c, 1);
    fw_text_printf(out,
                   "; mask %.8s; process %.8s; lot ______________\";font:8pt Helvetica,Arial,"
                   "sans-serif}@bottom-right{content:counter(page) \" / \" counter(pages);font:8pt "
                   "Helvetica,Arial,sans-serif}%s}\n",
                   h->mask_sha256 ? h->mask_sha256 : "-", flow->sha256,
                   h->rejected
                       ? "@top-center{content:\"REJECTED - DO NOT FABRICATE\";font:bold 12pt "
                         "Helvetica,Arial,sans-serif;letter-spacing:0.08em}"
                       : "");
}

static void blank_row(fw_text *out, const char *left, const char *right) {
    fw_text_printf(out,
                   "<tr><td class=\"k\">%s</td><td></td><td class=\"k\">%s</td><td></td></tr>\n",
                   left, right);
}

static void hash_row(fw_text *out, const char *name, const char *hash) {
    fw_text_printf(out, "<tr><td class=\"k\">%s</td><td colspan=\"3\" class=\"hash\">", name);
    fw_text_escaped(out, hash ? hash : "none");
    fw_text_add(out, "</td></tr>\n");
}

/* Of a flow that prints several: what makes this one, and the sheet it is ordered by. A plate that is written
   has its layers joined. */
static void plate_file(const fw_process_flow *flow, const fw_recipe_header *h, const char *mask,
                       fw_text *out) {
    const fw_mask *drawn = h->mask;
    int row = drawn && drawn->table->nplate > 1 ? fw_mask_plate_named(drawn->table, mask) : -1;
    const char *written = h->plates_written ? "-plate" : "";
    fw_text_add(out, "file masks/");
    fw_text_escaped(out, flow->id);
    fw_text_add(out, written);
    if (row >= 0 && h->plates_written) fw_text_printf(out, ".%s", mask);
    fw_text_add(out, ".gds");
    if (row < 0 && !h->plates_written) return;
    if (!h->plates_written) {
        fw_text_add(out, ", layers ");
        fw_text_escaped(out, drawn->table->plates[row].layers);
    }
    fw_text_add(out, "; order sheet ");
    fw_text_escaped(out, flow->id);
    fw_text_add(out, written);
    if (row >= 0) fw_text_printf(out, ".%s", mask);
    fw_text_add(out, ".order.txt");
}

/* "Plate M1: file masks/al-masked-rie.gds" of every mask that a step exposes */
static void plates(const fw_process_flow *flow, const fw_recipe_header *h, fw_text *out) {
    for (int i = 0; i < flow->nstep; i++) {
        const char *mask = flow->step[i].mask;
        bool again = !mask[0];
        for (int k = 0; k < i && !again; k++)
            again = strcmp(flow->step[k].mask, mask) == 0;
        if (again) continue;
        fw_text_add(out, "<tr><td class=\"k\">Plate ");
        fw_text_escaped(out, mask);
        fw_text_add(out, "</td><td colspan=\"3\">");
        plate_file(flow, h, mask, out);
        fw_text_add(out, "; plate no. ____________&ensp; inspected ____________</td></tr>\n");
    }
}

static void front(const fw_process_flow *flow, const fw_recipe_header *h, fw_text *out) {
    fw_text_add(out, "<h1>Run sheet: ");
    fw_text_escaped(out, flow->title);
    fw_text_add(out, "</h1>\n<p class=\"lead\">Device <b>");
    fw_text_escaped(out, h->device ? h->device : "");
    fw_text_add(out, "</b>, flow <b>");
    fw_text_escaped(out, flow->id);
    fw_text_add(out, "</b>, device layer ");
    fw_text_escaped(out, flow->material ? fw_process_flow_material_name(flow, flow->material) : "");
    if (flow->thickness && !flow->thickness->unknown) {
        fw_text_add(out, ", ");
        fw_recipe_put_value(out, fw_quantity_in_unit(flow->thickness));
        fw_text_add(out, " ");
        fw_recipe_put_unit(out, flow->thickness->unit);
    }
    fw_text_add(out, "</p>\n<table class=\"blank\">\n");
    blank_row(out, "Lot", "Wafer IDs");
    blank_row(out, "Date", "Operator");
    blank_row(out, "Buddy (HF steps)", "Laboratory");
    blank_row(out, "Revision of this sheet", "Approved by, date");
    plates(flow, h, out);
    fw_recipe_wafer_rows(flow, h, out);
    hash_row(out, "Mask set, SHA-256", h->mask_sha256);
    hash_row(out, "Process file, SHA-256", flow->sha256);
    fw_text_add(out, "<tr><td class=\"k\">Process version</td><td>");
    fw_text_escaped(out, flow->version);
    fw_text_add(out, "</td><td class=\"k\">Program version</td><td>");
    fw_text_escaped(out, h->program_version ? h->program_version : "");
    fw_text_add(out, "</td></tr>\n</table>\n");
    fw_text_printf(
        out,
        "<p class=\"note\"><b>Values with status assumed: %d, typical: %d, unknown: "
        "%d.</b> Stated: %d, derived: %d, measured: %d. %d of %d steps are NOT COMPUTABLE "
        "until what they name is entered. Steps marked <i>added</i> are not described in "
        "the source; a real run needs them.</p>\n",
        flow->count[FW_ASSUMED], flow->count[FW_TYPICAL], flow->unknown, flow->count[FW_STATED],
        flow->count[FW_DERIVED], flow->count[FW_MEASURED], flow->not_computable, flow->nstep);
}

static void labelled(const char *label, const char *words, fw_text *out) {
    if (!words || out->failed) return;
    fw_text_printf(out, "<p class=\"small\"><b>%s:</b> ", label);
    fw_text_escaped(out, words);
    fw_text_add(out, ".</p>\n");
}

/* the step that frees the devices; NULL: none does */
static const fw_process_step *freeing(const fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++)
            if (strcmp(flow->step[i].op, "release") == 0 &&
                strcmp(flow->step[i].change[k].kind, "remove") == 0)
                return &flow->step[i];
    return NULL;
}

/* who gets a whole wafer must know before the first one how dies come off it: free devices bear no saw */
static void parting(const fw_process_flow *flow, fw_text *out) {
    const fw_process_step *s = freeing(flow);
    if (fw_process_step_is_of_dies(flow, flow->nstep)) return;
    const char *words =
        s ? fw_arena_printf(
                out->arena,
                "no step of this flow parts the wafer into dies, and step %s frees the devices "
                "while it is whole. Water and shaking of a saw tear free devices off: settle "
                "before the "
                "first wafer how it is parted, with half cuts before step %s that it is broken "
                "along dry, or by something else that neither wets nor shakes it",
                s->id, s->id)
          : "no step of this flow parts the wafer into dies: settle before the first one who does";
    if (!words) out->failed = true;
    labelled("Parting", words, out);
}

static void judgement(const fw_process_flow *flow, const fw_recipe_header *h, fw_text *out) {
    static const char *const word[] = {"Not guaranteed until something is measured",
                                       "Not manufacturable in this flow",
                                       "Nothing speaks against making it in this flow"};
    fw_text_printf(out, "<h3>Can this flow make this device? %s.</h3>\n<ul class=\"small\">\n",
                   word[flow->manufacturable + 1]);
    for (int i = 0; i < flow->nreason; i++) {
        fw_text_add(out, "<li>");
        fw_text_escaped(out, flow->reason[i]);
        fw_text_add(out, "</li>\n");
    }
    fw_text_add(out, "</ul>\n<p class=\"small\"><b>Mask compensation: ");
    fw_text_fixed(out, flow->bias_m * 1e6, 3);
    fw_text_add(out, " µm per edge.</b> ");
    fw_text_escaped(out, flow->bias_note ? flow->bias_note : "");
    fw_text_add(out, ".</p>\n");
    const char *words;
    if (fw_process_release_words(out->arena, flow, &words) != FW_OK) out->failed = true;
    labelled("Release window", words, out);
    if (fw_process_hold_words(out->arena, flow, &words) != FW_OK) out->failed = true;
    labelled("What holds meanwhile", words, out);
    words = NULL;
    if (h->verdict && fw_verdict_drying_words(out->arena, h->verdict, &words) != FW_OK)
        out->failed = true;
    labelled("Drying", words, out);
    parting(flow, out);
    if (!h->release || out->failed) return;
    fw_text_add(out, "<div class=\"release\">");
    fw_text_bytes(out, h->release->data, h->release->length);
    fw_text_add(out, "</div>\n");
}

/* nets and where each is contacted, of a device that something drives */
static void wiring(const fw_wiring *w, fw_text *out) {
    if (!w || w->ndrive == 0) return;
    fw_text_add(out, "<p class=\"small\"><b>Wiring.</b> Insulated by: ");
    fw_text_escaped(out, w->carrier.words);
    fw_text_add(out, ".</p>\n<ul class=\"small\">\n");
    for (int i = 0; i < w->nnet + w->ngap + w->nremark; i++) {
        const char *words = NULL;
        int gap = i - w->nnet, remark = gap - w->ngap;
        fw_text_add(out, "<li>");
        if (gap < 0) {
            fw_text_escaped(out, w->net[i].name);
            fw_text_add(out, ": ");
            if (fw_wiring_contact_words(out->arena, &w->net[i], &words) != FW_OK)
                out->failed = true;
        } else if (remark < 0) {
            if (fw_wiring_gap_words(out->arena, w, &w->gap[gap], &words) != FW_OK)
                out->failed = true;
        } else
            words = w->remark[remark];
        fw_text_escaped(out, words ? words : "");
        fw_text_add(out, "</li>\n");
    }
    fw_text_add(out, "</ul>\n");
}

/* what nothing of this sheet makes */
static void from_outside(const fw_recipe_header *header, fw_text *out) {
    if (header->noutside == 0) return;
    fw_text_add(
        out, "<p class=\"note\"><b>From outside.</b> What the verdict counts on and no step here "
             "makes:</p>\n<ul>\n");
    for (int i = 0; i < header->noutside; i++) {
        fw_text_add(out, "<li>");
        fw_text_escaped(out, header->outside[i].text);
        fw_text_printf(out, " [FW-D%03d]</li>\n", header->outside[i].number);
    }
    fw_text_add(out, "</ul>\n");
}

static void summary_row(const fw_process_step *s, fw_text *out) {
    const fw_process_time *t = &s->time;
    fw_text_add(out, "<tr><td class=\"id\"><span class=\"box\"></span><a href=\"#");
    fw_text_escaped(out, s->id);
    fw_text_add(out, "\">");
    fw_text_escaped(out, s->id);
    fw_text_add(out, "</a></td><td>");
    fw_text_escaped(out, s->title);
    fw_text_printf(out, "%s</td><td>%s</td>", s->second_signature ? " <b>(2)</b>" : "",
                   s->in_source ? "source" : "added");
    if (!t->computable) {
        fw_text_add(out, "<td colspan=\"5\"><b>NOT COMPUTABLE</b></td></tr>\n");
        return;
    }
    const double value[] = {t->nominal_s, t->first_look_s, t->clear_by_s, t->stop_s};
    for (int i = 0; i < 4; i++) {
        fw_text_add(out, "<td class=\"n\">");
        fw_schedule_put_duration(out, value[i]);
        fw_text_add(out, "</td>");
    }
    fw_text_add(out, "<td class=\"n\">");
    fw_schedule_put_duration(out, s->booked_s);
    fw_text_add(out, "</td></tr>\n");
}

/* what stood before this step ("": at the end) and is not for this device, struck out with its reason */
static void left_out(const fw_process_flow *flow, const char *before, const char *open,
                     const char *close, fw_text *out) {
    for (int i = 0; i < flow->nleft_out; i++) {
        const fw_process_left_out *l = &flow->left_out[i];
        if (strcmp(l->before, before) != 0) continue;
        fw_text_printf(out, "%s<s>", open);
        fw_text_escaped(out, l->id);
        fw_text_add(out, "&ensp;");
        fw_text_escaped(out, l->title);
        fw_text_add(out, "</s>: left out, ");
        fw_text_escaped(out, l->why);
        fw_text_printf(out, ".%s\n", close);
    }
}

static void left_out_row(const fw_process_flow *flow, const char *before, fw_text *out) {
    left_out(flow, before, "<tr><td></td><td colspan=\"7\">", "</td></tr>", out);
}

static void left_out_note(const fw_process_flow *flow, const char *before, fw_text *out) {
    left_out(flow, before, "<p class=\"small\">", "</p>", out);
}

static void summary(const fw_process_flow *flow, fw_text *out) {
    fw_text_add(out,
                "<h3>Steps and times</h3>\n<table class=\"small summary\"><thead><tr><th>Step</th>"
                "<th>Title; (2) needs two signatures</th><th>In</th><th class=\"n\">Planned</th>"
                "<th class=\"n\">First look</th><th class=\"n\">Clear by</th><th class=\"n\">"
                "Stop</th><th class=\"n\">At the machine</th></tr></thead><tbody>\n");
    for (int i = 0; i < flow->nstep; i++) {
        left_out_row(flow, flow->step[i].id, out);
        summary_row(&flow->step[i], out);
    }
    left_out_row(flow, "", out);
    fw_text_printf(out,
                   "<tr><td></td><td><b>Sum of %d computable steps</b></td>"
                   "<td></td><td colspan=\"4\"></td><td class=\"n\"><b>",
                   flow->nstep - flow->not_computable);
    fw_schedule_put_duration(out, flow->total_s);
    fw_text_add(out,
                "</b></td></tr>\n</tbody></table>\n"
                "<p class=\"small\">First look = planned (1 - k u), clear by = planned (1 + k u), "
                "stop = clear by (1 + overrun); u is the relative standard uncertainty of the "
                "time, k = 2. At the machine: planned (1 + overrun), with pauses, with what is "
                "done at the same bench before the wafer leaves it, and with handling."
                "</p>\n");
}

/* those that a value of some step names, in that order; others stand in the pack, and in the report */
static void sources(const fw_process_flow *flow, const int *number, fw_text *out) {
    fw_text_add(out, "<h3>Sources of the values above</h3>\n<ol class=\"small sources\">\n");
    for (int k = 1; k <= flow->nsource; k++)
        for (int i = 0; i < flow->nsource; i++) {
            if (number[i] != k) continue;
            fw_text_add(out, "<li>");
            fw_text_escaped(out, flow->source[i].text);
            fw_text_add(out, " <span class=\"muted\">(");
            fw_text_escaped(out, flow->source[i].kind);
            fw_text_add(out, ")</span></li>\n");
        }
    fw_text_add(out, "</ol>\n");
}

/* the last thing that holds the device, behind the last step */
static fw_status tethers(const fw_recipe_header *header, fw_text *out) {
    const char *words = NULL;
    if (header->mechanism)
        FW_TRY(fw_statics_tethers_words(out->arena, header->mechanism, header->tethers, &words));
    if (!words) return FW_OK;
    fw_text_add(out,
                "<h3>Before use: the tethers</h3>\n<p class=\"note\"><span class=\"box\"></span> ");
    fw_text_escaped(out, words);
    fw_text_add(out, ".</p>\n<p class=\"small\">Broken by, at, instrument: ____________________ "
                     "Hinges whole under the microscope: <span class=\"box\"></span></p>\n");
    return FW_OK;
}

static void rejected(const fw_recipe_header *header, fw_text *out) {
    fw_text_add(out, "<div class=\"rejected\">REJECTED: the verdict rejects this design. Do not "
                     "fabricate.</div>\n");
    if (header->nbecause == 0) return;
    fw_text_add(out, "<ul class=\"because\">\n");
    for (int i = 0; i < header->nbecause; i++) {
        fw_text_add(out, "<li>");
        fw_text_escaped(out, header->because[i]);
        fw_text_add(out, "</li>\n");
    }
    fw_text_add(out, "</ul>\n");
}

fw_status fw_recipe_write_html(const fw_process_flow *flow, const fw_recipe_header *header,
                               fw_text *out) {
    fw_text_add(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "<title>");
    fw_text_add(out, header->rejected ? "REJECTED: " : "");
    fw_text_escaped(out, flow->title);
    fw_text_add(out, ", run sheet</title>\n<style>\n");
    fw_text_add(out, style);
    margin_boxes(flow, header, out);
    fw_text_add(out, "</style>\n</head>\n<body>\n");
    if (header->rejected) rejected(header, out);
    front(flow, header, out);
    judgement(flow, header, out);
    from_outside(header, out);
    wiring(header->wiring, out);
    overrides_table(flow, out);
    put_measurements(header, out);
    summary(flow, out);
    fw_recipe_html_schedule(header, out);
    fw_recipe_slicer slicer;
    fw_recipe_section_scale scale;
    bool cut = header->mask && header->cut;
    int *number;
    if (cut) {
        FW_TRY(fw_recipe_slicer_start(out->arena, header->mask, header->cut, &slicer));
        FW_TRY(fw_recipe_section_scale_of(out->arena, flow, header->cut, &scale));
        FW_TRY(fw_recipe_html_pictures(flow, header, &slicer, &scale, out));
    }
    fw_recipe_html_hazards(flow, out);
    FW_TRY(fw_recipe_html_bill(flow, header, out));
    fw_text_add(out, "<h3>Step by step</h3>\n");
    FW_TRY(fw_recipe_source_numbers(out->arena, flow, &number));
    for (int i = 0; i < flow->nstep; i++) {
        left_out_note(flow, flow->step[i].id, out);
        fw_recipe_html_step(flow, i, header, cut ? &slicer : NULL, &scale, number, out);
    }
    left_out_note(flow, "", out);
    FW_TRY(tethers(header, out));
    fw_recipe_html_deviations(flow, header, out);
    sources(flow, number, out);
    fw_text_add(out, "</body>\n</html>\n");
    return fw_text_end(out);
}
