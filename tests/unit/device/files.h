/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Test files into an arena. */
#ifndef FW_TEST_FILES_H
#define FW_TEST_FILES_H
#include "device/device.h"
#include "test.h"

static inline char *load(fw_arena *arena, const char *name, size_t *n) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", FW_TEST_SOURCE_DIR, name);
    FILE *f = fopen(path, "rb");
    if (!f) fail_msg("%s cannot be opened", path);
    fseek(f, 0, SEEK_END);
    long size = ftell(f);
    rewind(f);
    char *data = fw_arena_alloc(arena, (size_t)size + 1, 1);
    assert_non_null(data);
    *n = fread(data, 1, (size_t)size, f);
    fclose(f);
    assert_int_equal(*n, size);
    return data;
}

#define GALLERY "docs/gallery/reference-six-bar/device.xml"

/* reads a device that must be sound */
static inline const fw_device *sound(fw_arena *arena, const char *xml, const fw_device_set *set,
                                     int nset) {
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    fw_status s = fw_device_read(arena, "t.xml", xml, strlen(xml), set, nset, &diags, &device);
    if (s != FW_OK || diags.count > 0)
        fail_msg("%s: %s", fw_status_text(s), diags.count ? diags.item[0].message : "");
    return device;
}

/* the only error must be this one */
static inline void only_error(fw_arena *arena, const char *xml, const fw_device_set *set, int nset,
                              int number, const char *says) {
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device; /* may be what was understood, for looking up references */
    assert_int_equal(fw_device_read(arena, "t.xml", xml, strlen(xml), set, nset, &diags, &device),
                     FW_INPUT);
    if (diags.errors != 1 || diags.item[0].number != number || !strstr(diags.item[0].message, says))
        fail_msg("%zu errors, %d: %s", diags.errors, diags.count ? diags.item[0].number : 0,
                 diags.count ? diags.item[0].message : "");
}

#define DEVICE(body) "<device xmlns=\"urn:flexwright:device:1\" name=\"d\">" body "</device>"
#define ARM                                                                                        \
    "<mechanism><body id=\"arm\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"0 mm\" y=\"0 mm\"/>"      \
    "</mechanism>"
#endif
