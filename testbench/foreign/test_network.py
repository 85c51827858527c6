"""Tests of a core behind its UDP link, with the PHY model of cocotbext-eth at its pins: no Ethernet frame hangs the device."""

import struct
import zlib
from collections.abc import Awaitable, Callable
from typing import Any

import cocotb
from network import (
    BOARD_IP,
    BOARD_MAC,
    DATA,
    HELLO,
    HELLO_ANSWER,
    HOST_IP,
    HOST_MAC,
    NO_SESSION,
    OPEN,
    POINTS,
    POLL,
    Board,
    arp,
    ipv4,
    ones_sum,
    sealed,
)
from oracle import delaunay

SOME = min(POINTS, 24)
BROADCAST = bytes([255] * 6)


def test(body: Callable[[Any], Awaitable[None]]) -> Any:
    """A test that fails after two milliseconds of simulated time, so that none can hang. All take far less."""
    return cocotb.test(timeout_time=2, timeout_unit="ms")(body)


def echo(kind: int, payload: bytes) -> bytes:
    """A message of ICMP echo: 8 asks, 0 answers."""
    head = bytes([kind, 0, 0, 0, 0x12, 0x34, 0, 1])
    return head[:2] + ones_sum(head + payload).to_bytes(2, "big") + head[4:] + payload


@test
async def arp_and_ping(dut: Any) -> None:
    """The board says who has its address, and answers echo requests of many lengths."""
    board = await Board(dut).reset()
    await board.send(0x806, arp(1, (HOST_MAC, HOST_IP), (bytes(6), BOARD_IP)), target=BROADCAST)
    kind, message = await board.frame()
    assert (kind, message[:28]) == (0x806, arp(2, (BOARD_MAC, BOARD_IP), (HOST_MAC, HOST_IP)))
    for length in (0, 1, 56, 63):
        payload = board.random.randbytes(length)
        await board.send(0x800, ipv4(1, echo(8, payload)))
        kind, packet = await board.frame()
        assert kind == 0x800 and ones_sum(packet[:20]) == 0 and packet[12:20] == BOARD_IP + HOST_IP
        assert packet[20 : int.from_bytes(packet[2:4], "big")] == echo(0, payload), length


@test
async def greeting(dut: Any) -> None:
    """`Hello` is answered with the identity of the core, also to a broadcast; without a session the rest is refused."""
    board = await Board(dut).reset()
    board.session = 0xAA55
    for target in (BOARD_MAC, BROADCAST):
        await board.send_datagram(sealed(HELLO, 0, board.session, [0] * 14), target=target)
        body = await board.heard(HELLO_ANSWER)
        assert len(body) == 16 + 56 and body[16:20] == b"uCni" and body[36:42] == BOARD_MAC
        assert int.from_bytes(body[60:64], "little") == POINTS
    await board.say(POLL)
    await board.heard(NO_SESSION)


@test
async def meshes(dut: Any) -> None:
    """Meshes of random points, of ties and of duplicates are those of brute force, in several sessions."""
    board = await Board(dut).reset()
    for places in (65536, 3, 5):
        await board.open()
        for _ in range(2):
            points = board.points(SOME, places)
            assert await board.job(points) == delaunay(points), points
        await board.close()


@test
async def damaged_frames(dut: Any) -> None:
    """A frame with a bit turned anywhere behind its preamble is as if it had never been sent."""
    board = await Board(dut).reset()
    await board.open()
    for _ in range(12):
        await board.say(POLL, damage=board.random.randrange(64 * 8))
        assert await board.is_silent(3)
    # The same frame without damage is answered within that time.
    await board.say(POLL)
    assert not await board.is_silent(3)
    points = board.points(min(POINTS, 8))
    assert await board.job(points) == delaunay(points)


