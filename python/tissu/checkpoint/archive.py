"""The format of a checkpoint: an .npz of NumPy, with the SHA-256 of all its bytes at its end.

`numpy.load` opens it, without pickle: one member for each array, beside `header.json`. The comment
of the zip archive, its last 64 bytes, is the digest of everything before it, so that a file that
was cut short or changed in any byte is recognised. The members are not compressed and
carry no dates: equal contents are equal bytes.
"""

from __future__ import annotations

import hashlib
import io
import json
import math
import struct
import zipfile
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

_HEADER = "header.json"
_DIGEST = hashlib.sha256().digest_size * 2
_UNREADABLE = (
    *(zipfile.BadZipFile, KeyError, ValueError, TypeError, IndexError, OverflowError, EOFError),
    *(NotImplementedError, RuntimeError, RecursionError, MemoryError, struct.error, zlib.error),
)
"""What zipfile, json and NumPy raise on bytes that are none of theirs."""
_NO_DATE = (1980, 1, 1, 0, 0, 0)


class DamagedError(Exception):
    """The digest does not match: damaged, cut short, or no checkpoint at all."""


def pack(header: Mapping[str, Any], arrays: Mapping[str, Array]) -> bytes:
    """A header of plain values and arrays of numbers as the bytes of a file."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as archive:
        archive.comment = b"0" * _DIGEST
        text = json.dumps(header, indent=1, allow_nan=False, ensure_ascii=False)
        archive.writestr(zipfile.ZipInfo(_HEADER, _NO_DATE), text.encode())
        for name, values in arrays.items():
            member = io.BytesIO()
            np.lib.format.write_array(member, np.asarray(values), allow_pickle=False)
            archive.writestr(zipfile.ZipInfo(f"{name}.npy", _NO_DATE), member.getbuffer())
    data = buffer.getvalue()[:-_DIGEST]
    return data + _digest(data)


def unpack(data: bytes) -> tuple[dict[str, Any], dict[str, Array]]:
    """Header and arrays of what `pack` made.

    Raises:
        DamagedError: it is not, to the last byte.
    """
    if len(data) <= _DIGEST or _digest(data[:-_DIGEST]) != data[-_DIGEST:]:
        raise DamagedError
    # A digest is easy to compute: what follows is believed no more than another file.
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = archive.infolist()
            if any(member.compress_type != zipfile.ZIP_STORED for member in members):
                raise DamagedError
            if sum(member.file_size for member in members) > len(data):
                raise DamagedError
            header = json.loads(archive.read(_HEADER))
            names = [member.filename for member in members if member.filename != _HEADER]
            arrays = {name.removesuffix(".npy"): _array(archive.read(name)) for name in names}
    except _UNREADABLE:
        raise DamagedError from None
    if not isinstance(header, dict):
        raise DamagedError
    return header, arrays


def _array(data: bytes) -> Array:
    """The array of a member, whose header asks for no more numbers than follow it.

    Raises:
        DamagedError: it does, or they are not numbers.
    """
    stream = io.BytesIO(data)
    version = np.lib.format.read_magic(stream)
    if version != (1, 0):
        raise DamagedError
    shape, _, dtype = np.lib.format.read_array_header_1_0(stream)
    if dtype.kind not in "fi" or math.prod(shape) * dtype.itemsize != len(data) - stream.tell():
        raise DamagedError
    stream.seek(0)
    return np.asarray(np.lib.format.read_array(stream, allow_pickle=False))


def _digest(data: bytes) -> bytes:
    return hashlib.sha256(data).hexdigest().encode()
