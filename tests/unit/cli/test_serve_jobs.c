/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A job of the page is a command line that the program takes: every option of every kind. */
#include "cli/cli.h"
#include "serve/jobs.h"
#include "test.h"
#include <jansson.h>

static const char *const kinds[] = {"plan",    "check",    "workspace", "modes",
                                    "statics", "assemble", "tradeoff",  "hinge",
                                    "recipe",  "mask",     "simulate",  "study"};

/* a good value for each, and one kind that takes it */
static const struct {
    const char *name, *value, *kind;
} options[] = {
    {"flow", "\"al-masked-rie\"", "check"},
    {"accuracy", "0.01", "check"},
    {"effects", "\"auto\"", "check"},
    {"corners", "\"none\"", "check"},
    {"advice", "\"none\"", "check"},
    {"hinge_model", "\"revolute\"", "check"},
    {"force", "true", "mask"},
    {"mask_tolerance", "5", "mask"},
    {"mask_flatten", "\"inside\"", "mask"},
    {"mask_format", "\"gds,svg\"", "mask"},
    {"mask_vertices", "4094", "mask"},
    {"wafers", "3", "recipe"},
    {"operators", "\"2\"", "recipe"},
    {"day", "\"none\"", "recipe"},
    {"planned", "\"S03=90 min\"", "plan"},
    {"scene", "\"a\"", "modes"},
    {"at", "\"rest\"", "modes"},
    {"path", "true", "statics"},
    {"method", "\"chain\"", "simulate"},
    {"integrator", "\"auto\"", "simulate"},
    {"stabilise", "\"none\"", "simulate"},
    {"rtol", "1e-9", "simulate"},
    {"samples", "1001", "simulate"},
    {"independent", "\"AB.phi\"", "assemble"},
    {"rates", "\"1 rad/s\"", "assemble"},
    {"accelerations", "\"1 rad/s^2\"", "assemble"},
    {"level", "\"auto\"", "hinge"},
    {"budget", "30", "tradeoff"},
    {"no_time", "true", "tradeoff"},
    {"study", "\"widths\"", "study"},
    {"lab", "\"lab.xml\"", "recipe"},
};
enum { NKINDS = sizeof kinds / sizeof kinds[0], NOPTIONS = sizeof options / sizeof options[0] };

static const fw_cli_command *command_named(const char *name) {
    size_t n;
    const fw_cli_command *command = fw_cli_command_table(&n);
    for (size_t i = 0; i < n; i++)
        if (strcmp(command[i].name, name) == 0) return &command[i];
    return NULL;
}

static fw_status build(fw_arena *arena, const char *request, const char *const **argv) {
    const char *kind = NULL, *why = NULL;
    json_t *json = json_loads(request, JSON_DECODE_ANY, NULL);
    assert_non_null(json);
    fw_status status = fw_serve_job_command(arena, json, "-device.xml", NULL, &kind, argv, &why);
    assert_true((status == FW_OK) == (why == NULL));
    json_decref(json);
    return status;
}

static int count(const char *const *argv) {
    int n = 0;
    while (argv[n])
        n++;
    return n;
}

static bool has(const char *const *argv, const char *start) {
    for (int i = 0; argv[i]; i++)
        if (strncmp(argv[i], start, strlen(start)) == 0) return true;
    return false;
}

/* the page sends all its options to every kind: the command line has those that it takes */
static void every_kind_with_all_options(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text all = fw_text_new(arena);
    for (int i = 0; i < NOPTIONS; i++)
        fw_text_printf(&all, "%s\"%s\": %s", i ? ", " : "", options[i].name, options[i].value);
    for (int k = 0; k < NKINDS; k++) {
        const fw_cli_command *command = command_named(kinds[k]);
        if (!command) continue; /* not in this version: the job says so */
        const char *const *argv;
        const char *request = fw_arena_printf(
            arena,
            "{\"kind\": \"%s\", \"set\": {\"arc\": \"250 deg\", \"n\": 3}, \"files\": "
            "{\"lab.xml\": \"\"}, \"options\": {%s}}",
            kinds[k], all.data);
        assert_int_equal(build(arena, request, &argv), FW_OK);
        fw_cli_options parsed = {.design = fw_design_options_default()};
        assert_true(fw_cli_parse(command, count(argv), (char **)(uintptr_t)argv, &parsed));
        assert_string_equal(parsed.device, "-device.xml");
        assert_string_equal(parsed.output, "out");
        assert_true(parsed.json && parsed.verbose && parsed.nset == 2);
        assert_string_equal(parsed.set[0].value, "250 deg");
        assert_string_equal(parsed.set[1].value, "3");
        fw_cli_options_free(&parsed);
    }
    fw_arena_free(arena);
}