@test
async def noise(dut: Any) -> None:
    """Frames of noise, of every length and with right check sums, do not keep the board from the next job."""
    board = await Board(dut).reset()
    for length in (0, 1, 7, 46, 100, 400):
        for kind in (0x800, 0x806, 0x86DD):
            await board.send(kind, board.random.randbytes(length))
    for length in (0, 3, 16, 20, 99):
        payload = board.random.randbytes(length)
        # No `Open`: that of noise would be a session that has to die in silence.
        await board.send_datagram(payload if payload[:1] != bytes([OPEN]) else b"")
    assert await board.is_silent(10)
    await board.open()
    points = board.points(min(POINTS, 8))
    assert await board.job(points) == delaunay(points)


@test
async def commands_while_busy(dut: Any) -> None:
    """Commands that come while the core is busy wait, and all are answered in order."""
    board = await Board(dut).reset()
    await board.open()
    jobs = [board.points(min(POINTS, 8)) for _ in range(3)]
    for tag, points in enumerate(jobs):
        insert = [3 << 24, len(points), *(x | y << 16 for x, y in points)]
        await board.say(DATA, [2 << 24 | tag << 16, *insert, 7 << 24, 0, 2 * len(points) - 2, 1 << 24])
    for tag, _ in enumerate(jobs):
        heads = [(await board.answer())[0] for _ in range(4)]
        assert heads == [opcode << 24 | tag for opcode in (2, 3, 7, 1)]


@test
async def part_of_a_word(dut: Any) -> None:
    """`Data` that does not end with a whole word is dropped, whatever its check sum, and the session goes on."""
    board = await Board(dut).reset()
    await board.open()
    for some in (1, 2, 3):
        body = struct.pack("<IIQ", DATA, 0, board.session) + bytes([0, 0, 0, 1, 0, 0, 0, 1][: 4 + some])
        await board.send_datagram(body + zlib.crc32(body).to_bytes(4, "little"))
        assert await board.is_silent(5)
    points = board.points(min(POINTS, 8))
    assert await board.job(points) == delaunay(points)


@test
async def odd_clocks(dut: Any) -> None:
    """The board works at several ratios of the core's clock to that of the PHY, whose period is 8,000 ps."""
    board = await Board(dut).reset()
    for period in (3300, 7998, 26000):
        await board.restart(period)
        await board.open()
        points = board.points(min(POINTS, 7))
        assert await board.job(points) == delaunay(points), period


@test
async def reset_in_the_middle(dut: Any) -> None:
    """A reset at two moments of a job ends the session, says so to the host, and loses nothing else."""
    board = await Board(dut).reset()
    for wait in (200, 500):
        await board.open()
        job = cocotb.start_soon(board.job(board.points(min(POINTS, 8))))
        await board.clocks(wait)
        job.cancel()
        await board.restart()
        await board.say(POLL)
        await board.heard(NO_SESSION)
        await board.open()
        points = board.points(min(POINTS, 6))
        assert await board.job(points) == delaunay(points), wait
        await board.close()


@test
async def phy_clock_that_stops(dut: Any) -> None:
    """A PHY whose clock stands in mid-job, as one without a cable, delays the job and loses nothing."""
    board = await Board(dut).reset()
    await board.open()
    for wait in (50, 400):
        points = board.points(min(POINTS, 8))
        job = cocotb.start_soon(board.job(points))
        await board.clocks(wait)
        board.stop_phy()
        await board.clocks(300)
        board.start_phy()
        assert await job == delaunay(points), wait


@test
async def reset_of_one_side(dut: Any) -> None:
    """A reset while the clock of the PHY stands, which ends before or after that clock runs again, is a whole reset."""
    board = await Board(dut).reset()
    for ends_before in (False, True):
        await board.open()
        board.stop_phy()
        dut.reset.value = 1
        await board.clocks(200)
        if ends_before:
            dut.reset.value = 0
            await board.clocks(200)
        board.start_phy()
        await board.clocks(20)
        dut.reset.value = 0
        await board.clocks(200)
        board.phy.tx.clear()
        await board.say(POLL)
        await board.heard(NO_SESSION)
        await board.open()
        points = board.points(min(POINTS, 8))
        assert await board.job(points) == delaunay(points), ends_before
        await board.close()
