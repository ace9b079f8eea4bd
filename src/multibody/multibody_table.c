/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The methods that can be asked for by name. */
#include "multibody/method.h"
#include <string.h>

#define FW_MULTIBODY_METHOD(name) extern const fw_multibody_method fw_multibody_method_##name;
#include "multibody/methods.def"
#undef FW_MULTIBODY_METHOD
#define FW_MULTIBODY_METHOD(name) &fw_multibody_method_##name,
static const fw_multibody_method *const methods[] = {
#include "multibody/methods.def"
};
#undef FW_MULTIBODY_METHOD
enum { METHODS = sizeof methods / sizeof methods[0] };

const fw_multibody_method *fw_multibody_method_find(const char *name) {
    if (!name) return methods[0];
    for (size_t i = 0; i < METHODS; i++)
        if (strcmp(methods[i]->name, name) == 0) return methods[i];
    return NULL;
}

fw_multibody_method_row fw_multibody_method_at(size_t i) {
    return i < METHODS ? (fw_multibody_method_row){methods[i]->name, methods[i]->summary}
                       : (fw_multibody_method_row){NULL, NULL};
}
