"""Tests of a core behind its stream link, in a simulator with unknown values: no use of the ports hangs the device."""

from collections.abc import Awaitable, Callable
from typing import Any

import cocotb
from device import (
    BAD_CONTEXTS,
    BAD_RANGE,
    BEAT_BITS,
    BEAT_BYTES,
    BUSY,
    CLEAR,
    COLLINEAR,
    CONTEXTS,
    CONTROL,
    COUNTERS,
    ERRORS,
    FAULT,
    FULL,
    HAS_ERROR,
    HELLO,
    INSERT,
    OK,
    POINTS,
    RESETTING,
    RING,
    RUNS,
    STATUS,
    TRIANGLES,
    UNKNOWN_OPCODE,
    Device,
    clear,
    insert,
    mesh,
    status,
    triangles,
)
from oracle import delaunay

# A small core takes minutes for a set that fills it.
SOME = min(POINTS, 24)
SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
# The feature of protocol/README.md that every core of this version has.
SHORT_IDS = 1 << 17
IDENTITY = [0x696E4369, 0x20000, 0x300, 16, POINTS, 0x100 | CONTEXTS, SHORT_IDS | RING]


def test(body: Callable[[Any], Awaitable[None]]) -> Any:
    """A test that fails after five milliseconds of simulated time, so that none can hang. All take far less."""
    return cocotb.test(timeout_time=5, timeout_unit="ms")(body)


@test
async def registers_and_slverr(dut: Any) -> None:
    """Registers have the values of protocol/STREAM.md; all other addresses give SLVERR, whatever the protection."""
    device = await Device(dut).reset()
    device.stall()
    head = [IDENTITY[0], 0x10000, *IDENTITY[1:3], 16, POINTS, *IDENTITY[5:], BEAT_BITS, 512]
    for place, value in enumerate(head):
        assert await device.read(4 * place) == value, f"register {4 * place:x}"
    known = {4 * i for i in range(10)} | {CONTROL, STATUS, ERRORS, FAULT} | set(range(0x80, 0x9C, 4))
    for offset in [*range(0, 0x100, 4), 0x400, 0x7FC, 0x800, 0xFFC]:
        value, response = await device.access(offset)
        assert response == (0 if offset in known else 2), f"read of {offset:x}"
        assert offset in known or value == 0, f"value of {offset:x}"
        _, response = await device.access(offset, bytes(4))
        assert response == (0 if offset in (CONTROL, ERRORS) else 2), f"write of {offset:x}"
    # Bytes 1 to 3, without byte 0, which holds the bit: no reset.
    await device.access(CONTROL + 1, b"\x01\x01\x01")
    assert await device.read(CONTROL) == 0
    assert await device.read(STATUS) == RUNS


@test
async def identity(dut: Any) -> None:
    """`Hello` is answered with the identity of the core."""
    device = await Device(dut).reset()
    await device.send([HELLO << 24])
    assert await device.answer() == [HELLO << 24, 7, *IDENTITY]


@test
async def meshes_under_random_stalls(dut: Any) -> None:
    """Meshes of random points, of ties and of duplicates are those of brute force, with stalls in both directions."""
    device = await Device(dut).reset()
    for share, places in [(0.5, 65536), (0.9, 3), (0.2, 5)]:
        device.stall(share)
        points = device.points(SOME, places)
        assert await device.job(points) == delaunay(points), points
    assert await device.read(ERRORS) == 0


@test
async def jobs_sent_ahead(dut: Any) -> None:
    """Several jobs wait in the FIFO while the core is busy, and each gets its own answers in order."""
    device = await Device(dut).reset()
    jobs = [device.points(min(SOME, 8)) for _ in range(4)]
    for tag, points in enumerate(jobs):
        job = clear(tag=tag) + insert(points) + triangles(2 * len(points) - 2)
        await device.send(job + [HELLO << 24, COUNTERS << 24])
    for tag, points in enumerate(jobs):
        answers = await device.answers(5)
        assert [answer[0] & 255 for answer in answers] == [tag] * 5
        assert mesh(answers[2], len(points)) == delaunay(points), points
        assert answers[3][2:] == IDENTITY and answers[4][1] == 25
    await device.await_status(RUNS | BUSY, RUNS)


