// A damaged block is noticed before any of its texts is used; that the last block is there, before the first is read.
#define _FILE_OFFSET_BITS 64
#include "shard/read.h"

#include "base/message.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int is_at_end(FILE *file) {
    int c = getc(file);
    if (c != EOF) (void)ungetc(c, file);
    return c == EOF;
}

/// 1 if the last bytes of the file are a last block, which has no texts.
static int has_last_block(FILE *file, off_t begin) {
    unsigned char head[SHARD_BLOCK_HEAD];
    shard_block b;
    uint64_t number = 0;
    if (fseeko(file, -SHARD_BLOCK_HEAD, SEEK_END) != 0 || ftello(file) < begin) return 0;
    if (fread(head, 1, sizeof head, file) != sizeof head) return 0;
    for (int i = 0; i < 8; i++) number |= (uint64_t)head[8 + i] << 8 * i;
    return shard_block_decode(head, number, &b) && b.is_last && !b.bytes && shard_block_check(head, NULL, 0);
}

int shard_reader_open(shard_reader *r, const char *path) {
    *r = (shard_reader){.path = path};
    struct stat status;
    errno = 0;
    r->file = fopen(path, "rb");
    if (!r->file) return message_error("%s: cannot be opened: %s", path, strerror(errno)), EXIT_INPUT;
    if (fstat(fileno(r->file), &status) != 0 || !S_ISREG(status.st_mode) || !shard_header_read(r->file, &r->header)) {
        message_error("%s: is no shard, as ovoid batch --shard I/N makes them, or ends within its header", path);
        shard_reader_close(r);
        return EXIT_INPUT;
    }
    off_t begin = ftello(r->file);
    if (!has_last_block(r->file, begin)) {
        message_error("%s: part %s is not finished, or damaged; run it again, with --shard %s: it goes on", path,
                      r->header.fields[SHARD_PART], r->header.fields[SHARD_PART]);
        shard_reader_close(r);
        return EXIT_INPUT;
    }
    if (fseeko(r->file, begin, SEEK_SET) == 0) return 0;
    message_error("%s: cannot be read: %s", path, strerror(errno));
    shard_reader_close(r);
    return EXIT_INPUT;
}

void shard_reader_close(shard_reader *r) {
    if (r->file) (void)fclose(r->file); // it was read
    r->file = NULL;
    shard_header_clear(&r->header);
    free(r->texts);
    r->texts = NULL;
}

static int complain_damaged(const shard_reader *r) {
    message_error("%s: block %" PRIu64 " is damaged: remove the file and run part %s again", r->path, r->number,
                  r->header.fields[SHARD_PART]);
    return -1;
}

/// Room for the texts of a block; a length that the file does not have is damage.
static int reserve(shard_reader *r, uint64_t bytes) {
    struct stat status;
    if (bytes <= r->capacity) return 1;
    if (fstat(fileno(r->file), &status) != 0 || bytes > (uint64_t)status.st_size) return complain_damaged(r);
    unsigned char *texts = realloc(r->texts, (size_t)bytes);
    if (!texts) return message_error("out of memory"), -1;
    r->texts = texts;
    r->capacity = (size_t)bytes;
    return 1;
}

/// Reads the next block: 1, or -1 after a message.
static int read_block(shard_reader *r) {
    unsigned char head[SHARD_BLOCK_HEAD];
    shard_block b;
    if (fread(head, 1, sizeof head, r->file) != sizeof head || !shard_block_decode(head, r->number, &b))
        return complain_damaged(r);
    if (reserve(r, b.bytes) < 0) return -1;
    r->size = (size_t)b.bytes;
    if (fread(r->texts, 1, r->size, r->file) != r->size || !shard_block_check(head, r->texts, r->size))
        return complain_damaged(r);
    if (b.is_last && !is_at_end(r->file)) return complain_damaged(r);
    shard_tally_add(&r->all, &b.tally);
    r->number++;
    r->at = 0;
    r->left = b.texts;
    r->ended = b.is_last;
    return 1;
}

int shard_reader_next(shard_reader *r) {
    while (!r->left) {
        if (r->ended) return 0;
        if (read_block(r) < 0) return -1;
    }
    shard_key before = r->key;
    int is_first = !r->text;
    if (r->size - r->at < SHARD_TEXT_HEAD) return complain_damaged(r);
    r->text_size = shard_text_decode(r->texts + r->at, &r->key);
    r->at += SHARD_TEXT_HEAD;
    if (r->text_size > r->size - r->at || (!is_first && shard_key_compare(&before, &r->key) >= 0))
        return complain_damaged(r);
    r->text = (const char *)r->texts + r->at;
    r->at += r->text_size;
    r->left--;
    return 1;
}
