// test_path.c: files are opened below the handles of folders, with openat2 and without, while links come and go.
#include "test.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/syscall.h>

#include <lambent/path.h>

static bool is_old; // a kernel without openat2

long __real_syscall(long number, ...);
long __wrap_syscall(long number, ...);
long __wrap_syscall(long number, ...)
{
    va_list list;
    va_start(list, number);
    long given[6] = {0};
    for (int i = 0; i < (number == SYS_openat2 ? 4 : 3); i++) // the program's own calls pass no more
        given[i] = va_arg(list, long);
    va_end(list);
    if (number == SYS_openat2 && is_old) {
        errno = ENOSYS;
        return -1;
    }
    return __real_syscall(number, given[0], given[1], given[2], given[3], given[4], given[5]);
}

// Opens a file and returns its first byte; or '-' and the reason if it cannot be opened.
static int first_byte(const char *path, int *reason)
{
    char byte = '-';
    int file = lam_path_open(path, O_RDONLY | O_CLOEXEC);
    *reason = file < 0 ? errno : 0;
    if (file >= 0)
        assert_int_equal(read(file, &byte, 1), 1);
    lam_path_close(file);
    return byte;
}

static void run(const char *command) { assert_int_equal(system(command), 0); }

static char place[] = "/tmp/lambent-path-XXXXXX";

static int start(void **state)
{
    lam_error error;
    (void)state;
    return !mkdtemp(place) || chdir(place) != 0 ||
           system("mkdir -p top/sub far allowed out && printf a >top/a && printf s >top/sub/s && printf f >far/f &&"
                  "printf l >allowed/l && ln -s sub/s top/in && ln -s ../far/f top/out && ln -s ../allowed/l top/may &&"
                  "ln -s sub top/folder && ln -s ../far top/away && ln -s nowhere top/gone && ln -s far/f named &&"
                  "ln -s far indirect && ln -s \"$PWD/top/a\" top/whole && mkfifo pipe && ln -s pipe tap") != 0 ||
           !lam_path_hold("allowed", true, &error) || !lam_path_hold("top", false, &error) ||
           !lam_path_hold("named", false, &error) || !lam_path_hold("indirect/new/x", false, &error) ||
           !lam_path_hold("out/", false, &error) || !lam_path_hold("tap", false, &error);
}

TEST(test_open)
{
    static const struct {
        const char *path;
        char with, without; // the first byte if links below the folder are followed, and if they are not
        int reason;         // of the first
    } cases[] = {
        {"top/a", 'a', 'a', 0},         {"./top//sub/../a", 'a', 'a', 0}, {"top/sub/../../top/sub/s", 's', 's', 0},
        {"top/in", 's', '-', 0},        {"top/folder/s", 's', '-', 0},    {"top/whole", 'a', '-', 0},
        {"top/may", 'l', '-', 0},       {"top/out", '-', '-', EXDEV},     {"top/away/f", '-', '-', EXDEV},
        {"top/gone", '-', '-', ENOENT}, {"top/none", '-', '-', ENOENT},   {"top/a/b", '-', '-', ENOTDIR},
        {"named", 'f', 'f', 0},                                 // the user named the link
        {"indirect/f", 'f', 'f', 0},                            // and this one
        {"top/../far/f", 'f', 'f', 0},  {"far/f", 'f', 'f', 0}, // no held folder
    };
    for (int pass = 0; pass < 4; pass++) {
        is_old = pass % 2;
        if (pass == 2)
            lam_path_refuse_links();
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            int reason, byte = first_byte(cases[i].path, &reason);
            if (byte != (pass < 2 ? cases[i].with : cases[i].without) || (pass < 2 && reason != cases[i].reason))
                fail_msg("%s in pass %d: '%c' (%s)", cases[i].path, pass, byte, strerror(reason));
        }
    }
    assert_true(lam_path_is_below("top/new/x", "top") && lam_path_is_below("top/../top", "./top"));
    assert_false(lam_path_is_below("top/../far/f", "top") || lam_path_is_below("topmost", "top"));
}

// Nothing is read or written outside, whatever the names lead to.
TEST(test_exchange)
{
    lam_error error;
    int reason;
    static const lam_bytes bytes = {(uint8_t *)"new", 3};
    for (int pass = 0; pass < 2; pass++) {
        is_old = pass;
        run("mv top real && ln -s far top && printf x >far/a && mv out real-out && ln -s far out");
        assert_int_equal(first_byte("top/a", &reason), 'a');
        assert_int_equal(first_byte("top/f", &reason), '-');
        assert_true(lam_bytes_save(&bytes, "out/p", &error));
        assert_true(lam_bytes_save(&bytes, "out/p", &error));
        run("test \"$(cat real-out/p)\" = new && test ! -e far/p && rm real-out/p && ln -s ../far/f real-out/p");
        assert_false(lam_bytes_save(&bytes, "out/p", &error)); // a link that the user did not name
        assert_non_null(strstr(error.text, "a link is in the way"));
        run("test \"$(cat far/f)\" = f && rm real-out/p && rm top out far/a && mv real top && mv real-out out");
        assert_true(lam_bytes_save(&bytes, "named", &error)); // the user's own link
        run("test -L named && test \"$(cat far/f)\" = new && printf f >far/f");
    }
}

static int end(void **state)
{
    (void)state;
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", place);
    return system(command);
}

FIXTURE(start, end)
