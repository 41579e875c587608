"""When two results are equal: arrays, tables and datasets among their fields have no one truth of their own."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np


def same(a: Any, b: Any) -> bool:
    """Whether two fields hold the same: NaN is the same as NaN, and labels and units count."""
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and bool(np.array_equal(a, b, equal_nan=a.dtype.kind == "f"))
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(same(one, other) for one, other in zip(a, b))
    for method in ("identical", "equals"):  # xarray's, pandas'
        if hasattr(a, method):
            return bool(getattr(a, method)(b))
    if isinstance(a, float) and math.isnan(a):
        return math.isnan(b)
    return bool(a == b)


class Compared:
    """A dataclass whose fields are compared by :func:`same`. It has no hash, as arrays have none."""

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        fields = dataclasses.fields(self)  # type: ignore[arg-type]
        return all(same(getattr(self, field.name), getattr(other, field.name)) for field in fields)
