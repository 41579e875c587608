"""What callers give, read and checked: errors name the argument, what it is, and what is wanted."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from footfall.errors import InvalidInput

Floats = npt.NDArray[np.float64]


def described(value: object) -> str:
    """What a value is, for a message."""
    if value is None:
        return "None"
    if isinstance(value, str):
        return f"the text {value if len(value) <= 40 else value[:37] + '...'!r}"
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype}, shape {value.shape}"
    return type(value).__name__


def number(
    name: str,
    value: Any,
    unit: str = "",
    *,
    above: float | None = None,
    at_least: float | None = None,
    at_most: float | None = None,
    infinite: bool = False,
) -> float:
    """One real number. TypeError where it is none; InvalidInput where it is NaN or out of its range."""
    wanted = f"one number in {unit}" if unit else "one number"
    if isinstance(value, (str, bytes, bytearray, bool, np.bool_)) or getattr(value, "ndim", 0) != 0:
        raise TypeError(f"{name}: {wanted} is wanted, not {described(value)}")
    try:
        result = float(value)
    except OverflowError:
        raise InvalidInput(f"{name}: is not allowed: larger than any number that can be computed with") from None
    except (TypeError, ValueError):
        raise TypeError(f"{name}: {wanted} is wanted, not {described(value)}") from None
    if not _within(result, above, at_least, at_most, None, infinite=infinite):
        rule = _rule(above, at_least, at_most, None, infinite=infinite)
        raise InvalidInput(f"{name}: {_with_unit(result, unit)} is not allowed: must be {rule}")
    return result


def _with_unit(value: float, unit: str) -> str:
    return f"{value:g} {unit}" if unit else f"{value:g}"


def _within(
    value: float,
    above: float | None,
    at_least: float | None,
    at_most: float | None,
    below: float | None,
    *,
    infinite: bool,
) -> bool:
    return (
        not math.isnan(value)
        and (infinite or math.isfinite(value))
        and (above is None or value > above)
        and (at_least is None or value >= at_least)
        and (at_most is None or value <= at_most)
        and (below is None or value < below)
    )


def _rule(
    above: float | None, at_least: float | None, at_most: float | None, below: float | None, *, infinite: bool
) -> str:
    """What is allowed, in words."""
    if at_least is not None and at_most is not None:
        return f"from {at_least:g} to {at_most:g}"
    limits = ((">", above), (">=", at_least), ("<=", at_most), ("<", below))
    rules = [f"{sign} {limit:g}" for sign, limit in limits if limit is not None]
    if not infinite and at_most is None and below is None:
        rules.append("finite")
    return " and ".join(rules) or "a number"


def integer(name: str, value: Any, low: int, high: int | None = None, meaning: str = "") -> int:
    """One whole number from ``low`` to ``high``; what it is an index into, say, is ``meaning``."""
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: a whole number is wanted, not bool")
    try:
        result = value.__index__()
    except (AttributeError, TypeError):
        raise TypeError(f"{name}: a whole number is wanted, not {described(value)}") from None
    if result < low or (high is not None and result > high):
        allowed = f">= {low}" if high is None else f"from {low} to {high}"
        said = str(result) if abs(result) < 10**20 else "so large a number"
        raise InvalidInput(f"{name}: {said} is not allowed: must be {allowed}{meaning}")
    return int(result)


def real_array(name: str, value: Any) -> npt.NDArray[Any]:
    """An array of real numbers, of any shape and number type."""
    if isinstance(value, (list, tuple)) and any(isinstance(item, np.ma.MaskedArray) for item in value):
        value = np.ma.stack(value) if len({np.shape(item) for item in value}) == 1 else value
    if isinstance(value, np.ma.MaskedArray) and value.dtype.kind in "fiub":
        value = np.ma.filled(value.astype(np.float64), np.nan)  # what is masked is not known
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: real numbers are wanted, in lists of equal length where they are nested") from None
    if array.dtype.kind not in "fiub":
        kind = "complex numbers" if array.dtype.kind == "c" else described(value)
        raise TypeError(f"{name}: real numbers are wanted, not {kind}")
    return array


def column(
    name: str,
    values: Any,
    unit: str = "",
    *,
    above: float | None = None,
    at_least: float | None = None,
    below: float | None = None,
) -> list[float]:
    """One number or a list of them, each finite and in the range."""
    array = np.atleast_1d(real_array(name, values))
    if array.ndim != 1:
        raise InvalidInput(f"{name}: shape {array.shape} is not allowed: one number or a list of them is wanted")
    if array.size == 0:
        raise InvalidInput(f"{name}: an empty list is not allowed: at least one number is wanted")
    numbers: list[float] = array.astype(np.float64).tolist()
    for i, value in enumerate(numbers):
        if not _within(value, above, at_least, None, below, infinite=False):
            where = f" at index {i}" if len(numbers) > 1 else ""
            rule = _rule(above, at_least, None, below, infinite=False)
            raise InvalidInput(f"{name}: {_with_unit(value, unit)}{where} is not allowed: must be {rule}")
    return numbers


def choice(name: str, value: Any, allowed: Sequence[str]) -> str:
    """One of a few words."""
    if not isinstance(value, str) or value not in allowed:
        said = repr(value) if isinstance(value, (str, int, float)) else described(value)
        *most, last = (repr(word) for word in allowed)
        raise InvalidInput(f"{name}: {said} is not allowed: must be {', '.join(most)}{' or ' if most else ''}{last}")
    return value


def flag(name: str, value: Any) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: True or False is wanted, not {described(value)}")
    return bool(value)


def text(name: str, value: Any, *, null: bool = False) -> str:
    """A text that can be written as UTF-8, without null characters where ``null`` does not allow them."""
    if not isinstance(value, str):
        raise TypeError(f"{name}: a text is wanted, not {described(value)}")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise InvalidInput(
            f"{name}: the character {value[error.start]!r} at index {error.start} is not allowed: it is half of one"
        ) from None
    if "\0" in value and not null:
        raise InvalidInput(f"{name}: {value[:40]!r} is not allowed: it has a null character")
    return value


def texts(name: str, value: Any) -> dict[str, str]:
    """Texts by their names; none where nothing is given. Numbers are taken for their texts."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise TypeError(f"{name}: a dict of texts is wanted, not {described(value)}")
    made = {}
    for key, item in value.items():
        number_like = isinstance(item, (int, float)) and not isinstance(item, bool)
        made[text(f"{name}: a key", key)] = str(item) if number_like else text(f"{name}[{key!r}]", item)
    return made


