"""NetCDF files, read and written by one thread at a time.

The NetCDF library and the HDF5 library below it keep state of the whole process. xarray locks them while it reads the
values of a variable, but not while it opens a file or asks for its attributes: two threads that do crash the
interpreter now and then. Everything of this package that touches such a file holds one lock.
"""

from __future__ import annotations

import builtins
import contextlib
import os
import threading
import uuid
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import xarray as xr

from footfall._arguments import os_error, shown
from footfall.errors import InvalidInput

Result = TypeVar("Result")

_one_at_a_time = threading.Lock()

#: As many symbolic links as the kernel follows.
_MOST_LINKS = 40

#: How files begin: NetCDF-4, which is HDF5, and the classic formats.
_SIGNATURES = (b"\x89HDF\r\n\x1a\n", b"CDF\x01", b"CDF\x02", b"CDF\x05")


#: A process that is forked while another thread holds the lock would wait for it for ever.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=lambda: _one_at_a_time._at_fork_reinit())  # type: ignore[attr-defined]


def _undisturbed(call: Callable[[], Result]) -> Result:
    """What ``call()`` gives, made alone, in a thread that no signal reaches: Ctrl-C inside xarray leaves its locks held.

    The thread holds the lock itself and does its work to the end, so that an interrupt may come at any moment.
    """
    results: list[Result] = []
    errors: list[BaseException] = []

    def work() -> None:
        try:
            with _one_at_a_time:
                results.append(call())
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=work, name="footfall-netcdf")
    interrupt: KeyboardInterrupt | None = None
    try:
        thread.start()
    except KeyboardInterrupt as error:
        interrupt = error
    while thread.is_alive():
        try:
            thread.join(0.1)
        except KeyboardInterrupt as error:
            interrupt = error
    if interrupt is not None:
        raise interrupt
    if errors:
        raise errors[0]
    return results[0]


def _check_name(file: Path) -> None:
    try:
        str(file).encode()
    except UnicodeEncodeError:
        raise InvalidInput(f"path: {shown(file)} is not allowed: NetCDF files have names in UTF-8") from None


def read_netcdf(file: Path) -> xr.Dataset:
    """The whole dataset. OSError where the file cannot be read; InvalidInput where it is no NetCDF file, or a part of
    one."""
    _check_name(file)
    if file.is_fifo():
        raise InvalidInput(f"{file}: is not a file of a run, but a pipe")
    try:
        with builtins.open(file, "rb") as stream:
            start = stream.read(max(map(len, _SIGNATURES)))
    except OSError as error:
        raise os_error(error.errno or 0, f"cannot read {file}: {error.strerror}") from None
    if not start:
        raise InvalidInput(f"{file}: is empty; a NetCDF file of a run is wanted")
    if not start.startswith(_SIGNATURES):
        raise InvalidInput(
            f"{file}: is not a NetCDF file; one that 'footfall run -o' or Run.save has written is wanted"
        )
    def load() -> xr.Dataset:
        # An absolute name: xarray takes "~" for the home folder.
        with xr.open_dataset(Path(os.path.abspath(file)), engine="netcdf4") as opened:
            return opened.load()

    try:
        return _undisturbed(load)
    except MemoryError:
        raise
    except Exception as error:  # the libraries have many errors for a file that is not whole
        raise InvalidInput(f"{file}: cannot be read to its end: it is damaged or only a part of a file") from error


def _adopt_rights(partial: Path, target: Path) -> None:
    """Gives a new file the owner, as far as that is allowed, and the mode of the one that it replaces."""
    if not target.exists():
        return
    old = target.stat()
    with contextlib.suppress(PermissionError):
        os.chown(partial, old.st_uid, old.st_gid)
    os.chmod(partial, old.st_mode & 0o777)


def _bring_to_the_disk(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def written_whole(file: Path, dataset: xr.Dataset) -> Path:
    """Writes a NetCDF-4 file, which appears whole or not at all, and gives its path. OSError where that fails."""
    # A stream's link, such as /dev/stdout, leads to whatever file the stream goes to: it is not one to be replaced.
    link = file
    for _ in range(_MOST_LINKS):
        if not link.is_symlink():
            break
        if str(link.parent.resolve()).startswith("/proc/"):
            raise os_error(22, f"cannot write {file}: it is an open stream of a program; name a file")
        link = link.parent / os.readlink(link)
    else:
        raise os_error(40, f"cannot write {file}: it is a symbolic link that leads back to itself")
    target = Path(os.path.realpath(file))  # what a link points to is replaced, not the link
    _check_name(target)
    if file.is_symlink() and not target.exists():
        raise os_error(2, f"cannot write {file}: it is a symbolic link that leads to no file")
    if target.is_dir():
        raise os_error(21, f"cannot write {file}: it is a folder")
    if target.exists() and not target.is_file():
        raise InvalidInput(f"path: {str(file)!r} is not allowed: it is neither a file nor free for one")
    if target.exists() and not os.access(target, os.W_OK):
        raise os_error(13, f"cannot write {file}: it is write-protected")
    if not target.parent.is_dir():
        raise os_error(2, f"cannot write {file}: there is no folder {file.parent}")
    partial = target.with_name(f".{uuid.uuid4().hex}.part")

    def write() -> None:
        try:
            # Until it has the rights of what it replaces, nobody else may read it.
            mode = 0o600 if target.exists() else 0o666
            os.close(os.open(partial, os.O_CREAT | os.O_EXCL | os.O_WRONLY, mode))
            dataset.to_netcdf(partial, engine="netcdf4", format="NETCDF4")
            _adopt_rights(partial, target)
            _bring_to_the_disk(partial)
            os.replace(partial, target)
            _bring_to_the_disk(target.parent)
        finally:
            with contextlib.suppress(OSError):
                partial.unlink(missing_ok=True)

    try:
        _undisturbed(write)
    except OSError as error:
        raise os_error(error.errno or 0, f"cannot write {file}: {error.strerror or error}") from None
    except RuntimeError as error:  # how the NetCDF library says that a disk is full
        raise os_error(5, f"cannot write {file}: the disk is full or failing") from error
    return file
