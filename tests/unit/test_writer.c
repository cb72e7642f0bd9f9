// test_writer.c: the process that writes files for the sandboxed process: its rights, several threads at once, and the
// end of either process.
#include "test.h"
#include "sandbox.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <lambent/path.h>

static char folder[] = "/tmp/lambent-writer-XXXXXX";

static char *in_folder(const char *name)
{
    static _Thread_local char path[2][300];
    static _Thread_local int next;
    next ^= 1;
    snprintf(path[next], sizeof path[next], "%s/%s", folder, name);
    return path[next];
}

static enum writer_right rule(void *user, const char *path)
{
    const char *name = strrchr(path, '/') + 1;
    assert_string_equal(user, "rule");
    return strncmp(name, "any", 3) == 0       ? WRITER_ANY
           : strncmp(name, "ours", 4) == 0    ? WRITER_NEW_OR_OURS
           : strncmp(name, "implied", 7) == 0 ? WRITER_ANY
           : strncmp(name, "new", 3) == 0     ? WRITER_NEW
           : strcmp(name, "log") == 0         ? WRITER_REMOVES
                                              : WRITER_NONE;
}

static bool save(const char *name, const char *text, lam_error *error)
{
    *error = (lam_error){0};
    return writer_save(in_folder(name), &(lam_bytes){(void *)(uintptr_t)text, strlen(text)}, false, error);
}

