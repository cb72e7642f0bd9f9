// test_file.c: files are complete or do not appear, and no other files remain in their folder, whatever ends the
// process.
#include "test.h"
#include "file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>

#include "temporary_folder.h"

enum { LARGE = 6 << 20 };

static uint8_t *bytes; // LARGE bytes
static const char *const way_names[] = {[FILE_UNNAMED] = "unnamed", [FILE_NAMED] = "named"};

// Removes everything in the folder and returns the number of its files. Each must have LARGE bytes, or `other` bytes.
static int empty_folder(size_t other, const char *doing)
{
    int count = 0;
    char bad[300] = "";
    DIR *list = opendir(folder);
    assert_non_null(list);
    for (struct dirent *entry; (entry = readdir(list));) {
        struct stat about;
        if (entry->d_name[0] == '.' && (!entry->d_name[1] || entry->d_name[1] == '.'))
            continue;
        assert_int_equal(lstat(in_folder(entry->d_name), &about), 0);
        if (S_ISREG(about.st_mode) && about.st_size != LARGE && (size_t)about.st_size != other && about.st_size != 5)
            snprintf(bad, sizeof bad, "%s has %ld bytes", entry->d_name, (long)about.st_size);
        unlink(in_folder(entry->d_name));
        count++;
    }
    closedir(list);
    if (*bad)
        fail_msg("%s: %s", doing, bad);
    return count;
}

static int set_up(void **state)
{
    (void)state;
    umask(022);
    snprintf(folder, sizeof folder, "/tmp/lambent-file-XXXXXX");
    bytes = malloc(LARGE);
    for (size_t i = 0; bytes && i < LARGE; i++)
        bytes[i] = (uint8_t)(i * 7 + i / 300);
    return mkdtemp(folder) && bytes ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    free(bytes);
    return rmdir(folder);
}

static void assert_holds(const char *name, const uint8_t *data, size_t size, mode_t mode)
{
    struct file_bytes found;
    struct stat about;
    lam_error error;
    assert_true(file_read(in_folder(name), NULL, NULL, &found, &error));
    assert_int_equal(found.size, size);
    assert_memory_equal(found.data, data, size);
    file_release(&found);
    assert_int_equal(stat(in_folder(name), &about), 0);
    assert_int_equal(about.st_mode & 07777, mode);
}

TEST(test_written_and_replaced)
{
    mode_t before = umask(027);
    for (enum file_way way = FILE_UNNAMED; way <= FILE_NAMED; way++) {
        lam_error error;
        const char *path = in_folder("x");
        assert_true(file_write_by(way, path, bytes, LARGE, NULL, &error));
        assert_holds("x", bytes, LARGE, 0640);
        assert_int_equal(chmod(in_folder("x"), 0604), 0);
        assert_true(file_write_by(way, in_folder("x"), bytes + 1, 1000, NULL, &error)); // keeps its mode
        assert_holds("x", bytes + 1, 1000, 0604);
        assert_int_equal(symlink("x", in_folder("link")), 0); // its target is replaced
        assert_true(file_write_by(way, in_folder("link"), bytes, 0, NULL, &error));
        assert_holds("x", bytes, 0, 0604);
        assert_int_equal(unlink(in_folder("x")), 0);
        assert_true(file_write_by(way, in_folder("link"), bytes, 5, NULL, &error)); // it was a broken link
        struct stat about;
        assert_true(lstat(in_folder("link"), &about) == 0 && S_ISREG(about.st_mode));
        // A name of the maximum length.
        char name[256];
        memset(name, 'n', 255);
        name[255] = 0;
        assert_true(file_write_by(way, in_folder(name), bytes, 5, NULL, &error));
        assert_true(file_write_by(way, in_folder(name), bytes, 7, NULL, &error));
        assert_int_equal(empty_folder(7, "names"), 2);
    }
    umask(before);
}

TEST(test_failures_leave_nothing)
{
    for (enum file_way way = FILE_UNNAMED; way <= FILE_NAMED; way++) {
        lam_error error;
        assert_false(file_write_by(way, in_folder("no/x"), bytes, 10, NULL, &error));
        assert_int_equal(error.code, LAM_CANNOT_WRITE);
        assert_non_null(strstr(error.text, "No such file or directory"));
        assert_false(file_write_by(way, folder, bytes, 10, NULL, &error));
        assert_non_null(strstr(error.text, "is a directory"));
        // Cancelled during writing: the old file remains.
        assert_true(file_write_by(way, in_folder("x"), bytes, 10, NULL, &error));
        lam_cancel cancel = {0};
        lam_cancel_raise(&cancel);
        lam_control control = {.cancel = &cancel};
        struct call_control call;
        call_start(&call, &control);
        assert_false(file_write_by(way, in_folder("x"), bytes, LARGE, &call, &error));
        assert_int_equal(error.code, LAM_CANCELLED);
        assert_holds("x", bytes, 10, 0644);
        assert_int_equal(empty_folder(10, "cancelled"), 1);
    }
}

