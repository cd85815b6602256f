"""A program that plays a device over UDP: python played_device.py PORT; it prints what it was told.

It is written from docs/guide/trocar.md alone, as the program of a microcontroller would be: 1,000 frames
a second to whoever asks, motors off 20 ms after the last answer.
"""

import select
import socket
import struct
import sys
import time
import zlib

FRAME = "<4sIQ5iHHQ12x"
ANSWER = "<4sI5fHH"


def frame(sequence, counts, flags=7, tag=1):
    """A frame of 64 bytes."""
    body = struct.pack(FRAME, b"TSU1", sequence, sequence * 1_000_000, *counts, flags, 0, tag)
    return body + struct.pack("<I", zlib.crc32(body))


def answer(data):
    """Sequence, torques, enable and watchdog of an answer of 36 bytes; None of a damaged one."""
    if len(data) != 36 or zlib.crc32(data[:32]) != struct.unpack("<I", data[32:])[0]:
        return None
    magic, sequence, *torque, enable, watchdog = struct.unpack(ANSWER, data[:32])
    return (sequence, torque, enable, watchdog) if magic == b"TSA1" else None


def play(port):
    """Plays until it is told nothing for two seconds."""
    line = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    line.bind(("127.0.0.1", port))
    print(line.getsockname()[1], flush=True)
    who, sequence, last, largest, on = None, 0, time.monotonic(), 0.0, False
    while time.monotonic() - last < 2.0:
        if select.select([line], [], [], 0.001)[0]:
            data, who = line.recvfrom(100)
            told = answer(data)
            if told is not None:
                last, largest = time.monotonic(), max(largest, -told[1][3])
                if on and not told[2]:  # switched off after it was on
                    break
                on = bool(told[2])
        if who is not None:
            sequence += 1
            further = min(sequence, 280) // 2  # 14 mm in 0.28 s, in counts of 0.1 mm
            line.sendto(frame(sequence, [0, 0, 0, 1000 + further, 0]), who)
    print(f"frames {sequence} largest {largest:.3f} off {not on or not told[2]}", flush=True)


if __name__ == "__main__":
    play(int(sys.argv[1]))
