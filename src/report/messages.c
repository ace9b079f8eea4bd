/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include <string.h>

/* the path of a --set is no file path; the rest as fw_place_file */
static const char *file_of(fw_place place) {
    bool option = place.file && strncmp(place.file, "--set", 5) == 0;
    return option ? place.file : fw_place_file(place);
}

fw_status fw_report_section_messages(fw_page *page) {
    static const char *const word[] = {"note", "warning", "error"};
    const fw_diags *diags = page->in->diags;
    fw_text *out = page->out;
    if (!diags || diags->count == 0) {
        fw_text_add(out, "<p>No warnings.</p>\n");
        return fw_text_end(out);
    }
    fw_text_add(out,
                "<div class=\"wide\"><table><thead><tr><th scope=\"col\">Kind</th><th "
                "scope=\"col\">Place</th><th scope=\"col\">Message</th><th scope=\"col\">Code</th>"
                "</tr></thead><tbody>\n");
    for (size_t i = 0; i < diags->count; i++) {
        const fw_diag *d = &diags->item[i];
        if (d->number == 230)
            continue; /* how the program was called is no property of the device */
        fw_markup(out, "<tr><td>{r}</td><td>{s}", word[d->severity], file_of(d->place));
        if (d->place.line > 0) fw_markup(out, ":{i}:{i}", d->place.line, d->place.column);
        fw_markup(out, "</td><td>{s}</td><td>", d->message);
        fw_text_printf(out, "FW-D%03d</td></tr>\n", d->number);
    }
    fw_text_add(out, "</tbody></table></div>\n");
    if (diags->dropped) fw_markup(out, "<p>{l} more are not shown.</p>\n", (long)diags->dropped);
    return fw_text_end(out);
}
