/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a user of the installed library writes, in the common part of C and C++:
   consumer DEVICE.xml OUT [DATA_DIRECTORY]: opens the device from memory, judges, prints the
   decision, writes the results into the directory OUT. The process packs are those that were installed
   with the library, or of DATA_DIRECTORY. Exit status: the decision, 100 + status, or 99: the usage. */
#include <flexwright.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int finish(fw_design *design, int status) {
    for (size_t i = 0; i < fw_design_diagnostics(design); i++) {
        const fw_diagnostic *d = fw_design_diagnostic(design, i);
        fprintf(stderr, "%s:%d:%d: FW-D%03d: %s\n", d->file ? d->file : "", (int)d->line,
                (int)d->column, (int)d->number, d->message);
    }
    if (status != FW_STATUS_OK) fprintf(stderr, "consumer: %s\n", fw_status_name(status));
    int decision = fw_design_decision(design);
    fw_design_free(design);
    return status == FW_STATUS_OK ? decision : 100 + status;
}

/* what a page of one's own would be made from: the table of elements, and shapes and motion */
static int for_a_page(fw_design *design) {
    const int document[2] = {FW_DOCUMENT_TABLE_JSON, FW_DOCUMENT_PREVIEW_JSON};
    const char *begins[2] = {"{\"schema\":\"flexwright.table/1\"",
                             "{\"schema\":\"flexwright.preview/1\",\"status\":\"ok\""};
    for (int i = 0; i < 2; i++) {
        const char *text;
        size_t n;
        int status = fw_design_document(design, document[i], &text, &n);
        if (status != FW_STATUS_OK) return status;
        if (n < 1000 || strncmp(text, begins[i], strlen(begins[i])) != 0) return FW_STATUS_INTERNAL;
    }
    return FW_STATUS_OK;
}

int main(int argc, char **argv) {
    static char xml[1 << 20];
    if (argc < 3 || argc > 4) {
        fprintf(stderr, "usage: consumer DEVICE.xml OUT [DATA_DIRECTORY]\n");
        return 99;
    }
    FILE *file = fopen(argv[1], "rb");
    if (!file) {
        perror(argv[1]);
        return 99;
    }
    size_t n = fread(xml, 1, sizeof xml, file);
    fclose(file);

    fw_design_options options = fw_design_options_default();
    if (argc > 3) options.data_directory = argv[3];
    fw_design *design = fw_design_new(&options);
    if (!design) return 100 + FW_STATUS_NOMEM;
    int status = fw_design_read_memory(design, "device.xml", xml, n);
    if (status == FW_STATUS_OK) status = fw_design_judge(design);
    if (status == FW_STATUS_OK) status = fw_design_fabricate(design);
    if (status == FW_STATUS_OK) status = fw_design_write(design, argv[2], FW_DESIGN_EVERYTHING);
    const char *text;
    if (status == FW_STATUS_OK) status = for_a_page(design);
    if (status == FW_STATUS_OK)
        status = fw_design_document(design, FW_DOCUMENT_VERDICT_TEXT, &text, NULL);
    if (status == FW_STATUS_OK)
        printf("flexwright %s: decision %d\n%s", fw_library_version(), fw_design_decision(design),
               text);
    return finish(design, status);
}
