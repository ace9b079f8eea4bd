/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of a study: what was asked, what came of it, the pictures, the best designs. One file that needs
   nothing beside it, readable without script and on paper. */
#include "study/study_parts.h"
#include "study/study_result.h"
#include "study/study_write.h"
#include <math.h>

static void text(fw_text *out, const char *before, const char *content, const char *behind) {
    fw_text_add(out, before);
    fw_text_escaped(out, content);
    fw_text_add(out, behind);
}

static void number(fw_text *out, double value, const char *unit) {
    fw_text_add(out, "<td>");
    if (isnan(value))
        fw_text_add(out, "&ndash;");
    else
        fw_text_number(out, value, 5);
    if (!isnan(value) && *unit) text(out, " ", unit, "");
    fw_text_add(out, "</td>");
}

static void head(const fw_study *study, fw_text *out) {
    fw_text_add(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta "
                     "name=\"viewport\" "
                     "content=\"width=device-width\">");
    text(out, "<title>Study ", study->asked->name, " of ");
    text(out, "", study->device_name,
         "</title>\n<style>body{font:16px/1.5 system-ui,sans-serif;max-width:76rem;margin:1.5rem "
         "auto;padding:0 "
         "1rem;color:#1f2328;background:#fff}table{border-collapse:collapse;margin:.6rem "
         "0}td,th{border-bottom:1px "
         "solid #d0d7de;padding:.25rem "
         ".7rem;text-align:left;vertical-align:top}pre{background:#f6f8fa;padding:.8rem;overflow-x:"
         "auto;white-space:"
         "pre-wrap}figure{display:inline-block;width:min(100%,36rem);margin:.5rem .5rem .5rem "
         "0}figure "
         "svg{width:100%;height:auto}.wide{overflow-x:auto}</style></head>\n<body>\n");
    text(out, "<h1>Study ", study->asked->name, ": ");
    text(out, "", study->device_name, "</h1>\n");
}

static void responses(const fw_study *study, fw_text *out) {
    if (study->nresponse == 0) return;
    fw_text_add(out, "<h2>Responses</h2>\n<div "
                     "class=\"wide\"><table><tr><th>name</th><th>value</th><th>now</th><th>least</"
                     "th><th>largest</th>"
                     "<th>at least</th><th>at most</th></tr>\n");
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_response *q = &study->response[r];
        const fw_study_extreme *e = &study->result->extreme[r];
        text(out, "<tr><td>", q->asked->name, "</td>");
        text(out, "<td><code>", q->asked->value, "</code></td>");
        number(out, q->now, q->unit);
        number(out, e->least, q->unit);
        number(out, e->largest, q->unit);
        number(out, q->asked->min, q->unit);
        number(out, q->asked->max, q->unit);
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</table></div>\n");
}

/* a design with the line that goes on with it */
static void design(const fw_study *study, const fw_study_found *f, fw_text *out) {
    fw_text_add(out, "<tr>");
    for (int r = 0; r < study->nresponse; r++)
        number(out, f->response[r], study->response[r].unit);
    fw_text_add(out, "<td><code>flexwright check ");
    fw_text_escaped(out, study->device_path);
    for (int k = 0; k < study->nvary; k++) {
        text(out, " --set &quot;", study->input[k].what, "=");
        text(out, "", f->text[k], "&quot;");
    }
    fw_text_add(out, "</code></td></tr>\n");
}

static void designs(const fw_study *study, fw_text *out) {
    const fw_study_result *result = study->result;
    if (study->asked->kind != FW_STUDY_IS_size) return;
    fw_text_add(out, result->nfound > 0 ? "<h2>Designs</h2>\n"
                                        : "<h2>No design holds every limit; the nearest</h2>\n");
    fw_text_add(out, "<div class=\"wide\"><table><tr>");
    for (int r = 0; r < study->nresponse; r++)
        text(out, "<th>", study->response[r].asked->name, "</th>");
    fw_text_add(out, "<th>go on with</th></tr>\n");
    for (int i = 0; i < result->nfound; i++)
        design(study, &result->found[i], out);
    if (result->nearest.text) design(study, &result->nearest, out);
    fw_text_add(out, "</table></div>\n");
}

static void figure(const fw_study_picture *p, fw_text *out) {
    fw_text_add(out, "<figure>");
    fw_text_add(out, p->svg.data);
    fw_text_add(out, "</figure>\n");
}

fw_status fw_study_html(const fw_study *study, const fw_study_picture *picture, int n,
                        fw_text *out) {
    fw_text said = fw_text_new(study->arena), asked = fw_text_new(study->arena);
    FW_TRY(fw_study_text(study, &said));
    FW_TRY(fw_study_asked_text(study, &asked));
    head(study, out);
    text(out, "<pre>", said.data, "</pre>\n");
    designs(study, out);
    for (int i = 0; i < n; i++)
        figure(&picture[i], out);
    responses(study, out);
    text(out, "<h2>What was asked</h2>\n<pre>", asked.data, "</pre>\n");
    fw_text_add(out, "<p>All samples are in <code>study.sqlite</code> and <code>study.csv</code>; "
                     "the pictures are files of their own; the numbers above are "
                     "<code>study.json</code>.</p>\n");
    text(out, "<p>flexwright ", FW_VERSION, ", study ");
    fw_text_printf(out, "%.12s, seed %ld</p>\n</body>\n</html>\n", study->hash, study->asked->seed);
    return fw_text_end(out);
}
