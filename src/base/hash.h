/* SPDX-License-Identifier: GPL-3.0-or-later */
/* SHA-256 (FIPS 180-4). */
#ifndef FW_BASE_HASH_H
#define FW_BASE_HASH_H
#include <stddef.h>

/* 64 hexadecimal digits and a NUL into `text` */
void fw_sha256(const void *data, size_t n, char text[65]);

#endif
