/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/study_write.h"
#include "base/output.h"
#include "study/study_parts.h"
#include <sys/stat.h>

static fw_output_member member(const char *name, const fw_text *text) {
    return (fw_output_member){name, text->data, text->length};
}

/* pictures of an earlier study in the directory went when its store did */
static fw_status write_pictures(fw_study *study, const fw_study_picture *picture, int n) {
    fw_output_member *file = fw_arena_array(study->arena, fw_output_member, (size_t)n);
    const char *directory = fw_arena_printf(study->arena, "%s/pictures", study->options.output);
    FW_NEED(file && directory ? file : NULL);
    for (int i = 0; i < n; i++) {
        const char *name = fw_arena_printf(study->arena, "%s.svg", picture[i].name);
        fw_text svg = fw_text_new(study->arena);
        fw_text_add(&svg, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        fw_text_add(&svg, picture[i].svg.data);
        FW_TRY(fw_text_end(&svg));
        FW_NEED(name);
        file[i] = member(name, &svg);
    }
    if (n == 0) return FW_OK;
    mkdir(directory, 0777); /* what is wrong with it, writing will say */
    return fw_output_members(study->arena, directory, file, (size_t)n, &study->diags);
}

fw_status fw_study_write(fw_study *study) {
    fw_text json = fw_text_new(study->arena), html = fw_text_new(study->arena);
    const fw_study_picture *picture;
    int n;
    const char *csv = fw_arena_printf(study->arena, "%s/study.csv", study->options.output);
    FW_NEED(csv);
    FW_TRY(fw_study_json(study, &json));
    FW_TRY(fw_study_pictures(study, &picture, &n));
    FW_TRY(fw_study_html(study, picture, n, &html));
    FW_TRY(fw_study_csv_save(study, csv));
    FW_TRY(write_pictures(study, picture, n));
    const fw_output_member file[] = {member("study.html", &html), member("study.json", &json)};
    return fw_output_members(study->arena, study->options.output, file, 2, &study->diags);
}
