/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a PDF has around the operators of its page: the fonts that every reader has, with their letters and how wide
   they are, and the objects of the file. */
#include "report/report_page.h"
#include <stddef.h>

/* widths of Helvetica and its bold face from the blank to ~, in thousandths (Adobe's metrics of the base fonts) */
static const short width_of[2][95] = {
    {278,  278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
     556,  556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
     1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
     667,  778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
     333,  556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
     556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584},
    {278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278,
     556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 333, 333, 584, 584, 584, 611,
     975, 722, 722, 722, 722, 667, 611, 778, 722, 278, 556, 722, 611, 833, 722, 778,
     667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 333, 278, 333, 584, 556,
     333, 556, 611, 556, 611, 556, 333, 611, 611, 278, 278, 556, 278, 889, 611, 611,
     611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389, 280, 389, 584}};

static const struct {
    unsigned letter;
    unsigned char code;
    short width;
} symbol[] = {/* of the font Symbol */
              {0x2212, 0x2d, 549}, {0x2192, 0xae, 987}, {0x2190, 0xac, 987}, {0x2264, 0xa3, 549},
              {0x2265, 0xb3, 549}, {0x2248, 0xbb, 549}, {0x221e, 0xa5, 713}, {0x3b1, 0x61, 631},
              {0x3b2, 0x62, 549},  {0x3b5, 0x65, 439},  {0x3b8, 0x71, 521},  {0x3bc, 0x6d, 576},
              {0x3c0, 0x70, 549},  {0x3c3, 0x73, 603},  {0x3c6, 0x6a, 603},  {0x3c9, 0x77, 686},
              {0x3a9, 0x57, 768},  {0x394, 0x44, 612},  {0x3bb, 0x6c, 549},  {0x3b6, 0x7a, 494}};

bool fw_report_letter_of(unsigned u, bool bold, fw_report_letter *l) {
    static const struct {
        unsigned letter;
        unsigned char code;
        short width;
    } typographic[] = {{0x2013, 0x96, 556}, {0x2014, 0x97, 1000}, {0x2026, 0x85, 1000},
                       {0x2019, 0x92, 222}, {0x2022, 0x95, 350},  {0x20ac, 0x80, 556}};
    *l = (fw_report_letter){bold ? 2 : 1, (unsigned char)u, 0.556};
    if (u >= 32 && u < 127) l->width = width_of[bold][u - 32] / 1000.0;
    if (u == 0xa0 || u == 0xb7) l->width = 0.278;
    if (u == 0xb0) l->width = 0.4;
    if (u == 0xb2 || u == 0xb3 || u == 0xb9) l->width = 0.333;
    if (u == 0xb1 || u == 0xd7) l->width = 0.584;
    if (u == 0x202f || u == 0x2009) *l = (fw_report_letter){l->font, ' ', 0.278};
    if ((u >= 32 && u < 127) || (u >= 0xa0 && u < 0x100) || l->code == ' ') return true;
    for (size_t i = 0; i < sizeof typographic / sizeof typographic[0]; i++)
        if (typographic[i].letter == u) {
            *l = (fw_report_letter){l->font, typographic[i].code, typographic[i].width / 1000.0};
            return true;
        }
    for (size_t i = 0; i < sizeof symbol / sizeof symbol[0]; i++)
        if (symbol[i].letter == u) {
            *l = (fw_report_letter){3, symbol[i].code, symbol[i].width / 1000.0};
            return true;
        }
    return false;
}

/* the file around a page's operators: objects, where each begins, no date */
void fw_report_pdf_file(const fw_text *page, double wide, double high, const double (*state)[2],
                        int nstate, fw_text *pdf) {
    static const char *const font[] = {"Helvetica/Encoding/WinAnsiEncoding",
                                       "Helvetica-Bold/Encoding/WinAnsiEncoding", "Symbol"};
    size_t at[8];
    int n = 0;
    fw_text_add(pdf, "%PDF-1.4\n");
    at[++n] = pdf->length;
    fw_text_printf(pdf, "%d 0 obj<</Type/Catalog/Pages 2 0 R>>endobj\n", n);
    at[++n] = pdf->length;
    fw_text_printf(pdf, "%d 0 obj<</Type/Pages/Kids[3 0 R]/Count 1>>endobj\n", n);
    at[++n] = pdf->length;
    fw_text_printf(pdf, "%d 0 obj<</Type/Page/Parent 2 0 R/MediaBox[0 0 ", n);
    fw_text_number(pdf, wide, 7);
    fw_text_add(pdf, " ");
    fw_text_number(pdf, high, 7);
    fw_text_add(pdf, " ");
    fw_text_add(pdf,
                "]/Contents 4 0 R/Resources<</Font<</F1 5 0 R/F2 6 0 R/F3 7 0 R>>/ExtGState<<");
    for (int i = 0; i < nstate; i++) {
        fw_text_printf(pdf, "/G%d<</ca ", i);
        fw_text_number(pdf, state[i][0], 7);
        fw_text_add(pdf, " ");
        fw_text_add(pdf, "/CA ");
        fw_text_number(pdf, state[i][1], 7);
        fw_text_add(pdf, " ");
        fw_text_add(pdf, ">>");
    }
    fw_text_add(pdf, ">>>>>>endobj\n");
    at[++n] = pdf->length;
    fw_text_printf(pdf, "%d 0 obj<</Length %zu>>stream\n", n, page->length);
    fw_text_bytes(pdf, page->data, page->length);
    fw_text_add(pdf, "\nendstream endobj\n");
    for (int i = 0; i < 3; i++) {
        at[++n] = pdf->length;
        fw_text_printf(pdf, "%d 0 obj<</Type/Font/Subtype/Type1/BaseFont/%s>>endobj\n", n, font[i]);
    }
    const size_t table = pdf->length;
    fw_text_printf(pdf, "xref\n0 %d\n0000000000 65535 f \n", n + 1);
    for (int i = 1; i <= n; i++)
        fw_text_printf(pdf, "%010zu 00000 n \n", at[i]);
    fw_text_printf(pdf, "trailer<</Size %d/Root 1 0 R>>\nstartxref\n%zu\n%%%%EOF\n", n + 1, table);
}
