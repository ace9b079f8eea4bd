/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The guard against an independent list of what is right, and every single change of a right
 * request. */
#include "serve/server.h"
#include "test.h"

static fw_serve_guard guard;

static fw_serve_guard_facts reading(void) {
    static char cookie[160];
    snprintf(cookie, sizeof cookie, "other=1; %s=%s; more=2", guard.cookie_name, guard.cookie);
    return (fw_serve_guard_facts){.version = "HTTP/1.1",
                                  .method = "GET",
                                  .path = "/api/session",
                                  .host = guard.host[0],
                                  .cookie = cookie,
                                  .head_bytes = 100,
                                  .seen_bytes = 100};
}

static fw_serve_guard_facts writing(void) {
    fw_serve_guard_facts f = reading();
    f.method = "POST";
    f.path = "/api/jobs";
    f.origin = guard.origin[0];
    f.fetch_site = "same-origin";
    f.content_type = "application/json";
    f.content_length = "1048576";
    f.token = guard.header;
    return f;
}

static int fresh(void **state) {
    (void)state;
    return fw_serve_guard_new(&guard, 8931, true) ? 0 : -1;
}

static unsigned check(fw_serve_guard_facts f) {
    fw_serve_refusal r = fw_serve_guard_check(&guard, &f);
    assert_int_equal(r.status == 0, r.why == NULL);
    return r.status;
}

static void what_is_right_goes_on(void **state) {
    (void)state;
    assert_int_equal(check(reading()), 0);
    fw_serve_guard_facts f = writing();
    assert_int_equal(check(f), 0);
    assert_int_equal(fw_serve_guard_body(&f), 1048576);
    f.method = "DELETE", f.content_length = f.content_type = NULL;
    assert_int_equal(check(f), 0);
    assert_int_equal(fw_serve_guard_body(&f), 0);
    f = reading();
    f.fetch_site = "none";
    assert_int_equal(check(f), 0);
    f.host = "[::1]:8931", f.origin = "http://[::1]:8931", f.fetch_site = "same-origin";
    assert_int_equal(check(f), 0);
    f.head_bytes = 90; /* no blank behind the colons */
    assert_int_equal(check(f), 0);
}

/* each line: a right request with one thing changed, and the status that it gets */
#define ONE(from, change, status)                                                                  \
    do {                                                                                           \
        fw_serve_guard_facts f = from();                                                           \
        change;                                                                                    \
        assert_int_equal(check(f), status);                                                        \
    } while (0)

static void every_single_change_is_refused(void **state) {
    (void)state;
    ONE(reading, f.version = "HTTP/1.0", 505);
    ONE(reading, f.version = "", 505);
    ONE(reading, f.method = "HEAD", 405);
    ONE(reading, f.method = "get", 405);
    ONE(reading, f.path = "/api/sessio%6e", 400);
    ONE(reading, f.path = "/../etc", 400);
    ONE(reading, f.path = "//etc", 400);
    ONE(reading, f.path = "api", 400);
    ONE(reading, f.path = "", 400);
    ONE(reading, f.path = "/\xc3\xa4", 400);
    ONE(reading, f.query = true, 400);
    ONE(reading, f.repeated = true, 400);
    ONE(reading, f.head_bytes = 101, 400);
    ONE(reading, f.host = NULL, 421);
    ONE(reading, f.host = "127.0.0.1", 421);
    ONE(reading, f.host = "127.0.0.1:89310", 421);
    ONE(reading, f.host = "localhost:8931", 421);
    ONE(reading, f.origin = "null", 403);
    ONE(reading, f.origin = "", 403);
    ONE(reading, f.origin = "http://127.0.0.1:8932", 403);
    ONE(reading, f.origin = guard.origin[1], 403); /* ours, but of the other address */
    ONE(reading, f.fetch_site = "cross-site", 403);
    ONE(reading, f.fetch_site = "same-site", 403);
    ONE(reading, f.fetch_site = "", 403);
    ONE(writing, f.fetch_site = "none", 403);
    ONE(reading, f.cookie = NULL, 401);
    ONE(reading, f.cookie = "", 401);
    ONE(reading, f.cookie = guard.cookie, 401);
    ONE(writing, f.token = NULL, 403);
    ONE(writing, f.token = "", 403);
    ONE(writing, f.token = guard.cookie, 403);
    ONE(writing, f.content_type = NULL, 415);
    ONE(writing, f.content_type = "text/plain", 415);
    ONE(writing, f.content_length = NULL, 411);
    ONE(writing, f.content_length = "1048577", 413);
    ONE(writing, f.content_length = "-1", 400);
    ONE(writing, f.content_length = "9999999999", 400);
    ONE(writing, f.content_length = "", 400);
    ONE(writing, f.transfer_encoding = "chunked", 411);
    ONE(writing, f.odd_name = true, 400);
    ONE(writing, f.transfer_encoding = "identity", 411);
    ONE(reading, f.content_length = "1", 400);
}

