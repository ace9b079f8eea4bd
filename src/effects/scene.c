/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the rows say of a scene: in words, what can be made less, and making it less. */
#include "effects/effect.h"
#include <math.h>

void fw_effects_say(const fw_effects_words *words, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    words->write(words->context, format, arguments);
    va_end(arguments);
}

void fw_effects_say_law(const fw_effects_words *words, const fw_quantity_law *law) {
    words->write_law(words->context, law);
}

void fw_effects_describe(const fw_device *device, const fw_device_scene *scene,
                         const fw_effects_words *words) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    for (size_t i = 0; i < count; i++)
        if (row[i]->describe) row[i]->describe(device, scene, words);
}

void fw_effects_add_load(fw_effects_load_scaling *loads, fw_effects_load load) {
    size_t room = sizeof loads->item / sizeof loads->item[0];
    if ((size_t)loads->count < room) loads->item[loads->count++] = load;
}

void fw_effects_find_loads(const fw_device_scene *scene, fw_effects_load_scaling *loads) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    *loads = (fw_effects_load_scaling){0};
    for (size_t i = 0; i < count; i++)
        if (row[i]->loads) row[i]->loads(scene, loads);
}

bool fw_effects_scale(fw_device_scene *scene, double by) {
    size_t count;
    fw_effects_load_scaling loads;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    for (size_t i = 0; i < count; i++)
        if (row[i]->scale) row[i]->scale(scene, by);
    fw_effects_find_loads(scene, &loads);
    return loads.count > 0;
}
