"""A device with a stream link at the ports of a simulator, driven by the bus models of cocotbext-axi."""

import itertools
import os
from collections.abc import Iterator
from random import Random
from typing import Any

from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, SimTimeoutError, with_timeout
from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiProt, AxiStreamBus, AxiStreamSink, AxiStreamSource
from oracle import Point, Triangle, canonical

# The core under test, as testbench/foreign/run_tests.py builds it.
POINTS, CONTEXTS, RING, BEAT_BITS = (int(word) for word in os.environ["INCIRCLE_CORE"].split())
BEAT_BYTES = BEAT_BITS // 8

HELLO, CLEAR, INSERT, READ, COUNTERS, LATENCIES, TRIANGLES = range(1, 8)
OK, UNKNOWN_OPCODE, BAD_RANGE, COLLINEAR, FULL, BAD_CONTEXTS = range(6)
CONTROL, STATUS, ERRORS, FAULT = 0x40, 0x44, 0x48, 0x4C
RUNS, BUSY, RESETTING, HAS_ERROR = 1, 2, 4, 8
PERIODS_PS = (8000, 10000)


def clear(contexts: int = 0, tag: int = 0) -> list[int]:
    """The words of a Clear for this many contexts, 0 for all."""
    return [CLEAR << 24 | tag << 16 | contexts]


def insert(points: list[Point]) -> list[int]:
    """The words of an Insert."""
    return [INSERT << 24, len(points), *(x | y << 16 for x, y in points)]


def triangles(records: int, first: int = 0) -> list[int]:
    """The words of a Triangles."""
    return [TRIANGLES << 24, first, records]


def status(answer: list[int]) -> int:
    """The status in the header of an answer."""
    return answer[0] >> 16 & 255


def mesh(answer: list[int], points: int) -> list[Triangle]:
    """The triangles in an answer to Triangles, without ghosts, in the form of the oracle."""
    assert status(answer) == OK, hex(answer[0])
    ids = [half for word in answer[2:] for half in (word & 0xFFFF, word >> 16)]
    records = [(ids[i], ids[i + 1], ids[i + 2]) for i in range(0, len(ids) - 2, 3)]
    return sorted(canonical(record) for record in records if max(record) < points)