@test
async def batch_side_by_side(dut: Any) -> None:
    """Two jobs share the memory of the core, and each mesh is that of its points alone."""
    device = await Device(dut).reset()
    # Half of the points of each job: the first three come together, all others in turn.
    count = min(POINTS // 2, 12)
    jobs = [device.points(count), device.points(count)]
    order = [0] * 3 + [1] * 3 + [0, 1] * (count - 3)
    places = [list(range(3)), list(range(3))]
    sent = [jobs[0][i] for i in places[0]] + [jobs[1][i] for i in places[1]]
    sent += [jobs[job][i] for i in range(3, count) for job in (0, 1)]
    await device.send([CLEAR << 24 | 2 << 9 | 1 << 8, *insert(sent), *triangles(2 * (2 * count - 2))])
    cleared, inserted, records = await device.answers(3)
    assert [status(cleared), status(inserted)] == [OK, OK]
    found: list[list[tuple[int, ...]]] = [[], []]
    for triangle in mesh(records, 2 * count):
        job = order[triangle[0]]
        assert all(order[corner] == job for corner in triangle)
        found[job].append(tuple(corner - 3 * job if corner < 6 else corner // 2 for corner in triangle))
    assert [sorted(triangles) for triangles in found] == [delaunay(points) for points in jobs]


@test
async def reset_in_the_middle(dut: Any) -> None:
    """A reset by `CONTROL` or by the pin, at many moments of a job, loses the job and nothing else."""
    device = await Device(dut).reset()
    for wait in (7, 40, 90, 200):
        for by_pin in (False, True):
            await device.send(clear() + insert(device.points(min(SOME, 8))))
            await device.source.wait()
            await device.clocks(wait)
            if by_pin:
                await device.reset(clocks=1)
            else:
                await device.write(CONTROL, 1)
                await device.await_core()
            device.sink.clear()
            points = device.points(min(SOME, 6))
            assert await device.job(points) == delaunay(points), points


@test
async def error_statuses(dut: Any) -> None:
    """Each error has its status in the answer, in `ERRORS` and in `FAULT`, and ends with the next `Clear`."""
    device = await Device(dut).reset()
    line = [(0, 0), (1, 1), (2, 2)]
    cases = [
        ([0x2A << 24], UNKNOWN_OPCODE),
        (triangles(1), BAD_RANGE),
        (clear(contexts=CONTEXTS + 1), BAD_CONTEXTS),
        (insert(line), COLLINEAR),
    ]
    if POINTS <= 64:
        cases.append((insert(device.points(POINTS + 1)), FULL))
    for command, expected in cases:
        await device.send(clear() + command)
        cleared, answer = await device.answers(2)
        assert [status(cleared), status(answer)] == [OK, expected]
        assert await device.read(STATUS) & HAS_ERROR
        assert (await device.read(ERRORS), await device.read(FAULT)) == (2, answer[0])
        await device.write(ERRORS, 2)
        assert (await device.read(ERRORS), await device.read(FAULT)) == (0, answer[0])
    assert await device.job(SQUARE) == delaunay(SQUARE)


@test
async def beat_with_a_hole(dut: Any) -> None:
    """A beat that lacks bytes is dropped and noted; the words behind it wait, and a reset mends all."""
    device = await Device(dut).reset()
    await device.source.send((HELLO << 24).to_bytes(4, "little"))
    assert await device.is_silent()
    assert await device.read(ERRORS) == 1
    # The number of points of this command is in the beat that is dropped.
    await device.send([0] * (BEAT_BYTES // 4 - 1) + [INSERT << 24])
    await device.source.send(bytes(4))
    assert await device.is_silent()
    assert await device.read(STATUS) == RUNS | BUSY | HAS_ERROR
    await device.write(CONTROL, 1)
    await device.await_core()
    await device.write(ERRORS, 1)
    assert await device.read(STATUS) == RUNS
    assert await device.job(SQUARE) == delaunay(SQUARE)


@test
async def stream_of_the_wrong_width(dut: Any) -> None:
    """A stream of 32 bits at a wider port: with its own tkeep all is dropped, without it the words are out of step."""
    device = await Device(dut).reset()
    words = clear() + insert(SQUARE)
    for word in words:
        await device.source.send(word.to_bytes(4, "little"))
    assert await device.is_silent()
    assert await device.read(ERRORS) == 1
    assert await device.read(STATUS) & BUSY == 0
    await device.write(ERRORS, 1)
    # Now each word comes with padding behind it, so the number of points is 0, and the words that follow are commands.
    for word in words:
        await device.send([word])
    answers = await device.answers(3)
    assert [answer[0] >> 16 for answer in answers[:2]] == [CLEAR << 8, INSERT << 8]
    assert status(answers[2]) == UNKNOWN_OPCODE
    assert await device.read(ERRORS) == 2
    await device.write(CONTROL, 1)
    await device.await_core()
    device.sink.clear()
    assert await device.job(SQUARE) == delaunay(SQUARE)


@test
async def host_that_does_not_read(dut: Any) -> None:
    """A host that reads no answers stops the stream of commands in the end, and loses nothing."""
    device = await Device(dut).reset()
    device.sink.pause = True
    beats = 512
    hellos = beats * BEAT_BYTES // 36 + 2
    await device.send([HELLO << 24] * hellos + [0] * ((beats + 16) * BEAT_BYTES // 4))
    await device.clocks(4000)
    assert dut.s_axis_tready.value == 0 and dut.m_axis_tvalid.value == 1
    assert await device.read(STATUS) == RUNS | BUSY
    device.sink.pause = False
    for answer in await device.answers(hellos):
        assert answer == [HELLO << 24, 7, *IDENTITY]
    # The core takes the padding word by word.
    await device.await_status(RUNS | BUSY, RUNS, reads=3000)


@test
async def odd_clocks(dut: Any) -> None:
    """The core works at many ratios of its clock to that of the bus."""
    for periods in [(8000, 32000), (32000, 8000), (8000, 8002), (8000, 7300), (10000, 3300), (4000, 9100)]:
        device = await Device(dut, periods).reset()
        device.stall(0.3)
        points = device.points(min(SOME, 7))
        assert await device.job(points) == delaunay(points), periods
        for clock in (device.bus_clock, device.core_clock):
            clock.stop()


@test
async def reset_of_one_side(dut: Any) -> None:
    """While the core's clock stands, a reset does not end and says so; with the clock it ends."""
    device = await Device(dut).reset()
    await device.send(clear() + insert(SQUARE) + [TRIANGLES << 24])
    await device.answers(2)
    device.core_clock.stop()
    await device.await_status(RUNS, 0)
    dut.bus_reset_n.value = 0
    await device.clocks(1)
    dut.bus_reset_n.value = 1
    await device.clocks(300)
    # The standing core cannot say that it has forgotten the command that it was busy with.
    assert await device.read(STATUS) == RESETTING | BUSY
    assert await device.read(CONTROL) == 1
    assert dut.s_axis_tready.value == 0 and dut.m_axis_tvalid.value == 0
    device.core_clock.start()
    await device.await_core()
    assert await device.job(SQUARE) == delaunay(SQUARE)


@test
async def core_clock_that_stops(dut: Any) -> None:
    """A core whose clock stands in mid-job says so, and goes on when the clock does."""
    device = await Device(dut).reset()
    points = device.points(min(SOME, 8))
    await device.send(clear() + insert(points) + triangles(2 * len(points) - 2))
    await device.clocks(60)
    device.core_clock.stop()
    await device.await_status(RUNS | BUSY, BUSY)
    device.core_clock.start()
    _, _, records = await device.answers(3)
    assert mesh(records, len(points)) == delaunay(points), points
    await device.await_status(RUNS | BUSY, RUNS)
