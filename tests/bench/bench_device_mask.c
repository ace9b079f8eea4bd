/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a description in memory to the bytes of its GDSII file, as plans do it: reading, layout,
   frame marks, bias, rules, flattening with its proofs, writing; then the distances of its release, and
   the map of them. Thread CPU time, median and least of rounds, each in an arena of its own; then the
   memory beyond the start of the program.

   cmake --build DIR --target bench_device_mask &&
   DIR/tests/bench/bench_device_mask docs/gallery/reference-six-bar/device.xml masks/al-masked-rie.xml 1.5e-6

   A fourth argument, a pitch of release holes in metres, makes the device one with holes (0: as it is stated); a
   fifth is how many rounds there are, 1 to count instructions. */
#include "mask/mask.h"
#include "release/release.h"
#include "measure.h"
#include <inttypes.h>
#include <sys/resource.h>

enum { ROUNDS = 41, STAGES = 8, COLUMNS = 288 };
static const char *const stage_name[STAGES] = {
    "description read",  "layout",      "mask with its rules",  "GDSII",
    "release distances", "release map", "all, without release", "all"};

typedef struct source {
    const char *path;
    char *text;
    size_t length;
} source;

static source read_source(const char *path) {
    source s = {.path = path};
    FILE *file = fopen(path, "rb");
    size_t room = 1 << 20;
    s.text = malloc(room);
    if (!file || !s.text) {
        fprintf(stderr, "%s cannot be read\n", path);
        exit(2);
    }
    s.length = fread(s.text, 1, room - 1, file);
    s.text[s.length] = '\0';
    fclose(file);
    return s;
}

static void must(fw_status status, const char *what, const fw_diags *diags) {
    if (status == FW_OK) return;
    fprintf(stderr, "%s: %s\n", what, fw_status_text(status));
    for (size_t i = 0; i < diags->count; i++)
        fprintf(stderr, "  %s\n", diags->item[i].message);
    exit(1);
}

/* FNV-1a: whether two programs make the same to the byte */
static uint64_t mixed(uint64_t hash, const void *bytes, size_t n) {
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
    return hash;
}

static uint64_t hash_of(const fw_text *out, const fw_release *release, const fw_release_map *map) {
    uint64_t hash = mixed(14695981039346656037u, out->data, out->length);
    for (int i = 0; i < release->npart; i++) {
        const fw_release_part *p = &release->part[i];
        hash = mixed(hash, &p->reach_m, sizeof p->reach_m);
        hash = mixed(hash, &p->most_m, sizeof p->most_m);
        hash = mixed(hash, &p->at, sizeof p->at);
        hash = mixed(hash, p->bonded_m2, sizeof p->bonded_m2);
    }
    return mixed(hash, map->distance_m,
                 (size_t)map->rows * (size_t)map->columns * sizeof *map->distance_m);
}

/* spent_s (STAGES): CPU seconds of each stage and of all */
static size_t run(const source *device_file, const source *table_file, double bias_m,
                  double pitch_m, double spent_s[STAGES], size_t *peak, uint64_t *hash) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_mask_table table;
    must(fw_mask_table_read(arena, table_file->path, table_file->text, table_file->length, &diags,
                            &table),
         table_file->path, &diags);
    double at[STAGES - 1];
    const fw_device *device;
    const fw_release *release;
    const fw_release_map *map;
    const fw_layout *drawn, *layout;
    const fw_mask *mask;
    fw_layout_no_room no_room;
    at[0] = cpu_seconds();
    must(fw_device_read(arena, device_file->path, device_file->text, device_file->length, NULL, 0,
                        &diags, &device),
         device_file->path, &diags);
    at[1] = cpu_seconds();
    fw_device pierced = *device;
    if (pitch_m > 0.0) pierced.release_pitch_m = pitch_m;
    device = &pierced;
    must(fw_layout_build(arena, device, &diags, &drawn), "layout", &diags);
    at[2] = cpu_seconds();
    must(fw_mask_frame_marks(arena, &table, drawn, &layout, &no_room), "marks", &diags);
    fw_mask_options options = {.bias_m = bias_m};
    must(fw_mask_build(arena, layout, &table, device->name, &options, &diags, &mask), "mask",
         &diags);
    at[3] = cpu_seconds();
    fw_text out = fw_text_new(arena);
    must(fw_mask_write_gds(mask, &out), "GDSII", &diags);
    at[4] = cpu_seconds();
    must(fw_release_solve(arena, layout, true, false, 0.1, &release), "release", &diags);
    at[5] = cpu_seconds();
    must(fw_release_map_make(arena, layout, true, COLUMNS, &map), "map", &diags);
    at[6] = cpu_seconds();
    for (int i = 0; i < 6; i++)
        spent_s[i] = at[i + 1] - at[i];
    spent_s[6] = at[4] - at[0];
    spent_s[7] = at[6] - at[0];
    *peak = fw_arena_peak(arena);
    size_t bytes = out.length;
    *hash = hash_of(&out, release, map);
    fw_arena_free(arena);
    return bytes;
}

static long resident_kB(void) {
    struct rusage use;
    getrusage(RUSAGE_SELF, &use);
    return use.ru_maxrss;
}

int main(int argc, char **argv) {
    if (argc < 3) {
        fprintf(stderr, "bench_device_mask DEVICE.xml TABLE.xml [BIAS_M [PITCH_M [ROUNDS]]]\n");
        return 2;
    }
    source device = read_source(argv[1]), table = read_source(argv[2]);
    double bias_m = argc > 3 ? strtod(argv[3], NULL) : 1.5e-6, spent_s[STAGES][ROUNDS];
    double pitch_m = argc > 4 ? strtod(argv[4], NULL) : 0.0;
    int asked = argc > 5 ? atoi(argv[5]) : ROUNDS, rounds = asked < 1 || asked > ROUNDS ? ROUNDS : asked;
    size_t bytes = 0, peak = 0;
    uint64_t hash = 0;
    long before_kB = resident_kB(), after_kB = 0;
    for (int r = 0; r < rounds; r++) {
        double one[STAGES];
        bytes = run(&device, &table, bias_m, pitch_m, one, &peak, &hash);
        if (r == 0) after_kB = resident_kB();
        for (int i = 0; i < STAGES; i++)
            spent_s[i][r] = one[i];
    }
    for (int i = 0; i < STAGES; i++) {
        qsort(spent_s[i], (size_t)rounds, sizeof **spent_s, by_size);
        printf("%-20s %8.3f ms, least %8.3f\n", stage_name[i], 1e3 * spent_s[i][rounds / 2],
               1e3 * spent_s[i][0]);
    }
    printf("%zu bytes of GDSII, all that was made %016llx; arena %.2f MB, resident %.2f MB more than at the start\n",
           bytes, (unsigned long long)hash, 1e-6 * (double)peak, 1e-3 * (double)(after_kB - before_kB));
    free(device.text);
    free(table.text);
    return 0;
}