// --- signals

static bool ends_a_process(int number)
{
    static const int others[] = {SIGKILL, SIGSTOP, SIGTSTP, SIGTTIN, SIGTTOU, SIGCONT, SIGCHLD, SIGURG, SIGWINCH};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i] == number)
            return false;
    return number < 32 || number >= SIGRTMIN;
}

static void default_dispositions(void)
{
    struct rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
    for (int number = 1; number < NSIG; number++)
        signal(number, SIG_DFL);
    sigset_t empty;
    sigemptyset(&empty);
    sigprocmask(SIG_SETMASK, &empty, NULL);
}

// Kills a process that writes endlessly, after some time. It writes one name again and again, or new names each time.
static void kill_writer(enum file_way way, int number, bool same_name, unsigned delay_us)
{
    char doing[80];
    snprintf(doing, sizeof doing, "%s, signal %d, %s", way_names[way], number, same_name ? "replaced" : "new");
    int ready[2];
    char byte = 0;
    assert_int_equal(pipe(ready), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        default_dispositions();
        if (write(ready[1], &byte, 1) != 1)
            _exit(1);
        for (int i = 0;; i++) {
            char name[32];
            snprintf(name, sizeof name, "x%d", same_name ? 0 : i);
            if (!file_write_by(way, in_folder(name), bytes, LARGE, NULL, NULL))
                _exit(1);
            if (!same_name && i > 0) { // limits the space
                snprintf(name, sizeof name, "x%d", i - 1);
                unlink(in_folder(name));
            }
        }
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    close(ready[0]);
    close(ready[1]);
    usleep(delay_us);
    int status;
    kill(child, number);
    assert_int_equal(waitpid(child, &status, 0), child);
    if (!WIFSIGNALED(status) || WTERMSIG(status) != number)
        fail_msg("%s: ended with status %x", doing, status);
    int left = empty_folder(LARGE, doing); // only complete files
    if (left > (same_name ? 1 : 2))
        fail_msg("%s: left %d files", doing, left);
}

TEST(test_signals_leave_nothing)
{
    srandom(7);
    for (enum file_way way = FILE_UNNAMED; way <= FILE_NAMED; way++)
        for (int number = 1; number < NSIG; number++)
            for (int same = 0; same < 2 && ends_a_process(number); same++)
                kill_writer(way, number, same, (unsigned)(random() % 8000) + 500);
}

// SIGKILL takes effect immediately. A file without a name disappears with its process. Only in the microseconds between
// link and rename, when the name exists, could a complete file remain, so this test writes new names.
TEST(test_kill_leaves_nothing)
{
    srandom(8);
    for (int i = 0; i < 60; i++)
        kill_writer(FILE_UNNAMED, SIGKILL, false, (unsigned)(random() % 12000) + 100);
}

TEST(test_file_size_limit)
{
    for (enum file_way way = FILE_UNNAMED; way <= FILE_NAMED; way++)
        for (int ignored = 0; ignored < 2; ignored++) {
            pid_t child = fork();
            assert_true(child >= 0);
            if (child == 0) {
                default_dispositions();
                struct rlimit limit = {1 << 20, 1 << 20};
                setrlimit(RLIMIT_FSIZE, &limit);
                signal(SIGXFSZ, ignored ? SIG_IGN : SIG_DFL);
                lam_error error = {0};
                bool ok = file_write_by(way, in_folder("x"), bytes, LARGE, NULL, &error);
                _exit(!ok && strstr(error.text, "File too large") ? 0 : 1);
            }
            int status;
            assert_int_equal(waitpid(child, &status, 0), child);
            assert_true(ignored ? WIFEXITED(status) && WEXITSTATUS(status) == 0
                                : WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ);
            assert_int_equal(empty_folder(0, "limit"), 0);
        }
}

// The caller's handlers run during the call, and its signal mask is restored.
static volatile sig_atomic_t alarms;
static void count_alarm(int number)
{
    (void)number;
    alarms++;
}

TEST(test_handlers_run)
{
    struct sigaction action = {.sa_handler = count_alarm}, old;
    sigaction(SIGALRM, &action, &old);
    for (enum file_way way = FILE_UNNAMED; way <= FILE_NAMED; way++) {
        alarms = 0;
        struct itimerval often = {{0, 200}, {0, 200}}, never = {0};
        setitimer(ITIMER_REAL, &often, NULL);
        lam_error error;
        for (int i = 0; i < 20; i++) {
            assert_true(file_write_by(way, in_folder("x"), bytes, LARGE, NULL, &error));
            sigset_t now;
            sigprocmask(SIG_BLOCK, NULL, &now);
            assert_int_equal(sigismember(&now, SIGALRM), 0);
            assert_int_equal(sigismember(&now, SIGTERM), 0);
        }
        setitimer(ITIMER_REAL, &never, NULL);
        assert_true(alarms > 20);
        assert_holds("x", bytes, LARGE, 0644);
        assert_int_equal(empty_folder(0, "alarms"), 1);
    }
    sigaction(SIGALRM, &old, NULL);
}

// A file named in another file is opened below its folder: a link or ".." that appeared in its path after the check
// leads nowhere.
TEST(test_beneath)
{
    struct file_bytes read = {0};
    lam_error error;
    bool outside = true;
    size_t length = 0;
    assert_int_equal(mkdir(in_folder("in"), 0777), 0);
    assert_true(file_write(in_folder("in/a"), "inside", 6, false, NULL, &error));
    assert_true(file_write(in_folder("secret"), "outside", 7, false, NULL, &error));
    char in[100], path[200];
    snprintf(in, sizeof in, "%s/in", folder);
    char *real = path_within(in_folder("in/a"), in, &outside, &length);
    assert_non_null(real);
    assert_false(outside);
    assert_string_equal(real + length, "a");
    assert_true(file_read_named(real, length, NULL, true, NULL, NULL, &read, &error));
    assert_int_equal(read.size, 6);
    file_release(&read);
    free(real);
    static const char *const ways[] = {"out", "dots/../../secret", "../secret"};
    assert_int_equal(symlink("../secret", in_folder("in/out")), 0);
    assert_int_equal(mkdir(in_folder("in/dots"), 0777), 0);
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", in, ways[i]);
        assert_false(file_read_named(path, strlen(in) + 1, "shown", true, NULL, NULL, &read, &error));
        assert_int_equal(error.code, LAM_CANNOT_READ);
        assert_true(strncmp(error.text, "shown: cannot open: ", 20) == 0);
        assert_true(file_read_named(path, 0, NULL, true, NULL, NULL, &read, &error)); // alone, it can be read
        file_release(&read);
        free(path_within(path, in, &outside, &length));
        assert_true(outside);
    }
    unlink(in_folder("in/out"));
    unlink(in_folder("in/a"));
    rmdir(in_folder("in/dots"));
    rmdir(in_folder("in"));
    unlink(in_folder("secret"));
}

