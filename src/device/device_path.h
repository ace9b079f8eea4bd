/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which element of a description a path names: steps ELEMENT, ELEMENT[ID] or ELEMENT[N] with '/'
   between them, as edit.h says. Private to the room. */
#ifndef FW_DEVICE_DEVICE_PATH_H
#define FW_DEVICE_DEVICE_PATH_H
#include "xml/xml.h"

typedef struct fw_device_path {
    const char *attribute; /* behind "/@"; NULL: the element itself */
    const char *wrong;     /* what is wrong with it; NULL: nothing */
    const char *word;      /* the name that this is about; NULL: none */
    char name[64];
} fw_device_path;

/* false: there is no such element, and out->wrong says why. Test: test_text_edit.c, tests/cli/test_advice.py */
bool fw_device_path_find(fw_xml_element *root, const char *path, fw_xml_element **found,
                         fw_device_path *out);
#endif
