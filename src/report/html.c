/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page is HTML and well-formed XML at once, needs no network (its content policy forbids it)
   and reads without script. */
#include "report/figure.h"

static const struct {
    const char *id, *title;
    fw_status (*write)(fw_page *page);
} sections[] = {
    {"device", "Device", fw_report_section_device},
    {"hinges", "Hinges", fw_report_section_hinges},
    {"made", "As fabricated", fw_report_section_made},
    {"motion", "Motion", fw_report_section_motion},
    {"workspace", "Workspace", fw_report_section_workspace},
    {"flows", "Flows", fw_report_section_flows},
    {"masks", "Masks", fw_report_section_masks},
    {"recipes", "Recipes", fw_report_section_recipes},
    {"effects", "Effects", fw_report_section_effects},
    {"accuracy", "Accuracy", fw_report_section_accuracy},
    {"assumptions", "Assumptions", fw_report_section_assumptions},
    {"messages", "Messages", fw_report_section_messages},
};

enum { SECTIONS = sizeof sections / sizeof sections[0], DRAWING_WIDTH = 640 };

static void head(fw_page *page) {
    fw_markup(page->out,
              "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n"
              "<head>\n<meta charset=\"utf-8\"/>\n"
              "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
              "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
              "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\"/>\n"
              "<meta name=\"generator\" content=\"Flexwright {s}\"/>\n"
              "<title>{s}: {r}</title>\n<style>\n{r}</style>\n</head>\n<body>\n",
              page->in->version, page->in->device->name,
              fw_report_decision_word(page->in->verdict->decision), fw_report_style);
}

static void navigation(fw_page *page) {
    fw_text_add(page->out, "<nav aria-label=\"Sections\"><div class=\"in\">");
    for (int i = 0; i < SECTIONS; i++)
        fw_markup(page->out, "<a href=\"#{r}\">{r}</a>\n", sections[i].id, sections[i].title);
    fw_text_add(page->out, "</div></nav>\n");
}

/* one view for the drawing and all scenes, so that their shapes are shared */
static fw_status survey(fw_page *page) {
    const fw_report_input *in = page->in;
    bool drawn = fw_report_drawn(in->layout);
    fw_box reach = fw_report_box_empty();
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_variant_verdict *v = &in->verdict->variant[i];
        for (int k = 0; v->motion && k < in->device->nscene; k++)
            if (v->motion[k]) {
                page->nmotion++;
                if (drawn)
                    fw_report_reach_add(&reach, in->device, in->layout, v->mechanism, v->motion[k]);
                else
                    FW_TRY(fw_report_poses_reach(page->arena, &reach, NULL, v->mechanism,
                                                 v->motion[k]));
            }
    }
    if (!drawn) FW_TRY(fw_figure_rest_reach(page->arena, in->verdict, &reach));
    page->view = !drawn && reach.x1 >= reach.x0
                     ? fw_figure_view(&reach, DRAWING_WIDTH)
                     : fw_report_device_view(in->device, in->layout, &reach, DRAWING_WIDTH);
    return FW_OK;
}

fw_status fw_report_write_html(fw_arena *arena, const fw_report_input *input, fw_text *out) {
    fw_page page = {.arena = arena, .out = out, .in = input};
    FW_TRY(survey(&page));
    head(&page);
    fw_report_banner(&page);
    navigation(&page);
    fw_text_add(out, "<main>\n");
    fw_report_advice(&page);
    for (int i = 0; i < SECTIONS; i++) {
        fw_markup(out,
                  "<section id=\"{r}\" aria-labelledby=\"h-{r}\"><h2 id=\"h-{r}\">{r}"
                  "</h2>\n",
                  sections[i].id, sections[i].id, sections[i].id, sections[i].title);
        FW_TRY(sections[i].write(&page));
        fw_text_add(out, "</section>\n");
    }
    fw_markup(out,
              "</main>\n<footer><p>Flexwright {s}. The same input gives the same bytes: this "
              "page holds no date and no run time.</p></footer>\n"
              "<script>//<![CDATA[\n{r}//]]></script>\n</body>\n</html>\n",
              input->version, fw_report_script);
    return fw_text_end(out);
}
