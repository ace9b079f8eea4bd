/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the packs lie: beside the very program or library that asks, so that an installed tree can be moved. */
#include "base/output.h"
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <link.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* the file that this code was loaded from; false: it is not known */
static bool own_file(char path[PATH_MAX]) {
    static const char here = 0; /* an object of that file, as dladdr1 asks for */
    Dl_info info;
    void *extra = NULL;
    if (!dladdr1(&here, &info, &extra, RTLD_DL_LINKMAP) || !extra) return false;
    const struct link_map *map = extra;
    return realpath(map->l_name[0] ? map->l_name : "/proc/self/exe", path) != NULL;
}

static bool is_place(const char *part, size_t n) {
    static const char *const name[] = {"bin", "lib", "lib64"};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++)
        if (strlen(name[i]) == n && memcmp(name[i], part, n) == 0) return true;
    return false;
}

/* PREFIX of PREFIX/bin/FILE or PREFIX/lib/.../FILE: what stands before the last such directory. false:
   there is none, as in a build tree */
static bool prefix_of(char *path) {
    for (char *end = strrchr(path, '/'); end && end > path; end = strrchr(path, '/')) {
        *end = '\0';
        const char *part = strrchr(path, '/');
        if (!part || !is_place(part + 1, strlen(part + 1))) continue;
        path[part - path] = '\0';
        return true;
    }
    return false;
}

static bool readable(const char *path) {
    return access(path, R_OK) == 0;
}

fw_status fw_data_path(fw_arena *arena, const char *override, const char *name, const char **path) {
    static const char *const root[] = {FW_INSTALL_DATA_DIR, FW_SOURCE_DATA_DIR};
    char own[PATH_MAX];
    if (override && override[0]) {
        FW_NEED(*path = fw_arena_printf(arena, "%s/%s", override, name));
        if (!readable(*path)) *path = NULL;
        return FW_OK;
    }
    if (own_file(own) && prefix_of(own)) {
        FW_NEED(*path = fw_arena_printf(arena, "%s/share/flexwright/%s", own, name));
        if (readable(*path)) return FW_OK;
    }
    for (size_t i = 0; i < sizeof root / sizeof root[0]; i++) {
        FW_NEED(*path = fw_arena_printf(arena, "%s/%s", root[i], name));
        if (readable(*path)) return FW_OK;
    }
    *path = NULL;
    return FW_OK;
}

static int by_name(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

fw_status fw_data_names(fw_arena *arena, const char *override, const char *directory,
                        const char *const **name, size_t *n) {
    enum { MOST = 256 };
    const char *path, **found = fw_arena_array(arena, const char *, MOST);
    FW_NEED(found);
    *name = found, *n = 0;
    FW_TRY(fw_data_path(arena, override, directory, &path));
    DIR *dir = path ? opendir(path) : NULL;
    if (path && !dir) return errno == ENOMEM ? FW_NOMEM : FW_IO;
    fw_status status = FW_OK;
    errno = 0;
    for (struct dirent *e; dir && status == FW_OK && *n < MOST && (e = readdir(dir));) {
        const size_t length = strlen(e->d_name);
        if (length < 5 || strcmp(e->d_name + length - 4, ".xml") != 0) continue;
        found[*n] = fw_arena_strndup(arena, e->d_name, length - 4);
        status = found[(*n)++] ? FW_OK : FW_NOMEM;
    }
    if (status == FW_OK && dir && errno != 0) status = FW_IO;
    if (dir) closedir(dir);
    if (status == FW_OK && *n > 1) qsort(found, *n, sizeof *found, by_name);
    return status;
}
