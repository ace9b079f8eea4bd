/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes to the text of a description that leave every other byte of it as it is: comments, order
   and layout survive. The result is well-formed XML, not necessarily a valid description.

   A path is a parameter's name ("arc": its value), or steps with an attribute behind the last one:
       flexure[A]/@length        scene[step-load]/force[2]/@fx        limits/@safety-factor
   A step is ELEMENT, ELEMENT[ID] (by the attribute that names it) or ELEMENT[N] (the N-th of that
   name, from 1). The first step is looked for in the whole file, the others among the children of
   the one before. Without brackets there must be only one. */
#ifndef FW_DEVICE_EDIT_H
#define FW_DEVICE_EDIT_H
#include "device/device.h"

typedef enum fw_device_text_change_kind {
    FW_CHANGE_SET,   /* attribute `path` becomes `value`; it is added where it is not there; value
                        NULL: it is taken out */
    FW_CHANGE_ADD,   /* <element> with `attribute` as the last child of element `path` ("": of the
                        root) */
    FW_CHANGE_REMOVE /* element `path` with all that is in it */
} fw_device_text_change_kind;

typedef struct fw_device_text_attribute {
    const char *name, *value;
} fw_device_text_attribute;

typedef struct fw_device_text_change {
    fw_device_text_change_kind kind;
    const char *path, *value;
    const char *element;                       /* ADD */
    const fw_device_text_attribute *attribute; /* (nattribute) ADD */
    int nattribute;
} fw_device_text_change;

/* n bytes of XML -> *out. FW_INPUT: the text is no XML, or a change cannot be made (FW-D288): all
   in diags, *out is then of no use.  Cost: one reading per change. */
fw_status fw_device_edit(fw_arena *arena, const char *file, const char *xml, size_t n,
                         const fw_device_text_change *change, int nchange, fw_diags *diags,
                         fw_text *out);

/* ---- the unit that a value is written in ---- */

typedef struct fw_device_written fw_device_written; /* the file of a device, as a tree */
fw_status fw_device_written_open(fw_arena *arena, const fw_device *device,
                                 const fw_device_written **written);
/* Of attribute (or parameter) `path`: the first unit of this dimension in its text; without one there, that of the first
   parameter of this dimension that the text names. What --set gave is not looked at: units are the file's. "": there is none,
   nor is the attribute in the file. Test: test_text_edit.c */
fw_status fw_device_written_unit(fw_arena *arena, const fw_device_written *written,
                                 const char *path, fw_quantity_dimension dimension,
                                 const char **unit);
#endif
