// Lists read element by element. Truth: jansson on the whole text: it takes the text if and only if the parts are
// taken, and then the elements are the same.
#include "check.h"

#include "io/json.h"

#include <stdlib.h>
#include <string.h>

enum { FLAGS = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL };

// Puts the elements that are read into the tree; 0 where one is no JSON.
static int read_all(json_list *list, json_t *root, const char *key) {
    json_t *array = json_object_get(root, key), *element;
    json_error_t why;
    int found;
    size_t count = 0;
    while ((found = json_next(list, &element, &why)) > 0) {
        CHECK(list->at || json_equal(element, json_array_get(array, count)));
        if (list->at) json_array_append(array, element);
        json_decref(element);
        count++;
    }
    if (found < 0) CHECK(why.text[0] != 0);
    return found == 0;
}

// 1 if the text was taken.
static int check_text(const char *text, size_t size) {
    bytes given = {(char *)text, size};
    json_list list;
    json_error_t why;
    json_t *whole = json_loadb(text, size, FLAGS, &why), *root = json_load_around(given, "list", FLAGS, &list, &why);
    int is_taken = root && read_all(&list, root, "list");
    if (!CHECK_EQ(is_taken, whole != NULL)) printf("  %.*s\n", (int)size, text);
    if (is_taken && whole) CHECK(json_equal(root, whole));
    json_decref(whole);
    json_decref(root);
    return is_taken;
}

static const char *const good[] = {
    "{\"list\": []}",
    " {\"list\":[ ]\n} ",
    "{\"list\": [{\"a\": 1}, [2, 3] ,\n4, \"five, ]\", null, true]}",
    "{\"b\": [1, {\"list\": [7]}], \"list\" : [1.5, -0.25e3\n] \t\r\n , \"c\": \"]}\"}",
    "{\"c\": \"\\\"list\\\": [\", \"list\": [\"\\\\\", \"\\\"\", {\"list\": [1]}]}",
    "{\"l\\u0069st\": [1, 2]}",
    "{\"list\": {\"list\": [1]}}",
    "{\"list\": 3}",
    "[{\"list\": [1]}]",
    "{}",
};
static const char *const bad[] = {"",
                                  "{\"list\": [1,]}",
                                  "{\"list\": [,1]}",
                                  "{\"list\": [,]}",
                                  "{\"list\": [1 2]}",
                                  "{\"list\": [1}",
                                  "{\"list\": [1]",
                                  "{\"list\": [1]]}",
                                  "{\"list\": [1][2]}",
                                  "{\"list\": [1] 2}",
                                  "{\"list\": [{\"a\": 1, \"a\": 2}]}",
                                  "{\"list\": [1], \"list\": [2]}",
                                  "{\"list\": [1]} 3",
                                  "{\"list\": [\"a]}",
                                  "{\"list\": [1], }",
                                  "{\"list\": [01]}",
                                  "{\"list\": [1e999]}",
                                  "{\"list\": [}]}",
                                  "{\"list\": [{]}",
                                  "{\"list\": [1] , [2]}",
                                  "{\"list\" [1]}",
                                  "{list: [1]}",
                                  "{\"list\": [\"\xff\"]}",
                                  "{\"list\": ["};

// Changed bytes of all of them.
static void check_damaged(int rounds) {
    static const char marks[] = "\"[]{},:019.-e \n\\\xffx";
    uint64_t s = 7;
    int taken = 0;
    for (int i = 0; i < rounds; i++) {
        check_seed = s;
        char text[200];
        const char *from = good[random_next(&s) % (sizeof good / sizeof *good)];
        size_t length = strlen(from);
        memcpy(text, from, length);
        for (uint64_t k = 1 + random_next(&s) % 3; k-- > 0;)
            text[random_next(&s) % length] = marks[random_next(&s) % (sizeof marks - 1)];
        if (random_next(&s) % 4 == 0) length = random_next(&s) % length;
        // A block of that size, so that a sanitizer sees what reads beyond it.
        char *block = malloc(length + !length);
        memcpy(block, text, length);
        taken += check_text(block, length);
        free(block);
    }
    check_seed = 0;
    CHECK(taken > rounds / 100 && taken < rounds / 2);
}

// `before`, n - 1 brackets, a list of one number, the brackets' ends, `after`; the caller frees it.
static bytes make_nested(const char *before, const char *open, size_t n, const char *close, const char *after) {
    char *text = malloc(strlen(before) + n * (strlen(open) + strlen(close)) + 4 + strlen(after)), *at = text;
    at += sprintf(at, "%s", before);
    for (size_t i = 1; i < n; i++) at += sprintf(at, "%s", open);
    at += sprintf(at, "[0]");
    for (size_t i = 1; i < n; i++) at += sprintf(at, "%s", close);
    at += sprintf(at, "%s", after);
    return (bytes){text, (size_t)(at - text)};
}

// What failed must have failed for its depth, in that line.
static void check_failure(const json_t *root, const json_error_t *why, int line) {
    CHECK(!root && json_get_failure(why) == OVOID_ERROR_LIMIT);
    CHECK_EQ(why->line, line);
    CHECK(strcmp(why->text, "values are nested more than 64 deep") == 0);
}

// Values n deep within a text, which is an object: taken or refused, as a whole and around its list.
static void check_nested(const char *before, size_t n, const char *after, int line) {
    static const char *const brackets[2][2] = {{"[", "]"}, {"{\"[[\":", "}"}};
    for (int kind = 0; kind < 2; kind++) {
        bytes text = make_nested(before, brackets[kind][0], n, brackets[kind][1], after);
        json_error_t why = {.text = ""}, around_why = {.text = ""};
        json_list list;
        json_t *root = json_load(text, FLAGS, &why),
               *around = json_load_around(text, "list", FLAGS, &list, &around_why);
        if (n < JSON_DEPTH_MAX) {
            CHECK(root && around);
        } else {
            check_failure(root, &why, line);
            check_failure(around, &around_why, line);
        }
        json_decref(root);
        json_decref(around);
        free(text.data);
    }
}

static void check_depth(void) {
    // Values beside each other are not nested.
    char flat[12000] = "{\"list\": [0";
    size_t length = strlen(flat);
    for (int i = 0; i < 500; i++) length += (size_t)sprintf(flat + length, ",[[1], {\"a\": 2}]");
    strcpy(flat + length, "]}");
    CHECK(check_text(flat, strlen(flat)));
    static const size_t depths[] = {1, JSON_DEPTH_MAX - 1, JSON_DEPTH_MAX, 2000, 3000, 1000000};
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        check_nested("{\"list\":", depths[i], "}", 1);
        check_nested("{\n\"list\": [1, 2],\n \"b\": ", depths[i], "}", 3);
        check_nested("{\"a\":\n", depths[i], ", \"list\": [1, 2]}", 2);
    }
}

int main(void) {
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) CHECK_EQ(check_text(good[i], strlen(good[i])), 1);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) CHECK_EQ(check_text(bad[i], strlen(bad[i])), 0);
    check_damaged(20000);
    check_depth();
    return check_end();
}
