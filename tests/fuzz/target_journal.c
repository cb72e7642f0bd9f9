// target_journal.c: fuzz target for journals of `lambent batch`. An input is a byte of options, the journal, and after
// a zero byte the file FILE.running of a killed run. The run continues the journal, as --resume and --skip-same do, and
// the command `journal` sums it.
#include "own_folder.h"
#include "target.h"

#include "journal.h"

static void visit(void *user, const char *model, int process, const char *host)
{
    size_t *bytes = user;
    (void)process;
    *bytes += strlen(model) + strlen(host);
}

static void sum(const char *path, bool twice)
{
    struct journal_sum all = {0};
    lam_error error = {0};
    bool ok = journal_sum_add(&all, path, &error) && (!twice || journal_sum_add(&all, path, &error));
    note_sentence(ok ? "" : error.text);
    if (ok != (error.code == LAM_OK))
        abort();
    for (size_t i = 0; ok && i < all.count; i++) {
        json_t *record = journal_sum_record(&all, i);
        if (!record)
            abort();
        json_decref(record);
    }
    journal_sum_is_whole(&all);
    journal_sum_has_shard(&all, 1);
    journal_sum_free(&all);
}

// Invariant for every journal: the run continues it and adds a line that it then finds, or an error message.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[OWN_PATH], running[OWN_PATH];
    if (size < 1)
        return 0;
    const enum journal_way ways[] = {JOURNAL_RESUME, JOURNAL_SAME, JOURNAL_START, JOURNAL_SAME};
    enum journal_way way = ways[data[0] % 4];
    bool twice = data[0] & 4;
    const uint8_t *zero = memchr(data + 1, 0, size - 1);
    size_t length = zero ? (size_t)(zero - data) - 1 : size - 1, rest = zero ? size - length - 2 : 0;
    own_path(path, "j.jsonl");
    own_path(running, "j.jsonl.running");
    write_own(path, data + 1, length);
    if (rest) // FILE.running consists of slots of 8192 bytes; an input gives the beginning of the first
    {
        static uint8_t slot[2 * 8192];
        memset(slot, 0, sizeof slot);
        memcpy(slot, zero + 1, rest < sizeof slot ? rest : sizeof slot);
        write_own(running, slot, sizeof slot);
    }
    sum(path, twice);
    const struct journal_run run = {.options = "size=9\n", .folder = "out/", .pictures = 2};
    lam_error error = {0};
    struct journal *journal = journal_open(path, way, &run, 2, &error);
    note_sentence(journal ? "" : error.text);
    if (!journal != (error.code != LAM_OK))
        abort();
    if (journal) {
        size_t bytes = 0;
        journal_each_running(journal, visit, &bytes);
        json_decref(journal_find(journal, "out/a.png"));
        json_decref(journal_find(journal, "a.png"));
        journal_begin(journal, 1, 7, "a.obj");
        json_t *record = json_pack("{s:s}", "output", "out/\xc3\xa4.png");
        if (!journal_add(journal, record, &error))
            abort();
        json_decref(record);
        journal_close(journal, true, 0, false);
        journal = journal_open(path, JOURNAL_SAME, &run, 2, &error);
        record = journal ? journal_find(journal, "out/\xc3\xa4.png") : NULL;
        if (!record)
            abort();
        json_decref(record);
        journal_close(journal, true, 0, false);
        sum(path, false);
    }
    empty_folder();
    return 0;
}
