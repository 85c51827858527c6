"""A device with a UDP link at the pins of RGMII, with the PHY of cocotbext-eth, and a host that speaks protocol/UDP.md."""

import os
import struct
import zlib
from random import Random
from typing import Any

from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, SimTimeoutError, with_timeout
from cocotbext.eth import GmiiFrame, RgmiiPhy
from oracle import Point, Triangle, canonical

# The core under test, as testbench/foreign/run_tests.py builds it.
POINTS = int(os.environ["INCIRCLE_CORE"].split()[0])
PERIOD_PS = 8400

BOARD_MAC, HOST_MAC = bytes.fromhex("020000694301"), bytes.fromhex("0201aabbccdd")
BOARD_IP, HOST_IP = bytes([192, 168, 1, 50]), bytes([192, 168, 1, 2])
BOARD_PORT, HOST_PORT = 26947, 50000

HELLO, OPEN, POLL, DATA, CLOSE = 1, 2, 4, 5, 6
HELLO_ANSWER, OPENED, ACK, NAK, ANSWER, ANSWER_END, NO_SESSION, CLOSED, BUSY = range(0x81, 0x8A)


def ones_sum(data: bytes) -> int:
    """The check sum of IPv4 and ICMP over these bytes."""
    words = struct.unpack(f">{(len(data) + 1) // 2}H", data + bytes(len(data) % 2))
    total = sum(words)
    while total >> 16:
        total = (total & 0xFFFF) + (total >> 16)
    return ~total & 0xFFFF


def ipv4(protocol: int, payload: bytes, source: bytes = HOST_IP, target: bytes = BOARD_IP) -> bytes:
    """A packet of IPv4 with a header of 20 bytes."""
    head = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(payload), 7, 0, 64, protocol, 0, source, target)
    return head[:10] + ones_sum(head).to_bytes(2, "big") + head[12:] + payload


def arp(operation: int, sender: tuple[bytes, bytes], target: tuple[bytes, bytes]) -> bytes:
    """A message of ARP."""
    return struct.pack(">HHBBH", 1, 0x800, 6, 4, operation) + b"".join(sender + target)


def sealed(kind: int, number: int, session: int, words: list[int]) -> bytes:
    """A datagram of the link to the device."""
    body = struct.pack("<IIQ", kind, number, session) + b"".join(word.to_bytes(4, "little") for word in words)
    return body + zlib.crc32(body).to_bytes(4, "little")


