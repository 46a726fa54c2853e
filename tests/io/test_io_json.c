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

int main(void) {
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) CHECK_EQ(check_text(good[i], strlen(good[i])), 1);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) CHECK_EQ(check_text(bad[i], strlen(bad[i])), 0);
    check_damaged(20000);
    return check_end();
}
