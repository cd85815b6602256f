"""A program that plays a device over UDP, on command: python faulty_device.py PORT.

Until the first command it answers every question with a good frame. A command is a line on its
standard input with the name of the next fault. The program then prints the latest order that it
received: whether the motors are on, the largest torque, and the number of answers since the last
command. So a test controls the time of both sides.
"""

import select
import socket
import struct
import sys
import zlib

from played_device import FRAME, answer, frame

HOMED_IN = 1 | 2 | 4
DEPTH = 1120  # counts of 0.1 mm


def signed(counts, sequence, magic):
    """A frame with its right checksum, whatever its magic number is."""
    body = struct.pack(FRAME, magic, sequence, sequence * 1_000_000, *counts, HOMED_IN, 0, 1)
    return body + struct.pack("<I", zlib.crc32(body))


class Played:
    """What the device does with its line."""

    def __init__(self, port):
        self.line = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.line.bind(("127.0.0.1", port))
        self.who, self.sequence, self.told, self.answers = None, 0, (0, [0.0] * 5, 0, 0), 0

    def hear(self):
        """Takes all answers that are there."""
        while select.select([self.line], [], [], 0)[0]:
            data, self.who = self.line.recvfrom(100)
            self.told = answer(data) or self.told
            self.answers += 1

    def good(self, depth=DEPTH):
        self.sequence += 1
        self.send(frame(self.sequence, [0, 0, 0, depth, 0], tag=1))

    def nothing(self):
        """No frame: the line is cut, or the device hangs."""

    def twice(self):
        """The last frame once more."""
        self.send(frame(self.sequence, [0, 0, 0, DEPTH + 500, 0], tag=1))

    def late(self):
        """A good frame, and after it one that was sent before."""
        self.sequence += 2
        self.send(frame(self.sequence, [0, 0, 0, DEPTH, 0], tag=1))
        self.send(frame(self.sequence - 1, [0, 0, 0, DEPTH + 500, 0], tag=1))

    def nan(self):
        """Counts with the bits of numbers that are none: they are whole numbers all the same."""
        self.sequence += 1
        (bits,) = struct.unpack("<i", struct.pack("<f", float("nan")))
        self.send(frame(self.sequence, [bits] * 5, tag=1))

    def version(self):
        """A frame of a version that is not known, with its right checksum."""
        self.sequence += 1
        self.send(signed([0, 0, 0, DEPTH, 0], self.sequence, b"TSU2"))

    def short(self):
        """Half a frame."""
        self.sequence += 1
        self.send(frame(self.sequence, [0, 0, 0, DEPTH, 0], tag=1)[:32])

    def fault(self):
        """The device reports a fault of its own."""
        self.sequence += 1
        self.send(frame(self.sequence, [0, 0, 0, DEPTH, 0], flags=HOMED_IN | 8, tag=1))

    def send(self, data):
        self.line.sendto(data, self.who)


def play(port):
    """Plays until its standard input ends."""
    device = Played(port)
    print(device.line.getsockname()[1], flush=True)
    begun = False
    while True:
        ready = select.select([sys.stdin, device.line], [], [])[0]
        if sys.stdin in ready:
            command, begun = sys.stdin.readline().strip(), True
            if not command:
                return
            device.hear()
            _, torque, enable, _ = device.told
            getattr(device, command)()
            print(enable, max(map(abs, torque)), device.answers, flush=True)
            device.answers = 0
        elif not begun:
            device.hear()
            device.good()


if __name__ == "__main__":
    play(int(sys.argv[1]))
