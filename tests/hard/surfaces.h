/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference six-bar of the gallery as its file describes it, with scenes of the test's own. */
#ifndef FW_TEST_SURFACES_H
#define FW_TEST_SURFACES_H
#include "hard.h"
#include "layout/layout.h"

static inline char *surfaces_file(fw_arena *arena, const char *name, size_t *n) {
    FILE *file = fopen(name, "rb");
    size_t room = (size_t)1 << 20;
    char *text = fw_arena_array(arena, char, room);
    if (!file) fail_msg("%s", name);
    *n = fread(text, 1, room - 1, file);
    fclose(file);
    return text;
}

static inline void surfaces_need(fw_status status, const fw_diags *diags) {
    if (status != FW_OK) fail_msg("%s", diags->count ? diags->item[0].message : "no diagnostic");
}

/* the description with `scenes` (XML) before its <die> */
static inline const fw_device *surfaces_device(fw_arena *arena, const char *scenes,
                                               fw_diags *diags) {
    size_t n;
    const fw_device *device = NULL;
    const char *name = FW_TEST_SOURCE_DIR "/docs/gallery/reference-six-bar/device.xml";
    const char *own = surfaces_file(arena, name, &n), *die = strstr(own, "<die");
    assert_non_null(die);
    size_t room = n + strlen(scenes) + 1;
    char *xml = fw_arena_array(arena, char, room);
    snprintf(xml, room, "%.*s%s%s", (int)(die - own), own, scenes, die);
    surfaces_need(fw_device_read(arena, name, xml, strlen(xml), NULL, 0, diags, &device), diags);
    return device;
}

static inline const fw_mechanism *surfaces_mechanism(fw_arena *arena, const fw_device *d,
                                                     fw_diags *diags) {
    size_t n;
    fw_device_materials all;
    const char *base = FW_TEST_SOURCE_DIR "/processes/base.xml";
    const char *xml = surfaces_file(arena, base, &n);
    surfaces_need(fw_device_materials_read(arena, base, xml, n, diags, &all), diags);
    fw_mechanism_variant *v = fw_arena_one(arena, fw_mechanism_variant);
    const fw_layout *layout = NULL;
    const fw_mechanism *m = NULL;
    *v = (fw_mechanism_variant){.material = fw_device_material_with(
                                    fw_device_material_find(&all, d->material_ref), &d->material),
                                .thickness_m = d->thickness_m,
                                .explicit_mass_scale = 1,
                                .explicit_stiffness_scale = 1,
                                .explicit_damping_scale = 1};
    surfaces_need(fw_layout_build(arena, d, diags, &layout), diags);
    surfaces_need(fw_mechanism_build(arena, d, layout, v, diags, &m), diags);
    return m;
}

static inline rig surfaces_rig(fw_arena *arena, const char *scenes, const char *scene) {
    fw_diags diags = fw_diags_new(arena);
    const fw_device *d = surfaces_device(arena, scenes, &diags);
    rig r = {.m = *surfaces_mechanism(arena, d, &diags)};
    for (int i = 0; i < d->nscene; i++)
        if (strcmp(d->scene[i].name, scene) == 0) r.scene = d->scene[i];
    assert_non_null(r.scene.name);
    return r;
}

#endif
