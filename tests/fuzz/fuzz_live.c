/* SPDX-License-Identifier: GPL-3.0-or-later */
/* libFuzzer: any bytes as a request to the four functions behind the page. The first byte chooses
   the function; small mechanisms, so that a run is short. An answer that is no JSON, or a document
   without a status, is a crash, too. Run: fuzz_live -dict=tests/fuzz/device.dict CORPUS */
#include "plan/live.h"
#include <jansson.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static fw_plan_live *live;

static void check(fw_plan_live_answer a) {
    json_error_t error;
    if (!a.text || strlen(a.text) != a.length) __builtin_trap();
    json_t *root = json_loadb(a.text, a.length, JSON_REJECT_DUPLICATES, &error);
    if (!root) __builtin_trap();
    const json_t *wrong = json_object_get(root, "error");
    if (a.status == FW_OK ? !json_object_get(root, "schema") || wrong
                          : !json_is_string(json_object_get(wrong, "message")))
        __builtin_trap();
    json_decref(root);
}

/* the rest of the input as the text of a request that is otherwise whole */
static void as_text(const uint8_t *data, size_t n, unsigned which) {
    static const char *const more[] = {"{\"options\":{\"samples\":3,\"effects\":\"none\"}}",
                                       "{\"platform\":{\"x_m\":1e-5}}",
                                       ("{\"changes\":[{\"path\":\"arc\",\"value\":\"<\\\"&\"},{"
                                        "\"add\":\"\",\"element\":\"flow\"},"
                                        "{\"remove\":\"scene[1]\"}]}")};
    json_t *root = json_loads(more[which % 3], 0, NULL);
    json_t *text = json_stringn((const char *)data, n);
    if (root && text) {
        json_object_set(root, "text", text);
        char *request = json_dumps(root, 0);
        if (request)
            check(which % 3 == 0   ? fw_plan_live_preview(live, request, strlen(request))
                  : which % 3 == 1 ? fw_plan_live_pose(live, request, strlen(request))
                                   : fw_plan_live_edit(live, request, strlen(request)));
        free(request);
    }
    json_decref(text);
    json_decref(root);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n) {
    const fw_plan_live_settings settings = {.memory_cap = (size_t)64 * 1024 * 1024};
    if (n == 0) return 0;
    if (!live) live = fw_plan_live_new(&settings);
    if (!live) return 0;
    unsigned which = data[0];
    const char *request = (const char *)data + 1;
    if (which & 0x80)
        as_text(data + 1, n - 1, which);
    else
        check(which % 3 == 0   ? fw_plan_live_preview(live, request, n - 1)
              : which % 3 == 1 ? fw_plan_live_pose(live, request, n - 1)
                               : fw_plan_live_edit(live, request, n - 1));
    return 0;
}