class Board:
    """The pins, and what a host does with them. All waits have a bound."""

    def __init__(self, dut: Any, seed: int = 1) -> None:
        self.dut, self.random = dut, Random(seed)
        dut.reset.value = 1
        self.phy_clock = Clock(dut.rx_clock, 8, "ns")
        self.phy_clock.start()
        self.core_clock = Clock(dut.core_clock, PERIOD_PS, "ps")
        self.core_clock.start()
        self.session, self.number = 0, 0

    async def reset(self) -> "Board":
        """Holds the reset until all pins are known, and gives the clock of the PHY to the PHY of cocotbext-eth."""
        self.dut.rx_ctl.value = 0
        self.dut.rxd.value = 0
        await ClockCycles(self.dut.core_clock, 20)
        self.phy_clock.stop()
        dut = self.dut
        self.phy = RgmiiPhy(dut.txd, dut.tx_ctl, dut.tx_clock, dut.rxd, dut.rx_ctl, dut.rx_clock, speed=1000e6)
        await ClockCycles(self.dut.core_clock, 20)
        self.dut.reset.value = 0
        await ClockCycles(self.dut.core_clock, 100)
        return self

    async def restart(self, period: int = PERIOD_PS) -> None:
        """Resets a board that runs, with this period of the core's clock from now on, in picoseconds."""
        self.core_clock.stop()
        self.core_clock = Clock(self.dut.core_clock, 2 * (period // 2), "ps")
        self.core_clock.start()
        self.dut.reset.value = 1
        await self.clocks(20)
        self.dut.reset.value = 0
        await self.clocks(100)
        # What the reset has cut short counts for nothing.
        self.phy.tx.clear()

    async def clocks(self, count: int) -> None:
        """Waits for this many clocks of the core."""
        await ClockCycles(self.dut.core_clock, count)

    def stop_phy(self) -> None:
        """Stops the clock that the PHY gives. The PHY sends and hears nothing until `start_phy`."""
        self.phy._clock_cr.cancel()
        self.phy._clock_cr = None

    def start_phy(self) -> None:
        """Lets the clock of the PHY run again."""
        self.phy.set_speed(1000e6)

    async def send(self, kind: int, payload: bytes, target: bytes = BOARD_MAC, damage: int | None = None) -> None:
        """Sends a frame of Ethernet with this type, padded, with its check sum; `damage` is a bit to turn."""
        body = target + HOST_MAC + kind.to_bytes(2, "big") + payload
        body += bytes(max(0, 60 - len(body)))
        frame = bytearray(body + zlib.crc32(body).to_bytes(4, "little"))
        if damage is not None:
            frame[damage // 8 % len(frame)] ^= 1 << damage % 8
        await self.phy.rx.send(GmiiFrame.from_raw_payload(bytes(frame)))

    async def frame(self, microseconds: int = 200) -> tuple[int, bytes]:
        """Type and payload of the next frame from the board, which must be to this host and sound."""
        frame = await with_timeout(self.phy.tx.recv(), microseconds, "us")
        assert frame.check_fcs(), "a wrong check sum"
        assert not any(frame.error or []), "an error on the pins"
        data = bytes(frame.get_payload())
        assert len(data) >= 60 and data[:6] == HOST_MAC and data[6:12] == BOARD_MAC, data[:14].hex()
        return int.from_bytes(data[12:14], "big"), data[14:]

    async def is_silent(self, microseconds: int = 20) -> bool:
        """True if the board sends nothing within this time."""
        try:
            await with_timeout(self.phy.tx.recv(), microseconds, "us")
        except SimTimeoutError:
            return True
        return False

    async def send_datagram(self, payload: bytes, **options: Any) -> None:
        """Sends a datagram of UDP without a check sum to the port of the board."""
        head = struct.pack(">HHHH", HOST_PORT, BOARD_PORT, 8 + len(payload), 0)
        await self.send(0x800, ipv4(17, head + payload), **options)

    async def datagram(self, microseconds: int = 200) -> bytes:
        """The payload of the next datagram of UDP from the board, whose headers must be right."""
        kind, packet = await self.frame(microseconds)
        assert kind == 0x800 and ones_sum(packet[:20]) == 0
        length = int.from_bytes(packet[2:4], "big")
        assert packet[9] == 17 and packet[12:20] == BOARD_IP + HOST_IP
        ports = struct.pack(">HHH", BOARD_PORT, HOST_PORT, length - 20)
        assert packet[20:26] == ports and packet[26:28] == bytes(2), packet[20:28].hex()
        body = packet[28:length]
        assert zlib.crc32(body[:-4]) == int.from_bytes(body[-4:], "little")
        return body[:-4]

    async def say(self, kind: int, words: list[int] | None = None, **options: Any) -> None:
        """Sends a datagram of the open session; the number of `Data` counts up."""
        number = self.number if kind == DATA else 0
        self.number += kind == DATA
        await self.send_datagram(sealed(kind, number, self.session, words or []), **options)

    async def heard(self, *kinds: int) -> bytes:
        """The next datagram of one of these kinds in this session; an `Ack` between them is passed over."""
        for _ in range(50):
            body = await self.datagram()
            assert int.from_bytes(body[8:16], "little") == self.session
            if body[0] in kinds:
                return body
            assert body[0] == ACK, hex(body[0])
        raise AssertionError("only acknowledgements")

    async def open(self) -> None:
        """Opens a session with a number of its own."""
        self.session, self.number = self.random.randrange(1, 1 << 64), 0
        await self.say(OPEN)
        await self.heard(OPENED)

    async def close(self) -> None:
        """Ends the session."""
        await self.say(CLOSE)
        await self.heard(CLOSED)

    async def answer(self) -> list[int]:
        """The words of the next answer, from all of its datagrams."""
        words: list[int] = []
        while True:
            body = await self.heard(ANSWER, ANSWER_END)
            assert int.from_bytes(body[20:24], "little") == len(words), "a part is missing"
            end = len(body) if body[0] == ANSWER else len(body) - 4
            words += [int.from_bytes(body[i : i + 4], "little") for i in range(24, end, 4)]
            if body[0] == ANSWER_END:
                raw = b"".join(word.to_bytes(4, "little") for word in words)
                assert body[-4:] == zlib.crc32(raw).to_bytes(4, "little")
                return words

    async def job(self, points: list[Point]) -> list[Triangle]:
        """Triangulates the points, whose first three must span a triangle, and returns the mesh."""
        distinct = len(set(points))
        records = 2 * distinct - 2
        await self.say(DATA, [2 << 24, 3 << 24, len(points), *(x | y << 16 for x, y in points), 7 << 24, 0, records])
        cleared, inserted, read = [await self.answer() for _ in range(3)]
        assert [answer[0] >> 16 & 255 for answer in (cleared, inserted, read)] == [0, 0, 0]
        assert inserted[2:] == [len(points), distinct, len(points) - distinct, 0, records]
        ids = [half for word in read[2:] for half in (word & 0xFFFF, word >> 16)]
        found = [(ids[i], ids[i + 1], ids[i + 2]) for i in range(0, len(ids) - 2, 3)]
        return sorted(canonical(triangle) for triangle in found if max(triangle) < len(points))

    def points(self, count: int, places: int = 65536) -> list[Point]:
        """Random points on a grid of `places` by `places`; the first three span a triangle."""
        while True:
            points = [(self.random.randrange(places), self.random.randrange(places)) for _ in range(count)]
            (ax, ay), (bx, by), (cx, cy) = points[:3]
            if (bx - ax) * (cy - ay) != (by - ay) * (cx - ax):
                return points
