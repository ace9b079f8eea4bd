/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "serve/server.h"
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/random.h>

static bool secret(char text[FW_SERVE_SECRET]) {
    unsigned char byte[(FW_SERVE_SECRET - 1) / 2];
    if (getrandom(byte, sizeof byte, 0) != (ssize_t)sizeof byte) return false;
    for (size_t i = 0; i < sizeof byte; i++)
        snprintf(text + 2 * i, 3, "%02x", byte[i]);
    return true;
}

bool fw_serve_guard_new(fw_serve_guard *g, unsigned port, bool ipv6) {
    *g = (fw_serve_guard){.addresses = ipv6 ? 2 : 1};
    static const char *const address[FW_SERVE_ADDRESSES] = {"127.0.0.1", "[::1]"};
    for (int i = 0; i < g->addresses; i++) {
        snprintf(g->host[i], sizeof g->host[i], "%s:%u", address[i], port);
        snprintf(g->origin[i], sizeof g->origin[i], "http://%s:%u", address[i], port);
    }
    snprintf(g->cookie_name, sizeof g->cookie_name, "flexwright-%u", port);
    return secret(g->cookie) && secret(g->header) && secret(g->entry);
}

/* equal texts? takes the same time wherever they differ */
static bool equal_in_time(const char *a, const char *b) {
    size_t n = strlen(a);
    if (n != strlen(b)) return false;
    unsigned char difference = 0;
    for (size_t i = 0; i < n; i++)
        difference = (unsigned char)(difference | (a[i] ^ b[i]));
    return difference == 0;
}

#define REFUSE(status_, why_)                                                                      \
    return (fw_serve_refusal) {                                                                    \
        .status = (status_), .why = (why_)                                                         \
    }
#define PASS                                                                                       \
    return (fw_serve_refusal) {                                                                    \
        .status = 0                                                                                \
    }

/* ---- the request line ---- */

static bool is_get(const fw_serve_guard_facts *f) {
    return strcmp(f->method, "GET") == 0;
}

