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
from pathlib import Path

import xarray as xr

from footfall._arguments import os_error, shown
from footfall.errors import InvalidInput

_one_at_a_time = threading.Lock()

#: How files begin: NetCDF-4, which is HDF5, and the classic formats.
_SIGNATURES = (b"\x89HDF\r\n\x1a\n", b"CDF\x01", b"CDF\x02", b"CDF\x05")


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
    with _one_at_a_time:
        try:
            with xr.open_dataset(file, engine="netcdf4") as opened:
                return opened.load()
        except (MemoryError, KeyboardInterrupt):
            raise
        except Exception as error:  # the libraries have many errors for a file that is not whole
            raise InvalidInput(f"{file}: cannot be read to its end: it is damaged or only a part of a file") from error


def written_whole(file: Path, dataset: xr.Dataset) -> Path:
    """Writes a NetCDF-4 file, which appears whole or not at all, and gives its path. OSError where that fails."""
    target = Path(os.path.realpath(file))  # what a link points to is replaced, not the link
    _check_name(target)
    if target.is_dir():
        raise os_error(21, f"cannot write {file}: it is a folder")
    if target.exists() and not target.is_file():
        raise InvalidInput(f"path: {str(file)!r} is not allowed: it is neither a file nor free for one")
    if not target.parent.is_dir():
        raise os_error(2, f"cannot write {file}: there is no folder {file.parent}")
    partial = target.with_name(f".{uuid.uuid4().hex}.part")
    try:
        try:
            os.close(os.open(partial, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
            with _one_at_a_time:
                dataset.to_netcdf(partial, engine="netcdf4", format="NETCDF4")
            os.replace(partial, target)
        except OSError as error:
            raise os_error(error.errno or 0, f"cannot write {file}: {error.strerror or error}") from None
        except RuntimeError as error:  # how the NetCDF library says that a disk is full
            raise os_error(5, f"cannot write {file}: the disk is full or failing") from error
    finally:
        with contextlib.suppress(OSError):
            partial.unlink(missing_ok=True)
    return file
