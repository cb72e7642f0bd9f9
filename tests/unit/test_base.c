// test_base.c: small parts of the base: growing text, UTF-8, edit distance, libraries opened on first use.
#include "fail.h" // before cmocka's macro of the same name

#include "test.h"

#include "call_control.h"
#include "dynamic_library.h"
#include "available_memory.h"
#include "pool.h"
#include "shown_name.h"
#include "spelling.h"
#include "text_builder.h"

#include <lambent/text.h>

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/stat.h>

TEST(test_text)
{
    struct text text = {0};
    for (int i = 0; i < 1000; i++)
        text_print(&text, "%d,", i % 10);
    text_add(&text, "end");
    text_add_part(&text, "not all", 3);
    assert_false(text.failed);
    assert_int_equal(text.length, 2006);
    assert_string_equal(text.bytes + 1996, "8,9,endnot");
    char line[600];
    memset(line, 'x', sizeof line);
    line[sizeof line - 1] = 0;
    text_print(&text, "%s", line);
    assert_true(text.failed);
    assert_int_equal(text.error.code, LAM_BAD_ARGUMENT);
    text_add(&text, "more");
    assert_int_equal(text.length, 2006);
    free(text.bytes);
}

TEST(test_utf8)
{
    static const struct {
        const char *bytes;
        int length;
    } cases[] = {
        {"a", 1},
        {"\n", 1},
        {"é", 2},
        {"€", 3},
        {"\xf0\x9f\x98\x80", 4},
        {"\x80", 0},
        {"\xc3", 0},
        {"\xc3(", 0},
        {"\xc0\xaf", 0},
        {"\xe0\x80\xaf", 0},
        {"\xed\xa0\x80", 0},
        {"\xe2\x82", 0},
        {"\xff", 0},
        {"\xf5\x80\x80\x80", 0},
        {"\xf4\x90\x80\x80", 0},
        {"\xf4\x8f\xbf\xbf", 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(lam_utf8_length(cases[i].bytes, strlen(cases[i].bytes)), cases[i].length);
    assert_int_equal(lam_utf8_length("é", 1), 0);
    assert_int_equal(lam_utf8_length("", 0), 0);
}

TEST(test_edit_distance)
{
    assert_int_equal(lam_edit_distance("phong", "phong"), 0);
    assert_int_equal(lam_edit_distance("phogn", "phong"), 1); // neighbours swapped
    assert_int_equal(lam_edit_distance("kitten", "sitting"), 3);
    assert_int_equal(lam_edit_distance("", "abc"), 3);
    static const char *const words[] = {"ambient", "diffuse", "specular"};
    assert_string_equal(nearest_word("difuse", words, 3), "diffuse");
    assert_null(nearest_word("shadow", words, 3));
    char longer[400]; // cannot be compared, so nothing is near
    memset(longer, 'a', sizeof longer);
    longer[sizeof longer - 1] = 0;
    assert_null(nearest_word(longer, words, 3));
    assert_null(meant_word(longer, words, 3));
}

TEST(test_shown_name)
{
    static const struct {
        const char *name, *shown;
    } rows[] = {
        {"", ""},
        {"plain name", "plain name"},
        {"0123456789abcdef0123456789abcdef", "0123456789abcdef0123456789abcdef"},
        {"0123456789abcdef0123456789abcdefg", "0123456789abcdef0123456789abcdef…"},
        // characters, not bytes
        {"éééééééééééééééééééééééééééééééé", "éééééééééééééééééééééééééééééééé"},
        {"𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞", "𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞…"},
        // control characters of terminals, and invalid UTF-8
        {"a\x1b[31m\n\x7f\xc2\x9b"
         "b\xc2\xa0",
         "a?[31m???b\xc2\xa0"},
        {"\xff\xc3", "??"},
    };
    char out[SHOWN_NAME_SIZE];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_string_equal(shown_name(rows[i].name, out), rows[i].shown);
    assert_string_equal(shown_name_of("abcdef", 3, out), "abc");
    static const char name32[] = "0123456789abcdefghijklmnopqrstuv";
    char longer[2 * sizeof name32];
    assert_string_equal(shown_file(name32, out), name32);
    snprintf(longer, sizeof longer, "%sé\n.png", name32); // 38 characters
    assert_string_equal(shown_file(longer, out), "0123456789ab…ijklmnopqrstuvé?.png");
    snprintf(longer, sizeof longer, "%s\xff", name32);
    assert_string_equal(shown_file(longer, out), "0123456789ab…defghijklmnopqrstuv?");
    assert_string_equal(shown_name_of("a\0b", 3, out), "a?b");
}

// Text for a terminal: controls are visible, and the text ends between characters.
TEST(test_text_for_terminals)
{
    static const struct {
        const char *text, *shown;
    } rows[] = {
        {"é\xf0\x9d\x84\x9e", "é\xf0\x9d\x84\x9e"},
        {"a\x1b[31m\n\x7f\xc2\x9b\xff", "a?[31m????"},
        {"\u2028\u2029\xc2\x85\u202e\u2066\u061c", "<U+2028><U+2029>?<U+202E><U+2066><U+061C>"},
        {"0123456789012345678901234567890123456789012345678", "0123456789012345678901234567890123456789012345678"},
        {"01234567890123456789012345678901234567890123456789", "0123456789012345678901234567890123456789012345…"},
        {"0123456789012345678901234567890123456789012345é\u202e", "0123456789012345678901234567890123456789012345…"},
    };
    char out[50];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_int_equal(lam_utf8_show(rows[i].text, out, sizeof out), strlen(rows[i].shown));
        assert_string_equal(out, rows[i].shown);
    }
    lam_error error;
    (fail)(&error, LAM_CANNOT_READ, "%s", "x\u202e\xc2\x9b");
    assert_string_equal(error.text, "x<U+202E>?");
}

// Typical spellings of a word of the interface.
TEST(test_word_distance)
{
    static const struct {
        const char *typed, *word;
        int distance;
    } cases[] = {
        {"directional", "directional", 0},
        {"sun", "directional", 0},
        {"Distant", "directional", 0},
        {"per-vertex", "gouraud", 0},
        {"PER_PIXEL", "phong", 0},
        {"ndotl", "n.l", 0},
        {"Blinn Phong", "blinn-phong", 0},
        {"dir", "direction", 0},
        {"pos", "position", 0},
        {"back", "background", 1},
        {"ba", "background", 8},
        {"specualr", "specular", 1},
        {"sun", "spot", 3},
        {"su", "directional", 11},
        {"", "n.l", 3},
        {"sunsun", "directional", 10},
        {"un", "directional", 10},
        {"distan", "directional", 7},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (lam_word_distance(cases[i].typed, cases[i].word) != cases[i].distance)
            fail_msg("%s, %s: %d", cases[i].typed, cases[i].word, lam_word_distance(cases[i].typed, cases[i].word));
    static const char *const types[] = {"ambient", "hemisphere", "point", "directional", "spot"};
    assert_string_equal(meant_word("distant", types, 5), "directional");
    assert_string_equal(meant_word("spotlight", types, 5), "spot");
    assert_null(meant_word("per-vertex", types, 5));
    char many[70] = {0};
    memset(many, 'a', 69);
    assert_int_equal(lam_word_distance(many, "a"), 63);
}

TEST(test_libraries)
{
    const char *reason = NULL;
    assert_null(library_open("libno-such-library.so.9", false, &reason));
    assert_non_null(reason);
    void *library = library_open("libm.so.6", false, NULL);
    assert_non_null(library);
    double (*square_root)(double) = NULL;
    assert_true(library_find(library, "sqrt", &square_root));
    assert_true(square_root(9.0) == 3.0);
    assert_false(library_find(library, "no_such_function", &square_root));
    library_close(library);
}

// --- the available memory

static char root[] = "/tmp/lambent-memory-XXXXXX";

static void put(const char *path, const char *text)
{
    char name[300];
    snprintf(name, sizeof name, "%s%s", root, path);
    for (char *at = strchr(name + 1, '/'); at; at = strchr(at + 1, '/')) {
        *at = 0;
        mkdir(name, 0777);
        *at = '/';
    }
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void remove_root(void)
{
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", root);
    assert_int_equal(system(command), 0);
}

// Quotas of processor time in a period, of the group and its ancestors.
TEST(test_processors_of_groups)
{
    assert_non_null(mkdtemp(root));
    put("/proc/self/cgroup", "4:cpu:/shop\n0::/shop/night\n");
    assert_true(processors_of_groups(root) == UINT64_MAX);
    put("/sys/fs/cgroup/shop/night/cpu.max", "max 100000\n");
    assert_true(processors_of_groups(root) == UINT64_MAX);
    put("/sys/fs/cgroup/shop/cpu.max", "250000 100000\n");
    assert_true(processors_of_groups(root) == 3);
    put("/sys/fs/cgroup/shop/night/cpu.max", "20000 100000\n");
    assert_true(processors_of_groups(root) == 1);
    assert_true(memory_of_groups(root) == UINT64_MAX);
    remove_root();
    memcpy(strrchr(root, '-'), "-XXXXXX", 7); // for the next test
    assert_true(lam_processors_available() >= 1);
}

TEST(test_memory_of_groups)
{
    assert_non_null(mkdtemp(root));
    assert_true(memory_of_groups(root) == UINT64_MAX);
    // cgroup v2: the smallest limit of the group and its ancestors.
    put("/proc/self/cgroup", "0::/shop/night/job\n");
    put("/sys/fs/cgroup/shop/night/job/memory.max", "max\n");
    assert_true(memory_of_groups(root) == UINT64_MAX);
    put("/sys/fs/cgroup/shop/night/memory.max", "3000000000\n");
    assert_true(memory_of_groups(root) == 3000000000);
    put("/sys/fs/cgroup/shop/memory.max", "2000000000\n");
    assert_true(memory_of_groups(root) == 2000000000);
    put("/sys/fs/cgroup/shop/night/job/memory.max", "536870912\n");
    assert_true(memory_of_groups(root) == 536870912);
    // In a container, the group's path is the host's, and the mount's root is the group.
    put("/proc/self/cgroup", "0::/docker/0123\n");
    assert_true(memory_of_groups(root) == UINT64_MAX);
    put("/sys/fs/cgroup/memory.max", "700000000\n");
    assert_true(memory_of_groups(root) == 700000000);
    remove_root();
    // v1 next to a v2 without memory; "cpu,memory" is a list, and "memory2" is another word.
    put("/proc/self/cgroup", "9:name=systemd:/\n5:memory2:/x\n4:cpu,memory:/a/b\n3:cpuset:/\n0::/\n");
    put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    put("/sys/fs/cgroup/memory/x/memory.limit_in_bytes", "1\n");
    assert_true(memory_of_groups(root) == 9223372036854771712u);
    put("/sys/fs/cgroup/memory/a/b/memory.limit_in_bytes", "400000000\n");
    assert_true(memory_of_groups(root) == 400000000);
    put("/sys/fs/cgroup/memory/a/memory.limit_in_bytes", "300000000\n");
    assert_true(memory_of_groups(root) == 300000000);
    put("/proc/self/cgroup", "4:memory\n\n:\n::\n");
    assert_true(memory_of_groups(root) == UINT64_MAX);
    remove_root();
}

TEST(test_memory_of_process)
{
    struct rlimit before;
    uint64_t machine = lam_memory_available();
    assert_true(machine > 1 << 20);
    assert_int_equal(getrlimit(RLIMIT_DATA, &before), 0);
    if (machine <= (uint64_t)1 << 31) {
        print_message("less than 2 GiB are available: the limit of a process was not tested\n");
        skip();
    }
    assert_int_equal(setrlimit(RLIMIT_DATA, &(struct rlimit){(rlim_t)1 << 31, before.rlim_max}), 0);
    assert_true(lam_memory_available() == (uint64_t)1 << 31);
    assert_int_equal(setrlimit(RLIMIT_DATA, &before), 0);
    assert_true(lam_memory_available() == machine);
}

TEST(test_limits)
{
    struct call_control call;
    lam_error error = {0};
    assert_true(call_triangle_limit(NULL) == LAM_TRIANGLE_LIMIT && call_pixel_limit(NULL) == LAM_PIXEL_LIMIT);
    assert_true(call_check_file(NULL, "a", LAM_FILE_LIMIT_BYTES, &error) &&
                call_json_depth_limit(NULL) == LAM_JSON_DEPTH_LIMIT);
    assert_false(call_check_file(NULL, "a", (uint64_t)LAM_FILE_LIMIT_BYTES + 1, &error));
    call_start(&call, NULL);
    assert_true(call_triangle_limit(&call) == LAM_TRIANGLE_LIMIT);
    assert_true(call_check_triangles(&call, "a", LAM_TRIANGLE_LIMIT, "triangles", &error));
    assert_false(call_check_triangles(&call, "a", LAM_TRIANGLE_LIMIT + 1, "triangles", &error));
    assert_int_equal(error.code, LAM_LIMIT);
    assert_string_equal(error.text, "a: 200000001 triangles, expected at most 200000000 (lam_control.triangle_limit)");
    call_start(&call, &(lam_control){.file_limit_bytes = 10, .json_depth_limit = 1000000, .pixel_limit = 7});
    assert_true(call_pixel_limit(&call) == 7 && call_json_depth_limit(&call) == LAM_JSON_DEPTH_MAX);
    assert_true(call_check_file(&call, "f", 10, &error));
    assert_false(call_check_file(&call, "f", 11, &error));
    assert_string_equal(error.text, "f: 11 bytes, expected at most 10 (lam_control.file_limit_bytes)");
    // The error about memory contains the numbers of the refused request, whatever is read or freed afterwards.
    call_start(&call, NULL);
    call_add_input(&call, 1000);
    assert_true(call_charge(&call, 400000000) && !call_charge(&call, 300000000));
    call_refund(&call, 400000000);
    call_add_input(&call, 200000);
    assert_false(call_memory_error(&call, 10, &error));
    assert_non_null(strstr(error.text, "700.0 MB of memory are needed, expected at most 502.0 MB"));
}

// Waits for the other thread, so that each takes one task, and stores the size of its thread's stack.
static void measure_stack(void *user, size_t index, int thread)
{
    static int begun;
    pthread_attr_t attributes;
    (void)index;
    __atomic_fetch_add(&begun, 1, __ATOMIC_SEQ_CST);
    while (__atomic_load_n(&begun, __ATOMIC_SEQ_CST) < 2)
        sched_yield();
    assert_int_equal(pthread_getattr_np(pthread_self(), &attributes), 0);
    assert_int_equal(pthread_attr_getstacksize(&attributes, (size_t *)user + thread), 0);
    pthread_attr_destroy(&attributes);
}

// The system's default, which depends on `ulimit -s`, may be too small for drawing.
TEST(test_stack_of_workers)
{
    pthread_attr_t before, small;
    size_t sizes[2] = {0};
    assert_int_equal(pthread_getattr_default_np(&before), 0);
    pthread_attr_init(&small);
    pthread_attr_setstacksize(&small, 128 << 10);
    assert_int_equal(pthread_setattr_default_np(&small), 0);
    struct pool *pool = pool_make(2);
    assert_int_equal(pool_threads(pool), 2);
    pool_run(pool, 2, measure_stack, sizes);
    pool_free(pool);
    assert_int_equal(pthread_setattr_default_np(&before), 0);
    assert_true(sizes[1] >= 1 << 20);
}