/* nothing is ever decoded: a path of plain letters names a row of a table, or nothing */
static bool plain_path(const char *path) {
    size_t n = strlen(path);
    return path[0] == '/' && n <= FW_SERVE_MOST_PATH &&
           strspn(path, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789/._-") ==
               n &&
           !strstr(path, "..") && !strstr(path, "//");
}

bool fw_serve_guard_is_entry(const fw_serve_guard_facts *f) {
    return is_get(f) && strcmp(f->path, "/") == 0 && f->entry;
}

static fw_serve_refusal request_line(const fw_serve_guard_facts *f) {
    if (strcmp(f->version, "HTTP/1.1") != 0) REFUSE(505, "this server answers HTTP/1.1 only");
    if (!is_get(f) && strcmp(f->method, "POST") != 0 && strcmp(f->method, "DELETE") != 0)
        REFUSE(405, "this server answers GET, POST and DELETE only");
    if (!plain_path(f->path)) REFUSE(400, "no such path");
    if (f->query && !fw_serve_guard_is_entry(f))
        REFUSE(400, "no address of this server takes a query (what stands behind ?)");
    if (f->odd_name) REFUSE(400, "the name of a header holds a blank or another wrong sign");
    if (f->repeated) REFUSE(400, "a header that may be sent once was sent twice");
    /* the parser hands texts on that end at their first zero byte: what is behind one must not be
       there, so that what was checked is what was sent */
    if (FW_DEFENDED(HEAD) && f->head_bytes > f->seen_bytes)
        REFUSE(400, "the head of the request holds bytes that are part of no header");
    PASS;
}

/* ---- where it comes from ---- */

/* DNS rebinding: a page of another name that was made to point here sends its own name */
static fw_serve_refusal host(const fw_serve_guard *g, const fw_serve_guard_facts *f) {
    if (!FW_DEFENDED(HOST)) PASS;
    for (int i = 0; f->host && i < g->addresses; i++)
        if (strcmp(f->host, g->host[i]) == 0) PASS;
    REFUSE(421, "the address in Host is not this server's");
}

/* a page of another origin; the origin must be that of the host that is asked */
static fw_serve_refusal origin(const fw_serve_guard *g, const fw_serve_guard_facts *f) {
    if (!FW_DEFENDED(ORIGIN)) PASS;
    if (!f->origin) PASS;
    for (int i = 0; i < g->addresses; i++)
        if (strcmp(f->origin, g->origin[i]) == 0 && (!f->host || strcmp(f->host, g->host[i]) == 0))
            PASS;
    REFUSE(403, "this server answers its own page only, and the request comes from another one");
}

/* same-origin, or none for what a person types; another port of this machine is same-site and as
   foreign as any other page */
static fw_serve_refusal fetch_site(const fw_serve_guard_facts *f) {
    if (!FW_DEFENDED(FETCH_SITE)) PASS;
    if (!f->fetch_site || strcmp(f->fetch_site, "same-origin") == 0) PASS;
    if (strcmp(f->fetch_site, "none") == 0 && is_get(f)) PASS;
    REFUSE(403, "this server answers its own page only, and the request comes from another one");
}

/* ---- the body ---- */

/* digits only, no sign, no blank; -1: no number of bytes that is served */
static long declared(const char *text) {
    size_t n = strlen(text);
    if (n < 1 || n > 9 || strspn(text, "0123456789") != n) return -1;
    long bytes = 0;
    for (size_t i = 0; i < n; i++)
        bytes = 10 * bytes + (text[i] - '0');
    return bytes;
}

size_t fw_serve_guard_body(const fw_serve_guard_facts *f) {
    long bytes = f->content_length ? declared(f->content_length) : 0;
    return bytes > 0 ? (size_t)bytes : 0;
}

static fw_serve_refusal body(const fw_serve_guard_facts *f) {
    if (f->transfer_encoding) REFUSE(411, "the length of a body must be stated in Content-Length");
    long bytes = f->content_length ? declared(f->content_length) : 0;
    if (bytes < 0) REFUSE(400, "Content-Length is not a number of bytes");
    if (strcmp(f->method, "POST") != 0) {
        if (bytes > 0) REFUSE(400, "only POST has a body");
        PASS;
    }
    if (!f->content_length) REFUSE(411, "the length of a body must be stated in Content-Length");
    if (FW_DEFENDED(BODY) && bytes > FW_SERVE_MOST_BODY)
        REFUSE(413, "the body is larger than 1 MiB, the most that this server takes");
    const char *type = f->content_type ? f->content_type : "";
    if (FW_DEFENDED(CONTENT_TYPE) && strcasecmp(type, "application/json") != 0 &&
        strcasecmp(type, "application/json; charset=utf-8") != 0 &&
        strcasecmp(type, "application/json;charset=utf-8") != 0)
        REFUSE(415, "the Content-Type of a body must be application/json");
    PASS;
}

/* ---- who asks ---- */

/* the value of our cookie among those of this host into `value`; exactly one must be there */
static bool our_cookie(const fw_serve_guard *g, const char *header, char value[FW_SERVE_SECRET]) {
    size_t name = strlen(g->cookie_name);
    int found = 0;
    for (const char *at = header; at && *at;) {
        at += strspn(at, "; ");
        size_t n = strcspn(at, ";");
        if (n > name && strncmp(at, g->cookie_name, name) == 0 && at[name] == '=') {
            size_t length = n - name - 1;
            if (length != FW_SERVE_SECRET - 1) return false;
            memcpy(value, at + name + 1, length);
            value[length] = '\0';
            found++;
        }
        at += n;
    }
    return found == 1;
}

static fw_serve_refusal identity(const fw_serve_guard *g, const fw_serve_guard_facts *f) {
    if (fw_serve_guard_is_entry(f)) {
        if (FW_DEFENDED(ONE_TIME) && g->entry_used)
            REFUSE(403, "this address was used already; it opens the page once. Start flexwright "
                        "serve again for a new one");
        if (!equal_in_time(f->entry, g->entry))
            REFUSE(403, "this is not the address that flexwright serve printed");
        PASS;
    }
    char value[FW_SERVE_SECRET];
    bool known = f->cookie && our_cookie(g, f->cookie, value) && equal_in_time(value, g->cookie);
    if (FW_DEFENDED(COOKIE) && !known)
        REFUSE(401, "this browser has not opened the address that flexwright serve printed; open "
                    "that one first");
    if (FW_DEFENDED(HEADER_TOKEN) && !is_get(f) &&
        (!f->token || !equal_in_time(f->token, g->header)))
        REFUSE(403, "the header X-Flexwright-Token is missing or wrong");
    PASS;
}

fw_serve_refusal fw_serve_guard_check(const fw_serve_guard *g, const fw_serve_guard_facts *f) {
    fw_serve_refusal r = request_line(f);
    if (!r.status) r = host(g, f);
    if (!r.status) r = origin(g, f);
    /* the printed address may stand anywhere; whoever has it may open it */
    if (!r.status && !fw_serve_guard_is_entry(f)) r = fetch_site(f);
    if (!r.status) r = identity(g, f);
    if (!r.status) r = body(f);
    return r;
}