// --- durable: the linker redirects the calls of file_write.c to these functions

static char calls[200];
static int failing; // the errno of the next fsync(); 0 means success

static void note(const char *name)
{
    size_t used = strlen(calls);
    snprintf(calls + used, sizeof calls - used, "%s%s", used ? " " : "", name);
}

int __real_fsync(int file);
int __wrap_fsync(int file);
int __wrap_fsync(int file)
{
    struct stat about;
    assert_int_equal(fstat(file, &about), 0);
    note(S_ISDIR(about.st_mode) ? "folder" : "file");
    errno = failing;
    return failing ? -1 : __real_fsync(file);
}

int __real_renameat(int from_folder, const char *from, int to_folder, const char *to);
int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to);
int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to)
{
    note("rename");
    return __real_renameat(from_folder, from, to_folder, to);
}

int __real_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags);
int __wrap_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags);
int __wrap_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags)
{
    note("link");
    return __real_linkat(from_folder, from, to_folder, to, flags);
}

// The file is on the disk before its name refers to it, and the name before the call returns; if the disk fails, the
// old file remains.
TEST(test_durable)
{
    lam_error error;
    for (unsigned way = FILE_UNNAMED; way <= FILE_NAMED; way++) {
        static const char *const made[] = {"file link folder", "file rename folder"};
        static const char *const replaced[] = {"file link rename folder", "file rename folder"};
        calls[0] = 0;
        assert_true(file_write_by(way | FILE_DURABLE, in_folder("d"), bytes, 5, NULL, &error));
        if (way == FILE_UNNAMED && strstr(calls, "link") == NULL) { // the file system has no unnamed files
            empty_folder(5, "durable");
            continue;
        }
        assert_string_equal(calls, made[way]);
        calls[0] = 0;
        assert_true(file_write_by(way | FILE_DURABLE, in_folder("d"), bytes, LARGE, NULL, &error));
        assert_string_equal(calls, replaced[way]);
        for (failing = EIO; failing; failing = failing == EIO ? ENOSPC : 0) {
            assert_false(file_write_by(way | FILE_DURABLE, in_folder("d"), bytes, 7, NULL, &error));
            assert_int_equal(error.code, LAM_CANNOT_WRITE);
            assert_non_null(strstr(error.text, failing == EIO ? "Input/output error" : "No space left"));
            assert_holds("d", bytes, LARGE, 0644);
        }
        failing = EINVAL; // a file system without this operation
        assert_true(file_write_by(way | FILE_DURABLE, in_folder("d"), bytes, 5, NULL, &error));
        failing = 0;
        assert_int_equal(empty_folder(5, "durable"), 1);
        calls[0] = 0;
        assert_true(file_write_by(way, in_folder("d"), bytes, 5, NULL, &error));
        assert_null(strstr(calls, "f")); // neither file nor folder
        assert_int_equal(empty_folder(5, "not durable"), 1);
    }
}

FIXTURE(set_up, tear_down)