static void each_option_arrives(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (int i = 0; i < NOPTIONS; i++) {
        const char *const *argv;
        const char *request = fw_arena_printf(arena,
                                              "{\"kind\": \"%s\", \"files\": {\"lab.xml\": \"\"}, "
                                              "\"options\": {\"%s\": %s}}",
                                              options[i].kind, options[i].name, options[i].value);
        assert_int_equal(build(arena, request, &argv), FW_OK);
        char *option = fw_arena_printf(arena, "--%s", options[i].name);
        for (char *c = option; *c; c++)
            if (*c == '_') *c = '-';
        if (!has(argv, option)) fail_msg("%s does not arrive", option);
    }
    fw_arena_free(arena);
}

static void what_is_not_in_the_table_cannot_be_said(void **state) {
    (void)state;
    static const char *const refused[] = {
        "{}",
        "[]",
        "{\"kind\": \"serve\"}",
        "{\"kind\": \"log\", \"options\": {\"run\": \"lot.log\"}}", /* there is nothing beside */
        "{\"kind\": \"log\", \"options\": {\"entries\": \"/etc/passwd\"}}",
        "{\"kind\": \"log\", \"options\": {\"report\": \"/tmp/x\"}}",
        "{\"kind\": 7}",
        "{\"kind\": \"check\", \"options\": {\"lab\": \"x\"}}",
        ("{\"kind\": \"check\", \"files\": {\"lab.xml\": \"\"}, \"options\": {\"lab\": "
         "\"/etc/passwd\"}}"),
        "{\"kind\": \"check\", \"files\": {\"../lab.xml\": \"\"}}",
        "{\"kind\": \"check\", \"files\": {\"d.xml\": \"\"}}",
        "{\"kind\": \"check\", \"files\": {\"-o.xml\": \"\"}}",
        "{\"kind\": \"check\", \"files\": {\"printed\": \"\"}}",
        "{\"kind\": \"check\", \"files\": {\"archive.zip\": \"\"}}",
        "{\"kind\": \"check\", \"files\": {\"lab.xml\": 3}}",
        "{\"kind\": \"check\", \"files\": [\"lab.xml\"]}",
        "{\"kind\": \"check\", \"options\": {\"output\": \"x\"}}",
        "{\"kind\": \"check\", \"options\": {\"svg\": \"x\"}}",
        "{\"kind\": \"hinge\", \"options\": {\"deck\": \"x\"}}",
        "{\"kind\": \"check\", \"options\": {\"hinge-model\": \"x\"}}",
        "{\"kind\": \"check\", \"options\": {\"accuracy\": []}}",
        "{\"kind\": \"check\", \"options\": 3}",
        "{\"kind\": \"check\", \"set\": {\"a=b\": \"1\"}}",
        "{\"kind\": \"check\", \"set\": {\"a\": \"x\\u0000y\"}}"};
    fw_arena *arena = fw_arena_new(0);
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        const char *const *argv;
        const char *kind, *why = NULL;
        json_t *json = json_loads(refused[i], JSON_ALLOW_NUL, NULL);
        assert_non_null(json);
        if (fw_serve_job_command(arena, json, "d.xml", NULL, &kind, &argv, &why) != FW_INPUT || !why)
            fail_msg("%s is taken", refused[i]);
        json_decref(json);
    }
    fw_arena_free(arena);
}

/* a value that looks like an option stays a value */
static void values_stay_values(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *const *argv;
    assert_int_equal(build(arena,
                           "{\"kind\": \"check\", \"set\": {\"--json\": \"--output=/x\"}, "
                           "\"options\": {\"flow\": \"--output=/x\"}}",
                           &argv),
                     FW_OK);
    assert_true(has(argv, "--set=--json=--output=/x") && has(argv, "--flow=--output=/x"));
    assert_false(has(argv, "--output=/x"));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_with_all_options),
        cmocka_unit_test(each_option_arrives),
        cmocka_unit_test(what_is_not_in_the_table_cannot_be_said),
        cmocka_unit_test(values_stay_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