static void put(const char *name, const char *text)
{
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void assert_contains(const char *name, const char *text)
{
    char found[100] = "";
    FILE *file = fopen(in_folder(name), "r");
    assert_non_null(file);
    size_t size = fread(found, 1, sizeof found - 1, file);
    fclose(file);
    found[size] = 0;
    assert_string_equal(found, text);
}

static int count_files(void)
{
    int count = 0;
    DIR *list = opendir(folder);
    for (struct dirent *entry; (entry = readdir(list));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(list);
    return count;
}

static bool start_writer(int threads, uint64_t largest)
{
    lam_error error;
    struct sandbox_paths paths = {.may_write = rule, .user = "rule", .writers = threads};
    sandbox_add(&paths, folder, SANDBOX_MAKE);
    bool ok = lam_path_hold(folder, false, &error) && writer_start(&paths, largest, &error);
    sandbox_paths_free(&paths);
    return ok;
}

static int start(void **state)
{
    (void)state;
    umask(022);
    memcpy(strrchr(folder, '-') + 1, "XXXXXX", 6);
    return !mkdtemp(folder) || !start_writer(2, 100 << 20);
}

static int end(void **state)
{
    (void)state;
    char command[100];
    writer_end();
    assert_false(writer_is_there());
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

// The user names a link: it is held before the writer starts.
static int start_named(void **state)
{
    lam_error error;
    if (start(state))
        return 1;
    writer_end();
    put("precious", "of the user");
    return symlink("precious", in_folder("any link")) || !lam_path_hold(in_folder("any link"), false, &error) ||
           !start_writer(2, 100 << 20);
}

TEST(test_rights, .setup_func = start, .teardown_func = end)
{
    lam_error error;
    assert_true(writer_is_there() && writer_process() != getpid());
    // Any file is replaced, a new folder is created, and nothing is executable.
    put("any", "a program");
    assert_int_equal(chmod(in_folder("any"), 04755), 0);
    assert_true(save("any", "1", &error));
    assert_contains("any", "1");
    struct stat about;
    assert_true(stat(in_folder("any"), &about) == 0 && (about.st_mode & 07777) == 0644);
    assert_true(save("new/any", "2", &error));
    // Of the files with one name, new files and its own, as long as nobody changes them.
    assert_true(save("ours", "3", &error) && save("ours", "4", &error));
    put("ours", "of the user");
    assert_false(save("ours", "5", &error));
    assert_int_equal(error.code, LAM_CANNOT_WRITE);
    assert_non_null(strstr(error.text, "ours: cannot write: already exists, and lambent did not write it"));
    assert_contains("ours", "of the user");
    // No other.
    put("other", "of the user");
    assert_false(save("other", "6", &error));
    assert_non_null(strstr(error.text, "other: cannot write: this run may not write the file"));
    assert_false(save("log", "7", &error));
    assert_contains("other", "of the user");
    assert_int_equal(mkdir(in_folder("any folder"), 0777), 0);
    assert_false(save("any folder", "8", &error));
    assert_non_null(strstr(error.text, "is a directory"));
    // It removes permitted files.
    put("log", "");
    writer_remove(in_folder("log"));
    writer_remove(in_folder("other"));
    writer_remove(in_folder("any"));
    assert_int_equal(access(in_folder("log"), F_OK), -1);
    assert_int_equal(access(in_folder("other"), F_OK), 0);
    assert_int_equal(access(in_folder("any"), F_OK), 0);
}

// A name that the user did not give is written only to a regular file or a new file, and not through a link.
TEST(test_implied, .setup_func = start_named, .teardown_func = end)
{
    lam_error error;
    assert_int_equal(symlink("precious", in_folder("implied link")), 0);
    assert_int_equal(symlink("missing", in_folder("implied end")), 0);
    assert_false(save("implied link", "1", &error) || save("implied end", "1", &error));
    assert_non_null(strstr(error.text, "is a link"));
    assert_contains("precious", "of the user");
    assert_int_equal(access(in_folder("missing"), F_OK), -1);
    assert_true(save("implied", "2", &error) && save("implied", "3", &error) && save("new", "4", &error));
    assert_false(save("new", "5", &error));
    assert_contains("new", "4");
    assert_true(save("any link", "6", &error)); // the user named the link
    assert_contains("precious", "6");
    // The path and the size are checked before the contents arrive.
    size_t size = 101 << 20;
    char *large = calloc(1, size);
    assert_non_null(large);
    assert_false(writer_save(in_folder("other"), &(lam_bytes){large, size}, false, &error));
    assert_non_null(strstr(error.text, "this run may not write the file"));
    assert_false(writer_save(in_folder("any"), &(lam_bytes){large, size}, false, &error));
    assert_true(error.code == LAM_LIMIT && strstr(error.text, "--memory-limit"));
    free(large);
    assert_true(save("any", "7", &error));
}

static bool save_set(const char *second, lam_error *error)
{
    char first[300];
    snprintf(first, sizeof first, "%s", in_folder("any first"));
    static char one[] = "one", two[] = "two";
    const struct writer_file files[] = {{.path = first, .bytes = {one, 3}, .right = WRITER_ANY},
                                        {.path = in_folder(second), .bytes = {two, 3}, .right = WRITER_ANY}};
    *error = (lam_error){0};
    return writer_save_all(files, 2, error);
}

// All files of a set are replaced, or none, with the writer and without.
TEST(test_set, .setup_func = start, .teardown_func = end)
{
    lam_error error;
    put("any first", "older");
    assert_int_equal(chmod(in_folder("any first"), 0640), 0);
    put("precious", "of the user");
    assert_int_equal(symlink("precious", in_folder("implied link")), 0);
    for (int pass = 0; pass < 2; pass++) {
        assert_false(save_set("implied link", &error) || save_set("no/folder/implied", &error));
        assert_contains("any first", "older");
        assert_contains("precious", "of the user");
        assert_int_equal(count_files(), 3);
        assert_true(save_set("implied second", &error));
        assert_contains("any first", "one");
        assert_contains("implied second", "two");
        struct stat about;
        assert_true(stat(in_folder("any first"), &about) == 0 && (about.st_mode & 07777) == 0640);
        assert_int_equal(count_files(), 4);
        put("any first", "older");
        assert_int_equal(unlink(in_folder("implied second")), 0);
        writer_end();
    }
}

enum { THREADS = 5, ROUNDS = 40 };

static void *save_many(void *user)
{
    size_t size = 300000 + (size_t)(uintptr_t)user;
    char name[30], *text = malloc(size);
    memset(text, 'a', size);
    lam_error error;
    size_t good = 0;
    for (int i = 0; i < ROUNDS; i++) {
        snprintf(name, sizeof name, "any-%d-%d", (int)(uintptr_t)user, i);
        good += writer_save(in_folder(name), &(lam_bytes){text, size}, i == 0, &error);
    }
    free(text);
    return (void *)good;
}

// More threads than connections take turns.
TEST(test_threads, .setup_func = start, .teardown_func = end)
{
    pthread_t threads[THREADS];
    struct stat about;
    char name[30];
    for (size_t i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, save_many, (void *)i), 0);
    for (size_t i = 0; i < THREADS; i++) {
        void *good;
        pthread_join(threads[i], &good);
        assert_int_equal((size_t)good, ROUNDS);
        snprintf(name, sizeof name, "any-%zu-%d", i, ROUNDS - 1);
        assert_int_equal(stat(in_folder(name), &about), 0);
        assert_int_equal(about.st_size, 300000 + i);
    }
    assert_int_equal(count_files(), THREADS * ROUNDS);
}

// The end of the writer is an error, not a signal.
TEST(test_writer_ends, .setup_func = start, .teardown_func = end)
{
    lam_error error;
    assert_true(save("any", "1", &error));
    assert_int_equal(kill(writer_process(), SIGKILL), 0);
    for (int i = 0; i < 3; i++) {
        assert_false(save("any", "2", &error));
        assert_int_equal(error.code, LAM_CANNOT_WRITE);
        assert_non_null(strstr(error.text, "the process that writes files has ended"));
    }
    assert_contains("any", "1");
}

// Signals that end the process leave no partial files and no writer.
TEST(test_process_ends, .setup_func = start, .teardown_func = end)
{
    static const int signals[] = {SIGTERM, SIGKILL, SIGABRT, SIGPIPE, SIGUSR1};
    enum { LARGE = 3 << 20 };
    char *text = calloc(1, LARGE);
    for (size_t i = 0; i < 20; i++) {
        lam_error error;
        int ready[2], status = 0;
        assert_int_equal(pipe(ready), 0);
        pid_t child = fork();
        if (child == 0) {
            writer_leave();
            bool ok = start_writer(1, 0) && write(ready[1], &(pid_t){writer_process()}, sizeof(pid_t)) > 0;
            for (int k = 0; ok && k < 1000; k++)
                ok = writer_save(in_folder("any"), &(lam_bytes){text, LARGE}, false, &error);
            _exit(ok);
        }
        pid_t writer;
        assert_int_equal(read(ready[0], &writer, sizeof writer), sizeof writer);
        usleep((unsigned)(1000 + 700 * i));
        kill(child, signals[i % 5]);
        waitpid(child, &status, 0);
        assert_true(WIFSIGNALED(status));
        close(ready[1]);
        for (int k = 0; k < 2000 && kill(writer, 0) == 0; k++) { // a process that nobody waits for may stay as a zombie
            char path[40], line[200] = "";
            snprintf(path, sizeof path, "/proc/%d/stat", (int)writer);
            FILE *file = fopen(path, "r");
            bool zombie = file && fgets(line, sizeof line, file) && strstr(line, ") Z ");
            if (file)
                fclose(file);
            if (zombie)
                break;
            usleep(1000);
            assert_true(k < 1999);
        }
        close(ready[0]);
        struct stat about;
        assert_true(stat(in_folder("any"), &about) != 0 || about.st_size == LARGE);
        assert_true(count_files() <= 1);
    }
    free(text);
}

// A closed standard stream does not become a connection.
TEST(test_closed_streams, .setup_func = start, .teardown_func = end)
{
    int status = 0;
    pid_t child = fork();
    if (child == 0) {
        lam_error error;
        writer_leave();
        close(STDIN_FILENO);
        close(STDOUT_FILENO);
        close(STDERR_FILENO);
        bool ok = start_writer(1, 0) && write(STDERR_FILENO, "a", 1) < 0 && save("any", "1", &error);
        writer_end();
        _exit(!ok);
    }
    waitpid(child, &status, 0);
    assert_int_equal(status, 0);
    assert_contains("any", "1");
}
