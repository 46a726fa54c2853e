// The layout. A block's head: twelve words, little-endian: magic, number, bytes, texts, units, is_last, the tally, the
// checksum, a digest of the eleven words before it and of the texts.
#include "shard/file.h"

#include "shard/digest.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { SIDES = EXIT_NOT_PROVEN + 1, WORDS = SHARD_BLOCK_HEAD / 8, CHECKED = SHARD_BLOCK_HEAD - 8 };

/// "ovoidblk", as a little-endian word.
#define BLOCK_MAGIC 0x6b6c6264696f766fu

uint64_t shard_key_from_number(double number) {
    uint64_t bits;
    number += 0.0; // minus zero becomes zero
    memcpy(&bits, &number, sizeof bits);
    return bits >> 63 ? ~bits : bits | (uint64_t)1 << 63;
}

int shard_key_compare(const shard_key *a, const shard_key *b) {
    for (int i = 0; i < 3; i++)
        if (a->words[i] != b->words[i]) return a->words[i] < b->words[i] ? -1 : 1;
    return 0;
}

void shard_tally_add(shard_tally *to, const shard_tally *from) {
    for (int i = 0; i < SIDES; i++) to->sides[i] += from->sides[i];
}

exit_code shard_tally_get_exit(const shard_tally *t) {
    if (t->sides[EXIT_NOT_PROVEN]) return EXIT_NOT_PROVEN;
    return t->sides[EXIT_TOUCH] ? EXIT_TOUCH : EXIT_APART;
}

/* ---- words */

static void put_words(unsigned char *at, const uint64_t *words, int count) {
    for (int i = 0; i < 8 * count; i++) at[i] = (unsigned char)(words[i / 8] >> i % 8 * 8);
}

static void get_words(const unsigned char *at, uint64_t *words, int count) {
    for (int i = 0; i < count; i++) words[i] = 0;
    for (int i = 0; i < 8 * count; i++) words[i / 8] |= (uint64_t)at[i] << i % 8 * 8;
}

static uint64_t compute_checksum(const unsigned char *head, const void *texts, size_t size) {
    shard_digest digest = shard_digest_make();
    shard_digest_add(&digest, head, CHECKED);
    shard_digest_add(&digest, texts, size);
    return shard_digest_get(&digest);
}

void shard_block_encode(unsigned char head[SHARD_BLOCK_HEAD], const shard_block *b, uint64_t number,
                        const void *texts) {
    uint64_t words[WORDS - 1] = {BLOCK_MAGIC, number, b->bytes, b->texts, b->units, (uint64_t)b->is_last};
    memcpy(words + 6, b->tally.sides, sizeof b->tally.sides);
    put_words(head, words, WORDS - 1);
    uint64_t sum = compute_checksum(head, texts, (size_t)b->bytes);
    put_words(head + CHECKED, &sum, 1);
}

int shard_block_decode(const unsigned char head[SHARD_BLOCK_HEAD], uint64_t number, shard_block *b) {
    uint64_t words[WORDS];
    get_words(head, words, WORDS);
    *b = (shard_block){words[2], words[3], words[4], words[5] == 1, {{0}}};
    memcpy(b->tally.sides, words + 6, sizeof b->tally.sides);
    return words[0] == BLOCK_MAGIC && words[1] == number && words[5] <= 1 && b->bytes < SIZE_MAX / 2;
}

int shard_block_check(const unsigned char head[SHARD_BLOCK_HEAD], const void *texts, size_t size) {
    uint64_t sum;
    get_words(head + CHECKED, &sum, 1);
    return sum == compute_checksum(head, texts, size);
}

void shard_text_encode(unsigned char head[SHARD_TEXT_HEAD], const shard_key *key, size_t size) {
    const uint64_t length = size;
    put_words(head, key->words, 3);
    put_words(head + 24, &length, 1);
}

size_t shard_text_decode(const unsigned char head[SHARD_TEXT_HEAD], shard_key *key) {
    uint64_t length;
    get_words(head, key->words, 3);
    get_words(head + 24, &length, 1);
    return length < SIZE_MAX ? (size_t)length : SIZE_MAX;
}

/* ---- headers */

/// Longest beginning of the output.
#define HEAD_MAX_SIZE (1 << 24)

const char *shard_header_get_word(int field) {
    static const char *const words[SHARD_FIELDS] = {"tool", "command", "format", "options", "inputs", "most", "part"};
    return words[field];
}

/// Reads a line to the end of the text, without its end and terminated. 0: there is none.
static int read_line(FILE *file, char *text, size_t *size) {
    size_t length = 0;
    for (int c; (c = getc(file)) != '\n'; length++) {
        if (c == EOF || c == 0 || length == SHARD_LINE_MAX) return 0;
        text[*size + length] = (char)c;
    }
    text[*size + length] = 0;
    *size += length + 1;
    return 1;
}

/// The text of a line behind "word ", or NULL.
static const char *get_value(const char *line, const char *word) {
    size_t length = strlen(word);
    return strncmp(line, word, length) == 0 && line[length] == ' ' ? line + length + 1 : NULL;
}

static int read_fields(FILE *file, shard_header *h) {
    size_t size = 0, begin = 0;
    unsigned long long head = 0;
    if (!read_line(file, h->text, &size) || strcmp(h->text, SHARD_MAGIC) != 0) return 0;
    for (int i = 0; i < SHARD_FIELDS; i++) {
        begin = size;
        if (!read_line(file, h->text, &size)) return 0;
        h->fields[i] = get_value(h->text + begin, shard_header_get_word(i));
        if (!h->fields[i]) return 0;
    }
    begin = size;
    if (!read_line(file, h->text, &size) || sscanf(h->text + begin, "head %llu", &head) != 1) return 0;
    if (head > HEAD_MAX_SIZE || sscanf(h->fields[SHARD_MOST], "%" SCNu64, &h->most) != 1) return 0;
    if (sscanf(h->fields[SHARD_PART], "%u/%u", &h->part.index, &h->part.count) != 2) return 0;
    if (!h->part.index || h->part.index > h->part.count || h->part.count > SHARD_PARTS_MAX) return 0;
    h->head_size = (size_t)head;
    return 1;
}

int shard_header_read(FILE *file, shard_header *h) {
    *h = (shard_header){.text = malloc((size_t)(SHARD_FIELDS + 2) * (SHARD_LINE_MAX + 1))};
    int good = h->text && read_fields(file, h);
    if (good) h->head = malloc(h->head_size + 1);
    good = good && h->head && fread(h->head, 1, h->head_size, file) == h->head_size;
    if (!good) shard_header_clear(h);
    return good;
}

void shard_header_clear(shard_header *h) {
    free(h->text);
    free(h->head);
    *h = (shard_header){.text = NULL};
}