def path(name: str, value: Any) -> Path:
    """A path of a file or folder."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name}: a path is wanted, not {described(value)}")
    result = Path(os.fsdecode(value))
    try:
        os.fsencode(result)
    except UnicodeEncodeError:
        raise InvalidInput(f"{name}: {str(result)!r} is not allowed: no path has half a character") from None
    if "\0" in str(result):
        raise InvalidInput(f"{name}: {str(result)!r} is not allowed: no path has a null character")
    return result


def shown(file: Path) -> str:
    """A path for a message: bytes of a name that are no UTF-8 as escapes."""
    return os.fsencode(file).decode(errors="backslashreplace")


def folder(name: str, value: Any) -> Path:
    """A folder to write into, made where it is missing. OSError where it cannot be made."""
    result = path(name, value)
    try:
        result.mkdir(parents=True, exist_ok=True)
    except FileExistsError as error:
        raise os_error(error.errno or 0, f"cannot write into {result}: it is a file, not a folder") from None
    except OSError as error:
        raise os_error(error.errno or 0, f"cannot make the folder {result}: {error.strerror}") from None
    return result


def function(name: str, value: Any) -> None:
    """A function, or None."""
    if value is not None and not callable(value):
        raise TypeError(f"{name}: a function is wanted, not {described(value)}")


def os_error(number: int, message: str) -> OSError:
    """The OSError of the system's number, with a message of ours."""
    error = type(OSError(number, ""))(message)
    error.errno = number
    return error