class Device:
    """The ports of the device, its two clocks, and what a host does with them. All waits have a bound."""

    def __init__(self, dut: Any, periods: tuple[int, int] = PERIODS_PS, seed: int = 1) -> None:
        self.dut, self.random = dut, Random(seed)
        self.bus_clock, self.core_clock = (
            Clock(clock, 2 * (period // 2), "ps")
            for clock, period in zip((dut.bus_clock, dut.core_clock), periods, strict=True)
        )
        dut.bus_reset_n.value = 0
        reset = {"reset": dut.bus_reset_n, "reset_active_level": False}
        self.source = AxiStreamSource(AxiStreamBus.from_prefix(dut, "s_axis"), dut.bus_clock, **reset)
        self.sink = AxiStreamSink(AxiStreamBus.from_prefix(dut, "m_axis"), dut.bus_clock, **reset)
        self.registers = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axi"), dut.bus_clock, **reset)
        self.bus_clock.start()
        self.core_clock.start()

    async def clocks(self, count: int) -> None:
        """Waits for this many clocks of the bus."""
        await ClockCycles(self.dut.bus_clock, count)

    async def reset(self, clocks: int = 4) -> "Device":
        """Holds `bus_reset_n` low for some clocks, and waits until the device is out of its reset."""
        self.dut.bus_reset_n.value = 0
        await self.clocks(clocks)
        self.dut.bus_reset_n.value = 1
        await self.clocks(2)
        await self.await_core()
        return self

    async def await_core(self) -> None:
        """Waits until STATUS says that the core's clock runs and no reset is under way."""
        await self.await_status(RUNS | RESETTING, RUNS)

    async def await_status(self, mask: int, value: int, reads: int = 500) -> None:
        """Reads STATUS until its bits below `mask` have this value."""
        for _ in range(reads):
            now = await self.read(STATUS)
            if now & mask == value:
                return
        raise AssertionError(f"STATUS stays at {now:x}: {mask:x} should be {value:x}")

    async def read(self, offset: int) -> int:
        """The value of a register that exists."""
        value, response = await self.access(offset)
        assert response == 0, f"register {offset:x} gives {response}"
        return value

    async def access(self, offset: int, value: bytes | None = None) -> tuple[int, int]:
        """Reads a register, or writes these bytes, and returns value and response. The protection is any."""
        prot = AxiProt(self.random.randrange(8))
        if value is None:
            work = self.registers.read(offset, 4, prot=prot)
            result = await with_timeout(work, 100, "us")
            return int.from_bytes(result.data, "little"), int(result.resp)
        result = await with_timeout(self.registers.write(offset, value, prot=prot), 100, "us")
        return 0, int(result.resp)

    async def write(self, offset: int, value: int) -> None:
        """Writes a register that can be written."""
        _, response = await self.access(offset, value.to_bytes(4, "little"))
        assert response == 0, f"register {offset:x} gives {response}"

    async def send(self, words: list[int]) -> None:
        """Queues the words for the stream of commands, with padding behind them up to a whole beat."""
        data = b"".join(word.to_bytes(4, "little") for word in words)
        await self.source.send(data + bytes(-len(data) % BEAT_BYTES))

    async def answer(self, microseconds: int = 1000) -> list[int]:
        """The words of the next answer, once its beats are found to be as protocol/STREAM.md promises."""
        frame = await with_timeout(self.sink.recv(), microseconds, "us")
        data = bytes(frame.tdata)
        words = [int.from_bytes(data[i : i + 4], "little") for i in range(0, len(data), 4)]
        length = 2 + words[1]
        # A byte without its bit of tkeep would be missing here.
        assert len(data) == -(-4 * length // BEAT_BYTES) * BEAT_BYTES, f"{len(data)} bytes for {length} words"
        assert not any(words[length:]), "words behind an answer"
        return words[:length]

    async def answers(self, count: int) -> list[list[int]]:
        """The next answers."""
        return [await self.answer() for _ in range(count)]

    async def is_silent(self, microseconds: int = 20) -> bool:
        """True if no answer comes within this time."""
        try:
            await with_timeout(self.sink.wait(), microseconds, "us")
        except SimTimeoutError:
            return True
        return False

    async def job(self, points: list[Point]) -> list[Triangle]:
        """Triangulates the points, whose first three must span a triangle, and returns the mesh."""
        distinct = len(set(points))
        await self.send(clear() + insert(points) + triangles(2 * distinct - 2))
        cleared, inserted, records = await self.answers(3)
        assert [status(cleared), status(inserted)] == [OK, OK]
        assert inserted[2:] == [len(points), distinct, len(points) - distinct, 0, 2 * distinct - 2]
        return mesh(records, len(points))

    def stalls(self, share: float) -> Iterator[bool]:
        """Pauses in this share of all clocks."""
        return (self.random.random() < share for _ in itertools.count())

    def stall(self, share: float = 0.5) -> None:
        """Lets all channels pause at random from now on."""
        reads, writes = self.registers.read_if, self.registers.write_if
        channels = [reads.ar_channel, reads.r_channel, writes.aw_channel, writes.w_channel, writes.b_channel]
        for channel in [self.source, self.sink, *channels]:
            channel.set_pause_generator(self.stalls(share))

    def points(self, count: int, places: int = 65536) -> list[Point]:
        """Random points on a grid of `places` by `places`; the first three span a triangle."""
        while True:
            points = [(self.random.randrange(places), self.random.randrange(places)) for _ in range(count)]
            (ax, ay), (bx, by), (cx, cy) = points[:3]
            if (bx - ax) * (cy - ay) != (by - ay) * (cx - ax):
                return points
