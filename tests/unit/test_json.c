// test_json.c: JSON is parsed like Jansson does, but a failed allocation is reported as a limit, not as an error of the
// file, for every allocation, failing once or permanently.
#include "test.h"
#include "json_parse.h"
#include "loading.h"

// --- an allocator for Jansson that fails

static long countdown; // allocations that still succeed; −1 means all
static bool for_good;  // after one failure, all fail

static void *allocate(size_t size)
{
    if (countdown == 0) {
        if (!for_good)
            countdown = -1;
        return NULL;
    }
    countdown -= countdown > 0;
    return malloc(size);
}

static int fail_allocations(void **state)
{
    (void)state;
    countdown = -1;
    json_set_alloc_funcs(allocate, free);
    return 0;
}

static int restore(void **state)
{
    (void)state;
    json_set_alloc_funcs(malloc, free);
    return 0;
}

// Keys and texts of more than 16 bytes, numbers of both kinds, escapes, nesting: every path of its lexer.
static const char whole[] =
    "{\"lambent\": 1, \"image\": {\"size\": [8, 8], \"background\": \"\\u0023\\u0031\\u0032\\u0033\"}, "
    "\"light_cutoff\": "
    "0.0123456789012345678901234567890, \"materials\": {\"a name that takes more than sixteen bytes\": {\"diffuse\": "
    "[1, "
    "0.25, 1e-3]}}, \"match_highlights\": true, \"objects\": [{\"name\": \"x\", \"shape\": \"cube\", \"slices\": 3, "
    "\"stacks\": 1, \"material\": \"a name that takes more than sixteen bytes\"}], \"lights\": [{\"name\": \"l\", "
    "\"type\": \"point\"}, {\"name\": \"m\", \"type\": \"point\"}, {\"name\": \"l\", \"type\": \"point\"}]}";

static lam_scene *load_whole(lam_error *error)
{
    return lam_scene_load_memory(whole, sizeof whole - 1, "s.json", &(lam_load_params){.threads = 1}, NULL, error);
}

TEST(test_scene, .setup_func = fail_allocations, .teardown_func = restore)
{
    for (int mode = 0; mode < 2; mode++) {
        int refused = 0;
        for (long i = 0;; i++) {
            lam_error error = {0};
            for_good = mode;
            countdown = i;
            lam_scene *scene = load_whole(&error);
            bool reached = countdown == (mode ? 0 : -1);
            countdown = -1;
            if (!scene && error.code != LAM_MACHINE)
                fail_msg("allocation %ld, %s: %s", i, mode ? "for good" : "once", error.text);
            refused += !scene;
            lam_scene_free(scene);
            if (!reached)
                break;
            assert_true(i < 10000);
        }
        assert_true(refused > 50);
    }
}

// Writing likewise.
TEST(test_save, .setup_func = fail_allocations, .teardown_func = restore)
{
    char path[] = "/tmp/lambent-json-XXXXXX";
    int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    lam_error error;
    AUTO_SCENE scene = load_whole(&error);
    assert_non_null(scene);
    int refused = 0;
    for (long i = 0;; i++) {
        error = (lam_error){0};
        for_good = i % 2;
        countdown = i / 2;
        bool ok = lam_scene_save(scene, NULL, path, &error);
        bool reached = countdown == (for_good ? 0 : -1);
        countdown = -1;
        if (!ok && error.code != LAM_MACHINE)
            fail_msg("allocation %ld: %s", i / 2, error.text);
        refused += !ok;
        if (!reached)
            break;
    }
    assert_true(refused > 50);
    unlink(path);
}

// --- parsed texts

// Jansson's own parser accepts the same texts and makes the same trees; a result is either a tree or an error.
static void expect_agreement(const char *text, size_t size)
{
    json_error_t wrong;
    lam_error error = {0};
    json_t *found = json_parse(text, size, "t.json", NULL, &error),
           *wanted = json_loadb(text, size, JSON_REJECT_DUPLICATES, &wrong);
    if (found ? !wanted || !json_equal(found, wanted) : wanted != NULL)
        fail_msg("'%.*s': %s", (int)size, text, found ? "is read, unlike by Jansson" : error.text);
    if (!found && (error.code != LAM_CANNOT_READ || strncmp(error.text, "t.json:", 7) != 0))
        fail_msg("'%.*s': %s", (int)size, text, error.text);
    json_decref(found);
    json_decref(wanted);
}