static void a_cookie_with_one_other_digit(void **state) {
    (void)state;
    char cookie[160];
    for (int i = 0; i < 64; i++) {
        fw_serve_guard_facts f = reading();
        int n = snprintf(cookie, sizeof cookie, "%s=", guard.cookie_name);
        snprintf(cookie + n, sizeof cookie - (size_t)n, "%s", guard.cookie);
        cookie[n + i] = cookie[n + i] == 'f' ? '0' : 'f';
        f.cookie = cookie;
        assert_int_equal(check(f), 401);
    }
}

static void the_token_opens_once(void **state) {
    (void)state;
    fw_serve_guard_facts f = reading();
    f.path = "/", f.cookie = NULL, f.query = true, f.entry = guard.entry;
    assert_true(fw_serve_guard_is_entry(&f));
    assert_int_equal(check(f), 0);
    f.entry = guard.cookie;
    assert_int_equal(check(f), 403);
    f.entry = "";
    assert_int_equal(check(f), 403);
    guard.entry_used = true;
    f.entry = guard.entry;
    assert_int_equal(check(f), 403);
    f.path = "/api/session";
    assert_int_equal(check(f), 400);
}

static void secrets_are_new_and_whole(void **state) {
    (void)state;
    fw_serve_guard other;
    assert_true(fw_serve_guard_new(&other, 8931, false));
    assert_int_equal(strlen(other.cookie), 64);
    assert_string_not_equal(other.cookie, guard.cookie);
    assert_string_not_equal(other.cookie, other.header);
    assert_string_not_equal(other.cookie, other.entry);
    fw_serve_guard_facts f = reading();
    assert_int_equal(fw_serve_guard_check(&other, &f).status, 401);
    f.host = f.origin = "[::1]:8931"; /* this one does not listen there */
    assert_int_equal(fw_serve_guard_check(&other, &f).status, 421);
}

static void a_token_is_compared_whole(void **state) {
    (void)state;
    char nearly[FW_SERVE_SECRET + 1];
    fw_serve_guard_facts f = writing();
    snprintf(nearly, sizeof nearly, "%sx", guard.header);
    f.token = nearly;
    assert_int_equal(fw_serve_guard_check(&guard, &f).status, 403);
    nearly[64] = '\0';
    assert_int_equal(fw_serve_guard_check(&guard, &f).status, 0);
    nearly[63] ^= 1;
    assert_int_equal(fw_serve_guard_check(&guard, &f).status, 403);
    nearly[63] = '\0';
    assert_int_equal(fw_serve_guard_check(&guard, &f).status, 403);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_is_right_goes_on, fresh),
        cmocka_unit_test_setup(every_single_change_is_refused, fresh),
        cmocka_unit_test_setup(a_token_is_compared_whole, fresh),
        cmocka_unit_test_setup(a_cookie_with_one_other_digit, fresh),
        cmocka_unit_test_setup(the_token_opens_once, fresh),
        cmocka_unit_test_setup(secrets_are_new_and_whole, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
