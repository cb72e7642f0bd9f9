"""_core.py: calls of the library, errors as exceptions, and work that Ctrl-C stops."""
import contextlib
import os
import queue
import re
import threading
import time

import numpy as np

from ._native import ffi, lib


class Error(Exception):
    """An error of Lambent. The text is one sentence: the file, the position in it, what was found and what was expected."""


class BadValue(Error, ValueError):
    """An argument is out of range, or cannot be combined with another one."""


class CannotRead(Error, OSError):
    """A file cannot be read."""


class FileNotFound(CannotRead, FileNotFoundError):
    """The model's file does not exist."""


class BadModel(CannotRead):
    """A file is truncated, or is not in the format that it claims."""


class Unsupported(Error, NotImplementedError):
    """The file or the option is understood, but this build or machine does not support it."""


class LimitReached(Error):
    """A limit was reached: triangles, pixels, layers, the size of a file …"""


class OutOfMemory(LimitReached, MemoryError):
    """The machine's memory, its file descriptors or `memory_limit` are not sufficient."""


class TimeLimit(LimitReached, TimeoutError):
    """The call took longer than `time_limit`."""


class CannotWrite(Error, OSError):
    """The output cannot be written."""


class Cancelled(Error):
    """The progress callback returned False."""


CLASSES = {lib.LAM_BAD_ARGUMENT: BadValue, lib.LAM_CANNOT_READ: BadModel, lib.LAM_UNSUPPORTED: Unsupported, lib.LAM_LIMIT: LimitReached,
           lib.LAM_CANNOT_WRITE: CannotWrite, lib.LAM_CANCELLED: Cancelled,
           lib.LAM_MACHINE: OutOfMemory}


def shown(value):
    """A value for an error message: its repr on one short line."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def path_bytes(path):
    """The bytes of a path. C ends strings at a zero character, so such a path would name another file."""
    try:
        data = os.fsencode(path)
    except (TypeError, UnicodeEncodeError):
        raise BadValue("found %s, expected a path" % shown(path)) from None
    if b"\0" in data:
        raise BadValue("%s: found a zero character, expected a path" % shown(path))
    return data


def text_bytes(what, value):
    """The UTF-8 of a text."""
    try:
        data = value.encode() if isinstance(value, str) else b"\0"
    except UnicodeEncodeError: # unpaired surrogates
        data = b"\0"
    if b"\0" in data:
        raise BadValue("%s: found %s, expected a string" % (what, shown(value)))
    return data


def matrix_of(what, values):
    """A 4x4 matrix of finite numbers."""
    try:
        found = np.asarray(values, float)
    except (TypeError, ValueError, OverflowError):
        raise BadValue("%s: found %s, expected 4x4 numbers" % (what, shown(values))) from None
    if found.shape != (4, 4):
        raise BadValue("%s: found the shape %s, expected 4x4" % (what, "x".join(map(str, found.shape)) or "of one number"))
    return found


def text_of(pointer):
    """A string of the library; NULL gives None."""
    return None if pointer == ffi.NULL else ffi.string(pointer).decode(errors="replace")


def every(function, *args):
    """The results of a library function for 0, 1, … until NULL: strings and rows of tables."""
    index = 0
    while (item := function(*args, index)) != ffi.NULL:
        yield text_of(item) if ffi.typeof(item) is ffi.typeof("char *") else item
        index += 1


def in_words_of_python(sentence):
    """A sentence of the library with the keywords of Python: memory_limit in place of memory_limit_bytes."""
    sentence = re.sub(r"^(cpu|lam_\w+): ", "", sentence)
    return re.sub(r"\b(?:lam_control\.)?(memory_limit|time_limit)_(?:bytes|s)\b", r"\1", sentence)


def exception(error, path=None):
    """The exception for a lam_error."""
    sentence, kind = in_words_of_python(text_of(error.text)), CLASSES.get(error.code, Error)
    if kind is BadModel and path and path != "-" and not os.path.exists(path):
        kind = FileNotFound
    if kind is LimitReached:
        kind = TimeLimit if "time limit" in sentence else OutOfMemory if "memory" in sentence else kind
    return kind(sentence)


def call(function, *args, path=None):
    """Calls a library function whose last parameter is the error; the function fails if it returns false, NULL or a negative number."""
    error = ffi.new("lam_error *")
    result = function(*args, error)
    if result is False or (isinstance(result, int) and result < 0) or (isinstance(result, ffi.CData) and result == ffi.NULL):
        raise exception(error, path)
    return result


@ffi.def_extern(onerror=lambda *caught: None)
def tell_progress(user, share, step):
    ffi.from_handle(user).put((share, text_of(step)))


class Access:
    """Many threads may read a scene at the same time, or one thread may change it."""

    def __init__(self):
        self.free, self.readers = threading.Condition(), 0

    @contextlib.contextmanager
    def shared(self):
        with self.free:
            self.readers += 1
        try:
            yield
        finally:
            with self.free:
                self.readers -= 1
                self.free.notify_all()

    @contextlib.contextmanager
    def alone(self):
        with self.free:
            self.free.wait_for(lambda: not self.readers)
            yield


class Run:
    """The limits of one run of calls, and the flag that stops it."""

    def __init__(self, limits, told):
        self.flag, self.start, self.limits = ffi.new("lam_cancel *"), time.monotonic(), limits
        self.handle = told and ffi.new_handle(told)

    @property
    def control(self):
        """A lam_control for the next call, with the remaining time."""
        control = ffi.new("lam_control *", self.limits[0] if self.limits else {})
        control.cancel = self.flag
        if control.time_limit_s > 0:
            control.time_limit_s = max(control.time_limit_s - (time.monotonic() - self.start), 1e-9)
        if self.handle:
            control.progress, control.user = lib.tell_progress, self.handle
        return control


def run(work, limits=None, progress=None):
    """Returns work(run). It runs in a separate thread while this thread waits, so that Ctrl-C takes effect immediately; the library's calls release
    the GIL. `progress(share, step)` is called in this thread. An exception here, including Ctrl-C, first stops the work and is then raised."""
    if progress is not None and not callable(progress):
        raise BadValue("progress: found %s, expected a function" % shown(progress))
    told, result, stopped = queue.SimpleQueue(), {}, None
    task = Run(limits, told if progress else None)

    def body():
        try:
            result["value"] = work(task)
        except TimeLimit:  # the library knows only the time that was left
            result["error"] = TimeLimit("the time limit of %g s is over" % limits.time_limit_s)
        except BaseException as error:  # raised in the caller's thread
            result["error"] = error
        told.put(None)

    threading.Thread(target=body, daemon=True).start()
    while True:
        try:
            step = told.get()
            if step is None:
                break
            if not stopped and progress(*step) is False:
                lib.lam_cancel_raise(task.flag)
        except BaseException as error:
            stopped = stopped or error
            lib.lam_cancel_raise(task.flag)
    if stopped or "error" in result:
        raise stopped or result["error"]
    return result["value"]