TEST(test_agreement)
{
    static const char *const texts[] = {
        "[]",
        "{}",
        "[[],{}]",
        " [ 1 , -0 , 0.5e-7 , 1E+2 , true , false , null ] ",
        "[01]",
        "[1.]",
        "[.5]",
        "[-]",
        "[1e]",
        "[\"\\u0041\\ud834\\udd1e\\u00e9\\u20ac\\n\\/\\\\\\\"\\b\\f\\r\\t\"]",
        "[\"\\ud834\"]",
        "[\"\\udd1e\"]",
        "[\"\\ud834\\u0041\"]",
        "[\"\\ud834\\ud834\"]",
        "[\"\\u00\"]",
        "[\"\\u00g0\"]",
        "[\"a\tb\"]",
        "[\"\\x\"]",
        "[\"\\",
        "[\"\\\"",
        "[1,]",
        "[,1]",
        "{\"a\" 1}",
        "{\"a\":1,}",
        "{1:2}",
        "[1] 2",
        "5",
        "\"x\"",
        "",
        " ",
        "[tru]",
        "[truex]",
        "[nul",
        "{\"a\":[{\"b\":[]}]}",
        "[1e999]",
        "[-1e999]",
        "[1e-999]",
        "{\"a\":1,\"a\":2}",
        "{\"a\":1,\"\\u0061\":2}",
        "[\"\\u0000\"]",
        "{\"\\u0000\":1}",
        "[1 2]",
        "]",
        "[\"unclosed",
        "{\"a\"",
        "[+1]",
        "[1.5.5]",
        "[1.5-5]",
        "[NaN]",
        "[\x7f]",
        "[\"\xc3\xa9\"]",
        "[\"\xff\"]",
        "[\"\xc3\"]",
        "[\"\xed\xa0\x80\"]",
        "[9223372036854775807, -9223372036854775808, 0.1, 123456789012345678901234567890.0]",
        "{\"\":0}",
        "[\"a text that is much longer than sixteen bytes, where Jansson's buffer first grows\"]",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        expect_agreement(texts[i], strlen(texts[i]));
    static const char changes[] = "\"\\[]{}:,0-.eE tu\n\x01\xff";
    char text[sizeof whole];
    for (size_t at = 0; at < sizeof whole - 1; at++) {
        memcpy(text, whole, sizeof whole);
        expect_agreement(text, at);
        for (size_t c = 0; c < sizeof changes - 1; c++) {
            text[at] = changes[c];
            expect_agreement(text, sizeof whole - 1);
        }
    }
}

TEST(test_sentences)
{
    static const struct {
        const char *text, *sentence;
    } rows[] = {
        {"", "t.json:1: column 1: found the end of the file, expected '{' or '['"},
        {"\xef\xbb\xbf 5", "t.json:1: column 2: found '5', expected '{' or '['"},
        {"{\n \"é\": 1,\n 2}", "t.json:3: column 2: found '2', expected a key in quotes"},
        {"{\"é\" 1}", "t.json:1: column 6: found '1', expected ':'"},
        {"[1\r\n2]", "t.json:2: column 1: found '2', expected ',' or ']'"},
        {"{\"a\": 1 \"b\"}", "t.json:1: column 9: found '\"', expected ',' or '}'"},
        {"[01]", "t.json:1: column 2: found '01', expected a number"},
        {"[tru]", "t.json:1: column 2: found 'tru', expected a value"},
        {"[1] x", "t.json:1: column 5: found 'x', expected the end of the file"},
        {"[1", "t.json:1: column 3: found the end of the file, expected ',' or ']'"},
        {"[\"a", "t.json:1: column 2: a string without its closing quote"},
        {"[\"a\nb\"]", "t.json:1: column 4: a string contains a control character, expected an escape"},
        {"[\"\\q\"]", "t.json:1: column 3: a string contains an invalid escape"},
        {"[\"\\u0000\"]", "t.json:1: column 3: a string contains a zero character"},
        {"[\"\xc3(\"]", "t.json:1: column 3: a string is not UTF-8"},
        {"[\x1b\xc2\x9b"
         "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa]",
         "t.json:1: column 2: found '??aaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…', expected a value"},
        {"[-1e999]", "t.json:1: column 2: found '-1e999', expected a number within the range of a double"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_error error = {0};
        assert_null(json_parse(rows[i].text, strlen(rows[i].text), "t.json", NULL, &error));
        assert_string_equal(error.text, rows[i].sentence);
        assert_null(json_parse(rows[i].text, strlen(rows[i].text), "t.json", NULL, NULL));
    }
    // Integers that do not fit in 64 bits become the nearest doubles.
    json_t *list = json_parse("[9223372036854775808]", 21, "t.json", NULL, NULL);
    assert_true(json_is_real(json_array_get(list, 0)) && json_real_value(json_array_get(list, 0)) == 0x1p63);
    json_decref(list);
}

TEST(test_depth_and_limits)
{
    char deep[2 * LAM_JSON_DEPTH_LIMIT + 2];
    for (int extra = 0; extra < 2; extra++) {
        size_t depth = LAM_JSON_DEPTH_LIMIT + (size_t)extra;
        memset(deep, '[', depth);
        memset(deep + depth, ']', depth);
        lam_error error;
        json_t *tree = json_parse(deep, 2 * depth, "t.json", NULL, &error);
        assert_int_equal(tree == NULL, extra);
        if (!tree)
            assert_string_equal(error.text, "t.json:1: column 257: values are nested 257 deep, expected at most 256 "
                                            "(lam_control.json_depth_limit)");
        json_decref(tree);
    }
    enum { NUMBERS = 10000 };
    char *text = malloc(2 * NUMBERS + 1);
    for (int i = 0; i < NUMBERS; i++)
        memcpy(text + 2 * i, i ? ",1" : "[1", 2);
    text[2 * NUMBERS] = ']';
    lam_cancel cancel = {0};
    struct call_control call;
    call_start(&call, &(lam_control){.cancel = &cancel});
    json_decref(json_parse(text, 2 * NUMBERS + 1, "t.json", &call, NULL));
    lam_cancel_raise(&cancel);
    lam_error error;
    assert_null(json_parse(text, 2 * NUMBERS + 1, "t.json", &call, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    free(text);
}
